"""Wheels as they were painted: one that looks the same again, some teeth further on, is not painted again."""

from __future__ import annotations

from math import ceil, floor
from typing import NamedTuple

import pygame

from linkanim.picture.backdrop import Backdrop, is_clear, wipe
from linkanim.picture.blend import Words, mix
from linkanim.picture.cells import Ints
from linkanim.picture.parts import Part, Places, placed
from linkanim.picture.raster import paint_noting, pixels_of

_MOST_PICTURES = 4.0
"""No more is kept than so many pictures take; where nothing comes again, that is thrown away in time."""


class Patch(NamedTuple):
    """Pixels of a surface, and what was painted there."""

    place: Ints
    words: Words

    def lay(self, surface: pygame.Surface) -> None:
        """Paint the same again, on a surface that is as the first one was."""
        pixels_of(surface)[self.place] = self.words


class Turned:
    """Parts that turn about fixed joints behind what stands still, before the column and row `ends`."""

    def __init__(self, parts: tuple[Part, ...], ends: tuple[int, int]) -> None:
        self._parts, self._ends = parts, ends
        self._kept: dict[object, Patch] = {}
        self._backdrop: Backdrop | None = None

    def patch(self, canvas: pygame.Surface, backdrop: Backdrop, places: Places) -> Patch:
        """Return how the parts look now, to be laid on a canvas that is as the whole backdrop.

        What is not known yet is painted on the canvas, which is left as it was.
        """
        if backdrop is not self._backdrop:
            self._kept, self._backdrop = {}, backdrop
        alike = (canvas.get_shifts(), *(part.turn(places) for part in self._parts))
        if alike not in self._kept:
            made = self._made(canvas, backdrop, places)
            room = _MOST_PICTURES * backdrop.whole.get_buffer().length
            if (len(self._kept) + 1) * (made.place.nbytes + made.words.nbytes) > room:
                self._kept.clear()
            self._kept[alike] = made
        return self._kept[alike]

    def _made(self, canvas: pygame.Surface, backdrop: Backdrop, places: Places) -> Patch:
        area = self.area(places).clip(canvas.get_rect())
        wipe(canvas, backdrop.behind, area)
        place = paint_noting(canvas, placed(self._parts, places), ends=self._ends)
        if backdrop.front:
            mix(pixels_of(canvas), backdrop.front.within(area, canvas.get_width()), clear=is_clear(canvas))
        made = Patch(place, pixels_of(canvas).take(place))
        wipe(canvas, backdrop.whole, area)
        return made

    def area(self, places: Places) -> pygame.Rect:
        """Return the rectangle that the parts keep to, however they turn."""
        first, *others = (_square(places[part.at], part.reach) for part in self._parts)
        return first.unionall(others)


def _square(middle: complex, reach: float) -> pygame.Rect:
    """Return the whole pixels so far about a place, and one more all round."""
    left, top = floor(middle.real - reach) - 1, floor(middle.imag - reach) - 1
    right, end = ceil(middle.real + reach) + 1, ceil(middle.imag + reach) + 1
    return pygame.Rect(left, top, right - left, end - top)
