"""Compute curves of quantities over one true period, at one speed or several, beside a measured table.

A chart and its table show the same curves. A table of other values is compared with ours.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from math import degrees, floor, tau
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from linkanim.bounds import MOST_ROWS_READ
from linkanim.errors import BadInput, OutOfRange
from linkanim.export import columns
from linkanim.frozen import frozen
from linkanim.intake import Intake, NumberTable, named, read_numbers
from linkanim.mechanics.motion import Motion
from linkanim.mechanics.quantities import Quantity, plain_unit
from linkanim.mechanics.search import highest
from linkanim.picture.look import Over
from linkanim.picture.quantities import (
    Axis,
    Floats,
    course,
    input_title,
    linear,
    quantity,
    series_of,
)
from linkanim.scenes.scene import Scene
from linkanim.units import short, shown, signed, significant, stepped, typeset

# Curves of quantities over one true period, at one speed or several: what a chart and its table show.

SAMPLES = 720
"""Samples of a curve in each period of the drive."""
_MOST_PERIODS = 8
_ROUNDING = 1e-6
"""The rounding error of an angle, in degrees."""


class Pace(NamedTuple):
    """A speed in rad/s, its words as they were asked for, and the input's acceleration at it, rad/s²."""

    speed: float
    words: str
    acceleration: float = 0.0

    def motion(self, scene: Scene, phases: ArrayLike) -> Motion:
        """Return a scene's motion at phases, at this speed at each of them."""
        return scene.solve(phase=phases, speed=self.speed, acceleration=self.acceleration)


@frozen
class Curve:
    """One curve: its places along the axis and values there, and the phase at each place."""

    quantity: Quantity
    pace: Pace
    label: str
    """The component of a vector, x or y, that the curve is; empty for a number."""
    x: Floats
    values: Floats
    phases: Floats

    def solved(self, scene: Scene, phases: Floats) -> Floats:
        """Return its values at `phases` (rad), shape (n,); an angle may differ by whole turns."""
        values = np.asarray(self.quantity.displayed(self.pace.motion(scene, phases)), float)
        return values[:, self.quantity.columns.index(self.label)] if values.ndim == 2 else values


@frozen
class Curves:
    """All curves of a chart, and the axis that they share."""

    scene: Scene
    curves: tuple[Curve, ...]
    title: str
    """The title of the shared axis, with its unit."""
    low: float
    high: float
    unit: str
    marks: tuple[tuple[float, str], ...]
    over: Over | None

    @property
    def in_time(self) -> bool:
        """Whether they run over time: as asked for, or as an input that swings passes each place twice."""
        return self.over == "time" or (self.over is None and not self.scene.info.full_turn)

    def places(self, curve: Curve, motion: Motion) -> Floats:
        """Return where the instants of a motion lie along the axis of a curve."""
        if _there_and_back(self.scene, self.over):
            return np.degrees(motion.coordinate)
        return course(self.scene, curve.pace.speed, self.over).x_of(motion.phase)

    def axis(self, most: int, least: int = 0) -> Axis:
        """Return the axis that the curves share, with at most `most` ticks, and at least `least`."""
        return linear(self.low, self.high, most=most, unit=self.unit, least=least)

    def place_words(self, x: float) -> str:
        """Return a place along the axis in its unit: 87.0°, 1.25 s."""
        return f"{stepped(x, 0.1)}°" if self.unit else f"{typeset(short(float(f'{x:.4g}')))} s"

    def words(self, curve: Curve) -> str:
        """Return what sets a curve off from the others: quantity, component, speed, as far as they differ."""
        return self._distinguishing(curve, curve.quantity.named)

    def name(self, curve: Curve) -> str:
        """Return the words that set a curve off, with the quantity's symbol in the place of its words."""
        return self._distinguishing(curve, curve.quantity.symbol)

    def _distinguishing(self, curve: Curve, called: str) -> str:
        several = len({other.quantity.token for other in self.curves}) > 1
        paces = len({other.pace for other in self.curves}) > 1
        words = called if several or not (paces or curve.label) else ""
        return ", ".join(
            part for part in (words, curve.label, signed(curve.pace.words) if paces else "") if part
        )


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
    curves = tuple(chain.from_iterable(of_each))
    longest = max((course(scene, pace.speed, over) for pace in paces), key=lambda one: one.span)
    if _there_and_back(scene, over):
        low, high = map(degrees, scene.info.input_range)
        return Curves(scene, curves, input_title(scene), low, high, "°", (), over)
    marks = longest.marks if len(paces) == 1 else ()
    return Curves(scene, curves, longest.title, 0.0, longest.span, longest.unit, marks, over)


