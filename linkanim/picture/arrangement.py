"""Arrange a picture: the scene as large as possible, and the words where its motion leaves room.

The area that a linkage sweeps in a cycle is measured once, and kept through pans, zooms and changes of theme.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain, combinations, product

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import NamedTuple, frozen
from linkanim.picture.bodies import ENDED, WHEELS
from linkanim.picture.figure import Figure, figure
from linkanim.picture.fittings import outlines
from linkanim.picture.gears import wheels
from linkanim.picture.hud import (
    WidestRow,
    WordBlock,
    blocks,
    caption_lines,
    key_block,
    key_lines,
    shapes_of,
    widest_rows,
)
from linkanim.picture.layout import (
    NOTHING_DOCKED,
    Docked,
    Gauge,
    Layout,
    gauge,
    layout,
    with_caption,
    with_table,
)
from linkanim.picture.look import Look
from linkanim.picture.text import Type
from linkanim.picture.view import Box, Rect, View, joined
from linkanim.scenes.scene import Scene
from linkanim.steps import at_once

# What a linkage sweeps in a cycle: how far it extends, and which parts of the plane it leaves free.

_MOMENTS = 120
_ALONG = np.linspace(0.0, 1.0, 13)
_CELLS = 160
_ROUND = np.exp(2j * np.pi * np.arange(240) / 240)

Points = NDArray[np.complex128]
Numbers = NDArray[np.float64]
Sides = tuple[Numbers, Numbers, Numbers, Numbers]
"""Left, low, right and high of rectangles, in the scene's unit."""


@frozen
class Sweep:
    """Points x + yi that a linkage passes, in the scene's unit, so close that no gap between them matters.

    `feet` are points about which more is drawn than a bar's width: pedestals, guides, pads. `solid` are
    points about which nothing more is drawn: the rims of wheels.
    """

    points: Points
    feet: Points
    solid: Points

    @cached_property
    def parts(self) -> tuple[tuple[Box, int], ...]:
        """The boxes of points, and how wide the drawing about them is: 0 for none, 1 a bar's, 2 a foot's."""
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
        """Return whether anything is drawn in rectangles: within `bar` or `foot` of a point, or on a rim."""
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
        """Return the union of two sweeps."""
        mine, theirs = (self.points, self.feet, self.solid), (other.points, other.feet, other.solid)
        return Sweep(*(np.concatenate(both) for both in zip(mine, theirs, strict=True)))


@frozen
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
    """Yield the points that slotted bars and guides pass."""
    for outline, places, turns in outlines(figure):
        yield (places[:, None] + turns[:, None] * _edged(outline)).ravel()


def _edged(loop: Points) -> Points:
    """Return a loop's corners, and points along its longer edges."""
    after = np.roll(loop, -1)
    edges = np.abs(after - loop)
    long = edges > 0.1 * edges.sum()
    return np.concatenate((loop, _between(loop[long], after[long])))


def _rims(figure: Figure) -> Iterator[Points]:
    """Yield points on each wheel's rim wherever the wheel goes."""
    for centre, reach in _round(figure):
        path = _path(figure, centre)
        still = bool(np.all(np.abs(path - path[0]) <= 1e-9 * reach))
        path, circles, shares = (path[:1], _ROUND, 9) if still else (path, _ROUND[::4], 3)
        for share in np.linspace(1.0, 0.2, shares):
            yield (path[:, None] + share * reach * circles).ravel()


def _round(figure: Figure) -> Iterator[tuple[str, float]]:
    """Yield the centres and radii of gears, and of bodies that are drawn as wheels."""
    yield from ((wheel.centre, wheel.reach) for wheel in wheels(figure))
    yield from _body_wheels(figure)


def _body_wheels(figure: Figure) -> Iterator[tuple[str, float]]:
    """Yield the centre and the radius of each body that is drawn as a wheel."""
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


# The arrangement: the scene as large as its stage allows, and the words where its motion leaves room.
#
# Words stand in the upper left corner, whatever else is shown: nothing that is switched on moves them. Of all
# arrangements the one of the least cost is taken: a smaller scene and a title in more lines cost something.
# The scene has a least size, `HIGH` of the stage's height or `WIDE` of its width; before it gets smaller,
# words get smaller, and before they get too small to read, the least important ones are left out.

