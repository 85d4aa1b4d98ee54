"""One place for each label: near what it names, and clear of all else for as much of a cycle as possible.

Every label has a few places to choose from, each of which moves with what it names. It takes the place of the
least cost over the cycle: a place costs for being far, and most of all for touching what it must not touch.
At the moments at which it would still touch that, the label is hidden. A placed label is an obstacle for
those after it. On a picture of one moment, such as a chart or a figure, a label is shown there or not at all.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike, NDArray

from linkanim.frozen import NamedTuple, frozen
from linkanim.picture.raster import Loop
from linkanim.picture.shapes import lengths, units
from linkanim.picture.view import Rect

_Floats = NDArray[np.float64]
_Bools = NDArray[np.bool_]
Moments = slice | NDArray[np.intp]
"""Some of a cycle's moments."""

MOMENTS = 144
"""The moments of one drive period at which labels are checked for lying on something."""
_STEP = 4
"""Places are chosen by every fourth of these moments."""
_FORBIDDEN = 20.0
"""What a place costs at a moment at which it is forbidden; its price is added to the mean over the cycle."""
_BESIDE = 2.0
"""What it costs at a moment to lie on a solid that matters little to the label."""
_CROSSING, _THROUGH_LINK = 0.4, 0.8
"""What it costs a line to cross a solid, and what it costs in addition where that is a link."""
_THICK = 1.0
"""Half the assumed width of lines that go with labels, in pixels."""
_MOST_CROSSED = 1
"""A line crosses no more links than this."""
_NEARER = 1.0
"""By how much a word is nearer to its own dimension line than to any other, in pixels."""
_OFF_PINS = 2.0
"""How far a dimension's arrowheads keep from pins, in radii of a pin."""
_CHAINED = 0.5
"""Lines whose ends are within this distance of each other, in pixels, form a chain."""
_GONE = 3
"""How many moments before a label would lie on something it is hidden."""
_SOFT = 3
"""The number of moments over which a label fades out, and in again."""
_MANY = 500
"""With more pairs of a place and a solid than this, a few edges, or solids, are tried first."""
_EDGES = 4
"""One in this many of a shape's edges is tried first for separating the shape from a label."""
_SURE = 1e-6
"""By how much boxes for a first rough test are enlarged, in pixels, so that rounding loses nothing."""
_FIRST = 6
"""The number of solids that are tried first: in a crowded place these leave few places to the others."""


class Solid(NamedTuple):
    """What a thing covers: its convex shape, with corners (n moments, c) in order, and `half` around that.

    One corner is a disc, two are a bar. A solid that matters `little` is avoided only where that costs
    nothing.
    """

    corners: Loop
    half: float
    little: bool = False

    def at(self, moments: Moments) -> Solid:
        """Return the same at some of the moments."""
        return self._replace(corners=self.corners[moments]) if len(self.corners) > 1 else self


class Solids(NamedTuple):
    """m solids with equal numbers of corners: the corners (n or 1 moments, m, c), and `half` (m,)."""

    corners: Loop
    half: _Floats

    @classmethod
    def of(cls, solids: Sequence[Solid]) -> Solids:
        """Return solids with equal numbers of corners as one value."""
        corners = np.broadcast_arrays(*(solid.corners for solid in solids))
        return cls(np.stack(corners, axis=1), np.array([solid.half for solid in solids]))

    def picked(self, which: NDArray[np.intp]) -> Solids:
        """Return the solids at these indices."""
        return Solids(self.corners.take(which, axis=1), self.half[which])


@frozen
class Clutter:
    """What labels must not touch: all that is not `inside`, rectangles, and solids."""

    inside: Rect
    rects: tuple[Rect, ...] = ()
    solids: tuple[Solid, ...] = ()
    links: frozenset[int] = frozenset()
    """The numbers of the solids that are links."""
    pins: frozenset[int] = frozenset()
    """The numbers of the solids that are pins, on which no label may lie."""

    @cached_property
    def boxes(self) -> tuple[_Floats, ...]:
        """Left, right, top and bottom (n moments, m) of what each solid covers."""
        moments = max(len(solids.corners) for _, solids in self.alike)
        found = np.empty((4, moments, len(self.solids)))
        for numbers, (corners, half) in self.alike:
            for n, part in enumerate((corners.real, corners.imag)):
                found[2 * n][:, numbers] = part.min(axis=2) - half
                found[2 * n + 1][:, numbers] = part.max(axis=2) + half
        return tuple(found)

    @cached_property
    def alike(self) -> tuple[tuple[NDArray[np.intp], Solids], ...]:
        """The solids grouped by their number of corners, each group with the solids' numbers."""
        counts = np.array([solid.corners.shape[1] for solid in self.solids])
        groups = (np.flatnonzero(counts == count) for count in np.unique(counts))
        return tuple((group, Solids.of([self.solids[n] for n in group])) for group in groups)

    @cached_property
    def little(self) -> _Bools:
        """Whether each solid matters little."""
        return np.array([solid.little for solid in self.solids], np.bool_)

    @cached_property
    def some(self) -> Clutter:
        """The clutter at the moments by which places are chosen."""
        return self.at(slice(None, None, _STEP))

    def standing(self, label: LabelPlaces) -> Standing:
        """Return what is known of a label on a picture of one moment from this clutter alone."""
        self.learn([label])
        return self._of_labels[id(label)][1]

    def learn(self, labels: Sequence[LabelPlaces]) -> None:
        """Work out and keep what is known of labels, on a picture of one moment, from this clutter alone.

        It is kept because labels are tried in several orders. Many at once take little longer than one.
        """
        new = [label for label in labels if id(label) not in self._of_labels]
        if new:
            found = zip(new, _standings(new, self), strict=True)
            self._of_labels.update((id(label), (label, standing)) for label, standing in found)

    @cached_property
    def sizes(self) -> _Floats:
        """The widths and heights of the rectangles (2, m)."""
        return np.array([(rect.width, rect.height) for rect in self.rects]).reshape(-1, 2).T

    def has_place(self, label: LabelPlaces) -> bool:
        """Tell whether one of a label's places is free as long as no other label stands, at one moment."""
        standing = self.standing(label)
        taken = standing.forbidden[0]
        if label.drawn is not None:
            taken = taken | (label.drawn >= 0) & standing.barred[0, label.drawn]
        return not taken.all()

    @cached_property
    def _of_labels(self) -> dict[int, tuple[LabelPlaces, Standing]]:
        """What `learn` keeps, by the label's identity; the label is kept, too, so that its identity stays."""
        return {}

    def at(self, moments: Moments) -> Clutter:
        """Return the same at some of the moments."""
        return replace(self, solids=tuple(solid.at(moments) for solid in self.solids))


