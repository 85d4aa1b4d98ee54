"""Make the joints of a scene file from points in one pose and the links through them.

Its parts, in reading order:

- What a file's tables say of the pose: where its points are, which links join them, what slides.
- Stated lengths: the pose is moved to the nearest one that has them.
- Mobility: how many motors the links need.
- The chain of dyads that follows from the drive, each as the table of a joint.
- The document with [joints] that says the same.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import combinations
from typing import Any, NamedTuple

from linkanim.intake import few, meant
from linkanim.mechanics.followed import FollowedGroup
from linkanim.mechanics.groups import (
    GroupGear,
    GroupLink,
    GroupMotor,
    GroupPoint,
    GroupSlide,
    GroupSlider,
)
from linkanim.mechanics.linkage import RRP, RRR, Drive, Linkage, Pin, Travel
from linkanim.scenes.file_form import (
    GROUND,
    MOTOR_OF_POINTS,
    POINTS_FORM,
    POSE_KEYS,
    SECTIONS,
    motor_ratio,
)
from linkanim.scenes.form import SHORTEST, Table, on_circle
from linkanim.units import angle, shown

# What a file's tables say of the pose: where its points are, which links join them, what slides.

Document = Mapping[str, Any]
_NEAR = 1e-12
"""The share of a distance that counts as rounding."""
_BEYOND = 1.5
"""The length of a slot whose end is no point, in distances of its pin from the pivot."""
_FLAT = 1e-9
"""The sine below which a pose does not show on which side of a line a joint lies."""


class PosedSlide(NamedTuple):
    """A prismatic joint: what slides, a link or a point, along a line of the link `on`.

    `angle` is the line's direction in the pose (rad).
    """

    name: str
    on: str
    angle: float
    link: str = ""
    point: str = ""

    def other(self, link: str) -> str:
        """Return the link that slides on a link; "" where there is none, or it is a point that slides."""
        return {self.on: self.link, self.link: self.on}.get(link, "") if self.link else ""


class GearPair(NamedTuple):
    """Two links, the second of which turns `ratio` times as far as the first, as their carrier sees it."""

    name: str
    links: tuple[str, str]
    ratio: Fraction
    carrier: str
    motor: str = ""
    """The speed, as it was written, of a motor that turns the second instead."""


class PosedLinks(NamedTuple):
    """Links in one pose: where their points are (x + yi), and what holds them to each other.

    `stated` are the distances of pairs of points that are given as such.
    """

    places: Mapping[str, complex]
    links: Mapping[str, tuple[str, ...]]
    slides: tuple[PosedSlide, ...]
    gears: tuple[GearPair, ...]
    stated: Mapping[frozenset[str], float]

    def length(self, one: str, other: str) -> float:
        """Return the distance of two points: as stated, else that of their places."""
        return self.stated.get(frozenset((one, other))) or abs(self.places[other] - self.places[one])

    def at(self, point: str) -> list[str]:
        """Return the links that a point is on."""
        return [name for name, points in self.links.items() if point in points]

    @property
    def size(self) -> float:
        """How far its points lie apart."""
        first = next(iter(self.places.values()))
        return max(abs(place - first) for place in self.places.values())


def posed(top: Table) -> PosedLinks | None:
    """Return what the tables of a file say of the pose; None where anything in them has a fault."""
    read = {key: top.attempt(SECTIONS[key].read, top) for key in POSE_KEYS}
    tables: dict[str, Any] = {key: table for key, table in read.items() if table is not None}
    if len(tables) < len(read) or any(None in tables[key].values() for key in POSE_KEYS if key != "lengths"):
        return None
    links: dict[str, tuple[str, ...]] = tables["links"]
    sliding = [top.attempt(_sliding, top, name, of, links) for name, of in tables["slides"].items()]
    gears = [top.attempt(_gear_pair, top, name, of, links) for name, of in tables["gears"].items()]
    places = top.attempt(_places, top, tables["points"])
    if None in sliding or None in gears or places is None:
        return None
    polar = {name: of for name, of in tables["points"].items() if "base" in of}
    stated = {frozenset((name, of["base"])): of["length"] for name, of in polar.items()}
    slides = tuple(one for one in sliding if one)
    pose = PosedLinks(places, links, slides, tuple(one for one in gears if one), stated)
    problems = len(top.context.problems)
    for check in (_check_links, _check_points, _check_shared):
        top.attempt(check, top, pose)
    if len(top.context.problems) > problems:
        return None
    return top.attempt(_with_lengths, top, pose, tables["lengths"]) if tables["lengths"] else pose


def _places(top: Table, points: Mapping[str, Any]) -> dict[str, complex]:
    """Return the points' places; refuse one that is measured from itself."""
    places = {name: complex(*place) for name, place in points.items() if isinstance(place, tuple)}
    waiting = {name: polar for name, polar in points.items() if name not in places}
    while waiting:
        ready = [name for name, polar in waiting.items() if polar.get("base") not in waiting]
        if not ready:
            name = next(iter(waiting))
            table = top.table("points").table(name)
            raise table.error("from", "is measured from this point itself; give one of them as [x, y]")
        for name in ready:
            polar = waiting.pop(name)
            base = places[polar["base"]] if "base" in polar else 0j
            places[name] = base + complex(*on_circle(polar["length"], polar["angle"]))
    return {name: places[name] for name in points}


def _link(table: Table, key: str, name: str, links: Mapping[str, Any]) -> str:
    if name not in links:
        known = f"{meant(name, links)}; there are {', '.join(links)}"
        raise table.error(key, f"no link is called {shown(name)}{known}")
    return name


def _sliding(top: Table, name: str, of: Document, links: Mapping[str, tuple[str, ...]]) -> PosedSlide:
    table = top.table("slides").table(name)
    on, link, point = _link(table, "on", of["on"], links), of.get("link", ""), of.get("point", "")
    if link and _link(table, "link", link, links) == on:
        raise table.error("on", "is the link itself; name the link that carries the line")
    if point in links[on]:
        raise table.error("point", f"is fixed on {on}, so it cannot slide there; leave it out of links.{on}")
    return PosedSlide(name, on, of["angle"], link, point)


