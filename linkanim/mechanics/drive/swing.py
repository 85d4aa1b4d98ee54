"""The path of an input that swings between two limits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import localcontext
from fractions import Fraction

import numpy as np

from linkanim.mechanics.drive.input_path import (
    Limit,
    LimitDistances,
    Shortened,
    ThereAndBack,
    half_squares,
    limit_distances,
    nearer_way,
)
from linkanim.mechanics.formulas.exact import Sum
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


@dataclass(frozen=True, slots=True)
class Swing(ThereAndBack):
    """The input swings between two limits; `dyads` are those that limit it at each.

    An end without a name is no limit: the input turns back there, and every closure holds.
    `repeats` is the number of turns of the input after which the linkage would be the same (more
    than one with gears).
    """

    low: Sum
    high: Sum
    dyads: tuple[str, str]
    repeats: int = 1

    @property
    def ends(self) -> tuple[str, str]:
        """The dyads that limit the input at its lower and its upper end, "" where it merely turns back."""
        return self.dyads

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
        return tuple(float(end) for end, dyad in zip((self.low, self.high), self.ends, strict=True) if dyad)

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the input goes."""
        return float(self.low), float(self.high)

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
        return half_squares((self.low, self.high), reference, ratio)

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

    def distances(self, angle: Array) -> LimitDistances:
        """Return how far angles are from the limits."""
        return limit_distances(angle, (self.low, self.middle, self.high), self.repeats)
