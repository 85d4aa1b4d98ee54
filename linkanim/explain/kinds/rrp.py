"""A bar to a slider on a line."""

from __future__ import annotations

from linkanim.explain.chains import Route, bar_side, slide_sides
from linkanim.explain.expression import ZERO, Components, Formula, Symbol, sqrt, square
from linkanim.explain.rates import Order, Rates, SlideUnknown, TurnUnknown
from linkanim.explain.work import LENGTH, GuideLine, Work
from linkanim.mechanics.linkage.dyads import RRP


def beside_guide(work: Work, guide: GuideLine, point: str, joint: str) -> tuple[Formula, Formula]:
    """Add how far a point lies forward along a guide, and to the left of it."""
    way, u = work.points[point] - work.points[guide.through], guide.direction
    forward = work.let(Symbol("f", joint), way.x * u.x + way.y * u.y, LENGTH)
    return forward, work.let(Symbol("n", joint), way.y * u.x - way.x * u.y - guide.offset, LENGTH)


def on_guide(work: Work, guide: GuideLine, slide: Formula) -> Components:
    """Return the place on a guide that is so far along it."""
    u = guide.direction
    return work.points[guide.through] + u.times(slide) + u.left().times(guide.offset)


def place(joint: RRP, work: Work) -> None:
    """Add the right-angled triangle of bar and guide, and where the slider is."""
    name, end = joint.name, joint.end
    guide = work.guide(joint.line, name)
    work.say(
        f"How far {{{end}}} lies along the guide from {{{guide.through}}} (f) and to its left (n), then the "
        "slider's way s:"
    )
    forward, aside = beside_guide(work, guide, end, name)
    margin = square(work.length(end, name, joint.length)) - square(aside)
    if margin.value < 0:
        work.say("To the digits shown the bar stands square to the guide: what is under the root is 0.")
    root = sqrt(margin) if margin.value >= 0 else ZERO
    ahead = _ahead(joint, work)
    work.say(_why(joint, ahead))
    slide = work.let(work.names.slide(name), forward + root if ahead else forward - root, LENGTH)
    work.slides[name] = slide
    work.let_point(name, on_guide(work, guide, slide))
    work.angle_of(end, name)


def _ahead(joint: RRP, work: Work) -> bool:
    """Tell whether the slider is ahead of the bar's end at this pose."""
    end, at = (complex(*work.pose.position[name]) for name in (joint.end, joint.name))
    u = work.guide(joint.line, joint.name).direction
    return ((at - end) * complex(u.x.value, -u.y.value)).real >= 0


def _why(joint: RRP, ahead: bool) -> str:
    way, sign = ("ahead of", "plus") if ahead else ("behind", "minus")
    named = ahead == (joint.side > 0)
    why = "as the scene names it" if named else "the motion came to it through a limit or a change point"
    return f"Here {{{joint.name}}} is {way} {{{joint.end}}}, so the root has a {sign}: {why}."


def move(joint: RRP, rates: Rates, order: Order) -> None:
    """Add the two equations for how the slider slides and the bar turns, and how the joint moves."""
    work, name, end = rates.work, joint.name, joint.end
    guide, frame = work.guide(joint.line, name), work.frame((end, name))
    bar, u = work.bar(end, name, joint.length), guide.direction
    arm = work.points[name] - work.points[guide.through]
    slid = u.times(rates.sliding[name][0]) if order == 2 else u
    right = rates.of(end, order) - rates.guided(guide, arm, slid, order)
    if order == 2:
        right = right - rates.centripetal(frame, bar)
    rates.solve(name, (SlideUnknown(name, u), TurnUnknown(frame, -bar.left())), right, order)
    if joint.line.on is None:
        rates.let_moving(name, u.times(rates.sliding[name][order - 1]), order)
    else:
        rates.let_moving(name, rates.of(end, order) + rates.carried(frame, bar, order), order)


def route(joint: RRP, work: Work) -> Route:
    """Return the way to the slider by its bar."""
    return Route(joint.end, (bar_side(work, joint.end, joint.name, joint.length),))


def loop(joint: RRP, work: Work) -> tuple[Route, Route]:
    """Return both ways to the slider."""
    guide = work.guide(joint.line, joint.name)
    return route(joint, work), Route(guide.through, slide_sides(work, guide, joint.name))
