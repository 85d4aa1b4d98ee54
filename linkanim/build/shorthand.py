"""A draft as a shorthand, where one says the same in fewer lines."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Mapping
from functools import partial
from math import degrees, isclose, nan
from typing import Any

from linkanim import units
from linkanim.build.draft import Draft
from linkanim.build.order import place_of
from linkanim.errors import UnitError
from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.fields.form import Field
from linkanim.scenes.fields.shorthands import SHORTHANDS, Expansion, names_of
from linkanim.scenes.fields.table import Context, Table

_NEAR = 1e-12
Document = Mapping[str, Any]


def shortened(draft: Draft, document: Document) -> Document:
    """Return a draft's document with a shorthand instead of its joints, where that gives the same linkage.

    The numbers of the shorthand that it came from stay as they were written as long as they hold.
    """
    names = {*document.get("ground", {}), *document.get("joints", {})}
    if draft.short is None or "O2" not in names:
        return document
    for key in SHORTHANDS:
        for table in _tables(draft, key):
            given = set(names_of(key, table))
            if given == names or (key in draft.short and given <= names):
                expansion = _expansion(draft, key, table)
                if expansion and all(_says(draft, document, joint) for joint in expansion.joints):
                    return _instead(document, key, table, expansion)
    return document


def table_of(joint: Joint) -> Any:
    """Return a joint that a shorthand gives as the table that says the same; no side that is another's."""
    if isinstance(joint, Pin):
        polar = joint.polar
        if polar and not polar.base:
            return {"length": polar.length, "angle": _degrees(polar.angle)}
        return list(joint.position)
    if isinstance(joint, Crank):
        return {"crank": joint.pivot, "length": joint.length}
    if isinstance(joint, RRR):
        side = "" if joint.side_of else joint.sides[joint.side < 0]
        return {"from": list(joint.ends), "length": list(joint.lengths), "side": side}
    if isinstance(joint, RRP):
        line = {
            "through": joint.line.through,
            "angle": _degrees(joint.line.angle),
            "offset": joint.line.offset,
        }
        return {"from": joint.end, "length": joint.length, "line": line, "side": joint.sides[joint.side < 0]}
    assert isinstance(joint, Rigid)
    return {"on": list(joint.on), "at": list(joint.at)}


def _expansion(draft: Draft, key: str, table: Document) -> Expansion | None:
    """Return what a shorthand's table stands for; None where it is refused."""
    o2 = Pin("O2", draft.places["O2"])
    top = Table("", table, (key,), Context(draft.unit, names_of(key, table)))
    expansion: Expansion | None = top.attempt(SHORTHANDS[key].made, top, o2)
    return None if top.context.problems else expansion


def _says(draft: Draft, document: Document, joint: Joint) -> bool:
    """Tell whether a document's own table of a joint says what a shorthand does."""
    if isinstance(joint, Pin):
        place = complex(*joint.position)
        return abs(place_of(draft, joint.name) - place) <= _NEAR * abs(place)
    own, given = document["joints"].get(joint.name, {}), table_of(joint)
    if isinstance(joint, RRR) and joint.side_of:
        b, p, q = (place_of(draft, name) for name in joint.side_of)
        left = ((b - p) * (q - p).conjugate()).imag > 0
        own = {**own, "side": ""}
        if left != (joint.side > 0):
            return False
    return _alike(_ordered(own), _ordered(given), draft.unit)


def _ordered(table: Document) -> Document:
    """Return a table with the ends of its two bars in order, and without what is usual of a line."""
    if "line" in table:
        return {**table, "line": {"angle": "0 deg", "offset": 0, **table["line"]}}
    ends = table.get("from")
    if not isinstance(ends, list) or ends == sorted(ends):
        return table
    side = table["side"] and RRR.sides[table["side"] == RRR.sides[0]]
    return {**table, "from": ends[::-1], "length": table["length"][::-1], "side": side}


def _tables(draft: Draft, key: str) -> Iterator[dict[str, Any]]:
    """Yield a shorthand's table with a draft's numbers, for each closure that it may have."""
    former = (draft.short or {}).get(key, {})
    stated: dict[str, Any] = {}
    for one in SHORTHANDS[key].fields:
        value, old = _value(draft, one), former.get(one.key)
        if value is None and one.key == "link_angle":
            value = old
        if value is not None and (value != one.usual or old is not None):
            stated[one.key] = old if old is not None and _alike(value, old, draft.unit) else value
    if draft.driven == "B":
        stated["driver"] = "rocker"
    tables = [stated]
    for one in SHORTHANDS[key].fields:
        if one.plain and one.plain.options and one.key != "driver":
            options = sorted(one.plain.options, key=lambda option: option != former.get(one.key))
            tables = [{**table, one.key: option} for table in tables for option in options]
    yield from tables


