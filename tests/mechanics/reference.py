"""Fifty-digit reference motions, by the textbook circle intersection: nothing is shared with the solver.

A pose is a function of the phase in mpmath numbers; its derivatives are central differences with a
step so small, at so many digits, that they are exact to far more digits than a float has.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpf

mp.dps = 140
STEP = mpf(10) ** -22
Points = dict[str, Any]


@dataclass(frozen=True)
class Path:
    """How the reference's input runs: it turns from `start`, or swings between two angles."""

    start: Any = mpf(0)
    limits: tuple[Any, Any] | None = None

    def angle(self, phase: Any) -> Any:
        if self.limits is None:
            return self.start + phase
        low, high = self.limits
        return (low + high) / 2 - (high - low) / 2 * mp.cos(phase)


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


def sign_of(value: Any) -> int:
    return 1 if value >= 0 else -1


def four_bar(
    lengths: tuple[Any, Any, Any, Any],
    *,
    path: Path,
    side: Callable[[Any, Any], int],
    ground_angle: Any = mpf(0),
    coupler_point: tuple[Any, Any] = (mpf(0), mpf(0)),
) -> Callable[[Any], Points]:
    """The four-bar g, r, a, b; `side(phase, psi)` is the sign of the closure there."""
    g, r, a, b = (mpf(length) for length in lengths)

    def pose(phase: Any) -> Points:
        angle = path.angle(phase)
        pin_a, pin_o4 = r * unit(angle), g * unit(ground_angle)
        pin_b = meeting(pin_a, pin_o4, a, b, side(phase, angle - ground_angle))
        along = (pin_b - pin_a) / a
        point = pin_a + along * mp.mpc(*coupler_point)
        return {"A": pin_a, "B": pin_b, "P": point}

    return pose


def slider_crank(
    crank: Any, rod: Any, offset: Any, *, path: Path, side: Callable[[Any, Any], int]
) -> Callable[[Any], Points]:
    """The slider-crank on a horizontal line `offset` above the crank's pivot."""

    def pose(phase: Any) -> Points:
        angle = path.angle(phase)
        pin_a = crank * unit(angle)
        rise = offset - mp.im(pin_a)
        square = rod**2 - rise**2
        reach = mp.sqrt(square) if square > 0 else mpf(0)
        return {"A": pin_a, "B": mp.mpc(mp.re(pin_a) + side(phase, angle) * reach, offset)}

    return pose


def derivatives(pose: Callable[[Any], Points], phase: Any) -> tuple[Points, Points, Points]:
    """Position, first and second derivative in the phase."""
    before, here, after = (pose(phase + k * STEP) for k in (-1, 0, 1))
    first = {name: (after[name] - before[name]) / (2 * STEP) for name in here}
    second = {name: (after[name] - 2 * here[name] + before[name]) / STEP**2 for name in here}
    return here, first, second
