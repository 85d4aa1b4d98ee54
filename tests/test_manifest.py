"""Of a set of files only those are replaced, and go, that a list beside them says we wrote."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from linkanim.errors import BadInput, WorkFailed
from linkanim.manifest import FileSet, Output, replacing

LIST = ".linkanim-set.json"


@pytest.fixture
def files(tmp_path: Path) -> FileSet:
    return FileSet(tmp_path / "into", "set", r"page\.html|\d{4}\.png")


def written(files: FileSet, contents: dict[str, str], *, others_go: bool = True) -> None:
    with replacing(files, others_go=others_go) as new:
        for name, text in contents.items():
            (new / name).write_text(text)


def texts(files: FileSet) -> dict[str, str]:
    """Return what lies in the set's folder beside its list."""
    return {path.name: path.read_text() for path in files.folder.iterdir() if path.name != LIST}


def test_a_set_takes_the_place_of_an_older_one_and_what_else_is_there_stays(files: FileSet) -> None:
    written(files, {"page.html": "a", "0001.png": "a", "0002.png": "a"})
    (files.folder / "thesis.txt").write_text("mine")
    (files.folder / "20240101.png").write_text("mine")
    written(files, {"page.html": "b", "0001.png": "b"})
    assert texts(files) == {"page.html": "b", "0001.png": "b", "thesis.txt": "mine", "20240101.png": "mine"}
    assert [path.name for path in files.folder.parent.iterdir()] == ["into"]


def test_others_of_the_set_stay_where_they_are_to(files: FileSet) -> None:
    written(files, {"0001.png": "a", "0002.png": "a"})
    written(files, {"0001.png": "b"}, others_go=False)
    written(files, {"0002.png": "c"}, others_go=False)
    assert texts(files) == {"0001.png": "b", "0002.png": "c"}


@pytest.mark.parametrize("folder", ["new", "empty", "with a foreign file"])
def test_a_set_goes_into_any_folder_in_which_its_names_are_free(files: FileSet, folder: str) -> None:
    beside = {"thesis.txt": "mine"} if folder == "with a foreign file" else {}
    if folder != "new":
        files.folder.mkdir()
    for name, text in beside.items():
        (files.folder / name).write_text(text)
    for _ in range(2):
        written(files, {"page.html": "a"})
        assert texts(files) == {"page.html": "a", **beside}


def refused(files: FileSet, why: str) -> None:
    """Have a set be refused, before any work where its names are known, and nothing be changed."""
    before = {path.name: path.read_bytes() for path in files.folder.iterdir() if path.is_file()}
    began: list[Path] = []

    def begun() -> None:
        with replacing(files, ["page.html"]) as new:
            began.append(new)

    with pytest.raises(BadInput, match=why):
        begun()
    assert began == []
    with pytest.raises(BadInput, match=why):
        written(files, {"0001.png": "b", "page.html": "b"})
    assert {path.name: path.read_bytes() for path in files.folder.iterdir() if path.is_file()} == before


def test_a_name_that_a_foreign_file_has_is_refused(files: FileSet) -> None:
    files.folder.mkdir()
    (files.folder / "page.html").write_text("mine")
    refused(files, r"page\.html may not be linkanim's own.*; move it away, or choose another name$")


def test_what_was_changed_since_we_wrote_it_is_refused(files: FileSet) -> None:
    written(files, {"page.html": "a"})
    (files.folder / "page.html").write_text("a and what I noted")
    refused(files, r"page\.html was changed after linkanim wrote it.*; move it away, or choose another name$")


def test_of_what_would_go_that_stays_which_was_changed(files: FileSet) -> None:
    written(files, {"page.html": "a", "0002.png": "a", "0003.png": "a"})
    (files.folder / "0003.png").write_text("retouched")
    written(files, {"page.html": "b"})
    assert texts(files) == {"page.html": "b", "0003.png": "retouched"}


@pytest.mark.parametrize("kind", ["folder", "link", "pipe"])
def test_what_is_no_plain_file_is_refused(files: FileSet, kind: str) -> None:
    files.folder.mkdir()
    path = files.folder / "page.html"
    if kind == "pipe" and not hasattr(os, "mkfifo"):
        pytest.skip("has no named pipes")
    match kind:
        case "folder":
            path.mkdir()
        case "link":
            path.symlink_to("elsewhere")
        case _:
            os.mkfifo(path)
    refused(files, rf"page\.html is a {kind}")


LISTS = [
    "",
    "[]",
    "{}",
    '{"linkanim_wrote": 2, "files": {}}',
    '{"linkanim_wrote": 1, "files": [1]}',
    '{"linkanim_wrote": 1, "files": {"page.html": 3}}',
    "[" * 100_000,
]


@pytest.mark.parametrize("text", LISTS, ids=range(len(LISTS)))
def test_a_list_that_is_none_is_refused(files: FileSet, text: str) -> None:
    files.folder.mkdir()
    files.list_path.write_text(text)
    refused(files, r"\.linkanim-set\.json")


