"""The tables [guide], [function] and [quick-return]: what a linkage was made for.

Their lengths have a unit, always: they are no dimensions that one edits, and follow no change of the unit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from linkanim.scenes.fields.form import Field, Form, form
from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import ANGLE, OFFSET, TEXT, Schema, ValueType
from linkanim.scenes.purpose import FunctionPurpose, PosesPurpose, TimeRatioPurpose

_FEWEST_POSES, _MOST_POSES = 2, 5
_FEWEST_POINTS, _MOST_POINTS = 2, 12
_STATED: Schema = {"type": "string", "pattern": r"[a-z]"}


def _with_unit(table: Table, key: str, of: ValueType, example: str) -> float:
    value = table.values[key]
    if not isinstance(value, str):
        raise table.error(key, f'needs its unit; write it as "{example}"')
    found: float = of.read(table, key)
    return found


def _length(table: Table, key: str) -> float:
    return _with_unit(table, key, OFFSET, "80 mm")


def _number(table: Table, key: str) -> float:
    value = table.values[key]
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise table.error(key, "must be a finite number")
    return float(value)


def _ratio(table: Table, key: str) -> float:
    ratio = _number(table, key)
    if ratio < 1:
        raise table.error(key, "is the slow way's time over the quick way's; give 1 or more")
    return ratio


def _listed(read: Any, words: str, item: Schema, low: int, high: int) -> ValueType:
    """Return the type of a list of so many values."""

    def take(table: Table, key: str) -> tuple[Any, ...] | None:
        value = table.values[key]
        if not isinstance(value, list) or not low <= len(value) <= high:
            raise table.error(key, f"must be a list of {low} to {high} {words}")
        items = table.listed(key)
        found = tuple(items.attempt(read, items, one) for one in items.values)
        return None if None in found else found

    schema = {"type": "array", "items": item, "minItems": low, "maxItems": high}
    return ValueType(take, f"{low} to {high} {words}", schema)


def _pose(table: Table, key: str) -> tuple[Any, ...] | None:
    value = table.values[key]
    if not isinstance(value, list) or len(value) != 3:
        raise table.error(key, 'must be x, y and an angle, such as ["40 mm", "10 mm", "35 deg"]')
    items = table.listed(key)
    reads = (_length, _length, ANGLE.read)
    found = tuple(items.attempt(read, items, one) for read, one in zip(reads, items.values, strict=True))
    return None if None in found else found


def _place(table: Table, key: str) -> float:
    """Read an angle, or a way along a line."""
    value = table.values[key]
    angular = isinstance(value, str) and any(sign in value for sign in ("deg", "rad", "°"))
    return _with_unit(table, key, ANGLE if angular else OFFSET, "30 deg")


_POSES = _listed(
    _pose,
    'poses, `["40 mm", "10 mm", "35 deg"]`',
    {"type": "array", "items": _STATED, "minItems": 3, "maxItems": 3},
    *(_FEWEST_POSES, _MOST_POSES),
)
_NUMBERS = _listed(_number, "numbers", {"type": "number"}, _FEWEST_POINTS, _MOST_POINTS)
_ANGLES = _listed(ANGLE.read, "angles", _STATED, _FEWEST_POINTS, _MOST_POINTS)
_PLACES = _listed(_place, "angles, or lengths", _STATED, _FEWEST_POINTS, _MOST_POINTS)


def _refuse_uneven(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse precision points that have not one of each."""
    counts = {len(values[key]) for key in ("x", "y", "input", "output")}
    if len(counts) > 1:
        raise table.wrong("x, y, input and output have to be equally long: one of each a precision point")


def _refuse_both(table: Table, values: Mapping[str, Any]) -> None:
    if ("stroke" in values) == ("swing" in values):
        raise table.wrong("give either the slider's stroke or the rocker's swing")


PURPOSES: Mapping[str, Form] = {
    "guide": form(
        "the poses that its coupler was made for",
        Field("poses", _POSES, "x, y and angle of the first traced joint and its body"),
        make=PosesPurpose,
    ),
    "function": form(
        "the function that it was made for, in its precision points",
        Field("words", TEXT, 'such as "y = log10(x)"'),
        Field("x", _NUMBERS, "where it is exact"),
        Field("y", _NUMBERS, "what it is there"),
        Field("input", _ANGLES, "the crank's angle there"),
        Field("output", _PLACES, "the output's angle there, or the slider's way along its line"),
        refuse=_refuse_uneven,
        make=FunctionPurpose,
    ),
    "quick-return": form(
        "the time ratio that it was made for",
        Field(
            "ratio", ValueType(_ratio, "a number from 1", {"type": "number", "minimum": 1}), "slow to quick"
        ),
        Field("stroke", ValueType(_length, 'a length, `"80 mm"`', _STATED), "of the slider", None),
        Field("swing", ValueType(ANGLE.read, ANGLE.words, ANGLE.schema), "of the rocker", None),
        refuse=_refuse_both,
        make=TimeRatioPurpose,
    ),
}
"""The tables by their names."""
