"""The input: a crank that is driven, a cylinder that turns it, or a slider that drives."""

from __future__ import annotations

from linkanim import units
from linkanim.mechanics.linkage.drive import MOTOR, Cylinder, Drive, Travel
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider
from linkanim.mechanics.linkage.rigid_bodies import coincide, rigid_bodies
from linkanim.scenes.reading.check import Table

DEFAULT_SPEED = "20 rpm"


def read_drive(top: Table, joints: tuple[Joint, ...], usual: str | None) -> Drive:
    """Read the drive; where no joint is named it is the `usual` one, or the first crank without a gear.

    SceneError where nothing is left to be driven, or more than one joint would have to be.
    """
    table = top.table("drive")
    table.only("joint", "speed", "start", "cylinder", "slider")
    if "slider" in table or any(isinstance(joint, DrivenSlider) for joint in joints):
        return _slider_drive(top, table, joints)
    cranks = [joint for joint in joints if isinstance(joint, Crank)]
    free = [crank.name for crank in cranks if crank.gear is None]
    if not free:
        raise top.table("joints").wrong("no crank is free to be driven; add one without a gear, as the input")
    cylinder = table.table("cylinder")
    cylinder.only("between", "from", "to", "joint")
    name = cylinder.text("joint", table.text("joint", usual or free[0]))
    if name not in free:
        raise table.error("joint", f"is not a crank that can be driven; that is {free[0]}")
    if len(free) > 1:
        other = next(crank for crank in free if crank != name)
        way_out = f"gear it: gear = {{ with = {units.shown(name)}, ratio = -1 }}"
        raise top.table("joints").wrong(f"{other} is a second input beside {name}; {way_out}")
    speed, start = table.speed("speed", DEFAULT_SPEED), table.angle("start", "0 deg")
    driven = _cylinder(cylinder, joints, name) if "cylinder" in table else MOTOR
    return Drive(name, speed, start, driven, at_zero=start == 0 and "start" in table)


def _slider_drive(top: Table, table: Table, joints: tuple[Joint, ...]) -> Drive:
    """Read a slider that drives: the one joint that is declared by its line alone."""
    driven = [joint.name for joint in joints if isinstance(joint, DrivenSlider)]
    if "slider" not in table:
        way_out = f"drive it: [drive] slider = {{ joint = {units.shown(driven[0])}, from = 0, to = 100 }}"
        raise top.table("joints").table(driven[0]).wrong(f"has a line, but no bar that moves it; {way_out}")
    for key in ("joint", "start", "cylinder"):
        if key in table:
            raise table.error(key, "does not go with a slider that drives; leave it out")
    slider = table.table("slider")
    slider.only("joint", "from", "to")
    name = slider.text("joint")
    if name not in driven:
        known = f"; that is {driven[0]}" if driven else ""
        raise slider.error("joint", f"is no slider that is declared by its line alone{known}")
    others = [joint.name for joint in joints if isinstance(joint, Crank) or joint.name in driven]
    if len(others) > 1:
        other = next(joint for joint in others if joint != name)
        raise top.table("joints").wrong(
            f"{other} is a second input beside {name}; let it follow: give it from and length"
        )
    for key in ("from", "to"):
        slider.need(key)
    first, last = slider.offset("from"), slider.offset("to")
    if first == last:
        raise slider.error("to", "is the same place as from, so nothing would move")
    return Drive(name, table.speed("speed", DEFAULT_SPEED), actuator=Travel(first, last))


def _cylinder(table: Table, joints: tuple[Joint, ...], driven: str) -> Cylinder:
    """Read a cylinder between a fixed pin and a joint of the driven crank's body, named in either order."""
    known = {joint.name: joint for joint in joints}
    first, second = table.members("between", known, 2)
    fixed, moving = (first, second) if known[first].fixed else (second, first)
    crank = known[driven]
    assert isinstance(crank, Crank)
    if not known[fixed].fixed or fixed == crank.pivot:
        raise table.error("between", f"names no fixed pin beside {crank.pivot}; one end stands on the ground")
    ground, *others = rigid_bodies(joints)
    if coincide(ground, fixed, crank.pivot):
        reason = f"{fixed} and {crank.pivot} are one point, about which a cylinder turns nothing"
        raise table.error("between", f"{reason}; name a pin beside it")
    carried = [frame for frame in others if {crank.pivot, driven, moving} <= frame.keys()]
    if not carried or coincide(carried[0], crank.pivot, moving):
        raise table.error("between", f"{moving} is no joint of the body that turns with {driven}")
    start, end = table.length("from"), table.length("to")
    if start == end:
        raise table.error("to", "is the same length as from, so nothing would move")
    return Cylinder((fixed, moving), start, end)
