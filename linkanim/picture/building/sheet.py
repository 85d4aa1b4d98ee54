"""The sheet that a linkage is built on: its grid and ground line, what the hand draws, where it snaps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from linkanim.build.draft import Photo
from linkanim.picture.building.draft import DraftDrawing, draft_gauge, lit
from linkanim.picture.building.photograph import Photograph
from linkanim.picture.building.tools import tool_cells
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group
from linkanim.picture.layout import Layout
from linkanim.picture.panels.building import BuildShown, DraftShown, Rubber, Snap
from linkanim.picture.panels.marks import measure
from linkanim.picture.panels.overlay import DimensionLine
from linkanim.picture.panels.path import sheet
from linkanim.picture.parts.fittings import hatched
from linkanim.picture.raster.parts import lined
from linkanim.picture.raster.raster import Layer
from linkanim.picture.raster.shapes import box, dashes, disc, segments, stroke
from linkanim.picture.theme import ORANGE, mixed
from linkanim.picture.view import Box, View, view_of

_ROOM = 0.86
"""The share of the window that the home of a sheet takes."""
_LINES = 2.4
"""The room for words above, in heights of their text."""
_LIT, _FAINT = 0.45, 0.55
"""How strongly what is chosen is lit, and how much of what the hand draws shows."""
_BACKING = 0.8
"""How little of what lies under the words shows."""
_ARROW = (0j, 17j, 4 + 13j, 7 + 20j, 10 + 18.7j, 7 + 12j, 12.5 + 12j)
"""The corners of a pointer, in units."""
_ALONG = ("begin", "end")
"""The frame of what is measured along itself."""


def home_view(home: Box, layout: Layout) -> View:
    """Return the view in which a rectangle of the scene lies in the middle of a window, as large as fits."""
    above = layout.margin + _LINES * layout.text_size
    room = layout.stage._replace(y=layout.stage.y + above, height=max(layout.stage.height - above, 1))
    return view_of(home, room, _ROOM)


def paper(setting: DrawSetting, photo: Photo | None) -> Group:
    """Return the empty sheet: a light grid over a photograph, and the ground line through the origin."""
    view, layout, gauge, theme = setting.view, setting.layout, setting.gauge, setting.theme
    laid = photo and Photograph(photo, view, theme.background)
    grid, (_, level) = sheet(setting), view.to_pixel(0.0, 0.0)
    width, height = layout.size
    if not -20 * layout.unit < level < height:
        return grid._replace(under=laid)
    faint = mixed(theme.ground, theme.background, 0.62)
    coarse = replace(gauge, bar=2 * gauge.bar)
    ground = Layer(faint, [*hatched(complex(0, level), complex(width, level), coarse, 1)])
    return grid._replace(layers=[*grid.layers, ground], under=laid)


def drafted(shown: BuildShown, draft: DraftShown, setting: DrawSetting) -> Iterator[Group]:
    """Yield a draft that does not move, what the hand does to it, and the words."""
    thick = draft_gauge(setting.layout, setting.view, draft)
    drawing = DraftDrawing(draft, setting.view, thick, setting.theme)
    yield from drawing.groups(setting.layout.small_size)
    yield from hand(shown, replace(setting, gauge=thick))


def loose(draft: DraftShown, setting: DrawSetting) -> Iterator[Group]:
    """Yield what is drawn beside a linkage that moves: guides and pins that nothing holds on to yet."""
    drawing = DraftDrawing(draft, setting.view, setting.gauge, setting.theme)
    yield from drawing.groups(setting.layout.small_size)


def hand(shown: BuildShown, setting: DrawSetting) -> Iterator[Group]:
    """Yield what is chosen, what the hand draws, what that would be joined to, and the words on it all."""
    yield from _chosen(shown, setting)
    if shown.rubber:
        yield from _rubber(shown.rubber, setting)
    if shown.snap:
        yield Group("snap", [*_snap(shown.snap, setting)], over=True)
    for name, at in (("anchor", shown.anchor), ("cursor", shown.cursor)):
        if at:
            yield Group(name, [_crosshair(setting.view.place(at), setting)], over=True)
    if shown.hand and not shown.tools:
        yield Group("hand", [*_pointer(setting.view.place(shown.hand), setting)], over=True)
    yield _words(shown, setting)


def _chosen(shown: BuildShown, setting: DrawSetting) -> Iterator[Group]:
    """Yield the light on what is chosen, and its number beside it."""
    if shown.chosen is None:
        return
    loops = [*lit(shown.chosen, setting.view, 1.5 * setting.gauge.bar)]
    yield Group("chosen", [Layer(ORANGE, loops, _LIT)], over=True)
    if shown.number:
        ends = [setting.view.place(point) for point in shown.chosen.places[:2]]
        if len(ends) < 2 or shown.chosen.kind == "guides":
            ends = [ends[0] - 30 * setting.layout.unit, ends[0] + 30 * setting.layout.unit]
        words = DimensionLine(_ALONG, 0, 1, shown.number, chosen=False)
        yield from measure(setting, ends[0], ends[1], words)


def _rubber(rubber: Rubber, setting: DrawSetting) -> Iterator[Group]:
    """Yield what the hand draws, and its measures beside it."""
    view = setting.view
    begin, end = view.place(rubber.begin), view.place(rubber.end)
    yield Group("rubber", [*_drawn(rubber, begin, end, setting)], over=True)
    if rubber.words:
        words = DimensionLine(_ALONG, 0, 1, rubber.words, chosen=False)
        yield from measure(setting, begin, end, words)


def _drawn(rubber: Rubber, begin: complex, end: complex, setting: DrawSetting) -> Iterator[Layer]:
    gauge, theme = setting.gauge, setting.theme
    if rubber.tool == "bar":
        colours = theme.outline, mixed(theme.metal, theme.background, 0.3)
        for layer in lined([begin, end], gauge.bar, gauge.outline, colours):
            yield layer._replace(alpha=_FAINT)
    elif rubber.tool == "guide":
        yield Layer(theme.ground, [*hatched(begin, end, gauge, 1)], _FAINT)
    else:
        yield Layer(theme.ink, dashes(begin, end, 11.0 * gauge.line, 2.2 * gauge.line))


def _snap(snap: Snap, setting: DrawSetting) -> Iterator[Layer]:
    """Yield the mark of what is under the hand: a ring, the line lit."""
    view, gauge, theme = setting.view, setting.gauge, setting.theme
    at = view.place(snap.at)
    if snap.ends:
        begin, end = map(view.place, snap.ends)
        yield Layer(ORANGE, segments(begin, end, 2.4 * gauge.bar), _LIT)
    yield Layer(theme.velocity, stroke(at + disc(1.9 * gauge.bar), 1.8 * gauge.line, closed=True))


def _crosshair(at: complex, setting: DrawSetting) -> Layer:
    arms = 0.9 * setting.gauge.bar * np.array([1, 1j])
    return Layer(setting.theme.velocity, segments(at - arms, at + arms, 1.3 * setting.gauge.line))


def _pointer(at: complex, setting: DrawSetting) -> Iterator[Layer]:
    """Yield an arrow such as the mouse's."""
    arrow = at + 1.4 * setting.layout.unit * np.array(_ARROW, np.complex128)
    yield Layer(setting.theme.background, stroke(arrow, 5 * setting.layout.unit, closed=True))
    yield Layer(setting.theme.ink, [arrow])


