"""The arrangement: the scene as large as its stage lets it be, and the words where its motion leaves room.

Words go into a corner. Of all ways to put them there the one is taken that costs least: a smaller scene, a
title in more lines and a corner that is looked at later cost something. The scene keeps to its least
size, `HIGH` of the stage's height or `WIDE` of its width; before it gets smaller, words get smaller, and
before they get too small to read, the least important ones are left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.arrangement.sweep import Numbers, Sweep
from linkanim.picture.layout import Gauge, Layout, gauge
from linkanim.picture.panels.hud import WordBlock
from linkanim.picture.view import Rect, View

HIGH, WIDE = 0.86, 0.7
"""The least share of the stage that a scene takes, of its height or of its width."""
_STEPS = 10
_CORNERS = (((0, 0), 0.0), ((1, 0), 0.05), ((0, 1), 0.06), ((1, 1), 0.08))
"""Left or right, top or bottom, and what it costs."""
_LINE = 0.03
"""What each further line of the title costs."""
_AWAY = (0.0, 0.25, 0.5)
"""How far the scene gives way to the words, in shares of the room that it leaves."""
_WAYS = tuple(sorted(product(_AWAY, _AWAY), key=sum))
"""Across and down, the middle of the stage first."""
_MARKS = (7.2, 2.5)
"""How wide and high the marks are, in sizes of the text."""
_HINTS = (27.0, 19.0, 13.0, 5.4)
"""How wide the hint bar may be, in sizes of its text: with all its words, and with ever fewer."""
_THINNEST = 0.68
"""What is drawn is no thinner than this on a small stage, in thicknesses of the whole window's."""
_EDGE = 9.0
"""From the stage's edge to what is drawn, in units."""


Corner = tuple[int, int]
Views = tuple[Numbers, Numbers, Numbers]
"""Scales of views, and x and y of their origins, all of one shape."""


@dataclass(frozen=True)
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
) -> Arrangement:
    """Return the arrangement of a scene that sweeps this, its `shortest` bar in the scene's unit.

    `blocks` are the words, set in several ways: the first group of which one finds its place is taken.
    `shapes` are those of the sentence that is shown for a while, the best first.
    """
    ways_ = _WaysToArrange(parts, sweep, shortest)
    found = (one for group in blocks for one in ways_.placed(group))
    bare = Arrangement(parts, ways_.view(ways_.largest, (0.5, 0.5)), ways_.gauge, None)
    arrangement = next(found, bare)
    marked = replace(arrangement, layout=replace(arrangement.layout, marks=ways_.marks(arrangement)))
    hinted = replace(marked, layout=replace(marked.layout, hint=ways_.hint(marked)))
    return replace(hinted, layout=replace(hinted.layout, passing=ways_.free(hinted, shapes)))


