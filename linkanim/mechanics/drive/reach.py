"""How far given angles are from the limits of a swing, to the last digit at any number of turns."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.formulas.exact import FULL_TURN, Sum, two_product, two_sum

Array = NDArray[np.float64]

NEARLY_ZERO = 1e-8
"""Half a last digit of this is more than a limit is off by."""


@dataclass(frozen=True)
class WaysLeft:
    """Angles from the middle of a swing, half the ways to its limits, which lie outside or are a limit."""

    angle: Array
    u: Array
    v: Array
    outside: NDArray[np.bool_]
    at_limit: NDArray[np.bool_]

    @property
    def snapped(self) -> tuple[Array, Array]:
        """The ways, with the nearer one zero for angles that are a limit."""
        u, v = (np.where(self.at_limit & (way <= other), 0.0, way) for way, other in self._pairs)
        return u, v

    @property
    def _pairs(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        return (self.u, self.v), (self.v, self.u)


@np.errstate(all="ignore")
def reach(angle: Array, swing: tuple[Sum, Sum, Sum], repeats: int) -> WaysLeft:
    """Return how far angles are from a swing's low end, middle and high end, whole turns aside.

    After `repeats` turns of the input the linkage is the same; they are taken off without rounding.
    The float nearest a limit is the limit as well as a float can say it: it is never outside, nor is 0 where
    a limit is what its own last digits leave of 0.
    """
    low_end, middle, high_end = swing
    turns = repeats * np.rint((angle - float(middle)) / (2 * math.pi * repeats))
    whole, lost = two_product(-turns, FULL_TURN.high)
    high, error = two_sum(angle, whole)
    low = error + lost - turns * FULL_TURN.low
    v, u = _way(high, low, low_end, 1.0), _way(high, low, high_end, -1.0)
    nearest = np.spacing(np.maximum(np.abs(angle), NEARLY_ZERO)) / 2
    at_limit = (np.abs(u) <= nearest) | (np.abs(v) <= nearest)
    outside = ~((np.minimum(u, v) >= 0) | at_limit)
    return WaysLeft(
        _way(high, low, middle, 1.0), np.maximum(u, 0.0) / 2, np.maximum(v, 0.0) / 2, outside, at_limit
    )


def _way(high: Array, low: Array, limit: Sum, sign: float) -> Array:
    """Return sign × (angle - limit), both sums of two floats."""
    total, error = two_sum(high, -limit.high)
    way: Array = sign * (total + (error + (low - limit.low)))
    return way
