"""Where things stand in the window, and how large they are for its size."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from itertools import product
from math import ceil

from linkanim.frozen import NamedTuple, frozen
from linkanim.picture.view import Rect

_DRAWN_FOR = (1280, 720)
TEXT, SMALL = 21.0, 17.0
"""The heights of text and of small text, in units."""
_EDGE = 10.8
"""From the window's edge to the edit list, in units."""
_SHARES_BELOW, _SHARE_BESIDE = (0.27, 0.41, 0.52), 0.45
"""The share of the height that one, two or three charts below take; that of the width beside the scene."""
_ROW_OF_ANSWERS = 0.17
"""The height of a row of small pictures, in heights of the window."""
_SLIDER = 1.9
"""The height of a slider's room, in heights of small text."""
_BUTTON, _LEAST_BUTTON = 40.0, 28.0
"""The side of a button in units, and the least in pixels: a finger has to find it."""
_BAR = 1.6
"""The height of a bar of buttons with its margins, in sides of a button."""
_SHARE_OF_BAR = 0.3
"""The greatest share of the height that the bar takes."""
_LITTLE_FOR_BAR = 0.13
"""Where the bar would take a greater share of the height, it has no room but lies over the scene's foot."""
_NARROW = 30
"""A window narrower than so many heights of its text has a list at its foot, not at its left."""
_SHARE_LISTED = 0.42
"""A list's share of the height at the foot."""
_MARGIN, _OFF = 20.0, 0.6
"""The margin around charts and polygons, in units, and the gap between them and the stage, in margins."""
_HEAD_OF_MARKS = 1.5
"""The height of the marks of recording and pause, in heights of their text: a chart begins below them."""
_TALLEST = 0.42
"""The height of a chart beside the scene, in widths of the window; of several below each other twice that."""
HEAD_OF_CHART = 25.5
"""The room of a chart's title and of the values read from the chart, in heights of text."""
_BUTTONS, _ROW_OF_BUTTONS = 5.2, 1.5
"""The room of a chart's buttons across, and below its foot where its head has none, in sides of one."""
_ROW = 1.3
"""The step from row to row of a table, in heights of its text."""
_SMALLEST_ROW = 8
_SHARE_OF_TABLE = 0.27
"""A table that would take a greater share of the stage's width, or height, is set smaller, to that size."""
CAPTION_STEP = 1.25
"""The step from line to line of a caption, in heights of its text."""
_SHARE_OF_CAPTION = 0.16
"""The greatest share of the stage's height that a caption takes."""
_SHARES_OF_POLYGONS = (0.38, 0.6)
"""The polygons' share of the room that a chart leaves: of its width, or of its height if that is greater.

The second number is the share of a single large polygon.
"""


class Docked(NamedTuple):
    """What has room of its own in a window, apart from the scene and its charts."""

    listed: int = 0
    """1 for an open list, instead of the HUD; 2 for one with tools beside it."""
    row: bool = False
    """Whether there is a row of small pictures, at the foot."""
    bar: bool = False
    """Whether the bar of commands has room, at the foot."""


NOTHING_DOCKED = Docked()


