"""What a run of the benchmark found: rows of speed and error, and this project's targets beside it."""

from __future__ import annotations

import math
import os
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.accuracy import Score, Solve, score, together
from linkanim.bench.cases import FOUR_BAR, MECHANISMS, CaseSet
from linkanim.bench.entries import Entry, Timed, entries
from linkanim.bench.reference import answer
from linkanim.bench.timing import nanoseconds

Progress = Callable[[int, int], None]
Key = tuple[str, str, int]
"""A timed piece of work: mechanism, row, and the number of derivatives."""

_TIMES = (
    ("positions, 10,000 at once", "batch", None, 0, 15.0, "ns"),
    ("with derivatives, 10,000 at once", "batch", None, 1, 35.0, "ns"),
    ("positions, 1,000,000 to 10,000 at once", "batch, many", "batch", 0, 1.6, "×"),
    ("with derivatives, 1,000,000 to 10,000 at once", "batch, many", "batch", 1, 1.6, "×"),
    ("positions, one pose a call", "single", None, 0, 2.5, "µs"),
    ("with derivatives, one pose a call", "single", None, 1, 6.0, "µs"),
)
_RATIOS = (
    ("positions, 10,000 at once", "pylinkage", "batch", 0, 12.0, "×"),
    ("positions, 1,000,000 at once", "pylinkage, many", "batch, many", 0, 10.0, "×"),
    ("positions, one pose a call", "pylinkage step", "single", 0, 2.0, "×"),
    ("with derivatives, 10,000 at once", "pylinkage", "batch", 1, 20.0, "×"),
    ("with derivatives, 1,000,000 at once", "pylinkage, many", "batch, many", 1, 12.0, "×"),
    ("with derivatives, one pose a call", "pylinkage step", "single", 1, 2.0, "×"),
)
"""What is held to: words, the row, the row beside it, 0 or 1 with derivatives, the bound, the unit."""

BUDGET = 150.0
"""Seconds for the timings on a slow or busy machine."""


class Machine(NamedTuple):
    """Where figures were measured: the processor, how many cores of it there are, the versions that count.

    `features` are the vector units beyond the least that this numpy runs on and uses, by its names.
    """

    cpu: str
    cores: int
    python: str
    numpy: str
    features: tuple[str, ...] = ()

    @property
    def line(self) -> str:
        """The same in one line."""
        units = ", ".join(self.features) or "no further vector units"
        versions = f"Python {self.python}, numpy {self.numpy} with {units}"
        return f"{self.cpu}, {self.cores} cores, {versions}, one thread"


@dataclass(frozen=True)
class Measured:
    """One method on one mechanism: times in ns a pose (None where it gives no derivatives), and scores."""

    mechanism: str
    key: str
    method: str
    source: str
    ns_position: float
    ns_derivatives: float | None
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
    times = {key: (row.ns_position, row.ns_derivatives) for key, row in by_key.items()}
    timed = [
        Target(words + what, _ratio(times, key, beside, order, unit), bound, unit, least=bool(words))
        for words, whats in (("", _TIMES), ("pylinkage's time to ours: ", _RATIOS))
        for what, key, beside, order, bound, unit in whats
    ]
    return (*timed, *_exact(rows))


def _ratio(
    times: Mapping[str, Sequence[float | None]], key: str, beside: str | None, order: int, unit: str
) -> float:
    """Return a row's time in the unit, or how many times another row's it is; NaN where one is not known."""
    mine, other = times[key][order], times[beside][order] if beside else 1e3 if unit == "µs" else 1.0
    return mine / other if mine and other else math.nan


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


def this_machine() -> Machine:
    """Return what this process runs on."""
    return Machine(_cpu(), os.cpu_count() or 1, platform.python_version(), np.__version__, _features())


def _features() -> tuple[str, ...]:
    built: Any = np.show_config(mode="dicts")
    return tuple(built.get("SIMD Extensions", {}).get("found", ()))


def _cpu() -> str:
    """Return the processor's name, as Linux tells it, else as Python does."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, "") or platform.processor() or platform.machine()
