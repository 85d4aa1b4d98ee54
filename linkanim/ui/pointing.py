"""What is under the mouse, and the words about it: a joint, a link, a spring, or an instant on a curve.

The words and numbers are those of the shared page.
"""

from __future__ import annotations

from math import hypot
from typing import Literal, NamedTuple

import numpy as np

from linkanim.mechanics.linkage import Damper, Point, Spring
from linkanim.mechanics.motion import Pose, Strut
from linkanim.picture.drawn import Over
from linkanim.picture.figure import Figure
from linkanim.picture.hud import charted, rows
from linkanim.picture.quantities import chart_tokens, quantity
from linkanim.picture.shapes import hull
from linkanim.player.action import Action
from linkanim.player.state import (
    State,
)
from linkanim.scenes.scene import Scene
from linkanim.units import four_digits
from linkanim.words import name_said, said, said_as


def speed_rows() -> tuple[str, ...]:
    """Return the labels of the rows that say how fast the scene runs."""
    return said("input speed"), said("input rate")


class PointedThing(NamedTuple):
    """A joint, a link (a body), or a spring or damper, by its name; a row of numbers, by its label.

    The class below the title counts as a row without a label.
    """

    kind: Literal["joint", "link", "strut", "row"]
    name: str


class Pointed(NamedTuple):
    """What the mouse is over at a place of the scene: a thing, or an instant (phase) on a curve."""

    place: Point
    thing: PointedThing | None = None
    instant: float | None = None


def thing_at(
    figure: Figure, pose: Pose, place: Point, reach: float, half_width: float
) -> PointedThing | None:
    """Return what lies at a place of a pose: the nearest joint, else a spring or damper, else a link.

    A joint is met within `reach`, a link within the `half_width` of its bar (the scene's unit).
    """
    at = complex(*place)
    places = {name: complex(*position) for name, position in pose.position.items()}
    far, joint = min((abs(there - at), name) for name, there in places.items())
    if far <= reach:
        return PointedThing("joint", joint)
    struts: tuple[Spring | Damper, ...] = (*figure.linkage.springs, *figure.linkage.dampers)
    for strut in struts:
        if _apart(at, [places[name] for name in strut.between]) <= 1.5 * half_width:
            return PointedThing("strut", strut.name)
    for body in reversed(figure.bodies):
        if body.name and _apart(at, [places[name] for name in body.joints]) <= half_width:
            return PointedThing("link", body.name)
    return None


def _apart(at: complex, corners: list[complex]) -> float:
    """Return how far a place is from the convex hull of corners; 0 inside."""
    around = hull(corners)
    if len(around) < 2:
        return abs(at - around[0])
    sides = list(zip(around, [*around[1:], around[0]], strict=True))
    turns = [((end - begin).conjugate() * (at - begin)).imag for begin, end in sides]
    if len(around) > 2 and (min(turns) >= 0.0 or max(turns) <= 0.0):
        return 0.0
    return min(_from_side(at, begin, end) for begin, end in sides)


def _from_side(at: complex, begin: complex, end: complex) -> float:
    along = end - begin
    share = ((at - begin) * along.conjugate()).real / (abs(along) ** 2 or 1.0)
    return abs(at - begin - min(max(share, 0.0), 1.0) * along)


class AtMouse(NamedTuple):
    """What the mouse is at: a `joint` that can be dragged; the numbers of a row, a tool, a button of the bar.

    It may be `over` a place of a sheet, or at a thing that is `pointed` at.
    """

    joint: str | None = None
    row: int | None = None
    tool: int | None = None
    button: int | None = None
    over: Over | None = None
    pointed: Pointed | None = None


NOWHERE = AtMouse()


def led(state: State) -> Pointed | None:
    """Return the joint in the hand, whose card of words is shown."""
    if state.grasp is None:
        return None
    places = state.displayed.pose(state.phase, 0).position
    joint = state.grasp.joint
    return Pointed(places[joint], PointedThing("joint", joint)) if joint in places else None


