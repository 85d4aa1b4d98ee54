"""Actions that a stroke and poses share: answers come, one is chosen and kept, a change is undone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.edits import exchanged, followed
from linkanim.player.state import (
    POSED,
    AnswerRow,
    Mode,
    PathSketch,
    PoseSketch,
    Rule,
    Sketch,
    State,
    with_effect,
    with_undo,
)
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene

_SAME = 0.02
"""Pins nearer to each other than this, in sizes of the stroke, are one."""


def sketching(state: State, **changes: object) -> State:
    """Return the state with its sketch changed, if there is one."""
    return state.with_mode(replace(state.sketch, **changes)) if state.sketch else state  # type: ignore[arg-type]


def leave_sketch(state: State) -> State:
    """Leave the sketch; the scene from before comes back as if it had run on meanwhile."""
    sketch = state.sketch
    if sketch is None:
        return state
    faded = state.faded if state.scene is sketch.before else state.frame
    back = replace(state.without(Sketch), glide=None, faded=faded)
    return replace(back, scene=sketch.before, clock=sketch.clock, editing=sketch.editing)


def keep(state: State, _: None) -> State:
    """Leave the sketch and keep the answer in the scene's place; undo brings the scene back."""
    sketch = state.sketch
    if sketch is None or sketch.is_blank or state.scene is sketch.before:
        return leave_sketch(state)
    return replace(state.without(Sketch), editing=with_undo(sketch.editing, sketch.before))


_KEEPS = frozenset({"edit", "edit_at", "edit_row", "trace_joint", "drive_joint", "layers"})
_LEAVES = frozenset({"mechanism", "select", "put", "closure", "reset", "returns", "stage"})
"""Actions that keep the answer first, and those that first go back to the scene before."""
REFUSED = frozenset({"unit", "undo", "redo"})
"""Actions that are refused meanwhile: points keep their unit, and edits are the scene's."""


def follow(state: State, numbers: tuple[float, ...]) -> State:
    """Show an answer that has come instead of the answer that is shown."""
    sketch = state.sketch
    if sketch is None or not sketch.is_asked or (len(numbers) == POSED) != isinstance(sketch, PoseSketch):
        return state
    answer = sketch.answer_from(numbers)
    if not sketch.answers:
        return sketching(_first(state, sketch.scene_of(answer)), answers=(answer,))
    if isinstance(sketch.answer, Scene):
        return state
    answers = tuple(answer if n == sketch.chosen else one for n, one in enumerate(sketch.answers))
    if sketch.held is None:
        return followed(sketching(state, answers=answers), sketch.scene_of(answer))
    return sketching(state, answers=answers, coming=ready(sketch.scene_of(answer, sketch.base), state.phase))


def ready(scene: Scene, phase: float) -> Scene:
    """Return a scene after working out what the next frame needs, since that frame has a picture to make."""
    scene.cycle(1, derivatives=0)
    scene.pose(phase, 0)
    return scene


def come(state: State) -> State:
    """Return the state showing the linkage that was worked out for this frame."""
    coming = state.sketch and state.sketch.coming
    return replace(sketching(state, coming=None), scene=coming) if coming else state


def with_answers(state: State, first: int, more: tuple[Any, ...]) -> State:
    """Return the state with other answers, one of them shown.

    A scene whose own trace was taken stays the first answer, and the shown answer stays shown.
    """
    sketch = state.sketch
    if sketch is None or not sketch.is_asked or sketch.held is not None:
        return state
    if not 0 <= first < len(more):
        return state
    before = sketch.answer
    if isinstance(sketch, PathSketch) and sketch.answers and isinstance(sketch.answers[0], Scene):
        assert sketch.curve
        own = in_unit(sketch.answers[0], sketch.unit)
        others = (one for one in more if one == before or not _stands_on(own, one.row, sketch.curve.size))
        answers = sketch.answers[0], *others
        return sketching(state, answers=answers, chosen=answers.index(before) if before in answers else 0)
    was_none = not sketch.answers
    state = sketching(state, answers=more, chosen=first)
    if before == more[first]:
        return state
    scene = sketch.scene_of(more[first])
    return _first(state, scene) if was_none else followed(state, scene)


