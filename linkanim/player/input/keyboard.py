"""The keyboard: key events to presses, and a key that is held to an action that repeats."""

from __future__ import annotations

import pygame
from pygame.event import Event

from linkanim.player.input.keys import Bind, Press, key_names
from linkanim.player.state.action import Action

_WAIT = 24
_EVERY = 3


def code(name: str) -> int:
    """Return pygame's number for a key of the table; a printable key's is its character's."""
    return ord(name) if len(name) == 1 else int(getattr(pygame, f"K_{name.upper()}"))


class Repeats:
    """An action that is asked for again and again while something is held."""

    def __init__(self) -> None:
        self._action: Action | None = None
        self._next = 0

    def begin(self, bind: Bind | None, frame: int) -> None:
        """Go on with what was bound, where holding it does; else with nothing."""
        self._action = bind.action if bind and bind.repeats else None
        self._next = frame + _WAIT

    def due(self, frame: int) -> tuple[Action, ...]:
        """Return the action when it is due again."""
        if self._action is None or frame < self._next:
            return ()
        self._next = frame + _EVERY
        return (self._action,)


class Keyboard:
    """Knows which bound key is being held, and since when."""

    def __init__(self) -> None:
        self._names = {code(name): name for name in key_names()}
        self._key: int = 0
        self._repeats = Repeats()

    def press(self, event: Event) -> Press | None:
        """Return what a KEYDOWN means; None with Alt or the system's key, which are not ours."""
        mod = getattr(event, "mod", 0)
        if mod & (pygame.KMOD_ALT | pygame.KMOD_META) and not mod & pygame.KMOD_MODE:
            return None
        text = getattr(event, "unicode", "")
        shift, ctrl = bool(mod & pygame.KMOD_SHIFT), bool(mod & pygame.KMOD_CTRL)
        return Press(self._names.get(event.key, ""), text if text.isprintable() else "", shift, ctrl)

    def hold(self, event: Event, bind: Bind | None, frame: int) -> None:
        """Take note of the key that went down last."""
        self._key = event.key
        self._repeats.begin(bind, frame)

    def repeated(self, frame: int) -> tuple[Action, ...]:
        """Return the held key's action when it is due again."""
        due = self._repeats.due(frame)
        if due and not pygame.key.get_pressed()[self._key]:
            self._repeats.begin(None, frame)
            return ()
        return due