def _gear_pair(top: Table, name: str, of: Document, links: Mapping[str, Any]) -> GearPair:
    table = top.table("gears").table(name)
    pair = tuple(of["links"])
    if len(pair) != 2 or pair[0] == pair[1]:
        raise table.error("links", 'must be two links, such as ["crank", "wheel"]')
    for link in pair:
        _link(table, "links", link, links)
    carrier = _link(table, "carrier", of["carrier"], links)
    if carrier in pair:
        raise table.error("carrier", "is one of the two; name the link that carries both")
    return GearPair(name, (pair[0], pair[1]), of["ratio"], carrier)


def _check_links(top: Table, pose: PosedLinks) -> None:
    """Refuse a linkage without ground, and links that are no bodies."""
    table = top.table("links")
    if not pose.links.get(GROUND):
        raise table.error(GROUND, 'names no point; list the points that stand still: ground = ["O2", "O4"]')
    if len(pose.links) < 2:
        raise table.wrong('has nothing but the ground; add what moves, such as crank = ["O2", "A"]')
    slides = {end for slide in pose.slides for end in (slide.on, slide.link)}
    for name, points in pose.links.items():
        if not points or (len(points) < 2 and name not in (GROUND, *slides)):
            raise table.error(name, "needs two points or more; a block with one pin, a slide: [slides.block]")
        places = [pose.places[point] for point in points]
        if len(points) > 1 and all(abs(place - places[0]) <= _NEAR * pose.size for place in places):
            raise table.error(name, f"{points[0]} and {points[1]} are one point; a link needs two places")


def _check_points(top: Table, pose: PosedLinks) -> None:
    """Refuse points that no link has."""
    for name in pose.places:
        if not pose.at(name):
            raise top.table("points").error(name, "is on no link; name it in one of [links], or leave it out")


def _check_shared(top: Table, pose: PosedLinks) -> None:
    """Refuse links with two points in common."""
    for (one, points), (other, others) in combinations(pose.links.items(), 2):
        shared = [point for point in points if point in others]
        if len(shared) > 1:
            both = f"{one} and {other} share {shared[0]} and {shared[1]}"
            raise top.table("links").wrong(f"{both}, so they are one body; make them one link")


# Stated lengths: the pose is moved to the nearest one that has them.

_ROUNDS = 60


def _with_lengths(top: Table, pose: PosedLinks, lengths: Mapping[str, Mapping[str, float]]) -> PosedLinks:
    """Return the pose that has the stated lengths, the nearest to the one that is written.

    Fixed points stay, and what is written by length and angle from one that stays; blocks stay on their
    guides.
    """
    table, stated, firm = top.table("lengths"), dict(pose.stated), {*pose.links[GROUND]}
    for name in pose.places:
        written = top.values["points"][name]
        if isinstance(written, Mapping) and written.get("from") in firm:
            firm.add(name)
    mobile = pose.places.keys() - firm
    for link, pairs in lengths.items():
        _link(top, "lengths", link, pose.links)
        for written, length in pairs.items():
            pair = _pair(table.table(link), written, pose.links[link])
            stated[frozenset(pair)] = length
            mobile |= set(pair) if link == GROUND else set()
    spans = [(sorted(pair), length) for pair, length in stated.items()]
    places = dict(pose.places)
    if all(abs(abs(places[q] - places[p]) - length) <= _NEAR * length for (p, q), length in spans):
        return pose._replace(stated=stated)
    # Here, so that reading a scene file loads no arrays.
    import numpy as np

    columns = {name: n for n, name in enumerate(sorted(mobile))}
    guided = [
        (point, rect(1.0, slide.angle + math.pi / 2))
        for slide in pose.slides
        if slide.on == GROUND
        for point in (pose.links[slide.link] if slide.link else (slide.point,))
        if point in columns
    ]
    for _ in range(_ROUNDS):
        matrix = np.zeros((len(spans) + len(guided), 2 * len(columns)))
        off = np.zeros(len(matrix))
        for row, (point, normal) in enumerate(guided, len(spans)):
            matrix[row, 2 * columns[point] : 2 * columns[point] + 2] = normal.real, normal.imag
        for row, ((p, q), length) in enumerate(spans):
            span = places[q] - places[p]
            off[row] = length - abs(span)
            for name, sense in ((p, -1.0), (q, 1.0)):
                if name in columns and span:
                    at = 2 * columns[name]
                    matrix[row, at : at + 2] = sense * span.real / abs(span), sense * span.imag / abs(span)
        step = np.linalg.lstsq(matrix, off, rcond=1e-9)[0]
        for name, n in columns.items():
            places[name] += complex(step[2 * n], step[2 * n + 1])
        if abs(off).max() <= _NEAR * pose.size:
            return pose._replace(places=places, stated=stated)
    raise table.wrong("no pose near the points has all these lengths; correct a point, or leave a length out")


def _pair(table: Table, written: str, points: tuple[str, ...]) -> tuple[str, str]:
    """Return the two points that "A-B" names, which must be on the link."""
    for at, sign in enumerate(written):
        pair = (written[:at].strip(), written[at + 1 :].strip())
        if sign in "-–" and pair[0] != pair[1] and {*pair} <= {*points}:
            return pair
    raise table.error(written, f'must be two points of the link, such as "{points[0]}-{points[-1]}"')


# Mobility: how many motors the links need.


def mobility(pose: PosedLinks) -> int:
    """Return the degrees of freedom: 3 of each moving link, less what pins, slides and gears take."""
    free = 3 * (len(pose.links) - 1) - len(pose.gears)
    free -= sum(2 * (len(pose.at(name)) - 1) for name in pose.places)
    return free - sum(2 if slide.link else 1 for slide in pose.slides)


