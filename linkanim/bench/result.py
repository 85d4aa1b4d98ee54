"""What a run of the benchmark found: rows of speed and error, and this project's targets beside it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from linkanim.bench.accuracy import Score, Solve, score, together
from linkanim.bench.cases import EASY, HARD
from linkanim.bench.entries import Entry, Timed, entries, press
from linkanim.bench.machine import Machine, this_machine
from linkanim.bench.reference import Answer, answer
from linkanim.bench.timing import nanoseconds

Progress = Callable[[int, int], None]

BUDGET = 70.0
"""Seconds for the timings on a slow or busy machine."""


@dataclass(frozen=True)
class Measured:
    """One method: times in ns a pose (None where it gives no derivatives), and its scores."""

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


def run(progress: Progress | None = None) -> Result:
    """Measure all methods; about a minute."""
    methods = entries()
    scores = _scores(methods)
    times = nanoseconds(_work(methods), budget=BUDGET, progress=progress)
    rows = tuple(_row(entry, times, scores[entry.solve]) for entry in methods)
    return Result(this_machine(), rows, targets({row.key: row for row in rows}, times["press", 2]))


def _work(methods: Sequence[Entry]) -> dict[tuple[str, int], Timed]:
    """Return all that is timed, by the row's key and the number of derivatives."""
    work = {(entry.key, 0): entry.position for entry in methods}
    work |= {(entry.key, 2): entry.derivatives for entry in methods if entry.derivatives}
    return {**work, ("press", 2): press()}


def _scores(methods: Sequence[Entry]) -> dict[Solve, dict[str, Score]]:
    """Return each method's scores, by the name of the case."""
    answers: dict[str, Answer] = {case.name: answer(case) for case in (EASY, *HARD)}
    solves = dict.fromkeys(entry.solve for entry in methods)
    return {solve: {name: score(solve, asked) for name, asked in answers.items()} for solve in solves}


def _row(entry: Entry, times: Mapping[tuple[str, int], float], scores: Mapping[str, Score]) -> Measured:
    hard = together([scores[case.name] for case in HARD])
    nanos = (times[entry.key, 0], times.get((entry.key, 2)))
    return Measured(entry.key, entry.name, entry.source, *nanos, scores[EASY.name], hard, scores)


def targets(rows: Mapping[str, Measured], press_ns: float) -> tuple[Target, ...]:
    """Return the targets with what a run measured: times, and ratios to pylinkage in the same run."""
    few, many, one = rows["batch"], rows["batch, many"], rows["single"]
    their_few, their_many, their_one = rows["pylinkage"], rows["pylinkage, many"], rows["pylinkage step"]
    all_few, all_many, all_one = (row.derivatives_ns or math.nan for row in (few, many, one))
    theirs_few, theirs_many, theirs_one = (
        row.derivatives_ns or math.nan for row in (their_few, their_many, their_one)
    )
    return (
        Target("positions, 10,000 at once", few.position_ns, 15.0, "ns"),
        Target("with derivatives, 10,000 at once", all_few, 35.0, "ns"),
        Target("positions, 1,000,000 to 10,000 at once", many.position_ns / few.position_ns, 1.6, "×"),
        Target("with derivatives, 1,000,000 to 10,000 at once", all_many / all_few, 1.6, "×"),
        Target("positions, one pose a call", one.position_ns / 1e3, 2.5, "µs"),
        Target("with derivatives, one pose a call", all_one / 1e3, 6.0, "µs"),
        Target("press with derivatives, one pose a call", press_ns / 1e3, 40.0, "µs"),
        *(
            Target(f"pylinkage's time to ours: {what}", theirs / ours, bound, "×", least=True)
            for what, theirs, ours, bound in (
                ("positions, 10,000 at once", their_few.position_ns, few.position_ns, 10.0),
                ("with derivatives, 10,000 at once", theirs_few, all_few, 20.0),
                ("positions, 1,000,000 at once", their_many.position_ns, many.position_ns, 10.0),
                ("with derivatives, 1,000,000 at once", theirs_many, all_many, 12.0),
                ("positions, one pose a call", their_one.position_ns, one.position_ns, 2.0),
                ("with derivatives, one pose a call", theirs_one, all_one, 2.0),
            )
        ),
    )
