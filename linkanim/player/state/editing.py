"""Where the editing of dimensions stands: the value being typed, what was refused and why, undo and redo."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from linkanim.digits import degrees, typeset
from linkanim.errors import BadInput
from linkanim.mechanics.facts.classify import Info
from linkanim.mechanics.motion.mechanism import stopped
from linkanim.scenes.editing.edit import Dimension, dimensions
from linkanim.scenes.editing.handles import Handle, handles
from linkanim.scenes.fields.form import Key
from linkanim.scenes.scene import Scene

_KEPT = 100


@dataclass(frozen=True)
class Editing:
    """Where the editing stands; `past` and `future` are the scenes that undo and redo go to.

    `typed` is a value begun in the chosen row and not taken, `drafts` those begun in rows that were passed
    on from, `refusal` the reason why they were not taken; `refused` is the document that was dragged to. With
    `warned` they can be taken all the same, by asking once more. `original` is the scene as its file has it,
    once that was left.
    """

    open: bool = False
    chosen: int = 0
    typed: str = ""
    drafts: tuple[tuple[Key, str], ...] = ()
    refusal: str | None = None
    refused: Mapping[str, Any] | None = None
    warned: bool = False
    past: tuple[Scene, ...] = ()
    future: tuple[Scene, ...] = ()
    original: Scene | None = None

    @property
    def changed(self) -> bool:
        """Whether there is something to go back to or on to."""
        return bool(self.past or self.future)

    @property
    def begun(self) -> bool:
        """Whether a value, here or in another row, waits to be taken."""
        return bool(self.typed or self.drafts)


def chosen(editing: Editing, scene: Scene) -> Dimension | None:
    """Return the dimension that the list stands at; None where the scene has none."""
    items = dimensions(scene)
    return items[editing.chosen % len(items)] if items else None


def let_go(editing: Editing) -> Editing:
    """Return the editing with nothing begun: the value typed here first, then all drafts."""
    return cleared(editing) if editing.typed else cleared(editing, drafts=())


def changed(editing: Editing, scene: Scene) -> Editing:
    """Return the editing after `scene` was exchanged for another; undo goes back to it."""
    original = editing.original or scene
    return cleared(editing, past=(*editing.past, scene)[-_KEPT:], future=(), original=original)


def loss_of_turning(before: Info, after: Info) -> str | None:
    """Say that the input no longer turns fully, where it did; else None."""
    if after.full_turn or not before.full_turn:
        return None
    low, high = (typeset(degrees(limit)) for limit in after.input_range)
    cause = f"{after.why_swinging}: " if after.why_swinging else ""
    return f"{cause}the crank cannot turn fully; it swings {low}…{high}"


def check_of_turning(before: Info) -> Callable[[Scene], None]:
    """Return what refuses a scene whose input no longer turns fully, before it is worked out whole."""

    def check(scene: Scene) -> None:
        found = stopped(scene.linkage) if before.full_turn else None
        if found and (loss := loss_of_turning(before, Info(found, scene.length_unit))):
            raise BadInput(loss)

    return check


def cleared(editing: Editing, **changes: object) -> Editing:
    """Return the editing with nothing begun and nothing refused, and these changes."""
    return replace(editing, **{"typed": "", "refusal": None, "warned": False, **changes})  # type: ignore[arg-type]


@dataclass(frozen=True)
class Held:
    """A joint that is being dragged, "" for the chosen value: where it was taken, and whether that ran on."""

    joint: str
    scene: Scene
    phase: float
    ran: bool

    @cached_property
    def following(self) -> tuple[tuple[Handle, str], ...]:
        """The dimensions that follow the joint, with their units."""
        units = {item.key: item.unit for item in dimensions(self.scene)}
        return tuple((handle, units[handle.key]) for handle in handles(self.scene, self.joint))
