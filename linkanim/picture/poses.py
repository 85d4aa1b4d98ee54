"""Draw poses of a body that a user sets down: axes, pins, the coupler in each, Burmester's curves."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

import numpy as np

from linkanim.errors import BadInput
from linkanim.mechanics.linkage import Point
from linkanim.picture.chart import pen_for
from linkanim.picture.construction import construction_items
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Halo, grouped
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import arrows, disc, segments, stroke
from linkanim.picture.theme import ORANGE, mixed
from linkanim.synthesis.burmester import Poses
from linkanim.synthesis.constructions import Mark, pose_marks

NEAR = 0.022
"""How near to a thing counts as on it, as a share of the window's height."""
AXIS = 3.4
"""How long the x axis of a frame is, in lengths of `NEAR`."""
_ACROSS = 0.55
"""How long a pose's y axis is drawn, in lengths of its x axis."""
_CURVE, _HELD = 200, 90
"""Points of a circuit of Burmester's curves, and of one while a hand changes it."""


Frames = tuple[tuple[float, float, float], ...]
"""Poses: x, y and angle (rad) of each."""
Taken = tuple[str, int] | None
"""The thing that was touched last: "pose" or "pin", and its number."""


def _line(setting: DrawSetting) -> float:
    return max(1.8 * setting.layout.unit, 1.2)


def theory(setting: DrawSetting, frames: Frames, *, held: bool) -> Group:
    """Return the poles and Burmester's curves of poses, coarsely while a hand has `held` something."""
    marks = _marks(frames, _HELD if held else _CURVE) if len(frames) > 1 else ()
    pen = pen_for(setting.layout, setting.type, setting.theme)
    return grouped("theory", construction_items(marks, setting.view, setting.layout.stage, pen))


def couplers(setting: DrawSetting, bodies: Sequence[Sequence[Point]]) -> Group:
    """Return a coupler in each pose, by its corners."""
    ghosts = [np.array([setting.view.pixel(place) for place in body]) for body in bodies]
    loops = [loop for one in ghosts for loop in stroke(one, 0.6 * _line(setting), closed=True)]
    return Group("couplers", [Layer(mixed(setting.theme.ground, setting.theme.background, 0.25), loops)])


def axes(setting: DrawSetting, frames: Frames, selected: Taken, cursor: Point | None) -> Group:
    """Return the axes of poses with their numbers, and the keys' cursor."""
    layers = [*_frames(setting, frames, selected, cursor)]
    return Group("poses", layers, [*_numbers(setting, frames)], over=True)


def _reach(setting: DrawSetting) -> float:
    return AXIS * NEAR * setting.layout.size[1]


def _frames(setting: DrawSetting, frames: Frames, selected: Taken, cursor: Point | None) -> Iterator[Layer]:
    view, theme, reach, line = setting.view, setting.theme, _reach(setting), _line(setting)
    for n, (x, y, angle) in enumerate(frames):
        at, along = view.pixel((x, y)), reach * cmath.exp(-1j * angle)
        arms = np.array([along, -1j * _ACROSS * along])
        if ("pose", n) == selected:
            yield Layer(ORANGE, [at + disc(7 * line)], 0.45)
        yield Layer(theme.background, segments(np.array([at, at]), at + arms, 4 * line))
        yield Layer(theme.ink, arrows(np.array([at, at]), arms, 1.5 * line))
        yield Layer(theme.velocity, [at + along + disc(2.6 * line)])
        yield Layer(theme.background, [at + disc(3.4 * line)])
        yield Layer(theme.ink, stroke(at + disc(3.4 * line), 1.3 * line, closed=True))
    if cursor:
        at = view.pixel(cursor)
        arms = 5 * line * np.array([1, 1j])
        yield Layer(theme.velocity, segments(at - arms, at + arms, 1.3 * line))


def _numbers(setting: DrawSetting, frames: Frames) -> Iterator[Caption]:
    size, reach = setting.layout.small_size, _reach(setting)
    halo = Halo(setting.theme.background, 0.14 * size)
    for n, (x, y, angle) in enumerate(frames, start=1):
        at = setting.view.pixel((x, y)) - 0.45 * reach * cmath.exp(-1j * (angle + 0.6))
        top = at.real, at.imag - 0.5 * size
        yield Caption(str(n), top, size, setting.theme.ink, "centre", strong=True, halo=halo)


def grips(setting: DrawSetting, places: Iterable[Point], pins: Sequence[Point], selected: Taken) -> Group:
    """Return pins that are asked for, and rings about the linkage's points that can be dragged."""
    return Group("handles", [*_handles(setting, places, pins, selected)], over=True)


def _handles(
    setting: DrawSetting, places: Iterable[Point], pins: Sequence[Point], selected: Taken
) -> Iterator[Layer]:
    view, theme, line = setting.view, setting.theme, _line(setting)
    for place in places:
        ring = view.pixel(place) + disc(5.5 * line)
        yield Layer(theme.velocity, stroke(ring, 1.1 * line, closed=True))
    for n, place in enumerate(pins):
        at = view.pixel(place)
        if ("pin", n) == selected:
            yield Layer(ORANGE, [at + disc(8 * line)], 0.45)
        yield Layer(theme.velocity, [at + disc(5.5 * line)])
        yield Layer(theme.background, [at + disc(3.6 * line)])
        yield Layer(theme.velocity, [at + disc(1.6 * line)])


@lru_cache(maxsize=4)
def _marks(frames: Frames, count: int) -> tuple[Mark, ...]:
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
