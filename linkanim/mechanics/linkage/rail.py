"""Lines of travel: fixed ones, and those that a body carries along.

Seen from its line a point lies f forward of the line's base and e to its left. Where the line turns at Ω
with its body, u along it and w from its base to the point,

    f = u·w      f' = Ω (u×w) + u·w'
    e = u×w      e' = -Ω (u·w) + u×w'

and what travels at s along the line has the guide's motion, s' along it, and Coriolis' 2Ω s' across it
(Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, on points moving in moving frames).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope, Vec, carried
from linkanim.mechanics.linkage.joint import Need, Slide

if TYPE_CHECKING:
    from linkanim.mechanics.closing.walk import Walk


@dataclass(frozen=True, slots=True)
class Line:
    """A line of travel: through the joint `through`, at `angle`, shifted by `offset` to its left.

    A fixed line runs through a fixed pin, its angle is absolute. One that is carried names two joints of
    the body that carries it, `on`; `through` is a joint of that body, and the angle is from on[0] -> on[1].
    """

    through: str
    angle: float = 0.0
    offset: float = 0.0
    on: tuple[str, str] | None = None

    def needs(self, key: str) -> tuple[Need, ...]:
        """Return the joints that the line is known by, `key` being its own in a scene file."""
        through = Need(f"{key}.through", self.through, "" if self.on else "fixed")
        return (through, *(Need(f"{key}.on", name) for name in self.on or ()))

    @property
    def body(self) -> tuple[str, ...]:
        """The joints that must be on one body: those of the axis, and the one it runs through."""
        return tuple(dict.fromkeys((*self.on, self.through))) if self.on else ()

    def guiding(self, joint: str) -> Slide:
        """Return how a joint slides along the line."""
        return Slide(joint, self.on[0] if self.on else None, self.on, self.angle)

    def scaled(self, factor: float) -> Line:
        """Return the line with its offset times a factor."""
        return replace(self, offset=self.offset * factor)

    def laid(self, walk: Walk) -> Rail:
        """Return where the line lies at the walk's instant, and how it moves."""
        along = Vec(*unit(self.angle))
        if self.on is None:
            return Rail(walk.points[self.through], along, Slope(0.0), self.offset)
        axis, turning = walk.axis(self.on)
        return Rail(walk.points[self.through], axis.times(along), turning, self.offset)


@dataclass(frozen=True, slots=True)
class Rail:
    """A line of travel at one instant: its base point, its direction, and how it turns."""

    base: MovingPoint
    along: Vec
    turning: Slope
    offset: float

    def forward(self, point: MovingPoint) -> Moving:
        """Return how far a point lies forward of the base, with its rates as seen from the line."""
        return self._seen(point)[0]

    def aside(self, point: MovingPoint) -> Moving:
        """Return how far a point lies to the left of the line, with its rates as seen from the line."""
        left = self._seen(point)[1]
        return Moving(left.value - self.offset, left.rate, left.second)

    def _seen(self, point: MovingPoint) -> tuple[Moving, Moving]:
        """Return how far a point lies forward of the base, and to its left."""
        u, omega, alpha = self.along, self.turning.value, self.turning.rate
        w, w1, w2 = (
            point.position - self.base.position,
            point.velocity - self.base.velocity,
            point.acceleration - self.base.acceleration,
        )
        f, e = u.dot(w), u.cross(w)
        f1, e1 = u.dot(w1) + e * omega, u.cross(w1) - f * omega
        f2 = u.dot(w2) + (u.cross(w1) + e1) * omega + e * alpha
        e2 = u.cross(w2) - (u.dot(w1) + f1) * omega - f * alpha
        return Moving(f, f1, f2), Moving(e, e1, e2)

    def place(self, travel: Moving) -> MovingPoint:
        """Return the point that has travelled so far along the line from its base."""
        u, n = self.along, self.along.left()
        guided = self.base + carried(u.scaled(travel.value) + n.scaled(self.offset), self.turning)
        across = self.turning.value * travel.rate * 2.0
        return guided + MovingPoint(
            Vec(0.0, 0.0), u.scaled(travel.rate), u.scaled(travel.second) + n.scaled(across)
        )
