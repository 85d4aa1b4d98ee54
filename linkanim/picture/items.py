"""What a chart or a page is made of: filled shapes and captions, for a surface and a file alike."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import pygame

from linkanim.picture.raster.raster import Colour, Layer, paint
from linkanim.picture.text.lettering import Lettering
from linkanim.picture.text.text import Anchor, Type


class Halo(NamedTuple):
    """A rim round letters that parts them from what is below: its colour and width in pixels."""

    colour: Colour
    width: float


class Caption(NamedTuple):
    """One line of text; `at` is its top, at its left, middle or right as `anchor` says."""

    text: str
    at: tuple[float, float]
    size: int
    colour: Colour
    anchor: Anchor = "left"
    strong: bool = False
    halo: Halo | None = None


Item = Layer | Caption


class Group(NamedTuple):
    """Shapes that belong together, under a name, and the words over them."""

    name: str
    layers: Sequence[Layer]
    captions: Sequence[Caption] = ()


def grouped(name: str, items: Iterable[Item]) -> Group:
    """Return items under a name, the words over the shapes."""
    kept = list(items)
    shapes = [item for item in kept if isinstance(item, Layer)]
    return Group(name, shapes, [item for item in kept if isinstance(item, Caption)])


def flat(groups: Iterable[Group]) -> Iterator[Layer]:
    """Yield the shapes of all groups in their order."""
    return (layer for group in groups for layer in group.layers)


def worded(groups: Iterable[Group]) -> Iterator[Caption]:
    """Yield the words of all groups in their order."""
    return (caption for group in groups for caption in group.captions)


class Scribe:
    """Draws items on surfaces; the words that it has set in a halo once it keeps."""

    def __init__(self, type_: Type) -> None:
        self._type = type_
        self._set: dict[tuple[str, int, Colour, Halo], Lettering] = {}

    def draw(self, surface: pygame.Surface, items: Iterable[Item]) -> None:
        """Draw items in their order; changes the surface only."""
        shapes: list[Layer] = []
        for item in items:
            if isinstance(item, Layer):
                shapes.append(item)
                continue
            if shapes:
                paint(surface, shapes)
                shapes.clear()
            self._write(surface, item)
        if shapes:
            paint(surface, shapes)

    def _write(self, surface: pygame.Surface, line: Caption) -> None:
        """Draw a line of text; one in a halo to a part of a pixel, as labels on a drawing are."""
        text, at, size, colour, anchor, strong, halo = line
        if halo is None:
            self._type.draw(surface, text, at, size=size, colour=colour, anchor=anchor, strong=strong)
            return
        letters = self._letters(text, size, colour, halo)
        aside = {"left": 0.5, "centre": 0.0, "right": -0.5}[anchor] * letters.size[0]
        letters.draw(surface, complex(at[0] + aside, at[1] + letters.drop))

    def _letters(self, text: str, size: int, colour: Colour, halo: Halo) -> Lettering:
        key = (text, size, colour, halo)
        if key not in self._set:
            self._set[key] = Lettering(text, self._type, size, (colour, halo.colour), halo.width)
        return self._set[key]


def draw(surface: pygame.Surface, items: Iterable[Item], type_: Type) -> None:
    """Draw items in their order on a surface, once."""
    Scribe(type_).draw(surface, items)
