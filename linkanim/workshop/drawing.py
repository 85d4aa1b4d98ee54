"""Pictures of a made linkage, as items for a surface or a file: a plan by layers, from the side, exploded."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property

import numpy as np

from linkanim.frozen import frozen
from linkanim.paper.illustration import Illustration
from linkanim.picture.figure import figure
from linkanim.picture.items import Caption, Halo, Item, grouped
from linkanim.picture.layered import LayerView, layer_colour, lifted, room_of
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import disc, stroke
from linkanim.picture.text import letters, subscripted
from linkanim.picture.theme import LIGHT, Theme, mixed
from linkanim.picture.view import Box, Rect, View, view_of
from linkanim.words import name_said, said
from linkanim.workshop.made import MadeLinkage
from linkanim.workshop.parts import MadePin
from linkanim.workshop.shapes import polygon

_CHORD = 0.05
"""How far the sides of a drawn outline may stay within its arcs, in mm."""
_TEXT = 15
_SHADOW = ((2 + 2.5j, 0.16), (3.5 + 4.5j, 0.1))
"""The offsets of a plate's shadow, in pixels, and its opacities: two of each, for a soft edge."""


@frozen
class Drawn:
    """A made linkage, drawn at a phase: `size` in pixels, colours by layer.

    Only the plates in `shown` are drawn, all if it is None. Where `new` is given, plates that are not in it
    are pale.
    """

    made: MadeLinkage
    phase: float
    size: tuple[int, int]
    theme: Theme = LIGHT
    shown: Collection[int] | None = None
    new: Collection[int] | None = None

    @cached_property
    def _loops(self) -> list[tuple[Loop, ...]]:
        """The edges of each plate and of its cuts, placed at the phase, in mm."""
        loops = []
        for plate, (at, turn) in zip(self.made.plates, self.made.placed(self.phase), strict=True):
            outlines = (plate.outline(), *plate.cuts())
            loops.append(tuple(at + turn * np.array(polygon(outline, _CHORD)) for outline in outlines))
        return loops

    @cached_property
    def _box(self) -> Box:
        points = np.concatenate([loops[0] for loops in self._loops])
        real, imag = points.real, points.imag
        return Box(float(real.min()), float(imag.min()), float(real.max()), float(imag.max()))

    def _order(self) -> list[int]:
        """Return the plates that are shown, the lowest first."""
        shown = range(len(self.made.plates)) if self.shown is None else self.shown
        return sorted(shown, key=lambda number: (self.made.layer[number], number))

    def _colour(self, number: int) -> Colour:
        """Return a plate's colour: its layer's, pale if the plate is not new."""
        layer, theme = self.made.layer[number], self.theme
        colour = layer_colour(layer, theme)
        pale = self.new is not None and number not in self.new
        return mixed(colour, theme.background, 0.72 if pale and layer else 0.0)

    def _pins(self) -> list[tuple[MadePin, complex]]:
        """Return the pins of the shown plates, and their places, in mm."""
        shown = set(self._order())
        places = zip(self.made.pins, self.made.pinned(self.phase), strict=True)
        return [(pin, at) for pin, at in places if shown & set(pin.plates)]

    def _open(self) -> list[tuple[str, int, complex]]:
        """Return the holes through which no pin passes: the joint, the layer and the place, in mm."""
        pinned, open_pins = {pin.name for pin in self.made.pins}, []
        placed = self.made.placed(self.phase)
        for number in self._order():
            at, turn = placed[number]
            for hole in self.made.plates[number].holes:
                if hole.joint and hole.joint not in pinned:
                    open_pins.append((hole.joint, self.made.layer[number], at + turn * hole.begin))
        return open_pins

    def plan(self) -> Iterator[Item]:
        """Yield the plates seen from above, each with its number, and the names of joints at their holes."""
        left = 110 if self.new is None else 12
        width, height = self.size
        view = view_of(self._box, Rect(left, 12, width - left - 12, height - 24))
        for layer in range(self.made.layers + 2):
            lying = [number for number in self._order() if self.made.layer[number] == layer]
            if layer:
                # All shadows of a layer before its plates: no plate throws its shadow on another of its
                # layer.
                for number in lying:
                    yield from self._shadow(number, view)
            for number in lying:
                yield from self._plate(number, view)
        numbers = [item for number in self._order() for item in self._number(number, view)]
        pins = [(pin, view.pixel((at.real, at.imag))) for pin, at in self._pins()]
        discs = [item for pin, at in pins for item in self._pin(at, view)]
        yield from discs
        yield from numbers
        radius = self._radius(view)
        taken = [_around(layer.loops[0]) for layer in (*discs, *numbers) if isinstance(layer, Layer)]
        named = [(pin.name, at) for pin, at in pins if not pin.stuck]
        named += [(joint, view.pixel((at.real, at.imag))) for joint, _, at in self._open()]
        yield from self._names(
            [
                (name, [(at.real + x, at.imag + y - 0.5 * _TEXT) for x, y in _corner_places(radius)])
                for name, at in named
            ],
            taken,
        )
        if self.new is None:
            yield from self._key()

    def _shadow(self, number: int, view: View) -> Iterator[Layer]:
        """Yield the shadow that a plate throws on those below it; a pale plate throws none."""
        if self.new is None or number in self.new:
            edge = _in_view(self._loops[number][0], view)
            for far, alpha in _SHADOW:
                yield Layer(self.theme.outline, [edge + far], alpha)

    def _plate(self, number: int, view: View) -> Iterator[Layer]:
        loops = [_in_view(loop, view) for loop in self._loops[number]]
        yield Layer(self._colour(number), [loops[0], *(loop[::-1] for loop in loops[1:])], 0.9)
        new = self.new is not None and number in self.new
        edge = (
            self.theme.outline
            if new or self.new is None
            else mixed(self.theme.outline, self.theme.background, 0.5)
        )
        yield Layer(edge, [line for loop in loops for line in stroke(loop, 1.6 if new else 1.0, closed=True)])

    def _radius(self, view: View) -> float:
        """Return a pin's radius in pixels, as it is drawn from above."""
        return max(0.5 * self.made.sizes.pin * view.scale, 2.0)

    def _pin(self, at: complex, view: View) -> Iterator[Layer]:
        radius = self._radius(view)
        yield Layer(self.theme.outline, [at + disc(radius)])
        yield Layer(self.theme.metal, [at + disc(max(radius - 1.2, 1.0))])

    def _names(
        self, wanted: Iterable[tuple[str, Sequence[tuple[float, float]]]], taken: Sequence[Rect]
    ) -> Iterator[Caption]:
        """Yield pins' names, each at the first of its places that is free, or at the first if none is.

        A place is the middle of a name's upper edge.
        """
        room, type_ = Rect(0, 0, *self.size), letters()
        wanted = list(wanted)
        edges = np.full((4, len(taken) + len(wanted)), np.inf)
        for n, spot in enumerate(taken):
            edges[:, n] = spot.x, spot.y, spot.right, spot.bottom
        left, top, right, low = edges

        def free_of(box: Rect) -> bool:
            # a large linkage has ten thousand places, each compared with hundreds of boxes
            apart = (left >= box.right) | (box.x >= right) | (top >= box.bottom) | (box.y >= low)
            return bool(apart.all())

        for n, (name, places) in enumerate(wanted, start=len(taken)):
            text = subscripted(name)
            wide = type_.width(text, _TEXT)
            boxes = [Rect(x - wide / 2, y, wide, _TEXT) for x, y in places]
            free = (
                box
                for box in boxes
                if room.holds(box.x, box.y) and room.holds(box.right, box.bottom) and free_of(box)
            )
            spot = next(free, boxes[0])
            edges[:, n] = spot.x, spot.y, spot.right, spot.bottom
            halo = Halo(self.theme.background, 2.5)
            yield Caption(text, (spot.middle.real, spot.y), _TEXT, self.theme.ink, "centre", halo=halo)

    def _number(self, number: int, view: View) -> Iterator[Item]:
        """Yield a plate's number in a disc, where the plate has most room between its holes."""
        if self.made.layer[number] == 0 and self.made.plates[number].role == "ground":
            return
        at, turn = self.made.placed(self.phase)[number]
        place = at + turn * self.made.plates[number].clearest
        middle = view.pixel((place.real, place.imag))
        pale = self.new is not None and number not in self.new
        if pale:
            return
        text = self.made.numbers[number]
        radius = 0.5 * _TEXT + 2.5 * len(text) - 1
        yield Layer(self.theme.background, [middle + disc(radius)])
        yield Layer(self.theme.outline, stroke(middle + disc(radius), 1.0, closed=True))
        yield Caption(
            text, (middle.real, middle.imag - 0.5 * _TEXT), _TEXT, self.theme.ink, "centre", strong=True
        )

    def _key(self) -> Iterator[Item]:
        """Yield the key of the layers' colours, from the top down."""
        layers = range(self.made.layers, -1, -1)
        for row, layer in enumerate(layers):
            number = next(n for n, one in enumerate(self.made.layer) if one == layer)
            top = 14 + row * 1.5 * _TEXT
            box = np.array([complex(x, y) for x, y in ((12, top), (30, top), (30, top + 14), (12, top + 14))])
            yield Layer(self._colour(number), [box])
            yield Caption(_layer_said(layer), (37, top - 3), _TEXT, self.theme.ink)

    def side(self) -> Iterator[Item]:
        """Yield the layers seen from the side: plates over their extent, pins from end to end."""
        width, height = self.size
        across = self._box.right - self._box.left < self._box.high - self._box.low
        spans = [_span(loops[0] * (-1j if across else 1)) for loops in self._loops]
        low, high = min(span[0] for span in spans), max(span[1] for span in spans)
        left, right = 80.0, width - 16.0
        scale = (right - left) / (high - low)
        top, foot = 2.2 * _TEXT, height - 10.0
        step = (foot - top) / (self.made.layers + 1)

        def x(place: float) -> float:
            return left + scale * (place - low)

        def y(layer: float) -> float:
            return foot - step * layer

        for layer in range(self.made.layers + 1):
            yield Caption(_layer_said(layer), (8, y(layer + 0.5) - 0.5 * _TEXT), _TEXT, self.theme.dim)
        thick = 0.72
        for number in self._order():
            begin, end = (x(place) for place in spans[number])
            layer = self.made.layer[number]
            box = np.array([complex(a, b) for a, b in _corners(begin, end, y(layer + thick), y(layer))])
            yield Layer(self._colour(number), [box], 0.85)
            yield Layer(self.theme.outline, stroke(box, 1.0, closed=True))
        named: list[tuple[str, list[tuple[float, float]]]] = []
        taken: list[Rect] = []
        for pin, at in sorted(self._pins(), key=lambda one: (one[1] * (-1j if across else 1)).real):
            place = x((at * (-1j if across else 1)).real)
            half, upper = max(0.5 * self.made.sizes.pin * scale, 1.5), y(pin.high + thick) - 3
            box = np.array(
                [complex(a, b) for a, b in _corners(place - half, place + half, upper, y(pin.low) + 3)]
            )
            yield Layer(self.theme.outline, [box], 0.9)
            taken.append(_around(box))
            for layer, diameter in pin.spacers:
                reach = max(0.5 * diameter * scale, half + 2)
                corners = _corners(place - reach, place + reach, y(layer + thick), y(layer))
                yield Layer(self.theme.metal, [np.array([complex(a, b) for a, b in corners])], 0.8)
            if not pin.stuck:
                beside = (0, half + 12, -half - 12, half + 22, -half - 22)
                rows = (1.05 * _TEXT, 2.1 * _TEXT)
                named.append((pin.name, [(place + dx, upper - dy) for dy in rows for dx in beside]))
        yield from self._names(named, taken)
        for number in self._order():
            begin, end = (x(place) for place in spans[number])
            middle = complex((begin + end) / 2, y(self.made.layer[number] + thick / 2))
            halo = Halo(self.theme.background, 3.0)
            yield Caption(
                self.made.numbers[number],
                (middle.real, middle.imag - 0.5 * _TEXT),
                _TEXT,
                self.theme.ink,
                "centre",
                strong=True,
                halo=halo,
            )

    def exploded(self, apart: float = 1.0) -> Iterator[Item]:
        """Yield the layers lifted off each other, seen aslant: `apart` from 0, flat, to 1, as far as fits."""
        made, points = self.made, np.concatenate([loops[0] for loops in self._loops])
        view = LayerView.fitting(points, made.layers, apart, room_of(self.size))
        pose = made.scene.pose(self.phase, 0)
        yield from lifted(made.layered, pose, made.scene.length_unit, view, self.theme, _TEXT)
        for joint, layer, at in self._open():
            place = complex(view.seen(np.array([at]), layer)[0])
            beside, halo = (place.real + 4, place.imag - 1.1 * _TEXT), Halo(self.theme.background, 2.5)
            yield Caption(subscripted(joint), beside, _TEXT, self.theme.ink, halo=halo)


