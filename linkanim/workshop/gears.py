"""Gear wheels that keep a linkage's centre distances: which mesh, their teeth, their involute flanks."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import NamedTuple

from linkanim.errors import BadInput
from linkanim.mechanics.linkage import Crank, Linkage
from linkanim.workshop.shapes import Outline, straight

_PRESSURE = math.radians(20)
_FEWEST = 18
"""The fewest teeth, so that none is undercut: 2/sin² 20° = 17.1 (ISO 21771)."""
_FEWEST_INSIDE = 34
"""The fewest teeth of a ring, so that its teeth end outside its base circle."""
_FEWER = 10
"""The least difference of teeth between a ring and a wheel in it, so that their teeth do not collide."""
_TIP, _FOOT = 0.9, 1.15
"""How far a tooth reaches beyond the pitch circle, and a gap within it, in modules."""
_SMALLEST = 0.6
"""The least module in mm: smaller teeth cannot be cut."""
_FLANK = 8
"""The straight steps of a flank of module 1, which are then within 0.004 mm of it."""


class NotFlat(BadInput):
    """A linkage that cannot be made of flat parts, whatever their sizes."""


class GearWheel(NamedTuple):
    """A wheel about the joint `centre` that turns with the line from there to `arm`, or stands still (None).

    `tooth` is the angle of a tooth from that line, or of a ring's gap (radians); `module` is in mm.
    """

    centre: str
    arm: str | None
    teeth: int
    module: float
    tooth: float
    ring: bool = False

    @property
    def radius(self) -> float:
        """The pitch circle's radius."""
        return self.module * self.teeth / 2

    @property
    def tip(self) -> float:
        """The radius to which teeth reach: outwards, or for a ring inwards."""
        return self.radius + (-_TIP if self.ring else _TIP) * self.module

    @property
    def root(self) -> float:
        """The radius of the gaps' bottom."""
        return self.radius + (_FOOT if self.ring else -_FOOT) * self.module

    def outline(self, play: float, grown: float) -> Outline:
        """Return the teeth about the centre: a wheel's outer edge, a ring's inner one.

        Flanks are involutes of the base circle, each set back by `play` (mm); the whole is `grown` by half a
        cut's width. Half the angle of a tooth at a radius is pi/2z + inv(20 deg) - inv(angle there), with inv
        a = tan a - a (ISO 21771); setting a flank back by s turns it by s over the base radius. Below the
        base circle a flank is radial. A ring's gaps have the shape of such teeth.
        """
        out = -1.0 if self.ring else 1.0
        base, set_back = self.radius * math.cos(_PRESSURE), (grown - play) * out
        ends = sorted((self.root + grown * out, self.tip + grown * out))
        flank, steps = [], math.ceil(_FLANK * math.sqrt(self.module))
        for n in range(steps + 1):
            radius = ends[0] + (ends[1] - ends[0]) * n / steps
            there = math.acos(min(base / radius, 1.0))
            half = math.pi / (2 * self.teeth) + _involute(_PRESSURE) - _involute(there) + set_back / base
            flank.append((radius, max(half, 0.0)))
        side = [*((r, -half) for r, half in flank), *((r, half) for r, half in flank[::-1])]
        pitch = math.tau / self.teeth
        turns = [self.tooth + n * pitch for n in range(self.teeth)]
        return straight(cmath.rect(radius, turn + half) for turn in turns for radius, half in side)


Mesh = tuple[GearWheel, GearWheel]
"""Two wheels that roll on each other; the first one stands still where the second is a planet."""


def meshes(linkage: Linkage, scale: float, module: float) -> Iterator[Mesh]:
    """Yield a linkage's gear pairs; `scale` is mm per unit of length, `module` the wanted module in mm.

    NotFlat, with the reason, for pairs that two wheels cannot form; BadInput for teeth that are too small.
    """
    cranks = {crank.name: crank for crank in linkage.cranks}
    for crank in cranks.values():
        if crank.gear is not None and not crank.gear.motor:
            driver = cranks[crank.gear.mate]
            yield (
                _planet(linkage, crank, driver, scale, module)
                if crank.pivot == driver.name
                else _spur(linkage, crank, driver, scale, module)
            )


