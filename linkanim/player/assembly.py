"""The other closure: the same lengths, put together the other way."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.errors import AssemblyError, LinkanimError
from linkanim.mechanics.linkage import RRP, RRR
from linkanim.scenes.read import scene_from
from linkanim.scenes.scene import Scene

_SHORTHANDS = {
    "four-bar": ("open", "crossed"),
    "slider-crank": ("forward", "backward"),
    "six-bar": ("open", "crossed"),
}
_SIDES: Mapping[type, tuple[str, str]] = {RRR: ("left", "right"), RRP: ("forward", "backward")}


def other_closure(scene: Scene) -> Scene:
    """Return the scene with its first loop on the other closure; twice gives the same linkage again.

    Of several loops it is the one nearest the input. AssemblyError where there is no second closure,
    or where it cannot be assembled further down the chain.
    """
    document = _switched(scene)
    return scene_from(document, name=scene.name, where=scene.name)


def ghost_of(scene: Scene) -> Scene | None:
    """Return the other closure, to be drawn behind this one; None where there is none."""
    try:
        return other_closure(scene)
    except LinkanimError:
        return None


def _switched(scene: Scene) -> dict[str, Any]:
    document = dict(scene.document)
    for table, options in _SHORTHANDS.items():
        if table in document:
            return {**document, table: _toggled(document[table], "assembly", options)}
    joints = document.get("joints", {})
    dyads = (joint for joint in scene.linkage.joints if type(joint) in _SIDES and joint.name in joints)
    dyad = next(dyads, None)
    if dyad is None:
        raise AssemblyError(f"{scene.name} has no second closure: no loop of it can be put together two ways")
    toggled = _toggled(joints[dyad.name], "side", _SIDES[type(dyad)])
    return {**document, "joints": {**joints, dyad.name: toggled}}


def _toggled(table: Mapping[str, Any], key: str, options: tuple[str, str]) -> dict[str, Any]:
    """Return the table with the other option of the two; the first is the one a missing key means."""
    return {**table, key: options[table.get(key, options[0]) == options[0]]}
