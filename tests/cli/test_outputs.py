"""What is written takes the place of no file that its user did not name, and never of one that is read."""

from __future__ import annotations

import importlib
import os
import re
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

import linkanim
from linkanim.atomic_files import refuse_input
from linkanim.cli import main
from linkanim.errors import BadInput

EXAMPLES = Path(linkanim.__file__).parent / "examples"
CURVE, POSES = (str(EXAMPLES / name) for name in ("curve.csv", "poses.csv"))
KITE = """
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
[photo]
file = "photo.png"
place = [0, 0]
width = 9
"""
TABLE = "0,10\n90,20\n180,10\n270,20\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder to work in, with what is read: a scene with a photograph, and a table."""
    monkeypatch.chdir(tmp_path)
    for name, text in {"my.toml": KITE, "meas.csv": TABLE, "photo.png": "a photograph"}.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def hard_link(folder: Path) -> None:
    (folder / "other.csv").hardlink_to(folder / "meas.csv")


def scene_with_another_ending(folder: Path) -> None:
    for suffix in ("html", "csv", "gif"):
        (folder / f"my.{suffix}").write_text(KITE)


CHART = ("chart", "my.toml", "--quantity", "rocker.angle", "--size", "200x120", "--data")
# A command whose output is one of the files that it reads; what is done before, if anything.
READ: dict[str, tuple[tuple[str, ...], Callable[[Path], None] | None]] = {
    "a table": ((*CHART, "meas.csv", "-o", "meas.csv"), None),
    "a table by another way": ((*CHART, "meas.csv", "-o", "../{here}/meas.csv"), None),
    "a table in other capitals": ((*CHART, "meas.csv", "-o", "MEAS.csv"), None),
    "a table by a link": ((*CHART, "meas.csv", "-o", "other.csv"), hard_link),
    "a scene file": (("share", "my.html", "-o", "my.html"), scene_with_another_ending),
    "a scene file, by its usual name": (("share", "my.html"), scene_with_another_ending),
    "a scene file, solved": (
        ("solve", "my.csv", "--sweep", "0:9:3", "--csv", "my.csv"),
        scene_with_another_ending,
    ),
    "a scene file, explained": (("explain", "my.html", "-o", "my.html"), scene_with_another_ending),
    "a scene file, asked about": (("quiz", "my.html", "-n", "1", "-o", "my.html"), scene_with_another_ending),
    "a scene file, recorded": (("record", "./my.gif", "-o", "my.gif"), scene_with_another_ending),
    "a photograph": (("draw", "my.toml", "-o", "photo.png"), None),
    "a photograph, charted": (("chart", "my.toml", "--quantity", "rocker.angle", "-o", "photo.png"), None),
    "a photograph, recorded": (("record", "my.toml", "-o", "photo.png"), None),
    "a photograph, made": (("make", "my.toml", "--preview", "photo.png"), None),
}


