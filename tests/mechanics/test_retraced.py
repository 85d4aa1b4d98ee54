"""An input that swings and comes back by the way it came: the same closure, velocities of the other sign."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp

import linkanim
from linkanim.errors import SceneError
from linkanim.scenes import names
from linkanim.scenes.editing import other_return
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

SWINGING = [name for name in names() if not linkanim.load(name).info.full_turn]
UP = np.linspace(0.05, math.pi - 0.05, 24)


def retraced(name: str) -> Scene:
    return other_return(linkanim.load(name))


@pytest.mark.parametrize("name", SWINGING)
@pytest.mark.sampled
def test_it_comes_back_through_the_same_poses_with_rates_of_the_other_sign(name: str) -> None:
    scene = retraced(name)
    up, down = (scene.solve(phase=phases, speed=1.5) for phases in (UP, 2 * math.pi - UP))
    for joint, place in up.position.items():
        assert down.position[joint] == pytest.approx(place, rel=1e-9, abs=1e-9)
        for rate, sign in (("velocity", -1), ("acceleration", 1)):
            there, back = (getattr(motion, rate)[joint] for motion in (up, down))
            assert back == pytest.approx(sign * there, rel=1e-7, abs=1e-7 * np.abs(there).max(initial=1.0))
    assert down.phase == pytest.approx(2 * math.pi - UP, abs=0)
    assert scene.period == 2 * math.pi


def test_each_pose_is_the_one_that_solve_has_by_angle() -> None:
    scene = retraced("double-rocker")
    phases = np.concatenate([UP, 2 * math.pi - UP, 7 * math.pi + UP])
    by_phase = scene.solve(phase=phases)
    by_angle = scene.solve(angle=by_phase.coordinate, speed=by_phase.coordinate_rate)
    for joint in ("A", "B"):
        assert by_phase.position[joint] == pytest.approx(by_angle.position[joint], rel=1e-10)
        assert by_phase.velocity[joint] == pytest.approx(by_angle.velocity[joint], rel=1e-8)


def test_at_its_limits_and_before_them_it_is_what_it_is_without() -> None:
    """The ends are the phase law's own: bit for bit, at phase 0 and half a period on."""
    plain, scene = linkanim.load("double-rocker"), retraced("double-rocker")
    for phase in (0.0, 1e-17, 1.0, math.pi):
        one, other = plain.pose(phase), scene.pose(phase)
        assert (one.position, one.velocity, one.acceleration) == (
            other.position,
            other.velocity,
            other.acceleration,
        )
    assert scene.pose(2 * math.pi).position == scene.pose(0.0).position


@pytest.mark.parametrize("turns", [3, 10**6, -(10**9)])
def test_after_many_turns_its_poses_are_those_of_its_phases(turns: int) -> None:
    scene = retraced("double-rocker")
    for phase in (2 * math.pi * turns + 1.0, 2 * math.pi * turns - 2.0):
        with mp.workdps(40):
            left = mp.mpf(phase) - 2 * mp.pi * turns
        there, near = scene.pose(phase), scene.pose(abs(float(left)))
        for joint, place in near.position.items():
            assert there.position[joint] == pytest.approx(place, rel=1e-14)


@pytest.mark.parametrize("phase", [0.4, math.pi, 4.0, -1.0, 100.0])
def test_one_pose_is_a_row_of_many(phase: float) -> None:
    scene = retraced("double-rocker")
    pose, motion = scene.pose(phase, speed=-2.0), scene.solve(phase=[phase], speed=-2.0)
    assert (pose.phase, pose.input_speed) == (motion.phase[0], motion.input_speed) == (phase, -2.0)
    assert pose.velocity["B"] == pytest.approx(motion.velocity["B"][0], rel=1e-12)
    assert pose.angular_velocity["rocker"] == pytest.approx(motion.angular_velocity["rocker"][0], rel=1e-12)


def test_the_rocker_swings_back_as_long_as_it_swings_forth_and_nothing_turns() -> None:
    info = retraced("double-rocker").info
    assert info.turning_links == ()
    assert info.time_ratio == pytest.approx(1.0)
    assert dict(info.lines)["returns"].startswith("on the same closure")


def test_a_crank_that_turns_has_no_way_back_and_the_word_is_one_of_two() -> None:
    scene = linkanim.load("crank-rocker")
    with pytest.raises(linkanim.LinkanimError, match="turns fully"):
        other_return(scene)
    drive = {**scene.document["drive"], "returns": "never"}
    with pytest.raises(SceneError, match="returns"):
        scene_from({**scene.document, "drive": drive}, name="mine", where="mine")
    same = scene_from({**scene.document, "drive": {**drive, "returns": "same"}}, name="mine", where="mine")
    assert same.pose(4.0).position == scene.pose(4.0).position
