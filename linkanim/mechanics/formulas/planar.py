"""Plane vectors and moving quantities made of `Value`s: floats, or symbolic expressions.

A moving quantity is its value with the first and second derivative in time.
"""

from __future__ import annotations

from typing import NamedTuple

from linkanim.mechanics.formulas.expression import Value


class Vec(NamedTuple):
    """A plane vector, read as a complex number where one multiplies another."""

    x: Value
    y: Value

    def __add__(self, other: Vec) -> Vec:  # type: ignore[override]
        return Vec(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Vec) -> Vec:
        return Vec(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Vec:
        return Vec(-self.x, -self.y)

    def scaled(self, factor: Value) -> Vec:
        """Return the vector times a number."""
        return Vec(self.x * factor, self.y * factor)

    def times(self, other: Vec) -> Vec:
        """Return the complex product: a turn and a stretch."""
        return Vec(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def left(self) -> Vec:
        """Return the vector turned a quarter turn to the left."""
        return Vec(-self.y, self.x)

    def dot(self, other: Vec) -> Value:
        """Return the scalar product."""
        return self.x * other.x + self.y * other.y

    def cross(self, other: Vec) -> Value:
        """Return the signed area spanned, positive where `other` lies to the left."""
        return self.x * other.y - self.y * other.x


ZERO = Vec(0.0, 0.0)


class Moving(NamedTuple):
    """A number and its first two derivatives in time."""

    value: Value
    rate: Value = 0.0
    second: Value = 0.0

    def __mul__(self, other: Moving) -> Moving:  # type: ignore[override]
        return Moving(
            self.value * other.value,
            self.rate * other.value + self.value * other.rate,
            self.second * other.value + self.rate * other.rate * 2.0 + self.value * other.second,
        )

    def __add__(self, other: Moving) -> Moving:  # type: ignore[override]
        return Moving(self.value + other.value, self.rate + other.rate, self.second + other.second)

    def scaled(self, factor: Value) -> Moving:
        """Return the quantity times a constant."""
        return Moving(self.value * factor, self.rate * factor, self.second * factor)

    @property
    def slope(self) -> Slope:
        """The number with its first derivative alone."""
        return Slope(self.value, self.rate)


class MovingPoint(NamedTuple):
    """A point with its velocity and acceleration."""

    position: Vec
    velocity: Vec = ZERO
    acceleration: Vec = ZERO

    def __add__(self, other: MovingPoint) -> MovingPoint:  # type: ignore[override]
        return MovingPoint(*[a + b for a, b in zip(self, other, strict=True)])

    def __sub__(self, other: MovingPoint) -> MovingPoint:
        return MovingPoint(*[a - b for a, b in zip(self, other, strict=True)])


class Slope(NamedTuple):
    """A number and its first derivative in time: a regular factor, or how fast a body turns."""

    value: Value
    rate: Value = 0.0

    def __mul__(self, other: Slope) -> Slope:  # type: ignore[override]
        return Slope(self.value * other.value, self.rate * other.value + self.value * other.rate)

    def __truediv__(self, other: Slope) -> Slope:
        quotient = self.value / other.value
        return Slope(quotient, (self.rate - quotient * other.rate) / other.value)

    def scaled(self, factor: float) -> Slope:
        """Return the quantity times a constant."""
        return Slope(self.value * factor, self.rate * factor)

    def plus(self, value: Value, rate: Value) -> Slope:
        """Return the sum with another number and its derivative."""
        return Slope(self.value + value, self.rate + rate)


def carried(arm: Vec, turning: Slope) -> MovingPoint:
    """Return the end of an arm that turns (ω, α) about its fixed root: r, iω r, (iα - ω²) r."""
    square = turning.value * turning.value
    return MovingPoint(
        arm,
        arm.left().scaled(turning.value),
        arm.left().scaled(turning.rate) - arm.scaled(square),
    )
