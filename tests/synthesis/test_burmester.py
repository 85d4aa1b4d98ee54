"""Circle points and centre points: on circles, on their curve, as many as an independent solver has."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from random_poses import of_four_bars, of_slider_cranks, real_burmester_points

from linkanim.errors import BadInput
from linkanim.synthesis.burmester import (
    Bars,
    CentreCurve,
    Poses,
    ball_point,
    burmester_points,
    centre_points,
    circle_points,
    slide_points,
    slides_through,
)
from linkanim.synthesis.linkages import Real

DEGREE = math.pi / 180


def poses_of(rows: Real) -> Poses:
    return Poses(rows[:, 0] + 1j * rows[:, 1], np.array(rows[:, 2]))


def deviation(poses: Poses, bars: Bars) -> float:
    """Return by how much the bars' lengths differ from pose to pose, in shares of the longer and the size."""
    lengths = np.abs(poses.places(bars.circle) - bars.centre[:, None])
    return float((np.ptp(lengths, axis=1) / np.maximum(lengths.max(axis=1), poses.size)).max(initial=0.0))


def five(number: int) -> None:
    for known in of_four_bars(501, 5, number):
        poses = poses_of(known.rows)
        bars = burmester_points(poses)
        assert len(bars.centre) == real_burmester_points(known.rows)
        assert deviation(poses, bars) < 1e-12
        for pivot, joint in zip(known.pivots, known.joints, strict=True):
            assert (np.abs(bars.centre - pivot) + np.abs(bars.circle - joint)).min() < 1e-9


def test_five_poses_of_a_four_bar_have_its_bars_and_as_many_as_fifty_digits_tell() -> None:
    five(6)


@pytest.mark.long
def test_five_poses_of_a_thousand_four_bars() -> None:
    five(1000)


def four(number: int) -> None:
    for known in of_four_bars(401, 4, number):
        poses = poses_of(known.rows)
        curve = CentreCurve(poses)
        bars = curve.bars(60)
        assert len(bars.centre) > 40
        assert deviation(poses, bars) < 1e-12
        for place in (*known.pivots, *poses.poles.values()):
            # the curve runs through all pivots that there are, and through the poles
            assert abs(curve.nearest(complex(place)) - place) < 1e-9 * max(1.0, abs(place))
        assert np.abs(circle_points(poses, known.pivots) - known.joints).max() < 1e-9
        for circuit in range(len(curve.circuits)):
            # walked smoothly and closed, as the sphere sees it, on which infinity is a point like others
            walk = curve.at(circuit, np.linspace(1e-4, math.tau + 1e-4, 16_001))
            walk = (walk[np.isfinite(walk)] - poses.centre) / poses.size
            far = np.sqrt(1 + np.abs(walk) ** 2)
            steps = np.abs(np.diff(walk)) / (far[1:] * far[:-1])
            assert steps.max() < 0.2
            assert abs(walk[-1] - walk[0]) < 1e-6 * far[0] ** 2


def test_four_poses_have_a_curve_through_pivots_and_poles() -> None:
    four(12)


@pytest.mark.long
def test_four_poses_of_a_thousand_four_bars() -> None:
    four(1000)


def test_three_poses_lead_from_each_joint_to_its_pivot_and_back() -> None:
    for known in of_four_bars(301, 3, 50):
        poses = poses_of(known.rows)
        assert np.abs(circle_points(poses, known.pivots) - known.joints).max() < 1e-9
        assert np.abs(centre_points(poses, known.joints) - known.pivots).max() < 1e-9


def test_three_poses_have_a_circle_of_points_that_slide() -> None:
    for known in of_slider_cranks(302, 3, 30):
        poses = poses_of(known.rows)
        points = slide_points(poses, np.linspace(0, math.tau, 9))
        ways = (poses.places(points) - points[:, None]) / slides_through(poses, points).direction[:, None]
        assert np.abs(ways.imag).max() < 1e-12 * max(1.0, float(np.abs(points).max()))
        # the slider's own joint lies on that circle
        middle = np.mean(points[:-1])
        radius = abs(points[0] - middle)
        assert abs(abs(known.joints[1] - middle) - radius) < 1e-9 * radius


@pytest.mark.parametrize("count", [4, 5])
def test_ball_s_point_of_a_slider_crank_is_its_slider(count: int) -> None:
    for known in of_slider_cranks(402, count, 40):
        (point,), (way,) = ball_point(poses_of(known.rows))
        assert abs(point - known.joints[1]) < 1e-9
        assert abs((way / known.pivots[1]).imag) < 1e-9


