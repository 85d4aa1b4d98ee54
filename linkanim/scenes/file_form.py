"""State the form of a scene file once: reader, schema, edit list and reference follow from it.

Its parts, in reading order:

- How joints are written: the fields of each kind, and of fixed pins. A kind of joint is one entry here.
- How a linkage is written by points in one pose and the links through them.
- How the input is written and read: a driven crank, a cylinder that turns it, a slider.
- The shorthands [four-bar], [slider-crank] and [six-bar]: the common linkages in a few lines.
- The tables [guide], [function] and [quick-return]: what a linkage was made for.
- The whole scene file: its tables, and the fields of those that are not joints.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, get_args

from linkanim import units
from linkanim.bounds import LONGEST_TEXT
from linkanim.frozen import frozen
from linkanim.intake import few, meant, unnameable
from linkanim.mechanics.linkage import (
    MOTOR,
    RPP,
    RPR,
    RRP,
    RRR,
    Actuator,
    Body,
    Crank,
    Cylinder,
    Damper,
    Drive,
    DrivenSlider,
    Extension,
    Gear,
    Joint,
    Line,
    Load,
    Pin,
    Point,
    Polar,
    Rigid,
    RigidBody,
    Spring,
    Travel,
    coincide,
    holding,
)
from linkanim.scenes.form import (
    ANGLE,
    COLOUR,
    DAMPING,
    FLAG,
    FORCE,
    GRAVITY,
    INERTIA,
    INPUT_SPEED,
    JOINT,
    LENGTH,
    MASS,
    NAME,
    NEEDED,
    OFFSET,
    PAIR,
    POINT,
    POINT_ON_BODY,
    RATIO,
    SHORTEST,
    SPEED,
    SPREAD,
    STIFFNESS,
    TEXT,
    TEXTS,
    TORQUE,
    Field,
    Form,
    Named,
    Schema,
    Table,
    TravelSpeed,
    ValueType,
    choice,
    form,
    listed,
    never,
    on_circle,
    side,
)
from linkanim.scenes.form import JOINTS as MEMBERS
from linkanim.scenes.scene import Block, BodyStyle, FunctionPurpose, Outline, PosesPurpose, TimeRatioPurpose
from linkanim.units import shown
from linkanim.words import to_say

# How joints are written: the fields of each kind, and of fixed pins. A kind of joint is one entry here.

_STEEPEST = math.radians(45)
"""The greatest angle at which teeth of wheels press."""
_LEAST_SLOT = 1e-6
"""Sine of the least angle between a slot and its line of travel."""


def aside(words: str) -> tuple[str, str]:
    """Return the labels of a place on a body: along its axis, and to the left of it."""
    return f"{words}, along", f"{words}, to the left"


def polar_pin(name: str, length: float, angle: float, base: Pin | None = None) -> Pin:
    """Return the fixed pin at `length` and `angle` (rad) from `base`, or from the origin."""
    x, y = base.position if base else (0.0, 0.0)
    dx, dy = on_circle(length, angle)
    return Pin(name, (x + dx, y + dy), Polar(length, angle, base.name if base else None))


def _line(through: str | None = None, on: tuple[str, str] | None = None, **rest: float) -> Line:
    """Return a line of travel; where `through` is not stated, it runs through the first joint of its axis."""
    return Line(through or (on[0] if on else ""), on=on, **rest)


def _refuse_parallel(slide: Table, values: Mapping[str, Any]) -> None:
    if abs(math.sin(values["slot"])) < _LEAST_SLOT:
        raise slide.error("slot", 'lies along the line of travel, so it never crosses it; write "90 deg"')


def _refuse_pressure(gear: Table, values: Mapping[str, Any]) -> None:
    if not 0.0 <= values.get("pressure_angle", 0.0) <= _STEEPEST:
        raise gear.error("pressure_angle", 'is none of teeth; give one from 0 to 45 deg, such as "20 deg"')


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
    Field("pressure_angle", ANGLE, "at which teeth press: 20 deg", None, label="pressure angle"),
    refuse=_refuse_pressure,
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


def _refuse_two_sides(table: Table, values: Mapping[str, Any]) -> None:
    if "near" in table and "side" in table:
        raise table.error("near", "says the closure as side does; keep one of them")


def _without_near(kind: Callable[..., Joint]) -> Callable[..., Joint]:
    """Return what makes a joint whose closure may be named by a place; `reading` finds the side of it."""

    def made(name: str, near: Point | None = None, **known: Any) -> Joint:
        return kind(name, **known)

    return made


_NEAR = Field(
    "near",
    replace(POINT, measure=None),
    "in place of side: the closure nearer to this place at the start",
    None,
)
SLIDER = form(
    "a slider that a bar moves",
    Field("from", JOINT, "the bar's other end", into="end", must="moving"),
    _BAR,
    Field("line", LINE, "the line that it slides along"),
    Field("side", side(*RRP.sides), "of two closures the one further along the line, or back", RRP.sides[0]),
    _NEAR,
    mark="line",
    refuse=_refuse_two_sides,
    make=_without_near(RRP),
)
DYAD = form(
    "a joint of two bars",
    Field("from", PAIR, "the bars' other ends", into="ends"),
    Field("length", _LENGTHS, "the bars' lengths", into="lengths", label=("{bar}",) * 2, drag="distance"),
    Field("side", side(*RRR.sides), "of the line from the first end to the second", RRR.sides[0]),
    _NEAR,
    mark="from",
    refuse=_refuse_two_sides,
    make=_without_near(RRR),
)
_SLOT = Field("slot", SLOT, "the slotted bar", into=SPREAD)
SLOTTED_BAR = form("the end of a bar that slides through a joint", _SLOT, _BAR, mark="slot", make=RPR)
_SLIDE = Field("slide", SLIDE, "the bar with the slot", into=SPREAD)
YOKE = form("a yoke, where its slot crosses its line", _SLIDE, mark="slide", make=RPP)
BODY_POINT = form(
    "a point of a body",
    Field("on", PAIR, "two joints of the body: its axis"),
    Field("at", POINT_ON_BODY, "the place along the axis, and to its left", label=_AT, drag="place"),
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


# How a linkage is written by points in one pose and the links through them.
#
# `links` makes [joints] of these tables, where a chain of dyads says the same: that is edited joint by joint.

GROUND = "ground"
"""The link that stands still."""


def _pair_lengths(table: Table, key: str) -> dict[str, Any] | None:
    """Read the lengths that links state, as { "A-B" = 90 }; each link's by the pair as it is written."""
    links = table.table(key)
    read: dict[str, Any] = {}
    for name in links.values:
        pairs = links.table(name)
        lengths = {pair: pairs.attempt(LENGTH.read, pairs, pair) for pair in pairs.values}
        read[name] = None if None in lengths.values() else lengths
    return None if None in read.values() else read


