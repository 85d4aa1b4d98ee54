"""Where each quantity lies among the rows of a batch's results, and views of them by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from linkanim.mechanics.formulas.arrays import Array, Floats
from linkanim.mechanics.formulas.expression import Value

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


def columns(places: Mapping[str, Place], results: Floats, shape: tuple[int, ...]) -> Mapping[str, Array]:
    """Return one kind of quantity by name: views of the results.

    A row for each component keeps every pass contiguous; (N, 2) is its transpose, not a copy.
    """
    return Lazy(places, partial(_column, places, results, shape))


def _column(places: Mapping[str, Place], results: Any, shape: tuple[int, ...], name: str) -> Any:
    place = places[name]
    if place.fixed is not None:
        return np.broadcast_to(np.array(place.fixed), (*shape, 2))
    rows = results[place.row : place.row + place.count]
    return rows[0].reshape(shape) if place.count == 1 else rows.T.reshape((*shape, 2))


def scaled(values: Mapping[str, Array], factor: float) -> Mapping[str, Array]:
    """Return the same columns, each times a factor."""
    return Lazy(values, partial(_scaled, values, factor))


def _scaled(values: Mapping[str, Array], factor: float, name: str) -> Any:
    return values[name] * factor


def read_only(found: Any) -> Any:
    """Return what was found, its arrays such that nobody can change them any more."""
    if isinstance(found, tuple):
        for part in found:
            read_only(part)
    elif isinstance(found, np.ndarray):
        found.flags.writeable = False
    return found


def components(vector: Any) -> tuple[Any, Any]:
    """Return x and y of a pair of floats, or of an array (..., 2)."""
    return vector if isinstance(vector, tuple) else (vector[..., 0], vector[..., 1])
