"""Fit many candidates to a drawn curve at once, within the requested limits.

Its parts, in reading order:

- The task: a drawn curve, a kind of linkage, the crank angles at the points if they are given, and limits.
- Least squares over many candidates at once: Levenberg and Marquardt's steps, each point's crank angle free.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.synthesis.atlas import Candidates
from linkanim.synthesis.curves import DrawnCurve
from linkanim.synthesis.linkages import Indices, LinkageKind, Real, Requirements, TracedPoints

# The task: a drawn curve, a kind of linkage, the crank angles at the points if they are given, and limits.

FEW = 12
"""The largest number of points that say nothing about the path between them."""
EXACTLY = 1e10
"""The weight of a point that is to be passed exactly; another point has about 1."""


@frozen(eq=False)
class PathTask:
    """A curve in its unit, its points' weights, and the kind, timing and limits of its linkages.

    `timing` is None where crank angles are free, else the crank's angle at each point; with `free_start` all
    of those may be shifted by one angle.
    """

    curve: DrawnCurve
    kind: LinkageKind
    requirements: Requirements
    weights: Real
    timing: Real | None = None
    free_start: bool = True
    unit: str = "mm"
    name: str = "path"
    source: str = "a drawn path"

    @cached_property
    def normal(self) -> DrawnCurve:
        """The curve about the origin, its size 1."""
        return DrawnCurve((self.curve.points - self.curve.centre) / self.curve.size, self.curve.closed)

    def thinned(self, count: int) -> Indices:
        """Return the indices of about `count` evenly spaced points, and of those to be passed exactly."""
        return np.union1d(self.normal.thinned(count), np.flatnonzero(self.weights >= EXACTLY))

    @property
    def is_dense(self) -> bool:
        """Whether the points say where the curve goes between them."""
        return self.timing is None and len(self.curve.points) > FEW

    def among(self, chosen: Indices) -> PathTask:
        """Return the task for the chosen points."""
        curve = DrawnCurve(self.curve.points[chosen], self.curve.closed)
        timing = None if self.timing is None else self.timing[chosen]
        return replace(self, curve=curve, weights=self.weights[chosen], timing=timing)

    def problem(self, chosen: Indices) -> PathTask:
        """Return the task for the chosen points, at size 1 about the origin."""
        return replace(
            self.among(chosen),
            curve=DrawnCurve(self.normal.points[chosen], self.curve.closed),
            requirements=self.requirements.placed(self.curve.centre, self.curve.size),
        )

    def spread(self, angles: Real, turn: Real, before: Indices, after: Indices) -> Real:
        """Return crank angles at the points `after`, interpolated from those (B, n) at the points `before`.

        `turn` (B, 1) is how far the crank turns along the whole of a closed curve.
        """
        if np.array_equal(before, after):
            return angles
        if self.timing is not None:
            return np.asarray(angles[:, :1] + (self.timing[after] - self.timing[before[0]]))
        places = self.normal.places[before]
        if self.curve.closed:
            places = np.append(places, places[0] + 1.0)
            angles = np.concatenate([angles, angles[:, :1] + turn], axis=1)
        there = [np.interp(self.normal.places[after], places, row) for row in angles]
        return np.array(there).reshape(len(angles), len(after))

    def scaled(self, candidates: Candidates) -> Candidates:
        """Return candidates of size 1 in the curve's own unit and place."""
        return self._placed(candidates, self.curve.size, self.curve.centre)

    def normalised(self, candidates: Candidates) -> Candidates:
        """Return candidates in the curve's unit at size 1 about the origin: `scaled` undone."""
        return self._placed(candidates, 1 / self.curve.size, -self.curve.centre / self.curve.size)

    def _placed(self, candidates: Candidates, scale: float, shift: complex) -> Candidates:
        ones = np.ones(len(candidates.rows), np.complex128)
        return candidates._replace(rows=self.kind.placed(candidates.rows, scale * ones, shift * ones))

    def swinging(self) -> PathTask:
        """Return the same task, the crank free to swing."""
        return replace(self, requirements=replace(self.requirements, full_turn=False))

    @property
    def quantum(self) -> int:
        """The number of decimals of written lengths, which is that of 1e-12 of the curve's size."""
        return 12 - math.floor(math.log10(self.curve.size))


# Least squares over many candidates at once: Levenberg and Marquardt's steps, each point's crank angle free.
#
# A point counts by its distance to the curve, orthogonal distance regression: the crank's angle at a point
# is eliminated by projecting on the curve's normal there (Boggs, Byrd and Schnabel), and is updated after
# each step. With prescribed timing both components count. A limit that a step would break is an equation in
# it.

_FIRST_DAMPING, _LEAST_DAMPING = 1e-3, 1e-15
_STANDING, _PATIENCE, _EXACT = 1e-6, 12, 1e-31
"""When to stop: after so many steps in a row that gain less than a share of the merit, or at this merit."""
_NEARER = 0.1
"""The share of a limit's margin that is left by a step that would break the limit otherwise."""
_OF_GAP = 0.45
"""The longest step of a crank angle, as a share of the gap to its neighbour, so that the order is kept."""
_BROKEN = 1e3
"""The weight of a limit that is broken by one curve size; a point that is as far off has 1."""
_DIFFERENCE = 1e-7


