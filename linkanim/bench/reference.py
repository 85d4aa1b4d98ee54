"""Answers of many digits by the plainest closed form: where two circles cross.

Nothing is shared with the solver. At fifty digits the square root of a difference may lose half of
them and still have more than a float holds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.cases import Case, Length
from linkanim.bench.question import Complexes, Floats, FourBarLengths, Points, Question

DIGITS = 50


class Closures(NamedTuple):
    """An exact pose: B and P of the closure asked for, and of the other one."""

    angle: Any
    phase: Any
    sign: int
    b: Any
    p: Any
    other_b: Any
    other_p: Any


@dataclass(frozen=True)
class Exact:
    """Complex numbers to twice a float's digits: the nearest floats, and what they leave."""

    high: Complexes
    low: Complexes

    def distance(self, found: Complexes) -> Floats:
        """Return how far floats are from these numbers, without rounding the numbers first."""
        apart: Floats = np.abs((found - self.high) - self.low)
        return apart


@dataclass(frozen=True)
class Answer:
    """A case put as a question, with the exact points of both closures."""

    question: Question
    b: Exact
    p: Exact
    other: Points


def answer(case: Case) -> Answer:
    """Return a case with its fifty-digit poses."""
    with workdps(DIGITS):
        poses = list(closures(case))
        b, p = (_exact([getattr(pose, name) for pose in poses]) for name in ("b", "p"))
        other = Points(_rounded(pose.other_b for pose in poses), _rounded(pose.other_p for pose in poses))
        angles, phases = (
            np.array([float(getattr(pose, name)) for pose in poses]) for name in ("angle", "phase")
        )
        named = np.array([float(case.side if case.turns else pose.sign) for pose in poses])
    bars = FourBarLengths(*(float(length) for length in case.lengths))
    start = complex(b.high[0])
    by_angle = not (case.turns or case.by_phase)
    question = Question(bars, case.side, angles, named, start, phases, case.periods, by_angle)
    return Answer(question, b, p, other)


def closures(case: Case) -> Iterator[Closures]:
    """Yield the exact pose at each input of a case, at mpmath's present precision."""
    bars = ExactFourBar(case.lengths, case.side)
    ground, crank, coupler, rocker = bars.sizes
    for given in map(mpf, case.inputs.tolist()):
        phase = given if case.turns or case.by_phase else bars.phase_at(given)
        angle, side = bars.angle(phase), bars.side_at(phase)
        a = crank * mp.expj(angle)
        b, other = (crossing(a, ground, coupler, rocker, sign) for sign in (side, -side))
        point = mpc(FourBarLengths(1, 1, 1, 1).point)
        yield Closures(angle, phase, side, b, a + (b - a) * point, other, a + (other - a) * point)


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


def crossing(p: Any, q: Any, a: Any, b: Any, side: int) -> Any:
    """Return where circles of radius a about p and b about q cross, left of p -> q for side +1.

    Circles that miss each other by rounding touch.
    """
    way = q - p
    distance = abs(way)
    along = (distance**2 + a**2 - b**2) / (2 * distance)
    square = a**2 - along**2
    return p + way / distance * mpc(along, side * mp.sqrt(max(square, mpf(0))))


def sign_of(value: Any) -> int:
    """Return -1 for a negative number, else 1."""
    return 1 if value >= 0 else -1


def _rounded(values: Iterator[Any]) -> Complexes:
    return np.array([complex(value) for value in values])


def _exact(values: list[Any]) -> Exact:
    high = _rounded(iter(values))
    low = _rounded(value - mpc(near) for value, near in zip(values, high.tolist(), strict=True))
    return Exact(high, low)
