"""Closing a dyad: where two constraints from known points put the next joint, and how it moves.

Two bars a (from P) and b (from Q) meet at B = P + D·(p + i q)/(2L²) with D = Q - P, L = |D|,
p = L² + a² - b² and the signed root q: no arc functions, no √L. The bars turn at

    ω_a = e - ρ (L² + b² - a²)/(2L²)     ω_b = e + ρ (L² + a² - b²)/(2L²)

with e = D × D'/L² and ρ = (L²)'/q, which stays finite through a limit where q and the input's rate
vanish together (differentiate the closure in the phase; Müller's form of the loop equations).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from .clock import Clock, Half
from .exact import FULL_TURN, HALF_TURN, Sum
from .expression import Value, cos, maximum, minimum, select, sin, sqrt
from .planar import Moving, MovingPoint, Slope, Turning, Vec, carried
from .roots import Factor, Kind, LoopRoot

SMALLEST = 1e-300
LAMBERT_DEPTH = 23


@dataclass(frozen=True, slots=True)
class SignedRoot:
    """q, the regular ratio ρ = (K/2 sin ψ)ψ'/q, and the signed √U where q is a product of two roots."""

    q: Value
    ratio: Slope
    root_u: Value = 0.0

    def times(self, sign: int) -> SignedRoot:
        """Return the root of the closure on the other side where `sign` is -1."""
        factor = float(sign)
        return SignedRoot(self.q * factor, self.ratio.scaled(factor), self.root_u * factor)


@dataclass(frozen=True, slots=True)
class Triangle:
    """P, Q and the third corner: D, shares of it, and what its rates need.

    `near` = p/(2L²) and `far` = 1 - near are the shares of D under each bar; `lift` runs from D to
    the corner, i D q/(2L²); `turn` is e and, in its second, e' + ρ near'.
    """

    across: Vec
    near: Value
    far: Value
    lift: Vec
    turn: Turning
    ratio: Slope


@dataclass(frozen=True, slots=True)
class Meeting:
    """The joint in which two bars meet: the bars as vectors, and how they turn."""

    arm_a: Vec
    arm_b: Vec
    turning_a: Turning
    turning_b: Turning
    point: MovingPoint


def meet(p: MovingPoint, q: MovingPoint, lengths: tuple[float, float], triangle: Triangle) -> Meeting:
    """Return where two bars meet; the shorter one carries the joint, since its direction is sharper."""
    d, t = triangle.across, triangle
    a_is_shorter = lengths[0] < lengths[1]
    if a_is_shorter:
        arm_a = d.scaled(t.near) + t.lift
        arm_b = arm_a - d
    else:
        arm_b = t.lift - d.scaled(t.far)
        arm_a = arm_b + d
    rho = t.ratio
    turning_a = Turning(
        t.turn.rate - rho.value * t.far,
        t.turn.second - rho.rate * t.far,
    )
    turning_b = Turning(
        t.turn.rate + rho.value * t.near,
        t.turn.second + rho.rate * t.near,
    )
    point = p + carried(arm_a, turning_a) if a_is_shorter else q + carried(arm_b, turning_b)
    return Meeting(arm_a, arm_b, turning_a, turning_b, point)


@dataclass(frozen=True, slots=True)
class PinLoop:
    """A crank pin against a fixed pin: ground vector (length, unit), crank, and the pin's ψ.

    `half` is ψ/2, `pace` is ψ' with its derivative.
    """

    ground: float
    direction: Vec
    crank: float
    half: Half
    pace: Slope

    def across(self) -> Vec:
        """Return D from the crank pin to the fixed pin, exact where the two nearly meet."""
        twice = 2.0 * self.crank
        along = self.half.square * twice + (self.ground - self.crank)
        return Vec(along, -(self.half.product * twice)).times(self.direction)


def pin_triangle(loop: PinLoop, lengths: tuple[float, float], root: SignedRoot) -> Triangle:
    """Return the triangle of a crank pin and a fixed pin, without cancellation."""
    (a, b), g, r = lengths, loop.ground, loop.crank
    if g == r and a == b:
        return _kite(loop, root)
    w, wd = loop.pace.value, loop.pace.rate
    spread = loop.half.square * (4.0 * g * r)
    share = 0.5 / (spread + (g - r) * (g - r))
    # (L²)'/(4 L⁴): what the shares of D and e both change with.
    change = loop.half.product * (w * (4.0 * g * r)) * share * share
    excess, outer = 2.0 * (b - a) * (b + a), 2.0 * (g - r) * (g + r)
    turn = (spread + 2.0 * r * (r - g)) * share
    across = loop.across()
    return Triangle(
        across=across,
        near=(spread + _near_constant(g - r, a, b)) * share,
        far=(spread + _near_constant(g - r, b, a)) * share,
        lift=across.left().scaled(root.q * share),
        turn=Turning(turn * w, change * (root.ratio.value * excess + w * outer) + turn * wd),
        ratio=root.ratio,
    )


