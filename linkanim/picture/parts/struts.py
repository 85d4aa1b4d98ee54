"""Springs, whose pitch follows their length, and dampers, whose piston slides."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import pi
from typing import NamedTuple

import numpy as np

from linkanim.mechanics.linkage.linkage import Damper, Spring
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster.directions import directions, length, lengths
from linkanim.picture.raster.parts import Places
from linkanim.picture.raster.raster import Layer, Loop, Outlines
from linkanim.picture.raster.shapes import box, cut_ribbon, offsets, ribbon, rod, stroke, unit
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

_COILS = (4, 20)
"""Of how few and how many coils a spring has, as its shortest length allows."""
TILT = 0.15
"""How far a coil's front stands forward of its side, as a share of its radius."""
BACK, EDGE, CORE = 1.9, 2.6, 1.5
"""How wide far halves are drawn, and near ones with and without their outline, in widths of the wire."""
_WOUND = 8.5
"""From coil to coil where a spring is shortest, in widths of a thin line."""
_CYLINDER = 0.6
"""How long a cylinder that holds or drives is at the least, in lengths of it drawn in."""
_BARREL = 0.95
"""The half width of a damper's or cylinder's barrel, in half widths of a bar."""


class StrutSpan(NamedTuple):
    """The shortest and the longest distance between two joints over a cycle, in pixels."""

    shortest: float
    longest: float


def reach(figure: Figure, view: View, item: Spring | Damper) -> StrutSpan:
    """Return how short and how long a spring or damper becomes."""
    one, other = (figure.path(name, view) for name in item.between)
    apart = lengths(one - other)
    return StrutSpan(float(np.nanmin(apart)), float(np.nanmax(apart)))


@dataclass(frozen=True)
class Coil:
    """A spring to draw: its radius and the straight length at either end in pixels, its coils."""

    between: tuple[str, str]
    radius: float
    lead: float
    coils: int
    gauge: Gauge
    theme: Theme

    def layers(self, places: Places) -> list[Layer]:
        """Return the far halves of the coils, then the near ones over them."""
        start, end = (places[name] for name in self.between)
        span, turn = length(end - start), unit(end - start)
        lead = min(self.lead, 0.2 * span)
        pitch = (span - 2 * lead) / self.coils
        feet = np.asarray(start + turn * (lead + pitch * np.arange(self.coils)), np.complex128)
        wire = self.wire
        along, round_ = self._halves
        halves = turn * (pitch * along + round_)
        far, near = zip(halves, offsets(halves), strict=True)
        # the near halves' outlines hide where the far ones end
        shade = mixed(self.theme.metal, self.theme.background, 0.3)
        layers = [Layer(shade, [cut_ribbon(*far, BACK * wire)]).repeated(feet)]
        for colour, width in ((self.theme.outline, EDGE * wire), (self.theme.metal, CORE * wire)):
            (one, other), coil = _leads(lead, self.radius, width), ribbon(*near, width)
            points = start + turn * one, end + turn * other, np.add.outer(feet, coil).ravel()
            counts = len(one), len(other), *[len(coil)] * self.coils
            layers.append(Layer(colour, Outlines(np.concatenate(points), counts)))
        return layers

    @property
    def wire(self) -> float:
        """How wide its wire is reckoned, in pixels."""
        return 1.5 * self.gauge.line

    @cached_property
    def _halves(self) -> tuple[Loop, Loop]:
        """A coil's far half and its near one, the spring along the real axis: along it, and about it."""
        along = np.add.outer([0.5, 0.0], np.linspace(0, 0.5, 13))
        way = directions(2 * pi * along - pi / 2)
        about = self.radius * (TILT * way.real + 1j * way.imag)
        return along.astype(np.complex128), about.astype(np.complex128)


@lru_cache(maxsize=16)
def _leads(lead: float, radius: float, width: float) -> tuple[Loop, Loop]:
    """Return a spring's wire at its start and at its end, each about 0, the spring along the real axis."""
    share = np.linspace(0.0, 1.0, 13)
    rise = share * share * (3 - 2 * share)
    (first,) = stroke(lead * share - 1j * radius * rise, width)
    return first, -first.conj()[::-1]


