"""The other closure: the same lengths, put together the other way."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.errors import AssemblyError, LinkanimError
from linkanim.scenes.own_title import retitled
from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.reading.shorthand import SHORTHANDS
from linkanim.scenes.scene import Scene


def other_closure(scene: Scene) -> Scene:
    """Return the scene with its first loop on the other closure; twice gives the same linkage again.

    Of several loops it is the one nearest the input. AssemblyError where there is no second closure,
    or where it cannot be assembled further down the chain.
    """
    document = _switched(scene)
    return retitled(scene, scene_from(document, name=scene.name, where=scene.name))


def closure_name(scene: Scene) -> str | None:
    """Return what the first loop's closure is called (open, crossed, ...); None where it has no other."""
    document = scene.document
    for table, shorthand in SHORTHANDS.items():
        if table in document:
            return str(document[table].get("assembly", shorthand.assemblies[0]))
    joints = document.get("joints", {})
    sides = ((joint.name, joint.sides) for joint in scene.linkage.joints if joint.name in joints)
    return next((str(joints[name].get("side", found[0])) for name, found in sides if found), None)


def ghost_of(scene: Scene) -> Scene | None:
    """Return the other closure, to be drawn behind this one; None where there is none."""
    try:
        return other_closure(scene)
    except LinkanimError:
        return None


def _switched(scene: Scene) -> dict[str, Any]:
    document = dict(scene.document)
    for table, shorthand in SHORTHANDS.items():
        if table in document:
            return {**document, table: _toggled(document[table], "assembly", shorthand.assemblies)}
    joints = document.get("joints", {})
    sides = ((joint.name, joint.sides) for joint in scene.linkage.joints if joint.name in joints)
    name, options = next(((name, found) for name, found in sides if found), ("", None))
    if options is None:
        raise AssemblyError(f"{scene.name} has no second closure: no loop of it can be put together two ways")
    return {**document, "joints": {**joints, name: _toggled(joints[name], "side", options)}}


def _toggled(table: Mapping[str, Any], key: str, options: tuple[str, str]) -> dict[str, Any]:
    """Return the table with the other option of the two; the first is the one a missing key means."""
    return {**table, key: options[table.get(key, options[0]) == options[0]]}
