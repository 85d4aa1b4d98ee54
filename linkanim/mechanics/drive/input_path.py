"""What paths of the input have in common: those that no dyad limits, and those that run there and back."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from fractions import Fraction
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.drive.reach import Array, WaysLeft
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Graph
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.loops.input_state import InputState, turn
from linkanim.mechanics.loops.signed import Swinging


class Unlimited:
    """A path that no dyad limits: it has no ends to be measured from, and is solved from its angle alone."""

    __slots__ = ()

    ends: ClassVar[tuple[str, ...]] = ()
    amplitude: ClassVar[None] = None
    limits: ClassVar[tuple[float, ...]] = ()
    """The angles at which a dyad stops the input."""

    def state_by_angle(self, graph: Graph, pace: Slope) -> tuple[tuple[str, ...], InputState]:
        """Return the names of the graph's inputs, and the input's state at its angle."""
        return ("x",), turn(graph.input("x"), pace, Sum(0.0))

    def solved_from(self, reached: WaysLeft) -> tuple[Array, ...]:
        """Return what the program by angle takes: the angle."""
        return (reached.angle,)

    def swinging(self, state: InputState) -> Swinging | None:
        """Return None: no dyad limits a swing."""
        return None


class ThereAndBack(ABC):
    """A path on which the input turns back at both ends, where its phase is 0 and π."""

    __slots__ = ()

    full_turn: ClassVar[bool] = False

    @abstractmethod
    def angles(self, phases: Array) -> Array:
        """Return the input's angle at phases."""

    @abstractmethod
    def phase_of(self, angle: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, or at its end."""

    def home(self, start: float) -> float:
        """Return the phase of the start on the way to the far end, at most that of an end."""
        return self.phase_of(start, 0.0)

    def beside(self, start: float, phases: Array, rows: NDArray[Any]) -> tuple[Array, NDArray[Any], int]:
        """Return phases of the way to the far end and what is known there (D, N), and the start's index."""
        up = (phases >= 0) & (phases <= math.pi)
        return phases[up], rows[:, up], int(np.abs(phases[up] - self.home(start)).argmin())


def nearer_way(forth: float, near: float) -> float:
    """Return of ±forth, whole turns aside, the phase nearest to `near`: of a place passed there and back."""
    ways = (near + math.remainder(phase - near, 2 * math.pi) for phase in (forth, -forth))
    return min(ways, key=lambda phase: abs(phase - near))


def half_squares(ends: tuple[Sum, Sum], reference: Sum, ratio: Fraction) -> tuple[float, float]:
    """Return the least and greatest sin²(ψ/2) between two angles θ, where ψ = ratio × θ - reference."""
    low, high = sorted(float(end * ratio - reference) for end in ends)
    squares = [math.sin(angle / 2) ** 2 for angle in (low, high)]
    # An angle whole turns from ψ = 0, or from ψ = π, lies between them.
    passes = [(angle - low) % (2 * math.pi) <= high - low for angle in (0.0, math.pi)]
    return 0.0 if passes[0] else min(squares), 1.0 if passes[1] else max(squares)