class _State(NamedTuple):
    """Candidates with their traced points, the margins of their limits, and their merit."""

    candidates: Candidates
    traced: TracedPoints
    margins: Real
    broken: Real
    cost: Real


def _merged(mine: Any, other: Any, where: NDArray[np.bool_]) -> Any:
    """Return a state, or a part of it, with the rows of another one where the mask is true."""
    if isinstance(mine, tuple):
        return type(mine)(*(_merged(*pair, where) for pair in zip(mine, other, strict=True)))
    return np.where(where.reshape(-1, *[1] * (mine.ndim - 1)), other, mine)


def refined(
    problem: PathTask, candidates: Candidates, steps: int, *, guarded: bool = True
) -> tuple[Candidates, Real]:
    """Return the candidates after at most `steps` steps, and the merit of each: its mean square error.

    The merit is infinite where a candidate cannot be closed. Broken limits are added to it, and, if
    `guarded`, how far the path strays between points; unguarded steps may pass through such paths to a
    good answer.
    """
    state = _state(problem, candidates, guarded=guarded)
    damping = np.full(len(state.cost), _FIRST_DAMPING)
    resting = np.zeros(len(state.cost))
    for _ in range(steps):
        trial = _state(problem, _stepped(problem, state, damping), guarded=guarded)
        better = trial.cost < state.cost
        slowly = ~(trial.cost < (1.0 - _STANDING) * state.cost)
        resting = np.where(slowly, resting + 1, 0)
        state = _merged(state, trial, better)
        if ((resting >= _PATIENCE) | (state.cost < _EXACT)).all():
            break
        damping = np.where(better, np.maximum(damping * 0.2, _LEAST_DAMPING), damping * 6)
    return state.candidates, state.cost


def merit(problem: PathTask, candidates: Candidates) -> Real:
    """Return each candidate's merit, with how far its path strays between points."""
    return _state(problem, candidates, guarded=True).cost


def _state(problem: PathTask, candidates: Candidates, *, guarded: bool) -> _State:
    with np.errstate(all="ignore"):
        traced = problem.kind.trace(candidates.rows, candidates.closure, candidates.angles)
        margins = problem.requirements.margins(problem.kind, candidates.rows)
        mask, values = problem.requirements.held(problem.kind)
        missing = (candidates.rows - values) * mask
        off = np.abs(problem.curve.points - traced.point) ** 2 * problem.weights
        between = _between(problem, candidates, traced) if guarded and problem.is_dense else 0.0
        turning = 2 if problem.requirements.full_turn else 0
        broken = np.minimum(margins[:, turning:], 0.0)
        cost = off.mean(axis=1) + between + _BROKEN * ((broken**2).sum(axis=1) + (missing**2).sum(axis=1))
        cost = np.where(np.isfinite(cost) & (margins[:, :turning] > 0).all(axis=1), cost, np.inf)
    return _State(candidates, traced, margins, missing, cost)


def _between(problem: PathTask, candidates: Candidates, traced: TracedPoints) -> Real:
    """Return the mean square of how far the curve strays halfway between points, beyond a usual distance.

    The usual distance is that to the next point, and how far the curve is off at the points themselves.
    """
    before = 0 if problem.curve.closed else 1
    points, angles, places = problem.curve.points, candidates.angles, traced.point
    last = angles[:, -1:] - 2 * np.pi * candidates.sense[:, None]
    angles = np.concatenate([last, angles], axis=1)[:, before:]
    points = np.append(points[-1], points)[before:]
    off = np.abs(places - problem.curve.points)
    off = np.concatenate([off[:, -1:], off], axis=1)[:, before:]
    halfway = problem.kind.points(candidates.rows, candidates.closure, (angles[:, 1:] + angles[:, :-1]) / 2)
    chord = np.diff(points)
    share = np.clip((np.conj(chord) * (halfway - points[:-1])).real / np.abs(chord) ** 2, 0, 1)
    far = np.abs(halfway - points[:-1] - share * chord)
    usual = np.maximum(off[:, 1:], off[:, :-1]) + np.abs(chord)
    return np.asarray((np.maximum(far - usual, 0.0) ** 2).sum(axis=1))


def _stepped(problem: PathTask, state: _State, damping: Real) -> Candidates:
    """Return the candidates after one step."""
    with np.errstate(all="ignore"):
        residual, slopes = _equations(problem, state)
        change = _change(problem, state, residual, slopes, damping)
        angles = state.candidates.angles + _turned(problem, state, change)
    rows = state.candidates.rows + change[:, : state.candidates.rows.shape[1]]
    return state.candidates._replace(rows=rows, angles=angles)


