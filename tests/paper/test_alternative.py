"""What a picture shows is said in words, beside it and in it."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.paper.curves import Pace
from linkanim.paper.sentences import of_motion, of_pose
from linkanim.scenes import load, names
from linkanim.scenes.editing import in_unit
from linkanim.scenes.reading import scene_from

SVG = "{http://www.w3.org/2000/svg}"


def test_a_recording_s_text_says_what_moves_between_which_values(tmp_path: Path) -> None:
    made, told = tmp_path / "rocker.gif", tmp_path / "rocker.txt"
    asked = ["record", "crank-rocker", "--size", "160x120", "--fps", "5", "-o", str(made), "--alt", str(told)]
    assert main(asked) == 0
    text, info = told.read_text(encoding="utf-8"), load("crank-rocker").info
    assert text.count("\n") == 1
    assert "the crank turns fully" in text
    assert "20 rpm" in text
    cycle = np.degrees(load("crank-rocker").cycle(3600).angle["rocker"])
    low, high = (float(value) for value in re.findall(r"from ([\d.]+)° .* to ([\d.]+)°", text)[0])
    assert (low, high) == pytest.approx((cycle.min(), cycle.max()), rel=4e-4)
    assert info.time_ratio
    assert f"time ratio {info.time_ratio:.2f}" in text
    assert "lasts 3 s" in text


@pytest.mark.parametrize(
    "command", [["draw", "press", "--angle", "87 deg"], ["chart", "press", "--quantity", "5.travel"]]
)
def test_figures_and_charts_carry_their_words_and_write_them_beside(
    command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    made, told = tmp_path / "made.svg", tmp_path / "made.txt"
    assert main([*command, "-o", str(made), "--alt", str(told)]) == 0
    assert str(told) in capsys.readouterr().out
    words = ElementTree.parse(made).getroot().findtext(f"{SVG}desc")
    assert words
    assert words in told.read_text(encoding="utf-8")
    assert "_{" not in words


def test_the_words_of_a_construction_have_no_marks_of_subscripts(tmp_path: Path) -> None:
    made, told = tmp_path / "made.svg", tmp_path / "made.txt"
    asked = ["draw", "geared-five-bar-2-1", "--construction", "centres", "-o", str(made)]
    assert main([*asked, "--alt", str(told)]) == 0
    assert " at θ of large = " in told.read_text(encoding="utf-8")


def test_a_pose_is_told_by_its_links() -> None:
    text, pose = of_pose(load("crank-rocker"), 1.0), load("crank-rocker").pose(1.0, 0)
    for name in ("crank", "coupler", "rocker"):
        assert f"{name} at {np.degrees(pose.angle[name]) % 360:.1f}°" in text


BARE = {
    "drive": {"slider": {"joint": "C", "from": 20, "to": 90}},
    "ground": {"O2": [0, 0]},
    "joints": {
        "C": {"line": {"through": "O2", "angle": "10 deg"}},
        "A": {"from": ["C", "O2"], "length": [90, 80]},
    },
}


@pytest.mark.parametrize("at", [0, 1_000_000])
def test_a_pose_without_links_of_a_name_is_told_by_its_joints_as_closely_anywhere(at: int) -> None:
    scene = scene_from(BARE | {"ground": {"O2": [at, at]}}, name="bare", where="bare.toml")
    scene = in_unit(scene, "m")
    text = of_pose(scene, 0.0)
    assert text.startswith("Bare. At s = 0.02000 m: C at (")
    assert not text.endswith(": .")
    assert f"A at ({scene.pose(0.0, 0).position['A'][0]:.5f}, ".replace("-", "−") in text


def test_a_pdf_has_a_language_a_title_and_its_words(tmp_path: Path) -> None:
    pytest.importorskip("fpdf")
    made = tmp_path / "made.pdf"
    assert main(["draw", "crank-rocker", "--angle", "60 deg", "-o", str(made)]) == 0
    content = made.read_bytes()
    assert re.search(rb"/Lang\s*\(", content)
    assert b"/DisplayDocTitle true" in content
    assert b"/Subject" in content


def test_a_tape_and_another_ending_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["draw", "press", "-o", str(tmp_path / "a.svg"), "--alt", str(tmp_path / "a.md")]) == 2
    assert ".txt" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_scene_is_told_in_a_paragraph(name: str) -> None:
    scene = load(name)
    for text in (of_motion(scene, Pace(scene.linkage.drive.speed, "its speed")), of_pose(scene, 0.3)):
        assert 40 < len(text) < 700, text
        assert not re.search(r"nan|inf\b|_\{|  |\.\.", text), text
