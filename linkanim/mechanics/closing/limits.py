"""Limits and change points of dyads further down the chain, found on the cycle.

Both ends of such a dyad move, so there is no closed form: where it closes follows from its separation's
extremes (`separation`). The zero of its margin U·W next to the start is bracketed and bisected, and the input
then swings between the limits like any other. Next to a limit U·W itself has only half a float's digits
left; there its quotient by the way to the limit, which is smooth, is taken from a polynomial (`fitting`).

At a change point the margin touches zero without crossing it, as the dyad's bars fall into one line for an
instant; what drives the dyad is at an extreme there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError
from linkanim.mechanics.closing.assemble import JUST_AFTER, most_turns, resigned
from linkanim.mechanics.closing.chain import ChainRoot, Dip, End, Touch
from linkanim.mechanics.closing.fitting import fitted, refined
from linkanim.mechanics.closing.kinds import walk_at
from linkanim.mechanics.closing.search import ends_of
from linkanim.mechanics.closing.separation import Separations, separations
from linkanim.mechanics.closing.walk import Assembly
from linkanim.mechanics.drive.input_path import Limit
from linkanim.mechanics.drive.ranges import ONE_PLACE
from linkanim.mechanics.drive.swing import Swing
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Graph
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.program import Array, batch
from linkanim.mechanics.linkage.linkage import Linkage

USED_UP = 1e-10
"""A margin below this share of its greatest value is one at its limit."""
NO_WAY = 1e-5
"""A swing of less than this is what rounding leaves of one place."""
NO_RANGE = "the input has no range on which every dyad can be closed"
STOPPED_SHORT = 1 / 64
"""Share of its range by which a swing stops short of a limit that it cannot pass."""
CUTS = 8
"""A dyad may show where it does not close only when the one before it no longer leaves its own range."""


def stopped(assembly: Assembly, linkage: Linkage, found: Separations) -> Assembly:
    """Return the assembly on the path that its dyads leave to its input.

    It says how far the input goes; nothing can be solved on it. Arguments and errors are `restricted`'s.
    """
    return assembly if found.closes else _cut_back(assembly, linkage, found)


def restricted(assembly: Assembly, linkage: Linkage, found: Separations) -> Assembly:
    """Return the assembly with its input's path cut back to what every dyad allows.

    `linkage` is the one that was given, with its own lengths, to be named in an AssemblyError; `found` is how
    the dyads on moving points fare.
    """
    if not found.names:
        return assembly
    closes = found.closes
    whole, on_whole = through_change_points(assembly, found)
    if closes and (whole is assembly or _runs_through(whole, on_whole)):
        return fitted(whole)
    if closes:
        # It is on the closures behind a change point that a dyad cannot be closed.
        assembly, found = whole, on_whole
    return fitted(_cut_back(assembly, linkage, found))


def _cut_back(assembly: Assembly, linkage: Linkage, found: Separations) -> Assembly:
    """Return the assembly on the widest swing that every dyad lets the input run through, there and back."""
    swing, limited, on_limited = _cut(assembly, linkage, found)
    refusal = AssemblyError(NO_RANGE)
    for path in _smooth_paths(swing):
        try:
            if path is not swing:
                limited, on_limited = _limited(assembly, path)
            limited, on_limited = through_change_points(limited, on_limited)
        except AssemblyError as error:  # behind one limit a dyad may rest at its own
            refusal = error
            continue
        if _runs_through(limited, on_limited):
            return limited
    raise refusal


def _cut(assembly: Assembly, linkage: Linkage, found: Separations) -> tuple[Swing, Assembly, Separations]:
    """Return the swing around the start on which every dyad closes on the way up, and how they fare on it."""
    first = found.shut.argmax(axis=0)
    if found.shut.any(axis=0).all():
        name = found.names[int(first.max())]
        most = _most(assembly, name, found.phases)
        raise AssemblyError(f"joint {name}: {linkage.joint(name).why_apart(*most, linkage.unit)}")
    on_swing, limited = found, assembly
    for _ in range(CUTS):
        swing = Swing(*limited.path.cut(*_open_interval(limited, on_swing)))
        if swing.amplitude < NO_WAY:
            raise AssemblyError(f"joint {swing.ends[0]}: {ONE_PLACE}")
        limited, on_swing = _limited(assembly, swing)
        up = (on_swing.phases > 0) & (on_swing.phases < math.pi)  # at its ends rounding alone decides
        if not on_swing.shut[:, up].any():
            break
    return swing, limited, on_swing


def _limited(assembly: Assembly, path: Swing) -> tuple[Assembly, Separations]:
    """Return the assembly on another path, its closures named anew, and how its dyads fare there."""
    dyads = [name for name in dict.fromkeys(path.ends) if name and name not in assembly.loops]
    ends = {name: tuple(End(upper) for upper in (False, True) if path.ends[upper] == name) for name in dyads}
    chain = {name: ChainRoot(ends[name], 0.0) for name in dyads}
    limited = replace(resigned(replace(assembly, path=path, chain={})), chain=chain)
    return limited, separations(limited)


def _most(assembly: Assembly, name: str, phases: Array) -> tuple[float, float]:
    """Return the greatest that the factors U and W of a dyad come to, in squares of the scene's unit."""
    closing = walk_at(assembly, Graph().input("x"), Slope(0.0)).closings[name]
    with np.errstate(all="ignore"):
        u, w = (float(np.nanmax(values)) for values in batch({"x": True}, [closing.u, closing.w])(phases))
    return u * assembly.unscale**2, w * assembly.unscale**2


