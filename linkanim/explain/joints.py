"""Work out every kind of joint by hand, and write down the vector loops.

Its parts, in reading order:

- How each kind of joint is worked out by hand, and the one list of them.
- The vector loops of a linkage: the two routes to each dyad's joint, as equations and as arrows.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Callable, Mapping
from itertools import takewhile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.explain.formula import (
    NOWHERE,
    TWO,
    ZERO,
    Components,
    Formula,
    Symbol,
    along,
    arccos,
    atan2,
    cos,
    number,
    sin,
    sqrt,
    square,
)
from linkanim.explain.steps import (
    ANGLE,
    LENGTH,
    SQUARE,
    Chapter,
    Coordinate,
    Equation,
    GuideLine,
    LoopSide,
    Order,
    Powers,
    Rates,
    Step,
    Unknown,
    ValueLine,
    Work,
    joint_title,
    marked,
)
from linkanim.frozen import frozen
from linkanim.mechanics.groups import GroupPoint, GroupSlider
from linkanim.mechanics.linkage import RPP, RPR, RRP, RRR, Brace, Crank, DrivenSlider, Gear, Joint, Pin, Rigid
from linkanim.units import rounded as in_digits
from linkanim.units import significant
from linkanim.words import name_said, row_said, said, to_say

# How each kind of joint is worked out by hand, and the one list of them.

Places = NDArray[np.complex128]
Lengths = NDArray[np.float64]
Route = tuple[str, tuple[LoopSide, ...]]
"""A way to a joint: the joint at which it begins, and the vectors along it."""
Reach = tuple[Callable[[Mapping[str, Places]], Lengths], float, float]
"""The bounds within which a dyad closes: as a function of joints' places x + yi (n,), low and high."""


def place_pin(pin: Pin, work: Work) -> None:
    """Add the pin's place: as stated, or worked out from its length and angle."""
    origin = next((name for name, at in work.points.items() if at == NOWHERE), None)
    named = frozenset((origin, pin.name)) in work.names.lengths
    if pin.polar is not None and pin.polar.length:
        base, (length, angle) = pin.polar.base, (pin.polar.length, pin.polar.angle)
    elif named and pin.position[0] > 0 == pin.position[1]:
        # level with the origin: its one coordinate other than 0 is a length of the figure
        base, length, angle = None, pin.position[0], 0.0
    else:
        places = zip("xy", pin.position, strict=True)
        x, y = (work.stated(Symbol(letter, pin.name), value, LENGTH) for letter, value in places)
        work.points[pin.name] = Components(x, y)
        return
    index = work.names.length(start, pin.name) if (start := base or origin) else pin.name
    arm = along(work.stated(Symbol("θ", index), angle, ANGLE)).times(
        work.stated(Symbol("r", index), length, LENGTH)
    )
    work.let_point(pin.name, (work.points[base] if base else NOWHERE) + arm)


def place_crank(crank: Crank, work: Work) -> None:
    """Add where a crank's pin lies, and before it the angle if the crank is geared."""
    ends = crank.pivot, crank.name
    if crank.gear is not None:
        mate = work.linkage.crank(crank.gear.mate)
        offset = work.stated(
            Symbol("δ", crank.name),
            crank.gear.offset,
            ANGLE,
            said("angle of its crank when the driving gear is at 0°"),
        )
        driven = _ratio(crank.gear) * work.angle_of(mate.pivot, mate.name) + offset
        work.angles[ends] = work.let(work.angle_symbol(*ends), driven, ANGLE)
    work.let_point(crank.name, work.points[crank.pivot] + work.bar(*ends, crank.length))


def move_crank(crank: Crank, rates: Rates, order: Order) -> None:
    """Add how a crank's pin moves, and before it how the crank turns if it is geared."""
    ends, work = (crank.pivot, crank.name), rates.work
    if crank.gear is not None:
        mate = work.linkage.crank(crank.gear.mate)
        driver = rates.turning(work.frame((mate.pivot, mate.name)), order)
        rates.let_rate(("θ", work.frame(ends)), _ratio(crank.gear) * driver, order)
    rates.let_carried(crank.name, ends, work.bar(*ends, crank.length), order)


