"""An encoder as a process: fed through a pipe, listened to, and gone when the work is over."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from threading import Semaphore, Thread
from typing import IO

from linkanim.errors import RecordingFailed

if sys.platform == "linux":
    import fcntl

Frame = bytes | bytearray | memoryview
"""A frame's bytes, row by row: blue, green, red, and alpha or one that means nothing."""

_PATIENCE = 0.5
"""Seconds after which an encoder that tells of no frame gets one more all the same."""
_LAST_WORDS = 8
_WIDTH = 1 << 20
_ROOM = 100
"""Frames that an encoder gets once it is gone: one finds it out; each further one costs threading time."""


class _GoneError(Exception):
    """The encoder does not read any more; its last lines and its exit code tell why."""


@contextmanager
def running(command: Sequence[str], *, ahead: int) -> Iterator[Callable[[Frame], None]]:
    """Run the encoder and give the function that writes to it, not too far ahead of what is encoded.

    It tells of each frame that it is done with by a line on stdout, and gets no more than `ahead` of
    them; so its memory is the same for few frames and for many. When the block ends well, the encoder
    has; else it is gone.
    `RecordingFailed` where it cannot be started, stops early or reports an error.
    """
    process = _started(command)
    room = Semaphore(ahead)
    words: deque[bytes] = deque(maxlen=_LAST_WORDS)
    frames, stdout, stderr = _pipes(process)
    _widen(frames)
    listeners = (
        Thread(target=_making_room, args=(stdout, room)),
        Thread(target=words.extend, args=(stderr,)),
    )

    def write(frame: Frame) -> None:
        room.acquire(timeout=_PATIENCE)
        try:
            frames.write(frame)
        except BrokenPipeError as error:
            raise _GoneError from error

    try:
        for listener in listeners:
            listener.start()
        with suppress(_GoneError):
            yield write
        with suppress(BrokenPipeError):
            frames.close()
        process.wait()
    finally:
        _stop(process, listeners)
    _refuse_failure(process.returncode, words)


def _started(command: Sequence[str]) -> subprocess.Popen[bytes]:
    """Start the encoder in a session of its own: Ctrl-C in the terminal is for us, and we stop it."""
    pipe = subprocess.PIPE
    try:
        return subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, start_new_session=True)
    except OSError as error:
        raise not_started(command, error) from error


def not_started(command: Sequence[str], error: OSError) -> RecordingFailed:
    """Return what to raise where an encoder cannot be started."""
    return RecordingFailed(f"the encoder {command[0]} cannot be started: {error.strerror or error}")


def _pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes], IO[bytes]]:
    """Return the encoder's stdin, stdout and stderr."""
    if process.stdin is None or process.stdout is None or process.stderr is None:
        raise RecordingFailed("the encoder has no pipes")
    return process.stdin, process.stdout, process.stderr


def _widen(pipe: IO[bytes]) -> None:
    """Have a pipe hold more than its 64 kB where it can: a frame of megabytes then goes over in few turns."""
    if sys.platform == "linux":
        with suppress(OSError):
            fcntl.fcntl(pipe.fileno(), fcntl.F_SETPIPE_SZ, _WIDTH)


def _making_room(stdout: IO[bytes], room: Semaphore) -> None:
    for _ in stdout:
        room.release()
    room.release(_ROOM)  # the encoder is gone: whoever waits is to find out


def _refuse_failure(code: int, words: Iterable[bytes]) -> None:
    """Raise `RecordingFailed` with the encoder's last words where it did not end well."""
    if code == 0:
        return
    lines = [line.decode(errors="replace").strip() for line in words]
    reason = "".join(": " + re.sub(r"^\[.*?\] ", "", line) for line in lines[-1:])
    how = f"was stopped by {_signal_name(-code)}" if code < 0 else "gave up"
    raise RecordingFailed(f"the encoder {how}{reason or f' with code {code}' * (code > 0)}")


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _stop(process: subprocess.Popen[bytes], listeners: Iterable[Thread]) -> None:
    """Leave no process and no thread behind, however the work ended."""
    process.kill()
    process.wait()
    for listener in listeners:
        if listener.is_alive():
            listener.join()
    for pipe in _pipes(process):
        with suppress(OSError):
            pipe.close()
