"""Charts: a frame with axes, curves and points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.picture.diagrams.axis import Axis
from linkanim.picture.items import Caption, Item
from linkanim.picture.layout import Layout
from linkanim.picture.raster.parts import Stamp
from linkanim.picture.raster.raster import Colour, Layer, Loop
from linkanim.picture.raster.shapes import disc, segments, stroke
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect

_FOOT = 1.6
"""From the plot down to the title of the horizontal axis, in heights of small text."""


@dataclass(frozen=True)
class Plot:
    """Where a chart's curves are drawn, and its axes."""

    area: Rect
    x: Axis
    y: Axis

    def place(self, x: ArrayLike, y: ArrayLike) -> Loop:
        """Return pixels for values; above and below the axis they stay at its edge, NaN stays NaN."""
        across, up = self.x.share(x), np.minimum(np.maximum(self.y.share(y), -0.0), 1.0)
        pixels: Loop = (self.area.x + across * self.area.width) + 1j * (
            self.area.bottom - up * self.area.height
        )
        return pixels


@dataclass(frozen=True)
class Pen:
    """What a chart is drawn with."""

    type: Type
    theme: Theme
    small: int
    text: int
    line: float


def pen_for(layout: Layout, type_: Type, theme: Theme) -> Pen:
    """Return the pen for a window's size."""
    return Pen(type_, theme, layout.small_size, layout.text_size, 1.8 * layout.unit)


def plot_area(rect: Rect, y: Axis, pen: Pen, *, foot: bool = False) -> Rect:
    """Return what of a rectangle is left for curves beside tick labels, a title above and one at the foot."""
    labels = max((pen.type.width(label, pen.small) for _, label in y.ticks), default=0)
    left, top = labels + 0.6 * pen.small, 1.5 * pen.text
    right, low = 1.4 * pen.small, (_FOOT + 1.2 if foot else 1.6) * pen.small
    return Rect(
        rect.x + left, rect.y + top, max(rect.width - left - right, 1), max(rect.height - top - low, 1)
    )


def axes(plot: Plot, pen: Pen) -> Iterator[Item]:
    """Yield grid lines and tick labels."""
    area, theme = plot.area, pen.theme
    columns = [complex(plot.place(value, plot.y.low)) for value, _ in plot.x.ticks]
    rows = [complex(plot.place(plot.x.low, value)) for value, _ in plot.y.ticks]
    grid = [*_lines(np.array(columns), -1j * area.height, pen), *_lines(np.array(rows), area.width, pen)]
    yield Layer(theme.rule, grid)
    for foot, (_, label) in zip(columns, plot.x.ticks, strict=True):
        at = (foot.real, area.bottom + 0.4 * pen.small)
        yield Caption(label, at, pen.small, theme.dim, "centre")
    for y, label in _levels(plot, pen):
        at = (area.x - 0.5 * pen.small, y - 0.5 * pen.small)
        yield Caption(label, at, pen.small, theme.dim, "right")


def right_axis(plot: Plot, pen: Pen) -> Iterator[Item]:
    """Yield the ticks of a second vertical axis, at the right."""
    feet = plot.place(plot.x.high, [value for value, _ in plot.y.ticks])
    yield Layer(pen.theme.dim, _lines(feet - 0.3 * pen.small, 0.3 * pen.small, pen))
    for y, label in _levels(plot, pen):
        at = (plot.area.right + 0.4 * pen.small, y - 0.5 * pen.small)
        yield Caption(label, at, pen.small, pen.theme.dim)


def _levels(plot: Plot, pen: Pen) -> Iterator[tuple[float, str]]:
    """Yield how far down ticks of a vertical axis lie, and their labels, but for those that have no room."""
    below = np.inf
    for value, label in plot.y.ticks:
        y = complex(plot.place(plot.x.low, value)).imag
        if y <= below - pen.small:
            below = y
            yield y, label


def x_title(plot: Plot, title: str, pen: Pen, *, foot: bool = True) -> Caption:
    """Return the horizontal axis' title: below the tick labels on a plot with a `foot`, else beside them."""
    y = plot.area.bottom + (_FOOT if foot else 0.4) * pen.small
    return Caption(title, (plot.area.right, y), pen.small, pen.theme.dim, "right")


