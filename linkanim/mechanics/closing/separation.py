"""How far every dyad on moving points is from its limits along the input's path, and where that is extreme.

A dyad closes while its separation s (L² between its ends, or how far one lies beside its line) keeps its
factors U and W from going below zero. Both change with s alone. So between two neighbouring extremes of s,
which are zeros of its rate, each factor has one zero at most, and what the dyad does at the extremes decides
whether it closes: no sample does. The extremes are bracketed by samples, which are halved wherever the
margin U·W could come to zero between them, until rate and slope leave no room for another extreme.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError
from linkanim.mechanics.closing.chain import Closing
from linkanim.mechanics.closing.fitting import extreme
from linkanim.mechanics.closing.kinds import walk_at
from linkanim.mechanics.closing.search import around, ends_of
from linkanim.mechanics.closing.walk import AT_ITS_LIMIT, Assembly
from linkanim.mechanics.drive.input_path import InputPath
from linkanim.mechanics.formulas.exact import FULL_TURN, Sum
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.program import Array, Bools, batch

TOUCHING = 1e-12
"""Share of a margin's scale within which floats cannot tell its sign."""
BARELY = 1 / 64
"""Share of its greatest value below which a margin that turns back costs what is made of it its digits."""
MOST_TOUCHING = 24
"""Extremes in a turn of the fastest crank at which floats cannot tell a margin's sign."""
ROUNDING = 2.0**-48
"""Share of the longest bar that rounded lengths make: within it bars just fall into line."""
UNEVEN = 0.1
"""How far the change of a rate may be off the one that its slopes make, where it has no sharper bend."""
FLAT = 2.0**-52
"""Share of a margin's scale by which it changes between samples that need no others between them."""
FINEST = 2.0**-40
HALVINGS = 32
AT_END = 1e-6
"""At its own limit, where the input turns back, a separation is extreme by phase: that is no touching."""


class Sampled(NamedTuple):
    """Phases (N,), and there for every dyad (4, D, N): s', s'', and over their scale U·W and U - W."""

    phases: Array
    rows: Array

    def at(self, index: NDArray[np.intp] | slice) -> Sampled:
        """Return some of them."""
        return Sampled(self.phases[index], self.rows[..., index])

    def followed(self, other: Sampled) -> Sampled:
        """Return these, then the others."""
        return Sampled(
            np.concatenate([self.phases, other.phases]), np.concatenate([self.rows, other.rows], axis=-1)
        )

    @property
    def ordered(self) -> Sampled:
        """The samples in the order of their phases, each phase once."""
        order = np.argsort(self.phases, kind="stable")
        return self.at(order[np.diff(self.phases[order], prepend=-math.inf) > 0])


@dataclass(frozen=True)
class Extreme:
    """A place where a dyad's separation is extreme and its margin next to nothing, settled in many digits.

    `closes` is +1 where the dyad closes there, -1 where it does not, 0 where its bars just fall into line.
    """

    phase: float
    place: Sum
    closes: int
    reach: float
    """How far to both sides it does not close."""


@dataclass(frozen=True)
class Separations:
    """The margins of the dyads on moving points along a path, at samples among which are all that decide."""

    scales: Mapping[str, float]
    """What the margin of each dyad is beside."""
    phases: Array
    shut: Bools
    """Of every dyad at every phase, whether it does not close there (D, N)."""
    settled: Mapping[str, tuple[Extreme, ...]]
    """Of every dyad, the extremes at which floats cannot tell its margin from nothing."""
    barely: Mapping[str, tuple[float, ...]]
    """Of every dyad, the phases of others at which it barely closes."""
    margins: Callable[[Array], Array]
    """Returns the margins over their scale at phases (D, N)."""

    @property
    def names(self) -> tuple[str, ...]:
        """The dyads, in the order of rows."""
        return tuple(self.scales)

    @property
    def closes(self) -> bool:
        """Whether every dyad closes all along."""
        return not self.shut.any()

    def beside(self, phase: float, name: str, way: int) -> Sum | None:
        """Return where a stretch about an extreme ends, on that side, in which floats see the dyad close."""
        for found in self.settled[name]:
            turns = round((phase - found.phase) / (2 * math.pi))
            if found.closes < 0 and abs(phase - found.phase - turns * 2 * math.pi) <= found.reach:
                return found.place + FULL_TURN.times(float(turns)) + Sum(way * found.reach)
        return None

    def touches(self, name: str) -> tuple[Sum, ...]:
        """Return the phases at which a dyad's bars just fall into line."""
        return tuple(found.place for found in self.settled[name] if found.closes == 0)

    def dips(self, name: str) -> tuple[Sum, ...]:
        """Return the phases at which a dyad barely closes, its separation being extreme."""
        settled = (found.place for found in self.settled[name] if found.closes > 0)
        return (*settled, *map(Sum, self.barely[name]))


