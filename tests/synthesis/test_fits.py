"""Points to linkages: exact where a linkage is behind them, published problems, limits, what is refused."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from random_curves import curves, linkages

import linkanim
from linkanim.synthesis.answers import (
    Fit,
    PathAnswer,
    checked,
    checked_by_phase,
    cognates_of,
    turning_cognates,
)
from linkanim.synthesis.atlas import Candidates, atlas, matched
from linkanim.synthesis.curves import DrawnCurve
from linkanim.synthesis.fitting import _solutions, refined
from linkanim.synthesis.linkages import FOUR_BAR, KINDS, Complex, Real
from linkanim.synthesis.path import task_of
from linkanim.synthesis.search import best_of, ranked

PERCENT = 0.01
KUNJUR = [
    (0.5, 1.1), (0.4, 1.1), (0.3, 1.1), (0.2, 1.0), (0.1, 0.9), (0.05, 0.75), (0.02, 0.6), (0, 0.5), (0, 0.4),
    (0.03, 0.3), (0.1, 0.25), (0.15, 0.2), (0.2, 0.3), (0.3, 0.4), (0.4, 0.5), (0.5, 0.7), (0.6, 0.9),
    (0.6, 1.0),
]  # fmt: skip
"""The eighteen points of Kunjur and Krishnamurty (1997): the crank turns by 20° from each to the next."""
NINE = [
    (8.709218, 56.412603), (16.636378, 81.518085), (9.800075, 89.841049), (-7.455324, 83.133307),
    (-19.650068, 66.833128), (-25.501988, 44.546536), (-23.342694, 30.507243), (-11.936231, 25.007218),
    (-1.496144, 36.381880),
]  # fmt: skip
"""Nine points of one coupler curve, which three four-bars trace."""
LINE = [(20, 20 + 5 * step) for step in range(6)]
SQUARE = [(x, 0) for x in range(10)] + [(10, y) for y in range(10)]
SQUARE += [(10 - x, 10) for x in range(10)] + [(0, 10 - y) for y in range(10)]


def traced(fit: Fit, **places: Any) -> Complex:
    """Return the coupler point as the solver has it."""
    return np.asarray(fit.scene.solve(**places, derivatives=0).position["P"] @ np.array([1.0, 1j]))


def as_pairs(points: Complex) -> Real:
    return np.stack([points.real, points.imag], axis=1)


def distances(fit: Fit, points: Complex) -> Real:
    """Return how far the points are from the curve, by golden sections of the crank's turn."""
    turn = np.linspace(0, 2 * math.pi, 8000) if fit.scene.info.full_turn else None
    turn = np.linspace(fit.angles.min(), fit.angles.max(), 8000) if turn is None else turn
    way, step, share = traced(fit, angle=turn), turn[1] - turn[0], (math.sqrt(5) - 1) / 2
    middle = turn[[int(np.abs(way - point).argmin()) for point in points]]
    low, high = middle - step, middle + step
    for _ in range(50):
        one, other = high - share * (high - low), low + share * (high - low)
        nearer = np.abs(traced(fit, angle=one) - points) < np.abs(traced(fit, angle=other) - points)
        low, high = np.where(nearer, low, one), np.where(nearer, other, high)
    return np.asarray(np.abs(traced(fit, angle=(low + high) / 2) - points))


def verify(fit: Fit, points: Complex, *, closed: bool = True) -> None:
    """Hold what a fit says of itself against the solver's own motion."""
    # of a shape that is not followed, what is nearest is not always where a point is passed
    passed = np.abs(traced(fit, angle=fit.angles) - points)
    # where two stretches of a curve all but touch the nearest of its samples may lie on the other one
    nearest = np.minimum(distances(fit, points), passed)
    size = np.hypot(np.ptp(points.real), np.ptp(points.imag))
    for said, least, most in (
        (fit.rms, math.sqrt(np.mean(nearest**2)), math.sqrt(np.mean(passed**2))),
        (fit.largest, nearest.max(), passed.max()),
    ):
        assert least * (1 - 1e-9) - 1e-13 * size <= said <= most * (1 + 1e-9) + 1e-13 * size
    steps = np.diff(fit.angles) * fit.sense
    # where the curve all but turns on the spot two points may be nearest to one place of it
    assert (steps >= 0).all()
    assert fit.scene.trace == ("P",)
    whole = fit.scene.info.transmission
    assert whole is not None
    assert fit.transmission_angle >= whole.least - 1e-12
    if closed:
        assert steps.sum() < 2 * math.pi
        assert fit.scene.info.full_turn
        assert fit.transmission_angle == pytest.approx(whole.least, abs=1e-12)