def _equations(problem: PathTask, state: _State) -> tuple[Real, Real]:
    """Return residuals (B, m) and their slopes (B, m, p) by the parameters and a free start's angle."""
    root = np.sqrt(problem.weights)
    off = (problem.curve.points - state.traced.point) * root
    slopes = state.traced.slopes * root[:, None]
    if problem.timing is None:
        back = np.conj(state.traced.rate) / np.abs(state.traced.rate)
        return (off * back).imag, (slopes * back[..., None]).imag
    if problem.free_start:
        slopes = np.concatenate([slopes, (state.traced.rate * root)[..., None]], axis=2)
    return (
        np.concatenate([off.real, off.imag], axis=1),
        np.concatenate([slopes.real, slopes.imag], axis=1),
    )


def _change(problem: PathTask, state: _State, residual: Real, slopes: Real, damping: Real) -> Real:
    """Return the damped step, with the limits that it would break and the given values as equations."""
    across = slopes.transpose(0, 2, 1)
    normal, right = across @ slopes, (across @ residual[..., None])[..., 0]
    count = normal.shape[1]
    diagonal = np.einsum("bii->bi", normal)
    scale = diagonal.mean(axis=1, keepdims=True)
    diagonal += damping[:, None] * (diagonal + 1e-3 * scale) + 1e-15 * scale
    nowhere = ~(np.isfinite(normal).all(axis=(1, 2)) & np.isfinite(right).all(axis=1) & (scale[:, 0] > 0))
    normal[nowhere], right[nowhere] = np.eye(count), 0.0  # a candidate that cannot be closed stays as it is
    mask, _ = problem.requirements.held(problem.kind)
    equations = np.zeros((len(right), len(mask), count))
    equations[:, range(len(mask)), range(len(mask))] = mask
    step = _solved(normal, right, equations, -state.broken)
    margins, rows = state.margins, state.candidates.rows
    moved = problem.requirements.margins(problem.kind, rows + step[:, : rows.shape[1]])
    breaking = ~(moved >= np.minimum(_NEARER * margins, 0.9 * margins + 1e-12))
    if not breaking.any():
        return step
    limits = np.zeros((*margins.shape, count))
    limits[..., : rows.shape[1]] = _margin_slopes(problem, rows, margins) * breaking[..., None]
    return _solved(
        normal,
        right,
        np.concatenate([equations, limits], axis=1),
        np.concatenate([-state.broken, (_NEARER - 1.0) * margins * breaking], axis=1),
    )


def _margin_slopes(problem: PathTask, rows: Real, margins: Real) -> Real:
    """Return how each margin changes with each parameter (B, m, p)."""
    moved = (rows + step for step in _DIFFERENCE * np.eye(rows.shape[1]))
    after = [problem.requirements.margins(problem.kind, near) for near in moved]
    return np.asarray((np.stack(after, axis=2) - margins[..., None]) / _DIFFERENCE)


def _solved(normal: Real, right: Real, equations: Real, targets: Real) -> Real:
    """Return the least-squares step (B, p) that keeps equations (B, m, p); a row of zeros is no equation."""
    used = (np.abs(equations) > 0).any(axis=(0, 2))
    equations, targets = equations[:, used], targets[:, used]
    count, extra = normal.shape[1], equations.shape[1]
    if not extra:
        return _solutions(normal, right)
    whole = np.zeros((len(right), count + extra, count + extra))
    whole[:, :count, :count] = normal
    whole[:, count:, :count] = equations
    whole[:, :count, count:] = equations.transpose(0, 2, 1)
    size = np.einsum("bii->b", normal) / count
    none = np.abs(equations).max(axis=2) == 0
    own = np.arange(count, count + extra)
    whole[:, own, own] = np.where(none, -1.0, -1e-12 / size[:, None])
    both = np.concatenate([right, np.where(none, 0.0, targets)], axis=1)
    return _solutions(whole, both)[:, :count]


def _solutions(matrices: Real, right: Real) -> Real:
    """Return the solutions of linear equations (B, n, n), 0 where there is none, so that nothing changes."""
    try:
        return np.asarray(np.linalg.solve(matrices, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        solutions = np.zeros(right.shape)
        for n, (matrix, side) in enumerate(zip(matrices, right, strict=True)):
            with suppress(np.linalg.LinAlgError):
                solutions[n] = np.linalg.solve(matrix, side)
        return solutions


def _turned(problem: PathTask, state: _State, change: Real) -> Real:
    """Return by how much each point's crank angle changes in a step (B, n)."""
    if problem.timing is not None:
        return change[:, -1:] if problem.free_start else np.zeros((len(change), 1))
    traced, size = state.traced, state.candidates.rows.shape[1]
    missing = problem.curve.points - traced.point - (traced.slopes @ change[:, :size, None])[..., 0]
    turn = (np.conj(traced.rate) * missing).real / np.abs(traced.rate) ** 2
    gap = np.diff(state.candidates.angles, axis=1) * state.candidates.sense[:, None]
    last = (
        2 * np.pi - gap.sum(axis=1, keepdims=True) if problem.curve.closed else np.full((len(gap), 1), np.pi)
    )
    before = np.concatenate([last, gap], axis=1) * _OF_GAP
    after = np.concatenate([gap, last], axis=1) * _OF_GAP
    forward = turn * state.candidates.sense[:, None]
    return np.asarray(np.nan_to_num(np.clip(forward, -before, after) * state.candidates.sense[:, None]))
