"""Words on a chart's curves: each extreme beside its dot, and at their ends the names of many curves."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import radians
from typing import NamedTuple

import numpy as np

from linkanim.digits import short, stepped, typeset
from linkanim.paper.curves import Curve, Curves, Peak, extremes
from linkanim.picture.diagrams.chart import Pen, Plot, dot
from linkanim.picture.items import Caption, Item
from linkanim.picture.parts.driven import driven_words
from linkanim.picture.placing import Clutter, LabelPlaces, Solid, place
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import box, segments
from linkanim.picture.view import Rect

_MOST = 6
"""More curves than so many have names at their ends."""
_LEAD = 1.2
"""From a plot's edge to the names beside it, in heights of their text."""
_STEP = 1.15
"""From one such name to the next, likewise."""
_ASIDE, _LEVELS = (0.6, 2.5, 5.0), (1.6, 2.8, 4.0, 5.2)
"""How far aside of a dot, in heights of their text, and above or below it, in their own, words may stand."""
_DOT = 2.4
"""Half of what a dot takes, in widths of a thin line."""
_CLOSE = 0.7
"""Words about a dot that are farther from it, in their heights, have a line to it."""
_EVERY = 4
"""So many of a curve's points make a straight line that words keep off."""


def named_at_ends(curves: Curves) -> bool:
    """Whether a chart's curves are so many that a legend alone does not tell them apart."""
    return len(curves.curves) > _MOST


def room_for_names(curves: Curves, pen: Pen) -> float:
    """Return how much room beside a plot the names at the ends of its curves take; 0 for none."""
    if not named_at_ends(curves):
        return 0.0
    return max(pen.type.width(curves.name(curve), pen.small) for curve in curves.curves) + _LEAD * pen.small


def finer(pen: Pen) -> Pen:
    """Return the pen of dots on curves."""
    return replace(pen, line=0.6 * pen.line)


InPlot = tuple[Plot, Curve]
"""A curve in the plot that it is drawn in."""


class _Words(NamedTuple):
    """Words about a place on a curve, and where they may stand."""

    curve: Curve
    at: complex
    text: str
    places: LabelPlaces
    dotted: bool = False


@dataclass(frozen=True)
class Annotations:
    """What is written on the curves of a chart, in the colours that they have."""

    curves: Curves
    pen: Pen
    colour: Callable[[Curve], Colour]

    def items(self, drawn: Sequence[InPlot], marked: Sequence[InPlot]) -> Iterator[Item]:
        """Yield names of the curves in plots of one area, and extremes of those marked, off other curves."""
        area, ends = drawn[0][0].area, []
        if named_at_ends(self.curves):
            ends = [end for pair in drawn for end in self._end(*pair)]
        at_edge = [end for end in ends if end.at.real > area.right - 1]
        yield from self._beside(area, at_edge)
        within = [end for end in ends if end not in at_edge]
        yield from self._placed(drawn, [*within, *(peak for pair in marked for peak in self._peaks(*pair))])

    def _end(self, plot: Plot, curve: Curve) -> Iterator[_Words]:
        """Yield the name of a curve, to stand where it is furthest to the right."""
        places = plot.place(curve.x, np.where(np.isfinite(curve.values), curve.values, np.nan))
        known = places[np.isfinite(places)]
        if known.size:
            at, name = complex(known[known.real.argmax()]), self.curves.name(curve)
            yield _Words(curve, at, name, _about(at, name, self.pen, high=True))

    def _peaks(self, plot: Plot, curve: Curve) -> Iterator[_Words]:
        """Yield a curve's greatest and least value, in words."""
        for n, peak in enumerate(extremes(self.curves.scene, curve)):
            at, text = complex(plot.place(peak.x, peak.value)), _peak_words(plot, peak, self.curves, curve)
            yield _Words(curve, at, text, _about(at, text, self.pen, high=n == 0), dotted=True)

    def _beside(self, area: Rect, ends: list[_Words]) -> Iterator[Item]:
        """Yield names to the right of a plot, as near to their curves' ends as leaves each its line."""
        pen, step = self.pen, _STEP * self.pen.small
        shown = sorted(ends, key=lambda end: end.at.imag)[: max(int(area.height / step), 1)]
        levels = _apart([end.at.imag for end in shown], step, (area.y, area.bottom))
        for end, level in zip(shown, levels, strict=True):
            begin = complex(area.right + _LEAD * pen.small, level)
            line = segments(end.at, begin - 0.2 * pen.small, 0.6 * pen.line)
            yield Layer(self.colour(end.curve), line)
            yield Caption(end.text, (begin.real, level - 0.5 * pen.small), pen.small, pen.theme.ink)

    def _placed(self, drawn: Sequence[InPlot], words: list[_Words]) -> Iterator[Item]:
        """Yield words where there is room to say them, each with its dot and, from afar, a line to it."""
        pen, half = self.pen, 0.6 * self.pen.line
        tracks = [(curve, line) for plot, curve in drawn for line in _tracks(plot, curve, half)]
        own = {
            id(curve): frozenset(n for n, (owner, _) in enumerate(tracks) if owner is curve)
            for _, curve in drawn
        }
        to_place = [one.places._replace(beside=own[id(one.curve)]) for one in words]
        dots = tuple(_around(one.at, _DOT * pen.line) for one in words if one.dotted)
        clutter = Clutter(drawn[0][0].area, dots, tuple(line for _, line in tracks))
        for one, spot in zip(words, place(to_place, clutter), strict=True):
            size, middle = one.places.size, complex(one.places.places[0, spot.which])
            lead = -1 if one.places.drawn is None else int(one.places.drawn[spot.which])
            if spot.shown[0] and lead >= 0:
                end = one.places.lines[lead][0, 0, 1]
                yield Layer(self.colour(one.curve), segments(one.at, end, 0.6 * pen.line))
            if one.dotted:
                yield from dot(self.colour(one.curve), finer(pen)).at([one.at])
            if spot.shown[0]:
                yield Layer(pen.theme.background, [middle + box(size[0] + 4, size[1], 3)], 0.7)
                at = (middle.real - size[0] / 2, middle.imag - size[1] / 2)
                yield Caption(one.text, at, pen.small, pen.theme.ink)