def hover_words(state: State, pointed: Pointed | None) -> tuple[str, ...]:
    """Return the lines about the thing under the mouse at this instant; empty where there is none."""
    if pointed is None:
        return ()
    scene, thing = state.displayed, pointed.thing
    if pointed.instant is not None:
        return _of_instant(state, scene, pointed.instant)
    if thing is None:
        return ()
    if thing.kind == "row":
        return _of_row(state, scene, thing.name)
    pose = scene.pose(state.phase, speed=state.clock.speed)
    if thing.kind == "joint" and thing.name in pose.position:
        return _of_joint(scene, pose, thing.name)
    if thing.kind == "link" and thing.name in pose.angle:
        return _of_link(scene, pose, thing.name)
    struts = {**pose.spring, **pose.damper}
    if thing.kind == "strut" and thing.name in struts:
        return _of_strut(scene, struts[thing.name], thing.name)
    return ()


def _of_instant(state: State, scene: Scene, phase: float) -> tuple[str, ...]:
    """Return where the input is at an instant, and the charted quantity or the traced joint's speed there."""
    pose = scene.pose(phase, speed=state.clock.speed)
    where = rows(scene, pose)[0]
    traced = tuple(f"{joint}.velocity" for joint in scene.trace[:1])
    tokens = chart_tokens(scene, state.look.chart) or traced
    known = (quantity(scene, token) for token in tokens)
    unit = scene.length_unit
    words = (
        f"{one.symbol} = {', '.join(map(four_digits, np.atleast_1d(one.displayed(pose)).tolist()))} "
        f"{one.display_unit(unit)}"
        for one in known
    )
    return (f"{where.label} {where.value}", *words)


def _of_row(state: State, scene: Scene, label: str) -> tuple[str, ...]:
    """Return words on what a click on a row of numbers does; empty where it does nothing."""
    if not label:
        return class_words(scene)
    if label in speed_rows():
        return (said("drag it sideways, or turn the wheel"),)
    token = charted(scene).get(label)
    if token is None:
        return ()
    known = token in chart_tokens(scene, state.look.chart)
    return (said("a click puts its chart away") if known else said("a click charts it"),)


def row_asks(state: State, label: str) -> tuple[Action, ...]:
    """Return the actions of a click on a row of numbers: its chart, on or off; on the class, its reason."""
    if not label:
        return (Action("note", said_as("list of reasons", ": ").join(class_words(state.displayed))),)
    token = charted(state.displayed).get(label)
    return (Action("strip", token),) if token else ()


def class_words(scene: Scene) -> tuple[str, ...]:
    """Return a scene's class, and the reason for it: Grashof's sum, else how its input moves."""
    info = scene.info
    return info.class_said[:1].upper() + info.class_said[1:], info.grashof or said(
        "input {motion}", motion=info.input_words
    )


def _of_joint(scene: Scene, pose: Pose, name: str) -> tuple[str, ...]:
    unit = scene.length_unit
    if scene.linkage.joint(name).fixed:
        (x, y), speed, acceleration = pose.position[name], 0.0, 0.0
    else:
        x, y, speed, acceleration = (
            _number(scene, pose, f"{name}.{what}")
            for what in ("position.x", "position.y", "velocity", "acceleration")
        )
    return (
        f"{name} ({four_digits(x)}, {four_digits(y)}) {unit}",
        f"v = {four_digits(speed)} {unit}/s   a = {four_digits(acceleration)} {unit}/s²",
    )


def _of_link(scene: Scene, pose: Pose, name: str) -> tuple[str, ...]:
    begin, end = (pose.position[joint] for joint in scene.linkage.body(name).joints[:2])
    long = hypot(end[0] - begin[0], end[1] - begin[1])
    rate, angle = (_number(scene, pose, f"{name}.{what}") for what in ("angular_velocity", "angle"))
    return (
        f"{name_said(scene.info.link_names[name])}: ω = {four_digits(rate)} rad/s",
        # rounded before it is brought within one turn, so that 359.99999° is 0°
        said(
            "{length} at {angle}",
            length=f"{four_digits(long)} {scene.length_unit}",
            angle=f"{four_digits(float(f'{angle % 360.0:.4g}') % 360.0)}°",
        ),
    )


def _of_strut(scene: Scene, strut: Strut, name: str) -> tuple[str, ...]:
    force = "" if strut.force is None else f"   {four_digits(strut.force)} N"
    return (f"{name}: {four_digits(strut.length)} {scene.length_unit}{force}",)


def _number(scene: Scene, pose: Pose, token: str) -> float:
    """Return a quantity's value as in all outputs: 0 where it is nothing but rounding."""
    return float(scene.quantities[token].displayed(pose))
