"""Fixed pins: joints of the ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from linkanim.mechanics.formulas.planar import MovingPoint, Vec
from linkanim.mechanics.linkage.joint import Frame, Joint, Point

if TYPE_CHECKING:
    from linkanim.mechanics.closing.walk import Walk


@dataclass(frozen=True, slots=True)
class Polar:
    """Where a fixed pin lies as it was written: `length` at `angle` from `base`.

    `base` names a fixed pin; None is the origin of coordinates. Kept because a length that is
    read back from coordinates is rounded, and a change point depends on its last bit.
    """

    length: float
    angle: float
    base: str | None = None


@dataclass(frozen=True, slots=True)
class Pin(Joint):
    """A fixed pin on the ground."""

    position: Point
    polar: Polar | None = None

    fixed: ClassVar[bool] = True

    @property
    def lengths(self) -> tuple[float, ...]:
        """Its coordinates."""
        return self.position

    def scaled(self, factor: float) -> Pin:
        """Return the pin with its coordinates, and its length as written, times a factor."""
        polar = self.polar and Polar(self.polar.length * factor, self.polar.angle, self.polar.base)
        return Pin(self.name, (self.position[0] * factor, self.position[1] * factor), polar)

    def close(self, walk: Walk) -> None:
        """Put the pin where it stands."""
        walk.points[self.name] = MovingPoint(Vec(*self.position))

    def placed(self, frames: tuple[Frame, ...]) -> tuple[Frame, ...]:
        """Return the frames with the pin on the ground."""
        return ({**frames[0], self.name: complex(*self.position)}, *frames[1:])
