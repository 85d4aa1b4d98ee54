"""The key to the colours: of arrows with how much the one shown there stands for, of the causal chain."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from linkanim.digits import three_digits
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import Layout
from linkanim.picture.parts.vectors import Arrows
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import arrows, disc
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect

KEY_STEP = 1.5
"""From line to line of the key to the arrows."""
_SMALLEST = 8
_ENDS = ("input", "output")
_DISC_STEP = 1.2
"""From the colour of a step to the next one's, in heights of the text."""


@dataclass(frozen=True)
class Legend:
    """A line for each kind of arrow at the foot of the HUD's column, and one for the chain's colours."""

    kinds: tuple[Arrows, ...]
    column: Rect
    size: int
    """The height of its text."""
    type: Type
    theme: Theme
    chain: tuple[Colour, ...] = ()

    def group(self, speed: float) -> Group:
        """Return the key at this input speed (rad/s)."""
        chained = self._chained(self._top(len(self.kinds))) if self.chain else ()
        return grouped("key", [*self._arrows(speed), *chained], still=True)

    def _arrows(self, speed: float) -> Iterator[Item]:
        """Yield the arrows, what they are called, and how much each stands for."""
        size, dim = self.size, self.theme.dim
        for n, kind in enumerate(self.kinds):
            top = self._top(n)
            foot = complex(self.column.x, top + 0.5 * size)
            yield Layer(kind.colour, arrows([foot], [self._reach], 1.6 * kind.gauge.line))
            yield Caption(kind.words, (self.column.x + self._reach + 0.6 * size, top), size, dim)
            yield Caption(self.meaning(kind, speed), (self.column.right, top), size, dim, "right")

    def _chained(self, top: float) -> Iterator[Item]:
        """Yield the colours of the steps in which joints are solved, between input and output."""
        size, (begin, end) = self.size, _ENDS
        first = self.column.x + self.type.width(begin, size) + 0.5 * size
        room = self.column.right - self.type.width(end, size) - 0.5 * size - first
        step = min(_DISC_STEP * size, room / len(self.chain))
        yield Caption(begin, (self.column.x, top), size, self.theme.dim)
        for n, colour in enumerate(self.chain):
            middle, radius = complex(first + (n + 0.5) * step, top + 0.5 * size), 0.42 * step
            yield Layer(self.theme.outline, [middle + disc(radius)])
            yield Layer(colour, [middle + disc(radius - max(0.1 * size, 1.0))])
        yield Caption(end, (first + len(self.chain) * step + 0.5 * size, top), size, self.theme.dim)

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


def legend_for(
    kinds: tuple[Arrows, ...], layout: Layout, type_: Type, theme: Theme, chain: tuple[Colour, ...] = ()
) -> Legend | None:
    """Return the key to arrows and chain, its text as large as fits; None without any or a place for it."""
    column = layout.legend
    if column is None or not (kinds or chain):
        return None
    sizes = range(layout.small_size, _SMALLEST - 1, -1)
    legends = [Legend(kinds, column, size, type_, theme, chain) for size in sizes]
    return next((legend for legend in legends if legend.fits), legends[-1])
