"""Names on the picture: of joints and links, then their dimensions, placed for the whole cycle at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pygame

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.figure import Figure
from linkanim.picture.items import Caption, Halo
from linkanim.picture.labels.dimensions import Symbols, numbered, written
from linkanim.picture.labels.placing import Drift, Wish, place
from linkanim.picture.labels.whereabouts import Whereabouts
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.parts.turning import Turning
from linkanim.picture.raster.parts import Places
from linkanim.picture.raster.raster import Colour
from linkanim.picture.raster.shapes import unit
from linkanim.picture.text.lettering import Lettering
from linkanim.picture.text.text import Type, subscripted
from linkanim.picture.theme import Theme
from linkanim.picture.view import View

_ROOM = 0.6
"""The part of a bar that its link's name may take."""
_UNSEEN = 0.05
_LEAST_SHOWN = 0.4
"""A label that would show for less of the cycle is left out."""


@dataclass(frozen=True)
class Tag:
    """A label about to be placed: its words and where it would like to stand.

    It rests in the frame of the joint `at`, which turns with the direction to `head` where that is another.
    """

    lettering: Lettering
    at: str
    head: str
    wish: Wish
    across: bool = False
    """Whether it has a place on a plate, not by a bar."""


@dataclass(frozen=True)
class Label:
    """A label with its place over the cycle.

    It was placed for a distance of `length` pixels from `at` to `head`. Where that is another, as in an
    enlarged view, its place moves along by as much, and across where it lies on a plate and not by a bar.
    """

    lettering: Lettering
    at: str
    head: str
    path: Drift
    length: float
    across: bool

    def placed(self, share: float, places: Places) -> tuple[complex, float]:
        """Return its middle in pixels at a share of the cycle, and how far it shows (0 to 1)."""
        offset, shown = self.path.at(share)
        return self.standing(complex(offset), float(shown), places)

    def standing(self, offset: complex, shown: float, places: Places) -> tuple[complex, float]:
        """Return its middle in pixels at a place of its path, and how far it shows (0 to 1)."""
        span = places[self.head] - places[self.at]
        if self.length:
            scale = abs(span) / self.length
            offset = unit(span) * complex(scale * offset.real, (scale if self.across else 1) * offset.imag)
        return places[self.at] + offset, shown if shown > _UNSEEN else 0.0


@dataclass(frozen=True)
class Names:
    """All labels of a picture."""

    labels: tuple[Label, ...]
    period: float

    def draw(self, surface: pygame.Surface, pose: Pose, places: Places) -> None:
        """Draw every label; changes the surface only."""
        for label, middle, shown in self._standing(pose, places):
            if shown:
                label.lettering.draw(surface, middle, shown)

    def captions(self, pose: Pose, places: Places) -> list[Caption]:
        """Return every label that shows, as a line of text in its halo."""
        found = []
        for label, middle, shown in self._standing(pose, places):
            words = label.lettering
            at = (middle.real, middle.imag - words.drop)
            if shown > 0.5:
                halo = Halo(*words.halo)
                found.append(Caption(words.text, at, words.line_height, words.ink, "centre", True, halo))
        return found

    def _standing(self, pose: Pose, places: Places) -> Iterator[tuple[Label, complex, float]]:
        """Yield every label with its middle in pixels, and how far it shows."""
        if not self.labels:
            return
        offsets, showings = self._paths.at(pose.phase / self.period)
        for label, offset, shown in zip(self.labels, offsets.tolist(), showings.tolist(), strict=True):
            yield label, *label.standing(offset, shown, places)

    @cached_property
    def _paths(self) -> Drift:
        """All paths in one."""
        offsets, showings = zip(*(label.path for label in self.labels), strict=True)
        return Drift(np.stack(offsets, axis=-1), np.stack(showings, axis=-1))


