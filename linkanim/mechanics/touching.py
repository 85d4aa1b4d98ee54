"""Change points of dyads further down the chain, found on the cycle.

The margin U·W of such a dyad touches zero without crossing it where its two bars fall into one line
for an instant; what drives the dyad is at an extreme there, so the place is a zero of its rate.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .assembly import JUST_AFTER, Assembly
from .chain import ChainRoot, Touch
from .expression import Graph
from .fitting import refined
from .planar import Slope
from .program import batch
from .search import around, sign_changes

SAMPLES_A_TURN = 2880
TOUCHING = 1e-12
"""Share of a margin's greatest value below which an extreme of it touches zero."""
LEAST = 1e-40
AT_END = 1e-6

Array = NDArray[np.float64]


def through_change_points(assembly: Assembly, names: Iterable[str], near: Container[str]) -> Assembly:
    """Return the assembly with the zeros of the dyads on moving points, those at their limits known.

    Only the dyads in `near` come near one as long as none is passed. In the chain's order: where one
    passes onto its other closure, what stands on it goes another way.
    """
    found = assembly
    for name in names:
        if name in near or found is not assembly:
            found = _through(found, name)
    return found


def _through(assembly: Assembly, name: str) -> Assembly:
    path, known = assembly.path, assembly.chain.get(name, ChainRoot((), 0.0))
    phases, scale = _touching_phases(assembly, name)
    places = (path.place(refined(assembly, name, phase, touching=True)) for phase in phases)
    touches = tuple(Touch(place, path.periods, path.amplitude) for place in places)
    root = ChainRoot((*known.zeros, *touches), scale * LEAST)
    if not root.zeros:
        return assembly
    side = root.side(path.state(JUST_AFTER, Slope(1.0)))
    assert isinstance(side, float)
    if len(touches) % 2:
        path = replace(path, rounds=2 * path.rounds)
    return replace(assembly, path=path, chain={**assembly.chain, name: replace(root, sign=side)})


def _touching_phases(assembly: Assembly, name: str) -> tuple[list[float], float]:
    """Return the phases at which a dyad's margin touches zero, over a true period, and its greatest value."""
    closing = assembly.walk_at(Graph().input("x"), Slope(1.0)).closings[name]
    program = batch({"x": True}, [closing.u * closing.w, closing.separation.rate])
    places = around(assembly.path.periods, SAMPLES_A_TURN)
    with np.errstate(all="ignore"):
        scale = float(np.nanmax(np.abs(program(places)[0]), initial=0.0))
        extremes = sign_changes(lambda phase: program(phase)[1], places)
        margins: Array = program(extremes)[0]
    touching = np.abs(margins) <= TOUCHING * scale
    for end, middle in zip(assembly.path.ends, (0.0, np.pi), strict=False):
        # By phase every rate vanishes at the ends of a swing, also where the dyad limits it.
        if end == name:
            touching &= np.abs(np.remainder(extremes - middle + np.pi, 2 * np.pi) - np.pi) > AT_END
    return extremes[touching].tolist(), scale