def separations(assembly: Assembly) -> Separations:
    """Return how the dyads that come near their limits fare along the path, over its true period.

    AssemblyError where one is at its limit all along.
    """
    phases = _phases(assembly)
    scales = _scales(assembly, phases)
    if not scales:
        nothing = np.zeros((0, len(phases)))
        return Separations({}, phases, nothing > 0, {}, {}, lambda places: nothing[:, : len(places)])
    scale, barely = np.array([*scales.values()]).T
    found = walk_at(assembly, Graph().input("x"), Slope(1.0)).closings
    closings = {name: found[name] for name in scales}
    sampled = _sampler(closings.values(), scale)
    samples = _halved(sampled, sampled(phases))
    extremes = _places(sampled, samples, _turning(samples, barely), 0)
    peaks = _places(sampled, samples, _passing(samples), 3)
    samples = samples.followed(sampled(np.concatenate([*extremes, *peaks]))).ordered
    low = {
        name: _low(assembly, name, (places, sampled(places).rows[2, row]), barely[row])
        for row, (name, places) in enumerate(zip(closings, extremes, strict=True))
    }
    settled = {
        name: tuple(_settled(assembly, name, places[margins <= TOUCHING]))
        for name, (places, margins) in low.items()
    }
    return Separations(
        dict(zip(scales, scale.tolist(), strict=True)),
        samples.phases,
        _shut(samples, [*settled.values()]),
        settled,
        {name: tuple(places[margins > TOUCHING].tolist()) for name, (places, margins) in low.items()},
        lambda phases: np.asarray(sampled(phases).rows[2]),
    )


def _sampler(found: Collection[Closing], scale: Array) -> Callable[[Array], Sampled]:
    """Return the function of phases (N,) that gives s', s'', and over their scale U·W and U - W (4, D, N)."""
    run = _compiled(
        [
            [closing.separation.rate for closing in found],
            [closing.separation.second for closing in found],
            [closing.u * closing.w for closing in found],
            [closing.half_difference * 2.0 for closing in found],
        ]
    )

    def sampled(phases: Array) -> Sampled:
        rows = run(phases)
        with np.errstate(all="ignore"):
            rows[2:] /= scale[:, None]
        return Sampled(phases, rows)

    return sampled


def _compiled(rows: Sequence[Sequence[Value]]) -> Callable[[Array], Array]:
    """Return the function of phases (N,) that gives the values of rows of dyads (rows, D, N)."""
    program = batch({"x": True}, [value for row in rows for value in row])

    def run(phases: Array) -> Array:
        with np.errstate(all="ignore"):
            return program(phases).reshape(len(rows), len(rows[0]), len(phases))

    return run


def _phases(assembly: Assembly) -> Array:
    """Return phases over the true period, as near to each other as what turns fastest needs.

    The start is among them, and the ends of a way there and back.
    """
    marks = 0.0, math.pi, assembly.path.home(assembly.linkage.drive.start)
    return np.sort(np.concatenate([around(assembly.path.periods, assembly.samples), marks]))


