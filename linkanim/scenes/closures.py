"""Find all closures of a scene: each way in which its lengths can be put together, once.

A closure that an input runs into through a limit is part of the motion that comes from there, and no other
one; another range of the input is.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import product

import numpy as np

from linkanim.errors import BadInput, LinkanimError
from linkanim.frozen import frozen
from linkanim.mechanics.closures import group_closures
from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import Joint, Linkage
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.scenes.editing import closure_choices, replaced, with_document
from linkanim.scenes.reading import taken_together
from linkanim.scenes.scene import Scene
from linkanim.units import angle, degrees
from linkanim.words import name_said, said, said_as

MOST_DYADS = 10
"""The most dyads whose closures are tried: 1,024 ways to put them together."""
_PROBES = (0.37, 2.9)
_ALIKE = 1e-7
"""Poses and curves that are nearer, in shares of the longest length, are one."""
_SAMPLES = 24
Progress = Callable[[int, int], None]


@frozen
class SceneClosure:
    """A closure of a scene, as a scene of its own; `sides` are those of its dyads, by joint, as in a file.

    `curve` is the number, from 1, of the first closure that traces the same curves; its own where there is
    none before, and None where nothing is traced.
    """

    scene: Scene
    sides: Mapping[str, str]
    curve: int | None

    @cached_property
    def pose(self) -> dict[str, tuple[float, float]]:
        """Where the joints are at the start, in the scene's unit."""
        return {name: (place.real, place.imag) for name, place in _pose(self.scene.mechanism).items()}


def closures(scene: Scene, progress: Progress | None = None) -> tuple[SceneClosure, ...]:
    """Return the closures of a scene, the scene's own first.

    Those of links that are solved together are searched for from random starts, in the pose of the scene.
    `progress` is called with (ways tried, ways in all). BadInput for more than `MOST_DYADS` dyads.
    """
    choices = list[SceneClosure]()
    for variant, sides in _variants(scene, progress or (lambda done, count: None)):
        for one in _ranges(variant):
            if not any(_is_reached(one, other.scene) for other in choices):
                curves = (n for n, other in enumerate(choices, start=1) if _traces_alike(one, other.scene))
                number = next(curves, len(choices) + 1) if one.trace else None
                choices.append(SceneClosure(one, sides, number))
    return tuple(choices)


def described(choices: Sequence[SceneClosure], place: int) -> tuple[str, ...]:
    """Return words for the closure at a place: number, how it is put together, input, class, curve."""
    one, number = choices[place], place + 1
    info, sides = one.scene.info, (f"{name_said(joint)} {said(side)}" for joint, side in one.sides.items())
    curve = said("its own") if one.curve == number else said("that of {number}", number=one.curve)
    pose = said("as given") if number == 1 else said("in another pose")
    way = said_as("list", ", ").join(sides) or pose
    return str(number), way, info.motion_words, info.class_said, curve if one.curve else ""


def _variants(scene: Scene, progress: Progress) -> Iterator[tuple[Scene, dict[str, str]]]:
    """Yield the scene with each choice of its dyads' closures that can be assembled, its own first."""
    if "points" in scene.document:
        yield from _in_other_poses(scene, progress)
        return
    choices = closure_choices(scene)
    _refuse_many(len(choices))
    ways = [*product(*(names for _, *names in choices))]
    for n, way in enumerate(ways):
        progress(n, len(ways))
        document = scene.document
        sides = {}
        for (key, *_), name in zip(choices, way, strict=True):
            document, sides[key[-2]] = replaced(document, key, name), name
        try:
            yield (with_document(scene, document) if n else scene), sides
        except LinkanimError:
            continue


def _in_other_poses(scene: Scene, progress: Progress) -> Iterator[tuple[Scene, dict[str, str]]]:
    """Yield the scene of points in other poses: of its group, and for each of those of its dyads."""
    seeds = [scene]
    linkage = scene.linkage
    if group_of(linkage):
        linkage = taken_together(scene).linkage
        seeds += _valid(_posed(scene, pose) for pose in group_closures(linkage)[1:])
    dyads = [joint for joint in linkage.joints if joint.dyad]
    _refuse_many(len(dyads))
    ways = [*product(*([False, True] for _ in dyads))]
    for m, seed in enumerate(seeds):
        for n, way in enumerate(ways):
            progress(m * len(ways) + n, len(seeds) * len(ways))
            over = {joint.name for joint, other in zip(dyads, way, strict=True) if other}
            try:
                yield (_flipped(seed, over) if over else seed), {}
            except LinkanimError:
                continue


def _valid(scenes: Iterator[Scene]) -> Iterator[Scene]:
    while True:
        try:
            yield next(scenes)
        except StopIteration:
            return
        except LinkanimError:
            continue


