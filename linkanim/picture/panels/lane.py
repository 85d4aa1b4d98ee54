"""The lane of a ram: two lines on paper that scrolls across its guide."""

from __future__ import annotations

import numpy as np

from linkanim.picture.items import Group
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.panels.overlay import Lane
from linkanim.picture.raster.raster import Layer, Loop
from linkanim.picture.raster.shapes import segments, stroke, unit
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect, View

_DEEPEST = 0.62
"""How far the paper reaches before the ram at the most, in heights of the stage."""


def lane(view: View, layout: Layout, gauge: Gauge, theme: Theme, shown: Lane) -> Group:
    """Return the paper between the lines, the lines, and the way on which the ram is compared with them."""
    back, forward = view.place(shown.back), view.place(shown.forward)
    ahead = _ahead(layout.stage, back, forward)
    depth = min(_room(layout.stage, (back + forward) / 2, ahead), _DEEPEST * layout.stage.height)
    way, share = np.array(shown.middle).T
    foot: Loop = back + ahead * depth * way + (forward - back) * share
    half = (forward - back) * shown.half_width
    edges = foot - half, foot + half
    ink = theme.velocity if shown.well else theme.warning
    shade = theme.chosen if shown.well else mixed(ink, theme.background, 0.75)
    paper = Layer(shade, [np.concatenate((edges[0], edges[1][::-1]))])
    lines = [loop for edge in edges for loop in stroke(edge, 1.8 * gauge.line)]
    beyond = 0.06 * (forward - back)
    across = segments(back - beyond, forward + beyond, gauge.line)
    return Group("lane", [paper, Layer(theme.ground, list(across)), Layer(ink, lines)])


def _ahead(stage: Rect, back: complex, forward: complex) -> complex:
    """Return the way across the guide on which there is more room."""
    out = 1j * unit(forward - back)
    middle = (back + forward) / 2
    return max((out, -out), key=lambda way: _room(stage, middle, way))


def _room(stage: Rect, at: complex, way: complex) -> float:
    """Return how far it is from a place along a way to the stage's edge."""
    gaps = []
    for place, step, low, high in (
        (at.real, way.real, stage.x, stage.right),
        (at.imag, way.imag, stage.y, stage.bottom),
    ):
        if abs(step) > 1e-9:
            gaps.append(max(((high if step > 0 else low) - place) / step, 0.0))
    return min(gaps)
