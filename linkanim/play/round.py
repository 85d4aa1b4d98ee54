"""Rounds of questions about one scene or several, the same ones for the same seed."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from linkanim.errors import WorkFailed
from linkanim.play.kinds import KINDS
from linkanim.play.question import Puzzle, QuizQuestion
from linkanim.scenes.scene import Scene

_TRIES = 12
"""So many phases are tried for a kind before another is taken."""
_DECIMALS = 4
"""Of a question's phase, in radians, so that it can be typed."""


def questions(scenes: Sequence[Scene], count: int, seed: int) -> tuple[QuizQuestion, ...]:
    """Return so many questions, the scenes one after the other.

    Kinds come in turn, as far as the scene has something to ask of each; none is asked twice of one subject
    before a scene has nothing else. WorkFailed where a scene has
    nothing that can be asked, because nothing of it moves clearly.
    """
    found: list[QuizQuestion] = []
    for number in range(count):
        scene = scenes[number % len(scenes)]
        found.append(_question(scene, Random(f"{seed} {number} {scene.name}"), found))
    return tuple(found)


def _question(scene: Scene, random: Random, before: Sequence[QuizQuestion]) -> QuizQuestion:
    """Return a question about a scene, of the kind that was least often, that was not there before."""
    kinds = random.sample(sorted(KINDS), len(KINDS))
    often = [question.kind for question in before]
    kinds.sort(key=often.count)
    known = {(question.scene.name, question.kind, question.subject) for question in before}
    spare = None
    for kind in kinds:
        for _ in range(_TRIES):
            phase = round(random.uniform(0.0, scene.period), _DECIMALS)
            made = KINDS[kind](Puzzle(scene, phase, random))
            if made and (scene.name, kind, made.subject) not in known:
                return made
            spare = spare or made
    if spare is None:
        raise WorkFailed(f"{scene.name}: nothing of it moves so clearly that a question can be made of it")
    return spare
