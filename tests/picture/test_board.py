"""The sheets on which panels are drawn."""

from __future__ import annotations

import pygame
import pytest

from linkanim.picture.board import Board
from linkanim.picture.layout import layout
from linkanim.picture.raster import Layer, paint
from linkanim.picture.shapes import box
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of

SHEETS = {
    "a list": (340, 420),
    "a long toast": (701, 27),
    "a narrow list": (64, 600),
    "smaller than its corners": (9, 8),
    "as low as its corners": (300, 21),
}


@pytest.mark.parametrize("window", [(320, 180), (1000, 777), (1920, 1080)])
@pytest.mark.parametrize("size", SHEETS.values(), ids=SHEETS)
def test_an_empty_sheet_of_any_size_has_a_frame_with_round_corners(
    window: tuple[int, int], size: tuple[int, int]
) -> None:
    board = Board(layout(window), Type(), theme_of("light"))
    unit, (wide, high) = board.layout.unit, size
    middle, line = complex(wide / 2, high / 2), max(1.5 * unit, 1.0)
    whole = pygame.Surface(size, pygame.SRCALPHA, 32)
    outer = middle + box(wide, high, 10 * unit)
    inner = middle + box(wide - 2 * line, high - 2 * line, 10 * unit - line)
    paint(whole, [Layer(board.theme.rule, [outer]), Layer(board.theme.panel, [inner])])
    drawn = board.sheet(*size)
    assert pygame.image.tobytes(drawn, "RGBA") == pygame.image.tobytes(whole, "RGBA")
