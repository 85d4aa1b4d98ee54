"""Where labels stand over a whole cycle: chosen once, near what they name, off all else, moving smoothly.

Every label has a few places to choose from at each of the cycle's moments. The path through them that
costs least in all, for lying over things and for moving, is found by dynamic programming (the Viterbi
algorithm), closed over the cycle and smoothed. What is placed is in the way of the labels after it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import exp
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.raster.raster import Loop
from linkanim.picture.view import Rect

_Floats = NDArray[np.float64]
_Bools = NDArray[np.bool_]

MOMENTS = 72
"""Of one drive period."""
_MOVING, _HURRY = 2.0, 60.0
"""What it costs to move by the label's own height, and the more to do so at once, where lying over a bar
for a moment costs 1."""
_MARGIN = 0.08
"""How far labels are planned to stay off what they must not touch, in their heights: bends are rounded."""
_FORBIDDEN = 60.0
_CLOSE = 0.2
"""How near to a bar, in its own heights, a label's middle seems to lie on it."""
_APART = 2.0
"""So much further off than it can matter, in pixels, a thing is not looked at."""
_SOFT = 1.5
"""The smoothing's standard deviation, in moments."""
_GONE = 4
"""How many moments before it would lie on something a label is gone."""
_TELLING = 2 * _GONE
"""Every such moment without room hides a label until the next of them."""
_REACH = 6
"""How many moments either way the smoothing looks."""


class Obstacles(NamedTuple):
    """Lines (n moments, m) that labels had better not lie on, each so thick and so much in the way."""

    begin: Loop
    end: Loop
    half: _Floats
    weight: _Floats

    def picked(self, which: NDArray[np.intp]) -> Obstacles:
        """Return some of them."""
        return Obstacles(self.begin[:, which], self.end[:, which], self.half[which], self.weight[which])


class Extent(NamedTuple):
    """How far m things reach at each of n moments (n, m), in pixels."""

    left: _Floats
    right: _Floats
    top: _Floats
    bottom: _Floats

    @classmethod
    def of(cls, points: Loop, half: _Floats | float = 0.0, high: _Floats | float | None = None) -> Extent:
        """Return how far things with corners at points (n, m, c) reach, with `half` round each."""
        across, down = half, half if high is None else high
        return cls(
            points.real.min(axis=2) - across,
            points.real.max(axis=2) + across,
            points.imag.min(axis=2) - down,
            points.imag.max(axis=2) + down,
        )

    def near(self, places: Loop, across: float, down: float) -> NDArray[np.intp]:
        """Return which things come so near to one of the places (n, k) at some moment, in their order."""
        x, y = places.real, places.imag
        apart = self.left > x.max(axis=1, keepdims=True) + across
        apart |= self.right < x.min(axis=1, keepdims=True) - across
        apart |= self.top > y.max(axis=1, keepdims=True) + down
        apart |= self.bottom < y.min(axis=1, keepdims=True) - down
        return np.flatnonzero(~apart.all(axis=0))


class Solid(NamedTuple):
    """What a link covers: all within its corners (n moments, c), in their order, and `half` round it."""

    corners: Loop
    half: float


@dataclass(frozen=True)
class Clutter:
    """What labels must stay off: discs (n moments, m), rectangles, all that is not `inside`; and bars.

    Off the solids only those stay that shun them.
    """

    discs: Loop
    radii: _Floats
    rects: tuple[Rect, ...]
    inside: Rect
    bars: Obstacles
    solids: tuple[Solid, ...] = ()

    @cached_property
    def discs_reach(self) -> Extent:
        """How far the discs reach."""
        return Extent.of(self.discs[:, :, None], self.radii)

    @cached_property
    def bars_reach(self) -> Extent:
        """How far the bars reach."""
        return Extent.of(np.stack((self.bars.begin, self.bars.end), axis=2), self.bars.half)

    @cached_property
    def solids_reach(self) -> Extent:
        """How far the solids reach."""
        each = [Extent.of(solid.corners[:, None], solid.half) for solid in self.solids]
        return Extent(*(np.concatenate(sides, axis=1) for sides in zip(*each, strict=True)))

    @cached_property
    def telling(self) -> Clutter:
        """What must not be touched, at the few moments that tell whether there is room."""
        solids = tuple(solid._replace(corners=solid.corners[::_TELLING]) for solid in self.solids)
        return replace(self, discs=self.discs[::_TELLING], solids=solids)

    @cached_property
    def between(self) -> Clutter:
        """What must not be touched, half a moment later; the cycle is closed."""
        return replace(self, discs=_between(self.discs))


@dataclass(frozen=True)
class _Taken:
    """The labels placed so far: where each stands at each moment (n, m), and its sizes (m, 2)."""

    tracks: Loop
    sizes: _Floats

    def with_label(self, track: Loop, size: tuple[float, float]) -> _Taken:
        """Return them with one more."""
        return _Taken(np.column_stack((self.tracks, track)), np.vstack((self.sizes, size)))

    @cached_property
    def reach(self) -> Extent:
        """How far they reach."""
        return Extent.of(self.tracks[:, :, None], self.sizes[:, 0] / 2, self.sizes[:, 1] / 2)

    @cached_property
    def telling(self) -> _Taken:
        """Return them at the few moments that tell whether there is room."""
        return _Taken(self.tracks[::_TELLING], self.sizes)

    @cached_property
    def between(self) -> _Taken:
        """Return them half a moment later."""
        return _Taken(_between(self.tracks), self.sizes)


