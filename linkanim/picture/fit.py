"""Fit what is drawn into a room: how far a linkage and all that belongs to it extend, and the view for that.

What is drawn about a point of the scene, such as a pin or a letter, has a size in pixels, whatever the view.
So an extent is a set of rectangles of the scene, each with margins in pixels.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.picture.bodies import ENDED, ROUND, SHADOW, WHEELS
from linkanim.picture.figure import Figure
from linkanim.picture.fittings import SLOTTED, outlines
from linkanim.picture.gears import wheels
from linkanim.picture.layout import Gauge
from linkanim.picture.view import Box, Rect, View, moved

Floats = NDArray[np.float64]
Points = NDArray[np.complex128]
_LEAST_SCALE = 1e-6
"""The least scale, in widths of the room for the whole extent: some room is left of even the smallest one."""


class Extent(NamedTuple):
    """Rectangles of the scene (n, left low right high), y up; margins in pixels (n, left top right low)."""

    boxes: Floats
    margins: Floats

    def __or__(self, other: Extent) -> Extent:
        """Return all rectangles of both."""
        return Extent(
            np.concatenate([self.boxes, other.boxes]), np.concatenate([self.margins, other.margins])
        )

    @property
    def box(self) -> Box:
        """The rectangle of the scene that holds all, without margins; the unit square where there is none."""
        if not len(self.boxes):
            return Box(0.0, 0.0, 1.0, 1.0)
        left, low = self.boxes[:, :2].min(axis=0).tolist()
        right, high = self.boxes[:, 2:].max(axis=0).tolist()
        return Box(left, low, right, high)

    def pixels(self, view: View) -> Rect:
        """Return the rectangle of all that is drawn, in a view."""
        (left, low, right, high), (west, top, east, bottom) = self.boxes.T, self.margins.T
        x, right_ = view.x + view.scale * left - west, view.x + view.scale * right + east
        y, bottom_ = view.y - view.scale * high - top, view.y - view.scale * low + bottom
        first = float(x.min()), float(y.min())
        return Rect(*first, float(right_.max()) - first[0], float(bottom_.max()) - first[1])


NOTHING = Extent(np.zeros((0, 4)), np.zeros((0, 4)))


def around(points: ArrayLike, margins: float | tuple[float, float, float, float]) -> Extent:
    """Return the rectangle that holds points x + yi of the scene, with margins in pixels."""
    finite = np.asarray(points, np.complex128).ravel()
    finite = finite[np.isfinite(finite)]
    if not finite.size:
        return NOTHING
    x, y = finite.real, finite.imag
    sides = margins if isinstance(margins, tuple) else (margins,) * 4
    return Extent(np.array([[x.min(), y.min(), x.max(), y.max()]]), np.array([sides], np.float64))


def each(points: Points, offsets: Points, half: Points) -> Extent:
    """Return an extent of rectangles in pixels: about `offsets` from points x + yi, `half` their size."""
    known = np.isfinite(points) & np.isfinite(offsets)
    points, offsets, half = points[known], offsets[known], np.broadcast_to(half, known.shape)[known]
    boxes = np.stack([points.real, points.imag, points.real, points.imag], axis=1)
    x, y = offsets.real, offsets.imag
    margins = np.stack([half.real - x, half.imag - y, half.real + x, half.imag + y], axis=1)
    return Extent(boxes, margins)


def together(extents: Iterable[Extent]) -> Extent:
    """Return all rectangles of several extents."""
    parts = [*extents] or [NOTHING]
    return Extent(
        np.concatenate([one.boxes for one in parts]), np.concatenate([one.margins for one in parts])
    )


def fitted(extent: Extent, room: Rect) -> View:
    """Return the view in which an extent fills a room as far as it can, in the room's middle."""
    (left, low, right, high), (west, top, east, bottom) = extent.boxes.T, extent.margins.T
    scale = min(
        _largest(left, right, west, east, max(room.width, 1.0)),
        _largest(low, high, bottom, top, max(room.height, 1.0)),
    )
    box = extent.box
    most = max(box.right - box.left, box.high - box.low)
    if not np.isfinite(scale):
        scale = 1.0
    scale = max(scale, _LEAST_SCALE * max(room.width, room.height, 1.0) / most if most > 0 else scale)
    x = room.middle.real - ((scale * right + east).max() + (scale * left - west).min()) / 2
    y = room.middle.imag - ((bottom - scale * low).max() + (-scale * high - top).min()) / 2
    return View(scale, float(x), float(y))


