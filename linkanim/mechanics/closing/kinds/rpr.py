"""A bar that turns on one joint and slides on another: the dyad of inverted slider-cranks."""

from __future__ import annotations

from collections.abc import Mapping

from linkanim.mechanics.closing.walk import Assembly, Walk
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Slope, Vec, carried
from linkanim.mechanics.linkage.dyads import RPR
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.loop import Gearing, Loop, pin_against_pin
from linkanim.mechanics.loops.roots import slot_root
from linkanim.mechanics.loops.signed import Reduced, SignedRoot
from linkanim.mechanics.loops.triangle import PinLoop, moving_triangle, pin_triangle


def loop(joint: RPR, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin and a fixed pin, one in the slot and one the pivot."""
    found = pin_against_pin(linkage, gears, (joint.through, joint.pivot))
    if found is None:
        return None
    crank, ground, swapped = found
    root = slot_root(ground.exact, crank.length, joint.offset, ground.angle)
    return Loop(crank.name, crank, gears[crank.name], ground, root, swapped)


def close(joint: RPR, walk: Walk) -> None:
    """Add the slotted bar and its end."""
    pivot, pin = walk.points[joint.pivot], walk.points[joint.through]
    loop, sign = walk.assembly.loops.get(joint.name), walk.assembly.signs[joint.name]
    if loop is not None:
        root, ground = walk.pin_loop(loop, sign)
        turn = pin_triangle(ground, (0.0, 0.0), root).turn
        direction = _loop_direction(ground, root, (joint.offset, sign), swapped=loop.swapped)
    else:
        across = pin - pivot
        root = walk.slot_root(joint.name, across, joint.offset).times(sign)
        turn = moving_triangle(across, (0.0, 0.0), root).turn
        reduced = root.lift or Reduced(across, root.q)
        direction = _direction(reduced.across.position, reduced.q, joint.offset)
    turning = _turning(turn, root, joint.offset) if joint.offset else turn
    arm = direction.scaled(joint.length)
    walk.points[joint.name] = pivot + carried(arm, turning)
    walk.add_piece(turning, (joint.pivot, joint.name), arm)


def linkage_name(joint: RPR, assembly: Assembly) -> str:
    """Return inverted slider-crank, and how its slotted bar, or the cylinder on its rod, moves."""
    loop = assembly.loops.get(joint.name)
    if loop is None or loop.ground is None:
        return "inverted slider-crank"
    kind = "rotating" if loop.ground.length < loop.crank.length else "swinging"
    return f"inverted slider-crank, {kind} {'cylinder' if loop.swapped else 'slotted bar'}"


def _turning(turn: Slope, root: SignedRoot, offset: float) -> Slope:
    """Return how a slotted bar turns: e, and what the sliding adds where the slot misses the pivot."""
    inverse = 1.0 / (root.q * root.q + offset * offset)
    slide = root.ratio.value * (0.5 * offset) * inverse
    growth = root.ratio.value * root.q * inverse
    return turn.plus(slide, root.ratio.rate * (0.5 * offset) * inverse - slide * growth)


def _loop_direction(ground: PinLoop, root: SignedRoot, bar: tuple[float, int], *, swapped: bool) -> Vec:
    """Return the slotted bar's direction; a slot through its own pivot turns at half the crank's angle.

    `bar` is the slot's offset and the closure's sign; `swapped` where the bar turns about the crank's pin.
    """
    offset, sign = bar
    way = -1.0 if swapped else 1.0
    if ground.short == 0 and offset == 0:
        return Vec(-ground.half.sine, ground.half.cosine).times(ground.direction).scaled(way * sign)
    return _direction(ground.across().scaled(-way), root.q, offset)


def _direction(across: Vec, s: Value, offset: float) -> Vec:
    """Return the unit vector u with across = s·u + offset·n."""
    if offset == 0:
        return Vec(across.x / s, across.y / s)
    turned = across.times(Vec(s, -offset))
    square = s * s + offset * offset
    return Vec(turned.x / square, turned.y / square)
