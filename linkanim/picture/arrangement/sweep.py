"""What a linkage sweeps in a cycle: how far it reaches, and which parts of the plane it leaves free."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.figure import Figure
from linkanim.picture.parts.body_shapes import ENDED, WHEELS
from linkanim.picture.parts.fittings import outlines
from linkanim.picture.parts.wheels import wheels
from linkanim.picture.view import Box, joined

_MOMENTS = 120
_ALONG = np.linspace(0.0, 1.0, 13)
_CELLS = 160
_ROUND = np.exp(2j * np.pi * np.arange(240) / 240)

Points = NDArray[np.complex128]
Numbers = NDArray[np.float64]
Sides = tuple[Numbers, Numbers, Numbers, Numbers]
"""Left, low, right and high of rectangles, in the scene's unit."""


@dataclass(frozen=True)
class Sweep:
    """Points x + yi of the plane, in the scene's unit, so close that nothing of size lies between them.

    `feet` are those points about which more is drawn than a bar's width: pedestals, guides, pads. `solid`
    are those about which nothing is drawn: the rims of wheels.
    """

    points: Points
    feet: Points
    solid: Points

    @cached_property
    def parts(self) -> tuple[tuple[Box, int], ...]:
        """Boxes of points, and of which width what is drawn about them is: 0 none, 1 a bar's, 2 a foot's."""
        kinds = ((self.solid, 0), (self.points, 1), (self.feet, 2))
        return tuple((_box(points), kind) for points, kind in kinds if points.size)

    @cached_property
    def box(self) -> Box:
        """The rectangle that holds all points; the unit square where there are none."""
        boxes = [box for box, _ in self.parts] or [Box(0.0, 0.0, 1.0, 1.0)]
        whole = boxes[0]
        for box in boxes[1:]:
            whole = joined(whole, box)
        return whole

    def touches(self, sides: Sides, bar: Numbers, foot: Numbers) -> NDArray[np.bool_]:
        """Return whether anything is drawn in rectangles: a bar's half width or a foot about the points."""
        return self._bars.holds(sides, bar) | self._feet.holds(sides, foot) | self._rims.holds(sides, 0.0)

    @cached_property
    def _bars(self) -> _Grid:
        return _Grid.of(self.points)

    @cached_property
    def _feet(self) -> _Grid:
        return _Grid.of(self.feet)

    @cached_property
    def _rims(self) -> _Grid:
        return _Grid.of(self.solid)

    def __or__(self, other: Sweep) -> Sweep:
        """Return what either sweeps."""
        mine, theirs = (self.points, self.feet, self.solid), (other.points, other.feet, other.solid)
        return Sweep(*(np.concatenate(both) for both in zip(mine, theirs, strict=True)))


