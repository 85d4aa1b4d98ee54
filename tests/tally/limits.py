"""Limits of processor time and memory that the system itself holds a piece of work to.

A case that never ends is stopped, and one that asks for too much memory is refused it: nothing is
measured with a watch, and what else runs on the machine does not count.
"""

from __future__ import annotations

import re
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

if sys.platform == "linux":
    import resource

_PROC = Path("/proc/self")
_ADDRESSES = 4
"""Times the memory as address space: threads and what we start, an encoder, take more of it than they use."""


class TooLongError(Exception):
    """The work took more processor time than it may."""


class Limits:
    """Holds one piece of work after the other to its limits, and keeps the most that any took.

    `most_seconds` is processor time of this process; `most_mb` what its resident memory rose by at the
    highest, 0 where the system does not tell.
    """

    def __init__(self, seconds: float, megabytes: int) -> None:
        self._seconds, self._megabytes = seconds, megabytes
        self.most_seconds, self.most_mb = 0.0, 0.0

    @contextmanager
    def held(self) -> Iterator[None]:
        """Hold the block to the limits: `TooLongError`, or `MemoryError` at once or at its end."""
        before, begun = _peak_mb(), time.process_time()
        with _alarm(self._seconds) as rung, _room(_ADDRESSES * self._megabytes):
            yield
        spent = time.process_time() - begun
        self.most_seconds = max(self.most_seconds, spent)
        more = _peak_mb(reset=False) - before
        self.most_mb = max(self.most_mb, more)
        if more > self._megabytes:
            raise MemoryError(f"{more:.0f} MB")
        if rung:  # and the alarm was swallowed
            raise TooLongError(f"{spent:.2f} s of processor time")


@contextmanager
def _alarm(seconds: float) -> Iterator[list[int]]:
    """Raise TooLongError once the block has had so much processor time; never where that cannot be.

    Gives a list that is not empty once it has been raised.
    """
    rung: list[int] = []
    if not hasattr(signal, "setitimer"):
        yield rung
        return

    def ring(number: int, frame: object) -> None:
        rung.append(number)
        raise TooLongError(f"more than {seconds} s of processor time")

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds, seconds)  # and again, where the work went on all the same
    try:
        yield rung
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


@contextmanager
def _room(megabytes: int) -> Iterator[None]:
    """Refuse the block more address space than this beside what the process has now; on Linux only."""
    if sys.platform != "linux":
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    pages = int((_PROC / "statm").read_text().split()[0])
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + megabytes * 1_000_000, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def _peak_mb(*, reset: bool = True) -> float:
    """Return the highest resident memory since the last reset; 0 where the system does not tell."""
    with suppress(OSError):
        if reset:
            (_PROC / "clear_refs").write_text("5")
        found = re.search(r"VmHWM:\s*(\d+) kB", (_PROC / "status").read_text())
        return int(found[1]) * 1024 / 1e6 if found else 0.0
    return 0.0
