"""Draw charts: a frame with axes, curves and points, and the chart beside the scene with its cursor."""

from __future__ import annotations

from cmath import isfinite
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.motion import Motion, Pose
from linkanim.mechanics.quantities import Quantity
from linkanim.picture.figure import Figure
from linkanim.picture.items import Caption, Item, Target
from linkanim.picture.layout import Layout
from linkanim.picture.look import Over
from linkanim.picture.quantities import (
    MOST_CHARTS,
    Axis,
    Course,
    Floats,
    Series,
    around,
    axis_of,
    course,
    quantity,
    series_of,
    unbounded_places,
)
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Stamp, dashed, disc, segments, stroke
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect
from linkanim.units import stepped
from linkanim.words import said

# Charts: a frame with axes, curves and points.

_ASYMPTOTE, _ASYMPTOTE_DASHES = 0.6, (8.0, 6.0)
"""The width of an asymptote, in thin lines, and its dashes and gaps, in widths of the asymptote."""
_RIM = 1e-6
"""Points of a curve that are outside a plot by less than this, in pixels, are on its edge."""
_ZERO = 0.8
"""The width of the line at zero, in thin lines; the grid's are thinner and lighter."""
_FOOT = 1.6
"""From the plot down to the title of the horizontal axis, in heights of small text."""
_WITH_FOOT, _NO_FOOT, _FOR_FOOT = 1.2, 1.6, 8.0
"""In heights of small text: that title; the room below a plot without one; the least chart that has one."""
_LONG, _FEWEST = 90.0, 4
"""An axis that is at least this long, in pixels, has at least so many ticks."""


@frozen
class Plot:
    """Where a chart's curves are drawn, and its axes."""

    area: Rect
    x: Axis
    y: Axis

    def pixels(self, x: ArrayLike, y: ArrayLike) -> Loop:
        """Return pixels for values; values beyond the vertical axis are put at its edge, NaN stays NaN."""
        across, up = self.x.share(x), np.minimum(np.maximum(self.y.share(y), -0.0), 1.0)
        pixels: Loop = (self.area.x + across * self.area.width) + 1j * (
            self.area.bottom - up * self.area.height
        )
        return pixels


@frozen
class Pen:
    """The sizes, letters and colours with which a chart is drawn."""

    type: Type
    theme: Theme
    small: int
    text: int
    line: float


def pen_for(layout: Layout, type_: Type, theme: Theme) -> Pen:
    """Return the pen for a window's size."""
    return Pen(type_, theme, layout.small_size, layout.text_size, 1.8 * layout.unit)


def plot_area(
    rect: Rect, y: Axis, pen: Pen, *, foot: bool = False, left: float = 0.0, low: float | None = None
) -> Rect:
    """Return the part of a rectangle for curves: without tick labels, a title above and one at the foot.

    At least `left` pixels stay free at the left; with `low`, so many at the foot.
    """
    left, top = max(left, room_for_ticks(y, pen)), 1.5 * pen.text
    usual = (_FOOT + _WITH_FOOT if foot else _NO_FOOT) * pen.small
    right, low = 1.4 * pen.small, usual if low is None else low
    return Rect(
        rect.x + left, rect.y + top, max(rect.width - left - right, 1), max(rect.height - top - low, 1)
    )


def room_for_ticks(y: Axis, pen: Pen) -> float:
    """Return how much room the tick labels of a vertical axis take beside the plot."""
    return max((pen.type.width(label, pen.small) for _, label in y.ticks), default=0) + 0.6 * pen.small


def axes(plot: Plot, pen: Pen) -> Iterator[Item]:
    """Yield grid lines and tick labels."""
    area, theme = plot.area, pen.theme
    columns = [complex(plot.pixels(value, plot.y.low)) for value, _ in plot.x.ticks]
    rows = [complex(plot.pixels(plot.x.low, value)) for value, _ in plot.y.ticks]
    grid = [*_lines(np.array(columns), -1j * area.height, pen), *_lines(np.array(rows), area.width, pen)]
    yield Layer(theme.rule, grid)
    if plot.y.low < 0.0 < plot.y.high:
        zero = complex(plot.pixels(plot.x.low, 0.0))
        yield Layer(theme.dim, segments([zero], [zero + area.width], _ZERO * pen.line))
    for foot, (_, label) in zip(columns, plot.x.ticks, strict=True):
        at = (foot.real, area.bottom + 0.4 * pen.small)
        yield Caption(label, at, pen.small, theme.dim, "centre")
    for y, label in _levels(plot, pen):
        at = (area.x - 0.5 * pen.small, y - 0.5 * pen.small)
        yield Caption(label, at, pen.small, theme.dim, "right")


