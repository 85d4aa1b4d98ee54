"""Read and show quantities as people write them: their units, and how many digits.

Its parts, in reading order:

- Numbers as people read them: how many digits, which minus, and what stands where there is no value.
- Quantities as people write them ("60 rpm", "87 deg", "30 mm"), to SI, radians or the scene's unit.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from math import degrees as to_degrees
from math import floor, isfinite, isinf, log10, pi
from typing import NamedTuple

from linkanim.bounds import MOST_DIGITS
from linkanim.errors import UnitError

# Numbers as people read them: how many digits, which minus, and what stands where there is no value.

_SMALLEST, _LARGEST = -4, 7
"""The first power of ten with which a number is written without an exponent, and the first with one again."""
_ALL_DIGITS = 1e15
"""A number up to which every digit before its point is known."""
_NOTHING = 1e-13
"""Radians below which an angle is a rounding error of zero."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def significant(value: float, digits: int) -> str:
    """Return at most `digits` significant digits in ASCII: "unbounded" for an infinity, "-" for NaN."""
    if not isfinite(value):
        return "unbounded" if isinf(value) else "-"
    return f"{value + 0.0:.{digits}g}"  # -0.0 + 0.0 is 0.0


def rounded(value: float, digits: int) -> str:
    """Return `digits` significant digits, typeset, zeros at the end kept: 1.200, 24560, 3.456×10⁸.

    "∞" or "−∞" for an infinity, "–" for NaN, "0" for zero.
    """
    if not isfinite(value) or not value:
        return stepped(value, 1.0)
    mantissa, _, power = f"{value:.{digits - 1}e}".partition("e")
    if not _SMALLEST <= int(power) < max(_LARGEST, digits):
        return f"{typeset(mantissa)}×10{str(int(power)).translate(_RAISED)}"
    return typeset(f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - int(power), 0)}f}")


def short(value: float) -> str:
    """Return four significant digits, and every digit before the point that there is: 33.33, 12346, 6e+31."""
    return f"{value:.0f}" if 1000 <= abs(value) < _ALL_DIGITS else significant(value, 4)


def rpm(speed: float) -> str:
    """Return an angular speed in rad/s as turns a minute, clockwise negative."""
    return f"{short(speed * 30 / pi)} rpm"


def degrees(angle: float) -> str:
    """Return radians as degrees, typeset, in four significant digits; a rounding error of zero is 0."""
    return f"{typeset(significant(to_degrees(angle) if abs(angle) > _NOTHING else 0.0, 4))}°"


def stepped(value: float, step: float) -> str:
    """Return a number, typeset, with the decimals that a step between neighbours needs."""
    if not isfinite(value):
        return "∞" if value > 0 else "−∞" if value < 0 else "–"
    size = max(abs(value), abs(step))
    if size >= 1e6 or (0 < size < 1e-4):
        return typeset(significant(value, 3))
    places = min(max(-floor(log10(step) + 1e-9), 0), 6) if step > 0 else 0
    text = f"{value:.{places}f}"
    return typeset(text if float(text) else text.lstrip("-"))


def three_digits(value: float) -> str:
    """Return a positive number to three digits, without an exponent where it has up to six."""
    if not 1e-3 <= value < 1e6:
        return f"{value:.2e}"
    return f"{value:.{max(2 - floor(log10(value)), 0)}f}"


def four_digits(value: float) -> str:
    """Return a number to four significant digits, typeset: in full from 0.0001 to 1e7, else as 5.52×10⁻⁵.

    What is below 1e-9 counts as 0.
    """
    if not isfinite(value):
        return stepped(value, 1.0)
    mantissa, _, power = f"{value:.3e}".partition("e")
    if abs(value) < 1e-9:
        return "0"
    if not _SMALLEST <= int(power) < _LARGEST:
        return f"{typeset(f'{float(mantissa):g}')}×10{str(int(power)).translate(_RAISED)}"
    return typeset(f"{float(f'{mantissa}e{power}'):.10g}")


def typeset(text: str) -> str:
    """Return the text with true minus signs, as it is set on a picture."""
    return text.replace("-", "−")


_SIGN = re.compile(r"(?<![\w-])-(?=\d)")


def signed(text: str) -> str:
    """Return a sentence with true minus signs before its numbers; hyphens stay."""
    return _SIGN.sub("−", text)


# Quantities as people write them ("60 rpm", "87 deg", "30 mm"), to SI, radians or the scene's unit.
#
# A decimal is converted exactly (with `math.pi` for π) and rounded once, so that "0.07 cm" is the same
# length as 0.7 mm; what is equal on paper stays equal, and a change point stays one.

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|[+-]?(?:nan|inf(?:inity)?))", re.I | re.A)
_PI = Fraction(math.pi)
PI_REST = 1.2246467991473532e-16
"""What `math.pi` lacks of π: their sum is right to 32 digits."""


