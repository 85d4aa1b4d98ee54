"""The degrees of freedom of a drawing: two for each joint, less the rank of the constraints."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import numpy as np

from linkanim import units
from linkanim.build.draft import Draft
from linkanim.build.places import crank_of

_ANGLE = 2.399963
"""The angle from one joint's shift to the next one's (rad): the golden angle."""
_SHIFT = 0.07
_RANK = 1e-9
_Row = Mapping[str, complex]
"""The gradient of a constraint: for each joint the complex g of its share Re(conj(g) dz)."""
_Places = Mapping[str, complex]


def mobility(draft: Draft, group: set[str] | None = None) -> int:
    """Return the degrees of freedom of all joints, or of some of them as if the others were not there.

    They are two for each joint, less the rank of the constraints' gradients. The rank is taken in a pose near
    the drawn one that is not singular: a redundant bar does not count, and two bars in line hold like others.
    """
    there = {*draft.places} if group is None else group | draft.of("pins").keys()
    free = [name for name in draft.places if name in there and name not in draft.of("pins")]
    gradients = (row for row in _gradients(draft, _shifted(draft)) if row.keys() <= there)
    rows = [[row.get(name, 0j) for name in free] for row in gradients]
    if not rows or not free:
        return 2 * len(free)
    matrix = np.array(rows)
    matrix = np.hstack([matrix.real, matrix.imag])
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    return 2 * len(free) - int(np.linalg.matrix_rank(matrix / np.where(size > 0, size, 1.0), tol=_RANK))


def _shifted(draft: Draft) -> _Places:
    """Return the joints near where they are drawn, in sizes of the drawing; points go with their bodies."""
    drawn = {name: complex(*place) for name, place in draft.places.items()}
    size = max((abs(one - next(iter(drawn.values()))) for one in drawn.values()), default=0.0) or 1.0
    places: dict[str, complex] = {}
    for n, (name, place) in enumerate(drawn.items()):
        point = draft.of("points").get(name)
        if point:
            start, end = (drawn[one] for one in point["on"])
            share = (place - start) / ((end - start) or 1.0)
            first, second = (places[one] for one in point["on"])
            places[name] = (first + share * (second - first)) / size
        else:
            places[name] = place / size + (name not in draft.of("pins")) * rect(_SHIFT, n * _ANGLE)
    return places


def _gradients(draft: Draft, places: _Places) -> Iterator[_Row]:
    """Yield the gradients of all constraints on joints."""
    for table in draft.of("bars").values():
        first, second = table["joints"]
        direction = _unit(places[second] - places[first])
        yield {first: -direction, second: direction}
    for name, table in draft.of("points").items():
        first, second = table["on"]
        share = (places[name] - places[first]) / ((places[second] - places[first]) or 1.0)
        row = {name: 1 + 0j, first: (share - 1).conjugate(), second: -share.conjugate()}
        yield from (row, {joint: 1j * part for joint, part in row.items()})
    for name, table in draft.of("sliders").items():
        guide = draft.of("guides")[table["guide"]]
        yield _on_line(places, name, guide["through"], guide, 1 + 0j)
    for table in draft.of("slots").values():
        ends = draft.ends(table["bar"])
        yield _on_line(places, table["through"], ends[0], {"on": ends}, 1 + 0j)
    for name, table in draft.of("yokes").items():
        guide = draft.of("guides")[draft.of("sliders")[name]["guide"]]
        yield _on_line(places, table["pin"], name, guide, rect(1.0, units.angle(table["slot"])))
    for name, table in draft.of("gears").items():
        yield _geared(draft, places, name, table)


def _on_line(places: _Places, joint: str, through: str, guide: Mapping[str, Any], turn: complex) -> _Row:
    """Return the gradient of a joint's distance from a line through another, along the guide times `turn`."""
    direction = turn * rect(1.0, units.angle(guide.get("angle", "0 deg")))
    row: dict[str, complex] = {}
    if "on" in guide:
        first, second = guide["on"]
        axis = places[second] - places[first]
        direction *= _unit(axis)
        along = ((places[joint] - places[through]) * direction.conjugate()).real
        turning = 1j * axis * along / (abs(axis) ** 2 or 1.0)
        row = {first: turning, second: -turning}
    for name, part in ((joint, 1j * direction), (through, -1j * direction)):
        row[name] = row.get(name, 0j) + part
    return row


def _geared(draft: Draft, places: _Places, joint: str, gear: Mapping[str, Any]) -> _Row:
    """Return the gradient of a crank's angle less the ratio times its mate's."""
    row: dict[str, complex] = {}
    for name, times in ((joint, 1.0), (gear["with"], -float(Fraction(gear["ratio"])))):
        pivot = crank_of(draft, name)
        arm = places[name] - places[pivot] if pivot else 0j
        turning = times * 1j * arm / (abs(arm) ** 2 or 1.0)
        for end, part in ((name, turning), (pivot or name, -turning)):
            row[end] = row.get(end, 0j) + part
    return row


def _unit(span: complex) -> complex:
    return span / (abs(span) or 1.0)
