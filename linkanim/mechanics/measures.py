"""Measure what follows from solved quantities, and tell what a computed number means.

Its parts, in reading order:

- What a solved number says at a phase: a value, 0, unbounded, or no value at all.
- Measures: what follows from solved quantities, and what is known of each joint, body and strut.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache, partial
from typing import Any, NamedTuple

import numpy as np

from linkanim.mechanics.linkage import (
    Body,
    Crank,
    Damper,
    Line,
    Linkage,
    Load,
    Slide,
    Spring,
    holding,
    share_of,
)
from linkanim.mechanics.precise import direction as exact_direction
from linkanim.mechanics.tolerances import ASIDE, FEWER_ERRORS, ROUNDING, SLOW, STATED, STRAIGHT
from linkanim.words import to_say

# What a solved number says at a phase: a value, 0, unbounded, or no value at all.
#
# **How to ask.** `scene.quantities[token].read(motion)`, of a Motion or a Pose, and `.displayed(motion)` with
# angles in degrees. Every output asks in this way, so that all outputs agree:
#
# - a finite number is the value;
# - `0.0`, without a sign: exactly zero, by geometry or to all digits that it could have;
# - `math.inf`, without a sign: unbounded, such as a rate by the input at a limit of the input;
# - `nan`: no value, such as the direction of a strut of no length;
# - None: not known.
#
# Motion's own attributes hold the computed floats. These are wrong in three cases, which are put right here.
#
# **At a limit.** A limit lies at a multiple of π in phase, and no float but 0 is such a multiple. A phase
# within its own last digits of one counts as the limit (`angles.stated`): there a vanishing rate is 0.0, and
# a quotient over it is infinite. An angle is compared with the limit's own digits (`LimitDistances`).
#
# **By rounding.** A quantity that vanishes is computed as the rounding errors of its terms: a fixed share of
# the linkage's extent, moved at the input's speed. What is no larger is 0.
#
# **By geometry.** A point that keeps its distance from a fixed pin runs on a circle, one that slides on a
# fixed line runs straight (`Linkage.radii`); a body with a fixed pin turns about it (`Linkage.pivot`); a
# strut between two joints of one rigid body keeps its length. That holds at rest, too, where velocities say
# nothing.
#
# **At rest.** How another path bends, and where another pole is, is a quotient of rates, and no matter of
# time: 0/0 at a dead centre of the link that moves it, and a quotient of rounding errors beside it. There the
# rates by that link's own way are taken, which go on, or those by the input's (`steady`).


def cleaned(value: Any, rounding: Any) -> Any:
    """Return numbers with 0.0 for those no larger than rounding errors, and +inf for both infinities.

    `value` is a float, a pair of floats, or an array against which `rounding` broadcasts.
    """
    if isinstance(value, tuple):
        return tuple(cleaned(part, rounding) for part in value)
    if isinstance(value, float) and isinstance(rounding, float):
        size = abs(value)
        return 0.0 if size <= rounding else math.inf if size == math.inf else value
    told = np.where(np.abs(value) <= rounding, 0.0, value)
    np.copyto(told, np.inf, where=told == -np.inf)
    return told[()]


def as_output(motion: Any, value: Any, unit: str, order: int) -> Any:
    """Return solved numbers of a motion as every output shows them; vectors are arrays (..., 2) or pairs."""
    rounding = rounding_of(motion, unit, order)
    vectors = np.ndim(value) == np.ndim(rounding) + 1 if isinstance(rounding, np.ndarray) else False
    return cleaned(value, rounding[..., None] if vectors else rounding)


def rounding_of(motion: Any, unit: str, order: int) -> Any:
    """Return how large rounding errors of a quantity may be, from the linkage's extent and the input's speed.

    An array where the speed is an array; 0 for a unit other than of angles, lengths and their rates.
    """
    size = _size(unit, motion.mechanism.linkage.extent)
    if not order:
        return size
    speed, acceleration = motion.input_speed, motion.input_acceleration
    return size * (abs(speed) if order == 1 else speed * speed + abs(acceleration))


def unbounded(rate: Any, phase: Any) -> Any:
    """Return a rate, infinite where it is NaN though the phase is known: there it is unbounded."""
    if isinstance(rate, float):
        return math.inf if math.isnan(rate) and not math.isnan(phase) else rate
    return np.where(np.isnan(rate) & ~np.isnan(phase), np.inf, rate)[()]


def stands(motion: Any, within: float = STATED) -> Any:
    """Tell where the input stands still: at rest, or `within` so much of an end where it turns back.

    That is a share of π, or of a greater phase; by itself the last digits of a phase. With q the input's
    coordinate, φ the phase and a prime for a rate in time, φ lies beside an end by q' φ'²/(q" φ' - q' φ"),
    whatever φ" is.
    """
    speed, rate, second = motion.input_speed, motion.coordinate_rate, motion.coordinate_second
    bend = second * speed - rate * motion.input_acceleration
    return np.abs(rate * speed * speed) <= within * np.hypot(motion.phase, math.pi) * np.abs(bend)


@lru_cache(maxsize=256)
def _size(unit: str, extent: float) -> float:
    """Return the rounding errors of a unit in which `{}` stands for that of length."""
    above, _, below = unit.partition("/")
    if not ("{" in above or above.startswith("rad")):
        return 0.0
    power = ("{" in above) - ("{" in below) * (2 if "²" in below else 1)
    with np.errstate(all="ignore"):  # extents to a power may be beyond all floats
        return float(ROUNDING * np.power(extent, float(power)))


# Measures: what follows from solved quantities, and what is known of each joint, body and strut.
#
# Every function takes a Motion, and works on arrays, or a Pose, and works on floats: by + - × ÷ and roots of
# components, and numpy's functions, so that both have the same bits. NaN stands for no value at an instant,
# infinity for an unbounded one (`cleaned`). Symbols are those of the textbooks on mechanisms: ω, α, v, a;
# h and f for first kinematic coefficients.


def components(vector: Any) -> tuple[Any, Any]:
    """Return x and y of a pair of floats, or of an array (..., 2)."""
    return vector if isinstance(vector, tuple) else (vector[..., 0], vector[..., 1])


def as_complex(vector: Any) -> Any:
    """Return a pair of floats, or an array (..., 2), as x + yi."""
    return complex(*vector) if isinstance(vector, tuple) else vector[..., 0] + 1j * vector[..., 1]


def over(dividend: Any, divisor: Any) -> Any:
    """Return a quotient, infinite or NaN where the divisor is 0."""
    if type(dividend) is type(divisor) is float and divisor:
        return dividend / divisor
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.true_divide(dividend, divisor)


Vector = tuple[Any, Any]
"""The components of a plane vector, floats or arrays."""


class FarPositions(Mapping[str, Any]):
    """Positions by name, pairs or arrays (..., 2), of a linkage that is solved from a far `origin`.

    `near` has them as seen from there, with the digits that they lose far from (0, 0).
    """

    def __init__(self, near: Mapping[str, Any], origin: tuple[float, float]) -> None:
        self.near, self.origin = near, origin

    def __getitem__(self, name: str) -> Any:
        place, (x, y) = self.near[name], self.origin
        if isinstance(place, tuple):
            return place[0] + x, place[1] + y
        position = place + np.array([x, y])
        position.flags.writeable = False
        return position

    def __iter__(self) -> Iterator[str]:
        return iter(self.near)

    def __len__(self) -> int:
        return len(self.near)


def near(positions: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return positions as their differences are to be formed: as seen from the linkage's origin."""
    return positions.near if isinstance(positions, FarPositions) else positions


