"""The list of quantities: their words and symbols, what has been typed to sift them, the chosen one."""

from __future__ import annotations

import pygame

from linkanim.picture.panels.board import STEP, Board, Rows, around
from linkanim.picture.panels.overlay import Quantities

_FRAME = 2.6
"""How many lines high the list is without its rows and hint."""


def quantity_list(board: Board, shown: Quantities) -> pygame.Surface:
    """Return the list, as many rows around the chosen one as the window has room for."""
    size, wide = board.layout.small_size, board.layout.lists.width
    rows, hint = _divided(board, shown)
    lines = max(len(rows), 1) + len(hint) + _FRAME
    sheet = board.sheet(wide, STEP * size * lines)
    count = f"{shown.chosen + 1} of {len(shown.rows)}" if shown.rows else "0"
    typed = (f"{shown.sieve}_", board.theme.velocity) if shown.sieve else (shown.title, board.theme.ink)
    board.head(sheet, size, typed[0], count, typed[1])
    for n, row in enumerate(rows):
        _row(board, sheet, shown, row, size, (0.9 + STEP * (n + 1)) * size)
    if not shown.rows:
        at = (1.2 * size, (0.9 + STEP) * size)
        board.write(sheet, "nothing here has that in its name", at, size=size, colour=board.theme.warning)
    for n, line in enumerate(hint, start=max(len(rows), 1) + 1):
        at = (1.2 * size, (1.1 + STEP * n) * size)
        board.write(sheet, line, at, size=size, colour=board.theme.dim)
    return sheet


def quantity_rows(board: Board, shown: Quantities) -> Rows:
    """Return where the rows are on the list's sheet."""
    size = board.layout.small_size
    return Rows(_divided(board, shown)[0], (0.9 + 0.5 * (STEP + 1)) * size, STEP * size)


def _divided(board: Board, shown: Quantities) -> tuple[range, list[str]]:
    """Return which rows there is room for, and the lines of the hint, if there is room for it."""
    size, place = board.layout.small_size, board.layout.lists
    hint = board.type.wrapped(shown.hint, size, place.width - 2.4 * size, gap="   ")
    room = int(place.height / STEP / size - _FRAME)
    hint = hint if room - len(hint) >= 4 else []
    return around(len(shown.rows), shown.chosen, room - len(hint)), hint


def _row(board: Board, sheet: pygame.Surface, shown: Quantities, row: int, size: int, y: float) -> None:
    behind = board.behind(row, shown.chosen, shown.pointed)
    if behind:
        board.bar(sheet, y, size, behind)
    (words, symbol), room = shown.rows[row], sheet.get_width() - 2.4 * size
    left = room - board.type.width(words, size) - size
    ways = (symbol, symbol.rpartition(" = ")[2])
    symbol = next((text for text in ways if board.type.width(text, size) <= left), "")
    if symbol:
        at = (sheet.get_width() - 1.2 * size, y)
        board.write(sheet, symbol, at, size=size, colour=board.theme.dim, anchor="right")
    board.write(sheet, board.fitting((words,), size, room), (1.2 * size, y), size=size)