class LabelPlaces(NamedTuple):
    """A label: how large, and where its middle may stand at each of n moments (n, k), at which price.

    It may lie on the solids whose numbers are `own`, and rather not on those `beside` it. Some `lines` (n
    moments, lines, begin and end) are drawn with a place: those whose numbers stand in its row of `drawn`, -1
    for none. With a `gap` the first of them is a dimension line: such lines keep this distance, in pixels,
    from each other, and words from the lines of other labels.
    """

    size: tuple[float, float]
    places: Loop
    price: _Floats
    own: frozenset[int] = frozenset()
    beside: frozenset[int] = frozenset()
    lines: tuple[Loop, ...] = ()
    drawn: NDArray[np.int64] | None = None
    gap: float = 0.0

    def at(self, moments: Moments, which: slice = slice(None)) -> LabelPlaces:
        """Return the label with some of the moments and some of the places."""
        lines = tuple(line[moments] for line in self.lines)
        drawn = None if self.drawn is None else self.drawn[which]
        places, price = self.places[moments, which], self.price[which]
        return self._replace(places=places, price=price, lines=lines, drawn=drawn)


class Standing(NamedTuple):
    """What is known of a label's k places and g groups of lines at one moment, without other labels.

    Which places are `forbidden`, what each costs (1, k), and how far others' dimension lines must keep `off`;
    the lines (1, g, lines, 2), which groups are barred, and their price (1, g).
    """

    forbidden: _Bools
    cost: _Floats
    off: _Floats
    lines: Loop
    barred: _Bools
    price: _Floats


class Placed(NamedTuple):
    """The place that a label has, and its opacity at each moment (0 to 1)."""

    which: int
    shown: _Floats


