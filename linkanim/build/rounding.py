"""Round numbers: places on a grid, lengths and angles as a person would write them."""

from __future__ import annotations

from math import atan2, degrees, radians

FREE = 1e-3
"""The step of what is drawn without snapping, in its unit."""
_ANGLES = (1.0, 0.1, 0.01, 0.001)


def snapped(place: complex, step: float) -> complex:
    """Return the nearest place, x + yi, whose coordinates are multiples of a step; 0 is the finest."""
    return complex(_multiple(place.real, step or FREE), _multiple(place.imag, step or FREE))


def round_number(value: float, step: float) -> int | float:
    """Return the nearest multiple of a step, whole numbers as such; 0 is the finest."""
    number = _multiple(value, step or FREE)
    return int(number) if number.is_integer() else number


def round_length(value: float, step: float) -> int | float:
    """Return the nearest multiple of a step above zero; of a finer one where that would be zero."""
    step = step or FREE
    while not (number := round_number(abs(value), step)) and step > 1e-9:
        step /= 10
    return number or step


def round_angle(way: complex, step: float) -> str:
    """Return a way's direction in the roundest degrees that keep its end within half a step."""
    return f"{round_degrees(degrees(atan2(way.imag, way.real)), abs(way), step):g} deg"


def round_degrees(angle: float, reach: float, step: float) -> int | float:
    """Return the roundest degrees that keep what lies so far away within half a step."""
    off = (step or FREE) / 2
    fine = next(
        (fine for fine in _ANGLES if reach * radians(abs(angle - round_number(angle, fine))) <= off), FREE
    )
    return round_number(angle, fine)


def _multiple(value: float, step: float) -> float:
    """Return the nearest multiple of a step as a decimal, never -0."""
    return float(f"{round(value / step) * step:.9f}") + 0.0
