"""The shorthands [four-bar], [slider-crank] and [six-bar]: the common linkages in a few lines.

Each gives the joints that the long form would give, under fixed names: pins O2, O4, O6, joints A, B, C, D,
and the coupler points P (on the coupler) and P2 (on coupler2), traced unless [trace] says otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.mechanics.linkage.joint import Joint, Line
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.reading.check import Table
from linkanim.scenes.reading.joints import OPEN, DimensionKind, on_circle, polar_pin, side


@dataclass(frozen=True, slots=True)
class Expansion:
    """What a shorthand stands for; `drive` is the joint that is driven unless [drive] says otherwise."""

    joints: tuple[Joint, ...] = ()
    bodies: tuple[Body, ...] = ()
    drive: str | None = None
    trace: tuple[str, ...] = ()


class Shorthand(NamedTuple):
    """How a shorthand is expanded, the names of its `assembly`, and which of its numbers can be edited."""

    expand: Callable[[Table, Pin], Expansion]
    assemblies: tuple[str, str]
    numbers: Mapping[str, DimensionKind]


def expand(document: Table, origin: Pin) -> Expansion:
    """Expand the file's shorthand about the pin `origin` (O2); an empty one where it has none."""
    found = [key for key in SHORTHANDS if key in document]
    if len(found) > 1:
        raise document.wrong(f"has both [{found[0]}] and [{found[1]}]; keep one, write the other as [joints]")
    return SHORTHANDS[found[0]].expand(document.table(found[0]), origin) if found else Expansion()


def _four_bar(table: Table, o2: Pin) -> Expansion:
    table.only(
        "ground", "crank", "coupler", "rocker", "ground_angle", "coupler_point", "assembly", "driver"
    )  # fmt: skip
    o4 = polar_pin("O4", o2, table.length("ground"), table.angle("ground_angle", "0 deg"))
    crank, coupler, rocker = (table.length(key) for key in ("crank", "coupler", "rocker"))
    sign = side(table, "assembly", OPEN)
    if table.choice("driver", ("crank", "rocker")) == "crank":
        chain: tuple[Joint, ...] = (Crank("A", "O2", crank), RRR("B", ("A", "O4"), (coupler, rocker), sign))
    else:
        chain = (
            Crank("B", "O4", rocker),
            RRR("A", ("B", "O2"), (coupler, crank), sign, side_of=("B", "A", "O4")),
        )
    points = _coupler_point(table, "coupler_point", "P", ("A", "B"))
    names = tuple(point.name for point in points)
    bodies = (Body("crank", ("O2", "A")), Body("coupler", ("A", "B", *names)), Body("rocker", ("O4", "B")))
    return Expansion((o2, o4, *chain, *points), bodies, chain[0].name, names)


def _slider_crank(table: Table, o2: Pin) -> Expansion:
    table.only("crank", "rod", "offset", "line_angle", "assembly", "coupler_point")
    line = Line("O2", table.angle("line_angle", "0 deg"), table.offset("offset"))
    slider = RRP("B", "A", table.length("rod"), line, side(table, "assembly", RRP.sides))
    points = _coupler_point(table, "coupler_point", "P", ("A", "B"))
    names = tuple(point.name for point in points)
    bodies = (Body("crank", ("O2", "A")), Body("rod", ("A", "B", *names)), Body("slider", slider="B"))
    return Expansion((o2, Crank("A", "O2", table.length("crank")), slider, *points), bodies, "A", names)


def _six_bar(table: Table, o2: Pin) -> Expansion:
    table.only(
        "lengths", "ground_angle", "link_angle", "assembly", "assembly2", "coupler_point", "coupler_point2"
    )  # fmt: skip
    r1, r2, r3, r4, r5, r6, r7, r8 = table.lengths("lengths", 8)
    ground_angle = table.angle("ground_angle", "0 deg")
    o4 = polar_pin("O4", o2, r1, ground_angle)
    joints: tuple[Joint, ...] = (
        o2,
        o4,
        polar_pin("O6", o4, r5, ground_angle),
        Crank("A", "O2", r2),
        RRR("B", ("A", "O4"), (r3, r4), side(table, "assembly", OPEN)),
        Rigid("C", ("O4", "B"), on_circle(r6, table.angle("link_angle", "0 deg"))),
        RRR("D", ("C", "O6"), (r7, r8), side(table, "assembly2", OPEN)),
    )
    first = _coupler_point(table, "coupler_point", "P", ("A", "B"))
    second = _coupler_point(table, "coupler_point2", "P2", ("C", "D"))
    bodies = (
        Body("crank", ("O2", "A")),
        Body("coupler", ("A", "B", *(point.name for point in first))),
        Body("rocker", ("O4", "B", "C")),
        Body("coupler2", ("C", "D", *(point.name for point in second))),
        Body("rocker2", ("O6", "D")),
    )
    points = (*first, *second)
    return Expansion((*joints, *points), bodies, "A", tuple(point.name for point in points))


def _coupler_point(table: Table, key: str, name: str, on: tuple[str, str]) -> tuple[Rigid, ...]:
    if key not in table:
        return ()
    at = table.point(key)
    if at == (0.0, 0.0):
        raise table.error(key, f"is the joint {on[0]} itself; leave it out, or give a point such as [45, 30]")
    return (Rigid(name, on, at),)


_FOUR_BAR: Mapping[str, DimensionKind] = {
    **dict.fromkeys(("ground", "crank", "coupler", "rocker"), "length"),
    "ground_angle": "angle",
    "coupler_point": "offset",
}
_SLIDER_CRANK: Mapping[str, DimensionKind] = {
    **dict.fromkeys(("crank", "rod"), "length"),
    "offset": "offset",
    "line_angle": "angle",
    "coupler_point": "offset",
}
_SIX_BAR: Mapping[str, DimensionKind] = {
    "lengths": "length",
    **dict.fromkeys(("ground_angle", "link_angle"), "angle"),
    **dict.fromkeys(("coupler_point", "coupler_point2"), "offset"),
}

SHORTHANDS: Mapping[str, Shorthand] = {
    "four-bar": Shorthand(_four_bar, OPEN, _FOUR_BAR),
    "slider-crank": Shorthand(_slider_crank, RRP.sides, _SLIDER_CRANK),
    "six-bar": Shorthand(_six_bar, OPEN, _SIX_BAR),
}
"""The shorthands by the name of their table."""
