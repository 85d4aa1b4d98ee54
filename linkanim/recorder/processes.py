"""A clip's frames drawn by several processes, in the clip's order: the same bytes, whoever draws them.

Each process is a copy of ours, by `fork`, so that it begins with all that has been worked out and nothing
has to be sent to it. It draws every n-th frame, and codes it for the encoder, into memory that it shares with
us, a few frames ahead, and ends as soon as we do. With two cores it would gain nothing: one draws, the other
encodes. What one of them cannot draw we draw ourselves: so an error is raised here, and a
process that the system ends for its memory costs time alone.
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
"""Processes: so many draw faster than any encoder takes frames."""
_AHEAD = 2
"""Frames that a process has ready at most."""
_FEWEST = 8
"""Frames that are worth a process."""
_ROOM = 400_000_000
"""Bytes that all of them may take for frames."""
_DONE = b"."


def processes_for(frames: int, size: int) -> int:
    """Return how many processes draw the frames, of `size` bytes each; 0 where this process draws them.

    Only Linux copies a process in which libraries have been at work; and a copy has none of our threads, but
    what they hold is held for ever.
    """
    if sys.platform != "linux" or active_count() > 1:
        return 0
    # those ready, the one that is drawn, and what stands still in it
    fitting = _ROOM // (size * (_AHEAD + 2))
    cores = len(os.sched_getaffinity(0)) - 1  # the encoder has one
    number = min(cores, MOST, frames // _FEWEST, fitting)
    return number if number > 1 else 0


@contextmanager
def drawing(
    draw: Callable[[int], Frame], frames: int, size: int, processes: int
) -> Iterator[Callable[[int], Frame]]:
    """Give a function like `draw`, to be called for the frames 0, 1, 2, ... in turn, that shares the work.

    A frame's bytes, `size` of them, have to be let go before the next is asked for. When the block ends,
    however it does, the processes are gone. Where the system starts none it is `draw` itself.
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
    """A process that draws some of the frames, and our end of what we share with it."""

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
                os._exit(0)  # nothing of ours is to be cleared away or written by a copy
        os.close(ready)
        os.close(room)

    @property
    def _ends(self) -> tuple[int, int]:
        return self._ready, self._room

    def _work(self, numbers: range, ready: int, room: int) -> None:
        """Draw frames, in the process itself, as long as there is room for them and somebody takes them."""
        for turn, number in enumerate(numbers):
            if turn >= _AHEAD and not os.read(room, 1):
                return
            self._place(turn)[:] = self._draw(number)
            os.write(ready, _DONE)

    def _place(self, turn: int) -> memoryview:
        begin = turn % _AHEAD * self._size
        return self._memory[begin : begin + self._size]

    def frame(self, number: int) -> Frame:
        """Return the next frame of this process, drawn here where that gave up."""
        turn, self._taken = self._taken, self._taken + 1
        if turn:
            with suppress(BrokenPipeError):  # the place of the one before is free
                os.write(self._room, _DONE)
        return self._place(turn) if os.read(self._ready, 1) else self._draw(number)

    def end(self) -> None:
        """End the process: it has nothing that others need."""
        for end in self._ends:
            os.close(end)
        with suppress(ProcessLookupError):
            os.kill(self._process, signal.SIGKILL)
        os.waitpid(self._process, 0)


def _copy() -> int:
    """Fork: return 0 in the copy, its number in ours; OSError where the system copies no process."""
    if sys.platform != "win32":
        with warnings.catch_warnings():
            # of numpy's threads, which it stops and starts anew itself
            warnings.simplefilter("ignore", DeprecationWarning)
            return os.fork()
    raise OSError("no process is copied here")


def _end_with_parent(*ends: int) -> None:
    """Leave Ctrl-C to the process copied, and let go of its ends of pipes: each has to see the other go."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    for end in ends:
        os.close(end)
