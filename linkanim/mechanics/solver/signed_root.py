"""Take the signed root of a dyad without losing digits, and find where it vanishes.

Its parts, in reading order:

- Where the signed root of a loop closed from a crank pin vanishes: its two factors U and W.
- Signed roots: how a dyad closes where its bars fall into one line, with all its digits and a smooth motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal, localcontext
from enum import Enum
from fractions import Fraction
from functools import reduce
from typing import Any, NamedTuple

from linkanim.frozen import frozen
from linkanim.mechanics.angles import (
    FULL_TURN,
    HALF_TURN,
    Half,
    Sum,
    cosine_within,
    gap,
    half_of,
    quarter_turns,
    sine_within,
    total,
    two_sum,
)
from linkanim.mechanics.arithmetic import (
    Constant,
    Moving,
    MovingPoint,
    Slope,
    Value,
    arctan2,
    are_inputs,
    known,
    maximum,
    minimum,
    nearest,
    over,
    select,
    sqrt,
)
from linkanim.mechanics.arithmetic import root as root_of
from linkanim.mechanics.precise import context, nearest_sum, sine_and_cosine
from linkanim.mechanics.solver.input import Ends
from linkanim.mechanics.tolerances import CLOSE, CLOSEST, KITE, OWN_LIMIT, SETTLED, SMALLEST, WIDE

# Where the signed root of a loop closed from a crank pin vanishes: its two factors U and W.
#
#     U = cU + K cos²(ψ/2)        W = cW + K sin²(ψ/2)
#
# with ψ the crank's angle from the ground line (or a quarter turn behind the normal of a line of travel).
# The part on signed roots below derives them, and says what a factor does at c > 0, c = 0 and c < 0.

_STEPS = 8
"""The most steps of Newton's method."""


class Kind(Enum):
    """What one factor of the root does over the crank's turn."""

    PLAIN = "never vanishes"
    CHANGE_POINT = "touches zero: the smooth path changes its sign"
    LIMIT = "crosses zero: the crank can go no further"


class Factor(NamedTuple):
    """One factor of the root: `least` + K·cos² (or sin²), between `least` and `most`.

    `reach` is how far ψ may go from the place of the factor's greatest value (0 for U, π for W), and `short`
    is π less that; both are sums of two floats, since a rounded limit costs the velocity next to it half its
    digits.
    """

    least: Any
    most: Any
    reach: Sum
    short: Sum

    @property
    def kind(self) -> Kind:
        """What the factor does over the turn: it never vanishes, touches zero, or crosses it."""
        least = known(self.least)
        if least == 0:
            return Kind.CHANGE_POINT
        return Kind.PLAIN if least > 0 else Kind.LIMIT


ALWAYS = Factor(1.0, 1.0, quarter_turns(2), Sum(0.0))


@frozen
class LoopRoot:
    """U, W and K of one loop. `reference` is the angle of the crank at ψ = 0.

    `spread` is K, by which each factor varies over a turn; lengths squared are taken over `unit`.
    """

    spread: Any
    u: Factor
    w: Factor
    reference: Sum
    unit: Any = 1.0
    ample: bool | None = None
    """Where lengths are inputs of the program: whether U stays far from zero, or may come near it."""

    @property
    def change_points(self) -> tuple[Sum, ...]:
        """The crank's angles at which a factor touches zero."""
        places = (self.u, self.reference + HALF_TURN), (self.w, self.reference)
        return tuple(place for factor, place in places if factor.kind is Kind.CHANGE_POINT)

    @property
    def wide(self) -> bool:
        """True where U stays so far from zero that its digits do not depend on those of a small cosine."""
        if self.ample is not None:
            return self.ample
        return self.single or bool(self.u.least >= WIDE * self.spread)

    @property
    def quick(self) -> bool:
        """True where a factor comes near zero without limiting the crank: the closure moves quickly there."""
        factors = (self.w,) if self.single else (self.u, self.w)
        return self.ample is None and any(0 <= one.least < WIDE * self.spread for one in factors)

    @property
    def single(self) -> bool:
        """True where the root has no factor U (a slot through a pin)."""
        return self.u is ALWAYS