def within_a_turn(curves: Curves) -> Curves:
    """Return curves with angles shifted by whole turns: between 0° and 360° if they fit, else about 0°."""
    return replace(curves, curves=tuple(_within_a_turn(curve) for curve in curves.curves))


def _within_a_turn(curve: Curve) -> Curve:
    values = curve.values[np.isfinite(curve.values)]
    if curve.quantity.unit != "rad" or curve.quantity.order or not values.size:
        return curve
    low, high = float(values.min()), float(values.max())
    turns = floor((low + _ROUNDING) / 360)
    if high - 360 * turns > 360 + _ROUNDING:
        turns = round((low + high) / 720)
    return replace(curve, values=curve.values - 360 * turns)


def _there_and_back(scene: Scene, over: Over | None) -> bool:
    """Return whether the curves run over an angle that swings."""
    return over == "angle" and not scene.info.full_turn


def _of(scene: Scene, one: Quantity, pace: Pace, over: Over | None, cycle: Motion) -> Iterator[Curve]:
    """Yield the curve of a quantity, or one for each component of a vector."""
    series = series_of(scene, one, pace.motion(scene, cycle.phase))
    series = series.broken(one.unbounded_between(cycle))
    if _there_and_back(scene, over):
        angle = np.degrees(scene.solve(phase=series.phases, derivatives=0).coordinate)
        x, phases = np.append(angle, angle[0]), np.append(series.phases, scene.period)
        values = np.vstack([series.values, series.values[0] + series.gain])
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
    """Return the greatest value (`sign` +1) or the least (-1), found by search about its sample."""
    index = int(np.nanargmax(sign * curve.values))
    ends = sorted((curve.phases[0], curve.phases[-1]))
    phase, reach = float(curve.phases[index]), float(np.abs(np.diff(curve.phases)).max())
    # Where a point rests for an instant its path has no direction there, and nothing along it a value.
    phase = highest(lambda near: sign * curve.solved(scene, near), phase, reach, (ends[0], ends[1]))
    value = float(curve.solved(scene, np.array([phase]))[0])
    if curve.quantity.unit == "rad":
        value += 360 * round((curve.values[index] - value) / 360)
    angle = scene.linkage.drive.coordinate.displayed(scene.pose(phase, 0).coordinate)
    way = slice(None, None, 1 if curve.phases[-1] > curve.phases[0] else -1)
    x = float(np.interp(phase, curve.phases[way], curve.x[way]))
    return Peak(x, value, angle % 360 if scene.info.full_turn else angle)


_OURS = "angle_deg"
"""The heading of the first column in a table of `table`."""


