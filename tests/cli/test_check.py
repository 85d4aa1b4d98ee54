"""`linkanim check`: what is printed, as words and as JSON, and the exit code."""

from __future__ import annotations

import json
from pathlib import Path

import pygame
import pytest

from linkanim.cli import main
from linkanim.scenes.schema import SCHEMA

GOOD = "title = 'Mine'\n[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"
BAD = GOOD.replace("crank = 30", "crank = -30") + "[drive]\nspeed = '0 rpm'\n"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.toml").write_text(GOOD)
    (tmp_path / "bad.toml").write_text(BAD)
    return tmp_path


def test_a_good_file_is_told_for_what_it_is(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "good.toml"]) == 0
    printed = capsys.readouterr()
    assert printed.out == "good.toml: good: Mine: Grashof crank-rocker\n"
    assert printed.err == ""


def test_problems_are_printed_a_line_each_as_editors_read_them(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "good.toml", "bad.toml", "none.toml"]) == 2
    printed = capsys.readouterr()
    good, *lines = printed.out.splitlines()
    assert good.startswith("good.toml: good: ")
    assert [line.split(": ")[:2] for line in lines] == [
        ["bad.toml:4", "four-bar.crank = -30"],
        ["bad.toml:8", 'drive.speed = "0 rpm"'],
        ["none.toml", "no such file"],
    ]
    assert printed.err == "linkanim: 3 problems in 2 of 3 files\n"
    assert main(["check", "none.toml"]) == 2
    assert capsys.readouterr().err == "linkanim: 1 problem in 1 of 1 file\n"
    assert main(["check", "bad.toml"]) == 2
    assert capsys.readouterr().err == "linkanim: 2 problems in 1 of 1 file\n"


def test_json_tells_the_same(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "good.toml", "bad.toml", "--json"]) == 2
    output = capsys.readouterr().out
    assert output.splitlines()[:3] == ["[", "  {", '    "file": "good.toml",']
    good, bad = json.loads(output)
    assert good == {
        "file": "good.toml",
        "good": True,
        "problems": [],
        "scene": {"title": "Mine", "class": "Grashof crank-rocker", "notes": []},
    }
    assert (bad["good"], bad["scene"]) == (False, None)
    assert [problem["line"] for problem in bad["problems"]] == [4, 8]
    assert bad["problems"][0]["message"] == "four-bar.crank = -30: must be above zero"


def test_the_schema_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--schema"]) == 0
    assert json.loads(capsys.readouterr().out) == json.loads(json.dumps(SCHEMA))


def test_without_a_file_there_is_nothing_to_check(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check"]) == 2
    assert "name the scene files" in capsys.readouterr().err


def test_a_start_that_the_input_does_not_come_to_is_said(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    swings = GOOD.replace("crank = 30", "crank = 60").replace("rocker = 80", "rocker = 20")
    Path("swings.toml").write_text(f"{swings}[drive]\nstart = '230 deg'\n")
    assert main(["check", "swings.toml"]) == 0
    note = "; drive.start = 230° is not reached: the input "
    assert note in capsys.readouterr().out
    assert main(["check", "swings.toml", "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)
    assert told["scene"]["notes"][0].startswith(note.removeprefix("; "))
    assert main(["info", "swings.toml"]) == 0
    assert "230° is not reached" in capsys.readouterr().out
    Path("reached.toml").write_text(f"{swings}[drive]\nstart = '60 deg'\n")
    assert main(["check", "reached.toml"]) == 0
    assert "not reached" not in capsys.readouterr().out


def test_a_photograph_that_is_left_out_is_noted(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("over.toml").write_text(f"{GOOD}[photo]\nfile = 'digger.png'\nplace = [0, 0]\nwidth = 100\n")
    assert main(["check", "over.toml"]) == 0
    left_out = "; digger.png: is not there; the sheet goes on without the photograph\n"
    assert capsys.readouterr().out.endswith(left_out)
    pygame.image.save(pygame.Surface((8, 6)), "digger.png")
    assert main(["check", "over.toml"]) == 0
    assert "photograph" not in capsys.readouterr().out
