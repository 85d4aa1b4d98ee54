"""A linkage made ready to be solved: assembled once, its programs compiled when first needed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkanim.mechanics.closing import limits
from linkanim.mechanics.closing.assemble import assemble
from linkanim.mechanics.closing.kinds import walked
from linkanim.mechanics.closing.separation import Separations, separations
from linkanim.mechanics.closing.walk import Assembly, Walk
from linkanim.mechanics.drive.input_path import retraced
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.program import Array, Batch, batch, scalar
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.input_state import InputState
from linkanim.mechanics.motion.columns import ResultLayout, layout
from linkanim.mechanics.motion.measures import DERIVATIVE_OF, NUMBERS, VECTORS
from linkanim.mechanics.motion.motion import (
    COORDINATE,
    Instants,
    Motion,
    Pose,
    Setting,
    Variant,
)

Rows = Mapping[str, Mapping[str, tuple[Value, ...]]]
_Key = tuple[int, bool, bool]
"""Which poses a program gives: how many derivatives, whether the input accelerates, whether `per_input`."""


_FINE, _MOST_SEEN = 24, 10_001

Traced = tuple[tuple[str, ...], Rows]
"""The formulas as traced for one way of asking: the inputs' names, and every quantity."""


@dataclass(frozen=True)
class Mechanism(Setting):
    """A linkage with its loops, path and signs, and the programs that solve it.

    One that is `passing` is solved at a few instants only: they come from the program over arrays, which
    its cycle needs anyway, since a program of their own would cost more than it saves.
    """

    linkage: Linkage
    assembly: Assembly
    passing: bool = False

    def __reduce__(self) -> tuple[Any, ...]:
        """Go through a pickle as the linkage, which is made ready anew."""
        return (passing if self.passing else mechanism), (self.linkage,)

    @property
    def periods(self) -> int:
        """The number of drive periods after which every joint is back."""
        return 1 if self.retraced else self.assembly.path.periods

    @property
    def phases(self) -> Array:
        """Phases over one true period, from 0 on at equal steps, as near as what turns fastest needs."""
        count = self.assembly.samples * self.periods
        phases: Array = np.arange(count, dtype=np.float64) * (2 * math.pi * self.periods / count)
        return phases

    def count(self, least: int) -> int:
        """Return at how many phases of one true period its course is seen: `least`, more of quick gears.

        Of each turn of the quickest crank it is 24 of them, as far as that is not too many.
        """
        return max(least, min(math.ceil(_FINE * self.assembly.quickest * self.periods), _MOST_SEEN))

    @property
    def retraced(self) -> bool:
        """Whether the input swings and comes back by the way it came: each pose is one of the way up."""
        return self.linkage.drive.retraced and not self.assembly.path.full_turn

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
    def _programs(self) -> dict[tuple[Variant, tuple[str, ...]], tuple[Batch, ResultLayout]]:
        return {}

    def pose(
        self, phase: float, speed: float, acceleration: float, derivatives: int, per_input: bool = False
    ) -> Pose:
        """Return one instant, solved in plain floats; its rates by the input instead of time `per_input`."""
        at, w, a = phase, speed, acceleration
        if self.retraced:
            at, sign = (float(part) for part in retraced(phase))
            w, a = (w, a) if per_input else (sign * w, sign * a)
        key = derivatives, a != 0.0, per_input
        try:
            program = self._poses.get(key) or self._in_floats(key)
            pose = Pose(program(at, w, a, self))
        except (ZeroDivisionError, ValueError):
            pose = Pose(self._from_arrays(key, at, w, a))
        if self.retraced and not per_input:
            vars(pose).update(phase=phase, input_speed=speed, input_acceleration=acceleration)
        return pose

    def pose_per_input(self, phase: float) -> Pose:
        """Return one instant, its rates by the input's angle, or travel, instead of those in time."""
        return self.pose(phase, 1.0, 0.0, 2, not self.assembly.path.full_turn)

    def _in_floats(self, key: _Key) -> Callable[..., dict[str, Any]]:
        """Return the program of one instant; ValueError where it would cost more than it saves."""
        if self.passing:
            raise ValueError("a mechanism on its way is solved from arrays")
        derivatives, accelerates, per_input = key
        trace = self.trace(Variant(True, accelerates, per_input=per_input))
        found = self._poses[key] = _scalar(*trace, derivatives)
        return found

    def trace(self, variant: Variant) -> Traced:
        """Record the formulas of all quantities, lengths in the scene's unit."""
        found = self._traces.get(variant)
        if found is None:
            graph = Graph()
            uniform = not variant.varying_rate
            second = graph.input("a", uniform=uniform) if variant.accelerates else 0.0
            pace = Slope(graph.input("w", uniform=uniform), second)
            names, state = self._state(graph, pace, variant)
            unscale = self.assembly.unscale
            places = zip(COORDINATE, state.coordinate(unscale), strict=True)
            driven = {kind: {"": (value,)} for kind, value in places}
            rows = dict(_quantities(walked(self.assembly, state), unscale))
            graph.forget()
            found = self._traces[variant] = names, driven | rows
        return found

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
        found = {kind: _plain(values) for kind, values in motion.every.items()}
        inputs = ("phase", "input_speed", "input_acceleration", *COORDINATE)
        return found | {name: float(getattr(motion, name)) for name in inputs} | {"setting": self}

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
        given = np.asarray(angle if phase is None else phase, dtype=np.float64)
        by_phase, sign = None, 1.0
        if phase is not None and self.retraced:
            by_phase, (given, sign) = given, retraced(given)
        (w, a), shape = _rates(speed, acceleration, given.shape)
        varying, back, rates = isinstance(w, np.ndarray), None, (w, a)
        if by_phase is not None:
            signs = np.broadcast_to(sign, shape).reshape(-1)
            back, rates = (None, (signs * w, signs * a)) if varying else (signs < 0, rates)
        variant = Variant(phase is not None, varying or rates[1] != 0.0, varying)
        x = _kept(given, shape)
        distances = self.assembly.path.distances(x) if phase is None else None
        shown = None if by_phase is None else _kept(by_phase, shape)
        instants = Instants(variant, x, distances, rates, shape, derivatives, shown, back)
        return Motion(self, _shaped(w, shape), _shaped(a, shape), instants)

    def program(self, variant: Variant, kinds: tuple[str, ...]) -> tuple[Batch, ResultLayout]:
        """Return the program over arrays that works quantities out, and where its results lie."""
        found = self._programs.get((variant, kinds))
        if found is None:
            found = self._programs[variant, kinds] = self._compiled(variant, kinds)
        return found

    def _compiled(self, variant: Variant, kinds: tuple[str, ...]) -> tuple[Batch, ResultLayout]:
        names, rows = self.trace(variant)
        rates = ("w", "a") if variant.accelerates else ("w",)
        varying = {**dict.fromkeys(names, True), **dict.fromkeys(rates, variant.varying_rate)}
        pins = {joint.name: joint.position for joint in self.linkage.pins}
        places = layout({kind: rows[kind] for kind in kinds}, pins, VECTORS[:3])
        made = ((program, laid) for (like, _), (program, laid) in self._programs.items() if like == variant)
        known = (program for program, laid in made if laid.kinds == places.kinds)
        return next(known, None) or batch(varying, places.outputs), places


