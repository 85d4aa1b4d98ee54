"""How true a picture is: against sixty-four samples a pixel, and how far a slow bar strays from its place."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.motion import Pose
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Layer, offscreen, paint, pixel_view
from linkanim.picture.shapes import rounded
from linkanim.picture.surface import printed
from linkanim.picture.view import View
from linkanim.scenes.scene import Scene

Pixels = NDArray[np.float64]

SIZE = (320, 180)
LOOK = Look(hud=False, vectors=frozenset("va"), material="flat")
"""Text stays out, and what stands beside it: it is not drawn larger by the same factor as all else."""
_BESIDE = ("slots", "key")
PHASES = (0.0, 1.0, 2.5, 4.0, 5.5)
_FINER = 8


def frame_decibels(scene: Scene, phases: Sequence[float] = PHASES) -> float:
    """Return the worst PSNR of frames against the mean of 64 samples a pixel of the same drawing, in dB."""
    small = Picture(scene, SIZE, LOOK)
    home = View(_FINER * small.view.scale, _FINER * small.view.x, _FINER * small.view.y)
    large = Picture(scene, (_FINER * SIZE[0], _FINER * SIZE[1]), LOOK, view=home)
    poses = [scene.pose(phase) for phase in phases]
    return min(psnr(_painted(small, pose), averaged(_painted(large, pose), _FINER)) for pose in poses)


def jitter(*, steps: int = 60) -> float:
    """Return how far the centre of a slowly moving bar lies from where it should be, in px rms."""
    bar, turn = rounded([0j, complex(300, 0)], 9.0), np.exp(0.03j)
    places = [complex(12.3 + 0.037 * step, 60.1 + 0.051 * step) for step in range(steps)]
    away = [abs(centre(_white(place + turn * bar)) - (place + turn * 150)) for place in places]
    return sqrt(np.mean(np.square(away)))


def averaged(picture: Pixels, by: int) -> Pixels:
    """Return the mean of each square of `by` × `by` pixels of a (height, width, n) picture."""
    height, width, depth = picture.shape
    mean: Pixels = picture.reshape(height // by, by, width // by, by, depth).mean(axis=(1, 3))
    return mean


def psnr(one: Pixels, other: Pixels) -> float:
    """Return the peak signal-to-noise ratio of two pictures of 0 to 255 in dB, infinite where equal."""
    error = float(np.mean((one - other) ** 2))
    return 10 * float(np.log10(255**2 / error)) if error else float("inf")


def centre(cover: Pixels) -> complex:
    """Return the centre of gravity of a (height, width) coverage in any unit, pixel (0, 0) from 0 to 1."""
    rows, columns = np.indices(cover.shape) + 0.5
    return complex((columns * cover).sum(), (rows * cover).sum()) / float(cover.sum())


def _painted(painter: Picture, pose: Pose) -> Pixels:
    surface = offscreen(painter.size)
    surface.fill(painter.theme.background)
    groups = (group._replace(captions=()) for group in painter.groups(pose) if group.name not in _BESIDE)
    printed(surface, groups, painter.type)
    return _levels(bytes(pixel_view(surface)), painter.size)


def _white(bar: NDArray[np.complex128]) -> Pixels:
    size = (340, 120)
    surface = offscreen(size)
    paint(surface, [Layer((255, 255, 255), [bar])])
    return _levels(bytes(pixel_view(surface)), size)[..., 0]


def _levels(data: bytes, size: tuple[int, int]) -> Pixels:
    levels: Pixels = np.frombuffer(data, np.uint8).reshape(size[1], size[0], 4)[..., :3].astype(float)
    return levels
