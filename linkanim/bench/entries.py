"""The methods compared: who answers, from which source, and what of each is timed."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from linkanim.bench import methods, others
from linkanim.bench.accuracy import Solve
from linkanim.bench.cases import FOUR_BAR, CaseSet
from linkanim.bench.chain import TURN, Orders, Places, Question, circle_dyad
from linkanim.bench.reference import answer

FEW, MANY = 10_000, 1_000_000
ONE_BY_ONE = 720
"""Poses to a timing of methods that take one at a time."""
_DYADS = "each dyad's equations"


@dataclass(frozen=True)
class Timed:
    """Work to be timed, and how many poses it gives."""

    work: Callable[[], object]
    poses: int


@dataclass(frozen=True)
class Entry:
    """A row: the method, its accuracy's `solve`, and the work for positions and with derivatives.

    `key` names it for ratios. Rows that share a `solve` are solved once.
    """

    mechanism: str
    key: str
    name: str
    source: str
    solve: Solve
    position: Timed
    derivatives: Timed | None = None


def entries(mechanism: CaseSet) -> tuple[Entry, ...]:
    """Return all rows of a mechanism in the order of the table."""
    first = answer(replace(mechanism.easy, inputs=mechanism.easy.inputs[:1])).question
    counts = (FEW, MANY) if mechanism is FOUR_BAR else (FEW,)
    turns = {count: _one_turn(first, count) for count in (*counts, ONE_BY_ONE, 180)}
    many = [turns[count] for count in counts]
    rows = (*_own(many, turns[ONE_BY_ONE]), *_usual(turns[FEW], turns[ONE_BY_ONE]))
    packages = _packages(many, turns[ONE_BY_ONE], turns[180])
    return tuple(replace(row, mechanism=mechanism.name) for row in (*rows, *packages))


def _one_turn(first: Question, count: int) -> Question:
    """Return one turn of the easy cycle in so many poses."""
    angles = np.arange(count, dtype=np.float64) * (TURN / count)
    sides = {name: np.full(count, side[0]) for name, side in first.sides.items()}
    rates = (np.ones(count), np.zeros(count))
    return replace(first, angles=angles, phases=angles, rates=rates, sides=sides)


def _timed(solve: Callable[[Question], object], question: Question) -> Timed:
    return Timed(lambda: solve(question), question.angles.size)


def _own(turns: list[Question], one: Question) -> Iterator[Entry]:
    here = "linkanim, this solver"
    for key, turn in zip(("batch", "batch, many"), turns, strict=False):
        name, runs = f"linkanim, {turn.angles.size:,} at once", (_timed(_solved(n), turn) for n in (0, 2))
        yield Entry("", key, name, here, methods.batch, *runs)
    runs = (_timed(_posed(derivatives), one) for derivatives in (0, 2))
    yield Entry("", "single", "linkanim, one pose a call", here, methods.single, *runs)


def _solved(derivatives: int) -> Callable[[Question], object]:
    """Return the solver with what it gives read, which is worked out only then."""
    read = methods.QUANTITIES[derivatives]
    return lambda question: getattr(
        question.scene.solve(angle=question.angles, derivatives=derivatives), read
    )


def _posed(derivatives: int) -> Callable[[Question], object]:
    def run(question: Question) -> None:
        pose = question.scene.pose
        for phase in question.phases.tolist():
            pose(phase, derivatives)

    return run


def _usual(few: Question, one: Question) -> Iterator[Entry]:
    """Yield closed forms, what goes on from pose to pose, and tables."""
    norton = "Norton, Design of Machinery"
    yield _rated("half-angle", "half-angle formula", norton, methods.closed(methods.half_angle_dyad), few)
    yield _rated("circles", "circle intersection", "Bourke 1997", methods.closed(circle_dyad), few)
    for count in (1, 2, 3):
        name = f"Newton, {count} iteration{'s' if count > 1 else ''}"
        yield _rated(f"newton {count}", name, _DYADS, methods.newton(count), one)
    rk4 = methods.runge_kutta
    yield Entry("", "rk4", "RK4 on the velocity", _DYADS, rk4, _timed(rk4, one))
    table = methods.table_of(few)
    for key, words, read in (
        ("linear", "straight lines", methods.linear),
        ("cubic", "Hermite's cubics", methods.cubic),
    ):
        name, looked_up = f"table of 1° steps, {words}", _timed(_reading(read, table), few)
        yield Entry("", key, name, "poses of this solver", _reading(read), looked_up)


def _rated(key: str, name: str, source: str, places: Callable[[Question], Places], turn: Question) -> Entry:
    """Return the row of a method that gives positions, its rates being those of `methods.rated`."""
    solve = methods.rated(places)
    return Entry("", key, name, source, solve, _timed(places, turn), _timed(solve, turn))


def _reading(
    read: Callable[[methods.Samples, Question], Orders], table: methods.Samples | None = None
) -> Solve:
    """Return what reads a table, the question's own where none is given."""
    return lambda question: read(table or methods.table_of(question), question)


def _packages(turns: list[Question], one: Question, fewest: Question) -> Iterator[Entry]:
    for key, turn in zip(("pylinkage", "pylinkage, many"), turns, strict=False):
        count = turn.angles.size
        model = others.pylinkage_model(turn, TURN / count).linkage
        runs = (
            Timed(partial(work, count), count) for work in (model.step_fast, model.step_fast_with_kinematics)
        )
        solve, name = others.pylinkage_fast(round(count / 360)), f"pylinkage step_fast, {count:,} at once"
        yield Entry("", key, name, "pylinkage, numba", solve, *runs)
    count = one.angles.size
    model = others.pylinkage_model(one, TURN / count).linkage
    runs = (Timed(_walked(work, count), count) for work in (model.step, model.step_with_derivatives))
    yield Entry("", "pylinkage step", "pylinkage step()", "pylinkage", others.pylinkage_step, *runs)
    yield Entry("", "fsolve", "scipy fsolve", "scipy.optimize", others.fsolve, _timed(others.fsolve, fewest))


def _walked(work: Callable[[int], Iterator[object]], count: int) -> Callable[[], object]:
    return lambda: deque(work(count), maxlen=0)
