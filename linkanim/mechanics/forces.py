"""What the input has to deliver: its torque, or the force of a cylinder or a slider that drives.

By the balance of power over all that the scene gives a force or a mass (the principle of virtual power;
Uicker, Pennock and Shigley, Theory of Machines and Mechanisms), tension F positive and y up,

    Q q' = Σ (m a·v + I α ω) + Σ m g v_y + Σ F dL/dt

where q is the crank's angle, the cylinder's length or the slider's travel, and Q its torque or its push.
Where everything rests for an instant, accelerations stand in for velocities, which are all in proportion to
q': v/q' = a/q".
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import NamedTuple
from linkanim.mechanics.linkage import Damper, Linkage, Spring, holding
from linkanim.mechanics.measures import (
    ROUNDING,
    between,
    components,
    force_rounding,
    growth,
    over,
    rounding_of,
    said,
    settled,
    size,
    stands,
)
from linkanim.mechanics.program import Array
from linkanim.mechanics.search import highest, in_blocks

_ROUNDING = 1e-13
"""A mean below this share of the mean size of its values is rounding."""
_ENDING = 1e-6
"""Within this phase of where the input turns back, the quotient of power and pace may have no digits."""
_IDLE = 1e-12
"""Power below this share of its terms is rounding."""
_ASIDE = 1e-3, (4.0, -6.0, 4.0, -1.0)
"""Where effort is 0/0: the steps of phase beside the place at which it is read instead, and their weights."""
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
    return _power(motion, _MOVING).total


def input_effort(motion: Any) -> Any:
    """Return the torque (N m) at the input, or the force (N) of a cylinder or a slider that drives.

    Positive where it turns the input on counter-clockwise, lengthens the cylinder or pushes the slider
    forward. Unbounded at a limit of the input that takes power; NaN where the input stands still and does not
    start to move either.
    """
    pace, power = _pace(motion, _MOVING), _power(motion, _MOVING)
    found = settled(over(power.total, pace), over(power.rounding, abs(pace)))
    if not motion.acceleration:
        return found
    second = _pace(motion, _STARTING)
    ends = np.abs(pace * motion.input_speed) <= _ENDING * np.abs(second)
    if not np.any(ends):
        return found
    stops = stands(motion)
    found = np.where(stops, np.inf, found)
    rests = stops & _rests(motion)
    begun = _power(motion, _STARTING)
    starting = settled(over(begun.total, second), over(begun.rounding, abs(second)))
    found = np.where(rests, starting, found)
    ends = np.asarray(ends & ~rests)
    return (_aside(motion, found, ends) if np.any(ends) else found)[()]


def _aside(motion: Any, effort: Array, ends: NDArray[np.bool_]) -> Array:
    """Return efforts, those next to an end of the input that takes no power extrapolated from beside it."""
    phase, speed, second = (
        np.broadcast_to(value, effort.shape)[ends]
        for value in (motion.phase, motion.input_speed, motion.input_acceleration)
    )
    end = math.pi * np.rint(phase / math.pi)
    solve = motion.mechanism.solve
    there = _power(solve(phase=end, speed=speed, acceleration=second), _MOVING)
    step, weights = _ASIDE
    inwards = np.where(phase < end, -step, step)
    read = [
        weight * input_effort(solve(phase=phase + n * inwards, speed=speed, acceleration=second))
        for n, weight in enumerate(weights, start=1)
    ]
    found = settled(sum(read), _IDLE * sum(map(np.abs, read)))
    idle = np.abs(there.total) <= _IDLE * there.weight
    effort[ends] = np.where(idle, found, effort[ends])
    return effort


class _Power(NamedTuple):
    """The power of all forces and inertia, in W, its weight, and its rounding errors.

    The weight is the sum of the terms' sizes, each as if everything moved at the input's speed as well.
    """

    total: Any
    weight: Any
    rounding: Any


def _power(motion: Any, rates: _Rates) -> _Power:
    """Return the power that forces and inertia take (W); from rest, the rate at which it grows (W/s)."""
    linkage = motion.mechanism.linkage
    struts = _strut_power(motion, rates, linkage.springs + linkage.dampers)
    nothing = 0.0 * motion.phase
    return _Power(
        *map(sum, zip((nothing, nothing, nothing), *struts, *_body_power(motion, rates), strict=True))
    )


def _strut_power(
    motion: Any, rates: _Rates, struts: Iterable[Spring | Damper]
) -> Iterator[tuple[Any, Any, Any]]:
    """Yield what each spring and damper takes, its weight, and its rounding errors."""
    linkage, points = motion.mechanism.linkage, getattr(motion, rates.points)
    metre, usual = linkage.metre, linkage.extent * abs(motion.input_speed)
    blur = rates.rounding(motion, "{}")
    for strut in struts:
        # a strut that keeps its length takes no power
        if strut.forceful and holding(linkage.rigid_bodies, strut.between) is None:
            kind = motion.damper if isinstance(strut, Damper) else motion.spring
            force, moving = kind[strut.name].force, between(points, strut.between)
            rate = growth(between(motion.position, strut.between), moving)
            speeds = sum(size(components(points[end])) for end in strut.between)
            noise = abs(force) * (ROUNDING * speeds + blur) + force_rounding(motion, strut) * abs(rate)
            yield force * metre * rate, abs(force) * metre * (size(moving) + usual), noise * metre


def _body_power(motion: Any, rates: _Rates) -> Iterator[tuple[Any, Any, Any]]:
    """Yield what each mass and each inertia takes, its weight, and its rounding errors."""
    linkage = motion.mechanism.linkage
    metre = linkage.metre
    jolt, jerk = rounding_of(motion, "{}/s²", 2) * metre, rounding_of(motion, "rad/s²", 2)
    blur, twist = rates.rounding(motion, "{}") * metre, rates.rounding(motion, "rad")
    usual = abs(motion.input_speed)
    for body in linkage.bodies:
        prefix, centre = ("com_", body.name) if body.slider is None else ("", body.slider)
        if body.mass is not None:
            u, v = components(getattr(motion, rates.centres if prefix else rates.points)[centre])
            a, b = components(getattr(motion, f"{prefix}acceleration")[centre])
            pull, moved = size((a, b)) * metre + abs(linkage.gravity), body.mass * metre * size((u, v))
            power = body.mass * metre * ((a * u + b * v) * metre + linkage.gravity * v)
            weight = (moved + body.mass * metre * linkage.extent * usual) * pull
            yield power, weight, moved * (ROUNDING * pull + jolt) + body.mass * blur * pull
        if body.inertia is not None:
            turning = body.inertia * getattr(motion, rates.turning)[body.name]
            gained = motion.angular_acceleration[body.name]
            weight = (abs(turning) + body.inertia * usual) * abs(gained)
            noise = abs(turning) * jerk + (ROUNDING * abs(turning) + body.inertia * twist) * abs(gained)
            yield turning * gained, weight, noise


def _pace(motion: Any, rates: _Rates) -> Any:
    """Return how fast the input moves, in rad/s; a cylinder's length, or a slider, in m/s."""
    linkage = motion.mechanism.linkage
    ends = linkage.drive.actuator.along
    if ends is None:
        rate = getattr(motion, rates.input)
        return rate if linkage.drive.coordinate.is_angle else rate * linkage.metre
    moving = between(getattr(motion, rates.points), ends)
    return growth(between(motion.position, ends), moving) * linkage.metre


