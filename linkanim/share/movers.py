"""What of a picture moves on a page, and how: each group of it as SVG, and what its script moves it by."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from linkanim.mechanics.motion.motion import Pose
from linkanim.paper.svg import flat
from linkanim.picture.items import Caption, Group
from linkanim.picture.labels.names import Label, Names
from linkanim.picture.parts.struts import BACK, CORE, EDGE, TILT, Coil, Damping
from linkanim.picture.parts.trace import RECENT, SWELL, Trace
from linkanim.picture.parts.turning import AHEAD, SWEEP, Sliding, Turning
from linkanim.picture.parts.vectors import ORDER, Arrows
from linkanim.picture.picture import Picture
from linkanim.picture.raster.parts import Part, Places, Stamp
from linkanim.share.pairs import Pairs
from linkanim.share.tracks import centre, packed

Mover = dict[str, Any]
"""What a group is moved by: its `kind`, the points it follows, its measures in pixels, its colours."""


@dataclass(frozen=True)
class Movable:
    """A group as SVG, and what moves it; None for one that stands still."""

    shapes: str
    mover: Mover | None = None
    transform: str = ""
    """Where it lies at the start."""


@dataclass(frozen=True)
class Mobile:
    """A picture in both themes, whose groups move on a page."""

    light: Picture
    dark: Picture
    pairs: Pairs

    @cached_property
    def _places(self) -> Places:
        """Where joints and centres of mass lie at the start."""
        pose, _ = self.light.poses(0.0)
        masses = {centre(body): self.light.view.place(at) for body, at in pose.com_position.items()}
        return {**self.light.drawing.places(pose), **masses}

    def movables(self) -> Iterator[Movable]:
        """Yield all that is drawn, back to front, as it lies at the start."""
        pose, _ = self.light.poses(0.0)
        for one, other in zip(self.light.groups(pose), self.dark.groups(pose), strict=True):
            yield from self._movable(one, other, pose)

    def _movable(self, one: Group, other: Group, pose: Pose) -> Iterator[Movable]:
        match one.made_of, other.made_of:
            case Part() as part, Part() as dark:
                yield self._part(part, dark)
            case tuple() as parts, tuple() as darks:
                yield from (self._part(*both) for both in zip(parts, darks, strict=True))
            case Stamp() as stamp, Stamp() as dark:
                for body in pose.com_position:
                    at = centre(body)
                    put = (Part(at, at, at, some.layers) for some in (stamp, dark))
                    yield self._part(*put)
            case Names() as names, Names() as dark:
                yield from self._names(names, dark)
            case dict() as lines, dict() as darks if self.light.names:
                for label in (label for label in self.light.names.labels if label.symbol in lines):
                    line = self._part(lines[label.symbol], darks[label.symbol])
                    yield replace(line, mover={**(line.mover or {}), **_shown(label)})
            case (Coil() | Damping() | Trace() | Arrows() | Turning() | Sliding()) as live, dark:
                yield Movable("", self._live(one, live, dark))
            case _:
                if shapes := self.pairs.elements(flat([one]), flat([other])):
                    yield Movable(shapes)

    def _part(self, light: Part, dark: Part) -> Movable:
        shapes = self.pairs.elements(light.layers, dark.layers)
        mover = {"kind": "part", "at": light.at, "tail": light.tail, "head": light.head}
        link = self.light.scene.info.link_names.get(light.name)
        mover |= {"link": link} if link else {}
        turn, at = light.turn(self._places), self._places[light.at]
        matrix = (turn.real, turn.imag, -turn.imag, turn.real, at.real, at.imag)
        return Movable(shapes, mover, f"matrix({' '.join(f'{part:.7g}' for part in matrix)})")

    def _names(self, light: Names, dark: Names) -> Iterator[Movable]:
        tables = ([*names.table.captions()] if names.table else [] for names in (light, dark))
        if table := self.pairs.elements(*tables):
            yield Movable(table)
        for label, other in zip(light.labels, dark.labels, strict=True):
            shapes = self.pairs.elements([_line(label, light)], [_line(other, dark)])
            yield Movable(shapes, {"kind": "label", **_placed(label, light), **_shown(label)})

    def _live(self, group: Group, light: Any, dark: Any) -> Mover:
        """Return what a script draws anew at every pose."""
        match light:
            case Coil():
                return self._coil(light, dark)
            case Damping():
                return self._damping(light, dark)
            case Trace():
                kind, width = ("curve" if group.still else "recent"), light.width
                colours = self.pairs.variables((light.back, *light.shades), (dark.back, *dark.shades))
                recent = {"phase": RECENT, "swell": SWELL}
                return {"kind": kind, "at": light.joint, "width": width, "colours": colours} | recent
            case Arrows():
                return self._arrows(light, dark)
            case Sliding():
                along = _pair(light.along)
                more = {"kind": "sliding", "at": light.joint, "along": along, "room": light.room}
                return {**more, "longest": light.longest, **self._driven(light, dark)}
        bar = {"kind": "turning", "pivot": light.pivot, "pin": light.pin, "arc": light.arc}
        reach = {"arrow": light.arrow, "middle": light.middle, "sweep": SWEEP, "ahead": AHEAD}
        return {**bar, **reach, "angle": self.light.look.names > 1, **self._driven(light, dark)}

    def _driven(self, light: Any, dark: Any) -> Mover:
        colours = self.pairs.variables(light.colours, dark.colours)
        drive = self.light.scene.linkage.drive
        read = abs(drive.speed) / drive.coordinate.shown(1.0)
        return {"gain": read / light.fastest, "line": light.gauge.line, "colours": colours}

    def _coil(self, light: Coil, dark: Coil) -> Mover:
        ends = dict(zip(light.between, (0j, 1 + 0j), strict=True))
        both = ([layer.colour for layer in coil.layers(ends)] for coil in (light, dark))
        between, widths = list(light.between), [wide * light.wire for wide in (BACK, EDGE, CORE)]
        size = {"radius": light.radius, "lead": light.lead, "coils": light.coils, "widths": widths}
        return {
            "kind": "coil", "between": between, **size, "tilt": TILT, "colours": self.pairs.variables(*both)
        }  # fmt: skip

    def _damping(self, light: Damping, dark: Damping) -> Mover:
        barrel = self.pairs.elements(light.cylinder, dark.cylinder)
        head = self.pairs.elements([light.head], [dark.head])
        colour = self.pairs.variable(light.cylinder[0].colour, dark.cylinder[0].colour)
        size = {"reach": list(light.reach), "length": light.length, "rod": light.rod, "colour": colour}
        return {"kind": "damping", "between": list(light.between), **size, "barrel": barrel, "head": head}

    def _arrows(self, light: Arrows, dark: Arrows) -> Mover:
        """Return arrows; `gain` is their length in pixels for one pixel by radian (or radian²) of phase."""
        order, scene = ORDER[light.kind], self.light.scene
        gain = light.scale(light.drive) * abs(light.drive) ** order / self.light.view.scale
        colours = self.pairs.variables((light.colour, light.halo), (dark.colour, dark.halo))
        feet = [*scene.trace, *(centre(body.name) for body in scene.linkage.bodies if body.com is not None)]
        line = {"longest": light.longest, "line": light.gauge.line, "colours": colours}
        return {"kind": "arrows", "order": order, "at": feet, "gain": gain, **line}


def _line(label: Label, names: Names) -> Caption:
    """Return a label's line about 0."""
    return Caption(label.text, (0.0, -0.5 * label.line), label.line, label.colour, "centre", True, names.halo)


def _shown(label: Label) -> Mover:
    """Return how far a label shows over the cycle, in 255ths."""
    assert label.shown is not None
    return {"shown": packed(np.rint(255 * label.shown), "u1")}


def _placed(label: Label, names: Names) -> Mover:
    """Return where a label stands, as `Spots` has it."""
    assert label.spot is not None
    at, head, begin, end, share, aside, further, off = label.spot
    ways = {"begin": _pair(begin), "end": _pair(end), "off": _pair(off), "size": list(label.size)}
    shares = {"share": float(share), "aside": float(aside), "further": float(further)}
    return {"at": at, "head": head, **ways, **shares, "scale": names.scale, "bar": names.bar}


def _pair(value: Any) -> list[float]:
    return [float(np.real(value)), float(np.imag(value))]
