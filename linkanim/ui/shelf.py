"""Draw linkages as small live pictures: the shelf chapter by chapter, and the row of a search's answers."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pygame

from linkanim.errors import LinkanimError
from linkanim.picture.board import Board
from linkanim.picture.items import Target
from linkanim.picture.layout import Layout, layout
from linkanim.picture.look import Look, ThemeName
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Layer, Loop, paint
from linkanim.picture.shapes import box, disc
from linkanim.picture.slider import knob_on_track
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type, hyphened, letters
from linkanim.picture.theme import ORANGE, theme_of
from linkanim.picture.view import Rect
from linkanim.player.browsing import HEADING, NEW, NEW_TITLE, TITLE_LINES, Browsing, Grid, grid
from linkanim.player.state import AnswerRow, Dial, State
from linkanim.scenes import load
from linkanim.scenes.files import opened
from linkanim.scenes.scene import Scene
from linkanim.words import said

if TYPE_CHECKING:
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.guidance import PoseAnswer

# The shelf: all mechanisms as small live pictures with their titles, chapter by chapter, over the window.

_LEAST = 8
"""The least size of a title in pixels; at that size a title without room is cut."""
_CHOSEN_TURNS = 2
_AT_ONCE = 5
"""The others that move at each frame, in turns; the chosen picture moves at every second frame."""
_BESIDE_A_NEW_ONE = 2
"""The number of other pictures that move in a frame in which a new picture is made."""
_PER_SECOND = 60


class Live:
    """A mechanism on the shelf, and its picture at the latest frame that it showed."""

    def __init__(self, picture: Picture) -> None:
        self.picture, self.printer = picture, SurfacePrinter()
        self.turn = -1
        self.printed: pygame.Surface | None = None

    def go(self, turn: int) -> None:
        """Print the picture of a turn."""
        self.turn, self.printed = turn, pygame.Surface(self.picture.size, pygame.SRCALPHA, 32)
        phase = self.picture.figure.clearest + self.picture.scene.linkage.drive.speed * turn / _PER_SECOND
        self.printer.paint(self.printed, self.picture, self.picture.scene.pose(phase))


class ShelfPrinter:
    """Paints the open shelf: frames and titles first, then one visible mechanism a frame; all are cached."""

    def __init__(self) -> None:
        self._made_for: object = None
        self._still: tuple[object, pygame.Surface] | None = None
        self._live: dict[int, Live] = {}
        self._unread: set[int] = set()
        self._read: tuple[int, Scene] | None = None
        self._type = letters()

    def close(self) -> None:
        """Forget what was drawn for a shelf that is no longer open."""
        self._made_for = self._still = None
        self._live, self._unread, self._read = {}, set(), None

    def draw(
        self,
        surface: pygame.Surface,
        shelf: Browsing,
        frame: int,
        theme: ThemeName,
        *,
        still: bool = False,
        edited: frozenset[int] = frozenset(),
    ) -> list[Target]:
        """Draw the shelf instead of the picture, so many frames after it was opened; return its places.

        Each frame after the first adds one mechanism. The pictures rest while `still`; those at the places
        `edited` differ from their files.
        """
        size = surface.get_size()
        made_for = size, theme, shelf.entries, shelf.own
        opens = self._made_for != made_for
        if opens:
            self.close()
            self._made_for = made_for
        board, cells = Board(layout(size), self._type, theme_of(theme)), grid(size, shelf)
        shown = (cells.top, shelf.matches, shelf.typed)
        if self._still is None or self._still[0] != shown:
            self._still = shown, _still(size, board, cells, shelf)
        surface.blit(self._still[1], (0, 0))
        others = _AT_ONCE if opens else self._join(cells, shelf, theme)
        turns = _turns(shelf, cells, frame, still=still)
        for n in _due(self._live, turns, shelf, frame, others):
            self._live[n].go(turns[n])
        surface.set_clip(pygame.Rect(0, 0, size[0], int(cells.room.bottom)))
        for n, cell in cells.cells.items():
            live = self._live.get(n)
            if live and live.printed:
                surface.blit(live.printed, (round(cell.x), round(cell.y)))
            elif n in self._unread:
                at = (cell.middle.real, cell.middle.imag - 0.5 * cells.line)
                board.write(
                    surface,
                    said("cannot be read"),
                    at,
                    size=cells.text,
                    colour=board.theme.warning,
                    anchor="centre",
                )
            _mark(surface, board, cell, chosen=n == shelf.chosen, edited=n in edited)
        surface.set_clip(None)
        _foot(surface, board, cells, shelf, self._live.get(shelf.chosen))
        return cells.targets

    def _join(self, cells: Grid, shelf: Browsing, theme: ThemeName) -> int:
        """Read the next visible mechanism, the chosen one first, or make the picture of the one just read.

        A file that is no scene has no picture. Returns how many others may move in the rest of this frame:
        reading a mechanism may take all of it.
        """
        order = sorted(cells.cells, key=lambda n: n != shelf.chosen)
        n = next((n for n in order if n not in self._live and n not in self._unread and n != NEW), None)
        if n is None:
            return _AT_ONCE
        cell, file = cells.cells[n], shelf.file_at(n)
        size = round(cell.width), round(cell.height - cells.line)
        look = Look(theme=theme, hud=False, background=False)
        try:
            entry = file.name if file else shelf.entries[n]
            if self._read is None or self._read[0] != n:
                self._read = n, _entered(entry, is_file=file is not None)
                return 0
            self._live[n] = Live(Picture(self._read[1], size, look))
        except LinkanimError:
            self._unread.add(n)
        return _BESIDE_A_NEW_ONE


def _entered(entry: str | Scene, *, is_file: bool) -> Scene:
    """Return the scene of an entry: itself, a name's, or a file's; errors as `opened`."""
    if isinstance(entry, Scene):
        return entry
    return opened(Path(entry))[0] if is_file else load(entry)


def _due(live: dict[int, Live], turns: dict[int, int], shelf: Browsing, frame: int, others: int) -> list[int]:
    """Return the places to be painted at this frame: the chosen one, new ones, and `others` whose turn it is.

    Where no others may move, the chosen one does not either.
    """
    if not others:
        return []
    seen = [n for n in turns if n in live]
    first = frame * _AT_ONCE % max(len(seen), 1)
    order = seen[first:] + seen[:first]
    stale = [n for n in order if live[n].turn != turns[n]]
    at_once = [n for n in stale if n == shelf.chosen or live[n].printed is None]
    return at_once + [n for n in stale if n not in at_once][:others]


def _turns(shelf: Browsing, cells: Grid, frame: int, *, still: bool) -> dict[int, int]:
    """Return the frame that each place's picture shows: the places in sight take turns in moving on."""
    usual = ceil(len(cells.cells) / _AT_ONCE)
    every = {n: _CHOSEN_TURNS if n == shelf.chosen else usual for n in cells.cells}
    return {n: 0 if still else max((frame - n) // turns * turns, 0) for n, turns in every.items()}


def _still(size: tuple[int, int], board: Board, cells: Grid, browsing: Browsing) -> pygame.Surface:
    """Return the still part of a shelf: frames, titles, headings, and the typed text."""
    still = pygame.Surface(size, 0, 32)
    still.fill(board.theme.background)
    typed = f"{browsing.typed}_" if browsing.typed else ""
    words, colour = (typed, board.theme.velocity) if typed else (browsing.heading, board.theme.ink)
    text, x, y = cells.text, cells.room.x, 0.7 * cells.text
    board.write(still, words, (x, y), size=text, colour=colour, strong=True)
    count, found_now = len(browsing.entries) + len(browsing.own), sum(n != NEW for n in browsing.matches)
    hint = said("type to filter   {count}", count=count)
    if browsing.typed:
        hint = said("{number} of {count}", number=found_now, count=count)
    board.write(still, hint, (cells.room.right, y), size=text, colour=board.theme.dim, anchor="right")
    if not browsing.matches:
        board.write(still, browsing.nothing, (x, cells.room.y), size=text, colour=board.theme.warning)
    for name, at in cells.headings:
        board.write(still, name, (at.x, at.y), size=round(HEADING * text), strong=True)
    width = max(1.5 * board.layout.unit, 1.0)
    outer, inner = ([frame_of(cell, board, by) for cell in cells.cells.values()] for by in (width, 0.0))
    paint(still, [Layer(board.theme.rule, outer), Layer(board.theme.panel, inner)])
    for n, cell in cells.cells.items():
        if n == NEW:
            paint(still, [Layer(board.theme.dim, _plus(cell, cells.line, board.layout.unit))])
            _title(still, board, said(NEW_TITLE), cell, cells)
            continue
        if file := browsing.file_at(n):
            _title(still, board, file.title, cell, cells, file.written)
            continue
        _title(still, board, browsing.texts(n)[1], cell, cells)
    still.fill(board.theme.background, pygame.Rect(0, int(cells.room.bottom), *size))
    if cells.track:
        paint(still, _scroll_bar(board, cells, cells.track))
    return still


def _scroll_bar(board: Board, cells: Grid, track: Rect) -> list[Layer]:
    """Return the scroll bar, which shows on its track which rows are visible."""
    wide, count, x = 0.34 * cells.text, len(cells.rows), track.middle.real
    begin, end = (track.y + track.height * row / count for row in (cells.seen.start, cells.seen.stop))
    whole, part = (
        complex(x, (top + foot) / 2) + box(wide, foot - top, wide / 2)
        for top, foot in ((track.y, track.bottom), (begin, max(end, begin + 2 * wide)))
    )
    return [Layer(board.theme.rule, [whole]), Layer(board.theme.dim, [part])]


def _plus(cell: Rect, line: float, unit: float) -> list[Loop]:
    """Return a cross in the middle of where a picture would be."""
    middle, reach = cell.middle - 0.5j * line, 0.14 * cell.width
    return [np.asarray(middle + bar) for bar in (box(2 * reach, 5 * unit), box(5 * unit, 2 * reach))]


def _title(
    surface: pygame.Surface, board: Board, title: str, cell: Rect, cells: Grid, below: str = ""
) -> None:
    """Write a title in two lines below its picture, as large as fits; or in one, and `below` under it."""
    room = cell.width - 0.5 * cells.text
    if below:
        middle, foot = cell.x + cell.width / 2, cell.bottom - cells.line + 0.1 * cells.text
        words = board.fitting((title,), cells.text, room)
        board.write(surface, words, (middle, foot), size=cells.text, anchor="centre")
        size = max(round(0.85 * cells.text), _LEAST)
        at_foot = (middle, foot + 1.25 * cells.text)
        board.write(surface, below, at_foot, size=size, colour=board.theme.dim, anchor="centre")
        return
    lines, size = titled(board, title, cells.text, room)
    top = cell.bottom - cells.line + (0.1 + 0.6 * (TITLE_LINES - len(lines))) * cells.text
    for n, line in enumerate(lines):
        at = (cell.x + cell.width / 2, top + 1.15 * cells.text * n + (cells.text - size) / 2)
        board.write(surface, line, at, size=size, anchor="centre")


def titled(board: Board, title: str, text: int, room: float) -> tuple[list[str], int]:
    """Return a title in at most two lines, and the size at which these have room.

    A line ends at a space or a hyphen. Where no readable size has room, the second ends in an ellipsis.
    """
    for size in range(text, _LEAST - 1, -1):
        lines = board.type.wrapped(title, size, room)
        parts = (part for word in title.split() for part in hyphened(word))
        if len(lines) <= TITLE_LINES and board.widest(parts, size) <= room:
            return lines, size
    first, *rest = board.type.wrapped(title, _LEAST, room)
    return [first, *([_cut(board, " ".join(rest), room)] if rest else [])], _LEAST


def _cut(board: Board, words: str, room: float) -> str:
    """Return as many of some words' first letters as have room, with an ellipsis where they are cut."""
    ways = (words, *(f"{words[:n].rstrip()}…" for n in range(len(words) - 1, 0, -1)))
    return next((way for way in ways if board.type.width(way, _LEAST) <= room), "")


def _mark(surface: pygame.Surface, board: Board, cell: Rect, *, chosen: bool, edited: bool) -> None:
    """Frame the chosen place; put a dot on one that is edited."""
    if chosen:
        width = max(3.0 * board.layout.unit, 1.5)
        ring = [frame_of(cell, board, width), frame_of(cell, board, 0.0)[::-1]]
        paint(surface, [Layer(board.theme.velocity, ring)])
    if edited:
        reach = 6 * board.layout.unit
        middle = complex(cell.right - 2.2 * reach, cell.y + 2.2 * reach)
        paint(surface, [Layer(ORANGE, [middle + disc(reach)])])


def _foot(surface: pygame.Surface, board: Board, cells: Grid, shelf: Browsing, live: Live | None) -> None:
    """Write what to watch for of the chosen mechanism at the foot, in two lines at the most."""
    if live is None or shelf.chosen not in shelf.matches:
        return
    text, room = cells.text, cells.room
    for size in range(text, _LEAST - 1, -1):
        lines = board.type.wrapped(said(live.picture.scene.look_at), size, room.width)
        if len(lines) <= TITLE_LINES:
            break
    for n, line in enumerate(lines[:TITLE_LINES]):
        at = (room.x + room.width / 2, room.bottom + (0.35 + 1.2 * n) * text)
        board.write(surface, line, at, size=size, colour=board.theme.dim, anchor="centre")


def frame_of(cell: Rect, board: Board, by: float) -> Loop:
    """Return the outline of a place, `by` pixels larger on every side."""
    middle = complex(cell.x + cell.width / 2, cell.y + cell.height / 2)
    corner = 7 * board.layout.unit
    outline: Loop = middle + box(cell.width + 2 * by, cell.height + 2 * by, corner + by)
    return outline


# A row of small live pictures at the window's foot: the linkages that follow a path, numbered.

_ANSWER_SHAPE = 1.5
"""The width of a picture over its height."""
_TURNS = 6
"""The pictures take turns: each moves on once in this many frames."""
_SMALLEST = 8
"""The least side of a picture, in pixels."""


def row_cells(layout: Layout, count: int) -> tuple[Rect, ...]:
    """Return where the pictures of a row stand, in its middle."""
    if layout.row is None:
        return ()
    room, gap = layout.row, 6 * layout.unit
    wide = min(_ANSWER_SHAPE * room.height, (room.width + gap) / max(count, 1) - gap)
    left = room.x + (room.width - count * (wide + gap) + gap) / 2
    return tuple(Rect(left + n * (wide + gap), room.y, wide, room.height) for n in range(count))


def answers_of(state: State) -> AnswerRow | None:
    """Return the row of answers that a sketch has."""
    return next((row for one in state.modes if (row := one.answer_row(state))), None)


class RowPrinter:
    """Paints rows; each frame makes one more picture, or all `at_once`; they are kept with their answers."""

    def __init__(self, *, at_once: bool = False) -> None:
        self._at_once = at_once
        self._live: dict[int, tuple[object, Live]] = {}
        self._still: tuple[object, pygame.Surface] | None = None
        self._type: Type | None = None

    def draw(
        self, surface: pygame.Surface, layout: Layout, row: AnswerRow | None, frame: int, theme: ThemeName
    ) -> list[Target]:
        """Draw a row over the picture's foot, and return its places; without a row, forget the last one."""
        if row is None or layout.row is None:
            self._live.clear()
            return []
        self._type = self._type or letters()
        board, cells = Board(layout, self._type, theme_of(theme)), row_cells(layout, len(row.entries))
        targets = [Target("answer", cell, n) for n, cell in enumerate(cells)]
        if row.dial and layout.dial:
            targets.append(draw_dial(surface, board, layout.dial, row.dial))
        kind = layout.size, theme, row.names, row.words, row.chosen
        if self._still is None or self._still[0] != kind:
            self._still = kind, _still_answers(board, layout.row, cells, row)
        surface.blit(self._still[1], (round(layout.row.x), round(layout.row.y)))
        for live, cell in self._pictures(row, cells, _lines(row) * layout.small_size, frame, theme):
            assert live.printed
            surface.blit(live.printed, (round(cell.x), round(cell.y)))
        return targets

    def _pictures(
        self, row: AnswerRow, cells: tuple[Rect, ...], line: float, frame: int, theme: ThemeName
    ) -> Iterator[tuple[Live, Rect]]:
        """Yield the pictures of this frame with their places; of those that are missing, make one."""
        making = True
        for n, (entry, cell) in enumerate(zip(row.entries, cells, strict=True)):
            size = round(cell.width), round(cell.height - line)
            made_for = entry, size, theme
            missing = n not in self._live or self._live[n][0] != made_for
            if missing and making and min(size) >= _SMALLEST:
                look = Look(theme=theme, hud=False, background=False)
                self._live[n] = made_for, Live(Picture(_scene(entry, row), size, look))
                making, missing = self._at_once, False
            if not missing:
                live = self._live[n][1]
                turn = 0 if row.still else max((frame - n) // _TURNS * _TURNS, 0)
                if live.printed is None or (live.turn != turn and not row.still):
                    live.go(turn)
                yield live, cell


def _still_answers(board: Board, room: Rect, cells: tuple[Rect, ...], row: AnswerRow) -> pygame.Surface:
    """Return the row without its pictures: their frames, numbers and words."""
    sheet = pygame.Surface((round(room.width), round(room.height)), pygame.SRCALPHA, 32)
    size = board.layout.small_size
    for n, cell in enumerate(cells):
        cell, chosen = cell._replace(x=cell.x - room.x, y=0.0), n == row.chosen
        ink, width = (board.theme.velocity, 2.6) if chosen else (board.theme.rule, 1.4)
        inner = frame_of(cell.inset(width * board.layout.unit), board, 0.0)
        paint(sheet, [Layer(ink, [frame_of(cell, board, 0.0)]), Layer(board.theme.panel, [inner])])
        number, off = f"{n + 1}", row.words[n]
        name = f"{number}   {row.names[n]}" if row.names[n] else number
        lines = (
            ((name, number), (off, off.split(" · ")[0]))
            if any(row.names)
            else ((f"{number}   {off}", off, number),)
        )
        for line, ways in enumerate(lines, start=1 - len(lines)):
            words = board.fitting(ways, size, cell.width - 0.6 * size)
            at = cell.x + cell.width / 2, cell.bottom - (1.45 - 1.1 * line) * size
            board.write(sheet, words, at, size=size, anchor="centre", strong=chosen)
    return sheet


def _lines(row: AnswerRow) -> float:
    """Return how high the words below a picture are, in heights of their text."""
    return 2.45 if any(row.names) else 1.3


def _scene(entry: PathAnswer | PoseAnswer | Scene, row: AnswerRow) -> Scene:
    if isinstance(entry, Scene):
        return entry
    return entry.scene(row.unit, row.poses) if row.poses else entry.scene(row.unit)  # type: ignore[call-arg, arg-type]


_DIAL = 0.34
"""The width of a dial's track, as a share of its room."""
_BESIDE = 0.5
"""How far beyond its track's ends a dial can still be grasped, in heights of its room."""


def dial_track(room: Rect) -> Rect:
    """Return where the track of a dial runs, in the middle of its room."""
    wide = _DIAL * room.width
    return Rect(room.x + (room.width - wide) / 2, room.y, wide, room.height)


def draw_dial(surface: pygame.Surface, board: Board, room: Rect, dial: Dial) -> Target:
    """Draw a dial in its room, its words beside the ends of the track; return where it can be grasped."""
    rail, size, unit = dial_track(room), board.layout.small_size, board.layout.unit
    row, line, radius = rail.y + rail.height / 2, max(1.6 * unit, 1.0), 0.5 * size
    marks = [complex(rail.x + at * rail.width, row) + box(2 * line, 0.6 * size) for at in dial.marks]
    filled = board.theme.velocity if dial.held else board.theme.background
    knob_and_track = knob_on_track(
        complex(rail.x, row), rail.width, dial.value, radius, line, board.theme, filled
    )
    paint(surface, [Layer(board.theme.rule, marks), *knob_and_track])
    top, gap, dim = row - 0.65 * size, radius + 0.7 * size, board.theme.dim
    board.write(surface, dial.low, (rail.x - gap, top), size=size, colour=dim, anchor="right")
    board.write(surface, dial.high, (rail.right + gap, top), size=size, colour=dim)
    reach = _BESIDE * room.height
    return Target("dial", rail._replace(x=rail.x - reach, width=rail.width + 2 * reach), rail)
