"""Draw what lies over the picture for a while: help, edit list, list of quantities, chips, marks of state.

The help has as many columns as the window has room for. Chips are words that come and go.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from itertools import chain, product
from math import ceil, floor
from typing import Any

import numpy as np
import pygame

from linkanim.frozen import NamedTuple, frozen
from linkanim.picture.board import STEP, Board, Rows, around
from linkanim.picture.command_bar import bar_place, bar_places
from linkanim.picture.game_panel import answer_rows, game_panel
from linkanim.picture.layout import Layout, chip_places
from linkanim.picture.overlay import Fading, Help, Overlay, Panel, Quantities
from linkanim.picture.raster import Colour, Layer, Loop, paint
from linkanim.picture.shapes import box, disc, stroke
from linkanim.picture.theme import ORANGE, mixed
from linkanim.picture.view import Rect
from linkanim.steps import at_once

# Words that come and go, and their places: a chip that answers a key, the keys to press, sentences.

_GAP = "   ·   "
_LITTLE = 0.12
"""A sentence that takes a greater share of the stage's height is shown only where nothing is drawn."""


Clear = Callable[[tuple[Rect, ...]], tuple[bool, ...]]
"""Tells for each place whether nothing is drawn there."""

_BESIDE = 0.3
"""The least gap between a chip and other words, in heights of its text."""


def chip(board: Board, text: str) -> pygame.Surface:
    """Return a chip: words on a small sheet."""
    size = board.layout.text_size
    sheet = board.sheet(board.type.width(text, size, strong=True) + 1.6 * size, 1.7 * size)
    board.write(sheet, text, (sheet.get_width() / 2, 0.35 * size), size=size, anchor="centre", strong=True)
    return sheet


def hint_bar(board: Board, text: str) -> pygame.Surface | None:
    """Return the hint bar with as many of its last parts as fit; None where none does."""
    size, parts = board.layout.small_size, text.split(" · ")
    place = board.layout.hint or board.layout.stage
    room = place.width - 2 * size
    while parts and board.type.width(_GAP.join(parts), size) > room:
        parts.pop(0)
    if not parts:
        return None
    words = _GAP.join(parts)
    sheet = board.sheet(board.type.width(words, size) + 2 * size, 1.6 * size)
    board.write(sheet, words, (size, 0.3 * size), size=size, colour=board.theme.dim)
    return sheet


def sentence(board: Board, text: str) -> tuple[pygame.Surface, tuple[float, float] | None]:
    """Return the sentence on what to watch for, and its place off the drawing, or off words; else None."""
    free, stage = board.layout.passing, board.layout.stage
    sheet = _lines(board, text, board.layout.small_size, (free or stage).width + 1, board.theme.dim)
    if free or sheet.get_height() > _LITTLE * stage.height:
        return sheet, (free.x, free.y) if free else None
    return sheet, off_words(board.layout, sheet, edges(board, sheet))


def toast(board: Board, text: str) -> tuple[pygame.Surface, tuple[float, float]]:
    """Return a toast and its place: where nothing is drawn, else off the words about the scene."""
    layout, small, hint = board.layout, board.layout.small_size, board.layout.hint
    if hint and board.type.width(text, small) + 2 * small <= hint.width:
        sheet = _lines(board, text, small, hint.width)
        return sheet, (hint.x + (hint.width - sheet.get_width()) / 2, hint.bottom - sheet.get_height())
    ways = (layout.text_size, 0.9), (small, 0.9), (small, 0.6), (small, 0.4)
    sheets: list[pygame.Surface] = []
    for size, share in ways:
        sheets.append(_lines(board, text, size, share * layout.stage.width))
        if at := off_words(layout, sheets[-1], edges(board, sheets[-1])):
            return sheets[-1], at
    return sheets[0], next(edges(board, sheets[0]))


def _lines(board: Board, text: str, size: int, room: float, colour: Colour | None = None) -> pygame.Surface:
    """Return words on a sheet, in lines no wider than `room`, in ink unless a colour is given."""
    lines = board.type.wrapped(text, size, room - 2 * size)
    sheet = board.sheet(board.widest(lines, size) + 2 * size, (1.25 * len(lines) + 0.75) * size)
    for n, line in enumerate(lines):
        at = (sheet.get_width() / 2, (0.5 + 1.25 * n) * size)
        board.write(sheet, line, at, size=size, colour=colour, anchor="centre")
    return sheet


