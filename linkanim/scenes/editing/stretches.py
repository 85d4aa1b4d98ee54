"""What a dimension measures: the stretches of a construction, in the frames of joints that they move with."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterator
from typing import NamedTuple

from linkanim.mechanics.linkage.joint import Joint, Line
from linkanim.mechanics.linkage.pins import Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.editing.numbers import Number, numbers
from linkanim.scenes.fields.form import Key
from linkanim.scenes.scene import Scene


class Stretch(NamedTuple):
    """A straight line from `begin` to `end` in the frame of two joints, whose way is 1, to its left 1j.

    Of one joint twice, 1 is the scene's unit, level. `key` is the dimension that it is.
    """

    frame: tuple[str, str]
    begin: complex
    end: complex
    key: Key


def stretches(scene: Scene, key: Key) -> tuple[Stretch, ...]:
    """Return what the dimension at a key measures, then what else leads to that place; none of an angle.

    Of a place on a body these are the part along its axis and the part to the left, of a fixed pin x and y.
    """
    number = next((number for number in numbers(scene.document) if number.key == key), None)
    found = _of(number, scene) if number else ()
    return tuple(sorted(found, key=lambda stretch: stretch.key != key))


def _of(number: Number, scene: Scene) -> Iterator[Stretch]:
    joint = scene.linkage.by_name.get(number.ends(scene)[1] if number.field.drag else _named(number, scene))
    if number.field.drag == "distance" and joint:
        start = number.ends(scene)[0]
        frame = (start or joint.name, joint.name)
        begin, end = (0, 1) if start else (-complex(*_place(scene, joint.name)), 0)
        yield Stretch(frame, begin, end, number.key)
    elif number.field.drag == "place" and joint:
        yield from _of_place(joint, scene, number.key)
    elif number.key[-2:-1] == ("com",):
        body = next(body for body in scene.linkage.bodies if body.name == number.key[1])
        if body.com and len(body.joints) > 1:
            yield from _legs(scene, (body.joints[0], body.joints[1]), complex(*body.com), number.key)
    elif number.key[-1] == "offset" and number.type.measure == "offset" and joint:
        yield from _of_offset(joint, scene, number.key)


def _named(number: Number, scene: Scene) -> str:
    """Return the joint whose table a number stands in; of a shorthand the one that has a line."""
    guided = (joint.name for joint in scene.linkage.joints if getattr(joint, "line", None))
    return str(number.key[1]) if number.key[0] == "joints" else next(guided, "")


def _of_place(joint: Joint, scene: Scene, key: Key) -> Iterator[Stretch]:
    if isinstance(joint, Rigid):
        yield from _legs(scene, joint.on, complex(*joint.at), key)
    elif isinstance(joint, Pin):
        x, y = joint.position
        own = joint.name, joint.name
        yield Stretch(own, complex(-x, -y), complex(0, -y), (*key[:-1], 0))
        yield Stretch(own, complex(0, -y), 0, (*key[:-1], 1))


def _legs(scene: Scene, on: tuple[str, str], at: complex, key: Key) -> Iterator[Stretch]:
    """Yield the way along a body's axis and the way from there to its left."""
    at /= _apart(scene, *on)
    yield Stretch(on, 0, at.real, (*key[:-1], 0))
    yield Stretch(on, at.real, at, (*key[:-1], 1))


def _of_offset(joint: Joint, scene: Scene, key: Key) -> Iterator[Stretch]:
    """Yield the way from a pivot to its slot, or from a line's joint to the line."""
    line: Line | None = getattr(joint, "line", None)
    if line is None:
        pivot, offset = getattr(joint, "pivot", ""), getattr(joint, "offset", 0.0)
        if pivot:
            yield Stretch((pivot, joint.name), 0, 1j * offset / _apart(scene, pivot, joint.name), key)
        return
    across = rect(line.offset, line.angle) * 1j
    if line.on is None:
        yield Stretch((line.through, line.through), 0, across, key)
        return
    first, second, through = (complex(*_place(scene, name)) for name in (*line.on, line.through))
    base = (through - first) / (second - first)
    yield Stretch(line.on, base, base + across / abs(second - first), key)


def _place(scene: Scene, joint: str) -> tuple[float, float]:
    return scene.pose(0.0, 0).position[joint]


def _apart(scene: Scene, one: str, other: str) -> float:
    return abs(complex(*_place(scene, one)) - complex(*_place(scene, other)))
