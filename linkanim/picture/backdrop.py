"""What stands still in a picture, and what moves behind a part of it."""

from __future__ import annotations

from typing import NamedTuple

import pygame

from linkanim.picture.raster.blend import Mix
from linkanim.picture.raster.raster import is_clear


class Backdrop(NamedTuple):
    """What stands still: what lies `behind` the wheels, what is in `front` of them, and the `whole`."""

    behind: pygame.Surface
    front: Mix | None
    whole: pygame.Surface


def wipe(surface: pygame.Surface, still: pygame.Surface) -> None:
    """Bring a surface to what stands still."""
    if is_clear(surface):
        surface.fill((0, 0, 0, 0))
    surface.blit(still, (0, 0))
