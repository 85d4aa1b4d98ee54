"""Fifty-digit answers by the plainest closed form: where two circles cross.

Nothing is shared with the solver. At fifty digits the square root of a difference may lose half of
them and still have more than a float holds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.cases import Case
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
    ground, crank, coupler, rocker = lengths = [mpf(length) for length in case.lengths]
    for given in map(mpf, case.inputs.tolist()):
        angle, phase = (given, given) if case.turns else _swing(case, lengths, given)
        a, sign = crank * mp.expj(angle), _sign(case, lengths, phase)
        b, other = (crossing(a, ground, coupler, rocker, side) for side in (sign, -sign))
        point = mpc(FourBarLengths(1, 1, 1, 1).point)
        yield Closures(angle, phase, sign, b, a + (b - a) * point, other, a + (other - a) * point)


def crossing(p: Any, q: Any, a: Any, b: Any, side: int) -> Any:
    """Return where circles of radius a about p and b about q cross, left of p -> q for side +1.

    Circles that miss each other by rounding touch.
    """
    way = q - p
    distance = abs(way)
    along = (distance**2 + a**2 - b**2) / (2 * distance)
    square = a**2 - along**2
    return p + way / distance * mpc(along, side * mp.sqrt(max(square, mpf(0))))


def limits(lengths: list[Any]) -> tuple[Any, Any]:
    """Return between which angles, 0 to π, the crank can lie: where the two bars are in one line."""
    ground, crank, coupler, rocker = lengths
    return tuple(
        mp.acos(min(max((ground**2 + crank**2 - reach**2) / (2 * ground * crank), mpf(-1)), mpf(1)))
        for reach in (coupler - rocker, coupler + rocker)
    )


def _swing(case: Case, lengths: list[Any], given: Any) -> tuple[Any, Any]:
    """Return angle and phase of a swing, mid - amp cos φ, above the ground line or across it."""
    inner, outer = limits(lengths)
    low = inner if inner > 0 else -outer
    middle, amplitude = (low + outer) / 2, (outer - low) / 2
    if case.by_phase:
        return middle - amplitude * mp.cos(given), given
    return given, mp.acos((middle - given) / amplitude)


def _sign(case: Case, lengths: list[Any], phase: Any) -> int:
    """Return the closure on the smooth path: it changes at limits and at change points.

    The crank stands at a change point at 0 where r1 - r2 = ±(r3 - r4), at π where r1 + r2 = r3 + r4.
    """
    ground, crank, coupler, rocker = lengths
    if not case.turns:
        return case.side * _sign_of(mp.sin(phase))
    nothing = mpf(10) ** (5 - DIGITS)
    at_pi = abs(coupler + rocker - ground - crank) < nothing
    at_zero = abs(abs(coupler - rocker) - abs(ground - crank)) < nothing
    sign = case.side
    sign *= _sign_of(mp.cos(phase / 2)) if at_pi else 1
    sign *= _sign_of(mp.sin(phase / 2)) if at_zero else 1
    return sign


def _sign_of(value: Any) -> int:
    return 1 if value >= 0 else -1


def _rounded(values: Iterator[Any]) -> Complexes:
    return np.array([complex(value) for value in values])


def _exact(values: list[Any]) -> Exact:
    high = _rounded(iter(values))
    low = _rounded(value - mpc(near) for value, near in zip(values, high.tolist(), strict=True))
    return Exact(high, low)
