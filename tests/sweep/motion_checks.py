"""What every running linkage must keep to, as pure functions of its document and its positions.

Each returns what is wrong in words, or nothing. The bars, lines, slots and gears are read from the
document itself, so nothing is shared with the solver.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Places = Mapping[str, Array]
"""Positions (N, 2) by joint."""

CLOSED = 1e-12
"""Share of the longest link by which a bar may miss its length."""
ZOOM = 8
SPREAD = 1.5
"""Steps to either side of a rough place that the next, finer look covers."""
FINEST = 2e-6
VISIBLE = 1e-9
"""A second difference that is still this share of the size at the finest step is a kink or a jump."""
SMOOTH = 24
"""A bend that falls by more than this where the step falls by ZOOM falls with its square."""
ROUGHEST = 8


def unclosed(document: Mapping[str, Any], places: Places, crank_angle: Array, size: float) -> Iterator[str]:
    """Yield each bar, line, slot, point and gear that positions at these crank angles do not keep to."""
    for what, miss in _misses(document, places, crank_angle):
        worst = float(np.abs(miss).max())
        if not worst <= CLOSED * size:
            yield f"{what} is off by {worst / size:.1e} of the longest link"


def _misses(document: Mapping[str, Any], places: Places, angle: Array) -> Iterator[tuple[str, Array]]:
    for name, table in joint_tables(document).items():
        match table:
            case {"crank": pivot, "length": length}:
                ratio, offset = _gear(table)
                turned = np.stack([np.cos(angle * ratio + offset), np.sin(angle * ratio + offset)], axis=-1)
                yield f"crank {name}", _across(places, pivot, name) - turned * length
            case {"from": [first, second], "length": [near, far]}:
                yield f"bar {first}-{name}", _distance(places, first, name) - near
                yield f"bar {second}-{name}", _distance(places, second, name) - far
            case {"from": end, "length": length, "line": line}:
                yield f"bar {end}-{name}", _distance(places, end, name) - length
                yield f"line of {name}", _aside(places, line, name)
            case {"slot": slot, "length": length}:
                yield f"bar {slot['pivot']}-{name}", _distance(places, slot["pivot"], name) - length
                along, left = _local(places, slot["pivot"], name, slot["through"])
                yield f"slot of {name}", left - slot.get("offset", 0)
            case {"on": [first, second], "at": at}:
                along, left = _local(places, first, second, name)
                yield f"point {name} along", along - at[0]
                yield f"point {name} aside", left - at[1]


def _gear(table: Mapping[str, Any]) -> tuple[float, float]:
    gear = table.get("gear", {"ratio": 1, "offset": "0 deg"})
    return float(Fraction(gear["ratio"])), _radians(gear["offset"])


def _radians(text: str) -> float:
    return math.radians(float(text.removesuffix("deg")))


def _across(places: Places, start: str, end: str) -> Array:
    return places[end] - places[start]


def _distance(places: Places, start: str, end: str) -> Array:
    way = _across(places, start, end)
    return np.asarray(np.hypot(way[:, 0], way[:, 1]))


def _local(places: Places, first: str, second: str, joint: str) -> tuple[Array, Array]:
    """Return how far a joint lies along first -> second and to its left."""
    axis = _across(places, first, second) / _distance(places, first, second)[:, None]
    way = _across(places, first, joint)
    return (axis * way).sum(axis=1), axis[:, 0] * way[:, 1] - axis[:, 1] * way[:, 0]


def _aside(places: Places, line: Mapping[str, Any], joint: str) -> Array:
    angle = _radians(line.get("angle", "0 deg"))
    way = _across(places, line["through"], joint)
    return np.asarray(math.cos(angle) * way[:, 1] - math.sin(angle) * way[:, 0] - line.get("offset", 0))


def joint_tables(document: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """Return the joints as the long form has them, those of a shorthand among them."""
    found: dict[str, Mapping[str, Any]] = {}
    for shorthand, expand in SHORTHANDS.items():
        if shorthand in document:
            found.update(expand(document[shorthand]))
    found.update(document.get("joints", {}))
    return found


def _four_bar(table: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    crank, coupler, rocker = (table[key] for key in ("crank", "coupler", "rocker"))
    if table.get("driver") == "rocker":
        joints: dict[str, Mapping[str, Any]] = {
            "B": {"crank": "O4", "length": rocker},
            "A": {"from": ["B", "O2"], "length": [coupler, crank]},
        }
    else:
        joints = {
            "A": {"crank": "O2", "length": crank},
            "B": {"from": ["A", "O4"], "length": [coupler, rocker]},
        }
    return joints | _coupler_point(table)


def _coupler_point(table: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    return {"P": {"on": ["A", "B"], "at": table["coupler_point"]}} if "coupler_point" in table else {}


def _slider_crank(table: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    line = {"through": "O2", "angle": table.get("line_angle", "0 deg"), "offset": table.get("offset", 0)}
    joints: dict[str, Mapping[str, Any]] = {
        "A": {"crank": "O2", "length": table["crank"]},
        "B": {"from": "A", "length": table["rod"], "line": line},
    }
    return joints | _coupler_point(table)


def _six_bar(table: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    _, r2, r3, r4, _, r6, r7, r8 = table["lengths"]
    angle = _radians(table.get("link_angle", "0 deg"))
    return {
        "A": {"crank": "O2", "length": r2},
        "B": {"from": ["A", "O4"], "length": [r3, r4]},
        "C": {"on": ["O4", "B"], "at": [r6 * math.cos(angle), r6 * math.sin(angle)]},
        "D": {"from": ["C", "O6"], "length": [r7, r8]},
    }


SHORTHANDS: Mapping[str, Callable[[Mapping[str, Any]], dict[str, Mapping[str, Any]]]] = {
    "four-bar": _four_bar,
    "slider-crank": _slider_crank,
    "six-bar": _six_bar,
}


def not_finite(places: Places) -> Iterator[str]:
    """Yield each joint that is not somewhere at every instant."""
    for name, place in places.items():
        lost = int((~np.isfinite(place).all(axis=1)).sum())
        if lost:
            yield f"{name} is nowhere at {lost} of {len(place)} instants"


def kinks(place: Callable[[Array], Array], period: float, steps: int, size: float) -> Iterator[str]:
    """Yield where a closed path (N,) -> (N, K) jumps, or its tangent does.

    Its roughest places are looked at closer and closer: the second difference of a smooth path falls
    with the square of the step, once the step is below the width of its sharpest bend; that of a kink
    with the step, that of a jump not at all.
    """
    step = period / steps
    phases = np.asarray(np.arange(steps) * step, dtype=np.float64)
    centres = phases[_roughest(place(phases))]
    bends = np.full(len(centres), np.inf)
    while step > FINEST and len(centres):
        step /= ZOOM
        before = bends
        centres, bends = _closer(place, centres, step)
        rough = bends > VISIBLE * size
        before, centres, bends = before[rough], centres[rough], bends[rough]
    for centre, bend in zip(centres[bends > before / SMOOTH], bends[bends > before / SMOOTH], strict=True):
        yield (
            f"at phase {float(centre)!r} the path bends by {bend / size:.1e} of the longest link "
            f"within {step:.1e} rad"
        )


def _closer(place: Callable[[Array], Array], centres: Array, step: float) -> tuple[Array, Array]:
    """Return the sharpest bend near each place at a finer step: where it is, and its second difference."""
    reach = math.ceil(SPREAD * ZOOM)
    looks: Array = centres[:, None] + np.arange(-reach, reach + 1) * step
    values = place(looks.reshape(-1)).reshape(*looks.shape, -1)
    bends = np.abs(np.diff(values, 2, axis=1)).max(axis=2)
    bends = np.where(np.isnan(bends), np.inf, bends)
    return looks[np.arange(len(centres)), bends.argmax(axis=1) + 1], bends.max(axis=1)


def _roughest(values: Array) -> NDArray[np.intp]:
    """Return the places where the fourth difference of a closed path is greatest, each a peak."""
    around = np.concatenate([values[-2:], values, values[:2]])
    rough = np.abs(np.diff(around, 4, axis=0)).max(axis=1)
    before, after = np.roll(rough, 1), np.roll(rough, -1)
    peaks = np.flatnonzero((rough >= before) & (rough >= after))
    return peaks[np.argsort(rough[peaks])[::-1][:ROUGHEST]]


def not_back(first: Array, again: Sequence[Array], size: float) -> Iterator[str]:
    """Yield what is wrong with a true period: `again` holds the places after each drive period in turn."""
    gaps = [float(np.abs(later - first).max()) / size for later in again]
    if not gaps[-1] <= 1e-9:
        yield f"it is {gaps[-1]:.1e} of the longest link away after its true period"
    for periods, gap in enumerate(gaps[:-1], 1):
        if gap <= 1e-9 and len(gaps) % periods == 0:
            yield f"it is back after {periods} drive periods already, not {len(gaps)}"
