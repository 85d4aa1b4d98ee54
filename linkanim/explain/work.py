"""A worked solution while it is put together: what is known so far, each number in the digits it shows.

What follows is computed from shown digits alone, so each line gives the next one to its last digit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from decimal import Decimal
from typing import NamedTuple

from linkanim.explain.expression import Components, Formula, Symbol, along, atan2, number
from linkanim.explain.lines import Given, Item, ValueLine, Words
from linkanim.explain.names import SymbolNames
from linkanim.mechanics.linkage.joint import Line as Travel
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.mechanics.motion.motion import Pose


class Powers(NamedTuple):
    """What a number measures: powers of a length and of a rate, or an angle in degrees."""

    length: int = 0
    rate: int = 0
    angle: bool = False


RATIO, LENGTH, AREA = Powers(), Powers(1), Powers(2)
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
        size = self.length**measure.length * self.rate**measure.rate
        return max(self.digits - 1 - math.floor(math.log10(size)), 0)

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

    `slides` are ways along guides; `given` what the scene states, in the order in which it is needed.
    """

    linkage: Linkage
    names: SymbolNames
    pose: Pose
    scale: Scale
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
        if formula.constant is not None:
            return formula
        scale = scale or self.scale
        text = rounded(formula.value, scale.decimals(measure))
        found = Formula("leaf", symbol=symbol, shown=text, in_degrees=measure.angle)
        self.items.append(ValueLine(formula, found, scale.unit_of(measure)))
        return found

    def let_plain(self, symbol: Symbol, formula: Formula, unit: str) -> Formula:
        """Add the line of what is neither a length nor a rate: a force, a power, in significant digits."""
        if formula.constant is not None:
            return formula
        size = abs(formula.value)
        decimals = max(self.scale.digits - 1 - math.floor(math.log10(size)), 0) if size > 0 else 0
        found = Formula("leaf", symbol=symbol, shown=rounded(formula.value, decimals))
        self.items.append(ValueLine(formula, found, unit))
        return found

    def stated(self, symbol: Symbol, value: float, measure: Powers, words: str = "") -> Formula:
        """Return what the scene states as a symbol's value; 0 as the number alone."""
        text = self.written(math.degrees(value) if measure.angle else value, measure)
        if float(text) == 0 or (measure.angle and float(text) % 90 == 0):
            return number(text)
        return self.quoted(symbol, text, self.scale.unit_of(measure), words)

    def known(self, symbol: Symbol, value: float, measure: Powers, words: str = "") -> Formula:
        """Return a number that is given as a symbol's value, whatever it is."""
        text = self.written(math.degrees(value) if measure.angle else value, measure)
        return self.quoted(symbol, text, self.scale.unit_of(measure), words)

    def quoted(self, symbol: Symbol, text: str, unit: str, words: str = "") -> Formula:
        """Return a number that is given as a symbol's value in these digits, an exponent written out."""
        found = Formula("leaf", symbol=symbol, shown=f"{Decimal(text):f}", in_degrees=unit == "°")
        self.given.setdefault(symbol, Given(found, unit, words))
        return found

    def written(self, value: float, measure: Powers) -> str:
        """Return a number as it was stated, or where that is long in the digits of what is worked out."""
        text = f"{value + 0.0:.12g}"
        decimals = self.scale.decimals(measure) + 1
        return (
            text if "e" not in text and len(text.partition(".")[2]) <= decimals else rounded(value, decimals)
        )

    def length(self, start: str, end: str, value: float) -> Formula:
        """Return the length between two joints, as stated."""
        return self.stated(Symbol("r", self.names.length(start, end)), value, LENGTH)

    def angle_of(self, start: str, end: str) -> Formula:
        """Return the angle of the way from one joint to another, worked out where it is not known yet."""
        found = self.angles.get((start, end))
        if found is None:
            way = self.points[end] - self.points[start]
            found = self.angles[start, end] = self.let(
                self.angle_symbol(start, end), atan2(way.y, way.x), ANGLE
            )
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

    def guide(self, line: Travel, joint: str) -> GuideLine:
        """Return a joint's line of travel; its angle is worked out where a body carries it."""
        if line.on is None:
            angle = self.stated(Symbol("φ", joint), line.angle, ANGLE, "direction of its guide")
        else:
            angle = self.angle_of(*line.on)
            if line.angle:
                own = self.stated(
                    Symbol("β", joint), line.angle, ANGLE, "its guide from the line of its body"
                )
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


def rounded(value: float, decimals: int) -> str:
    """Return a number in so many decimals, as far as a float has them, without the sign of a zero."""
    if value:
        decimals = max(min(decimals, _FLOAT_DIGITS - 1 - math.floor(math.log10(abs(value)))), 0)
    text = f"{value:.{decimals}f}"
    return text if float(text) else text.lstrip("-")


_FLOAT_DIGITS = 13
