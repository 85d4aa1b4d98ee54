"""Curves of quantities over one true period, at one speed or several: what a chart and its table show."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from math import degrees, tau
from typing import NamedTuple

import numpy as np

from linkanim.errors import BadInput
from linkanim.mechanics.closing.search import highest
from linkanim.mechanics.facts.register import Quantity
from linkanim.mechanics.motion.motion import Motion
from linkanim.picture.diagrams.axis import Axis, linear
from linkanim.picture.diagrams.course import Floats, course, gain_of, input_title
from linkanim.picture.diagrams.quantities import broken, quantity, series_of
from linkanim.picture.look import Over
from linkanim.scenes.scene import Scene

SAMPLES = 720
"""For each period of the drive."""
_MOST_PERIODS = 8


class Pace(NamedTuple):
    """A speed in rad/s, and in the words in which it was asked for."""

    speed: float
    words: str


@dataclass(frozen=True)
class Curve:
    """One curve: its places along the axis and values there, and the phase at each place."""

    quantity: Quantity
    pace: Pace
    label: str
    """The component of a vector that it is, if any."""
    x: Floats
    values: Floats
    phases: Floats

    def solved(self, scene: Scene, phases: Floats) -> Floats:
        """Return its values at any phases, of an angle in any turn."""
        values = np.asarray(self.quantity.shown(scene.solve(phase=phases, speed=self.pace.speed)), float)
        return values[:, self.quantity.columns.index(self.label)] if values.ndim == 2 else values


@dataclass(frozen=True)
class Curves:
    """All curves of a chart, and the axis that they share."""

    scene: Scene
    curves: tuple[Curve, ...]
    title: str
    """The shared axis', with its unit."""
    low: float
    high: float
    unit: str
    marks: tuple[tuple[float, str], ...]
    over: Over | None

    def places(self, curve: Curve, motion: Motion) -> Floats:
        """Return where the instants of a motion lie along the axis of a curve."""
        if _there_and_back(self.scene, self.over):
            return np.degrees(motion.coordinate)
        return course(self.scene, curve.pace.speed, self.over).x_of(motion.phase)

    def axis(self, most: int) -> Axis:
        """Return the axis that the curves share, with at most so many ticks."""
        return linear(self.low, self.high, most=most, unit=self.unit)

    def words(self, curve: Curve) -> str:
        """Return what sets a curve off from the others: quantity, component, speed, as far as they differ."""
        return self._distinguishing(curve, curve.quantity.words + " " + curve.quantity.symbol)

    def name(self, curve: Curve) -> str:
        """Return the same with the quantity's symbol alone."""
        return self._distinguishing(curve, curve.quantity.symbol)

    def _distinguishing(self, curve: Curve, called: str) -> str:
        several = len({other.quantity.token for other in self.curves}) > 1
        paces = len({other.pace for other in self.curves}) > 1
        words = called if several or not paces else ""
        return ", ".join(part for part in (words, curve.label, curve.pace.words if paces else "") if part)


def curves_of(
    scene: Scene, tokens: tuple[str, ...], paces: tuple[Pace, ...], over: Over | None = None
) -> Curves:
    """Return the curves of quantities; BadInput where the scene has no such quantity, or none is named."""
    quantities = tuple(dict.fromkeys(tokens))
    if not quantities:
        raise BadInput(
            "--quantity names none; give one, such as rocker.angle, or several with commas between"
        )
    known = [quantity(scene, token) for token in quantities]
    periods = min(round(scene.period / tau), _MOST_PERIODS)
    cycle = scene.cycle(scene.mechanism.count(SAMPLES * periods))
    of_each = [_of(scene, one, pace, over, cycle) for one in known for pace in paces]
    found = tuple(chain.from_iterable(of_each))
    longest = max((course(scene, pace.speed, over) for pace in paces), key=lambda one: one.span)
    if _there_and_back(scene, over):
        low, high = map(degrees, scene.info.input_range)
        return Curves(scene, found, input_title(scene), low, high, "°", (), over)
    marks = longest.marks if len(paces) == 1 else ()
    return Curves(scene, found, longest.title, 0.0, longest.span, longest.unit, marks, over)