HIGH, WIDE = 0.86, 0.7
"""The least share of the stage that a scene takes, of its height or of its width."""
_TIGHT = 0.8
"""The factor on that least size where there would else be no room for a row of words, or for the key."""
_STEPS = 10
_LINE = 0.03
"""What each further line of the title costs."""
_AWAY = (0.0, 0.25, 0.5)
"""How far the scene gives way to the words, in shares of the room that it leaves."""
_PLACES = tuple((0.5 + across, 0.5 + down) for across, down in sorted(product(_AWAY, _AWAY), key=sum))
"""How far right and down (0 to 1) a scene may stand to give way to the words, the middle first."""
_MARKS = (7.2, 2.5)
"""How wide and high the marks are, in sizes of the text."""
_SIGN = 1.2
"""The side of the sign of a pause, in sizes of the text; at the right end of the marks nothing covers it."""
_HINTS = (27.0, 19.0, 13.0, 5.4)
"""The widths of the hint bar, in sizes of its text: with all its words, then with fewer and fewer."""
_THINNEST = 0.68
"""The least thickness of a drawing on a small stage, as a share of that for the whole window."""
_EDGE = 9.0
"""The distance of the drawing from the stage's edge, in units."""
_EDGE_OF_STILL = 22.0
"""The same in a still."""
_ROOM_FOR_LINES = 3.6
"""What dimension lines need on each side of a still, in heights of their text."""


Views = tuple[Numbers, Numbers, Numbers]
"""Scales of views, and x and y of their origins, all of one shape."""


@frozen
class Arrangement:
    """Where scene and words stand: the parts of the window, the view, the thicknesses, the words."""

    layout: Layout
    view: View
    gauge: Gauge
    block: WordBlock | None


def arranged(
    parts: Layout,
    sweep: Sweep,
    shortest: float,
    blocks: Iterable[Sequence[WordBlock]],
    shapes: Iterable[tuple[float, float]] = (),
    edge: float | None = None,
) -> Arrangement:
    """Return the arrangement of a scene with this sweep and `shortest` bar, in the scene's unit.

    `blocks` are the words, set in several ways: the first group with a block that finds a place is taken.
    `shapes` are the sizes of the sentence that is shown for a while, the best first. The drawing keeps `edge`
    pixels from the stage's edge; without `edge`, the usual distance.
    """
    return at_once(_arranging(parts, sweep, shortest, blocks, shapes, edge))


def _arranging(
    parts: Layout,
    sweep: Sweep,
    shortest: float,
    blocks: Iterable[Sequence[WordBlock]],
    shapes: Iterable[tuple[float, float]],
    edge: float | None,
) -> Generator[None, None, Arrangement]:
    """Return the arrangement as `arranged` does, yielding after each way of setting the words."""
    ways_ = _WaysToArrange(parts, sweep, shortest, _EDGE * parts.unit if edge is None else edge)
    groups, tried = iter(blocks), list[Sequence[WordBlock]]()
    found = None
    for group in groups:  # words are set in further ways only where these find no place
        tried.append(group)
        found = next(ways_.placed(group), None)
        if found:
            break
        yield
    keyed = bool(tried) and tried[0][0].parts_at((0.0, 0.0))[1] is not None
    if tried and (found is None or _lacks(found, keyed)):
        for group in chain(tried, groups):
            yield
            roomy = next((one for one in ways_.placed(group, _TIGHT) if not _lacks(one, keyed)), None)
            if roomy:
                found = roomy
                break
    arrangement = found or Arrangement(parts, ways_.view(ways_.largest, (0.5, 0.5)), ways_.gauge, None)
    marked = replace(arrangement, layout=replace(arrangement.layout, marks=ways_.marks(arrangement)))
    hinted = replace(marked, layout=replace(marked.layout, hint=ways_.hint(marked)))
    return replace(hinted, layout=replace(hinted.layout, passing=ways_.free(hinted, shapes)))


def _lacks(found: Arrangement, keyed: bool) -> bool:
    """Return whether the words have no row, or lack a key to the arrows though one is wanted."""
    if found.block is None or (keyed and found.layout.legend is None):
        return True
    return bool(found.block.lines) and not found.block.rows


