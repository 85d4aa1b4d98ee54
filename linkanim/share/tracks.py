"""Where joints run in pixels, as nodes between which a quintic is close enough for the largest screens.

A node has the position and its first two derivatives by phase, from the solver; between two nodes runs the
polynomial of fifth degree that has them at both ends (Hermite). Nodes lie where they are needed. Of a scene
that comes back by the way it came they are those of the way there: at its ends rates change sign at once.
"""

from __future__ import annotations

import base64
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.motion.motion import Motion
from linkanim.picture.figure import DOWN
from linkanim.picture.raster.raster import Loop
from linkanim.picture.view import View
from linkanim.scenes.scene import Scene

GRID = 1 << 16
"""Nodes lie at whole numbers of so many parts of the true period."""
NEAR = 3e-4
"""How far off a curve may be between its nodes, in pixels of the picture: 0.0012 at 3840 × 2160."""
_FIRST = 16
"""Into how many parts of a drive's turn a curve is cut at first, at the least."""
_PROBES = (0.25, 0.5, 0.75)
"""Where between two nodes is looked how far off it is."""
_STEPS = 1 << 30
"""Of positions, to the farthest of all."""
LARGEST = float(np.finfo(np.float32).max)
"""What 32 bits hold at the most: of rates beside a place where they are unbounded no more is kept."""
_NOWHERE = complex(-1e4, -1e4)
"""Where a joint lies that is nowhere (NaN)."""

Whole = NDArray[np.int64]


def centre(body: str) -> str:
    """Return what a body's centre of mass is called among the points."""
    return f"{body} (centre of mass)"


@dataclass(frozen=True)
class Track:
    """A point's nodes: places on the grid (n,), positions in pixels x + yi (n,), derivatives (2, n)."""

    nodes: Whole
    places: Loop
    rates: Loop


def tracks(scene: Scene, view: View) -> dict[str, Track]:
    """Return the tracks of all joints and centres of mass over one true period of phase, or its way there."""
    joints = scene.linkage.joints
    centres = (centre(body.name) for body in scene.linkage.bodies if body.com is not None)
    names, fixed = (*(one.name for one in joints), *centres), {one.name for one in joints if one.fixed}
    first = min(max(_FIRST, 1 << math.ceil(math.log2(_FIRST * scene.period / math.tau))), GRID)
    step = GRID // first
    end = GRID // 2 if scene.mechanism.retraced else GRID
    begins = {name: np.arange(0, end if name not in fixed else 1, step) for name in names}
    nodes = {name: [some] for name, some in begins.items()}
    open_ = {name: some for name, some in begins.items() if name not in fixed}
    while open_ and step >= 1 / min(_PROBES):
        open_ = dict(_halved(open_, _Solved(scene, view, names, _looked_at(open_, step)), step))
        step //= 2
        for name, some in open_.items():
            nodes[name].append(some)
    for name in begins.keys() - fixed if end < GRID else ():
        nodes[name].append(np.array([end]))
    kept = {name: np.unique(np.concatenate(some)) for name, some in nodes.items()}
    solved = _Solved(scene, view, names, np.unique(np.concatenate([*kept.values()])))
    return {name: solved.track(name, some) for name, some in kept.items()}


def _looked_at(open_: Mapping[str, Whole], step: int) -> Whole:
    """Return the places on the grid at which stretches begin and end, and are looked at between."""
    shares = np.array((0.0, *_PROBES, 1.0)) * step
    begins = np.unique(np.concatenate([*open_.values()]))
    found: Whole = np.unique(np.add.outer(begins, shares.astype(np.int64)) % GRID)
    return found


