"""Random linkages from a seed, and points of their coupler curves."""

from __future__ import annotations

import math

import numpy as np

from linkanim.synthesis.linkages import KINDS, Complex, Real


def linkages(kind: str, count: int, seed: int) -> Real:
    """Return parameters of linkages whose crank turns fully, a degree away from a change point."""
    chosen, random = KINDS[kind], np.random.default_rng(seed)
    rows = chosen.random_rows(random, 40 * count)
    return rows[(chosen.margins(rows, math.radians(1)) > 0).all(axis=1)][:count]


def curves(kind: str, count: int, seed: int, *, points: int = 64, turn: float = 1.0) -> list[Complex]:
    """Return so many points of each coupler curve over a share of a turn, at a place and size of its own."""
    rows, random = linkages(kind, count, seed), np.random.default_rng(seed + 1)
    found = []
    for number, row in enumerate(rows):
        first, size, way = random.uniform(0, 2 * math.pi), 10 ** random.uniform(-1, 3), (-1.0) ** number
        angles = first + way * 2 * math.pi * turn * np.arange(points) / points
        closure = np.array([random.choice([-1.0, 1.0])])
        place = complex(*random.normal(size=2)) * size
        turned = size * np.exp(1j * random.uniform(0, 2 * math.pi))
        found.append(KINDS[kind].points(row[None], closure, angles[None])[0] * turned + place)
    return found
