"""Scrubbing: from where the mouse has dragged the crank to the phase that puts it there."""

from __future__ import annotations

import math

from linkanim.scenes.scene import Scene


def phase_towards(scene: Scene, phase: float, point: tuple[float, float]) -> float:
    """Return the phase near `phase` at which the input crank points at `point` (scene's unit).

    An input that swings stops at its limits; of the two phases of an angle it is the nearer one, and
    past a limit the way back is the one not come by. A point on the pivot itself changes nothing.
    """
    crank = scene.linkage.crank(scene.linkage.drive.joint)
    pivot = scene.pose(phase, 0).position[crank.pivot]
    x, y = point[0] - pivot[0], point[1] - pivot[1]
    return phase if x == 0.0 == y else scene.mechanism.assembly.path.phase_of(math.atan2(y, x), phase)
