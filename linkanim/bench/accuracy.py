"""What a method's answers are worth beside the exact ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkanim.bench.chain import Floats, Orders, Places, Question
from linkanim.bench.reference import Answer, Exact

Solve = Callable[[Question], Orders]

APART = 1e-8
"""In longest links: closures nearer than this count as one."""


@dataclass(frozen=True)
class Score:
    """How many poses; the worst errors among those on the right closure; the others, counted.

    Errors are those of position, velocity and acceleration, of the joint that is farthest off: positions in
    longest links, rates in longest links or the pose's largest rate, whichever is more. NaN where no pose is
    right or the method gives none. A pose is `wrong` where a dyad's joint lies at most half as far from its
    other closure, `nan` where a position is not a number.
    """

    poses: int
    error: float
    velocity_error: float
    acceleration_error: float
    wrong: int
    nan: int

    @property
    def errors(self) -> tuple[float, float, float]:
        """The worst errors of position, velocity and acceleration."""
        return self.error, self.velocity_error, self.acceleration_error


def score(solve: Solve, answer: Answer) -> Score:
    """Return what one method's answer is worth."""
    with np.errstate(all="ignore"):
        found = solve(answer.question)
        longest = answer.question.longest
        error = _farthest(found[0], answer.orders[0]) / longest
        wrong, missing = _elsewhere(found[0], answer), ~np.isfinite(error)
        right = ~wrong & ~missing
        rates = [
            _farthest(places, exact) / np.maximum(_largest(exact), longest)
            for places, exact in zip(found[1:], answer.orders[1:], strict=False)
        ]
    position, velocity, acceleration, *_ = (*(_worst(one, right) for one in (error, *rates)), np.nan, np.nan)
    return Score(error.size, position, velocity, acceleration, int(wrong.sum()), int(missing.sum()))


def together(scores: Sequence[Score]) -> Score:
    """Return the worst errors and the sums of several scores."""
    errors = zip(*(score.errors for score in scores), strict=True)
    position, velocity, acceleration = (
        max((error for error in order if not np.isnan(error)), default=float("nan")) for order in errors
    )
    poses, wrong, nan = map(sum, zip(*((one.poses, one.wrong, one.nan) for one in scores), strict=True))
    return Score(poses, position, velocity, acceleration, wrong, nan)


def _worst(errors: Floats, right: Any) -> float:
    """Return the largest error of the right poses; a rate that is no number there is unboundedly wrong."""
    kept = errors[right]
    if not kept.size or np.isnan(errors).all():
        return float("nan")
    return float(np.nan_to_num(kept, nan=np.inf).max())


def _farthest(found: Places, exact: Mapping[str, Exact]) -> Floats:
    return np.max([place.distance(found[name]) for name, place in exact.items()], axis=0)  # type: ignore[no-any-return]


def _largest(exact: Mapping[str, Exact]) -> Floats:
    return np.max([np.abs(place.high) for place in exact.values()], axis=0)  # type: ignore[no-any-return]


def _elsewhere(found: Places, answer: Answer) -> Any:
    """Return which poses lie on another closure than the right one."""
    here, apart = answer.orders[0], APART * answer.question.longest
    return np.any(
        [
            (np.abs(other - here[name].high) > apart)
            & (2 * np.abs(found[name] - other) < here[name].distance(found[name]))
            for name, other in answer.other.items()
        ],
        axis=0,
    )
