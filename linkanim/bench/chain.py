"""What every method is asked: the poses of a linkage along a sequence of inputs, as plain steps."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.scene import Scene

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Places = Mapping[str, Any]
"""Of each joint where it lies: complex numbers, one or an array; NaN where a method has no answer."""
Orders = tuple[Places, ...]
"""Positions, then velocities and accelerations where a method gives them."""
TURN = 2 * math.pi


class TurnStep(NamedTuple):
    """A crank pin: its angle is `ratio` times the input's, and `offset`."""

    name: str
    pivot: str
    length: float
    ratio: float = 1.0
    offset: float = 0.0


class SlideStep(NamedTuple):
    """A bar to a slider on a line through `base`; of two places the one further along it for side +1."""

    name: str
    end: str
    length: float
    base: complex
    along: complex
    side: int


class FixedStep(NamedTuple):
    """A point of a body: `at` along the way of this length from first to second joint, and to its left."""

    name: str
    on: tuple[str, str]
    at: complex
    length: float


Step = TurnStep | RRR | SlideStep | FixedStep
Dyad = RRR | SlideStep
Closing = Callable[[Dyad, Places], Any]
"""Gives where a dyad's joint lies, from the places before it."""


class DyadChain(NamedTuple):
    """Pins on the ground, and the steps in the order in which they can be taken."""

    pins: Mapping[str, complex]
    steps: tuple[Step, ...]

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """The steps that have two closures."""
        return tuple(step for step in self.steps if isinstance(step, RRR | SlideStep))


def chain_of(linkage: Linkage) -> DyadChain:
    """Return a linkage of pins, cranks, two kinds of dyads on fixed lines, and points of bodies as steps."""
    lengths = {frozenset((end, joint.name)): length for joint in linkage.joints for end, length in joint.bars}
    pins: dict[str, complex] = {}
    steps: list[Step] = []
    for joint in linkage.joints:
        match joint:
            case Pin():
                pins[joint.name] = complex(*joint.position)
            case Crank():
                gear = (float(joint.gear.ratio), joint.gear.offset) if joint.gear else (1.0, 0.0)
                steps.append(TurnStep(joint.name, joint.pivot, joint.length, *gear))
            case RRR():
                steps.append(joint)
            case RRP():
                along = cmath.rect(1.0, joint.line.angle)
                base = pins[joint.line.through] + 1j * along * joint.line.offset
                steps.append(SlideStep(joint.name, joint.end, joint.length, base, along, joint.side))
            case Rigid():
                length = lengths[frozenset(joint.on)]
                steps.append(FixedStep(joint.name, joint.on, complex(*joint.at), length))
    return DyadChain(pins, tuple(steps))


@dataclass(frozen=True)
class Question:
    """A scene, its chain, and a sequence of inputs.

    `angles` are the input's; `phases` the drive's, for methods that take one: a turning input's are its
    angles. `rates` are the angle's first and second derivative in what rates are asked for, which is the
    phase, where `by_angle` the angle. `sides` is the closure of each dyad that a caller names at each pose:
    one who names a constant closure gets it; where the input swings the way back is asked for on the other
    one. `start` is the first pose, for methods that go on from the previous one. `shown` are the joints
    that count, `longest` is the longest link, `periods` the turns after which the motion is back.
    """

    scene: Scene
    chain: DyadChain
    angles: Floats
    phases: Floats
    rates: tuple[Floats, Floats]
    sides: Mapping[str, Floats]
    start: Mapping[str, complex]
    shown: tuple[str, ...]
    longest: float
    periods: int = 1
    by_angle: bool = False


def longest_of(linkage: Linkage) -> float:
    """Return the longest link, the ground between two pins included."""
    pins = [complex(*pin.position) for pin in linkage.pins]
    grounds = (abs(one - other) for one in pins for other in pins)
    return max(*(length for joint in linkage.joints for _, length in joint.bars), *grounds)


def placed(
    chain: DyadChain, angle: Any, close: Closing, exp: Callable[[Any], Any] = np.exp
) -> dict[str, Any]:
    """Return where the joints lie at an input's angle, dyads' as `close` gives them.

    `exp` is that of the numbers: arrays of complex ones, single ones, or those of many digits.
    """
    at: dict[str, Any] = dict(chain.pins)
    for step in chain.steps:
        if isinstance(step, TurnStep):
            at[step.name] = at[step.pivot] + step.length * exp(1j * (step.ratio * angle + step.offset))
        else:
            at[step.name] = point_on(step, at) if isinstance(step, FixedStep) else close(step, at)
    return at


def point_on(step: FixedStep, at: Places) -> Any:
    """Return a point of a body by those of its first and second joint, or a derivative of it by theirs."""
    first, second = (at[name] for name in step.on)
    return first + (second - first) * (step.at / step.length)


def circle_dyad(dyad: Dyad, at: Places, side: Any, root: Callable[[Any], Any] = np.sqrt) -> Any:
    """Go along the line of centres, then √(r² - x²) to the side; a circle and a line likewise.

    Paul Bourke, Circles and spheres (1997). `root` is that of the numbers.
    """
    if isinstance(dyad, RRR):
        p, q = (at[end] for end in dyad.ends)
        (a, b), way = dyad.lengths, q - p
        distance = abs(way)
        along = (a**2 - b**2 + distance * distance) / (2 * distance)
        return p + way / distance * (along + 1j * (side * root(a**2 - along * along)))
    seen = (at[dyad.end] - dyad.base) * dyad.along.conjugate()
    return dyad.base + dyad.along * (seen.real + side * root(dyad.length**2 - seen.imag**2))


def joined(vectors: Floats) -> Complexes:
    """Return vectors (..., 2) as complex numbers."""
    numbers: Complexes = vectors[..., 0] + 1j * vectors[..., 1]
    return numbers
