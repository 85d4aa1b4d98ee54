"""Where labels may stand: round joints, on links, beside what is measured; what is in their way."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.picture.figure import SAMPLES, Figure
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.parts.ground import away
from linkanim.picture.parts.turning import Turning
from linkanim.picture.placing import MOMENTS, NO_BARS, Clutter, LabelPlaces, Obstacles, Solid
from linkanim.picture.raster.directions import lengths
from linkanim.picture.raster.raster import Loop
from linkanim.picture.raster.shapes import hull
from linkanim.picture.view import View

Size = tuple[float, float]
"""How wide and high a label is, in pixels."""
Flags = NDArray[np.bool_]

_ALONG = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
"""Where along a bar its name may stand."""
_SIDES = (0, 1, -1, 1.8, -1.8)
"""On a bar, and how far to its sides, in heights of the name."""
_INSIDE = (0.3, 0.5, 0.65)
"""How far from a plate's middle to its corners and sides its name may stand."""
_BESIDE = 0.4
"""What a place beside a bar costs, where one on it is free."""
_FARTHER = 1.0
"""What a place farther from its joint costs."""
_ROUND = 16
"""So many places lie round a joint."""
_CLEAR = 1.3
"""How far off a bar's middle a label beside it begins, in half widths of a bar."""
_BLOCK = 2.7
"""How far a slider's block reaches, in half widths of a bar."""


class Spots(NamedTuple):
    """Places (k,) in the frame of the joint `at`, whose direction and unit is the way to `head`.

    A place lies so far along the line from `begin` to `end` in that frame, `aside` of it (+1 or -1: off the
    line and `further` pixels more; 0: on it), and then `off` in pixels.
    """

    at: str
    head: str
    begin: Loop
    end: Loop
    share: NDArray[np.float64]
    aside: NDArray[np.float64]
    further: NDArray[np.float64]
    off: Loop

    def picked(self, which: int) -> Spots:
        """Return one of them."""
        return Spots(self.at, self.head, *(part[which] for part in self[2:]))

    def middles(self, at: ArrayLike, head: ArrayLike, sides: ArrayLike, bar: float) -> Loop:
        """Return the middles in pixels where the joints are, of labels with these sides (w + hi)."""
        at, sides = np.asarray(at, np.complex128), np.asarray(sides, np.complex128)
        span = np.asarray(head, np.complex128) - at
        along = (self.end - self.begin) * span
        normal = 1j * _units(along)
        clear = 0.5 * (np.abs(normal.real) * sides.real + np.abs(normal.imag) * sides.imag) + _CLEAR * bar
        middles: Loop = (
            at
            + self.begin * span
            + self.share * along
            + self.aside * (clear + self.further) * normal
            + self.off
        )
        return middles


def stacked(spots: Sequence[Spots]) -> Spots:
    """Return single spots in one, each of its own joints."""
    return Spots("", "", *(np.array(part) for part in list(zip(*spots, strict=True))[2:]))


@dataclass(frozen=True)
class LabelSpots:
    """Where a label may stand, and what is to be placed of it."""

    spots: Spots
    candidates: LabelPlaces


