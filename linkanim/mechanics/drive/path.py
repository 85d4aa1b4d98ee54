"""The path of the input: how far it goes, how its phase moves it, when everything is back.

A path is found once for a linkage; every pose is computed from it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import localcontext
from fractions import Fraction
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError
from linkanim.mechanics.drive.input_path import ThereAndBack, Unlimited, half_squares, nearer_way
from linkanim.mechanics.drive.reach import Array, WaysLeft, reach
from linkanim.mechanics.drive.stroke import CylinderStroke, SliderStroke
from linkanim.mechanics.formulas.exact import FULL_TURN, HALF_TURN, Sum, exact_angle
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.precise import context, cosine, exactly, nearest_sum, sine
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.input_state import (
    InputState,
    swing_by_angle,
    swing_by_phase,
    swing_per_input,
    turn,
)
from linkanim.mechanics.loops.loop import Loop
from linkanim.mechanics.loops.roots import Kind, LoopRoot
from linkanim.mechanics.loops.signed import Swinging

NO_RANGE = 1e-12
"""Ranges that overlap by no more than this, in radians, touch."""
ONE_PLACE = (
    "it can be put together at one angle of the input only, so that nothing could move; "
    "make one length a little longer or shorter"
)


@dataclass(frozen=True, slots=True)
class Turn(Unlimited):
    """The input turns fully from `start`; every joint is back after `turns` turns.

    `rounds` is how often that takes to bring back a chain that passes a change point.
    """

    start: float
    turns: int
    rounds: int = 1

    full_turn: ClassVar[bool] = True

    @property
    def periods(self) -> int:
        """The number of turns after which every joint is back."""
        return self.turns * self.rounds

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the input goes: one turn from 0."""
        return 0.0, 2 * math.pi

    def holds(self, angle: float, turns: int = 1) -> bool:
        """Tell whether the input comes to an angle."""
        return True

    def phase_of(self, angle: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, whole turns aside."""
        return near + math.remainder(angle - self.start - near, 2 * math.pi)

    def angles(self, phases: Array) -> Array:
        """Return the input's angle at phases."""
        return phases + self.start if self.start else phases

    def phases(self, angles: Array, reached: WaysLeft | None) -> Array:
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

    def cut(self, low: tuple[Sum, str | None], high: tuple[Sum, str | None]) -> Swing:
        """Return the swing between two phases, at each of which a dyad limits the input."""
        names = tuple(dyad for _, dyad in (low, high) if dyad is not None)
        return Swing(self.place(low[0]), self.place(high[0]), (names[0], names[1]), self.periods)

    def place(self, phase: Sum) -> Sum:
        """Return the angle at a phase, by which a place on this path is known."""
        return exact_angle(self.start) + phase

    def half_squares(self, reference: Sum, ratio: Fraction) -> tuple[float, float]:
        """Return the least and greatest sin²(ψ/2), ψ = ratio × θ - reference."""
        return 0.0, 1.0

    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or noted expressions."""
        return turn(phase, pace, exact_angle(self.start))

    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by its own angle."""
        return self.state(phase, Slope(1.0))

    def reach(self, angle: Array) -> WaysLeft | None:
        """Return None: no angle is out of reach."""
        return None


@dataclass(frozen=True, slots=True)
class Swing(ThereAndBack):
    """The input swings between two limits; `ends` names the dyad that limits it at each.

    An end without a name is no limit: the input turns back there, and every closure holds.
    `repeats` is the number of turns of the input after which the linkage would be the same (more
    than one with gears).
    """

    low: Sum
    high: Sum
    ends: tuple[str, str]
    repeats: int = 1
    rounds: int = 1

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
        return float((self.high - self.low).times(0.5))

    @property
    def limits(self) -> tuple[float, ...]:
        """The angles at which a dyad stops the input; an end at which it merely turns back is none."""
        return tuple(float(end) for end, dyad in zip((self.low, self.high), self.ends, strict=True) if dyad)

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the input goes."""
        return float(self.low), float(self.high)

    def holds(self, angle: float, turns: int = 1) -> bool:
        """Tell whether the input comes to an angle, or to one that many turns away, or twice as many …"""
        return abs(math.remainder(angle - float(self.middle), 2 * math.pi * turns)) <= self.amplitude

    def phase_of(self, angle: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, or at its limit."""
        away = math.remainder(angle - float(self.middle), 2 * math.pi)
        rising = math.acos(min(max(-away / self.amplitude, -1.0), 1.0))
        return nearer_way(rising, near)

    def angles(self, phases: Array) -> Array:
        """Return the input's angle at phases."""
        angles: Array = float(self.middle) - self.amplitude * np.cos(phases)
        return angles

    def phases(self, angles: Array, reached: WaysLeft | None) -> Array:
        """Return the phase at angles of the input, on its way up; NaN for those out of reach."""
        assert reached is not None
        phases = 2 * np.arctan2(np.sqrt(reached.v), np.sqrt(reached.u))
        return np.where(reached.outside, np.nan, phases).reshape(angles.shape)

    def cut(self, low: tuple[Sum, str | None], high: tuple[Sum, str | None]) -> Swing:
        """Return the swing between two phases; at one without a dyad the input goes to its own limit."""
        angles = [
            own if dyad is None else self._angle(phase)
            for (phase, dyad), own in zip((low, high), (self.low, self.high), strict=True)
        ]
        return Swing(angles[0], angles[1], (low[1] or self.ends[0], high[1] or self.ends[1]), self.repeats)

    def _angle(self, phase: Sum) -> Sum:
        """Return the angle at a phase on the way up, from the nearer end: twice the way is known exactly."""
        with localcontext(context()):
            way = 2 * exactly(self.amplitude)
            if float(phase) < math.pi / 2:
                return nearest_sum(exactly(self.low) + way * sine(exactly(phase) / 2) ** 2)
            return nearest_sum(exactly(self.high) - way * cosine(exactly(phase) / 2) ** 2)

    def place(self, phase: Sum) -> Sum:
        """Return the phase: of an angle's two ways through it, each is a place of its own."""
        return phase

    def half_squares(self, reference: Sum, ratio: Fraction) -> tuple[float, float]:
        """Return the least and greatest sin²(ψ/2), ψ = ratio × θ - reference."""
        return half_squares((self.low, self.high), reference, ratio)

    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or noted expressions."""
        return swing_by_phase(phase, pace, self.middle, self.amplitude)

    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by its own angle."""
        return swing_per_input(phase, self.middle, self.amplitude)

    def state_by_angle(self, graph: Graph, pace: Slope) -> tuple[tuple[str, ...], InputState]:
        """Return the names of the graph's inputs, and the input's state: its angle and half the ways left."""
        x, u, v = (graph.input(name) for name in "xuv")
        return ("x", "u", "v"), swing_by_angle((x, u, v), pace, self.middle, self.amplitude)

    def solved_from(self, reached: WaysLeft) -> tuple[Array, ...]:
        """Return what the program by angle takes: the angle from the middle, and half the ways left."""
        return reached.angle, reached.u, reached.v

    def swinging(self, state: InputState) -> Swinging | None:
        """Return the swing as the state has it; None for a state without ends."""
        return None if state.ends is None else Swinging(state.ends, state.pace, self.low, self.high)

    def reach(self, angle: Array) -> WaysLeft | None:
        """Return how far angles are from the limits."""
        return reach(angle, (self.low, self.middle, self.high), self.repeats)


Path = Turn | Swing | CylinderStroke | SliderStroke


@dataclass(frozen=True, slots=True)
class Arc:
    """A range of the input that one dyad, or several, leave open."""

    low: Sum
    high: Sum
    ends: tuple[str, str]

    @property
    def middle(self) -> float:
        """The angle in the middle of the range."""
        return float(self.low + self.high) / 2

    def turns_to(self, angle: float) -> int:
        """Return by how many turns the range is to be shifted to lie around an angle, or nearest to it."""
        return round((angle - self.middle) / (2 * math.pi))

    def shifted(self, turns: int) -> Arc:
        """Return the same range that many turns on."""
        way = FULL_TURN.times(float(turns))
        return Arc(self.low + way, self.high + way, self.ends)


def open_arcs(linkage: Linkage, loops: Mapping[str, Loop]) -> list[Arc] | None:
    """Return the ranges of the input that the loops on its own pin leave open; None for a full turn.

    AssemblyError where a loop cannot be closed at any angle, or the loops leave no common range.
    """
    arcs: list[Arc] | None = None
    for name, loop in loops.items():
        if loop.pin == linkage.drive.joint:
            unscale = linkage.crank(loop.pin).length / loop.crank.length
            own = arcs_of(linkage.joint(name), loop.root, unscale)
            arcs = own if arcs is None else arcs if own is None else list(_common(arcs, own))
            if arcs == []:
                raise AssemblyError(f"joint {name}: the bars of the linkage leave its input no common range")
    return arcs


def arcs_of(joint: Joint, root: LoopRoot, unscale: float = 1.0) -> list[Arc] | None:
    """Return a loop's open ranges in the crank's own angle; times `unscale` its lengths are the joint's."""
    if min(root.u.most, root.w.most) == 0:
        raise AssemblyError(f"joint {joint.name}: {ONE_PLACE}")
    if min(root.u.most, root.w.most) < 0:
        most = (factor.most * root.unit * unscale**2 for factor in (root.u, root.w))
        raise AssemblyError(f"joint {joint.name}: {joint.why_apart(*most)}")
    ends, reference = (joint.name, joint.name), root.reference
    u_limits, w_limits = root.u.kind is Kind.LIMIT, root.w.kind is Kind.LIMIT
    if u_limits and w_limits:
        inner, outer = root.w.short, root.u.reach
        above = Arc(reference + inner, reference + outer, ends)
        return [above, Arc(reference - outer, reference - inner, ends)]
    if u_limits:
        return [Arc(reference - root.u.reach, reference + root.u.reach, ends)]
    if w_limits:
        middle = reference + HALF_TURN
        return [Arc(middle - root.w.reach, middle + root.w.reach, ends)]
    return None


def _common(first: list[Arc], second: list[Arc]) -> Iterator[Arc]:
    """Yield the ranges that both lists leave open, the input's angle being the same every turn."""
    for a in first:
        for b in second:
            for turns in (-1, 0, 1):
                moved = b.shifted(turns)
                low, low_end = max((a.low, a.ends[0]), (moved.low, moved.ends[0]), key=_size)
                high, high_end = min((a.high, a.ends[1]), (moved.high, moved.ends[1]), key=_size)
                if float(high - low) > NO_RANGE:
                    yield Arc(low, high, (low_end, high_end))


def _size(end: tuple[Sum, str]) -> tuple[float, float]:
    return end[0].high, end[0].low
