"""Name and measure dimensions: r₁ for the ground, r₂ for the crank, and so on, with lines and arcs.

What each symbol measures follows from the linkage. Dimension lines have arrows at both ends and stand beside
what they measure, with extension lines (leads) from it; angles have arcs.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from math import degrees
from typing import NamedTuple

import numpy as np

from linkanim.mechanics.linkage import Body, Brace, Rigid
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Part, arrows, dashes, directions, segments, stroke, unit
from linkanim.picture.text import subscripted
from linkanim.picture.view import View
from linkanim.units import short, typeset
from linkanim.words import said

# Dimension lines with arrows at both ends beside what is measured, the leads to them, and arcs of angles.

_OVER = 2.5
"""How far a lead extends beyond its dimension line, in widths of that line."""
_OFF = 1.2
"""Where a lead begins, in half widths of a bar from what is measured."""


class MeasureLine(NamedTuple):
    """A dimension line from `begin` to `end`, in a frame where 1 is the vector from joint to joint, y down.

    It lies `reach` pixels aside. In a frame that names one joint twice, 1 is the scene's unit to the right.
    """

    frame: tuple[str, str]
    begin: complex
    end: complex
    reach: float

    def part(self, span: float, gauge: Gauge, colour: Colour) -> Part:
        """Return the drawn line, for a frame `span` pixels long."""
        away = 1j * self.reach * unit(self.end - self.begin)
        ends = span * self.begin, span * self.end
        at, head = self.frame
        return Part(at, at, head, (Layer(colour, dimension_line(*ends, away, gauge)),))

    def tracks(self, at: Loop, span: Loop, gauge: Gauge) -> Loop:
        """Return the line and its leads, begin and end of each (n moments, 3, 2), for a frame at `at`.

        `span` is the vector from the frame's first joint to its second.
        """
        begin, end = at + self.begin * span, at + self.end * span
        along = end - begin
        side = 1j * along / np.maximum(np.abs(along), 1e-9) * np.sign(self.reach)
        level, near = side * abs(self.reach), side * _OFF * gauge.bar
        pairs = (begin + level, end + level), (begin + near, begin + level), (end + near, end + level)
        return np.moveaxis(np.array(pairs), -1, 0)

    def bases(self, at: Loop, span: Loop, tracks: Loop) -> Iterator[tuple[Loop, Loop]]:
        """Yield places in the scene's unit, each with an end of the line, which stays as far off it."""
        yield at + self.begin * span, tracks[:, 0, 0]
        yield at + self.end * span, tracks[:, 0, 1]


class AngleArc(NamedTuple):
    """An angle in the frame of two joints, between two directions; `radius` in pixels."""

    frame: tuple[str, str]
    begin: complex
    end: complex
    radius: float

    def part(self, span: float, gauge: Gauge, colour: Colour) -> Part:
        """Return the drawn angle: the arc, and a lead along each of its sides."""
        sweep = float(np.angle(self.end / self.begin))
        path = self.radius * unit(self.begin) * directions(np.linspace(0, sweep, 2 + round(12 * abs(sweep))))
        leads = [side * (self.radius + _OVER * gauge.line) for side in map(unit, (self.begin, self.end))]
        at, head = self.frame
        loops = [*stroke(path, 0.9 * gauge.line), *segments([0j, 0j], leads, 0.7 * gauge.line)]
        return Part(at, at, head, (Layer(colour, loops),))

    def tracks(self, at: Loop, span: Loop, gauge: Gauge) -> Loop:
        """Return the arc's chords and its leads, begin and end of each (n moments, 4, 2)."""
        turn = (span / np.maximum(np.abs(span), 1e-9))[:, None] * self.radius * unit(self.begin)
        shares = np.linspace(0, float(np.angle(self.end / self.begin)), 5)
        points = at[:, None] + turn * directions(shares)
        pairs: Loop = np.stack((points[:, :-1], points[:, 1:]), axis=2)
        return pairs

    def bases(self, at: Loop, span: Loop, tracks: Loop) -> Iterator[tuple[Loop, Loop]]:
        """Yield places in the scene's unit, each with a point of the arc, which stays as far off it."""
        for n in range(tracks.shape[1]):
            yield at, tracks[:, n, 0]
        yield at, tracks[:, -1, 1]


def dimension_line(begin: complex, end: complex, away: complex, gauge: Gauge) -> list[Loop]:
    """Return a dimension line, `away` from what it measures, with arrows at both ends and its leads."""
    width, side = 0.9 * gauge.line, unit(away)
    feet = np.array([begin, end])
    near = min(_OFF * gauge.bar, 0.5 * abs(away))
    leads = segments(feet + near * side, feet + away + _OVER * width * side, 0.7 * width)
    middle = (begin + end) / 2 + away
    return [*leads, *arrows([middle, middle], [begin + away - middle, end + away - middle], 1.6 * width)]


# The textbook's symbols: r₁ for the ground, r₂ for the crank, and so on; what each one measures.

