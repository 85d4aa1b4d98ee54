"""Frames told by what changes from one to the next: a small part of each, and all that a GIF needs."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint32]
"""Pixels as numbers: opacity, red, green, blue from the highest byte down."""
Places = NDArray[np.uint32]
"""Numbers of pixels, counted row by row from the top left."""

_COUNT = struct.Struct("<I")
_NUMBER = np.dtype("<u4")


class Change(NamedTuple):
    """What is not as in the frame before: which pixels, in their order, and what they are now."""

    place: Places
    words: Words


class Comparing:
    """Frames of so many pixels, one after the other, to their changes; before the first all is zero."""

    def __init__(self, pixels: int) -> None:
        self._before = np.zeros(pixels, _NUMBER)

    def __call__(self, frame: bytes | bytearray | memoryview) -> bytes:
        """Return a frame's change as it goes through a pipe; of the frame nothing is kept."""
        now = np.frombuffer(frame, _NUMBER)
        place = np.flatnonzero(now != self._before)
        words = now.take(place)
        self._before[place] = words
        return b"".join((_COUNT.pack(len(place)), place.astype(_NUMBER).data, words.data))


def changes(source: BinaryIO) -> Iterator[Change]:
    """Yield changes from a pipe until it ends; EOFError where it ends within one."""
    while head := source.read(_COUNT.size):
        (count,) = _COUNT.unpack(_whole(head, _COUNT.size))
        data = np.frombuffer(_whole(source.read(2 * 4 * count), 2 * 4 * count), _NUMBER)
        yield Change(data[:count], data[count:])


def _whole(data: bytes, size: int) -> bytes:
    if len(data) < size:
        raise EOFError("the frames broke off")
    return data
