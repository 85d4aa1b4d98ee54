"""How a step under the hand is drawn: whole in its frame, or where that takes too long, in two."""

from __future__ import annotations

import time
from collections.abc import Callable
from math import inf
from typing import Literal

import pygame
from pygame.event import Event

from linkanim.player.state.clock import FRAMES_PER_SECOND

_ROOM = 0.85 / FRAMES_PER_SECOND
"""What a frame may take, in seconds: the rest is for what else the machine does."""
_ONCE = 0.75
"""What a step takes at once of what it takes in two frames: all that moves is in both."""


class Halving:
    """Knows how long the last step took, and whether the rest of it is still to be drawn.

    In the first of two frames the linkage follows, in the second what stands still behind it, and the list;
    meanwhile a mouse that only moves has to wait.
    """

    def __init__(self, now: Callable[[], float] = time.perf_counter) -> None:
        self._now, self._began = now, 0.0
        self._waiting: list[Event] = []
        self._late = False
        self._part: Literal["first", "rest", "whole", "none"] = "none"
        self._first, self._step = 0.0, inf

    def begin(self, events: list[Event]) -> list[Event]:
        """Begin a frame; return what is for it of the events, and of those that wait."""
        self._began = self._now()
        events, self._waiting = self._waiting + events, []
        if self._late and all(event.type == pygame.MOUSEMOTION for event in events):
            events, self._waiting = [], events
        return events

    def late(self, *, stepped: bool) -> bool:
        """Return whether this frame, in which something was changed or not, has the first half of a step."""
        was, self._late = self._late, stepped and self._step > _ROOM
        self._part = "first" if self._late else "rest" if was else "whole" if stepped else "none"
        return self._late

    def end(self) -> None:
        """End a frame: take note of what it took."""
        took = self._now() - self._began
        match self._part:
            case "first":
                self._first = took
            case "rest":
                self._step = _ONCE * (self._first + took)
            case "whole":
                self._step = took
