"""A scene with other round lengths and the same kind of motion, for an exercise."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from math import degrees, floor, log10, radians
from random import Random
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import LinkanimError
from linkanim.scenes.editing import dimensions, with_dimensions
from linkanim.scenes.form import LENGTHS, Key
from linkanim.scenes.scene import PosesPurpose, Purpose, Scene, TimeRatioPurpose
from linkanim.synthesis.constructions import is_synthesised
from linkanim.words import said

_TRIES, _FEW = 60, 20
"""How often lengths are drawn for a scene of few joints, and how many are few; for more it is less often."""
_LEAST, _MOST = 0.8, 1.25
_PLACES = 48
"""Points of a path that are examined."""
_NOTHING = 1e-9
"""A share of the linkage's size, or radians, below which a difference is rounding."""
_TRIES_ANEW, _FREE = 12, 4
_NEAR, _TURN = 0.15, 12.0
"""How far new poses lie from the given ones at most: a share of their extent, and degrees."""
_SIMILAR = (0.5, 0.6, 0.8, 1.2, 1.5, 2.0)


def variant(scene: Scene, seed: int, fits: Callable[[Scene], bool]) -> Scene:
    """Return the scene with other lengths, always the same for one seed.

    Its class is the same, and so is whether its input turns fully, how many change points there are, which
    joints run along straight lines or circles and which bodies never turn; it also `fits`, as the caller
    asks. Its title says that the lengths are others. Lengths are round, and equal ones stay equal. Where no
    such lengths are found, all are scaled by one factor; where that fails too, the scene comes back
    unchanged.

    A scene that was synthesised for poses or a time ratio gets others of these, in round numbers, and the
    linkage that is synthesised for them.
    """
    random = Random(seed)
    if scene.purpose is not None and is_synthesised(scene):
        for made in _made_anew(scene, scene.purpose, random):
            if fits(made):
                return made
    kind, shapes = _kind(scene), _shapes(scene)
    for values in _choices(scene, random):
        try:
            found = with_dimensions(scene, values)
            if _kind(found) == kind and _shapes(found) == shapes and fits(found):
                return replace(found, title=said("{title}, with other lengths", title=said(found.title)))
        except LinkanimError:
            continue
    return scene


def _made_anew(scene: Scene, purpose: Purpose, random: Random) -> Iterator[Scene]:
    """Yield linkages for other poses, or for other time ratios."""
    # the synthesis is imported only where it is needed: most scenes get other lengths
    from linkanim.synthesis.guidance import guide
    from linkanim.synthesis.quick_returns import quick_return

    sliding = "O4" not in {pin.name for pin in scene.linkage.pins}
    stated: dict[str, Any] = {"unit": scene.length_unit, "name": scene.name, "source": scene.source}
    for _ in range(_TRIES_ANEW):
        try:
            if isinstance(purpose, PosesPurpose):
                kind = "slider-crank" if sliding else "four-bar"
                poses = _other_poses(np.array(purpose.poses), random)
                title = said("{title}, with other poses", title=said(scene.title))
                # five poses leave no choice: the few linkages for them usually have defects
                made = [
                    replace(one.scene, title=title)
                    for one in guide(poses, kind=kind, count=1, **stated)
                    if not one.defects or len(poses) > _FREE
                ]
            elif isinstance(purpose, TimeRatioPurpose):
                made = [one.scene for one in quick_return(**_other_ratio(purpose, random), count=1, **stated)]
            else:
                return
        except LinkanimError:
            continue
        yield from made


def _other_poses(poses: NDArray[np.float64], random: Random) -> NDArray[np.float64]:
    """Return poses that are near by, places in two digits of their size and angles in whole degrees."""
    size = float(np.ptp(poses[:, :2], axis=0).max()) or 1.0
    step = 10.0 ** (floor(log10(size)) - 1)
    rows = []
    for x, y, angle in poses.tolist():
        place = [round((at + random.uniform(-_NEAR, _NEAR) * size) / step) * step for at in (x, y)]
        turned = round(degrees(angle) + random.uniform(-_TURN, _TURN))
        rows.append((*(float(f"{at:.12g}") for at in place), radians(turned)))
    return np.array(rows)


def _other_ratio(purpose: TimeRatioPurpose, random: Random) -> dict[str, Any]:
    """Return a time ratio in hundredths, with a stroke in two digits or a swing in whole degrees."""
    factors = [random.uniform(_LEAST, _MOST) for _ in range(2)]
    found: dict[str, Any] = {"ratio": round(1 + (purpose.ratio - 1) * factors[0], 2)}
    if purpose.swing is not None:
        return found | {"swing": radians(round(degrees(purpose.swing) * factors[1]))}
    return found | {"stroke": _round((purpose.stroke or 1.0) * factors[1])}


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
    """Return what is special about a scene's motion: each path's dimensions, and the bodies that never turn.

    They are the dimensions of the space that (1, x, y) of a path's points span, and (1, x, y, x² + y²): for a
    line 2 and 3, for a circle 3 and 3, for any other curve 3 and 4.
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
