"""What is said on a picture stands near what it means, over nothing that matters, and all of it is seen.

The rules themselves are in `tests/measure/stage.py`, which reads finished pictures alone.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pygame
import pytest
from pictures import BARE, pixels, stated, with_panels
from stage import SIZES, STILLS, Fault, looks, of_moving, of_still, still_look

from linkanim.picture import labelled
from linkanim.picture.frame_words import lines_of
from linkanim.picture.layout import Docked
from linkanim.picture.lists import EditRow, Panel
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.scenes import load, names
from linkanim.scenes.editing import ghost_of

BACKGROUND = theme_of("light").background
LOOKS = ("names", "dimensions", "vectors", "centres", "polygons")


def counted(faults: list[Fault]) -> dict[str, int]:
    """Return faults in words, each with how often it is there."""
    return Counter(f"{fault.rule}: {fault.what}" for fault in faults)


# the quick run has every scene of the sample in every look, each time at another size
@pytest.mark.parametrize(
    ("name", "look", "size"),
    [
        (name, look, SIZES[(k + n) % len(SIZES)])
        for n, name in enumerate(names())
        for k, look in enumerate(LOOKS)
    ],
)
@pytest.mark.sampled
@pytest.mark.thinned(3)
def test_a_moving_picture_breaks_no_rule(name: str, look: str, size: tuple[int, int]) -> None:
    scene = load(name)
    assert not counted([*of_moving(scene, size, looks(scene)[look])])


@pytest.mark.parametrize(
    ("name", "look", "purpose"),
    [
        (name, look, [*STILLS][(k + n) % len(STILLS)])
        for n, name in enumerate(names())
        for k, look in enumerate(LOOKS)
    ],
)
@pytest.mark.sampled
def test_a_still_breaks_no_rule(name: str, look: str, purpose: str) -> None:
    scene, (size, scale) = load(name), STILLS[purpose]
    assert not counted([*of_still(scene, size, still_look(looks(scene)[look], scale))])


@pytest.mark.long
@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("name", names())
def test_at_no_size_is_one_broken(name: str, look: str) -> None:
    scene = load(name)
    shown = looks(scene)[look]
    found = {size: counted([*of_moving(scene, size, shown)]) for size in SIZES}
    stills = {
        purpose: counted([*of_still(scene, size, still_look(shown, scale))])
        for purpose, (size, scale) in STILLS.items()
    }
    assert not any(found.values()), found
    assert not any(stills.values()), stills


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_label_moves_by_more_than_what_it_names(name: str) -> None:
    """From frame to frame: it goes along with its joint, or its bar, and a pixel more."""
    scene = load(name)
    picture, steps = Picture(scene, (640, 360), Look(names=2)), round(120 * scene.period / (2 * np.pi))
    poses = [scene.pose(scene.period * step / steps, 0) for step in range(steps + 1)]
    moved = dict[str, float]()
    places = [picture.drawing.places(pose) for pose in poses]
    setting = picture.drawing.setting
    frames = [{one.of: complex(*one.at) for one in picture.names.captions(at, setting)} for at in places]
    assert len({frozenset(frame) for frame in frames}) == 1
    for label in picture.names.labels:
        assert label.anchor
        for (before, after), (here, there) in zip(pairwise(places), pairwise(frames), strict=True):
            ends = [abs(after[joint] - before[joint]) for joint in label.anchor[:2]]
            # what turns with a bar is off it by no more than a bar is long, or its own length
            spare = abs(there[label.of] - here[label.of]) - 2.5 * max(ends) - 1.0
            moved[label.of] = max(moved.get(label.of, -1.0), spare)
    assert max(moved.values(), default=0.0) <= 0, moved


def test_what_is_said_on_a_frame_can_be_asked_for() -> None:
    scene, size = load("crank-rocker"), (640, 360)
    rows = labelled(scene, 1.0, Look(names=1, vectors=frozenset("v"), chart="rocker.angle"), size)
    of = Counter(row.of.partition(":")[0] for row in rows)
    assert of["joint"] == 5
    assert of["body"] == 3
    assert {"vector", "readout", "legend", "axis"} <= of.keys()
    picture = Picture(scene, size, Look(names=1))
    places = picture.drawing.places(scene.pose(1.0))
    for row in labelled(scene, 1.0, Look(names=1), size):
        assert row.opacity == 1.0
        if row.of.startswith("joint:"):
            assert complex(*row.anchor) == pytest.approx(places[row.of.removeprefix("joint:")])


# Everything that is drawn, not only what has a name.


def _painted(picture: Picture, phase: float) -> np.ndarray:
    surface = offscreen(picture.size)
    SurfacePrinter().paint(surface, picture, picture.scene.pose(phase))
    return pixels(surface)


def _part(image: np.ndarray, rect: Rect) -> np.ndarray:
    return image[round(rect.y) : round(rect.bottom), round(rect.x) : round(rect.right)]


@pytest.mark.parametrize(
    ("name", "size"), [(name, [(480, 270), (320, 180)][k % 2]) for k, name in enumerate(names())]
)
@pytest.mark.sampled
def test_nothing_that_ever_moves_lies_under_the_words_or_leaves_the_picture(
    name: str, size: tuple[int, int]
) -> None:
    scene = load(name)
    picture = Picture(scene, size, Look(names=1, vectors=frozenset("v")))
    slots = [slot for slot in (picture.layout.hud, picture.layout.legend) if slot]
    picture._hud, picture._legend = None, None
    edge = np.ones((size[1], size[0]), bool)
    edge[2:-2, 2:-2] = False
    for phase in np.linspace(0.0, scene.period, 8, endpoint=False).tolist():
        image = _painted(picture, phase)
        assert (image[edge] == BACKGROUND).all(), phase
        assert all((_part(image, slot) == BACKGROUND).all() for slot in slots), phase


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_still_is_cropped_to_what_it_draws(name: str) -> None:
    """One margin on the two sides that bind, whatever it shows, and the middle between the others."""
    scene, size = load(name), (992, 744)
    phase = looks_best(name)
    picture = Picture(scene, size, Look(names=1, hud=False, type_scale=1.84), moment=phase)
    rows, columns = np.nonzero((_painted(picture, phase) != BACKGROUND).any(axis=-1))
    gaps = [columns.min(), size[0] - 1 - columns.max(), rows.min(), size[1] - 1 - rows.max()]
    margin = 0.04 * min(size)
    across, along = (gaps[0] + gaps[1]) / 2, (gaps[2] + gaps[3]) / 2
    # letters and gaps about them are less high than their lines
    assert margin - 2 <= min(across, along) <= margin + 0.5 * picture.layout.label_size, gaps
    assert min(gaps) >= margin - 2, gaps


def looks_best(name: str) -> float:
    """Return the phase of a scene's still."""
    from linkanim.picture.stills import still_phase

    return still_phase(load(name))