class _WaysToArrange:
    """The data that all arrangements of one scene share."""

    def __init__(self, parts: Layout, sweep: Sweep, shortest: float, edge: float) -> None:
        self.parts, self.sweep = parts, sweep
        self.room = parts.stage.inset(edge)
        box = sweep.box
        self._wide, self._high = max(box.right - box.left, 1e-12), max(box.high - box.low, 1e-12)
        extended = max(self._wide, self._high) > 1e-12
        bare = min(self.room.width / self._wide, self.room.height / self._high) if extended else 1.0
        share = min(parts.stage.width / parts.size[0], parts.stage.height / parts.size[1])
        self.gauge = gauge(parts.unit * max(share, _THINNEST), shortest * bare)
        self._reaches = [(box, self.gauge.around[kind]) for box, kind in sweep.parts]
        self.largest = self._largest(bare)
        high, wide = (side - 2 * edge + 2 * _EDGE * parts.unit for side in parts.stage[:1:-1])
        self.least = min(HIGH * high / self._high, WIDE * wide / self._wide)

    def placed(self, group: Sequence[WordBlock], tight: float = 1.0) -> Iterator[Arrangement]:
        """Yield arrangements with a group's words in the corner, off the scene, the cheapest first.

        The scene keeps at least `tight` times its least size.
        """
        clear: dict[int, NDArray[np.bool_]] = {}
        share = min(tight * self.least / self.largest, 1.0)
        shares = [1.0 - (1.0 - share) * step / _STEPS for step in range(_STEPS + 1)]
        scales = [share * self.largest for share in shares]
        corners = [self._corner(block) for block in group]
        for _, step, turn in _ways_through(shares, group):
            place, block = corners[turn], group[turn]
            if place is None:
                continue
            if turn not in clear:
                drawn = self._drawn_in([*block.rects_at(place), self.sign], self._views(scales), block.size)
                clear[turn] = np.logical_not(drawn.any(axis=-1))
            views = clear[turn][step]
            if views.any():
                hud, legend = block.parts_at(place)
                words = tuple(block.rects_at(place))
                parts = replace(self.parts, hud=hud, legend=legend, words=words)
                view = self.view(scales[step], _PLACES[int(views.argmax())])
                yield Arrangement(parts, view, self.gauge, block)

    @property
    def sign(self) -> Rect:
        """Where the sign of a pause stands: in the window's upper right corner, whatever else is shown."""
        (right, _), edge, side = self.parts.size, self.parts.margin, _SIGN * self.parts.text_size
        return Rect(right - edge - side, edge, side, side)

    def marks(self, arrangement: Arrangement) -> Rect:
        """Return where the marks stand: from the sign of a pause leftwards, up to the words."""
        sign, high = self.sign, self.parts.text_size
        line = Rect(0.0, sign.y, sign.x, _MARKS[1] * high)
        begin = max((one.right for one in arrangement.layout.words if one.meets(line)), default=0.0)
        left = min(max(sign.right - _MARKS[0] * high, begin), sign.x)
        return Rect(left, sign.y, sign.right - left, _MARKS[1] * high)

    def hint(self, arrangement: Arrangement) -> Rect:
        """Return where the hint bar stands: at the stage's foot or head, on nothing, as wide as possible.

        A rectangle of width 0 where there is no room.
        """
        size, stage = arrangement.layout.small_size, self._edges(arrangement)
        shapes = ((min(wide * size, stage.width), 1.6 * size) for wide in _HINTS)
        return self.free(arrangement, shapes) or Rect(stage.x, stage.bottom, 0.0, 0.0)

    def free(self, arrangement: Arrangement, shapes: Iterable[tuple[float, float]]) -> Rect | None:
        """Return a free place for the first of some sizes, at the stage's foot or head; None without one."""
        parts, stage = arrangement.layout, self._edges(arrangement)
        others = [one for one in (parts.hud, parts.legend, parts.marks) if one]
        for wide, high in shapes:
            if wide > stage.width or high > stage.height:
                continue
            across, down = stage.width - wide, stage.height - high
            rects = (
                Rect(stage.x + right * across, stage.y + low * down, wide, high)
                for low, right in product((1, 0), (1.0, 0.0, 0.5))
            )
            free = [rect for rect in rects if not any(rect.meets(one) for one in others)]
            if clear := self._clear(free, arrangement.view, 0):
                return clear
        return None

    def _clear(self, rects: Sequence[Rect], view: View, size: int) -> Rect | None:
        """Return the first rectangle in which nothing is drawn; None where there is none."""
        views = np.array(view.scale), np.array(view.x), np.array(view.y)
        drawn = self._drawn_in(rects, views, size) if rects else ()
        return next((rect for rect, taken in zip(rects, drawn, strict=True) if not taken), None)

    def _edges(self, arrangement: Arrangement) -> Rect:
        return arrangement.layout.stage.inset(6 * arrangement.layout.unit)

    def view(self, scale: float, at: tuple[float, float]) -> View:
        """Return the view of a scale; `at` is how far right and down it stands in the room left (0 to 1)."""
        left, top, right, bottom = self._extent(scale)
        x = self.room.x - left + at[0] * (self.room.width - (right - left))
        return View(scale, x, self.room.y - top + at[1] * (self.room.height - (bottom - top)))

    def _views(self, scales: Sequence[float]) -> Views:
        """Return the views (scales, places) in which the scene gives way to the words."""
        extents = np.array([self._extent(scale) for scale in scales])
        left, top, right, bottom = extents.T[:, :, None]
        across, down = np.array(_PLACES).T
        x = self.room.x - left + across * (self.room.width - (right - left))
        y = self.room.y - top + down * (self.room.height - (bottom - top))
        return np.array(scales)[:, None], x, y

    def _corner(self, block: WordBlock) -> tuple[float, float] | None:
        """Return where words stand; None where they have no room beside the sign of a pause."""
        stage = self.parts.stage.inset(self.parts.margin)
        place = stage.x, stage.y
        if block.width > stage.width or block.height > stage.height:
            return None
        return None if any(one.meets(self.sign) for one in block.rects_at(place)) else place

    def _drawn_in(self, rects: Sequence[Rect], views: Views, size: int) -> NDArray[np.bool_]:
        """Return whether anything is drawn in rectangles, in each view (..., rectangles)."""
        return drawn_in(rects, self.sweep, views, self.gauge, 0.5 * size)

    def _extent(self, scale: float) -> tuple[float, float, float, float]:
        """Return left, top, right and bottom of what is drawn, in pixels from the scene's origin."""
        return (
            min(scale * box.left - reach for box, reach in self._reaches),
            min(-scale * box.high - reach for box, reach in self._reaches),
            max(scale * box.right + reach for box, reach in self._reaches),
            max(-scale * box.low + reach for box, reach in self._reaches),
        )

    def _largest(self, bare: float) -> float:
        """Return the largest scale at which all that is drawn lies in the room."""
        scale = bare
        for (one, before), (other, after) in product(self._reaches, repeat=2):
            around = before + after
            for length, room in (
                (other.right - one.left, self.room.width),
                (other.high - one.low, self.room.height),
            ):
                if length > 0:
                    scale = min(scale, max(room - around, 1.0) / length)
        return scale


