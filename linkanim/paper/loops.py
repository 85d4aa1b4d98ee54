"""The vector loops of a scene on paper: a figure with their vectors over the links, and their equations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, remainder, tau
from typing import NamedTuple

import numpy as np

from linkanim.digits import short, typeset
from linkanim.mechanics.facts.register import indexed, link_labels
from linkanim.mechanics.facts.vector_loops import ClosedLoop, LoopVector, vector_loops
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.paper.figure import Figured
from linkanim.paper.svg import svg
from linkanim.picture.diagrams.chart import pen_for
from linkanim.picture.diagrams.polygons import beside_vector
from linkanim.picture.figure import figure
from linkanim.picture.items import Caption, Group, Halo, Item, grouped
from linkanim.picture.labels.dimensions import symbols
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.placing import Clutter, Solid, place
from linkanim.picture.raster.raster import Layer
from linkanim.picture.raster.shapes import arrows
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

_CYLINDER = "L_{in}"
_STRAIGHT = 1e-9
"""In radians: what leans less off a body's line lies along it."""
_FILLED = 0.82
"""Of the picture's width or height the vectors take so much."""
_SHORT = 1e-6
"""Of the picture's width: what is shorter has no direction."""


class LoopEquations(NamedTuple):
    """What a loop is closed by: the vectors' sum, its two components, and what is found from them."""

    joint: str
    vectors: str
    components: tuple[str, str]
    unknowns: tuple[str, ...]


