"""What holds each body: the forces that meet in its joints, those of guides and gears, and the ground's.

Every joint was closed from joints before it, so its forces follow from those behind it: joints are taken in
the reverse order, and each gives two or three equations of balance in as many unknowns, which are solved in
closed form. Inertia counts as a force, -m a and -I α (d'Alembert). With the arms b₁ and b₂ of two bars that
meet in B, from their far ends, the moments M₁ and M₂ there of all else that acts on them, and the force Q on
the pin in B,

    b₁ × F₁ = -M₁     b₂ × F₂ = -M₂     F₁ + F₂ = Q

so F₁ is a quotient over b₁ × b₂, which vanishes where the bars lie in one line; a bar to a slider and a slot
have such a divisor, too. Its root has a sign and all its digits (`solver.signed_root`), so forces have theirs
up to dead centres and limits of the input, where they grow without bound (Uicker, Pennock and Shigley, Theory
of Machines and Mechanisms, on static and dynamic force analysis).

Links that can only be solved together have one system of all their balances, which is solved in floats: it
has no divisor that is known beforehand, and so near a limit of the input its forces lose digits as they grow.

Springs, dampers and loads in a joint pull at its pin, not at one of the bodies that meet there: the forces of
the pin on all of them are together what pulls at it. There is no friction.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Mapping
from functools import lru_cache, reduce
from typing import Any, NamedTuple

import numpy as np

from linkanim.errors import BadInput
from linkanim.mechanics.forces import idle, interpolated, near_ends
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Body,
    Brace,
    Crank,
    Damper,
    DrivenSlider,
    Joint,
    Line,
    Linkage,
    Load,
    Rigid,
    Spring,
    coincide,
    holding,
)
from linkanim.mechanics.measures import (
    Vector,
    between,
    cleaned,
    components,
    cross,
    dot,
    force_rounding,
    line_direction,
    loaded,
    near,
    over,
    rounding_of,
    size,
    turned,
)
from linkanim.mechanics.precise import direction
from linkanim.mechanics.program import Array, keep_memory
from linkanim.mechanics.tolerances import IDLE, NO_LEVER, ROUNDING

GROUND = "ground"

Member = int | str
"""A body: its place among the rigid bodies, the ground being 0; of a block the joint it slides with."""


class GuideForces(NamedTuple):
    """What a guide does to what slides on it: a force to the left of the line's direction, and a moment.

    The force (N) acts in the sliding joint, about which the moment (N m) is taken.
    """

    force: Any
    moment: Any


class GearForces(NamedTuple):
    """What the teeth do to a geared crank's wheel, in N: along the pitch circles, and apart.

    `tangential` is positive where it turns the wheel counter-clockwise. Both are None where no two wheels
    mesh: of a belt, and of cranks about one pivot; `moment` (N m) is what turns the crank.
    """

    tangential: Any
    radial: Any
    moment: Any


class Reactions(NamedTuple):
    """All forces at an instant, or at many: on the body that is named, in newtons and newton metres.

    `joints` has for each joint in which several bodies meet the force on each of them (x, y); `guides` by
    sliding body; `gears` by crank. `ground` is the sum of all that acts on the ground, the shaking force, and
    `moment` its moment about the origin. `effort` is the input's, as it follows from its joints
    (`forces.input_effort` has it from the balance of power, which keeps its digits at change points, too).
    Infinite where it is unbounded, NaN where there is no value.
    """

    joints: Mapping[str, Mapping[str, Vector]]
    guides: Mapping[str, GuideForces]
    gears: Mapping[str, GearForces]
    ground: Vector
    moment: Any
    effort: Any


# Which bodies there are, and what each is called.


class Members(NamedTuple):
    """The bodies of a linkage: by joint those that its definition makes, or has it on; and their names.

    What a joint's definition makes are the bodies of its bars, then its block.
    """

    of: Mapping[str, tuple[Member, ...]]
    names: Mapping[Member, str]


def member_with(linkage: Linkage, joints: tuple[str, ...]) -> Member:
    """Return which body has these joints: a block has one; none show the ground."""
    return joints[0] if len(joints) == 1 else holding(linkage.rigid_bodies, joints) or 0


def member_of(linkage: Linkage, body: Body) -> Member:
    """Return which body a named one is."""
    return member_with(linkage, linkage.joint(body.slider).block if body.slider else body.joints)


@lru_cache(maxsize=16)
def members(linkage: Linkage) -> Members:
    """Return the bodies of a linkage; one without a name is called by its joints."""
    of, names, count = dict[str, tuple[Member, ...]](), dict[Member, str]({0: GROUND}), 1
    for joint in linkage.joints:
        if joint.fixed or isinstance(joint, Rigid):
            of[joint.name] = (holding(linkage.rigid_bodies, joint.needs) or 0,)
            continue
        made, blocks = joint.made
        own = dict[Member, str](enumerate(made, count))
        for block, name in blocks.items():
            own[block] = name
        count += len(made)
        of[joint.name] = tuple(own)
        names |= own
    for body in reversed(linkage.bodies):
        if member := member_of(linkage, body):
            names[member] = body.name
    return Members(of, names)


def named_at(linkage: Linkage, member: Member, joint: str) -> str:
    """Return what a body is called at a joint: of several named ones that are one, the one with the joint."""
    own = (body for body in linkage.bodies if joint in body.joints and member_of(linkage, body) == member)
    name = next(own, None)
    return name.name if name and member else members(linkage).names[member]


def meeting(linkage: Linkage) -> Mapping[str, tuple[str, ...]]:
    """Return the names of the bodies in each joint in which several meet, and in a cylinder's ends."""
    several: dict[str, list[Member]] = {
        name: [n for n, frame in enumerate(linkage.rigid_bodies) if name in frame] for name in linkage.by_name
    }
    for joint in linkage.joints:
        if joint.travels and len(joint.block) == 1:
            several[joint.name].append(joint.name)
        for name, of in joint.slotted:
            several[name].append(member_with(linkage, of))
    ends = linkage.drive.actuator.along or ()
    return {
        name: tuple(named_at(linkage, member, name) for member in several[name])
        for name in linkage.by_name
        if len(several[name]) > 1 or name in ends
    }