class Placer:
    """Places one label after the other in a clutter, each off those before it."""

    def __init__(self, clutter: Clutter) -> None:
        self.clutter = clutter
        self._taken = np.array([[rect.middle for rect in clutter.rects]], np.complex128)
        self._sizes = np.array([(rect.width, rect.height) for rect in clutter.rects]).reshape(-1, 2).T
        self._lines = self._measures = np.zeros((1, 0, 2), np.complex128)
        self._far = np.zeros((1, len(clutter.rects)))
        """How far placed words are from their own dimension lines."""

    def first(
        self,
        labels: Sequence[LabelPlaces],
        enough: float = 1.0,
        *,
        least: float = 0.0,
        but: _Bools | None = None,
    ) -> tuple[int, Placed]:
        """Place the first of several forms of a label that shows for `enough` of the cycle, else the best.

        Shares of the cycle are 0 to 1. A label that would show for less than `least` is not shown at all.
        None shows at the moments `but`.
        """
        found = []
        for label in labels:
            found.append(self._found(label, but))
            if found[-1].shown.mean() >= enough:
                break
        best = max(range(len(found)), key=lambda n: float(found[n].shown.mean()))
        if found[best].shown.mean() < least:
            return best, found[best]._replace(shown=np.zeros_like(found[best].shown))
        self._take(labels[best], found[best])
        return best, found[best]

    def rest(self, label: LabelPlaces, covered: _Floats, *, on: frozenset[int]) -> Placed:
        """Place a label a second time, for the moments at which it is not `covered` (0 to 1) by the first.

        This time it may lie `on` the solids of these numbers, too.
        """
        label = label._replace(own=label.own | on)
        bare = np.flatnonzero(covered < 1.0)
        clutter = self.clutter if len(bare) == len(covered) else self.clutter.at(bare)
        cost = self._cost(label.at(bare), bare, clutter)
        which = int((label.price + cost.mean(axis=0)).argmin())
        cost = self._cost(label.at(slice(None), slice(which, which + 1)), slice(None), self.clutter)
        shown = _eased(cost[:, 0] >= _FORBIDDEN, _SOFT - _GONE)
        placed = Placed(which, np.minimum(shown, 1.0 - covered))
        self._take(label, placed)
        return placed

    def _found(self, label: LabelPlaces, but: _Bools | None) -> Placed:
        if len(label.places) == 1:
            return self._found_at_once(label, but)
        every = slice(None, None, _STEP)
        cost = self._cost(label.at(every), every, self.clutter.some)
        if but is not None:
            cost[but[every]] = 0.0
        which = int((label.price + cost.mean(axis=0)).argmin())
        cost = self._cost(label.at(slice(None), slice(which, which + 1)), slice(None), self.clutter)
        shown = _eased(cost[:, 0] >= _FORBIDDEN)
        return Placed(which, shown if but is None else shown * _eased(but, 0))

    def _found_at_once(self, label: LabelPlaces, but: _Bools | None) -> Placed:
        """Return the place of a label on a picture of one moment."""
        cost = self._cost(label, slice(None), self.clutter)
        wanted = label.price + (cost[0] if but is None or not but[0] else 0.0)
        which = int(wanted.argmin())
        shown = _eased(cost[:, which] >= _FORBIDDEN)
        return Placed(which, shown if but is None else shown * _eased(but, 0))

    def _take(self, label: LabelPlaces, placed: Placed) -> None:
        if placed.shown.any():
            self._taken = _joined(self._taken, label.places[:, placed.which : placed.which + 1])
            self._sizes = np.column_stack((self._sizes, label.size))
            number = -1 if label.drawn is None else int(label.drawn[placed.which])
            far = _from_own(label, slice(placed.which, placed.which + 1)) if label.gap else np.zeros((1, 1))
            self._far = np.concatenate(
                [
                    np.broadcast_to(one, (max(len(self._far), len(far)), one.shape[1]))
                    for one in (self._far, far)
                ],
                axis=1,
            )
            if number >= 0:
                self._lines = _joined(self._lines, label.lines[number])
            if number >= 0 and label.gap:
                self._measures = _joined(self._measures, label.lines[number][:, :1])

    def _cost(self, label: LabelPlaces, moments: Moments, clutter: Clutter) -> _Floats:
        """Return what each place costs at each moment: `_FORBIDDEN` where it touches what it must not."""
        places, size = label.places, label.size
        taken, lines, measures = (
            all_[moments] if len(all_) > 1 else all_ for all_ in (self._taken, self._lines, self._measures)
        )
        standing = clutter.standing(label) if len(places) == 1 else None
        forbidden = standing.forbidden if standing else ~_within(places, size, clutter.inside)
        forbidden = forbidden | _over(places[:, :, None] - taken[:, None], size, self._sizes).any(axis=2)
        if lines.shape[1]:
            forbidden |= _cut(places, size, lines, _THICK)
        if measures.shape[1]:
            off = standing.off if standing else _off_others(label)
            forbidden |= _cut(places, size, measures, off[..., None])
        cost = standing.cost.copy() if standing else _covering(label, clutter, forbidden)
        lined = np.flatnonzero((label.drawn >= 0) & ~forbidden.all(axis=0)) if label.drawn is not None else ()
        if label.drawn is not None and len(lined):
            used, which = np.unique(label.drawn[lined], return_inverse=True)
            far = self._far[moments] if len(self._far) > 1 else self._far
            if standing:
                barred, price = standing.barred[:, used], standing.price[:, used]
                open_ = np.flatnonzero(~barred[0])
                lines = standing.lines[:, used[open_]]
                barred[:, open_] = self._barred(lines, label.gap, taken, measures, far)
            else:
                groups = np.stack([label.lines[n] for n in used], axis=1)
                barred = self._barred(groups, label.gap, taken, measures, far)
                barred |= ~_within(groups, (2.0, 2.0), clutter.inside).all(axis=(2, 3))
                gapped = np.full(len(used), label.gap > 0)
                price = _pricing(groups[:, :, 0], clutter, barred, gapped)
            forbidden[:, lined] |= barred[:, which]
            cost[:, lined] += price[:, which]
        return np.asarray(cost + _FORBIDDEN * forbidden)

    def _barred(self, groups: Loop, gap: float, taken: Loop, measures: Loop, far: _Floats) -> _Bools:
        """Return whether groups of lines (n, g, lines, 2) touch other labels or their lines (n, g)."""
        barred = _met(groups, taken, self._sizes)
        if gap:
            firsts, nearer = groups[:, :, 0], np.maximum(far, gap)[..., None]
            barred |= _hits(taken, self._sizes, firsts, nearer).any(axis=1)
            barred |= _too_near(firsts, measures, gap)
        return barred


def _met(groups: Loop, middles: Loop, sizes: _Floats) -> _Bools:
    """Return whether groups of lines (n, g, lines, 2) touch boxes of these sizes about middles (n, g)."""
    moments, count, lines, _ = groups.shape
    hit = _hits(middles, sizes, groups.reshape(moments, count * lines, 2), _THICK).any(axis=1)
    return np.asarray(hit.reshape(-1 if count * lines else moments, count, lines).any(axis=2))


