"""Files appear whole, or not at all."""

from __future__ import annotations

import os
import platform
import signal
import socket
import stat
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import chdir, closing
from pathlib import Path
from typing import Any

import pytest

from linkanim import atomic_files, manifest
from linkanim.cli.exits import guarded
from linkanim.errors import BadInput, WorkFailed

BEFORE = b"what was there before"


@pytest.fixture
def target(tmp_path: Path) -> Path:
    path = tmp_path / "out.csv"
    path.write_bytes(BEFORE)
    return path


def replaced(path: Path) -> None:
    with atomic_files.replacing(path) as part:
        part.write_bytes(b"new")


def set_replaced(path: Path) -> None:
    with manifest.replacing(manifest.FileSet(path.parent, "set", r"out-\d\.csv")) as new:
        (new / "out-1.csv").write_bytes(b"new")


def added(path: Path) -> None:
    assert atomic_files.add(b"new", path, [path.with_name("out-2.csv")]) == path.with_name("out-2.csv")


def test_a_file_is_replaced_when_it_is_whole(target: Path) -> None:
    with atomic_files.replacing(target) as part:
        part.write_bytes(b"new")
        assert target.read_bytes() == BEFORE
        assert part.parent.parent == target.parent
    assert target.read_bytes() == b"new"
    assert list(target.parent.iterdir()) == [target]


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError, ValueError])
def test_whatever_interrupts_leaves_what_was_there(target: Path, error: type[BaseException]) -> None:
    def interrupted() -> None:
        with atomic_files.replacing(target) as part:
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

    set_replaced(target)
    before = {path.name: path.read_bytes() for path in target.parent.iterdir()}
    monkeypatch.setattr(Path, "replace", refused)
    for write in (replaced, set_replaced):
        with pytest.raises(WorkFailed, match=r"it is open in another program; close it there, or choose"):
            write(target)
    assert {path.name: path.read_bytes() for path in target.parent.iterdir()} == before


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
        atomic_files.checked_target(tmp_path / name, (".gif",))
    for free in ("console.gif", "com.gif", "com10.gif", "my.con.gif"):
        assert atomic_files.checked_target(tmp_path / free, (".gif",)) == tmp_path / free


