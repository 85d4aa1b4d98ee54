"""Names on the picture: of joints and links, then their dimensions, placed for the whole cycle at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.mechanics.linkage import Body
from linkanim.mechanics.motion import Pose
from linkanim.picture.dimensions import Symbols, numbered, written
from linkanim.picture.figure import SAMPLES, Figure
from linkanim.picture.ground import away
from linkanim.picture.items import Caption, Halo
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.lettering import Lettering
from linkanim.picture.parts import Places
from linkanim.picture.placing import MOMENTS, Clutter, Drift, Obstacles, Wish, place
from linkanim.picture.raster import Colour, Loop
from linkanim.picture.shapes import hull, unit
from linkanim.picture.text import Type, subscripted
from linkanim.picture.theme import Theme
from linkanim.picture.turning import Turning
from linkanim.picture.view import View

_ALONG = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
"""Where along a bar its name may stand."""
_INSIDE = (0.3, 0.5, 0.65)
"""How far from a plate's middle to its corners and sides its name may stand."""
_BESIDE = 0.4
"""What a place beside a bar costs, where one on it is free."""
_FARTHER = 1.0
"""What a place farther from its joint costs."""
_BLOCK = 2.7
"""How far a slider's block reaches, in half widths of a bar."""
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


def names_of(figure: Figure, view: View, hand: Hand, turning: Turning | None, known: Symbols | None) -> Names:
    """Place the names of joints and links; where the symbols are known, dimensions and input's angle, too."""
    stage = _Stage(figure, view, hand, turning)
    tags = [*stage.joints(), *stage.links()]
    if known:
        tags += stage.dimensions(known)
    paths = place([tag.wish for tag in tags], stage.clutter())
    labels = [
        Label(tag.lettering, tag.at, tag.head, path, stage.length(tag), tag.across)
        for tag, path in zip(tags, paths, strict=True)
        if path.shown.mean() >= _LEAST_SHOWN
    ]
    return Names(tuple(labels), figure.scene.period)


