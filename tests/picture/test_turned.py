"""What turns and looks the same again is laid down as it was painted, and is the picture it would be."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pygame
import pytest
from pictures import BARE, painted, pixels
from test_moving_parts import GAUGE, VIEW, geared, planetary

from linkanim.mechanics.kinds import Crank, Gear, Pin
from linkanim.mechanics.linkage import Drive, Linkage
from linkanim.picture import raster, turned
from linkanim.picture.directions import directions, folded
from linkanim.picture.figure import figure
from linkanim.picture.gears import turning_apart, wheel_parts
from linkanim.picture.look import Look
from linkanim.picture.offscreen import offscreen
from linkanim.picture.painter import Painter
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load
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
    patch = raster.patch

    def counted(*args: object, **options: object) -> object:
        counts.append(len(args[1]))  # type: ignore[arg-type]
        return patch(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(turned, "patch", counted)
    return counts


def test_teeth_are_painted_once_for_a_pitch_and_the_picture_is_the_one_they_would_be(
    patched: list[int],
) -> None:
    scene, surface = load("press"), offscreen(SIZE)
    painter = Painter(scene, SIZE, LOOK)
    for phase in (0.1, 0.2, 0.1 + PITCH, 0.2 + 5 * PITCH, 0.1 - 24 * PITCH):
        painter.paint(surface, scene.pose(phase))
        assert _bytes(surface) == _bytes(painted(scene, phase, LOOK, SIZE))
    # two pictures of rims, and four of holes, which only whole turns bring back; and those of the fresh ones
    assert (patched.count(4), patched.count(2)) == (2 + 5, 4 + 5)


@pytest.mark.parametrize("name", ["press", "geared-five-bar-2-1", "geared-five-bar-3-2"])
def test_wheels_are_turned_as_their_drawing_is(name: str) -> None:
    scene, surface, drawn = load(name), offscreen(SIZE), offscreen(SIZE)
    painter, brief = Painter(scene, SIZE, BARE), Painter(scene, SIZE, BARE, brief=True)
    for phase in (0.3, 1.9, 5.0):
        painter.paint(surface, scene.pose(phase))
        brief.paint(drawn, scene.pose(phase))
        assert np.abs(pixels(surface) - pixels(drawn)).max() <= 2


@pytest.mark.parametrize("speeds", [(2.0, 4.0, 2.0), (2.0, -2.0)])
def test_what_was_painted_over_another_chart_is_forgotten(speeds: tuple[float, ...]) -> None:
    scene, surface = load("press"), offscreen(SIZE)
    painter = Painter(scene, SIZE, LOOK)
    for speed in speeds:
        painter.paint(surface, scene.pose(0.1, speed=speed))
        fresh = offscreen(SIZE)
        Painter(scene, SIZE, LOOK).paint(fresh, scene.pose(0.1, speed=speed))
        assert _bytes(surface) == _bytes(fresh)


def test_no_more_is_kept_than_there_is_room_for(monkeypatch: pytest.MonkeyPatch, patched: list[int]) -> None:
    monkeypatch.setattr(turned, "_MOST_PICTURES", 1e-6)
    scene, surface = load("press"), offscreen(SIZE)
    painter = Painter(scene, SIZE, LOOK)
    for phase in (0.1, 0.2, 0.1):
        painter.paint(surface, scene.pose(phase))
    assert patched == [4, 2] * 3
    assert _bytes(surface) == _bytes(painted(scene, 0.1, LOOK, SIZE))


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
