"""Things that are found by typed words, and the shelf: its mechanisms, and where each stands."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from itertools import groupby
from math import ceil
from typing import ClassVar, NamedTuple, Self, TypeVar

from linkanim.frozen import frozen
from linkanim.picture.items import Target
from linkanim.picture.layout import Docked, layout
from linkanim.picture.view import Rect
from linkanim.scenes import chapter_of, titles
from linkanim.scenes.scene import Scene
from linkanim.words import said, to_say

Key = TypeVar("Key")

# Words by which things are found, and what stands on a shelf.

NEW = -1
"""The place of an empty sheet on the shelf, before all mechanisms."""
NEW_TITLE = to_say("New: an empty sheet")


MINE = to_say("Mine")
"""The chapter of the scene files in the current folder."""


class OwnFile(NamedTuple):
    """A scene file in the current folder: its name, and when it was written last, in words."""

    name: str
    written: str

    @property
    def title(self) -> str:
        """Its name without the ending."""
        return self.name.removesuffix(".toml")


def filtered(texts: Mapping[Key, tuple[str, ...]], typed: str) -> tuple[Key, ...]:
    """Return the keys whose texts have all the typed words, the best ones first.

    The best is the one whose first text is what was typed; then come those with words that begin so. First of
    either are those whose first text has all the words, then those whose first two have them, and so on, each
    in the order of `texts`.
    """
    if not (words := typed.casefold().split()):
        return tuple(texts)
    rows = [(key, [text.casefold() for text in several]) for key, several in texts.items()]
    for word in words:
        rows = [(key, several) for key, several in rows if any(word in text for text in several)]

    def rank(several: list[str]) -> int:
        if several[0].replace("-", " ").split() == typed.casefold().replace("-", " ").split():
            return 0
        return 1 + max(next(n for n, text in enumerate(several) if word in text) for word in words)

    def is_within(several: list[str]) -> bool:
        starts = re.findall(r"\w+", " ".join(several))
        return not all(any(one.startswith(word) for one in starts) for word in words)

    def order(several: list[str]) -> tuple[bool, bool, int]:
        return rank(several) > 0, is_within(several), rank(several)

    return tuple(key for key, several in sorted(rows, key=lambda one: order(one[1])))


def searched(entry: Scene | str) -> tuple[str, str, str]:
    """Return the texts by which a mechanism is found: its name, its title, its chapter."""
    if isinstance(entry, str):
        entry_chapter = chapter_of(entry) or ""
        return entry, said(titles()[entry]), said(entry_chapter)
    return entry.name, said(entry.title), said(entry.chapter)


@frozen
class Browsing:
    """The open shelf: its mechanisms, the chosen one, and the frame at which it was opened.

    Typed letters filter it; it is scrolled to the row numbered `top`. The user's `own` files have the places
    after those of the mechanisms.
    """

    entries: tuple[Scene | str, ...]
    chosen: int
    since: int
    typed: str = ""
    top: int = 0
    own: tuple[OwnFile, ...] = ()

    has_new: ClassVar[bool] = True
    """Whether an empty sheet stands first."""

    @property
    def heading(self) -> str:
        """What stands over it."""
        return said("Mechanisms")

    @property
    def nothing(self) -> str:
        """What is said where nothing has the typed words."""
        return said("no title or chapter contains that")

    def texts(self, number: int) -> tuple[str, str, str]:
        """Return the texts by which the mechanism at a place is found: its name, its title, its chapter."""
        return searched(self.entries[number])

    @cached_property
    def matches(self) -> tuple[int, ...]:
        """The places of the mechanisms and files that have all the typed words, the best ones first."""
        files = ((one.title, one.written, said(MINE)) for one in self.own)
        texts = dict(enumerate((*map(self.texts, range(len(self.entries))), *files)))
        return filtered({NEW: (NEW_TITLE,), **texts} if self.has_new else texts, self.typed)

    def file_at(self, number: int) -> OwnFile | None:
        """Return the file at a place; None where there is a mechanism, or nothing."""
        behind = number - len(self.entries)
        return self.own[behind] if 0 <= behind < len(self.own) else None

    def filtered(self, typed: str) -> Self:
        """Return the shelf with other letters typed, and the best of what is found chosen."""
        other = replace(self, typed=typed, top=0)
        return replace(other, chosen=(*other.matches, self.chosen)[0]) if typed else other


# Where the mechanisms of a shelf stand.

_SHAPE = 1.6
"""The width of a picture over its height."""
_WIDE = (185.0, 100.0)
"""The least width of a picture, in units and in pixels."""
TITLE_LINES = 2
"""The most lines of a title, and of the sentence at the foot."""
HEADING = 1.2
"""The size of a heading, in sizes of a title."""
_TRACK = 1.6
"""The width of the scroll bar's track, in heights of a title."""