def _refuse_mobility(top: Table, pose: PosedLinks) -> None:
    free = mobility(pose)
    table = top.table("links")
    if free > 1:
        loose = [name for name in pose.links if name != GROUND and _joints_of(pose, name) < 2]
        which = f"; {', '.join(loose[:3])} hangs by one joint only" if loose else ""
        more = "one more link" if free == 2 else f"{free - 1} more links"
        way_out = f"add {more} to hold it, or a gear pair"
        raise table.wrong(f"mobility {free}: one motor leaves it loose{which}; {way_out}")
    if free < 1:
        raise table.wrong(f"mobility {free}: nothing can move; leave out a link, or a point of one")


def _joints_of(pose: PosedLinks, link: str) -> int:
    """Return how many joints and gears hold a link."""
    pins = sum(len(pose.at(point)) > 1 for point in pose.links[link])
    slides = sum(link in (slide.on, slide.link) or slide.point in pose.links[link] for slide in pose.slides)
    return pins + slides + sum(link in gear.links for gear in pose.gears)


# The chain of dyads that follows from the drive, each as the table of a joint.


class _Geared(NamedTuple):
    """A link that turns `ratio` times as far as the input; `angle` (rad) is that of its `pin` in the pose."""

    pin: str
    angle: float
    ratio: Fraction


class _Dyads:
    """The joints found so far, each from those before it, and the links whose places follow from them."""

    def __init__(self, top: Table, pose: PosedLinks) -> None:
        self.top, self.pose = top, pose
        self.joints: dict[str, dict[str, Any]] = {}
        self.known = set(pose.links[GROUND])
        self.blocks: dict[str, str] = {}
        """The blocks that were placed, each with its pin."""
        self.turning: dict[str, _Geared] = {}
        self.motors: dict[str, dict[str, Any]] = {}
        """The further motors, each as its table."""

    def place(self, link: str) -> list[str]:
        """Return the points of a link that are known."""
        return [point for point in self.pose.links[link] if point in self.known]

    def axis(self, link: str) -> tuple[str, str] | None:
        """Return two known points of a link, apart from each other."""
        first, *others = self.place(link) or [""]
        small = _NEAR * self.pose.size
        for other in others:
            if abs(self.pose.places[other] - self.pose.places[first]) > small:
                return first, other
        return None

    def stands(self, link: str) -> bool:
        """Tell whether a link's place is known."""
        return link == GROUND or link in self.blocks or self.axis(link) is not None

    def add(self, point: str, table: dict[str, Any]) -> bool:
        """Add a joint."""
        self.joints[point] = table
        self.known.add(point)
        return True

    def grow(self) -> bool:
        """Add the next joint that follows from those that are known; return whether there was one."""
        return any(
            step(link)
            for step in (self.points_of, self._geared, self._bars, self._slots, self._yoke)
            for link in self.pose.links
        )

    def points_of(self, link: str) -> bool:
        """Add a further point of a link whose place is known."""
        axis = self.axis(link)
        for point in self.pose.links[link]:
            if axis and link != GROUND and point not in self.known:
                first, second = (self.pose.places[name] for name in axis)
                at = (self.pose.places[point] - first) * (abs(second - first) / (second - first))
                return self.add(point, {"on": [*axis], "at": [at.real, at.imag]})
        return False

    def _geared(self, link: str) -> bool:
        """Add the pin of a link that a gear turns about a known joint."""
        if link in self.turning or link == GROUND:
            return False
        for gear in self.pose.gears:
            by = _turn_by(gear, link, self.turning) if link in gear.links else None
            if by is None:
                continue
            mate, ratio = by
            pivot = next(iter(self.place(link)), "")
            pin = self.pin_of(link, pivot) if pivot else ""
            if pin and pin not in self.known:
                turn = phase(self.pose.places[pin] - self.pose.places[pivot])
                other = self.turning[mate]
                offset = math.remainder(turn - float(ratio) * other.angle, math.tau)
                self.turning[link] = _Geared(pin, turn, ratio * other.ratio)
                if gear.motor:
                    self.motors[gear.name] = {"joint": pin, "speed": gear.motor, "start": in_degrees(turn)}
                    return self.add(pin, {"crank": pivot, "length": self.pose.length(pivot, pin)})
                geared = {"with": other.pin, "ratio": _written(ratio), "offset": in_degrees(offset)}
                length = self.pose.length(pivot, pin)
                return self.add(pin, {"crank": pivot, "length": length, "gear": geared})
        return False

    def pin_of(self, link: str, pivot: str) -> str:
        """Return the point of a link that shows its turn about a pivot: the first one apart from it."""
        small, places = _NEAR * self.pose.size, self.pose.places
        apart = (name for name in self.pose.links[link] if abs(places[name] - places[pivot]) > small)
        return next(apart, "")

    def _pivots(self) -> Iterator[tuple[str, str]]:
        """Yield the links that turn about one known point, with that point."""
        for link in self.pose.links:
            if not self.stands(link) and link not in self.turning:
                yield from ((link, point) for point in self.place(link)[:1])

    def _bars(self, link: str) -> bool:
        """Add the joint in which a link about a known point meets another one, or a slider, or a guide."""
        for one, pivot in self._pivots():
            if one != link:
                continue
            for point in self.pose.links[one]:
                if point in self.known:
                    continue
                if self._with_bar(one, pivot, point) or self._with_line(pivot, point):
                    return True
        return False

    def _with_bar(self, link: str, pivot: str, point: str) -> bool:
        for other, end in self._pivots():
            if other != link and point in self.pose.links[other]:
                ends, places = (pivot, end), self.pose.places
                base, arm = places[end] - places[pivot], places[point] - places[pivot]
                left = (base.conjugate() * arm).imag
                self._refuse_flat(left, abs(base) * abs(arm), (*ends, point))
                lengths = [self.pose.length(joint, point) for joint in ends]
                return self.add(point, {"from": [*ends], "length": lengths, "side": RRR.sides[left < 0]})
        return False

    def _with_line(self, end: str, point: str) -> bool:
        """Add a point that a bar from a known joint holds on a line: itself, or the block that it is on."""
        for slide in self.pose.slides:
            ends = [name for name in (slide.link, slide.on) if name]
            block = next((name for name in ends if point in self.pose.links[name]), "")
            on = slide.on if slide.point == point else slide.other(block) if block else ""
            if not on or not self.stands(on):
                continue
            line = self.line(on, slide.angle, point)
            if line is None:
                continue
            ahead = ((self.pose.places[point] - self.pose.places[end]) * rect(1.0, -slide.angle)).real
            self._refuse_flat(ahead, self.pose.length(end, point), (end, point))
            if slide.link:
                self.blocks[block] = point
            bar = {"from": end, "length": self.pose.length(end, point)}
            return self.add(point, {**bar, "line": line, "side": RRP.sides[ahead < 0]})
        return False

    def _slots(self, link: str) -> bool:
        """Add the end of a link about a known point whose slot passes over another, or that slides in one."""
        for one, pivot in self._pivots():
            for slide in self.pose.slides if one == link else ():
                if slide.point in self.known and slide.on == one:
                    through = slide.point
                else:
                    other = slide.other(one)
                    through = next(iter(self.place(other)), "") if other and not self.stands(other) else ""
                if through and through != pivot and self._slotted(one, pivot, through, slide):
                    return True
        return False

    def _slotted(self, link: str, pivot: str, through: str, slide: PosedSlide) -> bool:
        places = self.pose.places
        along = (places[through] - places[pivot]) * rect(1.0, -slide.angle)
        self._refuse_flat(along.real, abs(along), (pivot, through))
        sense = math.copysign(1.0, along.real)
        slot = {"pivot": pivot, "through": through, **_offset(sense * along.imag, self.pose.size)}
        for point in self.pose.links[link]:
            at = (places[point] - places[pivot]) * rect(sense, -slide.angle)
            if point not in self.known and at.real > 0 and abs(at.imag) <= _NEAR * self.pose.size:
                return self.add(point, {"slot": slot, "length": self.pose.length(pivot, point)})
        # No point of the link is on the slot's line through the pivot: the slot's own end is one, which is
        # called as the link is, and so has no letter of its own.
        end = f"{link}'" if link in places else link
        length = max(
            _BEYOND * abs(along), *(abs(places[name] - places[pivot]) for name in self.pose.links[link])
        )
        direction = rect(sense * length, slide.angle)
        self.pose = self.pose._replace(
            places={**places, end: places[pivot] + direction},
            links={**self.pose.links, link: (*self.pose.links[link], end)},
        )
        return self.add(end, {"slot": slot, "length": length})

    def _yoke(self, link: str) -> bool:
        """Add the point at which the slot of a link that slides on a known one crosses its line."""
        for slot in self.pose.slides:
            if slot.on != link or slot.point not in self.known or self.stands(link):
                continue
            for guide in self.pose.slides:
                on = guide.other(link)
                if on and self.stands(on) and self._crossing(link, slot, guide, on):
                    return True
        return False

    def _crossing(self, link: str, slot: PosedSlide, guide: PosedSlide, on: str) -> bool:
        pin = self.pose.places[slot.point]
        for point in self.pose.links[link]:
            aside = ((self.pose.places[point] - pin) * rect(1.0, -slot.angle)).imag
            line = self.line(on, guide.angle, point)
            if abs(aside) <= _NEAR * self.pose.size and line is not None:
                self.blocks[link] = point
                turned = in_degrees(math.remainder(slot.angle - guide.angle, math.tau))
                return self.add(point, {"slide": {"pin": slot.point, "line": line, "slot": turned}})
        return False

    def line(self, on: str, angle: float, point: str) -> dict[str, Any] | None:
        """Return the line of a known link through a point; None on a block, which has no axis."""
        axis = None if on == GROUND else self.axis(on)
        if on != GROUND and axis is None:
            return None
        places = self.pose.places
        through = nearest(places, self.place(on), places[point], angle)
        aside = ((places[point] - places[through]) * rect(1.0, -angle)).imag
        base = phase(places[axis[1]] - places[axis[0]]) if axis else 0.0
        line: dict[str, Any] = {"on": [*axis]} if axis else {}
        turned = in_degrees(math.remainder(angle - base, math.tau) if axis else angle)
        return {**line, "through": through, "angle": turned, **_offset(aside, self.pose.size)}

    def _refuse_flat(self, part: float, size: float, joints: tuple[str, ...]) -> None:
        """Refuse a pose at the limit of a dyad, from which its closure cannot be read."""
        if abs(part) <= _FLAT * size:
            listed = f"{', '.join(joints[:-1])} and {joints[-1]}"
            raise self.top.table("points").wrong(
                f"{listed} stand at a limit in this pose, which does not show how they are put together; "
                "give the points in another pose"
            )


