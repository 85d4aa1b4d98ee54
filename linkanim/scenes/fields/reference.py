"""The form of a scene file as people read it: a table in Markdown, a row for each key."""

from __future__ import annotations

import json
from collections.abc import Iterator

from linkanim.scenes.fields.form import NEEDED, Field, Form, Named
from linkanim.scenes.fields.scene_file import SCENE_FILE


def reference() -> str:
    """Return every key that a scene file may have, table by table."""
    head = ["| key | value | what it is | if left out |", "|---|---|---|---|"]
    return "\n".join(
        [*head, *_rows(SCENE_FILE), *(row for one in SCENE_FILE.fields for row in _section(one))]
    )


def _section(one: Field) -> Iterator[str]:
    """Yield the rows of one of the file's tables, or of each form that tables by names may have."""
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
            yield from _rows(one.type, f"{within}{one.key}.")
        elif one.plain and one.plain.schema is not None:
            yield f"| `{within}{one.key}` | {one.plain.words} | {one.words} | {_left_out(one)} |"


def _left_out(one: Field) -> str:
    if one.usual is NEEDED:
        return "needed"
    return f"`{json.dumps(one.usual)}`" if one.usual or one.usual == 0 else "–"
