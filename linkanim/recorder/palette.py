"""The one palette of a GIF: flat colours as they are, the rest by cutting the colours' box."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Colour = tuple[int, int, int]
Bytes = NDArray[np.uint8]

MOST = 255
"""A GIF has 256 colours; one stands for what does not change, or is transparent."""
_FLAT = 64
_LENGTH_BITS = np.uint64(32)
_LENGTH = np.uint64((1 << 32) - 1)
_OPAQUE = 128
"""Alpha from which a pixel counts as opaque: half, as in the encoder."""


def make_palette(
    samples: Iterable[Bytes], given: Sequence[Colour] = (), *, alpha: bool = False, most: int = MOST
) -> Bytes:
    """Return up to `most` colours (n, 3) as red, green, blue for frames like the samples.

    `samples` are frames of bytes blue, green, red, and alpha where `alpha`, else anything. The
    `given` colours and the most frequent ones (the flat areas) are in it exactly; where there are more
    than `most`, the others are means of boxes, each cut at the mean of the axis where it errs most,
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
    # map lets go of each sample before it asks for the next, which may be drawn in its place
    runs = np.concatenate(list(map(partial(_runs, alpha=alpha), samples)))
    runs.sort()
    values = (runs >> _LENGTH_BITS).astype(np.uint32)
    first = np.flatnonzero(np.append(True, values[1:] != values[:-1])[: len(values)])
    unique, counts = values[first], np.add.reduceat((runs & _LENGTH).astype(np.int64), first)
    return np.stack([unique >> 16 & 255, unique >> 8 & 255, unique & 255], axis=1).astype(np.uint8), counts


def _runs(sample: Bytes, *, alpha: bool) -> NDArray[np.uint64]:
    """Return the opaque runs of equal pixels, far fewer than these: 0xrrggbb, and their length below it."""
    pixels = np.ascontiguousarray(sample).view("<u4").reshape(-1)
    starts = np.flatnonzero(np.concatenate([[True], pixels[1:] != pixels[:-1]]))
    lengths = np.diff(starts, append=len(pixels)).astype(np.uint64)
    values = pixels[starts]
    opaque = (values >> 24 >= _OPAQUE) | (not alpha)
    colours = (values & np.uint32(0xFFFFFF)).astype(np.uint64)
    return (colours << _LENGTH_BITS | lengths)[opaque]


class _Box(NamedTuple):
    """Some of the colours; ordered by squared error, largest first, then by age."""

    error: float
    age: int
    members: NDArray[np.intp]
    axis: int
    mean: NDArray[np.float64]


def _means(colours: NDArray[np.float64], weights: NDArray[np.float64], count: int) -> Bytes:
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


def _box(
    colours: NDArray[np.float64], weights: NDArray[np.float64], members: NDArray[np.intp], age: int
) -> _Box:
    inside, share = colours[members], weights[members]
    mean = share @ inside / share.sum()
    errors = share @ (inside - mean) ** 2
    total = float(errors.sum()) if len(members) > 1 else 0.0
    return _Box(-total, age, members, int(errors.argmax()), mean)