def nearest(extent: Extent, view: View, room: Rect) -> View:
    """Return the view in which an extent lies in a room, changed as little as that takes."""
    at = extent.pixels(view)
    if room.holds(at.x, at.y) and room.holds(at.right, at.bottom):
        return view
    share = min(room.width / at.width, room.height / at.height, 1.0)
    view = moved(view, (at.middle.real, at.middle.imag), zoom=share, pan=(0.0, 0.0))
    at = extent.pixels(view)
    right = max(room.x - at.x, 0.0) + min(room.right - at.right, 0.0)
    down = max(room.y - at.y, 0.0) + min(room.bottom - at.bottom, 0.0)
    return View(view.scale, view.x + right, view.y + down)


def _largest(begin: Floats, end: Floats, before: Floats, after: Floats, room: float) -> float:
    """Return the largest scale at which all lies in so many pixels; infinite where it has no length.

    How much is needed is a convex function of the scale made of straight pieces, so that going from piece to
    piece, from the largest scale on, ends after a few.
    """
    last, first = int(np.lexsort((after, end))[-1]), int(np.lexsort((-before, begin))[0])
    scale = np.inf
    for _ in range(len(begin) + 1):
        length = float(end[last] - begin[first])
        if not length > 0:
            return scale
        scale = min(scale, (room - float(after[last] + before[first])) / length)
        outer, inner = int((scale * end + after).argmax()), int((scale * begin - before).argmin())
        needed = float(scale * end[outer] + after[outer] - scale * begin[inner] + before[inner])
        if needed <= room * (1 + 1e-12) or (outer, inner) == (last, first):
            return scale
        last, first = outer, inner
    return scale


# How far a linkage extends: its bodies, springs, wheels, curves and the ground, over a cycle or in a pose.


def of_linkage(figure: Figure, gauge: Gauge, moment: float | None = None, *, traced: bool = True) -> Extent:
    """Return how far a linkage extends in its cycle, or in the pose at a `moment` with its whole curves."""
    return together(_parts(figure, gauge, moment, traced=traced))


def _parts(figure: Figure, gauge: Gauge, moment: float | None, *, traced: bool) -> Iterator[Extent]:
    line, edge, foot = gauge.around
    scene = figure.scene
    still = None if moment is None else scene.pose(moment, 0)
    # a still is cropped to what is drawn; in motion a shadow or a slot's side may lie in the margin
    bar, slotted = (_in_still(wide * gauge.bar, gauge) if still else (edge,) * 4 for wide in (1.0, SLOTTED))

    def whole(name: str) -> Points:
        places = np.atleast_2d(figure.cycle.position[name])
        points: Points = places[:, 0] + 1j * places[:, 1]
        return points

    def path(name: str) -> Points:
        return whole(name) if still is None else np.array([complex(*still.position[name])])

    for name in figure.in_view:
        yield around(path(name), bar)
    slides = [slide for one in figure.linkage.joints for slide in one.slides if slide.point == one.name]
    guided = {slide.point for slide in slides if slide.line.on is None}
    travelling = {one.name: None for one in figure.linkage.joints if one.travels or one.name in guided}
    ended = (body.joints[-1] for body in figure.bodies if scene.style(body.name).outline in ENDED)
    for name in (*figure.fixed, *ended):
        yield around(path(name), foot)
    for name in travelling:  # a guide on the ground is as long as the travel
        yield around(whole(name) if name in guided else path(name), foot)
    for joint in scene.trace if traced else ():
        yield around(figure.cycle.position[joint] @ np.array([1, 1j]), 2 * line)
    for centre, reach, rim in _wheels(figure, gauge):
        yield around(path(centre)[:, None] + reach * np.array([1, 1j, -1, -1j]), rim)
    for outline, places, turns in outlines(figure, still):
        yield around(places[:, None] + turns[:, None] * outline, slotted)


def _in_still(half: float, gauge: Gauge) -> tuple[float, float, float, float]:
    """Return how far a bar with its shadow is drawn around its joints: left, top, right, low."""
    right, low = SHADOW.real * gauge.bar, SHADOW.imag * gauge.bar
    edge = half + gauge.outline
    return edge, edge, max(edge, half + right), max(edge, half + low)


def _wheels(figure: Figure, gauge: Gauge) -> Iterator[tuple[str, float, float]]:
    """Yield the centres and radii of gears, and of wheels, and their further pixels."""
    yield from ((wheel.centre, wheel.reach, gauge.line) for wheel in wheels(figure))
    for body in figure.linkage.bodies:
        style = figure.scene.style(body.name)
        if style.outline in WHEELS:
            yield body.joints[0], figure.wheel_reach(body), gauge.line if style.radius else ROUND * gauge.bar
