"""What each dimension of a scene is called, in the words of a class: "Crank 2", "Coupler point, along".

Links are numbered as in textbooks where a shorthand numbers them, or by the body of the scene that the
bar belongs to; a bar is told by its two joints where that is not enough.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.mechanics.linkage.linkage import Body, Linkage
from linkanim.scenes.reading.joints import Key
from linkanim.scenes.scene import Scene

_LINKS: Mapping[tuple[str | int, ...], tuple[str, int]] = {
    ("four-bar", "crank"): ("crank", 2),
    ("four-bar", "coupler"): ("coupler", 3),
    ("four-bar", "rocker"): ("rocker", 4),
    ("slider-crank", "crank"): ("crank", 2),
    ("slider-crank", "rod"): ("rod", 3),
    ("six-bar", "lengths", 1): ("crank", 2),
    ("six-bar", "lengths", 2): ("coupler", 3),
    ("six-bar", "lengths", 3): ("rocker", 4),
    ("six-bar", "lengths", 6): ("coupler2", 7),
    ("six-bar", "lengths", 7): ("rocker2", 8),
}
"""The bodies of shorthands that their lengths belong to, and the numbers of those."""
_WORDS: Mapping[tuple[str | int, ...], str] = {
    ("four-bar", "ground"): "Ground 1",
    ("slider-crank", "offset"): "Offset of the line",
    ("slider-crank", "line_angle"): "Direction of the line",
    ("six-bar", "lengths", 0): "Ground 1",
    ("six-bar", "lengths", 4): "Ground 5",
    ("six-bar", "lengths", 5): "Arm 6",
    ("drive", "speed"): "Input speed",
    ("drive", "start"): "Start angle",
}
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


def label(key: Key, scene: Scene) -> str:
    """Return the words for a key of a scene's document; those of a key without any are its own path."""
    document, names = scene.document, scene.info.link_names
    if key in _LINKS:
        return _numbered(*_LINKS[key], names)
    if key in _WORDS:
        return _WORDS[key]
    match key:
        case ("six-bar", "link_angle"):
            return f"Angle of arm 6 on {_numbered('rocker', 4, names).lower()}"
        case (str(), str(name)) if name in _ANY:
            return _ANY[name]
        case (str(), str(name), int(place)) if name in _ANY:
            return f"{_ANY[name]}, {_PARTS[place]}"
        case ("joints", str(joint), *rest):
            return _of_joint(joint, tuple(rest), document["joints"][joint], scene)
        case ("ground", str(pin), *rest):
            return f"Pin {pin}, {_of_pin(rest)}"
        case ("bodies", str(body), "com", int(place)):
            return f"{_named(body, names)} centre of mass, {_PARTS[place]}"
        case ("bodies", str(body), str(name)):
            return f"{_named(body, names)}, {_OF_BODY.get(name, name)}"
        case ("gravity",):
            return "Gravity"
        case ("drive", "cylinder" | "slider" as what, str(end)):
            return f"{what.capitalize()}, {end}"
        case ("springs" | "dampers", str(strut), str(name)):
            return f"{strut.capitalize()}, {_STRUT.get(name, name)}"
    return ", ".join(str(part).replace("_", " ") for part in key)


def _of_pin(rest: list[str | int]) -> str:
    return {"length": "distance", "angle": "direction", 0: "x", 1: "y"}[rest[0]]


def _of_joint(name: str, rest: Key, table: Mapping[str, Any], scene: Scene) -> str:
    match rest:
        case ("length", *place):
            return _bar(_start(table, place), name, scene, turns="crank" in table)
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


def _bar(start: str | None, end: str, scene: Scene, *, turns: bool) -> str:
    """Return what a bar is called: by its body's number, and by its joints where it is not a crank."""
    body = _body({start, end}, scene.linkage)
    ends = f"{start}–{end}" if start else end
    if body and body.name.isdigit():
        return f"Crank {body.name}" if turns else f"Bar {body.name}, {ends}"
    return f"{_named(body.name, scene.info.link_names) if body else 'Crank' if turns else 'Bar'} {ends}"


def _body(joints: set[str | None], linkage: Linkage) -> Body | None:
    return next((body for body in linkage.bodies if joints <= set(body.joints)), None)


def _named(body: str, names: Mapping[str, str]) -> str:
    return f"Link {body}" if body.isdigit() else names[body].capitalize()


def _numbered(body: str, number: int, names: Mapping[str, str]) -> str:
    """Return a link with its number, which tells it from another of its sort."""
    return f"{names[body].removeprefix('second ').capitalize()} {number}"
