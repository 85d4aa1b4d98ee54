"""Fill outlines with exact coverage and mix them into a surface's pixels.

Outlines become pixels by exact area coverage, so that a slow edge glides instead of shivering. All layers
of a picture are covered together and then mixed in, in 8 bits. A surface without a window gives its bytes.
Nothing here knows a linkage.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from io import BytesIO
from itertools import accumulate, pairwise
from typing import NamedTuple, overload

import numpy as np
import pygame
from numpy.typing import NDArray

# Outlines to pixels by exact area coverage, so that a slow edge glides instead of shivering.
#
# Every edge is cut where it crosses pixel rows and columns; each piece adds to its pixel the signed
# area to its right, and its height to everything further right in the row. Sorted and summed along
# the rows these give the winding number averaged over each pixel, without sampling. Corners lie on a
# grid of 1/1024 of a pixel, so that the sums are whole numbers: the same on every machine, in any order.
#
# Method: the cell accumulation of scan converters such as FreeType's "smooth" rasteriser.

Loop = NDArray[np.complex128]
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
"""Single precision: exact for whole numbers up to the grid's width, and fine enough to round to its steps."""
Ints = NDArray[np.int64]
Counts = NDArray[np.int32]

_BITS = 10
_STEPS = 1 << _BITS
"""Steps of the grid to a pixel."""
WHOLE_BITS = 2 * _BITS + 1
"""The coverage of a whole pixel is 2 to the power of this."""
_FAR = float(1 << 31)
"""Corners further off than this, in steps, are moved to this distance."""
_COLUMN_BITS = 15
_COLUMNS = (1 << _COLUMN_BITS) - 1
_WHOLE = 1 << WHOLE_BITS
_NOTHING = _WHOLE >> 9
"""Coverage below this does not show."""


class Edges(NamedTuple):
    """Edges from x + yi to x + yi in steps of the grid, each with the number of its layer."""

    begin: Loop
    end: Loop
    layer: Ints


class Room(NamedTuple):
    """Where on a surface each layer may lie: its first row, how many rows, and the column it ends before.

    A line is one row of one layer; the lines of all layers are numbered in one sequence. `first` has the
    number of each layer's first line, then the number of all lines; `starts` is the index of each line's
    first pixel among the surface's.
    """

    top: Ints
    high: Ints
    end: Ints
    first: Ints
    starts: Ints


def room(top: Ints, high: Ints, end: Ints, width: int) -> Room:
    """Return where layers may lie on a surface `width` pixels wide."""
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
    """Pieces of edges, each within one line: its height, and its left and right end, in steps."""

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
    """Return points in steps of the grid; a point that is not a number lies far outside."""
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
    """Cut pieces within one row at pixel columns; those beyond a layer's last column add up there."""
    # upright pieces lean by a step, so that all are cut in one way
    right = np.maximum(rows.right, rows.left + 1)
    width = right - rows.left
    if not width.all():  # at the end of the widest picture, where floats of 32 bits are two steps apart
        right += 2 * (width == 0)
        width = right - rows.left
    steep = (rows.height / width).astype(np.float32)
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
    """Return the order of pieces by line and column; numpy sorts short whole numbers by a fast radix sort."""
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


# Colours mixed into a surface's pixels; all four bytes of a pixel are treated alike.
#
# Single precision holds bytes and their shares far finer than they show; its products and sums are rounded
# alike on every machine.

Words = NDArray[np.uint32]
"""Pixels or colours as a surface keeps them, four bytes each."""
Shares = NDArray[np.uint16]
"""How much of each pixel is covered, 0 to `WHOLE`."""

_SHARE_BITS = 15
WHOLE = 1 << _SHARE_BITS
_ALIKE = np.uint64(0x0001_0001_0001_0001)
_HALF = np.float32(0.5)


class Mix(NamedTuple):
    """What mixing does to n pixels: each byte keeps a share of itself, and a level is added (both 4n,).

    The levels include a half, for rounding.
    """

    place: Ints
    keep: Singles
    add: Singles


def shares(cover: Counts | Floats) -> Shares:
    """Return coverage (0 to 2 to the power of `WHOLE_BITS`) as shares (0 to `WHOLE`)."""
    shift = WHOLE_BITS - _SHARE_BITS
    return (cover.astype(np.int32) + (1 << shift - 1) >> shift).astype(np.uint16)


