"""Work out a pose: the chapters of the solution, and the results that they lead to.

Its parts, in reading order:

- Where the input is and how it moves: as it was asked for, or from the phase.
- The loads of a linkage, worked out: centres of mass, springs and dampers, what the input delivers.
- The worked solution of a pose: its chapters, and the results that they lead to.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import Any, Literal

import numpy as np

from linkanim.errors import BadInput
from linkanim.explain.forces import Balance, FreeBody, forces
from linkanim.explain.formula import (
    ONE,
    TWO,
    ZERO,
    Components,
    Formula,
    Symbol,
    arccos,
    cos,
    dot,
    number,
    sin,
    sqrt,
    square,
)
from linkanim.explain.joints import KINDS, Arrows, body_point, half_angle, loops_of
from linkanim.explain.steps import (
    ANGLE,
    HALF,
    LENGTH,
    ORDERS,
    RATIO,
    Chapter,
    Coordinate,
    Order,
    Outcome,
    Powers,
    Rates,
    Scale,
    Step,
    SymbolNames,
    Work,
    decimals,
    joint_title,
    marked,
    names_of,
    rounded,
)
from linkanim.explain.synthesis import synthesis
from linkanim.explain.whole_motion import whole_motion
from linkanim.frozen import frozen
from linkanim.mechanics.forces import effort_token
from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import (
    RRR,
    Body,
    Crank,
    CrankTriangle,
    Cylinder,
    Damper,
    Load,
    Spring,
    Travel,
    holding,
)
from linkanim.mechanics.measures import loaded
from linkanim.mechanics.motion import Mechanism
from linkanim.mechanics.quantities import called, input_symbol, link_labels
from linkanim.picture.figure import figure
from linkanim.scenes.scene import Scene
from linkanim.units import rounded as in_digits
from linkanim.words import said, sentences, to_say

# Where the input is and how it moves: as it was asked for, or from the phase.

_SECOND = to_say("acceleration of the input")
_PI = Formula("leaf", symbol=Symbol("π"), shown="3.14159265359")
_ONCE, _TWICE = Powers(rate=1), Powers(rate=2)


@frozen
class PoseRequest:
    """The pose of a scene to work out: `value` is its "angle" or its "phase", in rad, as `by` says.

    The input has this `speed`, in rad/s, and this `acceleration`, in rad/s², or in the scene's unit of length
    per s² where a slider drives.
    """

    scene: Scene
    by: Literal["angle", "phase"]
    value: float
    speed: float
    acceleration: float = 0.0
    forces: bool = False
    """Whether what each body carries is worked out, too."""
    about: str | None = None
    """The joint about which moments are taken, on bodies that have it; else each one's first."""

    def motion(self) -> Any:
        """Return the pose as the solver gives it."""
        moving = {self.by: self.value, "speed": self.speed, "acceleration": self.acceleration}
        return self.scene.solve(**moving)  # type: ignore[arg-type]

    @property
    def swings(self) -> bool:
        """Whether the pose is asked for by the phase of an input that turns back."""
        return self.by == "phase" and not self.scene.info.full_turn


def place_input(request: PoseRequest, rates: Rates) -> None:
    """Add the lines of the input's place, and put its rates among those known."""
    work = rates.work
    joint = work.linkage.driven.joint
    ends = (joint.pivot, joint.name) if isinstance(joint, Crank) else None
    slid = Symbol("θ", joint.name) if joint.motor else work.names.slide(joint.name)
    symbol = work.angle_symbol(*ends) if ends else slid
    angle = (_swinging if request.swings else _stated)(request, rates, symbol)
    if ends:
        work.angles[ends] = angle
    else:
        work.slides[joint.name] = angle


def _stated(request: PoseRequest, rates: Rates, symbol: Symbol) -> Formula:
    """Return the requested angle, or the angle by the start and the phase."""
    work = rates.work
    rate = work.known(rates.symbol(work.driver, 1), request.speed, _ONCE, said("velocity of the input"))
    second = ZERO
    if request.acceleration:
        second = work.known(rates.symbol(work.driver, 2), request.acceleration, _TWICE, said(_SECOND))
    rates.start(rate, second)
    if request.by == "angle":
        return work.known(symbol, request.value, ANGLE, said("position of the input"))
    phase = work.known(Symbol("φ"), request.value, ANGLE, said("phase"))
    start = work.stated(
        Symbol("θ", "0"), request.scene.linkage.drive.start, ANGLE, said("position of the input at phase 0")
    )
    return work.let(symbol, start + phase, ANGLE)


