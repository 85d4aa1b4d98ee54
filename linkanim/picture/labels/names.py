"""Names on the picture: of joints and links, then their dimensions, each in one place for the whole cycle."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from math import ceil

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.figure import DrawSetting, Figure
from linkanim.picture.items import Caption, Halo
from linkanim.picture.labels.candidates import LabelSpots, Spots, Surroundings, stacked
from linkanim.picture.labels.dead_centres import DeadCentres
from linkanim.picture.labels.dimensions import Symbols
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.parts.dimension_lines import AngleArc, MeasureLine
from linkanim.picture.parts.turning import Turning
from linkanim.picture.placing import Placer
from linkanim.picture.raster.parts import Part, Places
from linkanim.picture.raster.raster import Colour, Layer, Loop
from linkanim.picture.text.text import subscripted
from linkanim.picture.view import Rect, View

_ROOM = 0.6
"""The part of a bar that its link's name may take."""
_HIGH = 0.94
"""The height of letters that are placed, in heights of their line."""
_UNSEEN = 0.05
_ENOUGH = 0.5
"""A name that shows for so much of it is preferred to a number."""
_LEAST_SHOWN = 0.2
"""A name that would show for less of the cycle is left out."""
_LEAST_AGAIN = 0.08
"""Likewise a name in one more place."""
_LEAST_MEASURED = 0.4
"""A dimension likewise: it then stands in the table."""
_ROW = 1.3
"""From row to row of the table, in heights of its text."""
_GRID = (9, 9)
"""So many places are tried for the table, across and down."""


@dataclass(frozen=True)
class Label:
    """A line of text with its place; what measures has its `symbol`, and maybe a line drawn with it.

    In the table it stands with what it is `about`.
    """

    text: str
    line: int
    """The height of its line."""
    colour: Colour
    size: tuple[float, float]
    """Of its letters in their halo."""
    symbol: str = ""
    about: str = ""
    spot: Spots | None = None
    shown: NDArray[np.float64] | None = None
    """How far it shows over the cycle, at equal steps of phase."""
    drawn: MeasureLine | AngleArc | None = None

    @property
    def row(self) -> str:
        """Its row in the table."""
        return f"{self.text}, {self.about}"


@dataclass(frozen=True)
class DimensionTable:
    """Rows of words beside the figure, in columns."""

    rows: tuple[Label, ...]
    columns: int
    rect: Rect
    size: int
    colour: Colour
    halo: Halo

    def captions(self) -> Iterator[Caption]:
        """Yield the rows, column by column."""
        deep, wide = ceil(len(self.rows) / self.columns), self.rect.width / self.columns
        for n, label in enumerate(self.rows):
            at = self.rect.x + n // deep * wide, self.rect.y + n % deep * _ROW * self.size
            yield Caption(label.row, at, self.size, self.colour, strong=True, halo=self.halo)


@dataclass(frozen=True)
class Names:
    """All labels of a picture, in their halo, and a table of what is not on the picture all the time."""

    labels: tuple[Label, ...]
    period: float
    bar: float
    halo: Halo
    table: DimensionTable | None = None
    unlisted: tuple[Label, ...] = ()
    """Rows for which there is no room."""
    scale: float = 1.0

    def captions(self, pose: Pose, places: Places) -> list[Caption]:
        """Return every label that shows, as a line of text, and the table."""
        found = [*self.table.captions()] if self.table else []
        for label, middle, shown in self.standing(pose, places):
            if shown > _UNSEEN:
                at = (middle.real, middle.imag - 0.5 * label.line)
                found.append(
                    Caption(label.text, at, label.line, label.colour, "centre", True, self.halo, shown)
                )
        return found

    def standing(self, pose: Pose, places: Places) -> Iterator[tuple[Label, complex, float]]:
        """Yield every label with its middle in pixels, and how far it shows (0 to 1)."""
        if not self.labels:
            return
        spots, sides = self._stacked
        frames = [(label.spot.at, label.spot.head) for label in self.labels if label.spot]
        at = np.array([places[name] for name, _ in frames])
        span = [places[head] - places[name] if head != name else self.scale for name, head in frames]
        middles: Loop = spots.middles(at, span, sides, self.bar)
        yield from zip(self.labels, middles.tolist(), self._shown(pose.phase), strict=True)

    def lines(self, pose: Pose, places: Places, parts: Mapping[str, Part]) -> Iterator[Layer]:
        """Yield the dimension lines that show, of `parts` by their symbols."""
        for label, shown in zip(self.labels, self._shown(pose.phase), strict=True) if parts else ():
            if label.drawn and shown > _UNSEEN:
                layers = parts[label.symbol].placed(places)
                yield from (layer._replace(alpha=shown * layer.alpha) for layer in layers)

    def parts(self, figure: Figure, view: View, gauge: Gauge, colour: Colour) -> dict[str, Part]:
        """Return the dimension lines in a view, by their symbols."""
        found = {}
        for label in self.labels:
            if label.drawn:
                at, head = map(figure.start, label.drawn.frame)
                span = view.scale * (abs(head - at) if label.drawn.frame[0] != label.drawn.frame[1] else 1.0)
                found[label.symbol] = label.drawn.part(span, gauge, colour)
        return found

    def measuring(self, known: Symbols | None, unit: str, scale: float) -> Names:
        """Return the labels in their places in a view of this scale, with the lengths as they are now."""
        values = {one.symbol: one.written(unit) for one in known.dimensions} if known else {}
        table = self.table and replace(self.table, rows=_reread(self.table.rows, values))
        return replace(self, labels=_reread(self.labels, values), table=table, scale=scale)

    def _shown(self, phase: float) -> list[float]:
        """Return how far each label shows at a phase."""
        steps = [label.shown for label in self.labels if label.shown is not None]
        count = max(map(len, steps), default=1)
        share = phase / self.period % 1.0 * count
        first, part = int(share), share % 1.0
        return [
            float(shown[first % len(shown)] * (1 - part) + shown[(first + 1) % len(shown)] * part)
            for shown in steps
        ]

    @cached_property
    def _stacked(self) -> tuple[Spots, NDArray[np.complex128]]:
        """The labels' spots, and their sides (w + hi)."""
        spots = stacked([label.spot for label in self.labels if label.spot])
        return spots, np.array([complex(*label.size) for label in self.labels])


