"""Somebody else's table, laid over a curve: how far its values are from ours."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from linkanim.bounds import MOST_ROWS_READ
from linkanim.digits import significant
from linkanim.errors import BadInput, OutOfRange
from linkanim.export import columns
from linkanim.intake import Intake, named
from linkanim.mechanics.facts.register import plain_unit
from linkanim.number_table import NumberRow, read_numbers
from linkanim.paper.curves import Curve, Curves
from linkanim.picture.diagrams.course import Floats
from linkanim.picture.look import Over
from linkanim.units import shown

_TABLE_FILE = Intake("a table of two columns", most_bytes=1_000_000, most_values=2 * MOST_ROWS_READ)
_SECONDS = re.compile(r"\W*(t|time|s|sec|seconds?)\b", re.IGNORECASE)
"""What a column of times is headed."""
_CLEARLY = 5.0
"""A column that fits so many times as well by another unit is one of that."""
_FEWEST = 4
"""So many rows tell in which unit they are."""
_MOST_SHOWN, _ENDS = 40, 15
"""Of more rows so many at either end are printed."""
_DIGITS = 7


class MeasuredTable(NamedTuple):
    """A table of two columns: what the first is called, if anything, and its rows' lines and numbers."""

    where: str
    heading: str
    rows: tuple[NumberRow, ...]

    def column(self, number: int) -> Floats:
        """Return a column."""
        return np.array([row.numbers[number] for row in self.rows])


@dataclass(frozen=True)
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
        with np.errstate(divide="ignore", invalid="ignore"):
            percent = 100 * self.differences / abs(self.ours)
        found = np.stack([self.inputs, self.ours, self.values, self.differences, percent], axis=1)
        rows = [[significant(cell, _DIGITS if n < 3 else 3) for n, cell in enumerate(row)] for row in found]
        if len(rows) > _MOST_SHOWN:
            left_out = [f"... {len(rows) - 2 * _ENDS:,} more", *[""] * (len(titles) - 1)]
            rows[_ENDS:-_ENDS] = [left_out]
        return columns([titles, *rows])


_UNITS: dict[Over, str] = {"angle": "deg", "phase": "deg", "time": "s"}
_WORDS: dict[Over, str] = {"angle": "degrees", "phase": "degrees", "time": "seconds"}


def read_table(path: Path, over: Over) -> MeasuredTable:
    """Return a table's first two columns: what `--over` says, and value.

    BadInput where it cannot be read, a line has not two finite numbers, or a comma may be either mark.
    """
    where = named(path)
    found = read_numbers(_TABLE_FILE.read(path, where), where, f"{_WORDS[over]}, value")
    for line, numbers in found.rows:
        if len(numbers) > 2 and all(map(float.is_integer, numbers)):
            raise BadInput(
                f"{where}: line {line} has {len(numbers)} whole numbers: a comma in it is a decimal mark or "
                "stands between columns; put semicolons between the columns"
            )
    return MeasuredTable(where, found.heading[0] if found.heading else "", found.rows)


def usual_over(curves: Curves) -> Over:
    """Return what a table's first column is where `--over` does not say: an input's angle, or the time."""
    return curves.over or ("angle" if curves.scene.linkage.drive.coordinate.is_angle else "time")


def beside(curves: Curves, table: MeasuredTable, label: str) -> MeasuredCurve:
    """Return a table beside the first curve, each of its rows solved exactly.

    OutOfRange for an angle that the input does not reach; BadInput where the column is not in the unit that
    `--over` says: by its heading, or since it fits by another one.
    """
    curve, over = curves.curves[0], usual_over(curves)
    if len(curve.quantity.columns) > 1:
        token = curve.quantity.token
        raise BadInput(f"--data goes with one curve; take {token}.x or {token}.y")
    _refuse_other_unit(curves, curve, table, over)
    phases = _phases(curves, curve, table.column(0), over)
    if np.isnan(phases).any():
        row = table.rows[int(np.isnan(phases).argmax())]
        raise OutOfRange(
            f"{table.where}: line {row.line}, column 1: the input of {curves.scene.name} does not reach "
            f"{row.numbers[0]:g} deg; of times add --over time"
        )
    ours, differences = _differences(curves, curve, phases, table.column(1))
    if not np.isfinite(differences).any():
        raise BadInput(f"{label}: {curve.quantity.token} has no value at any row of it")
    places = curves.places(curve, curves.scene.solve(phase=phases, derivatives=0))
    known = (table.column(0), np.asarray(places, float), table.column(1), ours, differences)
    return MeasuredCurve(label, curve, over, *known)


def _phases(curves: Curves, curve: Curve, column: Floats, over: Over) -> Floats:
    """Return the phase of each row, NaN for an angle that the input does not reach."""
    if over == "angle":
        phases: Floats = curves.scene.solve(angle=np.radians(column), derivatives=0).phase
        return phases
    return np.radians(column) if over == "phase" else column * curve.pace.speed


def _differences(curves: Curves, curve: Curve, phases: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Return our values, those of an angle in the turn of the table's, and how far the table's are off."""
    motion = curves.scene.solve(phase=phases, speed=curve.pace.speed)
    differences = values - np.asarray(curve.quantity.shown(motion), float)
    if curve.quantity.unit == "rad":
        differences = np.remainder(differences + 180, 360) - 180
    return values - differences, differences


def _refuse_other_unit(curves: Curves, curve: Curve, table: MeasuredTable, over: Over) -> None:
    """Raise BadInput for seconds where degrees are meant, and the other way round."""
    in_time = over == "time"
    degrees: Over = "angle" if curves.scene.linkage.drive.coordinate.is_angle else "phase"
    other: Over = degrees if in_time else "time"
    headed = not in_time and bool(_SECONDS.match(table.heading))
    if headed or _misfit(curves, curve, table, over) > _CLEARLY * _misfit(curves, curve, table, other):
        why = f"is headed {shown(table.heading)}" if headed else f"fits as {_WORDS[other]}"
        raise BadInput(
            f"{table.where}: column 1 {why}, and is read as {_WORDS[over]}; add --over {other}, or give "
            f"{_WORDS[over]}"
        )


def _misfit(curves: Curves, curve: Curve, table: MeasuredTable, over: Over) -> float:
    """Return how far a table is off by its median where the first column is read so; inf for what cannot be.

    NaN of a table too short to tell.
    """
    if len(table.rows) < _FEWEST:
        return np.nan
    phases = _phases(curves, curve, table.column(0), over)
    if np.isnan(phases).any():
        return np.inf
    _, differences = _differences(curves, curve, phases, table.column(1))
    known = differences[np.isfinite(differences)]
    return float(np.median(abs(known))) if known.size else np.inf
