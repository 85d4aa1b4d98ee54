"""Targets: their figures, their bounds, and on which side of them a run is."""

from __future__ import annotations

import math

import pytest
from made_result import row
from targets import Target, target_lines, targets

from linkanim.bench.reference import Score


def test_a_line_says_what_was_measured_and_whether_that_will_do() -> None:
    made = Target("positions", 9.31, 15.0, "ns"), Target("times faster", 9.0, 10.0, "×", least=True)
    assert target_lines(made)[1:] == [
        ("positions", "9.31 ns", "≤ 15 ns", "met"),
        ("times faster", "9 ×", "≥ 10 ×", "missed"),
    ]


# On the bound a target is met, past it missed, and without a figure missed, too.
@pytest.mark.parametrize(
    ("measured", "least", "met"),
    [
        (15.0, False, True),
        (15.1, False, False),
        (15.0, True, True),
        (14.9, True, False),
        (math.nan, False, False),
        (math.nan, True, False),
    ],
)
def test_a_target_is_met_up_to_its_bound(measured: float, least: bool, met: bool) -> None:
    assert Target("a figure", measured, 15.0, "ns", least=least).met == met


# What a target says of the rows below, and its bound.
TARGETS = {
    "positions, 10,000 at once": (10.0, "≤", 15.0),
    "with derivatives, 10,000 at once": (32.0, "≤", 35.0),
    "positions, 1,000,000 to 10,000 at once": (2.0, "≤", 1.6),
    "positions, one pose a call": (2.0, "≤", 2.5),
    "pylinkage's time to ours: positions, 10,000 at once": (15.0, "≥", 12.0),
    "pylinkage's time to ours: with derivatives, 10,000 at once": (21.5, "≥", 20.0),
    "pylinkage's time to ours: positions, one pose a call": (2.5, "≥", 2.0),
    "hard cases, positions": (pytest.approx(3.0), "≤", 16.0),
    "hard cases, velocities": (pytest.approx(5.0), "≤", 64.0),
    "hard cases, accelerations": (math.inf, "≤", 64.0),
}


def test_each_target_has_its_figure_and_its_bound() -> None:
    eps = 2.0**-52
    exact, other = (Score(1, *errors, 0, 0) for errors in ((eps, 5 * eps, eps), (3 * eps, eps, math.inf)))
    rows = (
        row("batch", 10.0, 32.0, exact),
        row("batch, many", 20.0, 40.0),
        row("single", 2000.0, 8000.0, exact),
        row("pylinkage", 150.0, 688.0),
        row("pylinkage, many", 160.0, 720.0),
        row("pylinkage step", 5000.0, 14000.0),
        row("batch", 10.0, 32.0, other, mechanism="press"),
    )
    found = {
        target.what: (target.measured, "≥" if target.least else "≤", target.bound) for target in targets(rows)
    }
    assert {what: found[what] for what in TARGETS} == TARGETS
