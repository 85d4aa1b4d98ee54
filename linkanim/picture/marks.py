"""Mark what only the window shows on the picture: the bar being edited, handles, the lane of a ram.

The bar has its dimension line. The lane consists of two lines on paper that scrolls across a ram's guide.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.motion import Pose
from linkanim.picture.dimensions import dimension_line
from linkanim.picture.drawn import Addition
from linkanim.picture.figure import DrawSetting
from linkanim.picture.game_panel import Mood, mood_colour
from linkanim.picture.items import Caption, Group, Target
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Stamp, box, disc, segments, stroke, unit
from linkanim.picture.theme import ORANGE, Theme, mixed
from linkanim.picture.view import Rect

# Marks that only the window shows: the bar being edited with its dimension line, and handles.

_LIT = 0.45
"""The opacity of the light on the bar being edited."""


class DimensionLine(NamedTuple):
    """A length in words, from place to place in a frame: 1 is the vector from joint to joint, 1j its left.

    In a frame that names one joint twice, 1 is the scene's unit to the right. A `chosen` line is lit.
    """

    frame: tuple[str, str]
    begin: complex
    end: complex
    words: str
    chosen: bool = True

    @property
    def is_bar(self) -> bool:
        """Whether it lies along a bar from joint to joint."""
        return self.frame[0] != self.frame[1] and (self.begin, self.end) == (0, 1)


@frozen
class MeasuredLines(Addition):
    """Lengths with their dimension lines."""

    lines: tuple[DimensionLine, ...]

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the lines."""
        for one in self.lines:
            at, head = (setting.view.pixel(pose.position[name]) for name in one.frame)
            span = head - at if one.frame[0] != one.frame[1] else complex(setting.view.scale)
            begin, end = (at + place.conjugate() * span for place in (one.begin, one.end))
            yield from measure(setting, begin, end, one)


@frozen
class Glow(Addition):
    """The light round a joint that can be dragged."""

    joint: str

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the light."""
        middle = setting.view.pixel(pose.position[self.joint])
        discs = ((middle + disc(reach * setting.gauge.bar), alpha) for reach, alpha in _GLOW)
        yield Group("glow", [Layer(ORANGE, [one], alpha) for one, alpha in discs], over=True)


_GLOW = ((3.2, 0.18), (2.4, 0.28), (1.7, 0.4))
"""How far the light of a joint reaches, in widths of a bar, and how strong it is."""
_SEEN = 36.0
"""How much of a dimension line is seen beside its value, at least, in units of the layout: its two arrows."""


def measure(setting: DrawSetting, begin: complex, end: complex, shown: DimensionLine) -> Iterator[Group]:
    """Yield the light on a length from `begin` to `end` (pixels), its dimension line, and its value."""
    if not 1.0 <= abs(end - begin) < np.inf:
        return
    gauge, theme = setting.gauge, setting.theme
    away, back, words = _label(setting, begin, end, shown.words, strong=shown.chosen, lined=True)
    line = Layer(theme.ink, dimension_line(begin, end, away, gauge))
    along = [*_lit(begin, end, gauge)] if shown.chosen else []
    thin = [] if shown.is_bar else [Layer(theme.ink, segments(begin, end, gauge.line))]
    yield Group("measure", [*along, *thin, line, back], [words], over=True)


def label_beside(setting: DrawSetting, begin: complex, end: complex, words: str) -> Group:
    """Return words without a dimension line, beside what lies from `begin` to `end`, in pixels."""
    _, back, caption = _label(setting, begin, end, words)
    return Group("beside", [back], [caption], over=True)


def _label(
    setting: DrawSetting,
    begin: complex,
    end: complex,
    words: str,
    *,
    strong: bool = False,
    lined: bool = False,
) -> tuple[complex, Layer, Caption]:
    """Return the way from a bar to the line above it, or to its side, and words there on their ground.

    Beside a line that is too short to be seen around them the words stand beyond it.
    """
    gauge, layout, size = setting.gauge, setting.layout, setting.layout.small_size
    away = 1j * unit(end - begin)
    away *= (2.0 * gauge.bar + 14 * layout.unit) * (-1 if away.imag > 0 else 1)
    wide, high = setting.type.width(words, size, strong=True) + 0.7 * size, 1.35 * size
    clear = _clear(away, gauge, wide, high)
    if lined and abs(end - begin) < _extent(1j * away, wide, high) + _SEEN * layout.unit:
        clear = away + unit(away) * (_extent(away, wide, high) / 2 + 4 * layout.unit)
    middle = _inside(layout.stage, (begin + end) / 2 + clear, wide, high)
    back = Layer(setting.theme.panel, [middle + box(wide, high, 0.3 * size)], 0.9)
    at = (middle.real, middle.imag - 0.52 * size)
    return away, back, Caption(words, at, size, setting.theme.ink, "centre", strong=strong)


def _clear(away: complex, gauge: Gauge, wide: float, high: float) -> complex:
    """Return the vector from a bar's middle to that of a label of this size at its dimension line."""
    return unit(away) * max(abs(away), _extent(away, wide, high) / 2 + 1.7 * gauge.bar)


