"""Places and numbers: what numbers are where a joint is drawn, and where joints are by their numbers."""

from __future__ import annotations

from cmath import polar, rect
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import degrees, sqrt
from typing import Any

from linkanim import units
from linkanim.build.draft import DRIVE, Draft
from linkanim.build.order import lengths_within, line_of, place_of
from linkanim.build.rounding import round_angle, round_degrees, round_length, round_number
from linkanim.scenes.editing.edit import replaced


def moved(draft: Draft, joint: str, place: complex, snap: float, phase: float | None = 0.0) -> Draft:
    """Return the draft with a joint at a place, and with the numbers that follow it, but for typed ones.

    The drive's start follows a crank that has turned by `phase` since; None of one that does not turn fully.
    """
    if joint in draft.of("sliders"):
        place = foot(draft, draft.of("sliders")[joint]["guide"], place)
    draft = draft.placing(joint, place)
    sides = draft.of("sides").items()
    kept = {name: table for name, table in sides if joint != name and joint not in table["joints"]}
    draft = draft.having_all("sides", kept)
    for key, value in list(_following(draft, joint, snap, phase)):
        draft = draft if key in draft.typed else with_number(draft, key, value)
    return fitted(draft)


def with_number(draft: Draft, key: tuple[str | int, ...], value: object) -> Draft:
    """Return the draft with another number at a key: kind, name, and the way into that table."""
    kind, name = str(key[0]), str(key[1])
    return draft.having(kind, name, replaced(draft.of(kind)[name], key[2:], value))


def at_on(draft: Draft, on: list[str], place: complex, snap: float) -> list[int | float]:
    """Return where a place lies on a body, along its axis and to the left."""
    start, end = (place_of(draft, name) for name in on)
    way = (place - start) * (end - start).conjugate() / (abs(end - start) or 1.0)
    return [round_number(way.real, snap), round_number(way.imag, snap)]


def foot(draft: Draft, guide: str, place: complex) -> complex:
    """Return the nearest place on a guide."""
    start, way = line_of(draft, draft.of("guides")[guide])
    return start + way * ((place - start) * way.conjugate()).real


def from_span(start: complex, end: complex, place: complex) -> complex:
    """Return the way to a place from the nearest one between two others."""
    way = end - start
    share = ((place - start) * way.conjugate()).real / (abs(way) ** 2 or 1.0)
    return place - start - way * min(max(share, 0.0), 1.0)


def crank_of(draft: Draft, joint: str) -> str | None:
    """Return the pivot of the crank that ends in a joint: a ground pin, or that of a geared crank."""
    ends = [end for _, end, _ in draft.bars_at(joint)]
    grounded = [end for end in ends if end in draft.of("pins")]
    return next(iter(grounded or (ends if joint in draft.of("gears") else [])), None)


def gear_offset(draft: Draft, joint: str, gear: Mapping[str, Any], snap: float) -> str:
    """Return the angle of a geared crank where its mate's is 0, as they are drawn."""
    arms = [(one, crank_of(draft, one)) for one in (joint, gear["with"])]
    own, mate = (place_of(draft, one) - place_of(draft, pivot or one) for one, pivot in arms)
    angle = degrees(polar(own)[1] - float(Fraction(gear["ratio"])) * polar(mate)[1]) % 360
    return f"{round_degrees(angle - 360 * (angle > 180), abs(own), snap):g} deg"


def fitted(draft: Draft) -> Draft:
    """Return the draft with its joints where their numbers put them, near where they were drawn.

    Each joint is fitted to those before it; where bars cannot meet, the first of them counts. A bar between
    two points of one body is as long as those are apart.
    """
    done = within_bodies(draft)
    for name in draft.places:
        done = done.placing(name, _fitted(done, name))
    return done


def within_bodies(draft: Draft) -> Draft:
    """Return the draft with the bars between two points of one body as long as those are apart."""
    for name, length in lengths_within(draft).items():
        key = ("bars", name, "length")
        draft = replace(with_number(draft, key, length), typed=draft.typed - {key})
    return draft