def _scalar(names: tuple[str, ...], rows: Rows, derivatives: int) -> Callable[..., dict[str, Any]]:
    """Return the program of one instant in plain floats."""
    outputs: list[Value] = []
    parts = ["'setting': setting, 'phase': x, 'input_speed': w, 'input_acceleration': a"]
    for kind, values in rows.items():
        if kind in COORDINATE or (values and DERIVATIVE_OF[kind] <= derivatives):
            outputs.extend(component for components in values.values() for component in components)
            parts.append(f"{kind!r}: {'{}' if kind in COORDINATE else _dict_display(values)}")
    display = f"{{{{{', '.join(parts)}}}}}"
    return scalar((*names, "w", "a", "setting"), outputs, display)


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


def _shaped(rate: Any, shape: tuple[int, ...]) -> Any:
    """Return a rate in a shape: arrays have it, one number holds for all."""
    return rate.reshape(shape) if isinstance(rate, np.ndarray) else rate


def _kept(values: Array, shape: tuple[int, ...]) -> Array:
    """Return the values along one axis, repeated to the shape, as nobody can change them any more."""
    if values.base is not None or values.flags.writeable or values.shape != shape:
        values = values.copy() if values.shape == shape else np.array(np.broadcast_to(values, shape))
        values.flags.writeable = False
    return values if values.ndim == 1 else values.reshape(-1)


def _quantities(walk: Walk, unscale: float) -> Iterator[tuple[str, Mapping[str, tuple[Value, ...]]]]:
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
    travels = {name: (way.value, way.rate, way.second) for name, way in sliding}
    for kind in NUMBERS:
        order = DERIVATIVE_OF[kind]
        if kind.startswith("angular"):
            yield kind, {name: (rates[order - 1],) for name, rates in turnings.items()}
        else:
            yield kind, {name: (ways[order] * unscale,) for name, ways in travels.items()}


@lru_cache(maxsize=1)
def _assembled(linkage: Linkage) -> tuple[Assembly, Separations | None]:
    """Return the linkage put together, and how its dyads on moving points fare, if it has any."""
    assembly = assemble(linkage)
    chained = not assembly.signs.keys() <= assembly.loops.keys()
    return assembly, separations(assembly) if chained else None


def stopped(linkage: Linkage) -> Mechanism | None:
    """Return a linkage whose input does not turn fully, for how far it goes; None of others.

    That is known long before all that it takes to solve it. AssemblyError where it cannot be put together.
    """
    assembly, found = _assembled(linkage)
    assembly = limits.stopped(assembly, linkage, found) if found else assembly
    return None if assembly.path.full_turn else Mechanism(linkage, assembly)


@lru_cache(maxsize=8)
def mechanism(linkage: Linkage) -> Mechanism:
    """Return the linkage made ready; AssemblyError where it cannot be put together."""
    assembly, fare = _assembled(linkage)
    found = Mechanism(linkage, limits.restricted(assembly, linkage, fare) if fare else assembly)
    found.trace(Variant(True, False))  # which a pose needs, and says what is not one rigid body
    return found


def passing(linkage: Linkage) -> Mechanism:
    """Return a linkage on the way between two whose dyads down the chain close all along.

    They are not looked at: where one does not close after all, its joints are NaN.
    """
    return Mechanism(linkage, assemble(linkage), passing=True)
