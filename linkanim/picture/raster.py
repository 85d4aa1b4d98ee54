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


class Layer(NamedTuple):
    """Closed loops of pixel positions x + yi filled with one colour, over the layers before it.

    Loops that turn the same way join where they overlap; a loop that turns the other way cuts a hole.
    """

    colour: Colour
    loops: Sequence[Loop]
    alpha: float = 1.0


class _Pieces(NamedTuple):
    """Pieces of edges, each within one pixel: its key, its height, and the area right of it."""

    key: _Ints
    cover: _Floats
    area: _Floats


class _Coverage(NamedTuple):
    """Runs of equally covered pixels in the order of their layers."""

    key: _Ints
    length: _Ints
    cover: _Floats


def paint(surface: pygame.Surface, layers: Sequence[Layer]) -> None:
    """Fill the layers in their order on a 32-bit surface whose rows touch; loops may leave it.

    Where the surface has alpha, it is kept straight (not multiplied into the colours).
    """
    layers = [layer for layer in layers if layer.loops]
    if not layers:
        return
    size = surface.get_size()
    pieces = _by_column(*_by_row(*_edges(layers), size), size)
    outline, spans = _resolve(pieces, size)
    _mix(surface, layers, outline, spans)


def paints(surface: pygame.Surface) -> bool:
    """Return whether `paint` can write to this surface."""
    return surface.get_bytesize() == 4 and surface.get_pitch() == 4 * surface.get_width()


def _edges(layers: Sequence[Layer]) -> tuple[Loop, Loop, _Ints]:
    """Return where the edges begin and end, and the number of their layer."""
    loops = [loop for layer in layers for loop in layer.loops]
    begin = np.concatenate(loops)
    end = np.concatenate([part for loop in loops for part in (loop[1:], loop[:1])])
    number = np.repeat(
        np.arange(len(layers)), [sum(len(loop) for loop in layer.loops) for layer in layers]
    )
    return begin, end, number


def _by_row(
    begin: Loop, end: Loop, number: _Ints, size: tuple[int, int]
) -> tuple[_Ints, _Floats, _Floats, _Floats]:
    """Cut edges at pixel rows; return (layer, row) as one number, signed height, and both ends' x."""
    falls = end.imag > begin.imag
    top, bottom = np.where(falls, begin, end), np.where(falls, end, begin)
    first = np.floor(np.clip(top.imag, 0, size[1])).astype(np.int64)
    last = np.ceil(np.clip(bottom.imag, 0, size[1])).astype(np.int64)
    height = bottom.imag - top.imag
    count = np.where(height > 0, np.maximum(last - first, 0), 0)
    edge, row = _expand(count, first)
    head, slope = top[edge], ((bottom.real - top.real) / np.where(height > 0, height, 1))[edge]
    above = np.maximum(head.imag, row)
    below = np.minimum(bottom.imag[edge], row + 1)
    signed = np.where(falls[edge], below - above, above - below)
    shift = head.real - head.imag * slope
    return number[edge] * size[1] + row, signed, shift + above * slope, shift + below * slope


def _by_column(rows: _Ints, height: _Floats, x0: _Floats, x1: _Floats, size: tuple[int, int]) -> _Pieces:
    """Cut what lies in one row at pixel columns; column `width` collects what lies further right."""
    left = np.clip(np.minimum(x0, x1), 0, size[0])
    right = np.clip(np.maximum(x0, x1), 0, size[0])
    first = np.floor(left).astype(np.int64)
    count = np.maximum(np.ceil(right).astype(np.int64) - first, 1)
    piece, column = _expand(count, first)
    left, width = left[piece], (right - left)[piece]
    near = np.maximum(left, column)
    far = np.minimum(left + width, column + 1)
    share = np.where(width > 0, (far - near) / np.where(width > 0, width, 1), 1)
    cover = height[piece] * share
    area = cover * (1 + column - 0.5 * (near + far))
    return _Pieces(rows[piece] * (size[0] + 1) + column, cover, area)


def _expand(count: _Ints, first: _Ints) -> tuple[_Ints, _Ints]:
    """Return, for each of count[i] copies of i, i and first[i] + 0, 1, 2, ..."""
    which = np.repeat(np.arange(count.size), count)
    return which, np.arange(which.size) + np.repeat(first - np.cumsum(count) + count, count)


