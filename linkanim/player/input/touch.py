"""Fingers as the mouse: the first one is its left button, two of them turn its wheel."""

from __future__ import annotations

from math import dist, isnan, log

import pygame
from pygame.event import Event

FINGERS = (pygame.FINGERDOWN, pygame.FINGERMOTION, pygame.FINGERUP)
_MOUSE = (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEMOTION)
_NOTCH = 1.1
"""How much further apart two fingers are for a notch of the wheel."""

Place = tuple[int, int]


class Fingers:
    """Knows the fingers that are down, and which of them is the pointer."""

    def __init__(self) -> None:
        self._down: dict[int, Place] = {}
        self._pointer: int | None = None
        self._apart = 0.0

    def pointed(self, events: list[Event], size: tuple[int, int]) -> list[Event]:
        """Return the events with those of fingers as the mouse's, in a window of that size.

        What the system makes of fingers by itself, mouse events with a mark, is left out.
        """
        found: list[Event] = []
        for event in events:
            if event.type in FINGERS:
                found += self._of_finger(event, size)
            elif event.type not in _MOUSE or not getattr(event, "touch", False):
                found.append(event)
        return found

    def _of_finger(self, event: Event, size: tuple[int, int]) -> list[Event]:
        at = _place(event, size) or self._down.get(event.finger_id)
        if at is None:
            return []
        if event.type == pygame.FINGERDOWN:
            return self._put(event.finger_id, at)
        if event.type == pygame.FINGERUP:
            return self._lifted(event.finger_id, at)
        if event.finger_id not in self._down:
            return []
        self._down[event.finger_id] = at
        if len(self._down) > 1:
            return self._pinched()
        return [_mouse(pygame.MOUSEMOTION, at)] if event.finger_id == self._pointer else []

    def _put(self, finger: int, at: Place) -> list[Event]:
        """Return the button pressed by the first finger, and let go by the second."""
        self._down[finger] = at
        if len(self._down) == 1:
            self._pointer = finger
            return [_mouse(pygame.MOUSEMOTION, at), _mouse(pygame.MOUSEBUTTONDOWN, at)]
        held, self._pointer, self._apart = self._pointer, None, self._spread
        if held in self._down and held != finger:
            return [_mouse(pygame.MOUSEBUTTONUP, self._down[held])]
        return []

    def _lifted(self, finger: int, at: Place) -> list[Event]:
        self._down.pop(finger, None)
        self._apart = self._spread
        if finger != self._pointer:
            return []
        self._pointer = None
        return [_mouse(pygame.MOUSEBUTTONUP, at)]

    def _pinched(self) -> list[Event]:
        """Return the wheel turned by the fingers' distance, about their middle."""
        notches = round(log(self._spread / self._apart, _NOTCH)) if self._apart and self._spread else 0
        if not notches:
            return []
        self._apart = self._spread
        (x0, y0), (x1, y1), *_ = self._down.values()
        middle = _mouse(pygame.MOUSEMOTION, ((x0 + x1) // 2, (y0 + y1) // 2))
        return [middle, Event(pygame.MOUSEWHEEL, x=0, y=notches)]

    @property
    def _spread(self) -> float:
        places = [*self._down.values()]
        return dist(*places[:2]) if len(places) > 1 else 0.0


def _place(event: Event, size: tuple[int, int]) -> Place | None:
    """Return the pixel under a finger, on the window's edge where it is outside; None where it is nowhere."""
    if isnan(event.x) or isnan(event.y):
        return None
    x, y = (min(max(share, 0.0), 1.0) for share in (event.x, event.y))
    return round(x * size[0]), round(y * size[1])


def _mouse(kind: int, at: Place) -> Event:
    """Return an event of the mouse, its left button the one that is meant."""
    if kind == pygame.MOUSEMOTION:
        return Event(kind, pos=at, rel=(0, 0), buttons=(1, 0, 0))
    return Event(kind, pos=at, button=1)
