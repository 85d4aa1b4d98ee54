"""Actions of the pencil: a stroke is drawn, answers come, points and pivots are dragged, one is kept."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from linkanim.errors import BadInput
from linkanim.player.dial import dialled, ready
from linkanim.player.edits import drop, exchanged, followed
from linkanim.player.state import (
    DIAL,
    PIVOTS,
    Sketch,
    State,
    nothing_begun,
    with_effect,
    with_toast,
    with_undo,
)
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.curves import DrawnCurve

# The rest of the search is imported when the pencil is taken: the first frame does not wait for it.

_SAME = 0.02
"""Of the stroke's size: pins nearer to each other are one."""
MOST_POINTS = 5_000
"""Of a stroke under way; further ones are left out."""


def pencil(state: State, _: None) -> State:
    """Take the pencil, or lay it down and go back to the scene that was on."""
    if state.sketch:
        return left(state)
    state = drop(state, None)
    editing = replace(state.editing, open=False)
    sketch = Sketch(state.scene, state.clock, nothing_begun(editing), state.displayed.length_unit)
    state = replace(state, sketch=sketch, editing=editing, listing=None, browsing=None, glide=None)
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
    return _sketching(_searched(pencil(state, None), curve), answers=(scene,))


def left(state: State) -> State:
    """Lay the pencil down; the scene that was on comes back as if it had gone on."""
    sketch = state.sketch
    if sketch is None:
        return state
    faded = state.faded if state.scene is sketch.before else state.frame
    back = replace(state, sketch=None, glide=None, faded=faded)
    return replace(back, scene=sketch.before, clock=sketch.clock, editing=sketch.editing)


def keep(state: State, _: None) -> State:
    """Lay the pencil down and keep the answer in the scene's place; undo brings that back."""
    sketch = state.sketch
    if sketch is None or sketch.is_blank or state.scene is sketch.before:
        return left(state)
    return replace(state, sketch=None, editing=with_undo(sketch.editing, sketch.before))


def down(state: State, at: tuple[float, float]) -> State:
    """Begin a stroke."""
    return _sketching(state, pen=(complex(*at),), held=None)


def along(state: State, at: tuple[float, float]) -> State:
    """Draw the stroke on to a point."""
    sketch = state.sketch
    if sketch is None or not 0 < len(sketch.pen) < MOST_POINTS:
        return state
    return _sketching(state, pen=(*sketch.pen, complex(*at)))


def up(state: State, _: None) -> State:
    """End the stroke, and ask for linkages that follow it; one without extent is forgotten."""
    import numpy as np

    from linkanim.synthesis.curves import stroke_of

    sketch = state.sketch
    if sketch is None or not sketch.pen:
        return state
    try:
        curve = stroke_of(np.array(sketch.pen))
    except BadInput:
        return off(state, None)
    return _searched(state, curve)


def off(state: State, _: None) -> State:
    """Forget the stroke that was begun."""
    return _sketching(state, pen=())


def stroke(state: State, numbers: tuple[float, ...]) -> State:
    """Take a stroke as it is: 1 where it is closed, else 0, and its points x, y, x, y, …"""
    from linkanim.synthesis.curves import drawn

    points = [complex(x, y) for x, y in zip(numbers[1::2], numbers[2::2], strict=True)]
    return _searched(state, drawn(points, closed=numbers[0] > 0)) if state.sketch else state


def _searched(state: State, curve: DrawnCurve) -> State:
    """Return the state with another stroke, linkages for which are asked for."""
    assert state.sketch
    earlier = replace(state.sketch, pen=())
    bare = replace(undialled(earlier), answers=(), chosen=0, names=(), way=(), pivots=(), earlier=earlier)
    sketch = replace(bare, curve=curve, strokes=bare.strokes + 1)
    return with_effect(replace(state, sketch=sketch, toast=None), "search")


