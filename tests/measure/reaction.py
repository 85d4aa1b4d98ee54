"""How long a key takes to be seen: from its event to the flip of the first picture that heeds it."""

from __future__ import annotations

import random
import sys
import time
from collections import deque
from statistics import median
from threading import Event, Thread

import pygame
from window import dummy

from linkanim.bench.result import this_machine
from linkanim.player import screen as display
from linkanim.player.state import begin
from linkanim.player.window import Window, frames
from linkanim.scenes import load

KEYS = "ttvvaannllppiijj"
"""Pressed one after the other, so that each shows something and takes it away again."""
PRESSES = 160
APART = 0.05, 0.13
"""The least and the longest time between two presses, in s."""
BOUNDS_MS = 25.0, 50.0
"""For the median and for the worst."""


def reactions(scene: str, size: tuple[int, int], presses: int = PRESSES) -> list[float]:
    """Return the time from each event to the flip of the picture after it, in ms, in a running window."""
    posted: deque[float] = deque()
    over = Event()

    def press() -> None:
        chance = random.Random(1)
        for n in range(presses):
            time.sleep(chance.uniform(*APART))
            key = KEYS[n % len(KEYS)]
            posted.append(time.perf_counter())
            for kind in (pygame.KEYDOWN, pygame.KEYUP):
                pygame.event.post(pygame.event.Event(kind, key=pygame.key.key_code(key), unicode=key, mod=0))
        over.set()

    found: list[float] = []
    with display.opened(size):
        window = Window(begin(load(scene)))
        fingers = Thread(target=press)
        fingers.start()
        try:
            for count in frames(time.monotonic, time.sleep):
                begun = time.perf_counter()
                window.tick(count)
                seen = time.perf_counter()
                while posted and posted[0] < begun:
                    found.append(1e3 * (seen - posted.popleft()))
                if over.is_set() and not posted:
                    break
        finally:
            fingers.join()
            window.close()
    return found


def as_text(scene: str, size: tuple[int, int], found: list[float]) -> str:
    """Return one line: the median and the worst beside their bounds."""
    middle, worst = BOUNDS_MS
    return (
        f"{scene}, {size[0]}x{size[1]}, {len(found)} keys: from the event to the flip {median(found):.1f} ms "
        f"(≤ {middle:g} ms), worst {max(found):.1f} ms (≤ {worst:g} ms)"
    )


if __name__ == "__main__":
    print(this_machine().line)
    with dummy():
        for name in sys.argv[1:] or ("crank-rocker", "press", "jansen"):
            for shape in ((1280, 720), (1920, 1080)):
                print(as_text(name, shape, reactions(name, shape)))
