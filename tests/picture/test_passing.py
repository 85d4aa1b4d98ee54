"""What lies over the picture for a while is all there: every word of it, where nothing else of it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pygame
import pytest
from pictures import inked, pixels

from linkanim.picture.board import Board
from linkanim.picture.layout import Docked, layout
from linkanim.picture.lists import EditRow, Panel
from linkanim.picture.look import Look
from linkanim.picture.overlay import (
    Button,
    CommandBar,
    DimensionLine,
    Fading,
    Overlay,
)
from linkanim.picture.panels import foot, words_at_foot
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load

SIZE = (640, 360)


@pytest.fixture(scope="module")
def painter() -> Picture:
    return Picture(load("crank-rocker"), SIZE, Look())


def _painted(painter: Picture, overlay: Overlay) -> pygame.Surface:
    surface = offscreen(SIZE)
    SurfacePrinter().paint(surface, painter, painter.scene.pose(1.0), overlay)
    return surface


MEASURED = DimensionLine(("O2", "O4"), 0, 1, "100 mm")


def test_the_bar_that_is_edited_is_lit_and_measured_beside_it(painter: Picture) -> None:
    bare, lit = _painted(painter, Overlay()), _painted(painter, Overlay(measured=(MEASURED,)))
    places = painter.drawing.places(painter.scene.pose(1.0))
    begin, end = places["O2"], places["O4"]
    bar, middle = painter.drawing.setting.gauge.bar, (begin + end) / 2
    changed = np.abs(pixels(bare) - pixels(lit)).max(axis=-1) > 8
    column = changed[:, round(middle.real) - 30]
    assert column[round(middle.imag - 1.3 * bar) : round(middle.imag + 1.3 * bar)].all()
    assert not column[round(middle.imag + 1.8 * bar) :].any()
    assert column[: round(middle.imag - 1.8 * bar)].any()  # the line above it
    assert inked(lit, Rect(middle.real - 15, middle.imag - 60, 30, 60 - 1.8 * bar), LIGHT.ink)


def _between(one: pygame.Surface, other: pygame.Surface) -> Rect:
    """Return the rectangle in which two pictures differ."""
    rows, columns = np.nonzero(np.abs(pixels(one) - pixels(other)).max(axis=-1) > 8)
    assert rows.size
    x, y = int(columns.min()), int(rows.min())
    return Rect(x, y, int(columns.max()) + 1 - x, int(rows.max()) + 1 - y)


SAID = {
    "a toast": Overlay(toast="recordings/crank-rocker-1.gif: 45 %"),
    "an answer": Overlay(chip=Fading("names and dimensions")),
    "a hint": Overlay(hint=Fading("Space pause · Tab next · drag the pin · H keys")),
    "a mark": Overlay(recording="REC GIF 0:03"),
}


# with a chart beside the linkage and below it; the key to the arrows is the lowest row
@pytest.mark.parametrize("size", [(640, 360), (720, 1280)])
@pytest.mark.parametrize(
    "look",
    [Look(vectors=frozenset("v")), Look(chart="H.velocity"), Look(polygons=True, names=1, caption=True)],
)
@pytest.mark.parametrize("case", SAID)
def test_what_is_said_in_passing_stands_in_the_caption_s_slot_alone(
    case: str, look: Look, size: tuple[int, int]
) -> None:
    shown = Picture(load("press"), size, look, docked=Docked(bar=True))
    sheets = [offscreen(size), offscreen(size)]
    for sheet, overlay in zip(sheets, (Overlay(), SAID[case]), strict=True):
        SurfacePrinter().paint(sheet, shown, shown.scene.pose(1.0), overlay)
    slot, place = shown.layout.caption, _between(*sheets)
    assert slot
    assert slot.x <= place.x <= place.right <= slot.right
    assert slot.y - 1 <= place.y <= place.bottom <= slot.bottom + 1
    assert not slot.meets(shown.layout.stage)


def test_of_all_that_could_be_said_the_most_pressing_is(painter: Picture) -> None:
    board = Board(painter.layout, Type(), LIGHT)
    bar = CommandBar((Button("play", "play", "Space"), Button("chart", "chart", "C", lack="no quantity")))
    said = Overlay(hint=Fading("H keys · Tab next"))
    assert words_at_foot(board, said) == ("H keys   ·   Tab next", False)
    said = replace(said, watch=Fading("watch P"))
    assert words_at_foot(board, said) == ("watch P", False)
    said = replace(said, chip=Fading("25 rpm"))
    assert words_at_foot(board, said) == ("25 rpm", True)
    said = replace(said, toast="written")
    assert words_at_foot(board, said) == ("written", True)
    said = replace(said, bar=bar._replace(pointed=0))
    assert words_at_foot(board, said) == ("play   Space", False)
    assert words_at_foot(board, Overlay(bar=bar._replace(pointed=1))) == ("chart   C: no quantity", False)
    assert words_at_foot(board, Overlay(chip=Fading("25 rpm", 0))) is None


def test_hints_that_have_no_room_in_a_line_lose_their_first_parts() -> None:
    board = Board(layout((320, 180), docked=Docked(bar=True)), Type(), LIGHT)
    words = " · ".join(f"key {n} does something" for n in range(9))
    told = words_at_foot(board, Overlay(hint=Fading(words)))
    assert told
    assert words.endswith(told[0].replace("   ·   ", " · "))
    assert "key 8" in told[0]
    assert "key 0" not in told[0]


@pytest.mark.parametrize("count", [1, 16, 40])
def test_words_at_the_foot_are_whole_and_in_the_window(count: int) -> None:
    board = Board(layout((480, 270), docked=Docked(bar=True)), Type(), LIGHT)
    sheet, (x, y) = foot(board, ("a few words " * count, True))
    assert x >= 0
    assert x + sheet.get_width() <= 480
    assert y > 0.6 * 270
    assert round(y) + sheet.get_height() <= 270


def test_the_picture_recedes_behind_the_help(painter: Picture) -> None:
    told = Overlay(help=(("look", (("H", "help"),)),))
    hud = painter.layout.hud
    assert hud
    title = hud._replace(height=24)
    assert inked(_painted(painter, Overlay()), title, LIGHT.ink)
    assert not inked(_painted(painter, told), title, LIGHT.ink)


def test_help_stands_beside_the_values_that_it_explains() -> None:
    scene, size = load("crank-rocker"), (1280, 720)
    painter, surface = Picture(scene, size, Look(), docked=Docked(listed=1)), offscreen(size)
    edited = Overlay(listed=Panel((EditRow("Crank 2", "55 mm", chosen=True),), hint="Esc closes"))
    SurfacePrinter().paint(surface, painter, scene.pose(1.0), edited)
    plain = pixels(surface)
    lines = tuple((f"key {n}", "what it does, in a few words") for n in range(9))
    helped = replace(edited, help=(("edit", lines),))
    SurfacePrinter().paint(surface, painter, scene.pose(1.0), helped)
    rows, columns = np.nonzero((plain == LIGHT.chosen).all(axis=-1))
    within = np.s_[rows.min() : rows.max(), columns.min() : columns.max()]
    assert np.array_equal(pixels(surface)[within], plain[within])
    assert not np.array_equal(pixels(surface)[:, 640:], plain[:, 640:])


def _list(rows: Sequence[EditRow], facts: tuple[str, ...] = ("Grashof",), hint: str = "Esc closes") -> Panel:
    return Panel(tuple(rows), facts=facts, hint=hint)


def test_every_line_of_the_edit_list_has_a_place_of_its_own() -> None:
    board = Board(layout(SIZE, docked=Docked(listed=1)), Type(), LIGHT)
    rows = [
        EditRow("Crank 2", "40 mm", chosen=True),
        EditRow("Coupler 3", "90 mm"),
        EditRow("Rocker 4", "80 mm"),
    ]
    whole = _list(rows).drawn(board).sheet
    others = [
        _list(rows, facts=("Grxxhof",)),
        *(_list([*rows[:n], replace(rows[n], value="77 mm"), *rows[n + 1 :]]) for n in range(3)),
        _list(rows, hint="Esc clxxes"),
    ]
    bands = [_between(whole, other.drawn(board).sheet) for other in others]
    for above, below in pairwise(bands):
        assert above.bottom <= below.y
    assert all(0 < band.y < band.bottom < whole.get_height() for band in bands)


def test_a_bar_lies_behind_all_of_the_chosen_row() -> None:
    board = Board(layout(SIZE, docked=Docked(listed=1)), Type(), LIGHT)
    rows = [EditRow("Crank 2", "40 mm", chosen=True), EditRow("Coupler 3", "90 mm")]
    one = _list(rows).drawn(board).sheet
    words = _between(one, _list([replace(rows[0], value="77 mm"), rows[1]]).drawn(board).sheet)
    bar = np.abs(pixels(one) - LIGHT.chosen).max(axis=-1) < 3
    lines, columns = np.nonzero(bar)
    assert lines.min() < words.y
    assert lines.max() >= words.bottom
    assert np.ptp(columns) > 0.8 * one.get_width()
    assert np.ptp(columns) < one.get_width() - 10


def test_the_first_words_that_have_room_are_taken() -> None:
    board = Board(layout(SIZE), Type(), LIGHT)
    words = ["a long name of a quantity", "a name", "n"]
    widths = [board.type.width(text, 14) for text in words]
    assert [board.fitting(words, 14, width) for width in widths] == words
    assert board.fitting(words, 14, widths[0] - 1) == "a name"
