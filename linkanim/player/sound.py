"""Play the sounds of the motion and of answers.

First come the cues of a step of the motion, at dead centres and at the input's limits; then their waves,
short tones that die away; then the loudspeaker, opened in a thread when the first sound is played.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.frozen import NamedTuple
from linkanim.player.state import State
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from threading import Thread

# Which sounds the motion makes from one frame to a later one: at dead centres, and at the input's limits.

Cue = Literal["tick", "tock", "limit", "right", "wrong"]
"""A tick is the forward dead centre, a tock the backward one; so a quick return has a rhythm."""
_FARTHEST = 1.0
"""In radians of phase: a larger step is a jump, which passes no dead centre or limit."""


def cues(before: State, after: State) -> tuple[Cue, ...]:
    """Return the cues between one state of the window and a later one; none while sounds are off."""
    if not after.is_audible or before.scene is not after.scene:
        return ()
    return tuple(_passed(after.scene, before.phase, after.phase))


def _passed(scene: Scene, before: float, after: float) -> Iterator[Cue]:
    """Yield the cues between two phases; a cue at a phase belongs to the step that begins there."""
    if before == after or abs(after - before) > _FARTHEST:
        return
    if not scene.info.full_turn and _lies_between(before, after, 0.0, math.pi):
        yield "limit"
    moved = scene.info.swing
    back, forward = scene.info.dead_centres or (moved.dead_centres if moved else None) or (None, None)
    if forward is not None and _lies_between(before, after, forward, scene.period):
        yield "tick"
    if back is not None and _lies_between(before, after, back, scene.period):
        yield "tock"


def _lies_between(before: float, after: float, place: float, period: float) -> bool:
    """Return whether a place, whole periods aside, lies between two phases."""
    return math.floor((before - place) / period) != math.floor((after - place) / period)


# The sounds themselves, computed: short tones that die away, quiet beside a lecturer's voice.

RATE = 44_100
"""Samples a second, one channel."""
_LOUDEST = 0.14
"""The loudest sample, as a share of what a sample can hold."""
_ONSET = 0.001
"""How long a tone takes to begin, in s: a step would click."""


class Tone(NamedTuple):
    """A tone of `pitch` (Hz) from `start` (s) on, falling to 1/e in `fade` (s); `share` is how loud it is."""

    pitch: float
    fade: float
    start: float = 0.0
    share: float = 1.0


_TONES: Mapping[Cue, tuple[Tone, ...]] = {
    "tick": (Tone(2093.0, 0.006), Tone(4186.0, 0.003, share=0.4)),
    "tock": (Tone(1396.9, 0.008), Tone(2793.8, 0.004, share=0.4)),
    "limit": (Tone(98.0, 0.045), Tone(147.0, 0.025, share=0.6)),
    "right": (Tone(659.3, 0.07), Tone(987.8, 0.11, start=0.09)),
    "wrong": (Tone(233.1, 0.08), Tone(174.6, 0.13, start=0.11)),
}
_FADES = 6
"""A tone ends after this many times its fade."""


def wave(cue: Cue) -> NDArray[np.int16]:
    """Return the samples of a sound."""
    tones = _TONES[cue]
    seconds = max(tone.start + _FADES * tone.fade for tone in tones)
    time = np.arange(round(seconds * RATE)) / RATE
    whole = sum(_sounding(tone, time) for tone in tones) / sum(tone.share for tone in tones)
    return np.asarray(np.round(_LOUDEST * np.iinfo(np.int16).max * whole), np.int16)


def _sounding(tone: Tone, time: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a tone at some times (s): within -share and share, 0 before it starts."""
    since = np.maximum(time - tone.start, 0.0)
    strength = tone.share * np.minimum(since / _ONSET, 1.0) * np.exp(-since / tone.fade)
    return np.asarray(strength * np.sin(2 * np.pi * tone.pitch * since))


# The loudspeaker: opened beside the frames when something is first to be heard; silent without a device.

_BUFFER = 512
"""Samples that are sent at once: 12 ms."""


class Speaker:
    """Plays sounds; those before the device is open, or where there is none, are not heard."""

    def __init__(self) -> None:
        self._opening: Thread | None = None
        self._sounds: dict[str, pygame.mixer.Sound] = {}

    def play(self, cue: str) -> None:
        """Play a sound; the first call only begins to open the device, which may take longer than a frame."""
        if self._opening is None:
            from threading import Thread

            self._opening = Thread(target=self._open, daemon=True)
            self._opening.start()
        elif sound := self._sounds.get(cue):
            sound.play()

    def close(self) -> None:
        """Close the device."""
        if self._opening:
            self._opening.join()
            self._sounds = {}
            pygame.mixer.quit()

    def _open(self) -> None:
        if not _is_likely():
            return

        try:
            pygame.mixer.init(RATE, -16, 1, _BUFFER, allowedchanges=0)
        except pygame.error:
            return
        self._sounds = {cue: pygame.mixer.Sound(buffer=wave(cue).tobytes()) for cue in get_args(Cue)}


def _is_likely() -> bool:
    """Return whether a device may exist: where none does, Linux's library would complain on stderr."""
    if not sys.platform.startswith("linux") or os.environ.get("SDL_AUDIODRIVER"):
        return True
    served = Path(os.environ.get("XDG_RUNTIME_DIR", "/nonexistent"))
    places = (Path("/dev/snd"), served / "pulse" / "native", served / "pipewire-0")
    return "PULSE_SERVER" in os.environ or any(place.exists() for place in places)
