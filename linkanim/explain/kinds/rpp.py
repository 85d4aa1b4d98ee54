"""A pin in the slot of a bar that slides on a line: the dyad of the Scotch yoke."""

from __future__ import annotations

from linkanim.explain.chains import LoopSide, Route, slide_sides
from linkanim.explain.expression import Components, Formula, Symbol, along, cos, sin
from linkanim.explain.kinds.rrp import beside_guide, on_guide
from linkanim.explain.rates import Order, Rates, SlideUnknown
from linkanim.explain.work import ANGLE, LENGTH, GuideLine, Work
from linkanim.mechanics.linkage.dyads import RPP


def place(joint: RPP, work: Work) -> None:
    """Add where the slot crosses the guide, and how far the pin is along the slot."""
    name = joint.name
    guide, slot = work.guide(joint.line, name), _slot(joint, work)
    work.say(
        f"How far {{{joint.pin}}} lies along the guide from {{{guide.through}}} (f) and to its left (n), and "
        "where the slot crosses it:"
    )
    forward, aside = beside_guide(work, guide, joint.pin, name)
    work.slides[name] = work.let(work.names.slide(name), forward - aside * (cos(slot) / sin(slot)), LENGTH)
    work.let_point(name, on_guide(work, guide, work.slides[name]))
    work.slides["t" + name] = work.let(Symbol("t", work.names.slide(name).sub), aside / sin(slot), LENGTH)


def _slot(joint: RPP, work: Work) -> Formula:
    """Return the slot's direction from the guide's."""
    return work.stated(Symbol("σ", joint.name), joint.slot, ANGLE, "direction of its slot from its guide")


def _along_slot(joint: RPP, work: Work, guide: GuideLine) -> Components:
    """Return the slot's direction."""
    slot = _slot(joint, work)
    if guide.angle.constant is not None and slot.constant is not None:
        return along(work.stated(Symbol("ψ", joint.name), joint.line.angle + joint.slot, ANGLE))
    return along(slot + guide.angle)


def move(joint: RPP, rates: Rates, order: Order) -> None:
    """Add the two equations for how bar and pin slide, and how the joint moves."""
    work, name = rates.work, joint.name
    guide = work.guide(joint.line, name)
    u, w = guide.direction, _along_slot(joint, work, guide)
    base = work.points[guide.through]
    slid = both = u
    if order == 2:
        slid = u.times(rates.sliding[name][0])
        both = slid + w.times(rates.sliding["t" + name][0])
    right = rates.of(joint.pin, order) - rates.guided(guide, work.points[joint.pin] - base, both, order)
    rates.solve(name, (SlideUnknown(name, u), SlideUnknown(name, w, "t")), right, order)
    carried = rates.guided(guide, work.points[name] - base, slid, order)
    rates.let_moving(name, carried + u.times(rates.sliding[name][order - 1]), order)


def route(joint: RPP, work: Work) -> Route:
    """Return the way along the guide."""
    guide = work.guide(joint.line, joint.name)
    return Route(guide.through, slide_sides(work, guide, joint.name))


def loop(joint: RPP, work: Work) -> tuple[Route, Route]:
    """Return both ways to the pin."""
    w = _along_slot(joint, work, work.guide(joint.line, joint.name))
    index = work.names.slide(joint.name).sub
    last = LoopSide(Symbol("T", index, bold=True), w.times(work.slides["t" + joint.name]))
    start, sides = route(joint, work)
    return Route(joint.pin, ()), Route(start, (*sides, last))
