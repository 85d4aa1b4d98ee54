"""The velocity and the acceleration polygon beside the linkage, to scale."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.polygons import Order, Side, Sort
from linkanim.picture.anchors import Way, pushed
from linkanim.picture.chart import Pen
from linkanim.picture.figure import Figure
from linkanim.picture.items import Caption, Group, Halo, Target
from linkanim.picture.motion_marks import SeenArrow
from linkanim.picture.placing import Alternatives, chosen, crossed, grounded
from linkanim.picture.quantities import round_step
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import arrows, disc, segments
from linkanim.picture.view import Box, Rect
from linkanim.units import three_digits
from linkanim.words import kept_as_said, said, to_say

_TITLES: dict[Order, tuple[str, str]] = {
    1: (to_say("velocity polygon"), "/s"),
    2: (to_say("acceleration polygon"), "/s²"),
}
_NOTHING = 1e-9
"""Share of a polygon's greatest extent below which a vector has no direction."""
_COINCIDING = 1e-3
"""How far apart arrows are that coincide, in pixels."""
_LABELLED = 0.8
"""The shortest vector that has its symbol beside it, in heights of the text."""
_SIDES = tuple(Way(share, turn, 0.12) for share in (0.5, 0.35, 0.65) for turn in (1j, -1j))
"""Where a symbol may stand beside its vector: by its middle, on either side."""
_AROUND = np.exp(0.25j * np.pi * np.arange(8))
"""The directions from the pole to its name."""
_MOMENTS = 24
"""The moments of a cycle at which symbols are looked at."""
_NOWHERE = -1e7
_BEYOND = 5.0
"""How far outside the polygon's place symbols may stand, in widths of a thin line."""
_TITLE = 0.6
"""The largest share of the width that a title takes beside the bar of the scale."""
_BARS = 5
"""The most bars of the scale that fit into the width."""
_LARGEST = 1e300
"""The most pixels for a unit: with more the bar of the scale would stand for less than a float can hold."""
_ROW = 1.2
"""The step from row to row of a list, in heights of its text."""
_GUIDED: frozenset[Sort] = frozenset({"coriolis", "sliding"})


class Arrow(NamedTuple):
    """A side of a polygon, in pixels."""

    side: Side
    foot: complex
    reach: complex

    @property
    def seen(self) -> SeenArrow:
        """The arrow with its symbol."""
        return SeenArrow(self.side.symbol, self.foot, self.reach)

    @property
    def is_absolute(self) -> bool:
        """Whether it is a vector from the pole."""
        return self.side.sort == "absolute"

    def is_on(self, other: Arrow) -> bool:
        """Return whether the two coincide, as a vector and its only part do."""
        return abs(self.foot - other.foot) + abs(self.reach - other.reach) < _COINCIDING


