"""Outlines to pixels by exact area coverage, so that a slow edge glides instead of shivering.

Every edge is cut where it crosses pixel rows and columns; each piece adds to its pixel the signed
area to its right, and its height to everything further right in the row. Sorted and summed along
the rows these give the winding number averaged over each pixel, without sampling. Corners lie on a
grid of 1/1024 of a pixel, so that the sums are whole numbers: the same on every machine, in any order.

Method: the cell accumulation of scan converters such as FreeType's "smooth" rasteriser.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Loop = NDArray[np.complex128]
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
"""Enough for whole numbers up to the grid's width, and for rounding to a step of it."""
Ints = NDArray[np.int64]
Counts = NDArray[np.int32]

_BITS = 10
_STEPS = 1 << _BITS
"""Steps of the grid to a pixel."""
WHOLE_BITS = 2 * _BITS + 1
"""A pixel that is covered whole counts 2 to the power of it."""
_FAR = float(1 << 31)
"""Corners further off, in steps, are drawn there."""
_COLUMN_BITS = 15
_COLUMNS = (1 << _COLUMN_BITS) - 1
_WHOLE = 1 << WHOLE_BITS
_NOTHING = _WHOLE >> 9
"""Less does not show."""


class Edges(NamedTuple):
    """Edges from x + yi to x + yi in steps of the grid, each with the number of its layer."""

    begin: Loop
    end: Loop
    layer: Ints


class Room(NamedTuple):
    """Where on a surface each layer may lie: its first row, how many rows, and the column it ends before.

    A line is a row of one layer; the lines of all layers are counted through. `first` has each layer's
    first line and how many lines there are, `starts` where each line begins among the surface's pixels.
    """

    top: Ints
    high: Ints
    end: Ints
    first: Ints
    starts: Ints


def room(top: Ints, high: Ints, end: Ints, width: int) -> Room:
    """Return where layers may lie on a surface so many pixels wide."""
    first = np.concatenate(([0], np.cumsum(high)))
    rows = np.arange(first[-1]) + np.repeat(top - first[:-1], high)
    return Room(top, high, end, first, rows * width)


class Runs(NamedTuple):
    """Runs of equally covered pixels, in the order of their lines."""

    line: Ints
    column: Ints
    cover: Counts
    length: Ints


class _Rows(NamedTuple):
    """Pieces of edges, each within one line: its height, and from where to where it leads, in steps."""

    line: Ints
    height: Floats
    left: Singles
    right: Singles


class _Pieces(NamedTuple):
    """Pieces of edges, each within one pixel: its height, and twice the area right of it."""

    line: Ints
    column: Ints
    height: Counts
    area: Counts


def on_grid(points: Loop) -> Loop:
    """Return points in steps of the grid; what is not a number lies far outside."""
    steps = np.rint(points.view(np.float64) * _STEPS)
    near: Loop = np.fmin(np.fmax(steps, -_FAR), _FAR).view(np.complex128)
    return near


def pixel_of(steps: Floats) -> Ints:
    """Return the pixel rows or columns that places on the grid lie in."""
    return steps.astype(np.int64) >> _BITS


def covered(edges: Edges, within: Room) -> tuple[Runs, Runs]:
    """Return the pixels on the layers' outlines, each as a run, and the spans between them."""
    return _resolved(_by_column(_by_row(edges, within)), within)


def _by_row(edges: Edges, within: Room) -> _Rows:
    """Cut edges at pixel rows."""
    x0, y0, y1 = edges.begin.real.copy(), edges.begin.imag.copy(), edges.end.imag.copy()
    height = y1 - y0
    first = np.maximum(pixel_of(np.minimum(y0, y1)), within.top[edges.layer])
    last = np.minimum(-pixel_of(-np.maximum(y0, y1)), (within.top + within.high)[edges.layer])
    edge, row = _expanded(np.where(height != 0, np.maximum(last - first, 0), 0), first)
    slope = (edges.end.real - x0) / np.where(height != 0, height, 1)
    above = (row << _BITS).astype(np.float64)
    from_x, from_y, slopes = x0.take(edge), y0.take(edge), slope.take(edge)
    starts, ends = (np.minimum(np.maximum(y, above), above + _STEPS) for y in (from_y, y1.take(edge)))
    right = _ends(within, edges.layer, edge)
    one, other = (
        np.minimum(np.maximum(np.rint(from_x + (y - from_y) * slopes), 0), right).astype(np.float32)
        for y in (starts, ends)
    )
    line = (within.first[:-1] - within.top)[edges.layer].take(edge) + row
    return _Rows(line, ends - starts, np.minimum(one, other), np.maximum(one, other))


