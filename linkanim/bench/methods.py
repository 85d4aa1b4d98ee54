"""The usual ways to solve a chain of dyads, as they are usually written, and this project's own.

Closed forms and tables take whole arrays; what goes on from the previous pose goes pose by pose in plain
floats, as a frame loop does. None of the usual ones is improved here: what they lose near limits and
change points is what is measured. Rates follow from the differentiated equations of each dyad, solved at the
pose found (Norton, Design of Machinery, chapters on velocity and acceleration analysis).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.chain import (
    TURN,
    Complexes,
    Dyad,
    DyadChain,
    FixedStep,
    Floats,
    Orders,
    Places,
    Question,
    TurnStep,
    joined,
    placed,
    point_on,
)
from linkanim.mechanics.linkage.dyads import RRR

INTERVALS = 360
"""Of a table, to one turn."""
NOWHERE = complex(math.nan, math.nan)
QUANTITIES = ("position", "velocity", "acceleration")
Close = Callable[[Dyad, Places, Any], Any]
"""How a method closes a dyad: from the places before it, and the side at each pose."""


def half_angle_dyad(dyad: Dyad, at: Places, side: Any) -> Any:
    """Solve A cos ψ + B sin ψ = C for a bar's angle as a quadratic in tan(ψ/2).

    Norton, Design of Machinery, "algebraic position analysis", for the second bar of a pair and the rod of a
    slider.
    """
    if isinstance(dyad, RRR):
        p, q = (at[end] for end in dyad.ends)
        (a, b), way = dyad.lengths, q - p
        cosine, sine = 2 * b * way.real, 2 * b * way.imag
        right, origin, arm, sign = a * a - b * b - way.real**2 - way.imag**2, q, b, side
    else:
        seen = (at[dyad.end] - dyad.base) * np.conj(dyad.along)
        turned = np.conj(dyad.along)
        cosine, sine = dyad.length * turned.imag, dyad.length * turned.real
        right, origin, arm, sign = -seen.imag, at[dyad.end], dyad.length, -side
    root = np.sqrt(cosine * cosine + sine * sine - right * right)
    angle = 2 * np.arctan((sine + sign * root) / (cosine + right))
    return origin + arm * np.exp(1j * angle)


def closed(close: Close) -> Callable[[Question], Places]:
    """Return the method that closes dyad by dyad so, all poses at once."""

    def places(question: Question) -> Places:
        sides = question.sides
        return placed(question.chain, question.angles, lambda dyad, at: close(dyad, at, sides[dyad.name]))

    return places


def rated(places: Callable[[Question], Places]) -> Callable[[Question], Orders]:
    """Return the method with rates: positions, then their first and second derivatives."""

    def solve(question: Question) -> Orders:
        at, (speed, gain) = places(question), question.rates
        chain = question.chain
        first = _rates(chain, at, lambda r: 1j * r * speed, lambda dyad: (0.0, 0.0))
        loads = partial(_centripetal, first=first)
        return at, first, _rates(chain, at, lambda r: 1j * r * gain - (r * speed) ** 2, loads)

    return solve


def _rates(
    chain: DyadChain,
    at: Places,
    turning: Callable[[float], Any],
    loads: Callable[[Dyad], tuple[Any, Any]],
) -> dict[str, Any]:
    """Return a derivative of all joints: of a crank's arm its factor by ratio, of dyads what they bear."""
    found: dict[str, Any] = dict.fromkeys(chain.pins, 0j)
    for step in chain.steps:
        if isinstance(step, TurnStep):
            found[step.name] = turning(step.ratio) * (at[step.name] - at[step.pivot])
        elif isinstance(step, FixedStep):
            found[step.name] = point_on(step, found)
        else:
            found[step.name] = _rate(step, at, found, loads(step))
    return found


def _rate(dyad: Dyad, at: Places, ends: Places, loads: tuple[Any, Any]) -> Any:
    """Return the rate x of a dyad's joint: (B - P)·(x - p) = load for each bar, or x along its line.

    Of a single pose whose bars are in line NaN.
    """
    here = at[dyad.name]
    try:
        if isinstance(dyad, RRR):
            (p, q), (one, other) = dyad.ends, (here - at[end] for end in dyad.ends)
            right, also = _dot(one, ends[p]) + loads[0], _dot(other, ends[q]) + loads[1]
            return 1j * (one * also - other * right) / (one.conjugate() * other).imag
        bar = here - at[dyad.end]
        return dyad.along * ((_dot(bar, ends[dyad.end]) + loads[0]) / _dot(bar, dyad.along))
    except ZeroDivisionError:
        return NOWHERE


def _centripetal(dyad: Dyad, first: Places) -> tuple[Any, Any]:
    ends = dyad.ends if isinstance(dyad, RRR) else (dyad.end,)
    loads = [-(np.abs(first[dyad.name] - first[end]) ** 2) for end in ends]
    return loads[0], loads[-1]


def _dot(one: Any, other: Any) -> Any:
    return (one.conjugate() * other).real


def newton(iterations: int) -> Callable[[Question], Places]:
    """Return Newton's method on each dyad's equations, so many iterations from the previous pose."""

    def poses(question: Question) -> Iterator[dict[str, complex]]:
        at = dict(question.start)
        for angle in question.angles.tolist():
            last = at
            at = placed(
                question.chain,
                angle,
                lambda dyad, at: _improved(dyad, at, last[dyad.name], iterations),  # noqa: B023
                cmath.exp,
            )
            yield at

    return lambda question: _gathered(poses(question))


