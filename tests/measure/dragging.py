"""What a frame costs while a hand drags a length, with names, chart and the motion running, at 1280x720.

Times are of the processor, and of each frame the median over rounds: a core may be taken away in the midst
of one. The hand leads the length out and back; where it goes beyond what the linkage allows, it is refused.
"""

from __future__ import annotations

import sys
import time
from statistics import median
from typing import NamedTuple

import pygame
from reaction import bounded, press
from window import dummy, measured, spare

from linkanim.bench.result import this_machine
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen as display
from linkanim.ui.screen import Screen
from linkanim.ui.window import Window

SCENES = ("crank-rocker", "press", "jansen", "excavator")
SIZE = (1280, 720)
ROW = 1
"""The row of the list whose length is dragged: the first may be the ground, or an input's."""
OPENING = {10: "n", 60: "c", 120: "e"}
"""The keys before, and the frames at which they are pressed: names, chart, the list of dimensions."""
GRASPED, LED = 200, 160
"""The frame at which the length is grasped, and the frames for which it is led, half of them back."""
PIXELS = 5
"""How far the hand goes in a frame."""
ROUNDS = 5
BOUNDS_MS = 16.7, 33.0
"""For the median and for the worst."""


class Dragged(NamedTuple):
    """A frame of a drag: its time, ms, and whether the length was refused in it."""

    milliseconds: float
    refused: bool


def drag(scene: str) -> list[Dragged]:
    """Return the frames of one drag."""
    found: list[Dragged] = []
    with display.opened(SIZE):
        window = Window(begin(load(scene)))
        spare()
        at = (0, 0)
        for frame in range(GRASPED + 1 + LED):
            if key := OPENING.get(frame):
                press(key)
            if frame == GRASPED:
                at = _row(window.screen)
                _move(at, held=False)
                pygame.event.post(pygame.event.Event(pygame.MOUSEBUTTONDOWN, pos=at, button=1))
            if (led := frame - GRASPED) > 0:
                _move((at[0] + PIXELS * min(led, LED - led), at[1]), held=True)
            start = time.process_time()
            window.tick()
            if led > 0:
                took = 1e3 * (time.process_time() - start)
                found.append(Dragged(took, window.state.editing.refusal is not None))
        window.close()
    return found


def _move(to: tuple[int, int], *, held: bool) -> None:
    """Post the event of a mouse that moves to a pixel."""
    pygame.event.post(pygame.event.Event(pygame.MOUSEMOTION, pos=to, rel=(1, 0), buttons=(int(held), 0, 0)))


def _row(screen: Screen) -> tuple[int, int]:
    """Return a pixel on the row that is dragged; StopIteration where the list is not open."""
    width, height = SIZE
    places = ((x, y) for y in range(height) for x in (width - 180, 150))
    return next(place for place in places if screen.row_at(*place) == ROW)


def settled(scene: str, rounds: int = ROUNDS) -> list[Dragged]:
    """Return of each frame the median over rounds."""
    drags = [drag(scene) for _ in range(rounds)]
    return [
        Dragged(median(one.milliseconds for one in same), same[0].refused)
        for same in zip(*drags, strict=True)
    ]


def as_text(scene: str, found: list[Dragged]) -> str:
    """Return one line: the median and the worst beside their bounds."""
    times, refused = [one.milliseconds for one in found], sum(one.refused for one in found)
    what = f"{scene}: {len(found)} frames, in {refused} of them the length is refused:"
    return f"{what} {bounded(times, BOUNDS_MS)}"


if __name__ == "__main__":
    print(this_machine().line)
    with dummy():
        for name in sys.argv[1:] or SCENES:
            print(as_text(name, settled(name)))
        print(f"beside it, a frame of the press with vectors and chart: {measured(SIZE).processor:.1f} ms")
