"""A recording that is rendered beside: what it says is heard, also where the system is not POSIX."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from linkanim.errors import WorkFailed
from linkanim.player import rendering
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.scenes import load


def talking(command: list[str], said: int) -> subprocess.Popen[bytes]:
    """Start what says how far it is, and last where the fault lies."""
    text = "import sys; print('x' * 900, '3/8', file=sys.stderr); print('linkanim: no room', file=sys.stderr)"
    return subprocess.Popen([sys.executable, "-c", f"{text}; sys.exit(1)"], stderr=said)


@pytest.fixture
def tape() -> Tape:
    return Tape(begin(load("kite")), 3, ())


@pytest.mark.parametrize("windows", [False, True], ids=["as here", "as on Windows"])
def test_what_a_rendering_says_is_told_and_nothing_of_it_is_left(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch, windows: bool
) -> None:
    unlink, open_ones = Path.unlink, list[rendering.Rendering]()

    def refused(path: Path, missing_ok: bool = False) -> None:
        if not open_ones or not open_ones[0]._said.closed:
            raise PermissionError(13, "The process cannot access the file")
        unlink(path, missing_ok)

    (here / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(here / "tmp"))
    monkeypatch.setattr(rendering, "_start", talking)
    if windows:
        monkeypatch.delattr(os, "pread", raising=False)
        monkeypatch.setattr(Path, "unlink", refused)
    one = rendering.render(tape, "gif")
    open_ones.append(one)
    one._process.wait()
    for _ in range(2):
        assert one.words() == "recordings/kite-1.gif: no room".replace("/", os.sep)
    one.close()
    assert list((here / "tmp").iterdir()) == []


def test_a_rendering_that_runs_says_how_far_it_is(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def still_running(command: list[str], said: int) -> subprocess.Popen[bytes]:
        """Start what waits to be told to end; it has said how far it is twice."""
        os.write(said, b"1/75\r12/75\r")
        return subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)

    monkeypatch.setattr(rendering, "_start", still_running)
    one = rendering.render(tape, "gif")
    process = one._process
    try:
        assert one.words().endswith("kite-1.gif: 16 %")
    finally:
        process.communicate(b"\n")
        one.close()


def test_a_process_that_cannot_be_started_leaves_nothing_open(
    tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(command: list[str], said: int) -> None:
        raise OSError(11, "Resource temporarily unavailable")

    (here / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(here / "tmp"))
    monkeypatch.setattr(rendering, "_start", refused)
    before = len(list(Path("/proc/self/fd").iterdir())) if Path("/proc/self/fd").exists() else 0
    with pytest.raises(WorkFailed, match="cannot be started: Resource temporarily unavailable"):
        rendering.render(tape, "gif")
    assert list((here / "tmp").iterdir()) == []
    assert before == (len(list(Path("/proc/self/fd").iterdir())) if before else 0)
