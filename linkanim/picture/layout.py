"""Where things stand in a picture, and how large they are for its size: one slot for each kind of thing.

The title and the readout stand in one column at the top left, the legend below them; charts and polygons at
the side, right of the linkage or under it; the caption in a line at the foot, over which in a window the bar
of commands comes and goes. Lists take the column's place. The stage is what these leave to the linkage;
nothing else is drawn there.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from math import ceil
from typing import NamedTuple

from linkanim.frozen import frozen
from linkanim.picture.view import Rect

_DRAWN_FOR = (1280, 720)
SMALL = 17.0
"""The height of small text, in units."""
_LETTERS = {"title": (30.0, 15), "text": (21.0, 13), "label": (20.0, 12), "small": (SMALL, 11)}
"""The one scale of letters: heights of lines in units, and the least in pixels."""
MARGIN = 20.0
"""The margin everywhere, in units."""
_MARGIN_OF_STILL = 0.04
"""The margin round a still, in shorter sides of it."""
_EDGE = 10.8
"""From the window's edge to a list, in units."""
_SHARES_BELOW, _SHARE_BESIDE = (0.27, 0.41, 0.52), 0.45
"""The share of the height that one, two or three charts below take; that of the width beside the linkage."""
_ROW_OF_ANSWERS = 0.17
"""The height of a row of small pictures, in heights of the window."""
_SLIDER = 1.9
"""The height of a slider's room, in heights of small text."""
_BUTTON, _LEAST_BUTTON = 34.0, 28.0
"""The side of a button in units, and the least in pixels: a finger has to find it."""
_BAR = 1.25
"""The height of the bar of commands, in sides of a button."""
_SHARE_OF_BAR = 0.16
"""The greatest share of the height that the bar takes."""
_LITTLE_FOR_BAR = 0.05
"""Where the bar needs a greater share of the height beyond the stage's margin, it has no room of its own."""
_MUCH_FOR_BAR = 0.12
"""Where the bar needs a greater share of the height, what is open has room where the bar comes and goes."""
_FOOT = 1.6
"""The height of a window's caption, in heights of its text."""
CAPTION_STEP = 1.25
"""The step from line to line of a caption, in heights of its text."""
HEAD_STEP = 1.35
"""The step from line to line of a sentence at the head, in heights of its text."""
_NARROW = 30
"""A window narrower than so many heights of its text has a list at its foot, not at its left."""
_SHARE_LISTED = 0.42
"""A list's share of the height at the foot."""
_TALLEST = 0.42
"""The height of a chart beside the linkage, in widths of the window; of several, twice that."""
HEAD_OF_CHART = 25.5
"""The room of a chart's title and of the values read from the chart, in heights of text."""
_BUTTONS, _ROW_OF_BUTTONS = 5.5, 1.4
"""The width of a chart's buttons and the height of a row of them, in sides of a button."""
_SHARES_OF_POLYGONS, _BELOW = (0.36, 0.6), 1.3
"""The polygons' share of the width: of both, and of a single large one. Below, their share is greater."""
_POLYGONS_OVER_CHART = 0.56
"""The polygons' share of a side that they share with charts."""


class Docked(NamedTuple):
    """What has room of its own in a window, apart from the linkage and its charts."""

    listed: int = 0
    """1 for an open list, instead of the readout; 2 for one with tools beside it."""
    row: bool = False
    """Whether there is a row of small pictures, at the foot."""
    bar: bool = False
    """Whether there is a foot for what is said in passing, and for the bar of commands."""
    head: bool = False
    """Whether a sentence stands at the head, instead of the title: of a sheet, or a construction's step."""


NOTHING_DOCKED = Docked()


