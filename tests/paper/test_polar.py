"""Polar diagrams: a vector's head round a turn."""

from __future__ import annotations

import csv
import math
from io import StringIO
from pathlib import Path

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.paper.curves import Pace
from linkanim.paper.polar import PolarPage
from linkanim.picture.items import words_of
from linkanim.scenes import load

PACES = (Pace(2.0, "2 rad/s"), Pace(-9.0, "-9 rad/s"))


def test_a_table_has_both_components_at_each_speed_as_solving_gives_them() -> None:
    page = PolarPage(load("press"), "ground.O2.force", PACES)
    rows = list(csv.DictReader(StringIO(page.csv())))
    assert len(rows) == 721
    for row in rows[::90]:
        for pace in PACES:
            pose = page.scene.pose(float(row["phase"]), speed=pace.speed)
            for n, axis in enumerate("xy"):
                told = float(row[f"ground.O2.force.{axis} at {pace.words}"])
                assert told == pytest.approx(pose.reaction["O2"]["ground"][n], rel=1e-9, abs=1e-9)


def test_it_says_how_large_the_force_gets_and_where() -> None:
    page = PolarPage(load("press"), "ground.O2.force", PACES[:1])
    motion = page.scene.solve(phase=np.linspace(0, math.tau, 721), speed=2.0)
    largest = float(np.hypot(*motion.reaction["O2"]["ground"].T).max())
    assert f"greatest {largest:.1f} N at θ" in page.words
    drawn = words_of(page.groups())
    for angle in ("0°", "90°", "180°", "270°"):
        assert angle in drawn


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--quantity", "input.torque"], "is no vector, so it has no polar diagram"),
        (["--quantity", "ground.O2.force", "--over", "time"], "--over does not go with --polar"),
        (["--quantity", "ground.O9.force"], "nearest are"),
    ],
)
def test_what_has_no_polar_diagram_is_refused_in_one_line(
    words: list[str], reason: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert main(["chart", "press", "--polar", "-o", str(tmp_path / "p.svg"), *words]) == 2
    told = capsys.readouterr().err
    assert reason in told
    assert told.count("\n") == 1


@pytest.mark.parametrize("suffix", ["svg", "png", "csv"])
def test_a_diagram_is_written_in_every_form(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"p.{suffix}"
    assert main(["chart", "press", "--polar", "--quantity", "ground.O2.force", "-o", str(path)]) == 0
    assert path.stat().st_size > 1000