def off_words(
    layout: Layout, drawn: pygame.Surface, places: Iterable[tuple[float, float]]
) -> tuple[float, float] | None:
    """Return the first of some places at which a sheet covers no word about the scene; else None."""
    busy = (*layout.words, *([layout.legend] if layout.legend else []))
    size = drawn.get_size()
    return next((at for at in places if not any(Rect(*at, *size).meets(one) for one in busy)), None)


def edges(board: Board, drawn: pygame.Surface) -> Iterator[tuple[float, float]]:
    """Yield places of a sheet along the foot and the head of the scene's room."""
    room = board.layout.stage.inset(board.margin)
    wide, high = room.width - drawn.get_width(), room.height - drawn.get_height()
    for low, right in product((1, 0), (0.5, 1, 0)):
        yield room.x + right * wide, room.y + low * high


def put(surface: pygame.Surface, drawn: pygame.Surface, at: tuple[float, float], shown: Fading) -> None:
    """Blit a drawn surface, its top left corner at a place, with the opacity of `shown`."""
    drawn.set_alpha(round(255 * shown.eighths / 8))
    surface.blit(drawn, (round(at[0]), round(at[1])))


# The list of dimensions: what the linkage is, the values, and why one is refused.

_FRAME = 2.7
"""The height of the list's frame, without its rows and the text above and below them, in lines."""
_FEWEST = 4
"""Where fewer rows than this would be shown, hints and facts are left out."""
_NAME = 4.5
"""The part of a row's name that is shown where its value is too long, in heights of the text."""
_ROWS_IN_STEP = 3
"""The rows that are drawn in one step where a list is drawn beforehand."""
_FLASH = 0.45
"""The share of the flash's colour in the bar behind the facts at its brightest."""


@frozen
class _Division:
    """How the list is divided: its text's size and width, the lines above and below the rows, the rows."""

    size: int
    wide: float
    facts: list[str]
    foot: list[tuple[str, Colour]]
    rows: range

    @property
    def lines(self) -> float:
        """The height of the whole list, in lines."""
        return len(self.facts) + len(self.rows) + len(self.foot) + _FRAME

    @property
    def top(self) -> float:
        """How far down the first row's text begins, in heights of the text."""
        return 0.9 + STEP * (1 + len(self.facts)) + (0.25 if self.facts else 0.0)


def edit_list(board: Board, panel: Panel) -> pygame.Surface:
    """Return the list; where it would not fit at a readable size, only the rows around the chosen one."""
    return at_once(_edit_list_in_steps(board, panel))


def _edit_list_in_steps(board: Board, panel: Panel) -> Generator[None, None, pygame.Surface]:
    parts = _fitting(board, panel)
    yield
    size = parts.size
    sheet = board.sheet(parts.wide, STEP * size * parts.lines)
    yield
    _head(board, sheet, panel, parts)
    top = parts.top
    for k, n in enumerate(parts.rows):
        if k % _ROWS_IN_STEP == 0:
            yield
        _row(board, sheet, panel, n, (top + STEP * k) * size, size)
    for n, (line, colour) in enumerate(parts.foot, start=len(parts.rows)):
        board.write(sheet, line, (1.2 * size, (top + 0.3 + STEP * n) * size), size=size, colour=colour)
    return sheet


def edit_rows(board: Board, panel: Panel) -> Rows:
    """Return where the rows are on the list's sheet."""
    parts = _fitting(board, panel)
    return Rows(parts.rows, (parts.top - (STEP - 1) / 2) * parts.size, STEP * parts.size)


def _fitting(board: Board, panel: Panel) -> _Division:
    """Return the largest text at which all fits; else the smallest, without the hint, then without facts."""
    sizes = range(board.layout.text_size, board.layout.small_size - 1, -1)
    for size in (size for size in sizes if len(panel.rows) <= _room(board, size)):
        parts = _divided(board, panel, size, (panel.facts, panel.hint))
        if len(parts.rows) == len(panel.rows) and _needed(board, panel, size) <= parts.wide:
            return parts
    for more in ((panel.facts, panel.hint), (panel.facts, ""), ((), "")):
        parts = _divided(board, panel, sizes[-1], more)
        if len(parts.rows) >= min(_FEWEST, len(panel.rows)):
            break
    return parts


