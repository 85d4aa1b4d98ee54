"""How long a key takes to be seen: from its event to the flip of the first picture that heeds it.

The clock goes by processor time and leaps where the window waits, as on a machine that does nothing else.
"""

from __future__ import annotations

import random
import sys
import time
from collections import deque
from collections.abc import Sequence
from statistics import median

import pygame
from window import dummy, spare

from linkanim.bench.result import this_machine
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen as display
from linkanim.ui.window import Window, frames

KEYS = "ttvvaannllppiijj"
"""Pressed one after the other, so that each shows something and takes it away again."""
PRESSES, ROUNDS = 160, 5
APART = 0.05, 0.13
"""The least and the longest time between two presses, in s."""
BOUNDS_MS = 25.0, 50.0
"""For the median and for the worst."""


class Clock:
    """Processor time, and what was waited for, in s."""

    def __init__(self) -> None:
        self._waited = 0.0

    def now(self) -> float:
        """Return the time."""
        return time.process_time() + self._waited

    def wait(self, seconds: float) -> None:
        """Let time pass at once."""
        self._waited += seconds


def reactions(scene: str, size: tuple[int, int], presses: int = PRESSES) -> list[float]:
    """Return the time from each event to the flip of the picture after it, in ms, in a running window."""
    chance, clock = random.Random(1), Clock()
    found: list[float] = []
    with display.opened(size):
        window = Window(begin(load(scene)))
        spare()
        coming, at = deque[tuple[float, str]](), clock.now()
        for n in range(presses):
            at += chance.uniform(*APART)
            coming.append((at, KEYS[n % len(KEYS)]))
        for count in frames(clock.now, clock.wait):
            heeded = []
            while coming and coming[0][0] <= clock.now():
                at, key = coming.popleft()
                heeded.append(at)
                press(key)
            window.tick(count)
            found += [1e3 * (clock.now() - at) for at in heeded]
            if not coming:
                break
        window.close()
    return found


def press(key: str) -> None:
    """Post the events of a key that is pressed and released."""
    for kind in (pygame.KEYDOWN, pygame.KEYUP):
        pygame.event.post(pygame.event.Event(kind, key=pygame.key.key_code(key), unicode=key, mod=0))


def settled(scene: str, size: tuple[int, int], rounds: int = ROUNDS) -> list[float]:
    """Return of each press the median over rounds, ms: a core may be taken away in the midst of a frame."""
    return [median(times) for times in zip(*(reactions(scene, size) for _ in range(rounds)), strict=True)]


def as_text(scene: str, size: tuple[int, int], found: list[float]) -> str:
    """Return one line: the median and the worst beside their bounds."""
    what = f"{scene}, {size[0]}x{size[1]}, {len(found)} keys: from the event to the flip"
    return f"{what} {bounded(found, BOUNDS_MS)}"


def bounded(times: Sequence[float], bounds: tuple[float, float]) -> str:
    """Return the median and the worst of times beside their bounds, all in ms."""
    middle, worst = bounds
    return (
        f"{median(times):.1f} ms in the median (≤ {middle:g} ms), worst {max(times):.1f} ms (≤ {worst:g} ms)"
    )


if __name__ == "__main__":
    print(this_machine().line)
    with dummy():
        for name in sys.argv[1:] or ("crank-rocker", "press", "jansen"):
            for shape in ((1280, 720), (1920, 1080)):
                print(as_text(name, shape, settled(name, shape)))
