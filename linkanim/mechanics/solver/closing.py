"""Close every kind of joint, one after the other, in one walk over the linkage.

Its parts, in reading order:

- The signed root of a dyad on moving points that limits the input, or passes change points.
- A linkage put together, as data, and one walk over it: what is known of its joints so far.
- How each kind of joint closes, and the one list of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from decimal import localcontext
from fractions import Fraction
from functools import cached_property, partial
from itertools import accumulate
from operator import mul
from typing import TYPE_CHECKING, Any, NamedTuple

from linkanim.errors import AssemblyError, DyadAtLimit
from linkanim.frozen import frozen
from linkanim.mechanics.angles import (
    Half,
    Sum,
    exact_angle,
    half_angle,
    quarter_turns,
    sharp_half_angle,
    snapped,
    unit,
)
from linkanim.mechanics.arithmetic import (
    Constant,
    Expr,
    Moving,
    MovingPoint,
    Slope,
    Value,
    Vec,
    are_inputs,
    carried,
    maximum,
    minimum,
    select,
    sqrt,
    usual,
)
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Brace,
    Crank,
    DrivenSlider,
    Joint,
    Line,
    Linkage,
    Pin,
    Point,
    Rigid,
    holding,
)
from linkanim.mechanics.precise import context, cosine, direction, exactly, nearest_sum
from linkanim.mechanics.program import Array
from linkanim.mechanics.search import around, samples_a_turn
from linkanim.mechanics.solver.input import InputPath, InputState, TravelState
from linkanim.mechanics.solver.loop import (
    Gearing,
    Loop,
    PinLoop,
    Triangle,
    aside_of,
    gearings,
    moving_factors,
    moving_square,
    moving_triangle,
    own_loop,
    pin_against_pin,
    pin_triangle,
    place,
)
from linkanim.mechanics.solver.signed_root import (
    Reduced,
    SignedRoot,
    four_bar_root,
    plain_root,
    rated_root,
    slider_root,
    slot_root,
)
from linkanim.mechanics.tolerances import AT_END, BESIDE_AN_END, SMALLEST
from linkanim.words import to_say

if TYPE_CHECKING:
    from linkanim.mechanics.solver.courses import GroupMotion

# The signed root of a dyad on moving points that limits the input, or passes change points.
#
# Its margin F = U·W is a difference of rounded coordinates, and has no digits left where it vanishes: q = √F
# would keep half of them. So each zero has a smooth signed distance z: the root of half the distance to a
# limit, or the sine of half the distance to a change point. There F = z²·R² with R smooth and positive, and
# next to the zero q = z·R, R being a polynomial fitted once in fifty digits (in `limits`). Then
#
#     q' = d(zR)/dz z'        ρ = q'/((U - W)/2)
#
# need no digits of F or of its rates, and stay finite through limits and change points. Between the zeros
# F keeps its digits: there q = ±√F, its sign on the smooth path being the product of the signs of all z.
#
# Where F comes near zero and turns back, at an extreme of the separation, its least value F₀ is found in
# fifty digits, too, and R² is fitted: there q = ±√(F₀ + r²), r = z·R, z the sine of half the distance from
# that place, and
#
#     q' = r r'/q        q'' = (r r'' + r'² F₀/q²)/q


class PolynomialFit(NamedTuple):
    """A smooth function for arguments up to `width`: a polynomial in (x - centre)/half."""

    width: float
    centre: float
    half: float
    coefficients: tuple[float, ...]

    def at(self, x: Moving) -> Moving:
        """Return the function of what moves, with its rates (Horner's scheme, and the chain rule)."""
        t = (x.value - self.centre) * (1.0 / self.half)
        value: Value = self.coefficients[-1]
        first: Value = 0.0
        second: Value = 0.0
        for coefficient in self.coefficients[-2::-1]:
            second = second * t + first
            first = first * t + value
            value = value * t + coefficient
        rate, bend = x.rate * (1.0 / self.half), x.second * (1.0 / self.half)
        return Moving(value, first * rate, second * (rate * rate * 2.0) + first * bend)


class SignedDistance(NamedTuple):
    """A signed distance z from a zero, and the argument of the polynomial there; `share` is z over it.

    A turn later the argument is the same and z has the other sign.
    """

    z: Moving
    argument: Moving
    share: Value = 1.0


class Near(NamedTuple):
    """The fits next to a zero: R, and D over the argument where the ends of equal bars meet there.

    `least` is the margin's least value where that is not zero: then R² is fitted. From a limit on, R has
    further fits `beyond` the first, where the margin stays low for long.
    """

    root: PolynomialFit
    across: tuple[PolynomialFit, PolynomialFit] | None = None
    least: float = 0.0
    beyond: tuple[PolynomialFit, ...] = ()

    @property
    def width(self) -> float:
        """How far from the zero the fits hold."""
        return (self.root, *self.beyond)[-1].width

    def smooth(self, argument: Moving) -> Moving:
        """Return R, or R²."""
        value, inner = self.root.at(argument), self.root.width
        for fit in self.beyond:
            pairs = zip(value, fit.at(argument), strict=True)
            value = Moving(*(select(argument.value, inner, near, far) for near, far in pairs))
            inner = fit.width
        return value

    def root_at(self, z: Moving, fitted: Moving) -> Moving:
        """Return √(least + z²R²)."""
        if not self.least:
            return z * fitted
        part = z * _root(fitted)
        root = sqrt(part.value * part.value + self.least)
        share, rate = part.value / root, part.rate / root
        return Moving(root, share * part.rate, share * part.second + rate * rate * (self.least / root))


@frozen
class End:
    """A limit that the dyad sets, at the swing's upper or its lower end: z² is half the distance to it."""

    upper: bool
    near: Near | None = None

    def distance(self, state: InputState) -> SignedDistance:
        """Return the signed distance to the limit."""
        assert state.ends is not None
        ends = state.ends
        z, half = (ends.root_u, ends.u) if self.upper else (ends.root_v, ends.v)
        return SignedDistance(z, Moving(half.value, half.rate, (z * z).second))

    def chosen(self, distance: SignedDistance, width: float, close: Value, otherwise: Value) -> Value:
        """Return `close` within the width, else the other."""
        return select(distance.argument.value, width, close, otherwise)


@frozen
class Stationary:
    """A change point or a near touch: z is the sine of half the distance from it, the argument its tangent.

    `place` is an angle for an input that turns, a phase for one that swings: there the dyads before this one
    may be on different closures on the two ways. `amplitude` is that of the swing. The place repeats after
    `turns` drive periods (for a swing, a power of two).
    """

    place: Sum
    turns: int
    amplitude: float | None
    near: Near | None = None

    def distance(self, state: InputState) -> SignedDistance:
        """Return the signed distance from the place."""
        turn = self._on_turn(state) if self.amplitude is None else self._on_swing(state, self.amplitude)
        sine, cosine = turn
        return SignedDistance(sine, _quotient(sine, cosine), cosine.value)

    def _on_turn(self, state: InputState) -> SineAndCosine:
        share = Fraction(1, self.turns)
        half = state.half(self.place * share, share)
        return _turning(half.sine, half.cosine, Slope(state.rate, state.second).scaled(0.5 / self.turns))

    def _on_swing(self, state: InputState, amplitude: float) -> SineAndCosine:
        assert state.ends is not None
        if state.phase is not None:
            away = (state.phase - self.place.high) - self.place.low
            half = sharp_half_angle(away * (1.0 / self.turns))
            return _turning(half.sine, half.cosine, state.phase_pace.scaled(0.5 / self.turns))
        scale = 1.0 / math.sqrt(amplitude)
        sine, cosine = state.ends.root_v.scaled(scale), state.ends.root_u.scaled(scale)
        for _ in range(self.turns.bit_length() - 1):
            sine, cosine = _halved(sine, cosine)
        half_way = float(self.place) / (2 * self.turns)
        along, aside = math.cos(half_way), math.sin(half_way)
        apart = sine.scaled(along) + cosine.scaled(-aside)
        if self.turns == 1 and math.sin(float(self.place)) > BESIDE_AN_END:
            both = sine.value * along + cosine.value * aside
            apart = apart._replace(value=self._way_left(state, amplitude) / (both * (2.0 * amplitude)))
        return apart, cosine.scaled(along) + sine.scaled(aside)

    def _way_left(self, state: InputState, amplitude: float) -> Value:
        """Return how far the input's angle θ is from the place on its way up.

        That is 2 amp sin((φ - φ₀)/2) sin((φ + φ₀)/2).
        """
        with localcontext(context()):
            gone = nearest_sum(-exactly(amplitude) * cosine(exactly(self.place)))
        away: Value = (state.angle - gone.high) + (state.rest - gone.low)
        return away

    def chosen(self, distance: SignedDistance, width: float, close: Value, otherwise: Value) -> Value:
        """Return `close` within the width, else the other."""
        z = distance.z.value
        return select(z * z, width * width / (1.0 + width * width), close, otherwise)


SineAndCosine = tuple[Moving, Moving]
"""Sine and cosine of a moving angle."""


def _turning(sine: Value, cosine: Value, rate: Slope) -> SineAndCosine:
    """Return sine and cosine with their rates where the angle itself has that rate."""
    first, second, square = rate.value, rate.rate, rate.value * rate.value
    return (
        Moving(sine, cosine * first, cosine * second - sine * square),
        Moving(cosine, -(sine * first), -(sine * second) - cosine * square),
    )


def _quotient(a: Moving, b: Moving) -> Moving:
    """Return the quotient of two moving numbers, with its rates."""
    value = a.value / b.value
    rate = (a.rate - value * b.rate) / b.value
    return Moving(value, rate, (a.second - value * b.second - rate * b.rate * 2.0) / b.value)


def _halved(sine: Moving, cosine: Moving) -> SineAndCosine:
    """Return sine and cosine of half an angle between 0 and π."""
    half_cosine = sqrt((cosine.value + 1.0) * 0.5)
    rate = Slope(
        sine.rate * cosine.value - cosine.rate * sine.value,
        sine.second * cosine.value - cosine.second * sine.value,
    )
    return _turning(sine.value * 0.5 / half_cosine, half_cosine, rate.scaled(0.5))


class Touch(Stationary):
    """A change point: the margin touches zero, and the root changes its sign."""


class NearTouch(Stationary):
    """A place where the margin comes near zero, and turns back."""

    def rates(self, closing: Closing, q: Moving, state: InputState) -> Slope:
        """Return ρ of the root q: by the angle of a swing, plainly near its ends, or where the place is one.

        What is smooth in the phase has no digits of its rates by the angle there.
        """
        fitted = closing.rates(q)
        if self.amplitude is None or state.ends is None or state.phase is not None:
            return fitted
        sine = math.sin(float(self.place))
        near = self.amplitude**2 / 4 * (sine * sine / 4 if abs(sine) > AT_END else 1.0)
        plain = rated_root(q.value, closing.separation, closing.half_difference).ratio
        aside = state.ends.u.value * state.ends.v.value
        return Slope(*(select(aside, near, one, other) for one, other in zip(plain, fitted, strict=True)))


Zero = End | Touch
Fitted = Zero | NearTouch


class Closing(NamedTuple):
    """What closes a dyad on moving points: U, W, the separation they depend on, and D where it has two ends.

    `separation` is L² between two ends (`squared`), or how far a single end lies beside its line. W' is the
    separation's rate, U' is minus that. `half_difference` is (U - W)/2, or 1/2 for a `single` root, which has
    no U.
    """

    u: Value
    w: Value
    separation: Moving
    single: bool
    across: MovingPoint | None
    squared: bool = True

    @property
    def half_difference(self) -> Value:
        """(U - W)/2: q' is ρ times that."""
        return 0.5 if self.single else (self.u - self.w) * 0.5

    @property
    def size(self) -> Value:
        """The scale of the margin: (U + W)², which is 16a²b² for two bars, or L²."""
        return self.separation.value if self.single else (self.u + self.w) * (self.u + self.w)

    @property
    def gap(self) -> Value:
        """How far the dyad is from its nearer limit, as a length: by how much its ends may still move."""
        if not self.squared:
            return minimum(self.u, self.w)
        distance = sqrt(self.separation.value)
        least = sqrt(maximum(self.separation.value - self.w, 0.0))
        folded = self.w / maximum(distance + least, SMALLEST)
        if self.single:
            return folded
        most = sqrt(self.separation.value + self.u)
        return minimum(self.u / maximum(distance + most, SMALLEST), folded)

    def rates(self, q: Moving) -> Slope:
        """Return ρ of a root that is known with its rates: from q', or from (L²)' where U and W are alike.

        Where U = W, q is at its greatest, and q'/((U - W)/2) is 0/0.
        """
        half, (rate, second) = self.half_difference, (self.separation.rate, self.separation.second)
        if self.single:
            return Slope(q.rate / half, q.second / half)

        def chosen(alike: Value, otherwise: Value) -> Value:
            return select(half * half * 16.0, self.size, alike, otherwise)

        divisor = chosen(q.value, half)
        ratio = chosen(rate, q.rate) / divisor
        # (U - W)' is -2 (L²)'.
        bent = chosen(second - ratio * ratio * half, q.second + ratio * rate)
        return Slope(ratio, bent / divisor)


@frozen
class ChainRoot:
    """The zeros of one dyad's root; `sign` makes the closure that is named the one just after the start.

    Below `least` the margin has no digits left.
    """

    zeros: tuple[Zero, ...]
    least: float
    sign: float = 1.0
    near_touches: tuple[NearTouch, ...] = ()

    @property
    def change_points(self) -> Iterator[Sum]:
        """The places (see `InputPath.place`) at which the root changes its sign and the input goes on."""
        return (zero.place for zero in self.zeros if isinstance(zero, Touch))

    def root(self, closing: Closing, state: InputState) -> SignedRoot:
        """Return q and ρ, signed and finite through every zero."""
        margin = maximum(closing.u * closing.w, self.least)
        plain = plain_root(margin, 1.0, closing.separation, closing.half_difference)
        away = [zero.distance(state) for zero in self.zeros]
        side, others = self._sides(away)
        root = SignedRoot(plain.q * side, Slope(plain.ratio.value * side, plain.ratio.rate * side))
        if any(zero.near and zero.near.across for zero in self.zeros) and closing.across:
            root = root.with_altitude(Reduced(closing.across, root.q))
        for near_touch in self.near_touches:
            if near_touch.near is not None:
                there = near_touch.distance(state), side
                root = _root_near(near_touch, near_touch.near, closing, there, root, state)
        for zero, there in zip(self.zeros, zip(away, others, strict=True), strict=True):
            if zero.near is not None:
                root = _root_near(zero, zero.near, closing, there, root, state)
        return root

    def side(self, state: InputState) -> Value:
        """Return the sign of the closure on the smooth path."""
        return self._sides([zero.distance(state) for zero in self.zeros])[0]

    def _sides(self, away: Sequence[SignedDistance]) -> tuple[Value, list[Value]]:
        """Return the sign of the closure on the smooth path, and for each zero the sign without its share."""
        signs = [_sign(distance.z.value) for distance in away]
        before = [*accumulate(signs, mul, initial=self.sign)]
        after = [*accumulate(reversed(signs), mul, initial=1.0)]
        return before[-1], [one * other for one, other in zip(before, after[-2::-1], strict=False)]


def _root_near(
    zero: Fitted,
    near: Near,
    closing: Closing,
    there: tuple[SignedDistance, Value],
    far: SignedRoot,
    state: InputState,
) -> SignedRoot:
    """Return the root from its fit next to a zero, else the one from `far` of it.

    `there` has the distance from the zero, and the sign of the closure without that zero's share.
    """
    distance, others = there
    fitted = near.smooth(distance.argument)
    q = near.root_at(distance.z, fitted)
    rho = zero.rates(closing, q, state) if isinstance(zero, NearTouch) else closing.rates(q)

    def chosen(close: Value, otherwise: Value) -> Value:
        return zero.chosen(distance, near.width, close, otherwise)

    root = SignedRoot(
        chosen(q.value * others, far.q),
        Slope(chosen(rho.value * others, far.ratio.value), chosen(rho.rate * others, far.ratio.rate)),
    )
    if far.altitude is None:
        return root
    if near.across is None:
        return root.with_altitude(Reduced(far.altitude.across, chosen(q.value * others, far.altitude.q)))
    reduced = vector_of(*(fit.at(distance.argument) for fit in near.across))
    points = [
        Vec(chosen(a.x, b.x), chosen(a.y, b.y)) for a, b in zip(reduced, far.altitude.across, strict=True)
    ]
    return root.with_altitude(
        Reduced(MovingPoint(*points), chosen(fitted.value * distance.share * others, far.altitude.q))
    )


def _root(x: Moving) -> Moving:
    """Return the root of a moving number above zero, with its rates."""
    root = sqrt(x.value)
    rate = x.rate * 0.5 / root
    return Moving(root, rate, (x.second * 0.5 - rate * rate) / root)


def vector_of(x: Moving, y: Moving) -> MovingPoint:
    """Return the vector of two moving components."""
    return MovingPoint(Vec(x.value, y.value), Vec(x.rate, y.rate), Vec(x.second, y.second))


def _sign(value: Value) -> Value:
    return select(value, 0.0, -1.0, 1.0)


# A linkage put together, as data, and one walk over it: what is known of its joints so far.
#
# Joints come in their order, each closed from those before it. For every rigid body the walk keeps how fast
# it turns, and the arms between its joints.
#
# Seen from a line of travel, fixed or carried by a body, a point lies f forward of the line's base and e to
# its left. Where the line turns at Ω with its body, u along it and w from its base to the point,
#
#     f = u·w      f' = Ω (u×w) + u·w'
#     e = u×w      e' = -Ω (u·w) + u×w'
#
# and a point that travels at s along the line has the guide's motion, s' along it, and Coriolis' 2Ω s' across
# it (Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, on points moving in moving frames).


@frozen
class Assembly:
    """A linkage's loops, the path of its input and the sign of every closure.

    `linkage` has its lengths scaled by a power of two where products of four of them could leave
    the range of a float; `unscale` brings results back.
    """

    linkage: Linkage
    loops: Mapping[str, Loop]
    path: InputPath
    signs: Mapping[str, int]
    unscale: float = 1.0
    chain: Mapping[str, ChainRoot] = field(default_factory=dict)
    """The roots, of dyads on moving points, that vanish somewhere on the path."""
    of_inputs: bool = False
    """Whether its lengths are inputs of the program."""
    course: GroupMotion | None = None
    """The motion of its group beyond dyads."""

    @property
    def change_points(self) -> Iterator[float]:
        """The input's places at which a root changes its sign, of loops and of dyads down the chain."""
        for loop in self.loops.values():
            yield from (phase for phase, turns in loop.change_points if self.path.holds(phase, turns))
        for root in self.chain.values():
            yield from map(self.path.coordinate_at, root.change_points)

    @cached_property
    def gears(self) -> Mapping[str, Gearing]:
        """How each crank turns with the input."""
        return gearings(self.linkage)

    @property
    def quickest(self) -> float:
        """How many times as fast as the input the quickest crank turns, at least once."""
        return max([1.0, *(abs(float(gearing.ratio)) for gearing in self.gears.values())])

    @property
    def samples(self) -> int:
        """The number of phases at which a drive period is looked at: enough for the quickest crank."""
        return samples_a_turn(self.quickest)

    @property
    def sampled(self) -> Array:
        """Those phases, once along its path, half a step off the start, where a swing's rates vanish.

        Of a path that retraces a way, those on that way, with one beyond it at each end.
        """
        if self.path.way is None:
            return around(self.path.periods, self.samples)
        first, last = self.path.way
        return first + around(2, self.samples)[: math.ceil((last - first) / math.tau * self.samples) + 2]


AT_ITS_LIMIT = (
    "it is at its limit at every angle of the input, or at many in a row, where rounding alone would"
    " move it; make one length longer or shorter"
)


class Walk:
    """What has been found so far; joints add themselves to it in their order.

    Turnings and arms stand in the order of the linkage's rigid bodies. Where a joint is the `mover`,
    everything before it stands still, and rates are those by its own way.
    """

    def __init__(self, assembly: Assembly, state: InputState, mover: str = "") -> None:
        self.assembly, self.state, self.mover = assembly, state, mover
        self.points: dict[str, MovingPoint] = {}
        self.turnings = [Slope(0.0)]
        """How each rigid body turns."""
        self.arms: list[dict[tuple[str, str], Vec]] = [{}]
        """The vectors between the joints of each that closing them gave."""
        self.travels: dict[str, Moving] = {}
        self.closings: dict[str, Closing] = {}
        """What closes each dyad on moving points: L², or how far its end lies from its line, U and W."""
        self.levers: dict[str, Value] = {}
        """The arm of each dyad's reactions, which vanishes as its root does and keeps all its digits.

        Of two bars it is how far the line of the second passes to the right of the far end of the first; of a
        slider how far it is ahead of its bar's end; of a slot how far the joint in it is ahead of the pivot.
        """

    @property
    def bodies(self) -> dict[str, Slope]:
        """How each named body turns."""
        turning = (body for body in self.linkage.bodies if body.slider is None)
        return {body.name: self.turning_of(body.joints) for body in turning}

    @property
    def centres(self) -> dict[str, MovingPoint]:
        """The centre of mass of each body that states one."""
        bodies = self.linkage.bodies
        return {
            body.name: self.attached((body.joints[0], body.joints[1]), body.com)
            for body in bodies
            if body.com is not None
        }

    @property
    def exact(self) -> bool:
        """Whether the recorded formulas will be run in many digits."""
        return isinstance(self.state.angle, Expr) and self.state.angle.graph.exact

    @property
    def linkage(self) -> Linkage:
        """The linkage that is walked over."""
        return self.assembly.linkage

    def pace(self, gearing: Gearing) -> Slope:
        """Return how fast a geared crank turns, with its derivative."""
        ratio = float(gearing.ratio)
        return Slope(self.state.rate * ratio, self.state.second * ratio)

    def add_body(self, turning: Slope, ends: tuple[str, str], arm: Vec) -> None:
        """Add the bar between two joints; `arm` is the vector from the first to the second."""
        self.turnings.append(turning)
        self.arms.append({ends: arm})

    def loop_root(self, loop: Loop, sign: int) -> tuple[SignedRoot, Half, Slope]:
        """Return the root of a loop on a crank pin, ψ/2, and ψ' with its derivative."""
        pace = self.pace(loop.gearing)
        root, half = loop.closed(self.state, pace)
        return root.times(sign), half, pace

    def pin_loop(self, loop: Loop, sign: int) -> tuple[SignedRoot, PinLoop]:
        """Return the root of a loop between a crank pin and a fixed pin, and where the two are."""
        assert loop.ground is not None
        root, half, pace = self.loop_root(loop, sign)
        ground, units = loop.ground, (loop.root.spread, loop.root.unit)
        return root, PinLoop(ground.exact, ground.direction, loop.crank.length, half, pace, *units)

    def span_root(self, name: str, across: MovingPoint, lengths: tuple[float, float]) -> SignedRoot:
        """Return the root of two bars on points that both move, D apart."""
        square = moving_square(across)
        u, w = moving_factors(square.value, lengths)
        return self.chain_root(
            name, Closing(u, w, square, False, across if lengths[0] == lengths[1] else None)
        )

    def slot_root(self, name: str, across: MovingPoint, offset: float) -> SignedRoot:
        """Return the root √(L² - o²) of a slot whose pin is carried by a moving point, D from the pivot."""
        square = moving_square(across)
        distance = sqrt(square.value)
        margin = (distance - offset) * (distance + offset)
        return self.chain_root(name, Closing(1.0, margin, square, True, None if offset else across))

    def chain_root(self, name: str, closing: Closing) -> SignedRoot:
        """Return the root of a dyad on moving points, and keep what closes it."""
        margin = closing.u * closing.w
        if isinstance(margin, float) and margin <= 0:
            # Its end keeps its distance from the line, so its factors are plain numbers instead of formulas.
            raise AssemblyError(f"joint {name}: {self._why_not(name, closing)}")
        self.closings[name] = closing
        root = self.assembly.chain.get(name)
        if root is not None and self.mover:
            return rated_root(root.root(closing, self.state).q, closing.separation, closing.half_difference)
        if root is not None:
            return root.root(closing, self.state)
        return plain_root(closing.u, closing.w, closing.separation, closing.half_difference)

    def lead(self, name: str) -> None:
        """Move a joint on a fixed circle by 1 rad a second, one on a fixed line by the linkage's extent."""
        linkage, place = self.linkage, self.points[name].position
        if math.isinf(linkage.radii[name]):
            fixed = (slide for joint in linkage.joints for slide in joint.slides if not slide.start)
            along = Vec(*direction(next(slide.angle for slide in fixed if slide.point == name)))
            self.points[name] = MovingPoint(place, along.scaled(linkage.extent))
            self.travels[name] = Moving(self.travels[name].value, linkage.extent)
            return
        frames = enumerate(linkage.rigid_bodies)
        n, pin = next((n, pin) for n, one in frames if name in one and (pin := linkage.pivot(one)))
        pivot, turning = self.points[pin], Slope(1.0)
        self.turnings[n] = turning
        self.points[name] = pivot + carried(place - pivot.position, turning)

    def _why_not(self, name: str, closing: Closing) -> str:
        """Say why a dyad whose factors do not change has no two closures."""
        u, w = closing.u, closing.w
        if not (isinstance(u, float) and isinstance(w, float) and u * w < 0):
            return AT_ITS_LIMIT
        return self.linkage.joint(name).why_apart(u, w, self.linkage.unit)

    def place_of(self, pin: Pin) -> Vec:
        """Return where a fixed pin stands."""
        if not self.exact:
            return Vec(*pin.position)
        return Vec(*map(Constant, pin.position, place(self.linkage, pin)))

    def attached(self, on: tuple[str, str], at: Point, name: str | None = None) -> MovingPoint:
        """Return the point `at` along on[0] -> on[1] and to its left; `name` where it is a joint."""
        n = holding(self.linkage.rigid_bodies, on) or 0
        length = self._length(n, on)
        arm = self._arm(n, *on).times(Vec(at[0] / length, at[1] / length))
        if name is not None:
            self.arms[n][on[0], name] = arm
        return self.points[on[0]] + carried(arm, self.turnings[n])

    def axis(self, on: tuple[str, str]) -> tuple[Vec, Slope]:
        """Return the direction from one joint of a body to another, of length 1, and how the body turns."""
        n = holding(self.linkage.rigid_bodies, on) or 0
        return self._arm(n, *on).scaled(1.0 / self._length(n, on)), self.turnings[n]

    def _length(self, n: int, ends: tuple[str, str]) -> Value:
        """Return how far two joints of one body are apart: as known, or worked out in many digits."""
        if self.exact or self.assembly.of_inputs:
            one, other = (dict(self.linkage.joint(end).bars) for end in ends)
            bar = None if self.exact else one.get(ends[1], other.get(ends[0]))
            arm = self._arm(n, *ends)
            return sqrt(arm.dot(arm)) if bar is None else bar
        start, end = (self.linkage.rigid_bodies[n][name] for name in ends)
        return abs(end - start)

    def _arm(self, n: int, start: str, end: str) -> Vec:
        """Return the vector from one joint of a rigid body to another."""
        arms = self.arms[n]
        if (start, end) in arms:
            return arms[start, end]
        if (end, start) in arms:
            return -arms[end, start]
        return self.points[end].position - self.points[start].position

    def turning_of(self, names: tuple[str, ...]) -> Slope:
        """Return how the rigid body turns that has all these joints."""
        return self.turnings[holding(self.linkage.rigid_bodies, names) or 0]


def refuse_loose(linkage: Linkage) -> None:
    """Raise AssemblyError where what needs a rigid body names joints of none."""
    for owner, names in _rested_on(linkage):
        if holding(linkage.rigid_bodies, names) is None:
            raise AssemblyError(f"{owner}: {' and '.join(names)} are not joints of one rigid body")


def _rested_on(linkage: Linkage) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield what needs a rigid body, and the joints of it that are named."""
    for joint in linkage.joints:
        if isinstance(joint, Rigid):
            yield f"joint {joint.name}", joint.on
        for slide in joint.slides:
            if slide.axis:
                yield "line of travel", slide.axis
    for body in linkage.bodies:
        if body.slider is None:
            yield f"body {body.name}", body.joints


@frozen
class Guide:
    """A line of travel at one instant: its base point, its direction, and how it turns."""

    base: MovingPoint
    along: Vec
    turning: Slope
    offset: float

    def forward(self, point: MovingPoint) -> Moving:
        """Return how far a point lies forward of the base, with its rates as seen from the line."""
        return self._seen(point)[0]

    def aside(self, point: MovingPoint) -> Moving:
        """Return how far a point lies to the left of the line, with its rates as seen from the line."""
        left = self._seen(point)[1]
        return Moving(left.value - self.offset, left.rate, left.second)

    def _seen(self, point: MovingPoint) -> tuple[Moving, Moving]:
        """Return how far a point lies forward of the base, and to its left."""
        u, omega, alpha = self.along, self.turning.value, self.turning.rate
        w, w1, w2 = (
            point.position - self.base.position,
            point.velocity - self.base.velocity,
            point.acceleration - self.base.acceleration,
        )
        f, e = u.dot(w), u.cross(w)
        f1, e1 = u.dot(w1) + e * omega, u.cross(w1) - f * omega
        f2 = u.dot(w2) + (u.cross(w1) + e1) * omega + e * alpha
        e2 = u.cross(w2) - (u.dot(w1) + f1) * omega - f * alpha
        return Moving(f, f1, f2), Moving(e, e1, e2)

    def place(self, travel: Moving) -> MovingPoint:
        """Return the point that has travelled so far along the line from its base."""
        u, n = self.along, self.along.left()
        guided = self.base + carried(u.scaled(travel.value) + n.scaled(self.offset), self.turning)
        across = self.turning.value * travel.rate * 2.0
        return guided + MovingPoint(
            Vec(0.0, 0.0), u.scaled(travel.rate), u.scaled(travel.second) + n.scaled(across)
        )


def guide(line: Line, walk: Walk) -> Guide:
    """Return where a line of travel lies at the walk's instant, and how it moves."""
    along = Vec(*direction(line.angle))
    if line.on is None:
        return Guide(walk.points[line.through], along, Slope(0.0), line.offset)
    axis, turning = walk.axis(line.on)
    return Guide(walk.points[line.through], axis.times(along), turning, line.offset)


# How each kind of joint closes, and the one list of them.
#
# **Two bars that meet in a pin**, a (from P) and b (from Q), meet at B = P + D·(p + i q)/(2L²) with D = Q -
# P, L = |D|, p = L² + a² - b² and the signed root q: no arc functions, no √L. The bars turn at
#
#     ω_a = e - ρ (L² + b² - a²)/(2L²)     ω_b = e + ρ (L² + a² - b²)/(2L²)
#
# with e = D × D'/L² and ρ = (L²)'/q, which stays finite through a limit where q and the input's rate
# vanish together (differentiate the closure in the phase).
#
# **A pin in the slot of a bar that slides on a line**, as in the Scotch yoke: with f and e how far the pin
# lies forward along the line and to its left, and σ the slot's direction from the line's, the slot crosses
# the line at s = f - e cot σ: linear, so the bar never jams and has one closure.


def place_pin(pin: Pin, walk: Walk) -> None:
    """Put the pin where it stands."""
    walk.points[pin.name] = MovingPoint(walk.place_of(pin))


def place_crank(crank: Crank, walk: Walk) -> None:
    """Add r e^{iψ}, ψ = ratio × θ + offset, as r (cos² - sin²) and 2r sin cos of ψ/2.

    The difference is right to 2.3 eps of r. The form r - 2r sin², right to 3.6 eps, is taken where a loop
    against a fixed pin needs 2r sin² anyway.
    """
    gearing = walk.assembly.gears[crank.name]
    loop = own_loop(crank.name, walk.assembly.loops)
    form = loop.form if loop else partial(half_angle, size=2.0 * crank.length)
    half = walk.state.half(-gearing.offset, gearing.ratio, form=form)
    squares = half.squares(2.0 * crank.length)
    spans = loop is not None and loop.ground is not None
    along = crank.length - squares.sine if spans else (squares.cosine - squares.sine) * 0.5
    arm = Vec(along, squares.product)
    pace = walk.pace(gearing)
    walk.points[crank.name] = walk.points[crank.pivot] + carried(arm, pace)
    walk.add_body(pace, (crank.pivot, crank.name), arm)


def place_slider(slider: DrivenSlider, walk: Walk) -> None:
    """Put the slider where the input has it."""
    assert isinstance(walk.state, TravelState)
    walk.points[slider.name] = guide(slider.line, walk).place(walk.state.travel)
    walk.travels[slider.name] = walk.state.travel


def place_point(point: Rigid, walk: Walk) -> None:
    """Carry the point with its body."""
    walk.points[point.name] = walk.attached(point.on, point.at, point.name)


def loop_of_bars(joint: RRR, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin against a fixed pin."""
    loop = pin_against_pin(linkage, gears, joint.ends)
    if loop is None:
        return None
    crank, ground, swapped = loop
    root = four_bar_root(ground.exact, crank.length, _turned(joint, swapped)[1], ground.angle)
    return Loop(crank.name, crank, gears[crank.name], ground, root, swapped)


def close_bars(joint: RRR, walk: Walk) -> None:
    """Add where the two bars meet, and how they turn."""
    loop, sign = walk.assembly.loops.get(joint.name), walk.assembly.signs[joint.name]
    swapped = loop is not None and loop.swapped
    (first, second), lengths = _turned(joint, swapped)
    p, q = walk.points[first], walk.points[second]
    sign = -sign if swapped else sign
    if loop is not None:
        root, pin = walk.pin_loop(loop, sign)
        triangle = pin_triangle(pin, lengths, root)
    else:
        across = q - p
        root = walk.span_root(joint.name, across, lengths).times(sign)
        triangle = moving_triangle(across, lengths, root)
    walk.levers[joint.name] = triangle.across.cross(triangle.altitude) * (
        (-1.0 if swapped else 1.0) / joint.lengths[1]
    )
    walk.points[joint.name], *bars = _meet(p, q, lengths, triangle)
    ends = zip((first, second), bars, strict=True)
    for end, (turning, arm) in reversed([*ends]) if swapped else ends:
        walk.add_body(turning, (end, joint.name), arm)


def _turned(joint: RRR, swapped: bool) -> tuple[tuple[str, str], tuple[float, float]]:
    """Return ends and lengths, in the other order where `swapped`."""
    return (joint.ends[::-1], joint.lengths[::-1]) if swapped else (joint.ends, joint.lengths)


_Bar = tuple[Slope, Vec]
"""How a bar turns, and the bar as a vector."""


def _meet(
    p: MovingPoint, q: MovingPoint, lengths: tuple[float, float], triangle: Triangle
) -> tuple[MovingPoint, _Bar, _Bar]:
    """Return where two bars meet, and both bars.

    The shorter bar carries the joint, since its direction is sharper. The rate of the longer bar, which turns
    less, is worked out; the shorter one's differs from it by ρ.
    """
    d, t, rho = triangle.across, triangle, triangle.ratio
    if usual(lengths[0]) < usual(lengths[1]):
        arm_a = d.scaled(t.near) + t.altitude
        arm_b = arm_a - d
        turning_b = t.turn_of_longer(True)
        turning_a = turning_b.plus(-rho.value, -rho.rate)
        return p + carried(arm_a, turning_a), (turning_a, arm_a), (turning_b, arm_b)
    arm_b = t.altitude - d.scaled(t.far)
    arm_a = arm_b + d
    turning_a = t.turn_of_longer(False)
    turning_b = turning_a.plus(rho.value, rho.rate)
    return q + carried(arm_b, turning_b), (turning_a, arm_a), (turning_b, arm_b)


def loop_of_slider(joint: RRP, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin against the line, where both stand on the ground."""
    crank = linkage.crank(joint.end) if joint.end in gears else None
    if crank is None or joint.line.on or not linkage.joint(crank.pivot).fixed:
        return None
    pivot, through = linkage.pin(crank.pivot), linkage.pin(joint.line.through)
    aside = aside_of(linkage, pivot, through, joint.line.angle)
    tie, reference = joint.length - crank.length, exact_angle(joint.line.angle) - quarter_turns(1)
    if are_inputs(aside.high, joint.line.offset, tie):
        eccentricity = Sum(aside.constant - joint.line.offset)
        root = slider_root(crank.length, joint.length, eccentricity, reference)
        return Loop(joint.end, crank, gears[joint.end], None, root)
    reach = sum(abs(a - b) for a, b in zip(pivot.position, through.position, strict=True))
    eccentricity = snapped(aside - Sum(joint.line.offset), (0.0, tie, -tie), reach + abs(joint.line.offset))
    root = slider_root(crank.length, joint.length, eccentricity, reference)
    return Loop(joint.end, crank, gears[joint.end], None, root)


def close_slider(joint: RRP, walk: Walk) -> None:
    """Add the slider: its travel along the line is that of the bar's end plus the root q = ±√(b² - e²).

    With e how far the end lies left of the line and ρ = e'/q the bar turns at -ρ, seen from the line.
    """
    rail, point = guide(joint.line, walk), walk.points[joint.end]
    forward, aside = rail.forward(point), rail.aside(point)
    root = _slider_root(joint, walk, aside)
    rho, q = root.ratio, root.q
    travel = Moving(
        forward.value + q,
        forward.rate - aside.value * rho.value,
        forward.second - (aside.rate * rho.value + aside.value * rho.rate),
    )
    walk.points[joint.name] = rail.place(travel)
    walk.travels[joint.name], walk.levers[joint.name] = travel, q
    arm = rail.along.scaled(q) - rail.along.left().scaled(aside.value)
    walk.add_body(rail.turning.plus(-rho.value, -rho.rate), (joint.end, joint.name), arm)


def _slider_root(joint: RRP, walk: Walk, aside: Moving) -> SignedRoot:
    loop, sign = walk.assembly.loops.get(joint.name), walk.assembly.signs[joint.name]
    if loop is not None:
        return walk.loop_root(loop, sign)[0]
    u, w = joint.length - aside.value, joint.length + aside.value
    return walk.chain_root(joint.name, Closing(u, w, aside, False, None, squared=False)).times(sign)


def slider_name(joint: RRP, assembly: Assembly) -> str:
    """Return slider-crank or slider-rocker, and whether the line runs past the pivot."""
    loop = assembly.loops.get(joint.name)
    if loop is None:
        return to_say("slider linkage")
    eccentric = loop.root.u.least != loop.root.w.least
    if assembly.path.full_turn:
        return to_say("offset slider-crank") if eccentric else to_say("in-line slider-crank")
    return to_say("offset slider-rocker") if eccentric else to_say("in-line slider-rocker")


def loop_of_slot(joint: RPR, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin and a fixed pin, one in the slot and one the pivot."""
    loop = pin_against_pin(linkage, gears, (joint.through, joint.pivot))
    if loop is None:
        return None
    crank, ground, swapped = loop
    root = slot_root(ground.exact, crank.length, joint.offset, ground.angle)
    return Loop(crank.name, crank, gears[crank.name], ground, root, swapped)


def close_slot(joint: RPR, walk: Walk) -> None:
    """Add the slotted bar and its end."""
    pivot, pin = walk.points[joint.pivot], walk.points[joint.through]
    loop, sign = walk.assembly.loops.get(joint.name), walk.assembly.signs[joint.name]
    if loop is not None:
        root, ground = walk.pin_loop(loop, sign)
        turn = pin_triangle(ground, (0.0, 0.0), root).turn
        direction = _loop_direction(ground, root, (joint.offset, sign), swapped=loop.swapped)
    else:
        across = pin - pivot
        root = walk.slot_root(joint.name, across, joint.offset).times(sign)
        turn = moving_triangle(across, (0.0, 0.0), root).turn
        reduced = root.altitude or Reduced(across, root.q)
        direction = _direction(reduced.across.position, reduced.q, joint.offset)
    walk.levers[joint.name] = root.q
    turning = _turning_kinds(turn, root, joint.offset) if joint.offset else turn
    arm = direction.scaled(joint.length)
    walk.points[joint.name] = pivot + carried(arm, turning)
    walk.add_body(turning, (joint.pivot, joint.name), arm)


def slot_name(joint: RPR, assembly: Assembly) -> str:
    """Return inverted slider-crank, and how its slotted bar, or the cylinder on its rod, moves."""
    loop = assembly.loops.get(joint.name)
    if loop is None or loop.ground is None:
        return to_say("inverted slider-crank")
    if loop.swapped:
        swinging, rotating = (
            to_say("inverted slider-crank, swinging cylinder"),
            to_say("inverted slider-crank, rotating cylinder"),
        )
    else:
        swinging, rotating = (
            to_say("inverted slider-crank, swinging slotted bar"),
            to_say("inverted slider-crank, rotating slotted bar"),
        )
    return rotating if loop.ground.length < loop.crank.length else swinging


def _turning_kinds(turn: Slope, root: SignedRoot, offset: float) -> Slope:
    """Return how a slotted bar turns: e, plus the effect of sliding where the slot misses the pivot."""
    inverse = 1.0 / (root.q * root.q + offset * offset)
    slide = root.ratio.value * (0.5 * offset) * inverse
    growth = root.ratio.value * root.q * inverse
    return turn.plus(slide, root.ratio.rate * (0.5 * offset) * inverse - slide * growth)


def _loop_direction(ground: PinLoop, root: SignedRoot, bar: tuple[float, int], *, swapped: bool) -> Vec:
    """Return the slotted bar's direction; a slot through its own pivot turns at half the crank's angle.

    `bar` is the slot's offset and the closure's sign; `swapped` where the bar turns about the crank's pin.
    """
    offset, sign = bar
    sense = -1.0 if swapped else 1.0
    if ground.short == 0 and offset == 0:
        return Vec(-ground.half.sine, ground.half.cosine).times(ground.direction).scaled(sense * sign)
    return _direction(ground.across().scaled(-sense), root.q, offset)


def _direction(across: Vec, s: Value, offset: float) -> Vec:
    """Return the unit vector u with across = s·u + offset·n."""
    if offset == 0:
        return Vec(across.x / s, across.y / s)
    turned = across.times(Vec(s, -offset))
    square = s * s + offset * offset
    return Vec(turned.x / square, turned.y / square)


def close_yoke(joint: RPP, walk: Walk) -> None:
    """Add the point where the slot crosses the line: s = f - e cot σ, derivatives in the same way."""
    rail, point = guide(joint.line, walk), walk.points[joint.pin]
    cosine, sine = direction(joint.slot)
    forward, aside, lean = rail.forward(point), rail.aside(point), cosine / sine
    travel = Moving(
        forward.value - aside.value * lean,
        forward.rate - aside.rate * lean,
        forward.second - aside.second * lean,
    )
    walk.points[joint.name] = rail.place(travel)
    walk.travels[joint.name] = travel


def yoke_name(joint: RPP, assembly: Assembly) -> str:
    """Return Scotch yoke, or that its slot is not square to its line."""
    return to_say("Scotch yoke") if unit(joint.slot)[0] == 0 else to_say("Scotch yoke, oblique slot")


def place_group(point: Any, walk: Walk) -> None:
    """Add all points of a group and all of its links, at the first of them."""
    if walk.exact:
        raise DyadAtLimit(f"joint {point.name}: it is not known to fifty digits, which a dyad's limit needs")
    if point.name not in walk.points and walk.assembly.course is not None:
        point.group.place(walk)


class Closer(NamedTuple):
    """What solves one kind of joint.

    `close` adds the joint's motion, and its bars', to a walk. `loop` returns the loop that it closes from a
    crank pin and fixed elements, if it does. `name` returns the class of a linkage whose only dyad it is.
    """

    close: Callable[[Any, Walk], None]
    loop: Callable[[Any, Linkage, Mapping[str, Gearing]], Loop | None] = lambda *_: None
    name: Callable[[Any, Assembly], str | None] = lambda *_: None


CLOSERS: Mapping[type[Joint], Closer] = {
    Pin: Closer(place_pin),
    Crank: Closer(place_crank),
    DrivenSlider: Closer(place_slider),
    Rigid: Closer(place_point),
    Brace: Closer(place_point),
    RRR: Closer(close_bars, loop_of_bars),
    RRP: Closer(close_slider, loop_of_slider, slider_name),
    RPR: Closer(close_slot, loop_of_slot, slot_name),
    RPP: Closer(close_yoke, name=yoke_name),
}
"""Every kind that a linkage can be made of, but the joints of a group."""


def closer_of(joint: Joint) -> Closer:
    """Return what solves a joint."""
    return CLOSERS.get(type(joint)) or Closer(place_group)


def walked(assembly: Assembly, state: InputState, mover: str = "") -> Walk:
    """Return a walk over the whole linkage at the state's instant; rates by the `mover`, if there is one."""
    walk = Walk(assembly, state, mover)
    for _ in walking(walk):
        pass
    return walk


def walking(walk: Walk) -> Iterator[Joint]:
    """Walk over the linkage, and yield each joint that is done."""
    for joint in walk.linkage.joints:
        closer_of(joint).close(joint, walk)
        if joint.name == walk.mover:
            walk.lead(joint.name)
        yield joint


def walk_at(assembly: Assembly, phase: Value, pace: Slope) -> Walk:
    """Return a walk at a phase that runs at `pace`: floats, or symbolic expressions."""
    return walked(assembly, assembly.path.state(phase, pace))
