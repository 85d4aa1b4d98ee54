"""Places of labels as functions of the pose: off a joint, off a bar, off an arrow.

An anchor is a base in the frame of a joint or a bar, and a way off it that is as long as a label needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.motion_marks import SeenArrow
from linkanim.picture.placing import Size
from linkanim.picture.raster import Loop
from linkanim.picture.shapes import Places, unit, units


class Anchor(NamedTuple):
    """Where a label stands: at a `base` in the frame of the joints `at` and `head`, then off it on its `way`.

    In the frame 1 is the vector from `at` to `head`, y down; where both are one joint, the scene's unit to
    the right. On its way the label just clears a disc of the radius `reach` (pixels) about the base or, where
    it is `flat`, the line through the base across the way. The way `turns` with the frame, or stays.
    """

    at: str
    head: str
    base: complex = 0j
    way: complex = 0j
    reach: float = 0.0
    flat: bool = False
    turns: bool = False

    def foot(self, places: Places, scale: float) -> complex:
        """Return the base in pixels."""
        at = places[self.at]
        return at + self.base * (places[self.head] - at if self.head != self.at else scale)

    def middle(self, places: Places, scale: float, size: Size) -> complex:
        """Return the middle of a label of a size in pixels, in a view of `scale`."""
        way = self.way
        if self.turns and self.head != self.at:
            way *= unit(places[self.head] - places[self.at])
        return self.foot(places, scale) + pushed(way, self.reach, size, self.flat)


def pushed(way: complex, reach: float, size: Size, flat: bool) -> complex:
    """Return how far a label of a size is pushed along a way, so that it just clears what is at its begin."""
    across, down = abs(way.real), abs(way.imag)
    wide, high = size[0] / 2, size[1] / 2
    if flat:
        return way * (reach + across * wide + down * high)
    if not way:
        return 0j
    if across and (wide + reach) * down <= high * across:
        return way * (wide + reach) / across
    if down and (high + reach) * across <= wide * down:
        return way * (high + reach) / down
    square = max(reach**2 - (across * high - down * wide) ** 2, 0.0)
    return way * (across * wide + down * high + sqrt(square))


class Anchors(NamedTuple):
    """Anchors of one kind (k,) for one label, each with its price."""

    at: str
    head: str
    base: Loop
    way: Loop
    reach: NDArray[np.float64]
    price: NDArray[np.float64]
    flat: bool = False
    turns: bool = False

    def picked(self, n: int) -> Anchor:
        """Return one of them."""
        place = complex(self.base[n]), complex(self.way[n]), float(self.reach[n])
        return Anchor(self.at, self.head, *place, self.flat, self.turns)

    def feet(self, paths: Paths) -> Loop:
        """Return their bases in pixels (n moments, k)."""
        at, span = paths.frame(self.at, self.head)
        feet: Loop = at[:, None] + self.base * span[:, None]
        return feet

    def middles(self, paths: Paths, size: Size) -> Loop:
        """Return the middles of a label of this size (n moments, k)."""
        way = self.way[None]
        if self.turns:
            way = way * units(paths.frame(self.at, self.head)[1])[:, None]
        across, down = np.abs(way.real), np.abs(way.imag)
        wide, high = size[0] / 2, size[1] / 2
        far = self.reach + across * wide + down * high
        if not self.flat:
            square = self.reach**2 - (across * high - down * wide) ** 2
            far = across * wide + down * high + np.sqrt(np.maximum(square, 0.0))
            with np.errstate(divide="ignore", invalid="ignore"):
                far = np.where((wide + self.reach) * down <= high * across, (wide + self.reach) / across, far)
                far = np.where((high + self.reach) * across <= wide * down, (high + self.reach) / down, far)
            far = np.where(way == 0, 0.0, far)
        middles: Loop = self.feet(paths) + far * way
        return middles


class Paths(NamedTuple):
    """Where joints are in pixels at some moments, and the motion at these moments."""

    places: Mapping[str, Loop]
    scale: float
    moments: int

    def frame(self, at: str, head: str) -> tuple[Loop, Loop]:
        """Return a frame's origin and its unit vector in pixels (n moments)."""
        origin = self.places[at]
        if at == head:
            return origin, np.full(self.moments, complex(self.scale))
        return origin, self.places[head] - origin


class Way(NamedTuple):
    """Where an arrow's name stands: at a `share` of it, then off it on a way that is `turn` off its own."""

    share: float
    turn: complex
    off: float
    """The gap to the arrow, in heights of the name."""

    def middle(self, arrow: SeenArrow, size: Size) -> complex:
        """Return the middle of the name of an arrow."""
        way = unit(arrow.reach) * self.turn
        return arrow.foot + self.share * arrow.reach + pushed(way, self.off * size[1], size, True)

    def middles(self, feet: Loop, reaches: Loop, size: Size) -> Loop:
        """Return the middles of the name of an arrow at some moments (n,)."""
        way = units(reaches) * self.turn
        far = self.off * size[1] + (np.abs(way.real) * size[0] + np.abs(way.imag) * size[1]) / 2
        middles: Loop = feet + self.share * reaches + far * way
        return middles


WAYS = (
    *(Way(1.0, 1 + 0j, 0.25), Way(0.85, 1j, 0.25), Way(0.85, -1j, 0.25)),
    *(Way(0.65, 1j, 0.25), Way(0.65, -1j, 0.25), Way(1.0, 1j, 0.5), Way(1.0, -1j, 0.5)),
)


def some_of(family: Anchors, which: NDArray[np.bool_]) -> Anchors:
    """Return some of a family's anchors."""
    return family._replace(
        base=family.base[which], way=family.way[which], reach=family.reach[which], price=family.price[which]
    )