def _divided(board: Board, panel: Panel, size: int, more: tuple[tuple[str, ...], str]) -> _Division:
    facts, hint = more
    wide = board.layout.lists.width
    room = wide - 2.4 * size
    lines = [line for fact in facts for line in board.type.wrapped(fact, size, room)]
    foot = [(line, board.theme.warning) for line in board.type.wrapped(panel.error or "", size, room)]
    foot += [(line, board.theme.dim) for line in board.type.wrapped(hint, size, room, gap="   ")]
    left = int(_room(board, size) - len(foot) - len(lines))
    return _Division(size, wide, lines, foot, around(len(panel.rows), _chosen(panel) or 0, left))


def _needed(board: Board, panel: Panel, size: int) -> float:
    """Return how wide the list must be for every name to be written in full."""
    columns = zip(*((row.label, row.value) for row in panel.rows), strict=True)
    return sum(board.widest(column, size, strong=True) for column in columns) + 3.9 * size


def _room(board: Board, size: int) -> float:
    """Return how many lines of text have room within the list's frame."""
    return board.layout.lists.height / STEP / size - _FRAME


def _chosen(panel: Panel) -> int | None:
    return next((n for n, row in enumerate(panel.rows) if row.chosen), None)


def _head(board: Board, sheet: pygame.Surface, panel: Panel, parts: _Division) -> None:
    """Draw the title, the number of the chosen row, and the facts, lit up while they flash."""
    size, chosen = parts.size, _chosen(panel)
    count = "" if chosen is None or not panel.counted else f"{chosen + 1} of {len(panel.rows)}"
    board.head(sheet, size, panel.title, count, board.theme.ink)
    if panel.flash > 0.0 and parts.facts:
        lit = mixed(board.theme.panel, ORANGE, _FLASH * panel.flash)
        board.bar(sheet, (0.8 + STEP) * size, size, lit, lines=len(parts.facts))
    for n, line in enumerate(parts.facts, start=1):
        board.write(sheet, line, (1.2 * size, (0.8 + STEP * n) * size), size=size)


def _row(board: Board, sheet: pygame.Surface, panel: Panel, n: int, y: float, size: int) -> None:
    row, behind = panel.rows[n], board.behind(n, _chosen(panel), panel.pointed)
    if behind:
        board.bar(sheet, y, size, behind)
    at, colour = (sheet.get_width() - 1.2 * size, y), board.theme.velocity if row.draft else board.theme.ink
    name = min(board.type.width(row.label, size), _NAME * size)
    value = board.ending(row.value, size, at[0] - name - 2.0 * size)
    room = at[0] - board.type.width(value, size, strong=True) - 2.0 * size
    label = board.fitting((row.label,), size, room)
    board.write(sheet, label, (1.2 * size, y), size=size, colour=board.theme.dim)
    board.write(sheet, value, at, size=size, colour=colour, anchor="right", strong=True)


# The help: every key and what it does, by subject, in as many columns as the window has room for.

_STEP = 1.32
_HELP_GAP = 1.1
"""The gap between keys and what they do, in heights of the text; it is twice that between columns."""
_WIDEST = 0.97
"""The greatest share of its room's width that the help takes."""
_LEAST = 9
"""The smallest text that can be read, in pixels."""
_LINES_IN_STEP = 4
"""The lines that are drawn in one step where the help is drawn beforehand."""


class _Line(NamedTuple):
    """A line of a column: a subject, or a key and what it does; an empty line separates subjects."""

    keys: str
    does: str
    heading: bool = False


class _Column(NamedTuple):
    lines: tuple[_Line, ...]
    keys: float
    """How wide its keys are."""
    does: float


class _Laid(NamedTuple):
    """The columns at one text size, and how large a sheet they need."""

    size: int
    columns: list[_Column]
    wide: float
    high: float


def help_sheet(board: Board, shown: tuple[Help, int]) -> pygame.Surface:
    """Return the help, its text as large as fits above the bar of commands in a room of that width.

    Where that would be too small to read, it has the window's height; lines without room there are left out.
    """
    return at_once(_help_in_steps(board, shown))


