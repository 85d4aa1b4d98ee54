"""Draw the sheet of paper: its grid, a linkage that is being built on it, the pencil's path.

A draft that does not move yet is drawn as bars and plates, pins with their feet, guides, struts and wheels.
A path is the pencil's line, and then the stroke behind its trace, with handles.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pygame

from linkanim.build.draft import Photo
from linkanim.build.places import Shape
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.motion import Pose
from linkanim.picture.bodies import mark_stamp, pin_stamp
from linkanim.picture.drawn import Addition
from linkanim.picture.figure import DrawSetting
from linkanim.picture.fittings import Coil, Damping, block_layers, damping, hatched, pedestal
from linkanim.picture.items import SHEET, Caption, Group, Halo
from linkanim.picture.layout import HEAD_STEP, Gauge, Layout, gauge, tool_cells
from linkanim.picture.marks import DimensionLine, label_beside, measure
from linkanim.picture.motion_marks import turning_arrow
from linkanim.picture.photograph import Photograph
from linkanim.picture.quantities import round_step
from linkanim.picture.raster import Layer, Loop, paint
from linkanim.picture.shapes import box, dashes, disc, glazed, hull, lined, segments, stroke, unit
from linkanim.picture.slider import slider_rect
from linkanim.picture.text import subscripted
from linkanim.picture.theme import ORANGE, Theme, mixed
from linkanim.picture.view import Box, Rect, View, view_of
from linkanim.units import significant
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.synthesis.curves import DrawnCurve

# A path that is drawn: the sheet, the pencil's line, and then the stroke behind its trace, with handles.

HINT = to_say("draw a path in one stroke")
_GRID = 36
"""The least distance of the sheet's lines, in units."""
_DASH, _GAP = 3.2, 2.2
"""The lengths of dashes and gaps of the stroke, in widths of it."""
_HANDLES = 12
"""Points of a stroke that are marked; every one can be dragged."""


@lru_cache(maxsize=2)
def sheet(view: View, layout: Layout, theme: Theme) -> Group:
    """Return the empty sheet, the same object each time: lines at round distances in the scene's unit."""
    width, height = layout.size
    step = view.scale * grid_step(view, layout)
    x, y = (np.arange(start % step, end, step) for start, end in ((view.x, width), (view.y, height)))
    lines = [*segments(x, x + 1j * height, 1.0), *segments(1j * y, width + 1j * y, 1.0)]
    return Group(SHEET, [Layer(mixed(theme.rule, theme.background, 0.4), lines)], still=True)


def grid_step(view: View, layout: Layout) -> float:
    """Return how far the sheet's lines are apart, in the scene's unit."""
    return round_step(_GRID * layout.unit / view.scale, 1)


def pencil(layout: Layout, theme: Theme) -> pygame.Surface:
    """Return a pencil to point with, its tip in the lower left corner."""
    size = round(max(30 * layout.unit, 20.0))
    sheet = pygame.Surface((size, size), pygame.SRCALPHA, 32)
    along, wide = (size - 4) * (1 - 1j) / 1.414, 0.13 * size * (1 + 1j) / 1.414
    tip, neck, end = complex(1.5, size - 1.5), 0.3 * along, 0.9 * along
    rim = np.array([0, neck + wide, end + wide, end - wide, neck - wide])
    layers = [
        Layer(theme.background, stroke(tip + rim, 3.0, closed=True)),
        Layer(theme.ink, [tip + rim]),
        Layer(ORANGE, [tip + np.array([neck, end]).repeat(2) + 0.6 * wide * np.array([1, -1, -1, 1])]),
    ]
    paint(sheet, layers)
    return sheet


