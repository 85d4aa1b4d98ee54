"""A motion's quantities are worked out when they are first read: the same bits in any order, and no more."""

from __future__ import annotations

from dataclasses import FrozenInstanceError

import numpy as np
import pytest
from bits import rows

from linkanim.mechanics.measures import FAMILIES
from linkanim.mechanics.motion import COORDINATE
from linkanim.scenes import load

KINDS = tuple(kind for family in FAMILIES for kind in family)
PHASES = np.random.default_rng(3).uniform(-9.0, 9.0, 40)
# A turning input with sliders, springs and centres of mass; an input that swings; gears.
SCENES = ("press", "double-rocker", "geared-five-bar-3-2")


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("order", [KINDS, KINDS[::-1], (*COORDINATE, "phase", *KINDS[1::2], *KINDS[::2])])
def test_the_order_of_reading_changes_no_bit(scene: str, order: tuple[str, ...]) -> None:
    once = load(scene).solve(phase=PHASES)
    whole = {kind: dict(values) for kind, values in once.every.items()}
    motion = load(scene).solve(phase=PHASES)
    for kind in order:
        getattr(motion, kind)
    for kind, values in whole.items():
        assert getattr(motion, kind).keys() == values.keys()
        for name, value in values.items():
            assert getattr(motion, kind)[name].tobytes() == value.tobytes()
    assert [name for name, _ in rows(motion)] == [name for name, _ in rows(once)]


@pytest.mark.parametrize(
    ("read", "worked_out"),
    [
        ("position", ("position",)),
        ("acceleration", ("position", "velocity", "acceleration")),
        ("com_velocity", ("com_position", "com_velocity")),
        ("travel", ("travel",)),
    ],
)
def test_reading_a_quantity_works_out_what_it_is_a_rate_of_and_no_more(
    read: str, worked_out: tuple[str, ...]
) -> None:
    motion = load("press").solve(phase=PHASES)
    assert not [kind for kind in KINDS if kind in vars(motion)]
    getattr(motion, read)
    assert tuple(kind for kind in KINDS if kind in vars(motion)) == worked_out


def test_what_was_read_before_is_not_worked_out_again() -> None:
    motion = load("press").solve(phase=PHASES)
    before = motion.position
    assert motion.acceleration["B"].shape == (40, 2)
    assert motion.position is before


def test_derivatives_that_were_not_asked_for_are_not_there() -> None:
    motion = load("press").solve(phase=PHASES, derivatives=1)
    assert motion.acceleration == {}
    assert motion.angular_acceleration == {}
    assert set(motion.velocity) == set(motion.position)


@pytest.mark.parametrize("given", ["angle", "phase", "speed"])
def test_a_motion_stays_what_it_was_when_the_caller_changes_the_arrays(given: str) -> None:
    scene, values = load("press"), np.array([0.3, 0.4])
    asked = {"phase": 0.5} if given == "speed" else {}
    motion, same = (scene.solve(**asked, **{given: x}) for x in (values, values.copy()))  # type: ignore[arg-type]
    values[:] = 9.0
    assert motion.velocity["B"].tobytes() == same.velocity["B"].tobytes()
    assert motion.coordinate.tobytes() == same.coordinate.tobytes()


@pytest.mark.parametrize("name", ["position", "phase", "coordinate"])
def test_a_motion_is_frozen(name: str) -> None:
    motion = load("press").solve(angle=[0.3, 0.4])
    with pytest.raises(FrozenInstanceError):
        setattr(motion, name, {})
    found = getattr(motion, name)
    assert not (found["B"] if name == "position" else found).flags.writeable


def test_what_a_motion_does_not_have_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no 'jerk'"):
        _ = load("press").solve(angle=0.3).jerk


@pytest.mark.parametrize("scene", ["press", "double-rocker"])
def test_the_inputs_own_motion_is_that_of_a_pose(scene: str) -> None:
    motion = load(scene).solve(phase=PHASES, speed=3.0, acceleration=0.5)
    for index, phase in enumerate(PHASES[:9].tolist()):
        pose = load(scene).pose(phase, speed=3.0, acceleration=0.5)
        for name in COORDINATE:
            assert np.broadcast_to(getattr(motion, name), PHASES.shape)[index] == pytest.approx(
                getattr(pose, name), rel=1e-14
            )


def test_a_motion_run_faster_stands_where_it_stood() -> None:
    motion = load("double-rocker").solve(phase=PHASES, speed=2.0)
    paced = load("double-rocker").solve(phase=PHASES, speed=-6.0)
    for name, power in zip(("phase", *COORDINATE), (1.0, 1.0, -3.0, 9.0), strict=True):
        assert np.array_equal(getattr(paced, name), getattr(motion, name) * power)
    assert np.array_equal(paced.position["B"], motion.position["B"])
    assert paced.velocity["B"] == pytest.approx(
        motion.velocity["B"] * -3.0, abs=1e-14 * np.abs(motion.velocity["B"]).max()
    )
