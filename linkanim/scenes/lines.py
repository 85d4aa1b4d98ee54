"""At which line of a TOML text each key stands."""

from __future__ import annotations

import tomllib
from typing import Any

Keys = tuple[str, ...]

_PATIENCE = 3_000_000
"""Characters looked at, at the most: a list over very many lines is looked at anew for each of them."""


def lines_of(text: str) -> dict[Keys, int]:
    """Return the line, from 1, of every table and key of a TOML text; few of one that is very long."""
    found: dict[Keys, int] = {}
    table: Keys = ()
    begun, statement, seen = 1, "", 0
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        statement += line
        seen += len(statement)
        if seen > _PATIENCE:
            break
        try:
            document = tomllib.loads(statement)
        except ValueError:  # goes on in the next line
            continue
        at = begun if len(statement) > len(line) else number
        if statement.lstrip().startswith("["):
            table = _way(document)
            found.setdefault(table, at)
        else:
            for keys in _keys(document):
                found.setdefault((*table, *keys), at)
        statement, begun = "", number + 1
    return found


def _way(document: Any) -> Keys:
    """Return the keys of a header, [a.b] or [[a.b]]."""
    way: list[str] = []
    while document:
        document = document[0] if isinstance(document, list) else document
        if not document:
            break
        ((key, document),) = document.items()
        way.append(key)
    return tuple(way)


def _keys(document: dict[str, Any]) -> list[Keys]:
    """Return the keys in a statement, those of the tables in it too."""
    found: list[Keys] = []
    for key, value in document.items():
        found.append((key,))
        if isinstance(value, dict):
            found += [(key, *keys) for keys in _keys(value)]
    return found
