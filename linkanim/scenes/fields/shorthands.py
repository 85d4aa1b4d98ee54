"""The shorthands [four-bar], [slider-crank] and [six-bar]: the common linkages in a few lines.

Each gives the joints that the long form would give, under fixed names: pins O2, O4, O6, joints A, B, C, D,
and the coupler points P (on the coupler) and P2 (on coupler2), traced unless [trace] says otherwise.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from typing import Any

from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.mechanics.linkage.joint import Joint, Line, Point
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.fields.form import NEEDED, Field, Form, form
from linkanim.scenes.fields.joints import aside, on_circle, polar_pin
from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import ANGLE, LENGTH, OFFSET, POINT, choice, listed, side


@dataclass(frozen=True, slots=True)
class Expansion:
    """What a shorthand stands for; `drive` is the joint that is driven unless [drive] says otherwise."""

    joints: tuple[Joint, ...] = ()
    bodies: tuple[Body, ...] = ()
    drive: str | None = None
    trace: tuple[str, ...] = ()


def _four_bar(o2: Pin, **its: Any) -> Expansion:
    o4 = polar_pin("O4", its["ground"], its["ground_angle"], o2)
    crank, coupler, rocker = its["crank"], its["coupler"], its["rocker"]
    chain: tuple[Joint, ...] = (
        Crank("A", "O2", crank),
        RRR("B", ("A", "O4"), (coupler, rocker), its["assembly"]),
    )
    if its["driver"] == "rocker":
        named = ("B", "A", "O4")
        dyad = RRR("A", ("B", "O2"), (coupler, crank), its["assembly"], side_of=named)
        chain = (Crank("B", "O4", rocker), dyad)
    points = _points(its.get("coupler_point"))
    names = tuple(point.name for point in points)
    bodies = (Body("crank", ("O2", "A")), Body("coupler", ("A", "B", *names)), Body("rocker", ("O4", "B")))
    return Expansion((o2, o4, *chain, *points), bodies, chain[0].name, names)


def _slider_crank(o2: Pin, **its: Any) -> Expansion:
    line = Line("O2", its["line_angle"], its["offset"])
    chain = (Crank("A", "O2", its["crank"]), RRP("B", "A", its["rod"], line, its["assembly"]))
    points = _points(its.get("coupler_point"))
    names = tuple(point.name for point in points)
    bodies = (Body("crank", ("O2", "A")), Body("rod", ("A", "B", *names)), Body("slider", slider="B"))
    return Expansion((o2, *chain, *points), bodies, "A", names)


def _six_bar(o2: Pin, **its: Any) -> Expansion:
    r1, r2, r3, r4, r5, r6, r7, r8 = its["lengths"]
    o4 = polar_pin("O4", r1, its["ground_angle"], o2)
    o6 = polar_pin("O6", r5, its["ground_angle"], o4)
    chain = (
        Crank("A", "O2", r2),
        RRR("B", ("A", "O4"), (r3, r4), its["assembly"]),
        Rigid("C", ("O4", "B"), on_circle(r6, its["link_angle"])),
        RRR("D", ("C", "O6"), (r7, r8), its["assembly2"]),
    )
    first, second = _points(its.get("coupler_point")), _points(its.get("coupler_point2"), "P2", ("C", "D"))
    bodies = (
        Body("crank", ("O2", "A")),
        Body("coupler", ("A", "B", *(point.name for point in first))),
        Body("rocker", ("O4", "B", "C")),
        Body("coupler2", ("C", "D", *(point.name for point in second))),
        Body("rocker2", ("O6", "D")),
    )
    points = (*first, *second)
    return Expansion((o2, o4, o6, *chain, *points), bodies, "A", tuple(point.name for point in points))


def _points(at: Point | None, name: str = "P", on: tuple[str, str] = ("A", "B")) -> tuple[Rigid, ...]:
    return () if at is None else (Rigid(name, on, at),)


def _refuse_own(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse a coupler point that is a joint of its coupler."""
    for key, first in (("coupler_point", "A"), ("coupler_point2", "C")):
        if values.get(key) == (0.0, 0.0):
            reason = f"is the joint {first} itself; leave it out, or give a point such as [45, 30]"
            raise table.error(key, reason)


