"""A scene that several threads solve at once: each gets what it would get alone."""

from __future__ import annotations

import sys
import threading
from itertools import count
from types import CodeType, FrameType
from typing import Any

import numpy as np
import pytest

from linkanim.mechanics import motion, program
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

PLACES = np.linspace(0.0, 6.0, 300)
HOMES = {motion.__file__, program.__file__}


NUMBER = count(1)


def fresh() -> Scene:
    """Return a four-bar that differs from all before it by a pin that nothing hangs on."""
    bars = {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80}
    return scene_from({"four-bar": bars, "ground": {"Z": [next(NUMBER), 0]}}, name="x", where="x")


def solved(scene: Scene, *, by: str = "phase", acceleration: float = 0.0) -> Any:
    found = scene.solve(**{by: PLACES}, speed=2.0, acceleration=acceleration)  # type: ignore[arg-type]
    return [found.velocity["B"].tobytes(), found.angular_acceleration["rocker"].tobytes()]


class Between:
    """Has another solve done between two steps of the one that is traced: the nth of those that differ."""

    def __init__(self, scene: Scene, nth: int) -> None:
        self.scene, self.nth, self.seen, self.other = scene, nth, set[tuple[CodeType, int]](), list[Any]()

    def __call__(self, frame: FrameType, event: str, arg: object) -> Any:
        if frame.f_code.co_filename not in HOMES:
            return None
        frame.f_trace_opcodes = True
        if event == "opcode" and (place := (frame.f_code, frame.f_lasti)) not in self.seen:
            self.seen.add(place)
            if len(self.seen) == self.nth:
                sys.settrace(None)
                self.other = [solved(self.scene), solved(self.scene, by="angle", acceleration=1.0)]
        return self


# What a thread does, another may do between any two steps of it: here it is done between each two in turn.
@pytest.mark.slow
@pytest.mark.parametrize("step", [11, pytest.param(1, marks=pytest.mark.long)])
def test_a_solve_in_another_thread_between_any_two_steps_changes_nothing(step: int) -> None:
    alone, other = solved(fresh()), solved(fresh(), by="angle", acceleration=1.0)
    solved(fresh(), acceleration=2.0)
    for nth in count(1, step):
        scene = fresh()
        solved(scene, acceleration=2.0)
        between = Between(scene, nth)
        before = sys.gettrace()
        sys.settrace(between)
        try:
            found = solved(scene)
        finally:
            sys.settrace(before)
        assert found == alone
        if not between.other:
            assert nth > 100
            return
        assert between.other == [alone, other]


def test_eight_threads_solve_a_fresh_scene_as_one_does() -> None:
    asked = [
        {"by": by, "acceleration": second} for by in ("phase", "angle") for second in (0.0, 1.0, -1.0, 3.0)
    ]
    alone = [solved(fresh(), **one) for one in asked]  # type: ignore[arg-type]
    for _ in range(10):
        scene, start, found = fresh(), threading.Barrier(len(asked)), dict[int, Any]()

        def work(n: int, scene: Scene = scene, start: threading.Barrier = start, found: Any = found) -> None:
            start.wait()
            found[n] = solved(scene, **asked[n])  # type: ignore[arg-type]

        threads = [threading.Thread(target=work, args=(n,)) for n in range(len(asked))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert [found.get(n) for n in range(len(asked))] == alone
