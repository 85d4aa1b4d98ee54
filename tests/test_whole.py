"""Files appear whole, or not at all."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from linkanim import whole
from linkanim.errors import BadInput, WorkFailed

BEFORE = b"what was there before"


@pytest.fixture
def target(tmp_path: Path) -> Path:
    path = tmp_path / "out.csv"
    path.write_bytes(BEFORE)
    return path


def replaced(path: Path) -> None:
    with whole.replacing(path) as part:
        part.write_bytes(b"new")


def numbers_replaced(path: Path) -> None:
    with whole.numbering(path.with_suffix(".png")) as part:
        (part / "0001.png").write_bytes(b"new")


def folder_replaced(path: Path) -> None:
    with whole.replacing_folder(path.with_name("report")) as part:
        (part / "page.html").write_bytes(b"new")


def added(path: Path) -> None:
    assert whole.add(b"new", path, [path.with_name("out-2.csv")]) == path.with_name("out-2.csv")


def test_a_file_is_replaced_when_it_is_whole(target: Path) -> None:
    with whole.replacing(target) as part:
        part.write_bytes(b"new")
        assert target.read_bytes() == BEFORE
        assert part.parent == target.parent
    assert target.read_bytes() == b"new"
    assert list(target.parent.iterdir()) == [target]


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError, ValueError])
def test_whatever_interrupts_leaves_what_was_there(target: Path, error: type[BaseException]) -> None:
    def interrupted() -> None:
        with whole.replacing(target) as part:
            part.write_bytes(b"half")
            raise error

    with pytest.raises(error):
        interrupted()
    assert target.read_bytes() == BEFORE
    assert list(target.parent.iterdir()) == [target]


def test_a_disk_that_refuses_is_one_line(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(number: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    for write in (replaced, added):
        with pytest.raises(WorkFailed, match=r"out\.csv: cannot be written: no space left on device$"):
            write(target)
    assert target.read_bytes() == BEFORE
    assert list(target.parent.iterdir()) == [target]


# As Windows has it: what a viewer shows cannot be replaced, and a folder of which a file is open has to stay.
@pytest.mark.withstands("faults survived")
@pytest.mark.parametrize("number", [5, 32], ids=["access is denied", "is being used"])
def test_a_target_that_is_open_in_another_program_stays_as_it_was(
    target: Path, number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(path: Path, goal: Path) -> Path:
        error = PermissionError(13, "Access is denied", str(path))
        vars(error)["winerror"] = number
        raise error

    (target.parent / "out-0001.png").write_bytes(BEFORE)
    (target.parent / "report").mkdir()
    monkeypatch.setattr(Path, "replace", refused)
    monkeypatch.setattr(Path, "rename", refused)
    for write in (replaced, numbers_replaced, folder_replaced):
        with pytest.raises(WorkFailed, match=r"it is open in another program; close it there, or choose"):
            write(target)
    assert target.read_bytes() == BEFORE == (target.parent / "out-0001.png").read_bytes()
    assert {path.name for path in target.parent.iterdir()} == {"out.csv", "out-0001.png", "report"}


# A machine that stops just after a file took its name must not leave it empty.
@pytest.mark.parametrize("write", [replaced, added])
def test_the_bytes_are_on_the_disk_before_the_name(
    target: Path, write: Callable[[Path], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    settled: list[tuple[bytes, list[str]]] = []
    fsync = os.fsync

    def watched(number: int) -> None:
        fsync(number)
        names = sorted(path.name for path in target.parent.iterdir() if not path.name.startswith("."))
        settled.append((os.pread(number, 100, 0), names))

    monkeypatch.setattr(os, "fsync", watched)
    write(target)
    assert settled == [(b"new", ["out.csv"])]


@pytest.mark.parametrize("name", ["CON.gif", "nul.gif", "Aux.old.gif", "com7.gif", "LPT1 .gif"])
def test_a_name_that_windows_keeps_for_a_device_is_refused_everywhere(tmp_path: Path, name: str) -> None:
    with pytest.raises(BadInput, match=r"Windows keeps .* for a device; choose another name$"):
        whole.checked_target(tmp_path / name, (".gif",))
    for free in ("console.gif", "com.gif", "com10.gif", "my.con.gif"):
        assert whole.checked_target(tmp_path / free, (".gif",)) == tmp_path / free


def test_a_link_stays_a_link(target: Path) -> None:
    link = target.with_name("link.csv")
    link.symlink_to(target.name)
    replaced(link)
    assert link.is_symlink()
    assert target.read_bytes() == b"new"


@pytest.mark.parametrize("links", [True, False], ids=["links", "no links"])
def test_an_added_file_takes_the_first_free_name(
    target: Path, links: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(path: Path, other: Path) -> None:
        raise PermissionError(1, "Operation not permitted")

    if not links:
        monkeypatch.setattr(Path, "hardlink_to", refused)
    added(target)
    assert target.read_bytes() == BEFORE
    assert {path.name: path.read_bytes() for path in target.parent.iterdir()} == {
        "out.csv": BEFORE,
        "out-2.csv": b"new",
    }
    with pytest.raises(WorkFailed, match=r"out\.csv: cannot be written: file exists"):
        whole.add(b"new", target)


def test_a_written_file_is_as_open_to_others_as_any(tmp_path: Path) -> None:
    (tmp_path / "plain").touch()
    replaced(tmp_path / "replaced")
    whole.add(b"", tmp_path / "added")
    assert {path.stat().st_mode for path in tmp_path.iterdir()} == {(tmp_path / "plain").stat().st_mode}


def test_temporaries_of_living_runs_stay(tmp_path: Path) -> None:
    living = tmp_path / f".linkanim-{os.getppid()}-0123abcd.part"
    living.touch()
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    (tmp_path / f".linkanim-{dead.pid}-0123abcd.part").mkdir()
    (tmp_path / f".linkanim-{dead.pid}-4567abcd.part").touch()
    (tmp_path / f".linkanim-{dead.pid}.part.gif").touch()  # not a name of ours
    whole.clear_stale(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {living.name, f".linkanim-{dead.pid}.part.gif"}


def test_a_folder_is_made_where_only_it_is_missing(target: Path) -> None:
    made = whole.made_folder(target.parent / "into")
    assert made.is_dir()
    assert whole.made_folder(made) == made
    with pytest.raises(BadInput, match="is a file; name a folder"):
        whole.made_folder(target)
    with pytest.raises(BadInput, match="there is no folder"):
        whole.made_folder(made / "absent" / "deeper")
