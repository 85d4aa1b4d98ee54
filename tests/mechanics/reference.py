"""References to a hundred digits, by the textbook circle intersection: nothing is shared with the solver.

A pose is a function of the phase in mpmath numbers; its derivatives are central differences with a
step so small, at so many digits, that they are exact to far more digits than a float has.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpf

from linkanim.bench.cases import Length
from linkanim.bench.reference import ExactFourBar, crossing

DIGITS = 140
STEP = mpf(10) ** -22
NUDGE = mpf(10) ** -40
"""Added to every phase: at a limit itself the two circles touch, and the side has no sign."""

Points = dict[str, Any]
Pose = Callable[[Any], Points]


@dataclass(frozen=True)
class FourBar:
    """A four-bar on ground at any angle, its start an absolute one."""

    lengths: tuple[Length, Length, Length, Length]
    side: int = 1
    ground_angle: float = 0.0
    start: float = 0.0

    @property
    def floats(self) -> tuple[float, float, float, float]:
        ground, crank, coupler, rocker = map(float, self.lengths)
        return ground, crank, coupler, rocker

    @property
    def level(self) -> ExactFourBar:
        """The same on level ground."""
        return ExactFourBar(self.lengths, self.side, mpf(self.start) - mpf(self.ground_angle))

    def pose(self) -> Pose:
        """The pins and the coupler point (a/2, a/3) at a phase."""
        bars = self.level
        g, r, a, b = bars.sizes
        tilt = unit(mpf(self.ground_angle))
        share = mp.mpc(mpf(self.floats[2] / 2), mpf(self.floats[2] / 3)) / a

        def pose(phase: Any) -> Points:
            pin_a = r * unit(bars.angle(phase))
            pin_b = crossing(pin_a, mp.mpc(g), a, b, bars.side_at(phase))
            point = pin_a + (pin_b - pin_a) * share
            return {"A": pin_a * tilt, "B": pin_b * tilt, "P": point * tilt}

        return pose


def unit(angle: Any) -> Any:
    return mp.mpc(mp.cos(angle), mp.sin(angle))


def on_line(p: Any, rod: Any, offset: Any, side: int) -> Any:
    """Where a rod from p meets the horizontal line `offset` above the origin."""
    rise = offset - mp.im(p)
    square = rod**2 - rise**2
    reach = mp.sqrt(square) if square > 0 else mpf(0)
    return mp.mpc(mp.re(p) + side * reach, offset)


def derivatives(pose: Pose, phase: Any) -> tuple[Points, Points, Points]:
    """Position, first and second derivative in the phase."""
    before, here, after = (pose(phase + k * STEP) for k in (-1, 0, 1))
    first = {name: (after[name] - before[name]) / (2 * STEP) for name in here}
    second = {name: (after[name] - 2 * here[name] + before[name]) / STEP**2 for name in here}
    return here, first, second