@dataclass(frozen=True)
class Loops:
    """The loops of a scene at one phase, their vectors R with the indices of the dimensions."""

    scene: Scene
    phase: float

    @cached_property
    def loops(self) -> tuple[ClosedLoop, ...]:
        """The loops, in the order in which they are solved."""
        pose = self.scene.pose(self.phase, 0)
        return vector_loops(self.scene.linkage, lambda name: complex(*pose.position[name]))

    @cached_property
    def vectors(self) -> tuple[LoopVector, ...]:
        """All vectors, each once."""
        return tuple(dict.fromkeys(one for loop in self.loops for way in loop.ways for one in way))

    def document(self, size: tuple[int, int]) -> str:
        """Return the figure as SVG: the links faint, the vectors over them."""
        picture = self._picture(size)
        ground, *_ = picture.drawing.standing()
        links = Group("links", picture.drawing.faint(self.scene.pose(self.phase, 0)))
        drawn = [ground, links, grouped("vectors", self._drawn(picture))]
        return svg(size, picture.theme.background, drawn, title=f"Vector loops of {self.scene.title}")

    def _picture(self, size: tuple[int, int]) -> Picture:
        """Return the links with all vectors in view, as large as there is room for."""
        look = Look(trace=False, hud=False)
        whole = Figured(self.scene, size, look, self.phase).picture
        ends = [
            whole.view.place((end.real, end.imag)) for one in self.vectors for end in (one.begin, one.end)
        ]
        x, y = np.real(ends), np.imag(ends)
        (width, height), spans = size, (max(float(np.ptp(x)), 1.0), max(float(np.ptp(y)), 1.0))
        zoom = min(_FILLED * width / spans[0], _FILLED * height / spans[1])
        off = (x.max() + x.min() - width) / 2, (y.max() + y.min() - height) / 2
        pan = -zoom * float(off[0]) / height, -zoom * float(off[1]) / height
        return Figured(self.scene, size, replace(look, zoom=zoom, pan=pan), self.phase).picture

    def _drawn(self, picture: Picture) -> Iterator[Item]:
        """Yield the vectors, and their names beside them."""
        pen, theme, view = pen_for(picture.layout, picture.type, picture.theme), picture.theme, picture.view
        colours = {"bar": theme.velocity, "slide": theme.acceleration}
        found = [
            (
                one,
                view.place((one.begin.real, one.begin.imag)),
                view.scale * (one.end - one.begin).conjugate(),
            )
            for one in self.vectors
            if abs(one.end - one.begin) * view.scale > _SHORT * picture.size[0]
        ]
        for one, foot, reach in found:
            yield Layer(colours.get(one.sort, theme.ink), arrows([foot], [reach], 1.7 * pen.line))
        middle = complex(np.mean([foot + reach / 2 for _, foot, reach in found]))
        names = [self.symbol(one, "R") for one, _, _ in found]
        to_place = [
            beside_vector(foot, reach, middle, (pen.type.width(name, pen.text, strong=True), pen.text))
            for (_, foot, reach), name in zip(found, names, strict=True)
        ]
        solids = (Solid(np.array([[foot, foot + reach]]), 1.5 * pen.line) for _, foot, reach in found)
        clutter, halo = (
            Clutter(Rect(0, 0, *picture.size), solids=tuple(solids)),
            Halo(theme.background, pen.line),
        )
        for (one, *_), name, label, spot in zip(
            found, names, to_place, place(to_place, clutter), strict=True
        ):
            at = complex(label.places[0, spot.which])
            colour, top = colours.get(one.sort, theme.ink), (at.real, at.imag - pen.text / 2)
            yield Caption(name, top, pen.text, colour, "centre", strong=True, halo=halo)

    def symbol(self, vector: LoopVector, letter: str) -> str:
        """Return what a vector is called, R₂ or in its length r₂: by its dimension, else by its joints."""
        start, end = vector.joints
        match vector.sort:
            case "offset":
                return indexed({"R": "E", "r": "e"}[letter], self._slid(end))
            case "slide":
                return indexed({"R": "S", "r": "s"}[letter], self._slid(end))
            case "cylinder":
                return _CYLINDER
        known = self._numbers.get(frozenset(vector.joints))
        return f"{letter}{known}" if known else indexed(letter, f"{start}{end}")

    @cached_property
    def _numbers(self) -> dict[frozenset[str], str]:
        """The indices of the dimensions that are lengths from joint to joint."""
        stated = symbols(figure(self.scene)).dimensions
        lengths = [one for one in stated if not one.angle and (one.begin, one.end) == (0, 1)]
        return {frozenset(one.frame): one.symbol[1:] for one in lengths if len(set(one.frame)) > 1}

    def _slid(self, joint: str) -> str:
        """Return by what a guided joint is called: its slider's number, else its own name."""
        linkage = self.scene.linkage
        slider = next((body.name for body in linkage.bodies if body.slider == joint), None)
        return link_labels(linkage)[slider] if slider else joint

    def equations(self) -> Iterator[LoopEquations]:
        """Yield what each loop is closed by; unknown is what no loop before it gives."""
        linkage = self.scene.linkage
        known = {_CYLINDER, indexed("s", self._slid(linkage.drive.joint))}
        if linkage.joint(linkage.drive.joint).bars:
            known = {_CYLINDER}
        if linkage.drive.actuator.along is None:
            known |= {self._turning(crank.pivot, crank.name) for crank in linkage.cranks}
        for loop in self.loops:
            variables = [name for way in loop.ways for one in way for name in self._variables(one)]
            unknowns = tuple(dict.fromkeys(name for name in variables if name not in known))
            known.update(unknowns)
            sides = [self._sum(way, "") for way in loop.ways]
            parts = [[self._sum(way, work) for way in loop.ways] for work in ("cos", "sin")]
            vectors, across, up = (" = ".join(two) for two in (sides, *parts))
            yield LoopEquations(loop.joint, vectors, (across, up), unknowns)

    def _sum(self, way: tuple[LoopVector, ...], work: str) -> str:
        if not way:
            return "0"
        if not work:
            return " + ".join(self.symbol(one, "R") for one in way)
        return " + ".join(f"{self.symbol(one, 'r')} {work} {self._angle(one)}" for one in way)

    def _variables(self, vector: LoopVector) -> Iterator[str]:
        """Yield what of a vector changes: how far it slides, and how its body turns."""
        if vector.sort in ("slide", "cylinder"):
            yield self.symbol(vector, "r")
        if vector.axis:
            yield self._turning(*vector.axis)

    def _turning(self, start: str, end: str) -> str:
        """Return the symbol of the angle of the body that two joints are on: one for all that is rigid."""
        linkage, labels = self.scene.linkage, link_labels(self.scene.linkage)
        body = next((one for one in linkage.bodies if {start, end} <= set(one.joints)), None)
        if body is None:
            frame = holding(linkage.rigid_bodies, (start, end))
            rigid = (one for one in linkage.bodies if not one.slider and frame is not None)
            body = next((one for one in rigid if holding(linkage.rigid_bodies, one.joints) == frame), None)
        return indexed("θ", labels[body.name] if body else f"{start}{end}")

    def _angle(self, vector: LoopVector) -> str:
        """Return a vector's angle: that of its body, with what it leans off the body's line, or a number."""
        way = float(np.angle(vector.along))
        if vector.axis is None:
            return _degrees(way) if way >= 0 else f"({_degrees(way)})"
        turning = self._turning(*vector.axis)
        off = remainder(way - self._own(turning, vector.axis), tau)
        if abs(off) < _STRAIGHT:
            return turning
        return f"({turning} {'−' if off < 0 else '+'} {_degrees(abs(off))})"

    def _own(self, turning: str, axis: tuple[str, str]) -> float:
        """Return the direction that a body's angle is measured in."""
        linkage, labels = self.scene.linkage, link_labels(self.scene.linkage)
        pose = self.scene.pose(self.phase, 0)
        own = next(
            (one.joints[:2] for one in linkage.bodies if indexed("θ", labels[one.name]) == turning), axis
        )
        start, end = (complex(*pose.position[name]) for name in own)
        return float(np.angle(end - start))


def _degrees(angle: float) -> str:
    return f"{typeset(short(round(degrees(angle), 9) + 0.0))}°"