def factor(least: float, most: float, spread: Fraction, exact_most: Fraction) -> Factor:
    """Return the factor, its reach found to twice a float's digits where it limits the crank."""
    if least >= 0 or most <= 0:
        return Factor(least, most, quarter_turns(2), Sum(0.0))
    reach = _twice_arcsine_of_root(exact_most / spread, math.atan2(math.sqrt(most), math.sqrt(-least)))
    return Factor(least, most, reach, quarter_turns(2) - reach)


def _twice_arcsine_of_root(square: Fraction, half_guess: float) -> Sum:
    """Return x with sin²(x/2) = square as a sum of two floats: Newton's method from a float.

    One step is enough, except next to a right angle, where the difference from it has to be right to its own
    digits.
    """
    with localcontext(context()):
        target = Decimal(square.numerator) / Decimal(square.denominator)
        half = Decimal(half_guess)
        for _ in range(_STEPS):
            sine, cosine = sine_and_cosine(half)
            half += (step := (target - sine * sine) / (2 * sine * cosine))
            if abs(step) < SETTLED:
                break
        return nearest_sum(2 * half)


def four_bar_root(ground: Sum, crank: float, bars: tuple[float, float], reference: Sum) -> LoopRoot:
    """Return the root of crank pin against fixed pin: ground r1, crank r2, bars r3, r4.

    cU = (r3+r4-r1-r2)(r3+r4+r1+r2) and cW = (r1-r2-r3+r4)(r1-r2+r3-r4). Where neither factor vanishes, both
    are divided by 2 r1, as q is: K is then 2 r2, which the crank's pin needs anyway. Otherwise they are
    divided by 4 r1 r2: K is then 1, whose root is exact.
    """
    coupler, rocker = bars
    if are_inputs(ground.high, crank, *bars):
        return _four_bar_of_inputs(ground.constant, crank, bars, reference)
    g, r, a, b = ground.fraction, *(Fraction(length) for length in (crank, coupler, rocker))
    longer, shorter = (ground.high, ground.low), (-ground.high, -ground.low)
    u_most, w_most = (a + b) ** 2 - (g - r) ** 2, (g + r) ** 2 - (a - b) ** 2
    u_least = gap(coupler, rocker, *shorter, -crank) * total(coupler, rocker, *longer, crank)
    w_least = gap(*longer, -crank, -coupler, rocker) * gap(*longer, -crank, coupler, -rocker)
    if alike(ground, crank, bars):
        w_least = 0.0
    touching_u = gap(coupler, rocker, *shorter, crank) == 0
    touching_w = 0 in (gap(*longer, crank, -coupler, rocker), gap(*longer, crank, coupler, -rocker))
    spread = 2 * r if u_least > 0 and w_least > 0 else Fraction(1)
    unit = nearest(4 * g * r / spread)
    u_most, w_most = u_most / unit.number, w_most / unit.number
    return LoopRoot(
        nearest(spread),
        factor(u_least / unit, _unless(touching_u, u_most), spread, u_most),
        factor(w_least / unit, _unless(touching_w, w_most), spread, w_most),
        reference,
        unit,
    )


def alike(ground: Sum, crank: float, bars: tuple[float, float]) -> bool:
    """Tell whether a kite's pins meet: ground and crank, and both bars, differ by rounding alone."""
    if are_inputs(ground.high, crank, *bars):
        return False
    reach = KITE * math.fsum((float(ground), crank, *bars))
    return bool(max(abs((ground - Sum(float(crank))).constant), abs(bars[0] - bars[1])) <= reach)


def slider_root(crank: float, rod: float, eccentricity: Sum, reference: Sum) -> LoopRoot:
    """Return the root of crank pin against a line: √((r3-e)(r3+e)), e = eccentricity - r2 cos ψ.

    `eccentricity` is how far the crank's pivot lies left of the line of travel.
    """
    if are_inputs(crank, rod, eccentricity.high):
        return _slider_of_inputs(crank, rod, eccentricity.constant, reference)
    r, b, e = Fraction(crank), Fraction(rod), eccentricity.fraction
    left, right = (eccentricity.high, eccentricity.low), (-eccentricity.high, -eccentricity.low)
    return LoopRoot(
        2.0 * crank,
        factor(gap(rod, *right, -crank), gap(rod, *right, crank), 2 * r, b - e + r),
        factor(gap(rod, *left, -crank), gap(rod, *left, crank), 2 * r, b + e + r),
        reference,
    )


