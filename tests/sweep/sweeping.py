"""One linkage of the sweep: refused with a sentence, or run and looked at from all sides."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from motion_checks import Array, kinks, not_back, not_finite, unclosed

from linkanim.errors import LinkanimError
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

STEPS = 360
"""Instants of one drive period at which a linkage is looked at."""
ALONE = (0, 7, STEPS // 4, STEPS // 2 + 1, STEPS - 1)
"""Those of them at which poses alone are compared."""


@dataclass(frozen=True)
class Outcome:
    """What became of a linkage: the sentence that refused it, or what is wrong with its motion."""

    refusal: str = ""
    faults: tuple[str, ...] = ()


def outcome(document: Mapping[str, Any], *, thorough: bool = True) -> Outcome:
    """Return what becomes of a document; an exception is a fault like any other.

    Poses alone, in programs of their own, and what is told of the linkage are looked at where `thorough`.
    """
    try:
        try:
            scene = scene_from(document, name="sweep", where="sweep.toml")
        except LinkanimError as error:
            return Outcome(str(error), tuple(_not_a_sentence(str(error))))
        return Outcome(faults=tuple(faults(scene, document, thorough=thorough)))
    except Exception as error:
        return Outcome(faults=(f"unexpected {type(error).__name__}: {error}",))


def _not_a_sentence(message: str) -> Iterator[str]:
    if "\n" in message or ": " not in message or len(message) > 400:
        yield f"refused in other words than one sentence: {message!r}"


def faults(scene: Scene, document: Mapping[str, Any], *, thorough: bool) -> Iterator[str]:
    """Yield everything that is wrong with a scene's motion over its true period."""
    drives = round(scene.period / (2 * math.pi))
    cycle = scene.solve(phase=np.arange(STEPS * drives) * (2 * math.pi / STEPS), derivatives=0)
    names = tuple(cycle.position)

    def place(phases: Array) -> Array:
        motion = scene.solve(phase=phases, derivatives=0)
        return np.concatenate([motion.position[name] for name in names], axis=1)

    places = {name: np.asarray(cycle.position[name]) for name in names}
    lost = list(not_finite(places))
    yield from lost
    if lost:
        return
    size = longest(places)
    yield from unclosed(document, places, cycle.coordinate, size)
    yield from kinks(place, scene.period, STEPS * drives, size)
    some = np.array([0.3, 1.1, 2.9, 4.0, 5.7])
    turns = [place(some + 2 * math.pi * k) for k in range(drives + 1)]
    yield from not_back(turns[0], turns[1:], size)
    if thorough:
        yield from _alone(scene, places, size)
        yield from _told(scene)


def longest(places: Mapping[str, Array]) -> float:
    """Return the size of the linkage: the greatest extent of its joints' places."""
    return max(float(np.abs(place).max()) for place in places.values())


def _alone(scene: Scene, places: Mapping[str, Array], size: float) -> Iterator[str]:
    for index in ALONE:
        pose = scene.pose(index * (2 * math.pi / STEPS), derivatives=0)
        apart = max(np.abs(pose.position[name] - place[index]).max() for name, place in places.items())
        if apart != 0:
            yield f"a pose alone lies {apart / size:.1e} of the longest link beside that of the batch"
            return


def _told(scene: Scene) -> Iterator[str]:
    info = scene.info
    numbers = [*info.input_range, *info.toggles, *info.change_points, info.period_seconds]
    numbers += [*(info.transmission_angle or ()), info.stroke or 0.0, info.time_ratio or 0.0]
    if not all(math.isfinite(number) for number in numbers):
        yield f"info tells of {numbers}"
