"""A track: where a ram has to be along the paper that scrolls by, made from the scene's own motion."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from random import Random
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage.joint import Point
from linkanim.mechanics.motion.measures import output_slider
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

LENGTH = 4_500
"""Of the paper, in mm."""
LEVELS = 3
_HALF_WIDTHS = (0.11, 0.075, 0.05)
"""Of the way between the lines, in strokes, by level."""
_LEAD = 60
_HALF_TURN = 150
"""So much paper, in mm, goes by before the ram has to move, and while a steady crank turns halfway."""
_SLOWEST, _FASTEST = 260, 130
"""Paper for one stroke at a steady speed of the ram."""
_RESTS = (40, 90)
_SAMPLES = 1_440


@dataclass(frozen=True)
class RamTrack:
    """Where the ram of a scene has to be at each mm of the paper: 0 at its back dead centre, 1 forward.

    The mechanism begins at phase 0. `back` and `forward` are the ram's places at its dead
    centres, in the scene's unit; `limits` its travel there.
    """

    places: tuple[float, ...]
    half_width: float
    body: str
    limits: tuple[float, float]
    back: Point
    forward: Point

    def at(self, paper: float) -> float:
        """Return where the ram has to be at a place of the paper (mm)."""
        place = min(max(paper, 0.0), len(self.places) - 1.001)
        first = int(place)
        low, high = self.places[first : first + 2]
        return low + (place - first) * (high - low)

    def share(self, scene: Scene, phase: float) -> float:
        """Return where the ram is at a phase of the scene: 0 at its back dead centre, 1 forward."""
        low, high = self.limits
        return (float(scene.pose(phase, 0).travel[self.body]) - low) / (high - low)


def is_track(scene: Scene) -> bool:
    """Whether a scene has a ram that a crank moves to and fro."""
    ram = output_slider(scene.linkage)
    return ram is not None and ram.slider != scene.linkage.drive.joint and scene.info.dead_centres is not None


@lru_cache(maxsize=1)
def tracks() -> tuple[str, ...]:
    """Return the scenes of the catalogue that are tracks."""
    return tuple(name for name in names() if is_track(load(name)))


@lru_cache(maxsize=2)
def track_of(name: str, level: int) -> RamTrack:
    """Return a scene's track at a level, 1 to `LEVELS`; each is the same at all times."""
    scene = load(name)
    ram, ends = output_slider(scene.linkage), scene.info.dead_centres
    assert ram
    assert ram.slider
    assert ends
    back, forward = (scene.pose(phase, 0) for phase in ends)
    low, high = float(back.travel[ram.name]), float(forward.travel[ram.name])
    motion = scene.solve(phase=np.arange(_SAMPLES) * (scene.period / _SAMPLES), derivatives=0)
    cycle = (np.asarray(motion.travel[ram.name]) - low) / (high - low)
    random = Random(crc32(f"{name} {level}".encode()))
    places = _places(cycle, scene, random)
    return RamTrack(
        places,
        _HALF_WIDTHS[level - 1],
        ram.name,
        (low, high),
        back.position[ram.slider],
        forward.position[ram.slider],
    )


def _places(cycle: NDArray[np.float64], scene: Scene, random: Random) -> tuple[float, ...]:
    """Return the places of a whole track, from where the ram is at phase 0."""
    places = [float(cycle[0])] * _LEAD
    places += _turning(cycle, scene, 0.0, 2)
    while len(places) <= LENGTH:
        places += _stretch(places[-1], cycle, scene, random)
    return tuple(min(max(place, 0.0), 1.0) for place in places[: LENGTH + 1])


def _stretch(place: float, cycle: NDArray[np.float64], scene: Scene, random: Random) -> Iterator[float]:
    """Yield what comes next: half turns of a steady crank, a steady stroke of the ram, or a rest."""
    kind = random.choice(("turn", "turn", "stroke", "stroke", "rest"))
    if kind == "rest":
        yield from [place] * random.randint(*_RESTS)
    elif kind == "stroke":
        end = random.uniform(0.55, 0.97) if place < 0.5 else random.uniform(0.03, 0.45)
        count = max(round(abs(end - place) * random.uniform(_FASTEST, _SLOWEST)), 8)
        yield from (place + (end - place) * n / count for n in range(1, count + 1))
    else:
        near = int(np.abs(cycle - place).argmin()) * (scene.period / _SAMPLES)
        yield from _turning(cycle, scene, near, random.randint(1, 3))


def _turning(cycle: NDArray[np.float64], scene: Scene, phase: float, halves: int) -> list[float]:
    """Return the ram's places while a steady crank turns some halves of a turn on from a phase."""
    phases = phase + math.pi / _HALF_TURN * np.arange(1, halves * _HALF_TURN + 1)
    known = np.arange(_SAMPLES + 1) * (scene.period / _SAMPLES)
    found: list[float] = np.interp(phases % scene.period, known, np.append(cycle, cycle[0])).tolist()
    return found
