"""Rigid bodies: which joints keep their distances, where they lie in the body's own frame, and its points.

Points of a body, beside its pins, are coupler points, third pins of a plate, corners of a rigid triangle.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import ClassVar

from linkanim.mechanics.linkage.dyads import RRR
from linkanim.mechanics.linkage.joint import Joint, Point, RigidBody

_ONE_POINT = 1e-12


def rigid_bodies(joints: Iterable[Joint]) -> tuple[RigidBody, ...]:
    """Return the sets of joints that keep their distances, the ground first; joints in solved order.

    Each maps its joints to their places: x along its first bar, y to the left. Every bar starts a frame
    of its own, in the order of the joints and of each joint's `bars`.
    """
    ground: tuple[RigidBody, ...] = ({},)
    return reduce(lambda bodies, joint: joint.placed(bodies), joints, ground)


def holding(bodies: Iterable[RigidBody], names: Iterable[str]) -> int | None:
    """Return which frame has all these joints; None where they are on different bodies."""
    joints = set(names)
    return next((n for n, frame in enumerate(bodies) if joints <= frame.keys()), None)


def coincide(frame: RigidBody, first: str, second: str) -> bool:
    """Tell whether two joints of a body are one point, so that no direction runs from one to the other."""
    size = max(abs(frame[first]), abs(frame[second]))
    return abs(frame[first] - frame[second]) <= _ONE_POINT * size


def share_of(frame: RigidBody, on: tuple[str, str], at: tuple[float, float]) -> complex:
    """Return the point `at` along on[0] -> on[1] and to its left, in lengths of that line."""
    return complex(*at) / abs(frame[on[1]] - frame[on[0]])


@dataclass(frozen=True, slots=True)
class Rigid(Joint):
    """A point of a body: `at` = (along `on[0]` -> `on[1]`, to the left of it) from `on[0]`."""

    on: tuple[str, str]
    at: Point

    sized: ClassVar[tuple[str, ...]] = ("at",)

    @property
    def needs(self) -> tuple[str, ...]:
        """The two joints that its body is known by."""
        return self.on

    @property
    def body(self) -> tuple[str, ...]:
        """The two joints that its body is known by."""
        return self.on

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """The plate of the three joints."""
        return ((*self.on, self.name),)

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the bodies with the point on its body; as they are where the two joints show none."""
        n = holding(bodies, self.on)
        if n is None or coincide(bodies[n], *self.on):
            return bodies
        start, end = (bodies[n][name] for name in self.on)
        place = start + (end - start) * share_of(bodies[n], self.on, self.at)
        return (*bodies[:n], {**bodies[n], self.name: place}, *bodies[n + 1 :])


@dataclass(frozen=True, slots=True)
class Brace(Rigid):
    """A point of a body stated by its distances from two joints of it: a corner of a rigid triangle."""

    reach: tuple[float, float]

    sized: ClassVar[tuple[str, ...]] = ("at", "reach")

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """Its two bars."""
        return (self.on[0], self.reach[0]), (self.on[1], self.reach[1])

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """Its two bars; the body may show them otherwise."""
        return tuple((start, self.name) for start in self.on)


def brace(dyad: RRR, frame: RigidBody) -> Brace:
    """Return two bars that stand on one body as the corner of a rigid triangle.

    With c from the first end to the second, the corner lies (c² + a² - b²)/(2c) along it and
    √(((a + b)² - c²)(c² - (a - b)²))/(2c) beside it, each rounded once; bars in one line have no height.
    """
    a, b, c = map(Fraction, (*dyad.lengths, abs(frame[dyad.ends[1]] - frame[dyad.ends[0]])))
    along = (c * c + a * a - b * b) / (2 * c)
    height = ((a + b) ** 2 - c * c) * (c * c - (a - b) ** 2) / (4 * c**4)
    beside = math.copysign(math.sqrt(max(height, Fraction(0))) * float(c), dyad.side)
    return Brace(dyad.name, dyad.ends, (float(along), beside), dyad.lengths)
