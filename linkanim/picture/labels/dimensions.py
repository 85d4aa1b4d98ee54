"""The textbook's symbols: r₁ for the ground, r₂ for the crank, and so on; which length each one is."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import NamedTuple

import numpy as np

from linkanim.digits import short, typeset
from linkanim.mechanics.facts.register import driven_body
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.rigid_bodies import Brace, Rigid
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster.parts import Part
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import segments, unit
from linkanim.picture.view import View

_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


class Distance(NamedTuple):
    """The distance between two joints of one body, or of the ground, in the scene's unit."""

    symbol: str
    begin: str
    end: str
    value: float


class Legs(NamedTuple):
    """How a point lies on its body: along from its first joint, then to the left; a symbol for each."""

    symbols: tuple[str, str]
    point: Rigid


class Symbols(NamedTuple):
    """A figure's dimensions and the angle of its input."""

    dimensions: tuple[Distance, ...]
    legs: tuple[Legs, ...]
    input: str


def symbols(figure: Figure) -> Symbols:
    """Number a figure's lengths: links that the scene calls by numbers keep them; else in their order.

    r₁ is the ground from the driven pivot to the next, r₂ the first body's bar; a further ground length
    comes after the body on whose pivot it begins, a body's second length after that. The numbers that
    are left go to the points of bodies, two for each.
    """
    bodies = [body for body in figure.bodies if body.name or not figure.linkage.bodies]
    if bodies and all(body.name.isdecimal() for body in bodies):
        named = [_bar(figure, body.name, *body.joints[:2]) for body in bodies]
        return Symbols((*_ground(figure), *named), (), _angle(figure))
    numbers = (str(n) for n in count(2))
    found = list(_numbered(figure, bodies, numbers))
    legs = tuple(Legs((_symbol(next(numbers)), _symbol(next(numbers))), point) for point in _points(figure))
    return Symbols((*_ground(figure), *found), legs, _angle(figure))


def leg_part(legs: Legs, view: View, gauge: Gauge, colour: Colour) -> Part:
    """Return the two lines, dashed, that lead from a body's first joint to a point of it."""
    along, left = legs.point.at
    corner = complex(view.scale * along)
    point = complex(view.scale * along, -view.scale * left)
    loops = []
    for begin, end in ((0j, corner), (corner, point)):
        if begin == end:
            continue
        step = 4 * gauge.line * unit(end - begin)
        feet = begin + step * np.arange(int(abs(end - begin) / (4 * gauge.line)) + 1)
        loops += segments(feet, feet + 0.6 * step, 0.9 * gauge.line)
    first, second = legs.point.on
    return Part(first, first, second, (Layer(colour, loops),))


def written(symbol: str, value: float, unit: str) -> str:
    """Return a dimension as it is set: r₂ = 40 mm."""
    return f"{symbol} = {typeset(short(value))} {unit}"


def pivots(figure: Figure) -> list[str]:
    """Return the fixed pins on which bars turn, the driven one first."""
    ends = {name for body in figure.bodies for name in body.joints}
    first = getattr(figure.linkage.joint(figure.linkage.drive.joint), "pivot", None)
    return sorted((name for name in figure.fixed if name in ends), key=lambda name: name != first)


def _ground(figure: Figure) -> Iterator[Distance]:
    for first, second in zip(pivots(figure)[:1], pivots(figure)[1:2], strict=False):
        yield _bar(figure, "1", first, second)


def _numbered(figure: Figure, bodies: list[Body], numbers: Iterator[str]) -> Iterator[Distance]:
    others = pivots(figure)[1:]
    for body in bodies:
        first, *rest = [name for n, name in enumerate(body.joints) if n < 2 or name in figure.pins]
        yield _bar(figure, next(numbers), first, rest[0])
        if others and others[0] in body.joints and len(others) > 1:
            yield _bar(figure, next(numbers), *others[:2])
            others = others[1:]
        for name in rest[1:]:
            yield _bar(figure, next(numbers), first, name)
        for joint in (joint for joint in figure.linkage.joints if isinstance(joint, Brace)):
            for start, _ in joint.bars if {*joint.on, joint.name} <= set(body.joints) else ():
                if first not in (start, joint.name):
                    yield _bar(figure, next(numbers), start, joint.name)


def _points(figure: Figure) -> list[Rigid]:
    joints = figure.linkage.joints
    return [joint for joint in joints if isinstance(joint, Rigid) and joint.name not in figure.pins]


def _bar(figure: Figure, number: str, begin: str, end: str) -> Distance:
    stated = {
        frozenset((joint.name, start)): length
        for joint in figure.linkage.joints
        for start, length in joint.bars
    }
    apart = abs(figure.start(end) - figure.start(begin))
    return Distance(_symbol(number), begin, end, stated.get(frozenset((begin, end)), apart))


def _angle(figure: Figure) -> str:
    driven = driven_body(figure.linkage)
    joints = set(driven.joints) if driven else {""}
    number = next((n for body, n in figure.numbers.items() if joints <= set(body.joints)), "2")
    return f"θ{_lowered(number)}"


def _symbol(number: str) -> str:
    return f"r{_lowered(number)}"


def _lowered(number: str) -> str:
    return number.translate(_LOWERED)
