"""Give the form of a scene file to others: as a JSON Schema, and as a table in Markdown.

Its parts, in reading order:

- The JSON Schema of scene files, for editors: which keys are allowed where, and the types of their values.
- The form of a scene file as people read it: a table in Markdown, a row for each key.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from linkanim.bounds import MOST_NAMES
from linkanim.scenes.file_form import SCENE_FILE, SHORTHANDS
from linkanim.scenes.form import NEEDED, OF_DRIVE, Field, Form, Named, Schema, ValueType

# The JSON Schema of scene files, for editors: which keys are allowed where, and the types of their values.
#
# A schema cannot find problems of several places at once (a joint that does not exist, bars that do not
# meet); `reading.problems` does.

_NAME: Schema = {"maxLength": 32, "pattern": r"^[^.\s]([^.]*[^.\s])?$", "not": {"const": OF_DRIVE}}


def schema_of(what: ValueType | Form | Named) -> dict[str, Any]:
    """Return the schema of a value, of a table, or of a table of named tables."""
    if isinstance(what, ValueType):
        return dict(what.schema or {})
    if isinstance(what, Form):
        return {"anyOf": [_table(what), schema_of(what.plain.type)]} if what.plain else _table(what)
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
    "anyOf": [{"required": [key]} for key in ("joints", "points", *SHORTHANDS)],
}
"""The schema; TOML and JSON have the same tables, lists and values."""


# The form of a scene file as people read it: a table in Markdown, a row for each key.


def reference() -> str:
    """Return every key that a scene file may have, table by table."""
    head = ["| key | value | what it is | if left out |", "|---|---|---|---|"]
    return "\n".join(
        [*head, *_rows(SCENE_FILE), *(row for one in SCENE_FILE.fields for row in _section(one))]
    )


def _section(one: Field) -> Iterator[str]:
    """Yield the rows of one of the file's tables, or of each form that its named tables may have."""
    if isinstance(one.type, Form):
        yield f"| **`[{one.key}]`** | | **{one.words}** | |"
        yield from _rows(one.type)
    elif isinstance(one.type, Named):
        for form in one.type.forms:
            yield f"| **`[{one.key}.NAME]`** | | **{form.words}** | |"
            yield from _rows(form)
        if one.type.plain:
            plain = one.type.plain.plain
            yield f"| `{one.key}.NAME` | {plain.words if plain else ''} | {one.type.plain.words} | – |"


def _rows(form: Form, within: str = "") -> Iterator[str]:
    for one in form.fields:
        if isinstance(one.type, Form) and form is not SCENE_FILE:
            plain = one.type.plain
            if plain and plain.plain:
                yield f"| `{within}{one.key}` | {plain.plain.words} | {plain.words} | {_left_out(one)} |"
            yield from _rows(one.type, f"{within}{one.key}.")
        elif one.plain and one.plain.schema is not None:
            yield f"| `{within}{one.key}` | {one.plain.words} | {one.words} | {_left_out(one)} |"


def _left_out(one: Field) -> str:
    if one.usual is NEEDED:
        return "needed"
    return f"`{json.dumps(one.usual)}`" if one.usual or one.usual == 0 else "–"
