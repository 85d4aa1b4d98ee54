"""The signed root of a dyad on moving points that limits the input, or passes change points.

Its margin F = U·W is a difference of rounded coordinates, without digits of its own where it vanishes:
q = √F would keep half of them. So each zero has a smooth signed way z to it: the root of half the way to
a limit, or the sine of half the way to a change point. There F = z²·R² with R smooth and positive, and
next to the zero q = z·R, R being a polynomial fitted once in fifty digits (`fitting`). Then

    q' = d(zR)/dz z'        ρ = q'/((U - W)/2)

need no digits of F or of its rates, and stay finite through limits and change points. Between the zeros
F keeps its digits: there q = ±√F, and the signs of all the ways are its sign on the smooth path.

Where F comes near zero and turns back, at an extreme of the separation, its least value F₀ is found in fifty
digits, too, and R² is fitted: there q = ±√(F₀ + r²), r = z·R, z the sine of half the way from there, and

    q' = r r'/q        q'' = (r r'' + r'² F₀/q²)/q
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import localcontext
from fractions import Fraction
from typing import NamedTuple

from linkanim.mechanics.formulas.circular import sharp_half_angle
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Value, maximum, minimum, select, sqrt
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope, Vec
from linkanim.mechanics.formulas.precise import context, cosine, exactly, nearest_sum
from linkanim.mechanics.loops.input_state import InputState
from linkanim.mechanics.loops.signed import SMALLEST, Reduced, SignedRoot, plain_root

BESIDE_AN_END = 1e-3
"""Sine of the phase below which half the way to an end of a swing has the digits of that to a place."""


@dataclass(frozen=True, slots=True)
class PolynomialFit:
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


class Way(NamedTuple):
    """A signed way z to a zero, and the argument of what is fitted there; `share` is z over it.

    The argument is the same a turn later, where z is -z.
    """

    z: Moving
    argument: Moving
    share: Value = 1.0


@dataclass(frozen=True, slots=True)
class Near:
    """What is fitted next to a zero: R, and D over the argument where the ends of equal bars meet there.

    `least` is what the margin comes down to where that is not zero: then R² is fitted.
    """

    root: PolynomialFit
    across: tuple[PolynomialFit, PolynomialFit] | None = None
    least: float = 0.0

    def root_at(self, z: Moving, fitted: Moving) -> Moving:
        """Return √(least + z²R²)."""
        if not self.least:
            return z * fitted
        part = z * _root(fitted)
        root = sqrt(part.value * part.value + self.least)
        share, rate = part.value / root, part.rate / root
        return Moving(root, share * part.rate, share * part.second + rate * rate * (self.least / root))


@dataclass(frozen=True, slots=True)
class End:
    """A limit that the dyad sets, at the swing's upper or its lower end: z² is half the way to it.

    Where the dyad fails to close on a short stretch only, of which half is the `stretch`, z² is that times
    half the way to its other end.
    """

    upper: bool
    near: Near | None = None
    stretch: float = 0.0

    def way(self, state: InputState) -> Way:
        """Return the way to the limit."""
        assert state.ends is not None
        ends = state.ends
        z, half = (ends.root_u, ends.u) if self.upper else (ends.root_v, ends.v)
        argument = Moving(half.value, half.rate, (z * z).second)
        return Way(z * _root(argument, self.stretch) if self.stretch else z, argument)

    def chosen(self, way: Way, width: float, close: Value, otherwise: Value) -> Value:
        """Return `close` within the width, else the other."""
        return select(way.argument.value, width, close, otherwise)


@dataclass(frozen=True, slots=True)
class Stationary:
    """A change point, or a dip: z is the sine of half the way from it, and the argument that tangent.

    `place` is an angle of an input that turns; of one that swings it is a phase, since its two ways may
    run on different closures before this one, and `amplitude` is that of the swing. It repeats after
    `turns` drive periods (a power of two, of a swing).
    """

    place: Sum
    turns: int
    amplitude: float | None
    near: Near | None = None

    def way(self, state: InputState) -> Way:
        """Return the way from there."""
        turn = self._on_turn(state) if self.amplitude is None else self._on_swing(state, self.amplitude)
        sine, cosine = turn
        return Way(sine, _quotient(sine, cosine), cosine.value)

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
        return (state.angle - gone.high) + (state.rest - gone.low)

    def chosen(self, way: Way, width: float, close: Value, otherwise: Value) -> Value:
        """Return `close` within the width, else the other."""
        z = way.z.value
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
    """Return a quotient of what moves."""
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


class Dip(Stationary):
    """A place where the margin comes near zero, and turns back."""


Zero = End | Touch
Fitted = Zero | Dip


class Closing(NamedTuple):
    """What closes a dyad on moving points: U, W, what they change by, and its ends' way D where it has two.

    `separation` is L² of two ends (`squared`), or how far a single one lies beside its line; W' is its rate,
    U' less it.
    `half_difference` is (U - W)/2, or 1/2 of a `single` root, which has no U.
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
        """What the margin is beside: (U + W)², which is 16a²b² of two bars, or L²."""
        return self.separation.value if self.single else (self.u + self.w) * (self.u + self.w)

    @property
    def gap(self) -> Value:
        """How much longer, or shorter, the separation may still become: its nearer factor as a length."""
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
        """Return ρ of a root that is known with its rates: from q', or where U and W are alike from (L²)'.

        There q is at its greatest, and q'/((U - W)/2) nothing over nothing.
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


@dataclass(frozen=True, slots=True)
class ChainRoot:
    """The zeros of one dyad's root; `sign` makes the closure that is named the one just after the start.

    Below `least` the margin has no digits left.
    """

    zeros: tuple[Zero, ...]
    least: float
    sign: float = 1.0
    dips: tuple[Dip, ...] = ()

    @property
    def change_points(self) -> Iterator[Sum]:
        """What names the places at which the root changes its sign and the input goes on."""
        return (zero.place for zero in self.zeros if isinstance(zero, Touch))

    def root(self, closing: Closing, state: InputState) -> SignedRoot:
        """Return q and ρ, signed and finite through every zero."""
        margin = maximum(closing.u * closing.w, self.least)
        plain = plain_root(margin, 1.0, closing.separation, closing.half_difference)
        side = self.side(state)
        found = SignedRoot(plain.q * side, Slope(plain.ratio.value * side, plain.ratio.rate * side))
        if any(zero.near and zero.near.across for zero in self.zeros) and closing.across:
            found = found.with_lift(Reduced(closing.across, found.q))
        for zero in (*self.dips, *self.zeros):
            if zero.near is not None:
                found = self._beside(zero, zero.near, closing, state, found)
        return found

    def _beside(
        self, zero: Fitted, near: Near, closing: Closing, state: InputState, far: SignedRoot
    ) -> SignedRoot:
        """Return the root from its fit next to a zero, else the one from `far` of it."""
        way, others = zero.way(state), self.side(state, zero)
        fitted = near.root.at(way.argument)
        q = near.root_at(way.z, fitted)
        rho = closing.rates(q)

        def chosen(close: Value, otherwise: Value) -> Value:
            return zero.chosen(way, near.root.width, close, otherwise)

        found = SignedRoot(
            chosen(q.value * others, far.q),
            Slope(chosen(rho.value * others, far.ratio.value), chosen(rho.rate * others, far.ratio.rate)),
        )
        if far.lift is None:
            return found
        if near.across is None:
            return found.with_lift(Reduced(far.lift.across, chosen(q.value * others, far.lift.q)))
        reduced = _vector(*(fit.at(way.argument) for fit in near.across))
        points = [
            Vec(chosen(a.x, b.x), chosen(a.y, b.y)) for a, b in zip(reduced, far.lift.across, strict=True)
        ]
        return found.with_lift(
            Reduced(MovingPoint(*points), chosen(fitted.value * way.share * others, far.lift.q))
        )

    def side(self, state: InputState, other_than: Fitted | None = None) -> Value:
        """Return the sign of the closure on the smooth path, without that of a zero."""
        sign: Value = self.sign
        for zero in self.zeros:
            if zero is not other_than:
                sign = sign * _sign(zero.way(state).z.value)
        return sign


def _root(x: Moving, more: float = 0.0) -> Moving:
    """Return the root of what moves and some more, which is positive."""
    root = sqrt(x.value + more)
    rate = x.rate * 0.5 / root
    return Moving(root, rate, (x.second * 0.5 - rate * rate) / root)


def _vector(x: Moving, y: Moving) -> MovingPoint:
    """Return the vector of two moving components."""
    return MovingPoint(Vec(x.value, y.value), Vec(x.rate, y.rate), Vec(x.second, y.second))


def _sign(value: Value) -> Value:
    return select(value, 0.0, -1.0, 1.0)
