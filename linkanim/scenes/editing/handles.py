"""Joints as handles: which dimensions follow when a joint is dragged, and which bar a dimension measures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import atan2, degrees, hypot

from linkanim.mechanics.linkage.joint import Point
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.editing.edit import dimensions
from linkanim.scenes.reading.joints import Key
from linkanim.scenes.scene import Scene

_SPANS: Mapping[Key, tuple[str, str]] = {
    ("four-bar", "ground"): ("O2", "O4"),
    ("four-bar", "crank"): ("O2", "A"),
    ("four-bar", "coupler"): ("A", "B"),
    ("four-bar", "rocker"): ("O4", "B"),
    ("slider-crank", "crank"): ("O2", "A"),
    ("slider-crank", "rod"): ("A", "B"),
    ("six-bar", "lengths", 0): ("O2", "O4"),
    ("six-bar", "lengths", 1): ("O2", "A"),
    ("six-bar", "lengths", 2): ("A", "B"),
    ("six-bar", "lengths", 3): ("O4", "B"),
    ("six-bar", "lengths", 4): ("O4", "O6"),
    ("six-bar", "lengths", 5): ("O4", "C"),
    ("six-bar", "lengths", 6): ("C", "D"),
    ("six-bar", "lengths", 7): ("O6", "D"),
}
"""The bars of the shorthands, each from the joint that is found first."""
_POINTS = {"P": "coupler_point", "P2": "coupler_point2"}


@dataclass(frozen=True)
class Handle:
    """A dimension that follows a joint: the distance from `start`, or a part of the place on a body.

    `part` is 0 along the body's axis `on` and 1 to its left, or 0 for x and 1 for y of a fixed pin; None for
    a distance. An `angle` is that of the way from `start`.
    """

    key: Key
    start: str | None = None
    on: tuple[str, str] | None = None
    part: int | None = None
    angle: bool = False


def span(scene: Scene, key: Key) -> tuple[str, str] | None:
    """Return the two joints between which a dimension measures a bar; None for any other dimension."""
    return dict(_bars(scene)).get(key)


def handles(scene: Scene, joint: str) -> tuple[Handle, ...]:
    """Return the dimensions that follow a joint; none for one that is found from others alone."""
    known = {item.key for item in dimensions(scene)}
    return tuple(handle for handle in _handles(scene, joint) if handle.key in known)


def dragged(handle: Handle, places: Mapping[str, Point], point: Point) -> float:
    """Return a dimension's value with its joint at `point`, the others at their places; angles in degrees."""
    if handle.on:
        (x0, y0), (x1, y1) = (places[name] for name in handle.on)
        length = hypot(x1 - x0, y1 - y0)
        ux, uy, x, y = (x1 - x0) / length, (y1 - y0) / length, point[0] - x0, point[1] - y0
        return -x * uy + y * ux if handle.part else x * ux + y * uy
    if handle.part is not None:
        return point[handle.part]
    x, y = places[handle.start] if handle.start else (0.0, 0.0)
    return degrees(atan2(point[1] - y, point[0] - x)) if handle.angle else hypot(point[0] - x, point[1] - y)


def _bars(scene: Scene) -> Iterator[tuple[Key, tuple[str, str]]]:
    yield from ((key, ends) for key, ends in _SPANS.items() if key[0] in scene.document)
    tables = scene.document.get("joints", {})
    for joint in scene.linkage.joints:
        written = tables.get(joint.name, {}).get("length")
        for n, (start, _) in enumerate(joint.bars if written is not None else ()):
            key: Key = ("joints", joint.name, "length")
            yield (*key, n) if isinstance(written, list) else key, (start, joint.name)


def _handles(scene: Scene, name: str) -> Iterator[Handle]:
    joint = scene.linkage.joint(name)
    if joint.fixed:
        yield from _of_pin(scene, name)
    elif isinstance(joint, Rigid):
        yield from _of_point(scene, joint)
    found_from = {bar[0] for bar in joint.bars}
    if isinstance(joint, Rigid):
        found_from.add(joint.on[0])
    for key, (start, end) in _bars(scene):
        ends = {start} if joint.fixed else found_from
        if end == name and start in ends:
            yield Handle(key, start)
        elif start == name and end in ends:
            yield Handle(key, end)


def _of_point(scene: Scene, joint: Rigid) -> Iterator[Handle]:
    tables = [key for key in ("four-bar", "slider-crank", "six-bar") if key in scene.document]
    for part in (0, 1):
        yield Handle(("joints", joint.name, "at", part), on=joint.on, part=part)
        for table in tables if joint.name in _POINTS else ():
            yield Handle((table, _POINTS[joint.name], part), on=joint.on, part=part)


def _of_pin(scene: Scene, name: str) -> Iterator[Handle]:
    yield from (Handle(("ground", name, part), part=part) for part in (0, 1))
    yield Handle(("ground", name, "length"))
    angle = scene.document.get("ground", {}).get(name)
    if isinstance(angle, Mapping) and _in_degrees(angle.get("angle", "")):
        yield Handle(("ground", name, "angle"), angle=True)
    for table in ("four-bar", "six-bar"):
        if name == "O4" and _in_degrees(scene.document.get(table, {}).get("ground_angle", "")):
            yield Handle((table, "ground_angle"), "O2", angle=True)


def _in_degrees(written: object) -> bool:
    """Tell whether an angle is written in degrees, as "30 deg" or "30°"."""
    text = str(written)
    return text.rstrip().endswith("°") or "deg" in text.lower()
