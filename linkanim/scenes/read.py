"""The document in a scene file to a checked `Scene`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from linkanim import units
from linkanim.document import few, meant
from linkanim.errors import AssemblyError, BadInput
from linkanim.mechanics.frames import coincide, frames_of, holding
from linkanim.mechanics.joint import Frame, Joint, Need
from linkanim.mechanics.kinds import RRR, Crank, DrivenSlider, Pin
from linkanim.mechanics.linkage import Body, Cylinder, Damper, Drive, Linkage, Spring, Travel
from linkanim.scenes.check import Table
from linkanim.scenes.joints import LOOKS, read_joint, read_pin
from linkanim.scenes.order import circle, solved_order
from linkanim.scenes.scene import Scene
from linkanim.scenes.shorthand import SHORTHANDS, Expansion, expand

_TOP = (
    "title", "source", "chapter", "look_at", "notes", "length_unit",
    "gravity", "drive", "ground", "joints", "bodies", "springs", "dampers", "trace", *SHORTHANDS,
)  # fmt: skip
_HEX = re.compile(r"#[0-9a-f]{6}", re.I | re.A)
DEFAULT_SPEED = "20 rpm"


def scene_from(document: Mapping[str, Any], *, name: str, where: str, towards: Scene | None = None) -> Scene:
    """Return the scene that a document describes, put together.

    `where` names the file in errors. Lengths come out in the document's `length_unit` (mm if it has none),
    angles in radians; joints in the order in which they can be solved. SceneError for whatever is unknown,
    missing or contradictory; AssemblyError for lengths that cannot be assembled. `towards` is the scene that
    this one is on the way to, where it is shown for an instant.
    """
    scene = drafted(document, name=name, where=where, towards=towards)
    _check_assembly(Table(where, document), scene)
    return scene


def drafted(document: Mapping[str, Any], *, name: str, where: str, towards: Scene | None = None) -> Scene:
    """Return the scene that a document describes before it is known whether it can be put together."""
    top = Table(where, document, unit=_length_unit(Table(where, document)))
    top.only(*_TOP)
    short = expand(top, _origin(top))
    joints = _joints(top, short)
    rigid = frames_of(joints)
    _check_rigid(top, joints, rigid)
    bodies = _bodies(top, joints, rigid, short.bodies)
    linkage = Linkage(
        joints=joints,
        drive=_drive(top, joints, short.drive),
        bodies=bodies,
        springs=tuple(_spring(name, table, joints) for name, table in top.tables("springs")),
        dampers=tuple(_damper(name, table, joints) for name, table in top.tables("dampers")),
        metre=units.metre(top.unit),
        gravity=_gravity(top, bodies),
    )
    return Scene(
        name=name,
        title=top.text("title", name),
        source=top.text("source", ""),
        length_unit=top.unit,
        linkage=linkage,
        trace=_trace(top, joints, short.trace),
        chapter=top.text("chapter", ""),
        look_at=top.text("look_at", ""),
        notes=top.texts("notes"),
        document=document,
        towards=towards,
    )


def _check_assembly(top: Table, scene: Scene) -> None:
    """Refuse lengths that cannot be put together, saying in which file and table they stand."""
    try:
        _ = scene.mechanism
    except AssemblyError as error:
        section = next((key for key in SHORTHANDS if key in top), "joints")
        raise _unassembled(top.table(section), str(error)) from None


def _unassembled(table: Table, reason: str) -> AssemblyError:
    error = AssemblyError(f"{table.where}: {table.path}: {reason}")
    error.keys = table.keys
    return error


def _length_unit(top: Table) -> str:
    return top.choice("length_unit", units.LENGTH_UNITS)


def _origin(top: Table) -> Pin:
    """Return the pin O2 that a shorthand starts from: the file's own, or the origin."""
    ground = top.table("ground")
    return read_pin("O2", ground) if "O2" in ground else Pin("O2", (0.0, 0.0))


def _pins(ground: Table, short: Expansion) -> list[Pin]:
    """Return the file's fixed pins, those given by coordinates first: so TOML writers order tables too."""
    names = [name for name in ground.names_given() if not (short.joints and name == "O2")]
    return [read_pin(name, ground) for name in sorted(names, key=lambda name: name in ground.subtables())]


def _joints(top: Table, short: Expansion) -> tuple[Joint, ...]:
    """Return all joints in solved order: the shorthand's and the file's."""
    pins = _pins(top.table("ground"), short)
    moving = [read_joint(name, table) for name, table in top.tables("joints")]
    if not (short.joints or moving):
        raise top.wrong(f"describes no linkage; give it [joints], or one of {', '.join(SHORTHANDS)}")
    joints: dict[str, Joint] = {joint.name: joint for joint in short.joints}
    for section, added in (("ground", pins), ("joints", moving)):
        for joint in added:
            if joint.name in joints:
                raise top.table(section).error(joint.name, "there is already a joint of that name")
            joints[joint.name] = joint
    for joint in moving:
        _check_needs(top, joint, joints)
    order = solved_order(joints)
    if len(order) < len(joints):
        chain = " -> ".join(circle(joints, joints.keys() - {joint.name for joint in order}))
        raise top.table("joints").wrong(f"{chain}: a joint cannot depend on itself; start from a crank")
    return order


