"""Curves of the traced joints: the whole curve stands still, its recent part follows the phase."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, floor, pi

import numpy as np

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import offsets, stroke
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
        sign = 1 if forward else -1
        last = floor(here) if forward else ceil(here)
        path = np.empty(tail + 2, np.complex128)
        path[:-1] = self.path[(last - sign * np.arange(tail, -1, -1)) % count]
        path[-1] = place
        moves = path[1:] != path[:-1]
        if not moves.all():
            path = np.concatenate((path[:1], path[1:][moves]))
        if len(path) < 2:
            return []
        side = offsets(path) * (self.width / 2 * (1 + (_SWELL - 1) / (len(path) - 1) * np.arange(len(path))))
        return list(self._shaded(path - side, path + side))

    def _shaded(self, right: Loop, left: Loop) -> Iterator[Layer]:
        """Yield the recent part cut into shades; each runs on a little below the next."""
        cuts = [round(len(right) * shade / _SHADES) for shade in range(_SHADES + 1)]
        for colour, (begin, end) in zip(self.shades, pairwise(cuts), strict=True):
            piece = slice(begin, end + 2)
            yield Layer(colour, [np.concatenate((right[piece], left[piece][::-1]))])


def traces(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Trace, ...]:
    """Return the curves of the scene's traced joints."""
    found = []
    for n, joint in enumerate(figure.scene.trace):
        colour = theme.traces[n % len(theme.traces)]
        back = mixed(colour, theme.background, _FAINT)
        path = figure.path(joint, view)
        found.append(Trace(joint, path, figure.scene.period, colour, back, 1.3 * gauge.line))
    return tuple(found)
