"""`python tests/bench/path_answers.py [SECONDS]` measures `linkanim path` and prints the manual's table.

It is asked for random coupler curves, published problems, and shapes that no four-bar traces.

For the shapes it is compared with a global search in a given time: scipy's differential evolution over the
same parameters, in which each point is assigned to one of 240 places of the curve, in their order.
Published figures are sums of squared distances: the eighteen points are those of Kunjur and Krishnamurty
(1997), with the crank's steps of 20°.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench.result import this_machine
from linkanim.export import markdown
from linkanim.synthesis.curves import drawn
from linkanim.synthesis.linkages import FOUR_BAR, Complex, Real
from linkanim.synthesis.path import path

CURVES = 200
TITLES = ("problem", "measure", "linkanim", "beside it", "seconds")
EIGHTEEN = (
    0.5 + 1.1j, 0.4 + 1.1j, 0.3 + 1.1j, 0.2 + 1.0j, 0.1 + 0.9j, 0.05 + 0.75j, 0.02 + 0.6j, 0.5j, 0.4j,
    0.03 + 0.3j, 0.1 + 0.25j, 0.15 + 0.2j, 0.2 + 0.3j, 0.3 + 0.4j, 0.4 + 0.5j, 0.5 + 0.7j, 0.6 + 0.9j,
    0.6 + 1j,
)  # fmt: skip
LINE = tuple(complex(20, 20 + 5 * step) for step in range(6))
_SEED = 7
_SAMPLES = 240
_BOUNDS = [(-4, 4)] * 2 + [(0.01, 4), (0.01, 8), (-8, 8), (-8, 8)] + [(-4, 4)] * 2 + [(0.01, 8), (-1, 1)]
"""The bounds of the search, in curve sizes: the four-bar's parameters, and the closure's sign."""


class PathRow(NamedTuple):
    """A problem, the measure, our figure, the one that it is compared with, and our processor time."""

    problem: str
    measure: str
    here: str
    beside: str
    seconds: float


def run(seconds: float, curves: int) -> list[PathRow]:
    """Measure all problems, with `seconds` of processor time for the global search of each shape."""
    path(LINE, count=1)  # the atlas is made
    jobs: list[Callable[[], PathRow]] = [
        lambda: _random(curves),
        lambda: _published("18 points, steps of 20°", EIGHTEEN, 9.115e-3, timing=math.radians(20)),
        lambda: _published("6 points of a line", LINE, 9e-28),
        *((lambda name=name: _shape(name, seconds)) for name in SHAPES),
    ]
    return [job() for job in jobs]


def _timed(points: Any, **options: Any) -> tuple[Any, float]:
    start = time.process_time()
    return path(points, prefer="exact", **options), time.process_time() - start


def _random(count: int) -> PathRow:
    """Measure how well random coupler curves of crank-rockers and drag-links are found, 64 points each."""
    random = np.random.default_rng(_SEED)
    rows = FOUR_BAR.random_rows(random, 40 * count)
    rows = rows[(FOUR_BAR.margins(rows, math.radians(1)) > 0).all(axis=1)][:count]
    angles = np.tile(2 * math.pi * np.arange(64) / 64, (len(rows), 1))
    found = [_timed(points, count=1) for points in FOUR_BAR.points(rows, np.ones(len(rows)), angles)]
    errors = np.array([100 * fits[0].rms / fits[0].task.curve.size for fits, _ in found])
    good = f"{np.mean(errors <= 0.01):.1%} to 0.01 %"
    here = f"median {np.median(errors):.0e} %, {good}, worst {errors.max():.2g} %"
    seconds = float(np.mean([spent for _, spent in found]))
    return PathRow(f"{count} random coupler curves", "rms in % of the diagonal", here, "", seconds)


def _published(name: str, points: tuple[complex, ...], best: float, **options: Any) -> PathRow:
    fits, seconds = _timed(points, **options)
    least = min(fit.rms**2 * len(points) for fit in fits)
    return PathRow(name, "sum of squares", f"{least:.4g}", f"published: {best:.4g}", seconds)


def _shape(name: str, seconds: float) -> PathRow:
    points = SHAPES[name]
    fits, spent = _timed(points)
    found = min(100 * fit.rms / fit.task.curve.size for fit in fits)
    beside = f"global search, {seconds:g} s: {100 * global_search(points, seconds):.2f} %"
    return PathRow(name, "rms in % of the diagonal", f"{found:.2f} %", beside, spent)


def global_search(points: Complex, seconds: float) -> float:
    """Return the least root mean square, in curve sizes, of differential evolution for so many seconds."""
    from scipy.optimize import differential_evolution

    curve, end = drawn(points, closed=True), time.process_time() + seconds
    sought = (curve.points - curve.centre) / curve.size
    best = math.inf
    seed = 0
    while time.process_time() < end:
        found = differential_evolution(
            lambda columns: _off(columns.T, sought),
            _BOUNDS,
            vectorized=True,
            updating="deferred",
            maxiter=3000,
            polish=False,
            rng=seed,
            callback=lambda *_, **__: time.process_time() > end,
        )
        best, seed = min(best, float(found.fun)), seed + 1
    return best


def _off(rows: Real, sought: Complex) -> Real:
    """Return each linkage's root mean square distance, beyond 10 where its crank does not turn fully."""
    margins = FOUR_BAR.margins(rows[:, :9], 0.0).min(axis=1)
    turning = np.flatnonzero(margins > 0)
    off = 10.0 - np.minimum(margins, 0.0)
    if len(turning):
        angles = np.tile(np.linspace(0, 2 * math.pi, _SAMPLES, endpoint=False), (len(turning), 1))
        closure = np.where(rows[turning, 9] > 0, 1.0, -1.0)
        way = FOUR_BAR.points(rows[turning, :9], closure, angles)
        off[turning] = np.sqrt(_in_order(np.abs(way[:, :, None] - sought) ** 2) / len(sought))
    return np.asarray(off)


