"""One walk over a linkage: every joint, body and centre of mass, with first and second derivatives.

Each joint is closed from the joints before it. What turns as one piece is a `Group`: a bar, the
points fixed to it, and how fast it turns.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from linkanim.errors import AssemblyError

from .assembly import Gearing, Loop, Path, gearings
from .chain import LimitFit, Margin, Touches, limited_root
from .clock import Clock, Half, by_angle
from .closures import (
    PinLoop,
    meet,
    moving_factors,
    moving_square,
    moving_triangle,
    pin_triangle,
    slot_direction,
    slot_turning,
)
from .exact import unit
from .expression import Value, sqrt
from .linkage import RPR, RRP, RRR, Body, Crank, Linkage, Pin, Rigid
from .planar import Moving, MovingPoint, Slope, Turning, Vec, carried
from .signed import SignedRoot, plain_root


@dataclass(frozen=True)
class Plan:
    """What a walk follows: the linkage, its loops, the closures' signs, the input's path."""

    linkage: Linkage
    loops: Mapping[str, Loop]
    signs: Mapping[str, int]
    path: Path
    fits: Mapping[str, LimitFit] = field(default_factory=dict)
    touches: Mapping[str, Touches] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Group:
    """What turns as one piece: `local` places its joints (complex, first joint at 0, second on the axis)."""

    turning: Turning
    local: Mapping[str, complex]
    arms: Mapping[tuple[str, str], Vec] = field(default_factory=dict)


@dataclass(frozen=True)
class Kinematics:
    """What the walk finds; positions in the scene's unit."""

    points: Mapping[str, MovingPoint]
    centres: Mapping[str, MovingPoint]
    bodies: Mapping[str, Turning]
    travels: Mapping[str, Moving]
    margins: Mapping[str, Value]
    """For each dyad closed from moving points: U·W, negative where it cannot be assembled."""
    drivers: Mapping[str, Moving]
    """What closes each of these dyads: L², or how far its end lies from its line."""


@dataclass
class _Walk:
    plan: Plan
    clock: Clock
    gears: Mapping[str, Gearing]
    by_angle: Mapping[str, Moving]
    """The drivers with their derivatives in the input's angle, where a chain limits the input."""
    points: dict[str, MovingPoint] = field(default_factory=dict)
    groups: list[Group] = field(default_factory=list)
    travels: dict[str, Moving] = field(default_factory=dict)
    margins: dict[str, Value] = field(default_factory=dict)
    drivers: dict[str, Moving] = field(default_factory=dict)
    """What closes each dyad on moving points: L², or how far its end lies from its line."""


def walk(plan: Plan, clock: Clock) -> Kinematics:
    """Return the motion of everything in the linkage at the clock's instant."""
    by_angle = _walked(plan, _angle_clock(clock), {}).drivers if plan.fits and clock.ends else {}
    w = _walked(plan, clock, by_angle)
    return Kinematics(w.points, _centres(w), _bodies(w), _body_travels(w), w.margins, w.drivers)


def _angle_clock(clock: Clock) -> Clock:
    """Return the same instant with derivatives in the input's angle instead of in time."""
    assert clock.ends is not None
    return replace(clock, rate=1.0, second=0.0, pace=Slope(1.0), ends=by_angle(clock.ends, Slope(1.0)))


def _walked(plan: Plan, clock: Clock, by_angle: Mapping[str, Moving]) -> _Walk:
    linkage = plan.linkage
    w = _Walk(plan, clock, gearings(linkage), by_angle)
    pins = {joint.name: complex(*joint.position) for joint in linkage.joints if isinstance(joint, Pin)}
    w.groups.append(Group(Turning(), pins))
    for joint in linkage.joints:
        match joint:
            case Pin():
                w.points[joint.name] = MovingPoint(Vec(*joint.position))
            case Crank():
                _crank(w, joint)
            case RRR():
                _two_bars(w, joint)
            case RRP():
                _slider(w, joint)
            case RPR():
                _slot(w, joint)
            case Rigid():
                w.points[joint.name] = _attached(w, joint.on, joint.at, joint.name)
    return w


def _pace(w: _Walk, gearing: Gearing) -> Slope:
    ratio = float(gearing.ratio)
    return Slope(w.clock.rate * ratio, w.clock.second * ratio)


