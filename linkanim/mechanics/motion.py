"""Solve a linkage: the mechanism made ready, its motion in arrays, its pose in floats.

Its parts, in reading order:

- Where solved quantities lie in rows, and how they are read from there.
- What solving gives: the motion of every joint, body, centre of mass, spring and damper.
- A linkage made ready to be solved: assembled once, its programs compiled when first needed.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import FrozenInstanceError, replace
from functools import cached_property, lru_cache, partial
from types import MappingProxyType
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.errors import AssemblyError
from linkanim.frozen import frozen
from linkanim.mechanics.arithmetic import Graph, Slope, Value
from linkanim.mechanics.linkage import Body, CrankTriangle, Damper, Linkage, Spring
from linkanim.mechanics.measures import (
    DERIVATIVE_OF,
    LEVER,
    NUMBERS,
    VECTORS,
    FarPositions,
    between,
    cross,
    direction,
    growth,
    near,
    over,
    size,
    unbounded,
)
from linkanim.mechanics.program import Array, Batch, batch, scalar
from linkanim.mechanics.reactions import Reactions, reactions
from linkanim.mechanics.search import around
from linkanim.mechanics.solver import limits
from linkanim.mechanics.solver.assembly import assemble, starts
from linkanim.mechanics.solver.closing import Assembly, Walk, walked
from linkanim.mechanics.solver.input import InputState, LimitDistances, retraced
from linkanim.mechanics.solver.limits import Separations, open_places, separations
from linkanim.mechanics.solver.loop import Gearing
from linkanim.mechanics.tolerances import SAME_PLACE

# Where solved quantities lie in rows, and how they are read from there.
#
# How far a direction turns from instant to instant follows from directions alone, not from rates, which grow
# without bound near a dead centre. Between two directions less than half a turn apart the turn is known, so
# further instants are put between neighbours until these are close in the input and in direction.

COORDINATE = ("coordinate", "coordinate_rate", "coordinate_second")
"""The input's angle, or travel, and its two rates, which are not the phase's where it does not turn fully."""
ORDER: Mapping[str, int] = {**DERIVATIVE_OF, **dict(zip(COORDINATE, range(3), strict=True))}
POINTS = VECTORS[:3]

Pair = tuple[float, float]


class ResultPlaces(NamedTuple):
    """Where quantities by kind and name lie in rows of results, those of vectors before those of numbers.

    A place counts vectors, each of two rows, or the numbers behind them; a pin's is its pair. `rated` are the
    rows of rates and of levers, which may be unbounded at a limit.
    """

    places: Mapping[str, Mapping[str, int | Array]]
    vectors: int
    rated: NDArray[np.bool_]


def laid_out(
    rows: Mapping[str, Mapping[str, tuple[Value, ...]]], pins: Mapping[str, Pair]
) -> tuple[ResultPlaces, list[Value]]:
    """Return where quantities by kind and name lie, and what the rows hold.

    `pins` gives where pins stand; their rates are zero.
    """
    places: dict[str, dict[str, int | Array]] = {kind: {} for kind in rows}
    outputs: list[Value] = []
    rated: list[bool] = []
    vectors = 0
    for kind in sorted(rows, key=lambda kind: kind not in VECTORS):
        for name, components in rows[kind].items():
            if name in pins and kind in POINTS:
                places[kind][name] = read_only(np.array((0.0, 0.0) if ORDER[kind] else pins[name]))
                continue
            places[kind][name] = vectors if kind in VECTORS else len(outputs) - 2 * vectors
            vectors += kind in VECTORS
            outputs.extend(components)
            rated.extend([kind == LEVER or ORDER[kind] > 0] * len(components))
    return ResultPlaces(places, vectors, np.array(rated, bool)), outputs


def arrays(layout: ResultPlaces, results: Array, shape: tuple[int, ...], kind: str) -> dict[str, Array]:
    """Return the quantities of a kind by name: views of the results, and of the pairs of pins.

    A row for each component keeps every pass contiguous; (N, 2) is its transpose, not a copy.
    """
    places, vectors = layout.places[kind], layout.vectors
    if kind not in VECTORS:
        return {name: results[2 * vectors + rows].reshape(shape) for name, rows in places.items()}
    pairs = results[: 2 * vectors].reshape(vectors, 2, results.shape[1]).transpose(0, 2, 1)
    if len(shape) != 1:
        pairs = pairs.reshape(vectors, *shape, 2)
    still = (*[0] * len(shape), 8)
    return {
        name: pairs[rows] if isinstance(rows, int) else np.ndarray((*shape, 2), np.float64, rows, 0, still)
        for name, rows in places.items()
    }


def read_only(values: Any) -> Any:
    """Return an array, or a tuple of values, with its arrays made read-only."""
    if isinstance(values, tuple):
        for part in values:
            read_only(part)
    elif isinstance(values, np.ndarray):
        values.flags.writeable = False
    return values


_NEAR = math.pi / 2
_INPUT_STEP = math.pi / 6
_MOST_PARTS = 64
_HALVINGS = 60


def turned(
    inputs: tuple[Array, Array], angles: tuple[Array, Array], at: Callable[[Array], Array], ratio: float
) -> Array:
    """Return how far a direction turns on each of N ways from one instant to another, in radians (N,).

    `inputs` are the input's angles at the two instants, `angles` the direction's, whole turns left open; `at`
    gives the direction's angle at other inputs; `ratio` is how many times as fast as the input the quickest
    crank turns. 0 where an angle is NaN.
    """
    (low, high), (first, last) = inputs, angles
    row, total = np.arange(len(low)), np.zeros(len(low))
    near = np.maximum(_INPUT_STEP / ratio, np.abs(high - low) / _MOST_PARTS)
    for halving in range(_HALVINGS):
        step = _shortest(last - first)
        wide = (np.abs(step) > _NEAR) | (np.abs(high - low) > near[row])
        wide &= np.isfinite(step) & (halving < _HALVINGS - 1)
        between = (low + high) / 2
        middle = np.full_like(between, np.nan)
        middle[wide] = at(between[wide]) if wide.any() else []
        wide &= np.isfinite(middle)
        np.add.at(total, row[~wide], np.nan_to_num(step[~wide]))
        if not wide.any():
            break
        low, between, high = low[wide], between[wide], high[wide]
        first, middle, last, row = first[wide], middle[wide], last[wide], np.tile(row[wide], 2)
        low, high = np.concatenate([low, between]), np.concatenate([between, high])
        first, last = np.concatenate([first, middle]), np.concatenate([middle, last])
    return total


def _shortest(turn: Array) -> Array:
    """Return an angle less whole turns, at most half a turn either way."""
    shortest: Array = turn - math.tau * np.rint(turn / math.tau)
    return shortest


# What solving gives: the motion of every joint, body, centre of mass, spring and damper.
#
# `Motion` holds arrays, `Pose` the same quantities of one instant as plain floats. Lengths are in the
# scene's unit, angles in radians, time in seconds, forces in newtons (tension positive).

_PLACES = {VECTORS[0], VECTORS[3]}
NOTHING: Mapping[str, Any] = MappingProxyType({})


class Variant(NamedTuple):
    """One way of asking: by phase or by angle; whether the input accelerates; whether its rate varies.

    `per_input`: at phases, with rates by the input's angle, or travel, instead of those in time. `mover`:
    with rates by the way of that joint.
    """

    by_phase: bool
    accelerates: bool
    varying_rate: bool = False
    per_input: bool = False
    mover: str = ""


class Strut(NamedTuple):
    """Length, its rate, and the force (None where it is not known) of a spring or damper; its direction.

    The direction runs from its first joint to its second (rad), its rate is in rad/s. Where the joints meet,
    both are NaN, and the length's rate is that at which it is about to grow.
    """

    length: Any
    rate: Any
    force: Any
    direction: Any
    direction_rate: Any


class Asked(NamedTuple):
    """What a motion is solved for: instants (N,) and the input's `rates`, in a shape, up to derivatives.

    Of `joints`, if any are named, positions, velocities and accelerations are solved and nothing else.
    `distances` tells, for the angles of an input that swings, how far they are from its limits. Where the
    input comes back through the same poses, `phases` are the phases asked for, `x` those of the same poses on
    the way up, and `back` says which are on the way back: there the rates have the other sign.
    """

    variant: Variant
    x: Array
    rates: tuple[Any, Any]
    shape: tuple[int, ...]
    derivatives: int
    joints: tuple[str, ...] | None = None
    distances: LimitDistances | None = None
    phases: Array | None = None
    back: NDArray[np.bool_] | None = None


Vector = TypeVar("Vector")
Number = TypeVar("Number")


class Derived(ABC, Generic[Vector, Number]):
    """What a motion and a pose have in common: solved quantities, and those that follow from them.

    `coordinate` is the input's: its angle, or a driving slider's travel.
    """

    mechanism: Mechanism
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
    lever: Mapping[str, Number]
    phase: Number
    input_speed: Any
    input_acceleration: Any
    coordinate: Number
    coordinate_rate: Any
    coordinate_second: Any

    @property
    def crank_angle(self) -> Any:
        """The angle of the bar that is driven; AttributeError where a slider drives, which has none."""
        if not self.mechanism.linkage.drive.coordinate.is_angle:
            raise AttributeError  # which asks __getattr__ for it
        return self.coordinate

    def _missing(self, what: str, name: str) -> AttributeError:
        """Return the error for an attribute that `what` does not have."""
        if name == "crank_angle":
            return AttributeError("a slider drives, which has no crank angle; read coordinate")
        return AttributeError(f"{what} has no {name!r}")

    @cached_property
    def angle(self) -> Mapping[str, Any]:
        """Each body's angle, first -> second joint.

        A crank's own angle counts its turns. Any other body's angle lies within one turn at a single instant;
        over many instants it has no jumps along the first axis.
        """
        bodies = tuple(body.name for body in self.mechanism.linkage.bodies if body.slider is None)
        return {name: read_only(self._angle(name)) for name in bodies}

    def _angle(self, name: str) -> Any:
        body = self.mechanism.linkage.body(name)
        crank = self.mechanism.crank_of(body)
        if crank is not None:
            return _crank_angle(self.coordinate, self.phase, *crank)
        return self._continuous((body.joints[0], body.joints[1]))

    @abstractmethod
    def _continuous(self, ends: tuple[str, str]) -> Any:
        """Return the direction from one joint to another; NaN where they meet."""

    @cached_property
    def coefficient(self) -> Mapping[str, tuple[Any, Any]]:
        """Each body's kinematic coefficients, (dq/dθ, d²q/dθ²) with q its angle or travel.

        They are derivatives by the input's angle, or by a driving slider's travel: the same at any speed.
        Infinite where a limit of the input leaves them unbounded.
        """
        known = self.per_input
        first = {**known.angular_velocity, **known.travel_velocity}
        second = {**known.angular_acceleration, **known.travel_acceleration}
        return {
            name: read_only((unbounded(first[name], self.phase), unbounded(rate, self.phase)))
            for name, rate in second.items()
        }

    @property
    @abstractmethod
    def per_input(self) -> Derived[Vector, Number]:
        """The same instants, with rates by the input's angle, or travel, instead of those in time."""

    @abstractmethod
    def per(self, mover: str) -> Motion:
        """Return the same instants, with the rates of all behind a joint by that joint's own way.

        The joint is one of `Linkage.movers`. Where it rests, these rates go on while those in time vanish.
        """

    @cached_property
    def spring(self) -> Mapping[str, Strut]:
        """Each spring's length, rate and force."""
        return {item.name: read_only(self._strut(item)) for item in self.mechanism.linkage.springs}

    @cached_property
    def damper(self) -> Mapping[str, Strut]:
        """Each damper's length, rate and force."""
        return {item.name: read_only(self._strut(item)) for item in self.mechanism.linkage.dampers}

    @cached_property
    def reactions(self) -> Reactions:
        """All forces in joints, guides and gears and on the ground, of a scene that states any."""
        return reactions(self)

    @cached_property
    def reaction(self) -> Mapping[str, Mapping[str, Any]]:
        """The force of each joint (N) on each body that meets there, by joint and body; empty without forces.

        Vectors as positions are: arrays (..., 2), or pairs of a pose.
        """
        if not self.mechanism.linkage.reacting:
            return NOTHING
        whole = isinstance(self.phase, float)
        return {
            joint: {body: force if whole else np.stack(force, axis=-1) for body, force in bodies.items()}
            for joint, bodies in self.reactions.joints.items()
        }

    def _strut(self, item: Spring | Damper) -> Strut:
        apart = between(self.position, item.between)
        length, rate, turning = size(apart), None, None
        if self.velocity:
            moving = between(self.velocity, item.between)
            rate, turning = growth(apart, moving), over(cross(apart, moving), length * length)
        force = _force(item, self.mechanism.linkage.metre, length, rate)
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
    limit, per unit of input speed) are infinite. What has more derivatives than were asked for is empty.
    What joints do is solved at once, all else when it is first read.
    """

    asked: Asked
    _layout: ResultPlaces
    _results: Array

    def __init__(self, mechanism: Mechanism, asked: Asked, out: Array | None = None) -> None:
        speed, acceleration = asked.rates
        if asked.variant.varying_rate:
            speed, acceleration = speed.reshape(asked.shape), acceleration.reshape(asked.shape)
        layout, results = mechanism.solved(asked, out)
        vars(self).update(
            mechanism=mechanism,
            asked=asked,
            input_speed=speed,
            input_acceleration=acceleration,
            _layout=layout,
            _results=results,
        )
        for kind in COORDINATE:
            if kind in layout.places:
                vars(self)[kind] = arrays(layout, results, asked.shape, kind)[""]

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle as what was asked for, which is worked out anew."""
        return Motion, (self.mechanism, self.asked)

    def __getattr__(self, name: str) -> Any:
        """Return the quantities of a kind by name, nothing of one that was not asked for."""
        if name not in DERIVATIVE_OF:
            raise self._missing("a motion", name)
        if name in POINTS:
            layout, results = self._layout, self._results
        elif self.asked.joints is None and DERIVATIVE_OF[name] <= self.asked.derivatives:
            layout, results = self._rest
        else:
            return NOTHING
        if name not in layout.places:
            return NOTHING
        values = {name: arrays(layout, results, self.asked.shape, name)}
        vars(self).update(values if self.asked.joints is not None else self.mechanism.placed(values))
        return vars(self)[name]

    @cached_property
    def _rest(self) -> tuple[ResultPlaces, Array]:
        """What bodies, centres of mass and sliders do, solved when it is first read."""
        return self.mechanism.solved(self.asked, points=False)

    def __setattr__(self, name: str, value: Any) -> None:
        raise FrozenInstanceError(f"a motion is what was solved: its {name} cannot be set")

    @cached_property
    def phase(self) -> Array:  # type: ignore[override]
        """The phases; of angles those on the way up, NaN where the input does not come to them."""
        asked = self.asked
        if asked.variant.by_phase:
            return (asked.x if asked.phases is None else asked.phases).reshape(asked.shape)
        with np.errstate(all="ignore"):
            values = self.mechanism.assembly.path.phases(asked.x.reshape(asked.shape), asked.distances)
        phases: Array = read_only(values)
        return phases

    @cached_property
    def coordinate(self) -> Array:  # type: ignore[override]
        """Where the input is; an input that swings by phase has it solved."""
        if self._swings_unseen:
            return self._driven.coordinate
        x = self.asked.x.reshape(self.asked.shape)
        return read_only(self.mechanism.assembly.path.coordinates(x)) if self.asked.variant.by_phase else x

    @cached_property
    def coordinate_rate(self) -> Any:
        """How fast the input moves; one that swings by phase has it solved."""
        return self._driven.coordinate_rate if self._swings_unseen else self.input_speed

    @cached_property
    def coordinate_second(self) -> Any:
        """How the input's rate changes; one that swings by phase has it solved."""
        return self._driven.coordinate_second if self._swings_unseen else self.input_acceleration

    @property
    def _swings_unseen(self) -> bool:
        """Whether the input's coordinate follows from formulas of which no joint that was named is a part."""
        asked = self.asked
        return asked.joints is not None and asked.variant.by_phase and not self.mechanism.full_turn

    @cached_property
    def _driven(self) -> Motion:
        """The same instants with what the input does."""
        return Motion(self.mechanism, self.asked._replace(joints=None, derivatives=0))

    @cached_property
    def per_input(self) -> Motion:
        """The same instants, with rates by the input's angle, or travel, instead of those in time."""
        by_phase = self.asked.variant.by_phase
        return self._rated(Variant(by_phase, False, per_input=by_phase and not self.mechanism.full_turn))

    def per(self, mover: str) -> Motion:
        """Return the same instants, with the rates of all behind a joint by that joint's own way."""
        if mover not in self._per:
            self._per[mover] = self._rated(Variant(self.asked.variant.by_phase, False, mover=mover))
        return self._per[mover]

    @cached_property
    def _per(self) -> dict[str, Motion]:
        return {}

    def _rated(self, variant: Variant) -> Motion:
        """Return the same instants with other rates."""
        return Motion(self.mechanism, self.asked._replace(variant=variant, rates=(1.0, 0.0), back=None))

    def _continuous(self, ends: tuple[str, str]) -> Array:
        principal: Array = np.asarray(direction(between(self.position, ends)))
        return principal if principal.ndim == 0 else self._unwrapped(principal, ends)

    def _unwrapped(self, principal: Array, ends: tuple[str, str]) -> Array:
        """Add whole turns, as a direction has turned between neighbours."""
        steps = np.diff(principal, axis=0)
        x, at = self.asked.x.reshape(principal.shape), partial(self._direction, ends)
        rows = [(values[:-1].reshape(-1), values[1:].reshape(-1)) for values in (x, principal)]
        angles = turned(rows[0], rows[1], at, self.mechanism.assembly.quickest)
        turns = np.rint((angles.reshape(steps.shape) - steps) / math.tau)
        whole = np.zeros_like(principal)
        np.cumsum(np.nan_to_num(turns), axis=0, out=whole[1:])
        return principal + math.tau * (whole - _before_stretch(whole, np.isnan(principal)))

    def _direction(self, ends: tuple[str, str], x: Array) -> Array:
        """Return the direction of one joint to another at other instants."""
        angle, phase = (None, x) if self.asked.variant.by_phase else (x, None)
        position = self.mechanism.solve(angle=angle, phase=phase, speed=1.0, derivatives=0).position
        return np.asarray(direction(between(position, ends)))