def between(vectors: Mapping[str, Any], ends: tuple[str, str]) -> Vector:
    """Return how far one joint's vector is from another's: x and y."""
    (x0, y0), (x1, y1) = (components(near(vectors)[joint]) for joint in ends)
    return x1 - x0, y1 - y0


def size(vector: Vector) -> Any:
    """Return a vector's length, by a root with the same bits everywhere: a C library has its own hypot."""
    square = vector[0] * vector[0] + vector[1] * vector[1]
    return math.sqrt(square) if isinstance(square, float) else np.sqrt(square)


def cross(vector: Vector, other: Vector) -> Any:
    """Return the signed area that two vectors span."""
    return vector[0] * other[1] - vector[1] * other[0]


def growth(vector: Vector, rate: Vector) -> Any:
    """Return how fast a vector's length grows, given its rate; of length 0, how fast it is about to grow."""
    length = size(vector)
    rate_of_growth = over(dot(vector, rate), length)
    return rate_of_growth if np.all(length) else np.where(length == 0, size(rate), rate_of_growth)[()]


def direction(vector: Vector) -> Any:
    """Return the angle of a vector, -π … π; NaN where it has no length."""
    dx, dy = vector
    if isinstance(dx, float) and not (dx or dy):
        return math.nan
    # numpy's of floats, too: a C library's has other bits
    return np.where((dx == 0) & (dy == 0), np.nan, np.arctan2(dy, dx))[()]


