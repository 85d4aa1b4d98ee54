"""One place for each label: near what it names, off all else for as much of a cycle as there is.

Every label has a few places to choose from, each of which goes along with what it names. The one is taken
that costs least over the cycle: for being far, for lying over bars, and most of all for lying where a label
must not. At the moments at which it would all the same, it is gone. What is placed is in the way of the
labels after it. On a picture of one moment, such as a chart, a label stands there or not at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.picture.raster.raster import Loop
from linkanim.picture.view import Rect

_Floats = NDArray[np.float64]
_Bools = NDArray[np.bool_]

MOMENTS = 144
"""Of one drive period, at which is looked whether a label lies on something."""
_STEP = 4
"""At every fourth of them a place is chosen."""
_FORBIDDEN = 20.0
"""What a place costs that is forbidden for the whole cycle, where one on a bar costs 1."""
_CLOSE = 0.2
"""How near to a bar, in its own heights, a label's middle seems to lie on it."""
_GONE = 7
"""How many moments before it would lie on something a label is gone."""
_SOFT = 3
"""In so many moments either way it comes and goes."""


class Obstacles(NamedTuple):
    """Lines (n moments, m) that labels had better not lie on, each so thick and so much in the way."""

    begin: Loop
    end: Loop
    half: _Floats
    weight: _Floats


_NONE = np.zeros((1, 0), np.complex128)
NO_BARS = Obstacles(_NONE, _NONE, np.zeros(0), np.zeros(0))


class Solid(NamedTuple):
    """What a link covers: all within its corners (n moments, c), in their order, and `half` round it."""

    corners: Loop
    half: float


@dataclass(frozen=True)
class Clutter:
    """What labels must stay off: all that is not `inside`, rectangles, discs (n moments, m); and bars.

    Off the solids only those stay that shun them.
    """

    inside: Rect
    rects: tuple[Rect, ...] = ()
    discs: Loop = field(default_factory=lambda: _NONE)
    radii: _Floats = field(default_factory=lambda: np.zeros(0))
    bars: Obstacles = NO_BARS
    solids: tuple[Solid, ...] = ()

    @cached_property
    def boxes(self) -> tuple[Loop, Loop, _Floats]:
        """Two corners of a box round each solid (n moments, m), and how much more it covers."""
        parts = [(solid.corners.real, solid.corners.imag) for solid in self.solids]
        low, high = (
            np.stack([end(x, axis=1) + 1j * end(y, axis=1) for x, y in parts], axis=1)
            for end in (np.min, np.max)
        )
        return low, high, np.array([solid.half for solid in self.solids])

    def some(self) -> Clutter:
        """Return it at the moments at which places are chosen."""
        bars = self.bars._replace(begin=self.bars.begin[::_STEP], end=self.bars.end[::_STEP])
        solids = tuple(solid._replace(corners=solid.corners[::_STEP]) for solid in self.solids)
        return replace(self, discs=self.discs[::_STEP], bars=bars, solids=solids)


class LabelPlaces(NamedTuple):
    """A label: how large, and where its middle may stand at each of n moments (n, k), at which price.

    `own` are the numbers of the bars that it may lie on; `shunned` (k, m) says of each place which solids
    its middle must not lie on, since the label would seem to be theirs.
    """

    size: tuple[float, float]
    places: Loop
    price: _Floats
    own: tuple[int, ...] = ()
    shunned: _Bools | None = None

    def at(self, which: int) -> LabelPlaces:
        """Return it with this place alone."""
        shunned = None if self.shunned is None else self.shunned[which : which + 1]
        return self._replace(
            places=self.places[:, which : which + 1], price=self.price[which : which + 1], shunned=shunned
        )


class Placed(NamedTuple):
    """Which of its places a label has, and how far it shows at each moment (0 to 1)."""

    which: int
    shown: _Floats


class _Taken(NamedTuple):
    """Where the labels placed so far stand at each moment (n, m), and their sizes (m, 2)."""

    tracks: Loop
    sizes: _Floats


def place(labels: Sequence[LabelPlaces], clutter: Clutter) -> list[Placed]:
    """Return a place for each label; the first have the first choice. One without room shows nowhere."""
    count = max((len(label.places) for label in labels), default=1)
    taken, found = _Taken(np.zeros((count, 0), np.complex128), np.zeros((0, 2))), list[Placed]()
    some = clutter.some()
    for label in labels:
        which = _cheapest(label._replace(places=label.places[::_STEP]), some, taken)
        chosen = label.at(which)
        shown = _eased(_forbidden(chosen, clutter, taken)[:, 0])
        if shown.any():
            track = np.broadcast_to(chosen.places, (count, 1))
            taken = _Taken(np.hstack((taken.tracks, track)), np.vstack((taken.sizes, label.size)))
        found.append(Placed(which, shown))
    return found


