"""Whatever goes wrong: no broken file, no process left, and what was there before stays."""

from __future__ import annotations

import errno
import os
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from moving_disc import TWO_SECONDS, MovingDisc, disc

from linkanim.errors import BadInput, RecordingFailed
from linkanim.recorder import encode, recording
from linkanim.recorder.plan import Format
from linkanim.recorder.recording import write

pytestmark = pytest.mark.withstands("faults survived")

FORMS: tuple[Format, ...] = ("gif", "mp4", "png")
BEFORE = b"what was there before"

needs_proc = pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="finds processes through /proc")


@pytest.fixture(params=FORMS)
def form(request: pytest.FixtureRequest) -> Format:
    chosen: Format = request.param
    return chosen


@pytest.fixture
def target(tmp_path: Path, form: Format) -> Path:
    """Return a name in a folder in which earlier recordings of all kinds lie."""
    for name in ("disc.gif", "disc.mp4", "disc.png", "disc-20240101.png", "disc-98765.png", "other-0099.png"):
        (tmp_path / name).write_bytes(BEFORE)
    return tmp_path / f"disc.{form}"


def untouched(folder: Path) -> bool:
    names = {"disc.gif", "disc.mp4", "disc.png", "disc-20240101.png", "disc-98765.png", "other-0099.png"}
    found = {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}
    return found == dict.fromkeys(names, BEFORE) and len(list(folder.iterdir())) == len(names)


def children(pid: int) -> list[int]:
    tasks = Path(f"/proc/{pid}/task").iterdir()
    return [int(child) for task in tasks for child in _children_of_thread(task)]


def _children_of_thread(task: Path) -> list[str]:
    try:
        return (task / "children").read_text().split()
    except (FileNotFoundError, ProcessLookupError):
        # A thread that ended since it was listed has no children any more.
        return []


def gone(pid: int) -> bool:
    """Wait until a process that need not be ours is gone, at most ten seconds."""
    try:
        handle = os.pidfd_open(pid)
    except ProcessLookupError:
        return True
    try:
        return bool(select.select([handle], [], [], 10.0)[0])
    finally:
        os.close(handle)


def at_frame(number: int, act: Callable[[], None], form: Format) -> MovingDisc:
    """Return a disc that acts when a frame is drawn while the encoder runs."""
    plan = disc(form).plan
    drawn: list[int] = []

    def watch(frame: int) -> None:
        drawn.append(frame)
        running = form != "gif" or len(drawn) > 8  # a GIF's palette is sampled first
        if running and frame == number:
            act()

    return MovingDisc(plan, on_draw=watch)


class Stop(BaseException):
    """What a signal's handler raises."""


@needs_proc
@pytest.mark.parametrize(
    ("form", "error"),
    [("gif", KeyboardInterrupt), ("mp4", Stop), ("png", MemoryError), ("mp4", MemoryError)],
    indirect=["form"],
)
def test_whatever_interrupts_leaves_nothing(target: Path, form: Format, error: type[BaseException]) -> None:
    def interrupt() -> None:
        raise error

    frames = at_frame(20, interrupt, form)
    with pytest.raises(error):
        write(frames, frames.plan, target)
    assert untouched(target.parent)
    assert children(os.getpid()) == []


