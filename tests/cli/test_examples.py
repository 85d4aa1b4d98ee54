"""The examples are listed, copied without replacing anything, and run."""

from __future__ import annotations

import json
import math
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import linkanim
from linkanim.cli import main
from linkanim.cli.commands.examples import FOLDER

EVERY = sorted(path.name for path in FOLDER.iterdir() if path.is_file())
NUMBERED = [name for name in EVERY if name[0].isdigit()]
START = math.atan2(1.94, -0.21)
"""The crank's angle in the pose in which the butterfly's points are stated."""


def test_each_has_its_number_and_each_is_listed_with_what_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["examples"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[: len(NUMBERED)]] == NUMBERED
    assert [name[:2] for name in NUMBERED] == [f"{n:02}" for n in range(1, 16)]
    assert all(len(line.split()) > 2 for line in lines[: len(EVERY)])


# what is named, and what is copied for it: the data that an example reads comes with it
@pytest.mark.parametrize(
    ("word", "files"),
    [
        ("06", {"06-optimise.py"}),
        ("6", {"06-optimise.py"}),
        ("10", {"10-hand-out.py", "curve.csv"}),
        ("02-pose", {"02-pose.py"}),
        ("my-linkage.toml", {"my-linkage.toml"}),
        ("all", set(EVERY)),
    ],
)
def test_an_example_is_copied(word: str, files: set[str], tmp_path: Path) -> None:
    folder = tmp_path / "copied"
    assert main(["examples", word, "-o", str(folder)]) == 0
    assert {path.name for path in folder.iterdir()} == files
    assert main(["examples", word, "-o", str(folder)]) == 0
    assert all((folder / name).read_bytes() == (FOLDER / name).read_bytes() for name in files)


def test_what_was_changed_is_never_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mine = tmp_path / "curve.csv"
    mine.write_text("my own", encoding="utf-8")
    assert main(["examples", "10", "-o", str(tmp_path)]) == 2
    assert "curve.csv is there already and is not the example" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["curve.csv"]
    assert mine.read_text(encoding="utf-8") == "my own"


@pytest.mark.parametrize("word", ["16", "cu", "06-optimize"])
def test_an_example_that_is_not_there_is_said(word: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["examples", word]) == 2
    assert "no example is called" in capsys.readouterr().err


def test_the_scenes_are_good(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", *(str(path) for path in FOLDER.glob("*.toml"))]) == 0
    assert capsys.readouterr().out.count(": good: ") == 7


# Positions of other programs' tests: PMKS Verification and PMKS-Web; the pen is back after two turns; both
# shafts of the coupling turn alike, and the middle of its cross twice as fast, on a circle about theirs.
def test_links_that_are_solved_together_move_as_is_known() -> None:
    places = linkanim.load(str(FOLDER / "13-double-butterfly.toml")).solve(angle=math.pi / 2 + START).position
    assert places["J"] == pytest.approx((3.277974954071667, 0.017062641156144212), rel=1e-14)
    stephenson = linkanim.load(str(FOLDER / "12-stephenson.toml"))
    assert stephenson.pose(0.0).position["E"] == pytest.approx((18, 35), rel=1e-14)
    assert linkanim.load(str(FOLDER / "14-plotter.toml")).period == pytest.approx(4 * math.pi)
    oldham = linkanim.load(str(FOLDER / "15-oldham.toml"))
    for phase in (0.3, 2.0, 5.0):
        pose = oldham.pose(phase)
        assert pose.angular_velocity["driven"] == pytest.approx(pose.angular_velocity["driver"], rel=1e-13)
        assert abs(complex(*pose.position["C"]) - 10) == pytest.approx(10, rel=1e-13)


NEEDS = {"04-data-frame.py": "pandas", "06-optimise.py": "scipy"}
MAKES = {
    "02-pose.py": set[str](),
    "03-loop.py": {"crank-rocker.gif"},
    "04-data-frame.py": {"slider-crank.csv"},
    "05-sweep.py": {"sweep.csv", "sweep.toml"},
    "06-optimise.py": {"straight.toml"},
    "09-quiz.py": {"quiz.gift"},
    "10-hand-out.py": {"lesson"},
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=[pytest.mark.long] if one.startswith("10") else []) for one in MAKES]
)
def test_a_script_runs(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if name in NEEDS:
        pytest.importorskip(NEEDS[name])
    for path in (FOLDER / name for name in EVERY):
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(Path(linkanim.__file__).parents[1]))
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    runpy.run_path(name, run_name="__main__")
    assert {path.name for path in tmp_path.iterdir()} - set(EVERY) - {".linkanim-outputs.json"} == MAKES[name]


@pytest.mark.slow
def test_the_cells_of_the_notebook_run() -> None:
    cells = json.loads((FOLDER / "07-notebook.ipynb").read_text(encoding="utf-8"))["cells"]
    names: dict[str, object] = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)
    assert isinstance(names["fastest"], int)


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
def test_the_makefile_makes_every_recording_of_the_deck(tmp_path: Path) -> None:
    shutil.copy(FOLDER / "08-slides.mk", tmp_path)
    command = [f"LINKANIM={sys.executable} -P -m linkanim", "SIZE=96x54"]
    subprocess.run(
        ["make", "-s", "-f", "08-slides.mk", *command], cwd=tmp_path, check=True, capture_output=True
    )
    assert {path.name for path in tmp_path.glob("*.*") if path.suffix in (".gif", ".mp4")} == {
        *("opening.gif", "press.mp4", "limits.gif"),
    }
