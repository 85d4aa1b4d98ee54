"""Where things stand in the window, and how large they are for its size."""

from __future__ import annotations

from dataclasses import dataclass

from linkanim.picture.look import Look
from linkanim.picture.view import Rect

_DRAWN_FOR = (1280, 720)


@dataclass(frozen=True)
class Layout:
    """The parts of a window; `unit` is one pixel of a 1280 × 720 window at this size."""

    size: tuple[int, int]
    unit: float
    scene: Rect
    hud: Rect | None
    legend: Rect | None
    """The key to the vectors, at the foot of the HUD's column."""
    chart: Rect | None

    @property
    def title_size(self) -> int:
        """The height of the scene's title in whole pixels."""
        return max(round(30 * self.unit), 17)

    @property
    def text_size(self) -> int:
        """The height of text that must read from the back row."""
        return max(round(21 * self.unit), 14)

    @property
    def small_size(self) -> int:
        """The height of tick labels and hints."""
        return _small(self.unit)


def layout(size: tuple[int, int], look: Look) -> Layout:
    """Divide a window: HUD on the left, chart along the bottom, the scene in what is left."""
    unit = min(size[0] / _DRAWN_FOR[0], size[1] / _DRAWN_FOR[1])
    whole = Rect(0, 0, *size).inset(20 * unit)
    chart = None
    if look.chart:
        tall = 0.27 * size[1]
        chart = Rect(whole.x, whole.bottom - tall, whole.width, tall)
    high = (chart.y - 12 * unit if chart else whole.bottom) - whole.y
    if not look.hud:
        return Layout(size, unit, Rect(whole.x, whole.y, whole.width, high), None, None, chart)
    wide = min(max(0.255 * size[0], 204.0), 0.36 * size[0])
    left = whole.x + wide + 16 * unit
    scene = Rect(left, whole.y, max(whole.right - left, 1), high)
    hud, legend = _column(Rect(whole.x, whole.y, wide, high), len(look.vectors) * 1.5 * _small(unit))
    return Layout(size, unit, scene, hud, legend, chart)


def _column(column: Rect, foot: float) -> tuple[Rect, Rect | None]:
    """Divide the HUD's column: the numbers, and a key so high below them."""
    if not foot:
        return column, None
    numbers = column._replace(height=max(column.height - foot, 1))
    return numbers, column._replace(y=column.bottom - foot, height=foot)


def _small(unit: float) -> int:
    return max(round(17 * unit), 12)


@dataclass(frozen=True)
class Gauge:
    """How thick things are drawn, in pixels."""

    bar: float
    """Half the width of a bar."""
    outline: float
    pin: float
    line: float
    """The width of a thin line."""

    @property
    def pedestal(self) -> float:
        """How far a ground pin's pedestal reaches from the pin."""
        return 2.6 * self.bar + 2 * self.outline


def gauge(unit: float, shortest: float) -> Gauge:
    """Return the thicknesses for a window and its shortest bar in pixels, thinner where that is short."""
    bar = min(10.5 * unit, max(0.2 * shortest, 5.5 * unit))
    return Gauge(bar=bar, outline=1.7 * unit, pin=0.5 * bar, line=1.8 * unit)
