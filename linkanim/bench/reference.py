"""Answer with many digits by the simplest closed forms, and score others by these answers.

Its parts, in reading order:

- Answers with many digits by the simplest closed forms: the intersections of circles and lines.
- The scores of a method's answers by the exact ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.questions import (
    Case,
    Complexes,
    Dyad,
    DyadChain,
    FixedStep,
    Floats,
    Orders,
    Places,
    Question,
    SlideStep,
    Step,
    TurnStep,
    chain_of,
    circle_dyad,
    longest_of,
)
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import RRR

# Answers with many digits by the simplest closed forms: the intersections of circles and lines.
#
# No code is shared with the solver. The square root of a difference may lose half of the digits and still
# have more than a float holds. Rates are central differences, with so small a step and so many digits that
# they too have far more correct digits than a float.

DIGITS = 140
STEP = mpf(10) ** -22
NUDGE = mpf(10) ** -40
"""A small step that is added to every input: exactly at a limit the circles touch, and there is no side."""
Pose = dict[str, Any]


@frozen
class Exact:
    """Complex numbers with twice a float's digits: the nearest floats, and the remainders."""

    high: Complexes
    low: Complexes

    def distance(self, place: Any) -> Floats:
        """Return the distances of floats from these numbers, which are not rounded first."""
        apart: Floats = np.abs((place - self.high) - self.low)
        return apart


@frozen
class Answer:
    """A case as a question, with exact positions and rates, and the places of each dyad's other closure."""

    question: Question
    orders: tuple[Mapping[str, Exact], ...]
    other: Mapping[str, Complexes]

    def errors(self, orders: Orders) -> list[Floats]:
        """Return the errors of the orders that are found at each pose: of the joint that is farthest off."""
        longest = self.question.longest
        rates = [
            _farthest(places, exact) / np.maximum(_largest(exact), longest)
            for places, exact in zip(orders[1:], self.orders[1:], strict=False)
        ]
        return [_farthest(orders[0], self.orders[0]) / longest, *rates]

    def score(self, solve: Solve) -> Score:
        """Return the score of a method's self."""
        with np.errstate(all="ignore"):
            solved = solve(self.question)
            error, *rates = self.errors(solved)
            wrong, missing = self._on_another(solved[0]), ~np.isfinite(error)
            right = ~wrong & ~missing
        worst = [_worst(one, right) for one in (error, *rates)]
        position, velocity, acceleration, *_ = (*(largest for largest, _ in worst), np.nan, np.nan)
        given = self.question.angles if self.question.by_angle else self.question.phases
        at = tuple(float(given[n]).hex() for _, n in worst)
        return Score(error.size, position, velocity, acceleration, int(wrong.sum()), int(missing.sum()), at)

    def _on_another(self, places: Places) -> Any:
        """Return which poses are on another closure than the right one, as a mask."""
        here, apart = self.orders[0], APART * self.question.longest
        return np.any(
            [
                (np.abs(other - here[name].high) > apart)
                & (2 * np.abs(places[name] - other) < here[name].distance(places[name]))
                for name, other in self.other.items()
            ],
            axis=0,
        )


def answer(case: Case) -> Answer:
    """Return a case with its poses computed with many digits."""
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
    """Return the first and the second derivative of the input's angle by the given angle or phase."""
    ways = [[path.angle(given + k * STEP) - path.angle(given) for k in (-1, 1)] for given in inputs]
    first = [(after - before) / (2 * STEP) for before, after in ways]
    return _floats(first), _floats([(after + before) / STEP**2 for before, after in ways])


def _order(order: int, name: str, poses: list[list[Pose]]) -> Iterator[Any]:
    """Yield a joint's positions, or their first or second derivative by the given angle or phase."""
    for before, here, after in zip(*poses, strict=True):
        early, now, late = (pose[name] for pose in (before, here, after))
        yield (now, (late - early) / (2 * STEP), (late - 2 * now + early) / STEP**2)[order]


