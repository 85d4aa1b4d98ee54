"""What lies over the picture: the state told in the words of the overlay."""

from __future__ import annotations

import re
from dataclasses import replace

from linkanim.digits import significant, typeset
from linkanim.picture.overlay import EditRow, Overlay, Panel, Quantities, Shelf
from linkanim.picture.quantities import quantity
from linkanim.picture.text import subscripted
from linkanim.player.browsing import Browsing, Listing, listed
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.editing import chosen
from linkanim.player.keys import help_groups
from linkanim.player.state import FLASH_FRAMES, State
from linkanim.scenes.edit import Dimension, dimensions

_HINT = "↑ ↓ choose   ← → nudge   type, Tab next   Enter takes   Ctrl+Z undo   Ctrl+S save   Esc closes"
_LIST_HINT = "↑ ↓ choose   letters sift   Enter charts   Esc closes"
_NAME = re.compile(r"\b[^\W\d_]\w*")
_STEPS = 12
"""So many shades of a flash: each is drawn once."""


def overlay(state: State) -> Overlay:
    """Return all that the window shows beside the scene at this state."""
    return Overlay(
        paused=state.clock.paused,
        noted=True,
        toast=state.toast.text if state.toast else None,
        recording=_recording(state),
        help=help_groups(state.mode) if state.help else None,
        panel=panel(state) if state.editing.open else None,
        quantities=_quantities(state, state.listing) if state.listing else None,
        shelf=_shelf(state, state.browsing) if state.browsing else None,
    )


def _quantities(state: State, listing: Listing) -> Quantities:
    scene = state.scene
    found = [quantity(scene, token) for token in listed(scene, listing.sieve)]
    rows = tuple((one.words, f"{one.symbol} ({one.shown_unit(scene.length_unit)})") for one in found)
    return Quantities(rows, listing.chosen, listing.sieve, _LIST_HINT)


def _shelf(state: State, browsing: Browsing) -> Shelf:
    frame, still = state.frame - browsing.since, state.clock.paused
    return Shelf(browsing.scenes, browsing.chosen, frame, state.look.theme, still=still)


def _recording(state: State) -> str | None:
    if state.recording is None:
        return None
    seconds = (state.frame - state.recording.since) // FRAMES_PER_SECOND
    return f"REC {state.recording.format.upper()} {seconds // 60}:{seconds % 60:02d}"


def panel(state: State) -> Panel:
    """Return the list of dimensions, the values begun in their places."""
    editing, info = state.editing, state.scene.info
    at, begun = chosen(editing, state.scene), dict(editing.drafts)
    rows = (_row(item, begun.get(item.key), chosen=item == at) for item in dimensions(state.scene))
    typed = f"{editing.typed}_" if editing.typed else None
    return Panel(
        tuple(replace(row, value=typed, draft=True) if typed and row.chosen else row for row in rows),
        facts=tuple(fact for fact in (info.class_name, info.grashof) if fact),
        flash=_flash(state),
        error=editing.refusal,
        hint=_HINT,
    )


def _row(item: Dimension, draft: str | None, *, chosen: bool) -> EditRow:
    label = _NAME.sub(lambda name: subscripted(name[0]), item.label)
    value = typeset(f"{significant(item.value, 10)} {item.unit}".strip())
    return EditRow(label, draft or value, chosen=chosen, draft=draft is not None)


def _flash(state: State) -> float:
    """Return how bright the facts are, from 1 as they change down to 0, in a few steps."""
    if state.turned is None:
        return 0.0
    part = (state.frame - state.turned) / FLASH_FRAMES
    return round(_STEPS * (1.0 - part) ** 2) / _STEPS
