"""Read a curve's file: columns of numbers, or an SVG's first path.

Its parts, in reading order:

- An SVG's first path as points: lines, cubic and quadratic curves, and arcs (SVG 1.1, 8.3 and F.6).
- A curve's file: columns of numbers, or an SVG's first path.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from linkanim.errors import BadInput
from linkanim.intake import Intake, named, read_numbers
from linkanim.synthesis.linkages import Complex, Real
from linkanim.units import shown

# An SVG's first path as points: lines, cubic and quadratic curves, and arcs (SVG 1.1, 8.3 and F.6).
#
# The `transform` of the path and of the groups about it is applied (7.6); a viewBox is not, as its unit says
# nothing about lengths.

_STEPS = 24
"""The number of points along each curved piece."""
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_TOKEN = re.compile(rf"(?P<letter>[MmZzLlHhVvCcSsQqTtAa])|(?P<number>{_NUMBER.pattern})|[\s,]+")
_FLAG = re.compile(r"[\s,]*(?P<number>[01])(?P<letter>)")
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_MOST_PIECES = 5_000
_LARGEST = 1e100
"""The largest number that is read: beyond it a curve's size would overflow."""
_FLAT, _STRAIGHT = 1e-12, 1e12
"""An arc is a line if one radius is less than this share of the other, or exceeds so many half chords."""
_NOT_DRAWN = frozenset({"defs", "clipPath", "mask", "marker", "pattern", "symbol"})
_TRANSFORM = re.compile(r"[\s,]*(matrix|translate|scale|rotate|skewX|skewY)\s*\(([-+\deE.,\s]*)\)")
_ARGUMENTS = {
    "matrix": (6,), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3), "skewX": (1,), "skewY": (1,),
}  # fmt: skip
"""The numbers of arguments that each transformation takes."""


class _Affine(NamedTuple):
    """An affine map, by the images of the axes' unit vectors and of the origin."""

    x: complex = 1.0 + 0.0j
    y: complex = 1.0j
    origin: complex = 0.0j

    def after(self, inner: _Affine) -> _Affine:
        """Return the map that applies `inner` first, then this one."""
        x, y, origin = (self.x * image.real + self.y * image.imag for image in inner)
        return _Affine(x, y, origin + self.origin)


class _Pen(NamedTuple):
    """Where the path is, and the last control points of a cubic and of a quadratic curve."""

    at: complex
    start: complex
    cubic: complex
    quadratic: complex


def first_path(text: str, where: str) -> Complex:
    """Return points along the first stroke of the first path in an SVG that draws anything.

    BadInput where the text is no SVG, has no path, or the path cannot be read.
    """
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        text = re.sub(r"<!DOCTYPE[^>\[]*>", "", text)
        if "<!ENTITY" in text or "<!DOCTYPE" in text:
            raise BadInput(f"{where}: declares entities, which are not read; save it as plain SVG")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise BadInput(f"{where}: is not SVG: {error}") from None
    for element, place in _drawn_elements(root, where):
        drawn = element.get("d", "").strip()
        if _name(element) == "path" and drawn:
            with np.errstate(all="ignore"):  # an overflow is refused later, as a point
                points = _points(drawn, where)
                return place.x * points.real + place.y * points.imag + place.origin
    raise BadInput(f"{where}: has no path; convert its shapes to paths first")


def _drawn_elements(root: ElementTree.Element, where: str) -> Iterator[tuple[ElementTree.Element, _Affine]]:
    """Yield an element and all drawn elements in it, in their order, each with its map to the plane."""
    waiting = [(root, _Affine())]
    while waiting:
        element, place = waiting.pop()
        for matrix in _matrices(element.get("transform", ""), where):
            place = place.after(matrix)
        yield element, place
        waiting += [(child, place) for child in reversed(element) if _name(child) not in _NOT_DRAWN]


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _matrices(text: str, where: str) -> Iterator[_Affine]:
    """Yield the transformations of an attribute, the outermost first."""
    place = 0
    while place < len(text.rstrip()):
        match = _TRANSFORM.match(text, place)
        numbers = [_number(one[0], "transform", where) for one in _NUMBER.finditer(match[2])] if match else []
        if match is None or len(numbers) not in _ARGUMENTS[match[1]]:
            raise BadInput(f"{where}: the transform cannot be read at {text[place : place + 20].strip()!r}")
        place = match.end()
        yield _matrix(match[1], numbers)