def _value(draft: Draft, one: Field) -> Any:
    """Return what a draft has for a field of a shorthand; None where it has nothing of that kind."""
    if one.drag == "distance":
        lengths = [_distance(draft, *span) for span in one.spans]
        return None if None in lengths else lengths if one.spans[1:] else lengths[0]
    start, end = one.spans[0] if one.spans else ("", "")
    if one.drag == "direction" and {start, end} <= draft.of("pins").keys():
        pin = draft.of("pins")[end]
        way = place_of(draft, end) - place_of(draft, start)
        return pin["angle"] if isinstance(pin, Mapping) else _degrees(phase(way))
    if one.drag == "place":
        return draft.of("points").get(end, {}).get("at")
    guide = draft.of("guides").get(draft.of("sliders").get("B", {}).get("guide"), {})
    return guide.get({"offset": "offset", "line_angle": "angle"}.get(one.key))


def _distance(draft: Draft, start: str, end: str) -> Any:
    """Return the distance that is stated between two joints, or that of a fixed pin or of a point."""
    pins, points = draft.of("pins"), draft.of("points")
    if name := draft.bar(start, end):
        return draft.of("bars")[name]["length"]
    if {start, end} <= pins.keys():
        polar = isinstance(pins[end], Mapping) and not place_of(draft, start)
        return pins[end]["length"] if polar else _tidy(abs(place_of(draft, end) - place_of(draft, start)))
    if end in points and points[end]["on"][0] == start:
        return _tidy(abs(complex(*(units.length(part, unit=draft.unit) for part in points[end]["at"]))))
    return None


def _instead(document: Document, key: str, table: Document, expansion: Expansion) -> Document:
    """Return a document with a shorthand's table instead of its joints and their plain bodies."""
    given = {joint.name for joint in expansion.joints}
    sections: dict[str, Any] = {
        section: {name: value for name, value in document.get(section, {}).items() if name not in given}
        for section in ("ground", "joints")
    }
    if document["ground"]["O2"] != [0, 0]:
        sections["ground"] = {"O2": document["ground"]["O2"], **sections["ground"]}
    members = {frozenset(_members(body)): body.name for body in expansion.bodies}
    bodies = document.get("bodies", {}).items()
    sections["bodies"] = {name: body for name, body in bodies if not _plain(name, body, members)}
    kept = {name: value for name, value in document.items() if name not in (*sections, "trace")}
    short = {**kept, key: table, **{name: tables for name, tables in sections.items() if tables}}
    trace = document.get("trace", {"joints": []})
    return short if list(expansion.trace) == trace["joints"] else {**short, "trace": trace}


def _plain(name: str, body: Mapping[str, Any], given: Mapping[frozenset[str], str]) -> bool:
    """Tell whether a body is one that the shorthand gives, with nothing else said of it."""
    members = frozenset(body.get("joints", ())) | {body.get("slider", "")} - {""}
    return len(body) == 1 and members in given and (name == given[members] or name.isdigit())


def _members(body: Body) -> tuple[str, ...]:
    return (body.slider,) if body.slider else body.joints


def _alike(one: Any, other: Any, unit: str) -> bool:
    """Tell whether two values say the same, but for the writing and the rounding of their numbers."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_alike(one[key], other[key], unit) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_alike, one, other, [unit] * len(one)))
    numbers = [_number(each, unit) for each in (one, other)]
    return one == other or isclose(*numbers, rel_tol=_NEAR, abs_tol=_NEAR)


def _number(value: Any, unit: str) -> float:
    """Return a length or an angle as a number; NaN of what is none."""
    for read in (partial(units.length, unit=unit), units.angle):
        try:
            return read(value)
        except UnitError:
            continue
    return nan


def _tidy(length: float) -> float | int:
    rounded = float(f"{length:.12g}")
    return int(rounded) if rounded.is_integer() else rounded


def _degrees(angle: float) -> str:
    return f"{degrees(angle):.12g} deg"
