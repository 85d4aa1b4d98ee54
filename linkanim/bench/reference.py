"""Answers of many digits by the plainest closed forms: where circles and lines cross.

Nothing is shared with the solver. The square root of a difference may lose half of the digits and still have
more than a float holds; rates are central differences of a step so small, at so many digits, that they are
exact to far more than a float has.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.cases import Case
from linkanim.bench.chain import (
    Complexes,
    Dyad,
    DyadChain,
    FixedStep,
    Floats,
    Places,
    Question,
    SlideStep,
    Step,
    TurnStep,
    chain_of,
    circle_dyad,
    longest_of,
    placed,
)
from linkanim.mechanics.linkage.dyads import RRR

DIGITS = 140
STEP = mpf(10) ** -22
NUDGE = mpf(10) ** -40
"""Added to every input: at a limit itself the two circles touch, and the side has no sign."""
Pose = dict[str, Any]


@dataclass(frozen=True)
class Exact:
    """Complex numbers to twice a float's digits: the nearest floats, and what they leave."""

    high: Complexes
    low: Complexes

    def distance(self, found: Any) -> Floats:
        """Return how far floats are from these numbers, without rounding the numbers first."""
        apart: Floats = np.abs((found - self.high) - self.low)
        return apart


@dataclass(frozen=True)
class Answer:
    """A case put as a question, with exact positions and rates, and where each dyad's other closure is."""

    question: Question
    orders: tuple[Mapping[str, Exact], ...]
    other: Mapping[str, Complexes]


def answer(case: Case) -> Answer:
    """Return a case with its poses in many digits."""
    with workdps(DIGITS):
        path = CasePath(case)
        inputs = [mpf(given) + NUDGE for given in case.inputs.tolist()]
        poses = [[path.pose(given + k * STEP) for given in inputs] for k in (-1, 0, 1)]
        moving = [step.name for step in path.chain.steps]
        orders = tuple(
            {name: _exact(list(_order(order, name, poses))) for name in moving} for order in range(3)
        )
        others = [path.others(pose) for pose in poses[1]]
        other = {dyad.name: _rounded([places[dyad.name] for places in others]) for dyad in path.chain.dyads}
        question = _question(case, path, inputs, orders[0])
    return Answer(question, orders, other)


def _question(case: Case, path: CasePath, inputs: list[Any], places: Mapping[str, Exact]) -> Question:
    chain, phases = path.chain, [path.phase(given) for given in inputs]
    named = {
        dyad.name: [dyad.side if case.swing is None else path.side(dyad, phase) for phase in phases]
        for dyad in chain.dyads
    }
    return Question(
        case.scene,
        chain,
        _floats([path.angle(given) for given in inputs]),
        _floats(phases),
        _rates(path, inputs),
        {name: _floats(sides) for name, sides in named.items()},
        {name: complex(place.high[0]) for name, place in places.items()},
        tuple(places),
        longest_of(case.scene.linkage),
        case.periods,
        case.by_angle,
    )


def _rates(path: CasePath, inputs: list[Any]) -> tuple[Floats, Floats]:
    """Return the first and the second derivative of the input's angle in what is given."""
    ways = [[path.angle(given + k * STEP) - path.angle(given) for k in (-1, 1)] for given in inputs]
    first = [(after - before) / (2 * STEP) for before, after in ways]
    return _floats(first), _floats([(after + before) / STEP**2 for before, after in ways])


def _order(order: int, name: str, poses: list[list[Pose]]) -> Iterator[Any]:
    """Yield a joint's positions, or their first or second derivative in what is given."""
    for before, here, after in zip(*poses, strict=True):
        early, now, late = (pose[name] for pose in (before, here, after))
        yield (now, (late - early) / (2 * STEP), (late - 2 * now + early) / STEP**2)[order]


