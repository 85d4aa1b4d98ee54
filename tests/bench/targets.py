"""What this project holds itself to, and whether a run of the benchmark reached it.

`python tests/bench/targets.py` measures and prints them; some minutes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from peers import entries

from linkanim.bench.questions import FOUR_BAR
from linkanim.bench.result import Measured, run
from linkanim.export import columns

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


def target_lines(targets: Sequence[Target]) -> list[Sequence[str]]:
    """Return the titles and a line for each target."""
    rows = [
        (
            target.what,
            f"{target.measured:.3g} {target.unit}",
            f"{'≥' if target.least else '≤'} {target.bound:g} {target.unit}",
            "met" if target.met else "missed",
        )
        for target in targets
    ]
    return [("target", "measured", "bound", ""), *rows]


if __name__ == "__main__":
    print(columns(target_lines(targets(run(rows=entries).rows))))
