"""Charts: a frame with axes, curves and points; and the strip under the scene with its cursor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees

import numpy as np
import pygame
from numpy.typing import ArrayLike, NDArray

from linkanim.digits import stepped
from linkanim.picture.axis import Axis, around, linear
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Layout
from linkanim.picture.quantities import Series, quantity, series_of
from linkanim.picture.raster import Colour, Layer, Loop, paint
from linkanim.picture.shapes import disc, segments, stroke
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect


@dataclass(frozen=True)
class Plot:
    """Where a chart's curves are drawn, and its axes."""

    area: Rect
    x: Axis
    y: Axis

    def place(self, x: ArrayLike, y: ArrayLike) -> Loop:
        """Return pixels for values; above and below the axis they stay at its edge, NaN stays NaN."""
        across, up = self.x.share(x), np.clip(self.y.share(y), -0.0, 1.0)
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


def plot_area(rect: Rect, y: Axis, pen: Pen, *, title: bool = True) -> Rect:
    """Return what of a rectangle is left for curves beside tick labels and a title."""
    labels = max((pen.type.width(label, pen.small) for _, label in y.ticks), default=0)
    left, top = labels + 0.6 * pen.small, (1.5 * pen.text if title else 0.6 * pen.small)
    right, low = 1.4 * pen.small, 1.6 * pen.small
    return Rect(
        rect.x + left, rect.y + top, max(rect.width - left - right, 1), max(rect.height - top - low, 1)
    )


def draw_axes(surface: pygame.Surface, plot: Plot, pen: Pen) -> None:
    """Draw grid lines and tick labels."""
    area, theme = plot.area, pen.theme
    columns = [complex(plot.place(value, plot.y.low)) for value, _ in plot.x.ticks]
    rows = [complex(plot.place(plot.x.low, value)) for value, _ in plot.y.ticks]
    grid = [*_lines(np.array(columns), -1j * area.height, pen), *_lines(np.array(rows), area.width, pen)]
    paint(surface, [Layer(theme.rule, grid)])
    for foot, (_, label) in zip(columns, plot.x.ticks, strict=True):
        at = (foot.real, area.bottom + 0.4 * pen.small)
        pen.type.draw(surface, label, at, size=pen.small, colour=theme.dim, anchor="centre")
    for foot, (_, label) in zip(rows, plot.y.ticks, strict=True):
        at = (area.x - 0.5 * pen.small, foot.imag - 0.5 * pen.small)
        pen.type.draw(surface, label, at, size=pen.small, colour=theme.dim, anchor="right")


def _lines(feet: Loop, reach: complex, pen: Pen) -> list[Loop]:
    return segments(feet, feet + reach, 0.6 * pen.line) if feet.size else []


def curve_layer(plot: Plot, x: ArrayLike, y: ArrayLike, colour: Colour, width: float) -> Layer:
    """Return a curve; it is broken where a value is not finite."""
    pixels = plot.place(x, np.where(np.isfinite(y), y, np.nan))
    return Layer(colour, [loop for run in _runs(pixels) for loop in stroke(run, width)])


def point_layers(plot: Plot, points: list[tuple[float, float]], colour: Colour, pen: Pen) -> list[Layer]:
    """Return dots at values, in a ring of the background."""
    places = [complex(plot.place(*point)) for point in points]
    ring = Layer(pen.theme.background, [place + disc(3.6 * pen.line) for place in places])
    return [ring, Layer(colour, [place + disc(2.7 * pen.line) for place in places])]


def _runs(pixels: Loop) -> Iterator[Loop]:
    held = np.flatnonzero(np.isfinite(pixels))
    for run in np.split(held, np.flatnonzero(np.diff(held) > 1) + 1):
        if run.size:
            yield pixels[run]


