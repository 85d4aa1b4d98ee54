"""A bar to a slider on a line: the dyad of slider-cranks, and of rams on guides that move themselves."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

from linkanim.mechanics.closing.chain import Closing
from linkanim.mechanics.closing.kinds.slider import SliderDyad
from linkanim.mechanics.formulas.exact import Sum, exact_angle, quarter_turns, snapped
from linkanim.mechanics.formulas.planar import Moving
from linkanim.mechanics.linkage.joint import Need
from linkanim.mechanics.linkage.rail import Line
from linkanim.mechanics.loops.loop import Loop, aside_of
from linkanim.mechanics.loops.roots import slider_root
from linkanim.mechanics.loops.signed import SignedRoot

if TYPE_CHECKING:
    from linkanim.mechanics.closing.assembly import Assembly
    from linkanim.mechanics.closing.walk import Walk
    from linkanim.mechanics.linkage.linkage import Linkage
    from linkanim.mechanics.loops.loop import Gearing


@dataclass(frozen=True, slots=True)
class RRP(SliderDyad):
    """A bar from `end` to a slider on `line`; `side` +1 is the closure further forward, -1 back."""

    end: str
    length: float
    line: Line
    side: int = 1

    sides: ClassVar[tuple[str, str]] = ("forward", "backward")

    @property
    def needs(self) -> tuple[Need, ...]:
        """The bar's far end, and the joints of its line."""
        return Need("from", self.end), *self.line.needs("line")

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """Its bar."""
        return ((self.end, self.length),)

    @property
    def pins(self) -> tuple[str, ...]:
        """The bar's two ends."""
        return self.end, self.name

    @property
    def named_sign(self) -> int:
        """The sign of the root: how far the slider is ahead of the bar's end."""
        return self.side

    def scaled(self, factor: float) -> RRP:
        """Return the dyad with its bar, and its line's offset, times a factor."""
        return replace(self, length=self.length * factor, line=self.line.scaled(factor))

    def loop(self, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
        """Return the loop of a crank pin against the line, where both stand on the ground."""
        crank = linkage.crank(self.end) if self.end in gears else None
        if crank is None or self.line.on or not linkage.joint(crank.pivot).fixed:
            return None
        pivot, through = linkage.pin(crank.pivot), linkage.pin(self.line.through)
        aside = aside_of(linkage, pivot, through, self.line.angle)
        tie = self.length - crank.length
        reach = sum(abs(a - b) for a, b in zip(pivot.position, through.position, strict=True))
        eccentricity = snapped(aside - Sum(self.line.offset), (0.0, tie, -tie), reach + abs(self.line.offset))
        reference = exact_angle(self.line.angle) - quarter_turns(1)
        root = slider_root(crank.length, self.length, eccentricity, reference)
        return Loop(self.end, crank, gears[self.end], None, root)

    def close(self, walk: Walk) -> None:
        """Add the slider: its way along the line is that of the bar's end and the root q = ±√(b² - e²).

        With e how far the end lies left of the line and ρ = e'/q the bar turns at -ρ, seen from the line.
        """
        rail, point = self.line.laid(walk), walk.points[self.end]
        forward, aside = rail.forward(point), rail.aside(point)
        root = self._root(walk, aside)
        rho, q = root.ratio, root.q
        travel = Moving(
            forward.value + q,
            forward.rate - aside.value * rho.value,
            forward.second - (aside.rate * rho.value + aside.value * rho.rate),
        )
        walk.points[self.name] = rail.place(travel)
        walk.travels[self.name] = travel
        arm = rail.along.scaled(q) - rail.along.left().scaled(aside.value)
        walk.add_piece(rail.turning.plus(-rho.value, -rho.rate), (self.end, self.name), arm)

    def _root(self, walk: Walk, aside: Moving) -> SignedRoot:
        loop, sign = walk.assembly.loops.get(self.name), walk.assembly.signs[self.name]
        if loop is not None:
            return walk.loop_root(loop, sign)[0]
        u, w = self.length - aside.value, self.length + aside.value
        return walk.chain_root(self.name, Closing(u, w, aside, False, None, squared=False)).times(sign)

    def transmission(self, u: float, w: float) -> float:
        """Return the angle from its bar to the normal of its line: as much less than 90° as the bar leans.

        The bar leans asin(|e|/b), where U = b - e and W = b + e.
        """
        return math.pi / 2 - abs(2 * math.atan2(math.sqrt(w), math.sqrt(u)) - math.pi / 2)

    def linkage_name(self, assembly: Assembly) -> str:
        """Return slider-crank or slider-rocker, and whether the line runs past the pivot."""
        loop = assembly.loops.get(self.name)
        if loop is None:
            return "slider linkage"
        eccentric = loop.root.u.least != loop.root.w.least
        turns = "slider-crank" if assembly.path.full_turn else "slider-rocker"
        return f"{'offset' if eccentric else 'in-line'} {turns}"

    def transmission_at(self, place: Callable[[str], Any]) -> Any:
        """Return the angle from its bar to the normal of its line, as in `transmission`."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        bar = (place(self.name) - place(self.end)) * cmath.rect(1.0, -self.line.angle)
        if self.line.on:
            axis = place(self.line.on[1]) - place(self.line.on[0])
            bar = bar * axis.conjugate()
        return np.arctan2(abs(bar.real), abs(bar.imag))

    def why_apart(self, u: float, w: float) -> str:
        """Say that the bar is too short for its line."""
        return (
            f"the bar of {self.length:g} cannot reach its line of travel from {self.end} "
            "at any angle of the input; make it longer or the offset smaller"
        )
