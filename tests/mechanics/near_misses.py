"""Random linkages whose last dyad J misses closing, or makes it, by a small share of its length.

A knee on a slider or on a four-bar's coupler, on a geared crank, in a six-bar: its bars, in line, are as long
as its ends ever come apart, or as short as they ever come together, but for the gap.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from build import four_bar, slider_crank, with_joints
from chain_reference import places
from mpmath import mp, mpf
from numpy.typing import NDArray

from linkanim.mechanics.linkage import RRR, Crank, Gear, Linkage, Pin, Rigid
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.mechanics.solver.input import Swing

Random = random.Random
Array = NDArray[np.float64]
GAPS = (-3.0, -12.0)
"""Powers of ten between which a gap lies, as a share of the bars' length."""


@dataclass(frozen=True)
class NearMiss:
    """A linkage whose dyad J lacks a `gap` to close all along; a negative one is to spare."""

    linkage: Linkage
    gap: float
    angle: float
    """Where its ends are furthest apart (`far`), or nearest to each other, by that `separation`."""
    far: bool
    separation: float


def knee_on_a_slider(rng: Random) -> tuple[Linkage, tuple[str, str]]:
    base = slider_crank(rng.uniform(10, 50), rng.uniform(90, 160), rng.uniform(-20, 20))
    return with_joints(base, Pin("S", (rng.uniform(-200, 300), rng.uniform(-150, 150)))), ("B", "S")


def knee_on_a_coupler(rng: Random) -> tuple[Linkage, tuple[str, str]]:
    base = _crank_rocker(rng)
    return with_joints(base, Pin("S", (rng.uniform(-150, 250), rng.uniform(-150, 150)))), ("P", "S")


def geared(rng: Random) -> tuple[Linkage, tuple[str, str]]:
    ratio = Fraction(rng.choice([-100, -7, -3, -1, 2, 5, 30, 100]), rng.choice([1, 1, 1, 3]))
    base = _crank_rocker(rng)
    wheel = Crank("G", "S", rng.uniform(5, 30), Gear("A", ratio, rng.uniform(-3, 3)))
    pin = Pin("S", (rng.uniform(-150, 250), rng.uniform(100, 250)))
    return with_joints(base, pin, wheel), (rng.choice("ABP"), "G")


def six_bar(rng: Random) -> tuple[Linkage, tuple[str, str]]:
    base = _crank_rocker(rng)
    pin, point = Pin("S", (rng.uniform(120, 300), rng.uniform(-150, 150))), (rng.uniform(30, 120), 10.0)
    return with_joints(base, pin, Rigid("C", ("O4", "B"), point)), ("C", "S")


def _crank_rocker(rng: Random) -> Linkage:
    return four_bar((100, rng.uniform(15, 40), rng.uniform(75, 110), rng.uniform(70, 95)))


KINDS: tuple[Callable[[Random], tuple[Linkage, tuple[str, str]]], ...] = (
    knee_on_a_slider,
    knee_on_a_coupler,
    geared,
    six_bar,
)


def near_miss(rng: Random) -> NearMiss:
    """Return a random one."""
    base, ends = rng.choice(KINDS)(rng)
    solved = mechanism(base)
    far = rng.random() < 0.7
    angles, ways = zip(*(_extreme(solved, ends, far=far) for far in (False, True)), strict=True)
    share = rng.choice([-1, 1]) * 10.0 ** rng.uniform(*GAPS)
    if far:
        length = ways[1] * (1 - share)
        first = length / 2 + rng.uniform(-0.4, 0.4) * ways[0]
        bars = first, length - first
    else:
        length = ways[0] * (1 + share)
        shorter = ways[1] * rng.uniform(0.6, 2.0)
        bars = shorter, shorter + length
    angle, separation = angles[far], ways[far]
    start = angle + rng.uniform(0.5, 2 * math.pi - 0.5)
    linkage = with_joints(base, RRR("J", ends, bars, rng.choice([1, -1])))
    return NearMiss(
        replace(linkage, drive=replace(linkage.drive, start=start)),
        share * separation,
        angle,
        far,
        separation,
    )


