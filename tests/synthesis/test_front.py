"""Answers judged by deviation, size and transmission angle together: the front, its knee, its cards."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations, pairwise, permutations, product
from typing import Any

import numpy as np
import pytest
from random_curves import curves

from linkanim.errors import BadInput
from linkanim.scenes.scene import Scene
from linkanim.synthesis.answers import Figures, Fit
from linkanim.synthesis.curves import stroke_of
from linkanim.synthesis.follower import COUNT
from linkanim.synthesis.front import (
    Preference,
    cards,
    differ,
    first_of,
    front_of,
    knee,
    names_of,
    preferred,
    searched_front,
    way_along,
)
from linkanim.synthesis.linkages import FOUR_BAR, Complex
from linkanim.synthesis.path import path, task_of
from linkanim.synthesis.search import best_fits

TURN = np.linspace(0, 2 * math.pi, 160)
SHAPES: dict[str, Complex] = {
    "eight": 100 * np.sin(TURN) + 50j * np.sin(2 * TURN),
    "D": np.append(60 * np.exp(1j * np.linspace(-math.pi / 2, math.pi / 2, 80)), [20j, -20j, -60j]),
    "ellipse": 100 * np.cos(TURN) + 40j * np.sin(TURN),
}
RUNS_WELL = math.radians(40)


@pytest.fixture(
    scope="module",
    params=["D", *(pytest.param(name, marks=pytest.mark.long) for name in ("eight", "ellipse"))],
)
def front(request: pytest.FixtureRequest) -> tuple[Fit, ...]:
    """A shape's front, with the most exact answers known."""
    curve = stroke_of(SHAPES[request.param])
    task = task_of(curve.points, curve.closed)
    return searched_front(task, best_fits(task, 6, widely=False))


def figures(*values: tuple[float, float] | tuple[float, float, float]) -> list[Figures]:
    """Return figures from deviation and size, and maybe an angle in degrees."""
    filled = [(*one, 40.0)[:3] for one in values]
    return [Figures(off, size, size, math.radians(angle)) for off, size, angle in filled]


@pytest.mark.parametrize(
    ("front", "chosen", "why"),
    [
        (figures((0.031, 6.0), (0.043, 1.2)), 1, "five times the size saves no third of the deviation"),
        (figures((0.010, 2.0), (0.043, 1.2)), 0, "a quarter of the deviation is worth more size"),
        (figures((0.010, 8.0), (0.014, 2.4)), 1, "within 1.5 times the best, and at most 2.5 sizes"),
        (figures((0.0001, 2.0), (0.0008, 1.0)), 1, "a deviation that nobody sees is worth nothing"),
        (figures((0.020, 1.0, 6.0), (0.022, 1.0, 35.0)), 1, "the one all but jams"),
        (
            figures((0.0029, 0.8, 7.0), (0.0049, 0.8, 50.0)),
            1,
            "a foot's: all but jams for what is hardly seen",
        ),
        (figures((0.022, 0.8, 7.0), (0.030, 0.6, 15.0), (0.056, 0.7, 30.0)), 1, "an eight's: another curve"),
        (figures((0.026, 0.6, 5.0), (0.047, 0.6, 15.0)), 1, "a crescent's: it jams"),
        (figures((0.020, 1.0, 40.0), (0.022, 1.0, 50.0)), 0, "both run well"),
    ],
)
def test_the_answer_that_is_chosen_is_worth_its_size(front: list[Figures], chosen: int, why: str) -> None:
    assert knee(front) == chosen, why


def test_the_crank_of_the_answer_that_is_chosen_is_seen_to_turn_where_there_is_such_an_answer() -> None:
    tiny, plain = figures((0.01, 1), (0.03, 2))
    tiny, plain = tiny._replace(crank=0.04), plain._replace(crank=0.2)
    assert knee([tiny, plain]) == 1
    assert knee([tiny, tiny._replace(size=3.0)]) == 0


@pytest.mark.parametrize(
    ("front", "first", "why"),
    [
        (figures((0.020, 1.0, 6.0), (0.039, 1.0, 30.0)), 1, "within twice the best deviation"),
        (figures((0.020, 1.0, 16.0), (0.041, 1.0, 30.0)), 0, "beyond it the knee"),
        (figures((0.020, 1.0, 16.0), (0.039, 1.0, 29.0)), 0, "29 degrees are not 30"),
        (figures((0.020, 1.0, 16.0), (0.039, 1.0, 29.999)), 1, "30 degrees, but for rounding"),
        (figures((0.020, 1.0, 16.0), (0.030, 4.0, 50.0), (0.031, 1.0, 40.0)), 2, "the knee of those"),
        (figures((1e-13, 2.0, 10.0), (2e-3, 1.0, 50.0)), 0, "the curve is a linkage's own"),
        (figures((1e-13, 2.0, 10.0), (9e-12, 1.0, 40.0)), 1, "two that trace it"),
        (figures((1e-7, 2.0, 3.0), (2e-3, 1.0, 50.0)), 0, "its own, with rounded points"),
        (figures((9e-5, 2.0, 20.0), (2e-3, 1.0, 50.0)), 0, "its own, but for what reads as nothing"),
    ],
)
def test_the_first_answer_is_the_one_to_build(front: list[Figures], first: int, why: str) -> None:
    assert first_of(front) == first, why