@dataclass(frozen=True)
class _Grid:
    """How many cells with points in them lie left of and below each corner of a grid."""

    box: Box
    cell: tuple[float, float]
    sums: NDArray[np.int64]

    @classmethod
    def of(cls, points: Points) -> _Grid:
        box = _box(points) if points.size else Box(0.0, 0.0, 0.0, 0.0)
        cell = tuple(
            max(far - near, 1e-12) / _CELLS for near, far in ((box.left, box.right), (box.low, box.high))
        )
        column, row = ((points.real - box.left) / cell[0], (points.imag - box.low) / cell[1])
        held = np.zeros((_CELLS + 1, _CELLS + 1), np.int64)
        place = [np.minimum(at.astype(np.int64), _CELLS - 1) + 1 for at in (column, row)]
        held[tuple(place)] = 1
        return cls(box, (cell[0], cell[1]), held.cumsum(axis=0).cumsum(axis=1))

    def holds(self, sides: Sides, around: Numbers | float) -> NDArray[np.bool_]:
        """Return whether a point lies in or around rectangles, or in a cell at their edges."""
        left, low, right, high = sides
        west, east = self._cells(left - around - self.box.left, right + around - self.box.left, self.cell[0])
        south, north = self._cells(low - around - self.box.low, high + around - self.box.low, self.cell[1])
        sums = self.sums
        count = sums[east, north] - sums[west, north] - sums[east, south] + sums[west, south]
        return np.asarray((west < east) & (south < north) & (count != 0))

    @staticmethod
    def _cells(near: Numbers, far: Numbers, cell: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        first, last = np.floor(near / cell), np.ceil(far / cell)
        return np.clip(first, 0, _CELLS).astype(np.intp), np.clip(last, 0, _CELLS).astype(np.intp)


def sweep_of(figure: Figure) -> Sweep:
    """Return what a figure's bodies, springs, dampers, traces and wheels pass over in its cycle."""
    swept = np.concatenate([np.zeros(0, complex), *_swept(figure)])
    swept = np.concatenate([swept, *_fitted(figure)])
    guided = (joint.name for joint in figure.linkage.joints if joint.travels)
    ends = (body.joints[-1] for body in figure.bodies if figure.scene.style(body.name).outline in ENDED)
    broad = (*figure.fixed, *guided, *ends)
    feet = np.concatenate([np.zeros(0, complex), *(_path(figure, name) for name in broad)])
    rims = np.concatenate([np.zeros(0, complex), *_rims(figure)])
    return Sweep(*(points[np.isfinite(points)] for points in (swept, feet, rims)))


def _swept(figure: Figure) -> Iterator[Points]:
    for body in figure.bodies:
        for one, other in combinations(body.joints, 2):
            yield _between(_path(figure, one), _path(figure, other))
    for centre, reach in _body_wheels(figure):
        yield (_path(figure, centre)[:, None] + reach * _ROUND).ravel()
    for strut in figure.struts:
        yield _between(*(_path(figure, name) for name in strut.between))
    for name in figure.shown:
        yield _path(figure, name, every=1)


def _fitted(figure: Figure) -> Iterator[Points]:
    """Yield where slotted bars and guides pass."""
    for outline, places, turns in outlines(figure):
        yield (places[:, None] + turns[:, None] * _edged(outline)).ravel()


def _edged(loop: Points) -> Points:
    """Return a loop's corners, and points along its longer edges."""
    after = np.roll(loop, -1)
    edges = np.abs(after - loop)
    long = edges > 0.1 * edges.sum()
    return np.concatenate((loop, _between(loop[long], after[long])))


def _rims(figure: Figure) -> Iterator[Points]:
    """Yield circles over each wheel, wherever it goes."""
    for centre, reach in _round(figure):
        way = _path(figure, centre)
        still = bool(np.all(np.abs(way - way[0]) <= 1e-9 * reach))
        way, circles, shares = (way[:1], _ROUND, 9) if still else (way, _ROUND[::4], 3)
        for share in np.linspace(1.0, 0.2, shares):
            yield (way[:, None] + share * reach * circles).ravel()


def _round(figure: Figure) -> Iterator[tuple[str, float]]:
    """Yield the centres and radii of gears, and of bodies that are drawn as wheels."""
    yield from ((wheel.centre, wheel.reach) for wheel in wheels(figure))
    yield from _body_wheels(figure)


def _body_wheels(figure: Figure) -> Iterator[tuple[str, float]]:
    """Yield the centre of each body that is drawn as a wheel, and how far it reaches from there."""
    for body in figure.linkage.bodies:
        if figure.scene.style(body.name).outline in WHEELS:
            yield body.joints[0], figure.wheel_reach(body)


def _between(begin: Points, end: Points) -> Points:
    points: Points = (begin[:, None] + (end - begin)[:, None] * _ALONG).ravel()
    return points


def _path(figure: Figure, name: str, every: int = 0) -> Points:
    """Return where a joint passes, at some of the cycle's moments."""
    places = np.atleast_2d(figure.cycle.position[name])
    step = every or max(len(places) // _MOMENTS, 1)
    path: Points = places[::step, 0] + 1j * places[::step, 1]
    return path


def _box(points: Points) -> Box:
    x, y = points.real, points.imag
    return Box(float(x.min()), float(y.min()), float(x.max()), float(y.max()))
