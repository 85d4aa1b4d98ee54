"""An answer as plain numbers, as it goes from one process to another and onto a tape; and back to a scene."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.fit import Fit, document_of
from linkanim.synthesis.kinds import FOUR_BAR

NAME = "path"
"""What the scene of an answer is called, and its file."""
NUMBERS = 4 + len(FOUR_BAR.parameters)


class PathAnswer(NamedTuple):
    """A four-bar beside a stroke: by how much of its size in percent it is off, and what it is.

    `closure` is +1 or -1, `start` the crank's angle at the stroke's first point (rad), `sense` +1 or -1 the
    way it turns from there, `row` the parameters of a four-bar.
    """

    off: float
    closure: float
    start: float
    sense: float
    row: tuple[float, ...]

    @property
    def numbers(self) -> tuple[float, ...]:
        """All of it in a row."""
        return (*self[:4], *self.row)

    def scene(self, unit: str, towards: Scene | None = None) -> Scene:
        """Return the linkage as a scene, maybe on the way `towards` another; errors as reading a file."""
        source = "made by linkanim for a path drawn in the window"
        start = self.start, self.sense
        document = document_of(FOUR_BAR, self.row, self.closure, start, source=source, length_unit=unit)
        return scene_from(document, name=NAME, where=NAME, towards=towards)


def answer_of(fit: Fit) -> PathAnswer:
    """Return a fit's answer."""
    off = 100 * fit.error / fit.task.curve.size
    row = tuple(float(value) for value in fit.row)
    return PathAnswer(off, fit.closure_sign, float(fit.angles[0]), fit.sense, row)


def answer_from(numbers: tuple[float, ...]) -> PathAnswer:
    """Return the answer that is all of these `NUMBERS` numbers."""
    off, closure, start, sense, *row = numbers
    return PathAnswer(off, closure, start, sense, tuple(row))
