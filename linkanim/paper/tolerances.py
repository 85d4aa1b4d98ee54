"""How far a quantity may be off over a period as a chart: all lengths together, and each alone."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from linkanim.export import csv_head, csv_rows
from linkanim.frozen import frozen
from linkanim.paper.illustration import DrawnPage, LegendEntry, legend
from linkanim.picture.chart import Plot, axes, curve_layer, dot, plot_area, x_title
from linkanim.picture.items import Caption, Item
from linkanim.picture.quantities import linear
from linkanim.scenes.deviation import Off, Tolerance
from linkanim.units import significant
from linkanim.words import name_said, said, sentences

_DASHES = ((), (7.0, 3.0), (2.0, 2.5), (9.0, 3.0, 2.0, 3.0))
"""Of the lengths that are drawn alone, those that matter most."""


@frozen
class ToleranceChart(DrawnPage):
    """A chart of how far the first quantity of a scene may be off, over a period; `size` is in pixels."""

    shown: Tolerance

    @property
    def off(self) -> Off:
        """The quantity that is shown."""
        return self.shown.quantities[0]

    @property
    def unit(self) -> str:
        """The unit of what is shown."""
        return "deg" if self.off.is_angle else self.shown.scene.length_unit

    @property
    def title(self) -> str:
        """What it shows, in words."""
        scene, off = self.shown.scene, self.off
        by = f"{significant(self.shown.by, 4)} {scene.length_unit}"
        return said(
            "How far {part} may be off, each length by {by}: {title}",
            part=name_said(off.name),
            by=by,
            title=said(scene.title),
        )

    @property
    def words(self) -> str:
        """What is seen in it, in a paragraph."""
        off, phase = self.off, math.degrees(self.off.worst_phase or 0.0)
        known = {"most": self._in_words(off.worst), "phase": significant(phase, 3)}
        first = said("At most {most}, at a phase of {phase}°, to first order.", **known)
        if off.likely > 0:
            first = said(
                "At most {most}, at a phase of {phase}°, to first order; 95 in 100 linkages stay within "
                "{likely}.",
                **known,
                likely=self._in_words(off.likely),
            )
        chief = self._in_words(float(off.by.max()))
        return sentences(
            first, said("{length} matters most: {by}.", length=name_said(self.shown.most(off)), by=chief)
        )

    def _in_words(self, value: float) -> str:
        return f"{significant(self._scale * value, 3)} {self.unit}"

    @property
    def _scale(self) -> float:
        """What turns values into the unit shown."""
        return 180 / math.pi if self.off.is_angle else 1.0

    def csv(self) -> str:
        """Return the curves as a table: the phase in degrees, all lengths together, each alone."""
        names = ["phase_deg", "all", *self.shown.lengths]
        return csv_head(names) + csv_rows([np.degrees(self.off.phases), self.off.bound, *self.off.alone])

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        pen, theme, off = self.pen, self.pen.theme, self.off
        title, below = self.headed()
        yield title
        phases = np.append(np.degrees(off.phases), math.degrees(self.shown.scene.period))
        bound = self._scale * np.append(off.bound, off.bound[0])
        alone = self._scale * np.column_stack([off.alone, off.alone[:, 0]])
        y_axis = linear(0.0, 1.12 * float(bound.max()), most=7)
        area = plot_area(below, y_axis, pen, foot=True)
        plot = Plot(area, linear(0.0, float(phases[-1]), most=13, unit="°"), y_axis)
        yield from axes(plot, pen)
        dots = said(
            "in {unit}; dots: 95 in 100 linkages stay below the lower, all of 10,000 below the upper",
            unit=self.unit,
        )
        yield Caption(dots, (area.x, area.y - 1.4 * pen.small), pen.small, theme.ink)
        yield x_title(plot, said("phase"), pen)
        strokes = [LegendEntry(said("all lengths"), theme.velocity, 1.6)]
        for n, dashes in zip(np.argsort(-off.by), _DASHES, strict=False):
            strokes.append(LegendEntry(name_said(self.shown.lengths[n]), theme.acceleration, 1.0, dashes))
            yield curve_layer(plot, phases, alone[n], theme.acceleration, pen.line, dashes)
        yield curve_layer(plot, phases, bound, theme.velocity, 1.6 * pen.line)
        yield from legend(area.x, x_title(plot, "", pen).at[1], strokes, pen)
        where = math.degrees(off.worst_phase or 0.0)
        drawn = [complex(plot.pixels(where, self._scale * one)) for one in (off.likely, off.greatest)]
        yield from dot(theme.ink, pen).at([one for one in drawn if math.isfinite(one.imag)])
