"""Transmission angles of every kind of dyad, against the bars as they lie in many poses."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
from build import four_bar, rocker_driven, six_bar, slider_crank, slotted, with_joints
from numpy.typing import NDArray

from linkanim.mechanics.analysis import transmission
from linkanim.mechanics.linkage import RPR, RRP, RRR, Crank, Gear, Joint, Line, Linkage, Pin
from linkanim.mechanics.measures import transmission_angle
from linkanim.mechanics.motion import Motion, mechanism

Array = NDArray[np.float64]
EXACT = 1e-9


def between(first: Array, second: Array) -> Array:
    """The angle between two directions (N, 2), 0 to π."""
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return np.asarray(np.arctan2(np.abs(cross), (first * second).sum(axis=-1)))


def up_to_square(angles: Array) -> Array:
    """The angle between two lines, 0 to 90°."""
    return np.minimum(angles, math.pi - angles)


def angle_at(motion: Motion, joint: Joint) -> Array | None:
    """A dyad's angle in every pose, between bars up to π; None of a joint that is no dyad."""
    place = motion.position
    match joint:
        case RRR():
            return between(*(place[joint.name] - place[end] for end in joint.ends))
        case RRP():
            angle = joint.line.angle
            normal = np.array([-math.sin(angle), math.cos(angle)])
            return up_to_square(between(place[joint.name] - place[joint.end], normal))
        case RPR():
            bar, out = place[joint.name] - place[joint.pivot], place[joint.through] - place[joint.pivot]
            return math.pi / 2 - up_to_square(between(bar, out))
        case _:
            return None


def sampled(linkage: Linkage) -> tuple[float, float]:
    """The least and greatest angle over all dyads, in 100,000 poses a period."""
    solved = mechanism(linkage)
    phases = np.linspace(0.0, 2 * math.pi * solved.periods, 100_000 * solved.periods + 1)
    motion = solved.solve(phase=phases, speed=1.0, derivatives=0)
    angles = [found for joint in linkage.joints if (found := angle_at(motion, joint)) is not None]
    least = min(float(up_to_square(angle).min()) for angle in angles)
    # Where bars pass 90° none of the poses need be there.
    square = any(angle.min() <= math.pi / 2 <= angle.max() for angle in angles)
    return least, math.pi / 2 if square else max(float(up_to_square(angle).max()) for angle in angles)


BAR = four_bar((100.0, 30.0, 90.0, 80.0))
LINE = Line("O4", 0.3, -20.0)
GEARED = Crank("D", "O7", 61.0, Gear("A", Fraction(-2, 3), 0.3))
CASES: list[tuple[str, Linkage]] = [
    ("a four-bar", BAR),
    # Neither end is 90°: the rod is never along the line.
    ("a slider far off the crank", slider_crank(20.0, 90.0, 50.0)),
    ("a slider below the crank", slider_crank(20.0, 90.0, -50.0, line_angle=0.7)),
    ("a slot through its pivot", slotted(100.0, 40.0, 50.0)),
    ("a slot beside its pivot", slotted(100.0, 40.0, 50.0, 20.0)),
    ("a slider down the chain", with_joints(BAR, RRP("S", "B", 150.0, LINE))),
    ("a slider down the chain, far off", with_joints(BAR, RRP("S", "B", 250.0, Line("O4", 0.0, -120.0)))),
    ("a slot down the chain", with_joints(BAR, Pin("O6", (200.0, 0.0)), RPR("Q", "O6", "B", 200.0, 40.0))),
    ("a second four-bar", six_bar((100.0, 30.0, 90.0, 80.0), (120.0, 60.0, 100.0, 90.0))),
    # The second loop stops the input: the first one's bars go less far.
    ("a first loop that is stopped", six_bar((100.0, 30.0, 90.0, 80.0), (120.0, 60.0, 70.0, 80.0))),
    (
        "a geared five-bar, back after three turns",
        with_joints(BAR, Pin("O7", (330.0, 0.0)), GEARED, RRR("E", ("A", "D"), (283.0, 250.0))),
    ),
    (
        "a rocker's swing that drives a slider",
        with_joints(rocker_driven((100.0, 30.0, 90.0, 80.0)), RRP("S", "B", 300.0, Line("O4", 0.3, 10.0))),
    ),
]


@pytest.mark.parametrize(("name", "linkage"), CASES, ids=[row[0] for row in CASES])
def test_both_ends_of_the_transmission_angle_are_those_of_all_poses(name: str, linkage: Linkage) -> None:
    found = transmission(mechanism(linkage))
    assert found is not None
    assert found[:2] == pytest.approx(sampled(linkage), abs=EXACT)
    there = mechanism(linkage).solve(phase=found.phase, speed=1.0, derivatives=0)
    assert transmission_angle(there, found.dyad) == pytest.approx(found.least, abs=EXACT)
    for joint in linkage.joints:
        if (angle := angle_at(there, joint)) is not None:
            assert transmission_angle(there, joint.name) == pytest.approx(up_to_square(angle), abs=1e-7)


ENDS: list[tuple[str, Callable[[], Linkage], tuple[float | None, float | None]]] = [
    # At a limit the dyad's own bars are in line: exactly, not to half the digits.
    ("at a limit down the chain", lambda: six_bar((100, 30, 90, 80), (120, 60, 70, 80)), (0.0, None)),
    ("at change points down the chain", lambda: six_bar((30, 60, 70, 80), (60, 40, 60, 40)), (0.0, None)),
    ("a rod that crosses its line's direction", lambda: slider_crank(40, 120, 20), (None, math.pi / 2)),
    ("a slot through its pivot", lambda: slotted(100, 40, 50), (math.pi / 2, math.pi / 2)),
    ("at the limits of a loop", lambda: four_bar((100, 80, 30, 90)), (0.0, math.pi / 2)),
]


@pytest.mark.parametrize(("name", "build", "ends"), ENDS, ids=[row[0] for row in ENDS])
def test_bars_in_line_are_told_exactly(
    name: str, build: Callable[[], Linkage], ends: tuple[float | None, float | None]
) -> None:
    found = transmission(mechanism(build()))
    assert found is not None
    for angle, expected in zip(found[:2], ends, strict=True):
        assert expected is None or angle == expected


def test_a_linkage_without_dyads_has_no_transmission_angle() -> None:
    bare = Linkage(BAR.joints[:3], BAR.drive)
    assert transmission(mechanism(bare)) is None
