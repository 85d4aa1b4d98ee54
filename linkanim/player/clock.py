"""Keep the player's clock: phase as a closed form of the integer frame, never a running sum."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Self

from linkanim.frozen import frozen

# The player's clock: phase as a closed form of the integer frame, never a running sum.

FRAMES_PER_SECOND = 60
STEP = math.radians(1.0)

COAST_FRAMES = 80
"""The frames in which a motion that a hand let go returns to its own speed."""

_LADDER = (1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.3, 8.0)  # Renard's R10 series
SLOWEST, FASTEST = -20, 10
"""The rungs of the ladder: a hundredth to ten times the scene's own speed."""


def factor(level: int) -> float:
    """Return the speed factor of a rung of the ladder: 1 at level 0, ten rungs to a decade."""
    decade, rung = divmod(level, len(_LADDER))
    return _LADDER[rung] * 10.0**decade if decade >= 0 else _LADDER[rung] / 10.0**-decade


@frozen
class Clock:
    """Where the phase is at any frame: a straight line from the frame of the last change.

    `rate` is the scene's own dφ/dt (rad/s, negative clockwise). `steps` counts degrees stepped
    by hand since the anchor, so that a step there and back is the same phase to the last bit.
    `coast` is the extra speed (rad/s) at frame `since`, when a hand let the motion go; it fades.
    """

    rate: float
    frame: int = 0
    phase: float = 0.0
    steps: int = 0
    level: int = 0
    direction: int = 1
    paused: bool = False
    coast: float = 0.0
    since: int = 0

    @property
    def speed(self) -> float:
        """The signed dφ/dt that is set (rad/s), also while the clock is paused."""
        return self.direction * self.rate * factor(self.level)

    def at(self, frame: float) -> float:
        """Return the phase (rad) at a frame; a fractional frame is allowed, for other frame rates."""
        still = self.phase + self.steps * STEP
        if self.coast:
            still += self._coasted(frame) - self._coasted(self.frame)
        return still if self.paused else still + self.speed * (frame - self.frame) / FRAMES_PER_SECOND

    def _coasted(self, frame: float) -> float:
        """Return the phase gained since then: the extra speed falls with the square of the time left."""
        remaining = 1.0 - min(max(frame - self.since, 0.0), COAST_FRAMES) / COAST_FRAMES
        return self.coast * COAST_FRAMES / FRAMES_PER_SECOND / 3.0 * (1.0 - remaining**3)

    def pause(self, frame: int, paused: bool) -> Self:
        """Return the clock paused or running from `frame` on, phase continuous."""
        if paused == self.paused:
            return self
        clock = self._anchored(frame)
        return replace(clock, paused=paused, coast=0.0 if paused else clock.coast)

    def let_go(self, frame: int, speed: float, *, paused: bool) -> Self:
        """Return the clock running on at a hand's dφ/dt (rad/s), and easing to its own speed or to rest."""
        clock = self.go(frame, self.at(frame), paused=paused)
        return replace(clock, coast=speed - (0.0 if paused else clock.speed), since=frame)

    def turn(self, frame: int) -> Self:
        """Return the clock running the other way, phase continuous."""
        return replace(self._anchored(frame), direction=-self.direction)

    def faster(self, frame: int, levels: int) -> Self:
        """Return the clock `levels` rungs up the ladder of speeds (negative: down), phase continuous."""
        return self.at_level(frame, self.level + levels)

    def at_level(self, frame: int, level: int) -> Self:
        """Return the clock on a rung of the ladder, or at its nearer end, phase continuous."""
        return replace(self._anchored(frame), level=min(max(level, SLOWEST), FASTEST))

    def step(self, frame: int, degrees: int) -> Self:
        """Return the clock paused, the crank moved by `degrees` in the direction in which it runs."""
        along = degrees if self.speed > 0 else -degrees
        still = self.pause(frame, True)
        if still.coast:
            still = replace(still._anchored(frame), coast=0.0)
        return replace(still, steps=still.steps + along)

    def go(self, frame: int, phase: float, *, paused: bool | None = None) -> Self:
        """Return the clock at `phase` at `frame`; without `paused`, it is paused or running as before."""
        stays = self.paused if paused is None else paused
        return replace(self, frame=frame, phase=phase, steps=0, paused=stays, coast=0.0)

    def at_rate(self, frame: int, rate: float) -> Self:
        """Return the clock with another scene's own speed, phase continuous."""
        return self if rate == self.rate else replace(self._anchored(frame), rate=rate)

    def _anchored(self, frame: int) -> Self:
        """Move the anchor to `frame`; a paused clock keeps its steps countable."""
        if self.paused:
            # the phase gained by coasting so far is added to the anchor's
            return replace(
                self, frame=frame, phase=self.at(frame) - self.steps * STEP if self.coast else self.phase
            )
        return replace(self, frame=frame, phase=self.at(frame), steps=0)
