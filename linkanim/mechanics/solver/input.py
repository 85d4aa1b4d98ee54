"""Move the input: its state at one instant, and its path over the phase, turning or swinging.

Its parts, in reading order:

- The state of the input at one instant: its angle, rates, and the ends of its swing.
- The path of the input: how far it goes, how its phase moves it, when everything is back.
- The path of an input that turns fully.
- The path of an input that swings between two limits.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import field, replace
from decimal import localcontext
from fractions import Fraction
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.angles import (
    FULL_TURN,
    Half,
    Sum,
    cosine_of,
    exact_angle,
    half_angle,
    quarter_turns,
    sharp_half_angle,
    stated,
    two_product,
    two_sum,
)
from linkanim.mechanics.arithmetic import (
    Graph,
    Moving,
    Slope,
    Value,
    are_inputs,
    minimum,
    recorded_with,
    root,
    select,
    sqrt,
)
from linkanim.mechanics.linkage import CrankTriangle
from linkanim.mechanics.precise import context, cosine, exactly, nearest_sum, sine
from linkanim.mechanics.program import Array
from linkanim.mechanics.tolerances import AT_END, NEARLY_ZERO, SAME_PLACE, STATED, TWO_FLOATS

# The state of the input at one instant: its angle, rates, and the ends of its swing.
#
# A turning input has θ = start + φ. A swinging one has θ = mid - amp·cos φ; with
# u = amp cos²(φ/2) and v = amp sin²(φ/2), half the ways left to its upper and lower limit, the roots
# √u and √v keep their signs, so the motion runs through both limits and back on the other closure.

HalfForm = Callable[..., Half]
"""Returns half of an angle, the sum of two numbers; `quarters=` are half turns to be added to the angle."""


@frozen
class Ends:
    """The two limits of a swing: half the distance left to each, and its root, which may be `signed`.

    They lie at the angles `low` and `high`; `pace` is the rate of the phase, or of the angle, that is given.
    """

    u: Slope
    v: Slope
    root_u: Moving
    root_v: Moving
    pace: Slope
    low: Sum
    high: Sum
    by_phase: bool
    signed: bool = True

    def share_of_rate(self, upper: bool, lower: bool) -> Slope:
        """Return θ' divided by √u where `upper` and by √v where `lower`: regular by phase."""
        share = self.pace.scaled(2.0)
        share = share if upper else share * self.root_u.slope
        return share if lower else share * self.root_v.slope


@frozen
class InputState:
    """What the input does at one instant.

    `angle` is θ less `origin`; `rate` and `second` are its derivatives in time; `pace` is φ' or θ', whichever
    is given, with its own derivative; `phase` is φ where a swing is given by it. `within` is how far from
    zero `angle` comes, where that is known, and `rest` is what the float `angle` lacks. `stated` is the
    origin as it was stated: its last digit may differ from that of the sum.
    """

    angle: Value
    origin: Sum
    rate: Value
    second: Value
    pace: Slope
    ends: Ends | None = None
    phase: Value | None = None
    within: Value = math.inf
    rest: Value = 0.0
    stated: float | None = None

    def coordinate(self, unscale: float) -> tuple[Value, Value, Value]:
        """Return the input's coordinate and its two rates: an angle, or a slider's travel times `unscale`."""
        origin = self.origin.constant if self.stated is None else self.stated
        return self.angle + origin, self.rate, self.second

    @property
    def phase_pace(self) -> Slope:
        """φ' with its derivative, of a swing."""
        if self.ends is None or self.ends.by_phase:
            return self.pace
        return self.pace / (self.ends.root_u.slope * self.ends.root_v.slope).scaled(2.0)

    def half(
        self,
        reference: Sum,
        ratio: Fraction = Fraction(1),
        *,
        form: HalfForm = half_angle,
        sharp: bool = False,
    ) -> Half:
        """Return half of ratio × θ - reference, to the last digit at any number of turns.

        Of a swing that is a digit of its amplitude; where `sharp`, next to both ends one of the angle itself.
        """
        shift = self.origin * ratio - reference
        if not sharp or self.ends is None or _half_turns(shift)[1] == Sum(0.0):
            return self.half_shifted(ratio, shift, form)
        angle, rest = self._from_nearer_end(self.ends)
        scaled, low = _scaled(angle, ratio)
        return form(*_summed(scaled, low + rest * float(ratio), shift))

    def _from_nearer_end(self, ends: Ends) -> tuple[Value, Value]:
        """Return the angle of a swing in two parts; by phase from the nearer end, where the way is exact."""
        if self.phase is None:
            return self.angle, self.rest
        u, v, most = ends.u.value, ends.v.value, (ends.high - ends.low).times(0.5)
        angle, rest = two_sum(minimum(u, v) * 2.0, -most.high)
        side = select(v, u, 1.0, -1.0)
        return angle * side, (rest - most.low) * side

    def half_shifted(self, ratio: Fraction, shift: Sum, form: HalfForm) -> Half:
        """Return half of ratio × angle + shift.

        Half turns of the shift are kept apart where the angle stays near zero: a small distance from the zero
        of a sine or cosine has more digits than the whole angle.
        """
        scaled, low = _scaled(self.angle, ratio)
        if are_inputs(shift.high):
            return form(*_summed(scaled, low, shift))
        quarters, rest = _half_turns(shift)
        if float(abs(ratio)) * self.within + abs(rest.high) <= _reach(form):
            return form(*_summed(scaled, low, rest), quarters=quarters)
        return form(*_summed(scaled, low, shift))


