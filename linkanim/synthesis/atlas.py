"""Keep an atlas of coupler curves, and find those in it that are most like a drawn one.

Its parts, in reading order:

- An atlas of coupler curves: many linkages from one seed, each curve at points equally far along it.
- The search for the most similar curves: over the shift along the curve, turn, scale, sense and mirror image.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.synthesis.curves import DrawnCurve
from linkanim.synthesis.linkages import Complex, Indices, LinkageKind, Real

# An atlas of coupler curves: many linkages from one seed, each curve at points equally far along it.
#
# It is made once in a process, in about a second, and is the same every time. It has only one closure: the
# other closure's curves are mirror images.

CURVES = 20_000
POINTS = 64
"""The number of points along each curve."""
_POSES = 96
"""The number of poses, at equal crank angles, between which a curve's points are interpolated."""
_AT_ONCE = 2_000
"""The number of curves made at once, which limits the memory for intermediate results."""
_SEED = 25
_WORST = math.radians(4)
"""The least transmission angle of a linkage in the atlas."""


class Atlas(NamedTuple):
    """Linkages (J, p) of one kind and closure +1, their curves' points, and the crank angles of these.

    Curves are centred and scaled to a mean square of 1 / POINTS: `centre` and `scale` undo this.
    """

    kind: LinkageKind
    rows: Real
    angles: Real
    shape: Complex
    spectrum: Complex
    centre: Complex
    scale: Real

    def first(self, count: int) -> Atlas:
        """Return the first `count` of its curves."""
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
    """Return the first `count` linkages of a random sequence whose crank turns fully."""
    random = np.random.default_rng(_SEED)
    sound: list[Real] = []
    while sum(map(len, sound)) < count:
        rows = kind.random_rows(random, 2 * count)
        sound.append(rows[(kind.margins(rows, _WORST) > 0).all(axis=1)])
    return np.concatenate(sound)[:count]


def _along(kind: LinkageKind, rows: Real, first: int) -> tuple[Real, Complex]:
    """Return crank angles (J, POINTS) at equal distances along each closed curve, and the points there.

    `first` is the number of the first of these linkages in the atlas.
    """
    turn = np.linspace(0, 2 * math.pi, _POSES + 1)
    closure = np.ones(len(rows))
    points = kind.points(rows, closure, np.broadcast_to(turn, (len(rows), len(turn))))
    length = np.zeros((len(rows), len(turn)))
    np.cumsum(np.abs(np.diff(points, axis=1)), axis=1, out=length[:, 1:])
    # One search serves all rows: row j's lengths are moved to between 2j and 2j + 1.
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


# The search for the most similar curves: over the shift along the curve, turn, scale, sense and mirror image.
#
# With curves centred, the best turn and scale of one onto the other leave 1 - |c|² of the mean square, where
# c is their inner product; one Fourier transform gives the products for all shifts along the curve.

_SHARES = (0.12, 0.2, 0.3, 0.42, 0.56, 0.72, 0.9)
"""The shares of a coupler curve with which an open curve is compared."""
_FEW_SEED, _FEW_TRIES = 6, 2
_TIMED, _TIMED_POINTS, _STARTS = 4_000, 24, 36
"""The numbers of curves, points and starts that are tried with prescribed timing."""
VARIANTS = tuple((mirrored, reverse) for mirrored in (False, True) for reverse in (False, True))


class Candidates(NamedTuple):
    """Linkages (B, p), their closures (B,), and the crank angles (B, n) at which they pass the points.

    Angles grow or fall all along; `sense` (B,) is +1 where they grow.
    """

    rows: Real
    closure: Real
    angles: Real
    sense: Real

    def take(self, chosen: Indices | NDArray[np.bool_]) -> Candidates:
        """Return the chosen candidates."""
        return Candidates(*(part[chosen] for part in self))


