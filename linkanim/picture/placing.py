"""Give every label one of its places, once for all moments of a period, or for one pose.

A label has a few places, each of which moves with what it names. A place has a fault at a moment where it
breaks a rule of its own, touches what no label may touch (heads, pins, lines of dimensions, words, other
labels) or leaves the room. Labels choose one after the other, those with the fewest faultless places first.
Bars, plates and curves may be covered, but a place that covers less of them is preferred.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.picture.raster import Loop
from linkanim.picture.view import Rect

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Size = tuple[float, float]
"""How wide and high a label is, in pixels."""

_FAULTY = 100.0
"""What a place costs that has a fault at every moment."""
_COVERING = 0.6
"""What it costs to cover a bar at every moment."""
_COVERING_MOMENTS = 8
"""The moments at which it is asked what a place covers."""
_BETWEEN = 0.35
"""The gap between two labels side by side, in heights of letters."""
_OFF = 0.4
"""How far a dimension's value is off its own line, in gaps between lines; off others' it is a pixel more."""
_SURE = 1e-9


class Alternatives(NamedTuple):
    """A label and its places: their middles (n moments, k places), and what each costs, the best least.

    `faults` (n, k) are breaches of the label's own rules. Places may have `lines` drawn with them (n, k, m
    lines, begin and end). Faults at the moments `excused` (n,) count only where all places have some. A label
    takes a place that has faults in a share `most` of the other moments at the most; with 1 it always has
    one. First lines keep a `gap` from each other, in pixels. Labels of a lower
    `rank` choose first; of one rank those with the fewest places or, where they are `ordered`, as they come.
    """

    size: Size
    places: Loop
    price: Floats
    faults: Bools | None = None
    lines: Loop | None = None
    excused: Bools | None = None
    most: float = 0.0
    gap: float = 0.0
    rank: int = 1
    ordered: bool = False

    @property
    def known_faults(self) -> Bools:
        """Its faults (n, k); none where nothing is known."""
        return np.zeros(self.places.shape, np.bool_) if self.faults is None else self.faults

    @property
    def has_place(self) -> bool:
        """Whether it has a place where no other label is."""
        return bool(self.allowed(self.known_faults)[1].any())

    def allowed(self, faults: Bools) -> tuple[Floats, Bools]:
        """Return in what share of the moments places have faults that count, and which it may take."""
        counted = faults if self.excused is None else faults & ~self.excused[:, None]
        share: Floats = counted.mean(axis=0)
        most = max(self.most, float(share.min()) if self.most >= 1 else 0.0)
        return share, np.asarray(share <= most + _SURE)

    def at(self, number: int) -> Alternatives:
        """Return the label with one of its places alone."""
        some = slice(number, number + 1)
        return self._replace(
            places=self.places[:, some],
            price=self.price[some],
            faults=None if self.faults is None else self.faults[:, some],
            lines=None if self.lines is None else self.lines[:, some],
        )


def _swept(label: Alternatives) -> Floats:
    """Return the rectangle that holds a label in all its places, and the lines drawn with it.

    Its edges (left, right, top, bottom; n moments; 1).
    """
    (wide, high), places = label.size, label.places
    x, y = places.real, places.imag
    left, right = x.min(axis=1) - wide / 2, x.max(axis=1) + wide / 2
    top, bottom = y.min(axis=1) - high / 2, y.max(axis=1) + high / 2
    if label.lines is not None:
        x, y = (part.reshape(len(part), -1) for part in (label.lines.real, label.lines.imag))
        left, right = np.minimum(left, x.min(axis=1)), np.maximum(right, x.max(axis=1))
        top, bottom = np.minimum(top, y.min(axis=1)), np.maximum(bottom, y.max(axis=1))
    return np.stack([left, right, top, bottom])[:, :, None]


def _bounds(lines: Loop) -> Floats:
    """Return the edges (left, right, top, bottom; n moments; m) of lines (n, m, begin and end)."""
    x, y = lines.real, lines.imag
    return np.stack([x.min(axis=2), x.max(axis=2), y.min(axis=2), y.max(axis=2)])


def _meet(one: Floats, others: Floats, margin: Floats | float) -> Bools:
    """Return which of some rectangles (m,) ever come nearer to one than a margin, by their edges."""
    meets = (others[1] + margin > one[0]) & (others[0] - margin < one[1])
    meets &= (others[3] + margin > one[2]) & (others[2] - margin < one[3])
    return np.asarray(meets.any(axis=0))


class Obstacles(NamedTuple):
    """What labels keep off at each of n moments (arrays may have one moment for all).

    All that is not `inside`; rectangles given by their middles (n, m) and sizes (m, 2); discs (n, m) with
    radii (m,); `lines` (n, m, begin and end), half as thick as `halves` (m,). `bars`, likewise, may be
    covered.
    """

    inside: Rect
    rects: Loop = np.zeros((1, 0), np.complex128)
    sizes: Floats = np.zeros((0, 2))
    discs: Loop = np.zeros((1, 0), np.complex128)
    radii: Floats = np.zeros(0)
    lines: Loop = np.zeros((1, 0, 2), np.complex128)
    halves: Floats = np.zeros(0)
    bars: Loop = np.zeros((1, 0, 2), np.complex128)
    thick: Floats = np.zeros(0)


def weighed(label: Alternatives, ground: Obstacles) -> Alternatives:
    """Return a label with the faults and prices that its places have on the ground."""
    faults = _faults(label, ground)
    return label._replace(faults=faults, price=label.price + _COVERING * _covered(label, ground))


def chosen(labels: Sequence[Alternatives], ground: Obstacles | None = None) -> list[int | None]:
    """Return the number of the place that each label takes; None for a label without a place.

    Labels that are weighed already need no ground.
    """
    labels = [weighed(one, ground) for one in labels] if ground else labels
    moments = len(labels[0].places) if labels else 0
    known = [one.known_faults for one in labels]
    free = [int((~faults.any(axis=0)).sum()) for faults in known]
    choice: list[int | None] = [None] * len(labels)
    placed = list[Alternatives]()
    edges, margins = np.empty((4, moments, len(labels))), np.empty(len(labels))
    for n in sorted(range(len(labels)), key=lambda n: (labels[n].rank, not labels[n].ordered and free[n], n)):
        label, faults, count = labels[n], known[n], len(placed)
        near = np.flatnonzero(_meet(_swept(label), edges[:, :, :count], label.gap + margins[:count]))
        if near.size:
            faults = faults | _hit_by(label, [placed[other] for other in near])
        share, allowed = label.allowed(faults)
        if not allowed.any():
            continue
        cost = np.where(allowed, label.price + _FAULTY * share + faults.mean(axis=0), np.inf)
        best = choice[n] = int(cost.argmin())
        placed.append(label.at(best))
        edges[:, :, count : count + 1], margins[count] = _swept(placed[-1]), label.size[1]
    return choice


def grounded(
    inside: Rect, rects: Sequence[Rect] = (), lines: Sequence[tuple[complex, complex]] = (), half: float = 0.0
) -> Obstacles:
    """Return what labels of a single moment keep off: rectangles, and lines half as thick as `half`."""
    middles = np.array([[rect.middle for rect in rects]], np.complex128).reshape(1, -1)
    sizes = np.array([(rect.width, rect.height) for rect in rects]).reshape(-1, 2)
    ends = np.array([lines], np.complex128).reshape(1, -1, 2)
    return Obstacles(inside, middles, sizes, lines=ends, halves=np.full(ends.shape[1], half))


def _faults(label: Alternatives, ground: Obstacles) -> Bools:
    """Return where a label's places (n, k) break a rule, without other labels."""
    places, (wide, high), swept = label.places, label.size, _swept(label)
    room = ground.inside
    x, y = places.real, places.imag
    out = (x < room.x + wide / 2 - _SURE) | (x > room.right - wide / 2 + _SURE)
    out |= (y < room.y + high / 2 - _SURE) | (y > room.bottom - high / 2 + _SURE)
    if label.faults is not None:
        out |= label.faults
    points = np.stack([ground.discs.real, ground.discs.real, ground.discs.imag, ground.discs.imag])
    near = _meet(swept, points, ground.radii + 1.0)
    discs, radii = ground.discs[:, near], ground.radii[near]
    if discs.size:
        out |= (_off(places, label.size, discs) < radii).any(axis=2)
    if ground.rects.size:
        out |= _overlap(places, label.size, ground.rects, ground.sizes).any(axis=2)
    near = _meet(swept, _bounds(ground.lines), ground.halves + 1.0)
    if near.any():
        out |= crossed(places, label.size, ground.lines[:, near], ground.halves[near]).any(axis=2)
    if label.lines is not None:
        for n in range(label.lines.shape[2]):
            line = label.lines[:, :, n]
            if ground.rects.size:
                out |= _run_over(line, ground.rects, ground.sizes, np.ones(len(ground.sizes)))
            if n == 0 and discs.size:
                out |= (_apart(discs[:, None], line[:, :, None]) < radii).any(axis=2)
    return out


