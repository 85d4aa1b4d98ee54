"""A chain of dyads to many digits, each joint by the plainest construction on complex numbers.

Nothing is shared with the solver: circles are met with circles and lines, and directions are quotients. Links
that are solved together are put by Newton's steps from places near by.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import combinations
from typing import Any

from mpmath import mp, mpf
from reference import on_line, unit

from linkanim.bench.reference import crossing
from linkanim.mechanics.groups import GROUND, GroupPoint, GroupSlide, LinkGroup
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Crank,
    DrivenSlider,
    Joint,
    Line,
    Linkage,
    Pin,
    Rigid,
)

Places = dict[str, Any]


def places(
    linkage: Linkage,
    angle: Any,
    signs: Mapping[str, int] | None = None,
    near: Mapping[str, complex] | None = None,
) -> Places:
    """Where every joint lies at an angle of the input, or a slider's travel; `signs` replaces named sides.

    Of links that are solved together the places are those `near` given ones.
    """
    found: Places = {}
    turned: dict[str, Any] = {linkage.drive.joint: angle}
    for joint in linkage.joints:
        if isinstance(joint, GroupPoint):
            if joint.name not in found:
                found |= _together(joint.group, found, mpf(angle), near or {})
            continue
        found[joint.name] = _place(joint, found, turned, (signs or {}).get(joint.name))
    return found


def _place(joint: Joint, at: Places, turned: dict[str, Any], sign: int | None) -> Any:
    match joint:
        case Pin():
            return mp.mpc(*map(mpf, joint.position))
        case Crank():
            return at[joint.pivot] + mpf(joint.length) * unit(_turned(joint, turned))
        case DrivenSlider():
            base, along = _line(joint.line, at)
            return base + along * mp.mpc(turned[joint.name], mpf(joint.line.offset))
        case RRR():
            p, q = (at[end] for end in joint.ends)
            a, b = map(mpf, joint.lengths)
            return crossing(p, q, a, b, joint.side if sign is None else sign)
        case RRP():
            base, along = _line(joint.line, at)
            seen = (at[joint.end] - base) / along
            side = joint.side if sign is None else sign
            return base + along * on_line(seen, mpf(joint.length), mpf(joint.line.offset), side)
        case RPP():
            base, along = _line(joint.line, at)
            seen = (at[joint.pin] - base) / along
            rise = mp.im(seen) - mpf(joint.line.offset)
            way = mp.re(seen) - rise * mp.cos(mpf(joint.slot)) / mp.sin(mpf(joint.slot))
            return base + along * mp.mpc(way, mpf(joint.line.offset))
        case RPR():
            way, offset = at[joint.through] - at[joint.pivot], mpf(joint.offset)
            slide = mp.sqrt(abs(way) ** 2 - offset**2) * (1 if sign is None else sign)
            return at[joint.pivot] + mpf(joint.length) * way / mp.mpc(slide, offset)
        case Rigid():
            start, end = (at[name] for name in joint.on)
            return start + mp.mpc(*map(mpf, joint.at)) * (end - start) / abs(end - start)
    raise AssertionError(joint)


def _turned(crank: Crank, turned: dict[str, Any]) -> Any:
    if crank.gear is not None:
        ratio = mpf(crank.gear.ratio.numerator) / crank.gear.ratio.denominator
        turned[crank.name] = turned[crank.gear.mate] * ratio + mpf(crank.gear.offset)
    return turned[crank.name]


def _line(line: Line, at: Places) -> tuple[Any, Any]:
    """The base point of a line, and its direction."""
    along = unit(mpf(line.angle))
    if line.on is not None:
        axis = at[line.on[1]] - at[line.on[0]]
        along = along * axis / abs(axis)
    return at[line.through], along


def _together(group: LinkGroup, known: Places, travel: Any, near: Mapping[str, complex]) -> Places:
    """The points of a group, by Newton's steps from places near by; `travel` is the driven slide's."""
    points, step = [*group.points], mpf(10) ** -(mp.dps // 2)
    at = {**known, **{name: mp.mpc(near[name]) for name in points}}
    conditions = [*_conditions(group, {*known}, travel)]
    for _ in range(12):
        off = mp.matrix([one(at) for one in conditions])
        slopes = mp.matrix(len(conditions), 2 * len(points))
        for n, way in enumerate((name, unit_) for name in points for unit_ in (1, 1j)):
            moved = {**at, way[0]: at[way[0]] + step * way[1]}
            for row, one in enumerate(conditions):
                slopes[row, n] = (one(moved) - off[row]) / step
        change = mp.lu_solve(slopes, -off)
        for n, name in enumerate(points):
            at[name] += mp.mpc(change[2 * n], change[2 * n + 1])
        if mp.norm(change) < mpf(10) ** (8 - mp.dps):
            break
    return {name: at[name] for name in points}


Condition = Callable[[Places], Any]
"""A number that is zero where the condition holds."""


def _conditions(group: LinkGroup, known: set[str], travel: Any) -> Iterator[Condition]:
    """Yield what holds a group: its links have their shapes, and what slides on them lies on its lines."""
    pose: Places = {}
    for link in group.members:
        pose |= {name: mp.mpc(*map(mpf, at)) for name, at in zip(link.points, link.places, strict=True)}
    for link in group.members:
        for one, other in combinations(link.points, 2):
            if not {one, other} <= known and {one, other} & {*link.points[:2]}:
                yield _apart(one, other, mpf(link.length) or abs(pose[other] - pose[one]))
    ways: dict[str, Condition] = {}
    for slide in group.slides:
        carrier, link = group.by_name[slide.on], group.by_name[slide.link]
        others = [name for name in carrier.points if name != slide.start and slide.on != GROUND]
        if slide.on != GROUND and not others:  # a cylinder from end to end
            yield _apart(slide.start, slide.point, travel)
            continue
        way = _way(slide, others, pose)
        yield _aside(slide.start, slide.point, way, pose)
        if slide.name == group.driven:
            yield _ahead(slide.start, slide.point, way, travel)
        if not slide.turns:
            yield from (_aside(slide.point, name, way, pose) for name in link.points if name != slide.point)
            if slide.link in ways:
                yield _turned_alike(ways[slide.link], way, pose)
            ways[slide.link] = way


def _apart(one: str, other: str, length: Any) -> Condition:
    return lambda at: (abs(at[other] - at[one]) - length) * length


def _way(slide: GroupSlide, others: list[str], pose: Places) -> Condition:
    """Return the direction of a slide's line as a function of the places, of length 1."""
    along = mp.expj(mpf(slide.angle))
    if not others:
        return lambda at: along

    def axis(at: Places) -> Any:
        turned = at[others[0]] - at[slide.start]
        return turned / abs(turned)

    own = along / axis(pose)
    return lambda at: own * axis(at)


def _aside(start: str, point: str, way: Condition, pose: Places) -> Condition:
    beside = mp.im((pose[point] - pose[start]) / way(pose))
    return lambda at: mp.im((at[point] - at[start]) / way(at)) - beside


def _ahead(start: str, point: str, way: Condition, travel: Any) -> Condition:
    return lambda at: mp.re((at[point] - at[start]) / way(at)) - travel


def _turned_alike(one: Condition, other: Condition, pose: Places) -> Condition:
    between = other(pose) / one(pose)
    return lambda at: mp.im(other(at) / one(at) / between)