def tangential(velocity: Any, acceleration: Any) -> Any:
    """Return the acceleration along the way a point moves: negative where it slows down; NaN at rest."""
    return over(dot(velocity, acceleration), size(velocity))


def normal(velocity: Any, acceleration: Any) -> Any:
    """Return the acceleration towards the centre of curvature of a point's path, not negative."""
    return over(abs(cross(velocity, acceleration)), size(velocity))


def curvature_radius(velocity: Any, acceleration: Any, least: Any) -> Any:
    """Return the radius of curvature of a point's path, ρ = |v|³/|v × a|; infinite where it is straight.

    An acceleration is known to within `least` only.
    """
    speed, bend = size(velocity), abs(cross(velocity, acceleration))
    straight = bend <= speed * np.maximum(STRAIGHT * size(acceleration), least)
    return over(speed * speed * speed, np.where(straight, 0.0, bend)[()])


def turned(vector: Vector, by: Vector) -> Vector:
    """Return a vector turned by the angle of another one, of length 1."""
    return vector[0] * by[0] - vector[1] * by[1], vector[0] * by[1] + vector[1] * by[0]


def body_direction(motion: Any, body: Body) -> Vector:
    """Return the direction of a body, of length 1: of first -> second joint, or of a block's line."""
    linkage = motion.mechanism.linkage
    if body.slider is not None:
        return line_direction(motion, linkage.slides[body.slider].line)
    first, second = body.joints[:2]
    frame = linkage.rigid_bodies[holding(linkage.rigid_bodies, body.joints) or 0]
    x, y = between(motion.position, (first, second))
    length = 1.0 / abs(frame[second] - frame[first])
    return x * length, y * length


def line_direction(motion: Any, line: Line) -> Vector:
    """Return the direction of a line of travel, of length 1."""
    x, y = map(float, exact_direction(line.angle))
    if line.on is None:
        return x, y
    return turned((x, y), body_direction(motion, Body("", line.body)))


def dot(vector: Vector, other: Vector) -> Any:
    """Return the scalar product of two vectors."""
    return vector[0] * other[0] + vector[1] * other[1]


