"""Every kind of joint on random linkages against many digits, limits and change points among them."""

from __future__ import annotations

import re
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mpmath import mp
from random_joints import (
    DOWN_THE_CHAIN,
    DRIVEN,
    Make,
    at_a_change_point,
    bar_that_limits_the_input,
    slot_that_limits_the_input,
    solved_linkages,
    worst,
)
from reference import DIGITS

import linkanim
from linkanim.mechanics.groups import GroupPoint, GroupSlider
from linkanim.mechanics.linkage import Joint
from linkanim.mechanics.solver.closing import CLOSERS

EPS = 2.0**-52
POSITION, RATE = 1e-12, 1e-10
OWN_LOOP = 16 * EPS
"""Of what the input moves directly."""
SLOW = (at_a_change_point, bar_that_limits_the_input, slot_that_limits_the_input)
"""What is smooth beside their limits is fitted in fifty digits for each linkage."""

every_kind = pytest.mark.parametrize("make", [*DOWN_THE_CHAIN, *DRIVEN], ids=lambda make: make.__name__)


@pytest.fixture(autouse=True)
def many_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


def check(make: Make, count: int) -> None:
    for linkage, solved in islice(solved_linkages(make), count):
        error = worst(linkage, solved)
        assert error.position <= (OWN_LOOP if make in DRIVEN else POSITION), linkage.joints
        assert error.rate <= RATE, linkage.joints


@pytest.mark.thinned(3)
@every_kind
@pytest.mark.slow
def test_a_joint_is_right_to_many_digits(make: Make) -> None:
    check(make, 1 if make in SLOW else 5)


@pytest.mark.long
@every_kind
def test_a_thousand_joints_are_right_to_many_digits(make: Make) -> None:
    check(make, 1000)


@every_kind
def test_one_pose_is_the_same_as_one_of_many(make: Make) -> None:
    _, solved = next(solved_linkages(make))
    motion = solved.solve(phase=np.array([1.0, 4.0]), speed=2.0)
    pose = solved.pose(4.0, 2.0, 0.0, 2)
    for kind in ("position", "velocity", "acceleration"):
        assert getattr(pose, kind)["J"] == tuple(getattr(motion, kind)["J"][1])


def test_every_kind_of_joint_is_known_to_close() -> None:
    kinds, found = Joint.__subclasses__(), set()
    while kinds:
        kind = kinds.pop()
        kinds += kind.__subclasses__()
        # A kind has fields of its own.
        found |= {kind} if "__dataclass_fields__" in vars(kind) else set()
    assert found == {*CLOSERS, GroupPoint, GroupSlider}  # which their group closes


JOINT_FILES = {
    "mechanics/linkage",
    "mechanics/solver/closing",
    "mechanics/reactions",
    "scenes/file_form",
    "explain/joints",
    "explain/forces",
    "explain/questions",
}
INPUT_FILES = {"mechanics/linkage", "mechanics/solver/strokes", "scenes/file_form", "explain/solution"}


@pytest.mark.parametrize(
    ("kind", "files"),
    [
        # which also have sliders on a page whose own solver closes them
        pytest.param("RPR", {*JOINT_FILES, "share/lengths"}, id="a slotted bar"),
        pytest.param("RPP", {*JOINT_FILES, "share/lengths"}, id="a yoke"),
        # a cylinder's path has a class beside that of its data
        pytest.param("Cylinder(Stroke)?", INPUT_FILES, id="a cylinder that drives"),
    ],
)
def test_a_kind_is_told_in_few_files(kind: str, files: set[str]) -> None:
    """Its data, how it closes or runs, what it carries, how it is written and explained; the rest follows."""
    package = Path(linkanim.__file__).parent
    telling = (file for file in package.rglob("*.py") if re.search(rf"\b{kind}\b", file.read_text("utf-8")))
    assert {file.relative_to(package).with_suffix("").as_posix() for file in telling} == files
