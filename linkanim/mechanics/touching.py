"""Change points of dyads further down the chain, found on the cycle.

The margin U·W of such a dyad touches zero without crossing it where its two bars fall into one line
for an instant; what drives the dyad is at an extreme there, so the place is a zero of its rate.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .assembly import JUST_AFTER, Assembly
from .chain import Touches
from .expression import Graph
from .planar import Slope
from .program import Batch, batch
from .search import around, sign_changes

SAMPLES_A_TURN = 2880
TOUCHING = 1e-12
"""Share of a margin's greatest value below which an extreme of it touches zero."""
LEAST = 1e-16

Array = NDArray[np.float64]


def through_change_points(assembly: Assembly, names: Iterable[str], scales: Mapping[str, float]) -> Assembly:
    """Return the assembly with the change points of the named dyads passed smoothly."""
    touches = {}
    for name in names:
        phases = tuple(_touching_phases(assembly, name, scales[name]).tolist())
        if phases:
            touches[name] = _named(assembly, phases, scales[name] * LEAST)
    if not touches:
        return assembly
    path = assembly.path
    if any(len(found.places) % 2 for found in touches.values()):
        path = replace(path, rounds=2 * path.rounds)
    return replace(assembly, path=path, touches=touches)


def _named(assembly: Assembly, phases: tuple[float, ...], least: float) -> Touches:
    """Return the touches with the sign under which the named closure holds just after the start."""
    path = assembly.path
    found = Touches(tuple(map(path.place, phases)), path.periods, path.amplitude, least)
    side = found.side(path.clock(JUST_AFTER, Slope(1.0)))
    assert isinstance(side, float)
    return replace(found, sign=side)


def _touching_phases(assembly: Assembly, name: str, scale: float) -> Array:
    """Return the phases at which a dyad's margin touches zero, over a true period."""
    program = _margin_and_rate(assembly, name)
    places = around(assembly.path.periods, SAMPLES_A_TURN)
    with np.errstate(all="ignore"):
        extremes = sign_changes(lambda phase: program(phase)[1], places)
        margins: Array = program(extremes)[0]
    return extremes[np.abs(margins) <= TOUCHING * scale]


def _margin_and_rate(assembly: Assembly, name: str) -> Batch:
    graph = Graph()
    found = assembly.walk_at(graph.input("x"), Slope(1.0))
    return batch({"x": True}, [found.margins[name], found.drivers[name].rate])
