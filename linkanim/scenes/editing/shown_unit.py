"""A scene in another unit of length: for pictures, tables and lists."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from linkanim import units
from linkanim.errors import BadInput, SceneError
from linkanim.scenes.editing.edit import replaced
from linkanim.scenes.editing.numbers import numbers
from linkanim.scenes.fields.types import LENGTHS
from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.scene import Scene


def in_unit(scene: Scene, unit: str | None) -> Scene:
    """Return the scene in another unit of length, and with it of velocity; itself for its own, and for None.

    The same linkage: each length is read again with the unit that it was written in, and rounded once. It
    is for showing; what is edited and saved stays the scene that it is made from. It is worked out once.
    SceneError for what is no unit of length, for a scene without a document, and where a length is too
    large or small to be computed with in that unit.
    """
    if unit is None or unit == scene.length_unit:
        return scene
    if unit not in scene.elsewhere:
        scene.elsewhere[unit] = _read_in(scene, unit)
    return scene.elsewhere[unit]


def _read_in(scene: Scene, unit: str) -> Scene:
    if not scene.document:
        raise SceneError(f"{scene.name}: has no scene file behind it; it stays in {scene.length_unit}")
    document: Any = {**scene.document, "length_unit": unit}
    for number in (one for one in numbers(scene.document) if one.type.measure in LENGTHS):
        if not isinstance(number.written, str) or not units.split(number.written)[1]:
            document = replaced(document, number.key, f"{number.written} {scene.length_unit}")
    towards = scene.towards and in_unit(scene.towards, unit)
    try:
        found = scene_from(document, name=scene.name, where=scene.name, towards=towards)
    except BadInput as error:
        raise SceneError(f"{error}; show it in another unit") from None
    return replace(found, title=scene.title, original_title=scene.original_title)