def right_axis(plot: Plot, pen: Pen) -> Iterator[Item]:
    """Yield the ticks of a second vertical axis, at the right."""
    feet = plot.pixels(plot.x.high, [value for value, _ in plot.y.ticks])
    yield Layer(pen.theme.dim, _lines(feet - 0.3 * pen.small, 0.3 * pen.small, pen))
    for y, label in _levels(plot, pen):
        at = (plot.area.right + 0.4 * pen.small, y - 0.5 * pen.small)
        yield Caption(label, at, pen.small, pen.theme.dim)


def _levels(plot: Plot, pen: Pen) -> Iterator[tuple[float, str]]:
    """Yield how far down the ticks of a vertical axis lie, and their labels where there is room."""
    below = np.inf
    for value, label in plot.y.ticks:
        y = complex(plot.pixels(plot.x.low, value)).imag
        if y <= below - pen.small:
            below = y
            yield y, label


def x_title(plot: Plot, title: str, pen: Pen) -> Caption:
    """Return the horizontal axis' title, below the tick labels."""
    y = plot.area.bottom + _FOOT * pen.small
    return Caption(title, (plot.area.right, y), pen.small, pen.theme.dim, "right")


def marked(
    plot: Plot, marks: Sequence[tuple[float, str]], values: NDArray[np.float64], pen: Pen
) -> Iterator[Item]:
    """Yield a dashed line at each mark, with its label at the end further from the curve."""
    area = plot.area
    for (x, label), value in zip(marks, values, strict=True):
        foot, wide = complex(plot.pixels(x, plot.y.low)), pen.type.width(label, pen.small)
        runs = dashed(np.array([foot, foot - 1j * area.height]), np.full(2, 3 * pen.line))
        line = [loop for run in runs for loop in segments(run[0], run[-1], 0.7 * pen.line)]
        yield Layer(pen.theme.dim, line)
        low = float(plot.y.share(value)) > 0.5
        left = foot.real + 0.3 * pen.small
        left = left if left + wide <= area.right else foot.real - 0.3 * pen.small - wide
        at = (left, area.bottom - 1.2 * pen.small if low else area.y + 0.1 * pen.small)
        if area.height > 2 * pen.small:
            yield Caption(label, at, pen.small, pen.theme.dim)


def _lines(feet: Loop, reach: complex, pen: Pen) -> list[Loop]:
    return segments(feet, feet + reach, 0.6 * pen.line) if feet.size else []


def curve_layer(
    plot: Plot, x: ArrayLike, y: ArrayLike, colour: Colour, width: float, dashes: Sequence[float] = ()
) -> Layer:
    """Return a curve, broken where a value is not finite or outside; `dashes` are in widths of its line."""
    return line_layer(paths(plot, x, y), colour, width, dashes)


def paths(plot: Plot, x: ArrayLike, y: ArrayLike) -> Iterator[Loop]:
    """Yield, in pixels, the parts of a curve between the lower and the upper edge of a plot."""
    area = plot.area
    across = area.x + plot.x.share(x) * area.width
    pixels = across + 1j * (area.bottom - plot.y.share(np.where(np.isfinite(y), y, np.nan)) * area.height)
    for run in runs_of(np.isfinite(pixels)):
        path = pixels[run]
        for edge in (area.y, area.bottom):
            path = _with_crossings(path, edge)
        for held in runs_of((path.imag >= area.y - _RIM) & (path.imag <= area.bottom + _RIM)):
            yield path[held]


def _with_crossings(path: Loop, level: float) -> Loop:
    """Return a path in pixels with a point added wherever it crosses a level."""
    above = path.imag - level
    at = np.flatnonzero(above[:-1] * above[1:] < 0)
    part = above[at] / (above[at] - above[at + 1])
    crossings = path[at].real + part * (path[at + 1].real - path[at].real) + 1j * level
    longer: Loop = np.insert(path, at + 1, crossings)
    return longer


def asymptotes(plot: Plot, x: ArrayLike, y: ArrayLike, colour: Colour, pen: Pen) -> Iterator[Layer]:
    """Yield a thin dashed line from edge to edge at each place where a curve goes to infinity."""
    for place in unbounded_places(x, y).tolist():
        foot = complex(plot.pixels(place, plot.y.low))
        run = np.array([foot, foot - 1j * plot.area.height])
        yield line_layer([run], colour, _ASYMPTOTE * pen.line, _ASYMPTOTE_DASHES)


