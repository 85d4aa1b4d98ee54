"""Draw what lies over the picture: help, lists, words at the foot, marks of state, tools, the bar.

`Panels` draws all panels of a state, each as a sheet with the places where it can be clicked. The help has as
many columns as the window has room for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain
from math import ceil
from typing import Any, Literal, NamedTuple

import numpy as np
import pygame

from linkanim.picture.board import Board
from linkanim.picture.game_panel import GamePanel
from linkanim.picture.items import DrawnSheet, Target
from linkanim.picture.layout import CAPTION_STEP, Layout, tool_cells
from linkanim.picture.lists import ListPanel, Panel
from linkanim.picture.raster import Colour, Layer, Loop, paint
from linkanim.picture.shapes import box, disc, stroke
from linkanim.picture.text import letters
from linkanim.picture.theme import Theme, theme_of
from linkanim.picture.view import Rect, on_the_way
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.commands import Button, bar, bar_eighths
from linkanim.player.framing import moves_of
from linkanim.player.state import State
from linkanim.ui.command_bar import CommandBar
from linkanim.ui.pictures import stands
from linkanim.ui.pointing import NOWHERE, AtMouse, hover_words
from linkanim.ui.tools import tool_bar, tooltip
from linkanim.words import said, said_as, to_say

Help = tuple[tuple[str, tuple[tuple[str, str], ...]], ...]
"""Subjects, each with its lines of (key, what it does)."""
_HINT = to_say("Space pause · Tab next · drag any joint · right click: all commands · H keys")
_HINT_FRAMES = 6 * FRAMES_PER_SECOND
_WATCH_FRAMES = 6 * FRAMES_PER_SECOND

Shown = Literal["window", "screenshot", "tape"]
"""Where a state is shown: what comes and goes is in the window alone, a tape has no tools and messages."""

# What is said in passing: one sheet of words in the caption's slot.

_SEPARATOR = "   ·   "
_MOST_LINES = 3
"""The most lines of words at the foot: with more they are set smaller."""
_LEAST_FOOT = 9
"""The smallest text at the foot, in pixels."""


def foot(board: Board, words: tuple[str, str]) -> tuple[pygame.Surface, tuple[float, float]]:
    """Return words on a sheet, and its place: in the middle of the foot, with further lines above that.

    Words that are an "answer" stand in ink, others are dim; a "hint" is shortened to a line.
    """
    (text, kind), layout, theme = words, board.layout, board.theme
    is_answer, text = kind == "answer", shortened(board, text) if kind == "hint" else text
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


def words_at_foot(
    state: State, mouse: AtMouse = NOWHERE, shown: Shown = "window"
) -> tuple[str, Literal["", "answer", "hint"]] | None:
    """Return what is said at the foot, and whether it is an answer or a hint.

    The name of the command under the mouse comes first, then a toast, an answer to a key, and hints.
    """
    buttons = bar(state) if mouse.button is not None and shown == "window" else ()
    if mouse.button is not None and 0 <= mouse.button < len(buttons):
        return _tip(buttons[mouse.button]), ""
    if toast := toast_of(state, shown):
        return toast, "answer"
    if shown != "window":
        return None
    if chip := chip_of(state):
        return chip, "answer"
    if lines := hover_words(state, mouse.pointed):
        return _SEPARATOR.join(lines), ""
    words = watched(state) or hint(state)
    return (words, "hint") if words else None


def toast_of(state: State, shown: Shown = "window") -> str | None:
    """Return the message at the foot, without the marks in which a terminal's messages have commands."""
    if shown == "tape":
        return None
    own = (one.says(state) for one in reversed(state.modes))
    text = next((words for words in own if words), None)
    text = text or (state.toast.text if state.toast and shown == "window" else None)
    return text and text.replace("`", "")


def chip_of(state: State) -> str | None:
    """Return the answer to the last key, for a while."""
    return state.chip.text if state.chip and state.chip.until > state.frame else None


def hint(state: State) -> str | None:
    """Return which keys to press: once, after the first seconds, unless the user does something before."""
    if state.touched or not state.is_bare or state.toast or state.chip:
        return None
    since = max(state.frame - _WATCH_FRAMES, 0)
    return said(_HINT) if min(since, _HINT_FRAMES - since) >= 4 else None


def watched(state: State) -> str | None:
    """Return the sentence on what to watch for: with the names, and in a mechanism's first seconds.

    Of these it is there until something is done.
    """
    gone = state.frame - (state.frame if state.arrived is None else state.arrived)
    is_new = 0 < gone < _WATCH_FRAMES and state.touched <= (state.arrived or 0)
    if not (is_new or state.look.names) or state.recording or state.toast:
        return None
    return None if state.game or state.is_covered else said(state.shown.look_at)