POLAR_POINT = form(
    "a point, by its distance",
    Field("from", JOINT, "the point that it is measured from, else the origin", None, into="base"),
    Field("length", LENGTH, "the distance from there", label="Point {name}, distance"),
    Field("angle", ANGLE, "the direction from there", label="Point {name}, direction"),
    make=lambda name, **polar: polar,
)
_POSED_AT = ("Point {name}, x", "Point {name}, y")
POINTS = Named(
    (POLAR_POINT,),
    Field("", POINT, "where a point stands in one pose, x and y", label=_POSED_AT),
    lambda _, place: place,
)
LINKS = Named((), Field("", MEMBERS, "the points on a rigid link; `ground` stands still"), lambda _, of: of)
_SLIDES_ON = (
    Field("on", NAME, "the link that carries the line"),
    Field("angle", ANGLE, "the line's direction in the pose", "0 deg", label="Slide {name}, direction"),
)
LINK_SLIDE = form(
    "a link that slides along a line and does not turn on it",
    Field("link", NAME, "the link that slides"),
    *_SLIDES_ON,
    Field("through", JOINT, "a point on the line: the link's first point", None),
    mark="link",
    make=lambda _, **slide: slide,
)
PIN_SLIDE = form(
    "a pin in a slot",
    Field("point", JOINT, "the pin"),
    *_SLIDES_ON,
    mark="point",
    make=lambda _, **slide: slide,
)
SLIDES = Named((LINK_SLIDE, PIN_SLIDE))
_TWO_LINKS = ValueType(
    Table.texts, "2 links", {"type": "array", "items": NAME.schema, "minItems": 2, "maxItems": 2}
)
GEAR_PAIR = form(
    "two links that turn together",
    Field("links", _TWO_LINKS, "the first turns the second"),
    Field("ratio", replace(RATIO, measure=None), "how far the second turns while the first turns once"),
    Field("carrier", NAME, "the link on which both turns are measured", GROUND),
    make=lambda _, **gear: gear,
)
GEARS = Named((GEAR_PAIR,))
_LENGTHS_OF_LINKS = ValueType(
    _pair_lengths,
    'lengths of a link, `{ "A-B" = 90 }`',
    {
        "type": "object",
        "additionalProperties": {"type": "object", "additionalProperties": LENGTH.schema or {}},
    },
    measure=LENGTH.measure,
    bare=LENGTH.bare,
    nested=True,
)
POINTS_FORM = "points"
"""The form of a scene that is saved by its points, though it was edited by its joints."""
POSED = (
    Field("points", POINTS, "the joints in one pose", None),
    Field("links", LINKS, "the rigid links", {}),
    Field("slides", SLIDES, "what slides", {}),
    Field("gears", GEARS, "the gear pairs", {}),
    Field("lengths", _LENGTHS_OF_LINKS, "where points are only read off", {}, label="{name}"),
)
"""The tables of a linkage that is written by its points in one pose."""
MOTOR_OF_POINTS = (
    Field("links", _TWO_LINKS, "of points: what turns on what, where more than two links meet", None),
    Field("slide", NAME, "of points: the slide that drives", None),
    Field(
        "from",
        OFFSET,
        "of a driving slide: its travel at one end; else to its limit",
        None,
        label="Travel from",
    ),
    Field(
        "to",
        OFFSET,
        "of a driving slide: its travel at the other end; else to its limit",
        None,
        label="Travel to",
    ),
)
"""The keys of the input that only such a linkage has."""
POSE_KEYS = tuple(one.key for one in POSED)


