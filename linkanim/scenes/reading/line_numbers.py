"""At which line of a TOML text each key stands."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import Any

Keys = tuple[str, ...]

_PATIENCE = 500_000
"""Characters looked at, at the most: a list of lists over very many lines is looked at anew for each."""
_IDLE = re.compile(r"\s*(#.*)?\s*")
_ENDS = re.compile(r"[\]}]|\"{3}|'{3}")
"""What a statement over several lines has in its last."""


def line_numbers(text: str) -> dict[Keys, int]:
    """Return the line, from 1, of every table and key of a TOML text; few of one that is very long."""
    found: dict[Keys, int] = {}
    table: Keys = ()
    for at, statement, document in _statements(text):
        if statement.lstrip().startswith("["):
            table = _way(document)
            found.setdefault(table, at)
        else:
            for keys in _keys(document):
                found.setdefault((*table, *keys), at)
    return found


def _statements(text: str) -> Iterator[tuple[int, str, Any]]:
    """Yield the line at which a statement begins, its text and the document in it, while patience lasts."""
    begun, lines, seen = 1, list[str](), 0
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        begun = begun if lines else number
        if not lines and _IDLE.fullmatch(line):
            continue
        lines.append(line)
        if begun < number and not _ENDS.search(line):
            continue
        statement = "".join(lines)
        seen += len(statement)
        if seen > _PATIENCE:
            return
        try:
            document = tomllib.loads(statement)
        except ValueError:  # goes on in the next line
            continue
        yield begun, statement, document
        lines = []


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
