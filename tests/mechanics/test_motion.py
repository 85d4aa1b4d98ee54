"""What a motion tells besides joints: angles, coefficients, springs and dampers, and in which shapes."""

from __future__ import annotations

import gc
import math
import pickle
import weakref

import numpy as np
import pytest
from build import four_bar, slider_crank

from linkanim.errors import AssemblyError
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.mechanics.quantities import register
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

STEP = 1e-4
OFFSETS = STEP * np.arange(-3, 4)
FIRST = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * STEP)


def scene_of(text: str) -> Scene:
    return scene_from(parse(text, "my.toml"), name="my", where="my.toml")


SHAPES = [(), (1,), (5,), (2, 3), (0,)]


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_results_have_the_shape_of_what_was_asked(shape: tuple[int, ...]) -> None:
    motion = load("press").solve(angle=np.zeros(shape), speed=10.0)
    assert motion.position["B"].shape == (*shape, 2)
    assert motion.acceleration["O2"].shape == (*shape, 2)
    assert motion.com_velocity["3"].shape == (*shape, 2)
    assert motion.angular_velocity["3"].shape == shape
    assert motion.angle["3"].shape == shape
    assert motion.coordinate.shape == shape


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


@pytest.mark.parametrize("name", ["crank-rocker", "kite", "andrews"])
def test_an_angle_s_phase_leads_back_to_it(name: str) -> None:
    scene, angles = load(name), np.array([0.2, 1.4, 3.0])
    found = scene.solve(phase=scene.solve(angle=angles).phase)
    assert np.exp(1j * found.coordinate) == pytest.approx(np.exp(1j * angles), abs=1e-12)


@pytest.mark.parametrize("name", ["press", "crank-rocker", "epicyclic-hypocycloid"])
def test_a_body_s_angle_is_the_direction_of_its_first_two_joints(name: str) -> None:
    scene = load(name)
    motion = scene.solve(phase=[0.3, 2.0, 4.4])
    for body in scene.linkage.bodies:
        if body.slider is None:
            first, second = (motion.position[joint] @ np.array([1.0, 1j]) for joint in body.joints[:2])
            way = (second - first) / np.abs(second - first)
            assert np.exp(1j * motion.angle[body.name]) == pytest.approx(way, abs=1e-12)


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


# A sweep by angle that begins at a limit as it is printed, where rates per input have no bound.
FROM_LIMITS = [
    ("double-rocker", 13.7953, "coupler", [62.32, 43.49, 37.18]),
    ("chebyshev-line", 36.8699, "coupler", [90.03, 110.47, 119.42]),
    ("roberts-line", -85.5882, "coupler", [34.37, 43.15, 47.02]),
]


@pytest.mark.parametrize(("name", "start", "body", "degrees"), FROM_LIMITS)
@pytest.mark.parametrize("derivatives", [0, 2])
def test_a_body_s_angle_does_not_jump_beside_a_limit(
    name: str, start: float, body: str, degrees: list[float], derivatives: int
) -> None:
    angles = np.radians(start + np.arange(3.0))
    motion = load(name).solve(angle=angles, derivatives=derivatives)
    assert np.degrees(motion.angle[body]) == pytest.approx(degrees, abs=0.01)


# Beside a change point the rates of one instant are a thousand times those around it.
@pytest.mark.parametrize("start", [0.0, math.pi, 1e-9])
def test_a_few_instants_tell_as_many_turns_as_many_do(start: float) -> None:
    found = mechanism(four_bar((10.0, 2.0, 1.0, 12.9999999)))
    for body in ("coupler", "rocker"):
        few, many = (
            found.solve(phase=start + math.tau * np.arange(count * 2 + 1) / count, speed=1.0).angle[body]
            for count in (3, 720)
        )
        assert few[-1] - few[0] == pytest.approx(many[-1] - many[0], abs=1e-6)


