"""Places and numbers: which dyad each joint is, its numbers from its place, and its place from its numbers.

`solvable_joints` puts joints in order, each in the terms of a scene file: how it is found from those before.
From there numbers follow from places, rounded as a person would write them, and places from numbers. `drawn`
returns the shapes of a draft that does not move yet.
"""

from __future__ import annotations

from cmath import polar, rect
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial, reduce
from itertools import combinations
from math import atan2, cos, degrees, radians, sin, sqrt
from typing import Any, NamedTuple

from linkanim import units
from linkanim.build.draft import DRIVE, JOINT, Draft, Thing, named_in
from linkanim.mechanics.linkage import RRP, RRR, Point, Rigid, RigidBody
from linkanim.scenes.editing import replaced

# Round numbers: places on a grid, lengths and angles as a person would write them.

FREE = 1e-3
"""The step of drawings without snapping, in the draft's unit."""
_ANGLES = (1.0, 0.1, 0.01, 0.001)


def snapped(place: complex, step: float) -> complex:
    """Return the nearest place, x + yi, whose coordinates are multiples of a step; 0 is the finest."""
    return complex(_multiple(place.real, step or FREE), _multiple(place.imag, step or FREE))


def round_number(value: float, step: float) -> int | float:
    """Return the nearest multiple of a step, whole numbers as such; 0 is the finest."""
    number = _multiple(value, step or FREE)
    return int(number) if number.is_integer() else number


def round_length(value: float, step: float) -> int | float:
    """Return the nearest positive multiple of a step; of a finer step where it would be zero."""
    step = step or FREE
    while not (number := round_number(abs(value), step)) and step > 1e-9:
        step /= 10
    return number or step


def round_angle(vector: complex, step: float) -> str:
    """Return a vector's direction in the roundest degrees that keep its end within half a step."""
    angle = degrees(atan2(vector.imag, vector.real))
    return f"{round_degrees(angle, abs(vector), step):g} deg"


def round_degrees(angle: float, reach: float, step: float) -> int | float:
    """Return the roundest degrees that move a point at the distance `reach` by at most half a step."""
    off = (step or FREE) / 2
    fine = next(
        (fine for fine in _ANGLES if reach * radians(abs(angle - round_number(angle, fine))) <= off), FREE
    )
    return round_number(angle, fine)


def _multiple(value: float, step: float) -> float:
    """Return the nearest multiple of a step as a decimal, never -0."""
    return float(f"{round(value / step) * step:.9f}") + 0.0


# The dyads of a drawing: each joint as a scene file says how it is found from joints before it.

JointTables = Mapping[str, Mapping[str, Any]]
"""Tables of joints by their names, in solvable order."""


def solvable_joints(draft: Draft) -> dict[str, dict[str, Any]]:
    """Return how each joint is found, as [joints] of a scene file; joints that cannot be found are left out.

    A joint is found by the first possible one of: the drive or a gear, its body, a slot, a guide, two bars.
    Of its two closures it has the one on which it was drawn.
    """
    tables: dict[str, dict[str, Any]] = {}
    known, plates = set(draft.of("pins")), plates_of(draft)
    waiting = [name for name in draft.places if name not in known]
    while table := next(((name, way) for name in waiting for way in _ways(draft, name, known, plates)), None):
        name, tables[table[0]] = table[0], table[1]
        known.add(name)
        waiting.remove(name)
    return tables


def sides(draft: Draft) -> dict[str, dict[str, Any]]:
    """Return the closures of a draft's dyads: the joints of each dyad, and the closure's name."""
    tables = ((name, table) for name, table in solvable_joints(draft).items() if "side" in table)
    return {name: {"joints": ends_of(table), "side": table["side"]} for name, table in tables}


def plates_of(draft: Draft) -> list[RigidBody]:
    """Return the bodies of three joints or more, each in its own frame, along its first bar."""
    bars = (
        {first: 0j, second: complex(units.length(table["length"], unit=draft.unit))}
        for table in draft.of("bars").values()
        for first, second in [table["joints"]]
    )
    points = []
    for name, table in draft.of("points").items():
        along, left = (units.length(part, unit=draft.unit) for part in table["at"])
        points.append(Rigid(name, tuple(table["on"]), (along, left)))
    bodies = reduce(lambda bodies, point: point.placed(bodies), points, tuple(bars))
    return [body for body in bodies if len(body) > 2]


