"""A stroke drawn by hand: closed where it ends near its start, smoothed between corners, bent."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from linkanim.synthesis.curves.drawn import DrawnCurve, drawn
from linkanim.synthesis.kinds import Complex, Indices, Real

POINTS = 72
"""Of a stroke, about as many."""
_SAMPLES = 288
"""Equally far along it, over which it is smoothed."""
_NEAR = 0.15
"""Of its size: a stroke whose ends are no further apart is closed."""
_GAP = 0.15
"""Of a stroke's length: its last part, which is led to its start where it is closed."""
_ARM, _SHARP = 0.025, math.radians(50)
"""Of the length, before and after a point; where the two ways differ by that angle, it is a corner."""
_WIDTH = 0.016
"""Of the length, by how much it is smoothed."""
_SAME = 1e-6
"""Of the size: a way back that differs by less is the same."""
_REACH = 0.1
"""Of the points, that a point takes along to either side."""


def stroke_of(points: Complex) -> DrawnCurve:
    """Return the curve that was meant by a stroke's points (n,), as the hand gave them.

    BadInput for fewer than three that differ, and for a stroke without extent.
    """
    points = points[np.append(True, np.diff(points) != 0)]
    raw = drawn(points, closed=False)
    even = raw.at(np.linspace(0.0, 1.0, _SAMPLES + 1))
    closed = bool(abs(even[-1] - even[0]) <= _NEAR * raw.size)
    return DrawnCurve(_smoothed(_joined(even) if closed else even, closed=closed), closed)


def _joined(even: Complex) -> Complex:
    """Return a stroke's samples with its ends joined: what runs on past the start is cut, or led to it."""
    tail = round(_GAP * _SAMPLES)
    even = even[: len(even) - tail + int(np.abs(even[-tail:] - even[0]).argmin()) + 1]
    way, gap = even[-1] - even[-1 - tail // 4], even[0] - even[-1]
    ahead = (np.conj(way) * gap).real > abs((np.conj(way) * gap).imag)
    even = even if ahead else even + gap * np.linspace(-len(even) / tail, 1.0, len(even)).clip(0.0)
    return DrawnCurve(even, closed=True).at(np.linspace(0.0, 1.0, _SAMPLES + 1))


def trace_of(way: Complex) -> DrawnCurve:
    """Return the curve that a joint's places (n,) over a period are; one gone back the same way is open.

    BadInput for a joint that stands still.
    """
    way = way[np.isfinite(way)]
    back = np.abs(way - np.roll(way[::-1], 1)).max(initial=0.0) <= _SAME * np.abs(way - way[:1]).max(
        initial=0.0
    )
    way = way[: len(way) // 2 + 1] if back else way
    whole = DrawnCurve(way, closed=not back)
    return drawn(way[whole.thinned(POINTS)] if whole.size else way, closed=not back)


def bent(curve: DrawnCurve, point: int, to: complex) -> DrawnCurve:
    """Return the curve with a point put elsewhere, its neighbours going along, less the further they are."""
    count = len(curve.points)
    away = np.abs(np.arange(count) - point)
    if curve.closed:
        away = np.minimum(away, count - away)
    share = np.cos(np.minimum(away / max(_REACH * count, 1.0), 1.0) * (math.pi / 2)) ** 2
    return drawn(curve.points + share * (to - curve.points[point]), closed=curve.closed)


def _smoothed(even: Complex, *, closed: bool) -> Complex:
    """Return about `POINTS` points along the smoothed pieces between corners, these among them.

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
    """Return a part between two corners smoothed, its ends where they are."""
    reach = min(len(part) - 1, _SAMPLES // 8)
    wider = np.pad(part, reach, mode="reflect", reflect_type="odd")
    smooth = _blurred(wider)[reach : reach + len(part)]
    smooth[0], smooth[-1] = part[0], part[-1]
    return _resampled(smooth, max(round(POINTS * (len(part) - 1) / _SAMPLES), 1))


def _resampled(points: Complex, steps: int) -> Complex:
    """Return points at so many equal steps along a polyline, its ends among them."""
    return DrawnCurve(points, closed=False).at(np.linspace(0.0, 1.0, steps + 1))


def _blurred(points: Complex) -> Complex:
    """Return points smoothed by a bell curve, and what that takes off a bend put back on."""
    width = _WIDTH * _SAMPLES
    bell = np.exp(-0.5 * (np.arange(-int(4 * width), int(4 * width) + 1) / width) ** 2)
    bell /= bell.sum()

    def blur(values: Complex) -> Complex:
        return np.convolve(np.pad(values, len(bell) // 2, mode="edge"), bell, mode="valid")

    return 2 * blur(points) - blur(blur(points))


def _corners(even: Complex, *, closed: bool) -> Indices:
    """Return the samples at which the stroke turns sharply: of a run of them the sharpest."""
    arm = round(_ARM * _SAMPLES)
    turn = (
        _turns(np.concatenate([even[:-1]] * 3), arm)[_SAMPLES : 2 * _SAMPLES] if closed else _turns(even, arm)
    )
    sharp = np.flatnonzero(turn > _SHARP)
    if not len(sharp):
        return sharp
    runs = np.split(sharp, np.flatnonzero(np.diff(sharp) > arm) + 1)
    found = np.array([run[turn[run].argmax()] for run in runs])
    if closed and len(found) > 1 and found[0] + _SAMPLES - found[-1] <= arm:
        found = found[1:] if turn[found[-1]] > turn[found[0]] else found[:-1]
    return found


def _turns(points: Complex, arm: int) -> Real:
    """Return by what angle the way turns at each point, over an arm to either side; 0 next to the ends."""
    turn = np.zeros(len(points))
    way = points[arm:] - points[:-arm]
    turn[arm:-arm] = np.abs(np.angle(way[arm:] * np.conj(way[:-arm])))
    return turn
