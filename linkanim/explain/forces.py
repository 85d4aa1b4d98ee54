"""Work out what each body carries: each one free, its equations of balance, and their solution line by line.

Joints are taken in the reverse order of solving, as `mechanics.reactions` takes them, and each force is
computed from the digits of those before it. Moments are in newtons times the scene's unit of length.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from linkanim.explain.formula import (
    NOWHERE,
    ZERO,
    Components,
    Formula,
    Symbol,
    along,
    cos,
    dot,
    number,
    sin,
    sqrt,
    square,
)
from linkanim.explain.steps import (
    LENGTH,
    NOTHING,
    SQUARE,
    Equation,
    Item,
    Outcome,
    Powers,
    Rates,
    Step,
    System,
    Unknown,
    joint_title,
    marked,
    rounded,
)
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Body,
    Crank,
    Damper,
    DrivenSlider,
    Joint,
    Line,
    Rigid,
    Spring,
    holding,
)
from linkanim.mechanics.measures import loaded
from linkanim.mechanics.quantities import link_labels
from linkanim.mechanics.reactions import GROUND, Member, contact, member_of, members, named_at
from linkanim.words import name_said, said, sentences, to_say

_SHORTEST = 0.05 / 0.32
"""A force of less than this share of the greatest on a body is drawn so long, so that it is seen."""
_NO_FORCE = 1e-9
_MOST_UNKNOWN = 12
"""The most unknowns of a system that is written out as a matrix."""


_SENSES = to_say(
    "Unknown forces are taken to the right and up, those of guides to the left of their "
    "lines, couples counter-clockwise. Where a result is negative, it points the other "
    "way; the bodies are drawn with the forces as they are."
)


def cross(one: Components, other: Components) -> Formula:
    """Return the moment of a force at the end of an arm."""
    return one.x * other.y - one.y * other.x


@dataclass
class FreeBody:
    """All that acts on a body, and the joint of its equation of moments.

    `forces` have a name, the place at which they act, and their components; `couples` a name and a moment.
    """

    name: str
    about: str
    forces: list[tuple[str, Components, Components]] = field(default_factory=list)
    couples: list[tuple[str, Formula]] = field(default_factory=list)

    def total(self) -> Components:
        """Return the sum of the forces."""
        return sum((force for _, _, force in self.forces), NOWHERE)

    def moment(self, about: Components) -> Formula:
        """Return the moment of all that acts on the body."""
        moment = sum((cross(at - about, force) for _, at, force in self.forces if at != about), ZERO)
        return sum((couple for _, couple in self.couples), moment)

    def pulls(self) -> Iterator[tuple[str, complex, complex]]:
        """Yield the forces that are not zero as they are drawn: name, foot, and way.

        Places are x + yi, y up, in the scene's unit; the way of the greatest is 1 long.
        """
        values = [force.value for _, _, force in self.forces]
        most = max(map(abs, values), default=0.0)
        for (name, place, _), value in zip(self.forces, values, strict=True):
            if abs(value) > _NO_FORCE * most:
                yield name, place.value, value / abs(value) * max(abs(value) / most, _SHORTEST)

    def turning(self) -> list[tuple[str, float]]:
        """Return the couples that are not zero, counter-clockwise positive."""
        return [(name, couple.value) for name, couple in self.couples if couple.value]

    def triangle(self) -> list[tuple[str, complex, complex]]:
        """Return the names and sides (N) of the triangle that the body's three forces close; none of others.

        Exactly three forces that hold a body meet in a point, and head to tail they close a triangle.
        """
        sides = [(name, force.value) for name, _, force in self.forces if force.value]
        if len(sides) != 3 or self.couples:
            return []
        begins = np.cumsum([0j, *(value for _, value in sides)]).tolist()
        return [(name, begin, begin + value) for (name, value), begin in zip(sides, begins, strict=False)]


class Balance:
    """The forces worked out so far, and the lines that led to them."""

    def __init__(
        self,
        rates: Rates,
        known: Mapping[str, Formula],
        motion: Any,
        about: str | None = None,
    ) -> None:
        """Note the bodies, nothing on them yet; moments about the joint `about` where a body has it."""
        self.rates, self.work, self.linkage = rates, rates.work, rates.work.linkage
        self.known, self.motion = known, motion
        self.members, self.labels = members(self.linkage), link_labels(self.linkage)
        self.bodies = {member: self._free(member, about) for member in self.members.names}
        self.pins: dict[str, Components] = defaultdict(lambda: NOWHERE)
        self.results: list[Outcome] = []
        self.unknown: list[Symbol] = []
        self.following: dict[Symbol, Formula] = {}
        """Components that follow from others alone, as one force does from the other in a joint."""
        reactions = motion.reactions
        sizes = [abs(float(part)) for one in reactions.joints.values() for f in one.values() for part in f]
        self.size = max(sizes, default=0.0)
        self.moments = f"N {self.work.scale.unit}"

    def _free(self, member: Member, about: str | None) -> FreeBody:
        name = self.members.names[member]
        joints = (member,) if isinstance(member, str) else tuple(self.linkage.rigid_bodies[member])
        own = next((one.joints for one in self.linkage.bodies if one.name == name and one.joints), joints)
        return FreeBody(name, about if about in joints else own[0])

    def say(self, text: str) -> None:
        """Add a sentence."""
        self.work.say(text)

    def newtons(self, symbol: Symbol, formula: Formula) -> Formula:
        """Add the line of a force."""
        return self.work.let_plain(symbol, formula, "N")

    def moment_line(self, symbol: Symbol, formula: Formula) -> Formula:
        """Add the line of a moment."""
        return self.work.let_plain(symbol, formula, self.moments)

    def label(self, member: Member, joint: str) -> str:
        """Return what a body is called in indices."""
        name = named_at(self.linkage, member, joint)
        return "1" if name == GROUND else self.labels.get(name, name)

    def pair(self, joint: str, member: Member) -> tuple[Symbol, Symbol]:
        """Return the symbols of the components of a joint's force on a body."""
        index = f"{joint},{self.label(member, joint)}"
        return Symbol("F", f"{index}x"), Symbol("F", f"{index}y")

    def meet(self, joint: str, member: Member, force: Components, *, follows: bool = False) -> Components:
        """Add the lines of a joint's force on a body, and note it on both sides."""
        symbols = self.pair(joint, member)
        components = Components(*(self.newtons(one, part) for one, part in zip(symbols, force, strict=True)))
        self.note(joint, member, components, force if follows else None)
        return components

    def note(self, joint: str, member: Member, force: Components, from_: Components | None = None) -> None:
        """Note a joint's force on a body whose lines are there; `from_` where it follows from another one."""
        symbols, name = self.pair(joint, member), named_at(self.linkage, member, joint)
        for n, (symbol, part) in enumerate(zip(symbols, force, strict=True)):
            if from_ is not None:
                self.following[symbol] = from_[n]
            elif part.symbol is not None:
                self.unknown.append(symbol)
            token = f"{name}.{joint}.force.{'xy'[n]}"
            self.results.append(Outcome(token, part, "N", NOTHING * self.size))
        self.pins[joint] = self.pins[joint] - force
        self.apply(member, f"F_{{{symbols[0].sub[:-1]}}}", self.work.points[joint], force)

    def apply(self, member: Member, name: str, place: Components, force: Components) -> None:
        """Note a force on a body."""
        if force != NOWHERE:
            self.bodies[member].forces.append((name, place, force))

    def turn(self, member: Member, name: str, couple: Formula) -> None:
        """Note a couple on a body."""
        self.bodies[member].couples.append((name, couple))

    def hang(self, member: Member, joint: str) -> None:
        """Let a body be held by a joint against all else that acts on it."""
        self.meet(joint, member, -self.bodies[member].total())

    def direction(self, joint: str, line: Line) -> Components:
        """Return the direction of a joint's guide."""
        return self.work.guide(line, joint).direction

    def guide(self, joint: str, line: Line) -> None:
        """Add what a guide does to the block in it."""
        u, place = self.direction(joint, line), self.work.points[joint]
        normal, block = Components(-u.y, u.x), joint
        name = self.members.names[block]
        index = self.labels.get(name, name)
        force = self.newtons(Symbol("N", index), -dot(self.bodies[block].total(), normal))
        turning = self.moment_line(Symbol("M", index), -self.bodies[block].moment(place))
        self.unknown += [one.symbol for one in (force, turning) if one.symbol is not None]
        self.results.append(Outcome(f"{name}.guide_force", force, "N", NOTHING * self.size))
        push = normal.times(force)
        self.apply(block, f"N_{{{index}}}", place, push)
        carrier = holding(self.linkage.rigid_bodies, line.body) or 0 if line.on else 0
        self.apply(carrier, f"N_{{{index}}}", place, -push)
        if turning.constant != 0:
            self.turn(block, f"M_{{{index}}}", turning)
            self.turn(carrier, f"M_{{{index}}}", -turning)


