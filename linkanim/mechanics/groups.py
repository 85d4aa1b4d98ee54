"""Say what a group beyond dyads is, as data: links that can only be solved together.

A group is what no chain of dyads finds: triads, double butterflies, blocks with two pins, slots on moving
links, gears between moving links. It is given in one pose, which says its lengths and how it is put together.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from cmath import phase
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Joint, Line, Linkage, Point, RigidBody, Slide, Stated
from linkanim.mechanics.tolerances import ONE_POINT

GROUND = "ground"


@frozen
class GroupLink(Stated):
    """A link of a group: its points, and where they are in the pose.

    Of a link with two points the `length` is their distance, where that was stated.
    """

    name: str
    points: tuple[str, ...]
    places: tuple[Point, ...]
    length: float = 0.0

    sized: ClassVar[tuple[str, ...]] = ("places", "length")

    def place(self, point: str) -> complex:
        """Return where a point of the link is in the pose."""
        return complex(*self.places[self.points.index(point)])


class GroupSlide(NamedTuple):
    """A point of a link that slides along a line of the link `on`; `angle` is the line's in the pose (rad).

    Its travel is counted from the point `start` of `on`. The link itself `turns` on the other, as a pin in a
    slot does; or it does not, as a block.
    """

    name: str
    link: str
    point: str
    on: str
    start: str
    angle: float
    turns: bool


class GroupGear(NamedTuple):
    """Two links, the second of which turns `ratio` times as far as the first, as their carrier sees it.

    It may be that a `motor` of its own turns it so.
    """

    name: str
    links: tuple[str, str]
    carrier: str
    ratio: Fraction
    motor: bool = False


class GroupMotor(NamedTuple):
    """A motor between two links that both move: where it is, and a point of each beside it.

    The input's angle is that of the second one's way from the pivot, from the first one's.
    """

    pivot: str
    links: tuple[str, str]
    arms: tuple[str, str]


@frozen
class LinkGroup(Stated, ABC):
    """Links that are solved together, the ground and the driven crank among them, in one pose.

    `at` is the input's angle in the pose (rad), `crank` the crank's link: "" where a `motor` drives that is
    between two links of the group, or the slide named `driven`, whose travel is the input. `points` are
    those that the group places, in the order of the linkage's joints. It is held by the links `before` it,
    which dyads place.
    """

    at: float
    crank: str
    members: tuple[GroupLink, ...]
    points: tuple[str, ...]
    slides: tuple[GroupSlide, ...] = ()
    gears: tuple[GroupGear, ...] = ()
    motor: GroupMotor | None = None
    driven: str = ""
    before: tuple[str, ...] = ()

    sized: ClassVar[tuple[str, ...]] = ("members",)

    @cached_property
    def by_name(self) -> dict[str, GroupLink]:
        """Map each link's name to the link."""
        return {member.name: member for member in self.members}

    @property
    def free(self) -> Iterator[GroupLink]:
        """The links whose motion the group gives."""
        return (one for one in self.members if one.name not in (GROUND, self.crank, *self.before))

    @property
    def moving(self) -> list[GroupLink]:
        """All moving links but the crank, those before the group first."""
        return [*(self.by_name[name] for name in self.before), *self.free]

    @cached_property
    def own_slides(self) -> tuple[GroupSlide, ...]:
        """The slides of its own links."""
        own = {one.name for one in self.free}
        return tuple(slide for slide in self.slides if own & {slide.link, slide.on})

    @cached_property
    def own_gears(self) -> tuple[GroupGear, ...]:
        """The gears of its own links."""
        own = {one.name for one in self.free}
        return tuple(gear for gear in self.gears if own & {*gear.links, gear.carrier})

    @property
    def driven_slide(self) -> GroupSlide | None:
        """The slide that drives; None where none does."""
        return next((slide for slide in self.slides if slide.name == self.driven), None)

    @abstractmethod
    def followed(self, linkage: Linkage, unscale: float) -> tuple[Any, Any]:
        """Return the path of a linkage's input, and the group's motion on it; AssemblyError without one.

        Times `unscale` lengths are in the scene's unit.
        """

    @abstractmethod
    def place(self, walk: Any) -> None:
        """Add its points and its links to a walk over the linkage."""

    @abstractmethod
    def hold(self, balance: Any) -> None:
        """Let its links hold each other, where the forces are known that act on them from outside."""

    def between(self, slide: GroupSlide) -> tuple[str, str] | None:
        """Return the ends of a cylinder: of a slide whose line, on a link of one point, runs through that."""
        carrier = self.by_name[slide.on]
        if slide.on == GROUND or len(carrier.points) > 1:
            return None
        way = self.by_name[slide.link].place(slide.point) - carrier.place(carrier.points[0])
        along = way * direction_of(-slide.angle)
        return (carrier.points[0], slide.point) if abs(along.imag) <= ONE_POINT * along.real else None

    def line(self, slide: GroupSlide) -> Line | None:
        """Return the line of a slide; None on a link that has no two points, and so no axis.

        It runs through the point from which the travel is counted.
        """
        carrier, place = self.by_name[slide.on], self.by_name[slide.link].place(slide.point)
        first, others = slide.start, [name for name in carrier.points if name != slide.start]
        start = carrier.place(first)
        offset = ((place - start) * direction_of(-slide.angle)).imag
        if slide.on == GROUND:
            return Line(first, slide.angle, offset)
        if not others:
            return None
        # of a linkage without its lengths all points are one
        second = next((name for name in others if carrier.place(name) != start), others[0])
        turned = math.remainder(slide.angle - phase(carrier.place(second) - start), math.tau)
        return Line(first, turned, offset, (first, second))

    def way(self, slide: GroupSlide) -> Line | None:
        """Return the line of a slide, of a cylinder that from end to end; None where points show none."""
        ends = self.between(slide)
        return Line(ends[0], on=ends) if ends else self.line(slide)

    def joints_of(self, link: str) -> tuple[str, ...]:
        """Return the points of a link; none of the ground."""
        return () if link == GROUND else self.by_name[link].points

    def at_point(self, point: str) -> list[GroupLink]:
        """Return the links that a point is on."""
        return [member for member in self.members if point in member.points]