_NONE = 1e-9
"""Share of a figure's extent, or angle in radians, below which a dimension is not stated."""


class Measurement(NamedTuple):
    """A length between two places of a body or the ground, or the `angle` between two directions.

    `begin` and `end` are in a frame where 1 is the vector from joint to joint, y down; where the frame names
    one joint twice, 1 is the scene's unit to the right. A length is in the scene's unit, an angle in degrees.
    `own` are the joints whose bodies it lies on; where it is `bare`, only its own bar runs from end to end.
    """

    symbol: str
    value: float
    about: str
    frame: tuple[str, str]
    begin: complex
    end: complex
    own: frozenset[str]
    bare: bool = False
    angle: bool = False

    def written(self, unit: str) -> str:
        """Return the dimension in words: r₂ = 40 mm."""
        return typeset(f"{self.symbol} = {short(self.value)}{'°' if self.angle else ' ' + unit}")


class Symbols(NamedTuple):
    """A figure's dimensions, the points stated along a body and to its side, and the symbol of its input."""

    dimensions: tuple[Measurement, ...]
    points: tuple[Rigid, ...]
    input: str

    def legs(self, figure: Figure, point: Rigid) -> tuple[str, ...]:
        """Return the symbol of each of a point's lengths, that of another one where both are one length."""
        spans = {_span(figure, one): one.symbol for one in self.dimensions if not one.angle}
        return tuple(spans[_span(figure, leg)] for leg in _legs(figure, point))


def symbols(figure: Figure) -> Symbols:
    """Number a figure's lengths: links that the scene calls by numbers keep them; else in their order.

    r₁ is the ground from the driven pivot to the next one, r₂ the first body's bar. A further ground length
    comes after the body on whose pivot it begins; then a body's second length, with β of its number for the
    angle between the two. Points of bodies come last: one length for a point in line with the body, else a
    length along it and one to its side. e is how far a guide is from the first pivot. A length that several
    bodies share is stated once.
    """
    bodies = [body for body in figure.bodies if body.name or not figure.linkage.bodies]
    ground = (*_ground(figure), *_offsets(figure))
    if bodies and all(body.name.isdecimal() for body in bodies):
        named = [_bar(figure, body.name, *body.joints[:2], bare=len(body.joints) == 2) for body in bodies]
        return Symbols((*ground, *named), (), _angle(figure))
    points = _points(figure)
    measurements = (*_measured(figure, bodies), *(leg for point in points for leg in _legs(figure, point)))
    return Symbols((*ground, *_numbered(figure, measurements)), tuple(points), _angle(figure))


def leg_part(point: Rigid, view: View, gauge: Gauge, colour: Colour) -> Part:
    """Return the two lines, dashed, that lead from a body's first joint to a point of it."""
    along, left = point.at
    corner = complex(view.scale * along)
    there = complex(view.scale * along, -view.scale * left)
    lines = ((0j, corner), (corner, there)) if left else ()
    loops = [loop for ends in lines for loop in dashes(*ends, 4 * gauge.line, 0.9 * gauge.line)]
    first, second = point.on
    return Part(first, first, second, (Layer(colour, loops),))


def pivots(figure: Figure) -> list[str]:
    """Return the fixed pins on which bars turn: the driven one, then as joints need them."""
    ends = {name for body in figure.bodies for name in body.joints}
    first = figure.linkage.driven.pivot
    needed = [name for joint in figure.linkage.joints for name in joint.needs]
    order = [first, *needed, *figure.fixed]
    return sorted((name for name in figure.fixed if name in ends), key=order.index)


def _ground(figure: Figure) -> Iterator[Measurement]:
    """Yield the length of the ground, and its angle where it is not horizontal."""
    for first, second in pairwise(pivots(figure)[:2]):
        yield _bar(figure, "1", first, second, bare=True)
        span = figure.start(second) - figure.start(first)
        if abs(span.imag) > _NONE * figure.extent:
            value, about = (
                degrees(float(np.angle(span))),
                said("angle of {line} to the horizontal", line=_named(first, second)),
            )
            yield Measurement(
                "θ₁", value, about, (first, first), 1, span.conjugate(), frozenset(), angle=True
            )


def _offsets(figure: Figure) -> Iterator[Measurement]:
    """Yield how far guides on the ground are from the first pivot, for those that run through no pivot."""
    offsets, names = [], pivots(figure)
    lines = [(joint, line) for joint in figure.linkage.joints if (line := getattr(joint, "line", None))]
    for joint, line in lines if names else ():
        across = -1j * complex(directions(line.angle))
        place = figure.start(joint.name)
        off = [((place - figure.start(name)) * across.conjugate()).real for name in names]
        if line.on is None and min(map(abs, off)) > _NONE * figure.extent:
            offsets.append((joint.name, off[0] * across))
    for n, (name, foot) in enumerate(offsets, start=1):
        symbol = subscripted(f"e{n}") if len(offsets) > 1 else "e"
        about = said("{pin} to the guide of {joint}", pin=_named(names[0]), joint=_named(name))
        yield Measurement(symbol, abs(foot), about, (names[0], names[0]), 0, foot.conjugate(), frozenset())