def _swinging(request: PoseRequest, rates: Rates, symbol: Symbol) -> Formula:
    """Add the law of an input that runs there and back: mid - amp cos φ."""
    work = rates.work
    phase = work.known(Symbol("φ"), request.value, ANGLE, said("phase"))
    pace = work.known(Symbol("φ", mark="˙"), request.speed, _ONCE, said("rate of the phase"))
    if isinstance(request.scene.linkage.drive.actuator, Cylinder | Travel):
        return _stroke(request.scene.mechanism, rates, (phase, pace), symbol)
    low, high = request.scene.info.input_range
    middle = work.known(Symbol("θ", "m"), (low + high) / 2, ANGLE, said("middle of the swing"))
    amplitude = work.known(Symbol("A"), (high - low) / 2, ANGLE, said("half of the swing"))
    angle = work.let(symbol, middle - amplitude * cos(phase), ANGLE)
    reach = work.let(Symbol("a"), amplitude * _PI / number("180", in_degrees=True), RATIO)
    once, twice = _cosine_rates(reach, phase, pace)
    rates.let_rate(work.driver, once, 1)
    rates.let_rate(work.driver, twice, 2)
    return angle


def _cosine_rates(reach: Formula, phase: Formula, pace: Formula) -> tuple[Formula, Formula]:
    """Return the rates of mid - reach·cos φ."""
    return reach * sin(phase) * pace, reach * cos(phase) * square(pace)


def _stroke(mechanism: Mechanism, rates: Rates, phase: tuple[Formula, Formula], symbol: Symbol) -> Formula:
    """Add the travel of a slider or cylinder that drives, and for a cylinder the crank's angle."""
    work, triangle = rates.work, mechanism.triangle
    letter, index = ("ℓ", "") if triangle else (symbol.letter, symbol.sub)
    ends = mechanism.linkage.drive.actuator.stated_lengths
    middle = work.stated(Symbol(letter, "m"), sum(ends) / 2, LENGTH, said("middle of the stroke"))
    reach = work.sided(Symbol("a"), (ends[1] - ends[0]) / 2, *[said("half of the stroke")] * 2)
    slid = work.let(Symbol(letter, index), middle - reach * cos(phase[0]), LENGTH)
    formulas = _cosine_rates(reach, *phase)
    once = work.let(Symbol(letter, index, "˙"), formulas[0], Powers(1, 1))
    twice = work.let(Symbol(letter, index, "¨"), formulas[1], Powers(1, 2))
    if triangle:
        return _cylinder(triangle, rates, (slid, once, twice), symbol)
    rates.start(once, twice)
    return slid


def _cylinder(
    triangle: CrankTriangle, rates: Rates, slid: tuple[Formula, Formula, Formula], symbol: Symbol
) -> Formula:
    """Add the crank's angle and its rates from a cylinder's length."""
    work, between = rates.work, rates.work.linkage.drive.actuator.along
    assert between is not None
    length, once, twice = slid
    pivot = work.linkage.driven.pivot
    g, r = (
        work.known(Symbol(name), side, LENGTH, f"{marked(pivot)}–{marked(end)}")
        for name, side, end in zip("gc", triangle.sides, between, strict=True)
    )
    base = work.known(
        Symbol("θ", "b"), triangle.base, ANGLE, said("the crank's angle at which the three lie in one line")
    )
    work.say(
        said(
            "The ends of the cylinder and the crank's pivot form a triangle; the cosine rule gives the crank:"
        )
    )
    corner = work.let(Symbol("ψ"), arccos((square(g) + square(r) - square(length)) / (TWO * g * r)), ANGLE)
    angle = work.let(symbol, base + corner if triangle.side > 0 else base - corner, ANGLE)
    arm = g * r * sin(corner)
    turning = rates.let_rate(work.driver, (length * once if triangle.side > 0 else -(length * once)) / arm, 1)
    bend = square(once) + length * twice - g * r * cos(corner) * square(turning)
    rates.let_rate(work.driver, (bend if triangle.side > 0 else -bend) / arm, 2)
    return angle


# The loads of a linkage, worked out: centres of mass, springs and dampers, what the input delivers.