@frozen
class Layout:
    """The parts of a window; `unit` is the size of a pixel of a window of 1280 × 720, or of 720 × 1280."""

    size: tuple[int, int]
    unit: float
    stage: Rect
    """The room that chart and edit list leave to the scene and the words about it."""
    hud: Rect | None
    legend: Rect | None
    """The key to the vectors, at the foot of the HUD."""
    chart: Rect | None
    marks: Rect
    """Where the marks of recording and pause stand: in the window's upper right corner."""
    lists: Rect
    """Where the edit list or that of quantities stands, if one is open."""
    polygons: Rect | None = None
    hint: Rect | None = None
    """Where the words on which keys to press stand; without width where there is no room for them."""
    row: Rect | None = None
    """Where a row of small pictures stands, if there is one."""
    dial: Rect | None = None
    """Where a slider stands above the row of small pictures."""
    bar: Rect | None = None
    """Where the bar of commands stands, if it has room of its own; else it lies over the stage's foot."""
    table: Rect | None = None
    """Where a table of dimensions stands, if it is given room."""
    caption: Rect | None = None
    """Where the sentence on what to watch for stands, if it is given room."""
    passing: Rect | None = None
    """Where that sentence may stand for a while, off all that is drawn; None where there is no such place."""
    room: Rect | None = None
    """What an open list leaves of the window; None where no list is open."""
    words: tuple[Rect, ...] = ()
    """The parts of the HUD and of the key that hold words: names keep off these."""
    type_scale: float = 1.0
    """How many times larger words are than usual in a window of that size."""

    @cached_property
    def above_bar(self) -> float:
        """The height of the window above the bar of commands, where that has room at the foot."""
        low = self.size[1]
        return self.bar.y if self.bar and self.bar.bottom >= low - 1 else low

    @cached_property
    def reach(self) -> Rect:
        """The room in which a zoomed scene is drawn: up to chart and polygons, and under the edit list."""
        right, bottom = self.size
        for beside in (self.chart, self.polygons):
            if beside and beside.x >= self.stage.right:
                right = min(right, int(self.stage.right))
            elif beside:
                bottom = min(bottom, int(beside.y))
        return Rect(0, 0, right, bottom)

    @cached_property
    def before_charts(self) -> Rect:
        """The same where polygons have no place yet: up to the charts."""
        (right, bottom), chart = self.size, self.chart
        if chart and chart.x >= self.stage.right:
            right = int(chart.x - _OFF * _MARGIN * self.unit)
        elif chart:
            bottom = int(chart.y)
        return Rect(0, 0, right, bottom)

    @property
    def text_size(self) -> int:
        """The height of text that must read from the back row."""
        return max(round(TEXT * self.unit * self.type_scale), 13)

    @property
    def small_size(self) -> int:
        """The height of tick labels and hints."""
        return max(round(SMALL * self.unit * self.type_scale), 11)

    @property
    def button(self) -> float:
        """The side of a button of the bar of commands."""
        room = self.bar.height if self.bar else _SHARE_OF_BAR * self.stage.height
        return max(min(max(_BUTTON * self.unit, _LEAST_BUTTON), room / _BAR), 2.0)

    @property
    def margin(self) -> float:
        """How far words keep from the stage's edges, in pixels."""
        return max(20 * self.unit, 6.0)


def layout(
    size: tuple[int, int],
    *,
    chart: int = 0,
    beside: bool = False,
    listed: int = 0,
    polygons: int = 0,
    row: bool = False,
    bar: bool = False,
    type_scale: float = 1.0,
) -> Layout:
    """Divide a window: `chart` charts along the bottom, or `beside` the scene; the stage is what is left.

    `listed` leaves room for a list, on the left or, in a narrow window, at the foot; where it is 2, also for
    tools beside the list. `polygons` leaves room for polygons, on the right or below, and more where it is 2,
    for a large one. `row` leaves room for small pictures at the foot, with the bar of commands below them.
    The `bar` has room at the foot without a row, too, where that takes little height. The HUD has no place
    yet: that depends on the scene. Words are `type_scale` times as large as usual.
    """
    unit = min(max(size) / _DRAWN_FOR[0], min(size) / _DRAWN_FOR[1])
    whole = Rect(0, 0, *size)
    empty = Layout(size, unit, whole, None, None, None, whole, whole, type_scale=type_scale)
    parts = _charted(empty, chart=chart, beside=beside, listed=listed, row=row, bar=bar)
    if not polygons:
        return parts
    stage, edge, share = parts.stage, _MARGIN * parts.unit, _SHARES_OF_POLYGONS[polygons - 1]
    if stage.width >= stage.height:
        wide = share * stage.width
        # in a window that has a bar, charts begin below the mark of pause
        top = edge + (_HEAD_OF_MARKS * parts.text_size if bar else 0.0)
        place = Rect(stage.right - wide, top, wide - edge, stage.height - top - edge)
        return replace(parts, polygons=place, stage=stage._replace(width=stage.width - wide - _OFF * edge))
    high = share * stage.height
    place = Rect(stage.x + edge, stage.bottom - high, stage.width - 2 * edge, high - edge)
    return replace(parts, polygons=place, stage=stage._replace(height=stage.height - high - _OFF * edge))


def with_table(parts: Layout, rows: int, wide: float, head: float = 0.0) -> Layout:
    """Return a layout with room for a table beside the stage or below it, whichever takes less of it.

    Beside the stage the table begins `head` pixels down, below the marks.
    """
    stage, edge = parts.stage, parts.margin
    for size in range(parts.small_size, _SMALLEST_ROW - 1, -1):
        step, broad_row = _ROW * size, wide * size / parts.small_size
        columns = ceil(rows * step / max(stage.height - 2 * edge - head, 1))
        across = max(int((stage.width - 2 * edge) / broad_row), 1)
        broad, deep = columns * broad_row + edge, ceil(rows / across) * step + edge
        if min(broad / stage.width, deep / stage.height) < _SHARE_OF_TABLE:
            break
    if broad / stage.width < deep / stage.height:
        high = stage.height - 2 * edge - head
        place = Rect(stage.right - broad, stage.y + edge + head, broad - edge, high)
        return replace(parts, table=place, stage=stage._replace(width=stage.width - broad))
    place = Rect(stage.x + edge, stage.bottom - deep, stage.width - 2 * edge, deep - edge)
    return replace(parts, table=place, stage=stage._replace(height=stage.height - deep))


