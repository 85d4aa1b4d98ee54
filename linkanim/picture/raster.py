"""Polygons to pixels by exact area coverage, so that a slow edge glides instead of shivering.

Every edge is cut where it crosses pixel rows and columns; each piece adds to its pixel the signed
area to its right, and its height to everything further right in the row. Sorted and summed along
the rows these give the winding number averaged over each pixel, without sampling. Only pixels on
an outline are mixed; the spans between them are filled. All layers of a frame go through the
arithmetic together, which is what makes it fast enough in numpy.

Method: the cell accumulation of scan converters such as FreeType's "smooth" rasteriser.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from typing import NamedTuple

import numpy as np
import pygame
from numpy.typing import NDArray

Loop = NDArray[np.complex128]
Colour = tuple[int, int, int]
_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]

_NOTHING = 1 / 1024
_SOLID = 1 - _NOTHING
_LEAN = 1e-6
_ROW_BITS = 16
_COLUMN_BITS = 14


class Layer(NamedTuple):
    """Closed loops of pixel positions x + yi filled with one colour, over the layers before it.

    Loops that turn the same way join where they overlap; a loop that turns the other way cuts a hole.
    Pixel rows from `end` on are left as they are, as are columns from `right` on.
    """

    colour: Colour
    loops: Sequence[Loop]
    alpha: float = 1.0
    end: int = 1 << 15
    right: int = 1 << 15


class Stencil(NamedTuple):
    """A layer that is worked out once for surfaces of one size, and then only mixed in: what stands still."""

    colour: Colour
    place: _Ints
    weight: NDArray[np.float32]


class _Pieces(NamedTuple):
    """Pieces of edges, each within one pixel: its line and column, its height, the area right of it.

    A line is a row of one layer, in one number: the layer above `_ROW_BITS`, the row below.
    """

    line: _Ints
    column: _Ints
    height: _Floats
    area: _Floats


class _Runs(NamedTuple):
    """Runs of equally covered pixels in the order of their layers."""

    line: _Ints
    column: _Ints
    length: _Ints
    cover: _Floats

    def where(self, chosen: NDArray[np.bool_]) -> _Runs:
        return _Runs(*(part[chosen] for part in self))  # type: ignore[arg-type]


def paint(surface: pygame.Surface, layers: Sequence[Layer | Stencil]) -> None:
    """Fill the layers in their order on a 32-bit surface whose rows touch; loops may leave it.

    Where the surface has alpha, it is kept straight (not multiplied into the colours).
    """
    layers = [layer for layer in layers if isinstance(layer, Stencil) or layer.loops]
    if layers:
        shapes = [layer for layer in layers if isinstance(layer, Layer)]
        _mix(surface, layers, *_runs(shapes, surface.get_size()))


def stencil(layer: Layer, size: tuple[int, int]) -> Stencil:
    """Work out what a layer covers of surfaces of this size."""
    batches = [
        _span_pixels(runs, size[0], np.array([layer.alpha]))
        for runs in _runs([layer] if layer.loops else [], size)
    ]
    place, weight, _ = zip(*batches, strict=True)
    return Stencil(layer.colour, np.concatenate(place), np.concatenate(weight))


def paints(surface: pygame.Surface) -> bool:
    """Return whether `paint` can write to this surface."""
    return surface.get_bytesize() == 4 and surface.get_pitch() == 4 * surface.get_width()


def _runs(layers: Sequence[Layer], size: tuple[int, int]) -> tuple[_Runs, _Runs]:
    """Return the pixels on the layers' outlines and the spans between them."""
    none = np.zeros(0, np.int64)
    nothing = _Runs(none, none, none, np.zeros(0))
    if not layers:
        return nothing, nothing
    begin, end, number = _edges(layers)
    lowest = np.array([min(layer.end, size[1]) for layer in layers])[number]
    line, height, x0, x1 = _by_row(begin, end, number, lowest)
    rightmost = np.array([min(layer.right, size[0]) for layer in layers])
    if rightmost.min() < size[0]:
        x0, x1 = (np.minimum(x, rightmost[line >> _ROW_BITS]) for x in (x0, x1))
    pieces = _by_column(line, height, x0, x1, size[0])
    return _resolve(pieces, size[0]) if pieces.line.size else (nothing, nothing)