# What is known: weight and inertia, springs and dampers, loads.


def _loads(balance: Balance) -> None:
    work, linkage = balance.work, balance.linkage
    for body in linkage.bodies:
        _weigh(body, balance)
    struts: tuple[Spring | Damper, ...] = (*linkage.springs, *linkage.dampers)
    for strut in struts:
        _pull(strut, balance)
    for load in linkage.loads:
        body = linkage.body(load.on)
        member = member_of(linkage, body)
        arm, force = loaded(balance.motion, load)
        given = Components(
            *(
                work.quoted(Symbol("F", f"{load.name},{side}"), f"{float(part):.12g}", "N")
                for side, part in zip("xy", force, strict=True)
            )
        )
        base = work.points[body.slider or body.joints[0]]
        place = work.points.get(load.joint) or work.points.get(load.name) or work.points.get(f"L{load.name}")
        if place is None or body.slider:
            sides = (
                work.known(Symbol(one, load.name), float(part), LENGTH)
                for one, part in zip("pq", arm, strict=True)
            )
            place = base + Components(*sides) if any(arm) else base
        balance.apply(member, f"F_{{{load.name}}}", place, given)
        if load.torque:
            torque = work.quoted(Symbol("T", load.name), f"{load.torque:.12g}", "N m")
            balance.turn(member, f"T_{{{load.name}}}", torque / work.metre)


