"""A hand on a sheet: gestures as lines of text, as a tape has them, and the building after them."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from linkanim.build.building import Building, posed, redo, undo
from linkanim.build.chosen import choose, choose_thing, delete, drive, move, trace
from linkanim.build.dimensions import choose_number, take, write
from linkanim.build.pointing import click, double_click, drag

REACH, SNAP = 3.0, 1.0


def gestures(text: str) -> list[str]:
    """Return the gestures of a session, a line each; what follows # is left out."""
    lines = (line.partition("#")[0].strip() for line in text.splitlines())
    return [line for line in lines if line]


def drawn(text: str | Iterable[str], begin: Building | None = None) -> Building:
    """Return the building after all gestures of a session."""
    lines = gestures(text) if isinstance(text, str) else text
    return reduce(gesture, lines, begin or Building())


def gesture(building: Building, line: str, *, reach: float = REACH, snap: float = SNAP) -> Building:
    """Return the building after one gesture; by the pointer it is made onto the pose that is drawn."""
    name, *words = line.split()
    if name == "type":
        return take(write(building, " ".join(words)))
    if name == "choose":
        return choose_thing(building, words[0], " ".join(words[1:]))
    if name == "number":
        return choose_number(building, int(words[0]))
    if name in _PLAIN:
        return _PLAIN[name](building)
    building = posed(building, building.draft.phase)
    if name == "move":
        return move(building, *map(float, words), snap=snap)
    if name == "double":
        return double_click(building, *map(float, words), reach=reach, snap=snap)
    tool = words.pop(0) if words[0].isalpha() else "bar"
    x, y, *to = map(float, words)
    if name == "click":
        return click(building, tool, x, y, reach=reach, snap=snap)
    return drag(building, tool, x, y, to[0], to[1], reach=reach, snap=snap)


def _next(building: Building) -> Building:
    return choose(building, 1)


_PLAIN = {"trace": trace, "drive": drive, "delete": delete, "undo": undo, "redo": redo, "next": _next}
