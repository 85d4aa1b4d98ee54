"""A result made by hand, for the tests of what is made of one."""

from __future__ import annotations

from datetime import date
from math import inf, nan

from linkanim.bench.reference import Score
from linkanim.bench.result import Machine, Measured, Result

EASY = Score(360, 3e-16, 4e-16, 5e-16, 0, 0)
HARD = Score(5198, 8.5e-16, inf, 2.0, 0, 0)
LOST = Score(5198, nan, nan, nan, 5000, 198)


def row(
    key: str,
    position: float,
    derivatives: float | None = None,
    hard: Score = HARD,
    easy: Score = EASY,
    mechanism: str = "four-bar",
) -> Measured:
    cases = {"a hard case": hard}
    return Measured(mechanism, key, f"{key} by name", "somewhere", position, derivatives, easy, hard, cases)


def result() -> Result:
    few = Score(360, 1e-12, nan, nan, 0, 0)
    rows = (
        row("batch", 9.31, 22.5),
        row("newton 1", 1604.0, hard=LOST),
        row("batch", 20.0, 40.0, mechanism="press", easy=few),
    )
    return Result(Machine("A processor", 2, "3.11.7", "2.4.6", ("X86_V3",)), rows, date(2026, 11, 28))
