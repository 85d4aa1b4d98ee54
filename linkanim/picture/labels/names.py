"""Names on the picture: of joints and links, then their dimensions, each in one place for the whole cycle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.figure import Figure
from linkanim.picture.items import Caption, Halo
from linkanim.picture.labels.candidates import LabelSpots, Spots, Surroundings, stacked
from linkanim.picture.labels.dimensions import Symbols, written
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.parts.turning import Turning
from linkanim.picture.placing import place
from linkanim.picture.raster.parts import Places
from linkanim.picture.raster.raster import Colour
from linkanim.picture.text.text import Type, subscripted
from linkanim.picture.theme import Theme
from linkanim.picture.view import View

_ROOM = 0.6
"""The part of a bar that its link's name may take."""
_HIGH = 0.94
"""The height of letters that are placed, in heights of their line."""
_UNSEEN = 0.05
_LEAST_SHOWN = 0.2
"""A label that would show for less of the cycle is left out."""


@dataclass(frozen=True)
class Label:
    """A line of text with its place; what measures a length has its `symbol`."""

    text: str
    line: int
    """The height of its line."""
    colour: Colour
    size: tuple[float, float]
    """Of its letters in their halo."""
    symbol: str = ""
    spot: Spots | None = None
    shown: NDArray[np.float64] | None = None
    """How far it shows over the cycle, at equal steps of phase."""


@dataclass(frozen=True)
class Names:
    """All labels of a picture, in their halo."""

    labels: tuple[Label, ...]
    period: float
    bar: float
    halo: Halo

    def captions(self, pose: Pose, places: Places) -> list[Caption]:
        """Return every label that shows, as a line of text."""
        found = []
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
        spots, sides, shown = self._stacked
        at, head = (
            np.array([places[joint] for joint in joints])
            for joints in zip(
                *((label.spot.at, label.spot.head) for label in self.labels if label.spot), strict=True
            )
        )
        middles = spots.middles(at, head, sides, self.bar)
        share = pose.phase / self.period % 1.0 * len(shown)
        first = int(share) % len(shown)
        now = shown[first] + (share % 1.0) * (shown[(first + 1) % len(shown)] - shown[first])
        yield from zip(self.labels, middles.tolist(), now.tolist(), strict=True)

    def measuring(self, known: Symbols | None, unit: str) -> Names:
        """Return the labels in their places, with the lengths as they are now."""
        values = dict(_lengths(known)) if known else {}
        labels = (
            replace(label, text=written(label.symbol, values[label.symbol], unit))
            if label.symbol in values
            else label
            for label in self.labels
        )
        return replace(self, labels=tuple(labels))

    @cached_property
    def _stacked(self) -> tuple[Spots, NDArray[np.complex128], NDArray[np.float64]]:
        """The labels' spots, their sides (w + hi), and how far they show (moments, labels)."""
        spots = stacked([label.spot for label in self.labels if label.spot])
        sides = np.array([complex(*label.size) for label in self.labels])
        return (
            spots,
            sides,
            np.stack([label.shown for label in self.labels if label.shown is not None], axis=1),
        )


def _lengths(known: Symbols) -> Iterator[tuple[str, float]]:
    """Yield the lengths of bodies and of points on them, by their symbols."""
    yield from ((length.symbol, length.value) for length in known.dimensions)
    for legs in known.legs:
        yield from zip(legs.symbols, legs.point.at, strict=True)


@dataclass(frozen=True)
class LabelStyle:
    """What labels are written with."""

    type: Type
    layout: Layout
    theme: Theme
    gauge: Gauge

    @property
    def joint_size(self) -> int:
        """The height of a joint's name."""
        return max(round(20 * self.layout.unit), 12)

    @property
    def halo(self) -> Halo:
        """What parts letters from what is below."""
        return Halo(self.theme.background, max(1.4 * self.gauge.line, 1.5))

    def label(self, text: str, line: int, colour: Colour, symbol: str = "") -> Label:
        """Return a line of text that has no place yet."""
        around = 2 * self.halo.width
        wide = self.type.width(text, line, strong=True)
        return Label(text, line, colour, (wide + around, _HIGH * line + around), symbol)

    def length(self, symbol: str, value: float, unit: str) -> Label:
        """Return a length with its symbol."""
        return self.label(written(symbol, value, unit), self.layout.small_size, self.theme.dim, symbol)


Unplaced = Iterator[tuple[Label, LabelSpots]]


def names_of(
    figure: Figure, view: View, style: LabelStyle, turning: Turning | None, known: Symbols | None
) -> Names:
    """Place the names of joints and links; where the symbols are known, dimensions and input's angle, too."""
    ground = Surroundings(figure, view, style.gauge, style.layout)
    still = figure.fixed
    moving = [name for name in figure.shown if name not in still]
    labels = [*_joints(ground, style, still), *_links(ground, style), *_joints(ground, style, moving)]
    if known:
        labels += [*_angle(ground, style, turning, known), *_dimensions(ground, style, known)]
    found = place([spots.candidates for _, spots in labels], ground.clutter())
    kept = tuple(
        replace(label, spot=spots.spots.picked(placed.which), shown=placed.shown)
        for (label, spots), placed in zip(labels, found, strict=True)
        if placed.shown.mean() >= _LEAST_SHOWN
    )
    return Names(kept, figure.scene.period, style.gauge.bar, style.halo)


def _joints(ground: Surroundings, style: LabelStyle, names: Iterable[str]) -> Unplaced:
    """Yield joints' names."""
    for name in names:
        label = style.label(subscripted(name), style.joint_size, style.theme.ink)
        yield label, ground.around(name, label.size)


def _links(ground: Surroundings, style: LabelStyle) -> Unplaced:
    """Yield the links' names, on their bars where there is room."""
    named, links = _long_enough(ground, style), ground.figure.links
    for body, number in ground.figure.numbers.items():
        label = style.label(links[body] if named else number, style.layout.small_size, style.theme.ink)
        if body.slider:
            yield label, ground.by_slider(body.slider, label.size)
        elif len(body.joints) > 1:
            yield label, ground.on(body, label.size)


def _long_enough(ground: Surroundings, style: LabelStyle) -> bool:
    """Return whether every bar has room for its link's name; else all are called by their numbers."""
    start, size = ground.figure.start, style.layout.small_size
    return all(
        style.type.width(name, size, strong=True)
        < _ROOM * ground.view.scale * abs(start(body.joints[1]) - start(body.joints[0]))
        for body, name in ground.figure.links.items()
        if len(body.joints) > 1
    )


def _angle(ground: Surroundings, style: LabelStyle, turning: Turning | None, known: Symbols) -> Unplaced:
    """Yield the input's angle at its pivot."""
    if turning:
        label = style.label(known.input, style.joint_size, style.theme.dim)
        yield label, ground.by_arc(turning, label.size)


def _dimensions(ground: Surroundings, style: LabelStyle, known: Symbols) -> Unplaced:
    """Yield the lengths beside what they measure."""
    unit = ground.figure.scene.length_unit
    for symbol, begin, end, value in known.dimensions:
        label = style.length(symbol, value, unit)
        yield label, ground.beside(begin, end, label.size)
    for symbols, point in known.legs:
        for which, (symbol, value) in enumerate(zip(symbols, point.at, strict=True)):
            if value:
                label = style.length(symbol, value, unit)
                yield label, ground.leg(point, which, label.size)
