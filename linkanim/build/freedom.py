"""What holds the joints of a drawing: how free they are, and where they stand when all of it holds.

A constraint is a number that must vanish, and its gradient. The degrees of freedom are two for each joint,
less the rank of the gradients; joints are fitted by Newton's steps, each the shortest.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from math import remainder, tau
from typing import Any

import numpy as np

from linkanim import units
from linkanim.build.draft import DRIVE, Draft
from linkanim.build.places import as_point, crank_of, lengths_within, place_of

_ANGLE = 2.399963
"""The angle from one joint's shift to the next one's (rad): the golden angle."""
_SHIFT = 0.07
_RANK = 1e-9
_STEPS = 60
_EXACT = 1e-13
"""How far off, in sizes of the drawing, a constraint may be that holds."""
_LONGEST_STEP = 0.2
"""The longest of Newton's steps, in sizes of the drawing."""
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
    return 2 * len(free) - _rank(free, [row for row in _gradients(draft) if row.keys() <= there])


def redundant_bar(draft: Draft) -> str | None:
    """Return a bar without which no joint is freer, the one drawn last; None where there is none.

    Bars within a body of three joints or more do not count.
    """
    free = [name for name in draft.places if name not in draft.of("pins")]
    within, bars = lengths_within(draft), [*draft.of("bars")]
    rows = [row for n, row in enumerate(_gradients(draft)) if n >= len(bars) or bars[n] not in within]
    own = [name for name in bars if name not in within]
    rank = _rank(free, rows)
    if rank == len(rows):
        return None
    last = (n for n in reversed(range(len(own))) if _rank(free, rows[:n] + rows[n + 1 :]) == rank)
    return next((own[n] for n in last), None)


def _gradients(draft: Draft) -> list[_Row]:
    """Return the gradients of all constraints, those of bars first, in a pose that is not singular."""
    return [row for row, _ in _constraints(draft, _shifted(draft), _size(draft))]


def _rank(free: list[str], gradients: list[_Row]) -> int:
    rows = [[row.get(name, 0j) for name in free] for row in gradients]
    if not rows or not free:
        return 0
    matrix = np.array(rows)
    matrix = np.hstack([matrix.real, matrix.imag])
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    return int(np.linalg.matrix_rank(matrix / np.where(size > 0, size, 1.0), tol=_RANK))


def assembled(draft: Draft) -> Draft | None:
    """Return the draft with its joints where all of its numbers hold, the nearest; None where none is near.

    The driven crank stays where it is drawn, or where its start angle is typed, if the others can follow.
    """
    crank = _crank_end(draft)
    held = _assembled(draft.placing(*crank), {crank[0]}) if crank else None
    return held or _assembled(draft, set())


def _crank_end(draft: Draft) -> tuple[str, complex] | None:
    """Return the end of the driven crank, and where it is; None where something else drives."""
    joint = draft.driven
    pivot = crank_of(draft, joint) if joint and not draft.drive.keys() & {"slider", "cylinder"} else None
    bar = draft.bar(joint, pivot) if joint and pivot and pivot in draft.of("pins") else None
    if joint is None or pivot is None or bar is None:
        return None
    turn = phase(place_of(draft, joint) - place_of(draft, pivot))
    if (*DRIVE, "start") in draft.typed:
        turn = units.angle(draft.drive["start"])
    return joint, place_of(draft, pivot) + rect(_length(draft, draft.of("bars")[bar]["length"]), turn)


def _assembled(draft: Draft, held: set[str]) -> Draft | None:
    size = _size(draft)
    places = {name: complex(*place) / size for name, place in draft.places.items()}
    free = [name for name in draft.places if name not in draft.of("pins") and name not in held]
    for _ in range(_STEPS):
        constraints = [*_constraints(draft, places, size)]
        off = np.array([value for _, value in constraints])
        if not len(off) or abs(off).max() <= _EXACT:
            whole = {name: as_point(place * size) for name, place in places.items() if name in free}
            return replace(draft, places={**draft.places, **whole})
        rows = np.array([[row.get(name, 0j) for name in free] for row, _ in constraints])
        step = np.linalg.lstsq(np.hstack([rows.real, rows.imag]), -off, rcond=_RANK)[0]
        step *= min(1.0, _LONGEST_STEP / (abs(step).max() or 1.0))
        for n, name in enumerate(free):
            places[name] += complex(step[n], step[n + len(free)])
    return None


