"""A bar that turns on one joint, its slot passing through another."""

from __future__ import annotations

from linkanim.explain.chains import LoopSide, Route, bar_side
from linkanim.explain.expression import TWO, Components, Symbol, along, atan2, sqrt, square
from linkanim.explain.rates import Order, Rates, SlideUnknown, TurnUnknown
from linkanim.explain.work import ANGLE, LENGTH, Work
from linkanim.mechanics.linkage.dyads import RPR


def place(joint: RPR, work: Work) -> None:
    """Add the way along the slot, the slotted bar's angle and where its end is."""
    name, pivot, pin = joint.name, joint.pivot, joint.through
    way = work.points[pin] - work.points[pivot]
    offset = work.stated(Symbol("e", name), joint.offset, LENGTH, "the slot's offset to the left")
    work.say(f"The slotted bar turns about {{{pivot}}} and its slot passes through {{{pin}}}, s ahead of it:")
    root = sqrt(square(way.x) + square(way.y) - square(offset))
    slide = work.let(work.names.slide(name), root if _ahead(joint, work) else -root, LENGTH)
    work.slides[name] = slide
    turned = atan2(slide * way.y - offset * way.x, slide * way.x + offset * way.y)
    work.angles[pivot, name] = work.let(work.angle_symbol(pivot, name), turned, ANGLE)
    work.let_point(name, work.points[pivot] + work.bar(pivot, name, joint.length))


def _ahead(joint: RPR, work: Work) -> bool:
    """Tell whether the pin is ahead of the pivot along the bar at this pose."""
    pivot, pin, at = (complex(*work.pose.position[name]) for name in (joint.pivot, joint.through, joint.name))
    return ((pin - pivot) * (at - pivot).conjugate()).real >= 0


def move(joint: RPR, rates: Rates, order: Order) -> None:
    """Add the two equations for how the bar turns and the pin slides, and how the bar's end moves."""
    work, name, pivot = rates.work, joint.name, joint.pivot
    frame, u = work.frame((pivot, name)), along(work.angle_of(pivot, name))
    arm = work.points[joint.through] - work.points[pivot]
    right = rates.of(joint.through, order) - rates.of(pivot, order)
    if order == 2:
        across = u.left().times(TWO * rates.turn(frame, 1) * rates.sliding[name][0])
        right = right + rates.centripetal(frame, arm) - across
    rates.solve(name, (TurnUnknown(frame, arm.left()), SlideUnknown(name, u)), right, order)
    bar = work.bar(pivot, name, joint.length)
    rates.let_moving(name, rates.of(pivot, order) + rates.carried(frame, bar, order), order)


def route(joint: RPR, work: Work) -> Route:
    """Return the way to the bar's end."""
    return Route(joint.pivot, (bar_side(work, joint.pivot, joint.name, joint.length),))


def loop(joint: RPR, work: Work) -> tuple[Route, Route]:
    """Return both ways to the pin in the slot."""
    u, index = along(work.angle_of(joint.pivot, joint.name)), work.names.slide(joint.name).sub
    sides = [LoopSide(Symbol("S", index, bold=True), u.times(work.slides[joint.name]))]
    if joint.offset:
        offset = work.stated(Symbol("e", joint.name), joint.offset, LENGTH)
        sides.append(LoopSide(Symbol("E", joint.name, bold=True), Components(*u.left().times(offset))))
    return Route(joint.through, ()), Route(joint.pivot, tuple(sides))