def _in_order(squares: Real) -> Real:
    """Return the least sums of squared distances (B, places, points) with the places in the points' order.

    The places go once round the curve, in either sense, from the one that is nearest to the first point.
    """
    sums = np.full(len(squares), np.inf)
    for way in (squares, squares[:, ::-1]):
        begin = way[:, :, 0].argmin(axis=1)
        turned = (begin[:, None] + np.arange(way.shape[1])) % way.shape[1]
        least = np.take_along_axis(way[:, :, 0], turned[:, :1], axis=1)
        for point in range(1, way.shape[2]):
            here = np.take_along_axis(way[:, :, point], turned, axis=1)
            least = np.minimum.accumulate(least + here, axis=1)
        sums = np.minimum(sums, least[:, -1])
    return sums


def _outline(*corners: complex, count: int) -> Complex:
    """Return evenly spaced points along a polygon."""
    return drawn(corners, closed=True).at(np.arange(count) / count)


def _by_hand(count: int) -> Complex:
    """Return a loop as a hand draws it: smooth, and a little unsteady."""
    turn = 2 * math.pi * np.arange(count) / count
    radius = 3 + 0.6 * np.cos(2 * turn + 1) + 0.4 * np.sin(3 * turn) + 0.02 * np.sin(17 * turn)
    return np.asarray(radius * np.exp(1j * turn) * (1 + 0.5j * np.sin(turn)))


SHAPES: dict[str, Complex] = {
    "square": _outline(0, 1, 1 + 1j, 1j, count=80),
    "star": _outline(*((1 - 0.55 * (k % 2)) * 1j ** (1 + 0.4 * k) for k in range(10)), count=100),
    "letter L": _outline(0, 6, 6 + 2j, 2 + 2j, 2 + 9j, 9j, count=90),
    "loop by hand": _by_hand(90),
}


def as_markdown(rows: list[PathRow], machine: str) -> str:
    """Return the table for the manual, and where it was measured."""
    table = markdown([TITLES, *_cells(rows)])
    return f"{table}\n\nSeconds of processor time, the atlas apart. Measured on {machine}.\n"


def _cells(rows: list[PathRow]) -> Iterator[tuple[str, ...]]:
    return ((*row[:4], f"{row.seconds:.2f}") for row in rows)


if __name__ == "__main__":
    print(as_markdown(run(float([*sys.argv, "600"][1]), CURVES), this_machine().line))