def slot_root(ground: Sum, crank: float, offset: float, reference: Sum) -> LoopRoot:
    """Return the root of a slot through the crank pin: √((L-o)(L+o)), L from slot pivot to pin."""
    if are_inputs(ground.high, crank, offset):
        return _slot_of_inputs(ground.constant, crank, offset, reference)
    g, r, o = ground.fraction, Fraction(crank), Fraction(offset)
    length = ground.high, ground.low
    least = gap(*length, -crank, -offset) * gap(*length, -crank, offset)
    most = (g + r) ** 2 - o**2
    touching = 0 in (gap(*length, crank, -offset), gap(*length, crank, offset))
    only = factor(least, _unless(touching, most), 4 * g * r, most)
    spread = Constant(4.0 * ground.high * crank, 4 * g * r)
    return LoopRoot(spread, ALWAYS, only, reference)


def _unless(touching: bool, most: Fraction) -> float:
    """Return the greatest value of a factor; 0 where the bars just reach each other, once a turn."""
    return 0.0 if touching else nearest(most)


# The same roots where lengths are inputs of the program: of many linkages at once, none of them within the
# last digits of a change point. Where a gap is a small share of the lengths in it, what rounding takes from
# their sums is added.


class Unlike(Exception):
    """A linkage that is solved by itself, not with others of its form."""


def _gap(one: tuple[Value, Value], other: tuple[Value, Value], *, exact: bool) -> Value:
    """Return the difference of two sums of two lengths each; `exact` with what rounding takes from them."""
    if not exact:
        return (one[0] - other[0]) + (one[1] - other[1])
    (total, lost), (taken, lost_too) = two_sum(*one), two_sum(*other)
    gap: Value = (total - taken) + (lost - lost_too)
    return gap


def _sized(leasts: Callable[[bool], list[Value]], ample: Value, least: Value) -> tuple[bool, list[Value]]:
    """Return the least values of factors, from rounded gaps where these are larger than `ample`, and whether.

    Otherwise they are made of exact gaps; Unlike where one of them is smaller than `least`.
    """
    for exact, size in ((False, ample), (True, least)):
        smallest = leasts(exact)
        if size < reduce(minimum, [one if known(one) > 0 else -one for one in smallest]):
            return not exact, smallest
    raise Unlike


def _of_inputs(least: Value, most: Value) -> Factor:
    """Return a factor that is known by its lengths, its reach to a float's digits."""
    if known(least) > 0 or not most > 0:
        return Factor(least, most, quarter_turns(2), Sum(0.0))
    root, other = sqrt(most), sqrt(-least)
    return Factor(least, most, Sum(arctan2(root, other) * 2.0), Sum(arctan2(other, root) * 2.0))


def _four_bar_of_inputs(ground: Value, crank: Value, bars: tuple[Value, Value], reference: Sum) -> LoopRoot:
    """Return the root of a four-bar as `four_bar_root` does."""
    g, r, a, b = ground, crank, *bars
    both, others, apart, unlike = a + b, g + r, g - r, a - b
    perimeter = both + others

    def leasts(exact: bool) -> list[Value]:
        pairs = ((a, b), (g, r)), ((g, b), (a, r)), ((g, a), (b, r))
        stretched, inner, outer = (_gap(*pair, exact=exact) for pair in pairs)
        return [stretched * perimeter, inner * outer]

    square = perimeter * perimeter
    ample, least = _sized(leasts, square * CLOSE, square * CLOSEST)
    plain = all(known(one) > 0 for one in least)
    spread, unit = (2.0 * r, 2.0 * g) if plain else (1.0, 4.0 * g * r)
    u_least, w_least = (over(one, unit) for one in least)
    if plain:
        factors = _of_inputs(u_least, u_least + spread), _of_inputs(w_least, w_least + spread)
    else:
        u = _of_inputs(u_least, over((both - apart) * (both + apart), unit))
        factors = u, _of_inputs(w_least, over((others - unlike) * (others + unlike), unit))
    return LoopRoot(spread, *factors, reference, unit, ample)


def _slider_of_inputs(crank: Value, rod: Value, eccentricity: Value, reference: Sum) -> LoopRoot:
    """Return the root of a slider as `slider_root` does."""
    r, b, e = crank, rod, eccentricity

    def leasts(exact: bool) -> list[Value]:
        return [_gap((b, 0.0), (r, one), exact=exact) for one in (e, -e)]

    ample, (u, w) = _sized(leasts, r * (2 * WIDE), (b + r) * CLOSEST)
    return LoopRoot(2.0 * r, _of_inputs(u, (b - e) + r), _of_inputs(w, (b + e) + r), reference, ample=ample)