def _extreme(solved: Mechanism, ends: tuple[str, str], *, far: bool) -> tuple[float, float]:
    """Return the input's angle at which two joints are furthest apart (or nearest), and how far that is.

    Behind a fast gear many extremes are all but alike: each that may be the best is refined.
    """
    sign, period = (1.0 if far else -1.0), 2 * math.pi * solved.periods
    fastest = max(abs(joint.gear.ratio) if joint.gear else 1 for joint in solved.linkage.cranks)
    count = 200 * solved.periods * math.ceil(fastest)
    angles = np.linspace(0.0, period, count, endpoint=False)
    ways = sign * _apart(solved, ends, angles)
    peaks = (ways >= np.roll(ways, 1)) & (ways >= np.roll(ways, -1))
    best = angles[peaks & (ways > ways.max() - 1e-3 * np.abs(ways).max())]
    found = [_refined(solved, ends, sign, float(angle), 4 * period / count) for angle in best]
    return max(found, key=lambda one: sign * one[1])


def _refined(
    solved: Mechanism, ends: tuple[str, str], sign: float, middle: float, reach: float
) -> tuple[float, float]:
    """Return an extreme near an angle, and how far the ends are apart there."""
    while True:
        angles = np.linspace(middle - reach / 2, middle + reach / 2, 41)
        ways = _apart(solved, ends, angles)
        best = int((sign * ways).argmax())
        middle, reach = float(angles[best]), reach / 10
        if reach <= 1e-9:
            return middle, float(ways[best])


def _apart(solved: Mechanism, ends: tuple[str, str], angles: Array) -> Array:
    """Return how far two joints are apart at angles of the input."""
    at = solved.solve(angle=angles, speed=1.0, derivatives=0).position
    return np.asarray(np.hypot(*(at[ends[0]] - at[ends[1]]).T))


BESIDE = 10.0 ** -np.arange(1.0, 13.0)


def rows(solved: Mechanism, angle: float) -> Array:
    """Return every position and rate (rows, N) over the true period, and the more near an angle."""
    whole = np.linspace(0.0, 2 * math.pi * solved.periods, 100)
    middle = solved.assembly.path.phase_of(angle, 0.0)
    motion = solved.solve(phase=np.concatenate([whole, middle + BESIDE, middle - BESIDE]), speed=1.0)
    kinds = ("acceleration", "velocity", "position")
    return np.concatenate([values.T for kind in kinds for values in getattr(motion, kind).values()])


def _lack(case: NearMiss) -> Callable[[Any], Any]:
    """Return how much J lacks at an angle to reach, as a share of its length, in many digits."""
    joint = case.linkage.joint("J")
    assert isinstance(joint, RRR)
    base = replace(case.linkage, joints=case.linkage.joints[:-1])
    a, b = map(mpf, joint.lengths)

    def lack(angle: Any) -> Any:
        at = places(base, angle)
        way = abs(at[joint.ends[0]] - at[joint.ends[1]])
        return way - (a + b) if case.far else abs(a - b) - way

    return lack


TWO_FLOATS = 2.0**-96
"""Share of the longest bar by which a limit may miss: it is a sum of two floats, found from bars as given."""


def is_right(case: NearMiss, solved: Mechanism) -> bool:
    """Tell whether J reaches all along where the input turns fully, and just reaches where it is limited."""
    lack, path = _lack(case), solved.assembly.path
    with mp.workdps(50):
        if isinstance(path, Swing):
            limits = (mpf(end.high) + mpf(end.low) for end in (path.low, path.high))
            longest = max(case.linkage.joint("J").stated_lengths)
            return all(abs(lack(limit)) <= TWO_FLOATS * longest for limit in limits)
        worst = mp.findroot(lambda angle: mp.diff(lack, angle), mpf(case.angle), tol=mpf(10) ** -30)
        return bool(abs(worst - case.angle) < 1e-3 and lack(worst) <= 0)
