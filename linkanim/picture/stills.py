"""Choose the pose of a still: the one that reads best, near 60° of the input."""

from __future__ import annotations

from functools import lru_cache
from math import sin, tau

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.figure import Figure, figure
from linkanim.scenes.scene import Scene

_USUAL = 60.0
"""The input's angle in textbooks' drawings, in degrees."""
_POSES = 24
"""The number of poses of one turn among which the still's is chosen."""
_DISTINCT = (0.02, 0.01, 0.004)
"""How far apart joints are, in shares of the figure's extent: less where there is no such pose."""
_RESTS = 1e-9
"""Phases nearer than this to the end of a swing, in radians, are at its end."""


@lru_cache(maxsize=128)
def still_phase(scene: Scene) -> float:
    """Return the phase, within one turn, of the pose that reads best.

    It is the pose whose input is nearest to 60°, or to the middle of a range without that angle, and in which
    no joints crowd each other; where they always do, the pose in which they are farthest apart. A pose in
    which the input rests is never taken, since nothing moves there.
    """
    shown = figure(scene)
    tried = _tried(shown)
    apart = [shown.apart[np.abs(shown.cycle.phase - phase).argmin()] for phase in tried]
    for least in _DISTINCT:
        for phase, distance in zip(tried, apart, strict=True):
            if distance >= least:
                return phase
    return tried[int(np.argmax(apart))]


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
    if not shown.linkage.drive.coordinate.is_angle:
        return np.asarray(np.abs(value - (value.min() + value.max()) / 2))
    angle = np.degrees(value)
    low, high = angle.min(), angle.max()
    if shown.scene.info.full_turn:
        return np.asarray(np.abs((angle - _USUAL + 180) % 360 - 180))
    return np.asarray(np.abs(angle - (_USUAL if low <= _USUAL <= high else (low + high) / 2)))
