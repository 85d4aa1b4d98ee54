"""What has been drawn: joints with their places, bars, points, guides, and what else is attached to them.

A `Draft` is a frozen value that holds just what the hand drew. Its things are named here, too: O2 and O4 for
ground pins, A and B for joints, P for points, 2 and 3 for bodies.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import field, replace
from itertools import chain, count
from typing import Any, NamedTuple

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.words import to_say

# What has been drawn: joints with their places, bars, points, guides, and what else is attached to them.

Thing = tuple[str, str]
"""A thing that can be chosen: its kind, and its name among its kind."""
Tables = Mapping[str, Mapping[str, Any]]
KINDS = (
    *("pins", "bars", "points", "guides", "sliders", "slots", "yokes", "gears", "drives", "springs"),
    "dampers",
)
"""The kinds of tables that are drawn; besides there are "sides", "bodies" and "drive"."""
UNTITLED = to_say("New linkage")
"""The title of a linkage until its file is written; then its class is the title."""
JOINT, DRIVE = "joints", ("drive", "input")
"""The kind of a joint, fixed or not, and the one thing that drives."""
_NAMING = {"guide": "guides", "bar": "bars"}
OWN = ("pins", "points", "sliders", "yokes", "gears", "drives", "sides")
"""The kinds of tables whose names are those of joints."""
_JOINTS = ("joints", "on", "between", "through", "with", "pin", "pivot", "joint", "slider")


class Photo(NamedTuple):
    """A photograph behind the drawing: its file beside the scene's, and how it lies there.

    `place` is that of its lower left corner, `width` how wide it is, both in the draft's unit; `turn` is
    counterclockwise about that corner (rad).
    """

    file: str
    place: Point = (0.0, 0.0)
    width: float = 100.0
    turn: float = 0.0


@frozen
class Draft:
    """A linkage as it is drawn, whole or not; nothing in it is changed in place.

    `places` are those of all joints, fixed ones too, in the order in which they were drawn. `tables` hold
    their properties, by kind and name, in the words of a scene file where it has any:

        pins     O2 = [0, 0], or { length = 100, angle = "0 deg" }
        bars     A–B = { joints = ["A", "B"], length = 90 }
        points   P = { on = ["A", "B"], at = [45, 30] }
        guides   1 = { through = "O2", angle = "0 deg", offset = 0 }, with `on` where a body carries it
        sliders  C = { guide = "1" }
        slots    A in O4–P = { bar = "O4–P", through = "A", offset = 0 }
        yokes    Y = { pin = "A", slot = "90 deg" }
        gears    D = { with = "A", ratio = -1, offset = "0 deg" }
        springs, dampers, bodies, drive (one, called "input"): as in a file
        drives   D = { speed = "10 rpm", start = "0 deg" }: a further motor, of the crank to D
        sides    B = { joints = ["A", "O4"], side = "left" }: of the dyads as they were found

    A drive between two links that both move is { motor = { pivot = "B", between = ["A", "C"] }, speed = … }:
    at B, of the link to C on the link to A.

    `rest` is what else the file states. `typed` are the keys of the numbers that were typed: no drag changes
    them. `short` is the key of the shorthand that the draft came from, if any; None for a linkage that is to
    be written joint by joint. In a draft that moves, places are those at `phase`.
    """

    places: Mapping[str, Point] = field(default_factory=dict)
    tables: Tables = field(default_factory=dict)
    rest: Mapping[str, Any] = field(default_factory=lambda: {"title": UNTITLED, "length_unit": "mm"})
    typed: frozenset[tuple[str | int, ...]] = frozenset()
    photo: Photo | None = None
    short: Mapping[str, Any] | None = field(default_factory=dict)
    phase: float = 0.0

    def of(self, kind: str) -> Mapping[str, Any]:
        """Return all tables of a kind by their names."""
        return self.tables.get(kind, {})

    def having(self, kind: str, name: str, table: Any) -> Draft:
        """Return the draft with another table at a name; None removes the table."""
        kept = {**self.of(kind), name: table}
        tables = {key: value for key, value in kept.items() if value is not None}
        return replace(self, tables={**self.tables, kind: tables})

    def having_all(self, kind: str, tables: Mapping[str, Any]) -> Draft:
        """Return the draft with these tables as all of a kind."""
        return replace(self, tables={**self.tables, kind: tables})

    def placing(self, name: str, place: complex) -> Draft:
        """Return the draft with a joint at a place, x + yi."""
        return replace(self, places={**self.places, name: (place.real, place.imag)})

    @property
    def unit(self) -> str:
        """Its unit of length."""
        return str(self.rest.get("length_unit", "mm"))

    @property
    def trace(self) -> tuple[str, ...]:
        """The joints whose curves are drawn."""
        return tuple(self.rest.get("trace", {}).get("joints", ()))

    @property
    def drive(self) -> Mapping[str, Any]:
        """The drive's table; empty before there is a drive."""
        table: Mapping[str, Any] = self.of("drive").get("input", {})
        return table

    @property
    def driven(self) -> str | None:
        """The joint that is driven: a crank pin or a slider."""
        for table in (self.drive, self.drive.get("cylinder", {}), self.drive.get("slider", {})):
            if "joint" in table:
                return str(table["joint"])
        return None

    def bars_at(self, joint: str) -> Iterator[tuple[str, str, float]]:
        """Iterate the bars that end in a joint, as they were drawn: their names, other ends and lengths."""
        for name, table in self.of("bars").items():
            if joint in table["joints"]:
                first, second = table["joints"]
                yield name, second if first == joint else first, table["length"]

    def ends(self, bar: str) -> list[str]:
        """Return the two joints of a bar."""
        return list(self.of("bars")[bar]["joints"])

    def with_bar(self, start: str, end: str, length: object) -> Draft:
        """Return the draft with a bar between two joints, named after them."""
        return self.having("bars", f"{start}–{end}", {"joints": [start, end], "length": length})

    def body_of(self, joints: Iterable[str]) -> str | None:
        """Return the name of the body that joints are on."""
        bodies = self.of("bodies").items()
        return next((name for name, body in bodies if {*joints} <= {*body.get("joints", ())}), None)

    def bar(self, one: str, other: str) -> str | None:
        """Return the name of the bar between two joints."""
        return next((name for name, end, _ in self.bars_at(one) if end == other), None)

    def things(self) -> Iterator[Thing]:
        """Iterate all things that can be chosen: joints first, then what was drawn on them, by kind."""
        yield from ((JOINT, name) for name in self.places)
        for kind in KINDS[1:]:
            yield from ((kind, name) for name in self.of(kind) if kind not in ("points", "sliders"))
        yield from (("drive", name) for name in self.of("drive"))