def _weigh(body: Body, balance: Balance) -> None:
    """Add the lines of a body's weight and inertia."""
    work, linkage, label = balance.work, balance.linkage, balance.labels[body.name]
    member = member_of(linkage, body)
    if not member:
        return
    if body.mass is not None:
        mass = work.quoted(Symbol("m", label), f"{body.mass:.12g}", "kg")
        at = body.slider or work.centre(body)
        bent = NOWHERE if linkage.static else balance.rates.of(at, 2).times(work.metre)
        fall = work.quoted(Symbol("g"), f"{linkage.gravity:.12g}", "m/s²") if linkage.gravity else ZERO
        down = Components(bent.x, bent.y + fall)
        sides = zip("xy", down, strict=True)
        force = Components(
            *(balance.newtons(Symbol("Q", f"{label}{one}"), -(mass * part)) for one, part in sides)
        )
        balance.apply(member, f"Q_{{{label}}}", work.points[at], force)
    if body.inertia is not None and not linkage.static:
        inertia = work.quoted(Symbol("I", label), f"{body.inertia:.12g}", "kg m²")
        turning = balance.known[f"{body.name}.angular_acceleration"]
        couple = balance.moment_line(Symbol("C", label), -(inertia * turning / work.metre))
        if couple.constant != 0:
            balance.turn(member, f"C_{{{label}}}", couple)


