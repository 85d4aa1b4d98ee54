"""From a draft to a scene: the document that a scene file would hold, read as every file is."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from math import dist, pi
from typing import Any, NamedTuple

from linkanim.build.draft import Draft
from linkanim.build.missing import missing, reworded
from linkanim.build.order import Found, found
from linkanim.build.photo import photo_table
from linkanim.build.shorthand import shortened
from linkanim.errors import BadInput
from linkanim.mechanics.linkage.joint import Point
from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.steering import phase_towards

NAME = "draft"
"""What the scene of a draft is called, and its file, unless it has a name."""
_FORCE = {"stiffness", "free_length"}
_AFTER = ("bodies", "springs", "dampers")


class Made(NamedTuple):
    """What a draft comes to: the scene, or None, and in words what is missing before there is one."""

    scene: Scene | None
    missing: str


def document(draft: Draft, joints: Found) -> Mapping[str, Any]:
    """Return the document of a scene file that says what is drawn, its joints as they are found."""
    # The one crank that no gear turns is driven without being named.
    drive = {key: value for key, value in draft.drive.items() if key != "joint"}
    stated = {**{key: value for key, value in draft.rest.items() if key != "trace"}, "drive": drive}
    stated |= {"ground": draft.of("pins"), "joints": joints}
    stated |= {kind: draft.of(kind) for kind in _AFTER}
    stated["springs"] = {name: _whole(spring) for name, spring in draft.of("springs").items()}
    trace = [name for name in draft.trace if name in draft.of("pins") or name in joints]
    stated |= {"trace": {"joints": trace}}
    stated |= {"photo": photo_table(draft.photo) if draft.photo else {}}
    return shortened(
        draft, {key: value for key, value in stated.items() if value not in ({}, {"joints": []})}
    )


def made(draft: Draft, name: str = NAME) -> Made:
    """Return the scene that a draft describes, put together; or none, and what it lacks."""
    joints = found(draft)
    if reason := missing(draft, joints):
        return Made(None, reason)
    try:
        scene = scene_from(document(draft, joints), name=name, where=name)
    except BadInput as error:
        return Made(None, reworded(draft, error))
    return Made(scene, "")


def phase_of(scene: Scene, places: Mapping[str, Point], *, swung: bool) -> float:
    """Return the phase at which a scene stands as it was drawn.

    0 of one that turns fully, which starts where it was drawn, unless it `swung` before. Of one that goes
    there and back it is the way on which all joints are nearest to where they were drawn.
    """
    if scene.info.full_turn and not swung:
        return 0.0
    driven = places[scene.linkage.drive.joint]
    ways = (0.0,) if scene.info.full_turn else (pi / 2, 3 * pi / 2)
    return min((phase_towards(scene, way, driven) for way in ways), key=partial(_off, scene, places))


def _off(scene: Scene, places: Mapping[str, Point], phase: float) -> float:
    """Return how far the joint is from its place that is farthest from it."""
    pose = scene.pose(phase, 0).position
    return max(dist(place, places[name]) for name, place in pose.items())


def _whole(spring: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return a spring without its force as long as only half of that is typed."""
    return spring if spring.keys() >= _FORCE else {key: spring[key] for key in spring.keys() - _FORCE}
