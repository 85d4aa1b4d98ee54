"""The chart beside the scene: one quantity over one true period of the motion as it runs, and its cursor."""

from __future__ import annotations

from cmath import isfinite
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linkanim.digits import stepped
from linkanim.mechanics.facts.register import Quantity
from linkanim.mechanics.motion.motion import Motion, Pose
from linkanim.picture.diagrams.axis import around
from linkanim.picture.diagrams.chart import (
    Pen,
    Plot,
    axes,
    beside_title,
    curve_layer,
    dot,
    marked,
    plot_area,
    x_title,
)
from linkanim.picture.diagrams.course import Course, Floats, axis_of, course
from linkanim.picture.diagrams.quantities import Series, broken, quantity, series_of
from linkanim.picture.figure import Figure
from linkanim.picture.items import Caption, Item
from linkanim.picture.layout import Layout
from linkanim.picture.look import Over
from linkanim.picture.raster.parts import Stamp
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import segments
from linkanim.picture.view import Rect

_TITLE = 1.35
"""From the plot up to the line above it, in heights of its text."""
_GAP = 1.2
"""Between two things in that line, in heights of its text."""


@dataclass(frozen=True)
class ChartPanel:
    """A quantity of a motion that runs at `speed` (rad/s, negative: the phase runs back), `over` an axis."""

    figure: Figure
    quantity: Quantity
    rect: Rect
    pen: Pen
    speed: float
    over: Over | None = None

    def at(self, speed: float) -> ChartPanel:
        """Return the chart of the same motion at another speed; nothing is solved for it."""
        return self if speed == self.speed else replace(self, speed=speed)

    @cached_property
    def course(self) -> Course:
        """What the values are shown over."""
        scene = self.figure.scene
        return course(scene, self.speed, axis_of(scene, self.over))

    @cached_property
    def series(self) -> Series:
        """The quantity over one true period."""
        found = series_of(self.figure.scene, self.quantity, self._cycle)
        return broken(found, self.quantity, self.figure.cycle)

    @cached_property
    def _cycle(self) -> Motion:
        return self.figure.cycle.paced(self.speed / self.figure.linkage.drive.speed)

    @cached_property
    def curves(self) -> tuple[Floats, Floats]:
        """The places along the course and the values there, a column for each curve."""
        return self.course.laid(self.series)

    @cached_property
    def plot(self) -> Plot:
        """Where the curves are drawn."""
        small = self.pen.small
        most = max(min(round(self.rect.height / (2.1 * small)), 6), 2)
        y = around(self.curves[1], most=most, unit=self.series.unit)
        area = plot_area(self.rect, y, self.pen, foot=self._has_foot)
        return Plot(area, self.course.axis(max(min(round(self.rect.width / (5 * small)), 8), 2)), y)

    @property
    def _has_foot(self) -> bool:
        """Whether there is room for a line below the tick labels."""
        return self.rect.height >= 9 * self.pen.small

    def still(self) -> Iterator[Item]:
        """Yield what stands still, back to front."""
        yield from self.frame()
        for n, column in enumerate(self.curves[1].T):
            yield curve_layer(self.plot, self.curves[0], column, self.colour(n), self.width)

    @property
    def width(self) -> float:
        """How wide curves are drawn, in pixels."""
        return 1.3 * self.pen.line

    def frame(self) -> Iterator[Item]:
        """Yield what stands still but for the curves."""
        title, pen = self.course.title, self.pen
        yield from axes(self.plot if self._has_foot else beside_title(self.plot, title, pen), pen)
        yield x_title(self.plot, title, pen, foot=self._has_foot)
        x, values = self.curves
        heights = np.interp([place for place, _ in self.course.marks], x, values[:, 0])
        yield from marked(self.plot, self.course.marks, heights, pen)
        yield self._y_title()

    def _y_title(self) -> Caption:
        """Return the vertical axis' title: words, symbol and unit, as much as leaves room for the reading."""
        pen, area = self.pen, self.plot.area
        room = area.width - self._widest_reading - _GAP * pen.text
        full = self.quantity.title(self.figure.scene.length_unit)
        short = full.removeprefix(f"{self.quantity.words} ")
        words = full if pen.type.width(full, pen.text) <= room else short
        return Caption(words, (area.x, area.y - _TITLE * pen.text), pen.text, pen.theme.ink)

    @cached_property
    def _widest_reading(self) -> float:
        ends = (np.full(self.curves[1].shape[1], end) for end in (self.plot.y.low, self.plot.y.high))
        return max(sum(self._widths(self.reading(values))) for values in ends)

    def colour(self, n: int) -> Colour:
        """Return the colour of a column."""
        return (self.pen.theme.velocity, self.pen.theme.acceleration)[n % 2]

    def values_at(self, pose: Pose) -> Floats:
        """Return the pose's own values; of an angle the turn in which the curve stands there."""
        found: Floats = np.atleast_1d(np.asarray(self.quantity.shown(pose), float))
        if self.series.unit != "°":
            return found
        x, values = self.curves
        near = np.array([np.interp(self.course.x_of(pose.phase), x, column) for column in values.T])
        return found + 360.0 * np.nan_to_num(np.rint((near - found) / 360.0))

    def foot(self, pose: Pose) -> complex:
        """Return where the cursor stands on the axis at a pose, in pixels."""
        return complex(self.plot.place(float(self.course.x_of(pose.phase)), self.plot.y.low))

    def cursor(self, pose: Pose) -> list[Layer]:
        """Return the line at a pose and the dots where it meets the curves."""
        places = self.plot.place(self.course.x_of(pose.phase), [self.plot.y.low, *self.values_at(pose)])
        found = [mark.at([place]) for mark, place in zip(self._marks, places, strict=True) if isfinite(place)]
        return [layer for layers in found for layer in layers]

    @cached_property
    def _marks(self) -> tuple[Stamp, ...]:
        """The line up from the axis, and each curve's dot, about 0."""
        pen, head = self.pen, -1j * self.plot.area.height
        line = Stamp((Layer(pen.theme.ink, segments(0, head, 0.8 * pen.line)),))
        return line, *(dot(self.colour(n), pen) for n in range(len(self.series.labels)))

    def reading(self, values: NDArray[np.float64]) -> tuple[str, ...]:
        """Return values in words, one for each curve."""
        span, gap = self.plot.y.high - self.plot.y.low, "" if self.series.unit == "°" else " "
        return tuple(
            f"{label} {stepped(float(value), span / 500)}{gap}{self.series.unit}".strip()
            for label, value in zip(self.series.labels, values, strict=True)
        )

    def readings(self, pose: Pose) -> Iterator[Item]:
        """Yield the pose's values at the right above the plot, of several curves each with its colour."""
        pen, words = self.pen, self.reading(self.values_at(pose))
        widths = self._widths(words)
        y, x = self.plot.area.y - _TITLE * pen.text, self.plot.area.right - sum(widths)
        for n, (text, width) in enumerate(zip(words, widths, strict=True)):
            left = x + width - pen.type.width(text, pen.text)
            yield Caption(text, (left, y), pen.text, pen.theme.ink)
            if len(words) > 1:
                end = complex(left - 0.4 * pen.text, y + 0.5 * pen.text)
                yield Layer(self.colour(n), segments(end - self._swatch, end, 1.6 * pen.line))
            x += width

    @property
    def _swatch(self) -> float:
        return 1.1 * self.pen.text

    def _widths(self, words: tuple[str, ...]) -> list[float]:
        """Return how much of the line each value takes, with its colour where there are several."""
        colours = self._swatch + (0.4 + _GAP) * self.pen.text if len(words) > 1 else 0.0
        return [self.pen.type.width(text, self.pen.text) + colours for text in words]

    def phase_at(self, px: float, py: float) -> float | None:
        """Return the phase under a pixel, None outside the chart; a little beside the ends counts."""
        area = self.plot.area
        near = Rect(area.x - 12, area.y, area.width + 24, area.height + 2 * self.pen.small)
        if not near.holds(px, py):
            return None
        share = min(max((px - area.x) / area.width, 0.0), 1.0)
        return float(self.course.phase_of(share * self.course.span)) % self.course.period


def chart_panel(figure: Figure, token: str, layout: Layout, pen: Pen, over: Over | None = None) -> ChartPanel:
    """Return the chart of a quantity for a window, at the scene's own speed, over the usual or another axis.

    BadInput where the scene has no such quantity.
    """
    rect = layout.chart or Rect(0, 0, *layout.size)
    return ChartPanel(figure, quantity(figure.scene, token), rect, pen, figure.linkage.drive.speed, over)