def squares(fit: Fit) -> float:
    return float(fit.rms**2 * len(fit.angles))


@pytest.mark.parametrize(
    ("kind", "closed"),
    [
        ("four-bar", True),
        ("slider-crank", False),
        *(
            pytest.param(*case, marks=pytest.mark.long)
            for case in (("four-bar", False), ("slider-crank", True))
        ),
    ],
)
@pytest.mark.slow
def test_a_coupler_curve_is_found_again(kind: str, closed: bool) -> None:
    for points in curves(kind, 2, seed=11, turn=1.0 if closed else 0.4)[:1]:
        best = linkanim.path(as_pairs(points), closed, kind=kind, count=1)[0]
        verify(best, points, closed=closed)
        assert best.rms < 0.01 * PERCENT * best.task.curve.size


@pytest.mark.long
@pytest.mark.parametrize(("kind", "seed"), [("four-bar", 101), ("four-bar", 202), ("slider-crank", 303)])
def test_two_hundred_coupler_curves_are_found_again(kind: str, seed: int) -> None:
    errors = []
    for points in curves(kind, 200, seed=seed):
        best = linkanim.path(points, kind=kind, count=1)[0]
        assert best.most_exact
        if best.most_exact.error <= 0.01 * PERCENT * best.task.curve.size:
            assert best.rms <= 2 * best.most_exact.error + 1e-9 * best.task.curve.size
        best = best.most_exact
        errors.append(best.rms / best.task.curve.size / PERCENT)
    assert np.mean(np.array(errors) <= 0.01) >= 0.99
    assert max(errors) <= 0.05


@pytest.mark.long
def test_every_answer_of_a_thousand_is_what_it_says() -> None:
    for points in curves("four-bar", 200, seed=404):
        for fit in linkanim.path(points):
            verify(fit, points)


