"""What each key of the window costs on every scene: the frame that heeds it, and the worst of those after."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable
from dataclasses import replace
from statistics import median
from typing import NamedTuple

from window import dummy, spare

from linkanim.bench.result import this_machine
from linkanim.export import columns
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.keys import RUNNING, Press
from linkanim.player.state import State, begin
from linkanim.scenes import load, names
from linkanim.ui import screen as display
from linkanim.ui.screen import Screen

KEYS = "lnptcvaibjhkoe"
"""The letters measured: those that change what is shown."""
BEFORE, AFTER = 12, 26
"""Frames shown before a key, and after it: the view has come to rest by then."""
AGAIN = 2
"""So often a key over a bound is pressed again, in a new window: what else the machine does only adds."""
BOUNDS_MS = {(1280, 720): 33.0, (1920, 1080): 50.0}
"""For the frame that heeds a key; those after it take no longer than the first of them."""
TITLES = ("key", "median", "worst", "on", "worst after it", "on")


class KeyCost(NamedTuple):
    """Processor time of the frame that heeds a key, and of the slowest of those after it, in ms."""

    key: str
    scene: str
    heeded: float
    after: float


def measured(size: tuple[int, int], scenes: Iterable[str], keys: str = KEYS) -> list[KeyCost]:
    """Press each key once on each scene in a window of that size, everything else as at the start.

    A key over a bound is pressed up to `AGAIN` times more, and the least of each figure counts.
    """
    spare()
    costs = []
    for name in scenes:
        for key in keys:
            cost, tries = _pressed(size, name, key), 0
            while tries < AGAIN and _over(cost, size):
                again, tries = _pressed(size, name, key), tries + 1
                cost = KeyCost(key, name, *map(min, cost[2:], again[2:]))
            costs.append(cost)
    return costs


def _over(cost: KeyCost, size: tuple[int, int]) -> bool:
    """Tell whether a frame is over its bound."""
    bounds = (BOUNDS_MS[size], min(BOUNDS_MS.values()))
    return any(took > most for took, most in zip(cost[2:], bounds, strict=True))


def _pressed(size: tuple[int, int], name: str, key: str) -> KeyCost:
    begun = begin(replace(load(name)))  # of which nothing is known from the key before
    bind = RUNNING.bind_of(Press(key, key))
    assert bind is not None, f"the key {key} does nothing"
    with display.opened(size):
        screen = Screen(begun)
        state = begun
        for _ in range(BEFORE):
            state, _ = _frame(screen, state)
        state, heeded = _frame(screen, state, bind.action)
        later = []
        for _ in range(AFTER):
            state, spent = _frame(screen, state)
            later.append(spent)
    return KeyCost(key, name, heeded, max(later))


def _frame(screen: Screen, state: State, *actions: Action) -> tuple[State, float]:
    """Return the state after a frame with these actions, and the processor time of it all in ms."""
    start = time.process_time()
    state = advance(state, actions)
    screen.show(state)
    return state, 1e3 * (time.process_time() - start)


def as_text(size: tuple[int, int], costs: list[KeyCost]) -> str:
    """Return a line for each key: its median and its worst over the scenes."""
    rows = [TITLES]
    for key in dict.fromkeys(cost.key for cost in costs):
        of_key = [cost for cost in costs if cost.key == key]
        worst = max(of_key, key=lambda cost: cost.heeded)
        later = max(of_key, key=lambda cost: cost.after)
        middle = median(cost.heeded for cost in of_key)
        figures = (f"{middle:.0f} ms", f"{worst.heeded:.0f} ms", worst.scene)
        rows.append((key.upper(), *figures, f"{later.after:.0f} ms", later.scene))
    head = f"{size[0]}x{size[1]}, at most {BOUNDS_MS[size]:g} ms wanted"
    return f"{head}\n{columns(rows)}"


if __name__ == "__main__":
    chosen = sys.argv[1:] or [*names()]
    print(this_machine().line)
    with dummy():
        for window in BOUNDS_MS:
            print("\n" + as_text(window, measured(window, chosen)))