def _reach(form: HalfForm) -> float:
    """Return how far from zero an angle may be for a form to take it without reduction (rad)."""
    return 0.75 * math.pi if form is sharp_half_angle else math.pi


def _half_turns(angle: Sum) -> tuple[int, Sum]:
    """Return the whole number of half turns nearest an angle, and what is left of it."""
    count = round(float(angle) / math.pi)
    remainder = angle - quarter_turns(2 * count)
    return count, remainder if abs(remainder.high) > TWO_FLOATS else Sum(0.0)


def _summed(angle: Value, low: Value, shift: Sum) -> tuple[Value, Value]:
    """Return the sum of an angle in two parts and a shift, in two parts."""
    if shift == Sum(0.0):
        return angle, low
    total, error = two_sum(angle, shift.high)
    return total, error + low + shift.low


@frozen
class TravelState(InputState):
    """The state where a slider drives: `angle` is the phase of its travel, and `half` halves that phase."""

    travel: Moving = field(default_factory=lambda: Moving(0.0, 0.0, 0.0))

    def coordinate(self, unscale: float) -> tuple[Value, Value, Value]:
        """Return the slider's travel and its two rates, each times `unscale`."""
        return self.travel.value * unscale, self.travel.rate * unscale, self.travel.second * unscale


def _scaled(x: Value, ratio: Fraction) -> tuple[Value, Value]:
    """Return ratio × x rounded, and what rounding lost."""
    p, q = float(ratio.numerator), float(ratio.denominator)
    product, lost = two_product(x, p) if abs(p) != 1 else (x * p, 0.0)
    if q == 1:
        return product, lost
    quotient = product / q
    if math.frexp(q)[0] == 0.5:
        return quotient, lost / q
    back, error = two_product(quotient, q)
    return quotient, ((product - back) - error + lost) / q


def turn(x: Value, pace: Slope, origin: Sum) -> InputState:
    """Return the state of an input that turns fully: θ = origin + x."""
    return InputState(x, origin, pace.value, pace.rate, pace)


def swing_by_phase(
    phase: Value, pace: Slope, low: Sum, high: Sum, span: tuple[Sum, Value] | None = None
) -> InputState:
    """Return the state of a swing between two angles, driven by its phase.

    `span` is the middle of both, and how far they are from it.
    """
    middle, way = span or (middle_of(low, high), half_way(low, high))
    half, amplitude = sharp_half_angle(phase), recorded_with(way, phase)
    scale = root(amplitude)
    root_u, root_v = half.cosine * scale, half.sine * scale
    half_rate, bend = pace.value * 0.5, pace.rate * 0.5
    square = half_rate * half_rate
    u, v, both = root_u * root_u, root_v * root_v, root_u * root_v
    ends = Ends(
        Slope(u, -(both * pace.value)),
        Slope(v, both * pace.value),
        Moving(root_u, -(root_v * half_rate), -(root_u * square) - root_v * bend),
        Moving(root_v, root_u * half_rate, root_u * bend - root_v * square),
        pace,
        low,
        high,
        by_phase=True,
    )
    rate = (both + both) * pace.value
    second = (both + both) * pace.rate + (u - v) * (pace.value * pace.value)
    # The cosine itself instead of v - u: near the middle of the swing it keeps all its digits.
    return InputState(cosine_of(phase) * -amplitude, middle, rate, second, pace, ends, phase, amplitude)


