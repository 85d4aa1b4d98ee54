"""Measure speed and error, and show them as a table or as JSON.

Its parts, in reading order:

- Times of many pieces of work, taken in turn, so that a busy machine slows all of them alike.
- The result of a run of the benchmark: rows of speed and error, as a table or as JSON.
- What was recorded of other methods, for the rows beside.
- Where errors are worst, and each of them once more.
- The words and numbers of the table.
"""

from __future__ import annotations

import math
import os
import platform
import shlex
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from datetime import date
from importlib.resources import files
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple, TypeVar

import numpy as np

from linkanim.bench.further import FurtherMeasured, FurtherWork, further
from linkanim.bench.methods import Entry, Timed, batch, entries
from linkanim.bench.questions import MECHANISMS, CaseSet
from linkanim.bench.reference import Score, Solve, answer, together
from linkanim.errors import BadInput
from linkanim.export import columns, json_text, markdown
from linkanim.frozen import frozen

# Times of many pieces of work, taken in turn, so that a busy machine slows all of them alike.
#
# Processor time is measured: all work is done in one thread, and time taken by other processes does not
# count.

Key = TypeVar("Key")

ROUNDS = 21
FEWEST = 3
LEAST_SECONDS = 0.02
"""A timing repeats short work until it is at least as long."""


def nanoseconds(
    work: Mapping[Key, Timed],
    *,
    rounds: int = ROUNDS,
    budget: float = math.inf,
    clock: Callable[[], float] = time.process_time,
    wall: Callable[[], float] = time.perf_counter,
    progress: Callable[[int, int], None] | None = None,
) -> dict[Key, float]:
    """Return the median time of each piece of work in ns per pose.

    Each piece is run once to find how often it must be repeated. Then all are timed in turn, in `rounds`
    rounds, or fewer, but at least three, if `budget` seconds have passed on the clock `wall`. `progress` is
    called with (rounds done, rounds in all).
    """
    once = {key: timed.seconds(1, clock) for key, timed in work.items()}
    repeats = {key: max(round(LEAST_SECONDS / one), 1) if one > 0 else 1 for key, one in once.items()}
    taken: dict[Key, list[float]] = {key: [] for key in work}
    start = wall()
    for done in range(rounds):
        if done >= FEWEST and wall() - start > budget:
            break
        for key, timed in work.items():
            taken[key].append(timed.seconds(repeats[key], clock) / (timed.poses * repeats[key]))
        if progress is not None:
            progress(done + 1, rounds)
    return {key: median(times) * 1e9 for key, times in taken.items()}


# The result of a run of the benchmark: rows of speed and error, as a table or as JSON.

Progress = Callable[[int, int], None]
Row = tuple[str, str, int]
"""A timed piece of work: mechanism, row, and the number of derivatives."""

BUDGET = 150.0
"""The time limit (s) of the timings, for a slow or busy machine."""


class Machine(NamedTuple):
    """The machine of a measurement: the processor, its number of cores, and the versions that matter.

    `features` are the vector instruction sets that numpy uses beyond its baseline, by numpy's names.
    """

    cpu: str
    cores: int
    python: str
    numpy: str
    features: tuple[str, ...] = ()

    @property
    def line(self) -> str:
        """The machine in one line of text."""
        units = ", ".join(self.features) or "no further vector units"
        versions = f"Python {self.python}, numpy {self.numpy} with {units}"
        return f"{self.cpu}, {self.cores} cores, {versions}, one thread"


@frozen
class Measured:
    """One method on one mechanism: times in ns per pose (None where it gives no derivatives), and scores."""

    mechanism: str
    key: str
    method: str
    source: str
    ns_position: float
    ns_derivatives: float | None
    easy: Score
    hard: Score
    cases: Mapping[str, Score]

    @property
    def cells(self) -> Sequence[str]:
        """Its line in the table."""
        times = (_time(self.ns_position), "" if self.ns_derivatives is None else _time(self.ns_derivatives))
        return (
            self.method,
            *times,
            _errors(self.easy),
            _errors(self.hard),
            f"{self.hard.wrong:,}",
            f"{self.hard.nan:,}",
        )