def guided(linkage: Linkage) -> tuple[str, ...]:
    """Return the names of what slides along a line, in the order of the joints."""
    names = members(linkage).names
    return tuple(names[member_with(linkage, one.block)] for one in linkage.joints if one.travels)


def meshing(linkage: Linkage) -> Mapping[str, bool]:
    """Return the geared cranks, and whether teeth turn them, not a belt."""
    geared = (crank for crank in linkage.cranks if crank.gear is not None)
    return {crank.name: contact(linkage, crank)[0] is not None for crank in geared}


# The forces, joint by joint from the last to the first.
#
# Lengths are in the scene's unit, and moments in newtons times that, until they are told.


def plus(vector: Vector, other: Vector) -> Vector:
    """Return the sum of two vectors."""
    return vector[0] + other[0], vector[1] + other[1]


def minus(vector: Vector, other: Vector) -> Vector:
    """Return the difference of two vectors."""
    return vector[0] - other[0], vector[1] - other[1]


def times(vector: Vector, factor: Any) -> Vector:
    """Return a vector times a number."""
    return vector[0] * factor, vector[1] * factor


def turned_left(vector: Vector) -> Vector:
    """Return a vector turned by a right angle, counter-clockwise."""
    return -vector[1], vector[0]


class ForceBalance:
    """What acts on each body and pin so far; the joints' own kinds add what follows."""

    def __init__(self, motion: Any) -> None:
        self.motion, self.linkage = motion, motion.mechanism.linkage
        self.members = members(self.linkage)
        self.places = near(motion.position)
        self.forces: dict[Member, list[tuple[Vector, Vector]]] = defaultdict(list)
        """Places and forces on each body."""
        self.couples: dict[Member, Any] = defaultdict(float)
        self.pins: dict[str, Vector] = defaultdict(lambda: (0.0, 0.0))
        """What pulls at each pin."""
        self.joints: dict[str, dict[Member, Vector]] = defaultdict(dict)
        self.guides: dict[str, tuple[Any, Any]] = {}
        self.gears: dict[str, tuple[Any, Any, Any]] = {}
        self.effort: Any = 0.0
        self.shaking: tuple[Any, Any, Any] = (0.0, 0.0, 0.0)
        """The force on the ground, and its moment about the origin."""
        self.noise: Any = 0.0
        """How large the rounding errors of forces may be (N)."""
        self.idle: Any = False
        """Where a lever and the moment over it vanish together."""
        self.nowhere: Any = False
        """Where a force has no direction: of a spring or damper of no length."""

    def place(self, joint: str) -> Vector:
        """Return where a joint is."""
        return components(self.places[joint])

    def apply(self, member: Member, place: Vector, force: Vector) -> None:
        """Add a force on a body."""
        self.forces[member].append((place, force))

    def meet(self, joint: str, member: Member, force: Vector) -> None:
        """Add the force of a pin on a body, which pushes back."""
        known = self.joints[joint].get(member)
        self.joints[joint][member] = plus(known, force) if known else force
        self.pins[joint] = minus(self.pins[joint], force)
        self.apply(member, self.place(joint), force)

    def total(self, member: Member) -> Vector:
        """Return the sum of the forces on a body."""
        x: Any = 0.0
        y: Any = 0.0
        for _, (u, v) in self.forces[member]:
            x, y = x + u, y + v
        return x, y

    def moment(self, member: Member, about: Vector) -> Any:
        """Return the moment of all that acts on a body."""
        terms = (cross(minus(place, about), force) for place, force in self.forces[member])
        return sum(terms, self.couples[member])

    def hang(self, member: Member, joint: str) -> None:
        """Let a body be held by a pin against all else that acts on it."""
        x, y = self.total(member)
        self.meet(joint, member, (-x, -y))

    def shake(self) -> None:
        """Note what all weights, loads and inertia do to the ground, which they reach without loss."""
        known, (x, y) = list(self.forces), self.linkage.origin
        force: Vector = (0.0, 0.0)
        for member in known:
            force = plus(force, self.total(member))
        self.shaking = *force, sum((self.moment(one, (-x, -y)) for one in {*known, *self.couples}), 0.0)

    def along(self, line: Line) -> tuple[Vector, Member]:
        """Return the direction of a line of travel, of length 1, and the body that carries it."""
        carrier = holding(self.linkage.rigid_bodies, line.body) if line.on else 0
        assert carrier is not None
        return line_direction(self.motion, line), carrier

    def guide(self, name: str, line: Line) -> None:
        """Let a block be held by its guide against all that acts on it across the line."""
        u, carrier = self.along(line)
        place, normal = self.place(name), turned_left(u)
        force, moment = -dot(self.total(name), normal), -self.moment(name, place)
        self.guides[name] = force, moment
        self.apply(carrier, place, times(normal, -force))
        self.couples[carrier] = self.couples[carrier] - moment

    def quotient(self, moments: Vector, lever: Any, lengths: tuple[float, ...]) -> Vector:
        """Return moments over a lever; where there is none, and no moments either, it is noted as `idle`."""
        if np.any(gone := np.equal(lever, 0.0)):
            least = np.where(np.isfinite(self.noise), IDLE * self.noise * math.prod(lengths), 0.0)
            self.idle = self.idle | (gone & (size(moments) <= least))
        return over(moments[0], lever), over(moments[1], lever)

    def lever(self, joint: Joint) -> Any:
        """Return the lever of a dyad's reactions; 0 where it vanishes to the last digits of a phase."""
        lever, least = self.motion.lever[joint.name], NO_LEVER * max(length for _, length in joint.bars)
        return np.where(np.abs(lever) <= least, 0.0, lever)[()]