def recorded_for(state: State) -> str | None:
    """Return how long the recording has run, in words; None where none runs."""
    if state.recording is None:
        return None
    seconds = (state.frame - state.recording.since) // FRAMES_PER_SECOND
    time = f"{seconds // 60}:{seconds % 60:02d}"
    return said("REC {format} {time}", format=state.recording.format.upper(), time=time)


def panel_of(state: State) -> ListPanel | GamePanel | None:
    """Return the open list."""
    panels = (one.panel(state) for one in reversed(state.modes))
    return next((panel for panel in panels if panel), None)


def tools_of(state: State) -> tuple[int, bool] | None:
    """Return the number of the tool in hand, and whether the tools' keys need Ctrl; None without tools."""
    found = next((tools for one in reversed(state.modes) if (tools := one.tools(state))), None)
    return found if found and (state.building or (state.top and state.top.has_tools)) else None


def _tip(button: Button) -> str:
    """Return a command's name and key, and why it cannot be done."""
    named = f"{said(button.name)}   {button.key}".strip()
    return f"{named}: {button.lack}" if button.lack else named


def shortened(board: Board, text: str) -> str:
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


class PanelSheet(NamedTuple):
    """A drawn sheet, where its upper left corner is in the window, and its opacity in eighths."""

    surface: pygame.Surface
    at: tuple[int, int]
    eighths: int = 8


