"""The pencil: a stroke that is drawn or dragged, and the linkages that follow it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from linkanim.mechanics.linkage.joint import Point
from linkanim.player.state.clock import Clock
from linkanim.player.state.editing import Editing
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.synthesis.answer import PathAnswer
    from linkanim.synthesis.curves.drawn import DrawnCurve

PIVOTS = ("O2", "O4")
"""Of every answer."""


@dataclass(frozen=True)
class Sketch:
    """What the pencil has drawn over the scene `before`, which comes back with its clock and editing.

    All is in the `unit` of length in which scenes were shown then. `pen` holds the points of the stroke under
    way, `curve` what the last stroke meant; `strokes` counts them. Of the `answers` the `chosen` one is the
    state's scene; the first may be the scene whose own trace was taken. `pivots` are held where they were
    put. `held` is the number of the curve's point, or the pivot, that is being dragged, `base` the scene when
    that was taken, `coming` the one for the next frame. `earlier` was there before the last stroke or drag.
    """

    before: Scene
    clock: Clock
    editing: Editing
    unit: str
    pen: tuple[complex, ...] = ()
    strokes: int = 0
    curve: DrawnCurve | None = None
    answers: tuple[PathAnswer | Scene, ...] = ()
    chosen: int = 0
    pivots: tuple[tuple[str, Point], ...] = ()
    held: int | str | None = None
    base: Scene | None = None
    coming: Scene | None = None
    earlier: Sketch | None = None

    @property
    def answer(self) -> PathAnswer | Scene | None:
        """The answer that is shown; None before the first has come."""
        return self.answers[self.chosen] if self.answers else None

    @property
    def follows(self) -> bool:
        """Whether the linkage that is shown was found for the stroke, and its fixed pins can be dragged."""
        return not (self.is_blank or isinstance(self.answer, Scene))

    @property
    def off(self) -> float | None:
        """By how much of the stroke's size, in percent, the answer shown is off; None before the first."""
        return 0.0 if isinstance(self.answer, Scene) else self.answer.off if self.answer else None

    @property
    def is_blank(self) -> bool:
        """Whether no linkage follows yet what is drawn."""
        return bool(self.pen) or not self.answers
