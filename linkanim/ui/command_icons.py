"""Draw the icons of the bar of commands, in line with those of a sheet's tools."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Literal

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.shapes import arrows, box, directions, disc, segments, stroke
from linkanim.picture.theme import DARK, GREEN, ORANGE, SKY, Theme, mixed
from linkanim.ui.tools import ICONS, Icon

_THIN = 1.7
"""The width of a line, in thin lines of the gauge, as all sizes below."""


def _line(gauge: Gauge, colour: Colour, *paths: list[complex], closed: bool = False) -> Layer:
    """Return lines through corners."""
    loops = [
        loop
        for path in paths
        for loop in stroke(gauge.line * np.array(path), _THIN * gauge.line, closed=closed)
    ]
    return Layer(colour, loops)


def _filled(gauge: Gauge, colour: Colour, *loops: list[complex]) -> Layer:
    return Layer(colour, [gauge.line * np.array(loop, np.complex128) for loop in loops])


def _arc(middle: complex, radius: float, begin: float, end: float) -> list[complex]:
    """Return points along an arc from one angle to another, in turns, clockwise on the screen."""
    angles: NDArray[np.float64] = np.linspace(2 * np.pi * begin, 2 * np.pi * end, 24)
    return [complex(middle + radius * way) for way in directions(angles)]


def _back(gauge: Gauge, theme: Theme) -> list[Layer]:
    return [_line(gauge, theme.ink, [7 + 0j, -7 + 0j], [-1 - 6j, -7 + 0j, -1 + 6j])]


def _turned(gauge: Gauge, theme: Theme, side: Literal[-1, 1]) -> list[Layer]:
    """Return an arrow's head, as for the page before and the next."""
    return [_line(gauge, theme.ink, [side * -3 - 7j, side * 4 + 0j, side * -3 + 7j])]


def _home(gauge: Gauge, theme: Theme) -> list[Layer]:
    roof, walls = [-8 - 0.5j, -7.5j, 8 - 0.5j], [-5.5 - 1.5j, -5.5 + 7j, 5.5 + 7j, 5.5 - 1.5j]
    return [_line(gauge, theme.ink, roof, walls, [7j, 2.5j])]


def _shelf(gauge: Gauge, theme: Theme) -> list[Layer]:
    side = 6.4 * gauge.line
    return [
        Layer(theme.bodies[n], [gauge.line * 4.4 * way + box(side, side, 1.2 * gauge.line)])
        for n, way in enumerate((-1 - 1j, 1 - 1j, -1 + 1j, 1 + 1j))
    ]


def _step(gauge: Gauge, theme: Theme, side: Literal[-1, 1]) -> list[Layer]:
    tip, wall = [side * 7 + 0j, side * -3.5 - 6.5j, side * -3.5 + 6.5j], gauge.line * side * -6.5
    return [_filled(gauge, theme.ink, tip), Layer(theme.ink, [wall + box(2.2 * gauge.line, 13 * gauge.line)])]


def _play(gauge: Gauge, theme: Theme) -> list[Layer]:
    return [_filled(gauge, theme.ink, [-5.5 - 8.5j, 8.5 + 0j, -5.5 + 8.5j])]


def _pause(gauge: Gauge, theme: Theme) -> list[Layer]:
    one = box(4.2 * gauge.line, 15.5 * gauge.line, 0.8 * gauge.line)
    return [Layer(theme.ink, [one - 4 * gauge.line, one + 4 * gauge.line])]


def _names(gauge: Gauge, theme: Theme) -> list[Layer]:
    letter = _line(gauge, theme.ink, [-8.5 + 6.5j, -3.2 - 7.5j, 2.1 + 6.5j], [-6.3 + 1.8j, -0.1 + 1.8j])
    hook = _arc(6 + 3.2j, 2.2, -0.5, 0.08)
    return [letter, _line(gauge, theme.velocity, [*hook, 3.6 + 8.4j, 8.6 + 8.4j])]


def _arrows(gauge: Gauge, theme: Theme) -> list[Layer]:
    foot, line = gauge.line * (-6 + 5.5j), gauge.line
    return [
        Layer(theme.velocity, arrows([foot], [line * (13.5 - 9.5j)], 1.9 * line)),
        Layer(theme.acceleration, arrows([foot], [line * (1.5 - 14j)], 1.9 * line)),
        Layer(theme.outline, [foot + disc(2.4 * line)]),
        Layer(theme.pin, [foot + disc(1.3 * line)]),
    ]


def _chart(gauge: Gauge, theme: Theme) -> list[Layer]:
    across = np.linspace(-6, 8, 32)
    curve = [complex(x, 5.4 * np.sin((x + 6) / 14 * 6.5) * -0.9 - 0.6) for x in across]
    return [
        _line(gauge, theme.dim, [-8 - 8j, -8 + 7.5j, 8.5 + 7.5j]),
        _line(gauge, theme.traces[0], curve),
    ]


