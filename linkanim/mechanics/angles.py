"""Work out angles to the last digit: circular functions, unit vectors, exact sums of two floats.

Its parts, in reading order:

- Sines and cosines out of + - × ÷ and rint alone.
- Small exact pieces: sums of two floats, unit vectors of angles, differences without rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from linkanim.frozen import frozen
from linkanim.mechanics.arithmetic import Constant, Expr, Value, rint, select
from linkanim.mechanics.tolerances import GAP, MARKED, STATED
from linkanim.units import PI_REST, Angle

# Sines and cosines out of + - × ÷ and rint alone.
#
# A C library's functions differ between machines, and numpy's vector versions from both. IEEE 754
# rounds these five operations in one way only, so a float, a batch of any size and every machine get
# the same bits. Each formula is written once, on floats or symbolic expressions.
#
# An angle is first brought near zero by whole periods, held in parts of which n times each but the last is
# exact up to n = 2³² (W. J. Cody and W. Waite, "Software Manual for the Elementary Functions"). Sines and
# cosines are rational in the tangent of a share of what is left, which is a sum over its poles; where
# squares of them are enough, the tangent stays a ratio of two polynomials.

Pair = tuple[Value, Value]

PI_PARTS = tuple(
    map(float.fromhex, ("0x1.921FBp1", "0x1.5110Ap-21", "0x1.4611Ap-41", "0x1.898CC51701B84p-63"))
)
"""π: its first 21 bits, the next 21, again, and the rest."""
POLES = (
    (2.4674011035387218, 0.8105694770977893),
    (22.28701080796582, 0.09166082321842979),
    (87.24566875059766, 0.06187044081627574),
)
"""zₖ and cₖ of tan r ≈ r + r³ Σ cₖ/(zₖ - r²), the nearest of that form on ±π/4: 2e-17 of it at most.

