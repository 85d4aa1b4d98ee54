"""A result made by hand, for the tests of what is made of one."""

from __future__ import annotations

from linkanim.bench.accuracy import Score
from linkanim.bench.machine import Machine
from linkanim.bench.result import Measured, Result, Target

EASY = Score(360, 3e-16, 0, 0)
HARD = Score(5198, 8.5e-16, 0, 0)
LOST = Score(5198, float("nan"), 5000, 198)


def row(key: str, position: float, derivatives: float | None = None, hard: Score = HARD) -> Measured:
    return Measured(
        key, f"{key} by name", "somewhere", position, derivatives, EASY, hard, {"a hard case": hard}
    )


def result(features: tuple[str, ...] = ("X86_V3",)) -> Result:
    rows = (row("batch", 9.31, 22.5), row("newton 1", 1604.0, hard=LOST))
    targets = (
        Target("positions", 9.31, 15.0, "ns"),
        Target("times faster", 9.0, 10.0, "×", least=True),
    )
    return Result(Machine("A processor", 2, "3.11.7", "2.4.6", features), rows, targets)
