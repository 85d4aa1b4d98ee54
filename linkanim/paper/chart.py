"""A chart on a page: curves with their legend, extremes marked, one axis a unit or a column of strips."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import pygame

from linkanim.paper.annotations import Annotations, finer, named_at_ends, room_for_names
from linkanim.paper.curves import Curve, Curves
from linkanim.paper.measured import MeasuredCurve
from linkanim.picture.diagrams.axis import Axis, linear, range_around, zeros_level
from linkanim.picture.diagrams.chart import (
    Pen,
    Plot,
    axes,
    curve_layer,
    dot,
    line_layer,
    marked,
    pen_for,
    right_axis,
    x_title,
)
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import layout
from linkanim.picture.look import ThemeName
from linkanim.picture.raster.offscreen import offscreen
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import disc, segments
from linkanim.picture.surface import printed
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect

_TOGETHER = 2
"""So many units share one plot, with an axis at either side; of more each has a strip of its own."""
_ROOM = 0.13
"""Of a curve's span, above and below it, where its extremes are written."""
_BELOW = 0.8
"""Below each plot, in heights of tick labels."""
_DASHES = ((), (7.0, 3.0), (2.0, 2.5), (9.0, 3.0, 2.0, 3.0), (4.0, 2.0), (12.0, 4.0))
"""The dashes and gaps of curves that share a plot, in widths of a line; the first is whole."""
_THINNEST = 0.9
"""A line of a small chart, in pixels."""
_WIDTH = 1.2
"""How wide a curve is, in thin lines."""
_LABELS = 5.0
"""How wide an axis' labels may be, in heights of their text."""
_APART = 1.6
"""Between the entries of a legend, in heights of their text."""
_LINE, _LIFT = 1.5, 0.2
"""From line to line, and from a line's top to its words, in heights of their text."""


