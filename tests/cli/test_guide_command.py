"""`linkanim guide`: scene files that run through the poses, table and JSON beside them, and how it ends."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.cli import main

POSES = [(0, 0, 0), (40, 10, 35), (70, -5, 80)]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    rows = "\n".join(",".join(map(str, row)) for row in POSES)
    (tmp_path / "lid.csv").write_text(f"x,y,angle\n{rows}\n")
    return tmp_path


def printed_json(capsys: pytest.CaptureFixture[str], *words: str) -> list[dict[str, Any]]:
    assert main(["guide", *words, "--json"]) == 0
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
def test_each_answer_is_a_scene_that_carries_its_coupler_through_the_poses(
    kind: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = printed_json(capsys, "lid.csv", "-o", "out.toml", "--kind", kind, "--count", "3")
    assert [row["file"] for row in found] == ["out.toml", "out-2.toml", "out-3.toml"]
    for row in found:
        scene = linkanim.load(here / row["file"])
        motion = scene.solve(phase=row["phases"], derivatives=0)
        off = motion.position[scene.trace[0]] - np.array(POSES)[:, :2]
        assert np.abs(off).max() <= 1e-12 * row["largest_link"]
        body = scene.linkage.bodies[1]
        assert scene.trace[0] in body.joints
        turned = np.degrees(motion.angle[body.name]) - np.array(POSES)[:, 2]
        assert np.ptp((turned - turned[0] + 180) % 360) == pytest.approx(0, abs=1e-10)
        assert row["defects"] == []
        assert row["class"] == scene.info.class_name
        assert row["full_turn"] == scene.info.full_turn
        assert row["limits"] == ([] if row["full_turn"] else pytest.approx(scene.info.input_range))
        assert scene.source == "linkanim guide for lid.csv"


def test_the_table_and_its_pivots(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["guide", "lid.csv", "--pivots", "80,-50", "10,-60"]) == 0
    printed = capsys.readouterr()
    titles, *rows = printed.out.splitlines()
    assert " ".join(titles.split()) == "file defects off mm transmission longest link mm sizes crank class"
    assert [row.split()[:2] for row in rows] == [["lid.toml", "none"]]
    info = linkanim.load("lid.toml").info
    first, last = (f"{math.degrees(angle):.4g}" for angle in info.input_range)
    assert ("turns" if info.full_turn else f"{first}…{last} deg") in rows[0]
    pins = {pin.position for pin in linkanim.load("lid.toml").linkage.pins}
    assert pins == {(80.0, -50.0), (10.0, -60.0)}
    assert printed.err == ""


def test_answers_that_all_have_a_defect_are_said_to(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = []
    # a crank-rocker on its one circuit, and then on the other one
    for angle, side in ((10, 1), (60, 1), (130, -1), (200, 1), (290, 1)):
        pin = 30 * np.exp(1j * math.radians(angle))
        way = 100 - pin
        square = abs(way) ** 2
        root = side * math.sqrt((170**2 - square) * (square - 10**2))
        coupler = way * (square + 10 * 170 + 1j * root) / (2 * square * 90)
        place = pin + (40 + 30j) * coupler
        rows.append(f"{place.real},{place.imag},{np.angle(coupler, deg=True)}")
    (here / "apart.csv").write_text("\n".join(rows))
    assert main(["guide", "apart.csv", "--pivots", "0,0", "100,0"]) == 0
    printed = capsys.readouterr()
    assert "circuit" in printed.out
    assert printed.err.startswith("every answer has a defect")


def test_linkages_of_five_poses_that_are_longer_than_allowed_are_told(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "five.csv").write_text("0,0,0\n40,10,35\n70,-5,80\n90,-40,120\n60,-80,170\n")
    assert main(["guide", "five.csv"]) == 0
    printed = capsys.readouterr()
    assert len(printed.out.splitlines()) == 4
    assert "3 more linkages have links of up to 24 sizes of the poses (--largest 24)" in printed.err
    assert main(["guide", "five.csv", "--largest", "24"]) == 0
    printed = capsys.readouterr()
    assert len(printed.out.splitlines()) == 7
    assert "--largest" not in printed.err
    # as many as were asked for: that there are more is no news
    assert main(["guide", "five.csv", "--count", "3"]) == 0
    assert "--largest" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["none.csv"], "none.csv: no such file"),
        (["two.csv"], "two.csv: has no third column"),
        (["lid.csv", "--pivots", "3"], '"3" is not X,Y'),
        (["lid.csv", "--pivots", "-3,x"], '"-3,x" is not X,Y'),
        (["lid.csv", "--pivots", "1,2", "3,4", "5,6"], "has 2 fixed pins; 3 are given"),
        (["lid.csv", "--kind", "crank"], "is not one of its choices: "),
        (["lid.csv", "--prefer", "exact"], "is not one of its choices: "),
        (["lid.csv", "-o", "out.gif"], "use one of .toml"),
        (["turned.csv"], "turned by 400 deg against each other"),
    ],
)
def test_bad_input_is_one_line(
    words: list[str], said: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "two.csv").write_text("0,0\n1,2\n")
    (here / "turned.csv").write_text("0,0,0\n40,10,400\n")
    assert main(["guide", *words]) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""
    assert list(here.glob("*.toml")) == []


def test_a_pivot_left_of_the_origin_is_no_option(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (row,) = printed_json(capsys, "lid.csv", "--pivots", "10,-20", "-5,30.5")
    assert {row["parameters"]["x"], row["parameters"]["x4"]} == {-5.0, 10.0}


@pytest.mark.parametrize("words", [["--driver"], ["--motor", "150,-60"]])
def test_an_answer_whose_crank_swings_runs_from_a_motor(
    words: list[str], here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = printed_json(capsys, "lid.csv", "--kind", "slider-crank", *words)
    some = [row for row in found if "driver" in row]
    assert some
    for row in some:
        scene, driver = linkanim.load(here / row["file"]), row["driver"]
        assert scene.info.full_turn
        assert "--motor" not in words or driver["motor"] == [150, -60]
        assert scene.solve(phase=0.0).position["O6"].tolist() == driver["motor"]
        there = scene.solve(phase=row["phases"], derivatives=0).position["P"]
        assert there == pytest.approx(np.array(POSES)[:, :2], abs=1e-9)
    assert main(["guide", "lid.csv", "--kind", "slider-crank", *words]) == 0
    assert "  driven  " in capsys.readouterr().out