def drawn_in(
    rects: Sequence[Rect], sweep: Sweep, views: Views, thick: Gauge, gap: float = 0.0
) -> NDArray[np.bool_]:
    """Return whether anything is drawn within `gap` of rectangles, in each view (..., rectangles)."""
    left, top, right, bottom = np.array([(one.x, one.y, one.right, one.bottom) for one in rects]).T
    scale, x, y = (one[..., None] for one in views)
    _, bar, foot = (reach + gap for reach in thick.around)
    sides = (left - x) / scale, (y - bottom) / scale, (right - x) / scale, (y - top) / scale
    return sweep.touches(sides, bar / scale, foot / scale)


def _ways_through(shares: Sequence[float], group: Sequence[WordBlock]) -> list[tuple[float, int, int]]:
    """Return the cost and the indices of scale and words for each combination, the cheapest first."""
    choices = [
        (1.0 - share + _LINE * block.turns, step, turn)
        for (step, share), (turn, block) in product(enumerate(shares), enumerate(group))
    ]
    return sorted(choices, key=lambda choice: choice[0])


# A scene fitted into a window: measured once, and kept through pans, zooms and changes of theme.

_BETTER = 1.25
"""The factor by which a scene must be larger with its chart beside it for the chart to stand there."""
_MOST_KEPT = 24
"""The most arrangements of a subject that are kept."""
_WIDE_ENOUGH = 420
"""The least width of a window that has its chart beside the scene, in pixels."""