def swing_per_input(phase: Value, low: Sum, high: Sum) -> InputState:
    """Return the state of a swing at a phase, its rates those by its own angle: infinite at a limit."""
    half, amplitude, pace = sharp_half_angle(phase), half_way(low, high), Slope(1.0)
    scale = math.sqrt(amplitude)
    roots = [stated(side, phase, 0.5) * scale for side in (half.cosine, half.sine)]
    root_u, root_v = (_rated(root, sign, pace) for root, sign in zip(roots, (-1.0, 1.0), strict=True))
    u, v = roots[0] * roots[0], roots[1] * roots[1]
    ends = Ends(Slope(u, -0.5), Slope(v, 0.5), root_u, root_v, pace, low, high, by_phase=False)
    return InputState(
        cosine_of(phase) * -amplitude, middle_of(low, high), 1.0, 0.0, pace, ends, phase, amplitude
    )


def swing_by_angle(
    ways: tuple[Value, Value, Value], pace: Slope, low: Sum, high: Sum, rest: Value = 0.0
) -> InputState:
    """Return the state of a swing driven by its angle.

    `ways` are the angle from the middle, and half the distances to the upper and the lower limit. `rest` is
    what the float lacks of that angle.
    """
    angle, u, v = ways
    root_u, root_v = (_rated(sqrt(way), sign, pace) for way, sign in ((u, -1.0), (v, 1.0)))
    half_rate = pace.value * 0.5
    ways_left = Slope(u, -half_rate), Slope(v, half_rate)
    ends = Ends(*ways_left, root_u, root_v, pace, low, high, by_phase=False, signed=False)
    within = half_way(low, high)
    return InputState(
        angle, middle_of(low, high), pace.value, pace.rate, pace, ends, within=within, rest=rest
    )


def middle_of(low: Sum, high: Sum) -> Sum:
    """Return the angle in the middle of two."""
    return (low + high).times(0.5)


def half_way(low: Sum, high: Sum) -> Any:
    """Return half of the way from one angle to another."""
    return (high - low).times(0.5).constant


def _rated(root: Value, sign: float, pace: Slope) -> Moving:
    """Return a root of half the distance to a limit, with its rates."""
    rate = pace.value * (0.25 * sign) / root
    return Moving(root, rate, (pace.rate * (0.25 * sign) - rate * rate) / root)


# The path of the input: how far it goes, how its phase moves it, when everything is back.
#
# A path is found once for a linkage; every pose is computed from it. `InputPath` says what every path
# answers, `ThereAndBack` is the base of paths that turn back, `strokes.Stroke` that of paths that a length
# drives.

Limit = tuple[Sum, str | None]
"""The phase of a limit, and the dyad that sets it; None where the path itself ends."""


Shortened = tuple[Sum, Sum, tuple[str, str], int]
"""What a path is cut back to: its two end angles, the dyads that limit it there, and its `repeats`."""