def drawn_line(setting: DrawSetting, pen: Sequence[complex], curve: DrawnCurve | None) -> Group:
    """Return the pencil's line, or the stroke while no linkage follows it; words where there is neither."""
    points = np.array(pen) if pen else curve.polyline if curve else np.zeros(0, complex)
    layout, theme, size = setting.layout, setting.theme, setting.layout.text_size
    if not points.size:
        at = layout.size[0] / 2, layout.size[1] / 2 - size
        return Group("pencil", (), [Caption(said(HINT), at, size, theme.dim, "centre")])
    line = stroke(_in_pixels(setting.view, points), max(2.6 * layout.unit, 1.6))
    return Group("pencil", [Layer(theme.ink, line)])


def dashed(setting: DrawSetting, curve: DrawnCurve) -> Group:
    """Return the stroke in dashes, wider than a trace."""
    width, theme = 2.6 * setting.gauge.line, setting.theme
    line = _in_pixels(setting.view, curve.polyline)
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(line)))])
    count = max(ceil(along[-1] / ((_DASH + _GAP) * width)), 1)
    ends = np.arange(count) * (along[-1] / count) + np.array([[0.0], [_DASH * width]])
    begin, end = np.interp(ends, along, line.real) + 1j * np.interp(ends, along, line.imag)
    loops = segments(begin, end, width)
    return Group("stroke", [Layer(mixed(theme.ink, theme.background, 0.55), loops)], still=True)


