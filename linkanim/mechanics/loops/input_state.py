"""The state of the input at one instant: its angle, rates, and the ends of its swing.

A turning input has θ = start + φ. A swinging one has θ = mid - amp·cos φ; with
u = amp cos²(φ/2) and v = amp sin²(φ/2), half the ways left to its upper and lower limit, the roots
√u and √v keep their signs, so the motion runs through both limits and back on the other closure.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from linkanim.mechanics.formulas.circular import Half, cosine_of, half_angle, sharp_half_angle, stated
from linkanim.mechanics.formulas.constant import root
from linkanim.mechanics.formulas.exact import Sum, quarter_turns, two_product, two_sum
from linkanim.mechanics.formulas.expression import Value, beside, sqrt
from linkanim.mechanics.formulas.planar import Moving, Slope

HalfForm = Callable[..., Half]
"""Returns half of an angle that is the sum of two numbers; `quarters=` are half turns beside it."""
NOTHING = 2.0**-100
"""What is less is left of equal sums of two floats."""


@dataclass(frozen=True, slots=True)
class Ends:
    """The two limits of a swing: half the way left to each, and its root, which may be `signed`.

    They lie at the angles `low` and `high`; `pace` is the derivative of what drives the input.
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

    @property
    def middle(self) -> Sum:
        """The angle in the middle."""
        return (self.low + self.high).times(0.5)

    def share_of_rate(self, upper: bool, lower: bool) -> Slope:
        """Return θ' divided by √u where `upper` and by √v where `lower`: regular by phase."""
        share = self.pace.scaled(2.0)
        share = share if upper else share * self.root_u.slope
        return share if lower else share * self.root_v.slope


@dataclass(frozen=True, slots=True)
class InputState:
    """What the input does at one instant.

    `angle` is θ without `origin`; `rate` and `second` are its derivatives in time; `pace` is the
    derivative of what drives it (φ' or θ') with its own derivative; `phase` is φ where a swing is
    driven by it. `within` is how far from zero `angle` comes, where that is known, and `rest` what the float
    lacks of it. `stated` is the origin as it was stated: its last digit may be another than that of the sum.
    """

    angle: Value
    origin: Sum
    rate: Value
    second: Value
    pace: Slope
    ends: Ends | None = None
    phase: Value | None = None
    within: float = math.inf
    rest: Value = 0.0
    stated: float | None = None

    def coordinate(self, unscale: float) -> tuple[Value, Value, Value]:
        """Return the input's coordinate with its rates: its angle; of a slider its travel, `unscale`d."""
        origin = float(self.origin) if self.stated is None else self.stated
        return self.angle + origin, self.rate, self.second

    @property
    def phase_pace(self) -> Slope:
        """φ' with its derivative, of a swing."""
        if self.ends is None or self.ends.by_phase:
            return self.pace
        return self.pace / (self.ends.root_u.slope * self.ends.root_v.slope).scaled(2.0)

    def half(self, reference: Sum, ratio: Fraction = Fraction(1), *, form: HalfForm = half_angle) -> Half:
        """Return half of ratio × θ - reference, to the last digit at any number of turns."""
        return self.half_shifted(ratio, self.origin * ratio - reference, form)

    def half_shifted(self, ratio: Fraction, shift: Sum, form: HalfForm) -> Half:
        """Return half of ratio × angle + shift.

        Half turns of the shift are kept apart where the angle stays near: a small way from where a sine or
        cosine vanishes has more digits than the angle there.
        """
        scaled, low = _scaled(self.angle, ratio)
        quarters, rest = _half_turns(shift)
        if abs(ratio) * self.within + abs(rest.high) <= _reach(form):
            return form(*_summed(scaled, low, rest), quarters=quarters)
        return form(*_summed(scaled, low, shift))


def _reach(form: HalfForm) -> float:
    """Return how far from whole half turns a form may be used without reduction."""
    return 0.75 * math.pi if form is sharp_half_angle else math.pi


def _half_turns(angle: Sum) -> tuple[int, Sum]:
    """Return the whole number of half turns nearest an angle, and what is left of it."""
    count = round(float(angle) / math.pi)
    left = angle - quarter_turns(2 * count)
    return count, left if abs(left.high) > NOTHING else Sum(0.0)


def _summed(angle: Value, low: Value, shift: Sum) -> tuple[Value, Value]:
    """Return the sum of an angle in two parts and a shift, in two parts."""
    if shift.high == 0 and shift.low == 0:
        return angle, low
    total, error = two_sum(angle, shift.high)
    return total, error + low + shift.low


@dataclass(frozen=True, slots=True)
class TravelState(InputState):
    """The state where a slider drives: `angle` is the phase that runs its travel, `half` is that of it."""

    travel: Moving = field(default_factory=lambda: Moving(0.0, 0.0, 0.0))

    def coordinate(self, unscale: float) -> tuple[Value, Value, Value]:
        """Return the slider's travel, with its rates, `unscale`d."""
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


def swing_by_phase(phase: Value, pace: Slope, low: Sum, high: Sum) -> InputState:
    """Return the state of a swing between two angles, driven by its phase."""
    half, amplitude = sharp_half_angle(phase), beside(half_way(low, high), phase)
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
    # A cosine of its own, not v - u: near the middle of the swing it keeps all its digits.
    return InputState(cosine_of(phase) * -amplitude, ends.middle, rate, second, pace, ends, phase, amplitude)


def swing_per_input(phase: Value, low: Sum, high: Sum) -> InputState:
    """Return the state of a swing at a phase, its rates those by its own angle: infinite at a limit."""
    half, amplitude, pace = sharp_half_angle(phase), half_way(low, high), Slope(1.0)
    scale = math.sqrt(amplitude)
    roots = [stated(side, phase, 0.5) * scale for side in (half.cosine, half.sine)]
    root_u, root_v = (_rated(root, sign, pace) for root, sign in zip(roots, (-1.0, 1.0), strict=True))
    u, v = roots[0] * roots[0], roots[1] * roots[1]
    ends = Ends(Slope(u, -0.5), Slope(v, 0.5), root_u, root_v, pace, low, high, by_phase=False)
    return InputState(cosine_of(phase) * -amplitude, ends.middle, 1.0, 0.0, pace, ends, phase, amplitude)


def swing_by_angle(
    ways: tuple[Value, Value, Value], pace: Slope, low: Sum, high: Sum, rest: Value = 0.0
) -> InputState:
    """Return the state of a swing driven by its angle.

    `ways` are the angle from the middle, of which a float lacks the `rest`, and half of what is left to the
    upper and the lower limit.
    """
    angle, u, v = ways
    root_u, root_v = (_rated(sqrt(way), sign, pace) for way, sign in ((u, -1.0), (v, 1.0)))
    half_rate = pace.value * 0.5
    ways_left = Slope(u, -half_rate), Slope(v, half_rate)
    ends = Ends(*ways_left, root_u, root_v, pace, low, high, by_phase=False, signed=False)
    within = half_way(low, high)
    return InputState(angle, ends.middle, pace.value, pace.rate, pace, ends, within=within, rest=rest)


def half_way(low: Sum, high: Sum) -> float:
    """Return half of the way from one angle to another."""
    return (high - low).times(0.5).constant


def _rated(root: Value, sign: float, pace: Slope) -> Moving:
    """Return a root of half the way to a limit with its rates."""
    rate = pace.value * (0.25 * sign) / root
    return Moving(root, rate, (pace.rate * (0.25 * sign) - rate * rate) / root)
