"""The transmission angle of every dyad: its least and greatest over the motion, exact at both ends.

It is 90° where the force in a dyad does nothing but drive what follows, and 0 (or 180°, between bars)
where it drives nothing: see Uicker, Pennock and Shigley, Theory of Machines and Mechanisms. Each kind of
dyad says what it is for the factors U and W of its root; they are at their extremes where what closes
the dyad is, and the angle at a slider has one more where the rod lies along its line (U = W).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from .expression import Graph
from .mechanism import Mechanism
from .planar import Slope
from .program import Batch, batch
from .search import around, sign_changes

SAMPLES_A_TURN = 1440
NEARLY = 2.0**-40
"""How near to an extreme, as a share of the phase: the angle there is off by the square of that."""
NONE_LEFT = 1e-12
"""A factor below this share of its greatest value, in a dyad whose bars fall into one line, is none."""

Array = NDArray[np.float64]


def transmission(mechanism: Mechanism) -> tuple[float, float] | None:
    """Return the least and greatest transmission angle over all dyads; None where there is no dyad."""
    joint = mechanism.assembly.linkage.joint
    angles = [
        angle
        for name, factors in (*_of_loops(mechanism), *_of_chain(mechanism))
        for u, w in _emptied(factors, at_end=_reaches_its_end(mechanism, name))
        if (angle := joint(name).transmission(u, w)) is not None
    ]
    return (min(angles), max(angles)) if angles else None


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
    """Yield U and W of each dyad on moving points where its separation, or its rate, changes its sign."""
    assembly = mechanism.assembly
    found = assembly.walk_at(Graph().input("x"), Slope(1.0)).closings
    if not found:
        return
    parts = [
        (closing.separation.value, closing.separation.rate, closing.u, closing.w)
        for closing in found.values()
    ]
    program = batch({"x": True}, [value for values in parts for value in values])
    places = around(assembly.path.periods, SAMPLES_A_TURN)
    for row, name in enumerate(found):
        with np.errstate(all="ignore"):
            turning = [sign_changes(partial(_row, program, 4 * row + k), places, NEARLY) for k in (0, 1)]
            factors = program(np.concatenate([places[:1], *turning]))[4 * row + 2 : 4 * row + 4]
        yield name, np.asarray(factors, dtype=np.float64).T


def _row(program: Batch, row: int, places: Array) -> Array:
    values: Array = program(places)[row]
    return values


def _reaches_its_end(mechanism: Mechanism, name: str) -> bool:
    """Tell whether a dyad's bars fall into one line: at a limit of its own, or at a change point."""
    return name in mechanism.assembly.chain or name in mechanism.assembly.path.ends


def _emptied(factors: Array, *, at_end: bool) -> list[list[float]]:
    """Return the factors without what rounding leaves of one that vanishes."""
    least = factors.max(axis=0) * (NONE_LEFT if at_end else 0.0)
    found: list[list[float]] = np.where(factors > least, factors, 0.0).tolist()
    return found
