"""Where each quantity lies among the rows of a batch's results, and views of them by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.formulas.expression import Value

Array = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]
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


class Columns(Mapping[str, Array]):
    """One kind of quantity by name: read-only views of the results, made when they are read.

    A row for each component keeps every pass contiguous; (N, 2) is its transpose, not a copy.
    """

    __slots__ = ("_places", "_results", "_shape")

    def __init__(self, places: Mapping[str, Place], results: Floats, shape: tuple[int, ...]) -> None:
        self._places, self._results, self._shape = places, results, shape

    def __getitem__(self, name: str) -> Array:
        place, shape = self._places[name], self._shape
        if place.fixed is not None:
            return np.broadcast_to(np.array(place.fixed), (*shape, 2))
        rows: Any = self._results[place.row : place.row + place.count]
        values: Array = rows[0].reshape(shape) if place.count == 1 else rows.T.reshape((*shape, 2))
        return values

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)


class Scaled(Mapping[str, Array]):
    """The same columns, each times a factor."""

    __slots__ = ("_columns", "_factor")

    def __init__(self, columns: Mapping[str, Array], factor: float) -> None:
        self._columns, self._factor = columns, factor

    def __getitem__(self, name: str) -> Array:
        scaled: Array = self._columns[name] * self._factor
        scaled.flags.writeable = False
        return scaled

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)


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