def follow(state: State, numbers: tuple[float, ...]) -> State:
    """Show an answer that has come, in the place of the one that is shown."""
    from linkanim.synthesis.answers import answer_from

    sketch = state.sketch
    if sketch is None or sketch.curve is None:
        return state
    answer, unit = answer_from(numbers), sketch.unit
    if not sketch.answers:
        state = exchanged(state, answer.scene(unit))
        return _sketching(replace(state, glide=None, faded=state.frame), answers=(answer,))
    if isinstance(sketch.answer, Scene):
        return state
    answers = tuple(answer if n == sketch.chosen else one for n, one in enumerate(sketch.answers))
    if sketch.held is None:
        return followed(_sketching(state, answers=answers), answer.scene(unit))
    return _sketching(state, answers=answers, coming=ready(answer.scene(unit, sketch.base), state.phase))


def come(state: State) -> State:
    """Return the state with the linkage on that was worked out for this frame."""
    coming = state.sketch and state.sketch.coming
    return replace(_sketching(state, coming=None), scene=coming) if coming else state


def answers(state: State, numbers: tuple[float, ...]) -> State:
    """Take all answers as they are on older tapes, without sizes and angles."""
    from linkanim.synthesis.answers import EARLIER

    return _taken(state, round(numbers[0]), _answers_of(numbers[1:], EARLIER))


def cards(state: State, numbers: tuple[float, ...]) -> State:
    """Take all answers in place of those that are there: which is to be shown, and the numbers of each.

    One that was chosen meanwhile stays.
    """
    from linkanim.synthesis.answers import NUMBERS
    from linkanim.synthesis.front import names_of

    sketch, first, found = state.sketch, round(numbers[0]), _answers_of(numbers[1:], NUMBERS)
    if sketch and sketch.picked and isinstance(sketch.answer, tuple):
        found = (*found, *([] if sketch.answer in found else [sketch.answer]))
        first = found.index(sketch.answer)
    state = _taken(state, first, found)
    known = all(one.size > 0 for one in found)
    if not known or state.sketch is None or state.sketch.answers[-len(found) :] != found:
        return state
    own = len(state.sketch.answers) - len(found)
    return _sketching(state, names=(*own * ("",), *names_of([one.figures for one in found])))


def way(state: State, numbers: tuple[float, ...]) -> State:
    """Take the answers along the front, from the exact end to the compact one: 0, and the numbers of each."""
    from linkanim.synthesis.answers import NUMBERS

    if state.sketch is None or state.sketch.held is not None:
        return state
    return _sketching(state, way=_answers_of(numbers[1:], NUMBERS))


def _answers_of(numbers: tuple[float, ...], each: int) -> tuple[PathAnswer, ...]:
    from linkanim.synthesis.answers import answer_from

    return tuple(answer_from(numbers[n : n + each]) for n in range(0, len(numbers), each))


def _taken(state: State, first: int, found: tuple[PathAnswer, ...]) -> State:
    """Return the state with answers in place of those that are there, and one of them shown."""
    sketch = state.sketch
    if sketch is None or sketch.curve is None or sketch.held is not None:
        return state
    if not 0 <= first < len(found):
        return state
    if sketch.answers and isinstance(sketch.answers[0], Scene):
        own = in_unit(sketch.answers[0], sketch.unit)
        others = tuple(one for one in found if not _stands_on(own, one, sketch.curve.size))
        return _sketching(state, answers=(sketch.answers[0], *others))
    was_none, before = not sketch.answers, sketch.answer
    state = _sketching(state, answers=found, chosen=first)
    if before == found[first]:
        return state
    scene = found[first].scene(sketch.unit)
    if was_none:
        return replace(exchanged(state, scene), glide=None, faded=state.frame)
    return followed(state, scene)


def _stands_on(scene: Scene, answer: PathAnswer, size: float) -> bool:
    """Return whether an answer has the fixed pins of the scene whose trace it follows: it is that scene."""
    pins = [complex(*pin.position) for pin in scene.linkage.pins]
    x, y, *_, x4, y4, _ = answer.row
    own = complex(x, y), complex(x4, y4)
    return all(min((abs(pin - at) for at in pins), default=size) < _SAME * size for pin in own)