def _extent(way: complex, wide: float, high: float) -> float:
    """Return how far a label of this size extends along a direction."""
    along = unit(way)
    return abs(along.real) * wide + abs(along.imag) * high


def _inside(stage: Rect, middle: complex, wide: float, high: float) -> complex:
    """Return the middle of a label of this size, moved so that the label stays on the stage."""
    x = min(max(middle.real, stage.x + wide / 2), stage.right - wide / 2)
    return complex(x, min(max(middle.imag, stage.y + high / 2), stage.bottom - high / 2))


def _lit(begin: complex, end: complex, gauge: Gauge) -> Iterator[Layer]:
    reach = 1.5 * gauge.bar
    loops = [*segments(begin, end, 2 * reach), begin + disc(reach), end + disc(reach)]
    yield Layer(ORANGE, loops, _LIT)


class Spot(NamedTuple):
    """The place of an answer on the picture, in the unit shown, and its mark."""

    key: str
    at: Point
    mood: Mood = ""


@frozen
class Spots(Addition):
    """The places of a game's answers on the picture, in the answers' order."""

    spots: tuple[Spot, ...]

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield their marks: a ring, and beside it, off joints and others, the key on a disc."""
        theme, layout, size = setting.theme, setting.layout, setting.layout.text_size
        places = [setting.view.pixel(spot.at) for spot in self.spots]
        joints = [setting.view.pixel(pose.position[name]) for name in setting.figure.in_view]
        taken = [*places, *joints]
        for n, (spot, at) in enumerate(zip(self.spots, places, strict=True)):
            colour = mood_colour(theme, spot.mood)
            ink = theme.velocity if spot.mood == "" else colour
            disc_at = _off(at, taken, layout.stage, size)
            off = unit(disc_at - at)
            taken.append(disc_at)
            ring = stroke(at + disc(0.55 * size), 0.13 * size, closed=True)
            lead = segments([at + 0.55 * size * off], [disc_at], 0.1 * size)
            rim, inner = disc_at + disc(0.8 * size), disc_at + disc(0.68 * size)
            layers = [Layer(ink, [*ring, *lead]), Layer(ink, [rim]), Layer(theme.panel, [inner])]
            top = disc_at.real, disc_at.imag - 0.5 * size
            words = Caption(spot.key, top, size, ink, "centre", strong=True)
            reach = (at, _RING * size), (disc_at, 0.8 * size)
            targets = tuple(Target("spot", _around(middle, far), n) for middle, far in reach)
            yield Group("spot", layers, [words], over=True, targets=targets)


def _around(middle: complex, far: float) -> Rect:
    """Return the square about a place."""
    return Rect(middle.real - far, middle.imag - far, 2 * far, 2 * far)


_RING = 1.6
"""How near to an answer's place counts as on it, in heights of its letter."""


def _off(at: complex, taken: Sequence[complex], stage: Rect, size: float) -> complex:
    """Return where a disc stands beside a place: farthest off what is there already, near before far."""
    turns = np.exp(1j * np.linspace(0, 2 * np.pi, _TURNS, endpoint=False))
    tries = [_inside(stage, at + far * size * turn, 1.6 * size, 1.6 * size) for far in _FAR for turn in turns]
    clear = [min(_CLEAR * size, *(abs(one - other) for other in taken)) for one in tries]
    return tries[int(np.argmax(np.round(np.array(clear) / size, 2)))]