def _kite(loop: PinLoop, root: SignedRoot) -> Triangle:
    """Return the triangle of a kite or rhombus, whose pins meet at ψ = 0: the lift is √U/2 along e^{iψ/2}."""
    lift = Vec(loop.half.cosine, loop.half.sine).times(loop.direction).scaled(root.root_u * 0.5)
    half_turn = Turning(loop.pace.value * 0.5, loop.pace.rate * 0.5)
    return Triangle(loop.across(), 0.5, 0.5, lift, half_turn, root.ratio)


def _near_constant(gap: float, near: float, far: float) -> float:
    """Return gap² + near² - far², rounded once."""
    return float(Fraction(gap) ** 2 + Fraction(near) ** 2 - Fraction(far) ** 2)


def moving_triangle(
    p: MovingPoint, q: MovingPoint, lengths: tuple[float, float], signed: SignedRoot
) -> Triangle:
    """Return the triangle on two points that both move."""
    a, b = lengths
    across, rate = q.position - p.position, q.velocity - p.velocity
    square = across.dot(across)
    share = 0.5 / square
    growth = across.dot(rate) * 4.0 * share
    turn = across.cross(rate) * (share + share)
    excess = (b - a) * (b + a)
    second = across.cross(q.acceleration - p.acceleration) * (share + share) - turn * growth
    return Triangle(
        across=across,
        near=(square - excess) * share,
        far=(square + excess) * share,
        lift=across.left().scaled(signed.q * share),
        turn=Turning(turn, second + signed.ratio.value * (share * growth * excess)),
        ratio=signed.ratio,
    )


def moving_square(p: MovingPoint, q: MovingPoint) -> Moving:
    """Return L² between two moving points with its rates."""
    across, rate = q.position - p.position, q.velocity - p.velocity
    second = across.dot(q.acceleration - p.acceleration) + rate.dot(rate)
    return Moving(across.dot(across), across.dot(rate) * 2.0, second * 2.0)


def moving_factors(square: Value, lengths: tuple[float, float]) -> tuple[Value, Value]:
    """Return U and W of two bars on points L apart, as products without cancellation."""
    a, b = lengths
    distance = sqrt(square)
    return (
        ((a + b) - distance) * ((a + b) + distance),
        (distance - abs(a - b)) * (distance + abs(a - b)),
    )


def slot_turning(turn: Turning, root: SignedRoot, offset: float) -> Turning:
    """Return how a slotted bar turns: e, and what the sliding adds where the slot misses the pivot."""
    inverse = 1.0 / (root.q * root.q + offset * offset)
    slide = root.ratio.value * (0.5 * offset) * inverse
    growth = root.ratio.value * root.q * inverse
    return Turning(
        turn.rate + slide,
        turn.second + root.ratio.rate * (0.5 * offset) * inverse - slide * growth,
    )


def slot_direction(across: Vec, s: Value, offset: float) -> Vec:
    """Return the unit vector u with across = s·u + offset·n."""
    if offset == 0:
        return Vec(across.x / s, across.y / s)
    turned = across.times(Vec(s, -offset))
    square = s * s + offset * offset
    return Vec(turned.x / square, turned.y / square)


def plain_root(u: Value, w: Value, driver: Moving, half_difference: Value) -> SignedRoot:
    """Return the root of factors that do not vanish, with U' = -g and W' = g, g the driver's rate.

    `half_difference` is (U - W)/2, or 1/2 where there is no U: q' = ρ times that.
    """
    q = sqrt(w * u)
    ratio = driver.rate / q
    return SignedRoot(q, Slope(ratio, (driver.second - ratio * ratio * half_difference) / q))


def signed_root(
    root: LoopRoot, half: Half, pace: Slope, clock: Clock, swing: tuple[Sum, Sum] | None
) -> SignedRoot:
    """Return q of a loop closed from a crank pin, signed through change points and limits."""
    if root.u.kind is Kind.PLAIN and root.w.kind is Kind.PLAIN:
        u, w, half_difference = factor_values(root, half)
        return plain_root(u, w, _spread_rates(root, half, pace), half_difference)
    return _product_root(root, half, pace, clock, swing)


def _spread_rates(root: LoopRoot, half: Half, pace: Slope) -> Moving:
    """Return K sin²(ψ/2) with its two derivatives."""
    w, square = pace.value, half.square * root.spread
    bend = (0.5 * root.spread - square) * (w * w)
    return Moving(square, half.product * (w * root.spread), bend + half.product * (pace.rate * root.spread))


def factor_values(root: LoopRoot, half: Half) -> tuple[Value, Value, Value]:
    """Return U, W and half of U - W (1/2 where there is no U)."""
    spread = half.square * root.spread
    w = spread + root.w.least
    if root.single:
        return 1.0, w, 0.5
    # Subtracting keeps all but two bits while the least value is not small beside the greatest.
    roomy = 4 * root.u.least >= root.u.most
    u = root.u.most - spread if roomy else (half.cosine * half.cosine) * root.spread + root.u.least
    return u, w, 0.5 * (root.u.most - root.w.least) - spread


