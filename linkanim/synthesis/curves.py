"""Take a curve that is to be followed: checked points, or a stroke drawn by hand.

Its parts, in reading order:

- A drawn curve: points in their order, closed or open, checked.
- A stroke drawn by hand: closed where it ends near its start, smoothed between corners, bent.
"""

from __future__ import annotations

import math
from contextlib import suppress
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.synthesis.linkages import Complex, Indices, Real

# A drawn curve: points in their order, closed or open, checked.

LEAST_POINTS = 3
_FARTHEST = 1e150
"""The largest coordinate: the square of a larger one would overflow."""


@frozen(eq=False)
class DrawnCurve:
    """Points (n,) as x + yi in their order; a closed curve's first point is not repeated at its end."""

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
        """The points, with a closed curve's first point repeated at the end."""
        return np.append(self.points, self.points[0]) if self.closed else self.points

    @cached_property
    def places(self) -> Real:
        """How far along the polyline each point is, from 0 to 1 at its end (n,)."""
        lengths = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.polyline)))])
        return np.asarray(lengths[: len(self.points)] / lengths[-1])

    @property
    def longest_step(self) -> float:
        """The longest distance from one point to the next."""
        return float(np.abs(np.diff(self.polyline)).max())

    def at(self, places: Real) -> Complex:
        """Return the points of the polyline at places along it."""
        own = np.append(self.places, 1.0) if self.closed else self.places
        return np.interp(places, own, self.polyline.real) + 1j * np.interp(places, own, self.polyline.imag)

    def thinned(self, count: int) -> Indices:
        """Return the indices of at most `count` points that are about evenly spaced along the curve."""
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
    path = _as_complex(points)
    for number, point in enumerate(path, start=1):
        if not np.isfinite(point):
            raise BadInput(f"point {number} is not finite; leave it out")
    if closed and not timed and len(path) > 1 and path[0] == path[-1]:
        path = path[:-1]
    if len(path) < LEAST_POINTS:
        raise BadInput(f"a path needs {LEAST_POINTS} points at least; there are {len(path)}")
    if (farthest := float(max(np.abs(path.real).max(), np.abs(path.imag).max()))) > _FARTHEST:
        raise BadInput(f"a point lies at {farthest:g}; give points up to {_FARTHEST:g}")
    size = np.hypot(np.ptp(path.real), np.ptp(path.imag))
    if not size > 1e-9 * np.abs(path).max() or not size > 1e-150:
        raise BadInput("the points have no extent: all are one; draw a curve")
    same = np.flatnonzero(np.abs(np.diff(path)) <= 1e-12 * size)
    if len(same) and not timed:
        raise BadInput(f"points {same[0] + 1} and {same[0] + 2} coincide; leave one of them out")
    path.flags.writeable = False
    return DrawnCurve(path, closed)


def _as_complex(points: ArrayLike) -> Complex:
    with suppress(TypeError, ValueError):
        array = np.array(points, dtype=np.complex128)
        if array.ndim == 2 and array.shape[1] == 2:
            return np.asarray(array[:, 0] + 1j * array[:, 1])
        if array.ndim == 1:
            return array
    raise BadInput("points are pairs of numbers, x and y, such as [[0, 0], [10, 5], [20, 0]]")


# A stroke drawn by hand: closed where it ends near its start, smoothed between corners, bent.

POINTS = 72
"""The number of points of a stroke, about."""
_SAMPLES = 288
"""The number of evenly spaced samples of a stroke over which it is smoothed."""
_NEAR = 0.15
"""The largest distance between the ends of a stroke that counts as closed, as a share of its size."""
_GAP = 0.15
"""The last part of a closed stroke that is bent towards its start, as a share of its length."""
_ARM, _SHARP = 0.025, math.radians(50)
"""How a corner is found: the directions over this share of the length before and after differ so (rad)."""
_WIDTH = 0.016
"""The width of the smoothing, as a share of the length."""
_SAME = 1e-6
"""The distance, as a share of the size, below which a path back is the same as the path there."""
_REACH = 0.1
"""The share of the points that a dragged point takes along to either side."""


def stroke_of(points: Complex) -> DrawnCurve:
    """Return the curve that was meant by the points (n,) of a stroke drawn by hand.

    BadInput for fewer than three different points, and for a stroke without extent.
    """
    points = points[np.append(True, np.diff(points) != 0)]
    raw = drawn(points, closed=False)
    even = raw.at(np.linspace(0.0, 1.0, _SAMPLES + 1))
    closed = bool(abs(even[-1] - even[0]) <= _NEAR * raw.size)
    return DrawnCurve(_smoothed(_joined(even) if closed else even, closed=closed), closed)


