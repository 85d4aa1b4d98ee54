"""Axes: ranges that hold the values, and few ticks at round numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkanim.picture.quantities import around, linear, zeros_level


@pytest.mark.parametrize(
    ("low", "high", "most", "unit", "labels"),
    [
        (0, 300, 3, "", ["0", "100", "200", "300"]),
        (-1, 1, 4, "", ["−1.0", "−0.5", "0.0", "0.5", "1.0"]),
        (0.013, 0.021, 4, "", ["0.014", "0.016", "0.018", "0.020"]),
        (-3e7, 2e7, 3, "", ["−2e+07", "0", "2e+07"]),
        # degrees are cut at parts of a turn
        (0, 360, 8, "°", ["0°", "45°", "90°", "135°", "180°", "225°", "270°", "315°", "360°"]),
        (0, 720, 8, "°", ["0°", "90°", "180°", "270°", "360°", "450°", "540°", "630°", "720°"]),
        (0, 7200, 8, "°", ["0°", "1080°", "2160°", "3240°", "4320°", "5400°", "6480°"]),
        (20, 130, 3, "°", ["45°", "90°"]),
        (1, 4, 3, "°", ["1°", "2°", "3°", "4°"]),
    ],
)
def test_ticks_are_few_and_round(low: float, high: float, most: int, unit: str, labels: list[str]) -> None:
    assert [label for _, label in linear(low, high, most=most, unit=unit).ticks] == labels


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6), st.integers(2, 8))
def test_there_are_never_too_many_ticks_and_all_lie_on_the_axis(low: float, span: float, most: int) -> None:
    axis = linear(low, low + span, most=most)
    assert 0 < len(axis.ticks) <= most + 1 or len(axis.ticks) == 0 < most
    assert all(-1e-6 <= axis.share(value) <= 1 + 1e-6 for value, _ in axis.ticks)


@pytest.mark.parametrize(
    ("values", "low", "high"),
    [
        ([1.0, 2.0], 0.94, 2.06),
        # a quantity that does not move, at zero and elsewhere
        ([0.0, 0.0], -1.12, 1.12),
        ([5.0, 5.0], 2.2, 7.8),
        ([5.0, 5.0 + 1e-12], 2.2, 7.8),
        # nothing finite at all
        ([math.inf, math.nan], -0.06, 1.06),
        # infinite values have no say
        ([1.0, 2.0, math.inf], 0.94, 2.06),
    ],
)
def test_the_range_holds_the_finite_values_with_a_little_room(
    values: list[float], low: float, high: float
) -> None:
    axis = around(np.array(values))
    assert (axis.low, axis.high) == pytest.approx((low, high))


def test_a_wild_peak_is_cut_so_that_the_rest_can_be_seen() -> None:
    values = np.sin(np.linspace(0, 6, 100))
    values[50] = 1e9
    assert around(values).high < 10
    assert around(1e-4 * values).high < 1e-3
    values[50] = 5.0
    assert around(values).high > 5


# Below and above zero, each; how many times both are stretched.
@pytest.mark.parametrize(
    ("one", "other", "stretched"),
    [
        ((-1.0, 1.0), (-30.0, 30.0), 1.0),
        ((-1.0, 3.0), (-30.0, 10.0), 1.5),
        ((-30.0, 10.0), (-1.0, 3.0), 1.5),
        # one that hardly falls below zero, beside one that hardly rises above it
        ((-0.01, 0.99), (-99.0, 1.0), 1.98),
    ],
)
def test_two_ranges_have_their_zeros_level_and_hold_what_they_held(
    one: tuple[float, float], other: tuple[float, float], stretched: float
) -> None:
    ranges = zeros_level([one, other])
    heights = [-low / (high - low) for low, high in ranges]
    assert heights[0] == pytest.approx(heights[1])
    for (low, high), (least, most) in zip(ranges, (one, other), strict=True):
        assert low <= least + 1e-12 * abs(least)
        assert high >= most * (1 - 1e-12)
        assert high - low == pytest.approx(stretched * (most - least))
