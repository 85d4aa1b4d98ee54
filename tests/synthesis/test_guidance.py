"""Poses to linkages: published ones again, known ones among the answers, defects as the solver has them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from random_poses import of_four_bars, of_slider_cranks, runs_through

import linkanim
from linkanim.errors import BadInput
from linkanim.mechanics.measures import as_complex, transmission_angle
from linkanim.synthesis.burmester import CentreCurve, Poses, slide_points
from linkanim.synthesis.guidance import GuidedLinkage, answers, apart, followed, task_of

DEGREE = math.pi / 180
LID = [(0, 0, 0), (40, 10, 35 * DEGREE), (70, -5, 80 * DEGREE)]


def verify(found: GuidedLinkage) -> None:
    """Hold what an answer says of itself against the solver's own motion of its scene."""
    poses, scene = found.task.poses, found.scene
    size = max(found.size, poses.size)
    rows = np.column_stack([poses.origins.real, poses.origins.imag, poses.angles])
    assert found.error < 1e-12 * size
    assert runs_through(scene, rows, -found.lean, 1e-2) == (not found.defects)
    assert scene.trace == ("P",)
    motion = scene.solve(phase=found.phases, derivatives=0)
    off = np.abs(as_complex(motion.position["P"]) - poses.origins)
    if "circuit" not in found.defects:
        assert off.max() < 1e-12 * size
        turned = np.asarray(motion.angle[found.task.kind.links[1]]) - poses.angles
        # as far as a point at the poses' size is off by it
        assert poses.size * np.abs(np.sin((turned - turned[0]) / 2)).max() < 1e-12 * size
        assert np.cos(motion.coordinate - found.angles) == pytest.approx(1)
    if not found.defects:
        first, last = np.unwrap(found.phases, period=scene.period)[[0, -1]]
        if scene.info.full_turn:
            last = first + found.sense * (((last - first) * found.sense) % scene.period)
        way = scene.solve(phase=np.linspace(first, last, 20_001), derivatives=0)
        least = float(np.min(transmission_angle(way, "B")))
        assert found.transmission_angle == pytest.approx(least, abs=1e-5)


def known_is_found(
    found: Sequence[GuidedLinkage], pivots: Sequence[complex], joints: Sequence[complex]
) -> float:
    """Return how far the nearest answer's joints and pivots are from the known linkage's."""
    bars = [np.array([joint, pivot]) for joint, pivot in zip(joints, pivots, strict=True)]
    ways = [(one.bars, order) for one in found for order in (bars, bars[::-1])]
    return min(float(max(np.abs(a - b).max() for a, b in zip(*way, strict=True))) for way in ways)


def of_known(count: int, number: int, seed: int) -> None:
    for known in of_four_bars(seed + count, count, number):
        pivots = [(pivot.real, pivot.imag) for pivot in known.pivots] if count < 5 else []
        found = linkanim.guide(known.rows, pivots=pivots, largest=1e6, count=6 if count == 5 else 2)
        if count > 2:  # two poses leave a choice at given pivots, too
            assert known_is_found(found, known.pivots.tolist(), known.joints.tolist()) < 1e-9
        for one in (*found, *linkanim.guide(known.rows, largest=1e6, count=2)):
            verify(one)


@pytest.mark.parametrize("count", [2, 3, 4, 5])
@pytest.mark.slow
def test_a_known_four_bar_is_among_the_answers(count: int) -> None:
    of_known(count, 1, 900)


# Of three poses in a hundredth of a millimetre, and of two in a tenth of a micrometre.
@pytest.mark.parametrize(("count", "apart"), [(2, 1e-2), (2, 1e-4), (2, 1e-6), (3, 1e-2), (3, 1e-4)])
@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
def test_given_pivots_are_kept_to_the_last_digit_however_near_the_poses_are(
    kind: str, count: int, apart: float
) -> None:
    poses = np.array([10.0, 20.0, 0.3]) + apart * np.random.default_rng(3).normal(size=(count, 3)) * [
        50,
        50,
        1,
    ]
    for pivots in ([(30.1, -40.3)], [(30.1, -40.3), (80.7, -20.9)])[: 2 if kind == "four-bar" else 1]:
        for one in linkanim.guide(poses, kind=kind, pivots=pivots, count=3, largest=1e7):
            pins = [tuple(pin.position) for pin in one.scene.linkage.pins]
            assert set(pivots) <= set(pins)
            assert one.error < 1e-12