@frozen
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
    def keeps(self) -> tuple[bool, bool]:
        """Whether all comes back as it went, on the same closures, at the lower and at the upper end."""
        return False, False

    @property
    def way(self) -> tuple[float, float] | None:
        """The first and the last phase of a way that all others retrace, from one kept end to the next."""
        return None

    def passes(self, phases: Array) -> NDArray[np.bool_]:
        """Tell which phases are the input's own: not those that retrace others."""
        first, last = self.way or (-math.inf, math.inf)
        return (phases >= first - AT_END) & (phases <= last + AT_END)

    @property
    def triangle(self) -> CrankTriangle | None:
        """The triangle by which a cylinder turns the crank, in the scene's unit; None without one."""
        return None

    @property
    def starts(self) -> list[float]:
        """Starts that lead to its ranges, where these follow from the input alone."""
        return []

    @property
    def dead_ends(self) -> tuple[float, ...]:
        """The ends at which a dyad may be at its limit though it does not stop the input."""
        return ()

    def doubled(self) -> Self:
        """Return the path of a linkage that is back after twice as many periods."""
        return replace(self, rounds=2 * self.rounds)

    @abstractmethod
    def holds(self, coordinate: float, turns: int = 1) -> bool:
        """Tell whether the input comes to a place; for an angle, whole multiples of `turns` turns aside."""

    @abstractmethod
    def phase_of(self, coordinate: float, near: float) -> float:
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
    def around_start(
        self, start: float, phases: Array, rows: NDArray[Any]
    ) -> tuple[Array, NDArray[Any], int]:
        """Return phases around the start, the `rows` (D, N) for these phases, and the start's index."""

    @abstractmethod
    def cut(self, low: Limit, high: Limit) -> Shortened:
        """Return the part of the path between two phases; AssemblyError where it may not be shorter."""

    def place(self, phase: Sum) -> Sum:
        """Return what names the place at a phase: the phase itself where the two ways are distinct."""
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
        """Return the arguments of the program by angle: the angle, and what else gives the state."""
        return (distances.angle,)

    def same(self, coordinate: float, other: float) -> bool:
        """Tell whether two places of the input are one."""
        return abs(math.remainder(coordinate - other, 2 * math.pi)) <= SAME_PLACE

    def distinct(self, places: Iterable[float]) -> tuple[float, ...]:
        """Return places of the input, angles within one turn, each once, the least first."""
        inputs: list[float] = []
        for coordinate in sorted(
            math.remainder(coordinate, 2 * math.pi) % (2 * math.pi) for coordinate in places
        ):
            if not any(self.same(coordinate, other) for other in inputs):
                inputs.append(coordinate)
        return tuple(inputs)


@frozen
class ThereAndBack(InputPath):
    """A path on which the input turns back at both ends, where its phase is 0 and π."""

    keeps: tuple[bool, bool] = field(default=(False, False), kw_only=True)

    full_turn: ClassVar[bool] = False

    @property
    def way(self) -> tuple[float, float] | None:
        """The first and the last phase of a way that all others retrace, from one kept end to the next."""
        low, high = self.keeps
        return (0.0 if low else -math.pi, math.pi if high else 2 * math.pi) if low or high else None

    def doubled(self) -> Self:
        """Return the path of a linkage that is back after twice as many periods; as it is with a way."""
        return self if self.way else super().doubled()

    def home(self, start: float) -> float:
        """Return the phase of the start on the way to the far end, at most that of an end."""
        return self.phase_of(start, 0.0)

    def around_start(
        self, start: float, phases: Array, rows: NDArray[Any]
    ) -> tuple[Array, NDArray[Any], int]:
        """Return the phases of the way to the far end, the `rows` (D, N) for these, and the start's index."""
        up = (phases >= 0) & (phases <= math.pi)
        return phases[up], rows[:, up], int(np.abs(phases[up] - self.home(start)).argmin())


def nearer_way(forth: float, near: float) -> float:
    """Return the phase nearest to `near` among ±forth, whole turns aside: of a place passed both ways."""
    ways = (near + math.remainder(phase - near, 2 * math.pi) for phase in (forth, -forth))
    return min(ways, key=lambda phase: abs(phase - near))


def retraced(phases: Any, way: tuple[float, float]) -> tuple[Any, Any]:
    """Return the phases of the same poses on an `InputPath.way`, and +1 or -1.

    The sign is that of its rates: +1 on that way and at both its ends, -1 on the way back. A phase within its
    last digits of a multiple of π is an end (`stated`).
    """
    first, last = way
    half = last - first
    within, whole = np.fmod(phases, 2 * half), FULL_TURN.times(half / math.pi)
    within = within - np.rint((phases - within) / whole.high) * whole.low
    within = np.where(within > last, within - 2 * half, within)
    within = np.where(within < first - half, within + 2 * half, within)
    near, at = STATED * np.hypot(phases, math.pi), np.where(within < first, 2 * first - within, within)
    back = np.where((within < first - near) & (within > first - half + near), -1.0, 1.0)
    # after many turns a phase's last digits are coarser than those of the end
    end = math.pi * np.rint(at / math.pi)
    return np.where((np.abs(phases) >= 2 * math.pi) & (np.abs(at - end) <= near), end, at), back


