"""What the tests of pictures share: paintings, their pixels, and how far two of them differ."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pygame
from fidelity import Pixels

from linkanim.mechanics.motion import Pose
from linkanim.picture.items import Caption
from linkanim.picture.labels import Names
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Colour, Layer, Shapes, covers, offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

BARE = Look(hud=False)
SMALL = (320, 180)


def painted(
    scene: Scene, phase: float, look: Look = BARE, size: tuple[int, int] = SMALL, *, ghost: Pose | None = None
) -> pygame.Surface:
    """Return one pose of a scene on a new surface."""
    surface = offscreen(size, alpha=not look.background)
    SurfacePrinter().paint(
        surface, Picture(scene, size, look), scene.pose(phase), faint=(ghost,) if ghost else ()
    )
    return surface


def filled(
    layers: list[Layer],
    size: tuple[int, int] = (64, 64),
    *,
    background: int = 0,
    alpha: bool = False,
    ends: tuple[int, int] | None = None,
) -> pygame.Surface:
    """Return layers on a plain surface."""
    surface = offscreen(size, alpha=alpha)
    surface.fill((background,) * 3 + (0 if alpha else 255,))
    covers(surface, [Shapes(layers, ends)])[0].put(surface)
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


def inked(surface: pygame.Surface, where: Rect, colour: Colour) -> bool:
    """Return whether some of a rectangle has a colour, or nearly."""
    x, y, right, bottom = (round(side) for side in (where.x, where.y, where.right, where.bottom))
    away = np.abs(pixels(surface)[max(y, 0) : bottom, max(x, 0) : right] - colour).max(axis=-1)
    return bool((away < 40).any())


def place_of(caption: Caption, type_: Type) -> Rect:
    """Return where a line of text stands."""
    wide = type_.width(caption.text, caption.size, strong=caption.strong)
    left = caption.at[0] - wide * {"left": 0.0, "centre": 0.5, "right": 1.0}[caption.anchor]
    return Rect(left, caption.at[1], wide, caption.size)


def contrast(one: Colour, other: Colour) -> float:
    """Return the contrast of two colours, 1 to 21, as WCAG 2 defines it."""
    darker, lighter = sorted((_luminance(one), _luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: Colour) -> float:
    parts = [value / 255 for value in colour]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def labelled(picture: Picture) -> Names:
    """Return the names that a picture has."""
    assert picture.names is not None
    return picture.names


def standing(picture: Picture, pose: Pose) -> Iterator[tuple[str, Rect]]:
    """Yield what is written and the rectangle it takes, for every label that shows."""
    names, places = labelled(picture), picture.drawing.places(pose)
    for label, middle, shown in names.standing(pose, places):
        wide, high = label.size
        if shown:
            yield label.text, Rect(middle.real - wide / 2, middle.imag - high / 2, wide, high)
