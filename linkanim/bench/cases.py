"""The easy cycle and the hard cases: lengths and sequences of inputs, before anything is solved."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from linkanim.bench.question import TURN, Floats

Length = float | str
"""A string is a decimal number, taken as it is written: the float nearest to it is not what was meant."""


@dataclass(frozen=True)
class Case:
    """A four-bar (ground, crank, coupler, rocker) and its inputs: angles, or phases where `by_phase`.

    `side` is the closure just after angle 0 of a turning input, or while sin φ > 0 of a swinging one.
    `periods` is the number of turns after which the motion is back.
    """

    name: str
    lengths: tuple[Length, Length, Length, Length]
    inputs: Floats
    side: int = 1
    by_phase: bool = False
    turns: bool = True
    periods: int = 1


def degrees(first: int, last: int) -> Floats:
    """Return every whole degree from first to last, in radians; the last one left out."""
    return np.radians(np.arange(first, last, dtype=np.float64))


def beside(inputs: Floats, *places: float) -> Floats:
    """Add inputs beside some places, 1e-2 to 1e-12 from them, to either side."""
    steps = np.logspace(-2, -12, 11)
    added = [place + steps * side for place in places for side in (-1, 1)]
    return np.unique(np.concatenate([inputs, *added]))


def turned(turns: float) -> Floats:
    """Return every whole degree of one turn after so many turns."""
    return turns * TURN + degrees(0, 360)


def towards(limit: float) -> Floats:
    """Return angles that approach a limit to 1e-12 rad, three to a decade."""
    return limit - np.logspace(-1, -12, 34)


ONE_TURN = beside(degrees(90, 450), TURN / 2, TURN)
TWO_TURNS = beside(degrees(90, 810), TURN / 2, TURN, 3 * TURN / 2, 2 * TURN)

EASY_LENGTHS = (100.0, 30.0, 90.0, 80.0)
EASY = Case("easy cycle", EASY_LENGTHS, degrees(0, 360))

SWINGS = (5.0, 4.0, 3.0, 3.5)
"""r3 + r4 < r1 + r2: the input swings between ± TOGGLE."""
TOGGLE = 2 * math.acos(math.sqrt((9.0**2 - 6.5**2) / (4 * 5.0 * 4.0)))

HARD = (
    Case("parallelogram", (4.0, 2.0, 4.0, 2.0), ONE_TURN),
    Case("antiparallelogram", (4.0, 2.0, 4.0, 2.0), ONE_TURN, side=-1),
    Case("change point at 0", (4.0, 2.0, 5.0, 3.0), TWO_TURNS, periods=2),
    Case("change point at 180 deg", (5.0, 2.0, 4.0, 3.0), TWO_TURNS, periods=2),
    Case("s + l = p + q in decimals", ("1.2", "0.3", "0.7", "0.8"), TWO_TURNS, periods=2),
    Case("1e-12 from a change point", (5.0, 2.0, 4.0, 3.0 + 1e-12), ONE_TURN),
    Case("1e-12 rad before a toggle", SWINGS, towards(TOGGLE), turns=False),
    Case("through two limits", SWINGS, ONE_TURN, by_phase=True, turns=False),
    Case("double-rocker", (5.0, 3.5, 2.0, 4.0), ONE_TURN, by_phase=True, turns=False),
    Case("after 1e6 turns", EASY_LENGTHS, turned(1e6)),
    Case("after 1e9 turns", EASY_LENGTHS, turned(1e9)),
)
