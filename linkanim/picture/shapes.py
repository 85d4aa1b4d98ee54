"""Make outlines in pixels: closed loops of complex numbers x + yi that all turn the same way.

Directions and lengths consist of + - × ÷, rint and square roots only, so that every machine has the same
bits. A `Part` is a rigid thing that moves: its outline is made once, and then only turned and placed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from math import atan2, pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.angles import PI_PARTS, tangent
from linkanim.picture.raster import Colour, Layer, Loop, outlines_of

# Directions and lengths for outlines, out of + - × ÷, rint and square roots: the same on every machine.
#
# The C library and numpy's vector units differ from machine to machine in the last digit of a sine or of
# an arctangent. Shapes use the functions here instead. Arctangents and arc cosines only say where an arc
# begins and ends or how a tooth's flank bends, and exponentials where a label rests; such a digit is 1e-13 of
# a pixel, and corners are rounded to 1/1024 of a pixel before anything is painted.

Directions = NDArray[np.complex128]

_GRAIN = float(1 << 24)
"""Directions are rounded to this many steps a radian."""


def directions(angles: ArrayLike) -> Directions:
    """Return cos + i sin of angles in radians, by the same formulas as poses (`mechanics.angles`)."""
    angle = np.asarray(angles, np.float64)
    quarters = np.rint(angle * (2 / pi))
    first, second, third, fourth = (0.5 * part for part in PI_PARTS)
    rest: Any = ((angle - quarters * first) - quarters * second) - quarters * (third + fourth)
    half: Any = tangent(rest, 2.0)
    norm = half * half + 4.0
    turned = np.empty(angle.shape, np.complex128)
    turned.real, turned.imag = (4.0 - half * half) / norm, 4.0 * half / norm
    directions: Directions = turned * np.array([1, 1j, -1, -1j])[quarters.astype(np.int64) & 3]
    return directions


def folded(turn: complex, fold: int) -> complex:
    """Return the direction nearest to 1 among those that look the same, `fold` of them (3 or more) a turn.

    It is rounded, far below what shows, so that a direction that recurs after parts of a turn is the same to
    the last digit.
    """
    turns, near = _turns(fold), round(atan2(-turn.imag, turn.real) / (2 * pi / fold))
    beside = sorted((near + n) % fold for n in (-1, 0, 1))
    nearest = max((turn * turns[n] for n in beside), key=lambda alike: alike.real)
    side = round(nearest.imag * _GRAIN) / _GRAIN
    return complex(sqrt(1.0 - side * side), side)


@lru_cache(maxsize=64)
def _turns(fold: int) -> tuple[complex, ...]:
    turns: list[complex] = directions(2 * pi / fold * np.arange(fold)).tolist()
    return tuple(turns)


def lengths(vectors: Directions) -> NDArray[np.float64]:
    """Return the lengths of vectors x + yi."""
    sizes: NDArray[np.float64] = np.sqrt(vectors.real * vectors.real + vectors.imag * vectors.imag)
    return sizes


def length(vector: complex) -> float:
    """Return the length of one vector."""
    return sqrt(vector.real * vector.real + vector.imag * vector.imag)


# Outlines in pixels, as closed loops of complex numbers x + yi that all turn the same way.
#
# They stand about the origin or where they were asked for; to place one, multiply it by a direction
# of length 1 and add a position.

MOST_MARKS = 20_000
"""The most dashes of a line, strokes of a hatching or chords of an arc: ten times what a window shows."""


@lru_cache(maxsize=64)
def disc(radius: float) -> Loop:
    """Return a circle about the origin, within 0.02 px of a true one; the latest results are cached."""
    return _kept(_arc(0.0, 2 * pi, radius)[:-1])


def rounded(points: Sequence[complex], radius: float) -> Loop:
    """Return the outline at this distance around the points' convex hull.

    One point gives a circle, two a bar with round ends, more a plate with round corners. The latest results
    are cached: while a hand drags, only one of a linkage's bars changes.
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
    """Return a rectangle about the origin, its corners rounded; the latest results are cached."""
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
    """Return a path without the points that repeat the one before them."""
    moves = path[1:] != path[:-1]
    return path if moves.all() else np.concatenate((path[:1], path[1:][moves]))


def ribbon(path: Loop, sides: Loop, width: float) -> Loop:
    """Return the outline of a line along an open path whose `offsets` are known, its ends round."""
    start, end = unit(path[1] - path[0]), unit(path[-1] - path[-2])
    cap, edge = _cap(width / 2), sides * (width / 2)
    return np.concatenate((path - edge, path[-1] + end * cap, (path + edge)[::-1], path[0] - start * cap))