def _before_stretch(whole: Array, gap: NDArray[np.bool_]) -> Array:
    """Return for each row the value in the last row of a gap up to it, 0 where there is no gap so far."""
    rows = np.arange(len(gap)).reshape(-1, *[1] * (gap.ndim - 1))
    last = np.maximum.accumulate(np.where(gap, rows, -1), axis=0)
    return np.where(last < 0, 0.0, np.take_along_axis(whole, np.maximum(last, 0), axis=0))


def _crank_angle(input_angle: Any, phase: Any, gearing: Gearing, from_pin: bool) -> Any:
    """Return a crank's angle; NaN where there is no phase."""
    angle = input_angle * float(gearing.ratio) + float(gearing.offset)
    return (angle + math.pi if from_pin else angle) + 0.0 * phase


class Pose(Derived[Pair, float]):
    """The motion at one instant, as plain floats and (x, y) tuples; the attributes are Motion's."""

    def __init__(self, results: dict[str, Any]) -> None:
        self.__dict__ = results

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle as what was solved, without what follows from it."""
        kinds = (*ORDER, "phase", "mechanism", "input_speed", "input_acceleration")
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
        return self.mechanism.pose_per_input(self.phase) if rated else self

    def per(self, mover: str) -> Motion:
        """Return the same instant, with the rates of all behind a joint by that joint's own way."""
        return self._batch.per(mover)

    @cached_property
    def _batch(self) -> Motion:
        return self.mechanism.solve(phase=self.phase, speed=1.0)

    def _continuous(self, ends: tuple[str, str]) -> float:
        return float(direction(between(self.position, ends)))


