"""Draw poses of a body that a user sets down: axes, pins, the coupler in each, Burmester's curves."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from linkanim.errors import BadInput
from linkanim.picture.build_sheet import worded
from linkanim.picture.chart import pen_for
from linkanim.picture.construction import construction_items
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Halo, grouped
from linkanim.picture.overlay import AXIS, NEAR, PosesShown
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import arrows, disc, segments, stroke
from linkanim.picture.theme import ORANGE, mixed
from linkanim.synthesis.burmester import Poses
from linkanim.synthesis.constructions import Mark, pose_marks

_ACROSS = 0.55
"""How long a pose's y axis is drawn, in lengths of its x axis."""
_CURVE, _HELD = 200, 90
"""Points of a circuit of Burmester's curves, and of one while a hand changes it."""


def posed(setting: DrawSetting, shown: PosesShown) -> Iterator[Group]:
    """Yield the drawing of poses: curves and couplers, the words, the points to drag, and the axes."""
    view, theme, layout = setting.view, setting.theme, setting.layout
    line = max(1.8 * layout.unit, 1.2)
    if shown.curves and len(shown.frames) > 1:
        marks = _marks(shown.frames, _HELD if shown.held else _CURVE)
        pen = pen_for(layout, setting.type, theme)
        yield grouped("theory", construction_items(marks, view, layout.stage, pen))
    ghosts = [np.array([view.place(place) for place in body]) for body in shown.bodies]
    faint = mixed(theme.ground, theme.background, 0.25)
    yield Group(
        "couplers", [Layer(faint, [loop for one in ghosts for loop in stroke(one, 0.6 * line, closed=True)])]
    )
    # what can be grasped lies over the words, whose backing would hide it
    yield worded(setting, shown.sentence, shown.facts, is_warning=shown.is_warning)
    yield Group("handles", [*_handles(setting, shown, line)], over=True)
    yield Group("poses", [*_frames(setting, shown, line)], [*_numbers(setting, shown)], over=True)


def _reach(setting: DrawSetting) -> float:
    return AXIS * NEAR * setting.layout.size[1]


def _frames(setting: DrawSetting, shown: PosesShown, line: float) -> Iterator[Layer]:
    view, theme, reach = setting.view, setting.theme, _reach(setting)
    for n, (x, y, angle) in enumerate(shown.frames):
        at, along = view.place((x, y)), reach * cmath.exp(-1j * angle)
        axes = np.array([along, -1j * _ACROSS * along])
        if ("pose", n) == shown.taken:
            yield Layer(ORANGE, [at + disc(7 * line)], 0.45)
        yield Layer(theme.background, segments(np.array([at, at]), at + axes, 4 * line))
        yield Layer(theme.ink, arrows(np.array([at, at]), axes, 1.5 * line))
        yield Layer(theme.velocity, [at + along + disc(2.6 * line)])
        yield Layer(theme.background, [at + disc(3.4 * line)])
        yield Layer(theme.ink, stroke(at + disc(3.4 * line), 1.3 * line, closed=True))
    if shown.cursor:
        at = view.place(shown.cursor)
        arms = 5 * line * np.array([1, 1j])
        yield Layer(theme.velocity, segments(at - arms, at + arms, 1.3 * line))


def _numbers(setting: DrawSetting, shown: PosesShown) -> Iterator[Caption]:
    size, reach = setting.layout.small_size, _reach(setting)
    halo = Halo(setting.theme.background, 0.14 * size)
    for n, (x, y, angle) in enumerate(shown.frames, start=1):
        at = setting.view.place((x, y)) - 0.45 * reach * cmath.exp(-1j * (angle + 0.6))
        top = at.real, at.imag - 0.5 * size
        yield Caption(str(n), top, size, setting.theme.ink, "centre", strong=True, halo=halo)


def _handles(setting: DrawSetting, shown: PosesShown, line: float) -> Iterator[Layer]:
    """Yield pins that are asked for, and rings about the linkage's points that can be dragged."""
    view, theme = setting.view, setting.theme
    for place in shown.handles:
        ring = view.place(place) + disc(5.5 * line)
        yield Layer(theme.velocity, stroke(ring, 1.1 * line, closed=True))
    for n, place in enumerate(shown.pins):
        at = view.place(place)
        if ("pin", n) == shown.taken:
            yield Layer(ORANGE, [at + disc(8 * line)], 0.45)
        yield Layer(theme.velocity, [at + disc(5.5 * line)])
        yield Layer(theme.background, [at + disc(3.6 * line)])
        yield Layer(theme.velocity, [at + disc(1.6 * line)])


@lru_cache(maxsize=4)
def _marks(frames: tuple[tuple[float, float, float], ...], count: int) -> tuple[Mark, ...]:
    """Return poles and Burmester's curves of poses, `count` points a circuit; empty for poses without any.

    While a hand changes the poses, which a low `count` says, there are no names, and no lines between poles.
    """
    rows = np.array(frames)
    try:
        marks = pose_marks(Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy()), count)
        plain = (mark._replace(label="") for mark in marks if mark.shape != "dashed")
        bare = marks if count == _CURVE else tuple(plain)
        return (*_joined(bare), *(mark for mark in bare if mark.shape != "line"))
    except BadInput:
        return ()


def _joined(marks: Sequence[Mark]) -> Iterator[Mark]:
    """Yield the lines of each tone as one mark, so that they are filled together; NaN separates them."""
    for tone in dict.fromkeys(mark.tone for mark in marks if mark.shape == "line"):
        parts = [(*mark.points, np.nan) for mark in marks if mark.shape == "line" and mark.tone == tone]
        yield Mark("line", np.concatenate([np.array(part) for part in parts]), tone=tone)