# How the input is written and read: a driven crank, a cylinder that turns it, a slider.

Values = Mapping[str, Any]

CYLINDER = form(
    "a cylinder that drives",
    Field("between", PAIR, "a fixed pin, and a joint of the driven crank's body; of points, any two"),
    Field("from", LENGTH, "its length at one end", label="Cylinder, from"),
    Field("to", LENGTH, "its length at the other end", label="Cylinder, to"),
    Field("joint", NAME, "the crank that it turns", None),
)
SLIDER_INPUT = form(
    "a slider that drives",
    Field("joint", NAME, "the slider, declared by its line alone"),
    Field("from", OFFSET, "its travel at one end", label="Slider, from"),
    Field("to", OFFSET, "its travel at the other end", label="Slider, to"),
)
DRIVE = form(
    "the input",
    Field("cylinder", CYLINDER, "what turns the crank, if it does not turn by itself", None),
    Field("slider", SLIDER_INPUT, "what drives instead of a crank", None),
    Field("joint", NAME, "the crank that is driven; of points, its pivot: the first one", None),
    Field(
        "speed",
        INPUT_SPEED,
        'turns, or there and back; negative: clockwise; of a length, `"10 cm/s"`',
        "20 rpm",
        label="Input speed",
    ),
    Field("start", ANGLE, "the crank's angle at the start", "0 deg", label="Start angle"),
    Field(
        "returns", choice("other", "same"), "the closure on which an input that swings comes back", "other"
    ),
    *MOTOR_OF_POINTS,
)
INPUT = Field("drive", DRIVE, "the input", {})
MOST_RATIO, RATIO_ROUNDED = 64, 1e-12
"""The greatest number in the ratio of two motors' speeds, and the share by which that may be rounded."""
FURTHER = form(
    "a further motor",
    Field("joint", NAME, "the crank that it drives; of points, its pivot"),
    Field("links", _TWO_LINKS, "of points: what turns on what, where more than two links meet", None),
    Field("speed", SPEED, "how fast it turns; negative: clockwise", label="speed"),
    Field(
        "start",
        ANGLE,
        "the crank's angle at the start; of points, that of the pose",
        None,
        label="start angle",
    ),
    make=lambda _, **motor: motor,
)


def motor_ratio(table: Table, speed: Any, first: Any) -> Fraction:
    """Return how many times as fast as the first motor another one turns."""
    if isinstance(speed, TravelSpeed) or isinstance(first, TravelSpeed):
        raise table.error("speed", 'is a speed along a line, but two cranks turn; write "20 rpm"')
    ratio = Fraction(speed / first).limit_denominator(MOST_RATIO)
    if abs(float(ratio) * first - speed) > RATIO_ROUNDED * abs(speed) or abs(ratio) > MOST_RATIO:
        raise table.error(
            "speed",
            f"and that of the first motor are not as small whole numbers, up to {MOST_RATIO}, so the linkage"
            " would never be back; choose others",
        )
    return ratio


