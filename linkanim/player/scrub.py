"""Scrubbing: from where the mouse has dragged the crank to the phase that puts it there."""

from __future__ import annotations

import math

from linkanim.mechanics.kinds import Crank
from linkanim.scenes.scene import Scene


def phase_towards(scene: Scene, phase: float, point: tuple[float, float]) -> float:
    """Return the phase near `phase` at which the input crank points at `point` (scene's unit).

    An input that swings stops at its limits; of the two phases of an angle it is the nearer one, and
    past a limit the way back is the one not come by. A point on the pivot itself changes nothing.
    """
    crank = scene.linkage.joint(scene.linkage.drive.joint)
    assert isinstance(crank, Crank)
    pivot = scene.pose(phase, 0).position[crank.pivot]
    x, y = point[0] - pivot[0], point[1] - pivot[1]
    return phase if x == 0.0 == y else phase_of_angle(scene, phase, math.atan2(y, x))


def phase_of_angle(scene: Scene, phase: float, angle: float) -> float:
    """Return the phase nearest to `phase` at which the crank's angle is `angle`, whole turns aside."""
    now = scene.pose(phase, 0).crank_angle
    if scene.info.full_turn:
        return phase + math.remainder(angle - now, math.tau)
    low, high = scene.info.input_range
    middle, reach = (low + high) / 2, (high - low) / 2
    away = math.remainder(angle - middle, math.tau)
    rising = math.acos(min(max(-away / reach, -1.0), 1.0))
    return min((_nearest(phase, rising), _nearest(phase, -rising)), key=lambda found: abs(found - phase))


def _nearest(phase: float, other: float) -> float:
    return phase + math.remainder(other - phase, math.tau)