def _smooth_paths(swing: Swing) -> Iterator[Swing]:
    """Yield the swing, then the same stopped short of one limit or both.

    Where one dyad stands on another, its range changes when the first passes its limit: the input
    then has to turn back before that, on the closure that was named.
    """
    yield swing
    short = (swing.high - swing.low).times(STOPPED_SHORT)
    for low, high in ((True, False), (False, True), (True, True)):
        yield Swing(
            swing.low + short if low else swing.low,
            swing.high - short if high else swing.high,
            ("" if low else swing.ends[0], "" if high else swing.ends[1]),
            swing.repeats,
        )


def _runs_through(assembly: Assembly, found: Separations) -> bool:
    """Tell whether every dyad closes all the way, and those that limit the input do so at each visit."""
    path = assembly.path
    visits = np.arange(path.periods, dtype=np.float64) * (2 * math.pi)
    return found.closes and all(
        bool((np.abs(found.margins(places)[found.names.index(name)]) <= USED_UP).all())
        for name, places in zip(path.ends, (visits, visits + math.pi), strict=False)
        if name in found.names
    )


def _open_interval(assembly: Assembly, found: Separations) -> tuple[Limit, Limit]:
    """Return the ends of the interval around the start, or of the widest one where the start is shut."""
    phases, shut, home = assembly.path.beside(assembly.linkage.drive.start, found.phases, found.shut)
    is_open = np.asarray(~shut.any(axis=0))
    if not is_open.any():  # cut back for one dyad, nothing is left to another
        raise AssemblyError(NO_RANGE)
    first, last = _run_around(is_open, home, phases)
    below, above = (
        _limit(assembly, found, (phases[inside], phases[outside]), shut[:, outside])
        if 0 <= outside < len(phases)
        else (Sum(float(phases[inside])), None)
        for inside, outside in ((first, first - 1), (last, last + 1))
    )
    return below, above


def _run_around(is_open: NDArray[np.bool_], home: int, phases: Array) -> tuple[int, int]:
    """Return the first and last place of the open run at `home`, or of the widest run."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_open.astype(np.int8), [0]])))
    runs = list(zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True))
    for first, last in runs:
        if first <= home <= last:
            return first, last
    return max(runs, key=lambda run: float(phases[run[1]] - phases[run[0]]))


def _limit(
    assembly: Assembly, found: Separations, bracket: tuple[float, float], shut: NDArray[np.bool_]
) -> tuple[Sum, str]:
    """Return the limit between an open phase and the shut one beside it, by bisection, then in all digits."""
    row = _first_shut(shut, found.margins(np.array(bracket[1:]))[:, 0])
    start = found.beside(bracket[1], found.names[row], 1 if bracket[0] > bracket[1] else -1)
    if start is None:
        inside, outside = (np.array([phase]) for phase in bracket)
        limit = ends_of(lambda phases: found.margins(phases[:, 0])[row, :, None] >= 0, inside, outside)
        start = Sum(float(limit[0]))
    name = found.names[row]
    return refined(assembly, name, start), name


def _first_shut(shut: NDArray[np.bool_], margins: Array) -> int:
    """Return the first dyad of the chain that does not close at a phase.

    One whose margin is no number stands on another that does not close, if only by rounding.
    """
    row = int(shut.argmax())
    before = np.flatnonzero(margins[:row] < 0)
    return int(before[0]) if math.isnan(margins[row]) and len(before) else row


LEAST = 1e-40
"""Share of a margin's scale below which it has no digits left."""


def through_change_points(assembly: Assembly, found: Separations) -> tuple[Assembly, Separations]:
    """Return the assembly with the zeros of the dyads on moving points, and how they fare on it.

    In the chain's order: where one passes onto its other closure, what stands on it goes another way, and
    may no longer come near its limits.
    """
    names = found.names
    for name in names:
        if name not in found.names:
            continue
        through = _through(assembly, name, found)
        if found.touches(name):
            found = separations(through)
        assembly = through
    return assembly, found


def _through(assembly: Assembly, name: str, found: Separations) -> Assembly:
    """Return the assembly with one dyad's zeros: its limits, which are known, its change points and dips."""
    path, known = assembly.path, assembly.chain.get(name, ChainRoot((), 0.0))
    touches = tuple(Touch(path.place(phase), path.periods, path.amplitude) for phase in found.touches(name))
    dips = tuple(Dip(path.place(phase), path.periods, path.amplitude) for phase in found.dips(name))
    root = ChainRoot((*known.zeros, *touches), found.scales[name] * LEAST, dips=dips)
    if not (root.zeros or dips):
        return assembly
    side = root.side(path.state(JUST_AFTER, Slope(1.0)))
    assert isinstance(side, float)
    if len(touches) % 2:
        path = path.doubled()
        if path.periods > (most := most_turns(assembly.linkage)):
            raise AssemblyError(
                f"joint {name}: with the change points up to this one every joint is back after "
                f"{path.periods:,} turns only, and {most:,} are the most here;"
                " make one of its lengths a little longer or shorter"
            )
    return replace(assembly, path=path, chain={**assembly.chain, name: replace(root, sign=side)})
