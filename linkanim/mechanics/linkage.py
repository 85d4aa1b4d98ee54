"""What a linkage is: frozen values, lengths in the scene's unit, angles in radians, y up.

Joints stand in the order in which they can be solved: each one names only joints before it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

Point = tuple[float, float]


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
class Pin:
    """A fixed pin on the ground."""

    name: str
    position: Point
    polar: Polar | None = None


@dataclass(frozen=True, slots=True)
class Gear:
    """A gear pair: angle = ratio × (angle of the crank `driver`) + offset."""

    driver: str
    ratio: Fraction
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Crank:
    """A pin that turns about the fixed pin `pivot`; geared to another crank, or the input."""

    name: str
    pivot: str
    length: float
    gear: Gear | None = None


@dataclass(frozen=True, slots=True)
class RRR:
    """Two bars that meet in a pin: `lengths[i]` from `ends[i]`.

    `side` is +1 where the pin lies left of the line from `ends[0]` to `ends[1]`, -1 right.
    With `side_of = (b, p, q)` it says instead on which side of p -> q the joint b lies just
    after the start of the drive (a four-bar driven at its rocker is named that way).
    """

    name: str
    ends: tuple[str, str]
    lengths: tuple[float, float]
    side: int = 1
    side_of: tuple[str, str, str] | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """A fixed line of travel: through a fixed pin, at `angle`, shifted by `offset` to its left."""

    through: str
    angle: float
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class RRP:
    """A bar from `end` to a slider on `line`; `side` +1 is the closure further forward, -1 back."""

    name: str
    end: str
    length: float
    line: Line
    side: int = 1


@dataclass(frozen=True, slots=True)
class RPR:
    """A bar that turns about the fixed pin `pivot`, its slot passing through the joint `through`.

    through = pivot + s·u + offset·n with s > 0, u the bar's direction and n to its left;
    the joint itself is pivot + length·u.
    """

    name: str
    pivot: str
    through: str
    length: float
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Rigid:
    """A point of a body: `at` = (along `on[0]` -> `on[1]`, to the left of it) from `on[0]`."""

    name: str
    on: tuple[str, str]
    at: Point


Joint = Pin | Crank | RRR | RRP | RPR | Rigid


@dataclass(frozen=True, slots=True)
class Body:
    """A named body: its angle is that of first -> second joint; `com` is its centre of mass.

    `com` is (along first -> second joint, to the left of it) from the first joint. A body with
    `slider` instead of joints is the block that travels with that joint along its line.
    """

    name: str
    joints: tuple[str, ...] = ()
    com: Point | None = None
    slider: str | None = None


@dataclass(frozen=True, slots=True)
class Spring:
    """A spring between two joints; `stiffness` in N/m, `free_length` in the scene's unit.

    Both are None where the force is not known.
    """

    name: str
    between: tuple[str, str]
    stiffness: float | None = None
    free_length: float | None = None

    @property
    def forceful(self) -> bool:
        """Whether its force is known."""
        return self.stiffness is not None and self.free_length is not None


@dataclass(frozen=True, slots=True)
class Damper:
    """A damper between two joints; `coefficient` in N·s/m, None where the force is not known."""

    name: str
    between: tuple[str, str]
    coefficient: float | None = None

    @property
    def forceful(self) -> bool:
        """Whether its force is known."""
        return self.coefficient is not None


@dataclass(frozen=True, slots=True)
class Drive:
    """What turns the linkage: the input crank, its speed (rad/s, negative clockwise) and start (rad)."""

    joint: str
    speed: float
    start: float = 0.0


@dataclass(frozen=True)
class Linkage:
    """A planar linkage with one input."""

    joints: tuple[Joint, ...]
    drive: Drive
    bodies: tuple[Body, ...] = ()
    springs: tuple[Spring, ...] = ()
    dampers: tuple[Damper, ...] = ()
    metre: float = field(default=1.0)
    """One unit of length in metres (0.001 for mm); forces need it."""

    def joint(self, name: str) -> Joint:
        """Return the joint of that name; KeyError where there is none."""
        return self.by_name[name]

    @property
    def by_name(self) -> dict[str, Joint]:
        """Map each joint's name to the joint."""
        return {joint.name: joint for joint in self.joints}

    @property
    def cranks(self) -> Iterator[Crank]:
        """The cranks in the order of the joints, the input among them."""
        return (joint for joint in self.joints if isinstance(joint, Crank))
