"""The shelf: what is in sight, titles in whole words, frames and titles at once, pictures one by one."""

from __future__ import annotations

import gc
from itertools import combinations, pairwise

import pygame
import pytest
from fidelity import Pixels
from pictures import pixels

from linkanim.picture.board import Board
from linkanim.picture.layout import layout
from linkanim.picture.picture import Picture
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.player.browsing import NEW, Browsing, grid
from linkanim.scenes import names, titles
from linkanim.ui.shelf import ShelfPrinter, titled

TEXT = 12
THREE = ("kite", "hart", "wiper")
BOARD = Board(layout((1280, 720)), Type(), theme_of("light"))


# One line of the last word's width has room, and no more.
@pytest.mark.parametrize(
    ("title", "lines"),
    [
        pytest.param("Klann's leg", ["Klann's", "leg"], id="a line ends at a space"),
        pytest.param("Grashof double-rocker", ["Grashof", "double-rocker"], id="a word stays whole"),
        pytest.param("Double-rocker's twin", ["Double-", "rocker's twin"], id="a line ends at a hyphen"),
    ],
)
def test_a_title_ends_its_lines_between_words(title: str, lines: list[str]) -> None:
    room = max(BOARD.type.width(line, TEXT) for line in lines)
    assert titled(BOARD, title, TEXT, room) == (lines, TEXT)


def test_a_title_that_has_no_room_is_set_smaller_then_cut() -> None:
    word = "Antiparallelogram"
    room = BOARD.type.width(word, TEXT) - 1
    (line,), size = titled(BOARD, word, TEXT, room)
    assert line == word
    assert size < TEXT
    assert BOARD.type.width(line, size) <= room
    lines, size = titled(BOARD, "A long title that runs on and on over three or four lines", TEXT, 60)
    assert len(lines) == 2
    assert lines[1].endswith("…")
    assert max(BOARD.type.width(line, size) for line in lines) <= 60


SIZES = [(320, 180), (1280, 720), (720, 1280), (3840, 2160), (1000, 300)]


@pytest.mark.parametrize("size", SIZES)
def test_every_title_of_the_catalogue_stands_whole_in_its_place(size: tuple[int, int]) -> None:
    board = Board(layout(size), Type(), theme_of("light"))
    found = grid(size, _shelf(names()))
    cell = next(iter(found.cells.values()))
    for title in titles().values():
        lines, _ = titled(board, title, found.text, cell.width - 0.5 * found.text)
        assert " ".join(lines).replace("- ", "-") == title.replace("- ", "-"), title


def _shelf(entries: tuple[str, ...], chosen: int = 0, top: int = 0) -> Browsing:
    return Browsing(entries, chosen, 0, top=top)


def _shown(size: tuple[int, int], chosen: int) -> pygame.Surface:
    """The shelf of three mechanisms, all of them there, still."""
    surface, painter = pygame.Surface(size, 0, 32), ShelfPrinter()
    for frame in range(4):
        painter.draw(surface, _shelf(THREE, chosen), frame, "light", still=True)
    return surface


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("chosen", [0, 20, len(names()) - 1])
@pytest.mark.parametrize("top", [0, 3, 99])
def test_the_chosen_mechanism_is_in_sight_in_any_window_and_nothing_overlaps(
    size: tuple[int, int], chosen: int, top: int
) -> None:
    found = grid(size, _shelf(names(), chosen, top=top))
    assert found.whole(chosen)
    assert sorted(n for row in found.rows for n in row) == list(range(NEW, len(names())))
    for _, heading in found.headings:
        assert not any(heading.inset(0.5).meets(cell.inset(0.5)) for cell in found.cells.values())
    for one, other in combinations(found.cells.values(), 2):
        assert not one.inset(0.5).meets(other.inset(0.5))
    for n, cell in found.cells.items():
        assert (cell.x >= 0, cell.right <= size[0]) == (True, True)
        at = [
            one.value
            for one in found.targets
            if one.kind == "entry" and one.place.holds(cell.x + 1, cell.y + 1)
        ]
        assert at == ([n] if cell.y + 1 <= found.room.bottom else [])
    full = max(len(row) for row in found.rows)
    wide = full * next(iter(found.cells.values())).width
    assert 0.9 * size[0] < wide < size[0]
    assert found.headings[0][1].y == found.room.y


