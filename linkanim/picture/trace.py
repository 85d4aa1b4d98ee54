"""Curves of the traced joints: the whole curve stands still, its recent part follows the phase."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate, pairwise
from math import ceil, floor, pi

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import distinct, offsets, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

_RECENT = 0.3 * 2 * pi
"""How much phase the recent part covers."""
_SHADES = 10
_SWELL = 1.7
"""How much wider than the whole curve the recent part ends."""
_FAINT = 0.5
"""How much of the background is in the whole curve's colour."""


@dataclass(frozen=True)
class Trace:
    """The curve of one joint in pixels, at equal steps of phase over one true period."""

    joint: str
    path: Loop
    period: float
    colour: Colour
    back: Colour
    width: float

    @cached_property
    def shades(self) -> tuple[Colour, ...]:
        """The colours of the recent part, from the oldest on."""
        return tuple(mixed(self.back, self.colour, shade / _SHADES) for shade in range(1, _SHADES + 1))

    def whole(self) -> Layer:
        """Return the whole curve."""
        return Layer(self.back, stroke(self.path, self.width, closed=True))

    def recent(self, phase: float, place: complex, *, forward: bool) -> list[Layer]:
        """Return what the joint, now at `place`, has passed through last, brighter towards it."""
        count = len(self.path)
        here = phase / self.period * count
        tail = max(round(_RECENT / self.period * count), _SHADES)
        # run backwards, the curve is passed through from its end
        last = floor(here) if forward else -ceil(here) - 1
        first = (last - tail) % count
        path = np.empty(tail + 2, np.complex128)
        path[:-1] = self._twice[not forward][first : first + tail + 1]
        path[-1] = place
        path = distinct(path)
        if len(path) < 2:
            return []
        side = offsets(path) * _swelling(len(path), self.width)
        corners, ends = _cuts(len(path))
        edges = np.concatenate((path - side, path + side)).take(corners)
        return [
            Layer(colour, [edges[begin:end]])
            for colour, (begin, end) in zip(self.shades, pairwise(ends), strict=True)
        ]

    @cached_property
    def _twice(self) -> tuple[Loop, Loop]:
        """Two rounds of the path, and two the other way."""
        twice = np.concatenate((self.path, self.path))
        return twice, twice[::-1]


@lru_cache(maxsize=16)
def _swelling(count: int, width: float) -> NDArray[np.float64]:
    """Return half the width of a recent part at each of its points."""
    return np.asarray(width / 2 * (1 + (_SWELL - 1) / (count - 1) * np.arange(count)), np.float64)


@lru_cache(maxsize=16)
def _cuts(count: int) -> tuple[NDArray[np.int64], tuple[int, ...]]:
    """Return how a part of so many points is cut into shades, each running on a little below the next.

    That is which corners follow each other, of all on its right and then all on its left, and where each
    shade begins among them, and the end.
    """
    cuts = [round(count * shade / _SHADES) for shade in range(_SHADES + 1)]
    sides = [np.arange(begin, min(end + 2, count)) for begin, end in pairwise(cuts)]
    pieces = [np.concatenate((side, count + side[::-1])) for side in sides]
    return np.concatenate(pieces), (0, *accumulate(map(len, pieces)))


def traces(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Trace, ...]:
    """Return the curves of the scene's traced joints."""
    found = []
    for n, joint in enumerate(figure.scene.trace):
        colour = theme.traces[n % len(theme.traces)]
        back = mixed(colour, theme.background, _FAINT)
        path = figure.path(joint, view)
        found.append(Trace(joint, path, figure.scene.period, colour, back, 1.3 * gauge.line))
    return tuple(found)
