"""Find linkages for a stroke or for poses while they are dragged: a process beside the window.

It reads requests from its standard input, a line of JSON each, and writes replies to its standard output. A
new request ends the work on the one before it.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from itertools import chain
from queue import SimpleQueue
from threading import Thread
from typing import NamedTuple, TextIO

from linkanim.errors import LinkanimError
from linkanim.synthesis import guidance
from linkanim.synthesis.answers import NAME, Fit, answer_of
from linkanim.synthesis.atlas import atlas
from linkanim.synthesis.front import cards, cost, first_of, front_of, searched_front, way_along, with_cognates
from linkanim.synthesis.guidance import GuidedLinkage, pose_answer_of
from linkanim.synthesis.linkages import FOUR_BAR
from linkanim.synthesis.path import task_of
from linkanim.synthesis.search import ALIKE, best_fits, glimpsed, refitted

COUNT = 6
"""The number of answers for a stroke."""
_MUCH = math.log(1.5)
"""The least difference in cost for which a better answer replaces the one that is shown."""
_KEPT = 128
"""The number of latest fits that are kept."""


class Follow(NamedTuple):
    """A request for linkages along points (x, y), with fixed pins given or None.

    `near` are the numbers of an answer to start from, if any; without `search` only that one is fitted again.
    """

    stroke: int
    points: Sequence[Sequence[float]]
    closed: bool
    pivots: Sequence[Sequence[float] | None] = ()
    near: Sequence[float] | None = None
    search: bool = True


class FollowPoses(NamedTuple):
    """A request for linkages through poses (x, y, angle in rad), sliding or not, with fixed pins given.

    `near` and `search` are those of a `Follow`. `moved`, if any, is the number of a joint of `near` and its
    wanted x and y in the first pose. `weight` is that of the transmission angle against the size.
    """

    stroke: int
    poses: Sequence[Sequence[float]]
    sliding: bool = False
    pivots: Sequence[Sequence[float]] = ()
    near: Sequence[float] | None = None
    moved: Sequence[float] | None = None
    weight: float | None = None
    search: bool = True


Request = Follow | FollowPoses


def request_from(line: str) -> Request:
    """Return the request in a line of JSON."""
    known = json.loads(line)
    return FollowPoses(**known) if "poses" in known else Follow(**known)


class Reply(NamedTuple):
    """Answers to a request: all their numbers in a row, and which one is shown; or why there is none.

    A reply that is not `whole` is a single answer, which replaces the one that is shown. `way` holds the
    numbers of further answers, from the exact end of the front to the compact end.
    """

    stroke: int
    whole: bool
    numbers: Sequence[float] = ()
    chosen: int = 0
    error: str | None = None
    way: Sequence[float] = ()


class Follower:
    """Answers one request after the other; it keeps the latest fits, to start from them."""

    def __init__(self) -> None:
        self._known: dict[tuple[float, ...], Fit | GuidedLinkage] = {}

    def replies(self, request: Request, pulse: Callable[[], None] = lambda: None) -> Iterator[Reply]:
        """Yield the answer near by or the atlas's best, then all; `pulse` is called meanwhile."""
        try:
            parts = self._fits(request, pulse) if isinstance(request, Follow) else self._guided(request)
            for fits, chosen, way in parts:
                numbers, along = self._kept(fits), self._kept(way)
                yield Reply(request.stroke, chosen is not None, numbers, chosen or 0, way=along)
        except LinkanimError as error:
            yield Reply(request.stroke, whole=True, error=str(error))

    def _kept(self, fits: Sequence[Fit | GuidedLinkage]) -> tuple[float, ...]:
        """Keep answers, and return their numbers in a row."""
        rows = [(answer_of(one) if isinstance(one, Fit) else pose_answer_of(one)).numbers for one in fits]
        self._known |= dict(zip(rows, fits, strict=True))
        self._known = dict(list(self._known.items())[-_KEPT:])
        return tuple(chain(*rows))

    def _fits(
        self, request: Follow, pulse: Callable[[], None]
    ) -> Iterator[tuple[tuple[Fit, ...], int | None, tuple[Fit, ...]]]:
        """Yield answers, the index of the one that is shown, and the way: the answers along the front.

        The index is None where a single answer is fitted again. First come the answers within many limits,
        then these with the most exact ones of all.
        """
        task = task_of(request.points, request.closed, pivots=request.pivots, name=NAME)
        before = self._known.get(tuple(request.near)) if request.near else None
        near = refitted(task, before) if isinstance(before, Fit) else glimpsed(task)
        if near:
            yield (near,), None, ()
        if not request.search:
            return
        shown = near if before else None
        front = searched_front(task, [shown] if shown else [], pulse)
        if front:
            shown = _shown(front, shown)
            row = cards(front, shown, COUNT)
            yield row, row.index(shown), ()
        exact = best_fits(task, 2 * COUNT, pulse, widely=False)
        front = with_cognates(front_of([*front, *exact]), pulse)
        shown = _shown(front, shown)
        row = cards(front, shown, COUNT)
        yield row, row.index(shown), way_along(task, front, pulse)

    def _guided(
        self, request: FollowPoses
    ) -> Iterator[tuple[tuple[GuidedLinkage, ...], int | None, tuple[GuidedLinkage, ...]]]:
        """Yield linkages through poses, and the index of the one that is shown, as `_fits`, without a way."""
        kind = "slider-crank" if request.sliding else "four-bar"
        task = guidance.task_of(request.poses, kind=kind, pivots=request.pivots, name=guidance.POSES_NAME)
        before = self._known.get(tuple(request.near)) if request.near else None
        moved = (int(request.moved[0]), complex(*request.moved[1:])) if request.moved else None
        near = guidance.followed(task, before, moved) if isinstance(before, GuidedLinkage) else None
        if near:
            yield (near,), None, ()
        if not request.search:
            return
        guided = guidance.answers(task, COUNT, request.weight)
        if near is None:
            yield guided, 0, ()
            return
        like = next((n for n, one in enumerate(guided) if guidance.apart(one, near) <= ALIKE), None)
        if like is None:
            guided, like = (near, *guided[: COUNT - 1]), 0
        yield (*guided[:like], near, *guided[like + 1 :]), like, ()


def _shown(front: Sequence[Fit], before: Fit | None) -> Fit:
    """Return the answer to be shown: the one that is shown already, unless another is much better."""
    best = front[first_of([fit.figures for fit in front])]
    if before is None or cost(before.figures) > cost(best.figures) + _MUCH:
        return best
    return next((fit for fit in front if fit.apart(before) <= ALIKE), before)


def lines_of(stream: TextIO) -> SimpleQueue[str | None]:
    """Return a queue of a stream's lines, None at its end, which a thread fills as they come."""
    lines: SimpleQueue[str | None] = SimpleQueue()

    def read() -> None:
        with stream:
            for line in stream:
                lines.put(line)
        lines.put(None)

    Thread(target=read, daemon=True).start()
    return lines


def main() -> None:
    """Answer requests until there are no more; with the argument `paths` prepare for strokes first."""
    requests = lines_of(sys.stdin)
    if "paths" in sys.argv:
        atlas(FOUR_BAR)
    follower, line = Follower(), requests.get()
    while line is not None:
        line = _served(follower, request_from(line), requests)


class _Newer(Exception):
    """Another request has come, or there are no more."""


def _served(follower: Follower, request: Request, requests: SimpleQueue[str | None]) -> str | None:
    """Write the replies to a request until a newer one comes; return the newest one, None at the end."""

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
