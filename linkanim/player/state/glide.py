"""A changed length is followed smoothly: the scenes between the old one and the new."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from linkanim.errors import LinkanimError
from linkanim.picture.view import eased
from linkanim.scenes.editing.edit import dimensions, passing
from linkanim.scenes.fields.form import Key
from linkanim.scenes.scene import Scene

FRAMES = 16
EVERY = 2
"""A scene on the way stands for so many frames: one is worked out in the last of them, and then drawn."""
_TRIED = 90
_FOLLOWED = ("length", "offset", "angle")


@dataclass(frozen=True)
class Glide:
    """Dimensions on their way since frame `since`: (key, from, to), and the scene shown meanwhile.

    `coming` is the one that is worked out for the next frame, if any.
    """

    scene: Scene
    since: int
    ways: tuple[tuple[Key, float, float], ...]
    coming: Scene | None = None


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
    gone = frame + 1 - way.since
    if gone > FRAMES:
        return None
    if gone % EVERY == 0 and gone < FRAMES:
        return replace(way, coming=_on_the_way(way, after, gone / FRAMES))
    return replace(way, scene=way.coming, coming=None) if way.coming else way


def _on_the_way(way: Glide, after: Scene, part: float) -> Scene | None:
    """Return the scene after a part of the way; None where it cannot be assembled all along."""
    try:
        scene = passing(after, {key: start + (end - start) * eased(part) for key, start, end in way.ways})
    except LinkanimError:
        return None
    return scene if closes(scene) else None


def closes(scene: Scene) -> bool:
    """Tell whether every joint is somewhere at all phases; worked out as its poses are, all in one pass."""
    places = scene.cycle(_TRIED).every["position"].values()
    return all(bool(np.isfinite(place).all()) for place in places)
