"""Close loops from a crank pin against fixed elements, and find what range they leave the input.

Its parts, in reading order:

- The triangle of a dyad: two points, the bars from them, and what the bars' rates need.
- Loops: dyads that close from a crank pin against fixed elements, each with its root in closed form.
- The ranges of the input that the loops on its own pin leave open.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

from linkanim.errors import AssemblyError
from linkanim.frozen import frozen
from linkanim.mechanics.angles import (
    HALF_TURN,
    Half,
    Sum,
    exact_angle,
    gap,
    half_angle,
    sharp_half_angle,
    signed_half_angle,
)
from linkanim.mechanics.arithmetic import (
    Constant,
    Moving,
    MovingPoint,
    Slope,
    Value,
    Vec,
    arctan2,
    are_inputs,
    over,
    select,
    sqrt,
    usual,
)
from linkanim.mechanics.linkage import Crank, Joint, Linkage, Pin
from linkanim.mechanics.precise import context, exactly, nearest_sum, sides, sine_and_cosine
from linkanim.mechanics.precise import direction as direction_of
from linkanim.mechanics.solver.input import InputState, Swing
from linkanim.mechanics.solver.signed_root import (
    Kind,
    LoopRoot,
    Reduced,
    SignedRoot,
    alike,
    sharpened,
    sign_of_root,
    signed_root,
)
from linkanim.mechanics.tolerances import CANCELLED, NEARLY_A_KITE, NO_RANGE, TWO_FLOATS

# The triangle of a dyad: two points, the bars from them, and what the bars' rates need.
#
# With D from the first point P to the second Q, L = |D| and the signed root q the third corner lies at
# P + D·(p + i q)/(2L²), p = L² + a² - b². D turns at e = D × D'/L², and the bars' rates differ from e by
# shares of ρ = (L²)'/q.
#
# **Next to a kite** both pins of a dyad nearly meet, and its bars are nearly of one length. Crank r, coupler
# a and rocker b on the ground g; ψ the crank's angle from the ground line. With T = g r sin ψ, d = r² - g r
# cos ψ, L² = g² + r² - 2 g r cos ψ, p = L² + a² - b² and the signed root q the rocker turns at
#
#     ω = (T p + q d)/(L² q) = r² F G/(q (T p - q d))         per unit of the crank's rate
#
#     F = (g - r + a)² - b² + 4 g (r - a) sin²(ψ/2)      G = (g - r - a)² - b² + 4 g (r + a) sin²(ψ/2)
#
# F and G vanish where crank and coupler lie in one line. Next to a kite L² is small and the first sum
# cancels over most of the turn; the second form has then a sum of two terms of one sign.
#
# ω' is ω (ln ω)'. Where sin²(ψ/2) outweighs the constant in T p - q d and in the other factors, the rate of
# each logarithm is about cot(ψ/2) times a simple fraction, and these fractions sum to zero: only the share of
# the constants is formed. Where the constant of F or G outweighs the square, the square's share is formed.


class Links(NamedTuple):
    """Ground, crank, coupler and rocker, and ground less crank as small parts to be summed."""

    ground: float
    crank: float
    coupler: float
    rocker: float
    short: tuple[float, ...]

    @property
    def kite(self) -> bool:
        """Whether the pins nearly meet, and the bars are nearly as long as each other."""
        longest = max(self.ground, self.crank)
        return max(abs(math.fsum(self.short)), abs(self.coupler - self.rocker)) <= NEARLY_A_KITE * longest

    def inverted(self) -> Links:
        """Return the links seen from the crank: crank and ground swap places, as do coupler and rocker."""
        short = tuple(-part for part in self.short)
        return Links(self.crank, self.ground, self.rocker, self.coupler, short)


class _Grown(NamedTuple):
    """least + share × sin²(ψ/2), a factor of ω."""

    least: float
    share: float
    value: Value


class KiteRates:
    """ω of a rocker next to a kite, and its derivative, both by the crank's angle.

    `half` is ψ/2, `q` the signed root and `excess` its own (see `SignedRoot`); lengths squared are divided by
    `unit`, 4 g r. T, p, d and L² have their constants.
    """

    def __init__(self, links: Links, half: Half, q: Value, excess: Value, unit: float) -> None:
        self.links, self.half, self.q, self.excess, self.unit = links, half, q, excess, unit
        short = math.fsum(links.short)
        self.square = half.sine * half.sine
        most = Fraction(short) ** 2 + Fraction(links.coupler) ** 2 - Fraction(links.rocker) ** 2
        self.t = half.sine * half.cosine * 0.5
        self.p = self._grown(float(most) / unit)
        self.d = self._grown(-links.crank * short / unit, 0.5)
        self.long = self._grown(over(short * short, unit))
        self.cot = half.cosine / half.sine

    def turning(self) -> tuple[Value, Value]:
        """Return ω and its derivative."""
        first, second = self.t * self.p.value, self.q * self.d.value
        total, other = first + second, first - second
        # A sum that keeps a fair share of its terms needs no differences, which the other form does.
        cancelled = total * total * CANCELLED
        summed, product = self._as_sum(), self._as_product()
        omega, bend = (select(cancelled, other * other, b, a) for a, b in zip(summed, product, strict=True))
        return omega, bend

    def _grown(self, least: float, share: float = 1.0) -> _Grown:
        return _Grown(least, share, self.square * share + least)

    def _left(self, sign: float) -> Value:
        """Return the rate of T p ± q d without the shares of its squares and constants."""
        own = self.square * self.p.value * 0.25
        return own + self.q * self.d.value * self.excess * (0.5 * sign)

    def _of_constants(self, sign: float) -> Value:
        """Return the constants' share in T p ± q d; where that cancels, over the sum with the other sign."""
        x, (constant, linear, square) = self.square, self._difference_of_squares()
        first, second = self.t * self.p.least, self.q * (self.d.least * sign)
        product = ((x * square + linear) * x + constant) / (first - second)
        return select(first * second, 0.0, product, first + second)

    def _difference_of_squares(self) -> tuple[float, float, float]:
        """Return the coefficients of (T p)² - (q d)² in sin²(ψ/2), p and d without that square in them."""
        r, a, b = Fraction(self.links.crank), Fraction(self.links.coupler), Fraction(self.links.rocker)
        short = sum(map(Fraction, self.links.short), Fraction(0))
        unit = 4 * (r + short) * r
        p, d = ((short**2 + a**2 - b**2) / unit / 2) ** 2, (r * short / unit) ** 2
        u, w = ((a + b) ** 2 - short**2) / unit, (short**2 - (a - b) ** 2) / unit
        return float(-u * w * d), float(p - (u - w) * d), float(d - p)

    def _as_sum(self) -> tuple[Value, Value]:
        t, p, d, long, q = self.t, self.p, self.d, self.long, self.q
        total, both = t * p.value + q * d.value, self.half.sine * self.half.cosine
        omega = total / (long.value * q)
        constants = self.cot * (omega * long.least - self._of_constants(1.0) / q) / long.value
        squares = both * ((t + q * 0.5) / q - omega) / long.value
        part = select(self.square, long.least, squares, constants)
        rest = self._left(1.0) / (long.value * q)
        return omega, part + omega * self.excess * 0.5 - rest

    def _as_product(self) -> tuple[Value, Value]:
        t, q, half, links = self.t, self.q, self.half, self.links
        one, two = self._collinear()
        total, both = t * self.p.value - q * self.d.value, half.sine * half.cosine
        share = (links.crank / (4.0 * links.ground)) / (q * total)
        omega = one.value * two.value * share
        left = omega * self._of_constants(-1.0) / total
        constants = self.cot * (left - two.value * share * one.least)
        squares = both * (two.value * share * one.share - omega * (t - q * 0.5) / total)
        mark = abs(one.least / one.share) if one.share else math.inf
        part = select(self.square, mark, squares, constants)
        rest = self._left(-1.0) / total
        return omega, part - self.cot * one.value * share * two.least + omega * (self.excess * 0.5 + rest)

    def _collinear(self) -> tuple[_Grown, _Grown]:
        """Return F and G, the one with the greater constant first."""
        r, a, b, short = self.links.crank, self.links.coupler, self.links.rocker, self.links.short
        factors = []
        for signed in (a, -a):
            least = math.fsum((*short, signed, -b)) * math.fsum((*short, signed, b)) / self.unit
            factors.append(self._grown(least, (r - signed) / r))
        one, two = sorted(factors, key=lambda factor: -abs(factor.least))
        return one, two