def mixed_in(place: Ints, share: Shares, ink: Words) -> Mix:
    """Return what mixing in the share of a colour does to each pixel."""
    of_bytes = (share.astype(np.uint64) * _ALIKE).view(np.uint16).astype(np.float32)
    of_bytes *= np.float32(1 / WHOLE)
    add = ink.view(np.uint8) * of_bytes
    add += _HALF
    return Mix(place, np.float32(1) - of_bytes, add)


def mix(pixels: Words, what: Mix, begin: int, end: int, *, clear: bool) -> None:
    """Mix into a surface's pixels the part of a mix from `begin` to `end`.

    `clear` says that the surface has transparency: its colours are kept straight, not multiplied by opacity.
    """
    place, bytes_ = what.place[begin:end], slice(4 * begin, 4 * end)
    keep, add = what.keep[bytes_], what.add[bytes_]
    levels = pixels.take(place).view(np.uint8).astype(np.float32)
    if clear:
        levels = _straight(levels.reshape(-1, 4), keep.reshape(-1, 4), add.reshape(-1, 4)).ravel()
    else:
        levels *= keep
        levels += add
    pixels[place] = levels.astype(np.uint8).view(np.uint32)


def _straight(below: Singles, keep: Singles, add: Singles) -> Singles:
    """Return mixed pixels (n, 4), opacity last: colours are weighted by their share of the opacity."""
    add = add - _HALF
    opacity = below[:, 3:] * keep[:, 3:] + add[:, 3:]
    colours = below[:, :3] * (below[:, 3:] / np.float32(255)) * keep[:, :3] + add[:, :3]
    straight = colours * (np.float32(255) / np.maximum(opacity, np.float32(1 / 255)))
    return np.concatenate((straight, opacity), axis=1) + _HALF


def words(surface: pygame.Surface, colours: Iterable[tuple[int, int, int]]) -> Words:
    """Return opaque colours as the surface keeps them."""
    inks = np.array([surface.map_rgb(colour) for colour in colours], np.int64).astype(np.uint32)
    return inks | np.uint32(0xFFFFFFFF ^ sum(surface.get_masks()[:3]))


# Layers of outlines on a surface: what each covers is worked out for all together, then mixed in.
#
# All layers of a frame go through the arithmetic together, which makes it fast enough in numpy. Layers that
# lie apart are mixed in together, too: each stands on the lowest level above all layers that it may cover.

Colour = tuple[int, int, int]

_MOST_AT_ONCE = 1 << 28
"""The most layers times pixels that are worked out together: about thirty layers at 3840 × 2160."""
_PIECES = 8
"""Where there are more, they are worked out in pieces so many times smaller: a quarter of the memory."""

_MOST_PAIRS = 1 << 24
"""The most pairs of layers that are compared together: all pairs of four thousand layers."""


class Outlines(Sequence[Loop]):
    """Closed loops, one after the other in one array: they are placed together."""

    def __init__(self, points: Loop, counts: tuple[int, ...]) -> None:
        self.points, self.counts = points, counts

    def placed(self, at: complex, turn: complex) -> Outlines:
        """Return the loops turned by a direction of length 1 about the origin, which then lies at `at`."""
        return Outlines(at + turn * self.points, self.counts)

    def repeated(self, places: Sequence[complex] | Loop) -> Outlines:
        """Return the loops about each of the places."""
        points = np.add.outer(np.asarray(places, np.complex128), self.points).ravel()
        return Outlines(points, self.counts * len(places))

    def __len__(self) -> int:
        return len(self.counts)

    def __iter__(self) -> Iterator[Loop]:
        return iter(self[:])

    @overload
    def __getitem__(self, index: int) -> Loop: ...
    @overload
    def __getitem__(self, index: slice) -> list[Loop]: ...
    def __getitem__(self, index: int | slice) -> Loop | list[Loop]:
        return np.split(self.points, np.cumsum(self.counts)[:-1])[index]


def outlines_of(loops: Sequence[Loop]) -> Outlines:
    """Return loops in one array."""
    if isinstance(loops, Outlines):
        return loops
    if len(loops) == 1:
        return Outlines(loops[0], (len(loops[0]),))
    points = np.concatenate(loops) if loops else np.zeros(0, np.complex128)
    return Outlines(points, tuple(map(len, loops)))


