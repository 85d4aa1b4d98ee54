"""Change points of dyads further down the chain, found on the cycle.

The margin U·W of such a dyad touches zero without crossing it where its two bars fall into one line
for an instant; what drives the dyad is at an extreme there, so the place is a zero of its rate.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .assembly import JUST_AFTER, Assembly
from .chain import Touches
from .exact import Sum, exact_angle
from .expression import Graph
from .path import Turn
from .planar import Slope
from .program import Batch, batch

SAMPLES_A_TURN = 2880
CANDIDATE = 1e-4
TOUCHING = 1e-12
"""Shares of a margin's greatest value: sampled minima worth a closer look, and those that touch zero."""
LEAST = 1e-16

Array = NDArray[np.float64]


def through_change_points(assembly: Assembly, names: Iterable[str], scales: Mapping[str, float]) -> Assembly:
    """Return the assembly with the change points of the named dyads passed smoothly."""
    touches = {}
    for name in names:
        phases = tuple(_touching_phases(assembly, name, scales[name]))
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
    if isinstance(path, Turn):
        start = exact_angle(path.start)
        found = Touches(tuple(start + Sum(phase) for phase in phases), path.periods, None, least)
    else:
        found = Touches(tuple(Sum(phase) for phase in phases), path.periods, path.amplitude, least)
    side = found.side(path.clock(JUST_AFTER, Slope(1.0)))
    assert isinstance(side, float)
    return replace(found, sign=side)


def _touching_phases(assembly: Assembly, name: str, scale: float) -> Iterator[float]:
    """Yield the phases at which a dyad's margin touches zero, over a true period."""
    program = _margin_and_rate(assembly, name)
    count = SAMPLES_A_TURN * assembly.path.periods
    places = np.arange(-1, count + 1) * (2 * math.pi / SAMPLES_A_TURN)
    with np.errstate(all="ignore"):
        margin = program(places)[0] / scale
    lowest = (margin[1:-1] <= margin[:-2]) & (margin[1:-1] < margin[2:]) & (margin[1:-1] < CANDIDATE)
    for index in np.flatnonzero(lowest) + 1:
        phase = _zero_of_rate(program, float(places[index - 1]), float(places[index + 1]))
        with np.errstate(all="ignore"):
            least = program(np.array([phase]))[0, 0] / scale
        if abs(least) <= TOUCHING:
            yield phase


def _margin_and_rate(assembly: Assembly, name: str) -> Batch:
    graph = Graph()
    found = assembly.walk_at(graph.input("x"), Slope(1.0))
    return batch({"x": True}, [found.margins[name], found.drivers[name].rate])


def _zero_of_rate(program: Batch, low: float, high: float) -> float:
    """Return where the driver is at its extreme between two phases, by bisection."""

    def rising(phase: float) -> bool:
        with np.errstate(all="ignore"):
            return bool(program(np.array([phase]))[1, 0] > 0)

    at_low = rising(low)
    while True:
        middle = (low + high) / 2
        if middle in (low, high):
            return middle
        low, high = (middle, high) if rising(middle) == at_low else (low, middle)
