"""Linkages for a stroke while it is drawn and dragged: a process beside the window, whose frames keep coming.

It reads requests from its standard input, a line of JSON each, and writes replies to its standard output. A
request that comes while another one is worked on ends that.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from itertools import chain
from queue import SimpleQueue
from threading import Thread
from typing import NamedTuple, TextIO

from linkanim.errors import LinkanimError
from linkanim.synthesis.answers import NAME, Fit, answer_of, cognates_of
from linkanim.synthesis.atlas import atlas
from linkanim.synthesis.linkages import FOUR_BAR
from linkanim.synthesis.path import found, glimpsed, ranked, refitted, task_of

COUNT = 6
"""Answers for a stroke."""
_ALIKE = 0.05
"""Of the stroke's size: answers whose joints are apart by no more look the same."""
_KEPT = 64
"""Fits that are known."""


class Follow(NamedTuple):
    """What is asked: linkages along points (x, y), with fixed pins given or None.

    `near` are the numbers of an answer to go on from, if any; without `search` only that one is fitted again.
    """

    stroke: int
    points: Sequence[Sequence[float]]
    closed: bool
    pivots: Sequence[Sequence[float] | None] = ()
    near: Sequence[float] | None = None
    search: bool = True


class Reply(NamedTuple):
    """Answers to a stroke, the numbers of all of them in a row, which one is shown; or why there is none.

    One that is not `whole` is a single answer, to go in the place of the one that is shown.
    """

    stroke: int
    whole: bool
    numbers: Sequence[float] = ()
    chosen: int = 0
    error: str | None = None


class Follower:
    """Answers one request after the other; it knows the last fits, to go on from them."""

    def __init__(self) -> None:
        self._known: dict[tuple[float, ...], Fit] = {}

    def replies(self, request: Follow, pulse: Callable[[], None] = lambda: None) -> Iterator[Reply]:
        """Yield the answer near by or the atlas's best, then all; `pulse` is called meanwhile."""
        try:
            for fits, chosen in self._fits(request, pulse):
                answers = [answer_of(fit) for fit in fits]
                self._known |= {answer.numbers: fit for answer, fit in zip(answers, fits, strict=True)}
                self._known = dict(list(self._known.items())[-_KEPT:])
                numbers = tuple(number for one in answers for number in one.numbers)
                yield Reply(request.stroke, chosen is not None, numbers, chosen or 0)
        except LinkanimError as error:
            yield Reply(request.stroke, whole=True, error=str(error))

    def _fits(
        self, request: Follow, pulse: Callable[[], None]
    ) -> Iterator[tuple[tuple[Fit, ...], int | None]]:
        """Yield answers and which of them is shown, None where it is only one that is followed."""
        task = task_of(request.points, request.closed, pivots=request.pivots, name=NAME)
        before = self._known.get(tuple(request.near)) if request.near else None
        near = refitted(task, before) if before else glimpsed(task)
        if near:
            yield (near,), None
        if not request.search:
            return
        fits = found(task, 2 * COUNT, lambda *_: pulse(), widely=False)
        if not (before and near):
            yield _row(fits[0], fits), 0
            return
        like = next((fit for fit in fits if fit.apart(near) <= _ALIKE), near)
        row = _row(like, fits)
        yield row, row.index(like)


def _row(shown: Fit, fits: tuple[Fit, ...]) -> tuple[Fit, ...]:
    """Return answers that differ visibly, that which is shown among them, and cognates where they are few."""
    kept = [shown]
    # a cognate has pivots of its own
    parents = () if shown.task.requirements.given else (shown, *fits)
    for fit in chain(fits, *map(cognates_of, parents)):
        if len(kept) == COUNT:
            break
        turns = fit.scene.info.full_turn or not shown.scene.info.full_turn
        if turns and not any(fit.apart(one) <= _ALIKE for one in kept):
            kept.append(fit)
    return tuple(ranked(kept))


def lines_of(stream: TextIO) -> SimpleQueue[str | None]:
    """Return a queue of a stream's lines as they come, None at its end, to be looked into without waiting."""
    lines: SimpleQueue[str | None] = SimpleQueue()

    def read() -> None:
        with stream:
            for line in stream:
                lines.put(line)
        lines.put(None)

    Thread(target=read, daemon=True).start()
    return lines


def main() -> None:
    """Answer requests until there are no more."""
    requests = lines_of(sys.stdin)
    atlas(FOUR_BAR)
    follower, line = Follower(), requests.get()
    while line is not None:
        line = _served(follower, Follow(**json.loads(line)), requests)


class _Newer(Exception):
    """Another request has come, or there are no more."""


def _served(follower: Follower, request: Follow, requests: SimpleQueue[str | None]) -> str | None:
    """Write the replies to a request, until another one comes; return the last that has, None at the end."""

    def pulse() -> None:
        if not requests.empty():
            raise _Newer

    with suppress(_Newer):
        for reply in follower.replies(request, pulse):
            print(json.dumps(reply._asdict()), flush=True)
    line = requests.get()
    while line is not None and not requests.empty():
        line = requests.get()
    return line


if __name__ == "__main__":
    main()
