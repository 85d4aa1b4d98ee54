"""Print how a linkage was synthesised: its construction step by step, its structural error as a chart."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from itertools import chain

import numpy as np

from linkanim.export import csv_head, csv_rows
from linkanim.frozen import frozen
from linkanim.paper.illustration import DrawnPage
from linkanim.picture.chart import Plot, axes, curve_layer, dot, line_layer, plot_area, x_title
from linkanim.picture.constructed import clear_phase, linkage_marks, steps_of, title_of, usual_kind
from linkanim.picture.construction import box_of, construction_items, view_of
from linkanim.picture.items import Caption, Item
from linkanim.picture.look import ConstructionKind
from linkanim.picture.quantities import input_at, linear, range_around
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import segments
from linkanim.picture.text import unspaced
from linkanim.scenes.scene import Scene
from linkanim.synthesis.constructions import ConstructionStep
from linkanim.synthesis.generation import FEWEST_POINTS, Generated
from linkanim.synthesis.linkages import Real
from linkanim.units import rounded, significant
from linkanim.words import said

# The construction of a synthesis as a figure: its marks, and below them a sentence for each step.

_LINE = 1.35
"""From line to line, in heights of their text."""


@frozen
class ConstructionPage(DrawnPage):
    """The first steps of a scene's construction, all where `steps` is None; `size` is in pixels.

    Without a `kind` it is the first that the scene has. Instant centres are those at `phase` (rad); without
    one, those of the pose in which they lie nearest.
    """

    scene: Scene
    steps: int | None = None
    kind: ConstructionKind | None = None
    phase: float | None = None

    @property
    def _kind(self) -> ConstructionKind:
        """The kind of construction; BadInput where a scene has none."""
        return self.kind or usual_kind(self.scene)

    @cached_property
    def every(self) -> tuple[ConstructionStep, ...]:
        """All steps; BadInput where the scene has no such construction."""
        if self._kind == "synthesis" or self._kind == "dead-centres":
            return steps_of(self.scene, self._kind)
        first, *others = steps_of(self.scene, self._kind, self._phase)
        marks = (*linkage_marks(self.scene, self._phase), *first.marks)
        return (ConstructionStep(first.words, marks), *others)

    @cached_property
    def _phase(self) -> float:
        return clear_phase(self.scene) if self.phase is None else self.phase

    @property
    def title(self) -> str:
        """What it shows, in words."""
        if self._kind != "centres":
            return title_of(self.scene, self._kind)
        where = input_at(self.scene, self.scene.pose(self._phase, 0).coordinate)
        return said("{title} at {place}", title=title_of(self.scene, self._kind), place=where)

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front; a step has the same place however many are shown."""
        pen = self.pen
        title, room = self.headed(1.6)
        told = [self._wrapped(f"{n}  {step.words}", room.width) for n, step in enumerate(self.every, 1)]
        area = room._replace(height=room.height - sum(map(len, told)) * _LINE * pen.small)
        marks = [mark for step in self.every for mark in step.marks]
        view = view_of(box_of(marks), area)
        shown = [mark for step in self.every[: self.steps] for mark in step.marks]
        yield from construction_items(shown, view, area, pen)
        yield title
        for n, line in enumerate(chain.from_iterable(told[: self.steps])):
            yield Caption(line, (room.x, area.bottom + n * _LINE * pen.small), pen.small, pen.theme.ink)

    def _wrapped(self, text: str, width: float) -> list[str]:
        """Return a sentence in lines no wider than the page."""
        lines = [""]
        pieces = ((" " * (n == 0), part) for word in text.split(" ") for n, part in enumerate(unspaced(word)))
        for gap, piece in pieces:
            longer = f"{lines[-1]}{gap}{piece}" if lines[-1] else piece
            if lines[-1] and self.pen.type.width(longer, self.pen.small) > width:
                lines.append(f"    {piece}")
            else:
                lines[-1] = longer
        return lines


# The chart of a function generator's structural error: the curve, its extremes, the precision points.

_SAMPLES = 721
_ROOM = 0.16
_DASHES = (6.0, 4.0)
_LEVEL = 1e-3
"""A share of the largest error: extremes that differ by less count as equal."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@frozen
class ErrorChart(DrawnPage):
    """A chart of the structural error of a linkage over x; `size` is in pixels."""

    shown: Generated

    @property
    def title(self) -> str:
        """What it shows, in words."""
        return said(
            "Structural error of {function}, {kind}",
            function=self.shown.task.function.words,
            kind=said(self.shown.task.kind.name),
        )

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

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        pen, theme = self.pen, self.pen.theme
        power = math.floor(math.log10(self.shown.error)) if self.shown.error else 0
        unit = 10.0**power
        x, errors = self.curve
        function = self.shown.task.function
        title, below = self.headed()
        yield title
        y_axis = linear(*range_around(errors / unit, _ROOM), most=7)
        area = plot_area(below, y_axis, pen, foot=True)
        most = max(min(round(area.width / (5 * pen.small)), 12), 2)
        plot = Plot(area, linear(function.first, function.last, most=most), y_axis)
        yield from axes(plot, pen)
        scale = f" × 10{str(power).translate(_RAISED)}" if power else ""
        share = significant(100 * self.shown.error / abs(function.span), 2)
        words = said("error in y{scale}, {share} % of its range", scale=scale, share=share)
        yield Caption(words, (area.x, area.y - 1.4 * pen.small), pen.small, theme.ink)
        yield x_title(plot, "x", pen)
        foot = complex(plot.pixels(function.first, 0.0))
        yield Layer(theme.dim, segments(foot, foot + area.width, 0.6 * pen.line))
        if self._level:
            for height in (self.shown.error, -self.shown.error):
                ends = plot.pixels(np.array([function.first, function.last]), np.full(2, height / unit))
                yield line_layer([ends], theme.acceleration, pen.line, _DASHES)
        yield curve_layer(plot, x, errors / unit, theme.velocity, 1.2 * pen.line)
        fine = replace(pen, line=0.7 * pen.line)
        yield from dot(theme.ink, fine).at([complex(plot.pixels(at, 0.0)) for at in self.shown.points])
        yield from self._extremes(plot, unit)

    @property
    def _level(self) -> bool:
        """Whether as many extremes are equal as the choice of the lengths can make equal."""
        heights = [abs(error) for _, error in self.shown.extremes]
        return sum(height >= (1 - _LEVEL) * max(heights) for height in heights) >= FEWEST_POINTS + 1

    def _extremes(self, plot: Plot, unit: float) -> Iterator[Item]:
        pen = self.pen
        for x, error in self.shown.extremes:
            at = complex(plot.pixels(x, error / unit))
            yield from dot(pen.theme.velocity, pen).at([at])
            words = rounded(error / unit, 3)
            half = 0.5 * pen.type.width(words, pen.small)
            middle = min(max(at.real, plot.area.x + half), plot.area.right - half)
            top = at.imag - 1.6 * pen.small if error > 0 else at.imag + 0.5 * pen.small
            yield Caption(words, (middle, top), pen.small, pen.theme.ink, "centre")
