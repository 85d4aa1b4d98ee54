"""Lengths as the input, which run to and fro: a cylinder that turns the crank, a slider's travel.

**A cylinder.** Its length ℓ between a fixed pin G and a joint H of the crank's body makes a triangle with
the crank's pivot, whose sides g and r do not change. With ψ its angle at the pivot the law of cosines is

    4 g r sin²(ψ/2) = (ℓ - g + r)(ℓ + g - r)      4 g r cos²(ψ/2) = (g + r - ℓ)(g + r + ℓ)

Nothing cancels in the brackets, since half the phase gives ℓ's distances from its ends. So the sine and
cosine of ψ/2 need no arc function; and ψ' = ℓ ℓ'/(g r sin ψ).

**A slider** has no angle: there the phase itself stands for one. Where a dyad is at its limit at an end of
the travel, such as a piston's rod and crank at a dead centre, that is a change point in terms of the phase,
and the motion runs on through it to the other closure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import field, replace
from fractions import Fraction
from functools import partial
from typing import ClassVar, NoReturn

import numpy as np

from linkanim.errors import BadInput, EndsError
from linkanim.frozen import frozen
from linkanim.mechanics.angles import (
    FULL_TURN,
    Half,
    Sum,
    direction,
    exact_angle,
    half_of,
    sharp_half_angle,
    stated,
)
from linkanim.mechanics.arithmetic import Graph, Moving, Slope, Value, Vec, arctan2, sqrt
from linkanim.mechanics.linkage import Actuator, CrankTriangle, Cylinder, Linkage, Travel
from linkanim.mechanics.program import Array
from linkanim.mechanics.solver.input import (
    HalfForm,
    InputState,
    Limit,
    LimitDistances,
    Swing,
    ThereAndBack,
    TravelState,
    nearer_way,
    turn,
)
from linkanim.mechanics.solver.loop import ground_between
from linkanim.mechanics.tolerances import SAME_PLACE
from linkanim.units import degrees

NO_ANGLE = "the input is a slider, which has no angle; take the phase"


@frozen
class Stroke(ThereAndBack):
    """The input's path where a length drives it, which is mid - amp·cos φ.

    The length starts at `first`, is at `last` half a period later, and comes back. Times `unscale` it is in
    the scene's unit.
    """

    first: float
    last: float
    unscale: float = field(default=1.0, kw_only=True)
    unit: str = field(default="", kw_only=True)
    """The scene's unit of length, as in sentences."""

    runs: ClassVar[str]
    """The noun for what runs to and fro."""

    @property
    def periods(self) -> int:
        """One there-and-back, or more where the chain passes change points."""
        return 1 if self.way else self.rounds

    def lengths(self, phases: Array) -> Array:
        """Return the length at phases."""
        lengths: Array = (self.first + self.last) / 2 - (self.last - self.first) / 2 * np.cos(phases)
        return lengths

    def forth(self, length: float) -> float:
        """Return the phase at which the length is reached on the way to `last`, at most that of an end."""
        middle, half = (self.first + self.last) / 2, (self.last - self.first) / 2
        return math.acos(min(max((middle - length) / half, -1.0), 1.0))

    def running(self, phase: Value, pace: Slope) -> Moving:
        """Return the length with its rates."""
        whole, reach = sharp_half_angle(phase + phase), (self.last - self.first) / 2
        length = whole.cosine * -reach + (self.first + self.last) / 2
        rate = whole.sine * pace.value * reach
        second = (whole.cosine * (pace.value * pace.value) + whole.sine * pace.rate) * reach
        return Moving(length, rate, second)

    def cut(self, low: Limit, high: Limit) -> NoReturn:
        """Raise EndsError with the lengths between which everything closes: a stroke is not cut back."""
        dyad = next(name for _, name in (low, high) if name is not None)
        ends = [float(self.lengths(np.array(float(phase)))) * self.unscale for phase, _ in (low, high)]
        least, most = sorted(ends)
        first, last = self.first * self.unscale, self.last * self.unscale
        raise EndsError(
            f"joint {dyad}: it lets the {self.runs} run from {least:.6g} to {most:.6g} {self.unit} only, "
            f"not from {first:g} to {last:g} {self.unit}; choose other ends"
        )


