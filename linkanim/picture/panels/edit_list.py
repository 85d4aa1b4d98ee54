"""The list of dimensions: what the linkage is, the values, and why one is refused."""

from __future__ import annotations

from dataclasses import dataclass

import pygame

from linkanim.picture.panels.board import STEP, Board, Rows, around
from linkanim.picture.panels.overlay import Panel
from linkanim.picture.raster.raster import Colour
from linkanim.picture.theme import ORANGE, mixed

_FRAME = 2.7
"""How many lines high the list is without its rows and what stands above and below them."""
_FEWEST = 4
"""As many rows are shown before hints and facts give way."""
_FLASH = 0.45
"""How much of the flash's colour is in the bar behind the facts at its brightest."""


@dataclass(frozen=True)
class _Division:
    """How the list is divided: its text's size and width, the lines above and below the rows, the rows."""

    size: int
    wide: float
    facts: list[str]
    foot: list[tuple[str, Colour]]
    rows: range

    @property
    def lines(self) -> float:
        """The height of the whole in lines."""
        return len(self.facts) + len(self.rows) + len(self.foot) + _FRAME

    @property
    def top(self) -> float:
        """How far down the first row's text begins, in its heights."""
        return 0.9 + STEP * (1 + len(self.facts)) + (0.25 if self.facts else 0.0)


def edit_list(board: Board, panel: Panel) -> pygame.Surface:
    """Return the list; where it would not fit at a size that reads, the rows around the chosen one."""
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


def edit_rows(board: Board, panel: Panel) -> Rows:
    """Return where the rows are on the list's sheet."""
    parts = _fitting(board, panel)
    return Rows(parts.rows, (parts.top - (STEP - 1) / 2) * parts.size, STEP * parts.size)


def _fitting(board: Board, panel: Panel) -> _Division:
    """Return the largest text at which all fits; else the smallest, without the hint, then the facts."""
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
    """Return how many lines of text there is room for beside the list's frame."""
    return board.layout.lists.height / STEP / size - _FRAME


def _chosen(panel: Panel) -> int | None:
    return next((n for n, row in enumerate(panel.rows) if row.chosen), None)


def _head(board: Board, sheet: pygame.Surface, panel: Panel, parts: _Division) -> None:
    """Draw the title, which of the rows is the chosen one, and the facts, lit up while they flash."""
    size, chosen = parts.size, _chosen(panel)
    count = "" if chosen is None else f"{chosen + 1} of {len(panel.rows)}"
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
    room = at[0] - board.type.width(row.value, size, strong=True) - 2.0 * size
    label = board.fitting((row.label,), size, room)
    board.write(sheet, label, (1.2 * size, y), size=size, colour=board.theme.dim)
    board.write(sheet, row.value, at, size=size, colour=colour, anchor="right", strong=True)
