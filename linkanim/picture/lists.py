"""The lists over the picture: dimensions with their values, and quantities or commands by their words.

A list returns its sheet with the places of its rows, so what is drawn is what is clicked.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pygame

from linkanim.frozen import frozen
from linkanim.picture.board import STEP, Board, around
from linkanim.picture.items import DrawnSheet, Target
from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.shapes import box, stroke
from linkanim.picture.theme import ORANGE, mixed
from linkanim.picture.view import Rect
from linkanim.words import said, said_as, to_say

# What all lists have: a title, rows with a bar behind the chosen one, words below.

_FRAME = 2.6
"""The height of a list's frame, without its rows and the text above and below them, in lines."""
_FEWEST = 4
"""Where fewer rows than this would be shown, hints and facts are left out."""


class _Division(NamedTuple):
    """How a list is divided: its text's size, the lines above and below the rows, the rows that are shown."""

    size: int
    facts: Sequence[str]
    foot: Sequence[tuple[str, Colour]]
    rows: range

    @property
    def top(self) -> float:
        """How far down the first row's text begins, in heights of the text."""
        return 0.9 + STEP * (1 + len(self.facts)) + (0.25 if self.facts else 0.0)


class ListPanel(ABC):
    """A list of rows."""

    rows: tuple[object, ...]

    def drawn(self, board: Board, pointed: int | None = None) -> DrawnSheet:
        """Return the list, or what has room of it about the chosen row, and the places of its rows.

        The mouse is over the row `pointed`.
        """
        size, facts, foot, rows = parts = self._divided(board)
        lines = max(len(rows), 1)
        sheet = board.sheet(board.layout.lists.width, STEP * size * (len(facts) + lines + len(foot) + _FRAME))
        self._head(board, sheet, parts)
        places = [(row, (parts.top + STEP * n) * size) for n, row in enumerate(rows)]
        for row, y in places:
            if behind := board.behind(row, self._at, pointed):
                board.bar(sheet, y, size, behind)
        for n, (line, colour) in enumerate(foot, start=lines):
            at = (1.2 * size, (parts.top + 0.2 + STEP * n) * size)
            board.write(sheet, line, at, size=size, colour=colour)
        wide, high = sheet.get_size()
        more = self._write(board, sheet, places, size)
        around = (Rect(0, y - 0.5 * (STEP - 1) * size, wide, STEP * size) for _, y in places)
        found = (Target("row", place, row) for place, row in zip(around, rows, strict=True))
        return DrawnSheet(sheet, (Target("list", Rect(0, 0, wide, high)), *found, *more))

    @property
    @abstractmethod
    def _at(self) -> int | None:
        """The number of the chosen row."""

    @abstractmethod
    def _divided(self, board: Board) -> _Division:
        """Return how the list is divided in its room."""

    @abstractmethod
    def _head(self, board: Board, sheet: pygame.Surface, parts: _Division) -> None:
        """Draw what stands above the rows."""

    @abstractmethod
    def _write(
        self, board: Board, sheet: pygame.Surface, places: Sequence[tuple[int, float]], size: int
    ) -> Iterator[Target]:
        """Write rows, each with its text's top, and yield what else of them can be clicked."""


def _numbered(chosen: int, rows: Sequence[object]) -> str:
    """Return in words which of how many rows one is."""
    return said("{number} of {count}", number=chosen + 1, count=len(rows))


def _room(board: Board, size: int) -> float:
    """Return how many lines of text have room within a list's frame."""
    return board.layout.lists.height / STEP / size - _FRAME


# The list of dimensions: what the linkage is, the values, and why one is refused.

_NAME = 4.5
"""The part of a row's name that is shown where its value is too long, in heights of the text."""
_FLASH = 0.45
"""The share of the flash's colour in the bar behind the facts at its brightest."""


@frozen
class EditRow:
    """One dimension in the edit list: its name, its value as written, and whether it is chosen.

    A `draft` is a typed value that has not been checked yet.
    """

    label: str
    value: str
    chosen: bool = False
    draft: bool = False