@pytest.mark.long
@pytest.mark.thinned(2)
@pytest.mark.parametrize(("count", "noise"), [(64, 0.01), (2000, 0.001)])
@pytest.mark.slow
def test_points_that_are_not_exact_are_as_far_off_as_the_curve_is(count: int, noise: float) -> None:
    random = np.random.default_rng(3)
    points = curves("four-bar", 1, seed=11, points=count)[0]
    size = np.hypot(np.ptp(points.real), np.ptp(points.imag))
    points = points + noise * size * random.normal(size=(count, 2)) @ np.array([1.0, 1j])
    best = linkanim.path(points, count=1, prefer="exact")[0]
    off = distances(best, points)
    assert best.rms == pytest.approx(math.sqrt(np.mean(off**2)), rel=1e-6)
    assert best.largest == pytest.approx(off.max(), rel=1e-6)
    assert best.rms < 1.1 * noise * size
    # in order all the same, where neighbours have changed places on the curve
    assert (np.diff(best.angles) * best.sense >= 0).all()
    assert np.ptp(best.angles) <= 2 * math.pi


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="memory as Linux tells it")
def test_a_curve_of_twenty_thousand_points_takes_no_more_memory_than_one_of_sixty(tmp_path: Path) -> None:
    points = curves("four-bar", 1, seed=11, points=20_000)[0]
    np.savetxt(tmp_path / "long.csv", as_pairs(points), delimiter=",")
    code = "from linkanim.__main__ import main; main(); print(open('/proc/self/status').read())"
    done = subprocess.run(
        [sys.executable, "-P", "-c", code, "path", "long.csv", "--count", "1"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert int(done.stdout.partition("VmHWM:")[2].split()[0]) < 300_000


@pytest.mark.long
def test_a_point_to_be_passed_exactly_is_so_among_hundreds() -> None:
    points = curves("four-bar", 1, seed=11, points=420)[0]
    size = np.hypot(np.ptp(points.real), np.ptp(points.imag))
    points[201] += 0.01 * size
    best = linkanim.path(points, exactly=[201], count=1)[0]
    assert distances(best, points)[201] < 1e-6 * size


@pytest.mark.slow
def test_answers_differ_and_the_best_come_first() -> None:
    fits = linkanim.path(SQUARE, count=4, prefer="exact")
    assert len(fits) == 4
    assert [fit.error for fit in fits] == sorted(fit.error for fit in fits)
    points = np.array(SQUARE) @ np.array([1.0, 1j])
    for fit in fits:
        verify(fit, points)
    for one, other in pairwise(fits):
        assert np.abs(one.row - other.row).max() > 1e-4 * one.task.curve.size


@pytest.mark.slow
def test_kunjurs_eighteen_points_are_passed_better_than_published() -> None:
    best = linkanim.path(KUNJUR, timing=math.radians(20), prefer="exact")[0]
    assert squares(best) <= 9.03e-3
    assert np.diff(best.angles) == pytest.approx(best.sense * math.radians(20))
    off = np.abs(traced(best, angle=best.angles) - np.array(KUNJUR) @ np.array([1.0, 1j]))
    assert best.rms == pytest.approx(math.sqrt(np.mean(off**2)))
    way = traced(best, angle=np.linspace(best.angles[0], best.angles[-1], 500))
    places = np.linspace(0, len(KUNJUR) - 1, 1000)
    sides = np.interp(places, np.arange(len(KUNJUR)), np.array(KUNJUR) @ np.array([1.0, 1j]))
    assert best.stray == pytest.approx(np.abs(way[:, None] - sides).min(axis=1).max(), abs=2e-3)


@pytest.mark.parametrize("turn", [0.3, 0.8, 2.0])
def test_a_curve_of_the_atlas_is_known_again_however_it_lies(turn: float) -> None:
    some = atlas(FOUR_BAR, 500)
    for number in (0, 99, 400):
        curve = DrawnCurve(some.shape[number] * 70 * np.exp(1j * turn) + 5, closed=True)
        best = matched(some, curve, 1)
        assert best.rows[0, 3] / best.rows[0, 2] == pytest.approx(some.rows[number, 3] / some.rows[number, 2])


@pytest.mark.slow
def test_six_points_of_a_line_are_passed_exactly() -> None:
    fits = linkanim.path(LINE)
    within = [fit for fit in fits if max(map(abs, fit.parameters.values())) <= 60]
    assert min(map(squares, within)) <= 1e-20


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.long)])
@pytest.mark.slow
def test_five_points_at_random_are_passed_exactly(seed: int) -> None:
    points = np.random.default_rng(seed).uniform(0, 50, (5, 2))
    best = linkanim.path(points, count=1)[0]
    assert squares(best) <= 1e-20
    verify(best, points @ np.array([1.0, 1j]))


@pytest.mark.slow
def test_a_point_has_the_crank_angle_that_it_is_given() -> None:
    points, angles = curves("four-bar", 1, seed=21, points=12)[0], np.linspace(0.4, 5.0, 12)
    best = linkanim.path(points, timing=angles, count=1)[0]
    assert best.angles == pytest.approx(angles, abs=1e-12)


@pytest.mark.long  # a free start is that of Kunjur's points, too
def test_the_crank_angles_that_are_given_may_all_be_shifted_by_one() -> None:
    points, angles = curves("four-bar", 1, seed=21, points=12)[0], np.linspace(0.4, 5.0, 12)
    best = linkanim.path(points, timing=angles, count=1)[0]
    free = linkanim.path(points, timing=angles, free_start=True, count=1)[0]
    assert np.diff(free.angles) == pytest.approx(np.diff(angles))
    assert free.rms <= best.rms * (1 + 1e-6)


@pytest.mark.slow
def test_cognates_trace_the_same_curve() -> None:
    points = curves("four-bar", 1, seed=31)[0]
    first, *others = linkanim.path(points, count=1, cognates=True)
    assert len(others) == 2
    way = traced(first, phase=np.linspace(0, 2 * math.pi, 400, endpoint=False))
    for other in others:
        dense = np.linspace(0, other.scene.period, 20_000)
        start = dense[np.abs(traced(other, phase=dense)[:, None] - way[::40]).argmin(axis=0)]
        for _ in range(6):
            motion = other.scene.solve(phase=start, speed=1.0, derivatives=1)
            left = way[::40] - motion.position["P"] @ np.array([1.0, 1j])
            rate = motion.velocity["P"] @ np.array([1.0, 1j])
            start = start + (np.conj(rate) * left).real / np.abs(rate) ** 2
        assert np.abs(traced(other, phase=start) - way[::40]).max() <= 1e-13 * first.task.curve.size


