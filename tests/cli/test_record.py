"""`linkanim record`: where the file goes, what is said of it, and how it ends when it is stopped."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image
from tqdm import tqdm

import linkanim
from linkanim.cli import main
from linkanim.cli.command_table import parse
from linkanim.cli.picture_options import look_of
from linkanim.cli.progress import advance, bar
from linkanim.player import tape_file
from linkanim.player.action import Action
from linkanim.player.state import begin
from linkanim.player.tape import Tape

SMALL = ["--size", "96x54", "--fps", "10"]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_the_path_is_on_stdout_and_what_it_holds_on_stderr(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["record", "crank-rocker", "-o", "rocker.gif", *SMALL]) == 0
    printed = capsys.readouterr()
    assert printed.out == "rocker.gif\n"
    assert printed.err.count("\n") == 1
    assert printed.err.startswith("rocker.gif: 30 frames")
    assert "20 rpm" in printed.err
    with Image.open("rocker.gif") as gif:
        assert gif.size == (96, 54)
        assert getattr(gif, "n_frames", 1) == 30


# options, the files that come out
@pytest.mark.parametrize(
    ("words", "made"),
    [
        ([], ["crank-rocker.gif"]),
        (["--for", "web"], ["crank-rocker.gif"]),
        (["--for", "beamer"], ["crank-rocker-0001.png", "crank-rocker-0002.png"]),
        (["-o", "a.mp4"], ["a.mp4"]),
        (["-o", "a.PNG"], ["a-0001.PNG", "a-0002.PNG"]),
    ],
    ids=lambda value: " ".join(value) if value and value[0].startswith("-") else None,
)
def test_the_file_is_named_after_the_scene_where_no_name_is_given(
    words: list[str], made: list[str], tmp_path: Path
) -> None:
    assert main(["record", "crank-rocker", *SMALL, "--seconds", "0.2", *words]) == 0
    assert [name for name in files(tmp_path) if not name.startswith(".linkanim-")] == made


# what each preset stands for: size, and the frames of a fifth of a second
@pytest.mark.parametrize(
    ("words", "file", "size", "frames"),
    [
        ([], "kite.gif", (1280, 720), 5),
        (["--for", "slides"], "kite.gif", (1280, 720), 5),
        (["--for", "web"], "kite.gif", (640, 360), 4),
        (["--for", "beamer"], "kite-0005.png", (1280, 720), 1),
    ],
)
def test_a_preset_stands_for_a_size_and_a_rate(
    words: list[str], file: str, size: tuple[int, int], frames: int, tmp_path: Path
) -> None:
    assert main(["record", "kite", *words, "--seconds", "0.2"]) == 0
    assert files(tmp_path)[-1] == file
    with Image.open(file) as picture:
        assert (picture.size, getattr(picture, "n_frames", 1)) == (size, frames)


@pytest.mark.slow
def test_a_preset_gives_way_to_what_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["record", "crank-rocker", "--for", "web", "--seconds", "0.2"]) == 0
    with Image.open("crank-rocker.gif") as gif:
        assert gif.size == (640, 360)
    assert main(["record", "crank-rocker", "--for", "web", "--seconds", "0.2", "--size", "64x36"]) == 0
    with Image.open("crank-rocker.gif") as gif:
        assert gif.size == (64, 36)


REFUSED = [
    # where it goes
    (["-o", "."], "is a folder"),
    (["-o", "missing/a.gif"], "there is no folder"),
    (["-o", "a.avi"], ".gif"),
    (["-o", "a"], ".gif"),
    # what it shows
    (["--chart", "rocker.angel"], "rocker.angle"),
    (["-o", "a.mp4", "--transparent"], "transparen"),
    # how long and how large
    (["--size", "1x1"], "1x1"),
    (["--size", "99999x99999"], "99999x99999"),
    (["--periods", "99999"], "frames"),
    (["--speed", "0 rpm"], "speed"),
    (["--speed", "1e9 rpm"], "rpm"),
]


@pytest.mark.parametrize(("words", "message"), REFUSED, ids=[" ".join(words) for words, _ in REFUSED])
def test_what_cannot_be_recorded_is_one_line_and_no_file(
    words: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["record", "crank-rocker", *words]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert message in printed.err
    assert files(tmp_path) == []


@pytest.fixture
def tape() -> Path:
    """Write a tape of half a second in which the trace is switched off."""
    taken = Tape(begin(linkanim.load("crank-rocker")), 30, ((10, Action("trace")),))
    path = Path("shown.tape.json")
    tape_file.write(taken, path)
    return path


def test_a_tape_is_recorded_under_its_own_name(
    tape: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["record", str(tape), *SMALL]) == 0
    assert capsys.readouterr().out == "shown.gif\n"
    with Image.open("shown.gif") as gif:
        assert (gif.size, getattr(gif, "n_frames", 1)) == ((96, 54), 5)


# options that a tape has its own answer to, and files that are no tape
@pytest.mark.parametrize(
    "words",
    [
        *(["--speed", "3 rpm"], ["--theme", "dark"], ["--periods", "2"], ["--vectors", "v"], ["--noted"]),
        *([word] for word in ("--no-trace", "--no-hud", "--instant-centres", "--centrodes", "--transparent")),
    ],
    ids=" ".join,
)
def test_a_tape_keeps_its_own(words: list[str], tape: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["record", str(tape), *words]) == 2
    assert f"{words[0]} is for a scene" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["", "{}", '{"linkanim_tape": 99}', "[1, 2"])
def test_what_is_no_tape_is_one_line(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("a.tape.json").write_text(text)
    assert main(["record", "a.tape.json"]) == 2
    message = capsys.readouterr().err
    assert message.startswith("linkanim: a.tape.json: ")
    assert message.count("\n") == 1


# a pipe or a file sees no bar, unless it asks for one
@pytest.mark.parametrize(("words", "seen"), [([], False), (["--progress"], True)])
def test_progress_is_told_where_it_is_asked_for(
    words: list[str], seen: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["record", "crank-rocker", *SMALL, "--seconds", "0.4", *words]) == 0
    message = capsys.readouterr().err
    assert ("frames [" in message) is seen
    assert message.count("\n") == 1  # its line is used again


@pytest.mark.parametrize("shown", [True, False])
def test_a_bar_is_drawn_where_it_is_to_be_and_leaves_nothing_behind(
    shown: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    with bar(shown=shown, unit=" rows") as output:
        output(2, 4)
    drawn = capsys.readouterr().err
    assert ("rows" in drawn) is shown
    assert drawn.split("\r")[-1] == ""
    assert "\n" not in drawn


def test_less_than_a_second_or_a_frame_a_second_can_be_recorded() -> None:
    chosen = parse(["record", "press", "--fps", "0.5", "--seconds", "0.25"])
    assert (chosen.fps, chosen.seconds) == (0.5, 0.25)


def test_the_largest_side_is_taken() -> None:
    assert parse(["record", "press", "--size", "16384x16"]).size == (16384, 16)


def test_a_bar_stands_where_the_work_does() -> None:
    with tqdm(file=io.StringIO()) as drawn:
        for done in (3, 7):
            advance(drawn, done, 10)
            assert (drawn.n, drawn.total) == (done, 10)


def test_a_gallery_that_cannot_be_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("taken").write_text("a file")
    assert main(["gallery", "--into", "taken"]) == 2
    assert main(["gallery", "--into", "missing/gallery"]) == 2
    assert capsys.readouterr().err.count("\n") == 2
    assert files(tmp_path) == ["taken"]


@pytest.mark.slow
def test_a_gallery_is_a_gif_for_each_scene_and_a_sheet(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("linkanim.cli.commands.gallery.names", lambda: ("parallelogram",))
    assert main(["gallery", "--into", "shown"]) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines() == ["shown/parallelogram.gif", "shown/contact-sheet.png"]
    made = [".linkanim-gallery.json", "contact-sheet.png", "parallelogram.gif"]
    assert files(tmp_path / "shown") == made


# Ctrl-C and SIGTERM in the middle of the work: what was there stays, and nothing else is there
@pytest.mark.thinned(2)
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.slow
def test_stopped_in_the_middle_it_leaves_the_old_file_alone(
    number: signal.Signals, code: int, tmp_path: Path
) -> None:
    Path("press.gif").write_text("the old one")
    record = ["record", "press", "-o", "press.gif", "--periods", "50", "--progress"]
    command = [sys.executable, "-m", "linkanim", *record]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0) as process:
        assert process.stderr is not None
        message = process.stderr.read(64)
        while b"/3750" not in message:
            more = process.stderr.read(64)
            assert more, message
            message += more
        os.kill(process.pid, number)
        message += process.stderr.read()
        assert process.stdout is not None
        assert process.stdout.read() == b""
    assert process.returncode == code
    assert message.rstrip().splitlines()[-1].startswith(b"linkanim: ")
    assert b"Traceback" not in message
    assert files(tmp_path) == ["press.gif"]
    assert Path("press.gif").read_text() == "the old one"


@pytest.mark.parametrize(
    ("words", "level"), [([], 0), (["--names"], 1), (["--names"] * 2, 2), (["--names"] * 3, 2)]
)
def test_names_are_asked_for_once_or_twice(words: list[str], level: int) -> None:
    assert look_of(linkanim.load("press"), parse(["record", "press", *words])).names == level
