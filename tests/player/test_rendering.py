"""A recording that is rendered beside: what it says is heard, also where the system is not POSIX."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from runpy import run_module

import pytest

from linkanim import cli
from linkanim.cli.commands import record as tapes
from linkanim.errors import WorkFailed
from linkanim.player import background
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.scenes import load


def talking(command: list[str], log: int) -> subprocess.Popen[bytes]:
    """Start what says how far it is, and last where the fault lies."""
    text = "import sys; print('x' * 900, '3/8', file=sys.stderr); print('linkanim: no room', file=sys.stderr)"
    return subprocess.Popen([sys.executable, "-c", f"{text}; sys.exit(1)"], stderr=log)


@pytest.fixture
def tape() -> Tape:
    return Tape(begin(load("kite")), 3, ())


@pytest.mark.parametrize("windows", [False, True], ids=["as here", "as on Windows"])
def test_what_a_rendering_says_is_told_and_nothing_of_it_is_left(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch, windows: bool
) -> None:
    unlink, open_ones = Path.unlink, list[background.Rendering]()

    def refused(path: Path, missing_ok: bool = False) -> None:
        if not open_ones or not open_ones[0]._log.closed:
            raise PermissionError(13, "The process cannot access the file")
        unlink(path, missing_ok)

    (here / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(here / "tmp"))
    monkeypatch.setattr(background, "_start", talking)
    if windows:
        monkeypatch.delattr(os, "pread", raising=False)
        monkeypatch.setattr(Path, "unlink", refused)
    one = background.keep(tape, "gif").rendering()
    open_ones.append(one)
    one._process.wait()
    for _ in range(2):
        assert one.words() == "recordings/kite-1.gif: no room".replace("/", os.sep)
    one.close()
    assert list((here / "tmp").iterdir()) == []


def test_a_rendering_that_runs_says_how_far_it_is(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def still_running(command: list[str], log: int) -> subprocess.Popen[bytes]:
        """Start what waits to be told to end; it has said how far it is twice."""
        os.write(log, b"1/75\r12/75\r")
        return subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)

    monkeypatch.setattr(background, "_start", still_running)
    one = background.keep(tape, "gif").rendering()
    process = one._process
    try:
        assert one.words().endswith("kite-1.gif: 16 %")
    finally:
        process.communicate(b"\n")
        one.close()


def test_a_process_that_cannot_be_started_leaves_nothing_open(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(command: list[str], log: int) -> None:
        raise OSError(11, "Resource temporarily unavailable")

    (here / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(here / "tmp"))
    monkeypatch.setattr(background, "_start", refused)
    before = len(list(Path("/proc/self/fd").iterdir())) if Path("/proc/self/fd").exists() else 0
    with pytest.raises(WorkFailed, match="cannot be started: Resource temporarily unavailable"):
        background.keep(tape, "gif").rendering()
    assert list((here / "tmp").iterdir()) == []
    assert before == (len(list(Path("/proc/self/fd").iterdir())) if before else 0)


class Running:
    """A process that ends when it is told to."""

    code: int | None = None

    def poll(self) -> int | None:
        return self.code


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[tuple[list[str], Running]]:
    """The commands of what would have been started, and their processes."""
    found: list[tuple[list[str], Running]] = []

    def start(command: list[str], log: int) -> Running:
        found.append((command, Running()))
        return found[-1][1]

    monkeypatch.setattr(background, "_start", start)
    return found


def test_of_several_recordings_one_is_rendered_and_the_rest_wait(
    tape: Tape, here: Path, started: list[tuple[list[str], Running]]
) -> None:
    queue = background.Queue()
    for _ in range(3):
        queue.add(tape, "gif")
    assert queue.news() == (f"{Path('recordings', 'kite-1.gif')}: … · 2 wait",)
    assert len(started) == 1
    for number, words in ((1, " · 1 waits"), (2, ""), (3, "")):
        started[-1][1].code = 0
        assert queue.news() == (f"{here / 'recordings' / f'kite-{number}.gif'} saved{words}",)
    assert queue.news() == ()
    assert [Path(command[-2]).name for command, _ in started] == ["kite-1.gif", "kite-2.gif", "kite-3.gif"]
    queue.close()
    assert len(started) == 3


def test_what_waits_when_the_window_closes_is_left_to_one_process(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch, started: list[tuple[list[str], Running]]
) -> None:
    queue = background.Queue()
    for size in (None, None, (640, 360)):
        queue.add(tape, "gif", size)
    queue.close()
    (_, (command, _)) = started
    pairs = [[str(Path("recordings", f"kite-{n}{end}")) for end in (".tape.json", ".gif")] for n in (2, 3)]
    rest = [*pairs[0], "", *pairs[1], "640x360"]
    assert command[2:] == ["-m", "linkanim.cli.commands.record", *rest]
    recorded: list[list[str]] = []

    def main(words: list[str]) -> int:
        recorded.append(words)
        return len(recorded)

    monkeypatch.setattr(tapes, "main", main)
    assert tapes.record_all([*rest, "c", "d", ""]) == 3
    sizes: tuple[list[str], ...] = ([], ["--size", "640x360"], [])
    jobs = zip((*pairs, ["c", "d"]), sizes, strict=True)
    assert recorded == [["record", one, "--no-clobber", "-o", other, *size] for (one, other), size in jobs]


def test_a_signal_ends_all_that_is_left_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    recorded: list[list[str]] = []

    def main(words: list[str]) -> int:
        recorded.append(words)
        return 143

    monkeypatch.setattr(tapes, "main", main)
    assert tapes.record_all(["a", "b", "", "c", "d", ""]) == 143
    assert recorded == [["record", "a", "--no-clobber", "-o", "b"]]


def test_the_process_to_which_it_is_left_records(monkeypatch: pytest.MonkeyPatch) -> None:
    recorded: list[list[str]] = []

    def main(words: list[str]) -> int:
        recorded.append(words)
        return 1

    monkeypatch.setattr(cli, "main", main)
    monkeypatch.setattr(sys, "argv", ["record", "one.tape.json", "one.gif", ""])
    monkeypatch.delitem(sys.modules, tapes.__name__)
    with pytest.raises(SystemExit, match="1"):
        run_module(tapes.__name__, run_name="__main__")
    assert recorded == [["record", "one.tape.json", "--no-clobber", "-o", "one.gif"]]
