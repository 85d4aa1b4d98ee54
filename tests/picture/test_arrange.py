"""The scene takes the room, and the words what its motion leaves of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pygame
import pytest
from pictures import pixels

from linkanim.picture.arrangement import FitRequest, Sweep, arranged, fitted
from linkanim.picture.layout import Docked, layout
from linkanim.picture.look import Look
from linkanim.picture.overlay import EditRow, Fading, Overlay, Panel
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.scenes import load, names
from linkanim.scenes.editing import beyond_title, ghost_of

FORMATS = ((1280, 720), (1024, 768), (720, 1280), (320, 180))
BACKGROUND = theme_of("light").background


@cache
def type_of_words() -> Type:
    return Type()


# every scene with a chart and without, each time in another format, so that all are met by many
@pytest.mark.parametrize(
    ("name", "chart", "size"),
    [
        (name, chart, FORMATS[(k + 2 * chart) % len(FORMATS)])
        for k, name in enumerate(names())
        for chart in (False, True)
    ],
)
@pytest.mark.sampled
def test_what_a_scene_sweeps_fills_the_height_or_the_width(
    name: str, chart: bool, size: tuple[int, int]
) -> None:
    """At least 85 % of the one or 70 % of the other, of what a chart leaves; with the other closure, too.

    In a tiny window it is four fifths of that, where words would have no row else.
    """
    scene, least = load(name), 0.8 if min(size) < 200 else 1.0
    for other in (None, ghost_of(scene)):
        staging = fitted(scene, other, FitRequest(size, chart, 0, True), type_of_words())
        arrangement, box = staging.arrangement, staging.subject.sweep.box
        left, low = arrangement.view.to_pixel(box.left, box.low)
        right, high = arrangement.view.to_pixel(box.right, box.high)
        stage = arrangement.layout.stage
        assert low - high >= 0.85 * least * stage.height or right - left >= 0.7 * least * stage.width
        assert stage.x <= left < right <= stage.right
        assert stage.y <= high < low <= stage.bottom


def _moments(name: str, count: int) -> Iterator[float]:
    yield from np.linspace(0.0, load(name).period, count, endpoint=False)


@pytest.mark.thinned(3)
@pytest.mark.parametrize(
    ("name", "size"), [(name, [(480, 270), (320, 180)][k % 2]) for k, name in enumerate(names())]
)
@pytest.mark.sampled
def test_words_lie_on_nothing_that_ever_moves_there(name: str, size: tuple[int, int]) -> None:
    scene, look = load(name), Look(chart=None)
    painter, surface = Picture(scene, size, look), offscreen(size)
    words = painter.layout.words
    assert words
    painter._hud = None
    for phase in _moments(name, 8):
        SurfacePrinter().paint(surface, painter, scene.pose(float(phase)))
        for rect in words:
            assert (_part(surface, rect) == BACKGROUND).all(), phase


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_all_that_is_drawn_lies_in_the_window(name: str) -> None:
    scene, size = load(name), (480, 270)
    painter, surface = Picture(scene, size, Look(hud=False, names=1)), offscreen(size)
    edge = np.ones((size[1], size[0]), bool)
    edge[2:-2, 2:-2] = False
    for phase in _moments(name, 8):
        SurfacePrinter().paint(surface, painter, scene.pose(float(phase)))
        assert (pixels(surface)[edge] == BACKGROUND).all(), phase


def _part(surface: pygame.Surface, rect: Rect) -> np.ndarray:
    left, top = round(rect.x), round(rect.y)
    return pixels(surface)[top : round(rect.bottom), left : round(rect.right)]


@pytest.mark.parametrize("size", [(320, 180), (1280, 720), (720, 1280)])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_title_is_whole_and_all_words_can_be_read(name: str, size: tuple[int, int]) -> None:
    scene = load(name)
    block = fitted(scene, None, FitRequest(size, False, 0, True), type_of_words()).arrangement.block
    assert block is not None
    assert " ".join(line.text for line in block.lines if line.strong) == scene.title
    assert block.size >= max(10, 0.7 * min(21 * size[1] / 720, 21))
    assert any(label.endswith(("angle", "travel")) for label in block.rows)


@pytest.mark.parametrize("name", ["press", "six-bar", "rocker-driven"])
def test_a_title_is_in_one_line_where_it_finds_room(name: str) -> None:
    arrangement = fitted(load(name), None, FitRequest((1280, 720), False, 0, True), Type()).arrangement
    assert arrangement.block is not None
    assert arrangement.block.turns == 0


@pytest.mark.parametrize("size", [(480, 270)])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_other_closure_keeps_the_view_and_the_place_of_the_words(
    name: str, size: tuple[int, int]
) -> None:
    scene = load(name)
    other = ghost_of(scene)
    if other is None:
        return
    wanted = FitRequest(size, False, 0, True)
    one = fitted(scene, other, wanted, type_of_words()).arrangement
    two = fitted(other, ghost_of(other), wanted, type_of_words()).arrangement
    views = [(view.scale, view.x, view.y) for view in (one.view, two.view)]
    assert views[0] == pytest.approx(views[1], abs=1e-6)
    assert one.layout.hud is not None
    assert two.layout.hud is not None
    # A title that says the class goes with the closure, and with it the width.
    same = slice(None) if scene.title == other.title else slice(2)
    assert one.layout.hud[same] == pytest.approx(two.layout.hud[same], abs=1e-6)


def test_a_tall_scene_has_its_chart_beside_it_and_a_wide_one_below() -> None:
    for name, beside in (("press", True), ("slider-crank", False)):
        wanted = FitRequest((1280, 720), True, 0, True)
        parts = fitted(load(name), None, wanted, type_of_words()).arrangement.layout
        assert parts.chart is not None
        assert (parts.chart.x >= parts.stage.right) == beside
        assert (parts.chart.y >= parts.stage.bottom) != beside


def test_a_scene_that_is_zoomed_does_not_reach_into_a_chart_beside_it() -> None:
    scene = load("press")
    look, size = Look(chart="C.velocity"), (640, 360)
    fitted, near = (Picture(scene, size, replace(look, zoom=zoom)) for zoom in (1.0, 6.0))
    reach = fitted.layout.reach
    drawn = [offscreen(size), offscreen(size)]
    for painter, surface in zip((fitted, near), drawn, strict=True):
        SurfacePrinter().paint(surface, painter, scene.pose(1.0))
    left = round(reach.right)
    one, other = (pixels(surface)[:, left:] for surface in drawn)
    assert np.array_equal(one, other)


def test_words_over_a_zoomed_scene_have_a_backing() -> None:
    scene, size = load("geared-five-bar-2-1"), (640, 360)
    near = Picture(scene, size, Look(zoom=6.0))
    words, pivot = near.layout.words[-1], near.view.to_pixel(0.0, 0.0)
    pan = ((words.x + words.width / 2 - pivot[0]) / 360, (words.y + words.height / 2 - pivot[1]) / 360)
    painter, surface = Picture(scene, size, Look(zoom=6.0, pan=pan)), offscreen(size)
    SurfacePrinter().paint(surface, painter, scene.pose(1.0))
    told = _part(surface, words)
    painter._hud = None
    SurfacePrinter().paint(surface, painter, scene.pose(1.0))
    bare = _part(surface, words)
    covered = np.abs(bare - BACKGROUND).max(axis=-1) > 20
    assert covered.mean() > 0.5
    light = np.abs(told - BACKGROUND).max(axis=-1) < 12
    assert light.mean() > 0.6


PASSING = Overlay(
    paused=True,
    recording="REC GIF 0:03",
    chip=Fading("names and dimensions"),
    hint=Fading("Space pause · Tab next · drag the pin · H keys"),
    toast="recordings/crank-rocker-1.gif: 45 %",
)


# A chart beside the scene, or one below, leaves it little room; the key to the arrows is the lowest row.
@pytest.mark.thinned(5)
@pytest.mark.parametrize("size", [(640, 360), (720, 1280)])
@pytest.mark.parametrize(
    ("name", "chart"), [("press", None), ("press", "H.velocity"), ("watt-1", "E.velocity")]
)
@pytest.mark.parametrize("framed", [{}, {"zoom": 1.25}])
def test_nothing_that_comes_and_goes_erases_a_word_about_the_scene(
    name: str, chart: str | None, size: tuple[int, int], framed: dict[str, Any]
) -> None:
    scene, look = load(name), Look(vectors=frozenset("v"), chart=chart)
    bare, shown = replace(look, pan=(30.0, 0.0)), replace(look, **framed)
    words, over = (offscreen(size), offscreen(size))
    painter = Picture(scene, size, bare)
    SurfacePrinter().print(words, painter, 0.5, 4.0, Overlay())
    SurfacePrinter().print(over, Picture(scene, size, shown), 0.5, 4.0, PASSING)
    for place in (painter.layout.hud, painter.layout.legend):
        assert place is not None
        before, after = (_part(surface, place).sum(axis=-1, dtype=int) for surface in (words, over))
        ink = before < 450
        assert ink.sum() > 100
        assert (ink & (np.abs(after - before) > 150)).sum() <= 10


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_view_makes_room_for_the_edit_list(name: str) -> None:
    staging = fitted(
        load(name), None, FitRequest((1280, 720), False, 0, True, Docked(listed=1)), type_of_words()
    )
    box, layout = staging.subject.sweep.box, staging.arrangement.layout
    assert staging.arrangement.view.to_pixel(box.left, 0.0)[0] > layout.lists.right


@pytest.mark.parametrize("size", [(320, 180), (360, 640), (480, 270), (640, 480), (720, 1280), (1920, 1080)])
@pytest.mark.parametrize("name", ["press", "crank-rocker"])
def test_a_list_covers_no_more_than_half_of_any_window_and_none_of_the_scene(
    name: str, size: tuple[int, int]
) -> None:
    staging = fitted(load(name), None, FitRequest(size, False, 0, True, Docked(listed=1)), type_of_words())
    box, parts, view = staging.subject.sweep.box, staging.arrangement.layout, staging.arrangement.view
    lists, (left, top) = parts.lists, view.to_pixel(box.left, box.high)
    right, bottom = view.to_pixel(box.right, box.low)
    assert lists.width * lists.height <= 0.51 * size[0] * size[1]
    assert not lists.meets(Rect(left, top, right - left, bottom - top))
    painter, scene = Picture(load(name), size, Look(), docked=Docked(listed=1)), load(name)
    bare, told = offscreen(size), offscreen(size)
    rows = tuple(EditRow(f"Point {n} of its bar, to the left", "123.45 mm", n == 3) for n in range(30))
    for surface, over in ((bare, Overlay()), (told, Overlay(panel=Panel(rows, hint=HINT)))):
        SurfacePrinter().paint(surface, painter, scene.pose(1.0), over)
    changed = np.nonzero((pixels(bare) != pixels(told)).any(axis=-1))
    assert changed[1].max() <= lists.right + 1
    assert changed[0].min() >= lists.y - 1


HINT = "↑ ↓ choose   ← → nudge   type, Tab next   Enter takes   Ctrl+Z undo   Ctrl+S save   Esc closes"
EDITED = Overlay(panel=Panel((EditRow("Crank 2", "55 mm", chosen=True),), hint="Esc closes"))


def test_help_stands_beside_the_values_that_it_explains() -> None:
    scene, size = load("crank-rocker"), (1280, 720)
    painter, surface = Picture(scene, size, Look(), docked=Docked(listed=1)), offscreen(size)
    SurfacePrinter().paint(surface, painter, scene.pose(1.0), EDITED)
    plain = pixels(surface)
    lines = tuple((f"key {n}", "what it does, in a few words") for n in range(9))
    helped = replace(EDITED, help=(("edit", lines),))
    SurfacePrinter().paint(surface, painter, scene.pose(1.0), helped)
    panel = (plain == theme_of("light").chosen).all(axis=-1)
    rows, columns = np.nonzero(panel)
    within = np.s_[rows.min() : rows.max(), columns.min() : columns.max()]
    assert np.array_equal(pixels(surface)[within], plain[within])
    assert not np.array_equal(pixels(surface)[:, 640:], plain[:, 640:])


@pytest.mark.parametrize("name", ["press", "crank-rocker"])
def test_a_toast_does_not_lie_on_the_chart(name: str) -> None:
    scene, size = load(name), (1280, 720)
    chart = next(token for token in scene.quantities if token.endswith("acceleration"))
    painter, surface = Picture(scene, size, Look(chart=chart)), offscreen(size)
    SurfacePrinter().paint(surface, painter, scene.pose(1.0))
    plain = pixels(surface)
    SurfacePrinter().paint(
        surface, painter, scene.pose(1.0), Overlay(toast="recordings/a-file-of-mine.gif is written")
    )
    changed = np.any(pixels(surface) != plain, axis=-1)
    rows, columns = np.nonzero(changed)
    stage = painter.layout.stage
    assert rows.size
    assert stage.x <= columns.min() <= columns.max() < stage.right
    assert stage.y <= rows.min() <= rows.max() < stage.bottom


@pytest.mark.parametrize("size", [(640, 360)])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_marks_stand_where_no_words_are(name: str, size: tuple[int, int]) -> None:
    layout = fitted(load(name), None, FitRequest(size, False, 0, True), type_of_words()).arrangement.layout
    assert not any(layout.marks.meets(rect) for rect in layout.words)


@pytest.mark.parametrize(
    ("title", "class_name", "rest"),
    [
        # the title says it all, in the same words or in others
        ("Grashof double-rocker", "Grashof double-rocker", ""),
        ("Triple-rocker, inward-outward", "triple-rocker (inward/outward)", ""),
        ("Parallelogram", "parallelogram", ""),
        # it says a part
        ("Crank-rocker", "Grashof crank-rocker", "Grashof"),
        ("Kite", "kite (change point)", "change point"),
        ("Drag link", "Grashof drag-link (double crank)", "Grashof (double crank)"),
        ("Six-bar: two in series", "six-bar: crank-rocker, then kite", "crank-rocker, then kite"),
        # nothing, or half a word
        ("My machine", "Grashof crank-rocker", "Grashof crank-rocker"),
        ("A rocker of mine", "Grashof crank-rocker", "Grashof crank-rocker"),
        # what is left would be no phrase
        (
            "Oscillating cylinder",
            "inverted slider-crank, swinging cylinder",
            "inverted slider-crank, swinging cylinder",
        ),
        (
            "Press pushed by a slider",
            "six-bar linkage driven by a slider",
            "six-bar linkage driven by a slider",
        ),
    ],
)
def test_class_and_title_do_not_repeat_each_other(title: str, class_name: str, rest: str) -> None:
    assert beyond_title(title, class_name) == rest


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_chart_does_not_drive_out_the_words(name: str) -> None:
    wanted = FitRequest((480, 270), True, 2, True)
    block = fitted(load(name), None, wanted, type_of_words()).arrangement.block
    assert block is not None
    assert block.rows


@pytest.mark.parametrize(
    ("points", "scale"),
    [
        # a single point has no scale of its own
        ([3 + 4j], 1.0),
        # a level line fills the width beside what is drawn about its ends, an upright one the height
        ([0j, 100 + 0j], (1280 - 2 * 9 - 2 * 12.2) / 100),
        ([0j, 100j], (720 - 2 * 9 - 2 * 12.2) / 100),
    ],
)
def test_what_has_no_extent_is_still_in_the_middle(points: list[complex], scale: float) -> None:
    none = np.zeros(0, complex)
    sweep = Sweep(np.array(points), none, none)
    arrangement = arranged(layout((1280, 720)), sweep, 50.0, ())
    assert arrangement.view.scale == pytest.approx(scale)
    middle = sum(points) / len(points)
    assert arrangement.view.to_pixel(middle.real, middle.imag) == pytest.approx((640, 360))


@pytest.mark.thinned(3)
@pytest.mark.parametrize("size", [(320, 180), (640, 360), (720, 1280)])
@pytest.mark.parametrize("name", ["press", "dwell-six-bar", "double-rocker"])
def test_the_strip_lies_on_nothing_that_moves_or_is_said(name: str, size: tuple[int, int]) -> None:
    scene, look = load(name), Look()
    painter, surface = Picture(scene, size, look), offscreen(size)
    place = painter.layout.hint
    assert place is not None
    assert place.x >= 0
    assert place.right <= size[0]
    for phase in _moments(name, 6):
        SurfacePrinter().paint(surface, painter, scene.pose(float(phase)))
        part = _part(surface, place)
        assert (part == BACKGROUND).all(), phase
    widest = fitted(scene, None, FitRequest((1280, 720), False, 0, True), type_of_words()).arrangement
    assert widest.layout.hint is not None
    assert widest.layout.hint.width >= 11 * widest.layout.small_size
