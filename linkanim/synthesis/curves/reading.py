"""A curve's file: columns of numbers, or an SVG's first path."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from linkanim.errors import BadInput
from linkanim.intake import Intake, named
from linkanim.number_table import read_numbers
from linkanim.synthesis.curves.svg_path import first_path
from linkanim.synthesis.kinds import Complex, Real

_CURVE_FILE = Intake("a curve: two columns of numbers, or an SVG", most_bytes=5_000_000, most_values=10**7)
_MOST_COLUMNS = 3


class CurveFile(NamedTuple):
    """Points as x + yi, and what the third column says of each: the crank's angle in radians, or nothing."""

    points: Complex
    angles: Real | None


def read_curve(path: Path) -> CurveFile:
    """Return the curve in a file, by its ending an SVG or else a table.

    A table has two columns, x and y, or three, the last an angle in degrees. An SVG's y axis is turned up.
    BadInput, naming file and line, where it cannot be read.
    """
    where = named(path)
    text = _CURVE_FILE.read(path, where)
    if path.suffix.lower() == ".svg":
        return CurveFile(np.conj(first_path(text, where)), None)
    rows = read_numbers(text, where, "x, y").rows
    for line, numbers in rows:
        if len(numbers) > _MOST_COLUMNS:
            raise BadInput(f"{where}: line {line} has {len(numbers)} columns; give x, y and at most an angle")
    angles = [row.numbers[2] for row in rows if len(row.numbers) > 2]
    if angles and len(angles) < len(rows):
        raise BadInput(f"{where}: {len(angles)} of {len(rows)} rows have an angle; give it to all, or none")
    points = np.array([complex(*row.numbers[:2]) for row in rows])
    return CurveFile(points, np.radians(angles) if angles else None)