@dataclass(frozen=True)
class Page:
    """A chart of so many pixels."""

    curves: Curves
    size: tuple[int, int]
    theme: ThemeName = "light"
    measured: MeasuredCurve | None = None
    brief: bool = False
    """Small, beside words that say the rest: no title, symbols for words, extremes of one curve alone."""

    @cached_property
    def pen(self) -> Pen:
        """What it is drawn with."""
        pen = pen_for(layout(self.size), Type(), theme_of(self.theme))
        return replace(pen, line=max(pen.line, _THINNEST)) if self.brief else pen

    @property
    def background(self) -> Colour:
        """The colour under everything."""
        return self.pen.theme.background

    def surface(self) -> pygame.Surface:
        """Return the chart drawn."""
        surface = offscreen(self.size)
        surface.fill(self.background)
        printed(surface, self.groups(), self.pen.type)
        return surface

    @property
    def title(self) -> str:
        """What it shows, in words."""
        words = dict.fromkeys(curve.quantity.words for curve in self.curves.curves)
        return f"{self.curves.scene.title}: {', '.join(words)}"

    def groups(self) -> tuple[Group, ...]:
        """Return everything on the page, words over shapes."""
        return (grouped("chart", self.items()),)

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        pen, whole = self.pen, Rect(0, 0, *self.size).inset(20 * self.pen.line / 1.8)
        if not self.brief:
            title = self.curves.scene.title
            yield Caption(title, (whole.x, whole.y), pen.text, pen.theme.ink, strong=True)
        entries = self._legend()
        rows = list(_rows(entries, whole.width, pen)) if len(entries) > 1 else []
        top = whole.y + (0 if self.brief else _LINE * pen.text)
        if self.brief and len(rows) == 1 and len(_by_unit(self.curves)) == 1:
            left = whole.right + _APART * pen.small - sum(_wide(entry, pen) for entry in entries)
            wide = pen.type.width(self._y_title(self.curves.curves), pen.small)
            if left > whole.x + _LABELS * pen.small + wide:  # beside the axis' title
                yield from _legend_row(rows.pop(), left, top + _LIFT * pen.small, pen)
        for n, row in enumerate(rows):
            yield from _legend_row(row, whole.x, top + n * _LINE * pen.small, pen)
        below = top + len(rows) * _LINE * pen.small
        yield from self._plots(whole._replace(y=below, height=whole.bottom - below))

    def _legend(self) -> list[_Entry]:
        words = self.curves.name if self.brief else self.curves.words
        entries = [
            _Entry(words(curve), self.colour(curve), self.dashes(curve)) for curve in self.curves.curves
        ]
        if self.measured:
            entries.append(_Entry(self.measured.label, self.pen.theme.ink, dotted=True))
        return entries

    def colour(self, curve: Curve) -> Colour:
        """Return the colour of a curve: after the theme's they repeat."""
        theme = self.pen.theme
        colours = (theme.velocity, theme.acceleration, *theme.traces[1::-1], *theme.bodies[3:])
        palette = tuple(dict.fromkeys(colours))
        return palette[self.curves.curves.index(curve) % len(palette)]

    def dashes(self, curve: Curve) -> tuple[float, ...]:
        """Return the dashes of a curve; they repeat as well."""
        return _DASHES[self.curves.curves.index(curve) % len(_DASHES)]

    def _plots(self, rect: Rect) -> Iterator[Item]:
        """Yield the plots one below the other over one common axis."""
        pen, groups = self.pen, _by_unit(self.curves)
        many = len(groups) > _TOGETHER or named_at_ends(self.curves)
        columns = [[group] for group in groups] if many else [groups]
        foot = (2 * _LINE - _BELOW) * pen.small
        high = (rect.height - foot) / len(columns)
        tall = max(high - (_LINE + _BELOW) * pen.small, 1)
        edges = [max(edge) for edge in zip(*(self._margins(sides, tall) for sides in columns), strict=True)]
        x = self.curves.axis(max(min(round(rect.width / (5 * pen.small)), 12), 2))
        for n, sides in enumerate(columns):
            last = n == len(columns) - 1
            top = rect.y + n * high + _LINE * pen.small
            area = Rect(rect.x + edges[0], top, max(rect.width - sum(edges), 1), tall)
            yield from self._plot(area, x if last else _unlabelled(x), sides)
            if last:
                yield x_title(Plot(area, x, self._axes(sides, tall)[0]), self.curves.title, pen)

    def _margins(self, sides: list[list[Curve]], high: float) -> tuple[float, float]:
        """Return how much room the tick labels at either side take."""
        pen = self.pen
        wide = [
            max((pen.type.width(label, pen.small) for _, label in axis.ticks), default=0)
            for axis in self._axes(sides, high)
        ]
        right = (wide[1] if len(wide) > 1 else 0) + 1.4 * pen.small
        return wide[0] + 0.6 * pen.small, max(right, room_for_names(self.curves, pen))

    def _axes(self, sides: list[list[Curve]], high: float) -> list[Axis]:
        """Return the vertical axes of a plot, a unit each; two about zero have it at one height."""
        ranges = [range_around(np.concatenate([curve.values for curve in side]), _ROOM) for side in sides]
        if len(ranges) == _TOGETHER and all(low < 0 < high for low, high in ranges):
            ranges = zeros_level(ranges)
        most = max(min(round(high / (2.0 * self.pen.small)), 6), 3)
        units = [side[0].quantity.shown_unit(self.curves.scene.length_unit) for side in sides]
        return [linear(*ends, most=most, unit=unit) for ends, unit in zip(ranges, units, strict=True)]

    def _plot(self, area: Rect, x: Axis, sides: list[list[Curve]]) -> Iterator[Item]:
        pen = self.pen
        plots = [Plot(area, x, axis) for axis in self._axes(sides, area.height)]
        yield from axes(plots[0], pen)
        yield from self._y_titles(area, sides)
        if len(plots) > 1:
            yield from right_axis(plots[1], pen)
        yield from _zero(plots[0], pen)
        first = sides[0][0]
        heights = np.interp([place for place, _ in self.curves.marks], first.x, first.values)
        yield from marked(plots[0], self.curves.marks, heights, pen)
        pairs = list(zip(plots, sides, strict=True))
        drawn = [(plot, curve) for plot, side in pairs for curve in side]
        for plot, curve in drawn:
            width = _WIDTH * pen.line
            yield curve_layer(plot, curve.x, curve.values, self.colour(curve), width, self.dashes(curve))
        if self.measured and self.measured.curve in sides[0]:
            places = [complex(plots[0].place(*point)) for point in self.measured.points]
            yield from dot(pen.theme.ink, finer(pen)).at(places)
        extremes_of = [(plot, curve) for plot, side in pairs for curve in self._marked(side)]
        yield from Annotations(self.curves, pen, self.colour).items(drawn, extremes_of)

    def _y_titles(self, area: Rect, sides: list[list[Curve]]) -> Iterator[Item]:
        pen, top = self.pen, area.y - (_LINE - _LIFT) * self.pen.small
        ends = (("left", area.x), ("right", area.right))
        for side, (anchor, x) in zip(sides, ends, strict=False):
            words = self._y_title(side)
            yield Caption(words, (x, top), pen.small, pen.theme.ink, "right" if anchor == "right" else "left")

    def _y_title(self, side: Sequence[Curve]) -> str:
        """Return what a vertical axis is titled: in words where it has one quantity, else in symbols."""
        known = list(dict.fromkeys(curve.quantity for curve in side))
        unit = self.curves.scene.length_unit
        if len(known) == 1 and not self.brief:
            return known[0].title(unit)
        shown = known[0].shown_unit(unit)
        if self.brief and len(known) > 1 and shown:
            return f"({shown})"
        return ", ".join(one.symbol for one in known) + (f" ({shown})" if shown else "")

    def _marked(self, side: list[Curve]) -> list[Curve]:
        """Return the curves whose extremes are told: in brief the one that goes farthest, of one quantity."""
        if not self.brief:
            return side
        one = len({curve.quantity.token for curve in self.curves.curves}) == 1
        return [max(side, key=lambda curve: float(np.ptp(curve.values)))] if one else []


