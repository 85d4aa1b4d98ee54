"""Somebody else's table, laid over a curve: how far its values are from ours."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from linkanim.bounds import MOST_ROWS_READ
from linkanim.errors import BadInput, OutOfRange
from linkanim.intake import Intake, control_in, named
from linkanim.paper.curves import Curve, Curves
from linkanim.units import shown

_TABLE_FILE = Intake("a table of two columns", most_bytes=1_000_000, most_values=2 * MOST_ROWS_READ)


@dataclass(frozen=True)
class MeasuredCurve:
    """Points of a table beside a curve, and the largest difference from it in words."""

    label: str
    curve: Curve
    points: list[tuple[float, float]]
    largest: float
    angle: float
    """Of the input in degrees, where the difference is largest."""


def read_table(path: Path) -> NDArray[np.float64]:
    """Return a table's first two columns, angle in degrees and value (n, 2); a line of titles may come first.

    BadInput where it cannot be read, or a line has not two finite numbers.
    """
    where = named(path)
    lines = _lines(_TABLE_FILE.read(path, where), where)
    body = lines[1:] if lines and not _are_numbers(lines[0]) else lines
    if not body:
        raise BadInput(f"{where}: has no rows; give a CSV of two columns, angle in degrees and value")
    for number, line in enumerate(body, start=1 + len(lines) - len(body)):
        if not _are_numbers(line):
            text = shown(",".join(line))
            raise BadInput(f"{where}: row {number} has not two numbers, angle in degrees and value: {text}")
    return np.array([[float(cell) for cell in line[:2]] for line in body])


def _lines(text: str, where: str) -> list[list[str]]:
    """Return a table's lines that hold anything, each in its cells."""
    for number, line in enumerate(text.split("\n"), start=1):
        if found := control_in(line):
            raise BadInput(f"{where}: line {number} has {found} in it; save it as plain text")
    try:
        cells = csv.reader(StringIO(text, newline=""))
        lines = [line for line in cells if any(cell.strip() for cell in line)]
    except csv.Error:
        raise BadInput(f"{where}: cannot be read: it is not a table of text") from None
    if len(lines) > MOST_ROWS_READ + 1:
        count = f"{len(lines):,} rows; {MOST_ROWS_READ:,} are the most that are read"
        raise BadInput(f"{where}: has {count}: keep every tenth or so")
    return lines


def _are_numbers(line: list[str]) -> bool:
    try:
        return len(line) >= 2 and bool(np.isfinite([float(cell) for cell in line[:2]]).all())
    except ValueError:
        return False


def beside(curves: Curves, table: NDArray[np.float64], label: str) -> MeasuredCurve:
    """Return a table beside the first curve, each of its angles solved exactly.

    OutOfRange for an angle that the input does not reach.
    """
    curve, scene = curves.curves[0], curves.scene
    if len(curve.quantity.columns) > 1:
        raise BadInput(
            f"--data goes with one curve; take {curve.quantity.token}.x or {curve.quantity.token}.y"
        )
    phases = scene.solve(angle=np.radians(table[:, 0]), derivatives=0).phase
    if np.isnan(phases).any():
        beyond = table[np.isnan(phases), 0][0]
        raise OutOfRange(f"{label}: the input of {scene.name} does not reach {beyond:g} deg")
    motion = scene.solve(phase=phases, speed=curve.pace.speed)
    differences = table[:, 1] - np.asarray(curve.quantity.shown(motion), float)
    if curve.quantity.unit == "rad":
        differences = np.remainder(differences + 180, 360) - 180
    if not np.isfinite(differences).any():
        raise BadInput(f"{label}: {curve.quantity.token} has no value at any of its angles")
    worst = int(np.nanargmax(np.where(np.isfinite(differences), np.abs(differences), np.nan)))
    places = curves.places(curve, motion)
    points = [(float(x), float(value)) for x, value in zip(places, table[:, 1], strict=True)]
    return MeasuredCurve(label, curve, points, float(differences[worst]), float(table[worst, 0]))
