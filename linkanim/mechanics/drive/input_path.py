"""The path of the input: how far it goes, how its phase moves it, when everything is back.

A path is found once for a linkage; every pose is computed from it. `InputPath` is what all of them answer;
`ThereAndBack` and `Stroke` are what those have in common that turn back, and that a length drives.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.formulas.circular import STATED
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.loops.input_state import InputState, turn

SAME_PLACE = 1e-9
"""Angles that differ by less, in radians, are one; travels by less than this share of the whole."""

Limit = tuple[Sum, str | None]
"""The phase of a limit, and the dyad that sets it; None where the path itself ends."""


Shortened = tuple[Sum, Sum, tuple[str, str], int]
"""The angles between which a path is cut back, the dyads that limit it there, and its repeats."""


@dataclass(frozen=True, slots=True)
class InputPath(ABC):
    """What every input answers: its range, its clock, its law and its limits.

    Its coordinate is an angle (rad), or of a slider its travel (the scene's unit); its phase is the clock's.
    After `periods` periods of the drive every joint is back, `rounds` times as many as without change
    points down the chain. The methods here hold where no dyad limits it.
    """

    rounds: int = field(default=1, kw_only=True)

    full_turn: ClassVar[bool]
    """Whether it turns fully; else it runs there and back."""

    @property
    @abstractmethod
    def periods(self) -> int:
        """The number of drive periods after which every joint is back."""

    @property
    @abstractmethod
    def input_range(self) -> tuple[float, float]:
        """How far the input goes, the lower end first."""

    @property
    def dead_ends(self) -> tuple[float, ...]:
        """The ends at which a dyad may be at its limit though it does not stop the input."""
        return ()

    def doubled(self) -> Self:
        """Return the path of a linkage that is back after twice as many periods."""
        return replace(self, rounds=2 * self.rounds)

    @abstractmethod
    def holds(self, place: float, turns: int = 1) -> bool:
        """Tell whether the input comes to a place; to an angle also by `turns` turns, or twice as many …"""

    @abstractmethod
    def phase_of(self, place: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at a place, or at its end."""

    @abstractmethod
    def coordinates(self, phases: Array) -> Array:
        """Return the input's coordinate at phases."""

    @abstractmethod
    def phases(self, angles: Array, distances: LimitDistances | None) -> Array:
        """Return the phase at angles of the input, on its way up; NaN for those out of reach."""

    @abstractmethod
    def home(self, start: float) -> float:
        """Return the phase of the start."""

    @abstractmethod
    def beside(self, start: float, phases: Array, rows: NDArray[Any]) -> tuple[Array, NDArray[Any], int]:
        """Return phases around the start and what is known there (D, N), and the start's index."""

    @abstractmethod
    def cut(self, low: Limit, high: Limit) -> Shortened:
        """Return the part of the path between two phases; AssemblyError where it may not be shorter."""

    def place(self, phase: Sum) -> Sum:
        """Return what names the place at a phase: the phase, for one that is passed there and back."""
        return phase

    def coordinate_at(self, place: Sum) -> float:
        """Return the input's coordinate at a place."""
        return float(self.coordinates(np.array(float(place))))

    def half_squares(self, reference: Sum, ratio: Fraction) -> tuple[float, float]:
        """Return the least and greatest sin²(ψ/2), ψ = ratio × θ - reference; of a slider, of the phase."""
        return 0.0, 1.0

    @abstractmethod
    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or symbolic expressions."""

    @abstractmethod
    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by its own coordinate."""

    @property
    def ends(self) -> tuple[str, ...]:
        """The dyads that limit the input at its lower and its upper end, "" where it merely turns back."""
        return ()

    @property
    def amplitude(self) -> float | None:
        """Half the angle of a swing between limits; None without one."""
        return None

    @property
    def limits(self) -> tuple[float, ...]:
        """The places at which a dyad stops the input."""
        return ()

    def distances(self, angle: Array) -> LimitDistances | None:
        """Return how far angles are from the input's ends; None where no angle is out of reach."""
        return None

    def state_by_angle(self, graph: Graph, pace: Slope) -> tuple[tuple[str, ...], InputState]:
        """Return the names of the graph's inputs, and the input's state at its angle."""
        return ("x",), turn(graph.input("x"), pace, Sum(0.0))

    def solved_from(self, distances: LimitDistances) -> tuple[Array, ...]:
        """Return what the program by angle takes: the angle, and what else its state is known by."""
        return (distances.angle,)

    def same(self, place: float, other: float) -> bool:
        """Tell whether two places of the input are one."""
        return abs(math.remainder(place - other, 2 * math.pi)) <= SAME_PLACE

    def distinct(self, places: Iterable[float]) -> tuple[float, ...]:
        """Return places of the input, angles within one turn, each once, the least first."""
        found: list[float] = []
        for place in sorted(math.remainder(place, 2 * math.pi) % (2 * math.pi) for place in places):
            if not any(self.same(place, other) for other in found):
                found.append(place)
        return tuple(found)


@dataclass(frozen=True, slots=True)
class ThereAndBack(InputPath):
    """A path on which the input turns back at both ends, where its phase is 0 and π."""

    full_turn: ClassVar[bool] = False

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


def retraced(phases: Any) -> tuple[Any, Any]:
    """Return the phases on the way up where an input is that comes back by the way it came, and +1 or -1.

    The sign is that of its rates: +1 on the way up and at both ends, where they change it, -1 on the way
    back. A float of any multiple of π is an end, as exact as it is itself, and so is what its last digits
    leave of one (`stated`).
    """
    within = np.fmod(phases, 2 * math.pi)
    within = np.where(np.abs(within) > math.pi, within - np.copysign(2 * math.pi, within), within)
    near, at = STATED * np.hypot(phases, math.pi), np.abs(within)
    back = np.where((within < -near) & (within > near - math.pi), -1.0, 1.0)
    # of many turns a phase's last digits are more than those of the end that is left
    ended = np.where(at <= near, 0.0, np.where(at >= math.pi - near, math.pi, at))
    return np.where(np.abs(phases) > 2 * math.pi, ended, at), back


@dataclass(frozen=True)
class LimitDistances:
    """How far angles are from the limits of a swing.

    `angle` is that from its middle, and `rest` what the float lacks of it; `u` and `v` are half of what is
    left to its upper and its lower limit; angles lie `outside`, or are a limit as well as a float can say it.
    """

    angle: Array
    rest: Array
    u: Array
    v: Array
    outside: NDArray[np.bool_]
    at_limit: NDArray[np.bool_]

    @property
    def snapped(self) -> LimitDistances:
        """The same, the smaller one of u and v zero for angles that are a limit."""
        pairs = (self.u, self.v), (self.v, self.u)
        u, v = (np.where(self.at_limit & (way <= other), 0.0, way) for way, other in pairs)
        return replace(self, u=u, v=v)
