"""The rows of the comparison: their names, how many poses each is timed with, and what of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from linkanim.bench import entries
from linkanim.bench.cases import EASY, degrees
from linkanim.bench.reference import answer
from linkanim.scenes.scene import Scene

# Those that need no other package: the row's name, and the poses of a timing.
ROWS = {
    "batch": ("linkanim, 10,000 at once", 10_000),
    "batch, many": ("linkanim, 1,000,000 at once", 1_000_000),
    "single": ("linkanim, one pose a call", 720),
    "float32": ("linkanim, float32, 10,000 at once", 10_000),
    "half-angle": ("half-angle formula", 10_000),
    "circles": ("circle intersection", 10_000),
    "newton 1": ("Newton, 1 iteration", 720),
    "newton 2": ("Newton, 2 iterations", 720),
    "newton 3": ("Newton, 3 iterations", 720),
    "rk4": ("RK4 on the velocity", 720),
    "linear": ("table of 1° steps, straight lines", 10_000),
    "cubic": ("table of 1° steps, Hermite's cubics", 10_000),
}


def test_each_row_has_its_name_and_its_poses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entries, "_packages", tuple)
    found = entries.entries()
    assert {row.key: (row.name, row.position.poses) for row in found} == ROWS
    timed = [row.key for row in found if row.derivatives]
    assert timed == ["batch", "batch, many", "single", "half-angle"]
    assert all(row.derivatives.poses == row.position.poses for row in found if row.derivatives)


def test_what_is_timed_is_the_easy_cycle() -> None:
    asked = entries.easy(360)
    exact = answer(replace(EASY, inputs=degrees(0, 3))).question
    assert (asked.bars, asked.side, len(asked.angles)) == (exact.bars, exact.side, 360)
    assert asked.angles[:3] == pytest.approx(exact.angles)
    assert asked.phases[:3] == pytest.approx(exact.phases)
    assert asked.start == pytest.approx(exact.start)
    assert set(asked.sides) == {1.0}
    assert (asked.periods, asked.by_angle) == (exact.periods, exact.by_angle)


def test_a_batch_is_timed_for_its_positions_and_for_its_accelerations() -> None:
    batch = next(entries._own())
    assert batch.derivatives is not None
    question = entries.easy(entries.FEW)
    motion = question.scene.solve(angle=question.angles)
    for work, exact in ((batch.position, motion.position), (batch.derivatives, motion.acceleration)):
        assert np.array_equal(work.work()["P"], exact["P"])  # type: ignore[index]


def test_one_pose_a_call_is_timed_with_each_pose_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[float, int]] = []
    monkeypatch.setattr(Scene, "pose", lambda self, phase, derivatives: asked.append((phase, derivatives)))
    single = next(row for row in entries._own() if row.key == "single")
    assert single.derivatives is not None
    phases = entries.easy(720).angles.tolist()
    for work, derivatives in ((single.position, 0), (single.derivatives, 2), (entries.press(), 2)):
        asked.clear()
        work.work()
        assert asked == [(phase, derivatives) for phase in phases]
