"""Actions on the list of dimensions, and on what is undone and redone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from linkanim.player import editing as edit_
from linkanim.player.editing import Editing
from linkanim.player.glide import glide
from linkanim.player.handlers.shelf import exchanged
from linkanim.player.state import State
from linkanim.scenes.scene import Scene

Handler = Callable[[State, Any], State]


def edit(state: State, _: None) -> State:
    """Open or close the list; values begun are let go of, undo and redo stay."""
    editing = edit_.choose(replace(state.editing, drafts=()), state.scene, 0)
    return replace(state, editing=replace(editing, open=not editing.open), listing=None, browsing=None)


def _listed(work: Callable[[Editing, Scene, Any], Editing]) -> Handler:
    """Make a handler of what changes the list alone."""
    return lambda state, value: replace(state, editing=work(state.editing, state.scene, value))


def _remade(work: Callable[[Editing, Scene, Any], tuple[Editing, Scene]]) -> Handler:
    """Make a handler of what may give another scene; the picture follows it smoothly."""

    def handle(state: State, value: Any) -> State:
        editing, scene = work(state.editing, state.scene, value)
        if scene is state.scene:
            return replace(state, editing=editing)
        way = glide(state.shown, scene, state.frame)
        return replace(exchanged(state, scene), editing=editing, glide=way)

    return handle


choose = _listed(edit_.choose)
pass_on = _listed(edit_.pass_on)
write = _listed(lambda editing, _, text: edit_.write(editing, text))
erase = _listed(lambda editing, scene, _: edit_.erase(editing, scene))
nudge = _remade(edit_.nudge)
take = _remade(lambda editing, scene, _: edit_.take(editing, scene))
undo = _remade(lambda editing, scene, _: edit_.undo(editing, scene))
redo = _remade(lambda editing, scene, _: edit_.redo(editing, scene))