def _pricing(firsts: Loop, clutter: Clutter, barred: _Bools, gapped: _Bools) -> _Floats:
    """Return what lines (n, g, 2) cost for crossing solids (n, g), and set further lines in `barred`.

    Dimension lines, which are `gapped` (g,), may not end at a pin or cross many links.
    """
    barred |= gapped & _ends_at_pins(firsts, clutter)
    open_ = np.flatnonzero(~barred.all(axis=0))
    crossed, links = _crossings(firsts[:, open_], clutter)
    barred[:, open_] |= gapped[open_] & (links > _MOST_CROSSED)
    price = np.zeros(barred.shape)
    price[:, open_] = _CROSSING * crossed + _THROUGH_LINK * links
    return price


def _standings(labels: Sequence[LabelPlaces], clutter: Clutter) -> Iterator[Standing]:
    """Yield what is known of each label of one moment from the clutter alone."""
    counts = [label.places.shape[1] for label in labels]
    places = np.concatenate([label.places[0] for label in labels])
    size = np.repeat(np.array([label.size for label in labels]).T, counts, axis=1)
    middles = np.array([rect.middle for rect in clutter.rects], np.complex128)
    forbidden = ~_within(places, size, clutter.inside)
    forbidden |= _over(places[:, None] - middles, size[:, :, None], clutter.sizes).any(axis=1)
    wanted, minor = np.ones((2, len(labels), len(clutter.solids)), np.bool_)
    minor[:] = clutter.little
    for n, label in enumerate(labels):
        wanted[n, [*label.own]], minor[n, [*label.beside]] = False, True
    of = np.repeat(np.arange(len(labels)), counts)
    place_, solid = _meeting(places, size, clutter, wanted[of])
    little = minor[of[place_], solid]
    forbidden[place_[~little]] = True
    cost = _BESIDE * np.bincount(place_[little], minlength=len(places))
    cuts = np.cumsum(counts)[:-1]
    flags = np.split(forbidden[None], cuts, axis=1)
    values = (np.split(part[None], cuts, axis=1) for part in (cost, _off_own(labels, places, size)))
    for *standing, lines in zip(flags, *values, _lines_of(labels, clutter), strict=True):
        yield Standing(*standing, *lines)


def _lines_of(labels: Sequence[LabelPlaces], clutter: Clutter) -> Iterator[tuple[Loop, _Bools, _Floats]]:
    """Yield the lines of each label of one moment, which of them are barred, and their price."""
    groups = [line[0] for label in labels for line in label.lines]
    barred, price = np.zeros((1, len(groups)), np.bool_), np.zeros((1, len(groups)))
    if groups:
        starts = np.cumsum([0, *(len(group) for group in groups[:-1])])
        every = np.concatenate(groups)[None]
        middles = np.array([[rect.middle for rect in clutter.rects]], np.complex128)
        hit = ~_within(every, (2.0, 2.0), clutter.inside).all(axis=2)
        hit |= _hits(middles, clutter.sizes, every, _THICK).any(axis=1)
        barred = np.logical_or.reduceat(hit, starts, axis=1)
        gapped = np.array([label.gap > 0 for label in labels for _ in label.lines])
        price = _pricing(every[:, starts], clutter, barred, gapped)
    cuts = np.cumsum([len(label.lines) for label in labels])[:-1]
    found = (np.split(part, cuts, axis=1) for part in (barred, price))
    for label, one, other in zip(labels, *found, strict=True):
        lines = np.stack(label.lines, axis=1) if label.lines else np.zeros((1, 0, 1, 2), np.complex128)
        yield lines, one, other


def _off_own(labels: Sequence[LabelPlaces], places: Loop, size: _Floats) -> _Floats:
    """Return how far each place of labels of one moment keeps from others' dimension lines (k,)."""
    counts = [label.places.shape[1] for label in labels]
    gaps = np.repeat([label.gap for label in labels], counts)
    starts = np.cumsum([0, *(len(label.lines) for label in labels)])
    own = [np.full(count, -1) for count in counts]
    for n, label in enumerate(labels):
        if label.drawn is not None and label.gap:
            own[n] = np.where(label.drawn >= 0, label.drawn + starts[n], -1)
    line = np.concatenate(own)
    lined = np.flatnonzero(line >= 0)
    found = np.where(gaps > 0, gaps, _THICK)
    if len(lined):
        firsts = np.array([group[0, 0] for label in labels for group in label.lines])
        far = _away(places[lined], size[:, lined], firsts[line[lined]]) + _NEARER
        found[lined] = np.maximum(far, gaps[lined])
    return found


