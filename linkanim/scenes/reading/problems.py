"""Every problem of a scene file at once, each with its line."""

from __future__ import annotations

import re
from typing import NamedTuple

from linkanim.bounds import MOST_PROBLEMS
from linkanim.errors import BadInput
from linkanim.scenes.editing.toml import parse
from linkanim.scenes.reading.line_numbers import Keys, line_numbers
from linkanim.scenes.reading.read import read

_AT_LINE = re.compile(r"\(at line (\d+), column \d+\)|\(line (\d+)\)")
_ITEM = re.compile(r"(.+)\[\d+\]")


class Problem(NamedTuple):
    """What is wrong, in the reader's words, at a line where there is one."""

    message: str
    line: int | None = None


def problems(text: str, *, name: str, where: str) -> list[Problem]:
    """Return every problem of a scene file's text in the order of the lines, 100 at the most."""
    try:
        document = parse(text, where)
    except BadInput as error:
        return [_unparsed(error, text)]
    _, errors = read(document, name=name, where=where)
    lines = line_numbers(text) if errors else {}
    found = dict.fromkeys(Problem(str(error), _line(lines, error.keys)) for error in errors)
    return sorted(found, key=lambda problem: problem.line or 0)[:MOST_PROBLEMS]


def _unparsed(error: BadInput, text: str) -> Problem:
    if error.keys:
        return Problem(str(error), _line(line_numbers(text), error.keys))
    at = _AT_LINE.search(str(error))
    return Problem(str(error), int(at[1] or at[2]) if at else None)


def _line(lines: dict[Keys, int], keys: Keys) -> int | None:
    """Return the line of a key, or of the nearest table around it."""
    items = [(key, _ITEM.fullmatch(key)) for key in keys]
    plain = tuple(item[1] if item else key for key, item in items)
    return next((lines[plain[:n]] for n in range(len(plain), 0, -1) if plain[:n] in lines), None)