def _rests(motion: Any) -> NDArray[np.bool_]:
    """Return at which instants no joint moves."""
    rounding = rounding_of(motion, "{}/s", 1)
    still = [size(components(velocity)) <= rounding for velocity in motion.velocity.values()]
    return np.asarray(np.all(still, axis=0))


class Demand(NamedTuple):
    """What one true period asks of the input: work (J), and its effort (N m, or N).

    The work is what dampers use up: springs and masses give back what they took.
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
    work = float(np.mean(used)) * len(phases) * float(phases[1]) / abs(float(cycle.input_speed))
    if not np.isfinite(effort).all():
        return Demand(work, None, None)
    peak = _peak(lambda near: np.asarray(input_effort(solved(near))), phases, effort)
    steady = np.ndim(cycle.coordinate_rate) == 0
    return Demand(work, peak, float(np.mean(used) / cycle.coordinate_rate) if steady else _mean(effort))


def _needs_of(cycle: Any) -> tuple[Array, Array]:
    """Return the input's effort, and the power that dampers use up."""
    linkage, used = cycle.mechanism.linkage, 0.0 * np.asarray(cycle.phase)
    for item in linkage.dampers:
        if item.coefficient is not None and holding(linkage.rigid_bodies, item.between) is None:
            rate = said(cycle, cycle.damper[item.name].rate, "{}/s", 1) * linkage.metre
            used = used + item.coefficient * rate * rate
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
    return 0.0 if abs(mean) <= _ROUNDING * float(np.abs(values).mean()) else mean
