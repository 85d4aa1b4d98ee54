"""Where the hand turns the input to: towards a point of the scene, or along a direction."""

from __future__ import annotations

import cmath
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


def phase_along(scene: Scene, phase: float, way: complex) -> float:
    """Return the phase near `phase` at which the input crank points along `way` (x + yi, y up).

    As `phase_towards` at limits. A slider that drives stands as far along its guide as `way`, of length 1
    at the most, reaches along it from the middle: at 1 it is at its end.
    """
    path, driven = scene.mechanism.assembly.path, scene.linkage.joint(scene.linkage.drive.joint)
    if not isinstance(driven, DrivenSlider):
        return path.phase_of(cmath.phase(way), phase)
    low, high = scene.info.input_range
    along = (way * complex(*unit(driven.line.angle)).conjugate()).real
    return path.phase_of((low + high) / 2 + along * (high - low) / 2, phase)
