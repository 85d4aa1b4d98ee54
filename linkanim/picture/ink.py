"""Ink a trace by speed: the faster a joint moves along its curve, the thicker and warmer the curve is.

All of a curve's width lies to the left of the motion, so that a curve which is passed there and back shows
both ways side by side. Dots on it are equal times apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.picture.figure import DrawContext, Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.motion_marks import sides_of
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import disc, distinct
from linkanim.picture.theme import Theme, mixed
from linkanim.units import three_digits

_SHADES = 18
_THIN, _THICK = 1.0, 6.5
"""The width of the curve where the joint rests and where it is fastest, in widths of a thin line."""
_DOTS = (24, 12, 8, 6, 4, 3, 2, 1)
_MOST_DOTS = 96
"""The numbers of dots in a drive period, and the most in a true period."""
_APART = 7.0
"""The least distance between dots, on average, in widths of a thin line."""
_DOT, _RIM = 1.6, 0.7
"""The radius of a dot and the width of its rim, in widths of a thin line."""


def ramp(theme: Theme, share: float) -> Colour:
    """Return the colour of a share (0 to 1) of the greatest speed."""
    last = len(theme.speeds) - 1
    step = min(int(share * last), last - 1)
    return mixed(theme.speeds[step], theme.speeds[step + 1], share * last - step)


class InkScale(NamedTuple):
    """The scale of the ink of all traced joints: the greatest speed of the cycle, and the dots' interval.

    `most` is in the scene's unit per second at its own input speed `drive` (rad/s of phase); `gap` is the
    phase from dot to dot (rad).
    """

    most: float
    gap: float
    drive: float
    unit: str

    def greatest_words(self, speed: float) -> str:
        """Return the greatest speed at an input speed (rad/s of phase); a dash where nothing moves."""
        most = self.most * abs(speed / self.drive)
        return f"0 … {three_digits(most)} {self.unit}" if most else "–"

    def interval_words(self, speed: float) -> str:
        """Return the time from dot to dot at an input speed; a dash where nothing moves."""
        return f"{three_digits(self.gap / abs(speed))} s" if speed and self.most else "–"

    def wedge(self, begin: complex, reach: float, size: float, theme: Theme) -> Iterator[Layer]:
        """Yield the colours from rest to the greatest speed, along a line that thickens."""
        step = reach / _SHADES
        for n in range(_SHADES):
            # each part extends a little below the next one, so that no seam shows
            low, high = (begin + step * at for at in (n, min(n + 1.5, _SHADES)))
            thick = 0.35 * size * (_THIN + (_THICK - _THIN) * (n + 0.5) / _SHADES) / _THICK
            corners = (low + 1j * thick, low - 1j * thick, high - 1j * thick, high + 1j * thick)
            yield Layer(ramp(theme, n / (_SHADES - 1)), [np.array(corners)])

    def row_of_dots(self, begin: complex, reach: float, size: float, theme: Theme) -> Iterator[Layer]:
        """Yield three dots side by side."""
        yield Layer(theme.ink, [begin + share * reach + disc(0.14 * size) for share in (0.1, 0.5, 0.9)])


def ink_scale(context: DrawContext) -> InkScale:
    """Return the scale of a scene's ink, with as many dots as have room on the longest curve."""
    figure, view, gauge, _ = context.known
    scene, periods = figure.scene, figure.scene.mechanism.periods
    speeds = [_speed(figure, joint) for joint in scene.trace]
    most = max((float(one.max()) for one in speeds), default=0.0)
    longest = max((float(one.mean()) for one in speeds), default=0.0) * view.scale
    longest *= scene.period / abs(scene.linkage.drive.speed)
    room = min(longest / (_APART * gauge.line), _MOST_DOTS)
    dots = next((count for count in _DOTS if count * periods <= room), 1)
    return InkScale(most, 2 * np.pi / dots, scene.linkage.drive.speed, f"{scene.length_unit}/s")


def _speed(figure: Figure, joint: str) -> NDArray[np.float64]:
    """Return a joint's speed over the cycle; 0 where it is not known."""
    across, up = np.atleast_2d(figure.cycle.velocity[joint]).T
    speed: NDArray[np.float64] = np.hypot(across, up)
    return np.where(np.isfinite(speed), speed, 0.0)


@frozen
class Ink:
    """The curve of one joint in pixels at equal steps of phase (N,), and its `share` of the greatest speed.

    `dots` are places that are equal times apart, and `numbers` the indices of the curve's points next to
    them.
    """

    joint: str
    path: Loop
    share: NDArray[np.float64]
    dots: Loop
    numbers: NDArray[np.int64]
    scale: InkScale
    theme: Theme
    gauge: Gauge

    @cached_property
    def layers(self) -> list[Layer]:
        """The curve in its colours, the slow parts first, and the dots on it."""
        if len(distinct(self.path)) < 2:
            return []
        right = self.path
        left = right + self._side * self._width
        count = len(right)
        shade = np.minimum((self.share * _SHADES).astype(np.int64), _SHADES - 1)
        loops: dict[int, list[Loop]] = {}
        ends = [*np.flatnonzero(shade != np.roll(shade, 1)).tolist()] or [0]
        for begin, end in zip(ends, [*ends[1:], ends[0] + count], strict=True):
            # each part extends below its neighbour, so that no seam shows between them
            part = np.arange(begin, end + 2) % count
            loops.setdefault(int(shade[begin]), []).append(np.concatenate((right[part], left[part][::-1])))
        curve = [Layer(ramp(self.theme, n / (_SHADES - 1)), loops[n]) for n in sorted(loops)]
        return [*curve, *self._dotted()]

    @property
    def _side(self) -> Loop:
        """The unit vectors to the left of the motion."""
        return sides_of(self.path)

    @property
    def _width(self) -> NDArray[np.float64]:
        return np.asarray((_THIN + (_THICK - _THIN) * self.share) * self.gauge.line, np.float64)

    def _dotted(self) -> list[Layer]:
        """Return the dots, each in a rim that sets it off from the curve."""
        line = self.gauge.line
        sizes = ((self.theme.background, _DOT + _RIM), (self.theme.ink, _DOT))
        middle = (0.5 * self._side * self._width)[self.numbers]
        places = (self.dots + middle)[np.isfinite(self.dots)]
        return [Layer(colour, [place + disc(size * line) for place in places]) for colour, size in sizes]


def inks(context: DrawContext) -> tuple[Ink, ...]:
    """Return the inked curves of the scene's traced joints."""
    scale = ink_scale(context)
    return tuple(_ink(context, joint, scale) for joint in context.figure.scene.trace)


def _ink(context: DrawContext, joint: str, scale: InkScale) -> Ink:
    figure, view, gauge, theme = context.known
    share = _speed(figure, joint) / scale.most if scale.most > 0.0 else np.zeros(len(figure.cycle.phase))
    phases = np.arange(round(figure.scene.period / scale.gap)) * scale.gap
    across, up = np.atleast_2d(figure.scene.solve(phase=phases, derivatives=0).position[joint]).T
    dots = view.x + view.scale * across + 1j * (view.y - view.scale * up)
    numbers = np.rint(phases / figure.scene.period * len(share)).astype(np.int64) % len(share)
    return Ink(joint, figure.path(joint, view), share, dots, numbers, scale, theme, gauge)
