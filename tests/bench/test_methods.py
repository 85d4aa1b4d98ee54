"""Each method of comparison does what its name says: right on the easy cycles, to its own order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import peers
import pytest

from linkanim.bench import methods
from linkanim.bench.questions import (
    FOUR_BAR,
    MECHANISMS,
    SLIDER_CRANK,
    Case,
    CaseSet,
    Orders,
    Question,
    circle_dyad,
    degrees,
)
from linkanim.bench.reference import Answer, Solve, answer

EPS = 2.0**-52
HARD = [(mechanism, case) for mechanism in MECHANISMS for case in mechanism.hard]
Read = Callable[[peers.Samples, Question], Orders]


@cache
def first_quarter(name: str) -> Answer:
    (mechanism,) = (one for one in MECHANISMS if one.name == name)
    return answer(replace(mechanism.easy, inputs=degrees(0, 90)))


def thinned(case: Case) -> Answer:
    """A case at every thirteenth of its inputs."""
    return answer(replace(case, inputs=case.inputs[::13]))


def read(way: Read) -> Solve:
    return lambda question: way(peers.table_of(question), question)


# The method, and the range of its worst error in steps of one degree, in longest links.
@pytest.mark.thinned(3)
@pytest.mark.parametrize("mechanism", MECHANISMS, ids=lambda mechanism: mechanism.name)
@pytest.mark.parametrize(
    ("solve", "least", "most"),
    [
        pytest.param(methods.batch, 0, 16 * EPS, id="linkanim, batch"),
        pytest.param(methods.single, 0, 16 * EPS, id="linkanim, single"),
        pytest.param(peers.rated(peers.closed(peers.half_angle_dyad)), 0, 1e-13, id="half-angle"),
        pytest.param(peers.rated(peers.closed(circle_dyad)), 0, 1e-13, id="circles"),
        pytest.param(peers.rated(peers.newton(1)), 1e-6, 1e-3, id="newton 1"),
        pytest.param(peers.rated(peers.newton(2)), 1e-12, 1e-7, id="newton 2"),
        pytest.param(peers.rated(peers.newton(3)), 0, 1e-13, id="newton 3"),
        pytest.param(peers.runge_kutta, 1e-12, 1e-8, id="rk4"),
        pytest.param(read(peers.linear), 1e-6, 1e-4, id="table, linear"),
        pytest.param(read(peers.cubic), 1e-11, 1e-8, id="table, cubic"),
    ],
)
def test_a_method_is_right_on_the_easy_cycle(
    solve: Solve, least: float, most: float, mechanism: CaseSet
) -> None:
    found = first_quarter(mechanism.name).score(solve)
    assert (found.poses, found.wrong, found.nan) == (90, 0, 0)
    assert least <= found.error <= most
    # Rates that are solved at the pose found are about as far off as it is.
    assert all(not error > 100 * most for error in found.errors)


def test_four_bars_each_of_its_own_lengths_are_closed_on_the_easy_cycle() -> None:
    found = first_quarter("four-bar").score(methods.each_its_own)
    assert (found.poses, found.wrong, found.nan) == (90, 0, 0)
    assert found.error <= 16 * EPS


def test_a_row_tells_of_ten_thousand_different_linkages() -> None:
    row = methods.of_many_linkages()
    assert row.position.poses == 10_000
    joints = np.asarray(row.position.work())
    assert joints.shape == (10_000, 5)
    assert np.isfinite(joints).all()
    assert len(np.unique(joints[:, 1])) == 10_000, "as many ground links"


@pytest.mark.parametrize(
    "solve", [peers.pylinkage_fast(1), peers.pylinkage_fast(4), peers.pylinkage_step, peers.fsolve]
)
@pytest.mark.parametrize("mechanism", MECHANISMS, ids=lambda mechanism: mechanism.name)
def test_other_packages_are_right_on_the_easy_cycle(solve: Solve, mechanism: CaseSet) -> None:
    pytest.importorskip("scipy" if solve is peers.fsolve else "pylinkage")
    found = answer(replace(mechanism.easy, inputs=degrees(0, 20))).score(solve)
    assert (found.wrong, found.nan) == (0, 0)
    assert found.error < 1e-9


@pytest.mark.thinned(3)
@pytest.mark.parametrize(("mechanism", "case"), HARD, ids=lambda item: item.name)
def test_this_solver_is_exact_on_the_hard_cases(mechanism: CaseSet, case: Case) -> None:
    posed = thinned(case)
    for solve in (methods.batch, methods.single):
        found = posed.score(solve)
        assert (found.wrong, found.nan) == (0, 0)
        assert found.error <= 16 * EPS
        assert all(not error > 64 * EPS for error in found.errors[1:])


# What the closed forms lose, and so what the table must show: the other closure past a change point.
@pytest.mark.parametrize(
    "case", [FOUR_BAR.hard[0], SLIDER_CRANK.hard[0]], ids=["parallelogram", "isosceles slider-crank"]
)
def test_a_change_point_costs_the_closed_forms_half_the_poses(case: Case) -> None:
    posed = thinned(case)
    for close in (peers.half_angle_dyad, circle_dyad):
        found = posed.score(peers.rated(peers.closed(close)))
        assert found.wrong > found.poses / 3


# Both bars on the line of centres: no velocity is determined.
SINGULAR = {"newton": peers.rated(peers.newton(1)), "rk4": peers.runge_kutta}


@pytest.mark.parametrize("solve", SINGULAR.values(), ids=SINGULAR)
def test_a_singular_jacobian_is_nan_and_not_an_exception(solve: Solve) -> None:
    question = thinned(replace(FOUR_BAR.hard[0], inputs=np.array([0.0] * 26))).question
    singular = replace(question, angles=np.array([0.0, 0.1]), start={**question.start, "B": complex(6.0)})
    with np.errstate(all="ignore"):
        assert np.isnan(solve(singular)[0]["B"]).all()
