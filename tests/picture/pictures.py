"""What the tests of pictures share: paintings, their pixels, and how far two of them differ."""

from __future__ import annotations

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.mechanics.motion import Pose
from linkanim.picture.look import Look
from linkanim.picture.offscreen import offscreen
from linkanim.picture.overlay import Overlay
from linkanim.picture.painter import Painter
from linkanim.picture.raster import Layer, paint
from linkanim.scenes.scene import Scene

Pixels = NDArray[np.float64]
BARE = Look(hud=False)
SMALL = (320, 180)


def painted(
    scene: Scene, phase: float, look: Look = BARE, size: tuple[int, int] = SMALL, *, ghost: Pose | None = None
) -> pygame.Surface:
    """Return one pose of a scene on a new surface."""
    surface = offscreen(size, alpha=not look.background)
    Painter(scene, size, look).paint(surface, scene.pose(phase), Overlay(), ghost=ghost)
    return surface


def filled(
    layers: list[Layer], size: tuple[int, int] = (64, 64), *, background: int = 0, alpha: bool = False
) -> pygame.Surface:
    """Return layers on a plain surface."""
    surface = offscreen(size, alpha=alpha)
    surface.fill((background,) * 3 + (0 if alpha else 255,))
    paint(surface, layers)
    return surface


def pixels(surface: pygame.Surface) -> Pixels:
    """Return the surface's colours as (height, width, 3), 0 to 255."""
    return pygame.surfarray.array3d(surface).transpose(1, 0, 2).astype(float)


def alphas(surface: pygame.Surface) -> Pixels:
    """Return the surface's opacity as (height, width), 0 to 255."""
    return pygame.surfarray.array_alpha(surface).T.astype(float)


def coverage(surface: pygame.Surface) -> Pixels:
    """Return how far white covers black in each pixel, 0 to 1."""
    return pixels(surface)[..., 0] / 255


def centre(cover: Pixels) -> complex:
    """Return the centre of gravity of a coverage, pixel (0, 0) reaching from 0 to 1."""
    rows, columns = np.indices(cover.shape) + 0.5
    return complex((columns * cover).sum(), (rows * cover).sum()) / float(cover.sum())


def averaged(picture: Pixels, by: int) -> Pixels:
    """Return the mean of each square of `by` × `by` pixels."""
    height, width, depth = picture.shape
    mean: Pixels = picture.reshape(height // by, by, width // by, by, depth).mean(axis=(1, 3))
    return mean


def psnr(one: Pixels, other: Pixels) -> float:
    """Return the peak signal-to-noise ratio of two pictures in dB."""
    error = float(np.mean((one - other) ** 2))
    return 10 * float(np.log10(255**2 / error)) if error else float("inf")
