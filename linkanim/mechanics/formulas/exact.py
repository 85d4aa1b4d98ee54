"""Small exact pieces: sums of two floats, unit vectors of angles, differences without rounding."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from linkanim.mechanics.formulas.circular import direction
from linkanim.mechanics.formulas.constant import Constant
from linkanim.units import PI_REST, Angle

QUARTER_TURN_HIGH = math.pi / 2
QUARTER_TURN_LOW = PI_REST / 2
"""π/2 is the sum of the two, to 32 digits."""


@dataclass(frozen=True, slots=True)
class Sum:
    """A number held as an unevaluated sum of two floats; the second is below half a last digit."""

    high: float
    low: float = 0.0

    def __add__(self, other: Sum) -> Sum:
        total, error = two_sum(self.high, other.high)
        return _renormalised(total, error + self.low + other.low)

    def __neg__(self) -> Sum:
        return Sum(-self.high, -self.low)

    def __sub__(self, other: Sum) -> Sum:
        return self + -other

    def times(self, factor: float) -> Sum:
        """Return the product with a float."""
        high, error = two_product(self.high, factor)
        return _renormalised(high, error + self.low * factor)

    @property
    def fraction(self) -> Fraction:
        """The number itself."""
        return Fraction(self.high) + Fraction(self.low)

    def __mul__(self, ratio: Fraction) -> Sum:
        exact = self.fraction * ratio
        high = float(exact)
        return Sum(high, float(exact - Fraction(high)))

    def __float__(self) -> float:
        return float(self.high + self.low)

    @property
    def constant(self) -> Constant:
        """The number as a constant of the formulas."""
        return Constant(float(self), lambda: self.fraction)


def _renormalised(high: float, low: float) -> Sum:
    return Sum(*two_sum(high, low))


def two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """Return a + b rounded, and what rounding lost, whichever is the larger.

    Knuth, The Art of Computer Programming, volume 2, on the accuracy of floating-point arithmetic. Works
    on floats and on symbolic expressions alike.
    """
    total = a + b
    back = total - a
    return total, (a - (total - back)) + (b - back)


def two_product(a: Any, b: Any) -> tuple[Any, Any]:
    """Return a × b rounded, and what rounding lost, both numbers split into halves first.

    Dekker, A Floating-Point Technique for Extending the Available Precision.
    """
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def _split(a: Any) -> tuple[Any, Any]:
    scaled = a * 134217729.0
    high = scaled - (scaled - a)
    return high, a - high


def quarter_turns(count: int) -> Sum:
    """Return count × π/2 as a sum."""
    return Sum(QUARTER_TURN_HIGH, QUARTER_TURN_LOW).times(float(count))


HALF_TURN = quarter_turns(2)
FULL_TURN = quarter_turns(4)


def _right_angles(angle: float) -> int | None:
    """Return how many right angles an angle is the float nearest to; None where it is none."""
    count = round(angle / QUARTER_TURN_HIGH)
    return count if quarter_turns(count).high == float(angle) else None


def exact_angle(angle: float) -> Sum:
    """Return the angle as a sum; the float nearest a multiple of a right angle stands for that multiple.

    One that was written keeps what the float lacks of it.
    """
    if (count := _right_angles(angle)) is not None:
        return quarter_turns(count)
    return _renormalised(float(angle), angle.rest) if isinstance(angle, Angle) else Sum(angle)


def unit(angle: float) -> tuple[float, float]:
    """Return (cos, sin), exact at multiples of a right angle."""
    if (count := _right_angles(angle)) is not None:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[count % 4]
    return direction(angle)


def snapped(number: Sum, marks: Iterable[float], reach: float) -> Sum:
    """Return the mark from which a number differs by rounding alone, else the number.

    It was worked out from coordinates that reach so far, with a direction's sine and cosine.
    """
    return next((Sum(mark) for mark in marks if abs(float(number) - mark) <= reach * 2.0**-51), number)


def gap(*lengths: float) -> float:
    """Return the sum of signed lengths, zero where it is below what their last digits can tell.

    Decimal lengths with s + l = p + q are rarely exact in binary: a gap within 2⁻⁵³ of the
    perimeter is the rounding of the lengths, not a gap.
    """
    rest, perimeter = total(*lengths), math.fsum(abs(length) for length in lengths)
    return 0.0 if abs(float(rest)) <= perimeter * 2.0**-53 else rest


def total(*lengths: float) -> Constant:
    """Return the sum of lengths."""
    return Constant(math.fsum(lengths), lambda: sum(map(Fraction, lengths), Fraction(0)))
