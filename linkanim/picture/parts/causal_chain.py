"""The causal chain in colour: the input's colour fades from step to step in which joints are solved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts.bodies import colours_of, pin_stamp
from linkanim.picture.raster.parts import Part, Stamp
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.theme import Theme, mixed

_FADED = 0.8
"""How much of the background is in the colour of the last step."""


@dataclass(frozen=True)
class CausalChain:
    """Each joint's step, 0 on the ground, and what the colours are that stand for them.

    One hue that only gets nearer to the background, so that it reads without telling hues apart.
    """

    steps: Mapping[str, int]
    theme: Theme

    @property
    def last(self) -> int:
        """The last step."""
        return max(self.steps.values(), default=1)

    @property
    def colours(self) -> tuple[Colour, ...]:
        """The colour of each step, the input's first."""
        return tuple(self._colour(step) for step in range(1, self.last + 1))

    def pins(self, gauge: Gauge) -> dict[str, Stamp]:
        """Return the joints' pins, their eyes in the colour of their step; those of the ground as ever."""
        eyes = [self.theme.pin, *self.colours]
        stamps = [pin_stamp(gauge, replace(self.theme, pin=eye)) for eye in eyes]
        return {name: stamps[step] for name, step in self.steps.items()}

    def coloured(self, parts: tuple[Part, ...], figure: Figure) -> Iterator[Part]:
        """Yield bodies and their fittings in colours between those of the joints by which they move."""
        usual = colours_of(figure, self.theme)
        for part in parts:
            own = {usual.get(part.name, self.theme.metal), self.theme.metal}
            shade = self._between({part.at, part.tail, part.head, *part.joints})
            layers = (
                Layer(shade, loops, alpha) if colour in own else Layer(colour, loops, alpha)
                for colour, loops, alpha in part.layers
            )
            yield replace(part, layers=tuple(layers))

    def _between(self, joints: set[str]) -> Colour:
        """Return the colour half way from the first step of some joints to the last; metal on the ground."""
        steps = [self.steps[name] for name in joints if self.steps[name]]
        return self._colour((min(steps) + max(steps)) / 2) if steps else self.theme.metal

    def _colour(self, step: float) -> Colour:
        share = (step - 1) / max(self.last - 1, 1)
        return mixed(self.theme.bodies[0], self.theme.background, _FADED * share)
