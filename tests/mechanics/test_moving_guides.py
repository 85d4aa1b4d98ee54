"""Lines that bodies carry, slots about joints that move, and cranks on cranks, at many digits."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
import pytest
from build import four_bar, with_joints
from chain_reference import places
from mpmath import mp, mpf
from reference import DIGITS, derivatives

from linkanim.errors import AssemblyError
from linkanim.mechanics.joint import Joint
from linkanim.mechanics.kinds import RPP, RPR, RRP, Crank, Gear, Line, Pin, Rigid
from linkanim.mechanics.linkage import Drive, Linkage
from linkanim.mechanics.mechanism import Mechanism, mechanism

POSITION, RATE = 1e-12, 1e-10
AWAY = 0.02
"""Share of its greatest value that a dyad's margin must keep: its limits have tests of their own."""
WANTED = 40
DRIVE = Drive("A", 1.0)

Random = random.Random


@pytest.fixture(autouse=True)
def many_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


def on_moving_line(rng: Random) -> Joint:
    body = rng.choice([("A", "B"), ("B", "P")])
    line = Line(rng.choice("AB"), rng.uniform(-3, 3), rng.uniform(-30, 30), body)
    return RRP("J", rng.choice(["O2", "O4"]), rng.uniform(120, 300), line, rng.choice((1, -1)))


def yoke_on_moving_line(rng: Random) -> Joint:
    line = Line("A", rng.uniform(-3, 3), rng.uniform(-30, 30), ("A", "B"))
    return RPP("J", rng.choice(["O2", "O4"]), line, rng.uniform(0.5, 2.6))


def slot_about_a_moving_joint(rng: Random) -> Joint:
    return RPR("J", rng.choice("BP"), rng.choice(["O2", "A"]), rng.uniform(20, 200), rng.uniform(-20, 20))


def rod_through_a_swivel(rng: Random) -> Joint:
    return RPR("J", "A", rng.choice(["O4", "S"]), rng.uniform(50, 200), rng.uniform(-20, 20))


def planet(rng: Random) -> Joint:
    ratio = Fraction(rng.choice([-3, -2, -1, 2, 3, 5]), rng.choice([1, 1, 2, 3]))
    return Crank("J", rng.choice("ABP"), rng.uniform(5, 40), Gear("A", ratio, rng.uniform(-3, 3)))


KINDS = [on_moving_line, yoke_on_moving_line, slot_about_a_moving_joint, rod_through_a_swivel, planet]


def linkages(make: Callable[[Random], Joint]) -> Iterator[tuple[Linkage, Mechanism]]:
    """Chains on crank-rockers that turn fully, the joint away from its limits, with a point on its bar."""
    rng = Random(7)
    while True:
        base = four_bar((100, rng.uniform(15, 40), rng.uniform(75, 110), rng.uniform(70, 95)))
        added = [Pin("S", (rng.uniform(-150, -60), rng.uniform(-40, 40))), make(rng)]
        if not isinstance(added[1], RPP):
            added.append(Rigid("K", (added[1].bars[0][0], "J"), (rng.uniform(5, 60), rng.uniform(-30, 30))))
        linkage = with_joints(base, *added)
        try:
            solved = mechanism(linkage)
        except AssemblyError:
            continue
        if solved.assembly.path.full_turn and _keeps_away(linkage):
            yield linkage, solved


def _keeps_away(linkage: Linkage) -> bool:
    """Whether the last dyad's construction stays real by a margin, all around."""
    with mp.workdps(20):
        for step in range(60):
            at = places(linkage, mpf(step) / 60 * 2 * mp.pi)
            joint = linkage.joint("J")
            if isinstance(joint, RPR):
                apart = abs(at[joint.through] - at[joint.pivot])
                if apart < 1.2 * abs(joint.offset) + 5:
                    return False
            if isinstance(joint, RRP):
                lean = abs(mp.im((at["J"] - at[joint.end]) / _along(joint, at))) / joint.length
                if lean > 1 - AWAY:
                    return False
    return True


def _along(joint: RRP, at: dict[str, Any]) -> Any:
    assert joint.line.on is not None
    axis = at[joint.line.on[1]] - at[joint.line.on[0]]
    return axis / abs(axis) * mp.expj(joint.line.angle)


