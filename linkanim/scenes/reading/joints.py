"""The long form of a scene file: fixed pins and joints, each a table of [ground] or [joints].

`READERS` is the one table of how each kind of joint is written.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple, get_args

from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.linkage.dyads import RPP, RPR, RRP, RRR
from linkanim.mechanics.linkage.joint import Joint, Line, Point
from linkanim.mechanics.linkage.linkage import Outline
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Gear, Pin, Polar
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.reading.check import Table

Key = tuple[str | int, ...]
DimensionKind = Literal[
    "length", "angle", "speed", "offset", "ratio", "stiffness", "damping", "mass", "inertia", "gravity"
]
"""What a number of a scene file measures; an "offset" is a length of either sign."""

_LEAST_SLOT = 1e-6
"""Sine of the least angle between a slot and its line of travel."""

LOOKS: tuple[Outline, ...] = get_args(Outline)
OPEN = ("open", "crossed")


class Reader(NamedTuple):
    """How a kind of joint is read from its table, and which of its numbers can be edited."""

    read: Callable[[str, Table], Joint]
    numbers: Mapping[Key, DimensionKind]


def side(table: Table, key: str, options: tuple[str, str]) -> int:
    """Return +1 for the first option (or a missing key) and -1 for the second."""
    return 1 if table.choice(key, options) == options[0] else -1


def on_circle(length: float, angle: float) -> Point:
    """Return the point at `length` and `angle` (rad) from the origin, exact at multiples of pi/2."""
    along, left = unit(angle)
    return along * length, left * length


def polar_pin(name: str, base: Pin | None, length: float, angle: float) -> Pin:
    """Return the fixed pin at `length` and `angle` (rad) from `base`, or from the origin."""
    x, y = base.position if base else (0.0, 0.0)
    dx, dy = on_circle(length, angle)
    return Pin(name, (x + dx, y + dy), Polar(length, angle, base.name if base else None))


def read_pin(name: str, ground: Table) -> Pin:
    """Read a fixed pin: [x, y], or { length, angle } from the origin."""
    if not isinstance(ground.values[name], Mapping):
        return Pin(name, ground.point(name))
    table = ground.table(name)
    table.only("length", "angle")
    return polar_pin(name, None, table.length("length"), table.angle("angle"))


def read_joint(name: str, table: Table) -> Joint:
    """Read a joint; which kind it is shows in its keys."""
    reader = reader_of(table.values)
    if reader is not None:
        return reader.read(name, table)
    table.only(*READERS, "length", "side", "gear", "at")
    raise table.wrong(f"says no way to find the joint; give it one of {', '.join(READERS)}")


def reader_of(values: Mapping[str, Any]) -> Reader | None:
    """Return how a joint's table is read, by the first key that marks a kind; None where none does."""
    return next((reader for mark, reader in READERS.items() if mark in values), None)


def _crank(name: str, table: Table) -> Crank:
    table.only("crank", "length", "gear")
    gear = _gear(table.table("gear")) if "gear" in table else None
    return Crank(name, table.text("crank"), table.length("length"), gear)


def _gear(table: Table) -> Gear:
    table.only("with", "ratio", "offset")
    return Gear(table.text("with"), table.ratio("ratio"), table.angle("offset", "0 deg"))


def _slider(name: str, table: Table) -> RRP | DrivenSlider:
    """Read a slider that a bar moves, or one that drives: declared by its line alone."""
    if "from" not in table and "length" not in table:
        return _driven_slider(name, table)
    table.only("from", "length", "line", "side")
    line = _line(table.table("line"))
    return RRP(name, table.text("from"), table.length("length"), line, side(table, "side", RRP.sides))


def _driven_slider(name: str, table: Table) -> DrivenSlider:
    table.only("line", "from", "length", "side")
    line = _line(table.table("line"))
    if line.on is not None:
        raise table.table("line").error(
            "on",
            "a slider without a bar is driven along a fixed line; leave it out, or give the slider its bar",
        )
    if "side" in table:
        raise table.error("side", "a slider without a bar has no second closure; leave it out")
    return DrivenSlider(name, line)


def _line(line: Table) -> Line:
    line.only("through", "angle", "offset", "on")
    on = line.names("on", 2) if "on" in line else None
    through = line.text("through", on[0] if on else None)
    carried = (on[0], on[1]) if on else None
    return Line(through, line.angle("angle", "0 deg"), line.offset("offset"), carried)


def _yoke(name: str, table: Table) -> RPP:
    table.only("slide")
    slide = table.table("slide")
    slide.only("pin", "line", "slot")
    slot = slide.angle("slot", "90 deg")
    if abs(math.sin(slot)) < _LEAST_SLOT:
        raise slide.error("slot", 'lies along the line of travel, so it never crosses it; write "90 deg"')
    return RPP(name, slide.text("pin"), _line(slide.table("line")), slot)


def _dyad(name: str, table: Table) -> RRR:
    table.only("from", "length", "side")
    start, end = table.names("from", 2)
    first, second = table.lengths("length", 2)
    return RRR(name, (start, end), (first, second), side(table, "side", RRR.sides))


def _slot(name: str, table: Table) -> RPR:
    table.only("slot", "length")
    slot = table.table("slot")
    slot.only("pivot", "through", "offset")
    return RPR(name, slot.text("pivot"), slot.text("through"), table.length("length"), slot.offset("offset"))


def _point(name: str, table: Table) -> Rigid:
    table.only("on", "at")
    first, second = table.names("on", 2)
    at = table.point("at")
    if at == (0.0, 0.0):
        raise table.error("at", f"is the joint {first} itself; give a point beside it, such as [10, 5]")
    return Rigid(name, (first, second), at)


_LINE_OF_SLIDE: Mapping[Key, DimensionKind] = {
    ("slide", "line", "angle"): "angle",
    ("slide", "line", "offset"): "offset",
}
_BAR: Mapping[Key, DimensionKind] = {("length",): "length"}

READERS: Mapping[str, Reader] = {
    "crank": Reader(_crank, {**_BAR, ("gear", "ratio"): "ratio", ("gear", "offset"): "angle"}),
    "line": Reader(_slider, {**_BAR, ("line", "angle"): "angle", ("line", "offset"): "offset"}),
    "from": Reader(_dyad, _BAR),
    "slot": Reader(_slot, {**_BAR, ("slot", "offset"): "offset"}),
    "slide": Reader(_yoke, {("slide", "slot"): "angle", **_LINE_OF_SLIDE}),
    "on": Reader(_point, {("at",): "offset"}),
}
"""How each kind of joint is written, by the key that marks it."""
