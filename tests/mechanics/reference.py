"""References to a hundred digits, by the textbook circle intersection: nothing is shared with the solver.

A pose is a function of the phase in mpmath numbers; its derivatives are central differences with a
step so small, at so many digits, that they are exact to far more digits than a float has.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpf

DIGITS = 140
STEP = mpf(10) ** -22
NUDGE = mpf(10) ** -40
"""Added to every phase: at a limit itself the two circles touch, and the side has no sign."""

Points = dict[str, Any]
Pose = Callable[[Any], Points]


@dataclass(frozen=True)
class FourBar:
    """Ground, crank, coupler, rocker and the sides of the two circles' crossing.

    Gaps below 2^-53 of the perimeter are none: decimal lengths are rarely exact in binary.
    """

    lengths: tuple[float, float, float, float]
    side: int = 1
    ground_angle: float = 0.0
    start: float = 0.0
    decimal: bool = False
    """Lengths stand for the decimals they were written as, not for the floats nearest them."""

    @property
    def sizes(self) -> tuple[Any, ...]:
        return tuple(mpf(repr(length)) if self.decimal else mpf(length) for length in self.lengths)

    def gaps(self) -> tuple[Any, Any, Any]:
        g, r, a, b = self.sizes
        least = mpf(2) ** -53 * (g + r + a + b)
        gaps = (a + b - g - r, g - r - a + b, g - r + a - b)
        return tuple(gap if abs(gap) > least else mpf(0) for gap in gaps)

    def limits(self) -> tuple[Any, Any] | None:
        """The ends of the crank's swing, from the ground line: the cosine rule on straight bars."""
        g, r, a, b = self.sizes
        outer, first, second = self.gaps()
        far = mp.acos((g * g + r * r - (a + b) ** 2) / (2 * g * r)) if outer < 0 else None
        near = mp.acos((g * g + r * r - (a - b) ** 2) / (2 * g * r)) if first * second < 0 else None
        if far is not None and near is not None:
            return (near, far) if self.start >= 0 else (-far, -near)
        if far is not None:
            return -far, far
        return None if near is None else (near, 2 * mp.pi - near)

    def angle(self, phase: Any) -> Any:
        """The crank's angle from the ground line."""
        limits = self.limits()
        if limits is None:
            return mpf(self.start) + phase - mpf(self.ground_angle)
        low, high = limits
        return (low + high) / 2 - (high - low) / 2 * mp.cos(phase)

    def sign(self, phase: Any) -> int:
        """The side on the smooth path, up to its sign at the start."""
        outer, first, second = self.gaps()
        psi = self.angle(phase)
        signs = [1]
        if self.limits() is not None:
            signs.append(sign_of(mp.sin(phase)))
        if outer == 0:
            signs.append(sign_of(mp.cos(psi / 2)))
        if first * second == 0:
            signs.append(sign_of(mp.sin(psi / 2)))
        return product(signs)

    def pose(self) -> Pose:
        """The pins and the coupler point (a/2, a/3) at a phase."""
        g, r, a, b = self.sizes
        named = self.side * self.sign(mpf(10) ** -8)
        tilt = unit(mpf(self.ground_angle))
        share = mp.mpc(mpf(self.lengths[2] / 2), mpf(self.lengths[2] / 3)) / a

        def pose(phase: Any) -> Points:
            pin_a = r * unit(self.angle(phase))
            pin_b = meeting(pin_a, mp.mpc(g), a, b, named * self.sign(phase))
            point = pin_a + (pin_b - pin_a) * share
            return {"A": pin_a * tilt, "B": pin_b * tilt, "P": point * tilt}

        return pose


def sign_of(value: Any) -> int:
    return 1 if value >= 0 else -1


def product(signs: Sequence[int]) -> int:
    return -1 if signs.count(-1) % 2 else 1


def unit(angle: Any) -> Any:
    return mp.mpc(mp.cos(angle), mp.sin(angle))


def meeting(p: Any, q: Any, a: Any, b: Any, side: Any) -> Any:
    """Where circles about p and q cross, on the left of p -> q for a positive side."""
    d = q - p
    distance = abs(d)
    along = (distance**2 + a**2 - b**2) / (2 * distance)
    square = a**2 - along**2
    height = mp.sqrt(square) if square > 0 else mpf(0)
    return p + d / distance * mp.mpc(along, side * height)


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
