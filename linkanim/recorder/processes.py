"""A clip's frames drawn by several processes, in the clip's order, with the same bytes as by one.

Each process is a copy of ours, by `fork`, so that it begins with all that has been worked out and nothing has
to be sent to it. It draws every n-th frame, and codes it for the encoder, into memory that it shares with us,
a few frames ahead, and ends as soon as we do. Two cores would gain nothing: one draws, the other encodes. A
frame that a process cannot draw is drawn here: so an error is raised here, and a process that the system ends
for lack of memory costs only time.
"""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from mmap import mmap
from threading import active_count

from linkanim.recorder.encode import Frame

MOST = 4
"""The most processes: these draw faster than any encoder takes frames."""
_AHEAD = 2
"""The most frames that a process has ready."""
_FEWEST = 8
"""The fewest frames for each process."""
_ROOM = 400_000_000
"""The most bytes that all processes take for frames."""
_DONE = b"."


def processes_for(frames: int, size: int) -> int:
    """Return how many processes draw the frames, of `size` bytes each; 0 where this process draws them.

    Only Linux safely copies a process in which libraries have run. A process with other threads is not
    copied: the copy would lack them, and locks that they hold would never be released.
    """
    if sys.platform != "linux" or active_count() > 1:
        return 0
    # the frames that are ready, the one being drawn, and the static parts of the picture
    fitting = _ROOM // (size * (_AHEAD + 2))
    cores = len(os.sched_getaffinity(0)) - 1  # the encoder has one
    number = min(cores, MOST, frames // _FEWEST, fitting)
    return number if number > 1 else 0


@contextmanager
def drawing(
    draw: Callable[[int], Frame], frames: int, size: int, processes: int
) -> Iterator[Callable[[int], Frame]]:
    """Give a function like `draw`, to be called for the frames 0, 1, 2, ... in turn, that shares the work.

    A frame's bytes, `size` of them, must not be used after the next call. When the block ends, also by an
    exception, the processes are ended. Without processes, or where the system starts none, it is `draw`
    itself.
    """
    if not processes:
        yield draw
        return
    with ExitStack() as gone:
        drawers: list[_Drawer] = []
        try:
            for number in range(processes):
                drawers.append(_Drawer(draw, range(number, frames, processes), size, drawers))
                gone.callback(drawers[-1].end)
        except OSError:  # no more processes, or no memory to share
            gone.close()
            drawers.clear()
        yield (lambda frame: drawers[frame % processes].frame(frame)) if drawers else draw


class _Drawer:
    """A process that draws some of the frames, and our end of the memory and pipes shared with it."""

    def __init__(
        self, draw: Callable[[int], Frame], numbers: range, size: int, others: list[_Drawer]
    ) -> None:
        self._draw, self._size, self._taken = draw, size, 0
        self._memory = memoryview(mmap(-1, _AHEAD * size))
        self._ready, ready = os.pipe()
        room, self._room = os.pipe()
        try:
            self._process = _copy()
        except OSError:
            for end in (self._ready, ready, room, self._room):
                os.close(end)
            raise
        if not self._process:
            try:
                _end_with_parent(self._ready, self._room, *(end for other in others for end in other._ends))
                self._work(numbers, ready, room)
            finally:
                os._exit(0)  # a copy must not clean up or flush anything of ours
        os.close(ready)
        os.close(room)

    @property
    def _ends(self) -> tuple[int, int]:
        return self._ready, self._room

    def _work(self, numbers: range, ready: int, room: int) -> None:
        """Draw frames, in the process itself, while there is room for them and somebody takes them."""
        for turn, number in enumerate(numbers):
            if turn >= _AHEAD and not os.read(room, 1):
                return
            self._place(turn)[:] = self._draw(number)
            os.write(ready, _DONE)

    def _place(self, turn: int) -> memoryview:
        begin = turn % _AHEAD * self._size
        return self._memory[begin : begin + self._size]

    def frame(self, number: int) -> Frame:
        """Return the next frame of this process, drawn here if that process gave up."""
        turn, self._taken = self._taken, self._taken + 1
        if turn:
            with suppress(BrokenPipeError):  # the place of the frame before is free
                os.write(self._room, _DONE)
        return self._place(turn) if os.read(self._ready, 1) else self._draw(number)

    def end(self) -> None:
        """End the process."""
        for end in self._ends:
            os.close(end)
        with suppress(ProcessLookupError):
            os.kill(self._process, signal.SIGKILL)
        os.waitpid(self._process, 0)


def _copy() -> int:
    """Fork: return 0 in the copy, the copy's id in this process; OSError where the system cannot copy one."""
    if sys.platform != "win32":
        with warnings.catch_warnings():
            # the warning is about numpy's threads, which numpy itself stops and starts anew
            warnings.simplefilter("ignore", DeprecationWarning)
            return os.fork()
    raise OSError("no process is copied here")


def _end_with_parent(*ends: int) -> None:
    """Leave Ctrl-C to the parent, and close the parent's ends of pipes: each side must see the other end."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    for end in ends:
        os.close(end)
