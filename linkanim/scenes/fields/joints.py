"""How joints are written: the fields of each kind, and of fixed pins. A kind of joint is one entry here."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.linkage.dyads import RPP, RPR, RRP, RRR
from linkanim.mechanics.linkage.joint import Line, Point
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Gear, Pin, Polar
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.fields.form import SPREAD, Field, Named, form
from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import ANGLE, JOINT, LENGTH, OFFSET, PAIR, POINT, RATIO, listed, never, side

_LEAST_SLOT = 1e-6
"""Sine of the least angle between a slot and its line of travel."""


def aside(words: str) -> tuple[str, str]:
    """Return the labels of a place on a body: along its axis, and to the left of it."""
    return f"{words}, along", f"{words}, to the left"


def on_circle(length: float, angle: float) -> Point:
    """Return the point at `length` and `angle` (rad) from the origin, exact at multiples of pi/2."""
    along, left = unit(angle)
    return along * length, left * length


def polar_pin(name: str, length: float, angle: float, base: Pin | None = None) -> Pin:
    """Return the fixed pin at `length` and `angle` (rad) from `base`, or from the origin."""
    x, y = base.position if base else (0.0, 0.0)
    dx, dy = on_circle(length, angle)
    return Pin(name, (x + dx, y + dy), Polar(length, angle, base.name if base else None))


def _line(through: str | None = None, on: tuple[str, str] | None = None, **rest: float) -> Line:
    """Return a line of travel, through the first joint of its axis unless stated."""
    return Line(through or (on[0] if on else ""), on=on, **rest)


def _refuse_parallel(slide: Table, values: Mapping[str, Any]) -> None:
    if abs(math.sin(values["slot"])) < _LEAST_SLOT:
        raise slide.error("slot", 'lies along the line of travel, so it never crosses it; write "90 deg"')


def _refuse_own(table: Table, values: Mapping[str, Any]) -> None:
    if values["at"] == (0.0, 0.0):
        first = values["on"][0]
        raise table.error("at", f"is the joint {first} itself; give a point beside it, such as [10, 5]")


_PIN_ON_LINE = Field(
    "through", JOINT, "a fixed pin on the line, or a joint of the axis' body", must="fixed", unless="on"
)
_LINE_FIELDS = (
    _PIN_ON_LINE,
    Field("angle", ANGLE, "the line's direction", "0 deg", label="direction of its guide"),
    Field("offset", OFFSET, "how far to the left of that joint it runs", 0, label="offset of its guide"),
)
_FREE = never("a slider without a bar is driven along a fixed line; leave it out, or give the slider its bar")
_ONE_CLOSURE = never("a slider without a bar has no second closure; leave it out")

_BAR = Field("length", LENGTH, "the bar's length", label="{bar}", drag="distance")
_LENGTHS = listed(LENGTH, 2)
_AT = aside("{name} on {on}")

LINE = form(
    "a line", Field("on", PAIR, "the axis of a body that carries the line", None), *_LINE_FIELDS, make=_line
)
FIXED_LINE = form("a fixed line", Field("on", _FREE, usual=None), *_LINE_FIELDS, make=Line)
GEAR = form(
    "a gear pair",
    Field("with", JOINT, "the crank that it is geared to", into="mate", must="crank"),
    Field("ratio", RATIO, "its angle to that crank's", label="gear ratio"),
    Field("offset", ANGLE, "its angle where that crank's is 0", "0 deg", label="gear offset"),
    make=Gear,
)
SLOT = form(
    "a slotted bar",
    Field("pivot", JOINT, "the joint that the bar turns about"),
    Field("through", JOINT, "the joint in its slot", must="moving"),
    Field("offset", OFFSET, "how far to the left of the pivot the slot runs", 0, label="offset of its slot"),
)
SLIDE = form(
    "a bar with a slot, on a line",
    Field("pin", JOINT, "the joint in the slot", must="moving"),
    Field("slot", ANGLE, "the slot's direction from the line's", "90 deg", label="direction of its slot"),
    Field("line", LINE, "the line that the bar slides along"),
    refuse=_refuse_parallel,
)

CRANK = form(
    "a crank pin",
    Field("crank", JOINT, "the fixed pin that it turns about", into="pivot", must="fixed", unless="gear"),
    _BAR,
    Field("gear", GEAR, "what turns it if not the drive, then about any joint", None),
    mark="crank",
    make=Crank,
)
DRIVEN_SLIDER = form(
    "a slider that drives",
    Field("line", FIXED_LINE, "the line that it is driven along"),
    Field("side", _ONE_CLOSURE, usual=None),
    mark="line",
    without=("from", "length"),
    make=DrivenSlider,
)
SLIDER = form(
    "a slider that a bar moves",
    Field("from", JOINT, "the bar's other end", into="end", must="moving"),
    _BAR,
    Field("line", LINE, "the line that it slides along"),
    Field("side", side(*RRP.sides), "of two closures the one further along the line, or back", RRP.sides[0]),
    mark="line",
    make=RRP,
)
DYAD = form(
    "a joint of two bars",
    Field("from", PAIR, "the bars' other ends", into="ends"),
    Field("length", _LENGTHS, "the bars' lengths", into="lengths", label=("{bar}",) * 2, drag="distance"),
    Field("side", side(*RRR.sides), "of the line from the first end to the second", RRR.sides[0]),
    mark="from",
    make=RRR,
)
_SLOT = Field("slot", SLOT, "the slotted bar", into=SPREAD)
SLOTTED_BAR = form("the end of a bar that slides through a joint", _SLOT, _BAR, mark="slot", make=RPR)
_SLIDE = Field("slide", SLIDE, "the bar with the slot", into=SPREAD)
YOKE = form("a yoke, where its slot crosses its line", _SLIDE, mark="slide", make=RPP)
BODY_POINT = form(
    "a point of a body",
    Field("on", PAIR, "two joints of the body: its axis"),
    Field("at", POINT, "the place along the axis, and to its left", label=_AT, drag="place"),
    mark="on",
    refuse=_refuse_own,
    make=Rigid,
)

JOINTS = Named((CRANK, DRIVEN_SLIDER, SLIDER, DYAD, SLOTTED_BAR, YOKE, BODY_POINT))
"""The kinds of joints, in the order in which their marks are looked for."""

POLAR_PIN = form(
    "a fixed pin, by its distance",
    Field("length", LENGTH, "the distance from the origin", label="Pin {name}, distance", drag="distance"),
    Field("angle", ANGLE, "the direction from there", label="Pin {name}, direction", drag="direction"),
    make=polar_pin,
)
PLACE = Field("", POINT, "x and y", label=("Pin {name}, x", "Pin {name}, y"), drag="place")
PINS = Named((POLAR_PIN,), PLACE, Pin)
