"""The input's motion: an arrow that bends as the driven bar turns, its angle's arc; or a straight arrow."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import pi, tau
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage.pins import DrivenSlider
from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster.directions import directions
from linkanim.picture.raster.parts import Places, joined
from linkanim.picture.raster.raster import Colour, Layer, Loop
from linkanim.picture.raster.shapes import arrows, segments, strokes, unit
from linkanim.picture.theme import Theme
from linkanim.picture.view import View

Angles = TypeVar("Angles", float, NDArray[np.float64])

SWEEP = 1.25
"""How much of a turn the arrow covers where the input is fastest, in radians."""
AHEAD = 0.3
"""How far ahead of the bar it begins, in radians."""
_CLEAR, _LONGEST = 3.0, 6.0
"""How far from a slider's middle a straight one begins, and its length at most, in half widths of a bar."""


@dataclass(frozen=True)
class Turning:
    """What shows how the bar from `pivot` to `pin` turns; radii in pixels, `fastest` in rad/s.

    Its angle is told within half a turn of `middle` (rad), as the HUD tells it.
    """

    pivot: str
    pin: str
    arc: float
    arrow: float
    fastest: float
    colours: tuple[Colour, Colour]
    gauge: Gauge
    middle: float = pi

    def turned(self, angle: Angles) -> Angles:
        """Return the bar's angle (rad) as it is told."""
        return self.middle + (angle - self.middle + pi) % tau - pi

    def tracks(
        self, paths: Mapping[str, Loop], rates: NDArray[np.float64], *, angled: bool
    ) -> Iterator[tuple[Loop, float]]:
        """Yield points (n, k) along the arrow and the angle, for joints on paths (n); half their widths."""
        centre, pin = paths[self.pivot], paths[self.pin]
        way, share = (pin - centre) / np.abs(pin - centre), np.linspace(0, 1, 16)
        sweep = SWEEP * np.clip(-rates / self.fastest, -1, 1)[:, None]
        shaft = np.sign(sweep) * AHEAD + sweep * np.linspace(0, 1, 6)
        head = shaft[:, -1:] + np.sign(sweep) * 6.0 * self.gauge.line / self.arrow * np.array([-0.5, 1])
        for bend, half in ((shaft, 1.8), (head, 4.2)):
            yield centre[:, None] + self.arrow * way[:, None] * directions(bend), half * self.gauge.line
        if angled:
            turned = self.turned(np.angle(np.conj(way)))[:, None]
            yield centre[:, None] + self.arc * directions(-turned * share), 1.5 * self.gauge.line
            yield centre[:, None] + np.array([0, 1.5 * self.arc]), self.gauge.line

    def direction(self, pose: Pose, places: Places, rate: float) -> list[Layer]:
        """Return the arrow, shorter as the bar slows down; `rate` is the scene's speed over this one's."""
        turning = -pose.coordinate_rate * rate / self.fastest
        sweep = SWEEP * min(max(turning, -1.0), 1.0)
        if not abs(sweep) > 0.02:
            return []
        bent = _bent(sweep, self.arrow, self.gauge.line, self.colours)
        return [layer.placed(*self._bar(places)) for layer in bent]

    def angle(self, places: Places) -> list[Layer]:
        """Return the arc from the horizontal to the bar, and the line it begins at."""
        centre, way = self._bar(places)
        turned = self.turned(float(np.angle(way.conjugate())))
        path = centre + self.arc * directions(np.linspace(0, -turned, max(round(abs(turned) * 12), 2)))
        ink, back = self.colours
        halo, line = strokes(path, (2.6 * self.gauge.line, 0.9 * self.gauge.line))
        return [Layer(back, halo), Layer(ink, [*line, *_dashes(centre, 1.45 * self.arc, self.gauge.line)])]

    def _bar(self, places: Places) -> tuple[complex, complex]:
        return places[self.pivot], unit(places[self.pin] - places[self.pivot])


@lru_cache(maxsize=16)
def _dashes(begin: complex, room: float, thick: float) -> list[Loop]:
    """Return a dashed line to the right; a pivot mostly stands still: the last ones are kept."""
    dashes = begin + np.arange(0, room, 3.5 * thick)
    return segments(dashes, dashes + 2.2 * thick, 0.8 * thick)


