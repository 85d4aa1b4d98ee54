"""Scenes of each kind of synthesis, made once: for what draws and explains them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache

import pytest

import linkanim
from linkanim.scenes.scene import Scene

DEGREE = math.pi / 180
POSES = [(0, 0, 0), (40, 10, 35), (70, -5, 80), (90, -40, 120), (95, -70, 150)]


def _guided(count: int, kind: str = "four-bar") -> Scene:
    rows = [(x, y, angle * DEGREE) for x, y, angle in POSES[:count]]
    return linkanim.guide(rows, kind=kind, count=1, largest=20)[0].scene


def _generated(text: str, first: float, last: float, points: int, kind: str = "four-bar") -> Scene:
    wide = 80.0 if kind == "slider-crank" else 60 * DEGREE
    found = linkanim.function(
        text, first, last, kind=kind, points=points, input_range=60 * DEGREE, output_range=wide, count=1
    )
    return found[0].scene


MADE: Mapping[str, Callable[[], Scene]] = {
    **{f"guide-{count}": cache(lambda count=count: _guided(count)) for count in (2, 3, 4, 5)},
    "guide-slider-2": cache(lambda: _guided(2, "slider-crank")),
    "guide-slider-3": cache(lambda: _guided(3, "slider-crank")),
    "function-3": cache(lambda: _generated("y = log10(x)", 1, 2, 3)),
    "function-5": cache(lambda: _generated("y = log10(x)", 1, 2, 5)),
    "function-slider": cache(lambda: _generated("y = x^2", 0, 1, 3, "slider-crank")),
    "stroke": cache(lambda: linkanim.quick_return(stroke=80, ratio=1.4, count=1)[0].scene),
    "stroke-even": cache(lambda: linkanim.quick_return(stroke=80, ratio=1, count=1)[0].scene),
    "swing": cache(lambda: linkanim.quick_return(swing=60 * DEGREE, ratio=1.25, count=1)[0].scene),
    "swing-even": cache(lambda: linkanim.quick_return(swing=45 * DEGREE, ratio=1, count=1)[0].scene),
}
"""Scenes by what they were made for."""
_USUAL = ("guide-3", "function-3", "stroke")
FEW = [*_USUAL, *(pytest.param(name, marks=pytest.mark.long) for name in MADE if name not in _USUAL)]
"""Their names; what is not usual is looked at in a long run."""