# Of the first the curve of centre points all but crosses itself near a pivot.
@pytest.mark.parametrize("number", [150, 4])
def test_pivots_of_four_poses_are_kept_where_their_curve_is_hardly_one(number: int) -> None:
    *_, known = of_four_bars(604, 4, number + 1)
    pivots = [(pivot.real, pivot.imag) for pivot in known.pivots]
    found = linkanim.guide(known.rows, pivots=pivots, largest=1e6, count=2)
    assert known_is_found(found, known.pivots.tolist(), known.joints.tolist()) < 1e-10


@pytest.mark.long
@pytest.mark.parametrize("count", [2, 3, 4, 5])
def test_a_thousand_known_four_bars_are_among_the_answers(count: int) -> None:
    of_known(count, 250, 600)


@pytest.mark.parametrize("count", [2, 3, 4, 5])
@pytest.mark.slow
def test_a_known_slider_crank_is_among_the_answers(count: int) -> None:
    (known,) = of_slider_cranks(11 + count, count, 1)
    pivot = (known.pivots[0].real, known.pivots[0].imag)
    found = linkanim.guide(known.rows, kind="slider-crank", pivots=[pivot], largest=1e6)
    if count > 3:
        # three poses leave a circle of sliders
        assert min(abs(one.bars[1][0] - known.joints[1]) for one in found) < 1e-9
    for one in found:
        verify(one)


def polar(length: float, angle: float) -> complex:
    return cmath.rect(length, angle * DEGREE)


# Norton, Design of Machinery, examples 5-1 and 5-2: P21 and δ2, P31 and δ3, the turns α; of each dyad Z and
# its angle φ, or β; what is printed is W and its angle, and U.
def test_norton_s_example_of_two_positions() -> None:
    shift = polar(2.416, 165.2)
    for arm, turned, length, angle in (
        (polar(1.298, 26.5), 38.4, "2.467", "71.6"),
        (polar(1.035, 104.1), 85.6, "1.486", "15.4"),
    ):
        joint = -arm
        # the pivot lies on the midline, from where the bar turns by β
        other = shift - arm * np.exp(1j * 43.3 * DEGREE)
        pivot = (other - joint * np.exp(1j * turned * DEGREE)) / (1 - np.exp(1j * turned * DEGREE))
        rows = [(0, 0, 0), (shift.real, shift.imag, 43.3 * DEGREE)]
        poses = linkanim.guide(rows, pivots=[(pivot.real, pivot.imag)], count=1)[0].task.poses
        assert abs(np.diff(np.abs(poses.places(joint) - pivot))[0]) < 1e-12
        bar = joint - pivot
        assert f"{abs(bar):.3f}" == length
        assert f"{np.angle(bar, deg=True):.1f}" == angle


def test_norton_s_example_of_three_positions() -> None:
    second, third = polar(2.798, -31.19), polar(3.919, -16.34)
    rows = [(0, 0, 0), (second.real, second.imag, -45 * DEGREE), (third.real, third.imag, 9.3 * DEGREE)]
    turned = np.array([[342.3, 324.8], [30.9, 80.6]]) * DEGREE
    pivots = []
    for two, three in turned:
        ways = np.exp(1j * np.array([[two, -math.pi / 4], [three, 9.3 * DEGREE]])) - 1
        bar, arm = np.linalg.solve(ways, [second, third])
        pivots.append(-bar - arm)
    (found,) = linkanim.guide(rows, pivots=[(pivot.real, pivot.imag) for pivot in pivots])
    lengths = sorted((found.parameters["crank"], found.parameters["rocker"]))
    assert f"{lengths[1]:.3f}" == "6.832"
    verify(found)


