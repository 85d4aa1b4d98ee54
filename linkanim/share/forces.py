"""The forces of a scene over a period, as arrows of a page.

The page has no solver of forces: each arrow is a table, for the motion at the page's speed forth and back.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.look import FORCE
from linkanim.picture.motion_marks import Arrows, arrows_of, pulls
from linkanim.picture.picture import Picture
from linkanim.picture.quantities import unbounded_places
from linkanim.share.movers import Mover, Pairs, packed, shares_of
from linkanim.share.tables import table
from linkanim.words import said

_NEAR = 5e-4
"""The share of a force's greatest value by which its table may be off."""
_STEPS = 32_000
"""Steps of a table's entries from 0 to its greatest one."""


def forces(light: Picture, dark: Picture, speed: float, pairs: Pairs) -> Mover | None:
    """Return the data of the arrows of forces at an input speed; None where the scene has none.

    `values` are tables of x and y of each arrow, in steps of `grain` (N), forth and back; they are told once
    where both are alike.
    """
    scene, cycle = light.scene, light.figure.cycle
    if not scene.linkage.reacting:
        return None
    arrows, other = (arrows_of(one.figure, FORCE, one.size[1], one.gauge, one.theme) for one in (light, dark))
    pulls_there = [*pulls(scene.solve(phase=cycle.phase, speed=speed))]
    every = [np.broadcast_to(one.value, (len(cycle.phase), 2)) for one in pulls_there]
    most = [_greatest(arrows, speed, value) for value in every]

    def read(phases: NDArray[np.float64]) -> NDArray[np.float64]:
        both = (scene.solve(phase=phases, speed=way * speed) for way in (1, -1))
        parts = [zip(pulls(motion), most, strict=True) for motion in both]
        rows = [np.broadcast_to(one.value, (len(phases), 2)).T / size for part in parts for one, size in part]
        return np.concatenate(rows)

    columns = [column for value in every for column in value.T]
    unbounded = {place for column in columns for place in unbounded_places(cycle.phase, column).tolist()}
    held = table(scene, (0.0, scene.period), read, sorted(unbounded), _NEAR)
    ways = held.values.reshape(2, len(pulls_there), 2, -1)
    top = np.nanmax(np.abs(ways), axis=(0, 2, 3), initial=0.0) + np.finfo(float).tiny
    steps = ways / top[:, None, None] * _STEPS
    alike = np.allclose(ways[0], ways[1], rtol=0.0, atol=_NEAR, equal_nan=True)
    starts = [one.place for one in pulls(scene.pose(0.0))]
    words = said(arrows.words)
    shown = {
        "words": said("{arrows} as at rest", arrows=words) if scene.linkage.static else words,
        "unit": arrows.unit,
        "per": arrows.scale(speed),
        "line": arrows.gauge.line,
    }
    return {
        "kind": "arrows",
        "order": 0,
        "at": [
            one.joint or shares_of(light, one.body, at) for one, at in zip(pulls_there, starts, strict=True)
        ],
        "usual": len(pulls_there),
        "symbols": [one.symbol for one in pulls_there],
        **shown,
        "longest": arrows.longest,
        "drawn": arrows.longest_drawn,
        "colours": pairs.variables((arrows.colour, arrows.halo), (other.colour, other.halo)),
        "grain": (np.array(most) * top / _STEPS).tolist(),
        "values": [_packed(way) for way in (steps[:1] if alike else steps)],
        **held.data,
    }


def _greatest(arrows: Arrows, speed: float, value: NDArray[np.float64]) -> float:
    """Return the greatest size of a force that is drawn, 1 N where it is none."""
    size = np.hypot(*value.T)
    drawn = size[size * arrows.scale(speed) <= arrows.longest_drawn]
    return float(drawn.max(initial=0.0)) or 1.0


def _packed(steps: NDArray[np.float64]) -> str:
    """Return whole steps in 16 bits; one that is not known is below all others."""
    return packed(np.where(np.isfinite(steps), np.rint(steps), -(1 << 15)), "<i2")