class Triangle(NamedTuple):
    """P, Q and the third corner: D, shares of it, and what its rates need.

    `near` = p/(2L²) and `far` = 1 - near are the shares of D under each bar; `altitude` runs from D to
    the corner, i D q/(2L²); `turn` is e and, as its rate, e' + ρ near'. `longer` is how the longer bar turns,
    given where e and the share of ρ would cancel.
    """

    across: Vec
    near: Value
    far: Value
    altitude: Vec
    turn: Slope
    ratio: Slope
    longer: Slope | None = None

    def turn_of_longer(self, second: bool) -> Slope:
        """Return how the longer bar turns, the second one or the first."""
        if self.longer is not None:
            return self.longer
        share = self.near if second else -self.far
        return self.turn.plus(self.ratio.value * share, self.ratio.rate * share)


@frozen
class PinLoop:
    """A crank pin against a fixed pin: the ground's length and direction, the crank, and ψ.

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
    def short(self) -> Any:
        """How much longer the ground is than the crank, rounded once."""
        if are_inputs(self.crank, self.ground.high):
            return self.ground.constant - self.crank
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
    if alike(loop.ground, loop.crank, lengths):
        return _kite(loop, root)
    w, wd = loop.pace.value, loop.pace.rate
    unit, squares = loop.unit, loop.half.squares(loop.spread)
    square = squares.sine
    share = 0.5 / (square + over(short * short, unit))
    # (L²)'/(4 L⁴), which is in the rates of both e and the shares of D.
    change = squares.product * w * share * share
    excess, outer = over(2.0 * (b - a) * (b + a), unit), over(2.0 * short * total, unit)
    turn = Slope(*(_turn(loop, square, share, rate) for rate in (w, wd)))
    across = loop.across()
    triangle = Triangle(
        across=across,
        near=(square + over(_near_constant(short, a, b), unit)) * share,
        far=(square + over(_near_constant(short, b, a), unit)) * share,
        altitude=across.left().scaled(root.q * share),
        turn=turn.plus(0.0, change * (root.ratio.value * excess + w * outer)),
        ratio=root.ratio,
    )
    links = Links(loop.ground.high, loop.crank, a, b, (loop.ground.high, loop.ground.low, -loop.crank))
    if root.excess is None or not links.kite:
        return triangle
    return triangle._replace(longer=_longer(loop, links, root, triangle.turn_of_longer(a < b)))


def _longer(loop: PinLoop, links: Links, root: SignedRoot, turn: Slope) -> Slope:
    """Return how the longer bar turns next to a kite; it is `turn` where the pins are far apart."""
    assert root.excess is not None
    second = links.coupler < links.rocker
    seen = links if second else links.inverted()
    rate, bend = KiteRates(seen, loop.half, root.q, root.excess, loop.unit).turning()
    if not second:
        rate, bend = 1.0 - rate, -bend
    square, (w, wd) = loop.half.sine * loop.half.sine, (loop.pace.value, loop.pace.rate)
    return Slope(
        select(square, 0.5, rate * w, turn.value),
        select(square, 0.5, bend * (w * w) + rate * wd, turn.rate),
    )


def _turn(loop: PinLoop, square: Value, share: Value, rate: Value) -> Value:
    """Return e for a rate of ψ, (r² - g r cos ψ)/L² times it; of like g and r, as a half and a share.

    Where one of them is much longer, the half would cancel and leave few digits of a small remainder.
    """
    g, r, unit = loop.ground.high, loop.crank, loop.unit
    if usual(g) < 8 * usual(r) and usual(r) < 8 * usual(g):
        turned: Value = share * (rate * over(-loop.short * (r + g), unit)) + rate * 0.5
        return turned
    shared: Value = (square - over(loop.short * (2.0 * r), unit)) * share * rate
    return shared


def _kite(loop: PinLoop, root: SignedRoot) -> Triangle:
    """Return the triangle of a kite or rhombus, whose pins meet at ψ = 0; altitude: √U/2 along e^{iψ/2}."""
    altitude = Vec(loop.half.cosine, loop.half.sine).times(loop.direction).scaled(root.root_u * loop.crank)
    half_turn = Slope(loop.pace.value * 0.5, loop.pace.rate * 0.5)
    return Triangle(loop.across(), 0.5, 0.5, altitude, half_turn, root.ratio)


def _near_constant(gap: Any, near: Any, far: Any) -> Any:
    """Return gap² + near² - far², that of the rounded gap rounded once."""
    if are_inputs(gap, near, far):
        return gap * gap + (near - far) * (near + far)
    excess = Fraction(near) ** 2 - Fraction(far) ** 2
    return Constant(float(Fraction(float(gap)) ** 2 + excess), Fraction(gap) ** 2 + excess)


def moving_triangle(across: MovingPoint, lengths: tuple[float, float], signed: SignedRoot) -> Triangle:
    """Return the triangle on two points that both move, D apart.

    Where the ends of equal bars meet, D and q vanish together: with the common zero divided out they give the
    altitude and the turn.
    """
    a, b = lengths
    reduced = signed.altitude or Reduced(across, signed.q)
    (d, rate, bend), excess = reduced.across, (b - a) * (b + a)
    square = d.dot(d)
    share = 0.5 / square
    growth = d.dot(rate) * 4.0 * share
    turn = d.cross(rate) * (share + share)
    second = d.cross(bend) * (share + share) - turn * growth
    return Triangle(
        across=across.position,
        near=(square - excess) * share,
        far=(square + excess) * share,
        altitude=d.left().scaled(reduced.q * share),
        turn=Slope(turn, second + signed.ratio.value * (share * growth * excess)),
        ratio=signed.ratio,
    )


def moving_square(across: MovingPoint) -> Moving:
    """Return L² between two points that move, D apart, with its rates."""
    d, rate, bend = across
    return Moving(d.dot(d), d.dot(rate) * 2.0, (d.dot(bend) + rate.dot(rate)) * 2.0)


def moving_factors(square: Value, lengths: tuple[float, float]) -> tuple[Value, Value]:
    """Return U and W of two bars on points L apart, as products without cancellation."""
    a, b = lengths
    distance = sqrt(square)
    return (
        ((a + b) - distance) * ((a + b) + distance),
        (distance - abs(a - b)) * (distance + abs(a - b)),
    )


# Loops: dyads that close from a crank pin against fixed elements, each with its root in closed form.

STRAIGHT = Sum(0.0)


class Gearing(NamedTuple):
    """How a crank turns with the input: angle = ratio × θ + offset."""

    ratio: Fraction = Fraction(1)
    offset: Sum = STRAIGHT


class Ground(NamedTuple):
    """The ground link between two fixed pins: length, direction, and the angle of that direction.

    `rest` is what rounding took from a length that is read from coordinates.
    """

    length: float
    direction: Vec
    angle: Sum
    rest: float = 0.0

    @property
    def exact(self) -> Sum:
        """The length to twice a float's digits."""
        return Sum(self.length, self.rest)


