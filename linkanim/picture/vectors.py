"""Velocity and acceleration arrows at traced joints and centres of mass."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from linkanim.mechanics.motion import Motion, Pose
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import arrows
from linkanim.picture.theme import Theme
from linkanim.picture.view import View

Kind = Literal["v", "a"]
LONGEST = 0.22
"""The longest arrow of a cycle, as a share of the window's height."""
_ORDER = {"v": 1, "a": 2}


@dataclass(frozen=True)
class Arrows:
    """Arrows of one kind, all to one scale over the whole cycle.

    `most` is the largest value of the cycle at the scene's own speed; it is drawn `longest` pixels long.
    """

    kind: Kind
    words: str
    unit: str
    most: float
    longest: float
    drive: float
    colour: Colour
    halo: Colour
    gauge: Gauge

    def scale(self, speed: float) -> float:
        """Return pixels for one unit of length and second at this input speed (rad/s of phase).

        It changes with the input's speed and with nothing else, so that an arrow's length tells
        where in the cycle the motion is fast, whatever the speed.
        """
        faster = abs(speed / self.drive) ** _ORDER[self.kind]
        return self.longest / (self.most * faster) if self.most > 0 and faster > 0 else 0.0

    def layers(self, pose: Pose, view: View, joints: tuple[str, ...]) -> list[Layer]:
        """Return the arrows of a pose, in a halo that parts them from what is below."""
        scale = self.scale(pose.input_speed)
        found = [
            (view.place(place), complex(scale * x, -scale * y))
            for place, (x, y) in _values(pose, self.kind, joints)
        ]
        seen = [(foot, reach) for foot, reach in found if 0.01 < abs(reach) / self.longest < 100]
        if not seen:
            return []
        feet, reaches = np.array(seen + seen).T
        rims = np.repeat([0.75 * self.gauge.line, 0.0], len(seen))
        drawn = arrows(feet, reaches, 1.6 * self.gauge.line, rims)
        return [Layer(self.halo, drawn[: len(seen)]), Layer(self.colour, drawn[len(seen) :])]


def _values(pose: Pose, kind: Kind, joints: tuple[str, ...]) -> list[tuple[Any, Any]]:
    values: Mapping[str, Any] = pose.velocity if kind == "v" else pose.acceleration
    of_mass: Mapping[str, Any] = pose.com_velocity if kind == "v" else pose.com_acceleration
    at_joints = [(pose.position[joint], values[joint]) for joint in joints]
    return at_joints + [(pose.com_position[body], value) for body, value in of_mass.items()]


def arrows_of(figure: Figure, kind: Kind, height: int, gauge: Gauge, theme: Theme) -> Arrows:
    """Return the arrows of one kind, scaled to the largest finite value of the cycle."""
    colour = theme.velocity if kind == "v" else theme.acceleration
    most = _most(figure.cycle, kind, figure.scene.trace)
    drive = figure.linkage.drive.speed
    words, per = ("velocity", "/s") if kind == "v" else ("acceleration", "/s²")
    unit = figure.scene.length_unit + per
    return Arrows(kind, words, unit, most, LONGEST * height, drive, colour, theme.background, gauge)


def _most(cycle: Motion, kind: Kind, joints: tuple[str, ...]) -> float:
    values = cycle.velocity if kind == "v" else cycle.acceleration
    of_mass = cycle.com_velocity if kind == "v" else cycle.com_acceleration
    rows = [np.atleast_2d(row) for row in (*(values[joint] for joint in joints), *of_mass.values())]
    sizes = (
        np.concatenate([np.sqrt(row[:, 0] ** 2 + row[:, 1] ** 2) for row in rows]) if rows else np.zeros(1)
    )
    finite = sizes[np.isfinite(sizes)]
    return float(finite.max()) if finite.size else 0.0