def _reread(labels: Iterable[Label], values: Mapping[str, str]) -> tuple[Label, ...]:
    """Return labels with the lengths as they are now, by their symbols."""
    return tuple(replace(label, text=values.get(label.symbol, label.text)) for label in labels)


def _joint_size(layout: Layout) -> int:
    """Return the height of a joint's name."""
    return max(round(20 * layout.unit), 12)


def _halo(setting: DrawSetting) -> Halo:
    """Return what parts letters from what is below."""
    return Halo(setting.theme.background, max(1.4 * setting.gauge.line, 1.5))


def _label(
    setting: DrawSetting, text: str, line: int, colour: Colour, symbol: str = "", about: str = ""
) -> Label:
    """Return a line of text that has no place yet."""
    around = 2 * _halo(setting).width
    wide = setting.type.width(text, line, strong=True)
    return Label(text, line, colour, (wide + around, _HIGH * line + around), symbol, about)


Form = tuple[Label, LabelSpots]
Forms = Iterator[tuple[Form, ...]]
"""Labels, each in the forms that it may have, the best first."""


def names_of(
    ground: Surroundings, setting: DrawSetting, known: Symbols | None, dead_centres: DeadCentres | None
) -> Generator[None, None, Names]:
    """Place the names of joints and links; where the symbols are known, dimensions and input's angle, too.

    Lengths that do not stand on the picture at all times go into a table. Each place that is looked for is a
    step.
    """
    fixed, shown = ground.figure.fixed, ground.figure.shown
    moving = [name for name in shown if name not in fixed]
    planned = [_joints(ground, setting, fixed), _links(ground, setting)]
    planned += [_dimensions(ground, setting, known), _angle(ground, setting, known)] if known else []
    planned += [_dead_centres(ground, setting, dead_centres)] if dead_centres else []
    placer, kept, left = Placer(ground.clutter()), [], []
    for forms in chain(*planned, _joints(ground, setting, moving)):
        placed, (label, _) = (yield from _placed(placer, forms)), forms[0]
        kept += placed
        if label.about and not any(one.shown is not None and one.shown.all() for one in placed):
            left.append(label)
    rows, found = tuple(left), (ground.figure.scene.period, setting.gauge.bar, _halo(setting))
    table = (yield from _tabled(ground, setting, placer, rows)) if rows else None
    return Names(tuple(kept), *found, table, () if table else rows, ground.view.scale)


def _placed(placer: Placer, forms: tuple[Form, ...]) -> Generator[None, None, list[Label]]:
    """Return a label in its place; a name again in another for the time at which it cannot be there."""
    found: list[Label] = []
    but = None
    measures = bool(forms[0][0].about)
    for least in (_LEAST_MEASURED,) if measures else (_LEAST_SHOWN, _LEAST_AGAIN, _LEAST_AGAIN):
        yield
        enough = 1.0 if measures else _ENOUGH
        which, placed = placer.first([spots.candidates for _, spots in forms], enough, least=least, but=but)
        label, spots = forms[which]
        forms = forms[which : which + 1] if placed.shown.any() else forms
        if placed.shown.any():
            number = -1 if spots.candidates.drawn is None else int(spots.candidates.drawn[placed.which])
            drawn = spots.lines[number] if number >= 0 else None
            spot = spots.spots.picked(placed.which)
            found.append(replace(label, spot=spot, shown=placed.shown, drawn=drawn))
        but = placed.shown > 0 if but is None else but | (placed.shown > 0)
        nowhere = least == _LEAST_AGAIN and not placed.shown.any()  # nor would it be a second time
        if nowhere or but.all():
            break
    return found


