"""Closing a dyad: where two constraints from known points put the next joint, and how it moves.

Two bars a (from P) and b (from Q) meet at B = P + D·(p + i q)/(2L²) with D = Q - P, L = |D|,
p = L² + a² - b² and the signed root q: no arc functions, no √L. The bars turn at

    ω_a = e - ρ (L² + b² - a²)/(2L²)     ω_b = e + ρ (L² + a² - b²)/(2L²)

with e = D × D'/L² and ρ = (L²)'/q, which stays finite through a limit where q and the input's rate
vanish together (differentiate the closure in the phase; Müller's form of the loop equations).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from .clock import Half
from .expression import Value, sqrt
from .planar import Moving, MovingPoint, Slope, Turning, Vec, carried
from .signed import SignedRoot


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
    """Return where two bars meet, and how they turn.

    The shorter bar carries the joint, since its direction is sharper; the longer one, which turns
    less, has its rate worked out, and the shorter one's is ρ away.
    """
    d, t, rho = triangle.across, triangle, triangle.ratio
    if lengths[0] < lengths[1]:
        arm_a = d.scaled(t.near) + t.lift
        arm_b = arm_a - d
        turning_b = t.turn.plus(rho.value * t.near, rho.rate * t.near)
        turning_a = turning_b.plus(-rho.value, -rho.rate)
        return Meeting(arm_a, arm_b, turning_a, turning_b, p + carried(arm_a, turning_a))
    arm_b = t.lift - d.scaled(t.far)
    arm_a = arm_b + d
    turning_a = t.turn.plus(-(rho.value * t.far), -(rho.rate * t.far))
    turning_b = turning_a.plus(rho.value, rho.rate)
    return Meeting(arm_a, arm_b, turning_a, turning_b, q + carried(arm_b, turning_b))


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
    """Return the triangle of a crank pin and a fixed pin, without cancellation.

    Lengths squared are taken over K = 4 g r, so that L² is sin²(ψ/2) and a constant; so is the root.
    """
    (a, b), g, r = lengths, loop.ground, loop.crank
    if g == r and a == b:
        return _kite(loop, root)
    w, wd = loop.pace.value, loop.pace.rate
    square, k = loop.half.square, 4.0 * g * r
    share = 0.5 / (square + (g - r) * (g - r) / k)
    # (L²)'/(4 L⁴): what the shares of D and e both change with.
    change = loop.half.product * w * share * share
    excess, outer = 2.0 * (b - a) * (b + a) / k, 2.0 * (g - r) * (g + r) / k
    turn = Turning(*(_turn(square, share, (g, r), rate) for rate in (w, wd)))
    across = loop.across()
    return Triangle(
        across=across,
        near=(square + _near_constant(g - r, a, b) / k) * share,
        far=(square + _near_constant(g - r, b, a) / k) * share,
        lift=across.left().scaled(root.q * share),
        turn=turn.plus(0.0, change * (root.ratio.value * excess + w * outer)),
        ratio=root.ratio,
    )


def _turn(square: Value, share: Value, lengths: tuple[float, float], rate: Value) -> Value:
    """Return e for a rate of ψ, (r² - g r cos ψ)/L² of it: half, and a share where g and r are alike.

    Where one is much the longer, the half would cancel and leave few digits of a small rest.
    """
    g, r = lengths
    if g < 8 * r and r < 8 * g:
        return share * (rate * ((r - g) * (r + g) / (4.0 * g * r))) + rate * 0.5
    return (square + (r - g) / (2.0 * g)) * share * rate


def _kite(loop: PinLoop, root: SignedRoot) -> Triangle:
    """Return the triangle of a kite or rhombus, whose pins meet at ψ = 0: the lift is √U/2 along e^{iψ/2}."""
    lift = Vec(loop.half.cosine, loop.half.sine).times(loop.direction).scaled(root.root_u * loop.crank)
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
