"""Quantities as written, to radians, rad/s and the scene's unit."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from linkanim import units
from linkanim.errors import UnitError

mm = partial(units.length, unit="mm")

READ: list[tuple[str, Callable[[object], float], object, float]] = [
    # Multiples of a right angle are that many times pi/2, so that directions along them can be exact.
    ("right angle", units.angle, "90 deg", math.pi / 2),
    ("half turn", units.angle, "180 deg", math.pi),
    ("three quarters", units.angle, "270 deg", 3 * (math.pi / 2)),
    ("backwards", units.angle, "-90 deg", -math.pi / 2),
    ("full turn", units.angle, "360 deg", 2 * math.pi),
    # Spellings that people use.
    ("radians", units.angle, "1.5 rad", 1.5),
    ("no space", units.angle, "1.5rad", 1.5),
    ("degree sign", units.angle, "180°", math.pi),
    ("capitals", units.angular_speed, "60 RPM", 2 * math.pi),
    ("exponent", units.angle, "1e-3 rad", 1e-3),
    ("no leading digit", units.angle, "+.5 rad", 0.5),
    ("outer spaces", units.angle, "  2 rad ", 2.0),
    # Every unit once.
    ("rpm", units.angular_speed, "20 rpm", 2 * math.pi / 3),
    ("rad/s", units.angular_speed, "-10 rad/s", -10.0),
    ("deg/s", units.angular_speed, "180 deg/s", math.pi),
    ("rad/s^2", units.ANGULAR_ACCELERATION.read, "2 rad/s^2", 2.0),
    ("rad/s²", units.ANGULAR_ACCELERATION.read, "2 rad/s²", 2.0),
    ("deg/s^2", units.ANGULAR_ACCELERATION.read, "180 deg/s^2", math.pi),
    ("N/m", units.STIFFNESS.read, "4000 N/m", 4000.0),
    ("N/mm", units.STIFFNESS.read, "4 N/mm", 4000.0),
    ("N s/m", units.DAMPING.read, "200 N s/m", 200.0),
    ("N·s/m", units.DAMPING.read, "200 N·s/m", 200.0),
    ("N*s/m", units.DAMPING.read, "200 N*s/m", 200.0),
    ("kg", units.MASS.read, "3 kg", 3.0),
    ("g", units.MASS.read, "250 g", 0.25),
    ("t", units.MASS.read, "2 t", 2000.0),
    ("kg m^2", units.INERTIA.read, "0.02 kg m^2", 0.02),
    ("kg m²", units.INERTIA.read, "0.02 kg·m²", 0.02),
    ("kg cm^2", units.INERTIA.read, "200 kg cm^2", 0.02),
    ("kg mm^2", units.INERTIA.read, "350 kg mm2", 3.5e-4),
    ("g mm^2", units.INERTIA.read, "7 g mm^2", 7e-9),
    ("kN", units.FORCE.read, "-1.5 kN", -1500.0),
    ("N m", units.TORQUE.read, "-5 N·m", -5.0),
    ("N mm", units.TORQUE.read, "250 N mm", 0.25),
    ("m/s^2", units.FALL.read, "9.81 m/s²", 9.81),
    ("mm/s^2", units.FALL.read, "9810 mm/s^2", 9.81),
    ("mm from mm", mm, "30 mm", 30.0),
    ("mm from cm", mm, "3 cm", 30.0),
    ("mm from m", mm, "0.03 m", 30.0),
    ("mm from in", mm, "1 in", 25.4),
    # A bare length is in the scene's unit.
    ("bare length", mm, 30, 30.0),
    ("bare length as text", mm, "30", 30.0),
    ("negative length", mm, -0.5, -0.5),
    # A decimal is converted exactly: multiplied as floats these are one digit off in the last place.
    ("0.07 cm is 0.7 mm", mm, "0.07 cm", 0.7),
    ("0.57 cm is 5.7 mm", mm, "0.57 cm", 5.7),
    ("0.3 in is 7.62 mm", mm, "0.3 in", 7.62),
    # Below the smallest float there is only zero, however small the exponent says.
    ("underflow", mm, "1e-999999999 mm", 0.0),
]

REFUSED: list[tuple[str, Callable[[object], float], object, str]] = [
    # A bare number could be degrees or radians, rpm or rad/s: it is asked for, not guessed.
    ("bare angle", units.angle, 87, '"87 deg" or "87 rad"'),
    ("bare angle as text", units.angle, "87", '"87 deg" or "87 rad"'),
    ("bare zero", units.angle, 0, '"0 deg"'),
    ("bare speed", units.angular_speed, 20, '"20 rpm" or "20 rad/s" or "20 deg/s"'),
    ("bare acceleration", units.ANGULAR_ACCELERATION.read, 0.0, '"0.0 rad/s^2"'),
    ("bare stiffness", units.STIFFNESS.read, 4000, '"4000 N/m"'),
    ("bare damping", units.DAMPING.read, 200, '"200 N s/m"'),
    # The unit of another quantity, or of none.
    ("length as angle", units.angle, "30 mm", "deg, rad"),
    ("angle as speed", units.angular_speed, "30 deg", "rpm, rad/s, deg/s"),
    ("no such unit", mm, "3 furlong", "mm, cm, m, in"),
    ("two numbers", mm, "3 4 mm", "mm, cm, m, in"),
    # Not finite.
    ("nan", units.angle, "nan deg", "finite"),
    ("inf", units.angular_speed, "-inf rpm", "finite"),
    ("overflow", units.angular_speed, "1e999 rpm", "finite"),
    ("faster than anything turns", units.angular_speed, "1e9 rpm", "1e7 rpm"),
    ("as fast backwards", units.angular_speed, "-1.1e6 rad/s", "1e7 rpm"),
    ("nan float", mm, math.nan, "finite"),
    ("inf float", mm, math.inf, "finite"),
    ("bare inf", units.angle, math.inf, "finite"),
    ("beyond floats after conversion", mm, "1e308 m", "too large"),
    ("integer beyond floats", mm, 10**400, "too large"),
    ("integer beyond printing", mm, 16**9000, "too large"),
    # Not numbers. True is 1 to Python, but not to a reader.
    ("true", mm, True, "true is not a length"),
    ("false angle", units.angle, False, "false is not an angle"),
    ("empty", units.angle, "", "is not an angle"),
    ("a word", mm, "long", "is not a length"),
    ("digits with underscores", mm, "1_000", "is not a length"),
    ("a list", mm, [30], "is not a length"),
    ("nothing", units.angle, None, "is not an angle"),
]


@pytest.mark.parametrize(
    ("parse", "value", "expected"), [row[1:] for row in READ], ids=[row[0] for row in READ]
)
def test_a_quantity_is_read_to_the_last_bit(
    parse: Callable[[object], float], value: object, expected: float
) -> None:
    assert parse(value) == expected


@pytest.mark.parametrize(
    ("parse", "value", "message"), [row[1:] for row in REFUSED], ids=[row[0] for row in REFUSED]
)
def test_what_is_no_quantity_is_refused_with_what_would_be(
    parse: Callable[[object], float], value: object, message: str
) -> None:
    with pytest.raises(UnitError) as refusal:
        parse(value)
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(("unit", "expected"), [("mm", 0.001), ("cm", 0.01), ("m", 1.0), ("in", 0.0254)])
def test_a_metre_is_told_for_each_length_unit(unit: str, expected: float) -> None:
    assert units.metre(unit) == expected


def test_an_unknown_scene_unit_is_refused() -> None:
    with pytest.raises(UnitError, match="mm, cm, m, in"):
        units.metre("ft")


def test_a_message_stays_short_and_on_one_line_whatever_was_written() -> None:
    with pytest.raises(UnitError) as refusal:
        units.angle("x\n" * 5000)
    assert len(str(refusal.value)) < 200
    assert "\n" not in str(refusal.value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_float_written_in_radians_reads_back(value: float) -> None:
    assert units.angle(f"{value!r} rad") == value


@given(st.floats(-1e6, 1e6))
def test_degrees_agree_with_the_library(value: float) -> None:
    assert units.angle(f"{value!r} deg") == pytest.approx(math.radians(value), rel=4e-16, abs=5e-324)


@given(st.integers(-4000, 4000))
def test_quarter_turns_are_exact(quarters: int) -> None:
    assert units.angle(f"{90 * quarters} deg") == quarters * (math.pi / 2)


# On one line, in quotes where it is text, and never longer than a message can bear.
@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("6 rpm", '"6 rpm"'),
        ("x" * 60, f'"{"x" * 60}"'),
        ("x" * 61, f'"{"x" * 57}..."'),
        ("two\nlines\x1b", '"two?lines?"'),
        (True, "true"),
        (1.5, "1.5"),
        (10**59, "1" + 59 * "0"),
        (10**60, "1" + 56 * "0" + "..."),
        pytest.param(10**5000, "a number of thousands of digits", id="thousands of digits"),
    ],
)
def test_a_value_is_shown_short_and_on_one_line(value: object, text: str) -> None:
    assert units.shown(value) == text


@pytest.mark.parametrize(
    "number", ["30", "-107.47", "37.482910348571", "90", "360000012.3", "1e-9", "0.1", "0"]
)
@pytest.mark.parametrize("unit", ["deg", "rad"])
def test_an_angle_keeps_what_a_float_lacks_of_it(number: str, unit: str) -> None:
    angle = units.angle(f"{number} {unit}")
    with mp.workdps(50):
        true = mpf(number) * (mp.pi / 180 if unit == "deg" else 1)
        assert abs(mpf(float(angle)) + mpf(angle.rest) - true) <= abs(true) * mpf(10) ** -30


def test_angles_are_equal_where_all_their_digits_are() -> None:
    written, other = units.angle("30 deg"), units.angle(f"{math.radians(30)!r} rad")
    assert float(written) == float(other)
    assert written != other
    assert written == float(written)
    assert written == pickle.loads(pickle.dumps(written))
    assert pickle.loads(pickle.dumps(written)).rest == written.rest


# A float has no more digits: those that print after them say nothing.
@pytest.mark.parametrize(
    ("value", "text"),
    [
        (33.333, "33.33"),
        (12345.6, "12346"),
        (6e31, "6e+31"),
        (-6.25e15, "-6.25e+15"),
        (999_999_999_999_999.0, "9" * 15),
    ],
)
def test_a_large_number_is_not_told_in_digits_that_it_has_not(value: float, text: str) -> None:
    assert units.short(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (14800.0, "14800"),
        (-1234567.0, "−1235000"),
        (12345678.0, "1.235×10⁷"),
        (9999.6, "10000"),
        (0.0001, "0.0001"),
        (5.523e-05, "5.523×10⁻⁵"),
        (-5.5e-05, "−5.5×10⁻⁵"),
        (5e-10, "0"),
        (math.inf, "∞"),
    ],
)
def test_a_number_in_a_list_has_no_letter_for_its_power(value: float, text: str) -> None:
    assert units.four_digits(value) == text
