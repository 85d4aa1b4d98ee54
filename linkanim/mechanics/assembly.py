"""How a linkage is put together: its loops' roots, how far the input goes, which closure holds.

The values here are found once for a linkage; every pose is computed from them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

from linkanim.errors import AssemblyError

from .clock import Clock, Half
from .exact import FULL_TURN, HALF_TURN, Sum, exact_angle, quarter_turns, unit
from .linkage import RPR, RRP, RRR, Crank, Joint, Linkage, Pin
from .planar import Slope, Vec
from .roots import Kind, LoopRoot, four_bar_root, slider_root, slot_root
from .signed import SignedRoot, sharpened, sign_of_root, signed_root, swinging

STRAIGHT = Sum(0.0)


@dataclass(frozen=True, slots=True)
class Gearing:
    """How a crank turns with the input: angle = ratio × θ + offset."""

    ratio: Fraction = Fraction(1)
    offset: Sum = STRAIGHT


@dataclass(frozen=True, slots=True)
class Ground:
    """The ground link between two fixed pins: length, direction, and the angle of that direction."""

    length: float
    direction: Vec
    angle: Sum


@dataclass(frozen=True, slots=True)
class Turn:
    """The input turns fully from `start`; every joint is back after `turns` turns.

    `rounds` is how often that takes to bring back a chain that passes a change point.
    """

    start: float
    turns: int
    rounds: int = 1

    @property
    def periods(self) -> int:
        """The number of turns after which every joint is back."""
        return self.turns * self.rounds


@dataclass(frozen=True, slots=True)
class Swing:
    """The input swings between two limits; `ends` names the dyad that limits it at each.

    An end without a name is no limit: the input turns back there, and every closure holds.
    `repeats` is the number of turns of the input after which the linkage would be the same (more
    than one with gears).
    """

    low: Sum
    high: Sum
    ends: tuple[str, str]
    repeats: int = 1
    rounds: int = 1

    @property
    def periods(self) -> int:
        """One there-and-back; two where a different dyad changes its closure at each end."""
        return self.rounds if self.ends[0] == self.ends[1] else 2 * self.rounds

    @property
    def middle(self) -> Sum:
        """The angle in the middle of the swing."""
        return (self.low + self.high).times(0.5)

    @property
    def amplitude(self) -> float:
        """Half the angle of the swing."""
        return float((self.high - self.low).times(0.5))


Path = Turn | Swing


@dataclass(frozen=True, slots=True)
class Loop:
    """A dyad closed from the crank pin `pin` (of the crank `crank`) and fixed elements.

    `ground` runs from the crank's pivot to the fixed pin; None for a line of travel.
    `swapped` says that the dyad names the fixed pin first.
    """

    pin: str
    crank: Crank
    gearing: Gearing
    ground: Ground | None
    root: LoopRoot
    swapped: bool = False

    def closed(self, clock: Clock, path: Path, pace: Slope) -> tuple[SignedRoot, Half]:
        """Return the loop's root and ψ/2 at the clock's instant, ψ running at `pace`."""
        half = self._half(clock)
        swing = swinging(clock, path.low, path.high) if isinstance(path, Swing) else None
        half = sharpened(self.root, half, swing)
        return signed_root(self.root, half, pace, swing), half

    def sign(self, clock: Clock) -> int:
        """Return the sign of the loop's root at an instant between its limits, in plain floats."""
        return sign_of_root(self.root, self._half(clock))

    def _half(self, clock: Clock) -> Half:
        return clock.half(self.root.reference - self.gearing.offset, self.gearing.ratio)


@dataclass(frozen=True, slots=True)
class Arc:
    """A range of the input that one dyad, or several, leave open."""

    low: Sum
    high: Sum
    ends: tuple[str, str]

    def shifted(self, turns: int) -> Arc:
        """Return the same range that many turns on."""
        way = FULL_TURN.times(float(turns))
        return Arc(self.low + way, self.high + way, self.ends)


