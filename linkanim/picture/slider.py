"""A slider at the upper right of the picture: its label, words at both ends, a knob at a step."""

from __future__ import annotations

from collections.abc import Iterator

from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group
from linkanim.picture.layout import Layout
from linkanim.picture.overlay import SliderShown
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import box, disc, segments
from linkanim.picture.view import Rect

_WIDE, _SHARE = 250.0, 0.42
"""How wide it is, in units, and at the most of the stage."""
_BELOW = 2.4
"""How far below the upper edge, in heights of text: marks stand above it."""
_BACKING = 0.8


def slider_rect(layout: Layout) -> Rect:
    """Return where a slider stands, with its words."""
    stage, small = layout.stage, layout.small_size
    wide = min(_WIDE * layout.unit, _SHARE * stage.width)
    top = stage.y + layout.margin + _BELOW * layout.text_size
    return Rect(stage.right - layout.margin - wide, top, wide, 4.0 * small)


def slider_step(layout: Layout, shown: SliderShown, x: float) -> int:
    """Return the step that is nearest to a pixel's column."""
    left, wide = _way(layout)
    return min(max(round((x - left) / wide * shown.steps), 0), shown.steps)


def slider(setting: DrawSetting, shown: SliderShown) -> Iterator[Group]:
    """Yield a slider, on a backing."""
    layout, theme = setting.layout, setting.theme
    rect, small, (left, wide) = slider_rect(layout), layout.small_size, _way(layout)
    row, line = rect.y + 1.9 * small, max(1.6 * layout.unit, 1.0)
    plate = rect.middle + box(rect.width, rect.height, 0.4 * small)
    knob = complex(left + wide * shown.at / shown.steps, row)
    layers = [
        Layer(theme.background, [plate], _BACKING),
        Layer(theme.rule, segments(complex(left, row), complex(left + wide, row), 2 * line)),
        Layer(theme.ink, [knob + disc(0.42 * small)]),
        Layer(theme.background, [knob + disc(0.42 * small - line)]),
    ]
    middle, below = rect.x + rect.width / 2, row + 0.7 * small
    captions = [
        Caption(shown.label, (middle, rect.y + 0.1 * small), small, theme.dim, "centre"),
        Caption(shown.low, (left - 0.4 * small, below), small, theme.ink),
        Caption(shown.high, (left + wide + 0.4 * small, below), small, theme.ink, "right"),
    ]
    yield Group("slider", layers, captions, over=True)


def _way(layout: Layout) -> tuple[float, float]:
    """Return where the knob's way begins, and how long it is."""
    rect, edge = slider_rect(layout), 0.9 * layout.small_size
    return rect.x + edge, rect.width - 2 * edge