@pytest.mark.slow
def test_the_first_answer_is_the_one_to_build_and_the_others_follow_by_size() -> None:
    found = linkanim.guide(LID)
    assert len(found) == 6
    sound = [one for one in found if not one.defects]
    assert found[: len(sound)] == tuple(sound)
    assert sound[0].transmission_angle > math.radians(29.9)
    assert [one.size for one in sound[1:]] == sorted(one.size for one in sound[1:])


def test_answers_differ_and_those_without_defects_come_first() -> None:
    found = linkanim.guide(LID, count=5)
    assert [len(one.defects) for one in found] == sorted(len(one.defects) for one in found)
    for n, one in enumerate(found):
        verify(one)
        assert all(apart(one, other) > 0.1 for other in found[:n])
    compact, wide = (linkanim.guide(LID, count=1, prefer=prefer)[0] for prefer in ("compact", "angle"))
    assert compact.size <= found[0].size <= wide.size
    assert compact.transmission_angle <= found[0].transmission_angle <= wide.transmission_angle


@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
def test_limits_are_kept(kind: str) -> None:
    box = (0, -60, 60, 50)
    for one in linkanim.guide(LID, kind=kind, box=box, largest=1.5, least_angle=0.5, count=3):
        verify(one)
        assert one.size <= 1.5 * one.task.poses.size
        assert one.transmission_angle >= 0.5
        pins = [pin.position for pin in one.scene.linkage.pins]
        assert all(0 <= x <= 60 and -60 <= y <= -10 for x, y in pins)


def within(box: Sequence[float], place: Sequence[float]) -> bool:
    return all(low <= at <= low + side for at, low, side in zip(place, box[:2], box[2:], strict=True))


ROOMS = ((-30.0, 30.0, 60.0, 60.0), (30.0, -90.0, 60.0, 95.0))


@pytest.mark.parametrize("count", [2, 3, 4])
def test_of_two_boxes_each_has_a_pin(count: int) -> None:
    for one in linkanim.guide(turned(*POSES[:count]), box=ROOMS, count=3):
        verify(one)
        pins = [pin.position for pin in one.scene.linkage.pins]
        assert any(all(map(within, ROOMS, order)) for order in (pins, pins[::-1]))


def test_a_box_is_for_the_pin_that_is_not_given_and_the_other_stands_where_it_is() -> None:
    for one in linkanim.guide(LID, pivots=[(0, 60)], box=(30, -20, 40, 40), count=3):
        verify(one)
        first, second = sorted((pin.position for pin in one.scene.linkage.pins), key=lambda at: at[0])
        assert list(first) == [0, 60]
        assert within((30, -20, 40, 40), second)


def test_a_small_box_on_the_curve_of_centre_points_is_found() -> None:
    poses = turned(*POSES[:4])
    row = np.array(poses)
    curve = CentreCurve(Poses(row[:, 0] + 1j * row[:, 1], row[:, 2].copy()))
    at = curve.nearest(30 + 45j)
    box = (at.real - 0.5, at.imag - 0.5, 1.0, 1.0)
    for one in linkanim.guide(poses, box=[box, ROOMS[1]], count=2):
        assert any(within(box, pin.position) for pin in one.scene.linkage.pins)


def test_parallel_poses_on_a_circle_are_a_parallelogram_s() -> None:
    places = 20 * np.exp(1j * np.array([0.1, 0.7, 1.5, 2.6]))
    rows = np.column_stack([places.real, places.imag, np.zeros(4)])
    for one in linkanim.guide(rows, count=3):
        verify(one)
        assert one.parameters["crank"] == pytest.approx(20)
        assert one.parameters["rocker"] == pytest.approx(20)


