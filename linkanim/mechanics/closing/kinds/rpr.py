"""A bar that turns on one joint and slides on another: the dyad of inverted slider-cranks."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Slope, Vec, carried
from linkanim.mechanics.linkage.joint import Joint, Need, Slide
from linkanim.mechanics.loops.loop import Loop, ground_between
from linkanim.mechanics.loops.roots import slot_root
from linkanim.mechanics.loops.signed import Reduced, SignedRoot
from linkanim.mechanics.loops.triangle import PinLoop, moving_triangle, pin_triangle

if TYPE_CHECKING:
    from linkanim.mechanics.closing.assembly import Assembly
    from linkanim.mechanics.closing.walk import Walk
    from linkanim.mechanics.linkage.linkage import Linkage
    from linkanim.mechanics.loops.loop import Gearing


@dataclass(frozen=True, slots=True)
class RPR(Joint):
    """A bar that turns about the joint `pivot`, its slot passing through the joint `through`.

    One of the two may be fixed: a lever whose slot a crank pin drives, or a rod sliding through a swivel.

    through = pivot + s·u + offset·n with s > 0, u the bar's direction and n to its left;
    the joint itself is pivot + length·u.
    """

    pivot: str
    through: str
    length: float
    offset: float = 0.0

    dyad: ClassVar[bool] = True

    @property
    def needs(self) -> tuple[Need, ...]:
        """The pivot, and the joint in the slot."""
        return Need("slot.pivot", self.pivot), Need("slot.through", self.through)

    @property
    def moved_by(self) -> tuple[Need, ...]:
        """The joint in the slot, or the pivot."""
        return self.needs[::-1]

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """The slotted bar."""
        return ((self.pivot, self.length),)

    @property
    def pins(self) -> tuple[str, ...]:
        """The pivot, and the joint in the slot."""
        return self.pivot, self.through

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The joint in the slot, along the bar."""
        return (Slide(self.through, self.pivot, (self.pivot, self.name), 0.0),)

    @property
    def lengths(self) -> tuple[float, ...]:
        """The bar's length, and the slot's offset."""
        return self.length, self.offset

    @property
    def named_sign(self) -> int:
        """The sign of the root: the joint in the slot is always ahead of the pivot."""
        return 1

    def scaled(self, factor: float) -> RPR:
        """Return the dyad with its bar, and its slot's offset, times a factor."""
        return replace(self, length=self.length * factor, offset=self.offset * factor)

    def loop(self, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
        """Return the loop of a crank pin and a fixed pin, one in the slot and one the pivot."""
        for swapped, (moving, fixed) in enumerate(((self.through, self.pivot), (self.pivot, self.through))):
            crank = linkage.crank(moving) if moving in gears else None
            if crank and linkage.joint(crank.pivot).fixed and linkage.joint(fixed).fixed:
                ground = ground_between(linkage, crank, fixed)
                if ground is None:
                    return None
                root = slot_root(ground.exact, crank.length, self.offset, ground.angle)
                return Loop(moving, crank, gears[moving], ground, root, bool(swapped))
        return None

    def close(self, walk: Walk) -> None:
        """Add the slotted bar and its end."""
        pivot, pin = walk.points[self.pivot], walk.points[self.through]
        loop, sign = walk.assembly.loops.get(self.name), walk.assembly.signs[self.name]
        if loop is not None:
            root, ground = walk.pin_loop(loop, sign)
            turn = pin_triangle(ground, (0.0, 0.0), root).turn
            direction = _loop_direction(ground, root, (self.offset, sign), swapped=loop.swapped)
        else:
            across = pin - pivot
            root = walk.slot_root(self.name, across, self.offset).times(sign)
            turn = moving_triangle(across, (0.0, 0.0), root).turn
            reduced = root.lift or Reduced(across, root.q)
            direction = _direction(reduced.across.position, reduced.q, self.offset)
        turning = _turning(turn, root, self.offset) if self.offset else turn
        arm = direction.scaled(self.length)
        walk.points[self.name] = pivot + carried(arm, turning)
        walk.add_piece(turning, (self.pivot, self.name), arm)

    def transmission(self, u: float, w: float) -> float:
        """Return the angle from the slot's normal, along which the pin pushes, to the bar's motion there.

        90° of a slot that runs through its pivot: the pin's push then does nothing but turn the bar.
        """
        return math.atan2(math.sqrt(w), abs(self.offset))

    def linkage_name(self, assembly: Assembly) -> str:
        """Return inverted slider-crank, and how its slotted bar, or the cylinder on its rod, moves."""
        loop = assembly.loops.get(self.name)
        if loop is None or loop.ground is None:
            return "inverted slider-crank"
        kind = "rotating" if loop.ground.length < loop.crank.length else "swinging"
        return f"inverted slider-crank, {kind} {'cylinder' if loop.swapped else 'slotted bar'}"

    def transmission_at(self, place: Callable[[str], Any]) -> Any:
        """Return the angle from the slot's normal to the bar's motion at the pin, as in `transmission`."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        arm = abs(place(self.through) - place(self.pivot))
        return np.arccos(np.minimum(abs(self.offset) / arm, 1.0))

    def why_apart(self, u: float, w: float) -> str:
        """Say that the slot's offset is too large."""
        return (
            f"the slot's offset {self.offset:g} is more than the pin {self.through} is ever away "
            f"from {self.pivot}; make it smaller"
        )


def _turning(turn: Slope, root: SignedRoot, offset: float) -> Slope:
    """Return how a slotted bar turns: e, and what the sliding adds where the slot misses the pivot."""
    inverse = 1.0 / (root.q * root.q + offset * offset)
    slide = root.ratio.value * (0.5 * offset) * inverse
    growth = root.ratio.value * root.q * inverse
    return turn.plus(slide, root.ratio.rate * (0.5 * offset) * inverse - slide * growth)


def _loop_direction(ground: PinLoop, root: SignedRoot, bar: tuple[float, int], *, swapped: bool) -> Vec:
    """Return the slotted bar's direction; a slot through its own pivot turns at half the crank's angle.

    `bar` is the slot's offset and the closure's sign; `swapped` where the bar turns about the crank's pin.
    """
    offset, sign = bar
    way = -1.0 if swapped else 1.0
    if ground.short == 0 and offset == 0:
        return Vec(-ground.half.sine, ground.half.cosine).times(ground.direction).scaled(way * sign)
    return _direction(ground.across().scaled(-way), root.q, offset)


def _direction(across: Vec, s: Value, offset: float) -> Vec:
    """Return the unit vector u with across = s·u + offset·n."""
    if offset == 0:
        return Vec(across.x / s, across.y / s)
    turned = across.times(Vec(s, -offset))
    square = s * s + offset * offset
    return Vec(turned.x / square, turned.y / square)
