"""The sounds themselves, computed: short tones that die away, quiet beside a lecturer's voice."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.player.sound.cues import Cue

RATE = 44_100
"""Samples a second, one channel."""
_LOUDEST = 0.14
"""Of what a sample can hold."""
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
"""After so many times its fade a tone is over."""


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
