"""The lane of a ram: two lines on paper that scrolls across its guide."""

from __future__ import annotations

import numpy as np

from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Group
from linkanim.picture.panels.overlay import Lane
from linkanim.picture.raster.raster import Layer, Loop
from linkanim.picture.raster.shapes import segments, stroke, unit
from linkanim.picture.theme import mixed

_DEEPEST = 0.62
"""How far the paper reaches before the ram at the most, in heights of the stage."""


def lane(setting: DrawSetting, shown: Lane) -> Group:
    """Return the paper between the lines, the lines, and the way on which the ram is compared with them."""
    _, view, gauge, theme = setting.known
    back, forward = view.place(shown.back), view.place(shown.forward)
    stage, across, middle = setting.layout.stage, 1j * unit(forward - back), (back + forward) / 2
    ahead = max((across, -across), key=lambda way: stage.ahead(middle, way))  # where there is more room
    depth = min(stage.ahead(middle, ahead), _DEEPEST * stage.height)
    way, share = np.array(shown.middle).T
    foot: Loop = back + ahead * depth * way + (forward - back) * share
    half = (forward - back) * shown.half_width
    edges = foot - half, foot + half
    ink = theme.velocity if shown.well else theme.warning
    shade = theme.chosen if shown.well else mixed(ink, theme.background, 0.75)
    paper = Layer(shade, [np.concatenate((edges[0], edges[1][::-1]))])
    lines = [loop for edge in edges for loop in stroke(edge, 1.8 * gauge.line)]
    beyond = 0.06 * (forward - back)
    guide = segments(back - beyond, forward + beyond, gauge.line)
    return Group("lane", [paper, Layer(theme.ground, guide), Layer(ink, lines)])