def _zero(plot: Plot, pen: Pen) -> Iterator[Layer]:
    """Yield the line of zero where it lies in the plot."""
    if plot.y.low < 0 < plot.y.high:
        foot = complex(plot.place(plot.x.low, 0.0))
        yield Layer(pen.theme.dim, segments(foot, foot + plot.area.width, 0.6 * pen.line))


def _unlabelled(axis: Axis) -> Axis:
    return replace(axis, ticks=tuple((value, "") for value, _ in axis.ticks))


def _by_unit(curves: Curves) -> list[list[Curve]]:
    """Return the curves in groups of one unit, in their order."""
    groups: dict[str, list[Curve]] = {}
    for curve in curves.curves:
        groups.setdefault(curve.quantity.unit, []).append(curve)
    return list(groups.values())


class _Entry(NamedTuple):
    """A line or a dot of a legend, and what it stands for."""

    words: str
    colour: Colour
    dashes: tuple[float, ...] = ()
    dotted: bool = False


def _swatch(pen: Pen) -> float:
    return 2.6 * pen.small


def _wide(entry: _Entry, pen: Pen) -> float:
    return _swatch(pen) + 0.5 * pen.small + pen.type.width(entry.words, pen.small) + _APART * pen.small


def _rows(entries: list[_Entry], width: float, pen: Pen) -> Iterator[list[_Entry]]:
    """Yield a legend's entries in lines no wider than the page."""
    row: list[_Entry] = []
    for entry in entries:
        if row and sum(_wide(other, pen) for other in (*row, entry)) > width:
            yield row
            row = []
        row.append(entry)
    yield row


def _legend_row(row: list[_Entry], x: float, y: float, pen: Pen) -> Iterator[Item]:
    for entry in row:
        start = complex(x, y + 0.5 * pen.small)
        way = [start + np.array([0, _swatch(pen)])]
        line = line_layer(way, entry.colour, _WIDTH * pen.line, entry.dashes)
        dot = Layer(entry.colour, [start + _swatch(pen) / 2 + disc(1.8 * pen.line)])
        yield dot if entry.dotted else line
        yield Caption(entry.words, (x + _swatch(pen) + 0.5 * pen.small, y), pen.small, pen.theme.ink)
        x += _wide(entry, pen)