@frozen
class Result:
    """The result of one run: the machine, and all rows; as text, as the manual's table, or as JSON."""

    machine: Machine
    rows: tuple[Measured, ...]
    day: date
    further: tuple[FurtherMeasured, ...] = ()

    def with_recorded(self) -> Result:
        """Return a result of this solver with the rows that the manual's table has of other methods."""
        page = (files("linkanim") / "manual" / "measurements.md").read_text(encoding="utf-8")
        table = page.partition("<!-- bench -->\n")[2].partition("<!-- /bench -->")[0]
        poses = {row.mechanism: (row.easy.poses, row.hard.poses) for row in self.rows}
        rows, mechanism = list(self.rows), ""
        for line in table.splitlines():
            name, *cells = [cell.strip() for cell in line.strip("|").split("|")]
            if name.startswith("**"):
                mechanism = name.strip("*")
            elif mechanism in poses and cells and not name.startswith(_OURS):
                rows.append(_recorded(mechanism, name, cells, poses[mechanism]))
        return replace(self, rows=tuple(rows))

    def witnesses(self) -> list[str]:
        """Return where this solver's errors are worst, each with the command that prints it again."""
        lines = []
        for row in (row for row in self.rows if row.key == "batch"):
            for order, what in enumerate(ORDERS):
                errors = [
                    (case.errors[order], name, case.at[order]) for name, case in row.cases.items() if case.at
                ]
                if errors:
                    error, name, at = max(errors)
                    lines.append(_witness(f"{row.mechanism}: {name}", what, error, [at]))
        return lines + [_witness(one.name, "error", one.error, one.at) for one in self.further]

    def as_text(self) -> str:
        """Return the machine and the tables in aligned columns."""
        tables = [f"{name}\n{columns([TITLES, *rows])}" for name, rows in self._by_mechanism()]
        further_ = [(one.words, _time(one.ns), f"{one.error:.1e}") for one in self.further]
        parts = [self.machine.line, *tables, self._note(), columns([FURTHER, *further_])]
        return "\n\n".join([*parts, "\n".join(["worst errors", *self.witnesses()])])

    def as_markdown(self) -> str:
        """Return the manual's table, one mechanism after the other, with the machine of the measurement."""
        blank = [""] * (len(TITLES) - 1)
        rows = [line for name, lines in self._by_mechanism() for line in ([f"**{name}**", *blank], *lines)]
        note = f"{self._note()} Measured on {self.day} on {self.machine.line}.\n"
        return f"{markdown([TITLES, *rows])}\n\n{note}"

    def as_json(self) -> str:
        """Return one JSON object: the machine, and the rows with every case; null for a missing number."""
        further = [asdict(row) for row in self.further]
        rows = [asdict(row) for row in self.rows]
        document = {"machine": self.machine._asdict(), "rows": rows, "further": further}
        return json_text(document, indent=2)

    def _by_mechanism(self) -> Iterator[tuple[str, list[Sequence[str]]]]:
        """Yield each mechanism's name and its lines."""
        for name in dict.fromkeys(row.mechanism for row in self.rows):
            yield name, [row.cells for row in self.rows if row.mechanism == name]

    def _note(self) -> str:
        poses = {row.mechanism: row.hard.poses for row in self.rows}
        note = NOTE.format(poses=", ".join(f"{count:,} ({name})" for name, count in poses.items()))
        beside = any(row.source == RECORDED for row in self.rows)
        return f"{note} {_BESIDE}" if beside else note


def run(
    progress: Progress | None = None,
    *,
    mechanisms: Sequence[CaseSet] = MECHANISMS,
    rows: Callable[[CaseSet], Sequence[Entry]] = entries,
    others: Callable[[], Sequence[FurtherWork]] = further,
) -> Result:
    """Measure all methods on all mechanisms, which takes some minutes."""
    entered = [(mechanism, tuple(rows(mechanism))) for mechanism in mechanisms]
    more = others()
    work = _work([row for _, methods in entered for row in methods])
    work |= {("", one.name, 0): one.timed for one in more}
    times = nanoseconds(work, budget=BUDGET, progress=progress)
    measured_rows = tuple(
        _row(entry, times, scores[entry.solve])
        for mechanism, methods in entered
        for scores in [_scores(mechanism, methods)]
        for entry in methods
    )
    measured_more = tuple(one.measured(times["", one.name, 0]) for one in more)
    return Result(this_machine(), measured_rows, date.today(), measured_more)


def _work(methods: Sequence[Entry]) -> dict[Row, Timed]:
    """Return all pieces of work to be timed."""
    work = {(entry.mechanism, entry.key, 0): entry.position for entry in methods}
    rates = {(entry.mechanism, entry.key, 2): entry.derivatives for entry in methods if entry.derivatives}
    return {**work, **rates}


def _scores(mechanism: CaseSet, methods: Sequence[Entry]) -> dict[Solve, dict[str, Score]]:
    """Return each method's scores, by the name of the case."""
    answers = {case.name: answer(case) for case in mechanism.cases}
    solves = dict.fromkeys(entry.solve for entry in methods)
    return {solve: {name: exact.score(solve) for name, exact in answers.items()} for solve in solves}


