"""What the input has to deliver: its torque, or the force of a cylinder or a slider that drives.

By the balance of power over all that the scene gives a force or a mass (the principle of virtual power;
Uicker, Pennock and Shigley, Theory of Machines and Mechanisms), tension F positive, y up, P and T loads,

    Q q' = Σ (m a·v + I α ω) + Σ m g v_y + Σ F dL/dt - Σ (P·v + T ω)

where q is the crank's angle, the cylinder's length or the slider's travel, and Q its torque or its push.
Where everything rests for an instant, accelerations stand in for velocities, which are all in proportion to
q': v/q' = a/q".
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage import Body, Damper, Linkage, Spring, holding
from linkanim.mechanics.measures import (
    as_output,
    between,
    cleaned,
    components,
    cross,
    dot,
    force_rounding,
    growth,
    loaded,
    over,
    rounding_of,
    size,
    stands,
)
from linkanim.mechanics.program import Array, keep_memory
from linkanim.mechanics.search import highest, in_blocks
from linkanim.mechanics.tolerances import AT_END, IDLE, ROUNDING

_BESIDE = 2.0**-6, (0.8, -0.4, 4 / 35, -1 / 70)
"""Where effort is 0/0: steps of phase to both sides of the place, at which it is read instead; their weights.

The steps are for a crank that turns as fast as the input, and shorter where gears turn one faster.
"""
_TOPS = 8
"""How many of the highest samples are followed to a peak of their own."""


class _Rates(NamedTuple):
    """The names under which a motion holds the rates of all that moves, and which derivative they are."""

    points: str
    centres: str
    turning: str
    input: str
    order: int

    def rounding(self, motion: Any, unit: str) -> Any:
        """Return the rounding errors of the rate of a quantity in that unit, as `rounding_of` does."""
        return rounding_of(motion, f"{unit}/s{'²' if self.order == 2 else ''}", self.order)


_MOVING = _Rates("velocity", "com_velocity", "angular_velocity", "coordinate_rate", 1)
_STARTING = _Rates("acceleration", "com_acceleration", "angular_acceleration", "coordinate_second", 2)


def effort_token(linkage: Linkage) -> str:
    """Return the token of the effort at the input: a force of a cylinder or slider, a torque of a crank."""
    return f"input.{linkage.drive.actuator.effort[0]}"


def input_power(motion: Any) -> Any:
    """Return the power (W) that the input delivers; needs second derivatives where anything has a mass."""
    return _power(motion, _MOVING)[0]


def input_effort(motion: Any) -> Any:
    """Return the torque (N m) at the input, or the force (N) of a cylinder or a slider that drives.

    Positive where it turns the input on counter-clockwise, lengthens the cylinder or pushes the slider
    forward. Unbounded at a limit of the input that takes power; NaN where the input stands still and does not
    start to move either.
    """
    keep_memory()
    with np.errstate(invalid="ignore"):  # a limit's unbounded rates leave no number
        power, weight, rounding = _power(motion, _MOVING)
        effort = _quotient(motion, power, rounding, _MOVING)
    unbounded = ~np.isfinite(weight) & ~np.isnan(motion.phase)
    effort = np.where(unbounded, np.inf, effort)[()] if np.any(unbounded) else effort
    if not motion.acceleration or not np.any(near := stands(motion, AT_END)):
        return effort
    stops, still = stands(motion), weight <= rounding
    starting = _effort(motion, _STARTING)
    effort = np.where(stops, np.where(still, starting, np.inf), effort)
    near = idle(motion, np.asarray(near & ~(stops & still)))
    if np.any(near):
        effort[near] = interpolated(motion, near, partial(_effort, rates=_MOVING))
    return effort[()]


def _effort(motion: Any, rates: _Rates) -> Any:
    """Return power over pace."""
    power, _, rounding = _power(motion, rates)
    return _quotient(motion, power, rounding, rates)


def _quotient(motion: Any, power: Any, rounding: Any, rates: _Rates) -> Any:
    """Return power over pace, 0 where that is rounding, infinite or NaN where the pace is 0."""
    pace = _pace(motion, rates)
    return cleaned(over(power, pace), over(rounding, abs(pace)))


def near_ends(motion: Any) -> Any:
    """Tell where the input stands so near an end that power and pace may both have no digits."""
    return stands(motion, AT_END)


def idle(motion: Any, near: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Tell at which of these instants, near an end of the input, what has a force or a mass moves on there.

    It takes no power at the end, and the effort is 0/0. Where it rests with the input, both have their digits
    up to the end.
    """
    is_idle = near.copy()
    if np.any(near):
        phase = np.broadcast_to(motion.phase, near.shape)[near]
        power, weight, rounding = _power(_solved(motion, near, math.pi * np.rint(phase / math.pi)), _MOVING)
        is_idle[near] = (weight > rounding) & (np.abs(power) <= IDLE * rounding)
    return is_idle