# A linkage made ready to be solved: assembled once, its programs compiled when first needed.

Rows = Mapping[str, Mapping[str, tuple[Value, ...]]]
_Key = tuple[int, bool, bool]
"""Which poses a program gives: how many derivatives, whether the input accelerates, whether `per_input`."""


_MOST_SEEN = 10_001

Traced = tuple[tuple[str, ...], Rows]
"""The formulas as traced for one way of asking: the inputs' names, and every quantity."""


@frozen
class Mechanism:
    """A linkage with its loops, path and signs, and the programs that solve it.

    A mechanism that is `transient` is solved at a few instants only. They come from the program over arrays,
    which its cycle needs anyway: a program of one instant would cost more than it saves.
    """

    linkage: Linkage
    assembly: Assembly
    transient: bool = False

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle as the linkage, which is made ready anew."""
        return (transient if self.transient else mechanism), (self.linkage,)

    @property
    def periods(self) -> int:
        """The number of drive periods after which every joint is back."""
        return self.assembly.path.periods

    @property
    def phases(self) -> Array:
        """Phases over one true period, from 0 at equal steps, dense enough for the quickest crank."""
        count = self.assembly.samples * self.periods
        phases: Array = np.arange(count, dtype=np.float64) * (2 * math.pi * self.periods / count)
        return phases

    @property
    def sampled(self) -> Array:
        """Phases around one true period for a search: half a step off 0, where a swing's rates vanish."""
        return around(self.periods, self.assembly.samples)

    def count(self, least: int, *, a_turn: int = 24) -> int:
        """Return how many phases show the course of one true period: `least`, or more with quick gears.

        There are `a_turn` phases to each turn of the quickest crank, up to a greatest number.
        """
        return max(least, min(math.ceil(a_turn * self.assembly.quickest * self.periods), _MOST_SEEN))

    @property
    def retraced(self) -> bool:
        """Whether the input comes back from both its ends through the same poses as it went."""
        return self.assembly.path.way == (0.0, math.pi)

    @property
    def full_turn(self) -> bool:
        """Whether the input turns fully."""
        return self.assembly.path.full_turn

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the driven angle, or the travel of a slider that drives, goes; the lower end first."""
        return self.assembly.path.input_range

    @cached_property
    def other_ranges(self) -> tuple[tuple[float, float], ...]:
        """The ranges of an input that does not turn fully when it starts elsewhere, on the named closures."""
        return () if self.full_turn else tuple(_other_ranges(self.linkage, self.input_range))

    @property
    def stops(self) -> tuple[str, ...]:
        """The dyads that stop the input at its lower and its upper end, "" where it merely turns back.

        Of an input that turns fully there are none.
        """
        return self.assembly.path.ends

    @property
    def way(self) -> tuple[float, float] | None:
        """The first and the last phase of a way that all other phases retrace; None where there is none."""
        return self.assembly.path.way

    @property
    def triangle(self) -> CrankTriangle | None:
        """The triangle by which a cylinder turns the crank; None where none does."""
        return self.assembly.path.triangle

    @property
    def keeps(self) -> tuple[bool, bool]:
        """Whether the input comes back on the same closures, at its lower and at its upper end."""
        return self.assembly.path.keeps

    def comes_to(self, coordinate: float) -> bool:
        """Tell whether the input comes to an angle, or to a travel of a slider that drives."""
        return self.assembly.path.holds(coordinate)

    def phase_of(self, coordinate: float, near: float) -> float:
        """Return the phase nearest to `near` at which the input stands at a place, or at its end."""
        return self.assembly.path.phase_of(coordinate, near)

    def crank_of(self, body: Body) -> tuple[Gearing, bool] | None:
        """Return how a crank's body turns with the input, and whether it is named from its pin."""
        crank = self.linkage.crank_of(body)
        return (self.assembly.gears[crank.name], body.joints[0] == crank.name) if crank else None

    @property
    def hindered(self) -> bool:
        """Whether a dyad down the chain limits the input or touches a change point."""
        return any(root.zeros for root in self.assembly.chain.values())

    @cached_property
    def _poses(self) -> dict[_Key, Callable[..., dict[str, Any]]]:
        return {}

    @cached_property
    def _traces(self) -> dict[Variant, Traced]:
        return {}

    @cached_property
    def _programs(
        self,
    ) -> dict[tuple[Variant, int, tuple[str, ...] | None, bool], tuple[Batch, ResultPlaces]]:
        return {}

    def pose(
        self, phase: float, speed: float, acceleration: float, derivatives: int, per_input: bool = False
    ) -> Pose:
        """Return one instant, solved in plain floats; its rates by the input instead of time `per_input`."""
        key = derivatives, acceleration != 0.0, per_input
        try:
            program = self._poses.get(key) or self._in_floats(key)
            return Pose(program(phase, speed, acceleration, self))
        except (ZeroDivisionError, ValueError):
            return Pose(self._from_arrays(key, phase, speed, acceleration))

    def pose_per_input(self, phase: float) -> Pose:
        """Return one instant, its rates by the input's angle, or travel, instead of those in time."""
        return self.pose(phase, 1.0, 0.0, 2, not self.full_turn)

    def _in_floats(self, key: _Key) -> Callable[..., dict[str, Any]]:
        """Return the program of one instant; ValueError where it would cost more than it saves."""
        if self.transient:
            raise ValueError("a mechanism on its way is solved from arrays")
        derivatives, accelerates, per_input = key
        trace = self.trace(Variant(True, accelerates, per_input=per_input))
        program = _scalar(*trace, derivatives)
        way = self.assembly.path.way
        program = _there_and_back(program, per_input, way) if way else program
        solved = self._poses[key] = program if self.linkage.near is self.linkage else _placed(program)
        return solved

    def placed(self, results: dict[str, Any]) -> dict[str, Any]:
        """Return quantities by kind, as solved, with positions where they are."""
        if self.linkage.near is self.linkage:
            return results
        places = {kind: FarPositions(results[kind], self.linkage.origin) for kind in _PLACES & results.keys()}
        return results | places

    def trace(self, variant: Variant) -> Traced:
        """Record the formulas of all quantities, lengths in the scene's unit."""
        traced = self._traces.get(variant)
        if traced is None:
            graph = Graph()
            uniform = not variant.varying_rate
            second = graph.input("a", uniform=uniform) if variant.accelerates else 0.0
            # what stands before a mover does not move
            pace = Slope(0.0) if variant.mover else Slope(graph.input("w", uniform=uniform), second)
            names, state = self._state(graph, pace, variant)
            unscale = self.assembly.unscale
            places = zip(COORDINATE, state.coordinate(unscale), strict=True)
            driven = {kind: {"": (value,)} for kind, value in places}
            rows = dict(walked_rows(walked(self.assembly, state, variant.mover), unscale))
            graph.forget()
            traced = self._traces[variant] = names, driven | rows
        return traced

    def _state(self, graph: Graph, pace: Slope, variant: Variant) -> tuple[tuple[str, ...], InputState]:
        path = self.assembly.path
        if variant.per_input:
            return ("x",), path.state_per_input(graph.input("x"))
        if variant.by_phase:
            return ("x",), path.state(graph.input("x"), pace)
        return path.state_by_angle(graph, pace)

    def _from_arrays(self, key: _Key, phase: float, speed: float, second: float) -> dict[str, Any]:
        """Return what the scalar program gives, NaN and infinities included, where floats raise."""
        derivatives, _, per_input = key
        motion = self.solve(phase=phase, speed=speed, acceleration=second, derivatives=derivatives)
        motion = motion.per_input if per_input else motion
        kinds = (kind for kind in DERIVATIVE_OF if DERIVATIVE_OF[kind] <= derivatives)
        results = self.placed({kind: _plain(near(getattr(motion, kind))) for kind in kinds})
        inputs = ("phase", "input_speed", "input_acceleration", *COORDINATE)
        return results | {name: float(getattr(motion, name)) for name in inputs} | {"mechanism": self}

    def solve(
        self,
        *,
        angle: ArrayLike | None = None,
        phase: ArrayLike | None = None,
        speed: ArrayLike,
        acceleration: ArrayLike = 0.0,
        derivatives: int = 2,
        joints: tuple[str, ...] | None = None,
        out: Array | None = None,
    ) -> Motion:
        """Return the motion at crank angles, or at phases; scalar or any shape.

        It is written into `out`, if given: (derivatives + 1, joints, 2, *shape) of the `joints` that are
        named. ValueError where that is not its shape.
        """
        given = np.asarray(angle if phase is None else phase, dtype=np.float64)
        shown = None
        if phase is not None and self.assembly.path.way:
            shown, (given, sign) = given, retraced(given, self.assembly.path.way)
        rates, shape = _rates(speed, acceleration, given.shape)
        varying = isinstance(rates[0], np.ndarray)
        x, variant = _kept(given, shape), Variant(phase is not None, varying or rates[1] != 0.0, varying)
        asked = Asked(variant, x, rates, shape, derivatives, joints)
        if shown is not None:
            back = np.broadcast_to(sign < 0, shape).reshape(-1)
            asked = asked._replace(phases=_kept(shown, shape), back=back)
        elif phase is None:
            asked = asked._replace(distances=self.assembly.path.distances(x))
        if out is not None:
            wanted = (derivatives + 1, len(joints or ()), 2, *shape)
            if not (
                isinstance(out, np.ndarray)
                and out.shape == wanted
                and out.dtype == np.float64
                and out.flags.carray
            ):
                raise ValueError(f"out= is an array of floats that can be written, in C's order: {wanted}")
        return Motion(self, asked, out)

    def solved(
        self, asked: Asked, out: Array | None = None, *, points: bool = True
    ) -> tuple[ResultPlaces, Array]:
        """Return what is asked for of joints, or of all else, in rows, and where it lies there."""
        program, layout = self.program(asked.variant, asked.derivatives, asked.joints, points=points)
        path = self.assembly.path
        rates = asked.rates if asked.variant.accelerates else asked.rates[:1]
        distances, back = asked.distances, asked.back
        if asked.variant.varying_rate and back is not None:
            rates, back = tuple(np.where(back, -rate, rate) for rate in rates), None
        given = (asked.x,) if distances is None else path.solved_from(distances)
        results = program(*given, *rates, out=None if out is None else out.reshape(-1, len(asked.x)))
        if back is not None and back.any():
            results[:, back] = program(asked.x[back], *(-rate for rate in rates))
        if distances is not None:
            results[:, distances.outside] = np.nan
            if distances.at_limit.any():
                snapped = program(*path.solved_from(distances.snapped), *rates)
                limits = np.ix_(layout.rated, distances.at_limit)
                results[limits] = np.where(np.isnan(snapped[limits]), np.inf, snapped[limits])
        if asked.joints is not None and self.linkage.near is not self.linkage:
            x, y = self.linkage.origin
            results[: 2 * len(asked.joints) : 2] += x
            results[1 : 2 * len(asked.joints) : 2] += y
        results.setflags(write=False)
        return layout, results

    def program(
        self,
        variant: Variant,
        derivatives: int,
        joints: tuple[str, ...] | None = None,
        *,
        points: bool = True,
    ) -> tuple[Batch, ResultPlaces]:
        """Return the program over arrays of up to so many derivatives, and where its results lie.

        It is that of joints (and of the input), or of all else. Where `joints` are named it has those alone,
        pins among them.
        """
        key = variant, derivatives, joints, points
        compiled = self._programs.get(key)
        if compiled is None:
            compiled = self._programs[key] = self._compiled(*key)
        return compiled

    def _compiled(
        self, variant: Variant, derivatives: int, joints: tuple[str, ...] | None, points: bool
    ) -> tuple[Batch, ResultPlaces]:
        names, rows = self.trace(variant)
        rates = ("w", "a") if variant.accelerates else ("w",)
        varying = {**dict.fromkeys(names, True), **dict.fromkeys(rates, variant.varying_rate)}
        pins = {joint.name: joint.position for joint in self.linkage.near.pins}
        swings = variant.by_phase and not self.full_turn
        asked = {
            kind: values
            for kind, values in rows.items()
            if (kind in POINTS or kind in COORDINATE) is points
            and (swings if kind in COORDINATE else ORDER[kind] <= derivatives)
        }
        if joints is not None:
            kinds, pins = POINTS[: derivatives + 1], {}
            asked = {kind: {name: rows[kind][name] for name in joints} for kind in kinds}
        layout, outputs = laid_out(asked, pins)
        return batch(varying, outputs), layout


