"""The dyads of a drawing: each joint as a scene file says how it is found from joints before it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce
from itertools import combinations
from math import cos, sin
from typing import Any

from linkanim import units
from linkanim.build.draft import Draft, named_in
from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.mechanics.linkage.joint import RigidBody
from linkanim.mechanics.linkage.rigid_bodies import Rigid

Found = Mapping[str, Mapping[str, Any]]
"""Tables of joints by their names, in solvable order."""


def found(draft: Draft) -> dict[str, dict[str, Any]]:
    """Return how each joint is found, as [joints] of a scene file; those that cannot be are left out.

    A joint is found from the first things drawn that do: the drive or a gear, its body, a slot, a guide,
    two bars. Of its two closures it is on the one where it was drawn.
    """
    tables: dict[str, dict[str, Any]] = {}
    known, plates = set(draft.of("pins")), plates_of(draft)
    waiting = [name for name in draft.places if name not in known]
    while table := next(((name, way) for name in waiting for way in _ways(draft, name, known, plates)), None):
        name, tables[table[0]] = table[0], table[1]
        known.add(name)
        waiting.remove(name)
    return tables


def sides(draft: Draft) -> dict[str, dict[str, Any]]:
    """Return the closures of a draft's dyads: of which joints each is one, and what it is called."""
    tables = ((name, table) for name, table in found(draft).items() if "side" in table)
    return {name: {"joints": ends_of(table), "side": table["side"]} for name, table in tables}


def plates_of(draft: Draft) -> list[RigidBody]:
    """Return the bodies of three joints or more, each in its own frame, along its first bar."""
    bars = (
        {first: 0j, second: complex(units.length(table["length"], unit=draft.unit))}
        for table in draft.of("bars").values()
        for first, second in [table["joints"]]
    )
    points = []
    for name, table in draft.of("points").items():
        along, left = (units.length(part, unit=draft.unit) for part in table["at"])
        points.append(Rigid(name, tuple(table["on"]), (along, left)))
    bodies = reduce(lambda bodies, point: point.placed(bodies), points, tuple(bars))
    return [body for body in bodies if len(body) > 2]


def lengths_within(draft: Draft) -> dict[str, float]:
    """Return the lengths of the bars between two points of one body, which hold nothing that it does not.

    A bar that a body begins with is none of them. The body sets their lengths, whatever is stated.
    """
    return {
        name: _round(abs(body[one] - body[other]))
        for name, (one, other) in ((name, table["joints"]) for name, table in draft.of("bars").items())
        for body in plates_of(draft)
        if one in body and other in body and {one, other} != {*list(body)[:2]}
    }


def line_of(draft: Draft, guide: Mapping[str, Any]) -> tuple[complex, complex]:
    """Return a point of a guide and its direction, of length 1, where the joints were drawn."""
    start, way = place_of(draft, guide.get("through") or guide["on"][0]), 1 + 0j
    if "on" in guide:
        first, second = (place_of(draft, name) for name in guide["on"])
        way = (second - first) / (abs(second - first) or 1.0)
    angle = units.angle(guide.get("angle", "0 deg"))
    way *= complex(cos(angle), sin(angle))
    return start + 1j * way * units.length(guide.get("offset", 0), unit=draft.unit), way


def place_of(draft: Draft, joint: str) -> complex:
    """Return where a joint was drawn, as x + yi."""
    return complex(*draft.places[joint])


def _ways(draft: Draft, name: str, known: set[str], plates: list[RigidBody]) -> Iterator[dict[str, Any]]:
    """Yield the ways in which a joint can be found from those that are known."""
    bars = [(end, length) for _, end, length in draft.bars_at(name) if end in known]
    guide = draft.of("guides").get(draft.of("sliders").get(name, {}).get("guide"))
    line = guide if guide and known.issuperset(joint for _, joint in named_in(guide)) else None
    gear, point, yoke = (draft.of(kind).get(name) for kind in ("gears", "points", "yokes"))
    if name == draft.driven:
        yield from _driven(draft, bars, line)
    elif gear and gear["with"] in known:
        yield from ({"crank": end, "length": length, "gear": gear} for end, length in bars)
    if point and known.issuperset(point["on"]):
        yield dict(point)
    held = [(body, [end for end in body if end in known]) for body in plates if name in body]
    for body, ends in held:
        bars += [(end, _round(abs(body[end] - body[name]))) for end in ends[:1] if end not in dict(bars)]
        if ends[1:]:
            way = (body[name] - body[ends[0]]) * (body[ends[1]] - body[ends[0]]).conjugate()
            way /= abs(body[ends[1]] - body[ends[0]])
            yield {"on": ends[:2], "at": [_round(way.real), _round(way.imag)]}
    yield from _slotted(draft, name, known, bars)
    if yoke and line and yoke["pin"] in known:
        yield {"slide": {"pin": yoke["pin"], "line": line, "slot": yoke["slot"]}}
    for each in [line] if line else _carried(draft, name, known):
        for end, length in bars:
            if end not in each.get("on", ()):
                yield _with_side(draft, name, {"from": end, "length": length, "line": each})
    for (one, a), (other, b) in combinations(bars, 2):
        yield _with_side(draft, name, {"from": [one, other], "length": [a, b]})


def _driven(draft: Draft, bars: list[tuple[str, Any]], line: Any) -> Iterator[dict[str, Any]]:
    if "slider" in draft.drive:
        yield from [{"line": line}] if line and "on" not in line else []
    else:
        yield from ({"crank": end, "length": length} for end, length in bars if end in draft.of("pins"))


def _slotted(
    draft: Draft, name: str, known: set[str], bars: list[tuple[str, Any]]
) -> Iterator[dict[str, Any]]:
    """Yield the joint as the end of a bar that slides through a joint."""
    for slot in draft.of("slots").values():
        (one, other), through = draft.ends(slot["bar"]), slot["through"]
        pivot = other if name == one else one
        if name in (one, other) and {pivot, through} <= known:
            length = dict(bars)[pivot]
            aside = {"offset": slot["offset"]} if slot.get("offset") else {}
            yield {"slot": {"pivot": pivot, "through": through, **aside}, "length": length}


def _carried(draft: Draft, name: str, known: set[str]) -> Iterator[dict[str, Any]]:
    """Yield the lines of the slots in known bars that a joint runs in."""
    for slot in draft.of("slots").values():
        ends = draft.ends(slot["bar"])
        if slot["through"] == name and known.issuperset(ends):
            yield {"on": ends, "through": ends[0], "offset": slot.get("offset", 0)}


def _round(length: float) -> float:
    """Return a length that follows from others without what rounding left in its last digits."""
    return round(length, 9)


def _with_side(draft: Draft, name: str, table: dict[str, Any]) -> dict[str, Any]:
    """Return a dyad with its closure: as it is known of the same dyad, else where the joint was drawn."""
    known = draft.of("sides").get(name)
    if known and known["joints"] == ends_of(table):
        return {**table, "side": known["side"]}
    place, names = place_of(draft, name), ends_of(table)
    if "line" in table:
        start, way = place_of(draft, names[0]), line_of(draft, table["line"])[1]
        return {**table, "side": RRP.sides[((place - start) * way.conjugate()).real < 0]}
    start, end = (place_of(draft, each) for each in names)
    return {**table, "side": RRR.sides[((place - start) * (end - start).conjugate()).imag < 0]}


def ends_of(table: Mapping[str, Any]) -> list[str]:
    """Return the other ends of the bars by which a joint's table finds it."""
    ends = table.get("from", table.get("crank", table.get("slot", {}).get("pivot", [])))
    return [ends] if isinstance(ends, str) else list(ends)
