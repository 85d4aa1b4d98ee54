"""Close links that are solved together: what they do is followed once, and read from there.

The solver itself closes dyads; it asks a group for its path and its places, and knows no more of it.
"""

from __future__ import annotations

from linkanim.frozen import frozen
from linkanim.mechanics.arithmetic import MovingPoint, Slope, Vec
from linkanim.mechanics.groups import LinkGroup
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.solver.closing import Walk, vector_of
from linkanim.mechanics.solver.courses import GroupMotion, followed_course, reader
from linkanim.mechanics.solver.input import InputPath


@frozen
class FollowedGroup(LinkGroup):
    """A group that is followed from its pose all the way round."""

    def followed(self, linkage: Linkage, unscale: float) -> tuple[InputPath, GroupMotion]:
        """Return the path of a linkage's input, and the group's motion on it."""
        return followed_course(linkage, unscale)

    def place(self, walk: Walk) -> None:
        """Add its points and its links to a walk, by the polynomials of its course."""
        course = walk.assembly.course
        assert course is not None
        read = reader(course, walk.state, walk.assembly.path, walk.linkage.drive.start)
        placed = {name.rpartition(".")[0] for name in course.coefficients if name.endswith(".x")}
        for name in self.points:
            if name in placed:
                x, y = (read(f"{name}.{part}") for part in "xy")
                walk.points[name] = vector_of(x, y)
        for name, ((first, second), share) in course.derived.items():
            start, way = walk.points[first], walk.points[second] - walk.points[first]
            by = Vec(share.real, share.imag)
            walk.points[name] = start + MovingPoint(*(part.times(by) for part in way))
        for member in self.free:
            if len(member.points) > 1:
                first, *others = member.points
                apart = {name: abs(member.place(name) - member.place(first)) for name in others}
                second = max(apart, key=lambda name: round(apart[name] / max(apart.values()), 6))
                way = walk.points[second] - walk.points[first]
                square = apart[second] ** 2
                turn = way.position.cross(way.velocity) / square
                bent = way.position.cross(way.acceleration) / square
                walk.add_body(Slope(turn, bent), (first, second), way.position)
        for slide in self.own_slides:
            walk.travels[slide.point] = read(slide.name)