def _ratio(gear: Gear) -> Formula:
    top, bottom = (number(str(part)) for part in gear.ratio.as_integer_ratio())
    return top / bottom


def place_slider(slider: DrivenSlider, work: Work) -> None:
    """Add where the driven slider lies."""
    guide = work.guide(slider.line, slider.name)
    work.let_point(slider.name, guide.point(work, work.slides[slider.name]))


def move_slider(slider: DrivenSlider, rates: Rates, order: Order) -> None:
    """Add how the driven slider moves."""
    guide = rates.work.guide(slider.line, slider.name)
    rates.let_moving(slider.name, guide.direction.times(rates.rate(("s", slider.name), order)), order)


def route_of_bar(joint: Joint, work: Work, which: int = 0) -> Route:
    """Return the route to a joint along one of its bars."""
    start, length = joint.bars[which]
    symbol = Symbol("R", work.names.length(start, joint.name), bold=True)
    return start, ((symbol, work.bar(start, joint.name, length)),)


def route_of_guide(joint: DrivenSlider | RRP | RPP, work: Work) -> Route:
    """Return the route along a joint's guide."""
    guide = work.guide(joint.line, joint.name)
    return guide.through, guide.sides(work, joint.name)


def place_point(point: Rigid, work: Work) -> None:
    """Add where a point of a body lies: along the line of two of its joints, and to the left."""
    work.let_point(
        point.name, work.points[point.on[0]] + body_point(work, point.on, point.at, legs(point, work))
    )


def legs(point: Rigid, work: Work) -> tuple[Symbol, Symbol]:
    """Return the symbols of a point's coordinates: along its body's line, and to the left of it."""
    known = iter(work.names.legs.get(point.name, ()))
    named = [Symbol("r", next(known, "")) if value else Symbol("") for value in point.at]
    if point.at[1] == 0 and not named[0].sub:
        return Symbol("r", work.names.length(point.on[0], point.name)), Symbol("")
    usual = Symbol("p", point.name), Symbol("q", point.name)
    return tuple(own if own.sub else other for own, other in zip(named, usual, strict=True))  # type: ignore[return-value]


def body_point(
    work: Work, on: tuple[str, str], at: tuple[float, float], names: tuple[Symbol, Symbol]
) -> Components:
    """Return the vector from a body's first joint to a point of the body."""
    ahead = along(work.angle_of(*on))
    first, second = map(marked, on)
    p = work.sided(
        names[0],
        at[0],
        said("along {first}–{second}", first=first, second=second),
        said("from {first}, away from {second}", first=first, second=second),
    )
    q = work.sided(
        names[1],
        at[1],
        said("to the left of {first}–{second}", first=first, second=second),
        said("to the right of {first}–{second}", first=first, second=second),
    )
    return ahead.times(p) + ahead.left().times(q)


def move_point(point: Rigid, rates: Rates, order: Order) -> None:
    """Add how a point of a body moves."""
    points = rates.work.points
    rates.let_carried(point.name, point.on, points[point.name] - points[point.on[0]], order)


def route_of_point(point: Rigid, work: Work) -> Route:
    """Return the route to a point of a body from the body's first joint."""
    base, points = point.on[0], work.points
    name, other = legs(point, work)
    index = name.sub if not other.letter and name.letter == "r" else base + point.name
    return base, ((Symbol("R", index, bold=True), points[point.name] - points[base]),)


def rest(pin: Pin, rates: Rates, order: Order) -> None:
    """Leave the pin where it is."""
    rates.moving.setdefault(pin.name, []).append(NOWHERE)


def place_bars(joint: RRR, work: Work) -> None:
    """Add the cosine rule, with the bars' angles and where they meet."""
    (p, q), name = joint.ends, joint.name
    span = work.points[q] - work.points[p]
    work.say(
        said(
            "The distance d from {p} to {q} and its direction δ; then the cosine rule in the "
            "triangle of the two bars:",
            p=marked(p),
            q=marked(q),
        )
    )
    d = work.let(Symbol("d", name), sqrt(square(span.x) + square(span.y)), LENGTH)
    symbol = work.angle_symbol(p, name)
    if d.value == 0:
        work.say(
            said("Both ends coincide, so every direction closes the loop; the motion continues in this one:")
        )
        at = complex(*work.pose.position[name]) - complex(*work.pose.position[p])
        work.angles[p, name] = work.known(
            symbol, phase(at), ANGLE, said("as the motion passes {p} = {q}", p=marked(p), q=marked(q))
        )
    else:
        work.angles[p, name] = work.let(symbol, _direction_of_bar(joint, work, span, d), ANGLE)
    work.let_point(name, work.points[p] + work.bar(p, name, joint.lengths[0]))
    work.angle_of(q, name)


