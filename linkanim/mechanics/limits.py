"""Limits that a dyad further down the chain puts on the input, found on the cycle.

Both ends of such a dyad move, so there is no closed form: its margin U·W is sampled over the input's
range, the zero next to the start is bracketed and bisected, and the input then swings between the
limits like any other. Next to a limit U·W itself has only half a float's digits left; there its
quotient by the way to the limit, which is smooth, is taken from a polynomial (`fitting`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError

from .assembly import Assembly, resigned
from .chain import ChainRoot, End
from .exact import Sum
from .expression import Graph
from .fitting import fitted, refined
from .linkage import Linkage
from .path import ONE_PLACE, Path, Swing
from .planar import Slope
from .program import Batch, batch
from .search import ends_of
from .touching import SAMPLES_A_TURN, TOUCHING, through_change_points
from .walk import AT_ITS_LIMIT

NEAR = 1e-3
"""A margin above this share of its greatest value at all samples has no zero between them."""
USED_UP = 1e-10
"""A margin below this share of its greatest value is one at its limit."""
NO_WAY = 1e-5
"""A swing of less than this is what rounding leaves of one place."""
STOPPED_SHORT = 1 / 64
"""Share of its range by which a swing stops short of a limit that it cannot pass."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Margins:
    """The margins of the dyads that close from moving points, over the input's range."""

    names: tuple[str, ...]
    program: Batch
    scale: Array

    def lowest(self, x: Array) -> tuple[Array, NDArray[np.intp]]:
        """Return the lowest relative margin at each place, and the first dyad that cannot be closed there.

        A dyad that stands on one that cannot be closed has no margin at all: NaN counts as none, and
        the one before it is to blame.
        """
        with np.errstate(all="ignore"):
            values = self.program(x)[: len(self.names)] / self.scale[:, None]
        values = np.where(np.isnan(values), -np.inf, values) + TOUCHING
        return values.min(axis=0), (values < 0).argmax(axis=0)

    def at_limit(self, name: str, x: Array) -> bool:
        """Tell whether a dyad is at its limit at all the places: its margin is used up."""
        row = self.names.index(name)
        with np.errstate(all="ignore"):
            values = self.program(x)[row] / self.scale[row]
        return bool((np.abs(values) <= USED_UP).all())

    def near_zero(self, x: Array) -> set[str]:
        """Return the dyads that come near a margin of nothing at one of the places, or have none there."""
        with np.errstate(all="ignore"):
            values = self.program(x)[: len(self.names)] / self.scale[:, None]
        return {name for name, low in zip(self.names, values.min(axis=1), strict=True) if not low > NEAR}

    def can_close(self, x: Array) -> bool:
        """Tell whether every dyad can be closed at all the places."""
        return bool((self.lowest(x)[0] >= 0).all())


def restricted(assembly: Assembly, linkage: Linkage) -> Assembly:
    """Return the assembly with its input's path cut back to what every dyad allows.

    `linkage` is the one asked for, with its own lengths, to be named in an AssemblyError.
    """
    margins = _margins(assembly)
    if margins is None:
        return assembly
    around = _around(assembly.path)
    closes = margins.can_close(around)
    whole = through_change_points(assembly, margins.names, margins.near_zero(around))
    if closes and (whole is assembly or _runs_through(whole)):
        return fitted(whole)
    if closes:
        # It is on the closures behind a change point that a dyad cannot be closed.
        assembly = whole
        margins = _margins(whole) or margins
    places = assembly.path.sampled(SAMPLES_A_TURN)
    values, whose = margins.lowest(places)
    if (values < 0).all():
        name = margins.names[int(whose[values.argmax()])]
        raise AssemblyError(f"joint {name}: {linkage.joint(name).why_apart()}")
    swing = assembly.path.cut(*_open_interval(assembly, places, values, margins))
    if swing.amplitude < NO_WAY:
        raise AssemblyError(f"joint {swing.ends[0]}: {ONE_PLACE}")
    for path in _smooth_paths(swing):
        limited = resigned(replace(assembly, path=path, chain={}))
        limited = replace(limited, chain=_ends(path, margins.names))
        limited = through_change_points(limited, margins.names, margins.names)
        if _runs_through(limited):
            return fitted(limited)
    raise AssemblyError("the input has no range on which every dyad can be closed")


