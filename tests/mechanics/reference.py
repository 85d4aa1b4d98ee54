"""References to a hundred digits, by the textbook circle intersection: nothing is shared with the solver.

A pose is a function of the phase in mpmath numbers; its derivatives are central differences with a
step so small, at so many digits, that they are exact to far more digits than a float has.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpf

from linkanim.bench.reference import crossing

HIGHEST_FIRST = ((2, "acceleration"), (1, "velocity"), (0, "position"))
"""Orders of rates and their names: what works out the highest works out all."""
DIGITS = 140
STEP = mpf(10) ** -22
NUDGE = mpf(10) ** -40
"""Added to every phase: at a limit itself the two circles touch, and the side has no sign."""

Length = float | str
"""A string is a decimal number, taken as it is written: the float nearest to it is not what was meant."""
Points = dict[str, Any]
Pose = Callable[[Any], Points]


@dataclass(frozen=True)
class ExactFourBar:
    """Ground, crank, coupler and rocker, O4 on the real axis, on the smooth path that the crank drives.

    `side` is the closure just after phase 0, +1 for B left of A -> O4. A crank that turns fully stands at
    `start` there; of two separate ranges a negative `start` means the one below the ground line.
    Gaps below 2^-53 of the perimeter are none: decimal lengths are rarely exact in binary.
    """

    lengths: tuple[Length, Length, Length, Length]
    side: int = 1
    start: Any = 0

    @property
    def sizes(self) -> tuple[Any, ...]:
        """The lengths in as many digits as mpmath has at present."""
        return tuple(mpf(length) for length in self.lengths)

    @property
    def gaps(self) -> tuple[Any, Any, Any]:
        """What is left when the bars are in line: stretched, and folded either way; 0 at a change point."""
        g, r, a, b = self.sizes
        least = mpf(2) ** -53 * (g + r + a + b)
        gaps = (a + b - g - r, g - r - a + b, g - r + a - b)
        return tuple(gap if abs(gap) > least else mpf(0) for gap in gaps)

    @property
    def limits(self) -> tuple[Any, Any] | None:
        """The ends of the crank's swing, by the law of cosines on bars in line; None where it turns fully."""
        g, r, a, b = self.sizes
        outer, first, second = self.gaps
        far = mp.acos((g * g + r * r - (a + b) ** 2) / (2 * g * r)) if outer < 0 else None
        near = mp.acos((g * g + r * r - (a - b) ** 2) / (2 * g * r)) if first * second < 0 else None
        if far is not None and near is not None:
            return (near, far) if self.start >= 0 else (-far, -near)
        if far is not None:
            return -far, far
        return None if near is None else (near, 2 * mp.pi - near)

    def angle(self, phase: Any) -> Any:
        """Return the crank's angle from the ground line."""
        if self.limits is None:
            return self.start + phase
        low, high = self.limits
        return (low + high) / 2 - (high - low) / 2 * mp.cos(phase)

    def phase_at(self, angle: Any) -> Any:
        """Return the phase at an angle of a swing, on the way up."""
        assert self.limits is not None
        low, high = self.limits
        return mp.acos((low + high - 2 * angle) / (high - low))

    def side_at(self, phase: Any) -> int:
        """Return the closure on the smooth path: it changes at limits and at change points."""
        return self.side * self._sign(mpf(10) ** -8) * self._sign(phase)

    def _sign(self, phase: Any) -> int:
        """Return the sign that the path gives the closure, up to the one at the start."""
        outer, first, second = self.gaps
        half = self.angle(phase) / 2
        sign = 1 if self.limits is None else sign_of(mp.sin(phase))
        sign *= sign_of(mp.cos(half)) if outer == 0 else 1
        return sign * (sign_of(mp.sin(half)) if first * second == 0 else 1)


def sign_of(value: Any) -> int:
    """Return -1 for a negative number, else 1."""
    return 1 if value >= 0 else -1


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
