"""The help: every key and what it does, by subject, in as many columns as the window has room for."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import NamedTuple

import pygame

from linkanim.picture.panels.board import Board
from linkanim.picture.panels.overlay import Help

_STEP = 1.32
_GAP = 1.1
"""Between the keys and what they do, and between columns twice as much, in heights of the text."""
_WIDEST = 0.97
"""The most of its room that the help takes."""
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


class _Laid(NamedTuple):
    """The columns at one text size, and how large a sheet they need."""

    size: int
    columns: list[_Column]
    wide: float
    high: float


def help_sheet(board: Board, shown: tuple[Help, int]) -> pygame.Surface:
    """Return the help, its text as large as lets it stand in a room so wide, and in the window's height.

    Where not all of it can be read there, the last subjects are left out.
    """
    groups, room = shown
    for laid in _ways(board, groups, _WIDEST * room):
        if laid.wide <= _WIDEST * room + 1 and laid.high <= _WIDEST * board.layout.size[1]:
            break
    size, sheet = laid.size, board.sheet(laid.wide, laid.high)
    x = 1.4 * size
    for column in laid.columns:
        _draw(board, sheet, column, x, size)
        x += column.keys + column.does + 3 * _GAP * size
    return sheet


def _ways(board: Board, groups: Help, room: float) -> Iterator[_Laid]:
    """Yield all subjects at every size, smaller ones broken into lines, then fewer and fewer at the least."""
    largest, small = board.layout.text_size, board.layout.small_size
    for size in range(largest, small - 1, -1):
        yield _laid(board, groups, size)
    for size in range(small, _LEAST - 1, -1):
        yield _laid(board, groups, size)
        yield _laid(board, groups, size, room)
    for count in range(len(groups) - 1, 0, -1):
        yield _laid(board, groups[:count], _LEAST, room)


def _laid(board: Board, groups: Help, size: int, room: float | None = None) -> _Laid:
    """Return the columns at a size, no wider than a room together where one is given."""
    parts = _divided(groups)
    gaps = (_GAP * (3 * len(parts) - 2) + 2.8) * size
    each = None if room is None else (room - gaps) / len(parts)
    columns = [_measured(board, lines, size, each) for lines in parts]
    wide = sum(column.keys + column.does for column in columns) + gaps
    high = (_STEP * max(len(column.lines) for column in columns) + 1.6) * size
    return _Laid(size, columns, wide, high)


def _divided(groups: Help) -> list[tuple[_Line, ...]]:
    """Return the lines of two columns, as equally high as whole subjects let them be; one group's of one.

    An empty line is below each subject but the last of a column.
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
    """Yield a line as several where what its keys do is wider than a room."""
    first, *rest = board.type.wrapped(line.does, size, max(room, 6.0 * size)) or [""]
    yield line._replace(does=first)
    yield from (_Line("", more) for more in rest)


def _draw(board: Board, sheet: pygame.Surface, column: _Column, x: float, size: int) -> None:
    for n, line in enumerate(column.lines):
        y = (0.9 + _STEP * n) * size
        colour = board.theme.velocity if line.heading else board.theme.ink
        board.write(sheet, line.keys, (x, y), size=size, colour=colour, strong=True)
        at = (x + column.keys + _GAP * size, y)
        board.write(sheet, line.does, at, size=size, colour=board.theme.dim)