def _direction_of_bar(joint: RRR, work: Work, span: Components, d: Formula) -> Formula:
    """Return the first bar's angle by the cosine rule, for the side on which the joint lies."""
    a, b = (work.length(end, joint.name, length) for end, length in joint.bars)
    ahead = work.let(Symbol("δ", joint.name), atan2(span.y, span.x), ANGLE)
    corner = _corner((square(a) + square(d) - square(b)) / (TWO * a * d), work, joint.name)
    is_left = _left(joint, work)
    work.say(_why_left(joint, is_left))
    return ahead + corner if is_left else ahead - corner


def _corner(cosine: Formula, work: Work, name: str) -> Formula:
    """Add the triangle's angle; at a limit, where rounding takes its cosine past 1, it is 0 or 180°."""
    if abs(cosine.value) <= 1:
        return work.let(Symbol("γ", name), arccos(cosine), ANGLE)
    work.say(said("In the digits shown the two bars lie in one line: rounding takes the cosine of γ past 1."))
    return number("0" if cosine.value > 0 else "180", in_degrees=True)


def _left(joint: RRR, work: Work) -> bool:
    """Return whether the joint lies left of the line from its first bar's end to its second's."""
    p, q, at = (complex(*work.pose.position[name]) for name in (*joint.ends, joint.name))
    return ((q - p).conjugate() * (at - p)).imag >= 0


def _why_left(joint: RRR, left: bool) -> str:
    p, q = joint.ends
    words = said(_WHY_LEFT[left], joint=marked(joint.name), p=marked(p), q=marked(q))
    usual = joint.side_of is not None or left == (joint.side > 0)
    return said("{found}.", found=words) if usual else said(_PASSED, found=words)


_WHY_LEFT = {
    True: to_say("In this position {joint} lies to the left of the line from {p} to {q}, so γ is added"),
    False: to_say(
        "In this position {joint} lies to the right of the line from {p} to {q}, so γ is subtracted"
    ),
}
_PASSED = to_say("{found}: the motion has come to this closure through a limit or a change point.")


def half_angle(joint: RRR, work: Work) -> None:
    """Add the second bar's angle by the half-angle form; nothing where that form loses its digits.

    The first bar's angle is eliminated from the loop, A cos θ + B sin θ = C remains, and t = tan(θ/2) makes
    it a quadratic: Freudenstein's equation, as most books and the source reports solve it.
    """
    (p, q), name = joint.ends, joint.name
    a, b = (work.length(end, name, length) for end, length in joint.bars)
    span, angle = work.points[q] - work.points[p], work.angles[q, name]
    before = len(work.items)
    work.say(
        said(
            "Eliminating the angle of {p}–{name} from the loop leaves A cos θ + B sin θ = C for "
            "the angle θ of {q}–{name}, a quadratic equation in tan(θ/2):",
            p=marked(p),
            name=marked(name),
            q=marked(q),
        )
    )
    cosine = work.let(Symbol("A", name), TWO * b * span.x, SQUARE)
    sine = work.let(Symbol("B", name), TWO * b * span.y, SQUARE)
    right = work.let(Symbol("C", name), square(a) - square(b) - square(span.x) - square(span.y), SQUARE)
    under = square(cosine) + square(sine) - square(right)
    size = math.hypot(cosine.value, sine.value)
    root = work.let(Symbol("W", name), sqrt(under), SQUARE) if under.value > 0 else ZERO
    above, below = (sine + root if _left(joint, work) else sine - root), cosine + right
    if math.hypot(above.value, below.value) < _HALF_ANGLE_LEFT * size:
        # both vanish at 180°, and rounding errors have no direction
        del work.items[before:]
        return
    half = work.let(Symbol("θ", "half"), TWO * atan2(above, below), ANGLE)
    miss, places = abs(math.remainder(half.value - angle.value, 360)), work.scale.decimals(ANGLE)
    turns = "" if abs(half.value - angle.value) < _HALF_TURN else said(", apart from a full turn")
    apart = "" if miss < 3 * 10.0**-places else said(", to within {miss}°", miss=in_digits(miss, 1))
    work.say(
        said("The root is taken with a plus on this closure.")
        if _left(joint, work)
        else said("The root is taken with a minus on this closure.")
    )
    work.say(
        said(
            "The result is the angle of {q}–{name} found above{turns}{apart}.",
            q=marked(q),
            name=marked(name),
            turns=turns,
            apart=apart,
        )
    )