def _halved(open_: Mapping[str, Whole], solved: _Solved, step: int) -> Iterator[tuple[str, Whole]]:
    """Yield both halves of the stretches that are too far off."""
    width = solved.scene.period * step / GRID
    for name, begins in open_.items():
        ends = (begins + step) % GRID
        course = quintic(solved.at(name, begins), solved.at(name, ends), width)
        shares = np.array(_PROBES)[:, None]
        true = solved.at(name, begins + (shares * step).astype(np.int64))[0]
        off = np.abs(evaluated(course, shares) - true).max(axis=0)
        far = begins[off > NEAR]
        if far.size:
            yield name, np.sort(np.concatenate((far, far + step // 2)))


class _Solved:
    """The points at places on the grid, solved at once."""

    def __init__(self, scene: Scene, view: View, names: Sequence[str], grid: Whole) -> None:
        self.scene, self._grid = scene, grid
        motion = scene.solve(phase=grid * (scene.period / GRID), speed=1.0)
        self._known = dict(zip(names, _pixels(motion, scene, view), strict=True))

    def at(self, name: str, places: Whole) -> Loop:
        """Return position and derivatives (3, …) at places on the grid."""
        found: Loop = self._known[name][:, np.searchsorted(self._grid, places)]
        return found

    def track(self, name: str, nodes: Whole) -> Track:
        """Return a point's track through nodes."""
        found = self.at(name, nodes)
        return Track(nodes, found[0], found[1:])


def _pixels(motion: Motion, scene: Scene, view: View) -> Iterator[Loop]:
    """Yield each point's position and derivatives (3, n) in pixels; what is not known does not move."""
    joints = (joint.name for joint in scene.linkage.joints)
    centres = (body.name for body in scene.linkage.bodies if body.com is not None)
    kinds: tuple[Any, ...] = (motion.position, motion.velocity, motion.acceleration)
    of_mass: tuple[Any, ...] = (motion.com_position, motion.com_velocity, motion.com_acceleration)
    for some, names in ((kinds, joints), (of_mass, centres)):
        for name in names:
            found = np.stack([np.broadcast_to(kind[name] @ DOWN, motion.phase.shape) for kind in some])
            found = view.scale * found + np.array([[complex(view.x, view.y)], [0], [0]])
            yield np.where(np.isfinite(found), found, np.array([[_NOWHERE], [0], [0]]))


def quintic(begin: Loop, end: Loop, width: float) -> Loop:
    """Return the coefficients (6, n), lowest first, of what runs from 0 to 1 between two nodes (3, n)."""
    scale = np.array([1.0, width, 0.5 * width * width])[:, None]
    (p, v, a), (q, w, b) = scale * begin, scale * end
    way = q - p
    return np.stack(
        (
            p,
            v,
            a,
            10 * way - 6 * v - 4 * w - 3 * a + b,
            -15 * way + 8 * v + 7 * w + 3 * a - 2 * b,
            6 * way - 3 * (v + w) - a + b,
        )
    )


def evaluated(coefficients: Loop, share: Any) -> Any:
    """Return a polynomial's values (Horner)."""
    value = coefficients[-1]
    for one in coefficients[-2::-1]:
        value = value * share + one
    return value


def packed_tracks(found: Mapping[str, Track]) -> dict[str, Any]:
    """Return tracks as a page holds them: whole steps of a `grain` in 32 bits, rates as 32-bit floats."""
    farthest = max((float(np.abs(_parts(track.places)).max()) for track in found.values()), default=1.0)
    grain = farthest / _STEPS
    return {
        "grain": grain,
        "points": {
            name: [
                packed(track.nodes, "<u2"),
                packed(np.rint(_parts(track.places) / grain), "<i4"),
                packed(np.clip(_parts(track.rates.T), -LARGEST, LARGEST), "<f4"),
            ]
            for name, track in found.items()
        },
    }


def _parts(values: Loop) -> NDArray[np.float64]:
    """Return real and imaginary parts one after the other."""
    found: NDArray[np.float64] = np.ascontiguousarray(values).view(np.float64)
    return found


def packed(values: Any, kind: str) -> str:
    """Return numbers of a kind, such as "<f4", in base 64."""
    return base64.b64encode(np.ascontiguousarray(values, kind).tobytes()).decode("ascii")
