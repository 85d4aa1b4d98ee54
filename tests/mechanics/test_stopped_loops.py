"""A loop that moves quickly just where a dyad behind it stops the input has all its digits there."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from chain_reference import Places, places
from mpmath import mp, mpf

from linkanim.mechanics.angles import Sum
from linkanim.mechanics.linkage import RPR, RRP, RRR, Crank, Drive, Gear, Joint, Line, Linkage, Pin
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.solver.input import Swing

EPS = 2.0**-52
BESIDE = [1e-9, 1e-6, 1e-4, 1e-3, *np.geomspace(0.005, 0.5, 16).tolist(), 0.2016]
WAYS = [1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3]
PINS = Pin("O", (0.0, 0.0)), Pin("P", (79.0, 0.0)), Pin("S", (140.0, 38.0))
CRANK = Crank("A", "O", 79.125)
KITE = (*PINS, CRANK, RRR("B", ("A", "P"), (64.0, 63.9375), -1))
"""Ground and crank are nearly alike, and both bars: within 0.003 rad of 0 these turn half round."""
SLOT = (*PINS, CRANK, RPR("B", "P", "A", 60.0))
TWO = (*SLOT, RRR("N", ("B", "A"), (60.0, 90.0), -1))
"""Bars that nearly lie in one line at 1.22 rad, and do at 1.211."""
GEARED = (
    *PINS,
    Pin("R", (-50.0, 10.0)),
    Crank("A", "R", 20.0),
    Crank("C", "O", 79.125, Gear("A", Fraction(-2))),
    RRR("B", ("C", "P"), (85.0, 84.9375), -1),
)
FLAT = (*PINS, Crank("A", "O", 30.0), RRR("B", ("A", "P"), (90.0, 41.0 + 2.0**-16), 1))
"""At 0 all bars nearly lie in one line: rates change within 0.001 rad."""


SHORT = (
    Pin("O", (0.0, 0.0)),
    Pin("P", (73.92, 0.0)),
    Pin("S", (120.55, -113.5)),
    Crank("A", "O", 74.23),
    RRR("B", ("A", "P"), (81.5, 81.49), 1),
)


def bars(at: Places) -> Joint:
    """Bars of lengths whose difference is B's distance from S."""
    length = float(abs(at["B"] - mp.mpc(140, 38)))
    return RRR("D", ("B", "S"), (1.75 * length, 0.75 * length), -1)


def given(at: Places) -> Joint:
    """Bars whose polynomial beside the limit ends at the phase 0.202."""
    return RRR("D", ("B", "S"), (40.19, 114.28), 1)


def slider(at: Places) -> Joint:
    """A bar as long as B's distance from the line through S."""
    return RRP("D", "B", abs(float(at["B"].imag) - 38), Line("S", 0.0), 1)


CASES: list[tuple[str, tuple[Joint, ...], Callable[[Places], Joint], float, float]] = [
    # Where the bars stop the input, and a start on its swing.
    ("before the pins of a kite meet", KITE, bars, -0.0005, 0.3),
    ("on a short swing, where a polynomial ends", SHORT, given, -6.2, -6.0),
    ("behind that place", KITE, bars, 0.003, 0.3),
    ("a whole turn later", SLOT, bars, -0.003, -0.3),
    ("a slotted bar that turns half round, behind it a slider", SLOT, slider, -0.003, 0.3),
    ("a kite on a geared crank", GEARED, bars, 0.0005, 0.1),
    ("bars that barely close at another dyad's limit", TWO, slider, 1.22, 1.0),
    ("bars that barely close at another dyad's upper limit", TWO, bars, -1.22, -1.0),
    ("no kite, but nearly a change point", FLAT, slider, -1e-3, -0.3),
]


@pytest.mark.parametrize("by", ["phase", "angle"])
@pytest.mark.parametrize(
    ("first", "behind", "at", "start"), [row[1:] for row in CASES], ids=[row[0] for row in CASES]
)
def test_a_loop_that_moves_quickly_at_a_limit_has_all_its_digits(
    first: tuple[Joint, ...], behind: Callable[[Places], Joint], at: float, start: float, by: str
) -> None:
    with mp.workdps(90):
        base = Linkage(first, Drive("A", 1.0, start))
        linkage = replace(base, joints=(*first, behind(places(base, mpf(at)))))
        solved = mechanism(linkage)
        path = solved.assembly.path
        assert isinstance(path, Swing)
        assert "D" in path.ends
        low, high = (limit(linkage, *end) for end in zip(path.ends, (path.low, path.high), strict=True))
        if by == "phase":
            stated = np.array([*BESIDE, *(math.pi - way for way in BESIDE)])
            steps = [mpf(10) ** -25] * len(stated)
            motion = solved.solve(phase=stated, speed=1.0)
        else:
            stated = np.array([*(float(low) + way for way in WAYS), *(float(high) - way for way in WAYS)])
            stated = stated[[low < mpf(angle) < high for angle in stated.tolist()]]
            steps = [min(mpf(angle) - low, high - mpf(angle)) * mpf(10) ** -12 for angle in stated.tolist()]
            motion = solved.solve(angle=stated, speed=1.0)

        def pose(way: Any) -> Places:
            swing = (low + high) / 2 - (high - low) / 2 * mp.cos(way)
            return places(linkage, swing if by == "phase" else way)

        true = [rates(pose, mpf(place), step) for place, step in zip(stated.tolist(), steps, strict=True)]
        longest = max(length for joint in linkage.joints for length in joint.stated_lengths)
        for order, kind, most in ((0, "position", 16), (1, "velocity", 32), (2, "acceleration", 64)):
            for name in true[0][0]:
                for found, exact in zip(getattr(motion, kind)[name], true, strict=True):
                    size = max(longest, abs(exact[order][name]))
                    assert abs(mp.mpc(*found.tolist()) - exact[order][name]) <= most * EPS * size


def limit(linkage: Linkage, name: str, near: Sum) -> Any:
    """The input's angle at which a dyad just closes, by Newton's method."""
    place = [joint.name for joint in linkage.joints].index(name)
    dyad, before = linkage.joints[place], replace(linkage, joints=linkage.joints[:place])

    def margin(angle: Any) -> Any:
        at = places(before, angle)
        if isinstance(dyad, RRP):
            return abs(at[dyad.end].imag - 38) - mpf(dyad.length)
        assert isinstance(dyad, RRR)
        (a, b), way = map(mpf, dyad.lengths), abs(at[dyad.ends[0]] - at[dyad.ends[1]])
        return (way - a - b) * (way - abs(a - b))

    start = mpf(near.high) + mpf(near.low)
    return mp.findroot(margin, (start, start + mpf(10) ** -20), tol=mpf(10) ** -80, verify=False)


def rates(pose: Callable[[Any], Places], place: Any, step: Any) -> tuple[Places, Places, Places]:
    """Position, first and second derivative."""
    before, here, after = (pose(place + k * step) for k in (-1, 0, 1))
    first = {name: (after[name] - before[name]) / (2 * step) for name in here}
    second = {name: (after[name] - 2 * here[name] + before[name]) / step**2 for name in here}
    return here, first, second
