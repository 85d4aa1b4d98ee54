"""An atlas of coupler curves: many linkages from one seed, each curve at points equally far along it.

It is made once in a process, in about a second, and is the same every time. Only one closure is in it: the
other one's curves are its mirror images.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from linkanim.synthesis.kinds import Complex, LinkageKind, Real

CURVES = 20_000
POINTS = 64
"""Along each curve."""
_POSES = 96
"""At equal crank angles, from which the points are found."""
_AT_ONCE = 2_000
"""Curves, so that memory does not grow with the atlas beyond what it holds."""
_SEED = 25
_WORST = math.radians(4)
"""The least transmission angle of a linkage in the atlas."""


class Atlas(NamedTuple):
    """Linkages (J, p) of one kind and closure +1, their curves, and at which crank angles their points are.

    Curves are centred and have a mean square of 1 / POINTS: `centre` and `scale` take them back.
    """

    kind: LinkageKind
    rows: Real
    angles: Real
    shape: Complex
    spectrum: Complex
    centre: Complex
    scale: Real

    def first(self, count: int) -> Atlas:
        """Return the first so many of its curves."""
        parts: list[Any] = [part[:count] for part in self[1:]]
        return Atlas(self.kind, *parts)


@lru_cache(maxsize=4)
def atlas(kind: LinkageKind, count: int = CURVES) -> Atlas:
    """Return the atlas of a kind, made when it is first needed."""
    rows = _sampled(kind, count)
    parts = [_along(kind, rows[first : first + _AT_ONCE], first) for first in range(0, len(rows), _AT_ONCE)]
    angles, points = (np.concatenate(part) for part in zip(*parts, strict=True))
    centre = points.mean(axis=1)
    shape = points - centre[:, None]
    scale = np.sqrt((np.abs(shape) ** 2).sum(axis=1))
    shape = (shape / scale[:, None]).astype(np.complex64)
    return Atlas(kind, rows, angles, shape, np.fft.fft(shape, axis=1), centre, scale)


def _sampled(kind: LinkageKind, count: int) -> Real:
    """Return linkages whose crank turns fully, the first so many of a row of random ones."""
    random = np.random.default_rng(_SEED)
    found: list[Real] = []
    while sum(map(len, found)) < count:
        rows = kind.random_rows(random, 2 * count)
        found.append(rows[(kind.slack(rows, _WORST) > 0).all(axis=1)])
    return np.concatenate(found)[:count]


def _along(kind: LinkageKind, rows: Real, first: int) -> tuple[Real, Complex]:
    """Return crank angles (J, POINTS) at equal distances along each closed curve, and the points there.

    `first` is the number of the first of these linkages in the atlas.
    """
    turn = np.linspace(0, 2 * math.pi, _POSES + 1)
    closure = np.ones(len(rows))
    points = kind.points(rows, closure, np.broadcast_to(turn, (len(rows), len(turn))))
    length = np.zeros((len(rows), len(turn)))
    np.cumsum(np.abs(np.diff(points, axis=1)), axis=1, out=length[:, 1:])
    # One search for all rows: each has its lengths between 2j and 2j + 1.
    length /= length[:, -1:]
    own = 2.0 * np.arange(first, first + len(rows))[:, None]
    places = np.arange(POINTS) / POINTS
    flat, sought = (length + own).ravel(), (places + own).ravel()
    angles = np.interp(sought, flat, np.tile(turn, len(rows))).reshape(len(rows), POINTS)
    after = np.clip(np.searchsorted(flat, sought, side="right"), 1, len(flat) - 1)
    share = (sought - flat[after - 1]) / np.maximum(flat[after] - flat[after - 1], 1e-300)
    ravelled = points.ravel()
    between = ravelled[after - 1] + share * (ravelled[after] - ravelled[after - 1])
    return angles, between.reshape(len(rows), POINTS)
