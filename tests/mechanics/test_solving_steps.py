"""The causal chain: in which step each joint is solved."""

from __future__ import annotations

import pytest

from linkanim.mechanics.analysis import solving_steps
from linkanim.scenes import load, names

# By hand, from the vector loops of each.
KNOWN = {
    # one dyad; the coupler point comes with the coupler
    "crank-rocker": {"O2": 0, "O4": 0, "A": 1, "B": 2, "P": 2},
    # the drive is the slider, the crank what comes last
    "driven-piston": {"C": 1},
    # what is solved together comes in one step: after the crank, or first where its own length drives
    "stephenson-2": {"A": 1, "B": 2, "C": 2, "D": 2, "E": 2},
    "double-butterfly": {"C": 1, "D": 1, "E": 2, "I": 2, "J": 2},
    "knee-cylinder": {"O": 0, "K": 1, "P": 1, "B": 1, "Q": 1},
}


@pytest.mark.parametrize("name", KNOWN)
def test_steps_are_those_of_the_loops(name: str) -> None:
    found = solving_steps(load(name).linkage)
    assert {joint: found[joint] for joint in KNOWN[name]} == KNOWN[name]


@pytest.mark.parametrize("name", names())
def test_the_chain_begins_at_the_input_and_leaves_no_step_out(name: str) -> None:
    linkage = load(name).linkage
    steps = solving_steps(linkage)
    assert steps[linkage.drive.joint] == 1
    assert set(steps.values()) == set(range(max(steps.values()) + 1))
    for joint in linkage.joints:
        assert (steps[joint.name] == 0) == joint.fixed
        assert all(steps[joint.name] >= steps[need] for need in joint.needs)