# Crank-rocker 100, 30, 90, 80 at angles of its crank: poses taken from its two circuits, out of order; and
# of a four-bar whose crank swings from both its branches.
@pytest.mark.parametrize(
    ("lengths", "angles", "sides", "defects"),
    [
        ((100, 30, 90, 80), (10, 60, 130), (1, 1, 1), ()),
        ((100, 30, 90, 80), (10, 60, 130), (1, 1, -1), ("circuit",)),
        ((100, 30, 90, 80), (10, 130, 60, 200), (1, 1, 1, 1), ("order",)),
        # any three places of a turn are in order, one way round or the other
        ((100, 30, 90, 80), (130, 10, 60), (1, 1, 1), ()),
        ((100, 80, 40, 70), (20, 40, 50), (1, 1, 1), ()),
        ((100, 80, 40, 70), (20, 40, 50), (1, 1, -1), ("branch",)),
        ((100, 80, 40, 70), (20, 50, 40), (1, 1, 1), ("order",)),
        # a double-rocker of Grashof's: its crank swings above the ground line, or below
        ((60, 80, 30, 90), (60, 80, 100), (1, 1, 1), ()),
        ((60, 80, 30, 90), (60, 80, -90), (1, 1, 1), ("circuit",)),
        ((60, 80, 30, 90), (60, 80, 100), (1, -1, 1), ("branch",)),
    ],
)
def test_defects_are_told(
    lengths: tuple[float, ...], angles: tuple[float, ...], sides: tuple[int, ...], defects: tuple[str, ...]
) -> None:
    r1, r2, r3, r4 = lengths
    crank = r2 * np.exp(1j * np.array(angles) * DEGREE)
    way = r1 - crank
    square = np.abs(way) ** 2
    root = np.array(sides) * np.sqrt(((r3 + r4) ** 2 - square) * (square - (r3 - r4) ** 2))
    coupler = way * (square + (r3 - r4) * (r3 + r4) + 1j * root) / (2 * square * r3)
    origins = crank + (40 + 30j) * coupler
    rows = np.column_stack([origins.real, origins.imag, np.angle(coupler)])
    found = linkanim.guide(rows, pivots=[(0, 0), (r1, 0)], largest=100)
    driven = [one for one in found if abs(one.parameters["x"]) < 1e-9] or found
    for one in found:
        verify(one)
    if abs(driven[0].parameters["x"]) < 1e-9:
        assert driven[0].defects == defects
    else:
        # from the other side it runs without
        assert driven[0].defects == ()


def turned(*rows: tuple[float, float, float]) -> list[tuple[float, float, float]]:
    return [(x, y, angle * DEGREE) for x, y, angle in rows]


def about(point: complex, *angles: float) -> list[tuple[float, float, float]]:
    places = [point + (30 + 10j - point) * np.exp(1j * angle * DEGREE) for angle in angles]
    return [(place.real, place.imag, angle * DEGREE) for place, angle in zip(places, angles, strict=True)]


SHIFTED = turned((0, 0, 0), (10, 4, 0), (30, -5, 0), (50, 20, 0))
IMAGINARY = turned((9, 24, -20), (80, 58, 3), (9, 43, -12), (48, 16, 16), (73, 11, 43))
ROUND = turned((20, 0, 0), (0, 20, 0), (-20, 0, 0), (12, 16, 0))
POSES = (0, 0, 0), (40, 10, 35), (70, -5, 80), (90, -40, 120)
FOUR = turned(*POSES)
FIVE = [*FOUR, (60, -80, 170 * DEGREE)]