def with_caption(parts: Layout, lines: int) -> Layout:
    """Return a layout with room for `lines` of text where the bar comes and goes, or at the stage's foot.

    At the stage's foot there is room only where the lines take little of it.
    """
    stage, edge, size = parts.stage, parts.margin, parts.small_size
    deep, bar = lines * CAPTION_STEP * size, parts.bar
    if lines and bar and deep <= bar.height:
        top = bar.y + (bar.height - deep) / 2
        return replace(parts, caption=Rect(bar.x + edge, top, bar.width - 2 * edge, deep))
    if not lines or deep + edge > _SHARE_OF_CAPTION * stage.height:
        return parts
    place = Rect(stage.x + edge, stage.bottom - deep - 0.6 * edge, stage.width - 2 * edge, deep)
    return replace(parts, caption=place, stage=stage._replace(height=place.y - stage.y))


def _charted(empty: Layout, *, chart: int, beside: bool, listed: int, row: bool, bar: bool) -> Layout:
    """Return a layout with chart, list, row and bar placed, but without polygons."""
    unit, whole, edge = empty.unit, empty.stage, _MARGIN * empty.unit
    deep = min(_BAR * max(_BUTTON * unit, _LEAST_BUTTON), _SHARE_OF_BAR * whole.height)
    if row or (bar and deep <= _LITTLE_FOR_BAR * whole.height):
        # at the window's foot, below a list: the bar stands still while a list opens and closes
        whole = whole._replace(height=whole.height - deep)
        empty = replace(empty, bar=Rect(0, whole.bottom, whole.width, deep))
    empty = replace(empty, lists=_lists(empty))
    room = _beside(empty.lists, whole) if listed else whole
    empty = replace(empty, room=room if listed else None)
    room = _beside_tools(empty, room) if listed > 1 else room
    if row:
        high, slider = _ROW_OF_ANSWERS * (room.height + deep), _SLIDER * empty.small_size
        place = Rect(room.x, room.bottom - high, room.width, high).inset(4 * unit)
        dial = Rect(room.x, place.y - slider, room.width, slider)
        empty = replace(empty, row=place, dial=dial)
        room = room._replace(height=dial.y - room.y)
    if not chart:
        return replace(empty, stage=room)
    if beside:
        head = edge + _HEAD_OF_MARKS * empty.text_size
        tallest = _TALLEST * room.width * min(chart, 2)
        wide, below = _SHARE_BESIDE * room.width, edge
        if bar and wide - edge < HEAD_OF_CHART * empty.text_size + _BUTTONS * empty.button:
            below = max(edge, _ROW_OF_BUTTONS * empty.button)
        high = min(room.height - head - below, tallest)
        top = max(min((room.height - high) / 2, room.height - below - high), head)
        chart_place = Rect(room.right - wide, top, wide - edge, high)
        return replace(empty, stage=room._replace(width=room.width - wide - _OFF * edge), chart=chart_place)
    tall = _SHARES_BELOW[min(chart, len(_SHARES_BELOW)) - 1] * room.height
    chart_place = Rect(room.x + edge, room.bottom - edge - tall, room.width - 2 * edge, tall)
    return replace(empty, stage=room._replace(height=chart_place.y - _OFF * edge), chart=chart_place)


_HEIGHT_OF_CHIP = 1.7
"""The height of a chip, in heights of its text."""


def chip_places(parts: Layout, wide: float) -> Iterator[Rect]:
    """Yield where a chip so many pixels wide may stand: below the marks, in corners, between these."""
    edge, size = round(_EDGE * parts.unit), parts.text_size
    room, high = parts.stage.inset(edge), round(_HEIGHT_OF_CHIP * size)
    # charts and polygons have their words at their head
    docked = any(one is not None and one.x >= parts.stage.right for one in (parts.chart, parts.polygons))
    right = room.right if docked else parts.marks.right
    yield Rect(right - wide, parts.marks.y + _HEAD_OF_MARKS * size, wide, high)
    for across, low in product((1, 0, 0.5), (1, 0)):
        yield Rect(room.x + across * (room.width - wide), room.y + low * (room.height - high), wide, high)


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


def _beside(lists: Rect, whole: Rect) -> Rect:
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