def _bars(joint: RRR, balance: ForceBalance) -> None:
    (one, other), pull = balance.members.of[joint.name], balance.pins[joint.name]
    (first, last), place = joint.ends, balance.place(joint.name)
    b1, b2 = (minus(place, balance.place(end)) for end in joint.ends)
    m1 = balance.moment(one, balance.place(first))
    m2 = balance.moment(other, balance.place(last)) + cross(b2, pull)
    area = balance.lever(joint) * joint.lengths[1]
    force = balance.quotient(plus(times(b2, -m1), times(b1, -m2)), area, joint.lengths)
    balance.meet(joint.name, one, force)
    balance.meet(joint.name, other, minus(pull, force))
    balance.hang(one, first)
    balance.hang(other, last)


def _bar_to_slider(joint: RRP, balance: ForceBalance) -> None:
    bar, block = balance.members.of[joint.name]
    (u, _), pull = balance.along(joint.line), balance.pins[joint.name]
    arm = minus(balance.place(joint.name), balance.place(joint.end))
    along = dot(plus(pull, balance.total(block)), u)
    moment = -balance.moment(bar, balance.place(joint.end)) - along * cross(arm, u)
    across, _ = balance.quotient((moment, 0.0), balance.lever(joint), (joint.length,))
    force = plus(times(u, along), times(turned_left(u), across))
    balance.meet(joint.name, bar, force)
    balance.meet(joint.name, block, minus(pull, force))
    balance.guide(joint.name, joint.line)
    balance.hang(bar, joint.end)


