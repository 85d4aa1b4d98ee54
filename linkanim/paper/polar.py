"""Draw a vector round a turn as a polar diagram, the curve of its head: as a bearing's force is drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import BadInput
from linkanim.export import csv_head, csv_rows
from linkanim.frozen import frozen
from linkanim.mechanics.quantities import Quantity
from linkanim.paper.curves import Pace
from linkanim.paper.illustration import DrawnPage, LegendEntry
from linkanim.picture.chart import Plot, axes, dot, line_layer, x_title
from linkanim.picture.items import Caption, Halo, Item
from linkanim.picture.quantities import Axis, input_at, linear, quantity, range_around, turned_words
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import arrows, segments
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene
from linkanim.units import stepped
from linkanim.words import said, sentences

_SAMPLES, _EVERY = 720, 60
"""How many points a curve has for each turn of the drive, and how many from one dot to the next: 30°."""
_ROOM, _NARROWEST = 0.1, 0.6
"""The room about the curves, in shares of their extent, and the least width, in shares of the height."""
_NAMED = 3
"""Every so many dots one has its angle beside it."""
_DASHES = ((), (7.0, 3.0), (2.0, 2.5), (9.0, 3.0, 2.0, 3.0))

Floats = NDArray[np.float64]


class _Head(NamedTuple):
    """The curve of a vector's head at one speed: its components, infinite where it is not bounded."""

    pace: Pace
    x: Floats
    y: Floats

    @property
    def bounded(self) -> NDArray[np.bool_]:
        """Which of its points are."""
        return np.isfinite(self.x) & np.isfinite(self.y)

    def within(self, plot: Plot) -> NDArray[np.bool_]:
        """Return which of its points lie in a plot."""
        x, y = plot.x, plot.y
        return (self.x >= x.low) & (self.x <= x.high) & (self.y >= y.low) & (self.y <= y.high)