def _apart(levels: Sequence[float], step: float, ends: tuple[float, float]) -> list[float]:
    """Return levels in order a step apart and more, between ends, each as near to its own as can be.

    Those that are too near make a block about their mean (pool adjacent violators).
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


def _peak_words(plot: Plot, peak: Peak, curves: Curves, curve: Curve) -> str:
    scene = curves.scene
    unit = "°" if curve.quantity.shown_unit(scene.length_unit) == "°" else ""
    value = stepped(peak.value, (plot.y.high - plot.y.low) / 500)
    if curves.over == "time":
        return f"{value}{unit} at {typeset(short(float(f'{peak.x:.4g}')))} s"
    angle = radians(peak.angle) if scene.linkage.drive.coordinate.is_angle else peak.angle
    return f"{value}{unit} at {driven_words(scene, angle)}"


def _about(at: complex, text: str, pen: Pen, *, high: bool) -> LabelPlaces:
    """Return places for words about a place on a curve, with lines to those that are not close by.

    Of a `high` one they are above it where they can be.
    """
    wide, tall = pen.type.width(text, pen.small), 1.15 * pen.small
    rows, up = (tall / 2 - 1.6 * pen.small, tall / 2 + 0.5 * pen.small), -1 if high else 1
    asides = [(side, off) for off in _ASIDE for side in (1, -1)]
    columns = [(0.0, 0.0), *((side * (wide / 2 + off * pen.small), off) for side, off in asides)]
    near = [complex(x, y) for y in rows[::-up] for x, _ in columns[:3]]
    levels = [(n, side * n * tall) for n in _LEVELS for side in (up, -up)]
    far = [(complex(x, y), 0.35 * n + 0.3 * off) for n, y in levels for x, off in columns]
    offs = np.array([*near, *(off for off, _ in far)])
    price = np.array([*(0.2 * np.arange(len(near))), *(1.0 + more for _, more in far)])
    # from the dot to the nearest point of the words
    away = np.maximum(np.abs(offs.real) - wide / 2, 0) * np.sign(offs.real)
    reach = away + 1j * np.maximum(np.abs(offs.imag) - tall / 2, 0) * np.sign(offs.imag)
    led = np.flatnonzero(np.abs(reach) > _CLOSE * pen.small)
    begins = 1.5 * _DOT * pen.line * reach[led] / np.abs(reach[led])
    lines = tuple(np.array([[[at + begin, at + end]]]) for begin, end in zip(begins, reach[led], strict=True))
    drawn = np.full(len(offs), -1)
    drawn[led] = np.arange(len(led))
    return LabelPlaces((wide, tall), at + offs[None], price, lines=lines, drawn=drawn)


def _tracks(plot: Plot, curve: Curve, half: float) -> Iterator[Solid]:
    """Yield a curve in short straight lines."""
    points = plot.place(curve.x, np.where(np.isfinite(curve.values), curve.values, np.nan))[::_EVERY]
    for begin, end in pairwise(points[np.isfinite(points)]):
        yield Solid(np.array([[begin, end]]), half)
