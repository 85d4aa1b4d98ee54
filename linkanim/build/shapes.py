"""What is to be seen of a draft that does not move yet: shapes with their places."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from linkanim.build.draft import DRIVE, JOINT, Draft, Thing
from linkanim.build.order import line_of, place_of
from linkanim.build.places import crank_of
from linkanim.mechanics.linkage.joint import Point


class Shape(NamedTuple):
    """What is drawn of one thing: its kind says how, `places` where, in the draft's unit.

    "pins", "joints": one place; "bars": the two ends, then the points of the same body; "guides": a place on
    it, another one 1 unit further, then what slides on it; "springs", "dampers", "cylinder": two ends;
    "gears": the two pivots of the wheels, and where they touch; "sliders", "slots", "yokes": what slides, and
    a place further along its guide or slot. `label` is its name.
    """

    thing: Thing
    kind: str
    places: tuple[Point, ...]
    label: str


def drawn(draft: Draft) -> tuple[Shape, ...]:
    """Return what is to be seen of a draft, from the back to the front."""
    return tuple(_shapes(draft))


def _shapes(draft: Draft) -> Iterator[Shape]:
    for name, guide in draft.of("guides").items():
        start, way = line_of(draft, guide)
        on_it = [draft.places[joint] for joint, one in draft.of("sliders").items() if one["guide"] == name]
        yield Shape(("guides", name), "guides", (as_point(start), as_point(start + way), *on_it), name)
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
    """Yield what slides along guides and in slots."""
    for joint, slider in draft.of("sliders").items():
        way = line_of(draft, draft.of("guides")[slider["guide"]])[1]
        yield Shape(
            (JOINT, joint), "sliders", (draft.places[joint], as_point(place_of(draft, joint) + way)), joint
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
