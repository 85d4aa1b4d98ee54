"""Say a scene by its points in one pose and the links through them.

The document of any scene of cranks, dyads and gears becomes one with [points], [links], [slides] and [gears];
a scene that has that form already keeps it.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from linkanim.errors import SceneError
from linkanim.mechanics.linkage import Slide
from linkanim.scenes.file_form import GROUND, SHORTHANDS
from linkanim.scenes.links import in_degrees, nearest
from linkanim.scenes.scene import Scene

_DROPPED = ("form", "joints", GROUND, "bodies", "drive", "drives", *SHORTHANDS)
"""Keys that [points] and [links] replace, or that are said anew."""
_CLOSE = 1e-9
"""Share of the linkage's size by which the points of both forms may differ over a period."""
_STATED = 9
"""Lengths of so many digits were stated; those of more follow from points, which say them to all digits."""
_ROUNDING = 4e-16
"""Shares of the linkage's size by which a coordinate may be off a number of few digits that is meant."""


def as_points(scene: Scene) -> dict[str, Any]:
    """Return the scene's document in that form, its pose being the one at the start.

    SceneError for a scene without a document.
    """
    if not scene.document:
        raise SceneError(f"{scene.name}: has no scene file behind it that could be written")
    if "points" in scene.document:
        return dict(scene.document)
    return _PointForm(scene).document()


def moves_alike(scene: Scene, made: Scene) -> bool:
    """Return whether another scene moves as this one over its period."""
    phases = np.linspace(0.0, scene.period, 24)
    one, other = (each.solve(phase=phases, speed=1.0, derivatives=0).position for each in (scene, made))
    size = max(float(np.ptp(place)) for place in one.values())
    both = ((place, other[name]) for name, place in one.items() if name in other)
    off = max((float(np.abs(there - here).max()) for here, there in both), default=size)
    return off <= _CLOSE * size