def steady(motion: Any, joints: Iterable[str], read: Callable[[Any], tuple[Any, ...]]) -> tuple[Any, ...]:
    """Return whether things move at all, and what `read` finds from rates that are neither tiny nor huge.

    `read` returns how fast things move, and numbers that do not depend on that. It is asked for the rates in
    time; where these are nearly 0, or unbounded, for those by each of `Linkage.movers`, by the input, and by
    the phase. An input that turns fully at one speed has these three alike.
    """
    linkage = motion.mechanism.linkage
    ways: list[Callable[[], Any]] = [partial(motion.per, mover) for mover in linkage.movers(joints)]
    if not motion.mechanism.full_turn or np.any(motion.input_acceleration) or not np.all(motion.input_speed):
        ways.append(lambda: motion.per_input)
        ways.append(lambda: motion.mechanism.solve(phase=motion.phase, speed=1.0))
    share, values = _moved(motion, read)
    for way in ways:
        poor = share < SLOW
        if not np.any(poor):
            break
        better, others = _moved(way(), read)
        taken = poor & (better > share)
        share = np.where(taken, better, share)[()]
        values = tuple(np.where(taken, new, old)[()] for new, old in zip(others, values, strict=True))
    return share > ROUNDING, *values


def _moved(motion: Any, read: Callable[[Any], tuple[Any, ...]]) -> tuple[Any, tuple[Any, ...]]:
    """Return how fast things move, in extents for each radian of the input, and what else is read.

    Of more than one extent the first is the reciprocal: it is near 0 where rates have few digits.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        size, *values = read(motion)
        share = over(size, motion.mechanism.linkage.extent * abs(motion.input_speed))
        share = np.minimum(share, over(1.0, share))
    return np.where(np.isnan(share), 0.0, share)[()], tuple(values)


def transmission_angle(motion: Any, dyad: str) -> Any:
    """Return a dyad's transmission angle, 90° at the most, as its kind of joint defines it."""

    def vector(start: str, end: str) -> Vector:
        return between(motion.position, (start, end))

    return motion.mechanism.linkage.joint(dyad).transmission_at(vector)


def worst_transmission(motion: Any, dyads: tuple[str, ...]) -> Any:
    """Return the least transmission angle of several dyads."""
    return np.min([transmission_angle(motion, dyad) for dyad in dyads], axis=0)[()]


def dyads_of(linkage: Linkage) -> tuple[str, ...]:
    """Return the joints of the dyads that have a transmission angle, in the order of solving."""
    return tuple(joint.name for joint in linkage.joints if joint.transmission(1.0, 1.0) is not None)


def output_body(linkage: Linkage) -> Body | None:
    """Return the body that a linkage is there to move: its first slider not driven, else its last rocker."""
    own = (None, linkage.drive.joint)
    slider = next((body for body in linkage.bodies if body.slider not in own), None)
    fixed = {pin.name for pin in linkage.pins}
    rockers = [body for body in linkage.bodies if fixed & set(body.joints) and not linkage.crank_of(body)]
    return slider or (rockers[-1] if rockers else None)


def output_slider(linkage: Linkage) -> Body | None:
    """Return the slider that a linkage is there to move: the first one not driven, or else the driven."""
    output = output_body(linkage)
    if output is not None and output.slider is not None:
        return output
    return next((body for body in linkage.bodies if body.slider is not None), None)


def coupler_body(linkage: Linkage) -> Body | None:
    """Return the first body without a fixed pin; None where every body has one."""
    turning = (body for body in linkage.bodies if body.slider is None)
    return next((body for body in turning if not pivots_of(linkage, body)), None)


def pivots_of(linkage: Linkage, body: Body) -> tuple[str, ...]:
    """Return the fixed pins of a body that turns, with those of all that is rigidly joined to it."""
    frame = holding(linkage.rigid_bodies, body.joints)
    return tuple(pin.name for pin in linkage.pins if frame and pin.name in linkage.rigid_bodies[frame])