@pytest.mark.slow
def test_an_answer_that_is_a_cognate_of_another_is_listed_once() -> None:
    row, turn = np.array([[0, 0, 30, 90, 45, 30, 100, 0, 80]]), np.linspace(0, 2 * math.pi, 21)[None, :-1]
    points = FOUR_BAR.points(row, np.ones(1), turn)[0]
    alone = linkanim.path(points, count=2, prefer="exact")
    listed = linkanim.path(points, count=2, prefer="exact", cognates=True)
    assert any(other.apart(alone[1]) < 1e-6 for other in cognates_of(alone[0]))  # so that there is one
    assert [one.cognate for one in listed] == [False, True, True]
    assert min(one.apart(other) for one, other in combinations(listed, 2)) > 1e-3


@pytest.mark.slow
def test_of_two_answers_that_trace_one_curve_the_later_is_the_cognate_of_the_earlier() -> None:
    assert [one.cognate for one in linkanim.path(NINE, count=5, prefer="exact")] == [False, True]


def order(fit: Fit, points: Complex) -> Real:
    """Return where in its period the coupler point is nearest to each point, the way that the drive runs."""
    speed = fit.scene.linkage.drive.speed
    period = fit.scene.period
    way = traced(fit, phase=math.copysign(period, speed) * np.arange(4000) / 4000)
    places = np.array([int(np.abs(way - point).argmin()) for point in points]) / 4000
    return np.asarray(np.remainder(places - places[0] + 1e-3, 1.0))


def answer(row: Real, angles: Real, *, closed: bool = True, **options: Any) -> Fit:
    """Return a linkage as an answer to points of its own coupler curve."""
    points = KINDS[options.get("kind", "four-bar")].points(row[None], np.ones(1), angles[None])[0]
    task = task_of(points, closed, **options)
    found = checked(task if closed else task.swinging(), row, 1.0, angles)
    assert found is not None
    return found


STEP = 2 * math.pi / 40
TURN: Real = STEP * np.arange(40, dtype=np.float64)


@pytest.mark.parametrize("kind", ["crank-rocker", "drag-link"])
def test_cognates_that_turn_trace_the_whole_curve_and_say_their_own_figures(kind: str) -> None:
    rows = {
        "crank-rocker": (9.0, 7.0, 30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0),
        "drag-link": (0.0, 0.0, 60.0, 55.0, 20.0, 15.0, 30.0, 5.0, 65.0),
    }
    first = PathAnswer(0.4, 1.0, 0.3, -1.0, rows[kind], 2.0, 0.5)
    found = [one for one in turning_cognates(first) if one]
    assert len(found) == (1 if kind == "crank-rocker" else 2)
    longest = [FOUR_BAR.link_lengths(np.array([one.row]))[0].max() for one in (first, *found)]
    whole = first.scene("mm").cycle(720, derivatives=0).position["P"] @ np.array([1, 1j])
    for one, long in zip(found, longest[1:], strict=True):
        scene = one.scene("mm")
        assert scene.info.full_turn
        assert scene.info.transmission
        assert one.angle == pytest.approx(scene.info.transmission.least)
        assert one.size / long == pytest.approx(first.size / longest[0])
        way = scene.cycle(720, derivatives=0).position["P"] @ np.array([1, 1j])
        assert np.abs(way[0] - whole[0]) < 1e-9
        assert np.abs(way[:, None] - whole).min(axis=1).max() < 1.0


# What is asked for, and how many cognates of three crank-rockers and drag-links keep to it.
COGNATES: tuple[tuple[dict[str, Any], int], ...] = (
    ({}, 12),
    ({"least_angle": 0.05}, 8),
    ({"largest": 3.5}, 10),
    ({"box": (-0.1, -0.1, 2, 0.3)}, 4),
    ({"pivots": [(0.0, 0.0)]}, 6),
    ({"timing": STEP}, 6),
    ({"timing": TURN + 0.5}, 0),
)


