"""From the mouse to the phase: turning inputs, swinging ones, and past a limit."""

from __future__ import annotations

import math

import pytest

from linkanim.scenes import load, names
from linkanim.scenes.editing import phase_towards, with_dimensions


@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize("phase", [0.3, 2.0, 4.0, 5.9])
def test_the_crank_goes_where_it_is_dragged(name: str, phase: float) -> None:
    scene = load(name)
    pose = scene.pose(phase, 0)
    near, pin = phase + 0.2, pose.position[scene.linkage.drive.joint]
    found = scene.mechanism.assembly.path.phase_of(pose.coordinate, near=near)
    assert found == pytest.approx(phase, abs=1e-6)
    assert phase_towards(scene, near, pin) == pytest.approx(phase, abs=1e-6)


@pytest.mark.parametrize("phase", [0.3, 2.0])
def test_a_slider_on_any_guide_goes_as_near_as_it_can(phase: float) -> None:
    scene = with_dimensions(
        with_dimensions(load("driven-piston"), {("joints", "C", "line", "angle"): "30 deg"}),
        {("ground", "O", 0): 70.0, ("ground", "O", 1): -20.0},
    )
    x, y = scene.pose(phase, 0).position["C"]
    across = 12.0 * math.sin(math.radians(30.0)), -12.0 * math.cos(math.radians(30.0))
    assert phase_towards(scene, phase + 0.2, (x, y)) == pytest.approx(phase, abs=1e-6)
    assert phase_towards(scene, phase + 0.2, (x + across[0], y + across[1])) == pytest.approx(phase, abs=1e-6)


def test_a_crank_that_turns_is_followed_over_whole_turns() -> None:
    scene = load("crank-rocker")
    path = scene.mechanism.assembly.path
    assert path.phase_of(0.2, near=20 * math.pi + 0.1) == pytest.approx(20 * math.pi + 0.2)
    assert path.phase_of(-0.1, near=0.1) == pytest.approx(-0.1)


def test_a_swing_stops_at_its_limits() -> None:
    scene = load("double-rocker")
    low, high = scene.info.input_range
    assert scene.mechanism.assembly.path.phase_of(low - 0.1, near=0.3) == pytest.approx(0.0)
    assert scene.mechanism.assembly.path.phase_of(high + 0.1, near=2.9) == pytest.approx(math.pi)


def test_a_swing_stays_on_the_way_it_is_on() -> None:
    scene = load("double-rocker")
    middle = sum(scene.info.input_range) / 2
    assert scene.mechanism.assembly.path.phase_of(middle, near=1.0) == pytest.approx(math.pi / 2)
    assert scene.mechanism.assembly.path.phase_of(middle, near=5.0) == pytest.approx(3 * math.pi / 2)


def test_the_pivot_itself_changes_nothing() -> None:
    assert phase_towards(load("crank-rocker"), 1.25, (0.0, 0.0)) == 1.25