def _spur(linkage: Linkage, crank: Crank, driver: Crank, scale: float, module: float) -> Mesh:
    assert crank.gear is not None
    ratio = crank.gear.ratio
    if not (linkage.joint(crank.pivot).fixed and linkage.joint(driver.pivot).fixed):
        raise NotFlat(
            f"the gear pair {driver.name}, {crank.name} has a pivot that moves; only pairs on two fixed pins "
            "and planets on the crank that they are geared to become wheels"
        )
    if ratio > 0:
        raise NotFlat(
            f"the cranks {driver.name} and {crank.name} turn the same way, which two wheels do not; take "
            f"a ratio below 0, such as {-ratio}"
        )
    pins = linkage.pin(driver.pivot).position, linkage.pin(crank.pivot).position
    apart = complex(*pins[1]) - complex(*pins[0])
    if abs(apart) <= 1e-9 * linkage.longest:
        raise NotFlat(f"the gear pair {driver.name}, {crank.name} has both wheels on one pin")
    teeth, size = _teeth((abs(ratio).numerator, ratio.denominator), scale * abs(apart), module, ring=False)
    angle = cmath.phase(apart)
    # A tooth of the first wheel points along its crank; where it meets the second, that has a gap.
    tooth = angle + math.pi + math.pi / teeth[1] - float(ratio) * angle - crank.gear.offset
    return (
        GearWheel(driver.pivot, driver.name, teeth[0], size, 0.0),
        GearWheel(crank.pivot, crank.name, teeth[1], size, tooth),
    )


def _planet(linkage: Linkage, crank: Crank, arm: Crank, scale: float, module: float) -> Mesh:
    """Return the wheel that stands still and the planet that rolls on it.

    Inside a ring of radius R, with an arm R - r, the planet turns 1 - R/r times as often as its arm; on a
    wheel, with an arm R + r, 1 + R/r times.
    """
    assert crank.gear is not None
    ratio = crank.gear.ratio
    if not linkage.joint(arm.pivot).fixed:
        raise NotFlat(
            f"the planet {crank.name} goes round a pin that moves; only one round a fixed pin rolls"
        )
    if 0 <= ratio <= 1:
        raise NotFlat(
            f"the planet {crank.name} turns {ratio} times as often as its arm, which takes a belt or a third "
            "wheel; two wheels make ratios below 0 (in a ring) and above 1 (on a wheel)"
        )
    ring, large = ratio < 0, abs(1 - ratio)
    teeth, size = _teeth((large.numerator, large.denominator), scale * arm.length, module, ring=ring)
    tooth = -crank.gear.offset + (0.0 if ring else math.pi + math.pi / teeth[1])
    still = GearWheel(arm.pivot, None, teeth[0], size, 0.0, ring=ring)
    return still, GearWheel(crank.pivot, crank.name, teeth[1], size, tooth)


def _teeth(
    shares: tuple[int, int], apart: float, module: float, *, ring: bool
) -> tuple[tuple[int, int], float]:
    """Return the numbers of teeth in proportion to two shares, and the module that keeps the distance."""
    one, other = shares
    span = one - other if ring else one + other
    fewest = [math.ceil(_FEWEST / min(one, other)), round(2 * apart / (module * span))]
    if ring:
        fewest += [math.ceil(_FEWEST_INSIDE / one), math.ceil(_FEWER / span)]
    many = max(fewest)
    size = 2 * apart / (many * span)
    if size < _SMALLEST:
        raise BadInput(
            f"wheels of {many * one} and {many * other} teeth {apart:g} mm apart have teeth of module "
            f"{size:.2g} mm, too small to cut; make it larger (--fit)"
        )
    return (many * one, many * other), size


def _involute(angle: float) -> float:
    return math.tan(angle) - angle