def lengths_within(draft: Draft) -> dict[str, float]:
    """Return the lengths of redundant bars: those between two points of one body.

    A bar that defines a body is not redundant. The body sets the lengths of the others, whatever is stated.
    """
    return {
        name: _round(abs(body[one] - body[other]))
        for name, (one, other) in ((name, table["joints"]) for name, table in draft.of("bars").items())
        for body in plates_of(draft)
        if one in body and other in body and {one, other} != {*list(body)[:2]}
    }


def line_of(draft: Draft, guide: Mapping[str, Any]) -> tuple[complex, complex]:
    """Return a point of a guide and its direction, of length 1, where the joints were drawn."""
    start, direction = place_of(draft, guide.get("through") or guide["on"][0]), 1 + 0j
    if "on" in guide:
        first, second = (place_of(draft, name) for name in guide["on"])
        direction = (second - first) / (abs(second - first) or 1.0)
    angle = units.angle(guide.get("angle", "0 deg"))
    direction *= complex(cos(angle), sin(angle))
    return start + 1j * direction * units.length(guide.get("offset", 0), unit=draft.unit), direction


def place_of(draft: Draft, joint: str) -> complex:
    """Return where a joint was drawn, as x + yi."""
    return complex(*draft.places[joint])


def _ways(draft: Draft, name: str, known: set[str], plates: list[RigidBody]) -> Iterator[dict[str, Any]]:
    """Yield the ways in which a joint can be found from those that are known."""
    bars = [(end, length) for _, end, length in draft.bars_at(name) if end in known]
    guide = draft.of("guides").get(draft.of("sliders").get(name, {}).get("guide"))
    line = guide if guide and known.issuperset(joint for _, joint in named_in(guide)) else None
    gear, point, yoke = (draft.of(kind).get(name) for kind in ("gears", "points", "yokes"))
    if name == draft.driven:
        yield from _driven(draft, bars, line)
    elif name in draft.of("drives"):
        yield from ({"crank": end, "length": length} for end, length in bars if end in draft.of("pins"))
    elif gear and gear["with"] in known:
        yield from ({"crank": end, "length": length, "gear": gear} for end, length in bars)
    if point and known.issuperset(point["on"]):
        yield dict(point)
    held = [(body, [end for end in body if end in known]) for body in plates if name in body]
    for body, ends in held:
        bars += [(end, _round(abs(body[end] - body[name]))) for end in ends[:1] if end not in dict(bars)]
        if ends[1:]:
            place = (body[name] - body[ends[0]]) * (body[ends[1]] - body[ends[0]]).conjugate()
            place /= abs(body[ends[1]] - body[ends[0]])
            yield {"on": ends[:2], "at": [_round(place.real), _round(place.imag)]}
    yield from _slotted(draft, name, known, bars)
    if yoke and line and yoke["pin"] in known:
        yield {"slide": {"pin": yoke["pin"], "line": line, "slot": yoke["slot"]}}
    for each in [line] if line else _carried(draft, name, known):
        for end, length in bars:
            if end not in each.get("on", ()):
                yield _with_side(draft, name, {"from": end, "length": length, "line": each})
    for (one, a), (other, b) in combinations(bars, 2):
        yield _with_side(draft, name, {"from": [one, other], "length": [a, b]})


def _driven(draft: Draft, bars: list[tuple[str, Any]], line: Any) -> Iterator[dict[str, Any]]:
    if "slider" in draft.drive:
        yield from [{"line": line}] if line and "on" not in line else []
    else:
        yield from ({"crank": end, "length": length} for end, length in bars if end in draft.of("pins"))


def _slotted(
    draft: Draft, name: str, known: set[str], bars: list[tuple[str, Any]]
) -> Iterator[dict[str, Any]]:
    """Yield the joint as the end of a bar that slides through a joint."""
    for slot in draft.of("slots").values():
        (one, other), through = draft.ends(slot["bar"]), slot["through"]
        pivot = other if name == one else one
        if name in (one, other) and {pivot, through} <= known:
            length = dict(bars)[pivot]
            aside = {"offset": slot["offset"]} if slot.get("offset") else {}
            yield {"slot": {"pivot": pivot, "through": through, **aside}, "length": length}


