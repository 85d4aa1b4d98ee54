"""Constants of the formulas: floats that know which number they stand for.

Worked out in floats, a constant is right to its last digit, and so is what is made of it. Not so a limit that
is found in many digits: the way that is left to it may be as small as that last digit. So what is made of
constants by + - × ÷ and square roots keeps the number, too, for the formulas that are run in many digits.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from decimal import Context, Decimal
from fractions import Fraction
from typing import Any

DIGITS = 50


Number = Fraction | Decimal | float


def _arithmetic(
    operate: Callable[[Any, Any], Any],
) -> tuple[Callable[[Any, Any], Any], Callable[[Any, Any], Any]]:
    """Return what an operation makes of floats and of the numbers they stand for, and it turned round."""

    def apply(a: Any, b: Any) -> Any:
        if not (isinstance(a, int | float) and isinstance(b, int | float)):
            return NotImplemented
        return Constant(operate(float(a), float(b)), lambda: operate(Fraction(a), Fraction(b)))

    return apply, lambda b, a: apply(a, b)


class Constant(float):
    """A float, and the `number` that it stands for: itself, where none is given.

    Equal to what is the same float and stands for the same; `Fraction` takes the number. That is worked out
    when it is first asked for, which it seldom is.
    """

    __slots__ = ("_known",)
    _known: Callable[[], Number] | Number

    def __new__(cls, nearest: float, number: Callable[[], Number] | Number | None = None) -> Constant:
        """Return the constant of a number, or of what finds it."""
        constant = super().__new__(cls, nearest)
        constant._known = nearest if number is None else number
        return constant

    @property
    def number(self) -> Fraction:
        """The number."""
        known = self._known
        if not isinstance(known, Fraction):
            known = self._known = Fraction(known() if callable(known) else known)
        return known

    def __reduce__(self) -> tuple[type[Constant], tuple[float, Fraction]]:
        return Constant, (float(self), self.number)

    def as_integer_ratio(self) -> tuple[int, int]:
        """Return the number as a quotient."""
        return self.number.as_integer_ratio()

    def __eq__(self, other: object) -> bool:
        equal = float.__eq__(self, other)
        return self.number == Fraction(other) if equal is True and isinstance(other, int | float) else equal

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(float(self))

    def __neg__(self) -> Constant:
        return Constant(-float(self), lambda: -self.number)

    def __abs__(self) -> Constant:
        return Constant(abs(float(self)), lambda: abs(self.number))

    __add__, __radd__ = _arithmetic(operator.add)
    __sub__, __rsub__ = _arithmetic(operator.sub)
    __mul__, __rmul__ = _arithmetic(operator.mul)
    __truediv__, __rtruediv__ = _arithmetic(operator.truediv)


def nearest(number: Fraction) -> Constant:
    """Return the constant that stands for a number."""
    return Constant(float(number), number)


def root(square: float) -> float:
    """Return the square root of a float; of a constant, that of its number to fifty digits."""
    if not isinstance(square, Constant):
        return math.sqrt(square)
    return Constant(math.sqrt(square), lambda: digits_of(square).sqrt(Context(prec=DIGITS)))


def digits_of(number: float) -> Decimal:
    """Return a float with all its digits, of a constant fifty of its number's."""
    if not isinstance(number, Constant):
        return Decimal(number)
    numerator, denominator = number.as_integer_ratio()
    return Context(prec=DIGITS, traps=[]).divide(Decimal(numerator), Decimal(denominator))