@frozen
class Loop:
    """A dyad closed from the crank pin `pin` (of the crank `crank`) and fixed elements.

    `ground` runs from the crank's pivot to the fixed pin; None for a line of travel.
    `swapped` says that the dyad names the fixed pin first.
    """

    pin: str
    crank: Crank
    gearing: Gearing
    ground: Ground | None
    root: LoopRoot
    swapped: bool = False

    @property
    def limits(self) -> bool:
        """Whether the loop keeps its crank from turning fully."""
        return Kind.LIMIT in (self.root.u.kind, self.root.w.kind)

    @property
    def change_points(self) -> Iterator[tuple[float, int]]:
        """The input's angles at which the root changes its sign, and after how many turns each is back."""
        p, q = self.gearing.ratio.as_integer_ratio()
        for angle in self.root.change_points:
            first, step = float((angle - self.gearing.offset) * Fraction(q, p)), 2 * math.pi * q / abs(p)
            yield from ((first + turn * step, q) for turn in range(abs(p)))

    def closed(self, state: InputState, pace: Slope) -> tuple[SignedRoot, Half]:
        """Return the loop's root and ψ/2 at the state's instant, ψ running at `pace`."""
        half = sharpened(self.root, self._half(state), state.ends)
        return signed_root(self.root, half, pace, state.ends), half

    def sign(self, state: InputState) -> int:
        """Return the sign of the loop's root at an instant between its limits, in plain floats."""
        return sign_of_root(self.root, self._half(state))

    def _half(self, state: InputState) -> Half:
        reference = self.root.reference - self.gearing.offset
        return state.half(reference, self.gearing.ratio, form=self.form, sharp=self.root.quick)

    @property
    def form(self) -> Callable[[Value, Value], Half]:
        """How ψ/2 is worked out: with the sign and the digits that the root needs, squares times 2r."""
        if self.root.u.kind is Kind.PLAIN and not self.root.wide:
            return sharp_half_angle
        plain = self.root.u.kind is self.root.w.kind is Kind.PLAIN
        return partial(half_angle if plain else signed_half_angle, size=2.0 * self.crank.length)


