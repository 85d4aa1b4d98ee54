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

Indices = NDArray[np.intp]

SAMPLES_A_TURN, SAMPLES_A_GEARED_TURN = 1440, 96
"""Phases at which each drive period is looked at, and the least number for a turn of any crank."""
BLOCK, AT_ONCE = 1024, 1 << 16
"""Places worked out at a time where a function has many rows, and where it has few."""

FINEST = 2.0**-70
"""Share of the largest place below which a bracket is not halved further: a place may be zero itself."""

_ROUNDS = 5
_AHEAD = 64
"""Places that are worked out in a call where there are fewer brackets than that."""
_DEEPEST = 6
"""The most halvings that are prepared in one call."""


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
    place: float,
    reach: float,
    ends: tuple[float, float] = (-math.inf, math.inf),
) -> float:
    """Return where a function is highest within `reach` of a place and between `ends`; NaN counts as least.

    The place is right to some 1e-6 of the reach, the function's value to about the square of that.
    """
    for _ in range(_ROUNDS):
        near = np.clip(place + reach * np.linspace(-1, 1, 21), *ends)
        values = function(near)
        place, reach = float(near[np.where(np.isfinite(values), values, -np.inf).argmax()]), reach / 10
    return place


def ends_of(
    holds: Callable[[Array], Bools],
    inside: Array,
    outside: Array,
    share: float = FINEST,
    *,
    ahead: int = _AHEAD,
) -> Array:
    """Return the last places (N,) at which a condition holds, between places where it does and does not.

    `holds` takes places (M, N), M in each of the N brackets, and returns whether the condition holds at each.
    No bracket is halved below that `share` of its places. With few brackets, all places that several halvings
    may reach are asked for in one call, `ahead` of them at the most: a call costs more than a place.
    """
    finest, each = share * np.maximum(np.abs(inside), np.abs(outside)), np.arange(len(inside))
    deep = min(max(int(math.log2(ahead / max(len(inside), 1) + 1)), 1), _DEEPEST)
    while True:
        middles, halves = _halvings(inside, outside, deep)
        held, at = holds(middles), np.zeros(len(inside), np.intp)
        size = np.maximum(np.abs(inside), np.abs(outside))
        least = np.maximum(finest, 4 * np.spacing(size)) * 2.0 ** (deep + 1)
        if (np.abs(outside - inside) > least).any():  # so that the search does not end with one of these
            for level in range(deep):
                at = 2 * at + ~held[(1 << level) - 1 + at, each]
            inside, outside = halves[0][at, each], halves[1][at, each]
            continue
        for level in range(deep):
            place = (1 << level) - 1 + at
            middle, good = middles[place, each], held[place, each]
            if ((middle == inside) | (middle == outside) | (np.abs(outside - inside) <= finest)).all():
                return inside
            inside, outside = np.where(good, middle, inside), np.where(good, outside, middle)
            at = 2 * at + ~good


def _halvings(inside: Array, outside: Array, deep: int) -> tuple[Array, tuple[Array, Array]]:
    """Return the middles of `deep` halvings, one row for each outcome of the halvings before, and all halves.

    A half where the condition holds in the middle comes before the one where it does not.
    """
    middles, halves = np.empty(((1 << deep) - 1, len(inside))), (inside[np.newaxis], outside[np.newaxis])
    for level in range(deep):
        here = middles[(1 << level) - 1 : (2 << level) - 1]
        np.divide(np.add(*halves, out=here), 2, out=here)
        halves = _in_turn(here, halves[0]), _in_turn(halves[1], here)
    return middles, halves


def _in_turn(first: Array, second: Array) -> Array:
    """Return rows of both, in turn."""
    rows = np.empty((2 * len(first), first.shape[1]))
    rows[::2], rows[1::2] = first, second
    return rows


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
        values = own_rows(function, np.tile(rows, len(middles)), middles.ravel()).reshape(middles.shape)
        return np.asarray((values > 0) == start)

    return rows, ends_of(alike, places[index], places[index + 1], share)


def own_rows(function: Callable[[Array], Array], rows: Indices, places: Array) -> Array:
    """Return the value of one row of a function at each place, a block of places at a time."""
    found = np.empty(len(places))
    for first in range(0, len(places), BLOCK):
        part = slice(first, first + BLOCK)
        values = function(places[part])
        found[part] = values[rows[part], np.arange(values.shape[1])]
    return found


def _brackets(function: Callable[[Array], Array], places: Array) -> tuple[Indices, Indices, Bools]:
    """Return the row and the place before each change of sign, and whether the row is positive there."""
    found: list[tuple[Indices, Indices, Bools]] = []
    for first in range(0, max(len(places) - 1, 1), BLOCK):
        values = function(places[first : first + BLOCK + 1])
        positive, known = values > 0, ~np.isnan(values)
        rows, index = np.nonzero((positive[:, :-1] != positive[:, 1:]) & known[:, :-1] & known[:, 1:])
        found.append((rows, index + first, positive[rows, index]))
    rows, index, start = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return rows, index, start
