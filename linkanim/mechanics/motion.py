"""What solving gives: the motion of every joint, body, centre of mass, spring and damper.

`Motion` holds arrays, `Pose` the same quantities of one instant as plain floats. Lengths are in the
scene's unit, angles in radians, time in seconds, forces in newtons (tension positive).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .assembly import Gearing
from .linkage import Body, Damper, Linkage, Spring

Array = NDArray[np.float64]
Pair = tuple[float, float]


class Strut(NamedTuple):
    """Length, its rate, and the force (None where it is not known) of a spring or damper."""

    length: Any
    rate: Any
    force: Any


@dataclass(frozen=True, slots=True)
class Setting:
    """What a motion needs of its linkage to tell angles and forces."""

    linkage: Linkage
    gears: Mapping[str, Gearing]

    def crank_of(self, body: Body) -> tuple[Gearing, bool] | None:
        """Return how a crank's body turns with the input, and whether it is named from its pin."""
        for crank in self.linkage.cranks:
            if crank.name in self.gears and body.joints[:2] in (
                (crank.pivot, crank.name),
                (crank.name, crank.pivot),
            ):
                return self.gears[crank.name], body.joints[0] == crank.name
        return None

    def body(self, name: str) -> Body:
        """Return the body of that name; KeyError where there is none."""
        return next(body for body in self.linkage.bodies if body.name == name)


def strut_of(
    item: Spring | Damper, metre: float, ends: tuple[Any, Any], rates: tuple[Any, Any] | None
) -> Strut:
    """Return length, rate and force between two points given as (x, y) pairs or arrays."""
    dx, dy = ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]
    length = (dx * dx + dy * dy) ** 0.5
    rate = None
    if rates is not None:
        rate = (dx * (rates[1][0] - rates[0][0]) + dy * (rates[1][1] - rates[0][1])) / length
    return Strut(length, rate, _force(item, metre, length, rate))


def _force(item: Spring | Damper, metre: float, length: Any, rate: Any) -> Any:
    if isinstance(item, Damper):
        known = item.coefficient is not None and rate is not None
        return item.coefficient * rate * metre if known else None
    if item.stiffness is None or item.free_length is None:
        return None
    return item.stiffness * (length - item.free_length) * metre


def coefficients(rate: Any, second: Any, input_rate: Any, input_second: Any) -> tuple[Any, Any]:
    """Return dq/dθ and d²q/dθ² from rates in time of q and of the input θ."""
    first = rate / input_rate
    return first, (second - first * input_second) / (input_rate * input_rate)


class Lazy(Mapping[str, Any]):
    """A mapping whose values are worked out when they are first asked for."""

    def __init__(self, names: tuple[str, ...], find: Callable[[str], Any]) -> None:
        self._names, self._find = names, find
        self._found: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._found:
            if name not in self._names:
                raise KeyError(name)
            self._found[name] = self._find(name)
        return self._found[name]

    def __iter__(self) -> Any:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


@dataclass(frozen=True)
class Motion:
    """The motion at many instants: vectors are arrays (..., 2), numbers (...).

    Rows outside the input's range are NaN. Rates that are truly unbounded (at a limit, per unit of
    input speed) are infinite.
    """

    setting: Setting
    phase: Array
    crank_angle: Array
    input_speed: Any
    input_acceleration: Any
    crank_rate: Any
    crank_second: Any
    position: Mapping[str, Array]
    velocity: Mapping[str, Array]
    acceleration: Mapping[str, Array]
    com_position: Mapping[str, Array]
    com_velocity: Mapping[str, Array]
    com_acceleration: Mapping[str, Array]
    angular_velocity: Mapping[str, Array]
    angular_acceleration: Mapping[str, Array]
    travel: Mapping[str, Array]
    travel_velocity: Mapping[str, Array]
    travel_acceleration: Mapping[str, Array]

    @cached_property
    def angle(self) -> Mapping[str, Array]:
        """Each body's angle, first -> second joint, without jumps along the first axis."""
        bodies = tuple(body.name for body in self.setting.linkage.bodies if body.slider is None)
        return Lazy(bodies, self._angle)

    def _angle(self, name: str) -> Array:
        body = self.setting.body(name)
        crank = self.setting.crank_of(body)
        if crank is not None:
            return np.asarray(_crank_angle(self.crank_angle, *crank))
        way = self.position[body.joints[1]] - self.position[body.joints[0]]
        principal: Array = np.arctan2(way[..., 1], way[..., 0])
        return principal if principal.ndim == 0 else self._unwrapped(principal, name)

    def _unwrapped(self, principal: Array, name: str) -> Array:
        """Add whole turns so that steps follow the angular velocity between neighbours."""
        predicted = np.zeros_like(principal)
        if name in self.angular_velocity and np.ndim(self.input_speed) == 0 and self.input_speed:
            pace = np.nan_to_num(self.angular_velocity[name] / self.input_speed, posinf=0.0, neginf=0.0)
            steps = np.diff(self.phase, axis=0) * (pace[1:] + pace[:-1]) / 2
            predicted[1:] = np.cumsum(steps, axis=0)
        rest: Array = np.unwrap(principal - predicted, axis=0) + predicted
        return rest

    @cached_property
    def coefficient(self) -> Mapping[str, tuple[Array, Array]]:
        """Each body's kinematic coefficients, (dq/dθ, d²q/dθ²) with q its angle or travel."""
        names = (*self.angular_acceleration, *self.travel_acceleration)
        return Lazy(names, self._coefficient)

    def _coefficient(self, name: str) -> tuple[Array, Array]:
        turns = name in self.angular_velocity
        rate = (self.angular_velocity if turns else self.travel_velocity)[name]
        second = (self.angular_acceleration if turns else self.travel_acceleration)[name]
        with np.errstate(divide="ignore", invalid="ignore"):
            return coefficients(rate, second, self.crank_rate, self.crank_second)

    @cached_property
    def spring(self) -> Mapping[str, Strut]:
        """Each spring's length, rate and force."""
        return self._struts(self.setting.linkage.springs)

    @cached_property
    def damper(self) -> Mapping[str, Strut]:
        """Each damper's length, rate and force."""
        return self._struts(self.setting.linkage.dampers)

    def _struts(self, items: tuple[Spring, ...] | tuple[Damper, ...]) -> Mapping[str, Strut]:
        by_name = {item.name: item for item in items}

        def find(name: str) -> Strut:
            ends = tuple(np.moveaxis(self.position[joint], -1, 0) for joint in by_name[name].between)
            rates = None
            if self.velocity:
                rates = tuple(np.moveaxis(self.velocity[joint], -1, 0) for joint in by_name[name].between)
            return strut_of(by_name[name], self.setting.linkage.metre, ends, rates)  # type: ignore[arg-type]

        return Lazy(tuple(by_name), find)