def table_width(rows: Iterable[str], setting: DrawSetting) -> float:
    """Return how wide a column of the table is."""
    size = setting.layout.small_size
    return max(setting.type.width(row, size, strong=True) for row in rows) + 1.2 * size


def _tabled(
    ground: Surroundings, setting: DrawSetting, placer: Placer, rows: tuple[Label, ...]
) -> Generator[None, None, DimensionTable | None]:
    """Return the table where it has been given room, or where there is some; None where there is none."""
    size, strip = setting.layout.small_size, setting.layout.table
    wide = table_width((label.row for label in rows), setting)
    if strip:
        fits = (
            (columns, small)
            for small in range(size, 0, -1)
            for columns in [max(int(strip.width / (wide * small / size)), 1)]
            if ceil(len(rows) / columns) * _ROW * small <= strip.height or small == 1
        )
        columns, small = next(fits)
        rect = strip._replace(width=columns * wide * small / size)
        return DimensionTable(rows, columns, rect, small, setting.theme.dim, _halo(setting))
    stage = setting.layout.stage.inset(setting.layout.margin)
    for columns in range(1, len(rows) + 1):
        around = complex(columns * wide, ceil(len(rows) / columns) * _ROW * size)
        first, room = complex(stage.x, stage.y) + around / 2, complex(stage.width, stage.height) - around
        if room.real > 0 and room.imag > 0:
            yield
            across, down = (np.linspace(0, 1, count) for count in _GRID)
            grid = first + np.add.outer(across * room.real, 1j * down * room.imag)
            outer = np.add.outer(np.minimum(across, 1 - across), np.minimum(down, 1 - down)).ravel()
            order = outer.argsort(kind="stable")
            spots = ground.still(grid.ravel()[order], (around.real, around.imag)).candidates
            _, placed = placer.first([spots], least=1.0)
            if placed.shown.all():
                corner = complex(spots.places[0, placed.which]) - around / 2
                rect = Rect(corner.real, corner.imag, around.real, around.imag)
                return DimensionTable(rows, columns, rect, size, setting.theme.dim, _halo(setting))
    return None


def _joints(ground: Surroundings, setting: DrawSetting, names: Iterable[str]) -> Forms:
    """Yield joints' names."""
    for name in names:
        label = _label(setting, subscripted(name), _joint_size(setting.layout), setting.theme.ink)
        yield ((label, ground.around(name, label.size)),)


def _links(ground: Surroundings, setting: DrawSetting) -> Forms:
    """Yield the links' names, their numbers where there is no room for those."""
    links, size = ground.figure.links, setting.layout.small_size
    for body, number in ground.figure.numbers.items():
        words = (links[body], number) if _long_enough(ground, setting, body) else (number,)
        labels = [_label(setting, text, size, setting.theme.ink) for text in dict.fromkeys(words)]
        if body.slider:
            yield tuple((label, ground.around(body.slider, label.size, slider=True)) for label in labels)
        elif len(body.joints) > 1:
            yield tuple((label, ground.on(body, label.size)) for label in labels)


def _long_enough(ground: Surroundings, setting: DrawSetting, body: Body) -> bool:
    """Return whether a link has room for its name."""
    if len(body.joints) < 2:
        return True
    one, other = map(ground.figure.start, body.joints[:2])
    name = ground.figure.links[body]
    wide = setting.type.width(name, setting.layout.small_size, strong=True)
    return wide < _ROOM * ground.view.scale * abs(other - one)


def _angle(ground: Surroundings, setting: DrawSetting, known: Symbols) -> Forms:
    """Yield the input's angle at its pivot."""
    if isinstance(ground.turning, Turning):
        label = _label(setting, known.input, _joint_size(setting.layout), setting.theme.dim)
        yield ((label, ground.by_arc(ground.turning, label.size)),)


def _dead_centres(ground: Surroundings, setting: DrawSetting, found: DeadCentres) -> Forms:
    """Yield the words at a slider's dead centres."""
    for text, places in found.words():
        label = _label(setting, text, setting.layout.small_size, setting.theme.dim)
        yield ((label, ground.still(places(label.size), label.size)),)


def _dimensions(ground: Surroundings, setting: DrawSetting, known: Symbols) -> Forms:
    """Yield the lengths and angles beside what they measure, those of the ground first."""
    unit, size = ground.figure.scene.length_unit, setting.layout.small_size
    for one in known.dimensions:
        label = _label(setting, one.written(unit), size, setting.theme.dim, one.symbol, one.about)
        yield tuple((label, spots) for spots in ground.dimension(one, label.size))