def _carried(draft: Draft, name: str, known: set[str]) -> Iterator[dict[str, Any]]:
    """Yield the lines of the slots in known bars that a joint runs in."""
    for slot in draft.of("slots").values():
        ends = draft.ends(slot["bar"])
        if slot["through"] == name and known.issuperset(ends):
            yield {"on": ends, "through": ends[0], "offset": slot.get("offset", 0)}


def _round(length: float) -> float:
    """Return a length that follows from others, freed of rounding errors in its last digits."""
    return round(length, 9)


def _with_side(draft: Draft, name: str, table: dict[str, Any]) -> dict[str, Any]:
    """Return a dyad with its closure: the known one of the same dyad, else that where the joint was drawn."""
    known = draft.of("sides").get(name)
    if known and known["joints"] == ends_of(table):
        return {**table, "side": known["side"]}
    place, names = place_of(draft, name), ends_of(table)
    if "line" in table:
        start, direction = place_of(draft, names[0]), line_of(draft, table["line"])[1]
        return {**table, "side": RRP.sides[((place - start) * direction.conjugate()).real < 0]}
    start, end = (place_of(draft, each) for each in names)
    return {**table, "side": RRR.sides[((place - start) * (end - start).conjugate()).imag < 0]}


def ends_of(table: Mapping[str, Any]) -> list[str]:
    """Return the other ends of the bars by which a joint's table finds it."""
    ends = table.get("from", table.get("crank", table.get("slot", {}).get("pivot", [])))
    return [ends] if isinstance(ends, str) else list(ends)


# Places and numbers: the numbers of a joint from its place, and its place from its numbers.


def moved(draft: Draft, joint: str, place: complex, snap: float, phase: float | None = 0.0) -> Draft:
    """Return the draft with a joint at a place, and with the numbers that follow it, except typed ones.

    `phase` is how far the crank has turned from the drive's start, which follows it; None for an input that
    does not turn fully.
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
    share = (place - start) * (end - start).conjugate() / (abs(end - start) or 1.0)
    return [round_number(share.real, snap), round_number(share.imag, snap)]


def foot(draft: Draft, guide: str, place: complex) -> complex:
    """Return the nearest place on a guide."""
    start, direction = line_of(draft, draft.of("guides")[guide])
    return start + direction * ((place - start) * direction.conjugate()).real


def from_span(start: complex, end: complex, place: complex) -> complex:
    """Return the vector to a place from the nearest point between two others."""
    vector = end - start
    share = ((place - start) * vector.conjugate()).real / (abs(vector) ** 2 or 1.0)
    return place - start - vector * min(max(share, 0.0), 1.0)


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

    Each joint is fitted to those before it; where bars cannot meet, the first bar counts. A bar between two
    points of one body gets their distance as its length.
    """
    done = within_bodies(draft)
    for name in draft.places:
        done = done.placing(name, _fitted(done, name))
    return done


def within_bodies(draft: Draft) -> Draft:
    """Return the draft in which bars between two points of one body have these points' distance as length."""
    for name, length in lengths_within(draft).items():
        key = ("bars", name, "length")
        draft = replace(with_number(draft, key, length), typed=draft.typed - {key})
    return draft


def _following(
    draft: Draft, joint: str, snap: float, phase: float | None
) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Yield the keys of the numbers that follow a joint, with their values where it is drawn."""
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
        arm = (place_of(draft, driven) - place_of(draft, pivot)) * rect(1.0, -phase)
        yield (*DRIVE, "start"), round_angle(arm, snap)
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
        vector = place - start
        return start + vector * (reach / (abs(vector) or 1.0))
    return place


def _on_line(draft: Draft, guide: str, place: complex, bars: list[tuple[complex, float]]) -> complex:
    """Return where a slider is: on its guide, as far from its bar's end as that is long, if it can be."""
    start, direction = line_of(draft, draft.of("guides")[guide])
    along = ((place - start) * direction.conjugate()).real
    for end, reach in bars[:1]:
        near = (end - start) * direction.conjugate()
        if abs(near.imag) <= reach:
            half = sqrt(reach * reach - near.imag**2)
            along = min((near.real - half, near.real + half), key=lambda one: abs(one - along))
    return start + direction * along


