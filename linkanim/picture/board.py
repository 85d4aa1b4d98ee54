"""What every panel is drawn on: framed sheets, rows of text in columns, a bar behind the chosen row."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import field
from math import ceil

import numpy as np
import pygame

from linkanim.frozen import frozen
from linkanim.picture.layout import Layout
from linkanim.picture.raster import Colour, Cover, Layer, Shapes, covers, paint
from linkanim.picture.shapes import box
from linkanim.picture.text import Anchor, Type
from linkanim.picture.theme import Theme, mixed

STEP = 1.42
"""The step from line to line of a list, in heights of its text."""

_POINTED = 0.5
"""The share of the chosen row's colour in the row under the mouse."""

_KEPT_BARS = 8
_KEPT_SHEETS = 4
"""The number of empty sheets kept, one for each height of a list: with a refusal of none to three lines."""


@frozen
class Board:
    """The window's layout, type and theme, and how a panel is made of them."""

    layout: Layout
    type: Type
    theme: Theme
    _sheets: dict[object, pygame.Surface] = field(default_factory=dict, compare=False)
    """The latest empty panels: a list that changes has few sizes."""
    _bars: dict[object, Cover] = field(default_factory=dict, compare=False)
    """The latest bars behind rows: a list that changes mostly keeps its chosen row."""

    @property
    def margin(self) -> int:
        """How far a panel keeps from the window's edge, in pixels."""
        return round(10.8 * self.layout.unit)

    def sheet(self, width: float, height: float) -> pygame.Surface:
        """Return an empty panel: a framed sheet with round corners on a clear surface."""
        size = round(width), round(height)
        key = size, self.layout.unit, self.theme
        if key not in self._sheets:
            if len(self._sheets) >= _KEPT_SHEETS:
                self._sheets.clear()
            self._sheets[key] = self._empty(size)
        return self._sheets[key].copy()

    def _empty(self, size: tuple[int, int]) -> pygame.Surface:
        """Return a framed sheet: only its corners are curves, so all else repeats a small one's middle."""
        corner = 10 * self.layout.unit
        least = 2 * ceil(corner) + 1
        small = self._framed((min(size[0], least), min(size[1], least)), corner)
        if small.get_size() == size:
            return small
        sheet, pixels = pygame.Surface(size, pygame.SRCALPHA, 32), pygame.surfarray.array2d(small)
        for axis, (count, wanted) in enumerate(zip(small.get_size(), size, strict=True)):
            times = np.ones(count, np.intp)
            times[count // 2] += wanted - count
            pixels = np.repeat(pixels, times, axis=axis)
        pygame.surfarray.blit_array(sheet, pixels)
        return sheet

    def _framed(self, size: tuple[int, int], corner: float) -> pygame.Surface:
        """Return a framed sheet, filled as a whole."""
        sheet = pygame.Surface(size, pygame.SRCALPHA, 32)
        (wide, high), line = size, max(1.5 * self.layout.unit, 1.0)
        middle = complex(wide / 2, high / 2)
        outer = middle + box(wide, high, corner)
        inner = middle + box(wide - 2 * line, high - 2 * line, corner - line)
        paint(sheet, [Layer(self.theme.rule, [outer]), Layer(self.theme.panel, [inner])])
        return sheet

    def write(
        self,
        sheet: pygame.Surface,
        text: str,
        at: tuple[float, float],
        *,
        size: int,
        colour: Colour | None = None,
        anchor: Anchor = "left",
        strong: bool = False,
    ) -> None:
        """Write a line whose top is at `at`, in the theme's ink where no colour is given."""
        ink = self.theme.ink if colour is None else colour
        self.type.draw(sheet, text, at, size=size, colour=ink, anchor=anchor, strong=strong)

    def bar(self, sheet: pygame.Surface, y: float, size: int, colour: Colour, *, lines: float = 1.0) -> None:
        """Draw a bar across a sheet behind a number of lines of text, the first with its top at `y`."""
        key = sheet.get_size(), y, size, colour, lines
        if key not in self._bars:
            middle = complex(sheet.get_width() / 2, y + (0.5 + (lines - 1.0) * STEP / 2) * size)
            high = (1.36 + (lines - 1.0) * STEP) * size
            loop = middle + box(sheet.get_width() - 1.2 * size, high, 0.25 * size)
            if len(self._bars) >= _KEPT_BARS:
                self._bars.clear()
            (self._bars[key],) = covers(sheet, [Shapes([Layer(colour, [loop])])])
        self._bars[key].put(sheet)

    def behind(self, row: int, chosen: int | None, pointed: int | None) -> Colour | None:
        """Return the colour behind a row that is chosen, or under the mouse; None for any other row."""
        if row == chosen:
            return self.theme.chosen
        return mixed(self.theme.panel, self.theme.chosen, _POINTED) if row == pointed else None

    def head(self, sheet: pygame.Surface, size: int, title: str, count: str, colour: Colour) -> None:
        """Write a list's title, and at the right which of how many rows is the chosen one."""
        left, right = (1.2 * size, 0.7 * size), (sheet.get_width() - 1.2 * size, 0.7 * size)
        self.write(sheet, title, left, size=size, colour=colour, strong=True)
        self.write(sheet, count, right, size=size, colour=self.theme.dim, anchor="right")

    def fitting(self, words: Sequence[str], size: int, room: float) -> str:
        """Return the first of some texts that fits the room; else the last one without its middle."""
        for text in words:
            if self.type.width(text, size) <= room:
                return text
        name = words[-1]
        kept = (f"{name[: n - n // 2]}…{name[len(name) - n // 2 :]}" for n in range(len(name) - 1, 0, -1))
        return next((text for text in kept if self.type.width(text, size) <= room), "")

    def ending(self, text: str, size: int, room: float) -> str:
        """Return a line in semibold; where it does not fit the room, only its end."""
        if self.type.width(text, size, strong=True) <= room:
            return text
        kept = (f"…{text[n:]}" for n in range(1, len(text)))
        return next((one for one in kept if self.type.width(one, size, strong=True) <= room), "")

    def widest(self, lines: Iterable[str], size: int, *, strong: bool = False) -> int:
        """Return the width of the widest of some lines, 0 where there is none."""
        return max((self.type.width(line, size, strong=strong) for line in lines), default=0)


def around(count: int, chosen: int, room: int) -> range:
    """Return which of `count` rows to show where `room` of them fit: at least one.

    The chosen one stands in their middle, where it can.
    """
    room = max(room, 1)
    first = min(max(chosen - room // 2, 0), max(count - room, 0))
    return range(first, min(first + room, count))
