"""One search for places: where a condition ends, where a function changes its sign, and where it is highest.

Bisection, on many brackets at once: it needs no derivative, cannot leave its bracket, and ends at
neighbouring floats. The highest place is sampled ever closer.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.program import Array, Bools
from linkanim.mechanics.tolerances import FINEST

Indices = NDArray[np.intp]

SAMPLES_A_TURN, SAMPLES_A_GEARED_TURN = 1440, 96
"""Phases at which each drive period is looked at, and the least number for a turn of any crank."""
BLOCK, AT_ONCE = 1024, 1 << 16
"""Places worked out at a time where a function has many rows, and where it has few."""

_ROUNDS = 5


def samples_a_turn(quickest: float) -> int:
    """Return at how many phases of a drive period to look where a crank turns `quickest` times in it."""
    return max(SAMPLES_A_TURN, math.ceil(SAMPLES_A_GEARED_TURN * quickest))


def in_blocks(places: Array) -> list[Array]:
    """Return places in parts that are small enough to be worked out one at a time."""
    return np.array_split(places, max(math.ceil(len(places) / AT_ONCE), 1))


def around(turns: int, samples_a_turn: int) -> Array:
    """Return phases once around, half a step off the start, where every rate of a swing vanishes."""
    step = 2 * math.pi / samples_a_turn
    return step * (np.arange(turns * samples_a_turn + 1, dtype=np.float64) - 0.5)


def highest(
    function: Callable[[Array], Array],
    peak: float,
    reach: float,
    ends: tuple[float, float] = (-math.inf, math.inf),
) -> float:
    """Return where a function is highest within `reach` of a place and between `ends`; NaN counts as least.

    The place is right to some 1e-6 of the reach, the function's value to about the square of that.
    """
    for _ in range(_ROUNDS):
        near = np.clip(peak + reach * np.linspace(-1, 1, 21), *ends)
        values = function(near)
        peak, reach = float(near[np.where(np.isfinite(values), values, -np.inf).argmax()]), reach / 10
    return peak


def ends_of(holds: Callable[[Array], Bools], inside: Array, outside: Array, share: float = FINEST) -> Array:
    """Return the last places (N,) at which a condition holds, between places where it does and does not.

    `holds` tells of one place in each bracket, (N,), whether the condition holds there. No bracket is halved
    below that `share` of its places.
    """
    finest = share * np.maximum(np.abs(inside), np.abs(outside))
    while True:
        middle = (inside + outside) / 2
        if ((middle == inside) | (middle == outside) | (np.abs(outside - inside) <= finest)).all():
            return inside
        good = holds(middle)
        inside, outside = np.where(good, middle, inside), np.where(good, outside, middle)


def sign_changes(function: Callable[[Array], Array], places: Array, share: float = FINEST) -> Array:
    """Return where a function changes its sign between neighbouring places; none where it is NaN there.

    Each is found to that `share` of its place.
    """
    return changes_by_row(lambda x: function(x)[np.newaxis], places, share)[1]


def changes_by_row(
    function: Callable[[Array], Array], places: Array, share: float = FINEST
) -> tuple[Indices, Array]:
    """Return where each row of a function changes its sign: the row, and the place, of every change.

    The function gives (rows, N) for places (N,). All brackets of all rows are halved together, and only a
    block of places is worked out at a time: so both time and memory go with the rows.
    """
    rows, index, start = _brackets(function, places)

    def alike(middles: Array) -> Bools:
        return np.asarray((own_rows(function, rows, middles) > 0) == start)

    return rows, ends_of(alike, places[index], places[index + 1], share)


def own_rows(function: Callable[[Array], Array], rows: Indices, places: Array) -> Array:
    """Return the value of one row of a function at each place, a block of places at a time."""
    own = np.empty(len(places))
    for first in range(0, len(places), BLOCK):
        part = slice(first, first + BLOCK)
        values = function(places[part])
        own[part] = values[rows[part], np.arange(values.shape[1])]
    return own


def _brackets(function: Callable[[Array], Array], places: Array) -> tuple[Indices, Indices, Bools]:
    """Return the row and the place before each change of sign, and whether the row is positive there."""
    brackets: list[tuple[Indices, Indices, Bools]] = []
    for first in range(0, max(len(places) - 1, 1), BLOCK):
        values = function(places[first : first + BLOCK + 1])
        positive, known = values > 0, ~np.isnan(values)
        rows, index = np.nonzero((positive[:, :-1] != positive[:, 1:]) & known[:, :-1] & known[:, 1:])
        brackets.append((rows, index + first, positive[rows, index]))
    rows, index, start = (np.concatenate(parts) for parts in zip(*brackets, strict=True))
    return rows, index, start
