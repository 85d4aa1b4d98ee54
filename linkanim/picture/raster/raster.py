"""Layers of outlines on a surface: what each covers is worked out for all together, then mixed in.

That all layers of a frame go through the arithmetic together is what makes it fast enough in numpy.
Those that lie apart are mixed in together, too: each on the lowest level above all that it may lie on.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple, overload

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.picture.raster.blend import WHOLE, Mix, Shares, Words, mix, mixed_in, shares, words
from linkanim.picture.raster.cells import Edges, Ints, Room, Runs, covered, on_grid, pixel_of, room
from linkanim.picture.raster.cells import Loop as Loop

Colour = tuple[int, int, int]

_KEPT_BYTES = 16 << 20
"""More than a frame's largest arrays take together."""
_MOST_AT_ONCE = 1 << 28
"""So many layers times pixels of the surface are worked out together: thirty at 3840 × 2160."""


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
        """Return it turned by a direction of length 1 about the origin, which then lies at `at`."""
        return Layer(self.colour, outlines_of(self.loops).placed(at, turn), self.alpha)

    def repeated(self, places: Sequence[complex] | Loop) -> Layer:
        """Return it about each of the places."""
        return Layer(self.colour, outlines_of(self.loops).repeated(places), self.alpha)


class _Boxes(NamedTuple):
    """The pixels that each layer may cover: first columns and rows, and the ones after the last."""

    left: Ints
    top: Ints
    right: Ints
    end: Ints


class _Pixels(NamedTuple):
    """Pixels, how much of an ink each is covered with, and where those of each level begin."""

    place: Ints
    share: Shares
    ink: Words
    bounds: Ints


_NONE = np.zeros(0, np.int64)
_NO_PIXELS = _Pixels(_NONE, _NONE.astype(np.uint16), _NONE.astype(np.uint32), _NONE)


class Shapes(NamedTuple):
    """Layers in their order, which end before some column and row, and those over them, which do not.

    Columns and rows from the ends on are left as they are.
    """

    layers: Iterable[Layer]
    ends: tuple[int, int] | None = None
    over: Iterable[Layer] = ()


class Cover:
    """What layers do to every surface of a size and kind: worked out once, put on it any number of times."""

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

    All go through the arithmetic together; where that would take too much memory, some layers at a time, as
    they are asked for.
    """
    known = [(list(layers), ends, list(over)) for layers, ends, over in parts]
    most = max(_MOST_AT_ONCE // max(math.prod(surface.get_size()), 1), 1)
    if sum(len(layers) + len(over) for layers, _, over in known) <= most:
        yield from ([cover] for cover in covers(surface, [Shapes(*part) for part in known]))
        return
    for layers, ends, over in known:
        pieces = [Shapes(layers[n : n + most], ends) for n in range(0, len(layers), most)]
        pieces += [Shapes(over[n : n + most]) for n in range(0, len(over), most)]
        yield (covers(surface, [piece])[0] for piece in pieces)


def paint(surface: pygame.Surface, layers: Iterable[Layer]) -> None:
    """Fill the layers in their order on a 32-bit surface whose rows touch; loops may leave it.

    Where the surface has alpha, it is kept straight (not multiplied into the colours).
    """
    covers(surface, [Shapes(layers)])[0].put(surface)


def keep_memory() -> None:
    """Have the C library keep the memory that a frame frees for the next one.

    glibc gives what is free at the heap's end back to the system where it is more than twice the largest
    block that was ever freed; to get it back, page by page, took a quarter to a half of a frame.
    """
    np.empty(_KEPT_BYTES, np.uint8)


def is_clear(surface: pygame.Surface) -> bool:
    """Return whether a surface lets light through."""
    return bool(surface.get_flags() & pygame.SRCALPHA)


def paints(surface: pygame.Surface) -> bool:
    """Return whether `paint` can write to this surface."""
    return surface.get_bytesize() == 4 and surface.get_pitch() == 4 * surface.get_width()


def _covered(surface: pygame.Surface, parts: Sequence[Shapes]) -> tuple[list[_Pixels], list[int]]:
    """Return the pixels that are covered in full, those on outlines, and those of spans covered in part.

    Also how many levels each of the parts has.
    """
    size = surface.get_size()
    drawn: list[tuple[Layer, Outlines]] = []
    limits, ends = [], [0]
    for part in parts:
        for layers, limit in ((part.layers, np.minimum(part.ends or size, size)), (part.over, size)):
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
    found = ((layer, outlines_of(layer.loops)) for layer in layers)
    return [(layer, outlines) for layer, outlines in found if outlines.counts]


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
    """Return a level for each layer: above all layers before it that it may touch, and else the lowest.

    Those of a part, up to its end, are above all of the part before. Also how many each part has.
    """
    left, top, right, end = (side[:, None] for side in boxes)
    meet = (left < boxes.right) & (right > boxes.left) & (top < boxes.end) & (end > boxes.top)
    taken: list[int] = []
    levels, counts = [], []
    bits, wide = np.packbits(meet, axis=1, bitorder="little").tobytes(), -(-len(meet) // 8)
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


def _inked(runs: Runs, within: Room, drawn: tuple[Words, list[float]], begins: Ints) -> _Pixels:
    """Return the first pixel of each run, for the layers' colours and opacities; levels begin at these."""
    (inks, alphas), bounds, cover = drawn, np.searchsorted(runs.line, within.first), runs.cover
    for n, alpha in enumerate(alphas):
        if alpha < 1:
            cover[bounds[n] : bounds[n + 1]] = alpha * cover[bounds[n] : bounds[n + 1]]
    place = within.starts.take(runs.line) + runs.column
    return _Pixels(place, shares(cover), np.repeat(inks, np.diff(bounds)), bounds[begins])


def _spread(first: _Pixels, length: Ints, chosen: NDArray[np.bool_]) -> _Pixels:
    """Return all pixels of the runs chosen; of runs that are covered whole the shares are left out."""
    runs = np.flatnonzero(chosen)
    begin, share, counts = first.place.take(runs), first.share.take(runs), length.take(runs)
    bounds = np.concatenate(([0], np.cumsum(counts)))[np.searchsorted(runs, first.bounds)]
    partly = np.repeat(share, counts) if share.min(initial=WHOLE) < WHOLE else share[:0]
    return _Pixels(_places(begin, counts), partly, np.repeat(first.ink.take(runs), counts), bounds)


def _places(begin: Ints, counts: Ints) -> Ints:
    """Return the numbers from each beginning on, so many of them."""
    after = np.cumsum(counts)
    steps = np.ones(int(counts.sum()), np.int64)
    steps[:1] = begin[:1]
    steps[after[:-1]] = begin[1:] - begin[:-1] - counts[:-1] + 1
    return np.cumsum(steps, out=steps)
