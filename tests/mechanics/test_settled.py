"""What a quantity says where floats alone would not: at limits, at rest, and where the truth is 0."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from linkanim.mechanics.quantities import register
from linkanim.scenes import load, names
from linkanim.scenes.editing import other_return
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

SIMPLE = {
    "length_unit": "mm",
    "gravity": "9.81 m/s^2",
    "slider-crank": {"crank": 60, "rod": 40},
    "bodies": {"slider": {"slider": "B", "mass": "450 g"}},
}
"""A crank that swings, since its rod is the shorter one."""
HALF_TURNS = (0, 1, 2, 3, 7, -1, -4, 74, 1001)


@cache
def simple() -> Scene:
    return scene_from(SIMPLE, name="simple", where="simple")


def said(scene: Scene, token: str, phase: float, **asked: Any) -> Any:
    """Return what a pose says, which a batch has to say, too."""
    read = register(scene.linkage)[token].read
    found, batch = read(scene.pose(phase, **asked)), read(scene.solve(phase=[phase], **asked))
    assert np.asarray(found, float).tobytes() == np.asarray(batch, float)[0].tobytes(), (token, phase)
    return found


UNBOUNDED = [
    ("double-rocker", "coupler.coefficient"),
    ("double-rocker", "rocker.second_coefficient"),
    ("triple-rocker", "rocker.coefficient"),
    ("chebyshev-line", "coupler.second_coefficient"),
    ("driven-piston", "rod.coefficient"),
    ("driven-piston", "crank.second_coefficient"),
]


# A rate by the input is not bounded at a limit, whichever float stands for it.
@pytest.mark.parametrize(("name", "token"), UNBOUNDED)
def test_a_float_of_any_multiple_of_pi_is_the_limit(name: str, token: str) -> None:
    scene = load(name)
    for count in HALF_TURNS:
        assert said(scene, token, count * math.pi) == math.inf, count
        assert math.isfinite(said(scene, token, count * math.pi + 1e-9)), count


def test_a_torque_at_a_limit_that_takes_power_is_unbounded_at_both_ends() -> None:
    for count in HALF_TURNS:
        assert said(simple(), "input.torque", count * math.pi) == math.inf, count
        assert math.isfinite(said(simple(), "input.torque", count * math.pi + 1e-9))


# phase in degrees, newton metres worked out by hand: m (a·v)/θ'
@pytest.mark.parametrize(("phase", "torque"), [(181.0, 0.162355), (178.0, -0.0825), (90.0, -0.0026)])
def test_beside_a_limit_a_torque_is_a_number(phase: float, torque: float) -> None:
    scene, at = simple(), math.radians(phase)
    pose = scene.pose(at)
    power = 0.45 * pose.acceleration["B"][0] * pose.velocity["B"][0] * 1e-6
    found = said(scene, "input.torque", at)
    assert found == pytest.approx(power / pose.coordinate_rate, rel=1e-12)
    if phase > 100:
        assert found == pytest.approx(torque, rel=1e-2)


ROUND = [
    ("double-rocker", "A", 130.0),
    ("double-rocker", "B", 115.0),
    ("triple-rocker-in-out", "B", 190.0),
    ("watt-line", "A", 120.0),
    ("rocker-driven", "A", 100.0),
    ("driven-piston", "A", 50.0),
    ("crank-rocker", "B", 80.0),
    ("slider-crank", "B", math.inf),
    ("toggle-press", "R", math.inf),
]


# A joint of a body that turns about a fixed pin runs on a circle, at rest and beside it, too.
@pytest.mark.parametrize(("name", "joint", "radius"), ROUND)
def test_what_keeps_its_distance_from_a_fixed_pin_has_that_radius(
    name: str, joint: str, radius: float
) -> None:
    scene = load(name)
    for phase in (0.0, 1e-15, 1e-12, 1e-9, 1e-3, 1.0, math.pi - 1e-9, math.pi, 2 * math.pi):
        assert said(scene, f"{joint}.curvature_radius", phase) == radius
    assert (scene.quantities[f"{joint}.curvature_radius"].read(scene.cycle(360)) == radius).all()


# A path bends as it does whichever way it is gone along: slower and slower towards a limit, or by the input.
@pytest.mark.parametrize(
    ("name", "joint"), [("double-rocker", "P"), ("rocker-driven", "P"), ("toggle-press", "K")]
)
def test_a_path_bends_alike_beside_a_limit_and_at_it(name: str, joint: str) -> None:
    scene, token = load(name), f"{joint}.curvature_radius"
    for end in (0.0, math.pi):
        here = said(scene, token, end)
        assert 0 < here < math.inf
        for way in (1e-12, 1e-9, 1e-6, -1e-6):
            assert said(scene, token, end + way) == pytest.approx(here, rel=1e-4), way


NOTHING = [
    # two links that stay parallel, and what is never turned by them
    ("parallelogram", "coupler.angular_velocity"),
    ("parallelogram", "coupler.angular_acceleration"),
    ("parallelogram", "coupler.coefficient"),
    ("parallel-locomotive", "rod.angular_velocity"),
    ("parallel-locomotive", "crank2.angular_acceleration"),
    ("wiper", "link.angular_velocity"),
    ("scissor-lift", "platform.angular_velocity"),
    # points on a straight line, by lengths alone
    ("peaucellier", "P.velocity.x"),
    ("hart", "P.acceleration.x"),
    ("scissor-lift", "L2.position.x"),
    ("cardan-gears", "E.normal_acceleration"),
    # cylinders that are held
    ("excavator", "stick.rate"),
    ("excavator", "bucket.rate"),
    ("press", "A.tangential_acceleration"),
]


@pytest.mark.parametrize(("name", "token"), NOTHING)
def test_what_is_nothing_by_geometry_is_nothing(name: str, token: str) -> None:
    scene = load(name)
    assert not np.any(scene.quantities[token].read(scene.cycle(500)))
    for phase in (0.0, 0.3, math.pi, 5.0):
        assert math.copysign(1.0, said(scene, token, phase)) * (1.0 + said(scene, token, phase)) == 1.0


def test_what_is_small_all_the_same_is_a_number() -> None:
    beside = [said(load("double-rocker"), "A.velocity", way) for way in (0.0, 1e-14, 1e-9, 1e-3)]
    assert beside[:2] == [0.0, 0.0]
    # by the acceleration there
    assert beside[2:] == pytest.approx([way * 264.800229984 / 1.5707963 for way in (1e-9, 1e-3)], rel=1e-5)


# A body that turns about a fixed pin has its pole there; others at rest where the input's own way has it.
@pytest.mark.parametrize(
    ("name", "token", "place"),
    [
        ("double-rocker", "crank.pole", (0.0, 0.0)),
        ("double-rocker", "rocker.pole", (110.0, 0.0)),
        ("triple-rocker", "rocker.pole", (120.0, 0.0)),
    ],
)
def test_a_pole_is_where_it_is_at_rest_too(name: str, token: str, place: tuple[float, float]) -> None:
    for phase in (0.0, 1e-12, 1.0, math.pi):
        assert tuple(said(load(name), token, phase)) == place


def test_what_the_input_starts_to_move_has_a_pole_as_it_starts() -> None:
    scene = load("toggle-press")
    start, soon = (np.array(said(scene, "lower.pole", phase)) for phase in (0.0, 1e-5))
    assert np.isfinite(start).all()
    assert start == pytest.approx(soon, abs=1e-6)


def test_geometry_does_not_ask_how_fast_it_runs() -> None:
    for name in ("crank-rocker", "double-rocker", "press"):
        scene = load(name)
        for token, quantity in register(scene.linkage).items():
            if quantity.order == 0 and not token.endswith(("force", "torque")):
                moving, still = (said(scene, token, 0.7, speed=speed) for speed in (2.0, 0.0))
                assert still == pytest.approx(moving, rel=1e-9, abs=1e-9), token


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_quantity_of_a_pose_holds_the_bits_of_a_batch(name: str) -> None:
    scene = load(name)
    for one in (scene,) if scene.info.full_turn else (scene, other_return(scene)):
        _has_the_bits_of_a_batch(one)


def _has_the_bits_of_a_batch(scene: Scene) -> None:
    phases = np.linspace(0.0, scene.period, 41)
    batches = [scene.solve(phase=phases), *(scene.solve(phase=[phase]) for phase in phases[::8])]
    poses = [scene.pose(phase) for phase in phases.tolist()]
    for token, quantity in register(scene.linkage).items():
        alone = [np.asarray(quantity.read(pose), float).tobytes() for pose in poses]
        for batch, few in zip(batches, (alone, *([one] for one in alone[::8])), strict=True):
            if len(few) > 1 and (quantity.unit == "rad"):
                continue  # of many instants in any turn
            read = np.asarray(quantity.read(batch), float)
            for one, row in zip(few, read, strict=True):
                assert one == row.tobytes(), token


# Its rates change sign at the ends, and are the ones of the way up at every float of one.
@pytest.mark.parametrize("end", [0.0, math.pi, 2 * math.pi, 3 * math.pi, -math.pi, 74 * math.pi])
def test_the_end_of_a_way_that_is_gone_back_is_an_end_by_any_float(end: float) -> None:
    document = load("double-rocker").document
    drive = {**document["drive"], "returns": "same"}
    same = scene_from({**document, "drive": drive}, name="same", where="same")
    there = said(same, "B.velocity.x", 0.0 if round(end / math.pi) % 2 == 0 else math.pi)
    assert abs(there) > 1
    for beside in (end, math.nextafter(end, 1e9), math.nextafter(end, -1e9)):
        assert said(same, "B.velocity.x", beside) == pytest.approx(there, rel=1e-9)
        assert said(same, "coupler.coefficient", beside) == math.inf
    way = 1 if round(end / math.pi) % 2 else -1
    assert said(same, "B.velocity.x", end - 1e-9) == pytest.approx(way * there, rel=1e-6)
