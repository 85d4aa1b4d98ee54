"""What a method's answers are worth beside the exact ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from linkanim.bench.question import Points, Question
from linkanim.bench.reference import Answer

Solve = Callable[[Question], Points]

APART = 1e-8
"""In longest links: closures nearer than this count as one."""


@dataclass(frozen=True)
class Score:
    """Poses asked; the worst error among those on the right closure; the others, counted.

    The error is the larger one of B and P in longest links, NaN where no pose is right. A pose is
    `wrong` where it lies at most half as far from the other closure's, `missing` where it is not a number.
    """

    poses: int
    error: float
    wrong: int
    missing: int


def score(solve: Solve, answer: Answer) -> Score:
    """Ask one method one question."""
    with np.errstate(all="ignore"):
        found = solve(answer.question)
    longest = answer.question.bars.longest
    error = np.maximum(answer.b.distance(found.b), answer.p.distance(found.p)) / longest
    other = _largest(found, answer.other) / longest
    apart = _largest(Points(answer.b.high, answer.p.high), answer.other) / longest > APART
    wrong, missing = apart & (2 * other < error), ~np.isfinite(error)
    right = error[~wrong & ~missing]
    worst = float(right.max()) if right.size else float("nan")
    return Score(error.size, worst, int(wrong.sum()), int(missing.sum()))


def _largest(one: Points, other: Points) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    largest: np.ndarray[tuple[int], np.dtype[np.float64]] = np.maximum(
        np.abs(one.b - other.b), np.abs(one.p - other.p)
    )
    return largest


def together(scores: Sequence[Score]) -> Score:
    """Return the worst error and the sums of several scores."""
    errors = [score.error for score in scores if not np.isnan(score.error)]
    return Score(
        sum(score.poses for score in scores),
        max(errors, default=float("nan")),
        sum(score.wrong for score in scores),
        sum(score.missing for score in scores),
    )
