"""Bisection on many brackets at once."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.search import BLOCK, around, changes_by_row, ends_of, own_rows, sign_changes


def test_every_bracket_ends_at_the_last_float_that_holds() -> None:
    limits = np.array([0.1, 2.5, -3.0, 1e9])
    inside, outside = limits - 1.0, limits + np.array([1.0, 2.0, 3.0, 4.0])
    assert ends_of(lambda x: x <= limits, inside, outside).tolist() == limits.tolist()


def test_a_bracket_may_run_downwards() -> None:
    assert ends_of(lambda x: x >= 0.3, np.array([1.0]), np.array([0.0])).tolist() == [0.3]


def test_without_brackets_there_are_no_ends() -> None:
    none = np.empty(0)
    assert ends_of(lambda x: x > 0.0, none, none).shape == (0,)


def test_brackets_that_end_sooner_than_others_stay_at_their_ends() -> None:
    # one that is two neighbouring floats, one that is narrow, one that ends at zero, and a wide one
    limits = np.array([1.0, 1.0 + 2.0**-40, 0.0, math.pi])
    inside = np.array([1.0, 1.0, -1.0, -1e6])
    outside = np.array([math.nextafter(1.0, 2.0), 1.0 + 2.0**-20, 1.0, 1e6])
    found = ends_of(lambda x: x <= limits, inside, outside)
    assert found[[0, 1, 3]].tolist() == limits[[0, 1, 3]].tolist()
    assert -1e-15 < found[2] <= 0.0


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


@pytest.mark.parametrize("rows", [1, 7, 60])
def test_changes_of_many_rows_are_searched_together_a_block_of_places_at_a_time(rows: int) -> None:
    shifts = np.linspace(0.0, 1.0, rows)
    asked: list[int] = []

    def function(x: NDArray[np.float64]) -> NDArray[np.float64]:
        asked.append(len(x))
        return np.sin(x - shifts[:, np.newaxis])

    found, places = changes_by_row(function, around(2, 1440))
    expected = [shift + n * math.pi for shift in shifts for n in range(4)]
    order = np.lexsort((places, found))
    assert found[order].tolist() == [row for row in range(rows) for _ in range(4)]
    assert places[order] == pytest.approx(expected, abs=1e-14)
    assert max(asked) <= BLOCK + 1
    # The samples, and of each of the four changes of a row one place for every halving, 80 at the most;
    # of few changes 15 for four halvings.
    assert sum(asked) <= 2900 + 4 * rows * (300 if rows == 1 else 80)
    assert len(asked) <= 3 + 80


def test_each_place_gets_the_value_of_its_own_row() -> None:
    places = np.linspace(0.0, 3.0, 2 * BLOCK + 5)
    rows = np.arange(len(places)) % 3
    found = own_rows(lambda x: np.array([x, -x, 0 * x]), rows, places)
    assert found.tolist() == np.choose(rows, [places, -places, 0 * places]).tolist()
