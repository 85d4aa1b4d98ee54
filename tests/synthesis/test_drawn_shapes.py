"""Thirty drawn shapes: the answer that is shown first is one that a lecturer would show."""

from __future__ import annotations

import math

import pytest
from drawn_shapes import SHAPES, front, stroke

from linkanim.synthesis.answers import Fit
from linkanim.synthesis.front import knee


def chosen(name: str) -> tuple[tuple[Fit, ...], Fit]:
    fits = front(stroke(name))
    return fits, fits[knee([fit.figures for fit in fits])]


@pytest.mark.long
@pytest.mark.parametrize("name", SHAPES)
def test_the_answer_that_is_shown_is_compact_and_follows(name: str) -> None:
    fits, shown = chosen(name)
    figures = shown.figures
    best = min(fit.figures.deviation for fit in fits)
    if any(fit.figures.size <= 2.5 and fit.figures.deviation <= 1.5 * best for fit in fits):
        assert figures.size <= 2.5
    assert figures.deviation < 0.08
    # none is half as large that is not half as far off again
    smaller = [fit.figures.deviation for fit in fits if fit.figures.size <= figures.size / 2]
    assert all(max(off, 0.003) >= 1.5 * figures.deviation for off in smaller)


@pytest.mark.long
@pytest.mark.slow
def test_a_foot_is_followed_by_a_linkage_that_runs_well() -> None:
    _, shown = chosen("foot")
    assert shown.figures.size < 1.5
    assert shown.figures.deviation < 0.01
    assert shown.figures.angle > math.radians(30)