def _help_in_steps(board: Board, shown: tuple[Help, int]) -> Generator[None, None, pygame.Surface]:
    laid = yield from _help_laid(board, shown)
    yield
    sheet = board.sheet(laid.wide, laid.high)
    yield
    for column, x in _help_columns(laid):
        for n, line in enumerate(column.lines):
            if n % _LINES_IN_STEP == 0:
                yield
            _draw(board, sheet, column, line, (x, (0.9 + _STEP * n) * laid.size), laid.size)
    return sheet


def help_line_at(board: Board, shown: tuple[Help, int], x: float, y: float) -> str | None:
    """Return the keys of the line at a place of the help's sheet; None where there is none."""
    laid = at_once(_help_laid(board, shown))
    number = floor((y / laid.size - 0.9) / _STEP + 0.12)
    for column, left in _help_columns(laid):
        inside = left <= x <= left + column.keys + column.does + _HELP_GAP * laid.size
        if inside and 0 <= number < len(column.lines) and not column.lines[number].heading:
            # the text of keys may be broken into lines; only the first of these has the keys
            whole = (line.keys for line in reversed(column.lines[: number + 1]) if line.keys)
            return next(whole, None) if column.lines[number].does else None
    return None


def _help_laid(board: Board, shown: tuple[Help, int]) -> Generator[None, None, _Laid]:
    groups, room = shown
    wide, (above, whole) = _WIDEST * room, (board.layout.above_bar, board.layout.size[1])
    ways = [(above, _ways(board, groups, wide)), (whole, _ways(board, groups, wide))]
    ways.append((whole, (_laid(board, groups[:n], _LEAST, wide) for n in range(len(groups) - 1, 0, -1))))
    for high, every in ways:
        for laid in every:
            if laid.wide <= wide + 1 and laid.high <= _WIDEST * high:
                return laid
            yield
    return laid


def _help_columns(laid: _Laid) -> Iterator[tuple[_Column, float]]:
    """Yield the columns, each with its left edge."""
    x = 1.4 * laid.size
    for column in laid.columns:
        yield column, x
        x += column.keys + column.does + 3 * _HELP_GAP * laid.size


def _ways(board: Board, groups: Help, room: float) -> Iterator[_Laid]:
    """Yield all subjects at every size, smaller ones broken into lines."""
    largest, small = board.layout.text_size, board.layout.small_size
    for size in range(largest, small - 1, -1):
        yield _laid(board, groups, size)
    for size in range(small, _LEAST - 1, -1):
        yield _laid(board, groups, size)
        yield _laid(board, groups, size, room)


def _laid(board: Board, groups: Help, size: int, room: float | None = None) -> _Laid:
    """Return the columns at a size, no wider than a room together where one is given."""
    parts = _two_columns(groups)
    gaps = (_HELP_GAP * (3 * len(parts) - 2) + 2.8) * size
    each = None if room is None else (room - gaps) / len(parts)
    columns = [_measured(board, lines, size, each) for lines in parts]
    wide = sum(column.keys + column.does for column in columns) + gaps
    high = (_STEP * max(len(column.lines) for column in columns) + 1.6) * size
    return _Laid(size, columns, wide, high)


def _two_columns(groups: Help) -> list[tuple[_Line, ...]]:
    """Return the lines of two columns of whole subjects, as equal as possible; of one column for one subject.

    An empty line is below each subject except the last of a column.
    """
    blocks = [
        (_Line(subject.capitalize(), "", heading=True), *(_Line(*line) for line in lines), _Line("", ""))
        for subject, lines in groups
    ]
    if len(blocks) == 1:
        return [blocks[0][1:-1]]
    high = [len(block) - 1 for block in blocks]
    cut = min(range(1, len(blocks)), key=lambda n: max(sum(high[:n]), sum(high[n:])))
    return [tuple(chain.from_iterable(part))[:-1] for part in (blocks[:cut], blocks[cut:])]


def _measured(board: Board, lines: tuple[_Line, ...], size: int, room: float | None) -> _Column:
    keys = board.widest((line.keys for line in lines if not line.heading), size, strong=True)
    if room is not None:
        lines = tuple(part for line in lines for part in _broken(board, line, size, room - keys))
    return _Column(lines, keys, board.widest((line.does for line in lines), size))


def _broken(board: Board, line: _Line, size: int, room: float) -> Iterator[_Line]:
    """Yield a line as several where its text is wider than a room."""
    first, *rest = board.type.wrapped(line.does, size, max(room, 6.0 * size)) or [""]
    yield line._replace(does=first)
    yield from (_Line("", more) for more in rest)


