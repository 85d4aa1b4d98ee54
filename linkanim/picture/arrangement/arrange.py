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

from linkanim.picture.arrangement.sweep import Sweep
from linkanim.picture.layout import Gauge, Layout, gauge
from linkanim.picture.panels.hud import WordBlock
from linkanim.picture.view import Box, Rect, View

HIGH, WIDE = 0.86, 0.7
"""The least share of the stage that a scene takes, of its height or of its width."""
_STEPS = 10
_CORNERS = (((0, 0), 0.0), ((1, 0), 0.05), ((0, 1), 0.06), ((1, 1), 0.08))
"""Left or right, top or bottom, and what it costs."""
_LINE = 0.03
"""What each further line of the title costs."""
_AWAY = (0.0, 0.25, 0.5)
"""How far the scene gives way to the words, in shares of the room that it leaves."""
_MARKS = (7.2, 2.5)
"""How wide and high the marks are, in sizes of the text."""
_HINTS = (27.0, 19.0, 13.0, 5.4)
"""How wide the hint bar may be, in sizes of its text: with all its words, and with ever fewer."""
_THINNEST = 0.68
"""What is drawn is no thinner than this on a small stage, in thicknesses of the whole window's."""
_EDGE = 9.0
"""From the stage's edge to what is drawn, in units."""


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
    found = (ways_.placed(*way[1:]) for group in blocks for way in ways_.ways(group))
    bare = Arrangement(parts, ways_.view(ways_.largest, (0.5, 0.5)), ways_.gauge, None)
    arrangement = next((one for one in found if one), bare)
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

    def ways(self, group: Sequence[WordBlock]) -> list[tuple[float, float, WordBlock, tuple[int, int]]]:
        """Return cost, scale, words and corner, the cheapest first."""
        share = min(self.least / self.largest, 1.0)
        scales = [1.0 - (1.0 - share) * step / _STEPS for step in range(_STEPS + 1)]
        ways = [
            (1.0 - scale + price + _LINE * block.turns, scale * self.largest, block, corner)
            for scale, block, (corner, price) in product(scales, group, _CORNERS)
        ]
        return sorted(ways, key=lambda way: way[0])

    def placed(self, scale: float, block: WordBlock, corner: tuple[int, int]) -> Arrangement | None:
        """Return the arrangement with the words in a corner, None where they would lie on the scene."""
        place = self._corner(block, corner)
        if place is None:
            return None
        for view in self._views(scale, corner):
            if not any(self._drawn_in(rect, view, block.size) for rect in block.rects_at(place)):
                hud, legend = block.parts_at(place)
                words = tuple(block.rects_at(place))
                parts = replace(self.parts, hud=hud, legend=legend, words=words)
                return Arrangement(parts, view, self.gauge, block)
        return None

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
        clear = (rect for rect in free if not self._drawn_in(rect, arrangement.view, high))
        return next(clear, (free or corners)[0])

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
        for (wide, high), low, right in product(shapes, (1, 0), (1.0, 0.0, 0.5)):
            at = stage.x + right * (stage.width - wide), stage.y + low * (stage.height - high)
            rect, beyond = Rect(*at, wide, high), wide > stage.width or high > stage.height
            taken = beyond or any(rect.meets(one) for one in others)
            if not (taken or self._drawn_in(rect, arrangement.view, 0)):
                return rect
        return None

    def _edges(self, arrangement: Arrangement) -> Rect:
        return arrangement.layout.stage.inset(6 * arrangement.layout.unit)

    def view(self, scale: float, at: tuple[float, float]) -> View:
        """Return the view of a scale, so far to the right and down in the room there is (0 to 1)."""
        left, top, right, bottom = self._extent(scale)
        x = self.room.x - left + at[0] * (self.room.width - (right - left))
        return View(scale, x, self.room.y - top + at[1] * (self.room.height - (bottom - top)))

    def _views(self, scale: float, corner: tuple[int, int]) -> Iterator[View]:
        """Yield views that give way to what is in a corner, the middle of the stage first."""
        for across, down in sorted(product(_AWAY, _AWAY), key=sum):
            away = (across * (1 - 2 * corner[0]), down * (1 - 2 * corner[1]))
            yield self.view(scale, (0.5 + away[0], 0.5 + away[1]))

    def _corner(self, block: WordBlock, corner: tuple[int, int]) -> tuple[float, float] | None:
        stage, wide, high = self.parts.stage.inset(self.parts.margin), block.width, block.height
        if wide > stage.width or high > stage.height:
            return None
        return stage.x + corner[0] * (stage.width - wide), stage.y + corner[1] * (stage.height - high)

    def _drawn_in(self, rect: Rect, view: View, size: int) -> bool:
        low, high = view.to_world(rect.x, rect.bottom), view.to_world(rect.right, rect.y)
        gap = 0.5 * size
        _, bar, foot = (reach + gap for reach in self.gauge.around)
        return self.sweep.touches(Box(*low, *high), bar / view.scale, foot / view.scale)

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
