"""Formulas of a worked solution as trees, whose leaves hold the digits that are printed.

A leaf is a symbol with its number in shown digits, or a number alone: whoever puts the digits in gets what
the tree evaluates to. Angles are in degrees. What is exactly 0 or 1 drops out as a formula is put together.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple


class Symbol(NamedTuple):
    """A letter with its index `sub`; `mark` is a dot or two over it, or a prime or two behind it."""

    letter: str
    sub: str = ""
    mark: Literal["", "˙", "¨", "′", "″"] = ""
    bold: bool = False


Operation = Literal["leaf", "+", "-", "·", "/", "neg", "sqrt", "square", "cos", "sin", "atan2", "arccos"]


@dataclass(frozen=True, slots=True)
class Formula:
    """A formula: an operation on others, or a leaf with its `shown` digits, and a symbol if it has one.

    A leaf `in_degrees` is printed with the sign of a degree.
    """

    operation: Operation
    parts: tuple[Formula, ...] = ()
    symbol: Symbol | None = None
    shown: str = ""
    in_degrees: bool = False

    @property
    def constant(self) -> float | None:
        """The value of a number without a symbol; None of all else."""
        return float(self.shown) if self.operation == "leaf" and self.symbol is None else None

    @property
    def value(self) -> float:
        """What the shown digits evaluate to; ValueError or ZeroDivisionError where that is nothing."""
        if self.operation == "leaf":
            return float(self.shown)
        return _VALUES[self.operation](*(part.value for part in self.parts))

    @property
    def symbolic(self) -> bool:
        """Whether any symbol stands in it."""
        return self.symbol is not None or any(part.symbolic for part in self.parts)

    @property
    def leaves(self) -> Iterator[Formula]:
        """The leaves with a symbol, from left to right."""
        if self.symbol is not None:
            yield self
        for part in self.parts:
            yield from part.leaves

    def __add__(self, other: Formula) -> Formula:
        if self.constant == 0:
            return other
        if other.constant == 0:
            return self
        match other.operation:
            case "neg":
                return self - other.parts[0]
            case "+":
                return (self + other.parts[0]) + other.parts[1]
            case "-":
                return (self + other.parts[0]) - other.parts[1]
        return Formula("+", (self, other))

    def __sub__(self, other: Formula) -> Formula:
        if other.constant == 0:
            return self
        if self.constant == 0:
            return -other
        if other.operation == "neg":
            return self + other.parts[0]
        return Formula("-", (self, other))

    def __mul__(self, other: Formula) -> Formula:
        for one, rest in ((self, other), (other, self)):
            if one.constant == 0:
                return ZERO
            if one.constant in (1.0, -1.0):
                return rest if one.constant == 1 else -rest
            if one.operation == "neg":
                return -(one.parts[0] * rest) if one is self else -(rest * one.parts[0])
        return Formula("·", (self, other))

    def __truediv__(self, other: Formula) -> Formula:
        if self.constant == 0:
            return ZERO
        if other.constant == 1:
            return self
        return Formula("/", (self, other))

    def __neg__(self) -> Formula:
        if self.constant == 0:
            return self
        if self.constant is not None:
            return number(f"-{self.shown}".removeprefix("--"), self.in_degrees)
        return self.parts[0] if self.operation == "neg" else Formula("neg", (self,))


_VALUES: Mapping[str, Callable[..., float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "·": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "neg": lambda a: -a,
    "sqrt": math.sqrt,
    "square": lambda a: a * a,
    "cos": lambda a: math.cos(math.radians(a)),
    "sin": lambda a: math.sin(math.radians(a)),
    "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
    "arccos": lambda a: math.degrees(math.acos(a)),
}


def number(shown: str, in_degrees: bool = False) -> Formula:
    """Return a number without a symbol, in the digits given."""
    return Formula("leaf", shown=shown, in_degrees=in_degrees)


ZERO, ONE, TWO = number("0"), number("1"), number("2")


def sqrt(e: Formula) -> Formula:
    """Return the root; of a square what is squared is taken as it is, which is not negative."""
    return Formula("sqrt", (e,))


def square(e: Formula) -> Formula:
    """Return the square; 0 and 1 of 0 and ±1."""
    return number(str(int(e.constant) ** 2)) if e.constant in (0.0, 1.0, -1.0) else Formula("square", (e,))


def cos(e: Formula) -> Formula:
    """Return the cosine of degrees; 0, 1 or -1 of a number of right angles."""
    return _turned("cos", e, ("1", "0", "-1", "0"))


def sin(e: Formula) -> Formula:
    """Return the sine of degrees; 0, 1 or -1 of a number of right angles."""
    return _turned("sin", e, ("0", "1", "0", "-1"))


def _turned(operation: Literal["cos", "sin"], e: Formula, quarters: tuple[str, ...]) -> Formula:
    if e.constant is not None and e.constant % 90 == 0:
        return number(quarters[int(e.constant // 90) % 4])
    return Formula(operation, (e,))


def atan2(y: Formula, x: Formula) -> Formula:
    """Return the angle of a way by its components, in degrees from -180 to 180."""
    return Formula("atan2", (y, x))


def arccos(e: Formula) -> Formula:
    """Return the angle from 0 to 180 degrees that has this cosine."""
    return Formula("arccos", (e,))


class Components(NamedTuple):
    """A vector by its components."""

    x: Formula
    y: Formula

    def __add__(self, other: Components) -> Components:  # type: ignore[override]
        return Components(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Components) -> Components:
        return Components(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Components:
        return Components(-self.x, -self.y)

    def times(self, factor: Formula) -> Components:
        """Return the vector times a number, which is written first."""
        return Components(factor * self.x, factor * self.y)

    def left(self) -> Components:
        """Return the vector turned left by a right angle."""
        return Components(-self.y, self.x)


def dot(one: Components, other: Components) -> Formula:
    """Return the scalar product."""
    return one.x * other.x + one.y * other.y


NOWHERE = Components(ZERO, ZERO)


def along(angle: Formula) -> Components:
    """Return the direction at an angle."""
    return Components(cos(angle), sin(angle))