class Wish(NamedTuple):
    """A label: how large, where it may stand at each of n moments (n, k), and the price of each place.

    `frame` is (origin, direction) of what it belongs to at each moment, in which it had better rest.
    `own` are the numbers of the bars that it may lie on; `shunned` (k, m) says of each place which solids
    its middle must not lie on, since the label would seem to be theirs.
    """

    size: tuple[float, float]
    places: Loop
    price: _Floats
    frame: tuple[Loop, Loop]
    own: tuple[int, ...] = ()
    shunned: _Bools | None = None


class Drift(NamedTuple):
    """A label's place in its frame at each moment, smooth over the cycle, and how far it shows (0 to 1).

    Several labels have a column each.
    """

    offset: Loop
    shown: _Floats

    def at(self, share: float) -> tuple[Loop, _Floats]:
        """Return place and showing at a share of the cycle (1 is the whole), of several labels in a row."""
        count = len(self.offset)
        middle = share * count
        first = round(middle) - _REACH
        weights = [exp(-0.5 * ((first + n - middle) / _SOFT) ** 2) for n in range(2 * _REACH + 1)]
        near, whole = (first % count + np.arange(len(weights))) % count, sum(weights)
        offset, shown = ((part.take(near, axis=0).T * weights).sum(axis=-1) / whole for part in self)
        return offset, shown


def place(wishes: Sequence[Wish], clutter: Clutter) -> list[Drift]:
    """Return a path for each label; the first have the first choice. One without room shows nowhere."""
    paths: list[Drift] = []
    count = len(clutter.discs)
    taken = _Taken(np.zeros((count, 0), np.complex128), np.zeros((0, 2)))
    hidden = Drift(np.zeros(count, np.complex128), np.zeros(count))
    for wish in wishes:
        path = _placed(wish, clutter, taken) if _has_room(wish, clutter.telling, taken.telling) else hidden
        if path.shown.any():
            taken = taken.with_label(_track(path, wish), wish.size)
        paths.append(path)
    return paths


def _has_room(wish: Wish, clutter: Clutter, taken: _Taken) -> bool:
    """Return whether there is a place to stand at one of the few moments that tell."""
    places = wish.places[::_TELLING]
    blocked = _blocked(places, wish, clutter, taken)
    return not blocked.all() and not (blocked | _mistaken(places, wish, clutter)).all()


def _placed(wish: Wish, clutter: Clutter, taken: _Taken) -> Drift:
    margin = 2 * _MARGIN * wish.size[1]
    planned = wish._replace(size=(wish.size[0] + margin, wish.size[1] + margin))
    cost = wish.price + _lying(wish, clutter)
    cost += _FORBIDDEN * (
        _blocked(wish.places, planned, clutter, taken) | _mistaken(wish.places, wish, clutter)
    )
    origin, direction = wish.frame
    local = (wish.places - origin[:, None]) / direction[:, None]
    chosen = _cheapest(cost, _moves(local, wish.size[1]))
    path = Drift(np.take_along_axis(local, chosen[:, None], axis=1)[:, 0], np.ones(len(cost)))
    track = _track(path, wish)[:, None]
    blocked = (_blocked(track, wish, clutter, taken) | _mistaken(track, wish, clutter, chosen))[:, 0]
    between = _blocked(_between(track), wish, clutter.between, taken.between)[:, 0]
    return path._replace(shown=_eased(blocked | between | np.roll(between, 1)))


def _between(places: Loop) -> Loop:
    """Return where things are half a moment later; the cycle is closed."""
    half: Loop = (places + np.roll(places, -1, axis=0)) / 2
    return half


def _track(path: Drift, wish: Wish) -> Loop:
    """Return where a label stands at each moment, as it will be drawn."""
    near = np.arange(-_REACH, _REACH + 1)
    weight = np.exp(-0.5 * (near / _SOFT) ** 2)
    smooth = sum(np.roll(path.offset, shift) * share for shift, share in zip(near, weight, strict=True))
    origin, direction = wish.frame
    track: Loop = origin + direction * smooth / weight.sum()
    return track


def _moves(local: Loop, height: float) -> _Floats:
    """Return the cost (k, k) of going from one place to another between two moments."""
    some = local[::9]
    apart = np.abs(some[:, :, None] - some[:, None, :]).mean(axis=0) / height
    return np.asarray(_MOVING * apart + _HURRY * apart**2)


def _cheapest(cost: _Floats, moves: _Floats) -> NDArray[np.int64]:
    """Return which place to take at each moment; the last leads back to the first."""
    count = len(cost)
    twice = _walked(np.concatenate((cost, cost)), moves)
    begin = int(twice[count])
    closed = np.concatenate((cost, cost[:1]))
    closed[[0, -1]] = np.inf
    closed[[0, -1], begin] = cost[0, begin]
    return _walked(closed, moves)[:count]