def _slot(joint: RPR, balance: ForceBalance) -> None:
    (bar,) = balance.members.of[joint.name]
    balance.meet(joint.name, bar, balance.pins[joint.name])
    u = times(between(balance.motion.position, (joint.pivot, joint.name)), 1.0 / joint.length)
    moment = -balance.moment(bar, balance.place(joint.pivot))
    push, _ = balance.quotient((moment, 0.0), balance.lever(joint), (joint.length,))
    balance.meet(joint.through, bar, times(turned_left(u), push))
    balance.hang(bar, joint.pivot)


def _yoke(joint: RPP, balance: ForceBalance) -> None:
    (block,) = balance.members.of[joint.name]
    balance.meet(joint.name, block, balance.pins[joint.name])
    (u, _), (cosine, sine) = balance.along(joint.line), map(float, direction(joint.slot))
    push = dot(balance.total(block), u) / sine
    balance.meet(joint.pin, block, times(turned((-sine, cosine), u), push))
    balance.guide(joint.name, joint.line)


def _crank(joint: Crank, balance: ForceBalance) -> None:
    (bar,) = balance.members.of[joint.name]
    balance.meet(joint.name, bar, balance.pins[joint.name])
    pivot = balance.place(joint.pivot)
    moment = -balance.moment(bar, pivot)
    ends = balance.linkage.drive.actuator.along
    if joint.gear is not None:
        _mesh(joint, moment, balance)
    elif ends is None:
        balance.effort = moment
        balance.couples[0] = balance.couples[0] - moment
    else:
        fixed, moving = ends
        apart = between(balance.motion.position, ends)
        u = tuple(over(part, size(apart)) for part in apart)
        balance.effort = over(moment, cross(minus(balance.place(moving), pivot), u))
        balance.meet(moving, bar, times(u, balance.effort))
        balance.pins[fixed] = minus(balance.pins[fixed], times(u, balance.effort))
    balance.hang(bar, joint.pivot)


def _driven_slider(joint: DrivenSlider, balance: ForceBalance) -> None:
    (block,) = balance.members.of[joint.name]
    balance.meet(joint.name, block, balance.pins[joint.name])
    u, _ = balance.along(joint.line)
    balance.effort = -dot(balance.total(block), u)
    balance.apply(block, balance.place(joint.name), times(u, balance.effort))
    balance.apply(0, balance.place(joint.name), times(u, -balance.effort))
    balance.guide(joint.name, joint.line)


def _point(joint: Rigid, balance: ForceBalance) -> None:
    (body,) = balance.members.of[joint.name]
    balance.meet(joint.name, body, balance.pins[joint.name])


def _mesh(joint: Crank, moment: Any, balance: ForceBalance) -> None:
    """Let a geared crank be turned by its mate's teeth, or as by a belt."""
    gear, linkage = joint.gear, balance.linkage
    assert gear is not None
    (bar,), (other,) = balance.members.of[joint.name], balance.members.of[gear.mate]
    centre, own, ratio = linkage.crank(gear.mate).pivot, balance.place(joint.pivot), float(gear.ratio)
    share, still = contact(linkage, joint)
    if share is None:
        balance.couples[bar] = balance.couples[bar] + moment
        balance.couples[other] = balance.couples[other] - moment * ratio
        balance.couples[0] = balance.couples[0] - moment * (1.0 - ratio)
        balance.gears[joint.name] = None, None, moment
        return
    line = minus(own, balance.place(centre))
    distance = size(line)
    u = times(line, 1.0 / distance)
    tangential = over(moment, distance * (share - 1.0))
    radial = abs(tangential) * math.tan(gear.pressure_angle)
    force = plus(times(turned_left(u), tangential), times(u, radial if share < 1.0 else -radial))
    place = plus(own, times(line, share - 1.0))
    balance.apply(bar, place, force)
    balance.apply(0 if still else other, place, times(force, -1.0))
    balance.gears[joint.name] = tangential if share > 1.0 else -tangential, radial, moment


