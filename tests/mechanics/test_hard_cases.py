"""Cranks that bars stop: 16 last digits of places and 64 of rates, by phase and by angle, near limits too."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random
from typing import Any

import numpy as np
import pytest
from hard_cases import (
    DIGITS,
    EPS,
    GUIDED,
    KINDS,
    Guided,
    Make,
    by_angle,
    by_phase,
    guided_by_angle,
    meet,
    placed,
    swinging,
)
from mpmath import mp, mpf
from reference import unit

from linkanim.scenes.reading import scene_from

POSITION, RATE = 16, 64


@pytest.fixture(autouse=True)
def many_digits() -> Iterator[None]:
    with mp.workdps(DIGITS):
        yield


def check(make: Make, count: int, seed: int) -> None:
    for (bars, solved), _ in zip(swinging(make, seed), range(count), strict=False):
        for error in (by_phase(bars, solved), by_angle(bars, solved)):
            assert error.position <= POSITION, bars
            assert error.rate <= RATE, bars


@pytest.mark.parametrize("make", KINDS, ids=lambda make: make.__name__)
def test_random_cranks_within_their_limits_are_right_to_the_last_digits(make: Make) -> None:
    check(make, 10, 0)


@pytest.mark.long
@pytest.mark.parametrize("make", KINDS, ids=lambda make: make.__name__)
def test_a_thousand_random_cranks_within_their_limits_are_right_to_the_last_digits(make: Make) -> None:
    check(make, 1000, 100)


def check_guided(make: Callable[[Random], Guided], count: int, seed: int) -> None:
    for (guided, solved), _ in zip(swinging(make, seed), range(count), strict=False):
        error = guided_by_angle(guided, solved)
        assert error.position <= POSITION, guided
        assert error.rate <= RATE, guided


@pytest.mark.parametrize("make", GUIDED, ids=lambda make: make.__name__)
@pytest.mark.slow
def test_random_sliders_slots_and_chains_are_right_up_to_their_limits(
    make: Callable[[Random], Guided],
) -> None:
    check_guided(make, 6, 0)


@pytest.mark.long
@pytest.mark.parametrize("make", GUIDED, ids=lambda make: make.__name__)
def test_a_thousand_random_sliders_slots_and_chains_are_right_up_to_their_limits(
    make: Callable[[Random], Guided],
) -> None:
    check_guided(make, 1000, 100)


KITE = (9.73418612386483, 9.73418612386874, 5.03669098034689, 5.036690980347538)


@pytest.mark.parametrize("tilt", ["0", "164", "-17.143360736465"])
@pytest.mark.parametrize("rocker", [False, True], ids=["at the crank", "at the rocker"])
def test_in_the_middle_of_a_swing_pins_4e_12_apart_give_the_last_digits(tilt: str, rocker: bool) -> None:
    ground, *lengths = KITE
    bars = placed(Random(1), (ground, tilt), *lengths, rocker=rocker)
    solved = scene_from(bars.document, name="kite", where="kite").mechanism
    for error in (by_phase(bars, solved), by_angle(bars, solved)):
        assert error.position <= POSITION
        assert error.rate <= RATE


# Bars so nearly alike that they fold over each other to a tenth of their length: what the joint that they
# stand on is rounded by, two last digits, they magnify by as much.
FOLDED: dict[str, Any] = {
    "drive": {"joint": "A", "start": "105.9 deg"},
    "ground": {"O2": [-0.43, 3.66], "O4": [-2.23, 4.39], "S": [5.58, -0.66]},
    "joints": {
        "A": {"crank": "O2", "length": 6.491},
        "B": {"from": ["A", "O4"], "length": [4.76, 6.036], "side": "right"},
        "C": {"on": ["A", "B"], "at": [2.93, -3.58]},
        "J": {"from": ["C", "S"], "length": [5.282, 5.89], "side": "left"},
    },
}


def test_bars_that_nearly_fold_over_each_other_magnify_two_last_digits_and_no_more() -> None:
    solved = scene_from(FOLDED, name="folded", where="folded").mechanism
    first, last = (mp.mpc(*FOLDED["ground"][name]) for name in ("O4", "S"))
    low, high = solved.input_range

    def place(angle: Any) -> Any:
        a = mp.mpc(-0.43, 3.66) + mpf(6.491) * unit(angle)
        along = meet(a, first, (4.76, 6.036), -1) - a
        return meet(a + mp.mpc(2.93, -3.58) * along / abs(along), last, (5.282, 5.89), 1)

    angles = [low + (high - low) * share for share in (1e-8, 1e-6, 1e-4, 0.01, 0.5, 0.99)]
    found = solved.solve(angle=np.array(angles), derivatives=0, speed=1.0)
    for angle, c, j in zip(angles, found.position["C"], found.position["J"], strict=True):
        magnified = max(5.89 / float(abs(mp.mpc(*c) - last)), 1.0)
        assert abs(mp.mpc(*j) - place(mpf(angle))) <= 2 * magnified * EPS * 5.89, angle