def _draw(
    board: Board,
    sheet: pygame.Surface,
    column: _Column,
    line: _Line,
    at: tuple[float, float],
    size: int,
) -> None:
    colour = board.theme.velocity if line.heading else board.theme.ink
    board.write(sheet, line.keys, at, size=size, colour=colour, strong=True)
    beside = at[0] + column.keys + _HELP_GAP * size, at[1]
    board.write(sheet, line.does, beside, size=size, colour=board.theme.dim)


# The list of quantities: their words and symbols, the text typed to filter them, the chosen one.

_QUANTITY_FRAME = 2.6
"""The height of the list's frame, without its rows and hint, in lines."""
_BOX = 2.5
"""Where the words of rows with boxes begin, in heights of their text."""


def quantity_list(board: Board, shown: Quantities) -> pygame.Surface:
    """Return the list, as many rows around the chosen one as the window has room for."""
    return at_once(_quantity_list_in_steps(board, shown))


def _quantity_list_in_steps(board: Board, shown: Quantities) -> Generator[None, None, pygame.Surface]:
    size, wide = board.layout.small_size, board.layout.lists.width
    rows, hint = _rows_and_hint(board, shown)
    lines = max(len(rows), 1) + len(hint) + _QUANTITY_FRAME
    sheet = board.sheet(wide, STEP * size * lines)
    count = f"{shown.chosen + 1} of {len(shown.rows)}" if shown.rows else "0"
    typed = (f"{shown.sieve}_", board.theme.velocity) if shown.sieve else (shown.title, board.theme.ink)
    board.head(sheet, size, typed[0], count, typed[1])
    places = [(row, (0.9 + STEP * (n + 1)) * size) for n, row in enumerate(rows)]
    for row, y in places:
        if behind := board.behind(row, shown.chosen, shown.pointed):
            board.bar(sheet, y, size, behind)
    if shown.boxes:
        _boxes(board, sheet, [(y, shown.boxes[row]) for row, y in places], size)
    for k, (row, y) in enumerate(places):
        if k % _ROWS_IN_STEP == 0:
            yield
        _quantity_row(board, sheet, shown, row, size, y)
    if not shown.rows:
        at = (1.2 * size, (0.9 + STEP) * size)
        board.write(sheet, "no name contains that", at, size=size, colour=board.theme.warning)
    for n, line in enumerate(hint, start=max(len(rows), 1) + 1):
        at = (1.2 * size, (1.1 + STEP * n) * size)
        board.write(sheet, line, at, size=size, colour=board.theme.dim)
    if track := scroll_track(board, shown):
        _scroll_bar(board, sheet, track, rows, len(shown.rows))
    return sheet


def scroll_track(board: Board, shown: Quantities) -> Rect | None:
    """Return the track of a list's scroll bar on its sheet; None where all rows are visible."""
    size, (rows, _) = board.layout.small_size, _rows_and_hint(board, shown)
    if len(rows) == len(shown.rows):
        return None
    wide = 1.4 * size
    top = (0.9 + 0.5 * (STEP + 1)) * size
    return Rect(round(board.layout.lists.width) - wide, top, wide, STEP * size * len(rows))


def _scroll_bar(board: Board, sheet: pygame.Surface, track: Rect, rows: range, count: int) -> None:
    """Draw the scroll bar, which shows the part of a list's rows that is visible."""
    wide, x = 0.32 * board.layout.small_size, track.x + 0.6 * track.width
    begin, end = (track.y + track.height * row / count for row in (rows.start, rows.stop))
    whole, part = (
        complex(x, (top + foot) / 2) + box(wide, foot - top, wide / 2)
        for top, foot in ((track.y, track.bottom), (begin, max(end, begin + 2 * wide)))
    )
    paint(sheet, [Layer(board.theme.rule, [whole]), Layer(board.theme.dim, [part])])


def quantity_rows(board: Board, shown: Quantities) -> Rows:
    """Return where the rows are on the list's sheet."""
    size = board.layout.small_size
    return Rows(_rows_and_hint(board, shown)[0], (0.9 + 0.5 * (STEP + 1)) * size, STEP * size)