class Layer(NamedTuple):
    """Closed loops of pixel positions x + yi filled with one colour, over the layers before it.

    Loops that turn the same way join where they overlap; a loop that turns the other way cuts a hole.
    """

    colour: Colour
    loops: Sequence[Loop]
    alpha: float = 1.0

    def placed(self, at: complex, turn: complex = 1 + 0j) -> Layer:
        """Return the layer turned by a direction of length 1 about the origin, which then lies at `at`."""
        return Layer(self.colour, outlines_of(self.loops).placed(at, turn), self.alpha)

    def repeated(self, places: Sequence[complex] | Loop) -> Layer:
        """Return the layer repeated about each of the places."""
        return Layer(self.colour, outlines_of(self.loops).repeated(places), self.alpha)


class _Boxes(NamedTuple):
    """The pixels that each layer may cover: first columns and rows, and the ones after the last."""

    left: Ints
    top: Ints
    right: Ints
    end: Ints


class _Pixels(NamedTuple):
    """Pixels, the share and the ink that each is covered with, and where the pixels of each level begin."""

    place: Ints
    share: Shares
    ink: Words
    bounds: Ints


_NONE = np.zeros(0, np.int64)
_NO_PIXELS = _Pixels(_NONE, _NONE.astype(np.uint16), _NONE.astype(np.uint32), _NONE)


class Shapes(NamedTuple):
    """Layers in their order, cut off at a column and a row (`ends`), and layers `over` them that are not cut.

    The pixels of that column and that row, and all beyond them, are left as they are.
    """

    layers: Iterable[Layer]
    ends: tuple[int, int] | None = None
    over: Iterable[Layer] = ()


class Cover:
    """What layers do to any surface of one size and kind: worked out once, applied any number of times."""

    def __init__(self, full: _Pixels, mixes: list[tuple[Mix, list[int]]], levels: range) -> None:
        self._full, self._mixes, self._levels = full, mixes, levels

    @property
    def nbytes(self) -> int:
        """The memory that it takes."""
        full = self._full.place.nbytes + self._full.ink.nbytes
        return full + sum(what.place.nbytes + what.keep.nbytes + what.add.nbytes for what, _ in self._mixes)

    def put(self, surface: pygame.Surface) -> None:
        """Fill the pixels that are covered in full and mix the others, level by level."""
        if not self._levels:
            return
        pixels: Words = np.frombuffer(surface.get_buffer(), np.uint32)  # type: ignore[call-overload]
        clear, full, bounds = is_clear(surface), self._full, self._full.bounds.tolist()
        for level in self._levels:
            inside = slice(bounds[level], bounds[level + 1])
            if inside.start < inside.stop:
                pixels[full.place[inside]] = full.ink[inside]
            for mixed, at in self._mixes:
                if at[level] < at[level + 1]:
                    mix(pixels, mixed, at[level], at[level + 1], clear=clear)


def covers(surface: pygame.Surface, parts: Sequence[Shapes]) -> list[Cover]:
    """Return what each part does to surfaces like this one; all go through the arithmetic together."""
    (full, *others), levels = _covered(surface, parts)
    mixes = [(mixed_in(some.place, some.share, some.ink), some.bounds.tolist()) for some in others]
    return [Cover(full, mixes, range(*ends)) for ends in pairwise((0, *accumulate(levels)))]


