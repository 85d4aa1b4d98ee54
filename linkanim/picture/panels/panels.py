"""What lies over the picture: the help, the edit list, a toast, the marks of pause and recording."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import ceil
from typing import Any

import numpy as np
import pygame

from linkanim.picture.panels.board import Board
from linkanim.picture.panels.chips import chip, edges, hint_bar, off_words, put, sentence, toast
from linkanim.picture.panels.edit_list import edit_list, edit_rows
from linkanim.picture.panels.game_panel import answer_rows, game_panel
from linkanim.picture.panels.help_sheet import help_sheet
from linkanim.picture.panels.overlay import Overlay
from linkanim.picture.panels.quantity_list import quantity_list, quantity_rows
from linkanim.picture.raster.raster import Colour, Layer, Loop, paint
from linkanim.picture.raster.shapes import box, disc, stroke
from linkanim.picture.view import Rect

_VEIL = 170
_BACKING = 0.7
"""How little of what lies under a mark shows through its backing."""


@dataclass
class Panels:
    """Draws overlays; the last panel of each kind is kept, so that an open one costs one blit."""

    board: Board
    _kept: dict[Any, tuple[Any, Any]] = field(default_factory=dict)

    def draw(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw what an overlay holds: the help over a game or beside the edit list, a toast at the foot."""
        self._marks(surface, overlay)
        self._list(surface, game_panel, overlay.game)
        if overlay.help:
            surface.blit(self._keep(_veil, self.board.layout.size), (0, 0))
        left = self._list(surface, edit_list, overlay.panel)
        self._list(surface, quantity_list, overlay.quantities)
        if overlay.help:
            room = self.board.layout.size[0] - left
            drawn = self._keep(help_sheet, (overlay.help, room))
            at = (
                left + (room - drawn.get_width()) // 2,
                (self.board.layout.size[1] - drawn.get_height()) // 2,
            )
            surface.blit(drawn, at)
        self._passing(surface, overlay)
        if overlay.toast:
            surface.blit(*self._keep(toast, overlay.toast))

    def _list(self, surface: pygame.Surface, make: Any, shown: object) -> int:
        """Draw a list, if one is open; return how much of the window's left it takes at the top."""
        if shown is None:
            return 0
        drawn = self._keep(make, shown)
        at = self._listed(drawn)
        surface.blit(drawn, at)
        return self.board.margin + drawn.get_width() if at[1] <= self.board.margin else 0

    def row_at(self, overlay: Overlay, x: float, y: float) -> int | None:
        """Return the row of the open list under a pixel, -1 on the list beside them; None off it.

        A game's answers have None beside them.
        """
        for make, rows_of, shown in (
            (game_panel, answer_rows, overlay.game),
            (edit_list, edit_rows, overlay.panel),
            (quantity_list, quantity_rows, overlay.quantities),
        ):
            if shown:
                drawn = self._keep(make, shown)
                left, top = self._listed(drawn)
                if not Rect(left, top, *drawn.get_size()).holds(x, y):
                    return None
                found: int | None = self._keep(rows_of, shown).at(y - top)
                return -1 if found is None and shown is not overlay.game else found
        return None

    def _listed(self, drawn: pygame.Surface) -> tuple[int, int]:
        """Return where a list stands: at the top of its place, or at the window's foot."""
        place, margin = self.board.layout.lists, self.board.margin
        foot = self.board.layout.size[1] - margin - drawn.get_height()
        return round(place.x), max(foot, margin) if place.y > margin else margin

    def _passing(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the chip below the marks, and the hint bar at the bottom, where the HUD is not."""
        room, place = self.board.layout.stage, self.board.layout.marks
        if overlay.chip:
            drawn = self._keep(chip, overlay.chip.text)
            marks = 1.5 * self.board.layout.text_size * (bool(overlay.recording) + overlay.paused)
            left = place.x if self._marks_lead else place.right - drawn.get_width()
            beside = left, place.y + marks
            free = off_words(self.board.layout, drawn, [beside, *edges(self.board, drawn)])
            put(surface, drawn, free or beside, overlay.chip)
        if overlay.watch:
            drawn, at = self._keep(sentence, overlay.watch.text)
            if at:
                put(surface, drawn, at, overlay.watch)
        if overlay.hint:
            words = self._keep(hint_bar, overlay.hint.text)
            at = self.board.layout.hint or room
            if words:
                leads = at.x + at.width / 2 <= room.x + room.width / 2
                left = at.x if leads else at.right - words.get_width()
                put(surface, words, (left, at.bottom - words.get_height()), overlay.hint)

    @property
    def _marks_lead(self) -> bool:
        """Whether the marks stand at the left of the scene's room."""
        place, stage = self.board.layout.marks, self.board.layout.stage
        return place.x - stage.x < stage.right - place.right

    def _keep(self, make: Any, value: Any, slot: object = None) -> Any:
        """Return what is made of a value on the board, kept until another is asked for in the same slot."""
        kept = self._kept.get((make, slot))
        if kept is None or kept[0] != value:
            kept = self._kept[make, slot] = (value, make(self.board, value))
        return kept[1]

    def _marks(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the marks of recording and pause, words and signs."""
        size, place = self.board.layout.text_size, self.board.layout.marks
        leads, top = self._marks_lead, place.y
        for sign, words, colour in (
            (_dot, overlay.recording, self.board.theme.warning),
            (_bars, "paused" if overlay.paused else None, self.board.theme.ink),
            (_wave, overlay.path.off if overlay.path else None, self.board.theme.ink),
        ):
            if words:
                sheet = self._keep(_mark, (sign, words, colour), sign)
                left = place.x - 0.2 * size if leads else place.right - sheet.get_width() + 0.2 * size
                surface.blit(sheet, (round(left), round(top)))
                top += 1.5 * size


def _veil(board: Board, size: tuple[int, int]) -> pygame.Surface:
    """Return what lets the picture recede behind the help."""
    veil = pygame.Surface(size, pygame.SRCALPHA, 32)
    veil.fill((*board.theme.background, _VEIL))
    return veil


def _mark(board: Board, shown: tuple[Callable[[float], list[Loop]], str, Colour]) -> pygame.Surface:
    """Return a sign and words on their backing."""
    (sign, words, colour), size = shown, board.layout.text_size
    wide, high = board.type.width(words, size) + 1.6 * size, 1.15 * size
    sheet = pygame.Surface((ceil(wide), ceil(high)), pygame.SRCALPHA, 32)
    back = complex(wide / 2, high / 2) + box(wide, high, 0.4 * size)
    signs = [complex(0.6 * size, 0.5 * size) + loop for loop in sign(size)]
    paint(sheet, [Layer(board.theme.background, [back], _BACKING), Layer(colour, signs)])
    board.write(sheet, words, (1.4 * size, 0), size=size, colour=colour)
    return sheet


def _dot(size: float) -> list[Loop]:
    return [0.36 * size * disc(1.0)]


def _wave(size: float) -> list[Loop]:
    way = np.linspace(-0.42, 0.42, 16)
    return stroke(size * (way - 0.24j * np.sin(7.5 * way)), 0.16 * size)


def _bars(size: float) -> list[Loop]:
    bar = box(0.22 * size, 0.72 * size)
    return [np.asarray(bar + side * 0.22 * size) for side in (-1, 1)]