@pytest.mark.parametrize(
    ("poses", "options", "said"),
    [
        (turned((0, 0, 0)), {}, "1 poses: a coupler is guided through 2 to 5"),
        ([*FIVE, (0, -90, 3.0)], {}, "6 poses"),
        ([(0, 0), (1, 1)], {}, "give a row of x, y and angle"),
        (turned((0, 0, 0), (math.nan, 0, 0)), {}, "pose 2 is not finite"),
        (turned((0, 0, 0), (5, 5, 9), (5, 5, 9)), {}, "poses 2 and 3 are one"),
        (turned((0, 0, 0), (1e-12, 0, 0), (50, 20, 30)), {}, "poses 1 and 2 are one"),
        (turned((0, 0, 0), (5, 5, 9), (9, 5, 400)), {}, "poses 1 and 3 are turned by 400 deg"),
        (turned((0, 0, 0), (9, 0, 360)), {}, "poses 1 and 2 are turned by 360 deg"),
        (turned((0, 0, 0), (0, 0, 360)), {}, "poses 1 and 2 are turned by 360 deg"),
        (turned((0, 0, 0), (5, 0, -400)), {}, "poses 1 and 2 are turned by -400 deg"),
        (turned((0, 0, 0), (4e31, 0, 9)), {}, "pose 2 lies beyond 1e.30; take a larger unit"),
        (turned((0, 0, 0), (4, 0, math.inf)), {}, "pose 2 is not finite"),
        ("abc", {}, "poses are numbers"),
        ([("a", 0, 0), (1, 1, 1)], {}, "poses are numbers"),
        ([], {}, "give a row of x, y and angle"),
        (about(7 - 3j, 0, 30, 70), {}, "all poses turn about one point, 7, -3"),
        (about(0j, 0, 30, 70, -20, 90), {}, "all poses turn about one point"),
        (turned((4, 4, 0), (4, 4, 30), (4, 4, 70)), {}, "all poses turn about one point, 4, 4"),
        (
            turned(*((2.1e10, 2.1e10, 10 * n) for n in range(4))),
            {},
            "all poses turn about one point, 2.1e.10",
        ),
        (LID, {"kind": "six-bar"}, "take four-bar or slider-crank"),
        (LID, {"pivots": [(0, 0), (1, 1), (2, 2)]}, "has 2 fixed pins; 3 are given"),
        (LID, {"pivots": [(0, 0)] * 2, "kind": "slider-crank"}, "has 1 fixed pins; 2 are given"),
        (LID, {"pivots": [(math.inf, 0)]}, "give x and y, each a number"),
        (LID, {"pivots": ["a"]}, "give x and y, each a number"),
        (LID, {"pivots": [(1, 2, 3)]}, "give x and y, each a number"),
        (LID, {"pivots": [(5, 5), (5, 5)]}, "both pivots are given at 5, 5, so there is no ground link"),
        (LID[:2], {"pivots": [(5, 5), (5, 5)]}, "both pivots are given at 5, 5, so there is no ground link"),
        (LID, {"pivots": [(0, 0), (30, 0)], "box": (20, -5, 20, 9)}, "pivot at 0, 0 lies outside the box"),
        (LID, {"pivots": [(0, 0)], "box": [(9, 9, 9, 9)] * 2}, "2 boxes are given, and one fixed pin"),
        (LID, {"box": [(9, 9, 9, 9)] * 3}, "3 boxes are given, and 2 fixed pins are free"),
        (LID, {"box": [(9, 9, 9, 9), (0, 0, 0, 9)]}, "nothing fits in it"),
        (LID, {"box": [(9000, 0, 9, 9), (0, 0, 9, 9)]}, "keeps to a pin in each box"),
        (FOUR, {"box": [(0, 40, 30, 30), (130, -90, 60, 9)]}, "no centre point of these four poses lies in"),
        (LID, {"box": (0, 0, math.nan, 1)}, "give x, y, width and height"),
        (LID, {"least_angle": 1.57}, "the least transmission angle; give it more room"),
        (LID, {"count": 0}, "from 1 to 50"),
        (LID, {"prefer": "exact"}, "take compact or angle"),
        (LID, {"largest": -1}, "give the longest link in sizes of the poses"),
        (LID, {"least_angle": 2}, "give 0 to 90 deg"),
        (LID, {"box": (0, 0, 0, 9)}, "nothing fits in it"),
        (LID, {"box": (9000, 0, 9, 9)}, "keeps to the box"),
        (LID, {"largest": 0.01}, "sizes of the poses at the least, 0.01 are allowed"),
        (LID, {"unit": "ft"}, "ft"),
        # parallel poses whose places lie on no circle and no line
        (SHIFTED, {}, "no circle"),
        # of parallel poses in one line no point stays on a circle: three, four and five of them
        (turned((0, 0, 0), (10, 0, 0), (20, 0, 0)), {}, "these 3 poses are parallel"),
        (turned((0, 0, 0), (10, 5, 0), (20, 10, 0), (36, 18, 0)), {}, "these 4 poses are parallel"),
        (turned((0, 0, 0), (9, 0, 0), (2, 0, 0), (3, 0, 0), (5, 0, 0)), {}, "these 5 poses are parallel"),
        (turned((0, 0, 0), (10, 0, 0), (20, 0, 0)), {"kind": "slider-crank"}, "these 3 poses are parallel"),
        (SHIFTED[:3], {"kind": "slider-crank"}, "so none can slide; turn them against each other"),
        # four of five are parallel, or three
        (
            turned((0, 0, 0), (40, 10, 0), (70, -5, 0), (90, -40, 0), (20, 60, 20)),
            {},
            "four or more of these five poses are parallel",
        ),
        (
            turned((0, 0, 0), (40, 10, 0), (70, -5, 0), (90, -40, 80), (20, 60, 20)),
            {},
            "none of Burmester's four points is real",
        ),
        (ROUND, {"kind": "slider-crank"}, "turn them against each other, or take a four-bar"),
        (FIVE, {"kind": "slider-crank"}, "leave one out, or take a four-bar"),
        (FOUR, {"pivots": [(500, 500)]}, "is no centre point of these four poses; the nearest one is"),
        (IMAGINARY, {}, "none of Burmester's four points is real"),
        (FIVE, {"pivots": [(500, 500)]}, "five poses leave no choice of pivots, theirs are"),
    ],
)
def test_what_cannot_be_is_said(poses: list[tuple[float, ...]], options: dict[str, Any], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        linkanim.guide(poses, **options)


# Odd sets that can be met all the same.
ODD = {
    "a half turn": turned((0, 0, 0), (40, 10, 180), (20, -30, 90)),
    "all but a whole turn": turned((0, 0, 0), (40, 10, 359.9)),
    "two at one place": turned((4, 4, 0), (4, 4, 30), (50, 10, 60)),
    "two that are shifted": turned((0, 0, 0), (10, 5, 0)),
    "two pairs of parallel ones": turned((0, 0, 0), (40, 10, 0), (70, -5, 80), (90, -40, 80)),
    "three of four parallel": turned((0, 0, 0), (40, 10, 0), (70, -5, 0), (90, -40, 80)),
    "three of four about one pole": [*about(7 - 3j, 0, 30, 70), (80, -40, 1.9)],
    "four of five about one pole": [*about(7 - 3j, 0, 30, 70, 110), (80, -40, 1.9)],
    "two all but one": turned((0, 0, 0), (1e-7, 0, 0), (50, 20, 30)),
}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", ODD)
def test_odd_sets_that_can_be_met_are_met(name: str) -> None:
    for one in linkanim.guide(ODD[name], count=1):
        assert one.error < 1e-11 * max(one.size, one.task.poses.size)


def test_a_pivot_whose_images_lie_in_line_is_refused() -> None:
    rows = np.array(LID)
    poses = Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2])
    # what the ground is to the body: a fixed point that slides as the body sees it
    (point,) = slide_points(Poses(poses.images(0), -rows[:, 2]), np.array([1.0]))
    with pytest.raises(BadInput, match="it lies in one line in all poses"):
        linkanim.guide(LID, pivots=[(point.real, point.imag)])


DRAGGED = [*((count, "four-bar") for count in (2, 3, 4, 5)), (3, "slider-crank")]


@pytest.mark.thinned(3)
@pytest.mark.parametrize(("count", "kind"), DRAGGED)
def test_a_pose_that_is_dragged_takes_the_linkage_with_it(count: int, kind: str) -> None:
    rows = np.array(FIVE[:count])
    task = task_of(rows, kind=kind, largest=50)
    now = answers(task, 1)[0]
    for step in range(5):
        rows[1] += (0.01 * task.poses.size, 0.005 * task.poses.size, 0.0015)
        task = task_of(rows, kind=kind, largest=50)
        after = followed(task, now)
        assert after is not None, step
        # a small step of the pose is a small step of the linkage
        assert apart(now, after) < 0.5
        now = after
    verify(now)
