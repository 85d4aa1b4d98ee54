"""The shelf: all mechanisms as small live pictures with their titles, chapter by chapter, over the window."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from math import ceil
from typing import NamedTuple

import pygame

from linkanim.picture.layout import layout
from linkanim.picture.look import Look
from linkanim.picture.panels.board import Board
from linkanim.picture.panels.overlay import Shelf
from linkanim.picture.picture import Picture
from linkanim.picture.raster.raster import Layer, Loop, paint
from linkanim.picture.raster.shapes import box, disc
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text.text import Type, hyphened
from linkanim.picture.theme import ORANGE, theme_of
from linkanim.picture.view import Rect
from linkanim.scenes import chapter_of, load
from linkanim.scenes.scene import Scene

_SHAPE = 1.6
"""How much wider than high a picture is."""
_NAMED = 74
"""The least width of a place that has a title below its picture, in pixels."""
_LEAST = 10
"""The least size of a title in pixels, below which it is cut rather than set smaller."""
_HEADING = 1.2
"""The size of a heading, in that of a title."""
_CHOSEN_TURNS = 2
_AT_ONCE = 5
"""The chosen picture moves at every second frame; of the others so many at each, in turns."""
_PER_SECOND = 60


class Grid(NamedTuple):
    """Where the pictures stand: a rectangle for each, the height of its title, headings, their size."""

    cells: tuple[Rect, ...]
    line: float
    headings: tuple[Rect, ...]
    text: int

    def at(self, x: float, y: float) -> int | None:
        """Return the place under a pixel; None between the pictures."""
        return next((n for n, cell in enumerate(self.cells) if cell.holds(x, y)), None)

    def beside(self, place: int, rows: int) -> int:
        """Return the place nearest to one, so many rows further down; the first row follows the last."""
        tops = sorted({cell.y for cell in self.cells})
        here = self.cells[place]
        top = tops[(tops.index(here.y) + rows) % len(tops)]
        row = [n for n, cell in enumerate(self.cells) if cell.y == top]
        return min(row, key=lambda n: abs(self.cells[n].x - here.x))


def grid(size: tuple[int, int], counts: Sequence[int]) -> Grid:
    """Return the grid in which pictures are largest, so many in each chapter, which begins a row.

    Where they would be too small for titles, they stand without, and without headings.
    """
    parts = layout(size)
    text = max(round(12.5 * parts.unit), 11)
    heading = 1.4 * _HEADING * text if len(counts) > 1 else 0.0
    named = _Shelves(Rect(0, 0, *size).inset(8 * parts.unit), tuple(counts), 2.45 * text, heading)
    if named.width(named.columns) >= _NAMED:
        return named.grid(text)
    foot = Rect(0, 0, size[0], size[1] - 1.6 * text)
    return _Shelves(foot.inset(6 * parts.unit), (sum(counts),), 0.0, 0.0).grid(text)


class _Shelves(NamedTuple):
    """Rows of places in a room; those of a chapter begin below its heading."""

    room: Rect
    counts: tuple[int, ...]
    line: float
    heading: float

    @property
    def gap(self) -> float:
        return max(0.005 * self.room.width, 3.0)

    @property
    def columns(self) -> int:
        """As many columns as make the places largest."""
        return max(range(1, max(self.counts, default=1) + 1), key=self.width)

    def width(self, columns: int) -> float:
        rows = sum(ceil(count / columns) for count in self.counts)
        spent = (rows - 1) * self.gap + len(self.counts) * self.heading
        high = (self.room.height - spent) / max(rows, 1) - self.line
        return min((self.room.width - (columns - 1) * self.gap) / columns, high * _SHAPE)

    def grid(self, text: int) -> Grid:
        wide = max(self.width(self.columns), 8.0)
        cells, headings = zip(*self._laid(wide), strict=True)
        low = max(cell.bottom for row in cells for cell in row)
        right = max(cell.right for row in cells for cell in row)
        x, y = (self.room.right - right) / 2, max(self.room.bottom - low, 0.0) / 2
        moved = [cell._replace(x=cell.x + x, y=cell.y + y) for row in cells for cell in row]
        heads = tuple(head._replace(x=head.x + x, y=head.y + y) for head in headings if self.heading)
        return Grid(tuple(moved), self.line, heads, text)

    def _laid(self, wide: float) -> Iterator[tuple[list[Rect], Rect]]:
        """Yield each chapter's places and its heading."""
        high, top, left, columns = wide / _SHAPE + self.line, self.room.y, self.room.x, self.columns
        for count in self.counts:
            heading = Rect(left, top, self.room.width, 0.9 * self.heading)
            top += self.heading
            yield (
                [
                    Rect(
                        left + n % columns * (wide + self.gap),
                        top + n // columns * (high + self.gap),
                        wide,
                        high,
                    )
                    for n in range(count)
                ],
                heading,
            )
            top += ceil(count / columns) * (high + self.gap)