@dataclass(frozen=True)
class Strip:
    """The chart under the scene: one quantity over one true period."""

    name: str
    series: Series
    plot: Plot
    pen: Pen
    period: float

    def draw(self, surface: pygame.Surface) -> None:
        """Draw all that stands still: axes, name, and the curves."""
        draw_axes(surface, self.plot, self.pen)
        area, pen = self.plot.area, self.pen
        top = area.y - 1.35 * pen.text
        pen.type.draw(surface, self.name, (area.x, top), size=pen.text, colour=pen.theme.ink)
        turns = np.degrees(np.append(self.series.phases, self.period))
        for n, column in enumerate(self.series.values.T):
            whole = np.append(column, column[0] + self._gain(n))
            paint(surface, [curve_layer(self.plot, turns, whole, self.colour(n), 1.3 * pen.line)])

    def _gain(self, n: int) -> float:
        """Return by how much a quantity grows in a period: whole turns for an angle, else nothing."""
        values = self.series.values[:, n]
        if self.series.unit != "°" or len(values) < 2:
            return 0.0
        step = values[-1] - values[-2]
        return float(360.0 * np.round((values[-1] + step - values[0]) / 360.0))

    def colour(self, n: int) -> Colour:
        """Return the colour of a column."""
        return (self.pen.theme.velocity, self.pen.theme.acceleration)[n % 2]

    def values_at(self, phase: float) -> NDArray[np.float64]:
        """Return the values at a phase, between the nearest two that were solved."""
        count = len(self.series.phases)
        at = (phase / self.period) % 1.0 * count
        index, part = int(at) % count, at - int(at)
        gain = np.array([self._gain(n) for n in range(self.series.values.shape[1])])
        after = self.series.values[(index + 1) % count] + (gain if index + 1 == count else 0.0)
        here = self.series.values[index]
        mean: NDArray[np.float64] = here * (1 - part) + after * part
        return np.where(np.isfinite(mean), mean, here)

    def cursor(self, phase: float) -> list[Layer]:
        """Return the line at a phase and the dots where it meets the curves."""
        turn = degrees(phase % self.period)
        foot = complex(self.plot.place(turn, self.plot.y.low))
        head = foot - 1j * self.plot.area.height
        layers = [Layer(self.pen.theme.ink, segments(foot, head, 0.8 * self.pen.line))]
        for n, value in enumerate(self.values_at(phase)):
            if np.isfinite(value):
                layers += point_layers(self.plot, [(turn, float(value))], self.colour(n), self.pen)
        return layers

    def reading(self, phase: float) -> str:
        """Return the values under the cursor in words."""
        span, gap = self.plot.y.high - self.plot.y.low, "" if self.series.unit == "°" else " "
        return "   ".join(
            f"{label} {stepped(float(value), span / 500)}{gap}{self.series.unit}".strip()
            for label, value in zip(self.series.labels, self.values_at(phase), strict=True)
        )

    def draw_reading(self, surface: pygame.Surface, phase: float) -> None:
        """Draw the values under the cursor at the right of the name."""
        area, pen = self.plot.area, self.pen
        at = (area.right, area.y - 1.35 * pen.text)
        words, ink = self.reading(phase), pen.theme.ink
        pen.type.draw(surface, words, at, size=pen.text, colour=ink, anchor="right")

    def phase_at(self, px: float, py: float) -> float | None:
        """Return the phase under a pixel, None outside the chart; a little beside the ends counts."""
        area = self.plot.area
        near = Rect(area.x - 12, area.y, area.width + 24, area.height + 2 * self.pen.small)
        if not near.holds(px, py):
            return None
        return min(max((px - area.x) / area.width, 0.0), 1.0) * self.period


def strip(figure: Figure, name: str, layout: Layout, pen: Pen) -> Strip:
    """Return the chart of a quantity for a window; BadInput where the scene has no such quantity."""
    found = series_of(figure.scene, quantity(figure.scene, name), figure.cycle)
    rect = layout.chart or Rect(0, 0, *layout.size)
    most = max(min(round(rect.height / (2.1 * pen.small)), 6), 2)
    values = around(found.values, most=most, unit="°" if found.unit == "°" else "")
    period = figure.scene.period
    turns = linear(0.0, degrees(period), most=8, unit="°")
    return Strip(name, found, Plot(plot_area(rect, values, pen), turns, values), pen, period)
