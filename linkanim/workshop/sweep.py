"""How near moving pieces come to each other over the whole true period, not only at samples.

A piece is made of convex cells, each a hull of corners with a rim of one radius, and moves with a frame: a
joint as its origin, and a direction. Between two samples a corner's distance from its place at the nearer one
is bounded by its speeds at both, a bound of its acceleration, and the part of its displacement that these
speeds do not explain. Where that bound does not settle whether two pieces stay apart, the step is halved.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage import Crank
from linkanim.picture.layered import Frame
from linkanim.scenes.scene import Scene

Real = NDArray[np.float64]
Points = NDArray[np.complex128]
Numbers = NDArray[np.int64]

_SAMPLES = 720
"""Samples of a drive period; more where a crank turns quicker than the drive."""
_MOST_SAMPLES = 11_520
_HALVINGS = 9
_CAUTION = 2.0
"""The factor by which an acceleration within a step may exceed those at its ends."""


GROUND = Frame()


class Nearness(NamedTuple):
    """Whether two pieces stay as far apart as asked; their least distance, in mm; its phase, in rad.

    Where they stay apart the distance is a lower bound; else they come as near as that, or may do so.
    """

    apart: bool
    distance: float
    phase: float


class _Placed(NamedTuple):
    """The place of a frame: its origin and its direction, each with two derivatives by the phase."""

    origin: tuple[Points, Points, Points]
    direction: tuple[Points, Points, Points]

    def at(self, points: Sequence[complex], rows: Numbers | slice = slice(None)) -> Points:
        """Return the places of points of the frame, (phases, points), at the phases `rows`."""
        places: Points = self.origin[0][rows, None] + self.direction[0][rows, None] * np.asarray(points)
        return places


class _Places(NamedTuple):
    """The places of joints, in mm, and their first two derivatives by the phase."""

    position: Mapping[str, Points]
    velocity: Mapping[str, Points]
    acceleration: Mapping[str, Points]

    def placed(self, frame: Frame, count: int) -> _Placed:
        """Return the place of a frame at the `count` phases."""
        nothing = np.zeros(count, np.complex128)
        origin = (nothing, nothing, nothing)
        if frame.origin is not None:
            origin = tuple(quantity[frame.origin] for quantity in self)  # type: ignore[assignment]
        if frame.axis is None:
            return _Placed(origin, (nothing + frame.turn, nothing, nothing))
        begin, end = frame.axis
        bar, moves, speeds = (quantity[end] - quantity[begin] for quantity in self)
        size = np.abs(bar)
        direction = bar / size
        # The bar keeps its length, so its direction's derivatives follow from the components across it.
        rate = (moves * direction.conj()).imag / size
        second = (speeds * direction.conj()).imag / size
        direction = direction * frame.turn
        return _Placed(origin, (direction, 1j * rate * direction, (1j * second - rate**2) * direction))

    def quickest(self, cranks: Iterable[Crank]) -> float:
        """Return the turning rate of the quickest crank, relative to the drive's phase."""
        rates = [1.0]
        for crank in cranks:
            bar = self.position[crank.name] - self.position[crank.pivot]
            moves = self.velocity[crank.name] - self.velocity[crank.pivot]
            rates.append(float(np.max(np.abs((moves * bar.conj()).imag / np.abs(bar) ** 2))))
        return max(rates)


class MovingPiece(NamedTuple):
    """Convex cells, each the corners of a hull in the frame, with one radius about them; lengths in mm."""

    frame: Frame
    cells: tuple[tuple[complex, ...], ...]
    radius: float

    def stray(self, placed: _Placed, first: Numbers, last: Numbers, step: float) -> Real:
        """Return the most that its points are off their places at the nearer end, for each step (mm)."""
        far = max(abs(corner) for cell in self.cells for corner in cell)
        total = np.zeros(len(first))
        for (place, speed, acceleration), share in ((placed.origin, 1.0), (placed.direction, far)):
            fastest = np.maximum(np.abs(speed[first]), np.abs(speed[last]))
            bent = _CAUTION * np.maximum(np.abs(acceleration[first]), np.abs(acceleration[last]))
            drift = place[last] - place[first] - (speed[first] + speed[last]) * (step / 2)
            total += share * (fastest * (step / 2) + bent * (step**2 / 8) + np.abs(drift))
        return total

    def apart(self, other: MovingPiece, placed: Mapping[Frame, _Placed], rows: Numbers) -> Real:
        """Return the distance from another piece at each phase; 0 or less where they overlap."""
        ones, others = (
            [placed[piece.frame].at(cell, rows) for cell in piece.cells] for piece in (self, other)
        )
        least = np.full(len(rows), np.inf)
        for a in ones:
            for b in others:
                np.minimum(least, hulls_apart(a, b), out=least)
        return least - self.radius - other.radius


