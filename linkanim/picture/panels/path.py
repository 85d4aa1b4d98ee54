"""A path that is drawn: the sheet, the pencil's line, and then the stroke behind its trace, with handles."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np
import pygame

from linkanim.picture.diagrams.axis import round_step
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group
from linkanim.picture.layout import Layout
from linkanim.picture.panels.overlay import PathShown
from linkanim.picture.raster.raster import Layer, Loop, paint
from linkanim.picture.raster.shapes import disc, segments, stroke
from linkanim.picture.theme import ORANGE, Theme, mixed
from linkanim.picture.view import View

HINT = "draw a path in one stroke"
SHEET = "sheet"
"""The name of the group that is drawn on."""
_GRID = 36
"""The least distance of the sheet's lines, in units."""
_DASH, _GAP = 3.2, 2.2
"""Along the stroke, in its widths."""
_HANDLES = 12
"""Points of a stroke that are marked; every one can be dragged."""


def sheet(setting: DrawSetting) -> Group:
    """Return the empty sheet: lines at round distances in the scene's unit."""
    view, layout, theme = setting.view, setting.layout, setting.theme
    width, height = layout.size
    step = view.scale * grid_step(view, layout)
    x, y = (np.arange(start % step, end, step) for start, end in ((view.x, width), (view.y, height)))
    lines = [*segments(x, x + 1j * height, 1.0), *segments(1j * y, width + 1j * y, 1.0)]
    return Group(SHEET, [Layer(mixed(theme.rule, theme.background, 0.4), lines)], still=True)


def grid_step(view: View, layout: Layout) -> float:
    """Return how far the sheet's lines are apart, in the scene's unit."""
    return round_step(_GRID * layout.unit / view.scale, 1)


def pencil(layout: Layout, theme: Theme) -> pygame.Surface:
    """Return a pencil to point with, its tip in the lower left corner."""
    size = round(max(30 * layout.unit, 20.0))
    sheet = pygame.Surface((size, size), pygame.SRCALPHA, 32)
    along, wide = (size - 4) * (1 - 1j) / 1.414, 0.13 * size * (1 + 1j) / 1.414
    tip, neck, end = complex(1.5, size - 1.5), 0.3 * along, 0.9 * along
    rim = np.array([0, neck + wide, end + wide, end - wide, neck - wide])
    layers = [
        Layer(theme.background, stroke(tip + rim, 3.0, closed=True)),
        Layer(theme.ink, [tip + rim]),
        Layer(ORANGE, [tip + np.array([neck, end]).repeat(2) + 0.6 * wide * np.array([1, -1, -1, 1])]),
    ]
    paint(sheet, layers)
    return sheet


def drawn_line(setting: DrawSetting, shown: PathShown) -> Group:
    """Return the pencil's line, or the stroke while nothing follows it; words where there is neither."""
    points = (
        np.array(shown.pen) if shown.pen else shown.curve.polyline if shown.curve else np.zeros(0, complex)
    )
    layout, theme, size = setting.layout, setting.theme, setting.layout.text_size
    if not points.size:
        at = layout.size[0] / 2, layout.size[1] / 2 - size
        return Group("pencil", (), [Caption(HINT, at, size, theme.dim, "centre")])
    line = stroke(_placed(setting.view, points), max(2.6 * layout.unit, 1.6))
    return Group("pencil", [Layer(theme.ink, line)])


def dashed(setting: DrawSetting, shown: PathShown) -> Group:
    """Return the stroke in dashes, wider than a trace."""
    assert shown.curve
    width, theme = 2.6 * setting.gauge.line, setting.theme
    line = _placed(setting.view, shown.curve.polyline)
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(line)))])
    count = max(ceil(way[-1] / ((_DASH + _GAP) * width)), 1)
    ends = np.arange(count) * (way[-1] / count) + np.array([[0.0], [_DASH * width]])
    begin, end = np.interp(ends, way, line.real) + 1j * np.interp(ends, way, line.imag)
    loops = segments(begin, end, width)
    return Group("stroke", [Layer(mixed(theme.ink, theme.background, 0.55), loops)], still=True)


def handles(setting: DrawSetting, shown: PathShown) -> Iterator[Layer]:
    """Yield the marked points of a stroke, the one that is held, and rings about pivots that are held."""
    assert shown.curve
    _, view, gauge, theme = setting.known
    points, reach = _placed(view, shown.curve.points), 0.55 * gauge.bar
    marked = points[:: max(len(points) // _HANDLES, 1)]
    yield Layer(theme.ink, [at + disc(reach) for at in marked])
    yield Layer(theme.background, [at + disc(0.6 * reach) for at in marked])
    if shown.held is not None:
        yield Layer(theme.velocity, [points[shown.held] + disc(1.5 * reach)])
    for pin in shown.pins:
        ring = view.place(pin) + disc(2.6 * gauge.bar)
        yield Layer(theme.velocity, stroke(ring, 1.6 * gauge.line, closed=True))


def _placed(view: View, points: Loop) -> Loop:
    return view.x + view.scale * points.real + 1j * (view.y - view.scale * points.imag)
