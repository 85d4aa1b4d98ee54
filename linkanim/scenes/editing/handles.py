"""Joints as handles: which dimensions follow when a joint is dragged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import atan2, degrees, hypot

from linkanim.mechanics.linkage.joint import Joint, Point
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.editing.numbers import Number, numbers
from linkanim.scenes.fields.form import Key
from linkanim.scenes.scene import Scene


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


def handles(scene: Scene, joint: str) -> tuple[Handle, ...]:
    """Return the dimensions that follow a joint; none for one that is found from others alone."""
    found = scene.linkage.joint(joint)
    dragged = [number for number in numbers(scene.document) if number.field.drag]
    return tuple(handle for number in dragged for handle in _handles(number, found, scene))


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


def _handles(number: Number, joint: Joint, scene: Scene) -> Iterator[Handle]:
    """Yield how a number follows a joint, if it does."""
    (start, end), drag = number.ends(scene), number.field.drag
    on = joint.on if isinstance(joint, Rigid) else None
    found_from = {bar[0] for bar in joint.bars} | set((on or ())[:1])
    if drag == "distance" and end == joint.name and (joint.fixed or start in found_from):
        yield Handle(number.key, start)
    elif drag == "distance" and start == joint.name and end in found_from:
        yield Handle(number.key, end)
    elif drag == "place" and end == joint.name:
        yield Handle(number.key, on=on, part=number.part)
    elif drag == "direction" and end == joint.name and _in_degrees(number.written):
        yield Handle(number.key, start, angle=True)


def _in_degrees(written: object) -> bool:
    """Tell whether an angle is written in degrees, as "30 deg" or "30°"."""
    text = str(written)
    return text.rstrip().endswith("°") or "deg" in text.lower()