def own_loop(crank: str, loops: Mapping[str, Loop]) -> Loop | None:
    """Return the loop on a crank's pin whose ψ is the crank's own angle; None where there is none."""
    own = (loop for loop in loops.values() if loop.pin == crank and loop.root.reference == STRAIGHT)
    return next(own, None)


def gearings(linkage: Linkage) -> dict[str, Gearing]:
    """Map each crank's pin to how it turns with the input; AssemblyError where it does not."""
    own = linkage.drive.joint
    gearings_of = {own: Gearing()} if isinstance(linkage.joint(own), Crank) else {}
    for crank in linkage.cranks:
        if crank.name in gearings_of:
            continue
        if crank.gear is None or crank.gear.mate not in gearings_of:
            raise AssemblyError(
                f"joint {crank.name}: this crank turns with nothing; gear it to {linkage.drive.joint}"
            )
        mate = gearings_of[crank.gear.mate]
        offset = mate.offset * crank.gear.ratio + exact_angle(crank.gear.offset)
        gearings_of[crank.name] = Gearing(mate.ratio * crank.gear.ratio, offset)
    return gearings_of


def pin_against_pin(
    linkage: Linkage, gears: Mapping[str, Gearing], ends: tuple[str, str]
) -> tuple[Crank, Ground, bool] | None:
    """Return a crank whose pin is one of two joints, and the ground link from its pivot to the other one.

    The last value says whether the pin is the second of the two. None where neither is a crank's pin with the
    other one and the pivot fixed, or where these two are one point.
    """
    for swapped, (moving, fixed) in enumerate((ends, ends[::-1])):
        crank = linkage.crank(moving) if moving in gears else None
        if crank and linkage.joint(crank.pivot).fixed and linkage.joint(fixed).fixed:
            ground = ground_between(linkage, crank, fixed)
            return (crank, ground, bool(swapped)) if ground else None
    return None