@frozen
class Layout:
    """The slots of a picture; `unit` is the size of a pixel of a picture of 1280 × 720, or of 720 × 1280."""

    size: tuple[int, int]
    unit: float
    stage: Rect
    """The room of the linkage."""
    head: Rect | None = None
    """The room of a sentence and of a slider beside it."""
    hud: Rect | None = None
    """The title and the readout."""
    legend: Rect | None = None
    """The key to the colours and what is listed, below the readout."""
    chart: Rect | None = None
    polygons: Rect | None = None
    caption: Rect | None = None
    """The foot, for one line of words in its middle."""
    bar: Rect | None = None
    """Where the bar of commands comes and goes: over the caption, in the stage's margin."""
    lists: Rect = Rect(0, 0, 1, 1)
    """Where a list stands, if one is open."""
    room: Rect | None = None
    """What an open list leaves of the window; None where no list is open."""
    row: Rect | None = None
    """Where a row of small pictures stands, if there is one."""
    dial: Rect | None = None
    """Where a slider stands above the row of small pictures."""
    type_scale: float = 1.0
    """How many times larger words are than usual in a window of that size."""

    @cached_property
    def above_bar(self) -> float:
        """The height of the window above the bar; the whole height where that is little."""
        kept = self.bar and self.bar.height <= _MUCH_FOR_BAR * self.size[1]
        return self.bar.y if self.bar and kept else self.size[1]

    @property
    def title_size(self) -> int:
        """The height of the title."""
        return self._letters("title")

    @property
    def text_size(self) -> int:
        """The height of text that must read from the back row."""
        return self._letters("text")

    @property
    def label_size(self) -> int:
        """The height of joints' letters."""
        return self._letters("label")

    @property
    def small_size(self) -> int:
        """The height of tick labels and of names of links."""
        return self._letters("small")

    def _letters(self, kind: str) -> int:
        units, least = _LETTERS[kind]
        return max(round(units * self.unit * self.type_scale), least)

    @property
    def button(self) -> float:
        """The side of a button of the bar of commands."""
        return max(min(max(_BUTTON * self.unit, _LEAST_BUTTON), _SHARE_OF_BAR * self.size[1] / _BAR), 2.0)

    @property
    def margin(self) -> float:
        """The margin, in pixels."""
        return max(MARGIN * self.unit, 6.0)

    @property
    def marks(self) -> Rect:
        """Where the marks of recording and pause stand: at the right end of the foot."""
        foot, edge = (
            self.caption or self.stage._replace(y=self.stage.bottom - 2 * self.text_size),
            self.margin,
        )
        wide, high = 0.22 * foot.width, 1.2 * self.text_size
        return Rect(foot.right - edge - wide, foot.y + (foot.height - high) / 2, wide, high)


def layout(size: tuple[int, int], *, docked: Docked = NOTHING_DOCKED, type_scale: float = 1.0) -> Layout:
    """Return the slots that do not depend on what is shown: lists, rows, the foot; the stage is the rest."""
    unit = min(max(size) / _DRAWN_FOR[0], min(size) / _DRAWN_FOR[1])
    whole = Rect(0, 0, *size)
    parts = Layout(size, unit, whole, type_scale=type_scale)
    if docked.bar or docked.row:
        # across the whole window, below a list: the bar stands still while a list opens and closes
        line, deep = _FOOT * parts.small_size, _BAR * parts.button
        foot = whole._replace(y=whole.bottom - line, height=line)
        bar = whole._replace(y=foot.y - deep, height=deep)
        # the bar comes and goes in half the stage's margin, and in what it needs beyond that
        beyond = deep if docked.row else deep - parts.margin / 2
        beyond = beyond if docked.row or beyond <= _LITTLE_FOR_BAR * size[1] else 0.0
        parts, whole = replace(parts, bar=bar, caption=foot), whole._replace(height=foot.y - beyond)
    parts = replace(parts, lists=_lists(parts))
    room = _beside_list(parts.lists, whole) if docked.listed else whole
    if parts.bar and docked.listed and parts.above_bar > parts.bar.y:
        top = min(parts.bar.y, room.bottom - parts.bar.height)
        parts = replace(parts, bar=parts.bar._replace(x=room.x, y=top, width=room.width))
    parts = replace(parts, room=room if docked.listed else None)
    room = _beside_tools(parts, room) if docked.listed > 1 else room
    if docked.head:
        head = room._replace(height=1.5 * parts.margin + HEAD_STEP * (parts.text_size + parts.small_size))
        parts, room = (
            replace(parts, head=head),
            Rect(room.x, head.bottom, room.width, room.bottom - head.bottom),
        )
    if docked.row:
        high, slider = _ROW_OF_ANSWERS * size[1], _SLIDER * parts.small_size
        place = Rect(room.x, room.bottom - high, room.width, high).inset(4 * unit)
        dial = Rect(room.x, place.y - slider, room.width, slider)
        parts, room = replace(parts, row=place, dial=dial), room._replace(height=dial.y - room.y)
    return replace(parts, stage=room)


