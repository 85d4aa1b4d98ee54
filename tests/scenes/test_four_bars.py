"""What each four-bar of the catalogue is there for, against a closed form or a published value."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.scenes import load
from linkanim.scenes.scene import Scene

Array = NDArray[np.float64]
FINE = 7200
"""Steps of a cycle between which an extreme is missed by less than 1e-6 of the sweep."""


def lengths(scene: Scene) -> tuple[float, float, float, float]:
    """Return ground, crank, coupler and rocker of a scene in the short form."""
    bar = scene.document["four-bar"]
    return bar["ground"], bar["crank"], bar["coupler"], bar["rocker"]


def swing(ground: float, crank: float, coupler: float, rocker: float) -> float:
    """Return a crank-rocker's swing: between the triangles of coupler + crank and of coupler - crank."""

    def angle(diagonal: float) -> float:
        return math.acos((ground**2 + rocker**2 - diagonal**2) / (2 * ground * rocker))

    return angle(coupler + crank) - angle(coupler - crank)


def span(values: Array) -> float:
    return float(np.ptp(values))


def test_driven_at_link_3_the_shortest_link_turns_and_its_neighbour_swings() -> None:
    scene = load("crank-rocker-link3")
    ground, rocker, coupler, crank = lengths(scene)
    assert scene.info.class_name == "Grashof crank-rocker"
    assert scene.info.turning_links == ("rocker",)
    assert scene.linkage.drive.speed < 0
    assert scene.linkage.drive.joint == "B"
    found = span(scene.cycle(FINE).angle["crank"])
    assert found == pytest.approx(swing(ground, crank, coupler, rocker), rel=1e-6)


def test_both_wipers_sweep_the_angle_of_the_crank_rocker_in_parallel() -> None:
    scene = load("wiper")
    motion = scene.cycle(FINE)
    expected = swing(*lengths(scene))
    for name in ("rocker", "rocker2"):
        assert span(motion.angle[name]) == pytest.approx(expected, rel=1e-6)
    apart = motion.position["T2"] - motion.position["T"]
    assert np.max(np.abs(apart - [260, 0])) <= 1e-14 * 350


def test_the_pumpjacks_stroke_is_that_of_the_beam_at_its_limits() -> None:
    scene = load("pumpjack")
    pivot = (240.0, 260.0)
    ground, crank, pitman, tail, head, bridle = math.hypot(*pivot), 75.0, 270.0, 230.0, 210.0, 200.0

    def rod(diagonal: float) -> float:
        """Return how high the rod hangs where crank and pitman are in line, `diagonal` long."""
        at_pivot = math.acos((ground**2 + tail**2 - diagonal**2) / (2 * ground * tail))
        beam = math.atan2(-pivot[1], -pivot[0]) - at_pivot + math.pi
        x, y = pivot[0] + head * math.cos(beam), pivot[1] + head * math.sin(beam)
        return y - math.sqrt(bridle**2 - (x - 440) ** 2)

    expected = abs(rod(pitman + crank) - rod(pitman - crank))
    assert scene.info.stroke == pytest.approx(expected, rel=1e-9)


def test_galloways_short_crank_goes_round_twice() -> None:
    scene = load("galloway")
    ground, short, *_ = lengths(scene)
    assert ground == short
    motion = scene.cycle(720)
    # The kite's axis runs from O2 to B and bisects the angle at O2 between the ground and the short crank.
    x, y = (motion.position["B"] - motion.position["O2"]).T
    axis = np.unwrap(np.arctan2(y, x))
    turn = np.unwrap(motion.angle["crank"]) - 2 * axis
    assert np.max(np.abs(turn - turn[0])) <= 1e-12
    assert abs(math.remainder(turn[0], 2 * math.pi)) <= 1e-12
    turns = motion.angle["rocker"][-1] - motion.angle["rocker"][0]
    assert motion.angle["crank"][-1] - motion.angle["crank"][0] == pytest.approx(2 * turns, rel=0.01)
    assert turns == pytest.approx(2 * math.pi * 719 / 720, rel=1e-12)


