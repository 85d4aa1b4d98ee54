"""Where names can stand at each moment of a cycle: round joints, on links, beside what is measured."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.picture.figure import SAMPLES, Figure
from linkanim.picture.labels.placing import MOMENTS, Clutter, Obstacles, Solid, Wish
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.parts.ground import away
from linkanim.picture.parts.turning import Turning
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
_BLOCK = 2.7
"""How far a slider's block reaches, in half widths of a bar."""


@dataclass(frozen=True)
class Whereabouts:
    """Where all is that names stand by or keep off, at each of the moments for which they are placed."""

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

    def apart(self, one: str, other: str) -> float:
        """Return how far apart two joints are on the whole, 0 for one and the same."""
        return float(np.mean(np.abs(self._paths[other] - self._paths[one])))

    def around(self, name: str, size: Size, rings: int = 2) -> Wish:
        """Return places all round a joint, in rings ever farther; up and to the right is best."""
        radius, path = self._radius(name), self._paths[name]
        turns = np.exp(-2j * pi * np.arange(24) / 24)
        turned = 0.04 * np.abs(np.angle(turns / np.exp(-0.25j * pi)))
        rounds = [_off(turns, size, radius + 0.7 * n * size[1]) for n in range(rings)]
        price = np.concatenate([_FARTHER * n + turned for n in range(rings)])
        return Wish(size, path[:, None] + np.concatenate(rounds), price, (path, np.ones_like(path)))

    def by_slider(self, name: str, size: Size) -> Wish:
        """Return places round a slider's block, off every link: also off the bar that leads to it."""
        wish = self.around(name, size, 3)
        return wish._replace(shunned=_everywhere(wish, self._others(())))

    def on(self, body: Body, size: Size) -> Wish:
        """Return places on a link: along a bar and beside it, or inside a plate."""
        return self._inside(body, size) if self._is_plate(body) else self._along(body, size)

    def _along(self, body: Body, size: Size) -> Wish:
        first, second = (self._paths[name] for name in body.joints[:2])
        wish = self._line((first, second), (first, _units(second - first)), size, _SIDES)
        beside = np.arange(len(wish.price)) >= len(_ALONG)
        shunned = np.where(beside[:, None], self._others(body.joints), self._in_front(body))
        return wish._replace(own=self._numbers(body), shunned=shunned)

    def _inside(self, body: Body, size: Size) -> Wish:
        corners = [self._paths[name] for name in body.joints]
        middle = sum(corners[1:], corners[0]) / len(corners)
        sides = [(one + other) / 2 for one, other in pairwise((*corners, corners[0]))]
        towards = [(share, end) for share in _INSIDE for end in (*corners, *sides)]
        inside = [middle, *((1 - share) * middle + share * end for share, end in towards)]
        price = np.array([0.0, *(share for share, _ in towards)])
        frame = corners[0], _units(corners[1] - corners[0])
        wish = Wish(size, np.stack(inside, axis=1), price, frame, self._numbers(body))
        return wish._replace(shunned=_everywhere(wish, self._in_front(body)))

    def beside(self, begin: str, end: str, size: Size) -> Wish:
        """Return places beside the line from joint to joint."""
        line = self._paths[begin], self._paths[end]
        return self._beside(line, line, size, {begin, end})

    def leg(self, point: Rigid, which: int, size: Size) -> Wish:
        """Return places beside the first or the second leg of a point: along its body, or to its left."""
        begin, end = frame = self._paths[point.on[0]], self._paths[point.on[1]]
        corner: Loop = begin + self.view.scale * point.at[0] * _units(end - begin)
        line = (corner, self._paths[point.name]) if which else (begin, corner)
        return self._beside(line, frame, size, set(point.on))

    def by_arc(self, turning: Turning, size: Size) -> Wish:
        """Return places outside the arc of the input's angle, best at its middle."""
        path, pin = self._paths[turning.pivot], self._paths[turning.pin]
        bars = np.angle(np.conj(pin - path))
        angles = np.array([turning.turned(float(angle)) for angle in bars])
        middle = np.full_like(angles, pi / 6) if self.figure.scene.info.full_turn else angles / 2
        turns = np.exp(-1j * (middle[:, None] + np.linspace(-0.8, 0.8, 9)))
        price = 0.3 * np.abs(np.linspace(-1, 1, 9))
        places = path[:, None] + _off(turns, size, turning.arc + 0.1 * size[1])
        return Wish(size, places, price, (path, np.ones_like(path)))

    def _beside(
        self, line: tuple[Loop, Loop], frame: tuple[Loop, Loop], size: Size, own: Iterable[str]
    ) -> Wish:
        """Return places beside a line, in the frame of two joints, off the bars of other joints than its own.

        What is measured may lie on a plate, whose number is not mistaken for a length.
        """
        wish = self._line(line, (frame[0], _units(frame[1] - frame[0])), size, (1, -1))
        return wish._replace(shunned=_everywhere(wish, self._others(own) & self._bars))

    def _line(
        self, line: tuple[Loop, Loop], frame: tuple[Loop, Loop], size: Size, sides: Sequence[float]
    ) -> Wish:
        begin, along = line[0], line[1] - line[0]
        normal = 1j * _units(along)
        clear = _support(normal, size) + 1.3 * self.gauge.bar
        aways = [np.sign(side) * (clear + (max(abs(side), 1) - 1) * size[1]) for side in sides]
        places = [begin + share * along + away * normal for away in aways for share in _ALONG]
        price = np.array([_BESIDE * abs(side) + abs(share - 0.5) for side in sides for share in _ALONG])
        return Wish(size, np.stack(places, axis=1), price, frame)

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
        return Clutter(discs, np.array(pins), layout.words, room, self._obstacles(), self._solids)

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

    def _numbers(self, body: Body) -> tuple[int, ...]:
        """Return which of the obstacles are the sides of a body."""
        return self._numbered.get(id(body), ())

    @cached_property
    def _numbered(self) -> dict[int, tuple[int, ...]]:
        """The numbers of the obstacles that are the sides of each body."""
        found: dict[int, tuple[int, ...]] = {}
        for n, (body, _) in enumerate(self._sides()):
            found[id(body)] = (*found.get(id(body), ()), n)
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
            none = np.zeros((1, 0))
            return Obstacles(none.astype(np.complex128), none.astype(np.complex128), none[0], none[0])
        begins, ends, half, weights = zip(*rows, strict=True)
        return Obstacles(np.stack(begins, axis=1), np.stack(ends, axis=1), np.array(half), np.array(weights))


def _everywhere(wish: Wish, which: Flags) -> Flags:
    """Return the same flags for each of the places."""
    return np.tile(which, (len(wish.price), 1))


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
