"""Collect the lines of a worked solution, each number in the digits that it shows.

Its parts, in reading order:

- The parts of a worked solution, in any kind of document: chapters, steps, lines.
- The symbols of a worked solution: those of the figure's dimensions and of the scene's links.
- A worked solution while it is put together: what is known so far, each number in the digits it shows.
- Velocities and accelerations, or kinematic coefficients: those known so far, and their lines.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cached_property
from typing import Literal, NamedTuple

from linkanim.explain.formula import (
    NOWHERE,
    TWO,
    ZERO,
    Components,
    Formula,
    Symbol,
    along,
    atan2,
    number,
    square,
)
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body, Crank, Damper, Linkage, Spring, holding
from linkanim.mechanics.linkage import Line as Travel
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.quantities import link_labels
from linkanim.picture.dimensions import symbols
from linkanim.picture.figure import Figure
from linkanim.units import signed
from linkanim.words import said, to_say

# The parts of a worked solution, in any kind of document: chapters, steps, lines.


def marked(joint: str) -> str:
    """Return a joint's name as it is marked in a text, by characters that no text of a scene contains."""
    return f"\x02{joint}\x03"


MARKED = re.compile("\x02([^\x02\x03]*)\x03")
"""A name that is marked."""
_TITLES = (
    to_say("Joint {joint}"),
    to_say("Joint {joint}, first coefficients"),
    to_say("Joint {joint}, second coefficients"),
)


def joint_title(joint: str, coefficients: Literal[0, 1, 2] = 0) -> str:
    """Return the title of a joint's step; it may be on its first or second kinematic coefficients."""
    return said(_TITLES[coefficients], joint=marked(joint))


@frozen
class ValueLine:
    """A symbol = a formula = the formula with its numbers = a value, in shown digits, with its unit."""

    formula: Formula
    value: Formula
    unit: str


@frozen
class Given:
    """A number that the scene states: a symbol = a value with its unit."""

    value: Formula
    unit: str
    words: str


@frozen
class Equation:
    """Two sides in symbols alone."""

    left: Formula
    right: Formula


@frozen
class System:
    """Linear equations: the unknowns, and rows of the matrix, each with its right side behind it.

    `values` are leaves; `formulas`, of two equations, what they follow from.
    """

    unknowns: tuple[Symbol, ...]
    values: tuple[tuple[Formula, ...], ...]
    formulas: tuple[tuple[Formula, ...], ...] = ()


@frozen
class Unknown:
    """Symbols in a row, as a rule those that two equations are solved for, and what they are."""

    symbols: tuple[Formula, ...]
    words: str


Item = str | ValueLine | Given | Equation | System | Unknown
"""What stands in a step. A text is a sentence; names of joints in it are `marked`."""


@frozen
class Step:
    """One stage of a chapter under a heading, such as a joint; names of joints are marked."""

    title: str
    items: tuple[Item, ...]


@frozen
class Chapter:
    """A part of the solution."""

    title: str
    steps: tuple[Step, ...]

    @property
    def items(self) -> Iterator[Item]:
        """All items of all steps."""
        return (item for step in self.steps for item in step.items)


NOTHING = 5e-7
"""A share of a number's size at a typical length and rate: a smaller number is nothing but rounding."""


@frozen
class Outcome:
    """A result: the token of its quantity, its value, and the size below which it is nothing but rounding.

    It is `last` where no position and no rate follows from it.
    """

    token: str
    value: Formula
    unit: str = ""
    least: float = NOTHING
    last: bool = False


# The symbols of a worked solution: those of the figure's dimensions and of the scene's links.

Pair = tuple[str, str]
BETWEEN = -1
"""The number that stands for the angle of a motor between two links that move."""
_PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