@pytest.mark.parametrize("make", KINDS)
def test_a_joint_on_moving_joints_is_right_to_many_digits(make: Callable[[Random], Joint]) -> None:
    stream = linkages(make)
    for _ in range(WANTED):
        linkage, solved = next(stream)
        phases = np.array([0.3, 2.1, 4.4, 5.9])
        motion, cycle = (solved.solve(phase=at, speed=1.0) for at in (phases, np.linspace(0, 2 * np.pi, 400)))
        exact = [derivatives(partial(places, linkage), mpf(float(phase))) for phase in phases]
        for name in ("J", "K") if "K" in linkage.by_name else ("J",):
            for order, kind in enumerate(("position", "velocity", "acceleration")):
                found = getattr(motion, kind)[name]
                size = float(np.hypot(*getattr(cycle, kind)[name].T).max()) if order else 100.0
                errors = [
                    float(abs(mp.mpc(*map(float, row)) - pose[order][name])) / size
                    for row, pose in zip(found, exact, strict=True)
                ]
                assert max(errors) <= (RATE if order else POSITION), (make.__name__, kind, linkage.joints)


@pytest.mark.parametrize("make", KINDS)
def test_one_pose_is_the_same_as_one_of_many(make: Callable[[Random], Joint]) -> None:
    _, solved = next(linkages(make))
    motion = solved.solve(phase=np.array([1.0, 4.0]), speed=2.0)
    pose = solved.pose(4.0, 2.0, 0.0, 2)
    for kind in ("position", "velocity", "acceleration"):
        assert getattr(pose, kind)["J"] == pytest.approx(tuple(getattr(motion, kind)["J"][1]), rel=1e-13)


def test_a_guide_that_stands_still_is_the_same_carried_by_the_ground() -> None:
    linkage = four_bar((100, 30, 90, 80))
    fixed = RRP("J", "B", 150.0, Line("O2", 0.4, 7.0))
    carried = RRP("J", "B", 150.0, Line("O2", 0.4, 7.0, ("O2", "O4")))
    phases = np.linspace(0, 6, 50)
    one, other = (
        mechanism(with_joints(linkage, joint)).solve(phase=phases, speed=1.0) for joint in (fixed, carried)
    )
    for kind in ("position", "velocity", "acceleration"):
        assert getattr(one, kind)["J"] == pytest.approx(getattr(other, kind)["J"], abs=1e-11)


def test_a_rod_through_a_swivel_limits_nothing_and_points_at_it() -> None:
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (100.0, 0.0))
    linkage = Linkage((*pins, Crank("A", "O2", 30.0), RPR("P", "A", "O4", 140.0)), DRIVE)
    motion = mechanism(linkage).solve(phase=np.linspace(0, 7, 200), speed=1.0)
    rod, way = motion.position["P"] - motion.position["A"], np.array([100.0, 0.0]) - motion.position["A"]
    assert np.hypot(*rod.T) == pytest.approx(140.0, rel=1e-14)
    assert rod[:, 0] * way[:, 1] - rod[:, 1] * way[:, 0] == pytest.approx(0.0, abs=1e-11)
    assert (rod * way).sum(axis=1).min() > 0


def test_a_rod_through_a_swivel_that_its_crank_passes_turns_at_half_the_crank_s_rate() -> None:
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (50.0, 0.0))
    linkage = Linkage((*pins, Crank("A", "O2", 50.0), RPR("P", "A", "O4", 80.0)), DRIVE)
    solved = mechanism(linkage)
    assert solved.periods == 2
    motion = solved.solve(phase=np.linspace(0.1, 4 * math.pi, 300), speed=1.0)
    rod = motion.position["P"] - motion.position["A"]
    turned = np.unwrap(np.arctan2(rod[:, 1], rod[:, 0]))
    assert np.diff(turned) == pytest.approx(np.diff(motion.phase) / 2, abs=1e-12)


@pytest.mark.parametrize("length", [30.0, 45.0])
def test_a_planet_of_ratio_minus_one_draws_a_line_or_an_ellipse(length: float) -> None:
    pins = (Pin("O2", (0.0, 0.0)),)
    gear = Gear("A", Fraction(-1))
    linkage = Linkage((*pins, Crank("A", "O2", 30.0), Crank("E", "A", length, gear)), DRIVE)
    x, y = mechanism(linkage).solve(phase=np.linspace(0, 7, 100), speed=1.0).position["E"].T
    if length == 30.0:
        assert y == pytest.approx(0.0, abs=1e-13 * 60)
    else:
        assert (x / 75) ** 2 + (y / 15) ** 2 == pytest.approx(1.0, abs=1e-14 * 60)
