"""The usual ways to solve a chain of dyads, as they are usually written.

Closed forms and tables take whole arrays; what goes on from the previous pose goes pose by pose in plain
floats, as a frame loop does. None of them is improved here: what they lose near limits and change points is
what is measured. Rates follow from the differentiated equations of each dyad, solved at the pose found
(Norton, Design of Machinery, chapters on velocity and acceleration analysis).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.chain import (
    TURN,
    Complexes,
    Dyad,
    DyadChain,
    FixedStep,
    Floats,
    MeetStep,
    Places,
    Question,
    TurnStep,
)
from linkanim.bench.ours import Orders, batch

INTERVALS = 360
"""Of a table, to one turn."""
Close = Callable[[Dyad, Places, Any], Any]
"""How a method closes a dyad: from the places before it, and the side at each pose."""


def half_angle_dyad(dyad: Dyad, at: Places, side: Any) -> Any:
    """Solve A cos ψ + B sin ψ = C for a bar's angle as a quadratic in tan(ψ/2).

    Norton, Design of Machinery, "algebraic position analysis", for the second bar of a pair and the rod of a
    slider.
    """
    if isinstance(dyad, MeetStep):
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


def circle_dyad(dyad: Dyad, at: Places, side: Any) -> Any:
    """Go along the line of centres, then √(r² - x²) to the side; a circle and a line likewise.

    Paul Bourke, Circles and spheres (1997).
    """
    if isinstance(dyad, MeetStep):
        p, q = (at[end] for end in dyad.ends)
        (a, b), way = dyad.lengths, q - p
        distance = np.abs(way)
        along = (a**2 - b**2 + distance * distance) / (2 * distance)
        height = np.sqrt(a**2 - along * along)
        return p + way / distance * (along + 1j * (side * height))
    seen = (at[dyad.end] - dyad.base) * np.conj(dyad.along)
    return dyad.base + dyad.along * (seen.real + side * np.sqrt(dyad.length**2 - seen.imag**2))


def closed(close: Close) -> Callable[[Question], Orders]:
    """Return the method that closes dyad by dyad so, with rates."""

    def solve(question: Question) -> Orders:
        return with_rates(question, _places(question, close))

    return solve


def positions(close: Close) -> Callable[[Question], Orders]:
    """Return the method that closes dyad by dyad so, without rates."""
    return lambda question: (_places(question, close),)


def _places(question: Question, close: Close) -> Places:
    chain = question.chain
    at: dict[str, Any] = dict(chain.pins)
    for step in chain.steps:
        match step:
            case TurnStep():
                turned = np.exp(1j * (step.ratio * question.angles + step.offset))
                at[step.name] = at[step.pivot] + step.length * turned
            case FixedStep():
                at[step.name] = _on(step, at)
            case _:
                at[step.name] = close(step, at, question.sides[step.name])
    return at


def _on(step: FixedStep, at: Places) -> Any:
    first, second = (at[name] for name in step.on)
    return first + (second - first) * (step.at / step.length)


def with_rates(question: Question, at: Places) -> Orders:
    """Return positions with their first and second derivatives."""
    first: dict[str, Any] = dict.fromkeys(question.chain.pins, 0.0)
    second: dict[str, Any] = dict.fromkeys(question.chain.pins, 0.0)
    speed, gain = question.rates
    for step in question.chain.steps:
        name = step.name
        match step:
            case TurnStep():
                arm, w, e = at[name] - at[step.pivot], step.ratio * speed, step.ratio * gain
                first[name], second[name] = 1j * w * arm, (1j * e - w * w) * arm
            case FixedStep():
                first[name], second[name] = _on(step, first), _on(step, second)
            case _:
                first[name] = _rate(step, at, first, (0.0, 0.0))
                second[name] = _rate(step, at, second, _centripetal(step, first))
    return at, first, second


def _rate(dyad: Dyad, at: Places, ends: Places, loads: tuple[Any, Any]) -> Any:
    """Return the rate x of a dyad's joint: (B - P)·(x - p) = load for each bar, or x along its line."""
    here = at[dyad.name]
    if isinstance(dyad, MeetStep):
        (p, q), (one, other) = dyad.ends, (here - at[end] for end in dyad.ends)
        right, also = _dot(one, ends[p]) + loads[0], _dot(other, ends[q]) + loads[1]
        return 1j * (one * also - other * right) / _cross(one, other)
    bar, end = here - at[dyad.end], ends[dyad.end]
    return dyad.along * (_dot(bar, end) + loads[0]) / _dot(bar, dyad.along)


def _centripetal(dyad: Dyad, first: Places) -> tuple[Any, Any]:
    ends = dyad.ends if isinstance(dyad, MeetStep) else (dyad.end,)
    loads = [-(np.abs(first[dyad.name] - first[end]) ** 2) for end in ends]
    return loads[0], loads[-1]


