"""A bar on stderr that says how far long work is."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import NoReturn, TypeVar

from tqdm import tqdm

_SILENT = 2.0
"""Seconds without a bar: what is done by then needs none."""

T = TypeVar("T")


@contextmanager
def bar(*, shown: bool = False, unit: str = " frames") -> Iterator[Callable[[int, int], None]]:
    """Give a function that is told (frames done, frames in all), and draws a bar of it on stderr.

    How many there are in all is 0 where that is not known. Nothing is drawn in the first two seconds, nor
    where stderr is no terminal, unless it is to be `shown` all the same.
    """
    # its watch over slow bars is a thread, and a process with threads is not copied for drawing
    tqdm.monitor_interval = 0
    # tqdm takes None for "not on a terminal"
    disable, delay = (False, 0.0) if shown else (None, _SILENT)
    with tqdm(unit=unit, leave=False, disable=disable, delay=delay, file=sys.stderr) as drawn:
        yield lambda done, total: advance(drawn, done, total)


def advance(drawn: tqdm[NoReturn], done: int, total: int) -> None:
    """Draw a bar at `done` of `total`."""
    drawn.total = total or None
    drawn.update(done - drawn.n)


def along(items: Iterable[T], unit: str, total: int = 0) -> Iterator[T]:
    """Yield items, `total` of them if that is known, and draw a bar of those that were taken."""
    with bar(unit=unit) as progress:
        for number, item in enumerate(items):
            progress(number, total)
            yield item
