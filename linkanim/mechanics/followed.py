"""Close links that are solved together: what they do is followed once, and read from there.

The solver itself closes dyads, and reactions hold them; of a group both ask for its path, its places and what
its links carry, and know no more of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.arithmetic import MovingPoint, Slope, Vec
from linkanim.mechanics.groups import GroupSlide, LinkGroup
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.measures import Vector, between, cross, line_direction, over, size
from linkanim.mechanics.reactions import ForceBalance, Member, member_with, minus, times, turned_left
from linkanim.mechanics.solver.closing import Walk, vector_of
from linkanim.mechanics.solver.courses import GroupMotion, followed_course, reader
from linkanim.mechanics.solver.input import InputPath
from linkanim.mechanics.tolerances import NO_LEVER


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
        # what slides on several lines travels along the first one, as `Linkage.slides` has it
        for slide in sorted(self.own_slides, key=lambda one: self.line(one) is None):
            walk.travels.setdefault(slide.point, read(slide.name))

    def hold(self, balance: ForceBalance) -> None:
        """Let its links hold each other, by all their balances at once."""
        links = {one.name: member_with(balance.linkage, self.joints_of(one.name)) for one in self.members}
        # of the links that meet in a point of the group, the first one has what the others leave
        rest = {
            name: next(links[link.name] for link in self.at_point(name) if link in self.free)
            for name in self.points
        }
        moving = [*self.free]
        unknown = list(_constraints(self, links, rest, balance))
        rows = 3 * len(moving)
        assert len(unknown) == rows
        shape, size_of = np.shape(balance.motion.phase), balance.linkage.longest
        matrix, right = np.zeros((*shape, rows, rows)), np.zeros((*shape, rows))
        for n, link in enumerate(moving):
            member, about = links[link.name], balance.place(link.points[0])
            x, y = balance.total(member)
            moment = balance.moment(member, about)
            for name in (name for name, first in rest.items() if first == member):
                pull = balance.pins[name]
                x, y = x + pull[0], y + pull[1]
                moment = moment + cross(minus(balance.place(name), about), pull)
            for row, part in enumerate((x, y, moment / size_of)):
                right[..., 3 * n + row] = part
            for column, one in enumerate(unknown):
                for place, (u, v) in ((place, force) for on, place, force in one.forces if on == member):
                    turning = cross(minus(place, about), (u, v)) / size_of
                    for row, part in enumerate((u, v, turning)):
                        matrix[..., 3 * n + row, column] += part
                for share in (share for on, share in one.couples if on == member):
                    matrix[..., 3 * n + 2, column] += share
        with np.errstate(all="ignore"):
            lost = ~(np.linalg.cond(np.where(np.isfinite(matrix), matrix, 0.0)) < 1.0 / NO_LEVER)
        even = np.where(lost[..., None, None], np.eye(rows), matrix)
        solution = np.linalg.solve(even, -right[..., None])[..., 0]
        solution = np.where(lost[..., None], np.nan, solution)
        for column, one in enumerate(unknown):
            one.tell(solution[..., column][()])
        for name, member in rest.items():
            balance.meet(name, member, balance.pins[name])


class _Unknown(NamedTuple):
    """An unknown of a group: the forces and couples on bodies of one unit of it, and what it is told to."""

    forces: tuple[tuple[Member, Vector, Vector], ...]
    couples: tuple[tuple[Member, float], ...]
    tell: Callable[[Any], None]


def _constraints(
    group: LinkGroup, links: Mapping[str, Member], rest: Mapping[str, Member], balance: ForceBalance
) -> Iterator[_Unknown]:
    """Yield what holds the links of a group: pins, lines, gears, and a motor between two of them."""
    points = dict.fromkeys(name for link in group.free for name in link.points)
    for name in points:
        place = balance.place(name)
        own = [links[link.name] for link in group.free if name in link.points]
        for member in own[1:] if name in rest else own:
            for axis in ((1.0, 0.0), (0.0, 1.0)):
                yield _at_pin(name, place, member, axis, rest, balance)
    for slide in group.own_slides:
        along, place = _slid_along(slide, group, balance), balance.place(slide.point)
        normal, block, carrier = turned_left(along), links[slide.link], links[slide.on]
        if slide.name == group.driven:
            yield _thrust(block, carrier, place, along, balance)
        if slide.turns:
            yield _at_pin(slide.point, place, carrier, normal, rest, balance)
            continue
        push, turn = _guiding(slide.point, block, carrier, place, normal, balance)
        yield push
        yield turn
    for gear in (gear for gear in group.own_gears if not gear.motor):
        (one, other), carrier, ratio = (
            (links[name] for name in gear.links),
            links[gear.carrier],
            float(gear.ratio),
        )
        yield _couple(((other, 1.0), (one, -ratio), (carrier, ratio - 1.0)), gear.name, balance)
    if group.motor:
        one, other = (links[name] for name in group.motor.links)
        yield _couple(((other, 1.0), (one, -1.0)), "", balance)


def _slid_along(slide: GroupSlide, group: LinkGroup, balance: ForceBalance) -> Vector:
    """Return the direction along which something slides in a group, of length 1."""
    if ends := group.between(slide):
        x, y = between(balance.motion.position, ends)
        length = size((x, y))
        return over(x, length), over(y, length)
    line = group.line(slide)
    assert line is not None
    return line_direction(balance.motion, line)


def _at_pin(
    name: str, place: Vector, member: Member, axis: Vector, rest: Mapping[str, Member], balance: ForceBalance
) -> _Unknown:
    """Return the force of a pin on a body along an axis, for which the body that has the rest pays."""

    def tell(forces: Any) -> None:
        balance.meet(name, member, times(axis, forces))

    back = ((rest[name], place, times(axis, -1.0)),) if name in rest else ()
    return _Unknown(((member, place, axis), *back), (), tell)


def _guiding(
    name: str, block: Member, carrier: Member, place: Vector, normal: Vector, balance: ForceBalance
) -> tuple[_Unknown, _Unknown]:
    """Return the force of a guide on a block, and its moment."""
    size_of, back = balance.linkage.longest, times(normal, -1.0)
    balance.guides[name] = 0.0, 0.0

    def push(forces: Any) -> None:
        balance.guides[name] = forces, balance.guides[name][1]
        balance.apply(block, place, times(normal, forces))
        balance.apply(carrier, place, times(back, forces))

    def turn(forces: Any) -> None:
        moment = forces * size_of
        balance.guides[name] = balance.guides[name][0], moment
        balance.couples[block] = balance.couples[block] + moment
        balance.couples[carrier] = balance.couples[carrier] - moment

    return (
        _Unknown(((block, place, normal), (carrier, place, back)), (), push),
        _Unknown((), ((block, 1.0), (carrier, -1.0)), turn),
    )


def _thrust(block: Member, carrier: Member, place: Vector, along: Vector, balance: ForceBalance) -> _Unknown:
    """Return the force of what drives a block along its line."""
    back = times(along, -1.0)

    def tell(found: Any) -> None:
        balance.effort = found
        balance.apply(block, place, times(along, found))
        balance.apply(carrier, place, times(back, found))

    return _Unknown(((block, place, along), (carrier, place, back)), (), tell)


def _couple(shares: tuple[tuple[Member, float], ...], gear: str, balance: ForceBalance) -> _Unknown:
    """Return the moment of a pair of gears, or of the motor where none is named."""
    size_of = balance.linkage.longest

    def tell(forces: Any) -> None:
        moment = forces * size_of
        if gear:
            balance.gears[gear] = None, None, moment
        else:
            balance.effort = moment
        for member, share in shares:
            balance.couples[member] = balance.couples[member] + share * moment

    return _Unknown((), shares, tell)