@needs_proc
def test_ctrl_c_as_an_encoder_has_begun_leaves_neither_it_nor_a_thread(
    target: Path, form: Format, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(pipe: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(encode, "_widen", interrupt)
    frames, before = disc(form), threading.enumerate()
    with pytest.raises(KeyboardInterrupt):
        write(frames, frames.plan, target)
    assert threading.enumerate() == before
    assert children(os.getpid()) == []


def test_a_program_that_ends_waits_for_no_thread_of_an_encoder(target: Path, form: Format) -> None:
    """It would wait for ever where Ctrl-C comes before what stops the thread."""
    waited = list[str]()

    def look() -> None:
        main = threading.main_thread()
        waited.extend(one.name for one in threading.enumerate() if one is not main and not one.daemon)

    frames = at_frame(3, look, form)
    write(frames, frames.plan, target)
    assert waited == []


@needs_proc
def test_a_killed_encoder_is_one_line(target: Path, form: Format) -> None:
    def kill() -> None:
        for child in children(os.getpid()):
            os.kill(child, signal.SIGKILL)

    frames = at_frame(3, kill, form)
    with pytest.raises(RecordingFailed, match="SIGKILL") as caught:
        write(frames, frames.plan, target)
    assert "\n" not in str(caught.value)
    assert untouched(target.parent)


def test_an_encoder_that_cannot_be_started_is_one_line(
    target: Path, form: Format, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(encode, "get_ffmpeg_exe", lambda: "/no/such/encoder")
    frames = disc(form)
    message = f"/no/such/encoder cannot be started: {os.strerror(errno.ENOENT)}$"
    with pytest.raises(RecordingFailed, match=message):
        write(frames, frames.plan, target)
    assert untouched(target.parent)


def no_ffmpeg() -> str:
    raise RuntimeError("No ffmpeg exe could be found.")


def test_an_encoder_that_is_not_installed_is_one_line(
    target: Path, form: Format, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(encode, "get_ffmpeg_exe", no_ffmpeg)
    frames = disc(form)
    with pytest.raises(RecordingFailed, match="IMAGEIO_FFMPEG_EXE"):
        write(frames, frames.plan, target)
    assert untouched(target.parent)


# What an encoder may stand still at: it takes no frame, it takes all and never ends, it cannot be read back.
STILL = {
    "taking nothing": "exec sleep 1000",
    "never ending": "cat >/dev/null; sleep 1000",
    "one that it has started": "sleep 1000 & wait",
}


@pytest.mark.skipif(sys.platform == "win32", reason="a script of a Unix shell")
@needs_proc
@pytest.mark.parametrize("name", STILL)
def test_an_encoder_that_stands_still_is_ended_and_said(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    encoder = tmp_path / "encoder"
    encoder.write_text(f"#!/bin/sh\n{STILL[name]}\n")
    encoder.chmod(0o700)
    monkeypatch.setattr(encode, "get_ffmpeg_exe", lambda: str(encoder))
    monkeypatch.setattr(encode, "_STILL", 0.2)
    monkeypatch.setattr(encode, "_PATIENCE", 0.01)
    frames = disc("mp4")
    with pytest.raises(RecordingFailed, match=r"made no progress for 0\.2 s and was ended"):
        write(frames, frames.plan, tmp_path / "disc.mp4")
    assert [path.name for path in tmp_path.iterdir()] == ["encoder"]
    assert children(os.getpid()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="a script of a Unix shell")
def test_a_file_that_cannot_be_read_back_for_ever_is_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(encode, "_STILL", 0.2)
    with pytest.raises(RecordingFailed, match="made no progress"):
        encode.output_of(["sh", "-c", "echo 1; sleep 1000"])
    assert encode.output_of(["sh", "-c", "echo 1"]) == b"1\n"
    assert encode.output_of(["sh", "-c", "echo 1; exit 3"]) == b""


# By a clock that stands, no time goes by, however often it is looked whether the process goes on.
@pytest.mark.skipif(sys.platform == "win32", reason="a script of a Unix shell")
def test_only_time_without_progress_ends_a_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(encode, "_STILL", 0.02)
    monkeypatch.setattr(time, "monotonic", lambda: 1000.0)
    assert encode.output_of(["sh", "-c", "sleep 0.05; echo 1"]) == b"1\n"


def test_missing_frames_are_noticed(target: Path, form: Format, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "count_frames", lambda part, form: encode.count_frames(part, form) - 1)
    frames = disc(form)
    with pytest.raises(RecordingFailed, match="49 of 50 frames"):
        write(frames, frames.plan, target)
    assert untouched(target.parent)


@pytest.mark.parametrize("form", ["gif", "mp4"])
def test_counting_tells_a_truncated_file(tmp_path: Path, form: Format) -> None:
    frames, path = disc(form), tmp_path / f"disc.{form}"
    write(frames, frames.plan, path)
    assert encode.count_frames(path, form) == 50
    whole = path.read_bytes()
    for held in (len(whole) // 2, 20, 8, 0):
        path.write_bytes(whole[:held])
        assert encode.count_frames(path, form) < 50


CHILD = """
import sys
sys.path[:0] = sys.argv[3:]
from moving_disc import disc, TWO_SECONDS
from linkanim.errors import RecordingFailed
from linkanim.recorder.recording import write

def started(done, total):
    if done == 10:
        print("running", flush=True)

frames = disc(sys.argv[2], TWO_SECONDS._replace(periods={periods}), size=(160, 120))
{before}
try:
    write(frames, frames.plan, sys.argv[1], started)
except RecordingFailed as error:
    sys.exit(str(error))
"""


@pytest.fixture
def child(target: Path, form: Format) -> Iterator[subprocess.Popen[str]]:
    with start(target, form) as process:
        yield process
        process.kill()


def start(target: Path, form: Format, before: str = "", periods: int = 300) -> subprocess.Popen[str]:
    here = Path(__file__).parent
    places = [str(here), str(here.parents[1])]
    command = [sys.executable, "-c", CHILD.format(before=before, periods=periods), str(target), form, *places]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def running(process: subprocess.Popen[str]) -> int:
    """Wait until frames are being encoded; return the encoder's process id."""
    assert process.stdout is not None
    assert process.stdout.readline() == "running\n"
    (encoder,) = children(process.pid)
    return encoder


# In a process of its own: a file and numbered files; an MP4 is one file as a GIF is.
one_of_each = pytest.mark.parametrize(
    "form", ["gif", "png", pytest.param("mp4", marks=pytest.mark.long)], indirect=True
)


@one_of_each
@needs_proc
def test_ctrl_c_leaves_nothing(child: subprocess.Popen[str], target: Path) -> None:
    encoder = running(child)
    child.send_signal(signal.SIGINT)
    child.communicate()
    assert gone(encoder)
    assert untouched(target.parent)


@one_of_each
@needs_proc
@pytest.mark.slow
def test_a_killed_run_leaves_no_process_and_the_next_one_clears_up(
    child: subprocess.Popen[str], target: Path, form: Format
) -> None:
    encoder = running(child)
    child.kill()
    child.communicate()
    assert gone(encoder)
    assert target.read_bytes() == BEFORE
    assert [path for path in target.parent.iterdir() if path.name.startswith(".linkanim-")]
    frames = disc("gif")
    write(frames, frames.plan, target.with_name("next.gif"))
    target.with_name("next.gif").unlink()
    assert untouched(target.parent)


FULL = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (MOST, MOST))"


@one_of_each
@needs_proc
@pytest.mark.slow
def test_a_full_disk_is_one_line(target: Path, form: Format) -> None:
    limit = "300" if form == "png" else "5000"
    with start(target, form, FULL.replace("MOST", limit), periods=3) as process:
        _, message = process.communicate()
    assert process.returncode == 1
    assert len(message.splitlines()) == 1
    assert "encoder" in message
    assert untouched(target.parent)


def test_a_folder_that_takes_no_files_is_one_line(tmp_path: Path, form: Format) -> None:
    folder = Path("/proc/self") if os.geteuid() == 0 else tmp_path
    tmp_path.chmod(0o500)
    frames = disc(form)
    try:
        with pytest.raises(RecordingFailed, match="disc"):
            write(frames, frames.plan, folder / f"disc.{form}")
    finally:
        tmp_path.chmod(0o700)


# (what is asked for, relative to a folder with a folder `there.gif` in it; what the sentence names)
REFUSED = [
    ("there.gif", "is a folder"),
    ("", "is a folder"),
    ("absent/disc.gif", "no folder"),
    ("there.gif/deeper/disc.gif", "no folder"),
    ("file.txt/disc.gif", "no folder"),
    ("disc", "ending"),
    ("disc.jpeg", "ending"),
    (".gif", "ending"),
]


@pytest.mark.parametrize(("wrong", "named"), REFUSED)
def test_paths_that_cannot_be_are_refused_before_any_work(tmp_path: Path, wrong: str, named: str) -> None:
    (tmp_path / "there.gif").mkdir()
    (tmp_path / "file.txt").touch()
    frames = at_frame(0, pytest.fail, "mp4")
    with pytest.raises(BadInput, match=named):
        write(frames, frames.plan, tmp_path / wrong)
    assert {path.name for path in tmp_path.iterdir()} == {"there.gif", "file.txt"}


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_older_higher_numbered_frames_of_ours_go_and_others_stay(tmp_path: Path) -> None:
    kept = [
        "disc-99.png",
        "disc-0001.gif",
        "disc2-0001.png",
        "disc-0099.png",
        "disc-20240101.png",
        "disc.png",
    ]
    for name in kept:
        (tmp_path / name).write_bytes(BEFORE)
    for seconds in (2.0, 0.2):
        frames = disc("png", TWO_SECONDS._replace(seconds=seconds))
        write(frames, frames.plan, tmp_path / "disc.png")
    made = [f"disc-{k:04d}.png" for k in range(1, 6)]
    found = contents(tmp_path)
    assert found.keys() == {*made, *kept, ".linkanim-disc.png.json"}
    assert {found[name] for name in kept} == {BEFORE}


@pytest.mark.parametrize("taken", ["disc-0001.png", "disc-0050.png"])
def test_a_frame_s_name_that_is_another_s_is_refused_before_any_work(tmp_path: Path, taken: str) -> None:
    for name in (taken, "disc-20240101.png"):
        (tmp_path / name).write_bytes(BEFORE)
    frames = at_frame(0, pytest.fail, "png")
    with pytest.raises(BadInput, match=rf"{taken} may not be linkanim's own.*choose another name"):
        write(frames, frames.plan, tmp_path / "disc.png")
    assert contents(tmp_path) == {taken: BEFORE, "disc-20240101.png": BEFORE}


def test_numbered_frames_that_cannot_all_move_do_not_move_at_all(tmp_path: Path) -> None:
    frames = disc("png")
    write(frames, frames.plan, tmp_path / "disc.png")
    (tmp_path / "disc-0030.png").unlink()
    (tmp_path / "disc-0030.png").mkdir()
    before = contents(tmp_path)
    with pytest.raises(BadInput, match=r"disc-0030\.png is a folder"):
        write(frames, frames.plan, tmp_path / "disc.png")
    assert contents(tmp_path) == before


def test_a_clip_of_one_frame_is_written(tmp_path: Path, form: Format) -> None:
    frames = disc(form, TWO_SECONDS._replace(seconds=0.04))
    assert write(frames, frames.plan, tmp_path / f"disc.{form}").frames == 1
