"""The dimensions of a scene as a list to be edited, and the scene with some of them changed.

A change is made to the document and read again, so that it is checked exactly as a file is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import Any

from linkanim import units
from linkanim.scenes.editing.labels import label
from linkanim.scenes.own_title import retitled
from linkanim.scenes.reading.drive import DEFAULT_SPEED
from linkanim.scenes.reading.joints import DimensionKind, Key, reader_of
from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.reading.shorthand import SHORTHANDS
from linkanim.scenes.scene import Scene

_BARE = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?", re.I | re.A)
_EXACT = 2**53
_WITH_UNIT = ("speed", "angle", "stiffness", "damping", "mass", "inertia", "gravity")
"""Kinds that a document writes with their unit, and never as a bare number."""

_PIN: Mapping[str, DimensionKind] = {"length": "length", "angle": "angle"}
_BODY: Mapping[str, DimensionKind] = {"com": "offset", "mass": "mass", "inertia": "inertia"}
_STRUT: Mapping[str, DimensionKind] = {
    "stiffness": "stiffness",
    "free_length": "length",
    "coefficient": "damping",
}
_STROKES: Mapping[str, DimensionKind] = {"cylinder": "length", "slider": "offset"}
_DRIVE: Mapping[str, DimensionKind] = {"speed": "speed", "start": "angle"}


@dataclass(frozen=True, slots=True)
class Dimension:
    """One number of a scene that can be edited.

    `key` is its path into the document, `label` what it is called. `value` is in `unit`: the scene's for
    lengths, "" for a gear ratio, and for all else, such as angles and masses, the one it is written with. An
    "offset" is a length of either sign.
    """

    key: Key
    label: str
    value: float
    unit: str
    kind: DimensionKind


def dimensions(scene: Scene) -> tuple[Dimension, ...]:
    """Return what can be edited.

    In this order: the shorthand's, the joints', the pins', the bodies', the springs', the dampers', gravity,
    the drive's. Only what the file says is there, and always the drive's speed; nothing of a scene without a
    document.
    """
    if not scene.document:
        return ()
    return tuple(_dimension(scene, key, kind) for key, kind in _keys(scene.document))


def with_dimensions(scene: Scene, values: Mapping[Key, float | str]) -> Scene:
    """Return the scene with some dimensions changed at once; `scene` itself stays as it is.

    A number, or a text without a unit, is taken in the dimension's unit; a text may name another
    ("3 cm", "1 rad", "90 deg/s"), and a ratio may be a fraction ("1/3"). KeyError for a key that is
    not one of the scene's dimensions; SceneError and AssemblyError as reading a file raises them.
    """
    return retitled(scene, scene_from(_with(scene, values), name=scene.name, where=scene.name))


def passing(scene: Scene, values: Mapping[Key, float | str]) -> Scene:
    """Return a scene on the way to `scene`, with these dimensions for an instant; errors as above.

    Where no dyad down the chain limits `scene`, none is looked at: one that does not close gives NaN.
    """
    return scene_from(_with(scene, values), name=scene.name, where=scene.name, towards=scene)


def _with(scene: Scene, values: Mapping[Key, float | str]) -> Mapping[str, Any]:
    known, document = {item.key: item for item in dimensions(scene)}, scene.document
    for key, value in values.items():
        document = _replaced(document, key, _written(value, known[key]))
    return document


def _keys(document: Mapping[str, Any]) -> Iterator[tuple[Key, DimensionKind]]:
    for name, shorthand in SHORTHANDS.items():
        yield from _numbers(document.get(name, {}), (name,), shorthand.numbers)
    for name, joint in document.get("joints", {}).items():
        reader = reader_of(joint)
        for (*within, last), kind in reader.numbers.items() if reader else ():
            table = reduce(lambda found, key: found.get(key, {}), within, joint)
            yield from _numbers(table, ("joints", name, *within), {str(last): kind})
    for name, pin in document.get("ground", {}).items():
        if isinstance(pin, Mapping):
            yield from _numbers(pin, ("ground", name), _PIN)
        else:
            yield from _numbers({name: pin}, ("ground",), {name: "offset"})
    for section, kinds in (("bodies", _BODY), ("springs", _STRUT), ("dampers", _STRUT)):
        for name, table in document.get(section, {}).items():
            yield from _numbers(table, (section, name), kinds)
    yield from _numbers(document, (), {"gravity": "gravity"})
    for name, kind in _STROKES.items():
        stroke = document.get("drive", {}).get(name, {})
        yield from _numbers(stroke, ("drive", name), {"from": kind, "to": kind})
    yield from _numbers({"speed": DEFAULT_SPEED, **document.get("drive", {})}, ("drive",), _DRIVE)


def _numbers(
    table: Mapping[str, Any], path: Key, kinds: Mapping[str, DimensionKind]
) -> Iterator[tuple[Key, DimensionKind]]:
    """Iterate the keys of those numbers in a table that have a kind, item by item where they are lists."""
    for name, value in table.items():
        if name in kinds and isinstance(value, list):
            yield from (((*path, name, i), kinds[name]) for i in range(len(value)))
        elif name in kinds:
            yield (*path, name), kinds[name]


def _dimension(scene: Scene, key: Key, kind: DimensionKind) -> Dimension:
    written = _at(scene.document, key)
    if kind in ("length", "offset"):
        value, unit = units.length(written, unit=scene.length_unit), scene.length_unit
    elif kind == "ratio":
        value, unit = float(Fraction(written)), ""
    else:
        value, unit = units.split(written)
    return Dimension(key, label(key, scene), value, unit, kind)


def _written(value: float | str, dimension: Dimension) -> object:
    """Return a new value as the document writes it: a number, or a text with its unit."""
    text = value.strip() if isinstance(value, str) else repr(value)
    bare = _BARE.fullmatch(text) is not None
    if dimension.kind in _WITH_UNIT:
        return f"{text} {dimension.unit}" if bare else text
    if not bare:
        return text
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < _EXACT else number


def _at(document: Mapping[str, Any], key: Key) -> Any:
    """Return what stands at a key; the default speed where the file has none."""
    if key == ("drive", "speed") and "speed" not in document.get("drive", {}):
        return DEFAULT_SPEED
    value: Any = document
    for part in key:
        value = value[part]
    return value


def _replaced(document: Any, key: Key, value: object) -> Any:
    """Return the document with another value at a key; the tables around it are new, the rest is shared."""
    if not key:
        return value
    part, rest = key[0], key[1:]
    if isinstance(document, list):
        return [_replaced(item, rest, value) if i == part else item for i, item in enumerate(document)]
    return {**document, part: _replaced(document.get(part, {}), rest, value)}
