"""Numbers over a period as tables that a page reads between their entries, with poles, corners and jumps.

A table has parts with equal steps, and a page reads it by the cubic through the four entries nearest to a
place. A part ends where a swing turns back and where values are unbounded; and it is halved, again and again,
where the cubic is off, so that a corner or a jump has parts of its own, too small to be seen.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.scenes.scene import Scene
from linkanim.share.movers import LARGEST_SINGLE, packed

Values = NDArray[np.float64]
Read = Callable[[Values], Values]
"""Returns rows of values (k, n) at phases (n,)."""

_MOMENTS, _A_TURN, _MOST = 64, 12, 2880
"""The steps of a table for a turn of the drive, for one of the quickest crank, before parts are halved; and
about the most in all."""
_INSIDE = 1e-7
"""How far inside a part its first and last entry lie, in phase."""
_NEAR, _NEARER, _AT = 1e-3, 1e-4, 1e-6
"""The distances from a place, in phase, at which it is measured how steeply values grow towards it."""
_LARGE = 2.0
"""Values that are unbounded at a place are so many times as large nearest to it."""
_FINEST = 2.0**-20
"""The share of a period below which a part is not halved."""
_SHARE = 1e-5
"""The share of a value by which a table may be off."""


Pole = tuple[float, int]
"""Where values are unbounded, as a share of the period, and the power with which they grow."""


class Tabulated(NamedTuple):
    """Values (k, n) in parts from `ends` to `ends`, shares of the whole, of so many `steps`.

    They are multiplied by |sin π(φ/period - place)| to the power of each pole.
    """

    values: Values
    ends: tuple[float, ...]
    steps: tuple[int, ...]
    poles: tuple[Pole, ...]

    @property
    def data(self) -> dict[str, Any]:
        """What a page is told of the parts, places with all their digits."""
        poles = {"poles": packed(self.poles, "<f8")} if self.poles else {}
        return {"ends": packed(self.ends, "<f8"), "steps": list(self.steps), **poles}


def table(
    scene: Scene, whole: tuple[float, float], read: Read, unbounded: Sequence[float], near: float
) -> Tabulated:
    """Return the table of values from one phase to another, a true period on or back.

    `unbounded` are the phases at which some value is unbounded, beside those at which a swing turns back. A
    reading between two entries is off by `near` at the most, or by a small share of the value.
    """
    turned = [math.pi * n for n in range(0 if scene.info.full_turn else round(scene.period / math.pi))]
    places = _apart(sorted({*turned, *(place % scene.period for place in unbounded)}), scene.period)
    poles = tuple(_poles(read, places, scene.period))
    parts = sorted(_Sought(scene, whole, read, poles, near).parts(places))
    values = np.concatenate([values for *_, values in parts], axis=1)
    ends = (*(low for low, *_ in parts), 1.0)
    return Tabulated(values, ends, tuple(steps for _, _, steps, _ in parts), poles)


def _apart(places: Sequence[float], period: float) -> list[float]:
    """Return places of a period, those of neighbours that differ by rounding alone once."""
    near = _INSIDE
    once = [one for one, other in pairwise([*places, math.inf]) if other - one > near]
    return once[:-1] if len(once) > 1 and once[0] + period - once[-1] <= near else once


def _poles(read: Read, places: Sequence[float], period: float) -> Iterator[Pole]:
    for place in places:
        far, nearer, here = np.max(np.abs(read(place + np.array([_NEAR, _NEARER, _AT]))), axis=0).tolist()
        if 0 < far < nearer and here > _LARGE * nearer:
            growth = math.log(nearer / far, _NEAR / _NEARER) if nearer < math.inf else 1.0
            yield place / period, max(round(growth), 1)


class _Sought(NamedTuple):
    """What a table is made of: the scene, where it begins and ends, its values, their poles, how near."""

    scene: Scene
    whole: tuple[float, float]
    read: Read
    poles: tuple[Pole, ...]
    near: float

    def weight(self, phases: Values) -> Values:
        """Return the factors (n,) that keep values from growing towards the poles."""
        weights = np.ones_like(phases)
        for place, power in self.poles:
            weights *= np.abs(np.sin((phases / self.scene.period - place) * math.pi)) ** power
        return weights

    def parts(self, places: Sequence[float]) -> Iterator[tuple[float, float, int, Values]]:
        """Yield the parts with their values, in any order; no part goes over one of the places."""
        open_, size = self._first(places), 0
        while open_:
            halves: list[_Part] = []
            for (low, high, steps), held, good in self._looked_at(open_):
                if good or high - low < _FINEST or size + sum(one[2] for one in halves) > 2 * _MOST:
                    size += steps
                    yield low, high, steps, held
                    continue
                middle, fewer = (low + high) / 2, max(math.ceil(steps / 2), 3)
                halves += [(low, middle, fewer), (middle, high, fewer)]
            open_ = halves

    def _first(self, places: Sequence[float]) -> list[_Part]:
        begin, end = self.whole
        shares = sorted((place - begin) / (end - begin) % 1.0 for place in places)
        inner = [share for share in shares if _FINEST < share < 1.0 - _FINEST]
        ends = [0.0, *(one for one, other in pairwise([*inner, 1.0]) if other - one > _FINEST), 1.0]
        mechanism, period = self.scene.mechanism, self.scene.period
        count = min(mechanism.count(_MOMENTS * round(period / math.tau), a_turn=_A_TURN), _MOST)
        return [(low, high, max(math.ceil(count * (high - low)), 3)) for low, high in pairwise(ends)]

    def _looked_at(self, parts: Sequence[_Part]) -> Iterator[tuple[_Part, Values, bool]]:
        """Yield each part with its values as the table has them, and whether a reading between is right."""
        begin, end = self.whole
        inside = math.copysign(_INSIDE, end - begin)
        way = [
            (begin + (end - begin) * low + inside, begin + (end - begin) * high - inside)
            for low, high, _ in parts
        ]
        phases = [np.linspace(*ends, 2 * part[2] + 1) for ends, part in zip(way, parts, strict=True)]
        read = self.read(np.concatenate(phases))
        first = 0
        for part, own in zip(parts, phases, strict=True):
            values, weight = read[:, first : first + len(own)], self.weight(own)
            first += len(own)
            held, true = (values * weight)[:, ::2], values[:, 1::2]
            with np.errstate(invalid="ignore"):
                off = np.abs(_between(held) / weight[1::2] - true)
                wrong = off > np.maximum(self.near, _SHARE * np.abs(true))
            yield part, held, not wrong.any()


_Part = tuple[float, float, int]
"""Where a part begins and ends, as shares of the whole, and its steps."""


def _between(held: Values) -> Values:
    """Return what a page reads in the middle of each step: by the cubic through the four nearest entries."""
    count = held.shape[1] - 1
    first = np.clip(np.arange(count) - 1, 0, count - 3)
    t = np.arange(count) + 0.5 - first
    a, b, c, d = (held[:, first + n] for n in range(4))
    with np.errstate(invalid="ignore"):
        cubic: Values = (t - 1) * (t - 2) * (d * t - a * (t - 3)) / 6 + t * (t - 3) * (
            b * (t - 2) - c * (t - 1)
        ) / 2
    return cubic


def kind_of(values: Values) -> str:
    """Return the type of numbers that holds values: floats of 32 bits, or of 64 where one is too large."""
    largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
    return "<f4" if largest < LARGEST_SINGLE else "<f8"
