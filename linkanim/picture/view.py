"""Between the scene's lengths and pixels: the only place where one becomes the other."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from linkanim.frozen import frozen


class Rect(NamedTuple):
    """A rectangle of the window in pixels, from its top left corner."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Its right edge."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """Its bottom edge."""
        return self.y + self.height

    @property
    def middle(self) -> complex:
        """Its middle, as x + yi."""
        return complex(self.x + self.width / 2, self.y + self.height / 2)

    def inset(self, by: float) -> Rect:
        """Return the rectangle without a border of that width; never smaller than one pixel."""
        return Rect(self.x + by, self.y + by, max(self.width - 2 * by, 1), max(self.height - 2 * by, 1))

    def meets(self, other: Rect) -> bool:
        """Return whether the two overlap."""
        apart = (
            other.x >= self.right or self.x >= other.right or other.y >= self.bottom or self.y >= other.bottom
        )
        return not apart

    def holds(self, x: float, y: float) -> bool:
        """Return whether a position lies in it."""
        return self.x <= x <= self.right and self.y <= y <= self.bottom

    def nearest(self, place: complex, half: complex = 0j) -> complex:
        """Return the centre nearest to `place` of a rectangle inside; `half` is half its width and height."""
        x = min(max(place.real, self.x + half.real), max(self.right - half.real, self.x + half.real))
        return complex(
            x, min(max(place.imag, self.y + half.imag), max(self.bottom - half.imag, self.y + half.imag))
        )

    def ahead(self, at: complex, vector: complex) -> float:
        """Return how far the edge is from a place along a vector, in lengths of it; 0 along a vector of 0."""
        gaps = [
            max(((high if step > 0 else low) - place) / step, 0.0)
            for place, step, low, high in (
                (at.real, vector.real, self.x, self.right),
                (at.imag, vector.imag, self.y, self.bottom),
            )
            if step
        ]
        return min(gaps, default=0.0)

    def crossed(self, one: complex, other: complex) -> tuple[complex, complex] | None:
        """Return the part of a segment that lies inside (Liang and Barsky); None where no part does."""
        along, first, last = other - one, 0.0, 1.0
        for step, gap in (
            (-along.real, one.real - self.x),
            (along.real, self.right - one.real),
            (-along.imag, one.imag - self.y),
            (along.imag, self.bottom - one.imag),
        ):
            if step == 0 and gap < 0:
                return None
            if step < 0:
                first = max(first, gap / step)
            elif step > 0:
                last = min(last, gap / step)
        return (one + first * along, one + last * along) if first < last else None


class Box(NamedTuple):
    """A rectangle of the scene, in its unit of length, y up."""

    left: float
    low: float
    right: float
    high: float

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle."""
        return (self.left + self.right) / 2, (self.low + self.high) / 2


def joined(one: Box, other: Box) -> Box:
    """Return the smallest rectangle that holds both."""
    left, low = min(one.left, other.left), min(one.low, other.low)
    return Box(left, low, max(one.right, other.right), max(one.high, other.high))


@frozen
class View:
    """A scale (pixels for one unit of length) and where the scene's origin lies in the window.

    The scene's y points up and the window's down, so an angle turns the other way in pixels.
    """

    scale: float
    x: float
    y: float

    def to_pixel(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point of the scene lies in the window, to fractions of a pixel."""
        return self.x + self.scale * x, self.y - self.scale * y

    def to_world(self, px: float, py: float) -> tuple[float, float]:
        """Return the point of the scene under a position in the window."""
        return (px - self.x) / self.scale, (self.y - py) / self.scale

    def pixel(self, point: tuple[float, float]) -> complex:
        """Return where a point of the scene lies, as x + yi in pixels."""
        return complex(self.x + self.scale * point[0], self.y - self.scale * point[1])


def view_of(box: Box, room: Rect, share: float = 1.0) -> View:
    """Return the view in which a box lies in the middle of a room, as large as fits times `share`.

    A room without extent, which a tiny window may leave, counts as one pixel.
    """
    wide, high = max(box.right - box.left, 1e-9), max(box.high - box.low, 1e-9)
    scale = share * min(max(room.width, 1.0) / wide, max(room.height, 1.0) / high)
    (x, y), middle = box.middle, room.middle
    return View(scale, middle.real - scale * x, middle.imag + scale * y)


def moved(view: View, about: tuple[float, float], *, zoom: float, pan: tuple[float, float]) -> View:
    """Return the view enlarged `zoom` times about a pixel, then shifted right and down in pixels."""
    x = about[0] + (view.x - about[0]) * zoom + pan[0]
    return View(view.scale * zoom, x, about[1] + (view.y - about[1]) * zoom + pan[1])


def on_the_way(values: Sequence[float], rests: Sequence[float]) -> float:
    """Return where a value is that went from each of these to the next, with the `rests` of the ways ahead.

    The last value is the goal. Later changes have greater rests, so the result is between the values.
    """
    changes = zip(pairwise(values), rests, strict=True)
    return values[-1] + sum(rest * (one - other) for (one, other), rest in changes)


def view_on_the_way(views: Sequence[View], rests: Sequence[float]) -> View:
    """Return the view on the way through several; each point moves straight from one to the next."""
    scale, x, y = (
        on_the_way(parts, rests) for parts in zip(*((one.scale, one.x, one.y) for one in views), strict=True)
    )
    return View(scale, x, y)


def eased(share: float) -> float:
    """Return 0 up to 0, 1 from 1 on, and a smooth step between."""
    share = min(max(share, 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)
