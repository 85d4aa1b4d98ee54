"""Every kind of joint on random linkages against many digits, limits and change points among them."""

from __future__ import annotations

from itertools import islice
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

from linkanim.mechanics.closing.kinds import CLOSERS
from linkanim.mechanics.linkage.joint import Joint

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
        # A kind is a dataclass of its own; by name, since slots make a second class beside the first.
        found |= {kind.__name__} if "__dataclass_fields__" in vars(kind) else set()
    assert found == {kind.__name__ for kind in CLOSERS}
