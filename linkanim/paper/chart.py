"""Draw a chart on a page: curves with their legend, an axis for each unit or a column of strips.

Extremes are marked and labelled beside their dots; names of many curves stand at their ends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from linkanim.export import csv_head, csv_rows
from linkanim.frozen import frozen
from linkanim.paper.curves import Curve, Curves, MeasuredCurve, Peak, extremes, table
from linkanim.paper.illustration import DrawnPage, LegendEntry, legend
from linkanim.paper.sentences import about, without_subscripts
from linkanim.picture.chart import (
    Pen,
    Plot,
    asymptotes,
    axes,
    curve_layer,
    dot,
    marked,
    paths,
    right_axis,
    without_values,
    x_title,
)
from linkanim.picture.items import Caption, Halo, Item
from linkanim.picture.placing import Alternatives, chosen, crossed, grounded
from linkanim.picture.quantities import Axis, linear, range_around, zeros_level
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import segments
from linkanim.picture.view import Rect
from linkanim.units import stepped
from linkanim.words import said, said_as

# Words on a chart's curves: each extreme beside its dot, and at their ends the names of many curves.

_MOST = 6
"""The most curves that a legend alone names; where there are more, each has its name at its end."""
_LEAD = 1.2
"""The distance from a plot's edge to the names beside it, in heights of their text."""
_STEP = 1.15
"""The distance from one such name to the next, in the same heights."""
_ASIDE, _LEVELS = (0.6, 2.5, 5.0, 7.5, 10.0), (1.6, 2.8, 4.0, 5.2, 6.4, 7.6)
"""How far words may stand beside a dot, in heights of text, and above or below it, in their own heights."""
_FAR = 0.3
"""The cost of standing far off: lower than that of standing on their own curve."""
_DOT = 2.4
"""Half the room that a dot takes, in widths of a thin line."""
_CLOSE = 0.7
"""The distance from a dot, in heights of text, beyond which words have a line to it."""
_EVERY = 4
"""The steps between a curve's points that make one straight line, which words keep off."""


def named_at_ends(curves: Curves) -> bool:
    """Return whether a chart's curves are so many that a legend alone does not tell them apart."""
    return len(curves.curves) > _MOST


def room_for_names(curves: Curves, pen: Pen) -> float:
    """Return how much room beside a plot the names at the ends of its curves take; 0 for none."""
    if not named_at_ends(curves):
        return 0.0
    return max(pen.type.width(curves.name(curve), pen.small) for curve in curves.curves) + _LEAD * pen.small


def finer(pen: Pen) -> Pen:
    """Return the pen of dots on curves."""
    return replace(pen, line=0.6 * pen.line)


_Line = tuple[complex, complex]
InPlot = tuple[Plot, Curve]
"""A curve in the plot that it is drawn in."""


class _Words(NamedTuple):
    """Words about a place on a curve, and where they may stand."""

    curve: Curve
    at: complex
    text: str
    places: Alternatives
    dotted: bool = False

    def off_curves(self, tracks: list[tuple[Curve, _Line]], half: float) -> Alternatives:
        """Return its places, of which none covers another curve, and rather not its own."""
        places, size = self.places.places, self.places.size
        others = np.array([[line for curve, line in tracks if curve is not self.curve]]).reshape(1, -1, 2)
        own = np.array([[line for curve, line in tracks if curve is self.curve]]).reshape(1, -1, 2)
        faults = np.asarray(crossed(places, size, others, np.full(others.shape[1], half)).any(axis=2))
        covered = np.asarray(crossed(places, size, own, np.full(own.shape[1], half)).any(axis=2))[0]
        return self.places._replace(faults=faults, price=self.places.price + 2.0 * covered)