def _resolve(pieces: _Pieces, size: tuple[int, int]) -> tuple[_Coverage, _Coverage]:
    """Sum the pieces along the rows; return the pixels on outlines and the spans between them."""
    order = np.argsort(pieces.key)
    key = pieces.key[order]
    first = np.flatnonzero(np.diff(key, prepend=-1))
    key = key[first]
    cover = np.cumsum(np.add.reduceat(pieces.cover[order], first)) if key.size else pieces.cover
    area = np.add.reduceat(pieces.area[order], first) if key.size else pieces.area
    on_edge = np.abs(np.concatenate((cover[:0], [0.0], cover[:-1]))[: key.size] + area)
    inside = np.minimum(np.abs(cover), 1)
    gap = np.diff(key, append=key[-1:]) - 1
    seen = (key % (size[0] + 1) < size[0]) & (on_edge > _NOTHING)
    between = (inside > _NOTHING) & (gap > 0)
    edges = _Coverage(key[seen], np.ones(int(seen.sum()), np.int64), np.minimum(on_edge[seen], 1))
    return edges, _Coverage(key[between] + 1, gap[between], inside[between])


class _Batch(NamedTuple):
    """Pixels' places in the surface and their coverage, and where each layer's begin."""

    place: _Ints
    cover: NDArray[np.float32]
    bounds: list[int]


def _batch(runs: _Coverage, size: tuple[int, int], count: int) -> _Batch:
    line, column = np.divmod(runs.key, size[0] + 1)
    layer, row = np.divmod(line, size[1])
    run, place = _expand(runs.length, row * size[0] + column)
    ends = np.concatenate(([0], np.cumsum(runs.length)))
    bounds = ends[np.searchsorted(layer, np.arange(count + 1))].tolist()
    return _Batch(place, runs.cover.astype(np.float32)[run], bounds)


def _mix(surface: pygame.Surface, layers: Sequence[Layer], outline: _Coverage, spans: _Coverage) -> None:
    size, count = surface.get_size(), len(layers)
    solid = spans.cover > _SOLID
    full = _batch(_Coverage(*(part[solid] for part in spans)), size, count)
    rest = _batch(_Coverage(*(part[~solid] for part in spans)), size, count) if not solid.all() else None
    edge = _batch(outline, size, count)
    pixels = np.frombuffer(surface.get_buffer(), np.uint8).reshape(-1, 4)
    words = pixels.view(np.uint32)[:, 0]
    clear = bool(surface.get_flags() & pygame.SRCALPHA)
    for n, layer in enumerate(layers):
        ink = _ink(surface, layer.colour)
        inner = slice(full.bounds[n], full.bounds[n + 1])
        if layer.alpha >= 1:
            words[full.place[inner]] = ink.astype(np.uint8).view(np.uint32)[0]
        elif inner.stop > inner.start:
            _blend(pixels, ink, full.place[inner], full.cover[inner] * layer.alpha, clear)
        for batch in (edge, rest) if rest else (edge,):
            part = slice(batch.bounds[n], batch.bounds[n + 1])
            if part.stop > part.start:
                _blend(pixels, ink, batch.place[part], batch.cover[part] * layer.alpha, clear)


def _ink(surface: pygame.Surface, colour: Colour) -> NDArray[np.float32]:
    """Return the colour's bytes in the surface's order, opaque."""
    red, green, blue, _ = surface.get_shifts()
    ink = np.full(4, 255, np.float32)
    ink[[red // 8, green // 8, blue // 8]] = colour
    return ink


def _blend(
    pixels: NDArray[np.uint8],
    ink: NDArray[np.float32],
    place: _Ints,
    cover: NDArray[np.float32],
    clear: bool,
) -> None:
    below = pixels[place].astype(np.float32)
    weight = cover[:, None]
    if clear:
        under = below[:, 3:] / 255
        weight = weight / (weight + under * (1 - weight))
        below += (ink - below) * weight
        below[:, 3:] = 255 * (cover[:, None] + under * (1 - cover[:, None]))
    else:
        below += (ink - below) * weight
    below += 0.5
    pixels[place] = below
