"""A motion holds what was asked for, frozen: the same bits, whatever else is asked for."""

from __future__ import annotations

from dataclasses import FrozenInstanceError
from typing import Any

import numpy as np
import pytest

from linkanim.mechanics.measures import DERIVATIVE_OF
from linkanim.mechanics.motion import COORDINATE
from linkanim.mechanics.program import Batch
from linkanim.scenes import load

KINDS = tuple(DERIVATIVE_OF)
PHASES = np.random.default_rng(3).uniform(-9.0, 9.0, 40)
# A turning input with sliders, springs and centres of mass; an input that swings; gears.
SCENES = ("press", "double-rocker", "geared-five-bar-3-2")


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("by", ["phase", "angle"])
@pytest.mark.parametrize("derivatives", [0, 1])
def test_what_else_is_asked_for_changes_no_bit(scene: str, by: str, derivatives: int) -> None:
    low, high = load(scene).mechanism.input_range
    asked: dict[str, Any] = {by: PHASES if by == "phase" else np.linspace(low, high, 40)}
    whole = load(scene).solve(**asked)
    motion = load(scene).solve(**asked, derivatives=derivatives)
    for kind in (kind for kind in KINDS if DERIVATIVE_OF[kind] <= derivatives):
        assert getattr(motion, kind).keys() == getattr(whole, kind).keys()
        for name, value in getattr(whole, kind).items():
            assert getattr(motion, kind)[name].tobytes() == value.tobytes()
    for name in ("phase", *COORDINATE):
        assert np.asarray(getattr(motion, name)).tobytes() == np.asarray(getattr(whole, name)).tobytes()


def test_joints_are_solved_at_once_and_all_else_when_it_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    runs: list[int] = []
    run = Batch.__call__

    def counted(self: Batch, *given: Any, **out: Any) -> Any:
        runs.append(len(self.outputs))
        return run(self, *given, **out)

    monkeypatch.setattr(Batch, "__call__", counted)
    motion = load("press").solve(phase=PHASES)
    assert motion.position
    assert motion.velocity
    assert motion.acceleration
    assert len(runs) == 1
    for kind in KINDS:
        assert getattr(motion, kind) is getattr(motion, kind)
    assert len(runs) == 2


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