def with_caption(parts: Layout, lines: int) -> Layout:
    """Return slots with a foot for so many lines of words; the foot of a window stays as it is."""
    if parts.caption or not lines:
        return parts
    stage, deep = parts.stage, lines * CAPTION_STEP * parts.small_size + 1.2 * parts.margin
    foot = Rect(stage.x, stage.bottom - deep, stage.width, deep)
    return replace(parts, caption=foot, stage=stage._replace(height=foot.y - stage.y))


def with_side(parts: Layout, charts: int, polygons: int, *, beside: bool) -> Layout:
    """Return slots with charts and polygons right of the linkage or under it.

    `polygons` is 2 for a large one.
    """
    if not charts and not polygons:
        return parts
    stage, edge = parts.stage, parts.margin
    shares = _SHARES_OF_POLYGONS[polygons - 1] * (1.0 if beside else _BELOW) if polygons else 0.0
    if beside:
        wide = max(_SHARE_BESIDE if charts else 0.0, shares) * stage.width
        side = Rect(stage.right - wide, stage.y + edge, wide - edge, stage.height - 2 * edge)
        if charts and parts.bar and side.width < HEAD_OF_CHART * parts.text_size + _BUTTONS * parts.button:
            foot = min(side.bottom, parts.bar.y) - _ROW_OF_BUTTONS * parts.button
            side = side._replace(height=foot - side.y)
        rest = stage._replace(width=stage.width - wide - edge / 2)
        polygon, chart = _over_each_other(side, charts, polygons, edge)
        if chart:
            high = min(chart.height, _TALLEST * stage.width * min(charts, 2))
            chart = chart._replace(y=chart.y + (chart.height - high) / 2, height=high)
    else:
        high = (
            max(_SHARES_BELOW[min(charts, len(_SHARES_BELOW)) - 1] if charts else 0.0, shares) * stage.height
        )
        side = Rect(stage.x + edge, stage.bottom - high, stage.width - 2 * edge, high - edge)
        rest = stage._replace(height=stage.height - high - edge / 2)
        polygon, chart = _beside_each_other(side, charts, polygons, edge)
    return replace(parts, stage=rest, chart=chart if charts else None, polygons=polygon if polygons else None)


def _over_each_other(side: Rect, charts: int, polygons: int, gap: float) -> tuple[Rect, Rect]:
    """Return the rooms of polygons and charts in a tall side."""
    high = _POLYGONS_OVER_CHART * side.height if charts and polygons else side.height
    if not (charts and polygons):
        return side, side
    return side._replace(height=high - gap), side._replace(y=side.y + high, height=side.height - high)


def _beside_each_other(side: Rect, charts: int, polygons: int, gap: float) -> tuple[Rect, Rect]:
    """Return the rooms of polygons and charts in a wide side."""
    wide = _POLYGONS_OVER_CHART * side.width
    if not (charts and polygons):
        return side, side
    return side._replace(width=wide - gap), side._replace(x=side.x + wide, width=side.width - wide)


def with_words(parts: Layout, block: tuple[float, float], key: float, *, above: bool) -> Layout | None:
    """Return slots with a column of words of this size, whose legend begins `key` pixels down.

    The linkage is right of them or, with the words `above`, below them. None where they have no room.
    """
    stage, edge, (wide, high) = parts.stage, parts.margin, block
    if wide + 2 * edge > stage.width or high + 2 * edge > stage.height:
        return None
    hud = Rect(stage.x + edge, stage.y + edge, wide, min(key, high))
    legend = Rect(hud.x, hud.y + key, wide, high - key) if high > key else None
    if above:
        taken = high + edge
        rest = stage._replace(y=stage.y + taken, height=stage.height - taken)
    else:
        taken = wide + edge
        rest = stage._replace(x=stage.x + taken, width=stage.width - taken)
    return replace(parts, hud=hud, legend=legend, stage=rest)


