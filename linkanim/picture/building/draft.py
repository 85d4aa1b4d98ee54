"""A draft as it is drawn before it moves: bars and plates, pins with their feet, guides, struts, wheels."""

from __future__ import annotations

from collections.abc import Iterator

from linkanim.build.shapes import Shape
from linkanim.mechanics.linkage.joint import Point
from linkanim.picture.items import Caption, Group, Halo
from linkanim.picture.layout import Gauge, Layout, gauge
from linkanim.picture.panels.building import DraftShown
from linkanim.picture.parts.bodies import mark_stamp, pin_stamp
from linkanim.picture.parts.fittings import block_layers, hatched
from linkanim.picture.parts.ground import pedestal
from linkanim.picture.parts.struts import Coil, Damping, StrutSpan, damping
from linkanim.picture.parts.turning import turning_arrow
from linkanim.picture.raster.parts import glazed, lined
from linkanim.picture.raster.raster import Layer, Loop
from linkanim.picture.raster.shapes import disc, hull, segments, stroke, unit
from linkanim.picture.text.text import subscripted
from linkanim.picture.theme import Theme
from linkanim.picture.view import View

_COILS = 10
_GUIDE = 11.0
"""How far a guide is drawn about a place, in half widths of a bar."""
_WHEELS = 0.55
"""How much of what lies behind a wheel it covers."""


def draft_gauge(layout: Layout, view: View, draft: DraftShown) -> Gauge:
    """Return how thick a draft is drawn: as the linkage is that it becomes."""
    ends = [[*map(view.place, one.places[:2])] for one in draft.shapes if one.kind == "bars"]
    spans = (abs(end - begin) for begin, end in ends)
    return gauge(layout.unit, min(spans, default=200 * layout.unit))


class DraftDrawing:
    """A draft in one view, in pixels."""

    def __init__(self, draft: DraftShown, view: View, gauge_: Gauge, theme: Theme) -> None:
        self._draft, self._view, self._gauge, self._theme = draft, view, gauge_, theme

    def groups(self, size: int) -> Iterator[Group]:
        """Yield all of it, back to front; names are written at that size."""
        drawn = {"gears": self._wheels, "guides": self._guide, "pins": self._foot}
        behind = [layer for kind, draw in drawn.items() for one in self._of(kind) for layer in draw(one)]
        yield Group("draft-ground", behind)
        yield Group("draft-bodies", [*self._bodies()])
        struts = (layer for kind in _STRUTS for one in self._of(kind) for layer in self._strut(one))
        yield Group("draft-struts", [*struts])
        yield Group("draft-pins", [*self._pins()], [*self._names(size)])

    def _of(self, *kinds: str) -> list[Shape]:
        return [one for one in self._draft.shapes if one.kind in kinds]

    def _placed(self, places: tuple[Point, ...]) -> list[complex]:
        return [self._view.place(point) for point in places]

    def _guide(self, guide: Shape) -> Iterator[Layer]:
        """Yield a line along a guide's two places, some way to either side of what slides on it."""
        start, beside, *blocks = self._placed(guide.places)
        along, reach = unit(beside - start), _GUIDE * self._gauge.bar
        ways = [((at - start) * along.conjugate()).real for at in blocks] or [0.0]
        ends = start + along * (min(ways) - reach), start + along * (max(ways) + reach)
        yield Layer(self._theme.ground, [*hatched(*ends, self._gauge, 1)])

    def _foot(self, pin: Shape) -> Iterator[Layer]:
        yield from pedestal(self._view.place(pin.places[0]), 1j, self._gauge, self._theme)

    def _wheels(self, gear: Shape) -> Iterator[Layer]:
        one, other, touching = self._placed(gear.places)
        for middle in (one, other):
            ring = middle + disc(max(abs(touching - middle), 1.0))
            yield Layer(self._theme.gear, [ring], _WHEELS)
            yield Layer(self._theme.ground, stroke(ring, self._gauge.line, closed=True))

    def _bodies(self) -> Iterator[Layer]:
        crank = set(self._draft.crank or ())
        bars = sorted(self._of("bars"), key=lambda bar: not crank >= {*bar.places})
        for colour, bar in sorted(enumerate(bars), key=lambda one: len(one[1].places) < 3):
            yield from self._body(bar, colour)
        for block in self._of("sliders", "slots", "yokes"):
            yield from self._block(block)

    def _body(self, bar: Shape, colour: int) -> list[Layer]:
        points = self._placed(bar.places)
        colours = self._theme.outline, self._theme.bodies[colour % len(self._theme.bodies)]
        draw = glazed if len(hull(points)) > 2 else lined
        return draw(points, self._gauge.bar, self._gauge.outline, colours)

    def _block(self, block: Shape) -> Iterator[Layer]:
        """Yield what slides, along the way from its first place to its second."""
        at, *beside = self._placed(block.places)
        turn = unit(beside[0] - at) if beside else 1 + 0j
        share = 1.0 if block.kind == "sliders" else 0.62
        yield from (layer.placed(at) for layer in block_layers(self._gauge, self._theme, turn, share))

    def _strut(self, strut: Shape) -> list[Layer]:
        begin, end = self._placed(strut.places[:2])
        ends, span, gauge_ = ("begin", "end"), abs(end - begin), self._gauge
        drawn: Coil | Damping
        if strut.kind == "springs":
            drawn = Coil(ends, 1.15 * gauge_.bar, 1.5 * gauge_.bar, _COILS, gauge_, self._theme)
        else:
            drawn = damping(ends, StrutSpan(span, span), (0.5 * span, 0.25 * span), gauge_, self._theme)
        return drawn.layers({"begin": begin, "end": end})

    def _pins(self) -> Iterator[Layer]:
        joints = tuple(one.places[0] for one in self._of("pins", "joints"))
        yield from pin_stamp(self._gauge, self._theme).at(self._placed(joints))
        for n, at in enumerate(self._placed(self._draft.traced)):
            colour = self._theme.traces[n % len(self._theme.traces)]
            yield from mark_stamp(colour, self._gauge, self._theme).at([at])
        if self._draft.crank:
            pivot, pin = self._placed(self._draft.crank)
            yield from turning_arrow(pivot, pin, self._gauge, self._theme)

    def _names(self, size: int) -> Iterator[Caption]:
        halo = Halo(self._theme.background, 0.12 * size)
        for joint in self._of("pins", "joints"):
            aside = 2.6 + 1.9j if joint.kind == "pins" else 1.3 - 1.3j
            at = self._view.place(joint.places[0]) + self._gauge.bar * aside
            words = subscripted(joint.label)
            yield Caption(words, (at.real, at.imag - size), size, self._theme.dim, halo=halo)


_STRUTS = ("springs", "dampers", "cylinder")


def lit(shape: Shape, view: View, reach: float) -> Iterator[Loop]:
    """Yield a light on a shape: round its place, along the way from its first place to its second."""
    places = [view.place(point) for point in shape.places[:2]]
    if shape.kind == "guides":
        along = 300 * reach * unit(places[1] - places[0])
        yield from segments(places[0] - along, places[0] + along, 0.5 * reach)
        return
    if len(places) > 1:
        yield from segments(places[0], places[1], 2 * reach)
    yield from (at + disc(reach * (1.0 if len(places) > 1 else 1.3)) for at in places)
