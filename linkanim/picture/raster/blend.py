"""Colours mixed into a surface's pixels, all four bytes of each alike.

Numbers in single precision hold bytes and their shares far finer than they show; products and sums
of such are rounded alike on every machine.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.picture.raster.cells import WHOLE_BITS, Counts, Floats, Ints, Singles

Words = NDArray[np.uint32]
"""Pixels or colours as a surface keeps them, four bytes each."""
Shares = NDArray[np.uint16]
"""How much of pixels is covered, 0 to `WHOLE`."""

_SHARE_BITS = 15
WHOLE = 1 << _SHARE_BITS
_ALIKE = np.uint64(0x0001_0001_0001_0001)
_HALF = np.float32(0.5)


class Mix(NamedTuple):
    """What becomes of pixels: of each byte is kept a share, and a level added; both (4n,).

    The levels hold the half that rounds.
    """

    place: Ints
    keep: Singles
    add: Singles


def shares(cover: Counts | Floats) -> Shares:
    """Return coverage as it is mixed by."""
    shift = WHOLE_BITS - _SHARE_BITS
    return (cover.astype(np.int32) + (1 << shift - 1) >> shift).astype(np.uint16)


def mixed_in(place: Ints, share: Shares, ink: Words) -> Mix:
    """Return what mixing in so much of a colour does, for each pixel its own."""
    of_bytes = (share.astype(np.uint64) * _ALIKE).view(np.uint16).astype(np.float32)
    of_bytes *= np.float32(1 / WHOLE)
    add = ink.view(np.uint8) * of_bytes
    add += _HALF
    return Mix(place, np.float32(1) - of_bytes, add)


def mix(pixels: Words, what: Mix, begin: int, end: int, *, clear: bool) -> None:
    """Mix some of what there is into pixels.

    `clear` where the surface itself lets light through: its colours are kept straight.
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
    """Return pixels (n, 4) whose opacity is their last byte, mixed: colours by their part in the opacity."""
    add = add - _HALF
    opacity = below[:, 3:] * keep[:, 3:] + add[:, 3:]
    colours = below[:, :3] * (below[:, 3:] / np.float32(255)) * keep[:, :3] + add[:, :3]
    straight = colours * (np.float32(255) / np.maximum(opacity, np.float32(1 / 255)))
    return np.concatenate((straight, opacity), axis=1) + _HALF


def words(surface: pygame.Surface, colours: Iterable[tuple[int, int, int]]) -> Words:
    """Return colours as the surface keeps them, opaque."""
    inks = np.array([surface.map_rgb(colour) for colour in colours], np.int64).astype(np.uint32)
    return inks | np.uint32(0xFFFFFFFF ^ sum(surface.get_masks()[:3]))
