"""Choose the pose of a still: the one that reads best, near 60° of the input."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from math import sin, tau

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage import DrivenSlider
from linkanim.picture.figure import Figure, figure
from linkanim.picture.labels import TRIES, Lacking, StillLabels, Surroundings
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import motion_of
from linkanim.picture.picture import Deferral, Picture
from linkanim.picture.purpose import USUAL_SIZE
from linkanim.scenes.scene import Scene

_USUAL = 60.0
"""The input's angle that textbooks draw, in degrees."""
_POSES = 24
"""So many poses of one turn are looked at."""
_USUAL_POSES, _LOOKED_AT_AGAIN = 3, 9
"""In so many of them, those nearest to the usual input and the best, names are tried in several orders."""
_NEAR_USUAL = 4
"""So many poses nearest to the usual input are looked at where words are large: few have room in any pose."""
_MOST_NAMED = 30
"""Of more joints and pins no pose has room for all names: the usual one is as good as any."""
_HIDDEN = 0.02
"""Joints nearer to each other than this part of the figure's extent hide each other."""
_RESTS = 1e-9
"""Phases of a swing that are nearer to its end, in radians, are at its end."""


def default_phase(scene: Scene) -> float:
    """Return the phase of what is drawn or worked out without one: that of a still of usual size."""
    return still_phase(scene, USUAL_SIZE)


@lru_cache(maxsize=128)
def still_phase(scene: Scene, size: tuple[int, int], type_scale: float = 1.0) -> float:
    """Return the phase, within one turn, of the pose that reads best in a picture of that size in pixels.

    Its words are `type_scale` times as large as usual.

    That is the one in which most names and dimensions stand at what they name; of several such poses the one
    whose input is nearest to 60°, or to the middle of a range without that angle. A pose in which joints hide
    each other is taken where there is no other, one in which the input rests never: nothing has a rate there.
    The same pose is chosen whatever else the figure shows.
    """
    shown, tried = figure(scene), _tried(figure(scene))
    tried = tried[:_NEAR_USUAL] if type_scale > 1 else tried
    if len(scene.linkage.joints) > _MOST_NAMED:
        return tried[0]
    look = Look(names=2, type_scale=type_scale)
    picture = Picture(scene, size, look, later=Deferral(names="in steps"), moment=tried[0])
    labels = dict[float, StillLabels]()
    left = dict[float, Lacking]()
    # the poses at the usual input are looked at closely, then all, then the best of these closely
    for more, poses in ((True, tried[:_USUAL_POSES]), (False, tried[_USUAL_POSES:]), (True, None)):
        for phase in poses or sorted(tried, key=lambda phase: left[phase])[:_LOOKED_AT_AGAIN]:
            hidden = shown.apart[np.abs(shown.cycle.phase - phase).argmin()] < _HIDDEN * shown.extent
            worse = hidden * len(picture.figure.shown)
            if phase not in labels:
                labels[phase] = _labels(picture, phase)
            elif phase in tried[:_USUAL_POSES] or not _may_be_best(phase, labels[phase].least, worse, left):
                continue
            lengths, names = labels[phase].lacking(TRIES if more else 0)
            left[phase] = lengths + worse, names
            if not any(left[phase]):
                return phase
    return min(tried, key=lambda phase: left[phase])


def _may_be_best(phase: float, least: Lacking, worse: int, left: Mapping[float, Lacking]) -> bool:
    """Return whether a pose that lacks so much at the least could be taken of all that were looked at."""
    best = min(left, key=lambda one: left[one])
    least = least[0] + worse, least[1]
    return least < left[best] or (least == left[best] and [*left].index(phase) < [*left].index(best))


def _labels(picture: Picture, phase: float) -> StillLabels:
    """Return the labels of a pose."""
    setting = picture.drawing.setting
    centres = picture.drawing.dead_centres_in(setting.view)
    ground = Surroundings(setting, motion_of(setting), phase, centres.ticks if centres else (), angled=True)
    return StillLabels(ground, picture.drawing.symbols, centres)


def input_rests(scene: Scene, phase: float) -> bool:
    """Tell whether a phase is at an end of the input's swing."""
    return not scene.info.full_turn and abs(sin(phase)) < _RESTS


def _tried(shown: Figure) -> list[float]:
    """Return phases of one turn, those near the usual input first."""
    phase, value = shown.cycle.phase, np.broadcast_to(shown.cycle.coordinate, shown.cycle.phase.shape)
    turn = np.flatnonzero(phase < tau - 1e-9)
    off = _off(shown, value)[turn]
    taken = {int(off.argmin()), *np.linspace(0, len(turn), _POSES, endpoint=False).astype(int).tolist()}
    order = sorted(taken, key=lambda n: (round(float(off[n]), 6), n))
    tried = [float(phase[turn[n]]) for n in order]
    return [one for one in tried if not input_rests(shown.scene, one)]


def _off(shown: Figure, value: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far the input is from its usual place: in degrees, or of a slider in its unit."""
    if isinstance(shown.linkage.driven.joint, DrivenSlider):
        return np.asarray(np.abs(value - (value.min() + value.max()) / 2))
    angle = np.degrees(value)
    low, high = angle.min(), angle.max()
    if shown.scene.info.full_turn:
        return np.asarray(np.abs((angle - _USUAL + 180) % 360 - 180))
    return np.asarray(np.abs(angle - (_USUAL if low <= _USUAL <= high else (low + high) / 2)))
