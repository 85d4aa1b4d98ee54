"""A changed length is followed smoothly: the scenes between the old one and the new."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkanim.errors import LinkanimError
from linkanim.scenes.edit import dimensions, passing
from linkanim.scenes.joints import Key
from linkanim.scenes.scene import Scene

FRAMES = 16
EVERY = 2
"""A scene on the way stands for so many frames: working one out takes as long as drawing two."""
_TRIED = 90
_FOLLOWED = ("length", "offset", "angle")


@dataclass(frozen=True)
class Glide:
    """Dimensions on their way since frame `since`: (key, from, to), and the scene shown meanwhile."""

    scene: Scene
    since: int
    ways: tuple[tuple[Key, float, float], ...]


def glide(before: Scene, after: Scene, frame: int) -> Glide | None:
    """Return the way from one scene to the other; None where no length or angle differs."""
    old = {item.key: item for item in dimensions(before)}
    ways = tuple(
        (item.key, old[item.key].value, item.value)
        for item in dimensions(after)
        if item.kind in _FOLLOWED and item.key in old
        if item.unit == old[item.key].unit and item.value != old[item.key].value
    )
    return Glide(before, frame, ways) if ways else None


def followed(way: Glide, after: Scene, frame: int) -> Glide | None:
    """Return the glide at `frame`; None when `after` is reached.

    A scene on the way that cannot be assembled all along is left out: the last one stays.
    """
    gone = frame - way.since
    if gone >= FRAMES:
        return None
    if gone % EVERY:
        return way
    part = gone / FRAMES
    eased = part * part * (3.0 - 2.0 * part)
    try:
        scene = passing(after, {key: start + (end - start) * eased for key, start, end in way.ways})
    except LinkanimError:
        return way
    return Glide(scene, way.since, way.ways) if closes(scene) else way


def closes(scene: Scene) -> bool:
    """Tell whether every joint is somewhere at all phases."""
    places = scene.cycle(_TRIED).position.values()
    return all(bool(np.isfinite(place).all()) for place in places)
