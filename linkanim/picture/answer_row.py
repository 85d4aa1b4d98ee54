"""A row of small live pictures at the window's foot: the linkages that follow a path, numbered."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pygame

from linkanim.picture.layout import Layout
from linkanim.picture.look import Look
from linkanim.picture.panels.board import Board
from linkanim.picture.panels.overlay import AnswerRow
from linkanim.picture.picture import Picture
from linkanim.picture.raster.raster import Layer, paint
from linkanim.picture.shelf import Live, frame_of
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.synthesis.answer import PathAnswer

_SHAPE = 1.5
"""How much wider than high a picture is."""
_TURNS = 6
"""Every picture moves on in so many frames, one after the other."""
_SMALLEST = 8
"""The least side of a picture, in pixels."""


def row_cells(layout: Layout, count: int) -> tuple[Rect, ...]:
    """Return where the pictures of a row stand, in its middle."""
    if layout.row is None:
        return ()
    room, gap = layout.row, 6 * layout.unit
    wide = min(_SHAPE * room.height, (room.width + gap) / max(count, 1) - gap)
    left = room.x + (room.width - count * (wide + gap) + gap) / 2
    return tuple(Rect(left + n * (wide + gap), room.y, wide, room.height) for n in range(count))


class RowPrinter:
    """Paints rows; one picture more is made a frame, or all `at_once`, and kept while its answer is there."""

    def __init__(self, *, at_once: bool = False) -> None:
        self._at_once = at_once
        self._live: dict[int, tuple[object, Live]] = {}
        self._still: tuple[object, pygame.Surface] | None = None
        self._type: Type | None = None

    def draw(self, surface: pygame.Surface, layout: Layout, row: AnswerRow | None) -> None:
        """Draw a row over the picture's foot; without one forget the last."""
        if row is None or layout.row is None:
            self._live.clear()
            return
        self._type = self._type or Type()
        board, cells = Board(layout, self._type, theme_of(row.theme)), row_cells(layout, len(row.entries))
        kind = layout.size, row.theme, row.words, row.chosen
        if self._still is None or self._still[0] != kind:
            self._still = kind, _still(board, layout.row, cells, row)
        surface.blit(self._still[1], (round(layout.row.x), round(layout.row.y)))
        for live, cell in self._shown(row, cells, 1.3 * layout.small_size):
            assert live.printed
            surface.blit(live.printed, (round(cell.x), round(cell.y)))

    def _shown(self, row: AnswerRow, cells: tuple[Rect, ...], line: float) -> Iterator[tuple[Live, Rect]]:
        """Yield the pictures, as of this frame, with their places; of those that are missing make one."""
        making = True
        for n, (entry, cell) in enumerate(zip(row.entries, cells, strict=True)):
            size = round(cell.width), round(cell.height - line)
            made_for = entry, size, row.theme
            missing = n not in self._live or self._live[n][0] != made_for
            if missing and making and min(size) >= _SMALLEST:
                look = Look(theme=row.theme, hud=False, background=False)
                self._live[n] = made_for, Live(Picture(_scene(entry, row.unit), size, look))
                making, missing = self._at_once, False
            if not missing:
                live = self._live[n][1]
                turn = 0 if row.still else max((row.frame - n) // _TURNS * _TURNS, 0)
                if live.printed is None or (live.turn != turn and not row.still):
                    live.go(turn)
                yield live, cell


def _still(board: Board, room: Rect, cells: tuple[Rect, ...], row: AnswerRow) -> pygame.Surface:
    """Return the row without its pictures: their frames, numbers and words."""
    sheet = pygame.Surface((round(room.width), round(room.height)), pygame.SRCALPHA, 32)
    size = board.layout.small_size
    for n, cell in enumerate(cells):
        cell, chosen = cell._replace(x=cell.x - room.x, y=0.0), n == row.chosen
        ink, width = (board.theme.velocity, 2.6) if chosen else (board.theme.rule, 1.4)
        inner = frame_of(cell.inset(width * board.layout.unit), board, 0.0)
        paint(sheet, [Layer(ink, [frame_of(cell, board, 0.0)]), Layer(board.theme.panel, [inner])])
        number, off = f"{n + 1}", row.words[n]
        words = board.fitting((f"{number}   {off}", off, number), size, cell.width - size)
        at = cell.x + cell.width / 2, cell.bottom - 1.45 * size
        board.write(sheet, words, at, size=size, anchor="centre", strong=chosen)
    return sheet


def _scene(entry: PathAnswer | Scene, unit: str) -> Scene:
    return entry if isinstance(entry, Scene) else entry.scene(unit)