@frozen
class SymbolNames:
    """The symbols of lengths, angles and bodies of a linkage.

    `lengths` are the indices of the figure's lengths, by the two joints; `legs` the indices of a body's
    point, along the body's line and beside it, by the point's name.
    """

    linkage: Linkage
    lengths: Mapping[frozenset[str], str]
    legs: Mapping[str, tuple[str, ...]]

    def length(self, start: str, end: str) -> str:
        """Return the index of the length between two joints."""
        return self.lengths.get(frozenset((start, end)), start + end)

    def angle(self, start: str, end: str) -> str:
        """Return the index of the angle of a line from joint to joint: its body's label, or both names."""
        return self._angles.get((start, end), start + end)

    def turning(self, frame: int) -> str:
        """Return the index of a rigid body's angle, by the body's number."""
        return self._bodies[frame]

    def slide(self, joint: str) -> Symbol:
        """Return the symbol of a joint's travel along its guide."""
        labels = link_labels(self.linkage)
        block = next((labels[body.name] for body in self.linkage.bodies if body.slider == joint), "")
        return Symbol("s", block if block.isdecimal() else joint)

    @cached_property
    def _angles(self) -> dict[Pair, str]:
        labels = link_labels(self.linkage)
        turning = [body for body in self.linkage.bodies if body.slider is None]
        return {(body.joints[0], body.joints[1]): labels[body.name] for body in reversed(turning)}

    @cached_property
    def _bodies(self) -> dict[int, str]:
        labels = {n: "".join(list(frame)[:2]) for n, frame in enumerate(self.linkage.rigid_bodies)}
        for ends, label in self._angles.items():
            frame = holding(self.linkage.rigid_bodies, ends)
            if frame is not None:
                labels[frame] = label
        return labels | {BETWEEN: self.linkage.drive.joint}


def names_of(figure: Figure) -> SymbolNames:
    """Return the symbols of a figure's linkage."""
    known = symbols(figure)
    lengths = [length for length in known.dimensions if not length.angle]
    bars = {frozenset(m.frame): m for m in reversed(lengths) if (m.begin, m.end) == (0, 1)}
    legs = {point.name: tuple(map(_index, known.legs(figure, point))) for point in known.points}
    return SymbolNames(
        figure.linkage, {ends: _index(m.symbol) for ends, m in bars.items() if len(ends) == 2}, legs
    )


def _index(symbol: str) -> str:
    return symbol.translate(_PLAIN)[1:]


# A worked solution while it is put together: what is known so far, each number in the digits it shows.
#
# Each line is computed from shown digits alone, so that a reader gets every last digit.


class Powers(NamedTuple):
    """The dimension of a number: powers of a length and of a rate, or an angle in degrees."""

    length: int = 0
    rate: int = 0
    angle: bool = False


RATIO, LENGTH, SQUARE = Powers(), Powers(1), Powers(2)
ANGLE = Powers(angle=True)


@frozen
class Scale:
    """How numbers are shown: with `digits` digits of a typical length, and of its rate at a typical speed.

    A rate is `per` s for time; for kinematic coefficients it is per the input's unit, "" for radians.
    """

    digits: int
    unit: str
    length: float
    rate: float
    per: str = "s"

    def decimals(self, measure: Powers) -> int:
        """Return the number of decimals that a number of a measure is shown with."""
        if measure.angle:
            return self.digits - 2
        return decimals(self.length**measure.length * self.rate**measure.rate, self.digits)

    def outcome(self, token: str, value: Formula, measure: Powers) -> Outcome:
        """Return a number as a result, with the size below which it is nothing but rounding."""
        size = 100.0 if measure.angle else self.length**measure.length * self.rate**measure.rate
        return Outcome(token, value, self.unit_of(measure), NOTHING * size)

    def outcomes(self, token: str, vector: Components, order: int) -> Iterator[Outcome]:
        """Yield the components of a place, or of its rate, as results."""
        for axis, value in zip("xy", vector, strict=True):
            yield self.outcome(f"{token}.{axis}", value, Powers(1, order))

    def unit_of(self, measure: Powers) -> str:
        """Return a measure's unit."""
        if measure.angle:
            return "°"
        powers = [(self.unit, measure.length), (self.per, -measure.rate)]
        if self.per == self.unit:
            powers = [(self.unit, measure.length - measure.rate)]
        above = "·".join(_power(unit, n) for unit, n in powers if unit and n > 0)
        below = "·".join(_power(unit, -n) for unit, n in powers if unit and n < 0)
        angular = "rad" if measure.rate and not measure.length and self.per else "1"
        return f"{above or angular}/{below}" if below else above


