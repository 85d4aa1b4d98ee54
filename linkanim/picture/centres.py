"""Draw instant centres, and the curves on which they run: the fixed and the moving centrode."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body
from linkanim.mechanics.measures import centrodes, coupler_body, pole
from linkanim.mechanics.motion import Pose
from linkanim.picture.chart import runs_of
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Halo
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Places, segments, stroke, unit
from linkanim.picture.view import Rect

# Instant centres, and the curves that the coupler's runs along: the fixed and the moving centrode.

_CLOSE = 3.0
"""Points of a curve that are nearer to each other, in pixels, are not all needed."""
_MOST = 4
"""Of so many moving links all centres are marked, of more those to the ground alone."""


class BodyPair(NamedTuple):
    """A body and another, None for the ground, and what their instant centre is called: P_{24}."""

    body: Body
    other: Body | None
    label: str


@frozen
class Centres:
    """The instant centres of a figure in a view, and the coupler's centrodes where the look has them."""

    setting: DrawSetting

    @cached_property
    def pairs(self) -> tuple[BodyPair, ...]:
        """The bodies to the ground, and of few to each other."""
        links: dict[str, Body] = {}
        for body, number in self.setting.figure.numbers.items():
            links.setdefault(number, body)
        pairs = [BodyPair(body, None, _label("1", number)) for number, body in links.items()]
        if len(links) <= _MOST:
            both = combinations(links.items(), 2)
            pairs += [BodyPair(a, b, _label(m, n)) for (m, a), (n, b) in both]
        return tuple(pairs)

    def marks(self, pose: Pose, places: Places) -> Group:
        """Return a cross and its name for each centre that is in sight, but for those that are pins."""
        (figure, view, gauge, theme), layout = self.setting.known, self.setting.layout
        layers, captions = [], []
        reach, size = 0.8 * gauge.bar, layout.small_size
        ink, halo = theme.warning, Halo(theme.background, max(1.4 * gauge.line, 1.5))
        for pair in self.pairs:
            at = view.place(pole(pose, pair.body, pair.other))
            pinned = any(abs(at - places[name]) < reach for name in figure.pins)
            if pinned or not layout.reach.holds(at.real, at.imag):
                continue
            ends = np.array([reach, 1j * reach])
            layers.append(Layer(ink, segments(at - ends, at + ends, 1.4 * gauge.line)))
            place = (at.real + reach, at.imag - reach - size)
            captions.append(Caption(pair.label, place, size, ink, strong=True, halo=halo))
        return Group("instant-centres", layers, captions)

    def fixed(self) -> Layer:
        """Return the curve on the ground."""
        _, view, _, theme = self.setting.known
        return self._stroked(view.place((0.0, 0.0)) + view.scale * self._curves[0].conj(), theme.warning)

    def moving(self, places: Places) -> Layer:
        """Return the curve that moves with the coupler and rolls on the other."""
        figure, view, _, theme = self.setting.known
        body = coupler_body(figure.linkage)
        if body is None:
            return Layer(theme.velocity, [])
        first, second = (places[name] for name in body.joints[:2])
        curve = first + unit(second - first) * view.scale * self._curves[1].conj()
        return self._stroked(curve, theme.velocity)

    @cached_property
    def _curves(self) -> tuple[Loop, Loop]:
        """Both centrodes, closed, in the scene's unit; empty where no body is a coupler."""
        body, scene = coupler_body(self.setting.figure.linkage), self.setting.figure.scene
        if body is None:
            return np.zeros(0, complex), np.zeros(0, complex)
        count = len(self.setting.figure.cycle.phase)
        phases = np.arange(count + 1) * (scene.period / count)
        return centrodes(scene.solve(phase=phases, derivatives=1), body)

    def _stroked(self, path: Loop, colour: Colour) -> Layer:
        width = 1.3 * self.setting.gauge.line
        runs = clipped(path, self.setting.layout.reach)
        return Layer(colour, [loop for run in runs for loop in stroke(_thinned(run), width)])


def _thinned(run: Loop) -> Loop:
    """Return a path without those of its points that lie close together."""
    steps = np.floor(np.cumsum(np.abs(np.diff(run))) / _CLOSE)
    kept: Loop = run[np.r_[True, np.diff(steps) > 0, True][: len(run)]]
    return kept


def _label(one: str, other: str) -> str:
    """Return what a centre is called, the lower number first."""
    first, second = sorted((one, other), key=lambda number: (len(number), number))
    apart = "," if len(first) + len(second) > 2 else ""
    return f"P_{{{first}{apart}{second}}}"


def clipped(path: Loop, room: Rect) -> Iterator[Loop]:
    """Yield the parts of a path that lie in a rectangle, cut where it leaves and where it breaks (NaN)."""
    across = (path.real >= room.x) & (path.real <= room.right)
    for run in runs_of(across & (path.imag >= room.y) & (path.imag <= room.bottom)):
        first, last = int(run[0]), int(run[-1])
        before = _edge(path[first], path[first - 1], room) if first else []
        after = _edge(path[last], path[last + 1], room) if last + 1 < len(path) else []
        yield np.concatenate((before, path[run], after))


def _edge(inside: complex, outside: complex, room: Rect) -> list[complex]:
    """Return where a line leaves a rectangle; nothing where the other end is NaN."""
    step = outside - inside
    return [inside + step * room.ahead(inside, step)] if np.isfinite(step) else []
