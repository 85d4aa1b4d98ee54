"""Curves of the traced joints: the whole curve stands still, its recent part follows the phase."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, pi

import numpy as np

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

_RECENT = 0.3 * 2 * pi
"""How much phase the recent part covers."""
_SHADES = 10
_FAINT = 0.62


@dataclass(frozen=True)
class Trace:
    """The curve of one joint in pixels, at equal steps of phase over one true period."""

    joint: str
    path: Loop
    period: float
    colour: Colour
    back: Colour
    width: float

    def whole(self) -> Layer:
        """Return the whole curve."""
        return Layer(self.back, stroke(self.path, self.width, closed=True))

    def recent(self, phase: float, place: complex, *, forward: bool) -> list[Layer]:
        """Return what the joint, now at `place`, has passed through last, brighter towards it."""
        count = len(self.path)
        here = phase / self.period * count
        tail = _RECENT / self.period * count
        sign = 1 if forward else -1
        last = floor(here) if forward else ceil(here)
        back = [ceil(tail * shade / _SHADES) for shade in range(_SHADES, -1, -1)]
        layers = []
        for shade, (begin, end) in enumerate(zip(back, back[1:], strict=False), start=1):
            steps = np.arange(begin, max(end - 2, -1), -1)
            piece = self.path[(last - sign * steps) % count]
            if shade == _SHADES:
                piece = np.concatenate((piece, [place]))
            share = shade / _SHADES
            colour = mixed(self.back, self.colour, share)
            layers.append(Layer(colour, stroke(piece, self.width * (1 + 0.7 * share))))
        return layers


def traces(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Trace, ...]:
    """Return the curves of the scene's traced joints."""
    found = []
    for n, joint in enumerate(figure.scene.trace):
        colour = theme.traces[n % len(theme.traces)]
        back = mixed(colour, theme.background, _FAINT)
        path = figure.path(joint, view)
        found.append(Trace(joint, path, figure.scene.period, colour, back, 1.3 * gauge.line))
    return tuple(found)