def ground_between(linkage: Linkage, crank: Crank, end: str) -> Ground | None:
    """Return the ground link from a crank's pivot to another fixed pin, as exactly as it was written.

    None where they are one point, and no direction leads from one to the other. The length is the
    crank's own where rounding is all that tells them apart.
    """
    ground = _between(linkage, crank.pivot, end)
    if ground and are_inputs(ground.length, crank.length):
        return ground
    if ground and ground.length < TWO_FLOATS * crank.length:
        return None
    if ground and gap(ground.length, ground.rest, -crank.length) == 0:
        return ground._replace(length=crank.length, rest=0.0)
    return ground


def _between(linkage: Linkage, begin: str, end: str) -> Ground | None:
    first, second = linkage.pin(begin), linkage.pin(end)
    if _written_from(second, first):
        return _written(second, turned=False)
    if _written_from(first, second):
        return _written(first, turned=True)
    dx, dy = second.position[0] - first.position[0], second.position[1] - first.position[1]
    if are_inputs(dx, dy):
        away = sqrt(dx * dx + dy * dy)
        return Ground(away, Vec(dx / away, dy / away), Sum(arctan2(dy, dx)))  # type: ignore[arg-type]
    length = math.hypot(dx, dy)
    if not length:
        return None
    places = place(linkage, first), place(linkage, second)
    exact, angle = _way(*places)
    with localcontext(context()):
        along, left = ((b - a) / exactly(exact) for a, b in zip(*places, strict=True))
    direction = Vec(Constant(dx / length, along), Constant(dy / length, left))
    if not (dx and dy):
        angle = exact_angle(math.atan2(dy, dx))
    return Ground(exact.high, direction, angle, exact.low)


def aside_of(linkage: Linkage, pin: Pin, base: Pin, angle: float) -> Sum:
    """Return how far a fixed pin lies left of the line through another at an angle."""
    if are_inputs(*base.position, *pin.position):
        along = Vec(*direction_of(angle))
        return Sum(along.cross(Vec(*pin.position) - Vec(*base.position)))
    (x0, y0), (x1, y1) = place(linkage, base), place(linkage, pin)
    sine, cosine = sides(angle)
    with localcontext(context()):
        return nearest_sum((y1 - y0) * cosine - (x1 - x0) * sine)


def place(linkage: Linkage, pin: Pin) -> tuple[Decimal, Decimal]:
    """Return where a fixed pin lies, as it was written."""
    if pin.polar is None:
        return Decimal(pin.position[0]), Decimal(pin.position[1])
    base, length = pin.polar.base, Decimal(pin.polar.length)
    x, y = place(linkage, linkage.pin(base)) if base else (Decimal(0), Decimal(0))
    sine, cosine = sides(pin.polar.angle)
    with localcontext(context()):
        return x + length * cosine, y + length * sine