def nearest(places: Mapping[str, complex], names: Iterable[str], place: complex, angle: float) -> str:
    """Return the point that is nearest to a line: from it the travel along the line is counted."""
    size = max(abs(one - place) for one in places.values())
    aside = {name: ((place - places[name]) * rect(1.0, -angle)).imag for name in names}
    # rounding decides between none that are equally near
    return min(aside, key=lambda name: round(abs(aside[name]) / size, 9))


def _offset(offset: float, size: float) -> dict[str, float]:
    return {"offset": offset} if abs(offset) > _NEAR * size else {}


def _turn_by(gear: GearPair, link: str, turning: Mapping[str, _Geared]) -> tuple[str, Fraction] | None:
    """Return the link by which a gear turns another, and how far; None where that is not known yet."""
    first, second = gear.links
    other, ratio = (first, gear.ratio) if link == second else (second, 1 / gear.ratio)
    rest = [name for name in (other, gear.carrier) if name != GROUND]
    if not rest or any(name not in turning for name in rest):
        return None
    if gear.carrier == GROUND:
        return other, ratio
    # The carrier turns both: b - c = ratio (a - c).
    own = turning[gear.carrier].ratio
    turns = (ratio * turning[other].ratio if other != GROUND else 0) + (1 - ratio) * own
    return gear.carrier, turns / own


