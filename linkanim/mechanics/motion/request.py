"""What a motion is to hold, and how its quantities are worked out when they are first read.

Quantities stand in families: joints, centres of mass, bodies that turn, bodies that slide. One that is read
brings those of its family with fewer derivatives along, from one pass over the instants.

How far a direction turns from instant to instant is known by directions alone, not by rates, which near a
dead centre grow without bound: between two less than half a turn apart the way is known, so instants are put
between neighbours until they are near, in the input and in direction.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.drive.input_path import InputPath, LimitDistances
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.program import Array, Batch, Floats
from linkanim.mechanics.motion.measures import DERIVATIVE_OF, FAMILIES, between, direction

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


POSITION = ("position",)
COORDINATE = ("coordinate", "coordinate_rate", "coordinate_second")
"""The input's angle, or travel, and its rates: one that does not turn fully moves in its own way."""
LOWER = {kind: family[:n] for family in FAMILIES for n, kind in enumerate(family)}
"""The quantities of its family with fewer derivatives, of each."""
ORDER: Mapping[str, int] = {**DERIVATIVE_OF, **dict(zip(COORDINATE, range(3), strict=True)), "phase": 0}


class Variant(NamedTuple):
    """One way of asking: by phase or by angle, whether the input accelerates, each instant on its own.

    `per_input`: at phases, with rates by the input's angle, or travel, instead of those in time.
    """

    by_phase: bool
    accelerates: bool
    varying_rate: bool = False
    per_input: bool = False


class Programs(NamedTuple):
    """The programs over arrays for one way of asking, compiled when first needed."""

    path: InputPath
    variant: Variant
    compiled: Callable[[tuple[str, ...]], tuple[Batch, ResultLayout]]
    found: dict[tuple[str, ...], tuple[Batch, ResultLayout]]

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle without what is compiled."""
        return Programs, (self.path, self.variant, self.compiled, {})

    def of(self, kinds: tuple[str, ...]) -> tuple[Batch, ResultLayout]:
        """Return the program that works these quantities out, and where its results lie."""
        found = self.found.get(kinds)
        if found is None:
            found = self.found[kinds] = self.compiled(kinds)
        return found


class Request(NamedTuple):
    """Instants (N,) with rates w and a, the shape in which to answer, and how many derivatives at most.

    `distances` are those of angles of an input that swings from its limits; `phases` those of one that comes
    back by the way it came, where x are the phases of its way up.
    """

    programs: Programs
    x: Array
    distances: LimitDistances | None
    rates: tuple[Any, Any]
    shape: tuple[int, ...]
    derivatives: int
    phases: Array | None = None

    def read(self, name: str, known: Collection[str]) -> dict[str, Any]:
        """Return a quantity with what comes out of the same pass, but for what is known."""
        if name not in DERIVATIVE_OF:
            return self._input()
        if DERIVATIVE_OF[name] > self.derivatives:
            return {name: {}}
        return self.worked_out((*[kind for kind in LOWER[name] if kind not in known], name))

    def every(self) -> dict[str, Any]:
        """Return all quantities from one pass."""
        kinds = [kind for family in FAMILIES for kind in family]
        found: dict[str, Any] = {kind: {} for kind in kinds}
        return found | self.worked_out(
            tuple(kind for kind in kinds if DERIVATIVE_OF[kind] <= self.derivatives)
        )

    def worked_out(self, kinds: tuple[str, ...]) -> dict[str, Any]:
        """Return these quantities."""
        places, results = self._run(kinds)
        results.setflags(write=False)
        return {kind: columns(names, results, self.shape) for kind, names in places.places.items()}

    def turned(self, angles: Array, ends: tuple[str, str], ratio: float) -> Array:
        """Return how far the way from one joint to another turns from row to row of its angles."""
        x = self.x.reshape(self.shape)
        rows = [(values[:-1].reshape(-1), values[1:].reshape(-1)) for values in (x, angles)]
        found = turned(rows[0], rows[1], lambda x: self._direction(x, ends), ratio)
        return found.reshape(angles[1:].shape)

    def _direction(self, x: Array, ends: tuple[str, str]) -> Array:
        """Return the direction of one joint to another at other instants."""
        distances = self.distances and self.programs.path.distances(x)
        w, a = (np.ones_like(x) if isinstance(rate, np.ndarray) else rate for rate in self.rates)
        request = self._replace(x=x, distances=distances, rates=(w, a), shape=x.shape)
        return np.asarray(direction(between(request.worked_out(POSITION)["position"], ends)))

    def _run(self, kinds: tuple[str, ...]) -> tuple[ResultLayout, Floats]:
        program, places = self.programs.of(kinds)
        rates = self.rates if self.programs.variant.accelerates else self.rates[:1]
        ways = self.distances
        with np.errstate(all="ignore"):
            if ways is None:
                return places, program(self.x, *rates)
            results = program(*self.programs.path.solved_from(ways), *rates)
            results[:, ways.outside] = np.nan
            if ways.at_limit.any() and any(map(DERIVATIVE_OF.__getitem__, kinds)):
                snapped = program(*self.programs.path.solved_from(ways.snapped), *rates)
                _mark_limits(places, results, snapped, ways.at_limit)
        return places, results

    def _input(self) -> dict[str, Any]:
        """Return the phase, and the input's coordinate with its two rates."""
        x, path, names = self.x.reshape(self.shape), self.programs.path, ("phase", *COORDINATE)
        rates = [shaped(rate, self.shape) for rate in self.rates]
        if not self.programs.variant.by_phase:
            with np.errstate(all="ignore"):
                return dict(zip(names, (read_only(path.phases(x, self.distances)), x, *rates), strict=True))
        if path.full_turn:
            return dict(zip(names, (x, read_only(path.coordinates(x)), *rates), strict=True))
        places, results = self._run(COORDINATE)
        results.setflags(write=False)
        shown = x if self.phases is None else self.phases.reshape(self.shape)
        return {"phase": shown} | {
            kind: row.reshape(self.shape) for kind, row in zip(places.kinds, results, strict=True)
        }


def shaped(rate: Any, shape: tuple[int, ...]) -> Any:
    """Return a rate in a shape: arrays have it, one number holds for all."""
    return rate.reshape(shape) if isinstance(rate, np.ndarray) else rate


def _mark_limits(places: ResultLayout, results: Floats, snapped: Floats, at_limit: NDArray[np.bool_]) -> None:
    """Give rates the values they have at the limit itself: infinite where they are unbounded."""
    for row, kind in enumerate(places.kinds):
        if DERIVATIVE_OF[kind]:
            values = snapped[row, at_limit]
            results[row, at_limit] = np.where(np.isnan(values), np.inf, values)