def beside_title(plot: Plot, title: str, pen: Pen) -> Plot:
    """Return a plot without the labels of the ticks that its title would stand on, which it stands beside."""
    free = plot.area.right - pen.type.width(title, pen.small) - 0.6 * pen.small
    ticks = []
    for value, label in plot.x.ticks:
        right = complex(plot.place(value, plot.y.low)).real + 0.5 * pen.type.width(label, pen.small)
        ticks.append((value, label if right <= free else ""))
    return replace(plot, x=replace(plot.x, ticks=tuple(ticks)))


def marked(
    plot: Plot, marks: Sequence[tuple[float, str]], values: NDArray[np.float64], pen: Pen
) -> Iterator[Item]:
    """Yield a dashed line at each mark, its label at the end that is further from the curve's value there."""
    area = plot.area
    for (x, label), value in zip(marks, values, strict=True):
        foot, wide = complex(plot.place(x, plot.y.low)), pen.type.width(label, pen.small)
        yield Layer(pen.theme.dim, list(_dashes(foot, area.height, pen)))
        low = float(plot.y.share(value)) > 0.5
        left = foot.real + 0.3 * pen.small
        left = left if left + wide <= area.right else foot.real - 0.3 * pen.small - wide
        at = (left, area.bottom - 1.2 * pen.small if low else area.y + 0.1 * pen.small)
        yield Caption(label, at, pen.small, pen.theme.dim)


def _dashes(foot: complex, height: float, pen: Pen) -> Iterator[Loop]:
    """Yield a dashed line that rises from a point."""
    for start in np.arange(0.0, height, 6 * pen.line):
        top = foot - 1j * min(start + 3 * pen.line, height)
        yield from segments(foot - 1j * start, top, 0.7 * pen.line)


def _lines(feet: Loop, reach: complex, pen: Pen) -> list[Loop]:
    return segments(feet, feet + reach, 0.6 * pen.line) if feet.size else []


def curve_layer(
    plot: Plot, x: ArrayLike, y: ArrayLike, colour: Colour, width: float, dashes: Sequence[float] = ()
) -> Layer:
    """Return a curve, dashed in widths of its line; it is broken where a value is not finite."""
    pixels = plot.place(x, np.where(np.isfinite(y), y, np.nan))
    held = (pixels[run] for run in runs_of(np.isfinite(pixels)))
    return line_layer(held, colour, width, dashes)


def line_layer(runs: Iterable[Loop], colour: Colour, width: float, dashes: Sequence[float] = ()) -> Layer:
    """Return lines along paths in pixels, dashed in widths of the line."""
    parts = (part for run in runs for part in _dashed(run, width * np.array(dashes))) if dashes else runs
    return Layer(colour, [loop for part in parts for loop in stroke(part, width)])


def _dashed(run: Loop, dashes: NDArray[np.float64]) -> Iterator[Loop]:
    """Yield the pieces of a path that dashes leave, each dash followed by a gap."""
    gone = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(run)))))
    ends = np.concatenate(([0.0], np.cumsum(dashes)))
    for start in np.arange(0.0, gone[-1], ends[-1]):
        for begin, end in start + ends[:-1].reshape(-1, 2):
            along = np.concatenate(([begin], gone[(gone > begin) & (gone < end)], [min(end, gone[-1])]))
            if begin < gone[-1]:
                yield np.interp(along, gone, run.real) + 1j * np.interp(along, gone, run.imag)


def dot(colour: Colour, pen: Pen) -> Stamp:
    """Return a dot about 0 in a ring of the background."""
    ring = Layer(pen.theme.background, [disc(3.6 * pen.line)])
    return Stamp((ring, Layer(colour, [disc(2.7 * pen.line)])))


def runs_of(held: NDArray[np.bool_]) -> Iterator[NDArray[np.intp]]:
    """Yield the numbers of neighbours that are all held."""
    numbers = np.flatnonzero(held)
    parts = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return (run for run in parts if run.size)
