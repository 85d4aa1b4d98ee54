"""Directions and lengths for outlines, out of + - × ÷, rint and square roots: the same on every machine.

The C library and numpy's vector units differ from machine to machine in the last digit of a sine or of
an arctangent. What shapes are made of comes from here. Arctangents and arc cosines only say where an arc
begins and ends or how a tooth's flank bends, and exponentials where a label rests; such a digit is a
1e-13th of a pixel, and corners are rounded to 1/1024 of one before anything is painted.
"""

from __future__ import annotations

from functools import lru_cache
from math import pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.mechanics.formulas.circular import PI_PARTS, tangent

Directions = NDArray[np.complex128]

_GRAIN = float(1 << 24)
"""Steps to a radian that directions are rounded to."""


def directions(angles: ArrayLike) -> Directions:
    """Return cos + i sin of angles in radians, by the formulas of the poses (`mechanics.circular`)."""
    angle = np.asarray(angles, np.float64)
    quarters = np.rint(angle * (2 / pi))
    first, second, third, fourth = (0.5 * part for part in PI_PARTS)
    rest: Any = ((angle - quarters * first) - quarters * second) - quarters * (third + fourth)
    half: Any = tangent(rest, 2.0)
    norm = half * half + 4.0
    turned = np.empty(angle.shape, np.complex128)
    turned.real, turned.imag = (4.0 - half * half) / norm, 4.0 * half / norm
    found: Directions = turned * np.array([1, 1j, -1, -1j])[quarters.astype(np.int64) & 3]
    return found


def folded(turn: complex, fold: int) -> complex:
    """Return the direction nearest to 1 in which looks alike what does so `fold` (3 or more) times a turn.

    It is rounded to a step far below what shows, so that a direction that comes again after some such
    parts of a turn is found again to the last digit.
    """
    nearest = max((turn * way for way in _ways(fold)), key=lambda way: way.real)
    side = round(nearest.imag * _GRAIN) / _GRAIN
    return complex(sqrt(1.0 - side * side), side)


@lru_cache(maxsize=64)
def _ways(fold: int) -> tuple[complex, ...]:
    ways: list[complex] = directions(2 * pi / fold * np.arange(fold)).tolist()
    return tuple(ways)


def lengths(vectors: Directions) -> NDArray[np.float64]:
    """Return the lengths of vectors x + yi."""
    found: NDArray[np.float64] = np.sqrt(vectors.real * vectors.real + vectors.imag * vectors.imag)
    return found


def length(vector: complex) -> float:
    """Return the length of one vector."""
    return sqrt(vector.real * vector.real + vector.imag * vector.imag)
