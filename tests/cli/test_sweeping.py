"""Sweeps: exact inputs, times, and blocks that join without a seam."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import linkanim
from linkanim import units
from linkanim.cli import main
from linkanim.cli.commands import solve as solved
from linkanim.cli.commands.solve import Steps, blocks, leaves
from linkanim.cli.options import sweep
from linkanim.scenes.scene import Scene

# what is typed: whole degrees, decimals, negative, many digits, beyond whole floats
TYPED = [
    "0:360:1",
    "0:360:0.1",
    "-90:720:0.7",
    "1e5:1e5:1",
    "0.30000000000000004:0.9:0.1",
    "999999999640:1e12:90",
    "123456789.123456789123:123456799:1.000000001",
]


@pytest.mark.parametrize("typed", TYPED)
def test_every_input_is_the_decimal_that_was_typed_rounded_once(typed: str) -> None:
    first, step, rows = sweep(typed)
    steps = Steps.of(first, step, rows)
    degrees = [float(first + step * row) for row in range(rows)]
    assert steps.degrees(0, rows).tolist() == degrees
    assert steps.radians(0, rows).tolist() == [units.angle(f"{value!r} deg") for value in degrees]


def test_quarter_turns_are_multiples_of_half_pi() -> None:
    found = Steps.of(*sweep("-720:720:90")).radians(0, 17)
    assert found.tolist() == [k * (math.pi / 2) for k in range(-8, 9)]


# scene, sweep: over several turns, through gaps, of the phase; the blocks end within stretches and at gaps
JOINED = [
    ("drag-link", "0:1440:35", "angle"),
    ("double-rocker", "-60:500:7", "angle"),
    ("double-rocker", "0:1440:35", "phase"),
    ("press", "360:-360:-33", "angle"),
]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("size", [1, 7])
@pytest.mark.parametrize(("name", "typed", "by"), JOINED)
def test_blocks_join_without_a_seam(
    name: str, typed: str, by: str, size: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene, steps = linkanim.load(name), Steps.of(*sweep(typed))

    def joined(block: int) -> dict[str, np.ndarray[tuple[int, ...], np.dtype[np.float64]]]:
        monkeypatch.setattr(solved, "BLOCK", block)
        found = [
            dict(leaves(result))
            for _, result in blocks(scene, steps, by, 2.0, lambda x: scene.solve(**{by: x}, speed=2.0))  # type: ignore[arg-type]
        ]
        return {key: np.concatenate([part[key] for part in found]) for key in found[0]}

    whole, parted = joined(10**6), joined(size)
    assert list(whole) == list(parted)
    for key, values in whole.items():
        largest = np.nanmax(np.abs(values), initial=1.0)
        assert parted[key] == pytest.approx(values, rel=0, abs=1e-12 * largest, nan_ok=True), key


def test_a_long_sweep_is_solved_in_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sizes: list[int] = []
    solve = Scene.solve

    def noting(self: Scene, **typed_steps: object) -> object:
        sizes.append(np.size(typed_steps.get("angle", 0)))  # type: ignore[arg-type]
        return solve(self, **typed_steps)  # type: ignore[arg-type]

    monkeypatch.setattr(Scene, "solve", noting)
    target = tmp_path / "out.csv"
    assert main(["solve", "crank-rocker", "--sweep", "0:360:0.02", "--csv", str(target)]) == 0
    assert len(target.read_text().splitlines()) == 18002
    assert max(sizes) <= solved.BLOCK + 1
    assert sum(sizes) >= 18001


def test_rows_have_the_time_since_the_first(capsys: pytest.CaptureFixture[str]) -> None:
    main(["solve", "press", "--sweep", "90:180:30", "--speed", "-2 rad/s", "--json"])
    found = json.loads(capsys.readouterr().out)
    assert [list(pose)[:5] for pose in found] == [["scene", "angle", "coordinate", "phase", "time"]] * 4
    assert [pose["time"] for pose in found] == pytest.approx([-math.radians(30 * k) / 2 for k in range(4)])
    main(["solve", "press", "--sweep", "0:30:30", "--speed", "0 rad/s", "--json"])
    assert ["time" in pose for pose in json.loads(capsys.readouterr().out)] == [False, False]
    main(["solve", "press", "--angle", "30 deg", "--json"])
    assert "time" not in json.loads(capsys.readouterr().out)