def test_chebyshevs_point_is_on_the_line_in_three_places_and_near_it_between() -> None:
    scene = load("chebyshev-line")
    # The rockers form 3-4-5 triangles: the left one upright, the coupler level, the right one upright.
    angles = [math.pi / 2, math.atan2(4, 3), math.atan2(3, 4)]
    expected = [[0, 160], [80, 160], [160, 160]]
    assert np.max(np.abs(scene.solve(angle=angles).position["P"] - expected)) <= 1e-6
    x, y = scene.cycle(FINE).position["P"].T
    way = y[(x >= 0) & (x <= 160) & (y < 165)]
    # 1/410 of the line's length: how far a quarter of the way along lies off it.
    assert span(way) == pytest.approx(160 / 410, rel=1e-3)


def test_hoeckens_line_is_as_straight_and_long_as_published() -> None:
    scene = load("hoecken")
    motion = scene.solve(angle=np.linspace(math.pi / 2, 3 * math.pi / 2, 2001), speed=1.0)
    x, y = motion.position["P"].T
    _, crank, _, _ = lengths(scene)
    # Norton's table for half a turn: 4.181 cranks long, straight to 0.096 %, the speed even to 35 %.
    assert span(x) / crank == pytest.approx(4.181, abs=5e-4)
    assert 100 * span(y) / span(x) == pytest.approx(0.096, abs=5e-4)
    speed = motion.velocity["P"][:, 0]
    assert 100 * span(speed) / abs(np.mean(speed)) == pytest.approx(35.3, abs=0.3)


def test_robertss_point_is_on_the_line_at_both_pins_and_in_the_middle() -> None:
    scene = load("roberts-line")
    # Three isosceles triangles: P on O2, the base level and P in the middle, P on O4.
    fan = 2 * math.asin(5 / 13)
    angles = [math.acos(10 / 13) + fan, math.atan2(12, 5), math.acos(10 / 13)]
    assert np.max(np.abs(scene.solve(angle=angles).position["P"] - [[0, 0], [100, 0], [200, 0]])) <= 1e-12
    way = scene.cycle(FINE).position["P"]
    x, y = way[np.abs(way[:, 1]) < 5].T
    between = y[(x >= 2) & (x <= 198)]
    assert np.max(between) <= 0
    assert np.min(between) >= -200 / 200


def test_watts_point_draws_watts_curve() -> None:
    scene = load("watt-line")
    x, y = (scene.cycle(720).position["P"] - [120, -40]).T
    a2, b2, c2 = (240**2 + 80**2) / 4, 120.0**2, 40.0**2
    # r² = b² - (a sin θ ± √(c² - a² cos² θ))², θ from the line between the pivots, both roots at once.
    along = (240 * x - 80 * y) ** 2 / (240**2 + 80**2)
    square = x**2 + y**2
    cosine = a2 * along / square
    sine = a2 - cosine
    residue = (b2 - square - sine - c2 + cosine) ** 2 - 4 * sine * (c2 - cosine)
    assert np.max(np.abs(residue)) <= 1e-12 * b2**2
    # Where the coupler stands upright the curve touches its tangent to the fifth order.
    swing = scene.solve(angle=np.radians(np.linspace(-20, 20, 401))).position["P"]
    across = swing[:, 0] - np.polyval(np.polyfit(swing[:, 1], swing[:, 0], 1), swing[:, 1])
    assert np.max(np.abs(across)) <= span(swing[:, 1]) / 500


def test_the_grasshopper_beams_end_goes_up_and_down_beside_its_pivot() -> None:
    motion = load("evans").cycle(FINE)
    p, c = motion.position["P"], motion.position["C"]
    # Thales: B is as far from O4 as from both ends of the beam, so the angle at O4 is a right one.
    assert np.max(np.abs((p * c).sum(axis=-1))) <= 1e-14 * 200**2
    assert np.max(np.abs(p[:, 0])) <= span(p[:, 1]) / 900