@frozen
class PolarPage(DrawnPage):
    """A polar diagram of a vector quantity over one true period; `size` is in pixels."""

    scene: Scene
    token: str
    paces: tuple[Pace, ...]

    @cached_property
    def known(self) -> tuple[Quantity, Quantity, Quantity]:
        """The vector, and its two components; BadInput for a quantity that is no vector."""
        whole = quantity(self.scene, self.token)
        parts = [self.scene.quantities.get(f"{whole.token}.{axis}") for axis in "xy"]
        if None in parts:
            reason = "is no vector, so it has no polar diagram; take a force in a joint, such as"
            tokens = (
                token for token in self.scene.quantities if token.endswith(".force") and token.count(".")
            )
            example = next(
                tokens, next(token for token in self.scene.quantities if token.endswith(".velocity"))
            )
            raise BadInput(f"--polar: {self.token} {reason} {example}")
        x, y = (part for part in parts if part)
        return whole, x, y

    @cached_property
    def phases(self) -> Floats:
        """The phases of the curves' points, one true period and its end."""
        turns = self.scene.period / math.tau
        return np.linspace(0.0, self.scene.period, round(_SAMPLES * turns) + 1)

    @cached_property
    def heads(self) -> tuple[_Head, ...]:
        """The curves, one at each speed."""
        _, x, y = self.known
        motions = ((pace, pace.motion(self.scene, self.phases)) for pace in self.paces)
        return tuple(
            _Head(pace, *(np.asarray(part.read(motion), float) for part in (x, y)))
            for pace, motion in motions
        )

    @property
    def title(self) -> str:
        """What it shows, in words."""
        return said(
            "{title}: {quantity}, polar diagram", title=said(self.scene.title), quantity=self.known[0].words
        )

    @property
    def words(self) -> str:
        """Where the vector is largest."""
        largest = (self._largest(head)[1] for head in self.heads)
        return sentences(*(said("{found}.", found=words) for words in largest if words))

    def csv(self) -> str:
        """Return the curves as a table: phase, the input, both components at each speed."""
        motion = self.paces[0].motion(self.scene, self.phases)
        names = ["phase", self.scene.linkage.drive.coordinate.name]
        columns: list[Floats] = [self.phases, np.asarray(motion.coordinate)]
        for head in self.heads:
            more = f" at {head.pace.words}" if len(self.heads) > 1 else ""
            names += [f"{self.known[0].token}.{axis}{more}" for axis in "xy"]
            columns += [head.x, head.y]
        return csv_head(names) + csv_rows(columns)

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""
        pen, theme = self.pen, self.pen.theme
        title, below = self.headed(1.6)
        yield title
        plot = self._plot(below)
        yield from axes(plot, pen)
        across, up = (part.headed(self.scene.length_unit) for part in self.known[1:])
        yield x_title(plot, across, pen)
        yield Caption(up, (plot.area.x, plot.area.y - 1.4 * pen.small), pen.small, theme.ink)
        if plot.x.low < 0.0 < plot.x.high:
            foot = complex(plot.pixels(0.0, plot.y.low))
            yield Layer(theme.dim, segments([foot], [foot - 1j * plot.area.height], 0.8 * pen.line))
        for n, head in enumerate(self.heads):
            yield from self._curve(plot, head, n)
        yield from self._size_words(plot, below)

    def _plot(self, below: Rect) -> Plot:
        """Return the plot, with one scale across and up and the origin in it."""
        pen = self.pen
        ranges, bounded = [], np.concatenate([head.bounded for head in self.heads])
        for part in ("x", "y"):
            values = np.concatenate([getattr(head, part) for head in self.heads])
            low, high = range_around(np.where(bounded, values, np.inf), _ROOM)
            ranges.append((min(low, -_ROOM * high), max(high, -_ROOM * low)))
        left, foot = 4.5 * pen.small, 3.0 * pen.small
        area = Rect(
            below.x + left,
            below.y + 1.6 * pen.small,
            max(below.width - left - pen.small, 1),
            max(below.height - foot - 1.6 * pen.small - len(self.heads) * 1.5 * pen.small, 1),
        )
        spans = [high - low for low, high in ranges]
        scale = min(area.width / spans[0], area.height / spans[1])
        curves = []
        wide = min(area.width, max(scale * spans[0], _NARROWEST * area.height))
        area = area._replace(x=area.x + (area.width - wide) / 2, width=wide)
        for (low, high), room in zip(ranges, (area.width, area.height), strict=True):
            more = (room / scale - (high - low)) / 2
            curves.append((low - more, high + more))
        most = max(min(round(area.width / (5 * pen.small)), 12), 2)
        x: Axis = linear(*curves[0], most=most)
        return Plot(area, x, linear(*curves[1], most=max(most * area.height / area.width, 2).__ceil__()))

    def _colour(self, n: int) -> Colour:
        theme = self.pen.theme
        return (theme.force, theme.velocity, theme.acceleration, *theme.traces[1:])[n % 5]

    def _curve(self, plot: Plot, head: _Head, n: int) -> Iterator[Item]:
        """Yield a curve, dots along it with angles, and an arrow to where the vector is largest."""
        pen, colour = self.pen, self._colour(n)
        places = plot.pixels(head.x, head.y)
        inside = head.bounded & head.within(plot)
        runs = np.split(places, np.flatnonzero(~inside))
        lines = [run[1:] if k else run for k, run in enumerate(runs)]
        yield line_layer([line for line in lines if len(line) > 1], colour, 1.2 * pen.line, _DASHES[n % 4])
        at, _ = self._largest(head)
        if at is not None and n == 0:
            origin, tip = complex(plot.pixels(0.0, 0.0)), complex(places[at])
            yield Layer(colour, arrows([origin], [tip - origin], pen.line))
        marks = [k for k in range(0, len(places) - 1, _EVERY) if inside[k]]
        yield from dot(colour, replace(pen, line=0.6 * pen.line)).at([complex(places[k]) for k in marks])
        if n == 0:
            yield from self._angles(plot, places, [k for k in marks if k // _EVERY % _NAMED == 0])

    def _angles(self, plot: Plot, places: NDArray[np.complex128], marks: list[int]) -> Iterator[Item]:
        """Yield the input's place beside dots, outside the curve."""
        pen = self.pen
        middle = complex(np.mean(places[np.isfinite(places)]))
        coordinate = np.asarray(self.paces[0].motion(self.scene, self.phases).coordinate)
        taken: list[Rect] = []
        for k in marks:
            at = complex(places[k])
            across = 1j * complex(places[(k + 1) % len(places)] - places[k - 1])
            away = across.real * (at - middle).real + across.imag * (at - middle).imag
            way = math.copysign(1.0, away) * across / abs(across) if across and np.isfinite(across) else 1.0
            words = turned_words(self.scene, float(coordinate[k])).replace(".0°", "°")
            wide = pen.type.width(words, pen.small)
            spot = at + way * (0.9 * pen.small) + complex(way.real * wide / 2, 0.0)
            halo = Halo(pen.theme.background, 0.2 * pen.small)
            corner = (spot.real, spot.imag - 0.5 * pen.small)
            box = Rect(corner[0] - wide / 2, corner[1], wide, pen.small)
            if any(box.meets(other) for other in taken):
                continue  # near the origin angles crowd, and those beside them say which way they go
            taken.append(box)
            yield Caption(words, corner, pen.small, pen.theme.ink, "centre", halo=halo)

    def _largest(self, head: _Head) -> tuple[int | None, str]:
        """Return which point of a curve is farthest out, and that in words; None where it is not bounded."""
        sizes = np.hypot(head.x, head.y)
        if not np.isfinite(sizes).all():
            return None, said("{quantity} is unbounded", quantity=self.known[0].words)
        k = int(sizes.argmax())
        motion = head.pace.motion(self.scene, self.phases[k : k + 1])
        place = float(np.asarray(motion.coordinate)[0])
        unit = self.known[0].display_unit(self.scene.length_unit)
        largest = float(sizes[k])
        shown = f"{stepped(largest, largest / 2000)} {unit}"
        return k, said("greatest {value} at {place}", value=shown, place=input_at(self.scene, place))

    def _size_words(self, plot: Plot, below: Rect) -> Iterator[Item]:
        """Yield below the diagram how large the vector gets, at each speed."""
        pen = self.pen
        top = plot.area.bottom + 3.0 * pen.small
        for n, head in enumerate(self.heads):
            words = said("{label}: {words}", label=head.pace.words, words=self._largest(head)[1])
            entry = LegendEntry(words, self._colour(n), 1.2, _DASHES[n % 4])
            yield from entry.items(below.x, top + 1.5 * n * pen.small, pen)
