"""An encoder as a process: fed through a pipe, listened to, and gone when the work is over."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from threading import Event, Semaphore, Thread
from typing import IO

from linkanim.errors import RecordingFailed

if sys.platform == "linux":
    import fcntl

Frame = bytes | bytearray | memoryview
"""A frame's bytes, row by row: blue, green, red, and alpha or one that means nothing."""

_PATIENCE = 0.5
"""Seconds after which an encoder that tells of no frame gets one more all the same."""
_STILL = 60.0
"""Seconds after which an encoder that takes nothing and tells of nothing is ended."""
_LAST_WORDS = 8
_WIDTH = 1 << 20
_ROOM = 100
"""Frames that an encoder gets once it is gone: one finds it out; each further one costs threading time."""


class _GoneError(Exception):
    """The encoder does not read any more; its last lines and its exit code tell why."""


class _Watch:
    """Ends a process that is waited for and gives no sign of progress for `_STILL` seconds."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self._process, self._over = process, Event()
        self._since: float | None = None
        self._thread = Thread(target=self._look)
        self._thread.start()
        self.ended = False

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Count the time of the block as time in which there should be progress."""
        self._since = time.monotonic()
        try:
            yield
        finally:
            self._since = None

    def heard(self) -> None:
        """Begin to count anew: there is progress."""
        if self._since is not None:
            self._since = time.monotonic()

    def stop(self) -> None:
        """Watch no longer."""
        self._over.set()
        self._thread.join()

    def refuse_stillness(self) -> None:
        """Raise `RecordingFailed` where the process was ended for its stillness."""
        if self.ended:
            raise RecordingFailed(f"the encoder made no progress for {_STILL:g} s and was ended")

    def _look(self) -> None:
        while not self._over.wait(_STILL / 20):
            since = self._since
            if since is not None and time.monotonic() - since > _STILL:
                self.ended = True
                _kill(self._process)
                return


@contextmanager
def running(command: Sequence[str], *, ahead: int) -> Iterator[Callable[[Frame], None]]:
    """Run the encoder and give the function that writes to it, not too far ahead of what is encoded.

    It tells of each frame that it is done with by a line on stdout, and gets no more than `ahead` of
    them; so its memory is the same for few frames and for many. When the block ends well, the encoder
    has; else it is gone.
    `RecordingFailed` where it cannot be started, stops early, stands still or reports an error.
    """
    process = _started(command)
    watch = _Watch(process)
    room = Semaphore(ahead)
    words: deque[bytes] = deque(maxlen=_LAST_WORDS)
    frames, stdout, stderr = _pipes(process)
    _widen(frames)
    listeners = (
        Thread(target=_making_room, args=(stdout, room, watch)),
        Thread(target=words.extend, args=(stderr,)),
    )

    def write(frame: Frame) -> None:
        room.acquire(timeout=_PATIENCE)
        try:
            with watch.waiting():
                frames.write(frame)
        except BrokenPipeError as error:
            raise _GoneError from error

    try:
        for listener in listeners:
            listener.start()
        with suppress(_GoneError):
            yield write
        with watch.waiting():
            with suppress(BrokenPipeError):
                frames.close()
            process.wait()
    finally:
        watch.stop()
        _stop(process, listeners)
    watch.refuse_stillness()
    _refuse_failure(process.returncode, words)


def told(command: Sequence[str]) -> bytes:
    """Return what a command prints; nothing where it does not end well.

    `RecordingFailed` where it cannot be started or stands still.
    """
    process = _started(command)
    watch = _Watch(process)
    frames, stdout, stderr = _pipes(process)
    listener = Thread(target=stderr.read)
    lines = []
    try:
        listener.start()
        frames.close()
        with watch.waiting():
            for line in stdout:
                watch.heard()
                lines.append(line)
            process.wait()
    finally:
        watch.stop()
        _stop(process, [listener])
    watch.refuse_stillness()
    return b"".join(lines) if process.returncode == 0 else b""


def _started(command: Sequence[str]) -> subprocess.Popen[bytes]:
    """Start the encoder in a session of its own: Ctrl-C in the terminal is for us, and we stop it."""
    pipe = subprocess.PIPE
    try:
        return subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, start_new_session=True)
    except OSError as error:
        why = error.strerror or error
        raise RecordingFailed(f"the encoder {command[0]} cannot be started: {why}") from error


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


def _making_room(stdout: IO[bytes], room: Semaphore, watch: _Watch) -> None:
    for _ in stdout:
        room.release()
        watch.heard()
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


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a process and what it has started, which would keep its pipes open."""
    if sys.platform != "win32":
        if process.returncode is None:  # else its number may be another's by now
            with suppress(OSError):
                os.killpg(process.pid, signal.SIGKILL)
    process.kill()


def _stop(process: subprocess.Popen[bytes], listeners: Iterable[Thread]) -> None:
    """Leave no process and no thread behind, however the work ended."""
    _kill(process)
    process.wait()
    for listener in listeners:
        if listener.is_alive():
            listener.join()
    for pipe in _pipes(process):
        with suppress(OSError):
            pipe.close()