@pytest.mark.thinned(4)
@pytest.mark.parametrize(("options", "count"), COGNATES, ids=[next(iter(one), "free") for one, _ in COGNATES])
def test_cognates_keep_to_what_is_asked_for_and_run_the_way_that_was_drawn(
    options: dict[str, Any], count: int
) -> None:
    found = 0
    for row in linkages("four-bar", 4, seed=40)[:3]:
        for way in (1.0, -1.0):
            timed = {"timing": way * options["timing"]} if "timing" in options else {}
            first = answer(row, way * (TURN + 0.5), **{"largest": 100.0} | options | timed)
            for fit in cognates_of(first):
                found += 1
                points = fit.task.curve.points
                assert fit.rms < 1e-9 * fit.task.curve.size
                assert (np.diff(order(fit, points)) > 0).all()
                assert fit.transmission_angle >= options.get("least_angle", 0.0) - 1e-9
                assert fit.size <= options.get("largest", 100.0) * fit.task.curve.size * (1 + 1e-9)
                if "timing" in options:
                    turned = np.diff(fit.angles)
                    assert turned == pytest.approx(np.full(39, way * STEP))
                    assert np.abs(traced(fit, angle=fit.angles) - points).max() < 1e-9 * fit.task.curve.size
    assert found == count


# Kind, row, the crank's angles from and to, and those at which the angle is least: by the law of cosines for
# a four-bar, by the rod's steepness for a slider-crank.
ALONG: dict[str, tuple[str, tuple[float, ...], tuple[float, float], float]] = {
    # the whole turn's least angle, with the crank along the ground at 0, is not on the way
    "four-bar that turns, least at an end": ("four-bar", (0, 0, 30, 90, 45, 30, 100, 0, 80), (1.0, 2.2), 1.0),
    "four-bar that turns, least on the way": (
        "four-bar",
        (0, 0, 30, 90, 45, 30, 100, 0, 80),
        (-0.4, 2.2),
        0.0,
    ),
    "triple-rocker, least on the way": ("four-bar", (0, 0, 60, 50, 20, 30, 100, 0, 70), (-1.2, 0.9), 0.0),
    "slider-crank that turns, least at an end": (
        "slider-crank",
        (0, 0, 30, 90, 45, 30, 0, 10),
        (-0.5, 1.0),
        -0.5,
    ),
    "slider-crank, least on the way": (
        "slider-crank",
        (5, 5, 30, 90, 45, 30, 0, 10),
        (-2.5, 1.0),
        -math.pi / 2,
    ),
}


@pytest.mark.parametrize(("kind", "row", "way", "worst"), ALONG.values(), ids=ALONG)
def test_the_transmission_angle_of_an_open_curve_is_the_least_along_it(
    kind: str, row: tuple[float, ...], way: tuple[float, float], worst: float
) -> None:
    best = answer(np.array(row, dtype=float), np.linspace(*way, 40), closed=False, kind=kind)
    if kind == "four-bar":
        _, _, crank, coupler, _, _, ground, _, rocker = row
        across = ground**2 + crank**2 - 2 * ground * crank * math.cos(worst)
        cosine = (coupler**2 + rocker**2 - across) / (2 * coupler * rocker)
    else:
        cosine = (row[7] - row[2] * math.sin(worst)) / row[3]
    assert best.transmission_angle == pytest.approx(math.acos(abs(cosine)), abs=1e-14)
    whole = best.scene.info.transmission
    assert whole is not None
    assert whole.least <= best.transmission_angle + 1e-14


def test_an_open_curve_through_a_limit_of_the_input_has_no_transmission_angle_there() -> None:
    # a triple-rocker: ground 100, crank 60, coupler 50, rocker 70; at the limit A is 120 from O4
    row, limit = np.array([0, 0, 60, 50, 20, 30, 100, 0, 70.0]), math.acos(-8 / 120)
    angles = limit - np.abs(np.linspace(-0.3, 0.4, 40))
    closures = np.where(np.arange(40) < 17, 1.0, -1.0)
    points = np.array(
        [
            FOUR_BAR.points(row[None], np.array([side]), np.array([[angle]]))[0, 0]
            for side, angle in zip(closures, angles, strict=True)
        ]
    )
    found = checked_by_phase(task_of(points, closed=False), row, closures, angles)
    assert found is not None
    assert found.transmission_angle < 1e-7


def test_a_candidate_whose_equations_have_no_solution_holds_up_no_other() -> None:
    found = _solutions(np.array([np.eye(2), np.zeros((2, 2))]), np.array([[1.0, 2.0], [3.0, 4.0]]))
    assert found.tolist() == [[1.0, 2.0], [0.0, 0.0]]


