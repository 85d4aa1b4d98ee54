"""Everything that is known at each solved angle, as one tree that JSON, CSV and the tables read.

The tree is that of `solve --json`; its leaves are arrays (N,), a value for each angle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.motion import Motion, Strut
from linkanim.scenes.scene import Scene

Leaf = NDArray[np.float64]
Tree = dict[str, Any]

BLOCK = 4096
"""Rows that are turned into Python's own numbers at a time, so that a long sweep stays small."""


def tree(scene: Scene, motion: Motion) -> Tree:
    """Return joints, bodies, springs and dampers of N poses, in the scene's unit, radians and seconds."""
    linkage = scene.linkage
    return {
        "joints": {joint.name: _point(motion, joint.name) for joint in linkage.joints},
        "bodies": {
            body.name: _slider(motion, body.name) if body.slider else _body(motion, body.name)
            for body in linkage.bodies
        },
        "springs": {spring.name: _element(motion.spring[spring.name]) for spring in linkage.springs},
        "dampers": {damper.name: _element(motion.damper[damper.name]) for damper in linkage.dampers},
    }


def _point(motion: Motion, joint: str) -> Tree:
    return {
        "position": _xy(motion.position[joint]),
        "velocity": _xy(motion.velocity[joint]),
        "acceleration": _xy(motion.acceleration[joint]),
    }


def _body(motion: Motion, body: str) -> Tree:
    turning = {
        "angle": motion.angle[body],
        "angular_velocity": motion.angular_velocity[body],
        "angular_acceleration": motion.angular_acceleration[body],
        "coefficients": list(motion.coefficient[body]),
    }
    if body not in motion.com_position:
        return turning
    com = {
        "position": _xy(motion.com_position[body]),
        "velocity": _xy(motion.com_velocity[body]),
        "acceleration": _xy(motion.com_acceleration[body]),
    }
    return {**turning, "com": com}


def _slider(motion: Motion, body: str) -> Tree:
    return {
        "travel": motion.travel[body],
        "velocity": motion.travel_velocity[body],
        "acceleration": motion.travel_acceleration[body],
        "coefficients": list(motion.coefficient[body]),
    }


def _element(element: Strut) -> Tree:
    force = np.full(np.shape(element.length), np.nan) if element.force is None else element.force
    return {"length": element.length, "rate": element.rate, "force": force}


def _xy(points: Leaf) -> list[Leaf]:
    return [points[..., 0], points[..., 1]]


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


def rows(node: Tree, count: int) -> Iterator[Tree]:
    """Yield the tree of each row, its leaves plain floats."""
    for start in range(0, count, BLOCK):
        block = _block(node, slice(start, start + BLOCK))
        yield from (_row(block, row) for row in range(min(BLOCK, count - start)))


def _block(node: Tree, part: slice) -> Tree:
    # a tuple is a leaf; a list would be a pair
    return mapped(lambda leaf: tuple(leaf[part].tolist()), node)  # type: ignore[no-any-return]


def _row(block: Tree, row: int) -> Tree:
    return mapped(lambda leaf: leaf[row], block)  # type: ignore[no-any-return]
