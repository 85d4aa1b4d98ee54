"""The path of an input that turns fully."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.drive.input_path import InputPath, Limit, LimitDistances, Shortened
from linkanim.mechanics.formulas.exact import Sum, exact_angle
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.loops.input_state import InputState, turn


@dataclass(frozen=True, slots=True)
class Turn(InputPath):
    """The input turns fully from `start`; without change points down the chain all is back after `turns`."""

    start: float
    turns: int

    full_turn: ClassVar[bool] = True

    @property
    def periods(self) -> int:
        """The number of turns after which every joint is back."""
        return self.turns * self.rounds

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the input goes: one turn from 0."""
        return 0.0, 2 * math.pi

    def holds(self, place: float, turns: int = 1) -> bool:
        """Tell whether the input comes to an angle: to every one."""
        return True

    def phase_of(self, place: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, whole turns aside."""
        return near + math.remainder(place - self.start - near, 2 * math.pi)

    def coordinates(self, phases: Array) -> Array:
        """Return the input's angle at phases."""
        return phases + self.start if self.start else phases

    def phases(self, angles: Array, distances: LimitDistances | None) -> Array:
        """Return the phase at angles of the input."""
        return angles - self.start if self.start else angles

    def home(self, start: float) -> float:
        """Return the phase of the start."""
        return 0.0

    def beside(self, start: float, phases: Array, rows: NDArray[Any]) -> tuple[Array, NDArray[Any], int]:
        """Return phases and what is known there (D, N), coming round on both sides; the start's index."""
        once, period = (phases >= 0) & (phases < 2 * math.pi * self.periods), 2 * math.pi * self.periods
        one, count = phases[once], int(once.sum())
        return np.concatenate([one - period, one, one + period]), np.tile(rows[:, once], 3), count

    def cut(self, low: Limit, high: Limit) -> Shortened:
        """Return the angles between two phases, at each of which a dyad limits the input."""
        first, last = (dyad for _, dyad in (low, high) if dyad is not None)
        return self.place(low[0]), self.place(high[0]), (first, last), self.periods

    def place(self, phase: Sum) -> Sum:
        """Return the angle at a phase, by which a place on this path is known."""
        return exact_angle(self.start) + phase

    def coordinate_at(self, place: Sum) -> float:
        """Return the angle."""
        return float(place)

    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or symbolic expressions."""
        return replace(turn(phase, pace, exact_angle(self.start)), stated=self.start)

    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by its own angle."""
        return self.state(phase, Slope(1.0))