def without_values(plot: Plot, columns: Sequence[ArrayLike], pen: Pen) -> Iterator[Caption]:
    """Yield words in the middle of a plot in which no curve has a finite value."""
    if any(np.isfinite(column).any() for column in columns):
        return
    unbounded = any(np.isinf(column).any() for column in columns)
    words = said("at infinity throughout") if unbounded else said("without a value throughout")
    area = plot.area
    at = (area.x + 0.5 * area.width, area.y + 0.5 * area.height - 0.5 * pen.small)
    yield Caption(words, at, pen.small, pen.theme.ink, "centre")


def line_layer(runs: Iterable[Loop], colour: Colour, width: float, dashes: Sequence[float] = ()) -> Layer:
    """Return lines along paths in pixels, dashed in widths of the line."""
    parts = (part for run in runs for part in dashed(run, width * np.array(dashes))) if dashes else runs
    return Layer(colour, [loop for part in parts for loop in stroke(part, width)])


def dot(colour: Colour, pen: Pen) -> Stamp:
    """Return a dot about 0, in a ring of the background's colour."""
    ring = Layer(pen.theme.background, [disc(3.6 * pen.line)])
    return Stamp((ring, Layer(colour, [disc(2.7 * pen.line)])))


def runs_of(held: NDArray[np.bool_]) -> Iterator[NDArray[np.intp]]:
    """Yield the indices of each run of neighbours that are all true."""
    numbers = np.flatnonzero(held)
    parts = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return (run for run in parts if run.size)


# The chart beside the scene: one quantity over one true period of the motion as it runs, and its cursor.

_TITLE = 1.35
"""From the plot up to the line of text above it, in heights of that text."""
_GAP = 1.2
"""The gap between two things in that line, in heights of its text."""
_PAST = 0.13
"""The opacity of the area that the motion has passed."""
_LEAST_PLOT = 2.0
"""The least height of one of several plots, in heights of small text."""
_BETWEEN = 0.7
"""The gap between two plots, in heights of small text."""