def in_degrees(angle: float) -> str:
    """Return an angle (rad) in the shortest degrees that have all its digits."""
    exact = math.degrees(angle)
    for digits in range(4, 18):
        text = f"{exact:.{digits}g}"
        if abs(math.radians(float(text)) - angle) <= 2.0**-52 * abs(angle):
            break
    return f"{float(text) + 0.0:.17g} deg" if digits == 17 else f"{text} deg"


def _written(ratio: Fraction) -> int | str:
    return ratio.numerator if ratio.denominator == 1 else str(ratio)


# The document with [joints] that says the same.


AsJoints = tuple[dict[str, Any], tuple[GroupPoint, ...]]
"""A document with [joints], and the joints of a group, which no table of a joint can say."""


def as_joints(top: Table, *, whole: bool = False) -> AsJoints | None:
    """Return the document of a file with [points] as one with [joints]; None where it has a fault.

    Dyads before and behind a group are closed as such; with `whole` they are solved together with it.
    """
    pose = posed(top)
    drive, further = (top.attempt(SECTIONS[key].read, top) for key in ("drive", "drives"))
    if pose is None or drive is None or further is None or None in further.values():
        return None
    return top.attempt(_as_joints, top, pose, drive, further, whole)


def _as_joints(
    top: Table, pose: PosedLinks, drive: Mapping[str, Any], further: Mapping[str, Any], whole: bool
) -> AsJoints:
    motors = _further_motors(top, pose, drive, further)
    pose = pose._replace(gears=(*pose.gears, *motors))
    _refuse_ends(top.table("drive"), pose, drive)
    _refuse_mobility(top, pose)
    chain = _Dyads(top, pose)
    if "cylinder" in drive and not _turns_crank(pose, drive):
        table = top.table("drive")
        for holder, key in ((table, "joint"), (table, "links"), (table.table("cylinder"), "joint")):
            if key in holder:
                raise holder.error(key, "is that of a crank, but the cylinder turns none; leave it out")
        return _by_length(top, *_with_cylinder(top, pose, drive["cylinder"]["between"]), whole=whole)
    if "slide" in drive and not (slide := _driving(top.table("drive"), pose, drive["slide"])).other(GROUND):
        return _by_length(top, pose, slide, whole=whole)
    if "slide" not in drive and (motor := _moving_motor(chain, drive)):
        driven = _by_moving_motor(chain, motor)
        chain, group = _group(lambda: _Dyads(top, pose), whole=whole, motor=motor)
        return _document(top, pose, chain, driven), group
    driven = _by_slide(chain, slide) if "slide" in drive else _by_motor(chain, drive)
    while chain.grow():
        pass
    group = ()
    if not {*pose.places} <= chain.known:
        if "slide" in drive:
            return _by_length(top, pose, slide, whole=whole)
        if "cylinder" in drive:
            return _by_length(top, *_with_cylinder(top, pose, drive["cylinder"]["between"]), whole=whole)

        def cranked() -> _Dyads:
            chain = _Dyads(top, pose)
            _by_motor(chain, drive)
            while chain.points_of(next(iter(chain.turning))):
                pass
            return chain

        chain, group = _group(cranked, whole=whole)
    if "slider" in driven:
        driven["slider"] = _travel(chain, driven["slider"])
    return _document(top, pose, chain, driven), group


def _refuse_ends(table: Table, pose: PosedLinks, drive: Mapping[str, Any]) -> None:
    """Refuse the ends of an input's length where nothing would move between them, or no slide drives."""
    if "slide" in drive:
        _driving(table, pose, drive["slide"])
    else:
        for key in ("from", "to"):
            if key in drive:
                way_out = "name one, as slide = ..., or write it in cylinder = { ... }"
                raise table.error(key, f"is an end of a driving slide, but no slide drives; {way_out}")
    own, ends = ("cylinder", drive["cylinder"]) if "cylinder" in drive else ("", drive)
    if {"from", "to"} <= ends.keys() and abs(ends["to"] - ends["from"]) < SHORTEST:
        place = "length" if own else "place"
        reason = f"is the same {place} as from, so nothing would move; write another one"
        raise (table.table(own) if own else table).error("to", reason)
    if own:
        first, second = ends["between"]
        shared = [name for name in pose.at(first) if name in pose.at(second)]
        if shared:
            reason = f"{first} and {second} are on one link, so nothing would move"
            raise table.table(own).error("between", f"{reason}; name points of two links")


def _further_motors(
    top: Table, pose: PosedLinks, drive: Mapping[str, Any], further: Mapping[str, Any]
) -> tuple[GearPair, ...]:
    """Return each further motor as what turns its link so many times as far as the first motor's."""
    if not further:
        return ()
    table, motors = top.table("drive"), list[GearPair]()
    if "slide" in drive or "cylinder" in drive:
        raise top.error("drives", "go with a first motor that turns; leave them out, or the slide")
    first = _driven_links(table, pose, _pivot_of(table, pose, drive), drive.get("links"))
    for name, motor in further.items():
        own = top.table("drives").table(name)
        links = _driven_links(own, pose, _pivot_of(own, pose, motor), motor.get("links"))
        if first[0] != GROUND or links[0] != GROUND or links[1] == first[1]:
            pins = (name for name in pose.links[GROUND] if {*pose.at(name)} - {GROUND, *first})
            reason = "is no fixed point about which another link than the first one's turns"
            raise own.error("joint", f"{reason}; there are {few(pins) or 'none'}")
        if "start" in motor:
            raise own.error("start", "is that of the pose; leave it out")
        ratio = motor_ratio(own, motor["speed"], drive["speed"])
        motors.append(GearPair(name, (first[1], links[1]), ratio, GROUND, str(own.values["speed"])))
    return tuple(motors)


