"""The triangle of a dyad: two points, the bars from them, and what the bars' rates need.

With D from the first point P to the second Q, L = |D| and the signed root q the third corner lies at
P + D·(p + i q)/(2L²), p = L² + a² - b². D turns at e = D × D'/L², and the bars' rates differ from e by
shares of ρ = (L²)'/q.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from linkanim.mechanics.formulas.circular import Half
from linkanim.mechanics.formulas.constant import Constant
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Value, select, sqrt
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope, Vec
from linkanim.mechanics.loops.kite import Closure, Links, turning
from linkanim.mechanics.loops.signed import Reduced, SignedRoot


@dataclass(frozen=True, slots=True)
class Triangle:
    """P, Q and the third corner: D, shares of it, and what its rates need.

    `near` = p/(2L²) and `far` = 1 - near are the shares of D under each bar; `lift` runs from D to
    the corner, i D q/(2L²); `turn` is e and, as its rate, e' + ρ near'. `longer` is how the longer bar turns,
    where e and ρ's share would cancel.
    """

    across: Vec
    near: Value
    far: Value
    lift: Vec
    turn: Slope
    ratio: Slope
    longer: Slope | None = None

    def turn_of_longer(self, second: bool) -> Slope:
        """Return how the longer bar turns, the second one or the first."""
        if self.longer is not None:
            return self.longer
        share = self.near if second else -self.far
        return self.turn.plus(self.ratio.value * share, self.ratio.rate * share)


@dataclass(frozen=True, slots=True)
class PinLoop:
    """A crank pin against a fixed pin: ground vector (length, direction), crank, and the pin's ψ.

    `half` is ψ/2, `pace` is ψ' with its derivative; K and the unit of lengths squared are the root's.
    """

    ground: Sum
    direction: Vec
    crank: float
    half: Half
    pace: Slope
    spread: float
    unit: float

    @property
    def short(self) -> float:
        """How much longer the ground is than the crank, rounded once."""
        return (self.ground - Sum(float(self.crank))).constant

    def across(self) -> Vec:
        """Return D from the crank pin to the fixed pin, exact where the two nearly meet."""
        squares = self.half.squares(2.0 * self.crank)
        return Vec(squares.sine + self.short, -squares.product).times(self.direction)


def pin_triangle(loop: PinLoop, lengths: tuple[float, float], root: SignedRoot) -> Triangle:
    """Return the triangle of a crank pin and a fixed pin, without cancellation.

    Lengths squared are taken over the root's unit, so that L² is K sin²(ψ/2) and a constant.
    """
    (a, b), short, total = lengths, loop.short, loop.ground.high + loop.crank
    if short == 0 and a == b:
        return _kite(loop, root)
    w, wd = loop.pace.value, loop.pace.rate
    unit, squares = loop.unit, loop.half.squares(loop.spread)
    square = squares.sine
    share = 0.5 / (square + short * short / unit)
    # (L²)'/(4 L⁴): what the shares of D and e both change with.
    change = squares.product * w * share * share
    excess, outer = 2.0 * (b - a) * (b + a) / unit, 2.0 * short * total / unit
    turn = Slope(*(_turn(loop, square, share, rate) for rate in (w, wd)))
    across = loop.across()
    triangle = Triangle(
        across=across,
        near=(square + _near_constant(short, a, b) / unit) * share,
        far=(square + _near_constant(short, b, a) / unit) * share,
        lift=across.left().scaled(root.q * share),
        turn=turn.plus(0.0, change * (root.ratio.value * excess + w * outer)),
        ratio=root.ratio,
    )
    links = Links(loop.ground.high, loop.crank, a, b, (loop.ground.high, loop.ground.low, -loop.crank))
    if root.slack is None or not links.kite:
        return triangle
    return replace(triangle, longer=_longer(loop, links, root, triangle.turn_of_longer(a < b)))


def _longer(loop: PinLoop, links: Links, root: SignedRoot, turn: Slope) -> Slope:
    """Return how the longer bar turns next to a kite; it is `turn` where the pins are far apart."""
    assert root.slack is not None
    closing = Closure(loop.half, root.q, root.slack, loop.unit)
    if links.coupler < links.rocker:
        rate, bend = turning(links, closing)
    else:
        rate, bend = turning(links.inverted(), closing)
        rate, bend = 1.0 - rate, -bend
    square, (w, wd) = loop.half.sine * loop.half.sine, (loop.pace.value, loop.pace.rate)
    return Slope(
        select(square, 0.5, rate * w, turn.value),
        select(square, 0.5, bend * (w * w) + rate * wd, turn.rate),
    )


def _turn(loop: PinLoop, square: Value, share: Value, rate: Value) -> Value:
    """Return e for a rate of ψ, (r² - g r cos ψ)/L² of it: half, and a share where g and r are alike.

    Where one is much the longer, the half would cancel and leave few digits of a small rest.
    """
    g, r, unit = loop.ground.high, loop.crank, loop.unit
    if g < 8 * r and r < 8 * g:
        return share * (rate * (-loop.short * (r + g) / unit)) + rate * 0.5
    return (square - loop.short * (2.0 * r) / unit) * share * rate


def _kite(loop: PinLoop, root: SignedRoot) -> Triangle:
    """Return the triangle of a kite or rhombus, whose pins meet at ψ = 0: the lift is √U/2 along e^{iψ/2}."""
    lift = Vec(loop.half.cosine, loop.half.sine).times(loop.direction).scaled(root.root_u * loop.crank)
    half_turn = Slope(loop.pace.value * 0.5, loop.pace.rate * 0.5)
    return Triangle(loop.across(), 0.5, 0.5, lift, half_turn, root.ratio)


def _near_constant(gap: float, near: float, far: float) -> float:
    """Return gap² + near² - far², that of the rounded gap rounded once."""
    excess = Fraction(near) ** 2 - Fraction(far) ** 2
    return Constant(float(Fraction(float(gap)) ** 2 + excess), Fraction(gap) ** 2 + excess)


def moving_triangle(across: MovingPoint, lengths: tuple[float, float], signed: SignedRoot) -> Triangle:
    """Return the triangle on two points that both move, D apart.

    Where equal bars' ends meet, D and q vanish together: what is left of both gives the lift and the turn.
    """
    a, b = lengths
    reduced = signed.lift or Reduced(across, signed.q)
    (d, rate, bend), excess = reduced.across.parts, (b - a) * (b + a)
    square = d.dot(d)
    share = 0.5 / square
    growth = d.dot(rate) * 4.0 * share
    turn = d.cross(rate) * (share + share)
    second = d.cross(bend) * (share + share) - turn * growth
    return Triangle(
        across=across.position,
        near=(square - excess) * share,
        far=(square + excess) * share,
        lift=d.left().scaled(reduced.q * share),
        turn=Slope(turn, second + signed.ratio.value * (share * growth * excess)),
        ratio=signed.ratio,
    )


def moving_square(across: MovingPoint) -> Moving:
    """Return L² between two points that move, D apart, with its rates."""
    d, rate, bend = across.parts
    return Moving(d.dot(d), d.dot(rate) * 2.0, (d.dot(bend) + rate.dot(rate)) * 2.0)


def moving_factors(square: Value, lengths: tuple[float, float]) -> tuple[Value, Value]:
    """Return U and W of two bars on points L apart, as products without cancellation."""
    a, b = lengths
    distance = sqrt(square)
    return (
        ((a + b) - distance) * ((a + b) + distance),
        (distance - abs(a - b)) * (distance + abs(a - b)),
    )
