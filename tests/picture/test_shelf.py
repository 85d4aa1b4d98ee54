"""Titles on the shelf: whole words in two lines, or the scene's name, smaller letters, and a cut at last."""

from __future__ import annotations

import gc

import pygame
import pytest
from pictures import pixels

from linkanim.picture.layout import layout
from linkanim.picture.panels.board import Board
from linkanim.picture.panels.overlay import Shelf
from linkanim.picture.picture import Picture
from linkanim.picture.shelf import ShelfPrinter, grid, titled
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect

TEXT = 12
BOARD = Board(layout((1280, 720)), Type(), theme_of("light"))


# One line of the last word's width has room, and no more.
@pytest.mark.parametrize(
    ("title", "name", "lines"),
    [
        pytest.param("Klann's leg", "klann", ["Klann's", "leg"], id="a line ends at a space"),
        pytest.param("Grashof double-rocker", "name", ["Grashof", "double-rocker"], id="a word stays whole"),
        pytest.param("Double-rocker's twin", "x", ["Double-", "rocker's twin"], id="a line ends at a hyphen"),
        pytest.param(
            "Coupled wheels, a quarter apart", "coupledwheels", ["coupledwheels"], id="too long: the name"
        ),
        pytest.param(
            "A long title on three or four lines", "rocker-out", ["rocker-", "out"], id="the name's two"
        ),
    ],
)
def test_a_title_ends_its_lines_between_words(title: str, name: str, lines: list[str]) -> None:
    room = max(BOARD.type.width(line, TEXT) for line in lines)
    assert titled(BOARD, (title, name), TEXT, room) == (lines, TEXT)


def test_a_word_that_has_no_room_is_set_smaller_then_cut() -> None:
    word = "Antiparallelogram"
    room = BOARD.type.width(word, TEXT) - 1
    (line,), size = titled(BOARD, (word, word), TEXT, room)
    assert line == word
    assert size < TEXT
    assert BOARD.type.width(line, size) <= room
    (line,), size = titled(BOARD, (word, word), TEXT, 0.6 * room)
    assert "…" in line
    assert size == TEXT
    assert BOARD.type.width(line, size) <= 0.6 * room


def _shown(size: tuple[int, int], chosen: int) -> pygame.Surface:
    """The shelf of three mechanisms, all of them there, still."""
    surface, painter = pygame.Surface(size, 0, 32), ShelfPrinter()
    for frame in range(4):
        painter.draw(surface, Shelf(("kite", "hart", "wiper"), chosen, frame, "light", still=True))
    return surface


def test_a_closed_shelf_keeps_no_picture() -> None:
    def painters() -> int:
        gc.collect()
        return sum(isinstance(one, Picture) for one in gc.get_objects())

    before, painter = painters(), ShelfPrinter()
    painter.draw(pygame.Surface((640, 480), 0, 32), Shelf(("kite",), 0, 0, "light", still=True))
    assert painters() > before
    painter.close()
    assert painters() == before


@pytest.mark.parametrize("chosen", [0, 2])
def test_the_chosen_mechanism_has_a_frame_of_its_own(chosen: int) -> None:
    size, colour = (640, 480), theme_of("light").velocity
    surface = _shown(size, chosen)
    for n, cell in enumerate(grid(size, (1, 1, 1)).cells):
        beside = [tuple(surface.get_at((round(cell.x) - 1, y)))[:3] for y in _middle(cell)]
        assert all((pixel == colour) == (n == chosen) for pixel in beside), n


def _middle(cell: Rect) -> range:
    return range(round(cell.y + cell.height / 3), round(cell.bottom - cell.height / 3))


def test_where_there_are_no_titles_the_chosen_one_s_stands_at_the_foot() -> None:
    size = (160, 120)
    assert not grid(size, (1, 1, 1)).line
    pictures = [pixels(_shown(size, chosen)) for chosen in (0, 2)]
    low = max(round(cell.bottom) for cell in grid(size, (1, 1, 1)).cells) + 3
    feet = [picture[low:] for picture in pictures]
    assert all((foot != foot[-1, 0]).any() for foot in feet)
    assert (feet[0] != feet[1]).any()