@lru_cache(maxsize=16)
def _bent(sweep: float, radius: float, thick: float, colours: tuple[Colour, Colour]) -> tuple[Layer, ...]:
    """Return an arrow about the pivot, the bar along the real axis, in its rim and without.

    It bends by `sweep` (rad, negative to the left); its head is smaller where it is short. An input of
    steady speed has the same arrow at every frame: the last ones are kept.
    """
    side, line, rim = 1 if sweep > 0 else -1, 1.7 * thick, 0.9 * thick
    bend: Loop = radius * directions(side * AHEAD + sweep * np.linspace(0, 1, 16))
    head, turn = min(6.5 * thick, 0.8 * abs(sweep) * radius), bend[-1] / radius * 1j * side
    (rimmed,), (bare,) = strokes(bend, (line + 2 * rim, line))
    # a triangle whose point is a little ahead of the end
    barb = turn * np.array([0.75, -0.35 + 0.5j, -0.35 - 0.5j])
    loops = (rimmed, bend[-1] + (head + 2 * rim) * barb), (bare, bend[-1] + head * barb)
    return joined(map(Layer, reversed(colours), loops))


@dataclass(frozen=True)
class Sliding:
    """What shows how a slider that drives runs along its guide, y down; `fastest` in the scene's unit/s."""

    joint: str
    along: complex
    room: float
    longest: float
    fastest: float
    colours: tuple[Colour, Colour]
    gauge: Gauge

    def direction(self, pose: Pose, places: Places, rate: float) -> list[Layer]:
        """Return the arrow ahead of the slider, shorter as it slows down; `rate` as of a `Turning`."""
        share = pose.coordinate_rate * rate / self.fastest
        reach = self.along * self.longest * min(max(share, -1.0), 1.0)
        if not abs(reach) > 0.02 * self.longest:
            return []
        foot, width = places[self.joint] + self.room * unit(reach), 1.7 * self.gauge.line
        ink, back = self.colours
        rims = ((back, 0.9 * self.gauge.line), (ink, 0.0))
        return [Layer(colour, arrows([foot], [reach], width, rim)) for colour, rim in rims]

    def tracks(
        self, paths: Mapping[str, Loop], rates: NDArray[np.float64], *, angled: bool
    ) -> Iterator[tuple[Loop, float]]:
        """Yield the ends (n, 2) of the arrow of a joint on its path, and half its width; it has no angle."""
        reach = self.along * self.longest * np.clip(rates / self.fastest, -1, 1)
        foot = paths[self.joint] + self.room * self.along * np.sign(rates)
        yield np.stack((foot, foot + reach), axis=1), 4.2 * self.gauge.line


def motion_of(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> Turning | Sliding | None:
    """Return what shows how the input moves: its bar's turning, or its slider's way along the guide.

    None where the input is neither a slider nor a crank on a pivot.
    """
    joint, info = figure.linkage.joint(figure.linkage.drive.joint), figure.scene.info
    fastest = float(np.nanmax(np.abs(figure.cycle.coordinate_rate)))
    ink = theme.ink, theme.background
    if isinstance(joint, DrivenSlider):
        along = complex(directions(-joint.line.angle))
        return Sliding(joint.name, along, _CLEAR * gauge.bar, _LONGEST * gauge.bar, fastest, ink, gauge)
    pivot = getattr(joint, "pivot", None)
    if pivot is None:
        return None
    arc, arrow = _radii(view.scale * abs(figure.start(joint.name) - figure.start(pivot)), gauge)
    middle = pi if info.full_turn else sum(info.input_range) / 2
    return Turning(pivot, joint.name, arc, arrow, fastest, ink, gauge, middle)


def _radii(length: float, gauge: Gauge) -> tuple[float, float]:
    """Return the radii of the angle's arc and of the arrow, in pixels, for a bar of that length."""
    arc = max(min(0.36 * length, 6 * gauge.bar), 2.2 * gauge.bar)
    return arc, max(min(0.7 * length, 8 * gauge.bar), arc + 1.6 * gauge.bar)


def turning_arrow(pivot: complex, pin: complex, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return the arrow of a driven bar that stands still, in pixels, counter-clockwise."""
    _, arrow = _radii(abs(pin - pivot), gauge)
    bent = _bent(-SWEEP, arrow, gauge.line, (theme.ink, theme.background))
    return [layer.placed(pivot, unit(pin - pivot)) for layer in bent]
