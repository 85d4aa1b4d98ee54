"""Sliders: a track with a knob and words at both ends, at the upper right of the picture."""

from __future__ import annotations

from collections.abc import Iterator

from linkanim.frozen import frozen
from linkanim.mechanics.motion import Pose
from linkanim.picture.drawn import Addition
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Target
from linkanim.picture.layout import Layout
from linkanim.picture.raster import Colour, Layer
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


@frozen
class Slider(Addition):
    """A slider: its subject, the meaning of its two ends, how many steps it has, and its present step."""

    label: str
    low: str
    high: str
    steps: int
    at: int

    @property
    def of_window(self) -> bool:
        """It has a place of its own, at the upper right."""
        return True

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the slider, on a backing; the value of its target is its rail and its steps."""
        del pose
        layout, theme = setting.layout, setting.theme
        rect, small, (left, wide) = slider_rect(layout), layout.small_size, _way(layout)
        row, line = rect.y + 1.9 * small, max(1.6 * layout.unit, 1.0)
        plate, share = rect.middle + box(rect.width, rect.height, 0.4 * small), self.at / self.steps
        track = knob_on_track(complex(left, row), wide, share, 0.42 * small, line, theme, theme.background)
        layers = [Layer(theme.background, [plate], _BACKING), *track]
        middle, below = rect.x + rect.width / 2, row + 0.7 * small
        captions = [
            Caption(self.label, (middle, rect.y + 0.1 * small), small, theme.dim, "centre"),
            Caption(self.low, (left - 0.4 * small, below), small, theme.ink),
            Caption(self.high, (left + wide + 0.4 * small, below), small, theme.ink, "right"),
        ]
        target = Target("slider", rect, (Rect(left, row, wide, 0.0), self.steps))
        yield Group("slider", layers, captions, over=True, targets=(target,))


def knob_on_track(
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