@frozen
class HalfState(InputState):
    """The input's state where half of its angle from `origin` is known by its sine and cosine."""

    own: Half | None = None

    def half_shifted(self, ratio: Fraction, shift: Sum, form: HalfForm) -> Half:
        """Return half of ratio × angle + shift; where ratio is ±1, from the known half by a rotation."""
        assert self.own is not None
        if abs(ratio) != 1:
            return InputState.half_shifted(self, ratio, shift, form)
        sense = float(ratio)
        rest = direction(float(shift.times(0.5)))
        turned = Vec(self.own.cosine, self.own.sine * sense).times(Vec(*rest))
        return half_of(turned.y, turned.x)


@frozen
class CylinderStroke(Stroke):
    """The input's path where a cylinder drives it; θ = base + side × ψ."""

    sides: tuple[float, float]
    """The triangle's sides from the crank's pivot: to the cylinder's fixed pin, to its joint on the crank."""
    base: Sum
    side: int
    lost: float = 0.0
    """What rounding took from the first side, which is read from coordinates."""

    runs: ClassVar[str] = "cylinder's length"

    @property
    def swing(self) -> Swing:
        """The crank's swing, whose ends are no dyad's limits."""
        low, high = sorted(self.angle_of(length) for length in (self.first, self.last))
        return Swing(Sum(low), Sum(high))

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the crank goes."""
        return self.swing.input_range

    @property
    def triangle(self) -> CrankTriangle:
        """The triangle of the cylinder and the crank's pivot, in the scene's unit."""
        g, r = self.sides
        return CrankTriangle((g * self.unscale, r * self.unscale), float(self.base), self.side)

    @property
    def starts(self) -> list[float]:
        """The middle of the crank's swing, and that of its swing in the other triangle."""
        middle = float(self.swing.middle)
        return [middle, 2 * float(self.base) - middle]

    def angle_of(self, length: float) -> float:
        """Return the crank's angle at a length of the cylinder."""
        g, r = self.sides
        sine, cosine = (length - g + r) * (length + g - r), (g + r - length) * (g + r + length)
        return float(self.base) + self.side * 2 * math.atan2(math.sqrt(sine), math.sqrt(cosine))

    def holds(self, coordinate: float, turns: int = 1) -> bool:
        """Tell whether the crank comes to an angle, whole multiples of `turns` turns aside."""
        return self.swing.holds(coordinate, turns)

    def around(self, angle: float) -> CylinderStroke:
        """Return the path with its range, by whole turns, around an angle, or nearest to it."""
        return replace(self, base=self.base + FULL_TURN.times(float(self.swing.turns_to(angle))))

    def phase_of(self, coordinate: float, near: float) -> float:
        """Return the phase nearest to `near` at which the crank stands at an angle, or at its end."""
        g, r = self.sides
        psi = abs(math.remainder(coordinate - float(self.base), 2 * math.pi))
        length = math.sqrt(g * g + r * r - 2 * g * r * math.cos(psi))
        return nearer_way(self.forth(length), near)

    def coordinates(self, phases: Array) -> Array:
        """Return the crank's angle at phases."""
        g, r = self.sides
        length = self.lengths(phases)
        sine, cosine = (length - g + r) * (length + g - r), (g + r - length) * (g + r + length)
        angles: Array = float(self.base) + self.side * 2 * np.arctan2(np.sqrt(sine), np.sqrt(cosine))
        return angles

    def phases(self, angles: Array, distances: LimitDistances | None) -> Array:
        """Return the phase at angles of the crank on the cylinder's way to `last`; NaN out of reach."""
        assert distances is not None
        g, r = self.sides
        lengths = np.sqrt(g * g + r * r - 2 * g * r * np.cos(angles - float(self.base)))
        middle, half = (self.first + self.last) / 2, (self.last - self.first) / 2
        phases = np.arccos(np.clip((middle - lengths) / half, -1.0, 1.0))
        return np.where(distances.outside.reshape(angles.shape), np.nan, phases)

    def place(self, phase: Sum) -> Sum:
        """Return the angle at a phase: a place that is passed there and back."""
        return exact_angle(float(self.coordinates(np.array([float(phase)]))[0]))

    def coordinate_at(self, place: Sum) -> float:
        """Return the angle."""
        return float(place)

    def half_squares(self, reference: Sum, ratio: Fraction) -> tuple[float, float]:
        """Return the least and greatest sin²(ψ/2), ψ = ratio × θ - reference."""
        return self.swing.half_squares(reference, ratio)

    def state(self, phase: Value, pace: Slope) -> InputState:
        """Return the input's state at a phase, in plain floats or symbolic expressions."""
        g, r = self.sides
        running = self.running(phase, pace)
        length, rate, second = running.value, running.rate, running.second
        half = self._half(phase, length)
        squares = half.squares(2 * g * r)
        turning = length * rate / squares.product
        along = (squares.cosine - squares.sine) * 0.5
        bend = (rate * rate + length * second - along * turning * turning) / squares.product
        angle = arctan2(half.sine, half.cosine) * 2.0
        return HalfState(angle, self.base, turning, bend, pace, own=half)

    def state_per_input(self, phase: Value) -> InputState:
        """Return the input's state at a phase, its rates those by the crank's angle."""
        half = self._half(phase, self.running(phase, Slope(1.0)).value)
        angle = arctan2(half.sine, half.cosine) * 2.0
        return HalfState(angle, self.base, 1.0, 0.0, Slope(1.0), own=half)

    def _half(self, phase: Value, length: Value) -> Half:
        """Return half of the triangle's angle at the crank's pivot, times `side`."""
        g, r = self.sides
        beyond, short = self._ways(sharp_half_angle(phase))
        sine, cosine = sqrt(beyond * (length + abs(g - r))), sqrt(short * (g + r + length))
        scale = 0.5 / math.sqrt(g * r)
        return half_of(sine * (scale * self.side), cosine * scale)

    def _ways(self, half: Half) -> tuple[Value, Value]:
        """Return ℓ - |g - r| and g + r - ℓ from half the phase.

        Both are sums of terms that are not negative: near the least and the greatest ℓ nothing cancels.
        """
        g, r = self.sides
        stroke, sine, cosine = self.last - self.first, half.sine, half.cosine
        least, most = sorted((self.first, self.last))
        from_least, to_most = (sine * sine, cosine * cosine) if stroke > 0 else (cosine * cosine, sine * sine)
        longer = 1.0 if g > r else -1.0
        beyond = math.fsum((least, -longer * g, -longer * self.lost, longer * r))
        short = math.fsum((g, self.lost, r, -most))
        return from_least * abs(stroke) + beyond, to_most * abs(stroke) + short

    def state_by_angle(self, graph: Graph, pace: Slope) -> tuple[tuple[str, ...], InputState]:
        """Return the names of the graph's inputs, and the input's state at its angle from the middle."""
        return ("x",), turn(graph.input("x"), pace, self.swing.middle)

    def distances(self, angle: Array) -> LimitDistances:
        """Return which angles the crank comes to; at both ends it merely turns back."""
        limits = self.swing.distances(angle)
        return replace(limits, at_limit=np.zeros_like(limits.outside))


