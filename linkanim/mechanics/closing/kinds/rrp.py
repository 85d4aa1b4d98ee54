"""A bar to a slider on a line: the dyad of slider-cranks, and of rams on guides that move themselves."""

from __future__ import annotations

from collections.abc import Mapping

from linkanim.mechanics.closing.chain import Closing
from linkanim.mechanics.closing.walk import Assembly, Walk, guide
from linkanim.mechanics.formulas.exact import Sum, exact_angle, quarter_turns, snapped
from linkanim.mechanics.formulas.planar import Moving
from linkanim.mechanics.linkage.dyads import RRP
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.loop import Gearing, Loop, aside_of
from linkanim.mechanics.loops.roots import slider_root
from linkanim.mechanics.loops.signed import SignedRoot


def loop(joint: RRP, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin against the line, where both stand on the ground."""
    crank = linkage.crank(joint.end) if joint.end in gears else None
    if crank is None or joint.line.on or not linkage.joint(crank.pivot).fixed:
        return None
    pivot, through = linkage.pin(crank.pivot), linkage.pin(joint.line.through)
    aside = aside_of(linkage, pivot, through, joint.line.angle)
    tie = joint.length - crank.length
    reach = sum(abs(a - b) for a, b in zip(pivot.position, through.position, strict=True))
    eccentricity = snapped(aside - Sum(joint.line.offset), (0.0, tie, -tie), reach + abs(joint.line.offset))
    reference = exact_angle(joint.line.angle) - quarter_turns(1)
    root = slider_root(crank.length, joint.length, eccentricity, reference)
    return Loop(joint.end, crank, gears[joint.end], None, root)


def close(joint: RRP, walk: Walk) -> None:
    """Add the slider: its way along the line is that of the bar's end and the root q = ±√(b² - e²).

    With e how far the end lies left of the line and ρ = e'/q the bar turns at -ρ, seen from the line.
    """
    rail, point = guide(joint.line, walk), walk.points[joint.end]
    forward, aside = rail.forward(point), rail.aside(point)
    root = _root(joint, walk, aside)
    rho, q = root.ratio, root.q
    travel = Moving(
        forward.value + q,
        forward.rate - aside.value * rho.value,
        forward.second - (aside.rate * rho.value + aside.value * rho.rate),
    )
    walk.points[joint.name] = rail.place(travel)
    walk.travels[joint.name] = travel
    arm = rail.along.scaled(q) - rail.along.left().scaled(aside.value)
    walk.add_piece(rail.turning.plus(-rho.value, -rho.rate), (joint.end, joint.name), arm)


def _root(joint: RRP, walk: Walk, aside: Moving) -> SignedRoot:
    loop, sign = walk.assembly.loops.get(joint.name), walk.assembly.signs[joint.name]
    if loop is not None:
        return walk.loop_root(loop, sign)[0]
    u, w = joint.length - aside.value, joint.length + aside.value
    return walk.chain_root(joint.name, Closing(u, w, aside, False, None, squared=False)).times(sign)


def linkage_name(joint: RRP, assembly: Assembly) -> str:
    """Return slider-crank or slider-rocker, and whether the line runs past the pivot."""
    loop = assembly.loops.get(joint.name)
    if loop is None:
        return "slider linkage"
    eccentric = loop.root.u.least != loop.root.w.least
    turns = "slider-crank" if assembly.path.full_turn else "slider-rocker"
    return f"{'offset' if eccentric else 'in-line'} {turns}"
