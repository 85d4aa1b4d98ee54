"""Rounds of questions about one scene or several, the same ones for the same seed."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from random import Random

from linkanim.errors import BadInput, WorkFailed
from linkanim.play.kinds.table import KINDS
from linkanim.play.question import Puzzle, QuestionId, QuizQuestion
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene
from linkanim.units import shown

_TRIES = 12
"""So many phases are tried for a kind before another is taken."""
_DECIMALS = 4
"""Of a question's phase, in radians, so that it can be typed."""


def questions(
    scenes: Sequence[Scene], count: int, seed: int, progress: Callable[[int, int], None] = lambda *_: None
) -> tuple[QuizQuestion, ...]:
    """Return so many questions, the scenes one after the other.

    Kinds come in turn, as far as the scene has something to ask of each; none is asked twice of one subject
    before a scene has nothing else. `progress` is called with (questions made, in all). WorkFailed where a
    scene has nothing that can be asked, because nothing of it moves clearly.
    """
    found: list[QuizQuestion] = []
    spent: set[tuple[str, str]] = set()
    for number in range(count):
        scene, before = scenes[number % len(scenes)], [one.question_id for one in found]
        found.append(next_question(scene, f"{seed} {number}", before, spent=spent))
        progress(number + 1, count)
    return tuple(found)


def next_question(
    scene: Scene,
    seed: str,
    before: Sequence[QuestionId],
    kinds: Collection[str] = tuple(KINDS),
    *,
    spent: set[tuple[str, str]] | None = None,
) -> QuizQuestion:
    """Return a question about a scene, of the kind that was least often, that was not there before.

    Of other kinds than those that are asked for where the scene has nothing to ask of these. Kinds that have
    nothing new to ask of a scene are `spent`, to which they are added: they are not tried at length again.
    WorkFailed as `questions`.
    """
    spent = set() if spent is None else spent
    random = Random(f"{seed} {scene.name}")
    asked = sorted(name for name, kind in KINDS.items() if scene.purpose or not kind.of_making)
    order = random.sample(asked, len(asked))
    often = [question_id.kind for question_id in before]
    order.sort(key=lambda kind: (kind not in kinds, often.count(kind)))
    known = {(question_id.scene, question_id.kind, question_id.subject) for question_id in before}
    spare = None
    for kind in order:
        if spare and (scene.name, kind) in spent:
            continue
        for _ in range(_TRIES):
            made = _made(kind, scene, round(random.uniform(0.0, scene.period), _DECIMALS))
            if made and (scene.name, kind, made.subject) not in known:
                return made
            spare = spare or made
            if spare and (scene.name, kind) in spent:
                break
        spent.add((scene.name, kind))
    if spare is None:
        raise WorkFailed(f"{scene.name}: nothing of it moves so clearly that a question can be made of it")
    return spare


def question_of(question_id: QuestionId) -> QuizQuestion:
    """Return a question of the catalogue again; BadInput where there is none such."""
    if question_id.kind in KINDS and question_id.scene in names() and abs(question_id.phase) < 1e6:
        made = _made(question_id.kind, load(question_id.scene), question_id.phase)
        if made and made.subject == question_id.subject:
            return made
    raise BadInput(f"{shown(str(question_id))} is no question of this version")


def is_question(question_id: QuestionId) -> bool:
    """Tell whether a question that was kept can be asked by this version."""
    try:
        question_of(question_id)
    except BadInput:
        return False
    return True


def _made(kind: str, scene: Scene, phase: float) -> QuizQuestion | None:
    return KINDS[kind].make(Puzzle(kind, scene, phase, Random(f"{kind} {scene.name} {phase}")))