@frozen
class CasePath:
    """The poses of a case along its smooth path, with mpmath's present number of digits."""

    case: Case

    @cached_property
    def chain(self) -> DyadChain:
        """The chain, with lengths as floats."""
        return chain_of(self.case.scene.linkage)

    @cached_property
    def _ends(self) -> tuple[Any, Any] | None:
        return self.case.swing(mp) if self.case.swing else None

    @cached_property
    def _exact(self) -> tuple[dict[str, Any], tuple[Step, ...]]:
        """The pins and the steps, with exact numbers: the floats, or the decimals of a `decimal` case."""
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
        """Return the input's angle: the given number, or for a swing's phase mid - amp·cos φ."""
        if self._ends is None or self.case.by_angle:
            return given
        low, high = self._ends
        return (low + high) / 2 - (high - low) / 2 * mp.cos(given)

    def phase(self, given: Any) -> Any:
        """Return the phase: the given number, or for a swing's angle that on the way up."""
        if self._ends is None or not self.case.by_angle:
            return given
        low, high = self._ends
        return mp.acos((low + high - 2 * given) / (high - low))

    def side(self, dyad: Dyad, phase: Any) -> int:
        """Return a dyad's closure (+1 or -1) at a phase of the smooth path."""
        turn = 2 * self.case.periods
        at = phase / mp.pi
        passed = sum(
            int(mp.floor((at - flip) / turn)) + (flip > 0) for flip in self.case.flips.get(dyad.name, ())
        )
        return -dyad.side if passed % 2 else dyad.side

    def pose(self, given: Any) -> Pose:
        """Return the places of all joints at a given angle or phase."""
        phase, (pins, steps) = self.phase(given), self._exact
        return DyadChain(pins, steps).joints_at(
            self.angle(given), lambda dyad, at: closed(dyad, at, self.side(dyad, phase)), mp.exp
        )

    def others(self, at: Pose) -> Pose:
        """Return the other closure of each dyad, with its ends in their places."""
        others = {}
        for step in self._exact[1]:
            if isinstance(step, RRR | SlideStep):
                near, far = (closed(step, at, side) for side in (1, -1))
                apart = [abs(place - at[step.name]) for place in (near, far)]
                others[step.name] = near if apart[0] > apart[1] else far
        return others

    def _place(self, value: complex) -> Any:
        return mpc(self._number(value.real), self._number(value.imag))

    def _number(self, value: float) -> Any:
        return mpf(repr(value)) if self.case.decimal else mpf(value)


def closed(dyad: Dyad, at: Places, side: int) -> Any:
    """Return the place of a dyad's joint with many digits; a gap by rounding counts as touching."""
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


# The scores of a method's answers by the exact ones.

Solve = Callable[[Question], Orders]

APART = 1e-8
"""In longest links: closures nearer than this count as one."""


@frozen
class Score:
    """The number of poses, the worst errors among those on the right closure, and the counts of the others.

    Errors are of position, velocity and acceleration, at the joint with the largest: positions in longest
    links, rates in longest links or in the pose's largest rate, whichever is more. NaN where no pose is right
    or the method gives none. A pose is `wrong` where a dyad's joint is at most half as far from its other
    closure as from the right one, and `nan` where a position is not a number. `at` are the inputs, as
    hexadecimal floats, at which the errors are worst.
    """

    poses: int
    error: float
    velocity_error: float
    acceleration_error: float
    wrong: int
    nan: int
    at: tuple[str, ...] = ()

    @property
    def errors(self) -> tuple[float, float, float]:
        """The worst errors of position, velocity and acceleration."""
        return self.error, self.velocity_error, self.acceleration_error


def together(scores: Sequence[Score]) -> Score:
    """Return the worst errors and the sums of several scores."""
    errors = zip(*(score.errors for score in scores), strict=True)
    position, velocity, acceleration = (
        max((error for error in order if not np.isnan(error)), default=float("nan")) for order in errors
    )
    poses, wrong, nan = map(sum, zip(*((one.poses, one.wrong, one.nan) for one in scores), strict=True))
    return Score(poses, position, velocity, acceleration, wrong, nan)


def _worst(errors: Floats, right: Any) -> tuple[float, int]:
    """Return the largest error of the right poses, and which; NaN of a rate counts as infinitely wrong."""
    if not right.any() or np.isnan(errors).all():
        return float("nan"), 0
    kept = np.where(right, np.nan_to_num(errors, nan=np.inf), -1.0)
    return float(kept.max()), int(kept.argmax())


def _farthest(places: Places, exact: Mapping[str, Exact]) -> Floats:
    return np.max([place.distance(places[name]) for name, place in exact.items()], axis=0)  # type: ignore[no-any-return]


def _largest(exact: Mapping[str, Exact]) -> Floats:
    return np.max([np.abs(place.high) for place in exact.values()], axis=0)  # type: ignore[no-any-return]
