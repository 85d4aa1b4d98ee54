"""Positions and rates of named joints alone, written where the caller says: the same bits as ever."""

from __future__ import annotations

import math
import pickle
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.errors import BadInput
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

KINDS = ("position", "velocity", "acceleration")
PHASES = np.linspace(-1.0, 7.0, 30)
FAR = {
    "ground": {"A0": [1e6, 2e6], "B0": [1e6 + 100, 2e6]},
    "joints": {
        "A": {"crank": "A0", "length": 30},
        "B": {"from": ["A", "B0"], "length": [90, 80], "side": "left"},
    },
    "drive": {"speed": "1 rad/s"},
}


def scene(name: str) -> Scene:
    return scene_from(FAR, name="far", where="far") if name == "far" else load(name)


# One that turns, one that swings, one that comes back as it went, by a slider, by a cylinder, with gears, of
# links that are solved together, and one far from the origin.
NAMES = [
    "crank-rocker",
    "double-rocker",
    "scissor-lift",
    "driven-piston",
    "excavator",
    "press",
    "andrews",
    "far",
]


def check(solved: Scene, joints: Sequence[str], derivatives: int, **given: Any) -> None:
    shape = np.shape(next(iter(given.values())))
    out = np.full((derivatives + 1, len(joints), 2, *shape), 7.0)
    found = solved.solve(**given, derivatives=derivatives, joints=joints, out=out)
    whole = solved.solve(**given, derivatives=derivatives)
    for order, kind in enumerate(KINDS[: derivatives + 1]):
        assert list(getattr(found, kind)) == list(joints)
        for row, joint in enumerate(joints):
            # out of reach a pin is NaN here, as all is
            usual = np.where(np.isnan(whole.phase)[..., None], np.nan, getattr(whole, kind)[joint])
            assert np.array_equal(np.moveaxis(out[order, row], 0, -1), usual, equal_nan=True), (kind, joint)
            assert np.array_equal(getattr(found, kind)[joint], usual, equal_nan=True)
            assert np.shares_memory(getattr(found, kind)[joint], out)
    for kind in ("phase", "coordinate", "coordinate_rate", "coordinate_second", "input_speed"):
        assert np.array_equal(getattr(found, kind), getattr(whole, kind), equal_nan=True), kind
    assert not found.angular_velocity


@pytest.mark.parametrize("name", NAMES)
def test_out_has_what_the_motion_has(name: str) -> None:
    solved = scene(name)
    joints = [joint.name for joint in solved.linkage.joints]
    check(solved, joints, 2, phase=PHASES)
    check(solved, joints[::-2], 1, phase=PHASES, speed=2.0, acceleration=3.0)
    check(solved, joints[-1:], 0, phase=PHASES.reshape(5, 6))
    check(solved, joints[-1:], 2, phase=1.0)
    if solved.linkage.drive.coordinate.is_angle:
        low, high = solved.mechanism.input_range
        angles = np.linspace(low - 0.1, high + 0.1, 30) if math.isfinite(low) else PHASES
        check(solved, joints, 2, angle=np.concatenate([angles, [low, high]]))
    else:
        first, last = solved.linkage.drive.actuator.stated_lengths
        check(solved, joints, 2, travel=np.linspace(first, last, 30))


def test_without_joints_out_takes_all_of_them_in_order() -> None:
    solved = load("crank-rocker")
    out = np.empty((1, len(solved.linkage.joints), 2, len(PHASES)))
    found = solved.solve(phase=PHASES, derivatives=0, out=out)
    assert list(found.position) == [joint.name for joint in solved.linkage.joints]


def test_joints_without_out_are_worked_out_alone() -> None:
    found = load("press").solve(phase=PHASES, joints="B")
    assert list(found.position) == list(found.acceleration) == ["B"]
    assert not found.com_position
    assert np.array_equal(found.position["B"], load("press").solve(phase=PHASES).position["B"])


def test_a_motion_of_some_joints_goes_through_a_pickle() -> None:
    found = load("crank-rocker").solve(phase=PHASES, joints=["P"], out=np.empty((3, 1, 2, len(PHASES))))
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.acceleration["P"], found.acceleration["P"])


def read_only(out: NDArray[np.float64]) -> NDArray[np.float64]:
    out.flags.writeable = False
    return out


# What out= is, and part of the sentence that refuses it.
REFUSED = {
    "rows of another order": np.empty((3, 1, 30, 2)),
    "fewer derivatives": np.empty((2, 1, 2, 30)),
    "not floats of eight bytes": np.empty((3, 1, 2, 30), np.float32),
    "not in one piece": np.empty((3, 1, 2, 60))[..., ::2],
    "not to be written": read_only(np.empty((3, 1, 2, 30))),
    "a list": [0.0],
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_cannot_take_the_motion_is_refused(what: str) -> None:
    with pytest.raises(BadInput, match=r"^solve: out= is an array of floats.*\(3, 1, 2, 30\)$"):
        load("crank-rocker").solve(phase=PHASES, joints=["P"], out=REFUSED[what])  # type: ignore[arg-type]


def test_a_wrong_name_is_answered_with_all_of_them() -> None:
    with pytest.raises(BadInput, match=r"joints=\['Q'\].*crank-rocker has joints O2, O4, A, B, P"):
        load("crank-rocker").solve(phase=PHASES, joints=["Q"])
