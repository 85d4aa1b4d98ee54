"""Draw what lies over the picture for a while: help, lists, words at the foot, marks of state.

The help has as many columns as the window has room for.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
from math import ceil
from typing import Any

import numpy as np
import pygame

from linkanim.frozen import NamedTuple, frozen
from linkanim.picture.board import STEP, Board, Span, around, spans
from linkanim.picture.game_panel import answer_rows, game_panel
from linkanim.picture.items import Target
from linkanim.picture.layout import CAPTION_STEP
from linkanim.picture.overlay import Button, Help, Overlay, Panel, Quantities
from linkanim.picture.raster import Colour, Layer, Loop, paint
from linkanim.picture.shapes import box, disc, stroke
from linkanim.picture.theme import ORANGE, mixed
from linkanim.picture.view import Rect
from linkanim.words import said

# What is said in passing: one sheet of words in the caption's slot.

_SEPARATOR = "   ·   "
_MOST_LINES = 3
"""The most lines of words at the foot: with more they are set smaller."""
_LEAST_FOOT = 9
"""The smallest text at the foot, in pixels."""


def foot(board: Board, said: tuple[str, bool]) -> tuple[pygame.Surface, tuple[float, float]]:
    """Return words on a sheet, and its place: in the middle of the foot, with further lines above that.

    Words that are an answer stand in ink, others are dim.
    """
    (text, is_answer), layout, theme = said, board.layout, board.theme
    slot = layout.caption or layout.stage._replace(y=layout.stage.bottom - 2 * layout.small_size)
    room = slot.width - 2 * layout.margin
    for size in range(layout.small_size, _LEAST_FOOT - 1, -1):
        lines = board.type.wrapped(text, size, room, strong=is_answer)
        if len(lines) <= _MOST_LINES:
            break
    high = max((CAPTION_STEP * len(lines) + 0.2) * size, min(slot.height, 1.6 * size))
    sheet = board.sheet(board.widest(lines, size, strong=is_answer) + 1.6 * size, high)
    top = (high - CAPTION_STEP * len(lines) * size) / 2
    colour = theme.ink if is_answer else theme.dim
    for n, line in enumerate(lines):
        at = sheet.get_width() / 2, top + CAPTION_STEP * size * n
        board.write(sheet, line, at, size=size, colour=colour, anchor="centre", strong=is_answer)
    below = (slot.height - min(slot.height, 1.6 * layout.small_size)) / 2
    return sheet, (slot.x + (slot.width - sheet.get_width()) / 2, slot.bottom - below - high)


def words_at_foot(board: Board, overlay: Overlay) -> tuple[str, bool] | None:
    """Return what is said at the foot, and whether it is an answer.

    The name of the command under the mouse comes first, then a toast, an answer to a key, and hints.
    """
    bar = overlay.bar
    if bar and bar.pointed is not None and bar.pointed >= 0:
        return _tip(bar.buttons[bar.pointed]), False
    if overlay.toast:
        return overlay.toast, True
    if overlay.chip and overlay.chip.eighths > 0:
        return overlay.chip.text, True
    if overlay.hover_text:
        return _SEPARATOR.join(overlay.hover_text.lines), False
    for words in (overlay.watch, overlay.hint):
        if words and words.eighths > 0:
            return _shortened(board, words.text), False
    return None


def _tip(button: Button) -> str:
    """Return a command's name and key, and why it cannot be done."""
    named = f"{button.name}   {button.key}".strip()
    return f"{named}: {button.lack}" if button.lack else named


def _shortened(board: Board, text: str) -> str:
    """Return words without their first parts where they would need more than a line."""
    parts, layout = text.split(" · "), board.layout
    room = (layout.caption or layout.stage).width - 4 * layout.margin
    while len(parts) > 1 and board.type.width(_SEPARATOR.join(parts), layout.small_size) > room:
        parts.pop(0)
    return _SEPARATOR.join(parts)


# The list of dimensions: what the linkage is, the values, and why one is refused.

