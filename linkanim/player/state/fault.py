"""Faults of a scene's solver: found before a scene is shown, told in a sentence, kept in a report.

A scene file passes its checks and may still meet a hole in the solver. The window then keeps the last
good linkage, and writes what is needed to find the hole.
"""

from __future__ import annotations

import traceback
from dataclasses import replace

from linkanim.errors import LinkanimError
from linkanim.player.state.action import Action
from linkanim.player.state.editing import chosen
from linkanim.player.state.state import State, with_effect, with_toast
from linkanim.scenes.scene import Scene

_TRIED = 90
_AT_A_VALUE = ("take", "nudge")


def proved(scene: Scene, phase: float) -> Scene:
    """Return the scene, the facts that a window shows, one cycle and a pose worked out; what that raises."""
    info = scene.info
    _ = info.class_name, info.grashof, info.change_points
    # Read, for a motion works out what is read of it; the picture asks for the same.
    _ = scene.cycle(_TRIED).position
    scene.pose(phase)
    return scene


def refused(state: State, action: Action, error: Exception) -> State:
    """Return the state as it was, the reason told where the value stands, or in a toast.

    What linkanim raises on purpose says its reason by itself; of anything else a report is written.
    """
    if isinstance(error, LinkanimError):
        return with_toast(state, str(error))
    sentence = f"the solver failed there ({named(error)}); the last good linkage runs on"
    item = chosen(state.editing, state.scene) if action.name in _AT_A_VALUE else None
    context = {"action": list(action), "key": item.key if item else None, "typed": state.editing.typed}
    state = with_effect(state, "report", report(state.scene, error, **context))
    if item is None:
        return with_toast(state, sentence)
    return replace(state, editing=replace(state.editing, refusal=sentence))


def named(error: Exception) -> str:
    """Return an exception's kind and words in one line."""
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")


def report(scene: Scene, error: Exception, **context: object) -> str:
    """Return, as JSON, the whole scene, the context, and where the solver failed."""
    import json

    from linkanim import __version__

    content = {
        "linkanim": __version__,
        "scene": scene.name,
        "document": scene.document,
        **context,
        "error": named(error),
        "traceback": traceback.format_exception(error),
    }
    return json.dumps(content, indent=1, ensure_ascii=False, default=str)


def recovered(state: State, good: State, error: Exception) -> State:
    """Return a state that can be painted instead of one that cannot; `good` is the last that was.

    A glide is left out; another scene than the last good one is taken off again; where the scene itself
    fails at this phase, it stands still at the last good one.
    """
    if state.glide:
        return replace(state, glide=None)
    clock = good.clock.go(state.frame, good.phase, paused=state.scene is good.scene or good.clock.paused)
    back = replace(good, frame=state.frame, clock=clock, glide=None, effects=(), recording=None)
    return with_toast(back, f"the solver failed there ({named(error)}); the last good linkage is back")