def in_turn(surface: pygame.Surface, parts: Iterable[Shapes]) -> Iterator[Iterable[Cover]]:
    """Yield what each part does to surfaces like this one, to be put on it one after the other.

    All go through the arithmetic together; where that would take too much memory, they are worked out some
    layers at a time, as they are asked for.
    """
    known = [(list(layers), ends, list(over)) for layers, ends, over in parts]
    most = max(_MOST_AT_ONCE // max(math.prod(surface.get_size()), 1), 1)
    if sum(len(layers) + len(over) for layers, _, over in known) <= most:
        yield from ([cover] for cover in covers(surface, [Shapes(*part) for part in known]))
        return
    most = max(most // _PIECES, 1)
    for layers, ends, over in known:
        pieces = [Shapes(layers[n : n + most], ends) for n in range(0, len(layers), most)]
        pieces += [Shapes(over[n : n + most]) for n in range(0, len(over), most)]
        yield (covers(surface, [piece])[0] for piece in pieces)


def paint(surface: pygame.Surface, layers: Iterable[Layer]) -> None:
    """Fill the layers in their order on a 32-bit surface without gaps between rows; loops may leave it.

    Where the surface has alpha, colours are kept straight (not multiplied by it).
    """
    covers(surface, [Shapes(layers)])[0].put(surface)


def is_clear(surface: pygame.Surface) -> bool:
    """Return whether a surface has transparency."""
    return bool(surface.get_flags() & pygame.SRCALPHA)


def paints(surface: pygame.Surface) -> bool:
    """Return whether `paint` can write to this surface."""
    return surface.get_bytesize() == 4 and surface.get_pitch() == 4 * surface.get_width()


def _covered(surface: pygame.Surface, parts: Sequence[Shapes]) -> tuple[list[_Pixels], list[int]]:
    """Return the pixels that are covered in full, those on outlines, and those of spans covered in part.

    The second value is the number of levels of each part.
    """
    size = surface.get_size()
    drawn: list[tuple[Layer, Outlines]] = []
    limits, ends = [], [0]
    for part in parts:
        for layers, limit in ((part.layers, np.clip(part.ends or size, 0, size)), (part.over, size)):
            some = _with_loops(layers)
            drawn += some
            limits += [limit] * len(some)
        ends.append(len(drawn))
    if not drawn:
        return [_NO_PIXELS], [0] * len(parts)
    edge = np.array(limits).T
    edges, boxes = _outlined([outlines for _, outlines in drawn], edge)
    levels, counts = _levels(boxes, ends)
    order = np.argsort(levels, kind="stable")
    within = room(boxes.top[order], (boxes.end - boxes.top)[order], edge[0][order], size[0])
    outline, spans = covered(edges._replace(layer=np.argsort(order)[edges.layer]), within)
    filled = [drawn[n][0] for n in order.tolist()]
    inks, alphas = words(surface, [layer.colour for layer in filled]), [layer.alpha for layer in filled]
    begins = np.searchsorted(levels[order], np.arange(sum(counts) + 1))
    rim, inside = (_inked(runs, within, (inks, alphas), begins) for runs in (outline, spans))
    full = inside.share == WHOLE
    return [_spread(inside, spans.length, full), rim, _spread(inside, spans.length, ~full)], counts


def _with_loops(layers: Iterable[Layer]) -> list[tuple[Layer, Outlines]]:
    """Return the layers that have loops, with these."""
    outlined = ((layer, outlines_of(layer.loops)) for layer in layers)
    return [(layer, outlines) for layer, outlines in outlined if outlines.counts]


def _outlined(outlines: Sequence[Outlines], limits: Ints) -> tuple[Edges, _Boxes]:
    """Return the layers' edges, and which pixels each may cover before its limits (2, n)."""
    begin = on_grid(np.concatenate([outline.points for outline in outlines]))
    counts = np.array([count for outline in outlines for count in outline.counts])
    sizes = np.array([len(outline.points) for outline in outlines])
    last = np.cumsum(counts) - 1
    end = np.empty_like(begin)
    end[:-1] = begin[1:]
    end[last] = begin[last - counts + 1]
    number = np.repeat(np.arange(len(outlines)), sizes)
    return Edges(begin, end, number), _boxes(begin, np.cumsum(sizes) - sizes, limits)


def _boxes(points: Loop, starts: Ints, limits: Ints) -> _Boxes:
    """Return the pixels about the points of each layer, within its limits."""
    sides = []
    for part, end in zip((points.real, points.imag), limits, strict=True):
        low = np.minimum(np.maximum(pixel_of(np.minimum.reduceat(part, starts)), 0), end)
        high = np.minimum(np.maximum(-pixel_of(-np.maximum.reduceat(part, starts)), low), end)
        sides.append((low, high))
    (left, right), (top, bottom) = sides
    return _Boxes(left, top, right, bottom)


def _levels(boxes: _Boxes, ends: Sequence[int]) -> tuple[Ints, list[int]]:
    """Return a level for each layer: the lowest above all layers before it that it may touch.

    The levels of a part, whose layers stop at its end, are above all of the part before. The second value is
    the number of levels of each part.
    """
    count, taken = len(boxes.left), list[int]()
    levels, counts = [], []
    # with tens of thousands of layers a byte for each pair would take too much memory
    some = max(_MOST_PAIRS // count, 1)
    bits = b"".join(_meeting(boxes, slice(n, n + some)) for n in range(0, count, some))
    wide = -(-count // 8)
    for begin, after in pairwise(ends):
        lowest = len(taken)
        for n in range(begin, after):
            touched = int.from_bytes(bits[n * wide : (n + 1) * wide], "little")
            level = len(taken)
            while level > lowest and not taken[level - 1] & touched:
                level -= 1
            if level == len(taken):
                taken.append(0)
            taken[level] |= 1 << n
            levels.append(level)
        counts.append(len(taken) - lowest)
    return np.array(levels), counts


def _meeting(boxes: _Boxes, some: slice) -> bytes:
    """Return a row of bits for each of some layers: which of all layers it may touch."""
    left, top, right, end = (side[some, None] for side in boxes)
    meet = (left < boxes.right) & (right > boxes.left) & (top < boxes.end) & (end > boxes.top)
    return np.packbits(meet, axis=1, bitorder="little").tobytes()


def _inked(runs: Runs, within: Room, drawn: tuple[Words, list[float]], begins: Ints) -> _Pixels:
    """Return the first pixel of each run, for the layers' colours and opacities; levels begin at these."""
    (inks, alphas), bounds, cover = drawn, np.searchsorted(runs.line, within.first), runs.cover
    for n, alpha in enumerate(alphas):
        if alpha < 1:
            cover[bounds[n] : bounds[n + 1]] = alpha * cover[bounds[n] : bounds[n + 1]]
    place = within.starts.take(runs.line) + runs.column
    return _Pixels(place, shares(cover), np.repeat(inks, np.diff(bounds)), bounds[begins])


def _spread(first: _Pixels, length: Ints, chosen: NDArray[np.bool_]) -> _Pixels:
    """Return all pixels of the runs chosen; for runs that are covered in full the shares are left out."""
    runs = np.flatnonzero(chosen)
    begin, share, counts = first.place.take(runs), first.share.take(runs), length.take(runs)
    bounds = np.concatenate(([0], np.cumsum(counts)))[np.searchsorted(runs, first.bounds)]
    partly = np.repeat(share, counts) if share.min(initial=WHOLE) < WHOLE else share[:0]
    return _Pixels(_ranges(begin, counts), partly, np.repeat(first.ink.take(runs), counts), bounds)


def _ranges(begin: Ints, counts: Ints) -> Ints:
    """Return consecutive numbers from each beginning on, as many as its count says."""
    after = np.cumsum(counts)
    steps = np.ones(int(counts.sum()), np.int64)
    steps[:1] = begin[:1]
    steps[after[:-1]] = begin[1:] - begin[:-1] - counts[:-1] + 1
    return np.cumsum(steps, out=steps)


# A surface without a window, and its bytes.


def offscreen(size: tuple[int, int], *, alpha: bool = False) -> pygame.Surface:
    """Return a surface of 32-bit pixels whose bytes are blue, green, red and, where `alpha`, opacity."""
    opacity = 0xFF000000 if alpha else 0
    return pygame.Surface(size, pygame.SRCALPHA if alpha else 0, 32, (0xFF0000, 0xFF00, 0xFF, opacity))


def pixel_view(surface: pygame.Surface) -> memoryview:
    """Return a surface's pixels, row by row, as they are; it cannot be drawn on while the view is held."""
    return memoryview(surface.get_buffer())  # type: ignore[arg-type]


def ground_clear(surface: pygame.Surface, colour: Colour) -> None:
    """Give each pixel that shows nothing one colour; it has that of whatever was cached and drawn there."""
    pixels, opacity = np.frombuffer(pixel_view(surface), np.uint32), np.uint32(surface.get_masks()[3])
    pixels[pixels & opacity == 0] = words(surface, [colour])[0] & ~opacity


def png_bytes(surface: pygame.Surface) -> bytes:
    """Return a surface as a PNG file's bytes."""
    file = BytesIO()
    pygame.image.save(surface, file, ".png")
    return file.getvalue()
