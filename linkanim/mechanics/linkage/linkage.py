"""What a linkage is: frozen values, lengths in the scene's unit, angles in radians, y up.

Joints stand in the order in which they can be solved: each one names only joints before it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

from linkanim.mechanics.linkage.drive import Drive
from linkanim.mechanics.linkage.joint import Joint, Point, RigidBody, Stated
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import holding, rigid_bodies
from linkanim.units import unit_of


@dataclass(frozen=True, slots=True)
class Body(Stated):
    """A named body: its angle is that of first -> second joint; `com` is its centre of mass.

    `com` is (along first -> second joint, to the left of it) from the first joint. A body with
    `slider` instead of joints is the block that travels with that joint along its line. `mass` is in kg,
    `inertia` in kg·m² about the centre of mass; what is None is left out of all forces.
    """

    name: str
    joints: tuple[str, ...] = ()
    com: Point | None = None
    slider: str | None = None
    mass: float | None = None
    inertia: float | None = None

    sized: ClassVar[tuple[str, ...]] = ("com",)

    @property
    def forceful(self) -> bool:
        """Whether it takes a force to move it."""
        return self.mass is not None or self.inertia is not None


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


@dataclass(frozen=True)
class Linkage(Stated):
    """A planar linkage with one input."""

    joints: tuple[Joint, ...]
    drive: Drive
    bodies: tuple[Body, ...] = ()
    springs: tuple[Spring, ...] = ()
    dampers: tuple[Damper, ...] = ()
    metre: float = field(default=1.0)
    """One unit of length in metres (0.001 for mm); forces need it."""
    gravity: float = 0.0
    """How fast masses fall, in m/s², down; 0 where nothing is said of it."""

    sized: ClassVar[tuple[str, ...]] = ("joints", "bodies", "drive")

    @property
    def unit(self) -> str:
        """The unit of its lengths, as in sentences."""
        return unit_of(self.metre)

    @property
    def forceful(self) -> bool:
        """Whether the input has to drive anything: a spring or damper of known force, or a mass."""
        struts = self.springs + self.dampers
        return any(strut.forceful for strut in struts) or any(body.forceful for body in self.bodies)

    @staticmethod
    def strut_word(strut: Spring | Damper) -> str:
        """Return what a strut is called: a damper of which no force is known is a cylinder."""
        if isinstance(strut, Spring):
            return "spring"
        return "damper" if strut.forceful else "cylinder"

    def strut_words(self, strut: Spring | Damper) -> str:
        """Return what a strut is called with its name: "return spring"; a name that says it stands alone."""
        word = self.strut_word(strut)
        return strut.name if word in strut.name.lower().split() else f"{strut.name} {word}"

    def joint(self, name: str) -> Joint:
        """Return the joint of that name; KeyError where there is none."""
        return self.by_name[name]

    def pin(self, name: str) -> Pin:
        """Return the fixed pin of that name, which must be one."""
        joint = self.by_name[name]
        assert isinstance(joint, Pin)
        return joint

    def crank(self, name: str) -> Crank:
        """Return the crank whose pin has that name, which must be one."""
        joint = self.by_name[name]
        assert isinstance(joint, Crank)
        return joint

    @property
    def longest(self) -> float:
        """The longest length that the definition of a joint states; without any that of the drive, or 1."""
        stated = max((abs(length) for joint in self.joints for length in joint.lengths), default=0.0)
        return stated or max(map(abs, self.drive.actuator.lengths), default=0.0) or 1.0

    @cached_property
    def extent(self) -> float:
        """How far from the origin any joint may come: all lengths together; 1 without any."""
        return math.fsum(map(abs, self.lengths)) or 1.0

    @cached_property
    def by_name(self) -> dict[str, Joint]:
        """Map each joint's name to the joint."""
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def unsized(self) -> Linkage:
        """The linkage with every length 0: what those have in common that differ in lengths alone."""
        return self.scaled(0.0)

    @cached_property
    def rigid_bodies(self) -> tuple[RigidBody, ...]:
        """The rigid bodies, the ground first: where each one's joints lie in its own frame."""
        return rigid_bodies(self.joints)

    @cached_property
    def radii(self) -> dict[str, float]:
        """How far each joint is from the fixed pin that it turns about; infinite where its line is fixed."""
        found = {slide.point: math.inf for joint in self.joints for slide in joint.slides if not slide.start}
        for frame in self.rigid_bodies[1:]:
            if (pivot := self.pivot(frame)) is not None:
                found |= {name: abs(place - frame[pivot]) for name, place in frame.items() if name != pivot}
        return {name: radius for name, radius in found.items() if radius}

    def pivot(self, names: Iterable[str]) -> str | None:
        """Return the fixed pin about which a rigid body turns that has joints; None of others, and of two."""
        n = holding(self.rigid_bodies, names)
        pins = [pin.name for pin in self.pins if n and pin.name in self.rigid_bodies[n]]
        return pins[0] if len(pins) == 1 else None

    @property
    def cranks(self) -> Iterator[Crank]:
        """The cranks in the order of the joints, the input among them."""
        return (joint for joint in self.joints if isinstance(joint, Crank))

    def crank_of(self, body: Body) -> Crank | None:
        """Return the crank whose bar a body is: of the input, or of one geared to it; None of others."""
        ends = set(body.joints[:2])
        return next((crank for crank in self.cranks if ends == {crank.pivot, crank.name}), None)

    @property
    def pins(self) -> Iterator[Pin]:
        """The fixed pins in the order of the joints."""
        return (joint for joint in self.joints if isinstance(joint, Pin))