def named_in(table: Any, key: str = "at") -> Iterator[Thing]:
    """Iterate the things that a table names: joints, and the guide or the bar that it is on."""
    if isinstance(table, Mapping):
        for under, value in table.items():
            yield from named_in(value, under)
    elif isinstance(table, list | tuple):
        for value in table:
            yield from named_in(value, key)
    elif key in _NAMING or key in _JOINTS:
        yield _NAMING.get(key, JOINT), table


def renamed(draft: Draft, kind: str, old: str, new: str) -> Draft:
    """Return the draft with a thing renamed; a joint also wherever it is named, with its bars and slots."""
    if kind != JOINT:
        tables = {new if name == old else name: table for name, table in draft.of(kind).items()}
        typed = frozenset((kind, new, *key[2:]) if key[:2] == (kind, old) else key for key in draft.typed)
        return replace(draft.having_all(kind, tables), typed=typed)
    bars = {
        name: "–".join(new if end == old else end for end in one["joints"])
        for name, one in draft.of("bars").items()
        if old in one["joints"] and name == "–".join(one["joints"])
    }

    def called(kind: str, name: str) -> str:
        if kind == "bars":
            return bars.get(name, name)
        if kind == "slots":
            through, within, bar = name.partition(" in ")
            return f"{new if through == old else through}{within}{bars.get(bar, bar)}"
        return new if name == old and kind in OWN else name

    def plain(value: Any, key: str) -> Any:
        if isinstance(value, Mapping):
            return {under: plain(one, under) for under, one in value.items()}
        if isinstance(value, list | tuple):
            return [plain(one, key) for one in value]
        if key in _JOINTS:
            return new if value == old else value
        return bars.get(value, value) if key == "bar" else value

    tables = {
        kind: {called(kind, name): plain(table, "at") for name, table in every.items()}
        for kind, every in draft.tables.items()
    }
    places = {new if name == old else name: place for name, place in draft.places.items()}
    typed = frozenset((key[0], called(str(key[0]), str(key[1])), *key[2:]) for key in draft.typed)
    rest = {**draft.rest, **({"trace": plain(draft.rest["trace"], "at")} if "trace" in draft.rest else {})}
    return replace(draft, places=places, tables=tables, typed=typed, rest=rest)


# Names as a person gives them: O2, O4 for ground pins, A, B for joints, P for points, 2, 3 for bodies.

_FIELDS_OF_JOINTS, _POINTS = "ABCDEFGHJKLMN", "PQRSTUVWXYZ"


def pin_name(draft: Draft) -> str:
    """Return the name of the next ground pin."""
    return _free((f"O{number}" for number in count(2, 2)), draft.places)


def joint_name(draft: Draft, *, point: bool = False) -> str:
    """Return the name of the next joint, or of the next point of a body."""
    return _free(_lettered(_POINTS if point else _FIELDS_OF_JOINTS), draft.places)


def body_name(draft: Draft) -> str:
    """Return the number of the next body."""
    return _free(map(str, count(2)), draft.of("bodies"))


def numbered(draft: Draft, kind: str, word: str) -> str:
    """Return the next name of a kind: the word itself, then with 2, 3, ... behind it."""
    return _free(chain([word], (f"{word}{number}" for number in count(2))), draft.of(kind))


def _lettered(letters: str) -> Iterator[str]:
    yield from letters
    yield from (f"{letter}{number}" for number in count(2) for letter in letters)


def _free(names: Iterable[str], taken: Container[str]) -> str:
    return next(name for name in names if name not in taken)