def _placed(program: Callable[..., dict[str, Any]]) -> Callable[..., dict[str, Any]]:
    """Return the program of one instant of a linkage that is solved from a far origin."""

    def solved(phase: float, w: float, a: float, mechanism: Mechanism) -> dict[str, Any]:
        return mechanism.placed(program(phase, w, a, mechanism))

    return solved


def _scalar(names: tuple[str, ...], rows: Rows, derivatives: int) -> Callable[..., dict[str, Any]]:
    """Return the program of one instant in plain floats."""
    outputs: list[Value] = []
    parts = ["'mechanism': mechanism, 'phase': x, 'input_speed': w, 'input_acceleration': a"]
    for kind, values in rows.items():
        if kind in COORDINATE or (values and DERIVATIVE_OF[kind] <= derivatives):
            outputs.extend(component for components in values.values() for component in components)
            parts.append(f"{kind!r}: {'{}' if kind in COORDINATE else _dict_display(values)}")
    display = f"{{{{{', '.join(parts)}}}}}"
    return scalar((*names, "w", "a", "mechanism"), outputs, display)


def _there_and_back(
    program: Callable[..., dict[str, Any]], per_input: bool, way: tuple[float, float]
) -> Callable[..., dict[str, Any]]:
    """Return the program of one instant of an input that comes back by the way it came."""

    def solved(phase: float, w: float, a: float, mechanism: Mechanism) -> dict[str, Any]:
        at, sign = (float(part) for part in retraced(phase, way))
        results = program(at, *((w, a) if per_input else (sign * w, sign * a)), mechanism)
        return results | {"phase": phase, "input_speed": w, "input_acceleration": a}

    return solved


