"""How each kind of joint closes, and the one list of them.

**Two bars that meet in a pin**, a (from P) and b (from Q), meet at B = P + D·(p + i q)/(2L²) with D = Q - P,
L = |D|, p = L² + a² - b² and the signed root q: no arc functions, no √L. The bars turn at

    ω_a = e - ρ (L² + b² - a²)/(2L²)     ω_b = e + ρ (L² + a² - b²)/(2L²)

with e = D × D'/L² and ρ = (L²)'/q, which stays finite through a limit where q and the input's rate
vanish together (differentiate the closure in the phase).

**A pin in the slot of a bar that slides on a line**, as in the Scotch yoke: with f and e how far the pin lies
forward along the line and to its left, and σ the slot's direction from the line's, the slot crosses the line
at s = f - e cot σ: linear, so the bar never jams and has one closure.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from linkanim.mechanics.closing.chain import Closing
from linkanim.mechanics.closing.walk import Assembly, Walk, guide
from linkanim.mechanics.formulas.circular import half_angle
from linkanim.mechanics.formulas.exact import Sum, exact_angle, quarter_turns, snapped, unit
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope, Vec, carried
from linkanim.mechanics.formulas.precise import direction
from linkanim.mechanics.linkage.dyads import RPP, RPR, RRP, RRR
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Pin
from linkanim.mechanics.linkage.rigid_bodies import Brace, Rigid
from linkanim.mechanics.loops.input_state import InputState, TravelState
from linkanim.mechanics.loops.loop import Gearing, Loop, aside_of, own_loop, pin_against_pin
from linkanim.mechanics.loops.roots import four_bar_root, slider_root, slot_root
from linkanim.mechanics.loops.signed import Reduced, SignedRoot
from linkanim.mechanics.loops.triangle import PinLoop, Triangle, moving_triangle, pin_triangle


def place_pin(pin: Pin, walk: Walk) -> None:
    """Put the pin where it stands."""
    walk.points[pin.name] = MovingPoint(walk.place_of(pin))


def place_crank(crank: Crank, walk: Walk) -> None:
    """Add r e^{iψ}, ψ = ratio × θ + offset, as r (cos² - sin²) and 2r sin cos of ψ/2.

    The difference is right to 2.3 eps of r, where r - 2r sin² is to 3.6: that is taken where a loop
    against a fixed pin needs 2r sin² anyway.
    """
    gearing = walk.assembly.gears[crank.name]
    loop = own_loop(crank.name, walk.assembly.loops)
    form = loop.form if loop else partial(half_angle, size=2.0 * crank.length)
    half = walk.state.half(-gearing.offset, gearing.ratio, form=form)
    squares = half.squares(2.0 * crank.length)
    spans = loop is not None and loop.ground is not None
    along = crank.length - squares.sine if spans else (squares.cosine - squares.sine) * 0.5
    arm = Vec(along, squares.product)
    pace = walk.pace(gearing)
    walk.points[crank.name] = walk.points[crank.pivot] + carried(arm, pace)
    walk.add_piece(pace, (crank.pivot, crank.name), arm)


def place_slider(slider: DrivenSlider, walk: Walk) -> None:
    """Put the slider where the input has it."""
    assert isinstance(walk.state, TravelState)
    walk.points[slider.name] = guide(slider.line, walk).place(walk.state.travel)
    walk.travels[slider.name] = walk.state.travel


def place_point(point: Rigid, walk: Walk) -> None:
    """Carry the point with its body."""
    walk.points[point.name] = walk.attached(point.on, point.at, point.name)


def loop_of_bars(joint: RRR, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin against a fixed pin."""
    found = pin_against_pin(linkage, gears, joint.ends)
    if found is None:
        return None
    crank, ground, swapped = found
    root = four_bar_root(ground.exact, crank.length, _turned(joint, swapped)[1], ground.angle)
    return Loop(crank.name, crank, gears[crank.name], ground, root, swapped)


def close_bars(joint: RRR, walk: Walk) -> None:
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
    walk.points[joint.name], *bars = _meet(p, q, lengths, triangle)
    ends = zip((first, second), bars, strict=True)
    for end, (turning, arm) in reversed([*ends]) if swapped else ends:
        walk.add_piece(turning, (end, joint.name), arm)


def _turned(joint: RRR, swapped: bool) -> tuple[tuple[str, str], tuple[float, float]]:
    """Return ends and lengths, in the other order where `swapped`."""
    return (joint.ends[::-1], joint.lengths[::-1]) if swapped else (joint.ends, joint.lengths)


_Bar = tuple[Slope, Vec]
"""How a bar turns, and it as a vector."""


