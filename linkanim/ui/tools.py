"""The bar of tools: small icons along the window's left edge, or its foot where it is upright; a tooltip."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from itertools import chain

import numpy as np
import pygame

from linkanim.build.tools import TOOLS
from linkanim.picture.board import Board
from linkanim.picture.bodies import pin_stamp
from linkanim.picture.fittings import Coil, barrel, block_layers, hatched
from linkanim.picture.layout import Gauge, tool_cells
from linkanim.picture.motion_marks import turning_arrow
from linkanim.picture.raster import Layer, paint
from linkanim.picture.shapes import box, directions, disc, lined, rod, segments, slotted, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.words import said

_TAKEN = ("tool", "trace_on", "drive_by")
"""Tools whose keys need Ctrl where letters and digits are typed."""
Icon = Callable[[Gauge, Theme], list[Layer]]
"""Draws an icon about 0, within 10 thin lines each way."""


def tool_bar(board: Board, chosen: int) -> tuple[pygame.Surface, tuple[int, int]]:
    """Return the bar with a tool in hand, no larger than its tools, and where its upper left corner is.

    All tools are painted together, which is quicker.
    """
    sheet = pygame.Surface(board.layout.size, pygame.SRCALPHA, 32)
    theme, line = board.theme, max(1.2 * board.layout.unit, 1.0)
    layers: list[Layer] = []
    for n, (cell, tool) in enumerate(zip(tool_cells(board.layout), TOOLS, strict=True)):
        is_chosen, corner = n == chosen, 0.18 * cell.width
        rim = theme.velocity if is_chosen else theme.rule
        fill = mixed(theme.panel, theme.chosen, 1.0 if is_chosen else 0.0)
        outer, inner = (
            cell.middle + box(cell.width - 2 * by, cell.height - 2 * by, corner) for by in (0.0, line)
        )
        thin = cell.width / 22
        gauge = Gauge(bar=2.1 * thin, outline=0.8 * thin, pin=1.1 * thin, line=thin)
        layers += [Layer(rim, [outer]), Layer(fill, [inner])]
        layers += [layer.placed(cell.middle) for layer in ICONS[tool.icon](gauge, theme)]
    paint(sheet, layers)
    used = sheet.get_bounding_rect()
    return sheet.subsurface(used).copy(), used.topleft


def tooltip(board: Board, shown: tuple[int, bool]) -> tuple[pygame.Surface, tuple[int, int]]:
    """Return a tool's name and key, which may need Ctrl, and their place beside it."""
    (number, typed), size = shown, board.layout.small_size
    tool, cell = TOOLS[number], tool_cells(board.layout)[number]
    key = f"Ctrl+{tool.key}" if typed and tool.action in _TAKEN else tool.key
    words = f"{said(tool.name)}   {key}".rstrip()
    sheet = board.sheet(board.type.width(words, size) + 1.4 * size, 1.6 * size)
    board.write(sheet, words, (0.7 * size, 0.3 * size), size=size)
    (width, height), gap = board.layout.size, 0.25 * cell.width
    beside = cell.right + gap, cell.middle.imag - sheet.get_height() / 2
    above = cell.middle.real - sheet.get_width() / 2, cell.y - gap - sheet.get_height()
    x, y = beside if width >= height else above
    x = min(max(x, 2), max(width - sheet.get_width() - 2, 2))
    return sheet, (round(x), round(min(max(y, 2), max(height - sheet.get_height() - 2, 2))))


def _bar_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    ends = [gauge.line * (-6 + 6j), gauge.line * (6 - 6j)]
    bar = lined(ends, 1.5 * gauge.bar, gauge.outline, (theme.outline, theme.bodies[0]))
    return [*bar, *pin_stamp(gauge, theme).at(ends)]


def _line_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    ends = gauge.line * (-8 + 3j), gauge.line * (8 + 3j)
    ground = Layer(theme.outline, [*hatched(*ends, replace(gauge, bar=3.6 * gauge.line), 1)])
    return [ground, *(one.placed(-1.5j * gauge.line) for one in block_layers(gauge, theme, 1 + 0j))]


def _slider_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    line, begins = gauge.line, np.array([-9 - 4.6j, -9 + 4.6j])
    rails = segments(line * begins, line * (begins + 18), 1.2 * line)
    block = block_layers(replace(gauge, bar=2.4 * line), theme, 1 + 0j)
    return [Layer(theme.ground, rails), *block, *pin_stamp(gauge, theme).at([0j])]


def _slot_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    line, ends = gauge.line, (gauge.line * (-6 + 5j), gauge.line * (6 - 5j))
    bar = slotted(ends, ends, (3.2 * line, 1.3 * line), gauge.outline, (theme.outline, theme.bodies[2]))
    return [*bar, *pin_stamp(replace(gauge, pin=1.5 * line), theme).at([0j])]