def _group(
    begun: Callable[[], _Dyads], *, whole: bool, motor: GroupMotor | None = None, slide: str = ""
) -> tuple[_Dyads, tuple[GroupPoint, ...]]:
    """Return the dyads and the joints of the group between them, which a crank, a motor or a slide drives.

    `begun` returns what is known before any of them: the ground, and a driven crank.
    """
    chain = begun()
    parts = _Parts(chain, motor.links if motor else (), slide)
    known, own, head = {*chain.known}, parts.unknown(chain), set[str]()
    if not whole and (apart := _apart(begun, parts)):
        chain, known, own, head = apart
    pose = chain.pose
    if slide:
        crank, at = "", 0.0
    elif motor:
        crank, at = "", _angle_between(pose, motor)
    else:
        crank, geared = next(iter(chain.turning.items()))
        at = geared.angle
    members = tuple(
        GroupLink(
            name,
            points,
            tuple((pose.places[point].real, pose.places[point].imag) for point in points),
            pose.stated.get(frozenset(points), 0.0) if len(points) == 2 else 0.0,
        )
        for name, points in pose.links.items()
        if name in (GROUND, crank, *own, *head)
    )
    there = {one.name for one in members}
    sliding = (_group_slide(pose, slide) for slide in pose.slides)
    slides = tuple(slide for slide in sliding if {slide.link, slide.on} <= there)
    gears = tuple(
        GroupGear(gear.name, gear.links, gear.carrier, gear.ratio, bool(gear.motor))
        for gear in pose.gears
        if {*gear.links, gear.carrier} <= there
    )
    placed = {point for name in own for point in pose.links[name]} - known
    points = tuple(name for name in _connected(pose, known) if name in placed)
    before = tuple(name for name in pose.links if name in head and name != crank)
    group = FollowedGroup(at, crank, members, points, slides, gears, motor, slide, before)
    own_slides = group.own_slides
    blocks = {slide.point: slide.link for slide in own_slides if not slide.turns and group.line(slide)}
    chain.blocks |= {link: point for point, link in blocks.items()}
    return chain, tuple((GroupSlider if name in blocks else GroupPoint)(name, group) for name in points)


def _apart(begun: Callable[[], _Dyads], parts: _Parts) -> tuple[_Dyads, set[str], list[str], set[str]] | None:
    """Return the dyads around the links from the first smallest group to the last one, and these links.

    They are: the dyads, what is known before the group, its links, and those that it hangs on.
    """
    own: set[str] = set()
    while True:
        chain = begun()
        points, links = _grown(chain, parts)
        head, known = parts.standing(chain), {*chain.known}
        for name in own:
            on = chain.pose.links[name]
            chain.known |= {*on}
            chain.blocks |= {name: on[0]} if len(on) == 1 else {}
        while own and chain.grow():
            pass
        if {*parts.pose.places} <= chain.known:
            before, waiting = set[str](), parts.held_by(own, points) & head
            while waiting:
                before |= waiting
                waiting = {name for one in waiting for name in links.get(one, ())} - before
            for name in own:
                chain.blocks.pop(name, None)
            return chain, known, [name for name in parts.pose.links if name in own], before
        more = parts.smallest(chain)
        if not more:
            return None
        own |= (parts.standing(chain) - head if own else set()) | more


def _grown(chain: _Dyads, parts: _Parts) -> tuple[dict[str, set[str]], dict[str, set[str]]]:
    """Add all dyads that follow; return for each point, and for each link, the links that give its place."""
    standing = parts.standing(chain)
    points = {point: {name} for name in standing for point in parts.pose.links[name]}
    points |= {point: set() for point in parts.pose.links[GROUND]}
    links: dict[str, set[str]] = {}
    while chain.grow():
        new = parts.standing(chain) - standing
        links |= dict.fromkeys(new, new | parts.held_by(new, points) & standing)
        standing |= new
        for name in new or standing:
            for point in parts.pose.links[name]:
                points.setdefault(point, new or {name})
    return points, links


_MOST_APART = 14
"""The most links among which a smallest group is looked for."""


class _Parts:
    """The links of a pose by what holds them to each other, and a motor between two of them or on a slide."""

    def __init__(self, chain: _Dyads, motor: tuple[str, ...], slide: str) -> None:
        self.pose, pose = chain.pose, chain.pose
        # what takes so much freedom from links, once all its links are there
        self.held: list[tuple[set[str], int]] = [({*gear.links, gear.carrier}, 1) for gear in pose.gears]
        self.held += [({*motor}, 1)] if motor else []
        for one in pose.slides:
            ends = _group_slide(pose, one)
            self.held.append(({ends.link, ends.on}, (2 if one.link else 1) + (one.name == slide)))

    def standing(self, chain: _Dyads) -> set[str]:
        """Return the links whose places are known."""
        return {name for name in self.pose.links if chain.stands(name)}

    def unknown(self, chain: _Dyads) -> list[str]:
        """Return the links whose places are not known."""
        return [name for name in self.pose.links if not chain.stands(name)]

    def held_by(self, links: set[str], givers: Mapping[str, set[str]]) -> set[str]:
        """Return the moving links by which these are held, the crank among them."""
        points = (point for link in links for point in self.pose.links[link])
        found = {name for point in points for name in givers.get(point, ())}
        found |= {name for held, _ in self.held if held & links for name in held}
        return found - {GROUND}

    def smallest(self, chain: _Dyads) -> set[str]:
        """Return the fewest links that what is known holds, all together; empty where there are none."""
        unknown, known = self.unknown(chain), self.standing(chain)
        if len(unknown) > _MOST_APART:
            return set()
        for count in range(2, len(unknown) + 1):
            for links in map(set, combinations(unknown, count)):
                if self._freedom(links, known, chain.known) == 0:
                    return links
        return set()

    def _freedom(self, links: set[str], known: set[str], placed: set[str]) -> int:
        there, free = links | known, 3 * len(links)
        points: dict[str, int] = {}
        for link in links:
            for point in self.pose.links[link]:
                points[point] = points.get(point, 0) + 1
        free -= sum(2 * (count if point in placed else count - 1) for point, count in points.items())
        return free - sum(takes for held, takes in self.held if held & links and held <= there)


def _group_slide(pose: PosedLinks, slide: PosedSlide) -> GroupSlide:
    """Return a slide with the link and the point that it leads."""
    turns = not (slide.link and pose.links[slide.link])
    point = slide.point if turns else pose.links[slide.link][0]
    own = next(name for name in pose.at(point) if name != slide.on) if turns else slide.link
    start = pose.links[slide.on][0]
    if slide.on == GROUND:
        start = nearest(pose.places, pose.links[GROUND], pose.places[point], slide.angle)
    return GroupSlide(slide.name, own, point, slide.on, start, slide.angle, turns)


