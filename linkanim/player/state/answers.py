"""What the window answers to a key, in a word or two: "reverse", "40 rpm", "crossed", "3 / 14"."""

from __future__ import annotations

from linkanim.picture.diagrams.quantities import quantity
from linkanim.picture.parts.driven import speed_words
from linkanim.player.state.state import State
from linkanim.scenes.reading.closure import closure_name

_NAMES = ("no names", "names", "names and dimensions")
_CENTRES = ("no instant centres", "instant centres", "instant centres and centrodes")
_KINDS = {"v": "velocity", "a": "acceleration"}


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


def trace(_: State, after: State) -> str:
    """Say whether the trace is shown."""
    return "trace" if after.look.trace else "no trace"


def vectors(before: State, after: State) -> str:
    """Say which vectors came or went."""
    (kind,) = before.look.vectors ^ after.look.vectors
    return _KINDS[kind] if kind in after.look.vectors else f"no {_KINDS[kind]}"


def ghost(before: State, after: State) -> str | None:
    """Say whether the other closure is shown."""
    if before.look.ghost == after.look.ghost:
        return None
    return "both closures" if after.look.ghost else "one closure"


def chart(before: State, after: State) -> str | None:
    """Say what is charted."""
    token = after.look.chart
    if token == before.look.chart:
        return None
    return quantity(after.scene, token).words if token else "no chart"


def names(_: State, after: State) -> str:
    """Say what is named."""
    return _NAMES[after.look.names]


def polygons(_: State, after: State) -> str:
    """Say whether the polygons are shown."""
    return "polygons" if after.look.polygons else "no polygons"


def centres(_: State, after: State) -> str:
    """Say what is shown of the instant centres."""
    return _CENTRES[after.look.centres]


def theme(_: State, after: State) -> str:
    """Say which theme is on."""
    return after.look.theme


def zoom(_: State, after: State) -> str:
    """Say how large the picture is."""
    return f"{after.look.zoom:.0%}".replace("%", " %")


def undo(before: State, after: State) -> str | None:
    """Say that there was nothing to undo or redo; else the picture says it."""
    return "nothing there" if before.editing == after.editing else None
