"""Joints that are given, not closed: fixed pins, crank pins, the slider that drives."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar

from linkanim.mechanics.linkage.joint import Guided, Joint, Line, Point, RigidBody, Stated


@dataclass(frozen=True, slots=True)
class Polar(Stated):
    """Where a fixed pin lies as it was written: `length` at `angle` from `base`.

    `base` names a fixed pin; None is the origin of coordinates. Kept because a length that is
    read back from coordinates is rounded, and a change point depends on its last bit.
    """

    length: float
    angle: float
    base: str | None = None

    sized: ClassVar[tuple[str, ...]] = ("length",)


@dataclass(frozen=True, slots=True)
class Pin(Joint):
    """A fixed pin on the ground."""

    position: Point
    polar: Polar | None = None

    fixed: ClassVar[bool] = True
    sized: ClassVar[tuple[str, ...]] = ("position", "polar")

    @property
    def lengths(self) -> tuple[float, ...]:
        """Its coordinates."""
        return self.position

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the bodies with the pin on the ground."""
        return ({**bodies[0], self.name: complex(*self.position)}, *bodies[1:])


@dataclass(frozen=True, slots=True)
class Gear:
    """A gear pair: angle = ratio × (angle of the crank `mate`) + offset."""

    mate: str
    ratio: Fraction
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Crank(Joint):
    """A pin that turns about the fixed pin `pivot`: the input; or about any joint, geared to another crank.

    The angle of a geared crank is absolute, also of one whose pivot moves: a planet.
    """

    pivot: str
    length: float
    gear: Gear | None = None

    sized: ClassVar[tuple[str, ...]] = ("length",)

    @property
    def needs(self) -> tuple[str, ...]:
        """Its pivot, and the crank that it is geared to."""
        return (self.pivot, self.gear.mate) if self.gear else (self.pivot,)

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """The crank."""
        return ((self.pivot, self.length),)


@dataclass(frozen=True, slots=True)
class DrivenSlider(Guided):
    """A slider on the fixed `line`; the drive gives its travel, from the joint that the line runs through."""

    line: Line

    sized: ClassVar[tuple[str, ...]] = ("line",)
