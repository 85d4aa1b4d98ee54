"""`linkanim function` and `linkanim quick-return`: scenes that do what is printed, and how they end."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.cli import main


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def printed_json(capsys: pytest.CaptureFixture[str], *words: str) -> list[dict[str, Any]]:
    assert main([*words, "--json"]) == 0
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)
    return found


LOGARITHM = ("function", "y = log10(x)", "--from", "1", "--to", "10")


def test_an_expression_longer_than_any_file_s_name_is_an_expression(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["function", "y = " + "+".join("x" * 150), "--from", "1", "--to", "2"]) == 2
    assert "the expression has 303 characters; write 200 at the most" in capsys.readouterr().err
    assert not [*here.iterdir()]


def test_a_function_s_scene_is_off_by_what_is_printed(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--input", "60 deg", "--output", "-60 deg", "-o", "log.toml", "--chart", "error.svg")
    found = printed_json(capsys, *LOGARITHM, *words)
    assert found[0]["file"] == "log.toml"
    x = np.linspace(1, 10, 5001)
    for row in found:
        scene = linkanim.load(here / row["file"])
        angle = row["input_start"] + row["input_range"] * (x - 1) / 9
        output = scene.solve(angle=angle, derivatives=0).angle[row["output_body"]]
        y = (output - row["output_start"]) / row["output_range"]
        assert np.abs(y - np.log10(x)).max() == pytest.approx(row["error"], rel=1e-5)
        assert row["input_range"] == pytest.approx(math.radians(60))
        assert row["output_range"] == pytest.approx(math.radians(-60))
        assert row["defects"] == []
        assert scene.source == "linkanim function y = log10(x)"
    assert "Structural error" in (here / "error.svg").read_text()


def test_a_table_is_followed_by_a_slider(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = "\n".join(f"{x};{x * x}" for x in np.linspace(0, 1, 21))
    (here / "square.csv").write_text(f"x;y\n{rows}\n")
    words = ("--kind", "slider-crank", "--output", "80 mm", "--count", "1")
    (row,) = printed_json(capsys, "function", "square.csv", *words)
    scene = linkanim.load(here / row["file"])
    x = np.linspace(0, 1, 1001)
    travel = scene.solve(angle=row["input_start"] + row["input_range"] * x, derivatives=0).travel["slider"]
    off = (travel - row["output_start"]) / row["output_range"] - x * x
    assert row["output_range"] == 80
    assert np.abs(off).max() == pytest.approx(row["error"], abs=3e-4)


def test_a_straight_line_some_of_whose_poses_have_no_centre_points_is_generated(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = "\n".join(f"{n},{np.pi * (1 + n / 20)}" for n in range(12))
    (here / "line.csv").write_text(f"{rows}\n")
    (row, *_) = printed_json(capsys, "function", "line.csv")
    assert row["error"] < 3e-4
    assert linkanim.load(here / row["file"]).linkage


def test_the_table_of_functions(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*LOGARITHM, "--input", "60 deg", "--output", "-60 deg", "--count", "1"]) == 0
    titles, row = capsys.readouterr().out.splitlines()
    assert titles.split()[:4] == ["file", "largest", "error", "of"]
    assert row.split()[0] == "function.toml"
    widths = [float(end) - float(start) for start, end in re.findall(r"(\S+)…(\S+) deg", row)]
    assert widths == pytest.approx([60, -60], abs=0.1)


@pytest.mark.parametrize(
    ("words", "output"),
    [(("--stroke", "80"), "stroke"), (("--swing", "60 deg", "--stroke", "5 cm"), "swing")],
)
def test_a_time_ratio_s_scenes_have_it(
    words: tuple[str, ...], output: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = printed_json(capsys, "quick-return", *words, "--ratio", "1.4", "--count", "3")
    assert [row["best"] for row in found] == [True, False, False]
    for row in found:
        info = linkanim.load(here / row["file"]).info
        assert info.time_ratio == row["ratio"] == pytest.approx(1.4)
        real = info.stroke if output == "stroke" else info.swing and info.swing.stroke
        assert real == row[output]
    assert main(["quick-return", *words, "--ratio", "1.4", "--place", "0.5"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["function", "y = log10(x)"], "say over which x"),
        (["function", "y = foo(x)", "--from", "1", "--to", "2"], "is no function that is known"),
        ([*LOGARITHM, "--input", "60"], '--input: "60" has no unit'),
        ([*LOGARITHM, "--output", "60 deg:mm"], "--output:"),
        ([*LOGARITHM, "--points", "7"], "in 3 to 5 points"),
        ([*LOGARITHM, "--chart", "error.gif"], "use one of .svg"),
        (["function", "none.csv"], "none.csv: no such file"),
        (["function", "three.csv"], "three.csv: line 1 has 3 columns"),
        (["function", "y = x", "--from", "one", "--to", "2"], "is not a finite number"),
        (["quick-return", "--ratio", "1.4"], "the stroke is missing"),
        (["quick-return", "--stroke", "80"], "required: --ratio"),
        (["quick-return", "--stroke", "-80", "--ratio", "1.4"], "no length above zero"),
        (["quick-return", "--swing", "60", "--ratio", "1.4"], "has no unit"),
        (["quick-return", "--stroke", "80", "--ratio", "0.9"], "1 to 10"),
    ],
)
def test_bad_input_is_one_line(
    words: list[str], said: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "three.csv").write_text("0,0,0\n1,2,3\n")
    assert main(words) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""
    assert list(here.glob("*.toml")) == []


def test_pairs_of_angles_are_a_text_or_a_table(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "pairs.csv").write_text("crank,rocker\n40,70\n45,76\n50,83\n")
    text, table = (
        printed_json(capsys, "function", given, "--pairs") for given in ("40:70, 45:76, 50:83", "pairs.csv")
    )
    assert text[0]["parameters"] == table[0]["parameters"]
    assert text[0]["input_start"] == pytest.approx(math.radians(40))
    assert text[0]["output_start"] == pytest.approx(math.radians(70))
    assert main(["draw", "function.toml", "--construction", "-o", "steps.svg"]) == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["40;70", "--pairs"], '"40;70" is no list of pairs; write them as in'),
        (["40:70, 45:76, 50:83", "--pairs", "--chart", "e.svg"], "leave out --chart"),
        (["40:70, 45:76, 50:83", "--pairs", "--input", "60 deg"], "leave out ranges"),
    ],
)
def test_pairs_that_make_no_sense_are_refused(
    words: list[str], said: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["function", *words]) == 2
    assert said in capsys.readouterr().err
