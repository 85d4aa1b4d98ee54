"""`linkanim chart`: the files it writes, what it prints, and what it refuses."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path
from xml.etree import ElementTree

import pytest

from linkanim.cli import main


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", ["out.png", "out.svg", "out.csv"])
def test_the_ending_says_the_format(name: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = [
        "chart",
        "press",
        "--quantity",
        "5.travel_velocity",
        "--speeds",
        "5 rad/s,10 rad/s",
        "-o",
        name,
    ]
    assert main([*options, "--size", "640x360", "--theme", "dark"]) == 0
    assert capsys.readouterr().out == f"{name}\n"
    content = (folder / name).read_bytes()
    assert [path.name for path in folder.iterdir()] == [name]
    if name.endswith("png"):
        assert content[:8] == b"\x89PNG\r\n\x1a\n"
    elif name.endswith("svg"):
        assert ElementTree.fromstring(content).get("width") == "640"
    else:
        assert content.startswith(b"angle_deg,angle,phase,time@5 rad/s,5.travel_velocity@5 rad/s,")


def test_without_a_name_it_is_the_scenes(folder: Path) -> None:
    assert main(["chart", "crank-rocker", "--quantity", "rocker.angle", "--size", "320x180"]) == 0
    assert sorted(path.name for path in folder.iterdir()) == [".linkanim-outputs.json", "crank-rocker.png"]


def test_a_table_says_what_solve_says(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        main(["chart", "press", "--quantity", "3.angle,C.velocity.y", "--speeds", "10 rad/s", "-o", "a.csv"])
        == 0
    )
    with (folder / "a.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows[::45]:
        capsys.readouterr()
        main(["solve", "press", "--phase", f"{row['phase']} rad", "--speed", "10 rad/s", "--json"])
        pose = json.loads(capsys.readouterr().out)
        assert float(row["angle"]) == pytest.approx(pose["angle"])
        assert float(row["3.angle"]) == pytest.approx(pose["bodies"]["3"]["angle"], rel=1e-12)
        assert float(row["C.velocity.y"]) == pytest.approx(pose["joints"]["C"]["velocity"][1], rel=1e-12)


def test_what_is_unbounded_is_inf_in_a_table(folder: Path) -> None:
    assert main(["chart", "double-rocker", "--quantity", "coupler.coefficient", "-o", "a.csv"]) == 0
    first = (folder / "a.csv").read_text().splitlines()[1]
    assert first.endswith(",inf")


def test_a_table_beside_it_is_told_by_its_largest_difference(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # θ and ω3 at 10 rad/s; at 87 deg the published value, as it was printed
    (folder / "report.csv").write_text("deg,w3\n87,3.3271\n\n180,1.0\n")
    options = ["chart", "press", "--quantity", "3.angular_velocity", "--speeds", "10 rad/s", "-o", "a.svg"]
    assert main([*options, "--data", "report.csv"]) == 0
    printed = capsys.readouterr().err.splitlines()
    assert [line.split()[0] for line in printed[:3]] == ["angle", "87", "180"]
    assert printed[-1].startswith("largest difference of report from 3.angular_velocity: ")
    assert printed[-1].endswith(" rad/s at 180.00 deg")
    assert "report" in (folder / "a.svg").read_text()


# options beside `chart crank-rocker`, what the one line says
REFUSED = [
    (["--quantity", "rocker.angel"], "nearest are rocker.angle, "),
    (["--quantity", ","], "--quantity names none"),
    (["--quantity", "rocker.angle", "-o", "out.eps"], ".svg, .png, .pdf, .csv"),
    (["--quantity", "rocker.angle", "-o", "missing/out.png"], "there is no folder"),
    (["--quantity", "rocker.angle", "--speeds", "5"], '--speeds: "5" has no unit'),
    (["--quantity", "rocker.angle", "--speeds", "0 rpm"], "other than zero"),
    (["--quantity", "rocker.angle", "--speeds", ","], "other than zero"),
    (["--quantity", "rocker.angle", "--size", "9999999x2"], "9999999"),
    (["--quantity", "rocker.angle", "--label", "x"], "--data"),
    (["--quantity", "rocker.angle", "--data", "missing.csv"], "missing.csv: no such file"),
    (["--quantity", "rocker.angle", "--data", "empty.csv"], "has no rows"),
    (["--quantity", "rocker.angle", "--data", "one.csv"], "line 2 has 1 of 2 columns (degrees, value)"),
    (["--quantity", "rocker.angle", "--data", "/dev/zero"], "/dev/zero: is not a file with text in it"),
    (["--quantity", "rocker.angle", "--data", "pipe.csv"], "pipe.csv: is not a file with text in it"),
    (["--quantity", "rocker.angle", "--data", "long.csv"], "has 30,000 rows; 20,000 are the most"),
    (["--quantity", "rocker.angle", "--data", "large.csv"], "is larger than 1 MB"),
    (["--quantity", "rocker.angle", "--data", "escape.csv"], "line 2 has the control character U+001B"),
    (["--quantity", "rocker.angle", "--data", "good.csv", "--label", "a\x1bb"], "U+001B"),
    (["--quantity", "P.position", "--data", "good.csv"], "take P.position.x or P.position.y"),
]


TABLES = {
    "empty.csv": "deg,value\n",
    "one.csv": "deg,value\n3\n",
    "good.csv": "1,2\n",
    "long.csv": "1,2\n" * 30_000,
    "large.csv": "1,2\n" * 300_000,
    "escape.csv": "deg,value\n1,\x1b[31m\n",
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes and devices among files")
@pytest.mark.parametrize(("words", "message"), REFUSED)
def test_what_cannot_be_is_refused_in_a_line_and_nothing_is_written(
    words: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in TABLES.items():
        (folder / name).write_text(text)
    os.mkfifo(folder / "pipe.csv")
    before = set(folder.iterdir())
    assert main(["chart", "crank-rocker", *words]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert message in printed.err
    assert printed.err.count("\n") == 1
    assert set(folder.iterdir()) == before


def test_an_angle_out_of_reach_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "far.csv").write_text("60,1\n180,2\n")
    assert main(["chart", "double-rocker", "--quantity", "rocker.angle", "--data", "far.csv"]) == 2
    assert "does not reach 180 deg" in capsys.readouterr().err