@frozen
class Panel(ListPanel):
    """The edit list; `error` says why the chosen value is refused.

    `facts` say what linkage the lengths make; they stand out while `flash` (0 to 1) is above 0. Where rows
    are `counted`, the head says which of how many is chosen.
    """

    rows: tuple[EditRow, ...]
    title: str = to_say("Edit dimensions")
    facts: tuple[str, ...] = ()
    flash: float = 0.0
    error: str | None = None
    hint: str = ""
    counted: bool = True

    @property
    def _at(self) -> int | None:
        return next((n for n, row in enumerate(self.rows) if row.chosen), None)

    def _divided(self, board: Board) -> _Division:
        """Return the largest text at which all fits; else the smallest, without hint or facts."""
        sizes, count = range(board.layout.text_size, board.layout.small_size - 1, -1), len(self.rows)
        for size in (size for size in sizes if count <= _room(board, size)):
            parts = self._with(board, size, self.facts, self.hint)
            if len(parts.rows) == count and self._needed(board, size) <= board.layout.lists.width:
                return parts
        for facts, hint in ((self.facts, self.hint), (self.facts, ""), ((), "")):
            parts = self._with(board, sizes[-1], facts, hint)
            if len(parts.rows) >= min(_FEWEST, count):
                break
        return parts

    def _with(self, board: Board, size: int, facts: tuple[str, ...], hint: str) -> _Division:
        """Return how the list is divided at a size, with these facts and this hint."""
        room = board.layout.lists.width - 2.4 * size
        lines = [line for fact in facts for line in board.type.wrapped(fact, size, room)]
        foot = [(line, board.theme.warning) for line in board.type.wrapped(self.error or "", size, room)]
        foot += [(line, board.theme.dim) for line in board.type.wrapped(said(hint), size, room, gap="   ")]
        left = int(_room(board, size) - len(foot) - len(lines))
        return _Division(size, lines, foot, around(len(self.rows), self._at or 0, left))

    def _needed(self, board: Board, size: int) -> float:
        """Return how wide the list must be for every name to be written in full."""
        columns = zip(*((row.label, row.value) for row in self.rows), strict=True)
        return sum(board.widest(column, size, strong=True) for column in columns) + 3.9 * size

    def _head(self, board: Board, sheet: pygame.Surface, parts: _Division) -> None:
        """Draw the title, the number of the chosen row, and the facts, lit up while they flash."""
        size, chosen = parts.size, self._at
        count = "" if chosen is None or not self.counted else _numbered(chosen, self.rows)
        board.head(sheet, size, said(self.title), count, board.theme.ink)
        if self.flash > 0.0 and parts.facts:
            lit = mixed(board.theme.panel, ORANGE, _FLASH * self.flash)
            board.bar(sheet, (0.8 + STEP) * size, size, lit, lines=len(parts.facts))
        for n, line in enumerate(parts.facts, start=1):
            board.write(sheet, line, (1.2 * size, (0.8 + STEP * n) * size), size=size)

    def _write(
        self, board: Board, sheet: pygame.Surface, places: Sequence[tuple[int, float]], size: int
    ) -> Iterator[Target]:
        right = sheet.get_width() - 1.2 * size
        for n, y in places:
            row = self.rows[n]
            colour = board.theme.velocity if row.draft else board.theme.ink
            name = min(board.type.width(row.label, size), _NAME * size)
            value = board.ending(row.value, size, right - name - 2.0 * size)
            room = right - board.type.width(value, size, strong=True) - 2.0 * size
            label = board.fitting((row.label,), size, room)
            board.write(sheet, label, (1.2 * size, y), size=size, colour=board.theme.dim)
            board.write(sheet, value, (right, y), size=size, colour=colour, anchor="right", strong=True)
        yield from ()


# The list of quantities: their words and symbols, the text typed to filter them, the chosen one.

_ABBREVIATED = {
    **{"second ": "2nd ", "kinematic coefficient": "kin. coeff.", " spring:": ":", " damper:": ":"},
    **{"acceleration": "accel.", "angular": "ang.", "tangential": "tang.", "kin. ": ""},
}
"""How words of quantities are abbreviated where room is short, one after the other."""
_OWNER = re.compile(r"^.*?(: |：)")
"""What stands before a quantity's own words."""
_NUMBER, _USUAL = r"(?<![×\d])[−\d.∞]+", "−0.8888"
"""A number in a value, without its power of ten, and one as wide as most."""
_GAP = 0.7
"""The gaps between words, symbol and value, in heights of their text."""
_BOX = 2.5
"""Where the words of rows with boxes begin, in heights of their text."""
_TRACK = 1.4
"""The width of the scroll bar's track, in heights of the text."""


