"""The dimensions of a scene as a list to be edited, and the scene with some of them changed.

A change is made to the document and read again, so that it is checked exactly as a file is.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from linkanim import units
from linkanim.scenes.editing.numbers import Number, numbers
from linkanim.scenes.editing.titles import retitled
from linkanim.scenes.fields.form import Key
from linkanim.scenes.fields.types import LENGTHS, Measure, ValueType
from linkanim.scenes.reading.read import Check, scene_from
from linkanim.scenes.scene import Scene

_BARE = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?", re.I | re.A)
_EXACT = 2**53


@dataclass(frozen=True, slots=True)
class Dimension:
    """One number of a scene that can be edited.

    `key` is its path into the document, `label` what it is called. `value` is in `unit`: the scene's for
    lengths, "" for a gear ratio, and for all else, such as angles and masses, the one it is written with;
    only what is `bare` may be written without.
    """

    key: Key
    label: str
    value: float
    unit: str
    kind: Measure
    bare: bool


def dimensions(scene: Scene) -> tuple[Dimension, ...]:
    """Return what can be edited, in the order of the scene file's form.

    Only what the file says is there, and always the drive's speed; nothing of a scene without a document.
    """
    return tuple(_dimension(number, scene) for number in numbers(scene.document)) if scene.document else ()


def with_dimensions(scene: Scene, values: Mapping[Key, float | str]) -> Scene:
    """Return the scene with some dimensions changed at once; `scene` itself stays as it is.

    A number, or a text without a unit, is taken in the dimension's unit; a text may name another
    ("3 cm", "1 rad", "90 deg/s"), and a ratio may be a fraction ("1/3"). KeyError for a key that is
    not one of the scene's dimensions; SceneError and AssemblyError as reading a file raises them.
    """
    return with_document(scene, with_values(scene, values))


def with_document(scene: Scene, document: Mapping[str, Any], check: Check | None = None) -> Scene:
    """Return the scene with its document changed; `check` and errors as reading a file has them."""
    return retitled(scene, scene_from(document, name=scene.name, where=scene.name, check=check))


def passing(scene: Scene, values: Mapping[Key, float | str]) -> Scene:
    """Return a scene on the way to `scene`, with these dimensions for an instant; errors as above.

    Where no dyad down the chain limits `scene`, none is looked at: one that does not close gives NaN.
    """
    return scene_from(with_values(scene, values), name=scene.name, where=scene.name, towards=scene)


def with_values(scene: Scene, values: Mapping[Key, float | str]) -> Mapping[str, Any]:
    """Return the scene's document with some dimensions changed; KeyError as above."""
    known, document = {number.key: number for number in numbers(scene.document)}, scene.document
    for key, value in values.items():
        document = replaced(document, key, written(value, _dimension(known[key], scene)))
    return document


def _dimension(number: Number, scene: Scene) -> Dimension:
    return dimension_of(number.key, number.label(scene), number.type, number.written, scene.length_unit)


def dimension_of(key: Key, label: str, kind: ValueType, stated: Any, length_unit: str) -> Dimension:
    """Return what is `stated` of a number as it can be edited, lengths in that unit."""
    measure = kind.measure
    assert measure
    if measure in LENGTHS:
        value, unit = units.length(stated, unit=length_unit), length_unit
    elif measure == "ratio":
        value, unit = float(Fraction(stated)), ""
    else:
        value, unit = units.split(stated)
    return Dimension(key, label, value, unit, measure, kind.bare)


def written(value: float | str, dimension: Dimension) -> object:
    """Return a new value as the document writes it: a number, or a text with its unit."""
    text = value.strip() if isinstance(value, str) else repr(value)
    if _BARE.fullmatch(text) is None or not dimension.bare:
        return with_unit(text, dimension)
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < _EXACT else number


def with_unit(text: str, dimension: Dimension) -> str:
    """Return a value as it is typed with the dimension's unit, where it is a number without any."""
    return f"{text} {dimension.unit}" if _BARE.fullmatch(text.strip()) and dimension.unit else text


def replaced(document: Any, key: Key, value: object) -> Any:
    """Return the document with another value at a key; the tables around it are new, the rest is shared."""
    if not key:
        return value
    part, rest = key[0], key[1:]
    if isinstance(document, list):
        return [replaced(item, rest, value) if i == part else item for i, item in enumerate(document)]
    return {**document, part: replaced(document.get(part, {}), rest, value)}
