"""Vector loops: both ways lead to one place, in every scene at every pose, and name what they are made of."""

from __future__ import annotations

from itertools import pairwise

import pytest

from linkanim.mechanics.facts.vector_loops import ClosedLoop, vector_loops
from linkanim.scenes import load, names


def loops_at(name: str, phase: float) -> tuple[ClosedLoop, ...]:
    scene = load(name)
    pose = scene.pose(phase, 0)
    return vector_loops(scene.linkage, lambda joint: complex(*pose.position[joint]))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_both_ways_end_in_one_place(name: str) -> None:
    for phase in (0.3, 2.0, 5.1):
        for loop in loops_at(name, phase):
            one, other = (sum(vector.end - vector.begin for vector in way) for way in loop.ways)
            size = max(abs(vector.end - vector.begin) for way in loop.ways for vector in way)
            assert abs(one - other) < 1e-12 * max(size, 1.0)
            for way in loop.ways:
                assert all(a.end == b.begin for a, b in pairwise(way))
                for vector in way:
                    across = ((vector.end - vector.begin) * vector.along.conjugate()).imag
                    assert abs(across) < 1e-9 * max(size, 1.0)
                    assert abs(vector.along) == pytest.approx(1.0)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_dyad_and_the_cylinder_that_drives_closes_a_loop(name: str) -> None:
    linkage = load(name).linkage
    dyads = [joint.name for joint in linkage.joints if joint.dyad]
    driven = [linkage.drive.joint] if linkage.drive.actuator.along else []
    assert [loop.joint for loop in loops_at(name, 1.0)] == driven + dyads


# Of each way the sort of vector and the joints that it leads along.
WAYS = {
    "crank-rocker": [[("bar", "O2A"), ("bar", "AB")], [("ground", "O2O4"), ("bar", "O4B")]],
    "slider-crank": [[("bar", "O2A"), ("bar", "AB")], [("offset", "O2B"), ("slide", "O2B")]],
    "inverted-slider-crank": [[("bar", "O2A")], [("ground", "O2O4"), ("slide", "O4A")]],
    "excavator": [[("ground", "O2G"), ("cylinder", "GH")], [("bar", "O2H")]],
}


@pytest.mark.parametrize("name", WAYS)
def test_ways_are_named_by_their_joints(name: str) -> None:
    ways = loops_at(name, 1.0)[0].ways
    assert [[(one.sort, "".join(one.joints)) for one in way] for way in ways] == WAYS[name]