def _bars(key: str, *bars: tuple[str, str, str]) -> Field:
    """Return the field of a bar's length, or of those of several: what each is called, and its two joints."""
    spans = tuple((start, end) for _, start, end in bars)
    words = ", ".join(f"{start}–{end}" for start, end in spans)
    many = listed(LENGTH, len(bars)) if bars[1:] else LENGTH
    return Field(key, many, words, label=tuple(bar[0] for bar in bars), drag="distance", spans=spans)


def _coupler_point(key: str, label: str, ends: str, point: str) -> Field:
    words = f"the point {point} along {'–'.join(ends)}, and to its left"
    return Field(key, POINT, words, None, label=aside(label), drag="place", spans=((ends[0], point),))


_GROUND_LINE = (("O2", "O4"),)
_GROUND_ANGLE = Field(
    "ground_angle", ANGLE, "of O2–O4", "0 deg", label="Ground angle", drag="direction", spans=_GROUND_LINE
)
_COUPLER_POINT = _coupler_point("coupler_point", "Coupler point", "AB", "P")
_OPEN = side("open", "crossed")

SHORTHANDS: Mapping[str, Form] = {
    "four-bar": form(
        "pins O2, A, B, O4; bodies crank, coupler, rocker",
        _bars("ground", ("Ground 1", "O2", "O4")),
        _bars("crank", ("{Crank} 2", "O2", "A")),
        _bars("coupler", ("{Coupler} 3", "A", "B")),
        _bars("rocker", ("{Rocker} 4", "O4", "B")),
        _GROUND_ANGLE,
        _COUPLER_POINT,
        Field("assembly", _OPEN, "of the two closures; open is B to the left of A–O4", "open"),
        Field("driver", choice("crank", "rocker"), "the link that is driven", "crank"),
        refuse=_refuse_own,
        make=_four_bar,
    ),
    "slider-crank": form(
        "pins O2, A, slider B; bodies crank, rod, slider",
        _bars("crank", ("{Crank} 2", "O2", "A")),
        _bars("rod", ("{Rod} 3", "A", "B")),
        Field("offset", OFFSET, "how far to the left of O2 the line runs", 0, label="Offset"),
        Field("line_angle", ANGLE, "the direction of the line", "0 deg", label="Direction of the guide"),
        Field("assembly", side(*RRP.sides), "of the two closures, along the line", RRP.sides[0]),
        _COUPLER_POINT,
        refuse=_refuse_own,
        make=_slider_crank,
    ),
    "six-bar": form(
        "two four-bars in a row, O2 A B O4 and O4 C D O6; bodies crank, coupler, rocker, coupler2, rocker2",
        _bars(
            "lengths",
            ("Ground 1", "O2", "O4"),
            ("{Crank} 2", "O2", "A"),
            ("{Coupler} 3", "A", "B"),
            ("{Rocker} 4", "O4", "B"),
            ("Ground 5", "O4", "O6"),
            ("Arm 6", "O4", "C"),
            ("{Coupler2} 7", "C", "D"),
            ("{Rocker2} 8", "O6", "D"),
        ),
        _GROUND_ANGLE,
        Field("link_angle", ANGLE, "of O4–C on O4–B", "0 deg", label="Angle of arm 6 on {rocker} 4"),
        Field("assembly", _OPEN, "of the first loop", "open"),
        Field("assembly2", _OPEN, "of the second loop", "open"),
        _COUPLER_POINT,
        _coupler_point("coupler_point2", "Second coupler point", "CD", "P2"),
        refuse=_refuse_own,
        make=_six_bar,
    ),
}
"""The shorthands by the name of their table."""


def names_of(key: str, keys: Container[str]) -> tuple[str, ...]:
    """Return the names of all joints that a shorthand's table with these keys states."""
    stated = [one for one in SHORTHANDS[key].fields if one.usual is NEEDED or one.key in keys]
    ends = (name for one in stated if one.drag != "direction" for span in one.spans for name in span)
    return tuple(dict.fromkeys(ends))