@frozen
class ChartPanel:
    """A quantity of a motion that runs at `speed` (rad/s, negative: the phase decreases), `over` an axis.

    Where several charts share the axis, `left` is the room that the widest of their tick labels takes, and
    only the `lowest` chart names the axis. Where not all charts have room, `counted` says which of how many
    this one is.
    """

    figure: Figure
    quantity: Quantity
    rect: Rect
    pen: Pen
    speed: float
    over: Over | None = None
    left: float = 0.0
    lowest: bool = True
    counted: str = ""

    def at(self, speed: float) -> ChartPanel:
        """Return the chart of the same motion at another speed; nothing is solved for it."""
        return self if speed == self.speed else replace(self, speed=speed)

    @cached_property
    def course(self) -> Course:
        """The axis over which the values are shown."""
        scene = self.figure.scene
        return course(scene, self.speed, axis_of(scene, self.over))

    @cached_property
    def series(self) -> Series:
        """The quantity over one true period."""
        series = series_of(self.figure.scene, self.quantity, self._cycle)
        return series.broken(self.quantity.unbounded_between(self.figure.cycle))

    @cached_property
    def _cycle(self) -> Motion:
        return self.figure.scene.solve(phase=self.figure.cycle.phase, speed=self.speed)

    @cached_property
    def curves(self) -> tuple[Floats, Floats]:
        """The places along the course and the values there, a column for each curve."""
        return self.course.laid(self.series)

    @cached_property
    def plot(self) -> Plot:
        """Where the curves are drawn."""
        y, small = self.y_axis, self.pen.small
        low = None if self.lowest else _BETWEEN * small
        area = plot_area(self.rect, y, self.pen, foot=self._has_foot, left=self.left, low=low)
        x = self.course.axis(max(min(round(self.rect.width / (5 * small)), 8), 2))
        return Plot(area, x if self.lowest else x.unlabelled, y)

    @cached_property
    def y_axis(self) -> Axis:
        """The vertical axis."""
        high = self.rect.height - 1.5 * self.pen.text - (_FOOT + _WITH_FOOT) * self.pen.small
        most = max(min(round(self.rect.height / (2.1 * self.pen.small)), 6), 2)
        most = max(most, _FEWEST + 1) if high >= _LONG else most
        return around(self.curves[1], most=most, unit=self.series.unit, least=min(most, _FEWEST))

    @property
    def _has_foot(self) -> bool:
        """Whether there is room for a line below the tick labels."""
        return self.lowest and self.rect.height >= _FOR_FOOT * self.pen.small

    def still(self) -> Iterator[Item]:
        """Yield what stands still, back to front."""
        yield from self.frame()
        x, values = self.curves
        for n, column in enumerate(values.T):
            yield from asymptotes(self.plot, x, column, self.colour(n), self.pen)
            yield curve_layer(self.plot, x, column, self.colour(n), self.width)
        yield from without_values(self.plot, values.T.tolist(), self.pen)

    @property
    def width(self) -> float:
        """How wide curves are drawn, in pixels."""
        return 1.3 * self.pen.line

    def frame(self) -> Iterator[Item]:
        """Yield what stands still, without the curves."""
        title, pen = self.course.title, self.pen
        yield from axes(self.plot, pen)
        if self._has_foot:
            yield x_title(self.plot, title, pen)
        x, values = self.curves
        heights = np.interp([place for place, _ in self.course.marks], x, values[:, 0])
        marks = [(place, label if self.lowest else "") for place, label in self.course.marks]
        yield from marked(self.plot, marks, heights, pen)
        yield self.title

    @cached_property
    def title(self) -> Caption:
        """The vertical axis' title: words, symbol and unit, as far as the reading leaves room."""
        pen, area = self.pen, self.plot.area
        room = area.width - self._widest_reading - _GAP * pen.text
        full = self.quantity.title(self.figure.scene.length_unit)
        short = full.removeprefix(f"{self.quantity.words} ")
        words = next(
            (one for one in (full, short) if pen.type.width(one + self.counted, pen.text) <= room), short
        )
        return Caption(words + self.counted, (area.x, area.y - _TITLE * pen.text), pen.text, pen.theme.ink)

    @cached_property
    def _widest_reading(self) -> float:
        ends = (np.full(self.curves[1].shape[1], end) for end in (self.plot.y.low, self.plot.y.high))
        return max(sum(self._widths(self.reading(values))) for values in ends)

    def colour(self, n: int) -> Colour:
        """Return the colour of a column."""
        return (self.pen.theme.velocity, self.pen.theme.acceleration)[n % 2]

    def values_at(self, pose: Pose) -> Floats:
        """Return the pose's own values; an angle is given in the turn of the curve there."""
        shown: Floats = np.atleast_1d(np.asarray(self.quantity.displayed(pose), float))
        if self.series.unit != "°":
            return shown
        x, values = self.curves
        near = np.array([np.interp(self.course.x_of(pose.phase), x, column) for column in values.T])
        return shown + 360.0 * np.nan_to_num(np.rint((near - shown) / 360.0))

    def foot(self, pose: Pose) -> complex:
        """Return where the cursor stands on the axis at a pose, in pixels."""
        return complex(self.plot.pixels(float(self.course.x_of(pose.phase)), self.plot.y.low))

    def past(self, pose: Pose) -> list[Layer]:
        """Return the areas between the axis and the curves, up to a pose: what the motion has passed."""
        x, values = self.curves
        here = float(self.course.x_of(pose.phase))
        level = min(max(0.0, self.plot.y.low), self.plot.y.high)
        layers = []
        for n, column in enumerate(values.T):
            kept = (x < here) if self.speed >= 0 else (x > here)
            for run in runs_of(kept & np.isfinite(column)):
                ends = self.plot.pixels(x[run[[0, -1]]][::-1], [level, level])
                loop = np.concatenate((self.plot.pixels(x[run], column[run]), ends))
                layers.append(Layer(self.colour(n), [loop], _PAST))
        return layers

    def cursor(self, pose: Pose) -> list[Layer]:
        """Return the line at a pose and the dots where it meets the curves."""
        places = self.plot.pixels(self.course.x_of(pose.phase), [self.plot.y.low, *self.values_at(pose)])
        marks = [mark.at([place]) for mark, place in zip(self._marks, places, strict=True) if isfinite(place)]
        return [layer for layers in marks for layer in layers]

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
        """Yield the pose's values at the right above the plot; with several curves, each with its colour."""
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
        """Return the width of each value in the line, with its colour where there are several."""
        colours = self._swatch + (0.4 + _GAP) * self.pen.text if len(words) > 1 else 0.0
        return [self.pen.type.width(text, self.pen.text) + colours for text in words]

    @property
    def targets(self) -> tuple[Target, ...]:
        """Where it can be clicked: a little beside its ends, too; and its title."""
        area = self.plot.area
        near = Rect(area.x - 12, area.y, area.width + 24, area.height + 2 * self.pen.small)
        title = self.title.around(self.pen.type)
        return Target("chart", near, self), Target("chart-title", title, self.quantity.token)

    def phase_at(self, px: float) -> float:
        """Return the phase at a pixel's x, at most that of the nearer end."""
        area = self.plot.area
        share = min(max((px - area.x) / area.width, 0.0), 1.0)
        return float(self.course.phase_of(share * self.course.span)) % self.course.period


