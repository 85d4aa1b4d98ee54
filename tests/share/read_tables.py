"""The numbers of a page, read from its tables as its script reads them, by a formula of its own."""

from __future__ import annotations

import base64
import math
from typing import Any

import numpy as np


def unpacked(held: dict[str, Any], packed: str) -> Any:
    return np.frombuffer(base64.b64decode(packed), f"<{held.get('kind', 'f4')}").astype(float)


def read(held: dict[str, Any], packed: str, data: dict[str, Any], phase: float, *, back: bool) -> float:
    """Return a table's value at a phase, of one that runs `back` in its order: by Neville's scheme."""
    table, period = unpacked(held, packed).reshape(data["parts"], -1), math.tau * round(data["period"] / 6.28)
    there = phase % period
    part = min(int(there / (period / data["parts"])), data["parts"] - 1)
    if data["retraced"] and there == math.pi:
        part = 0  # the end of the way there
    along = there / (period / data["parts"]) - part
    part, along = (data["parts"] - 1 - part, 1 - along) if back else (part, along)
    place = along * (table.shape[1] - 1)
    first = min(max(int(place) - 1, 0), table.shape[1] - 4)
    column = table[part, first : first + 4].tolist()
    for step in range(1, 4):
        column = [
            ((place - first - n) * column[n + 1] - (place - first - n - step) * column[n]) / step
            for n in range(4 - step)
        ]
    low, high = held.get("poles", (0, 0))
    sides = [0.0 if abs(side) < 1e-14 else abs(side) for side in (math.sin(phase / 2), math.cos(phase / 2))]
    weight = sides[0] ** low * sides[1] ** high
    return column[0] / weight if weight else math.inf


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
