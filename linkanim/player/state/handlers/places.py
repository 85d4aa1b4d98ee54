"""Actions that take the paused input to a place that is typed: its angle in degrees, or a slider's travel."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite, radians

from linkanim.mechanics.facts.register import input_symbol
from linkanim.picture.parts.driven import driven_words
from linkanim.player.state.state import State, Toast, with_toast

_STANDS = 240
_LONGEST = 12


def write(state: State, text: str) -> State:
    """Add to the place that is typed, which a chip shows for as long as it is waited for."""
    return _begun(state, (state.place_typed + text)[:_LONGEST])


def erase(state: State, _: None) -> State:
    """Take the last letter off the place that is typed."""
    return _begun(state, state.place_typed[:-1])


def _begun(state: State, text: str) -> State:
    chip = Toast(f"{_symbol(state)} = {text}_", state.frame + _STANDS) if text else None
    return replace(state, place_typed=text, chip=chip)


def _symbol(state: State) -> str:
    return input_symbol(state.scene.linkage).translate({ord("{"): None, ord("}"): None})


def go(state: State, _: None) -> State:
    """Go to the place that was typed; say the input's range where it does not come there."""
    text, state = state.place_typed, replace(state, place_typed="", chip=None)
    if not text:
        return state
    scene, path = state.displayed, state.displayed.mechanism.assembly.path
    try:
        value = float(text)
    except ValueError:
        return with_toast(state, f"{text} is no number")
    place = radians(value) if scene.linkage.drive.coordinate.is_angle else value
    if not isfinite(place) or not path.holds(place):
        unit = scene.linkage.drive.coordinate.shown_unit(f" {scene.length_unit}")
        ends = "…".join(driven_words(scene, end) for end in scene.info.input_range)
        return with_toast(state, f"the {scene.info.input_name} does not reach {text}{unit}; it goes {ends}")
    phase = path.phase_of(place, state.phase)
    return replace(state, clock=state.clock.go(state.frame, phase, paused=True))