def _pull(strut: Spring | Damper, balance: Balance) -> None:
    """Add the lines of what a spring or damper does to the pins at its ends."""
    if strut not in balance.rates.struts:
        return
    work, (first, last) = balance.work, strut.between
    span = (work.points[last] - work.points[first]).times(balance.rates.struts[strut][0])
    length = balance.known[f"{strut.name}.length"]
    sides = zip("xy", span, strict=True)
    pull = Components(
        *(balance.newtons(Symbol("S", f"{strut.name},{one}"), part / length) for one, part in sides)
    )
    balance.pins[first] = balance.pins[first] + pull
    balance.pins[last] = balance.pins[last] - pull


# The joints, each kind in its own way; see `mechanics.reactions` for the equations.


def _bars(joint: RRR, balance: Balance) -> None:
    (one, other), (first, last) = balance.members.of[joint.name], joint.ends
    points, pull = balance.work.points, balance.pins[joint.name]
    here = points[joint.name]
    b1, b2 = here - points[first], here - points[last]
    labels = balance.label(one, joint.name), balance.label(other, joint.name)
    balance.say(
        said(
            "Moments about {first} and {last} leave two equations for the force in {joint}; the "
            "other forces on both bars follow from their sums.",
            first=marked(first),
            last=marked(last),
            joint=marked(joint.name),
        )
    )
    m1 = balance.moment_line(Symbol("M", f"{first},{labels[0]}"), balance.bodies[one].moment(points[first]))
    given = balance.bodies[other].moment(points[last]) + cross(b2, pull)
    m2 = balance.moment_line(Symbol("M", f"{last},{labels[1]}"), given)
    force = _solved(
        joint.name, balance.pair(joint.name, one), ((-b1.y, b1.x, -m1), (-b2.y, b2.x, m2)), balance
    )
    balance.note(joint.name, one, force)
    balance.meet(joint.name, other, pull - force, follows=True)
    balance.hang(one, first)
    balance.hang(other, last)


def _solved(
    index: str,
    unknowns: tuple[Symbol, Symbol],
    rows: tuple[tuple[Formula, Formula, Formula], tuple[Formula, Formula, Formula]],
    balance: Balance,
) -> Components:
    """Add two equations of moments for the components of a force, and their solution by Cramer's rule."""
    work = balance.work
    if all(row[2].constant == 0 for row in rows):
        return NOWHERE

    def entry(formula: Formula, n: int, k: int) -> Formula:
        if formula.constant is not None:
            return formula
        if k == 2:
            text = formula.shown or rounded(formula.value, _places(formula))
            return Formula("leaf", symbol=Symbol("b", str(n)), shown=text)
        shown = rounded(formula.value, work.scale.decimals(LENGTH))
        return Formula("leaf", symbol=Symbol("a", f"{n}{k + 1}"), shown=shown)

    values = tuple(tuple(entry(one, n, k) for k, one in enumerate(row)) for n, row in enumerate(rows, 1))
    (a, b, c), (d, e, f) = values
    work.items.append(System(unknowns, values, rows))
    det = work.let(Symbol("D", f"{index},F"), a * e - b * d, SQUARE)
    numerators = (c * e - b * f, a * f - d * c)
    return Components(
        *(balance.newtons(one, part / det) for one, part in zip(unknowns, numerators, strict=True))
    )


def _places(formula: Formula) -> int:
    """Return the decimals of a formula's one number, which a sign does not change."""
    return max((len(leaf.shown.partition(".")[2]) for leaf in formula.leaves), default=0)


def _bar_to_slider(joint: RRP, balance: Balance) -> None:
    bar, block = balance.members.of[joint.name]
    points, pull, name = balance.work.points, balance.pins[joint.name], joint.name
    u, arm = balance.direction(name, joint.line), points[name] - points[joint.end]
    normal = Components(-u.y, u.x)
    index = f"{name},{balance.label(bar, name)}"
    balance.say(
        said(
            "What acts on the block along its guide gives one component of the force in {name}, "
            "moments about {end} the one across.",
            name=marked(name),
            end=marked(joint.end),
        )
    )
    along_ = balance.newtons(Symbol("F", f"{index}t"), dot(pull + balance.bodies[block].total(), u))
    m = balance.moment_line(
        Symbol("M", f"{joint.end},{balance.label(bar, name)}"), balance.bodies[bar].moment(points[joint.end])
    )
    lever = balance.work.let(Symbol("q", f"{name},F"), dot(arm, u), LENGTH)
    aside = balance.work.let(Symbol("d", f"{name},F"), cross(arm, u), LENGTH)
    across = balance.newtons(Symbol("F", f"{index}n"), (-m - along_ * aside) / lever)
    force = u.times(along_) + normal.times(across)
    components = balance.meet(name, bar, force)
    balance.meet(name, block, pull - components, follows=True)
    balance.guide(name, joint.line)
    balance.hang(bar, joint.end)


