"""06  An optimisation with scipy over linkanim.load(...).solve.

Which coupler point of a four-bar runs straightest over half a turn of the crank? The point's two
coordinates are free; what is minimised is its deviation from a straight line.
"""

import math
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

import linkanim

TEMPLATE = """
length_unit = "mm"

[four-bar]
ground  = 200
crank   = 100
coupler = 250
rocker  = 250
coupler_point = [{x!r}, {y!r}]

[trace]
joints = ["P"]
"""
ANGLES = np.linspace(math.pi / 2, 3 * math.pi / 2, 90)


def points(place):
    """Return where the coupler point is over half a turn."""
    x, y = map(float, place)
    Path("straight.toml").write_text(TEMPLATE.format(x=x, y=y), encoding="utf-8")
    return linkanim.load("straight.toml").solve(angle=ANGLES, derivatives=0).position["P"]


def deviation(place):
    """Return how far the path is from straight: its width over its length."""
    path = points(place)
    _, sizes, _ = np.linalg.svd(path - path.mean(axis=0))
    return sizes[1] / sizes[0]


found = minimize(deviation, x0=[450.0, 40.0], method="Nelder-Mead", options={"xatol": 1e-3, "fatol": 1e-9})
points(found.x)  # the scene file holds the answer
print(f"coupler point {found.x[0]:.2f}, {found.x[1]:.2f} mm: {found.fun:.2e} (Hoecken's is 500, 0)")
