"""Find all closures of links that are solved together, in the pose at which their input stands.

Newton's method is started from many poses put down at random, always the same ones; each solution that it
comes to is told once. The more starts have come to each of them, the surer it is that there is no other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.program import Array
from linkanim.mechanics.solver import courses
from linkanim.mechanics.solver.following import LinkEquations, system_of
from linkanim.mechanics.tolerances import BESIDE_A_LIMIT, ONE_CLOSURE, SOLVED

STARTS, _ROUNDS, _REACH = 3000, 40, 2.0
"""How many poses Newton's method starts from, and for how long; how far they reach, in lengths of links."""


def travel_range(linkage: Linkage) -> tuple[float, float]:
    """Return how far the length that drives a group can go; AssemblyError where nothing stops it."""
    return courses.travel_range(linkage.near)


def group_closures(linkage: Linkage) -> list[dict[str, complex]]:
    """Return where the joints of a group are in each of its closures, its own first; [] without a group."""
    if group_of(linkage) is None:
        return []
    system = system_of(linkage.near)
    closures: list[Array] = []
    for one in (system.start, *_solved(system)):
        if not any(
            np.abs(_pose_numbers(system, one) - _pose_numbers(system, other)).max() < ONE_CLOSURE
            for other in closures
        ):
            closures.append(one)
    return [_places(linkage, system, one) for one in closures]


def _pose_numbers(system: LinkEquations, y: Array) -> NDArray[np.complex128]:
    """Return the places of links, and their directions, whole turns left out."""
    count = 3 * system.links
    return np.concatenate([y[0:count:3], y[1:count:3], np.exp(1j * y[2:count:3])])


def _solved(system: LinkEquations) -> Array:
    """Return the solutions that Newton's method comes to from random poses, (N, m)."""
    chance = np.random.default_rng(0)
    y = np.tile(system.start, (STARTS, 1))
    spread = np.ptp(np.abs(system.start[: 3 * system.links])) + _REACH
    for n in range(system.links):
        y[:, 3 * n : 3 * n + 2] += chance.uniform(-spread, spread, (STARTS, 2))
        y[:, 3 * n + 2] += chance.uniform(-np.pi, np.pi, STARTS)
    slides = slice(3 * system.links, system.size - 1)
    y[:, slides] += chance.uniform(-spread, spread, (STARTS, len(system.slots)))
    open_ = np.ones(len(y), dtype=bool)
    for _ in range(_ROUNDS):
        at = y[open_]
        step = _step(system, at)
        y[open_, :-1] -= step
        far = np.abs(step).max(axis=1)
        still = np.flatnonzero(open_)
        open_[still[~(far > SOLVED)]] = False
        if not open_.any():
            break
    error = np.abs(system.residual(y)).max(axis=1)
    good = (error < 1e2 * SOLVED) & (np.abs(y).max(axis=1) < 1e3)
    return np.asarray(y[good])


def _step(system: LinkEquations, y: Array) -> Array:
    """Return Newton's steps (N, m - 1), of a turn at the most a radian; none where they are not known."""
    matrix, right = system.jacobian(y)[:, :, :-1], system.residual(y)
    normal = np.einsum("nij,nik->njk", matrix, matrix) + BESIDE_A_LIMIT * np.eye(matrix.shape[2])
    try:
        step = np.linalg.solve(matrix, right[..., None])[..., 0]
    except np.linalg.LinAlgError:
        step = np.linalg.solve(normal, np.einsum("nij,ni->nj", matrix, right)[..., None])[..., 0]
    largest = np.abs(step).max(axis=1, keepdims=True)
    return np.asarray(np.nan_to_num(step / np.maximum(largest, 1.0)))


def _places(linkage: Linkage, system: LinkEquations, y: Array) -> dict[str, complex]:
    """Return the places of all joints of the system's links, in the linkage's unit."""
    x, left = linkage.origin
    places: dict[str, complex] = {}
    for n, frame in enumerate(system.frames):
        origin, turn = complex(y[3 * n], y[3 * n + 1]), np.exp(1j * y[3 * n + 2])
        for name in frame.points:
            places.setdefault(
                name, complex(origin + frame.at(name) * turn) / system.shrunk + complex(x, left)
            )
    return places