FORCES = to_say("Forces")
"""The title of the chapter on what each body carries."""
_WORDS = ("com_position", "com_velocity", "com_acceleration")


def centre_of_mass(body: Body, rates: Rates) -> Iterator[Outcome]:
    """Add where a body's centre of mass is and how it moves, and yield it."""
    assert body.com is not None
    work, on = rates.work, (body.joints[0], body.joints[1])
    name = work.centre(body)
    arm = body_point(work, on, body.com, (Symbol("p", name), Symbol("q", name)))
    work.let_point(name, work.points[on[0]] + arm)
    yield from work.scale.outcomes(f"{body.name}.{_WORDS[0]}", work.points[name], 0)
    for order in ORDERS:
        rates.let_carried(name, on, work.points[name] - work.points[on[0]], order)
        yield from work.scale.outcomes(f"{body.name}.{_WORDS[order]}", rates.of(name, order), order)


def strut(item: Spring | Damper, rates: Rates) -> Iterator[Outcome]:
    """Add the length of a spring or damper, its rate and its force, and yield them."""
    work, (start, end), name = rates.work, item.between, item.name
    span, moving = work.points[end] - work.points[start], rates.of(end, 1) - rates.of(start, 1)
    length = work.let(Symbol("L", name), sqrt(square(span.x) + square(span.y)), LENGTH)
    yield work.scale.outcome(f"{name}.length", length, LENGTH)
    if length.value == 0:
        work.say(said("Its ends coincide here, so its rate does not follow from this."))
        return
    rate = rates.let(Symbol("L", name, "˙"), dot(span, moving) / length, Powers(1, 1))
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
    free = work.stated(Symbol("L", f"{item.name}0"), item.free_length, LENGTH, said("free length"))
    return work.quoted(Symbol("k", item.name), f"{item.stiffness:.12g}", "N/m") * (length - free) * metre


def _metre(rates: Rates) -> Formula:
    """Return one unit of length in metres; say so in the solution once."""
    work = rates.work
    unit, metre = work.scale.unit, work.linkage.metre
    if metre != 1:
        work.say_once(
            said(
                "Forces are in newtons, so lengths are taken in metres: 1 {unit} is {metre} m.",
                unit=unit,
                metre=f"{metre:.12g}",
            )
        )
    return work.metre


def effort(rates: Rates, known: Mapping[str, Formula], motion: Any) -> Iterator[Outcome]:
    """Add the power of all forces and masses and the input's torque or force, and yield the latter.

    `known` are the quantities worked out so far, by their tokens; `motion` is the pose, from which the forces
    of loads are read.
    """
    work, linkage = rates.work, rates.work.linkage
    if not rates.struts.keys() >= set(_forceful(rates)):
        work.say(
            said(
                "The rate of a spring or damper does not follow here, and so neither does the load "
                "on the input."
            )
        )
        return
    work.say(
        said(
            "The input delivers the power of springs, dampers and masses, less that of the loads; divided "
            "by the input's velocity it gives:"
        )
        if linkage.loads
        else said(
            "The input delivers the power of springs, dampers and masses; divided by the input's velocity "
            "it gives:"
        )
    )
    loads = (-_load_power(load, rates, known, motion) for load in linkage.loads)
    powers = [*_strut_powers(rates), *_body_powers(rates, known), *loads]
    total = work.let_plain(Symbol("P"), sum(powers, ZERO), "W")
    name, unit = linkage.drive.actuator.effort
    pace = _pace(rates)
    if pace.value == 0:
        work.say(said("The input is at rest here, so it does not follow from the balance of power."))
        return
    delivered = work.let_plain(Symbol(name[0].upper(), "in"), total / pace, unit)
    yield Outcome(effort_token(linkage), delivered, last=True)


