"""Fifty digits, for what is worked out once: the zeros of roots, and the smooth functions next to them."""

from __future__ import annotations

import math
from decimal import Context, Decimal, getcontext, localcontext
from functools import lru_cache

from linkanim.mechanics.angles import Sum, exact_angle, unit
from linkanim.mechanics.arithmetic import DIGITS, Constant, digits_of

PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")

_SPARE = 10
"""Digits that sums have in addition to those asked for."""


def context() -> Context:
    """Return a context of fifty digits, in which what cannot be computed gives NaN or infinity, no error."""
    return Context(prec=DIGITS, traps=[])


def exactly(number: Sum | float) -> Decimal:
    """Return the number with all its digits."""
    return digits_of(number.high) + digits_of(number.low) if isinstance(number, Sum) else digits_of(number)


def nearest_sum(number: Decimal) -> Sum:
    """Return the sum of two floats nearest a number."""
    high = float(number)
    return Sum(high, float(number - Decimal(high)))


def square_root(number: Decimal) -> Decimal:
    """Return the square root; 0 for a number below zero, which is so by rounding only."""
    return max(number, Decimal(0)).sqrt()


def sine(angle: Decimal) -> Decimal:
    """Return the sine."""
    return sine_and_cosine(angle)[0]


def cosine(angle: Decimal) -> Decimal:
    """Return the cosine."""
    return sine_and_cosine(angle)[1]


def sine_and_cosine(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Return sine and cosine, by their series after whole right angles are taken off."""
    if not angle.is_finite():
        return Decimal("NaN"), Decimal("NaN")
    return _series(angle, getcontext().prec)


@lru_cache(maxsize=8)
def _fixed_point(digits: int) -> tuple[int, Decimal]:
    """Return how many binary places hold so many digits and some more, and the whole number that means 1."""
    bits = math.ceil((digits + _SPARE) * math.log2(10))
    return bits, Decimal(1 << bits)


@lru_cache(maxsize=64)
def _series(angle: Decimal, digits: int) -> tuple[Decimal, Decimal]:
    """Return sine and cosine in the context's digits; cached, since formulas ask for one after the other.

    The sums are of whole numbers with so many binary places: Python's are ten times as fast as Decimals.
    """
    bits, unit = _fixed_point(digits)
    count = int((2 * angle / PI).to_integral_value())
    rest = angle - count * PI / 2
    square = int(rest * rest * unit)
    term = cosines = sines = 1 << bits  # of the cosine, and of the sine over its angle
    n = 1
    while term and n < 4 * DIGITS:
        term = (term * square >> bits) // -(n + 1)
        cosines += term
        term //= n + 2
        sines += term
        n += 2
    cosine, sine = Decimal(cosines) / unit, rest * (Decimal(sines) / unit)
    return ((sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine))[count % 4]


def sides(angle: float) -> tuple[Decimal, Decimal]:
    """Return sine and cosine of an angle as it was written, exact at multiples of a right angle."""
    along, left = unit(angle)
    if 0.0 in (along, left):
        return Decimal(left), Decimal(along)
    with localcontext(context()):
        return sine_and_cosine(exactly(exact_angle(angle)))


def direction(angle: float) -> tuple[Constant, Constant]:
    """Return (cos, sin) of an angle as it was written."""
    along, left = unit(angle)
    return Constant(along, lambda: sides(angle)[1]), Constant(left, lambda: sides(angle)[0])


def interpolated(places: list[Decimal], values: list[Decimal]) -> list[float]:
    """Return the coefficients of the polynomial through the values, the constant one first.

    By Newton's divided differences, multiplied out (Abramowitz and Stegun, Handbook of Mathematical
    Functions, on interpolation); fifty digits bear what cancels.
    """
    divided = list(values)
    for step in range(1, len(places)):
        for k in range(len(places) - 1, step - 1, -1):
            divided[k] = (divided[k] - divided[k - 1]) / (places[k] - places[k - step])
    coefficients = [divided[-1]]
    for node, difference in zip(places[-2::-1], divided[-2::-1], strict=True):
        shifted = [Decimal(0), *coefficients]
        coefficients = [a - node * b for a, b in zip(shifted, [*coefficients, Decimal(0)], strict=True)]
        coefficients[0] += difference
    return [float(coefficient) for coefficient in coefficients]


def nodes(count: int) -> list[Decimal]:
    """Return the zeros of the Chebyshev polynomial of that degree, at which interpolation errs least."""
    return [Decimal(math.cos(math.pi * (k + 0.5) / count)) for k in range(count)]
