"""The methods compared: who answers, from which source, and what of each is timed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from linkanim.bench import methods, others, solver
from linkanim.bench.accuracy import Solve
from linkanim.bench.cases import EASY_LENGTHS
from linkanim.bench.question import TURN, FourBarLengths, Points, Question, joined, scene_of
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

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

    key: str
    name: str
    source: str
    solve: Solve
    position: Timed
    derivatives: Timed | None = None


def easy(count: int) -> Question:
    """Return one turn of the easy linkage in so many poses."""
    bars, angles = FourBarLengths(*EASY_LENGTHS), np.arange(count, dtype=np.float64) * (TURN / count)
    start = joined(scene_of(bars, 1).solve(angle=angles[:1], derivatives=0).position["B"])[0]
    return Question(bars, 1, angles, np.ones(count), complex(start), angles)


def entries() -> tuple[Entry, ...]:
    """Return all rows in the order of the table."""
    return (*_own(), *_closed_forms(), *_from_pose_to_pose(), *_tables(), *_packages())


def _own() -> Iterator[Entry]:
    here = "linkanim, this solver"
    for key, count in (("batch", FEW), ("batch, many", MANY)):
        runs = (_solved(easy(count), derivatives) for derivatives in (0, 2))
        yield Entry(key, f"linkanim, {count:,} at once", here, solver.batch, *runs)
    poses = (_posed(easy(ONE_BY_ONE), derivatives) for derivatives in (0, 2))
    yield Entry("single", "linkanim, one pose a call", here, solver.single, *poses)
    scene, phases = easy(FEW).scene, easy(FEW).angles.astype(np.float32)
    run = Timed(lambda: solver.batch_float32(scene, phases), FEW)
    yield Entry("float32", f"linkanim, float32, {FEW:,} at once", here, solver.float32, run)


def _solved(question: Question, derivatives: int) -> Timed:
    scene, angles = question.scene, question.angles
    # Worked out when first read.
    read = ("position", "velocity", "acceleration")[derivatives]
    return Timed(lambda: getattr(scene.solve(angle=angles, derivatives=derivatives), read), angles.size)


def _posed(question: Question, derivatives: int) -> Timed:
    return _one_by_one(question.scene, question.angles.tolist(), derivatives)


def press() -> Timed:
    """Return the work of the press, one pose a call with all derivatives."""
    return _one_by_one(load("press"), easy(ONE_BY_ONE).angles.tolist(), 2)


def _one_by_one(scene: Scene, phases: list[float], derivatives: int) -> Timed:
    pose = scene.pose

    def run() -> None:
        for phase in phases:
            pose(phase, derivatives)

    return Timed(run, len(phases))


def _asked(solve: Solve, count: int) -> Timed:
    question = easy(count)
    return Timed(lambda: solve(question), count)


def _closed_forms() -> Iterator[Entry]:
    rates = easy(FEW)
    yield Entry(
        "half-angle",
        "half-angle formula",
        "Norton, Design of Machinery",
        methods.half_angle,
        _asked(methods.half_angle, FEW),
        Timed(lambda: methods.half_angle_rates(rates), FEW),
    )
    yield Entry(
        "circles", "circle intersection", "Bourke 1997", methods.circles, _asked(methods.circles, FEW)
    )


def _from_pose_to_pose() -> Iterator[Entry]:
    for count in (1, 2, 3):
        solve = methods.newton(count)
        name = f"Newton, {count} iteration{'s' if count > 1 else ''}"
        yield Entry(f"newton {count}", name, "loop equation", solve, _asked(solve, ONE_BY_ONE))
    rk4 = methods.runge_kutta
    yield Entry("rk4", "RK4 on the velocity", "loop equation", rk4, _asked(rk4, ONE_BY_ONE))


def _tables() -> Iterator[Entry]:
    question = easy(FEW)
    table = methods.table_of(question)
    for key, name, read in (
        ("linear", "straight lines", methods.linear),
        ("cubic", "Hermite's cubics", methods.cubic),
    ):
        run = _reading(read, table, question)
        yield Entry(key, f"table of 1° steps, {name}", "poses of this solver", _looked_up(read), run)


def _reading(
    read: Callable[[methods.Samples, Question], Points], table: methods.Samples, question: Question
) -> Timed:
    return Timed(lambda: read(table, question), FEW)


def _looked_up(read: Callable[[methods.Samples, Question], Points]) -> Solve:
    return lambda question: read(methods.table_of(question), question)


def _packages() -> Iterator[Entry]:
    for key, count in (("pylinkage", FEW), ("pylinkage, many", MANY)):
        model = others.pylinkage_model(easy(count), TURN / count).linkage
        runs = (_stepped(work, count) for work in (model.step_fast, model.step_fast_with_kinematics))
        solve = others.pylinkage_fast(round(count / 360))
        yield Entry(key, f"pylinkage step_fast, {count:,} at once", "pylinkage, numba", solve, *runs)
    one = others.pylinkage_model(easy(ONE_BY_ONE), TURN / ONE_BY_ONE).linkage
    runs = (_walked(work, ONE_BY_ONE) for work in (one.step, one.step_with_derivatives))
    yield Entry("pylinkage step", "pylinkage step()", "pylinkage", others.pylinkage_step, *runs)
    yield Entry("fsolve", "scipy fsolve", "scipy.optimize", others.fsolve, _asked(others.fsolve, 180))


def _stepped(work: Callable[[int], object], count: int) -> Timed:
    return Timed(lambda: work(count), count)


def _walked(work: Callable[[int], Iterator[object]], count: int) -> Timed:
    def run() -> None:
        for _ in work(count):
            pass

    return Timed(run, count)