def _joined(even: Complex) -> Complex:
    """Return a stroke's samples with its ends joined: an overlap is cut off, a gap is bent together."""
    tail = round(_GAP * _SAMPLES)
    even = even[: len(even) - tail + int(np.abs(even[-tail:] - even[0]).argmin()) + 1]
    heading, gap = even[-1] - even[-1 - tail // 4], even[0] - even[-1]
    ahead = (np.conj(heading) * gap).real > abs((np.conj(heading) * gap).imag)
    even = even if ahead else even + gap * np.linspace(-len(even) / tail, 1.0, len(even)).clip(0.0)
    return DrawnCurve(even, closed=True).at(np.linspace(0.0, 1.0, _SAMPLES + 1))


def trace_of(path: Complex) -> DrawnCurve:
    """Return the curve through a joint's places (n,) over a period; a path there and back is an open curve.

    BadInput for a joint that stands still.
    """
    path = path[np.isfinite(path)]
    back = np.abs(path - np.roll(path[::-1], 1)).max(initial=0.0) <= _SAME * np.abs(path - path[:1]).max(
        initial=0.0
    )
    path = path[: len(path) // 2 + 1] if back else path
    whole = DrawnCurve(path, closed=not back)
    return drawn(path[whole.thinned(POINTS)] if whole.size else path, closed=not back)


def bent(curve: DrawnCurve, point: int, to: complex) -> DrawnCurve:
    """Return the curve with one point moved; its neighbours follow, the less the further they are."""
    count = len(curve.points)
    away = np.abs(np.arange(count) - point)
    if curve.closed:
        away = np.minimum(away, count - away)
    share = np.cos(np.minimum(away / max(_REACH * count, 1.0), 1.0) * (math.pi / 2)) ** 2
    return drawn(curve.points + share * (to - curve.points[point]), closed=curve.closed)


def _smoothed(even: Complex, *, closed: bool) -> Complex:
    """Return about `POINTS` points along the smoothed pieces between corners, and the corners.

    `even` has the first point of a closed curve once more at its end.
    """
    corners = _corners(even, closed=closed)
    if closed and not len(corners):
        return _resampled(_blurred(np.concatenate([even[:-1]] * 3))[_SAMPLES : 2 * _SAMPLES + 1], POINTS)[:-1]
    if closed:
        even = np.append(np.roll(even[:-1], -corners[0]), even[corners[0]])
        corners = corners - corners[0]
    ends = np.unique([0, *corners, _SAMPLES])
    pieces = [_piece(even[first : last + 1]) for first, last in pairwise(ends)]
    points = np.concatenate([piece[:-1] for piece in pieces])
    return points if closed else np.append(points, even[-1])


def _piece(part: Complex) -> Complex:
    """Return a part between two corners, smoothed, with its ends unmoved."""
    reach = min(len(part) - 1, _SAMPLES // 8)
    wider = np.pad(part, reach, mode="reflect", reflect_type="odd")
    smooth = _blurred(wider)[reach : reach + len(part)]
    smooth[0], smooth[-1] = part[0], part[-1]
    return _resampled(smooth, max(round(POINTS * (len(part) - 1) / _SAMPLES), 1))


def _resampled(points: Complex, steps: int) -> Complex:
    """Return points at `steps` equal steps along a polyline, both ends included."""
    return DrawnCurve(points, closed=False).at(np.linspace(0.0, 1.0, steps + 1))


def _blurred(points: Complex) -> Complex:
    """Return points smoothed by a bell curve, corrected for the flattening of bends by it."""
    width = _WIDTH * _SAMPLES
    bell = np.exp(-0.5 * (np.arange(-int(4 * width), int(4 * width) + 1) / width) ** 2)
    bell /= bell.sum()

    def blur(values: Complex) -> Complex:
        return np.convolve(np.pad(values, len(bell) // 2, mode="edge"), bell, mode="valid")

    return 2 * blur(points) - blur(blur(points))


def _corners(even: Complex, *, closed: bool) -> Indices:
    """Return the samples at which the stroke turns sharply: the sharpest of each run of neighbours."""
    arm = round(_ARM * _SAMPLES)
    turn = (
        _turns(np.concatenate([even[:-1]] * 3), arm)[_SAMPLES : 2 * _SAMPLES] if closed else _turns(even, arm)
    )
    sharp = np.flatnonzero(turn > _SHARP)
    if not len(sharp):
        return sharp
    runs = np.split(sharp, np.flatnonzero(np.diff(sharp) > arm) + 1)
    corners = np.array([run[turn[run].argmax()] for run in runs])
    if closed and len(corners) > 1 and corners[0] + _SAMPLES - corners[-1] <= arm:
        corners = corners[1:] if turn[corners[-1]] > turn[corners[0]] else corners[:-1]
    return corners


def _turns(points: Complex, arm: int) -> Real:
    """Return by what angle the path turns at each point, over an arm to either side; 0 next to the ends."""
    turn = np.zeros(len(points))
    chords = points[arm:] - points[:-arm]
    turn[arm:-arm] = np.abs(np.angle(chords[arm:] * np.conj(chords[:-arm])))
    return turn
