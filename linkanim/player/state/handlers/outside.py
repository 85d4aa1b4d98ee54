"""Actions that the window carries out: the state only says so, in its effects."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Literal

from linkanim.player.state import editing as edit_
from linkanim.player.state.handlers import build
from linkanim.player.state.handlers.edits import edit
from linkanim.player.state.handlers.pencil import left
from linkanim.player.state.state import State, Take, with_effect, with_toast

_MEANT = "recording: Q again ends it, writes it and quits"


def sounds(state: State, _: None) -> State:
    """Switch sounds on or off."""
    return replace(state, sounds=not state.is_audible)


def pad(state: State, name: str) -> State:
    """Take note of the gamepad that was plugged in, or that the last one is gone."""
    told = f"{name}: its left stick turns the crank; H lists its buttons" if name else "the gamepad is gone"
    return with_toast(replace(state, pad=bool(name)), told)


def back(state: State, _: None) -> State:
    """Let go of what lies on top: the help, a list, a value begun; never of the window.

    From a mechanism it leads back to the title, where the window opened on that.
    """
    if state.help:
        return replace(state, help=False)
    if state.listing or state.browsing:
        return replace(state, listing=None, browsing=None)
    if state.sketch and not state.editing.open:
        return left(state)
    if state.building:
        return build.let_go(state) or build.left(state)
    if state.editing.open and state.editing.begun:
        return replace(state, editing=edit_.let_go(state.editing))
    if state.place_typed:
        return replace(state, place_typed="", chip=None)
    if state.editing.open:
        return edit(state, None)
    if state.attract and state.games:
        return with_effect(state, "begin", "title")
    return with_toast(state, "Q quits")


def quit_(state: State, _: None) -> State:
    """Ask for the window's end; while something is recorded, first whether that is meant."""
    if state.recording and (state.toast is None or state.toast.text != _MEANT):
        return with_toast(state, _MEANT)
    return build.closing(state) or with_effect(state, "quit")


def close(state: State, _: None) -> State:
    """Ask for the window's end by its own button; once more where a draft is in no file."""
    return build.closing(state) or with_effect(state, "quit")


def record(state: State, form: Literal["gif", "mp4"]) -> State:
    """Start a recording, or stop the one that runs, whichever its format is."""
    if state.recording is None:
        return replace(with_effect(state, "record", form), recording=Take(form, state.frame))
    return replace(with_effect(state, "render", state.recording.format), recording=None)


def shot(name: str) -> Callable[[State, None], State]:
    """Return the handler of what keeps the picture: the shutter is seen to go."""
    return lambda state, _: replace(with_effect(state, name), shot=state.frame)


def effect(name: str) -> Callable[[State, str | None], State]:
    """Return the handler of what changes nothing in the picture."""
    return lambda state, value: with_effect(state, name, value)
