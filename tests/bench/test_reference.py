"""The answers of many digits close their loops, on the closure asked for, along one smooth path."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.questions import FOUR_BAR, MECHANISMS, Case, CaseSet, SlideStep, chain_of, degrees
from linkanim.bench.reference import DIGITS, CasePath, answer, crossing
from linkanim.mechanics.linkage import RRR

CASES = [
    pytest.param(case, id=f"{mechanism.name}, {case.name}")
    for mechanism in MECHANISMS
    for case in mechanism.cases
]
SMOOTH = [
    case for mechanism in MECHANISMS for case in mechanism.hard if not case.by_angle and case.inputs[0] < 100
]


@pytest.mark.parametrize("case", CASES)
def test_the_bars_have_their_lengths(case: Case) -> None:
    with workdps(DIGITS):
        path = CasePath(case)
        # Where two circles touch, half the digits go into the root.
        tolerance = mpf(10) ** (3 - DIGITS // 2)
        for given in case.inputs[::293].tolist():
            at = path.pose(mpf(given))
            for dyad, (a, b) in _dyads(case):
                for place in (at[dyad.name], path.others(at)[dyad.name]):
                    if isinstance(dyad, RRR):
                        p, q = (at[end] for end in dyad.ends)
                        assert abs(abs(place - p) - a) < tolerance * a
                        assert abs(abs(place - q) - b) < tolerance * b
                    else:
                        assert abs(abs(place - at[dyad.end]) - a) < tolerance * a


def _dyads(case: Case) -> Any:
    for dyad in chain_of(case.scene.linkage).dyads:
        lengths = (dyad.length, 0.0) if isinstance(dyad, SlideStep) else dyad.lengths
        yield dyad, tuple(mpf(repr(length)) if case.decimal else mpf(length) for length in lengths)


@pytest.mark.thinned(3)
@pytest.mark.parametrize("case", SMOOTH, ids=lambda case: case.name)
def test_the_path_has_no_jump(case: Case) -> None:
    # A jump to the other closure, even where they are a degree apart, would be a step like none beside it.
    inputs = np.radians(np.arange(60.0, 60.0 + 360 * case.periods, 6.0))
    found = answer(replace(case, inputs=inputs.astype(np.float64)))
    for place in found.orders[0].values():
        assert np.abs(np.diff(place.high)).max() < 12 * found.question.longest * (inputs[1] - inputs[0])


@pytest.mark.parametrize("mechanism", MECHANISMS, ids=lambda mechanism: mechanism.name)
def test_rates_are_those_of_the_places(mechanism: CaseSet) -> None:
    step = 1e-4
    inputs = np.array([1.0, 1.0 + step, 1.0 + 2 * step])
    found = answer(replace(mechanism.easy, inputs=inputs))
    for name in found.question.shown:
        place, rate, second = (order[name].high for order in found.orders)
        longest = found.question.longest
        assert abs((place[2] - place[0]) / (2 * step) - rate[1]) < 1e-6 * longest
        assert abs((place[2] - 2 * place[1] + place[0]) / step**2 - second[1]) < 1e-5 * longest


@pytest.mark.parametrize("case", SMOOTH, ids=lambda case: case.name)
def test_the_path_is_back_after_its_period(case: Case) -> None:
    found = answer(replace(case, inputs=np.array([1.7, 1.7 + 2 * np.pi * case.periods])))
    for exact in found.orders[0].values():
        assert abs(exact.high[1] - exact.high[0]) < 1e-13 * found.question.longest


def test_circles_of_3_and_4_that_are_5_apart_cross_at_a_right_angle() -> None:
    for side in (1, -1):
        found: Any = crossing(mpc(0), mpc(5), mpf(3), mpf(4), side)
        assert complex(found) == pytest.approx(complex(9 / 5, side * 12 / 5), abs=1e-15)


def test_the_low_part_holds_what_rounding_left() -> None:
    case = replace(FOUR_BAR.easy, inputs=np.array([1.0]))
    found = answer(case).orders[0]["B"]
    with workdps(DIGITS):
        pose = CasePath(case).pose(mpf(1.0))
        rest = pose["B"] - mpc(complex(found.high[0])) - mpc(complex(found.low[0]))
    assert abs(complex(rest)) < 1e-29
    assert 0 < abs(found.low[0]) < 1e-14


def test_a_crank_turns_at_one_radian_for_a_radian() -> None:
    found = answer(replace(FOUR_BAR.easy, inputs=degrees(0, 3)))
    place, rate, second = (order["A"].high for order in found.orders)
    assert rate == pytest.approx(1j * place)
    assert second == pytest.approx(-place)
    assert found.question.rates[0].tolist() == [1.0] * 3
    assert np.abs(found.question.rates[1]).max() < 1e-30
    assert float(mp.fabs(found.question.longest)) == 100.0
