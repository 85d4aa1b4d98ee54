"""The usual ways to solve a four-bar, as they are usually written: B and the coupler point P for each input.

Closed forms and tables take whole arrays; what goes on from the previous pose goes pose by pose in plain
floats, as a frame loop does. None of them is improved here: what they lose near limits and change
points is what is measured.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.question import (
    TURN,
    Complexes,
    Floats,
    FourBarLengths,
    Points,
    Question,
    coupler_point,
    crank_pin,
    joined,
)

INTERVALS = 360
"""Of a table, to one turn."""


class Rates(NamedTuple):
    """Points with their first and second derivatives in the crank's angle."""

    points: Points
    first: Points
    second: Points


def half_angle(question: Question) -> Points:
    """Solve Freudenstein's equation for the rocker as a quadratic in tan(θ4/2).

    Norton, Design of Machinery, "algebraic position analysis": θ4 = 2 atan((-B ∓ √(B² - 4AC)) / 2A).
    """
    bars = question.bars
    rocker = _rocker_angle(bars, question.angles, question.sides)
    b = bars.ground + bars.rocker * np.exp(1j * rocker)
    return coupler_point(bars, crank_pin(bars, question.angles), b)


def _rocker_angle(bars: FourBarLengths, angles: Floats, sides: Floats) -> Floats:
    d, a, b, c = bars[:4]
    k1, k2, k3 = d / a, d / c, (a * a - b * b + c * c + d * d) / (2 * a * c)
    cosine = np.cos(angles)
    first, middle, last = cosine - k1 - k2 * cosine + k3, -2 * np.sin(angles), k1 - (k2 + 1) * cosine + k3
    root = np.sqrt(middle * middle - 4 * first * last)
    rocker: Floats = 2 * np.arctan((-middle - sides * root) / (2 * first))
    return rocker


def half_angle_rates(question: Question) -> Rates:
    """Return the same with velocities and accelerations from the differentiated loop equations.

    Norton, Design of Machinery, chapters on velocity and acceleration analysis.
    """
    bars, angles = question.bars, question.angles
    points = half_angle(question)
    crank, arm = crank_pin(bars, angles), points.b - bars.ground
    link = points.b - crank
    cross = link.imag * arm.real - link.real * arm.imag
    w3, w4 = -_cross(crank, arm) / cross, -_cross(crank, link) / cross
    load = crank + w3 * w3 * link - w4 * w4 * arm
    a3, a4 = -_dot(load, arm) / cross, -_dot(load, link) / cross
    first = Points(1j * w4 * arm, 1j * crank + 1j * w3 * link * bars.point)
    second = Points((1j * a4 - w4 * w4) * arm, -crank + (1j * a3 - w3 * w3) * link * bars.point)
    return Rates(points, first, second)


def _cross(one: Complexes, other: Complexes) -> Floats:
    return one.imag * other.real - one.real * other.imag


def _dot(one: Complexes, other: Complexes) -> Floats:
    return one.real * other.real + one.imag * other.imag


def circles(question: Question) -> Points:
    """Intersect the circle about A with the circle about O4: along the line of centres, then √(r² - x²).

    Paul Bourke, Circles and spheres (1997).
    """
    bars = question.bars
    pin = crank_pin(bars, question.angles)
    way = bars.ground - pin
    distance = np.abs(way)
    along = (bars.coupler**2 - bars.rocker**2 + distance * distance) / (2 * distance)
    height = np.sqrt(bars.coupler**2 - along * along)
    b = pin + way / distance * (along + 1j * (question.sides * height))
    return coupler_point(bars, pin, b)


def newton(iterations: int) -> Callable[[Question], Points]:
    """Return Newton's method on the loop equation, so many iterations from the previous pose."""

    def solve(question: Question) -> Points:
        return _assembled(question, _followed(question, iterations))

    return solve


def _followed(question: Question, iterations: int) -> Iterator[_Angles]:
    state = _start(question)
    for angle in _floats(question):
        state = _newton(question.bars, angle, state, iterations)
        yield state


class _Angles(NamedTuple):
    """The angles of coupler and rocker."""

    coupler: float
    rocker: float


def _start(question: Question) -> _Angles:
    bars = question.bars
    pin = bars.crank * complex(math.cos(question.angles[0]), math.sin(question.angles[0]))
    link, arm = question.start - pin, question.start - bars.ground
    return _Angles(math.atan2(link.imag, link.real), math.atan2(arm.imag, arm.real))


def _floats(question: Question) -> list[float]:
    angles: list[float] = question.angles.tolist()
    return angles