def cylinder_stroke(linkage: Linkage, unscale: float, arcs: list[Swing] | None) -> CylinderStroke:
    """Return the path of a linkage that a cylinder drives, `arcs` being left open by the loops on its crank.

    AssemblyError where its triangle does not close, or the crank would leave these ranges.

    Of the two triangles it is the one whose range contains the stated start, or else the one in which the
    cylinder's joint lies left of the line from the crank's pivot to the fixed pin.
    """
    drive = linkage.drive
    cylinder = drive.actuator
    assert isinstance(cylinder, Cylinder)
    crank = linkage.crank(drive.joint)
    fixed, joint = cylinder.between
    ground = ground_between(linkage, crank, fixed)
    assert ground is not None
    frame = next(
        frame for frame in linkage.rigid_bodies[1:] if {crank.pivot, crank.name, joint} <= frame.keys()
    )
    arm = (frame[joint] - frame[crank.pivot]) / (frame[crank.name] - frame[crank.pivot]) * crank.length
    sides = ground.length, abs(arm)
    _check(cylinder, sides, linkage.unit)
    own = exact_angle(math.atan2(arm.imag, arm.real))
    base = ground.angle - own
    stroke = partial(CylinderStroke, cylinder.first, cylinder.last, unscale=unscale, unit=linkage.unit)
    paths = [stroke(sides, base, side, ground.rest) for side in (1, -1)]
    start = drive.stated_start
    held = (path for path in paths if start is not None and path.holds(start))
    return _with_room(next(held, paths[0]).around(drive.start), arcs)


