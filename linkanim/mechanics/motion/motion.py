"""What solving gives: the motion of every joint, body, centre of mass, spring and damper.

`Motion` holds arrays, `Pose` the same quantities of one instant as plain floats. Lengths are in the
scene's unit, angles in radians, time in seconds, forces in newtons (tension positive).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import FrozenInstanceError
from functools import cached_property, partial
from types import MappingProxyType
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.mechanics.closing.walk import Assembly
from linkanim.mechanics.drive.input_path import LimitDistances
from linkanim.mechanics.formulas.program import Array, Batch
from linkanim.mechanics.linkage.linkage import Body, Damper, Linkage, Spring
from linkanim.mechanics.loops.loop import Gearing
from linkanim.mechanics.motion.columns import Lazy, ResultLayout, columns, read_only, scaled, turned
from linkanim.mechanics.motion.measures import (
    DERIVATIVE_OF,
    FAMILIES,
    between,
    cross,
    direction,
    growth,
    over,
    size,
)
from linkanim.mechanics.motion.settled import unbounded

COORDINATE = ("coordinate", "coordinate_rate", "coordinate_second")
"""The input's angle, or travel, and its rates: one that does not turn fully moves in its own way."""
Pair = tuple[float, float]
NOTHING: Mapping[str, Any] = MappingProxyType({})
LOWER = {kind: family[:n] for family in FAMILIES for n, kind in enumerate(family)}
"""The quantities of its family with fewer derivatives, of each."""
ORDER: Mapping[str, int] = {**DERIVATIVE_OF, **dict(zip(COORDINATE, range(3), strict=True)), "phase": 0}


class Variant(NamedTuple):
    """One way of asking: by phase or by angle, whether the input accelerates, each instant on its own.

    `per_input`: at phases, with rates by the input's angle, or travel, instead of those in time.
    """

    by_phase: bool
    accelerates: bool
    varying_rate: bool = False
    per_input: bool = False


class Strut(NamedTuple):
    """Length, its rate, and the force (None where it is not known) of a spring or damper; its direction.

    The direction is that of its first joint to its second, the rate of it in rad/s; where they meet both are
    NaN, and the rate of the length is that with which it is about to grow.
    """

    length: Any
    rate: Any
    force: Any
    direction: Any
    direction_rate: Any


class Instants(NamedTuple):
    """Instants (N,) with rates w and a, the shape in which to answer, and how many derivatives at most.

    `distances` are those of angles of an input that swings from its limits; `phases` those of one that comes
    back by the way it came, where x are the phases of its way up, and `back` where it is on its way back, at
    rates of the other sign.
    """

    variant: Variant
    x: Array
    distances: LimitDistances | None
    rates: tuple[Any, Any]
    shape: tuple[int, ...]
    derivatives: int
    phases: Array | None = None
    back: NDArray[np.bool_] | None = None


class Setting(ABC):
    """What motions and poses of one linkage share: it, and what solves it."""

    linkage: Linkage
    assembly: Assembly

    @abstractmethod
    def program(self, variant: Variant, kinds: tuple[str, ...]) -> tuple[Batch, ResultLayout]:
        """Return the program over arrays that works quantities out, and where its results lie."""

    @abstractmethod
    def solve(
        self, *, phase: ArrayLike, speed: ArrayLike, acceleration: ArrayLike = ..., derivatives: int = ...
    ) -> Motion:
        """Return the motion at phases."""

    @abstractmethod
    def pose_per_input(self, phase: float) -> Pose:
        """Return one instant, its rates by the input's angle, or travel, instead of those in time."""

    def crank_of(self, body: Body) -> tuple[Gearing, bool] | None:
        """Return how a crank's body turns with the input, and whether it is named from its pin."""
        crank = self.linkage.crank_of(body)
        return (self.assembly.gears[crank.name], body.joints[0] == crank.name) if crank else None

    def body(self, name: str) -> Body:
        """Return the body of that name; KeyError where there is none."""
        return next(body for body in self.linkage.bodies if body.name == name)


Vector = TypeVar("Vector")
Number = TypeVar("Number")


