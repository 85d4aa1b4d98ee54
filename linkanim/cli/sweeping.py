"""The rows of a sweep, solved a block at a time: a long one takes no more memory than a short one."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from linkanim import units
from linkanim.cli.tree import Leaf, Tree, input_key, mapped, tree
from linkanim.cli.values import SweepSteps
from linkanim.mechanics.formulas.exact import two_product
from linkanim.mechanics.motion.motion import Motion
from linkanim.scenes.scene import Scene

BLOCK = 4096
_WHOLE = 2**53
"""Below this every whole number is a float."""


class RowBlock(NamedTuple):
    """Neighbouring rows: the inputs in degrees, and what is known at each; leaves are arrays (N,)."""

    degrees: Leaf
    found: Tree


@dataclass(frozen=True)
class Steps:
    """The inputs of a sweep, exact: row k is (first + step·k) / scale degrees, in whole numbers."""

    first: int
    step: int
    scale: int
    rows: int

    @staticmethod
    def of(sweep: SweepSteps) -> Steps:
        """Return a sweep's decimals in whole numbers of their last digit."""
        first, step = Fraction(sweep.first), Fraction(sweep.step)
        scale = max(math.lcm(first.denominator, step.denominator), 1)
        return Steps(int(first * scale), int(step * scale), scale, sweep.rows)

    def degrees(self, start: int, stop: int) -> Leaf:
        """Return rows in degrees, each rounded once."""
        if not self._fits:
            return np.array([float(Fraction(self._at(row), self.scale)) for row in range(start, stop)])
        return self._counts(start, stop) / float(self.scale)

    def radians(self, start: int, stop: int) -> Leaf:
        """Return rows in radians, as `units.angle` reads them: by the float π, rounded once."""
        if not self._fits:
            return np.array([units.angle(f"{value!r} deg") for value in self.degrees(start, stop).tolist()])
        exact = Fraction(math.pi) / (180 * self.scale)
        high = float(exact)
        counts = self._counts(start, stop)
        product, lost = two_product(counts, high)
        radians: Leaf = product + (lost + counts * float(exact - Fraction(high)))
        return radians

    @property
    def _fits(self) -> bool:
        """Whether all whole numbers are floats."""
        return max(abs(self._at(0)), abs(self._at(self.rows)), self.scale) < _WHOLE

    def _at(self, row: int) -> int:
        return self.first + self.step * row

    def _counts(self, start: int, stop: int) -> Leaf:
        return (self.first + self.step * np.arange(start, stop)).astype(float)


def blocks(
    scene: Scene, steps: Steps, by: str, speed: float, solve: Callable[[Leaf], Motion]
) -> Iterator[RowBlock]:
    """Yield a sweep's rows; `by` is "angle" or "phase", which runs at `speed` from time 0 in the first row.

    Bodies' angles run on from block to block, which share a row for it.
    """
    start, last = steps.radians(0, 1)[0], None
    for row in range(0, steps.rows, BLOCK):
        shared, stop = int(row > 0), min(row + BLOCK, steps.rows)
        inputs = steps.radians(row - shared, stop)
        motion = solve(inputs)
        time = (inputs - start) / speed if speed else np.full(len(inputs), np.nan)
        where = {input_key(scene): motion.coordinate, "phase": motion.phase, by: inputs, "time": time}
        found = _continued({**where, **tree(scene, motion)}, last)
        last = found
        yield RowBlock(steps.degrees(row, stop), _without(found, shared))


def _continued(found: Tree, last: Tree | None) -> Tree:
    """Return rows whose angles and directions go on from the row before, which is their first."""
    if last is None:
        return found
    for part, name, key in _continued_keys(found):
        known = found[part][name]
        turns = np.rint((last[part][name][key][-1] - known[key][0]) / math.tau)
        known[key] = known[key] + math.tau * np.nan_to_num(turns)
    return found


def _continued_keys(found: Tree) -> Iterator[tuple[str, str, str]]:
    """Yield where angles stand that run on: of bodies, and the directions of springs and dampers."""
    for part, key in (("bodies", "angle"), ("springs", "direction"), ("dampers", "direction")):
        yield from ((part, name, key) for name, known in found[part].items() if key in known)


def _without(found: Tree, rows: int) -> Tree:
    return mapped(lambda leaf: leaf[rows:], found)  # type: ignore[no-any-return]