def _edges(layers: Sequence[Layer]) -> tuple[Loop, Loop, _Ints]:
    """Return where the edges begin and end, and the number of their layer."""
    begin = np.concatenate([loop for layer in layers for loop in layer.loops])
    counts = np.array([len(loop) for layer in layers for loop in layer.loops])
    last = np.cumsum(counts) - 1
    end = np.empty_like(begin)
    end[:-1] = begin[1:]
    end[last] = begin[last - counts + 1]
    layer_of_loop = np.repeat(np.arange(len(layers)), [len(layer.loops) for layer in layers])
    return begin, end, np.repeat(layer_of_loop, counts)


def _by_row(begin: Loop, end: Loop, number: _Ints, lowest: _Ints) -> tuple[_Ints, _Floats, _Floats, _Floats]:
    """Cut edges at pixel rows; return each piece's line, its signed height, and x at both ends."""
    x0, y0, y1 = begin.real.copy(), begin.imag.copy(), end.imag.copy()
    height = y1 - y0
    first = np.minimum(np.maximum(np.minimum(y0, y1), 0), lowest).astype(np.int64)
    last = np.ceil(np.minimum(np.maximum(np.maximum(y0, y1), 0), lowest)).astype(np.int64)
    edge, row = _expand(np.where(height != 0, last - first, 0), first)
    slope = (end.real - x0) / np.where(height != 0, height, 1)
    above = row.astype(np.float64)
    below = above + 1
    starts, ends = (np.minimum(np.maximum(y[edge], above), below) for y in (y0, y1))
    slopes, shift = slope[edge], (x0 - y0 * slope)[edge]
    return number[edge] << _ROW_BITS | row, ends - starts, shift + starts * slopes, shift + ends * slopes


def _by_column(line: _Ints, height: _Floats, x0: _Floats, x1: _Floats, width: int) -> _Pieces:
    """Cut what lies in one row at pixel columns; column `width` collects what lies further right."""
    left = np.minimum(np.maximum(np.minimum(x0, x1), 0), width)
    right = np.minimum(np.maximum(np.maximum(x0, x1), 0), width)
    # upright pieces lean by less than can be seen, so that all are cut in one way
    right = np.maximum(right, left + _LEAN)
    first = left.astype(np.int64)
    steep = height / (right - left)
    piece, column = _expand(np.ceil(right).astype(np.int64) - first, first)
    edge = column.astype(np.float64)
    beyond = edge + 1
    near, far = np.maximum(left[piece], edge), np.minimum(right[piece], beyond)
    part = (far - near) * steep[piece]
    near += far
    near *= 0.5
    return _Pieces(line[piece], column, part, part * (beyond - near))


def _expand(count: _Ints, first: _Ints) -> tuple[_Ints, _Ints]:
    """Return, for each of count[i] copies of i, i and first[i] + 0, 1, 2, ..."""
    which = np.repeat(np.arange(count.size), count)
    return which, np.arange(which.size) + np.repeat(first - np.cumsum(count) + count, count)


def _resolve(pieces: _Pieces, width: int) -> tuple[_Runs, _Runs]:
    """Sum the pieces along the lines; return the pixels on outlines and the spans between them."""
    place = pieces.line << _COLUMN_BITS | pieces.column
    # a merging sort, for the edges of an outline follow one another down or up the rows
    order = np.argsort(place, kind="stable")
    place = place[order]
    changes = np.empty(place.size, np.bool_)
    changes[0] = True
    np.not_equal(place[1:], place[:-1], out=changes[1:])
    first = np.flatnonzero(changes)
    place = place[first]
    cover = np.cumsum(np.add.reduceat(pieces.height[order], first))
    area = np.add.reduceat(pieces.area[order], first)
    area[1:] += cover[:-1]
    line, column = place >> _COLUMN_BITS, place & ((1 << _COLUMN_BITS) - 1)
    on_edge, inside = np.minimum(np.abs(area), 1), np.minimum(np.abs(cover), 1)
    edges = np.flatnonzero((column < width) & (on_edge > _NOTHING))
    # the cover to the right of a line's last piece is zero, so that no span leads to the next line
    spans = np.flatnonzero((place[1:] - place[:-1] > 1) & (inside[:-1] > _NOTHING))
    gap = place[spans + 1] - place[spans] - 1
    return (
        _Runs(line[edges], column[edges], np.ones_like(edges), on_edge[edges]),
        _Runs(line[spans], column[spans] + 1, gap, inside[spans]),
    )


