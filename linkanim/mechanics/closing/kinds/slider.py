"""What the dyads with a slider on a line share, whatever moves the slider."""

from __future__ import annotations

from typing import ClassVar

from linkanim.mechanics.linkage.joint import Joint, Need, Slide
from linkanim.mechanics.linkage.rail import Line


class SliderDyad(Joint):
    """A dyad whose joint travels along `line`, fixed or carried by a body."""

    __slots__ = ()

    line: Line

    dyad: ClassVar[bool] = True
    travels: ClassVar[bool] = True

    @property
    def moved_by(self) -> tuple[Need, ...]:
        """What moves the slider, or a line that is carried."""
        return self.needs

    @property
    def body(self) -> tuple[str, ...]:
        """The joints of the body that carries its line."""
        return self.line.body

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The joint, along its line."""
        return (self.line.guiding(self.name),)