def interpolated(motion: Any, where: NDArray[np.bool_], read: Callable[[Any], Any]) -> Any:
    """Return what is read of a motion, interpolated at some of its instants from both sides."""
    step, weights = _BESIDE[0] / motion.mechanism.assembly.quickest, _BESIDE[1]
    phase = np.broadcast_to(motion.phase, where.shape)[where]
    places = ((phase + side * n * step, w) for n, w in enumerate(weights, start=1) for side in (-1, 1))
    return sum(weight * read(_solved(motion, where, place)) for place, weight in places)


def _solved(motion: Any, where: NDArray[np.bool_], phases: Array) -> Any:
    """Return the motion at other phases, with the rates that the input has at these instants."""
    rates = (motion.input_speed, motion.input_acceleration)
    speed, second = (np.broadcast_to(rate, where.shape)[where] for rate in rates)
    return motion.mechanism.solve(phase=phases, speed=speed, acceleration=second)


def _power(motion: Any, rates: _Rates) -> tuple[Any, Any, Any]:
    """Return the power that forces and inertia take (W), its weight, and its rounding errors.

    From rest, it is the rate at which the power grows (W/s). The weight is the sum of the terms' sizes, each
    as if all moved along its force.
    """
    linkage = motion.mechanism.linkage
    struts = _strut_power(motion, rates, linkage.springs + linkage.dampers)
    nothing = 0.0 * motion.phase
    others = (*_body_power(motion, rates), *_load_power(motion, rates))
    power, weight, rounding = map(sum, zip((nothing, nothing, nothing), *struts, *others, strict=True))
    return power, weight, rounding


def _strut_power(
    motion: Any, rates: _Rates, struts: Iterable[Spring | Damper]
) -> Iterator[tuple[Any, Any, Any]]:
    """Yield what each spring and damper takes, its weight, and its rounding errors."""
    linkage, points = motion.mechanism.linkage, getattr(motion, rates.points)
    metre, blur = linkage.metre, rates.rounding(motion, "{}")
    for strut in struts:
        # a strut that keeps its length takes no power
        if strut.forceful and holding(linkage.rigid_bodies, strut.between) is None:
            kind = motion.damper if isinstance(strut, Damper) else motion.spring
            force, moving = kind[strut.name].force, between(points, strut.between)
            rate = growth(between(motion.position, strut.between), moving)
            speeds = sum(size(components(points[end])) for end in strut.between)
            noise = abs(force) * (ROUNDING * speeds + blur) + force_rounding(motion, strut) * abs(rate)
            yield force * metre * rate, abs(force) * metre * size(moving), noise * metre


def _body_power(motion: Any, rates: _Rates) -> Iterator[tuple[Any, Any, Any]]:
    """Yield what each mass and each inertia takes, its weight, and its rounding errors."""
    linkage = motion.mechanism.linkage
    metre = linkage.metre
    jolt, jerk = rounding_of(motion, "{}/s²", 2) * metre, rounding_of(motion, "rad/s²", 2)
    blur, twist = rates.rounding(motion, "{}") * metre, rates.rounding(motion, "rad")
    for body in linkage.bodies:
        prefix, centre = ("com_", body.name) if body.slider is None else ("", body.slider)
        if body.mass is not None:
            u, v = components(getattr(motion, rates.centres if prefix else rates.points)[centre])
            a, b = (0.0, 0.0)
            if not linkage.static:
                a, b = components(getattr(motion, f"{prefix}acceleration")[centre])
            pull, moved = size((a, b)) * metre + abs(linkage.gravity), body.mass * metre * size((u, v))
            power = body.mass * metre * ((a * u + b * v) * metre + linkage.gravity * v)
            yield power, moved * pull, moved * (ROUNDING * pull + jolt) + body.mass * blur * pull
        if body.inertia is not None and not linkage.static:
            turning = body.inertia * getattr(motion, rates.turning)[body.name]
            gained = motion.angular_acceleration[body.name]
            noise = abs(turning) * jerk + (ROUNDING * abs(turning) + body.inertia * twist) * abs(gained)
            yield turning * gained, abs(turning * gained), noise


def _pace(motion: Any, rates: _Rates) -> Any:
    """Return how fast the input moves, in rad/s; a cylinder's length, or a slider, in m/s."""
    linkage = motion.mechanism.linkage
    ends = linkage.drive.actuator.along
    if ends is None:
        rate = getattr(motion, rates.input)
        return rate if linkage.drive.coordinate.is_angle else rate * linkage.metre
    moving = between(getattr(motion, rates.points), ends)
    return growth(between(motion.position, ends), moving) * linkage.metre


