"""What each dimension of a scene is called, in the words of a class: "Crank 2", "Coupler point, along".

Links are numbered as in textbooks where a shorthand numbers them, or by the body of the scene that the
bar belongs to; a bar is told by its two joints where that is not enough.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.mechanics.linkage import Body, Linkage
from linkanim.scenes.joints import Key

_WORDS: Mapping[tuple[str, str], str] = {
    ("four-bar", "ground"): "Ground 1",
    ("four-bar", "crank"): "Crank 2",
    ("four-bar", "coupler"): "Coupler 3",
    ("four-bar", "rocker"): "Rocker 4",
    ("slider-crank", "crank"): "Crank 2",
    ("slider-crank", "rod"): "Rod 3",
    ("slider-crank", "offset"): "Offset of the line",
    ("slider-crank", "line_angle"): "Direction of the line",
    ("six-bar", "link_angle"): "Angle of arm 6 on rocker 4",
    ("drive", "speed"): "Input speed",
    ("drive", "start"): "Start angle",
}
_SIX_BAR = ("Ground 1", "Crank 2", "Coupler 3", "Rocker 4", "Ground 5", "Arm 6", "Coupler 7", "Rocker 8")
_ANY = {
    "ground_angle": "Ground angle",
    "coupler_point": "Coupler point",
    "coupler_point2": "Second coupler point",
}
_STRUT = {"free_length": "free length", "coefficient": "damping"}
_OF_BODY = {"inertia": "moment of inertia"}
_PARTS = ("along", "to the left")
_WITHIN: Mapping[tuple[str, str], str] = {
    ("gear", "ratio"): "gear ratio",
    ("gear", "offset"): "gear offset",
    ("line", "angle"): "direction of its line",
    ("line", "offset"): "offset of its line",
    ("slot", "offset"): "offset of its slot",
}


def label(key: Key, document: Mapping[str, Any], linkage: Linkage) -> str:
    """Return the words for a key of a document; those of a key without any are its own path."""
    match key:
        case ("six-bar", "lengths", int(place)):
            return _SIX_BAR[place]
        case (str(table), str(name)) if (table, name) in _WORDS:
            return _WORDS[table, name]
        case (str(), str(name)) if name in _ANY:
            return _ANY[name]
        case (str(), str(name), int(place)) if name in _ANY:
            return f"{_ANY[name]}, {_PARTS[place]}"
        case ("joints", str(joint), *rest):
            return _of_joint(joint, tuple(rest), document["joints"][joint], linkage)
        case ("ground", str(pin), *rest):
            return f"Pin {pin}, {_of_pin(rest)}"
        case ("bodies", str(body), "com", int(place)):
            return f"{_named(body)} centre of mass, {_PARTS[place]}"
        case ("bodies", str(body), str(name)):
            return f"{_named(body)}, {_OF_BODY.get(name, name)}"
        case ("gravity",):
            return "Gravity"
        case ("drive", "cylinder" | "slider" as what, str(end)):
            return f"{what.capitalize()}, {end}"
        case ("springs" | "dampers", str(strut), str(name)):
            return f"{strut.capitalize()}, {_STRUT.get(name, name)}"
    return ", ".join(str(part).replace("_", " ") for part in key)


def _of_pin(rest: list[str | int]) -> str:
    return {"length": "distance", "angle": "direction", 0: "x", 1: "y"}[rest[0]]


def _of_joint(name: str, rest: Key, table: Mapping[str, Any], linkage: Linkage) -> str:
    match rest:
        case ("length", *place):
            return _bar(_start(table, place), name, linkage, turns="crank" in table)
        case ("at", int(part)):
            first, second = table["on"]
            return f"{name} on {first}–{second}, {_PARTS[part]}"
        case (str(inner), str(key)) if (inner, key) in _WITHIN:
            return f"{name}, {_WITHIN[inner, key]}"
    return ", ".join(str(part).replace("_", " ") for part in (name, *rest))


def _start(table: Mapping[str, Any], place: list[str | int]) -> str | None:
    """Return the joint that a length of this joint is measured from."""
    source: Any = table.get("crank") or table.get("from") or table.get("slot", {}).get("pivot")
    if isinstance(source, list):
        return str(source[int(place[0])]) if place else None
    return source if isinstance(source, str) else None


def _bar(start: str | None, end: str, linkage: Linkage, *, turns: bool) -> str:
    """Return what a bar is called: by its body's number, and by its joints where it is not a crank."""
    body = _body({start, end}, linkage)
    ends = f"{start}–{end}" if start else end
    if body and body.name.isdigit():
        return f"Crank {body.name}" if turns else f"Bar {body.name}, {ends}"
    return f"{_named(body.name) if body else 'Crank' if turns else 'Bar'} {ends}"


def _body(joints: set[str | None], linkage: Linkage) -> Body | None:
    return next((body for body in linkage.bodies if joints <= set(body.joints)), None)


def _named(body: str) -> str:
    return f"Link {body}" if body.isdigit() else body.capitalize()