class Angle(float):
    """An angle in radians as a float, with the `rest` by which the angle as it was written exceeds it."""

    __slots__ = ("rest",)
    rest: float

    def __new__(cls, nearest: float, rest: float = 0.0) -> Angle:
        """Return the angle that is the sum of two floats."""
        angle = super().__new__(cls, nearest)
        angle.rest = rest
        return angle

    def __eq__(self, other: object) -> bool:
        # To a plain float it is equal, as the float that it is.
        equal = float.__eq__(self, other)
        return self.rest == getattr(other, "rest", self.rest) if equal is True else equal

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __reduce__(self) -> tuple[type[Angle], tuple[float, float]]:
        return Angle, (float(self), self.rest)

    __hash__ = float.__hash__


class Units(NamedTuple):
    """What is measured: its name, and its units as factors to the base unit."""

    noun: str
    factors: dict[str, Fraction]

    def read(self, value: object) -> float:
        """Return a quantity with its unit in the base unit; UnitError as in `angle`."""
        number, unit = _split(value, self)
        if not unit and math.isfinite(float(number)):
            raise UnitError(f"{shown(value)} has no unit; write {self.noun} as {_examples(value, self)}")
        return _rounded(number, self.factors.get(unit, Fraction(1)), value, self)


_ONE = Fraction(1)
ANGLE = Units("an angle", {"deg": _PI / 180, "rad": _ONE})
SPEED = Units("an angular speed", {"rpm": _PI / 30, "rad/s": _ONE, "deg/s": _PI / 180})
TRAVEL_SPEED = Units(
    "a speed", {"mm/s": _ONE / 1000, "cm/s": _ONE / 100, "m/s": _ONE, "in/s": Fraction(254, 10000)}
)
EITHER_SPEED = Units("a speed", {**TRAVEL_SPEED.factors, **SPEED.factors})
ANGULAR_ACCELERATION = Units("an angular acceleration", {"rad/s^2": _ONE, "deg/s^2": _PI / 180})
_FASTEST = 1.05e6
"""The highest angular speed in rad/s: 1e7 rpm, with a margin for rounding."""
_LENGTH = Units("a length", {"mm": _ONE / 1000, "cm": _ONE / 100, "m": _ONE, "in": Fraction(254, 10000)})
STIFFNESS = Units("a stiffness", {"N/m": _ONE, "N/mm": _ONE * 1000, "kN/m": _ONE * 1000})
DAMPING = Units("a damping coefficient", {"N s/m": _ONE, "N s/mm": _ONE * 1000, "kN s/m": _ONE * 1000})
MASS = Units("a mass", {"kg": _ONE, "g": _ONE / 1000, "t": _ONE * 1000})
INERTIA = Units(
    "a moment of inertia",
    {"kg m^2": _ONE, "kg cm^2": _ONE / 10**4, "kg mm^2": _ONE / 10**6, "g mm^2": _ONE / 10**9},
)
FORCE = Units("a force", {"N": _ONE, "kN": _ONE * 1000})
TORQUE = Units("a torque", {"N m": _ONE, "N mm": _ONE / 1000, "N cm": _ONE / 100, "kN m": _ONE * 1000})
FALL = Units("an acceleration", {"m/s^2": _ONE, "mm/s^2": _ONE / 1000})
_ALL = (
    *(ANGLE, SPEED, TRAVEL_SPEED, ANGULAR_ACCELERATION, _LENGTH),
    *(STIFFNESS, DAMPING, MASS, INERTIA, FORCE, TORQUE),
)
_SPELLINGS = (("°", "deg"), ("²", "2"), ("^2", "2"))
"""Other spellings of a part of a unit, and the one that stands for them."""

LENGTH_UNITS = tuple(_LENGTH.factors)


def angle(value: object) -> Angle:
    """Return an angle in radians: "87 deg" or "1.5 rad", with the rest that rounding takes from it.

    A multiple of 90 degrees comes back as that multiple of `math.pi / 2`, rounded once. UnitError
    where the unit is missing or unknown, or the number is not finite.
    """
    nearest = ANGLE.read(value)
    if nearest == 0.0:
        return Angle(nearest)
    number, unit = _split(value, ANGLE)
    exact = ANGLE.factors[unit] * Fraction(Decimal(number))
    if unit == "deg":
        exact *= 1 + Fraction(PI_REST) / _PI
    return Angle(nearest, float(exact - Fraction(nearest)))


def angular_speed(value: object) -> float:
    """Return an angular speed in rad/s: "60 rpm", "6.28 rad/s", "360 deg/s".

    UnitError as in `angle`, and for what is faster than anything turns.
    """
    speed = SPEED.read(value)
    if abs(speed) > _FASTEST:
        raise UnitError(f'{shown(value)} is faster than anything turns; write at most "1e7 rpm"')
    return speed


