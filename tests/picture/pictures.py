"""What the tests of pictures share: paintings, their pixels, and how far two of them differ."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pygame
from fidelity import Pixels

from linkanim.frozen import frozen
from linkanim.mechanics.motion import Pose
from linkanim.picture.game_panel import GamePanel
from linkanim.picture.layout import NOTHING_DOCKED, Docked, Layout, layout, with_side
from linkanim.picture.lists import ListPanel
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Colour, Layer, Shapes, covers, offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.view import Rect
from linkanim.player.helping import Help
from linkanim.player.keys import KeyRow, ModeKeys
from linkanim.player.state import Mode, State, begin
from linkanim.scenes.scene import Scene
from linkanim.ui.panels import Panels

BARE = Look(hud=False)
FEW = ModeKeys("few", {"in a test": (KeyRow("Esc", "close"),)})
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


@frozen
class Shows(Mode):
    """A mode that shows a list, and says something at the foot."""

    listed: ListPanel | GamePanel | None = None
    words: str = ""
    keys = FEW

    def panel(self, state: State) -> ListPanel | GamePanel | None:
        del state
        return self.listed

    def says(self, state: State) -> str:
        del state
        return self.words


def stated(
    listed: ListPanel | GamePanel | None = None, words: str = "", *, helped: bool = False, **changes: Any
) -> State:
    """Return a state with a list, words at the foot, the help."""
    modes = (Shows(listed, words), *((Help(),) if helped else ()))
    return replace(begin("crank-rocker"), modes=modes, **changes)


def with_panels(picture: Picture, phase: float, state: State | None = None) -> pygame.Surface:
    """Return a pose of a picture on a new surface, with the panels of a state over it."""
    surface = offscreen(picture.size)
    SurfacePrinter().paint(surface, picture, picture.scene.pose(phase))
    for one in Panels().drawn(state, picture.layout, picture.theme)[0] if state else ():
        surface.blit(one.surface, one.at)
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


def contrast(one: Colour, other: Colour) -> float:
    """Return the contrast of two colours, 1 to 21, as WCAG 2 defines it."""
    darker, lighter = sorted((_luminance(one), _luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: Colour) -> float:
    parts = [value / 255 for value in colour]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def standing(picture: Picture, pose: Pose) -> Iterator[tuple[str, Rect]]:
    """Yield what each label says and the rectangle of its line."""
    places = picture.drawing.places(pose)
    for line in picture.names.captions(places, picture.drawing.setting):
        yield line.text, line.around(picture.type)


def window(
    size: tuple[int, int],
    charts: int = 0,
    polygons: int = 0,
    *,
    beside: bool = False,
    docked: Docked = NOTHING_DOCKED,
) -> Layout:
    """Return the slots of a window with charts and polygons."""
    return with_side(layout(size, docked=docked), charts, polygons, beside=beside)