def _cheapest(label: LabelPlaces, clutter: Clutter, taken: _Taken) -> int:
    some = taken._replace(tracks=taken.tracks[::_STEP])
    cost = _lying(label, clutter.bars) + _FORBIDDEN * _forbidden(label, clutter, some)
    return int((label.price + cost.mean(axis=0)).argmin())


def _forbidden(label: LabelPlaces, clutter: Clutter, taken: _Taken) -> _Bools:
    """Return whether it would lie on a disc, a rectangle or another label, reach outside, or mislead."""
    (wide, high), places, room = label.size, label.places, clutter.inside
    x, y = places.real, places.imag
    forbidden: _Bools = (x - wide / 2 < room.x) | (x + wide / 2 > room.right)
    forbidden |= (y - high / 2 < room.y) | (y + high / 2 > room.bottom)
    for rect in clutter.rects:
        middle = complex(rect.x + rect.width / 2, rect.y + rect.height / 2)
        forbidden |= _over(places - middle, wide + rect.width, high + rect.height)
    if len(taken.sizes):
        sides = taken.sizes + np.array((wide + 2, high))
        forbidden |= _over(places[:, :, None] - taken.tracks[:, None], *sides.T).any(axis=2)
    if clutter.radii.size:
        near = _near(places, clutter.discs, clutter.discs, wide / 2 + clutter.radii, high / 2 + clutter.radii)
        away = places[:, :, None] - clutter.discs[:, None, near]
        aside = np.maximum(np.abs(away.real) - wide / 2, 0) + 1j * np.maximum(np.abs(away.imag) - high / 2, 0)
        forbidden |= (np.abs(aside) < clutter.radii[near]).any(axis=2)
    return forbidden if label.shunned is None else forbidden | _misleading(label, clutter)


def _misleading(label: LabelPlaces, clutter: Clutter) -> _Bools:
    """Return whether the label's middle would lie on a solid that it shuns there."""
    assert label.shunned is not None
    misleading, close = np.zeros(label.places.shape, np.bool_), _CLOSE * label.size[1]
    if not clutter.solids:
        return misleading
    low, high, half = clutter.boxes
    for n in _near(label.places, low, high, half + close, half + close):
        which, solid = np.flatnonzero(label.shunned[:, n]), clutter.solids[n]
        if which.size:
            off = _off(label.places[:, which], solid.corners)
            misleading[:, which] |= off < solid.half + close
    return misleading


def _lying(label: LabelPlaces, bars: Obstacles) -> _Floats:
    """Return how much each place lies over bars: 0 for none, 1 for right on one, more for more."""
    if not bars.weight.size:
        return np.zeros(label.places.shape)
    (wide, high), weight = label.size, bars.weight.copy()
    weight[list(label.own)] = 0.0
    reach = max(wide - high, 0.0) / 2
    around = bars.half + high / 2
    near = _near(label.places, bars.begin, bars.end, around + reach, around)
    points = label.places[:, :, None, None] + np.array([-reach, 0.0, reach])[:, None]
    away = _distance(points, *(ends[:, None, None, near] for ends in bars[:2]))
    over = np.clip((around[near] - away) / high, 0, 1).max(axis=2)
    lying: _Floats = (over * weight[near] * np.minimum(2 * bars.half[near] / high, 1)).sum(axis=2)
    return lying


def _near(places: Loop, begin: Loop, end: Loop, across: _Floats, down: _Floats) -> NDArray[np.intp]:
    """Return which lines (n, m) come so near to one of the places (n, k) at some moment, in their order."""
    apart = np.zeros(begin.shape, np.bool_)
    for some, first, last, by in (
        (places.real, begin.real, end.real, across),
        (places.imag, begin.imag, end.imag, down),
    ):
        apart |= np.minimum(first, last) > some.max(axis=1, keepdims=True) + by
        apart |= np.maximum(first, last) < some.min(axis=1, keepdims=True) - by
    return np.flatnonzero(~apart.all(axis=0))


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
    squared = np.maximum(along.real**2 + along.imag**2, 1e-9)
    share = np.clip(((points - begin) * np.conj(along)).real / squared, 0, 1)
    away: _Floats = np.abs(points - begin - share * along)
    return away


def _over(away: Loop, width: _Floats | float, height: _Floats | float) -> _Bools:
    return np.asarray((2 * np.abs(away.real) < width) & (2 * np.abs(away.imag) < height))


def _eased(forbidden: _Bools) -> _Floats:
    """Return how far a label shows that must not at some moments; it is gone in time for each."""
    if len(forbidden) == 1 or not forbidden.any():
        return np.where(forbidden, 0.0, 1.0)
    shifts = range(-_GONE - _SOFT, _GONE + _SOFT + 1)
    hidden = np.any([np.roll(forbidden, shift) for shift in shifts], axis=0)
    around = [np.roll(~hidden, shift) for shift in range(-_SOFT, _SOFT + 1)]
    return np.asarray(np.mean(around, axis=0), np.float64)