def _plain(values: Mapping[str, Array]) -> dict[str, Any]:
    """Return one instant's numbers and vectors as floats and pairs of them."""
    return {
        name: (float(value[0]), float(value[1])) if value.ndim else float(value)
        for name, value in values.items()
    }


def _dict_display(values: Mapping[str, tuple[Value, ...]]) -> str:
    """Return the layout of a dict of the values' names, for str.format."""
    items = (
        repr(name).replace("{", "{{").replace("}", "}}") + (": ({}, {})" if len(components) == 2 else ": {}")
        for name, components in values.items()
    )
    return "{{" + ", ".join(items) + "}}"


def _rates(
    speed: float | ArrayLike, acceleration: float | ArrayLike, shape: tuple[int, ...]
) -> tuple[tuple[Any, Any], tuple[int, ...]]:
    """Return one speed and acceleration for all instants, or arrays of them, and the shape of the answer."""
    if isinstance(speed, float) and isinstance(acceleration, float):
        return (speed, acceleration), shape
    w, a = (np.asarray(rate, dtype=np.float64) for rate in (speed, acceleration))
    if w.ndim or a.ndim:
        shape = np.broadcast_shapes(shape, w.shape, a.shape)
        return (_kept(w, shape), _kept(a, shape)), shape
    return (float(w), float(a)), shape


