"""Find the phase at which a moving point is nearest to a place: a hand drags the point, the input follows.

A point's course over one true period is sampled once. For each place, all minima of the distance are
bracketed among the samples and then solved in plain floats, so that the answer is the nearest pose of all,
and not only of those close by. One true period holds every pose that the input reaches: both closures of a
swing that comes back on the other one, and all poses beyond a change point.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.motion import Mechanism
from linkanim.mechanics.program import Array
from linkanim.mechanics.tolerances import EQUALLY_FAR, NARROW

_TURNING = math.cos(math.radians(30.0))
"""Cosine of 30°: between samples whose directions differ by more, the distance may have several minima."""
_PARTS = 16
"""The number of parts into which such a step is divided."""
_ROUNDS = 100
_BACK = 1.5
"""The factor by which a pose counts as farther that lies backwards: past a dead centre the motion goes on."""

Complex = NDArray[np.complex128]


@frozen
class PointPath:
    """Where a joint is at equal steps of phase over one true period (N,), in the scene's unit.

    `places` are complex, x + yi, and `rates` their derivatives by the phase.
    """

    mechanism: Mechanism
    joint: str
    phases: Array
    places: Complex
    rates: Complex

    @property
    def size(self) -> float:
        """The diagonal of the box around the course; 0 for a joint that does not move."""
        return float(math.hypot(np.ptp(self.places.real), np.ptp(self.places.imag)))

    @property
    def moves(self) -> bool:
        """Whether the joint moves at all."""
        return bool(np.abs(self.rates).max() > 0.0)

    def nearest(self, place: Point, near: float, *, tolerance: float = 0.0, forward: bool = True) -> float:
        """Return the phase at which the joint is nearest to a place (the scene's unit), in any turn.

        Of several equally near poses it is the one nearest to the phase `near`; a pose ahead is preferred to
        one behind, ahead being towards greater phases where `forward`. A minimum that is farther by at most
        `tolerance` counts as equally near. `near` itself for a joint that does not move.
        """
        target, period = complex(*place), 2 * math.pi * self.mechanism.periods
        minima = list(self._minima(target, tolerance))
        least = min(far for far, _ in minima) if minima else 0.0
        equal = least + tolerance + EQUALLY_FAR * self.size
        shifts = (math.remainder(phase - near, period) for far, phase in minima if far <= equal)

        def way_to(shift: float) -> float:
            return abs(shift) if (shift > 0.0) == forward else _BACK * abs(shift)

        return near + min(shifts, key=way_to) if self.moves and minima else near

    def _minima(self, target: complex, tolerance: float) -> Iterator[tuple[float, float]]:
        """Yield distance and phase of each minimum that may be the least, or farther by the tolerance."""
        apart = self.places - target
        far = np.abs(apart)
        slope = (apart * self.rates.conj()).real
        after = np.roll(np.arange(len(far)), -1)
        speed = np.abs(self.rates)
        cosine = (self.rates * self.rates[after].conj()).real
        turning = cosine < _TURNING * speed * speed[after]
        falls = (slope < 0.0) & (slope[after] >= 0.0)
        step = 2 * math.pi * self.mechanism.periods / len(far)
        reached = np.minimum(far, far[after]) - 2.0 * step * np.maximum(speed, speed[after])
        least = int(far.argmin())
        yield float(far[least]), float(self.phases[least])
        for n in np.flatnonzero((falls | turning) & (reached <= far[least] + tolerance)):
            low = float(self.phases[n])
            parts = _PARTS if turning[n] else 1
            yield from self._within(target, [low + step * part / parts for part in range(parts + 1)])

    def _within(self, target: complex, phases: list[float]) -> Iterator[tuple[float, float]]:
        """Yield distance and phase of each minimum between neighbouring phases."""

        def slope(phase: float) -> float:
            apart, rate = self._at(phase, target)
            return apart.real * rate.real + apart.imag * rate.imag

        slopes = [slope(phase) for phase in phases]
        for n, (first, last) in enumerate(pairwise(slopes)):
            if first < 0.0 <= last:
                phase = _root(slope, (phases[n], first), (phases[n + 1], last))
                yield abs(self._at(phase, target)[0]), phase

    def _at(self, phase: float, target: complex) -> tuple[complex, complex]:
        """Return the vector from a place to the joint, and its derivative by the phase."""
        pose = self.mechanism.pose(phase, 1.0, 0.0, 1)
        return complex(*pose.position[self.joint]) - target, complex(*pose.velocity[self.joint])


def point_path(mechanism: Mechanism, joint: str) -> PointPath:
    """Return a joint's course over one true period; KeyError for a name that is no joint's."""
    phases = mechanism.phases
    motion = mechanism.solve(phase=phases, speed=1.0, derivatives=1)
    places, rates = motion.position[joint], motion.velocity[joint]
    return PointPath(mechanism, joint, phases, _complex(places), _complex(rates))


def _complex(vectors: Array) -> Complex:
    return np.asarray(vectors[..., 0] + 1j * vectors[..., 1])


def _root(function: Callable[[float], float], low: tuple[float, float], high: tuple[float, float]) -> float:
    """Return where a function rises through zero between two places, each with its value there.

    False position after Dowell and Jarratt (the Illinois rule, BIT 11, 1971): the value of an end that stays
    is halved, so that both ends close in.
    """
    (a, at_a), (b, at_b) = low, high
    for _ in range(_ROUNDS):
        if b - a <= NARROW or at_b == 0.0:
            break
        middle = a - at_a * (b - a) / (at_b - at_a)
        if not a < middle < b:
            break
        value = function(middle)
        if value < 0.0:
            a, at_a, at_b = middle, value, at_b / 2
        else:
            b, at_b, at_a = middle, value, at_a / 2
    return b