def _crank(w: _Walk, joint: Crank) -> None:
    gearing = w.gears[joint.name]
    half, twice = w.clock.half(-gearing.offset, gearing.ratio), 2.0 * joint.length
    arm = Vec(joint.length - half.square * twice, half.product * twice)
    pace = _pace(w, gearing)
    turning = Turning(pace.value, pace.rate)
    w.points[joint.name] = w.points[joint.pivot] + carried(arm, turning)
    _add_bar(w, (joint.pivot, joint.name), joint.length, turning, arm)


def _add_bar(w: _Walk, ends: tuple[str, str], length: float, turning: Turning, arm: Vec) -> None:
    w.groups.append(Group(turning, {ends[0]: 0j, ends[1]: complex(length)}, {ends: arm}))


def _loop_root(w: _Walk, loop: Loop, sign: int) -> tuple[SignedRoot, Half, Slope]:
    pace = _pace(w, loop.gearing)
    root, half = loop.closed(w.clock, w.plan.path, pace)
    return root.times(sign), half, pace


def _two_bars(w: _Walk, joint: RRR) -> None:
    loop, sign = w.plan.loops.get(joint.name), w.plan.signs[joint.name]
    ends, lengths = joint.ends, joint.lengths
    if loop is not None and loop.swapped:
        ends, lengths, sign = (ends[1], ends[0]), (lengths[1], lengths[0]), -sign
    p, q = w.points[ends[0]], w.points[ends[1]]
    if loop is not None and loop.ground is not None:
        root, half, pace = _loop_root(w, loop, sign)
        pin = PinLoop(loop.ground.length, loop.ground.direction, loop.crank.length, half, pace)
        triangle = pin_triangle(pin, lengths, root)
    else:
        root = _moving_root(w, joint.name, p, q, lengths).times(sign)
        triangle = moving_triangle(p, q, lengths, root)
    meeting = meet(p, q, lengths, triangle)
    w.points[joint.name] = meeting.point
    _add_bar(w, (ends[0], joint.name), lengths[0], meeting.turning_a, meeting.arm_a)
    _add_bar(w, (ends[1], joint.name), lengths[1], meeting.turning_b, meeting.arm_b)


def _moving_root(
    w: _Walk, name: str, p: MovingPoint, q: MovingPoint, lengths: tuple[float, float]
) -> SignedRoot:
    square = moving_square(p, q)
    u, v = moving_factors(square.value, lengths)
    return _margin_root(w, name, (u, v), square)


def _slider(w: _Walk, joint: RRP) -> None:
    point, line = w.points[joint.end], joint.line
    along, base = Vec(*unit(line.angle)), w.points[line.through]
    way = point.position - base.position
    aside, forward = along.cross(way) - line.offset, along.dot(way)
    root = _slider_root(w, joint, aside, along)
    rho, q = root.ratio, root.q
    turning = Turning(-rho.value, -rho.rate)
    travel = Moving(
        forward + q,
        along.dot(point.velocity) - aside * rho.value,
        along.dot(point.acceleration) - (along.cross(point.velocity) * rho.value + aside * rho.rate),
    )
    start = base.position + along.left().scaled(line.offset)
    w.points[joint.name] = MovingPoint(
        start + along.scaled(travel.value), along.scaled(travel.rate), along.scaled(travel.second)
    )
    w.travels[joint.name] = travel
    arm = along.scaled(q) - along.left().scaled(aside)
    _add_bar(w, (joint.end, joint.name), joint.length, turning, arm)


def _slider_root(w: _Walk, joint: RRP, aside: Value, along: Vec) -> SignedRoot:
    """Return √(b² - e²) with e how far the bar's end lies left of the line."""
    loop, sign = w.plan.loops.get(joint.name), w.plan.signs[joint.name]
    if loop is not None:
        return _loop_root(w, loop, sign)[0]
    point, b = w.points[joint.end], joint.length
    driver = Moving(aside, along.cross(point.velocity), along.cross(point.acceleration))
    return _margin_root(w, joint.name, (b - aside, b + aside), driver).times(sign)


