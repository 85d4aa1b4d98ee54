"""Lines that bodies carry, rods through swivels, and cranks on cranks, against what they must do."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from build import four_bar, with_joints

from linkanim.mechanics.linkage import RPR, RRP, Crank, Drive, Gear, Line, Linkage, Pin, Rigid
from linkanim.mechanics.measures import transmission_angle
from linkanim.mechanics.motion import mechanism

DRIVE = Drive("A", 1.0)


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
    assert transmission_angle(one, "J") == pytest.approx(transmission_angle(other, "J"), abs=1e-12)


def test_a_point_is_where_it_is_from_whichever_joints_of_its_body() -> None:
    bar = four_bar((100, 30, 90, 80), coupler_point=(50.0, 20.0))
    points = Rigid("Q", ("A", "P"), (10.0, 5.0)), Rigid("R", ("P", "Q"), (-8.0, 12.0))
    linkage = with_joints(bar, *points, Rigid("S", ("R", "A"), (3.0, 4.0)))
    motion = mechanism(linkage).solve(phase=np.linspace(0, 6, 20), speed=1.0)
    places = {name: place @ np.array([1.0, 1j]) for name, place in motion.position.items()}
    along = places["B"] - places["A"]
    q = (50.0 + 20.0j) / abs(50.0 + 20.0j) * (10.0 + 5.0j)
    r = (q - (50.0 + 20.0j)) / abs(q - (50.0 + 20.0j)) * (-8.0 + 12.0j) + (50.0 + 20.0j)
    assert places["Q"] == pytest.approx(places["A"] + along / 90 * q, abs=1e-12)
    assert places["R"] == pytest.approx(places["A"] + along / 90 * r, abs=1e-12)
    assert places["S"] == pytest.approx(places["A"] + along / 90 * (r - r / abs(r) * (3.0 + 4.0j)), abs=1e-12)


def test_a_coupler_point_has_its_place_at_any_size() -> None:
    phases = np.linspace(0, 6, 20)
    usual, tiny = (
        mechanism(
            four_bar((100 * size, 30 * size, 90 * size, 80 * size), coupler_point=(50 * size, 20 * size))
        )
        for size in (1.0, 2.0**-600)
    )
    one, other = (solved.solve(phase=phases, speed=1.0).position["P"] for solved in (usual, tiny))
    assert other * 2.0**600 == pytest.approx(one, rel=1e-13)


def test_the_transmission_angle_of_a_slot_is_that_of_its_offset() -> None:
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (100.0, 0.0))
    linkage = Linkage((*pins, Crank("A", "O2", 30.0), RPR("P", "A", "O4", 140.0, 9.0)), DRIVE)
    motion = mechanism(linkage).solve(phase=np.linspace(0, 7, 20), speed=1.0)
    apart = np.hypot(*(motion.position["A"] - np.array([100.0, 0.0])).T)
    assert transmission_angle(motion, "P") == pytest.approx(np.arccos(9.0 / apart), rel=1e-12)


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


@pytest.mark.parametrize("through", ["A", "B"])
def test_a_guide_that_the_coupler_carries_is_kept_to_and_its_rates_are_its_places(through: str) -> None:
    linkage = four_bar((100, 30, 90, 80))
    joint = RRP("J", "O4", 300.0, Line(through, 0.3, 7.0, ("A", "B")))
    solved = mechanism(with_joints(linkage, joint))
    near = np.linspace(0.1, 6.0, 20)[:, None] + np.array([-1e-4, 0.0, 1e-4])
    motion = solved.solve(phase=near, speed=1.0)
    a, b, o4, base, j = (motion.position[name] @ (1, 1j) for name in ("A", "B", "O4", through, "J"))
    seen = (j - base) * np.conj((b - a) / abs(b - a) * np.exp(0.3j))
    assert seen.imag == pytest.approx(7.0, abs=1e-10)
    assert abs(j - o4) == pytest.approx(300.0, rel=1e-13)
    for rate, value in (("velocity", "position"), ("acceleration", "velocity")):
        values = getattr(motion, value)["J"]
        slope = (values[:, 2] - values[:, 0]) / 2e-4
        assert getattr(motion, rate)["J"][:, 1] == pytest.approx(slope, abs=1e-4)
