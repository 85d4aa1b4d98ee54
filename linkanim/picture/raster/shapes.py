"""Outlines in pixels, as closed loops of complex numbers x + yi that all turn the same way.

They stand about the origin or where they were asked for; to place one, multiply it by a direction
of length 1 and add a position.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from linkanim.picture.raster.directions import directions, length, lengths
from linkanim.picture.raster.raster import Loop

MOST_MARKS = 20_000
"""Dashes of a line, strokes of a hatching or chords of an arc: the largest window has a tenth of them."""


@lru_cache(maxsize=64)
def disc(radius: float) -> Loop:
    """Return a circle about the origin, within 0.02 px of a true one; the last ones are kept."""
    return _kept(_arc(0.0, 2 * pi, radius)[:-1])


def rounded(points: Sequence[complex], radius: float) -> Loop:
    """Return the outline at this distance around the points' convex hull.

    One point gives a circle, two a bar with round ends, more a plate with round corners. The last ones are
    kept: under the hand one of a linkage's bars changes.
    """
    return _rounded(tuple(points), radius)


@lru_cache(maxsize=256)
def _rounded(points: tuple[complex, ...], radius: float) -> Loop:
    corners = hull(points)
    if len(corners) == 1:
        return corners[0] + disc(radius)
    normals = [
        -1j * unit(after - corner) for corner, after in zip(corners, corners[1:] + corners[:1], strict=True)
    ]
    arcs = []
    for corner, before, after in zip(corners, normals[-1:] + normals[:-1], normals, strict=True):
        begin = float(np.angle(before))
        arcs.append(corner + _arc(begin, float(np.angle(after / before)) % (2 * pi), radius))
    return _kept(np.concatenate(arcs))


@lru_cache(maxsize=64)
def box(width: float, height: float, radius: float = 0.0) -> Loop:
    """Return a rectangle about the origin, its corners rounded; the last ones are kept."""
    x, y = width / 2 - radius, height / 2 - radius
    return _kept(rounded([complex(-x, -y), complex(x, -y), complex(x, y), complex(-x, y)], radius))


def stroke(path: ArrayLike, width: float, *, closed: bool = False) -> list[Loop]:
    """Return the outline of a line of this width along the path, its ends round.

    Points that repeat are passed over; a path of a single place gives a dot.
    """
    return next(strokes(path, (width,), closed=closed))


def strokes(path: ArrayLike, widths: Iterable[float], *, closed: bool = False) -> Iterator[list[Loop]]:
    """Yield the outlines of a line along the path in several widths."""
    path = distinct(np.asarray(path, np.complex128))
    if closed and len(path) > 1 and path[0] == path[-1]:
        path = path[:-1]
    if len(path) < 2:
        yield from ([path[0] + disc(width / 2)] for width in widths)
    elif closed:
        sides = offsets(np.concatenate((path[-1:], path, path[:1])))[1:-1]
        yield from ([path - sides * (width / 2), (path + sides * (width / 2))[::-1]] for width in widths)
    else:
        sides = offsets(path)
        yield from ([ribbon(path, sides, width)] for width in widths)


def distinct(path: Loop) -> Loop:
    """Return a path without the points that are where the ones before them are."""
    moves = path[1:] != path[:-1]
    return path if moves.all() else np.concatenate((path[:1], path[1:][moves]))


def ribbon(path: Loop, sides: Loop, width: float) -> Loop:
    """Return the outline of a line along an open path whose `offsets` are known, its ends round."""
    start, end = unit(path[1] - path[0]), unit(path[-1] - path[-2])
    cap, edge = _cap(width / 2), sides * (width / 2)
    return np.concatenate((path - edge, path[-1] + end * cap, (path + edge)[::-1], path[0] - start * cap))


def cut_ribbon(path: Loop, sides: Loop, width: float) -> Loop:
    """Return the same with its ends cut off: for a line whose ends something else hides."""
    edge = sides * (width / 2)
    return np.concatenate((path - edge, (path + edge)[::-1]))


def rod(begin: float, end: float, radius: float) -> Loop:
    """Return a bar along the real axis, its ends round about these places."""
    edge = 1j * radius
    cap = np.concatenate(([-edge], _cap(radius), [edge]))
    return np.concatenate((end + cap, begin - cap))


@lru_cache(maxsize=64)
def _cap(radius: float) -> Loop:
    """Return the round end of a line along the real axis, without the ends of its edges."""
    return _kept(_arc(-pi / 2, pi, radius)[1:-1])


def _kept(loop: Loop) -> Loop:
    """Return an outline that many hold, not to be written to."""
    loop.flags.writeable = False
    return loop


def segments(begin: ArrayLike, end: ArrayLike, width: float) -> list[Loop]:
    """Return separate straight lines of this width with square ends, one for each pair."""
    begin, end = (np.atleast_1d(np.asarray(ends, np.complex128)) for ends in (begin, end))
    along = end - begin
    side = 0.5j * width * along / np.maximum(lengths(along), 1e-9)
    return list(np.stack((begin - side, end - side, end + side, begin + side), axis=1))


def dashes(begin: complex, end: complex, step: float, width: float) -> list[Loop]:
    """Return a dashed line with square ends, one dash to a step; of a line far beyond any window a few."""
    along, reach = unit(end - begin), length(end - begin)
    step = max(step, reach / MOST_MARKS)
    feet = begin + along * np.arange(0.0, reach, step)
    return segments(feet, feet + 0.6 * step * along, width)


def cut(loop: Loop, limit: float, *, down: bool = False) -> Loop:
    """Return a closed loop without what reaches right of a limit, or below it (Sutherland, Hodgman 1974)."""
    place = loop.imag if down else loop.real
    inside, after = place <= limit, np.roll(loop, -1)
    if inside.all():
        return loop
    crosses, step = inside != np.roll(inside, -1), np.roll(place, -1) - place
    share = (limit - place) / np.where(crosses, step, 1)
    points = np.stack((loop, loop + share * (after - loop)), axis=1)
    found: Loop = points[np.stack((inside, crosses), axis=1)]
    return found


def arrows(feet: ArrayLike, reaches: ArrayLike, width: float, rim: ArrayLike = 0.0) -> list[Loop]:
    """Return an arrow from each foot, widened all round by a rim (one for all, or one for each).

    Short ones are smaller arrows.
    """
    feet, reaches = (np.asarray(ends, np.complex128) for ends in (feet, reaches))
    rim = np.asarray(rim, np.float64)
    long = lengths(reaches)
    head = np.minimum(4.2 * width, 0.6 * long)
    half = np.minimum(width / 2, head / 5)
    of_length, of_head, of_width, of_rim = _ARROW
    corners = of_length * long + of_head * head + of_width * half + of_rim * rim
    turn = reaches / np.where(long > 0, long, 1)
    return list((feet + turn * corners).T)


_ARROW = np.array(
    (
        (0, 1, 1, 1, 1, 1, 0),
        (0, -0.9, -1 - 0.42j, 0, -1 + 0.42j, -0.9, 0),
        (-1j, -1j, 0, 0, 0, 1j, 1j),
        (-1 - 1j, -1 - 1j, -1 - 1.5j, 2, -1 + 1.5j, -1 + 1j, -1 + 1j),
    )
)[..., None]
"""An arrow's corners in shares of its length, of its head's, of half its width and of its rim."""


def unit(vector: complex) -> complex:
    """Return the direction of a vector; to the right where it has no length."""
    size = length(vector)
    return vector / size if size > 0 else 1 + 0j


def hull(points: Sequence[complex]) -> list[complex]:
    """Return the corners of the convex hull (monotone chain, Andrew 1979)."""
    ordered = sorted(set(points), key=lambda point: (point.real, point.imag))
    if len(ordered) < 3:
        return ordered
    lower, upper = _chain(ordered), _chain(ordered[::-1])
    return lower[:-1] + upper[:-1]


def framed(points: Loop) -> Loop:
    """Return the corners of a rectangle that holds all points, along the longest side of their hull."""
    corners = np.array(hull(points.tolist()))
    sides = np.roll(corners, -1) - corners
    along = unit(complex(sides[np.abs(sides).argmax()]))
    level = points * along.conjugate()
    (left, right), (top, bottom) = ((part.min(), part.max()) for part in (level.real, level.imag))
    rectangle: Loop = along * np.array(
        [complex(left, top), complex(right, top), complex(right, bottom), complex(left, bottom)]
    )
    return rectangle


def _chain(points: Sequence[complex]) -> list[complex]:
    chain: list[complex] = []
    for point in points:
        while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 1e-9 * abs(point - chain[-2]):
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: complex, b: complex, c: complex) -> float:
    return ((b - a).conjugate() * (c - b)).imag


def _arc(begin: float, sweep: float, radius: float) -> Loop:
    """Return an arc about the origin; the chords stay within 0.02 px of it, but far beyond any window."""
    step = max(2 * np.arccos(max(1 - 0.02 / max(radius, 0.02), 0.5)), sweep / MOST_MARKS)
    count = max(int(np.ceil(sweep / step)), 2)
    arc: Loop = radius * directions(begin + sweep / count * np.arange(count + 1))
    return arc


def offsets(path: Loop) -> Loop:
    """Return at each point of paths (..., points) the way to the left edge of a line 2 wide.

    It is mitred up to twice its width.
    """
    along = path[..., 1:] - path[..., :-1]
    normal = 1j * along / lengths(along)
    between = (normal[..., :-1] + normal[..., 1:]) / 2
    joined = np.concatenate((normal[..., :1], between, normal[..., -1:]), axis=-1)
    sides: Loop = joined / np.maximum(joined.real**2 + joined.imag**2, 0.25)
    return sides
