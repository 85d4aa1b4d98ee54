"""Actions on the list of dimensions, and on what is undone and redone."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from linkanim.player.state import editing as edit_
from linkanim.player.state.editing import Editing, Held, changed_to, pulled_by, values_at
from linkanim.player.state.glide import glide
from linkanim.player.state.handlers.shelf import exchanged
from linkanim.player.state.state import State
from linkanim.scenes.editing.closures import other_return
from linkanim.scenes.editing.edit import dimensions
from linkanim.scenes.editing.handles import handles
from linkanim.scenes.fields.form import Key
from linkanim.scenes.scene import Scene
from linkanim.units import metre

AGAIN = "R again: the file's dimensions"

Handler = Callable[[State, Any], State]


def edit(state: State, _: None) -> State:
    """Open or close the list; a joint is dropped, values begun are let go of, undo and redo stay."""
    state = drop(state, None)
    editing = edit_.choose(replace(state.editing, drafts=()), state.scene, 0)
    return replace(state, editing=replace(editing, open=not editing.open), listing=None, browsing=None)


def grab(state: State, joint: str) -> State:
    """Take hold of a joint while the list is open: the picture stands still, the list at its dimension."""
    keys = [item.key for item in dimensions(state.scene)]
    found = handles(state.scene, joint) if joint in state.scene.linkage.by_name else ()
    if not state.editing.open or not found:
        return state
    held = Held(joint, state.scene, state.phase, not state.clock.paused)
    state = drop(state, None)
    editing = edit_.choose(replace(state.editing, chosen=keys.index(found[0].key)), state.scene, 0)
    clock = state.clock.pause(state.frame, True)
    return replace(state, held=held, editing=editing, clock=clock, glide=None)


def carry(state: State, to: tuple[float, float, float]) -> State:
    """Drag the held joint to a point of the scene as shown, in whole units of its own times `to[2]`."""
    held = state.held
    if held is None or not held.joint or not to[2] > 0.0:
        return state
    ratio = metre(state.displayed.length_unit) / metre(state.scene.length_unit)
    point, before = (to[0] * ratio, to[1] * ratio), state.scene
    state = _dragged(state, held, values_at(held, point, to[2]))
    if state.scene is before:
        return state
    angle = held.scene.pose(held.phase, 0).coordinate
    phase = state.scene.mechanism.assembly.path.phase_of(angle, state.phase)
    return replace(state, clock=state.clock.go(state.frame, phase, paused=True))


def grab_row(state: State, row: int) -> State:
    """Take hold of a row's value; what is begun in another row waits as a draft."""
    items, state = dimensions(state.scene), drop(state, None)
    if not state.editing.open or not 0 <= row < len(items):
        return state
    further = row - state.editing.chosen % len(items)
    editing = edit_.pass_on(state.editing, state.scene, further) if further else state.editing
    held = Held("", state.scene, state.phase, not state.clock.paused)
    return replace(state, held=held, editing=editing, glide=None)


def pull(state: State, steps: int) -> State:
    """Change the value that is held by so many small steps from what it was."""
    held = state.held
    if held is None or held.joint:
        return state
    return _dragged(state, held, pulled_by(state.editing, held, steps, state.look.unit))


def _dragged(state: State, held: Held, values: Mapping[Key, str]) -> State:
    editing, scene = changed_to(state.editing, state.scene, held, values)
    return replace(state if scene is state.scene else exchanged(state, scene), editing=editing)


def drop(state: State, _: None) -> State:
    """Let go of the joint; what ran before runs on."""
    if state.held is None:
        return state
    clock = state.clock.pause(state.frame, not state.held.ran)
    return replace(state, held=None, clock=clock, editing=replace(state.editing, refusal=None))


def _listed(work: Callable[[Editing, Scene, Any], Editing]) -> Handler:
    """Make a handler of what changes the list alone."""
    return lambda state, value: replace(state, editing=work(state.editing, state.scene, value))


def _remade(work: Callable[[State, Any], tuple[Editing, Scene]]) -> Handler:
    """Make a handler of what may give another scene; the picture follows it smoothly."""

    def handle(state: State, value: Any) -> State:
        editing, scene = work(state, value)
        if scene is state.scene:
            return replace(state, editing=editing)
        way = glide(state.shown, scene, state.frame)
        return replace(exchanged(state, scene), editing=editing, glide=way)

    return handle


choose = _listed(edit_.choose)
pass_on = _listed(edit_.pass_on)
write = _listed(lambda editing, _, text: edit_.write(editing, text))
erase = _listed(lambda editing, scene, _: edit_.erase(editing, scene))
nudge = _remade(lambda state, steps: edit_.nudge(state.editing, state.scene, steps, state.look.unit))
take = _remade(lambda state, _: edit_.take(state.editing, state.scene, state.look.unit))
undo = _remade(lambda state, _: edit_.undo(state.editing, state.scene))
redo = _remade(lambda state, _: edit_.redo(state.editing, state.scene))
reset = _remade(lambda state, _: edit_.reset(state.editing, state.scene))
returns = _remade(lambda state, _: (edit_.changed(state.editing, state.scene), other_return(state.scene)))


def start(state: State, _: None) -> State:
    """Go back to the start; once more, while the chip says so, to the file's dimensions as well."""
    again = state.chip is not None and state.sketch is None and state.chip.text == AGAIN
    state = replace(reset(state, None) if again else state, chip=None)
    return replace(state, clock=state.clock.go(state.frame, 0.0))


def way_back(_: State, after: State) -> str | None:
    """Say how the file's dimensions come back, where others are on."""
    return AGAIN if after.place in after.edited else None