def _power(unit: str, power: int) -> str:
    return unit if power == 1 else f"{unit}²"


@dataclass
class Work:
    """The positions known so far at a pose, and the lines that led to them.

    `points` are vectors by the joints' names; `slides` travels along guides; `given` what the scene states,
    in the order in which it is needed; `places` the decimals of symbols that have fewer than the scale gives.
    """

    linkage: Linkage
    names: SymbolNames
    pose: Pose
    scale: Scale
    places: Mapping[Symbol, int] = field(default_factory=dict)
    points: dict[str, Components] = field(default_factory=dict)
    angles: dict[tuple[str, str], Formula] = field(default_factory=dict)
    slides: dict[str, Formula] = field(default_factory=dict)
    given: dict[Symbol, Given] = field(default_factory=dict)
    items: list[Item] = field(default_factory=list)
    sentences: set[str] = field(default_factory=set)

    def step(self, title: str, write: Callable[[], object], *, with_given: bool = False) -> Step:
        """Return the step of the lines that `write` adds; `with_given`, behind the numbers given for them."""
        before = set(self.given)
        self.items.clear()
        write()
        given = [item for symbol, item in self.given.items() if symbol not in before] if with_given else ()
        return Step(title, (*given, *self.items))

    def say(self, text: str) -> None:
        """Add a sentence; its numbers have true minus signs."""
        self.items.append(signed(text))

    def say_once(self, text: str) -> None:
        """Add a sentence if it was not added before."""
        if text not in self.sentences:
            self.sentences.add(text)
            self.say(text)

    def let(self, symbol: Symbol, formula: Formula, measure: Powers, scale: Scale | None = None) -> Formula:
        """Add the line of a symbol's value, and return the symbol; a number alone needs no line."""
        scale = scale or self.scale
        return self._line(symbol, formula, scale.decimals(measure), scale.unit_of(measure))

    def let_plain(self, symbol: Symbol, formula: Formula, unit: str) -> Formula:
        """Add the line of a force or a power, in significant digits, and return its value."""
        return self._line(symbol, formula, decimals(formula.value, self.scale.digits), unit)

    def _line(self, symbol: Symbol, formula: Formula, places: int, unit: str) -> Formula:
        if formula.constant is not None:
            return formula
        text = rounded(formula.value, min(places, self.places.get(symbol, places)))
        leaf = Formula("leaf", symbol=symbol, shown=text, in_degrees=unit == "°")
        self.items.append(ValueLine(formula, leaf, unit))
        return leaf

    def stated(self, symbol: Symbol, value: float, measure: Powers, words: str = "") -> Formula:
        """Return what the scene states as a symbol's value; 0 and multiples of 90° as numbers alone."""
        text = self.written(value, measure)
        plain = float(text) == 0 or (measure.angle and float(text) % 90 == 0)
        return number(text, measure.angle) if plain else self.known(symbol, value, measure, words)

    def sided(self, symbol: Symbol, value: float, one: str, other: str) -> Formula:
        """Return a length that has a sign: its size as stated, as in a figure; its words say to which side.

        The side is `one`, or the `other` where the length is negative.
        """
        size = self.stated(symbol, abs(value), LENGTH, other if value < 0 else one)
        return -size if value < 0 else size

    def known(self, symbol: Symbol, value: float, measure: Powers, words: str = "") -> Formula:
        """Return a number that is given as a symbol's value, also where it is 0."""
        return self.quoted(symbol, self.written(value, measure), self.scale.unit_of(measure), words)

    def quoted(self, symbol: Symbol, text: str, unit: str, words: str = "") -> Formula:
        """Return a symbol with a value given in these digits, an exponent written out."""
        leaf = Formula("leaf", symbol=symbol, shown=f"{Decimal(text):f}", in_degrees=unit == "°")
        self.given.setdefault(symbol, Given(leaf, unit, words))
        return leaf

    def solved(self, symbol: Symbol, value: float, measure: Powers, scale: Scale | None = None) -> Formula:
        """Add the line of a value that no formula gives, and return the symbol."""
        scale = scale or self.scale
        places, unit = scale.decimals(measure), scale.unit_of(measure)
        text = rounded(value, min(places, self.places.get(symbol, places)))
        leaf = Formula("leaf", symbol=symbol, shown=text, in_degrees=unit == "°")
        self.items.append(Given(leaf, unit, said("solved")))
        return leaf

    def written(self, value: float, measure: Powers) -> str:
        """Return a number as it was stated; where that is too long, with one decimal more than a result."""
        value = (math.degrees(value) if measure.angle else value) + 0.0
        text, places = f"{value:.12g}", self.scale.decimals(measure) + 1
        short = "e" not in text and len(text.partition(".")[2]) <= places
        return text if short else rounded(value, places)

    def length(self, start: str, end: str, value: float) -> Formula:
        """Return the length between two joints, as stated."""
        return self.stated(Symbol("r", self.names.length(start, end)), value, LENGTH)

    def angle_of(self, start: str, end: str) -> Formula:
        """Return the angle of the line from one joint to another, worked out where it is not known yet."""
        formula = self.angles.get((start, end))
        if formula is None:
            span, symbol = self.points[end] - self.points[start], self.angle_symbol(start, end)
            angle = atan2(span.y, span.x)
            formula = self._same_angle(symbol, angle.value) or self.let(symbol, angle, ANGLE)
            self.angles[start, end] = formula
        return formula

    def _same_angle(self, symbol: Symbol, value: float) -> Formula | None:
        """Return the angle that is known by this symbol: that of another two points of the same line."""
        known = (one for one in self.angles.values() if one.symbol == symbol)
        least = 10.0 ** (1 - self.scale.decimals(ANGLE))
        return next((one for one in known if abs(math.remainder(one.value - value, 360)) < least), None)

    def angle_symbol(self, start: str, end: str) -> Symbol:
        """Return the symbol of the angle of the line from one joint to another."""
        return Symbol("θ", self.names.angle(start, end))

    def let_point(self, joint: str, place: Components) -> None:
        """Add the lines that say where a joint lies."""
        x = self.let(Symbol("x", joint), place.x, LENGTH)
        self.points[joint] = Components(x, self.let(Symbol("y", joint), place.y, LENGTH))

    def centre(self, body: Body) -> str:
        """Return the name of a body's centre of mass: G3, or GG3 where a joint is called G3."""
        name = f"G{link_labels(self.linkage)[body.name]}"
        while name in self.linkage.by_name:
            name = f"G{name}"
        return name

    @property
    def metre(self) -> Formula:
        """One unit of length in metres."""
        return number(f"{self.linkage.metre:.12g}")

    def frame(self, ends: tuple[str, str]) -> int:
        """Return the number of the rigid body that has both joints; 0 is the ground."""
        number = holding(self.linkage.rigid_bodies, ends)
        assert number is not None
        return number

    @property
    def driver(self) -> Coordinate:
        """The input: the angle of the crank's rigid body, or the slider's travel.

        Of a motor between two links that move it is the angle `BETWEEN` them.
        """
        joint = self.linkage.driven.joint
        if joint.motor:
            return "θ", BETWEEN
        return ("θ", self.frame((joint.pivot, joint.name))) if isinstance(joint, Crank) else ("s", joint.name)

    def guide(self, line: Travel, joint: str) -> GuideLine:
        """Return a joint's line of travel; its angle is worked out where a body carries it."""
        if line.on is None:
            angle = self.stated(Symbol("φ", joint), line.angle, ANGLE, said("direction of its guide"))
        else:
            angle = self.angle_of(*line.on)
            if line.angle:
                words = said("its guide from the line of its body")
                own = self.stated(Symbol("β", joint), line.angle, ANGLE, words)
                angle = self.let(Symbol("φ", joint), angle + own, ANGLE)
        sides = said("its guide's offset to the left"), said("its guide's offset to the right")
        offset = self.sided(Symbol("e", joint), line.offset, *sides)
        frame = self.frame(line.on) if line.on else 0
        return GuideLine(line.through, offset, frame, angle)

    def bar(self, start: str, end: str, value: float) -> Components:
        """Return a bar as a vector, by its length and its angle."""
        return along(self.angle_of(start, end)).times(self.length(start, end, value))

    def place(self, joint: str) -> complex:
        """Return where a joint lies, as x + yi."""
        return self.points[joint].value