def _size(draft: Draft) -> float:
    """Return how far the joints lie apart."""
    drawn = [complex(*place) for place in draft.places.values()]
    return max((abs(one - drawn[0]) for one in drawn), default=0.0) or 1.0


def _shifted(draft: Draft) -> _Places:
    """Return the joints near where they are drawn, in sizes of the drawing; points go with their bodies."""
    drawn = {name: complex(*place) for name, place in draft.places.items()}
    size = _size(draft)
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


def _constraints(draft: Draft, places: _Places, size: float) -> Iterator[tuple[_Row, float]]:
    """Yield all constraints on joints: the gradient of each, and by how much it does not hold."""
    for table in draft.of("bars").values():
        first, second = table["joints"]
        span = places[second] - places[first]
        direction = _unit(span)
        yield {first: -direction, second: direction}, abs(span) - _length(draft, table["length"]) / size
    for name, table in draft.of("points").items():
        first, second = table["on"]
        at = complex(*(_length(draft, part) for part in table["at"])) / size
        share = at / (abs(places[second] - places[first]) or 1.0)
        if bar := draft.bar(first, second):
            share = at * size / _length(draft, draft.of("bars")[bar]["length"])
        off = places[name] - places[first] - share * (places[second] - places[first])
        share = (places[name] - places[first]) / ((places[second] - places[first]) or 1.0)
        row = {name: 1 + 0j, first: (share - 1).conjugate(), second: -share.conjugate()}
        yield row, off.real
        yield {joint: 1j * part for joint, part in row.items()}, off.imag
    for name, table in draft.of("sliders").items():
        guide = draft.of("guides")[table["guide"]]
        offset = _length(draft, guide.get("offset", 0)) / size
        yield _on_line(places, name, guide.get("through") or guide["on"][0], guide, 1 + 0j, offset)
    for table in draft.of("slots").values():
        ends = draft.ends(table["bar"])
        offset = _length(draft, table.get("offset", 0)) / size
        yield _on_line(places, table["through"], ends[0], {"on": ends}, 1 + 0j, offset)
    for name, table in draft.of("yokes").items():
        guide = draft.of("guides")[draft.of("sliders")[name]["guide"]]
        yield _on_line(places, table["pin"], name, guide, rect(1.0, units.angle(table["slot"])), 0.0)
    for name, table in draft.of("gears").items():
        yield _geared(draft, places, name, table)


def _length(draft: Draft, stated: Any) -> float:
    return units.length(stated, unit=draft.unit)


def _on_line(
    places: _Places, joint: str, through: str, guide: Mapping[str, Any], turn: complex, offset: float
) -> tuple[_Row, float]:
    """Return the constraint that a joint is on a line, `offset` to the left of another joint.

    The line's direction is the guide's, times `turn`.
    """
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
    return row, ((places[joint] - places[through]) * direction.conjugate()).imag - offset


def _geared(draft: Draft, places: _Places, joint: str, gear: Mapping[str, Any]) -> tuple[_Row, float]:
    """Return the constraint that a crank's angle, less the ratio times its mate's, is the offset."""
    row: dict[str, complex] = {}
    ratio, off = Fraction(gear["ratio"]), -units.angle(gear.get("offset", "0 deg"))
    for name, times in ((joint, 1.0), (gear["with"], -float(ratio))):
        pivot = crank_of(draft, name)
        arm = places[name] - places[pivot] if pivot else 0j
        off += times * phase(arm)
        turning = times * 1j * arm / (abs(arm) ** 2 or 1.0)
        for end, part in ((name, turning), (pivot or name, -turning)):
            row[end] = row.get(end, 0j) + part
    # whole turns of the mate do not show in its angle
    return row, remainder(off, tau / ratio.denominator)


def _unit(span: complex) -> complex:
    return span / (abs(span) or 1.0)
