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
_ROW_BITS = 16


class Layer(NamedTuple):
    """Closed loops of pixel positions x + yi filled with one colour, over the layers before it.

    Loops that turn the same way join where they overlap; a loop that turns the other way cuts a hole.
    Pixel rows from `end` on are left as they are.
    """

    colour: Colour
    loops: Sequence[Loop]
    alpha: float = 1.0
    end: int = 1 << 15


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


def paint(surface: pygame.Surface, layers: Sequence[Layer]) -> None:
    """Fill the layers in their order on a 32-bit surface whose rows touch; loops may leave it.

    Where the surface has alpha, it is kept straight (not multiplied into the colours).
    """
    layers = [layer for layer in layers if layer.loops]
    if not layers:
        return
    width, height = surface.get_size()
    begin, end, number = _edges(layers)
    lowest = np.array([min(layer.end, height) for layer in layers])[number]
    pieces = _by_column(*_by_row(begin, end, number, lowest), width)
    if pieces.line.size:
        _mix(surface, layers, *_resolve(pieces, width))


def paints(surface: pygame.Surface) -> bool:
    """Return whether `paint` can write to this surface."""
    return surface.get_bytesize() == 4 and surface.get_pitch() == 4 * surface.get_width()


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
    falls = end.imag > begin.imag
    top, bottom = np.where(falls, begin, end), np.where(falls, end, begin)
    first = np.floor(np.clip(top.imag, 0, lowest)).astype(np.int64)
    last = np.ceil(np.clip(bottom.imag, 0, lowest)).astype(np.int64)
    height = bottom.imag - top.imag
    edge, row = _expand(np.where(height > 0, np.maximum(last - first, 0), 0), first)
    slope = (bottom.real - top.real) / np.where(height > 0, height, 1)
    above = np.maximum(top.imag[edge], row)
    below = np.minimum(bottom.imag[edge], row + 1)
    slopes, shift = slope[edge], (top.real - top.imag * slope)[edge]
    signed = (below - above) * np.where(falls, 1.0, -1.0)[edge]
    return number[edge] << _ROW_BITS | row, signed, shift + above * slopes, shift + below * slopes


def _by_column(line: _Ints, height: _Floats, x0: _Floats, x1: _Floats, width: int) -> _Pieces:
    """Cut what lies in one row at pixel columns; column `width` collects what lies further right."""
    left = np.clip(np.minimum(x0, x1), 0, width)
    right = np.clip(np.maximum(x0, x1), 0, width)
    first = np.floor(left).astype(np.int64)
    reach = right - left
    steep = height / np.where(reach > 0, reach, 1)
    piece, column = _expand(np.maximum(np.ceil(right).astype(np.int64) - first, 1), first)
    near = np.maximum(left[piece], column)
    far = np.minimum(right[piece], column + 1)
    part = np.where((reach > 0)[piece], (far - near) * steep[piece], height[piece])
    return _Pieces(line[piece], column, part, part * (1 + column - 0.5 * (near + far)))


def _expand(count: _Ints, first: _Ints) -> tuple[_Ints, _Ints]:
    """Return, for each of count[i] copies of i, i and first[i] + 0, 1, 2, ..."""
    which = np.repeat(np.arange(count.size), count)
    return which, np.arange(which.size) + np.repeat(first - np.cumsum(count) + count, count)


def _resolve(pieces: _Pieces, width: int) -> tuple[_Runs, _Runs]:
    """Sum the pieces along the lines; return the pixels on outlines and the spans between them."""
    order = _sorted(pieces.line, pieces.column)
    line, column = pieces.line[order], pieces.column[order]
    first = np.flatnonzero((np.diff(line, prepend=-1) != 0) | (np.diff(column, prepend=-1) != 0))
    line, column = line[first], column[first]
    cover = np.cumsum(np.add.reduceat(pieces.height[order], first))
    area = np.add.reduceat(pieces.area[order], first)
    area[1:] += cover[:-1]
    on_edge, inside = np.minimum(np.abs(area), 1), np.minimum(np.abs(cover), 1)
    gap = np.where(np.diff(line, append=-1) == 0, np.diff(column, append=0) - 1, 0)
    edges = _Runs(line, column, np.ones_like(line), on_edge)
    spans = _Runs(line, column + 1, gap, inside)
    return edges.where((column < width) & (on_edge > _NOTHING)), spans.where((gap > 0) & (inside > _NOTHING))


def _sorted(line: _Ints, column: _Ints) -> _Ints:
    """Return the order by line, then column; numpy sorts 16 bits at a time by counting, not comparing."""
    order = np.argsort(column.astype(np.uint16), kind="stable")
    for digit in range(0, int(line.max()).bit_length(), 16):
        digits = (line >> digit).astype(np.uint16)
        order = order[np.argsort(digits[order], kind="stable")]
    return order


class _Batch(NamedTuple):
    """Pixels' places in the surface and their coverage, and where each layer's begin."""

    place: _Ints
    cover: NDArray[np.float32]
    bounds: list[int]


def _batch(runs: _Runs, width: int, count: int) -> _Batch:
    """Return every pixel of the runs."""
    row = runs.line & ((1 << _ROW_BITS) - 1)
    run, place = _expand(runs.length, row * width + runs.column)
    ends = np.concatenate(([0], np.cumsum(runs.length)))
    starts = np.searchsorted(runs.line, np.arange(count + 1) << _ROW_BITS)
    return _Batch(place, runs.cover.astype(np.float32)[run], ends[starts].tolist())


def _mix(surface: pygame.Surface, layers: Sequence[Layer], outline: _Runs, spans: _Runs) -> None:
    """Put the layers' colours on the surface, one layer after the other."""
    width, count = surface.get_width(), len(layers)
    solid = spans.cover > _SOLID
    full = _batch(spans.where(solid), width, count)
    mixed = [_batch(outline, width, count)]
    if not solid.all():
        mixed.append(_batch(spans.where(~solid), width, count))
    pixels = np.frombuffer(surface.get_buffer(), np.uint32)  # type: ignore[call-overload]
    inks = _inks(surface, layers)
    words = inks.astype(np.uint8).view(np.uint32)[:, 0]
    clear = bool(surface.get_flags() & pygame.SRCALPHA)
    for n, layer in enumerate(layers):
        if layer.alpha >= 1:
            pixels[full.place[full.bounds[n] : full.bounds[n + 1]]] = words[n]
        for batch in mixed if layer.alpha >= 1 else (full, *mixed):
            part = slice(batch.bounds[n], batch.bounds[n + 1])
            if part.stop > part.start:
                cover = batch.cover[part] if layer.alpha >= 1 else batch.cover[part] * layer.alpha
                _blend(pixels, inks[n], batch.place[part], cover[:, None], clear)


def _inks(surface: pygame.Surface, layers: Sequence[Layer]) -> NDArray[np.float32]:
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
