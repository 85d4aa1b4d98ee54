"""What a linkage was made for, as its file keeps it: poses, a function, or a stroke and its time ratio.

It says nothing of the motion; what explains and draws the synthesis reads it.
"""

from __future__ import annotations

from typing import NamedTuple


class PosesPurpose(NamedTuple):
    """Poses of the coupler: x, y (the scene's unit) and angle (rad); its origin is the first traced joint."""

    poses: tuple[tuple[float, float, float], ...]


class FunctionPurpose(NamedTuple):
    """A function in words, with its precision points.

    At each x the function has a y, the crank stands at an angle `input` (rad), and the output at an angle
    (rad), or a slider at a way along its line (the scene's unit).
    """

    words: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    input: tuple[float, ...]
    output: tuple[float, ...]


class TimeRatioPurpose(NamedTuple):
    """The slow way's time over the quick way's, and the slider's stroke, or the rocker's swing (rad)."""

    ratio: float
    stroke: float | None = None
    swing: float | None = None


Purpose = PosesPurpose | FunctionPurpose | TimeRatioPurpose
