"""Random linkages with a joint J of one kind, and how far their motion is from many digits.

Where J stops the input, the limits are found anew from where the solver has them, and J is on its other
closure behind each; where J touches its limit, at a change point, likewise.

`python tests/mechanics/random_joints.py [COUNT]` prints the worst of each kind.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from build import four_bar, with_joints
from chain_reference import places
from mpmath import mp, mpf
from reference import DIGITS, HIGHEST_FIRST, NUDGE, derivatives, sign_of

from linkanim.errors import AssemblyError
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Crank,
    Cylinder,
    Drive,
    DrivenSlider,
    Gear,
    Joint,
    Line,
    Linkage,
    Pin,
    Rigid,
    Travel,
)
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.mechanics.solver.closing import Touch
from linkanim.mechanics.solver.input import Swing, Turn
from linkanim.mechanics.solver.strokes import CylinderStroke

Random = random.Random
Make = Callable[[Random], Linkage]
PHASES = (0.3, 2.1, 4.4, 5.9)
BESIDE = (0.0, 1e-12, 1e-9, -1e-6, 1e-3)
"""How far from a limit the motion is compared, too."""
CLEAR = 1e-3
"""Share of its greatest value that a margin keeps where it does not vanish: nearer, floats lose digits."""


class Error(NamedTuple):
    """How far off positions are, in longest bars, and rates, in their greatest."""

    position: float
    rate: float


def _crank_rocker(rng: Random) -> Linkage:
    base = four_bar((100, rng.uniform(15, 40), rng.uniform(75, 110), rng.uniform(70, 95)))
    return with_joints(base, Pin("S", (rng.uniform(-150, -60), rng.uniform(-40, 40))))


def _with(rng: Random, joint: Joint) -> Linkage:
    """Return a crank-rocker with the joint on it, and a point of the joint's bar where it has one."""
    linkage = with_joints(_crank_rocker(rng), joint)
    if not joint.bars:
        return linkage
    at = rng.uniform(5, 60), rng.uniform(-30, 30)
    return with_joints(linkage, Rigid("K", (joint.bars[0][0], "J"), at))


def bar_to_a_carried_line(rng: Random) -> Linkage:
    body = rng.choice([("A", "B"), ("B", "P")])
    line = Line(rng.choice("AB"), rng.uniform(-3, 3), rng.uniform(-30, 30), body)
    return _with(rng, RRP("J", rng.choice(["O2", "O4"]), rng.uniform(40, 300), line, rng.choice((1, -1))))


def bar_to_a_fixed_line(rng: Random) -> Linkage:
    line = Line(rng.choice(["O2", "S"]), rng.uniform(-3, 3), rng.uniform(-30, 30))
    return _with(rng, RRP("J", rng.choice("BP"), rng.uniform(40, 300), line, rng.choice((1, -1))))


def yoke_on_a_fixed_line(rng: Random) -> Linkage:
    line = Line(rng.choice(["O2", "S"]), rng.uniform(-3, 3), rng.uniform(-30, 30))
    return _with(rng, RPP("J", rng.choice("ABP"), line, rng.uniform(0.5, 2.6)))


def yoke_on_a_carried_line(rng: Random) -> Linkage:
    line = Line("A", rng.uniform(-3, 3), rng.uniform(-30, 30), ("A", "B"))
    return _with(rng, RPP("J", rng.choice(["O2", "O4"]), line, rng.uniform(0.5, 2.6)))


def slot_about_a_moving_joint(rng: Random) -> Linkage:
    return _with(
        rng, RPR("J", rng.choice("BP"), rng.choice(["O2", "A"]), rng.uniform(20, 200), rng.uniform(-60, 60))
    )


def rod_through_a_swivel(rng: Random) -> Linkage:
    return _with(rng, RPR("J", "A", rng.choice(["O4", "S"]), rng.uniform(50, 200), rng.uniform(-20, 20)))


def planet(rng: Random) -> Linkage:
    ratio = Fraction(rng.choice([-3, -2, -1, 2, 3, 5]), rng.choice([1, 1, 2, 3]))
    return _with(rng, Crank("J", rng.choice("ABP"), rng.uniform(5, 40), Gear("A", ratio, rng.uniform(-3, 3))))