class _PointForm:
    """A scene's points, links and slides in the pose at the start."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.linkage = scene, scene.linkage
        drive = scene.linkage.drive
        turns = drive.coordinate.is_angle and not drive.actuator.stated_lengths
        at = scene.solve(angle=drive.start, derivatives=0) if turns else None
        if at is None or not math.isfinite(float(at.phase)):
            at = scene.solve(phase=math.pi / 3, derivatives=0)
        self.at = {name: complex(*map(float, place)) for name, place in at.position.items()}
        self.links = self._links()

    def _links(self) -> dict[str, list[str]]:
        """Return the links by their joints: bodies that share two joints, apart from each other, are one."""
        fixed = [pin.name for pin in self.linkage.pins]
        links: list[list[str]] = [fixed]
        for frame in self.linkage.rigid_bodies[1:]:
            mine = [*frame]
            for other in [one for one in links if self._as_one(one, mine)]:
                links.remove(other)
                mine = [*dict.fromkeys((*other, *mine))]
            links.append(mine)
        ground = next(one for one in links if not fixed or (fixed[0] in one and {*fixed} <= {*one}))
        named: dict[str, list[str]] = {GROUND: ground}
        for joints in (one for one in links if one is not ground and len(one) > 1):
            bodies = (body.name for body in self.linkage.bodies if len({*body.joints} & {*joints}) > 1)
            name = next(bodies, "".join(joints))
            named[name if name not in named else f"{name}'"] = joints
        for joint in self.linkage.joints:
            if joint.travels:
                named[self.block(joint.name)] = [joint.name]
        return named

    def _as_one(self, one: list[str], other: list[str]) -> bool:
        first, *shared = [name for name in one if name in other] or [""]
        return any(abs(self.at[name] - self.at[first]) > 0 for name in shared)

    def block(self, joint: str) -> str:
        """Return the name of the block that a joint is on."""
        own = (body.name for body in self.linkage.bodies if body.slider == joint)
        return next(own, f"block {joint}")

    def link_of(self, *joints: str) -> str:
        """Return the link that has all these joints."""
        return next(name for name, on in self.links.items() if {*joints} <= {*on})

    def _slides(self) -> Iterator[tuple[str, dict[str, str]]]:
        for joint in self.linkage.joints:
            first, *across = joint.slides or (None,)
            if first is None:
                continue
            if joint.travels:
                block = self.block(joint.name)
                yield block, {"link": block, **self._line(first)}
            else:
                yield f"pin {first.point}", {"point": first.point, **self._line(first)}
            for slide in (one for one in across if one.start == joint.name):
                angle = {"angle": self._line(joint.slides[0], slide.line.angle)["angle"]}
                yield f"pin {slide.point}", {"point": slide.point, "on": self.block(joint.name), **angle}

    def _line(self, slide: Slide, angle: float | None = None) -> dict[str, str]:
        """Return the link that carries a line, and the line's direction in the pose."""
        line, turned = slide.line, slide.line.angle if angle is None else angle
        if line.on is None:
            return {"on": GROUND, "angle": in_degrees(turned)}
        way = self.at[line.on[1]] - self.at[line.on[0]]
        return {
            "on": self.link_of(*line.on),
            "angle": in_degrees(math.remainder(phase(way) + turned, math.tau)),
        }

    def _gears(self) -> dict[str, dict[str, Any]]:
        gears = {}
        for crank in self.linkage.cranks:
            if crank.gear and not crank.gear.motor:
                mate = self.linkage.crank(crank.gear.mate)
                pair = [self.link_of(mate.pivot, mate.name), self.link_of(crank.pivot, crank.name)]
                gears[f"{mate.name}-{crank.name}"] = {"links": pair, "ratio": str(crank.gear.ratio)}
        return gears

    def _lengths(self) -> dict[str, dict[str, float]]:
        """Return the lengths of bars as they were stated, but for those that follow from the points."""
        lengths: dict[str, dict[str, float]] = {}
        points = self._points()
        for joint in self.linkage.joints:
            for start, length in joint.bars:
                ends = [points[name] for name in (start, joint.name)]
                plain = all(float(f"{number:.{_STATED}g}") == number for place in ends for number in place)
                if float(f"{length:.{_STATED}g}") == length and not (plain and math.dist(*ends) == length):
                    link = lengths.setdefault(self.link_of(start, joint.name), {})
                    link[f"{start}-{joint.name}"] = length
        return lengths

    def _points(self) -> dict[str, list[float]]:
        """Return the places of the points, without what rounding has added to them."""
        size = max(abs(place) for place in self.at.values())

        def meant(number: float) -> float:
            short = float(f"{number:.{_STATED}g}")
            return short if abs(short - number) <= _ROUNDING * size else number

        return {name: [meant(place.real), meant(place.imag)] for name, place in self.at.items()}

    def _drive(self) -> dict[str, Any]:
        drive, stated = self.linkage.drive, dict(self.scene.document.get("drive", {}))
        kept = {key: stated[key] for key in ("speed", "returns") if key in stated}
        driven = self.linkage.driven
        if not drive.coordinate.is_angle:
            line, pins = driven.joint.slides[0].line, self.linkage.rigid_bodies[0]
            start = nearest(self.at, pins, self.at[driven.joint.name], line.angle)
            more = ((self.at[line.through] - self.at[start]) * rect(1.0, -line.angle)).real
            lengths = (length + more for length in drive.actuator.stated_lengths)
            ends = dict(zip(("from", "to"), lengths, strict=True))
            return {"slide": self.block(driven.joint.name), **ends, **kept}
        cylinder = {"cylinder": _without_joint(stated["cylinder"])} if "cylinder" in stated else {}
        links = [self.link_of(pin) for pin in (driven.pivot,)] + [
            self.link_of(driven.pivot, driven.joint.name)
        ]
        return {"joint": driven.pivot, "links": links, **cylinder, **kept}

    def _motors(self) -> dict[str, Any]:
        motors = {}
        for name, motor in self.scene.document.get("drives", {}).items():
            crank = self.linkage.crank(motor["joint"])
            links = [GROUND, self.link_of(crank.pivot, crank.name)]
            motors[name] = {"joint": crank.pivot, "links": links, "speed": motor["speed"]}
        return motors

    def _bodies(self) -> dict[str, Any]:
        """Return what the document says of bodies beyond their joints."""
        bodies = {}
        for name, body in self.scene.document.get("bodies", {}).items():
            further = {key: value for key, value in body.items() if key not in ("joints", "slider")}
            if "joints" in body and ("com" in further or name not in self.links):
                further["joints"] = body["joints"]
            if further:
                bodies[name] = further
        return bodies

    def document(self) -> dict[str, Any]:
        """Return the whole document."""
        stated = {key: value for key, value in self.scene.document.items() if key not in _DROPPED}
        tables: Mapping[str, Any] = {
            "points": self._points(),
            "links": self.links,
            "slides": dict(self._slides()),
            "gears": self._gears(),
            "lengths": self._lengths(),
            "drive": self._drive(),
            "drives": self._motors(),
            "bodies": self._bodies(),
        }
        trace = {"trace": {"joints": list(self.scene.trace)}} if self.scene.trace else {}
        return stated | {key: table for key, table in tables.items() if table} | trace


def _without_joint(cylinder: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in cylinder.items() if key != "joint"}
