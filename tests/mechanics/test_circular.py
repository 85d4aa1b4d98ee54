"""Sines and cosines of our own: within a few last digits of the true ones, from floats and arrays alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

from linkanim.mechanics.angles import (
    PI_PARTS,
    Half,
    cosine_within,
    direction,
    half_angle,
    reduced,
    sharp_half_angle,
    sharply_reduced,
    signed_half_angle,
    sine_within,
    tangent,
)
from linkanim.mechanics.arithmetic import Value, nearest_whole

EPS = 2.0**-52
RANDOM = np.random.default_rng(10)
TURN = 2 * math.pi
WITHIN_A_TURN = RANDOM.uniform(-TURN, TURN, 500).tolist()
NEAR_ZEROS = [k * math.pi + s * 10.0**-p for k in range(-4, 5) for s in (-1, 1) for p in (3, 6, 9, 12)]
FAR = [turns * TURN + x for turns in (1e3, 1e6, 1e9) for x in WITHIN_A_TURN[:60]]
ANGLES = [*WITHIN_A_TURN, *NEAR_ZEROS, *FAR, 0.0, math.pi, 2 * TURN]


@pytest.fixture(autouse=True)
def fifty_digits() -> Any:
    with mp.workdps(50):
        yield


def plain(found: Value) -> float:
    """The value as the float that it is when only floats went in."""
    assert isinstance(found, float)
    return found


def units(found: Value, true: Any, *, of: Any = 1) -> float:
    """The error in units of 2⁻⁵² of a size."""
    return float(abs(mpf(plain(found)) - true) / abs(of)) / EPS


def test_pi_is_the_sum_of_its_parts_and_all_but_the_last_are_short() -> None:
    total = sum(mpf(part) for part in PI_PARTS)
    assert abs(total - mp.pi) < mpf(2) ** -94
    for part in PI_PARTS[:3]:
        assert part.as_integer_ratio()[0].bit_length() <= 21


def test_the_tangent_is_good_to_its_last_digit_but_one() -> None:
    angles = [*RANDOM.uniform(-math.pi, math.pi, 3000).tolist(), math.pi, -math.pi, 1e-9]
    errors = []
    for angle in angles:
        true = 4 * mp.tan(mpf(angle) / 4)
        errors.append(units(tangent(angle, 4.0), true, of=true))
    assert max(errors) <= 0.75


@pytest.mark.parametrize("turns", [1.0, 2.0, 4.0])
def test_what_is_left_of_an_angle_has_all_its_digits(turns: float) -> None:
    for angle in ANGLES:
        for rest in (0.0, 1e-17 * angle):
            n, left = (plain(value) for value in reduced(angle, rest, turns))
            true = mpf(angle) + mpf(rest) - n * turns * mp.pi
            assert abs(left) <= turns * math.pi / 2 * (1 + 1e-6)
            least = abs(n) * turns * 1e-28 + abs(rest) * EPS
            assert abs(left - true) <= abs(true) * mpf(2) ** -53 * 1.01 + least


def test_what_is_left_next_to_half_turns_has_all_its_digits() -> None:
    for angle in [*ANGLES, *(float(k * mp.pi) for k in (*range(-9, 10), 10**6, 10**9))]:
        for rest in (0.0, 1e-17 * angle):
            n, left = (plain(value) for value in sharply_reduced(angle, rest))
            true = mpf(angle) + mpf(rest) - n * mp.pi
            assert abs(left) <= math.pi / 2 * (1 + 1e-6)
            assert abs(left - true) <= (abs(true) * 1.01 + abs(rest)) * 2.0**-53


FORMS: Mapping[str, Callable[..., Half]] = {
    "half": half_angle,
    "grown": partial(half_angle, size=0.3),
    "signed": signed_half_angle,
    "grown signed": partial(signed_half_angle, size=0.3),
    "sharp": sharp_half_angle,
}
UNSIGNED = {"sine": 2, "cosine": 2.5, "square": 1.6, "cosine_square": 1.4, "product": 1.6, "difference": 2.3}
SIGNED = {"sine": 2, "cosine": 2.5, "square": 2, "cosine_square": 2, "product": 1.2, "difference": 2}
SHARP = {"sine": 1.2, "cosine": 1.2, "square": 2, "cosine_square": 2, "product": 1.2, "difference": 2}
BOUNDS = {"half": UNSIGNED, "grown": UNSIGNED, "signed": SIGNED, "grown signed": SIGNED, "sharp": SHARP}
SIZES = {"half": 1.0, "grown": 0.3, "signed": 1.0, "grown signed": 0.3, "sharp": 1.0}
"""What the squares are asked times."""


def values(half: Half, size: float) -> dict[str, Value]:
    """Return all that half an angle tells, squares times a size."""
    square, cosine_square, product = half.squares(size)
    return {
        "sine": half.sine,
        "cosine": half.cosine,
        "square": square,
        "cosine_square": cosine_square,
        "product": product,
        "difference": cosine_square - square,
    }


def true_half(angle: float, rest: float, size: float) -> dict[str, Any]:
    x = (mpf(angle) + mpf(rest)) / 2
    s, c = mp.sin(x), mp.cos(x)
    squares = {"square": s * s, "cosine_square": c * c, "product": s * c, "difference": c * c - s * s}
    return {"sine": s, "cosine": c} | {name: size * square for name, square in squares.items()}


@pytest.mark.parametrize("form", FORMS)
def test_half_an_angle_is_good_to_a_few_last_digits_of_one(form: str) -> None:
    worst = dict.fromkeys(BOUNDS[form], 0.0)
    for angle in ANGLES:
        rest = 3e-17 * angle
        found, size = values(FORMS[form](angle, rest), SIZES[form]), SIZES[form]
        for name, true in true_half(angle, rest, size).items():
            whole = size if "square" in name or name in ("product", "difference") else 1
            worst[name] = max(worst[name], units(found[name], true, of=whole))
    assert all(worst[name] <= bound for name, bound in BOUNDS[form].items()), worst


@pytest.mark.parametrize(
    ("form", "names"),
    [
        ("half", ["square"]),
        ("signed", ["sine", "square"]),
        ("sharp", ["sine", "cosine", "square", "cosine_square", "product"]),
    ],
)
def test_next_to_a_zero_there_are_still_all_digits(form: str, names: list[str]) -> None:
    for angle in NEAR_ZEROS:
        found = values(FORMS[form](angle, 0.0), SIZES[form])
        true = true_half(angle, 0.0, SIZES[form])
        for name in names:
            assert units(found[name], true[name], of=true[name]) <= 4, (angle, name)


@pytest.mark.thinned(7)
@pytest.mark.parametrize("form", ["half", "signed", "sharp"])
@pytest.mark.parametrize("quarters", range(-4, 6))
def test_a_small_way_from_where_they_vanish_keeps_all_its_digits(form: str, quarters: int) -> None:
    for way in (sign * 10.0**-n for n in range(301) for sign in (1, -1)):
        half = FORMS[form](way, 0.0, quarters=quarters)
        s, c = mp.sin(mpf(way) / 2), mp.cos(mpf(way) / 2)
        sine, cosine = ((s, c), (c, -s), (-s, -c), (-c, s))[quarters % 4]
        assert units(half.sine, sine, of=sine) <= 2
        assert units(half.cosine, cosine, of=cosine) <= 2
        if abs(way) > 1e-150:
            squares = half.squares(1.0)
            assert units(squares.sine, sine * sine, of=sine * sine) <= 4
            assert units(squares.cosine, cosine * cosine, of=cosine * cosine) <= 4
            assert units(squares.product, sine * cosine, of=sine * cosine) <= 4


def test_the_floats_nearest_to_where_they_vanish_keep_all_their_digits() -> None:
    places = [k * math.pi / 2 + sign * 10.0**-n for k in range(-8, 9) for n in range(18) for sign in (1, -1)]
    for angle in [*places, *(10.0**-n for n in range(301))]:
        cosine, sine = direction(angle)
        assert units(sine, mp.sin(mpf(angle)), of=mp.sin(mpf(angle))) <= 2
        assert units(cosine, mp.cos(mpf(angle)), of=mp.cos(mpf(angle))) <= 2
        if 0 < angle <= math.pi / 2:
            assert units(sine_within(angle), mp.sin(mpf(angle)), of=mp.sin(mpf(angle))) <= 2


@pytest.mark.parametrize(
    ("function", "true", "most", "size"),
    [
        (sine_within, mp.sin, math.pi / 2, None),
        (cosine_within, mp.cos, math.pi, 1),
    ],
)
def test_functions_of_a_short_range(
    function: Callable[[Value], Value], true: Callable[[Any], Any], most: float, size: float | None
) -> None:
    for angle in [*RANDOM.uniform(0, most, 800).tolist(), most, 1e-9, 1e-300]:
        exact = true(mpf(angle))
        assert units(function(angle), exact, of=size or exact) <= 4


def test_a_direction_of_floats() -> None:
    for angle in ANGLES:
        cosine, sine = direction(angle)
        assert units(sine, mp.sin(mpf(angle))) <= 1.2
        assert units(cosine, mp.cos(mpf(angle))) <= 1.2


@pytest.mark.parametrize("form", FORMS)
def test_floats_and_arrays_get_the_same_bits(form: str) -> None:
    # Plain operators on arrays: neither a formula graph nor a compiled program between.
    angles = np.array(ANGLES)
    together = _on_arrays(FORMS[form], angles, SIZES[form])
    alone = [values(FORMS[form](angle, 0.0), SIZES[form]) for angle in ANGLES]
    for name in BOUNDS[form]:
        assert np.array([one[name] for one in alone]).tobytes() == together[name].tobytes()


def _on_arrays(form: Callable[..., Any], angles: Any, size: float) -> Any:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("linkanim.mechanics.angles.rint", np.rint)
        return values(form(angles, 0.0), size)


@pytest.mark.parametrize("x", [0.0, -0.0, 0.5, 1.5, -0.5, -2.5, 0.49999999999999994, 2.0**51 - 0.5])
def test_the_nearest_whole_number_is_numpys(x: float) -> None:
    assert np.float64(nearest_whole(x)).tobytes() == np.rint(x).tobytes()