@dataclass(frozen=True)
class Damping:
    """A damper to draw: how far it reaches, its cylinder's length and where that begins, in pixels.

    `cylinder` lies along the real axis from its closed end at 0, `head` about 0.
    """

    between: tuple[str, str]
    reach: StrutSpan
    length: float
    foot: float
    rod: float
    cylinder: tuple[Layer, Layer]
    head: Layer

    def layers(self, places: Places) -> list[Layer]:
        """Return cylinder, rods and piston; the piston stands deeper the shorter the damper is."""
        start, end = (places[name] for name in self.between)
        span, turn = length(end - start), unit(end - start)
        piston = self.foot + self._piston(span)
        rods = [rod(piston, max(span, piston), self.rod / 2), rod(0.0, self.foot, self.rod / 2)]
        return [
            *(layer.placed(start + turn * self.foot, turn) for layer in self.cylinder),
            Layer(self.cylinder[0].colour, rods).placed(start, turn),
            self.head.placed(start + turn * piston, turn),
        ]

    def _piston(self, span: float) -> float:
        """Return where in the cylinder the piston stands, in pixels from its closed end."""
        swept = self.reach.longest - self.reach.shortest
        share = (span - self.reach.shortest) / swept if swept > 0 else 0.5
        return self.length * (0.16 + 0.68 * min(max(share, 0.0), 1.0))


def coils(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Coil, ...]:
    """Return the scene's springs."""
    lead, found = 1.5 * gauge.bar, []
    for item in figure.linkage.springs:
        room = reach(figure, view, item).shortest - 2 * lead
        count = min(max(int(room / (_WOUND * gauge.line)), _COILS[0]), _COILS[1])
        found.append(Coil(item.between, 1.15 * gauge.bar, lead, count, gauge, theme))
    return tuple(found)


def dampings(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Damping, ...]:
    """Return the scene's dampers and driving cylinder, each as long as its stroke needs, if there is room."""
    found = []
    for item in figure.cylinders:
        span = reach(figure, view, item)
        needed = (span.longest - span.shortest) / 0.68
        least = 5 * gauge.bar if item.forceful else max(5 * gauge.bar, _CYLINDER * span.shortest)
        length = min(max(needed, least), max(0.8 * span.shortest, 2 * gauge.bar))
        foot = max(0.5 * (span.shortest - length), 0.0) * 0.6
        found.append(damping(item.between, span, (length, foot), gauge, theme))
    return tuple(found)


def damping(
    between: tuple[str, str], span: StrutSpan, size: tuple[float, float], gauge: Gauge, theme: Theme
) -> Damping:
    """Return a damper whose cylinder has a length and begins so far from the first joint, in pixels."""
    (length, foot), radius = size, _BARREL * gauge.bar
    cylinder = barrel(0.0, length, radius, gauge, theme)
    head = piston(0.16 * length, radius, gauge, theme)
    return Damping(between, span, length, foot, 2.4 * gauge.line, cylinder, head)


def barrel(near: float, far: float, radius: float, gauge: Gauge, theme: Theme) -> tuple[Layer, Layer]:
    """Return a cylinder along the real axis: its wall, and its inside."""
    length, middle, edge = far - near, (near + far) / 2, gauge.outline
    wall = box(length, 2 * radius, 0.25 * radius) + middle
    inside = box(length - 2 * edge, 2 * (radius - edge), 0.2 * radius) + middle
    hollow = mixed(theme.metal, theme.background, 0.72)
    return Layer(theme.outline, [wall]), Layer(hollow, [inside])


def piston(length: float, radius: float, gauge: Gauge, theme: Theme) -> Layer:
    """Return the piston about 0 that fits into a cylinder along the real axis."""
    return Layer(theme.metal, [box(length, 2 * radius - 3 * gauge.outline, 0.1 * radius)])
