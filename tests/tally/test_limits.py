"""What is held to limits is stopped at them, and told what it took."""

from __future__ import annotations

import signal
import sys
from contextlib import suppress
from mmap import mmap

import pytest
from limits import Limits, TooLongError

linux = pytest.mark.skipif(sys.platform != "linux", reason="the limits are Linux's")


def forever() -> None:
    while True:
        pass


@linux
def test_what_never_ends_is_stopped() -> None:
    before = signal.getsignal(signal.SIGPROF)
    with pytest.raises(TooLongError, match=r"^more than 0\.05 s"), Limits(0.05, 100).held():
        forever()
    assert signal.getsignal(signal.SIGPROF) is before
    assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)


@linux
def test_what_swallows_the_alarm_is_found_out() -> None:
    limits = Limits(0.05, 100)
    with pytest.raises(TooLongError, match=r"^\d\.\d\d s"), limits.held(), suppress(TooLongError):
        forever()
    assert limits.most_seconds > 0


@linux
def test_memory_beyond_the_limit_is_refused_and_there_again_after() -> None:
    # So much that no memory which the process has left over from earlier would do.
    with pytest.raises(MemoryError), Limits(1.0, 50).held():
        bytearray(1_000_000_000)
    assert len(bytearray(60_000_000)) == 60_000_000


@linux
@pytest.mark.parametrize("size", [70_000_000, 1_000_000_000])
def test_memory_in_use_counts_not_what_could_be(size: int) -> None:
    limits = Limits(1.0, 50)
    with limits.held(), mmap(-1, 70_000_000) as untouched:
        assert len(untouched) == 70_000_000
    with pytest.raises(MemoryError), limits.held():
        assert len(b"x" * size) == size


@linux
def test_the_most_of_all_is_kept() -> None:
    limits = Limits(1.0, 400)
    for size in (1_000_000, 200_000_000, 2_000_000):
        with limits.held():
            sum(bytearray(size)[:: size // 1000])
    assert 190 < limits.most_mb < 220
    assert 0 < limits.most_seconds < 1