def _with_room(path: CylinderStroke, arcs: list[Swing] | None) -> CylinderStroke:
    """Return the path that a cylinder drives; EndsError where a loop on the crank leaves it no room."""
    low, high = path.input_range
    around = [arc.shifted(arc.turns_to(float(path.swing.middle))) for arc in arcs or ()]
    if arcs is None or any(float(arc.low) < low and high < float(arc.high) for arc in around):
        return path
    within = " or ".join(f"{degrees(float(arc.low))}…{degrees(float(arc.high))}" for arc in arcs)
    raise EndsError(
        f"joint {arcs[0].ends[0]}: the cylinder would turn the crank {degrees(low)}…{degrees(high)}, "
        f"and the bars meet at {within} only; choose other ends"
    )


def _check(cylinder: Cylinder, sides: tuple[float, float], unit: str) -> None:
    low, high = abs(sides[0] - sides[1]), sum(sides)
    for length in cylinder.stated_lengths:
        if not low < length < high:
            raise EndsError(
                f"a cylinder of length {length:g} {unit} between {' and '.join(cylinder.between)}: it can be "
                f"{low:g} to {high:g} {unit} long, ends not included; choose other ends"
            )


@frozen
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

    def holds(self, coordinate: float, turns: int = 1) -> bool:
        """Tell whether the slider comes so far."""
        low, high = self.input_range
        return low <= coordinate <= high

    def phase_of(self, coordinate: float, near: float) -> float:
        """Return the phase nearest to `near` at which the slider has travelled so far, or is at its end."""
        return nearer_way(self.forth(coordinate / self.unscale), near)

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
        rate = 1.0 / stated(by_phase.rate, phase, abs(self.last - self.first) / 2)
        second = -(by_phase.second * rate * rate * rate)
        travel = Moving(by_phase.value, 1.0, 0.0)
        return TravelState(phase, Sum(0.0), rate, second, Slope(rate, second), travel=travel)

    def distances(self, angle: Array) -> NoReturn:
        """Raise BadInput: a slider has no angle."""
        raise BadInput(NO_ANGLE)

    def phases(self, angles: Array, distances: LimitDistances | None) -> NoReturn:
        """Raise BadInput: a slider has no angle."""
        raise BadInput(NO_ANGLE)

    def same(self, coordinate: float, other: float) -> bool:
        """Tell whether two places of the slider are one."""
        low, high = self.input_range
        return abs(coordinate - other) <= SAME_PLACE * (high - low)

    def distinct(self, places: Iterable[float]) -> tuple[float, ...]:
        """Return places of the slider, each once, the least first."""
        return tuple(sorted(set(places)))


def slider_stroke(linkage: Linkage, unscale: float, arcs: list[Swing] | None) -> SliderStroke:
    """Return the path of a linkage that a slider drives; no loop on a crank limits it."""
    return SliderStroke(*linkage.drive.actuator.stated_lengths, unscale=unscale, unit=linkage.unit)


STROKES: Mapping[type[Actuator], Callable[[Linkage, float, list[Swing] | None], Stroke]] = {
    Cylinder: cylinder_stroke,
    Travel: slider_stroke,
}
"""The path of each actuator; any other drives a crank, whose path its loops may limit."""
