"""The same linkages in other people's packages: pylinkage (Assur groups, numba) and scipy (root finding)."""

from __future__ import annotations

import cmath
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.chain import Dyad, Orders, Places, Question, SlideStep, TurnStep, joined, placed
from linkanim.bench.methods import NOWHERE
from linkanim.mechanics.linkage.dyads import RRR


class Model(NamedTuple):
    """A pylinkage linkage, its cranks with their ratios, and the row of each joint in its answers."""

    linkage: Any
    cranks: tuple[tuple[Any, float], ...]
    rows: dict[str, int]

    def run_at(self, speed: float, gain: float) -> None:
        """Have the input turn at this speed and acceleration, for the rates."""
        for crank, ratio in self.cranks:
            self.linkage.set_input_velocity(crank, ratio * speed, ratio * gain)


def pylinkage_model(question: Question, rate: float) -> Model:
    """Return the linkage at the question's first pose; its input turns by `rate` radians at every step."""
    from pylinkage.components import Ground
    from pylinkage.simulation import Linkage

    made: dict[str, Any] = {name: Ground(at.real, at.imag) for name, at in question.chain.pins.items()}
    parts, cranks = [*made.values()], []
    rows = {name: row for row, name in enumerate(made)}
    for step in question.chain.steps:
        ends = (step.base, step.base + step.along) if isinstance(step, SlideStep) else ()
        guide = [Ground(at.real, at.imag) for at in ends]
        parts += guide
        part = _part(step, made, question, rate, guide)
        if isinstance(step, TurnStep):
            cranks.append((part, step.ratio))
        rows[step.name] = len(parts)
        parts.append(part)
        made[step.name] = part.output if isinstance(step, TurnStep) else part
    model = Model(Linkage(parts), tuple(cranks), rows)
    model.run_at(1.0, 0.0)
    return model


def _part(step: Any, made: dict[str, Any], question: Question, rate: float, guide: list[Any]) -> Any:
    from pylinkage.actuators import Crank
    from pylinkage.dyads import FixedDyad, RRPDyad, RRRDyad

    start = question.start[step.name]
    match step:
        case TurnStep():
            angle = step.ratio * float(question.angles[0]) + step.offset
            return Crank(made[step.pivot], step.length, step.ratio * rate, angle)
        case RRR():
            ends = [made[end] for end in step.ends]
            return RRRDyad(*ends, *step.lengths, start.real, start.imag)
        case SlideStep():
            return RRPDyad(made[step.end], *guide, step.length, start.real, start.imag)
    return FixedDyad(*(made[name] for name in step.on), abs(step.at), cmath.phase(step.at))


def pylinkage_fast(substeps: int) -> Callable[[Question], Orders]:
    """Return step_fast from pose to pose, with so many of its own equal steps from one input to the next.

    Inputs at unequal distances are one step apart. The first pose is given; the next ones lie nearest to
    their predecessor, as its solver decides.
    """

    def solve(question: Question) -> Orders:
        ways = np.diff(question.angles)
        count = substeps if np.allclose(ways, ways[0], rtol=1e-3, atol=0.0) else 1

        def take(linkage: Any, way: float) -> Any:
            orders = linkage.step_fast_with_kinematics(count, dt=way / count)
            return [order[-1] for order in orders]

        return _walked(question, take)

    return solve


def pylinkage_step(question: Question) -> Orders:
    """Do the same with step(); what it refuses as unbuildable is NaN."""
    from pylinkage.exceptions import UnbuildableError

    def take(linkage: Any, way: float) -> Any:
        try:
            orders = next(linkage.step_with_derivatives(1, dt=way))
        except UnbuildableError:
            return np.full((3, len(linkage.components), 2), np.nan)
        return [[(np.nan, np.nan) if value is None else value for value in values] for values in orders]

    return _walked(question, take)


def _walked(question: Question, take: Callable[[Any, float], Any]) -> Orders:
    """Return the poses from input to input, of each order all places as `take` gives them."""
    model, found = pylinkage_model(question, 1.0), []
    ways = np.diff(question.angles, prepend=question.angles[0]).tolist()
    for way, speed, gain in zip(ways, *(rate.tolist() for rate in question.rates), strict=True):
        model.run_at(speed, gain)
        found.append(take(model.linkage, way))
    orders = np.moveaxis(joined(np.array(found)), 1, 0)
    return tuple({name: order[:, row] for name, row in model.rows.items()} for order in orders)


def fsolve(question: Question) -> Orders:
    """Solve each dyad's equations from its previous place; NaN where it says it did not converge."""
    before, rows = dict(question.start), range(question.angles.size)

    def close(dyad: Dyad, at: Places) -> Any:
        return np.array([_found(dyad, at, row, before) for row in rows])

    return (placed(question.chain, question.angles, close),)


def _found(dyad: Dyad, at: Places, row: int, before: dict[str, complex]) -> complex:
    from scipy.optimize import fsolve as find

    ends = dyad.ends if isinstance(dyad, RRR) else (dyad.end,)
    lengths = dyad.lengths if isinstance(dyad, RRR) else (dyad.length,)
    places = [complex(at[end][row]) if np.ndim(at[end]) else complex(at[end]) for end in ends]
    largest = max(lengths) ** 2

    def equations(guess: Any) -> list[float]:
        here = complex(guess[0], guess[1])
        ways = [abs(here - place) ** 2 - length**2 for place, length in zip(places, lengths, strict=True)]
        off = [] if isinstance(dyad, RRR) else [((here - dyad.base) * dyad.along.conjugate()).imag]
        return [way / largest for way in ways] + [way / max(lengths) for way in off]

    start = before[dyad.name]
    root, _, flag, _ = find(equations, (start.real, start.imag), full_output=True)
    if flag != 1:
        return NOWHERE
    before[dyad.name] = complex(root[0], root[1])
    return before[dyad.name]