def mechanical_advantage(motion: Any, output: Body) -> Any:
    """Return the output's torque over the input's; of sliders the force, at the crank's pin.

    Without losses both are ratios of speeds (Uicker, Pennock and Shigley, Theory of Machines and
    Mechanisms); not negative, infinite where the output rests, 0 where the input does.
    """
    linkage = motion.mechanism.linkage
    crank, turning = linkage.driven.joint, output.slider is None
    length = crank.length if isinstance(crank, Crank) and not turning else 1.0
    first, _ = coefficients_of(linkage, turning=turning)

    def by_input(motion: Any) -> Any:
        return over(rate_of(motion, output), motion.coordinate_rate)

    slope = by_input(motion)
    if np.any(stops := stands(motion)):
        slope = np.where(stops, unbounded(by_input(motion.per_input), motion.phase), slope)[()]
    return abs(over(length, cleaned(slope, rounding_of(motion, first.unit, 0))) + 0.0 * motion.phase)


def rate_of(motion: Any, body: Body) -> Any:
    """Return how fast a body turns, or a slider travels."""
    return (motion.travel_velocity if body.slider else motion.angular_velocity)[body.name]


def input_place(motion: Any) -> Any:
    """Return where the input is: the driven angle, or how far a slider that drives has travelled."""
    unit = "rad" if motion.mechanism.linkage.drive.coordinate.is_angle else "{}"
    return as_output(motion, motion.coordinate + 0.0 * motion.phase, unit, 0)


def input_rate(motion: Any) -> Any:
    """Return the input's own velocity, one value an instant: of a swing it is not the phase's."""
    return motion.coordinate_rate + 0.0 * motion.phase


class Measure(NamedTuple):
    """What is known of each part of one sort, such as the angular velocity of a body.

    `name` ends the token, and is the attribute of Motion that holds it, if one does; `key` is the name in
    JSON and `heading` that in a table of plain letters. In `unit`, `{}` stands for the unit of length.
    `order` counts derivatives in time. `read` takes a Motion or a Pose and the part's name, and returns
    computed values, rounding errors for zeros among them. Where its `divisor` changes sign the measure may be
    unbounded.
    """

    name: str
    key: str
    symbol: str
    words: str
    unit: str
    order: int
    heading: str
    read: Callable[[Any, str], Any]
    divisor: Callable[[Any, str], Any] | None = None

    def divisor_of(self, part: str) -> Callable[[Any], Any] | None:
        """Return the divisor of one part, if there is one."""
        divisor = self.divisor
        if divisor is None:
            return None
        return lambda motion: divisor(motion, part)


def _solved(name: str, symbol: str, words: str, unit: str, order: int, heading: str = "") -> Measure:
    """Return the measure that Motion holds under its own name."""
    key = name.removeprefix("travel_").removeprefix("com_")

    def read(motion: Any, part: str) -> Any:
        return getattr(motion, name)[part]

    return Measure(name, key, symbol, words, unit, order, heading or symbol, read)


def _of_points(prefix: str) -> tuple[Measure, ...]:
    """Return the measures of joints, or of centres of mass, by what their names begin with in a motion."""
    return (
        _solved(f"{prefix}position", "r", to_say("position"), "{}", 0),
        _solved(f"{prefix}velocity", "v", to_say("velocity"), "{}/s", 1),
        _solved(f"{prefix}acceleration", "a", to_say("acceleration"), "{}/s²", 2),
    )


POINT, CENTRE = _of_points(""), _of_points("com_")
TURNING = (
    _solved("angle", "θ", to_say("angle"), "rad", 0, "angle"),
    _solved("angular_velocity", "ω", to_say("angular velocity"), "rad/s", 1, "omega"),
    _solved("angular_acceleration", "α", to_say("angular acceleration"), "rad/s²", 2, "alpha"),
)
TRAVELLING = (
    _solved("travel", "s", to_say("travel"), "{}", 0, "travel"),
    _solved("travel_velocity", "v", to_say("velocity"), "{}/s", 1),
    _solved("travel_acceleration", "a", to_say("acceleration"), "{}/s²", 2),
)