def _numbered(figure: Figure, measurements: Iterable[Measurement]) -> Iterator[Measurement]:
    """Yield each span once, numbered from 2, and an angle with the number of the length that it leads to."""
    numbers: dict[frozenset[complex], int] = {}
    for one in measurements:
        if not one.angle:
            span = _span(figure, one)
            stated = span in numbers
            number = numbers.setdefault(span, len(numbers) + 2)
        if one.angle or not stated:
            yield one._replace(symbol=subscripted(f"{one.symbol}{number}"))


def _span(figure: Figure, one: Measurement) -> frozenset[complex]:
    """Return where a length's ends are as the cycle begins, rounded to a small part of the figure."""
    at, head = (figure.start(name) for name in one.frame)
    span, grain = head - at if one.frame[0] != one.frame[1] else 1 + 0j, _NONE * figure.extent
    ends = (at + complex(place).conjugate() * span for place in (one.begin, one.end))
    return frozenset(complex(round(end.real / grain), round(end.imag / grain)) for end in ends)


def _measured(figure: Figure, bodies: list[Body]) -> Iterator[Measurement]:
    """Yield the lengths of bodies and between pivots, each before its angle; they have no numbers yet."""
    others = pivots(figure)
    for body in bodies:
        first, *rest = [name for n, name in enumerate(body.joints) if n < 2 or name in figure.pins]
        yield _bar(figure, "", first, rest[0], bare=len(body.joints) == 2)
        if len(others) > 2 and others[1] in body.joints:
            yield from _with_angle(figure, others[1], others[0], others[2], bare=True)
            others = others[1:]
        for name in rest[1:]:
            yield from _with_angle(figure, first, rest[0], name)
        for joint in (joint for joint in figure.linkage.joints if isinstance(joint, Brace)):
            for start, _ in joint.bars if {*joint.on, joint.name} <= set(body.joints) else ():
                if first not in (start, joint.name):
                    yield _bar(figure, "", start, joint.name)


def _with_angle(
    figure: Figure, at: str, side: str, name: str, *, bare: bool = False
) -> Iterator[Measurement]:
    """Yield the length from `at` to `name`, and the angle there from `side`, unless other lengths give it."""
    yield _bar(figure, "", at, name, bare=bare)
    if figure.start(side) == figure.start(at):
        return
    turn = (figure.start(name) - figure.start(at)) / (figure.start(side) - figure.start(at))
    if abs(turn.imag) > _NONE * abs(turn) and not isinstance(figure.linkage.joint(name), Brace):
        value, own = abs(degrees(float(np.angle(turn)))), frozenset() if bare else frozenset((at, side, name))
        about = _named(side, at, name)
        yield Measurement("β", value, about, (at, side), 1, turn.conjugate(), own, angle=True)


def _points(figure: Figure) -> list[Rigid]:
    joints = figure.linkage.joints
    return [joint for joint in joints if isinstance(joint, Rigid) and joint.name not in figure.pins]


def _legs(figure: Figure, point: Rigid) -> Iterator[Measurement]:
    """Yield a point's distance from its body's first joint; for a point off the axis, along it and aside."""
    (first, second), (along, left), name = point.on, point.at, point.name
    span, own = abs(figure.start(second) - figure.start(first)), frozenset((first, second, name))
    corner, there = complex(along) / span, complex(along, -left) / span
    aside = said("{point} off {line}", point=_named(name), line=_named(first, second))
    level = _named(first, name)
    if left:
        level = said("{point} along {line}", point=_named(first), line=_named(first, second))
    for value, begin, end, about in ((along, 0j, corner, level), (left, corner, there, aside)):
        if value:
            yield Measurement("r", abs(value), about, point.on, begin, end, own)


def _bar(figure: Figure, number: str, begin: str, end: str, *, bare: bool = False) -> Measurement:
    stated = {
        frozenset((joint.name, start)): length
        for joint in figure.linkage.joints
        for start, length in joint.bars
    }
    apart = abs(figure.start(end) - figure.start(begin))
    value, ends = stated.get(frozenset((begin, end)), apart), (begin, end)
    own = frozenset(() if begin in figure.fixed and end in figure.fixed else ends)
    symbol = subscripted(f"r{number}") if number else "r"
    return Measurement(symbol, value, _named(*ends), ends, 0, 1, own, bare)


def _named(*joints: str) -> str:
    return "–".join(map(subscripted, joints))


def _angle(figure: Figure) -> str:
    if figure.linkage.driven.base is not None:
        return subscripted(f"θ{figure.linkage.driven.pivot}")
    driven = figure.linkage.driven.body
    joints = set(driven.joints) if driven else {""}
    number = next((n for body, n in figure.numbers.items() if joints <= set(body.joints)), "2")
    return subscripted(f"θ{number}")
