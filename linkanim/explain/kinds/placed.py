"""Joints that are put in place: fixed pins, cranks, a driven slider, points of bodies."""

from __future__ import annotations

from linkanim.explain.chains import LoopSide, Route, bar_side, slide_sides
from linkanim.explain.expression import NOWHERE, Components, Formula, Symbol, along, number
from linkanim.explain.rates import Order, Rates
from linkanim.explain.work import ANGLE, LENGTH, Work
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Gear, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid


def place_pin(pin: Pin, work: Work) -> None:
    """Take where the pin stands, or work it out from its length and angle."""
    if pin.polar is None or not pin.polar.length:
        x, y = (
            work.stated(Symbol(letter, pin.name), value, LENGTH)
            for letter, value in zip("xy", pin.position, strict=True)
        )
        work.points[pin.name] = Components(x, y)
        return
    base, (length, angle) = pin.polar.base, (pin.polar.length, pin.polar.angle)
    origin = next((name for name, at in work.points.items() if at == NOWHERE), None)
    index = work.names.length(start, pin.name) if (start := base or origin) else pin.name
    arm = along(work.stated(Symbol("θ", index), angle, ANGLE)).times(
        work.stated(Symbol("r", index), length, LENGTH)
    )
    work.let_point(pin.name, (work.points[base] if base else NOWHERE) + arm)


def place_crank(crank: Crank, work: Work) -> None:
    """Add the geared crank's angle, and where its pin lies."""
    ends = crank.pivot, crank.name
    if crank.gear is not None:
        mate = work.linkage.crank(crank.gear.mate)
        offset = work.stated(Symbol("δ", crank.name), crank.gear.offset, ANGLE, "angle of the gears at θ = 0")
        driven = _ratio(crank.gear) * work.angle_of(mate.pivot, mate.name) + offset
        work.angles[ends] = work.let(work.angle_symbol(*ends), driven, ANGLE)
    work.let_point(crank.name, work.points[crank.pivot] + work.bar(*ends, crank.length))


def move_crank(crank: Crank, rates: Rates, order: Order) -> None:
    """Add how the geared crank turns, and how its pin moves."""
    frame = rates.work.frame((crank.pivot, crank.name))
    if crank.gear is not None:
        mate = rates.work.linkage.crank(crank.gear.mate)
        driver = rates.turn(rates.work.frame((mate.pivot, mate.name)), order)
        rates.let_turning(frame, _ratio(crank.gear) * driver, order)
    arm = rates.work.bar(crank.pivot, crank.name, crank.length)
    rates.let_moving(crank.name, rates.of(crank.pivot, order) + rates.carried(frame, arm, order), order)


def _ratio(gear: Gear) -> Formula:
    top, bottom = (number(str(part)) for part in gear.ratio.as_integer_ratio())
    return top / bottom


def route_of_crank(crank: Crank, work: Work) -> Route:
    """Return the way to its pin."""
    return Route(crank.pivot, (bar_side(work, crank.pivot, crank.name, crank.length),))


def place_slider(slider: DrivenSlider, work: Work) -> None:
    """Add where the driven slider lies."""
    guide = work.guide(slider.line, slider.name)
    ahead = guide.direction.times(work.slides[slider.name])
    aside = guide.direction.left().times(guide.offset)
    work.let_point(slider.name, work.points[guide.through] + ahead + aside)


def move_slider(slider: DrivenSlider, rates: Rates, order: Order) -> None:
    """Add how the driven slider moves."""
    guide = rates.work.guide(slider.line, slider.name)
    rates.let_moving(slider.name, guide.direction.times(rates.sliding[slider.name][order - 1]), order)


def route_of_slider(slider: DrivenSlider, work: Work) -> Route:
    """Return the way along its guide."""
    return Route(slider.line.through, slide_sides(work, work.guide(slider.line, slider.name), slider.name))


def place_point(point: Rigid, work: Work) -> None:
    """Add where a point of a body lies: along the line of two of its joints, and to the left."""
    work.let_point(
        point.name, work.points[point.on[0]] + body_point(work, point.on, point.at, legs(point, work))
    )


def legs(point: Rigid, work: Work) -> tuple[Symbol, Symbol]:
    """Return the symbols of how far a point lies along its body's line, and to the left."""
    known = iter(work.names.legs.get(point.name, ()))
    named = [Symbol("r", next(known, "")) if value else Symbol("") for value in point.at]
    if point.at[1] == 0 and not named[0].sub:
        return Symbol("r", work.names.length(point.on[0], point.name)), Symbol("")
    usual = Symbol("p", point.name), Symbol("q", point.name)
    return tuple(own if own.sub else other for own, other in zip(named, usual, strict=True))  # type: ignore[return-value]


def body_point(
    work: Work, on: tuple[str, str], at: tuple[float, float], names: tuple[Symbol, Symbol]
) -> Components:
    """Return how far a point of a body lies from its first joint."""
    ahead = along(work.angle_of(*on))
    about = f"along {{{on[0]}}}–{{{on[1]}}}", f"to the left of {{{on[0]}}}–{{{on[1]}}}"
    p, q = (
        work.stated(name, value, LENGTH, words) for name, value, words in zip(names, at, about, strict=True)
    )
    return ahead.times(p) + ahead.left().times(q)


def move_point(point: Rigid, rates: Rates, order: Order) -> None:
    """Add how a point of a body moves."""
    points, base = rates.work.points, point.on[0]
    arm = points[point.name] - points[base]
    turned = rates.carried(rates.work.frame(point.on), arm, order)
    rates.let_moving(point.name, rates.of(base, order) + turned, order)


def route_of_point(point: Rigid, work: Work) -> Route:
    """Return the way from its body's first joint."""
    base, points = point.on[0], work.points
    name, other = legs(point, work)
    index = name.sub if not other.letter and name.letter == "r" else base + point.name
    return Route(base, (LoopSide(Symbol("R", index, bold=True), points[point.name] - points[base]),))


def rest(pin: Pin, rates: Rates, order: Order) -> None:
    """Leave the pin where it is."""
    rates.moving.setdefault(pin.name, []).append(NOWHERE)
