"""Draw what lies over the picture for a while: help, lists, words at the foot, marks of state.

The help has as many columns as the window has room for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain
from math import ceil
from typing import Any, NamedTuple

import numpy as np
import pygame

from linkanim.picture.board import Board
from linkanim.picture.game_panel import GamePanel
from linkanim.picture.items import DrawnSheet, Target
from linkanim.picture.layout import CAPTION_STEP
from linkanim.picture.lists import ListPanel, Panel
from linkanim.picture.overlay import Button, Help, Overlay
from linkanim.picture.raster import Colour, Layer, Loop, paint
from linkanim.picture.shapes import box, disc, stroke
from linkanim.picture.view import Rect
from linkanim.words import said, said_as

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


# The help: every key and what it does, by subject, in as many columns as the window has room for.

_STEP = 1.32
_HELP_GAP = 1.1
"""The gap between keys and what they do, in heights of the text; it is twice that between columns."""
_WIDEST = 0.97
"""The greatest share of its room's width that the help takes."""
_LEAST = 9
"""The smallest text that can be read, in pixels."""


class _Line(NamedTuple):
    """A line of a column: a subject, or a key and what it does; an empty line separates subjects.

    It is `of` the keys as the table has them.
    """

    keys: str
    does: str
    heading: bool = False
    of: str = ""


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


def help_sheet(board: Board, shown: tuple[Help, int]) -> DrawnSheet:
    """Return the help, its text as large as fits above the bar of commands in a room of that width.

    Where that would be too small to read, it has the window's height; lines without room there are left out.
    """
    laid, keys, left = _help_laid(board, shown), "", 0.0
    size, sheet = laid.size, board.sheet(laid.wide, laid.high)
    targets = [Target("help", Rect(0, 0, *sheet.get_size()))]
    left = 1.4 * size
    for column in laid.columns:
        wide = column.keys + column.does + _HELP_GAP * size
        for n, line in enumerate(column.lines):
            _draw(board, sheet, column, line, (left, (0.9 + _STEP * n) * size), size)
            keys = line.of or keys  # the text of a line may be broken; only its first part has the keys
            if line.does and not line.heading:
                place = Rect(left, (0.9 + (n - 0.12) * _STEP) * size, wide, _STEP * size)
                targets.append(Target("line", place, keys))
        left += wide + 2 * _HELP_GAP * size
    return DrawnSheet(sheet, tuple(targets))


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
        (
            _Line(said_as("subject", subject).capitalize(), "", heading=True),
            *(_Line(said(keys), said(does), of=keys) for keys, does in lines),
            _Line("", ""),
        )
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
        helped, listed, targets = overlay.help, overlay.listed, list[Target]()
        if isinstance(listed, GamePanel):
            targets += self._list(surface, (listed, overlay.pointed), overlay.shut)
        if helped:
            surface.blit(self._keep(_veil, self.board.layout.size), (0, 0))
        if isinstance(listed, ListPanel):
            targets += self._list(surface, (listed, overlay.pointed), overlay.shut)
        if helped:
            shown = (listed, overlay.pointed) if isinstance(listed, Panel) else None
            targets += self._helped(
                surface, helped, self._width_at_left(self._keep(_drawn, shown)) if shown else 0
            )
        if said := words_at_foot(self.board, overlay):
            drawn, at = self._keep(foot, said)
            surface.blit(drawn, (round(at[0]), round(at[1])))
            if said == (overlay.toast, True):
                targets.append(Target("toast", Rect(*at, *drawn.get_size())))
        return tuple(targets)

    def _helped(self, surface: pygame.Surface, shown: Help, left: int) -> list[Target]:
        """Draw the help, right of a list that takes `left` pixels of the window's left; return its places."""
        wide, whole = self.board.layout.size
        drawn: DrawnSheet = self._keep(help_sheet, (shown, wide - left))
        (broad, high), above = drawn.sheet.get_size(), self.board.layout.above_bar
        top = int((above if high <= above else whole) - high) // 2
        x = left + (wide - left - broad) // 2
        surface.blit(drawn.sheet, (x, top))
        return drawn.at(x, top)

    def _list(self, surface: pygame.Surface, shown: _Pointed, shut: float) -> list[Target]:
        """Draw a list and the row under the mouse, and return its places.

        The share `shut` of it is beyond the left edge, or beyond the foot where it stands there; it is
        clicked where it goes.
        """
        drawn: DrawnSheet = self._keep(_drawn, shown)
        left, top = self._listed(drawn.sheet)
        if top <= self.board.margin:
            surface.blit(drawn.sheet, (left - round(shut * (left + drawn.sheet.get_width())), top))
        else:
            surface.blit(drawn.sheet, (left, top + round(shut * (surface.get_height() - top))))
        return drawn.at(left, top)

    def _width_at_left(self, drawn: DrawnSheet) -> int:
        """Return the width that a list takes at the window's top left."""
        is_at_top = self._listed(drawn.sheet)[1] <= self.board.margin
        return self.board.margin + drawn.sheet.get_width() if is_at_top else 0

    def _listed(self, drawn: pygame.Surface) -> tuple[int, int]:
        """Return where a list stands: at the top of its place, or at the window's foot."""
        lists, margin = self.board.layout.lists, self.board.margin
        foot = self.board.layout.size[1] - margin - drawn.get_height()
        return round(lists.x), max(foot, margin) if lists.y > margin else margin

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


_Pointed = tuple[ListPanel | GamePanel, int | None]
"""A list, and its row under the mouse."""


def _drawn(board: Board, shown: _Pointed) -> DrawnSheet:
    listed, pointed = shown
    return listed.drawn(board, pointed)


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
