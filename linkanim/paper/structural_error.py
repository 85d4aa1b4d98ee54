"""The chart of a function generator's structural error: the curve, its extremes, the precision points."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pygame

from linkanim.digits import rounded, significant
from linkanim.export import csv_head, csv_rows
from linkanim.picture.diagrams.axis import linear, range_around
from linkanim.picture.diagrams.chart import (
    Pen,
    Plot,
    axes,
    curve_layer,
    dot,
    line_layer,
    pen_for,
    plot_area,
    x_title,
)
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import layout
from linkanim.picture.look import ThemeName
from linkanim.picture.raster.offscreen import offscreen
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import segments
from linkanim.picture.surface import printed
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.synthesis.generation import FEWEST_POINTS, Generated
from linkanim.synthesis.kinds import Real

_SAMPLES = 721
_ROOM = 0.16
_DASHES = (6.0, 4.0)
_LEVEL = 1e-3
"""Of the largest error: extremes that differ by less are level."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class ErrorChart:
    """The structural error of a linkage over x, in so many pixels."""

    shown: Generated
    size: tuple[int, int] = (1280, 720)
    theme: ThemeName = "light"

    @cached_property
    def pen(self) -> Pen:
        """What it is drawn with."""
        return pen_for(layout(self.size), Type(), theme_of(self.theme))

    @property
    def background(self) -> Colour:
        """The colour under everything."""
        return self.pen.theme.background

    @property
    def title(self) -> str:
        """What it shows, in words."""
        return f"Structural error of {self.shown.task.function.words}, {self.shown.task.generator.name}"

    @cached_property
    def curve(self) -> tuple[Real, Real]:
        """x, and the error there as the solver has it, in y's unit."""
        function = self.shown.task.function
        x = np.linspace(function.first, function.last, _SAMPLES)
        return x, self.shown.errors(x)

    def csv(self) -> str:
        """Return the curve as a table: x, the function, the error."""
        x, errors = self.curve
        return csv_head(["x", "y", "error"]) + csv_rows([x, self.shown.task.function(x), errors])

    def surface(self) -> pygame.Surface:
        """Return the chart drawn."""
        surface = offscreen(self.size)
        surface.fill(self.background)
        printed(surface, self.groups(), self.pen.type)
        return surface

    def groups(self) -> tuple[Group, ...]:
        """Return everything on the page, words over shapes."""
        return (grouped("chart", self.items()),)

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        pen, theme = self.pen, self.pen.theme
        power = math.floor(math.log10(self.shown.error)) if self.shown.error else 0
        unit = 10.0**power
        x, errors = self.curve
        function = self.shown.task.function
        whole = Rect(0, 0, *self.size).inset(1.2 * pen.small)
        yield Caption(self.title, (whole.x, whole.y), pen.text, theme.ink, strong=True)
        below = whole._replace(y=whole.y + 1.4 * pen.text, height=whole.height - 1.4 * pen.text)
        y_axis = linear(*range_around(errors / unit, _ROOM), most=7)
        area = plot_area(below, y_axis, pen, foot=True)
        most = max(min(round(area.width / (5 * pen.small)), 12), 2)
        plot = Plot(area, linear(function.first, function.last, most=most), y_axis)
        yield from axes(plot, pen)
        scale = f" × 10{str(power).translate(_RAISED)}" if power else ""
        said = (
            f"error in y{scale}, {significant(100 * self.shown.error / abs(function.span), 2)} % of its range"
        )
        yield Caption(said, (area.x, area.y - 1.4 * pen.small), pen.small, theme.ink)
        yield x_title(plot, "x", pen)
        foot = complex(plot.place(function.first, 0.0))
        yield Layer(theme.dim, segments(foot, foot + area.width, 0.6 * pen.line))
        if self._level:
            for height in (self.shown.error, -self.shown.error):
                ends = plot.place(np.array([function.first, function.last]), np.full(2, height / unit))
                yield line_layer([ends], theme.acceleration, pen.line, _DASHES)
        yield curve_layer(plot, x, errors / unit, theme.velocity, 1.2 * pen.line)
        fine = replace(pen, line=0.7 * pen.line)
        yield from dot(theme.ink, fine).at([complex(plot.place(at, 0.0)) for at in self.shown.points])
        yield from self._extremes(plot, unit)

    @property
    def _level(self) -> bool:
        """Whether as many extremes are equal as lengths alone can make."""
        heights = [abs(error) for _, error in self.shown.extremes]
        return sum(height >= (1 - _LEVEL) * max(heights) for height in heights) >= FEWEST_POINTS + 1

    def _extremes(self, plot: Plot, unit: float) -> Iterator[Item]:
        pen = self.pen
        for x, error in self.shown.extremes:
            at = complex(plot.place(x, error / unit))
            yield from dot(pen.theme.velocity, pen).at([at])
            words = rounded(error / unit, 3)
            half = 0.5 * pen.type.width(words, pen.small)
            middle = min(max(at.real, plot.area.x + half), plot.area.right - half)
            top = at.imag - 1.6 * pen.small if error > 0 else at.imag + 0.5 * pen.small
            yield Caption(words, (middle, top), pen.small, pen.theme.ink, "centre")
