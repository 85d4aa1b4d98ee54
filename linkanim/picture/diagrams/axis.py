"""Axes of a chart: where values lie along them, and few ticks at round numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.digits import stepped

_WILD = 8.0
"""A peak this many times the span of the middle nine tenths is cut off, or all else would be a line."""
_LITTLE = 0.06
"""Of the span of the values, left free at either end."""


@dataclass(frozen=True)
class Axis:
    """The range of an axis, and its ticks as (value, label)."""

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]

    def share(self, values: ArrayLike) -> NDArray[np.float64]:
        """Return where values lie, 0 at the low end and 1 at the high one."""
        share: NDArray[np.float64] = (np.asarray(values, float) - self.low) / (self.high - self.low)
        return share


def linear(low: float, high: float, *, most: int = 5, unit: str = "") -> Axis:
    """Return an axis from `low` to `high` with at most so many ticks, at 1, 2 or 5 times a power of ten.

    In degrees (`unit` "°") ticks lie at parts of a turn; no other unit stands with their numbers.
    """
    sign = "°" if unit == "°" else ""
    step = _degrees(high - low, most) if unit == "°" else round_step(high - low, most)
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    ticks = tuple((k * step, f"{stepped(k * step, step)}{sign}") for k in range(first, last + 1))
    return Axis(low, high, ticks)


def around(values: NDArray[np.float64], *, most: int = 5, unit: str = "", room: float = _LITTLE) -> Axis:
    """Return a linear axis that holds the finite values, with a little room; wild peaks run out of it."""
    low, high = range_around(values, room)
    return linear(low, high, most=most, unit=unit)


def range_around(values: NDArray[np.float64], room: float = _LITTLE) -> tuple[float, float]:
    """Return from where to where an axis runs that holds the finite values, with a little room."""
    finite = values[np.isfinite(values)]
    low, high = _span(finite) if finite.size else (0.0, 1.0)
    size = max(abs(low), abs(high))
    if high - low <= 1e-9 * size or high == low:
        low, high = (low - 0.5 * size, high + 0.5 * size) if size else (-1.0, 1.0)
    beyond = room * (high - low)
    return low - beyond, high + beyond


def zeros_level(ranges: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return two ranges about zero stretched, both by one factor, until their zeros lie at one height.

    Below zero lie the shares a < b of the two. With the zero at s the one is stretched (1 - a) / (1 - s)
    times and the other b / s times, which is alike where s = b / (1 - a + b).
    """
    shares = sorted(-low / (high - low) for low, high in ranges)
    zero = shares[1] / (1 - shares[0] + shares[1])
    spans = (max(-low / zero, high / (1 - zero)) for low, high in ranges)
    return [(-zero * span, (1 - zero) * span) for span in spans]


def _span(finite: NDArray[np.float64]) -> tuple[float, float]:
    low, high = float(finite.min()), float(finite.max())
    inner = np.quantile(finite, (0.05, 0.95))
    middle = float(inner[1] - inner[0])
    if high - low > _WILD * middle > 0:
        return max(low, float(inner[0]) - middle), min(high, float(inner[1]) + middle)
    return low, high


def round_step(span: float, most: int) -> float:
    """Return the least of 1, 2 and 5 times a power of ten that goes at most so many times into a span."""
    rough = span / most
    power = 10.0 ** floor(log10(rough))
    return next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough * (1 - 1e-9))


def _degrees(span: float, most: int) -> float:
    parts = (15.0, 30.0, 45.0, 90.0, 180.0, 360.0)
    if span / most <= parts[0] / 2:
        return round_step(span, most)
    return next((part for part in parts if span / part <= most), 360.0 * ceil(span / most / 360.0))
