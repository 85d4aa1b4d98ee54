"""Describe the state as an overlay: what lies over the picture, and what a sheet shows."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from linkanim.picture.overlay import (
    Fading,
    Hover,
    Overlay,
    SwingShown,
)
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.commands import bar
from linkanim.player.state import (
    SHUTTER_FRAMES,
    Changeover,
    State,
)
from linkanim.ui.pointing import Pointed, hover_text
from linkanim.words import said, to_say

if TYPE_CHECKING:
    pass

# What lies over the picture: the state as an overlay.

_BAR = to_say("Space pause · Tab next · drag any joint · right click: all commands · H keys")
_BAR_FRAMES = 6 * FRAMES_PER_SECOND
_WATCH_FRAMES = 6 * FRAMES_PER_SECOND


def overlay(
    state: State,
    hover: str | None = None,
    row: int | None = None,
    over: Hover | None = None,
    button: int | None = None,
    pointed: Pointed | None = None,
) -> Overlay:
    """Return all that the window shows beside the scene.

    These are what is under the mouse: `hover` a joint, `row` a row of a list, `over` a place of a sheet,
    `button` the number of a command on the bar, `pointed` a thing of the scene with words about it.
    """
    lists = _lasting(state, over)
    return replace(
        lists,
        pointed=row if lists.listed else None,
        toast=_plain(lists.toast or (state.toast.text if state.toast else None)),
        chip=_chip(state),
        hint=_hint_bar(state),
        watch=None if state.game else _watch(state),
        glow=_glow(state, hover),
        hover_text=hover_text(state, pointed) if pointed else None,
        instant=pointed.instant if pointed else None,
        grip=state.look.chart is not None and not state.game,
        shutter=0 if state.shot is None else 8 - 8 * (state.frame - state.shot) // SHUTTER_FRAMES,
        swing=_swing(state),
        bar=bar(state, button),
    )


def _plain(text: str | None) -> str | None:
    """Return a message without the marks in which a terminal's messages have commands."""
    return text and text.replace("`", "")


def _swing(state: State) -> SwingShown | None:
    """Return the closure that is left, and how far, while the linkage swings over."""
    swing = state.glide if isinstance(state.glide, Changeover) else None
    return SwingShown(swing.left, swing.share(state.frame)) if swing else None


def _glow(state: State, hover: str | None) -> str | None:
    """Return the joint of the scene that is lit: the one in the hand, else the one under the mouse."""
    held = state.held or state.grasp
    joint = held.joint if held else hover
    return joint if joint in state.shown.linkage.by_name else None


def lasting(state: State) -> Overlay:
    """Return the part of the overlay that belongs on a screenshot: all that does not come and go."""
    found = _lasting(state)
    return replace(found, measured=(), tools=found.tools if state.building else None)


def recorded(state: State, *, photo: bool = False) -> Overlay:
    """Return what a recording shows of the overlay: no marks, tools and short messages.

    A photograph behind a sheet is shown only with `photo`.
    """
    shown = replace(_lasting(state, recorded=True), toast=None, paused=False, tools=None)
    photo_ = shown.photo if photo else None
    return replace(shown, photo=photo_, glow=_glow(state, None), swing=_swing(state))


def _lasting(state: State, over: Hover | None = None, *, recorded: bool = False) -> Overlay:
    overlay = Overlay(
        paused=_stands(state) and not state.game,
        noted=True,
        recording=_recording(state),
        hover=over,
        recorded=recorded,
    )
    for mode in state.modes:
        overlay = mode.shown(state, overlay)
    return replace(overlay, hover=None)


def _stands(state: State) -> bool:
    """Return whether the motion is paused, and not merely dragged by a hand."""
    return state.clock.paused and not (state.grasp and state.grasp.ran)


def _chip(state: State) -> Fading | None:
    return Fading(state.chip.text, min(state.chip.until - state.frame, 8)) if state.chip else None


def _hint_bar(state: State) -> Fading | None:
    """Return the hint bar: once, after the first seconds, unless the user does something before."""
    if state.touched or not state.is_bare or state.toast or state.chip:
        return None
    since = max(state.frame - _WATCH_FRAMES, 0)
    eighths = min(since, _BAR_FRAMES - since, 32) // 4
    return Fading(said(_BAR), eighths) if eighths > 0 else None


def _watch(state: State) -> Fading | None:
    """Return the sentence on what to watch for: with the names, and in a mechanism's first seconds.

    Of these it is there until something is done.
    """
    if state.is_covered or state.recording or state.toast:
        return None
    gone = state.frame - (state.frame if state.arrived is None else state.arrived)
    is_new = 0 < gone < _WATCH_FRAMES and state.touched <= (state.arrived or 0)
    return Fading(said(state.shown.look_at)) if is_new or state.look.names else None


def _recording(state: State) -> str | None:
    if state.recording is None:
        return None
    seconds = (state.frame - state.recording.since) // FRAMES_PER_SECOND
    return said(
        "REC {format} {time}",
        format=state.recording.format.upper(),
        time=f"{seconds // 60}:{seconds % 60:02d}",
    )