def _connected(pose: PosedLinks, known: set[str]) -> list[str]:
    """Return the points, each link's one after the other, from those that are known outwards."""
    reached = dict.fromkeys(name for name in pose.places if name in known)
    waiting = dict(pose.links)
    while waiting:
        held = {name: sum(point in reached for point in points) for name, points in waiting.items()}
        link = max(waiting, key=lambda name: held[name])
        reached |= dict.fromkeys(waiting.pop(link))
    return list(reached)


def _document(top: Table, pose: PosedLinks, chain: _Dyads, driven: dict[str, Any]) -> dict[str, Any]:
    stated = {key: value for key, value in top.values.items() if key not in (*POSE_KEYS, "bodies", "drives")}
    stated["form"] = POINTS_FORM
    if chain.motors:
        stated["drives"] = chain.motors
    pins = {name: _pin(top, pose, name) for name in pose.links[GROUND]}
    bodies = _bodies(top, chain)
    return {**stated, "drive": driven, "ground": pins, "joints": chain.joints, "bodies": bodies}


def _pin(top: Table, pose: PosedLinks, name: str) -> Any:
    """Return a fixed pin as it is written, if that is from the origin; else its place."""
    written = top.values["points"][name]
    place = pose.places[name]
    if isinstance(written, Mapping) and "from" not in written:
        return written
    return written if isinstance(written, list) and not _moved(top, pose, name) else [place.real, place.imag]


def _moved(top: Table, pose: PosedLinks, name: str) -> bool:
    """Tell whether a stated length has moved a point."""
    table = top.table("points")
    return complex(*SECTIONS["points"].type.plain.type.read(table, name)) != pose.places[name]  # type: ignore[union-attr]


def _bodies(top: Table, chain: _Dyads) -> dict[str, Any]:
    """Return the links as bodies, with what [bodies] says of them."""
    bodies: dict[str, Any] = {}
    for name, points in chain.pose.links.items():
        if name == GROUND:
            continue
        if len(points) > 1:
            bodies[name] = {"joints": [*points]}
        elif name in chain.blocks:
            bodies[name] = {"slider": points[0]}
    stated = top.table("bodies").values
    for name, body in stated.items():
        bodies[name] = {**bodies.get(name, {}), **body} if isinstance(body, Mapping) else body
    return bodies


_OWN = ("joint", *(one.key for one in MOTOR_OF_POINTS))


def _by_motor(chain: _Dyads, drive: Mapping[str, Any]) -> dict[str, Any]:
    """Add the driven crank; return the drive's table."""
    table, pose = chain.top.table("drive"), chain.pose
    pivot = _pivot_of(table, pose, drive)
    crank = _driven_links(table, pose, pivot, drive.get("links"))[1]
    pin = chain.pin_of(crank, pivot)
    written = chain.top.values["points"][pin]
    direction = phase(pose.places[pin] - pose.places[pivot])
    polar = isinstance(written, Mapping) and written.get("from") == pivot
    start = written["angle"] if polar else in_degrees(direction)
    chain.turning[crank] = _Geared(pin, direction, Fraction(1))
    chain.add(pin, {"crank": pivot, "length": pose.length(pivot, pin)})
    stated = {key: value for key, value in table.values.items() if key not in _OWN}
    if "cylinder" in stated:
        stated["cylinder"] = {**stated["cylinder"], "joint": pin}
    return {"start": start, **stated, "joint": pin}


def _pivot_of(table: Table, pose: PosedLinks, drive: Mapping[str, Any]) -> str:
    """Return the point at which a motor turns."""
    pivot: str = drive.get("joint") or _usual_pivot(pose)
    if pivot not in pose.places:
        way_out = f"{meant(pivot, pose.places)}; name the one where the motor turns"
        raise table.error("joint", f"is no point{way_out}")
    return pivot


def _usual_pivot(pose: PosedLinks) -> str:
    """Return the first fixed point about which one link turns, else the first fixed point."""
    pins = pose.links[GROUND]
    return next((name for name in pins if len(pose.at(name)) == 2), pins[0])


def _driven_links(
    table: Table, pose: PosedLinks, pivot: str, links: tuple[str, ...] | None
) -> tuple[str, str]:
    """Return the two links between which a motor turns, the ground first, if it is one of them."""
    meeting = pose.at(pivot)
    if links is not None:
        if len(links) != 2 or not {*links} <= {*meeting} or links[0] == links[1]:
            raise table.error("links", f"must be two of the links that meet at {pivot}: {', '.join(meeting)}")
        meeting = [*links]
    if len(meeting) != 2:
        if len(meeting) < 2:
            reason = f"is on {meeting[0]} alone, so nothing turns there; name a joint of two links"
            raise table.error("joint", reason)
        way_out = f"say which two: links = [{shown(meeting[0])}, {shown(meeting[1])}]"
        raise table.error("joint", f"is where {', '.join(meeting)} meet; {way_out}")
    carrier, driven = meeting
    return (driven, carrier) if driven == GROUND else (carrier, driven)


def _moving_motor(chain: _Dyads, drive: Mapping[str, Any]) -> GroupMotor | None:
    """Return the motor between two links that both move; None where it is on the ground."""
    table, pose = chain.top.table("drive"), chain.pose
    pivot = _pivot_of(table, pose, drive)
    links = _driven_links(table, pose, pivot, drive.get("links"))
    if GROUND in links:
        return None
    if "cylinder" in drive:
        raise table.error("cylinder", f"turns {links[1]} about a joint that moves; give both as links")
    arms = chain.pin_of(links[0], pivot), chain.pin_of(links[1], pivot)
    for link, arm in zip(links, arms, strict=True):
        if not arm:
            reason = f"is where {' and '.join(links)} meet, and {link} is a block"
            raise table.error("joint", f"{reason}; give {link} a second point, which shows how it turns")
    return GroupMotor(pivot, links, arms)