def _check_needs(top: Table, joint: Joint, joints: Mapping[str, Joint]) -> None:
    """Refuse a joint found from one that is not there, from itself, or held by one that is not fixed."""
    table = top.table("joints").table(joint.name)
    for need in joint.needs:
        if need.joint not in joints:
            raise _at(table, need.key, _no_joint(need.joint, joints))
        if need.joint == joint.name:
            raise _at(table, need.key, "a joint cannot be found from itself")
    for need in joint.needs:
        if (reason := _unfit(need, joints)) is not None:
            raise _at(table, need.key, reason)
    if joint.moved_by and all(joints[need.joint].fixed for need in joint.moved_by):
        key, still, _ = joint.moved_by[0]
        reason = f"{still} is fixed, so nothing would move; name a joint that moves"
        raise _at(table, key, reason)


def _at(table: Table, way: str, reason: str) -> BadInput:
    """Return the error about what a joint is found from; `way` is the key in its table, as "gear.with"."""
    return table.at(f"{table.path}.{way}: {reason}", *way.split("."))


def _unfit(need: Need, joints: Mapping[str, Joint]) -> str | None:
    """Say why a joint cannot be what another one needs it to be; None where it can."""
    found = joints[need.joint]
    if need.must == "fixed" and not found.fixed:
        pins = ", ".join(joint.name for joint in joints.values() if joint.fixed)
        return f"{need.joint} moves; name a fixed pin ({pins})"
    if need.must == "crank" and not isinstance(found, Crank):
        return f"{need.joint} is not a crank"
    return None


def _no_joint(name: str, joints: Iterable[str]) -> str:
    return f"no joint is called {units.shown(name)}{meant(name, joints)}; there are {few(joints)}"


def _check_rigid(top: Table, joints: tuple[Joint, ...], rigid: tuple[Frame, ...]) -> None:
    """Refuse points that are not on one body, and bars on one body that do not meet."""
    for joint in joints:
        if joint.body:
            _check_body(top.table("joints").table(joint.name), joint.body, rigid)
        elif isinstance(joint, RRR) and (n := holding(rigid, joint.ends)) is not None:
            _check_brace(top.table("joints").table(joint.name), joint, rigid[n])


def _check_body(table: Table, names: tuple[str, ...], rigid: tuple[Frame, ...]) -> None:
    first, second, *others = names
    n = holding(rigid, names)
    if n is None:
        listed = f"{', '.join([first, second, *others][:-1])} and {names[-1]}"
        raise table.wrong(f"{listed} are not on one rigid body; name joints of one bar")
    if coincide(rigid[n], first, second):
        raise table.wrong(
            f"{first} and {second} are one point, so no direction leads from {first} to {second}"
        )


def _check_brace(table: Table, joint: RRR, frame: Frame) -> None:
    """Refuse a dyad between two joints of one body whose bars are too short or too long for it."""
    first, second = joint.ends
    a, b = joint.lengths
    distance = abs(frame[first] - frame[second])
    if coincide(frame, first, second) or not abs(a - b) <= distance <= a + b:
        raise _unassembled(
            table,
            f"the bars of {a:g} and {b:g} cannot meet: {first} and {second} are "
            f"{distance:g} apart on one rigid body, and {abs(a - b):g} to {a + b:g} would do",
        )


def _drive(top: Table, joints: tuple[Joint, ...], usual: str | None) -> Drive:
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
    return Drive(name, speed, start, _cylinder(cylinder, joints, name) if "cylinder" in table else None)


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
    return Drive(name, table.speed("speed", DEFAULT_SPEED), travel=Travel(first, last))


def _cylinder(table: Table, joints: tuple[Joint, ...], driven: str) -> Cylinder:
    """Read a cylinder between a fixed pin and a joint of the driven crank's body, named in either order."""
    known = {joint.name: joint for joint in joints}
    first, second = _members(table, "between", known, 2)
    fixed, moving = (first, second) if known[first].fixed else (second, first)
    crank = known[driven]
    assert isinstance(crank, Crank)
    if not known[fixed].fixed or fixed == crank.pivot:
        raise table.error("between", f"names no fixed pin beside {crank.pivot}; one end stands on the ground")
    carried = [frame for frame in frames_of(joints)[1:] if {crank.pivot, driven, moving} <= frame.keys()]
    if not carried or coincide(carried[0], crank.pivot, moving):
        raise table.error("between", f"{moving} is no joint of the body that turns with {driven}")
    start, end = table.length("from"), table.length("to")
    if start == end:
        raise table.error("to", "is the same length as from, so nothing would move")
    return Cylinder((fixed, moving), start, end)