@frozen
class Annotations:
    """The words on the curves of a chart, with lines to them in the curves' colours."""

    curves: Curves
    pen: Pen
    colour: Callable[[Curve], Colour]
    points: tuple[complex, ...] = ()
    """Measured points (x + yi in pixels), which no word covers."""

    def items(self, drawn: Sequence[InPlot], marked: Sequence[InPlot]) -> Iterator[Item]:
        """Yield names of the `drawn` curves, in plots of one area, and extremes of the `marked` ones."""
        area, ends = drawn[0][0].area, []
        if named_at_ends(self.curves):
            ends = [end for pair in drawn for end in self._end(*pair)]
        at_edge = [end for end in ends if end.at.real > area.right - 1]
        yield from self._names_beside(area, at_edge)
        within = [end for end in ends if end not in at_edge]
        yield from self._named(drawn, [*within, *(peak for pair in marked for peak in self._peaks(*pair))])

    def _end(self, plot: Plot, curve: Curve) -> Iterator[_Words]:
        """Yield the name of a curve, to stand where the curve is furthest to the right."""
        places = plot.pixels(curve.x, np.where(np.isfinite(curve.values), curve.values, np.nan))
        known = places[np.isfinite(places)]
        if known.size:
            at, name = complex(known[known.real.argmax()]), self.curves.name(curve)
            yield _Words(curve, at, name, _about(at, name, self.pen, high=True))

    def _peaks(self, plot: Plot, curve: Curve) -> Iterator[_Words]:
        """Yield a curve's greatest and least value, in words."""
        for n, peak in enumerate(extremes(self.curves.scene, curve)):
            at, text = complex(plot.pixels(peak.x, peak.value)), _peak_words(plot, peak, self.curves, curve)
            yield _Words(curve, at, text, _about(at, text, self.pen, high=n == 0), dotted=True)

    def _names_beside(self, area: Rect, ends: list[_Words]) -> Iterator[Item]:
        """Yield names to the right of a plot, one per line, as near to their curves' ends as possible."""
        pen, step = self.pen, _STEP * self.pen.small
        shown = sorted(ends, key=lambda end: end.at.imag)[: max(int(area.height / step), 1)]
        levels = _apart([end.at.imag for end in shown], step, (area.y, area.bottom))
        for end, level in zip(shown, levels, strict=True):
            begin = complex(area.right + _LEAD * pen.small, level)
            line = segments(end.at, begin - 0.2 * pen.small, 0.6 * pen.line)
            yield Layer(self.colour(end.curve), line)
            yield Caption(end.text, (begin.real, level - 0.5 * pen.small), pen.small, pen.theme.ink)

    def _named(self, drawn: Sequence[InPlot], words: list[_Words]) -> Iterator[Item]:
        """Yield words where there is room, each with its dot and, where it is far off, a line to that."""
        pen, half = self.pen, 0.6 * self.pen.line
        tracks = [(curve, line) for plot, curve in drawn for line in _tracks(plot, curve)]
        to_place = [one.off_curves(tracks, half) for one in words]
        dots = [_around(one.at, _DOT * pen.line) for one in words if one.dotted]
        half_dot = 0.5 * _DOT * pen.line
        measured = [_around(at, half_dot) for at in _thinned(self.points, half_dot)]
        which = chosen(to_place, grounded(drawn[0][0].area, [*dots, *measured]))
        for one, n in zip(words, which, strict=True):
            size = one.places.size
            if n is not None and one.places.lines is not None:
                begin, end = one.places.lines[0, n, 0].tolist()
                if begin != end:
                    yield Layer(self.colour(one.curve), segments(one.at, end, 0.6 * pen.line))
            if one.dotted:
                yield from dot(self.colour(one.curve), finer(pen)).at([one.at])
            if n is not None:
                middle = complex(one.places.places[0, n])
                at = (middle.real - size[0] / 2, middle.imag - size[1] / 2)
                halo = Halo(pen.theme.background, 0.2 * pen.small)
                yield Caption(one.text, at, pen.small, pen.theme.ink, halo=halo)


def _apart(levels: Sequence[float], step: float, ends: tuple[float, float]) -> list[float]:
    """Return levels at least a step apart, in order between `ends`, each as near to its own as possible.

    Levels that are too near each other form a block about their mean (pool adjacent violators).
    """
    blocks: list[list[float]] = []
    for n, level in enumerate(levels):
        blocks.append([level - n * step])
        while len(blocks) > 1 and np.mean(blocks[-2]) > np.mean(blocks[-1]):
            blocks[-2:] = [blocks[-2] + blocks[-1]]
    last = ends[1] - (len(levels) - 1) * step
    feet = [max(min(float(np.mean(block)), last), ends[0]) for block in blocks for _ in block]
    return [foot + n * step for n, foot in enumerate(feet)]


def _around(at: complex, half: float) -> Rect:
    return Rect(at.real - half, at.imag - half, 2 * half, 2 * half)


def _thinned(points: Sequence[complex], apart: float) -> Iterator[complex]:
    """Yield points of which no two lie within one square of that side."""
    yield from {(round(at.real / apart), round(at.imag / apart)): at for at in points}.values()