def _pace(rates: Rates) -> Formula:
    """Return the input's rate: an angular velocity in rad/s, or a velocity in m/s."""
    work, drive = rates.work, rates.work.linkage.drive
    if drive.actuator.along:
        span, moving = (
            work.points[drive.actuator.along[1]] - work.points[drive.actuator.along[0]],
            rates.of(drive.actuator.along[1], 1) - rates.of(drive.actuator.along[0], 1),
        )
        length = sqrt(square(span.x) + square(span.y))
        return rates.let(Symbol("ℓ", "", "˙"), dot(span, moving) / length, Powers(1, 1)) * _metre(rates)
    pace = rates.rate(work.driver, 1)
    return pace if work.driver[0] == "θ" else pace * _metre(rates)


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
            at = body.slider or work.centre(body)
            velocity = rates.of(at, 1)
            pull = ZERO if work.linkage.static else dot(rates.of(at, 2), velocity) * square(metre)
            if work.linkage.gravity:
                fall = work.quoted(Symbol("g"), f"{work.linkage.gravity:.12g}", "m/s²")
                pull = pull + fall * velocity.y * metre
            mass = work.quoted(Symbol("m", label), f"{body.mass:.12g}", "kg")
            yield work.let_plain(Symbol("P", label), mass * pull, "W")
        if body.inertia is not None and not work.linkage.static:
            inertia = work.quoted(Symbol("I", label), f"{body.inertia:.12g}", "kg m²")
            turning = known[f"{body.name}.angular_acceleration"] * known[f"{body.name}.angular_velocity"]
            yield work.let_plain(Symbol("P", f"{label}turn"), inertia * turning, "W")


def _load_power(load: Load, rates: Rates, known: Mapping[str, Formula], motion: Any) -> Formula:
    """Add the power of a load, its force being that in this pose."""
    work, body = rates.work, rates.work.linkage.body(load.on)
    arm, force = loaded(motion, load)
    power = ZERO
    if any(force):
        sides = zip("xy", map(float, force), strict=True)
        x, y = (work.quoted(Symbol("F", f"{load.name},{side}"), f"{part:.12g}", "N") for side, part in sides)
        power = dot(Components(x, y), _load_velocity(load, rates, arm)) * _metre(rates)
    turning = known.get(f"{body.name}.angular_velocity")
    if load.torque and turning:
        power = power + work.quoted(Symbol("T", load.name), f"{load.torque:.12g}", "N m") * turning
    return work.let_plain(Symbol("P", load.name), power, "W")


def _load_velocity(load: Load, rates: Rates, arm: Any) -> Components:
    """Return how fast the place of a load moves; a block turns with the line that carries it."""
    work, body = rates.work, rates.work.linkage.body(load.on)
    if load.at is None or body.slider:
        velocity = rates.of(body.slider or load.joint, 1)
        carrier = work.linkage.slides[body.slider].axis if body.slider else None
        if carrier is None or load.at is None:
            return velocity
        sides = (
            work.known(Symbol(letter, load.name), float(part), LENGTH)
            for letter, part in zip("pq", arm, strict=True)
        )
        return velocity + rates.carried(work.frame(carrier), Components(*sides), 1)
    on, name = (body.joints[0], body.joints[1]), load.name
    while name in work.linkage.by_name:
        name = f"L{name}"
    work.let_point(
        name, work.points[on[0]] + body_point(work, on, load.at, (Symbol("p", name), Symbol("q", name)))
    )
    rates.let_carried(name, on, work.points[name] - work.points[on[0]], 1)
    return rates.of(name, 1)


# The worked solution of a pose: its chapters, and the results that they lead to.
#
# It carries the fewest digits with which every result agrees with the solver to five significant digits. A
# zero is shown without digits of rounding, and a force or a torque, from which nothing follows, only in
# digits that are right.

_FEWEST, _MOST = 6, 14
_AGREES = 5e-6
"""The share of itself by which a result may differ from the solver's."""
INPUT_TITLE = to_say("The input")
RESULT_DIGITS = 4
"""Significant digits of a result."""
_LONG = 100.0
"""The factor on the median bar beyond which a longest bar does not set the decimals of lengths."""
_TINY = 1e-300
_PRIMES = to_say(
    "Kinematic coefficients are derivatives with respect to the input: h of a link's "
    "angle, f of a travel, x′ and y′ of a point; the second ones are h′, f′, x″ and y″."
)
_BY_INPUT = to_say(
    "Differentiating a loop gives two linear equations, with a matrix a, its "
    "determinant D and the right-hand sides b; Cramer's rule gives the two unknowns.",
)
_IN_TIME = (
    to_say("By the chain rule, a velocity is the first coefficient times the velocity of the input."),
    to_say(
        "By the chain rule, an acceleration is the second coefficient times the square of the velocity of "
        "the input."
    ),
)
_ACCELERATED = to_say(
    "By the chain rule, an acceleration is the second coefficient times the square of the velocity of the "
    "input, plus the first coefficient times the acceleration of the input."
)
_CARRIED = to_say(
    "The numbers given are exact. Results have four significant digits; the lines before them carry as many "
    "as that takes."
)
_FEWER = to_say(
    "The numbers given are exact. Results have four significant digits, or fewer where they are small beside "
    "others of their kind; the lines before them carry as many as that takes."
)
_AS_INPUT = to_say("The slider is the input itself, so this is given.")
_NO_LOOP = to_say("There is no loop to close: every joint follows directly from the input.")
_TOGETHER = to_say("The loops of links that can only be solved together are not written down here.")
_SINGULAR = to_say(
    "At a limit or a change point the two linear equations of a dyad are not "
    "independent, so no velocities follow from them. Choose a position beside it."
)