def _there_and_back(scene: Scene, over: Over | None) -> bool:
    """Whether the curves run over an angle that swings."""
    return over == "angle" and not scene.info.full_turn


def _of(scene: Scene, one: Quantity, pace: Pace, over: Over | None, cycle: Motion) -> Iterator[Curve]:
    """Yield the curve of a quantity, or one for each component of a vector."""
    series = series_of(scene, one, cycle.paced(pace.speed / scene.linkage.drive.speed))
    series = broken(series, one, cycle)
    if _there_and_back(scene, over):
        angle = np.degrees(scene.solve(phase=series.phases, derivatives=0).coordinate)
        x, phases = np.append(angle, angle[0]), np.append(series.phases, scene.period)
        values = np.vstack([series.values, series.values[0] + gain_of(series)])
    else:
        along = course(scene, pace.speed, over)
        x, values = along.laid(series)
        phases = along.phase_of(x)
    for label, column in zip(series.labels, values.T, strict=True):
        yield Curve(one, pace, label, x, column, phases)


class Peak(NamedTuple):
    """An extreme of a curve: where, its value, and the input's angle there in degrees, or slider's travel."""

    x: float
    value: float
    angle: float


def extremes(scene: Scene, curve: Curve) -> tuple[Peak, ...]:
    """Return a curve's greatest and least value.

    A level curve has none, nor has one that is somewhere unbounded.
    """
    values = curve.values[~np.isnan(curve.values)]
    if not values.size or np.isinf(values).any() or np.ptp(values) <= 1e-9 * np.abs(values).max():
        return ()
    return tuple(_peak(scene, curve, sign) for sign in (1, -1))


def _peak(scene: Scene, curve: Curve, sign: int) -> Peak:
    """Return the greatest value (`sign` +1) or the least (-1), solved ever closer about its sample."""
    index = int(np.nanargmax(sign * curve.values))
    ends = sorted((curve.phases[0], curve.phases[-1]))
    phase, reach = float(curve.phases[index]), float(np.abs(np.diff(curve.phases)).max())
    # Where a point rests for an instant its path has no direction there, and nothing along it a value.
    phase = highest(lambda near: sign * curve.solved(scene, near), phase, reach, (ends[0], ends[1]))
    value = float(curve.solved(scene, np.array([phase]))[0])
    if curve.quantity.unit == "rad":
        value += 360 * round((curve.values[index] - value) / 360)
    angle = scene.linkage.drive.coordinate.shown(scene.pose(phase, 0).coordinate)
    way = slice(None, None, 1 if curve.phases[-1] > curve.phases[0] else -1)
    x = float(np.interp(phase, curve.phases[way], curve.x[way]))
    return Peak(x, value, angle % 360 if scene.info.full_turn else angle)


def table(curves: Curves) -> tuple[list[str], list[Floats]]:
    """Return names and columns of a table: the input's angle in degrees, then angle, phase, time, quantities.

    Where a slider drives, its travel stands for the angle.
    Angles are radians and lengths the scene's unit, as in all CSV. Of several speeds each column says its
    own; times are negative where the phase runs back.
    """
    scene = curves.scene
    phases = np.linspace(0.0, scene.period, SAMPLES // 2 * round(scene.period / tau) + 1)
    motion = scene.solve(phase=phases)
    angle = motion.coordinate
    names, columns = ["angle_deg", "angle", "phase"], [np.degrees(angle), angle, phases]
    if not scene.linkage.drive.coordinate.is_angle:
        names, columns = [scene.linkage.drive.coordinate.name, "phase"], [angle, phases]
    several = len({curve.pace for curve in curves.curves}) > 1
    for pace in dict.fromkeys(curve.pace for curve in curves.curves):
        paced = motion.paced(pace.speed / scene.linkage.drive.speed)
        words = f"@{pace.words}" if several else ""
        names.append(f"time{words}")
        columns.append(phases / pace.speed)
        for one in dict.fromkeys(curve.quantity for curve in curves.curves):
            values = np.asarray(one.read(paced), float)
            for label, column in zip(one.columns, np.atleast_2d(values.T), strict=True):
                names.append(".".join(filter(None, (one.token, label))) + words)
                columns.append(column)
    return names, columns