def _slot(joint: RPR, balance: Balance) -> None:
    (bar,), points = balance.members.of[joint.name], balance.work.points
    _pinned(joint.name, bar, balance)
    u = along(balance.work.angle_of(joint.pivot, joint.name))
    label = balance.label(bar, joint.name)
    m = balance.moment_line(
        Symbol("M", f"{joint.pivot},{label}"), balance.bodies[bar].moment(points[joint.pivot])
    )
    lever = balance.work.let(
        Symbol("q", f"{joint.through},F"), dot(points[joint.through] - points[joint.pivot], u), LENGTH
    )
    push = balance.newtons(Symbol("S", f"{joint.through},{label}"), -m / lever)
    balance.meet(joint.through, bar, Components(-u.y, u.x).times(push))
    balance.hang(bar, joint.pivot)


def _yoke(joint: RPP, balance: Balance) -> None:
    (block,) = balance.members.of[joint.name]
    _pinned(joint.name, block, balance)
    u = balance.direction(joint.name, joint.line)
    slot = balance.work.stated(
        Symbol("δ", joint.name), joint.slot, Powers(angle=True), said("its slot from its guide")
    )
    push = balance.newtons(
        Symbol("S", f"{joint.pin},{balance.label(block, joint.name)}"),
        dot(balance.bodies[block].total(), u) / sin(slot),
    )
    n = Components(-(sin(slot) * u.x) - cos(slot) * u.y, cos(slot) * u.x - sin(slot) * u.y)
    balance.meet(joint.pin, block, n.times(push))
    balance.guide(joint.name, joint.line)


def _pinned(joint: str, member: Member, balance: Balance) -> None:
    """Give the pin's pull to the one body that has the joint."""
    if balance.pins[joint] != NOWHERE:
        balance.meet(joint, member, balance.pins[joint], follows=True)


def _crank(joint: Crank, balance: Balance) -> None:
    (bar,), points = balance.members.of[joint.name], balance.work.points
    _pinned(joint.name, bar, balance)
    label, moment = balance.label(bar, joint.name), balance.bodies[bar].moment(points[joint.pivot])
    ends = balance.linkage.drive.actuator.along
    if joint.gear is not None:
        _mesh(joint, moment, balance)
    elif ends is None:
        turning = balance.moment_line(Symbol("M", "in"), -moment)
        if turning.symbol:
            balance.unknown.append(turning.symbol)
        balance.turn(bar, "M_{in}", turning)
        balance.turn(0, "M_{in}", -turning)
    else:
        fixed, moving = ends
        apart = points[moving] - points[fixed]
        size = balance.work.let(Symbol("ℓ", f"{fixed}{moving}"), _size(apart), LENGTH)
        u = Components(
            balance.work.let(Symbol("u", "x"), apart.x / size, Powers()),
            balance.work.let(Symbol("u", "y"), apart.y / size, Powers()),
        )
        lever = balance.work.let(Symbol("h", "in"), cross(points[moving] - points[joint.pivot], u), LENGTH)
        push = balance.newtons(Symbol("F", f"in,{label}"), -moment / lever)
        balance.meet(moving, bar, u.times(push))
        balance.pins[fixed] = balance.pins[fixed] - u.times(push)
    balance.hang(bar, joint.pivot)


def _size(vector: Components) -> Formula:
    return sqrt(square(vector.x) + square(vector.y))


