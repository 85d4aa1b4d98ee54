"""Numbers as people read them: how many digits, which minus, and what stands where there is no value."""

from __future__ import annotations

from math import degrees as to_degrees
from math import floor, isfinite, isinf, log10, pi

_SMALLEST, _LARGEST = -4, 7
"""Powers of ten from which and up to which a number is written without one."""
_NOTHING = 1e-13
"""Radians that are left of none."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def significant(value: float, digits: int) -> str:
    """Return at most so many significant digits in ASCII: "unbounded" for an infinity, "-" for NaN."""
    if not isfinite(value):
        return "unbounded" if isinf(value) else "-"
    return f"{value + 0.0:.{digits}g}"  # -0.0 + 0.0 is 0.0


def rounded(value: float, digits: int) -> str:
    """Return so many significant digits, set, with the noughts that they end in: 1.200, 24560, 3.456×10⁸.

    "∞" or "−∞" for an infinity, "–" for NaN, "0" for nothing.
    """
    if not isfinite(value) or not value:
        return stepped(value, 1.0)
    mantissa, _, power = f"{value:.{digits - 1}e}".partition("e")
    if not _SMALLEST <= int(power) < max(_LARGEST, digits):
        return f"{typeset(mantissa)}×10{str(int(power)).translate(_RAISED)}"
    return typeset(f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - int(power), 0)}f}")


def short(value: float) -> str:
    """Return four significant digits, and every digit before the point: 33.33, 12346."""
    return significant(value, 4) if abs(value) < 1000 else f"{value:.0f}"


def rpm(speed: float) -> str:
    """Return an angular speed in rad/s as turns a minute, clockwise negative."""
    return f"{short(speed * 30 / pi)} rpm"


def degrees(angle: float) -> str:
    """Return an angle in radians as degrees of four significant digits; what rounding leaves of none is 0."""
    return f"{significant(to_degrees(angle) if abs(angle) > _NOTHING else 0.0, 4)}°"


def stepped(value: float, step: float) -> str:
    """Return a number, set, with the decimals that a step between neighbours needs."""
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


def typeset(text: str) -> str:
    """Return the text with true minus signs, as it is set on a picture."""
    return text.replace("-", "−")
