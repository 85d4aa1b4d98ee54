"""Analyse a linkage: its class and names, its transmission angles, the order of its solution.

Its parts, in reading order:

- In which step each joint is solved: the causal chain from the input to the output.
- The transmission angle of every dyad: the worst over the motion and where it is, and the best.
- What a linkage is called: by the lengths of its four-bars, its dyads, its gears and what drives it.
- What kind of linkage it is, how far its input goes, and what a lecturer says of it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property, partial
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.arithmetic import Graph, Slope
from linkanim.mechanics.balance import surplus
from linkanim.mechanics.forces import Demand, demand, usual_effort
from linkanim.mechanics.groups import GroupPoint, LinkGroup, group_of
from linkanim.mechanics.linkage import RRR, Body, Joint, Linkage, Rigid, holding
from linkanim.mechanics.measures import (
    as_output,
    near,
    output_body,
    output_slider,
    pivots_of,
    transmission_angle,
)
from linkanim.mechanics.motion import Mechanism, Motion
from linkanim.mechanics.program import Array, batch
from linkanim.mechanics.quantities import input_symbol, phrase
from linkanim.mechanics.search import changes_by_row, highest, in_blocks, own_rows, sign_changes
from linkanim.mechanics.solver.closing import closer_of, walk_at
from linkanim.mechanics.solver.signed_root import Kind
from linkanim.mechanics.tolerances import (
    BESIDE_AN_EXTREME,
    CHANGE_POINT,
    EQUAL_LINKS,
    FOUND,
    NO_WAY,
    NONE_LEFT,
    PARALLEL,
    RIGID,
    SAME_PLACE,
    TURNING_WITH_IT,
)
from linkanim.units import degrees, short, significant, typeset
from linkanim.words import (
    ENGLISH,
    cached_as_said,
    name_said,
    row_said,
    said,
    said_as,
    said_many,
    speaking,
    to_say,
)

# In which step each joint is solved: the causal chain from the input to the output.


def solving_steps(linkage: Linkage) -> Mapping[str, int]:
    """Return each joint's step: 0 on the ground, 1 the input's, then one more than what it is found from.

    A point of a body comes with the last of the joints that its body is known by; dyads that need nothing
    of each other share a step, and so do all points of links that are solved together.
    """
    steps: dict[str, int] = {}
    for joint in linkage.joints:
        needs: Iterable[str] = joint.needs
        if isinstance(joint, GroupPoint):
            members = (name for member in joint.group.members for name in member.points)
            needs = (name for name in members if name not in joint.group.points)
        before = max((steps[name] for name in needs), default=0)
        with_body = joint.fixed or isinstance(joint, Rigid)
        steps[joint.name] = before if with_body else before + 1
    return steps


# The transmission angle of every dyad: the worst over the motion and where it is, and the best.
#
# It is 90° where the force in a dyad does nothing but drive what follows, and 0 where it drives nothing: see
# Uicker, Pennock and Shigley, Theory of Machines and Mechanisms. An angle past 90° between two bars counts as
# its supplement, here as everywhere. Each kind of dyad gives the angle from the factors U and W of its root;
# the angle is extreme where the dyad's separation is extreme, and where U = W.


class Transmission(NamedTuple):
    """The least transmission angle over the motion, of which dyad and at which phase, and the greatest."""

    least: float
    greatest: float
    dyad: str
    phase: float


def transmission(mechanism: Mechanism) -> Transmission | None:
    """Return the least and greatest transmission angle over all dyads; None where there is no dyad.

    Both are exact. Where the least angle is reached at several phases, one of them is returned.
    """
    joint = mechanism.assembly.linkage.joint
    angles = [
        (angle, name)
        for name, factors in (*_of_loops(mechanism), *_of_chain(mechanism))
        for u, w in _emptied(factors, at_end=_reaches_its_end(mechanism, name))
        if (angle := joint(name).transmission(u, w)) is not None
    ]
    if not angles:
        return None
    least, dyad = min(angles, key=itemgetter(0))
    return Transmission(least, max(angles)[0], dyad, _where_least(mechanism, dyad))


def _where_least(mechanism: Mechanism, dyad: str) -> float:
    """Return a phase at which a dyad's transmission angle is least."""

    def negative(phases: Array) -> Array:
        motion = mechanism.solve(phase=phases, speed=1.0, derivatives=0)
        return -np.asarray(transmission_angle(motion, dyad), dtype=np.float64)

    places = mechanism.sampled
    worst = float(places[np.nanargmax(np.concatenate([*map(negative, in_blocks(places))]))])
    phase = highest(negative, worst, math.tau / mechanism.assembly.samples)
    end = math.pi * round(phase / math.pi)  # where bars in one line, or an end of the input, often are
    return (end if abs(phase - end) < FOUND else phase) % (math.tau * mechanism.periods)


def _of_loops(mechanism: Mechanism) -> Iterator[tuple[str, Array]]:
    """Yield U and W of each loop where sin²(ψ/2) is least and greatest, and where they are equal."""
    for name, loop in mechanism.assembly.loops.items():
        root, path = loop.root, mechanism.assembly.path
        reference, ratio = root.reference - loop.gearing.offset, loop.gearing.ratio
        least, greatest = path.half_squares(reference, ratio)
        equal = (root.u.most - root.w.least) / (2 * root.spread)
        spread = np.array([least, min(max(equal, least), greatest), greatest]) * root.spread
        u = np.ones(3) if root.single else root.u.most - spread
        yield name, np.column_stack([u, root.w.least + spread])


