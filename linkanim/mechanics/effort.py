"""What the input has to deliver: its torque, or the force of a cylinder or a slider that drives.

By the balance of power over all that the scene gives a force or a mass (the principle of virtual power;
Uicker, Pennock and Shigley, Theory of Machines and Mechanisms), tension F positive and y up,

    Q q' = Σ (m a·v + I α ω) + Σ m g v_y + Σ F dL/dt

where q is the crank's angle, the cylinder's length or the slider's travel, and Q its torque or its push.
Where everything rests for an instant all velocities are in proportion to q', and accelerations stand for
them: v/q' = a/q".
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .derived import as_complex, over
from .linkage import Damper, Linkage, Spring
from .search import highest

Array = NDArray[np.float64]

_SAMPLES = 1440
"""For each period of the drive."""
_ROUNDING = 1e-13
"""A mean below this share of what it is the mean of is rounding."""
_BOUNDED = 1e-9
"""A limit of the input asks for no more than a bounded torque where power there is below this share."""
_ASIDE = 1e-4
"""So far from a limit, in radians of phase, a torque is read that is rounding over 0 at the limit itself."""


class _Way(NamedTuple):
    """Under which names a motion holds how everything moves."""

    points: str
    centres: str
    turning: str
    crank: str


_MOVING = _Way("velocity", "com_velocity", "angular_velocity", "crank_rate")
_STARTING = _Way("acceleration", "com_acceleration", "angular_acceleration", "crank_second")


def effort_token(linkage: Linkage) -> str:
    """Return the token of the effort at the input: a force of a cylinder or slider, a torque of a crank."""
    return "input.force" if linkage.drive.cylinder or linkage.slides else "input.torque"


def input_power(motion: Any) -> Any:
    """Return the power (W) that the input delivers; needs second derivatives where anything has a mass."""
    return _power(motion, _MOVING)


def input_effort(motion: Any) -> Any:
    """Return the torque (N m) at the input, or the force (N) of a cylinder or a slider that drives.

    Positive where it turns the input on counter-clockwise, lengthens the cylinder or pushes the slider
    forward. Unbounded at a limit of the input; NaN where the input stands still and does not start to move
    either.
    """
    pace = _pace(motion, _MOVING)
    found = over(_power(motion, _MOVING), pace)
    rests = np.asarray(pace) == 0
    if not rests.any() or not motion.acceleration:
        return found
    rests = rests & _rests(motion)
    return np.where(rests, over(_power(motion, _STARTING), _pace(motion, _STARTING)), found)[()]


def _power(motion: Any, way: _Way) -> Any:
    """Return what forces and inertia take, in W; of what starts from rest per second."""
    linkage, total = motion.setting.linkage, 0.0 * motion.phase
    for strut in linkage.springs + linkage.dampers:
        if strut.forceful:
            kind = motion.damper if isinstance(strut, Damper) else motion.spring
            total = total + kind[strut.name].force * _lengthening(motion, strut, way) * linkage.metre
    for body in linkage.bodies:
        prefix, centre = ("com_", body.name) if body.slider is None else ("", body.slider)
        if body.mass is not None:
            velocity = as_complex(getattr(motion, way.centres if prefix else way.points)[centre])
            pull = as_complex(getattr(motion, f"{prefix}acceleration")[centre]) * linkage.metre
            lift = (pull.conjugate() * velocity).real + linkage.gravity * velocity.imag
            total = total + body.mass * lift * linkage.metre
        if body.inertia is not None:
            turning = getattr(motion, way.turning)[body.name]
            total = total + body.inertia * motion.angular_acceleration[body.name] * turning
    return total


def _pace(motion: Any, way: _Way) -> Any:
    """Return how fast the input moves, in rad/s; a cylinder's length, or a slider, in m/s."""
    linkage = motion.setting.linkage
    if linkage.slides:
        return getattr(motion, way.crank) * linkage.metre
    if linkage.drive.cylinder is None:
        return getattr(motion, way.crank)
    along = Spring("cylinder", linkage.drive.cylinder.between)
    return _lengthening(motion, along, way) * linkage.metre


def _lengthening(motion: Any, strut: Spring | Damper, way: _Way) -> Any:
    """Return how fast a strut grows in the scene's unit, or begins to where it rests."""
    start, end = (as_complex(motion.position[joint]) for joint in strut.between)
    first, last = (as_complex(getattr(motion, way.points)[joint]) for joint in strut.between)
    return over(((end - start).conjugate() * (last - first)).real, abs(end - start))


def _rests(motion: Any) -> NDArray[np.bool_]:
    """Return at which instants no joint moves."""
    still = [np.asarray(as_complex(velocity) == 0) for velocity in motion.velocity.values()]
    return np.asarray(np.all(still, axis=0))


class Demand(NamedTuple):
    """What one true period asks of the input: work (J), and its effort (N m, or N).

    `peak` is the effort of the greatest size, `mean` that over time, both None where it is not bounded.
    """

    work: float
    peak: float | None
    mean: float | None


def usual_effort(solved: Callable[[Array], Any], periods: int) -> float:
    """Return the size that the effort has half of a true period of so many drive periods; NaN without one.

    `solved` gives the motion at phases; where the effort is not bounded it does not count.
    """
    effort = np.asarray(input_effort(solved(_phases(periods))))
    sizes = np.sort(np.abs(effort[np.isfinite(effort)]))
    # the median; numpy's own loads masked arrays at its first call
    return 0.5 * float(sizes[(sizes.size - 1) // 2] + sizes[sizes.size // 2]) if sizes.size else math.nan


def demand(solved: Callable[[Array], Any], periods: int, *, limited: bool) -> Demand:
    """Return what a true period of so many drive periods asks; `solved` gives the motion at phases.

    Where the input is `limited` its ends are limits. The work is that of equal weights on a closed curve,
    which lose nothing of a smooth one.
    """
    phases = _phases(periods)
    cycle = solved(phases)
    power, effort = input_power(cycle), np.array(input_effort(cycle), dtype=np.float64)
    seconds = math.tau * periods / abs(float(cycle.input_speed))
    work = _mean(power) * seconds
    idle = np.abs(power) <= _BOUNDED * np.abs(power).max()
    rounded = idle & np.isinf(effort)
    if rounded.any():
        effort[rounded] = input_effort(solved(phases[rounded] + _ASIDE))
    if (limited and not idle[:: _SAMPLES // 2].all()) or not np.isfinite(effort).all():
        return Demand(work, None, None)
    index = int(np.abs(effort).argmax())
    sign = math.copysign(1.0, effort[index])
    ends = (-math.inf, math.inf)
    step = float(phases[1])
    place = highest(lambda near: sign * input_effort(solved(near)), float(phases[index]), step, ends)
    peak = float(input_effort(solved(np.array([place])))[0])
    return Demand(work, peak, _mean(effort))


def _phases(periods: int) -> Array:
    """Return phases at which a true period is looked at."""
    count = _SAMPLES * periods
    phases: Array = np.arange(count, dtype=np.float64) * (math.tau * periods / count)
    return phases


def _mean(values: Array) -> float:
    """Return the mean, 0 where it is nothing but rounding errors."""
    mean = float(values.mean())
    return 0.0 if abs(mean) <= _ROUNDING * float(np.abs(values).mean()) else mean
