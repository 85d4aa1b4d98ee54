"""Gamepads: which are plugged in, what their buttons ask for, where the left stick turns the crank to."""

from __future__ import annotations

from math import isfinite
from typing import NamedTuple

import pygame
from pygame.event import Event

from linkanim.player.input.keyboard import Repeats
from linkanim.player.input.keys import Bind, Press, bind_of
from linkanim.player.input.pad_buttons import button_name, hat_name, key_of
from linkanim.player.state.action import Action, Mode
from linkanim.player.state.state import State
from linkanim.scenes.steering import phase_along

PAD_EVENTS = (
    pygame.JOYDEVICEADDED,
    pygame.JOYDEVICEREMOVED,
    pygame.JOYAXISMOTION,
    pygame.JOYHATMOTION,
    pygame.JOYBUTTONDOWN,
    pygame.JOYBUTTONUP,
)
_LOOKED_FOR_AFTER = 30
"""Frames after which gamepads are looked for: the first picture does not wait for it."""
_DEAD_ZONE = 0.4
"""A stick that is no further out than so much of its way is let go."""


class Pad(NamedTuple):
    """A gamepad, held open so that its events come, and what is to be known of it once it is gone."""

    opened: pygame.joystick.JoystickType
    name: str
    has_hat: bool


class Pads:
    """Knows the gamepads that are plugged in, where the stick was pushed last, and what is being held."""

    def __init__(self) -> None:
        self._pads: dict[int, Pad] = {}
        self._stick, self._moved = [0.0, 0.0], False
        self._repeats = Repeats()
        self._frames: int | None = _LOOKED_FOR_AFTER

    def look(self, frames: int) -> None:
        """Look for gamepads, once, some frames after the window has opened; events tell of them from then."""
        if self._frames is None:
            return
        self._frames -= frames
        if self._frames <= 0:
            self._frames = None
            pygame.joystick.init()

    def actions(self, event: Event, mode: Mode, frame: int) -> tuple[Action, ...]:
        """Return what an event asks for; of the stick only what is taken note of."""
        match event.type:
            case pygame.JOYDEVICEADDED:
                return self._plugged_in(event.device_index)
            case pygame.JOYDEVICEREMOVED if self._pads.pop(event.instance_id, None):
                return (Action("pad", next((pad.name for pad in self._pads.values()), "")),)
            case pygame.JOYAXISMOTION if event.axis in (0, 1) and isfinite(event.value):
                self._stick[event.axis], self._moved = event.value, True
            case pygame.JOYBUTTONDOWN:
                return self._pressed(button_name(event.button, hat=self._has_hat(event)), mode, frame)
            case pygame.JOYHATMOTION:
                return self._pressed(hat_name(*event.value), mode, frame)
            case pygame.JOYBUTTONUP:
                self._repeats.begin(None, frame)
        return ()

    def turned(self, state: State) -> tuple[Action, ...]:
        """Return where the stick has turned the crank to since the last frame: both its axes together."""
        moved, self._moved = self._moved, False
        way = complex(self._stick[0], -self._stick[1])
        if not moved or abs(way) <= _DEAD_ZONE or state.mode in ("list", "shelf"):
            return ()
        return (Action("scrub", phase_along(state.displayed, state.phase, way / max(abs(way), 1.0))),)

    def repeated(self, frame: int) -> tuple[Action, ...]:
        """Return what a button that is held asks for when that is due again."""
        return self._repeats.due(frame)

    def _plugged_in(self, index: int) -> tuple[Action, ...]:
        try:
            pad = pygame.joystick.Joystick(index)
            found = Pad(pad, pad.get_name(), pad.get_numhats() > 0)
            self._pads[pad.get_instance_id()] = found
        except pygame.error:  # pulled out before its event came
            return ()
        return (Action("pad", found.name),)

    def _has_hat(self, event: Event) -> bool:
        """Whether the gamepad of an event has its D-pad as a hat, as most have."""
        pad = self._pads.get(getattr(event, "instance_id", -1))
        return pad is None or pad.has_hat

    def _pressed(self, name: str, mode: Mode, frame: int) -> tuple[Action, ...]:
        bind = _bound(name, mode)
        self._repeats.begin(bind, frame)
        return (bind.action,) if bind else ()


def _bound(name: str, mode: Mode) -> Bind | None:
    """Return what a button asks for: what its key does; None where it has none."""
    key = key_of(name, listed=mode not in ("play", "paused"))
    shift = key.startswith("shift+")
    return bind_of(Press(key.removeprefix("shift+"), shift=shift), mode) if key else None