@frozen
class Solution:
    """A pose worked out: chapters in reading order, results, and where joints lie (x + yi).

    `arrows` are the vectors of its loops; none where it has no loop.
    """

    request: PoseRequest
    chapters: tuple[Chapter, ...]
    arrows: Arrows
    results: tuple[Outcome, ...]
    places: dict[str, complex]
    singular: bool
    made: bool = False
    """Whether the last chapter says how the linkage was made."""
    bodies: tuple[FreeBody, ...] = ()
    """Each body on which anything acts, free, where forces were asked for."""

    @property
    def loop_chapter(self) -> Chapter:
        """The chapter of the loops, which has the figure."""
        return self.chapters[1]

    @property
    def positions(self) -> Chapter:
        """The chapter of the input and of where each joint is."""
        return self.chapters[2]

    @property
    def synthesis_chapter(self) -> Chapter | None:
        """The chapter on how the linkage was made, which has the figure of its construction."""
        return self.chapters[-1] if self.made else None

    @property
    def phase(self) -> float:
        """The phase of the pose."""
        return float(self.request.motion().phase)

    @property
    def solved(self) -> dict[Symbol, float]:
        """The solver's value for each result, by its symbol; an angle is on the same turn as the result."""
        return {result.value.symbol: true for result, true in _compared(self) if result.value.symbol}

    @property
    def title(self) -> str:
        """The title of the scene."""
        return said(self.request.scene.title)

    def body_title(self, body: FreeBody) -> str:
        """Return what a free body is called."""
        scene = self.request.scene
        own = next((one for one in scene.linkage.bodies if one.name == body.name), None)
        return called(own, scene.info.link_names) if own else said("Bar {name}", name=body.name)

    def joints_of(self, body: FreeBody) -> dict[str, complex]:
        """Return the joints of a free body and where they lie."""
        linkage = self.request.scene.linkage
        own = next((one for one in linkage.bodies if one.name == body.name), None)
        names: Collection[str] = (body.about,)
        if own is not None and own.slider:
            names = (own.slider,)
        else:
            pair = tuple(body.name.split("–")) if own is None else own.joints
            if (own or len(pair) > 1) and (n := holding(linkage.rigid_bodies, pair)):
                names = linkage.rigid_bodies[n]
        return {name: self.places[name] for name in names}

    @property
    def spread(self) -> float:
        """The width or height of the largest free body."""
        each = (np.array([*self.joints_of(body).values()]) for body in self.bodies)
        return max((float(max(np.ptp(places.real), np.ptp(places.imag))) for places in each), default=0.0)

    @property
    def where(self) -> tuple[Symbol | str, str]:
        """The input's name, a symbol where it has an index, and the input's value in words."""
        scene = self.request.scene
        coordinate = float(self.request.motion().coordinate)
        letter, _, index = input_symbol(scene.linkage).partition("_{")
        words = scene.linkage.drive.coordinate.text(coordinate, scene.length_unit, 0.01)
        return Symbol(letter, index[:-1]) if index else letter, words


def solution(request: PoseRequest) -> Solution:
    """Return the worked solution of a pose, which its input must reach.

    It ends with the positions where no rates follow, or none in five digits: at limits and change points.
    """
    names = names_of(figure(request.scene))
    ways = [(digits, rates) for rates in (True, False) for digits in range(_FEWEST, _MOST + 1)]
    for digits, rates in ways:
        # near a limit, rounded digits may give a negative root or a zero divisor: more digits are then taken
        with suppress(ZeroDivisionError, ValueError):
            places: dict[Symbol, int] = {}
            draft = _Draft(request, names, digits, places)
            worked = draft.solution(rates)
            # fewer digits of one number change those that follow from it, which may then need fewer, too
            while _agrees(worked) and not (fewer := _right_places(worked)).items() <= places.items():
                places |= fewer
                draft = _Draft(request, names, digits, places)
                worked = draft.solution(rates)
            if _agrees(worked):
                break
    pose = len(worked.chapters) - worked.made
    whole = whole_motion(request.scene, draft.work)
    given, *others = worked.chapters[:pose]
    given = replace(given, steps=(*given.steps, *_carried(worked)))
    return replace(worked, chapters=(given, *others, *whole, *worked.chapters[pose:]))