def by_chapter(entries: Sequence[Scene | str]) -> tuple[tuple[str, int], ...]:
    """Return the chapters of the shelf's mechanisms, in their order, and how many each has."""
    found = (_chapter(entry) for entry in entries)
    return tuple((chapter, len(list(members))) for chapter, members in groupby(found))


def _chapter(entry: Scene | str) -> str:
    return (chapter_of(entry) or "") if isinstance(entry, str) else entry.chapter


@dataclass
class Live:
    """A mechanism on the shelf, and its picture as of a turn."""

    picture: Picture
    printer: SurfacePrinter = field(default_factory=SurfacePrinter)
    turn: int = -1
    printed: pygame.Surface | None = None

    def go(self, turn: int) -> None:
        """Print the picture of a turn."""
        self.turn, self.printed = turn, pygame.Surface(self.picture.size, pygame.SRCALPHA, 32)
        phase = self.picture.figure.clearest + self.picture.scene.linkage.drive.speed * turn / _PER_SECOND
        self.printer.paint(self.printed, self.picture, self.picture.scene.pose(phase))


@dataclass
class _Sheet:
    """What of an open shelf is kept: its places, what stands still, the mechanisms that are there."""

    board: Board
    grid: Grid
    still: pygame.Surface
    live: list[Live] = field(default_factory=list)


class ShelfPrinter:
    """Paints the open shelf; one mechanism is read and drawn a frame, and kept while the shelf is open."""

    def __init__(self) -> None:
        self._made_for: object = None
        self._sheet: _Sheet | None = None
        self._type: Type | None = None

    def close(self) -> None:
        """Forget what was drawn for a shelf that is no longer open."""
        self._made_for = self._sheet = self._type = None

    def draw(self, surface: pygame.Surface, shelf: Shelf) -> None:
        """Draw the shelf instead of the picture, with one mechanism more than before."""
        made_for = (surface.get_size(), shelf.theme, shelf.entries)
        if self._sheet is None or self._made_for != made_for:
            self._type = self._type or Type()
            self._made_for, self._sheet = made_for, _sheet(surface.get_size(), shelf, self._type)
        sheet = self._sheet
        if len(sheet.live) < len(shelf.entries):
            _joined(sheet, shelf)
        surface.blit(sheet.still, (0, 0))
        _marked(surface, sheet, shelf.chosen)
        for n in _due(sheet, shelf):
            sheet.live[n].go(_turn(shelf, n))
        for live, cell in zip(sheet.live, sheet.grid.cells, strict=False):
            if live.printed:
                surface.blit(live.printed, (round(cell.x), round(cell.y)))
        for cell in (sheet.grid.cells[n] for n in shelf.edited):
            reach = 6 * sheet.board.layout.unit
            middle = complex(cell.right - 2.2 * reach, cell.y + 2.2 * reach)
            paint(surface, [Layer(ORANGE, [middle + disc(reach)])])


def _due(sheet: _Sheet, shelf: Shelf) -> list[int]:
    """Return the places to be painted at this frame: the chosen one, new ones, and some whose turn it is."""
    count = len(sheet.live)
    order = [(shelf.frame * _AT_ONCE + n) % count for n in range(count)]
    stale = [n for n in order if sheet.live[n].turn != _turn(shelf, n)]
    at_once = [n for n in stale if n == shelf.chosen or sheet.live[n].printed is None]
    return at_once + [n for n in stale if n not in at_once][:_AT_ONCE]


