"""The words about a scene, set in blocks: its title and class, rows of numbers, the key to its colours."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from itertools import groupby, zip_longest
from typing import NamedTuple

from linkanim.picture.layout import Layout
from linkanim.picture.panels.hud import STEP, WordBlock, WordLine
from linkanim.picture.panels.legend import KEY_STEP
from linkanim.picture.panels.readings import Reading, notes, ranked, rows_of
from linkanim.picture.text.text import Type
from linkanim.scenes.editing.titles import beyond_title
from linkanim.scenes.scene import Scene

_TITLE = 1.43
"""The title's size, in sizes of the rows."""
_SMALLEST = 10
_SHRUNK = 0.72
"""The rows' least size, in pixels and in the size that a window's is as a rule."""
_CLASS_RANK = 4
"""The class goes after the rows of higher ranks."""
_CLASS_WIDTH = 17.0
"""As wide as this, in sizes, a class is not broken."""
_GAP = 0.9
"""Between the name and the value of a row, in sizes."""
_MOST_LINES = 4
_TRIED = 24
_SENTENCE_LINES = (1, 2, 3, 4)
_MEASURED = 21
"""The size at which values are compared; the widest is so at any size."""
_FASTEST = -10.0
"""The fastest that a scene is run at, backwards for the minus sign."""


class WidestRow(NamedTuple):
    """A row as it needs the most room, with its rank."""

    rank: int
    row: Reading


def widest_rows(scenes: Sequence[Scene], type_: Type) -> tuple[WidestRow, ...]:
    """Return the rows of a scene, and of those beside it, each with the widest value that it ever has."""
    widest: dict[str, tuple[int, WidestRow]] = {}
    for one in (one for scene in scenes for one in _over_a_cycle(scene)):
        width = type_.width(one.row.value, _MEASURED)
        if width > widest.get(one.row.label, (-1, one))[0]:
            widest[one.row.label] = width, one
    return tuple(one for _, one in widest.values())


def _over_a_cycle(scene: Scene) -> Iterator[WidestRow]:
    """Yield the rows over a cycle, at the fastest speed."""
    known, speed = rows_of(scene), _FASTEST * scene.linkage.drive.speed
    for step in range(_TRIED):
        for rank, row in ranked(known, scene.pose(scene.period * step / _TRIED, speed=speed)):
            yield WidestRow(rank, row)


def blocks(
    scenes: Sequence[Scene], rows: tuple[WidestRow, ...], layout: Layout, keys: int, type_: Type
) -> Iterator[list[WordBlock]]:
    """Yield the words in groups, each with the title in ever more lines; those to be preferred first.

    First all `rows`, ever smaller, then ever less of it, then without the key. `keys` is how many
    lines the key has. The words are the first scene's; there is room for those of the others in their place.
    """
    setter = _Setter(scenes, layout, keys, type_)
    smallest = max(_SMALLEST, round(_SHRUNK * layout.text_size))
    for size in range(layout.text_size, smallest, -1):
        yield setter.group(size, rows, True)
    ranks = sorted({one.rank for one in rows}, reverse=True)
    bare = _Setter(scenes, layout, 0, type_)
    ways = [(setter, rank) for rank in ranks] + [(bare, rank) for rank in (*ranks, -1)]
    for way, rank in ways:
        yield way.group(smallest, tuple(one for one in rows if one.rank <= rank), rank >= _CLASS_RANK)


def caption_lines(layout: Layout, text: str, type_: Type) -> list[str]:
    """Return a sentence in lines, as it stands below a scene."""
    room = layout.caption.width if layout.caption else layout.stage.width - 2 * layout.margin
    return type_.wrapped(text, layout.small_size, room) if text else []


def shapes_of(text: str, layout: Layout, type_: Type) -> Iterator[tuple[float, float]]:
    """Yield how wide and high a sentence is on a sheet of its own, in one line and in more."""
    size = layout.small_size
    whole = type_.width(text, size)
    for count in _SENTENCE_LINES if text else ():
        lines = type_.wrapped(text, size, (1.0 + 0.2 * (count > 1)) * whole / count)
        wide = max(type_.width(line, size) for line in lines)
        yield wide + 2.0 * size, (1.25 * len(lines) + 0.75) * size