def test_candidates_that_cannot_be_closed_stay_as_they_are() -> None:
    rows, turn = linkages("four-bar", 2, seed=5), np.linspace(0, 6, 40)
    points = FOUR_BAR.points(rows[:1], np.ones(1), turn[None])[0]
    rows[1, 8] = 1e-3
    task = task_of(points, closed=False).swinging()
    start = Candidates(rows, np.ones(2), np.tile(turn, (2, 1)), np.ones(2))
    _, cost = refined(task.problem(np.arange(40)), task.normalised(start), 5)
    assert cost[0] < 1e-20
    assert cost[1] == np.inf


@pytest.mark.slow
def test_the_longest_link_is_the_longest_side_of_the_coupler_where_that_is() -> None:
    for fit in linkanim.path(SQUARE, count=3):
        pose = fit.scene.pose(0.3, 0).position
        sides = [math.dist(pose[one], pose[other]) for one, other in ("AB", "AP", "BP")]
        links = [math.dist(pose[one], pose[other]) for one, other in (("O2", "A"), ("O4", "B"), ("O2", "O4"))]
        assert fit.size == pytest.approx(max(*sides, *links))


@pytest.mark.slow
def test_round_lengths_are_round_and_the_cost_is_known() -> None:
    points = curves("four-bar", 1, seed=41)[0]
    points = points * (100 / np.ptp(points.real))
    best = linkanim.path(points, count=1, rounding=0.5)[0]
    assert {value * 2 % 1 for value in best.parameters.values()} == {0.0}
    assert best.exact is not None
    assert best.exact.rms < best.rms < 0.01 * best.task.curve.size
    verify(best, points)


# Each limit, and what shows that it is kept.
LIMITS: dict[str, tuple[Any, Any]] = {
    "largest": (1.2, lambda fit: fit.size <= 1.2 * fit.task.curve.size * (1 + 1e-9)),
    "least_angle": (0.7, lambda fit: fit.transmission_angle >= 0.7 - 1e-9),
    "box": ((12, -2, 10, 10), lambda fit: all(12 <= fit.parameters[x] <= 22 for x in ("x", "x4"))),
    "pivots": ([(14, 3)], lambda fit: (fit.parameters["x"], fit.parameters["y"]) == (14, 3)),
    "lengths": ({"crank": 4.5}, lambda fit: fit.parameters["crank"] == 4.5),
}  # fmt: skip


# Limits that hold answers to the square back at once: they stand at the longest link, the angle and the box.
@pytest.mark.thinned(2)
@pytest.mark.parametrize("names", [("largest", "least_angle", "box"), ("pivots", "lengths")])
@pytest.mark.slow
def test_limits_are_kept(names: tuple[str, ...]) -> None:
    options: dict[str, Any] = {name: LIMITS[name][0] for name in names}
    fits = linkanim.path(SQUARE, count=2, **options)
    assert fits
    for fit in fits:
        assert [name for name in names if not LIMITS[name][1](fit)] == []
        verify(fit, np.array(SQUARE) @ np.array([1.0, 1j]))


@pytest.mark.slow
def test_of_two_boxes_the_first_holds_the_crank_s_pin() -> None:
    boxes = [(12, -2, 10, 10), (-20, -30, 25, 20)]
    for some in (boxes, boxes[::-1]):
        for fit in linkanim.path(SQUARE, count=2, box=some, prefer="exact"):
            for (x, y, wide, high), pivot in zip(some, fit.kind.pivots(fit.row[None])[0], strict=True):
                assert x - 1e-9 <= pivot.real <= x + wide + 1e-9
                assert y - 1e-9 <= pivot.imag <= y + high + 1e-9


@pytest.mark.slow
def test_one_linkage_whose_line_is_told_from_either_end_is_one_answer() -> None:
    points = curves("slider-crank", 1, seed=61)[0]
    best = linkanim.path(points, kind="slider-crank", count=1)[0]
    turned = best.row + np.array([0, 0, 0, 0, 0, 0, math.pi, -2 * best.parameters["offset"]])
    other = checked(best.task, turned, -best.closure_sign, best.angles)
    assert other is not None
    assert other.closure != best.closure
    assert best.apart(other) < 1e-9
    assert best_of([best, other], 2) in ((best,), (other,))


@pytest.mark.slow
def test_a_point_may_be_passed_exactly() -> None:
    best = linkanim.path(SQUARE, exactly=[0], count=1)[0]
    assert abs(traced(best, angle=best.angles)[0]) < 1e-6
    assert best.rms > 0.01


