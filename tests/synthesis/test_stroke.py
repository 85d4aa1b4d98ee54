"""A stroke as it is drawn: an answer at once, better ones after, and again when something is dragged."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from random_curves import curves

from linkanim.errors import BadInput
from linkanim.synthesis.answers import NUMBERS, PathAnswer, answer_from
from linkanim.synthesis.curves import DrawnCurve, bent, stroke_of, trace_of
from linkanim.synthesis.follower import COUNT, Follow, Follower, Reply
from linkanim.synthesis.front import cost
from linkanim.synthesis.path import task_of
from linkanim.synthesis.search import best_fits, glimpsed, refitted


@pytest.mark.slow
def test_the_atlas_answers_first_and_a_refined_answer_is_better() -> None:
    task = task_of(curves("four-bar", 1, seed=51)[0])
    first, last = glimpsed(task), best_fits(task, 2)[0]
    assert first
    assert last.rms <= first.rms < 0.1 * task.curve.size


@pytest.mark.slow
def test_an_answer_follows_a_point_that_is_dragged() -> None:
    task = task_of(curves("four-bar", 1, seed=52)[0])
    best = best_fits(task, 1)[0]
    points = task.curve.points.copy()
    points[5] += 0.02 * task.curve.size
    again = refitted(replace(task, curve=DrawnCurve(points, closed=True)), best)
    assert again is not None
    assert again.rms < 0.01 * again.task.curve.size
    assert np.abs(again.row - best.row).max() > 0


@pytest.mark.slow
def test_a_pivot_that_is_dragged_is_held_where_it_is_put() -> None:
    task = task_of(curves("four-bar", 1, seed=53)[0])
    best = best_fits(task, 1)[0]
    x, y = (best.parameters[name] + 0.01 * best.task.curve.size for name in ("x4", "y4"))
    held = replace(task, requirements=replace(task.requirements, given={"x4": x, "y4": y}))
    again = refitted(held, best)
    assert again is not None
    assert (again.parameters["x4"], again.parameters["y4"]) == pytest.approx((x, y))
    assert again.rms < 0.02 * again.task.curve.size


ROUND = np.exp(2j * np.pi * np.arange(80) / 80)


def test_a_stroke_that_ends_near_its_start_is_closed_and_one_that_does_not_is_open() -> None:
    assert stroke_of(100 * ROUND[:78]).closed
    arc = stroke_of(100 * ROUND[:50])
    assert not arc.closed
    assert (arc.points[0], arc.points[-1]) == pytest.approx((100 * ROUND[0], 100 * ROUND[49]))


def test_an_unsteady_hand_is_smoothed_and_a_bend_keeps_its_radius() -> None:
    shake = np.random.default_rng(3).normal(0, 1.5, (2, 80))
    off = np.abs(stroke_of(100 * ROUND + shake[0] + 1j * shake[1]).points) - 100
    assert abs(off.mean()) < 0.3
    assert off.std() < 0.7 * 1.5


@pytest.mark.parametrize("start", [0, 13])
def test_sharp_corners_are_kept(start: int) -> None:
    corners = np.array([0, 100, 100 + 60j, 60j])
    outline = DrawnCurve(corners, closed=True).at(np.arange(97) / 97)
    points = stroke_of(np.roll(outline, -start)).points
    assert all(np.abs(points - corner).min() < 2.0 for corner in corners)
    level = points.imag[(points.real > 20) & (points.real < 80)]
    assert np.minimum(np.abs(level), np.abs(level - 60)).max() < 0.05


def test_what_a_joint_goes_back_on_is_open() -> None:
    there = np.linspace(-1, 1, 361) + 0.2j * np.linspace(-1, 1, 361) ** 2
    assert not trace_of(np.concatenate([there, there[-2:0:-1]])).closed
    assert trace_of(ROUND).closed
    with pytest.raises(BadInput, match="no extent"):
        trace_of(np.full(80, 3 + 4j))


def followed(points: DrawnCurve, **more: Any) -> tuple[Follower, list[Reply]]:
    follower = Follower()
    pairs = [(float(point.real), float(point.imag)) for point in points.points]
    return follower, list(follower.replies(Follow(1, pairs, points.closed, **more)))


def told(numbers: Sequence[float]) -> list[PathAnswer]:
    return [answer_from(tuple(numbers[n:][:NUMBERS])) for n in range(0, len(numbers), NUMBERS)]


@cache
def replies() -> tuple[DrawnCurve, list[Reply]]:
    """Return a stroke and what is told of it."""
    curve = stroke_of(curves("four-bar", 1, seed=54)[0])
    return curve, followed(curve)[1]


@pytest.mark.slow
def test_replies_to_a_stroke_are_one_answer_and_then_several_that_differ() -> None:
    _, (first, early, whole) = replies()
    assert (first.whole, len(first.numbers), early.whole, whole.whole) == (False, NUMBERS, True, True)
    answers = told(whole.numbers)
    assert 1 < len(answers) <= COUNT
    assert [one.off for one in answers] == sorted(one.off for one in answers)
    assert answers[0].off <= first.numbers[0]
    for one, other in combinations(answers, 2):
        assert one.closure != other.closure or np.abs(np.subtract(one.row, other.row)).max() > 0.01


@pytest.mark.slow
def test_the_answer_that_is_shown_stays_when_more_come_and_the_way_goes_from_exact_to_compact() -> None:
    curve, (_, early, whole) = replies()
    before, shown = told(early.numbers)[early.chosen], told(whole.numbers)[whole.chosen]
    assert np.abs(np.subtract(before.row, shown.row)).max() < 0.05 * curve.size
    way = told(whole.way)
    assert len(way) > 2
    assert way[0].off == min(one.off for one in way)
    sizes = [one.size for one in way[1:]]
    assert sizes == sorted(sizes, reverse=True)


@pytest.mark.long
@pytest.mark.slow
def test_what_is_dragged_is_followed_and_stays_shown_among_the_others() -> None:
    curve = stroke_of(curves("four-bar", 1, seed=55)[0])
    follower, (*_, whole) = followed(curve)
    near = told(whole.numbers)[whole.chosen].numbers
    moved = bent(curve, 9, curve.points[9] + 0.01 * curve.size)
    pairs = [(float(point.real), float(point.imag)) for point in moved.points]
    (led,) = follower.replies(Follow(1, pairs, moved.closed, near=near, search=False))
    assert not led.whole
    assert np.abs(np.subtract(led.numbers, near)).max() > 0
    again, *_, all_ = follower.replies(Follow(1, pairs, moved.closed, near=tuple(led.numbers)))
    shown = told(all_.numbers)[all_.chosen]
    assert np.abs(np.subtract(shown.row, told(again.numbers)[0].row)).max() < 0.05 * moved.size


@pytest.mark.long
def test_an_answer_that_is_dragged_to_where_it_is_poor_gives_way_to_a_good_one() -> None:
    """A quarter of the size off beside cards of three percent is nobody's choice."""
    curve = stroke_of(curves("four-bar", 1, seed=55)[0])
    follower, (*_, whole) = followed(curve)
    near, count = told(whole.numbers)[whole.chosen].numbers, len(curve.points)
    moved = bent(curve, 9, curve.points[(9 + count // 2) % count])
    pairs = [(float(point.real), float(point.imag)) for point in moved.points]
    *_, last = follower.replies(Follow(1, pairs, moved.closed, near=near))
    answers = told(last.numbers)
    best = min(cost(one.figures) for one in answers)
    assert cost(answers[last.chosen].figures) <= best + math.log(2)


def test_a_search_ends_when_it_is_interrupted_and_what_cannot_be_is_said() -> None:
    class Stop(Exception):
        pass

    def stop() -> None:
        raise Stop

    curve = stroke_of(100 * ROUND)
    pairs = [(float(point.real), float(point.imag)) for point in curve.points]
    with pytest.raises(Stop):
        list(Follower().replies(Follow(1, pairs, closed=True), stop))
    (reply,) = Follower().replies(Follow(1, pairs[:2], closed=True))
    assert (reply.whole, reply.error is None) == (True, False)
