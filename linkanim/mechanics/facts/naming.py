"""What a linkage is called: by the lengths of its four-bars, its dyads, its gears and what drives it."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.closing.kinds import CLOSERS
from linkanim.mechanics.closing.search import in_blocks
from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.linkage.dyads import RRR
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Body, Linkage
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.mechanics.loops.roots import Kind
from linkanim.mechanics.motion.measures import pivots_of
from linkanim.mechanics.motion.mechanism import Mechanism

_EACH_NAMED = 4
"""Up to this many four-bars in a row each is named, beyond that only the first."""
TRIPLE_ROCKERS = {
    "ground": "outward/outward",
    "input": "outward/inward",
    "output": "inward/outward",
    "coupler": "inward/inward",
}
GRASHOF = {
    "ground": "drag-link (double crank)",
    "input": "crank-rocker",
    "output": "crank-rocker driven at its rocker",
    "coupler": "double-rocker",
}

_PARTS = re.compile(r"(crank|rocker|coupler|drag)\d*")
"""The names of bodies that say what they do."""
_ORDINALS = {2: "second", 3: "third"}
_ENDINGS = {1: "st", 2: "nd", 3: "rd"}


@dataclass(frozen=True)
class FourBar:
    """The four links of a four-bar by their part, seen from its input, and which of two closures it has.

    `joint` is the one in which coupler and output meet.
    """

    joint: str
    links: Mapping[str, float]
    sign: int
    change_points: int

    @property
    def shortest(self) -> str:
        """The part of the shortest link, the output as the link that it drives."""
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
    dyads = [joint for joint in linkage.joints if joint.dyad]
    geared = any(crank.gear for crank in linkage.cranks)
    slider = " with slider" if any(joint.travels for joint in dyads) else ""
    if geared and any(isinstance(joint, RRR) for joint in dyads):
        return f"geared five-bar{slider}"
    if four_bar is not None:
        name = _four_bar_name(four_bar)
        return name if len(dyads) == 1 else f"{_bars(len(dyads))}: {name}{_rest(mechanism, len(dyads))}"
    if not dyads:
        return _cranks_name(linkage)
    if linkage.drive.actuator.noun is not None:
        return _driven_name(linkage, dyads, linkage.drive.actuator.noun)
    own = CLOSERS[type(dyads[0])].name(dyads[0], mechanism.assembly) if len(dyads) == 1 else None
    return own or f"{_bars(len(dyads))} linkage{slider}"


def _driven_name(linkage: Linkage, dyads: list[Joint], noun: str) -> str:
    """Name a linkage by what drives it where that is no crank."""
    first = dyads[0]
    ends = set(first.ends) if isinstance(first, RRR) else set()
    cranked = linkage.drive.joint in ends and any(pin.name in ends for pin in linkage.pins)
    if cranked and len(dyads) == 1:
        return f"slider-crank driven at its {noun}"
    return f"{_bars(len(dyads))} linkage driven by a {noun}"


def _cranks_name(linkage: Linkage) -> str:
    """Name a linkage without dyads by how its cranks turn."""
    if linkage.drive.actuator.linkage_name is not None:
        return linkage.drive.actuator.linkage_name
    geared = [crank for crank in linkage.cranks if crank.gear]
    if any(not linkage.joint(crank.pivot).fixed for crank in geared):
        return "epicyclic gear train"
    return "geared cranks" if geared else "crank"


def _bars(dyads: int) -> str:
    """Name the linkage by its links: ground, crank and two for each dyad."""
    return {1: "four-bar", 2: "six-bar", 3: "eight-bar"}.get(dyads, f"{2 * dyads + 2}-bar")


def _rest(mechanism: Mechanism, dyads: int) -> str:
    """Name the loops after the first, as far as they are four-bars; else say how many dyads follow."""
    if dyads <= _EACH_NAMED:
        further = [_four_bar_name(bar) for bar in _further_loops(mechanism)]
        if len(further) == dyads - 1:
            return "".join(f", then {name}" for name in further)
    return " and a second dyad" if dyads == 2 else f" and {dyads - 1} further dyads"


def _further_loops(mechanism: Mechanism) -> Iterator[FourBar]:
    """Yield the four-bars down the chain: dyads between a fixed pin and one that turns about a fixed pin.

    Their sign tells a parallelogram, whose coupler keeps along the ground, from an antiparallelogram.
    """
    linkage = mechanism.linkage
    cycle = mechanism.solve(phase=in_blocks(mechanism.phases)[0], speed=1.0, derivatives=0)
    pins = {pin.name: complex(*pin.position) for pin in linkage.pins}
    for joint in linkage.joints:
        if not isinstance(joint, RRR) or joint.name in mechanism.assembly.loops:
            continue
        for (moving, fixed), (a, b) in ((joint.ends, joint.lengths), (joint.ends[::-1], joint.lengths[::-1])):
            pivot, crank = _turns_about(linkage, moving)
            if fixed in pins and pivot is not None:
                ground = abs(pins[fixed] - pins[pivot])
                along = cycle.position[joint.name] - cycle.position[moving]
                apart = along - (cycle.position[fixed] - cycle.position[pivot])
                sign = 1 if np.abs(apart).max() <= 1e-6 * ground else -1
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
    """Return how many change points the lengths have, each of them rounded: to 1e-12 of the perimeter."""
    least = 1e-12 * (g + r + a + b)
    return int(abs(a + b - g - r) <= least) + int(min(abs(g - r - a + b), abs(g - r + a - b)) <= least)


def _four_bar_name(bar: FourBar) -> str:
    if bar.change_points:
        return _change_point_name(bar)
    if bar.margin > 0:
        return "Grashof " + GRASHOF[_part(bar, min)]
    return f"triple-rocker ({TRIPLE_ROCKERS[_part(bar, max)]})"


def _part(bar: FourBar, pick: Callable[..., str]) -> str:
    """Return the part of the shortest (min) or longest (max) link."""
    return pick(bar.links, key=lambda part: bar.links[part])


def _change_point_name(bar: FourBar) -> str:
    g, r, a, b = bar.links.values()
    same = partial(math.isclose, rel_tol=1e-15)
    if same(g, a) and same(r, b):
        return "parallelogram" if bar.sign > 0 else "antiparallelogram"
    if (same(g, r) and same(a, b)) or (same(g, b) and same(a, r)):
        return "kite (change point)"
    return "change-point " + GRASHOF[_part(bar, min)]


def turning_bodies(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the bodies that turn fully over one true period: a crank with the input, another as it winds."""
    linkage, full_turn = mechanism.linkage, mechanism.assembly.path.full_turn
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
        places = mechanism.solve(phase=part, speed=1.0, derivatives=0).position
        ways = np.stack([places[body.joints[1]] - places[body.joints[0]] for body in bodies])
        gone += _crossings(np.concatenate([last, ways], axis=1))
        first, last = first if first.size else ways[:, :1], ways[:, -1:]
    gone += _crossings(np.concatenate([last, first], axis=1))
    return [bool(one) for one in gone]


