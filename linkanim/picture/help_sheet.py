"""The help: every key and what it does, by subject, in as many columns as the window has room for."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import pygame

from linkanim.picture.board import Board
from linkanim.picture.overlay import Help

_STEP = 1.32
_GAP = 1.1
"""Between the keys and what they do, and between columns twice as much, in heights of the text."""
_LEAST = 9
"""The smallest text that can be read, in pixels."""


class _Line(NamedTuple):
    """A line of a column: a subject, or a key and what it does; an empty one parts subjects."""

    keys: str
    does: str
    heading: bool = False


class _Column(NamedTuple):
    lines: tuple[_Line, ...]
    keys: float
    """How wide its keys are."""
    does: float


class _Plan(NamedTuple):
    """The columns at one text size, and how large a sheet they need."""

    size: int
    columns: list[_Column]
    wide: float
    high: float


def help_sheet(board: Board, told: tuple[Help, int]) -> pygame.Surface:
    """Return the help, its text as large as lets it stand in a room so wide, and in the window's height.

    Where not all of it can be read there, the last subjects are left out.
    """
    groups, room = told
    plan = next(filter(partial(_fits, (room, board.layout.size[1])), _plans(board, groups)), None)
    size, columns, wide, high = plan or _planned(board, groups[:1], _LEAST)
    sheet = board.sheet(wide, high)
    x = 1.4 * size
    for column in columns:
        _draw(board, sheet, column, x, size)
        x += column.keys + column.does + 3 * _GAP * size
    return sheet


def _plans(board: Board, groups: Help) -> Iterator[_Plan]:
    """Yield all subjects at every size, then fewer and fewer at the least."""
    for size in range(board.layout.text_size, _LEAST - 1, -1):
        yield _planned(board, groups, size)
    for count in range(len(groups) - 1, 0, -1):
        yield _planned(board, groups[:count], _LEAST)


def _planned(board: Board, groups: Help, size: int) -> _Plan:
    columns = [_measured(board, lines, size) for lines in _divided(groups)]
    wide = sum(column.keys + column.does for column in columns) + (_GAP * (3 * len(columns) - 2) + 2.8) * size
    high = (_STEP * max(len(column.lines) for column in columns) + 1.6) * size
    return _Plan(size, columns, wide, high)


def _fits(room: tuple[int, int], plan: _Plan) -> bool:
    width, height = room
    return plan.wide <= 0.97 * width and plan.high <= 0.97 * height


def _divided(groups: Help) -> list[tuple[_Line, ...]]:
    """Return the lines of two columns, as equally high as whole subjects let them be; one group's of one."""
    blocks = [tuple(_block(subject, lines)) for subject, lines in groups]
    if len(blocks) == 1:
        return [blocks[0][1:]]
    cuts = range(1, len(blocks))
    cut = min(cuts, key=lambda n: max(sum(map(len, blocks[:n])), sum(map(len, blocks[n:]))))
    return [_joined(blocks[:cut]), _joined(blocks[cut:])]


def _block(subject: str, lines: tuple[tuple[str, str], ...]) -> Iterator[_Line]:
    yield _Line(subject.capitalize(), "", heading=True)
    yield from (_Line(keys, does) for keys, does in lines)


def _joined(blocks: list[tuple[_Line, ...]]) -> tuple[_Line, ...]:
    """Return the blocks one below the other, an empty line between them."""
    lines = [line for block in blocks for line in (*block, _Line("", ""))]
    return tuple(lines[:-1])


def _measured(board: Board, lines: tuple[_Line, ...], size: int) -> _Column:
    keys = board.widest((line.keys for line in lines if not line.heading), size, strong=True)
    return _Column(lines, keys, board.widest((line.does for line in lines), size))


def _draw(board: Board, sheet: pygame.Surface, column: _Column, x: float, size: int) -> None:
    for n, line in enumerate(column.lines):
        y = (0.9 + _STEP * n) * size
        colour = board.theme.velocity if line.heading else board.theme.ink
        board.write(sheet, line.keys, (x, y), size=size, colour=colour, strong=True)
        at = (x + column.keys + _GAP * size, y)
        board.write(sheet, line.does, at, size=size, colour=board.theme.dim)
