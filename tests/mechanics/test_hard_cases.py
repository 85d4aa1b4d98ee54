"""Cranks that bars stop: 16 last digits of places and 64 of rates, by phase and by angle, near limits too."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random

import pytest
from hard_cases import DIGITS, GUIDED, KINDS, Guided, Make, by_angle, by_phase, guided_by_angle, swinging
from mpmath import mp

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
