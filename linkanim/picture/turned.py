"""Wheels as they were painted: one that looks the same again, some teeth further on, is not painted again."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, floor
from typing import NamedTuple

import pygame

from linkanim.picture.backdrop import Backdrop
from linkanim.picture.raster.blend import Mix, Words, mix
from linkanim.picture.raster.cells import Ints
from linkanim.picture.raster.parts import Part, Places, placed
from linkanim.picture.raster.raster import Layer, is_clear, paint_noting, pixels_of

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
    """Parts that turn about fixed joints behind what stands still, before the column and row `ends`.

    They stand in sets that never lie over each other, each of which is painted and kept by itself.
    """

    def __init__(self, sets: tuple[tuple[Part, ...], ...], ends: tuple[int, int]) -> None:
        self._sets, self._ends = sets, ends
        self._kept: list[dict[object, Patch]] = []
        self._backdrop: Backdrop | None = None
        self._front: Mix | None = None

    def paint(self, canvas: pygame.Surface, backdrop: Backdrop, places: Places) -> None:
        """Paint the parts on a canvas that is like the whole backdrop, and of the same kind."""
        if backdrop is not self._backdrop:
            self._stand_before(backdrop, places)
        turns = [tuple(part.turn(places) for part in parts) for parts in self._sets]
        known = [kept.get(turn) for kept, turn in zip(self._kept, turns, strict=True)]
        new = [n for n, patch in enumerate(known) if patch is None]
        if new:
            made = self._made(canvas, backdrop, [placed(self._sets[n], places) for n in new])
            for n, patch in zip(new, made, strict=True):
                self._keep(n, turns[n], patch, backdrop)
        for patch in filter(None, known):
            patch.lay(canvas)

    def _stand_before(self, backdrop: Backdrop, places: Places) -> None:
        """Forget what was painted before another backdrop; take what of this one lies over the parts."""
        first, *others = (_square(places[part.at], part.reach) for parts in self._sets for part in parts)
        self._kept, self._backdrop = [{} for _ in self._sets], backdrop
        area, width = first.unionall(others), backdrop.whole.get_width()
        self._front = backdrop.front and backdrop.front.within(area, width)

    def _made(self, canvas: pygame.Surface, backdrop: Backdrop, sets: list[list[Layer]]) -> Iterator[Patch]:
        """Paint sets of layers on the canvas, under what lies over them, and yield what that gives."""
        pixels, front = pixels_of(canvas), self._front
        if front:
            pixels[front.place] = pixels_of(backdrop.behind)[front.place]
        painted = [paint_noting(canvas, layers, ends=self._ends) for layers in sets]
        if front:
            mix(pixels, front, clear=is_clear(canvas))
        return (Patch(place, pixels.take(place)) for place in painted)

    def _keep(self, n: int, turn: object, patch: Patch, backdrop: Backdrop) -> None:
        room, kept = _MOST_PICTURES * backdrop.whole.get_buffer().length, self._kept[n]
        if (len(kept) + 1) * (patch.place.nbytes + patch.words.nbytes) > room:
            kept.clear()
        kept[turn] = patch


def _square(middle: complex, reach: float) -> pygame.Rect:
    """Return the whole pixels so far about a place, and one more all round."""
    left, top = floor(middle.real - reach) - 1, floor(middle.imag - reach) - 1
    right, end = ceil(middle.real + reach) + 1, ceil(middle.imag + reach) + 1
    return pygame.Rect(left, top, right - left, end - top)
