"""Rows of words on the sheet: the numbers of the chosen shape, and what a gesture can mean."""

from __future__ import annotations

from collections.abc import Iterator

from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Target
from linkanim.picture.layout import Layout
from linkanim.picture.overlay import RowsShown
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import box
from linkanim.picture.theme import mixed
from linkanim.picture.view import Rect, View

_HIGH, _LETTER, _EDGE = 1.5, 0.56, 0.7
"""The height of a row, the width of a letter and the margin beside the words, in heights of text."""
_ASIDE = 1.4
"""How far right of and below its place a list stands, in heights of text."""
_CHOSEN = 0.35


def row_rects(layout: Layout, view: View, shown: RowsShown) -> tuple[Rect, ...]:
    """Return where the rows of a list are, its title's first: beside its place, else at the upper right."""
    size, stage = layout.small_size, layout.stage
    letters = max(len(shown.title), *(len(label) + len(value) + 2 for label, value in shown.rows), 1)
    wide, high = (_LETTER * letters + 2 * _EDGE) * size, _HIGH * size
    tall = high * (1 + len(shown.rows))
    x, y = stage.right - layout.margin - wide, stage.y + layout.margin + 2 * layout.text_size
    if shown.at:
        x, y = (at + _ASIDE * size for at in view.to_pixel(*shown.at))
        x = max(min(x, stage.right - layout.margin - wide), stage.x)
        y = max(min(y, stage.bottom - layout.margin - tall), stage.y)
    return tuple(Rect(x, y + n * high, wide, high) for n in range(1 + len(shown.rows)))


def rows(kind: str, shown: RowsShown, setting: DrawSetting) -> Iterator[Group]:
    """Yield a list of a kind, as its targets have it: its title, and its rows with the chosen one lit."""
    layout, theme, size = setting.layout, setting.theme, setting.layout.small_size
    rects = row_rects(layout, setting.view, shown)
    first, last = rects[0], rects[-1]
    middle = complex(first.x + first.width / 2, (first.y + last.bottom) / 2)
    high, corner, line = last.bottom - first.y, 0.4 * size, max(1.2 * layout.unit, 1.0)
    layers = [
        Layer(theme.rule, [middle + box(first.width + 2 * line, high + 2 * line, corner + line)]),
        Layer(theme.panel, [middle + box(first.width, high, corner)]),
    ]
    captions = [Caption(shown.title, (first.x + _EDGE * size, first.y + 0.25 * size), size, theme.dim)]
    for n, ((label, value), rect) in enumerate(zip(shown.rows, rects[1:], strict=True)):
        is_chosen, top = n == shown.chosen, rect.y + 0.25 * size
        if is_chosen:
            lit = rect.middle + box(rect.width - 0.4 * size, rect.height, 0.3 * size)
            layers.append(Layer(mixed(theme.velocity, theme.panel, 1 - _CHOSEN), [lit]))
        captions.append(Caption(label, (rect.x + _EDGE * size, top), size, theme.ink))
        if value:
            at = rect.right - _EDGE * size, top
            captions.append(Caption(value, at, size, theme.ink, "right", strong=is_chosen))
    targets = tuple(Target(kind, rect, n) for n, rect in enumerate(rects, start=-1))
    yield Group("sheet-rows", layers, captions, over=True, targets=targets)
