"""A page's pen and surface, and a picture of groups that exist already, to be written as a file."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

import numpy as np
import pygame

from linkanim.frozen import frozen
from linkanim.picture.chart import Pen, line_layer, pen_for
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import layout
from linkanim.picture.look import ThemeName
from linkanim.picture.purpose import USUAL_SIZE
from linkanim.picture.raster import Colour, Layer, offscreen
from linkanim.picture.shapes import disc
from linkanim.picture.surface import printed
from linkanim.picture.text import Type, letters
from linkanim.picture.theme import on_paper, theme_of
from linkanim.picture.view import Rect


def page_pen(size: tuple[int, int], theme: ThemeName, type_scale: float = 1.0, *, ground: bool = True) -> Pen:
    """Return the pen for a page of `size` pixels, words `type_scale` times as large, on a ground or none."""
    known = theme_of(theme)
    return pen_for(layout(size, type_scale=type_scale), letters(), known if ground else on_paper(known))


def page_surface(
    size: tuple[int, int], background: Colour | None, groups: Iterable[Group], type_: Type
) -> pygame.Surface:
    """Return groups drawn on a surface of `size` pixels; it is clear where there is no background."""
    surface = offscreen(size, alpha=background is None)
    if background is not None:
        surface.fill(background)
    printed(surface, groups, type_)
    return surface


@frozen(kw_only=True)
class DrawnPage(ABC):
    """A page of items, `size` pixels large, its words `type_scale` times so; without `ground` it is open."""

    size: tuple[int, int] = USUAL_SIZE
    theme: ThemeName = "light"
    type_scale: float = 1.0
    ground: bool = True

    @cached_property
    def pen(self) -> Pen:
        """What it is drawn with."""
        return page_pen(self.size, self.theme, self.type_scale, ground=self.ground)

    @property
    def background(self) -> Colour | None:
        """The colour under everything; None where it is left open."""
        return self.pen.theme.background if self.ground else None

    @property
    @abstractmethod
    def title(self) -> str:
        """What it shows, in words."""

    @property
    def words(self) -> str:
        """What is seen in it beside its title; nothing, where a kind of page does not say."""
        return ""

    def headed(self, lines: float = 1.4) -> tuple[Caption, Rect]:
        """Return the title at the head, `lines` heights of its text, and the room below it."""
        pen = self.pen
        whole = Rect(0, 0, *self.size).inset(1.2 * pen.small)
        title = Caption(self.title, (whole.x, whole.y), pen.text, pen.theme.ink, strong=True)
        high = lines * pen.text
        return title, whole._replace(y=whole.y + high, height=whole.height - high)

    @abstractmethod
    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front."""

    def groups(self) -> tuple[Group, ...]:
        """Return everything on the page as one group, words over shapes."""
        return (grouped("page", self.items()),)

    def surface(self) -> pygame.Surface:
        """Return the page drawn."""
        return page_surface(self.size, self.background, self.groups(), self.pen.type)


class LegendEntry(NamedTuple):
    """A curve's words, how it is drawn, or a dot; width and dashes in the pen's lines and in pixels."""

    words: str
    colour: Colour
    width: float = 1.4
    dashes: tuple[float, ...] = ()
    dotted: bool = False

    def wide(self, pen: Pen, apart: float = 1.5) -> float:
        """Return how far it is to the next, which is `apart` behind its words, in heights of their text."""
        return (_SWATCH + 0.5 + apart) * pen.small + pen.type.width(self.words, pen.small)

    def items(self, x: float, y: float, pen: Pen) -> Iterator[Item]:
        """Yield the curve's swatch and its words, from the upper left corner on."""
        start = complex(x, y + 0.5 * pen.small)
        if self.dotted:
            yield Layer(self.colour, [start + _SWATCH / 2 * pen.small + disc(1.8 * pen.line)])
        else:
            line = start + np.array([0, _SWATCH * pen.small])
            yield line_layer([line], self.colour, self.width * pen.line, self.dashes)
        yield Caption(self.words, (x + (_SWATCH + 0.5) * pen.small, y), pen.small, pen.theme.ink)


_SWATCH = 2.6
"""How long a curve's swatch is, in heights of its words."""


def legend(
    x: float, y: float, entries: Iterable[LegendEntry], pen: Pen, apart: float = 1.5
) -> Iterator[Item]:
    """Yield which curve is which in one row, from its upper left corner on."""
    for one in entries:
        yield from one.items(x, y, pen)
        x += one.wide(pen, apart)


class Illustration(NamedTuple):
    """A picture of `drawn` groups, back to front, `size` pixels large on a background, with its title."""

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
        return page_surface(self.size, self.background, self.drawn, letters())
