"""A scene with other round lengths and the same kind of motion, for an exercise."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import floor, log10
from random import Random

from linkanim.errors import LinkanimError
from linkanim.scenes.editing.edit import dimensions, with_dimensions
from linkanim.scenes.fields.form import Key
from linkanim.scenes.fields.types import LENGTHS
from linkanim.scenes.scene import Scene

_TRIES = 60
_LEAST, _MOST = 0.8, 1.25
_SIMILAR = (0.5, 0.6, 0.8, 1.2, 1.5, 2.0)


def variant(scene: Scene, seed: int, fits: Callable[[Scene], bool]) -> Scene:
    """Return the scene with other lengths, always the same for one seed.

    Its class is the same, and so is whether its input turns fully and how many change points there are; it
    `fits` what else is wanted. Lengths are round, and those that are equal stay so. Where no such lengths are
    found all are larger or smaller alike.
    """
    random = Random(seed)
    for values in _choices(scene, random):
        try:
            found = with_dimensions(scene, values)
            if _kind(found) == _kind(scene) and fits(found):
                return found
        except LinkanimError:
            continue
    return scene


def _choices(scene: Scene, random: Random) -> Iterator[Mapping[Key, float]]:
    lengths = {item.key: item.value for item in dimensions(scene) if item.kind in LENGTHS and item.value}
    for _ in range(_TRIES):
        factors = {size: random.uniform(_LEAST, _MOST) for size in dict.fromkeys(map(abs, lengths.values()))}
        yield {key: _round(value * factors[abs(value)]) for key, value in lengths.items()}
    for factor in random.sample(_SIMILAR, len(_SIMILAR)):
        yield {key: float(f"{value * factor:.12g}") for key, value in lengths.items()}


def _round(value: float) -> float:
    """Return a number in two significant digits."""
    return round(value, 1 - floor(log10(abs(value))))


def _kind(scene: Scene) -> tuple[str, bool, int, int]:
    info = scene.info
    return info.class_name, info.full_turn, len(info.toggles), len(info.change_points)
