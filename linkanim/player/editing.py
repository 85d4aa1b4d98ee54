"""Editing dimensions: the list, the value being typed, what was refused and why, undo and redo.

Every change gives a new scene or a refusal; the last good scene always runs on.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from decimal import Decimal

from linkanim.digits import degrees, typeset
from linkanim.errors import LinkanimError
from linkanim.mechanics.classify import Info
from linkanim.scenes.edit import Dimension, dimensions, with_dimension
from linkanim.scenes.scene import Scene

_KEY = re.compile(r"^[\w.\[\]-]+( =|:) ")
_KEPT = 100
_LONGEST = 40
_NUDGE = {
    "mm": "1", "cm": "0.1", "m": "0.001", "in": "0.1",
    "deg": "1", "°": "1", "rad": "0.01",
    "rpm": "1", "deg/s": "5", "°/s": "5", "rad/s": "0.1",
}  # fmt: skip


@dataclass(frozen=True)
class Editing:
    """Where the editing stands; `past` and `future` are the scenes that undo and redo go to.

    `typed` is a value begun and not taken, `refusal` the reason why it was not. With `warned` the
    value can be taken all the same, by asking once more.
    """

    open: bool = False
    chosen: int = 0
    typed: str = ""
    refusal: str | None = None
    warned: bool = False
    past: tuple[Scene, ...] = ()
    future: tuple[Scene, ...] = ()

    @property
    def changed(self) -> bool:
        """Whether the scene is no longer as it was loaded."""
        return bool(self.past)


def chosen(editing: Editing, scene: Scene) -> Dimension | None:
    """Return the dimension that the list stands at; None where the scene has none."""
    items = dimensions(scene)
    return items[editing.chosen % len(items)] if items else None


def choose(editing: Editing, scene: Scene, further: int) -> Editing:
    """Return the list so many rows further, a value begun let go."""
    count = len(dimensions(scene))
    return _clear(editing, chosen=(editing.chosen + further) % count if count else 0)


def write(editing: Editing, text: str) -> Editing:
    """Return the editing with text added to the value being typed."""
    return _clear(editing, typed=(editing.typed + text)[:_LONGEST])


def erase(editing: Editing) -> Editing:
    """Return the editing with the last typed character gone."""
    return _clear(editing, typed=editing.typed[:-1])


def take(editing: Editing, scene: Scene) -> tuple[Editing, Scene]:
    """Return the scene with the typed value in place, or the same scene and the refusal."""
    return (editing, scene) if not editing.typed else _tried(editing, scene, editing.typed)


def nudge(editing: Editing, scene: Scene, steps: int) -> tuple[Editing, Scene]:
    """Return the scene with the chosen value so many small steps larger, or the same and the refusal.

    A step depends on the unit alone, so that as many steps back end on the same value.
    """
    item = chosen(editing, scene)
    if item is None:
        return editing, scene
    value = Decimal(repr(item.value)) + steps * Decimal(_NUDGE.get(item.unit, "1"))
    return _tried(_clear(editing), scene, f"{value.normalize():f}")


def undo(editing: Editing, scene: Scene) -> tuple[Editing, Scene]:
    """Return the scene before the last change; a value begun or refused is let go of first."""
    if editing.typed:
        return _clear(editing), scene
    if not editing.past:
        return editing, scene
    *earlier, last = editing.past
    return _clear(editing, past=tuple(earlier), future=(*editing.future, scene)), last


def redo(editing: Editing, scene: Scene) -> tuple[Editing, Scene]:
    """Return the scene that the last undo left, or the same where there is none."""
    if not editing.future:
        return editing, scene
    *later, following = editing.future
    return _clear(editing, past=(*editing.past, scene), future=tuple(later)), following


def changed(editing: Editing, scene: Scene) -> Editing:
    """Return the editing after `scene` was exchanged for another; undo goes back to it."""
    return _clear(editing, past=(*editing.past, scene)[-_KEPT:], future=())


def _tried(editing: Editing, scene: Scene, text: str) -> tuple[Editing, Scene]:
    """Put a value where the list stands; a refused one stays typed, to be mended.

    One that ends the crank's full turn is refused once, with the way to take it all the same.
    """
    item = chosen(editing, scene)
    if item is None:
        return editing, scene
    try:
        after = with_dimension(scene, item.key, text)
        loss = None if editing.warned else _loss(scene.info, after.info)
    except LinkanimError as error:
        return replace(editing, typed=text, refusal=_reason(str(error), scene), warned=False), scene
    if loss:
        return replace(editing, typed=text, refusal=loss, warned=True), scene
    return changed(editing, scene), after


def _loss(before: Info, after: Info) -> str | None:
    """Say that the input no longer turns fully, where it did; else None."""
    if after.full_turn or not before.full_turn:
        return None
    low, high = (typeset(degrees(limit)) for limit in after.input_range)
    cause = f"{after.grashof}: " if after.grashof else ""
    return f"{cause}the crank cannot turn fully; it swings {low}…{high} (Enter takes it all the same)"


def _reason(message: str, scene: Scene) -> str:
    """Leave out the scene's name and the key: the reason stands beside the value."""
    return _KEY.sub("", message.removeprefix(f"{scene.name}: "))


def _clear(editing: Editing, **changes: object) -> Editing:
    """Return the editing with nothing begun and nothing refused, and these changes."""
    return replace(editing, **{"typed": "", "refusal": None, "warned": False, **changes})  # type: ignore[arg-type]