def _meeting(
    places: Loop, size: _Floats, clutter: Clutter, wanted: _Bools
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return which boxes (k,) of sizes (2, k) meet which solids at one moment: the numbers of both.

    Only pairs that are `wanted` (k, m) are tested.
    """
    if not clutter.solids:
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    left, right, top, bottom = clutter.boxes
    (wide, high), x, y = size[:, :, None] / 2 + _SURE, places.real[:, None], places.imag[:, None]
    near = wanted & (left < x + wide) & (right > x - wide) & (top < y + high) & (bottom > y - high)
    place_, solid = near.nonzero()
    met = np.zeros(len(place_), np.bool_)
    number = np.zeros(len(clutter.solids), np.intp)
    for numbers, solids in clutter.alike:
        number[numbers] = np.arange(len(numbers))
        some = np.flatnonzero(np.isin(solid, numbers))
        which = number[solid[some]]
        met[some] = _pairs_touch(places[place_[some]], size[:, place_[some]], solids.picked(which))
    return place_[met], solid[met]


def _covering(label: LabelPlaces, clutter: Clutter, forbidden: _Bools) -> _Floats:
    """Return what places cost for solids below them (n, k); `forbidden` says where nothing may lie anyway."""
    places, size = label.places, label.size
    cost = np.zeros(places.shape)
    minor = clutter.little.copy()
    minor[[*label.beside]] = True
    near = _near(places, size, clutter)
    near[[*label.own]] = False
    for solids in _some(places, clutter, near & minor):
        cost += _BESIDE * touching(places, size, solids).sum(axis=2)
    for solids in _some(places, clutter, near & ~minor):
        poses, around = ~forbidden.all(axis=1), ~forbidden.all(axis=0)
        if poses.any():  # a label too large for its room has no place at all
            there = solids._replace(corners=solids.corners[poses]) if len(solids.corners) > 1 else solids
            left = np.ix_(poses, around)
            forbidden[left] |= touching(places[left], size, there, forbidden[left]).any(axis=2)
    return cost


def place(labels: Sequence[LabelPlaces], clutter: Clutter) -> list[Placed]:
    """Return a place for each label; earlier ones choose first. A label without room is not shown."""
    placer = Placer(clutter)
    return [placer.first([label])[1] for label in labels]


def placed_among(
    labels: Sequence[LabelPlaces], room: Rect, rects: Sequence[Rect], lines: Loop, half: float
) -> list[tuple[int, bool]]:
    """Return which of its places each label of one moment takes, and whether it has room there.

    All are within the `room`, off the `rects`, off lines (1, m, 2) of half the width `half`, and off each
    other; earlier labels choose first. The clutter is tested for all labels at once.
    """
    if not labels:
        return []
    counts = [label.places.shape[1] for label in labels]
    every = np.concatenate([label.places for label in labels], axis=1)
    size = np.repeat(np.array([label.size for label in labels]).T, counts, axis=1)
    barred = np.logical_not(_within(every, size, room)) | _cut(every, size, lines, half)
    taken = np.array([*(rect.middle for rect in rects), *[0j] * len(labels)])
    sizes = np.array([*((rect.width, rect.height) for rect in rects), *(label.size for label in labels)]).T
    found, count = list[tuple[int, bool]](), len(rects)
    for label, forbidden in zip(labels, np.split(barred[0], np.cumsum(counts)[:-1]), strict=True):
        away = label.places[0][:, None] - taken[:count]
        forbidden |= _over(away, label.size, sizes[:, :count]).any(axis=1)
        which = int((label.price + _FORBIDDEN * forbidden).argmin())
        found.append((which, not forbidden[which]))
        if not forbidden[which]:
            taken[count], sizes[:, count] = label.places[0, which], label.size
            count += 1
    return found


# Names in one pose that have to be shown: where they overlap least.


def rect_rows(rects: Iterable[Rect]) -> _Floats:
    """Return rectangles as rows (4, m): their left and top edges, widths and heights."""
    return np.array([*rects], np.float64).reshape(-1, 4).T


def about(middles: Loop, wide: ArrayLike, high: float, room: Rect) -> _Floats:
    """Return rectangles (4, ...) of a size about these middles, moved into a room as little as can be."""
    found = np.empty((4, *middles.shape))
    found[2], found[3] = wide, high
    for n, (place, low, end) in enumerate(
        ((middles.real, room.x, room.right), (middles.imag, room.y, room.bottom))
    ):
        half = found[2 + n] / 2
        least = low + half
        found[n] = np.minimum(np.maximum(place, least), np.maximum(end - half, least)) - half
    return found


def widened(rects: _Floats, by: float) -> _Floats:
    """Return rectangles (4, ...) with a border of that width round each."""
    x, y, wide, high = rects
    return np.array((x - by, y - by, wide + 2 * by, high + 2 * by))


def overlap(rects: _Floats, others: _Floats) -> _Bools:
    """Return whether rectangles (4, ...) meet others (4, ...) in the same places: `Rect.meets`."""
    (left, top, wide, high), (x, y, width, height) = rects, others
    apart = (x >= left + wide) | (left >= x + width) | (y >= top + high) | (top >= y + height)
    return np.asarray(~apart)


def met(rects: _Floats, others: _Floats) -> NDArray[np.int64]:
    """Return how many of others (4, m) each of some rectangles (4, ...) meets."""
    return np.asarray(overlap(rects[..., None], others).sum(axis=-1))


def crossed(rects: _Floats, lines: Sequence[tuple[complex, complex]]) -> NDArray[np.int64]:
    """Return how many of some lines, from end to end, run through each rectangle (4, ...): `Rect.crossed`."""
    if not lines:
        return np.zeros(rects.shape[1:], np.int64)
    one, other = np.array(lines).T
    along, (x, y, wide, high) = other - one, rects[..., None]
    first, last, beside = np.zeros(()), np.ones(()), np.zeros((), np.bool_)
    with np.errstate(all="ignore"):
        for step, gap in (
            (-along.real, one.real - x),
            (along.real, x + wide - one.real),
            (-along.imag, one.imag - y),
            (along.imag, y + high - one.imag),
        ):
            share = gap / step
            beside = beside | (step == 0) & (gap < 0)
            first = np.where(step < 0, np.fmax(first, share), first)
            last = np.where(step > 0, np.fmin(last, share), last)
    return np.asarray(((first < last) & ~beside).sum(axis=-1))


def holding(rects: _Floats, points: Loop) -> NDArray[np.int64]:
    """Return how many points (m,) lie in each of some rectangles (4, ...)."""
    x, y, wide, high = rects[..., None]
    held = (points.real >= x) & (points.real <= x + wide) & (points.imag >= y) & (points.imag <= y + high)
    return np.asarray(held.sum(axis=-1))


def least_met(rects: _Floats, meets: NDArray[np.int64], crosses: NDArray[np.int64]) -> list[int]:
    """Return which of its k places (4, n, k) each of n names takes: the first of those that meet least.

    The number of things that it `meets` at each place (n, k) counts first, with the names before it; of equal
    places the one that `crosses` fewer lines is better.
    """
    # both counts in one number: all crossed lines together count less than one thing met
    whole = 1 + int(crosses.max(initial=0))
    counts, found = whole * meets + crosses, list[int]()
    for n in range(len(counts)):
        found.append(int(counts[n].argmin()))
        counts[n + 1 :] += whole * overlap(rects[:, n + 1 :], rects[:, n, found[n]])
    return found


def _pairs_touch(places: Loop, size: _Floats, solids: Solids) -> _Bools:
    """Return whether each box (p,) of sizes (2, p) touches the solid (p,) of the same number."""
    corners, half, (wide, high) = solids.corners[0], solids.half, size
    if corners.shape[1] == 1:
        away = places - corners[:, 0]
        aside = np.maximum(np.abs(away.real) - wide / 2, 0) + 1j * np.maximum(np.abs(away.imag) - high / 2, 0)
        return np.asarray(np.abs(aside) < half)
    if corners.shape[1] == 2:
        middle, reach = ((corners[:, 1] + sign * corners[:, 0]) / 2 for sign in (1, -1))
        return _hit(places, (wide / 2, high / 2), middle, reach, half)
    hit = _straddles(corners.real[:, None], places.real[:, None, None], (wide / 2 + half)[:, None, None])
    hit &= _straddles(corners.imag[:, None], places.imag[:, None, None], (high / 2 + half)[:, None, None])
    hit = hit[:, 0, 0]
    some = np.flatnonzero(hit)
    hit[some] = _overlapping(corners[some] - places[some, None], size[:, some], half[some])
    return hit


def touching(places: Loop, size: tuple[float, float], solids: Solids, but: _Bools | None = None) -> _Bools:
    """Return whether boxes of a size about places (n, k) touch each of the solids (n, k, m).

    Two convex shapes are apart where the line of one of their edges separates them; a bar's ends count as
    square. At the places `but` (n, k) the answer does not matter.
    """
    (wide, high), (corners, half) = size, solids
    if corners.shape[2] == 1:
        away = places[..., None] - corners[:, None, :, 0]
        aside = np.maximum(np.abs(away.real) - wide / 2, 0) + 1j * np.maximum(np.abs(away.imag) - high / 2, 0)
        return np.asarray(np.abs(aside) < half)
    if corners.shape[2] == 2:
        return _hits(places, size, corners, half)
    hit = _straddles(corners.real, places.real[..., None], wide / 2 + half)
    hit &= _straddles(corners.imag, places.imag[..., None], high / 2 + half)
    if but is not None:
        hit &= ~but[..., None]
    moment, place_, solid = hit.nonzero()
    near = corners[moment if len(corners) > 1 else 0, solid] - places[moment, place_, None]
    hit[moment, place_, solid] = _overlapping(near, (wide, high), half[solid])
    return hit


def _overlapping(near: Loop, size: tuple[float, float] | _Floats, half: _Floats) -> _Bools:
    """Return whether shapes (p, c), each with `half` around it, overlap boxes about the origin (p,).

    The boxes are of one size, or of sizes (2, p).
    """
    ends, together, sides = np.arange(near.shape[1]), np.arange(len(near)), np.asarray(size)
    # with many shapes, a few edges separate most of those that are apart; the rest are tested against all
    # edges
    few = (ends[::_EDGES], np.delete(ends, slice(None, None, _EDGES)))
    for some in few if len(near) > _MANY else (ends,):
        these = sides if sides.ndim == 1 else sides[:, together]
        together = together[~_parted(near[together], these, half[together], some)]
    overlap = np.zeros(len(near), np.bool_)
    overlap[together] = True
    return overlap


def _parted(near: Loop, size: _Floats, half: _Floats, edges: NDArray[np.intp]) -> _Bools:
    """Return whether one of some edges of shapes (p, c) separates them from a box about the origin (p,)."""
    parted, corners = np.zeros(len(near), bool), np.ascontiguousarray(near.T)
    for end in edges.tolist():
        along = corners[end] - corners[end - 1]
        reach = np.abs(along.imag) * size[0] / 2 + np.abs(along.real) * size[1] / 2 + np.abs(along) * half
        across = along.real * corners.imag - along.imag * corners.real
        lowest, highest = across.min(axis=0), across.max(axis=0)
        parted |= (along != 0) & ((lowest >= reach) | (-highest >= reach))
    return parted


def _some(places: Loop, clutter: Clutter, wanted: _Bools) -> Iterator[Solids]:
    """Yield the wanted solids in parts: of many solids a few come first, which may forbid most places."""
    for numbers, solids in clutter.alike:
        which = np.flatnonzero(wanted[numbers])
        first = _FIRST if which.size * places.size > _MANY else which.size
        for some in (which[:first], which[first:]):
            if some.size:
                yield solids.picked(some)


def _off_others(label: LabelPlaces) -> _Floats:
    """Return how far each place of a label must keep from others' dimension lines (n, k)."""
    if not label.gap:
        return np.full(label.places.shape, _THICK)
    return np.asarray(np.maximum(_from_own(label), label.gap))


def _from_own(label: LabelPlaces, which: slice = slice(None)) -> _Floats:
    """Return how far a label is from its own dimension line, and a little more; 0 without one (n, k)."""
    places = label.places[:, which]
    if label.drawn is None:
        return np.zeros(places.shape)
    lines = np.stack([group[:, 0] for group in label.lines], axis=1)[:, label.drawn[which]]
    return np.asarray(np.where(label.drawn[which] >= 0, _away(places, label.size, lines) + _NEARER, 0.0))


def _away(places: Loop, size: tuple[float, float] | _Floats, lines: Loop) -> _Floats:
    """Return how far boxes about places (...) are from lines (..., 2) that do not run through them."""
    wide, high = size
    ends = (
        np.abs((lines - places[..., None]).real) - np.asarray(wide)[..., None] / 2,
        np.abs((lines - places[..., None]).imag) - np.asarray(high)[..., None] / 2,
    )
    near = np.hypot(np.maximum(ends[0], 0), np.maximum(ends[1], 0)).min(axis=-1)
    along = lines[..., 1] - lines[..., 0]
    for corner in (wide + 1j * high, wide - 1j * high, -wide + 1j * high, -wide - 1j * high):
        away = places + corner / 2 - lines[..., 0]
        share = np.clip((away * along.conj()).real / np.maximum(np.abs(along) ** 2, 1e-12), 0.0, 1.0)
        near = np.minimum(near, np.abs(away - share * along))
    return np.asarray(near)


def _cut(
    places: ArrayLike, size: tuple[float, float] | _Floats, lines: Loop, half: float | _Floats
) -> _Bools:
    """Return whether boxes of sizes about places (n, k) touch lines (n, m, 2) that are `half` thick."""
    return np.asarray(_hits(places, size, lines, half).any(axis=2))


def _hits(
    places: ArrayLike, size: tuple[float, float] | _Floats, lines: Loop, half: float | _Floats
) -> _Bools:
    """Return which boxes touch which of the lines (n, k, m)."""
    wide, high = (np.atleast_1d(side)[:, None] / 2 for side in size)
    middle, reach = (((lines[..., 1] + sign * lines[..., 0]) / 2)[:, None] for sign in (1, -1))
    return _hit(np.atleast_2d(places)[:, :, None], (wide, high), middle, reach, half)


def _hit(
    places: Loop, size: tuple[_Floats, _Floats], middle: Loop, reach: Loop, half: float | _Floats
) -> _Bools:
    """Return whether boxes about places touch lines, by half their sizes and half the lines' vectors."""
    (wide, high), away = size, places - middle
    long, deep = np.abs(reach.real), np.abs(reach.imag)
    hit = (np.abs(away.real) < wide + half + long) & (np.abs(away.imag) < high + half + deep)
    across = np.abs(away.real * reach.imag - away.imag * reach.real)
    hit &= across < long * high + deep * wide + half * np.hypot(long, deep)
    return np.asarray(hit)


def _joined(one: Loop, other: Loop) -> Loop:
    """Return arrays (n or 1, m, ...) side by side."""
    count = max(len(one), len(other))
    wide = (np.broadcast_to(part, (count, *part.shape[1:])) for part in (one, other))
    return np.concatenate([*wide], axis=1)


def _crossings(lines: Loop, clutter: Clutter) -> tuple[_Floats, _Floats]:
    """Return how many solids, and how many links, each of some lines (n, m, 2) crosses (n, m)."""
    found = np.zeros((2, *lines.shape[:2]))
    links = np.zeros(len(clutter.solids), np.bool_)
    links[[*clutter.links]] = True
    for numbers, solids in clutter.alike:
        crossed = _run_through(lines, solids)
        found += crossed.sum(axis=2), crossed[..., links[numbers]].sum(axis=2)
    return found[0], found[1]


def _run_through(lines: Loop, solids: Solids) -> _Bools:
    """Return which lines (n, k, 2) run through which solids (n, k, m): nothing parts the two."""
    corners, half = solids
    turn = units(lines[..., 1] - lines[..., 0])[:, :, None, None].conj()
    apart = _apart(lines[:, :, None] * turn, corners[:, None] * turn, half)
    # most are apart in the line's own frame: only the others are tested along the solids' edges
    moment, line, solid = np.logical_not(apart).nonzero()
    ends = lines[moment if len(lines) > 1 else 0, line]
    corners = corners[moment if len(corners) > 1 else 0, solid]
    parted, around, count = np.zeros(len(line), np.bool_), half[solid], corners.shape[-1]
    for n in range(count if count > 2 else count - 1):
        turn = units(corners[:, n] - corners[:, n - 1])[:, None].conj()
        parted |= _apart(ends * turn, corners * turn, around)
    apart[moment, line, solid] = parted
    return np.asarray(np.logical_not(apart))


def _apart(ends: Loop, corners: Loop, half: _Floats) -> _Bools:
    """Return whether lines (..., 2) are apart, in x or y, from corners (..., c) with `half` around them."""
    apart = np.zeros((), np.bool_)
    for one, other in ((ends.real, corners.real), (ends.imag, corners.imag)):
        apart = apart | (one.min(axis=-1) >= other.max(axis=-1) + half)
        apart |= one.max(axis=-1) <= other.min(axis=-1) - half
    return np.asarray(apart)


def _too_near(lines: Loop, others: Loop, gap: float) -> _Bools:
    """Return which lines (n, k, 2) come nearer than a gap to one of some others (n, m, 2), as (n, k).

    A line that continues another one, end to end, is not too near.
    """
    if not others.shape[1]:
        return np.zeros(lines.shape[:2], np.bool_)
    one, other = lines[:, :, None], others[:, None]
    far, crossing, level, beyond = [], [], [], []
    for ends, base in ((one, other), (other, one)):
        along = base[..., 1] - base[..., 0]
        long = lengths(along)
        place = (ends - base[..., :1]) * units(along).conj()[..., None]
        off = np.maximum(np.maximum(-place.real, place.real - long[..., None]), 0)
        far.append(lengths(off + 1j * place.imag).min(axis=-1))
        crossing.append(place.imag[..., 0] * place.imag[..., 1] < 0)
        level.append(np.abs(place.imag).max(axis=-1) < _CHAINED)
        beyond.append((place.real.max(axis=-1) < _CHAINED) | (place.real.min(axis=-1) > long - _CHAINED))
    near = np.minimum(*far) < gap
    near |= crossing[0] & crossing[1]
    near &= ~(level[0] & level[1] & beyond[0])
    return np.asarray(near.any(axis=2))


def _ends_at_pins(lines: Loop, clutter: Clutter) -> _Bools:
    """Return which lines (n, k, 2) end at a pin (n, k): they would seem to measure to it."""
    found = np.zeros(lines.shape[:2], np.bool_)
    for _, solids in clutter.alike:
        if solids.corners.shape[2] == 1:
            away = np.abs(lines[:, :, None] - solids.corners[:, None])
            found |= (away < _OFF_PINS * solids.half[:, None]).any(axis=(2, 3))
    return found


def _straddles(corners: _Floats, middle: _Floats, reach: _Floats | float) -> _Bools:
    """Return whether the span of corners (n, m, c) comes within `reach` of middles in one direction."""
    low, high = corners.min(axis=2)[:, None], corners.max(axis=2)[:, None]
    return np.asarray((low - middle < reach) & (middle - high < reach), np.bool_)


def _near(places: Loop, size: tuple[float, float], clutter: Clutter) -> _Bools:
    """Return which solids come near a box of that size about any of the places at any moment."""
    if not clutter.solids:
        return np.zeros(0, np.bool_)
    near, boxes = np.ones((1, 1), np.bool_), clutter.boxes
    for part, side, ends in ((places.real, size[0], boxes[:2]), (places.imag, size[1], boxes[2:])):
        low, high = (end(part, axis=1, keepdims=True) for end in (np.min, np.max))
        near = near & (ends[0] < high + side / 2) & (ends[1] > low - side / 2)
    return np.asarray(near.any(axis=0))


def _within(places: Loop, size: tuple[float, float] | _Floats, room: Rect) -> _Bools:
    (wide, high), x, y = size, places.real, places.imag
    inside = (x - wide / 2 >= room.x) & (x + wide / 2 <= room.right)
    return np.asarray(inside & (y - high / 2 >= room.y) & (y + high / 2 <= room.bottom))


def _over(away: Loop, size: tuple[float, float] | _Floats, other: _Floats) -> _Bools:
    wide, high = size[0] + other[0], size[1] + other[1]
    return np.asarray((2 * np.abs(away.real) < wide) & (2 * np.abs(away.imag) < high))


def _eased(forbidden: _Bools, gone: int = _GONE) -> _Floats:
    """Return a label's opacity; it is hidden from `gone` moments before those that are forbidden."""
    if len(forbidden) == 1 or not forbidden.any():
        return np.where(forbidden, 0.0, 1.0)
    clear = _around(forbidden, gone + _SOFT) == 0
    return np.asarray(_around(clear, _SOFT) / (2 * _SOFT + 1), np.float64)


def _around(flags: _Bools, reach: int) -> NDArray[np.int64]:
    """Return how many flags are set within `reach` moments of each, the last beside the first."""
    wrapped = np.concatenate((flags[-reach:], flags, flags[:reach]))
    return np.asarray(sliding_window_view(wrapped, 2 * reach + 1).sum(axis=1))
