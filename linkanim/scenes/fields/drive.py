"""How the input is written, and what it comes to: a driven crank, a cylinder that turns it, a slider."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim.mechanics.linkage.drive import MOTOR, Cylinder, Drive, Travel
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider
from linkanim.mechanics.linkage.rigid_bodies import coincide
from linkanim.scenes.fields.form import Field, form
from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import ANGLE, LENGTH, NAME, OFFSET, PAIR, SHORTEST, SPEED, choice
from linkanim.units import shown

Values = Mapping[str, Any]

CYLINDER = form(
    "a cylinder that drives",
    Field("between", PAIR, "a fixed pin, and a joint of the driven crank's body"),
    Field("from", LENGTH, "its length at one end", label="Cylinder, from"),
    Field("to", LENGTH, "its length at the other end", label="Cylinder, to"),
    Field("joint", NAME, "the crank that it turns", None),
)
SLIDER = form(
    "a slider that drives",
    Field("joint", NAME, "the slider, declared by its line alone"),
    Field("from", OFFSET, "its travel at one end", label="Slider, from"),
    Field("to", OFFSET, "its travel at the other end", label="Slider, to"),
)
DRIVE = form(
    "the input",
    Field("cylinder", CYLINDER, "what turns the crank, if it does not turn by itself", None),
    Field("slider", SLIDER, "what drives instead of a crank", None),
    Field("joint", NAME, "the crank that is driven: the first one without a gear", None),
    Field("speed", SPEED, "turns, or there and back; negative: clockwise", "20 rpm", label="Input speed"),
    Field("start", ANGLE, "the crank's angle at the start", "0 deg", label="Start angle"),
    Field(
        "returns", choice("other", "same"), "the closure on which an input that swings comes back", "other"
    ),
)
INPUT = Field("drive", DRIVE, "the input", {})


def read_drive(top: Table, usual: str | None) -> Drive | None:
    """Read the drive; where no joint is named it is the `usual` one, or the first crank without a gear.

    None where its table or a joint has a fault. SceneError where nothing is left to be driven, or more than
    one joint would have to be.
    """
    values: Values | None = INPUT.read(top)
    if values is None or not top.context.sound:
        return None
    joints = top.context.joints.values()
    if "slider" in values or any(isinstance(joint, DrivenSlider) for joint in joints):
        return _slider_drive(top, values)
    table = top.table("drive")
    cylinder = values.get("cylinder")
    cranks = [joint for joint in joints if isinstance(joint, Crank)]
    free = [crank.name for crank in cranks if crank.gear is None]
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
    return Drive(name, values["speed"], values["start"], driven, at_zero=at_zero, retraced=retraced)


def _slider_drive(top: Table, values: Values) -> Drive:
    """Return the drive of a slider: of the one joint that is declared by its line alone."""
    table, joints = top.table("drive"), top.context.joints
    driven = [joint.name for joint in joints.values() if isinstance(joint, DrivenSlider)]
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
    inputs = [joint.name for joint in joints.values() if isinstance(joint, Crank | DrivenSlider)]
    if len(inputs) > 1:
        other = next(joint for joint in inputs if joint != name)
        raise top.table("joints").wrong(
            f"{other} is a second input beside {name}; let it follow: give it from and length"
        )
    if abs(travel["to"] - travel["from"]) < SHORTEST:
        raise slider.error("to", "is the same place as from, so nothing would move")
    actuator = Travel(travel["from"], travel["to"])
    return Drive(name, values["speed"], actuator=actuator, retraced=values["returns"] == "same")


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
