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

    def __add__(self, other: Any) -> Any:
        return _both(operator.add, self, other)

    def __radd__(self, other: Any) -> Any:
        return _both(operator.add, other, self)

    def __sub__(self, other: Any) -> Any:
        return _both(operator.sub, self, other)

    def __rsub__(self, other: Any) -> Any:
        return _both(operator.sub, other, self)

    def __mul__(self, other: Any) -> Any:
        return _both(operator.mul, self, other)

    def __rmul__(self, other: Any) -> Any:
        return _both(operator.mul, other, self)

    def __truediv__(self, other: Any) -> Any:
        return _both(operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return _both(operator.truediv, other, self)


def _both(operate: Callable[[Any, Any], Any], a: Any, b: Any) -> Any:
    """Return what an operation makes of floats and of the numbers that they stand for."""
    if not (isinstance(a, int | float) and isinstance(b, int | float)):
        return NotImplemented
    return Constant(operate(float(a), float(b)), lambda: operate(Fraction(a), Fraction(b)))


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
