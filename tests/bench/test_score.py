"""Scores: which poses count as right, which as on the other closure, which as no pose at all."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from linkanim.bench.accuracy import Score, score, together
from linkanim.bench.cases import EASY, degrees
from linkanim.bench.question import Points, Question
from linkanim.bench.reference import Answer, answer


@pytest.fixture(scope="module")
def asked() -> Answer:
    return answer(replace(EASY, inputs=degrees(10, 14)))


def test_the_exact_pose_has_the_error_of_its_rounding_only(asked: Answer) -> None:
    found = score(lambda question: Points(asked.b.high, asked.p.high), asked)
    assert found.error < 2**-52
    assert (found.poses, found.wrong, found.missing) == (4, 0, 0)


def test_errors_are_in_longest_links(asked: Answer) -> None:
    found = score(lambda question: Points(asked.b.high + 1e-3, asked.p.high), asked)
    assert found.error == pytest.approx(1e-5)


def test_each_pose_is_counted_once(asked: Answer) -> None:
    def mixed(question: Question) -> Points:
        b, p = asked.b.high.copy(), asked.p.high.copy()
        b[1], p[1] = asked.other.b[1], asked.other.p[1]
        p[2] = np.nan
        b[3] += 1e-6
        return Points(b, p)

    found = score(mixed, asked)
    assert (found.poses, found.wrong, found.missing) == (4, 1, 1)
    assert found.error == pytest.approx(1e-8)


# At most half as far from the other closure's as from its own: between the two the error counts.
@pytest.mark.parametrize(("share", "wrong"), [(0.0, 4), (0.32, 4), (0.35, 0), (0.9, 0)])
def test_a_pose_between_the_closures_is_wrong_near_the_other_one(
    asked: Answer, share: float, wrong: int
) -> None:
    def between(question: Question) -> Points:
        b, p = (1 - share) * asked.other.b + share * asked.b.high, (1 - share) * asked.other.p
        return Points(b, p + share * asked.p.high)

    assert score(between, asked).wrong == wrong


def test_closures_that_are_one_cannot_be_mistaken(asked: Answer) -> None:
    for apart, wrong in ((0.5e-8, 0), (2e-8, 4)):
        other = Points(asked.b.high + 100 * apart, asked.p.high + 100 * apart)
        found = score(lambda question, other=other: other, replace(asked, other=other))  # type: ignore[misc]
        assert found.wrong == wrong


def test_no_right_pose_has_no_error(asked: Answer) -> None:
    found = score(lambda question: asked.other, asked)
    assert math.isnan(found.error)
    assert found.wrong == 4


def test_scores_add_up_and_the_worst_error_stays() -> None:
    scores = (Score(4, 1e-9, 1, 0), Score(3, math.nan, 3, 0), Score(2, 1e-7, 0, 2))
    assert together(scores) == Score(9, 1e-7, 4, 2)
