"""Words that come and go: a chip that answers a key, what there is to press, sentences; and where."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product

import pygame

from linkanim.picture.layout import Layout
from linkanim.picture.panels.board import Board
from linkanim.picture.panels.overlay import Fading
from linkanim.picture.raster.raster import Colour
from linkanim.picture.view import Rect

_GAP = "   ·   "
_LITTLE = 0.12
"""A sentence that takes more of the stage's height is shown on nothing that is drawn, or not at all."""


def chip(board: Board, text: str) -> pygame.Surface:
    """Return a chip: words on a small sheet."""
    size = board.layout.text_size
    sheet = board.sheet(board.type.width(text, size, strong=True) + 1.6 * size, 1.7 * size)
    board.write(sheet, text, (sheet.get_width() / 2, 0.35 * size), size=size, anchor="centre", strong=True)
    return sheet


def hint_bar(board: Board, text: str) -> pygame.Surface | None:
    """Return the hint bar, the last of its parts that there is room for; None where that is none."""
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
    """Return what to watch for on a sheet where nothing is drawn, or off the words; None for nowhere."""
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
    sheets = [_lines(board, text, size, share * layout.stage.width) for size, share in ways]
    found = ((sheet, off_words(layout, sheet, edges(board, sheet))) for sheet in sheets)
    free = next(((sheet, at) for sheet, at in found if at), None)
    return free or (sheets[0], next(edges(board, sheets[0])))


def _lines(board: Board, text: str, size: int, room: float, colour: Colour | None = None) -> pygame.Surface:
    """Return words on a sheet, in lines no wider than some room, in ink unless a colour is given."""
    lines = board.type.wrapped(text, size, room - 2 * size)
    sheet = board.sheet(board.widest(lines, size) + 2 * size, (1.25 * len(lines) + 0.75) * size)
    for n, line in enumerate(lines):
        at = (sheet.get_width() / 2, (0.5 + 1.25 * n) * size)
        board.write(sheet, line, at, size=size, colour=colour, anchor="centre")
    return sheet


def off_words(
    layout: Layout, drawn: pygame.Surface, places: Iterable[tuple[float, float]]
) -> tuple[float, float] | None:
    """Return the first of some places at which a sheet lies on no word about the scene; else None."""
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
    """Blit what has been drawn, its top left corner at a place, as strongly as it is shown."""
    drawn.set_alpha(round(255 * shown.eighths / 8))
    surface.blit(drawn, (round(at[0]), round(at[1])))