def _mesh(joint: Crank, moment: Formula, balance: Balance) -> None:
    """Add what turns a geared crank: its mate's teeth, or a belt."""
    gear, linkage, work = joint.gear, balance.linkage, balance.work
    assert gear is not None
    (bar,), (other,) = balance.members.of[joint.name], balance.members.of[gear.mate]
    centre, ratio = linkage.crank(gear.mate).pivot, float(gear.ratio)
    share, still = contact(linkage, joint)
    needed = balance.moment_line(Symbol("M", f"g{joint.name}"), -moment)
    if share is None:
        factor = number(f"{ratio:.12g}")
        balance.turn(bar, f"M_{{g{joint.name}}}", needed)
        balance.turn(other, f"M_{{g{joint.name}}}", -(needed * factor))
        balance.turn(0, f"M_{{g{joint.name}}}", -(needed * number(f"{1.0 - ratio:.12g}")))
        return
    own = work.points[joint.pivot]
    line = own - work.points[centre]
    size = work.let(Symbol("e", joint.name), _size(line), LENGTH)
    u = Components(
        work.let(Symbol("u", f"{joint.name}x"), line.x / size, Powers()),
        work.let(Symbol("u", f"{joint.name}y"), line.y / size, Powers()),
    )
    reach = number(f"{share - 1.0:.12g}")
    push = balance.newtons(Symbol("F", f"{joint.name},t"), needed / (size * reach))
    slope = number(f"{math.tan(gear.pressure_angle) * (1.0 if push.value >= 0 else -1.0):.12g}")
    apart = balance.newtons(Symbol("F", f"{joint.name},r"), push * slope)
    force = Components(-u.y, u.x).times(push) + u.times(apart if share < 1.0 else -apart)
    sides = zip("xy", force, strict=True)
    teeth = Components(*(balance.newtons(Symbol("Z", f"{joint.name}{one}"), part) for one, part in sides))
    place = own + line.times(reach)
    balance.apply(bar, f"Z_{{{joint.name}}}", place, teeth)
    balance.apply(0 if still else other, f"Z_{{{joint.name}}}", place, -teeth)


def _driven_slider(joint: DrivenSlider, balance: Balance) -> None:
    (block,) = balance.members.of[joint.name]
    _pinned(joint.name, block, balance)
    u, place = balance.direction(joint.name, joint.line), balance.work.points[joint.name]
    push = balance.newtons(Symbol("F", "in,s"), -dot(balance.bodies[block].total(), u))
    if push.symbol:
        balance.unknown.append(push.symbol)
    balance.apply(block, "F_{in}", place, u.times(push))
    balance.apply(0, "F_{in}", place, -u.times(push))
    balance.guide(joint.name, joint.line)


def _point(joint: Rigid, balance: Balance) -> None:
    (body,) = balance.members.of[joint.name]
    _pinned(joint.name, body, balance)


_KINDS: Mapping[type[Joint], Callable[[Any, Balance], None]] = {
    RRR: _bars,
    RRP: _bar_to_slider,
    RPR: _slot,
    RPP: _yoke,
    Crank: _crank,
    DrivenSlider: _driven_slider,
}


# The chapter: each body free, its equations, the system, the solution.


def forces(balance: Balance) -> tuple[Step, ...]:
    """Return the steps on what each body carries; the balance has the bodies then, and the results."""
    linkage = balance.linkage
    if not math.isfinite(balance.size):
        text = said("Forces grow without bound here: a lever vanishes under load. Take a pose beside it.")
        return (Step("", (text,)),)
    step = balance.work.step
    known = step(said("What is known"), partial(_loads, balance))
    solved = [
        step(joint_title(joint.name), partial(_KINDS.get(type(joint), _point), joint, balance))
        for joint in reversed(linkage.joints)
        if not joint.fixed
    ]
    for pin in linkage.pins:
        title = said("Ground at {pin}", pin=marked(pin.name))
        solved.append(step(title, partial(_pinned, pin.name, 0, balance)))
    equations = [(body, _equations(body, balance)) for member, body in balance.bodies.items() if member]
    steps = [Step("", (said(_SENSES),))]
    steps += [known] if known.items else []
    steps += [
        Step(said("{body}, free", body=_words(body)), _freed(body, balances)) for body, balances in equations
    ]
    steps += _system([one for _, balances in equations for one in balances], balance)
    steps += [step for step in solved if step.items]
    return tuple(steps)