def preview(made: MadeLinkage, size: tuple[int, int] = (1280, 640)) -> Illustration:
    """Return the layers in one picture: seen from above, and beside that lifted off each other.

    The linkage is in the pose in which its joints are farthest apart.
    """
    width, height = size
    drawn = Drawn(made, figure(made.scene).clearest, (width // 2, height))
    beside = (_moved(item, width / 2) for item in drawn.exploded())
    groups = grouped("from above", drawn.plan()), grouped("lifted off", beside)
    return Illustration(
        said("{title}: its layers", title=said(made.scene.title)), size, LIGHT.background, groups
    )


def _layer_said(layer: int) -> str:
    return said("layer {number}", number=layer) if layer else name_said("ground")


def _moved(item: Item, right: float) -> Item:
    """Return an item moved right by pixels."""
    if isinstance(item, Layer):
        return item._replace(loops=[loop + right for loop in item.loops])
    return item._replace(at=(item.at[0] + right, item.at[1]))


def _in_view(loop: Loop, view: View) -> Loop:
    pixels: Loop = view.x + view.scale * loop.real + 1j * (view.y - view.scale * loop.imag)
    return pixels


def _around(loop: Loop) -> Rect:
    """Return the rectangle around a loop."""
    left, top = float(loop.real.min()), float(loop.imag.min())
    return Rect(left, top, float(loop.real.max()) - left, float(loop.imag.max()) - top)


def _corner_places(radius: float) -> Iterator[tuple[float, float]]:
    """Yield where a name may stand, from its pin's middle: upper right first, then around it."""
    for far in (1.0, 1.8):
        aside, up = far * (radius + 12), far * 0.5 * (radius + _TEXT)
        yield from ((aside, -up), (aside, up), (-aside, -up), (-aside, up), (0, -1.8 * up), (0, 1.8 * up))


def _span(loop: Loop) -> tuple[float, float]:
    return float(loop.real.min()), float(loop.real.max())


def _corners(left: float, right: float, top: float, foot: float) -> Sequence[tuple[float, float]]:
    return (left, top), (right, top), (right, foot), (left, foot)