def _slot_of_inputs(ground: Value, crank: Value, offset: Value, reference: Sum) -> LoopRoot:
    """Return the root of a slot as `slot_root` does."""
    g, r, o = ground, crank, offset

    def leasts(exact: bool) -> list[Value]:
        inner, outer = (_gap((g, 0.0), (r, one), exact=exact) for one in (o, -o))
        return [inner * outer]

    square = (g + r) * (g + r)
    _, (least,) = _sized(leasts, square * CLOSE, square * CLOSEST)
    only = _of_inputs(least, ((g + r) - o) * ((g + r) + o))
    return LoopRoot(4.0 * g * r, ALWAYS, only, reference, ample=True)


# Signed roots: how a dyad closes where its bars fall into one line, with all its digits and a smooth motion.
#
# **Why.** Bars a and b hang on two pins P and Q, L apart. They meet in the corner B of a triangle; with
# D = Q - P and p = L² + a² - b², from the cosine rule and Heron's formula,
#
#     B = P + D (p + i q)/(2 L²)      q = ±√(U·W)      U = (a + b)² - L²      W = L² - (a - b)²
#
# |q| is four times the triangle's area, its sign the side of D on which B lies: the assembly. U vanishes
# where the bars lie stretched in one line, W where they lie folded. Computed as written, U is there a
# difference of rounded numbers: an error of 1e-16 in U becomes 1e-8 in its root, a negative U gives no pose
# at all, and a sign chosen pose by pose is chosen by chance. So here q is not the root of a product, but the
# product of two roots, each of them a smooth function of the crank's angle with a sign of its own.
#
# **The two factors.** P is the pin of a crank r on a fixed pivot, Q a fixed pin at g from that pivot, ψ the
# crank's angle from the line of the two. L² = g² + r² - 2 g r cos ψ, in half angles (Uicker, Pennock and
# Shigley, Theory of Machines and Mechanisms, for the loop; the half angles take its cancellation away):
#
#     U = cU + K cos²(ψ/2)      cU = (a + b - g - r)(a + b + g + r)
#     W = cW + K sin²(ψ/2)      cW = (g - r - a + b)(g - r + a - b)      K = 4 g r
#
# The c are products of sums of lengths as they were given, so nothing cancels. A slider (U, W = b ∓ e, with
# e = e₀ - r cos ψ and K = 2 r) and a slot (W alone) have the same form; `four_bar_root`, `slider_root` and
# `slot_root` return them, the four-bar's over 2 g, so that its K is 2 r, or over 4 g r where a factor
# vanishes: its K is then 1. The sign of c tells what a factor does:
#
# - c > 0: it never vanishes. Where both are positive the crank turns fully, each closure on its own.
# - c = 0: a **change point**. √U is √K cos(ψ/2), with the cosine's sign: it goes through zero as smoothly as
#   the cosine does, and behind it B lies on the other side, where a linkage with mass would go, too. cos(ψ/2)
#   is back after two turns: so is a linkage with one change point. With two, √U √W = K/2 sin ψ is back after
#   one: the parallelogram is the one sign of that product, the antiparallelogram the other.
# - c < 0: a **limit**. The crank stops at ψm with cos²(ψm/2) = -cU/K, and
#
#       U = K (cos²(ψ/2) - cos²(ψm/2)) = K sin x sin y,      x, y = (ψm - ψ)/2, (ψm + ψ)/2
#
#   are half the distances left to the two limits. The input swings, θ = mid - amp cos φ, so these halves are
#   u = amp cos²(φ/2) and v = amp sin²(φ/2), and their roots √u = √amp cos(φ/2) and √v = √amp sin(φ/2) have
#   signs. √U = √K √u √v √(sin u/u) √(sin v/v): smooth in φ, through both limits and back on the other
#   closure. (A limit that the input does not reach, because of another dyad, gives √sin x, always positive.)
#
# **Rates.** The two bars turn differently by ρ = (L²)'/q, and (L²)' = K sin(ψ/2) cos(ψ/2) ψ'. Where q
# vanishes, so does something above it: at a change point the same cosine or sine, at a limit the rate ψ' = 2
# √u √v φ'. It is divided out before anything is computed (`_Part.left`, `Ends.share_of_rate`), and ρ is a
# quotient of regular functions, finite wherever the phase stands; `Slope` carries its derivative along. By
# angle instead of phase the rate does not vanish at a limit: ρ is infinite there, as it ought to be.
#
# A dyad whose ends both move has no such factors; `closing` says what stands in for them.