class Derived(ABC, Generic[Vector, Number]):
    """What is solved, for a motion and a pose alike, and what follows from it; vectors are x and y.

    `coordinate` is the input's: its angle, or a driving slider's travel.
    """

    setting: Setting
    position: Mapping[str, Vector]
    velocity: Mapping[str, Vector]
    acceleration: Mapping[str, Vector]
    com_position: Mapping[str, Vector]
    com_velocity: Mapping[str, Vector]
    com_acceleration: Mapping[str, Vector]
    angular_velocity: Mapping[str, Number]
    angular_acceleration: Mapping[str, Number]
    travel: Mapping[str, Number]
    travel_velocity: Mapping[str, Number]
    travel_acceleration: Mapping[str, Number]
    phase: Number
    input_speed: Any
    input_acceleration: Any
    coordinate: Number
    coordinate_rate: Any
    coordinate_second: Any

    @property
    def crank_angle(self) -> Any:
        """The angle of the bar that is driven; AttributeError where a slider drives, which has none."""
        if not self.setting.linkage.drive.coordinate.is_angle:
            raise AttributeError  # which asks __getattr__ for it
        return self.coordinate

    def _missing(self, what: str, name: str) -> AttributeError:
        """Return what is raised for an attribute that `what` has not."""
        if name == "crank_angle":
            return AttributeError("a slider drives, which has no crank angle; read coordinate")
        return AttributeError(f"{what} has no {name!r}")

    @cached_property
    def angle(self) -> Mapping[str, Any]:
        """Each body's angle, first -> second joint.

        A crank's own angle counts its turns. The others' are in one turn at one instant, and of many
        instants without jumps along the first axis.
        """
        bodies = tuple(body.name for body in self.setting.linkage.bodies if body.slider is None)
        return Lazy(bodies, self._angle)

    def _angle(self, name: str) -> Any:
        body = self.setting.body(name)
        crank = self.setting.crank_of(body)
        if crank is not None:
            return _crank_angle(self.coordinate, self.phase, *crank)
        return self._continuous((body.joints[0], body.joints[1]))

    @abstractmethod
    def _continuous(self, ends: tuple[str, str]) -> Any:
        """Return the angle of the way from one joint to another; NaN where they meet."""

    @cached_property
    def coefficient(self) -> Mapping[str, tuple[Any, Any]]:
        """Each body's kinematic coefficients, (dq/dθ, d²q/dθ²) with q its angle or travel.

        They are the rates by the input's angle, or a driving slider's travel: at any speed the same. Infinite
        where a limit of the input leaves them unbounded.
        """
        known = self.per_input
        return Lazy((*known.angular_acceleration, *known.travel_acceleration), self._coefficient)

    def _coefficient(self, name: str) -> tuple[Any, Any]:
        known = self.per_input
        if name in known.angular_velocity:
            rates = known.angular_velocity[name], known.angular_acceleration[name]
        else:
            rates = known.travel_velocity[name], known.travel_acceleration[name]
        return unbounded(rates[0], self.phase), unbounded(rates[1], self.phase)

    @property
    @abstractmethod
    def per_input(self) -> Derived[Vector, Number]:
        """The same instants, with rates by the input's angle, or travel, instead of those in time."""

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
        return Lazy(tuple(by_name), lambda name: self._strut(by_name[name]))

    def _strut(self, item: Spring | Damper) -> Strut:
        apart = between(self.position, item.between)
        length, rate, turning = size(apart), None, None
        if self.velocity:
            moving = between(self.velocity, item.between)
            rate, turning = growth(apart, moving), over(cross(apart, moving), length * length)
        force = _force(item, self.setting.linkage.metre, length, rate)
        return Strut(length, rate, force, self._continuous(item.between), turning)


def _force(item: Spring | Damper, metre: float, length: Any, rate: Any) -> Any:
    if isinstance(item, Damper):
        known = item.coefficient is not None and rate is not None
        return item.coefficient * rate * metre if known else None
    if item.stiffness is None or item.free_length is None:
        return None
    return item.stiffness * (length - item.free_length) * metre