def _product_root(
    root: LoopRoot, half: Half, pace: Slope, clock: Clock, swing: tuple[Sum, Sum] | None
) -> SignedRoot:
    """Return q as the product of its two signed roots, and ρ with what vanishes in both divided out."""
    s, c = half.sine, half.cosine
    u, w, _ = factor_values(root, half)
    scale = math.sqrt(root.spread)
    half_rate = pace.value * 0.5
    first = half.product * (pace.value * root.spread)
    sine, cosine = Slope(s, c * half_rate), Slope(c, -(s * half_rate))
    part_u = _part(
        root.u, u, 0.0 if root.single else -first, cosine, scale, clock, _limits(root, root.u, swing)
    )
    part_w = _part(root.w, w, first, sine, scale, clock, _limits(root, root.w, swing))
    upper, lower = part_u.upper or part_w.upper, part_u.lower or part_w.lower
    share = pace
    if clock.ends is not None and (upper or lower):
        share = clock.ends.share_of_rate(clock.pace, upper, lower)
    numerator = share.scaled(root.spread) * part_u.left * part_w.left
    ratio = numerator / (part_u.regular * part_w.regular)
    return SignedRoot(part_u.whole * part_w.whole, ratio, part_u.whole)


@dataclass(frozen=True, slots=True)
class _Part:
    """One signed root: whole, its regular part, what is left of sin or cos(ψ/2), the ends it holds."""

    whole: Value
    regular: Slope
    left: Slope
    upper: bool = False
    lower: bool = False


def _part(
    factor: Factor,
    value: Value,
    rate: Value,
    touching: Slope,
    scale: float,
    clock: Clock,
    limits: _Beyond | None,
) -> _Part:
    if factor.kind is Kind.CHANGE_POINT:
        return _Part(touching.value * scale, Slope(scale), Slope(1.0))
    if factor.kind is Kind.LIMIT and clock.ends is not None and limits is not None:
        return _limited_part(clock, limits, float(factor.short), scale, touching)
    whole = sqrt(value)
    return _Part(whole, Slope(whole, rate * 0.5 / whole), touching)


@dataclass(frozen=True, slots=True)
class _Beyond:
    """How far the factor's own limits lie beyond the ends of the swing, halved; 0 where they are the ends.

    `sign` is that of cos(ψ/2) (sin(ψ/2) for W) over the whole swing.
    """

    upper: float
    lower: float
    sign: float


def _limits(root: LoopRoot, factor: Factor, swing: tuple[Sum, Sum] | None) -> _Beyond | None:
    """Return where the factor's own limits lie; None where it does not limit the input."""
    if swing is None or factor.kind is not Kind.LIMIT:
        return None
    best = root.reference if factor is root.u else root.reference + HALF_TURN
    low, high = swing
    turns = round((float(low + high) / 2 - float(best)) / (2 * math.pi))
    best = best + FULL_TURN.times(float(turns))
    beyond = (best + factor.reach) - high, low - (best - factor.reach)
    upper, lower = (0.5 * float(way) if float(way) > 1e-15 else 0.0 for way in beyond)
    return _Beyond(upper, lower, -1.0 if turns % 2 else 1.0)


def _limited_part(clock: Clock, beyond: _Beyond, short: float, scale: float, touching: Slope) -> _Part:
    """Return √(K sin x sin y), x and y half the ways to the factor's two limits, x + y + short = π."""
    ends = clock.ends
    assert ends is not None
    x = Slope(ends.u.value + beyond.upper, ends.u.rate)
    y = Slope(ends.v.value + beyond.lower, ends.v.rate)
    at_upper, at_lower = beyond.upper == 0, beyond.lower == 0
    regular = _root_of_sine(x, y.value + short, at_upper) * _root_of_sine(y, x.value + short, at_lower)
    regular = regular.scaled(scale)
    whole = regular.value
    whole = whole * ends.root_u.value if at_upper else whole
    whole = whole * ends.root_v.value if at_lower else whole
    # cos(ψ/2) of U, sin(ψ/2) of W: small next to a limit near π, and sharp there this way.
    left = Slope(sin(minimum(x.value, y.value) + 0.5 * short) * beyond.sign, touching.rate)
    return _Part(whole, regular, left, at_upper, at_lower)


def _root_of_sine(x: Slope, supplement: Value, divided: bool) -> Slope:
    """Return √sin x, or √(sin x / x) where `divided`; near π the supplement keeps the digits."""
    safe = maximum(x.value, SMALLEST)
    sine = sin(minimum(safe, supplement))
    if not divided:
        root = sqrt(sine)
        return Slope(root, root * 0.5 * (cos(x.value) / sine) * x.rate)
    root = sqrt(sine / safe)
    return Slope(root, root * 0.5 * _logarithmic_slope(x.value, safe, sine) * x.rate)


def _logarithmic_slope(x: Value, safe: Value, sine: Value) -> Value:
    """Return cot x - 1/x, by Lambert's continued fraction where the difference would cancel."""
    square = x * x
    fraction: Value = float(LAMBERT_DEPTH)
    for odd in range(LAMBERT_DEPTH - 2, 1, -2):
        fraction = float(odd) - square / fraction
    return select(x, 1.0, -(x / fraction), cos(x) / maximum(sine, SMALLEST) - 1.0 / safe)