def read_drive(top: Table, usual: str | None) -> Drive | None:
    """Read the drive; where no joint is named it is the `usual` one, or the first crank without a gear.

    None where its table or a joint has a fault. SceneError where nothing is left to be driven, or more than
    one joint would have to be.
    """
    values: Values | None = INPUT.read(top)
    if values is None or not top.context.sound:
        return None
    for key in (one.key for one in MOTOR_OF_POINTS if one.key in top.table("drive")):
        raise top.table("drive").error(key, "goes with [points] and [links]; leave it out")
    joints = top.context.joints.values()
    if "slider" in values or any(joint.driven_slide for joint in joints):
        return _slider_drive(top, values)
    table = top.table("drive")
    cylinder = values.get("cylinder")
    cranks = [joint for joint in joints if isinstance(joint, Crank)]
    free = [crank.name for crank in cranks if crank.gear is None]
    if any(joint.motor for joint in joints):
        at_zero, retraced = values["start"] == 0, values["returns"] == "same"
        speed = _phase_speed(table, values["speed"], MOTOR)
        return Drive(values["joint"], speed, values["start"], at_zero=at_zero, retraced=retraced)
    if not free:
        raise top.table("joints").wrong("no crank is free to be driven; add one without a gear, as the input")
    by_cylinder = "joint" in (cylinder or {})
    name = {**values, **(cylinder or {})}.get("joint", usual or free[0])
    if name not in free:
        holder = table.table("cylinder") if by_cylinder else table
        raise holder.error("joint", f"is not a crank that can be driven; that is {free[0]}")
    if len(free) > 1:
        other = next(crank for crank in free if crank != name)
        way_out = f"gear it: gear = {{ with = {shown(name)}, ratio = -1 }}"
        raise top.table("joints").wrong(f"{other} is a second input beside {name}; {way_out}")
    driven = _cylinder(table.table("cylinder"), cylinder, name) if cylinder else MOTOR
    at_zero = values["start"] == 0 and "start" in table
    retraced = values["returns"] == "same"
    speed = _phase_speed(table, values["speed"], driven)
    return Drive(name, speed, values["start"], driven, at_zero=at_zero, retraced=retraced)


def _phase_speed(table: Table, speed: float | TravelSpeed, actuator: Actuator) -> float:
    """Return dφ/dt (rad/s); a length's speed is the mean one on its way from one end to the other."""
    if not isinstance(speed, TravelSpeed):
        return speed
    if not actuator.stated_lengths:
        raise table.error("speed", 'is a speed along a line, but a crank turns; write "20 rpm"')
    first, last = actuator.stated_lengths
    return math.pi * speed.metres / (abs(last - first) * units.metre(table.context.unit))


def _slider_drive(top: Table, values: Values) -> Drive:
    """Return the drive of a slider: of the one joint that is declared by its line alone."""
    table, joints = top.table("drive"), top.context.joints
    driven = [name for name, joint in joints.items() if joint.driven_slide]
    if "slider" not in values:
        way_out = f"drive it: [drive] slider = {{ joint = {shown(driven[0])}, from = 0, to = 100 }}"
        raise top.table("joints").table(driven[0]).wrong(f"has a line, but no bar that moves it; {way_out}")
    for key in ("joint", "start", "cylinder"):
        if key in table:
            raise table.error(key, "does not go with a slider that drives; leave it out")
    slider, travel = table.table("slider"), values["slider"]
    name = travel["joint"]
    if name not in driven:
        known = f"; that is {driven[0]}" if driven else ""
        raise slider.error("joint", f"is no slider that is declared by its line alone{known}")
    inputs = [*driven, *(joint.name for joint in joints.values() if isinstance(joint, Crank))]
    if len(inputs) > 1:
        other = next(joint for joint in inputs if joint != name)
        raise top.table("joints").wrong(
            f"{other} is a second input beside {name}; let it follow: give it from and length"
        )
    if abs(travel["to"] - travel["from"]) < SHORTEST:
        raise slider.error("to", "is the same place as from, so nothing would move")
    ends, between = (travel["from"], travel["to"]), joints[name].driven_between
    actuator = Extension(*ends, between) if between else Travel(*ends)
    speed = _phase_speed(table, values["speed"], actuator)
    return Drive(name, speed, actuator=actuator, retraced=values["returns"] == "same")


def _cylinder(table: Table, values: Values, driven: str) -> Cylinder:
    """Return a cylinder between a fixed pin and a joint of the driven crank's body, named in either order."""
    joints, (ground, *others) = table.context.joints, table.context.rigid
    first, second = values["between"]
    fixed, moving = (first, second) if joints[first].fixed else (second, first)
    crank = joints[driven]
    assert isinstance(crank, Crank)
    if not joints[fixed].fixed or fixed == crank.pivot:
        raise table.error("between", f"names no fixed pin beside {crank.pivot}; one end stands on the ground")
    if coincide(ground, fixed, crank.pivot):
        reason = f"{fixed} and {crank.pivot} are one point, about which a cylinder turns nothing"
        raise table.error("between", f"{reason}; name a pin beside it")
    carried = [frame for frame in others if {crank.pivot, driven, moving} <= frame.keys()]
    if not carried or coincide(carried[0], crank.pivot, moving):
        raise table.error("between", f"{moving} is no joint of the body that turns with {driven}")
    if abs(values["to"] - values["from"]) < SHORTEST:
        raise table.error("to", "is the same length as from, so nothing would move")
    return Cylinder((fixed, moving), values["from"], values["to"])


# The shorthands [four-bar], [slider-crank] and [six-bar]: the common linkages in a few lines.
#
# Each gives the joints that the long form would give, under fixed names: pins O2, O4, O6, joints A, B, C, D,
# and the coupler points P (on the coupler) and P2 (on coupler2), traced unless [trace] says otherwise.