LAMBERT_DEPTH = 23


class Reduced(NamedTuple):
    """D between the two ends of a dyad, and q, both divided by what vanishes where the ends meet."""

    across: MovingPoint
    q: Value


@frozen
class SignedRoot:
    """q, the ratio ρ = (L²)'/q, and the signed √U where q is a product of two roots.

    `altitude` closes a dyad whose two ends meet on the way. `excess` is cot(ψ/2) - 2 q'/q, by the angle of
    a crank that W limits: it tells how far q is from sin(ψ/2), its form for equal bars on pins that meet at
    ψ = 0.
    """

    q: Value
    ratio: Slope
    root_u: Value = 0.0
    altitude: Reduced | None = None
    excess: Value | None = None

    def times(self, sign: int) -> SignedRoot:
        """Return the root of the closure on the other side where `sign` is -1."""
        factor = float(sign)
        altitude = self.altitude and Reduced(self.altitude.across, self.altitude.q * factor)
        return SignedRoot(
            self.q * factor, self.ratio.scaled(factor), self.root_u * factor, altitude, self.excess
        )

    def with_altitude(self, altitude: Reduced) -> SignedRoot:
        """Return the root of a dyad whose ends meet on the way."""
        return replace(self, altitude=altitude)


def plain_root(u: Value, w: Value, separation: Moving, half_difference: Value) -> SignedRoot:
    """Return the root of factors that do not vanish, with U' = -g and W' = g, g the separation's rate.

    `half_difference` is (U - W)/2, or 1/2 where there is no U: q' = ρ times that.
    """
    return rated_root(sqrt(w * u), separation, half_difference)


def rated_root(q: Value, separation: Moving, half_difference: Value) -> SignedRoot:
    """Return a root of known sign, with its rates as of one that does not vanish here."""
    ratio = separation.rate / q
    return SignedRoot(q, Slope(ratio, (separation.second - ratio * ratio * half_difference) / q))


def signed_root(root: LoopRoot, half: Half, pace: Slope, swing: Ends | None) -> SignedRoot:
    """Return q of a loop closed from a crank pin, signed through change points and limits.

    `half` is ψ/2, sharpened where the loop limits the input; `pace` is ψ'.
    """
    if root.u.kind is Kind.PLAIN and root.w.kind is Kind.PLAIN:
        return _turning_root(root, half, pace)
    return _product_root(root, half, pace, swing)


def _turning_root(root: LoopRoot, half: Half, pace: Slope) -> SignedRoot:
    """Return q and ρ where neither factor vanishes; ρ' keeps its digits however near zero they come.

    At a steady pace ρ' = K ψ'² (cW c²/W - cU s²/U)/(2 q), as in `_root_by_angle`.
    """
    w, squares = pace.value, half.squares(root.spread)
    (u, v), cosine = factor_values(root, half), squares.cosine
    if root.wide:
        cosine = root.spread - squares.sine
    square = v * u
    q = sqrt(square)
    bend = (cosine * u * (0.5 * root.w.least) - squares.sine * v * (0.5 * root.u.least)) / square
    rates = Slope(squares.product * w / q, (bend * (w * w) + squares.product * pace.rate) / q)
    return SignedRoot(q, rates)


def sign_of_root(root: LoopRoot, half: Half) -> int:
    """Return the sign of q just after a swing's lower limit or at an angle of a turn, in plain floats.

    Only a change point changes it: every other factor of q is positive there.
    """
    sides = ((root.u, half.cosine), (root.w, half.sine))
    return math.prod(-1 if factor.kind is Kind.CHANGE_POINT and side < 0 else 1 for factor, side in sides)


def factor_values(root: LoopRoot, half: Half) -> tuple[Value, Value]:
    """Return U (1 where there is none) and W."""
    squares = half.squares(root.spread)
    w = squares.sine + root.w.least
    if root.single:
        return 1.0, w
    return root.u.most - squares.sine if root.wide else squares.cosine + root.u.least, w