def _cross(one: Any, other: Any) -> Any:
    return one.real * other.imag - one.imag * other.real


def _dot(one: Any, other: Any) -> Any:
    return (np.conj(one) * other).real


def newton(iterations: int) -> Callable[[Question], Orders]:
    """Return Newton's method on each dyad's equations, so many iterations from the previous pose."""
    return lambda question: with_rates(question, _gathered(question, _followed(question, iterations)))


def newton_positions(iterations: int) -> Callable[[Question], Orders]:
    """Return the same without rates."""
    return lambda question: (_gathered(question, _followed(question, iterations)),)


def _gathered(question: Question, poses: Iterator[dict[str, complex]]) -> Places:
    kept = list(poses)
    return {name: np.array([pose[name] for pose in kept]) for name in kept[0]}


def _followed(question: Question, iterations: int) -> Iterator[dict[str, complex]]:
    chain, last = question.chain, dict(question.start)
    for angle in question.angles.tolist():
        at = dict(chain.pins)
        for step in chain.steps:
            if isinstance(step, TurnStep):
                at[step.name] = at[step.pivot] + cmath.rect(step.length, step.ratio * angle + step.offset)
            elif isinstance(step, FixedStep):
                at[step.name] = _on(step, at)
            else:
                at[step.name] = _improved(step, at, last[step.name], iterations)
        yield at
        last = at


def _improved(dyad: Dyad, at: Places, here: complex, iterations: int) -> complex:
    """Return a dyad's joint after so many iterations; a singular Jacobian gives NaN."""
    try:
        if isinstance(dyad, MeetStep):
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
        return complex(math.nan, math.nan)


def runge_kutta(question: Question) -> Orders:
    """Integrate the dyads' velocities from pose to pose with the classical method of fourth order."""
    return (_gathered(question, _integrated(question)),)


def _integrated(question: Question) -> Iterator[dict[str, complex]]:
    chain = question.chain
    state = [question.start[dyad.name] for dyad in chain.dyads]
    before = float(question.angles[0])
    for angle in question.angles.tolist():
        h = angle - before
        k1 = _slopes(chain, before, state)
        k2 = _slopes(chain, before + h / 2, [y + h / 2 * k for y, k in zip(state, k1, strict=True)])
        k3 = _slopes(chain, before + h / 2, [y + h / 2 * k for y, k in zip(state, k2, strict=True)])
        k4 = _slopes(chain, angle, [y + h * k for y, k in zip(state, k3, strict=True)])
        slopes = zip(k1, k2, k3, k4, strict=True)
        state = [y + h / 6 * (p + 2 * q + 2 * r + s) for y, (p, q, r, s) in zip(state, slopes, strict=True)]
        before = angle
        yield _at(chain, angle, state)


def _at(chain: DyadChain, angle: float, state: list[complex]) -> dict[str, complex]:
    at, dyads = dict(chain.pins), iter(state)
    for step in chain.steps:
        if isinstance(step, TurnStep):
            at[step.name] = at[step.pivot] + cmath.rect(step.length, step.ratio * angle + step.offset)
        else:
            at[step.name] = _on(step, at) if isinstance(step, FixedStep) else next(dyads)
    return at


def _slopes(chain: DyadChain, angle: float, state: list[complex]) -> list[complex]:
    """Return the velocities of the dyads' joints per unit input; NaN where bars are in line."""
    at, first = _at(chain, angle, state), dict.fromkeys(chain.pins, 0j)
    for step in chain.steps:
        if isinstance(step, TurnStep):
            first[step.name] = 1j * step.ratio * (at[step.name] - at[step.pivot])
        elif isinstance(step, FixedStep):
            first[step.name] = _on(step, first)
        else:
            first[step.name] = _velocity(step, at, first)
    return [first[dyad.name] for dyad in chain.dyads]


def _velocity(dyad: Dyad, at: Places, first: Places) -> Any:
    here = at[dyad.name]
    try:
        if isinstance(dyad, MeetStep):
            (p, q), (one, other) = dyad.ends, (here - at[end] for end in dyad.ends)
            right = one.real * first[p].real + one.imag * first[p].imag
            also = other.real * first[q].real + other.imag * first[q].imag
            det = one.real * other.imag - one.imag * other.real
            return complex(other.imag * right - one.imag * also, one.real * also - other.real * right) / det
        bar, end = here - at[dyad.end], first[dyad.end]
        rate = (bar.real * end.real + bar.imag * end.imag) / (bar.conjugate() * dyad.along).real
        return dyad.along * rate
    except ZeroDivisionError:
        return complex(math.nan, math.nan)


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