def _rows_and_hint(board: Board, shown: Quantities) -> tuple[range, list[str]]:
    """Return which rows there is room for, and the lines of the hint, if there is room for it."""
    size, place = board.layout.small_size, board.layout.lists
    hint = board.type.wrapped(shown.hint, size, place.width - 2.4 * size, gap="   ")
    room = int(place.height / STEP / size - _QUANTITY_FRAME)
    hint = hint if room - len(hint) >= 4 else []
    return around(len(shown.rows), shown.chosen, room - len(hint)), hint


def _quantity_row(
    board: Board, sheet: pygame.Surface, shown: Quantities, row: int, size: int, y: float
) -> None:
    begin = (_BOX if shown.boxes else 1.2) * size
    (words, symbol), room = shown.rows[row], sheet.get_width() - begin - 1.2 * size
    left = room - board.type.width(words, size) - size
    ways = (symbol, symbol.rpartition(" = ")[2])
    symbol = next((text for text in ways if board.type.width(text, size) <= left), "")
    if symbol:
        at = (sheet.get_width() - 1.2 * size, y)
        board.write(sheet, symbol, at, size=size, colour=board.theme.dim, anchor="right")
    board.write(sheet, board.fitting((words,), size, room), (begin, y), size=size)


def _boxes(board: Board, sheet: pygame.Surface, rows: Sequence[tuple[float, bool]], size: int) -> None:
    """Draw a box in each row, ticked or empty, all of them at once."""
    line = max(0.09 * size, 1.0)
    edge, inside = (box(wide, wide, 0.15 * size) for wide in (0.86 * size, 0.86 * size - 2 * line))
    tick = size * np.array([-0.24 + 0.02j, -0.07 + 0.2j, 0.26 - 0.2j])
    ticked, empty = (
        [complex(1.6 * size, y + 0.55 * size) for y, is_ticked in rows if is_ticked is wanted]
        for wanted in (True, False)
    )
    theme, ticks = board.theme, (stroke(at + tick, 0.14 * size) for at in ticked)
    layers = [
        Layer(theme.velocity, [at + edge for at in ticked]),
        Layer(theme.panel, [loop for one in ticks for loop in one]),
        Layer(theme.dim, [at + edge for at in empty]),
        Layer(theme.panel, [at + inside for at in empty]),
    ]
    paint(sheet, [layer for layer in layers if layer.loops])


# What lies over the picture: the help, the edit list, a toast, the marks of pause and recording.

_VEIL = 170
_BACKING = 0.7
"""The opacity of a mark's backing."""