def handles(
    setting: DrawSetting, curve: DrawnCurve, held: int | None, pins: Sequence[Point]
) -> Iterator[Layer]:
    """Yield the marked points of a stroke, the one that is held, and rings about pivots that are held."""
    _, view, gauge, theme = setting.known
    points, reach = _in_pixels(view, curve.points), 0.55 * gauge.bar
    marked = points[:: max(len(points) // _HANDLES, 1)]
    yield Layer(theme.ink, [at + disc(reach) for at in marked])
    yield Layer(theme.background, [at + disc(0.6 * reach) for at in marked])
    if held is not None:
        yield Layer(theme.velocity, [points[held] + disc(1.5 * reach)])
    for pin in pins:
        ring = view.pixel(pin) + disc(2.6 * gauge.bar)
        yield Layer(theme.velocity, stroke(ring, 1.6 * gauge.line, closed=True))


def _in_pixels(view: View, points: Loop) -> Loop:
    return view.x + view.scale * points.real + 1j * (view.y - view.scale * points.imag)


# A draft as it is drawn before it moves: bars and plates, pins with their feet, guides, struts, wheels.

_COILS = 10
_GUIDE = 11.0
"""How far a guide is drawn about a place, in half widths of a bar."""
_WHEELS = 0.55
"""The opacity of a wheel."""


def draft_gauge(layout: Layout, view: View, shapes: Iterable[Shape]) -> Gauge:
    """Return how thick a draft's shapes are drawn: like the linkage that it becomes."""
    ends = [[*map(view.pixel, one.places[:2])] for one in shapes if one.kind == "bars"]
    spans = (abs(end - begin) for begin, end in ends)
    return gauge(layout.unit, min(spans, default=200 * layout.unit))


class DraftDrawing:
    """A draft that does not move yet, in pixels: its shapes from the back to the front.

    `crank` are the pivot and the pin of the driven crank; a bar has the colour of its place among the bars,
    the crank first. The joints `traced` have marks.
    """

    def __init__(
        self,
        shapes: Sequence[Shape],
        setting: DrawSetting,
        crank: tuple[Point, Point] | None = None,
        traced: tuple[Point, ...] = (),
    ) -> None:
        self._shapes, self._crank, self._traced = shapes, crank, traced
        self._view, self._gauge, self._theme = setting.view, setting.gauge, setting.theme

    def groups(self) -> Iterator[Group]:
        """Yield the draft without its names, back to front."""
        drawn = {"gears": self._wheels, "guides": self._guide, "pins": self._foot}
        behind = [layer for kind, draw in drawn.items() for one in self._of(kind) for layer in draw(one)]
        yield Group("draft-ground", behind)
        yield Group("draft-bodies", [*self._bodies()])
        struts = (layer for kind in _STRUTS for one in self._of(kind) for layer in self._strut(one))
        yield Group("draft-struts", [*struts])
        yield Group("draft-pins", [*self._pins()])

    def _of(self, *kinds: str) -> list[Shape]:
        return [one for one in self._shapes if one.kind in kinds]

    def _in_pixels(self, places: tuple[Point, ...]) -> list[complex]:
        return [self._view.pixel(point) for point in places]

    def _guide(self, guide: Shape) -> Iterator[Layer]:
        """Yield a line through a guide's two places, extended on both sides of the slider on it."""
        start, beside, *blocks = self._in_pixels(guide.places)
        along, reach = unit(beside - start), _GUIDE * self._gauge.bar
        places = [((at - start) * along.conjugate()).real for at in blocks] or [0.0]
        ends = start + along * (min(places) - reach), start + along * (max(places) + reach)
        yield Layer(self._theme.ground, [*hatched(*ends, self._gauge, 1)])

    def _foot(self, pin: Shape) -> Iterator[Layer]:
        yield from pedestal(self._view.pixel(pin.places[0]), 1j, self._gauge, self._theme)

    def _wheels(self, gear: Shape) -> Iterator[Layer]:
        one, other, touching = self._in_pixels(gear.places)
        for middle in (one, other):
            ring = middle + disc(max(abs(touching - middle), 1.0))
            yield Layer(self._theme.gear, [ring], _WHEELS)
            yield Layer(self._theme.ground, stroke(ring, self._gauge.line, closed=True))

    def _bodies(self) -> Iterator[Layer]:
        crank = set(self._crank or ())
        bars = sorted(self._of("bars"), key=lambda bar: not crank >= {*bar.places})
        for colour, bar in sorted(enumerate(bars), key=lambda one: len(one[1].places) < 3):
            yield from self._body(bar, colour)
        for block in self._of("sliders", "slots", "yokes"):
            yield from self._block(block)

    def _body(self, bar: Shape, colour: int) -> list[Layer]:
        points = self._in_pixels(bar.places)
        colours = self._theme.outline, self._theme.bodies[colour % len(self._theme.bodies)]
        draw = glazed if len(hull(points)) > 2 else lined
        return draw(points, self._gauge.bar, self._gauge.outline, colours)

    def _block(self, block: Shape) -> Iterator[Layer]:
        """Yield a slider's block, along the line from its first place to its second."""
        at, *beside = self._in_pixels(block.places)
        turn = unit(beside[0] - at) if beside else 1 + 0j
        share = 1.0 if block.kind == "sliders" else 0.62
        yield from (layer.placed(at) for layer in block_layers(self._gauge, self._theme, turn, share))

    def _strut(self, strut: Shape) -> list[Layer]:
        begin, end = self._in_pixels(strut.places[:2])
        ends, span, gauge_ = ("begin", "end"), abs(end - begin), self._gauge
        drawn: Coil | Damping
        if strut.kind == "springs":
            drawn = Coil(ends, 1.15 * gauge_.bar, 1.5 * gauge_.bar, _COILS, gauge_, self._theme)
        else:
            drawn = damping(ends, (span, span), (0.5 * span, 0.25 * span), gauge_, self._theme)
        return drawn.layers({"begin": begin, "end": end})

    def _pins(self) -> Iterator[Layer]:
        joints = tuple(one.places[0] for one in self._of("pins", "joints"))
        yield from pin_stamp(self._gauge, self._theme).at(self._in_pixels(joints))
        for n, at in enumerate(self._in_pixels(self._traced)):
            colour = self._theme.traces[n % len(self._theme.traces)]
            yield from mark_stamp(colour, self._gauge, self._theme).at([at])
        if self._crank:
            pivot, pin = self._in_pixels(self._crank)
            yield from turning_arrow(pivot, pin, self._gauge, self._theme)

    def names(self, size: int) -> Iterator[Caption]:
        """Yield the joints' names at a size, each where the bars at its joint leave most room."""
        halo = Halo(self._theme.background, 0.12 * size)
        for joint in self._of("pins", "joints"):
            here, aside = self._in_pixels(joint.places)[0], self._aside(joint)
            at = here + (1.5 * self._gauge.bar + 0.75 * size) * aside
            place = at.real, at.imag - 0.62 * size
            yield Caption(subscripted(joint.label), place, size, self._theme.ink, "centre", halo=halo)

    def _aside(self, joint: Shape) -> complex:
        """Return the direction farthest from those of a joint's bars, and from a pin's foot."""
        here = joint.places[0]
        bars = [self._in_pixels(bar.places) for bar in self._of("bars") if here in bar.places]
        at = self._in_pixels((here,))[0]
        busy = [unit(place - at) for places in bars for place in places if abs(place - at) > 1e-9]
        busy += [1j] if joint.kind == "pins" else []
        return max(_ASIDE, key=lambda way: -max(((way * one.conjugate()).real for one in busy), default=-1.0))


_STRUTS = ("springs", "dampers", "cylinder")
_ASIDE = tuple(cmath.rect(1.0, n * math.pi / 4) for n in (-1, 0, -2, -3, 1, 4, 3, 2))
"""Directions of a name from its joint, in pixels; of equal ones the first is taken."""


def lit(shape: Shape, view: View, reach: float) -> Iterator[Loop]:
    """Yield a light on a shape: round its place, or along the line from its first place to its second."""
    places = [view.pixel(point) for point in shape.places[:2]]
    if shape.kind == "guides":
        along = 300 * reach * unit(places[1] - places[0])
        yield from segments(places[0] - along, places[0] + along, 0.5 * reach)
        return
    if len(places) > 1:
        yield from segments(places[0], places[1], 2 * reach)
    yield from (at + disc(reach * (1.0 if len(places) > 1 else 1.3)) for at in places)


# The sheet that a linkage is built on: its grid and ground line, what the hand draws, where it snaps.

_ROOM = 0.86
"""The share of the window that the home of a sheet takes."""
_LIT, _FAINT = 0.45, 0.55
"""The opacities of the light on the chosen shape, and of what the hand is drawing."""
_BACKING = 0.8
"""The opacity of the backing under the words."""
_ARROW = (0j, 17j, 4 + 13j, 7 + 20j, 10 + 18.7j, 7 + 12j, 12.5 + 12j)
"""The corners of a pointer, in units."""
_ALONG = ("begin", "end")
"""The frame of a length that is measured from its begin to its end."""


_LEAST_WORDS = 9
"""The smallest size of words at the head, in pixels."""


def home_view(home: Box, layout: Layout) -> View:
    """Return the view in which a rectangle of the scene lies in the middle of a window, as large as fits."""
    return view_of(home, layout.stage, _ROOM)


def paper(setting: DrawSetting, photo: Photo | None) -> Group:
    """Return the empty sheet: a light grid over a photograph, and the ground line through the origin.

    It is the same object while a hand changes the linkage, so that it is filled once.
    """
    return _paper(setting.view, setting.layout, setting.gauge, setting.theme, photo)


@lru_cache(maxsize=2)
def _paper(view: View, layout: Layout, gauge: Gauge, theme: Theme, photo: Photo | None) -> Group:
    laid = photo and Photograph(photo, view, theme.background)
    grid, (_, level) = sheet(view, layout, theme), view.to_pixel(0.0, 0.0)
    width, height = layout.size
    if not -20 * layout.unit < level < height:
        return grid._replace(under=laid)
    faint = mixed(theme.ground, theme.background, 0.62)
    coarse = replace(gauge, bar=2 * gauge.bar)
    ground = Layer(faint, [*hatched(complex(0, level), complex(width, level), coarse, 1)])
    return grid._replace(layers=[*grid.layers, ground], under=laid)


def named(names: Sequence[Caption], *, over: bool = True) -> Group:
    """Return the joints' names."""
    return Group("draft-names", (), names, over=over)


def dots(points: Sequence[Point], setting: DrawSetting) -> Group:
    """Return the points of bodies as dots."""
    places, reach = [*map(setting.view.pixel, points)], 0.55 * setting.gauge.bar
    rims = Layer(setting.theme.outline, [at + disc(reach) for at in places])
    inner = Layer(setting.theme.background, [at + disc(0.6 * reach) for at in places])
    return Group("dots", [rims, inner], over=True)


def grid_words(setting: DrawSetting, length_unit: str) -> Group:
    """Return how far the lines of the grid are apart, at the lower right."""
    layout, size = setting.layout, setting.layout.small_size
    words = said("grid {length}", length=f"{significant(grid_step(setting.view, layout), 3)} {length_unit}")
    at = layout.stage.right - layout.margin, layout.stage.bottom - 1.7 * size
    halo = Halo(setting.theme.background, 0.15 * size)
    return Group(
        "grid-words", (), [Caption(words, at, size, setting.theme.dim, "right", halo=halo)], over=True
    )


def chosen(shape: Shape, number: str, setting: DrawSetting, *, is_length: bool) -> Iterator[Group]:
    """Yield the light on the chosen shape, and its number beside one that has a length.

    The number of a bar's length is on a dimension line. Beside a joint is its letter; its numbers are in the
    list.
    """
    loops = [*lit(shape, setting.view, 1.5 * setting.gauge.bar)]
    yield Group("chosen", [Layer(ORANGE, loops, _LIT)], over=True)
    ends = [setting.view.pixel(point) for point in shape.places[:2]]
    if number and len(ends) > 1 and shape.kind not in ("pins", "joints"):
        if shape.kind == "guides":
            ends = [ends[0] - 30 * setting.layout.unit, ends[0] + 30 * setting.layout.unit]
        if is_length:
            words = DimensionLine(_ALONG, 0, 1, number, chosen=False)
            yield from measure(setting, ends[0], ends[1], words)
        else:
            yield label_beside(setting, ends[0], ends[1], number)


class Rubber(NamedTuple):
    """What the hand is drawing from place to place with a tool, and its measures in words."""

    tool: str
    begin: Point
    end: Point
    words: str = ""

    def groups(self, setting: DrawSetting) -> Iterator[Group]:
        """Yield it, and its measures beside it."""
        begin, end = setting.view.pixel(self.begin), setting.view.pixel(self.end)
        yield Group("rubber", [*_tool_mark(self.tool, begin, end, setting)], over=True)
        if self.words:
            words = DimensionLine(_ALONG, 0, 1, self.words, chosen=False)
            yield from measure(setting, begin, end, words)


def _tool_mark(tool: str, begin: complex, end: complex, setting: DrawSetting) -> Iterator[Layer]:
    gauge, theme = setting.gauge, setting.theme
    if tool == "bar":
        colours = theme.outline, mixed(theme.metal, theme.background, 0.3)
        for layer in lined([begin, end], gauge.bar, gauge.outline, colours):
            yield layer._replace(alpha=_FAINT)
    elif tool == "guide":
        yield Layer(theme.ground, [*hatched(begin, end, gauge, 1)], _FAINT)
    else:
        yield Layer(theme.ink, dashes(begin, end, 11.0 * gauge.line, 2.2 * gauge.line))


class Snap(NamedTuple):
    """What is under the hand: a joint, or a line or bar with its ends; and the place on it."""

    at: Point
    ends: tuple[Point, Point] | None = None

    def group(self, setting: DrawSetting) -> Group:
        """Return its mark: a ring, the line lit."""
        view, gauge, theme, layers = setting.view, setting.gauge, setting.theme, list[Layer]()
        if self.ends:
            begin, end = map(view.pixel, self.ends)
            layers.append(Layer(ORANGE, segments(begin, end, 2.4 * gauge.bar), _LIT))
        ring = stroke(view.pixel(self.at) + disc(1.9 * gauge.bar), 1.8 * gauge.line, closed=True)
        return Group("snap", [*layers, Layer(theme.velocity, ring)], over=True)


def crosshair(name: str, place: Point, setting: DrawSetting) -> Group:
    """Return a cross at a place of the sheet."""
    at, arms = setting.view.pixel(place), 0.9 * setting.gauge.bar * np.array([1, 1j])
    cross = Layer(setting.theme.velocity, segments(at - arms, at + arms, 1.3 * setting.gauge.line))
    return Group(name, [cross], over=True)


def pointer(place: Point, setting: DrawSetting) -> Group:
    """Return an arrow such as the mouse's at a place of the sheet."""
    arrow = setting.view.pixel(place) + 1.4 * setting.layout.unit * np.array(_ARROW, np.complex128)
    rim = Layer(setting.theme.background, stroke(arrow, 5 * setting.layout.unit, closed=True))
    return Group("hand", [rim, Layer(setting.theme.ink, [arrow])], over=True)


@frozen
class Head(Addition):
    """A sentence at the picture's head, perhaps as a warning, and facts below it; perhaps beside a slider."""

    sentence: str
    facts: tuple[str, ...] = ()
    is_warning: bool = False
    has_slider: bool = False

    @property
    def is_head(self) -> bool:
        """It stands in the place of the words about the scene."""
        return True

    @property
    def of_window(self) -> bool:
        """It has a place of its own, at the head."""
        return True

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the words, which hide nothing that can be grasped."""
        del pose
        beside = slider_rect(setting.layout) if self.has_slider else None
        yield worded(setting, self.sentence, self.facts, is_warning=self.is_warning, beside=beside)


def worded(
    setting: DrawSetting,
    sentence: str,
    facts: Sequence[str] = (),
    *,
    is_warning: bool = False,
    tools: bool = False,
    beside: Rect | None = None,
) -> Group:
    """Return a sentence and facts below it at the head, off `tools` and what stands `beside`.

    Where they have no room in their usual sizes they are set smaller.
    """
    layout, theme = setting.layout, setting.theme
    head = layout.head or layout.stage
    is_wide = layout.size[0] >= layout.size[1]
    left = max(cell.right for cell in tool_cells(layout)) if tools and is_wide else head.x
    left, top, right = left + layout.margin, head.y + 0.75 * layout.margin, head.right - layout.margin
    wide = (min(right, beside.x - layout.margin) if beside else right) - left
    first, other = layout.text_size, layout.small_size
    while True:
        parts = [(sentence, first, theme.warning if is_warning else theme.ink, True)]
        parts += [(fact, other, theme.dim, False) for fact in facts]
        lines = [
            (line, size, colour, strong)
            for words, size, colour, strong in parts
            for line in (setting.type.wrapped(words, size, wide, strong=strong) if words else ())
        ]
        if sum(HEAD_STEP * size for _, size, *_ in lines) <= head.height or first <= _LEAST_WORDS:
            break
        first, other = max(first - 1, _LEAST_WORDS), min(other, max(first - 1, _LEAST_WORDS))
    captions, y = list[Caption](), top
    for line, size, colour, strong in lines:
        captions.append(Caption(line, (left, y), size, colour, strong=strong))
        y += HEAD_STEP * size
    if not captions:
        return Group("build-words", ())
    broad = max(setting.type.width(one.text, one.size, strong=one.strong) for one in captions)
    edge = 0.5 * layout.small_size
    middle = complex(left + broad / 2, (top + y) / 2)
    plate = middle + box(broad + 2 * edge, y - top + edge, edge)
    return Group("build-words", [Layer(theme.background, [plate])], captions, over=True)
