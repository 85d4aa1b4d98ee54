"""Two bars that meet in a pin: the triangle of both bars and the line between their ends."""

from __future__ import annotations

from cmath import phase

from linkanim.explain.chains import Route, bar_side
from linkanim.explain.expression import TWO, Components, Formula, Symbol, arccos, atan2, number, sqrt, square
from linkanim.explain.rates import Order, Rates, TurnUnknown
from linkanim.explain.work import ANGLE, LENGTH, Work
from linkanim.mechanics.linkage.dyads import RRR


def place(joint: RRR, work: Work) -> None:
    """Add the cosine rule, with the bars' angles and where they meet."""
    (p, q), name = joint.ends, joint.name
    way = work.points[q] - work.points[p]
    work.say(
        f"From {{{p}}} to {{{q}}} the distance d and its direction δ, then the triangle of both bars by the "
        "cosine rule:"
    )
    d = work.let(Symbol("d", name), sqrt(square(way.x) + square(way.y)), LENGTH)
    symbol = work.angle_symbol(p, name)
    if d.value == 0:
        work.say("Both ends lie in one point, where every direction closes; the motion takes this one:")
        at = complex(*work.pose.position[name]) - complex(*work.pose.position[p])
        work.angles[p, name] = work.known(
            symbol, phase(at), ANGLE, f"from the motion through {{{p}}} = {{{q}}}"
        )
    else:
        work.angles[p, name] = work.let(symbol, _direction(joint, work, way, d), ANGLE)
    work.let_point(name, work.points[p] + work.bar(p, name, joint.lengths[0]))
    work.angle_of(q, name)


def _direction(joint: RRR, work: Work, way: Components, d: Formula) -> Formula:
    """Return the first bar's angle by the cosine rule, to the side on which the joint lies."""
    a, b = (work.length(end, joint.name, length) for end, length in joint.bars)
    ahead = work.let(Symbol("δ", joint.name), atan2(way.y, way.x), ANGLE)
    corner = _corner((square(a) + square(d) - square(b)) / (TWO * a * d), work, joint.name)
    left = _left(joint, work)
    work.say(_why(joint, left))
    return ahead + corner if left else ahead - corner


def _corner(cosine: Formula, work: Work, name: str) -> Formula:
    """Add the triangle's angle; at a limit, where rounding takes its cosine past 1, it is 0 or 180°."""
    if abs(cosine.value) <= 1:
        return work.let(Symbol("γ", name), arccos(cosine), ANGLE)
    work.say("To the digits shown the bars lie in one line: the cosine of γ is rounded past 1.")
    return number("0" if cosine.value > 0 else "180")


def _left(joint: RRR, work: Work) -> bool:
    """Tell whether the joint lies left of the way between its bars' ends at this pose."""
    p, q, at = (complex(*work.pose.position[name]) for name in (*joint.ends, joint.name))
    return ((q - p).conjugate() * (at - p)).imag >= 0


def _why(joint: RRR, left: bool) -> str:
    p, q = joint.ends
    side, sign = ("left", "added") if left else ("right", "taken off")
    found = f"Here {{{joint.name}}} lies {side} of {{{p}}} → {{{q}}}, so γ is {sign}"
    if joint.side_of is not None:
        return f"{found}: the closure to which the motion leads from its start."
    if left == (joint.side > 0):
        return f"{found}: as the scene names it."
    return f"{found}: the motion came to this closure through a limit or a change point."


def move(joint: RRR, rates: Rates, order: Order) -> None:
    """Add the two equations for how the bars turn, and how their pin moves."""
    work, (p, q), name = rates.work, joint.ends, joint.name
    (_, a), (_, b) = joint.bars
    one, other = work.bar(p, name, a), work.bar(q, name, b)
    frames = work.frame((p, name)), work.frame((q, name))
    right = rates.of(q, order) - rates.of(p, order)
    if order == 2:
        right = right + rates.centripetal(frames[0], one) - rates.centripetal(frames[1], other)
    rates.solve(
        name, (TurnUnknown(frames[0], one.left()), TurnUnknown(frames[1], -other.left())), right, order
    )
    rates.let_moving(name, rates.of(p, order) + rates.carried(frames[0], one, order), order)


def route(joint: RRR, work: Work) -> Route:
    """Return the way to the pin by the first bar."""
    return Route(joint.ends[0], (bar_side(work, joint.ends[0], joint.name, joint.lengths[0]),))


def loop(joint: RRR, work: Work) -> tuple[Route, Route]:
    """Return both ways to the pin."""
    other = bar_side(work, joint.ends[1], joint.name, joint.lengths[1])
    return route(joint, work), Route(joint.ends[1], (other,))
