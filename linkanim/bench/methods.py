"""This solver's ways to answer: what of each is timed, and what is scored.

The usual ways of solving a linkage, and other people's packages, are measured beside the tests
(`tests/bench/peers.py`); the table has what was recorded of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from linkanim.bench.questions import FOUR_BAR, TURN, CaseSet, FixedStep, Orders, Question, TurnStep, joined
from linkanim.bench.reference import Solve, answer
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import RRR
from linkanim.synthesis import linkages as synthesised

QUANTITIES = ("position", "velocity", "acceleration")
FEW, MANY = 10_000, 1_000_000
ONE_BY_ONE = 720
"""The number of poses in a timing of methods that take one pose at a time."""


def batch(question: Question) -> Orders:
    """Solve all inputs in one call, by angle where the question gives angles, else by phase."""
    solve = question.scene.solve
    by_angle = question.by_angle
    motion = solve(angle=question.angles, speed=1.0) if by_angle else solve(phase=question.phases, speed=1.0)
    return tuple(
        {name: joined(getattr(motion, quantity)[name]) for name in question.shown} for quantity in QUANTITIES
    )


def single(question: Question) -> Orders:
    """Solve one pose per call in plain floats; rates by phase only, as this call gives no others."""
    poses = [question.scene.pose(phase, 2) for phase in question.phases.tolist()]
    scale = question.scene.linkage.drive.speed
    return tuple(
        {
            name: np.array([complex(*getattr(pose, quantity)[name]) for pose in poses]) / scale**order
            for name in question.shown
        }
        for order, quantity in enumerate(QUANTITIES[:1] if question.by_angle else QUANTITIES)
    )


def each_its_own(question: Question) -> Orders:
    """Close every pose as a four-bar of its own lengths, as an atlas of curves is made: positions alone.

    All poses of the question have the same lengths, but neither time nor error depends on that.
    """
    chain = question.chain
    (crank, dyad, point), (o2, o4) = chain.steps, chain.pins.values()
    if not (isinstance(crank, TurnStep) and isinstance(dyad, RRR) and isinstance(point, FixedStep)):
        raise TypeError("a four-bar is asked for")
    places = (o2.real, o2.imag, crank.length, dyad.lengths[0], point.at.real, point.at.imag)
    row = np.array([*places, o4.real, o4.imag, dyad.lengths[1]])
    rows, sides = np.tile(row, (question.angles.size, 1)), question.sides[dyad.name]
    joints = synthesised.FOUR_BAR.joints(rows, sides, question.angles[:, None]).T
    names = (*chain.pins, crank.name, dyad.name, point.name)
    return (dict(zip(names, joints, strict=True)),)


@frozen
class Timed:
    """Work to be timed, and how many poses it gives."""

    work: Callable[[], object]
    poses: int

    def seconds(self, repeats: int, clock: Callable[[], float]) -> float:
        """Return the time of the repeats (s), after one run that is not timed.

        Memory that was idle between rounds may have been given back to a virtual machine's host, and the time
        to get it again does not belong to the work.
        """
        self.work()
        start = clock()
        for _ in range(repeats):
            self.work()
        return clock() - start


@frozen
class Entry:
    """A row: the method, the `solve` that is scored, and the work for positions and with derivatives.

    `key` is its name in ratios of times. Rows that share a `solve` are scored once.
    """

    mechanism: str
    key: str
    name: str
    source: str
    solve: Solve
    position: Timed
    derivatives: Timed | None = None


def entries(mechanism: CaseSet) -> tuple[Entry, ...]:
    """Return this solver's rows of a mechanism in the order of the table."""
    first = first_of(mechanism)
    counts = (FEW, MANY) if mechanism is FOUR_BAR else (FEW,)
    rows = _own([one_turn(first, count) for count in counts], one_turn(first, ONE_BY_ONE))
    return tuple(replace(row, mechanism=mechanism.name) for row in rows)


def first_of(mechanism: CaseSet) -> Question:
    """Return the question of the easy cycle's first pose."""
    return answer(replace(mechanism.easy, inputs=mechanism.easy.inputs[:1])).question


def one_turn(first: Question, count: int) -> Question:
    """Return one turn of the easy cycle in `count` poses."""
    angles = np.arange(count, dtype=np.float64) * (TURN / count)
    sides = {name: np.full(count, side[0]) for name, side in first.sides.items()}
    rates = (np.ones(count), np.zeros(count))
    return replace(first, angles=angles, phases=angles, rates=rates, sides=sides)


def timed(solve: Callable[[Question], object], question: Question) -> Timed:
    """Return a solve of a question as work."""
    return Timed(lambda: solve(question), question.angles.size)


def _own(turns: list[Question], one: Question) -> Iterator[Entry]:
    here = "linkanim, this solver"
    for key, turn in zip(("batch", "batch, many"), turns, strict=False):
        name, runs = f"linkanim, {turn.angles.size:,} at once", (timed(_solved(n), turn) for n in (0, 2))
        yield Entry("", key, name, here, batch, *runs)
    if turns[1:]:  # of a four-bar
        yield of_many_linkages()
    runs = (timed(_posed(derivatives), one) for derivatives in (0, 2))
    yield Entry("", "single", "linkanim, one pose a call", here, single, *runs)


def of_many_linkages() -> Entry:
    """Return the row of ten thousand four-bars whose cranks turn fully, each at one angle."""
    kind, random = synthesised.FOUR_BAR, np.random.default_rng(1)
    rows = kind.random_rows(random, 20 * FEW)
    rows = rows[(kind.margins(rows, 0.0) > 0).all(axis=1)][:FEW]
    ways, angles = np.ones(len(rows)), random.uniform(0.0, TURN, (len(rows), 1))
    timed = Timed(lambda: kind.joints(rows, ways, angles), len(rows))
    name = f"synthesis, {len(rows):,} different linkages"
    return Entry("", "different", name, "linkanim, its synthesis", each_its_own, timed)


def _solved(derivatives: int) -> Callable[[Question], object]:
    """Return the solver with its results read, as they are computed only then."""
    read = QUANTITIES[derivatives]
    return lambda question: getattr(
        question.scene.solve(angle=question.angles, derivatives=derivatives), read
    )


def _posed(derivatives: int) -> Callable[[Question], object]:
    def run(question: Question) -> None:
        pose = question.scene.pose
        for phase in question.phases.tolist():
            pose(phase, derivatives)

    return run