def at_a_change_point(rng: Random) -> Linkage:
    """A bar to a carried line that just reaches it where it is furthest away: once or twice a turn."""
    linkage = bar_to_a_carried_line(rng)
    joint, angles = linkage.joint("J"), np.linspace(0, 2 * math.pi, 180, endpoint=False)
    assert isinstance(joint, RRP)
    leans = [float(_lean(linkage, mpf(float(angle)))) for angle in angles]
    peak = _highest(partial(_lean, linkage), mpf(float(angles[int(np.argmax(leans))])), mpf(0.04))
    return _replaced(linkage, replace(joint, length=float(_lean(linkage, peak))))


def bar_that_limits_the_input(rng: Random) -> Linkage:
    """A bar that reaches its line, carried or fixed, over a part of the turn only."""
    linkage = rng.choice([bar_to_a_carried_line, bar_to_a_fixed_line])(rng)
    joint = linkage.joint("J")
    assert isinstance(joint, RRP)
    ways = [abs(_aside(linkage, mpf(float(angle)))) for angle in np.linspace(0, 2 * math.pi, 60)]
    return _replaced(linkage, replace(joint, length=_between(rng, ways)))


def slot_that_limits_the_input(rng: Random) -> Linkage:
    """A slot further off its pivot than the joint in it comes over a part of the turn."""
    linkage = slot_about_a_moving_joint(rng)
    joint = linkage.joint("J")
    assert isinstance(joint, RPR)
    ways = []
    for angle in np.linspace(0, 2 * math.pi, 60):
        at = places(_without_last(linkage), mpf(float(angle)))
        ways.append(abs(at[joint.through] - at[joint.pivot]))
    return _replaced(linkage, replace(joint, offset=rng.choice((1, -1)) * _between(rng, ways)))


def _between(rng: Random, ways: list[Any]) -> float:
    least, most = float(min(ways)), float(max(ways))
    return least + (most - least) * rng.uniform(0.2, 0.8)


def driven_by_a_cylinder(rng: Random) -> Linkage:
    ground, arm = rng.uniform(20, 300), rng.uniform(20, 300)
    low, high = abs(ground - arm), ground + arm
    first, last = (low + (high - low) * rng.uniform(0.02, 0.98) for _ in range(2))
    turn = rng.uniform(-3, 3)
    pins = Pin("O2", (0.0, 0.0)), Pin("G", (ground * math.cos(turn), ground * math.sin(turn)))
    joints = (*pins, Crank("J", "O2", arm), Rigid("K", ("O2", "J"), (rng.uniform(5, 60), 20.0)))
    return Linkage(joints, Drive("J", 1.0, turn + rng.choice((1, -1)), Cylinder(("G", "J"), first, last)))


def driven_by_a_slider(rng: Random) -> Linkage:
    crank, rod, offset = rng.uniform(10, 60), rng.uniform(70, 150), rng.choice([0.0, rng.uniform(-8, 8)])
    far, near = (math.sqrt((rod + way * crank) ** 2 - offset**2) for way in (1, -1))
    shares = [rng.choice([0.0, rng.uniform(0.01, 0.45)]), rng.choice([1.0, rng.uniform(0.55, 0.99)])]
    if offset:
        shares = [min(max(share, 0.01), 0.99) for share in shares]
    first, last = (near + (far - near) * share for share in rng.choice([shares, shares[::-1]]))
    joints = (
        Pin("O2", (0.0, 0.0)),
        DrivenSlider("C", Line("O2", 0.0, offset)),
        RRR("J", ("C", "O2"), (rod, crank), rng.choice((1, -1))),
        Rigid("K", ("C", "J"), (rng.uniform(5, 60), rng.uniform(-30, 30))),
    )
    return Linkage(joints, Drive("C", 1.0, actuator=Travel(first, last)))


DOWN_THE_CHAIN: tuple[Make, ...] = (
    bar_to_a_carried_line,
    bar_to_a_fixed_line,
    at_a_change_point,
    bar_that_limits_the_input,
    slot_that_limits_the_input,
    yoke_on_a_fixed_line,
    yoke_on_a_carried_line,
    slot_about_a_moving_joint,
    rod_through_a_swivel,
    planet,
)
DRIVEN: tuple[Make, ...] = (driven_by_a_cylinder, driven_by_a_slider)


def solved_linkages(make: Make, seed: int = 7) -> Iterator[tuple[Linkage, Mechanism]]:
    """Yield linkages that go together, their margins clear of zero where they do not vanish."""
    rng = Random(seed)
    while True:
        linkage = make(rng)
        try:
            solved = mechanism(linkage)
        except AssemblyError:
            continue
        path = solved.assembly.path
        if isinstance(path, Swing) and set(path.ends) - {"J", ""}:
            continue
        if _clear(linkage, solved):
            yield linkage, solved


