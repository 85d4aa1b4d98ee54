"""The head-up display: what scene it is, and the numbers of this instant, in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.items import Caption
from linkanim.picture.panels.readings import Row, note, ranked, rows_of
from linkanim.picture.raster.raster import Layer
from linkanim.picture.raster.shapes import box
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

STEP = 1.4
"""From row to row, in heights of their text."""
_BACKING = 0.82
"""How little of what lies under the words shows through their backing."""


class WordLine(NamedTuple):
    """A line that stands still: its text, how far down, size, whether it is a title, how wide it is."""

    text: str
    y: float
    size: int
    strong: bool
    width: int


@dataclass(frozen=True)
class WordBlock:
    """Words at one size, all places from the block's top left corner."""

    size: int
    lines: tuple[WordLine, ...]
    """The title's and the class's."""
    turns: int
    """How many lines more than one the title takes."""
    rows: frozenset[str]
    """The names of the rows that are shown."""
    first: float
    """The top of the first row."""
    note: float
    """The top of what is special."""
    key: float
    """The top of the key to the arrows."""
    column: int
    """The width of the rows."""
    width: float
    height: float

    def rects_at(self, place: tuple[float, float]) -> Iterator[Rect]:
        """Yield the rectangles that the words take where the block stands."""
        x, y = place
        for line in self.lines:
            yield Rect(x, y + line.y, line.width, line.size)
        if self.height > self.first:
            yield Rect(x, y + self.first, self.column, self.height - self.first)

    def parts_at(self, place: tuple[float, float]) -> tuple[Rect, Rect | None]:
        """Return the rectangles of the words and of the key to the arrows; None without arrows."""
        x, y = place
        whole = Rect(x, y, self.width, self.key)
        return whole, Rect(
            x, y + self.key, self.column, self.height - self.key
        ) if self.height > self.key else None


@dataclass(frozen=True)
class Hud:
    """The words about a scene where they stand: what keeps still is drawn once, values at every frame."""

    scene: Scene
    block: WordBlock
    place: Rect
    type: Type
    theme: Theme

    def still(self) -> Iterator[Caption]:
        """Yield the words that stand still."""
        for line in self.block.lines:
            at, ink = (self.place.x, self.place.y + line.y), self.theme.ink if line.strong else self.theme.dim
            yield Caption(line.text, at, line.size, ink, strong=line.strong)
        for n, (_, row) in enumerate(ranked(self._rows, self.scene.pose(0.0))):
            yield Caption(row.label, (self.place.x, self._top(n)), self.block.size, self.theme.dim)

    def values(self, pose: Pose) -> list[Caption]:
        """Return the numbers of a pose beside them."""
        size, right = self.block.size, self.place.x + self.block.column
        return [
            Caption(row.value, (right, self._top(n)), size, self.theme.ink, "right", strong=True)
            for n, (_, row) in enumerate(ranked(self._rows, pose))
        ]

    @cached_property
    def _rows(self) -> tuple[Row, ...]:
        """The rows that are shown."""
        return tuple(row for row in rows_of(self.scene) if row.label in self.block.rows)

    def backing(self, key: Rect | None) -> Layer:
        """Return what lets the words and their key be read where something lies under them."""
        bottom = key.bottom if key else self.place.bottom
        room = self.place._replace(height=bottom - self.place.y).inset(-0.5 * self.block.size)
        middle = complex(room.x + room.width / 2, room.y + room.height / 2)
        plate = middle + box(room.width, room.height, 0.5 * self.block.size)
        return Layer(self.theme.background, [plate], _BACKING)

    def notes(self, pose: Pose) -> Iterator[Caption]:
        """Yield what is special at a pose, as clearly as it is shown."""
        words, eighths = note(self.scene, pose)
        size, colour = self.block.size, mixed(self.theme.background, self.theme.dim, eighths / 8)
        lines = self.type.wrapped(words, size, self.block.column) if eighths else []
        for n, line in enumerate(lines):
            at = (self.place.x, self.place.y + self.block.note + 1.2 * size * n)
            yield Caption(line, at, size, colour)

    def _top(self, row: int) -> float:
        return self.place.y + self.block.first + STEP * self.block.size * row