class Motion(Derived[Array, Array]):
    """The motion at many instants: vectors are arrays (..., 2), numbers (...).

    Rows outside the input's range are NaN, their phase too. Rates that are truly unbounded (at a
    limit, per unit of input speed) are infinite. Each quantity is worked out when it is first read.
    """

    instants: Instants

    def __init__(
        self, setting: Setting, input_speed: Any, input_acceleration: Any, instants: Instants
    ) -> None:
        vars(self).update(
            setting=setting, input_speed=input_speed, input_acceleration=input_acceleration, instants=instants
        )

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle as what was asked for, which is worked out anew."""
        return Motion, (self.setting, self.input_speed, self.input_acceleration, self.instants)

    def __getattr__(self, name: str) -> Any:
        """Work a quantity out, with those that come out of the same pass."""
        if name not in ORDER:
            raise self._missing("a motion", name)
        vars(self).update(self._read(name))
        return vars(self)[name]

    def __setattr__(self, name: str, value: Any) -> None:
        raise FrozenInstanceError(f"a motion is what was solved: its {name} cannot be set")

    def _read(self, name: str) -> dict[str, Any]:
        """Return a quantity with what comes out of the same pass, but for what is known."""
        if name not in DERIVATIVE_OF:
            return self._input()
        if DERIVATIVE_OF[name] > self.instants.derivatives:
            return {name: {}}
        return self._worked_out((*[kind for kind in LOWER[name] if kind not in vars(self)], name))

    @property
    def every(self) -> Mapping[str, Mapping[str, Array]]:
        """All quantities by kind and name, from one pass."""
        kinds: dict[str, Any] = {kind: {} for family in FAMILIES for kind in family}
        known = (kind for kind in kinds if DERIVATIVE_OF[kind] <= self.instants.derivatives)
        return kinds | self._worked_out(tuple(known))

    def _worked_out(self, kinds: tuple[str, ...]) -> dict[str, Any]:
        """Return these quantities."""
        places, results = self._run(kinds)
        return {kind: columns(names, results, self.instants.shape) for kind, names in places.places.items()}

    def _run(self, kinds: tuple[str, ...]) -> tuple[ResultLayout, Array]:
        instants, path = self.instants, self.setting.assembly.path
        program, places = self.setting.program(instants.variant, kinds)
        rates = instants.rates if instants.variant.accelerates else instants.rates[:1]
        ways = instants.distances
        with np.errstate(all="ignore"):
            results = program(*((instants.x,) if ways is None else path.solved_from(ways)), *rates)
            if instants.back is not None and instants.back.any():
                results[:, instants.back] = program(instants.x[instants.back], *(-rate for rate in rates))
            if ways is not None:
                results[:, ways.outside] = np.nan
                if ways.at_limit.any() and any(map(DERIVATIVE_OF.__getitem__, kinds)):
                    snapped = program(*path.solved_from(ways.snapped), *rates)
                    _mark_limits(places, results, snapped, ways.at_limit)
        results.setflags(write=False)
        return places, results

    def _input(self) -> dict[str, Any]:
        """Return the phase, and the input's coordinate with its two rates."""
        instants, path, names = self.instants, self.setting.assembly.path, ("phase", *COORDINATE)
        x, rates = instants.x.reshape(instants.shape), (self.input_speed, self.input_acceleration)
        if not instants.variant.by_phase:
            with np.errstate(all="ignore"):
                return dict(
                    zip(names, (read_only(path.phases(x, instants.distances)), x, *rates), strict=True)
                )
        if path.full_turn:
            return dict(zip(names, (x, read_only(path.coordinates(x)), *rates), strict=True))
        places, results = self._run(COORDINATE)
        shown = x if instants.phases is None else instants.phases.reshape(instants.shape)
        return {"phase": shown} | {
            kind: row.reshape(instants.shape) for kind, row in zip(places.kinds, results, strict=True)
        }

    @cached_property
    def per_input(self) -> Motion:
        """The same instants, with rates by the input's angle, or travel, instead of those in time."""
        by_phase = self.instants.variant.by_phase
        variant = Variant(by_phase, False, per_input=by_phase and not self.setting.assembly.path.full_turn)
        instants = self.instants._replace(variant=variant, rates=(1.0, 0.0), back=None)
        return Motion(self.setting, 1.0, 0.0, instants)

    def paced(self, factor: float) -> Motion:
        """Return the same motion run so many times as fast; backwards where the factor is negative.

        Nothing is solved: first derivatives in time grow with the factor, second ones with its square.
        """
        return _Paced(self, factor)

    def _continuous(self, ends: tuple[str, str]) -> Array:
        principal: Array = np.asarray(direction(between(self.position, ends)))
        return principal if principal.ndim == 0 else self._unwrapped(principal, ends)

    def _unwrapped(self, principal: Array, ends: tuple[str, str]) -> Array:
        """Add whole turns, as a direction has turned between neighbours."""
        steps = np.diff(principal, axis=0)
        x, at = self.instants.x.reshape(principal.shape), partial(self._direction, ends)
        rows = [(values[:-1].reshape(-1), values[1:].reshape(-1)) for values in (x, principal)]
        ways = turned(rows[0], rows[1], at, self.setting.assembly.quickest)
        turns = np.rint((ways.reshape(steps.shape) - steps) / math.tau)
        whole = np.zeros_like(principal)
        np.cumsum(np.nan_to_num(turns), axis=0, out=whole[1:])
        return principal + math.tau * (whole - _before_stretch(whole, np.isnan(principal)))

    def _direction(self, ends: tuple[str, str], x: Array) -> Array:
        """Return the direction of one joint to another at other instants."""
        distances = self.instants.distances and self.setting.assembly.path.distances(x)
        w, a = (np.ones_like(x) if isinstance(rate, np.ndarray) else rate for rate in self.instants.rates)
        instants = self.instants._replace(x=x, distances=distances, rates=(w, a), shape=x.shape, back=None)
        found = Motion(self.setting, 1.0, 0.0, instants).position
        return np.asarray(direction(between(found, ends)))


