"""The cases are what their names say, along the inputs that README counts."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from mpmath import workdps

from linkanim.bench.cases import EASY, HARD, TOGGLE, Case
from linkanim.bench.question import TURN, FourBarLengths, scene_of
from linkanim.bench.reference import DIGITS, ExactFourBar

NAMED = {case.name: case for case in HARD}
SEQUENCES = [case for case in HARD if "turns" not in case.name and "toggle" not in case.name]


def test_the_readme_counts_the_hard_poses() -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    assert f" of {sum(len(case.inputs) for case in HARD):,} hard poses" in readme


# Every degree from 90° on, and beside each half turn 1e-2 to 1e-12 before and after.
@pytest.mark.parametrize("case", SEQUENCES, ids=lambda case: case.name)
def test_a_sequence_covers_its_turns_and_what_lies_beside_each_half_turn(case: Case) -> None:
    end = 90 + 360 * case.periods
    near = 10.0 ** np.arange(-12, -1)
    beside = [np.radians(half) + side * near for half in range(180, end, 180) for side in (-1, 1)]
    expected = np.sort(np.concatenate([np.radians(np.arange(90, end)), *beside]))
    assert case.inputs == pytest.approx(expected, rel=0, abs=1e-14)


@pytest.mark.parametrize(("name", "turns"), [("after 1e6 turns", 1e6), ("after 1e9 turns", 1e9)])
def test_after_so_many_turns_comes_one_more(name: str, turns: float) -> None:
    case = NAMED[name]
    assert case.lengths == EASY.lengths
    # So near to a float of that size as it can be.
    assert case.inputs - turns * TURN == pytest.approx(EASY.inputs, abs=2**-53 * turns * TURN)


def test_a_toggle_is_approached_three_times_a_decade() -> None:
    before = -np.log10(TOGGLE - NAMED["1e-12 rad before a toggle"].inputs)
    assert before == pytest.approx(np.linspace(1, 12, 34), abs=1e-3)


# All bars lie in one line with the crank at 0, or at 180°, where ground and crank are as long as the others.
@pytest.mark.parametrize(
    ("name", "at_0", "at_180"),
    [
        ("parallelogram", True, True),
        ("antiparallelogram", True, True),
        ("change point at 0", True, False),
        ("change point at 180 deg", False, True),
        ("s + l = p + q in decimals", False, True),
        ("1e-12 from a change point", False, False),
        ("through two limits", False, False),
        ("double-rocker", False, False),
    ],
)
def test_a_change_point_is_where_the_name_says(name: str, at_0: bool, at_180: bool) -> None:
    with workdps(DIGITS):
        outer, first, second = ExactFourBar(NAMED[name].lengths).gaps
    assert (first * second == 0, outer == 0) == (at_0, at_180)


def test_lengths_that_are_decimals_up_to_their_rounding_are_at_the_change_point() -> None:
    with workdps(DIGITS):
        assert ExactFourBar((1.2, 0.3, 0.7, 0.8)).gaps[0] == 0
        assert ExactFourBar((1.2, 0.3, 0.7, 0.8 + 1e-15)).gaps[0] > 0


def test_lengths_are_what_the_names_say() -> None:
    for name, side in (("parallelogram", 1), ("antiparallelogram", -1)):
        ground, crank, coupler, rocker = NAMED[name].lengths
        assert (ground, crank, NAMED[name].side) == (coupler, rocker, side)
    shortest, *middle, longest = sorted(map(Fraction, NAMED["s + l = p + q in decimals"].lengths))
    assert shortest + longest == sum(middle)
    *bars, rocker = NAMED["1e-12 from a change point"].lengths
    assert (*bars, round(float(rocker) - 1e-12, 15)) == NAMED["change point at 180 deg"].lengths


# The range of the crank: between ± one limit, or between two on one side of the ground line.
@pytest.mark.parametrize(("name", "two"), [("through two limits", False), ("double-rocker", True)])
def test_a_swing_has_its_limits(name: str, two: bool) -> None:
    case = NAMED[name]
    limits = ExactFourBar(case.lengths).limits
    assert limits is not None
    assert (limits[0] > 0) == two
    assert (case.by_phase, case.turns) == (True, False)


def test_the_coupler_point_lies_half_along_the_coupler_and_a_quarter_to_its_left() -> None:
    scene = scene_of(FourBarLengths(100, 30, 90, 80), 1)
    pose = scene.pose(0.0)
    a, b, p = (complex(*pose.position[name]) for name in "ABP")
    assert p == pytest.approx(a + (b - a) * (0.5 + 0.25j))
    assert scene.linkage.drive.speed == 1.0