_HALF_TURN = 180.0
_HALF_ANGLE_LEFT = 1e-3
"""A share of A and B: where the parts of the fraction tan(θ/2) are smaller, the digits are lost."""


def move_bars(joint: RRR, rates: Rates, order: Order) -> None:
    """Add the two equations for how the bars turn, and how their pin moves."""
    work, (p, q), name = rates.work, joint.ends, joint.name
    (_, a), (_, b) = joint.bars
    one, other = work.bar(p, name, a), work.bar(q, name, b)
    frames = work.frame((p, name)), work.frame((q, name))
    right = rates.of(q, order) - rates.of(p, order)
    if order == 2:
        right = right + rates.centripetal(frames[0], one) - rates.centripetal(frames[1], other)
    rates.solve(name, {("θ", frames[0]): one.left(), ("θ", frames[1]): -other.left()}, right, order)
    rates.let_carried(name, (p, name), one, order)


def loop_of_bars(joint: RRR, work: Work) -> tuple[Route, Route]:
    """Return both routes to the pin."""
    return route_of_bar(joint, work), route_of_bar(joint, work, 1)


def place_slider_on_bar(joint: RRP, work: Work) -> None:
    """Add the right-angled triangle of bar and guide, and where the slider is."""
    name, end = joint.name, joint.end
    guide = work.guide(joint.line, name)
    work.say(
        said(
            "How far {end} lies along the guide from {through} (p) and to the left of the guide "
            "(n); then the slider's travel s:",
            end=marked(end),
            through=marked(guide.through),
        )
    )
    forward, aside = guide.let_beside(work, end, name)
    margin = square(work.length(end, name, joint.length)) - square(aside)
    if margin.value < 0:
        work.say(
            said(
                "In the digits shown the bar is perpendicular to the guide, and the value under the "
                "root is 0."
            )
        )
    root = sqrt(margin) if margin.value >= 0 else ZERO
    ahead = _slider_ahead(joint, work)
    work.say(_why_ahead(joint, ahead))
    slide = work.let(work.names.slide(name), forward + root if ahead else forward - root, LENGTH)
    work.slides[name] = slide
    work.let_point(name, guide.point(work, slide))
    work.angle_of(end, name)


def _slider_ahead(joint: RRP, work: Work) -> bool:
    """Return whether the slider is ahead of the bar's end along the guide at this pose."""
    end, at = (complex(*work.pose.position[name]) for name in (joint.end, joint.name))
    u = work.guide(joint.line, joint.name).direction
    return ((at - end) * complex(u.x.value, -u.y.value)).real >= 0


def _why_ahead(joint: RRP, ahead: bool) -> str:
    found = said(_WHY_AHEAD[ahead], joint=marked(joint.name), end=marked(joint.end))
    return said("{found}.", found=found) if ahead == (joint.side > 0) else said(_PASSED, found=found)


_WHY_AHEAD = {
    True: to_say("In this position {joint} is ahead of {end} along the guide, so the root is added"),
    False: to_say("In this position {joint} is behind {end} along the guide, so the root is subtracted"),
}


def move_slider_on_bar(joint: RRP, rates: Rates, order: Order) -> None:
    """Add the two equations for how the slider slides and the bar turns, and how the joint moves."""
    work, name, end = rates.work, joint.name, joint.end
    guide, frame = work.guide(joint.line, name), work.frame((end, name))
    bar = work.bar(end, name, joint.length)
    sliding: dict[Coordinate, Components] = {("s", name): guide.direction}
    right = rates.of(end, order) - rates.guided(guide, name, order, sliding)
    if order == 2:
        right = right - rates.centripetal(frame, bar)
    rates.solve(name, {**sliding, ("θ", frame): -bar.left()}, right, order)
    if joint.line.on is None:
        rates.let_moving(name, guide.direction.times(rates.rate(("s", name), order)), order)
    else:
        rates.let_carried(name, (end, name), bar, order)