def _gathered(poses: Iterator[dict[str, complex]]) -> Places:
    kept = list(poses)
    return {name: np.array([pose[name] for pose in kept]) for name in kept[0]}


def _improved(dyad: Dyad, at: Places, here: complex, iterations: int) -> complex:
    """Return a dyad's joint after so many iterations; a singular Jacobian gives NaN."""
    try:
        if isinstance(dyad, RRR):
            p, q = (at[end] for end in dyad.ends)
            a, b = (length * length for length in dyad.lengths)
            for _ in range(iterations):
                x, y, z, w = here.real - p.real, here.imag - p.imag, here.real - q.real, here.imag - q.imag
                f, g = 0.5 * (x * x + y * y - a), 0.5 * (z * z + w * w - b)
                det = x * w - y * z
                here -= complex((w * f - y * g) / det, (x * g - z * f) / det)
            return here
        way = ((here - dyad.base) * dyad.along.conjugate()).real
        seen, square = (at[dyad.end] - dyad.base) * dyad.along.conjugate(), dyad.length * dyad.length
        for _ in range(iterations):
            x = way - seen.real
            way -= 0.5 * (x * x + seen.imag * seen.imag - square) / x
        return dyad.base + dyad.along * way
    except ZeroDivisionError:
        return NOWHERE


def runge_kutta(question: Question) -> Orders:
    """Integrate the dyads' velocities from pose to pose with the classical method of fourth order."""
    return (_gathered(_integrated(question)),)


def _integrated(question: Question) -> Iterator[dict[str, complex]]:
    chain = question.chain
    state = [question.start[dyad.name] for dyad in chain.dyads]
    before = float(question.angles[0])
    for angle in question.angles.tolist():
        h, weighted = angle - before, [0j] * len(state)
        slopes = weighted
        for part, weight in ((0.0, 1), (0.5, 2), (0.5, 2), (1.0, 1)):
            reached = [y + part * h * k for y, k in zip(state, slopes, strict=True)]
            slopes = _slopes(chain, before + part * h, reached)
            weighted = [sum_ + weight * k for sum_, k in zip(weighted, slopes, strict=True)]
        state = [y + h / 6 * sum_ for y, sum_ in zip(state, weighted, strict=True)]
        before = angle
        yield _with_dyads(chain, angle, state)


def _with_dyads(chain: DyadChain, angle: float, state: list[complex]) -> dict[str, complex]:
    dyads = iter(state)
    return placed(chain, angle, lambda dyad, at: next(dyads), cmath.exp)


def _slopes(chain: DyadChain, angle: float, state: list[complex]) -> list[complex]:
    """Return the velocities of the dyads' joints per unit input; NaN where bars are in line."""
    at = _with_dyads(chain, angle, state)
    rates = _rates(chain, at, lambda ratio: 1j * ratio, lambda dyad: (0.0, 0.0))
    return [rates[dyad.name] for dyad in chain.dyads]


class Samples(NamedTuple):
    """Poses of one period at equal steps of the phase, with their slopes."""

    first: float
    step: float
    period: float
    values: Places
    slopes: Places

    def place(self, phases: Floats) -> tuple[Any, Floats]:
        """Return the interval in which each phase lies, and which share of it lies before the phase."""
        steps = np.mod(phases - self.first, self.period) / self.step
        last = len(next(iter(self.values.values()))) - 2
        interval = np.minimum(steps.astype(np.intp), last)
        return interval, steps - interval


def table_of(question: Question) -> Samples:
    """Return the table of a question: this project's own poses, half a step off whole degrees."""
    step, count = TURN / INTERVALS, INTERVALS * question.periods
    phases = (np.arange(count + 1, dtype=np.float64) - 0.5) * step
    values, slopes, _ = batch(replace(question, phases=phases, by_angle=False))
    return Samples(float(phases[0]), step, count * step, values, slopes)


def linear(table: Samples, question: Question) -> Orders:
    """Read the table with straight lines between its entries."""
    at, s = table.place(question.phases)
    return ({name: (1 - s) * value[at] + s * value[at + 1] for name, value in table.values.items()},)


def cubic(table: Samples, question: Question) -> Orders:
    """Read the table with Hermite's cubics through its entries and slopes."""
    at, s = table.place(question.phases)
    u, h = 1 - s, table.step
    before, after, rise, fall = u * u * (1 + 2 * s), s * s * (3 - 2 * s), u * u * s * h, s * s * u * h

    def read(value: Complexes, slope: Complexes) -> Any:
        return before * value[at] + after * value[at + 1] + rise * slope[at] - fall * slope[at + 1]

    return ({name: read(value, table.slopes[name]) for name, value in table.values.items()},)


def batch(question: Question) -> Orders:
    """Solve all inputs in one call, by angle where that is what is given, else by phase."""
    solve = question.scene.solve
    by_angle = question.by_angle
    motion = solve(angle=question.angles, speed=1.0) if by_angle else solve(phase=question.phases, speed=1.0)
    return tuple(
        {name: joined(getattr(motion, quantity)[name]) for name in question.shown} for quantity in QUANTITIES
    )


def single(question: Question) -> Orders:
    """Solve one pose per call in plain floats; rates where they are asked for by phase, as it gives them."""
    poses = [question.scene.pose(phase, 2) for phase in question.phases.tolist()]
    scale = question.scene.linkage.drive.speed
    return tuple(
        {
            name: np.array([complex(*getattr(pose, quantity)[name]) for pose in poses]) / scale**order
            for name in question.shown
        }
        for order, quantity in enumerate(QUANTITIES[:1] if question.by_angle else QUANTITIES)
    )
