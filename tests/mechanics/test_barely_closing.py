"""Dyads that barely close: 16 last digits of places and 32 of rates beside there, by phase and by angle."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from barely_closing import by_angle, by_phase, dyads_that_barely_close
from hard_cases import DIGITS
from mpmath import mp

POSITION, RATE = 16, 32


@pytest.fixture(autouse=True)
def many_digits() -> Iterator[None]:
    with mp.workdps(DIGITS):
        yield


def check(count: int, seed: int) -> None:
    for case, _ in zip(dyads_that_barely_close(seed), range(count), strict=False):
        for error in (by_phase(case), by_angle(case)):
            assert error.position <= POSITION, case
            assert error.rate <= RATE, case


@pytest.mark.slow
def test_random_dyads_that_barely_close_are_right_to_the_last_digits() -> None:
    check(2, 7)


@pytest.mark.long
def test_a_thousand_dyads_that_barely_close_are_right_to_the_last_digits() -> None:
    check(1000, 100)
