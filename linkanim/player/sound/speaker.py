"""The loudspeaker: opened beside the frames when something is first to be heard; silent without a device."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from threading import Thread
from typing import get_args

import pygame

from linkanim.player.sound.cues import Cue

_BUFFER = 512
"""Samples that are sent at once: 12 ms."""


class Speaker:
    """Plays sounds; what comes before the device is open, or where there is none, is not heard."""

    def __init__(self) -> None:
        self._opening: Thread | None = None
        self._sounds: dict[str, pygame.mixer.Sound] = {}

    def play(self, cue: str) -> None:
        """Play a sound; the first call only begins to open the device, which may take longer than a frame."""
        if self._opening is None:
            self._opening = Thread(target=self._open, daemon=True)
            self._opening.start()
        elif sound := self._sounds.get(cue):
            sound.play()

    def close(self) -> None:
        """Let go of the device."""
        if self._opening:
            self._opening.join()
            self._sounds = {}
            pygame.mixer.quit()

    def _open(self) -> None:
        if not _is_likely():
            return
        from linkanim.player.sound.waves import RATE, wave

        try:
            pygame.mixer.init(RATE, -16, 1, _BUFFER, allowedchanges=0)
        except pygame.error:
            return
        self._sounds = {cue: pygame.mixer.Sound(buffer=wave(cue).tobytes()) for cue in get_args(Cue)}


def _is_likely() -> bool:
    """Whether there may be a device; asked for one where none is, Linux's library complains on stderr."""
    if not sys.platform.startswith("linux") or os.environ.get("SDL_AUDIODRIVER"):
        return True
    served = Path(os.environ.get("XDG_RUNTIME_DIR", "/nonexistent"))
    places = (Path("/dev/snd"), served / "pulse" / "native", served / "pipewire-0")
    return "PULSE_SERVER" in os.environ or any(place.exists() for place in places)
