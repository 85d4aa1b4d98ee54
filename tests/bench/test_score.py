"""Scores: which poses count as right, which as on the other closure, which as no pose at all."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from linkanim.bench.questions import FOUR_BAR, Complexes, Orders, Question, degrees
from linkanim.bench.reference import Answer, Score, answer, together


@pytest.fixture(scope="module")
def posed() -> Answer:
    return answer(replace(FOUR_BAR.easy, inputs=degrees(10, 14)))


def exact(posed: Answer) -> list[dict[str, Complexes]]:
    return [{name: place.high.copy() for name, place in order.items()} for order in posed.orders]


def test_the_exact_pose_has_the_error_of_its_rounding_only(posed: Answer) -> None:
    found = posed.score(lambda question: tuple(exact(posed)))
    assert all(error < 2**-52 for error in found.errors)
    assert (found.poses, found.wrong, found.nan) == (4, 0, 0)


def test_errors_are_in_longest_links_and_a_method_without_rates_has_none(posed: Answer) -> None:
    places = exact(posed)[0]
    found = posed.score(lambda question: ({**places, "B": places["B"] + 1e-3},))
    assert found.error == pytest.approx(1e-5)
    assert math.isnan(found.errors[1])
    assert math.isnan(found.errors[2])


def test_a_rate_that_is_no_number_at_a_right_pose_is_unboundedly_wrong(posed: Answer) -> None:
    places, first, second = exact(posed)
    first["P"][2] = np.nan
    assert posed.score(lambda question: (places, first, second)).errors[1] > 1e300


def test_each_pose_is_counted_once(posed: Answer) -> None:
    def mixed(question: Question) -> Orders:
        places = exact(posed)[0]
        places["B"][1] = posed.other["B"][1]
        places["P"][2] = np.nan
        places["B"][3] += 1e-6
        return (places,)

    found = posed.score(mixed)
    assert (found.poses, found.wrong, found.nan) == (4, 1, 1)
    assert found.error == pytest.approx(1e-8)


# At most half as far from the other closure as from its own: between the two the error counts.
@pytest.mark.parametrize(("share", "wrong"), [(0.0, 4), (0.32, 4), (0.35, 0), (0.9, 0)])
def test_a_pose_between_the_closures_is_wrong_near_the_other_one(
    posed: Answer, share: float, wrong: int
) -> None:
    places = exact(posed)[0]
    places["B"] = (1 - share) * posed.other["B"] + share * places["B"]
    assert posed.score(lambda question: (places,)).wrong == wrong


def test_closures_that_are_one_cannot_be_mistaken(posed: Answer) -> None:
    for apart, wrong in ((0.5e-8, 0), (2e-8, 4)):
        places = exact(posed)[0]
        other = {"B": places["B"] + 100 * apart}
        places["B"] = other["B"]
        found = replace(posed, other=other).score(lambda question, places=places: (places,))  # type: ignore[misc]
        assert found.wrong == wrong


def test_no_right_pose_has_no_error(posed: Answer) -> None:
    places = exact(posed)[0]
    places["B"] = posed.other["B"]
    found = posed.score(lambda question: (places,))
    assert math.isnan(found.error)
    assert found.wrong == 4


def test_scores_add_up_and_the_worst_errors_stay() -> None:
    none = (math.nan, math.nan, math.nan)
    scores = (Score(4, 1e-9, 1e-3, math.nan, 1, 0), Score(3, *none, 3, 0), Score(2, 1e-7, 1e-4, 1.0, 0, 2))
    assert together(scores) == Score(9, 1e-7, 1e-3, 1.0, 4, 2)
