"""Two bars that meet in a pin: the dyad of four-bars and six-bars.

Bars a (from P) and b (from Q) meet at B = P + D·(p + i q)/(2L²) with D = Q - P, L = |D|,
p = L² + a² - b² and the signed root q: no arc functions, no √L. The bars turn at

    ω_a = e - ρ (L² + b² - a²)/(2L²)     ω_b = e + ρ (L² + a² - b²)/(2L²)

with e = D × D'/L² and ρ = (L²)'/q, which stays finite through a limit where q and the input's rate
vanish together (differentiate the closure in the phase).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from linkanim.mechanics.closing.walk import Walk
from linkanim.mechanics.formulas.planar import MovingPoint, Slope, Vec, carried
from linkanim.mechanics.linkage.dyads import RRR
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.loop import Gearing, Loop, pin_against_pin
from linkanim.mechanics.loops.roots import four_bar_root
from linkanim.mechanics.loops.triangle import Triangle, moving_triangle, pin_triangle


def loop(joint: RRR, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin against a fixed pin."""
    found = pin_against_pin(linkage, gears, joint.ends)
    if found is None:
        return None
    crank, ground, swapped = found
    root = four_bar_root(ground.exact, crank.length, _turned(joint, swapped)[1], ground.angle)
    return Loop(crank.name, crank, gears[crank.name], ground, root, swapped)


def close(joint: RRR, walk: Walk) -> None:
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
    found = _meet(p, q, lengths, triangle)
    walk.points[joint.name] = found.point
    arms = ((found.turning_a, first, found.arm_a), (found.turning_b, second, found.arm_b))
    for turning, end, arm in reversed(arms) if swapped else arms:
        walk.add_piece(turning, (end, joint.name), arm)


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