def _peak_words(plot: Plot, peak: Peak, curves: Curves, curve: Curve) -> str:
    unit = "°" if curve.quantity.display_unit(curves.scene.length_unit) == "°" else ""
    value = f"{stepped(peak.value, (plot.y.high - plot.y.low) / 500)}{unit}"
    return said("{value} at {place}", value=value, place=curves.place_words(peak.x))


def _about(at: complex, text: str, pen: Pen, *, high: bool) -> Alternatives:
    """Return places for words about a place on a curve, with lines to those that are not close by.

    The words of a `high` place stand above it where they can, those of a low one below.
    """
    wide, tall = pen.type.width(text, pen.small), 1.15 * pen.small
    rows, up = (tall / 2 - 1.6 * pen.small, tall / 2 + 0.5 * pen.small), -1 if high else 1
    asides = [(side, off) for off in _ASIDE for side in (1, -1)]
    columns = [(0.0, 0.0), *((side * (wide / 2 + off * pen.small), off) for side, off in asides)]
    near = [complex(x, y) for y in rows[::-up] for x, _ in columns[:3]]
    far = [(complex(x, y), 0.3 * off) for y in (0.0, *rows) for x, off in columns[3:]]
    levels = [(n, side * n * tall) for n in _LEVELS for side in (up, -up)]
    far += [(complex(x, y), 0.35 * n + 0.3 * off) for n, y in levels for x, off in columns]
    offs = np.array([*near, *(off for off, _ in far)])
    price = _FAR * np.array([*(0.2 * np.arange(len(near))), *(1.0 + more for _, more in far)])
    # from the dot to the nearest point of the words
    away = np.maximum(np.abs(offs.real) - wide / 2, 0) * np.sign(offs.real)
    reach = away + 1j * np.maximum(np.abs(offs.imag) - tall / 2, 0) * np.sign(offs.imag)
    led = np.flatnonzero(np.abs(reach) > _CLOSE * pen.small)
    begins = 1.5 * _DOT * pen.line * reach[led] / np.abs(reach[led])
    lines = np.repeat((at + offs)[:, None], 2, axis=1)
    lines[led] = np.stack([at + begins, at + reach[led]], axis=1)
    return Alternatives((wide, tall), at + offs[None], price, lines=lines[None, :, None])


def _tracks(plot: Plot, curve: Curve) -> Iterator[_Line]:
    """Yield a curve in short straight lines."""
    for path in paths(plot, curve.x, curve.values):
        points = path[np.r_[0 : len(path) - 1 : _EVERY, len(path) - 1]]
        yield from pairwise(points.tolist())


# A chart on a page: curves with their legend, extremes marked, one axis a unit or a column of strips.

_TOGETHER = 2
"""The most units that share one plot, with an axis at either side; of more, each has a strip of its own."""
_ROOM = 0.13
"""The room above and below a curve for its extremes, as a share of its span."""
_BELOW = 0.8
"""The room below each plot, in heights of tick labels."""
_DASHES = ((), (7.0, 3.0), (2.0, 2.5), (9.0, 3.0, 2.0, 3.0), (4.0, 2.0), (12.0, 4.0))
"""The dashes and gaps of curves that share a plot, in widths of a line; the first is whole."""
_FEWEST = 4
"""The fewest ticks of an axis, unless a plot is too low for their labels."""
_THINNEST = 0.9
"""The least width of a line in a small chart, in pixels."""
_WIDTH = 1.2
"""How wide a curve is, in thin lines."""
_LABELS = 5.0
"""How wide an axis' labels may be, in heights of their text."""
_APART = 1.6
"""The distance between the entries of a legend, in heights of their text."""
_LINE, _LIFT = 1.5, 0.2
"""From line to line, and from a line's top to its words, in heights of their text."""


