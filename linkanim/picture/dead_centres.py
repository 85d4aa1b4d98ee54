"""A slider's two dead centres as ticks on its guide with the input's angles; its stroke and time ratio."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property, partial
from itertools import pairwise
from math import degrees

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.measures import output_slider
from linkanim.mechanics.quantities import input_symbol
from linkanim.picture.figure import DrawSetting
from linkanim.picture.fittings import rail_reach
from linkanim.picture.quantities import driven_words
from linkanim.picture.raster import Layer, Loop
from linkanim.picture.shapes import arrows, segments
from linkanim.units import short, stepped, typeset
from linkanim.words import said

_TICK = 1.6
"""How far a tick extends beyond the rail, in half widths of a bar."""
_VISIBLE = 1e-3
"""The least travel of a slider, in pixels, for its ends to be marked."""
_WIDE = 3.0
"""Ticks do not cross a guide whose rails are further aside than this, in half widths of a bar."""
_NEAR = 0.3
"""Bars that pass the guide no further than this off its ends, in strokes, are in the way of the words."""
_FEW = 1e-6


@frozen
class DeadCentres:
    """The dead centres of a figure's output slider, which slides on the ground.

    `ends` are the slider's places furthest back and furthest forward, `rail` how far aside its rails lie, all
    in pixels.
    """

    setting: DrawSetting
    ends: tuple[complex, complex]
    rail: float

    def words(self) -> Iterator[tuple[str, complex, Callable[[tuple[float, float]], Loop]]]:
        """Yield the input's angle at each dead centre, and between them the stroke and the time ratio.

        Each comes with its tick, and the places at which the middle of a line of text of a size may stand.
        """
        info = self.setting.figure.scene.info
        lines = [*map(self._angle, info.dead_centres or ())]
        if self.sized and info.stroke and info.time_ratio:
            stroke = f"{short(info.stroke)} {self.setting.figure.scene.length_unit}"
            words = said("stroke {length}, time ratio {ratio}", length=stroke, ratio=short(info.time_ratio))
            lines.append(typeset(words))
        feet = (*zip(self.ends, (-1, 1), strict=True), (sum(self.ends) / 2, 0))
        for text, foot in zip(lines, feet, strict=False):
            yield text, foot[0], partial(self._text_places, *foot)

    def _text_places(self, foot: complex, end: int, size: tuple[float, float]) -> Loop:
        """Return places for the middle of a line of text off the guide, those on its side `out` first.

        The text is at one `end` of the guide, -1 or 1, or about its middle, 0.
        """
        (along, out), (wide, high) = self._frame, size
        aside, beyond = (0.5 * (abs(side.real) * wide + abs(side.imag) * high) for side in (out, along))
        level = self._reach + aside + 0.2 * high + (0 if end else 1.3 * high * abs(out.imag))
        steps = [0, end * beyond, 2 * end * beyond, -end * beyond, -2 * end * beyond] if end else [0]
        return np.array(
            [
                foot + side * out * (level + further * high) + step * along
                for side in (1, -1)
                for further in (0, 1.2)
                for step in steps
            ]
        )

    @property
    def sized(self) -> bool:
        """Whether the look asks for dimensions, and so for the stroke."""
        return self.setting.look.names > 1

    @cached_property
    def _frame(self) -> tuple[complex, complex]:
        """The directions in pixels along the guide, and off it to where there is more room."""
        begin, along = self.ends[0], self.ends[1] - self.ends[0]
        seen = (np.concatenate([np.zeros(0, complex), *self._passed()]) - begin) / along
        near = seen[(seen.real > -_NEAR) & (seen.real < 1 + _NEAR)].imag
        crowded = float(np.sum(np.sign(near) * np.exp(-np.abs(near))))
        out = 1j * along / abs(along) * (-1 if crowded > _FEW * near.size else 1)
        return along / abs(along), out if self._fits(out) or not self._fits(-out) else -out

    def _passed(self) -> Iterator[Loop]:
        """Yield pixels that bars pass through in the cycle, except for the slider's own track."""
        figure, view = self.setting.figure, self.setting.view
        for body in figure.bodies:
            for ends in pairwise(body.joints):
                begin, end = (figure.path(name, view) for name in ends)
                yield from (begin + share * (end - begin) for share in (0.2, 0.4, 0.6, 0.8))

    def _fits(self, out: complex) -> bool:
        """Return whether the words have room on one side of the guide."""
        stage, high = self.setting.layout.stage, (self._reach + 2.8 * self.setting.layout.small_size) * out
        return all(stage.holds((end + high).real, (end + high).imag) for end in self.ends)

    @property
    def _reach(self) -> float:
        """How far the ticks extend from the line of travel, in pixels."""
        return self.rail + _TICK * self.setting.gauge.bar

    def _angle(self, phase: float) -> str:
        scene = self.setting.figure.scene
        angle = scene.pose(phase, 0).coordinate
        if not scene.info.full_turn:
            return f"{input_symbol(scene.linkage)} = {driven_words(scene, angle)}"
        return f"{input_symbol(scene.linkage)} = {stepped(round(degrees(angle), 1) % 360, 0.1)}°"

    @cached_property
    def ticks(self) -> tuple[tuple[complex, complex], ...]:
        """The lines across the guide, or beside a cylinder, and the one between where the stroke is shown."""
        (_, out), bar = self._frame, self.setting.gauge.bar
        level = out * (self._reach - 0.4 * bar)
        begin = -self._reach if self.rail < _WIDE * bar else self.rail
        across = tuple((foot + out * begin, foot + out * self._reach) for foot in self.ends)
        return (*across, (self.ends[0] + level, self.ends[1] + level)) if self.sized else across

    @property
    def layers(self) -> list[Layer]:
        """The ticks, and the stroke's arrows between them."""
        width, (first, second, *level) = 0.9 * self.setting.gauge.line, self.ticks
        begins, ends = zip(first, second, strict=True)
        lines = segments(begins, ends, width)
        for begin, end in level:
            middle = (begin + end) / 2
            lines += arrows([middle, middle], [begin - middle, end - middle], 1.6 * width)
        return [Layer(self.setting.theme.dim, lines)]


def dead_centres_of(setting: DrawSetting) -> DeadCentres | None:
    """Return the dead centres; None where no slider runs on the ground, or it travels too little."""
    figure, body = setting.figure, output_slider(setting.figure.linkage)
    slider, phases = body.slider if body else None, figure.scene.info.dead_centres
    if slider is None or phases is None or figure.linkage.joint(slider).slides[0].start is not None:
        return None
    back, forward = (setting.view.pixel(figure.scene.pose(phase, 0).position[slider]) for phase in phases)
    if not abs(forward - back) > _VISIBLE:
        return None
    return DeadCentres(setting, (back, forward), rail_reach(setting, slider))