def _following(
    draft: Draft, joint: str, snap: float, phase: float | None
) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Yield the numbers that follow a joint, by their keys, with what they are where it is drawn."""
    place = place_of(draft, joint)
    pin, point = draft.of("pins").get(joint), draft.of("points").get(joint)
    if isinstance(pin, Mapping):
        yield ("pins", joint, "length"), round_length(abs(place), snap)
        yield ("pins", joint, "angle"), round_angle(place, snap)
    elif pin:
        yield from (
            (("pins", joint, n), round_number(part, snap)) for n, part in enumerate(draft.places[joint])
        )
    if point:
        at = at_on(draft, point["on"], place, snap)
        yield from ((("points", joint, "at", n), part) for n, part in enumerate(at))
    for name, end, _ in draft.bars_at(joint):
        yield ("bars", name, "length"), round_length(abs(place - place_of(draft, end)), snap)
    driven = draft.driven
    pivot = crank_of(draft, driven) if driven and not draft.drive.keys() & {"cylinder", "slider"} else None
    if driven and pivot and phase is not None and joint in (driven, pivot):
        way = (place_of(draft, driven) - place_of(draft, pivot)) * rect(1.0, -phase)
        yield (*DRIVE, "start"), round_angle(way, snap)
    for name, gear in draft.of("gears").items():
        if {joint} & {name, gear["with"], crank_of(draft, name), crank_of(draft, gear["with"])}:
            yield ("gears", name, "offset"), gear_offset(draft, name, gear, snap)


def _fitted(draft: Draft, name: str) -> complex:
    """Return where a joint is by its numbers, those before it at their places."""
    place, pin, point = place_of(draft, name), draft.of("pins").get(name), draft.of("points").get(name)
    length = partial(units.length, unit=draft.unit)
    if isinstance(pin, Mapping):
        return rect(length(pin["length"]), units.angle(pin["angle"]))
    if pin:
        return complex(*map(length, pin))
    if point:
        start, end = (place_of(draft, one) for one in point["on"])
        return start + complex(*map(length, point["at"])) * (end - start) / (abs(end - start) or 1.0)
    before = list(draft.places)[: list(draft.places).index(name)]
    bars = [(place_of(draft, end), length(bar)) for _, end, bar in draft.bars_at(name) if end in before]
    if name in draft.of("sliders"):
        guide = draft.of("sliders")[name]["guide"]
        return _on_line(draft, guide, place, bars)
    if len(bars) > 1 and (met := _meeting(place, *bars[:2])) is not None:
        return met
    for start, reach in bars[:1]:
        way = place - start
        return start + way * (reach / (abs(way) or 1.0))
    return place


def _on_line(draft: Draft, guide: str, place: complex, bars: list[tuple[complex, float]]) -> complex:
    """Return where a slider is: on its guide, as far from its bar's end as that is long, if it can be."""
    start, way = line_of(draft, draft.of("guides")[guide])
    along = ((place - start) * way.conjugate()).real
    for end, reach in bars[:1]:
        near = (end - start) * way.conjugate()
        if abs(near.imag) <= reach:
            half = sqrt(reach * reach - near.imag**2)
            along = min((near.real - half, near.real + half), key=lambda one: abs(one - along))
    return start + way * along


def _meeting(place: complex, one: tuple[complex, float], other: tuple[complex, float]) -> complex | None:
    """Return where two bars meet, of the two places the nearer one; None where they cannot."""
    (a, reach), (b, reach_b) = one, other
    way = b - a
    if not way:
        return None
    share = (abs(way) ** 2 + reach**2 - reach_b**2) / (2 * abs(way) ** 2)
    height = reach**2 / abs(way) ** 2 - share**2
    if height < 0:
        return None
    ends = (a + way * complex(share, part * sqrt(height)) for part in (1, -1))
    return min(ends, key=lambda end: abs(end - place))