def _meeting(place: complex, one: tuple[complex, float], other: tuple[complex, float]) -> complex | None:
    """Return where two bars meet, of the two places the nearer one; None where they cannot."""
    (a, reach), (b, reach_b) = one, other
    vector = b - a
    if not vector:
        return None
    share = (abs(vector) ** 2 + reach**2 - reach_b**2) / (2 * abs(vector) ** 2)
    height = reach**2 / abs(vector) ** 2 - share**2
    if height < 0:
        return None
    ends = (a + vector * complex(share, part * sqrt(height)) for part in (1, -1))
    return min(ends, key=lambda end: abs(end - place))


# The shapes of a draft that does not move yet, with their places.


class Shape(NamedTuple):
    """The drawing of one thing: its kind says how, `places` where, in the draft's unit.

    "pins", "joints": one place; "bars": the two ends, then the points of the same body; "guides": a place on
    it, another one 1 unit further, then the sliders on it; "springs", "dampers", "cylinder": two ends;
    "gears": the two pivots of the wheels, and where they touch; "sliders", "slots", "yokes": the sliding
    joint, and a place further along its guide or slot. `label` is its name.
    """

    thing: Thing
    kind: str
    places: tuple[Point, ...]
    label: str


def drawn(draft: Draft) -> tuple[Shape, ...]:
    """Return the shapes of a draft, from the back to the front."""
    return tuple(_shapes(draft))


def _shapes(draft: Draft) -> Iterator[Shape]:
    for name, guide in draft.of("guides").items():
        start, direction = line_of(draft, guide)
        on_it = [draft.places[joint] for joint, one in draft.of("sliders").items() if one["guide"] == name]
        yield Shape(("guides", name), "guides", (as_point(start), as_point(start + direction), *on_it), name)
    for name, gear in draft.of("gears").items():
        yield from _wheels(draft, name, gear["with"], float(Fraction(gear["ratio"])))
    for name, table in draft.of("bars").items():
        points = [end for end in draft.of("points") if draft.of("points")[end]["on"] == table["joints"]]
        places = tuple(draft.places[end] for end in (*table["joints"], *points))
        yield Shape(("bars", name), "bars", places, draft.body_of(table["joints"]) or name)
    for kind in ("springs", "dampers"):
        for name, table in draft.of(kind).items():
            yield Shape((kind, name), kind, tuple(draft.places[end] for end in table["between"]), name)
    if between := draft.drive.get("cylinder", {}).get("between"):
        yield Shape(DRIVE, "cylinder", tuple(draft.places[end] for end in between), "cylinder")
    yield from _blocks(draft)
    for name, place in draft.places.items():
        yield Shape((JOINT, name), "pins" if name in draft.of("pins") else JOINT, (place,), name)


def _wheels(draft: Draft, joint: str, mate: str, ratio: float) -> Iterator[Shape]:
    """Yield the wheels of a gear pair, which roll on each other where their pivots are apart."""
    pivots = [crank_of(draft, one) for one in (joint, mate)]
    if None in pivots or pivots[0] == pivots[1]:
        return
    own, other = (place_of(draft, str(pivot)) for pivot in pivots)
    touching = own + (other - own) / (1 + abs(ratio))
    yield Shape(("gears", joint), "gears", (as_point(own), as_point(other), as_point(touching)), joint)


def _blocks(draft: Draft) -> Iterator[Shape]:
    """Yield the blocks that slide along guides and in slots."""
    for joint, slider in draft.of("sliders").items():
        direction = line_of(draft, draft.of("guides")[slider["guide"]])[1]
        yield Shape(
            (JOINT, joint),
            "sliders",
            (draft.places[joint], as_point(place_of(draft, joint) + direction)),
            joint,
        )
    for name, slot in draft.of("slots").items():
        first, second = (place_of(draft, end) for end in draft.ends(slot["bar"]))
        at = place_of(draft, slot["through"])
        yield Shape(("slots", name), "slots", (as_point(at), as_point(at + second - first)), name)
    for joint, yoke in draft.of("yokes").items():
        pin, own = place_of(draft, yoke["pin"]), place_of(draft, joint)
        further = pin + (pin - own if pin != own else 1)
        yield Shape(("yokes", joint), "yokes", (as_point(pin), as_point(further)), joint)


def as_point(place: complex) -> Point:
    """Return a place, x + yi, by its coordinates."""
    return place.real, place.imag
