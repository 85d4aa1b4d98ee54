"""Actions of the pencil: a stroke is drawn, answers come, points of the stroke and pivots are dragged."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from linkanim.errors import BadInput
from linkanim.player.dial import dialled
from linkanim.player.edits import drop, exchanged
from linkanim.player.sketching import left, released, sketching, taken
from linkanim.player.state import DIAL, PIVOTS, PathSketch, State, nothing_begun, with_effect, with_toast
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.curves import DrawnCurve

# The rest of the search is imported when the pencil is taken: the first frame does not wait for it.

MOST_POINTS = 5_000
"""The most points of a stroke under way; further ones are left out."""


def pencil(state: State, _: None) -> State:
    """Take the pencil, or put it down and go back to the scene from before."""
    if state.drawing:
        return left(state)
    state = drop(left(state), None)
    editing = replace(state.editing, open=False)
    sketch = PathSketch(state.scene, state.clock, nothing_begun(editing), state.displayed.length_unit)
    state = replace(state.unlisted, sketch=sketch, editing=editing, glide=None)
    return with_effect(replace(state, toast=None, faded=state.frame), "pencil")


def own(state: State, _: None) -> State:
    """Take the pencil, the scene's own trace as the stroke."""
    from linkanim.mechanics.measures import as_complex
    from linkanim.synthesis.curves import trace_of

    state = left(state)
    scene = state.scene
    if not scene.trace:
        return with_toast(state, f"{scene.name} has no trace to take; W draws a path")
    try:
        curve = trace_of(as_complex(state.displayed.cycle(720, derivatives=0).position[scene.trace[0]]))
    except BadInput as error:
        return with_toast(state, str(error))
    return sketching(_searched(pencil(state, None), curve), answers=(scene,))


def down(state: State, at: tuple[float, float]) -> State:
    """Begin a stroke."""
    return sketching(state, pen=(complex(*at),), held=None) if state.drawing else state


def along(state: State, at: tuple[float, float]) -> State:
    """Continue the stroke to a point."""
    sketch = state.drawing
    if sketch is None or not 0 < len(sketch.pen) < MOST_POINTS:
        return state
    return sketching(state, pen=(*sketch.pen, complex(*at)))


def up(state: State, _: None) -> State:
    """End the stroke, and ask for linkages that follow it; a stroke without extent is forgotten."""
    import numpy as np

    from linkanim.synthesis.curves import stroke_of

    sketch = state.drawing
    if sketch is None or not sketch.pen:
        return state
    try:
        curve = stroke_of(np.array(sketch.pen))
    except BadInput:
        return off(state, None)
    return _searched(state, curve)


def off(state: State, _: None) -> State:
    """Forget the stroke that was begun."""
    return sketching(state, pen=()) if state.drawing else state


def stroke(state: State, numbers: tuple[float, ...]) -> State:
    """Take a stroke that is given: 1 where it is closed, else 0, then its points x, y, x, y, …"""
    from linkanim.synthesis.curves import drawn

    points = [complex(x, y) for x, y in zip(numbers[1::2], numbers[2::2], strict=True)]
    return _searched(state, drawn(points, closed=numbers[0] > 0)) if state.drawing else state


def _searched(state: State, curve: DrawnCurve) -> State:
    """Return the state with another stroke, for which linkages are asked."""
    assert state.drawing
    earlier = replace(state.drawing, pen=())
    bare = replace(earlier.undialled, answers=(), chosen=0, names=(), way=(), pivots=(), earlier=earlier)
    sketch = replace(bare, curve=curve, strokes=bare.strokes + 1)
    return with_effect(replace(state, sketch=sketch, toast=None), "search")


def answers(state: State, numbers: tuple[float, ...]) -> State:
    """Take all answers from an older tape, which has no sizes and angles for them."""
    from linkanim.synthesis.answers import EARLIER

    return taken(state, round(numbers[0]), _answers_of(numbers[1:], EARLIER))


