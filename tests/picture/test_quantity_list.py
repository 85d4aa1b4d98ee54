"""The open list of quantities: what is written where, and what gives way where room is short."""

from __future__ import annotations

from dataclasses import field
from itertools import pairwise
from typing import Any, NamedTuple

import pygame
import pytest

from linkanim.frozen import frozen
from linkanim.picture.board import STEP, Board
from linkanim.picture.layout import Docked, layout
from linkanim.picture.lists import Quantities
from linkanim.picture.raster import Colour
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.words import speaking

ROWS = tuple((f"Link {n}: angle", f"θ{n} (°)") for n in range(60))
HINT = "Enter charts   Esc closes"


class Line(NamedTuple):
    at: tuple[float, float]
    colour: Colour | None
    anchor: str


@frozen
class Noted(Board):
    """A board that keeps what is written on it."""

    lines: dict[str, Line] = field(default_factory=dict)
    bars: list[float] = field(default_factory=list)

    def write(self, sheet: pygame.Surface, text: str, at: tuple[float, float], **how: Any) -> None:
        self.lines[text] = Line(at, how.get("colour"), how.get("anchor", "left"))
        super().write(sheet, text, at, **how)

    def bar(self, sheet: pygame.Surface, y: float, size: int, colour: Colour, *, lines: float = 1.0) -> None:
        self.bars.append(y)
        super().bar(sheet, y, size, colour, lines=lines)


@pytest.fixture
def board() -> Noted:
    return Noted(layout((640, 360), docked=Docked(listed=1)), Type(), LIGHT)


def test_rows_stand_line_by_line_below_the_title_and_the_hint_below_them(board: Noted) -> None:
    sheet = Quantities(ROWS, 25, "", HINT).drawn(board).sheet
    size, lines = board.layout.small_size, board.lines
    shown = [words for words, _ in ROWS if words in lines]
    assert len(shown) >= 4
    assert ROWS[25][0] in shown[1:-1]
    tops = [
        lines["Quantities"].at[1],
        *(lines[words].at[1] for words in shown),
        lines[HINT].at[1],
    ]
    gaps = [after - before for before, after in pairwise(tops)]
    assert gaps[1:-1] == pytest.approx([STEP * size] * (len(shown) - 1))
    assert all(STEP * size * 0.99 <= gap < 1.5 * STEP * size for gap in gaps)
    assert board.bars == [lines[ROWS[25][0]].at[1]]
    assert lines["26 of 60"].anchor == "right"
    for words, symbol in ROWS[20:30]:
        assert (words in lines) == (symbol in lines)
        if words in lines:
            assert lines[symbol] == (
                (sheet.get_width() - lines[words].at[0], lines[words].at[1]),
                LIGHT.dim,
                "right",
            )
    assert board.layout.lists.height - 1.5 * STEP * size < sheet.get_height() <= board.layout.lists.height
    assert sheet.get_width() == round(board.layout.lists.width)


def test_each_row_is_found_where_its_words_stand(board: Noted) -> None:
    shown = Quantities(ROWS, 25, "", HINT)
    targets = (one for one in shown.drawn(board).targets if one.kind == "row")
    rows = [(one.value, one.place.y, one.place.bottom) for one in targets]
    half = 0.5 * board.layout.small_size
    written = [(n, board.lines[words].at[1]) for n, (words, _) in enumerate(ROWS) if words in board.lines]
    found = [next(row for row, begin, end in rows if begin <= y + half < end) for _, y in written]
    assert found == [n for n, _ in written]
    assert written[0][1] - half < rows[0][1]
    assert written[-1][1] + 3 * half >= rows[-1][2]


def test_what_has_been_typed_stands_for_the_title_and_none_found_is_said(board: Noted) -> None:
    sheet = Quantities((), 0, "rock", HINT).drawn(board).sheet
    size, lines = board.layout.small_size, board.lines
    assert (lines["rock_"].colour, "Quantities" in lines, lines["0"].anchor) == (
        LIGHT.velocity,
        False,
        "right",
    )
    none = lines["no name contains that"]
    assert none.colour == LIGHT.warning
    tops = lines["rock_"].at[1], none.at[1], lines[HINT].at[1], sheet.get_height() - size
    assert all(after - before >= 0.99 * STEP * size for before, after in pairwise(tops[:3]))
    assert tops[2] < tops[3]
    assert board.bars == []