def worst(linkage: Linkage, solved: Mechanism) -> Error:
    """Return how far J, and a point K on its bar, are from many digits, beside limits as well."""
    pose, turns = _Exact(linkage, solved), solved.periods
    phases = [phase + 2 * math.pi * turn for phase in PHASES for turn in range(min(turns, 2))]
    phases += [end + way for end in pose.flips for way in BESIDE]
    motion = solved.solve(phase=np.array(phases), speed=1.0)
    cycle = solved.solve(phase=np.linspace(0, 2 * math.pi * turns, 400 * turns), speed=1.0)
    exact = [derivatives(pose.places, mpf(phase) + NUDGE) for phase in phases]
    longest = max(length for joint in linkage.joints for _, length in joint.bars)
    errors: list[list[float]] = [[], []]
    for name in ("J", "K") if "K" in linkage.by_name else ("J",):
        for order, kind in HIGHEST_FIRST:
            size = float(np.hypot(*getattr(cycle, kind)[name].T).max()) if order else longest
            errors[order > 0] += [
                float(abs(mp.mpc(*map(float, row)) - found[order][name])) / size
                for row, found in zip(getattr(motion, kind)[name], exact, strict=True)
            ]
    return Error(max(errors[0]), max(errors[1]))


class _Exact:
    """A linkage's joints at a phase: its input's path, and the sides of J along it, at many digits."""

    def __init__(self, linkage: Linkage, solved: Mechanism) -> None:
        self._linkage, self._path = linkage, solved.assembly.path
        self._travel = _travel(linkage)
        self._side = getattr(linkage.joint("J"), "side", 1)
        root = solved.assembly.chain.get("J")
        touches = [zero.place for zero in root.zeros if isinstance(zero, Touch)] if root else []
        self.flips = [float(place) for place in touches]
        if isinstance(self._path, Swing):
            assert not touches
            self._ends = tuple(
                _limit(linkage, mpf(end.high) + mpf(end.low)) if name == "J" else mpf(end.high) + mpf(end.low)
                for end, name in zip((self._path.low, self._path.high), self._path.ends, strict=True)
            )
            ends = zip((0.0, math.pi), self._path.ends, strict=True)
            self.flips = [phase for phase, name in ends if name == "J"]
        self._places = [self._refined(mpf(place.high) + mpf(place.low)) for place in touches] or [
            mpf(0) if flip == 0 else mp.pi for flip in self.flips
        ]
        if touches and linkage.drive.coordinate.is_angle:
            # The float nearest the length at which it just reaches its line stands for that length.
            joint = linkage.joint("J")
            assert isinstance(joint, RRP)
            self._linkage = _replaced(linkage, replace(joint, length=abs(_aside(linkage, self._places[0]))))
        self._first = self._parity(mpf(10) ** -6)

    def _refined(self, place: Any) -> Any:
        """Return a change point: the ends of a slider's travel, or where the bar to a line leans most."""
        if not self._linkage.drive.coordinate.is_angle:
            return mp.pi * mp.nint(place / mp.pi)
        return _extreme(lambda angle: _aside(self._linkage, angle), place)

    def _parity(self, phase: Any) -> int:
        return math.prod(sign_of(mp.sin((phase - place) / 2)) for place in self._places)

    def angle(self, phase: Any) -> Any:
        """The input's angle, or travel."""
        drive = self._linkage.drive
        if isinstance(self._path, Turn):
            return phase
        if isinstance(drive.actuator, Cylinder):
            return _on_cylinder(self._linkage, phase)
        low, high = self._travel or self._ends
        return (low + high) / 2 - (high - low) / 2 * mp.cos(phase)

    def places(self, phase: Any) -> dict[str, Any]:
        """The joints; J on its other closure behind each place where its two fall together."""
        sign = self._side * self._parity(phase) * self._first
        return places(self._linkage, self.angle(phase), {"J": sign})


def _travel(linkage: Linkage) -> tuple[Any, Any] | None:
    """The ends of a slider's travel; the floats nearest its dead centres stand for these."""
    travel, joint = linkage.drive.actuator, linkage.joint("J")
    if not isinstance(travel, Travel):
        return None
    assert isinstance(joint, RRR)
    rod, crank = map(mpf, joint.lengths)
    dead = rod - crank, rod + crank

    def end(place: float) -> Any:
        return next((one for one in dead if abs(one - place) < 1e-13 * rod), mpf(place))

    return end(travel.first), end(travel.last)