@frozen
class Polygon:
    """One polygon of a figure in its place: all poses of the cycle at one scale, about one pole.

    With a `moment` the scale lets the pose at that phase, the one `shown`, fill the place. Vectors without
    room for their symbols are then listed in a corner or, where no corner is free, in a column of width
    `aside` beside the polygon; of too many the largest ones, and none unless it `lists` them. `says` is what
    the bar of the scale says besides its length, where it has room.
    """

    figure: Figure
    order: Order
    rect: Rect
    pen: Pen
    moment: float | None = None
    shown: Pose | None = None
    aside: float = 0.0
    says: str = ""
    lists: bool = True

    def standing(self, phase: float) -> Polygon:
        """Return the polygon at the scale at which the pose at a phase fills its place; its bar says so."""
        return replace(self, moment=phase, says=said("at this pose"))

    def group(self, pose: Pose) -> Group:
        """Return the polygon of a pose with its title and the bar of its scale."""
        if self.moment is not None and self.shown is None:
            return replace(self, shown=pose).group(pose)
        words, per = _TITLES[self.order]
        scale = self.scale(pose.input_speed)
        pole = self.pole(pose.input_speed)
        drawn = self._arrows(pose, pole, scale)
        dot = Layer(self.pen.theme.ink, [pole + disc(1.8 * self.pen.line)])
        symbols, unnamed = self._symbols(drawn, pole)
        layers, captions = [*self._drawn(drawn), dot], [self._title, *symbols]
        if scale > 0 and unnamed and self.shown is not None and self.lists:
            every = self._rows(unnamed, scale, per)
            wide = self._widest(every)
            if not self.aside and not self._corner(every, wide, drawn, symbols)[1]:
                return replace(self, aside=min(wide + self.pen.small, 0.5 * self.rect.width)).group(pose)
            for most in range(len(every), min(len(unnamed), 2) - 1, -1):
                rows = self._rows(unnamed, scale, per, most)
                corner, free = self._corner(rows, self._widest(rows), drawn, symbols)
                if free:
                    captions += self._listed(rows, corner)
                    break
            else:
                return replace(self, aside=0.0, lists=False).group(pose)
        if scale > 0:
            bar, meaning = self._bar(scale, per)
            layers.append(bar)
            captions.append(meaning)
        if not drawn:
            at_rest = np.isfinite([side.end for side in self.figure.polygon_sides(pose, self.order)]).all()
            why = said("all at rest") if at_rest else said("unbounded here")
            at = (pole.real, pole.imag + 0.6 * self.pen.small)
            captions.append(Caption(why, at, self.pen.small, self.pen.theme.dim, "centre"))
        targets = (Target("polygon", self.rect, self.order),)
        return Group(words.replace(" ", "-"), layers, captions, targets=targets)

    @cached_property
    def _title(self) -> Caption:
        """The title, as large as its place is wide."""
        pen, words = self.pen, said(_TITLES[self.order][0])
        sizes = range(pen.text, 7, -1)
        size = next((one for one in sizes if pen.type.width(words, one) <= self.rect.width), 8)
        return Caption(words, (self.rect.x, self.rect.y), size, pen.theme.ink)

    @property
    def _barred(self) -> bool:
        """Whether the bar of the scale stands beside the title; else it stands at the foot."""
        return self._title.around(self.pen.type).width <= self._beside_bar

    @property
    def _beside_bar(self) -> float:
        """How wide a title may be beside the bar of the scale."""
        return min(_TITLE * self.rect.width, self.rect.width - self._usual - 0.5 * self.pen.small)

    @property
    def _usual(self) -> float:
        """The usual width of the words at the bar of the scale."""
        per = _TITLES[self.order][1]
        return self.pen.type.width(f"1000 {self.figure.scene.length_unit}{per}", self.pen.small)

    def scale(self, speed: float) -> float:
        """Return pixels for one unit of length and second at this input speed; 0 where nothing moves or fits.

        It depends on the speed alone, so that a polygon's size shows where the motion is fast.
        """
        faster = 1.0 if self.shown else abs(speed / self.figure.linkage.drive.speed) ** self.order
        box, room = self._box, self._room
        spans = [(room.width, box.right - box.left), (room.height, box.high - box.low)]
        shares = [have / need for have, need in spans if need > 0]
        scale = min(shares) / faster if shares and faster > 0 else 0.0
        return scale if 0.0 < scale < _LARGEST and self.rect.width >= 1.0 else 0.0

    def pole(self, speed: float) -> complex:
        """Return where the pole stands, so that all poses of the cycle have room."""
        box, room = self._box, self._room
        backwards = not self.shown and self.order == 1 and speed * self.figure.linkage.drive.speed < 0
        across, up = box.middle if not backwards else (-box.middle[0], -box.middle[1])
        scale = self.scale(self.figure.linkage.drive.speed)
        return complex(room.x + room.width / 2 - scale * across, room.y + room.height / 2 + scale * up)

    @property
    def _room(self) -> Rect:
        """The part of its place that symbols, title and foot leave to the vectors."""
        rect, side, top = self.rect, 1.6 * self.pen.small, 2.4 * self.pen.text
        foot = (1.2 if self._barred else 2.8) * self.pen.small
        width, height = max(rect.width - 2 * side - self.aside, 1.0), max(rect.height - top - foot, 1.0)
        return Rect(rect.x + side, rect.y + top, width, height)

    @cached_property
    def _box(self) -> Box:
        """The box of the cycle's polygons about the pole, at the scene's own speed."""
        ends = np.concatenate([np.atleast_1d(side.end) for side in self._sides])
        ends = np.append(ends[np.isfinite(ends)], 0.0)
        x, y = ends.real, ends.imag
        return Box(float(x.min()), float(y.min()), float(x.max()), float(y.max()))

    @cached_property
    def _sides(self) -> list[Side]:
        """The vectors of the pose that is shown, or of the whole cycle."""
        scene, pose = self.figure.scene, self.shown
        if self.moment is not None and pose is None:
            pose = scene.pose(self.moment, speed=scene.linkage.drive.speed)
        return (
            self.figure.polygon_sides(pose, self.order) if pose else self.figure.cycle_sides[self.order - 1]
        )

    def _arrows(self, pose: Pose, pole: complex, scale: float) -> list[Arrow]:
        """Return the arrows in pixels: all that have a length; none at all where one is unbounded."""
        sides = self.figure.polygon_sides(pose, self.order)
        if not np.isfinite([side.end for side in sides]).all():
            return []
        arrows_drawn = [
            Arrow(side, pole + scale * side.begin.conjugate(), scale * (side.end - side.begin).conjugate())
            for side in sides
        ]
        whole = [arrow for arrow in arrows_drawn if arrow.is_absolute]
        parts = [arrow for arrow in arrows_drawn if not any(arrow.is_on(other) for other in whole)]
        return [arrow for arrow in (*whole, *parts) if abs(arrow.reach) > _NOTHING * self._room.width]

    def _tracks(
        self, count: int, step: int, pole: complex, scale: float
    ) -> dict[tuple[str, Sort], tuple[Loop, Loop]]:
        """Return foot and reach of the arrows at every which of `count` phases, in pixels, by what they are.

        Absolute ones come first. One that is not drawn has its foot far away, and no length.
        """
        tracks: dict[tuple[str, Sort], tuple[Loop, Loop]] = {}
        bounded = np.ones(len(range(0, count, step)), np.bool_)
        for side in sorted(self._sides, key=lambda one: one.sort != "absolute"):
            begin, end = (np.broadcast_to(one, (count,))[::step] for one in (side.begin, side.end))
            bounded = bounded & np.isfinite(end)
            foot, reach = pole + scale * np.conj(begin), scale * np.conj(end - begin)
            tracks.setdefault((side.symbol, side.sort), (foot, reach))
        whole = [track for (_, sort), track in tracks.items() if sort == "absolute"]
        for key, (foot, reach) in tracks.items():
            drawn = bounded & (np.abs(reach) > _NOTHING * self._room.width)
            for other in whole if key[1] != "absolute" else ():
                drawn &= np.abs(foot - other[0]) + np.abs(reach - other[1]) >= _COINCIDING
            tracks[key] = np.where(drawn, foot, _NOWHERE), np.where(drawn, reach, 0)
        return tracks

    def _drawn(self, drawn: list[Arrow]) -> Iterator[Layer]:
        """Yield the arrows, relative ones first."""
        for arrow in sorted(drawn, key=lambda arrow: arrow.is_absolute):
            width = (1.6 if arrow.is_absolute else 1.1) * self.pen.line
            yield Layer(self._colour(arrow.side.sort), arrows([arrow.foot], [arrow.reach], width))

    def _colour(self, sort: Sort) -> Colour:
        theme = self.pen.theme
        if sort == "absolute":
            return theme.velocity if self.order == 1 else theme.acceleration
        return theme.traces[0] if sort in _GUIDED else theme.dim

    def _symbols(self, drawn: list[Arrow], pole: complex) -> tuple[list[Caption], list[Arrow]]:
        """Return the name of the pole and the symbols beside their vectors; and vectors that have none.

        A symbol stands on one side of its vector all through the cycle. Where it would lie on another there,
        or where its vector is shorter than the symbol is high, it is left out.
        """
        pen, small, room = self.pen, self.pen.small, self._within
        origin, (way, ways) = "o_{v}" if self.order == 1 else "o_{a}", self._ways
        size = (float(pen.type.width(origin, small)), float(small))
        at = pole + pushed(way, 2.4 * pen.line, size, False)
        captions, taken, unnamed = (
            [self._written(origin, at, pen.theme.ink)],
            [*self._words, _rect(at, size)],
            [],
        )
        for arrow in sorted(drawn, key=lambda arrow: (not arrow.is_absolute, -abs(arrow.reach))):
            symbol = arrow.side.symbol
            size = (float(pen.type.width(symbol, small)), float(small))
            way_ = ways.get((symbol, arrow.side.sort))
            middle = way_.middle(arrow.seen, size) if way_ else 0j
            rect = _rect(middle, size)
            inside = room.holds(rect.x, rect.y) and room.holds(rect.right, rect.bottom)
            short = abs(arrow.reach) < _LABELLED * small
            if way_ is None or short or not inside or any(rect.meets(one) for one in taken):
                unnamed.append(arrow)
                continue
            taken.append(rect)
            captions.append(self._written(symbol, middle, self._colour(arrow.side.sort)))
        return captions, unnamed

    @property
    def _within(self) -> Rect:
        """The room of symbols: it ends some thin lines before the picture does, so that none is cut there."""
        return self.rect.inset(-min(self.pen.text, _BEYOND * self.pen.line))

    @cached_property
    def _ways(self) -> tuple[complex, dict[tuple[str, Sort], Way]]:
        """The direction from the pole to its name, and where symbols stand beside their vectors.

        They are chosen for the pose that is shown, or for the cycle.
        """
        pen, small = self.pen, self.pen.small
        speed = self.figure.linkage.drive.speed
        pole, phases = self.pole(speed), 1 if self.shown else len(self.figure.cycle.phase)
        step = max(phases // _MOMENTS, 1)
        tracks, count = self._tracks(phases, step, pole, self.scale(speed)), len(range(0, phases, step))
        ends = [np.stack([foot, foot + reach], axis=1) for foot, reach in tracks.values()]
        lines = np.stack(ends, axis=1) if ends else np.zeros((count, 0, 2), np.complex128)
        ground = grounded(self._within, [*self._words])
        ground = ground._replace(bars=lines, thick=np.full(len(ends), pen.line))
        origin = "o_{v}" if self.order == 1 else "o_{a}"
        size = (float(pen.type.width(origin, small)), float(small))
        round_ = np.array([[pole + pushed(complex(way), 2.4 * pen.line, size, False) for way in _AROUND]])
        choices = [Alternatives(size, np.repeat(round_, count, axis=0), 0.02 * np.arange(8.0), most=1.0)]
        for number, ((symbol, _), (foot, reach)) in enumerate(tracks.items(), start=2):
            size = (float(pen.type.width(symbol, small)), float(small))
            hidden = np.abs(reach) < _LABELLED * small
            places = np.stack([way.middles(foot, reach, size) for way in _SIDES], axis=1)
            places[hidden] = _NOWHERE * number
            price = np.asarray(0.05 * np.arange(len(_SIDES)), np.float64)
            choices.append(Alternatives(size, places, price, excused=hidden, most=1.0))
        pole_way, *ways = chosen(choices, ground)
        sides = {key: _SIDES[n] for key, n in zip(tracks, ways, strict=True) if n is not None}
        return complex(_AROUND[pole_way or 0]), sides

    def _written(self, words: str, at: complex, colour: Colour) -> Caption:
        """Return a name about a place."""
        pen, halo = self.pen, Halo(self.pen.theme.background, 0.1 * self.pen.small)
        return Caption(words, (at.real, at.imag - pen.small / 2), pen.small, colour, "centre", halo=halo)

    @property
    def _words(self) -> Iterator[Rect]:
        """The rectangles of the title, and of the bar of the scale with its meaning."""
        title, small, rect = self._title, self.pen.small, self.rect
        yield title.around(self.pen.type)
        said = self.pen.type.width(f" {self.says}", small) if self.says else 0.0
        wide = max((1 - _TITLE) * rect.width, self._usual + said)
        if self._barred:
            yield Rect(rect.right - wide, rect.y, wide, 2.0 * small)
        else:
            yield Rect(rect.x, rect.bottom - 2.1 * small, wide, 2.1 * small)

    def _widest(self, rows: list[tuple[str, Colour]]) -> float:
        return max(self.pen.type.width(text, self.pen.small) for text, _ in rows)

    def _rows(
        self, unnamed: list[Arrow], scale: float, per: str, most: int | None = None
    ) -> list[tuple[str, Colour]]:
        """Return symbols and sizes of vectors without a symbol beside them: the largest, `most` of them.

        Without `most` these are as many as have room below each other.
        """
        rows, unit_ = list[tuple[str, Colour]](), f"{self.figure.scene.length_unit}{per}"
        room = max(int((self.rect.height - 2.4 * self.pen.text) / (_ROW * self.pen.small)), 1)
        most = room if most is None else min(most, room)
        listed = (
            sorted(unnamed, key=lambda arrow: -abs(arrow.reach))[: most - 1]
            if len(unnamed) > most
            else unnamed
        )
        for arrow in listed:
            size = abs(arrow.reach) / scale
            words = f"{arrow.side.symbol} = {three_digits(size) if size >= 1e-3 else '0'} {unit_}"
            rows.append((words, self._colour(arrow.side.sort)))
        if len(listed) < len(unnamed):
            rows.append((said("and {count} smaller", count=len(unnamed) - len(listed)), self.pen.theme.dim))
        return rows

    def _corner(
        self, rows: list[tuple[str, Colour]], wide: float, drawn: list[Arrow], named: list[Caption]
    ) -> tuple[Rect, bool]:
        """Return the corner for these rows in which least is drawn, and whether it is free."""
        rect, high = self.rect, _ROW * self.pen.small * len(rows)
        low, top = rect.bottom - high, rect.y + 2.4 * self.pen.text
        corners = [Rect(x, y, wide, high) for y in (low, top) for x in (rect.right - wide, rect.x)]
        ends = [(arrow.foot, arrow.foot + arrow.reach) for arrow in drawn]
        busy = [line.around(self.pen.type) for line in named] + [*self._words]
        corners = corners[::2] if self.aside else corners
        places = np.array([[corner.middle for corner in corners]])
        lines = np.array([ends], np.complex128).reshape(1, -1, 2)
        covered = crossed(places, (wide, high), lines, np.zeros(len(ends))).sum(axis=2)[0]
        covered += [sum(corner.meets(one) for one in busy) for corner in corners]
        return corners[int(covered.argmin())], not covered.all()

    def _listed(self, rows: list[tuple[str, Colour]], corner: Rect) -> Iterator[Caption]:
        small = self.pen.small
        for n, (words, colour) in enumerate(rows):
            yield Caption(words, (corner.x, corner.y + _ROW * n * small), small, colour)

    def _bar(self, scale: float, per: str) -> tuple[Layer, Caption]:
        """Return the bar of the scale, beside the title or at the foot, and its words."""
        rect, small, ink = self.rect, self.pen.small, self.pen.theme.ink
        step = round_step(rect.width / scale, _BARS)
        long, tick = step * scale, 0.35j * small
        if self._barred:
            begin, top = complex(rect.right - long, rect.y + 1.75 * small), rect.y
        else:
            begin, top = complex(rect.x, rect.bottom - 0.5 * small), rect.bottom - 2.0 * small
        end = begin + long
        feet, heads = [begin, begin - tick, end - tick], [end, begin + tick, end + tick]
        number = f"{step:g}" if 1e-3 <= step < 1e6 else three_digits(step)
        words = f"{number} {self.figure.scene.length_unit}{per}"
        whole = f"{words} {self.says}"
        taken = self._title.around(self.pen.type).width + self.pen.text if self._barred else 0.0
        words = whole if self.says and self.pen.type.width(whole, small) <= rect.width - taken else words
        bar = Layer(ink, segments(feet, heads, 0.8 * self.pen.line))
        if self._barred:
            return bar, Caption(words, (rect.right, top), small, ink, "right")
        return bar, Caption(words, (rect.x, top), small, ink)


def _rect(middle: complex, size: tuple[float, float]) -> Rect:
    """Return the rectangle of a size about a place."""
    return Rect(middle.real - size[0] / 2, middle.imag - size[1] / 2, *size)


@kept_as_said(4)
def polygons_of(
    figure: Figure, rect: Rect, pen: Pen, moment: float | None = None, *, only: int = 0
) -> tuple[Polygon, ...]:
    """Return both polygons in a rectangle: over each other where it is tall, else side by side.

    With `only` 1 or 2 it is the velocity or the acceleration polygon alone.
    """
    if only:
        return (Polygon(figure, 1 if only == 1 else 2, rect, pen, moment),)
    if rect.height >= rect.width:
        first = rect._replace(height=0.48 * rect.height)
        second = first._replace(y=rect.bottom - first.height)
    else:
        first = rect._replace(width=0.48 * rect.width)
        second = first._replace(x=rect.right - first.width)
    return Polygon(figure, 1, first, pen, moment), Polygon(figure, 2, second, pen, moment)