def _move_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    corners = (-4 - 8j, -4 + 5.5j, -0.8 + 2.6j, 1.4 + 7.4j, 4 + 6.2j, 1.8 + 1.6j, 6 + 1.4j)
    hand = gauge.line * np.array(corners, np.complex128)
    return [Layer(theme.outline, stroke(hand, 2.2 * gauge.line, closed=True)), Layer(theme.pin, [hand])]


def _gear_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    layers: list[Layer] = []
    for at, radius, teeth in ((-3.2 + 2.2j, 5.0, 12), (4.6 - 3.4j, 3.4, 8)):
        middle, reach = gauge.line * at, gauge.line * radius
        spokes = reach * directions(np.arange(teeth) * 2 * np.pi / teeth)
        cogs = segments(middle + 0.8 * spokes, middle + 1.28 * spokes, 1.4 * gauge.line)
        layers.append(Layer(theme.outline, [middle + disc(reach), *cogs]))
        layers.append(Layer(theme.gear, [middle + disc(0.72 * reach)]))
        layers.append(Layer(theme.outline, [middle + disc(gauge.line)]))
    return layers


def _spring_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    thin = replace(gauge, line=0.9 * gauge.line)
    coil = Coil(("a", "b"), 3.4 * gauge.line, 2.5 * gauge.line, 4, thin, theme)
    return coil.layers({"a": gauge.line * (-8 + 0j), "b": gauge.line * (8 + 0j)})


def _strut(gauge: Gauge, theme: Theme, *, drives: bool) -> list[Layer]:
    line, (far, head) = gauge.line, (4, 2) if drives else (2, -2)
    wall, inside = barrel(-7 * line, far * line, 3.6 * line, gauge, theme)
    fill = inside._replace(colour=theme.bodies[0]) if drives else inside
    seal = segments((head - 2.6j) * line, (head + 2.6j) * line, 1.8 * line)
    return [wall, fill, Layer(theme.outline, [rod(head * line, 9 * line, 0.9 * line), *seal])]


def _photo_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    line = gauge.line
    hill = line * np.array([-7.5 + 5.5j, -2 - 2.5j, 1.5 + 2.5j, 4 - 0.5j, 7.5 + 5.5j], np.complex128)
    return [
        Layer(theme.outline, [box(17 * line, 13 * line, line)]),
        Layer(theme.pin, [box(15 * line, 11 * line)]),
        Layer(theme.bodies[4], [hill]),
        Layer(theme.bodies[3], [line * (3.5 - 3j) + disc(1.4 * line)]),
    ]


def _trace_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    turn = np.linspace(0, 2 * np.pi, 48)
    curve = gauge.line * np.asarray(7 * np.cos(turn) + 1j * (4.6 * np.sin(turn) - 2.2 * np.cos(2 * turn)))
    rim, dot = (curve[6] + disc(radius * gauge.line) for radius in (2.6, 1.8))
    line = Layer(theme.traces[0], stroke(curve, 1.5 * gauge.line, closed=True))
    return [line, Layer(theme.outline, [rim]), Layer(theme.traces[0], [dot])]


def _drive_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    pivot, pin = gauge.line * (-4 + 5j), gauge.line * (4 - 1j)
    small = replace(gauge, bar=0.7 * gauge.line, line=0.75 * gauge.line)
    bar = lined([pivot, pin], gauge.bar, gauge.outline, (theme.outline, theme.bodies[0]))
    arrow = turning_arrow(pivot, pivot + 0.95 * (pin - pivot), small, theme)
    return [*bar, *pin_stamp(gauge, theme).at([pivot, pin]), *arrow]


def _delete_icon(gauge: Gauge, theme: Theme) -> list[Layer]:
    reach = 5 * gauge.line
    strokes = (stroke([-reach * way, reach * way], 2.2 * gauge.line) for way in (1 + 1j, 1 - 1j))
    return [Layer(theme.warning, [*chain.from_iterable(strokes)])]


def _undo_icon(gauge: Gauge, theme: Theme, side: int = 1) -> list[Layer]:
    arc = 5.5 * gauge.line * directions(np.linspace(0.9 * np.pi, -0.35 * np.pi, 24)).conj() + 1j * gauge.line
    tip = arc[0]
    head = tip + gauge.line * np.array([-3.2 - 1.6j, 3.4 - 2.4j, 0.2 + 4.2j])
    loops = [*stroke(arc, 1.8 * gauge.line), head]
    return [Layer(theme.ink, [loop if side > 0 else -loop.conj()]) for loop in loops]


ICONS: Mapping[str, Icon] = {
    "bar": _bar_icon,
    "line": _line_icon,
    "slider": _slider_icon,
    "slot": _slot_icon,
    "move": _move_icon,
    "gear": _gear_icon,
    "spring": _spring_icon,
    "damper": partial(_strut, drives=False),
    "cylinder": partial(_strut, drives=True),
    "photo": _photo_icon,
    "trace": _trace_icon,
    "drive": _drive_icon,
    "delete": _delete_icon,
    "undo": _undo_icon,
    "redo": partial(_undo_icon, side=-1),
}
"""How each tool's icon is drawn."""