def _by_moving_motor(chain: _Dyads, motor: GroupMotor) -> dict[str, Any]:
    """Return the drive's table of a motor between two links that both move."""
    stated = {key: value for key, value in chain.top.table("drive").values.items() if key not in _OWN}
    return {"start": in_degrees(_angle_between(chain.pose, motor)), **stated, "joint": motor.pivot}


def _angle_between(pose: PosedLinks, motor: GroupMotor) -> float:
    """Return the input's angle in the pose."""
    first, second = (pose.places[arm] - pose.places[motor.pivot] for arm in motor.arms)
    return phase(second / first)


def _driving(table: Table, pose: PosedLinks, name: str) -> PosedSlide:
    """Return the slide that drives; refuse one that is none, and what does not go with one."""
    for key in ("joint", "links", "start", "cylinder", "slider"):
        if key in table:
            raise table.error(key, "does not go with a slide that drives; leave it out")
    slide = next((one for one in pose.slides if one.name == name), None)
    if slide is None:
        names = [one.name for one in pose.slides]
        known = f"{meant(name, names)}; there are {', '.join(names) or 'none'}"
        raise table.error("slide", f"is no slide{known}")
    return slide


def _turns_crank(pose: PosedLinks, drive: Mapping[str, Any]) -> bool:
    """Tell whether a cylinder stands between a fixed point and a link that turns at the drive's joint.

    Also where neither end moves, which is refused later.
    """
    ends, pivot = drive["cylinder"]["between"], drive.get("joint") or _usual_pivot(pose)
    moving = [end for end in ends if end not in pose.links[GROUND]]
    turning = [name for name in pose.at(pivot) if name != GROUND] if pivot in pose.links[GROUND] else []
    return not moving or (len(moving) == 1 and any(moving[0] in pose.links[name] for name in turning))


def _with_cylinder(top: Table, pose: PosedLinks, ends: tuple[str, str]) -> tuple[PosedLinks, PosedSlide]:
    """Return the pose with a cylinder as a link about its first end, along which the other one slides."""
    first, second = sorted(ends, key=lambda end: end not in pose.links[GROUND])
    name = "cylinder"
    while name in pose.links or any(slide.name == name for slide in pose.slides):
        name += "'"
    slide = PosedSlide(name, name, phase(pose.places[second] - pose.places[first]), point=second)
    links = {**pose.links, name: (first,)}
    return pose._replace(links=links, slides=(*pose.slides, slide)), slide


def _by_length(top: Table, pose: PosedLinks, slide: PosedSlide, *, whole: bool) -> AsJoints:
    """Return the document of links that are solved together and driven by a slide, or a cylinder."""
    table = top.table("drive")
    if "start" in table:
        raise table.error("start", "is that of a crank, but a length drives these links; leave it out")
    chain, group = _group(lambda: _Dyads(top, pose), whole=whole, slide=slide.name)
    driven = next((one for one in group if one.driven_slide), None)
    if driven is None:
        way_out = f"give {slide.on} a second point, or let the slide's line run through its own"
        raise table.error("slide", f"is on a link with one point, which shows no line; {way_out}")
    stated = {key: value for key, value in table.values.items() if key not in (*_OWN, "cylinder", "start")}
    written = table.table("cylinder").values if "cylinder" in table else table.values
    ends = {key: written[key] for key in ("from", "to") if key in written}
    if len(ends) < 2:
        ends = dict(zip(("from", "to"), _limits(pose, group, driven), strict=True)) | ends
    slider = {"slider": {"joint": driven.name, **ends}}
    return _document(top, pose, chain, {**stated, **slider}), group


def _limits(pose: PosedLinks, group: tuple[GroupPoint, ...], driven: GroupPoint) -> tuple[float, float]:
    """Return how far the length that drives a group can go."""
    # Here, so that reading a scene file loads no arrays.
    from linkanim.mechanics.closures import travel_range

    pins = (Pin(name, (pose.places[name].real, pose.places[name].imag)) for name in pose.links[GROUND])
    return travel_range(Linkage((*pins, *group), Drive(driven.name, 1.0, actuator=Travel(0.0, 1.0))))


def _by_slide(chain: _Dyads, slide: PosedSlide) -> dict[str, Any]:
    """Add the driven slider; return the drive's table."""
    table, pose, block = chain.top.table("drive"), chain.pose, slide.other(GROUND)
    points = pose.links[block]
    pin = next((name for name in points if len(pose.at(name)) > 1), points[0])
    line = chain.line(GROUND, slide.angle, pin)
    chain.blocks[block] = pin
    chain.add(pin, {"line": line})
    stated = {key: value for key, value in table.values.items() if key not in _OWN}
    ends = {key: table.values[key] for key in ("from", "to") if key in table}
    return {**stated, "slider": {"joint": pin, **ends}}


def _travel(chain: _Dyads, slider: dict[str, Any]) -> dict[str, Any]:
    """Return a driving slider's table with its ends: where they are not stated, as far as two bars let it."""
    if {"from", "to"} <= slider.keys():
        return slider
    pin, places = slider["joint"], chain.pose.places
    line = chain.joints[pin]["line"]
    along = rect(1.0, -angle(line["angle"]))
    for joint in chain.joints.values():
        ends = joint["from"] if isinstance(joint.get("from"), list) else []
        other = next((end for end in ends if end in chain.pose.links[GROUND]), "")
        if pin in ends and other:
            at = (places[other] - places[line["through"]]) * along
            now = ((places[pin] - places[other]) * along).real
            one, two = joint["length"]
            far, near = (
                math.sqrt(max((reach - aside) * (reach + aside), 0.0))
                for reach, aside in ((one + two, at.imag - line.get("offset", 0.0)) for two in (two, -two))
            )
            low, high = (near if near else -far, far) if now > 0 else (-far, -near if near else far)
            return {"from": at.real + low, "to": at.real + high, **slider}
    table = chain.top.table("drive")
    raise table.wrong("needs the ends of its slide's travel; give from and to, such as from = 80, to = 160")