class Cycle:
    """A scene's true period in mm, sampled closely enough for its quickest part, and closer where asked."""

    def __init__(self, scene: Scene, scale: float) -> None:
        """Solve the scene; `scale` is mm per unit of length."""
        self.scene, self.scale = scene, scale
        self.count = _SAMPLES * max(round(scene.period / (2 * np.pi)), 1)
        quickest = self._at(self.phases).quickest(scene.linkage.cranks)
        self.count = int(min(self.count * max(quickest, 1.0), max(_MOST_SAMPLES, self.count)))
        self._start = self._at(self.phases)

    @property
    def phases(self) -> Real:
        """The phases of the samples, equally spaced over the period, its end left out."""
        return np.arange(self.count, dtype=np.float64) * (self.scene.period / self.count)

    def _at(self, phases: Real) -> _Places:
        motion = self.scene.solve(phase=phases, speed=1.0, derivatives=2)
        names = [joint.name for joint in self.scene.linkage.joints]

        def read(quantity: Mapping[str, Any]) -> dict[str, Points]:
            pairs = {name: np.broadcast_to(quantity[name], (len(phases), 2)) for name in names}
            return {name: self.scale * (pair[:, 0] + 1j * pair[:, 1]) for name, pair in pairs.items()}

        return _Places(read(motion.position), read(motion.velocity), read(motion.acceleration))

    def paths(self, frame: Frame, points: Sequence[complex]) -> Points:
        """Return the places of points of a frame at the samples, (samples, points), in the ground's frame."""
        return self._start.placed(frame, self.count).at(points)

    def seen(self, joint: str, frame: Frame) -> Points:
        """Return the places of a joint at the samples, (samples,), in a frame's own coordinates."""
        placed = self._start.placed(frame, self.count)
        return (self._start.position[joint] - placed.origin[0]) * placed.direction[0].conj()

    def nearness(
        self, pieces: Sequence[MovingPiece], pairs: Sequence[tuple[int, int, float]]
    ) -> list[Nearness]:
        """Return how near two pieces come, for each (piece, piece, wanted distance), in the order given."""
        finest, period = 2**_HALVINGS, self.scene.period
        # A step is identified by its beginning, counted in the finest steps.
        whole, unit = np.arange(self.count) * finest, period / (self.count * finest)
        steps = self._steps(pieces, whole, finest, self._start)
        known = {k: Nearness(True, far, 0.0) for k, far in steps.far(pairs)}
        unsure_spans = {k: whole for k in range(len(pairs)) if k not in known}
        bounds = dict.fromkeys(unsure_spans, np.inf)
        for level in range(_HALVINGS + 1):
            width = finest >> level
            if level and unsure_spans:
                begins = np.unique(np.concatenate(list(unsure_spans.values())))
                steps = self._steps(pieces, begins, width)
            for k, own in list(unsure_spans.items()):
                i, j, asked = pairs[k]
                near, at, sure = steps.between(i, j, own)
                unsure = sure < asked
                bounds[k] = min(bounds[k], float(sure[~unsure].min(initial=np.inf)))
                if near < asked:
                    known[k] = Nearness(False, near, at * unit)
                elif not unsure.any():
                    known[k] = Nearness(True, bounds[k], at * unit)
                elif level == _HALVINGS:
                    known[k] = Nearness(False, float(sure.min()), at * unit)
                else:
                    unsure_spans[k] = np.sort(np.concatenate((own[unsure], own[unsure] + width // 2)))
                    continue
                del unsure_spans[k]
        return [known[k] for k in range(len(pairs))]

    def _steps(
        self, pieces: Sequence[MovingPiece], begins: Numbers, width: int, places: _Places | None = None
    ) -> _Steps:
        """Return the pieces at both ends of steps; `places` are those at the ends, if known already."""
        round_ = self.count * 2**_HALVINGS
        unit = self.scene.period / round_
        rims = np.unique(np.concatenate((begins, begins + width)) % round_)
        first, last = (np.searchsorted(rims, some % round_) for some in (begins, begins + width))
        known = places or self._at(rims * unit)
        placed = {frame: known.placed(frame, len(rims)) for frame in {piece.frame for piece in pieces}}
        strays = [piece.stray(placed[piece.frame], first, last, width * unit) for piece in pieces]
        return _Steps(pieces, placed, strays, begins, rims, first, last)


class _Steps(NamedTuple):
    """Steps between phases, by their beginnings, and the pieces at their ends, the phases `rims`.

    A step goes from the phase number `first` to number `last` of these. In it, a piece stays within `strays`
    (mm) of its place at the nearer end.
    """

    pieces: Sequence[MovingPiece]
    placed: Mapping[Frame, _Placed]
    strays: Sequence[Real]
    begins: Numbers
    rims: Numbers
    first: Numbers
    last: Numbers

    def far(self, pairs: Sequence[tuple[int, int, float]]) -> Iterator[tuple[int, float]]:
        """Yield the pairs (number, distance) whose moving boxes alone are as far apart as asked."""
        lows, highs = [], []
        for piece, stray in zip(self.pieces, self.strays, strict=True):
            places = np.concatenate([self.placed[piece.frame].at(cell).ravel() for cell in piece.cells])
            rim = piece.radius + float(stray.max())
            lows.append((float(places.real.min()) - rim, float(places.imag.min()) - rim))
            highs.append((float(places.real.max()) + rim, float(places.imag.max()) + rim))
        for k, (i, j, asked) in enumerate(pairs):
            gap = max(max(lows[i][n] - highs[j][n], lows[j][n] - highs[i][n]) for n in (0, 1))
            if gap >= asked:
                yield k, gap

    def between(self, i: int, j: int, own: Numbers) -> tuple[float, int, Real]:
        """Return two pieces' least distance at ends of some steps, which end, and a bound for each step."""
        one, other, rows = self.pieces[i], self.pieces[j], np.searchsorted(self.begins, own)
        ends, back = np.arange(len(self.rims)), np.concatenate((self.first[rows], self.last[rows]))
        if len(own) < len(self.begins):
            ends, back = np.unique(back, return_inverse=True)
        apart = one.apart(other, self.placed, ends)
        n = int(apart.argmin())
        sure = apart[back].reshape(2, -1).min(axis=0) - self.strays[i][rows] - self.strays[j][rows]
        return float(apart[n]), int(self.rims[ends[n]]), sure


def hulls_apart(a: Points, b: Points) -> Real:
    """Return the distances of convex hulls, corners (n, k) and (n, m) in order; 0 where they overlap."""
    least = np.minimum(_corners_to_edges(a, b), _corners_to_edges(b, a))
    return np.where(_meet(a, b), 0.0, least)


def _edges(corners: Points) -> tuple[Points, Points]:
    """Return where edges begin, and the vectors along them; a point is an edge of no length."""
    if corners.shape[1] < 3:
        return corners[:, :1], corners[:, -1:] - corners[:, :1]
    return corners, np.roll(corners, -1, axis=1) - corners


def _corners_to_edges(corners: Points, hull: Points) -> Real:
    begin, along = _edges(hull)
    squared = np.abs(along) ** 2
    reach = corners[:, :, None] - begin[:, None, :]
    share = (reach * along[:, None, :].conj()).real / np.where(squared > 0, squared, 1.0)[:, None, :]
    away = reach - np.clip(share, 0.0, 1.0) * along[:, None, :]
    least: Real = np.abs(away).min(axis=(1, 2))
    return least


def _meet(a: Points, b: Points) -> NDArray[np.bool_]:
    """Return whether edges cross, or one hull holds a corner of the other."""
    inside = _holds(a, b[:, 0]) | _holds(b, a[:, 0])
    if min(a.shape[1], b.shape[1]) < 2:
        return inside
    (p, u), (q, v) = _edges(a), _edges(b)
    between = q[:, None, :] - p[:, :, None]
    one, other = u[:, :, None], v[:, None, :]
    crosses = _cross(one, between) * _cross(one, between + other) < 0
    right = _cross(other, between) * _cross(other, between - one) < 0
    meet: NDArray[np.bool_] = inside | np.any(crosses & right, axis=(1, 2))
    return meet


def _holds(hull: Points, point: Points) -> NDArray[np.bool_]:
    if hull.shape[1] < 3:
        return np.zeros(len(point), np.bool_)
    begin, along = _edges(hull)
    inside: NDArray[np.bool_] = np.all(_cross(along, point[:, None] - begin) > 0, axis=1)
    return inside


def _cross(a: Points, b: Points) -> Real:
    product: Real = (a.conj() * b).imag
    return product