def matched(atlas: Atlas, curve: DrawnCurve, count: int) -> Candidates:
    """Return the best `count` candidates for free timing, the best first."""
    return _best(_hits(atlas, curve, count), count)


def matched_in_time(
    atlas: Atlas, points: Complex, timing: Real, count: int, *, free_start: bool
) -> Candidates:
    """Return the best candidates for prescribed timing, the crank angle at each point.

    With `free_start` all angles may be shifted by one angle; else a linkage may be turned only together
    with its crank.
    """
    rows, hits = atlas.rows[:_TIMED], list[tuple[Real, Candidates]]()
    chosen = np.linspace(0, len(points) - 1, min(len(points), _TIMED_POINTS)).round().astype(np.intp)
    for mirrored in (False, True):
        own, angles = (np.conj(points), -timing) if mirrored else (points, timing)
        score, start = _timed(atlas, own[chosen], angles[chosen], free_start=free_start)
        best = np.argpartition(-score, count)[:count]
        own_angles = angles + start[best, None]
        placed = _laid(atlas, rows[best], own, own_angles, np.ones(count), mirrored=mirrored)
        placed = placed if free_start else placed._replace(angles=np.tile(timing, (count, 1)))
        hits.append((score[best], placed))
    return _best(hits, count)


def matched_few(atlas: Atlas, curve: DrawnCurve, count: int) -> Candidates:
    """Return candidates for few points, between which the curve is unknown, by random crank angles."""
    random = np.random.default_rng(_FEW_SEED)
    hits, points = list[tuple[Real, Candidates]](), curve.points
    reach = 2 * math.pi * (1.0 if curve.closed else 0.8)
    sought = points - points.mean()
    for mirrored, _ in _FEW_TRIES * VARIANTS:
        own = np.conj(points) if mirrored else points
        angles = np.sort(random.uniform(0.0, reach, (len(atlas.rows), len(points))), axis=1)
        angles += random.uniform(0.0, 2 * math.pi, (len(atlas.rows), 1))
        shape = atlas.kind.points(atlas.rows, np.ones(len(atlas.rows)), angles)
        shape -= shape.mean(axis=1, keepdims=True)
        product = np.conj(shape) @ (np.conj(sought) if mirrored else sought)
        score = np.abs(product) ** 2 / (np.abs(shape) ** 2).sum(axis=1)
        best = np.argpartition(-score, count)[:count]
        placed = _laid(atlas, atlas.rows[best], own, angles[best], np.ones(count), mirrored=mirrored)
        hits.append((score[best], placed))
    return _best(hits, count)


def _best(hits: Iterable[tuple[Real, Candidates]], count: int) -> Candidates:
    """Return the best `count` candidates of several sets, each with its scores."""
    scores, parts = zip(*hits, strict=True)
    return joined(parts).take(np.argsort(-np.concatenate(scores), kind="stable")[:count])


def _timed(atlas: Atlas, points: Complex, timing: Real, *, free_start: bool) -> tuple[Real, Real]:
    """Return each curve's best score over all starts, and the start."""
    rows = atlas.rows[:_TIMED]
    best, where = np.full(len(rows), -1.0), np.zeros(len(rows))
    sought = points - points.mean()
    for start in np.arange(_STARTS) * (2 * math.pi / _STARTS):
        shape = atlas.kind.points(rows, np.ones(len(rows)), np.tile(timing + start, (len(rows), 1)))
        shape -= shape.mean(axis=1, keepdims=True)
        product = np.conj(shape) @ sought
        size = np.abs(product) if free_start else np.maximum((product * np.exp(1j * start)).real, 0.0)
        score = size**2 / (np.abs(shape) ** 2).sum(axis=1)
        better = score > best
        best, where = np.where(better, score, best), np.where(better, start, where)
    return best, where