def table(curves: Curves) -> tuple[list[str], list[Floats]]:
    """Return names and columns of a table: the input's angle in degrees, then angle, phase, time, quantities.

    Where a slider drives, its travel stands for the angle. Angles are radians and lengths the scene's unit,
    as in all CSV. Where there are several speeds, each column names its own; times are negative where the
    phase runs back.
    """
    scene = curves.scene
    phases = np.linspace(0.0, scene.period, SAMPLES // 2 * round(scene.period / tau) + 1)
    motion = scene.solve(phase=phases)
    angle = motion.coordinate
    names, columns = [_OURS, "angle", "phase"], [np.degrees(angle), angle, phases]
    if not scene.linkage.drive.coordinate.is_angle:
        names, columns = [scene.linkage.drive.coordinate.name, "phase"], [angle, phases]
    several = len({curve.pace for curve in curves.curves}) > 1
    for pace in dict.fromkeys(curve.pace for curve in curves.curves):
        paced = pace.motion(scene, phases)
        words = f"@{pace.words}" if several else ""
        names.append(f"time{words}")
        columns.append(phases / pace.speed)
        for one in dict.fromkeys(curve.quantity for curve in curves.curves):
            values = np.asarray(one.read(paced), float)
            for label, column in zip(one.columns, np.atleast_2d(values.T), strict=True):
                names.append(".".join(filter(None, (one.token, label))) + words)
                columns.append(column)
    return names, columns


# A table of other values, laid over a curve: how far they are from ours.

_TABLE_FILE = Intake("a table of two columns", most_bytes=1_000_000, most_values=2 * MOST_ROWS_READ)
_SECONDS = re.compile(r"\W*(t|time|s|sec|seconds?)\b", re.IGNORECASE)
"""The headings of a column of times."""
_CLEARLY = 5.0
"""A column that fits this many times better in another unit is in that unit."""
_FEWEST = 4
"""The fewest rows from which their unit can be told."""
_MOST_SHOWN, _ENDS = 40, 15
"""The most rows that are all printed, and how many are printed at either end of a longer table."""
_DIGITS = 7


@frozen
class MeasuredCurve:
    """A table beside a curve: its places along the curve's axis, both values and their difference (n,).

    Its `inputs` are as they stand in the table: degrees of the input or its phase, or seconds.
    """

    label: str
    curve: Curve
    over: Over
    inputs: Floats
    places: Floats
    values: Floats
    ours: Floats
    differences: Floats

    @property
    def points(self) -> list[tuple[float, float]]:
        """Its points on the chart."""
        return list(zip(self.places.tolist(), self.values.tolist(), strict=True))

    @property
    def worst(self) -> int:
        """The row with the largest difference."""
        return int(np.nanargmax(np.where(np.isfinite(self.differences), abs(self.differences), np.nan)))

    def percent(self) -> Floats:
        """Return the differences in percent of our values."""
        with np.errstate(divide="ignore", invalid="ignore"):
            percent: Floats = 100 * self.differences / abs(self.ours)
        return percent

    def table(self, length_unit: str) -> str:
        """Return both and their difference, in the unit and in percent of ours, in aligned columns."""
        one = self.curve.quantity
        unit = plain_unit(one.unit, length_unit)
        titles = [
            f"{self.over} {_UNITS[self.over]}",
            f"{one.token} {unit}".rstrip(),
            self.label,
            f"difference {unit}".rstrip(),
            "percent",
        ]
        found = np.stack([self.inputs, self.ours, self.values, self.differences, self.percent()], axis=1)
        rows = [[significant(cell, _DIGITS if n < 3 else 3) for n, cell in enumerate(row)] for row in found]
        if len(rows) > _MOST_SHOWN:
            left_out = [f"... {len(rows) - 2 * _ENDS:,} more", *[""] * (len(titles) - 1)]
            rows[_ENDS:-_ENDS] = [left_out]
        return columns([titles, *rows])


_UNITS: dict[Over, str] = {"angle": "deg", "phase": "deg", "time": "s"}
_WORDS: dict[Over, str] = {"angle": "degrees", "phase": "degrees", "time": "seconds"}


def read_table(path: Path, over: Over, one: Quantity) -> NumberTable:
    """Return two columns of a table: its first, which is what `--over` says, and that of a quantity.

    Of more than two columns the second is the one that has the quantity as its heading. Angles are in
    degrees, or in radians in a table of ours. BadInput where no column has that heading, the file cannot be
    read, a line lacks two finite numbers, or a comma may be a decimal mark or a separator.
    """
    where = named(path)
    read = read_numbers(_TABLE_FILE.read(path, where), where, f"{_WORDS[over]}, value")
    for line, numbers in read.rows:
        if len(numbers) > 2 and all(map(float.is_integer, numbers)):
            raise BadInput(
                f"{where}: line {line} has {len(numbers)} whole numbers: a comma in it is a decimal mark or "
                "stands between columns; put semicolons between the columns"
            )
    n = 1
    if len(read.heading) > 2:
        if one.token not in read.heading[1:]:
            raise BadInput(
                f"{where}: none of its {len(read.heading)} columns is headed {one.token}; head one so, "
                "or give two columns"
            )
        n = read.heading.index(one.token)
        read.refuse_ragged()
    return read.beside_first(n, np.degrees(1.0) if read.first == _OURS and one.unit == "rad" else 1.0)


def read_tables(path: Path) -> dict[str, NumberTable]:
    """Return each further column of a table beside its first one, by the quantity that heads it.

    BadInput as `read_table`, and where the columns have no names or a row has another number of cells.
    """
    where = named(path)
    numbers = read_numbers(_TABLE_FILE.read(path, where), where, "angle, then a column for each quantity")
    tokens = numbers.heading[1:]
    if not tokens:
        raise BadInput(f"{where}: its columns have no names; head them, such as angle, 3.angular_velocity")
    numbers.refuse_ragged()
    return {token: numbers.beside_first(n) for n, token in enumerate(tokens, 1)}


def _column(table: NumberTable, number: int) -> Floats:
    """Return a column as an array (n,)."""
    return np.array([row[number] for _, row in table.rows])


def compared(
    scene: Scene, token: str, pace: Pace, table: NumberTable, label: str
) -> tuple[Curves, MeasuredCurve]:
    """Return a quantity's curve with a table beside it, over that one's input; errors as `comparison`."""
    over: Over | None = "time" if _SECONDS.match(table.first) else None
    curves = curves_of(scene, (token,), (pace,), over)
    return curves, comparison(curves, table, label)


def usual_over(curves: Curves) -> Over:
    """Return what a table's first column is: as `--over` says, else the input's angle, or the time."""
    return curves.over or ("angle" if curves.scene.linkage.drive.coordinate.is_angle else "time")


def comparison(curves: Curves, table: NumberTable, label: str) -> MeasuredCurve:
    """Return a table beside the first curve, each of its rows solved exactly.

    OutOfRange for an angle that the input does not reach. BadInput where the first column is not what
    `--over` says, by its heading or because it fits far better otherwise; for a vector; and where no row has
    a value.
    """
    curve, over = curves.curves[0], usual_over(curves)
    if len(curve.quantity.columns) > 1:
        token = curve.quantity.token
        raise BadInput(f"--data goes with one curve; take {token}.x or {token}.y")
    _refuse_other_unit(curves, curve, table, over)
    phases = _phases(curves, curve, _column(table, 0), over)
    if np.isnan(phases).any():
        line, row = table.rows[int(np.isnan(phases).argmax())]
        raise OutOfRange(
            f"{table.where}: line {line}, column 1: the input of {curves.scene.name} does not reach "
            f"{row[0]:g} deg; for times add --over time"
        )
    ours, differences = _differences(curves, curve, phases, _column(table, 1))
    if not np.isfinite(differences).any():
        raise BadInput(f"{label}: {curve.quantity.token} has no value at any row of it")
    places = curves.places(curve, curves.scene.solve(phase=phases, derivatives=0))
    known = (_column(table, 0), np.asarray(places, float), _column(table, 1), ours, differences)
    return MeasuredCurve(label, curve, over, *known)


def _phases(curves: Curves, curve: Curve, column: Floats, over: Over) -> Floats:
    """Return the phase of each row, NaN for an angle that the input does not reach."""
    if over == "angle":
        phases: Floats = curves.scene.solve(angle=np.radians(column), derivatives=0).phase
        return phases
    return np.radians(column) if over == "phase" else column * curve.pace.speed


def _differences(curves: Curves, curve: Curve, phases: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Return our values, an angle in the same turn as the table's, and the table's differences from them."""
    motion = curves.scene.solve(phase=phases, speed=curve.pace.speed)
    differences = values - np.asarray(curve.quantity.displayed(motion), float)
    if curve.quantity.unit == "rad":
        differences = np.remainder(differences + 180, 360) - 180
    return values - differences, differences


def _refuse_other_unit(curves: Curves, curve: Curve, table: NumberTable, over: Over) -> None:
    """Raise BadInput for seconds where degrees are meant, and the other way round."""
    in_time = over == "time"
    degrees: Over = "angle" if curves.scene.linkage.drive.coordinate.is_angle else "phase"
    other: Over = degrees if in_time else "time"
    headed = not in_time and bool(_SECONDS.match(table.first))
    if headed or _misfit(curves, curve, table, over) > _CLEARLY * _misfit(curves, curve, table, other):
        why = f"is headed {shown(table.first)}" if headed else f"fits as {_WORDS[other]}"
        raise BadInput(
            f"{table.where}: column 1 {why}, and is read as {_WORDS[over]}; add --over {other}, or give "
            f"{_WORDS[over]}"
        )


def _misfit(curves: Curves, curve: Curve, table: NumberTable, over: Over) -> float:
    """Return the median of a table's differences where its first column is read as `over`.

    It is inf where the input does not reach an angle, NaN for a table that is too short to tell.
    """
    if len(table.rows) < _FEWEST:
        return np.nan
    phases = _phases(curves, curve, _column(table, 0), over)
    if np.isnan(phases).any():
        return np.inf
    _, differences = _differences(curves, curve, phases, _column(table, 1))
    known = differences[np.isfinite(differences)]
    return float(np.median(abs(known))) if known.size else np.inf
