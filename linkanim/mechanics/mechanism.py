"""A linkage made ready to be solved: assembled once, its programs compiled when first needed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .assembly import Assembly, assemble
from .columns import Columns, Floats, ResultLayout, layout
from .expression import Graph, Value
from .input_state import InputState
from .limits import restricted
from .linkage import Linkage
from .motion import Array, Motion, Pose, Setting
from .planar import MovingPoint, Slope
from .program import Batch, batch, scalar
from .reach import WaysLeft
from .register import DERIVATIVE_OF, NUMBERS, VECTORS
from .walk import Kinematics

Rows = Mapping[str, Mapping[str, tuple[Value, ...]]]


@dataclass(frozen=True)
class Variant:
    """One way of asking: by phase or by angle, how many derivatives, whether the input accelerates."""

    by_phase: bool
    derivatives: int
    accelerates: bool
    varying_rate: bool = False


@dataclass(frozen=True)
class Mechanism:
    """A linkage with its loops, path and signs, and the programs that solve it.

    One that is `passing` is asked for a few instants only: they come from the program over arrays, which
    its cycle needs anyway, since a program of their own would cost more than it saves.
    """

    linkage: Linkage
    assembly: Assembly
    passing: bool = False

    @property
    def periods(self) -> int:
        """The number of drive periods after which every joint is back."""
        return self.assembly.path.periods

    @property
    def hindered(self) -> bool:
        """Whether a dyad down the chain limits the input or touches a change point."""
        return bool(self.assembly.chain)

    @cached_property
    def setting(self) -> Setting:
        """What motions and poses share."""
        return Setting(self.linkage, self.assembly.gears)

    @cached_property
    def _poses(self) -> dict[tuple[int, bool], Callable[..., Any]]:
        return {}

    @cached_property
    def _programs(self) -> dict[Variant, tuple[Batch, ResultLayout]]:
        return {}

    def pose(self, phase: float, speed: float, acceleration: float, derivatives: int) -> Pose:
        """Return one instant, solved in plain floats."""
        accelerates = acceleration != 0.0
        if self.passing:
            found = self._pose_from_arrays(derivatives, phase, speed, acceleration)
            return Pose(self.setting, (phase, speed, acceleration), found)
        program = self._poses.get((derivatives, accelerates))
        if program is None:
            program = self._scalar(Variant(True, derivatives, accelerates))
            self._poses[derivatives, accelerates] = program
        try:
            found = program(phase, speed, acceleration)
        except (ZeroDivisionError, ValueError):
            found = self._pose_from_arrays(derivatives, phase, speed, acceleration)
        return Pose(self.setting, (phase, speed, acceleration), found)

    def _trace(self, variant: Variant) -> tuple[tuple[str, ...], tuple[Value, Value, Value], Rows]:
        """Note the formulas: the inputs' names, the crank's angle and rates, and all quantities."""
        graph = Graph()
        uniform = not variant.varying_rate
        second = graph.input("a", uniform=uniform) if variant.accelerates else 0.0
        pace = Slope(graph.input("w", uniform=uniform), second)
        names, state = self._state(graph, pace, by_phase=variant.by_phase)
        kinematics = self.assembly.walk(state)
        angle = state.angle + float(state.origin)
        return names, (angle, state.rate, state.second), _rows(kinematics, self.assembly.unscale, variant)

    def _state(self, graph: Graph, pace: Slope, *, by_phase: bool) -> tuple[tuple[str, ...], InputState]:
        path = self.assembly.path
        if by_phase:
            return ("x",), path.state(graph.input("x"), pace)
        return path.state_by_angle(graph, pace)

    def _scalar(self, variant: Variant) -> Any:
        names, crank, rows = self._trace(variant)
        outputs: list[Value] = list(crank)
        parts = ["({}, {}, {})"]
        for values in rows.values():
            outputs.extend(component for components in values.values() for component in components)
            parts.append(_dict_display(values))
        return scalar((*names, "w", "a"), outputs, f"({', '.join(parts)})")

    def _pose_from_arrays(
        self, derivatives: int, phase: float, speed: float, second: float
    ) -> tuple[Any, ...]:
        """Return what the scalar program gives, NaN and infinities included, where floats raise."""
        motion = self.solve(phase=phase, speed=speed, acceleration=second, derivatives=derivatives)
        vectors = [
            {name: (float(value[0]), float(value[1])) for name, value in getattr(motion, kind).items()}
            for kind in VECTORS
        ]
        numbers = [{name: float(value) for name, value in getattr(motion, kind).items()} for kind in NUMBERS]
        crank = (float(motion.crank_angle), float(motion.crank_rate), float(motion.crank_second))
        return (crank, *vectors, *numbers)

    def solve(
        self,
        *,
        angle: ArrayLike | None = None,
        phase: ArrayLike | None = None,
        speed: ArrayLike,
        acceleration: ArrayLike = 0.0,
        derivatives: int = 2,
    ) -> Motion:
        """Return the motion at crank angles, or at phases; scalar or any shape."""
        by_phase = phase is not None
        given = np.asarray(phase if phase is not None else angle, dtype=np.float64)
        rates = [np.asarray(rate, dtype=np.float64) for rate in (speed, acceleration)]
        varying = any(rate.ndim for rate in rates)
        shape = np.broadcast_shapes(given.shape, *(rate.shape for rate in rates)) if varying else given.shape
        x = _flat(given, shape)
        w, a = (_flat(rate, shape) if varying else float(rate) for rate in rates)
        variant = Variant(by_phase, derivatives, varying or a != 0.0, varying)
        ways = None if by_phase else self.assembly.path.reach(x)
        asked = _Given(x, w, a, shape, ways)
        with np.errstate(all="ignore"):
            return self._motion(variant, asked, *self._run(variant, asked))

    def _run(self, variant: Variant, given: _Given) -> tuple[ResultLayout, Floats]:
        program, places = self.program(variant)
        rates = (given.w, given.a) if variant.accelerates else (given.w,)
        ways = given.reach
        if ways is None:
            return places, program(given.x, *rates)
        results = program(*self.assembly.path.solved_from(ways), *rates)
        results[:, ways.outside] = np.nan
        if variant.derivatives and ways.at_limit.any():
            snapped = program(ways.angle, *ways.snapped, *rates)
            _mark_limits(places, results, snapped, ways.at_limit)
        return places, results

    def program(self, variant: Variant) -> tuple[Batch, ResultLayout]:
        """Return the program over arrays for one way of asking, and where its results lie."""
        found = self._programs.get(variant)
        if found is None:
            names, crank, rows = self._trace(variant)
            rates = ("w", "a") if variant.accelerates else ("w",)
            varying = {**dict.fromkeys(names, True), **dict.fromkeys(rates, variant.varying_rate)}
            pins = {joint.name: joint.position for joint in self.linkage.pins}
            places = layout(rows, pins, VECTORS[:3])
            swinging = () if self.assembly.path.full_turn else crank
            found = self._programs[variant] = (batch(varying, (*places.outputs, *swinging)), places)
        return found

    def _motion(self, variant: Variant, given: _Given, places: ResultLayout, results: Floats) -> Motion:
        results.flags.writeable = False
        kinds = places.places.items()
        found: dict[str, Any] = {kind: Columns(names, results, given.shape) for kind, names in kinds}
        swing = [row.reshape(given.shape) for row in results[len(places.outputs) :]]
        angles = self._crank(given, variant, swing)
        return Motion(
            self.setting,
            *angles[:2],
            input_speed=_shaped(given.w, given.shape),
            input_acceleration=_shaped(given.a, given.shape),
            crank_rate=angles[2],
            crank_second=angles[3],
            **found,
        )

    def _crank(self, given: _Given, variant: Variant, swing: list[Any]) -> tuple[Any, Any, Any, Any]:
        """Return phase, crank angle and its two rates."""
        x, path = given.x.reshape(given.shape), self.assembly.path
        rates = _shaped(given.w, given.shape), _shaped(given.a, given.shape)
        if not variant.by_phase:
            return path.phases(x, given.reach), x, *rates
        angle, *moving = swing or (path.angles(x), *rates)
        return x, angle, moving[0], moving[1]


@dataclass(frozen=True)
class _Given:
    """What was asked, flattened, and the shape in which to answer."""

    x: Array
    w: Any
    a: Any
    shape: tuple[int, ...]
    reach: WaysLeft | None


def _mark_limits(places: ResultLayout, results: Floats, snapped: Floats, at_limit: NDArray[np.bool_]) -> None:
    """Give rates the values they have at the limit itself: infinite where they are unbounded."""
    for row, kind in enumerate(places.kinds):
        if DERIVATIVE_OF[kind]:
            values = snapped[row, at_limit]
            results[row, at_limit] = np.where(np.isnan(values), np.inf, values)


def _dict_display(values: Mapping[str, tuple[Value, ...]]) -> str:
    """Return the layout of a dict of the values' names, for str.format."""
    items = (
        repr(name).replace("{", "{{").replace("}", "}}") + (": ({}, {})" if len(components) == 2 else ": {}")
        for name, components in values.items()
    )
    return "{{" + ", ".join(items) + "}}"


