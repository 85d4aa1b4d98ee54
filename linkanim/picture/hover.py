"""The two arrows of a joint under the mouse, and lights where the mouse points at an instant."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.motion import Motion, Pose
from linkanim.picture.drawn import Addition
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Group
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import arrows, disc

_LONGEST = 0.16
"""The longest arrow of a joint's cycle, in heights of the picture."""
Greatest = tuple[float, float]
"""A joint's greatest speed and acceleration over the cycle."""


def greatest(cycle: Motion, joint: str) -> Greatest:
    """Return a joint's greatest finite speed and acceleration over a cycle; 0 where it stands still."""
    sizes = (np.hypot(*np.atleast_2d(rates[joint]).T) for rates in (cycle.velocity, cycle.acceleration))
    speed, acceleration = (float(np.where(np.isfinite(one), one, 0.0).max()) for one in sizes)
    return speed, acceleration


@frozen
class HoverArrows(Addition):
    """The arrows of the joint under the mouse, to the scale of its own greatest values."""

    joint: str

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the two arrows."""
        most = greatest(setting.figure.cycle, self.joint)
        yield Group("hover-arrows", [*_arrows(setting, pose, self.joint, most)], over=True)


def _arrows(setting: DrawSetting, pose: Pose, joint: str, most: Greatest) -> Iterator[Layer]:
    """Yield a joint's arrows, each over its rim in the ground's colour."""
    theme, longest = setting.theme, _LONGEST * setting.layout.size[1]
    foot, width = [setting.view.pixel(pose.position[joint])], 1.8 * setting.gauge.line
    faster = abs(pose.input_speed / setting.figure.linkage.drive.speed)
    kinds = (
        (pose.velocity[joint], most[0] * faster, theme.velocity),
        (pose.acceleration[joint], most[1] * faster**2, theme.acceleration),
    )
    for (x, y), largest, colour in kinds:
        reach = longest * complex(x, -y) / largest if largest > 0.0 else 0j
        if 0.01 * longest < abs(reach) <= 2.0 * longest:
            yield Layer(theme.background, arrows(foot, [reach], width, 0.5 * width))
            yield Layer(colour, arrows(foot, [reach], width))


def instant(setting: DrawSetting, places: list[complex]) -> Iterator[Layer]:
    """Yield a light on each curve, where its joint is at the instant under the mouse."""
    for middle in places:
        for reach, alpha in ((2.0, 0.2), (1.3, 0.35), (0.7, 0.9)):
            yield Layer(setting.theme.acceleration, [middle + disc(reach * setting.gauge.bar)], alpha)
