"""Times of many pieces of work, taken in turn, so that a busy machine slows all of them alike.

What counts is the processor's time: all of the work is done in one thread, and what other processes
take from it is not its own.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from statistics import median
from typing import TypeVar

from linkanim.bench.entries import Timed

Key = TypeVar("Key")

ROUNDS = 21
FEWEST = 3
LEAST_SECONDS = 0.02
"""A timing repeats short work until it is at least as long."""


def nanoseconds(
    work: Mapping[Key, Timed],
    *,
    rounds: int = ROUNDS,
    budget: float = math.inf,
    clock: Callable[[], float] = time.process_time,
    wall: Callable[[], float] = time.perf_counter,
    progress: Callable[[int, int], None] | None = None,
) -> dict[Key, float]:
    """Return the median time of each piece of work in ns a pose.

    Each is run before, to see how often it must be repeated; then, `rounds` times, all of them in
    turn: fewer where `budget` seconds are over by the `wall`'s clock, but three. `progress` is told
    (rounds done, rounds in all).
    """
    repeats = {key: _repeats(timed, clock) for key, timed in work.items()}
    taken: dict[Key, list[float]] = {key: [] for key in work}
    start = wall()
    for done in range(rounds):
        if done >= FEWEST and wall() - start > budget:
            break
        for key, timed in work.items():
            taken[key].append(_seconds(timed, repeats[key], clock) / (timed.poses * repeats[key]))
        if progress is not None:
            progress(done + 1, rounds)
    return {key: median(times) * 1e9 for key, times in taken.items()}


def _repeats(timed: Timed, clock: Callable[[], float]) -> int:
    once = _seconds(timed, 1, clock)
    return max(round(LEAST_SECONDS / once), 1) if once > 0 else 1


def _seconds(timed: Timed, repeats: int, clock: Callable[[], float]) -> float:
    """Return the time of the repeats; the first is run once more before, and not timed.

    Memory that lay idle between rounds may have gone back to the machine below a virtual one, and
    what it takes to get it again is not the work's own.
    """
    timed.work()
    start = clock()
    for _ in range(repeats):
        timed.work()
    return clock() - start
