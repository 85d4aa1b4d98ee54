"""What inertia does to the ground over a period, without and with counterweights, as a chart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import BadInput
from linkanim.export import csv_head, csv_rows
from linkanim.frozen import frozen
from linkanim.mechanics.balance import Shaken, balanced, counterweights, shaken
from linkanim.paper.illustration import DrawnPage, LegendEntry, legend
from linkanim.picture.chart import Plot, axes, curve_layer, plot_area, x_title
from linkanim.picture.items import Caption, Item
from linkanim.picture.quantities import linear, range_around
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene
from linkanim.units import significant
from linkanim.words import said, sentences, to_say

_DASHES = (6.0, 3.0)
_STRIPS = ((to_say("shaking force"), "N"), (to_say("shaking moment about the origin"), "N m"))

Floats = NDArray[np.float64]


@frozen
class BalanceChart(DrawnPage):
    """A four-bar's shaking force and moment of inertia at its own speed; `size` is in pixels."""

    scene: Scene

    @cached_property
    def both(self) -> tuple[Shaken, Shaken]:
        """What shakes the ground, without counterweights and with them; BadInput for what has none."""
        linkage, speed = self.scene.linkage, self.scene.linkage.drive.speed
        weights = counterweights(linkage)
        if not weights:
            why = "needs no counterweights" if weights == () else "is no four-bar whose coupler has a mass"
            raise BadInput(f"--balance: {self.scene.name} {why}, so there is nothing to compare")
        return shaken(linkage, speed), shaken(balanced(linkage, weights), speed)

    @property
    def title(self) -> str:
        """What it shows, in words."""
        return said(
            "{title}: what inertia does to the ground, without and with counterweights",
            title=said(self.scene.title),
        )

    @property
    def words(self) -> str:
        """How large both get, without and with counterweights."""
        pairs = zip(_STRIPS, self._in_words, strict=True)
        strips = (said("{label}: {words}", label=said(name), words=told) for (name, _), told in pairs)
        return sentences(*(said("{found}.", found=strip[:1].upper() + strip[1:]) for strip in strips))

    @property
    def _in_words(self) -> list[str]:
        told = []
        for n, (_, unit) in enumerate(_STRIPS):
            before, after = (one.greatest[n] for one in self.both)
            remaining = significant(after, 4) if after > 1e-9 * before else "0"
            told.append(
                said(
                    "at most {before} {unit} without counterweights, {after} {unit} with them",
                    before=significant(before, 4),
                    after=remaining,
                    unit=unit,
                )
            )
        return told

    def csv(self) -> str:
        """Return the curves as a table: the phase in degrees, force and moment without and with them."""
        names = ["phase_deg", "force", "moment", "force_balanced", "moment_balanced"]
        columns = [column for one in self.both for column in (one.force, one.moment)]
        return csv_head(names) + csv_rows([np.degrees(self.both[0].phases), *columns])

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        title, below = self.headed()
        yield title
        high = below.height / 2
        curves = [(one.force, one.moment) for one in self.both]
        for n, (name, unit) in enumerate(_STRIPS):
            strip = Rect(below.x, below.y + n * high, below.width, high)
            values = [curve[n] for curve in curves]
            yield from self._strip(
                strip,
                said("{label}: {words}", label=f"{said(name)} ({unit})", words=self._in_words[n]),
                values,
                foot=n == 1,
            )

    def _strip(self, rect: Rect, title: str, values: Sequence[Floats], *, foot: bool) -> Iterator[Item]:
        pen, theme = self.pen, self.pen.theme
        places = np.degrees(self.both[0].phases)
        low, high = range_around(np.concatenate(values), 0.08)
        y = linear(min(low, 0.0), max(high, 0.0), most=6)
        area = plot_area(rect, y, pen, foot=foot, left=4.5 * pen.small)
        plot = Plot(area, linear(0.0, math.degrees(self.scene.period), most=13, unit="°"), y)
        yield from axes(plot, pen)
        yield Caption(title, (area.x, area.y - 1.4 * pen.small), pen.small, theme.ink)
        strokes = (
            LegendEntry(said("without counterweights"), theme.force),
            LegendEntry(said("with them"), theme.velocity, dashes=_DASHES),
        )
        for curve, one in zip(values, strokes, strict=True):
            rows = np.append(places, math.degrees(self.scene.period)), np.append(curve, curve[0])
            yield curve_layer(plot, *rows, one.colour, one.width * pen.line, one.dashes)
        if foot:
            yield x_title(plot, said("phase"), pen)
            yield from legend(area.x, x_title(plot, "", pen).at[1], strokes, pen)
