"""A driver dyad swings a limited input from a motor that turns fully, and changes nothing else."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.errors import BadInput
from linkanim.mechanics.measures import as_complex, transmission_angle
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse, text
from linkanim.synthesis.drivers import LEAST, Driver, driven
from linkanim.synthesis.linkages import Real

POSES = np.array([[0, 0, 0], [30, 20, 25], [50, 60, 60]]) * [1, 1, math.pi / 180]
ARC = np.exp(1j * np.linspace(0.2, 1.3, 40)) * 80


def swinging(swing: float, first: float = 40.0) -> tuple[Scene, Real]:
    """Return a double-rocker, and angles of its input over a swing in degrees."""
    document: dict[str, Any] = {
        "title": "Rocker",
        "length_unit": "mm",
        "drive": {"joint": "A", "speed": "20 rpm", "start": f"{first} deg"},
        "ground": {"O2": [10, -5], "O4": [90, -5]},
        "joints": {
            "A": {"crank": "O2", "length": 60},
            "B": {"from": ["A", "O4"], "length": [75, 70], "side": "left"},
            "P": {"on": ["A", "B"], "at": [40, 30]},
        },
        "bodies": {"crank": {"joints": ["O2", "A"]}, "coupler": {"joints": ["A", "B", "P"]}},
        "trace": {"joints": ["P"]},
    }
    return scene_from(document, name="rocker", where="rocker"), np.radians([first, first + swing])


# The rod's least transmission angle is what the driver says, and at both dead centres the input has the first
# and the last of its angles; each way takes half a turn.
@pytest.mark.parametrize("swing", [2.0, 25.0, -40.0, 60.0, 79.0])
@pytest.mark.parametrize("place", [None, 200 - 90j, 15 + 2j, 1000j])
def test_a_driver_swings_the_input_from_its_first_angle_to_its_last(
    swing: float, place: complex | None
) -> None:
    scene, angles = swinging(swing)
    whole, driver = driven(scene, angles, place)
    assert whole.info.full_turn
    assert place is None or driver.motor == place
    assert driver.transmission_angle > LEAST
    motion = whole.solve(phase=np.linspace(0, 2 * math.pi, 721), derivatives=0)
    lever = np.unwrap(np.asarray(motion.angle["lever"]))
    if "D" in motion.position:
        lever = np.unwrap(np.angle(as_complex(motion.position["A"]) - as_complex(motion.position["O2"])))
    lever += 2 * math.pi * round(float(angles[0] - lever[0]) / (2 * math.pi))
    ends = np.array([lever[0], lever[360], lever[720]])
    assert ends == pytest.approx([angles[0], angles[1], angles[0]], abs=1e-12)
    assert np.ptp(lever) == pytest.approx(abs(angles[1] - angles[0]), abs=1e-12)
    least = transmission_angle(motion, "D" if "D" in motion.position else "A").min()
    assert least == pytest.approx(driver.transmission_angle, abs=1e-4)
    assert driver.rod >= 3 * driver.crank * (1 - 1e-12)
    assert driver.arm <= 60


def test_the_widest_swing_has_a_driver_of_some_length() -> None:
    scene, angles = swinging(115.0, first=20.0)
    driver = driven(scene, angles, None)[1]
    assert driver.transmission_angle > LEAST
    assert driver.rod < 4 * driver.arm


def test_all_joints_of_a_driven_linkage_are_where_they_are_without_the_driver() -> None:
    scene, angles = swinging(70.0)
    whole, driver = driven(scene, angles, None)
    on_the_way = np.linspace(angles[0], angles[1], 50)
    own = scene.solve(angle=on_the_way, derivatives=0).position
    there = whole.solve(phase=driver.phases(on_the_way), derivatives=0).position
    for name in own:
        assert there[name] == pytest.approx(own[name], abs=1e-11)


@pytest.mark.parametrize(
    ("swing", "place", "says"),
    [
        (115.1, None, "its input swings through 115.1 deg; a driver swings it through 115 deg at most"),
        (0.0, None, "its input stands still"),
        (50.0, 10 - 5j, "its input turns about the motor's place"),
    ],
)
def test_what_no_driver_swings_is_refused(swing: float, place: complex | None, says: str) -> None:
    scene, angles = swinging(swing, first=20.0)
    with pytest.raises(BadInput, match=says):
        driven(scene, angles, place)


def _runs(scene: Scene, driver: Driver) -> None:
    """Check that a driven scene reads back from its file, and turns fully there."""
    again = scene_from(parse(text(scene), "saved"), name="saved", where="saved")
    assert again.info.full_turn
    phases = np.linspace(0, 2 * math.pi, 60)
    for name, at in scene.solve(phase=phases).position.items():
        assert again.solve(phase=phases).position[name] == pytest.approx(at, abs=1e-9 * driver.rod)


@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
@pytest.mark.parametrize("motor", [True, (150.0, -60.0)])
def test_a_body_passes_its_poses_in_half_a_turn_of_the_motor(kind: str, motor: Any) -> None:
    found = linkanim.guide(POSES, kind=kind, driver=motor)
    some = [one for one in found if one.driver]
    assert some
    for one in some:
        assert one.driver
        _runs(one.scene, one.driver)
        assert (np.diff(one.phases) > 0).all()
        assert [one.phases[0], one.phases[-1]] == pytest.approx([0, math.pi], abs=1e-6)
        point = as_complex(one.scene.solve(phase=one.phases, derivatives=0).position["P"])
        assert point == pytest.approx(POSES[:, 0] + 1j * POSES[:, 1], abs=1e-9)
    assert all(one.scene.info.full_turn for one in found if not one.defects)


@pytest.mark.slow
def test_an_output_follows_its_function_while_a_motor_turns() -> None:
    given: dict[str, Any] = {"input_range": math.radians(60), "output_range": math.radians(-60), "count": 2}
    plain = linkanim.function("1/x", 1, 2, **given)
    for one, before in zip(linkanim.function("1/x", 1, 2, **given, driver=True), plain, strict=True):
        assert one.driver
        assert not before.scene.info.full_turn
        _runs(one.scene, one.driver)
        x = np.linspace(1, 2, 30)
        assert one.errors(x) == pytest.approx(before.errors(x), abs=1e-15)
        inputs = one.input_start + (x - 1) * one.input_range
        output = one.scene.solve(phase=one.driver.phases(inputs), derivatives=0).angle["rocker"]
        wanted = before.scene.solve(angle=inputs, derivatives=0).angle["rocker"]
        assert np.cos(output - wanted) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.slow
def test_an_open_curve_is_followed_by_a_motor_that_turns_fully() -> None:
    found = linkanim.path(ARC.view(float).reshape(-1, 2), False, count=3, driver=True)
    assert all(fit.scene.info.full_turn for fit in found)
    for fit in found:
        if fit.driver:
            _runs(fit.scene, fit.driver)
            passed = fit.scene.solve(phase=fit.driver.phases(fit.angles), derivatives=0).position["P"]
            off = np.abs(as_complex(passed) - ARC)
            assert math.sqrt((off**2).mean()) == pytest.approx(fit.rms, rel=1e-6)


def test_a_closed_curve_needs_no_driver() -> None:
    with pytest.raises(BadInput, match="along a closed curve every crank turns fully"):
        linkanim.path([(0, 0), (10, 5), (20, 0)], driver=True)


@pytest.mark.parametrize("motor", [(1.0,), (1.0, math.nan), "here"])
def test_a_motor_stands_at_a_point(motor: Any) -> None:
    with pytest.raises(BadInput, match="give the motor's x and y"):
        linkanim.guide(POSES, driver=motor)
