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
"""The input's angle in textbooks' drawings, in degrees."""
_POSES = 24
"""The number of poses of one turn among which the still's is chosen."""
_USUAL_POSES, _LOOKED_AT_AGAIN = 3, 9
"""The numbers of poses in which names are tried in several orders: nearest to the usual input, and best."""
_NEAR_USUAL = 4
"""Where words are large, only this many poses nearest to the usual input are tried: few have room anyway."""
_MOST_NAMED = 30
"""With more joints and pins no pose has room for all names: the usual pose is as good as any."""
_HIDDEN = 0.02
"""Joints nearer to each other than this share of the figure's extent hide each other."""
_RESTS = 1e-9
"""Phases nearer than this to the end of a swing, in radians, are at its end."""


def default_phase(scene: Scene) -> float:
    """Return the phase for drawings and solutions that state none: that of a still of usual size."""
    return still_phase(scene, USUAL_SIZE)


@lru_cache(maxsize=128)
def still_phase(scene: Scene, size: tuple[int, int], type_scale: float = 1.0) -> float:
    """Return the phase, within one turn, of the pose that reads best in a picture of that size in pixels.

    Words are `type_scale` times as large as usual.

    It is the pose in which most names and dimensions stand at what they name; of several such poses, the one
    whose input is nearest to 60°, or to the middle of a range without that angle. A pose in which joints hide
    each other is taken only where there is no other. A pose in which the input rests is never taken, since
    nothing moves there. The choice does not depend on what else the figure shows.
    """
    shown, tried = figure(scene), _tried(figure(scene))
    tried = tried[:_NEAR_USUAL] if type_scale > 1 else tried
    if len(scene.linkage.joints) > _MOST_NAMED:
        return tried[0]
    look = Look(names=2, type_scale=type_scale)
    picture = Picture(scene, size, look, later=Deferral(names="in steps"), moment=tried[0])
    labels = dict[float, StillLabels]()
    left = dict[float, Lacking]()
    # the poses at the usual input are tried thoroughly, then all others quickly, then the best of all
    # thoroughly
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
    """Return whether a pose that lacks at least so many labels could still be the best of those tried."""
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
    """Return how far the input is from its usual place: in degrees, or for a slider in the scene's unit."""
    if isinstance(shown.linkage.driven.joint, DrivenSlider):
        return np.asarray(np.abs(value - (value.min() + value.max()) / 2))
    angle = np.degrees(value)
    low, high = angle.min(), angle.max()
    if shown.scene.info.full_turn:
        return np.asarray(np.abs((angle - _USUAL + 180) % 360 - 180))
    return np.asarray(np.abs(angle - (_USUAL if low <= _USUAL <= high else (low + high) / 2)))