def _kept(values: Array, shape: tuple[int, ...]) -> Array:
    """Return the values along one axis, repeated to the shape and read-only."""
    if values.shape != shape:
        values = np.array(np.broadcast_to(values, shape))
    elif values.base is not None or values.flags.writeable:
        values = values.copy()
    values.setflags(write=False)
    return values if values.ndim == 1 else values.reshape(-1)


def walked_rows(walk: Walk, unscale: float) -> Iterator[tuple[str, Mapping[str, tuple[Value, ...]]]]:
    """Yield each kind of quantity that a walk gives, and its components by name, in the scene's unit."""
    joints, centres = walk.points, walk.centres
    for kind in VECTORS:
        part = ("position", "velocity", "acceleration")[DERIVATIVE_OF[kind]]
        points = (centres if kind.startswith("com_") else joints).items()
        vectors = ((name, getattr(point, part)) for name, point in points)
        if unscale != 1.0:
            vectors = ((name, vector.scaled(unscale)) for name, vector in vectors)
        yield kind, dict(vectors)
    turnings = {name: (turning.value, turning.rate) for name, turning in walk.bodies.items()}
    sliding = ((body.name, walk.travels[body.slider]) for body in walk.linkage.bodies if body.slider)
    travels = {name: (travel.value, travel.rate, travel.second) for name, travel in sliding}
    for kind in NUMBERS:
        order = DERIVATIVE_OF[kind]
        if kind.startswith("angular"):
            yield kind, {name: (rates[order - 1],) for name, rates in turnings.items()}
        else:
            yield kind, {name: (rates[order] * unscale,) for name, rates in travels.items()}
    levers = walk.levers if walk.linkage.forceful else {}
    yield LEVER, {name: (lever * unscale,) for name, lever in levers.items()}