def cut_ribbon(path: Loop, sides: Loop, width: float) -> Loop:
    """Return the outline as `ribbon` does, with square ends: for a line whose ends something else hides."""
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
    """Return an outline made read-only, since several callers share it."""
    loop.flags.writeable = False
    return loop


def segments(begin: ArrayLike, end: ArrayLike, width: float) -> list[Loop]:
    """Return separate straight lines of this width with square ends, one for each pair."""
    begin, end = (np.atleast_1d(np.asarray(ends, np.complex128)) for ends in (begin, end))
    along = end - begin
    side = 0.5j * width * along / np.maximum(lengths(along), 1e-9)
    return list(np.stack((begin - side, end - side, end + side, begin + side), axis=1))


DASH = ((0.0, 0.6),)
"""Where a plain dash begins and ends, in steps."""
DASH_DOT = ((0.0, 5 / 9), (6.8 / 9, 7.7 / 9))
"""Where a dash and a dot begin and end, in steps."""


def dashes(
    begin: complex,
    end: complex,
    step: float,
    width: float,
    marks: Sequence[tuple[float, float]] = DASH,
) -> list[Loop]:
    """Return a dashed line with square ends; each step has the same `marks`, given as shares of the step.

    The last mark is as long as the others. A line far larger than any window has fewer and longer marks.
    """
    along, reach = unit(end - begin), length(end - begin)
    step = max(step, reach / MOST_MARKS)
    feet = begin + along * np.arange(0.0, reach, step)
    ways = [(step * low * along, step * high * along) for low, high in marks]
    return [loop for low, high in ways for loop in segments(feet + low, feet + high, width)]


def dashed(run: Loop, dashes: NDArray[np.float64]) -> Iterator[Loop]:
    """Yield the pieces of a path cut into dashes, each followed by a gap; the last one ends with the path."""
    gone = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(run)))))
    ends = np.concatenate(([0.0], np.cumsum(dashes)))
    for start in np.arange(0.0, gone[-1], ends[-1]):
        for begin, end in start + ends[:-1].reshape(-1, 2):
            along = np.concatenate(([begin], gone[(gone > begin) & (gone < end)], [min(end, gone[-1])]))
            if begin < gone[-1]:
                yield np.interp(along, gone, run.real) + 1j * np.interp(along, gone, run.imag)


def cut(loop: Loop, limit: float, *, down: bool = False) -> Loop:
    """Return a closed loop without its part right of a limit, or below it (Sutherland and Hodgman 1974)."""
    place = loop.imag if down else loop.real
    inside, after = place <= limit, np.roll(loop, -1)
    if inside.all():
        return loop
    crosses, step = inside != np.roll(inside, -1), np.roll(place, -1) - place
    share = (limit - place) / np.where(crosses, step, 1)
    points = np.stack((loop, loop + share * (after - loop)), axis=1)
    inner: Loop = points[np.stack((inside, crosses), axis=1)]
    return inner


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


def units(vectors: Loop) -> Loop:
    """Return the directions of vectors; to the right where one has no length."""
    length_ = lengths(vectors)
    unit_vectors: Loop = np.where(length_ > 0, vectors / np.where(length_ > 0, length_, 1), 1)
    return unit_vectors


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
    """Return an arc about the origin; its chords stay within 0.02 px of it, unless it exceeds any window."""
    step = max(2 * np.arccos(max(1 - 0.02 / max(radius, 0.02), 0.5)), sweep / MOST_MARKS)
    count = max(int(np.ceil(sweep / step)), 2)
    arc: Loop = radius * directions(begin + sweep / count * np.arange(count + 1))
    return arc


def offsets(path: Loop) -> Loop:
    """Return from each point of paths (..., points) the vector to the left edge of a line 2 wide.

    Corners are mitred up to twice the line's width.
    """
    along = path[..., 1:] - path[..., :-1]
    normal = 1j * along / lengths(along)
    between = (normal[..., :-1] + normal[..., 1:]) / 2
    joined = np.concatenate((normal[..., :1], between, normal[..., -1:]), axis=-1)
    sides: Loop = joined / np.maximum(joined.real**2 + joined.imag**2, 0.25)
    return sides


# Rigid things that move: their outlines are made once and then only turned and placed.

_GLAZED = 0.6
"""The opacity of a plate's fill."""

_LIT = 0.05
"""An edge that faces upwards by less than this catches no light."""
Places = Mapping[str, complex]
"""Where the joints lie in pixels, as x + yi."""