def _on_cylinder(linkage: Linkage, phase: Any) -> Any:
    """The crank's angle by the law of cosines, on the side of the pivot's line to the pin it starts on."""
    ends, crank = linkage.drive.actuator.stated_lengths, linkage.crank("J")
    pin = mp.mpc(*map(mpf, linkage.pin("G").position))
    (first, last), arm = map(mpf, ends), mpf(crank.length)
    length = (first + last) / 2 - (last - first) / 2 * mp.cos(phase)
    psi = mp.acos((abs(pin) ** 2 + arm**2 - length**2) / (2 * abs(pin) * arm))
    path = mechanism(linkage).assembly.path
    assert isinstance(path, CylinderStroke)
    return mp.arg(pin) + path.side * psi


def _margin(linkage: Linkage, angle: Any) -> Any:
    """What J has left to its limit, over its greatest; None of a kind without limits."""
    joint = linkage.joint("J")
    if isinstance(joint, RRP):
        return 1 - (_aside(linkage, angle) / joint.length) ** 2
    if isinstance(joint, RPR):
        at = places(_without_last(linkage), angle)
        way = abs(at[joint.through] - at[joint.pivot])
        return (way - abs(mpf(joint.offset))) / linkage.crank("A").length
    return None


def _aside(linkage: Linkage, angle: Any) -> Any:
    """How far the bar's end lies left of its line."""
    joint = linkage.joint("J")
    assert isinstance(joint, RRP)
    at, along = places(_without_last(linkage), angle), mp.expj(mpf(joint.line.angle))
    if joint.line.on:
        axis = at[joint.line.on[1]] - at[joint.line.on[0]]
        along = along * axis / abs(axis)
    return mp.im((at[joint.end] - at[joint.line.through]) / along) - mpf(joint.line.offset)


def _lean(linkage: Linkage, angle: Any) -> Any:
    return abs(_aside(linkage, angle))


def _without_last(linkage: Linkage) -> Linkage:
    return replace(linkage, joints=tuple(joint for joint in linkage.joints if joint.name not in ("J", "K")))


def _replaced(linkage: Linkage, joint: Joint) -> Linkage:
    return replace(linkage, joints=tuple(joint if one.name == joint.name else one for one in linkage.joints))


def _limit(linkage: Linkage, near: Any) -> Any:
    return mp.findroot(lambda angle: _margin(linkage, angle), (near, near + mpf(10) ** -10))


def _extreme(function: Callable[[Any], Any], near: Any) -> Any:
    return mp.findroot(lambda x: mp.diff(function, x), near, tol=mpf(10) ** -60, verify=False)


def _highest(function: Callable[[Any], Any], near: Any, step: Any) -> Any:
    """Return where a function is greatest, some steps from a place near it."""
    for _ in range(6):
        near = max((near + step * k / 10 for k in range(-10, 11)), key=function)
        step = step / 8
    return _extreme(function, near)


def _clear(linkage: Linkage, solved: Mechanism) -> bool:
    """Whether J's margin stays clear of zero but for limits and change points."""
    if linkage.drive.actuator.stated_lengths or _margin(linkage, mpf(0)) is None:
        return True
    path = solved.assembly.path
    if isinstance(path, Swing) and not all(path.ends):
        return False
    with mp.workdps(20):
        low, high = (float(path.low), float(path.high)) if isinstance(path, Swing) else (0.0, 2 * math.pi)
        angles = np.linspace(low, high, 120)
        margins = np.array([float(_margin(linkage, mpf(float(angle)))) for angle in angles])
    inner = margins[5:-5] if isinstance(path, Swing) else margins
    touches = bool(solved.assembly.chain) and not isinstance(path, Swing)
    return touches or bool(inner.min() > CLEAR)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    with mp.workdps(DIGITS):
        for make in (*DOWN_THE_CHAIN, *DRIVEN):
            stream, limited = solved_linkages(make), 0
            errors = []
            for _ in range(count):
                linkage, solved = next(stream)
                limited += bool(_Exact(linkage, solved).flips)
                errors.append(worst(linkage, solved))
            position, rate = (max(part) for part in zip(*errors, strict=True))
            print(f"{make.__name__:28} {count} {limited:5} {position:9.2e} {rate:9.2e}", flush=True)