def _carried(solution: Solution) -> Iterator[Step]:
    """Yield the sentence on the digits of a solution, where it has rates."""
    if not solution.singular:
        fewer = any(_has_fewer(result.value, true) for result, true in _compared(solution))
        yield Step("", (said(_FEWER if fewer else _CARRIED),))


def _has_fewer(value: Formula, true: float) -> bool:
    """Return whether a result has fewer right digits than it is to have."""
    places = len(value.shown.partition(".")[2])
    coarse = abs(value.value - true) > 10.0 ** (1 - RESULT_DIGITS) * abs(true) / 2
    return value.value != 0 and (coarse or places < decimals(true, RESULT_DIGITS))


def _compared(solution: Solution) -> Iterator[tuple[Outcome, float]]:
    """Yield each result with the solver's value, an angle on the same turn as the result."""
    motion, quantities = solution.request.motion(), solution.request.scene.quantities
    for result in solution.results:
        true, worked_out = float(quantities[result.token].displayed(motion)), result.value.value
        yield (
            result,
            worked_out + math.remainder(true - worked_out, 360) if result.unit == "°" else true,
        )


def _agrees(solution: Solution) -> bool:
    return all(
        abs(result.value.value - true) <= max(_AGREES * abs(true), result.least)
        and _same_digits(result.value, true)
        for result, true in _compared(solution)
    )


def _same_digits(value: Formula, true: float) -> bool:
    """Return whether a value and the solver's are one number in the digits that it is to have."""
    places = decimals(true, RESULT_DIGITS) if math.isfinite(true) else _MOST
    if places > len(value.shown.partition(".")[2]):
        return True
    return abs(float(rounded(value.value, places)) - true) <= HALF * 10.0**-places


def _right_places(solution: Solution) -> dict[Symbol, int]:
    """Return the decimals in which zeros and `last` results are right, by symbol, where more are shown.

    If one zero shows rounding, all zeros get fewer decimals: else those that follow from it would show it
    next.
    """
    zeros: dict[Symbol, int] = {}
    right: dict[Symbol, int] = {}
    rounding = False
    for result, true in _compared(solution):
        value, symbol = result.value.value, result.value.symbol
        shown = len(result.value.shown.partition(".")[2])
        if symbol is None:
            continue
        if float(rounded(true, shown)) == 0:
            zeros[symbol] = min(shown, max(math.floor(-math.log10(2 * max(result.least, _TINY))), 0))
            rounding = rounding or value != 0
        elif result.last:
            right[symbol] = next((n for n in range(shown, 0, -1) if rounded(value, n) == rounded(true, n)), 0)
            if right[symbol] == shown:
                del right[symbol]
    return right | (zeros if rounding else {})


