"""Limits that a dyad further down the chain puts on the input, found on the cycle.

Both ends of such a dyad move, so there is no closed form: its margin U·W is sampled over the input's
range, the zero next to the start is bracketed and bisected, and the input then swings between the
limits like any other. Next to a limit U·W itself has only half a float's digits left; there its
quotient by the way to the limit, which is smooth, is taken from a polynomial fitted once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError

from .assembly import Assembly, resigned
from .chain import LimitFit, NearEnd
from .clock import swing_by_angle
from .expression import Graph, Value
from .linkage import Linkage
from .path import Path, Swing
from .planar import Slope
from .program import Batch, batch
from .search import ends_of
from .touching import SAMPLES_A_TURN, TOUCHING, through_change_points

if TYPE_CHECKING:
    from numpy.polynomial import Polynomial

USED_UP = 1e-10
"""A margin below this share of its greatest value is one at its limit."""
STOPPED_SHORT = 1 / 64
"""Share of its range by which a swing stops short of a limit that it cannot pass."""
DEGREE = 12
FIT_POINTS = 96
GOOD_FIT = 1e-14

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Margins:
    """The margins of the dyads that close from moving points, over the input's range."""

    names: tuple[str, ...]
    program: Batch
    scale: Array

    @property
    def scales(self) -> dict[str, float]:
        """Map each dyad to its margin's greatest value."""
        return dict(zip(self.names, self.scale.tolist(), strict=True))

    def lowest(self, x: Array) -> tuple[Array, NDArray[np.intp]]:
        """Return the lowest relative margin at each place, and the first dyad that cannot be closed there.

        A dyad that stands on one that cannot be closed has no margin at all: NaN counts as none, and
        the one before it is to blame.
        """
        with np.errstate(all="ignore"):
            values = self.program(x) / self.scale[:, None]
        values = np.where(np.isnan(values), -np.inf, values) + TOUCHING
        return values.min(axis=0), (values < 0).argmax(axis=0)

    def closed(self, name: str, x: Array) -> bool:
        """Tell whether a dyad's margin is used up at all the places."""
        with np.errstate(all="ignore"):
            values = self.program(x)[self.names.index(name)] / self.scales[name]
        return bool((np.abs(values) <= USED_UP).all())

    def all_open(self, x: Array) -> bool:
        """Tell whether every dyad can be closed at all the places."""
        return bool((self.lowest(x)[0] >= 0).all())


def restricted(assembly: Assembly, linkage: Linkage) -> Assembly:
    """Return the assembly with its input's path cut back to what every dyad allows.

    `linkage` is the one asked for, with its own lengths, to be named in an AssemblyError.
    """
    margins = _margins(assembly)
    if margins is None:
        return assembly
    if margins.all_open(_around(assembly.path)):
        return through_change_points(assembly, margins.names, margins.scales)
    places = assembly.path.sampled(SAMPLES_A_TURN)
    values, whose = margins.lowest(places)
    if (values < 0).all():
        name = margins.names[int(whose[values.argmax()])]
        raise AssemblyError(f"joint {name}: {linkage.joint(name).why_apart()}")
    found = _open_interval(assembly, places, values, margins)
    for path in _smooth_paths(assembly.path.cut(*found)):
        limited = resigned(replace(assembly, path=path))
        limited = replace(limited, fits=_fits(limited, path, margins.names))
        if _runs_through(limited, path):
            others = (name for name in margins.names if name not in limited.fits)
            return through_change_points(limited, others, margins.scales)
    raise AssemblyError("the input has no range on which every dyad can be closed")


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


def _runs_through(assembly: Assembly, path: Swing) -> bool:
    """Tell whether every dyad closes all the way, and those that limit the input do so at each visit."""
    margins = _margins(assembly)
    if margins is None:
        return True
    visits = np.arange(path.periods, dtype=np.float64) * (2 * math.pi)
    ends = zip(path.ends, (visits, visits + math.pi), strict=True)
    return margins.all_open(_around(path)) and all(
        margins.closed(name, places) for name, places in ends if name in margins.names
    )


def _margins(assembly: Assembly) -> _Margins | None:
    graph = Graph()
    found = assembly.walk_at(graph.input("x"), Slope(0.0)).margins
    names = tuple(found)
    if not names:
        return None
    program = batch({"x": True}, [found[name] for name in names])
    with np.errstate(all="ignore"):
        values = program(assembly.path.sampled(SAMPLES_A_TURN))
    scale = np.nanmax(np.abs(values), axis=1, initial=0.0)
    return _Margins(names, program, np.where(scale > 0, scale, 1.0))