LoopSide = tuple[Symbol, Components]
"""A vector of a loop: its symbol, and its components as formulas."""


class GuideLine(NamedTuple):
    """A line of travel: a joint it runs through, its offset, the body it is on, and its angle."""

    through: str
    offset: Formula
    frame: int
    angle: Formula

    @property
    def direction(self) -> Components:
        """The unit vector along it."""
        return along(self.angle)

    def point(self, work: Work, slide: Formula) -> Components:
        """Return the point at the distance `slide` along it."""
        u = self.direction
        return work.points[self.through] + u.times(slide) + u.left().times(self.offset)

    def let_beside(self, work: Work, point: str, joint: str) -> tuple[Formula, Formula]:
        """Add how far a point lies along a joint's guide, and how far to its left; return both."""
        arm, u = work.points[point] - work.points[self.through], self.direction
        forward = work.let(Symbol("p", joint), arm.x * u.x + arm.y * u.y, LENGTH)
        return forward, work.let(Symbol("n", joint), arm.y * u.x - arm.x * u.y - self.offset, LENGTH)

    def sides(self, work: Work, joint: str) -> tuple[LoopSide, ...]:
        """Return the vectors of a joint's travel: along the guide, and across it where that is offset."""
        index = work.names.slide(joint).sub
        sides = [(Symbol("S", index, bold=True), self.direction.times(work.slides[joint]))]
        if self.offset.constant != 0:
            sides.append((Symbol("E", joint, bold=True), self.direction.left().times(self.offset)))
        return tuple(sides)