class Grid(NamedTuple):
    """The visible part of a shelf: places by the numbers of their mechanisms, headings, words.

    `rows` are all rows of numbers, from top to bottom; the first visible one is numbered `top`. What extends
    below the `room` is cut off there. The `track` is that of the scroll bar, if not all is visible.
    """

    cells: dict[int, Rect]
    headings: tuple[tuple[str, Rect], ...]
    rows: tuple[tuple[int, ...], ...]
    top: int
    room: Rect
    line: float
    text: int
    shape: ShelfRows
    track: Rect | None = None

    @property
    def targets(self) -> list[Target]:
        """Where it can be clicked."""
        low = self.room.bottom
        cells = {n: one._replace(height=min(one.bottom, low) - one.y) for n, one in self.cells.items()}
        tracks = [Target("shelf-track", self.track)] if self.track else []
        return [
            Target("shelf", self.room, self),
            *(Target("entry", one, n) for n, one in cells.items()),
            *tracks,
        ]

    def scrolled(self, rows: int) -> Grid:
        """Return the grid so many rows further down, as far as there are any."""
        row = min(max(self.top + rows, 0), max(len(self.rows) - 1, 0))
        return self.shape.showing(row, row)

    def neighbour(self, number: int, rows: int) -> int:
        """Return the mechanism nearest to a place, `rows` further down; the first row follows the last.

        The same place where there are no rows.
        """
        if not self.rows:
            return number
        here = next((n for n, row in enumerate(self.rows) if number in row), 0)
        row = self.rows[(here + rows) % len(self.rows)]
        return row[min(self.rows[here].index(number), len(row) - 1)] if number in self.rows[here] else row[0]

    @property
    def seen(self) -> range:
        """The visible rows, at least one of them as a whole."""
        last = next((n for n in range(self.top, len(self.rows)) if not self.whole(self.rows[n][0])), None)
        return range(self.top, max(len(self.rows) if last is None else last, self.top + 1))

    @property
    def step(self) -> float:
        """The step from row to row, in pixels."""
        tops = sorted({cell.y for cell in self.cells.values()})
        return max(tops[1] - tops[0] if len(tops) > 1 else self.room.height, 1.0)

    def led_to(self, y: float) -> int:
        """Return which row is the first visible one when the knob's middle is dragged to a pixel's y."""
        track, count = self.track or self.room, len(self.rows)
        share = (y - track.y) / max(track.height, 1.0)
        return min(max(round(share * count - len(self.seen) / 2), 0), max(count - 1, 0))

    def whole(self, number: int) -> bool:
        """Return whether a mechanism's place is visible from top to bottom."""
        return number in self.cells and self.cells[number].bottom <= self.room.bottom + 1


def grid(size: tuple[int, int], browsing: Browsing) -> Grid:
    """Return where a shelf's mechanisms stand, scrolled so that the chosen one is visible."""
    shape = ShelfRows(size, browsing)
    chosen = next((n for n, row in enumerate(shape.rows) if browsing.chosen in row), 0)
    return shape.showing(browsing.top, chosen)


class ShelfRows:
    """The sizes of things on a shelf, and which mechanisms are in each row."""

    def __init__(self, size: tuple[int, int], browsing: Browsing) -> None:
        parts = layout(size, docked=Docked(bar=True))
        unit = parts.unit
        self.text = max(round(15.0 * unit), 11)
        edge = max(14.0 * unit, 4.0)
        strip = _TRACK * self.text
        wide, high = (max(side, 1.0) for side in (size[0] - edge - strip, parts.above_bar - 5.4 * self.text))
        self._room = Rect(edge, 2.4 * self.text, wide, high)
        self._track = Rect(self._room.right, self._room.y, strip, high)
        self._gap, least = max(12.0 * unit, 4.0), max(_WIDE[0] * unit, _WIDE[1])
        columns = max(int((size[0] - 2 * edge + self._gap) / (least + self._gap)), 1)
        self._wide = (self._room.width - (columns - 1) * self._gap) / columns
        self.line = (1.2 * TITLE_LINES + 0.3) * self.text
        groups = [
            (name, [*members]) for name, members in groupby(browsing.matches, lambda n: _chapter(browsing, n))
        ]
        self._heads = [name for name, members in groups for _ in range(ceil(len(members) / columns))]
        self.rows = tuple(
            tuple(members[n : n + columns]) for _, members in groups for n in range(0, len(members), columns)
        )

    def showing(self, top: int, row: int) -> Grid:
        """Return the grid with the row `top` at its top, or another so that a row is visible as a whole.

        It is scrolled at most until the last row stands at the foot.
        """
        last = len(self.rows) - 1
        top = min(max(top, 0), row, max(last, 0))
        while top < row and not self.grid(top).whole(self.rows[row][0]):
            top += 1
        while top > 0 and self.grid(top - 1).whole(self.rows[last][0]):
            top -= 1
        return self.grid(top)

    def grid(self, top: int) -> Grid:
        """Return the grid with a row at its top, below the name of its chapter."""
        cells: dict[int, Rect] = {}
        heads = []
        y, high, head = self._room.y, self._wide / _SHAPE + self.line, 1.5 * HEADING * self.text
        for n in range(top, len(self.rows)):
            if n == top or self._heads[n] != self._heads[n - 1]:
                heads.append((self._heads[n], Rect(self._room.x, y, self._room.width, head)))
                y += head
            if y >= self._room.bottom:
                break
            for column, place in enumerate(self.rows[n]):
                x = self._room.x + column * (self._wide + self._gap)
                cells[place] = Rect(x, y, self._wide, high)
            y += high + self._gap
        seen = tuple(one for one in heads if one[1].bottom <= self._room.bottom)
        grid = Grid(cells, seen, self.rows, top, self._room, self.line, self.text, self)
        return grid if len(grid.seen) >= len(self.rows) else grid._replace(track=self._track)


def _chapter(browsing: Browsing, number: int) -> str:
    """Return what stands over a mechanism: its chapter, in capitals where it begins."""
    if number == NEW:  # the empty sheet stands first in the first chapter
        return next((_chapter(browsing, n) for n in browsing.matches if n != NEW), said(MINE))
    if browsing.file_at(number):
        return said(MINE)
    name = browsing.texts(number)[2] or said("opened")
    return name[:1].upper() + name[1:]