def gearings(linkage: Linkage) -> dict[str, Gearing]:
    """Map each crank's pin to how it turns with the input; AssemblyError where it does not."""
    found = {linkage.drive.joint: Gearing()}
    for crank in linkage.cranks:
        if crank.name in found:
            continue
        if crank.gear is None or crank.gear.driver not in found:
            raise AssemblyError(
                f"joint {crank.name}: this crank turns with nothing; "
                f'give it a gear, gear = {{ with = "{linkage.drive.joint}", ratio = -1 }}'
            )
        driver = found[crank.gear.driver]
        offset = driver.offset * crank.gear.ratio + exact_angle(crank.gear.offset)
        found[crank.name] = Gearing(driver.ratio * crank.gear.ratio, offset)
    return found


def ground_between(linkage: Linkage, start: str, end: str) -> Ground:
    """Return the ground link from one fixed pin to another, as exactly as it was written."""
    first, second = linkage.joint(start), linkage.joint(end)
    assert isinstance(first, Pin)
    assert isinstance(second, Pin)
    if _written_from(second, first):
        return _written(second, turned=False)
    if _written_from(first, second):
        return _written(first, turned=True)
    dx, dy = second.position[0] - first.position[0], second.position[1] - first.position[1]
    length = math.hypot(dx, dy)
    if length == 0:
        return Ground(0.0, Vec(1.0, 0.0), Sum(0.0))
    return Ground(length, Vec(dx / length, dy / length), exact_angle(math.atan2(dy, dx)))


def _written_from(pin: Pin, base: Pin) -> bool:
    """Tell whether the pin was written as a length at an angle from the other."""
    if pin.polar is None:
        return False
    return pin.polar.base == base.name or (pin.polar.base is None and base.position == (0.0, 0.0))


def _written(pin: Pin, *, turned: bool) -> Ground:
    assert pin.polar is not None
    direction = Vec(*unit(pin.polar.angle))
    angle = exact_angle(pin.polar.angle)
    if turned:
        return Ground(pin.polar.length, -direction, angle + HALF_TURN)
    return Ground(pin.polar.length, direction, angle)


def find_loops(linkage: Linkage) -> dict[str, Loop]:
    """Return the dyads that close from a crank pin against something fixed, by the joint's name.

    A loop that limits a geared crank is left to the general closure.
    """
    gears = gearings(linkage)
    loops = {}
    for joint in linkage.joints:
        loop = _loop(linkage, joint, gears)
        if loop is not None and (loop.pin == linkage.drive.joint or not _limits(loop)):
            loops[joint.name] = loop
    return loops


def _limits(loop: Loop) -> bool:
    return Kind.LIMIT in (loop.root.u.kind, loop.root.w.kind)


def _loop(linkage: Linkage, joint: Joint, gears: Mapping[str, Gearing]) -> Loop | None:
    match joint:
        case RRR():
            return _pin_loop(linkage, joint, gears)
        case RRP() if joint.end in gears:
            return _slider_loop(linkage, joint, gears[joint.end])
        case RPR() if joint.through in gears:
            return _slot_loop(linkage, joint, gears[joint.through])
        case _:
            return None


T = TypeVar("T")


def _reversed(pair: tuple[T, T]) -> tuple[T, T]:
    return pair[1], pair[0]


def _pin_loop(linkage: Linkage, joint: RRR, gears: Mapping[str, Gearing]) -> Loop | None:
    for swapped in (False, True):
        ends, lengths = joint.ends, joint.lengths
        if swapped:
            ends, lengths = _reversed(ends), _reversed(lengths)
        if ends[0] in gears and isinstance(linkage.joint(ends[1]), Pin):
            crank = _crank(linkage, ends[0])
            ground = ground_between(linkage, crank.pivot, ends[1])
            if ground.length == 0:
                return None
            root = four_bar_root(ground.length, crank.length, lengths, ground.angle)
            return Loop(ends[0], crank, gears[ends[0]], ground, root, swapped)
    return None


def _slider_loop(linkage: Linkage, joint: RRP, gearing: Gearing) -> Loop:
    crank = _crank(linkage, joint.end)
    pivot, through = linkage.joint(crank.pivot), linkage.joint(joint.line.through)
    assert isinstance(pivot, Pin)
    assert isinstance(through, Pin)
    along = unit(joint.line.angle)
    dx, dy = pivot.position[0] - through.position[0], pivot.position[1] - through.position[1]
    eccentricity = dy * along[0] - dx * along[1] - joint.line.offset
    reference = exact_angle(joint.line.angle) - quarter_turns(1)
    root = slider_root(crank.length, joint.length, eccentricity, reference)
    return Loop(joint.end, crank, gearing, None, root)