_FRAME = 2.7
"""The height of the list's frame, without its rows and the text above and below them, in lines."""
_FEWEST = 4
"""Where fewer rows than this would be shown, hints and facts are left out."""
_NAME = 4.5
"""The part of a row's name that is shown where its value is too long, in heights of the text."""
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
    parts = _fitting(board, panel)
    size = parts.size
    sheet = board.sheet(parts.wide, STEP * size * parts.lines)
    _head(board, sheet, panel, parts)
    top = parts.top
    for k, n in enumerate(parts.rows):
        _row(board, sheet, panel, n, (top + STEP * k) * size, size)
    for n, (line, colour) in enumerate(parts.foot, start=len(parts.rows)):
        board.write(sheet, line, (1.2 * size, (top + 0.3 + STEP * n) * size), size=size, colour=colour)
    return sheet


def edit_rows(board: Board, panel: Panel) -> tuple[Span, ...]:
    """Return where the rows are on the list's sheet."""
    parts = _fitting(board, panel)
    return spans(parts.rows, (parts.top - (STEP - 1) / 2) * parts.size, STEP * parts.size)


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
    count = (
        ""
        if chosen is None or not panel.counted
        else said("{number} of {count}", number=chosen + 1, count=len(panel.rows))
    )
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
    laid = _help_laid(board, shown)
    sheet = board.sheet(laid.wide, laid.high)
    for column, x in _help_columns(laid):
        for n, line in enumerate(column.lines):
            _draw(board, sheet, column, line, (x, (0.9 + _STEP * n) * laid.size), laid.size)
    return sheet


def help_lines(board: Board, shown: tuple[Help, int]) -> tuple[Target, ...]:
    """Return the places of the lines on the help's sheet, each with its keys."""
    laid, targets, keys = _help_laid(board, shown), [], ""
    for column, left in _help_columns(laid):
        wide = column.keys + column.does + _HELP_GAP * laid.size
        for n, line in enumerate(column.lines):
            keys = line.keys or keys  # the text of a line may be broken; only its first part has the keys
            if line.does and not line.heading:
                top = (0.9 + (n - 0.12) * _STEP) * laid.size
                targets.append(Target("line", Rect(left, top, wide, _STEP * laid.size), keys))
    return tuple(targets)


def _help_laid(board: Board, shown: tuple[Help, int]) -> _Laid:
    groups, room = shown
    wide, (above, whole) = _WIDEST * room, (board.layout.above_bar, board.layout.size[1])
    ways = [(above, _ways(board, groups, wide)), (whole, _ways(board, groups, wide))]
    ways.append((whole, (_laid(board, groups[:n], _LEAST, wide) for n in range(len(groups) - 1, 0, -1))))
    for high, every in ways:
        for laid in every:
            if laid.wide <= wide + 1 and laid.high <= _WIDEST * high:
                return laid
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
_ABBREVIATED = {
    **{"second ": "2nd ", "kinematic coefficient": "kin. coeff.", " spring:": ":", " damper:": ":"},
    **{"acceleration": "accel.", "angular": "ang.", "tangential": "tang.", "kin. ": ""},
}
"""How words of quantities are abbreviated where room is short, one after the other."""
_NUMBER, _USUAL = r"[−\d.∞]+", "−0.8888"
"""A number in a value, and one as wide as most."""
_GAP = 0.7
"""The gaps between words, symbol and value, in heights of their text."""
_BOX = 2.5
"""Where the words of rows with boxes begin, in heights of their text."""


def quantity_list(board: Board, shown: Quantities) -> pygame.Surface:
    """Return the list, as many rows around the chosen one as the window has room for."""
    size, wide = board.layout.small_size, board.layout.lists.width
    rows, hint = _rows_and_hint(board, shown)
    lines = max(len(rows), 1) + len(hint) + _QUANTITY_FRAME
    sheet = board.sheet(wide, STEP * size * lines)
    count = "0"
    if shown.rows:
        count = said("{number} of {count}", number=shown.chosen + 1, count=len(shown.rows))
    typed = (f"{shown.typed}_", board.theme.velocity) if shown.typed else (shown.title, board.theme.ink)
    board.head(sheet, size, typed[0], count, typed[1])
    places = [(row, (0.9 + STEP * (n + 1)) * size) for n, row in enumerate(rows)]
    for row, y in places:
        if behind := board.behind(row, shown.chosen, shown.pointed):
            board.bar(sheet, y, size, behind)
    if shown.boxes:
        _boxes(board, sheet, [(y, shown.boxes[row]) for row, y in places], size)
    for row, y in places:
        _quantity_row(board, sheet, shown, row, size, y)
    if not shown.rows:
        at = (1.2 * size, (0.9 + STEP) * size)
        board.write(sheet, said("no name contains that"), at, size=size, colour=board.theme.warning)
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