def contact(linkage: Linkage, joint: Crank) -> tuple[float | None, bool]:
    """Return where two wheels touch, as a share of the way from the mate's pivot to the crank's own.

    Then whether the crank's wheel rolls on one that stands still. No share where no wheels mesh.
    """
    gear = joint.gear
    assert gear is not None
    mate, ratio = linkage.crank(gear.mate), float(gear.ratio)
    if not linkage.joint(mate.pivot).fixed:
        return None, False
    if joint.pivot == mate.name:
        return (1.0 - 1.0 / ratio, True) if ratio < 0 or ratio > 1 else (None, True)
    pivots = linkage.rigid_bodies[0]
    apart = joint.pivot in pivots and not coincide(pivots, joint.pivot, mate.pivot)
    return (ratio / (ratio - 1.0), False) if apart and ratio < 0 else (None, False)


def _together(point: Any, balance: ForceBalance) -> None:
    """Let the links of a group hold each other, with its last joint."""
    if point.name == point.group.points[-1]:
        point.group.hold(balance)


_KINDS: Mapping[type[Joint], Callable[[Any, ForceBalance], None]] = {
    RRR: _bars,
    RRP: _bar_to_slider,
    RPR: _slot,
    RPP: _yoke,
    Crank: _crank,
    DrivenSlider: _driven_slider,
    Rigid: _point,
    Brace: _point,
}


def _balanced(motion: Any) -> ForceBalance:
    """Return the balance of a motion after all joints."""
    balance = ForceBalance(motion)
    for strut in (*balance.linkage.springs, *balance.linkage.dampers):
        _pull(strut, balance)
    for body in balance.linkage.bodies:
        _weigh(body, balance)
    for load in balance.linkage.loads:
        _press(load, balance)
    balance.shake()
    for joint in reversed(balance.linkage.joints):
        if not joint.fixed:
            _KINDS.get(type(joint), _together)(joint, balance)
    for joint in balance.linkage.joints:
        if joint.fixed:
            balance.meet(joint.name, 0, balance.pins[joint.name])
    return balance


def _pull(strut: Spring | Damper, balance: ForceBalance) -> None:
    """Let a spring or damper pull at the pins at its ends."""
    motion = balance.motion
    rigid = holding(balance.linkage.rigid_bodies, strut.between) is not None
    if not strut.forceful or (rigid and isinstance(strut, Damper)):
        return
    known = (motion.spring if isinstance(strut, Spring) else motion.damper)[strut.name]
    apart = between(motion.position, strut.between)
    if isinstance(strut, Spring) and not strut.free_length:
        share = (strut.stiffness or 0.0) * balance.linkage.metre
    else:
        share = over(known.force, known.length)
        balance.nowhere = balance.nowhere | (np.equal(known.length, 0.0) & np.not_equal(known.force, 0.0))
    pull = times(apart, share)
    first, last = strut.between
    balance.pins[first] = plus(balance.pins[first], pull)
    balance.pins[last] = minus(balance.pins[last], pull)
    balance.noise = balance.noise + ROUNDING * abs(known.force) + force_rounding(motion, strut)


def _weigh(body: Body, balance: ForceBalance) -> None:
    """Let a body's weight and its inertia act on it."""
    motion, linkage = balance.motion, balance.linkage
    member = member_of(linkage, body)
    moves = 0.0 if linkage.static else 1.0
    if not member:
        return
    if body.mass is not None:
        x, y = (0.0, 0.0)
        prefix, name = ("", body.slider) if body.slider is not None else ("com_", body.name)
        if moves:
            x, y = components(getattr(motion, f"{prefix}acceleration")[name])
        down = y * linkage.metre + linkage.gravity
        place = components(near(getattr(motion, f"{prefix}position"))[name])
        balance.apply(member, place, (-body.mass * linkage.metre * x, -body.mass * down))
        jolt = moves * rounding_of(motion, "{}/s²", 2) * linkage.metre
        balance.noise = balance.noise + body.mass * (ROUNDING * (size((x * linkage.metre, down))) + jolt)
    if body.inertia is not None and moves:
        turning = body.inertia * motion.angular_acceleration[body.name] / linkage.metre
        balance.couples[member] = balance.couples[member] - turning
        jerk = body.inertia / linkage.metre * rounding_of(motion, "rad/s²", 2)
        balance.noise = balance.noise + (ROUNDING * abs(turning) + jerk) / linkage.longest


def _press(load: Load, balance: ForceBalance) -> None:
    """Let a load act on its body."""
    body = balance.linkage.body(load.on)
    member = member_of(balance.linkage, body)
    arm, force = loaded(balance.motion, load)
    balance.apply(member, plus(balance.place(body.slider or body.joints[0]), arm), force)
    balance.couples[member] = balance.couples[member] + load.torque / balance.linkage.metre
    torque = abs(load.torque) / (balance.linkage.metre * balance.linkage.longest)
    balance.noise = balance.noise + ROUNDING * (size(force) + torque)


