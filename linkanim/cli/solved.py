"""Everything that is known at each solved angle, as one tree that JSON, CSV and the tables read.

The tree is that of `solve --json`; its leaves are arrays (N,), a value for each angle. The rows of a sweep
are solved a block at a time: a long one takes no more memory than a short one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from itertools import repeat
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim import units
from linkanim.export import mapped
from linkanim.mechanics.facts.register import Path, recorded
from linkanim.mechanics.motion.motion import Motion
from linkanim.scenes.scene import Scene

Leaf = NDArray[np.float64]
Tree = dict[str, Any]
BLOCK = 4096
_WHOLE = 2**53
"""Below this every whole number is a float."""


def input_key(scene: Scene) -> str:
    """Return under which key the tree has the input: its angle, or the travel of a slider that drives."""
    return scene.linkage.drive.coordinate.name


def tree(scene: Scene, motion: Motion) -> Tree:
    """Return every quantity of N poses under its path, in the scene's unit, radians and seconds."""
    found: Tree = {"joints": {}, "bodies": {}, "springs": {}, "dampers": {}}
    for quantity in recorded(scene.linkage):
        _put(found, quantity.path, _leaf(quantity.read(motion), motion))
    return found


def _put(found: Any, path: Path, leaf: Leaf) -> None:
    """Put a leaf where a path leads, through tables and lists that are made on the way."""
    key, *rest = path
    if isinstance(key, int):
        found.append(leaf)
    elif rest:
        _put(found.setdefault(key, [] if isinstance(rest[0], int) else {}), tuple(rest), leaf)
    else:
        found[key] = leaf


def _leaf(found: Any, motion: Motion) -> Leaf:
    """Return what was found at every instant, NaN for what is not known (None)."""
    return np.broadcast_to(np.asarray(np.nan if found is None else found, np.float64), np.shape(motion.phase))


def leaves(node: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Yield ("joints.B.position.x", leaf), ...: the keys on the way joined by dots.

    A pair is told apart by x and y, coefficients by 1 (the first derivative) and 2.
    """
    if isinstance(node, list):
        ends = "12" if name.endswith("coefficients") else "xy"
        node = dict(zip(ends, node, strict=True))
    if not isinstance(node, Mapping):
        yield name, node
        return
    for key, part in node.items():
        yield from leaves(part, f"{name}.{key}" if name else key)


def rows(node: Tree) -> Iterator[Tree]:
    """Yield the tree of each row, its leaves plain floats; what is no array is every row's."""
    columns = mapped(lambda leaf: iter(leaf.tolist()) if isinstance(leaf, np.ndarray) else repeat(leaf), node)
    yield from (mapped(next, columns) for _ in node["phase"])


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
    def of(first: Decimal, step: Decimal, rows: int) -> Steps:
        """Return a sweep's decimals in whole numbers of their last digit."""
        scale = math.lcm(Fraction(first).denominator, Fraction(step).denominator)
        return Steps(int(Fraction(first) * scale), int(Fraction(step) * scale), scale, rows)

    def degrees(self, start: int, stop: int) -> Leaf:
        """Return rows in degrees, each rounded once."""
        return np.array([at / self.scale for at in self._counts(start, stop)])

    def radians(self, start: int, stop: int) -> Leaf:
        """Return rows in radians, as `units.angle` reads them: by the float π, rounded once."""
        counts, last = self._counts(start, stop), self.first + self.step * self.rows
        if max(abs(self.first), abs(last), self.scale) < _WHOLE:
            above, below = (Fraction(math.pi) / (180 * self.scale)).as_integer_ratio()
            return np.array([above * at / below for at in counts])
        return np.array([units.angle(f"{value!r} deg") for value in self.degrees(start, stop).tolist()])

    def _counts(self, start: int, stop: int) -> range:
        return range(self.first + self.step * start, self.first + self.step * stop, self.step)


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
