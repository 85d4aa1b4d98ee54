"""Bisection on many brackets at once."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.search import around, ends_of, sign_changes


def test_every_bracket_ends_at_the_last_float_that_holds() -> None:
    limits = np.array([0.1, 2.5, -3.0, 1e9])
    inside, outside = limits - 1.0, limits + np.array([1.0, 2.0, 3.0, 4.0])
    assert ends_of(lambda x: x <= limits, inside, outside).tolist() == limits.tolist()


def test_a_bracket_may_run_downwards() -> None:
    assert ends_of(lambda x: x >= 0.3, np.array([1.0]), np.array([0.0])).tolist() == [0.3]


def test_no_bracket_is_halved_down_to_the_smallest_floats() -> None:
    asked = []

    def negative(x: NDArray[np.float64]) -> NDArray[np.bool_]:
        asked.append(x)
        return x < 0

    found = ends_of(negative, np.array([-1.0]), np.array([1.0]))
    assert abs(found[0]) < 1e-20
    assert len(asked) < 100


def test_sign_changes_are_found_between_samples_and_nowhere_in_what_is_not_a_number() -> None:
    places = np.linspace(-0.5, 9.5, 100)
    assert sign_changes(np.sin, places) == pytest.approx([0.0, math.pi, 2 * math.pi, 3 * math.pi], abs=1e-15)
    with np.errstate(invalid="ignore"):
        assert len(sign_changes(lambda x: np.sqrt(x - 1.0) - 1.0, places)) == 1


def test_phases_once_around_hold_every_zero_once() -> None:
    # Among them the zeros at the start, which is also the end.
    for turns in (1, 3):
        assert len(sign_changes(np.sin, around(turns, 1440))) == 2 * turns