@frozen
class _Ways:
    """Half the distances x and y to a factor's own two limits, and which of these are ends of the swing.

    `short` completes x + y to π; `sign` is that of cos(ψ/2) (sin(ψ/2) for W) over the whole swing.
    """

    ends: Ends
    x: Slope
    y: Slope
    upper: bool
    lower: bool
    short: Any
    sign: float

    @property
    def touching(self) -> Value:
        """cos(ψ/2) of U, sin(ψ/2) of W: to its own last digit, however near π the limits lie."""
        return sine_within(minimum(self.x.value, self.y.value) + 0.5 * self.short) * self.sign

    @property
    def sign_of_root(self) -> Value:
        """The sign of the factor's root: the product of the signs of √u and √v at the ends that it sets."""
        sign: Value = 1.0
        for held, root in ((self.upper, self.ends.root_u), (self.lower, self.ends.root_v)):
            if held and self.ends.signed:
                sign = sign * select(root.value, 0.0, -1.0, 1.0)
        return sign

    @property
    def sines(self) -> Value:
        """sin x sin y: the factor over K."""
        x, y = self.x.value, self.y.value
        return sine_within(minimum(x, y + self.short)) * sine_within(minimum(y, x + self.short))


def _ways(root: LoopRoot, factor: Factor, swing: Ends | None) -> _Ways | None:
    """Return half the distances to the limits that a factor sets; None where it sets none."""
    if swing is None or factor.kind is not Kind.LIMIT:
        return None
    best = root.reference if factor is root.u else root.reference + HALF_TURN
    middle = (swing.low + swing.high).constant / 2
    turns = round(known(middle - best.constant) / (2 * math.pi))
    best = best + FULL_TURN.times(float(turns)) if turns else best
    upper, lower = (best + factor.reach - swing.high).constant, (swing.low - (best - factor.reach)).constant
    at_upper, at_lower = known(upper) <= OWN_LIMIT, known(lower) <= OWN_LIMIT
    u, v = swing.u, swing.v
    return _Ways(
        swing,
        u if at_upper else Slope(u.value + 0.5 * upper, u.rate),
        v if at_lower else Slope(v.value + 0.5 * lower, v.rate),
        at_upper,
        at_lower,
        factor.short.constant,
        -1.0 if turns % 2 else 1.0,
    )


def sharpened(root: LoopRoot, half: Half, swing: Ends | None) -> Half:
    """Return ψ/2, its sine or cosine right to the last digit where a limit keeps that from vanishing."""
    ways_u, ways_w = _ways(root, root.u, swing), _ways(root, root.w, swing)
    cosine = ways_u.touching if ways_u else half.cosine
    if ways_w:
        return half_of(ways_w.touching, cosine)
    return half_of(half.sine, cosine) if ways_u else half


def _product_root(root: LoopRoot, half: Half, pace: Slope, swing: Ends | None) -> SignedRoot:
    """Return q as the product of its two signed roots, and ρ with what vanishes in both divided out."""
    if swing is not None and not swing.by_phase:
        return _root_by_angle(root, half, pace, swing)
    half_rate, scale = pace.value * 0.5, root_of(root.spread)
    first = half.squares(root.spread).product * pace.value
    u, w = factor_values(root, half)
    sine = Slope(half.sine, half.cosine * half_rate)
    cosine = Slope(half.cosine, -(half.sine * half_rate))
    plain_u = Slope(u, 0.0 if root.single else -first)
    part_u = _part(root.u, plain_u, cosine, scale, _ways(root, root.u, swing))
    part_w = _part(root.w, Slope(w, first), sine, scale, _ways(root, root.w, swing))
    upper, lower = part_u.upper or part_w.upper, part_u.lower or part_w.lower
    share = pace
    if swing is not None and (upper or lower):
        share = swing.share_of_rate(upper, lower)
    numerator = share.scaled(root.spread) * part_u.left * part_w.left
    ratio = numerator / (part_u.regular * part_w.regular)
    return SignedRoot(part_u.whole * part_w.whole, ratio, part_u.whole)


