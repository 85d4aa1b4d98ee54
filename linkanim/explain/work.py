"""A worked solution while it is put together: what is known so far, each number in the digits it shows.

What follows is computed from shown digits alone, so each line gives the next one to its last digit.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from typing import NamedTuple

from linkanim.explain.expression import Components, Formula, Symbol, along, atan2, number
from linkanim.explain.lines import NOTHING, Given, Item, Outcome, ValueLine, Words
from linkanim.explain.names import SymbolNames
from linkanim.mechanics.linkage.joint import Line as Travel
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Crank
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.mechanics.motion.motion import Pose


class Powers(NamedTuple):
    """What a number measures: powers of a length and of a rate, or an angle in degrees."""

    length: int = 0
    rate: int = 0
    angle: bool = False


RATIO, LENGTH = Powers(), Powers(1)
ANGLE = Powers(angle=True)


@dataclass(frozen=True)
class Scale:
    """How numbers are shown: to so many digits of a typical length, and of what it is at a typical rate.

    A rate is `per` something: s for time; the input's own unit for kinematic coefficients, "" for radians.
    """

    digits: int
    unit: str
    length: float
    rate: float
    per: str = "s"

    def decimals(self, measure: Powers) -> int:
        """Return how many decimals a number of a measure has."""
        if measure.angle:
            return self.digits - 2
        return decimals(self.length**measure.length * self.rate**measure.rate, self.digits)

    def outcome(self, token: str, value: Formula, measure: Powers) -> Outcome:
        """Return a number as a result: what is less than a share of its usual size is nothing."""
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
    """The positions known so far at a pose, and the lines that led to them; vectors by their joints' names.

    `slides` are ways along guides; `given` what the scene states, in the order in which it is needed;
    `places` the decimals of symbols that have fewer than the scale gives them.
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

    def say(self, text: str) -> None:
        """Add a sentence."""
        self.items.append(Words(text))

    def let(self, symbol: Symbol, formula: Formula, measure: Powers, scale: Scale | None = None) -> Formula:
        """Add the line that gives a symbol its value, and return it; a number alone needs no line."""
        scale = scale or self.scale
        return self._line(symbol, formula, scale.decimals(measure), scale.unit_of(measure))

    def let_plain(self, symbol: Symbol, formula: Formula, unit: str) -> Formula:
        """Add the line of what is neither a length nor a rate: a force, a power, in significant digits."""
        return self._line(symbol, formula, decimals(formula.value, self.scale.digits), unit)

    def _line(self, symbol: Symbol, formula: Formula, places: int, unit: str) -> Formula:
        if formula.constant is not None:
            return formula
        text = rounded(formula.value, min(places, self.places.get(symbol, places)))
        found = Formula("leaf", symbol=symbol, shown=text, in_degrees=unit == "°")
        self.items.append(ValueLine(formula, found, unit))
        return found

    def stated(self, symbol: Symbol, value: float, measure: Powers, words: str = "") -> Formula:
        """Return what the scene states as a symbol's value; 0 as the number alone."""
        text = self.written(value, measure)
        plain = float(text) == 0 or (measure.angle and float(text) % 90 == 0)
        return number(text, measure.angle) if plain else self.known(symbol, value, measure, words)

    def known(self, symbol: Symbol, value: float, measure: Powers, words: str = "") -> Formula:
        """Return a number that is given as a symbol's value, whatever it is."""
        return self.quoted(symbol, self.written(value, measure), self.scale.unit_of(measure), words)

    def quoted(self, symbol: Symbol, text: str, unit: str, words: str = "") -> Formula:
        """Return a number that is given as a symbol's value in these digits, an exponent written out."""
        found = Formula("leaf", symbol=symbol, shown=f"{Decimal(text):f}", in_degrees=unit == "°")
        self.given.setdefault(symbol, Given(found, unit, words))
        return found

    def written(self, value: float, measure: Powers) -> str:
        """Return a number as it was stated, or where that is long in the digits of what is worked out."""
        value = (math.degrees(value) if measure.angle else value) + 0.0
        text, places = f"{value:.12g}", self.scale.decimals(measure) + 1
        short = "e" not in text and len(text.partition(".")[2]) <= places
        return text if short else rounded(value, places)

    def length(self, start: str, end: str, value: float) -> Formula:
        """Return the length between two joints, as stated."""
        return self.stated(Symbol("r", self.names.length(start, end)), value, LENGTH)

    def angle_of(self, start: str, end: str) -> Formula:
        """Return the angle of the way from one joint to another, worked out where it is not known yet."""
        found = self.angles.get((start, end))
        if found is None:
            way = self.points[end] - self.points[start]
            found = self.let(self.angle_symbol(start, end), atan2(way.y, way.x), ANGLE)
            self.angles[start, end] = found
        return found

    def angle_symbol(self, start: str, end: str) -> Symbol:
        """Return the symbol of the angle of the way from one joint to another."""
        return Symbol("θ", self.names.angle(start, end))

    def let_point(self, joint: str, place: Components) -> None:
        """Add the lines that say where a joint lies."""
        x = self.let(Symbol("x", joint), place.x, LENGTH)
        self.points[joint] = Components(x, self.let(Symbol("y", joint), place.y, LENGTH))

    def frame(self, ends: tuple[str, str]) -> int:
        """Return which rigid body has two joints; 0 is the ground."""
        found = holding(self.linkage.rigid_bodies, ends)
        assert found is not None
        return found

    @property
    def driver(self) -> int | str:
        """What drives: the crank by its rigid body, or the slider by its joint."""
        joint = self.linkage.joint(self.linkage.drive.joint)
        return self.frame((joint.pivot, joint.name)) if isinstance(joint, Crank) else joint.name

    def guide(self, line: Travel, joint: str) -> GuideLine:
        """Return a joint's line of travel; its angle is worked out where a body carries it."""
        if line.on is None:
            angle = self.stated(Symbol("φ", joint), line.angle, ANGLE, "direction of its guide")
        else:
            angle = self.angle_of(*line.on)
            if line.angle:
                words = "its guide from the line of its body"
                own = self.stated(Symbol("β", joint), line.angle, ANGLE, words)
                angle = self.let(Symbol("φ", joint), angle + own, ANGLE)
        offset = self.stated(Symbol("e", joint), line.offset, LENGTH, "its guide's offset to the left")
        frame = self.frame(line.on) if line.on else 0
        return GuideLine(line.through, along(angle), offset, frame, angle)

    def bar(self, start: str, end: str, value: float) -> Components:
        """Return a bar as a vector, by its length and its angle."""
        return along(self.angle_of(start, end)).times(self.length(start, end, value))

    def place(self, joint: str) -> complex:
        """Return where a joint lies, as x + yi."""
        return complex(self.points[joint].x.value, self.points[joint].y.value)


class GuideLine(NamedTuple):
    """A line of travel: a joint it runs through, its direction and angle, its offset, and what carries it."""

    through: str
    direction: Components
    offset: Formula
    frame: int
    angle: Formula


def decimals(value: float, digits: int) -> int:
    """Return with how many decimals a number has so many significant digits at the least."""
    return max(digits - 1 - math.floor(math.log10(abs(value))), 0) if value else 0


def rounded(value: float, places: int) -> str:
    """Return a number in so many decimals, as far as a float has them, without the sign of a zero."""
    text = f"{value:.{min(places, decimals(value, _FLOAT_DIGITS)) if value else places}f}"
    return text if float(text) else text.lstrip("-")


_FLOAT_DIGITS = 13