def decimals(value: float, digits: int) -> int:
    """Return how many decimals a number needs to have at least `digits` significant digits."""
    return max(digits - 1 - math.floor(math.log10(abs(value))), 0) if value else 0


def rounded(value: float, places: int) -> str:
    """Return a number with `places` decimals, as far as a float has them; a zero has no sign."""
    text = f"{value:.{min(places, decimals(value, _FLOAT_DIGITS)) if value else places}f}"
    return text if float(text) else text.lstrip("-")


_FLOAT_DIGITS = 13
HALF = 0.5001
"""How far off a value may be that still rounds to a digit, in units of its place."""


# Velocities and accelerations, or kinematic coefficients: those known so far, and their lines.
#
# Both are worked out alike: in time with rates ω, α, or by the input with h, h′, which are the same rates for
# an input that moves at the rate 1. Each dyad's two unknowns follow from its loop, differentiated: two linear
# equations.

Order = Literal[1, 2]
ORDERS: tuple[Order, Order] = (1, 2)
Row = tuple[Formula, Formula, Formula]


Coordinate = tuple[Literal["θ", "s", "t"], int | str]
"""A variable with a rate: a rigid body's angle by its number, or a joint's travel along its guide or slot."""
FIXED: Coordinate = ("θ", 0)
"""The ground's angle."""
_IN_TIME = {
    "θ": (Symbol("ω"), Symbol("α")),
    **{letter: (Symbol(letter, mark="˙"), Symbol(letter, mark="¨")) for letter in "stxy"},
}
_BY_INPUT = {
    **{of: (Symbol(letter), Symbol(letter, mark="′")) for of, letter in zip("θst", "hfg", strict=True)},
    **{letter: (Symbol(letter, mark="′"), Symbol(letter, mark="″")) for letter in "xy"},
}
"""The symbols of the rates of the first and the second order, by the letters of variables."""


_SHORT = 3
"""The most symbols of a right side that stands in the equations themselves."""


