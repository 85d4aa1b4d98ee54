"""Rows of words on the sheet: the numbers of the chosen shape, and what a gesture can mean."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.mechanics.linkage import Point
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Target
from linkanim.picture.layout import Layout
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import box
from linkanim.picture.theme import mixed
from linkanim.picture.view import Rect, View

_HIGH, _LETTER, _EDGE = 1.5, 0.56, 0.7
"""The height of a row, the width of a letter and the margin beside the words, in heights of text."""
_ASIDE = 1.4
"""How far right of and below its place a list stands, in heights of text."""
_CHOSEN = 0.35


class SheetRows(NamedTuple):
    """A list on the sheet: a title, rows of a label and a value, the lit row, and the list's place.

    Without a place it stands at the upper right. A click on one of the rows `options` takes its next value.
    """

    title: str
    rows: tuple[tuple[str, str], ...]
    chosen: int
    at: Point | None = None
    options: tuple[int, ...] = ()

    def _places(self, layout: Layout, view: View) -> tuple[Rect, ...]:
        """Return where the rows are, the title's first: beside the list's place, else at the upper right."""
        size, stage = layout.small_size, layout.stage
        letters = max(len(self.title), *(len(label) + len(value) + 2 for label, value in self.rows), 1)
        wide, high = (_LETTER * letters + 2 * _EDGE) * size, _HIGH * size
        tall = high * (1 + len(self.rows))
        x, y = stage.right - layout.margin - wide, stage.y + layout.margin + 2 * layout.text_size
        if self.at:
            x, y = (at + _ASIDE * size for at in view.to_pixel(*self.at))
            x = max(min(x, stage.right - layout.margin - wide), stage.x)
            y = max(min(y, stage.bottom - layout.margin - tall), stage.y)
        return tuple(Rect(x, y + n * high, wide, high) for n in range(1 + len(self.rows)))

    def group(self, kind: str, setting: DrawSetting) -> Group:
        """Return a list of a kind, as its targets have it: its title, and its rows with the chosen one lit.

        The value of a target is the row's number, −1 for the title, and the list.
        """
        layout, theme, size = setting.layout, setting.theme, setting.layout.small_size
        rects = self._places(layout, setting.view)
        first, last = rects[0], rects[-1]
        middle = complex(first.x + first.width / 2, (first.y + last.bottom) / 2)
        high, corner, line = last.bottom - first.y, 0.4 * size, max(1.2 * layout.unit, 1.0)
        layers = [
            Layer(theme.rule, [middle + box(first.width + 2 * line, high + 2 * line, corner + line)]),
            Layer(theme.panel, [middle + box(first.width, high, corner)]),
        ]
        captions = [Caption(self.title, (first.x + _EDGE * size, first.y + 0.25 * size), size, theme.dim)]
        for n, ((label, value), rect) in enumerate(zip(self.rows, rects[1:], strict=True)):
            is_chosen, top = n == self.chosen, rect.y + 0.25 * size
            if is_chosen:
                lit = rect.middle + box(rect.width - 0.4 * size, rect.height, 0.3 * size)
                layers.append(Layer(mixed(theme.velocity, theme.panel, 1 - _CHOSEN), [lit]))
            captions.append(Caption(label, (rect.x + _EDGE * size, top), size, theme.ink))
            if value:
                at = rect.right - _EDGE * size, top
                captions.append(Caption(value, at, size, theme.ink, "right", strong=is_chosen))
        targets = tuple(Target(kind, rect, (n, self)) for n, rect in enumerate(rects, start=-1))
        return Group("sheet-rows", layers, captions, over=True, targets=targets)
