"""A curve's file: columns of numbers, or an SVG's first path."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from linkanim.bounds import MOST_ROWS_READ
from linkanim.errors import BadInput
from linkanim.intake import Intake, control_in, named
from linkanim.synthesis.kinds import Complex, Real
from linkanim.synthesis.svg_path import first_path
from linkanim.units import shown

_CURVE_FILE = Intake("a curve: two columns of numbers, or an SVG", most_bytes=5_000_000, most_values=10**7)
_BETWEEN = re.compile(r"[,;\s]+")


class CurveFile(NamedTuple):
    """Points as x + yi, and what the third column says of each: the crank's angle in radians, or nothing."""

    points: Complex
    angles: Real | None


def read_curve(path: Path) -> CurveFile:
    """Return the curve in a file, by its ending an SVG or else a table.

    A table has two columns, x and y, or three, the last an angle in degrees; commas, semicolons, blanks or
    tabs between; a first line of titles, empty lines and what follows # are passed over. An SVG's y axis is
    turned up. BadInput, naming file and line, where it cannot be read.
    """
    where = named(path)
    text = _CURVE_FILE.read(path, where)
    if path.suffix.lower() == ".svg":
        return CurveFile(np.conj(first_path(text, where)), None)
    rows = _rows(text, where)
    points = np.array([complex(x, y) for x, y, *_ in rows])
    angles = [row[2] for row in rows if len(row) > 2]
    if angles and len(angles) < len(rows):
        raise BadInput(f"{where}: {len(angles)} of {len(rows)} rows have an angle; give it to all, or none")
    return CurveFile(points, np.radians(angles) if angles else None)


def _rows(text: str, where: str) -> list[list[float]]:
    """Return the numbers of each line, two or three."""
    lines = [(n, line.partition("#")[0].strip()) for n, line in enumerate(text.splitlines(), start=1)]
    full = [(n, line) for n, line in lines if line]
    rows = [(n, line, _numbers(line)) for n, line in full]
    if rows and rows[0][2] is None and len(rows) > 1:
        rows = rows[1:]
    if len(rows) > MOST_ROWS_READ:
        raise BadInput(f"{where}: has {len(rows):,} points; {MOST_ROWS_READ:,} are the most that are read")
    for number, line, found in rows:
        if found is None:
            what = "is no plain text" if control_in(line) else f"has not two or three numbers: {shown(line)}"
            raise BadInput(f"{where}: line {number} {what}")
        if not all(map(math.isfinite, found)):
            raise BadInput(f"{where}: line {number} is not finite: {shown(line)}")
    if not rows:
        raise BadInput(f"{where}: has no points; give two columns, x and y")
    return [found for _, _, found in rows if found is not None]


def _numbers(line: str) -> list[float] | None:
    """Return a line's two or three numbers; None where it has not that."""
    cells = [cell for cell in _BETWEEN.split(line) if cell]
    try:
        return [float(cell) for cell in cells] if len(cells) in (2, 3) else None
    except ValueError:
        return None
