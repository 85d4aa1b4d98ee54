"""Where solved quantities lie in rows, and how they are read from there.

How far a direction turns from instant to instant is known by directions alone, not by rates, which near a
dead centre grow without bound: between two less than half a turn apart the way is known, so instants are put
between neighbours until they are near, in the input and in direction.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.program import Array

Pair = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Place:
    """The first row of a quantity and how many it has; a `fixed` pair has none."""

    row: int
    count: int
    fixed: Pair | None = None


@dataclass(frozen=True)
class ResultLayout:
    """The places of all quantities by kind and name, and the kind that each row holds."""

    places: Mapping[str, Mapping[str, Place]]
    outputs: tuple[Value, ...]
    kinds: tuple[str, ...]


def layout(
    rows: Mapping[str, Mapping[str, tuple[Value, ...]]], fixed: Mapping[str, Pair], vectors: tuple[str, ...]
) -> ResultLayout:
    """Lay the quantities out in rows, one for each component; what is fixed takes none.

    `fixed` gives where pins stand, `vectors` the kinds of quantity that pins have: their position,
    then rates, which are zero.
    """
    places: dict[str, dict[str, Place]] = {}
    outputs: list[Value] = []
    kinds: list[str] = []
    for kind, values in rows.items():
        places[kind] = {}
        for name, components in values.items():
            if kind in vectors and name in fixed:
                places[kind][name] = Place(-1, 2, fixed[name] if kind == vectors[0] else (0.0, 0.0))
                continue
            places[kind][name] = Place(len(outputs), len(components))
            outputs.extend(components)
            kinds.extend([kind] * len(components))
    return ResultLayout(places, tuple(outputs), tuple(kinds))


class Lazy(Mapping[str, Any]):
    """A mapping whose values are worked out when they are first read; nobody can change them."""

    def __init__(self, names: Iterable[str], find: Callable[[str], Any]) -> None:
        self._names, self._find = dict.fromkeys(names), find
        self._found: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._found:
            if name not in self._names:
                raise KeyError(name)
            self._found[name] = read_only(self._find(name))
        return self._found[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def columns(places: Mapping[str, Place], results: Array, shape: tuple[int, ...]) -> Mapping[str, Array]:
    """Return one kind of quantity by name: views of the results.

    A row for each component keeps every pass contiguous; (N, 2) is its transpose, not a copy.
    """

    def column(name: str) -> Any:
        place = places[name]
        if place.fixed is not None:
            return np.broadcast_to(np.array(place.fixed), (*shape, 2))
        rows = results[place.row : place.row + place.count]
        return rows[0].reshape(shape) if place.count == 1 else rows.T.reshape((*shape, 2))

    return Lazy(places, column)


def scaled(values: Mapping[str, Array], factor: float) -> Mapping[str, Array]:
    """Return the same columns, each times a factor."""
    return Lazy(values, lambda name: values[name] * factor)


def read_only(found: Any) -> Any:
    """Return what was found, its arrays such that nobody can change them any more."""
    if isinstance(found, tuple):
        for part in found:
            read_only(part)
    elif isinstance(found, np.ndarray):
        found.flags.writeable = False
    return found


_NEAR = math.pi / 2
_INPUT_STEP = math.pi / 6
_MOST_PARTS = 64
_HALVINGS = 60


def turned(
    inputs: tuple[Array, Array], angles: tuple[Array, Array], at: Callable[[Array], Array], ratio: float
) -> Array:
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