class _Paced(Motion):
    """A motion run so many times as fast: its quantities, each times its power of the factor."""

    def __init__(self, motion: Motion, factor: float) -> None:
        speed, acceleration = motion.input_speed * factor, motion.input_acceleration * factor**2
        super().__init__(motion.setting, speed, acceleration, motion.instants)
        vars(self).update(motion=motion, factor=factor, per_input=motion.per_input)

    def __reduce__(self) -> tuple[Any, ...]:
        return _Paced, (self.motion, self.factor)

    def _read(self, name: str) -> dict[str, Any]:
        found, power = getattr(self.motion, name), self.factor ** ORDER[name]
        if not ORDER[name]:
            return {name: found}
        return {name: scaled(found, power) if name in DERIVATIVE_OF else read_only(found * power)}


def _mark_limits(places: ResultLayout, results: Array, snapped: Array, at_limit: NDArray[np.bool_]) -> None:
    """Give rates the values they have at the limit itself: infinite where they are unbounded."""
    for row, kind in enumerate(places.kinds):
        if DERIVATIVE_OF[kind]:
            values = snapped[row, at_limit]
            results[row, at_limit] = np.where(np.isnan(values), np.inf, values)


def _before_stretch(whole: Array, gap: NDArray[np.bool_]) -> Array:
    """Return for each row what stood in the last row of the gap before it, 0 where there is none."""
    rows = np.arange(len(gap)).reshape(-1, *[1] * (gap.ndim - 1))
    last = np.maximum.accumulate(np.where(gap, rows, -1), axis=0)
    return np.where(last < 0, 0.0, np.take_along_axis(whole, np.maximum(last, 0), axis=0))


def _crank_angle(input_angle: Any, phase: Any, gearing: Gearing, from_pin: bool) -> Any:
    """Return a crank's angle; NaN where there is no phase."""
    angle = input_angle * float(gearing.ratio) + float(gearing.offset)
    return (angle + math.pi if from_pin else angle) + 0.0 * phase


class Pose(Derived[Pair, float]):
    """The motion at one instant, as plain floats and (x, y) tuples; the attributes are Motion's."""

    def __init__(self, found: dict[str, Any]) -> None:
        self.__dict__ = found

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle as what was solved, without what follows from it."""
        kinds = (*ORDER, "setting", "input_speed", "input_acceleration")
        return Pose, ({kind: vars(self)[kind] for kind in kinds if kind in vars(self)},)

    def __getattr__(self, name: str) -> Any:
        """Return nothing of a kind that was not solved."""
        if name not in DERIVATIVE_OF:
            raise self._missing("a pose", name)
        return NOTHING

    @cached_property
    def per_input(self) -> Pose:
        """The same instant, with rates by the input's angle, or travel, instead of those in time."""
        rated = self.angular_acceleration or self.travel_acceleration
        return self.setting.pose_per_input(self.phase) if rated else self

    def _continuous(self, ends: tuple[str, str]) -> float:
        return float(direction(between(self.position, ends)))
