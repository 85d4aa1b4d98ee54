"""A clip's frames drawn by several processes: the same, in the same order, whatever becomes of a process."""

from __future__ import annotations

import errno
import os
import select
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from linkanim.picture.look import Look
from linkanim.player.action import Action
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.recorder import processes
from linkanim.recorder import recording as recorder
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.processes import drawing, processes_for
from linkanim.recorder.recording import SceneFrames, write
from linkanim.recorder.tape_frames import TapeFrames
from linkanim.scenes import load

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere one process draws")

SIZE = 16
FRAMES = 9
OURS = os.getpid()
P4K, P8K = 4 * 3840 * 2160, 4 * 7680 * 4320


def numbered(frame: int) -> bytes:
    return bytes([frame]) * SIZE


def drawn(draw: Callable[[int], bytes], number: int) -> list[bytes]:
    with drawing(draw, FRAMES, SIZE, number) as one:
        return [bytes(one(frame)) for frame in range(FRAMES)]


# One is what ours alone is; three do not divide nine evenly over two places each; more than there are frames.
@pytest.mark.parametrize("number", [0, 1, 2, 3, 4, 12])
def test_frames_come_in_their_order_from_any_number_of_processes(number: int) -> None:
    assert drawn(numbered, number) == [numbered(frame) for frame in range(FRAMES)]


def test_frames_are_drawn_by_other_processes() -> None:
    def whose(frame: int) -> bytes:
        return bytes([os.getpid() != OURS]) * SIZE

    assert drawn(whose, 2) == [b"\1" * SIZE] * FRAMES


# At its first frame, in the midst, at the last.
@pytest.mark.parametrize("fatal", [0, 4, 8])
def test_what_a_process_that_was_killed_had_to_draw_is_drawn_all_the_same(fatal: int) -> None:
    def killing(frame: int) -> bytes:
        if frame == fatal and os.getpid() != OURS:
            os.kill(os.getpid(), signal.SIGKILL)
        return numbered(frame)

    assert drawn(killing, 2) == [numbered(frame) for frame in range(FRAMES)]


# No process at all, one and no other, no memory to share.
@pytest.mark.parametrize(("name", "started"), [("_copy", 0), ("_copy", 1), ("mmap", 0), ("mmap", 1)])
def test_where_the_system_starts_none_ours_draws_all(
    name: str, started: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    there, usual, left = os.listdir("/proc/self/fd"), getattr(processes, name), [None] * started  # noqa: PTH208

    def refused(*given: int) -> object:
        if not left:
            raise OSError(errno.EAGAIN, "Resource temporarily unavailable")
        left.pop()
        return usual(*given)

    monkeypatch.setattr(processes, name, refused)
    assert drawn(numbered, 3) == [numbered(frame) for frame in range(FRAMES)]
    assert len(os.listdir("/proc/self/fd")) == len(there)  # noqa: PTH208
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


def test_what_goes_wrong_is_raised_where_the_frame_is_asked_for_and_no_process_stays() -> None:
    def failing(frame: int) -> bytes:
        if frame == 5:
            raise ZeroDivisionError
        return numbered(frame)

    taken: list[bytes] = []
    with pytest.raises(ZeroDivisionError), drawing(failing, FRAMES, SIZE, 2) as one:  # noqa: PT012
        for frame in range(FRAMES):
            taken.append(bytes(one(frame)))
    assert taken == [numbered(frame) for frame in range(5)]
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


ENDLESS = """
import os
from linkanim.recorder.processes import drawing

with drawing(lambda frame: str(os.getpid()).ljust(16).encode(), 1000, 16, 2) as one:
    print(*(bytes(one(frame)).decode().strip() for frame in range(2)), flush=True)
    input()
"""


def test_processes_end_with_the_one_that_they_draw_for_however_it_ends() -> None:
    command = [sys.executable, "-P", "-c", ENDLESS]
    pipe = subprocess.PIPE
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, env=env) as ours:
        assert ours.stdout is not None
        drawers = [os.pidfd_open(int(word)) for word in ours.stdout.readline().split()]
        ours.kill()
        ours.wait()
    for drawer in drawers:
        assert select.select([drawer], [], [], 60.0)[0], "it goes on drawing for nobody"
        os.close(drawer)


CASES = {
    "many cores: no encoder takes more": (64, 75, 4 * 1280 * 720, 4),
    "three cores, one of them the encoder's": (3, 75, 4 * 1280 * 720, 2),
    "two cores: one draws and one encodes": (2, 75, 4 * 1280 * 720, 0),
    "one core": (1, 75, 4 * 1280 * 720, 0),
    "few frames: a copy takes as long": (8, 15, 4 * 1280 * 720, 0),
    "as many as are worth it": (8, 24, 4 * 1280 * 720, 3),
    "4K: as many as memory holds": (8, 75, P4K, 3),
    "8K: ours alone": (8, 75, P8K, 0),
}


@pytest.mark.parametrize(("cores", "frames", "size", "number"), CASES.values(), ids=CASES)
def test_as_many_processes_draw_as_cores_frames_and_memory_allow(
    cores: int, frames: int, size: int, number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(cores)))
    monkeypatch.setattr(processes, "active_count", lambda: 1)
    assert processes_for(frames, size) == number
    monkeypatch.setattr(processes, "active_count", lambda: 2)
    assert processes_for(frames, size) == 0, "its threads would be missing in a copy"


@pytest.mark.thinned(2)
@pytest.mark.parametrize("form", ["gif", "mp4", "png"])
def test_a_recording_has_the_same_bytes_whatever_draws_it(
    form: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = load("press")
    plan = make_plan(Clip(2.0 * scene.period, scene.period, 25.0), "gif")
    made: list[list[bytes]] = []
    for number in (0, 2, 3):
        monkeypatch.setattr(recorder, "processes_for", lambda *_, n=number: n)
        folder = tmp_path / str(number)
        folder.mkdir()
        write(SceneFrames(scene, plan, (64, 36), Look()), plan, folder / f"out.{form}")
        made.append([file.read_bytes() for file in sorted(folder.glob(f"*.{form}"))])
    assert made[0] == made[1] == made[2]


@pytest.mark.slow
def test_a_tape_has_the_same_frames_whatever_draws_them() -> None:
    """Its states follow from one another, so each process goes through all of them and draws its own."""
    actions = {
        2: ("names", None),
        5: ("zoom", (1.0, 0.1, 0.0)),
        8: ("edit", None),
        12: ("move", 1),
        16: ("edit", None),
        20: ("theme", None),
    }
    noted = tuple((frame, Action(*action)) for frame, action in actions.items())
    tape = Tape(begin("crank-rocker"), 45, noted)
    size, frames = (160, 90), 18

    def all_by(number: int) -> list[bytes]:
        draw = TapeFrames(tape, 25.0, size).draw
        with drawing(draw, frames, 4 * size[0] * size[1], number) as one:
            return [bytes(one(frame)) for frame in range(frames)]

    alone = all_by(0)
    assert len({*alone}) > frames - 3, "frames of a motion differ"
    assert all_by(2) == alone
    assert all_by(3) == alone