def quantity_rows(board: Board, shown: Quantities) -> tuple[Span, ...]:
    """Return where the rows are on the list's sheet."""
    size = board.layout.small_size
    return spans(_rows_and_hint(board, shown)[0], (0.9 + 0.5 * (STEP + 1)) * size, STEP * size)


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
    """Write a row: its value at the right, the symbol before it, and its words in the room that remains.

    The symbol keeps its place while the value's digits change.
    """
    begin, right = (_BOX if shown.boxes else 1.2) * size, sheet.get_width() - 1.2 * size
    words, told = shown.rows[row]
    symbol, _, value = told.rpartition(" = ")
    taken: float = board.widest((value, re.sub(_NUMBER, _USUAL, value)) if symbol else (value,), size)
    board.write(sheet, value, (right, y), size=size, colour=board.theme.dim, anchor="right")
    if symbol:
        taken += board.type.width(symbol, size) + _GAP * size
        board.write(sheet, symbol, (right - taken, y), size=size, colour=board.theme.dim)
    room = right - begin - (taken + _GAP * size if told else 0.0)
    board.write(sheet, board.fitting([*_shorter(words)], size, room), (begin, y), size=size)


def _shorter(words: str) -> Iterator[str]:
    """Yield a quantity's words, then with more and more of them abbreviated."""
    yield words
    for word, short in _ABBREVIATED.items():
        if word in words:
            words = words.replace(word, short)
            yield words


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


