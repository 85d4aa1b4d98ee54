"""Joints dragged while the list of dimensions is open: their lengths follow live, one undo a drag."""

from __future__ import annotations

from dataclasses import dataclass, replace
from decimal import Decimal

from linkanim.errors import LinkanimError
from linkanim.player.state.editing import Editing, changed, loss_of_turning, step_of
from linkanim.scenes.editing.edit import dimensions, with_dimensions
from linkanim.scenes.editing.handles import dragged, handles
from linkanim.scenes.reading.joints import Key
from linkanim.scenes.scene import Scene


@dataclass(frozen=True)
class Held:
    """A joint that is being dragged: the scene and the phase it was taken at, and whether that ran on."""

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


def carried_to(
    editing: Editing, scene: Scene, held: Held, point: tuple[float, float], share: float
) -> tuple[Editing, Scene]:
    """Return the scene with the joint dragged to a point, or the same scene and why it is refused.

    However far it is dragged, undo goes back to where it was taken.
    """
    try:
        after = with_dimensions(held.scene, values_at(held, point, share))
        lost = loss_of_turning(held.scene.info, after.info)
    except LinkanimError as error:
        return replace(editing, refusal=str(error).removeprefix(f"{scene.name}: ")), scene
    if lost:
        return replace(editing, refusal=lost), scene
    kept = editing if scene is not held.scene else changed(editing, held.scene)
    return replace(kept, typed="", refusal=None, warned=False), after