def coefficients_of(linkage: Linkage, *, turning: bool) -> tuple[Measure, ...]:
    """Return the two kinematic coefficients of bodies that turn, or slide: by the input's angle or travel."""
    coordinate = linkage.drive.coordinate
    by, plain = coordinate.unit, "theta" if coordinate.is_angle else coordinate.name
    slid = f"{{}}/{by}" if coordinate.is_angle else "{0}/{0}"
    symbol, letter, units = (
        ("h", "q", (f"rad/{by}", f"rad/{by}²")) if turning else ("f", "s", (slid, f"{slid}²"))
    )
    first = "coefficient", "1", symbol, to_say("kinematic coefficient"), units[0], 0, f"d{letter}/d{plain}"
    words = to_say("second kinematic coefficient")
    second = "second_coefficient", "2", f"{symbol}′", words, units[1], 0, f"d2{letter}/d{plain}2"

    def read(component: int) -> Callable[[Any, str], Any]:
        return lambda motion, part: motion.coefficient[part][component]

    return Measure(*first, read(0)), Measure(*second, read(1))


def measures_of(linkage: Linkage, body: Body) -> tuple[tuple[Measure, ...], tuple[Measure, ...]]:
    """Return the measures of a body that turns or slides, and its two kinematic coefficients."""
    turning = body.slider is None
    return TURNING if turning else TRAVELLING, coefficients_of(linkage, turning=turning)


def _strut(motion: Any, item: Spring | Damper, values: Any, name: str) -> Any:
    """Return a strut's quantity of that name; between two joints of one rigid body its length is constant."""
    value = getattr(values, name)
    if value is None:
        return None
    rigid = holding(motion.mechanism.linkage.rigid_bodies, item.between) is not None
    if rigid and (name == "rate" or (name == "force" and isinstance(item, Damper))):
        return 0.0 * motion.phase
    if name == "force":
        return cleaned(value, force_rounding(motion, item))
    if name in ("length", "rate"):
        return value
    nowhere = np.equal(as_output(motion, values.length, "{}", 0), 0.0)
    return np.where(nowhere, np.nan, value)[()]


def force_rounding(motion: Any, item: Spring | Damper) -> Any:
    """Return how large the rounding errors of a strut's force may be (N)."""
    factor = item.stiffness if isinstance(item, Spring) else item.coefficient
    unit, order = ("{}", 0) if isinstance(item, Spring) else ("{}/s", 1)
    return rounding_of(motion, unit, order) * (abs(factor or 0.0) * motion.mechanism.linkage.metre)


def loaded(motion: Any, load: Load) -> tuple[Vector, Vector]:
    """Return where a load acts, from its body's first joint or its block's, and its force (N)."""
    body = motion.mechanism.linkage.body(load.on)
    arm: Vector = (0.0, 0.0)
    if load.joint and body.slider is None:
        arm = between(motion.position, (body.joints[0], load.joint))
    elif load.at is not None:
        arm = turned(load.at, body_direction(motion, body))
    force = turned(load.force, body_direction(motion, body)) if load.turns or load.against else load.force
    share = _share_of(motion, load)
    return arm, force if share is None else (force[0] * share + 0.0, force[1] * share + 0.0)  # −0 is 0


def _share_of(motion: Any, load: Load) -> Any:
    """Return how many times as large a load is as its force; None where that does not change."""
    share: Any = None
    if load.values:
        place = motion.travel[load.on] if load.over_travel else motion.coordinate
        share = np.interp(place, load.places, load.values, period=None if load.over_travel else math.tau)
    if load.against or load.way:
        ways = np.sign(as_output(motion, motion.travel_velocity[load.on], "{}/s", 1))
        alone = -ways if load.against else abs(ways)
        alone = np.where(ways == load.way, alone, 0.0) if load.way else alone
        share = alone if share is None else share * alone
    return share