def _walked(cost: _Floats, moves: _Floats) -> NDArray[np.int64]:
    """Return the cheapest path from the first moment to the last."""
    total, came = cost[0], np.empty(cost.shape, np.int64)
    for n in range(1, len(cost)):
        ways = total[:, None] + moves
        came[n] = ways.argmin(axis=0)
        total = ways.min(axis=0) + cost[n]
    chosen = np.empty(len(cost), np.int64)
    chosen[-1] = total.argmin()
    for n in range(len(cost) - 1, 0, -1):
        chosen[n - 1] = came[n, chosen[n]]
    return chosen


def _blocked(places: Loop, wish: Wish, clutter: Clutter, taken: _Taken) -> _Bools:
    """Return whether the label would lie on a disc, a rectangle or another label, or reach outside."""
    wide, high = wish.size
    near = clutter.discs_reach.near(places, wide / 2 + _APART, high / 2 + _APART)
    away = places[:, :, None] - clutter.discs[:, None, near]
    beside = np.maximum(np.abs(away.real) - wide / 2, 0), np.maximum(np.abs(away.imag) - high / 2, 0)
    blocked: _Bools = np.asarray((np.hypot(*beside) < clutter.radii[near]).any(axis=2))
    for rect in clutter.rects:
        middle = complex(rect.x + rect.width / 2, rect.y + rect.height / 2)
        blocked |= _over(places - middle, wide + rect.width, high + rect.height)
    for n in taken.reach.near(places, wide / 2 + _APART, high / 2 + _APART):
        width, height = taken.sizes[n]
        blocked |= _over(places - taken.tracks[:, n, None], wide + width + 2, high + height)
    room = clutter.inside
    inside = (places.real - wide / 2 >= room.x) & (places.real + wide / 2 <= room.right)
    inside &= (places.imag - high / 2 >= room.y) & (places.imag + high / 2 <= room.bottom)
    return blocked | ~inside


def _mistaken(places: Loop, wish: Wish, clutter: Clutter, chosen: NDArray[np.int64] | None = None) -> _Bools:
    """Return whether the label's middle would lie on a solid that it must shun there."""
    mistaken, shunned = np.zeros(places.shape, np.bool_), wish.shunned
    if shunned is None:
        return mistaken
    at = shunned[None] if chosen is None else shunned[chosen][:, None]
    close = _CLOSE * wish.size[1] + _APART
    for n in clutter.solids_reach.near(places, close, close):
        if not shunned[:, n].any():
            continue
        solid = clutter.solids[n]
        mistaken |= at[..., n] & (_off(places, solid.corners) < solid.half + _CLOSE * wish.size[1])
    return mistaken


def _off(points: Loop, corners: Loop) -> _Floats:
    """Return how far points (n, k) are from what corners (n, c) enclose, 0 inside."""
    begin, end = corners[:, None], np.roll(corners, -1, axis=1)[:, None]
    away = _distance(points[:, :, None], begin, end).min(axis=2)
    left = ((points[:, :, None] - begin) * np.conj(end - begin)).imag
    # of one corner, or two, all points are "inside" that lie in line with them
    return np.where((left > 0).all(axis=2) | (left < 0).all(axis=2), 0.0, away)


def _distance(points: Loop, begin: Loop, end: Loop) -> _Floats:
    """Return how far points are from lines."""
    along = end - begin
    squared = np.maximum(np.abs(along) ** 2, 1e-9)
    share = np.clip(((points - begin) * np.conj(along)).real / squared, 0, 1)
    away: _Floats = np.abs(points - begin - share * along)
    return away


def _over(away: Loop, width: float, height: float) -> _Bools:
    return np.asarray((2 * np.abs(away.real) < width) & (2 * np.abs(away.imag) < height))


def _lying(wish: Wish, clutter: Clutter) -> _Floats:
    """Return how much each place lies over bars: 0 for none, 1 for right on one, more for more."""
    wide, high = wish.size
    weight = clutter.bars.weight.copy()
    weight[list(wish.own)] = 0.0
    reach = max(wide - high, 0.0) / 2
    near = clutter.bars_reach.near(wish.places, reach + high / 2 + _APART, high / 2 + _APART)
    bars = clutter.bars.picked(near)
    points = wish.places[:, :, None, None] + np.array([-reach, 0.0, reach])[:, None]
    away = _distance(points, bars.begin[:, None, None, :], bars.end[:, None, None, :])
    over = np.clip((bars.half + high / 2 - away) / high, 0, 1).max(axis=2)
    lying: _Floats = (over * weight[near] * np.minimum(2 * bars.half / high, 1)).sum(axis=2)
    return lying


def _eased(blocked: _Bools) -> _Floats:
    """Return how far a label shows that must not at some moments; it is gone in time for each."""
    hidden = blocked.copy()
    for shift in range(1, _GONE + 1):
        hidden |= np.roll(blocked, shift) | np.roll(blocked, -shift)
    return np.where(hidden, 0.0, 1.0)
