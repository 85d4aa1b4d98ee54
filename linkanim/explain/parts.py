"""What hangs on a linkage, worked out: centres of mass, springs and dampers, what the input delivers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from linkanim.explain.expression import ZERO, Formula, Symbol, dot, number, sqrt, square
from linkanim.explain.kinds import body_point
from linkanim.explain.lines import Outcome
from linkanim.explain.rates import ORDERS, Rates
from linkanim.explain.work import LENGTH, Powers
from linkanim.mechanics.facts.effort import effort_token
from linkanim.mechanics.facts.register import link_labels
from linkanim.mechanics.linkage.linkage import Body, Damper, Spring

_WORDS = ("com_position", "com_velocity", "com_acceleration")


def centre_of_mass(body: Body, rates: Rates) -> Iterator[Outcome]:
    """Add where a body's centre of mass is and how it moves, and yield it."""
    assert body.com is not None
    work, on = rates.work, (body.joints[0], body.joints[1])
    name = centre_name(body, rates)
    arm = body_point(work, on, body.com, (Symbol("p", name), Symbol("q", name)))
    work.let_point(name, work.points[on[0]] + arm)
    yield from work.scale.outcomes(f"{body.name}.{_WORDS[0]}", work.points[name], 0)
    for order in ORDERS:
        rates.let_carried(name, on, work.points[name] - work.points[on[0]], order)
        yield from work.scale.outcomes(f"{body.name}.{_WORDS[order]}", rates.of(name, order), order)


def centre_name(body: Body, rates: Rates) -> str:
    """Return what a body's centre of mass is called: G3, or GG3 where a joint has that name."""
    linkage = rates.work.linkage
    name = f"G{link_labels(linkage)[body.name]}"
    while any(joint.name == name for joint in linkage.joints):
        name = f"G{name}"
    return name


def strut(item: Spring | Damper, rates: Rates) -> Iterator[Outcome]:
    """Add the length of a spring or damper, its rate and its force, and yield them."""
    work, (start, end), name = rates.work, item.between, item.name
    way, moving = work.points[end] - work.points[start], rates.of(end, 1) - rates.of(start, 1)
    length = work.let(Symbol("L", name), sqrt(square(way.x) + square(way.y)), LENGTH)
    yield work.scale.outcome(f"{name}.length", length, LENGTH)
    if length.value == 0:
        work.say("Its ends meet, so that its rate does not follow from this.")
        return
    rate = rates.let(Symbol("L", name, "˙"), dot(way, moving) / length, Powers(1, 1))
    yield work.scale.outcome(f"{name}.rate", rate, Powers(1, 1))
    if item.forceful:
        force = work.let_plain(Symbol("F", name), _force(item, rates, length, rate), "N")
        rates.struts[item] = force, rate
        yield Outcome(f"{name}.force", force, last=True)


def _force(item: Spring | Damper, rates: Rates, length: Formula, rate: Formula) -> Formula:
    work, metre = rates.work, _metre(rates)
    if isinstance(item, Damper):
        assert item.coefficient is not None
        return work.quoted(Symbol("c", item.name), f"{item.coefficient:.12g}", "N s/m") * rate * metre
    assert item.stiffness is not None
    assert item.free_length is not None
    free = work.stated(Symbol("L", f"{item.name}0"), item.free_length, LENGTH, "its length without force")
    return work.quoted(Symbol("k", item.name), f"{item.stiffness:.12g}", "N/m") * (length - free) * metre


def _metre(rates: Rates) -> Formula:
    """Return one unit of length in metres."""
    return number(f"{rates.work.linkage.metre:.12g}")


def effort(rates: Rates, known: Mapping[str, Formula]) -> Iterator[Outcome]:
    """Add the power of all forces and masses, and what the input delivers, which is yielded.

    `known` are the quantities worked out so far, by their tokens.
    """
    work, linkage = rates.work, rates.work.linkage
    if not rates.struts.keys() >= set(_forceful(rates)):
        work.say("The rate of a spring or damper does not follow, so that what the input delivers does not.")
        return
    work.say("The input delivers the power of springs, dampers and masses, over its own rate:")
    powers = [*_strut_powers(rates), *_body_powers(rates, known)]
    total = work.let_plain(Symbol("P"), sum(powers, ZERO), "W")
    name, unit = linkage.drive.actuator.effort
    pace = _pace(rates)
    if pace.value == 0:
        work.say("The input rests here, so that this does not follow from power.")
        return
    delivered = work.let_plain(Symbol(name[0].upper(), "in"), total / pace, unit)
    yield Outcome(effort_token(linkage), delivered, last=True)


def _pace(rates: Rates) -> Formula:
    """Return the rate of what drives: an angular velocity, or a velocity in m/s."""
    work, drive = rates.work, rates.work.linkage.drive
    if drive.actuator.along:
        way, moving = (
            work.points[drive.actuator.along[1]] - work.points[drive.actuator.along[0]],
            rates.of(drive.actuator.along[1], 1) - rates.of(drive.actuator.along[0], 1),
        )
        length = sqrt(square(way.x) + square(way.y))
        return rates.let(Symbol("ℓ", "", "˙"), dot(way, moving) / length, Powers(1, 1)) * _metre(rates)
    pace = rates.rate(work.driver, 1)
    return pace if isinstance(work.driver, int) else pace * _metre(rates)


def _forceful(rates: Rates) -> list[Spring | Damper]:
    return [item for item in rates.work.linkage.springs + rates.work.linkage.dampers if item.forceful]


def _strut_powers(rates: Rates) -> Iterator[Formula]:
    for item in _forceful(rates):
        force, rate = rates.struts[item]
        power = force * rate * _metre(rates)
        yield rates.work.let_plain(Symbol("P", item.name), power, "W")


def _body_powers(rates: Rates, known: Mapping[str, Formula]) -> Iterator[Formula]:
    work, metre = rates.work, _metre(rates)
    for body in work.linkage.bodies:
        label = link_labels(work.linkage)[body.name]
        if body.mass is not None:
            at = body.slider or centre_name(body, rates)
            velocity, acceleration = rates.of(at, 1), rates.of(at, 2)
            pull = dot(acceleration, velocity) * square(metre)
            if work.linkage.gravity:
                fall = work.quoted(Symbol("g"), f"{work.linkage.gravity:.12g}", "m/s²")
                pull = pull + fall * velocity.y * metre
            mass = work.quoted(Symbol("m", label), f"{body.mass:.12g}", "kg")
            yield work.let_plain(Symbol("P", label), mass * pull, "W")
        if body.inertia is not None:
            inertia = work.quoted(Symbol("I", label), f"{body.inertia:.12g}", "kg m²")
            turning = known[f"{body.name}.angular_acceleration"] * known[f"{body.name}.angular_velocity"]
            yield work.let_plain(Symbol("P", f"{label}turn"), inertia * turning, "W")
