"""Frames told by what changes from one to the next: a small part of each, and all that a GIF needs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint32]
"""Pixels as numbers: opacity, red, green, blue from the highest byte down."""
Places = NDArray[np.uint32]
"""Numbers of pixels, counted row by row from the top left."""

_NUMBER = np.dtype("<u4")
_BYTES = _NUMBER.itemsize


class Change(NamedTuple):
    """What is not as in the frame before: which pixels, in their order, and what they are now."""

    place: Places
    words: Words


class Comparing:
    """Frames, one after the other, to their changes; the first is told by what is not as its first pixel."""

    def __init__(self) -> None:
        self._before: Words | None = None

    def __call__(self, frame: bytes | bytearray | memoryview) -> bytes:
        """Return a frame's change as it goes through a pipe; of the frame nothing is kept."""
        now, first = np.frombuffer(frame, _NUMBER), b""
        if self._before is None:
            self._before, first = np.full_like(now, now[0]), now[:1].tobytes()
        place = np.flatnonzero(now != self._before)
        words = now.take(place)
        self._before[place] = words
        count = np.array([len(place)], _NUMBER)
        return b"".join((first, count.data, place.astype(_NUMBER).data, words.data))


def changes(source: BinaryIO, pixels: int) -> Iterator[Change]:
    """Yield changes of frames of so many pixels from a pipe until it ends; that of the first names them all.

    EOFError where the pipe ends within one.
    """
    if not (head := source.read(_BYTES)):
        return
    whole = np.full(pixels, _numbers(head, 1))
    place, words = _change(source, source.read(_BYTES))
    whole[place] = words
    yield Change(np.arange(pixels, dtype=_NUMBER), whole)
    while head := source.read(_BYTES):
        yield _change(source, head)


def _change(source: BinaryIO, head: bytes) -> Change:
    count = int(_numbers(head, 1)[0])
    both = _numbers(source.read(2 * count * _BYTES), 2 * count)
    return Change(both[:count], both[count:])


def _numbers(data: bytes, count: int) -> Words:
    if len(data) < count * _BYTES:
        raise EOFError("the frames broke off")
    return np.frombuffer(data, _NUMBER)