def _margin_root(
    w: _Walk, name: str, factors: tuple[Value, Value], driver: Moving, *, single: bool = False
) -> SignedRoot:
    """Return the root of a dyad on moving points, and note its margin."""
    u, v = factors
    w.margins[name] = u * v
    w.drivers[name] = driver
    if name in w.plan.fits and name in w.by_angle:
        half_difference = 0.5 if single else (u - v) * 0.5
        margin = Margin(u * v, half_difference, driver, w.by_angle[name])
        return limited_root(margin, w.plan.fits[name], w.clock)
    half_difference = 0.5 if single else (u - v) * 0.5
    touches = w.plan.touches.get(name)
    if touches is not None:
        return touches.root(u * v, driver, half_difference, w.clock)
    return plain_root(u, v, driver, half_difference)


def _slot(w: _Walk, joint: RPR) -> None:
    pivot, pin = w.points[joint.pivot], w.points[joint.through]
    loop, sign, offset = w.plan.loops.get(joint.name), w.plan.signs[joint.name], joint.offset
    if loop is not None and loop.ground is not None:
        root, half, pace = _loop_root(w, loop, sign)
        ground = PinLoop(loop.ground.length, loop.ground.direction, loop.crank.length, half, pace)
        turn = pin_triangle(ground, (0.0, 0.0), root).turn
        direction = _loop_direction(ground, root, offset, sign)
    else:
        root = _moving_slot_root(w, joint).times(sign)
        turn = moving_triangle(pin, pivot, (0.0, 0.0), root).turn
        direction = slot_direction(pin.position - pivot.position, root.q, offset)
    turning = slot_turning(turn, root, offset) if offset else turn
    arm = direction.scaled(joint.length)
    w.points[joint.name] = pivot + carried(arm, turning)
    _add_bar(w, (joint.pivot, joint.name), joint.length, turning, arm)


def _loop_direction(ground: PinLoop, root: SignedRoot, offset: float, sign: int) -> Vec:
    """Return the slotted bar's direction; a slot through its own pivot turns at half the crank's angle."""
    if ground.ground == ground.crank and offset == 0:
        return Vec(-ground.half.sine, ground.half.cosine).times(ground.direction).scaled(float(sign))
    return slot_direction(-ground.across(), root.q, offset)


def _moving_slot_root(w: _Walk, joint: RPR) -> SignedRoot:
    pivot, pin, offset = w.points[joint.pivot], w.points[joint.through], joint.offset
    square = moving_square(pivot, pin)
    distance = sqrt(square.value)
    v = (distance - offset) * (distance + offset)
    return _margin_root(w, joint.name, (1.0, v), square, single=True)


def _group_of(w: _Walk, names: tuple[str, ...], owner: str) -> Group:
    for group in w.groups:
        if all(name in group.local for name in names):
            return group
    raise AssemblyError(f"{owner}: {' and '.join(names)} are not joints of one rigid body")


def _arm(w: _Walk, group: Group, start: str, end: str) -> Vec:
    """Return the vector from one joint of a rigid body to another."""
    if (start, end) in group.arms:
        return group.arms[start, end]
    if (end, start) in group.arms:
        return -group.arms[end, start]
    return w.points[end].position - w.points[start].position


def _attached(w: _Walk, on: tuple[str, str], at: tuple[float, float], name: str | None = None) -> MovingPoint:
    """Return the point `at` along on[0] -> on[1] and to its left; as a joint of the body where named."""
    group = _group_of(w, on, f"joint {name}" if name else "centre of mass")
    base = group.local[on[1]] - group.local[on[0]]
    share = complex(*at) / abs(base)
    arm = _arm(w, group, *on).times(Vec(share.real, share.imag))
    if name is not None:
        local = {**group.local, name: group.local[on[0]] + base * share}
        w.groups[w.groups.index(group)] = Group(group.turning, local, {**group.arms, (on[0], name): arm})
    return w.points[on[0]] + carried(arm, group.turning)


def _bodies(w: _Walk) -> dict[str, Turning]:
    return {
        body.name: _group_of(w, body.joints, f"body {body.name}").turning
        for body in w.plan.linkage.bodies
        if body.slider is None
    }


def _centres(w: _Walk) -> dict[str, MovingPoint]:
    return {
        body.name: _attached(w, _axis(body), body.com)
        for body in w.plan.linkage.bodies
        if body.com is not None and body.slider is None
    }


def _axis(body: Body) -> tuple[str, str]:
    return body.joints[0], body.joints[1]


def _body_travels(w: _Walk) -> dict[str, Moving]:
    return {body.name: w.travels[body.slider] for body in w.plan.linkage.bodies if body.slider is not None}