def _of_struts(kind: str) -> tuple[Measure, ...]:
    """Return length, rate, force, direction and its rate of the struts of one kind, "spring" or "damper"."""

    def measure(name: str, symbol: str, words: str, unit: str, order: int) -> Measure:
        def read(motion: Any, strut: str) -> Any:
            item = next(one for one in getattr(motion.mechanism.linkage, f"{kind}s") if one.name == strut)
            return _strut(motion, item, getattr(motion, kind)[strut], name)

        return Measure(name, name, symbol, words, unit, order, name, read)

    return (
        measure("length", "L", to_say("length"), "{}", 0),
        measure("rate", "v", to_say("rate of length"), "{}/s", 1),
        measure("force", "F", to_say("force"), "N", int(kind == "damper")),
        measure("direction", "θ", to_say("direction"), "rad", 0),
        measure("direction_rate", "ω", to_say("rate of direction"), "rad/s", 1),
    )


SPRING, DAMPER = _of_struts("spring"), _of_struts("damper")


def _radius(motion: Any, prefix: str, part: str) -> float | None:
    """Return the radius of the circle on which a joint, or a centre of mass, runs; None for other paths."""
    linkage = motion.mechanism.linkage
    if not prefix:
        radius: float | None = linkage.radii.get(part)
        return radius
    body = motion.mechanism.linkage.body(part)
    if (pivot := linkage.pivot(body.joints)) is None:
        return None
    frame = linkage.rigid_bodies[holding(linkage.rigid_bodies, body.joints) or 0]
    start, end = (frame[name] for name in body.joints[:2])
    assert body.com is not None
    place = start + (end - start) * share_of(frame, (body.joints[0], body.joints[1]), body.com)
    return float(abs(place - frame[pivot])) or None


def _rates(motion: Any, prefix: str, part: str) -> tuple[Vector, Vector]:
    kinds = (getattr(motion, f"{prefix}{kind}") for kind in ("velocity", "acceleration"))
    velocity, acceleration = (components(kind[part]) for kind in kinds)
    return velocity, acceleration


def _radius_of_curvature(motion: Any, prefix: str, part: str) -> Any:
    """Return a path's radius of curvature: known by geometry, or from the rates by what moves the point.

    At a cusp it is 0.
    """
    radius = _radius(motion, prefix, part)
    if radius is not None:
        return radius + 0.0 * motion.phase
    joints = (part,) if not prefix else motion.mechanism.linkage.body(part).joints[:2]

    def read(motion: Any) -> tuple[Any, Any]:
        rates = _rates(motion, prefix, part)
        return size(rates[0]), curvature_radius(*rates, FEWER_ERRORS * rounding_of(motion, "{}/s²", 2))

    moves, values = steady(motion, joints, read)
    turns = ~moves & ~np.isnan(motion.phase)
    if not np.any(turns):
        return values
    solve = motion.mechanism.solve
    near, far = (read(solve(phase=motion.phase + n * ASIDE, speed=1.0))[1] for n in (1, 2))
    with np.errstate(invalid="ignore"):
        cusped = np.where(far > 1.5 * near, 0.0, near)
        return np.where(turns, np.where(np.isinf(near), near, cusped), values)[()]


def _along(motion: Any, prefix: str, part: str) -> Any:
    """Return the tangential acceleration; of a point that rests, that with which it is about to move."""
    velocity, acceleration = _rates(motion, prefix, part)
    rests = np.equal(as_output(motion, size(velocity), "{}/s", 1), 0.0)
    return np.where(rests, size(acceleration), tangential(velocity, acceleration))[()]


def _across(motion: Any, prefix: str, part: str) -> Any:
    """Return the normal acceleration, 0 of a point that rests."""
    velocity, acceleration = _rates(motion, prefix, part)
    speed, radius = as_output(motion, size(velocity), "{}/s", 1), _radius(motion, prefix, part)
    if radius is not None:
        return speed * speed / radius
    return np.where(np.equal(speed, 0.0), 0.0, normal(velocity, acceleration))[()]


