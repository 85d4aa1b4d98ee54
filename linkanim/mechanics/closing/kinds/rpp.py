"""A pin in the slot of a bar that slides on a line: the dyad of the Scotch yoke.

With f and e how far the pin lies forward along the line and to its left, and σ the slot's direction from
the line's, the slot crosses the line at s = f - e cot σ: linear, so the bar never jams and has one closure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from linkanim.mechanics.closing.kinds.slider import SliderDyad
from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.formulas.planar import Moving
from linkanim.mechanics.linkage.joint import Need, Slide
from linkanim.mechanics.linkage.rail import Line

if TYPE_CHECKING:
    from linkanim.mechanics.closing.assembly import Assembly
    from linkanim.mechanics.closing.walk import Walk


@dataclass(frozen=True, slots=True)
class RPP(SliderDyad):
    """A bar sliding along `line`, the joint `pin` in its slot; the joint is where the slot crosses the line.

    `slot` is the slot's direction from the line's, in radians; it must not lie along the line.
    """

    pin: str
    line: Line
    slot: float = math.pi / 2

    @property
    def needs(self) -> tuple[Need, ...]:
        """The pin in the slot, and the joints of the line."""
        return Need("slide.pin", self.pin), *self.line.needs("slide.line")

    @property
    def pins(self) -> tuple[str, ...]:
        """The pin in the slot."""
        return (self.pin,)

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The bar along its line, and the pin along the bar's slot."""
        slot = Slide(self.pin, self.name, self.line.on, self.line.angle + self.slot)
        return self.line.guiding(self.name), slot

    @property
    def lengths(self) -> tuple[float, ...]:
        """The line's offset."""
        return (self.line.offset,)

    def scaled(self, factor: float) -> RPP:
        """Return the dyad with its line's offset times a factor."""
        return replace(self, line=self.line.scaled(factor))

    def close(self, walk: Walk) -> None:
        """Add where the slot crosses the line: s = f - e cot σ, and its derivatives alike."""
        rail, point = self.line.laid(walk), walk.points[self.pin]
        cosine, sine = unit(self.slot)
        forward, aside, lean = rail.forward(point), rail.aside(point), cosine / sine
        travel = Moving(
            forward.value - aside.value * lean,
            forward.rate - aside.rate * lean,
            forward.second - aside.second * lean,
        )
        walk.points[self.name] = rail.place(travel)
        walk.travels[self.name] = travel

    def linkage_name(self, assembly: Assembly) -> str:
        """Return Scotch yoke, or that its slot is not square to its line."""
        return "Scotch yoke" if unit(self.slot)[0] == 0 else "Scotch yoke, oblique slot"
