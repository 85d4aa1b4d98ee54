"""What a four-bar is worth beside a curve: how exactly it follows, how small it is, how well it transmits."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from linkanim.synthesis.curves.drawn import DrawnCurve
from linkanim.synthesis.kinds import FOUR_BAR, Complex, Linkage4, Real

_MOMENTS = 240


class Worth(NamedTuple):
    """By how much of the curve's size in percent it is off, its links together in curve sizes, and its least
    transmission angle (rad), 0 where the crank does not turn fully.

    Among the links is the coupler point's arm from A.
    """

    off: float
    links: float
    angle: float


def worth(joints: Linkage4, curve: DrawnCurve) -> Worth:
    """Return what a four-bar is worth beside a curve.

    `off` is the root mean square of the points' distances from what the coupler point draws, of a closed
    curve also of that from the curve, whichever is more; infinite where it draws nothing.
    """
    row = np.array(joints.row)
    *lengths, _ = FOUR_BAR.link_lengths(row[None])[0]
    return Worth(_off(joints, curve), float(np.sum(lengths) / curve.size), _least_angle(row))


def _off(joints: Linkage4, curve: DrawnCurve) -> float:
    drawn = trace(joints)
    if len(drawn) < 2:
        return math.inf
    away = _distances(curve.points, drawn)
    if curve.closed:
        away = max(away, _distances(drawn, curve.polyline))
    return 100 * away / curve.size


def trace(joints: Linkage4) -> Complex:
    """Return what the coupler point draws, the first point once more at the end; that of a swing comes back.

    The way back of a swing is on the other closure.
    """
    rows, step = np.array([joints.row]), 2 * math.pi / _MOMENTS
    angles: Real = joints.angle + step * np.arange(_MOMENTS + 1, dtype=np.float64)
    ways = list[Complex]()
    with np.errstate(all="ignore"):
        ways += [FOUR_BAR.points(rows, np.array([side]), angles[None])[0] for side in (1.0, -1.0)]
    there, back = ways if joints.closure > 0 else ways[::-1]
    if np.isfinite(there).all():
        return there
    shut = np.flatnonzero(~np.isfinite(there))
    # the stretch that the crank is in, from limit to limit, and back
    open_ = np.arange(shut[-1] + 1 - _MOMENTS, shut[0])
    found: Complex = np.concatenate([there[open_ % _MOMENTS], back[open_[::-1] % _MOMENTS]])
    found = found[np.isfinite(found)]
    return np.append(found, found[:1])


def _distances(points: Complex, line: Complex) -> float:
    """Return the root mean square of the points' distances from a line through others."""
    begin, way = line[:-1], np.diff(line)
    from_begin = points[:, None] - begin
    square = np.maximum(way.real**2 + way.imag**2, 1e-300)
    share = np.clip((from_begin * way.conj()).real / square, 0.0, 1.0)
    nearest: Real = np.abs(from_begin - share * way).min(axis=1)
    return float(np.sqrt(np.mean(nearest**2)))


def _least_angle(row: Real) -> float:
    """Return the least transmission angle of a crank that turns fully, by the cosine rule; else 0."""
    x, y, crank, a, _, _, x4, y4, b = row
    ground = math.hypot(x4 - x, y4 - y)
    angles = []
    for far in (abs(ground - crank), ground + crank):
        cosine = (a * a + b * b - far * far) / max(2 * a * b, 1e-300)
        if not abs(cosine) < 1.0:
            return 0.0
        angles.append(math.acos(abs(cosine)))
    return min(angles)