def _of_paths(prefix: str) -> tuple[Measure, ...]:
    """Return how the paths bend of joints, or of centres of mass, from velocity and acceleration."""

    def bent(name: str, symbol: str, words: str, unit: str, order: int, work: Callable[..., Any]) -> Measure:
        def read(motion: Any, part: str) -> Any:
            with np.errstate(invalid="ignore"):  # a limit's unbounded rates leave no number
                return work(motion, prefix, part)

        def turning(motion: Any, part: str) -> Any:
            return cross(*_rates(motion, prefix, part))

        divisor = None if order else turning
        return Measure(prefix + name, name, symbol, words, unit, order, name, read, divisor)

    return (
        bent("normal_acceleration", "aⁿ", to_say("normal acceleration"), "{}/s²", 2, _across),
        bent("tangential_acceleration", "aᵗ", to_say("tangential acceleration"), "{}/s²", 2, _along),
        bent("curvature_radius", "ρ", to_say("radius of curvature"), "{}", 0, _radius_of_curvature),
    )


PATH, CENTRE_PATH = _of_paths(""), _of_paths("com_")


def slips(linkage: Linkage) -> dict[str, Slide]:
    """Return what slides on links that move, by the link's name: of several on one link the first."""
    slides: dict[str, Slide] = {}
    for joint in linkage.joints:
        for slide in (one for one in joint.slides if one.start is not None):
            axis = slide.line.on
            for body in linkage.bodies:
                if {*axis} <= {*body.joints} if axis else body.slider == slide.start:
                    slides.setdefault(body.name, slide)
    return slides


def slip_of(motion: Any, link: str) -> tuple[Any, Any, Any, Any]:
    """Return how far along its link's line a pin or block is, both rates, and its Coriolis acceleration.

    With u along the line, w from its begin, and Ω and α of the link: s = u·w, s' = u·w' + Ω (u×w), and 2Ω s'
    is the Coriolis acceleration, positive to the left of the line.
    """
    linkage = motion.mechanism.linkage
    slide = slips(linkage)[link]
    u, ends = line_direction(motion, slide.line), (slide.line.through, slide.point)
    w, w1, w2 = (between(kind, ends) for kind in (motion.position, motion.velocity, motion.acceleration))
    turns = slide.line.on is not None
    omega, alpha = (motion.angular_velocity[link], motion.angular_acceleration[link]) if turns else (0.0, 0.0)
    f, e = dot(u, w), cross(u, w)
    f1, e1 = dot(u, w1) + e * omega, cross(u, w1) - f * omega
    f2 = dot(u, w2) + (cross(u, w1) + e1) * omega + e * alpha
    return f, f1, f2, 2.0 * omega * f1


def _of_slip(component: int, name: str, symbol: str, words: str, unit: str, order: int) -> Measure:
    def read(motion: Any, link: str) -> Any:
        with np.errstate(invalid="ignore"):
            return slip_of(motion, link)[component] + 0.0 * motion.phase

    return Measure(name, name, symbol, words, unit, order, name, read)


SLIP = (
    _of_slip(0, "slip", "s", to_say("slip"), "{}", 0),
    _of_slip(1, "slip_velocity", "v", to_say("velocity of slip"), "{}/s", 1),
    _of_slip(2, "slip_acceleration", "a", to_say("acceleration of slip"), "{}/s²", 2),
)
"""Along the line of a link that moves: where what slides on it is, seen from the link."""
CORIOLIS = _of_slip(3, "coriolis", "aᶜ", to_say("Coriolis acceleration"), "{}/s²", 2)

LEVER = "lever"
"""The solved arms of the dyads' reactions, which a linkage without forces does not have."""
VECTORS = tuple(measure.name for measure in (*POINT, *CENTRE))
NUMBERS = tuple(measure.name for measure in (*TURNING[1:], *TRAVELLING))
DERIVATIVE_OF = {
    **{measure.name: measure.order for measure in (*POINT, *CENTRE, *TURNING[1:], *TRAVELLING)},
    LEVER: 0,
}
"""The solved quantities, and how many derivatives each has."""
