"""How bodies are drawn that say how: bars, plates, wheels, slotted bars, hooks. `SHAPES` is the one table.

Each is drawn about its first joint at 0, its second on the positive real axis, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from linkanim.picture.layout import Gauge
from linkanim.picture.parts.fittings import SLOT, SLOTTED
from linkanim.picture.raster.parts import glazed, lined, slotted
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import disc, stroke, unit

Colours = tuple[Colour, Colour]
"""Of an edge and of what it encloses."""

_BROAD = 1.5
"""Half the width of a plate of two joints, in those of a bar."""
_CLEAR = 1.2
"""How far from the joints a slot ends, in half widths of a bar."""
_HOOK, _BENT = 2.6, 4.2
"""A hook's radius at most, in half widths of a bar, and its bend in radians."""
_ROUND = 1.0
"""How far a wheel reaches round its furthest joint, in half widths of a bar."""
_RIM, _GLASS = 0.8, 0.35
"""How wide a wheel's rim is in half widths of a bar, and how much its disc covers."""


def _bar(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar that runs through the joints in their order, bent where they are not in line."""
    return _drawn(np.array(points), gauge, colours)


def _plate(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    return glazed(points, (_BROAD if len(points) == 2 else 1.0) * gauge.bar, gauge.outline, colours)


def _wheel(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a wheel out to the furthest joint, with a spoke to the second by which its turning is seen."""
    (edge, fill), radius = colours, wheel_radius(points, gauge)
    rim, line = _RIM * gauge.bar, gauge.outline
    ring = [disc(radius - line), disc(radius - rim)[::-1]]
    edges = [disc(radius), disc(radius - line)[::-1], disc(radius - rim), disc(radius - rim - line)[::-1]]
    spoke = lined(points[:2], gauge.bar, line, colours)
    return [Layer(fill, [disc(radius - rim)], _GLASS), Layer(fill, ring), Layer(edge, edges), *spoke]


def wheel_radius(points: list[complex], gauge: Gauge) -> float:
    """Return a wheel's radius: it reaches round the furthest of its joints."""
    return max(map(abs, points)) + _ROUND * gauge.bar


def _slot(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    begin, end = points[:2]
    along = unit(end - begin) * min(_CLEAR * gauge.bar, abs(end - begin) / 2)
    widths = SLOTTED * gauge.bar, SLOT * gauge.bar
    return slotted(points, (begin + along, end - along), widths, gauge.outline, colours)


def _hook(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar that bends round to a hook, in whose bowl the last joint would hang."""
    *_, before, end = points
    along, radius = unit(end - before), min(_HOOK * gauge.bar, 0.3 * abs(end - before))
    middle = end - along * radius
    bend = middle - along * radius * np.exp(-1j * np.linspace(0.0, _BENT, 24))
    return _drawn(np.concatenate([points[:-1], bend]), gauge, colours)


def _nothing(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    return []


def _drawn(path: np.ndarray, gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar along a path, its edge inside its width."""
    edge, fill = colours
    width = 2 * gauge.bar
    return [
        Layer(edge, list(stroke(path, width))),
        Layer(fill, list(stroke(path, max(width - 2 * gauge.outline, 0.2)))),
    ]


SHAPES: Mapping[str, Callable[[list[complex], Gauge, Colours], list[Layer]]] = {
    "bar": _bar,
    "plate": _plate,
    "wheel": _wheel,
    "slot": _slot,
    "hook": _hook,
    "none": _nothing,
}
"""How a body is drawn that says its `look`."""