class _Stage:
    """Where everything is, at each of the moments for which labels are placed."""

    def __init__(self, figure: Figure, view: View, hand: Hand, turning: Turning | None) -> None:
        self._figure, self._view, self._hand, self._turning = figure, view, hand, turning
        step = SAMPLES // MOMENTS
        self._paths: dict[str, Loop] = {
            name: np.nan_to_num(figure.path(name, view)[::step], nan=-1e6) for name in figure.shown
        }

    def length(self, tag: Tag) -> float:
        """Return how far apart the joints of a tag's frame are, 0 where it has one joint only."""
        return float(np.mean(np.abs(self._paths[tag.head] - self._paths[tag.at])))

    def joints(self) -> Iterator[Tag]:
        """Yield the joints' names, those that stand still first."""
        fixed = set(self._figure.fixed)
        size, ink = self._hand.joint_size, self._hand.theme.ink
        for name in sorted(self._figure.shown, key=lambda name: name not in fixed):
            lettering = self._hand.written(subscripted(name), size, ink)
            wish = self._around(name, lettering.size, self._radius(name))
            yield Tag(lettering, name, name, wish)

    def links(self) -> Iterator[Tag]:
        """Yield the links' names, on their bars where there is room."""
        size, ink = self._hand.layout.small_size, self._hand.theme.ink
        named = self._long_enough()
        for body, number in numbered(self._figure).items():
            lettering = self._hand.written(body.name if named else number, size, ink)
            if body.slider:
                wish = self._around(body.slider, lettering.size, self._radius(body.slider))
                yield Tag(lettering, body.slider, body.slider, wish)
            elif len(body.joints) > 1:
                first, second = body.joints[:2]
                yield Tag(lettering, first, second, self._on(body, lettering.size), len(body.joints) > 2)

    def _long_enough(self) -> bool:
        """Return whether every bar has room for its link's name; else all are called by their numbers."""
        return all(
            self._hand.type.width(body.name, self._hand.layout.small_size, strong=True)
            < _ROOM
            * self._view.scale
            * abs(self._figure.start(body.joints[1]) - self._figure.start(body.joints[0]))
            for body in self._figure.linkage.bodies
            if len(body.joints) > 1
        )

    def dimensions(self, known: Symbols) -> Iterator[Tag]:
        """Yield the lengths beside what they measure, and the input's angle at its pivot."""
        size, dim, figure = self._hand.layout.small_size, self._hand.theme.dim, self._figure
        unit_ = figure.scene.length_unit
        turning = self._hand.written(known.input, self._hand.joint_size, dim)
        if self._turning:
            pivot = self._turning.pivot
            yield Tag(turning, pivot, pivot, self._beside_arc(self._turning, turning.size))
        for symbol, begin, end, value in known.dimensions:
            lettering = self._hand.written(written(symbol, value, unit_), size, dim)
            line = self._paths[begin], self._paths[end]
            wish = self._beside(line, line, lettering.size)
            yield Tag(lettering, begin, end, self._shunning(wish, {begin, end}))
        for legs in known.legs:
            (first, second), corner = legs.point.on, self._corner(legs.point.on, legs.point.at[0])
            frame = self._paths[first], self._paths[second]
            lines = (frame[0], corner), (corner, self._paths[legs.point.name])
            for symbol, value, line in zip(legs.symbols, legs.point.at, lines, strict=True):
                if not value:
                    continue
                lettering = self._hand.written(written(symbol, value, unit_), size, dim)
                wish = self._shunning(self._beside(line, frame, lettering.size), {first, second})
                yield Tag(lettering, first, second, wish, across=True)

    def _corner(self, on: tuple[str, str], along: float) -> Loop:
        begin, end = (self._paths[name] for name in on)
        corner: Loop = begin + self._view.scale * along * _units(end - begin)
        return corner

    def _radius(self, name: str) -> float:
        """Return how far what is drawn at a joint reaches."""
        gauge = self._hand.gauge
        block = self._figure.linkage.joint(name).travels
        return _BLOCK * gauge.bar if block else gauge.bar

    def _around(self, name: str, size: tuple[float, float], radius: float) -> Wish:
        """Return places all round a joint, near and farther; up and to the right is best."""
        turns = np.exp(-2j * pi * np.arange(24) / 24)
        rings = [_off(turns, size, radius), _off(turns, size, radius + 0.7 * size[1])]
        path = self._paths[name]
        price = np.concatenate(
            [_FARTHER * n + 0.04 * np.abs(np.angle(turns / np.exp(-0.25j * pi))) for n in (0, 1)]
        )
        return Wish(size, path[:, None] + np.concatenate(rings), price, (path, np.ones_like(path)))

    def _beside_arc(self, turning: Turning, size: tuple[float, float]) -> Wish:
        """Return places outside the arc of the input's angle, best at its middle."""
        path, pin = self._paths[turning.pivot], self._paths[turning.pin]
        bars = np.angle(np.conj(pin - path))
        angles = np.array([turning.turned(float(angle)) for angle in bars])
        middle = np.full_like(angles, pi / 6) if self._figure.scene.info.full_turn else angles / 2
        turns = np.exp(-1j * (middle[:, None] + np.linspace(-0.8, 0.8, 9)))
        price = 0.3 * np.abs(np.linspace(-1, 1, 9))
        places = path[:, None] + _off(turns, size, turning.arc + 0.1 * size[1])
        return Wish(size, places, price, (path, np.ones_like(path)))

    def _on(self, body: Body, size: tuple[float, float]) -> Wish:
        """Return places on a link: along a bar and beside it, or inside a plate."""
        corners = [self._paths[name] for name in body.joints]
        frame = corners[0], _units(corners[1] - corners[0])
        if not self._is_plate(body):
            on_it = self._line((corners[0], corners[1]), frame, size, (0, 1, -1, 1.8, -1.8))
            beside = np.arange(len(on_it.price)) >= len(_ALONG)
            shunned = np.where(beside[:, None], self._others(body.joints), self._in_front(body))
            return on_it._replace(own=self._numbers(body), shunned=shunned)
        middle = sum(corners[1:], corners[0]) / len(corners)
        sides = [(one + other) / 2 for one, other in pairwise((*corners, corners[0]))]
        towards = [(share, end) for share in _INSIDE for end in (*corners, *sides)]
        inside = [middle, *((1 - share) * middle + share * end for share, end in towards)]
        price = np.array([0.0, *(share for share, _ in towards)])
        shunned = np.tile(self._in_front(body), (len(inside), 1))
        return Wish(size, np.stack(inside, axis=1), price, frame, self._numbers(body), shunned)

    def _is_plate(self, body: Body) -> bool:
        return len(hull([complex(self._paths[name][0]) for name in body.joints])) > 2

    def _shunning(self, wish: Wish, own: set[str]) -> Wish:
        """Return the wish for a label that must not seem to be of another bar than that of its own joints."""
        return wish._replace(shunned=np.tile(self._others(own), (len(wish.price), 1)))

    def _others(self, own: Iterable[str]) -> NDArray[np.bool_]:
        """Return which obstacles are bars that do not have all these joints."""
        bars = [not self._is_plate(body) and not set(own) <= set(body.joints) for body, _ in self._sides()]
        return np.array([*bars, *[False] * (len(self._figure.struts) + len(self._figure.fixed))])

    def _in_front(self, body: Body) -> NDArray[np.bool_]:
        """Return which of them are drawn over a body: plates lie behind all bars."""
        order = [other for other, _ in self._sides()]
        plate = self._is_plate(body)
        later = [plate or n > order.index(body) for n in range(len(order))]
        found: NDArray[np.bool_] = self._others(body.joints)
        found[: len(later)] &= np.array(later, np.bool_)
        return found

    def _beside(self, line: tuple[Loop, Loop], frame: tuple[Loop, Loop], size: tuple[float, float]) -> Wish:
        """Return places beside a line, in the frame of two joints."""
        return self._line(line, (frame[0], _units(frame[1] - frame[0])), size, (1, -1))

    def _line(
        self,
        line: tuple[Loop, Loop],
        frame: tuple[Loop, Loop],
        size: tuple[float, float],
        sides: Sequence[float],
    ) -> Wish:
        begin, along = line[0], line[1] - line[0]
        normal = 1j * _units(along)
        clear = _support(normal, size) + 1.3 * self._hand.gauge.bar
        aways = [np.sign(side) * (clear + (max(abs(side), 1) - 1) * size[1]) for side in sides]
        places = [begin + share * along + away * normal for away in aways for share in _ALONG]
        price = np.array([_BESIDE * abs(side) + abs(share - 0.5) for side in sides for share in _ALONG])
        return Wish(size, np.stack(places, axis=1), price, frame)

    def clutter(self) -> Clutter:
        """Return what is in the labels' way."""
        gauge, layout = self._hand.gauge, self._hand.layout
        names = list(self._paths)
        radii = np.array(
            [
                0.85 * self._radius(name) if self._radius(name) > gauge.bar else gauge.pin + gauge.outline
                for name in names
            ]
        )
        discs = np.stack([self._paths[name] for name in names], axis=1)
        return Clutter(discs, radii, layout.words, layout.stage.inset(2), self._bars())

    def _numbers(self, body: Body) -> tuple[int, ...]:
        """Return which of the bars are the sides of a body."""
        return tuple(n for n, (other, _) in enumerate(self._sides()) if other is body)

    def _sides(self) -> list[tuple[Body, int]]:
        return [
            (body, n)
            for body in self._figure.bodies
            for n in range(len(body.joints) if len(body.joints) > 2 else 1)
        ]

    def _bars(self) -> Obstacles:
        """Return the sides of bodies, springs and dampers, pedestals."""
        gauge, figure = self._hand.gauge, self._figure
        rows = []
        for body, n in self._sides():
            ends = body.joints[n], body.joints[(n + 1) % len(body.joints)]
            rows.append(
                (*(self._paths[name] for name in ends), gauge.bar, 1.0 if len(body.joints) == 2 else 0.4)
            )
        for strut in figure.struts:
            rows.append((*(self._paths[name] for name in strut.between), 1.1 * gauge.bar, 0.8))
        for name in figure.fixed:
            foot = self._paths[name] + away(figure, name) * 2 * gauge.bar
            rows.append((self._paths[name], foot, 1.6 * gauge.bar, 1.0))
        begin, end, half, weight = zip(*rows, strict=True) if rows else ((), (), (), ())
        if not rows:
            none = np.zeros((1, 0))
            return Obstacles(none.astype(np.complex128), none.astype(np.complex128), none[0], none[0])
        return Obstacles(np.stack(begin, axis=1), np.stack(end, axis=1), np.array(half), np.array(weight))


def _off(turns: Loop, size: tuple[float, float], radius: float) -> Loop:
    """Return where the middle of a label lies that stays off a disc about 0, in these directions."""
    off: Loop = turns.real * (radius + size[0] / 2) + 1j * turns.imag * (radius + size[1] / 2)
    return off


def _support(normal: Loop, size: tuple[float, float]) -> NDArray[np.float64]:
    """Return how far a label's middle must lie from a line to stay off it."""
    support: NDArray[np.float64] = np.abs(normal.real) * size[0] / 2 + np.abs(normal.imag) * size[1] / 2
    return support


def _units(vectors: Loop) -> Loop:
    """Return the directions; to the right where there is none."""
    length = np.abs(vectors)
    directions: Loop = np.where(length > 0, vectors / np.where(length > 0, length, 1), 1)
    return directions
