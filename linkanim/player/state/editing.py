"""Editing dimensions: the list, the value being typed, what was refused and why, undo and redo.

Every change gives a new scene or a refusal; the last good scene always runs on. A joint that is dragged
while the list is open takes its lengths along, one undo a drag.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

from linkanim.digits import degrees, typeset
from linkanim.errors import LinkanimError
from linkanim.mechanics.facts.classify import Info
from linkanim.scenes.editing.edit import Dimension, dimensions, with_dimensions, with_unit, with_values
from linkanim.scenes.editing.handles import dragged, handles
from linkanim.scenes.editing.shown_unit import in_unit
from linkanim.scenes.fields.form import Key
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

    `typed` is a value begun in the chosen row and not taken, `drafts` those begun in rows that were passed
    on from, `refusal` the reason why they were not taken. With `warned` they can be taken all the same, by
    asking once more. `original` is the scene as its file has it, once that was left.
    """

    open: bool = False
    chosen: int = 0
    typed: str = ""
    drafts: tuple[tuple[Key, str], ...] = ()
    refusal: str | None = None
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


def choose(editing: Editing, scene: Scene, further: int) -> Editing:
    """Return the list so many rows further, a value begun let go."""
    count = len(dimensions(scene))
    return _clear(editing, chosen=(editing.chosen + further) % count if count else 0)


def pass_on(editing: Editing, scene: Scene, further: int) -> Editing:
    """Return the list so many rows further, a value begun kept as a draft, to be judged with the others."""
    return choose(replace(editing, drafts=_drafts(editing, scene)), scene, further)


def write(editing: Editing, text: str) -> Editing:
    """Return the editing with text added to the value being typed."""
    return _clear(editing, typed=(editing.typed + text)[:_LONGEST])


def erase(editing: Editing, scene: Scene) -> Editing:
    """Return the editing with the last typed character gone; that of the row's draft, where none is typed."""
    item = chosen(editing, scene)
    draft = dict(editing.drafts).get(item.key, "") if item else ""
    kept = tuple(pair for pair in editing.drafts if not item or pair[0] != item.key)
    return _clear(editing, typed=(editing.typed or draft)[:-1], drafts=kept)


def let_go(editing: Editing) -> Editing:
    """Return the editing with nothing begun: the value typed here first, then all drafts."""
    return _clear(editing) if editing.typed else _clear(editing, drafts=())


def take(editing: Editing, scene: Scene, unit: str | None = None) -> tuple[Editing, Scene]:
    """Return the scene with all values begun in place at once, or the same scene and the refusal.

    Lengths without a unit are in the one that is shown, the scene's own without any.
    """
    values = dict(_drafts(editing, scene))
    return _tried(editing, scene, values, editing.typed, unit) if values else (editing, scene)


def nudge(editing: Editing, scene: Scene, steps: int, unit: str | None = None) -> tuple[Editing, Scene]:
    """Return the scene with the chosen value so many small steps larger, or the same and the refusal.

    A step depends on the unit that is shown alone, so that as many steps back end on the same value.
    """
    item = chosen(editing, in_unit(scene, unit))
    if item is None:
        return editing, scene
    text = _nudged(item, steps)
    return _tried(_clear(editing), scene, {item.key: text}, text, unit)


def _nudged(item: Dimension, steps: int) -> str:
    """Return a dimension's value so many small steps larger, as it would be typed."""
    value = Decimal(repr(item.value)) + steps * step_of(item.unit)
    return f"{value.normalize():f}"


def step_of(unit: str) -> Decimal:
    """Return the step in which a dimension of that unit is nudged."""
    return Decimal(_NUDGE.get(unit, "1"))


def undo(editing: Editing, scene: Scene) -> tuple[Editing, Scene]:
    """Return the scene before the last change; a value begun or refused is let go of first."""
    if editing.begun:
        return let_go(editing), scene
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
    original = editing.original or scene
    return _clear(editing, past=(*editing.past, scene)[-_KEPT:], future=(), original=original)


def reset(editing: Editing, scene: Scene) -> tuple[Editing, Scene]:
    """Return the scene as its file has it; undo goes back."""
    if editing.original is None or editing.original == scene:
        return _clear(editing, drafts=()), scene
    return changed(replace(editing, drafts=()), scene), editing.original


def _drafts(editing: Editing, scene: Scene) -> tuple[tuple[Key, str], ...]:
    """Return all values begun, that of the chosen row the last."""
    item = chosen(editing, scene)
    if item is None or not editing.typed:
        return editing.drafts
    return (*(pair for pair in editing.drafts if pair[0] != item.key), (item.key, editing.typed))