@pytest.mark.parametrize("name", READ)
def test_what_is_read_is_not_written_over(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words, prepare = READ[name]
    if prepare:
        prepare(folder)
    before = contents(folder)
    assert main([word.replace("{here}", folder.name) for word in words]) == 2
    assert "choose another name for what is written" in capsys.readouterr().err
    assert contents(folder) == before


def test_a_scene_and_a_file_of_its_name_are_two_things(folder: Path) -> None:
    (folder / "kite").mkdir()
    refuse_input(folder / "kite.svg", ["kite", "missing.toml"])
    with pytest.raises(BadInput, match="is what is read as"):
        refuse_input(folder / "MY.toml", [folder / "my.toml"])


# Commands that take a usual name, and that name.
USUAL = {
    "kite.svg": ("draw", "kite", "--phase", "1 rad", "--size", "64x36"),
    "kite.png": ("chart", "kite", "--quantity", "B.velocity", "--size", "200x120"),
    "kite.gif": ("record", "kite", "--size", "64x36", "--seconds", "0.1"),
    "kite.html": ("share", "kite"),
}


@pytest.mark.parametrize("name", USUAL)
def test_under_a_usual_name_only_what_we_wrote_is_replaced(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = USUAL[name]
    (folder / name).write_text("mine")
    before = contents(folder)
    assert main(words) == 2
    assert f"{name} may not be linkanim's own" in capsys.readouterr().err
    assert contents(folder) == before
    (folder / name).unlink()
    assert main(words) == 0
    ours = contents(folder)
    assert main(words) == 0
    assert contents(folder) == ours
    (folder / name).write_text("ours, changed")
    capsys.readouterr()
    assert main(words) == 2
    said = capsys.readouterr().err
    assert f"{name} was changed after linkanim wrote it" in said
    assert f"give -o {name} to replace it" in said
    assert (folder / name).read_text() == "ours, changed"
    assert main([*words, "-o", name]) == 0
    assert contents(folder)[name] == ours[name]


# -o gives the name that the command takes by itself: the file is linkanim's all the same.
@pytest.mark.parametrize("name", USUAL)
def test_a_file_that_was_given_the_usual_name_is_ours(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = USUAL[name]
    (folder / name).write_text("named, and so replaced")
    assert main([*words, "-o", name]) == 0
    made = contents(folder)[name]
    assert main(words) == 0
    assert capsys.readouterr().out == f"{name}\n" * 2
    assert contents(folder)[name] == made
    (folder / name).write_text("ours, changed")
    assert main(words) == 2
    assert (folder / name).read_text() == "ours, changed"


def test_a_usual_name_in_another_folder_or_with_another_ending_is_noted_there(folder: Path) -> None:
    (folder / "into").mkdir()
    words = ["draw", "kite", "--phase", "1 rad", "--size", "64x36"]
    assert main([*words, "-o", "into/kite.pdf"]) == 0
    assert main([*words, "-o", "other.svg"]) == 0
    assert {path.name for path in folder.rglob(".*")} == {".linkanim-outputs.json"}
    assert [path.parent.name for path in folder.rglob(".*")] == ["into"]


def test_a_list_that_is_none_of_ours_hinders_no_name_that_was_given(folder: Path) -> None:
    (folder / ".linkanim-outputs.json").write_text("mine")
    assert main(["draw", "kite", "--phase", "1 rad", "--size", "64x36", "-o", "kite.svg"]) == 0
    assert (folder / ".linkanim-outputs.json").read_text() == "mine"


# Each command that writes several answers, and how it searches.
SEARCHES = {
    "path": (("path", CURVE, "--count", "3", "-o", "p.toml"), "path"),
    "path, with cognates": (("path", CURVE, "--count", "1", "--cognates", "-o", "p.toml"), "path"),
    "guide": (("guide", POSES, "--count", "3", "-o", "p.toml"), "guide"),
    "function": (("function", "1/x", "--from", "1", "--to", "2", "--count", "3", "-o", "p.toml"), "function"),
    "quick-return": (
        ("quick-return", "--stroke", "80", "--ratio", "1.4", "--count", "3", "-o", "p.toml"),
        "quick_return",
    ),
    "dwell": (("dwell", "--rest", "90 deg", "--stroke", "50", "--count", "3", "-o", "p.toml"), "dwell"),
}


@pytest.mark.parametrize("words", SEARCHES)
@pytest.mark.parametrize("taken", ["p.toml", "p-2.toml", "p-3.toml"])
def test_a_further_answer_s_name_that_is_a_foreign_file_s_is_refused_before_the_search(
    words: str, taken: str, folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / taken).write_text("mine")
    (folder / "p-4.toml").write_text("mine, and in nobody's way")
    command, search = SEARCHES[words]
    module = importlib.import_module(f"linkanim.cli.commands.{search}")
    monkeypatch.setattr(module, search, pytest.fail)
    before = contents(folder)
    assert main(command) == 2
    assert f"{taken} may not be linkanim's own" in capsys.readouterr().err
    assert contents(folder) == before


def test_no_clobber_is_for_side_files_too(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["record", "kite", "--size", "64x36", "--seconds", "0.1", "--no-clobber", "-o", "film.gif"]
    (folder / "film.txt").write_text("mine")
    before = contents(folder)
    assert main([*words, "--alt", "film.txt"]) == 2
    assert "film.txt may not be linkanim's own" in capsys.readouterr().err
    assert contents(folder) == before
    for _ in range(2):
        assert main([*words, "--alt", "words.txt"]) == 0
    assert (folder / "words.txt").read_text(encoding="utf-8").startswith("Kite")
    assert main([*words[:-3], "-o", "film.gif", "--alt", "film.txt"]) == 0  # asked for by name
    assert (folder / "film.txt").read_text() == (folder / "words.txt").read_text()


@pytest.mark.skipif(os.name == "nt", reason="has no modes of this kind")
@pytest.mark.parametrize(
    "words", [USUAL["kite.svg"], ("report", "kite", "-o", "into")], ids=["draw", "report"]
)
def test_a_umask_that_takes_our_own_rights_hinders_nothing(
    words: tuple[str, ...], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = os.umask(0o277)
    try:
        for _ in range(2):
            assert main(words) == 0, capsys.readouterr().err
    finally:
        os.umask(before)
    made = [path for path in folder.rglob("*") if path.is_file() and path.parent.name == "into"]
    made += [folder / name for name in ("kite.svg",) if (folder / name).exists()]
    assert {stat.S_IMODE(path.stat().st_mode) for path in made} == {0o600}


def test_files_of_usual_names_share_one_list(folder: Path) -> None:
    for words in (USUAL["kite.svg"], USUAL["kite.png"], USUAL["kite.svg"]):
        assert main(words) == 0
    lists = [name for name in contents(folder) if name.startswith(".")]
    assert lists == [".linkanim-outputs.json"]


def test_the_words_beside_a_pdf_take_nobody_s_place(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["draw", "kite", "--phase", "1 rad", "-o", "fig.pdf", "--text", "latex"]
    (folder / "fig.pdf_tex").write_text("mine")
    before = contents(folder)
    assert main(words) == 2
    said = capsys.readouterr().err
    assert "fig.pdf_tex may not be linkanim's own" in said
    assert said.endswith("; move it away, or give another name than fig.pdf with -o\n")
    assert contents(folder) == before
    (folder / "fig.pdf_tex").unlink()
    (folder / "fig.pdf").write_text("named, and so replaced")
    assert main(words) == 0
    assert main(words) == 0
    assert (folder / "fig.pdf").read_bytes().startswith(b"%PDF")
    assert (folder / "fig.pdf_tex").read_text(encoding="utf-8").startswith("%% The words of fig.pdf")


LONG = "n" * 256
TOO_LONG = [
    ("draw", "my.toml", "-o", f"{LONG}.svg"),
    ("draw", "my.toml", "-o", "my.svg", "--alt", f"{LONG}.txt"),
    ("report", "my.toml", "-o", LONG),
    ("make", "my.toml", "--fit", "A4", "-o", LONG),
    ("quick-return", "--stroke", "80", "--ratio", "1.4", "--count", "2", "-o", f"{LONG[:250]}.toml"),
    ("play", "--counts", f"{LONG}.csv"),
]


@pytest.mark.skipif(os.name == "nt", reason="Windows has other bounds")
@pytest.mark.parametrize("words", TOO_LONG, ids=lambda words: words[0])
def test_a_name_that_is_too_long_is_its_user_s_to_mend(
    words: tuple[str, ...], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = contents(folder)
    assert main(words) == 2
    assert re.fullmatch(r"linkanim: n+[\w./ :-]*: file name too long\n", capsys.readouterr().err.lower())
    assert contents(folder) == before


@pytest.mark.skipif(os.name == "nt", reason="asks for a folder that nothing can be written to")
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks for such a folder")
def test_a_disk_that_refuses_is_told_of_the_file(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir("/proc")
    assert main(["share", "kite"]) == 1
    assert capsys.readouterr().err.startswith("linkanim: kite.html: cannot be written: ")