class Panels:
    """Draws the panels of states; the last of each kind is cached, so that an open panel costs one blit."""

    def __init__(self) -> None:
        self._board: Board | None = None
        self._kept: dict[Any, tuple[Any, Any]] = {}
        self._bar = CommandBar()

    def drawn(
        self, state: State, layout: Layout, theme: Theme, mouse: AtMouse = NOWHERE, shown: Shown = "window"
    ) -> tuple[list[PanelSheet], list[Target]]:
        """Return the sheets over the picture, the topmost last, and where they can be clicked."""
        board = self._on(layout, theme)
        sheets, targets = [*self._marks(board, state, shown)], list[Target]()
        panel, shut = sliding(state) if shown == "window" else (panel_of(state), 0.0)
        listed = (panel, mouse.row if panel and state.listed else None)
        if isinstance(panel, GamePanel):
            self._list(board, listed, shut, sheets, targets)
        helped = state.help
        if helped:
            sheets.append(PanelSheet(self._keep(_veil, layout.size), (0, 0)))
        if isinstance(panel, ListPanel):
            self._list(board, listed, shut, sheets, targets)
        if helped:
            left = self._width_at_left(board, self._keep(_drawn, listed)) if isinstance(panel, Panel) else 0
            self._helped(board, state.keys.help_groups, left, sheets, targets)
        if words := words_at_foot(state, mouse, shown):
            drawn, (x, y) = self._keep(foot, words)
            sheets.append(PanelSheet(drawn, (round(x), round(y))))
            if words[1] and words[0] == toast_of(state, shown):
                targets.append(Target("toast", Rect(x, y, *drawn.get_size())))
        tools = None if shown == "tape" or (shown == "screenshot" and not state.building) else tools_of(state)
        if tools:
            sheets += self._tools(tools, mouse)
            targets += [Target("tool", cell, n) for n, cell in enumerate(tool_cells(layout))]
        return sheets, targets

    def bar(
        self, state: State, layout: Layout, mouse: AtMouse = NOWHERE
    ) -> tuple[list[PanelSheet], list[Target]]:
        """Return the sheets of the bar of commands, and the places of its buttons."""
        if not (eighths := bar_eighths(state)):
            return [], []
        buttons = bar(state)
        known = mouse.button is not None and mouse.button < len(buttons)  # else it is of another mode's bar
        theme = theme_of(state.look.theme)
        key = buttons, mouse.button if known else None, layout, theme
        drawn = self._kept.get("bar")
        if drawn is None or drawn[0] != key:
            board = replace(self._board or Board(layout, letters(), theme), layout=layout, theme=theme)
            drawn = self._kept["bar"] = key, self._bar.drawn(board, key[:2])
        sheets, targets = drawn[1]
        return [PanelSheet(surface, at, eighths) for surface, at in sheets], targets

    def _on(self, layout: Layout, theme: Theme) -> Board:
        """Return the board for a layout and a theme; with another one panels are drawn anew."""
        before = self._board or Board(layout, letters(), theme)
        if self._board is None or (before.layout, before.theme) != (layout, theme):
            self._board = replace(before, layout=layout, theme=theme)
            self._kept = {}
        assert self._board
        return self._board

    def _tools(self, tools: tuple[int, bool], mouse: AtMouse) -> Iterator[PanelSheet]:
        yield PanelSheet(*self._keep(tool_bar, tools[0]))
        if mouse.tool is not None:
            yield PanelSheet(*self._keep(tooltip, (mouse.tool, tools[1])))

    def _helped(
        self, board: Board, shown: Help, left: int, sheets: list[PanelSheet], targets: list[Target]
    ) -> None:
        """Add the help, right of a list that takes `left` pixels of the window's left."""
        wide, whole = board.layout.size
        drawn: DrawnSheet = self._keep(help_sheet, (shown, wide - left))
        (broad, high), above = drawn.sheet.get_size(), board.layout.above_bar
        top = int((above if high <= above else whole) - high) // 2
        x = left + (wide - left - broad) // 2
        sheets.append(PanelSheet(drawn.sheet, (x, top)))
        targets += drawn.at(x, top)

    def _list(
        self, board: Board, shown: _Pointed, shut: float, sheets: list[PanelSheet], targets: list[Target]
    ) -> None:
        """Add a list with the row under the mouse.

        The share `shut` of it is beyond the left edge, or beyond the foot where it stands there; it is
        clicked where it goes.
        """
        drawn: DrawnSheet = self._keep(_drawn, shown)
        left, top = self._listed(board, drawn.sheet)
        at = left, top + round(shut * (board.layout.size[1] - top))
        if top <= board.margin:
            at = left - round(shut * (left + drawn.sheet.get_width())), top
        sheets.append(PanelSheet(drawn.sheet, at))
        targets += drawn.at(left, top)

    def _width_at_left(self, board: Board, drawn: DrawnSheet) -> int:
        """Return the width that a list takes at the window's top left."""
        is_at_top = self._listed(board, drawn.sheet)[1] <= board.margin
        return board.margin + drawn.sheet.get_width() if is_at_top else 0

    def _listed(self, board: Board, drawn: pygame.Surface) -> tuple[int, int]:
        """Return where a list stands: at the top of its place, or at the window's foot."""
        lists, margin = board.layout.lists, board.margin
        foot = board.layout.size[1] - margin - drawn.get_height()
        return round(lists.x), max(foot, margin) if lists.y > margin else margin

    def _keep(self, make: Any, value: Any, slot: object = None) -> Any:
        """Return `make` of the board and a value, cached until the slot is asked for another value."""
        kept = self._kept.get((make, slot))
        if kept is None or kept[0] != value:
            kept = self._kept[make, slot] = (value, make(self._board, value))
        return kept[1]

    def _marks(self, board: Board, state: State, shown: Shown) -> Iterator[PanelSheet]:
        """Yield the marks at the right end of the foot: a pause, a recording, how far off a curve is."""
        theme, off = board.theme, next((sign for one in reversed(state.modes) if (sign := one.sign)), None)
        signs = [self._keep(_sign, theme.ink)] if stands(state) and shown != "tape" else []
        signs += [
            self._keep(_mark, (sign, words, colour), sign)
            for sign, words, colour in ((_dot, recorded_for(state), theme.warning), (_wave, off, theme.ink))
            if words
        ]
        if not signs:
            return
        size, place = board.layout.small_size, board.layout.marks
        right, top = place.right, place.middle.imag - 0.6 * size
        for sheet in signs:
            yield PanelSheet(sheet, (round(right - sheet.get_width()), round(top)))
            right -= sheet.get_width() + 0.6 * size


def sliding(state: State) -> tuple[ListPanel | GamePanel | None, float]:
    """Return the list that is open, opens or shuts, and the share of it that is beyond the window's edge."""
    moves = moves_of(state) if state.departures else []
    if not moves:
        return panel_of(state), 0.0
    listed = [float(one.listed) for one in (*(move.left for move in moves), state)]
    open_ = on_the_way(listed, [1.0 - one.share(state.frame) for one in moves])
    if state.listed:
        return panel_of(state), 1.0 - open_
    last = next((one.left for one in reversed(moves) if one.left.listed), None)
    return (panel_of(last), 1.0 - open_) if last else (None, 0.0)


_Pointed = tuple[ListPanel | GamePanel | None, int | None]
"""A list, and its row under the mouse."""


def _drawn(board: Board, shown: _Pointed) -> DrawnSheet:
    listed, pointed = shown
    assert listed
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