def loop_of_slider_on_bar(joint: RRP, work: Work) -> tuple[Route, Route]:
    """Return both routes to the slider."""
    return route_of_bar(joint, work), route_of_guide(joint, work)


def place_slot(joint: RPR, work: Work) -> None:
    """Add the pin's distance along the slot, the slotted bar's angle and where its end is."""
    name, pivot, pin = joint.name, joint.pivot, joint.through
    arm = work.points[pin] - work.points[pivot]
    offset = _slot_offset(joint, work)
    work.say(
        said(
            "The slotted bar turns about {pivot}; the pin {pin} is in its slot, s along it from {pivot}:",
            pivot=marked(pivot),
            pin=marked(pin),
        )
    )
    root = sqrt(square(arm.x) + square(arm.y) - square(offset))
    slide = work.let(work.names.slide(name), root if _pin_ahead(joint, work) else -root, LENGTH)
    work.slides[name] = slide
    turned = atan2(slide * arm.y - offset * arm.x, slide * arm.x + offset * arm.y)
    work.angles[pivot, name] = work.let(work.angle_symbol(pivot, name), turned, ANGLE)
    work.let_point(name, work.points[pivot] + work.bar(pivot, name, joint.length))


def _slot_offset(joint: RPR, work: Work) -> Formula:
    sides = said("the slot's offset to the left"), said("the slot's offset to the right")
    return work.sided(Symbol("e", joint.name), joint.offset, *sides)


def _pin_ahead(joint: RPR, work: Work) -> bool:
    """Return whether the pin is ahead of the pivot along the bar at this pose."""
    pivot, pin, at = (complex(*work.pose.position[name]) for name in (joint.pivot, joint.through, joint.name))
    return ((pin - pivot) * (at - pivot).conjugate()).real >= 0


def move_slot(joint: RPR, rates: Rates, order: Order) -> None:
    """Add the two equations for how the bar turns and the pin slides, and how the bar's end moves."""
    work, name, pivot = rates.work, joint.name, joint.pivot
    frame, u = work.frame((pivot, name)), along(work.angle_of(pivot, name))
    arm = work.points[joint.through] - work.points[pivot]
    right = rates.of(joint.through, order) - rates.of(pivot, order)
    if order == 2:
        across = u.left().times(TWO * rates.turning(frame, 1) * rates.rate(("s", name), 1))
        right = right + rates.centripetal(frame, arm) - across
    rates.solve(name, {("θ", frame): arm.left(), ("s", name): u}, right, order)
    rates.let_carried(name, (pivot, name), work.bar(pivot, name, joint.length), order)


def loop_of_slot(joint: RPR, work: Work) -> tuple[Route, Route]:
    """Return both routes to the pin in the slot."""
    pivot, name, angle = joint.pivot, joint.name, work.angle_of(joint.pivot, joint.name)
    offset = _slot_offset(joint, work)
    slot = GuideLine(pivot, offset, work.frame((pivot, name)), angle)
    return (joint.through, ()), (pivot, slot.sides(work, name))


def place_yoke(joint: RPP, work: Work) -> None:
    """Add where the slot crosses the guide, and how far the pin is along the slot."""
    name = joint.name
    guide, slot = work.guide(joint.line, name), _slot(joint, work)
    work.say(
        said(
            "How far {pin} lies along the guide from {through} (p) and to the left of the guide "
            "(n); then the travel s at which the slot crosses the guide:",
            pin=marked(joint.pin),
            through=marked(guide.through),
        )
    )
    forward, aside = guide.let_beside(work, joint.pin, name)
    work.slides[name] = work.let(work.names.slide(name), forward - aside * (cos(slot) / sin(slot)), LENGTH)
    work.let_point(name, guide.point(work, work.slides[name]))
    work.slides["t" + name] = work.let(Symbol("t", work.names.slide(name).sub), aside / sin(slot), LENGTH)


