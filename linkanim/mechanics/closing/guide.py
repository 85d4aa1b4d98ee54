"""Lines of travel: fixed ones, and those that a body carries along.

Seen from its line a point lies f forward of the line's base and e to its left. Where the line turns at Ω
with its body, u along it and w from its base to the point,

    f = u·w      f' = Ω (u×w) + u·w'
    e = u×w      e' = -Ω (u·w) + u×w'

and what travels at s along the line has the guide's motion, s' along it, and Coriolis' 2Ω s' across it
(Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, on points moving in moving frames).
"""

from __future__ import annotations

from dataclasses import dataclass

from linkanim.mechanics.closing.walk import Walk
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope, Vec, carried
from linkanim.mechanics.formulas.precise import direction
from linkanim.mechanics.linkage.joint import Line


@dataclass(frozen=True, slots=True)
class Guide:
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


def guide(line: Line, walk: Walk) -> Guide:
    """Return where a line of travel lies at the walk's instant, and how it moves."""
    along = Vec(*direction(line.angle))
    if line.on is None:
        return Guide(walk.points[line.through], along, Slope(0.0), line.offset)
    axis, turning = walk.axis(line.on)
    return Guide(walk.points[line.through], axis.times(along), turning, line.offset)
