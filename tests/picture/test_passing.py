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
from linkanim.picture.command_bar import bar_place
from linkanim.picture.layout import Docked, chip_places, layout
from linkanim.picture.look import Look
from linkanim.picture.overlay import (
    NOTHING_OVER,
    Button,
    CommandBar,
    DimensionLine,
    EditRow,
    Fading,
    Overlay,
    Panel,
)
from linkanim.picture.panels import edit_list
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load

SIZE = (640, 360)
WORDS = "40 rpm"


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


def _saying(kind: str, words: Fading) -> Overlay:
    return Overlay(chip=words) if kind == "chip" else Overlay(hint=words)


@pytest.mark.parametrize("kind", ["chip", "strip"])
def test_a_chip_and_the_strip_hold_their_words_and_fade(painter: Picture, kind: str) -> None:
    bare = _painted(painter, Overlay())
    there = _painted(painter, _saying(kind, Fading(WORDS)))
    size = painter.layout.text_size if kind == "chip" else painter.layout.small_size
    ink = LIGHT.ink if kind == "chip" else LIGHT.dim
    sheet = _between(bare, there)
    wide = Type().width(WORDS, size, strong=kind == "chip")
    assert wide + 0.8 * size < sheet.width < wide + 3 * size
    assert sheet.height > 1.4 * size
    middle = sheet.inset(0.3 * size)
    assert inked(there, middle, ink)
    going = _painted(painter, _saying(kind, Fading(WORDS, 2)))
    assert not inked(going, middle, ink)


@pytest.mark.parametrize("look", [Look(polygons=True), Look(chart="j.angle")], ids=["polygons", "chart"])
@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (500, 720)], ids=str)
def test_a_chip_lies_on_no_words_of_a_chart_or_a_polygon(size: tuple[int, int], look: Look) -> None:
    shown, printer = Picture(load("jansen"), size, look), SurfacePrinter()
    sheets = []
    for chip in (None, Fading("polygons")):
        sheets.append(offscreen(size))
        printer.paint(sheets[-1], shown, shown.scene.pose(1.0), Overlay(chip=chip))
    beside = shown.layout.polygons or shown.layout.chart
    assert beside
    assert not _between(*sheets).meets(beside)


def chip_of(shown: Picture, words: str, overlay: Overlay = NOTHING_OVER) -> Rect:
    """Return where a chip with these words lies on a picture."""
    sheets = [offscreen(shown.size), offscreen(shown.size)]
    for sheet, chip in zip(sheets, (None, Fading(words)), strict=True):
        over = replace(overlay, chip=chip)
        SurfacePrinter().paint(sheet, shown, shown.scene.pose(1.0), over)
    return _between(*sheets)


def is_bare(shown: Picture, place: Rect) -> bool:
    """Return whether nothing is drawn in a place of a picture, all through a cycle."""
    columns, rows = slice(int(place.x), int(place.right)), slice(int(place.y), int(place.bottom))
    for n in range(40):
        surface = offscreen(shown.size)
        SurfacePrinter().paint(surface, shown, shown.scene.pose(shown.scene.period * n / 40))
        if (pixels(surface)[rows, columns] != LIGHT.background).any():
            return False
    return True


@pytest.mark.parametrize(
    ("name", "size", "look", "words"),
    [
        ("crank-rocker", (320, 180), Look(), "25 rpm"),
        ("crank-rocker", (320, 180), Look(chart="rocker.angle"), "Rocker: angle"),
        ("crank-rocker", (320, 180), Look(polygons=True), "polygons"),
        ("crank-rocker", (640, 360), Look(), "25 rpm"),
        ("jansen", (640, 360), Look(chart="d.angle"), "Link d: angle"),
        ("engine", (1280, 720), Look(chart="slider.travel_velocity"), "Slider: velocity"),
        ("engine", (360, 640), Look(), "25 rpm"),
    ],
)
def test_a_chip_lies_where_nothing_is_drawn(name: str, size: tuple[int, int], look: Look, words: str) -> None:
    shown = Picture(load(name), size, look, docked=Docked(bar=True))
    place = chip_of(shown, words)
    usual, *_ = chip_places(shown.layout, place.width)
    assert not is_bare(shown, usual)
    assert is_bare(shown, place)


def test_a_chip_stays_below_the_marks_where_nothing_is_drawn_there_or_nowhere_else() -> None:
    for name, free in (("engine", True), ("press", False)):
        shown = Picture(load(name), (320, 180), Look())
        place = chip_of(shown, "25 rpm")
        usual, *_ = chip_places(shown.layout, place.width)
        assert abs(usual.middle - place.middle) < 2, name
        assert is_bare(shown, place.inset(1)) == free, name


def test_a_chip_is_not_under_the_bar_nor_where_a_draft_may_be() -> None:
    shown = Picture(load("crank-rocker"), (320, 180), Look(), docked=Docked(bar=True))
    bar = CommandBar(tuple(Button("play", "play", "Space") for _ in range(9)))
    frame = bar_place(shown.layout, bar)
    assert frame
    assert chip_of(shown, "25 rpm").meets(frame)
    assert not chip_of(shown, "25 rpm", Overlay(bar=bar)).meets(frame)
    place = chip_of(shown, "25 rpm", Overlay(construction=1))
    assert abs(next(iter(chip_places(shown.layout, place.width))).middle - place.middle) < 2


def test_the_picture_recedes_behind_the_help(painter: Picture) -> None:
    told = Overlay(help=(("look", (("H", "help"),)),))
    hud = painter.layout.hud
    assert hud
    title = hud._replace(height=24)
    assert inked(_painted(painter, Overlay()), title, LIGHT.ink)
    assert not inked(_painted(painter, told), title, LIGHT.ink)


def _list(rows: Sequence[EditRow], facts: tuple[str, ...] = ("Grashof",), hint: str = "Esc closes") -> Panel:
    return Panel(tuple(rows), facts=facts, hint=hint)


def test_every_line_of_the_edit_list_has_a_place_of_its_own() -> None:
    board = Board(layout(SIZE, listed=True), Type(), LIGHT)
    rows = [
        EditRow("Crank 2", "40 mm", chosen=True),
        EditRow("Coupler 3", "90 mm"),
        EditRow("Rocker 4", "80 mm"),
    ]
    whole = edit_list(board, _list(rows))
    others = [
        _list(rows, facts=("Grxxhof",)),
        *(_list([*rows[:n], replace(rows[n], value="77 mm"), *rows[n + 1 :]]) for n in range(3)),
        _list(rows, hint="Esc clxxes"),
    ]
    bands = [_between(whole, edit_list(board, other)) for other in others]
    for above, below in pairwise(bands):
        assert above.bottom <= below.y
    assert all(0 < band.y < band.bottom < whole.get_height() for band in bands)


def test_a_bar_lies_behind_all_of_the_chosen_row() -> None:
    board = Board(layout(SIZE, listed=True), Type(), LIGHT)
    rows = [EditRow("Crank 2", "40 mm", chosen=True), EditRow("Coupler 3", "90 mm")]
    one = edit_list(board, _list(rows))
    words = _between(one, edit_list(board, _list([replace(rows[0], value="77 mm"), rows[1]])))
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
