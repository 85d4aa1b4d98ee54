"""Scrubbing: from where the mouse has dragged the crank, or the slider, to the phase that puts it there."""

from __future__ import annotations

import math

from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.linkage.pins import DrivenSlider
from linkanim.scenes.scene import Scene


def phase_towards(scene: Scene, phase: float, point: tuple[float, float]) -> float:
    """Return the phase near `phase` at which the input crank points at `point` (scene's unit).

    A slider that drives comes as near to the point as its guide lets it.

    An input that swings stops at its limits; of the two phases of an angle it is the nearer one, and
    past a limit the way back is the one not come by. A point on the pivot itself changes nothing.
    """
    path, driven = scene.mechanism.assembly.path, scene.linkage.joint(scene.linkage.drive.joint)
    if isinstance(driven, DrivenSlider):
        base, (along, left) = scene.linkage.pin(driven.line.through).position, unit(driven.line.angle)
        travel = (point[0] - base[0]) * along + (point[1] - base[1]) * left
        return path.phase_of(travel, phase)
    crank = scene.linkage.crank(driven.name)
    pivot = scene.pose(phase, 0).position[crank.pivot]
    x, y = point[0] - pivot[0], point[1] - pivot[1]
    return phase if x == 0.0 == y else path.phase_of(math.atan2(y, x), phase)
