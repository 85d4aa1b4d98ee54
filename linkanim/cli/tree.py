"""Everything that is known at each solved angle, as one tree that JSON, CSV and the tables read.

The tree is that of `solve --json`; its leaves are arrays (N,), a value for each angle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.facts.register import Path, recorded
from linkanim.mechanics.motion.motion import Motion
from linkanim.scenes.scene import Scene

Leaf = NDArray[np.float64]
Tree = dict[str, Any]


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


def mapped(change: Callable[[Any], Any], node: Any) -> Any:
    """Return the tree with every leaf changed."""
    if isinstance(node, Mapping):
        return {key: mapped(change, part) for key, part in node.items()}
    if isinstance(node, list):
        return [mapped(change, part) for part in node]
    return change(node)


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
    plain = mapped(lambda leaf: tuple(leaf.tolist()) if isinstance(leaf, np.ndarray) else leaf, node)
    yield from (_row(plain, row) for row in range(len(plain["phase"])))


def _row(plain: Tree, row: int) -> Tree:
    # a tuple is a column; a list is a pair
    return mapped(lambda leaf: leaf[row] if isinstance(leaf, tuple) else leaf, plain)  # type: ignore[no-any-return]