def length(value: object, *, unit: str) -> float:
    """Return a length in `unit`: "30 mm", or a bare number, which is taken in `unit`.

    Zero and negative lengths pass (a coordinate may be either). UnitError where the unit is unknown,
    or the value is not a finite number.
    """
    number, written = _split(value, _LENGTH)
    factor = _LENGTH.factors[written] / _LENGTH.factors[_length_unit(unit)] if written else Fraction(1)
    return _rounded(number, factor, value, _LENGTH)


def unit_of(metres: float) -> str:
    """Return the unit of length whose size in metres this is; "" where there is none."""
    return next((unit for unit in LENGTH_UNITS if metre(unit) == metres), "")


def metre(unit: str) -> float:
    """Return one `unit` of length in metres (0.001 for mm); UnitError for a unit that is not a length."""
    return float(_LENGTH.factors[_length_unit(unit)])


def split(text: str) -> tuple[float, str]:
    """Part "87 deg" into the number and the unit as written ("" for none); UnitError where it has no number.

    The number is the nearest float, which may be infinite.
    """
    match = _NUMBER.match(text)
    if match is None:
        raise UnitError(f"{shown(text)} is not a number with a unit, such as 30 mm, 87 deg or 60 rpm")
    return float(match[1]), text[match.end() :].strip()


def names_unit(text: str, of: Units) -> bool:
    """Tell whether a text ends in one of the units of a quantity."""
    match = _NUMBER.match(text)
    return match is not None and _folded(text[match.end() :]) in map(_folded, of.factors)


def is_quantity(text: str) -> bool:
    """Tell whether a text is a number with a unit that is known."""
    match = _NUMBER.match(text)
    known = {_folded(name) for one in _ALL for name in one.factors}
    return match is not None and _folded(text[match.end() :]) in known


def shown(value: object) -> str:
    """Return a value as a message shows it: on one line, text in quotes, cut at 60 characters."""
    if isinstance(value, str):
        clean = "".join(c if c.isprintable() else "?" for c in value)
        return f'"{clean if len(clean) <= 60 else clean[:57] + "..."}"'
    try:
        text = str(value).lower() if isinstance(value, bool) else ascii(value)
    except ValueError:  # Python prints no integer of more than 4300 digits
        return "a number of thousands of digits"
    return text if len(text) <= 60 else text[:57] + "..."


def _split(value: object, units: Units) -> tuple[str, str]:
    """Part a value into its number as text and its unit's name, "" where there is none."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise UnitError(f"{shown(value)} is not {units.noun}; write {_examples(1, units)}")
    if not isinstance(value, str):
        return _digits(value, units), ""
    match = _NUMBER.match(value)
    if match is None:
        raise UnitError(f"{shown(value)} is not {units.noun}; write {_examples(1, units)}")
    if len(match[1]) > MOST_DIGITS:
        raise UnitError(f"{shown(value)} has more than {MOST_DIGITS:,} digits; write fewer")
    written = value[match.end() :].strip()
    return match[1], _named(written, value, units) if written else ""


def _digits(value: float, units: Units) -> str:
    """Return a number's shortest decimal, which is what its writer meant."""
    try:
        return repr(float(value))
    except OverflowError:
        raise UnitError(
            f"{shown(value)} is too large for {units.noun}; write {_examples(1, units)}"
        ) from None


def _named(written: str, value: object, units: Units) -> str:
    for name in units.factors:
        if _folded(name) == _folded(written):
            return name
    known = ", ".join(units.factors)
    raise UnitError(f"{shown(value)} is not {units.noun}: {shown(written)} is not one of its units, {known}")


def _folded(unit: str) -> str:
    bare = re.sub(r"[\s*·⋅.]", "", unit).lower()
    for written, meant in _SPELLINGS:
        bare = bare.replace(written, meant)
    return bare


def _rounded(number: str, factor: Fraction, value: object, units: Units) -> float:
    nearest = float(number)
    if not math.isfinite(nearest):
        raise UnitError(f"{shown(value)} is not a finite number; write {units.noun} as {_examples(1, units)}")
    if nearest == 0.0 or factor == 1:
        return nearest + 0.0
    try:
        return float(Fraction(Decimal(number)) * factor)
    except OverflowError:
        raise UnitError(f"{shown(value)} is too large for {units.noun}; write a smaller number") from None


def _length_unit(unit: str) -> str:
    if unit not in _LENGTH.factors:
        raise UnitError(f"{shown(unit)} is not a unit of length; use one of {', '.join(_LENGTH.factors)}")
    return unit


def _examples(value: object, units: Units) -> str:
    number = str(value).strip() if isinstance(value, str | int | float) else "1"
    return " or ".join(f'"{number[:24]} {unit}"' for unit in units.factors)