def _load_power(motion: Any, rates: _Rates) -> Iterator[tuple[Any, Any, Any]]:
    """Yield what each load takes from the input, its weight, and its rounding errors."""
    linkage = motion.mechanism.linkage
    blur, twist = rates.rounding(motion, "{}") * linkage.metre, rates.rounding(motion, "rad")
    for load in linkage.loads:
        body = linkage.body(load.on)
        arm, force = loaded(motion, load)
        u, v = components(getattr(motion, rates.points)[body.slider or body.joints[0]])
        turning = _turning(motion, rates, body)
        u, v = (u - turning * arm[1]) * linkage.metre, (v + turning * arm[0]) * linkage.metre
        weight = size(force) * size((u, v)) + abs(load.torque * turning)
        noise = ROUNDING * weight + size(force) * blur + abs(load.torque) * twist
        yield -(dot(force, (u, v)) + load.torque * turning), weight, noise


def _turning(motion: Any, rates: _Rates, body: Body) -> Any:
    """Return how fast a body turns: a block with the body that carries its line."""
    if body.slider is None:
        return getattr(motion, rates.turning)[body.name]
    axis = motion.mechanism.linkage.slides[body.slider].axis
    if axis is None:
        return 0.0
    apart = between(motion.position, axis)
    return over(cross(apart, between(getattr(motion, rates.points), axis)), dot(apart, apart))


class Demand(NamedTuple):
    """What one true period asks of the input: work (J), and its effort (N m, or N).

    The work is what dampers use up and loads take: springs and masses give back what they took.
    `peak` is the effort of the greatest size, `mean` that over time, both None where it is not bounded: its
    integral does not converge then, and no mean follows from the work, since the input turns back.
    """

    work: float
    peak: float | None
    mean: float | None


def usual_effort(solved: Callable[[Array], Any], phases: Array) -> float:
    """Return the median size of the effort at these phases of a true period; NaN where it is nowhere bounded.

    `solved` gives the motion at phases; where the effort is not bounded it does not count.
    """
    effort = np.concatenate([np.asarray(input_effort(solved(part))) for part in in_blocks(phases)])
    sizes = np.sort(np.abs(effort[np.isfinite(effort)]))
    # the median; numpy's own loads masked arrays at its first call
    return 0.5 * float(sizes[(sizes.size - 1) // 2] + sizes[sizes.size // 2]) if sizes.size else math.nan


def demand(solved: Callable[[Array], Any], phases: Array) -> Demand:
    """Return what a true period asks of the input; `phases` cover it from 0 at equal steps.

    `solved` gives the motion at phases. All phases have equal weight in a mean, which is exact to rounding
    for a smooth periodic function. Effort is unbounded only at an end of the input, which is among the
    phases.
    """
    parts = [_needs_of(cycle := solved(part)) for part in in_blocks(phases)]
    effort, used = (np.concatenate(rows) for rows in zip(*parts, strict=True))
    work = _mean(used) * len(phases) * float(phases[1]) / abs(float(cycle.input_speed))
    if not np.isfinite(effort).all():
        return Demand(work, None, None)
    peak = _peak(lambda near: np.asarray(input_effort(solved(near))), phases, effort)
    steady = np.ndim(cycle.coordinate_rate) == 0
    return Demand(work, peak, _mean(used) / float(cycle.coordinate_rate) if steady else _mean(effort))


def _needs_of(cycle: Any) -> tuple[Array, Array]:
    """Return the input's effort, and the power that dampers use up and loads take."""
    linkage, used = cycle.mechanism.linkage, 0.0 * np.asarray(cycle.phase)
    for item in linkage.dampers:
        if item.coefficient is not None and holding(linkage.rigid_bodies, item.between) is None:
            rate = as_output(cycle, cycle.damper[item.name].rate, "{}/s", 1) * linkage.metre
            used = used + item.coefficient * rate * rate
    for power, _, _ in _load_power(cycle, _MOVING):
        used = used + power
    return np.asarray(input_effort(cycle)), used


def _peak(effort: Callable[[Array], Array], phases: Array, known: Array) -> float:
    """Return the effort of the greatest size: each of the highest samples is followed to its own peak."""
    sizes = np.abs(known)
    tops = np.flatnonzero((sizes >= np.roll(sizes, 1)) & (sizes >= np.roll(sizes, -1)))
    tops = tops[np.argsort(-sizes[tops])][:_TOPS]
    places = [
        highest(lambda near: np.abs(effort(near)), phase, float(phases[1])) for phase in phases[tops].tolist()
    ]
    peaks = effort(np.array(places))
    return float(peaks[np.abs(peaks).argmax()])


def _mean(values: Array) -> float:
    """Return the mean, 0 where it is nothing but rounding errors."""
    mean = float(values.mean())
    return 0.0 if abs(mean) <= ROUNDING * float(np.abs(values).mean()) else mean
