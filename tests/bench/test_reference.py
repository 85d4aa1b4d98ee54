"""The fifty-digit answers close their loops, on the closure asked for, along one smooth path."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.cases import EASY, HARD, TOGGLE, Case
from linkanim.bench.reference import DIGITS, ExactFourBar, answer, closures, crossing

CASES = (EASY, *HARD)
SMOOTH = [case for case in CASES if case.name != "1e-12 rad before a toggle"]
# A float holds the period of so many turns to 1e-7 only.
FEW_TURNS = [case for case in SMOOTH if case.inputs[0] < 100]
# Turned by less than half a turn at the first input, the closure is still the one just after 0.
JUST_BEGUN = [case for case in CASES if 0 < case.inputs[0] < np.pi]


def named(case: Case) -> str:
    return case.name


@pytest.mark.parametrize("case", CASES, ids=named)
def test_the_bars_have_their_lengths(case: Case) -> None:
    with workdps(DIGITS):
        ground, crank, coupler, rocker = (mpf(length) for length in case.lengths)
        # Where two circles touch, half the digits go into the root.
        tolerance = mpf(10) ** (3 - DIGITS // 2)
        for pose in closures(case):
            a = crank * mp.expj(pose.angle)
            for b in (pose.b, pose.other_b):
                assert abs(abs(b - a) - coupler) < tolerance * ground
                assert abs(abs(b - ground) - rocker) < tolerance * ground


@pytest.mark.parametrize("case", CASES, ids=named)
def test_the_two_closures_mirror_each_other_in_the_line_of_centres(case: Case) -> None:
    with workdps(DIGITS):
        _, crank, *_ = lengths = [mpf(length) for length in case.lengths]
        for pose in closures(case):
            a = crank * mp.expj(pose.angle)
            way = (lengths[0] - a) / abs(lengths[0] - a)
            one, other = ((b - a) / way for b in (pose.b, pose.other_b))
            assert abs(one - other.conjugate()) < mpf(10) ** (3 - DIGITS // 2) * max(lengths)


@pytest.mark.parametrize("case", SMOOTH, ids=named)
def test_the_path_has_no_jump(case: Case) -> None:
    # A jump to the other closure, even where they are a degree apart, would be a step like none beside it.
    found = answer(case)
    time = case.inputs
    for exact in (found.b, found.p):
        speed = np.abs(np.diff(exact.high)) / np.diff(time)
        assert speed.max() < 12 * found.question.bars.longest


@pytest.mark.parametrize("case", FEW_TURNS, ids=named)
def test_the_path_is_back_after_its_period(case: Case) -> None:
    ends = np.array([1.7, 1.7 + 2 * np.pi * case.periods])
    found = answer(replace(case, inputs=ends)).b.high
    assert abs(found[1] - found[0]) < 1e-13 * 100


# Where the closure asked for lies: B left or right of the way from A to O4, at the first input.
@pytest.mark.parametrize("case", JUST_BEGUN, ids=named)
def test_it_starts_on_the_closure_named(case: Case) -> None:
    question = answer(case).question
    a = question.bars.crank * np.exp(1j * question.angles[0])
    turn = ((question.start - a) * np.conj(question.bars.ground - a)).imag
    assert np.sign(turn) == case.side


def test_circles_of_3_and_4_that_are_5_apart_cross_at_a_right_angle() -> None:
    for side in (1, -1):
        found: Any = crossing(mpc(0), mpc(5), mpf(3), mpf(4), side)
        assert complex(found) == pytest.approx(complex(9 / 5, side * 12 / 5), abs=1e-15)


def test_the_limits_are_where_the_bars_are_in_line() -> None:
    limits = ExactFourBar((5, 4, 3, "3.5")).limits
    assert limits is not None
    low, high = limits
    assert low == -high
    assert float(high) == pytest.approx(TOGGLE, abs=1e-15)


# The way between them lies about the ground line, about its far side, or above or below it.
@pytest.mark.parametrize(
    ("lengths", "start", "least", "most"),
    [
        pytest.param((5, 4, 3, "3.5"), 0, -np.pi, np.pi, id="stretched at both"),
        pytest.param((4, 3, 6, 2), 0, 0, 2 * np.pi, id="folded at both"),
        pytest.param((5, "3.5", 2, 4), 1, 0, np.pi, id="one of each, above"),
        pytest.param((5, "3.5", 2, 4), -1, -np.pi, 0, id="one of each, below"),
    ],
)
def test_between_the_limits_the_bars_reach(lengths: Any, start: int, least: float, most: float) -> None:
    bars = ExactFourBar(lengths, start=start)
    ground, crank, coupler, rocker = map(float, lengths)
    assert bars.limits is not None
    low, high = map(float, bars.limits)
    assert least < low < high < most
    within = np.abs(ground - crank * np.exp(1j * np.linspace(low + 1e-6, high - 1e-6, 9)))
    assert (np.abs(coupler - rocker) < within).all()
    assert (within < coupler + rocker).all()
    for limit in (low, high):
        apart = abs(ground - crank * np.exp(1j * limit))
        assert min(abs(apart - coupler - rocker), abs(apart - abs(coupler - rocker))) < 1e-14 * ground


def test_the_low_part_holds_what_rounding_left() -> None:
    found = answer(replace(EASY, inputs=np.array([1.0])))
    with workdps(DIGITS):
        (pose,) = closures(replace(EASY, inputs=np.array([1.0])))
        rest = pose.b - mpc(complex(found.b.high[0])) - mpc(complex(found.b.low[0]))
    assert abs(complex(rest)) < 1e-29
    assert 0 < abs(found.b.low[0]) < 1e-14
