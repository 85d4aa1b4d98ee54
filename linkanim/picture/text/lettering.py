"""Words that move: set once in a halo, and put down to a quarter of a pixel, so that they glide."""

from __future__ import annotations

from functools import cached_property
from itertools import product
from math import ceil

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.picture.raster.directions import directions
from linkanim.picture.raster.offscreen import offscreen, pixel_view
from linkanim.picture.raster.raster import Colour
from linkanim.picture.text.text import Type

_FINE = 4
"""Words are set so many times larger and averaged, and placed to such a part of a pixel."""
_RING = directions(np.linspace(0, 2 * np.pi, 24, endpoint=False))
"""Where a halo reaches from every point of a letter."""


class Lettering:
    """One line of text in a halo of another colour, drawn about its middle."""

    def __init__(self, text: str, kind: Type, size: int, colours: tuple[Colour, Colour], halo: float) -> None:
        ink, back = colours
        self.ink, self.halo = ink, (back, halo)
        self._cover, above = _letters(text, kind, size)
        high, wide = self._cover.shape
        self.drop = (above + high / 2) / _FINE
        """How far the middle lies below the line's top."""
        self._drawn: dict[tuple[int, int], pygame.Surface] = {}
        around = 2 * (round(_FINE * halo) + 1)
        self.size: tuple[float, float] = ((wide + around) / _FINE, (high + around) / _FINE)

    @cached_property
    def _parts(self) -> NDArray[np.float32]:
        """The words in their halo, worked out when drawn: many are measured and find no room."""
        return _haloed(self._cover, round(_FINE * self.halo[1]), (self.ink, self.halo[0]))

    def draw(
        self, surface: pygame.Surface, middle: complex, shown: float = 1.0, *, whole: bool = False
    ) -> None:
        """Draw the words about a place in pixels, as strongly as 0 (not at all) to 1 says.

        They begin at a whole pixel where that is wanted, which draws many new places faster.
        """
        if not self._meets(surface.get_size(), middle):
            return
        wide, high = (_FINE * side for side in self.size)
        step = _FINE if whole else 1
        x = step * round((_FINE * middle.real - wide / 2) / step)
        y = step * round((_FINE * middle.imag - high / 2) / step)
        sprite = self._sprite(x % _FINE, y % _FINE)
        if sprite.get_alpha() != round(255 * shown):
            sprite.set_alpha(round(255 * shown))
        surface.blit(sprite, (x // _FINE, y // _FINE))

    def _meets(self, size: tuple[int, int], middle: complex) -> bool:
        """Whether the words about a place are seen on a surface so large, to a pixel."""
        (wide, high), (x, y) = self.size, (middle.real, middle.imag)
        return -1 - wide / 2 < x < size[0] + 1 + wide / 2 and -1 - high / 2 < y < size[1] + 1 + high / 2

    def _sprite(self, right: int, down: int) -> pygame.Surface:
        """Return the words so many parts of a pixel further right and down."""
        if (right, down) not in self._drawn:
            wide, high = self.size
            size = ceil(wide + right / _FINE), ceil(high + down / _FINE)
            self._drawn[right, down] = _averaged(self._parts, (right, down), size)
        return self._drawn[right, down]


def _letters(text: str, kind: Type, size: int) -> tuple[NDArray[np.uint8], int]:
    """Return how far a large line of text covers (height, width), 0 to 255, without empty rows.

    Also how many rows of the line are left out above it.
    """
    large = _FINE * size
    sheet = offscreen((kind.width(text, large, strong=True) + _FINE, 2 * large), alpha=True)
    kind.draw(sheet, text, (_FINE // 2, large // 2), size=large, colour=(255, 255, 255), strong=True)
    cover = np.frombuffer(pixel_view(sheet), np.uint8)[3::4].reshape(2 * large, -1)
    rows = np.flatnonzero(cover.any(axis=1))
    first, last = (int(rows[0]), int(rows[-1])) if rows.size else (0, 0)
    return cover[first : last + 1].copy(), first - large // 2


def _haloed(cover: NDArray[np.uint8], halo: int, colours: tuple[Colour, Colour]) -> NDArray[np.float32]:
    """Return letters in ink on a halo, in colours times opacity and opacity, 0 to 1, with nothing about.

    They are parted by row and column within a pixel: (`_FINE`, `_FINE`, 4, height, width) in pixels, so that
    an average is made of whole arrays, however far the line is shifted.
    """
    begin, (high, wide) = _FINE + halo + 1, cover.shape
    room = tuple(-(-(side + 2 * begin + _FINE) // _FINE) * _FINE for side in cover.shape)
    letters = np.zeros(room, np.uint8)
    letters[begin : begin + high, begin : begin + wide] = cover
    around = letters.copy()
    # what is empty about them lets whole rows be shifted at once, as they lie in memory
    first, end = begin * room[1], (begin + high) * room[1]
    inked, flat = letters.ravel()[first:end], around.ravel()
    ring = np.rint(halo * _RING)
    for aside in (ring.imag * room[1] + ring.real).astype(int).tolist():
        under = flat[first + aside : end + aside]
        np.maximum(under, inked, out=under)
    share, opacity = (
        levels.reshape(-1, _FINE, room[1] // _FINE, _FINE).transpose(1, 3, 0, 2).astype(np.float32, order="C")
        / 255
        for levels in (letters, around)
    )
    rest = opacity - share
    parts = np.empty((_FINE, _FINE, 4, *share.shape[2:]), np.float32)
    for n, (ink, back) in enumerate(zip(*colours, strict=True)):
        mixed = np.multiply(share, np.float32(ink / 255), out=parts[:, :, n])
        mixed += rest * np.float32(back / 255)
    parts[:, :, 3] = opacity
    return parts


def _averaged(parts: NDArray[np.float32], shift: tuple[int, int], size: tuple[int, int]) -> pygame.Surface:
    """Return a line in pixels, shifted by parts of one right and down."""
    (right, down), (width, height) = shift, size
    small = np.zeros((4, height, width), np.float32)
    for row, column in product(range(_FINE), repeat=2):
        top, left = (_FINE + row - down) // _FINE, (_FINE + column - right) // _FINE
        part = parts[(row - down) % _FINE, (column - right) % _FINE]
        small += part[:, top : top + height, left : left + width]
    small /= _FINE**2
    small[:3] /= np.maximum(small[3], 1e-6)
    levels = (255 * small + 0.5).astype(np.uint8)
    # in the order of a surface's bytes, which blits many times faster
    return pygame.image.frombuffer(levels[[2, 1, 0, 3]].transpose(1, 2, 0).tobytes(), size, "BGRA")
