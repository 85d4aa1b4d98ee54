"""What is to be seen of a draft that does not move yet: shapes with their places."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.order import line_of
from linkanim.mechanics.linkage.joint import Point


class Shape(NamedTuple):
    """What is drawn of one thing: its kind says how, `places` where, in the draft's unit.

    "pins", "joints": one place; "bars": the two ends, then the points of the same body; "guides": a place on
    it, and another one 1 unit further; "springs", "dampers", "cylinder": two ends; "gears": the two pivots of
    the wheels, and where they touch; "slots", "yokes": the joint in the slot. `label` is its name.
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
        ends = (start, start + way)
        yield Shape(("guides", name), "guides", tuple((end.real, end.imag) for end in ends), name)
    for name, table in draft.of("bars").items():
        body = _body(draft, table["joints"])
        points = [end for end in draft.of("points") if draft.of("points")[end]["on"] == table["joints"]]
        places = tuple(draft.places[end] for end in (*table["joints"], *points))
        yield Shape(("bars", name), "bars", places, body or name)
    for kind in ("springs", "dampers"):
        for name, table in draft.of(kind).items():
            yield Shape((kind, name), kind, tuple(draft.places[end] for end in table["between"]), name)
    for name, place in draft.places.items():
        yield Shape((JOINT, name), "pins" if name in draft.of("pins") else JOINT, (place,), name)


def _body(draft: Draft, joints: list[str]) -> str | None:
    """Return the name of the body that two joints are on."""
    bodies = draft.of("bodies").items()
    return next((name for name, body in bodies if set(joints) <= set(body.get("joints", ()))), None)
