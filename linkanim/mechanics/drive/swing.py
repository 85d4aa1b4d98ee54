"""The path of an input that swings between two limits."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from decimal import localcontext
from fractions import Fraction

import numpy as np

from linkanim.mechanics.drive.input_path import Limit, LimitDistances, Shortened, ThereAndBack, nearer_way
from linkanim.mechanics.formulas.circular import STATED
from linkanim.mechanics.formulas.exact import FULL_TURN, Sum, two_product, two_sum
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.precise import context, cosine, exactly, nearest_sum, sine
from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.loops.input_state import (
    InputState,
    half_way,
    swing_by_angle,
    swing_by_phase,
    swing_per_input,
)

SOLVED_FROM = ("x", "u", "v", "rest")
NEARLY_ZERO = 1e-8
"""Half a last digit of this is more than a limit is off by."""


@dataclass(frozen=True, slots=True)
class Swing(ThereAndBack):
    """The input swings between two limits; `ends` are the dyads that limit it at each.

    An end without a name is no limit: the input turns back there, and every closure holds.
    `repeats` is the number of turns of the input after which the linkage would be the same (more
    than one with gears).
    """

    low: Sum
    high: Sum
    ends: tuple[str, str]
    repeats: int = 1

    @property
    def periods(self) -> int:
        """One there-and-back; two where a different dyad changes its closure at each end."""
        return self.rounds if self.ends[0] == self.ends[1] else 2 * self.rounds

    @property
    def middle(self) -> Sum:
        """The angle in the middle of the swing."""
        return (self.low + self.high).times(0.5)

    @property
    def amplitude(self) -> float:
        """Half the angle of the swing."""
        return half_way(self.low, self.high)

    @property
    def limits(self) -> tuple[float, ...]:
        """The angles at which a dyad stops the input; an end at which it merely turns back is none."""
        ends = zip(self.input_range, self.ends, strict=True)
        return tuple(end for end, dyad in ends if dyad)

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the input goes; what the last digits of its sums leave of 0 is 0."""
        low, high = (float(end) for end in (self.low, self.high))
        return low if abs(low) > STATED * math.pi else 0.0, high if abs(high) > STATED * math.pi else 0.0

    def holds(self, place: float, turns: int = 1) -> bool:
        """Tell whether the input comes to an angle, or to one that many turns away, or twice as many …"""
        return abs(math.remainder(place - float(self.middle), 2 * math.pi * turns)) <= self.amplitude

    def phase_of(self, place: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, or at its limit."""
        away = math.remainder(place - float(self.middle), 2 * math.pi)
        rising = math.acos(min(max(-away / self.amplitude, -1.0), 1.0))
        return nearer_way(rising, near)

    def coordinates(self, phases: Array) -> Array:
        """Return the input's angle at phases."""
        angles: Array = float(self.middle) - self.amplitude * np.cos(phases)
        return angles

    def phases(self, angles: Array, distances: LimitDistances | None) -> Array:
        """Return the phase at angles of the input, on its way up; NaN for those out of reach."""
        assert distances is not None
        phases = 2 * np.arctan2(np.sqrt(distances.v), np.sqrt(distances.u))
        return np.where(distances.outside, np.nan, phases).reshape(angles.shape)

    def cut(self, low: Limit, high: Limit) -> Shortened:
        """Return the angles between two phases; at one without a dyad the input goes to its own limit."""
        first = self.low if low[1] is None else self._angle(low[0])
        last = self.high if high[1] is None else self._angle(high[0])
        return first, last, (low[1] or self.ends[0], high[1] or self.ends[1]), self.repeats

    def _angle(self, phase: Sum) -> Sum:
        """Return the angle at a phase on the way up, from the nearer end: twice the way is known exactly."""
        with localcontext(context()):
            way = 2 * exactly(self.amplitude)
            if float(phase) < math.pi / 2:
                return nearest_sum(exactly(self.low) + way * sine(exactly(phase) / 2) ** 2)
            return nearest_sum(exactly(self.high) - way * cosine(exactly(phase) / 2) ** 2)

    def half_squares(self, reference: Sum, ratio: Fraction) -> tuple[float, float]:
        """Return the least and greatest sin²(ψ/2), ψ = ratio × θ - reference."""
        low, high = sorted(float(end * ratio - reference) for end in (self.low, self.high))
        squares = [math.sin(angle / 2) ** 2 for angle in (low, high)]
        # An angle whole turns from ψ = 0, or from ψ = π, lies between them.
        passes = [(angle - low) % (2 * math.pi) <= high - low for angle in (0.0, math.pi)]
        return 0.0 if passes[0] else min(squares), 1.0 if passes[1] else max(squares)

    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or symbolic expressions."""
        return swing_by_phase(phase, pace, self.low, self.high)

    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by its own angle."""
        return swing_per_input(phase, self.low, self.high)

    def state_by_angle(self, graph: Graph, pace: Slope) -> tuple[tuple[str, ...], InputState]:
        """Return the names of the graph's inputs, and the input's state: its angle and half the ways left."""
        x, u, v, rest = (graph.input(name) for name in SOLVED_FROM)
        return SOLVED_FROM, swing_by_angle((x, u, v), pace, self.low, self.high, rest)

    def solved_from(self, distances: LimitDistances) -> tuple[Array, ...]:
        """Return what the program by angle takes: the angle from the middle, half the ways left, the rest."""
        return distances.angle, distances.u, distances.v, distances.rest

    @np.errstate(all="ignore")
    def distances(self, angle: Array) -> LimitDistances:
        """Return how far angles are from the low end, the middle and the high end, whole turns aside.

        After `repeats` turns of the input the linkage is the same; they are taken off without rounding.
        The float nearest a limit is the limit as well as a float can say it: it is never outside, nor is 0
        where a limit is what its own last digits leave of 0.
        """
        turns = self.repeats * np.rint((angle - float(self.middle)) / (2 * math.pi * self.repeats))
        whole, lost = two_product(-turns, FULL_TURN.high)
        high, error = two_sum(angle, whole)
        low = error + lost - turns * FULL_TURN.low
        v, u = np.add(*_way(high, low, self.low)), -np.add(*_way(high, low, self.high))
        nearest = np.spacing(np.maximum(np.abs(angle), NEARLY_ZERO)) / 2
        at_limit = (np.abs(u) <= nearest) | (np.abs(v) <= nearest)
        outside = ~((np.minimum(u, v) >= 0) | at_limit)
        near, rest = _way(high, low, self.middle)
        way = near + rest
        u, v = np.maximum(u, 0.0) / 2, np.maximum(v, 0.0) / 2
        return LimitDistances(way, rest - (way - near), u, v, outside, at_limit)

    def turns_to(self, angle: float) -> int:
        """Return by how many turns the range is to be shifted to lie around an angle, or nearest to it."""
        return round((angle - float(self.middle)) / (2 * math.pi))

    def shifted(self, turns: int) -> Swing:
        """Return the same range that many turns on."""
        way = FULL_TURN.times(float(turns))
        return replace(self, low=self.low + way, high=self.high + way)


def _way(high: Array, low: Array, limit: Sum) -> tuple[Array, Array]:
    """Return angle - limit, sums of two floats both, in two parts that overlap."""
    total, error = two_sum(high, -limit.high)
    return total, error + (low - limit.low)