class _WaysToArrange:
    """What all ways to arrange one scene have in common."""

    def __init__(self, parts: Layout, sweep: Sweep, shortest: float) -> None:
        self.parts, self.sweep = parts, sweep
        self.room = parts.stage.inset(_EDGE * parts.unit)
        box = sweep.box
        self._wide, self._high = max(box.right - box.left, 1e-12), max(box.high - box.low, 1e-12)
        extended = max(self._wide, self._high) > 1e-12
        bare = min(self.room.width / self._wide, self.room.height / self._high) if extended else 1.0
        share = min(parts.stage.width / parts.size[0], parts.stage.height / parts.size[1])
        self.gauge = gauge(parts.unit * max(share, _THINNEST), shortest * bare)
        self._reaches = [(box, self.gauge.around[kind]) for box, kind in sweep.parts]
        self.largest = self._largest(bare)
        self.least = min(HIGH * parts.stage.height / self._high, WIDE * parts.stage.width / self._wide)
        share = min(self.least / self.largest, 1.0)
        self._shares = [1.0 - (1.0 - share) * step / _STEPS for step in range(_STEPS + 1)]
        self._scales = [share * self.largest for share in self._shares]

    def placed(self, group: Sequence[WordBlock]) -> Iterator[Arrangement]:
        """Yield arrangements with one of the group's words in a corner, off the scene, the cheapest first."""
        clear: dict[tuple[int, Corner], NDArray[np.bool_]] = {}
        for _, step, turn, corner in self._ways(group):
            place, block = self._corner(group[turn], corner), group[turn]
            if place is None:
                continue
            if (turn, corner) not in clear:
                drawn = self._drawn_in([*block.rects_at(place)], self._views(corner), block.size)
                clear[turn, corner] = np.logical_not(drawn.any(axis=-1))
            views = clear[turn, corner][step]
            if views.any():
                hud, legend = block.parts_at(place)
                words = tuple(block.rects_at(place))
                parts = replace(self.parts, hud=hud, legend=legend, words=words)
                view = self.view(self._scales[step], _places(corner)[int(views.argmax())])
                yield Arrangement(parts, view, self.gauge, block)

    def _ways(self, group: Sequence[WordBlock]) -> list[tuple[float, int, int, Corner]]:
        """Return cost, number of the scale and of the words, and corner, the cheapest first."""
        ways = [
            (1.0 - share + price + _LINE * block.turns, step, turn, corner)
            for (step, share), (turn, block), (corner, price) in product(
                enumerate(self._shares), enumerate(group), _CORNERS
            )
        ]
        return sorted(ways, key=lambda way: way[0])

    def marks(self, arrangement: Arrangement) -> Rect:
        """Return where the marks stand: in the first corner without words, off the scene if there is one."""
        parts, high = arrangement.layout, arrangement.layout.text_size
        stage = parts.stage.inset(parts.margin)
        wide = min(_MARKS[0] * high, stage.width)
        corners = [
            Rect(
                stage.x + right * (stage.width - wide),
                stage.y + low * (stage.height - _MARKS[1] * high),
                wide,
                _MARKS[1] * high,
            )
            for right, low in ((1, 0), (0, 0), (1, 1), (0, 1))
        ]
        free = [
            rect
            for rect in corners
            if not any(rect.meets(words) for words in (parts.hud, parts.legend) if words)
        ]
        return self._clear(free, arrangement.view, high) or (free or corners)[0]

    def hint(self, arrangement: Arrangement) -> Rect:
        """Return where the hint bar stands: at the stage's foot or head, on nothing, as wide as it can be.

        Nowhere is a rectangle without width.
        """
        size, stage = arrangement.layout.small_size, self._edges(arrangement)
        shapes = ((min(wide * size, stage.width), 1.6 * size) for wide in _HINTS)
        return self.free(arrangement, shapes) or Rect(stage.x, stage.bottom, 0.0, 0.0)

    def free(self, arrangement: Arrangement, shapes: Iterable[tuple[float, float]]) -> Rect | None:
        """Return the first of some shapes at the stage's foot or head that lies on nothing; None for none."""
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
        """Return the first rectangle in which nothing is drawn; None for none."""
        views = np.array(view.scale), np.array(view.x), np.array(view.y)
        drawn = self._drawn_in(rects, views, size) if rects else ()
        return next((rect for rect, taken in zip(rects, drawn, strict=True) if not taken), None)

    def _edges(self, arrangement: Arrangement) -> Rect:
        return arrangement.layout.stage.inset(6 * arrangement.layout.unit)

    def view(self, scale: float, at: tuple[float, float]) -> View:
        """Return the view of a scale, so far to the right and down in the room there is (0 to 1)."""
        left, top, right, bottom = self._extent(scale)
        x = self.room.x - left + at[0] * (self.room.width - (right - left))
        return View(scale, x, self.room.y - top + at[1] * (self.room.height - (bottom - top)))

    def _views(self, corner: Corner) -> Views:
        """Return the views (scales, places) that give way to what is in a corner."""
        extents = np.array([self._extent(scale) for scale in self._scales])
        left, top, right, bottom = extents.T[:, :, None]
        across, down = np.array(_places(corner)).T
        x = self.room.x - left + across * (self.room.width - (right - left))
        y = self.room.y - top + down * (self.room.height - (bottom - top))
        return np.array(self._scales)[:, None], x, y

    def _corner(self, block: WordBlock, corner: Corner) -> tuple[float, float] | None:
        stage, wide, high = self.parts.stage.inset(self.parts.margin), block.width, block.height
        if wide > stage.width or high > stage.height:
            return None
        return stage.x + corner[0] * (stage.width - wide), stage.y + corner[1] * (stage.height - high)

    def _drawn_in(self, rects: Sequence[Rect], views: Views, size: int) -> NDArray[np.bool_]:
        """Return whether anything is drawn in rectangles, in each view (..., rectangles)."""
        left, top, right, bottom = np.array([(one.x, one.y, one.right, one.bottom) for one in rects]).T
        scale, x, y = (one[..., None] for one in views)
        gap = 0.5 * size
        _, bar, foot = (reach + gap for reach in self.gauge.around)
        sides = (left - x) / scale, (y - bottom) / scale, (right - x) / scale, (y - top) / scale
        return self.sweep.touches(sides, bar / scale, foot / scale)

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


def _places(corner: Corner) -> list[tuple[float, float]]:
    """Return how far to the right and down a scene stands that gives way to a corner, the middle first."""
    return [(0.5 + across * (1 - 2 * corner[0]), 0.5 + down * (1 - 2 * corner[1])) for across, down in _WAYS]