def test_five_poses_whose_origins_lie_in_line_have_their_bars() -> None:
    """A body led along a line, by its slider: one centre point lies at infinity, the others are found."""
    for known in of_slider_cranks(503, 5, 12):
        arm = known.joints[1] - (known.rows[0, 0] + 1j * known.rows[0, 1])
        origins = known.rows[:, 0] + 1j * known.rows[:, 1]
        origins = origins + arm * np.exp(1j * (known.rows[:, 2] - known.rows[0, 2]))
        poses = Poses(origins, known.rows[:, 2])
        bars = burmester_points(poses)
        assert deviation(poses, bars) < 1e-12
        assert (np.abs(bars.centre - known.pivots[0]) + np.abs(bars.circle - known.joints[0])).min() < 1e-9


def test_poses_of_a_four_bar_have_no_slider_but_by_chance() -> None:
    for known in of_four_bars(403, 5, 10):
        assert len(ball_point(poses_of(known.rows)).point) == 0


@pytest.mark.parametrize(
    ("angles", "places"),
    [
        # mirror images in pairs: the cubic falls into a line and a circle
        ([20, 50, -50, -20], [30 + 5j, 60 + 40j, -60 + 40j, -30 + 5j]),
        # two poses parallel: one pole lies at infinity
        ([0, 40, 40, 90], [0, 30 + 10j, 70 - 5j, 90 + 60j]),
        # two pairs of parallel poses
        ([0, 0, 40, 40], [0, 30 + 10j, 70 - 5j, 90 + 60j]),
        # half a turn between two
        ([0, 180, 40, 90], [0, 30 + 10j, 70 - 5j, 90 + 60j]),
    ],
)
def test_a_curve_that_is_special_is_walked_all_the_same(angles: list[float], places: list[complex]) -> None:
    poses = Poses(np.array(places, dtype=np.complex128), np.array(angles) * DEGREE)
    curve = CentreCurve(poses)
    bars = curve.bars(60)
    assert len(bars.centre) > 40
    assert deviation(poses, bars) < 1e-12


def test_poles_are_points_at_rest() -> None:
    (known,) = of_four_bars(7, 3, 1)
    poses = poses_of(known.rows)
    for (one, other), pole in poses.poles.items():
        places = poses.places(poses.images(pole)[one])
        assert abs(places[one] - pole) < 1e-12
        assert abs(places[other] - pole) < 1e-12


def test_a_large_shift_and_scale_change_nothing_else() -> None:
    (known,) = of_four_bars(8, 5, 1)
    bars = burmester_points(poses_of(known.rows))
    turn = 1e4 * cmath.exp(0.7j)
    moved = (known.rows[:, 0] + 1j * known.rows[:, 1]) * turn
    other = burmester_points(Poses(moved, known.rows[:, 2] + 0.7))
    for centre in bars.centre * turn:
        assert np.abs(other.centre - centre).min() < 1e-7


@pytest.mark.parametrize(
    ("places", "angles", "said"),
    [
        ([0], [0], "1 poses: a coupler is guided through 2 to 5"),
        ([0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 4, 5], "6 poses"),
        ([0, 1, math.nan], [0, 10, 20], "pose 3 is not finite"),
        ([0, 1, 2], [0, math.inf, 20], "pose 2 is not finite"),
        ([0, 1, 2], [0, 10, 375], "poses 1 and 3 are turned by 375 deg"),
        ([0, 1, 2], [-200, 10, 180], "poses 1 and 3 are turned by 380 deg"),
        ([0, 1, 2], [0, 10, 360], "poses 1 and 3 are turned by 360 deg"),
        ([0, 1, 0], [0, 10, 0], "poses 1 and 3 are one"),
        ([0, 5, 5], [0, 10, 10], "poses 2 and 3 are one"),
    ],
)
def test_poses_that_are_none_are_refused(places: list[complex], angles: list[float], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        Poses(np.array(places, dtype=np.complex128), np.array(angles) * DEGREE)


def test_the_circle_points_are_the_centre_points_of_the_inverse_motion() -> None:
    (known,) = of_four_bars(31, 4, 1)
    poses = poses_of(np.array(known.rows))
    bars, inverse = CentreCurve(poses).bars(40), CentreCurve(poses.inverse)
    assert poses.inverse.inverse.origins == pytest.approx(poses.origins)
    for circle, centre in zip(*bars, strict=True):
        assert abs(inverse.nearest(complex(circle)) - circle) < 1e-7 * max(poses.size, abs(circle))
        assert centre_points(poses, np.array([circle]))[0] == pytest.approx(centre, rel=1e-5, abs=1e-5)
