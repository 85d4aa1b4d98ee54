"""Rigid things that move: their outlines are made once and then only turned and placed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import rounded, unit

Places = Mapping[str, complex]
"""Where the joints lie in pixels, as x + yi."""


@dataclass(frozen=True)
class Part:
    """Layers about the joint `at`, drawn for the direction from `tail` to `head` being 1.

    Without a direction (`tail` == `head`) the part keeps its own.
    """

    at: str
    tail: str
    head: str
    layers: tuple[Layer, ...]

    def placed(self, places: Places) -> list[Layer]:
        """Return the layers where the joints now lie."""
        origin = places[self.at]
        turn = unit(places[self.head] - places[self.tail])
        return [
            Layer(layer.colour, [origin + turn * loop for loop in layer.loops], layer.alpha)
            for layer in self.layers
        ]


@dataclass(frozen=True)
class Stamp:
    """Layers about the origin that are put down at many places without turning."""

    layers: tuple[Layer, ...]

    def at(self, centres: Sequence[complex]) -> list[Layer]:
        """Return the layers at all places at once."""
        return [
            Layer(layer.colour, [centre + loop for centre in centres for loop in layer.loops], layer.alpha)
            for layer in self.layers
        ]


def placed(parts: Iterable[Part], places: Places) -> list[Layer]:
    """Return the layers of all parts, in their order."""
    return [layer for part in parts for layer in part.placed(places)]


def lined(points: list[complex], radius: float, width: float, colours: tuple[Colour, Colour]) -> list[Layer]:
    """Return a rounded outline around points in (edge colour, fill colour), the edge inside the radius."""
    edge, fill = colours
    return [Layer(edge, [rounded(points, radius)]), Layer(fill, [rounded(points, max(radius - width, 0.1))])]
