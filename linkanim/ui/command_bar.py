"""The bar of commands at the scene's foot: its buttons' places, their drawing, and their names."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import accumulate
from typing import NamedTuple

import pygame

from linkanim.picture.board import Board
from linkanim.picture.items import Target
from linkanim.picture.layout import HEAD_OF_CHART, Gauge, Layout
from linkanim.picture.raster import Layer, Loop, paint
from linkanim.picture.shapes import box, disc
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect
from linkanim.player.commands import Button
from linkanim.ui.command_icons import COMMAND_ICONS

_GAP, _BETWEEN = 0.06, 0.3
"""The gaps between buttons and between their groups, in sides of a button, as the sizes below."""
_FRAME = 0.14
_ABOVE, _BELOW = 0.3, 0.2
"""How far a chart's buttons extend above its head; how far below its foot they are where they stand there."""
_READING = 7.5
"""The room of the values at a chart's head, in heights of text."""
_SLIDER = 3.0
_WITHIN = 0.35
"""From a slider's end to the end of its knob's range."""
_MOST_FACES = 200
"""The number of cached buttons above which they are drawn anew: a knob that is dragged has many places."""
_GREY = 0.68
"""The share of the panel's colour in a button that cannot be used."""
_POINTED = 0.5


def bar_cells(layout: Layout, buttons: Sequence[Button]) -> tuple[Rect | None, ...]:
    """Return where each button stands: in the middle of the scene's foot, or of the chart's head.

    None where there is no room.
    """
    side, foot, chart = layout.button, layout.bar or layout.stage, layout.chart
    top = foot.bottom - (1 + _FRAME) * side
    cells = _row(buttons, _numbers(buttons, on_chart=False), foot, top, layout)
    if chart:
        on_chart = _numbers(buttons, on_chart=True)
        room, top = _at_chart(chart, _wide(buttons, on_chart) * side, layout)
        cells |= _row(buttons, on_chart, room, top, layout)
    return tuple(cells.get(n) for n in range(len(buttons)))


def _at_chart(chart: Rect, wide: float, layout: Layout) -> tuple[Rect, float]:
    """Return the room of a chart's buttons across, and its top.

    At the chart's head this is its whole width, or the part between its title and its reading. For a chart
    too narrow for that, it is below the chart's foot, where there is room.
    """
    side, head = layout.button, chart.y - _ABOVE * layout.button
    reading = _READING * layout.text_size
    title = HEAD_OF_CHART * layout.text_size - reading
    if (chart.width - wide) / 2 >= title:
        return chart, head
    needed = 1.01 * (wide + 2 * _FRAME * side + 2 * _edge(layout))
    foot = chart.bottom + _BELOW * side
    if title + needed + reading > chart.width and foot + (1 + _FRAME) * side <= layout.above_bar:
        return chart, foot
    left = max(chart.width - reading - needed, 0.0)
    return chart._replace(x=chart.x + left, width=min(needed, chart.width)), head


def _numbers(buttons: Sequence[Button], *, on_chart: bool) -> list[int]:
    return [n for n, button in enumerate(buttons) if button.on_chart == on_chart]


def _row(
    buttons: Sequence[Button], kept: list[int], room: Rect, top: float, layout: Layout
) -> dict[int, Rect]:
    """Return where buttons stand in a row in the middle of a room, without buttons that have no room."""
    side = layout.button
    while len(kept) > 1 and _wide(buttons, kept) * side > room.width - 2 * _FRAME * side - 2 * _edge(layout):
        kept.remove(max(kept, key=lambda n: buttons[n].rank))
    cells: dict[int, Rect] = {}
    left = room.x + (room.width - _wide(buttons, kept) * side) / 2
    for n, (gap, wide) in zip(kept, _spaced(buttons, kept), strict=True):
        cells[n] = Rect(left + gap * side, top, wide * side, side)
        left += (gap + wide) * side
    return cells


def share_at(cell: Rect, x: float) -> float:
    """Return how far along the slider in a cell a pixel is, 0 to 1."""
    begin, end = _rail(cell)
    return min(max((x - begin) / max(end - begin, 1.0), 0.0), 1.0)


def _edge(layout: Layout) -> float:
    """Return how far the bar keeps from the stage's edges, in pixels."""
    return 6.0 * layout.unit


def _spaced(buttons: Sequence[Button], kept: list[int]) -> list[tuple[float, float]]:
    """Return the gap before each button, wider where a group has begun since the last, and its width."""
    spaced, last = list[tuple[float, float]](), -1
    for n in kept:
        leads = any(one.leads for one in buttons[last + 1 : n + 1])
        gap = (_BETWEEN if leads else _GAP) if spaced else 0.0
        spaced.append((gap, 1.0 if buttons[n].share is None else _SLIDER))
        last = n
    return spaced


def _wide(buttons: Sequence[Button], kept: list[int]) -> float:
    return sum(gap + wide for gap, wide in _spaced(buttons, kept))


def _frames(
    layout: Layout, buttons: Sequence[Button], cells: Sequence[Rect | None]
) -> Iterator[tuple[Rect, bool]]:
    """Yield the sheets about the buttons at the foot, and about those on the chart; and whether on that."""
    by = _FRAME * layout.button
    for on_chart in (False, True):
        seen = [cell for cell in (cells[n] for n in _numbers(buttons, on_chart=on_chart)) if cell]
        if seen:
            left, top = seen[0].x - by, seen[0].y - by
            yield Rect(left, top, seen[-1].right + by - left, seen[0].height + 2 * by), on_chart


