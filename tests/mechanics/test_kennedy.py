"""Instant centres of all pairs of links, against the velocities that the solver has."""

from __future__ import annotations

import math
from itertools import combinations

import pytest
from few_links import drawn

from linkanim.mechanics.centres import KennedyStep, Link, blocks, centre, joint_between, kennedy
from linkanim.mechanics.measures import cross
from linkanim.mechanics.motion import Pose
from linkanim.picture.figure import figure
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

EXACT = 1e-12
"""Of the greatest velocity at hand: what a centre's two velocities differ by at the most."""


def velocity(pose: Pose, scene: Scene, link: Link, at: complex) -> complex:
    """The velocity of a link's plane at a place, by the solver's velocities of two of its joints."""
    if link is None:
        return 0j
    if link.slider is not None:
        guide = next(
            one for joint in scene.linkage.joints for one in joint.slides if one.point == link.slider
        )
        rate = rate_of(pose, *guide.axis) if guide.axis else 0.0
        return complex(*pose.velocity[link.slider]) + 1j * rate * (at - complex(*pose.position[link.slider]))
    first, second = link.joints[:2]
    turning = 1j * rate_of(pose, first, second)
    return complex(*pose.velocity[first]) + turning * (at - complex(*pose.position[first]))


def rate_of(pose: Pose, first: str, second: str) -> float:
    (x0, y0), (x1, y1) = pose.position[first], pose.position[second]
    (u0, v0), (u1, v1) = pose.velocity[first], pose.velocity[second]
    arm = (x1 - x0, y1 - y0)
    return float(cross(arm, (u1 - u0, v1 - v0)) / (arm[0] ** 2 + arm[1] ** 2))


@pytest.mark.parametrize("number", range(20))
def test_at_their_centre_two_links_have_one_velocity(number: int) -> None:
    scene = drawn(number)
    links = figure(scene).by_number
    assert len(links) in {4, 5}
    for phase in (0.3, 1.9, 3.5, 5.1):
        pose = scene.pose(phase, 2)
        for one, other in combinations(links.values(), 2):
            found = centre(pose, one, other)
            assert found is not None
            if found.place is None:
                # they turn alike, and move against each other across the way to it
                apart = velocity(pose, scene, one, 0j) - velocity(pose, scene, other, 0j)
                again = velocity(pose, scene, one, 1 + 1j) - velocity(pose, scene, other, 1 + 1j)
                fast = abs(pose.coordinate_rate) * scene.linkage.extent
                assert abs(apart - again) <= EXACT * fast
                assert abs((apart * found.direction.conjugate()).real) <= EXACT * fast
                assert abs(found.direction) == pytest.approx(1.0)
            else:
                mine, theirs = (velocity(pose, scene, link, found.place) for link in (one, other))
                fast = abs(pose.coordinate_rate) * (scene.linkage.extent + abs(found.place))
                assert abs(mine - theirs) <= EXACT * fast


@pytest.mark.parametrize("number", range(20))
def test_kennedy_s_theorem_leads_to_all_centres(number: int) -> None:
    scene = drawn(number)
    links = figure(scene).by_number
    steps = kennedy(scene.linkage, links)
    adjacent = {4: 4, 5: 6}[len(links)]  # of five links a gear pair is one
    assert len(steps) == math.comb(len(links), 2) - adjacent
    assert all(len(step.by) == 2 for step in steps)
    pose = scene.pose(0.7, 2)
    for step in steps:
        for third in step.by:
            pairs = (step.pair, (step.pair[0], third), (third, step.pair[1]))
            known = [centre(pose, *(links[number] for number in pair)) for pair in pairs]
            at = [one.place for one in known if one and one.place is not None]
            way = [one.direction for one in known if one and one.place is None]
            if len(at) == 3:
                across = ((at[1] - at[0]).conjugate() * (at[2] - at[0])).imag
                assert abs(across) <= 1e-9 * abs(at[1] - at[0]) * abs(at[2] - at[0])
            elif len(at) == 2:
                across = ((at[1] - at[0]).conjugate() * way[0]).imag
                assert abs(across) <= 1e-9 * abs(at[1] - at[0])


def test_the_steps_of_a_four_bar_and_of_a_geared_five_bar() -> None:
    scene = load("crank-rocker")
    assert kennedy(scene.linkage, figure(scene).by_number) == (
        KennedyStep(("1", "3"), ("2", "4")),
        KennedyStep(("2", "4"), ("1", "3")),
    )
    scene = load("geared-five-bar-2-1")
    found = kennedy(scene.linkage, figure(scene).by_number)
    assert [step.pair for step in found] == [("2", "4"), ("1", "4"), ("1", "3"), ("3", "5")]


# scene, a block that no body is: the pin in a slot, the swivel on a rod
BLOCKS = [("inverted-slider-crank", ["A"]), ("oscillating-cylinder", ["O4"]), ("slider-crank", [])]


@pytest.mark.parametrize(("name", "points"), BLOCKS)
def test_a_block_without_a_name_is_a_link(name: str, points: list[str]) -> None:
    scene = load(name)
    assert [block.slider for block in blocks(scene.linkage)] == points
    links = figure(scene).by_number
    assert [*links] == ["1", "2", "3", "4"]
    for phase in (0.0, math.pi / 2, math.pi):  # also where the block stands on its guide
        pose = scene.pose(phase, 2)
        slid = [centre(pose, *pair) for pair in combinations(links.values(), 2)]
        assert sum(found is not None and found.place is None for found in slid) >= 1


def test_a_shared_joint_is_the_centre_to_the_last_bit() -> None:
    scene = load("slider-crank")
    links, pose = figure(scene).by_number, scene.pose(1.3, 2)
    for pair, joint in {("1", "2"): "O2", ("2", "3"): "A", ("3", "4"): "B"}.items():
        one, other = (links[number] for number in pair)
        assert joint_between(scene.linkage, one, other) == joint
        found = centre(pose, one, other)
        assert found is not None
        assert found.place == complex(*pose.position[joint])


def test_what_is_held_together_is_one_link() -> None:
    assert [*figure(load("excavator")).by_number] == ["1", "2"]