@dataclass(frozen=True)
class Surroundings:
    """Where all is that labels stand by or keep off, at each of the moments for which they are placed."""

    figure: Figure
    view: View
    gauge: Gauge
    layout: Layout

    @cached_property
    def _paths(self) -> dict[str, Loop]:
        step = SAMPLES // MOMENTS
        return {
            name: np.nan_to_num(self.figure.path(name, self.view)[::step], nan=-1e6)
            for name in self.figure.shown
        }

    def around(self, name: str, size: Size, rings: int = 3) -> LabelSpots:
        """Return places all round a joint, in rings ever farther; up and to the right is best."""
        turns = np.exp(-2j * pi * np.arange(_ROUND) / _ROUND)
        turned = 0.04 * np.abs(np.angle(turns / np.exp(-0.25j * pi)))
        rounds = [_off(turns, size, self._radius(name) + 0.7 * n * size[1]) for n in range(rings)]
        price = np.concatenate([_FARTHER * n + turned for n in range(rings)])
        return self._candidates((name, name), size, price, off=np.concatenate(rounds))

    def by_slider(self, name: str, size: Size) -> LabelSpots:
        """Return places round a slider's block, off every link: also off the bar that leads to it."""
        return _shunning(self.around(name, size, 6), self._others(()))

    def on(self, body: Body, size: Size) -> LabelSpots:
        """Return places on a link: along a bar and beside it, or inside a plate."""
        return self._inside(body, size) if self._is_plate(body) else self._along(body, size)

    def _along(self, body: Body, size: Size) -> LabelSpots:
        first, second, *_ = body.joints
        found = self._line((first, second), (0, 1), size, _SIDES)
        beside = np.arange(len(found.candidates.price)) >= len(_ALONG)
        shunned = np.where(beside[:, None], self._others(body.joints), self._in_front(body))
        mine = found.candidates._replace(own=self._numbers.get(body.joints, ()), shunned=shunned)
        return LabelSpots(found.spots, mine)

    def _inside(self, body: Body, size: Size) -> LabelSpots:
        first, second, *_ = body.joints
        places = [complex(self._paths[name][0]) for name in body.joints]
        corners = [(place - places[0]) / (places[1] - places[0]) for place in places]
        middle = sum(corners) / len(corners)
        sides = [(one + other) / 2 for one, other in pairwise((*corners, corners[0]))]
        towards = [(share, end) for share in _INSIDE for end in (*corners, *sides)]
        inside = np.array([middle, *((1 - share) * middle + share * end for share, end in towards)])
        price = np.array([0.0, *(share for share, _ in towards)])
        found = self._candidates((first, second), size, price, begin=inside, end=inside)
        mine = found.candidates._replace(own=self._numbers.get(body.joints, ()))
        return _shunning(LabelSpots(found.spots, mine), self._in_front(body))

    def beside(self, begin: str, end: str, size: Size) -> LabelSpots:
        """Return places beside the line from joint to joint."""
        return self._beside((begin, end), (0, 1), size, {begin, end})

    def leg(self, point: Rigid, which: int, size: Size) -> LabelSpots:
        """Return places beside the first or the second leg of a point: along its body, or to its left."""
        first, second = point.on
        span = abs(self._paths[second][0] - self._paths[first][0]) / self.view.scale
        along, left = point.at
        corner, there = complex(along / span), complex(along, -left) / span
        return self._beside((first, second), (corner, there) if which else (0, corner), size, set(point.on))

    def by_arc(self, turning: Turning, size: Size) -> LabelSpots:
        """Return places outside the arc of the input's angle, best at its middle."""
        bars = np.angle(np.conj(self._paths[turning.pin] - self._paths[turning.pivot]))
        angles = np.array([turning.turned(float(angle)) for angle in bars])
        middle = pi / 6 if self.figure.scene.info.full_turn else angles.mean() / 2
        ways = np.linspace(-1, 1, 9)
        off = _off(np.exp(-1j * (middle + 0.8 * ways)), size, turning.arc + 0.1 * size[1])
        return self._candidates((turning.pivot, turning.pivot), size, 0.3 * np.abs(ways), off=off)

    def _beside(
        self, frame: tuple[str, str], line: tuple[complex, complex], size: Size, own: Iterable[str]
    ) -> LabelSpots:
        """Return places beside a line in the frame of two joints, off the bars of other joints than its own.

        What is measured may lie on a plate, whose number is not mistaken for a length.
        """
        return _shunning(self._line(frame, line, size, (1, -1)), self._others(own) & self._bars)

    def _line(
        self, frame: tuple[str, str], line: tuple[complex, complex], size: Size, sides: Sequence[float]
    ) -> LabelSpots:
        aside, share = np.array([(side, share) for side in sides for share in _ALONG]).T
        price = _BESIDE * np.abs(aside) + np.abs(share - 0.5)
        further = (np.maximum(np.abs(aside), 1) - 1) * size[1]
        begin, end = (np.full(len(share), place, np.complex128) for place in line)
        where = {"begin": begin, "end": end, "share": share, "aside": np.sign(aside), "further": further}
        return self._candidates(frame, size, price, **where)

    def _candidates(
        self,
        frame: tuple[str, str],
        size: Size,
        price: NDArray[np.float64],
        **parts: NDArray[Any],
    ) -> LabelSpots:
        """Return places with their prices, at each moment; of the parts of spots what is left out is 0."""
        none, nowhere = np.zeros(len(price)), np.zeros(len(price), np.complex128)
        lacking = {"begin": nowhere, "end": nowhere, "share": none, "aside": none, "further": none}
        known = {"off": nowhere, **lacking, **parts}
        spots = Spots(*frame, *(known[part] for part in Spots._fields[2:]))
        at, head = (self._paths[name][:, None] for name in frame)
        middles = spots.middles(at, head, complex(*size), self.gauge.bar)
        return LabelSpots(spots, LabelPlaces(size, middles, price))

    def _radius(self, name: str) -> float:
        """Return how far what is drawn at a joint reaches."""
        block = self.figure.linkage.joint(name).travels
        return _BLOCK * self.gauge.bar if block else self.gauge.bar

    def clutter(self) -> Clutter:
        """Return what is in the labels' way."""
        gauge, layout, radii = self.gauge, self.layout, [self._radius(name) for name in self._paths]
        pins = [0.85 * radius if radius > gauge.bar else gauge.pin + gauge.outline for radius in radii]
        discs = np.stack(list(self._paths.values()), axis=1)
        room = layout.stage.inset(2)
        return Clutter(room, layout.words, discs, np.array(pins), self._obstacles(), self._solids)

    @cached_property
    def _solids(self) -> tuple[Solid, ...]:
        """What each of the bodies covers, and each spring and damper."""
        figure, bar = self.figure, self.gauge.bar
        links = [(self._corners(body), bar) for body in figure.bodies]
        struts = [(strut.between, 1.1 * bar) for strut in figure.struts]
        return tuple(
            Solid(np.stack([self._paths[name] for name in names], axis=1), half)
            for names, half in (*links, *struts)
        )

    def _corners(self, body: Body) -> list[str]:
        """Return the joints at the corners of a body's outline, in their order round it."""
        starts = {complex(self._paths[name][0]): name for name in reversed(body.joints)}
        return [starts[corner] for corner in hull(list(starts))]

    def _is_plate(self, body: Body) -> bool:
        return len(self._corners(body)) > 2

    @cached_property
    def _bars(self) -> Flags:
        """Which of the solids are bars."""
        struts = [False] * len(self.figure.struts)
        return np.array([*(not self._is_plate(body) for body in self.figure.bodies), *struts])

    @cached_property
    def _owned(self) -> dict[str, set[int]]:
        """The numbers of the solids that have each joint."""
        found: dict[str, set[int]] = {}
        owners = (*(body.joints for body in self.figure.bodies), *(s.between for s in self.figure.struts))
        for n, joints in enumerate(owners):
            for joint in joints:
                found.setdefault(joint, set()).add(n)
        return found

    def _others(self, own: Iterable[str]) -> Flags:
        """Return which of the solids do not have all these joints; without joints every one."""
        owners = [self._owned.get(joint, set[int]()) for joint in own]
        others = np.ones(len(self.figure.bodies) + len(self.figure.struts), np.bool_)
        others[list(set.intersection(*owners) if owners else ())] = False
        return others

    def _in_front(self, body: Body) -> Flags:
        """Return which of them are bars drawn over a body: plates lie behind all bars."""
        found = self._others(body.joints) & self._bars
        if not self._is_plate(body):
            found[: self.figure.bodies.index(body) + 1] = False
        return found

    @cached_property
    def _numbers(self) -> dict[tuple[str, ...], tuple[int, ...]]:
        """The numbers of the obstacles that are the sides of each body."""
        found: dict[tuple[str, ...], tuple[int, ...]] = {}
        for n, (body, _) in enumerate(self._sides()):
            found[body.joints] = (*found.get(body.joints, ()), n)
        return found

    def _sides(self) -> Iterator[tuple[Body, tuple[str, str]]]:
        """Yield the sides of bodies, from joint to joint."""
        for body in self.figure.bodies:
            joints = body.joints
            ends = zip(joints, (*joints[1:], joints[0]), strict=True)
            yield from ((body, pair) for pair in (ends if len(joints) > 2 else [(joints[0], joints[1])]))

    def _obstacles(self) -> Obstacles:
        """Return the sides of bodies, springs and dampers, pedestals."""
        bar, figure, rows = self.gauge.bar, self.figure, []
        for body, (begin, end) in self._sides():
            weight = 1.0 if len(body.joints) == 2 else 0.4
            rows.append((self._paths[begin], self._paths[end], bar, weight))
        for strut in figure.struts:
            begin, end = strut.between
            rows.append((self._paths[begin], self._paths[end], 1.1 * bar, 0.8))
        for name in figure.fixed:
            foot = self._paths[name] + away(figure, name) * 2 * bar
            rows.append((self._paths[name], foot, 1.6 * bar, 1.0))
        if not rows:
            return NO_BARS
        begins, ends, half, weights = zip(*rows, strict=True)
        return Obstacles(np.stack(begins, axis=1), np.stack(ends, axis=1), np.array(half), np.array(weights))


def _shunning(found: LabelSpots, which: Flags) -> LabelSpots:
    """Return a label that shuns the same solids at each of its places."""
    shunned = np.tile(which, (len(found.candidates.price), 1))
    return LabelSpots(found.spots, found.candidates._replace(shunned=shunned))


def _off(turns: Loop, size: tuple[float, float], radius: float) -> Loop:
    """Return where the middle of a label lies that stays off a disc about 0, in these directions."""
    off: Loop = turns.real * (radius + size[0] / 2) + 1j * turns.imag * (radius + size[1] / 2)
    return off


def _units(vectors: Loop) -> Loop:
    """Return the directions; to the right where there is none."""
    length = lengths(vectors)
    directions: Loop = np.where(length > 0, vectors / np.where(length > 0, length, 1), 1)
    return directions