def _hit_by(label: Alternatives, others: Sequence[Alternatives]) -> Bools:
    """Return where a label's places meet other labels, which have one each, or the lines drawn with them."""
    middles = np.concatenate([one.places for one in others], axis=1)
    sizes = np.array([one.size for one in others])
    apart = sizes + _BETWEEN * sizes[:, 1:] * (1.0, 0.0)
    hit: Bools = np.asarray(_overlap(label.places, label.size, middles, apart).any(axis=2))
    lines = [one.lines[:, 0] for one in others if one.lines is not None]
    if lines:
        drawn = np.concatenate(lines, axis=1)
        hit |= crossed(label.places, label.size, drawn, np.ones(drawn.shape[1])).any(axis=2)
    if label.lines is None:
        return hit
    for n in range(label.lines.shape[2]):
        clear = np.array([1.0 + (0.0 if n else _OFF * one.gap) for one in others])
        hit |= _run_over(label.lines[:, :, n], middles, sizes, clear)
    if lines and label.gap:
        firsts = np.stack([some[:, 0] for some in lines], axis=1)
        hit |= (_between(label.lines[:, :, 0, None], firsts[:, None]) < label.gap).any(axis=2)
        clear = np.full(len(lines), 1.0 + _OFF * label.gap)
        hit |= crossed(label.places, label.size, firsts, clear).any(axis=2)
    return hit