@frozen
class Expansion:
    """The meaning of a shorthand; `drive` is the joint that is driven unless [drive] says otherwise."""

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


def _refuse_own_shorthands(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse a coupler point that is a joint of its coupler."""
    for key, first in (("coupler_point", "A"), ("coupler_point2", "C")):
        if values.get(key) == (0.0, 0.0):
            reason = f"is the joint {first} itself; leave it out, or give a point such as [45, 30]"
            raise table.error(key, reason)


def _bars(key: str, *bars: tuple[str, str, str]) -> Field:
    """Return the field of one or several bars' lengths; `bars` has each one's label and its two joints."""
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
_OPEN = side(to_say("open"), to_say("crossed"))

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
        refuse=_refuse_own_shorthands,
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
        refuse=_refuse_own_shorthands,
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
        refuse=_refuse_own_shorthands,
        make=_six_bar,
    ),
}
"""The shorthands by the name of their table."""


def names_of(key: str, keys: Container[str]) -> tuple[str, ...]:
    """Return the names of all joints that a shorthand's table with these keys states."""
    stated = [one for one in SHORTHANDS[key].fields if one.usual is NEEDED or one.key in keys]
    ends = (name for one in stated if one.drag != "direction" for span in one.spans for name in span)
    return tuple(dict.fromkeys(ends))


# The tables [guide], [function] and [quick-return]: what a linkage was made for.
#
# Their lengths always state a unit: they are not dimensions to be edited, and do not change with the unit.

_FEWEST_POSES, _MOST_POSES = 2, 5
_FEWEST_POINTS, _MOST_POINTS = 2, 12
_STATED: Schema = {"type": "string", "pattern": r"[a-z]"}


def _with_unit(table: Table, key: str, of: ValueType, example: str) -> float:
    value = table.values[key]
    if not isinstance(value, str):
        raise table.error(key, f'needs its unit; write it as "{example}"')
    number: float = of.read(table, key)
    return number


def _length(table: Table, key: str) -> float:
    return _with_unit(table, key, OFFSET, "80 mm")


def _number(table: Table, key: str) -> float:
    value = table.values[key]
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise table.error(key, "must be a finite number")
    return float(value)


def _ratio(table: Table, key: str) -> float:
    ratio = _number(table, key)
    if ratio < 1:
        raise table.error(key, "is the slow way's time over the quick way's; give 1 or more")
    return ratio


def _listed(read: Any, words: str, item: Schema, low: int, high: int) -> ValueType:
    """Return the type of a list of `low` to `high` values."""

    def take(table: Table, key: str) -> tuple[Any, ...] | None:
        value = table.values[key]
        if not isinstance(value, list) or not low <= len(value) <= high:
            raise table.error(key, f"must be a list of {low} to {high} {words}")
        items = table.listed(key)
        values = tuple(items.attempt(read, items, one) for one in items.values)
        return None if None in values else values

    schema = {"type": "array", "items": item, "minItems": low, "maxItems": high}
    return ValueType(take, f"{low} to {high} {words}", schema)


def _pose(table: Table, key: str) -> tuple[Any, ...] | None:
    value = table.values[key]
    if not isinstance(value, list) or len(value) != 3:
        raise table.error(key, 'must be x, y and an angle, such as ["40 mm", "10 mm", "35 deg"]')
    items = table.listed(key)
    reads = (_length, _length, ANGLE.read)
    values = tuple(items.attempt(read, items, one) for read, one in zip(reads, items.values, strict=True))
    return None if None in values else values


def _place(table: Table, key: str) -> float:
    """Read an angle, or a travel along a line."""
    value = table.values[key]
    angular = isinstance(value, str) and any(sign in value for sign in ("deg", "rad", "°"))
    return _with_unit(table, key, ANGLE if angular else OFFSET, "30 deg")


_POSES = _listed(
    _pose,
    'poses, `["40 mm", "10 mm", "35 deg"]`',
    {"type": "array", "items": _STATED, "minItems": 3, "maxItems": 3},
    *(_FEWEST_POSES, _MOST_POSES),
)
_NUMBERS = _listed(_number, "numbers", {"type": "number"}, _FEWEST_POINTS, _MOST_POINTS)
_ANGLES = _listed(ANGLE.read, "angles", _STATED, _FEWEST_POINTS, _MOST_POINTS)
_PLACES = _listed(_place, "angles, or lengths", _STATED, _FEWEST_POINTS, _MOST_POINTS)


def _refuse_uneven(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse precision points whose lists differ in length."""
    counts = {len(values[key]) for key in ("x", "y", "input", "output")}
    if len(counts) > 1:
        raise table.wrong("x, y, input and output have to be equally long: one of each a precision point")


def _refuse_both(table: Table, values: Mapping[str, Any]) -> None:
    if ("stroke" in values) == ("swing" in values):
        raise table.wrong("give either the slider's stroke or the rocker's swing")


PURPOSES: Mapping[str, Form] = {
    "guide": form(
        "the poses that its coupler was made for",
        Field("poses", _POSES, "x, y and angle of the first traced joint and its body"),
        make=PosesPurpose,
    ),
    "function": form(
        "the function that it was made for, in its precision points",
        Field("words", TEXT, 'such as "y = log10(x)"'),
        Field("x", _NUMBERS, "where it is exact"),
        Field("y", _NUMBERS, "what it is there"),
        Field("input", _ANGLES, "the crank's angle there"),
        Field("output", _PLACES, "the output's angle there, or the slider's way along its line"),
        refuse=_refuse_uneven,
        make=FunctionPurpose,
    ),
    "quick-return": form(
        "the time ratio that it was made for",
        Field(
            "ratio", ValueType(_ratio, "a number from 1", {"type": "number", "minimum": 1}), "slow to quick"
        ),
        Field("stroke", ValueType(_length, 'a length, `"80 mm"`', _STATED), "of the slider", None),
        Field("swing", ValueType(ANGLE.read, ANGLE.words, ANGLE.schema), "of the rocker", None),
        refuse=_refuse_both,
        make=TimeRatioPurpose,
    ),
}
"""The tables by their names."""


# The whole scene file: its tables, and the fields of those that are not joints.


def _refuse_block(table: Table, values: Mapping[str, Any]) -> None:
    slider = table.context.joints.get(values["slider"])
    if slider and not slider.travels:
        raise table.error("slider", "does not travel on a line; name a joint that has one")


def _refuse_bar(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse a body with too few joints, with joints on several rigid bodies, or with two in one point."""
    _refuse_radius(table, values)
    members, frames = values["joints"], table.context.rigid
    if len(members) < 2:
        raise table.error("joints", "must name two joints or more; a body's angle is that of first -> second")
    if not all(name in table.context.joints for name in members):
        return
    n = holding(frames, members)
    if n is None:
        raise table.error("joints", f"{', '.join(members)} are not joints of one rigid body")
    first, second, *_ = members
    if coincide(frames[n], first, second):
        raise table.error("joints", f"{first} and {second} are one point; name another first or second")
    if "mass" in values and "com" not in values:
        half = abs(frames[n][second] - frames[n][first]) / 2
        halfway = f"com = [{half:g}, 0] is halfway from {first} to {second}"
        raise table.error("mass", f"needs to be known where it is; {halfway}")


def _refuse_radius(table: Table, values: Mapping[str, Any]) -> None:
    if "radius" in values and values.get("look") not in ("wheel", "railwheel"):
        raise table.error("radius", 'is that of a wheel; write look = "wheel" beside it, or leave it out')


def _refuse_half(table: Table, values: Mapping[str, Any]) -> None:
    if ("stiffness" in values) != ("free_length" in values):
        raise table.wrong("a force needs both stiffness and free_length; give both, or neither")


def _drawn(
    name: str,
    look: Outline | Block | None = None,
    colour: Any = None,
    radius: float | None = None,
    **known: Any,
) -> tuple[Body, BodyStyle]:
    """Return a body as a file states it: what moves, and how it is drawn."""
    return Body(name, **known), BodyStyle(look, colour, radius)


_MASS = Field("mass", MASS, "its mass", None, label="mass")
_COLOUR = Field("colour", COLOUR, "its colour", None)
_BETWEEN = Field("between", PAIR, "its two ends")
_COM = aside("{name} centre of mass")

BLOCK = form(
    "the block of a slider",
    Field("slider", JOINT, "the joint that it travels with"),
    _MASS,
    Field("look", choice(*get_args(Block)), "how it is drawn", None),
    _COLOUR,
    mark="slider",
    refuse=_refuse_block,
    make=_drawn,
)
BAR = form(
    "a body",
    Field("joints", MEMBERS, "the joints on it; its angle is that of the first to the second"),
    Field("com", POINT, "its centre of mass along first–second, and to the left", None, label=_COM),
    _MASS,
    Field("inertia", INERTIA, "about the centre of mass", None, label="moment of inertia"),
    Field("look", choice(*get_args(Outline)), "how it is drawn", None),
    Field("radius", LENGTH, "of a wheel, else out to its furthest joint", None, label="wheel's radius"),
    _COLOUR,
    refuse=_refuse_bar,
    together={"mass": "com"},
    make=_drawn,
)
SPRING = form(
    "a spring",
    _BETWEEN,
    Field("stiffness", STIFFNESS, "its stiffness; with it the force is known", None, label="stiffness"),
    Field("free_length", LENGTH, "its length without force", None, label="free length"),
    refuse=_refuse_half,
    together={"stiffness": "free_length", "free_length": "stiffness"},
    make=Spring,
)
_COEFFICIENT = Field("coefficient", DAMPING, "its force by its rate", None, label="damping coefficient")
DAMPER = form("a damper", _BETWEEN, _COEFFICIENT, make=Damper)


# A load: where it acts, how large it is, which way it points.

_MOST_ROWS = 1_000


def _place_of_load(table: Table, key: str) -> Any:
    """Read where a force acts: the name of a joint, or a place along a body's axis and to its left."""
    if isinstance(table.values[key], str):
        return table.joint(key, table.text(key))
    return POINT.read(table, key)


def _load_table(table: Table, key: str) -> tuple[tuple[float, float], ...] | None:
    """Read rows of a place, an angle or a length as `over` says, and the force there; places rise."""
    value, over = table.values[key], table.choice("over", ("angle", "travel"))
    of, example = (ANGLE, '[["0 deg", "0 N"], ["90 deg", "50 N"]]')
    if over == "travel":
        of, example = OFFSET, '[["0 mm", "0 N"], ["20 mm", "50 N"]]'
    if not isinstance(value, list) or not 2 <= len(value) <= _MOST_ROWS:
        raise table.error(key, f"must be a list of 2 to {_MOST_ROWS} rows, such as {example}")
    rows = table.listed(key)
    read: list[tuple[float, float]] = []
    for name, row in rows.values.items():
        if not isinstance(row, list) or len(row) != 2:
            raise rows.error(name, f"must be a place and the force there, as in {example}")
        cells = rows.listed(name)
        place, force = (cells.attempt(kind.read, cells, f"{name}[{n}]") for n, kind in enumerate((of, FORCE)))
        if place is None or force is None:
            return None
        if read and place <= read[-1][0]:
            raise rows.error(name, "does not come after the row before it; let the places rise")
        read.append((float(place), force))
    if over == "angle" and read[-1][0] - read[0][0] >= math.tau:
        raise table.error(key, "goes over a whole turn or more, after which it begins anew; leave rows out")
    return tuple(read)


def _refuse_size(table: Table, values: Mapping[str, Any]) -> None:
    if ("size" in values) == ("table" in values):
        raise table.wrong('needs its size, such as size = "50 N", or a table instead')
    if "over" in table and "table" not in values:
        raise table.error("over", "goes with a table; leave it out")
    for key in ("angle", "turns") if values["against"] else ():
        if key in table:
            raise table.error(key, "does not go with against, which is along the slider's line; leave it out")


def _load_force(
    angle: float,
    turns: bool,
    against: bool,
    over: str,
    size: float = 1.0,
    table: tuple[tuple[float, float], ...] = (),
    moving: int = 0,
) -> Load:
    """Return a load without a place: its force, of length 1 where a table has its sizes."""
    places, values = zip(*table, strict=True) if table else ((), ())
    force = (size, 0.0) if against else on_circle(size, angle)
    return Load(
        "",
        "",
        force=force,
        turns=turns,
        places=places,
        values=values,
        over_travel=bool(table) and over == "travel",
        against=against,
        way=moving,
    )


_ROWS: Schema = {"type": "array", "items": {}, "minItems": 2, "maxItems": 2}
_LOAD_TABLE = ValueType(
    _load_table,
    'rows, `[["0 deg", "0 N"], ["90 deg", "50 N"]]`',
    {"type": "array", "items": _ROWS, "minItems": 2, "maxItems": _MOST_ROWS},
)
_TWO_FORCES = listed(FORCE, 2)
LOAD_FORCE = form(
    "a force",
    Field("size", FORCE, "how large it is", None, label="size"),
    Field("angle", ANGLE, "its direction", "0 deg", label="direction"),
    Field("turns", FLAG, "whether it turns with its body, and the angle is from the body's axis", False),
    Field("against", FLAG, "of a slider: along its line, against its motion", False),
    Field("table", _LOAD_TABLE, "in place of size: sizes at places, linearly between them", None),
    Field(
        "over",
        choice("angle", "travel"),
        "what the places are: the input's angle, or its slider's travel",
        "angle",
    ),
    Field("moving", side("forward", "backward"), "of a slider: only while it moves so along its line", None),
    refuse=_refuse_size,
    make=_load_force,
    plain=Field("force", _TWO_FORCES, "to the right, and up", None, label=("force to the right", "force up")),
)
_LOAD_PLACE = ValueType(
    _place_of_load,
    "a joint of the body, or 2 lengths",
    {"anyOf": [NAME.schema, POINT.schema]},
    "offset",
    bare=True,
    refers=True,
)


def _load(name: str, on: str, at: Any = None, force: Load | Point | None = None, torque: float = 0.0) -> Load:
    where = {"joint": at} if isinstance(at, str) else {"at": at}
    how = force if isinstance(force, Load) else Load("", "", force=force or (0.0, 0.0))
    return replace(how, name=name, on=on, torque=torque, **where)


def _refuse_idle(table: Table, values: Mapping[str, Any]) -> None:
    if "force" not in values and "torque" not in values:
        raise table.wrong('does nothing; give it a force, such as force = ["50 N", "0 N"], or a torque')


LOAD = form(
    "a load on a body",
    Field("on", replace(NAME, words="a body"), "the body's name"),
    Field("at", _LOAD_PLACE, "where: a joint, or along its axis and to the left", None, label=aside("place")),
    Field("force", LOAD_FORCE, "its force", None),
    Field("torque", TORQUE, "its torque, counter-clockwise", None, label="torque"),
    refuse=_refuse_idle,
    make=_load,
)


def refuse_misplaced(
    loads: Table, load: Load, bodies: Mapping[str, Body], rigid: tuple[RigidBody, ...]
) -> Load:
    """Return a load; refuse one on no body, at a joint that is not on it, or as of a slider on none."""
    table = loads.table(load.name)
    body = bodies.get(load.on)
    if body is None:
        known = f"; there are {few(bodies)}" if bodies else "; name one in [bodies]"
        raise table.error("on", f"no body is called {shown(load.on)}{meant(load.on, bodies)}{known}")
    if load.joint and (
        load.joint != body.slider if body.slider else holding(rigid, (*body.joints, load.joint)) is None
    ):
        own = body.slider or ", ".join(body.joints)
        raise table.error("at", f"{load.joint} is no joint of {load.on}; name one of it ({own}), or a place")
    if body.slider is None:
        force = table.table("force") if isinstance(table.values.get("force"), Mapping) else table
        for key, states in (("against", load.against), ("moving", load.way), ("over", load.over_travel)):
            if states:
                raise force.error(key, f"is of a slider, but {load.on} slides along no line; leave it out")
        if load.at is None and not load.joint and load.force != (0.0, 0.0):
            raise table.wrong(f'does not say where; write at = "{body.joints[0]}", or a place on {load.on}')
    return load


def _picture(table: Table, key: str) -> str:
    """Read the path of a picture, which need not exist; refuse a path that no file can have."""
    file = table.text(key)
    if reason := unnameable(file):
        raise table.error(key, f"{reason}; rename the picture")
    return file


_PICTURE = replace(
    TEXT,
    read=_picture,
    schema={
        "type": "string",
        "maxLength": LONGEST_TEXT,
        "pattern": r"^(?=.*\S)([^/\\]{0,255}[/\\])*[^/\\]{0,255}$",
    },
)
PHOTO = form(
    "a photograph to build over, behind the sheet",
    Field("file", _PICTURE, "its path from the scene file's folder"),
    Field("place", replace(POINT, measure=None), "x and y of its lower left corner"),
    Field("width", replace(LENGTH, measure=None), "how wide it is"),
    Field("turn", replace(ANGLE, measure=None), "by what angle it is turned about that corner", "0 deg"),
)
TRACE = form("the curves", Field("joints", MEMBERS, "the joints whose curves are drawn", None))

SCENE_FILE = form(
    "the file",
    Field("title", TEXT, "what it is called: the file's name", None),
    Field("source", TEXT, "where its dimensions come from", ""),
    Field("chapter", TEXT, "the part of a collection that it belongs to", ""),
    Field("look_at", TEXT, "what to watch for, in a sentence", ""),
    Field("notes", TEXTS, "what a reader of its figures should know", []),
    Field("length_unit", choice(*units.LENGTH_UNITS), "the unit of bare lengths", units.LENGTH_UNITS[0]),
    Field("form", choice("joints", POINTS_FORM), "in which form the window saves the scene", "joints"),
    *(Field(key, one, one.words, None) for key, one in SHORTHANDS.items()),
    Field("joints", JOINTS, "the joints", {}),
    Field("ground", PINS, "the fixed pins", {}),
    *POSED,
    Field("bodies", Named((BLOCK, BAR)), "what is drawn and named", {}),
    Field("springs", Named((SPRING,)), "the springs", {}),
    Field("dampers", Named((DAMPER,)), "the dampers", {}),
    Field("loads", Named((LOAD,)), "the loads", {}),
    Field("gravity", GRAVITY, "how fast masses fall, down", None, label="Gravity"),
    INPUT,
    Field("drives", Named((FURTHER,)), "further motors", {}),
    Field("trace", TRACE, "the curves", {}),
    *(Field(key, one, one.words, None) for key, one in PURPOSES.items()),
    Field("photo", PHOTO, "a photograph to build over", None),
)
"""The form of a scene file."""
SECTIONS: Mapping[str, Field] = {one.key: one for one in SCENE_FILE.fields}