def test_a_list_has_no_say_about_other_names(files: FileSet, tmp_path: Path) -> None:
    written(files, {"page.html": "a"})
    document = json.loads(files.list_path.read_text())
    (sums,) = document["files"].values()
    strange = ("../thesis.txt", "thesis.txt", str(tmp_path / "thesis.txt"))
    document["files"] |= dict.fromkeys(strange, sums)
    files.list_path.write_text(json.dumps(document))
    for path in (tmp_path / "thesis.txt", files.folder / "thesis.txt"):
        path.write_text("a")
    written(files, {"page.html": "b"})
    assert (tmp_path / "thesis.txt").read_text() == (files.folder / "thesis.txt").read_text() == "a"


# Who looks for the file by its name, also in the folder of a run that works, finds none that is half done.
@pytest.mark.parametrize("output", [Output(Path("a.mp4")), Output(Path("a.mp4"), named=False)], ids=repr)
def test_what_is_being_written_has_no_file_of_its_name(
    output: Output, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with output.replacing() as part:
        part.write_text("half")
        assert "a.mp4" not in {path.name for path in tmp_path.rglob("*")}
        part.write_text("whole")
    assert (tmp_path / "a.mp4").read_text() == "whole"
    assert not list(tmp_path.glob("*.part"))


# What moves a file, in the order of the moves; each of them fails once.
@pytest.mark.parametrize("links", [True, False], ids=["links", "no links"])
@pytest.mark.parametrize(
    "error", [OSError(5, "Input/output error"), KeyboardInterrupt()], ids=["error", "^C"]
)
def test_where_a_step_fails_all_is_as_it_was(
    files: FileSet, links: bool, error: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_links(path: Path, other: Path) -> None:
        raise PermissionError(1, "Operation not permitted")

    if not links:
        monkeypatch.setattr(Path, "hardlink_to", no_links)
    written(files, {"page.html": "a", "0001.png": "a", "0002.png": "a"})
    before = {path.name: path.read_bytes() for path in files.folder.iterdir()}
    for failing in fails_at_every_move(error, monkeypatch):
        with pytest.raises((WorkFailed, KeyboardInterrupt)):
            written(files, {"page.html": "b", "0001.png": "b", "0003.png": "b"})
        assert {path.name: path.read_bytes() for path in files.folder.iterdir()} == before, failing
    written(files, {"page.html": "b"})
    assert texts(files) == {"page.html": "b"}


def fails_at_every_move(error: BaseException, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Yield a number for each of the moves of a set; that move fails once it is made."""
    for failing in range(1, 7):
        moves = [0]

        def counted(move: object, moves: list[int] = moves, failing: int = failing) -> object:
            def made(path: Path, goal: Path) -> Path:
                moves[0] += 1
                if moves[0] == failing:
                    raise error
                return move(path, goal)  # type: ignore[operator, no-any-return]

            return made

        with monkeypatch.context() as moving:
            moving.setattr(Path, "replace", counted(Path.replace))
            moving.setattr(Path, "rename", counted(Path.rename))
            yield failing
            assert moves[0] >= failing


# Killed before each of its moves in turn: whatever is under a name is whole, and the next run knows it.
KILLED = r"""
import os, signal, sys
from pathlib import Path
from linkanim.manifest import FileSet, replacing

left = int(sys.argv[2])
def counted(move):
    def made(path, goal):
        global left
        left -= 1
        if left == 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return move(path, goal)
    return made
Path.replace, Path.rename = counted(Path.replace), counted(Path.rename)
with replacing(FileSet(Path(sys.argv[1]), "set", r"page\.html|\d{4}\.png")) as new:
    for name in ("page.html", "0001.png", "0003.png"):
        (new / name).write_text("b")
print("done")
"""


@pytest.mark.skipif(os.name != "posix", reason="kills")
@pytest.mark.slow
def test_a_run_that_is_killed_at_any_move_leaves_whole_files_and_the_next_one_goes_on(files: FileSet) -> None:
    killed = 0
    for moves in range(1, 10):
        written(files, {"page.html": "a", "0001.png": "a", "0002.png": "a"})
        (files.folder / "thesis.txt").write_text("mine")
        command = [sys.executable, "-c", KILLED, str(files.folder), str(moves)]
        done = subprocess.run(command, check=False, capture_output=True)
        if done.returncode == 0:
            break
        killed += 1
        assert done.returncode == -signal.SIGKILL
        left = {path.name: path.read_text() for path in files.folder.glob("[!.]*")}
        assert {"page.html", "0001.png", "thesis.txt"} <= left.keys()
        assert set(left.values()) <= {"a", "b", "mine"}
    assert killed == 6
    assert texts(files) == {"page.html": "b", "0001.png": "b", "0003.png": "b", "thesis.txt": "mine"}
