"""What a scene is asked for in Python: numbers, and no more turns than a pose has digits for."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from linkanim.bounds import MOST_TURNS_ON
from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.player.clock import Clock
from linkanim.player.state import begin
from linkanim.scenes import load

NO_NUMBERS = [
    pytest.param({"phase": "1"}, 'phase="1"', id="a text with a number in it"),
    pytest.param({"phase": ["a", "b"]}, "phase=['a', 'b']", id="a list of words"),
    pytest.param({"angle": [1.0, "2"]}, "angle=[1.0, '2']", id="a number and a word"),
    pytest.param({"angle": [[1], [2, 3]]}, "angle=[[1], [2, 3]]", id="rows of different lengths"),
    pytest.param({"phase": 1j}, "phase=1j", id="a complex number"),
    pytest.param({"phase": object()}, "phase=<object", id="an object"),
    pytest.param({"phase": 1.0, "speed": "fast"}, 'speed="fast"', id="a speed in words"),
    pytest.param({"phase": 1.0, "acceleration": ["x"]}, "acceleration=['x']", id="an acceleration in words"),
]


@pytest.mark.parametrize(("asked", "named"), NO_NUMBERS)
def test_what_is_no_number_is_refused_by_its_name(asked: dict[str, Any], named: str) -> None:
    with pytest.raises(BadInput) as refused:
        load("crank-rocker").solve(**asked)
    assert str(refused.value).startswith(f"solve({named}")
    assert "give numbers" in str(refused.value)


def test_numbers_of_every_kind_are_taken() -> None:
    scene = load("crank-rocker")
    kinds: list[Any] = [1, np.int8(1), np.float32(1), Fraction(1), np.array(1.0), True]
    for one in kinds:
        assert scene.solve(phase=one).position["B"] == pytest.approx(scene.pose(1.0).position["B"])


# A quick gear turns on sooner; a swing's phase is taken twice.
@pytest.mark.parametrize(
    "name", ["crank-rocker", "double-rocker", "geared-five-bar-3-2", "excavator", "epicyclic-hypocycloid"]
)
def test_poses_have_all_their_digits_up_to_a_billion_turns_and_are_refused_beyond(name: str) -> None:
    scene = load(name)
    most = 2 * math.pi * MOST_TURNS_ON / max(scene.mechanism.assembly.quickest / 2, 1.0)
    for phase in (most * share for share in (1.0, -0.9999, 0.97, 0.5)):
        with mpmath.workdps(60):
            whole = 2 * mpmath.pi * scene.info.true_period
            near = float(mpmath.fmod(mpmath.mpf(phase), whole))
        there, here = scene.solve(phase=[phase]), scene.solve(phase=[near])
        for joint, place in here.position.items():
            assert np.abs(there.position[joint] - place).max() <= 4e-15 * scene.linkage.longest
    many = np.zeros(10_000)
    for ask in (
        scene.pose,
        lambda phase: scene.solve(phase=[0.0, phase]),
        lambda phase: scene.solve(phase=np.append(many, phase)),
        lambda phase: scene.solve(phase=np.append(many, -phase)),
    ):
        with pytest.raises(BadInput, match=f"{name}: phase=.* is more than .* turns.*take off whole periods"):
            ask(-1.01 * most)


def test_the_command_says_so_in_a_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "press", "--phase", "1e12 rad"]) == 2
    assert capsys.readouterr().err.startswith("linkanim: press: phase=1e+12 is more than 1,073,741,824 turns")


def test_a_window_that_runs_on_and_on_has_a_phase_that_can_be_solved() -> None:
    late = replace(begin("double-rocker"), clock=Clock(1e7), frame=10**9)
    assert abs(late.phase) < late.scene.period
    assert np.isfinite(late.scene.pose(late.phase).position["B"]).all()