# What is told of them.


def reactions(motion: Any) -> Reactions:
    """Return all reactions of a motion, or of a pose; with masses its second derivatives are needed.

    Where a lever and the moment over it vanish together, forces are those beside, interpolated.
    """
    if not all(joint.reacts for joint in motion.mechanism.linkage.joints):
        raise BadInput(
            "forces of a block on two lines, or of a slot on a link of one point, are not worked out; what"
            " the input delivers is"
        )
    keep_memory()
    with np.errstate(all="ignore"):
        return _reactions(motion)


def _reactions(motion: Any) -> Reactions:
    balance = _balanced(motion)
    unknowns = _listed(balance)
    ends = np.asarray(near_ends(motion)) if motion.acceleration else np.asarray(False)
    free = np.broadcast_to(idle(motion, ends) | balance.idle, unknowns[0].shape)
    if np.any(free):
        unknowns = [np.array(row) for row in unknowns]
        for row, known in zip(unknowns, interpolated(motion, free, _stacked), strict=True):
            row[free] = known
    return _as_reactions(balance, unknowns)


def _stacked(motion: Any) -> Array:
    return np.stack(_listed(_balanced(motion)))


def _listed(balance: ForceBalance) -> list[Array]:
    """Return all numbers that are told, as computed: an array of each, to be read."""
    told = [part for forces in balance.joints.values() for force in forces.values() for part in force]
    told += [part for guide in balance.guides.values() for part in guide]
    told += [part for gear in balance.gears.values() for part in gear if part is not None]
    told += [*balance.shaking, balance.effort]
    shape = np.shape(balance.motion.phase)
    return [np.broadcast_to(part, shape) for part in told]


def _reach(linkage: Linkage) -> float:
    """Return how far from the origin forces may act on the ground."""
    return linkage.longest + max((math.hypot(*pin.position) for pin in linkage.pins), default=0.0)


def _as_reactions(balance: ForceBalance, unknowns: list[Array]) -> Reactions:
    """Return the numbers in their places: 0 for rounding errors, infinite where they are unbounded."""
    linkage, metre, phase = balance.linkage, balance.linkage.metre, np.asarray(balance.motion.phase)
    nowhere = np.isnan(phase) | balance.nowhere
    # row by row: a temporary array of all rows would be fresh memory at every call
    largest = reduce(np.maximum, map(np.abs, unknowns))
    whole = bool((np.isfinite(largest) & ~nowhere).all())
    if not whole:
        largest = reduce(np.maximum, (np.where(np.isfinite(row), np.abs(row), 0.0) for row in unknowns))
    own = np.where(np.isfinite(balance.noise), balance.noise, 0.0)
    noise = np.maximum(own, ROUNDING * largest)

    def without_rounding(number: Any, least: Any) -> Any:
        if not whole:
            number = np.where(nowhere, np.nan, np.where(np.isnan(number), np.inf, number))
        value = cleaned(number, least)
        return value if np.ndim(value) else float(value)

    def force(least: Any = noise) -> Any:
        return without_rounding(next(numbers), least)

    def moment(least: Any = noise) -> Any:
        return without_rounding(next(numbers) * metre, least * (linkage.longest * metre))

    numbers = iter(unknowns)
    joints = {
        joint: {member: (force(), force()) for member in forces} for joint, forces in balance.joints.items()
    }
    guides = {name: GuideForces(force(), moment()) for name in balance.guides}
    gears = {
        name: GearForces(
            None if tangential is None else force(), None if radial is None else force(), moment()
        )
        for name, (tangential, radial, _) in balance.gears.items()
    }
    ends = linkage.drive.actuator.along or ()
    return Reactions(
        {
            joint: {named_at(linkage, member, joint): force for member, force in joints[joint].items()}
            for joint in linkage.by_name
            if len(joints[joint]) > 1 or joint in ends
        },
        {
            balance.members.names[member_with(linkage, linkage.joint(name).block)]: guide
            for name, guide in guides.items()
        },
        gears,
        (force(own), force(own)),
        without_rounding(next(numbers) * metre, own * (_reach(linkage) * metre)),
        moment() if linkage.drive.actuator.effort[0] == "torque" else force(),
    )
