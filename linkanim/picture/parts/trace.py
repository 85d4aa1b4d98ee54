"""Curves of the traced joints: the whole curve stands still, its recent part follows the phase."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import ceil, floor, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster.directions import lengths
from linkanim.picture.raster.raster import Colour, Layer, Loop
from linkanim.picture.raster.shapes import offsets, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

RECENT = 0.3 * 2 * pi
"""How much phase the recent part covers."""
_SHADES = 10
_ORDER = (0, *(shade + step for shade in range(1, _SHADES - 1, 2) for step in (1, 0)), _SHADES - 1)
"""In which shades are painted: the odd ones after both neighbours, else from the oldest on."""
SWELL = 1.7
"""How much wider than the whole curve the recent part ends."""
_FAINT = 0.5
"""How much of the background is in the whole curve's colour."""
_NEAR, _LONGEST_RUN = 0.01, 16
"""How far off a straight piece may points lie that it passes over, in pixels, and so many in all."""


@dataclass(frozen=True)
class Trace:
    """The curve of one joint in pixels, at equal steps of phase over one true period."""

    joint: str
    path: Loop
    period: float
    colour: Colour
    back: Colour
    width: float

    @cached_property
    def shades(self) -> tuple[Colour, ...]:
        """The colours of the recent part, from the oldest on."""
        return tuple(mixed(self.back, self.colour, shade / _SHADES) for shade in range(1, _SHADES + 1))

    def whole(self) -> Layer:
        """Return the whole curve."""
        return Layer(self.back, stroke(self.path, self.width, closed=True))

    def recent(self, phase: float, place: complex, *, forward: bool) -> list[Layer]:
        """Return what the joint, now at `place`, has passed through last, brighter towards it."""
        count = len(self.path)
        here = phase / self.period * count
        tail = max(round(RECENT / self.period * count), _SHADES)
        # run backwards, the curve is passed through from its end
        last, share = (floor(here), here % 1) if forward else (-ceil(here) - 1, -here % 1)
        first = (last - tail) % count
        course, (cuts, needed) = self._courses[not forward], _cuts(tail + 2)
        taken = np.flatnonzero(course.corner[first : first + tail + 2] | needed)
        path, side = course.path.take(first + taken), course.side.take(first + taken)
        path[-1], side[-1] = place, (1 - share) * side[-2] + share * side[-1]
        side *= _swelling(tail + 2, self.width).take(taken)
        ends = np.searchsorted(taken, cuts).tolist()
        return list(self._shaded(path - side, path + side, ends))

    def _shaded(self, right: Loop, left: Loop, ends: list[int]) -> Iterator[Layer]:
        """Yield what lies between two edges in the shades: every other one runs on below its neighbours.

        So few lie over each other. Where the curve crosses itself, the younger part is still on top.
        """
        for shade in _ORDER:
            under = 1 - shade % 2
            part = slice(max(ends[shade] - under, 0), ends[shade + 1] + 1 + under)
            yield Layer(self.shades[shade], [np.concatenate((right[part], left[part][::-1]))])

    @cached_property
    def _courses(self) -> tuple[_Course, _Course]:
        """Two rounds of the path, and two the other way."""
        side = _sides(self.path)
        corner = _corners(np.stack([self.path + way * side for way in (self.width, -self.width)]))
        there = _Course(np.tile(self.path, 2), np.tile(side, 2), np.tile(corner, 2))
        return there, _Course(there.path[::-1], -there.side[::-1], there.corner[::-1])


class _Course(NamedTuple):
    """A curve's points, the way from each to the left edge of a line 2 wide, and which ones are corners."""

    path: Loop
    side: Loop
    corner: NDArray[np.bool_]


@lru_cache(maxsize=16)
def _swelling(count: int, width: float) -> NDArray[np.float64]:
    """Return half the width of a recent part at each of its points."""
    return np.asarray(width / 2 * (1 + (SWELL - 1) / (count - 1) * np.arange(count)), np.float64)


@lru_cache(maxsize=16)
def _cuts(count: int) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Return where a part of so many points is cut into shades, and its end; and which points that needs.

    Those are the points at the cuts, the ones before and after, which two shades share, and the last two.
    """
    cuts = np.array([round(count * shade / _SHADES) for shade in range(_SHADES + 1)])
    needed = np.zeros(count, np.bool_)
    needed[np.clip((cuts - 1, cuts, cuts + 1), 0, count - 1)] = True
    needed[-2:] = True
    return cuts, needed


def _sides(path: Loop) -> Loop:
    """Return at each point of a closed path the way to the left edge of a line 2 wide; 0 where none moves."""
    moved = path != np.roll(path, 1)
    points = path[moved]
    if not points.size:
        return np.zeros_like(path)
    sides = offsets(np.concatenate((points[-1:], points, points[:1])))[1:-1]
    found: Loop = sides[np.cumsum(moved) - 1]
    return found


def _corners(edges: Loop) -> NDArray[np.bool_]:
    """Return which points of closed lines (n, points) are needed for straight pieces to be as good.

    Runs of 2, 4, 8 and 16 points are left out where all lie near the places that they have on a piece.
    """
    corner, step = np.ones(edges.shape[1], np.bool_), 2
    while step <= _LONGEST_RUN and not len(corner) % step:
        begin = edges[:, ::step, None]
        share = np.arange(1, step) / step
        there = begin + share * (np.roll(begin, -1, axis=1) - begin)
        off = lengths(edges.reshape(len(edges), -1, step)[:, :, 1:] - there)
        corner.reshape(-1, step)[(off <= _NEAR).all(axis=(0, 2)), 1:] = False
        step *= 2
    return corner


def traces(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Trace, ...]:
    """Return the curves of the scene's traced joints."""
    found = []
    for n, joint in enumerate(figure.scene.trace):
        colour = theme.traces[n % len(theme.traces)]
        back = mixed(colour, theme.background, _FAINT)
        path = figure.path(joint, view)
        found.append(Trace(joint, path, figure.scene.period, colour, back, 1.3 * gauge.line))
    return tuple(found)