class Panels:
    """Draws overlays; the last panel of each kind is cached, so that an open panel costs one blit."""

    def __init__(self, board: Board) -> None:
        self.board = board
        self._kept: dict[Any, tuple[Any, Any]] = {}

    def draw(self, surface: pygame.Surface, overlay: Overlay) -> tuple[Target, ...]:
        """Draw what an overlay holds, and return where it can be clicked, what lies on top last."""
        self._marks(surface, overlay)
        targets = [*self._list(surface, game_panel, answer_rows, overlay.game, overlay.shut)]
        if overlay.help:
            surface.blit(self._keep(_veil, self.board.layout.size), (0, 0))
        listed = self._list(surface, edit_list, edit_rows, overlay.panel, overlay.shut)
        targets += listed
        targets += self._list(surface, quantity_list, quantity_rows, overlay.quantities, overlay.shut)
        if overlay.help:
            left = self._width_at_left(self._keep(edit_list, overlay.panel)) if overlay.panel else 0
            drawn, place = self._helped(overlay.help, left)
            surface.blit(drawn, (place.x, place.y))
            lines = self._keep(help_lines, (overlay.help, self.board.layout.size[0] - left))
            targets += [Target("help", place), *(one.moved(place.x, place.y) for one in lines)]
        if said := words_at_foot(self.board, overlay):
            drawn, at = self._keep(foot, said)
            surface.blit(drawn, (round(at[0]), round(at[1])))
            if said == (overlay.toast, True):
                targets.append(Target("toast", Rect(*at, *drawn.get_size())))
        return tuple(targets)

    def _helped(self, shown: Help, left: int) -> tuple[pygame.Surface, Rect]:
        """Return the help and its place, right of a list that takes `left` pixels of the window's left."""
        wide, whole = self.board.layout.size
        drawn = self._keep(help_sheet, (shown, wide - left))
        above = self.board.layout.above_bar
        high = above if drawn.get_height() <= above else whole
        at = left + (wide - left - drawn.get_width()) // 2, int(high - drawn.get_height()) // 2
        return drawn, Rect(*at, *drawn.get_size())

    def _list(
        self, surface: pygame.Surface, make: Any, rows_of: Any, shown: Any, shut: float
    ) -> Iterable[Target]:
        """Draw a list, if one is open; return its places: of the list, its rows, its boxes, its scroll bar.

        The share `shut` of it is beyond the left edge, or beyond the foot where it stands there; it is
        clicked where it goes.
        """
        if shown is None:
            return ()
        drawn = self._keep(make, shown)
        left, top = self._listed(drawn)
        wide, high = drawn.get_size()
        if top <= self.board.margin:
            surface.blit(drawn, (left - round(shut * (left + wide)), top))
        else:
            surface.blit(drawn, (left, top + round(shut * (surface.get_height() - top))))
        targets = [] if make is game_panel else [Target("list", Rect(left, top, wide, high))]
        for row, begin, end in self._keep(rows_of, shown):
            targets.append(Target("row", Rect(left, top + begin, wide, end - begin), row))
        if make is quantity_list:
            track = scroll_track(self.board, shown)
            targets += [Target("track", track, len(shown.rows)).moved(left, top)] if track else []
            boxes = Rect(left, top, _BOX * self.board.layout.small_size, high)
            targets += [Target("boxes", boxes)] if shown.boxes else []
        return targets

    def _width_at_left(self, drawn: pygame.Surface) -> int:
        """Return the width that a list takes at the window's top left."""
        return self.board.margin + drawn.get_width() if self._listed(drawn)[1] <= self.board.margin else 0

    def _listed(self, drawn: pygame.Surface) -> tuple[int, int]:
        """Return where a list stands: at the top of its place, or at the window's foot."""
        place, margin = self.board.layout.lists, self.board.margin
        foot = self.board.layout.size[1] - margin - drawn.get_height()
        return round(place.x), max(foot, margin) if place.y > margin else margin

    def _keep(self, make: Any, value: Any, slot: object = None) -> Any:
        """Return `make` of the board and a value, cached until the slot is asked for another value."""
        kept = self._kept.get((make, slot))
        if kept is None or kept[0] != value:
            kept = self._kept[make, slot] = (value, make(self.board, value))
        return kept[1]

    def _marks(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the marks at the right end of the foot: a pause, a recording, how far off a curve is."""
        size, place, theme = self.board.layout.small_size, self.board.layout.marks, self.board.theme
        right, top = place.right, place.middle.imag - 0.6 * size
        if overlay.paused:
            sheet = self._keep(_sign, theme.ink)
            surface.blit(sheet, (round(right - sheet.get_width()), round(top)))
            right -= sheet.get_width() + 0.6 * size
        for sign, words, colour in (
            (_dot, overlay.recording, theme.warning),
            (_wave, overlay.off, theme.ink),
        ):
            if words:
                sheet = self._keep(_mark, (sign, words, colour), sign)
                surface.blit(sheet, (round(right - sheet.get_width()), round(top)))
                right -= sheet.get_width() + 0.6 * size


def _veil(board: Board, size: tuple[int, int]) -> pygame.Surface:
    """Return the veil that makes the picture recede behind the help."""
    veil = pygame.Surface(size, pygame.SRCALPHA, 32)
    veil.fill((*board.theme.background, _VEIL))
    return veil


def _mark(board: Board, shown: tuple[Callable[[float], list[Loop]], str, Colour]) -> pygame.Surface:
    """Return a sign and words beside it."""
    (sign, words, colour), size = shown, board.layout.small_size
    sheet = pygame.Surface(
        (ceil(board.type.width(words, size) + 1.5 * size), ceil(1.2 * size)), pygame.SRCALPHA, 32
    )
    paint(sheet, [Layer(colour, [complex(0.6 * size, 0.55 * size) + loop for loop in sign(size)])])
    board.write(sheet, words, (1.4 * size, 0), size=size, colour=colour)
    return sheet


def _sign(board: Board, colour: Colour) -> pygame.Surface:
    """Return the sign of a pause."""
    side = 1.2 * board.layout.small_size
    sheet = pygame.Surface((ceil(side), ceil(side)), pygame.SRCALPHA, 32)
    signs = [complex(side, side) / 2 + loop for loop in _bars(board.layout.small_size)]
    paint(sheet, [Layer(colour, signs)])
    return sheet


def _dot(size: float) -> list[Loop]:
    return [0.36 * size * disc(1.0)]


def _wave(size: float) -> list[Loop]:
    way = np.linspace(-0.42, 0.42, 16)
    return stroke(size * (way - 0.24j * np.sin(7.5 * way)), 0.16 * size)


def _bars(size: float) -> list[Loop]:
    bar = box(0.22 * size, 0.72 * size)
    return [np.asarray(bar + side * 0.22 * size) for side in (-1, 1)]
