"""The palette of a GIF: flat colours exactly, the rest by cutting their box; and frames as its indices."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Colour = tuple[int, int, int]
Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Words = NDArray[np.uint32]
"""Pixels or colours as numbers: 0xrrggbb, and in the highest byte opacity or nothing of meaning."""

MOST = 255
"""A GIF has 256 colours; one stands for what does not change, or is transparent."""
_FLAT = 64
_LENGTH_BITS = np.uint64(32)
_LENGTH = np.uint64((1 << 32) - 1)
_OPAQUE = 128
"""Alpha from which a pixel counts as opaque: half."""
_TO_CONES = np.array([[0.4122, 0.5363, 0.0514], [0.2119, 0.6807, 0.1074], [0.0883, 0.2817, 0.6300]]).T
_TO_OKLAB = np.array([[0.2105, 0.7936, -0.0041], [1.9780, -2.4286, 0.4506], [0.0259, 0.7828, -0.8087]]).T
_AT_ONCE = 4096
"""Colours that are looked up together; all those of a photograph took hundreds of megabytes."""

_BLOCK = 1 << 20
"""Pixels that are compared together; for a whole large frame the indices alone took 200 MB."""


class Indexing:
    """Turns frames into indices of a palette, from 1 on, and 0 for transparent; each ends with the palette.

    Only pixels that differ from the frame before are looked up, and each colour once.
    """

    def __init__(self, palette: Sequence[Colour], pixels: int, *, alpha: bool) -> None:
        colours = np.array(palette, np.uint8)
        self._palette, self._alpha = _oklab(colours), alpha
        self._known = np.zeros(1 << 24, np.uint8)  # the system provides only memory that is used
        self._before = np.zeros(pixels, "<u4")
        table = np.full((MOST + 1, 4), (0, 0, 0, 255), np.uint8)
        table[0], table[1 : len(colours) + 1, :3] = 0, colours[:, ::-1]
        self._bytes = np.concatenate([np.full(pixels, self._indices(self._before[:1])), table.ravel()])

    def __call__(self, frame: bytes | bytearray | memoryview) -> memoryview:
        """Return a frame's bytes, which the next call overwrites."""
        now = np.frombuffer(frame, "<u4")
        for begin in range(0, len(now), _BLOCK):
            part = slice(begin, min(begin + _BLOCK, len(now)))
            place = np.flatnonzero(now[part] != self._before[part])
            words = now[part].take(place)
            self._before[part][place] = words
            self._bytes[part][place] = self._indices(words)
        return self._bytes.data

    def _indices(self, words: Words) -> Bytes:
        colours = words & np.uint32(0xFFFFFF)
        indices = self._known.take(colours)
        if not indices.all():
            new = np.unique(colours[indices == 0])
            for some in np.array_split(new, len(new) // _AT_ONCE + 1):
                self._known[some] = 1 + nearest(_oklab(rgb(some)), self._palette)
            indices = self._known.take(colours)
        return np.where(words >> 24 < _OPAQUE, np.uint8(0), indices) if self._alpha else indices


def nearest(colours: Floats, palette: Floats) -> NDArray[np.intp]:
    """Return for each colour (n, 3) the number of the nearest in a palette (m, 3), the first of equals."""
    # |a - b|² without |a|², the same for every b
    products = _product(colours, 2.0 * palette.T)
    distances = np.subtract((palette**2).sum(axis=1), products, out=products)
    numbers: NDArray[np.intp] = distances.argmin(axis=1)
    return numbers


def _product(rows: Floats, matrix: Floats) -> Floats:
    """Return rows (n, 3) times a matrix (3, m); the bits of a row's product do not depend on other rows.

    A library's product rounds differently for other numbers of rows; a GIF would depend on which pixels were
    looked up together.
    """
    products: Floats = rows[:, :1] * matrix[0]
    for k in (1, 2):
        products += rows[:, k : k + 1] * matrix[k]
    return products


def _oklab(colours: Bytes) -> Floats:
    """Return colours (n, 3) in Oklab, where distances are as they look (Ottosson 2020)."""
    parts = colours / 255.0
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return _product(np.cbrt(_product(linear, _TO_CONES)), _TO_OKLAB)


def rgb(words: Words) -> Bytes:
    """Return colours (n, 3) as red, green, blue."""
    return words.view(np.uint8).reshape(-1, 4)[:, 2::-1]


def make_palette(
    samples: Iterable[Bytes], given: Sequence[Colour] = (), *, alpha: bool = False, most: int = MOST
) -> Bytes:
    """Return up to `most` colours (n, 3) as red, green, blue for frames like the samples.

    `samples` are frames of bytes blue, green, red, and alpha if `alpha`, else a byte without meaning. The
    `given` colours and the most frequent ones (the flat areas) are in it exactly; where there are more
    than `most`, the others are means of boxes, each cut at the mean along the axis of its largest error,
    the box of the largest squared error first.
    """
    colours, weights = _counted(samples, alpha)
    order = np.argsort(-weights, kind="stable")
    colours, weights = colours[order], weights[order]
    fixed = np.array(list(dict.fromkeys(given)), np.uint8).reshape(-1, 3)[:most]
    new = ~(colours[:, None, :] == fixed[None, :, :]).all(axis=2).any(axis=1)
    colours, weights = colours[new], weights[new]
    room = most - len(fixed)
    if len(colours) <= room:
        return np.concatenate([fixed, colours])
    flat = min(_FLAT, room // 2)
    rest = _means(colours[flat:].astype(float), weights[flat:].astype(float), room - flat)
    return np.concatenate([fixed, colours[:flat], rest])


def _counted(samples: Iterable[Bytes], alpha: bool) -> tuple[Bytes, NDArray[np.int64]]:
    """Return each opaque colour (n, 3) of the samples once, and how many pixels have it."""
    # map releases each sample before it asks for the next, which may be drawn in the same memory
    runs = np.concatenate(list(map(partial(_runs, alpha=alpha), samples)))
    runs.sort()
    values = (runs >> _LENGTH_BITS).astype(np.uint32)
    first = np.flatnonzero(np.append(True, values[1:] != values[:-1])[: len(values)])
    return rgb(values[first]), np.add.reduceat((runs & _LENGTH).astype(np.int64), first)


def _runs(sample: Bytes, *, alpha: bool) -> NDArray[np.uint64]:
    """Return the opaque runs of equal pixels as numbers: 0xrrggbb above, the length in the low 32 bits."""
    pixels = np.ascontiguousarray(sample).view("<u4").reshape(-1)
    starts = np.flatnonzero(np.concatenate([[True], pixels[1:] != pixels[:-1]]))
    lengths = np.diff(starts, append=len(pixels)).astype(np.uint64)
    values = pixels[starts]
    opaque = (values >> 24 >= _OPAQUE) | (not alpha)
    colours = (values & np.uint32(0xFFFFFF)).astype(np.uint64)
    return (colours << _LENGTH_BITS | lengths)[opaque]


class _Box(NamedTuple):
    """Some of the colours; boxes are ordered by squared error, stored negative, largest first, then age."""

    error: float
    age: int
    members: NDArray[np.intp]
    axis: int
    mean: Floats


def _means(colours: Floats, weights: Floats, count: int) -> Bytes:
    """Return the means of `count` boxes of the colours."""
    boxes = [_box(colours, weights, np.arange(len(colours)), 0)]
    for age in range(1, 2 * count, 2):
        if len(boxes) == count or boxes[0].error >= 0.0:
            break
        _, _, members, axis, mean = heapq.heappop(boxes)
        low = colours[members, axis] <= mean[axis]
        heapq.heappush(boxes, _box(colours, weights, members[low], age))
        heapq.heappush(boxes, _box(colours, weights, members[~low], age + 1))
    return np.rint([box.mean for box in sorted(boxes, key=lambda box: box.age)]).astype(np.uint8)


def _box(colours: Floats, weights: Floats, members: NDArray[np.intp], age: int) -> _Box:
    inside, share = colours[members], weights[members]
    mean = share @ inside / share.sum()
    errors = share @ (inside - mean) ** 2
    total = float(errors.sum()) if len(members) > 1 else 0.0
    return _Box(-total, age, members, int(errors.argmax()), mean)
