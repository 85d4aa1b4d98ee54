"""Rigid things that move: their outlines are made once and then only turned and placed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from linkanim.picture.raster.directions import folded
from linkanim.picture.raster.raster import Colour, Layer, outlines_of
from linkanim.picture.raster.shapes import rounded, unit

_GLAZED = 0.6
"""How much a plate covers of what lies behind it."""

Places = Mapping[str, complex]
"""Where the joints lie in pixels, as x + yi."""


@dataclass(frozen=True)
class Part:
    """Layers about the joint `at`, drawn for the direction from `tail` to `head` being 1.

    Without a direction (`tail` == `head`) the part keeps its own. The pins of `joints` go through it.
    One that looks the same `fold` times in a turn (3 or more) is turned by no more than to there.
    """

    at: str
    tail: str
    head: str
    layers: tuple[Layer, ...]
    joints: tuple[str, ...] = ()
    name: str = ""
    fold: int = 1

    @property
    def title(self) -> str:
        """What its group is called: by its body, or by the joint that it is fitted to."""
        return f"body-{self.name}" if self.name else f"fitting-{self.at}"

    def placed(self, places: Places) -> list[Layer]:
        """Return the layers where the joints now lie."""
        at, turn = places[self.at], self.turn(places)
        return [layer.placed(at, turn) for layer in self._joined]

    def turn(self, places: Places) -> complex:
        """Return the direction that the part is turned by."""
        turn = unit(places[self.head] - places[self.tail])
        return folded(turn, self.fold) if self.fold > 2 else turn

    @cached_property
    def _joined(self) -> tuple[Layer, ...]:
        return joined(self.layers)


@dataclass(frozen=True, eq=False)  # outlines are arrays, which do not compare
class Stamp:
    """Layers about the origin that are put down at many places without turning."""

    layers: tuple[Layer, ...]

    def at(self, centres: Sequence[complex]) -> list[Layer]:
        """Return the layers at all places at once."""
        return [layer.repeated(centres) for layer in self._joined]

    @cached_property
    def _joined(self) -> tuple[Layer, ...]:
        return joined(self.layers)


def joined(layers: Iterable[Layer]) -> tuple[Layer, ...]:
    """Return layers whose loops lie in one array each, so that they are placed together."""
    return tuple(layer._replace(loops=outlines_of(layer.loops)) for layer in layers)


def placed(parts: Iterable[Part], places: Places) -> list[Layer]:
    """Return the layers of all parts, in their order."""
    return [layer for part in parts for layer in part.placed(places)]


def by_depth(parts: Sequence[Part], names: Iterable[str]) -> tuple[tuple[str, ...], ...]:
    """Return which joints' pins are drawn before the first part, and which after each of the parts.

    A pin lies on the foremost of the parts that it goes through, so that a part further forward hides it.
    """
    depth = {name: n for n, part in enumerate(parts, start=1) for name in part.joints}
    kept = tuple(names)
    return tuple(tuple(name for name in kept if depth.get(name, 0) == n) for n in range(len(parts) + 1))


def lined(points: list[complex], radius: float, width: float, colours: tuple[Colour, Colour]) -> list[Layer]:
    """Return a rounded outline around points in (edge colour, fill colour), the edge inside the radius."""
    edge, fill = colours
    return [Layer(edge, [rounded(points, radius)]), Layer(fill, [rounded(points, max(radius - width, 0.1))])]


def glazed(points: list[complex], radius: float, width: float, colours: tuple[Colour, Colour]) -> list[Layer]:
    """Return the same with a fill that lets through what lies behind, and ends under the outline."""
    edge, fill = colours
    inner = rounded(points, max(radius - width, 0.1))
    pane = rounded(points, max(radius - width / 2, 0.1))
    return [Layer(fill, [pane], _GLAZED), Layer(edge, [rounded(points, radius), inner[::-1]])]


def slotted(
    points: Sequence[complex],
    slot: tuple[complex, complex],
    radii: tuple[float, float],
    width: float,
    colours: tuple[Colour, Colour],
) -> list[Layer]:
    """Return the same with a slot from end to end in it, open to what lies behind.

    `radii` are half the widths of the bar and of its slot.
    """
    edge, fill = colours
    (bar, hole), ends = radii, list(slot)
    return [
        Layer(edge, [rounded(points, bar), rounded(ends, hole)[::-1]]),
        Layer(fill, [rounded(points, max(bar - width, 0.1)), rounded(ends, hole + width)[::-1]]),
    ]
