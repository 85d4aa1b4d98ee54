"""Outlines in millimetres: corners as x + yi, each with the bulge of the edge that leaves it, as in DXF.

A bulge is tan(sweep/4): 0 for a straight edge, 1 for half a circle to the left. All outlines run counter-
clockwise. Arcs stay arcs up to the file that is cut; only `polygon` divides them.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Sequence

import numpy as np

Outline = tuple[tuple[complex, float], ...]
"""A closed line: each corner, and the bulge of the edge from it to the next."""

_CHORD = 0.005
"""How far a polygon's sides stay within the arcs that they stand for, in mm."""
_SAME = 1e-9


def rounded(points: Iterable[complex], radius: float) -> Outline:
    """Return the outline at a distance around the convex hull of points.

    One point gives a circle, two a bar with round ends, more a plate with round corners.
    """
    corners = hull(points)
    if len(corners) == 1:
        return ((corners[0] + radius, 1.0), (corners[0] - radius, 1.0))
    edges = [after - corner for corner, after in zip(corners, corners[1:] + corners[:1], strict=True)]
    sides = [-1j * edge / abs(edge) for edge in edges]
    outline: list[tuple[complex, float]] = []
    for corner, before, after in zip(corners, sides[-1:] + sides[:-1], sides, strict=True):
        sweep = cmath.phase(after / before) % math.tau
        outline += [(corner + radius * before, math.tan(sweep / 4)), (corner + radius * after, 0.0)]
    return tuple(outline)


def straight(points: Iterable[complex]) -> Outline:
    """Return a polygon as an outline."""
    return tuple((complex(point), 0.0) for point in points)


def hull(points: Iterable[complex]) -> list[complex]:
    """Return the corners of the convex hull, counter-clockwise (monotone chain, Andrew 1979)."""
    ordered = sorted(set(points), key=lambda point: (point.real, point.imag))
    if len(ordered) < 3:
        return ordered
    lower, upper = _chain(ordered), _chain(ordered[::-1])
    return lower[:-1] + upper[:-1]


def _chain(points: Sequence[complex]) -> list[complex]:
    chain: list[complex] = []
    for point in points:
        while len(chain) > 1 and _is_straight(chain[-2], chain[-1], point):
            chain.pop()
        chain.append(point)
    return chain


def _is_straight(a: complex, b: complex, c: complex) -> bool:
    """Return whether b is not right of the line from a to c, apart from rounding: no left turn at b."""
    return ((b - a).conjugate() * (c - b)).imag <= _SAME * abs(b - a) * abs(c - b)


def polygon(outline: Outline, chord: float = _CHORD) -> list[complex]:
    """Return an outline's corners with its arcs divided into sides within `chord` (mm) of them."""
    corners: list[complex] = []
    for (start, bulge), (end, _) in zip(outline, outline[1:] + outline[:1], strict=True):
        corners.append(start)
        if bulge:
            corners += _divided(start, end, bulge, chord)
    return corners


def _divided(start: complex, end: complex, bulge: float, chord: float) -> list[complex]:
    middle, radius, sweep = arc(start, end, bulge)
    if radius < _SAME:
        return []
    step = 2 * math.acos(max(1 - chord / radius, math.cos(math.pi / 8)))
    count = math.ceil(abs(sweep) / step - _SAME)
    return [middle + (start - middle) * cmath.rect(1.0, sweep * n / count) for n in range(1, count)]


def arc(start: complex, end: complex, bulge: float) -> tuple[complex, float, float]:
    """Return middle, radius and sweep (radians, to the left positive) of an edge with a bulge."""
    sweep = 4 * math.atan(bulge)
    middle = (start + end) / 2 + 1j * (end - start) / 2 / math.tan(sweep / 2)
    return middle, abs(start - middle), sweep


def moved(outline: Outline, at: complex, turn: complex) -> Outline:
    """Return an outline turned about the origin by the direction `turn`, then moved by `at`."""
    return tuple((at + turn * corner, bulge) for corner, bulge in outline)


def box(points: Iterable[complex]) -> tuple[float, float, float, float]:
    """Return the least and the greatest x, then y, of points."""
    places = list(points)
    xs, ys = [place.real for place in places], [place.imag for place in places]
    return min(xs), max(xs), min(ys), max(ys)


def upright(points: Iterable[complex]) -> complex:
    """Return the direction to turn points by so that their rectangle is smallest, its longer side along x."""
    corners = np.array(hull(points))
    sides = np.roll(corners, -1) - corners
    directions = (sides / np.abs(sides)).conj() if len(corners) > 1 else np.ones(1, np.complex128)
    turned = np.multiply.outer(directions, corners)
    wide, high = np.ptp(turned.real, axis=1), np.ptp(turned.imag, axis=1)
    least = int((wide * high).argmin())
    return complex(directions[least]) * (1 if wide[least] >= high[least] else -1j)


def sides(outline: Outline) -> tuple[float, float]:
    """Return the sides of the smallest rectangle about an outline, the longer one first."""
    points = polygon(outline)
    turn = upright(points)
    left, right, low, high = box(turn * point for point in points)
    return right - left, high - low