# How slots and linkage share a window.


def test_a_tall_scene_has_its_chart_beside_it_and_a_wide_one_below() -> None:
    for name, beside in (("press", True), ("slider-crank", False)):
        scene = load(name)
        parts = Picture(scene, (1280, 720), Look(chart=scene.telling[0])).layout
        assert parts.chart is not None
        assert (parts.chart.x >= parts.stage.right) == beside
        assert (parts.chart.y >= parts.stage.bottom) != beside


@pytest.mark.parametrize("size", [(1280, 720), (720, 1280), (640, 360)])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_title_is_whole_and_the_same_size_in_every_scene(name: str, size: tuple[int, int]) -> None:
    scene = load(name)
    picture = Picture(scene, size, Look())
    block, parts = picture.composition.block, picture.layout
    assert " ".join(block.title) == scene.title
    assert block.title_size == parts.title_size
    assert block.size == parts.text_size
    assert any(label.endswith(("angle", "travel")) for label in block.rows)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_with_its_other_closure_a_scene_stays_where_it_is_when_they_change_places(name: str) -> None:
    scene = load(name)
    other = ghost_of(scene)
    if other is None:
        return
    one, two = (Picture(shown, (480, 270), Look(ghost=True)) for shown in (scene, other))
    views = [(picture.view.scale, picture.view.x, picture.view.y) for picture in (one, two)]
    assert views[0] == pytest.approx(views[1], abs=1e-6)


@pytest.mark.parametrize(("name", "look"), [("press", Look(chart="C.velocity")), ("press", Look(names=1))])
def test_a_linkage_that_is_zoomed_reaches_neither_into_charts_nor_under_words(name: str, look: Look) -> None:
    scene, size = load(name), (640, 360)
    whole, near = (Picture(scene, size, replace(look, zoom=zoom)) for zoom in (1.0, 6.0))
    slots = [slot for slot in (whole.layout.hud, whole.layout.chart) if slot]
    assert slots
    images = [_painted(picture, 1.0) for picture in (whole, near)]
    assert (images[0] != images[1]).any()
    for slot in slots:
        assert np.array_equal(_part(images[0], slot), _part(images[1], slot))


@pytest.mark.parametrize("size", [(320, 180), (360, 640), (480, 270), (640, 480), (720, 1280), (1920, 1080)])
@pytest.mark.parametrize("name", ["press", "crank-rocker"])
def test_a_list_covers_no_more_than_half_of_any_window_and_none_of_the_linkage(
    name: str, size: tuple[int, int]
) -> None:
    picture = Picture(load(name), size, Look(), docked=Docked(listed=1))
    lists, parts = picture.layout.lists, picture.layout
    assert lists.width * lists.height <= 0.51 * size[0] * size[1]
    assert not lists.meets(parts.stage)
    rows = tuple(EditRow(f"Point {n} of its bar, to the left", "123.45 mm", n == 3) for n in range(30))
    hint = "↑ ↓ choose   ← → nudge   type, Tab next   Enter takes   Ctrl+Z undo   Ctrl+S save   Esc closes"
    bare, told = with_panels(picture, 1.0), with_panels(picture, 1.0, stated(Panel(rows, hint=hint)))
    assert _changed(bare, told)[1].max() <= lists.right + 1
    assert _changed(bare, told)[0].min() >= lists.y - 1


def _changed(one: pygame.Surface, other: pygame.Surface) -> tuple[np.ndarray, ...]:
    """Return the rows and columns of the pixels in which two pictures differ."""
    return np.nonzero((pixels(one) != pixels(other)).any(axis=-1))


# What is said is as settled as the picture: keys that do not concern it leave it where it is.


@pytest.mark.parametrize("change", [{"theme": "dark"}, {"trace": False}, {"zoom": 2.0, "pan": (0.1, 0.2)}])
def test_a_theme_and_a_zoom_keep_the_composition_and_so_do_curves_in_motion(
    change: dict[str, object],
) -> None:
    scene, look = load("press"), Look(names=1)
    first = Picture(scene, (640, 360), look)
    other = Picture(scene, (640, 360), replace(look, **change))  # type: ignore[arg-type]
    assert other.names is first.names


def test_bare_pictures_say_nothing() -> None:
    scene = load("press")
    assert lines_of(Picture(scene, (640, 360), BARE), 1.0) == []
