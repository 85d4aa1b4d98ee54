"""What a chart or a page is made of: filled shapes and captions, for a surface and a file alike."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import pygame

from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.text import Anchor, Type


class Caption(NamedTuple):
    """One line of text; `at` is its top, at its left, middle or right as `anchor` says."""

    text: str
    at: tuple[float, float]
    size: int
    colour: Colour
    anchor: Anchor = "left"
    strong: bool = False


Item = Layer | Caption


class Group(NamedTuple):
    """Shapes that belong together, under a name."""

    name: str
    layers: Sequence[Layer]


def flat(groups: Iterable[Group]) -> Iterator[Layer]:
    """Yield the shapes of all groups in their order."""
    return (layer for group in groups for layer in group.layers)


def draw(surface: pygame.Surface, items: Iterable[Item], type_: Type) -> None:
    """Draw items in their order on a surface."""
    for shapes, run in groupby(items, lambda item: isinstance(item, Layer)):
        if shapes:
            paint(surface, [item for item in run if isinstance(item, Layer)])
            continue
        for item in run:
            assert isinstance(item, Caption)
            text, at, size, colour, anchor, strong = item
            type_.draw(surface, text, at, size=size, colour=colour, anchor=anchor, strong=strong)
