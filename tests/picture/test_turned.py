"""What turns and looks the same again is laid down as it was painted, and is the picture it would be."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pygame
import pytest
from fidelity import Pixels
from pictures import BARE, painted, pixels
from test_moving_parts import GAUGE, VIEW, geared, planetary

from linkanim.mechanics.linkage.drive import Drive
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Crank, Gear, Pin
from linkanim.picture import turned
from linkanim.picture.backdrop import Backdrop
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.painter import Painter
from linkanim.picture.parts.gears import turning_apart, wheel_parts
from linkanim.picture.raster import raster
from linkanim.picture.raster.blend import mix
from linkanim.picture.raster.directions import directions, folded
from linkanim.picture.raster.offscreen import offscreen
from linkanim.picture.raster.parts import Part, placed
from linkanim.picture.raster.raster import Layer
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load
from linkanim.scenes.editing.closures import ghost_of
from linkanim.scenes.scene import Scene

SIZE = (320, 180)
LOOK = Look(hud=False, chart="C.velocity")
PITCH = math.radians(30)
"""The press's wheels have twelve teeth each."""


def _bytes(surface: pygame.Surface) -> bytes:
    return bytes(surface.get_buffer().raw)


@pytest.fixture
def patched(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return a list that grows by how many layers a patch has, as often as one is painted."""
    counts: list[int] = []
    noting = raster.paint_noting

    def counted(*args: object, **options: object) -> object:
        counts.append(len(args[1]))  # type: ignore[arg-type]
        return noting(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(turned, "paint_noting", counted)
    return counts


@pytest.mark.parametrize(
    "look",
    [
        LOOK,
        replace(LOOK, background=False),
        # faint bars lie between the wheels and the lines that stand still
        replace(LOOK, ghost=True),
        replace(LOOK, ghost=True, background=False),
        replace(LOOK, zoom=6.0, pan=(0.4, 0.2)),
    ],
)
def test_teeth_are_painted_once_for_a_pitch_and_the_picture_is_the_one_they_would_be(
    patched: list[int], look: Look
) -> None:
    scene, surface = load("press"), offscreen(SIZE, alpha=not look.background)
    painter, other = Painter(scene, SIZE, look), ghost_of(scene)
    assert other
    for phase in (0.1, 0.2, 0.1 + PITCH, 0.2 + 5 * PITCH, 0.1 - 24 * PITCH):
        faint = other.pose(phase)
        painter.paint(surface, scene.pose(phase), ghost=faint)
        assert _bytes(surface) == _bytes(painted(scene, phase, look, SIZE, ghost=faint))
    # two pictures of rims, and four of holes, which only whole turns bring back; and those of the fresh ones
    assert (patched.count(4), patched.count(2)) == (2 + 5, 4 + 5)


@pytest.mark.parametrize("ghost", [False, True])
@pytest.mark.parametrize("name", ["press", "geared-five-bar-2-1", "geared-five-bar-3-2"])
def test_wheels_are_turned_as_their_drawing_is(name: str, ghost: bool) -> None:
    scene, surface, drawn = load(name), offscreen(SIZE), offscreen(SIZE)
    look, other = replace(BARE, ghost=ghost), ghost_of(scene)
    painter, brief = Painter(scene, SIZE, look), Painter(scene, SIZE, look, brief=True)
    for phase in (0.3, 1.9, 5.0):
        faint = other.pose(phase) if other else None
        painter.paint(surface, scene.pose(phase), ghost=faint)
        brief.paint(drawn, scene.pose(phase), ghost=faint)
        assert np.abs(pixels(surface) - pixels(drawn)).max() <= 2


def _wheel() -> tuple[Part, ...]:
    """Return a wheel of twelve teeth about O, which turns with A."""
    tooth = 9 * directions(2 * math.pi / 12 * np.array([0.0, 0.5]))
    rim = np.ravel([(tooth * [1.0, 0.6]) * way for way in directions(2 * math.pi / 12 * np.arange(12))])
    return (Part("O", "O", "A", (Layer((200, 30, 60), [rim]),), fold=12),)


def _turned_by(angle: float) -> dict[str, complex]:
    return {"O": 16 + 16j, "A": 16 + 16j + 5 * complex(directions(angle))}


def _alone(still: pygame.Surface) -> Backdrop:
    return Backdrop(still, None, still)


def test_what_was_painted_over_another_backdrop_is_forgotten(patched: list[int]) -> None:
    wheel = turned.Turned((_wheel(),), (32, 32))
    dark, light = offscreen((32, 32)), offscreen((32, 32))
    light.fill((255, 255, 255))
    backdrops = _alone(dark), _alone(light)
    for backdrop in (backdrops[0], backdrops[1], backdrops[1]):
        surface, fresh = backdrop.whole.copy(), backdrop.whole.copy()
        wheel.paint(surface, backdrop, _turned_by(0.2))
        turned.Turned((_wheel(),), (32, 32)).paint(fresh, backdrop, _turned_by(0.2))
        assert _bytes(surface) == _bytes(fresh)
    # twice by the wheel that is tried, and three times by fresh ones
    assert len(patched) == 2 + 3


def test_no_more_is_kept_than_there_is_room_for(monkeypatch: pytest.MonkeyPatch, patched: list[int]) -> None:
    still, wheel = offscreen((32, 32)), turned.Turned((_wheel(),), (32, 32))
    backdrop, sizes = _alone(still), []
    for angle in (0.1, 0.2):
        place = raster.paint_noting(still.copy(), placed(_wheel(), _turned_by(angle)), ends=(32, 32))
        sizes.append(place.nbytes + 4 * place.size)
    monkeypatch.setattr(turned, "_MOST_PICTURES", 2.5 * max(sizes) / still.get_buffer().length)
    # two are kept; the third throws them away
    for angle, painted_so_far in ((0.1, 1), (0.2, 2), (0.1, 2), (0.3, 3), (0.3, 3), (0.1, 4)):
        wheel.paint(still.copy(), backdrop, _turned_by(angle))
        assert len(patched) == painted_so_far


def _on_white(surface: pygame.Surface) -> Pixels:
    below = offscreen(surface.get_size())
    below.fill((255, 255, 255))
    below.blit(surface, (0, 0))
    return pixels(below)


@pytest.mark.parametrize("alpha", [False, True])
def test_a_line_that_stands_in_front_of_wheels_is_seen_before_them_whichever_are_painted_anew(
    alpha: bool,
) -> None:
    behind, line = offscreen((64, 32), alpha=alpha), Layer((20, 90, 240), [np.array([2, 30j, 60 + 29j])], 0.5)
    front, whole = raster.stencil([line], behind), behind.copy()
    mix(raster.pixels_of(whole), front, clear=alpha)
    backdrop = Backdrop(behind, front, whole)
    beside = (replace(_wheel()[0], at="P", tail="P", head="B"),)
    both = turned.Turned((_wheel(), beside), (64, 32))
    for one, other in ((0.1, 0.1), (0.1, 0.2), (0.2, 0.2), (0.3, 0.1), (0.3, 0.1)):
        places = _turned_by(one) | {"P": 44 + 16j, "B": 44 + 16j + _turned_by(other)["A"] - 16 - 16j}
        canvas, fresh, drawn = whole.copy(), whole.copy(), behind.copy()
        both.paint(canvas, backdrop, places)
        turned.Turned((_wheel(), beside), (64, 32)).paint(fresh, backdrop, places)
        assert _bytes(canvas) == _bytes(fresh)
        raster.paint(drawn, [*placed((*_wheel(), *beside), places), line])
        assert np.abs(_on_white(canvas) - _on_white(drawn)).max() <= 2


def test_a_period_of_the_press_finds_all_that_comes_again(patched: list[int]) -> None:
    scene, surface = load("press"), offscreen((640, 360))
    painter = Painter(scene, (640, 360), Look())
    for frame in range(75):
        painter.paint(surface, scene.pose(scene.period * frame / 75))
    # twelve teeth come again after 25 frames, five holes after 15
    assert (patched.count(4), patched.count(2)) == (25, 15)


def _twice_about_one_pivot() -> Scene:
    joints = (
        Pin("O", (0.0, 0.0)),
        Pin("Q", (100.0, 30.0)),
        Pin("R", (-60.0, 30.0)),
        Crank("A", "O", 20.0),
        Crank("D", "Q", 20.0, Gear("A", Fraction(-1), 0.3)),
        Crank("E", "R", 20.0, Gear("A", Fraction(-1), 0.3)),
    )
    return Scene("train", "Train", "", "mm", Linkage(joints, Drive("A", 1.0, 0.2)))


@pytest.mark.parametrize(
    ("scene", "folds"),
    [
        # two wheels that mesh; two pulleys have as many corners instead of teeth
        (geared(Fraction(-1, 3)), [(9, 27), (5, 5)]),
        (geared(Fraction(1, 2)), [(63, 88), (5, 5)]),
        # a planet goes round; of two wheels about one pivot one hides the other's holes
        (planetary(Fraction(-3)), []),
        (_twice_about_one_pivot(), []),
    ],
)
def test_wheels_are_painted_apart_where_none_hides_another_s_holes(
    scene: Scene, folds: list[tuple[int, ...]]
) -> None:
    shown = figure(scene)
    found = turning_apart(shown, wheel_parts(shown, VIEW, GAUGE, LIGHT))
    assert [tuple(part.fold for part in parts) for parts in found] == folds


@pytest.mark.parametrize("fold", [3, 5, 12])
@pytest.mark.parametrize("angle", [0.0, 0.4, 3.0, -2.9])
def test_a_direction_is_folded_to_the_same_one_a_part_of_a_turn_further(fold: int, angle: float) -> None:
    turn = complex(directions(angle))
    found = folded(turn, fold)
    assert abs(found) == pytest.approx(1.0, abs=1e-15)
    assert abs(math.atan2(found.imag, found.real)) <= math.pi / fold + 1e-6
    # the rounding is a ten-millionth of the radius
    assert abs(found**fold - turn**fold) < fold * 1e-7
    for part in range(fold):
        assert folded(turn * complex(directions(2 * math.pi * part / fold)), fold) == found
