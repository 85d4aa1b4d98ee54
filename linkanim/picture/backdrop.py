"""What stands still in a picture, and what moves behind a part of it."""

from __future__ import annotations

from typing import NamedTuple

import pygame

from linkanim.picture.blend import Mix


class Backdrop(NamedTuple):
    """What stands still: what lies `behind` the wheels, what is in `front` of them, and the `whole`."""

    behind: pygame.Surface
    front: Mix | None
    whole: pygame.Surface


def wipe(surface: pygame.Surface, still: pygame.Surface, area: pygame.Rect | None = None) -> None:
    """Bring a surface, or an area of it, to what stands still there."""
    if is_clear(surface):
        surface.fill((0, 0, 0, 0), area)
    surface.blit(still, area or (0, 0), area)


def is_clear(surface: pygame.Surface) -> bool:
    """Return whether a surface lets light through."""
    return bool(surface.get_flags() & pygame.SRCALPHA)
