"""The transmission angle of every dyad: the worst over the motion and where it is, and the best.

It is 90° where the force in a dyad does nothing but drive what follows, and 0 where it drives nothing: see
Uicker, Pennock and Shigley, Theory of Machines and Mechanisms. One past 90° between two bars counts as what
is left to 180°, here as everywhere: as good as it is near 90°. Each kind of dyad says what it is for the
factors U and W of its root; it is at its extremes where what closes the dyad is, and where U = W.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from linkanim.mechanics.closing.kinds import walk_at
from linkanim.mechanics.closing.search import around, changes_by_row, highest, in_blocks, own_rows
from linkanim.mechanics.formulas.expression import Graph
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.program import Array, batch
from linkanim.mechanics.motion.measures import transmission_angle
from linkanim.mechanics.motion.mechanism import Mechanism

NEARLY = 2.0**-40
"""How near to an extreme, as a share of the phase: the angle there is off by the square of that."""
NONE_LEFT = 1e-12
"""A factor below this share of its greatest value, in a dyad whose bars fall into one line, is none."""
RIGID = 2.0**-44
"""A rate below this share of its separation is rounding."""


class Transmission(NamedTuple):
    """The least transmission angle over the motion, of which dyad and at which phase, and the greatest."""

    least: float
    greatest: float
    dyad: str
    phase: float


def transmission(mechanism: Mechanism) -> Transmission | None:
    """Return the least and greatest transmission angle over all dyads; None where there is no dyad.

    Both are exact; of several phases at which the least is reached it is one.
    """
    joint = mechanism.assembly.linkage.joint
    angles = [
        (angle, name)
        for name, factors in (*_of_loops(mechanism), *_of_chain(mechanism))
        for u, w in _emptied(factors, at_end=_reaches_its_end(mechanism, name))
        if (angle := joint(name).transmission(u, w)) is not None
    ]
    if not angles:
        return None
    least, dyad = min(angles, key=itemgetter(0))
    return Transmission(least, max(angles)[0], dyad, _where_least(mechanism, dyad))


def _where_least(mechanism: Mechanism, dyad: str) -> float:
    """Return a phase at which a dyad's transmission angle is least."""

    def negative(phases: Array) -> Array:
        motion = mechanism.solve(phase=phases, speed=1.0, derivatives=0)
        return -np.asarray(transmission_angle(motion, dyad), dtype=np.float64)

    count = mechanism.assembly.samples
    places = around(mechanism.periods, count)
    worst = float(places[np.nanargmax(np.concatenate([*map(negative, in_blocks(places))]))])
    return highest(negative, worst, math.tau / count) % (math.tau * mechanism.periods)


def _of_loops(mechanism: Mechanism) -> Iterator[tuple[str, Array]]:
    """Yield U and W of each loop where sin²(ψ/2) is least and greatest, and where they are equal."""
    for name, loop in mechanism.assembly.loops.items():
        root, path = loop.root, mechanism.assembly.path
        reference, ratio = root.reference - loop.gearing.offset, loop.gearing.ratio
        least, greatest = path.half_squares(reference, ratio)
        equal = (root.u.most - root.w.least) / (2 * root.spread)
        spread = np.array([least, min(max(equal, least), greatest), greatest]) * root.spread
        u = np.ones(3) if root.single else root.u.most - spread
        yield name, np.column_stack([u, root.w.least + spread])


def _of_chain(mechanism: Mechanism) -> Iterator[tuple[str, Array]]:
    """Yield U and W of each dyad on moving points where its separation, its rate or U - W changes sign."""
    assembly = mechanism.assembly
    found = walk_at(assembly, Graph().input("x"), Slope(1.0)).closings
    if not found:
        return
    closings, count = found.values(), len(found)
    parts = [(one.separation.value, one.separation.rate, one.half_difference) for one in closings]
    turning = batch({"x": True}, [value for values in parts for value in values])
    factors = batch({"x": True}, [closing.u for closing in closings] + [closing.w for closing in closings])

    def moving(phases: Array) -> Array:
        """Return each separation, its rate, none where the ends are carried by one body, and U - W."""
        values = turning(phases)
        rates = values[1::3]
        rates[np.abs(rates) <= RIGID * np.abs(values[::3])] = 0.0
        return values

    places = around(assembly.path.periods, assembly.samples)
    with np.errstate(all="ignore"):
        rows, extremes = changes_by_row(moving, places, NEARLY)
        whose = np.concatenate([np.arange(count), rows // len(parts[0])])
        where = np.concatenate([np.repeat(places[:1], count), extremes])
        u, w = (own_rows(factors, whose + half, where) for half in (0, count))
    for row, name in enumerate(found):
        yield name, np.column_stack([u, w])[whose == row]


def _reaches_its_end(mechanism: Mechanism, name: str) -> bool:
    """Tell whether a dyad's bars fall into one line: at a limit of its own, or at a change point."""
    root = mechanism.assembly.chain.get(name)
    return bool(root and root.zeros) or name in mechanism.assembly.path.ends


def _emptied(factors: Array, *, at_end: bool) -> list[list[float]]:
    """Return the factors without what rounding leaves of one that vanishes."""
    least = factors.max(axis=0) * (NONE_LEFT if at_end else 0.0)
    found: list[list[float]] = np.where(factors > least, factors, 0.0).tolist()
    return found