def _matrix(kind: str, numbers: list[float]) -> _Affine:
    """Return one transformation by its name and numbers."""
    first, second, *others = (*numbers, 0.0, 0.0)
    if kind == "matrix":
        a, b, c, d, e, f = numbers
        return _Affine(complex(a, b), complex(c, d), complex(e, f))
    if kind == "translate":
        return _Affine(origin=complex(first, second))
    if kind == "scale":
        return _Affine(complex(first), 1j * (second if len(numbers) > 1 else first))
    if kind == "rotate":
        turn, about = cmath.rect(1.0, math.radians(first)), complex(second, others[0])
        return _Affine(turn, 1j * turn, about - turn * about)
    lean = math.tan(math.radians(first))
    return _Affine(y=complex(lean, 1.0)) if kind == "skewX" else _Affine(complex(1.0, lean))


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
    distinct = [point for n, point in enumerate(points) if n == 0 or point != points[n - 1]]
    return np.array(distinct, dtype=np.complex128)


def _pieces(drawn: str, where: str) -> Iterator[tuple[str, list[float]]]:
    """Yield each command's letter and numbers, a repeated command as several; after an M they are L."""
    letter, values, end = "", list[float](), 0
    while end < len(drawn):
        match = (_FLAG if letter in ("A", "a") and len(values) in (3, 4) else _TOKEN).match(drawn, end)
        if match is None:
            raise BadInput(f"{where}: the path cannot be read at {drawn[end : end + 12]!r}")
        end = match.end()
        if match["letter"]:
            if values:
                raise BadInput(f"{where}: the path's {letter} has too few numbers")
            letter = match["letter"]
            if letter in "Zz":
                yield letter, []
        elif match["number"]:
            values.append(_number(match["number"], "path", where))
            if not letter or letter in "Zz":
                raise BadInput(f"{where}: the path has the number {values[-1]:g} where none can be")
            if len(values) == _TAKES[letter.upper()]:
                yield letter, values
                values, letter = [], {"M": "L", "m": "l"}.get(letter, letter)
    if values:
        raise BadInput(f"{where}: the path's {letter} has too few numbers")


def _number(text: str, what: str, where: str) -> float:
    if abs(number := float(text)) > _LARGEST:
        raise BadInput(
            f"{where}: the {what} has a number beyond {_LARGEST:g}: {shown(text)}; draw it smaller"
        )
    return number


def _drawn(pen: _Pen, letter: str, values: list[float]) -> tuple[_Pen, list[complex]]:
    """Return where the pen is after a piece, and the points along the piece."""
    own, origin = letter.upper(), pen.at if letter.islower() else 0j
    if own in "HV":
        own_at = pen.at - origin
        straight = complex(values[0], own_at.imag) if own == "H" else complex(own_at.real, values[0])
        straight += origin
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
    """Return a piece's control points and end; a smooth piece's first one mirrors the last piece's."""
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
    """Return points along an elliptic arc between two ends; radii that are too short are enlarged."""
    rx, ry, tilt, large, sweep = abs(values[0]), abs(values[1]), math.radians(values[2]), values[3], values[4]
    size, turn = max(rx, ry), cmath.exp(1j * tilt)
    if min(rx, ry) <= _FLAT * size:
        return [end]
    rx, ry = rx / size, ry / size

    def unit(point: complex) -> complex:
        """Return a point in coordinates in which the ellipse is a circle of radius `size`."""
        own = point / turn
        return complex(own.real / rx, own.imag / ry)

    first, last = unit(start), unit(end)
    half = (last - first) / 2
    reach = size / abs(half) if half else math.inf
    if not reach < _STRAIGHT:
        return [end]
    height = math.sqrt(max(0.0, reach * reach - 1.0))
    centre = first + half + half * 1j * height * (-1.0 if large == sweep else 1.0)
    radius = abs(first - centre)
    begin, angle = cmath.phase(first - centre), cmath.phase((last - centre) / (first - centre))
    if sweep and angle < 0:
        angle += 2 * math.pi
    elif not sweep and angle > 0:
        angle -= 2 * math.pi
    places = (centre + cmath.rect(radius, begin + angle * k / _STEPS) for k in range(1, _STEPS))
    return [*(complex(place.real * rx, place.imag * ry) * turn for place in places), end]


# A curve's file: columns of numbers, or an SVG's first path.

_CURVE_FILE = Intake("a curve: two columns of numbers, or an SVG", most_bytes=5_000_000, most_values=10**7)
_MOST_COLUMNS = 3


class CurveFile(NamedTuple):
    """Points as x + yi, and the third column, if any: the crank's angle (rad) at each point."""

    points: Complex
    angles: Real | None


def read_curve(path: Path) -> CurveFile:
    """Return the curve in a file: an SVG if its name ends so, else a table.

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
    angles = [numbers[2] for _, numbers in rows if len(numbers) > 2]
    if angles and len(angles) < len(rows):
        raise BadInput(f"{where}: {len(angles)} of {len(rows)} rows have an angle; give it to all, or none")
    points = np.array([complex(*numbers[:2]) for _, numbers in rows])
    return CurveFile(points, np.radians(angles) if angles else None)
