"""The document in a scene file to a checked `Scene`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim import units
from linkanim.errors import AssemblyError, BadInput
from linkanim.mechanics.linkage.dyads import RRR
from linkanim.mechanics.linkage.joint import Joint, Need, RigidBody
from linkanim.mechanics.linkage.linkage import Body, Damper, Linkage, Spring
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.linkage.rigid_bodies import brace, coincide, holding, rigid_bodies
from linkanim.scenes.reading.bodies import read_bodies
from linkanim.scenes.reading.check import Table, no_joint
from linkanim.scenes.reading.drive import read_drive
from linkanim.scenes.reading.joints import read_joint, read_pin
from linkanim.scenes.reading.order import circle, solved_order
from linkanim.scenes.reading.shorthand import SHORTHANDS, Expansion, expand
from linkanim.scenes.scene import Scene
from linkanim.scenes.sizes import refuse_apart

_TOP = (
    "title", "source", "chapter", "look_at", "notes", "length_unit",
    "gravity", "drive", "ground", "joints", "bodies", "springs", "dampers", "trace", *SHORTHANDS,
)  # fmt: skip


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
    joints = _rigid(top, _joints(top, short))
    rigid = rigid_bodies(joints)
    bodies = read_bodies(top, joints, rigid, short.bodies)
    linkage = Linkage(
        joints=joints,
        drive=read_drive(top, joints, short.drive),
        bodies=bodies,
        springs=tuple(_spring(name, table, joints) for name, table in top.tables("springs")),
        dampers=tuple(_damper(name, table, joints) for name, table in top.tables("dampers")),
        metre=units.metre(top.unit),
        gravity=_gravity(top, bodies),
    )
    refuse_apart(top, linkage)
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
        first, *others = circle(joints, joints.keys() - {joint.name for joint in order})
        chain = " -> ".join([first, *others[:12], *["..."] * (len(others) > 12)])
        raise top.table("joints").wrong(f"{chain}: a joint cannot depend on itself; start from a crank")
    return order


def _check_needs(top: Table, joint: Joint, joints: Mapping[str, Joint]) -> None:
    """Refuse a joint found from one that is not there, from itself, or held by one that is not fixed."""
    table = top.table("joints").table(joint.name)
    for need in joint.needs:
        if need.joint not in joints:
            raise _at(table, need.key, no_joint(need.joint, joints))
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


def _rigid(top: Table, joints: tuple[Joint, ...]) -> tuple[Joint, ...]:
    """Return the joints, a dyad whose bars stand on one body as a point of it.

    Refused are points that are not on one body, and bars on one body that do not meet.
    """
    found: list[Joint] = []
    frames = rigid_bodies(())
    for joint in joints:
        table = top.table("joints").table(joint.name) if joint.body or isinstance(joint, RRR) else top
        if joint.body:
            _check_body(table, joint.body, frames)
        elif isinstance(joint, RRR) and (n := holding(frames, joint.ends)) is not None:
            _check_brace(table, joint, frames[n])
            joint = brace(joint, frames[n])
        found.append(joint)
        frames = joint.placed(frames)
    return tuple(found)


def _check_body(table: Table, names: tuple[str, ...], rigid: tuple[RigidBody, ...]) -> None:
    first, second, *others = names
    n = holding(rigid, names)
    if n is None:
        listed = f"{', '.join([first, second, *others][:-1])} and {names[-1]}"
        raise table.wrong(f"{listed} are not on one rigid body; name joints of one bar")
    if coincide(rigid[n], first, second):
        raise table.wrong(
            f"{first} and {second} are one point, so no direction leads from {first} to {second}"
        )


def _check_brace(table: Table, joint: RRR, frame: RigidBody) -> None:
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


def _gravity(top: Table, bodies: tuple[Body, ...]) -> float:
    """Return the scene's gravity in m/s², 0 where it states none; refused where it could pull at nothing."""
    if "gravity" not in top:
        return 0.0
    gravity = top.positive("gravity", units.acceleration)
    if all(body.mass is None for body in bodies):
        raise top.error("gravity", 'pulls at nothing; give a body its mass, such as mass = "3 kg"')
    return gravity


def _spring(name: str, table: Table, joints: tuple[Joint, ...]) -> Spring:
    table.only("between", "stiffness", "free_length")
    start, end = table.members("between", [joint.name for joint in joints], 2)
    if ("stiffness" in table) != ("free_length" in table):
        raise table.wrong("a force needs both stiffness and free_length; give both, or neither")
    if "stiffness" not in table:
        return Spring(name, (start, end))
    stiffness = table.positive("stiffness", units.stiffness)
    return Spring(name, (start, end), stiffness, table.length("free_length"))


def _damper(name: str, table: Table, joints: tuple[Joint, ...]) -> Damper:
    table.only("between", "coefficient")
    start, end = table.members("between", [joint.name for joint in joints], 2)
    known = "coefficient" in table
    return Damper(name, (start, end), table.positive("coefficient", units.damping) if known else None)


def _trace(top: Table, joints: tuple[Joint, ...], usual: tuple[str, ...]) -> tuple[str, ...]:
    table = top.table("trace")
    table.only("joints")
    return table.members("joints", [joint.name for joint in joints]) if "joints" in table else usual