class Panels:
    """Draws overlays; the last panel of each kind is cached, so that an open panel costs one blit."""

    def __init__(self, board: Board) -> None:
        self.board = board
        self._kept: dict[Any, tuple[Any, Any]] = {}

    def draw(self, surface: pygame.Surface, overlay: Overlay, clear: Clear | None = None) -> None:
        """Draw what an overlay holds: the help over a game or beside the edit list, a toast at the foot.

        `clear` tells in which places nothing is drawn; without it this is not known.
        """
        self._marks(surface, overlay)
        self._list(surface, game_panel, overlay.game)
        if overlay.help:
            surface.blit(self._keep(_veil, self.board.layout.size), (0, 0))
        left = self._list(surface, edit_list, overlay.panel)
        self._list(surface, quantity_list, overlay.quantities)
        if overlay.help:
            drawn, place = self._helped(overlay.help, left)
            surface.blit(drawn, (place.x, place.y))
        self._passing(surface, overlay, clear)
        if overlay.toast:
            surface.blit(*self._toasted(overlay, overlay.toast))

    def _helped(self, shown: Help, left: int) -> tuple[pygame.Surface, Rect]:
        """Return the help and its place, right of a list that takes `left` pixels of the window's left."""
        wide, whole = self.board.layout.size
        drawn = self._keep(help_sheet, (shown, wide - left))
        above = self.board.layout.above_bar
        high = above if drawn.get_height() <= above else whole
        at = left + (wide - left - drawn.get_width()) // 2, int(high - drawn.get_height()) // 2
        return drawn, Rect(*at, *drawn.get_size())

    def _toasted(self, overlay: Overlay, text: str) -> tuple[pygame.Surface, tuple[float, float]]:
        drawn, at = self._keep(toast, text)
        return drawn, self._above_bar(overlay, drawn, at)

    def on_toast(self, overlay: Overlay, x: float, y: float) -> bool:
        """Return whether a pixel is on the toast."""
        if not overlay.toast:
            return False
        drawn, at = self._toasted(overlay, overlay.toast)
        return Rect(*at, *drawn.get_size()).holds(x, y)

    def help_at(self, overlay: Overlay, x: float, y: float) -> str | None:
        """Return the keys of the line of the open help under a pixel, "" elsewhere on it; None off it."""
        if not overlay.help:
            return None
        left = 0
        if overlay.panel:
            drawn = self._keep(edit_list, overlay.panel)
            left = self._beside(drawn)
        _, place = self._helped(overlay.help, left)
        if not place.holds(x, y):
            return None
        room = self.board.layout.size[0] - left
        return help_line_at(self.board, (overlay.help, room), x - place.x, y - place.y) or ""

    def prepared(self, overlay: Overlay) -> Iterator[None]:
        """Draw help, lists and chip of an overlay in steps, so that showing them later takes less time."""
        if overlay.help:
            yield from self._ahead(help_sheet, (overlay.help, self.board.layout.size[0]), _help_in_steps)
        if overlay.panel:
            yield from self._ahead(edit_list, overlay.panel, _edit_list_in_steps)
        if overlay.quantities:
            yield from self._ahead(quantity_list, overlay.quantities, _quantity_list_in_steps)
        if overlay.chip:
            yield
            self._keep(chip, overlay.chip.text)

    def _ahead(self, make: Any, shown: Any, steps: Any) -> Iterator[None]:
        """Draw a panel in steps, and cache it as when it is shown."""
        drawn = yield from steps(self.board, shown)
        self._kept[make, None] = shown, drawn

    def _list(self, surface: pygame.Surface, make: Any, shown: object) -> int:
        """Draw a list, if one is open; return the width that it takes at the window's top left."""
        if shown is None:
            return 0
        drawn = self._keep(make, shown)
        surface.blit(drawn, self._listed(drawn))
        return self._beside(drawn)

    def _beside(self, drawn: pygame.Surface) -> int:
        """Return the width that a list takes at the window's top left."""
        return self.board.margin + drawn.get_width() if self._listed(drawn)[1] <= self.board.margin else 0

    def row_at(self, overlay: Overlay, x: float, y: float) -> int | None:
        """Return the row of the open list under a pixel; -1 elsewhere on the list, None off it.

        Between a game's answers it is None.
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

    def is_at_boxes(self, overlay: Overlay, x: float) -> bool:
        """Return whether a pixel is as far left as the boxes of the open list's rows, if these have some."""
        shown = overlay.quantities
        if shown is None or not shown.boxes:
            return False
        left, _ = self._listed(self._keep(quantity_list, shown))
        return x < left + _BOX * self.board.layout.small_size

    def scrolled_at(self, overlay: Overlay, x: float, y: float, *, held: bool) -> int | None:
        """Return the row to which the scroll bar of the open list leads at a pixel; None off the bar.

        While the bar is `held`, places beside it count, too.
        """
        shown = overlay.quantities
        track = scroll_track(self.board, shown) if shown else None
        if shown is None or track is None:
            return None
        left, top = self._listed(self._keep(quantity_list, shown))
        place = track._replace(x=left + track.x, y=top + track.y)
        if not (held or place.holds(x, y)):
            return None
        share = min(max((y - place.y) / place.height, 0.0), 1.0)
        return round(share * (len(shown.rows) - 1))

    def _listed(self, drawn: pygame.Surface) -> tuple[int, int]:
        """Return where a list stands: at the top of its place, or at the window's foot."""
        place, margin = self.board.layout.lists, self.board.margin
        foot = self.board.layout.size[1] - margin - drawn.get_height()
        return round(place.x), max(foot, margin) if place.y > margin else margin

    def _passing(self, surface: pygame.Surface, overlay: Overlay, clear: Clear | None) -> None:
        """Draw the chip, and the hint bar at the bottom, where the HUD is not."""
        room = self.board.layout.stage
        if overlay.chip:
            drawn = self._keep(chip, overlay.chip.text)
            put(surface, drawn, self._chip_place(overlay, drawn, clear), overlay.chip)
        if overlay.watch:
            drawn, at = self._keep(sentence, overlay.watch.text)
            if at:
                put(surface, drawn, self._above_bar(overlay, drawn, at), overlay.watch)
        if overlay.hint:
            words = self._keep(hint_bar, overlay.hint.text)
            at = self.board.layout.hint or room
            if words:
                leads = at.x + at.width / 2 <= room.x + room.width / 2
                left = at.x if leads else at.right - words.get_width()
                free = self._above_bar(overlay, words, (left, at.bottom - words.get_height()))
                put(surface, words, free, overlay.hint)

    def _chip_place(
        self, overlay: Overlay, drawn: pygame.Surface, clear: Clear | None
    ) -> tuple[float, float]:
        """Return where a chip stands: below the marks, or where nothing is drawn; else only off words."""
        layout, places = self.board.layout, tuple(chip_places(self.board.layout, drawn.get_width()))
        if clear and not overlay.is_drawn_on:
            busy, gap = [*layout.words, *self._busy(overlay)], _BESIDE * layout.text_size
            for place, free in zip(places, clear(places), strict=False):
                if free and not any(place.inset(-gap).meets(one) for one in busy):
                    return place.x, place.y
        usual = places[0].x, places[0].y
        return off_words(layout, drawn, [usual, *edges(self.board, drawn)]) or usual

    def _busy(self, overlay: Overlay) -> Iterator[Rect]:
        """Yield where other words and buttons are, besides the rows of words about the scene."""
        layout = self.board.layout
        yield from bar_places(layout, overlay.bar)
        if layout.legend:
            yield layout.legend
        yield layout.marks._replace(height=layout.text_size)
        if overlay.watch and layout.passing:
            yield layout.passing
        if overlay.toast:
            sheet, at = self._toasted(overlay, overlay.toast)
            yield Rect(*at, *sheet.get_size())

    def _above_bar(
        self, overlay: Overlay, drawn: pygame.Surface, at: tuple[float, float]
    ) -> tuple[float, float]:
        """Return the place of words that come and go, moved above the bar of commands where need be."""
        bar = bar_place(self.board.layout, overlay.bar)
        if bar is None or not bar.meets(Rect(*at, *drawn.get_size())):
            return at
        return at[0], max(bar.y - self.board.margin / 2 - drawn.get_height(), 0.0)

    def _keep(self, make: Any, value: Any, slot: object = None) -> Any:
        """Return `make` of the board and a value, cached until the slot is asked for another value."""
        kept = self._kept.get((make, slot))
        if kept is None or kept[0] != value:
            kept = self._kept[make, slot] = (value, make(self.board, value))
        return kept[1]

    def _marks(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the sign of a pause in its corner; those of recording and a stroke, with words, beside it."""
        size, place, theme = self.board.layout.text_size, self.board.layout.marks, self.board.theme
        if overlay.paused:
            sheet = self._keep(_sign, theme.ink)
            surface.blit(sheet, (round(place.right - sheet.get_width()), round(place.y)))
        right, top = place.right - 1.4 * size, place.y
        for sign, words, colour in (
            (_dot, overlay.recording, theme.warning),
            (_wave, overlay.path.off if overlay.path else None, theme.ink),
        ):
            if words:
                sheet = self._keep(_mark, (sign, words, colour), sign)
                surface.blit(sheet, (round(right - sheet.get_width()), round(top)))
                top += 1.5 * size


def _veil(board: Board, size: tuple[int, int]) -> pygame.Surface:
    """Return the veil that makes the picture recede behind the help."""
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


def _sign(board: Board, colour: Colour) -> pygame.Surface:
    """Return the sign of a pause on its backing."""
    side = 1.2 * board.layout.text_size
    sheet = pygame.Surface((ceil(side), ceil(side)), pygame.SRCALPHA, 32)
    middle = complex(side, side) / 2
    signs = [middle + loop for loop in _bars(board.layout.text_size)]
    back = middle + box(side, side, 0.3 * side)
    paint(sheet, [Layer(board.theme.background, [back], _BACKING), Layer(colour, signs)])
    return sheet


def _dot(size: float) -> list[Loop]:
    return [0.36 * size * disc(1.0)]


def _wave(size: float) -> list[Loop]:
    way = np.linspace(-0.42, 0.42, 16)
    return stroke(size * (way - 0.24j * np.sin(7.5 * way)), 0.16 * size)


def _bars(size: float) -> list[Loop]:
    bar = box(0.22 * size, 0.72 * size)
    return [np.asarray(bar + side * 0.22 * size) for side in (-1, 1)]
