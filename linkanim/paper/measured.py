"""Somebody else's table, laid over a curve: how far its values are from ours."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import BadInput, OutOfRange
from linkanim.paper.curves import Curve, Curves


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
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            lines = [line for line in csv.reader(file) if any(cell.strip() for cell in line)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "it is not a table of text"
        raise BadInput(f"{path}: cannot be read: {str(reason).lower()}") from error
    body = lines[1:] if lines and not _are_numbers(lines[0]) else lines
    if not body:
        raise BadInput(f"{path}: has no rows; give a CSV of two columns, angle in degrees and value")
    for number, line in enumerate(body, start=1 + len(lines) - len(body)):
        if not _are_numbers(line):
            said = ",".join(line)
            raise BadInput(f"{path}: row {number} has not two numbers, angle in degrees and value: {said!r}")
    return np.array([[float(cell) for cell in line[:2]] for line in body])


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
