"""A drawn curve: points in their order, closed or open, checked."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from linkanim.errors import BadInput
from linkanim.synthesis.kinds import Complex, Indices, Real

LEAST_POINTS = 3
_FARTHEST = 1e150
"""Of a coordinate: squares of what lies beyond are no numbers any more."""


@dataclass(frozen=True, eq=False)
class DrawnCurve:
    """Points (n,) as x + yi in their order; the first of a closed curve stands once."""

    points: Complex
    closed: bool

    @cached_property
    def size(self) -> float:
        """The diagonal of the points' bounding box."""
        return float(np.hypot(np.ptp(self.points.real), np.ptp(self.points.imag)))

    @property
    def centre(self) -> complex:
        """The points' mean."""
        return complex(self.points.mean())

    @cached_property
    def polyline(self) -> Complex:
        """The points, of a closed curve with the first once more at the end."""
        return np.append(self.points, self.points[0]) if self.closed else self.points

    @cached_property
    def places(self) -> Real:
        """How far along the polyline each point is, from 0 to 1 at its end (n,)."""
        way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.polyline)))])
        return np.asarray(way[: len(self.points)] / way[-1])

    @property
    def longest_step(self) -> float:
        """The longest way from one point to the next."""
        return float(np.abs(np.diff(self.polyline)).max())

    def at(self, places: Real) -> Complex:
        """Return the points of the polyline at places along it."""
        own = np.append(self.places, 1.0) if self.closed else self.places
        return np.interp(places, own, self.polyline.real) + 1j * np.interp(places, own, self.polyline.imag)

    def thinned(self, count: int) -> Indices:
        """Return which points to take so that at most so many are about equally far along the curve."""
        if len(self.points) <= count:
            return np.arange(len(self.points))
        even = np.linspace(0.0, self.places[-1], count)
        after = np.clip(np.searchsorted(self.places, even), 1, len(self.places) - 1)
        nearer = even - self.places[after - 1] < self.places[after] - even
        return np.unique(after - nearer)


def drawn(points: ArrayLike, *, closed: bool, timed: bool = False) -> DrawnCurve:
    """Return the curve through points (n, 2), or complex (n,); a closed one may repeat its first at the end.

    BadInput for fewer than three points, for one that is not finite, for neighbours that coincide (with
    prescribed timing a point may rest), and for points without extent.
    """
    found = _as_complex(points)
    for number, point in enumerate(found, start=1):
        if not np.isfinite(point):
            raise BadInput(f"point {number} is not finite; leave it out")
    if closed and not timed and len(found) > 1 and found[0] == found[-1]:
        found = found[:-1]
    if len(found) < LEAST_POINTS:
        raise BadInput(f"a path needs {LEAST_POINTS} points at least; there are {len(found)}")
    if (farthest := float(max(np.abs(found.real).max(), np.abs(found.imag).max()))) > _FARTHEST:
        raise BadInput(f"a point lies at {farthest:g}; give points up to {_FARTHEST:g}")
    size = np.hypot(np.ptp(found.real), np.ptp(found.imag))
    if not size > 1e-9 * np.abs(found).max() or not size > 1e-150:
        raise BadInput("the points have no extent: all are one; draw a curve")
    same = np.flatnonzero(np.abs(np.diff(found)) <= 1e-12 * size)
    if len(same) and not timed:
        raise BadInput(f"points {same[0] + 1} and {same[0] + 2} coincide; leave one of them out")
    found.flags.writeable = False
    return DrawnCurve(found, closed)


def _as_complex(points: ArrayLike) -> Complex:
    with suppress(TypeError, ValueError):
        array = np.array(points, dtype=np.complex128)
        if array.ndim == 2 and array.shape[1] == 2:
            return np.asarray(array[:, 0] + 1j * array[:, 1])
        if array.ndim == 1:
            return array
    raise BadInput("points are pairs of numbers, x and y, such as [[0, 0], [10, 5], [20, 0]]")
