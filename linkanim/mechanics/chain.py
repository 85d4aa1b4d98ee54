"""The signed root of a dyad on moving points that limits the input, or passes change points.

Its margin F = U·W vanishes with the way to the limit: F = uⁱ vʲ S with S smooth and positive. So
q = √uⁱ √vʲ √S is signed like any limit's, and next to the limit S comes from a polynomial, since
F itself has lost its digits there. Between the limits S is F over the ways.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from .clock import Clock, Ends
from .exact import Sum
from .expression import Value, maximum, select, sqrt
from .planar import Moving, Slope
from .signed import SMALLEST, SignedRoot, plain_root

CLOSE = 1e-10
"""Square of the way within which an input counts as next to a change point."""


@dataclass(frozen=True, slots=True)
class NearEnd:
    """S over the way to its limit: a polynomial in way/width, for ways below `width`."""

    width: float
    coefficients: tuple[float, ...]

    def slope(self, way: Value) -> Slope:
        """Return the polynomial and its derivative in the way (Horner)."""
        x = way * (1.0 / self.width)
        value: Value = self.coefficients[-1]
        rate: Value = 0.0
        for coefficient in self.coefficients[-2::-1]:
            rate = rate * x + value
            value = value * x + coefficient
        return Slope(value, rate * (1.0 / self.width))


@dataclass(frozen=True, slots=True)
class LimitFit:
    """How a dyad further down the chain behaves next to the ends of the swing that it limits."""

    upper: NearEnd | None
    lower: NearEnd | None


@dataclass(frozen=True, slots=True)
class Touches:
    """Where a dyad on moving points passes a change point, and with it to its other closure.

    `places` are angles of an input that turns, repeating after `turns` turns; of one that swings
    they are phases, since its two ways may run on different closures before this one, and
    `amplitude` is that of the swing. `least` is the smallest margin that its digits can tell from
    none; `sign` makes the named closure the one just after the start.
    """

    places: tuple[Sum, ...]
    turns: int
    amplitude: float | None
    least: float
    sign: float = 1.0

    def side(self, clock: Clock) -> Value:
        """Return the sign of the closure on the smooth path."""
        side: Value = self.sign
        for way in self._ways(clock):
            side = side * _sign(way)
        return side

    def _ways(self, clock: Clock) -> list[Value]:
        """Return the signed sines of half the ways from each change point."""
        if self.amplitude is None or clock.ends is None:
            share = Fraction(1, self.turns)
            return [clock.half(place * share, share).sine for place in self.places]
        scale = 1.0 / math.sqrt(self.amplitude)
        sine, cosine = clock.ends.root_v.value * scale, clock.ends.root_u.value * scale
        halves = [float(place) / 2 for place in self.places]
        return [sine * math.cos(half) - cosine * math.sin(half) for half in halves]

    def root(self, margin: Value, driver: Moving, half_difference: Value, clock: Clock) -> SignedRoot:
        """Return q, signed, and ρ.

        The margin has lost its digits next to a change point: q is good to 1e-8 of the longest link
        there, ρ to 1e-5, and within 1e-5 rad ρ' is left out.
        """
        found = plain_root(maximum(margin, self.least), 1.0, driver, half_difference)
        side, close = self.side(clock), 1e6 * self.least
        # Where g and q vanish together ρ² = g'/(U - W)/2, from q' = ρ (U - W)/2.
        past: Value = 0.0
        for way in self._ways(clock):
            past = past + select(way * way, CLOSE, _sign(way), 0.0)
        limit = sqrt(maximum(driver.second / half_difference, 0.0)) * past * _sign(driver.second)
        ratio = select(margin, close, limit, found.ratio.value)
        rate = select(margin, close, 0.0, found.ratio.rate)
        return SignedRoot(found.q * side, Slope(ratio * side, rate * side))


def _sign(value: Value) -> Value:
    return select(value, 0.0, -1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Margin:
    """F = U·W, half of U - W, and what drives it in time and in the input's angle."""

    value: Value
    half_difference: Value
    in_time: Moving
    in_angle: Moving


def limited_root(margin: Margin, fit: LimitFit, clock: Clock) -> SignedRoot:
    """Return q and ρ, finite through the limits that the dyad sets."""
    ends = clock.ends
    assert ends is not None
    upper, lower = fit.upper is not None, fit.lower is not None
    smooth = _smooth_part(margin, fit, ends)
    root = sqrt(smooth.value)
    q = root * ends.root_u.value if upper else root
    q = q * ends.root_v.value if lower else q
    driver = Slope(margin.in_angle.rate, margin.in_angle.second * clock.rate)
    share = ends.share_of_rate(clock.pace, upper, lower)
    regular = driver * share / Slope(root, smooth.rate * clock.rate * 0.5 / root)
    if upper and lower:
        return SignedRoot(q, regular)
    return SignedRoot(q, _nearest(regular, _in_time(margin, q), ends, upper=upper))


def _smooth_part(margin: Margin, fit: LimitFit, ends: Ends) -> Slope:
    """Return S and its derivative in the input's angle."""
    u, v = (maximum(way.value, SMALLEST) for way in (ends.u, ends.v))
    ways: Value = 1.0
    fall: Value = 0.0
    if fit.upper:
        ways, fall = ways * u, fall + 0.5 / u
    if fit.lower:
        ways, fall = ways * v, fall - 0.5 / v
    value = margin.value / ways
    found = Slope(value, margin.in_angle.rate * margin.half_difference * 2.0 / ways + value * fall)
    if fit.upper:
        found = _switched(ends.u.value, fit.upper, -0.5, found)
    if fit.lower:
        found = _switched(ends.v.value, fit.lower, 0.5, found)
    return found


def _switched(way: Value, near: NearEnd, way_rate: float, otherwise: Slope) -> Slope:
    """Return the polynomial below its width, else what was found without it."""
    fitted = near.slope(way)
    return Slope(
        select(way, near.width, fitted.value, otherwise.value),
        select(way, near.width, fitted.rate * way_rate, otherwise.rate),
    )


def _in_time(margin: Margin, q: Value) -> Slope:
    """Return ρ away from the dyad's own limit, from derivatives in time."""
    ratio = margin.in_time.rate / q
    return Slope(ratio, (margin.in_time.second - ratio * ratio * margin.half_difference) / q)


def _nearest(regular: Slope, in_time: Slope, ends: Ends, *, upper: bool) -> Slope:
    """Return ρ: the regular form in the half of the swing at the dyad's own limit.

    The other end may belong to a dyad before it, whose derivatives in the angle are unbounded there.
    """
    own, other = (ends.u.value, ends.v.value) if upper else (ends.v.value, ends.u.value)
    return Slope(
        select(own, other, regular.value, in_time.value),
        select(own, other, regular.rate, in_time.rate),
    )