class _Batch(NamedTuple):
    """Pixels' places in the surface and how much of each is mixed in, and where each layer's begin."""

    place: _Ints
    weight: NDArray[np.float32]
    bounds: list[int]


def _edge_pixels(runs: _Runs, width: int, alphas: _Floats) -> _Batch:
    """Return runs of one pixel each."""
    weight = runs.cover if (alphas >= 1).all() else runs.cover * alphas[runs.line >> _ROW_BITS]
    return _Batch(
        _place(runs, width), weight.astype(np.float32)[:, None], _bounds(runs, len(alphas)).tolist()
    )


def _span_pixels(runs: _Runs, width: int, alphas: _Floats) -> _Batch:
    """Return every pixel of longer runs."""
    ends = np.concatenate(([0], np.cumsum(runs.length)))
    place = np.arange(ends[-1]) + np.repeat(_place(runs, width) - ends[:-1], runs.length)
    weight = (runs.cover * alphas[runs.line >> _ROW_BITS]).astype(np.float32)
    return _Batch(place, np.repeat(weight, runs.length)[:, None], ends[_bounds(runs, len(alphas))].tolist())


def _place(runs: _Runs, width: int) -> _Ints:
    return (runs.line & ((1 << _ROW_BITS) - 1)) * width + runs.column


def _bounds(runs: _Runs, count: int) -> _Ints:
    """Return the number of the first run of each layer, and how many runs there are."""
    return np.searchsorted(runs.line, np.arange(count + 1) << _ROW_BITS)


def _mix(surface: pygame.Surface, layers: Sequence[Layer | Stencil], outline: _Runs, spans: _Runs) -> None:
    """Put the layers' colours on the surface, one layer after the other."""
    width = surface.get_width()
    alphas = np.array([layer.alpha for layer in layers if isinstance(layer, Layer)])
    solid = (spans.cover > _SOLID) & (alphas >= 1)[spans.line >> _ROW_BITS]
    full = _span_pixels(spans.where(solid), width, alphas)
    mixed = [_edge_pixels(outline, width, alphas)]
    if not solid.all():
        mixed.append(_span_pixels(spans.where(~solid), width, alphas))
    pixels = np.frombuffer(surface.get_buffer(), np.uint32)  # type: ignore[call-overload]
    inks = _inks(surface, layers)
    words = inks.astype(np.uint8).view(np.uint32)[:, 0]
    clear = bool(surface.get_flags() & pygame.SRCALPHA)
    number = count()
    for ink, word, layer in zip(inks, words, layers, strict=True):
        if isinstance(layer, Stencil):
            _blend(pixels, ink, layer.place, layer.weight, clear)
            continue
        n = next(number)
        pixels[full.place[full.bounds[n] : full.bounds[n + 1]]] = word
        for batch in mixed:
            part = slice(batch.bounds[n], batch.bounds[n + 1])
            if part.stop > part.start:
                _blend(pixels, ink, batch.place[part], batch.weight[part], clear)


def _inks(surface: pygame.Surface, layers: Sequence[Layer | Stencil]) -> NDArray[np.float32]:
    """Return the layers' colours as the surface keeps them, four bytes each, opaque."""
    inks = np.full((len(layers), 4), 255, np.float32)
    inks[:, [shift // 8 for shift in surface.get_shifts()[:3]]] = [layer.colour for layer in layers]
    return inks


def _blend(
    pixels: NDArray[np.uint32],
    ink: NDArray[np.float32],
    place: _Ints,
    weight: NDArray[np.float32],
    clear: bool,
) -> None:
    """Mix ink into pixels by its coverage; `clear` where the surface itself lets light through."""
    below = pixels[place].view(np.uint8).reshape(-1, 4).astype(np.float32)
    if clear:
        under = below[:, 3:] / np.float32(255)
        whole = weight + under * (1 - weight)
        below += (ink - below) * (weight / whole)
        below[:, 3:] = 255 * whole
    else:
        below += (ink - below) * weight
    below += 0.5
    pixels[place] = below.astype(np.uint8).view(np.uint32)[:, 0]
