"""The shorthands [four-bar], [slider-crank] and [six-bar]: the common linkages in a few lines.

Each gives the joints that the long form would give, under fixed names: pins O2, O4, O6, joints A, B, C, D,
and the coupler points P (on the coupler) and P2 (on coupler2), traced unless [trace] says otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.mechanics.linkage.joint import Joint, Line, Point
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.fields.form import NEEDED, Field, Form
from linkanim.scenes.fields.joints import aside, on_circle, polar_pin
from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import ANGLE, LENGTH, OFFSET, POINT, choice, listed, side

_OPEN = side("open", "crossed")


@dataclass(frozen=True, slots=True)
class Expansion:
    """What a shorthand stands for; `drive` is the joint that is driven unless [drive] says otherwise."""

    joints: tuple[Joint, ...] = ()
    bodies: tuple[Body, ...] = ()
    drive: str | None = None
    trace: tuple[str, ...] = ()


def _four_bar(
    o2: Pin,
    *,
    ground: float,
    crank: float,
    coupler: float,
    rocker: float,
    ground_angle: float,
    assembly: int,
    driver: str,
    coupler_point: Point | None = None,
) -> Expansion:
    o4 = polar_pin("O4", ground, ground_angle, o2)
    if driver == "crank":
        chain: tuple[Joint, ...] = (
            Crank("A", "O2", crank),
            RRR("B", ("A", "O4"), (coupler, rocker), assembly),
        )
    else:
        chain = (
            Crank("B", "O4", rocker),
            RRR("A", ("B", "O2"), (coupler, crank), assembly, side_of=("B", "A", "O4")),
        )
    points = _points(coupler_point)
    names = tuple(point.name for point in points)
    bodies = (Body("crank", ("O2", "A")), Body("coupler", ("A", "B", *names)), Body("rocker", ("O4", "B")))
    return Expansion((o2, o4, *chain, *points), bodies, chain[0].name, names)


def _slider_crank(
    o2: Pin,
    *,
    crank: float,
    rod: float,
    offset: float,
    line_angle: float,
    assembly: int,
    coupler_point: Point | None = None,
) -> Expansion:
    slider = RRP("B", "A", rod, Line("O2", line_angle, offset), assembly)
    points = _points(coupler_point)
    names = tuple(point.name for point in points)
    bodies = (Body("crank", ("O2", "A")), Body("rod", ("A", "B", *names)), Body("slider", slider="B"))
    return Expansion((o2, Crank("A", "O2", crank), slider, *points), bodies, "A", names)


def _six_bar(
    o2: Pin,
    *,
    lengths: tuple[float, ...],
    ground_angle: float,
    link_angle: float,
    assembly: int,
    assembly2: int,
    coupler_point: Point | None = None,
    coupler_point2: Point | None = None,
) -> Expansion:
    r1, r2, r3, r4, r5, r6, r7, r8 = lengths
    o4 = polar_pin("O4", r1, ground_angle, o2)
    joints: tuple[Joint, ...] = (
        o2,
        o4,
        polar_pin("O6", r5, ground_angle, o4),
        Crank("A", "O2", r2),
        RRR("B", ("A", "O4"), (r3, r4), assembly),
        Rigid("C", ("O4", "B"), on_circle(r6, link_angle)),
        RRR("D", ("C", "O6"), (r7, r8), assembly2),
    )
    first, second = _points(coupler_point), _points(coupler_point2, "P2", ("C", "D"))
    bodies = (
        Body("crank", ("O2", "A")),
        Body("coupler", ("A", "B", *(point.name for point in first))),
        Body("rocker", ("O4", "B", "C")),
        Body("coupler2", ("C", "D", *(point.name for point in second))),
        Body("rocker2", ("O6", "D")),
    )
    points = (*first, *second)
    return Expansion((*joints, *points), bodies, "A", tuple(point.name for point in points))


def _points(at: Point | None, name: str = "P", on: tuple[str, str] = ("A", "B")) -> tuple[Rigid, ...]:
    return () if at is None else (Rigid(name, on, at),)


def _refuse_own(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse a coupler point that is a joint of its coupler."""
    for key, first in (("coupler_point", "A"), ("coupler_point2", "C")):
        if values.get(key) == (0.0, 0.0):
            raise table.error(
                key, f"is the joint {first} itself; leave it out, or give a point such as [45, 30]"
            )


