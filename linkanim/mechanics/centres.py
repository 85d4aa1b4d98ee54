"""Instant centres: where two links move alike, and how Kennedy's theorem leads from some to the others.

Links are bodies, the blocks in slots that have no name among them; None is the ground. The instant centres
of three links lie in one line (Aronhold and Kennedy; Uicker, Pennock and Shigley, Theory of Machines and
Mechanisms), so that two such lines give a centre that is not known yet.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.angles import unit
from linkanim.mechanics.linkage import Body, Crank, Linkage, Slide, holding
from linkanim.mechanics.measures import as_complex, between, components, cross, over, size, steady
from linkanim.mechanics.tolerances import ROUNDING, STRAIGHT

Link = Body | None
"""A body, or None for the ground."""


class Centre(NamedTuple):
    """An instant centre: a place (x + yi), or a unit vector towards a centre that is infinitely far."""

    place: complex | None
    direction: complex = 0j


class KennedyStep(NamedTuple):
    """Two links, and the third links that lead to their centre: each of these gives a line through it."""

    pair: tuple[str, str]
    by: tuple[str, ...]


def blocks(linkage: Linkage) -> tuple[Body, ...]:
    """Return the blocks that slide on a link, or on the ground, and that are no named body.

    A pin in two slots has one block, which turns with the first of its guides.
    """
    named = {body.slider for body in linkage.bodies}
    points = dict.fromkeys(slide.point for joint in linkage.joints for slide in joint.slides)
    return tuple(Body("", slider=point) for point in points if point not in named)


def centre(motion: Any, one: Link, other: Link) -> Centre | None:
    """Return the instant centre of two links of a pose; None where they do not move against each other.

    Links that share a joint have it there. The centre of what slides and its guide is infinitely far across
    the guide, also while it stands; that of two links that turn alike across the way they move.
    """
    linkage = motion.mechanism.linkage
    if joint := joint_between(linkage, one, other):
        return Centre(complex(*motion.position[joint]))
    if slide := slide_between(linkage, one, other):
        return Centre(None, 1j * _direction(motion, slide))
    body, against = (one, other) if one is not None else (other, one)
    assert body is not None
    x, y = pole(motion, body, against)
    if math.isfinite(x) and math.isfinite(y):
        return Centre(complex(x, y))
    velocity = complex(*_steadily(motion, body, against)[1:])
    speed = abs(velocity)
    return Centre(None, 1j * velocity / speed) if math.isfinite(speed) and speed > 0 else None


def centre_path(motion: Any, one: Link, other: Link) -> NDArray[np.complex128]:
    """Return where two links have their instant centre over a motion: x + yi (n,), NaN where it is nowhere.

    That is where it is infinitely far, or where the links do not move against each other.
    """
    linkage = motion.mechanism.linkage
    if joint := joint_between(linkage, one, other):
        return np.asarray(as_complex(motion.position[joint]))
    if slide_between(linkage, one, other):
        return np.full(np.shape(motion.phase), complex(math.nan))
    body, against = (one, other) if one is not None else (other, one)
    assert body is not None
    return _finite(*pole(motion, body, against))


def _finite(x: Any, y: Any) -> NDArray[np.complex128]:
    """Return places as x + yi, NaN where they are not finite."""
    known = np.isfinite(x) & np.isfinite(y)
    return np.where(known, x, math.nan) + 1j * np.where(known, y, math.nan)


def joint_between(linkage: Linkage, one: Link, other: Link) -> str | None:
    """Return the joint that two links share; None where they share none."""
    shared = _joints(linkage, one) & _joints(linkage, other)
    return min(shared, default=None)


def slide_between(linkage: Linkage, one: Link, other: Link) -> Slide | None:
    """Return the slide by which one of two links slides on the other; None where neither does.

    A block whose pin runs in a second slot, too, turns against that slot, so its centre lies elsewhere; one
    that turns on neither of its guides has a centre across each.
    """
    for block, guide in ((one, other), (other, one)):
        if block is not None and block.slider is not None:
            slides = _slides_of(linkage, block.slider)
            if slide := next((slide for slide in slides if _guides(linkage, guide, slide)), None):
                return slide
    return None


def touch(linkage: Linkage, one: Link, other: Link) -> bool:
    """Return whether the centre of two links is known by how they touch: in a joint, on a guide, as gears."""
    joined = joint_between(linkage, one, other) or slide_between(linkage, one, other)
    return joined is not None or _geared(linkage, one, other)


def kennedy(
    linkage: Linkage, links: Mapping[str, Link], *, to_ground: bool = False
) -> tuple[KennedyStep, ...]:
    """Return the centres that Kennedy's theorem leads to, in the order in which they can be found.

    Centres of links that share a joint, slide on each other or are geared to each other on fixed pins are
    known. Each other centre is found by two links whose centres with both are known by then. Centres to which
    only one such link leads stand at the end. `to_ground` are only those with the first link, the ground, to
    which two lines lead through each other and the centres that are known at once.
    """
    pairs = list(combinations(links, 2))
    known = {(one, other) for one, other in pairs if touch(linkage, links[one], links[other])}
    steps: list[KennedyStep] = []
    if to_ground:
        pairs = [pair for pair in pairs if pair[0] == next(iter(links))]
    for least in (2,) if to_ground else (2, 1):
        while step := next(_next(links, pairs, known, least), None):
            steps.append(step)
            known.add(step.pair)
    return tuple(steps)


def _next(
    links: Mapping[str, Link], pairs: list[tuple[str, str]], known: set[tuple[str, str]], least: int
) -> Iterator[KennedyStep]:
    """Yield the centres that at least `least` links lead to."""
    both = known | {(other, one) for one, other in known}
    for one, other in pairs:
        by = tuple(third for third in links if (one, third) in both and (third, other) in both)
        if (one, other) not in known and len(by) >= least:
            yield KennedyStep((one, other), by[:2])


def _geared(linkage: Linkage, one: Link, other: Link) -> bool:
    """Return whether two links turn about fixed pins and their gears mesh: the pitch circles touch."""
    bars = (_joints(linkage, one), _joints(linkage, other))
    for crank in linkage.cranks:
        if crank.gear and not crank.gear.motor and linkage.joint(crank.pivot).fixed:
            mate = linkage.joint(crank.gear.mate)
            ends = [{crank.pivot, crank.name}, {mate.pivot, mate.name} if isinstance(mate, Crank) else set()]
            if any(first <= bars[0] and second <= bars[1] for first, second in (ends, ends[::-1])):
                return True
    return False


def _joints(linkage: Linkage, link: Link) -> frozenset[str]:
    """Return all joints of a link."""
    if link is None:
        return frozenset(linkage.rigid_bodies[0])
    if link.slider is not None:
        return frozenset([link.slider])
    frame = holding(linkage.rigid_bodies, link.joints)
    return frozenset(link.joints if frame is None else linkage.rigid_bodies[frame])


def _guides(linkage: Linkage, link: Link, slide: Slide) -> bool:
    """Return whether a link is what something slides on."""
    if link is None or slide.start is None:
        return link is None and slide.start is None
    if link.slider is not None:
        return link.slider == slide.start and slide.axis is None
    return slide.axis is not None and set(slide.axis) <= _joints(linkage, link)


def _slides_of(linkage: Linkage, point: str) -> tuple[Slide, ...]:
    """Return the slides on whose guides a block does not turn.

    That is the first by what its own joint says, or by the bar whose slot it is in; of a group all of them.
    """
    joint = linkage.joint(point)
    if joint.guided:
        return joint.guided
    every = (*joint.slides, *(slide for one in linkage.joints for slide in one.slides))
    return (next(slide for slide in every if slide.point == point),)


def _direction(motion: Any, slide: Slide) -> complex:
    """Return the direction of a guide in a pose."""
    turn = complex(*unit(slide.angle))
    if slide.axis is None:
        return turn
    arm = complex(*between(motion.position, slide.axis))
    return turn * arm / abs(arm)


def pole(motion: Any, body: Body, other: Link = None) -> tuple[Any, Any]:
    """Return a body's instant centre to another link: x and y, of a pose or of a motion.

    Both links move alike there: P = A + i·(v_A - v)/(ω - ω′) with A a joint of the body, and v and ω′ those
    of the other link's plane at A. Infinite where both turn alike, NaN where they do not move. A fixed pin is
    the centre of a body that turns about it.
    """
    linkage, still = motion.mechanism.linkage, 0.0 * motion.phase
    pin = linkage.pivot(body.joints) if other is None and body.slider is None else None
    if pin is not None:
        x, y = linkage.pin(pin).position
        return x + still, y + still
    x, y = components(motion.position[_point(body)])
    rate, vx, vy = _steadily(motion, body, other)
    turning, moving = abs(rate) * linkage.extent, size((vx, vy))
    place = x - over(vy, rate), y + over(vx, rate)
    away = np.where(moving > 0, math.inf, math.nan) + still
    turns = turning > STRAIGHT * moving
    return np.where(turns, place[0], away)[()], np.where(turns, place[1], away)[()]


def _steadily(motion: Any, body: Body, other: Link) -> tuple[Any, Any, Any]:
    """Return how two links move against each other, as `_velocity_between`, up to a factor; also at rest.

    Where all that moves them rests they are about to move as they are accelerated.
    """
    linkage = motion.mechanism.linkage
    joints = [name for link in (body, other) if link is not None for name in _moved_with(linkage, link)]
    extent = linkage.extent

    def read(motion: Any) -> tuple[Any, ...]:
        rate, vx, vy = _velocity_between(motion, body, other)
        return size((vx, vy)) + abs(rate) * extent, rate, vx, vy

    moves, *place = steady(motion, joints, read)
    rests = ~moves
    if np.any(rests):
        begun = _velocity_between(motion.mechanism.solve(phase=motion.phase, speed=1.0), body, other, _BEGUN)
        still = size(begun[1:]) + abs(begun[0]) * extent <= ROUNDING * extent
        place = [
            np.where(rests, np.where(still, 0.0, new), old)[()] for new, old in zip(begun, place, strict=True)
        ]
    return place[0], place[1], place[2]


_MOVING = "velocity", "angular_velocity"
_BEGUN = "acceleration", "angular_acceleration"


def _velocity_between(
    motion: Any, body: Body, other: Link, rates: tuple[str, str] = _MOVING
) -> tuple[Any, Any, Any]:
    """Return how fast a body turns against another link, and its first joint's velocity against that link.

    Where both rest, the rates may be accelerations.
    """
    points = getattr(motion, rates[0])
    rate = _rate(motion, body, rates)
    vx, vy = components(points[_point(body)])
    if other is None:
        return rate, vx, vy
    theirs, (x, y) = _rate(motion, other, rates), between(motion.position, (_point(other), _point(body)))
    wx, wy = components(points[_point(other)])
    return rate - theirs, vx - wx + theirs * y, vy - wy - theirs * x


def _point(body: Body) -> str:
    return body.slider or body.joints[0]


def _moved_with(linkage: Linkage, body: Body) -> tuple[str, ...]:
    """Return joints that tell how a body moves: two of its own, of a block those of its guide."""
    if body.slider is None:
        return body.joints[:2]
    return body.slider, *(_slides_of(linkage, body.slider)[0].axis or ())


def _rate(motion: Any, body: Body, rates: tuple[str, str]) -> Any:
    """Return a body's angular velocity, or acceleration; a block turns with its guide."""
    points, turning = rates
    if body.slider is None:
        return getattr(motion, turning)[body.name]
    guide = _slides_of(motion.mechanism.linkage, body.slider)[0]
    if guide.axis is None:
        return 0.0 * motion.phase
    arm, moving = between(motion.position, guide.axis), between(getattr(motion, points), guide.axis)
    return over(cross(arm, moving), arm[0] * arm[0] + arm[1] * arm[1])


def centrodes(motion: Any, body: Body) -> tuple[Any, Any]:
    """Return the path of a body's instant centre on the ground, and on the body: x + yi (n,), breaks NaN.

    The body moves as if the second curve, fixed to it along its first -> second joint, rolled on the first.
    There is a break wherever the centre goes through infinity: where the body stops turning.
    """
    fixed = _finite(*pole(motion, body))
    first, second = (as_complex(motion.position[name]) for name in body.joints[:2])
    turning = np.sign(motion.angular_velocity[body.name])
    rolling = (fixed - first) * (np.conj(second - first) / abs(second - first))
    through = np.flatnonzero(turning[1:] * turning[:-1] <= 0) + 1
    return np.insert(fixed, through, math.nan), np.insert(rolling, through, math.nan)
