"""How far a direction turns from instant to instant, by directions alone, without their rates.

Between two directions less than half a turn apart the way is known. So instants are put between neighbours
until they are near, in the input and in direction; rates would do with fewer, but near a dead centre they
grow without bound.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from linkanim.mechanics.formulas.arrays import Array

Pair = tuple[Array, Array]

_NEAR = math.pi / 2
_INPUT_STEP = math.pi / 6
_MOST_PARTS = 64
_HALVINGS = 60


def turned(inputs: Pair, angles: Pair, at: Callable[[Array], Array], ratio: float) -> Array:
    """Return how far a direction turns on each of N ways from one instant to another, in radians (N,).

    `inputs` are those of the two instants, `angles` the direction's there in any turn; `at` gives them at
    other inputs; `ratio` is how many times as fast as the input the quickest crank turns. 0 where an angle
    is NaN.
    """
    (low, high), (first, last) = inputs, angles
    row, total = np.arange(len(low)), np.zeros(len(low))
    near = np.maximum(_INPUT_STEP / ratio, np.abs(high - low) / _MOST_PARTS)
    for halving in range(_HALVINGS):
        step = _shortest(last - first)
        wide = (np.abs(step) > _NEAR) | (np.abs(high - low) > near[row])
        wide &= np.isfinite(step) & (halving < _HALVINGS - 1)
        between = (low + high) / 2
        middle = np.full_like(between, np.nan)
        middle[wide] = at(between[wide]) if wide.any() else []
        wide &= np.isfinite(middle)
        np.add.at(total, row[~wide], np.nan_to_num(step[~wide]))
        if not wide.any():
            break
        low, between, high = low[wide], between[wide], high[wide]
        first, middle, last, row = first[wide], middle[wide], last[wide], np.tile(row[wide], 2)
        low, high = np.concatenate([low, between]), np.concatenate([between, high])
        first, last = np.concatenate([first, middle]), np.concatenate([middle, last])
    return total


def _shortest(turn: Array) -> Array:
    """Return an angle less whole turns, at most half a turn either way."""
    shortest: Array = turn - math.tau * np.rint(turn / math.tau)
    return shortest
