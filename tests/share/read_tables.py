"""The numbers of a page, read from its tables as its script reads them, by a formula of its own."""

from __future__ import annotations

import base64
import math
from bisect import bisect_right
from typing import Any

import numpy as np


def unpacked(held: dict[str, Any], packed: str) -> Any:
    return np.frombuffer(base64.b64decode(packed), f"<{held.get('kind', 'f4')}").astype(float)


def exactly(packed: str) -> list[float]:
    """Return numbers of 64 bits."""
    return list(np.frombuffer(base64.b64decode(packed), "<f8").tolist())


def read(held: dict[str, Any], packed: str, data: dict[str, Any], phase: float, *, back: bool) -> float:
    """Return a table's value at a phase, of one that runs `back` in its order: by Neville's scheme."""
    return read_values(held, unpacked(held, packed), data, phase, back=back)


def read_values(held: dict[str, Any], table: Any, data: dict[str, Any], phase: float, *, back: bool) -> float:
    """Return what a table of these entries has at a phase, as `read` does."""
    period = math.tau * round(data["period"] / 6.28)
    there = phase % period
    if data["retraced"] and there == math.pi:
        there *= 1 - 1e-12  # the end of the way there
    share = 1 - there / period if back else there / period
    return _within(held, table, share) / weight if (weight := _weight(held, phase, period)) else math.inf


def charted_over_angle(data: dict[str, Any], phase: float, *, back: bool = False) -> list[float]:
    """Return what the cursor of the chart of an input that turns says at a phase, of each curve."""
    chart = data["sides"][0]["charts"][int(back)]
    origin, scale, span = chart["course"]
    period, share = math.tau * round(data["period"] / 6.28), (phase - origin) / scale % span / span
    return [
        _within(curve, unpacked(curve, curve["values"]), share) / _weight(curve, phase, period)
        for curve in chart["curves"]
    ]


def _within(held: dict[str, Any], table: Any, share: float) -> float:
    """Return what a table has at a share of its whole, between four entries of the part that this lies in."""
    ends, steps = exactly(held["ends"]), held["steps"]
    part = min(bisect_right(ends, share), len(steps)) - 1
    begin, count = sum(steps[:part]) + part, steps[part]
    place = (share - ends[part]) / (ends[part + 1] - ends[part]) * count
    first = min(max(int(place) - 1, 0), count - 3)
    column = table[begin + first : begin + first + 4].tolist()
    for step in range(1, 4):
        column = [
            ((place - first - n) * column[n + 1] - (place - first - n - step) * column[n]) / step
            for n in range(4 - step)
        ]
    return float(column[0]) if math.isfinite(column[0]) else float(table[begin + int(place)])


def _weight(held: dict[str, Any], phase: float, period: float) -> float:
    told = exactly(held.get("poles", ""))
    sides = [
        (abs(math.sin((phase / period - at) * math.pi)), n)
        for at, n in zip(told[::2], told[1::2], strict=True)
    ]
    return float(math.prod((0.0 if side < 1e-14 else side) ** power for side, power in sides))


def row(data: dict[str, Any], label: str, phase: float, *, back: bool = False) -> float:
    """Return what a row of a page's first side has at a phase, forth or back."""
    held = next(one for one in data["sides"][0]["rows"] if one["label"] == label)
    sign = held["back"] if back and held["back"] else 1
    packed = held["values"][1 if back and not held["back"] else 0]
    return sign * read(held, packed, data, phase, back=False)


def charted(data: dict[str, Any], phase: float, *, back: bool = False) -> list[float]:
    """Return what the cursor of a swing's chart says at a phase, of each curve."""
    chart = data["sides"][0]["charts"][int(back)]
    runs_back = chart["course"][1] < 0
    return [read(curve, curve["values"], data, phase, back=runs_back) for curve in chart["curves"]]