def cards(state: State, numbers: tuple[float, ...]) -> State:
    """Replace all answers: the number of the one to show, then the numbers of each answer.

    An answer that the user chose meanwhile stays.
    """
    from linkanim.synthesis.answers import NUMBERS
    from linkanim.synthesis.front import names_of

    sketch, first, found = state.drawing, round(numbers[0]), _answers_of(numbers[1:], NUMBERS)
    if sketch and sketch.picked and isinstance(sketch.answer, tuple):
        found = (*found, *([] if sketch.answer in found else [sketch.answer]))
        first = found.index(sketch.answer)
    after = taken(state, first, found)
    if after is state or after.drawing is None or not all(one.size > 0 for one in found):
        return after
    kept = [one for one in after.drawing.answers if not isinstance(one, Scene)]
    own = len(after.drawing.answers) - len(kept)
    return sketching(after, names=(*own * ("",), *names_of([one.figures for one in kept])))


def way(state: State, numbers: tuple[float, ...]) -> State:
    """Take the answers along the front, from the exact end to the compact one: 0, and the numbers of each."""
    from linkanim.synthesis.answers import NUMBERS

    if state.drawing is None or state.drawing.held is not None:
        return state
    return sketching(state, way=_answers_of(numbers[1:], NUMBERS))


def _answers_of(numbers: tuple[float, ...], each: int) -> tuple[PathAnswer, ...]:
    from linkanim.synthesis.answers import answer_from

    return tuple(answer_from(numbers[n : n + each]) for n in range(0, len(numbers), each))


def take_point(state: State, point: int) -> State:
    """Take hold of a point of the stroke."""
    sketch = state.drawing
    if sketch is None or sketch.curve is None or not 0 <= point < len(sketch.curve.points):
        return state
    return _held(state, sketch, point)


def take_pivot(state: State, pivot: str) -> State:
    """Take hold of a fixed pin of the answer that is shown."""
    sketch = state.drawing
    if sketch is None or pivot not in PIVOTS or sketch.answer is None or isinstance(sketch.answer, Scene):
        return state
    return _held(state, sketch, pivot)


def _held(state: State, sketch: PathSketch, held: int | str) -> State:
    """Return the state with a part of a sketch grasped; what the dial shows becomes an answer."""
    found = sketch.undialled
    if sketch.dialled:
        answers = (*sketch.answers[: sketch.chosen], sketch.dialled, *sketch.answers[sketch.chosen + 1 :])
        found = replace(found, answers=answers)
    found = replace(found, way=(), names=(), picked=False, held=held, base=state.scene, earlier=sketch)
    return replace(state, glide=None, sketch=found)


def lead(state: State, to: tuple[float, float]) -> State:
    """Drag what is held to a point, and ask for the linkage that follows."""
    from linkanim.synthesis.curves import bent

    sketch = state.drawing
    if sketch is None or sketch.held is None or sketch.held == DIAL:
        return state
    if isinstance(sketch.held, str):
        pivots = {**dict(sketch.pivots), sketch.held: to}
        return with_effect(sketching(state, pivots=tuple(pivots.items())), "follow")
    assert sketch.curve
    with suppress(BadInput):
        curve = bent(sketch.curve, sketch.held, complex(*to))
        state = with_effect(sketching(state, curve=curve, **_without_own(sketch)), "follow")
    return state


def _without_own(sketch: PathSketch) -> dict[str, object]:
    """Return the answers without the scene whose trace was taken, since the stroke is another curve now."""
    own = sum(isinstance(one, Scene) for one in sketch.answers)
    return {"answers": sketch.answers[own:], "chosen": max(sketch.chosen - own, 0)}


def cognate(state: State, place: int) -> State:
    """Show a cognate of the answer instead of it: one of those that turn fully."""
    sketch = state.drawing
    found = [one for one in sketch.cognates if one] if sketch else []
    if sketch is None or not 0 <= place < len(found):
        return with_toast(state, "none of its cognates turns fully") if sketch and sketch.follows else state
    from linkanim.synthesis.front import names_of

    answers = (*sketch.answers[: sketch.chosen], found[place], *sketch.answers[sketch.chosen + 1 :])
    figures = [one.figures for one in answers if isinstance(one, tuple) and one.size > 0]
    names = names_of(figures) if len(figures) == len(answers) == len(sketch.names) else ()
    taken = replace(sketch.undialled, answers=answers, names=names, picked=True, earlier=sketch)
    state = replace(exchanged(state, taken.scene_of(found[place])), glide=None, faded=state.frame)
    return replace(state, sketch=taken)


def let_go(state: State, _: None) -> State:
    """Release what was dragged; all answers to the sketch as it is now are asked for."""
    sketch = state.drawing
    if sketch is None or sketch.held is None:
        return state
    if sketch.held == DIAL:
        return dialled(state)
    return released(state)