@pytest.fixture(params=["link", "dangling link", "loop of links", "pipe", "folder", "read-only file"])
def taken(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A name under which something is that no file is written over."""
    path = tmp_path / "taken.csv"
    match request.param:
        case "link":
            (tmp_path / "other.csv").write_bytes(BEFORE)
            path.symlink_to("other.csv")
        case "dangling link":
            path.symlink_to("absent.csv")
        case "loop of links":
            path.symlink_to("loop.csv")
            (tmp_path / "loop.csv").symlink_to("taken.csv")
        case "pipe":
            if not hasattr(os, "mkfifo"):
                pytest.skip("has no named pipes")
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case _:
            path.write_bytes(BEFORE)
            path.chmod(0o444)
    return path


def state(folder: Path) -> dict[str, tuple[int, bytes]]:
    """Return what lies in a folder: mode, and what is in it."""
    found = {}
    for path in folder.iterdir():
        mode = path.lstat().st_mode
        found[path.name] = mode, path.read_bytes() if stat.S_ISREG(mode) else b""
    return found


def test_what_is_no_plain_writable_file_is_never_written_over(taken: Path) -> None:
    before = state(taken.parent)
    with pytest.raises(BadInput, match=r"taken\.csv is .*; (name|choose|make)|taken\.csv is a folder; give"):
        atomic_files.checked_target(taken, (".csv",))
    with pytest.raises(BadInput, match=r"taken\.csv is .*; (name|choose|make) "):
        replaced(taken)
    assert state(taken.parent) == before


def test_what_takes_the_name_meanwhile_is_not_written_over(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"

    def interfered() -> None:
        with atomic_files.replacing(path) as part:
            part.write_bytes(b"new")
            path.symlink_to("absent.csv")

    with pytest.raises(BadInput, match=r"out\.csv is a link"):
        interfered()
    assert path.is_symlink()
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_is_a_loop_of_links_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    with pytest.raises(BadInput, match="a link that leads to no folder"):
        atomic_files.made_folder(tmp_path / "a")


@pytest.mark.skipif(os.name != "posix", reason="has no modes of this kind")
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o755, 0o666])
def test_a_replaced_file_keeps_its_mode(target: Path, mode: int) -> None:
    target.chmod(mode)
    replaced(target)
    assert stat.S_IMODE(target.stat().st_mode) == mode


@pytest.mark.parametrize(
    "links", [pytest.param(True, id="links"), pytest.param(False, id="no links", marks=pytest.mark.quick)]
)
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
        atomic_files.add(b"new", target)


def test_a_written_file_is_as_open_to_others_as_any(tmp_path: Path) -> None:
    (tmp_path / "plain").touch()
    replaced(tmp_path / "replaced")
    set_replaced(tmp_path / "out-1.csv")
    atomic_files.add(b"", tmp_path / "added")
    assert {path.stat().st_mode for path in tmp_path.iterdir()} == {(tmp_path / "plain").stat().st_mode}


# A process number tells nothing: that of a run in another container is free, or another's, here.
HOLDING = """
import sys
from pathlib import Path
from linkanim import atomic_files
with atomic_files.replacing(Path(sys.argv[1])) as part:
    print(part.parent, flush=True)
    sys.stdin.read()
"""


def held(target: Path) -> subprocess.Popen[str]:
    """Start a run that has begun a file and waits."""
    pipe = subprocess.PIPE
    return subprocess.Popen(
        [sys.executable, "-c", HOLDING, str(target)], stdin=pipe, stdout=pipe, text=True, cwd=target.parent
    )


def test_the_lock_and_no_number_tells_whose_run_is_alive(tmp_path: Path) -> None:
    with held(tmp_path / "living.csv") as living, held(tmp_path / "dead.csv") as dead:
        assert living.stdout
        assert dead.stdout
        (at_work, left) = (Path(run.stdout.readline().strip()) for run in (living, dead) if run.stdout)
        dead.kill()
        dead.wait()
        foreign = tmp_path / ".linkanim-4567abcd.part"
        foreign.touch()
        (left / "deep").mkdir()
        (left / "deep" / "0001.png").touch()
        atomic_files.clear_stale(tmp_path)
        assert set(tmp_path.iterdir()) == {at_work, foreign}
        living.communicate()
    assert {path.name for path in tmp_path.iterdir()} == {"living.csv", foreign.name}


# Nobody holds the lock of any of these. A folder without one, or with an empty one, may be a run's that
# begins just now. On a disk of this machine a lock that can be taken is nobody's, after a restart, too;
# elsewhere another machine's locks may not show, and what it works on is left alone for a week.
HERE, ELSEWHERE, DAY = 8, 0, 24 * 3600
LEFT = {
    "an empty folder of just now": (HERE, None, 0, True),
    "an empty folder": (HERE, None, 61, False),
    "an empty lock of just now": (HERE, b"", 0, True),
    "an empty lock": (HERE, b"", 61, False),
    "an empty lock elsewhere": (ELSEWHERE, b"", 61, False),
    "a lock from before a restart": (HERE, b"0f6c02d5-63ad-4e5a-8f0f-1f0bb6f0a9a4", 0, False),
    "our own lock elsewhere": (ELSEWHERE, platform.node().encode(), 0, False),
    "another machine's lock": (ELSEWHERE, b"another machine", 0, True),
    "another machine's lock of six days ago": (ELSEWHERE, b"another machine", 6 * DAY, True),
    "another machine's lock of eight days ago": (ELSEWHERE, b"another machine", 8 * DAY, False),
}


def left_behind(folder: Path, lock: bytes | None, ago: float) -> Path:
    """Make a scratch folder as a killed run leaves it."""
    part = folder / ".linkanim-0123456789abcdef.part"
    part.mkdir()
    if lock is not None:
        (part / "lock").write_bytes(lock)
    if lock:
        (part / "new").mkdir()
        (part / "new" / "0001.png").touch()
    for path in (*part.iterdir(), part):
        os.utime(path, (time.time() - ago,) * 2)
    return part


@pytest.mark.skipif(sys.platform != "linux", reason="Linux numbers the disks")
@pytest.mark.parametrize(("disk", "lock", "ago", "stays"), LEFT.values(), ids=LEFT)
def test_what_a_killed_run_leaves_goes_with_the_next(
    tmp_path: Path,
    disk: int,
    lock: bytes | None,
    ago: float,
    stays: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(os, "major", lambda device: disk)
    part = left_behind(tmp_path, lock, ago)
    replaced(tmp_path / "next.csv")
    assert part.exists() == stays


@pytest.mark.parametrize(("days", "stays"), [(0, True), (6, True), (8, False)])
@pytest.mark.parametrize("locked", [True, False], ids=["by no lock", "without a lock"])
def test_where_no_lock_can_be_taken_the_age_tells(
    tmp_path: Path, days: int, stays: bool, locked: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(lock: int, *, wait: bool = False) -> None:
        raise OSError(37, "No locks available")

    monkeypatch.setattr(atomic_files, "hold", refused)
    part = left_behind(tmp_path, b"another machine", days * DAY)
    if not locked:
        (part / "lock").unlink()
        os.utime(part, (time.time() - days * DAY,) * 2)
    replaced(tmp_path / "next.csv")
    assert part.exists() == stays


# An unpacked archive can carry any of these: each would have a run wait, or lock what is not ours.
WAITING = """
import sys
from pathlib import Path
from linkanim import atomic_files
from linkanim.cli.exits import guarded
from linkanim.errors import WorkFailed
with atomic_files.replacing(Path("out.csv")) as part:
    part.write_bytes(b"new")
atomic_files.add(b"new", Path("added.csv"))
try:
    with atomic_files.alone(Path("scores.json")):
        print("has it")
except WorkFailed as error:
    print(error)
"""


@pytest.mark.skipif(os.name != "posix", reason="has no named pipes")
@pytest.mark.parametrize("kind", ["pipe", "link to a pipe", "link to a file", "folder", "socket"])
def test_a_lock_that_is_no_file_is_not_opened(tmp_path: Path, kind: str) -> None:
    part, other = left_behind(tmp_path, None, 8 * DAY), tmp_path / "other"
    for lock in (part / "lock", tmp_path / ".scores.json.lock"):
        match kind:
            case "pipe":
                os.mkfifo(lock)
            case "folder":
                lock.mkdir()
            case "socket":
                with closing(socket.socket(socket.AF_UNIX)) as one, chdir(lock.parent):
                    one.bind(lock.name)
            case _:
                if not other.exists():
                    os.mkfifo(other) if kind == "link to a pipe" else other.write_bytes(BEFORE)
                lock.symlink_to(other)
    command = [sys.executable, "-c", WAITING]
    done = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True, timeout=30)
    assert done.stdout == "scores.json: cannot be written: .scores.json.lock is no file of linkanim's\n"
    assert os.path.lexists(part / "lock")
    assert kind != "link to a file" or other.read_bytes() == BEFORE


def counting(name: str, at: int, does: Callable[[], None], monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Have a method of paths do something before its call of that number; return the count of its calls."""
    method, calls = getattr(Path, name), [0]

    def counted(path: Path, *words: Any, **more: Any) -> Any:
        calls[0] += 1
        if calls[0] == at:
            does()
        return method(path, *words, **more)

    monkeypatch.setattr(Path, name, counted)
    return calls


@pytest.mark.withstands("faults survived", 15)
@pytest.mark.parametrize("write", [replaced, set_replaced, added])
@pytest.mark.parametrize("name", ["is_symlink", "is_dir", "iterdir", "unlink", "rmdir"])
def test_a_signal_is_obeyed_when_removing_is_finished(
    target: Path, write: Callable[[Path], None], name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for at in range(1, 100):
        target.with_name("out-2.csv").unlink(missing_ok=True)
        with monkeypatch.context() as counted:
            calls = counting(name, at, lambda: signal.raise_signal(signal.SIGTERM), counted)
            code = guarded(lambda: write(target))
        assert not list(target.parent.glob(".linkanim-*.part")), at
        if calls[0] < at:
            assert code == 0
            return
        assert code == 143
    raise AssertionError(f"{name} was called a hundred times")


@pytest.mark.parametrize("name", ["new", "lock"])
def test_what_cannot_be_removed_stays_with_its_lock_and_goes_with_the_next_run(
    target: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    unlink = Path.unlink

    def refused(path: Path, missing_ok: bool = False) -> None:
        if path.name == name:
            raise OSError(5, "Input/output error")
        unlink(path, missing_ok)

    with monkeypatch.context() as failing:
        failing.setattr(Path, "unlink", refused)
        added(target)
        (part,) = target.parent.glob(".linkanim-*.part")
        assert (part / "lock").exists()
    replaced(target)
    assert not part.exists()


def test_a_folder_is_made_where_only_it_is_missing(target: Path) -> None:
    made = atomic_files.made_folder(target.parent / "into")
    assert made.is_dir()
    assert atomic_files.made_folder(made) == made
    with pytest.raises(BadInput, match="is a file; name a folder"):
        atomic_files.made_folder(target)
    with pytest.raises(BadInput, match="there is no folder"):
        atomic_files.made_folder(made / "absent" / "deeper")
