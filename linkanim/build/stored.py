"""A draft as plain data, to be kept in a file and brought back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.build.draft import Draft, Photo
from linkanim.document import Section


def stored(draft: Draft) -> dict[str, Any]:
    """Return all of a draft as tables, lists, texts and numbers."""
    return {
        "places": {name: list(place) for name, place in draft.places.items()},
        "tables": {kind: dict(tables) for kind, tables in draft.tables.items()},
        "rest": dict(draft.rest),
        "typed": [list(key) for key in sorted(draft.typed, key=repr)],
        "photo": draft.photo and list(draft.photo),
        "short": draft.short,
        "phase": draft.phase,
    }


def restored(tables: Mapping[str, Any], where: str = "draft") -> Draft:
    """Return the draft that was stored; BadInput for what is none."""
    try:
        photo = tables["photo"] and Photo(tables["photo"][0], tuple(tables["photo"][1]), *tables["photo"][2:])
        return Draft(
            {str(name): (float(x), float(y)) for name, (x, y) in tables["places"].items()},
            {kind: dict(every) for kind, every in tables["tables"].items()},
            dict(tables["rest"]),
            frozenset(tuple(key) for key in tables["typed"]),
            photo,
            tables["short"],
            float(tables.get("phase", 0.0)),
        )
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        raise Section(where, {}).wrong(f"is no draft of linkanim: {type(error).__name__}") from None