class _Draft:
    """A solution in `digits` digits while it is written; symbols in `places` have fewer decimals."""

    def __init__(
        self, request: PoseRequest, names: SymbolNames, digits: int, places: Mapping[Symbol, int]
    ) -> None:
        self.request, self.motion = request, request.motion()
        self.linkage = request.scene.linkage
        bars = sorted(abs(value) for joint in self.linkage.joints for _, value in joint.bars) or [1.0]
        # a single bar far longer than the others does not reduce their digits
        length = min(bars[-1], _LONG * bars[len(bars) // 2]) or bars[-1]
        angular = self.linkage.drive.coordinate.is_angle
        rate, second = abs(float(self.motion.coordinate_rate)), abs(float(self.motion.coordinate_second))
        pace = max(rate, math.sqrt(second))
        rate = pace if angular else pace / length
        scale = Scale(digits, request.scene.length_unit, length, rate if 0 < rate < math.inf else 1.0)
        self.work = Work(self.linkage, names, self.motion, scale, places)
        rate, per = (1.0, "") if angular else (1.0 / length, scale.unit)
        by = Scale(digits, scale.unit, length, rate, per)
        self.slopes = Rates(self.work, by)
        self.rates = Rates(self.work, scale, self.slopes)
        self.results: list[Outcome] = []
        self.looped = False
        self.steps: list[Step] = []
        self.bodies: tuple[FreeBody, ...] = ()

    def solution(self, rates: bool) -> Solution:
        """Return the solution, with velocities and accelerations if `rates`."""
        places = self._placed()
        loops, arrows = loops_of(self.work, places)
        self.looped = bool(loops)
        halves = self._half_angles()
        self.work.items.clear()
        if rates:
            by_input = self._by_input()
            rest = [*by_input, *self._in_time(has_coefficients=bool(by_input)), *self._parts()]
        else:
            rest = [Chapter(said("Velocities and accelerations"), (Step("", (said(_SINGULAR),)),))]
        given = Chapter(said("Given"), (Step("", tuple(self.work.given.values())),))
        without = _NO_LOOP if group_of(self.linkage) is None else _TOGETHER
        steps = tuple(loops) or (Step("", (said(without),)),)
        made = synthesis(self.request.scene, self.work.names)
        chapters = (given, Chapter(said("Vector loops"), steps), places, *halves, *rest, *made)
        known = self.request.scene.quantities
        # where two parts have one name the last has the token, as it has among the quantities
        results = tuple({one.token: one for one in self.results if one.token in known}.values())
        at = {joint.name: self.work.place(joint.name) for joint in self.linkage.joints}
        return Solution(self.request, chapters, arrows, results, at, not rates, bool(made), self.bodies)

    def _step(self, title: str, write: Callable[[], object]) -> None:
        """Add a step with the lines that `write` adds; no step where it adds none."""
        step = self.work.step(title, write)
        self.steps += [step] if step.items else []

    def _chapter(self, title: str) -> list[Chapter]:
        """Return a chapter of the steps since the last one, if there are any."""
        steps, self.steps = tuple(self.steps), []
        return [Chapter(title, steps)] if steps else []

    def _placed(self) -> Chapter:
        """Return the chapter of positions."""
        scale = self.work.scale
        self._step(said(INPUT_TITLE), partial(place_input, self.request, self.rates))
        for joint in self.linkage.joints:
            self._step(joint_title(joint.name), partial(KINDS[type(joint)].place, joint, self.work))
            self.results += scale.outcomes(f"{joint.name}.position", self.work.points[joint.name], 0)
        self._step(said("Angles of the links"), self._angles)
        for body in self.linkage.bodies:
            if body.slider in self.work.slides:
                travel = self.work.slides[body.slider]
                self.results.append(scale.outcome(f"{body.name}.travel", travel, LENGTH))
        return self._chapter(said("Positions"))[0]

    def _half_angles(self) -> list[Chapter]:
        """Return the chapter on the half-angle form of two bars, which many books have."""
        for joint in self.linkage.joints:
            if isinstance(joint, RRR):
                self._step(joint_title(joint.name), partial(half_angle, joint, self.work))
        return self._chapter(said("The same by the half-angle form"))

    def _angles(self) -> None:
        for body in self._turning():
            angle = self.work.angle_of(body.joints[0], body.joints[1])
            self.results.append(self.work.scale.outcome(f"{body.name}.angle", angle, ANGLE))

    def _turning(self) -> Iterator[Body]:
        return (body for body in self.linkage.bodies if body.slider is None)

    def _by_input(self) -> list[Chapter]:
        """Return the chapter of kinematic coefficients; none where nothing but a driven slider moves."""
        self.slopes.start(ONE)
        derived = said(_BY_INPUT) if self.looped else ""
        self._step("", partial(self.work.say, sentences(said(_PRIMES), derived)))
        begun = len(self.steps)
        for order, token in zip(ORDERS, ("", "second_"), strict=True):
            self._moved(self.slopes, order, order)
            self._tell_links(self.slopes, order, f"{token}coefficient", f"{token}coefficient")
        if len(self.steps) == begun:
            self.steps.clear()
        return self._chapter(said("Kinematic coefficients"))

    def _in_time(self, *, has_coefficients: bool) -> Iterator[Chapter]:
        """Yield the chapters of velocities and accelerations, by the chain rule if there are coefficients."""
        titles = {"velocity": to_say("Velocities"), "acceleration": to_say("Accelerations")}
        steady = not (self.request.acceleration or self.request.swings)
        laws = (_IN_TIME[0], _IN_TIME[1] if steady else _ACCELERATED)
        for order, (word, title), text in zip(ORDERS, titles.items(), laws, strict=True):
            self._step("", partial(self.work.say, said(text if has_coefficients else _AS_INPUT)))
            self._moved(self.rates, order)
            for joint in self.linkage.joints:
                moving = self.rates.of(joint.name, order)
                self.results += self.rates.scale.outcomes(f"{joint.name}.{word}", moving, order)
            self._tell_links(self.rates, order, f"angular_{word}", f"travel_{word}")
            self._step(said("Sizes"), partial(self._sizes, order, word))
            if self.looped:
                check = said(
                    "Check: inserted in the differentiated loops, these values leave a residual of at most "
                    "{most}.",
                    most=self._residual_words(order),
                )
                self._step("", partial(self.work.say, check))
            yield from self._chapter(said(title))

    def _sizes(self, order: Order, word: str) -> None:
        """Add the sizes of the joints' velocities, or accelerations."""
        for joint in self.linkage.joints:
            moving = self.rates.of(joint.name, order)
            if moving.x.value or moving.y.value:
                formula = sqrt(square(moving.x) + square(moving.y))
                size = self.rates.let(Symbol("va"[order - 1], joint.name), formula, Powers(1, order))
                self.results.append(self.rates.scale.outcome(f"{joint.name}.{word}", size, Powers(1, order)))

    def _residual_words(self, order: Order) -> str:
        """Return words for the largest residual of the differentiated loops at the rates of an order."""
        residual, self.rates.residual = self.rates.residual, 0.0
        return f"{in_digits(residual, 2)} {self.rates.scale.unit_of(Powers(1, order))}"

    def _moved(self, rates: Rates, order: Order, coefficients: Literal[0, 1, 2] = 0) -> None:
        """Add a step for each joint that moves; its title may say which coefficients it is on."""
        for joint in self.linkage.joints:
            title = joint_title(joint.name, coefficients)
            self._step(title, partial(KINDS[type(joint)].move, joint, rates, order))

    def _tell_links(self, rates: Rates, order: Order, turning: str, sliding: str) -> None:
        for body in self.linkage.bodies:
            coordinate: Coordinate = (
                ("s", body.slider)
                if body.slider
                else ("θ", self.work.frame((body.joints[0], body.joints[1])))
            )
            if coordinate in rates.known:
                token = f"{body.name}.{sliding if body.slider else turning}"
                measure = Powers(int(body.slider is not None), order)
                self.results.append(rates.scale.outcome(token, rates.rate(coordinate, order), measure))

    def _parts(self) -> Iterator[Chapter]:
        """Yield the chapters of centres of mass, springs and dampers, and of the input's torque or force."""
        for body in self._turning():
            if body.com is not None:
                self._step_with_results(
                    called(body, self.request.scene.info.link_names), centre_of_mass(body, self.rates)
                )
        yield from self._chapter(said("Centres of mass"))
        for item in self.linkage.springs + self.linkage.dampers:
            self._step_with_results(self.linkage.strut_title(item), strut(item, self.rates))
        yield from self._chapter(said("Springs and dampers"))
        if self.linkage.forceful:
            known = {result.token: result.value for result in self.results}
            self._step_with_results("", effort(self.rates, known, self.request.motion()))
            yield from self._chapter(said("Load on the input"))
            if self.request.forces:
                yield from self._forces(known)

    def _forces(self, known: Mapping[str, Formula]) -> Iterator[Chapter]:
        """Yield the chapter of what each body carries; BadInput for links that are solved together."""
        if any(joint.grouped for joint in self.linkage.joints):
            raise BadInput(
                "forces in joints of links that are solved together are not derived line by line;"
                " `linkanim solve` and `linkanim chart` have them"
            )
        balance = Balance(self.rates, known, self.motion, self.request.about)
        steps = forces(balance)
        self.results += balance.results
        self.bodies = tuple(
            body for member, body in balance.bodies.items() if member and (body.forces or body.couples)
        )
        yield Chapter(said(FORCES), steps)

    def _step_with_results(self, title: str, outcomes: Iterable[Outcome]) -> None:
        """Add a step with its results."""
        self._step(title, lambda: self.results.extend(outcomes))
