"""The other closure: the same lengths, put together the other way."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.errors import AssemblyError, LinkanimError
from linkanim.scenes.editing.edit import replaced, with_document
from linkanim.scenes.fields.shorthands import SHORTHANDS
from linkanim.scenes.scene import Scene


class _Choice(NamedTuple):
    """Where a document says which closure holds, which it is, and which is the other."""

    key: tuple[str, ...]
    name: str
    other: str


def other_closure(scene: Scene) -> Scene:
    """Return the scene with its first loop on the other closure; twice gives the same linkage again.

    Of several loops it is the one nearest the input. AssemblyError where there is no second closure,
    or where it cannot be assembled further down the chain.
    """
    choice = _choice(scene)
    if choice is None:
        raise AssemblyError(f"{scene.name} has no second closure: no loop of it can be put together two ways")
    document = replaced(scene.document, choice.key, choice.other)
    return with_document(scene, document)


def other_return(scene: Scene) -> Scene:
    """Return the scene whose input comes back from its limits on the other, or on the same, closure.

    AssemblyError where the input turns fully.
    """
    if scene.info.full_turn:
        raise AssemblyError(f"{scene.name}: its input turns fully, and never comes back")
    way = "other" if scene.linkage.drive.retraced else "same"
    document = replaced(scene.document, ("drive", "returns"), way)
    return with_document(scene, document)


def closure_name(scene: Scene) -> str | None:
    """Return what the first loop's closure is called (open, crossed, ...); None where it has no other."""
    choice = _choice(scene)
    return choice and choice.name


def ghost_of(scene: Scene) -> Scene | None:
    """Return the other closure, to be drawn behind this one; None where there is none."""
    try:
        return other_closure(scene)
    except LinkanimError:
        return None


def _choice(scene: Scene) -> _Choice | None:
    """Return where the first closure that can be chosen is; a missing key means the first option."""
    document = scene.document
    joints = document.get("joints", {})
    fields = ((key, form.field("assembly").plain) for key, form in SHORTHANDS.items() if key in document)
    shorthands = [((key, "assembly"), plain.options) for key, plain in fields if plain]
    dyads = (joint for joint in scene.linkage.joints if joint.name in joints)
    sides = [(("joints", joint.name, "side"), joint.sides) for joint in dyads if joint.sides]
    for (*tables, key), options in (*shorthands, *sides):
        table = document
        for name in tables:
            table = table[name]
        found = table.get(key, options[0])
        return _Choice((*tables, key), found, options[found == options[0]])
    return None
