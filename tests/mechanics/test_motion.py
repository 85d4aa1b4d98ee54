"""What a motion tells besides joints: angles, coefficients, springs and dampers, and in which shapes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from build import four_bar, slider_crank

from linkanim.errors import AssemblyError
from linkanim.mechanics.mechanism import mechanism
from linkanim.mechanics.register import register
from linkanim.scenes import load

STEP = 1e-4
OFFSETS = STEP * np.arange(-3, 4)
FIRST = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * STEP)


SHAPES = [(), (1,), (5,), (2, 3), (0,)]


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_results_have_the_shape_of_what_was_asked(shape: tuple[int, ...]) -> None:
    motion = load("press").solve(angle=np.zeros(shape), speed=10.0)
    assert motion.position["B"].shape == (*shape, 2)
    assert motion.acceleration["O2"].shape == (*shape, 2)
    assert motion.com_velocity["3"].shape == (*shape, 2)
    assert motion.angular_velocity["3"].shape == shape
    assert motion.angle["3"].shape == shape
    assert motion.crank_angle.shape == shape


def test_speeds_may_differ_from_angle_to_angle() -> None:
    scene = load("press")
    angles, speeds = np.array([0.3, 1.2, 4.0]), np.array([1.0, -5.0, 0.0])
    motion = scene.solve(angle=angles, speed=speeds, acceleration=2.0)
    for index, (angle, speed) in enumerate(zip(angles, speeds, strict=True)):
        one = scene.solve(angle=angle, speed=speed, acceleration=2.0)
        assert motion.acceleration["C"][index] == pytest.approx(one.acceleration["C"], rel=1e-13, abs=1e-9)
        assert motion.angular_acceleration["6"][index] == pytest.approx(
            one.angular_acceleration["6"], rel=1e-12
        )


def test_results_cannot_be_written_to() -> None:
    motion = load("press").solve(angle=[0.1, 0.2])
    with pytest.raises(ValueError, match="read-only"):
        motion.position["B"][0, 0] = 1.0


@pytest.mark.parametrize("kind", ["spring", "damper"])
def test_springs_and_dampers_change_at_the_rate_they_say(kind: str) -> None:
    scene = load("press")
    name = next(iter(getattr(scene.solve(angle=0.0), kind)))
    for angle in (0.4, 2.0, 5.5):
        near = getattr(scene.solve(angle=angle + OFFSETS, speed=1.0), kind)[name]
        assert near.rate[3] == pytest.approx(FIRST @ near.length, rel=1e-9, abs=1e-9)


def test_forces_are_newtons_and_tension_is_positive() -> None:
    scene = load("press")
    spring, damper = scene.linkage.springs[0], scene.linkage.dampers[0]
    assert spring.stiffness is not None
    assert spring.free_length is not None
    assert damper.coefficient is not None
    motion = scene.solve(angle=[0.5, 1.5], speed=10.0)
    found = motion.spring[spring.name]
    stretched = (found.length - spring.free_length) * 1e-3
    assert found.force == pytest.approx(spring.stiffness * stretched)
    rate = motion.damper[damper.name].rate * 1e-3
    assert motion.damper[damper.name].force == pytest.approx(damper.coefficient * rate)


@pytest.mark.parametrize("body", ["3", "4", "6", "5"])
def test_coefficients_are_slopes_over_the_crank_angle(body: str) -> None:
    scene = load("press")
    near = scene.solve(angle=1.1 + OFFSETS, speed=10.0)
    values = near.travel[body] if body == "5" else near.angle[body]
    first, second = near.coefficient[body]
    assert first[3] == pytest.approx(FIRST @ values, rel=1e-8)
    assert second[3] == pytest.approx(FIRST @ first, rel=1e-8)


def test_a_crank_s_angle_counts_its_turns_and_the_others_do_not_jump() -> None:
    motion = load("drag-link").solve(angle=np.linspace(0.0, 6 * math.pi, 37))
    assert motion.angle["crank"][-1] == pytest.approx(6 * math.pi)
    assert motion.angle["rocker"][-1] - motion.angle["rocker"][0] == pytest.approx(6 * math.pi)
    # Ten steps a turn are too few for differences below half a turn alone where the rocker is quick.
    coarse = load("drag-link").solve(angle=np.linspace(0.0, 6 * math.pi, 13))
    assert coarse.angle["rocker"][-1] - coarse.angle["rocker"][0] == pytest.approx(6 * math.pi)


def test_a_pose_tells_the_same_as_a_motion() -> None:
    scene = load("press")
    pose, motion = (
        scene.pose(1.3, speed=2.0, acceleration=0.5),
        scene.solve(phase=1.3, speed=2.0, acceleration=0.5),
    )
    for kind in ("angle", "angular_velocity", "angular_acceleration", "travel", "travel_velocity"):
        found = getattr(pose, kind)
        assert found.keys() == {**getattr(motion, kind)}.keys()
        for name, value in found.items():
            assert value == pytest.approx(float(getattr(motion, kind)[name]), rel=1e-12, abs=1e-12)
    for kind in ("spring", "damper"):
        for name, strut in getattr(pose, kind).items():
            assert strut == pytest.approx(tuple(float(x) for x in getattr(motion, kind)[name]), rel=1e-12)
    for name, pair in pose.coefficient.items():
        assert pair == pytest.approx(tuple(float(x) for x in motion.coefficient[name]), rel=1e-11)


def test_at_the_limit_itself_coefficients_are_unbounded() -> None:
    pose = load("double-rocker").pose(0.0)
    assert all(math.isinf(value) for value in pose.coefficient["rocker"])
    assert math.isfinite(pose.angular_velocity["rocker"])


def test_fewer_derivatives_leave_the_rest_out() -> None:
    scene = load("press")
    assert not scene.solve(angle=0.1, derivatives=0).velocity
    assert scene.solve(angle=0.1, derivatives=1).velocity
    assert not scene.pose(0.1, 1).acceleration
    assert scene.pose(0.1, 0).spring["return"].rate is None


def test_messages_name_the_lengths_as_they_were_given() -> None:
    with pytest.raises(AssemblyError, match="2e\\+90"):
        mechanism(four_bar((100e90, 3e90, 9e90, 2e90)))
    with pytest.raises(AssemblyError, match="5e-90"):
        mechanism(slider_crank(1e-88, 5e-90, 3e-88))


@pytest.mark.parametrize("factor", [2.0, -1.0, 0.1, -3.7])
@pytest.mark.parametrize("name", ["press", "double-rocker", "slider-crank"])
def test_a_motion_at_another_pace_is_the_one_solved_at_that_speed(name: str, factor: float) -> None:
    scene = load(name)
    phases = np.linspace(0.1, 6.0, 40)
    paced = scene.solve(phase=phases, speed=2.0, acceleration=0.5).paced(factor)
    solved = scene.solve(phase=phases, speed=2.0 * factor, acceleration=0.5 * factor**2)
    assert paced.input_speed == solved.input_speed
    for quantity in register(scene.linkage).values():
        assert quantity.read(paced) == pytest.approx(quantity.read(solved), rel=1e-11, abs=1e-9)
    with pytest.raises(ValueError, match="read-only"):
        paced.velocity["A"][0] = 1.0
