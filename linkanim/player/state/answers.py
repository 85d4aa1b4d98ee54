"""What the window answers to a key, in a word or two: "reverse", "40 rpm", "crossed", "3 / 14"."""

from __future__ import annotations

from linkanim.picture.diagrams.quantities import quantity
from linkanim.picture.look import answer
from linkanim.picture.parts.driven import speed_words
from linkanim.player.state.state import State
from linkanim.scenes.reading.closure import closure_name


def speed(_: State, after: State) -> str:
    """Say the input's speed."""
    return speed_words(after.scene, after.clock.speed)


def direction(_: State, after: State) -> str:
    """Say which way the phase runs."""
    return "forward" if after.clock.direction > 0 else "reverse"


def place(before: State, after: State) -> str | None:
    """Say which of the shelf's mechanisms is on."""
    return None if after.scene is before.scene else f"{after.place + 1} / {len(after.shelf)}"


def closure(before: State, after: State) -> str | None:
    """Say which of the two closures is on."""
    return None if after.scene is before.scene else closure_name(after.scene)


def chart(before: State, after: State) -> str | None:
    """Say what is charted."""
    token = after.look.chart
    if token == before.look.chart:
        return None
    return quantity(after.scene, token).words if token else "no chart"


def of_look(name: str, before: State, after: State) -> str | None:
    """Say what is shown now of a field of the look."""
    return answer(before.look, after.look, name)


def zoom(_: State, after: State) -> str:
    """Say how large the picture is."""
    return f"{after.look.zoom:.0%}".replace("%", " %")


def undo(before: State, after: State) -> str | None:
    """Say that there was nothing to undo or redo; else the picture says it."""
    return "nothing there" if before.editing == after.editing else None