@pytest.mark.slow
def test_answers_that_rounding_alone_tells_apart_come_in_one_order() -> None:
    points = curves("four-bar", 1, seed=31)[0]
    best, *cognates = linkanim.path(points, count=1, cognates=True)
    # equally good, some with the same transmission angle, too
    fits = [replace(fit, rms=0.01, largest=0.02, stray=0.0) for fit in (best, *cognates)]
    fits += [replace(fits[1], size=fits[1].size * 2), replace(fits[2], parameters=best.parameters)]
    fits = [replace(fit, angles=fit.angles.copy()) for fit in fits]
    random, names = np.random.default_rng(1), {id(fit.angles): n for n, fit in enumerate(fits)}
    orders = set()
    for _ in range(30):
        shaken = [
            replace(fit, rms=fit.rms * one, transmission_angle=fit.transmission_angle * other)
            for fit, (one, other) in zip(fits, random.normal(1.0, 1e-14, (len(fits), 2)), strict=True)
        ]
        random.shuffle(shaken)
        orders.add(tuple(names[id(fit.angles)] for fit in ranked(shaken)))
    assert len(orders) == 1


@pytest.mark.slow
def test_one_input_gives_one_answer() -> None:
    points = curves("four-bar", 1, seed=71)[0]
    one, other = (linkanim.path(points, count=2) for _ in range(2))
    assert [fit.scene.document for fit in one] == [fit.scene.document for fit in other]


# What is refused, by the word that says which.
REFUSED: dict[str, tuple[Any, dict[str, Any]]] = {
    "3 points at least": ([(0, 0), (1, 1)], {}),
    "points 2 and 3 coincide": ([(0, 0), (1, 1), (1, 1), (2, 0)], {}),
    "point 2 is not finite": ([(0, 0), (math.nan, 1), (2, 0)], {}),
    "no extent": ([(3, 3), (3, 3), (3, 3), (3, 3)], {"closed": False}),
    "pairs of numbers": ([(0, 0, 0), (1, 1, 1), (2, 0, 0)], {}),
    "nothing fits in it": (SQUARE, {"box": (0, 0, 0, 5)}),
    "3 boxes are given, and a four-bar has 2": (SQUARE, {"box": 3 * [(0, 0, 5, 5)]}),
    "2 boxes are given, and a slider-crank has 1 fixed pin": (
        SQUARE,
        {"box": 2 * [(0, 0, 5, 5)], "kind": "slider-crank"},
    ),
    "lies outside of its box": (SQUARE, {"box": (0, 0, 5, 5), "pivots": [(9, 9)]}),
    "longer than the longest link": (SQUARE, {"lengths": {"crank": 500}}),
    "no length of a four-bar": (SQUARE, {"lengths": {"rod": 5}}),
    "0 to 90 deg": (SQUARE, {"least_angle": 2.0}),
    "longest link in curve sizes": (SQUARE, {"largest": 0.0}),
    "4 points": (SQUARE[:4], {"timing": [0.0, 1.0]}),
    "step of the timing": (SQUARE, {"timing": 0.0}),
    "take four-bar or slider-crank": (SQUARE, {"kind": "six-bar"}),
    "has no cognates": (SQUARE, {"kind": "slider-crank", "cognates": True}),
    "no point 99": (SQUARE, {"exactly": [99]}),
    "rounding to -1": (SQUARE, {"rounding": -1.0}),
    "count=0: give a whole number from 1 to 50": (SQUARE, {"count": 0}),
    "count=2.5: give a whole number": (SQUARE, {"count": 2.5}),
    "a point lies at 1e\\+308": ([(0, 0), (1e308, -1e308), (-1e308, 1e308)], {}),
    "keeps to the longest link and": (SQUARE[::8], {"largest": 0.05}),
    "keeps to the box,": (SQUARE[::8], {"box": (1e6, 1e6, 1.0, 1.0)}),
    "keeps to the boxes,": (SQUARE[::8], {"box": [(1e6, 1e6, 1.0, 1.0), (0.0, 0.0, 1.0, 1.0)]}),
}


@pytest.mark.parametrize(("words", "points", "options"), [(words, *case) for words, case in REFUSED.items()])
def test_what_makes_no_sense_is_refused(words: str, points: Any, options: dict[str, Any]) -> None:
    with pytest.raises(linkanim.LinkanimError, match=words) as error:
        linkanim.path(points, **options)
    assert "\n" not in str(error.value)
    assert error.value.exit_code == 2
