"""Gear pairs: wheels that mesh, planets on the wheel they roll on, pulleys where both turn the same way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil, floor, pi

import numpy as np

from linkanim.mechanics.linkage.pins import Crank
from linkanim.picture.figure import Figure

_TEETH = 48
"""Of about how many teeth two wheels of one size have together, if they turn slowly enough."""
_PASSING = 25 / 3
"""So many teeth pass in a second at the most: a third of a pitch from frame to frame, so that none seem
to turn back."""
_FEWEST = 9
_DWARFED = 2.0
"""A pair both of whose wheels have radii of more than so many cranks is drawn as pitch circles."""
TIP, FOOT = 0.85, 1.0
"""How far a tooth reaches beyond the pitch circle and the gap below it, in modules."""
_TOGETHER = 1e-9
"""How far pivots that have nothing between them to show are apart, as a share of the picture."""
_BELT = 0.3
"""The larger pulley's radius, as a share of the distance between the pivots."""


@dataclass(frozen=True)
class Wheel:
    """A wheel about a joint, its radius in the scene's unit; `teeth` is 0 for a pulley.

    It turns with the direction from its centre to the joint `arm`, or not at all without one. `tooth` is
    the angle of a tooth ahead of that direction, in radians, counter-clockwise. The teeth of a `ring`
    point inwards: `tooth` is then the angle of a gap. Of one that is but its `pitch` circle it is that of
    a mark.
    """

    centre: str
    arm: str | None
    radius: float
    teeth: int = 0
    tooth: float = 0.0
    ring: bool = False
    pitch: bool = False

    @property
    def reach(self) -> float:
        """How far it reaches from its middle, in the scene's unit: to its tips, or a ring's outer edge."""
        beyond = 7.0 if self.ring else 2 * TIP
        return self.radius * (1 + beyond / self.teeth) if self.teeth else self.radius


@dataclass(frozen=True)
class WheelPair:
    """Two wheels that roll on each other, or share a belt; a planet rolls on a wheel that stands still."""

    driver: Wheel
    driven: Wheel

    @property
    def wheels(self) -> tuple[Wheel, Wheel]:
        """Both of them, the one behind first."""
        return self.driver, self.driven

    @property
    def planetary(self) -> bool:
        """Whether the driven wheel goes round with an arm."""
        return self.driver.arm is None

    @property
    def belted(self) -> bool:
        """Whether the wheels are pulleys."""
        return not (self.driven.teeth or self.driven.pitch)


def pairs(figure: Figure) -> tuple[WheelPair, ...]:
    """Return the gear pairs with pivots apart, sized so that their pitch circles roll on each other.

    A crank that is geared to the one whose pin it turns on is a planet: what makes it turn as it does is
    a wheel about that crank's own pivot which stands still, a ring around it where it turns the other way.
    """
    cranks = {crank.name: crank for crank in figure.linkage.cranks}
    found = (_pair(figure, crank, cranks) for crank in cranks.values())
    return tuple(pair for pair in found if pair)


def _pair(figure: Figure, crank: Crank, cranks: dict[str, Crank]) -> WheelPair | None:
    gear = crank.gear
    if gear is None or gear.mate not in cranks:
        return None
    driver = cranks[gear.mate]
    fixed = figure.linkage.joint(driver.pivot).fixed
    if crank.pivot == driver.name and fixed:
        return _planet(figure, crank, driver)
    apart = figure.start(crank.pivot) - figure.start(driver.pivot)
    if not (fixed and figure.linkage.joint(crank.pivot).fixed) or abs(apart) <= _TOGETHER * figure.extent:
        return None
    if gear.ratio > 0:
        return _pulleys((driver, crank), abs(apart), float(gear.ratio))
    return _meshing(figure, (driver, crank), apart)


def _pulleys(cranks: tuple[Crank, Crank], apart: float, ratio: float) -> WheelPair:
    radii = _BELT * apart * min(ratio, 1), _BELT * apart * min(1 / ratio, 1)
    return WheelPair(*(Wheel(one.pivot, one.name, radius) for one, radius in zip(cranks, radii, strict=True)))


