"""Two bars that meet in a pin: the dyad of four-bars and six-bars.

Bars a (from P) and b (from Q) meet at B = P + D·(p + i q)/(2L²) with D = Q - P, L = |D|,
p = L² + a² - b² and the signed root q: no arc functions, no √L. The bars turn at

    ω_a = e - ρ (L² + b² - a²)/(2L²)     ω_b = e + ρ (L² + a² - b²)/(2L²)

with e = D × D'/L² and ρ = (L²)'/q, which stays finite through a limit where q and the input's rate
vanish together (differentiate the closure in the phase).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from linkanim.mechanics.formulas.planar import MovingPoint, Slope, Vec, carried
from linkanim.mechanics.linkage.joint import Joint, Need
from linkanim.mechanics.loops.loop import Loop, ground_between
from linkanim.mechanics.loops.roots import four_bar_root
from linkanim.mechanics.loops.triangle import Triangle, moving_triangle, pin_triangle

if TYPE_CHECKING:
    from linkanim.mechanics.closing.walk import Walk
    from linkanim.mechanics.linkage.linkage import Linkage
    from linkanim.mechanics.loops.loop import Gearing


@dataclass(frozen=True, slots=True)
class RRR(Joint):
    """Two bars that meet in a pin: `lengths[i]` from `ends[i]`.

    `side` is +1 where the pin lies left of the line from `ends[0]` to `ends[1]`, -1 right.
    With `side_of = (b, p, q)` it says instead on which side of p -> q the joint b lies just
    after the start of the drive (a four-bar driven at its rocker is named that way).
    """

    ends: tuple[str, str]
    lengths: tuple[float, float]
    side: int = 1
    side_of: tuple[str, str, str] | None = None

    sides: ClassVar[tuple[str, str]] = ("left", "right")
    dyad: ClassVar[bool] = True

    @property
    def needs(self) -> tuple[Need, ...]:
        """The far ends of its two bars."""
        return Need("from", self.ends[0]), Need("from", self.ends[1])

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """Its two bars."""
        return (self.ends[0], self.lengths[0]), (self.ends[1], self.lengths[1])

    @property
    def pins(self) -> tuple[str, ...]:
        """The far ends of its bars, and the joint itself."""
        return *self.ends, self.name

    @property
    def named_sign(self) -> int:
        """The sign of the root: left of the line, or of the closure that another joint's side names."""
        return -self.side if self.side_of else self.side

    @property
    def named_from(self) -> tuple[int, str, str, str] | None:
        """The side of a line on which another joint lies, where that names the closure."""
        return (self.side, *self.side_of) if self.side_of else None

    def scaled(self, factor: float) -> RRR:
        """Return the dyad with its bars times a factor."""
        return replace(self, lengths=(self.lengths[0] * factor, self.lengths[1] * factor))

    def loop(self, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
        """Return the loop of a crank pin against a fixed pin."""
        for swapped in (False, True):
            (moving, fixed), bars = _turned(self, swapped)
            crank = linkage.crank(moving) if moving in gears else None
            if crank and linkage.joint(crank.pivot).fixed and linkage.joint(fixed).fixed:
                ground = ground_between(linkage, crank, fixed)
                if ground is None:
                    return None
                root = four_bar_root(ground.exact, crank.length, bars, ground.angle)
                return Loop(moving, crank, gears[moving], ground, root, swapped)
        return None

    def close(self, walk: Walk) -> None:
        """Add where the two bars meet, and how they turn."""
        loop, sign = walk.assembly.loops.get(self.name), walk.assembly.signs[self.name]
        swapped = loop is not None and loop.swapped
        (first, second), lengths = _turned(self, swapped)
        p, q = walk.points[first], walk.points[second]
        sign = -sign if swapped else sign
        if loop is not None:
            root, pin = walk.pin_loop(loop, sign)
            triangle = pin_triangle(pin, lengths, root)
        else:
            across = q - p
            root = walk.span_root(self.name, across, lengths).times(sign)
            triangle = moving_triangle(across, lengths, root)
        found = _meet(p, q, lengths, triangle)
        walk.points[self.name] = found.point
        arms = ((found.turning_a, first, found.arm_a), (found.turning_b, second, found.arm_b))
        for turning, end, arm in reversed(arms) if swapped else arms:
            walk.add_piece(turning, (end, self.name), arm)

    def transmission(self, u: float, w: float) -> float:
        """Return the angle μ between its bars' lines: tan²(μ/2) = W/U or, past 90°, U/W.

        It is the cosine rule in its half-angle form.
        """
        return 2 * math.atan2(math.sqrt(min(u, w)), math.sqrt(max(u, w)))

    def transmission_at(self, place: Callable[[str], Any]) -> Any:
        """Return the angle between its bars' lines."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        one, other = (place(end) - place(self.name) for end in self.ends)
        product = one * other.conjugate()
        return np.arctan2(abs(product.imag), abs(product.real))

    def why_apart(self, u: float, w: float) -> str:
        """Say how near its ends come, or how far apart: U = (a + b)² - L², W = L² - (a - b)²."""
        a, b = self.lengths
        least, most = math.sqrt(max((a + b) ** 2 - u, 0.0)), math.sqrt(max((a - b) ** 2 + w, 0.0))
        if w < 0:
            apart = f"at most {most:.6g}; these bars need {abs(a - b):g}"
        else:
            apart = f"at least {least:.6g}; these bars reach {a + b:g}"
        ends = "–".join(self.ends)
        return f"the bars of {a:g} and {b:g} cannot meet at any angle of the input: {ends} is {apart}"


def _turned(joint: RRR, swapped: bool) -> tuple[tuple[str, str], tuple[float, float]]:
    """Return ends and lengths, in the other order where `swapped`."""
    return (joint.ends[::-1], joint.lengths[::-1]) if swapped else (joint.ends, joint.lengths)


class _Meeting(NamedTuple):
    """The joint in which two bars meet: the bars as vectors, and how they turn."""

    arm_a: Vec
    arm_b: Vec
    turning_a: Slope
    turning_b: Slope
    point: MovingPoint


def _meet(p: MovingPoint, q: MovingPoint, lengths: tuple[float, float], triangle: Triangle) -> _Meeting:
    """Return where two bars meet, and how they turn.

    The shorter bar carries the joint, since its direction is sharper; the longer one, which turns
    less, has its rate worked out, and the shorter one's is ρ away.
    """
    d, t, rho = triangle.across, triangle, triangle.ratio
    if lengths[0] < lengths[1]:
        arm_a = d.scaled(t.near) + t.lift
        arm_b = arm_a - d
        turning_b = t.turn_of_longer(True)
        turning_a = turning_b.plus(-rho.value, -rho.rate)
        return _Meeting(arm_a, arm_b, turning_a, turning_b, p + carried(arm_a, turning_a))
    arm_b = t.lift - d.scaled(t.far)
    arm_a = arm_b + d
    turning_a = t.turn_of_longer(False)
    turning_b = turning_a.plus(rho.value, rho.rate)
    return _Meeting(arm_a, arm_b, turning_a, turning_b, q + carried(arm_b, turning_b))
