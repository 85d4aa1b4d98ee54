"""A slider as the input: its travel runs to and fro.

It has no angle: there the phase itself stands for one. Where a dyad is at its limit at an end of the
travel, such as a piston's rod and crank at a dead centre, that is a change point of the phase's, and the
motion runs on through it to the other closure.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar, NoReturn

from linkanim.errors import BadInput
from linkanim.mechanics.drive.input_path import SAME_PLACE, LimitDistances, Stroke, nearer_way
from linkanim.mechanics.drive.ranges import Arc
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Moving, Slope
from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.input_state import InputState, TravelState

NO_ANGLE = "the input is a slider, which has no angle; take the phase"


@dataclass(frozen=True, slots=True)
class SliderStroke(Stroke):
    """The input's path where a slider drives it; its coordinate is the slider's travel."""

    runs: ClassVar[str] = "slider's travel"

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the slider goes."""
        low, high = sorted((self.first * self.unscale, self.last * self.unscale))
        return low, high

    @property
    def dead_ends(self) -> tuple[float, ...]:
        """Both ends: where a dyad is at its limit, the motion runs on to the other closure."""
        return self.input_range

    def holds(self, place: float, turns: int = 1) -> bool:
        """Tell whether the slider comes so far."""
        low, high = self.input_range
        return low <= place <= high

    def phase_of(self, place: float, near: float) -> float:
        """Return the phase nearest to `near` at which the slider has travelled so far, or is at its end."""
        return nearer_way(self.forth(place / self.unscale), near)

    def coordinates(self, phases: Array) -> Array:
        """Return the slider's travel at phases."""
        return self.lengths(phases) * self.unscale

    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or symbolic expressions."""
        travel = self.running(phase, pace)
        return TravelState(phase, Sum(0.0), pace.value, pace.rate, pace, travel=travel)

    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by the slider's travel."""
        by_phase = self.running(phase, Slope(1.0))
        rate = 1.0 / by_phase.rate
        second = -(by_phase.second * rate * rate * rate)
        travel = Moving(by_phase.value, 1.0, 0.0)
        return TravelState(phase, Sum(0.0), rate, second, Slope(rate, second), travel=travel)

    def state_by_angle(self, graph: Graph, pace: Slope) -> NoReturn:
        """Raise BadInput: it has no angle."""
        raise BadInput(NO_ANGLE)

    def distances(self, angle: Array) -> NoReturn:
        """Raise BadInput: it has no angle."""
        raise BadInput(NO_ANGLE)

    def phases(self, angles: Array, distances: LimitDistances | None) -> NoReturn:
        """Raise BadInput: it has no angle."""
        raise BadInput(NO_ANGLE)

    def same(self, place: float, other: float) -> bool:
        """Tell whether two places of the slider are one."""
        low, high = self.input_range
        return abs(place - other) <= SAME_PLACE * (high - low)

    def distinct(self, places: Iterable[float]) -> tuple[float, ...]:
        """Return places of the slider, each once, the least first."""
        return tuple(sorted(set(places)))


def slider_stroke(linkage: Linkage, unscale: float, arcs: list[Arc] | None) -> SliderStroke:
    """Return the path of a linkage that a slider drives; no loop on a crank limits it."""
    return SliderStroke(*linkage.drive.actuator.lengths, unscale=unscale, unit=linkage.unit)