def _axis(gauge: Gauge, theme: Theme) -> list[Layer]:
    ticks = [[at - 1.6j + 3j, at + 1.6j + 3j] for at in (-5 + 0j, -1 + 0j, 3 + 0j)]
    way = arrows([gauge.line * (-9 + 3j)], [18 * gauge.line], 1.6 * gauge.line)
    return [
        Layer(theme.ink, way),
        _line(gauge, theme.ink, *ticks),
        _line(gauge, theme.dim, [-9 - 7j, -9 + 3j]),
    ]


def _construction(gauge: Gauge, theme: Theme) -> list[Layer]:
    centre = 2.2 + 1.2j
    return [
        _line(gauge, theme.velocity, [-8 + 6.5j, 1.5 - 8j, 8.5 + 6.5j], closed=True),
        _line(gauge, theme.ink, [centre - 3.4, centre + 3.4], [centre - 3.4j, centre + 3.4j]),
    ]


def _edit(gauge: Gauge, theme: Theme) -> list[Layer]:
    line = gauge.line
    ends = [line * (-6.5 + 4.5j), line * (6.5 + 4.5j)]
    bar = [Layer(theme.outline, stroke(ends, 6.2 * line)), Layer(theme.bodies[1], stroke(ends, 4.2 * line))]
    ways = arrows([line * (-0.5 - 5j), line * (0.5 - 5j)], [-7 * line, 7 * line], 1.5 * line)
    walls = segments(
        [line * (-8.4 - 8j), line * (8.4 - 8j)], [line * (-8.4 - 2j), line * (8.4 - 2j)], 1.3 * line
    )
    return [
        *bar,
        Layer(theme.pin, [end + disc(1.1 * line) for end in ends]),
        Layer(theme.ink, [*ways, *walls]),
    ]


def _build(gauge: Gauge, theme: Theme) -> list[Layer]:
    plus = _line(gauge, theme.ink, [4.6 - 8.6j, 4.6 - 1.4j], [1 - 5j, 8.2 - 5j])
    return [*(one.placed(gauge.line * (-1.2 + 1.2j)) for one in ICONS["bar"](gauge, theme)), plus]


def _pencil(gauge: Gauge, theme: Theme) -> list[Layer]:
    wood, tip = [-3.6 + 1.2j, 4.6 - 8.4j, 8.4 - 5.1j, 0.2 + 4.5j], [-3.6 + 1.2j, -5.2 + 6.1j, 0.2 + 4.5j]
    path = [complex(x, 8 - 0.9 * np.cos(x)) for x in np.linspace(-8.5, 8.5, 28)]
    return [
        _line(gauge, theme.traces[0], path),
        _filled(gauge, theme.bodies[3], wood),
        _filled(gauge, theme.outline, tip),
    ]


def _record(gauge: Gauge, theme: Theme) -> list[Layer]:
    ring = [7.6 * gauge.line * disc(1.0), 6.0 * gauge.line * disc(1.0)[::-1]]
    return [Layer(theme.ink, ring), Layer(theme.warning, [4.3 * gauge.line * disc(1.0)])]


def _stop(gauge: Gauge, theme: Theme) -> list[Layer]:
    return [Layer(theme.warning, [box(12.5 * gauge.line, 12.5 * gauge.line, 1.5 * gauge.line)])]


def _more(gauge: Gauge, theme: Theme) -> list[Layer]:
    return [Layer(theme.ink, [gauge.line * at + disc(1.7 * gauge.line) for at in (-6, 0, 6)])]


def _help(gauge: Gauge, theme: Theme) -> list[Layer]:
    hook = _arc(-3.4j, 4.2, -0.5, 0.13)
    dot = Layer(theme.ink, [gauge.line * 7.4j + disc(1.4 * gauge.line)])
    return [_line(gauge, theme.ink, [*hook, 0.4 + 1.2j, 3.4j]), dot]


def _lifted(gauge: Gauge, theme: Theme, apart: float) -> list[Layer]:
    """Return three sheets above each other, so far apart."""
    sheet = [-8.5 + 0j, -3.5j, 8.5 + 0j, 3.5j]
    layers = []
    for n, colour in enumerate((theme.bodies[2], theme.bodies[1], theme.bodies[0])):
        at = [corner + 1j * apart * (1 - n) for corner in sheet]
        layers += [_filled(gauge, colour, at), _line(gauge, theme.outline, at, closed=True)]
    return layers


def _save(gauge: Gauge, theme: Theme) -> list[Layer]:
    tray = [-8 + 1.5j, -8 + 7.5j, 8 + 7.5j, 8 + 1.5j]
    return [_line(gauge, theme.ink, tray, [-8j, 3.5j], [-4.2 - 0.7j, 3.5j, 4.2 - 0.7j])]


