"""What lies over the picture: the help, the edit list, a toast, the marks of pause and recording."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pygame

from linkanim.picture.layout import Layout
from linkanim.picture.overlay import EditRow, Overlay, Panel
from linkanim.picture.raster import Colour, Layer, Loop, paint
from linkanim.picture.shapes import box, disc
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme

_LINE = 1.42
"""From line to line of the edit list, in heights of its text."""
_FRAME = 2.6
"""How many lines high the edit list is without its rows and what stands below them."""
_VEIL = 170


@dataclass
class Panels:
    """Draws overlays; the last panel of each kind is kept, so that an open one costs one blit."""

    layout: Layout
    type: Type
    theme: Theme
    _kept: dict[str, tuple[Any, pygame.Surface]] = field(default_factory=dict)

    def draw(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw all that an overlay holds."""
        size, gap = self.layout.size, 18 * self.layout.unit
        self._marks(surface, overlay)
        if overlay.panel:
            drawn = self._keep("panel", overlay.panel, self._panel)
            surface.blit(drawn, (self._margin, self._margin))
        if overlay.help:
            surface.blit(self._keep("veil", None, self._veil), (0, 0))
            drawn = self._keep("help", overlay.help, self._help)
            at = ((size[0] - drawn.get_width()) // 2, (size[1] - drawn.get_height()) // 2)
            surface.blit(drawn, at)
        if overlay.toast:
            drawn = self._keep("toast", overlay.toast, self._toast)
            at = ((size[0] - drawn.get_width()) // 2, round(size[1] - drawn.get_height() - 2 * gap))
            surface.blit(drawn, at)

    def _keep(self, kind: str, value: Any, make: Any) -> pygame.Surface:
        if kind not in self._kept or self._kept[kind][0] != value:
            self._kept[kind] = (value, make(value))
        return self._kept[kind][1]

    def _veil(self, _: None) -> pygame.Surface:
        """Return what lets the picture recede behind the help."""
        veil = pygame.Surface(self.layout.size, pygame.SRCALPHA, 32)
        veil.fill((*self.theme.background, _VEIL))
        return veil

    def _marks(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the marks of recording and pause at the top right, words and signs."""
        size, unit = self.layout.text_size, self.layout.unit
        right, top = self.layout.size[0] - 20 * unit, 18 * unit
        marks = [(overlay.recording, self.theme.warning, [0.36 * size * disc(1.0)])]
        marks.append(("paused" if overlay.paused else None, self.theme.ink, _bars(size)))
        for words, colour, sign in marks:
            if words:
                width = self.type.draw(surface, words, (right, top), size=size, colour=colour, anchor="right")
                middle = complex(right - width - 0.8 * size, top + 0.5 * size)
                paint(surface, [Layer(colour, [middle + loop for loop in sign])])
                top += 1.5 * size

    def _sheet(self, width: float, height: float) -> pygame.Surface:
        """Return an empty panel: a framed sheet with round corners on nothing."""
        sheet = pygame.Surface((round(width), round(height)), pygame.SRCALPHA, 32)
        middle = complex(sheet.get_width() / 2, sheet.get_height() / 2)
        line, corner = max(1.5 * self.layout.unit, 1.0), 10 * self.layout.unit
        outer = middle + box(sheet.get_width(), sheet.get_height(), corner)
        inner = middle + box(sheet.get_width() - 2 * line, sheet.get_height() - 2 * line, corner - line)
        paint(sheet, [Layer(self.theme.rule, [outer]), Layer(self.theme.panel, [inner])])
        return sheet

    def _toast(self, text: str) -> pygame.Surface:
        size = self.layout.text_size
        lines = self.type.wrapped(text, size, 0.8 * self.layout.size[0])
        wide = max((self.type.width(line, size) for line in lines), default=0)
        sheet = self._sheet(wide + 2 * size, (1.25 * len(lines) + 0.75) * size)
        for n, line in enumerate(lines):
            at = (sheet.get_width() / 2, (0.5 + 1.25 * n) * size)
            self.type.draw(sheet, line, at, size=size, colour=self.theme.ink, anchor="centre")
        return sheet

    def _help(self, rows: tuple[tuple[str, str], ...]) -> pygame.Surface:
        size = _fitting(self.layout.text_size, 1.38 * (len(rows) + 1.2), self.layout.size[1])
        widths = self._columns(rows, size)
        size = _fitting(size, (sum(widths) + 4 * size) / size, self.layout.size[0])
        keys, words = self._columns(rows, size)
        sheet = self._sheet(keys + words + 4 * size, 1.38 * size * (len(rows) + 1.1))
        for n, (key, does) in enumerate(rows):
            y = (0.9 + 1.38 * n) * size
            self.type.draw(sheet, key, (1.4 * size, y), size=size, colour=self.theme.ink, strong=True)
            self.type.draw(sheet, does, (2.6 * size + keys, y), size=size, colour=self.theme.dim)
        return sheet

    def _columns(self, rows: tuple[tuple[str, str], ...], size: int) -> list[int]:
        """Return the width of each of the columns."""
        columns = zip(*rows, strict=True)
        return [max(self.type.width(text, size, strong=True) for text in column) for column in columns]

    @property
    def _margin(self) -> int:
        return round(10.8 * self.layout.unit)

    def _panel(self, panel: Panel) -> pygame.Surface:
        """Return the edit list; where it would not fit at a size that reads, the rows around the chosen."""
        size, wide, foot = self._measured(panel)
        shown = _around(panel.rows, int(self._height / size - len(foot) - _FRAME))
        sheet = self._sheet(wide, _LINE * size * (len(shown) + len(foot) + _FRAME))
        self._head(sheet, panel, size)
        for n, row in enumerate(shown, start=1):
            self._row(sheet, row, (0.9 + _LINE * n) * size, size)
        for n, (line, colour) in enumerate(foot, start=len(shown) + 1):
            at = (1.2 * size, (1.2 + _LINE * n) * size)
            self.type.draw(sheet, line, at, size=size, colour=colour)
        return sheet

    @property
    def _height(self) -> float:
        """The height there is for the edit list, in lines of a pixel's height of text."""
        return (self.layout.size[1] - 2 * self._margin) / _LINE

    def _measured(self, panel: Panel) -> tuple[int, float, list[tuple[str, Colour]]]:
        """Return the list's text size, its width, and the lines below its rows in their colours."""
        covered = self.layout.hud.right if self.layout.hud else 0.0
        for size in range(self.layout.text_size, self.layout.small_size - 1, -1):
            columns = self._columns(tuple((row.label, row.value) for row in panel.rows), size)
            wide = max(sum(columns) + 5.5 * size, 19.0 * size, covered)
            room = wide - 2.4 * size
            foot = [(line, self.theme.warning) for line in self.type.wrapped(panel.error or "", size, room)]
            foot += [(line, self.theme.dim) for line in self.type.wrapped(panel.hint, size, room, gap="   ")]
            if len(panel.rows) + len(foot) + _FRAME <= self._height / size:
                break
        return size, wide, foot

    def _head(self, sheet: pygame.Surface, panel: Panel, size: int) -> None:
        """Draw the title, and which of the rows is the chosen one."""
        at = (1.2 * size, 0.7 * size)
        self.type.draw(sheet, panel.title, at, size=size, colour=self.theme.ink, strong=True)
        places = [n for n, row in enumerate(panel.rows, start=1) if row.chosen]
        at = (sheet.get_width() - 1.2 * size, 0.7 * size)
        words = "".join(f"{n} of {len(panel.rows)}" for n in places)
        self.type.draw(sheet, words, at, size=size, colour=self.theme.dim, anchor="right")

    def _row(self, sheet: pygame.Surface, row: EditRow, y: float, size: int) -> None:
        if row.chosen:
            middle = complex(sheet.get_width() / 2, y + 0.5 * size)
            bar = middle + box(sheet.get_width() - 1.2 * size, 1.36 * size, 0.25 * size)
            paint(sheet, [Layer(self.theme.chosen, [bar])])
        at = (sheet.get_width() - 1.2 * size, y)
        self.type.draw(sheet, row.label, (1.2 * size, y), size=size, colour=self.theme.dim)
        self.type.draw(sheet, row.value, at, size=size, colour=self.theme.ink, anchor="right")


def _around(rows: tuple[EditRow, ...], count: int) -> tuple[EditRow, ...]:
    """Return at most so many rows, and at least one, with the chosen one in their middle where it can be."""
    count = max(count, 1)
    chosen = next((n for n, row in enumerate(rows) if row.chosen), 0)
    first = min(max(chosen - count // 2, 0), max(len(rows) - count, 0))
    return rows[first : first + count]


def _bars(size: float) -> list[Loop]:
    bar = box(0.22 * size, 0.72 * size)
    return [np.asarray(bar + side * 0.22 * size) for side in (-1, 1)]


def _fitting(size: int, lengths: float, room: int) -> int:
    """Return the text size, smaller where so many times its own length would not fit the window."""
    return max(min(size, int(0.96 * room / lengths)), 6)
