"""A stroke as it is drawn: an answer at once, better ones after, and again when something is dragged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_curves import curves

from linkanim.synthesis.curves.drawn import DrawnCurve
from linkanim.synthesis.request import task_of
from linkanim.synthesis.search import answers, refitted


def test_the_atlas_answers_first_and_the_refined_answers_follow() -> None:
    first, last = answers(task_of(curves("four-bar", 1, seed=51)[0]), 2)
    assert len(first) == 1
    assert last[0].rms <= first[0].rms < 0.1 * first[0].task.curve.size


def test_an_answer_follows_a_point_that_is_dragged() -> None:
    task = task_of(curves("four-bar", 1, seed=52)[0])
    *_, (best, *_) = answers(task, 1)
    points = task.curve.points.copy()
    points[5] += 0.02 * task.curve.size
    again = refitted(replace(task, curve=DrawnCurve(points, closed=True)), best)
    assert again is not None
    assert again.rms < 0.01 * again.task.curve.size
    assert np.abs(again.row - best.row).max() > 0


def test_a_pivot_that_is_dragged_is_held_where_it_is_put() -> None:
    task = task_of(curves("four-bar", 1, seed=53)[0])
    *_, (best, *_) = answers(task, 1)
    x, y = (best.parameters[name] + 0.01 * best.task.curve.size for name in ("x4", "y4"))
    held = replace(task, requirements=replace(task.requirements, given={"x4": x, "y4": y}))
    again = refitted(held, best)
    assert again is not None
    assert (again.parameters["x4"], again.parameters["y4"]) == pytest.approx((x, y))
    assert again.rms < 0.02 * again.task.curve.size