def _of_chain(mechanism: Mechanism) -> Iterator[tuple[str, Array]]:
    """Yield U and W of each dyad on moving points where its separation, its rate or U - W changes sign."""
    assembly = mechanism.assembly
    by_name = walk_at(assembly, Graph().input("x"), Slope(1.0)).closings
    if not by_name:
        return
    closings, count = by_name.values(), len(by_name)
    parts = [(one.separation.value, one.separation.rate, one.half_difference) for one in closings]
    turning = batch({"x": True}, [value for values in parts for value in values])
    factors = batch({"x": True}, [closing.u for closing in closings] + [closing.w for closing in closings])

    def moving(phases: Array) -> Array:
        """Return each separation, its rate, 0 where one body carries both ends, and U - W."""
        values = turning(phases)
        rates = values[1::3]
        rates[np.abs(rates) <= RIGID * np.abs(values[::3])] = 0.0
        return values

    places = assembly.sampled
    with np.errstate(all="ignore"):
        rows, extremes = changes_by_row(moving, places, BESIDE_AN_EXTREME)
        whose = np.concatenate([np.arange(count), rows // len(parts[0])])
        where = np.concatenate([np.repeat(places[:1], count), extremes])
        u, w = (own_rows(factors, whose + half, where) for half in (0, count))
    for row, name in enumerate(by_name):
        yield name, np.column_stack([u, w])[whose == row]


def _reaches_its_end(mechanism: Mechanism, name: str) -> bool:
    """Tell whether a dyad's bars fall into one line: at a limit of its own, or at a change point."""
    root = mechanism.assembly.chain.get(name)
    return bool(root and root.zeros) or name in mechanism.stops


def _emptied(factors: Array, *, at_end: bool) -> list[list[float]]:
    """Return the factors, with 0 for what rounding leaves of a factor that vanishes."""
    least = factors.max(axis=0) * (NONE_LEFT if at_end else 0.0)
    kept: list[list[float]] = np.where(factors > least, factors, 0.0).tolist()
    return kept


# What a linkage is called: by the lengths of its four-bars, its dyads, its gears and what drives it.

_EACH_NAMED = 4
"""Up to this many four-bars in a row each is named, beyond that only the first."""
TRIPLE_ROCKERS = {
    "ground": to_say("outward/outward"),
    "input": to_say("outward/inward"),
    "output": to_say("inward/outward"),
    "coupler": to_say("inward/inward"),
}
GRASHOF = {
    "ground": to_say("drag-link (double crank)"),
    "input": to_say("crank-rocker"),
    "output": to_say("crank-rocker driven at its rocker"),
    "coupler": to_say("double-rocker"),
}

SHORTEST = {
    "ground": to_say("the ground"),
    "input": to_say("the input"),
    "coupler": to_say("the coupler"),
    "driven link": to_say("the driven link"),
}
_PARTS = re.compile(r"(crank|rocker|coupler|drag)\d*")
"""Names by which a scene says what a body does."""
_ORDINALS = {2: "second", 3: "third"}
_ENDINGS = {1: "st", 2: "nd", 3: "rd"}


class FourBar(NamedTuple):
    """The four links of a four-bar by their part, seen from its input, and which of two closures it has.

    `joint` is the joint of coupler and output.
    """

    joint: str
    links: Mapping[str, float]
    sign: int
    change_points: int

    @property
    def shortest(self) -> str:
        """The part of the shortest link."""
        part = _part(self, min)
        return "driven link" if part == "output" else part

    @property
    def margin(self) -> float:
        """p + q - s - l: positive for Grashof linkages, zero at a change point."""
        s, p, q, longest = sorted(self.links.values())
        return 0.0 if self.change_points else math.fsum((p, q, -s, -longest))


def _links(*lengths: float) -> Mapping[str, float]:
    return dict(zip(("ground", "input", "coupler", "output"), lengths, strict=True))


def four_bar_of(mechanism: Mechanism) -> FourBar | None:
    """Return the four-bar loop that the input drives directly, where there is one."""
    for name, loop in mechanism.assembly.loops.items():
        joint = mechanism.linkage.joint(name)
        if isinstance(joint, RRR) and loop.pin == mechanism.linkage.drive.joint and loop.ground:
            a, b = joint.lengths[::-1] if loop.swapped else joint.lengths
            sign = mechanism.assembly.signs[name] * (-1 if loop.swapped else 1)
            scale = mechanism.assembly.unscale
            touching = (loop.root.u.kind, loop.root.w.kind).count(Kind.CHANGE_POINT)
            links = _links(loop.ground.length * scale, loop.crank.length * scale, a, b)
            return FourBar(name, links, sign, touching)
    return None


def class_name(mechanism: Mechanism, four_bar: FourBar | None) -> str:
    """Return the class of a linkage, `four_bar` being the loop that its input drives directly."""
    linkage = mechanism.linkage
    if group := group_of(linkage):
        return group_name(linkage, group)
    dyads = [joint for joint in linkage.joints if joint.dyad]
    geared = any(crank.gear and not crank.gear.motor for crank in linkage.cranks)
    if linkage.motors and dyads:
        bars = bars_named(1 + len([*linkage.cranks]) + 2 * len(dyads))
        if len(linkage.motors) == 1:
            return said("{bars} with two motors", bars=bars)
        return said("{bars} with {count} motors", bars=bars, count=len(linkage.motors) + 1)
    slider = any(joint.travels for joint in dyads)
    cranks = {crank.name for crank in linkage.cranks}
    if geared and any(isinstance(joint, RRR) and cranks.issuperset(joint.ends) for joint in dyads):
        return said("geared five-bar with slider") if slider else said("geared five-bar")
    if geared and len(dyads) > 1:
        bars = bars_named(1 + len(cranks) + 2 * len(dyads))
        if slider:
            return said("{bars} linkage with gears and slider", bars=bars)
        return said("{bars} linkage with gears", bars=bars)
    if four_bar is not None:
        name = _four_bar_name(four_bar)
        if len(dyads) == 1:
            return name
        return said("{bars}: {loops}", bars=_bars(len(dyads)), loops=_with_rest(name, mechanism, len(dyads)))
    if not dyads:
        return _cranks_name(linkage)
    if linkage.drive.actuator.noun is not None:
        return _driven_name(linkage, dyads, linkage.drive.actuator.noun)
    own = closer_of(dyads[0]).name(dyads[0], mechanism.assembly) if len(dyads) == 1 else None
    if own:
        return said(own)
    bars = _bars(len(dyads))
    return said("{bars} linkage with slider", bars=bars) if slider else said("{bars} linkage", bars=bars)


def group_name(linkage: Linkage, group: LinkGroup) -> str:
    """Name a linkage with links that are solved together by how many there are, and what they have.

    A pin in a slot stands for a block that turns about it, which is a link.
    """
    dyads = [joint for joint in linkage.joints if joint.dyad]
    cylinders = [slide for slide in group.slides if group.between(slide)]
    slots = any(slide.turns for slide in group.slides if slide not in cylinders)
    slots = slots or any(joint.slides and not joint.travels for joint in dyads)
    sliders = any(not slide.turns for slide in group.slides if slide not in cylinders)
    sliders = sliders or any(joint.travels for joint in dyads)
    geared, driven = (any(gear.motor == motor for gear in group.gears) for motor in (False, True))
    geared = geared or any(crank.gear and not crank.gear.motor for crank in linkage.cranks)
    has = zip(_HAS, (sliders, slots, bool(cylinders), geared, driven or bool(linkage.motors)), strict=True)
    parts = [said(word) for word, there in has if there]
    bars = bars_named(links_and_joints(linkage)[0])
    if not parts:
        return said("{bars} linkage", bars=bars)
    return said("{bars} linkage with {parts}", bars=bars, parts=said_as("list", " and ").join(parts))


_HAS = to_say("slider"), to_say("slot"), to_say("cylinder"), to_say("gears"), to_say("further motors")
_BARS = (
    to_say("four-bar"),
    to_say("five-bar"),
    to_say("six-bar"),
    to_say("seven-bar"),
    to_say("eight-bar"),
    to_say("nine-bar"),
    to_say("ten-bar"),
)


def links_and_joints(linkage: Linkage) -> tuple[int, int]:
    """Return how many links, the ground among them, and joints there are.

    A crank or a driven slider counts as one link and one joint, a dyad or a driving cylinder as two links
    and three joints; a pin in a slot is a link, the block, that turns and slides.
    """
    group = group_of(linkage)
    sliding = group is None and linkage.driven.joint.driven_slide is not None
    cylinder = group is None and linkage.drive.actuator.along is not None
    inputs = len(tuple(linkage.cranks)) + sliding
    pairs = sum(joint.dyad for joint in linkage.joints) + cylinder
    links, joints = 1 + inputs + 2 * pairs, inputs + 3 * pairs
    if group:
        slots = sum(slide.turns for slide in group.own_slides)
        points = [name for one in group.free for name in one.points]
        links += len([*group.free]) + slots
        joints += len(points) - len({*points} & {*group.points}) + len(group.own_slides) + slots
    return links, joints


def bars_named(count: int) -> str:
    """Name a linkage by the number of its links."""
    return said(_BARS[count - 4]) if 4 <= count <= 10 else said("{count}-bar", count=count)


def _driven_name(linkage: Linkage, dyads: list[Joint], noun: str) -> str:
    """Name a linkage by what drives it where that is no crank."""
    first = dyads[0]
    ends = set(first.ends) if isinstance(first, RRR) else set()
    cranked = linkage.drive.joint in ends and any(pin.name in ends for pin in linkage.pins)
    if cranked and len(dyads) == 1:
        return said("slider-crank driven at its {noun}", noun=name_said(noun))
    return said("{bars} linkage driven by a {noun}", bars=_bars(len(dyads)), noun=name_said(noun))


def _cranks_name(linkage: Linkage) -> str:
    """Name a linkage without dyads by how its cranks turn."""
    if linkage.drive.actuator.linkage_name is not None:
        return said(linkage.drive.actuator.linkage_name)
    geared = [crank for crank in linkage.cranks if crank.gear and not crank.gear.motor]
    if any(not linkage.joint(crank.pivot).fixed for crank in geared):
        return said("epicyclic gear train")
    return said("geared cranks") if geared else said("crank")


def _bars(dyads: int) -> str:
    """Name the linkage by its links: ground, crank and two for each dyad."""
    return bars_named(2 * dyads + 2) if dyads < 4 else said("{count}-bar", count=2 * dyads + 2)


def _with_rest(first: str, mechanism: Mechanism, dyads: int) -> str:
    """Name the `first` loop and those after it, as far as they are four-bars, or how many dyads follow."""
    if dyads <= _EACH_NAMED:
        further = [_four_bar_name(bar) for bar in _further_loops(mechanism)]
        if len(further) == dyads - 1:
            return said_as("list", ", then ").join((first, *further))
    if dyads == 2:
        return said("{first} and a second dyad", first=first)
    return said("{first} and {count} further dyads", first=first, count=dyads - 1)


def _further_loops(mechanism: Mechanism) -> Iterator[FourBar]:
    """Yield the four-bars down the chain: dyads between a fixed pin and one that turns about a fixed pin.

    Their sign tells a parallelogram, whose coupler keeps along the ground, from an antiparallelogram.
    """
    linkage = mechanism.linkage
    cycle = mechanism.solve(phase=in_blocks(mechanism.phases)[0], speed=1.0, derivatives=0)
    pins = {pin.name: complex(*pin.position) for pin in linkage.pins}
    places = near(cycle.position)
    for joint in linkage.joints:
        if not isinstance(joint, RRR) or joint.name in mechanism.assembly.loops:
            continue
        for (moving, fixed), (a, b) in ((joint.ends, joint.lengths), (joint.ends[::-1], joint.lengths[::-1])):
            pivot, crank = _turns_about(linkage, moving)
            if fixed in pins and pivot is not None:
                ground = abs(pins[fixed] - pins[pivot])
                along = places[joint.name] - places[moving]
                apart = along - (places[fixed] - places[pivot])
                sign = 1 if np.abs(apart).max() <= PARALLEL * ground else -1
                links = _links(ground, crank, a, b)
                yield FourBar(joint.name, links, sign, _change_point_count(ground, crank, a, b))
                break


def _turns_about(linkage: Linkage, moving: str) -> tuple[str | None, float]:
    """Return the fixed pin that a joint turns about, and how far from it; None where there is none."""
    for frame in (frame for frame in linkage.rigid_bodies[1:] if moving in frame):
        pivot = next((pin.name for pin in linkage.pins if pin.name in frame), None)
        if pivot is not None and pivot != moving:
            return pivot, abs(frame[moving] - frame[pivot])
    return None, 0.0


def _change_point_count(g: float, r: float, a: float, b: float) -> int:
    """Return how many change points the lengths have, each of them rounded."""
    least = CHANGE_POINT * (g + r + a + b)
    return int(abs(a + b - g - r) <= least) + int(min(abs(g - r - a + b), abs(g - r + a - b)) <= least)


def _four_bar_name(bar: FourBar) -> str:
    if bar.change_points:
        return _change_point_name(bar)
    if bar.margin > 0:
        return said("Grashof {kind}", kind=said(GRASHOF[_part(bar, min)]))
    return said("triple-rocker ({kind})", kind=said(TRIPLE_ROCKERS[_part(bar, max)]))


def _part(bar: FourBar, pick: Callable[..., str]) -> str:
    """Return the part of the shortest (min) or longest (max) link."""
    return pick(bar.links, key=lambda part: bar.links[part])


def _change_point_name(bar: FourBar) -> str:
    g, r, a, b = bar.links.values()
    same = partial(math.isclose, rel_tol=EQUAL_LINKS)
    if same(g, a) and same(r, b):
        return said("parallelogram") if bar.sign > 0 else said("antiparallelogram")
    if (same(g, r) and same(a, b)) or (same(g, b) and same(a, r)):
        return said("kite (change point)")
    return said("change-point {kind}", kind=said(GRASHOF[_part(bar, min)]))


def turning_bodies(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the bodies that turn fully over one true period: a crank with the input, another as it winds."""
    linkage, full_turn = mechanism.linkage, mechanism.full_turn
    bodies = [body for body in linkage.bodies if body.slider is None]
    turns = {body.name: full_turn for body in bodies if linkage.crank_of(body)}
    others = [body for body in bodies if body.name not in turns]
    if others:
        turns |= dict(zip((body.name for body in others), _windings(mechanism, others), strict=True))
    return tuple(body.name for body in bodies if turns[body.name])


def _windings(mechanism: Mechanism, bodies: list[Body]) -> list[bool]:
    """Return whether each body's direction has gone round in one true period, a block of it at a time."""
    gone = np.zeros(len(bodies), np.intp)
    first: Array = np.empty((len(bodies), 0, 2))
    last = first
    for part in in_blocks(mechanism.phases):
        places = near(mechanism.solve(phase=part, speed=1.0, derivatives=0).position)
        vectors = np.stack([places[body.joints[1]] - places[body.joints[0]] for body in bodies])
        gone += _crossings(np.concatenate([last, vectors], axis=1))
        first, last = first if first.size else vectors[:, :1], vectors[:, -1:]
    gone += _crossings(np.concatenate([last, first], axis=1))
    return [bool(one) for one in gone]


def _crossings(vectors: Array) -> NDArray[np.intp]:
    """Return how often directions (D, N, 2) cross the positive x axis counter-clockwise, less clockwise."""
    (x, x1), (y, y1) = ((vectors[:, :-1, n], vectors[:, 1:, n]) for n in (0, 1))
    below, left = y < 0, x * y1 > y * x1
    up, down = below & left & (y1 >= 0), ~below & ~left & (y1 < 0)
    return np.asarray(np.count_nonzero(up, axis=1) - np.count_nonzero(down, axis=1))


def link_names(mechanism: Mechanism, turning: Callable[[], Collection[str]]) -> dict[str, str]:
    """Return each body's name; a body that the scene calls crank, rocker or coupler is named by what it does.

    `turning` gives the bodies that turn fully, which only some names depend on. A crank turns fully about a
    fixed pin, a rocker swings about one, a coupler has no fixed pin. The input is the crank or the input
    rocker; other cranks are driven cranks. Further bodies of a sort are counted: second coupler. Every other
    name stays.
    """
    full_turn = mechanism.full_turn
    parts = {body.name: _part_of(mechanism, body, turning) for body in mechanism.linkage.bodies}
    driven = [name for name, (_, drives) in parts.items() if not drives]
    first = next((noun for noun, drives in parts.values() if drives and noun), None)
    count: dict[str, int] = {}
    names = {}
    for name, (noun, drives) in parts.items():
        words = noun or name
        if noun == "crank" and not drives and first != "rocker" and full_turn:
            words = "driven crank"
        elif noun == "rocker" and drives and any(parts[other][0] == "rocker" for other in driven):
            words = "input rocker"
        count[words] = count.get(words, 0) + 1
        names[name] = _counted(words, count[words]) if noun else name
    return names


def _part_of(
    mechanism: Mechanism, body: Body, turning: Callable[[], Collection[str]]
) -> tuple[str | None, bool]:
    """Return crank, rocker or coupler, None for a body with another name; and whether it is the input."""
    linkage = mechanism.linkage
    own = _PARTS.fullmatch(body.name)
    if own is None or body.slider is not None:
        return None, False
    pivoted = bool(pivots_of(linkage, body))
    if pivoted == (own[1] == "coupler"):
        return None, False
    drives = linkage.drive.joint in linkage.rigid_bodies[holding(linkage.rigid_bodies, body.joints) or 0]
    if not pivoted:
        return "coupler", False
    turns = mechanism.full_turn if drives else body.name in turning()
    return "crank" if turns else "rocker", drives


def _counted(words: str, number: int) -> str:
    if number == 1:
        return words
    ending = "th" if number // 10 % 10 == 1 else _ENDINGS.get(number % 10, "th")
    return f"{_ORDINALS.get(number, f'{number}{ending}')} {words}"


# What kind of linkage it is, how far its input goes, and what a lecturer says of it.


@frozen
class Info:
    """What is known of a linkage; angles in radians, lengths in the scene's unit.

    Where a slider drives, its travel stands for the input's angle.

    Each fact is worked out when it is first read: a length that is dragged changes sixty times a second.
    """

    mechanism: Mechanism
    length_unit: str

    @cached_property
    def class_name(self) -> str:
        """The class, in English words, as files and JSON have it."""
        with speaking(ENGLISH):
            return class_name(self.mechanism, self._four_bar)

    @cached_as_said
    def class_said(self) -> str:
        """The class, in the language that is spoken."""
        return class_name(self.mechanism, self._four_bar)

    @cached_property
    def grashof(self) -> str | None:
        """Grashof's rule with the four-bar's numbers; None for other linkages."""
        if (bar := self._four_bar) is None:
            return None
        s, p, q, longest = sorted(bar.links.values())
        relation = "=" if bar.change_points else "<" if bar.margin > 0 else ">"
        return f"s + l = {significant(s + longest, 6)} {relation} p + q = {significant(p + q, 6)}"

    @property
    def why_swinging(self) -> str | None:
        """What keeps the input from turning fully, lengths or joints; None where nothing does."""
        stops = tuple(dict.fromkeys(filter(None, self.mechanism.stops)))
        if not stops:
            return None
        if self._four_bar is None or stops != (self._four_bar.joint,):
            return said("{joints} cannot close all the way round", joints=row_said(stops))
        if self._four_bar.margin < 0:
            return self.grashof
        shortest = said(SHORTEST[self._four_bar.shortest])
        return said("{sums}, but the shortest is {shortest}", sums=self.grashof, shortest=shortest)

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the driven angle, or the travel of a slider that drives, goes."""
        return self.mechanism.input_range

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Where an input that does not turn fully turns back: at phase 0, and half a drive period later."""
        first, last = self.mechanism.assembly.path.coordinates(np.array([0.0, math.pi])).tolist()
        return first, last

    @property
    def full_turn(self) -> bool:
        """Whether the input turns fully."""
        return self.mechanism.full_turn

    @property
    def unreached_start(self) -> float | None:
        """The start that is stated, where the input swings and does not come to it; else None."""
        start = self.mechanism.linkage.drive.stated_start
        return None if start is None or self.full_turn or self.mechanism.comes_to(start) else start

    @property
    def kept(self) -> tuple[float, ...]:
        """The ends of an input that swings at which it comes back on the same closures."""
        ends = zip(self.input_range, self.mechanism.keeps, strict=True)
        return tuple(end for end, kept in ends if kept)

    @property
    def toggles(self) -> tuple[float, ...]:
        """The input's places at its limits, without an end at which it merely turns back."""
        path, touched = self.mechanism.assembly.path, tuple(self.mechanism.assembly.change_points)
        ends = (end for end in path.dead_ends if any(path.same(coordinate, end) for coordinate in touched))
        return (*path.limits, *ends)

    @cached_property
    def change_points(self) -> tuple[float, ...]:
        """The input's places at its change points, angles within one turn, each once, the least first."""
        path, touched = self.mechanism.assembly.path, self.mechanism.assembly.change_points
        return path.distinct(
            coordinate
            for coordinate in touched
            if not any(path.same(coordinate, end) for end in path.dead_ends)
        )

    @property
    def circuits(self) -> int | None:
        """How many separate motions the lengths allow, two for Grashof; None for more than one four-bar."""
        if self._four_bar is None or len(self.mechanism.assembly.loops) != 1:
            return None
        return 2 if self._four_bar.margin > 0 else 1

    @property
    def true_period(self) -> int:
        """The drive periods after which every joint is back."""
        return self.mechanism.periods

    @property
    def period_seconds(self) -> float:
        """The true period at the drive's speed, s."""
        return 2 * math.pi * self.mechanism.periods / abs(self.mechanism.linkage.drive.speed)

    @cached_property
    def transmission(self) -> Transmission | None:
        """The worst transmission angle, where it is, and the best; None where there is none."""
        return transmission(self.mechanism)

    @property
    def transmission_angle(self) -> tuple[float, float] | None:
        """The least and the greatest transmission angle, 90° at the most; None where there is none."""
        return self.transmission and self.transmission[:2]

    @property
    def stroke(self) -> float | None:
        """The output slider's stroke; None without a slider."""
        return self._slider.stroke if self._slider else None

    @property
    def time_ratio(self) -> float | None:
        """The time of the output's slow stroke over its quick one's; None without a slider or a rocker."""
        stroke = self.swing or self._slider
        return stroke.time_ratio if stroke else None

    @property
    def output_name(self) -> str:
        """What the output is called within a sentence, "the rocker"; empty without one."""
        body = output_body(self.mechanism.linkage)
        return phrase(body, self.link_names) if body else ""

    @property
    def dead_centres(self) -> tuple[float, float] | None:
        """Phases of the output slider's dead centres, back and then forward; None where it rests."""
        return self._slider.dead_centres if self._slider else None

    @cached_property
    def counts(self) -> Counts:
        """How many links, the ground among them, and joints there are, and the mobility by Grübler."""
        linkage = self.mechanism.linkage
        links, joints = links_and_joints(linkage)
        meshes = sum(bool(crank.gear and not crank.gear.motor) for crank in linkage.cranks)
        if group := group_of(linkage):
            meshes += sum(not gear.motor for gear in group.own_gears)
        return Counts(links, joints, 3 * (links - 1) - 2 * joints - meshes)

    @cached_property
    def swing(self) -> _ToAndFro | None:
        """How far the output rocker swings (rad), and its time ratio; None where it does not."""
        body = output_body(self.mechanism.linkage)
        if body is None or body.slider is not None or body.name in self.turning_links:
            return None
        swing = _to_and_fro(self.mechanism, body.name, "angle", "angular_velocity")
        return swing if swing.stroke else None

    @cached_property
    def demand(self) -> Demand | None:
        """What a true period at the drive's speed asks of the input; None where nothing has force or mass."""
        if not self.mechanism.linkage.forceful:
            return None
        return demand(self._driven, self.mechanism.phases)

    @cached_property
    def surplus(self) -> float | None:
        """The work (J) that a flywheel has to store; None where the input does not turn fully or is free."""
        if not (self.full_turn and self.mechanism.linkage.forceful):
            return None
        return surplus(self._driven, self.mechanism.phases)

    @cached_property
    def usual_effort(self) -> float | None:
        """The median size of the effort at the input over time; None where `demand` is None."""
        if not self.mechanism.linkage.forceful:
            return None
        return usual_effort(self._driven, self.mechanism.phases)

    def _driven(self, phases: Array) -> Motion:
        """Return the motion at the drive's speed."""
        return self.mechanism.solve(phase=phases, speed=self.mechanism.linkage.drive.speed)

    @property
    def effort(self) -> tuple[str, str]:
        """What the input delivers, torque or force, and its unit."""
        return self.mechanism.linkage.drive.actuator.effort

    @cached_property
    def turning_links(self) -> tuple[str, ...]:
        """The bodies that turn fully over one true period."""
        return turning_bodies(self.mechanism)

    @cached_property
    def link_names(self) -> Mapping[str, str]:
        """What each body is called by what it does, by the name that it has in the scene."""
        return link_names(self.mechanism, lambda: self.turning_links)

    @cached_property
    def input_name(self) -> str:
        """What the driven bar is called: "crank" if it turns, the slider where one drives.

        One that swings goes by its name in the scene; named crank it is the rocker, or the input rocker.
        """
        body, noun = self.mechanism.linkage.driven.body, self.mechanism.linkage.drive.actuator.noun
        if noun is not None:
            return noun
        if self.full_turn:
            return "crank"
        return self.link_names[body.name] if body and not body.name.isdecimal() else "rocker"

    @property
    def input_said(self) -> str:
        """What the driven bar is called, in the language that is spoken."""
        return name_said(self.input_name)

    @property
    def coordinate_said(self) -> str:
        """What the input's coordinate is called, in the language that is spoken: "crank angle"."""
        if self.mechanism.linkage.drive.coordinate.is_angle:
            return said("{link} angle", link=self.input_said)
        return said("{link} travel", link=self.input_said)

    @property
    def motion_said(self) -> str:
        """What the input does: "The crank turns fully"."""
        return said("The {link} {moves}", link=self.input_said, moves=self.motion_words)

    @property
    def input_words(self) -> str:
        """How far the input goes, in words, and how far from another start."""
        drive = self.mechanism.linkage.drive
        if self.full_turn or not drive.coordinate.is_angle:
            return self.motion_words
        return said(drive.actuator.moves, ends=self.ranges("{}…{}", degrees))

    @property
    def motion_words(self) -> str:
        """How far the input goes, in words; at hand at once."""
        moves = self.mechanism.linkage.drive.actuator.moves
        return (
            said("turns fully") if self.full_turn else said(moves, ends=_places(self, self.input_range, "…"))
        )

    def ranges(self, form: str, end: Callable[[float], str]) -> str:
        """Return the input's range in words, and those that it has when it starts elsewhere.

        `form` stands for a range, with `{}` for each of its two ends, and `end` puts an end in words.
        """
        ranges = (self.input_range, *self.mechanism.other_ranges)
        own, *others = (form.format(*map(end, ends)) for ends in ranges)
        if not others:
            return own
        joined = said_as("list", " or ").join(others)
        return said("{range}, and {others} where its start lies there", range=own, others=joined)

    @cached_as_said
    def lines(self) -> tuple[tuple[str, str], ...]:
        """Label and value of each fact, in words; the labels are English, and said where they are shown."""
        return tuple((label, value) for label, value in _facts(self) if value)

    @cached_property
    def _four_bar(self) -> FourBar | None:
        return four_bar_of(self.mechanism)

    @cached_property
    def _slider(self) -> _ToAndFro | None:
        slider = output_slider(self.mechanism.linkage)
        return _to_and_fro(self.mechanism, slider.name, "travel", "travel_velocity") if slider else None


class Counts(NamedTuple):
    """Links, the ground among them, joints of two links each, M = 3 (links - 1) - 2 joints - gear meshes."""

    links: int
    joints: int
    mobility: int


_AWAY, _FLAT = 0.1, 1e-5
"""A rate beside a place of less than `_FLAT` times that at `_AWAY` from it has a multiple zero there."""


class _ToAndFro(NamedTuple):
    """How a slider or rocker goes to and fro: its time ratio and the phases of its dead centres.

    Time ratio and phases are None where it rests.
    """

    stroke: float
    time_ratio: float | None
    dead_centres: tuple[float, float] | None


def _to_and_fro(mechanism: Mechanism, name: str, place: str, rate: str) -> _ToAndFro:
    """Return how a body goes to and fro; its time ratio is the slow stroke's time over the quick stroke's.

    In a longer true period it goes to and fro more than once: each stroke ends at the next dead centre.
    """
    whole = 2 * math.pi * mechanism.periods
    samples = mechanism.sampled
    if _rests(mechanism, name, rate, samples):
        return _ToAndFro(0.0, None, None)
    turning = reversals(mechanism, name, rate, samples)
    # Dead centres stand among the samples, along which an angle is continuous.
    order = np.argsort(np.concatenate((turning, samples)))
    phases = np.concatenate((turning, samples))[order]
    along = getattr(mechanism.solve(phase=phases, speed=1.0, derivatives=0), place)[name]
    travel = along[np.argsort(order)[: len(turning)]]
    if not len(travel):
        return _ToAndFro(0.0, None, None)
    span = float(np.ptp(travel))
    near = SAME_PLACE * span
    backs, forwards = (turning[np.abs(travel - end) <= near] for end in (travel.min(), travel.max()))
    forth = (forwards - backs[:, None]) % whole
    row, column = np.unravel_index(int(forth.argmin()), forth.shape)
    lasting = float(forth.min()), float(((backs - forwards[:, None]) % whole).min())
    return _ToAndFro(span, max(lasting) / min(lasting), (float(backs[row]), float(forwards[column])))


def reversals(mechanism: Mechanism, name: str, rate: str, phases: Array) -> Array:
    """Return the phases, between those given, at which a body turns back; `rate` names its rate in a motion.

    Where the input turns back and everything with it, that is at a multiple of π. Where a toggle is straight
    just as its driver turns back, the body's own rate vanishes as a third power, and gives the place to a
    third of its digits only: the rate of the driver gives it to all of them.
    """

    def turning(near: Array) -> Array:
        return np.asarray(getattr(mechanism.solve(phase=near, speed=1.0, derivatives=1), rate)[name])

    phases_of_rest = sign_changes(turning, phases)
    if not mechanism.full_turn:
        stops, ends = mechanism.stops or ("", ""), np.rint(phases_of_rest / math.pi)
        all_turns = [kept or not stop for kept, stop in zip(mechanism.keeps, stops, strict=True)]
        near = np.abs(phases_of_rest - math.pi * ends) < TURNING_WITH_IT
        phases_of_rest = np.where(near & np.where(ends % 2, *all_turns[::-1]), math.pi * ends, phases_of_rest)
    near, *far = (np.abs(turning(phases_of_rest + way)) for way in (TURNING_WITH_IT, _AWAY, -_AWAY))
    flat = near <= _FLAT * np.maximum(*far)
    return np.array(
        [_steepest(mechanism, at) if level else at for at, level in zip(phases_of_rest, flat, strict=True)]
    )


def _steepest(mechanism: Mechanism, phase: float) -> float:
    """Return the phase beside a place at which the body with the steepest rate turns back, else the place."""

    def turning(near: Array) -> Mapping[str, Array]:
        return mechanism.solve(phase=near, speed=1.0, derivatives=1).angular_velocity

    around = phase + TURNING_WITH_IT * np.array([-1.0, 1.0])
    steps = {
        name: float(rate[1] - rate[0]) for name, rate in turning(around).items() if rate[0] * rate[1] < 0
    }
    if not steps:
        return phase
    steepest = max(steps, key=lambda name: abs(steps[name]))
    at = float(sign_changes(lambda near: turning(near)[steepest], around)[0])
    return at if abs(at - phase) < NO_WAY else phase


def _rests(mechanism: Mechanism, name: str, rate: str, phases: Array) -> bool:
    """Return whether a body stands still all along, rounding errors aside."""
    for part in in_blocks(phases):
        motion = mechanism.solve(phase=part, speed=1.0, derivatives=1)
        unit = "{}/s" if rate.startswith("travel") else "rad/s"
        if np.any(as_output(motion, getattr(motion, rate)[name], unit, 1)):
            return False
    return True


def _facts(info: Info) -> Iterator[tuple[str, str | None]]:
    """Yield label and value of each fact, in words; None where there is none."""
    links, joints, mobility = info.counts
    turning = (info.link_names[name] for name in info.turning_links)
    yield "class", info.class_said
    counts = {"links": links, "joints": joints, "mobility": mobility}
    yield "links, joints", said("{links}, {joints}; mobility {mobility}", **counts)
    yield "groups", _groups(info.mechanism.linkage)
    yield "solved together", _together(info)
    yield "Grashof", info.grashof
    yield "input", info.input_words
    start = info.unreached_start
    yield "start", None if start is None else said("{angle} is not reached", angle=degrees(start))
    yield "returns", _returns(info)
    yield "turns fully", said_as("list", ", ").join(map(_link_said, turning))
    yield "toggles at", _places(info, info.toggles)
    yield "change points", _places(info, info.change_points)
    yield "circuits", str(info.circuits or "")
    yield "transmission angle", info.transmission and _worst(info, info.transmission)
    yield "stroke", None if info.stroke is None else f"{significant(info.stroke, 6)} {info.length_unit}"
    yield (
        "swing",
        info.swing and said("{angle} of {link}", angle=degrees(info.swing.stroke), link=info.output_name),
    )
    yield "time ratio", None if info.time_ratio is None else f"{info.time_ratio:.4f}"
    if info.demand is not None:
        (work, *efforts), (name, unit) = info.demand, info.effort
        yield "work per period", f"{typeset(significant(work, 6))} J"
        unbounded = said("undefined, since the {effort} is unbounded at a limit", effort=said(name))
        unknown = (said("unbounded"), unbounded)
        for word, value, without in zip(("peak", "mean"), efforts, unknown, strict=True):
            yield f"{word} {name}", without if value is None else f"{typeset(significant(value, 6))} {unit}"
    turns = said_many("one drive period", "{count} drive periods", info.true_period)
    yield "true period", said("{periods}, {time} s", periods=turns, time=short(info.period_seconds))


FACTS = (
    to_say("class"),
    to_say("links, joints"),
    to_say("groups"),
    to_say("solved together"),
    to_say("Grashof"),
    to_say("input"),
    to_say("start"),
    to_say("returns"),
    to_say("turns fully"),
    to_say("toggles at"),
    to_say("change points"),
    to_say("circuits"),
    to_say("transmission angle"),
    to_say("stroke"),
    to_say("swing"),
    to_say("time ratio"),
    to_say("work per period"),
    to_say("peak torque"),
    to_say("mean torque"),
    to_say("peak force"),
    to_say("mean force"),
    to_say("true period"),
)
"""The labels of facts, to be said where they are shown."""


def _link_said(name: str) -> str:
    return said("link {name}", name=name) if name.isdecimal() else name_said(name)


def _worst(info: Info, transmission: Transmission) -> str:
    """Return the least transmission angle in words, its dyad and where the input is then."""
    known = {"angle": significant(math.degrees(transmission.least), 3), "joint": transmission.dyad}
    if transmission.greatest - transmission.least <= SAME_PLACE:
        return said("μ = {angle}° at {joint}, all the way", **known)
    linkage = info.mechanism.linkage
    coordinate = float(info.mechanism.solve(phase=transmission.phase, speed=1.0, derivatives=0).coordinate)
    if not linkage.drive.coordinate.is_angle:
        where = f"{typeset(significant(coordinate, 4))} {info.length_unit}"
    else:
        turned = round(math.degrees(coordinate), 1) % 360 if info.full_turn else math.degrees(coordinate)
        told = significant(turned, 3)
        where = "0°" if info.full_turn and told == "360" else f"{typeset(told)}°"
    symbol = input_symbol(linkage).translate({ord("{"): None, ord("}"): None})
    return said("μ ≥ {angle}° at {joint}, {place}", **known, place=f"{symbol} = {where}")


def _groups(linkage: Linkage) -> str | None:
    """Return the dyads in the order in which they are solved, by their kinds; None of fewer than two."""
    dyads = [joint for joint in linkage.joints if joint.dyad and not joint.grouped]
    kinds = (f"{joint.name} ({type(joint).__name__})" for joint in dyads)
    return said("dyads {kinds}", kinds=", ".join(kinds)) if len(dyads) > 1 else None


def _together(info: Info) -> str | None:
    """Return the links that can only be solved together; None of a chain of dyads."""
    group = group_of(info.mechanism.linkage)
    return None if group is None else ", ".join(name_said(member.name) for member in group.free)


def _returns(info: Info) -> str | None:
    """Return where and why an input that swings comes back on the same closures, in words."""
    if not info.kept:
        return None
    if info.mechanism.linkage.drive.retraced:
        return said("on the same closure; velocities change sign at the limits")
    if info.mechanism.retraced:
        return said(
            "on the same closure, as beyond the limits its links do not close on the whole swing; "
            "velocities change sign there"
        )
    return said(
        "on the same closure at {places}, as beyond it its links do not close on the whole swing; "
        "velocities change sign there",
        places=_places(info, info.kept),
    )


def _places(info: Info, places: tuple[float, ...], between: str = ", ") -> str:
    """Return places of the input in words: its angles, or how far a slider has travelled; "" for none."""
    if info.mechanism.linkage.drive.coordinate.is_angle:
        return between.join(map(degrees, places))
    travels = (typeset(significant(place, 6)) for place in places)
    return f"{between.join(travels)} {info.length_unit}" if places else ""