def _root_by_angle(root: LoopRoot, half: Half, pace: Slope, swing: Ends) -> SignedRoot:
    """Return q and ρ where the input's angle is given, so that nothing vanishes above a limit's root.

    ρ = K s c ψ'/(√U √W) with s, c of ψ/2, and at a steady pace ρ' = ρ ψ' (cW c/(s W) - cU s/(c U))/2: next to
    a change point the rates of U, W, s and c nearly cancel, and the terms that do are not formed.
    """
    scale, (u, w) = root_of(root.spread), factor_values(root, half)
    part_u = _part_by_angle(root.u, _ways(root, root.u, swing), u, (half.cosine, half.sine), scale)
    part_w = _part_by_angle(root.w, _ways(root, root.w, swing), w, (half.sine, half.cosine), scale)
    share = root.spread / (part_u.regular * part_w.regular)
    ratio = share * part_u.left * part_w.left
    bend = (part_w.bend * part_u.left - part_u.bend * part_w.left) * share * 0.5
    rates = Slope(ratio * pace.value, ratio * pace.rate + bend * (pace.value * pace.value))
    excess = None
    if root.w.kind is Kind.LIMIT and root.u.kind is not Kind.CHANGE_POINT:
        excess = part_w.bend / half.sine + half.sine * half.cosine * root.spread / part_u.value
    return SignedRoot(part_u.whole * part_w.whole, rates, part_u.whole, excess=excess)


class _PartByAngle(NamedTuple):
    """A factor F and its signed root: whole, its regular part, what is left of sin or cos(ψ/2), and c/F.

    `bend` is c/F times the other one of sin and cos(ψ/2).
    """

    value: Value
    whole: Value
    regular: Value
    left: Value
    bend: Value


def _part_by_angle(
    factor: Factor, ways: _Ways | None, value: Value, sides: tuple[Value, Value], scale: float
) -> _PartByAngle:
    """Return the root of a factor F; `sides` are the side of ψ/2 that vanishes with F, and the other one."""
    touching, other = sides
    if factor.kind is Kind.CHANGE_POINT:
        return _PartByAngle(value, touching * scale, scale, 1.0, 0.0)
    value = value if ways is None else ways.sines * (scale * scale)
    whole = sqrt(value) * (1.0 if ways is None else ways.sign_of_root)
    return _PartByAngle(value, whole, whole, touching, other * factor.least / value)


class _Part(NamedTuple):
    """One signed root: whole, its regular part, what is left of sin or cos(ψ/2), the ends it holds."""

    whole: Value
    regular: Slope
    left: Slope
    upper: bool = False
    lower: bool = False


def _part(factor: Factor, value: Slope, touching: Slope, scale: float, ways: _Ways | None) -> _Part:
    """Return the root of a factor; where the root comes from a limit, `value` need not have digits."""
    if factor.kind is Kind.CHANGE_POINT:
        return _Part(touching.value * scale, Slope(scale), Slope(1.0))
    if ways is None:
        whole = sqrt(value.value)
        return _Part(whole, Slope(whole, value.rate * 0.5 / whole), touching)
    regular = _root_of_sine(ways.x, ways.y.value + ways.short, divided=ways.upper)
    regular = regular * _root_of_sine(ways.y, ways.x.value + ways.short, divided=ways.lower)
    regular = regular.scaled(scale)
    whole = regular.value
    whole = whole * ways.ends.root_u.value if ways.upper else whole
    whole = whole * ways.ends.root_v.value if ways.lower else whole
    return _Part(whole, regular, touching, ways.upper, ways.lower)


def _root_of_sine(x: Slope, supplement: Value, *, divided: bool) -> Slope:
    """Return √sin x, or √(sin x / x) where `divided`; near π the supplement keeps the digits."""
    safe = maximum(x.value, SMALLEST)
    sine = sine_within(minimum(safe, supplement))
    if not divided:
        root = sqrt(sine)
        return Slope(root, root * 0.5 * (cosine_within(x.value) / sine) * x.rate)
    root = sqrt(sine / safe)
    return Slope(root, root * 0.5 * _logarithmic_slope(x.value, safe, sine) * x.rate)


def _logarithmic_slope(x: Value, safe: Value, sine: Value) -> Value:
    """Return cot x - 1/x, by Lambert's continued fraction where the difference would cancel.

    It is that of the tangent, turned over (Abramowitz and Stegun, Handbook of Mathematical Functions).
    """
    square = x * x
    fraction: Value = float(LAMBERT_DEPTH)
    for odd in range(LAMBERT_DEPTH - 2, 1, -2):
        fraction = float(odd) - square / fraction
    return select(x, 1.0, -(x / fraction), cosine_within(x) / maximum(sine, SMALLEST) - 1.0 / safe)