@frozen
class Quantities(ListPanel):
    """A list, for example of quantities: rows of words and symbol, the chosen row's number, the typed text.

    Rows with `boxes` have one each, ticked or not.
    """

    rows: tuple[tuple[str, str], ...]
    chosen: int
    typed: str = ""
    hint: str = ""
    title: str = to_say("Quantities")
    boxes: tuple[bool, ...] = ()

    @property
    def _at(self) -> int | None:
        return self.chosen

    def _divided(self, board: Board) -> _Division:
        """Return as many rows as the window has room for, and the hint, if there is room for it."""
        size = board.layout.small_size
        hint = board.type.wrapped(said(self.hint), size, board.layout.lists.width - 2.4 * size, gap="   ")
        room = int(_room(board, size))
        hint = hint if room - len(hint) >= _FEWEST else []
        rows = around(len(self.rows), self.chosen, room - len(hint))
        return _Division(size, (), [(line, board.theme.dim) for line in hint], rows)

    def _head(self, board: Board, sheet: pygame.Surface, parts: _Division) -> None:
        """Write what is typed, else the title, and the number of the chosen row."""
        size = parts.size
        count = _numbered(self.chosen, self.rows) if self.rows else "0"
        typed = (
            (f"{self.typed}_", board.theme.velocity) if self.typed else (said(self.title), board.theme.ink)
        )
        board.head(sheet, size, typed[0], count, typed[1])
        if not self.rows:
            at = (1.2 * size, parts.top * size)
            board.write(sheet, said("no name contains that"), at, size=size, colour=board.theme.warning)

    def _write(
        self, board: Board, sheet: pygame.Surface, places: Sequence[tuple[int, float]], size: int
    ) -> Iterator[Target]:
        wide, high = sheet.get_size()
        if self.boxes:
            _boxes(board, sheet, [(y, self.boxes[row]) for row, y in places], size)
            yield Target("boxes", Rect(0, 0, _BOX * size, high))
        for row, y in places:
            self._row(board, sheet, row, size, y)
        if len(places) < len(self.rows):
            top, side = places[0][1] - 0.5 * (STEP - 1) * size, _TRACK * size
            track = Rect(wide - side, top, side, STEP * size * len(places))
            rows = range(places[0][0], places[-1][0] + 1)
            _scroll_bar(board, sheet, track, rows, len(self.rows))
            yield Target("track", track, len(self.rows))

    def _row(self, board: Board, sheet: pygame.Surface, row: int, size: int, y: float) -> None:
        """Write a row: its value at the right, the symbol before it, and its words in the room that remains.

        The symbol keeps its place while the value's digits change.
        """
        begin, right = (_BOX if self.boxes else 1.2) * size, sheet.get_width() - 1.2 * size
        words, told = self.rows[row]
        symbol, _, value = told.rpartition(" = ")
        taken: float = board.widest((value, re.sub(_NUMBER, _USUAL, value)) if symbol else (value,), size)
        board.write(sheet, value, (right, y), size=size, colour=board.theme.dim, anchor="right")
        if symbol:
            taken += board.type.width(symbol, size) + _GAP * size
            board.write(sheet, symbol, (right - taken, y), size=size, colour=board.theme.dim)
        room = right - begin - (taken + _GAP * size if told else 0.0)
        ways = [*_shorter(words)]
        if symbol:  # which says whose the quantity is
            ways.append(_OWNER.sub("", ways[-1]))
        board.write(sheet, board.fitting(ways, size, room), (begin, y), size=size)


def _scroll_bar(board: Board, sheet: pygame.Surface, track: Rect, rows: range, count: int) -> None:
    """Draw the scroll bar, which shows the part of a list's rows that is visible."""
    wide, x = 0.32 * board.layout.small_size, track.x + 0.6 * track.width
    begin, end = (track.y + track.height * row / count for row in (rows.start, rows.stop))
    whole, part = (
        complex(x, (top + foot) / 2) + box(wide, foot - top, wide / 2)
        for top, foot in ((track.y, track.bottom), (begin, max(end, begin + 2 * wide)))
    )
    paint(sheet, [Layer(board.theme.rule, [whole]), Layer(board.theme.dim, [part])])


def _shorter(words: str) -> Iterator[str]:
    """Yield a quantity's words, then with more and more of them abbreviated."""
    yield words
    coefficient = said("kinematic coefficient"), said_as("short", "coeff.")
    for word, short in (*_ABBREVIATED.items(), coefficient):
        if word in words:
            words = words.replace(word, short)
            yield words


def _boxes(board: Board, sheet: pygame.Surface, rows: Sequence[tuple[float, bool]], size: int) -> None:
    """Draw a box in each row, ticked or empty, all of them at once."""
    line = max(0.09 * size, 1.0)
    edge, inside = (box(wide, wide, 0.15 * size) for wide in (0.86 * size, 0.86 * size - 2 * line))
    tick = size * np.array([-0.24 + 0.02j, -0.07 + 0.2j, 0.26 - 0.2j])
    ticked, empty = (
        [complex(1.6 * size, y + 0.55 * size) for y, is_ticked in rows if is_ticked is wanted]
        for wanted in (True, False)
    )
    theme, ticks = board.theme, (stroke(at + tick, 0.14 * size) for at in ticked)
    layers = [
        Layer(theme.velocity, [at + edge for at in ticked]),
        Layer(theme.panel, [loop for one in ticks for loop in one]),
        Layer(theme.dim, [at + edge for at in empty]),
        Layer(theme.panel, [at + inside for at in empty]),
    ]
    paint(sheet, [layer for layer in layers if layer.loops])
