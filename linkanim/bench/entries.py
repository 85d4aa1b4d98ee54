"""The methods compared: who answers, from which source, and what of each is timed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from linkanim.bench import methods, others, ours
from linkanim.bench.accuracy import Solve
from linkanim.bench.cases import FOUR_BAR, Case, CaseSet
from linkanim.bench.chain import TURN, Question
from linkanim.bench.reference import answer

FEW, MANY = 10_000, 1_000_000
ONE_BY_ONE = 720
"""Poses to a timing of methods that take one at a time."""


@dataclass(frozen=True)
class Timed:
    """Work to be timed, and how many poses it gives."""

    work: Callable[[], object]
    poses: int


@dataclass(frozen=True)
class Entry:
    """A row: the method, its accuracy's `solve`, and the work for positions and with derivatives.

    `key` names it for ratios. Rows that share a `solve` are asked once.
    """

    mechanism: str
    key: str
    name: str
    source: str
    solve: Solve
    position: Timed
    derivatives: Timed | None = None


class Easy:
    """The easy cycle of a mechanism, in as many poses as are asked for."""

    def __init__(self, case: Case) -> None:
        self._one = answer(replace(case, inputs=case.inputs[:1])).question

    def in_poses(self, count: int) -> Question:
        """Return one turn in so many poses."""
        angles = np.arange(count, dtype=np.float64) * (TURN / count)
        sides = {name: np.full(count, side[0]) for name, side in self._one.sides.items()}
        rates = (np.ones(count), np.zeros(count))
        return replace(self._one, angles=angles, phases=angles, rates=rates, sides=sides)


def entries(mechanism: CaseSet) -> tuple[Entry, ...]:
    """Return all rows of a mechanism in the order of the table."""
    easy, name = Easy(mechanism.easy), mechanism.name
    counts = (FEW, MANY) if mechanism is FOUR_BAR else (FEW,)
    rows = (*_own(easy, counts), *_closed_forms(easy), *_from_pose_to_pose(easy), *_tables(easy))
    return tuple(replace(row, mechanism=name) for row in (*rows, *_packages(easy, counts)))


def _own(easy: Easy, counts: tuple[int, ...]) -> Iterator[Entry]:
    here = "linkanim, this solver"
    for key, count in zip(("batch", "batch, many"), counts, strict=False):
        runs = (_solved(easy.in_poses(count), derivatives) for derivatives in (0, 2))
        yield Entry("", key, f"linkanim, {count:,} at once", here, ours.batch, *runs)
    poses = (_posed(easy.in_poses(ONE_BY_ONE), derivatives) for derivatives in (0, 2))
    yield Entry("", "single", "linkanim, one pose a call", here, ours.single, *poses)


def _solved(question: Question, derivatives: int) -> Timed:
    scene, angles = question.scene, question.angles
    # Worked out when first read.
    read = ours.QUANTITIES[derivatives]
    return Timed(lambda: getattr(scene.solve(angle=angles, derivatives=derivatives), read), angles.size)


def _posed(question: Question, derivatives: int) -> Timed:
    pose, phases = question.scene.pose, question.phases.tolist()

    def run() -> None:
        for phase in phases:
            pose(phase, derivatives)

    return Timed(run, len(phases))


def _timed(solve: Solve, question: Question) -> Timed:
    return Timed(lambda: solve(question), question.angles.size)


def _closed_forms(easy: Easy) -> Iterator[Entry]:
    question = easy.in_poses(FEW)
    for key, name, source, close in (
        ("half-angle", "half-angle formula", "Norton, Design of Machinery", methods.half_angle_dyad),
        ("circles", "circle intersection", "Bourke 1997", methods.circle_dyad),
    ):
        solve = methods.closed(close)
        runs = (_timed(way, question) for way in (methods.positions(close), solve))
        yield Entry("", key, name, source, solve, *runs)


def _from_pose_to_pose(easy: Easy) -> Iterator[Entry]:
    question = easy.in_poses(ONE_BY_ONE)
    for count in (1, 2, 3):
        solve = methods.newton(count)
        runs = (_timed(way, question) for way in (methods.newton_positions(count), solve))
        name = f"Newton, {count} iteration{'s' if count > 1 else ''}"
        yield Entry("", f"newton {count}", name, "each dyad's equations", solve, *runs)
    rk4 = methods.runge_kutta
    source = "each dyad's equations"
    yield Entry("", "rk4", "RK4 on the velocity", source, rk4, _timed(rk4, question))


def _tables(easy: Easy) -> Iterator[Entry]:
    question = easy.in_poses(FEW)
    table = methods.table_of(question)
    for key, name, read in (
        ("linear", "straight lines", methods.linear),
        ("cubic", "Hermite's cubics", methods.cubic),
    ):
        run = Timed(lambda read=read: read(table, question), FEW)  # type: ignore[misc]
        yield Entry("", key, f"table of 1° steps, {name}", "poses of this solver", _looked_up(read), run)


def _looked_up(read: Callable[[methods.Samples, Question], ours.Orders]) -> Solve:
    return lambda question: read(methods.table_of(question), question)


def _packages(easy: Easy, counts: tuple[int, ...]) -> Iterator[Entry]:
    for key, count in zip(("pylinkage", "pylinkage, many"), counts, strict=False):
        model = others.pylinkage_model(easy.in_poses(count), TURN / count).linkage
        runs = (_stepped(work, count) for work in (model.step_fast, model.step_fast_with_kinematics))
        solve = others.pylinkage_fast(round(count / 360))
        yield Entry("", key, f"pylinkage step_fast, {count:,} at once", "pylinkage, numba", solve, *runs)
    one = others.pylinkage_model(easy.in_poses(ONE_BY_ONE), TURN / ONE_BY_ONE).linkage
    runs = (_walked(work, ONE_BY_ONE) for work in (one.step, one.step_with_derivatives))
    yield Entry("", "pylinkage step", "pylinkage step()", "pylinkage", others.pylinkage_step, *runs)
    timed = _timed(others.fsolve, easy.in_poses(180))
    yield Entry("", "fsolve", "scipy fsolve", "scipy.optimize", others.fsolve, timed)


def _stepped(work: Callable[[int], object], count: int) -> Timed:
    return Timed(lambda: work(count), count)


def _walked(work: Callable[[int], Iterator[object]], count: int) -> Timed:
    def run() -> None:
        for _ in work(count):
            pass

    return Timed(run, count)