def _crossings(ways: Array) -> NDArray[np.intp]:
    """Return how often directions (D, N, 2) cross the x axis ahead to the left, less how often back."""
    (x, x1), (y, y1) = ((ways[:, :-1, n], ways[:, 1:, n]) for n in (0, 1))
    below, left = y < 0, x * y1 > y * x1
    up, down = below & left & (y1 >= 0), ~below & ~left & (y1 < 0)
    return np.asarray(np.count_nonzero(up, axis=1) - np.count_nonzero(down, axis=1))


def link_names(mechanism: Mechanism, turning: Collection[str]) -> dict[str, str]:
    """Return what each body is called: one that a scene names crank, rocker or coupler by what it does.

    `turning` are those that turn fully. A crank turns fully about a fixed pin, a rocker swings about one, a
    coupler has none. Of cranks the input is the crank, others are driven cranks; of rockers the input is the
    input rocker. Further ones of a sort are counted: second coupler. Every other name stays.
    """
    full_turn = mechanism.assembly.path.full_turn
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


def _part_of(mechanism: Mechanism, body: Body, turning: Collection[str]) -> tuple[str | None, bool]:
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
    turns = mechanism.assembly.path.full_turn if drives else body.name in turning
    return "crank" if turns else "rocker", drives


def _counted(words: str, number: int) -> str:
    if number == 1:
        return words
    ending = "th" if number // 10 % 10 == 1 else _ENDINGS.get(number % 10, "th")
    return f"{_ORDINALS.get(number, f'{number}{ending}')} {words}"
