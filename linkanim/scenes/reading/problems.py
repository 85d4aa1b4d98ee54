"""Every problem of a scene file at once, each with its line.

The reader stops at the first problem; what is said here is what it says, one after the other: each
problem is mended with a value that it takes, and the file is read again. What could only be a
consequence of such a mend is left out.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator, Mapping
from itertools import permutations, product
from typing import Any, NamedTuple

from linkanim.errors import AssemblyError, BadInput
from linkanim.scenes.editing.toml import parse
from linkanim.scenes.reading.lines import lines_of
from linkanim.scenes.reading.read import drafted, scene_from

Keys = tuple[str, ...]

MOST = 100
"""Problems that are told of one file."""

_PLAIN: tuple[object, ...] = (
    1, [1, 2], "1 deg", "20 rpm", 0, "1 N/m", "1 N s/m", "1 kg", "1 kg m^2", "1 m/s^2", [1] * 8, {}, "", True
)  # fmt: skip
_AT_LINE = re.compile(r"\(at line (\d+), column \d+\)|\(line (\d+)\)")
_ITEM = re.compile(r"(.+)\[(\d+)\]")
_OF_SHAPE = (
    "rigid body",
    "one point",
    "cannot meet",
    "is fixed, so nothing",
    "does not travel",
    "no linkage",
)
"""Words of what may only follow from a mend that put a joint elsewhere, or left it out."""


class Problem(NamedTuple):
    """What is wrong, said as the reader says it, at a line where one can be told."""

    message: str
    line: int | None = None


class _Stop(NamedTuple):
    """Where the reader stopped, and what it said."""

    keys: Keys
    message: str


def problems(text: str, *, name: str, where: str) -> list[Problem]:
    """Return every problem of a scene file's text, none for a good one, in the order of the lines."""
    try:
        document = parse(text, where)
    except BadInput as error:
        return [_unparsed(error, text)]
    lines = lines_of(text)
    found = [
        Problem(stop.message, _line(lines, stop.keys)) for stop in _stops(document, name=name, where=where)
    ]
    return sorted(dict.fromkeys(found), key=lambda problem: problem.line or 0)


def _unparsed(error: BadInput, text: str) -> Problem:
    if error.keys:
        return Problem(str(error), _line(lines_of(text), error.keys))
    at = _AT_LINE.search(str(error))
    return Problem(str(error), int(at[1] or at[2]) if at else None)


def _stops(document: Mapping[str, Any], *, name: str, where: str) -> Iterator[_Stop]:
    """Yield where the reader stops, again and again, until it goes through or can go no further."""
    mended: dict[str, Any] = copy.deepcopy(dict(document))
    moved = False
    for _ in range(MOST):
        stop = _stopped(mended, where)
        if stop is None:
            break
        if not (moved and any(words in stop.message for words in _OF_SHAPE)):
            yield stop
        if not _mend(mended, stop, where):
            return
        moved = moved or "unknown key" not in stop.message
    else:  # there may be more
        return
    if not moved:
        try:
            scene_from(mended, name=name, where=where)
        except AssemblyError as error:
            yield _Stop(error.keys, str(error))


def _stopped(document: Mapping[str, Any], where: str) -> _Stop | None:
    """Return where the reader stops, None where it goes through; what is put together counts later."""
    try:
        drafted(document, name="", where=where)
    except BadInput as error:
        return _Stop(error.keys, str(error))
    return None


def _mend(document: dict[str, Any], stop: _Stop, where: str) -> bool:
    """Put something in the place where the reader stopped with which it goes on; return whether it does."""
    for keys in dict.fromkeys((stop.keys, stop.keys[:2], stop.keys[:1])):
        holder, key = _holder(document, keys)
        if holder is None:
            continue
        for value in _candidates(document, keys, whole=keys != stop.keys):
            _put(holder, key, value)
            if _goes_on(_stopped(document, where), stop, keys):
                return True
    return False


def _goes_on(after: _Stop | None, stop: _Stop, keys: Keys) -> bool:
    """Tell whether the reader now stops elsewhere: not at what was mended, in it or around it."""
    if after is None:
        return True
    shared = min(len(after.keys), len(keys))
    return after.message != stop.message and (shared == 0 or after.keys[:shared] != keys[:shared])


_GONE = object()


def _put(holder: Any, key: Any, value: object) -> None:
    if value is not _GONE:
        holder[key] = copy.deepcopy(value)
    elif isinstance(holder, dict):
        holder.pop(key, None)


def _holder(document: dict[str, Any], keys: Keys) -> tuple[Any, Any]:
    """Return the table or list that holds the last key, and the key in it; None where there is none."""
    if not keys:
        return None, None
    holder: Any = document
    for key in keys[:-1]:
        holder = holder.get(key) if isinstance(holder, dict) else None
    item = _ITEM.fullmatch(keys[-1])
    if item and isinstance(holder, dict) and isinstance(holder.get(item[1]), list):
        return holder[item[1]], int(item[2])
    return (holder, keys[-1]) if isinstance(holder, dict) else (None, None)


def _candidates(document: Mapping[str, Any], keys: Keys, *, whole: bool) -> Iterator[object]:
    """Yield what may stand in: another joint, nothing, plain values, names of joints and pairs of them."""
    sections = (document.get(key) for key in ("joints", "ground"))
    joints, ground = (list(section) if isinstance(section, dict) else [] for section in sections)
    moving, pins = dict.fromkeys([*joints[:6], "A", "B"]), dict.fromkeys([*ground[:4], "O2", "O4"])
    if len(keys) == 2 and keys[0] == "joints":
        for pin, crank in product(pins, moving):
            yield {"crank": pin, "length": 1, "gear": {"with": crank, "ratio": 1}}
    yield _GONE
    if whole:
        return
    yield from _PLAIN
    names = [*moving, *pins]
    yield from names
    for pair in permutations(names, 2):
        yield list(pair)


def _line(lines: Mapping[Keys, int], keys: Keys) -> int | None:
    """Return the line of a key, or of the nearest table around it."""
    items = [(key, _ITEM.fullmatch(key)) for key in keys]
    plain = tuple(item[1] if item else key for key, item in items)
    return next((lines[plain[:n]] for n in range(len(plain), 0, -1) if plain[:n] in lines), None)