def _shorthand(make: Callable[..., Expansion], words: str, *fields: Field) -> Form:
    return Form(fields, make, words, refuse=_refuse_own)


def _bar(key: str, label: str, *spans: tuple[str, str]) -> Field:
    return Field(key, LENGTH, f"the length {'–'.join(spans[0])}", label=label, drag="distance", spans=spans)


_GROUND_ANGLE = Field(
    "ground_angle",
    ANGLE,
    "the direction O2–O4",
    "0 deg",
    label="Ground angle",
    drag="direction",
    spans=(("O2", "O4"),),
)


def _coupler_point(key: str, label: str, ends: str, point: str) -> Field:
    words = f"the point {point} along {'–'.join(ends)}, and to its left"
    return Field(key, POINT, words, None, label=aside(label), drag="place", spans=((ends[0], point),))


_COUPLER_POINT = _coupler_point("coupler_point", "Coupler point", "AB", "P")

SHORTHANDS: Mapping[str, Form] = {
    "four-bar": _shorthand(
        _four_bar,
        "pins O2, A, B, O4; bodies crank, coupler, rocker",
        _bar("ground", "Ground 1", ("O2", "O4")),
        _bar("crank", "{Crank} 2", ("O2", "A")),
        _bar("coupler", "{Coupler} 3", ("A", "B")),
        _bar("rocker", "{Rocker} 4", ("O4", "B")),
        _GROUND_ANGLE,
        _COUPLER_POINT,
        Field("assembly", _OPEN, "which of the two closures: open is B to the left of A–O4", "open"),
        Field("driver", choice("crank", "rocker"), "the link that is driven", "crank"),
    ),
    "slider-crank": _shorthand(
        _slider_crank,
        "pins O2, A, slider B; bodies crank, rod, slider",
        _bar("crank", "{Crank} 2", ("O2", "A")),
        _bar("rod", "{Rod} 3", ("A", "B")),
        Field("offset", OFFSET, "how far to the left of O2 the line runs", 0, label="Offset of the line"),
        Field("line_angle", ANGLE, "the direction of the line", "0 deg", label="Direction of the line"),
        Field("assembly", side(*RRP.sides), "which of the two closures, along the line", RRP.sides[0]),
        _COUPLER_POINT,
    ),
    "six-bar": _shorthand(
        _six_bar,
        "two four-bars in a row, O2 A B O4 and O4 C D O6; bodies crank, coupler, rocker, coupler2, rocker2",
        Field(
            "lengths",
            listed(LENGTH, 8),
            "r1 to r8: O2–O4, O2–A, A–B, O4–B, O4–O6, O4–C, C–D, O6–D",
            label=(
                "Ground 1",
                "{Crank} 2",
                "{Coupler} 3",
                "{Rocker} 4",
                "Ground 5",
                "Arm 6",
                "{Coupler2} 7",
                "{Rocker2} 8",
            ),
            drag="distance",
            spans=(
                ("O2", "O4"),
                ("O2", "A"),
                ("A", "B"),
                ("O4", "B"),
                ("O4", "O6"),
                ("O4", "C"),
                ("C", "D"),
                ("O6", "D"),
            ),
        ),
        _GROUND_ANGLE,
        Field("link_angle", ANGLE, "of O4–C on O4–B", "0 deg", label="Angle of arm 6 on {rocker} 4"),
        Field("assembly", _OPEN, "which closure of the first loop", "open"),
        Field("assembly2", _OPEN, "which closure of the second loop", "open"),
        _COUPLER_POINT,
        _coupler_point("coupler_point2", "Second coupler point", "CD", "P2"),
    ),
}
"""The shorthands by the name of their table."""


def names_of(key: str, table: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the names of all joints that a shorthand's table states."""
    stated = [one for one in SHORTHANDS[key].fields if one.usual is NEEDED or one.key in table]
    ends = (name for one in stated if one.drag != "direction" for span in one.spans for name in span)
    return tuple(dict.fromkeys(ends))