def _new(gauge: Gauge, theme: Theme) -> list[Layer]:
    page = [-6 - 8j, 1.5 - 8j, 6 - 3.5j, 6 + 8j, -6 + 8j]
    plus = _line(gauge, theme.velocity, [-3.4 + 2.4j, 3.4 + 2.4j], [-1j, 5.8j])
    return [_line(gauge, theme.ink, page, closed=True), plus]


def _add(gauge: Gauge, theme: Theme) -> list[Layer]:
    return [_line(gauge, theme.ink, [-7 + 0j, 7 + 0j], [-7j, 7j])]


def _done(gauge: Gauge, theme: Theme) -> list[Layer]:
    thick = 1.5 * _THIN * gauge.line
    return [Layer(theme.traces[1], stroke(gauge.line * np.array([-7.5 + 0.5j, -2 + 6j, 7.5 - 6j]), thick))]


def _again(gauge: Gauge, theme: Theme) -> list[Layer]:
    arc = _arc(0j, 6.4, 0.08, 0.86)
    return [_line(gauge, theme.ink, arc), _filled(gauge, theme.ink, [0.8 - 6j, 8 - 7.4j, 6.6 - 0.2j])]


def _closure(gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return both closures of a dyad on one ground, one of them faint."""
    up, down = [-8 + 0j, 1 - 7.5j, 8 + 0j], [-8 + 0j, 1 + 7.5j, 8 + 0j]
    joints = [gauge.line * at + disc(1.8 * gauge.line) for at in (-8, 1 - 7.5j, 8)]
    return [
        _line(gauge, mixed(theme.ink, theme.panel, 0.6), down),
        _line(gauge, theme.velocity, up),
        Layer(theme.ink, joints),
    ]


def _theme(gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return a disc, half of it dark."""
    ring = [7.6 * gauge.line * disc(1.0), 6.0 * gauge.line * disc(1.0)[::-1]]
    return [Layer(theme.ink, ring), _filled(gauge, theme.ink, _arc(0j, 6.4, 0.25, 0.75))]


def _full_screen(gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return the four corners of a screen."""
    corners = [complex(8 * x, 7 * y) for x in (-1, 1) for y in (-1, 1)]
    return [_line(gauge, theme.ink, *([at - 0.55 * at.real, at, at - 0.6j * at.imag] for at in corners))]


def _close(gauge: Gauge, theme: Theme) -> list[Layer]:
    return [_line(gauge, theme.ink, [-6 - 6j, 6 + 6j], [-6 + 6j, 6 - 6j])]


def window_icon(side: int) -> pygame.Surface:
    """Return the window's own icon, so many pixels square: a four-bar on a dark tile, its pins light."""
    tile = pygame.Surface((side, side), pygame.SRCALPHA, 32)
    part, theme = side / 64, DARK
    place = {"O2": 15 + 47j, "A": 22 + 27j, "B": 45 + 17j, "O4": 49 + 47j}
    middle = (1 + 1j) * side / 2
    paint(tile, [Layer(theme.background, [middle + box(side, side, 13 * part)])])
    for ends, colour in (
        (("O2", "O4"), theme.ground),
        (("O4", "B"), GREEN),
        (("A", "B"), SKY),
        (("O2", "A"), ORANGE),
    ):
        bar = part * np.array([place[end] for end in ends])
        paint(
            tile, [Layer(theme.background, stroke(bar, 10.5 * part)), Layer(colour, stroke(bar, 7.5 * part))]
        )
    paint(tile, [Layer(theme.ink, [part * at + disc(2.2 * part) for at in place.values()])])
    return tile


COMMAND_ICONS: Mapping[str, Icon] = {
    "back": _back,
    "home": _home,
    "shelf": _shelf,
    "step back": partial(_step, side=-1),
    "step on": partial(_step, side=1),
    "before": partial(_turned, side=-1),
    "after": partial(_turned, side=1),
    "play": _play,
    "pause": _pause,
    "trace": ICONS["trace"],
    "names": _names,
    "arrows": _arrows,
    "chart": _chart,
    "axis": _axis,
    "construction": _construction,
    "edit": _edit,
    "build": _build,
    "pencil": _pencil,
    "record": _record,
    "stop": _stop,
    "more": _more,
    "help": _help,
    "nearer": partial(_lifted, apart=1.6),
    "farther": partial(_lifted, apart=5.0),
    "save": _save,
    "new": _new,
    "add": _add,
    "done": _done,
    "again": _again,
    "close": _close,
    "closure": _closure,
    "theme": _theme,
    "full screen": _full_screen,
    "undo": ICONS["undo"],
    "redo": ICONS["redo"],
}
"""How each command's icon is drawn, about 0 and within 10 thin lines each way."""