def room_of(parts: Layout, *, still: bool) -> Rect:
    """Return the part of the stage that the linkage and its names may fill."""
    return parts.stage.inset(_MARGIN_OF_STILL * min(parts.size) if still else parts.margin)


# The tools beside a list of dimensions, and on a sheet.

_SIDE, _LEAST, _FEWEST = 40.0, 22.0, 12.0
"""The side of an icon in units; the least in pixels; the least where icons need more than one row."""
_GAP = 0.12
"""The gap between icons, in sides of an icon."""


def tool_cells(layout: Layout) -> tuple[Rect, ...]:
    """Return where the tools stand: in columns at the left, in rows at the foot of an upright window.

    Beside an open list it is the left, or the foot, of the room that the list leaves.
    """
    from linkanim.build.tools import TOOLS

    edge, count, upright = 10.8 * layout.unit, len(TOOLS), layout.size[0] < layout.size[1]
    x, y, width, height = layout.room or Rect(0, 0, *layout.size)
    long = width - 2 * edge if upright else height - 2 * edge
    side = max(min(_SIDE * layout.unit, long / count / (1 + _GAP)), min(_LEAST, long / 4), 1.0)
    step = (1 + _GAP) * side
    each = max(int((long + _GAP * side) / step), 1)
    lines = ceil(count / each)
    places = [divmod(n, ceil(count / lines)) for n in range(count)]
    if not upright:
        top = y + (height - ceil(count / lines) * step) / 2
        return tuple(Rect(x + edge + line * step, top + n * step, side, side) for line, n in places)
    left, foot = x + (width - ceil(count / lines) * step) / 2, y + height - edge - lines * step
    return tuple(Rect(left + n * step, foot + line * step, side, side) for line, n in places)


def _beside_tools(parts: Layout, room: Rect) -> Rect:
    """Return what the tools leave of the room that a list leaves."""
    cells = tool_cells(replace(parts, room=room))
    if parts.size[0] < parts.size[1]:
        return room._replace(height=min(cell.y for cell in cells) - room.y)
    right = max(cell.right for cell in cells)
    return Rect(right, room.y, room.right - right, room.height)


def _lists(parts: Layout) -> Rect:
    """Return where a list stands: at the left over the whole height, in a narrow window at the foot."""
    width, height = parts.size[0], parts.above_bar
    text, margin = parts.text_size, round(_EDGE * parts.unit)
    if width < _NARROW * text:
        high = _SHARE_LISTED * height
        return Rect(margin, height - high - margin, width - 2 * margin, high)
    wide = round(min(max(19.0 * text, 0.3 * width), 0.5 * width))
    return Rect(margin, margin, wide, height - 2 * margin)


def _beside_list(lists: Rect, whole: Rect) -> Rect:
    """Return what a list leaves of the window."""
    if lists.y > lists.x:
        return whole._replace(height=lists.y - lists.x)
    left = lists.right + lists.x
    return Rect(left, 0, whole.width - left, whole.height)


@frozen
class Gauge:
    """How thick things are drawn, in pixels."""

    bar: float
    """Half the width of a bar."""
    outline: float
    pin: float
    line: float
    """The width of a thin line."""

    @property
    def around(self) -> tuple[float, float, float]:
        """How far drawing extends around a wheel's rim, around a joint, and around a pedestal, in pixels."""
        return self.line, self.bar + self.outline, 3.3 * self.bar + 2 * self.outline


def gauge(unit: float, shortest: float) -> Gauge:
    """Return the thicknesses for a window's unit and the shortest bar, in pixels; thinner for a short bar."""
    bar = min(10.5 * unit, max(0.2 * shortest, 5.5 * unit))
    return Gauge(bar=bar, outline=1.7 * unit, pin=0.5 * bar, line=1.8 * unit)