@dataclass(frozen=True)
class Hand:
    """What labels are written with."""

    type: Type
    layout: Layout
    theme: Theme
    gauge: Gauge

    @property
    def joint_size(self) -> int:
        """The height of a joint's name."""
        return max(round(20 * self.layout.unit), 12)

    def written(self, text: str, size: int, colour: Colour) -> Lettering:
        """Return a line of text in its halo."""
        halo = max(1.4 * self.gauge.line, 1.5)
        return Lettering(text, self.type, size, (colour, self.theme.background), halo)

    def measure(self, symbol: str, value: float, unit_: str) -> Lettering:
        """Return a length with its symbol."""
        return self.written(written(symbol, value, unit_), self.layout.small_size, self.theme.dim)


def names_of(figure: Figure, view: View, hand: Hand, turning: Turning | None, known: Symbols | None) -> Names:
    """Place the names of joints and links; where the symbols are known, dimensions and input's angle, too."""
    ground = Whereabouts(figure, view, hand.gauge, hand.layout)
    tags = [*_joints(ground, hand), *_links(ground, hand)]
    if known:
        tags += [*_angle(ground, hand, turning, known), *_dimensions(ground, hand, known)]
    paths = place([tag.wish for tag in tags], ground.clutter())
    labels = [
        Label(tag.lettering, tag.at, tag.head, path, ground.apart(tag.at, tag.head), tag.across)
        for tag, path in zip(tags, paths, strict=True)
        if path.shown.mean() >= _LEAST_SHOWN
    ]
    return Names(tuple(labels), figure.scene.period)


def _joints(ground: Whereabouts, hand: Hand) -> Iterator[Tag]:
    """Yield the joints' names, those that stand still first."""
    figure = ground.figure
    for name in sorted(figure.shown, key=lambda name: name not in figure.fixed):
        lettering = hand.written(subscripted(name), hand.joint_size, hand.theme.ink)
        yield Tag(lettering, name, name, ground.around(name, lettering.size))


def _links(ground: Whereabouts, hand: Hand) -> Iterator[Tag]:
    """Yield the links' names, on their bars where there is room."""
    named = _long_enough(ground, hand)
    for body, number in numbered(ground.figure).items():
        lettering = hand.written(
            ground.figure.links[body] if named else number, hand.layout.small_size, hand.theme.ink
        )
        if body.slider:
            yield Tag(lettering, body.slider, body.slider, ground.by_slider(body.slider, lettering.size))
        elif len(body.joints) > 1:
            first, second = body.joints[:2]
            yield Tag(lettering, first, second, ground.on(body, lettering.size), len(body.joints) > 2)


def _long_enough(ground: Whereabouts, hand: Hand) -> bool:
    """Return whether every bar has room for its link's name; else all are called by their numbers."""
    start, size = ground.figure.start, hand.layout.small_size
    return all(
        hand.type.width(name, size, strong=True)
        < _ROOM * ground.view.scale * abs(start(body.joints[1]) - start(body.joints[0]))
        for body, name in ground.figure.links.items()
        if len(body.joints) > 1
    )


def _angle(ground: Whereabouts, hand: Hand, turning: Turning | None, known: Symbols) -> Iterator[Tag]:
    """Yield the input's angle at its pivot."""
    if turning:
        lettering = hand.written(known.input, hand.joint_size, hand.theme.dim)
        yield Tag(lettering, turning.pivot, turning.pivot, ground.by_arc(turning, lettering.size))


def _dimensions(ground: Whereabouts, hand: Hand, known: Symbols) -> Iterator[Tag]:
    """Yield the lengths beside what they measure."""
    unit_ = ground.figure.scene.length_unit
    for symbol, begin, end, value in known.dimensions:
        lettering = hand.measure(symbol, value, unit_)
        yield Tag(lettering, begin, end, ground.beside(begin, end, lettering.size))
    for symbols, point in known.legs:
        for which, (symbol, value) in enumerate(zip(symbols, point.at, strict=True)):
            if value:
                lettering = hand.measure(symbol, value, unit_)
                yield Tag(lettering, *point.on, ground.leg(point, which, lettering.size), across=True)