def _crank_angle(input_angle: Any, gearing: Gearing, from_pin: bool) -> Any:
    angle = input_angle * float(gearing.ratio) + float(gearing.offset)
    return angle + math.pi if from_pin else angle


class Pose:
    """The motion at one instant, as plain floats and (x, y) tuples; the attributes are Motion's."""

    __slots__ = (
        "_angles",
        "acceleration",
        "angular_acceleration",
        "angular_velocity",
        "com_acceleration",
        "com_position",
        "com_velocity",
        "crank_angle",
        "crank_rate",
        "crank_second",
        "input_acceleration",
        "input_speed",
        "phase",
        "position",
        "setting",
        "travel",
        "travel_acceleration",
        "travel_velocity",
        "velocity",
    )

    def __init__(self, setting: Setting, drive: tuple[float, float, float], found: tuple[Any, ...]) -> None:
        self.setting = setting
        self.phase, self.input_speed, self.input_acceleration = drive
        (
            (self.crank_angle, self.crank_rate, self.crank_second),
            self.position,
            self.velocity,
            self.acceleration,
            self.com_position,
            self.com_velocity,
            self.com_acceleration,
            self.angular_velocity,
            self.angular_acceleration,
            self.travel,
            self.travel_velocity,
            self.travel_acceleration,
        ) = found

    position: dict[str, Pair]
    velocity: dict[str, Pair]
    acceleration: dict[str, Pair]
    com_position: dict[str, Pair]
    com_velocity: dict[str, Pair]
    com_acceleration: dict[str, Pair]
    angular_velocity: dict[str, float]
    angular_acceleration: dict[str, float]
    travel: dict[str, float]
    travel_velocity: dict[str, float]
    travel_acceleration: dict[str, float]
    crank_angle: float
    crank_rate: float
    crank_second: float

    @property
    def angle(self) -> dict[str, float]:
        """Each body's angle; a crank's own angle is not brought into one turn, the others' are."""
        bodies = self.setting.linkage.bodies
        return {body.name: self._angle(body) for body in bodies if body.slider is None}

    def _angle(self, body: Body) -> float:
        crank = self.setting.crank_of(body)
        if crank is not None:
            return float(_crank_angle(self.crank_angle, *crank))
        (x0, y0), (x1, y1) = self.position[body.joints[0]], self.position[body.joints[1]]
        return math.atan2(y1 - y0, x1 - x0)

    @property
    def coefficient(self) -> dict[str, tuple[float, float]]:
        """Each body's kinematic coefficients; infinite at a limit of the input."""
        rates = {**self.angular_velocity, **self.travel_velocity}
        seconds = {**self.angular_acceleration, **self.travel_acceleration}
        return {name: self._coefficient(rates[name], seconds[name]) for name in seconds}

    def _coefficient(self, rate: float, second: float) -> tuple[float, float]:
        if self.crank_rate == 0:
            return math.inf, math.inf
        return coefficients(rate, second, self.crank_rate, self.crank_second)

    @property
    def spring(self) -> dict[str, Strut]:
        """Each spring's length, rate and force."""
        return {item.name: self._strut(item) for item in self.setting.linkage.springs}

    @property
    def damper(self) -> dict[str, Strut]:
        """Each damper's length, rate and force."""
        return {item.name: self._strut(item) for item in self.setting.linkage.dampers}

    def _strut(self, item: Spring | Damper) -> Strut:
        a, b = item.between
        rates = (self.velocity[a], self.velocity[b]) if self.velocity else None
        return strut_of(item, self.setting.linkage.metre, (self.position[a], self.position[b]), rates)
