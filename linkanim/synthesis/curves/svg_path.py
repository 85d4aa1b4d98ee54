"""An SVG's first path as points: lines, cubic and quadratic curves, and arcs (SVG 1.1, 8.3 and F.6).

Transformations are not followed: the points are those of the path itself.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from linkanim.errors import BadInput
from linkanim.synthesis.kinds import Complex

_STEPS = 24
"""Points along each curved piece."""
_TOKEN = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])|([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|[\s,]+|(.)")
_FLAG = re.compile(r"[\s,]*([01])")
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_MOST_PIECES = 5_000


class _Pen(NamedTuple):
    """Where the path is, and the last control points of a cubic and of a quadratic curve."""

    at: complex
    start: complex
    cubic: complex
    quadratic: complex


def first_path(text: str, where: str) -> Complex:
    """Return points along the first path of an SVG that draws anything; only its first stroke.

    BadInput where it is no SVG, has no path, or the path cannot be read.
    """
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        text = re.sub(r"<!DOCTYPE[^>\[]*>", "", text)
        if "<!ENTITY" in text or "<!DOCTYPE" in text:
            raise BadInput(f"{where}: declares entities, which are not read; save it as plain SVG")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise BadInput(f"{where}: is not SVG: {error}") from None
    for element in root.iter():
        drawn = element.get("d", "").strip()
        if str(element.tag).rpartition("}")[2] == "path" and drawn:
            return _points(drawn, where)
    raise BadInput(f"{where}: has no path; convert its shapes to paths first")


def _points(drawn: str, where: str) -> Complex:
    """Return the points of a path's first stroke."""
    points: list[complex] = []
    pen = _Pen(0j, 0j, 0j, 0j)
    for number, (letter, values) in enumerate(_pieces(drawn, where)):
        if (number == 0) != (letter in "Mm"):
            if number == 0:
                raise BadInput(f"{where}: the path does not begin with a move (M)")
            break
        if number > _MOST_PIECES:
            raise BadInput(f"{where}: the path has more than {_MOST_PIECES:,} pieces; simplify it")
        if letter in "Zz":
            points.append(pen.start)
            break
        pen, along = _drawn(pen, letter, values)
        points += along
    kept = [point for n, point in enumerate(points) if n == 0 or point != points[n - 1]]
    return np.array(kept, dtype=np.complex128)


def _pieces(drawn: str, where: str) -> Iterator[tuple[str, list[float]]]:
    """Yield each command's letter with its numbers, repeated ones each on its own; M is followed by L."""
    letter, values, place = "", list[float](), 0
    while place < len(drawn):
        arc_flag = letter in "Aa" and letter and len(values) in (3, 4)
        found = (_FLAG if arc_flag else _TOKEN).match(drawn, place)
        if found is None or (not arc_flag and found[3]):
            raise BadInput(f"{where}: the path cannot be read at {drawn[place : place + 12]!r}")
        place = found.end()
        if not arc_flag and found[1]:
            if values:
                raise BadInput(f"{where}: the path's {letter} has too few numbers")
            letter = found[1]
            if letter in "Zz":
                yield letter, []
            continue
        number = found[1] if arc_flag else found[2]
        if number is None:
            continue
        values.append(float(number))
        if not letter or letter in "Zz" or not math.isfinite(values[-1]):
            raise BadInput(f"{where}: the path has the number {number} where none can be")
        if len(values) == _TAKES[letter.upper()]:
            yield letter, values
            values, letter = [], {"M": "L", "m": "l"}.get(letter, letter)
    if values:
        raise BadInput(f"{where}: the path's {letter} has too few numbers")


def _drawn(pen: _Pen, letter: str, values: list[float]) -> tuple[_Pen, list[complex]]:
    """Return where the pen is after a piece, and the points along that."""
    own, origin = letter.upper(), pen.at if letter.islower() else 0j
    if own in "HV":
        straight = complex(values[0], pen.at.imag) if own == "H" else complex(pen.at.real, values[0])
        if letter.islower():
            straight = pen.at + (values[0] if own == "H" else 1j * values[0])
        return _Pen(straight, pen.start, straight, straight), [straight]
    if own == "A":
        end = complex(values[5], values[6]) + origin
        return _Pen(end, pen.start, end, end), _arc(pen.at, values, end)
    ends = [complex(x, y) + origin for x, y in zip(values[::2], values[1::2], strict=True)]
    end = ends[-1]
    if own == "M":
        return _Pen(end, end, end, end), [end]
    controls = _controls(pen, own, ends)
    along = _bezier([pen.at, *controls]) if len(controls) > 1 else [end]
    cubic = controls[-2] if own in "CS" else end
    return _Pen(end, pen.start, cubic, controls[0] if own in "QT" else end), along


def _controls(pen: _Pen, own: str, ends: list[complex]) -> list[complex]:
    """Return a piece's control points and its end; smooth ones begin with the last one's mirror image."""
    if own == "S":
        return [2 * pen.at - pen.cubic, *ends]
    return [2 * pen.at - pen.quadratic, *ends] if own == "T" else ends


def _bezier(controls: list[complex]) -> list[complex]:
    """Return points along a Bézier curve (de Casteljau), its end the last."""
    share = np.arange(1, _STEPS + 1) / _STEPS
    rows = [np.full(_STEPS, control) for control in controls]
    while len(rows) > 1:
        rows = [a + share * (b - a) for a, b in pairwise(rows)]
    return [complex(point) for point in rows[0]]


def _arc(start: complex, values: list[float], end: complex) -> list[complex]:
    """Return points along an elliptic arc by its ends, its radii raised where they are too short."""
    rx, ry, tilt, large, sweep = abs(values[0]), abs(values[1]), math.radians(values[2]), values[3], values[4]
    if rx == 0 or ry == 0 or start == end:
        return [end]
    turn = cmath.exp(1j * tilt)

    def unit(point: complex) -> complex:
        """Return a point in coordinates in which the ellipse is a circle of radius 1."""
        own = point / turn
        return complex(own.real / rx, own.imag / ry)

    first, last = unit(start), unit(end)
    half = (last - first) / 2
    height = math.sqrt(max(0.0, 1.0 / abs(half) ** 2 - 1.0))
    centre = first + half + half * 1j * height * (-1.0 if large == sweep else 1.0)
    radius = abs(first - centre)
    begin, angle = cmath.phase(first - centre), cmath.phase((last - centre) / (first - centre))
    if sweep and angle < 0:
        angle += 2 * math.pi
    elif not sweep and angle > 0:
        angle -= 2 * math.pi
    places = (centre + cmath.rect(radius, begin + angle * k / _STEPS) for k in range(1, _STEPS))
    return [*(_back(place, rx, ry, turn) for place in places), end]


def _back(point: complex, rx: float, ry: float, turn: complex) -> complex:
    return complex(point.real * rx, point.imag * ry) * turn