def _first(state: State, scene: Scene) -> State:
    """Show the first linkage for a sketch: it runs at once, whatever was paused before."""
    state = replace(exchanged(state, scene), glide=None, faded=state.frame)
    return replace(state, clock=state.clock.pause(state.frame, False))


def _stands_on(scene: Scene, row: tuple[float, ...], size: float) -> bool:
    """Return whether an answer has the fixed pins of the scene whose trace it follows: then it is that."""
    pins = [complex(*pin.position) for pin in scene.linkage.pins]
    x, y, *_, x4, y4, _ = row
    own = complex(x, y), complex(x4, y4)
    return all(min((abs(pin - at) for at in pins), default=size) < _SAME * size for pin in own)


def choose(state: State, number: int) -> State:
    """Show another of the answers."""
    sketch = state.sketch
    if sketch is None or sketch.held is not None or not 0 <= number < len(sketch.answers):
        return state
    if sketch.answer is sketch.answers[number]:
        return state
    scene = sketch.scene_of(sketch.answers[number])
    state = replace(exchanged(state, scene), glide=None, faded=state.frame)
    return state.with_mode(sketch.picking(number))


def undo(state: State, _: None) -> State:
    """Go back to the sketch, with its answers, before the last change."""
    sketch = state.sketch
    if sketch is None or sketch.earlier is None or sketch.held is not None:
        return state
    back = replace(sketch.earlier.at_rest, strokes=sketch.strokes + 1)
    state = state.with_mode(back)
    if back.answer is None:
        return with_effect(state, "search") if back.is_asked else state
    return followed(state, back.scene_of(back.answer))


def released(state: State) -> State:
    """Return the state with nothing held, showing its answer itself; all answers are asked for."""
    sketch = state.sketch
    if sketch is None:
        return state
    answer = sketch.answer
    state = sketching(state, held=None, base=None, coming=None)
    if answer and not isinstance(answer, Scene) and state.scene is not sketch.base:
        state = exchanged(state, sketch.scene_of(answer))
    return with_effect(state, "search")


def row_of(state: State, sketch: Sketch, words: tuple[str, ...]) -> AnswerRow:
    """Return the row of answers with words about each; while something is dragged, as it was before."""
    entries = tuple(
        sketch.base if sketch.base and n == sketch.chosen else one for n, one in enumerate(sketch.answers)
    )
    names, still = tuple("" for _ in entries), state.clock.paused or sketch.held is not None
    return AnswerRow(entries, names, words, sketch.chosen, sketch.unit, still)


ACTIONS: Mapping[str, Rule] = {
    "follow": Rule(rules.answer, follow),  # an answer's numbers
    "answer": Rule(rules.whole, choose),  # its place in the row
    "keep": Rule(rules.nothing, keep),
    "undo_sketch": Rule(rules.nothing, undo),
}
"""The actions that the pencil and poses share."""


class Sketching(Mode):
    """What the pencil and poses share, while a sketch is on."""

    @property
    def is_paper(self) -> bool:
        """Whether there is nothing but the paper yet."""
        return isinstance(self, Sketch) and self.is_blank

    def forbids(self, state: State, action: Action) -> str | None:
        """Refuse edits of the scene, and another unit."""
        del state
        return "" if action.name in REFUSED else None

    def ready_for(self, state: State, action: Action) -> State:
        """Keep the answer for an action on a scene, or leave it."""
        return (
            keep(state, None)
            if action.name in _KEEPS
            else leave_sketch(state)
            if action.name in _LEAVES
            else state
        )

    def aged(self, state: State) -> State:
        """Show the linkage that was worked out for this frame."""
        return come(state)