def _words(shown: BuildShown, setting: DrawSetting) -> Group:
    """Return what is missing or what the linkage is, at the top, off the tools, on a backing."""
    layout, theme = setting.layout, setting.theme
    cells = tool_cells(layout, len(shown.tools.tools)) if shown.tools else ()
    beside = max((cell.right for cell in cells), default=0) if layout.size[0] >= layout.size[1] else 0
    left, y, captions = beside + layout.margin, layout.margin, []
    room = 0.93 * (layout.stage.right - layout.margin - left)
    sentence = shown.sentence, layout.text_size, theme.warning if shown.is_warning else theme.ink
    for words, size, colour in (sentence, *((fact, layout.small_size, theme.dim) for fact in shown.facts)):
        for line in setting.type.wrapped(words, size, room):
            captions.append(Caption(line, (left, y), size, colour, strong=size == layout.text_size))
            y += 1.35 * size
    if not captions:
        return Group("build-words", ())
    wide = max(setting.type.width(one.text, one.size, strong=one.strong) for one in captions)
    edge = 0.5 * layout.small_size
    middle = complex(left + wide / 2, (layout.margin + y) / 2)
    plate = middle + box(wide + 2 * edge, y - layout.margin + 2 * edge, edge)
    return Group("build-words", [Layer(theme.background, [plate], _BACKING)], captions, over=True)
