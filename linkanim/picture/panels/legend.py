"""The key to the arrows: which colour is what, and how much the arrow shown there stands for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from linkanim.digits import three_digits
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import Layout
from linkanim.picture.parts.vectors import Arrows
from linkanim.picture.raster.raster import Layer
from linkanim.picture.raster.shapes import arrows
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect

KEY_STEP = 1.5
"""From line to line of the key to the arrows."""
_SMALLEST = 8


@dataclass(frozen=True)
class Legend:
    """A line for each kind of arrow at the foot of the HUD's column."""

    kinds: tuple[Arrows, ...]
    column: Rect
    size: int
    """The height of its text."""
    type: Type
    theme: Theme

    def group(self, speed: float) -> Group:
        """Return the key at this input speed (rad/s)."""
        return grouped("key", [*self.still(), *self.values(speed)], still=True)

    def still(self) -> Iterator[Item]:
        """Yield the arrows and what they are called."""
        size = self.size
        for n, kind in enumerate(self.kinds):
            foot = complex(self.column.x, self._top(n) + 0.5 * size)
            yield Layer(kind.colour, arrows([foot], [self._reach], 1.6 * kind.gauge.line))
            at = (self.column.x + self._reach + 0.6 * size, self._top(n))
            yield Caption(kind.words, at, size, self.theme.dim)

    def values(self, speed: float) -> Iterator[Caption]:
        """Yield how much each arrow stands for at this input speed (rad/s)."""
        for n, kind in enumerate(self.kinds):
            at, words = (self.column.right, self._top(n)), self.meaning(kind, speed)
            yield Caption(words, at, self.size, self.theme.dim, "right")

    def meaning(self, kind: Arrows, speed: float) -> str:
        """Return in words how much the arrow of the key stands for; a dash where nothing moves."""
        scale = kind.scale(speed)
        return f"{three_digits(self._reach / scale)} {kind.unit}" if scale > 0 else "–"

    @property
    def fits(self) -> bool:
        """Whether words and values stand side by side, with room for values a digit longer."""
        lines = (f"{kind.words}  0{self.meaning(kind, kind.drive)}" for kind in self.kinds)
        room = self.column.width - self._reach - 0.6 * self.size
        return all(self.type.width(line, self.size) <= room for line in lines)

    @property
    def _reach(self) -> float:
        """The length of the key's arrows in pixels."""
        return 2.6 * self.size

    def _top(self, line: int) -> float:
        return self.column.y + KEY_STEP * self.size * line


def legend_for(kinds: tuple[Arrows, ...], layout: Layout, type_: Type, theme: Theme) -> Legend | None:
    """Return the key to the arrows, its text as large as fits; None without arrows or a place for it."""
    column = layout.legend
    if column is None or not kinds:
        return None
    sizes = range(layout.small_size, _SMALLEST, -1)
    legends = (Legend(kinds, column, size, type_, theme) for size in sizes)
    return next((legend for legend in legends if legend.fits), Legend(kinds, column, _SMALLEST, type_, theme))