@pytest.mark.parametrize(
    ("one", "other", "differs"),
    [
        ((0.020, 1.0, 20.0), (0.024, 1.1, 24.0), False),
        ((0.020, 1.0, 20.0), (0.0251, 1.0, 20.0), True),
        ((0.020, 1.0, 20.0), (0.020, 1.21, 20.0), True),
        ((0.020, 1.0, 20.0), (0.020, 1.0, 25.1), True),
        ((1e-13, 1.0, 20.0), (5e-8, 1.0, 20.0), False),
    ],
    ids=["hardly", "in deviation", "in size", "in angle", "both read as no deviation"],
)
def test_answers_differ_as_a_reader_sees_them(one: Any, other: Any, differs: bool) -> None:
    assert differ(*figures(one, other)) is differs


@pytest.mark.slow
@pytest.mark.parametrize("name", ["eight", "D"])
def test_the_list_is_the_front_the_one_to_build_first_and_no_two_alike(name: str) -> None:
    curve = stroke_of(SHAPES[name])
    fits = path(np.column_stack([curve.points.real, curve.points.imag]), curve.closed)
    assert len(fits) == 5
    assert first_of([fit.figures for fit in fits]) == 0
    assert [fit.error for fit in fits[1:]] == sorted(fit.error for fit in fits[1:])
    for one, other in combinations(fits, 2):
        assert differ(one.figures, other.figures)
        assert one.apart_from_cognates(other) > 1e-4
    assert min(fit.transmission_angle for fit in fits) >= math.radians(5)
    assert fits[0].most_exact
    assert fits[0].most_exact.error <= min(fit.error for fit in fits)


# Its transmission angle is 3.6 degrees: nobody would build it, but who asks for it gets it.
@pytest.mark.slow
def test_the_linkage_behind_a_curve_comes_first_however_it_runs() -> None:
    row = np.array([0, 0, 30, 90, 45, 30, 64.3, 0, 56.0])
    turn = np.linspace(0, 2 * math.pi, 64, endpoint=False)
    points = FOUR_BAR.points(row[None], np.ones(1), turn[None])[0]
    first = path(np.column_stack([points.real, points.imag]), count=1)[0]
    assert first.rms < 1e-9 * first.task.curve.size


def test_a_chosen_answer_never_doubles_the_size_for_less_than_a_third_of_the_deviation() -> None:
    steps = list(product((0.004, 0.01, 0.014, 0.03), (0.5, 1.1, 2.4, 5.0)))
    for some in combinations(steps, 3):
        for order in permutations(some):
            front = figures(*order)
            one, best = front[knee(front)], min(each.deviation for each in front)
            near = [each for each in front if each.size <= 2.5 and each.deviation <= 1.5 * best]
            assert one.size <= 2.5 or not near
            halves = [each for each in front if each.size <= one.size / 2]
            assert not any(max(each.deviation, 0.003) < 1.5 * one.deviation for each in halves)


# Six points of a curve, in millimetres, in metres, and as large as a crane.
@pytest.mark.parametrize("scale", [2.0**-10, 2.0**10], ids=["tiny", "huge"])
@pytest.mark.parametrize("prefer", ["compact", "angle"])
@pytest.mark.slow
@pytest.mark.thinned(3)
def test_a_curve_of_another_size_has_the_same_front(prefer: Preference, scale: float) -> None:
    points = np.array([(-62, -41), (-42, -67), (19, -10), (95, 49), (31, 58), (-41, 11)], dtype=float)
    usual, other = (path(size * points, prefer=prefer, count=2) for size in (1.0, scale))
    for one, same in zip(usual, other, strict=True):
        assert [*same.figures] == pytest.approx([*one.figures], rel=1e-6, abs=1e-9)


def test_limits_that_no_curve_of_the_atlas_keeps_leave_the_answers_as_they_are() -> None:
    task = task_of(stroke_of(SHAPES["D"]).points)
    assert searched_front(replace(task, requirements=replace(task.requirements, least_angle=1.57))) == ()


@pytest.mark.slow
def test_no_answer_of_a_front_is_beaten_by_another_one(front: tuple[Fit, ...]) -> None:
    assert len(front) > 3
    for one, other in permutations(front, 2):
        better = [mine < its for mine, its in zip(one.figures[:3], other.figures[:3], strict=True)]
        assert not (all(better) and one.figures.angle > other.figures.angle + math.radians(0.5))