def _scales(assembly: Assembly, phases: Array) -> Mapping[str, tuple[float, float]]:
    """Return what the margin of each dyad that comes near its limits is beside: its greatest, or its bars'.

    And the share of it below which the dyad barely closes. One whose margin is all along more than that, and
    than it changes between three samples at the most, keeps away from them.
    """
    closings = walk_at(assembly, Graph().input("x"), Slope(0.0)).closings
    found = closings.values()
    rows = _compiled([[one.u * one.w for one in found], [one.size for one in found]])(phases)
    margins, sizes = rows
    rows[:, _behind(margins < -TOUCHING * sizes)] = math.nan
    most, size = np.fmax.reduce(np.abs(rows), axis=2)
    nothing = (most <= TOUCHING * size) | (most <= (TOUCHING * assembly.linkage.longest) ** 2)
    for name in (name for name, flat in zip(closings, nothing, strict=True) if flat):
        raise AssemblyError(f"joint {name}: {AT_ITS_LIMIT}")
    scale = np.minimum(most, size)
    changes = np.fmax.reduce(np.abs(np.diff(margins, axis=1)), axis=1)
    # A greatest margin of bars is a quarter of their size; where it never comes near that, all are low.
    low = BARELY * np.maximum(scale, size / 4)
    near = np.fmin.reduce(margins, axis=1) <= np.maximum(3 * changes, low)
    with np.errstate(all="ignore"):
        scales = np.column_stack([scale, low / scale]).tolist()
    return {name: tuple(pair) for name, pair, comes in zip(closings, scales, near, strict=True) if comes}


def _behind(shut: Bools) -> Bools:
    """Tell of every dyad where one before it in the chain does not close: it is but rounding there (D, N)."""
    before = np.logical_or.accumulate(shut, axis=0)
    return np.concatenate([np.zeros_like(shut[:1]), before[:-1]])


def _halved(sampled: Callable[[Array], Sampled], samples: Sampled) -> Sampled:
    """Return the samples with others between them wherever a second extreme could lie there."""
    left, right, found = samples.at(slice(None, -1)), samples.at(slice(1, None)), samples
    fastest = _fastest_change(samples)[:, None] / 4
    for _ in range(HALVINGS):
        # At first a margin may change faster than at both neighbours; the nearer they are, the less.
        with np.errstate(all="ignore"):
            index = np.flatnonzero(_unclear(left, right, fastest).any(axis=0))
        if not len(index):
            break
        left, right = left.at(index), right.at(index)
        middle = sampled((left.phases + right.phases) / 2)
        found = found.followed(middle)
        left, right, fastest = left.followed(middle), middle.followed(right), fastest / 2
    return found.ordered


def _speed(samples: Sampled) -> Array:
    """Return how fast the margins change: by s' (U - W), since U' = -s' and W' = s'.

    NaN where an unbounded rate meets no difference: that is nowhere taken for slow.
    """
    rates, _, _, differences = samples.rows
    with np.errstate(invalid="ignore"):
        return np.asarray(np.abs(rates * differences))


def _fastest_change(samples: Sampled) -> Array:
    """Return how fast each margin changes at most (D,).

    A speed that is unbounded at one place, at a limit, says nothing of all the others.
    """
    speeds = _speed(samples)
    return np.asarray(np.max(speeds, axis=1, initial=0.0, where=np.isfinite(speeds)))


def _near(left: Sampled, right: Sampled, fastest: Array | float = 0.0) -> Bools:
    """Tell where a margin could be nothing between neighbours (D, N), changing so fast at least."""
    before, after = left.rows[2], right.rows[2]
    speed = np.maximum(np.maximum(_speed(left), _speed(right)), fastest)
    least = np.maximum(2 * (right.phases - left.phases) * speed, TOUCHING)
    clear = (np.minimum(np.abs(before), np.abs(after)) > least) & (before * after > 0)
    return np.asarray(np.isfinite(before + after) & ~clear & ~_behind(clear & (before < 0)))


def _unclear(left: Sampled, right: Sampled, fastest: Array) -> Bools:
    """Tell between which neighbours a margin near nothing could have two extremes (D, N).

    Where neither has a rate, at a limit of the dyad before it, floats cannot tell, nor closer by.
    """
    step = right.phases - left.phases
    (r, b, _, d), (s, c, _, e) = left.rows, right.rows
    size = np.max(np.abs([r, s, step * b, step * c]), axis=0)
    even = np.abs((s - r) - step / 2 * (b + c)) <= UNEVEN * size
    none = (r * s > 0) & (r * (r + step * b) > 0) & (s * (s - step * c) > 0)
    one = (r * s <= 0) & (b * c > 0)
    flat = size * step * np.maximum(np.abs(d), np.abs(e)) <= FLAT
    blind = ~np.isfinite(r) & ~np.isfinite(s)
    return np.asarray(_near(left, right, fastest) & ~(even & (none | one)) & ~flat & ~blind)