_FAR, _TURNS = (1.7, 2.3, 3.0), 16
"""How far off its place the disc of an answer's key may stand, in heights of its letter, and which ways."""
_CLEAR = 1.6
"""How far a disc is off all else to be clear of it, in the same."""


def grip(foot: complex, unit_: float, theme: Theme) -> list[Layer]:
    """Return the grip at the foot of the chart's cursor, for a layout's unit."""
    return _grip(unit_, theme.ink, theme.background).at([foot])


@lru_cache(maxsize=4)
def _grip(unit_: float, ink: Colour, back: Colour) -> Stamp:
    """Return the grip about 0; cached, since it is the same at every frame."""
    begin, end = ([unit_ * (side + way) for side in (-1.8, 1.8)] for way in (-3.5j, 3.5j))
    ribs = segments(begin, end, 1.2 * unit_)
    return Stamp((Layer(ink, [box(11 * unit_, 15 * unit_, 4 * unit_)]), Layer(back, ribs)))


# The lane of a ram: two lines on paper that scrolls across its guide.

BEYOND = 0.06
"""How far the guide is drawn beyond the dead centres, in strokes."""
_BAND = 0.3
"""The opacity of a band round a trace."""
_DEEPEST = 0.62
"""How far the paper extends ahead of the ram at the most, in heights of the stage."""


@frozen
class TraceBands(Addition):
    """Bands round traces: of each both edges from place to place (x + yi, in the scene's unit)."""

    edges: tuple[tuple[tuple[complex, complex], ...], ...]

    def behind(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the bands, each in its trace's colour."""
        del pose
        theme, layers = setting.theme, list[Layer]()
        for n, pairs in enumerate(self.edges):
            edges = np.array([[setting.view.pixel((at.real, at.imag)) for at in pair] for pair in pairs])
            (left, right), (further, beyond) = edges.T, np.roll(edges, -1, axis=0).T
            loops = np.stack([left, right, beyond, further], axis=1)
            turns = (np.conj(beyond - left) * (further - right)).imag > 0
            loops[turns] = loops[turns, ::-1]
            layers.append(Layer(theme.traces[n % len(theme.traces)], [*loops], _BAND))
        yield Group("band", layers)


@frozen
class Lane(Addition):
    """Two lines across a ram's guide, from its `back` to its `forward` dead centre, in the unit shown.

    `middle` has pairs: how far ahead, as a share of the visible paper, and where between the dead centres (0
    to 1) the ram has to be then, within `half_width` to either side. `well` says that it is between the lines
    now.
    """

    back: Point
    forward: Point
    middle: tuple[tuple[float, float], ...]
    half_width: float
    well: bool

    def behind(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the paper between the lines, the lines, and the guide for comparing the ram with them."""
        del pose
        _, view, gauge, theme = setting.known
        back, forward = view.pixel(self.back), view.pixel(self.forward)
        across, beside = 1j * unit(forward - back), max(self.half_width, BEYOND) * (forward - back)
        stage, ends = setting.layout.stage.inset(1.8 * gauge.line), (back - beside, forward + beside)

        def room(way: complex) -> float:
            return min(stage.ahead(end, way) for end in ends)

        ahead = max((across, -across), key=room)
        depth = min(room(ahead), _DEEPEST * stage.height)
        way, share = np.array(self.middle).T
        seen = way >= -room(-ahead) / max(depth, 1.0)  # what has left the stage is gone
        way, share = way[seen], share[seen]
        foot: Loop = back + ahead * depth * way + (forward - back) * share
        half = (forward - back) * self.half_width
        edges = foot - half, foot + half
        ink = theme.velocity if self.well else theme.warning
        shade = theme.chosen if self.well else mixed(ink, theme.background, 0.75)
        paper = Layer(shade, [np.concatenate((edges[0], edges[1][::-1]))])
        lines = [loop for edge in edges for loop in stroke(edge, 1.8 * gauge.line)]
        beyond = BEYOND * (forward - back)
        guide = segments(back - beyond, forward + beyond, gauge.line)
        yield Group("lane", [paper, Layer(theme.ground, guide), Layer(ink, lines)])