class FitRequest(NamedTuple):
    """The properties of a window and a look on which an arrangement depends."""

    size: tuple[int, int]
    charts: int
    """How many charts there are."""
    key_lines: int
    """How many lines the key to the colours has."""
    hud: bool
    docked: Docked = NOTHING_DOCKED
    polygons: int = 0
    """1 for both polygons, 2 for a large one."""
    table: tuple[int, float] = (0, 0.0)
    """How many rows a table beside the figure has, and how wide they are."""
    caption: bool = False
    still: bool = False
    """Whether it is of one pose, which keeps farther from the edge than a moving scene."""
    lined: bool = False
    """Whether that pose has dimension lines or arrows."""
    also: tuple[complex, ...] = ()
    """Further places, in the scene's unit, that the view has to include."""
    type_scale: float = 1.0

    @property
    def worded(self) -> bool:
        """Whether the rows of words are shown; an open list takes their place."""
        return self.hud and not self.docked.listed


def request_of(
    size: tuple[int, int], look: Look, charts: int, docked: Docked, *, still: bool = False
) -> FitRequest:
    """Return what an arrangement depends on, for a look with that number of charts."""
    keys, polygons = key_lines(look), look.polygons_shown
    captioned = look.caption and not docked.listed
    request = FitRequest(size, charts, keys, look.hud, docked, polygons, caption=captioned)
    lined = still and (look.names > 1 or bool(look.vectors))
    return request._replace(still=still, lined=lined, type_scale=look.type_scale)


@frozen
class Subject:
    """A scene's figure, and perhaps a second scene beside it: what both sweep, and the words about them."""

    figure: Figure
    beside: Scene | None
    type: Type

    @cached_property
    def sweep(self) -> Sweep:
        """What the scene and the one beside it sweep."""
        swept = sweep_of(self.figure)
        return swept | sweep_of(figure(self.beside)) if self.beside else swept

    @cached_property
    def rows(self) -> tuple[WidestRow, ...]:
        """The rows of words about them, at their widest; beside an open list there are none."""
        return widest_rows(self.scenes, self.type)

    @cached_property
    def arrangements(self) -> dict[FitRequest, Arrangement]:
        """The arrangements for the latest requests, since looks recur, and for looks that are expected."""
        return {}

    @cached_property
    def expected(self) -> list[Subject]:
        """The subjects that a key may put in place of this one."""
        return []

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scene, and the one beside it."""
        return (self.figure.scene, self.beside) if self.beside else (self.figure.scene,)


@frozen
class SceneFit:
    """A subject, and how it is arranged for a request."""

    subject: Subject
    request: FitRequest
    arrangement: Arrangement

    @cached_property
    def has_room(self) -> bool:
        """Whether all that is swept is within the scene's room."""
        room, view = self.arrangement.layout.stage, self.arrangement.view
        boxes = [one.box for one in (self.subject.figure, *map(figure, self.subject.scenes[1:]))]
        return all(
            room.x <= x <= room.right and room.y <= y <= room.bottom
            for box in boxes
            for x, y in (view.to_pixel(box.left, box.high), view.to_pixel(box.right, box.low))
        )

    def clear(self, places: tuple[Rect, ...]) -> tuple[bool, ...]:
        """Return for each of some places whether nothing is drawn there, all through the cycle."""
        if places not in self._clear:
            view, thick = self.arrangement.view, self.arrangement.gauge
            views = np.array(view.scale), np.array(view.x), np.array(view.y)
            drawn = drawn_in(places, self.subject.sweep, views, thick).tolist()
            self._clear.clear()
            self._clear[places] = tuple(not one for one in drawn)
        return self._clear[places]

    @cached_property
    def _clear(self) -> dict[tuple[Rect, ...], tuple[bool, ...]]:
        """The answer for the last places: they are asked for at every frame."""
        return {}

    def view_of(self, shown: Figure) -> View:
        """Return the view of the subject's figure; a figure on its way to it has the same scale and place."""
        view, whole = self.arrangement.view, self.subject.figure
        if shown is whole:
            return view
        wide, high = (shown.box.right - shown.box.left, shown.box.high - shown.box.low)
        spans = ((whole.box.right - whole.box.left, wide), (whole.box.high - whole.box.low, high))
        share = min((span / own for span, own in spans if own > 0), default=1.0)
        x, y = view.to_pixel(*whole.box.middle)
        across, up = shown.box.middle
        scale = view.scale * share
        return View(scale, x - scale * across, y + scale * up)


