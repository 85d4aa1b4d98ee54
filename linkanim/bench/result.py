"""What a run of the benchmark found: rows of speed and error, and this project's targets beside it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from linkanim.bench.accuracy import Score, Solve, score, together
from linkanim.bench.cases import FOUR_BAR, MECHANISMS, CaseSet
from linkanim.bench.entries import Entry, Timed, entries
from linkanim.bench.machine import Machine, this_machine
from linkanim.bench.reference import answer
from linkanim.bench.timing import nanoseconds

Progress = Callable[[int, int], None]
Key = tuple[str, str, int]
"""A timed piece of work: mechanism, row, and the number of derivatives."""

BUDGET = 150.0
"""Seconds for the timings on a slow or busy machine."""


@dataclass(frozen=True)
class Measured:
    """One method on one mechanism: times in ns a pose (None where it gives no derivatives), and scores."""

    mechanism: str
    key: str
    name: str
    source: str
    position_ns: float
    derivatives_ns: float | None
    easy: Score
    hard: Score
    cases: Mapping[str, Score]


@dataclass(frozen=True)
class Target:
    """A figure this project holds itself to: at most, or at least where `least`."""

    what: str
    measured: float
    bound: float
    unit: str
    least: bool = False

    @property
    def met(self) -> bool:
        """Whether this run reached it."""
        return self.measured >= self.bound if self.least else self.measured <= self.bound


@dataclass(frozen=True)
class Result:
    """Everything one run found."""

    machine: Machine
    rows: tuple[Measured, ...]
    targets: tuple[Target, ...]


def run(
    progress: Progress | None = None,
    *,
    mechanisms: Sequence[CaseSet] = MECHANISMS,
    rows: Callable[[CaseSet], Sequence[Entry]] = entries,
) -> Result:
    """Measure all methods on all mechanisms; some minutes."""
    entered = [(mechanism, tuple(rows(mechanism))) for mechanism in mechanisms]
    times = nanoseconds(
        _work([row for _, methods in entered for row in methods]), budget=BUDGET, progress=progress
    )
    found = tuple(
        _row(entry, times, scores[entry.solve])
        for mechanism, methods in entered
        for scores in [_scores(mechanism, methods)]
        for entry in methods
    )
    return Result(this_machine(), found, targets(found))


def _work(methods: Sequence[Entry]) -> dict[Key, Timed]:
    """Return all that is timed."""
    work = {(entry.mechanism, entry.key, 0): entry.position for entry in methods}
    rates = {(entry.mechanism, entry.key, 2): entry.derivatives for entry in methods if entry.derivatives}
    return {**work, **rates}


def _scores(mechanism: CaseSet, methods: Sequence[Entry]) -> dict[Solve, dict[str, Score]]:
    """Return each method's scores, by the name of the case."""
    answers = {case.name: answer(case) for case in (mechanism.easy, *mechanism.hard)}
    solves = dict.fromkeys(entry.solve for entry in methods)
    return {solve: {name: score(solve, exact) for name, exact in answers.items()} for solve in solves}


def _row(entry: Entry, times: Mapping[Key, float], scores: Mapping[str, Score]) -> Measured:
    easy, *hard = scores.values()
    nanos = [times.get((entry.mechanism, entry.key, order)) for order in (0, 2)]
    assert nanos[0] is not None
    names = (entry.mechanism, entry.key, entry.name, entry.source)
    return Measured(*names, nanos[0], nanos[1], easy, together(hard), scores)


def targets(rows: Sequence[Measured]) -> tuple[Target, ...]:
    """Return the targets with what a run measured: times, ratios to pylinkage in that run, worst errors."""
    by_key = {row.key: row for row in rows if row.mechanism == FOUR_BAR.name}
    few, many, one = (by_key[key] for key in ("batch", "batch, many", "single"))
    pairs = [
        ("10,000 at once", by_key["pylinkage"], few, 12.0, 20.0),
        ("1,000,000 at once", by_key["pylinkage, many"], many, 10.0, 12.0),
        ("one pose a call", by_key["pylinkage step"], one, 2.0, 2.0),
    ]
    all_few, all_many, all_one = (row.derivatives_ns or math.nan for row in (few, many, one))
    return (
        Target("positions, 10,000 at once", few.position_ns, 15.0, "ns"),
        Target("with derivatives, 10,000 at once", all_few, 35.0, "ns"),
        Target("positions, 1,000,000 to 10,000 at once", many.position_ns / few.position_ns, 1.6, "×"),
        Target("with derivatives, 1,000,000 to 10,000 at once", all_many / all_few, 1.6, "×"),
        Target("positions, one pose a call", one.position_ns / 1e3, 2.5, "µs"),
        Target("with derivatives, one pose a call", all_one / 1e3, 6.0, "µs"),
        *(
            _beside("positions", what, theirs.position_ns, own.position_ns, bound)
            for what, theirs, own, bound, _ in pairs
        ),
        *(
            _beside("with derivatives", what, theirs.derivatives_ns, own.derivatives_ns, bound)
            for what, theirs, own, _, bound in pairs
        ),
        *_exact(rows),
    )


def _beside(what: str, how: str, theirs: float | None, own: float | None, bound: float) -> Target:
    share = theirs / own if theirs and own else math.nan
    return Target(f"pylinkage's time to ours: {what}, {how}", share, bound, "×", least=True)


def _exact(rows: Sequence[Measured]) -> list[Target]:
    """Return how exact this solver is to be on every hard case: 16 eps in positions, 64 in rates."""
    own = [row.hard.errors for row in rows if row.key in ("batch", "single")]
    eps = 2.0**-52
    worst = [max(order) / eps for order in zip(*own, strict=True)]
    names = ("positions", "velocities", "accelerations")
    return [
        Target(f"hard cases, {name}", found, bound, "eps")
        for name, found, bound in zip(names, worst, (16.0, 64.0, 64.0), strict=True)
    ]
