"""What lies over the picture: the state told in the words of the overlay."""

from __future__ import annotations

from dataclasses import replace

from linkanim.digits import significant
from linkanim.picture.overlay import EditRow, Overlay, Panel
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.editing import Editing, chosen
from linkanim.player.keys import help_rows
from linkanim.player.state import State
from linkanim.scenes.edit import dimensions
from linkanim.scenes.scene import Scene

_HINT = "↑ ↓ choose   ← → nudge   digits type   Enter takes   Ctrl+Z undo   Ctrl+S save   Esc closes"


def overlay(state: State) -> Overlay:
    """Return all that the window shows beside the scene at this state."""
    return Overlay(
        paused=state.clock.paused,
        noted=True,
        toast=state.toast.text if state.toast else None,
        recording=_recording(state),
        help=help_rows(editing=state.editing.open) if state.help else None,
        panel=panel(state.editing, state.scene) if state.editing.open else None,
    )


def _recording(state: State) -> str | None:
    if state.recording is None:
        return None
    seconds = (state.frame - state.recording.since) // FRAMES_PER_SECOND
    return f"REC {state.recording.format.upper()} {seconds // 60}:{seconds % 60:02d}"


def panel(editing: Editing, scene: Scene) -> Panel:
    """Return the list of dimensions, the value being typed in its place."""
    at = chosen(editing, scene)
    rows = tuple(
        EditRow(item.label, f"{significant(item.value, 10)} {item.unit}".strip(), chosen=item == at)
        for item in dimensions(scene)
    )
    if editing.typed:
        rows = tuple(replace(row, value=f"{editing.typed}_") if row.chosen else row for row in rows)
    return Panel(rows, error=editing.refusal, hint=_HINT)
