"""Velocity and acceleration polygons: how each joint's motion follows from that of those it is found from.

Every point of the polygon is the image of a joint: its velocity, or its acceleration, drawn from the pole o.
Between the images stand the relative vectors, worked out from angular velocities and what slides,

    v_BA = iω r      a_BA = -ω² r + iα r      r = B - A
    v = v_guide + vʳ      vʳ = s' u      a = a_guide + aᶜ + aʳ      aᶜ = 2iω s' u      aʳ = s'' u

so that a polygon closes only where the motion is right (Uicker, Pennock and Shigley, Theory of Machines and
Mechanisms). Vectors are x + yi: complex numbers for a `Pose`, arrays (N,) for a `Motion`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import Any, Literal, NamedTuple

from linkanim.frozen import frozen
from linkanim.mechanics.angles import unit
from linkanim.mechanics.linkage import Linkage, Rigid, Slide
from linkanim.mechanics.measures import as_complex, near, over
from linkanim.mechanics.quantities import indexed

Order = Literal[1, 2]
"""1 for velocities, 2 for accelerations."""
Sort = Literal["absolute", "relative", "normal", "tangential", "coriolis", "sliding"]

_MARKS: dict[Sort, str] = {"normal": "ⁿ", "tangential": "ᵗ", "coriolis": "ᶜ", "sliding": "ʳ"}


class Side(NamedTuple):
    """One vector of a polygon: its symbol, such as v_{BA}, and both ends."""

    symbol: str
    sort: Sort
    begin: Any
    end: Any


class Chain(NamedTuple):
    """The sides that lead from one joint's image to another's; `start` is None for the pole."""

    start: str | None
    end: str
    sides: tuple[Side, ...]


_Turning = tuple[Any, Any]
"""How a body turns: its angular velocity and acceleration."""
_STILL: _Turning = (0.0, 0.0)
_Step = tuple[Sort, Any]
"""A vector about to be put down."""


def image(motion: Any, joint: str, order: Order) -> Any:
    """Return where a joint's image lies: its velocity, or its acceleration."""
    return as_complex((motion.velocity if order == 1 else motion.acceleration)[joint])


def chains(motion: Any, linkage: Linkage, order: Order, points: Collection[str] = ()) -> tuple[Chain, ...]:
    """Return a polygon's chains: the absolute vectors, then those of bars and of what slides.

    A point of a body is included where other joints are found from it, or where it is one of `points`, such
    as coupler points. The point of a guide that lies under the sliding joint B is B′. Where everything rests
    all sides have no length; where rates are unbounded the ends are not finite.
    """
    return tuple(_Images(motion, linkage, order, points).chains())


@frozen
class _Images:
    """A motion, and which polygon of it."""

    motion: Any
    linkage: Linkage
    order: Order
    points: Collection[str]

    def chains(self) -> Iterator[Chain]:
        relative = tuple(self._relative())
        absolute = {chain.end for chain in relative if [side.sort for side in chain.sides] == ["absolute"]}
        for name in dict.fromkeys(name for chain in relative for name in (chain.start, chain.end)):
            if name is not None and name not in absolute and not self.linkage.joint(name).fixed:
                yield Chain(None, name, self._laid(0j, name, [("absolute", self._image(name))]))
        yield from relative

    def _relative(self) -> Iterator[Chain]:
        """Yield the chains of bars, of points of bodies from which others are found, and of what slides."""
        needed = {need for joint in self.linkage.joints for need in joint.needs} | {*self.points}
        for joint in self.linkage.joints:
            starts = [start for start, _ in joint.bars]
            if isinstance(joint, Rigid) and joint.name in needed:
                starts = [joint.on[0]]
            yield from (self._turned(start, joint.name) for start in starts)
            yield from (self._slid(slide) for slide in joint.slides)

    def _turned(self, start: str, end: str) -> Chain:
        """Return the chain along a bar; about a fixed pin its velocity is absolute."""
        fixed = self.linkage.joint(start).fixed
        steps = self._carried(self._arm(start, end), self._turning((start, end)))
        if fixed and self.order == 1:
            steps = [("absolute", steps[0][1])]
        label = end if fixed else f"{end}{start}"
        return Chain(None if fixed else start, end, self._laid(self._image(start), label, steps))

    def _slid(self, slide: Slide) -> Chain:
        """Return the chain of a sliding joint: with the guide's point under it, then along the guide."""
        point, start = slide.point, slide.start
        if start is None:
            return Chain(None, point, self._laid(0j, point, [("absolute", self._image(point))]))
        arm, under = self._arm(start, point), f"{point}′"
        turning = self._turning(slide.axis) if slide.axis else _STILL
        fixed = self.linkage.joint(start).fixed
        guide = self._carried(arm, turning) if slide.axis else []
        sides = self._laid(self._image(start), under if fixed else f"{under}{start}", guide)
        begin = sides[-1].end if sides else self._image(start)
        slid = self._laid(begin, point, self._along(slide, arm, turning))
        return Chain(None if fixed else start, point, (*sides, *slid))

    def _carried(self, arm: Any, turning: _Turning) -> list[_Step]:
        """Return the relative vectors between two points of a body."""
        turn, growth = turning
        if self.order == 1:
            return [("relative", 1j * turn * arm)]
        return [("normal", -turn * turn * arm), ("tangential", 1j * growth * arm)]

    def _along(self, slide: Slide, arm: Any, turning: _Turning) -> list[_Step]:
        """Return the relative vectors of what slides against its guide."""
        assert slide.start is not None
        turn, turn_growth = turning
        u = complex(*unit(slide.angle)) * (self._direction(*slide.axis) if slide.axis else 1.0)
        seen = self._apart(slide.start, slide.point, 1) - 1j * turn * arm
        rate = (u.conjugate() * seen).real
        if self.order == 1:
            return [("sliding", rate * u)]
        across = 2j * turn * rate * u
        guided = (1j * turn_growth - turn * turn) * arm + across
        growth = (u.conjugate() * (self._apart(slide.start, slide.point, 2) - guided)).real
        return [*([("coriolis", across)] if slide.axis else []), ("sliding", growth * u)]  # type: ignore[list-item]

    def _turning(self, axis: tuple[str, str]) -> _Turning:
        """Return how a body turns, from the motion of two of its joints."""
        inverse = over(1.0, self._arm(*axis))
        rate = (inverse * self._apart(*axis, 1)).imag
        second = (inverse * self._apart(*axis, 2)).imag if self.order == 2 else 0.0
        return rate, second

    def _laid(self, begin: Any, label: str, steps: Iterable[_Step]) -> tuple[Side, ...]:
        """Return vectors put end to end."""
        sides, letter = [], "v" if self.order == 1 else "a"
        for sort, vector in steps:
            sides.append(Side(indexed(letter + _MARKS.get(sort, ""), label), sort, begin, begin + vector))
            begin = begin + vector
        return tuple(sides)

    def _direction(self, start: str, end: str) -> Any:
        arm = self._arm(start, end)
        return arm / abs(arm)

    def _arm(self, start: str, end: str) -> Any:
        places = near(self.motion.position)
        return as_complex(places[end]) - as_complex(places[start])

    def _apart(self, start: str, end: str, order: Order) -> Any:
        return image(self.motion, end, order) - image(self.motion, start, order)

    def _image(self, joint: str) -> Any:
        return image(self.motion, joint, self.order)