def _tried(
    editing: Editing, scene: Scene, values: Mapping[Key, str], typed: str, unit: str | None
) -> tuple[Editing, Scene]:
    """Put values where they belong, all at once; refused ones stay begun, to be mended.

    Values that end the crank's full turn are refused once, with the way to take them all the same. The
    reason is in the unit that is shown.
    """
    try:
        before, shown = in_unit(scene, unit), with_dimensions(in_unit(scene, unit), values)
        loss = None if editing.warned else loss_of_turning(before.info, shown.info)
        after = shown if before is scene else with_dimensions(scene, united(before, values))
    except LinkanimError as error:
        reason = str(error).removeprefix(f"{scene.name}: ")
        return replace(editing, typed=typed, refusal=_reason(reason, values, scene), warned=False), scene
    if loss:
        refusal = f"{loss} (Enter again takes it)"
        return replace(editing, typed=typed, refusal=refusal, warned=True), scene
    drafts = tuple(pair for pair in editing.drafts if pair[0] not in values)
    return changed(replace(editing, drafts=drafts), scene), after


def united(shown: Scene, values: Mapping[Key, str]) -> dict[Key, str]:
    """Return values with their unit, those that have none with that of a scene as it is shown."""
    items = {item.key: item for item in dimensions(shown)}
    return {key: with_unit(text, items[key]) for key, text in values.items()}


def loss_of_turning(before: Info, after: Info) -> str | None:
    """Say that the input no longer turns fully, where it did; else None."""
    if after.full_turn or not before.full_turn:
        return None
    low, high = (typeset(degrees(limit)) for limit in after.input_range)
    cause = f"{after.why_swinging}: " if after.why_swinging else ""
    return f"{cause}the crank cannot turn fully; it swings {low}…{high}"


def _reason(message: str, values: Mapping[Key, str], scene: Scene) -> str:
    """Leave out the key of a single value, beside which the reason stands; of several say it in words."""
    if len(values) == 1:
        return _KEY.sub("", message)
    words = {".".join(map(str, item.key)): item.label for item in dimensions(scene) if item.key in values}
    key, _, reason = message.partition(": ")
    return f"{words[key]}: {reason}" if key in words else message


def _clear(editing: Editing, **changes: object) -> Editing:
    """Return the editing with nothing begun and nothing refused, and these changes."""
    return replace(editing, **{"typed": "", "refusal": None, "warned": False, **changes})  # type: ignore[arg-type]


@dataclass(frozen=True)
class Held:
    """A joint that is being dragged, "" for the chosen value: where it was taken, and whether that ran on."""

    joint: str
    scene: Scene
    phase: float
    ran: bool


def values_at(held: Held, point: tuple[float, float], share: float) -> dict[Key, str]:
    """Return the dimensions that put the joint near a point, in whole steps of their units times `share`."""
    places = held.scene.pose(held.phase, 0).position
    units = {item.key: item.unit for item in dimensions(held.scene)}
    found = {}
    for handle in handles(held.scene, held.joint):
        step = step_of(units[handle.key]) * Decimal(repr(share))
        value = step * round(Decimal(repr(dragged(handle, places, point))) / step)
        found[handle.key] = f"{value.normalize():f}"
    return found


def pulled_by(editing: Editing, held: Held, steps: int, unit: str | None) -> dict[Key, str]:
    """Return the chosen dimension so many small steps of the unit that is shown from where it was taken."""
    shown = in_unit(held.scene, unit)
    item = chosen(editing, shown)
    values = {item.key: _nudged(item, steps)} if item else {}
    return values if shown is held.scene else united(shown, values)


def changed_to(
    editing: Editing, scene: Scene, held: Held, values: Mapping[Key, str]
) -> tuple[Editing, Scene]:
    """Return the scene that was taken hold of with these values, or the same scene and why it is refused.

    However far they are dragged, undo goes back to where they were taken.
    """
    try:
        if with_values(held.scene, values) == scene.document:
            return replace(editing, typed="", refusal=None, warned=False), scene
        after = with_dimensions(held.scene, values)
        lost = loss_of_turning(held.scene.info, after.info)
    except LinkanimError as error:
        return replace(editing, refusal=str(error).removeprefix(f"{scene.name}: ")), scene
    if lost:
        return replace(editing, refusal=lost), scene
    kept = editing if scene is not held.scene else changed(editing, held.scene)
    return replace(kept, typed="", refusal=None, warned=False), after
