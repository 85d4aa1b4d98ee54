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
from linkanim.picture.raster.shapes import disc, strokes, unit

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
_PAD = (3.6, 2.2)
"""A pad's width between its round ends and how far from its bar's middle it lies, in half widths of a bar."""
_BACK, _TOOTH = 0.2, 2.6
"""How far a bucket's back bends out, in its lengths, and how long its tooth is, in half widths of a bar."""
WHEELS = ("wheel", "railwheel")
"""The looks of bodies that are wheels about their first joint."""
ENDED = ("hook", "pad", "bucket")
"""The looks of bodies of which more is drawn about their last joint than a bar's width."""
_RIM, _GLASS = 0.8, 0.35
"""How wide a wheel's rim is in half widths of a bar, and how much its disc covers."""


def _bar(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar that runs through the joints in their order, bent where they are not in line."""
    return _drawn(np.array(points), gauge, colours)


def _plate(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    return glazed(points, (_BROAD if len(points) == 2 else 1.0) * gauge.bar, gauge.outline, colours)


def _wheel(points: list[complex], gauge: Gauge, colours: Colours, radius: float = 0.0) -> list[Layer]:
    """Return a wheel out to the furthest joint or further; a spoke to the second shows its turning."""
    (edge, fill), radius = colours, max(radius, wheel_radius(points, gauge))
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


def _pad(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar through the joints with a pad at the last, on the side to which it bends."""
    *_, before, end = points
    along = unit(end - before)
    side = -1 if ((points[0] - end) / along).imag < 0 else 1
    (wide, deep), bar, down = _PAD, gauge.bar, 1j * along * side
    foot, high = end + down * deep * bar, 1.2 * bar
    sole = [foot + along * way * 0.5 * wide * bar for way in (-1, 1)]
    stem = lined([end, foot], 0.5 * bar, gauge.outline, colours)
    pad = lined(sole, high / 2, gauge.outline, colours)
    return [*stem, *pad, *_drawn(np.array(points), gauge, colours)]


def _bucket(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bucket about the joints: its back bends away from the first one to its edge at the last."""
    if len(points) < 3:
        return _plate(points, gauge, colours)
    first, *_, before, end = points
    way, share = end - before, np.linspace(0.0, 1.0, 12)
    out = 1j * way * (1 if ((first - before) / way).imag < 0 else -1)
    back = before + way * share + out * _BACK * 4 * share * (1 - share)
    tip = unit(way - 4 * _BACK * out) * gauge.bar
    tooth = end + tip * np.array([_TOOTH, -0.5 + 0.9j, -0.5 - 0.9j])
    shell = glazed([*points, *back.tolist()], gauge.bar, gauge.outline, colours)
    return [Layer(colours[0], [tooth]), *shell]


def _drawn(path: np.ndarray, gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar along a path, its edge inside its width."""
    widths = 2 * gauge.bar, max(2 * gauge.bar - 2 * gauge.outline, 0.2)
    return [Layer(*layer) for layer in zip(colours, strokes(path, widths), strict=True)]


SHAPES: Mapping[str, Callable[..., list[Layer]]] = {
    "bar": _bar,
    "plate": _plate,
    "wheel": _wheel,
    "railwheel": _wheel,
    "slot": _slot,
    "hook": _hook,
    "pad": _pad,
    "bucket": _bucket,
    "none": lambda *_: [],
}
"""How a body is drawn that says its `look`."""
