"""Velocity and acceleration arrows at traced joints and centres of mass."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import Any, Literal

import numpy as np

from linkanim.mechanics.motion.motion import Motion, Pose
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import arrows
from linkanim.picture.theme import Theme
from linkanim.picture.view import View

Kind = Literal["v", "a"]
LONGEST = 0.22
"""The longest arrow of a cycle, as a share of the window's height."""
ORDER = {"v": 1, "a": 2}


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
        faster = abs(speed / self.drive) ** ORDER[self.kind]
        return self.longest / (self.most * faster) if self.most > 0 and faster > 0 else 0.0

    def seen(self, pose: Pose, view: View, joints: tuple[str, ...]) -> list[tuple[complex, complex]]:
        """Return foot and reach of each arrow of a pose that is long enough to be seen, in pixels."""
        scale = self.scale(pose.input_speed)
        found = [
            (view.place(place), complex(scale * x, -scale * y))
            for place, (x, y) in _values(pose, self.kind, joints)
        ]
        return [arrow for arrow in found if 0.01 < abs(arrow[1]) / self.longest < 100]


def arrow_layers(
    kinds: Sequence[Arrows], pose: Pose, view: View, joints: tuple[str, ...]
) -> list[list[Layer]]:
    """Return the arrows of a pose, kind by kind, each in a halo that parts them from what is below.

    All kinds go through the arithmetic together.
    """
    seen = [kind.seen(pose, view, joints) for kind in kinds]
    every = [arrow for arrows_ in seen for arrow in arrows_]
    if not every:
        return [[] for _ in kinds]
    line, count = kinds[0].gauge.line, len(every)
    feet, reaches = np.array(every + every).T
    drawn = arrows(feet, reaches, 1.6 * line, np.repeat([0.75 * line, 0.0], count))
    rims, bare = drawn[:count], drawn[count:]
    ends = pairwise((0, *accumulate(map(len, seen))))
    return [
        [Layer(kind.halo, rims[begin:end]), Layer(kind.colour, bare[begin:end])] if begin < end else []
        for kind, (begin, end) in zip(kinds, ends, strict=True)
    ]


def _values(pose: Pose, kind: Kind, joints: tuple[str, ...]) -> list[tuple[Any, Any]]:
    values, of_mass = _rates(pose, kind)
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
    values, of_mass = _rates(cycle, kind)
    rows = [np.atleast_2d(row) for row in (*(values[joint] for joint in joints), *of_mass.values())]
    sizes = np.concatenate([np.zeros(1), *(np.sqrt(row[:, 0] ** 2 + row[:, 1] ** 2) for row in rows)])
    return float(sizes[np.isfinite(sizes)].max())


def _rates(motion: Motion | Pose, kind: Kind) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Return the velocities or the accelerations of the joints, and of the centres of mass."""
    if kind == "v":
        return motion.velocity, motion.com_velocity
    return motion.acceleration, motion.com_acceleration