def test_words_too_long_lose_their_middle_and_never_their_symbol(board: Noted) -> None:
    size = board.layout.small_size
    room = board.layout.lists.width - 2.4 * size
    rows = (("m" * 40, "θ = 1.5°"), ("w" * 40, "ω = −0.1 rad/s"), ("short", "α = 10 rad/s²"))
    Quantities(rows, 0).drawn(board)
    for words, told in rows:
        symbol, _, value = told.partition(" = ")
        assert {symbol, value} <= {*board.lines}
        assert board.lines[symbol].at[1] == board.lines[value].at[1]
        (written,) = (text for text in board.lines if text[0] == words[0] and text not in (symbol, value))
        assert ("…" in written) == (words != "short")
        end = board.lines[written].at[0] + board.type.width(written, size)
        assert end < board.lines[symbol].at[0] < board.lines[value].at[0] - board.type.width(value, size)
    assert all(board.type.width(text, size) <= room for text in board.lines)


STEADY = {
    "a sign": ("ω₃ = 1.25 rad/s", "ω₃ = −0.3012 rad/s"),
    "a vector's digits": ("r_{A} = 1, 2 mm", "r_{A} = −41.21, 37.52 mm"),
    "infinity": ("ρ_{A} = ∞ mm", "ρ_{A} = 55 mm"),
}


@pytest.mark.parametrize("told", STEADY.values(), ids=STEADY)
def test_a_symbol_stays_while_its_value_changes(board: Noted, told: tuple[str, str]) -> None:
    symbol, places = told[0].partition(" = ")[0], set[tuple[float, float]]()
    for value in told:
        Quantities((("Link 3: angular velocity", value),), 0).drawn(board)
        places.add(board.lines[symbol].at)
    assert len(places) == 1


ABBREVIATED = {
    "Link 3: second kinematic coefficient": "Link 3: 2nd kin. coeff.",
    "Link 3: angular acceleration": "Link 3: angular accel.",
    "Link 3: angle": "Link 3: angle",
}


def test_the_words_of_quantities_are_abbreviated_before_they_are_cut() -> None:
    board = Noted(layout((1280, 720), docked=Docked(listed=1)), Type(), LIGHT)
    Quantities(tuple((words, "h′₂ = 0.1089 rad/rad²") for words in ABBREVIATED), 0).drawn(board)
    assert {*ABBREVIATED.values()} <= {*board.lines}


NARROW = {
    # language, size of the window, words: what is written beside a symbol and a value that are long
    "English": ("en", (1280, 720), "Upper: second kinematic coefficient", "2nd coeff."),
    "Chinese": ("zh_TW", (1280, 720), "上：二階運動係數", "二階係數"),
    "Simplified Chinese": ("zh_CN", (1280, 720), "上：二阶运动系数", "二阶系数"),
    "Chinese, small": ("zh_TW", (640, 360), "上：二階運動係數", "二…"),
}


@pytest.mark.parametrize("case", NARROW)
def test_where_no_name_has_room_a_quantity_s_own_words_stay(case: str) -> None:
    language, size, words, written = NARROW[case]
    told = "h′_{upper} = 4.934×10⁻⁶ rad/mm²"
    with speaking(language):
        board = Noted(layout(size, docked=Docked(listed=1)), Type(), LIGHT)
        Quantities(((words, told),) * 40, 0, boxes=(False,) * 40).drawn(board)
    assert written in board.lines


def test_where_fewer_than_four_rows_would_be_left_the_hint_gives_way() -> None:
    told = set()
    for high in range(120, 360, 8):
        low = Noted(layout((640, high), docked=Docked(listed=1)), Type(), LIGHT)
        sheet = Quantities(ROWS, 3, "", "Enter").drawn(low).sheet
        rows = sum(words in low.lines for words, _ in ROWS)
        assert rows >= 4 if "Enter" in low.lines else rows <= 4
        last = max(line.at[1] for line in low.lines.values())
        assert sheet.get_height() - last < 3 * low.layout.small_size
        told.add("Enter" in low.lines)
    assert told == {True, False}