def _meet(
    p: MovingPoint, q: MovingPoint, lengths: tuple[float, float], triangle: Triangle
) -> tuple[MovingPoint, _Bar, _Bar]:
    """Return where two bars meet, and both bars.

    The shorter bar carries the joint, since its direction is sharper; the longer one, which turns
    less, has its rate worked out, and the shorter one's is ρ away.
    """
    d, t, rho = triangle.across, triangle, triangle.ratio
    if lengths[0] < lengths[1]:
        arm_a = d.scaled(t.near) + t.lift
        arm_b = arm_a - d
        turning_b = t.turn_of_longer(True)
        turning_a = turning_b.plus(-rho.value, -rho.rate)
        return p + carried(arm_a, turning_a), (turning_a, arm_a), (turning_b, arm_b)
    arm_b = t.lift - d.scaled(t.far)
    arm_a = arm_b + d
    turning_a = t.turn_of_longer(False)
    turning_b = turning_a.plus(rho.value, rho.rate)
    return q + carried(arm_b, turning_b), (turning_a, arm_a), (turning_b, arm_b)


def loop_of_slider(joint: RRP, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
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


def close_slider(joint: RRP, walk: Walk) -> None:
    """Add the slider: its way along the line is that of the bar's end and the root q = ±√(b² - e²).

    With e how far the end lies left of the line and ρ = e'/q the bar turns at -ρ, seen from the line.
    """
    rail, point = guide(joint.line, walk), walk.points[joint.end]
    forward, aside = rail.forward(point), rail.aside(point)
    root = _slider_root(joint, walk, aside)
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


def _slider_root(joint: RRP, walk: Walk, aside: Moving) -> SignedRoot:
    loop, sign = walk.assembly.loops.get(joint.name), walk.assembly.signs[joint.name]
    if loop is not None:
        return walk.loop_root(loop, sign)[0]
    u, w = joint.length - aside.value, joint.length + aside.value
    return walk.chain_root(joint.name, Closing(u, w, aside, False, None, squared=False)).times(sign)


def slider_name(joint: RRP, assembly: Assembly) -> str:
    """Return slider-crank or slider-rocker, and whether the line runs past the pivot."""
    loop = assembly.loops.get(joint.name)
    if loop is None:
        return "slider linkage"
    eccentric = loop.root.u.least != loop.root.w.least
    turns = "slider-crank" if assembly.path.full_turn else "slider-rocker"
    return f"{'offset' if eccentric else 'in-line'} {turns}"


def loop_of_slot(joint: RPR, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
    """Return the loop of a crank pin and a fixed pin, one in the slot and one the pivot."""
    found = pin_against_pin(linkage, gears, (joint.through, joint.pivot))
    if found is None:
        return None
    crank, ground, swapped = found
    root = slot_root(ground.exact, crank.length, joint.offset, ground.angle)
    return Loop(crank.name, crank, gears[crank.name], ground, root, swapped)


def close_slot(joint: RPR, walk: Walk) -> None:
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


def slot_name(joint: RPR, assembly: Assembly) -> str:
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


def close_yoke(joint: RPP, walk: Walk) -> None:
    """Add where the slot crosses the line: s = f - e cot σ, and its derivatives alike."""
    rail, point = guide(joint.line, walk), walk.points[joint.pin]
    cosine, sine = direction(joint.slot)
    forward, aside, lean = rail.forward(point), rail.aside(point), cosine / sine
    travel = Moving(
        forward.value - aside.value * lean,
        forward.rate - aside.rate * lean,
        forward.second - aside.second * lean,
    )
    walk.points[joint.name] = rail.place(travel)
    walk.travels[joint.name] = travel


def yoke_name(joint: RPP, assembly: Assembly) -> str:
    """Return Scotch yoke, or that its slot is not square to its line."""
    return "Scotch yoke" if unit(joint.slot)[0] == 0 else "Scotch yoke, oblique slot"


@dataclass(frozen=True, slots=True)
class Closer:
    """What solves one kind of joint.

    `close` adds the joint's motion, and its bars', to a walk. `loop` returns the loop that it closes from a
    crank pin and fixed elements, if it does. `name` returns the class of a linkage whose only dyad it is.
    """

    close: Callable[[Any, Walk], None]
    loop: Callable[[Any, Linkage, Mapping[str, Gearing]], Loop | None] = lambda *_: None
    name: Callable[[Any, Assembly], str | None] = lambda *_: None


CLOSERS: Mapping[type[Joint], Closer] = {
    Pin: Closer(place_pin),
    Crank: Closer(place_crank),
    DrivenSlider: Closer(place_slider),
    Rigid: Closer(place_point),
    Brace: Closer(place_point),
    RRR: Closer(close_bars, loop_of_bars),
    RRP: Closer(close_slider, loop_of_slider, slider_name),
    RPR: Closer(close_slot, loop_of_slot, slot_name),
    RPP: Closer(close_yoke, name=yoke_name),
}
"""Every kind that a linkage can be made of."""


def walked(assembly: Assembly, state: InputState) -> Walk:
    """Return a walk over the whole linkage at the state's instant."""
    walk = Walk(assembly, state)
    for joint in assembly.linkage.joints:
        CLOSERS[type(joint)].close(joint, walk)
    return walk


def walk_at(assembly: Assembly, phase: Value, pace: Slope) -> Walk:
    """Return a walk at a phase that runs at `pace`: floats, or symbolic expressions."""
    return walked(assembly, assembly.path.state(phase, pace))