def _slot(joint: RPP, work: Work) -> Formula:
    """Return the slot's direction from the guide's."""
    return work.stated(
        Symbol("σ", joint.name), joint.slot, ANGLE, said("direction of its slot from its guide")
    )


def _along_slot(joint: RPP, work: Work, guide: GuideLine) -> Components:
    """Return the slot's direction."""
    slot = _slot(joint, work)
    if guide.angle.constant is not None and slot.constant is not None:
        return along(work.stated(Symbol("ψ", joint.name), joint.line.angle + joint.slot, ANGLE))
    return along(slot + guide.angle)


def move_yoke(joint: RPP, rates: Rates, order: Order) -> None:
    """Add the two equations for how bar and pin slide, and how the joint moves."""
    work, name = rates.work, joint.name
    guide = work.guide(joint.line, name)
    slid: Coordinate = ("s", name)
    unknowns: dict[Coordinate, Components] = {
        slid: guide.direction,
        ("t", name): _along_slot(joint, work, guide),
    }
    right = rates.of(joint.pin, order) - rates.guided(guide, joint.pin, order, unknowns)
    if rates.slopes is None and order == 1:
        work.say(
            said(
                "f belongs to the travel along the guide, g to the travel of {pin} along the slot:",
                pin=marked(joint.pin),
            )
        )
    rates.solve(name, unknowns, right, order)
    carried = rates.guided(guide, name, order, {slid: guide.direction})
    rates.let_moving(name, carried + guide.direction.times(rates.rate(slid, order)), order)


def loop_of_yoke(joint: RPP, work: Work) -> tuple[Route, Route]:
    """Return both routes to the pin."""
    w = _along_slot(joint, work, work.guide(joint.line, joint.name))
    index = work.names.slide(joint.name).sub
    last = Symbol("T", index, bold=True), w.times(work.slides["t" + joint.name])
    start, sides = route_of_guide(joint, work)
    return (joint.pin, ()), (start, (*sides, last))


def reach_of_bars(joint: RRR, work: Work) -> Reach:
    """Add the least and the greatest distance between the ends of two bars; return these bounds."""
    p, q = joint.ends
    bars = (work.length(end, joint.name, length) for end, length in joint.bars)
    short, long = sorted(bars, key=lambda bar: bar.value)
    work.say(
        said(
            "The bars that meet at {joint} can be assembled as long as the distance from {p} to "
            "{q} lies between the difference and the sum of their lengths:",
            joint=marked(joint.name),
            p=marked(p),
            q=marked(q),
        )
    )
    low = work.let(Symbol("d", "min"), long - short if long.value > short.value else ZERO, LENGTH)
    high = work.let(Symbol("d", "max"), long + short, LENGTH)
    return lambda at: np.abs(at[p] - at[q]), low.value, high.value


def reach_of_slider(joint: RRP, work: Work) -> Reach:
    """Say how far a bar's end may be from its guide; return this bound."""
    line, turned = joint.line, rect(1.0, joint.line.angle)

    def aside(at: Mapping[str, Places]) -> Lengths:
        seen = (at[joint.name] - at[joint.end]) / turned
        if line.on is not None:
            carried = at[line.on[1]] - at[line.on[0]]
            seen = seen * abs(carried) / carried
        return np.abs(seen.imag)

    length = work.length(joint.end, joint.name, joint.length)
    work.say(
        said(
            "The bar from {end} reaches the guide of {joint} as long as {end} is no farther from "
            "the guide than the bar's length, {length} {unit}.",
            end=marked(joint.end),
            joint=marked(joint.name),
            length=length.shown,
            unit=work.scale.unit,
        )
    )
    return aside, -math.inf, joint.length


def reach_of_slot(joint: RPR, work: Work) -> Reach | None:
    """Say how near the pin may come to an offset slot's pivot, and return it; None without an offset."""
    if not joint.offset:
        return None
    offset = abs(joint.offset)
    work.say(
        said(
            "The slotted bar can hold the pin {through} as long as that is no nearer to {pivot} "
            "than the slot's offset, {offset} {unit}.",
            through=marked(joint.through),
            pivot=marked(joint.pivot),
            offset=significant(offset, 6),
            unit=work.scale.unit,
        )
    )
    return lambda at: np.abs(at[joint.through] - at[joint.pivot]), offset, math.inf


