"""Wheels as they were painted: one that looks the same again, some teeth further on, is not painted again."""

from __future__ import annotations

import pygame

from linkanim.picture.parts import Part, Places, placed
from linkanim.picture.raster import Patch, patch

_MOST_PICTURES = 4.0
"""No more is kept than so many pictures take; where nothing comes again, that is thrown away in time."""


class Turned:
    """Parts that turn about fixed joints over what stands still, before the column and row `ends`."""

    def __init__(self, parts: tuple[Part, ...], ends: tuple[int, int]) -> None:
        self._parts, self._ends = parts, ends
        self._kept: dict[object, Patch] = {}
        self._still: pygame.Surface | None = None

    def paint(self, canvas: pygame.Surface, still: pygame.Surface, places: Places) -> None:
        """Paint the parts on a canvas that is, where they lie, as the surface that stands still."""
        if still is not self._still:
            self._kept, self._still = {}, still
        alike = (canvas.get_shifts(), *(part.turn(places) for part in self._parts))
        if alike in self._kept:
            self._kept[alike].lay(canvas)
            return
        made = patch(canvas, placed(self._parts, places), ends=self._ends)
        room = _MOST_PICTURES * still.get_buffer().length
        if (len(self._kept) + 1) * (made.place.nbytes + made.words.nbytes) > room:
            self._kept.clear()
        self._kept[alike] = made