def test_a_shelf_scrolls_no_further_than_its_last_row() -> None:
    found = grid((1280, 720), _shelf(names(), len(names()) - 1, top=99))
    last = found.cells[len(names()) - 1]
    assert last.bottom <= found.room.bottom
    assert last.bottom > found.room.bottom - 2 * last.height
    alone = grid((1280, 720), _shelf(THREE, 0, top=5))
    assert alone.top == 0


def test_each_chapter_begins_a_row_and_the_rows_are_gone_through_whatever_their_length() -> None:
    found = grid((1280, 720), _shelf(names()))
    lengths = [len(row) for row in found.rows]
    assert sum(lengths) == len(names()) + 1  # an empty sheet leads them
    first, (short, after) = found.rows[0], next(pair for pair in pairwise(found.rows) if len(pair[0]) < 6)
    assert found.neighbour(first[2], 1) == found.rows[1][min(2, len(found.rows[1]) - 1)]
    assert found.neighbour(after[-1], -1) == short[-1]
    assert found.neighbour(first[0], -1) == found.rows[-1][0]


@pytest.mark.slow
def test_the_first_paint_has_every_frame_and_title_and_a_picture_comes_with_each_second_after_it() -> None:
    size, painter = (1280, 720), ShelfPrinter()
    surface = pygame.Surface(size, 0, 32)
    found = grid(size, _shelf(names()))
    shots = []
    for frame in range(len(found.cells)):  # an empty sheet has no picture
        for _ in range(2 if frame else 1):  # in one it is read, in the other its picture is made
            painter.draw(surface, _shelf(names(), 0), frame, "light", still=True)
        shots.append(pixels(surface))
    drawn = [{n for n, cell in found.cells.items() if _differs(shot, shots[0], cell)} for shot in shots]
    assert all(len(after - before) == 1 for before, after in pairwise(drawn))
    assert drawn[-1] == {*found.cells} - {NEW}
    for n, cell in found.cells.items():  # titles stand below the pictures, from the first on
        foot = cell._replace(y=cell.bottom - found.line, height=found.line)
        if foot.bottom <= found.room.bottom:
            assert not _differs(shots[0], shots[-1], foot.inset(2)), n
            rows = shots[0][
                round(foot.y) + 2 : round(foot.bottom) - 2, round(foot.x) + 2 : round(foot.right) - 2
            ]
            assert (rows != rows[0, 0]).any()


@pytest.mark.slow
def test_a_frame_that_reads_a_mechanism_moves_no_other() -> None:
    painter, surface = ShelfPrinter(), pygame.Surface((1280, 720), 0, 32)
    shots = []
    for frame in range(9):  # the first opens the shelf; of the others each second one reads
        painter.draw(surface, _shelf(names(), 0), frame, "light")
        shots.append(pixels(surface))
    stood = [(one == other).all() for one, other in pairwise(shots)]
    assert stood == [True, False] * 4


def _differs(one: Pixels, other: Pixels, cell: Rect) -> bool:
    part = slice(round(cell.y), round(cell.bottom)), slice(round(cell.x), round(cell.right))
    return bool((one[part] != other[part]).any())


@pytest.mark.slow
def test_a_closed_shelf_keeps_no_picture() -> None:
    def painters() -> int:
        gc.collect()
        return sum(isinstance(one, Picture) for one in gc.get_objects())

    before, painter = painters(), ShelfPrinter()
    for _ in range(3):
        painter.draw(pygame.Surface((640, 480), 0, 32), _shelf(("kite",)), 0, "light", still=True)
    assert painters() > before
    painter.close()
    assert painters() == before


@pytest.mark.parametrize("chosen", [0, 2])
def test_the_chosen_mechanism_has_a_frame_of_its_own(chosen: int) -> None:
    size, colour = (640, 480), theme_of("light").velocity
    surface = _shown(size, chosen)
    for n, cell in grid(size, _shelf(THREE, chosen)).cells.items():
        beside = [tuple(surface.get_at((round(cell.x) - 1, y)))[:3] for y in _middle(cell)]
        assert all((pixel == colour) == (n == chosen) for pixel in beside), n


def _middle(cell: Rect) -> range:
    return range(round(cell.y + cell.height / 3), round(cell.bottom - cell.height / 3))


def test_what_to_watch_for_of_the_chosen_one_stands_at_the_foot() -> None:
    size = (640, 480)
    low = round(grid(size, _shelf(THREE)).room.bottom) + 1
    feet = [pixels(_shown(size, chosen))[low:] for chosen in (0, 2)]
    assert all((foot != foot[-1, 0]).any() for foot in feet)
    assert (feet[0] != feet[1]).any()