def place_group(point: GroupPoint, work: Work) -> None:
    """Add where a group's joint lies, which no dyad gives: as it is solved."""
    links = [name_said(member.name) for member in point.group.free]
    work.say_once(
        said(
            "The links {links} can only be solved together: no dyad gives one of "
            "their joints without the others. What follows of them is linkanim's own solution, "
            "not derived here.",
            links=row_said(links),
        )
    )
    x, y = (
        work.solved(Symbol(letter, point.name), float(value), LENGTH)
        for letter, value in zip("xy", work.pose.position[point.name], strict=True)
    )
    work.points[point.name] = Components(x, y)


def move_group(point: GroupPoint, rates: Rates, order: Order) -> None:
    """Add how a group's joint moves: coefficients as they are solved, rates by the chain rule."""
    if rates.slopes is not None:
        rates.let_moving(point.name, NOWHERE, order)
    else:
        pose = rates.work.pose.per_input
        vector, measure = (pose.velocity, pose.acceleration)[order - 1][point.name], Powers(1, order)
        x, y = (
            rates.work.solved(symbol, float(value), measure, rates.scale)
            for symbol, value in zip(rates.moving_symbols(point.name, order), vector, strict=True)
        )
        rates.moving.setdefault(point.name, []).append(Components(x, y))
    if point.name == point.group.points[-1]:
        for member in point.group.free:
            if len(member.points) > 1:
                rates.let_solved(rates.work.frame((member.points[0], member.points[1])), order)


@frozen
class KindSteps:
    """The steps of one kind of joint.

    `place` adds the lines of its position, `move` those of its rates of one order. `route` leads to it from
    an earlier joint. Of a dyad, `loop` is the two routes that meet, `reach` the bounds within which it
    closes.
    """

    place: Callable[[Any, Work], None]
    move: Callable[[Any, Rates, Order], None]
    route: Callable[[Any, Work], Route] | None = None
    loop: Callable[[Any, Work], tuple[Route, Route]] | None = None
    reach: Callable[[Any, Work], Reach | None] | None = None


KINDS: Mapping[type[Joint], KindSteps] = {
    Pin: KindSteps(place_pin, rest),
    Crank: KindSteps(place_crank, move_crank, route_of_bar),
    DrivenSlider: KindSteps(place_slider, move_slider, route_of_guide),
    Rigid: KindSteps(place_point, move_point, route_of_point),
    Brace: KindSteps(place_point, move_point, route_of_point),
    RRR: KindSteps(place_bars, move_bars, route_of_bar, loop_of_bars, reach_of_bars),
    RRP: KindSteps(
        place_slider_on_bar, move_slider_on_bar, route_of_bar, loop_of_slider_on_bar, reach_of_slider
    ),
    RPR: KindSteps(place_slot, move_slot, route_of_bar, loop_of_slot, reach_of_slot),
    RPP: KindSteps(place_yoke, move_yoke, route_of_guide, loop_of_yoke),
    GroupPoint: KindSteps(place_group, move_group),
    GroupSlider: KindSteps(place_group, move_group),
}
"""The steps of every kind of joint."""


# The vector loops of a linkage: the two routes to each dyad's joint, as equations and as arrows.

CYLINDER = Symbol("ℓ")
"""The length of the driving cylinder."""


Arrows = dict[Symbol, tuple[complex, complex]]
"""The vectors of loops, by their symbols: where each begins and ends, x + yi in the scene's unit."""


def loops_of(work: Work, places: Chapter) -> tuple[list[Step], Arrows]:
    """Return a step for each dyad's loop in solving order, a driving cylinder's first, and all their vectors.

    `places` are the positions of the joints.
    """
    symbols = {
        step.title: {item.value.symbol for item in step.items if isinstance(item, ValueLine)}
        for step in places.steps
    }
    steps: list[Step] = []
    arrows: Arrows = {}
    lines = [item for step in places.steps for item in step.items if isinstance(item, ValueLine)]
    length = next((line.value for line in lines if line.value.symbol == CYLINDER), None)
    if length is not None:
        steps.append(_cylinder(length, work, arrows))
    ways = _WaysFromGround(work)
    for joint in work.linkage.joints:
        if (close := KINDS[type(joint)].loop) is not None:
            both = [ways.along(route) for route in close(joint, work)]
            steps.append(_loop(joint, both, symbols.get(joint_title(joint.name), set()), work, arrows))
    return steps, arrows