def _slot_loop(linkage: Linkage, joint: RPR, gearing: Gearing) -> Loop | None:
    crank = _crank(linkage, joint.through)
    ground = ground_between(linkage, crank.pivot, joint.pivot)
    if ground.length == 0:
        return None
    root = slot_root(ground.length, crank.length, joint.offset, ground.angle)
    return Loop(joint.through, crank, gearing, ground, root)


def _crank(linkage: Linkage, name: str) -> Crank:
    joint = linkage.joint(name)
    assert isinstance(joint, Crank)
    return joint


def open_arcs(linkage: Linkage, loops: Mapping[str, Loop]) -> list[Arc] | None:
    """Return the ranges of the input that the loops on its own pin leave open; None for a full turn.

    AssemblyError where a loop cannot be closed at any angle, or the loops leave no common range.
    """
    arcs: list[Arc] | None = None
    for name, loop in loops.items():
        if loop.pin == linkage.drive.joint:
            own = _arcs(linkage, name, loop.root)
            arcs = own if arcs is None else arcs if own is None else list(_common(arcs, own))
            if arcs == []:
                raise AssemblyError(f"joint {name}: the bars of the linkage leave its input no common range")
    return arcs


def _arcs(linkage: Linkage, name: str, root: LoopRoot) -> list[Arc] | None:
    """Return the open ranges of one loop in the crank's own angle."""
    if min(root.u.most, root.w.most) == 0:
        raise AssemblyError(
            f"joint {name}: it can be put together at one angle of the input only, so that nothing "
            "could move; make one length a little longer or shorter"
        )
    if min(root.u.most, root.w.most) < 0:
        raise AssemblyError(f"joint {name}: {why_apart(linkage, name)}")
    ends, reference = (name, name), root.reference
    u_limits, w_limits = root.u.kind is Kind.LIMIT, root.w.kind is Kind.LIMIT
    if u_limits and w_limits:
        inner, outer = root.w.short, root.u.reach
        above = Arc(reference + inner, reference + outer, ends)
        return [above, Arc(reference - outer, reference - inner, ends)]
    if u_limits:
        return [Arc(reference - root.u.reach, reference + root.u.reach, ends)]
    if w_limits:
        middle = reference + HALF_TURN
        return [Arc(middle - root.w.reach, middle + root.w.reach, ends)]
    return None


def _common(first: list[Arc], second: list[Arc]) -> Iterator[Arc]:
    """Yield the ranges that both lists leave open, the input's angle being the same every turn."""
    for a in first:
        for b in second:
            for turns in (-1, 0, 1):
                moved = b.shifted(turns)
                low, low_end = max((a.low, a.ends[0]), (moved.low, moved.ends[0]), key=_size)
                high, high_end = min((a.high, a.ends[1]), (moved.high, moved.ends[1]), key=_size)
                if float(high - low) > 0:
                    yield Arc(low, high, (low_end, high_end))


def _size(end: tuple[Sum, str]) -> tuple[float, float]:
    return end[0].high, end[0].low


def why_apart(linkage: Linkage, name: str) -> str:
    """Say in words and numbers why the bars of a dyad cannot be assembled at any angle of the input."""
    joint = linkage.joint(name)
    match joint:
        case RRR():
            a, b = joint.lengths
            return (
                f"the bars of {a:g} and {b:g} cannot meet at any angle of the input: the pins "
                f"{joint.ends[0]} and {joint.ends[1]} are never {abs(a - b):g} to {a + b:g} apart"
            )
        case RRP():
            return (
                f"the bar of {joint.length:g} cannot reach its line of travel from {joint.end} "
                "at any angle of the input; make it longer or the offset smaller"
            )
        case RPR():
            return (
                f"the slot's offset {joint.offset:g} is more than the pin {joint.through} is ever away "
                f"from {joint.pivot}; make it smaller"
            )
        case _:
            return "it cannot be assembled"
