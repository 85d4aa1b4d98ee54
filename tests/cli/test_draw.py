"""`linkanim draw`: the files it writes, and what it refuses."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pygame
import pytest

from linkanim.cli import main
from linkanim.scenes import load

LIST = ".linkanim-outputs.json"
"""What says which files of usual names we wrote."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_figure_is_written_where_it_was_asked_for(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--angle", "87 deg", "--size", "640x360", "--names", "--vectors", "v,a", "--theme", "dark"]
    assert main(["draw", "press", "-o", "one.png", *options, "--transparent", "--instant-centres"]) == 0
    assert main(["draw", "press", "-o", "one.svg", *options, "--poses", "4", "--ghost", "--no-trace"]) == 0
    assert capsys.readouterr().out == "one.png\none.svg\n"
    assert pygame.image.load(folder / "one.png").get_size() == (640, 360)
    assert ElementTree.parse(folder / "one.svg").getroot().get("width") == "640"


def test_without_a_name_it_is_the_scenes(folder: Path) -> None:
    assert main(["draw", "kite", "--phase", "1 rad"]) == 0
    assert sorted(path.name for path in folder.iterdir()) == [LIST, "kite.svg"]
    root = ElementTree.parse(folder / "kite.svg").getroot()
    assert (root.get("width"), root.get("height")) == ("1280", "720")


def test_angle_and_phase_say_the_same_pose(folder: Path) -> None:
    assert main(["draw", "crank-rocker", "-o", "a.svg", "--angle", "57 deg", "--size", "320x180"]) == 0
    assert main(["draw", "crank-rocker", "-o", "b.svg", "--phase", "57 deg", "--size", "320x180"]) == 0
    assert main(["draw", "crank-rocker", "-o", "c.svg", "--phase", "58 deg", "--size", "320x180"]) == 0
    texts = [(folder / f"{name}.svg").read_text(encoding="utf-8") for name in "abc"]
    assert texts[0] == texts[1] != texts[2]


def test_a_caption_says_what_to_watch_for_where_it_is_asked_for(folder: Path) -> None:
    texts = []
    for words in ([], ["--caption"]):
        assert (
            main(["draw", "crank-rocker", "--angle", "60 deg", *words, "-o", str(folder / "figure.svg")]) == 0
        )
        text = re.sub(r"<[^>]*>", "", (folder / "figure.svg").read_text(encoding="utf-8"))
        texts.append(" ".join(text.split()))
    assert [load("crank-rocker").look_at in text for text in texts] == [False, True]


# The key's arrows stand for round values, those of the pose's own speed.
@pytest.mark.parametrize(
    ("kinds", "said"),
    [("v", ["velocity", "20 mm/s"]), ("v,a", ["velocity", "20 mm/s", "acceleration", "50 mm/s"])],
)
def test_a_figure_says_how_much_its_arrows_stand_for(kinds: str, said: list[str], folder: Path) -> None:
    command = ["draw", "crank-rocker", "--angle", "60 deg", "--size", "640x360", "--vectors", kinds]
    assert main([*command, "-o", "arrows.svg"]) == 0
    words = "".join(ElementTree.parse(folder / "arrows.svg").getroot().itertext())
    assert [one for one in said if one not in words] == []
    assert ("acceleration" in words) == ("a" in kinds)


def test_no_pose_lies_behind_where_none_is_asked_for(folder: Path) -> None:
    assert main(["draw", "kite", "--phase", "1 rad", "-o", "none.svg", "--size", "320x180"]) == 0
    assert (
        main(["draw", "kite", "--phase", "1 rad", "-o", "one.svg", "--size", "320x180", "--poses", "1"]) == 0
    )
    none, one = ((folder / f"{name}.svg").read_text(encoding="utf-8") for name in ("none", "one"))
    assert len(none) < len(one)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["double-rocker", "--angle", "187 deg"], "cannot be reached"),
        (["kite", "-o", "kite.eps"], ".svg, .png, .pdf"),
        (["kite", "--angle", "87"], "unit"),
        (["kite", "--angle", "1 rad", "--phase", "1 rad"], "not allowed with"),
        (["kite", "--size", "3x3"], "16"),
        (["kite", "--poses", "0"], "--poses"),
        (["kite", "--poses", "361"], "360 poses"),
        (["scotch-yoke", "--ghost"], "no second closure"),
        (["scotch-yoke", "--centrodes"], "no coupler"),
    ],
)
def test_bad_input_is_refused_and_nothing_written(
    options: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["draw", *options]) == 2
    err = capsys.readouterr().err
    assert message in err
    assert err.count("\n") == 1
    assert list(folder.iterdir()) == []
