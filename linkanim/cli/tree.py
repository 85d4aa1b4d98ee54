"""Everything that is known at each solved angle, as one tree that JSON, CSV and the tables read.

The tree is that of `solve --json`; its leaves are arrays (N,), a value for each angle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.columns import components
from linkanim.mechanics.linkage import Body, Linkage
from linkanim.mechanics.measures import CENTRE, DAMPER, POINT, SPRING, Measure, measures_of
from linkanim.mechanics.motion import Motion
from linkanim.scenes.scene import Scene

Leaf = NDArray[np.float64]
Tree = dict[str, Any]


def input_key(scene: Scene) -> str:
    """Return under which key the tree has the input: its angle, or the travel of a slider that drives."""
    return "travel" if scene.linkage.slides else "angle"


def tree(scene: Scene, motion: Motion) -> Tree:
    """Return joints, bodies, springs and dampers of N poses, in the scene's unit, radians and seconds."""
    linkage = scene.linkage
    return {
        "joints": {joint.name: _known(POINT, motion, joint.name) for joint in linkage.joints},
        "bodies": {body.name: _body(linkage, motion, body) for body in linkage.bodies},
        "springs": {item.name: _known(SPRING, motion, item.name) for item in linkage.springs},
        "dampers": {item.name: _known(DAMPER, motion, item.name) for item in linkage.dampers},
    }


def _body(linkage: Linkage, motion: Motion, body: Body) -> Tree:
    own, slopes = measures_of(linkage, body)
    known = _known(own, motion, body.name)
    known["coefficients"] = [measure.read(motion, body.name) for measure in slopes]
    return {**known, "com": _known(CENTRE, motion, body.name)} if body.com else known


def _known(measures: Iterable[Measure], motion: Motion, part: str) -> Tree:
    return {measure.key: _leaf(measure.read(motion, part), motion) for measure in measures}


def _leaf(found: Any, motion: Motion) -> Leaf | list[Leaf]:
    """Return a vector as [x, y], and NaN at every instant for what is not known (None)."""
    if found is None:
        return np.full(np.shape(motion.phase), np.nan)
    return list(components(found)) if np.ndim(found) > np.ndim(motion.phase) else found


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
