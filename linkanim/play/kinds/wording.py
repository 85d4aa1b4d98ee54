"""How numbers and ways stand in questions, and how many answers."""

from __future__ import annotations

from cmath import phase
from math import degrees, pi

from linkanim.digits import short, significant, typeset
from linkanim.play.question import Puzzle

MOST = 4
"""So many answers a question has at most."""

WAYS = ("to the right", "up", "to the left", "down")
"""The compass points of `quarter`, as ways to move, and as places beside something."""
SIDES = ("to the right of", "above", "to the left of", "below")
BESIDE = ("on the right", "above", "on the left", "below")
TURNS = ("counterclockwise", "clockwise")


def quarter(vector: complex) -> int:
    """Return the compass point that is nearest to a vector: 0 right, 1 up, 2 left, 3 down."""
    return round(phase(vector) / (pi / 2)) % 4


def obliquity(vector: complex) -> float:
    """Return the angle between a vector and the nearest compass point, 0 to π/4."""
    return abs(phase(vector * (1, -1j, -1, 1j)[quarter(vector)]))


def number(value: float) -> str:
    """Return a number as it is read in a question."""
    return typeset(short(value) if abs(value) >= 0.1 or not value else significant(value, 3))


def angle(value: float) -> str:
    """Return an angle of a full turn, in degrees."""
    return f"{round(value, 1) % 360:.1f}°"


def swing(low: float, high: float) -> str:
    """Return between which angles, in degrees, something swings."""
    return f"it swings between {tenths(low)} and {tenths(high)}"


def tenths(value: float) -> str:
    """Return an angle in degrees, of either sign."""
    return typeset(f"{round(value, 1) + 0.0:.1f}°")  # -0.0 + 0.0 is 0.0


def between(one: float, other: float) -> float:
    """Return how far two angles in degrees are from each other, 0 to 180."""
    return abs((one - other + 180) % 360 - 180)


def crank_degrees(puzzle: Puzzle, at: float) -> float:
    """Return the input's angle at a phase, 0 to 360."""
    return round(degrees(puzzle.scene.pose(at, 0).coordinate), 9) % 360