def _way(start: tuple[Decimal, Decimal], end: tuple[Decimal, Decimal]) -> tuple[Sum, Sum]:
    """Return length and angle of the way between two points to twice a float's digits."""
    with localcontext(context()):
        dx, dy = end[0] - start[0], end[1] - start[1]
        near = Decimal(math.atan2(dy, dx))
        sine, cosine = sine_and_cosine(near)
        # The error of a float angle is so small that it equals its own tangent.
        rest = (dy * cosine - dx * sine) / (dx * cosine + dy * sine)
        return nearest_sum((dx * dx + dy * dy).sqrt()), nearest_sum(near + rest)


def _written_from(pin: Pin, base: Pin) -> bool:
    """Tell whether the pin was written as a length at an angle from the other."""
    if pin.polar is None:
        return False
    return pin.polar.base == base.name or (pin.polar.base is None and base.position == (0.0, 0.0))


def _written(pin: Pin, *, turned: bool) -> Ground:
    assert pin.polar is not None
    direction = Vec(*direction_of(pin.polar.angle))
    angle = exact_angle(pin.polar.angle)
    if turned:
        # At most half a turn, as an angle from coordinates would be: the input's range is counted from it.
        back = angle - HALF_TURN if float(angle) > 0 else angle + HALF_TURN
        return Ground(pin.polar.length, -direction, back)
    return Ground(pin.polar.length, direction, angle)


# The ranges of the input that the loops on its own pin leave open.

ONE_PLACE = (
    "it can be put together at one angle of the input only, so nothing could move; "
    "make one length a little longer or shorter"
)


def open_arcs(linkage: Linkage, loops: Mapping[str, Loop]) -> list[Swing] | None:
    """Return the ranges of the input that the loops on its own pin leave open; None for a full turn.

    AssemblyError where a loop cannot be closed at any angle, or the loops leave no common range.
    """
    arcs: list[Swing] | None = None
    for name, loop in loops.items():
        if loop.pin == linkage.drive.joint:
            unscale = linkage.crank(loop.pin).length / loop.crank.length
            own = arcs_of(linkage.joint(name), loop.root, linkage.unit, unscale)
            arcs = own if arcs is None else arcs if own is None else list(_common(arcs, own))
            if arcs == []:
                raise AssemblyError(f"joint {name}: the bars of the linkage leave its input no common range")
    return arcs


def arcs_of(joint: Joint, root: LoopRoot, unit: str, unscale: float = 1.0) -> list[Swing] | None:
    """Return a loop's open ranges in the crank's own angle; `unscale` times its lengths gives the joint's."""
    if min(root.u.most, root.w.most) == 0:
        raise AssemblyError(f"joint {joint.name}: {ONE_PLACE}")
    if min(root.u.most, root.w.most) < 0:
        u, w = (factor.most * root.unit * unscale**2 for factor in (root.u, root.w))
        raise AssemblyError(f"joint {joint.name}: {joint.why_apart(u, w, unit)}")
    ends, reference = (joint.name, joint.name), root.reference
    u_limits, w_limits = root.u.kind is Kind.LIMIT, root.w.kind is Kind.LIMIT
    if u_limits and w_limits:
        inner, outer = root.w.short, root.u.reach
        above = Swing(reference + inner, reference + outer, ends)
        return [above, Swing(reference - outer, reference - inner, ends)]
    if u_limits:
        return [Swing(reference - root.u.reach, reference + root.u.reach, ends)]
    if w_limits:
        middle = reference + HALF_TURN
        return [Swing(middle - root.w.reach, middle + root.w.reach, ends)]
    return None


def _common(first: list[Swing], second: list[Swing]) -> Iterator[Swing]:
    """Yield the ranges that both lists leave open, the input's angle being the same every turn."""
    for a in first:
        for b in second:
            for turns in (-1, 0, 1):
                moved = b.shifted(turns)
                low, low_end = max((a.low, a.ends[0]), (moved.low, moved.ends[0]), key=_size)
                high, high_end = min((a.high, a.ends[1]), (moved.high, moved.ends[1]), key=_size)
                if float(high - low) > NO_RANGE:
                    yield Swing(low, high, (low_end, high_end))


def _size(end: tuple[Sum, str]) -> tuple[float, float]:
    return end[0].high, end[0].low
