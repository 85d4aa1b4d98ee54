"""The linkages of a batch are the solver's, and their derivatives are those of their points."""

from __future__ import annotations

import numpy as np
import pytest
from random_curves import linkages

import linkanim
from linkanim.scenes.reading import scene_from
from linkanim.synthesis.linkages import KINDS

STEP = 1e-6


@pytest.mark.parametrize("closure", [1.0, -1.0])
@pytest.mark.parametrize("name", KINDS)
def test_points_are_those_of_the_solver(name: str, closure: float) -> None:
    kind, angles = KINDS[name], np.linspace(0.0, 6.0, 13)
    for row in linkages(name, 5, seed=1):
        tables = kind.document(dict(zip(kind.parameters, row.tolist(), strict=True)), closure)
        motion = scene_from(tables, name="s", where="s").solve(angle=angles, derivatives=0)
        own = kind.points(row[None], np.array([closure]), angles[None])[0]
        solved = motion.position["P"] @ np.array([1.0, 1j])
        assert np.abs(own - solved).max() < 1e-12


@pytest.mark.parametrize("closure", [1.0, -1.0])
@pytest.mark.parametrize("name", KINDS)
def test_slopes_are_those_of_the_points(name: str, closure: float) -> None:
    kind, rows = KINDS[name], linkages(name, 4, seed=2)
    rows[:, :2] += 0.3
    signs, angles = np.full(len(rows), closure), np.tile(np.linspace(0.2, 6.0, 7), (len(rows), 1))
    traced = kind.trace(rows, signs, angles)
    for column in range(rows.shape[1]):
        step = STEP * np.eye(rows.shape[1])[column]
        ahead, behind = (kind.points(rows + way * step, signs, angles) for way in (1, -1))
        assert np.abs((ahead - behind) / (2 * STEP) - traced.slopes[..., column]).max() < 1e-6
    ahead, behind = (kind.points(rows, signs, angles + way * STEP) for way in (1, -1))
    assert np.abs((ahead - behind) / (2 * STEP) - traced.rate).max() < 1e-6


@pytest.mark.parametrize("name", KINDS)
def test_slack_is_positive_where_the_solver_says_a_full_turn(name: str) -> None:
    kind = KINDS[name]
    rows = kind.random_rows(np.random.default_rng(3), 40)
    for row, margins in zip(rows, kind.margins(rows, 0.0), strict=True):
        tables = kind.document(dict(zip(kind.parameters, row.tolist(), strict=True)), 1.0)
        try:
            turns = scene_from(tables, name="s", where="s").info.full_turn
        except linkanim.LinkanimError:
            turns = False
        assert turns == bool((margins > 0).all())
