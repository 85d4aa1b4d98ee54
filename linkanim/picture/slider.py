"""Sliders: a track with a knob and words at both ends.

A slider stands at the upper right of the picture, its knob at a step; the dial stands above a row of answers.
"""

from __future__ import annotations

from collections.abc import Iterator

import pygame

from linkanim.picture.board import Board
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Target
from linkanim.picture.layout import Layout
from linkanim.picture.overlay import DialShown, SliderShown
from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.shapes import box, disc, segments
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect

_WIDE, _SHARE = 250.0, 0.42
"""A slider's width in units, and the greatest share of the stage's width that it takes."""
_BACKING = 0.8


def slider_rect(layout: Layout) -> Rect:
    """Return where a slider stands, with its words."""
    head, small = layout.head or layout.stage, layout.small_size
    wide = min(_WIDE * layout.unit, _SHARE * head.width)
    return Rect(head.right - layout.margin - wide, head.y + 0.25 * small, wide, 4.0 * small)


def share_along(rail: Rect, x: float) -> float:
    """Return how far along a knob's rail a pixel's column is, 0 to 1."""
    return min(max((x - rail.x) / max(rail.width, 1.0), 0.0), 1.0)


def slider(setting: DrawSetting, shown: SliderShown) -> Iterator[Group]:
    """Yield a slider, on a backing."""
    layout, theme = setting.layout, setting.theme
    rect, small, (left, wide) = slider_rect(layout), layout.small_size, _way(layout)
    row, line = rect.y + 1.9 * small, max(1.6 * layout.unit, 1.0)
    plate = rect.middle + box(rect.width, rect.height, 0.4 * small)
    track = _track(
        complex(left, row), wide, shown.at / shown.steps, 0.42 * small, line, theme, theme.background
    )
    layers = [Layer(theme.background, [plate], _BACKING), *track]
    middle, below = rect.x + rect.width / 2, row + 0.7 * small
    captions = [
        Caption(shown.label, (middle, rect.y + 0.1 * small), small, theme.dim, "centre"),
        Caption(shown.low, (left - 0.4 * small, below), small, theme.ink),
        Caption(shown.high, (left + wide + 0.4 * small, below), small, theme.ink, "right"),
    ]
    target = Target("slider", rect, Rect(left, row, wide, 0.0))
    yield Group("slider", layers, captions, over=True, targets=(target,))


def _track(
    left: complex, wide: float, share: float, radius: float, line: float, theme: Theme, filled: Colour
) -> list[Layer]:
    """Return a track from its left end on, and the knob at a share of it, filled with a colour."""
    knob = left + wide * share
    return [
        Layer(theme.rule, segments(left, left + wide, 2 * line)),
        Layer(theme.ink, [knob + disc(radius)]),
        Layer(filled, [knob + disc(radius - line)]),
    ]


def _way(layout: Layout) -> tuple[float, float]:
    """Return where the knob's range begins, and its length, in pixels."""
    rect, edge = slider_rect(layout), 0.9 * layout.small_size
    return rect.x + edge, rect.width - 2 * edge


_DIAL = 0.34
"""The width of a dial's track, as a share of its room."""
_BESIDE = 0.5
"""How far beyond its track's ends a dial can still be grasped, in heights of its room."""


def dial_track(room: Rect) -> Rect:
    """Return where the track of a dial runs, in the middle of its room."""
    wide = _DIAL * room.width
    return Rect(room.x + (room.width - wide) / 2, room.y, wide, room.height)


def draw_dial(surface: pygame.Surface, board: Board, room: Rect, dial: DialShown) -> Target:
    """Draw a dial in its room, its words beside the ends of the track; return where it can be grasped."""
    rail, size, unit = dial_track(room), board.layout.small_size, board.layout.unit
    row, line, radius = rail.y + rail.height / 2, max(1.6 * unit, 1.0), 0.5 * size
    marks = [complex(rail.x + at * rail.width, row) + box(2 * line, 0.6 * size) for at in dial.marks]
    filled = board.theme.velocity if dial.held else board.theme.background
    knob_and_track = _track(complex(rail.x, row), rail.width, dial.value, radius, line, board.theme, filled)
    paint(surface, [Layer(board.theme.rule, marks), *knob_and_track])
    top, gap, dim = row - 0.65 * size, radius + 0.7 * size, board.theme.dim
    board.write(surface, dial.low, (rail.x - gap, top), size=size, colour=dim, anchor="right")
    board.write(surface, dial.high, (rail.right + gap, top), size=size, colour=dim)
    reach = _BESIDE * room.height
    return Target("dial", rail._replace(x=rail.x - reach, width=rail.width + 2 * reach), rail)
