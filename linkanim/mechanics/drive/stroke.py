"""A length that drives, running to and fro: it is mid - amp·cos φ.

It starts at `first`, is at `last` half a period on, and comes back.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, NoReturn

import numpy as np

from linkanim.errors import AssemblyError
from linkanim.mechanics.drive.input_path import Limit, ThereAndBack
from linkanim.mechanics.formulas.arrays import Array
from linkanim.mechanics.formulas.circular import sharp_half_angle
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Moving, Slope


@dataclass(frozen=True, slots=True)
class Stroke(ThereAndBack):
    """The input's path where a length drives it; results times `unscale` are in the scene's unit."""

    first: float
    last: float
    unscale: float = field(default=1.0, kw_only=True)

    runs: ClassVar[str]
    """What runs to and fro, in words."""

    @property
    def periods(self) -> int:
        """One there-and-back, times what a chain that passes a change point needs."""
        return self.rounds

    def lengths(self, phases: Array) -> Array:
        """Return the length at phases."""
        lengths: Array = (self.first + self.last) / 2 - (self.last - self.first) / 2 * np.cos(phases)
        return lengths

    def forth(self, length: float) -> float:
        """Return the phase at which the length is reached on the way to `last`, at most that of an end."""
        middle, half = (self.first + self.last) / 2, (self.last - self.first) / 2
        return math.acos(min(max((middle - length) / half, -1.0), 1.0))

    def running(self, phase: Value, pace: Slope) -> Moving:
        """Return the length with its rates."""
        whole, reach = sharp_half_angle(phase + phase), (self.last - self.first) / 2
        length = whole.cosine * -reach + (self.first + self.last) / 2
        rate = whole.sine * pace.value * reach
        second = (whole.cosine * (pace.value * pace.value) + whole.sine * pace.rate) * reach
        return Moving(length, rate, second)

    def cut(self, low: Limit, high: Limit) -> NoReturn:
        """Raise AssemblyError with the lengths between which everything closes: it may not be shorter."""
        dyad = next(name for _, name in (low, high) if name is not None)
        ends = [float(self.lengths(np.array(float(phase)))) * self.unscale for phase, _ in (low, high)]
        least, most = sorted(ends)
        first, last = self.first * self.unscale, self.last * self.unscale
        raise AssemblyError(
            f"joint {dyad}: it lets the {self.runs} run from {least:.6g} to {most:.6g} only, "
            f"not from {first:g} to {last:g}; choose other ends"
        )
