"""The JSON Schema of scene files, for editors: what may stand where, and of which kind it is.

What depends on several places at once (a joint that is not there, lengths that do not meet) no schema
says; `problems` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.bounds import MOST_NAMES
from linkanim.scenes.fields.form import NEEDED, Field, Form, Named
from linkanim.scenes.fields.scene_file import SCENE_FILE
from linkanim.scenes.fields.shorthands import SHORTHANDS
from linkanim.scenes.fields.types import Schema, ValueType

_NAME: Schema = {"maxLength": 32, "pattern": r"^[^.\s]([^.]*[^.\s])?$"}


def schema_of(what: ValueType | Form | Named) -> dict[str, Any]:
    """Return what a schema says of a value, a table or a table of named ones."""
    if isinstance(what, ValueType):
        return dict(what.schema or {})
    if isinstance(what, Form):
        return _table(what)
    entries = [schema_of(form) for form in what.forms]
    entries += [schema_of(what.plain.type)] if what.plain else []
    return {
        "type": "object",
        "maxProperties": MOST_NAMES,
        "propertyNames": _NAME,
        "additionalProperties": {"anyOf": entries} if entries[1:] else entries[0],
    }


def _table(form: Form) -> dict[str, Any]:
    known = {one.key: _described(one) for one in form.fields if not (one.plain and one.plain.schema is None)}
    firm = (one for one in form.fields if one.key == form.mark or not one.unless)
    needed = [one.key for one in firm if one.usual is NEEDED]
    table: dict[str, Any] = {"type": "object", "additionalProperties": False, "properties": known}
    table |= {"description": form.words} if form.words else {}
    table |= {"required": needed} if needed else {}
    together = {key: [other] for key, other in form.together.items()}
    return table | ({"dependentRequired": together} if together else {})


def _described(one: Field) -> dict[str, Any]:
    return {**schema_of(one.type), **({"description": one.words} if one.words else {})}


SCHEMA: Mapping[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    **schema_of(SCENE_FILE),
    "title": "A scene of linkanim",
    "anyOf": [{"required": [key]} for key in ("joints", *SHORTHANDS)],
}
"""The schema; TOML and JSON have the same tables, lists and values."""