def _newton(bars: FourBarLengths, angle: float, state: _Angles, iterations: int) -> _Angles:
    """Return the angles after so many iterations; a singular Jacobian gives NaN."""
    d, r, a, b = bars[:4]
    x, y = r * math.cos(angle) - d, r * math.sin(angle)
    coupler, rocker = state
    for _ in range(iterations):
        ca, sa = a * math.cos(coupler), a * math.sin(coupler)
        cb, sb = b * math.cos(rocker), b * math.sin(rocker)
        fx, fy, determinant = x + ca - cb, y + sa - sb, ca * sb - sa * cb
        if determinant == 0:
            return _Angles(math.nan, math.nan)
        coupler -= (fx * cb + fy * sb) / determinant
        rocker -= (fx * ca + fy * sa) / determinant
    return _Angles(coupler, rocker)


def _assembled(question: Question, states: Iterator[_Angles]) -> Points:
    """Return the points that the angles of coupler and rocker give."""
    bars = question.bars
    ways: Complexes = np.exp(1j * np.array(list(states)))
    pin = crank_pin(bars, question.angles)
    return Points(bars.ground + bars.rocker * ways[:, 1], pin + bars.coupler * ways[:, 0] * bars.point)


def runge_kutta(question: Question) -> Points:
    """Integrate the angular velocities from pose to pose with the classical method of fourth order."""
    return _assembled(question, _integrated(question))


def _integrated(question: Question) -> Iterator[_Angles]:
    bars, state = question.bars, _start(question)
    before = float(question.angles[0])
    for angle in _floats(question):
        state = _step(bars, before, state, angle - before)
        before = angle
        yield state


def _step(bars: FourBarLengths, angle: float, state: _Angles, h: float) -> _Angles:
    k1 = _velocity(bars, angle, state)
    k2 = _velocity(bars, angle + h / 2, _moved(state, k1, h / 2))
    k3 = _velocity(bars, angle + h / 2, _moved(state, k2, h / 2))
    k4 = _velocity(bars, angle + h, _moved(state, k3, h))
    mean = ((p + 2 * q + 2 * r + s) / 6 for p, q, r, s in zip(k1, k2, k3, k4, strict=True))
    return _moved(state, _Angles(*mean), h)


def _moved(state: _Angles, rate: _Angles, h: float) -> _Angles:
    return _Angles(state.coupler + h * rate.coupler, state.rocker + h * rate.rocker)


def _velocity(bars: FourBarLengths, angle: float, state: _Angles) -> _Angles:
    """Return dθ3/dθ2 and dθ4/dθ2; NaN where coupler and rocker are in one line."""
    coupler, rocker = state
    sine = math.sin(coupler - rocker)
    if sine == 0:
        return _Angles(math.nan, math.nan)
    return _Angles(
        bars.crank * math.sin(rocker - angle) / (bars.coupler * sine),
        bars.crank * math.sin(coupler - angle) / (bars.rocker * sine),
    )


class Samples(NamedTuple):
    """Poses of one period at equal steps of the phase, B and P, with their slopes."""

    first: float
    step: float
    period: float
    values: Points
    slopes: Points

    def place(self, phases: Floats) -> tuple[Any, Floats]:
        """Return the interval in which each phase lies, and which share of it lies before the phase."""
        steps = np.mod(phases - self.first, self.period) / self.step
        interval = np.minimum(steps.astype(np.intp), len(self.values.b) - 2)
        return interval, steps - interval


def table_of(question: Question) -> Samples:
    """Return the table of a question: this project's own poses, half a step off whole degrees."""
    step, count = TURN / INTERVALS, INTERVALS * question.periods
    phases = (np.arange(count + 1) - 0.5) * step
    motion = question.scene.solve(phase=phases, speed=1.0, derivatives=1)
    values, slopes = (
        Points(joined(part["B"]), joined(part["P"])) for part in (motion.position, motion.velocity)
    )
    return Samples(float(phases[0]), step, count * step, values, slopes)


def linear(table: Samples, question: Question) -> Points:
    """Read the table with straight lines between its entries."""
    at, s = table.place(question.phases)
    return Points(*((1 - s) * values[at] + s * values[at + 1] for values in table.values))


def cubic(table: Samples, question: Question) -> Points:
    """Read the table with Hermite's cubics through its entries and slopes."""
    at, s = table.place(question.phases)
    u, h = 1 - s, table.step
    before, after, rise, fall = u * u * (1 + 2 * s), s * s * (3 - 2 * s), u * u * s * h, s * s * u * h
    return Points(
        *(
            before * values[at] + after * values[at + 1] + rise * slopes[at] - fall * slopes[at + 1]
            for values, slopes in zip(table.values, table.slopes, strict=True)
        )
    )
