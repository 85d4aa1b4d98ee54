"""Dimension lines: arrows from end to end beside what is measured, lines that lead there, arcs of angles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from linkanim.picture.layout import Gauge
from linkanim.picture.raster.directions import directions
from linkanim.picture.raster.parts import Part
from linkanim.picture.raster.raster import Colour, Layer, Loop
from linkanim.picture.raster.shapes import arrows, segments, stroke, unit

_OVER = 2.5
"""How far a lead goes beyond the line that it leads to, in widths of it."""
_OFF = 1.2
"""Where a lead begins, in half widths of a bar."""


class MeasureLine(NamedTuple):
    """A line of dimension in the frame of two joints, whose way is 1: from `begin` to `end`, y down.

    It lies `reach` pixels aside. In a frame of one joint twice, 1 is the scene's unit to the right.
    """

    frame: tuple[str, str]
    begin: complex
    end: complex
    reach: float

    def part(self, span: float, gauge: Gauge, colour: Colour) -> Part:
        """Return it drawn, with the frame `span` pixels long."""
        away = 1j * self.reach * unit(self.end - self.begin)
        ends = span * self.begin, span * self.end
        at, head = self.frame
        return Part(at, at, head, (Layer(colour, dimension_line(*ends, away, gauge)),))

    def tracks(self, at: Loop, way: Loop, gauge: Gauge) -> Loop:
        """Return its line and its leads, begin and end of each (n moments, 3, 2), for a frame at `at`."""
        begin, end = at + self.begin * way, at + self.end * way
        along = end - begin
        side = 1j * along / np.maximum(np.abs(along), 1e-9) * np.sign(self.reach)
        level, near = side * abs(self.reach), side * _OFF * gauge.bar
        pairs = (begin + level, end + level), (begin + near, begin + level), (end + near, end + level)
        return np.moveaxis(np.array(pairs), -1, 0)


class AngleArc(NamedTuple):
    """An angle in the frame of two joints, between two directions; `radius` in pixels."""

    frame: tuple[str, str]
    begin: complex
    end: complex
    radius: float

    def part(self, span: float, gauge: Gauge, colour: Colour) -> Part:
        """Return it drawn: the arc, and a lead along each of its sides."""
        sweep = float(np.angle(self.end / self.begin))
        path = self.radius * unit(self.begin) * directions(np.linspace(0, sweep, 2 + round(12 * abs(sweep))))
        leads = [way * (self.radius + _OVER * gauge.line) for way in map(unit, (self.begin, self.end))]
        at, head = self.frame
        loops = [*stroke(path, 0.9 * gauge.line), *segments([0j, 0j], leads, 0.7 * gauge.line)]
        return Part(at, at, head, (Layer(colour, loops),))

    def tracks(self, at: Loop, way: Loop, gauge: Gauge) -> Loop:
        """Return what it draws in straight lines, begin and end of each (n moments, 4, 2)."""
        turn = (way / np.maximum(np.abs(way), 1e-9))[:, None] * self.radius * unit(self.begin)
        shares = np.linspace(0, float(np.angle(self.end / self.begin)), 5)
        points = at[:, None] + turn * directions(shares)
        pairs: Loop = np.stack((points[:, :-1], points[:, 1:]), axis=2)
        return pairs


def dimension_line(begin: complex, end: complex, away: complex, gauge: Gauge) -> list[Loop]:
    """Return a line `away` from its ends, with an arrow at both, and the leads to it."""
    width, side = 0.9 * gauge.line, unit(away)
    feet = np.array([begin, end])
    near = min(_OFF * gauge.bar, 0.5 * abs(away))
    leads = segments(feet + near * side, feet + away + _OVER * width * side, 0.7 * width)
    middle = (begin + end) / 2 + away
    return [*leads, *arrows([middle, middle], [begin + away - middle, end + away - middle], 1.6 * width)]
