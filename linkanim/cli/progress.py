"""A bar on stderr that says how far long work is."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn

from tqdm import tqdm


@contextmanager
def bar(*, shown: bool = False, unit: str = " frames") -> Iterator[Callable[[int, int], None]]:
    """Give a function that is told (frames done, frames in all), and draws a bar of it on stderr.

    Nothing is drawn where stderr is no terminal, unless it is to be `shown` all the same.
    """
    # its watch over slow bars is a thread, and a process with threads is not copied for drawing
    tqdm.monitor_interval = 0
    # tqdm takes None for "not on a terminal"
    with tqdm(unit=unit, leave=False, disable=False if shown else None, file=sys.stderr) as drawn:
        yield lambda done, total: advance(drawn, done, total)


def advance(drawn: tqdm[NoReturn], done: int, total: int) -> None:
    """Draw a bar at `done` of `total`."""
    drawn.total = total
    drawn.update(done - drawn.n)
