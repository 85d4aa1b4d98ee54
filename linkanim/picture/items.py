"""What a chart or a page is made of: filled shapes and captions, for a surface and a file alike."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import pygame

from linkanim.picture.lettering import Lettering
from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.text import Anchor, Type


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
            _write(surface, item, type_)


def _write(surface: pygame.Surface, line: Caption, type_: Type) -> None:
    """Draw a line of text; one in a halo to a part of a pixel, as labels on a drawing are."""
    text, at, size, colour, anchor, strong, halo = line
    if halo is None:
        type_.draw(surface, text, at, size=size, colour=colour, anchor=anchor, strong=strong)
        return
    letters = Lettering(text, type_, size, (colour, halo.colour), halo.width)
    aside = {"left": 0.5, "centre": 0.0, "right": -0.5}[anchor] * letters.size[0]
    letters.draw(surface, complex(at[0] + aside, at[1] + letters.drop))
