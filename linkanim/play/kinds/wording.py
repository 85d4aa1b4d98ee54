"""How numbers stand in questions, and how many answers."""

from __future__ import annotations

from math import degrees

from linkanim.digits import short, significant, typeset
from linkanim.play.question import Puzzle

MOST = 4
"""So many answers a question has at most."""


def number(value: float) -> str:
    """Return a number as it is read in a question."""
    return typeset(short(value) if abs(value) >= 0.1 or not value else significant(value, 3))


def angle(value: float) -> str:
    """Return an angle of a full turn, in degrees."""
    return f"{value % 360:.1f}°"


def swing(low: float, high: float) -> str:
    """Return between which angles, in degrees, something swings."""
    return typeset(f"it swings between {low:.1f}° and {high:.1f}°")


def between(one: float, other: float) -> float:
    """Return how far two angles in degrees are from each other, 0 to 180."""
    return abs((one - other + 180) % 360 - 180)


def crank_degrees(puzzle: Puzzle, phase: float) -> float:
    """Return the input's angle at a phase, 0 to 360."""
    return degrees(puzzle.scene.pose(phase, 0).coordinate) % 360