def _around(path: Path) -> Array:
    """Return phases over the whole true period, every closure that the path takes among them."""
    count = SAMPLES_A_TURN * path.periods
    return np.linspace(0.0, 2 * math.pi * path.periods, count, endpoint=False)


def _open_interval(
    assembly: Assembly, places: Array, values: Array, margins: _Margins
) -> tuple[tuple[float, str | None], tuple[float, str | None]]:
    """Return the ends of the interval around the start, or of the widest one where the start is shut.

    Each is its phase and the dyad that limits the input there, None where the path itself ends.
    """
    places, values, home = assembly.path.beside(assembly.linkage.drive.start, places, values)
    first, last = _run_around(values >= 0, home)
    return (
        _refined(margins, places, first, first - 1),
        _refined(margins, places, last, last + 1),
    )


def _run_around(is_open: NDArray[np.bool_], home: int) -> tuple[int, int]:
    """Return the first and last place of the open run at `home`, or of the longest run."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_open.astype(np.int8), [0]])))
    runs = list(zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True))
    for first, last in runs:
        if first <= home <= last:
            return first, last
    return max(runs, key=lambda run: run[1] - run[0])


def _refined(margins: _Margins, places: Array, inside: int, outside: int) -> tuple[float, str | None]:
    """Return the limit between an open place and the shut one beside it, by bisection."""
    if not 0 <= outside < len(places):
        return float(places[inside]), None
    _, whose = margins.lowest(places[outside : outside + 1])
    name = margins.names[int(whose[0])]
    row = margins.names.index(name)
    with np.errstate(all="ignore"):
        last = ends_of(lambda phase: margins.program(phase)[row] >= 0, places[[inside]], places[[outside]])
    return float(last[0]), name


def _fits(assembly: Assembly, path: Swing, names: tuple[str, ...]) -> Mapping[str, LimitFit]:
    """Return, for each dyad that limits the swing, its margin's smooth part next to its limits."""
    return {
        name: LimitFit(
            _near_end(assembly, path, name, upper=True) if path.ends[1] == name else None,
            _near_end(assembly, path, name, upper=False) if path.ends[0] == name else None,
        )
        for name in names
        if name in path.ends
    }


def _near_end(assembly: Assembly, path: Swing, name: str, *, upper: bool) -> NearEnd:
    """Fit the margin over the way to the limit, on the widest stretch where a polynomial holds it."""
    both = path.ends == (name, name)
    margin = _margin_by_way(assembly, path, name, upper=upper)
    noise = GOOD_FIT * np.nanmax(np.abs(margin(np.linspace(0, path.amplitude, FIT_POINTS))))
    width = path.amplitude / 8
    while True:
        ways = width * (1 - np.cos(np.linspace(0.02, math.pi, FIT_POINTS))) / 2
        values = margin(ways)
        weights = ways * (path.amplitude - ways) if both else ways
        fitted = _weighted_fit(ways / width, values, weights)
        error = np.abs(fitted(ways / width) * weights - values).max()
        if error <= noise or width < path.amplitude * 1e-4:
            return NearEnd(width, tuple(float(c) for c in fitted.coef))
        width /= 2


def _weighted_fit(x: Array, values: Array, weights: Array) -> Polynomial:
    """Return the polynomial p on [0, 1] for which weights × p comes nearest the values."""
    # Here, because it costs as much to import as a linkage without such a limit costs to load.
    from numpy.polynomial import Chebyshev, Polynomial
    from numpy.polynomial.chebyshev import chebvander

    columns = chebvander(2 * x - 1, DEGREE) * weights[:, None]
    coefficients = np.linalg.lstsq(columns, values, rcond=None)[0]
    found = Chebyshev(coefficients, domain=[0.0, 1.0]).convert(kind=Polynomial, domain=[-1, 1])
    assert isinstance(found, Polynomial)
    return found


def _margin_by_way(assembly: Assembly, path: Swing, name: str, *, upper: bool) -> Callable[[Array], Array]:
    """Return the margin as a function of half the way to a limit."""
    graph = Graph()
    u, v = graph.input("u"), graph.input("v")
    value: Value = assembly.walk(swing_by_angle(v - u, u, v, Slope(0.0), path.middle)).margins[name]
    program = batch({"u": True, "v": True}, [value])

    def margin(way: Array) -> Array:
        other = path.amplitude - way
        with np.errstate(all="ignore"):
            return np.asarray(program(*((way, other) if upper else (other, way)))[0], dtype=np.float64)

    return margin