def _bodies(
    top: Table, joints: tuple[Joint, ...], rigid: tuple[Frame, ...], usual: tuple[Body, ...]
) -> tuple[Body, ...]:
    """Return the shorthand's bodies and the file's; the file's takes the place of one of the same name."""
    found = {body.name: body for body in usual}
    known = {joint.name: joint for joint in joints}
    for name, table in top.tables("bodies"):
        found[name] = _block(name, table, known) if "slider" in table else _bar(name, table, known, rigid)
    return tuple(found.values())


def _block(name: str, table: Table, joints: Mapping[str, Joint]) -> Body:
    table.only("slider", "mass", "colour")
    slider = table.text("slider")
    if slider not in joints:
        raise table.error("slider", _no_joint(slider, joints))
    if not joints[slider].travels:
        raise table.error("slider", "does not travel on a line; name a joint that has one")
    return Body(name, slider=slider, mass=_mass(table), colour=_colour(table))


def _bar(name: str, table: Table, joints: Mapping[str, Joint], rigid: tuple[Frame, ...]) -> Body:
    table.only("joints", "com", "mass", "inertia", "look", "colour")
    members = _members(table, "joints", joints)
    if len(members) < 2:
        raise table.error("joints", "must name two joints or more; a body's angle is that of first -> second")
    n = holding(rigid, members)
    if n is None:
        raise table.error("joints", f"{', '.join(members)} are not joints of one rigid body")
    if coincide(rigid[n], members[0], members[1]):
        raise table.error(
            "joints", f"{members[0]} and {members[1]} are one point; name another first or second"
        )
    if "mass" in table and "com" not in table:
        half = abs(rigid[n][members[1]] - rigid[n][members[0]]) / 2
        halfway = f"com = [{half:g}, 0] is halfway from {members[0]} to {members[1]}"
        raise table.error("mass", f"needs to be known where it is; {halfway}")
    return Body(
        name,
        members,
        table.point("com") if "com" in table else None,
        mass=_mass(table),
        inertia=table.positive("inertia", units.inertia) if "inertia" in table else None,
        look=table.choice("look", LOOKS) if "look" in table else None,
        colour=_colour(table),
    )


def _colour(table: Table) -> tuple[int, int, int] | None:
    """Return a colour from "#rrggbb"; None where the table has none."""
    if "colour" not in table:
        return None
    value = table.text("colour")
    if not _HEX.fullmatch(value):
        raise table.error("colour", 'is no colour; write red, green and blue as in "#d55e00"')
    red, green, blue = bytes.fromhex(value[1:])
    return red, green, blue


def _mass(table: Table) -> float | None:
    return table.positive("mass", units.mass) if "mass" in table else None


def _gravity(top: Table, bodies: tuple[Body, ...]) -> float:
    """Return the scene's gravity in m/s², 0 where it states none; refused where it could pull at nothing."""
    if "gravity" not in top:
        return 0.0
    gravity = top.positive("gravity", units.acceleration)
    if all(body.mass is None for body in bodies):
        raise top.error("gravity", 'pulls at nothing; give a body its mass, such as mass = "3 kg"')
    return gravity


def _members(table: Table, key: str, joints: Iterable[str], count: int | None = None) -> tuple[str, ...]:
    """Return a list of names that are all joints."""
    members = table.names(key, count)
    for member in members:
        if member not in joints:
            raise table.error(key, _no_joint(member, joints))
    return members


def _spring(name: str, table: Table, joints: tuple[Joint, ...]) -> Spring:
    table.only("between", "stiffness", "free_length")
    start, end = _members(table, "between", [joint.name for joint in joints], 2)
    if ("stiffness" in table) != ("free_length" in table):
        raise table.wrong("a force needs both stiffness and free_length; give both, or neither")
    if "stiffness" not in table:
        return Spring(name, (start, end))
    stiffness = table.positive("stiffness", units.stiffness)
    return Spring(name, (start, end), stiffness, table.length("free_length"))


def _damper(name: str, table: Table, joints: tuple[Joint, ...]) -> Damper:
    table.only("between", "coefficient")
    start, end = _members(table, "between", [joint.name for joint in joints], 2)
    known = "coefficient" in table
    return Damper(name, (start, end), table.positive("coefficient", units.damping) if known else None)


def _trace(top: Table, joints: tuple[Joint, ...], usual: tuple[str, ...]) -> tuple[str, ...]:
    table = top.table("trace")
    table.only("joints")
    return _members(table, "joints", [joint.name for joint in joints]) if "joints" in table else usual
