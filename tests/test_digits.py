"""Numbers as people read them."""

from __future__ import annotations

import math

import pytest

from linkanim.units import degrees, rounded, rpm, short, significant, stepped, three_digits, typeset


@pytest.mark.parametrize(
    ("value", "digits", "words"),
    [
        (123.456789, 7, "123.4568"),
        (0.1, 7, "0.1"),
        (-0.0, 7, "0"),  # never "-0"
        (-2.5, 4, "-2.5"),  # ASCII: a column can be read back
        (math.inf, 7, "unbounded"),
        (-math.inf, 7, "unbounded"),
        (math.nan, 7, "-"),
    ],
)
def test_significant_digits(value: float, digits: int, words: str) -> None:
    assert significant(value, digits) == words


@pytest.mark.parametrize(
    ("value", "digits", "words"),
    [
        (1.2, 4, "1.200"),  # noughts are digits
        (-54.0, 4, "−54.00"),
        (24563.7, 4, "24560"),
        (9999.6, 4, "10000"),
        (0.0123456, 4, "0.01235"),
        (1.23456e-5, 4, "1.235×10⁻⁵"),
        (84_100_000.0, 3, "8.41×10⁷"),
        (123456789.123, 12, "123456789.123"),
        (-0.0, 4, "0"),
        (math.inf, 4, "∞"),
        (-math.inf, 4, "−∞"),
        (math.nan, 4, "–"),
    ],
)
def test_a_rounded_number_has_all_its_digits(value: float, digits: int, words: str) -> None:
    assert rounded(value, digits) == words


@pytest.mark.parametrize(
    ("value", "words"),
    [(33.3333333, "33.33"), (25.0, "25"), (12345.6, "12346"), (-12345.6, "-12346"), (-0.0, "0")],
)
def test_a_short_number_has_no_exponent_where_it_is_large(value: float, words: str) -> None:
    assert short(value) == words


@pytest.mark.parametrize(
    ("speed", "words"),
    [(2 * math.pi / 3, "20 rpm"), (-math.pi / 2, "-15 rpm"), (1.0, "9.549 rpm"), (0.0, "0 rpm")],
)
def test_speed_is_told_in_turns_a_minute(speed: float, words: str) -> None:
    assert rpm(speed) == words


@pytest.mark.parametrize(
    ("angle", "words"),
    [(math.pi / 2, "90°"), (-1.0, "−57.3°"), (-0.0, "0°"), (math.radians(87.456), "87.46°")],
)
def test_an_angle_is_told_in_degrees(angle: float, words: str) -> None:
    assert degrees(angle) == words


@pytest.mark.parametrize(
    ("value", "step", "text"),
    [
        (-0.04, 0.1, "0.0"),  # never "-0.0"
        (-12.34, 0.1, "−12.3"),
        (1234.5, 100, "1234"),
        (2.5e6, 1e6, "2.5e+06"),
        (3e-5, 1e-5, "3e−05"),
        (math.inf, 1, "∞"),
        (-math.inf, 1, "−∞"),
        (math.nan, 1, "–"),
    ],
)
def test_numbers_have_the_decimals_their_steps_need(value: float, step: float, text: str) -> None:
    assert stepped(value, step) == text


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (123.456, "123"),
        (12.3456, "12.3"),
        (0.01234, "0.0123"),
        (123456.0, "123456"),
        (1.5e6, "1.50e+06"),
        (1e-5, "1.00e-05"),
    ],
)
def test_numbers_keep_three_digits(value: float, words: str) -> None:
    assert three_digits(value) == words


def test_a_set_text_has_true_minus_signs() -> None:
    assert typeset("-15 rpm … -3e-05") == "−15 rpm … −3e−05"


def test_a_number_too_large_or_small_for_decimals_has_three_digits() -> None:
    assert stepped(1234567.0, 1.0) == "1.23e+06"
    assert stepped(-1.2345e-5, 1e-6) == "−1.23e−05"


# What the last digits of a limit leave of nothing: a drag was answered with −6.986e-14°.
@pytest.mark.parametrize(
    ("angle", "words"),
    [(-1.2193e-15, "0°"), (1e-33, "0°"), (0.0, "0°"), (1e-9, "5.73e−08°"), (math.pi, "180°")],
)
def test_no_angle_is_what_rounding_leaves_of_none(angle: float, words: str) -> None:
    assert degrees(angle) == words