def _ends(path: Swing, names: tuple[str, ...]) -> Mapping[str, ChainRoot]:
    """Return, for each dyad on moving points that limits the swing, where it does so."""
    found = {name: tuple(End(upper) for upper in (False, True) if path.ends[upper] == name) for name in names}
    return {name: ChainRoot(ends, 0.0) for name, ends in found.items() if ends}


def _smooth_paths(swing: Swing) -> Iterator[Swing]:
    """Yield the swing, then the same stopped short of one limit or both.

    Where one dyad stands on another, its range changes when the first passes its limit: the input
    then has to turn back before that, on the closure that was named.
    """
    short = (swing.high - swing.low).times(STOPPED_SHORT)
    for low, high in ((False, False), (True, False), (False, True), (True, True)):
        yield Swing(
            swing.low + short if low else swing.low,
            swing.high - short if high else swing.high,
            ("" if low else swing.ends[0], "" if high else swing.ends[1]),
            swing.repeats,
        )


def _runs_through(assembly: Assembly) -> bool:
    """Tell whether every dyad closes all the way, and those that limit the input do so at each visit."""
    margins, path = _margins(assembly), assembly.path
    if margins is None:
        return True
    visits = np.arange(path.periods, dtype=np.float64) * (2 * math.pi)
    return margins.can_close(_around(path)) and all(
        margins.at_limit(name, places)
        for name, places in zip(path.ends, (visits, visits + math.pi), strict=False)
        if name in margins.names
    )


def _margins(assembly: Assembly) -> _Margins | None:
    graph = Graph()
    found = assembly.walk_at(graph.input("x"), Slope(0.0)).closings
    if not found:
        return None
    margins = [closing.u * closing.w for closing in found.values()]
    program = batch({"x": True}, [*margins, *(closing.size for closing in found.values())])
    with np.errstate(all="ignore"):
        values = program(assembly.path.sampled(SAMPLES_A_TURN))
    scale, size = np.split(np.nanmax(np.abs(values), axis=1, initial=0.0), 2)
    longest = max(abs(length) for joint in assembly.linkage.joints for length in joint.lengths)
    nothing = (scale <= TOUCHING * size) | (scale <= (TOUCHING * longest) ** 2)
    for name in (name for name, flat in zip(found, nothing, strict=True) if flat):
        raise AssemblyError(f"joint {name}: {AT_ITS_LIMIT}")
    return _Margins(tuple(found), program, scale)


def _around(path: Path) -> Array:
    """Return phases over the whole true period, every closure that the path takes among them."""
    count = SAMPLES_A_TURN * path.periods
    return np.linspace(0.0, 2 * math.pi * path.periods, count, endpoint=False)


def _open_interval(
    assembly: Assembly, places: Array, values: Array, margins: _Margins
) -> tuple[tuple[Sum, str | None], tuple[Sum, str | None]]:
    """Return the ends of the interval around the start, or of the widest one where the start is shut.

    Each is its phase and the dyad that limits the input there, None where the path itself ends.
    """
    places, values, home = assembly.path.beside(assembly.linkage.drive.start, places, values)
    first, last = _run_around(values >= 0, home)
    return (
        _refined(assembly, margins, places, (first, first - 1)),
        _refined(assembly, margins, places, (last, last + 1)),
    )


def _run_around(is_open: NDArray[np.bool_], home: int) -> tuple[int, int]:
    """Return the first and last place of the open run at `home`, or of the longest run."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_open.astype(np.int8), [0]])))
    runs = list(zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True))
    for first, last in runs:
        if first <= home <= last:
            return first, last
    return max(runs, key=lambda run: run[1] - run[0])


def _refined(
    assembly: Assembly, margins: _Margins, places: Array, bracket: tuple[int, int]
) -> tuple[Sum, str | None]:
    """Return the limit between an open place and the shut one beside it, by bisection, then in all digits."""
    inside, outside = bracket
    if not 0 <= outside < len(places):
        return Sum(float(places[inside])), None
    _, whose = margins.lowest(places[outside : outside + 1])
    name = margins.names[int(whose[0])]
    row = margins.names.index(name)
    with np.errstate(all="ignore"):
        last = ends_of(lambda phase: margins.program(phase)[row] >= 0, places[[inside]], places[[outside]])
    return refined(assembly, name, float(last[0]), touching=False), name