def _turn(shelf: Shelf, n: int) -> int:
    """Return the frame that a place's picture shows: the places take turns in moving on."""
    turns = _CHOSEN_TURNS if n == shelf.chosen else ceil(len(shelf.entries) / _AT_ONCE)
    return 0 if shelf.still else max((shelf.frame - n) // turns * turns, 0)


def _sheet(size: tuple[int, int], shelf: Shelf, type_: Type) -> _Sheet:
    """Return an empty shelf: its frames and headings."""
    chapters = by_chapter(shelf.entries)
    board, found = Board(layout(size), type_, theme_of(shelf.theme)), grid(size, [n for _, n in chapters])
    still = pygame.Surface(size, 0, 32)
    still.fill(board.theme.background)
    width = max(1.5 * board.layout.unit, 1.0)
    outer, inner = ([frame_of(cell, board, by) for cell in found.cells] for by in (width, 0.0))
    paint(still, [Layer(board.theme.rule, outer), Layer(board.theme.panel, inner)])
    for (chapter, _), at in zip(chapters, found.headings, strict=False):
        words = chapter[:1].upper() + chapter[1:]
        board.write(still, words, (at.x, at.y), size=round(_HEADING * found.text), strong=True)
    return _Sheet(board, found, still)


def _joined(sheet: _Sheet, shelf: Shelf) -> None:
    """Put the next mechanism on the shelf, and its title below its place."""
    entry, cell = shelf.entries[len(sheet.live)], sheet.grid.cells[len(sheet.live)]
    scene = load(entry) if isinstance(entry, str) else entry
    size = round(cell.width), round(cell.height - sheet.grid.line)
    look = Look(theme=shelf.theme, hud=False, background=False)
    sheet.live.append(Live(Picture(scene, size, look)))
    if sheet.grid.line:
        _title(sheet, scene, cell)


def _title(sheet: _Sheet, scene: Scene, cell: Rect) -> None:
    """Write a scene's title in two lines below its picture, or its name, or as much of that as has room."""
    board, text = sheet.board, sheet.grid.text
    lines, size = titled(board, (scene.title, scene.name), text, cell.width - 0.5 * text)
    top = cell.bottom - sheet.grid.line + (0.1 + 0.6 * (2 - len(lines))) * text
    for n, line in enumerate(lines):
        at = (cell.x + cell.width / 2, top + 1.15 * text * n + (text - size) / 2)
        board.write(sheet.still, line, at, size=size, anchor="centre")


def titled(board: Board, names: Sequence[str], text: int, room: float) -> tuple[list[str], int]:
    """Return the first of some names that has room in two lines, and the size at which it has.

    A line ends at a space or a hyphen. A name that would have to be broken inside is set smaller, and where
    that does not help either, as much of the last one's two ends as has room.
    """
    for size in range(text, _LEAST - 1, -1):
        for name in names:
            lines = board.type.wrapped(name, size, room)
            parts = (part for word in name.split() for part in hyphened(word))
            if len(lines) <= 2 and board.widest(parts, size) <= room:
                return lines, size
    return [board.fitting(names, text, room)], text


def _marked(surface: pygame.Surface, sheet: _Sheet, chosen: int) -> None:
    """Frame the chosen place; where there are no titles, write its own at the foot."""
    board, cell = sheet.board, sheet.grid.cells[chosen]
    width = max(3.0 * board.layout.unit, 1.5)
    paint(
        surface,
        [Layer(board.theme.velocity, [frame_of(cell, board, width), frame_of(cell, board, 0.0)[::-1]])],
    )
    if not sheet.grid.line and chosen < len(sheet.live):
        size, text = surface.get_size(), sheet.grid.text
        words = board.fitting((sheet.live[chosen].picture.scene.title,), text, size[0] - text)
        board.write(surface, words, (size[0] / 2, size[1] - 1.5 * text), size=text, anchor="centre")


def frame_of(cell: Rect, board: Board, by: float) -> Loop:
    """Return the outline of a place, so much wider on every side."""
    middle = complex(cell.x + cell.width / 2, cell.y + cell.height / 2)
    corner = 7 * board.layout.unit
    outline: Loop = middle + box(cell.width + 2 * by, cell.height + 2 * by, corner + by)
    return outline