def _covered(label: Alternatives, ground: Obstacles) -> Floats:
    """Return for each place how many bars it covers, in the mean over the moments."""
    if not ground.bars.size:
        return np.zeros(label.places.shape[1])
    every = max(len(label.places) // _COVERING_MOMENTS, 1)
    places, bars = label.places[::every], ground.bars[::every]
    swept = _swept(label._replace(places=places, lines=None))
    near = _meet(swept, _bounds(bars), ground.thick + 1.0)
    covered = crossed(places, label.size, bars[:, near], ground.thick[near])
    return np.asarray(covered.sum(axis=2).mean(axis=0), np.float64)


def _overlap(places: Loop, size: Size, others: Loop, sizes: Floats) -> Bools:
    """Return whether rectangles at places (n, k) overlap others (n, m), as (n, k, m)."""
    away = places[:, :, None] - others[:, None]
    reach = (np.asarray(size) + sizes) / 2
    overlap: Bools = (np.abs(away.real) < reach[:, 0] - _SURE) & (np.abs(away.imag) < reach[:, 1] - _SURE)
    return overlap


def _off(places: Loop, size: Size, points: Loop) -> Floats:
    """Return how far points (n, m) are from rectangles at places (n, k), as (n, k, m); 0 inside."""
    away = points[:, None] - places[:, :, None]
    x = np.maximum(np.abs(away.real) - size[0] / 2, 0.0)
    y = np.maximum(np.abs(away.imag) - size[1] / 2, 0.0)
    distance: Floats = np.hypot(x, y)
    return distance


def crossed(places: Loop, size: Size, lines: Loop, halves: Floats) -> Bools:
    """Return whether rectangles at places (n, k) meet thick lines (n, m, 2), as (n, k, m).

    Separating axes: the two of the rectangle, and the normal of the line.
    """
    middle = ((lines[..., 0] + lines[..., 1]) / 2)[:, None] - places[:, :, None]
    arm = ((lines[..., 1] - lines[..., 0]) / 2)[:, None]
    wide, high = size[0] / 2 + halves, size[1] / 2 + halves
    across = np.abs(middle.real * arm.imag - middle.imag * arm.real)
    crossed: Bools = (
        (np.abs(middle.real) < wide + np.abs(arm.real))
        & (np.abs(middle.imag) < high + np.abs(arm.imag))
        & (across < wide * np.abs(arm.imag) + high * np.abs(arm.real) + _SURE)
    )
    return crossed


def _run_over(lines: Loop, others: Loop, sizes: Floats, clear: Floats) -> Bools:
    """Return whether lines (n, k, 2) come as near as `clear` (m,) to any of some rectangles (n, m)."""
    middle = ((lines[..., 0] + lines[..., 1]) / 2)[:, :, None] - others[:, None]
    arm = ((lines[..., 1] - lines[..., 0]) / 2)[:, :, None]
    wide, high = sizes[:, 0] / 2 + clear, sizes[:, 1] / 2 + clear
    across = np.abs(middle.real * arm.imag - middle.imag * arm.real)
    meets = (np.abs(middle.real) < wide + np.abs(arm.real)) & (np.abs(middle.imag) < high + np.abs(arm.imag))
    meets &= across < wide * np.abs(arm.imag) + high * np.abs(arm.real)
    return np.asarray(meets.any(axis=2))


def _apart(points: ArrayLike, lines: Loop) -> Floats:
    """Return the distances of points from lines from begin to end (last axis of `lines`)."""
    at, begin, end = np.asarray(points), lines[..., 0], lines[..., 1]
    way = end - begin
    square = np.maximum((way * way.conj()).real, 1e-12)
    share = np.clip(((at - begin) * way.conj()).real / square, 0.0, 1.0)
    distance: Floats = np.abs(at - begin - share * way)
    return distance


def _between(lines: Loop, others: Loop) -> Floats:
    """Return the distances of lines from others, with their ends on the last axis; 0 where they cross."""
    ways, other_ways = lines[..., 1] - lines[..., 0], others[..., 1] - others[..., 0]

    def side(way: Loop, at: Loop) -> Floats:
        return np.asarray(way.real * at.imag - way.imag * at.real, np.float64)

    ends = [
        _apart(lines[..., 0], others),
        _apart(lines[..., 1], others),
        _apart(others[..., 0], lines),
        _apart(others[..., 1], lines),
    ]
    crosses = (
        side(ways, others[..., 0] - lines[..., 0]) * side(ways, others[..., 1] - lines[..., 0]) < 0
    ) & (
        side(other_ways, lines[..., 0] - others[..., 0]) * side(other_ways, lines[..., 1] - others[..., 0])
        < 0
    )
    return np.where(crosses, 0.0, np.min(np.broadcast_arrays(*ends), axis=0))


def off_lines(points: Loop, lines: Loop) -> Floats:
    """Return how far points (n, k) are from lines (n, m, 2), as (n, k, m)."""
    return _apart(points[:, :, None], lines[:, None])


def off_rects(places: Loop, size: Size, lines: Loop) -> Floats:
    """Return how far lines (n, m, 2) are from rectangles at places (n, k), as (n, k, m)."""
    wide, high = size[0] / 2, size[1] / 2
    corners = places[:, :, None] + np.array(
        [-wide - 1j * high, wide - 1j * high, wide + 1j * high, -wide + 1j * high]
    )
    nearest = np.min([_apart(corners[:, :, None, n], lines[:, None]) for n in range(4)], axis=0)
    ends = np.minimum(_off(places, size, lines[..., 0]), _off(places, size, lines[..., 1]))
    distance = np.minimum(nearest, ends)
    distance[crossed(places, size, lines, np.zeros(lines.shape[1]))] = 0.0
    return np.asarray(distance, np.float64)