@pytest.mark.slow
def test_a_front_reaches_from_the_best_deviation_to_bars_as_long_as_the_curve(
    front: tuple[Fit, ...],
) -> None:
    task = front[0].task
    best = best_fits(task, 1, widely=False)[0].figures.deviation
    assert front[0].figures.deviation <= 1.5 * best
    assert min(fit.figures.size for fit in front) < 1.2
    assert max(fit.figures.angle for fit in front) > math.radians(25)


@pytest.mark.slow
def test_the_default_of_a_shape_is_compact(front: tuple[Fit, ...]) -> None:
    assert front[knee([fit.figures for fit in front])].figures.size <= 2.5


@pytest.mark.slow
def test_cards_differ_to_the_eye_and_hold_the_ends_of_the_front(front: tuple[Fit, ...]) -> None:
    shown = front[knee([fit.figures for fit in front])]
    row = cards(front, shown, COUNT)
    assert shown in row
    assert 1 < len(row) <= COUNT
    assert row[0] is shown
    assert all(differ(one.figures, other.figures) for one, other in combinations(row, 2))
    ends: list[Preference] = ["exact", "compact", "angle"]
    for end in (preferred(front, prefer)[0] for prefer in ends):
        assert not all(differ(end.figures, one.figures) for one in row)
    assert len({name for name in names_of([fit.figures for fit in row]) if name}) >= 2


@pytest.mark.slow
def test_the_way_along_a_front_has_small_steps(front: tuple[Fit, ...]) -> None:
    way = way_along(front[0].task, front)
    assert way[0].figures.deviation == min(fit.figures.deviation for fit in way)
    sizes = [fit.figures.size for fit in way[1:]]
    assert sizes == sorted(sizes, reverse=True)
    steps = [one.apart(other) / max(one.figures.size, 1.0) for one, other in pairwise(way)]
    assert np.median(steps) < 0.25


@pytest.mark.long
def test_a_preferred_answer_is_the_first_of_its_kind() -> None:
    points = curves("four-bar", 1, seed=61)[0]
    exact, compact, angle = (path(points, prefer=prefer) for prefer in ("exact", "compact", "angle"))
    assert [fit.row.tolist() for fit in exact] == [fit.row.tolist() for fit in path(points, prefer="exact")]
    assert compact[0].size <= min(fit.size for fit in exact) * 1.01
    angles = [fit.transmission_angle for fit in angle]
    assert angles == sorted(angles, reverse=True)
    assert {len(exact) > 0, len(compact) <= 5, len(angle) <= 5} == {True}


def test_a_preference_that_is_none_is_refused() -> None:
    with pytest.raises(BadInput, match='prefer="small": take balanced, exact, compact or angle'):
        path([(0, 0), (10, 5), (20, 0)], prefer="small")  # type: ignore[arg-type]


def test_what_does_not_follow_is_not_on_the_front() -> None:
    assert front_of([]) == ()


# What a search looks at must not grow with the points: only answers that are listed are checked at all of
# them, each in some twenty passes. The sum of all cells that the solver was asked for says so.
@pytest.mark.parametrize("prefer", ["balanced", "exact"])
@pytest.mark.slow
def test_a_long_path_is_searched_by_some_of_its_points_and_answered_at_all(
    prefer: Preference, monkeypatch: pytest.MonkeyPatch
) -> None:
    turn = np.linspace(0, 2 * math.pi, 20_000, endpoint=False)
    points = 60 * np.exp(1j * turn) + 8 * np.exp(-2j * turn) + 5j * np.sin(3 * turn)
    asked, solve = list[int](), Scene.solve

    def counted(scene: Scene, **given: Any) -> Any:
        asked.append(max(np.size(value) for value in given.values()))
        return solve(scene, **given)

    monkeypatch.setattr(Scene, "solve", counted)
    fits = path(np.column_stack([points.real, points.imag]), prefer=prefer, count=3)
    assert sum(count >= 10_000 for count in asked) <= 30 * (len(fits) + 1)
    for fit in fits:
        assert len(fit.angles) == len(points)
        passed = FOUR_BAR.points(fit.row[None], np.array([fit.closure_sign]), fit.angles[None])[0]
        assert fit.rms == pytest.approx(np.sqrt((np.abs(passed - points) ** 2).mean()), rel=1e-9)
        curve = FOUR_BAR.points(fit.row[None], np.array([fit.closure_sign]), turn[None, ::4])[0]
        some = points[::400]
        nearest = np.abs(curve - some[:, None]).min(axis=1)
        assert np.abs(passed[::400] - some) == pytest.approx(nearest, abs=2e-3 * fit.task.curve.size)