def _refuse_many(dyads: int) -> None:
    if dyads > MOST_DYADS:
        most = 2**MOST_DYADS
        raise BadInput(f"{dyads} dyads can be put together in {2**dyads:,} ways; {most:,} are the most")


def _flipped(scene: Scene, over: set[str]) -> Scene:
    """Return a scene of points in a pose with the dyads of some joints on their other closures."""
    joints = tuple(_other(joint) if joint.name in over else joint for joint in scene.linkage.joints)
    return _in_pose_of(scene, replace(scene.linkage, joints=joints))


def _other(joint: Joint) -> Joint:
    return replace(joint, side=-joint.side)  # type: ignore[attr-defined, call-arg]


def _in_pose_of(scene: Scene, linkage: Linkage) -> Scene:
    return _posed(scene, _pose(mechanism(linkage)))


def _pose(solved: Mechanism) -> dict[str, complex]:
    """Return where the joints are at the start."""
    start = solved.linkage.drive.start
    return _at(solved, solved.phase_of(start, 0.0) if solved.comes_to(start) else 0.0)[1]


def _posed(scene: Scene, pose: Mapping[str, complex]) -> Scene:
    """Return a scene of points in another pose; lines of slides turn with the links that they are on."""
    document, before = dict(scene.document), _pose(scene.mechanism)
    points = document["points"]
    known = {name: [pose[name].real, pose[name].imag] for name in points if name in pose}
    document["points"] = {**points, **known}
    slides = {}
    for name, slide in document.get("slides", {}).items():
        link = document["links"].get(slide.get("on", "ground"), ())
        turned = _turn([name for name in link if name in pose], before, pose)
        slides[name] = {**slide, "angle": f"{degrees(angle(slide.get('angle', '0 deg')) + turned)!r} deg"}
    if slides:
        document["slides"] = slides
    return with_document(scene, document)


def _turn(names: list[str], before: Mapping[str, complex], after: Mapping[str, complex]) -> float:
    """Return by how much a link has turned between two poses; 0 for one of fewer than two points."""
    if len(names) < 2:
        return 0.0
    first, *others = names
    last = max(others, key=lambda name: abs(before[name] - before[first]))
    return cmath.phase((after[last] - after[first]) / (before[last] - before[first]))


def _ranges(scene: Scene) -> Iterator[Scene]:
    """Yield the scene in each range of its input, that of its own start first."""
    yield scene
    for low, high in scene.mechanism.other_ranges:
        middle = (low + high) / 2
        try:
            if "points" in scene.document:
                drive = replace(scene.linkage.drive, start=middle, at_zero=True)
                yield _in_pose_of(scene, replace(scene.linkage, drive=drive))
            else:
                table = {**scene.document.get("drive", {}), "start": f"{math.degrees(middle)!r} deg"}
                yield with_document(scene, {**scene.document, "drive": table})
        except LinkanimError:
            continue


def _is_reached(one: Scene, other: Scene) -> bool:
    """Tell whether poses of one closure lie on the way of another."""
    return all(_is_passed(_at(one.mechanism, probe), other) for probe in _PROBES)


def _at(solved: Mechanism, phase: float) -> tuple[float, dict[str, complex]]:
    pose = solved.pose(phase, 1.0, 0.0, 0)
    return float(pose.coordinate), {name: complex(*place) for name, place in pose.position.items()}


def _is_passed(closure: tuple[float, dict[str, complex]], scene: Scene) -> bool:
    """Tell whether a scene passes through a pose at the place of its input."""
    coordinate, places = closure
    solved = scene.mechanism
    if not solved.comes_to(coordinate):
        return False
    near = _ALIKE * scene.linkage.longest
    starts = np.linspace(0.0, scene.period, 16 * solved.periods, endpoint=False)
    for phase in {round(solved.phase_of(coordinate, float(start)), 9) for start in starts}:
        _, others = _at(solved, phase)
        if all(abs(places[name] - others[name]) <= near for name in places):
            return True
    return False


def _traces_alike(one: Scene, other: Scene) -> bool:
    """Tell whether two closures trace the same curves."""
    return all(_covers(one, other, joint) and _covers(other, one, joint) for joint in one.trace)


def _covers(one: Scene, other: Scene, joint: str) -> bool:
    """Tell whether the curve of one closure runs along that of another."""
    path, near = one.point_path(joint), _ALIKE * one.linkage.longest
    for phase in np.linspace(0.0, other.period, _SAMPLES, endpoint=False):
        _, places = _at(other.mechanism, float(phase))
        place = places[joint]
        nearest = path.nearest((place.real, place.imag), 0.0)
        if abs(_at(one.mechanism, nearest)[1][joint] - place) > near:
            return False
    return True