def _meshing(figure: Figure, cranks: tuple[Crank, Crank], apart: complex) -> WheelPair:
    """Return two wheels on fixed pivots that turn against each other."""
    driver, driven = cranks
    assert driven.gear is not None
    ratio = abs(driven.gear.ratio)
    radius = abs(apart) * float(ratio / (1 + ratio))
    second, contact = abs(apart) - radius, float(np.angle(apart))
    at, facing = contact - _angle(figure, driver), contact + pi - _angle(figure, driven)
    one = Wheel(driver.pivot, driver.name, radius, tooth=at, pitch=True)
    other = Wheel(driven.pivot, driven.name, second, tooth=facing, pitch=True)
    if radius > _DWARFED * driver.length and second > _DWARFED * driven.length:
        return WheelPair(one, other)
    some, others = _teeth(ratio.numerator, ratio.denominator, _turns(figure, driven))
    toothed = replace(other, teeth=others, tooth=facing + pi / others, pitch=False)
    return WheelPair(replace(one, teeth=some, pitch=False), toothed)


def _teeth(one: int, other: int, turns: float) -> tuple[int, int]:
    """Return the numbers of teeth of two wheels whose radii are as these, the other at `turns` a second."""
    many = min(_TEETH / (one + other), _PASSING / max(other * turns, 1e-9))
    many = max(ceil(_FEWEST / min(one, other)), floor(many))
    return many * one, many * other


def _planet(figure: Figure, planet: Crank, arm: Crank) -> WheelPair | None:
    """Return the still wheel and the planet that rolls on it: r and R of radius, the arm d long.

    Rolling on it makes the planet turn 1 - R/r times as often as its arm inside a ring, where R - r = d,
    and 1 + R/r times outside a sun, where R + r = d; a belt from it, 1 - R/r times.
    """
    assert planet.gear is not None
    ratio, long, inside = planet.gear.ratio, arm.length, planet.gear.ratio < 0
    if 0 < ratio <= 1:
        pulley = Wheel(planet.pivot, planet.name, _BELT * long)
        still = Wheel(arm.pivot, None, pulley.radius * float(1 - ratio))
        return WheelPair(still, pulley) if ratio < 1 else None
    contact, radius = _angle(figure, arm), long / abs(float(ratio))
    teeth, small = _teeth(abs(ratio.numerator - ratio.denominator), ratio.denominator, _turns(figure, planet))
    tooth = contact - _angle(figure, planet) + (0.0 if inside else pi + pi / small)
    large = long + radius if inside else long - radius
    rolling = Wheel(planet.pivot, planet.name, radius, small, tooth)
    return WheelPair(Wheel(arm.pivot, None, large, teeth, contact, ring=inside), rolling)


def _angle(figure: Figure, crank: Crank) -> float:
    return float(np.angle(figure.start(crank.name) - figure.start(crank.pivot)))


def teeth_a_second(figure: Figure) -> float:
    """Return how many teeth of the fastest wheel turn past a direction in a second at the scene's speed."""
    turned = (wheel for wheel in wheels(figure) if wheel.arm)
    cranks = {crank.name: crank for crank in figure.linkage.cranks}
    return max((wheel.teeth * _turns(figure, cranks[str(wheel.arm)]) for wheel in turned), default=0.0)


def _turns(figure: Figure, crank: Crank) -> float:
    """Return how many turns a second a crank makes where it is fastest, at the scene's speed."""
    arm = figure.cycle.position[crank.name] - figure.cycle.position[crank.pivot]
    turned = np.diff(np.unwrap(np.arctan2(arm[:, 1], arm[:, 0])))
    step = figure.scene.period / len(figure.cycle.phase)
    return float(np.nanmax(np.abs(turned))) / step * abs(figure.linkage.drive.speed) / (2 * pi)


def wheels(figure: Figure) -> Iterator[Wheel]:
    """Yield the wheels of all pairs."""
    for pair in pairs(figure):
        yield from pair.wheels
