"""The phase at which a point is nearest to a place: against a dense search, between equal poses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from linkanim.mechanics.nearest import PointPath
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

_FINER = 16
"""How many times as dense the search is that it is held against."""
_SMALL = 12
_MANY = 200


def moving(scene: Scene) -> list[PointPath]:
    courses = [scene.point_path(joint) for joint in scene.pose(0.0, 0).position]
    return [one for one in courses if one.moves]


def hands(course: PointPath, count: int) -> np.ndarray:
    """Return random places about a course, some far outside, and some right on it."""
    chance = np.random.default_rng(count)
    low = complex(course.places.real.min(), course.places.imag.min())
    high = complex(course.places.real.max(), course.places.imag.max())
    free = chance.uniform(-1.0, 1.0, (count, 2)) @ [1.0, 1.0j]
    about = (low + high) / 2 + free * course.size * chance.choice([0.4, 1.0, 3.0], count)
    on = chance.choice(course.places, count)
    return np.where(chance.random(count) < 0.8, about, on)


def farther(scene: Scene, course: PointPath, place: complex, least: float) -> float:
    """Return by how much of the course's size the pose found is farther from a place than the least."""
    phase = course.nearest((place.real, place.imag), 0.3)
    found = complex(*scene.pose(phase, 0).position[course.joint])
    return (abs(found - place) - least) / course.size


def worst(name: str, count: int) -> float:
    scene, found = load(name), -math.inf
    for course in moving(scene):
        dense = np.linspace(0.0, scene.period, _FINER * len(course.phases), endpoint=False)
        every = scene.solve(phase=dense, derivatives=0).position[course.joint] @ [1.0, 1.0j]
        for place in hands(course, count):
            found = max(found, farther(scene, course, place, float(np.abs(every - place).min())))
    return found


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_other_pose_is_nearer(name: str) -> None:
    assert worst(name, _SMALL) < 1e-6


@pytest.mark.parametrize("name", names())
@pytest.mark.long
def test_no_other_pose_is_nearer_at_many_places(name: str) -> None:
    assert worst(name, _MANY) < 1e-6


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_place_on_the_course_is_met_and_the_distance_is_least_to_the_last_digits(name: str) -> None:
    scene = load(name)
    for course in moving(scene):
        place = scene.pose(1.2345, 0).position[course.joint]
        phase = course.nearest(place, 1.2)
        found = scene.pose(phase, 0).position[course.joint]
        assert math.dist(found, place) < 1e-9 * course.size


def test_of_equal_poses_the_one_next_to_the_present_one_is_taken() -> None:
    # a rocker's pin passes every place twice in a turn of the crank
    course = load("crank-rocker").point_path("B")
    place = load("crank-rocker").pose(1.0, 0).position["B"]
    there, back = course.nearest(place, 0.9), course.nearest(place, 4.0)
    assert there == pytest.approx(1.0)
    assert back != pytest.approx(1.0, abs=0.5)
    assert abs(back - 4.0) < math.pi
    assert course.nearest(place, 20 * math.pi + 0.9) == pytest.approx(20 * math.pi + 1.0)


@pytest.mark.parametrize("forward", [True, False])
def test_pulled_past_its_end_and_back_a_rocker_takes_the_crank_through_the_dead_centre(forward: bool) -> None:
    scene = load("crank-rocker")
    course = scene.point_path("B")
    limit = max((k * 1e-3 for k in range(6283)), key=lambda phase: scene.pose(phase, 0).position["B"][0])
    (x, y), way = scene.pose(limit, 0).position["B"], 1.0 if forward else -1.0
    end = course.nearest((x + 40.0, y), limit, forward=forward)
    inside = scene.pose(end - 0.3, 0).position["B"]
    assert (course.nearest(inside, end, forward=forward) - end) * way > 0.1


def test_within_the_slack_the_hand_stays_on_its_own_part_of_a_curve_that_crosses_itself() -> None:
    scene = load("watt-line")
    course = scene.point_path(scene.trace[0])
    places, step = course.places, 40
    apart = np.abs(places[:, np.newaxis] - places[np.newaxis, ::step])
    near = np.abs(course.phases[:, np.newaxis] - course.phases[np.newaxis, ::step]) < 0.5
    here, there = np.unravel_index(np.where(near, np.inf, apart).argmin(), apart.shape)
    own, other = course.phases[here], course.phases[there * step]
    place = scene.pose(float(other), 0).position[scene.trace[0]]
    assert course.nearest(place, float(own), tolerance=0.05 * course.size) == pytest.approx(own, abs=0.2)


def test_a_joint_that_does_not_move_changes_nothing() -> None:
    course = load("crank-rocker").point_path("O4")
    assert (course.moves, course.nearest((3.0, 4.0), 1.25)) == (False, 1.25)
