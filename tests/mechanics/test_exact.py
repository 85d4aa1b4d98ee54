"""Sums of two floats hold twice the digits; angles that stand for right angles are right."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from linkanim.mechanics.angles import (
    FULL_TURN,
    HALF_TURN,
    Sum,
    exact_angle,
    gap,
    quarter_turns,
    two_product,
    two_sum,
    unit,
)

floats = st.floats(-1e100, 1e100, allow_subnormal=False)


@given(floats, floats)
@pytest.mark.slow
def test_a_sum_and_what_it_lost_are_exactly_the_sum(a: float, b: float) -> None:
    total, lost = two_sum(a, b)
    assert Fraction(total) + Fraction(lost) == Fraction(a) + Fraction(b)


@given(st.floats(1e-50, 1e50), st.floats(1e-50, 1e50))
def test_a_product_and_what_it_lost_are_exactly_the_product(a: float, b: float) -> None:
    product, lost = two_product(a, b)
    assert Fraction(product) + Fraction(lost) == Fraction(a) * Fraction(b)


@pytest.mark.parametrize(
    ("value", "exact"), [(HALF_TURN, 1), (FULL_TURN, 2), (quarter_turns(-3), Fraction(-3, 2))]
)
def test_turns_are_right_to_thirty_digits(value: Sum, exact: Fraction) -> None:
    with mp.workdps(50):
        truth = mp.pi * exact.numerator / exact.denominator
        assert abs(mpf(value.high) + mpf(value.low) - truth) < mpf(10) ** -31


RIGHT = [(0.0, (1, 0)), (90.0, (0, 1)), (180.0, (-1, 0)), (270.0, (0, -1)), (-90.0, (0, -1)), (720.0, (1, 0))]


@pytest.mark.parametrize(("degrees", "direction"), RIGHT)
def test_right_angles_point_exactly_along_the_axes(degrees: float, direction: tuple[float, float]) -> None:
    assert unit(math.radians(degrees)) == direction


def test_any_other_angle_is_left_as_it_is() -> None:
    assert exact_angle(1.0) == Sum(1.0)
    assert unit(1.0) == (math.cos(1.0), math.sin(1.0))
    beside = math.nextafter(math.pi / 2, 0)
    assert unit(beside)[0] == pytest.approx(math.cos(beside), abs=1e-28)


# s + l = p + q in decimals, off by a last digit in binary; and real gaps that must stay.
GAPS = [
    ((0.1, 0.5, -0.2, -0.4), True),
    ((0.3, 0.6, -0.7, -0.2), True),
    ((3 + 1e-12, 4, -5, -2), False),
    ((1e-9, 1, -1), False),
]


@pytest.mark.parametrize(("lengths", "none"), GAPS)
def test_a_gap_below_what_the_lengths_can_tell_is_none(lengths: tuple[float, ...], none: bool) -> None:
    assert (gap(*lengths) == 0) is none
