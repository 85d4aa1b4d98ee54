"""What lies over the picture for a while is all there: every word of it, where nothing else of it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pygame
import pytest
from pictures import inked, pixels, stated, with_panels

from linkanim.picture.board import Board
from linkanim.picture.drawn import Additions
from linkanim.picture.layout import Docked, layout
from linkanim.picture.lists import EditRow, Panel
from linkanim.picture.look import Look
from linkanim.picture.marks import DimensionLine, MeasuredLines
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.player.commands import bar
from linkanim.player.state import RunningRecording, Toast, begin, with_toast
from linkanim.scenes import load
from linkanim.ui.panels import foot, hint, shortened, words_at_foot
from linkanim.ui.pointing import AtMouse

SIZE = (640, 360)


@pytest.fixture(scope="module")
def painter() -> Picture:
    return Picture(load("crank-rocker"), SIZE, Look())


MEASURED = DimensionLine(("O2", "O4"), 0, 1, "100 mm")


def test_the_bar_that_is_edited_is_lit_and_measured_beside_it(painter: Picture) -> None:
    bare, lit = offscreen(SIZE), offscreen(SIZE)
    for surface, drawn in ((bare, ()), (lit, (MeasuredLines((MEASURED,)),))):
        SurfacePrinter().paint(surface, painter, painter.scene.pose(1.0), Additions(drawn))
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
    "a toast": stated(words="recordings/crank-rocker-1.gif: 45 %"),
    "an answer": stated(chip=Toast("names and dimensions", 60)),
    "a hint": replace(begin("crank-rocker"), frame=460),
    "a mark": stated(recording=RunningRecording("gif", 0)),
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
    slot, place = shown.layout.caption, _between(with_panels(shown, 1.0), with_panels(shown, 1.0, SAID[case]))
    assert slot
    assert slot.x <= place.x <= place.right <= slot.right
    assert slot.y - 1 <= place.y <= place.bottom <= slot.bottom + 1
    assert not slot.meets(shown.layout.stage)


def test_of_all_that_could_be_said_the_most_pressing_is() -> None:
    state = replace(begin("crank-rocker"), frame=460)
    hints, _ = words_at_foot(state) or ("", "")
    assert hints.endswith("H keys")
    state = replace(state, look=Look(names=1))
    assert words_at_foot(state) == (state.scene.look_at, "hint")
    state = replace(state, chip=Toast("25 rpm", 500))
    assert words_at_foot(state) == ("25 rpm", "answer")
    state = replace(with_toast(state, "`written`"), last_mouse_move=460)
    assert words_at_foot(state) == ("written", "answer")
    names = [words_at_foot(state, AtMouse(button=n)) for n in range(len(bar(state)))]
    assert ("play / pause   Space", "") in names
    lacking = next(n for n, one in enumerate(bar(state)) if one.lack)
    words, kind = words_at_foot(state, AtMouse(button=lacking)) or ("", "answer")
    assert words.endswith(f": {bar(state)[lacking].lack}")
    assert kind == ""
    assert words_at_foot(replace(begin("crank-rocker"), chip=Toast("25 rpm", 0))) is None


def test_hints_that_have_no_room_in_a_line_lose_their_first_parts() -> None:
    board = Board(layout((320, 180), docked=Docked(bar=True)), Type(), LIGHT)
    state = replace(begin("crank-rocker"), frame=460)
    whole = hint(state)
    assert whole
    told = shortened(board, whole)
    assert whole.endswith(told.replace("   ·   ", " · "))
    assert "H keys" in told
    assert "Space" not in told


@pytest.mark.parametrize("count", [1, 16, 40])
def test_words_at_the_foot_are_whole_and_in_the_window(count: int) -> None:
    board = Board(layout((480, 270), docked=Docked(bar=True)), Type(), LIGHT)
    sheet, (x, y) = foot(board, ("a few words " * count, "answer"))
    assert x >= 0
    assert x + sheet.get_width() <= 480
    assert y > 0.6 * 270
    assert round(y) + sheet.get_height() <= 270


def test_the_picture_recedes_behind_the_help(painter: Picture) -> None:
    hud = painter.layout.hud
    assert hud
    title = hud._replace(height=24)
    assert inked(with_panels(painter, 1.0), title, LIGHT.ink)
    assert not inked(with_panels(painter, 1.0, stated(helped=True)), title, LIGHT.ink)


def test_help_stands_beside_the_values_that_it_explains() -> None:
    painter = Picture(load("crank-rocker"), (1280, 720), Look(), docked=Docked(listed=1))
    values = Panel((EditRow("Crank 2", "55 mm", chosen=True),), hint="Esc closes")
    plain = pixels(with_panels(painter, 1.0, stated(values)))
    helped = pixels(with_panels(painter, 1.0, stated(values, helped=True)))
    rows, columns = np.nonzero((plain == LIGHT.chosen).all(axis=-1))
    within = np.s_[rows.min() : rows.max(), columns.min() : columns.max()]
    assert np.array_equal(helped[within], plain[within])
    assert not np.array_equal(helped[:, 640:], plain[:, 640:])


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
