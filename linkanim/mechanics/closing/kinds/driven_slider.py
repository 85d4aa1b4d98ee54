"""A slider on a fixed line that drives the linkage: it travels as the input has it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from linkanim.mechanics.linkage.joint import Joint, Need, Slide
from linkanim.mechanics.linkage.rail import Line
from linkanim.mechanics.loops.input_state import TravelState

if TYPE_CHECKING:
    from linkanim.mechanics.closing.walk import Walk


@dataclass(frozen=True, slots=True)
class DrivenSlider(Joint):
    """A slider on the fixed `line`; the drive gives its travel, from the joint that the line runs through."""

    line: Line

    travels: ClassVar[bool] = True

    @property
    def needs(self) -> tuple[Need, ...]:
        """The joint that its line runs through."""
        return self.line.needs("line")

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The joint, along its line."""
        return (self.line.guiding(self.name),)

    @property
    def lengths(self) -> tuple[float, ...]:
        """The line's offset."""
        return (self.line.offset,)

    def scaled(self, factor: float) -> DrivenSlider:
        """Return the slider with its line's offset times a factor."""
        return replace(self, line=self.line.scaled(factor))

    def close(self, walk: Walk) -> None:
        """Put the slider where the input has it."""
        assert isinstance(walk.state, TravelState)
        walk.points[self.name] = self.line.laid(walk).place(walk.state.travel)
        walk.travels[self.name] = walk.state.travel