def _rail(cell: Rect) -> tuple[float, float]:
    """Return the left and the right end of a slider's knob's range."""
    return cell.x + _WITHIN * cell.height, cell.right - _WITHIN * cell.height


Laid = tuple[pygame.Surface, tuple[int, int]]
"""A sheet, and where its upper left corner is in the window."""


class CommandBar:
    """The bar of commands; each button in each of its states is drawn once."""

    def __init__(self) -> None:
        self._theme: Theme | None = None
        self._faces: dict[_Sized, pygame.Surface] = {}

    def drawn(
        self, board: Board, shown: tuple[tuple[Button, ...], int | None]
    ) -> tuple[list[Laid], list[Target]]:
        """Return the sheets of the buttons, one of which may be under the mouse, and their places."""
        buttons, layout = shown[0], board.layout
        if board.theme != self._theme:
            self._theme, self._faces = board.theme, {}
        cells = bar_cells(layout, buttons)
        frames = [frame for frame, _ in _frames(layout, buttons, cells)]
        sheets = [
            (self._sheet(board, frame, cells, shown), (round(frame.x), round(frame.y))) for frame in frames
        ]
        places = (Target("button", cell, n) for n, cell in enumerate(cells) if cell)
        return sheets, [*(Target("bar", frame) for frame in frames), *places]

    def _sheet(
        self,
        board: Board,
        frame: Rect,
        cells: Sequence[Rect | None],
        shown: tuple[tuple[Button, ...], int | None],
    ) -> pygame.Surface:
        (buttons, pointed), sheet = shown, board.sheet(frame.width, frame.height)
        seen: list[tuple[Rect, _Sized]] = []
        for n, (cell, button) in enumerate(zip(cells, buttons, strict=True)):
            if cell and frame.meets(cell):
                face = _Face(button.icon, button.on, bool(button.lack), button.share, n == pointed)
                seen.append((cell, ((round(cell.width), round(cell.height)), face)))
        if len(self._faces) > _MOST_FACES:
            self._faces.clear()
        fresh = dict.fromkeys(sized for _, sized in seen if sized not in self._faces)
        self._faces |= _faces(board.theme, fresh)
        for cell, sized in seen:
            sheet.blit(self._faces[sized], (round(cell.x - frame.x), round(cell.y - frame.y)))
        return sheet


class _Face(NamedTuple):
    """How a button looks: its icon, whether it is on, greyed or under the mouse, where its knob is."""

    icon: str
    on: bool
    grey: bool
    share: float | None
    pointed: bool


_Sized = tuple[tuple[int, int], _Face]
"""How large a button is, in pixels, and how it looks."""


def _faces(theme: Theme, wanted: Collection[_Sized]) -> dict[_Sized, pygame.Surface]:
    """Return buttons as pictures; all are painted together, which takes a fifth of the time."""
    if not wanted:
        return {}
    sizes = [size for size, _ in wanted]
    strip = pygame.Surface(
        (sum(wide for wide, _ in sizes), max(high for _, high in sizes)), pygame.SRCALPHA, 32
    )
    lefts = [*accumulate((wide for wide, _ in sizes), initial=0)][:-1]
    placed = [*zip(lefts, wanted, strict=True)]
    paint(
        strip,
        [one.placed(complex(left, 0)) for left, (size, face) in placed for one in _face(theme, size, face)],
    )
    return {sized: strip.subsurface((left, 0, *sized[0])).copy() for left, sized in placed}


def _face(theme: Theme, size: tuple[int, int], face: _Face) -> Iterator[Layer]:
    """Yield a button: its icon, in a frame where it is on, on a light ground under the mouse, or greyed."""
    wide, high = size
    middle, line, corner = complex(wide / 2, high / 2), max(0.04 * high, 1.0), 0.18 * high
    lit = theme.chosen if face.on else mixed(theme.panel, theme.chosen, _POINTED)
    if face.on:
        yield Layer(theme.velocity, [middle + box(wide, high, corner)])
    if face.on or (face.pointed and not face.grey):
        by = 2 * line * face.on
        yield Layer(lit, [middle + box(wide - by, high - by, corner - by / 2)])
    thin = high / 27
    gauge = Gauge(bar=2.1 * thin, outline=0.8 * thin, pin=1.1 * thin, line=thin)
    if face.share is None:
        layers = [one.placed(middle) for one in COMMAND_ICONS[face.icon](gauge, theme)]
    else:
        layers = _slider(theme, Rect(0, 0, wide, high), face.share)
    greyed = _GREY if face.grey else 0.0
    yield from (one._replace(colour=mixed(one.colour, theme.panel, greyed)) for one in layers)


def _slider(theme: Theme, cell: Rect, share: float) -> list[Layer]:
    """Return a rail with ticks from slow to fast, filled up to its knob."""
    (begin, end), y, side = _rail(cell), cell.height / 2, cell.height
    at, thick = begin + share * (end - begin), 0.1 * side

    def part(left: float, right: float) -> list[Loop]:
        return [complex((left + right) / 2, y) + box(right - left + thick, thick, thick / 2)]

    knob = complex(at, y)
    return [
        Layer(theme.rule, part(begin, end)),
        Layer(theme.velocity, part(begin, at)),
        Layer(theme.outline, [knob + disc(0.25 * side)]),
        Layer(theme.panel, [knob + disc(0.2 * side)]),
    ]