@frozen
class GroupPoint(Joint):
    """A joint that a group places, with all others of the group at once."""

    group: LinkGroup

    sized: ClassVar[tuple[str, ...]] = ("group",)
    grouped: ClassVar[bool] = True

    @property
    def reacts(self) -> bool:
        """Whether every line of its group has an axis, and no block lies on two of them."""
        blocks = [slide.link for slide in self.group.own_slides if not slide.turns]
        return len({*blocks}) == len(blocks) and all(map(self.group.way, self.group.own_slides))

    @property
    def driven_slide(self) -> Slide | None:
        """How it slides where that is the input."""
        own = self.group.driven_slide
        line = self.group.way(own) if own and own.point == self.name else None
        return line.guiding(self.name) if line else None

    @property
    def driven_between(self) -> tuple[str, str] | None:
        """The ends of the cylinder that drives, of which it is the last."""
        own = self.group.driven_slide
        return self.group.between(own) if own and own.point == self.name else None

    @property
    def motor(self) -> tuple[str, str] | None:
        """The link that a motor at the joint turns, and the joint towards which its angle is 0."""
        own = self.group.motor
        return (own.links[1], own.arms[0]) if own and own.pivot == self.name else None

    @property
    def stated_lengths(self) -> tuple[float, ...]:
        """The lengths of its bars."""
        return tuple(length for _, length in self.bars)

    def seen_from(self, x: float, y: float) -> GroupPoint:
        """Return the joint with its group as it lies from a place."""
        members = (
            replace(one, places=tuple((place[0] - x, place[1] - y) for place in one.places))
            for one in self.group.members
        )
        return replace(self, group=replace(self.group, members=tuple(members)))

    @property
    def needs(self) -> tuple[str, ...]:
        """The joints before it on its links; of the group's first one all that the group is held to."""
        starts = [start for start, _ in self.bars]
        if self.name == self.group.points[0]:
            lines = (self.group.line(slide) for slide in self.group.own_slides)
            held = [*(name for one in self.group.free for name in one.points)]
            held += [name for line in lines if line for name in line.needs]
            starts += [name for name in held if name not in self.group.points]
        return tuple(dict.fromkeys(starts))

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """On each of its links the bar from the joint before it, and how long it is."""
        own = self.group.at_point(self.name)
        pairs = [(member, start) for member in own if (start := self._before(member))]
        return tuple((start, abs(one.place(start) - one.place(self.name))) for one, start in pairs)

    def _before(self, member: GroupLink) -> str:
        """Return the last joint before this one on a link, in the order of the joints; "" for the first."""
        points = self.group.points
        known = [name for name in member.points if name not in points]
        later = points[: points.index(self.name)]
        return next((name for name in reversed(later) if name in member.points), known[0] if known else "")

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """Each link of which it is the last joint."""
        points, name = self.group.points, self.name
        later = points[points.index(name) + 1 :]
        own = (member for member in self.group.at_point(name) if member.name != GROUND)
        return tuple(one.points for one in own if len(one.points) > 1 and not {*later} & {*one.points})

    @property
    def pins(self) -> tuple[str, ...]:
        """Itself where links meet in it, and the joints that its bars come from."""
        own = (self.name,) if len(self.group.at_point(self.name)) > 1 else ()
        return (*(start for start, _ in self.bars), *own)

    @property
    def slides(self) -> tuple[Slide, ...]:
        """Itself, along each line of a link on which it slides."""
        return self._along(slide for slide in self.group.own_slides if slide.point == self.name)

    def _along(self, slides: Iterable[GroupSlide]) -> tuple[Slide, ...]:
        lines = map(self.group.line, slides)
        return tuple(line.guiding(self.name) for line in lines if line)

    @property
    def slotted(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The points in slots, which come with the group's first point."""
        slots = self.group.own_slides if self.name == self.group.points[0] else ()
        return tuple((one.point, self.group.joints_of(one.on)) for one in slots if one.turns)

    @property
    def made(self) -> tuple[tuple[str, ...], Mapping[str, str]]:
        """What the group's links are called, which come with its first point; blocks by their only point."""
        own = list(self.group.free) if self.name == self.group.points[0] else []
        bars = tuple(link.name for link in own if link.points[1:])
        return bars, {link.points[0]: link.name for link in own if not link.points[1:]}

    @property
    def at_limit(self) -> str:
        """The links of its group are stretched out, or folded."""
        names = [member.name for member in self.group.free]
        return f"the links {', '.join(names[:-1])} and {names[-1]} can go no further together"

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the rigid bodies with all of the group's links, which come with its first point."""
        if self.name != self.group.points[0]:
            return bodies
        return (*bodies, *(frame_of(one) for one in self.group.free if len(one.points) > 1))


@frozen
class GroupSlider(GroupPoint):
    """A point of a group's block, which slides along a line without turning on what carries that."""

    travels: ClassVar[bool] = True

    @property
    def line(self) -> Line:
        """The line of travel."""
        return self.slides[0].line

    @property
    def block(self) -> tuple[str, ...]:
        """The points of the block, which may have further ones."""
        own = next(one for one in self.group.slides if one.point == self.name and not one.turns)
        return self.group.joints_of(own.link)

    @property
    def guided(self) -> tuple[Slide, ...]:
        """The slides on whose guides the block does not turn."""
        own = (slide for slide in self.group.own_slides if slide.point == self.name)
        return self._along(slide for slide in own if not slide.turns)


def frame_of(member: GroupLink) -> RigidBody:
    """Return where a link's joints lie in its own frame, x along its first two joints."""
    first = complex(*member.places[0])
    ways = [complex(*place) - first for place in member.places]
    apart = next((way for way in ways if way), 1 + 0j)
    along = apart / abs(apart)
    return {name: way / along for name, way in zip(member.points, ways, strict=True)}


def group_of(linkage: Linkage) -> LinkGroup | None:
    """Return the group that a linkage has beyond its dyads; None where it has none."""
    return next((joint.group for joint in linkage.joints if isinstance(joint, GroupPoint)), None)


def direction_of(angle: float) -> complex:
    """Return the unit vector of an angle."""
    return complex(math.cos(angle), math.sin(angle))