def _flat(values: Array, shape: tuple[int, ...]) -> Array:
    """Return the values along one axis, repeated to the shape."""
    repeated = values if values.shape == shape else np.broadcast_to(values, shape)
    return np.ascontiguousarray(repeated).reshape(-1)


def _shaped(rate: Any, shape: tuple[int, ...]) -> Any:
    return rate.reshape(shape) if isinstance(rate, np.ndarray) else rate


def _rows(kinematics: Kinematics, unscale: float, variant: Variant) -> Rows:
    """Return every quantity's values up to the derivatives asked for, lengths in the scene's unit."""
    found: dict[str, Mapping[str, tuple[Value, ...]]] = {}
    for kind, values in _quantities(kinematics, unscale):
        found[kind] = values if DERIVATIVE_OF[kind] <= variant.derivatives else {}
    return found


def _quantities(k: Kinematics, unscale: float) -> Iterator[tuple[str, Mapping[str, tuple[Value, ...]]]]:
    for kind in VECTORS:
        part = ("position", "velocity", "acceleration")[DERIVATIVE_OF[kind]]
        points = k.centres if kind.startswith("com_") else k.points
        yield kind, {name: _pair(point, part, unscale) for name, point in points.items()}
    turnings = {name: (turning.value, turning.rate) for name, turning in k.bodies.items()}
    travels = {name: (way.value, way.rate, way.second) for name, way in k.travels.items()}
    for kind in NUMBERS:
        order = DERIVATIVE_OF[kind]
        if kind.startswith("angular"):
            yield kind, {name: (rates[order - 1],) for name, rates in turnings.items()}
        else:
            yield kind, {name: (ways[order] * unscale,) for name, ways in travels.items()}


def _pair(point: MovingPoint, part: str, unscale: float) -> tuple[Value, Value]:
    vector = getattr(point, part).scaled(unscale)
    return vector.x, vector.y


@lru_cache(maxsize=64)
def mechanism(linkage: Linkage) -> Mechanism:
    """Return the linkage made ready; AssemblyError where it cannot be put together."""
    return Mechanism(linkage, restricted(assemble(linkage), linkage))


def passing(linkage: Linkage) -> Mechanism:
    """Return a linkage on the way between two whose dyads down the chain close all along.

    They are not looked at: where one does not close after all, its joints are NaN.
    """
    return Mechanism(linkage, assemble(linkage), passing=True)
