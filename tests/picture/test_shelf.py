"""Titles on the shelf: whole words in two lines, or the scene's name, smaller letters, and a cut at last."""

from __future__ import annotations

import pytest

from linkanim.picture.board import Board
from linkanim.picture.layout import layout
from linkanim.picture.shelf import titled
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of

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