@frozen
class Page(DrawnPage):
    """A chart on a page of its size in pixels."""

    curves: Curves
    measured: MeasuredCurve | None = None
    brief: bool = False
    """Whether it is small, beside words that say the rest: no title, only symbols, one curve's extremes."""

    @cached_property
    def pen(self) -> Pen:
        """What it is drawn with."""
        pen = super().pen
        return replace(pen, line=max(pen.line, _THINNEST)) if self.brief else pen

    @property
    def title(self) -> str:
        """What it shows, in words."""
        words = dict.fromkeys(curve.quantity.words for curve in self.curves.curves)
        title = said(self.curves.scene.title)
        return said("{title}: {part}", title=title, part=said_as("list", ", ").join(words))

    @property
    def words(self) -> str:
        """Where its curves are greatest, least and zero."""
        return without_subscripts(about(self.curves))

    def csv(self) -> str:
        """Return the curves as a table."""
        names, columns = table(self.curves)
        return csv_head(names) + csv_rows(columns)

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        pen, whole = self.pen, Rect(0, 0, *self.size).inset(20 * self.pen.line / 1.8)
        if not self.brief:
            title = said(self.curves.scene.title)
            yield Caption(title, (whole.x, whole.y), pen.text, pen.theme.ink, strong=True)
        entries = self._legend()
        rows = list(_rows(entries, whole.width, pen)) if len(entries) > 1 else []
        top = whole.y + (0 if self.brief else _LINE * pen.text)
        if self.brief and len(rows) == 1 and len(_by_unit(self.curves)) == 1:
            left = whole.right + _APART * pen.small - sum(entry.wide(pen, _APART) for entry in entries)
            wide = pen.type.width(self._y_title(self.curves.curves), pen.small)
            if left > whole.x + _LABELS * pen.small + wide:  # beside the axis' title
                yield from legend(left, top + _LIFT * pen.small, rows.pop(), pen, _APART)
        for n, row in enumerate(rows):
            yield from legend(whole.x, top + n * _LINE * pen.small, row, pen, _APART)
        below = top + len(rows) * _LINE * pen.small
        yield from self._plots(whole._replace(y=below, height=whole.bottom - below))

    def _legend(self) -> list[LegendEntry]:
        """Return the entries of the legend, less what the axes say; a curve alone in its strip has none."""
        measured = self.measured and self.measured.curve
        words = self.curves.name if self.brief or self._worded else self.curves.words
        entries = [
            LegendEntry(words(curve), self.colour(curve), _WIDTH, self.dashes(curve))
            for group in _by_unit(self.curves)
            for curve in group
            if not self._in_strips or len(group) > 1 or curve is measured
        ]
        if self.measured:
            entries.append(LegendEntry(self.measured.label, self.pen.theme.ink, dotted=True))
        return entries

    @property
    def _in_strips(self) -> bool:
        """Whether each unit has a plot of its own."""
        return len(_by_unit(self.curves)) > _TOGETHER or named_at_ends(self.curves)

    @property
    def _worded(self) -> bool:
        """Whether the one quantity of all curves stands in words at the axis."""
        return len({curve.quantity.token for curve in self.curves.curves}) == 1

    def colour(self, curve: Curve) -> Colour:
        """Return the colour of a curve: colours repeat where there are more curves than the theme has."""
        theme = self.pen.theme
        colours = (theme.velocity, theme.acceleration, *theme.traces[1::-1], *theme.bodies[3:])
        palette = tuple(dict.fromkeys(colours))
        return palette[self.curves.curves.index(curve) % len(palette)]

    def dashes(self, curve: Curve) -> tuple[float, ...]:
        """Return the dashes of a curve among those of its plot; they repeat, too."""
        side = next(group for group in _by_unit(self.curves) if curve in group)
        together = side if self._in_strips else self.curves.curves
        return _DASHES[together.index(curve) % len(_DASHES)]

    def _plots(self, rect: Rect) -> Iterator[Item]:
        """Yield the plots one below the other over one common axis."""
        pen, groups = self.pen, _by_unit(self.curves)
        columns = [[group] for group in groups] if self._in_strips else [groups]
        foot = (2 * _LINE - _BELOW) * pen.small
        high = (rect.height - foot) / len(columns)
        tall = max(high - (_LINE + _BELOW) * pen.small, 1)
        edges = [max(edge) for edge in zip(*(self._margins(sides, tall) for sides in columns), strict=True)]
        x = self.curves.axis(max(min(round(rect.width / (5 * pen.small)), 12), 2), _FEWEST)
        for n, sides in enumerate(columns):
            last = n == len(columns) - 1
            top = rect.y + n * high + _LINE * pen.small
            area = Rect(rect.x + edges[0], top, max(rect.width - sum(edges), 1), tall)
            yield from self._plot(area, x if last else x.unlabelled, sides)
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
        """Return the vertical axes of a plot, one for each unit; two that contain 0 have it at one height."""
        if not any(np.isfinite(curve.values).any() for side in sides for curve in side):
            return [Axis(0.0, 1.0, ()) for _ in sides]
        ranges = [_range_of(side) for side in sides]
        if len(ranges) == _TOGETHER and all(low < 0 < high for low, high in ranges):
            ranges = zeros_level(ranges)
        most = max(min(round(high / (2.0 * self.pen.small)), 6), 3)
        units = [side[0].quantity.display_unit(self.curves.scene.length_unit) for side in sides]
        least = _FEWEST if high > (_FEWEST + 1) * self.pen.small else 0
        return [
            linear(*ends, most=most, unit=unit, least=least) for ends, unit in zip(ranges, units, strict=True)
        ]

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
            yield from asymptotes(plot, curve.x, curve.values, self.colour(curve), pen)
            width = _WIDTH * pen.line
            yield curve_layer(plot, curve.x, curve.values, self.colour(curve), width, self.dashes(curve))
        yield from without_values(plots[0], [curve.values for _, curve in drawn], pen)
        points = self._points(plots[0], sides[0])
        extremes_of = [(plot, curve) for plot, side in pairs for curve in self._marked(side)]
        yield from Annotations(self.curves, pen, self.colour, points).items(drawn, extremes_of)
        yield from dot(pen.theme.ink, finer(pen)).at(points)

    def _points(self, plot: Plot, side: list[Curve]) -> tuple[complex, ...]:
        """Return where measured points lie in a plot, if any do."""
        if not self.measured or self.measured.curve not in side:
            return ()
        return tuple(complex(plot.pixels(*point)) for point in self.measured.points)

    def _y_titles(self, area: Rect, sides: list[list[Curve]]) -> Iterator[Item]:
        pen, top = self.pen, area.y - (_LINE - _LIFT) * self.pen.small
        ends = (("left", area.x), ("right", area.right))
        for side, (anchor, x) in zip(sides, ends, strict=False):
            words = self._y_title(side)
            yield Caption(words, (x, top), pen.small, pen.theme.ink, "right" if anchor == "right" else "left")

    def _y_title(self, side: Sequence[Curve]) -> str:
        """Return the title of a vertical axis: in words where it has one quantity, else in symbols."""
        known = list(dict.fromkeys(curve.quantity for curve in side))
        unit = self.curves.scene.length_unit
        if len(known) == 1 and not self.brief and (self._worded or self._in_strips):
            return known[0].title(unit)
        shown = known[0].display_unit(unit)
        if self.brief and len(known) > 1 and shown:
            return f"({shown})"
        return ", ".join(one.symbol for one in known) + (f" ({shown})" if shown else "")

    def _marked(self, side: list[Curve]) -> list[Curve]:
        """Return the curves whose extremes are written: if `brief`, the one of greatest range, if any."""
        if not self.brief:
            return side
        one = len({curve.quantity.token for curve in self.curves.curves}) == 1
        return [max(side, key=lambda curve: float(np.ptp(curve.values)))] if one else []


