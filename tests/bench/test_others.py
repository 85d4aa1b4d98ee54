"""Other packages are asked the same question; stand-ins for them keep what they are asked."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest
from stand_ins import Linkage, pylinkage, scipy

from linkanim.bench import entries, others
from linkanim.bench.accuracy import Solve, score
from linkanim.bench.cases import EASY, SWINGS, TOGGLE, Case, degrees
from linkanim.bench.question import TURN, Question
from linkanim.bench.reference import answer

SOME = answer(replace(EASY, inputs=degrees(10, 16)))
STEP = TURN / 360


@pytest.fixture
def linkages(monkeypatch: pytest.MonkeyPatch) -> list[Linkage]:
    made: list[Linkage] = []
    for module in pylinkage(made):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    return made


@pytest.fixture
def starts(monkeypatch: pytest.MonkeyPatch) -> list[complex]:
    found: list[complex] = []
    module = scipy(found)
    monkeypatch.setitem(sys.modules, module.__name__, module)
    return found


def past_the_limit() -> Question:
    """Return three poses of which there is none at the second."""
    angles = TOGGLE + np.array([-0.1, 0.1, -0.05])
    start = answer(Case("before the limit", SWINGS, angles[:1], turns=False)).question
    return replace(start, angles=angles)


@pytest.mark.parametrize("solve", [others.pylinkage_fast(1), others.pylinkage_fast(4), others.pylinkage_step])
def test_pylinkage_gets_the_four_bar_its_inputs_and_its_first_pose(
    solve: Solve, linkages: list[Linkage]
) -> None:
    found = score(solve, SOME)
    assert (found.wrong, found.missing) == (0, 0)
    assert found.error < 1e-14
    assert linkages[0].speeds == {linkages[0].crank: 1.0}


# The inputs in degrees, and how each is reached: so many steps of its own, of how many degrees.
@pytest.mark.parametrize(
    ("inputs", "steps"),
    [
        pytest.param([10, 11, 12], [(4, 0), (4, 0.25), (4, 0.25)], id="equal steps"),
        pytest.param([10, 12], [(4, 0), (4, 0.5)], id="one step"),
        pytest.param([10, 11, 12.5], [(1, 0), (1, 1), (1, 1.5)], id="unequal steps"),
    ],
)
def test_equal_steps_are_divided(
    inputs: list[float], steps: list[tuple[int, float]], linkages: list[Linkage]
) -> None:
    others.pylinkage_fast(4)(answer(replace(EASY, inputs=np.radians(inputs))).question)
    asked = [(count, float(np.degrees(step))) for _, count, step in linkages[0].asked]
    assert np.array(asked) == pytest.approx(np.array(steps))


def test_what_pylinkage_cannot_build_is_nan(linkages: list[Linkage]) -> None:
    found = others.pylinkage_step(past_the_limit())
    assert np.isnan(found.b).tolist() == np.isnan(found.p).tolist() == [False, True, False]


def test_pylinkages_rows_are_one_turn_of_the_easy_cycle(
    linkages: list[Linkage], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(entries, "FEW", 720)
    monkeypatch.setattr(entries, "MANY", 1_800)
    found = list(entries._packages())
    assert [(row.key, row.name, row.position.poses) for row in found] == [
        ("pylinkage", "pylinkage step_fast, 720 at once", 720),
        ("pylinkage, many", "pylinkage step_fast, 1,800 at once", 1_800),
        ("pylinkage step", "pylinkage step()", 720),
        ("fsolve", "scipy fsolve", 180),
    ]
    assert found[-1].derivatives is None
    ways = 2 * [("step_fast", "step_fast_with_kinematics")] + [("step", "step_with_derivatives")]
    for row, made, names in zip(found, linkages, ways, strict=False):
        assert row.derivatives is not None
        for name, timed in zip(names, (row.position, row.derivatives), strict=True):
            before = made.angle
            timed.work()
            assert made.asked.pop() == (name, timed.poses, 1.0)
            assert made.angle - before == pytest.approx(TURN)


def test_pylinkages_batches_are_asked_in_the_steps_in_which_they_are_timed(
    linkages: list[Linkage], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(entries, "FEW", 720)
    monkeypatch.setattr(entries, "MANY", 1_800)
    few, many, single, _ = entries._packages()
    for row, name, steps in ((few, "step_fast", 2), (many, "step_fast", 5), (single, "step", 1)):
        row.solve(SOME.question)
        *asked, step = linkages[-1].asked[-1]
        assert asked == [name, steps]
        assert step == pytest.approx(STEP / steps)


def test_fsolve_starts_at_the_pose_before(starts: list[complex]) -> None:
    found = score(others.fsolve, SOME)
    assert (found.wrong, found.missing) == (0, 0)
    assert found.error < 1e-12
    before = [SOME.question.start, *SOME.b.high[:-1]]
    assert starts == pytest.approx(before, abs=1e-9)


def test_where_fsolve_finds_nothing_there_is_no_pose_and_the_last_one_found_is_the_start(
    starts: list[complex],
) -> None:
    question = past_the_limit()
    found = others.fsolve(question)
    assert np.isnan(found.b).tolist() == [False, True, False]
    assert starts[0] == question.start
    assert starts[1] == starts[2] == found.b[0]


def test_the_equations_are_squared_distances_in_longest_links() -> None:
    equations = others._distances(30j, entries.easy(1))
    assert equations((90.0, 30.0)) == pytest.approx((0.0, (10**2 + 30**2 - 80**2) / 100**2))
    assert equations((100.0, 80.0)) == pytest.approx(((100**2 + 50**2 - 90**2) / 100**2, 0.0))
