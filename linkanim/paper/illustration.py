"""A picture of groups that are at hand, to be written as a file."""

from __future__ import annotations

import pygame

from linkanim.frozen import NamedTuple
from linkanim.picture.items import Group
from linkanim.picture.raster import Colour, offscreen
from linkanim.picture.surface import printed
from linkanim.picture.text import Type


class Illustration(NamedTuple):
    """All that is drawn, back to front, in so many pixels over a background, and what it shows in words."""

    title: str
    size: tuple[int, int]
    background: Colour
    drawn: tuple[Group, ...]

    @property
    def words(self) -> str:
        """Nothing more than its title says."""
        return ""

    def groups(self) -> tuple[Group, ...]:
        """Return all that is drawn."""
        return self.drawn

    def surface(self) -> pygame.Surface:
        """Return the picture drawn."""
        surface = offscreen(self.size)
        surface.fill(self.background)
        printed(surface, self.drawn, Type())
        return surface
