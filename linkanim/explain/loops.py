"""The vector loops of a linkage: the two ways to each dyad's joint, as equations and as arrows."""

from __future__ import annotations

from itertools import takewhile
from typing import NamedTuple

from linkanim.explain.chains import LoopSide, Route
from linkanim.explain.expression import ZERO, Formula, Symbol, along
from linkanim.explain.kinds import KINDS
from linkanim.explain.lines import Chapter, Equation, Step, Unknown, ValueLine, marked
from linkanim.explain.work import Work
from linkanim.mechanics.linkage.joint import Joint

CYLINDER = Symbol("ℓ")
"""The length of the cylinder that drives."""


class LoopArrow(NamedTuple):
    """A vector of a loop where it lies, x + yi in the scene's unit."""

    symbol: Symbol
    begin: complex
    end: complex


class VectorLoop(NamedTuple):
    """A dyad's loop: what is said of it, and its vectors."""

    step: Step
    arrows: tuple[LoopArrow, ...]


class _Chain(NamedTuple):
    """The way from a fixed pin: the pin, and the vectors with the places at which they begin."""

    root: str
    sides: tuple[tuple[LoopSide, complex], ...]


def loops_of(work: Work, places: Chapter) -> tuple[VectorLoop, ...]:
    """Return the loop of each dyad, in the order in which they are solved by the lines of their positions."""
    found = {
        step.title: {item.value.symbol for item in step.items if isinstance(item, ValueLine)}
        for step in places.steps
    }
    dyads = (joint for joint in work.linkage.joints if KINDS[type(joint)].loop)
    loops = tuple(_loop(joint, work, found.get(f"Joint {marked(joint.name)}", set())) for joint in dyads)
    lines = [item for step in places.steps for item in step.items if isinstance(item, ValueLine)]
    length = next((line.value for line in lines if line.value.symbol == CYLINDER), None)
    return loops if length is None else (_cylinder(length, work), *loops)


def _cylinder(length: Formula, work: Work) -> VectorLoop:
    """Return the loop of a cylinder that drives the crank, from the crank's pivot over its foot and head."""
    between, crank = work.linkage.drive.actuator.along, work.linkage.crank(work.linkage.drive.joint)
    assert between is not None
    (pivot, foot, head), turned = (crank.pivot, *between), work.angles[crank.pivot, crank.name]
    ends = [work.place(name) for name in (pivot, foot, head)]
    tilt = Formula("leaf", symbol=Symbol("θ", CYLINDER.letter), shown="0")
    names = [Symbol(letter, index, bold=True) for letter, index in (("R", "g"), ("L", ""), ("R", "c"))]
    base, arm, way = (
        work.points[foot] - work.points[pivot],
        work.points[head] - work.points[pivot],
        along(tilt),
    )
    bold = [Formula("leaf", symbol=name, shown="0") for name in names]
    equations = (
        Equation(bold[0] + bold[1], bold[2]),
        Equation(base.x + length * way.x, arm.x),
        Equation(base.y + length * way.y, arm.y),
    )
    arrows = tuple(
        LoopArrow(name, ends[begin], ends[end])
        for name, begin, end in zip(names, (0, 1, 0), (1, 2, 2), strict=True)
    )
    return VectorLoop(Step("Loop of the cylinder", (*equations, Unknown((turned, tilt)))), arrows)


def _loop(joint: Joint, work: Work, found: set[Symbol | None]) -> VectorLoop:
    close = KINDS[type(joint)].loop
    assert close is not None
    one, other = (_from_ground(route, work) for route in close(joint, work))
    same = sum(
        1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one.sides, other.sides, strict=False))
    )
    left, right = list(one.sides[same:]), list(other.sides[same:])
    if one.root != other.root:
        right.insert(0, _ground(work, one.root, other.root))
    sides = [[side for side, _ in way] for way in (left, right)]
    bold = [sum((Formula("leaf", symbol=side.symbol, shown="0") for side in way), ZERO) for way in sides]
    parts = [[sum((side.vector[n] for side in way), ZERO) for way in sides] for n in (0, 1)]
    equations = [Equation(*pair) for pair in (bold, *parts)]
    arrows = tuple(LoopArrow(side.symbol, at, at + _value(side)) for side, at in (*left, *right))
    known = {leaf.symbol: leaf for pair in parts for side in pair for leaf in side.leaves}
    unknown = tuple(leaf for symbol, leaf in known.items() if symbol in found)
    return VectorLoop(Step(f"Loop of {marked(joint.name)}", (*equations, Unknown(unknown))), arrows)


def _ground(work: Work, start: str, end: str) -> tuple[LoopSide, complex]:
    """Return the way between two fixed pins, by length and angle where it is stated so."""
    index, way = work.names.length(start, end), work.points[end] - work.points[start]
    length, angle = (work.given.get(Symbol(letter, index)) for letter in "rθ")
    if length and angle:
        way = along(angle.value).times(length.value)
    return LoopSide(Symbol("R", index, bold=True), way), work.place(start)


def _from_ground(route: Route, work: Work) -> _Chain:
    """Return the whole way to where a route leads, from a fixed pin."""
    sides, at = [], work.place(route.start)
    for side in route.sides:
        sides.append((side, at))
        at += _value(side)
    further = KINDS[type(work.linkage.joint(route.start))].route
    if further is None:
        return _Chain(route.start, tuple(sides))
    before = _from_ground(further(work.linkage.joint(route.start), work), work)
    return _Chain(before.root, (*before.sides, *sides))


def _value(side: LoopSide) -> complex:
    return complex(side.vector.x.value, side.vector.y.value)