def test_a_fast_gear_s_coupler_counts_its_turns() -> None:
    scene = _geared("77")
    few, many = (scene.solve(phase=np.linspace(0.0, math.tau, n)).angle["arm"] for n in (5, 7201))
    assert few[-1] - few[0] == pytest.approx(many[-1] - many[0], abs=1e-6)
    assert abs(many[-1] - many[0]) > 70 * math.tau


def _geared(ratio: str) -> Scene:
    """Return two geared cranks, the second of which drags a link round."""
    return scene_of(f"""
length_unit = "mm"
[drive]
joint = "A"
speed = "20 rpm"
[ground]
O = [0, 0]
Q = [200, 0]
R = [210, 0]
[joints.A]
crank = "O"
length = 20
[joints.D]
crank = "Q"
length = 40
gear = {{ with = "A", ratio = "{ratio}", offset = "0 deg" }}
[joints.E]
from = ["D", "R"]
length = [35, 40]
side = "left"
[bodies.arm]
joints = ["R", "E"]
[bodies.wheel]
joints = ["Q", "D"]
""")


def test_what_turns_back_without_a_limit_has_finite_coefficients_there() -> None:
    scene = load("toggle-press")
    slopes, bends = -3.25457623, -0.286762563
    motion = scene.solve(phase=[0.0, math.pi, 2 * math.pi, 1e-9, -1e-5])
    first, second = motion.coefficient["ram"]
    assert first == pytest.approx([slopes, 0.0, slopes, slopes, slopes], abs=1e-8)
    assert second == pytest.approx([bends, -1 / 60, bends, bends, bends], rel=1e-8)
    for phase, pair in zip(motion.phase, zip(first, second, strict=True), strict=True):
        assert scene.pose(float(phase)).coefficient["ram"] == pytest.approx(pair, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("name", ["excavator", "toggle-press"])
def test_coefficients_at_a_turning_point_are_those_beside_it(name: str) -> None:
    scene = load(name)
    motion = scene.solve(phase=[0.0, 1e-6, math.pi, math.pi - 1e-6])
    for body, (first, second) in motion.coefficient.items():
        size = np.abs(second).max() + np.abs(first).max()
        assert first[::2] == pytest.approx(first[1::2], abs=1e-9 * size), body
        assert second[::2] == pytest.approx(second[1::2], abs=1e-5 * size), body


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_coefficients_do_not_depend_on_speed(name: str) -> None:
    scene = load(name)
    phases = np.array([0.0, 0.7, math.pi, 5.0])
    usual = scene.solve(phase=phases, speed=1.7)
    still = scene.solve(phase=phases, speed=0.0)
    for other in (still, scene.solve(phase=phases, speed=-3.0, acceleration=2.0)):
        for body, pair in usual.coefficient.items():
            assert [part.tolist() for part in other.coefficient[body]] == [part.tolist() for part in pair]


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_coefficients_are_rates_over_the_input_s(name: str) -> None:
    scene = load(name)
    motion = scene.solve(phase=[0.4, 1.7, 2.9, 4.1])
    for body, (first, second) in motion.coefficient.items():
        rates = motion.angular_velocity if body in motion.angular_velocity else motion.travel_velocity
        seconds = (
            motion.angular_acceleration if body in motion.angular_velocity else motion.travel_acceleration
        )
        pace = motion.coordinate_rate
        assert rates[body] == pytest.approx(first * pace, rel=1e-9, abs=1e-9)
        meant = second * pace**2 + first * motion.coordinate_second
        assert seconds[body] == pytest.approx(meant, rel=1e-8, abs=1e-8 * np.abs(meant).max() + 1e-9)


def test_at_a_limit_both_coefficients_are_unbounded_by_angle_too() -> None:
    scene = load("double-rocker")
    motion = scene.solve(angle=np.array(scene.info.input_range))
    for body in ("coupler", "rocker"):
        assert np.isinf(motion.coefficient[body]).all()
    assert np.array_equal(motion.coefficient["crank"], [[1.0, 1.0], [0.0, 0.0]])


CROSSING = """
length_unit = "mm"
[drive]
joint = "A"
speed = "20 rpm"
[ground]
O = [0, 0]
[joints.A]
crank = "O"
length = 40
[joints.D]
crank = "O"
length = 40
gear = { with = "A", ratio = -1, offset = "0 deg" }
[springs.coil]
between = ["A", "D"]
stiffness = "500 N/m"
free_length = 30
[dampers.cushion]
between = ["A", "D"]
coefficient = "20 N s/m"
[dampers.rod]
between = ["A", "D"]
"""


@pytest.mark.parametrize("by", ["angle", "phase"])
def test_a_strut_of_no_length_keeps_its_force_and_has_no_direction(by: str) -> None:
    scene, places = scene_of(CROSSING), [-0.1, 0.0, 0.1]
    motion = scene.solve(phase=places, speed=2.0) if by == "phase" else scene.solve(angle=places, speed=2.0)
    for strut in (motion.spring["coil"], motion.damper["cushion"], motion.damper["rod"]):
        assert strut.length == pytest.approx(80 * np.abs(np.sin([0.1, 0.0, 0.1])))
        assert strut.rate == pytest.approx([-160 * math.cos(0.1), 160.0, 160 * math.cos(0.1)])
        assert np.isnan(strut.direction[1])
        assert np.isnan(strut.direction_rate[1])
    assert motion.spring["coil"].force[1] == pytest.approx(-500 * 0.030)
    assert motion.damper["cushion"].force[1] == pytest.approx(20 * 0.160)


def test_a_pose_tells_of_a_strut_of_no_length_what_a_motion_does() -> None:
    scene = scene_of(CROSSING)
    pose, motion = scene.pose(0.0, speed=2.0), scene.solve(phase=0.0, speed=2.0)
    for kind in ("spring", "damper"):
        for name, strut in getattr(pose, kind).items():
            told = tuple(math.nan if value is None else float(value) for value in strut)
            meant = tuple(
                math.nan if value is None else float(value) for value in getattr(motion, kind)[name]
            )
            assert told == pytest.approx(meant, nan_ok=True)


# Nothing that a motion tells can be written to, and what has been used goes through a pickle.
def test_what_follows_from_a_motion_cannot_be_written_to() -> None:
    motion = load("press").solve(phase=[0.1, 0.2])
    for found in (
        motion.phase,
        motion.coordinate,
        motion.angle["3"],
        motion.coefficient["3"][1],
        motion.spring["return"].length,
        motion.spring["return"].force,
        motion.damper["cushion"].rate,
    ):
        with pytest.raises(ValueError, match="read-only"):
            found[0] = 1.0


@pytest.mark.parametrize("name", ["press", "double-rocker", "excavator", "toggle-press"])
def test_a_used_scene_and_a_motion_go_through_a_pickle(name: str) -> None:
    scene = load(name)
    motion, pose = scene.solve(phase=[0.3, 0.4]), scene.pose(0.3)
    known = register(scene.linkage).values()
    meant = [(quantity.read(motion), quantity.read(pose)) for quantity in known]
    assert scene.info.lines
    assert set(scene.telling) < set(scene.quantities)
    again, motion_again, pose_again = pickle.loads(pickle.dumps((scene, motion, pose)))
    assert again == scene
    assert list(again.quantities) == list(scene.quantities)
    for quantity, (many, one) in zip(known, meant, strict=True):
        assert np.array_equal(quantity.read(motion_again), many, equal_nan=True), quantity.token
        assert np.array_equal(quantity.read(pose_again), one, equal_nan=True), quantity.token


# A pause for a search of the memory is seen as a jerk; a drag makes a linkage in each frame.
@pytest.mark.parametrize("name", ["crank-rocker", "press", "double-rocker"])
def test_a_linkage_that_nobody_uses_is_freed_at_once(name: str) -> None:
    used = Mechanism(load(name).linkage, load(name).mechanism.assembly)
    used.solve(phase=[0.1, 0.2], speed=1.0).acceleration  # noqa: B018 -- compiled by being read
    used.pose(0.1, 1.0, 0.0, 2)
    left = weakref.ref(used)
    gc.disable()
    try:
        del used
        assert left() is None
    finally:
        gc.enable()
