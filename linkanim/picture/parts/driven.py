"""What the input is called, and the unit in which its speed is told."""

from __future__ import annotations

from functools import lru_cache
from math import pi

from linkanim.digits import short, typeset
from linkanim.errors import UnitError
from linkanim.scenes.scene import Scene
from linkanim.units import SPEED, split

_PER_RADIAN = {"rad/s": 1.0, "rpm": 30 / pi, "deg/s": 180 / pi}
_SIGNS = {"deg/s": "°/s"}
_SPELT = {"°/s": "deg/s"}


def driven_words(scene: Scene, value: float) -> str:
    """Return where the input is in words: its angle, 87.0°; of a slider that drives its travel, 12.5 mm."""
    coordinate = scene.linkage.drive.coordinate
    return coordinate.text(value, scene.length_unit, 0.1 if coordinate.is_angle else scene.length_step)


def speed_unit(scene: Scene) -> str:
    """Return the unit in which the scene states its input's speed, rpm where it states none."""
    return _unit_of(str(scene.document.get("drive", {}).get("speed", "")))


@lru_cache(maxsize=64)
def _unit_of(stated: str) -> str:
    """Return the unit of a speed as it is stated; asked for at every frame, the last ones are kept."""
    try:
        unit = split(stated)[1]
    except UnitError:
        return "rpm"
    unit = _SPELT.get(unit, unit)
    return unit if unit in SPEED.factors else "rpm"


def speed_in(unit: str, speed: float) -> float:
    """Return an angular speed in rad/s in "rpm", "rad/s" or "deg/s"."""
    return speed * _PER_RADIAN[unit]


def sign_of(unit: str) -> str:
    """Return a unit of speed as it is set: °/s for deg/s."""
    return _SIGNS.get(unit, unit)


def speed_words(scene: Scene, speed: float) -> str:
    """Return the input's speed (rad/s) in words: "20 rpm", clockwise negative; of a swing "15 swings/min".

    One there-and-back of a slider is a cycle.
    """
    if not scene.info.full_turn:
        there_and_back = scene.linkage.drive.actuator.cycles
        return f"{short(abs(speed) * _PER_RADIAN['rpm'])} {there_and_back}/min"
    unit = speed_unit(scene)
    return f"{typeset(short(speed_in(unit, speed)))} {sign_of(unit)}"