def _ends(within: Room, layer: Ints, edge: Ints) -> Floats | float:
    """Return how far right pieces of edges reach, in steps."""
    if within.end.min() == within.end.max():
        return float(within.end[0] << _BITS)
    return (within.end << _BITS).astype(np.float64)[layer].take(edge)


def _by_column(rows: _Rows) -> _Pieces:
    """Cut what lies in one row at pixel columns; the layer's end collects what lies further right."""
    # upright pieces lean by a step, so that all are cut in one way
    right = np.maximum(rows.right, rows.left + 1)
    steep = (rows.height / (right - rows.left)).astype(np.float32)
    first = rows.left.astype(np.int32) >> _BITS
    last = -(-right.astype(np.int32) >> _BITS)
    piece, column = _expanded((last - first).astype(np.int64), first.astype(np.int64))
    edge = (column << _BITS).astype(np.float32)
    left, beyond = rows.left.take(piece), edge + _STEPS
    near, far = np.maximum(left, edge), np.minimum(right.take(piece), beyond)
    slopes = steep.take(piece)
    part = np.rint((far - left) * slopes) - np.rint((near - left) * slopes)
    area = part * ((beyond - near) + (beyond - far))
    return _Pieces(rows.line.take(piece), column, part.astype(np.int32), area.astype(np.int32))


def _expanded(count: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Return, for each of count[i] copies of i, i and first[i] + 0, 1, 2, ..."""
    which = np.repeat(np.arange(count.size), count)
    return which, np.arange(which.size) + (first - np.cumsum(count) + count).take(which)


def _resolved(pieces: _Pieces, within: Room) -> tuple[Runs, Runs]:
    """Sum the pieces along the lines; return the pixels on outlines and the spans between them."""
    order = _sorted(pieces, int(within.first[-1]))
    place = (pieces.line << _COLUMN_BITS | pieces.column).take(order)
    if not place.size:
        nothing = Runs(place, place, place.astype(np.int32), place)
        return nothing, nothing
    ends = np.concatenate((np.flatnonzero(place[1:] != place[:-1]), [place.size - 1]))
    place = place.take(ends)
    height, area = (
        np.cumsum(part.take(order), dtype=np.int32).take(ends) for part in (pieces.height, pieces.area)
    )
    area[1:] -= area[:-1].copy()
    area[1:] += height[:-1] << (_BITS + 1)
    return _outline(place, area, within), _spans(place, height)


def _sorted(pieces: _Pieces, lines: int) -> Ints:
    """Return the order of pieces by line and column; short numbers are sorted by their digits, fast."""
    line = pieces.line.astype(np.min_scalar_type(lines))
    return np.lexsort((pieces.column.astype(np.uint16), line))


def _outline(place: Ints, area: Counts, within: Room) -> Runs:
    cover = np.minimum(np.abs(area), _WHOLE)
    line, column = place >> _COLUMN_BITS, place & _COLUMNS
    counts = np.diff(np.searchsorted(line, within.first))
    seen = np.flatnonzero((column < np.repeat(within.end, counts)) & (cover > _NOTHING))
    return Runs(line.take(seen), column.take(seen), cover.take(seen), np.ones_like(seen))


def _spans(place: Ints, height: Counts) -> Runs:
    # the height to the right of a line's last piece is zero, so that no span leads to the next line
    cover = np.minimum(np.abs(height), _STEPS) << _BITS + 1
    seen = np.flatnonzero((place[1:] - place[:-1] > 1) & (cover[:-1] > _NOTHING))
    begin = place.take(seen)
    length = place.take(seen + 1) - begin - 1
    return Runs(begin >> _COLUMN_BITS, (begin & _COLUMNS) + 1, cover.take(seen), length)
