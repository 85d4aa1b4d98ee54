"""The shelf: all mechanisms as small live pictures with their names, in a grid over the window."""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

import pygame

from linkanim.picture.board import Board
from linkanim.picture.layout import layout
from linkanim.picture.look import Look
from linkanim.picture.overlay import Shelf
from linkanim.picture.painter import Painter
from linkanim.picture.raster import Layer, paint
from linkanim.picture.shapes import box
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

_SHAPE = 1.6
"""How much wider than high a picture is."""
_TURNS = 3
"""So many frames take turns in moving the pictures."""
_PER_SECOND = 60


class Grid(NamedTuple):
    """Where the pictures stand: the columns, a place's rectangle, and the height of the line below it."""

    columns: int
    cells: tuple[Rect, ...]
    line: float

    def at(self, x: float, y: float) -> int | None:
        """Return the place under a pixel; None between the pictures."""
        return next((n for n, cell in enumerate(self.cells) if cell.holds(x, y)), None)


def grid(size: tuple[int, int], count: int) -> Grid:
    """Return the grid in which so many pictures are largest, their names below them inside their cells."""
    parts = layout(size)
    gap, line = 14 * parts.unit, 1.5 * parts.small_size
    whole = Rect(0, 0, *size).inset(gap)

    def width(columns: int) -> float:
        rows = ceil(count / columns)
        high = (whole.height - (rows - 1) * gap) / rows - line
        return min((whole.width - (columns - 1) * gap) / columns, high * _SHAPE)

    columns = max(range(1, count + 1), key=width)
    wide = max(width(columns), 8.0)
    high, rows = wide / _SHAPE + line, ceil(count / columns)
    left = (size[0] - columns * wide - (columns - 1) * gap) / 2
    top = (size[1] - rows * high - (rows - 1) * gap) / 2
    cells = (
        Rect(left + (n % columns) * (wide + gap), top + (n // columns) * (high + gap), wide, high)
        for n in range(count)
    )
    return Grid(columns, tuple(cells), line)


class ShelfPainter:
    """Paints the open shelf; the painters of its pictures are made one a frame, and kept while it is open."""

    def __init__(self) -> None:
        self._made_for: object = None
        self._framed: tuple[object, pygame.Surface] | None = None
        self._painters: dict[int, Painter] = {}
        self._pictures: dict[int, tuple[int, pygame.Surface]] = {}
        self._type = Type()

    def draw(self, surface: pygame.Surface, shelf: Shelf) -> None:
        """Draw the shelf instead of the picture, as many mechanisms as there has been a frame for."""
        size = surface.get_size()
        made_for = (size, shelf.theme, tuple(map(id, shelf.scenes)))
        if self._made_for != made_for:
            self._made_for, self._framed, self._painters, self._pictures = made_for, None, {}, {}
        found = grid(size, len(shelf.scenes))
        surface.blit(self._frames(size, found, shelf), (0, 0))
        for n in range(min(shelf.frame + 1, len(shelf.scenes))):
            cell = found.cells[n]
            picture = self._picture(shelf, n, (round(cell.width), round(cell.height - found.line)))
            surface.blit(picture, (round(cell.x), round(cell.y)))

    def _frames(self, size: tuple[int, int], found: Grid, shelf: Shelf) -> pygame.Surface:
        """Return the frames and names, which stand still while the same mechanism is chosen."""
        if self._framed is None or self._framed[0] != shelf.chosen:
            board = Board(layout(size), self._type, theme_of(shelf.theme))
            sheet = pygame.Surface(size, 0, 32)
            sheet.fill(board.theme.background)
            for n, cell in enumerate(found.cells):
                _frame(sheet, board, cell, chosen=n == shelf.chosen)
                _name(sheet, board, shelf.scenes[n], cell, found.line)
            self._framed = shelf.chosen, sheet
        return self._framed[1]

    def _picture(self, shelf: Shelf, n: int, size: tuple[int, int]) -> pygame.Surface:
        """Return the live picture of a place; the places take turns in moving on."""
        turn = 0 if shelf.still else (shelf.frame - n) // _TURNS * _TURNS
        if n not in self._pictures or self._pictures[n][0] != turn:
            scene = shelf.scenes[n]
            if n not in self._painters:
                self._painters[n] = Painter(scene, size, Look(theme=shelf.theme, hud=False, background=False))
            surface = pygame.Surface(size, pygame.SRCALPHA, 32)
            self._painters[n].paint(surface, scene.pose(scene.linkage.drive.speed * turn / _PER_SECOND))
            self._pictures[n] = turn, surface
        return self._pictures[n][1]


def _frame(sheet: pygame.Surface, board: Board, cell: Rect, *, chosen: bool) -> None:
    """Draw the frame of a place, that of the chosen one wider and in colour."""
    width = max((3.0 if chosen else 1.5) * board.layout.unit, 1.0)
    corner, middle = 8 * board.layout.unit, complex(cell.x + cell.width / 2, cell.y + cell.height / 2)
    outer = middle + box(cell.width + 2 * width, cell.height + 2 * width, corner)
    inner = middle + box(cell.width, cell.height, corner - width)
    colour = board.theme.velocity if chosen else board.theme.rule
    paint(sheet, [Layer(colour, [outer]), Layer(board.theme.panel, [inner])])


def _name(sheet: pygame.Surface, board: Board, scene: Scene, cell: Rect, line: float) -> None:
    """Write a scene's title below its picture, or its name, or as much of that as there is room for."""
    size = board.layout.small_size
    words = board.fitting((scene.title, scene.name), size, cell.width - 0.6 * size)
    at = (cell.x + cell.width / 2, cell.bottom - line + 0.15 * size)
    board.write(sheet, words, at, size=size, anchor="centre")