class _Setter:
    """Sets the words of one scene."""

    def __init__(self, scenes: Sequence[Scene], layout: Layout, keys: int, type_: Type) -> None:
        self._scene, self._layout, self._keys, self._type = scenes[0], layout, keys, type_
        shown = type_.width(self._scene.title, round(_TITLE * layout.text_size))
        self._title = self._scene.title if shown and self._scene.title.strip() else self._scene.name
        self._classes = [beyond_title(self._title, scene.info.class_name) for scene in scenes]
        self._notes = [words for scene in scenes for words in notes(scene)]

    def group(self, size: int, rows: tuple[WidestRow, ...], classed: bool) -> list[WordBlock]:
        """Return the block with the title in one line, in two, and so on."""
        big = round(_TITLE * size)
        titles = [self._broken(count, big) for count in range(1, _MOST_LINES + 1)]
        return [self._block(size, title, rows, classed) for title, _ in groupby(titles)]

    def _block(
        self, size: int, title: tuple[str, ...], rows: tuple[WidestRow, ...], classed: bool
    ) -> WordBlock:
        big, column = round(_TITLE * size), self._column(size, rows)
        lines = [self._line(text, 1.12 * big * n, big, strong=True) for n, text in enumerate(title)]
        y, wide = 1.12 * big * len(title) + 0.1 * size, max(line.width for line in lines)
        for line_of_each in self._classed(size, max(column, wide, _CLASS_WIDTH * size)) if classed else ():
            widest = max(self._type.width(text, size) for text in line_of_each)
            lines.append(WordLine(line_of_each[0], y, size, False, widest))
            y += 1.2 * size
        first = y + 0.5 * size if rows else y
        note = first + STEP * size * len(rows) + (0.3 * size if rows else 0.0)
        key = note + 1.2 * size * max(
            (len(self.wrapped(words, size, column)) for words in self._notes), default=0
        )
        high = KEY_STEP * self._layout.small_size * self._keys if rows else 0.0
        width = max(column, *(line.width for line in lines))
        shown = frozenset(one.row.label for one in rows)
        last, tall = len(title) - 1, key + high
        return WordBlock(size, tuple(lines), last, shown, first, note, key, column, width, tall)

    def _classed(self, size: int, width: float) -> Iterator[tuple[str, ...]]:
        """Yield the lines of the scenes' classes, the first scene's first."""
        wrapped = (self._type.wrapped(words, size, width) for words in self._classes)
        yield from zip_longest(*wrapped, fillvalue="")

    def wrapped(self, words: str, size: int, column: int) -> list[str]:
        """Return a note in lines."""
        return self._type.wrapped(words, size, column) if column else []

    def _column(self, size: int, rows: tuple[WidestRow, ...]) -> int:
        """Return how wide the rows are, and the key to the colours."""
        width = self._type.width
        wide = [
            width(one.row.label, size) + width(one.row.value, size, strong=True) + _GAP * size for one in rows
        ]
        if rows and self._keys:
            small = self._layout.small_size
            unit = f"acceleration  00000 {self._scene.length_unit}/s²"
            wide.append(3.2 * small + width(unit, small))
        return round(max(wide, default=0.0))

    def _line(self, text: str, y: float, size: int, *, strong: bool) -> WordLine:
        return WordLine(text, y, size, strong, self._type.width(text, size, strong=strong))

    def _broken(self, count: int, big: int) -> tuple[str, ...]:
        """Return the title in at most so many lines, between its words, as narrow as they can be."""
        words, room = self._title.split(), self._layout.stage.width - 2 * self._layout.margin

        def lines(width: float) -> list[str]:
            return self._type.wrapped(self._title, big, width, strong=True)

        def fits(width: int) -> bool:
            found = lines(width)
            return len(found) <= count and " ".join(found).split() == words

        widths = range(max(int(room), 0))
        narrowest = bisect_left(widths, True, key=fits)
        return tuple(lines(narrowest if narrowest < len(widths) else room)) or ("",)