@dataclass
class Rates:
    """The rates known so far, of the first order and then of the second, and each strut's force and rate."""

    work: Work
    scale: Scale
    slopes: Rates | None = None
    """Of rates in time the coefficients, from which they follow by the chain rule; None of coefficients."""
    known: dict[Coordinate, list[Formula]] = field(default_factory=lambda: {FIXED: [ZERO, ZERO]})
    moving: dict[str, list[Components]] = field(default_factory=dict)
    struts: dict[Spring | Damper, tuple[Formula, Formula]] = field(default_factory=dict)
    residual: float = 0.0
    """The most by which rates from coefficients miss the differentiated loops."""

    def let(self, symbol: Symbol, formula: Formula, measure: Powers) -> Formula:
        """Add the line of a symbol's value, and return the symbol."""
        return self.work.let(symbol, formula, measure, self.scale)

    def start(self, rate: Formula, second: Formula = ZERO) -> None:
        """Set the input's rates: those of its body, or of its slider."""
        self.known[self.work.driver] = [rate, second]

    def let_rate(self, coordinate: Coordinate, formula: Formula, order: Order) -> Formula:
        """Add the line that says how a rigid body turns, or how fast something slides."""
        measure = Powers(int(coordinate[0] != "θ"), order)
        rate = self.let(self.symbol(coordinate, order), formula, measure)
        self.known.setdefault(coordinate, []).append(rate)
        return rate

    def let_solved(self, frame: int, order: Order) -> None:
        """Add the line that says how a rigid body of a group turns: as solved, or by the chain rule."""
        turns: Coordinate = ("θ", frame)
        if self.slopes is not None:
            self.let_rate(turns, self._chain(self.slopes.known[turns], order), order)
            return
        first, second, *_ = self.work.linkage.rigid_bodies[frame]
        pose = self.work.pose.per_input
        kinds = (pose.position, (pose.velocity, pose.acceleration)[order - 1])
        arm, rate = (complex(*kind[second]) - complex(*kind[first]) for kind in kinds)
        turning = (arm.conjugate() * rate).imag / abs(arm) ** 2
        value = self.work.solved(self.symbol(turns, order), turning, Powers(0, order), self.scale)
        self.known.setdefault(turns, []).append(value)

    def let_moving(self, joint: str, formula: Components, order: Order) -> None:
        """Add the lines that say how a joint moves."""
        slopes = self.slopes.moving.get(joint, []) if self.slopes else []
        if slopes:
            formula = Components(
                self._chain([one.x for one in slopes], order), self._chain([one.y for one in slopes], order)
            )
        places = zip(self.moving_symbols(joint, order), formula, strict=True)
        moving = Components(*(self.let(symbol, one, Powers(1, order)) for symbol, one in places))
        self.moving.setdefault(joint, []).append(moving)

    def let_carried(self, joint: str, on: tuple[str, str], arm: Components, order: Order) -> None:
        """Add the lines of how a point of a rigid body moves, `arm` from the first of two joints `on` it."""
        self.let_moving(joint, self.of(on[0], order) + self.carried(self.work.frame(on), arm, order), order)

    def symbol(self, coordinate: Coordinate, order: Order) -> Symbol:
        """Return the symbol of how a rigid body turns, or of how fast something slides."""
        letter, of = coordinate
        names = self.work.names
        return self._letter(letter, names.turning(of) if isinstance(of, int) else names.slide(of).sub, order)

    def moving_symbols(self, joint: str, order: Order) -> tuple[Symbol, Symbol]:
        """Return the symbols of how a joint moves: of x and of y."""
        return self._letter("x", joint, order), self._letter("y", joint, order)

    def _letter(self, letter: str, index: str, order: Order) -> Symbol:
        return (_BY_INPUT if self.slopes is None else _IN_TIME)[letter][order - 1]._replace(sub=index)

    def of(self, joint: str, order: Order) -> Components:
        """Return how a joint moves."""
        return self.moving[joint][order - 1]

    def rate(self, coordinate: Coordinate, order: Order) -> Formula:
        """Return how a rigid body turns, or how fast something slides."""
        return self.known[coordinate][order - 1]

    def turning(self, frame: int, order: Order) -> Formula:
        """Return how a rigid body turns."""
        return self.rate(("θ", frame), order)

    def carried(self, frame: int, arm: Components, order: Order) -> Components:
        """Return the relative velocity, or acceleration, of a rigid body's point at `arm` from another."""
        turn = arm.left().times(self.turning(frame, order))
        return turn if order == 1 else turn - self.centripetal(frame, arm)

    def centripetal(self, frame: int, arm: Components) -> Components:
        """Return ω² times an arm."""
        return arm.times(square(self.turning(frame, 1)))

    def guided(
        self, guide: GuideLine, joint: str, order: Order, sliding: Mapping[Coordinate, Components]
    ) -> Components:
        """Return how that point of a guide's carrier moves which lies under a joint.

        The second order includes the Coriolis acceleration of what is `sliding` there, by its directions.
        """
        arm = self.work.points[joint] - self.work.points[guide.through]
        base = self.of(guide.through, order) + self.carried(guide.frame, arm, order)
        if order == 1:
            return base
        slid = sum((way.times(self.rate(one, 1)) for one, way in sliding.items()), NOWHERE)
        return base + slid.left().times(TWO * self.turning(guide.frame, 1))

    def solve(
        self, index: str, unknowns: Mapping[Coordinate, Components], right: Components, order: Order
    ) -> None:
        """Add the two equations and their solution; ZeroDivisionError where they have none.

        `unknowns` are the two variables, each with the column of its rate. In time each rate follows from its
        coefficient, and the equations are the check.
        """
        if self.slopes is not None:
            chained = [self._chain(self.slopes.known[one], order) for one in unknowns]
            rates = [self.let_rate(*one, order) for one in zip(unknowns, chained, strict=True)]
            sides = (column.times(rate) for column, rate in zip(unknowns.values(), rates, strict=True))
            miss = sum(sides, NOWHERE) - right
            self.residual = max(self.residual, abs(miss.x.value), abs(miss.y.value))
            return
        one, other = unknowns.values()
        left, beside = (LENGTH if letter == "θ" else RATIO for letter, _ in unknowns)
        first, second = (self.symbol(unknown, order) for unknown in unknowns)
        measures = left, beside, Powers(1, order)
        right = self._right(right, measures[2])
        formulas = (one.x, other.x, right.x), (one.y, other.y, right.y)
        values = self._row(formulas[0], measures, 1), self._row(formulas[1], measures, 2)
        (a, b, c), (d, e, f) = values
        self.work.items.append(System((first, second), values, formulas))
        det = self.let(Symbol("D", index), a * e - b * d, Powers(left.length + beside.length))
        for unknown, formula in zip(unknowns, (c * e - b * f, a * f - d * c), strict=True):
            self.let_rate(unknown, formula / det, order)

    def _chain(self, slopes: Sequence[Formula], order: Order) -> Formula:
        """Return the rate with coefficients h, h′: h·θ̇ of the first order, h′·θ̇² + h·θ̈ of the second."""
        rate, second = self.known[self.work.driver]
        return slopes[0] * rate if order == 1 else slopes[1] * square(rate) + slopes[0] * second

    def _right(self, right: Components, measure: Powers) -> Components:
        """Return the right sides; long ones get lines of their own before the equations."""
        if max(len(list(side.leaves)) for side in right) <= _SHORT:
            return right
        return Components(*(self.let(Symbol("b", str(n)), side, measure) for n, side in enumerate(right, 1)))

    def _row(self, formulas: Row, measures: tuple[Powers, Powers, Powers], row: int) -> Row:
        """Return the entries of a row, a₁₁ a₁₂ b₁, in the digits that they show."""
        names = Symbol("a", f"{row}1"), Symbol("a", f"{row}2"), Symbol("b", str(row))
        first, second, right = map(self._entry, formulas, measures, names)
        return first, second, right

    def _entry(self, formula: Formula, measure: Powers, symbol: Symbol) -> Formula:
        if formula.constant is not None or (formula.symbol and formula.symbol.letter == "b"):
            return formula
        return Formula("leaf", symbol=symbol, shown=rounded(formula.value, self.scale.decimals(measure)))
