"""What a chart's values are shown over: the driven bar's angle, time, or phase, over one true period."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.mechanics.facts.register import input_symbol
from linkanim.picture.diagrams.axis import Axis, linear
from linkanim.picture.diagrams.quantities import Series
from linkanim.picture.look import Over
from linkanim.picture.parts.driven import driven_words
from linkanim.scenes.scene import Scene

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Course:
    """How a phase lies along a chart: `x = (phase - origin) / scale`, from 0 to `span` and over again.

    `period` is the true period in phase; `scale` is negative where the phase runs back over time.
    `marks` are places along it that have a name.
    """

    title: str
    unit: str
    span: float
    period: float
    origin: float
    scale: float
    marks: tuple[tuple[float, str], ...] = ()

    def x_of(self, phase: ArrayLike) -> Floats:
        """Return where phases lie, 0 to `span`."""
        x: Floats = np.mod((np.asarray(phase, float) - self.origin) / self.scale, self.span)
        return x

    def phase_of(self, x: ArrayLike) -> Floats:
        """Return the phases at places, without jumps from 0 to `span`."""
        phase: Floats = self.origin + self.scale * np.asarray(x, float)
        return phase

    def axis(self, most: int) -> Axis:
        """Return the axis with at most so many ticks."""
        return linear(0.0, self.span, most=most, unit=self.unit)

    def laid(self, series: Series) -> tuple[Floats, Floats]:
        """Return a series along the course, both ends with it: x (n + 2,) rising, values (n + 2, k)."""
        gain = gain_of(series)
        x = self.x_of(series.phases)
        turns = np.rint((self.phase_of(x) - series.phases) / self.period)
        order = np.argsort(x)
        x, values = x[order], (series.values + turns[:, None] * gain)[order]
        step = gain if self.scale > 0 else -gain
        before, after = values[-1] - step, values[0]
        part = (self.span - x[-1]) / (self.span - x[-1] + x[0])
        with np.errstate(invalid="ignore"):
            start = after if part == 1.0 else before + (after - before) * part
        return np.r_[0.0, x, self.span], np.vstack([start, values, start + step])


def gain_of(series: Series) -> Floats:
    """Return by how much each column grows in a period: whole turns for an angle, else nothing."""
    values = series.values
    if series.unit != "°" or len(values) < 2:
        return np.zeros(values.shape[1])
    with np.errstate(invalid="ignore"):
        turns = np.rint((2 * values[-1] - values[-2] - values[0]) / 360.0)
    gain: Floats = 360.0 * np.nan_to_num(turns)
    return gain


def axes_of(scene: Scene) -> tuple[Over, ...]:
    """Return over what a chart beside the scene may run, the usual first; not an angle that swings."""
    return ("angle", "time", "phase") if scene.info.full_turn else ("time", "phase")


def axis_of(scene: Scene, over: Over | None) -> Over:
    """Return over what the chart beside the scene runs: `over` where that may be, else the usual."""
    axes = axes_of(scene)
    return over if over in axes else axes[0]


def course(scene: Scene, speed: float, over: Over | None = None) -> Course:
    """Return the course of a scene that runs at `speed` (rad/s, negative: the phase runs back).

    An input that turns is shown over its absolute angle, one that swings over time, unless `over` says.
    BadInput for the angle of an input that is a slider.
    """
    if over == "angle":
        scene.linkage.drive.check_angle(scene.name, "show it over time or phase")
    turns = scene.info.full_turn
    chosen = over or axes_of(scene)[0]
    period = scene.period
    if chosen == "time":
        pace = speed or scene.linkage.drive.speed
        limits = () if turns else tuple(_limits(scene, pace))
        title = "time (s), back on the same closure" if scene.mechanism.retraced else "time (s)"
        return Course(title, "", period / abs(pace), period, 0.0, pace, limits)
    title, origin = input_title(scene), -scene.linkage.drive.start
    if chosen == "phase":
        title, origin = "phase φ (°)", 0.0
    return Course(title, "°", degrees(period), period, origin, radians(1.0))


def input_title(scene: Scene) -> str:
    """Return what an axis of the driven bar's angle is titled: "crank angle θ₂ (°)"."""
    return f"{scene.info.input_name} angle {input_symbol(scene.linkage)} (°)"


def _limits(scene: Scene, pace: float) -> Iterator[tuple[float, str]]:
    """Yield when in a period a swing is at its limits, each with its angle."""
    for half in range(round(scene.period / pi) + 1):
        angle = scene.pose(half * pi, 0).coordinate
        yield half * pi / abs(pace), driven_words(scene, angle)