def _range_of(side: list[Curve]) -> tuple[float, float]:
    """Return the range (low, high) of the axis that the curves of one side share."""
    if any(np.isinf(curve.values).any() for curve in side):
        ranges = [range_around(curve.values, _ROOM) for curve in side if np.isfinite(curve.values).any()]
        return (min(low for low, _ in ranges), max(high for _, high in ranges)) if ranges else (0.0, 1.0)
    return range_around(np.concatenate([curve.values for curve in side]), _ROOM)


def _zero(plot: Plot, pen: Pen) -> Iterator[Layer]:
    """Yield the line of zero where it lies in the plot."""
    if plot.y.low < 0 < plot.y.high:
        foot = complex(plot.pixels(plot.x.low, 0.0))
        yield Layer(pen.theme.dim, segments(foot, foot + plot.area.width, 0.6 * pen.line))


def _by_unit(curves: Curves) -> list[list[Curve]]:
    """Return the curves in groups of one unit, in their order."""
    groups: dict[str, list[Curve]] = {}
    for curve in curves.curves:
        groups.setdefault(curve.quantity.unit, []).append(curve)
    return list(groups.values())


def _rows(entries: list[LegendEntry], width: float, pen: Pen) -> Iterator[list[LegendEntry]]:
    """Yield a legend's entries in lines no wider than the page."""
    row: list[LegendEntry] = []
    for entry in entries:
        if row and sum(other.wide(pen, _APART) for other in (*row, entry)) > width:
            yield row
            row = []
        row.append(entry)
    yield row