It is the tangent's expansion in poles, cut off after three terms, whose poles are moved to where the worst
error is least (found by Remez's exchange at 60 digits). All terms are positive, so nothing cancels.
"""
NUMERATOR = (
    0.011257044481653348,
    -43.6393823400964,
    23622.070494376192,
    -3295897.1324085817,
    95958473.12357695,
)
DENOMINATOR = (1.0, -1215.4805641571577, 330009.01549134793, -22584873.118746653, 191916946.2471539)
"""N and D of tan(ψ/2) ≈ ψ N(ψ²)/D(ψ²), the nearest with these degrees on ±π: 1.2e-18 of ψ at most.

Highest powers first. Times one factor, ψ N is the sine and D the cosine of half the angle.
"""


def reduced(angle: Value, rest: Value, turns: float) -> Pair:
    """Return n and angle + rest - n × period, the period being `turns` (a power of two) half turns.

    The result is within half a period of zero, and right to its own last digit down to 1e-11 times n.
    """
    first, second, third, fourth = (part * turns for part in PI_PARTS)
    n = rint(angle * (1.0 / (turns * math.pi)))
    return n, ((angle - n * first) - n * second) - (n * (third + fourth) - rest)


def sharply_reduced(angle: Value, rest: Value) -> Pair:
    """Return n, and angle + rest less n half turns: right to the last digit, however small that is."""
    first, second, third, fourth = PI_PARTS
    n = rint(angle * (1.0 / math.pi))
    near, step = (angle - n * first) - n * second, n * third
    close = near - step
    lost = (near - close) - step
    return n, close - ((n * fourth - rest) - lost)


def tangent(angle: Value, share: float) -> Value:
    """Return share × tan(angle/share) for an angle within π/4 of the share, a power of two."""
    square, scale = angle * angle, share * share
    (z1, c1), (z2, c2), (z3, c3) = ((angle_of_pole * scale, weight) for angle_of_pole, weight in POLES)
    poles = (c3 / (z3 - square) + c2 / (z2 - square)) + c1 / (z1 - square)
    return angle + square * poles * angle


class Squares(NamedTuple):
    """sin², cos² and sin × cos of half an angle, times one factor."""

    sine: Value
    cosine: Value
    product: Value


@frozen
class Half:
    """Half an angle, worked out as far as it is read.

    `sides` gives its sine and cosine, whose signs change with every turn of the whole angle; `times` gives
    the squares and the product of both, which do not, times a factor.
    """

    sides: Callable[[], Pair]
    times: Callable[[float], Squares]

    def squares(self, factor: float) -> Squares:
        """Return sin², cos² and sin × cos of the half angle, times a factor."""
        squares = self._squares.get(factor)
        if squares is None:
            squares = self._squares[factor] = self.times(factor)
        return squares

    @cached_property
    def _squares(self) -> dict[float, Squares]:
        return {}

    @cached_property
    def _sides(self) -> Pair:
        return self.sides()

    @property
    def sine(self) -> Value:
        """The sine of half the angle."""
        return self._sides[0]

    @property
    def cosine(self) -> Value:
        """The cosine of half the angle."""
        return self._sides[1]


def _left(angle: Value, rest: Value, quarters: int | None) -> Pair:
    """Return n and angle + rest less n turns; 0 and the sum itself where `quarters` were taken off before."""
    return reduced(angle, rest, 2.0) if quarters is None else (0.0, angle + rest)


def _quartered(half: Half, quarters: int | None) -> Half:
    """Return half an angle, advanced by that many quarter turns."""

    def sides() -> Pair:
        sine, cosine = half.sine, half.cosine
        return ((sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine))[(quarters or 0) % 4]

    def squares(factor: float) -> Squares:
        sine, cosine, product = half.squares(factor)
        return Squares(cosine, sine, -product)

    return Half(sides, squares if (quarters or 0) % 2 else half.squares) if quarters else half


def half_of(sine: Value, cosine: Value) -> Half:
    """Return the half angle of a sine and a cosine."""

    def squares(factor: float) -> Squares:
        return Squares(sine * sine * factor, cosine * cosine * factor, sine * cosine * factor)

    return Half(lambda: (sine, cosine), squares)


def half_angle(angle: Value, rest: Value = 0.0, size: float = 1.0, quarters: int | None = None) -> Half:
    """Return half of angle + rest for its squares: cos² to the last digit of 1, sin² to its own.

    With B/A the tangent, sin², cos² and sin × cos are B², A² and A B over A² + B². Squares times `size` cost
    no more than those alone. Sine and cosine are those of `signed_half_angle`.
    Where `quarters` are given, angle + rest lies within half a turn of zero, and the result is half of it
    plus that many quarter turns: the sine (with an odd number, the cosine) is then right to its own last
    digit, however small angle + rest is.
    """
    if _is_exact(angle):
        return _exact_half(angle, rest, quarters)

    def squares(factor: float) -> Squares:
        _, left = _left(angle, rest, quarters)
        square = left * left
        b, a = left * _polynomial(NUMERATOR, square), _polynomial(DENOMINATOR, square)
        # The product comes first: then each square can be written over its own root.
        product, b_square, a_square = a * b, b * b, a * a
        share = size / (a_square + b_square) * (factor / size)
        return Squares(b_square * share, a_square * share, product * share)

    return _quartered(Half(lambda: _signed_half(angle, rest, size, quarters).sides(), squares), quarters)


def _polynomial(coefficients: tuple[float, ...], x: Value) -> Value:
    """Return the polynomial of these coefficients, that of the highest power first (Horner's form)."""
    first, *others = coefficients
    value: Value = first
    for coefficient in others:
        value = value * x + coefficient
    return value


def signed_half_angle(
    angle: Value, rest: Value = 0.0, size: float = 1.0, quarters: int | None = None
) -> Half:
    """Return half of angle + rest; the cosine to the last digit of 1, the sine to its own.

    Both are rational in the tangent t of half of it: (1 - t²)/(1 + t²) and 2t/(1 + t²). Squares times
    `size` cost no more than those alone. `quarters` are those of `half_angle`.
    """
    if _is_exact(angle):
        return _exact_half(angle, rest, quarters)
    return _quartered(_signed_half(angle, rest, size, quarters), quarters)


def _signed_half(angle: Value, rest: Value, size: float, quarters: int | None) -> Half:
    n, remainder = _left(angle, rest, quarters)
    t = tangent(remainder, 4.0)
    square = t * t
    norm, rest_of_norm = square + 16.0, 16.0 - square

    def sides() -> Pair:
        share = _sign(n) / norm
        return t * share * 8.0, rest_of_norm * share

    def squares(factor: float) -> Squares:
        share = 64.0 * size / (norm * norm) * (factor / size)
        # cos² is computed on its own: with 1 - sin² the error would be doubled in cos² - sin².
        cosine_square = rest_of_norm * rest_of_norm * share * (1 / 64)
        return Squares(square * share, cosine_square, t * share * rest_of_norm * 0.125)

    return Half(sides, squares)


def sharp_half_angle(angle: Value, rest: Value = 0.0, *, quarters: int | None = None) -> Half:
    """Return half of angle + rest, sine and cosine each to its own last digit, also next to its zeros.

    `quarters` are those of `half_angle`; angle + rest then lies within three eighths of a turn of zero.
    """
    if _is_exact(angle):
        return _exact_half(angle, rest, quarters)
    if quarters is not None:
        return _quartered(half_of(*_halved(angle + rest)), quarters)
    return half_of(*_sharp_sides(angle, rest))


def stated(side: Value, phase: Value, share: float = 1.0) -> Value:
    """Return `side`, a sine or cosine of that share of a phase; 0 where the phase stands for its zero.

    A phase is stated as a float, and no float is π: within two to four of its last digits of a multiple of
    half a turn it counts as that. There a vanishing sine is exactly 0, and a quotient over it is unbounded.
    """
    if _is_exact(phase):
        return side
    return select(side * side, (phase * phase + math.pi**2) * (share * STATED) ** 2, 0.0, side)


def _is_exact(angle: Value) -> bool:
    return isinstance(angle, Expr) and angle.graph.exact


def _exactly(function: str, angle: Value) -> Value:
    assert isinstance(angle, Expr)
    return angle.graph.node(function, angle)


def _exact_half(angle: Value, rest: Value, quarters: int | None) -> Half:
    half = (angle + rest) * 0.5
    return _quartered(half_of(_exactly("sin", half), _exactly("cos", half)), quarters)


def _sign(n: Value) -> Value:
    """Return (-1)ⁿ as 1 - 2 (n mod 2)²."""
    odd = n - rint(n * 0.5) * 2.0
    return 1.0 - odd * odd * 2.0


def _sharp_sides(angle: Value, rest: Value) -> Pair:
    """Return sine and cosine of half an angle, by those of the remainder from the nearest quarter turn.

    n quarter turns are k half turns and f ∈ {-1, 0, 1} quarters.
    """
    n, remainder = sharply_reduced(angle, rest)
    sine, cosine = _halved(remainder)
    k = rint(n * 0.5)
    f = n - k * 2.0
    even, sign = 1.0 - f * f, _sign(k)
    return (sine * even + cosine * f) * sign, (cosine * even - sine * f) * sign


def cosine_of(angle: Value) -> Value:
    """Return the cosine, to its own last digit also next to its zeros."""
    return sharp_half_angle(angle * 2.0).cosine


def sine_within(angle: Value) -> Value:
    """Return the sine of an angle from 0 to π/2, to its own last digit."""
    if _is_exact(angle):
        return _exactly("sin", angle)
    t = tangent(angle, 2.0)
    return t * 4.0 / (t * t + 4.0)


def cosine_within(angle: Value) -> Value:
    """Return the cosine of an angle from 0 to π, to the last digit of 1."""
    if _is_exact(angle):
        return _exactly("cos", angle)
    sine, _ = _halved(angle)
    return 1.0 - sine * sine * 2.0


def _halved(angle: Value) -> Pair:
    """Return sine and cosine of half an angle of at most half a turn."""
    t = tangent(angle, 4.0)
    square = t * t
    norm = 1.0 / (square + 16.0)
    return t * norm * 8.0, (16.0 - square) * norm


def direction(angle: float) -> tuple[float, float]:
    """Return cosine and sine of a float, each to its own last digit."""
    sine, cosine = _sharp_sides(angle * 2.0, 0.0)
    assert isinstance(sine, float)
    assert isinstance(cosine, float)
    return cosine, sine


# Small exact pieces: sums of two floats, unit vectors of angles, differences without rounding.

QUARTER_TURN_HIGH = math.pi / 2
QUARTER_TURN_LOW = PI_REST / 2
"""π/2 is the sum of the two, to 32 digits."""


@frozen
class Sum:
    """A number held as an unevaluated sum of two floats; the second is below half a last digit."""

    high: Any
    low: Any = 0.0

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
        if ratio == 1:
            return self
        if isinstance(self.high, Expr):
            return self.times(float(ratio))
        exact = self.fraction * ratio
        high = float(exact)
        return Sum(high, float(exact - Fraction(high)))

    def __float__(self) -> float:
        return float(self.high + self.low)

    @property
    def constant(self) -> Any:
        """The number as a constant of the formulas, or their value where it is made of lengths."""
        if isinstance(self.high, Expr) or isinstance(self.low, Expr):
            return self.high + self.low
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

    A constant keeps what its float lacks of the angle as it was written.
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

    `reach` is the size of the coordinates from which the number was computed, with a direction's sine and
    cosine.
    """
    return next((Sum(mark) for mark in marks if abs(float(number) - mark) <= reach * MARKED), number)


def gap(*lengths: float) -> float:
    """Return the sum of signed lengths, zero where it is below what their last digits can tell.

    Decimal lengths with s + l = p + q are rarely exact in binary: a gap within 2⁻⁵³ of the
    perimeter is the rounding of the lengths, not a gap.
    """
    rest, perimeter = total(*lengths), math.fsum(abs(length) for length in lengths)
    return 0.0 if abs(float(rest)) <= perimeter * GAP else rest


def total(*lengths: float) -> Constant:
    """Return the sum of lengths."""
    return Constant(math.fsum(lengths), lambda: sum(map(Fraction, lengths), Fraction(0)))
