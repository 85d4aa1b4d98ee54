"""The one table of kinds: what makes a question of each, and at which levels it is asked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

from linkanim.play.kinds import gaining, making, moving, ranging
from linkanim.play.question import Puzzle, QuizQuestion

LEVELS = (1, 2, 3)


class QuestionKind(NamedTuple):
    """What makes a question of a kind, None where a puzzle has none, and the levels that ask it.

    One `of_making` is about what a linkage was made for, and asked of a scene that says so.
    """

    make: Callable[[Puzzle], QuizQuestion | None]
    levels: tuple[int, ...]
    of_making: bool = False


KINDS: Mapping[str, QuestionKind] = {
    "turning": QuestionKind(moving.turning, (1,)),
    "fastest": QuestionKind(moving.fastest, (1, 2)),
    "heading": QuestionKind(moving.heading, (1, 2)),
    "input range": QuestionKind(ranging.input_range, (1, 2)),
    "doubled": QuestionKind(gaining.doubled, (1, 2)),
    "grashof": QuestionKind(ranging.grashof, (1, 2)),
    "speeding": QuestionKind(gaining.speeding, (2, 3)),
    "dead centre": QuestionKind(ranging.dead_centre, (2, 3)),
    "closure": QuestionKind(ranging.closure, (2, 3)),
    "coriolis": QuestionKind(gaining.coriolis, (2, 3)),
    "curves": QuestionKind(gaining.curves, (2, 3)),
    "instant centre": QuestionKind(moving.instant_centre, (3,)),
    "force": QuestionKind(gaining.force, (3,)),
    "grashof sum": QuestionKind(ranging.grashof_sum, (3,)),
    "slow way": QuestionKind(making.slow_way, (1, 2), of_making=True),
    "precision point": QuestionKind(making.precision_point, (2, 3), of_making=True),
    "pole": QuestionKind(making.pole, (2, 3), of_making=True),
}


def of_level(level: int) -> tuple[str, ...]:
    """Return the kinds that a level asks."""
    return tuple(name for name, kind in KINDS.items() if level in kind.levels)