def _row(entry: Entry, times: Mapping[Row, float], scores: Mapping[str, Score]) -> Measured:
    easy, *hard = scores.values()
    nanos = [times.get((entry.mechanism, entry.key, order)) for order in (0, 2)]
    assert nanos[0] is not None
    names = (entry.mechanism, entry.key, entry.name, entry.source)
    return Measured(*names, nanos[0], nanos[1], easy, together(hard), scores)


def this_machine() -> Machine:
    """Return the machine that this process runs on."""
    return Machine(_cpu(), os.cpu_count() or 1, platform.python_version(), np.__version__, _features())


def _features() -> tuple[str, ...]:
    built: Any = np.show_config(mode="dicts")
    return tuple(built.get("SIMD Extensions", {}).get("found", ()))


def _cpu() -> str:
    """Return the processor's name according to Linux, or else to Python."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, "") or platform.processor() or platform.machine()


# What was recorded of other methods, for the rows beside.

RECORDED = "recorded"
_OURS = ("linkanim", "synthesis")


def _recorded(mechanism: str, name: str, cells: Sequence[str], poses: tuple[int, int]) -> Measured:
    """Return a row of the manual's table; an error above 1 is infinite."""
    times = [float(cell.replace(",", "")) if cell else None for cell in cells[:2]]
    errors = [
        [math.inf if one == "> 1" else float(one) for one in cell.split(", ")] if cell[:4] != "none" else []
        for cell in cells[2:4]
    ]
    wrong, missing = (int(cell.replace(",", "")) for cell in cells[4:])
    easy, hard = ([*measured, math.nan, math.nan, math.nan] for measured in errors)
    scores = (
        Score(poses[0], easy[0], easy[1], easy[2], 0, 0),
        Score(poses[1], hard[0], hard[1], hard[2], wrong, missing),
    )
    assert times[0] is not None
    method = f"{name} ({RECORDED})"
    return Measured(mechanism, name, method, RECORDED, times[0], times[1], *scores, {})


# Where errors are worst, and each of them once more.

ORDERS = ("position", "velocity", "acceleration")


def _witness(name: str, what: str, error: float, at: Sequence[str]) -> str:
    return f"{what} {error:.1e}: linkanim bench --again {shlex.quote(name)} {' '.join(at)}"


def again(name: str, numbers: Sequence[float]) -> str:
    """Return once more the errors that a witness tells of, as text.

    BadInput for the name of nothing, or for too few numbers.
    """
    cases = {f"{kind.name}: {case.name}": case for kind in MECHANISMS for case in kind.cases}
    more = {work.name: work for work in further()}
    if name not in cases | more:
        raise BadInput(f"bench --again {name!r}: there are {', '.join(map(repr, [*cases, *more]))}")
    inputs = more[name].inputs if name in more else ("input",)
    if len(numbers) != len(inputs):
        raise BadInput(f"bench --again {name!r}: give {', '.join(inputs)} as hexadecimal floats")
    if name in more:
        (error,) = more[name].errors(np.array([numbers])).tolist()
        return f"error {error:.2e}"
    scored = answer(replace(cases[name], inputs=np.array(numbers))).score(batch)
    return ", ".join(f"{what} {error:.2e}" for what, error in zip(ORDERS, scored.errors, strict=True))


# The words and numbers of the table.

TITLES = (
    "method",
    "ns per pose",
    "with derivatives",
    "easy: position, velocity, acceleration",
    "hard",
    "wrong closure",
    "NaN",
)
NOTE = (
    "ns per pose: processor time, medians of runs in turn. Errors against 50 digits and more, the worst of "
    "all joints: positions in longest links, rates in longest links or the pose's largest rate, of poses on "
    "the right closure; wrong closure and NaN: of {poses} hard poses."
)

_BESIDE = "What is recorded was measured once, on the machine that `linkanim manual measurements` names."


FURTHER = ("beyond one linkage's poses", "ns each", "worst error")


def _time(nanos: float) -> str:
    return f"{nanos:,.1f}" if nanos < 100 else f"{float(f'{nanos:.3g}'):,.0f}"


def _errors(score: Score) -> str:
    """Return the errors of position and, if there are any, of rates; those above 1 are meaningless."""
    if math.isnan(score.error):
        return "none right"
    return ", ".join(
        "> 1" if error > 1 else f"{error:.1e}" for error in score.errors if not math.isnan(error)
    )
