"""The same four-bar in other people's packages: pylinkage (Assur groups, numba) and scipy (root finding)."""

from __future__ import annotations

import cmath
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.question import Complexes, Points, Question, coupler_point, crank_pin


class Model(NamedTuple):
    """A pylinkage linkage of O2, O4, A, B, P, and its crank."""

    linkage: Any
    crank: Any


def pylinkage_model(question: Question, rate: float) -> Model:
    """Return the four-bar at the question's first pose; its crank turns by `rate` radians at every step."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRRDyad
    from pylinkage.simulation import Linkage

    bars, start = question.bars, question.start
    o2, o4 = Ground(0.0, 0.0), Ground(bars.ground, 0.0)
    crank = Crank(o2, bars.crank, rate, float(question.angles[0]))
    b = RRRDyad(crank.output, o4, bars.coupler, bars.rocker, start.real, start.imag)
    arm = bars.point * bars.coupler
    linkage = Linkage([o2, o4, crank, b, FixedDyad(crank.output, b, abs(arm), cmath.phase(arm))])
    linkage.set_input_velocity(crank, 1.0)
    return Model(linkage, crank)


def pylinkage_fast(substeps: int) -> Callable[[Question], Points]:
    """Return step_fast from pose to pose, with so many of its own equal steps from one input to the next.

    Inputs at unequal distances are one step apart. The first pose is given; the next ones lie
    nearest to their predecessor, as its solver decides.
    """

    def solve(question: Question) -> Points:
        model = pylinkage_model(question, 1.0)
        ways = np.diff(question.angles)
        count = substeps if np.allclose(ways, ways[0], rtol=1e-3, atol=0.0) else 1
        steps = [0.0, *(ways / count).tolist()]
        return _points(np.array([model.linkage.step_fast(count, dt=step)[-1] for step in steps]))

    return solve


def pylinkage_step(question: Question) -> Points:
    """Do the same with step(); what it refuses as unbuildable is NaN."""
    from pylinkage.exceptions import UnbuildableError

    model = pylinkage_model(question, 1.0)
    found = np.full((len(question.angles), 5, 2), np.nan)
    for row, step in zip(found, np.diff(question.angles, prepend=question.angles[0]).tolist(), strict=True):
        try:
            row[:] = next(model.linkage.step(1, dt=step))
        except UnbuildableError:
            continue
    return _points(found)


def _points(found: Any) -> Points:
    joined: Complexes = found[..., 0] + 1j * found[..., 1]
    return Points(joined[:, 3], joined[:, 4])


def fsolve(question: Question) -> Points:
    """Solve the two distance equations for B from the previous B; NaN where it says it did not converge."""
    from scipy.optimize import fsolve as find

    bars, before, found = question.bars, question.start, []
    pins = crank_pin(bars, question.angles)
    for pin in pins.tolist():
        equations = _distances(pin, question)
        root, _, flag, _ = find(equations, (before.real, before.imag), full_output=True)
        b = complex(root[0], root[1]) if flag == 1 else complex(np.nan, np.nan)
        before = b if flag == 1 else before
        found.append(b)
    return coupler_point(bars, pins, np.array(found))


def _distances(pin: complex, question: Question) -> Any:
    bars = question.bars
    longest = bars.longest**2

    def equations(at: Any) -> tuple[float, float]:
        b = complex(at[0], at[1])
        first, second = b - pin, b - bars.ground
        return (
            (first.real**2 + first.imag**2 - bars.coupler**2) / longest,
            (second.real**2 + second.imag**2 - bars.rocker**2) / longest,
        )

    return equations