def fitted(
    scene: Scene,
    beside: Scene | None,
    request: FitRequest,
    type_: Type,
    *,
    before: SceneFit | None = None,
    held: bool = False,
    late: bool = False,
) -> SceneFit:
    """Return how a scene fits its picture, together with the scene beside it where there is one.

    What `before` has measured of the same scenes is reused, all of it where the request is the same. While a
    hand has `held` something, the scene that it changes keeps its view as long as it has room there, and in
    any case for a `late` frame.
    """
    known = before.subject if before else None
    if known is None or known.figure.scene is not scene or known.beside is not beside:
        expected = (one for one in (known.expected if known else ()) if one.figure.scene is scene)
        subject = next((one for one in expected if one.beside is beside), None)
        subject = subject or Subject(figure(scene), beside, type_)
    elif before and before.request == request and (late or not held or before.has_room):
        return before
    else:
        subject = known
    if held and before and before.request == request:
        stays = SceneFit(subject, request, before.arrangement)
        if late or stays.has_room:
            return stays
    return SceneFit(subject, request, at_once(arranging(subject, request)))


def arranging(subject: Subject, request: FitRequest) -> Generator[None, None, Arrangement]:
    """Return the arrangement with the chart where the scene is larger and more words have room.

    It is found in steps of a few milliseconds, and kept with the subject.
    """
    known = subject.arrangements
    if request not in known:
        _ = subject.sweep
        yield
        if request.worded:
            _ = subject.rows
            yield
        found = yield from _with_chart(subject, request, beside=False)
        if request.charts and request.size[0] >= _WIDE_ENOUGH:
            yield
            aside = yield from _with_chart(subject, request, beside=True)
            as_many = 2 * _row_count(aside) >= _row_count(found)
            found = aside if as_many and aside.view.scale > _BETTER * found.view.scale else found
        if len(known) >= _MOST_KEPT:
            known.clear()
        known[request] = found
    return known[request]


def _row_count(arrangement: Arrangement) -> int:
    """Return how many rows of words there are, and one for the title."""
    return 1 + len(arrangement.block.rows) if arrangement.block else 0


def _with_chart(subject: Subject, request: FitRequest, *, beside: bool) -> Generator[None, None, Arrangement]:
    type_ = subject.type
    parts = layout(
        request.size,
        chart=request.charts,
        beside=beside,
        listed=request.docked.listed,
        polygons=request.polygons,
        row=request.docked.row,
        bar=request.docked.bar,
        type_scale=request.type_scale,
    )
    head = 1.4 * parts.text_size if request.hud else 0.0
    parts = with_table(parts, *request.table, head) if request.table[0] else parts
    sentence = subject.figure.scene.look_at
    if request.caption:
        parts = with_caption(parts, len(caption_lines(parts, sentence, type_)))
    words: Iterable[Sequence[WordBlock]] = ()
    if request.worded:
        words = blocks(subject.scenes, subject.rows, parts, request.key_lines, type_)
    elif request.still and request.key_lines:  # a figure says how much its arrows stand for
        words = [[key_block(subject.figure.scene, parts, request.key_lines, type_)]]
    shapes = shapes_of(sentence, parts, type_) if request.worded and not parts.caption else ()
    edge = _EDGE_OF_STILL * parts.unit if request.still else None
    edge = _ROOM_FOR_LINES * parts.small_size if request.lined else edge
    sweep = subject.sweep
    if request.also:
        nothing = np.zeros(0, complex)
        sweep |= Sweep(nothing, nothing, np.array(request.also))
    return (yield from _arranging(parts, sweep, subject.figure.shortest, words, shapes, edge))