@frozen
class LimitDistances:
    """How far angles are from the limits of a swing.

    `angle` is measured from the swing's middle, and `rest` is what the float lacks of it; `u` and `v` are
    half the distances to its upper and its lower limit. An angle is `outside` the swing, or `at_limit`: as
    near to a limit as a float can be.
    """

    angle: Array
    rest: Array
    u: Array
    v: Array
    outside: NDArray[np.bool_]
    at_limit: NDArray[np.bool_]

    @property
    def snapped(self) -> LimitDistances:
        """The same distances, with the smaller of u and v set to zero for angles at a limit."""
        pairs = (self.u, self.v), (self.v, self.u)
        u, v = (np.where(self.at_limit & (way <= other), 0.0, way) for way, other in pairs)
        return replace(self, u=u, v=v)


# The path of an input that turns fully.


@frozen
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

    def holds(self, coordinate: float, turns: int = 1) -> bool:
        """Tell whether the input comes to an angle: to every one."""
        return True

    def phase_of(self, coordinate: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, whole turns aside."""
        return near + math.remainder(coordinate - self.start - near, 2 * math.pi)

    def coordinates(self, phases: Array) -> Array:
        """Return the input's angle at phases."""
        return phases + self.start if self.start else phases

    def phases(self, angles: Array, distances: LimitDistances | None) -> Array:
        """Return the phase at angles of the input."""
        return angles - self.start if self.start else angles

    def home(self, start: float) -> float:
        """Return the phase of the start."""
        return 0.0

    def around_start(
        self, start: float, phases: Array, rows: NDArray[Any]
    ) -> tuple[Array, NDArray[Any], int]:
        """Return phases continued on both sides of the start, their `rows` (D, N), and the start's index."""
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


# The path of an input that swings between two limits.

SOLVED_FROM = ("x", "u", "v", "rest")


@frozen
class Swing(ThereAndBack):
    """The input swings between two limits; `ends` are the dyads that limit it at each.

    An end without a name is no limit: the input turns back there, and every closure holds.
    `repeats` is the number of turns of the input after which the linkage would be the same (more
    than one with gears).
    """

    low: Sum
    high: Sum
    ends: tuple[str, str] = ("", "")
    repeats: int = 1

    @property
    def periods(self) -> int:
        """One there-and-back; two where a different dyad changes its closure at each end."""
        if any(self.keeps):
            return 1 if all(self.keeps) else 2
        return self.rounds if self.ends[0] == self.ends[1] else 2 * self.rounds

    @property
    def middle(self) -> Sum:
        """The angle in the middle of the swing."""
        return middle_of(self.low, self.high)

    @property
    def amplitude(self) -> float:
        """Half the angle of the swing."""
        half: float = half_way(self.low, self.high)
        return half

    @property
    def limits(self) -> tuple[float, ...]:
        """The angles at which a dyad stops the input; an end at which it merely turns back is none."""
        ends = zip(self.input_range, self.ends, strict=True)
        return tuple(end for end, dyad in ends if dyad)

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the input goes (rad); an end that differs from 0 by rounding alone is 0."""
        low, high = (float(end) for end in (self.low, self.high))
        return low if abs(low) > STATED * math.pi else 0.0, high if abs(high) > STATED * math.pi else 0.0

    def holds(self, coordinate: float, turns: int = 1) -> bool:
        """Tell whether the input comes to an angle, whole multiples of `turns` turns aside."""
        return abs(math.remainder(coordinate - float(self.middle), 2 * math.pi * turns)) <= self.amplitude

    def phase_of(self, coordinate: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at an angle, or at its limit."""
        away = math.remainder(coordinate - float(self.middle), 2 * math.pi)
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
        """Return the angle at a phase on the way up, from the nearer end: so it is exact next to both."""
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
        """Return the arguments of the program by angle: `angle`, `u`, `v` and `rest` of the distances."""
        return distances.angle, distances.u, distances.v, distances.rest

    @np.errstate(all="ignore")
    def distances(self, angle: Array) -> LimitDistances:
        """Return how far angles are from the low end, the middle and the high end, whole turns aside.

        After `repeats` turns of the input the linkage is the same; they are taken off without rounding.
        The float nearest a limit counts as the limit and is never outside; nor is 0 where a limit differs
        from 0 by rounding alone.
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