def chart_panel(figure: Figure, token: str, layout: Layout, pen: Pen, over: Over | None = None) -> ChartPanel:
    """Return the chart of a quantity for a window, at the scene's own speed, over the usual or another axis.

    BadInput where the scene has no such quantity.
    """
    rect = layout.chart or Rect(0, 0, *layout.size)
    return ChartPanel(figure, quantity(figure.scene, token), rect, pen, figure.linkage.drive.speed, over)


@frozen
class ChartStrips:
    """The charts of one or several quantities of a motion, one below the other over one axis."""

    panels: tuple[ChartPanel, ...]

    def at(self, speed: float) -> ChartStrips:
        """Return the charts of the same motion at another speed; nothing is solved for them."""
        moved = tuple(panel.at(speed) for panel in self.panels)
        same = all(one is other for one, other in zip(moved, self.panels, strict=True))
        return self if same else ChartStrips(_aligned(moved))

    def still(self) -> Iterator[Item]:
        """Yield what stands still, back to front."""
        return chain.from_iterable(panel.still() for panel in self.panels)

    def foot(self, pose: Pose) -> complex:
        """Return where the cursor stands on the lowest axis at a pose, in pixels."""
        return self.panels[-1].foot(pose)

    def cursor(self, pose: Pose) -> list[Layer]:
        """Return the lines at a pose and the dots where they meet the curves."""
        return [layer for panel in self.panels for layer in panel.cursor(pose)]

    def past(self, pose: Pose) -> list[Layer]:
        """Return the areas under the curves up to a pose."""
        return [layer for panel in self.panels for layer in panel.past(pose)]

    def readings(self, pose: Pose) -> Iterator[Item]:
        """Yield the pose's values above each plot."""
        return chain.from_iterable(panel.readings(pose) for panel in self.panels)

    def targets(self) -> tuple[Target, ...]:
        """Return where they can be clicked."""
        return tuple(target for panel in self.panels for target in panel.targets)


def chart_strips(
    figure: Figure, tokens: Sequence[str], layout: Layout, pen: Pen, over: Over | None = None
) -> ChartStrips:
    """Return the charts of quantities as `chart_panel` returns one, in strips of equal plots.

    Where not all have room below each other, only the last ones are there and say which of how many they are.
    BadInput where the scene has no such quantity, and for more than `MOST_CHARTS`.
    """
    if len(tokens) > MOST_CHARTS:
        raise BadInput(f"{len(tokens)} quantities in charts: there is room for {MOST_CHARTS}")
    whole = chart_panel(figure, tokens[0], layout, pen, over)
    if len(tokens) == 1:
        return ChartStrips((whole,))
    rect, most, least = whole.rect, len(tokens), 1.5 * pen.text + (_BETWEEN + _LEAST_PLOT) * pen.small
    count = next((n for n in range(most, 1, -1) if _high(rect, n, pen) >= least), 1)
    high, last = _high(rect, count, pen), count - 1
    panels = [
        replace(
            chart_panel(figure, token, layout, pen, over),
            rect=Rect(rect.x, rect.y + n * high, rect.width, rect.height - n * high if n == last else high),
            lowest=n == last,
            counted=said(", {number} of {count}", number=most - last + n, count=most) if count < most else "",
        )
        for n, token in enumerate(tokens[most - count :])
    ]
    return ChartStrips(_aligned(panels))


def _aligned(panels: Sequence[ChartPanel]) -> tuple[ChartPanel, ...]:
    """Return charts whose plots have one left edge, beside the widest of all tick labels."""
    if len(panels) == 1:
        return tuple(panels)
    left = max(room_for_ticks(panel.y_axis, panel.pen) for panel in panels)
    return tuple(replace(panel, left=left) for panel in panels)


def _high(rect: Rect, count: int, pen: Pen) -> float:
    """Return the height of each of so many strips in a rectangle, without the foot of the lowest one.

    So all plots, the lowest one's included, are equally high.
    """
    rests = [(low - _BETWEEN) * pen.small for low in (_FOOT + _WITH_FOOT, _NO_FOOT)]
    highs = [((rect.height - rest) / count, rest) for rest in rests]
    return (highs[0] if sum(highs[0]) >= _FOR_FOOT * pen.small else highs[1])[0]