@frozen
class Part:
    """Layers about the joint `at`, drawn as they lie where the direction from `tail` to `head` is 1.

    Without a direction (`tail` == `head`) the part is not turned. The pins of `joints` go through it. A part
    that looks the same `fold` times a turn (3 or more) is turned by the least equal angle only.
    """

    at: str
    tail: str
    head: str
    layers: tuple[Layer, ...]
    joints: tuple[str, ...] = ()
    name: str = ""
    fold: int = 1
    shadow: tuple[complex, Layer] | None = None
    """What it throws on what is below, and how far that lies from it on the picture, in pixels."""
    edges: tuple[tuple[complex, Layer], ...] = ()
    """Its edges that may catch the light: layers, and the direction in which each faces."""
    reaches: tuple[str, ...] = ()
    """Joints that travel along it, beside those that go through it: it is as long as they need."""
    sized: tuple[str, str] | None = None
    """The two joints whose distance its whole size follows: those between which a gear pair lies."""

    @property
    def title(self) -> str:
        """What its group is called: by its body, or by the joint that it is fitted to."""
        return f"body-{self.name}" if self.name else f"fitting-{self.at}"

    def placed(self, places: Places) -> list[Layer]:
        """Return the layers where the joints now lie."""
        at, turn = places[self.at], self.turn(places)
        layers = [self.shadow[1].placed(at + self.shadow[0], turn)] if self.shadow else []
        layers += [layer.placed(at, turn) for layer in self._joined]
        for facing, layer in self.edges:
            up = -(facing * turn).imag
            if up > _LIT:
                layers.append(layer._replace(alpha=up * layer.alpha).placed(at, turn))
        return layers

    def turn(self, places: Places) -> complex:
        """Return the direction that the part is turned by."""
        turn = unit(places[self.head] - places[self.tail])
        return folded(turn, self.fold) if self.fold > 2 else turn

    @cached_property
    def _joined(self) -> tuple[Layer, ...]:
        return joined(self.layers)


@frozen(eq=False)  # outlines are arrays, which do not compare
class Stamp:
    """Layers about the origin that are put down at many places without turning."""

    layers: tuple[Layer, ...]

    def at(self, centres: Sequence[complex]) -> list[Layer]:
        """Return the layers at all places at once."""
        return [layer.repeated(centres) for layer in self._joined]

    @cached_property
    def _joined(self) -> tuple[Layer, ...]:
        return joined(self.layers)


def joined(layers: Iterable[Layer]) -> tuple[Layer, ...]:
    """Return layers whose loops lie in one array each, so that they are placed together."""
    return tuple(layer._replace(loops=outlines_of(layer.loops)) for layer in layers)


def placed(parts: Iterable[Part], places: Places) -> list[Layer]:
    """Return the layers of all parts, in their order."""
    return [layer for part in parts for layer in part.placed(places)]


def by_depth(parts: Sequence[Part], names: Iterable[str]) -> tuple[tuple[str, ...], ...]:
    """Return which joints' pins are drawn before the first part, and which after each part.

    A pin lies on the foremost of the parts that it goes through, so that a part further forward hides it.
    """
    depth = {name: n for n, part in enumerate(parts, start=1) for name in part.joints}
    kept = tuple(names)
    return tuple(tuple(name for name in kept if depth.get(name, 0) == n) for n in range(len(parts) + 1))


def lined(points: list[complex], radius: float, width: float, colours: tuple[Colour, Colour]) -> list[Layer]:
    """Return a rounded outline around points in `colours`, edge and fill; the edge lies inside the radius."""
    edge, fill = colours
    return [Layer(edge, [rounded(points, radius)]), Layer(fill, [rounded(points, max(radius - width, 0.1))])]


def glazed(points: list[complex], radius: float, width: float, colours: tuple[Colour, Colour]) -> list[Layer]:
    """Return the same with a translucent fill that ends under the outline."""
    edge, fill = colours
    inner = rounded(points, max(radius - width, 0.1))
    pane = rounded(points, max(radius - width / 2, 0.1))
    return [Layer(fill, [pane], _GLAZED), Layer(edge, [rounded(points, radius), inner[::-1]])]


def slotted(
    points: Sequence[complex],
    slot: tuple[complex, complex],
    radii: tuple[float, float],
    width: float,
    colours: tuple[Colour, Colour],
) -> list[Layer]:
    """Return a rounded outline with a slot along a line in it, open to what lies behind.

    `radii` are half the widths of the bar and of its slot.
    """
    edge, fill = colours
    (bar, hole), ends = radii, list(slot)
    return [
        Layer(edge, [rounded(points, bar), rounded(ends, hole)[::-1]]),
        Layer(fill, [rounded(points, max(bar - width, 0.1)), rounded(ends, hole + width)[::-1]]),
    ]
