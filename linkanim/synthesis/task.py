"""What is asked for: a drawn curve, a kind of linkage, how the crank goes with the points, and limits."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkanim.synthesis.curves.drawn import DrawnCurve
from linkanim.synthesis.kinds import Indices, LinkageKind, Real
from linkanim.synthesis.match import Candidates
from linkanim.synthesis.requirements import Requirements

FEW = 12
"""Points that say nothing about the way between them."""
EXACTLY = 1e10
"""What a point that is to be passed through exactly weighs beside another one."""


@dataclass(frozen=True, eq=False)
class PathTask:
    """A curve in its unit, with its points' weights and what its linkages have to be.

    `timing` is None where crank angles are free, else the crank's angle at each point; with `free_start` all
    of those may be shifted by one angle.
    """

    curve: DrawnCurve
    kind: LinkageKind
    requirements: Requirements
    weights: Real
    timing: Real | None = None
    free_start: bool = True
    unit: str = "mm"
    name: str = "path"
    source: str = "a drawn path"

    @cached_property
    def normal(self) -> DrawnCurve:
        """The curve about the origin, its size 1."""
        return DrawnCurve((self.curve.points - self.curve.centre) / self.curve.size, self.curve.closed)

    def thinned(self, count: int) -> Indices:
        """Return which points to take: about so many equally far along, and those to be passed exactly."""
        return np.union1d(self.normal.thinned(count), np.flatnonzero(self.weights >= EXACTLY))

    @property
    def is_dense(self) -> bool:
        """Whether the points say where the curve goes between them."""
        return self.timing is None and len(self.curve.points) > FEW

    def problem(self, chosen: Indices) -> PathTask:
        """Return the same for some of the points, at size 1 about the origin."""
        return replace(
            self,
            curve=DrawnCurve(self.normal.points[chosen], self.curve.closed),
            requirements=self.requirements.placed(self.curve.centre, self.curve.size),
            weights=self.weights[chosen],
            timing=None if self.timing is None else self.timing[chosen],
        )

    def scaled(self, found: Candidates) -> Candidates:
        """Return candidates of size 1 in the curve's own unit and place."""
        return self._placed(found, self.curve.size, self.curve.centre)

    def normalised(self, found: Candidates) -> Candidates:
        """Return candidates in the curve's unit at size 1 about the origin: `scaled` undone."""
        return self._placed(found, 1 / self.curve.size, -self.curve.centre / self.curve.size)

    def _placed(self, found: Candidates, scale: float, shift: complex) -> Candidates:
        ones = np.ones(len(found.rows), np.complex128)
        return found._replace(rows=self.kind.placed(found.rows, scale * ones, shift * ones))

    def swinging(self) -> PathTask:
        """Return the same task, the crank free to swing."""
        return replace(self, requirements=replace(self.requirements, full_turn=False))

    @property
    def quantum(self) -> int:
        """To how many decimals lengths are written: to a share of 1e-12 of the curve's size."""
        return 12 - math.floor(math.log10(self.curve.size))
