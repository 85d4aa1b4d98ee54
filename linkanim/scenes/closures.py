"""All closures of a scene: every way in which its bars can be put together at the start."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from linkanim.errors import BadInput, LinkanimError
from linkanim.frozen import NamedTuple
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

MOST_DYADS = 10
_SAME = 1e-6
"""Share of the linkage's size within which two poses are one."""


class FoundClosure(NamedTuple):
    """A closure: the scene put together so, its joints' places at the start, and how it is chosen.

    `sides` names the side of each dyad; `same_as` is the number of an earlier closure that the motion of this
    one passes through, from 1; None for a motion of its own.
    """

    scene: Scene
    places: Mapping[str, complex]
    sides: Mapping[str, str]
    same_as: int | None = None


def closures(scene: Scene) -> list[FoundClosure]:
    """Return every closure that assembles, each once, the scene's own first; BadInput beyond `MOST_DYADS`."""
    found: list[FoundClosure] = []
    for one in (*_of_group(scene), *_of_dyads(scene)):
        size = max(abs(place) for place in one.places.values()) or 1.0
        if not any(_apart(one.places, other.places) < _SAME * size for other in found):
            same = (n for n, other in enumerate(found, 1) if _passes(other.scene, one.places, _SAME * size))
            found.append(one._replace(same_as=next(same, None)))
    return found


def _apart(one: Mapping[str, complex], other: Mapping[str, complex]) -> float:
    return max(abs(place - other[name]) for name, place in one.items())


def _at_start(scene: Scene) -> dict[str, complex] | None:
    """Return the joints' places at the start, of a length that drives on its way; None out of reach."""
    drive = scene.linkage.drive
    turns = drive.coordinate.is_angle and not drive.actuator.stated_lengths
    by: Any = {"angle": drive.start} if turns else {"phase": math.pi / 3}
    at = scene.solve(**by, derivatives=0).position
    places = {name: complex(*map(float, place)) for name, place in at.items()}
    return None if any(place != place for place in places.values()) else places


def _passes(scene: Scene, places: Mapping[str, complex], near: float) -> bool:
    """Tell whether a scene's own motion comes to a pose: its input stands there again within a period."""
    mechanism, start = scene.mechanism, scene.linkage.drive.start
    first = _phase(scene)
    turns = [first + math.tau * n for n in range(round(scene.period / math.tau))]
    phases = turns if mechanism.full_turn else [*turns, *(-phase for phase in turns)]
    found = scene.solve(phase=np.array(phases), speed=1.0, derivatives=0).position
    off = [np.hypot(*(found[name] - [place.real, place.imag]).T) for name, place in places.items()]
    return bool(np.max(off, axis=0).min() < near) and math.isfinite(start)


def _phase(scene: Scene) -> float:
    drive = scene.linkage.drive
    if not drive.coordinate.is_angle or drive.actuator.stated_lengths:
        return math.pi / 3
    return float(scene.solve(angle=drive.start, derivatives=0).phase)


def _of_dyads(scene: Scene) -> Iterator[FoundClosure]:
    joints = scene.linkage.joints
    sided = [joint for joint in joints if joint.sides is not None]
    if len(sided) > MOST_DYADS:
        raise BadInput(
            f"{scene.name}: has {len(sided)} dyads, and {MOST_DYADS} are the most of which all are tried"
        )
    for flipped in product((False, True), repeat=len(sided)):
        other = {one.name for one, flip in zip(sided, flipped, strict=True) if flip}
        changed: list[Any] = [_flipped(one) if one.name in other else one for one in joints]
        linkage = replace(scene.linkage, joints=tuple(changed))
        try:
            there = replace(scene, linkage=linkage, towards=None)
            places = _at_start(there)
        except LinkanimError:
            continue
        if places is not None:
            known = {one.name: one for one in changed}
            sides = {one.name: one.sides[known[one.name].side < 0] for one in sided if one.sides}
            yield FoundClosure(there, places, sides)


def _flipped(joint: Any) -> Any:
    """Return a dyad on its other side."""
    return replace(joint, side=-joint.side)


def _of_group(scene: Scene) -> Iterator[FoundClosure]:
    from linkanim.mechanics.closures import group_closures

    for places in group_closures(scene.linkage):
        points = dict(scene.document["points"]) | {
            name: [place.real, place.imag]
            for name, place in places.items()
            if not scene.linkage.joint(name).fixed
        }
        try:
            there = scene_from({**scene.document, "points": points}, name=scene.name, where=scene.name)
            _ = there.mechanism
        except LinkanimError:
            continue
        yield FoundClosure(there, places | _pins(there), {})


def _pins(scene: Scene) -> dict[str, complex]:
    return {pin.name: complex(*pin.position) for pin in scene.linkage.pins}
