"""What a run of the benchmark found: rows of speed and error."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.accuracy import Score, Solve, score, together
from linkanim.bench.cases import MECHANISMS, CaseSet
from linkanim.bench.entries import Entry, Timed, entries
from linkanim.bench.reference import answer
from linkanim.bench.timing import nanoseconds

Progress = Callable[[int, int], None]
Key = tuple[str, str, int]
"""A timed piece of work: mechanism, row, and the number of derivatives."""

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
class Result:
    """Everything one run found."""

    machine: Machine
    rows: tuple[Measured, ...]


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
    return Result(this_machine(), found)


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