def joined(parts: Iterable[Candidates]) -> Candidates:
    """Return several sets of candidates as one."""
    return Candidates(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _hits(atlas: Atlas, curve: DrawnCurve, count: int) -> Iterator[tuple[Real, Candidates]]:
    """Yield the best of each variant, for an open curve also of each share of the coupler curve."""
    for share in (1.0,) if curve.closed else _SHARES:
        steps = POINTS if curve.closed else round(share * POINTS)
        last = steps if curve.closed else steps - 1
        sought = curve.at(np.arange(steps) / last)
        sought = sought - sought.mean()
        sought /= np.sqrt((np.abs(sought) ** 2).sum())
        size = None if curve.closed else _window(atlas, steps)
        for mirrored, reverse in VARIANTS:
            target = np.conj(sought) if mirrored else sought
            score, start = _correlated(atlas, target[::-1] if reverse else target, size)
            best = np.argpartition(-score, count)[:count]
            places = (1.0 if curve.closed else curve.places[-1]) - curve.places if reverse else curve.places
            angles = _angles(atlas, best, start[best, None] + last * places)
            points = np.conj(curve.points) if mirrored else curve.points
            sense = np.full(len(best), -1.0 if reverse else 1.0)
            yield score[best], _laid(atlas, atlas.rows[best], points, angles, sense, mirrored=mirrored)


def _window(atlas: Atlas, steps: int) -> Real:
    """Return the root (J, POINTS) of the sum of squares of each stretch of points about its centre."""
    twice = np.concatenate([atlas.shape, atlas.shape[:, :steps]], axis=1)
    total = np.cumsum(twice, axis=1)
    square = np.cumsum(twice.real**2 + twice.imag**2, axis=1)
    total = total[:, steps:] - total[:, :-steps]
    square = square[:, steps:] - square[:, :-steps]
    spread = np.roll(square - np.abs(total) ** 2 / steps, 1, axis=1)
    return np.asarray(np.sqrt(np.maximum(spread, 1e-4 * spread.mean())))


def _correlated(atlas: Atlas, sought: Complex, size: Real | None) -> tuple[Real, Indices]:
    """Return each curve's best score over all shifts, and the shift."""
    spectrum = np.conj(np.fft.fft(sought.astype(np.complex64), POINTS))
    product = np.fft.ifft(atlas.spectrum * spectrum, axis=1)
    score: Real = product.real**2 + product.imag**2
    if size is not None:
        score /= size**2
    start = score.argmax(axis=1)
    return np.take_along_axis(score, start[:, None], axis=1)[:, 0], start


def _laid(
    atlas: Atlas, rows: Real, points: Complex, angles: Real, sense: Real, *, mirrored: bool
) -> Candidates:
    """Return linkages laid over the points that they pass at crank angles; mirrored back if `mirrored`."""
    kind, closure = atlas.kind, np.ones(len(rows))
    turn, shift = overlaid(kind.points(rows, closure, angles), points)
    rows, angles = kind.placed(rows, turn, shift), angles + np.angle(turn)[:, None]
    if not mirrored:
        return Candidates(rows, closure, angles, sense)
    return Candidates(*kind.mirrored(rows, closure), -angles, -sense)


def _angles(atlas: Atlas, which: Indices, places: Real) -> Real:
    """Return the crank angles at places along curves, counted in points, also beyond the last one."""
    before = np.floor(places).astype(np.intp)

    def at(index: Indices) -> Real:
        turns, own = np.divmod(index, POINTS)
        return np.asarray(atlas.angles[which[:, None], own] + 2 * math.pi * turns)

    low = at(before)
    return np.asarray(low + (places - before) * (at(before + 1) - low))


def overlaid(shape: Complex, points: Complex) -> tuple[Complex, Complex]:
    """Return the factors and shifts (B,) that lay shapes (B, n) over points (n,) with the least squares."""
    centre, middle = shape.mean(axis=1), points.mean()
    arms = shape - centre[:, None]
    turn = (np.conj(arms) * (points - middle)).sum(axis=1) / (np.abs(arms) ** 2).sum(axis=1)
    return turn, middle - turn * centre