@dataclass(frozen=True)
class CasePath:
    """The poses of a case along its smooth path, in the digits that mpmath has at present."""

    case: Case

    @cached_property
    def chain(self) -> DyadChain:
        """The chain, its lengths floats."""
        return chain_of(self.case.scene.linkage)

    @cached_property
    def _ends(self) -> tuple[Any, Any] | None:
        return self.case.swing(mp) if self.case.swing else None

    @cached_property
    def _exact(self) -> tuple[dict[str, Any], tuple[Step, ...]]:
        """The pins and the steps, their numbers as the case means them."""
        places = {name: self._place(pin) for name, pin in self.chain.pins.items()}
        return places, tuple(self._meant(step) for step in self.chain.steps)

    def _meant(self, step: Step) -> Step:
        match step:
            case TurnStep():
                named = {key: self._number(getattr(step, key)) for key in ("length", "ratio", "offset")}
                return step._replace(**named)
            case FixedStep():
                return step._replace(at=self._place(step.at), length=self._number(step.length))
            case RRR():
                a, b = map(self._number, step.lengths)
                return replace(step, lengths=(a, b))
        along = mpc(step.along)
        return step._replace(length=self._number(step.length), base=mpc(step.base), along=along / abs(along))

    def angle(self, given: Any) -> Any:
        """Return the input's angle: what is given, or of a phase of a swing, mid - amp·cos φ."""
        if self._ends is None or self.case.by_angle:
            return given
        low, high = self._ends
        return (low + high) / 2 - (high - low) / 2 * mp.cos(given)

    def phase(self, given: Any) -> Any:
        """Return the phase, of an angle of a swing on the way up."""
        if self._ends is None or not self.case.by_angle:
            return given
        low, high = self._ends
        return mp.acos((low + high - 2 * given) / (high - low))

    def side(self, dyad: Dyad, phase: Any) -> int:
        """Return the closure on the smooth path."""
        turn = 2 * self.case.periods
        at = phase / mp.pi
        passed = sum(
            int(mp.floor((at - flip) / turn)) + (flip > 0) for flip in self.case.flips.get(dyad.name, ())
        )
        return -dyad.side if passed % 2 else dyad.side

    def pose(self, given: Any) -> Pose:
        """Return where every joint lies."""
        phase, (pins, steps) = self.phase(given), self._exact
        chain = DyadChain(pins, steps)
        return placed(
            chain, self.angle(given), lambda dyad, at: closed(dyad, at, self.side(dyad, phase)), mp.exp
        )

    def others(self, at: Pose) -> Pose:
        """Return the other closure of each dyad, whose ends lie where they are."""
        found = {}
        for step in self._exact[1]:
            if isinstance(step, RRR | SlideStep):
                near, far = (closed(step, at, side) for side in (1, -1))
                apart = [abs(place - at[step.name]) for place in (near, far)]
                found[step.name] = near if apart[0] > apart[1] else far
        return found

    def _place(self, value: complex) -> Any:
        return mpc(self._number(value.real), self._number(value.imag))

    def _number(self, value: float) -> Any:
        return mpf(repr(value)) if self.case.decimal else mpf(value)


def closed(dyad: Dyad, at: Places, side: int) -> Any:
    """Return where a dyad's joint lies, in many digits; what misses by rounding touches."""
    return circle_dyad(dyad, at, side, lambda square: mp.sqrt(max(square, mpf(0))))


def crossing(p: Any, q: Any, a: Any, b: Any, side: int) -> Any:
    """Return where circles of radius a about p and b about q cross, left of p -> q for side +1."""
    return closed(RRR("", ("p", "q"), (a, b), side), {"p": p, "q": q}, side)


def _floats(values: list[Any]) -> Floats:
    return np.array([float(value) for value in values])


def _rounded(values: list[Any]) -> Complexes:
    return np.array([complex(value) for value in values])


def _exact(values: list[Any]) -> Exact:
    high = _rounded(values)
    return Exact(
        high, _rounded([value - mpc(near) for value, near in zip(values, high.tolist(), strict=True)])
    )
