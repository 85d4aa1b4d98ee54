"""Short words that come and go: the chip that answers a key, the bar that says what there is to press."""

from __future__ import annotations

import pygame

from linkanim.picture.panels.board import Board
from linkanim.picture.panels.overlay import Fading

_GAP = "   ·   "


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


def put(surface: pygame.Surface, drawn: pygame.Surface, at: tuple[float, float], shown: Fading) -> None:
    """Blit what has been drawn, its top left corner at a place, as strongly as it is shown."""
    drawn.set_alpha(round(255 * shown.eighths / 8))
    surface.blit(drawn, (round(at[0]), round(at[1])))
