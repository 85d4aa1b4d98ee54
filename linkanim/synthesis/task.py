"""What is asked for: a drawn curve, a kind of linkage, how the crank goes with the points, and limits."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkanim.synthesis.curves.drawn import DrawnCurve
from linkanim.synthesis.kinds import Indices, LinkageKind, Real
from linkanim.synthesis.match import Candidates
from linkanim.synthesis.refine import LeastSquares
from linkanim.synthesis.requirements import Requirements


@dataclass(frozen=True, eq=False)
class PathTask:
    """A curve in its unit, with what its linkages have to be; the timing is as in `LeastSquares`."""

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

    def problem(self, chosen: Indices) -> LeastSquares:
        """Return the least squares over some of the points, at size 1."""
        return LeastSquares(
            self.kind,
            self.normal.points[chosen],
            self.weights[chosen],
            self.requirements.placed(self.curve.centre, self.curve.size),
            self.curve.closed,
            None if self.timing is None else self.timing[chosen],
            self.free_start,
        )

    def scaled(self, found: Candidates) -> Candidates:
        """Return candidates of size 1 in the curve's own unit and place."""
        size, centre = self.curve.size, self.curve.centre
        ones = np.ones(len(found.rows), np.complex128)
        return found._replace(rows=self.kind.placed(found.rows, size * ones, centre * ones))

    def normalised(self, found: Candidates) -> Candidates:
        """Return candidates in the curve's unit at size 1 about the origin: `scaled` undone."""
        size, centre = self.curve.size, self.curve.centre
        ones = np.ones(len(found.rows), np.complex128)
        return found._replace(rows=self.kind.placed(found.rows, ones / size, -centre / size * ones))

    def swinging(self) -> PathTask:
        """Return the same task, the crank free to swing."""
        return replace(self, requirements=replace(self.requirements, full_turn=False))

    @property
    def quantum(self) -> int:
        """To how many decimals lengths are written: to a share of 1e-12 of the curve's size."""
        return 12 - math.floor(math.log10(self.curve.size))