@lru_cache(maxsize=1)
def _assembled(linkage: Linkage) -> tuple[Assembly, Separations | None]:
    """Return the linkage put together, and the margins of its dyads on moving points, if it has any."""
    assembly = assemble(linkage)
    chained = not assembly.signs.keys() <= assembly.loops.keys()
    return assembly, separations(assembly) if chained else None


def stopped(linkage: Linkage) -> Mechanism | None:
    """Return a linkage whose input does not turn fully, to ask how far it goes; None where it turns fully.

    This takes far less time than to make it ready to be solved. AssemblyError where it cannot be put
    together.
    """
    assembly, separations = _assembled(linkage)
    assembly = limits.stopped(assembly, linkage, separations) if separations else assembly
    return None if assembly.path.full_turn else Mechanism(linkage, assembly)


def _other_ranges(linkage: Linkage, own: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Yield the ranges that other starts give the input, each once, whole turns aside."""
    known = [own]
    for start in starts(linkage):
        try:
            assembly, separations = _assembled(_starting(linkage, start))
            places = open_places(assembly, separations) if separations else [start]
        except AssemblyError:
            continue
        for start_there in places:
            try:
                there = stopped(_starting(linkage, start_there))
            except AssemblyError:
                continue
            if there and not any(_are_alike(there.input_range, other) for other in known):
                known.append(there.input_range)
                yield there.input_range


def _starting(linkage: Linkage, coordinate: float) -> Linkage:
    """Return the linkage with a start that is stated."""
    return replace(linkage, drive=replace(linkage.drive, start=coordinate, at_zero=True))


def _are_alike(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Tell whether two ranges are one, whole turns aside."""
    return all(abs(math.remainder(a - b, math.tau)) <= SAME_PLACE for a, b in zip(one, other, strict=True))


@lru_cache(maxsize=8)
def mechanism(linkage: Linkage) -> Mechanism:
    """Return the linkage made ready; AssemblyError where it cannot be put together."""
    assembly, fare = _assembled(linkage)
    return Mechanism(linkage, limits.restricted(assembly, linkage, fare) if fare else assembly)


def transient(linkage: Linkage) -> Mechanism:
    """Return a linkage on the way between two whose dyads down the chain close all along.

    Those dyads are not checked: where one does not close after all, its joints are NaN.
    """
    return Mechanism(linkage, assemble(linkage), transient=True)