def _words(body: FreeBody) -> str:
    if len(body.name) < 3:
        return said("Link {name}", name=body.name)
    name = name_said(body.name)
    return name[:1].upper() + name[1:]


def _equations(body: FreeBody, balance: Balance) -> tuple[Formula, Formula, Formula]:
    """Return the sums of a free body that are zero: across, up, and of moments about its point."""
    x, y = body.total()
    return x, y, body.moment(balance.work.points[body.about])


def _freed(body: FreeBody, sums: tuple[Formula, Formula, Formula]) -> tuple[Item, ...]:
    acting = dict.fromkeys([*(name for name, _, _ in body.forces), *(name for name, _ in body.couples)])
    if not acting:
        return (said("Nothing acts on it."),)
    listed = Unknown(tuple(Formula("leaf", symbol=symbol_of(name)) for name in acting), said("On it act"))
    text = said(_SUMS if sums[-1].symbolic else _NO_MOMENT, about=marked(body.about))
    return (listed, text, *(Equation(one, ZERO) for one in sums if one.symbolic))


_SUMS = to_say("Its forces across and up, and their moments about {about}:")
_NO_MOMENT = to_say("Its forces across and up, none of which has a moment about {about}:")


def symbol_of(name: str) -> Symbol:
    """Return the symbol of a force or couple by its name, F_{B,3}."""
    letter, _, index = name.partition("_{")
    return Symbol(letter, index.removesuffix("}"))


def _system(sums: list[Formula], balance: Balance) -> list[Step]:
    """Return the step with all equations as one system, where it is small enough to be read."""
    unknown = list(dict.fromkeys(balance.unknown))
    rows = [_linear(one, balance) for one in sums]
    rows = [row for row in rows if any(symbol in row[0] for symbol in unknown)]
    count = len(unknown)
    if len(rows) != count:
        return []
    text = said("These are {count} linear equations in {count} unknowns.", count=count)
    if count > _MOST_UNKNOWN:
        return [Step(said("All equations"), (text,))]
    digits = 5

    def leaf(value: float) -> Formula:
        return number(f"{float(f'{value:.{digits}g}'):.12g}")

    matrix = tuple(
        (*(leaf(coefficients.get(symbol, 0.0)) for symbol in unknown), leaf(-constant))
        for coefficients, constant in rows
    )
    return [
        Step(
            said("All equations"),
            (sentences(text, said("As A x = b they are:")), System(tuple(unknown), matrix)),
        )
    ]


def _linear(formula: Formula, balance: Balance) -> tuple[dict[Symbol, float], float]:
    """Return a formula as coefficients of the unknowns and a constant."""
    unknown = set(balance.unknown)

    def of(one: Formula) -> tuple[dict[Symbol, float], float]:
        if one.operation == "leaf":
            if one.symbol in unknown:
                return {one.symbol: 1.0}, 0.0
            if one.symbol in balance.following:
                return of(balance.following[one.symbol])
            return {}, one.value
        parts = [of(part) for part in one.parts]
        match one.operation:
            case "+" | "-":
                sign = 1.0 if one.operation == "+" else -1.0
                (a, p), (b, q) = parts
                return {k: a.get(k, 0.0) + sign * b.get(k, 0.0) for k in {**a, **b}}, p + sign * q
            case "neg":
                return {k: -v for k, v in parts[0][0].items()}, -parts[0][1]
            case "·":
                (a, p), (b, q) = parts
                return {k: a.get(k, 0.0) * q + p * b.get(k, 0.0) for k in {**a, **b}}, p * q
            case "/":
                (a, p), (_, q) = parts
                return {k: v / q for k, v in a.items()}, p / q
        return {}, one.value

    return of(formula)
