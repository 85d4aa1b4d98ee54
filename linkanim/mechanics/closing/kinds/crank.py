"""Cranks: pins that turn about a fixed pin with the input, or geared to it about any joint."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

from linkanim.mechanics.formulas.circular import half_angle
from linkanim.mechanics.formulas.planar import Vec, carried
from linkanim.mechanics.linkage.joint import Joint, Need
from linkanim.mechanics.loops.loop import own_loop

if TYPE_CHECKING:
    from linkanim.mechanics.closing.walk import Walk


@dataclass(frozen=True, slots=True)
class Gear:
    """A gear pair: angle = ratio × (angle of the crank `mate`) + offset."""

    mate: str
    ratio: Fraction
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Crank(Joint):
    """A pin that turns about the fixed pin `pivot`: the input; or about any joint, geared to another crank.

    The angle of a geared crank is absolute, also of one whose pivot moves: a planet.
    """

    pivot: str
    length: float
    gear: Gear | None = None

    @property
    def needs(self) -> tuple[Need, ...]:
        """Its pivot, and the crank that it is geared to."""
        if self.gear is None:
            return (Need("crank", self.pivot, "fixed"),)
        return Need("crank", self.pivot), Need("gear.with", self.gear.mate, "crank")

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """The crank."""
        return ((self.pivot, self.length),)

    @property
    def pins(self) -> tuple[str, ...]:
        """Its two ends."""
        return self.pivot, self.name

    def scaled(self, factor: float) -> Crank:
        """Return the crank with its length times a factor."""
        return replace(self, length=self.length * factor)

    def close(self, walk: Walk) -> None:
        """Add r e^{iψ}, ψ = ratio × θ + offset, as r (cos² - sin²) and 2r sin cos of ψ/2.

        The difference is right to 2.3 eps of r, where r - 2r sin² is to 3.6: that is taken where a loop
        against a fixed pin needs 2r sin² anyway.
        """
        gearing = walk.assembly.gears[self.name]
        loop = own_loop(self.name, walk.assembly.loops)
        form = loop.form if loop else partial(half_angle, size=2.0 * self.length)
        half = walk.state.half(-gearing.offset, gearing.ratio, form=form)
        squares = half.squares(2.0 * self.length)
        spans = loop is not None and loop.ground is not None
        along = self.length - squares.sine if spans else (squares.cosine - squares.sine) * 0.5
        arm = Vec(along, squares.product)
        pace = walk.pace(gearing)
        walk.points[self.name] = walk.points[self.pivot] + carried(arm, pace)
        walk.add_piece(pace, (self.pivot, self.name), arm)
