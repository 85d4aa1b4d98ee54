"""Where the signed root of a loop closed from a crank pin vanishes: its two factors U and W.

    U = cU + K cos²(ψ/2)        W = cW + K sin²(ψ/2)

with ψ the crank's angle from the ground line (or a quarter turn behind the normal of a line of travel).
`signed` derives them, and says what a factor does at c > 0, c = 0 and c < 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal, localcontext
from enum import Enum
from fractions import Fraction

from linkanim.mechanics.formulas.constant import Constant, nearest
from linkanim.mechanics.formulas.exact import HALF_TURN, Sum, gap, quarter_turns, total
from linkanim.mechanics.formulas.precise import context, nearest_sum, sine_and_cosine

_STEPS, _SETTLED = 8, Decimal("1e-24")
"""Newton's steps at the most, and one after which the next is below all digits of the sum."""
ALIKE = 2.0**-51
"""Share of the perimeter that rounded lengths of a kite may differ by."""
WIDE = 1 / 16
"""Share of K above which U is its greatest value less K sin²(ψ/2)."""


class Kind(Enum):
    """What one factor of the root does over the crank's turn."""

    PLAIN = "never vanishes"
    CHANGE_POINT = "touches zero: the smooth path changes its sign"
    LIMIT = "crosses zero: the crank can go no further"


@dataclass(frozen=True, slots=True)
class Factor:
    """One factor of the root: `least` + K·cos² (or sin²), between `least` and `most`.

    `reach` is how far ψ may go from the factor's own best position (0 for U, π for W), and
    `short` what is missing to π; both are sums of two floats, since a rounded limit costs the
    velocity next to it half its digits.
    """

    least: float
    most: float
    reach: Sum
    short: Sum

    @property
    def kind(self) -> Kind:
        """Tell what the factor does."""
        if self.least == 0:
            return Kind.CHANGE_POINT
        return Kind.PLAIN if self.least > 0 else Kind.LIMIT


ALWAYS = Factor(1.0, 1.0, quarter_turns(2), Sum(0.0))


@dataclass(frozen=True, slots=True)
class LoopRoot:
    """U, W and K of one loop. `reference` is the angle of the crank at ψ = 0.

    `spread` is K, by which each factor varies over a turn; lengths squared are taken over `unit`.
    """

    spread: float
    u: Factor
    w: Factor
    reference: Sum
    unit: float = 1.0

    @property
    def change_points(self) -> tuple[Sum, ...]:
        """The crank's angles at which a factor touches zero."""
        places = (self.u, self.reference + HALF_TURN), (self.w, self.reference)
        return tuple(place for factor, place in places if factor.kind is Kind.CHANGE_POINT)

    @property
    def wide(self) -> bool:
        """True where U stays so far from zero that its digits do not hang on those of a small cosine."""
        return self.u.least >= WIDE * self.spread or self.single

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
    """Return x with sin²(x/2) = square as a sum of two floats: Newton's steps from a float.

    One is enough but next to a right angle, where what is missing to it is to be right to its own digits.
    """
    with localcontext(context()):
        target = Decimal(square.numerator) / Decimal(square.denominator)
        half = Decimal(half_guess)
        for _ in range(_STEPS):
            sine, cosine = sine_and_cosine(half)
            half += (step := (target - sine * sine) / (2 * sine * cosine))
            if abs(step) < _SETTLED:
                break
        return nearest_sum(2 * half)


def four_bar_root(ground: Sum, crank: float, bars: tuple[float, float], reference: Sum) -> LoopRoot:
    """Return the root of crank pin against fixed pin: ground r1, crank r2, bars r3, r4.

    cU = (r3+r4-r1-r2)(r3+r4+r1+r2) and cW = (r1-r2-r3+r4)(r1-r2+r3-r4). Where neither root vanishes they
    are taken over 2 r1, as q is: K is 2 r2, which the crank's pin needs anyway. Else over 4 r1 r2: K is 1,
    of which the root is exact.
    """
    coupler, rocker = bars
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
    reach = ALIKE * math.fsum((float(ground), crank, *bars))
    return max(abs((ground - Sum(float(crank))).constant), abs(bars[0] - bars[1])) <= reach


def slider_root(crank: float, rod: float, eccentricity: Sum, reference: Sum) -> LoopRoot:
    """Return the root of crank pin against a line: √((r3-e)(r3+e)), e = eccentricity - r2 cos ψ.

    `eccentricity` is how far the crank's pivot lies left of the line of travel.
    """
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
    g, r, o = ground.fraction, Fraction(crank), Fraction(offset)
    length = ground.high, ground.low
    least = gap(*length, -crank, -offset) * gap(*length, -crank, offset)
    most = (g + r) ** 2 - o**2
    touching = 0 in (gap(*length, crank, -offset), gap(*length, crank, offset))
    only = factor(least, _unless(touching, most), 4 * g * r, most)
    spread = Constant(4.0 * ground.high * crank, 4 * g * r)
    return LoopRoot(spread, ALWAYS, only, reference)


def _unless(touching: bool, most: Fraction) -> float:
    """Return the greatest value of a factor; none where the bars just reach each other, once a turn."""
    return 0.0 if touching else nearest(most)
