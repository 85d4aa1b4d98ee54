"""The search for linkages along a stroke: a process beside the window, and what it replies as actions."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from contextlib import suppress
from typing import TextIO, cast

from linkanim import child
from linkanim.player.state.action import Action
from linkanim.player.state.sketch import PIVOTS, Sketch
from linkanim.scenes.scene import Scene
from linkanim.synthesis.follower import Follow, Reply, lines_of


def request_of(sketch: Sketch, *, search: bool) -> Follow | None:
    """Return what is asked for a sketch; None where there is no stroke."""
    curve, answer, held = sketch.curve, sketch.answer, dict(sketch.pivots)
    if curve is None:
        return None
    near = None if answer is None or isinstance(answer, Scene) else answer.numbers
    points = [(float(point.real), float(point.imag)) for point in curve.points]
    pivots = [held.get(pivot) for pivot in PIVOTS]
    return Follow(sketch.strokes, points, curve.closed, pivots, near, search)


def action_of(reply: Reply, sketch: Sketch | None) -> Action | None:
    """Return what a reply does; None where it is to another stroke."""
    if sketch is None or reply.stroke != sketch.strokes:
        return None
    if reply.error:
        return Action("note", reply.error)
    if not reply.whole:
        return Action("follow", tuple(reply.numbers))
    return Action("answers", (float(reply.chosen), *reply.numbers))


class Following:
    """The process, from the first time that the pencil is taken; it ends with the window."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            child.module("linkanim.synthesis.follower"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**child.env(), **child.ONE_CORE},
            start_new_session=True,
            text=True,
            encoding="utf-8",
        )
        assert self._process.stdout
        self._lines = lines_of(cast(TextIO, self._process.stdout))

    def ask(self, request: Follow) -> None:
        """Send a request; where the process is gone, that is seen by its replies."""
        assert self._process.stdin
        with suppress(OSError):
            print(json.dumps(request._asdict()), file=self._process.stdin, flush=True)

    def replies(self) -> Iterator[Reply]:
        """Yield what has come since the last time."""
        while not self._lines.empty() and (reply := self.wait()):
            yield reply

    def wait(self) -> Reply | None:
        """Return the next reply once it is there; None where the process has ended."""
        line = self._lines.get()
        return Reply(**json.loads(line)) if line else None

    @property
    def is_over(self) -> bool:
        """Whether the process has ended."""
        return self._process.poll() is not None

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin
        self._process.kill()
        with suppress(OSError):
            self._process.stdin.close()
        self._process.wait()