def _cylinder(length: Formula, work: Work, arrows: Arrows) -> Step:
    """Return the loop of a cylinder that drives the crank: crank's pivot, cylinder's foot and head."""
    between, crank = work.linkage.drive.actuator.along, work.linkage.driven
    assert between is not None
    (pivot, foot, head), turned = (crank.pivot, *between), work.angles[crank.pivot, crank.joint.name]
    ends = [work.place(name) for name in (pivot, foot, head)]
    tilt = Formula("leaf", symbol=Symbol("θ", CYLINDER.letter), shown="0")
    names = [Symbol(letter, index, bold=True) for letter, index in (("R", "g"), ("L", ""), ("R", "c"))]
    base, arm, axis = (
        work.points[foot] - work.points[pivot],
        work.points[head] - work.points[pivot],
        along(tilt),
    )
    bold = [Formula("leaf", symbol=name, shown="0") for name in names]
    equations = (
        Equation(bold[0] + bold[1], bold[2]),
        Equation(base.x + length * axis.x, arm.x),
        Equation(base.y + length * axis.y, arm.y),
    )
    for name, begin, end in zip(names, (0, 1, 0), (1, 2, 2), strict=True):
        arrows[name] = ends[begin], ends[end]
    return Step(said("Loop of the cylinder"), (*equations, Unknown((turned, tilt), said("Unknown"))))


def _loop(joint: Joint, ways: list[_Way], symbols: set[Symbol | None], work: Work, arrows: Arrows) -> Step:
    """Return the loop of two ways to a joint, without what they share, and add its vectors."""
    (root, one), (other_root, other) = ways
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))
    chains = [one[same:], other[same:]]
    if root != other_root:
        chains[1].insert(0, (*_ground(work, root, other_root), work.place(root)))
    arrows |= {name: (at, at + vector.value) for chain in chains for name, vector, at in chain}
    bold = [
        sum((Formula("leaf", symbol=symbol, shown="0") for symbol, _, _ in chain), ZERO) for chain in chains
    ]
    parts = [[sum((vector[n] for _, vector, _ in chain), ZERO) for chain in chains] for n in (0, 1)]
    known = {leaf.symbol: leaf for pair in parts for side in pair for leaf in side.leaves}
    unknown = tuple(leaf for symbol, leaf in known.items() if symbol in symbols)
    return Step(
        said("Loop of {joint}", joint=marked(joint.name)),
        (*(Equation(*pair) for pair in (bold, *parts)), Unknown(unknown, said("Unknown"))),
    )


def _ground(work: Work, start: str, end: str) -> LoopSide:
    """Return the vector between two fixed pins, by length and angle where the scene states these."""
    index, vector = work.names.length(start, end), work.points[end] - work.points[start]
    length, angle = (work.given.get(Symbol(letter, index)) for letter in "rθ")
    if length and angle:
        vector = along(angle.value).times(length.value)
    elif length and vector.y.constant == 0:
        vector = Components(length.value if vector.x.value > 0 else -length.value, ZERO)
    return Symbol("R", index, bold=True), vector


_Way = tuple[str, list[tuple[Symbol, Components, complex]]]
"""A whole way to a joint: the fixed pin at which it begins, and its vectors with the places where they do."""


class _WaysFromGround:
    """The whole ways to joints from a fixed pin, each worked out once."""

    def __init__(self, work: Work) -> None:
        self._work = work
        self._known: dict[str, _Way] = {}

    def along(self, route: Route) -> _Way:
        """Return the whole way, from a fixed pin, to where a route leads."""
        start, sides = route
        if start not in self._known:
            joint = self._work.linkage.joint(start)
            further = KINDS[type(joint)].route
            self._known[start] = self.along(further(joint, self._work)) if further else (start, [])
        root, before = self._known[start]
        way, at = [*before], self._work.place(start)
        for symbol, vector in sides:
            way.append((symbol, vector, at))
            at += vector.value
        return root, way