def choose(state: State, place: int) -> State:
    """Show another of the answers."""
    sketch = state.sketch
    if sketch is None or sketch.held is not None or (place == sketch.chosen and not sketch.dialled):
        return state
    if not 0 <= place < len(sketch.answers):
        return state
    scene = _scene_of(sketch.answers[place], sketch.unit)
    state = replace(exchanged(state, scene), glide=None, faded=state.frame)
    return replace(state, sketch=replace(undialled(sketch), chosen=place, picked=True))


def take_point(state: State, point: int) -> State:
    """Take hold of a point of the stroke."""
    sketch = state.sketch
    if sketch is None or sketch.curve is None or not 0 <= point < len(sketch.curve.points):
        return state
    return _held(state, sketch, point)


def take_pivot(state: State, pivot: str) -> State:
    """Take hold of a fixed pin of the answer that is shown."""
    sketch = state.sketch
    if sketch is None or pivot not in PIVOTS or sketch.answer is None or isinstance(sketch.answer, Scene):
        return state
    return _held(state, sketch, pivot)


def _held(state: State, sketch: Sketch, held: int | str) -> State:
    """Return the state with something of a sketch taken hold of; what the dial shows becomes an answer."""
    found = undialled(sketch)
    if sketch.dialled:
        answers = (*sketch.answers[: sketch.chosen], sketch.dialled, *sketch.answers[sketch.chosen + 1 :])
        found = replace(found, answers=answers)
    found = replace(found, way=(), names=(), picked=False, held=held, base=state.scene, earlier=sketch)
    return replace(state, glide=None, sketch=found)


def undialled(sketch: Sketch) -> Sketch:
    """Return a sketch of which nothing is dragged, its dial where the answer that was chosen is."""
    return replace(sketch, dial=None, dialled=None, held=None, picked=False)


def lead(state: State, to: tuple[float, float]) -> State:
    """Drag what is held to a point; what follows is asked for."""
    from linkanim.synthesis.curves import bent

    sketch = state.sketch
    if sketch is None or sketch.held is None or sketch.held == DIAL:
        return state
    if isinstance(sketch.held, str):
        pivots = {**dict(sketch.pivots), sketch.held: to}
        return with_effect(_sketching(state, pivots=tuple(pivots.items())), "follow")
    assert sketch.curve
    with suppress(BadInput):
        curve = bent(sketch.curve, sketch.held, complex(*to))
        state = with_effect(_sketching(state, curve=curve, **_without_own(sketch)), "follow")
    return state


def take_back(state: State, _: None) -> State:
    """Go back to the stroke and the answers before the last stroke or drag."""
    sketch = state.sketch
    if sketch is None or sketch.earlier is None or sketch.held is not None:
        return state
    back = replace(sketch.earlier, pen=(), strokes=sketch.strokes + (sketch.held != DIAL))
    state = replace(state, sketch=back)
    if back.answer is None:
        return with_effect(state, "search") if back.curve else state
    return followed(state, _scene_of(back.answer, back.unit))


def _scene_of(answer: PathAnswer | Scene, unit: str) -> Scene:
    return answer if isinstance(answer, Scene) else answer.scene(unit)


def _without_own(sketch: Sketch) -> dict[str, object]:
    """Return the answers without the scene whose trace was taken: the stroke is another curve now."""
    own = sum(isinstance(one, Scene) for one in sketch.answers)
    return {"answers": sketch.answers[own:], "chosen": max(sketch.chosen - own, 0)}


def let_go(state: State, _: None) -> State:
    """Let go of what was dragged; all answers to what is there now are asked for."""
    sketch = state.sketch
    if sketch is None or sketch.held is None:
        return state
    if sketch.held == DIAL:
        return dialled(state)
    answer = sketch.answer
    state = _sketching(state, held=None, base=None, coming=None)
    if answer and not isinstance(answer, Scene) and state.scene is not sketch.base:
        state = exchanged(state, answer.scene(sketch.unit))
    return with_effect(state, "search")


def _sketching(state: State, **changes: object) -> State:
    """Return the state with these changes of its sketch, if there is one."""
    return replace(state, sketch=state.sketch and replace(state.sketch, **changes))  # type: ignore[arg-type]
