"""What every method is asked: the poses of one four-bar with a coupler point, along a sequence of inputs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.kinds import RRR, Crank, Pin, Polar, Rigid
from linkanim.mechanics.linkage import Drive, Linkage
from linkanim.scenes.scene import Scene

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
TURN = 2 * math.pi


class FourBarLengths(NamedTuple):
    """The bars of a four-bar and its coupler point, measured along A -> B and to the left of it.

    O2 is the origin, O4 lies on the real axis; A is the crank's pin, B joins coupler and rocker.
    """

    ground: float
    crank: float
    coupler: float
    rocker: float
    point: complex = 0.5 + 0.25j
    """In coupler lengths from A."""

    @property
    def longest(self) -> float:
        """The length of the longest link."""
        return max(self[:4])


class Points(NamedTuple):
    """Where B and the coupler point P lie, as complex numbers; NaN where a method has no answer."""

    b: Complexes
    p: Complexes


@dataclass(frozen=True)
class Question:
    """One linkage and a sequence of inputs.

    `side` is the closure just after the start (+1: B left of A -> O4); `sides` the closure that a
    caller names at each pose. A caller who names a constant one gets `side`; where the input swings,
    the way back is asked for on the other closure. `start` is B at the first input: methods that go
    on from the previous pose begin there. `phases` are the drive's, for methods that take one; a
    turning input's are its angles. `by_angle` where an input that swings is given by its angle.
    """

    bars: FourBarLengths
    side: int
    angles: Floats
    sides: Floats
    start: complex
    phases: Floats
    periods: int = 1
    by_angle: bool = False

    @property
    def scene(self) -> Scene:
        """The same linkage as a scene."""
        return scene_of(self.bars, self.side)


def scene_of(bars: FourBarLengths, side: int) -> Scene:
    """Return the four-bar as a scene; its drive starts at angle 0 with a speed of 1 rad/s."""
    ground, crank, coupler, rocker, point = bars
    joints = (
        Pin("O2", (0.0, 0.0)),
        Pin("O4", (ground, 0.0), Polar(ground, 0.0)),
        Crank("A", "O2", crank),
        RRR("B", ("A", "O4"), (coupler, rocker), side),
        Rigid("P", ("A", "B"), (point.real * coupler, point.imag * coupler)),
    )
    return Scene("bench", "four-bar", "bench", "m", Linkage(joints, Drive("A", 1.0)), ("P",))


def coupler_point(bars: FourBarLengths, a: Complexes, b: Complexes) -> Points:
    """Return B and the coupler point of the coupler from A to B."""
    return Points(b, a + (b - a) * bars.point)


def crank_pin(bars: FourBarLengths, angles: Floats) -> Complexes:
    """Return where the crank's pin A lies."""
    pins: Complexes = bars.crank * np.exp(1j * angles)
    return pins


def joined(vectors: Floats) -> Complexes:
    """Return vectors (..., 2) as complex numbers."""
    numbers: Complexes = vectors[..., 0] + 1j * vectors[..., 1]
    return numbers