def _turning(samples: Sampled, barely: Array) -> Bools:
    """Tell between which neighbours a separation near a limit has its extreme (D, N - 1)."""
    positive, margins = samples.rows[0] > 0, samples.rows[2]
    low = (np.minimum(margins[:, 1:], margins[:, :-1]) > 0) & (margins[:, 1:] <= barely[:, None])
    near = _near(*_neighbours(samples)) | low
    # Between two cranks that turn alike the separation stays as it is: what changes there is rounding.
    moves = _fastest_change(samples)[:, None] > TOUCHING
    return np.asarray(near & moves & (positive[:, 1:] != positive[:, :-1]))


def _passing(samples: Sampled) -> Bools:
    """Tell between which neighbours a separation passes from one limit to the other (D, N - 1)."""
    before, after = (one.rows for one in _neighbours(samples))
    return np.asarray((before[2] < 0) & (after[2] < 0) & ((before[3] > 0) != (after[3] > 0)))


def _neighbours(samples: Sampled) -> tuple[Sampled, Sampled]:
    return samples.at(slice(None, -1)), samples.at(slice(1, None))


def _places(sampled: Callable[[Array], Sampled], samples: Sampled, cells: Bools, row: int) -> list[Array]:
    """Return for every dyad where that row of its samples changes its sign in the cells."""
    dyads, index = np.nonzero(cells)
    if not len(index):
        return [np.empty(0) for _ in cells]
    start = samples.rows[row, dyads, index] > 0

    def alike(phases: Array) -> Bools:
        values = sampled(phases.ravel()).rows[row].reshape(-1, *phases.shape)
        return np.asarray((values[dyads, :, np.arange(len(dyads))].T > 0) == start)

    found = ends_of(alike, samples.phases[index], samples.phases[index + 1], FINEST)
    return [found[dyads == dyad] for dyad in range(len(cells))]


def _low(assembly: Assembly, name: str, extremes: tuple[Array, Array], barely: float) -> tuple[Array, Array]:
    """Return of extremes, phases and margins, those at which a dyad barely closes, if it does."""
    phases, margins = extremes
    inside = [not _at_own_end(assembly.path, name, phase) for phase in phases.tolist()]
    low = (margins >= -TOUCHING) & (margins <= barely) & np.array(inside, bool)
    return phases[low], margins[low]


def _settled(assembly: Assembly, name: str, phases: Array) -> Iterator[Extreme]:
    """Yield the extremes at which floats cannot tell a dyad's margin from nothing.

    AssemblyError where there are so many that they are rounding on a stretch of nothing.
    """
    if len(phases) > MOST_TOUCHING * assembly.path.periods * assembly.quickest:
        raise AssemblyError(f"joint {name}: {AT_ITS_LIMIT}")
    for phase in phases.tolist():
        place, gap, reach = extreme(assembly, name, phase)
        closes = 0 if abs(gap) <= ROUNDING * assembly.linkage.longest else 1 if gap > 0 else -1
        yield Extreme(phase, place, closes, reach)


def _at_own_end(path: InputPath, name: str, phase: float) -> bool:
    ends = zip(path.ends, (0.0, math.pi), strict=False)
    return any(end == name and abs(math.remainder(phase - at, 2 * math.pi)) <= AT_END for end, at in ends)


def _shut(samples: Sampled, settled: Sequence[Sequence[Extreme]]) -> Bools:
    """Tell of every dyad at every sample whether it does not close there (D, N)."""
    shut = ~(samples.rows[2] >= -TOUCHING)
    for row, extremes in enumerate(settled):
        for found in extremes:
            shut[row, np.searchsorted(samples.phases, found.phase)] = found.closes < 0
    return np.asarray(shut)
