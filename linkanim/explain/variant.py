"""A scene with other round lengths and the same kind of motion, for an exercise."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from math import floor, log10
from random import Random

import numpy as np

from linkanim.errors import LinkanimError
from linkanim.scenes.editing import dimensions, with_dimensions
from linkanim.scenes.form import LENGTHS, Key
from linkanim.scenes.scene import Scene

_TRIES, _FEW = 60, 20
"""How often lengths are drawn for a scene of few joints; those of one of more hardly ever keep its motion."""
_LEAST, _MOST = 0.8, 1.25
_PLACES = 48
"""Of a path that are looked at."""
_NOTHING = 1e-9
"""Of the linkage's size, or of a radian: less is rounding."""
_SIMILAR = (0.5, 0.6, 0.8, 1.2, 1.5, 2.0)


def variant(scene: Scene, seed: int, fits: Callable[[Scene], bool]) -> Scene:
    """Return the scene with other lengths, always the same for one seed.

    Its class is the same, and so is whether its input turns fully, how many change points there are, which
    joints run along straight lines or circles and which bodies never turn; it `fits` what else is wanted. Its
    title says that the lengths are others. Lengths are round, and those that are equal stay so. Where no such
    lengths are found all are larger or smaller alike.
    """
    random, kind, shapes = Random(seed), _kind(scene), _shapes(scene)
    for values in _choices(scene, random):
        try:
            found = with_dimensions(scene, values)
            if _kind(found) == kind and _shapes(found) == shapes and fits(found):
                return replace(found, title=f"{found.title}, with other lengths")
        except LinkanimError:
            continue
    return scene


def _choices(scene: Scene, random: Random) -> Iterator[Mapping[Key, float]]:
    lengths = {item.key: item.value for item in dimensions(scene) if item.kind in LENGTHS and item.value}
    crowd = max(len(scene.linkage.joints) / _FEW, 1.0)
    for _ in range(max(int(_TRIES / crowd**2), 1)):
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


def _shapes(scene: Scene) -> tuple[dict[str, tuple[int, ...]], frozenset[str]]:
    """Return what is special about its paths: of each joint's the dimensions, and the bodies that never turn.

    The points of a path, and with their squares of distance, span a space: of a line 2 and 3 dimensions,
    of a circle 3 and 3, of any other curve 3 and 4.
    """
    cycle = scene.cycle(scene.mechanism.count(_PLACES), derivatives=0)
    size = max(scene.linkage.longest, float(np.ptp(list(cycle.position.values()))))
    spans = {}
    for name, place in cycle.position.items():
        x, y = (place - place.mean(axis=0)).T / size
        rows = np.stack([np.ones(len(x)), x, y, x * x + y * y])
        spans[name] = tuple(int(np.linalg.matrix_rank(some, tol=_NOTHING)) for some in (rows[:3], rows))
    still = frozenset(name for name, angle in cycle.angle.items() if np.ptp(angle) < _NOTHING)
    return spans, still
