"""Each method of comparison does what its name says: right on the easy cycle, to its own order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from linkanim.bench import methods, others, solver
from linkanim.bench.accuracy import Solve, score
from linkanim.bench.cases import EASY, HARD, degrees
from linkanim.bench.question import Points, Question, joined
from linkanim.bench.reference import answer


def read_linearly(question: Question) -> Points:
    return methods.linear(methods.table_of(question), question)


def read_by_cubics(question: Question) -> Points:
    return methods.cubic(methods.table_of(question), question)


# The method, and its worst error on the easy cycle in steps of one degree, in longest links.
@pytest.mark.parametrize(
    ("solve", "least", "most"),
    [
        pytest.param(solver.batch, 0, 16 * 2**-53, id="linkanim, batch"),
        pytest.param(solver.single, 0, 16 * 2**-53, id="linkanim, single"),
        pytest.param(solver.float32, 1e-9, 1e-6, id="linkanim, float32"),
        pytest.param(methods.half_angle, 0, 1e-14, id="half-angle"),
        pytest.param(methods.circles, 0, 1e-14, id="circles"),
        pytest.param(methods.newton(1), 1e-6, 1e-4, id="newton 1"),
        pytest.param(methods.newton(2), 1e-11, 1e-8, id="newton 2"),
        pytest.param(methods.newton(3), 0, 1e-14, id="newton 3"),
        pytest.param(methods.runge_kutta, 1e-12, 1e-9, id="rk4"),
        pytest.param(read_linearly, 1e-6, 1e-4, id="table, linear"),
        pytest.param(read_by_cubics, 1e-11, 1e-8, id="table, cubic"),
    ],
)
def test_a_method_is_right_on_the_easy_cycle(solve: Solve, least: float, most: float) -> None:
    found = score(solve, answer(EASY))
    assert (found.poses, found.wrong, found.missing) == (360, 0, 0)
    assert least <= found.error <= most


def test_a_phase_lies_in_the_interval_of_the_table_around_it() -> None:
    entries = np.zeros(5, complex)
    table = methods.Samples(0.5, 1.0, 4.0, Points(entries, entries), Points(entries, entries))
    interval, share = table.place(np.array([0.5, 1.75, 4.25, 4.5, 0.25]))
    assert interval.tolist() == [0, 1, 3, 0, 3]
    assert share.tolist() == [0.0, 0.25, 0.75, 0.0, 0.75]


def test_a_table_has_an_entry_at_every_degree_and_half_a_degree_off_those_that_are_asked() -> None:
    for case, count in ((EASY, 361), (HARD[2], 721)):
        asked = answer(replace(case, inputs=degrees(0, 3))).question
        table = methods.table_of(asked)
        assert np.degrees([table.first, table.step]) == pytest.approx([-0.5, 1.0])
        assert len(table.values.b) == len(table.slopes.p) == count
        assert np.degrees(table.period) == pytest.approx(360 * case.periods)


def test_pylinkage_is_right_on_the_easy_cycle() -> None:
    pytest.importorskip("pylinkage")
    asked = answer(replace(EASY, inputs=degrees(0, 30)))
    for solve in (others.pylinkage_fast(1), others.pylinkage_fast(4), others.pylinkage_step):
        found = score(solve, asked)
        assert (found.wrong, found.missing) == (0, 0)
        assert found.error < 1e-12


def test_fsolve_is_right_on_the_easy_cycle() -> None:
    pytest.importorskip("scipy")
    found = score(others.fsolve, answer(replace(EASY, inputs=degrees(0, 30))))
    assert (found.wrong, found.missing) == (0, 0)
    assert found.error < 1e-9


@pytest.mark.parametrize("case", HARD, ids=lambda case: case.name)
def test_this_solver_is_exact_on_the_hard_cases(case: object) -> None:
    asked = answer(case)  # type: ignore[arg-type]
    for solve in (solver.batch, solver.single):
        found = score(solve, asked)
        assert (found.wrong, found.missing) == (0, 0)
        assert found.error <= 16 * 2**-52


def test_in_32_bits_a_swing_is_followed_through_its_limits_too() -> None:
    for case in HARD:
        if not case.turns:
            found = score(solver.float32, answer(case))
            assert (found.wrong, found.missing) == (0, 0)
            assert found.error < 1e-5


# What the closed forms lose, and so what the table must show: NaN, or the other closure past a change point.
def test_a_change_point_costs_the_closed_forms_half_the_poses() -> None:
    parallelogram = answer(HARD[0])
    for solve in (methods.half_angle, methods.circles):
        found = score(solve, parallelogram)
        assert found.wrong > found.poses / 3
        assert 1e-10 < found.error < 1e-6
    assert score(methods.half_angle, parallelogram).missing > 0


def test_the_half_angle_rates_are_the_solvers() -> None:
    question = answer(EASY).question
    found = methods.half_angle_rates(question)
    motion = question.scene.solve(phase=question.phases, speed=1.0)
    for ours, theirs in ((motion.velocity, found.first), (motion.acceleration, found.second)):
        assert np.abs(joined(ours["B"]) - theirs.b).max() < 1e-12 * 100
        assert np.abs(joined(ours["P"]) - theirs.p).max() < 1e-12 * 100


# Both bars on the line of centres: no velocity is determined.
@pytest.mark.parametrize("solve", [methods.newton(1), methods.runge_kutta], ids=["newton", "rk4"])
def test_a_singular_jacobian_is_nan_and_not_an_exception(solve: Solve) -> None:
    asked = replace(answer(HARD[0]).question, angles=np.array([0.0, 0.1]), start=complex(6.0))
    assert np.isnan(solve(asked).b).all()
