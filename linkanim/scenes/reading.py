"""Read the document in a scene file to a checked `Scene`, or to all that is wrong with it.

Its parts, in reading order:

- How much sizes in one scene may differ: beyond that neither digits nor pixels show them together.
- The joints of a file in the order in which they are solved, those with a fault left out.
- Places by length and angle, and closures by a place that is near, in their usual form.
- From the document in a scene file to a checked `Scene`, or to all that is wrong with it.
- Every problem of a scene file at once, each with its line.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import hypot, pi
from typing import Any, NamedTuple

from linkanim import units
from linkanim.bounds import MOST_PROBLEMS
from linkanim.errors import AssemblyError, BadInput, DyadAtLimit, EndsError
from linkanim.mechanics.angles import unit
from linkanim.mechanics.linkage import (
    RRP,
    RRR,
    Body,
    Crank,
    Gear,
    Joint,
    Linkage,
    Load,
    Pin,
    Rigid,
    RigidBody,
    brace,
    coincide,
    holding,
    rigid_bodies,
)
from linkanim.scenes.file_form import (
    GROUND,
    INPUT,
    JOINTS,
    POSE_KEYS,
    PURPOSES,
    SCENE_FILE,
    SECTIONS,
    SHORTHANDS,
    Expansion,
    motor_ratio,
    names_of,
    read_drive,
    refuse_misplaced,
)
from linkanim.scenes.form import POINT, Context, Field, Key, Table, fields_in
from linkanim.scenes.scene import FREE_STYLE, Scene
from linkanim.scenes.toml import Keys, line_numbers, parse

# How much sizes in one scene may differ: beyond that neither digits nor pixels show them together.

MOST_APART = 1e9
"""The greatest size of anything in a scene, in lengths of its shortest bar."""


def refuse_apart(top: Table, linkage: Linkage) -> Linkage:
    """Return the linkage, refused where anything in it is too long beside its shortest bar."""
    bars = [(size, joint.name) for joint in linkage.joints for size in _bars(joint)]
    shortest, name = min(bars, default=(1.0, ""))
    longest, what = max(_sizes(linkage))
    if longest > MOST_APART * shortest:
        joints = top.table("joints")
        short = next((key for key in SHORTHANDS if key in top), "ground")
        raise (joints.table(name) if name in joints else top.table(short)).wrong(
            f"a bar of {shortest:g} {linkage.unit} is too short beside the {longest:g} {linkage.unit} "
            f"of {what}; nothing may be more than {MOST_APART:g} times as long as the shortest bar"
        )
    return linkage


def _bars(joint: Joint) -> Iterator[float]:
    yield from (length for _, length in joint.bars)
    if isinstance(joint, Rigid):
        yield hypot(*joint.at)


def _sizes(linkage: Linkage) -> Iterator[tuple[float, str]]:
    drive = linkage.drive
    for joint in linkage.joints:
        yield from ((abs(length), joint.name) for length in joint.stated_lengths)
    for body in linkage.bodies:
        yield from ((abs(part), f"{body.name}'s centre of mass") for part in body.com or ())
    yield from ((abs(length), "the input's travel") for length in drive.actuator.stated_lengths)


# The joints of a file in the order in which they are solved, those with a fault left out.

Stated = Mapping[str, Joint | None]
"""Joints by their names, None where one has a fault."""


def solved(top: Table, expanded: Stated, pins: Stated, moving: Stated, group: Sequence[str] = ()) -> Table:
    """Return the file's table with its sound joints known, in solved order: a shorthand's and the file's.

    A joint that depends on a joint with a fault is left out, and not checked further. Joints of a `group`
    stand together.
    """
    stated = _together(top, expanded, pins, moving)
    for name in moving:
        joint = stated[name]
        stated[name] = joint and top.attempt(_with_fit_references, top, joint, stated)
    order = _solved_order(stated)
    if group:
        order = _with_group_together(stated, order, group)
    if len(order) < len(stated):
        first, *others = _circle(stated, stated.keys() - set(order))
        chain = " -> ".join([first, *others[:12], *["..."] * (len(others) > 12)])
        reason = f"{chain}: a joint cannot depend on itself; start from a crank"
        top.context.problems.append(top.table("joints").wrong(reason))
    return _rigid(top, [stated[name] for name in order])


def _together(top: Table, expanded: Stated, pins: Stated, moving: Stated) -> dict[str, Joint | None]:
    """Return all joints, pins given by coordinates first, as TOML writers order tables."""
    listed = sorted(pins, key=lambda name: isinstance(top.values["ground"][name], Mapping))
    stated = dict(expanded)
    own = {name: pins[name] for name in listed if not (name == "O2" and name in expanded)}
    for section, added in (("ground", own), ("joints", moving)):
        for name, joint in added.items():
            if name in stated:
                error = top.table(section).error(name, "there is already a joint of that name")
                top.context.problems.append(error)
            stated[name] = None if name in stated else joint
    return stated


def _with_fit_references(top: Table, joint: Joint, stated: Stated) -> Joint:
    """Return a joint; BadInput where it is found from itself, or from joints that do not fit."""
    table = top.table("joints").table(joint.name)
    joints = dict[str, Joint | None]()
    moving: tuple[Key, str] | None = None
    for key, one, holder in fields_in(JOINTS.form(table.values), table.values):
        names = _references(one, holder)
        joints |= {name: stated.get(name) for name in names}
        for name in names:
            if reason := _unfit(joint, name, "" if one.unless in holder else one.must, stated):
                raise _at(table, key, reason)
        if one.must == "moving":
            moving = key, names[0]
    if moving and all(other and other.fixed for other in joints.values()):
        raise _at(table, moving[0], f"{moving[1]} is fixed, so nothing would move; name a joint that moves")
    return joint


def _references(one: Field, holder: Mapping[str, Any]) -> list[str]:
    """Return the joints that a field names."""
    value = holder[one.key] if one.plain and one.plain.refers else []
    return [value] if isinstance(value, str) else value


def _unfit(joint: Joint, name: str, must: str, stated: Stated) -> str | None:
    """Say why a joint cannot be what another one needs; None where it can, or has a fault itself."""
    kind = stated.get(name)
    if name == joint.name:
        return "a joint cannot be found from itself"
    if must == "fixed" and kind and not kind.fixed:
        pins = ", ".join(other.name for other in stated.values() if other and other.fixed)
        return f"{name} moves; name a fixed pin ({pins})"
    if must == "crank" and kind and not isinstance(kind, Crank):
        return f"{name} is not a crank"
    return None


def _at(table: Table, key: Key, reason: str) -> BadInput:
    """Return the error about a joint that another one is found from; `key` leads to it in the table."""
    steps = [str(step) for step in key]
    return table.at(f"{table.path}.{'.'.join(steps)}: {reason}", *steps)


def _needs(stated: Stated, name: str) -> list[str]:
    """Return the joints that a joint is found from; none for a joint that has a fault."""
    joint = stated[name]
    return [need for need in joint.needs if need in stated] if joint else []


def _solved_order(stated: Stated) -> list[str]:
    """Return the joints so that each names only joints before it, otherwise as they stood.

    Those that depend on themselves are left out.
    """
    waiting = {name: set(_needs(stated, name)) for name in stated}
    order: dict[str, None] = {}
    while ready := next((name for name, needs in waiting.items() if needs <= order.keys()), None):
        order[ready] = None
        del waiting[ready]
    return list(order)


def _with_group_together(stated: Stated, order: list[str], group: Sequence[str]) -> list[str]:
    """Return the order with the joints of a group one after the other, and then what hangs on them."""
    group = [name for name in group if name in order]
    behind = {*group}
    for name in order:
        if (joint := stated[name]) and not joint.grouped and behind & {*joint.needs}:
            behind.add(name)
    before = [name for name in order if name not in behind]
    return [*before, *group, *(name for name in order if name in behind and name not in group)]


def _circle(stated: Stated, stuck: set[str]) -> tuple[str, ...]:
    """Return a chain of joints that ends where it began, among `stuck` ones, each of which needs another."""
    name = min(stuck)
    path = [name]
    while True:
        name = next(need for need in _needs(stated, name) if need in stuck)
        if name in path:
            return (*path[path.index(name) :], name)
        path.append(name)


def _rigid(top: Table, joints: Iterable[Joint | None]) -> Table:
    """Return the file's table with its joints known; a dyad between joints of one body becomes its point."""
    placed_joints: dict[str, Joint] = {}
    bodies = rigid_bodies(())
    for joint in joints:
        if joint is None or any(need not in placed_joints for need in joint.needs):
            continue
        placed = top.attempt(_on_one_body, top, joint, bodies)
        if placed is not None:
            placed_joints[joint.name] = placed
            bodies = placed.placed(bodies)
    return replace(top, context=replace(top.context, joints=placed_joints, rigid=bodies))


def _on_one_body(top: Table, joint: Joint, bodies: tuple[RigidBody, ...]) -> Joint:
    """Return a joint; refuse a point of no body, and a dyad on one body whose bars do not meet."""
    if joint.body:
        _refuse_apart(top.table("joints").table(joint.name), joint.body, bodies)
    elif isinstance(joint, RRR) and (n := holding(bodies, joint.ends)) is not None:
        _refuse_loose(top.table("joints").table(joint.name), joint, bodies[n])
        return brace(joint, bodies[n])
    return joint


def _refuse_apart(table: Table, names: tuple[str, ...], bodies: tuple[RigidBody, ...]) -> None:
    first, second, *_ = names
    n = holding(bodies, names)
    if n is None:
        listed = f"{', '.join(names[:-1])} and {names[-1]}"
        raise table.wrong(f"{listed} are not on one rigid body; name joints of one bar")
    if coincide(bodies[n], first, second):
        raise table.wrong(
            f"{first} and {second} are one point, so no direction leads from {first} to {second}"
        )


def _refuse_loose(table: Table, joint: RRR, frame: RigidBody) -> None:
    """Refuse a dyad between two joints of one body whose bars are too short or too long for it."""
    first, second = joint.ends
    (a, b), unit = joint.lengths, table.context.unit
    distance = abs(frame[first] - frame[second])
    if coincide(frame, first, second) or not abs(a - b) <= distance <= a + b:
        raise unassembled(
            table,
            f"the bars of {a:g} and {b:g} {unit} cannot meet: {first} and {second} are "
            f"{distance:g} {unit} apart on one rigid body, and {abs(a - b):g} to {a + b:g} {unit} would do",
        )


def unassembled(table: Table, reason: str) -> AssemblyError:
    """Return the error about lengths that cannot be assembled."""
    error = AssemblyError(f"{table.where}: {table.path}: {reason}")
    error.keys = table.keys
    return error


# From the document in a scene file to a checked `Scene`, or to all that is wrong with it.

Check = Callable[[Scene], None]
"""Raises where it refuses a scene that is complete but not yet put together."""


def scene_from(
    document: Mapping[str, Any],
    *,
    name: str,
    where: str,
    goal: Scene | None = None,
    check: Check | None = None,
) -> Scene:
    """Return the scene that a document describes, put together.

    `where` names the file in errors. Lengths are in the document's `length_unit` (mm if it has none), angles
    in radians; joints stand in the order in which they can be solved. SceneError for anything unknown,
    missing or contradictory; AssemblyError for lengths that cannot be assembled. `goal` is the scene to
    which this one is on its way, where it is shown for an instant only; `check` may refuse it before it is
    put together.
    """
    scene, problems = read(document, name=name, where=where, goal=goal, check=check)
    if scene is None or problems:
        raise problems[0]
    return scene


def taken_together(scene: Scene) -> Scene:
    """Return a scene with a group with all its links but the crank in that, not put together."""
    found, _ = read(scene.document, name=scene.name, where=scene.name, together=True)
    assert found
    return found


def read(
    document: Mapping[str, Any],
    *,
    name: str,
    where: str,
    goal: Scene | None = None,
    check: Check | None = None,
    group: tuple[Joint, ...] = (),
    together: bool = False,
) -> tuple[Scene | None, list[BadInput]]:
    """Return the scene that a document describes, None where it describes none, and all its problems.

    `group` are joints that no table says. Of points and links that are no chain of dyads all are solved
    `together` where dyads before or behind the group come to their limits; or where that is asked for: then
    the scene is not put together.

    Problems that only follow from others are left out: of things that depend on a joint with a fault only
    their own table is checked, and the assembly is checked only where every joint is sound.
    """
    top = _opened(document, where, group)
    if any(key in top for key in POSE_KEYS):
        return _read_points(top, name=name, goal=goal, check=check, together=together)
    top, short = _with_joints(top, group)
    top = top.attempt(_with_motors, top, short) or top
    top = top.attempt(_in_usual_form, top, short) or top
    document = top.values
    bodies = _part(top, "bodies") or {}
    parts = {
        "linkage": _linkage(top, short, {name: one and one[0] for name, one in bodies.items()}),
        "title": _part(top, "title") if "title" in top else name,
        **{key: _part(top, key) for key in ("source", "chapter", "look_at", "notes")},
        "trace": _trace(top, short),
    }
    if "photo" in top:
        _part(top, "photo")
    purposes = [key for key in PURPOSES if key in top]
    if len(purposes) > 1:
        reason = (
            f"was made for one thing, not for [{purposes[0]}] and [{purposes[1]}]; keep one of the tables"
        )
        top.context.problems.append(top.wrong(reason))
    purpose = _part(top, purposes[0]) if purposes else None
    if any(part is None for part in parts.values()):
        return None, top.context.problems
    styles = tuple((name, one[1]) for name, one in bodies.items() if one and one[1] != FREE_STYLE)
    parts |= {"purpose": purpose, "styles": styles, "document": document, "goal": goal}
    scene = Scene(name=name, length_unit=top.context.unit, **parts)
    if not together:
        top.attempt(_check_assembly, top, scene, check)
    return scene, top.context.problems


# Places by length and angle, and closures by a place that is near, are written as all others from here on.


def _in_usual_form(top: Table, short: Expansion) -> Table:
    """Return the file's table with its joints' places on bodies and closures in their usual form."""
    tables = top.table("joints")
    for name, joint in top.context.joints.items() if top.context.sound else ():
        table = tables.values.get(name, {})
        if isinstance(joint, Rigid) and isinstance(table.get("at"), Mapping):
            top = _restated(top, joint, {**table, "at": [*joint.at]})
        if isinstance(joint, RRR | RRP) and "near" in table:
            joint = replace(joint, side=_nearer_side(top, joint, short))
            side = joint.sides[joint.side < 0]
            top = _restated(top, joint, {**{k: v for k, v in table.items() if k != "near"}, "side": side})
    return top


def _restated(top: Table, joint: Joint, table: Mapping[str, Any]) -> Table:
    """Return the file's table with another table of a joint."""
    joints = {**top.values["joints"], joint.name: table}
    context = replace(top.context, joints={**top.context.joints, joint.name: joint})
    return replace(top, values={**top.values, "joints": joints}, context=context)


def _nearer_side(top: Table, joint: RRR | RRP, short: Expansion) -> int:
    """Return the side of the closure of a joint that is nearer to the place in its table, at the start."""
    from linkanim.mechanics.motion import mechanism

    table = top.table("joints").table(joint.name)
    drive = read_drive(top, short.drive)
    names = list(top.context.joints)
    before = [top.context.joints[name] for name in names[: names.index(joint.name) + 1]]
    if drive is None or drive.joint not in {one.name for one in before}:
        raise table.error("near", "is no place of a joint that the input moves; say the side instead")
    moving = mechanism(Linkage(tuple(before), drive))
    if drive.coordinate.is_angle and not drive.actuator.stated_lengths:
        position = moving.solve(angle=drive.start, speed=1.0, derivatives=0).position
    else:
        position = moving.solve(phase=pi / 2, speed=1.0, derivatives=0).position
    at = {name: complex(*place) for name, place in position.items()}
    here, near = at[joint.name], complex(*POINT.read(table, "near"))
    if here != here:
        raise table.error(
            "near", "cannot be compared: the input does not come to its start; give another start"
        )
    if isinstance(joint, RRR):
        p, q = (at[end] for end in joint.ends)
        there = p + (q - p) * ((here - p) / (q - p)).conjugate()
    else:
        axis = at[joint.line.on[1]] - at[joint.line.on[0]] if joint.line.on else 1 + 0j
        along = axis / abs(axis) * complex(*unit(joint.line.angle))
        there = here - 2 * ((here - at[joint.end]) * along.conjugate()).real * along
    one, other = abs(here - near), abs(there - near)
    if abs(one - other) <= 1e-9 * (one + other):
        raise table.error("near", "is as near to one closure as to the other; give a place beside it")
    return joint.side if one < other else -joint.side


def _read_points(
    top: Table, *, name: str, goal: Scene | None, check: Check | None, together: bool
) -> tuple[Scene | None, list[BadInput]]:
    """Return the scene of a file with points and links, as `read` does."""
    problems = top.context.problems
    if "points" not in top:
        key = next(key for key in POSE_KEYS if key in top)
        problems.append(top.error(key, "goes with [points]; say where the joints stand in one pose"))
        return None, problems
    for key in ("joints", GROUND, *SHORTHANDS):
        if key in top:
            way_out = "list the fixed points in links.ground" if key == GROUND else "keep one of them"
            problems.append(top.error(key, f"does not go with [points]; {way_out}"))
    from linkanim.scenes.links import as_joints

    for whole in (True,) if together else (False, True):
        as_joints_document = None if problems else as_joints(top, whole=whole)
        if as_joints_document is None:
            return None, problems
        document, group = as_joints_document
        scene, further = read(
            document, name=name, where=top.where, goal=goal, check=check, group=group, together=together
        )
        if not any(isinstance(error, DyadAtLimit) for error in further):
            break
    if scene and group:
        scene = replace(scene, document=top.values)
    return scene, [*problems, *(_of_points(error, top) for error in further)]


def _of_points(error: BadInput, top: Table) -> BadInput:
    """Return an error about a joint as one about what it came from: a point, the links, the driven length."""
    section, *rest = error.keys or ("",)
    if error.keys[:2] == ("drive", "slider"):
        written = ("drive", "cylinder") if "cylinder" in top.table("drive") else ("drive",)
        joint, own, keys = "drive.slider", ".".join(written), (*written, *rest[1:])
    elif section in ("joints", GROUND):
        joint, own = section, "points" if rest else "links"
        keys = (own, *rest[:1])
    else:
        return error
    told = type(error)(str(error).replace(f"{top.where}: {joint}", f"{top.where}: {own}", 1))
    told.keys = keys
    return told


def _part(top: Table, key: str) -> Any:
    """Return the value of one of the file's tables or keys; None where it has a fault."""
    return top.attempt(SECTIONS[key].read, top)


def _with_motors(top: Table, short: Expansion) -> Table:
    """Return the file's table with further motors on their cranks: each turns so many times as fast."""
    further = _part(top, "drives") or {}
    drive = INPUT.read(top) if further else None
    if not further or drive is None or None in further.values() or not top.context.sound:
        return top
    joints = dict(top.context.joints)
    own = {motor["joint"] for motor in further.values()}
    cranks = (joint.name for joint in joints.values() if isinstance(joint, Crank) and joint.gear is None)
    first = drive.get("joint", short.drive or next((name for name in cranks if name not in own), ""))
    for name, motor in further.items():
        table, crank = top.table("drives").table(name), joints.get(motor["joint"])
        if not isinstance(crank, Crank) or crank.gear or crank.name == first or first not in joints:
            raise table.error("joint", "is no crank that is left to be driven; name another one")
        ratio = motor_ratio(table, motor["speed"], drive["speed"])
        offset = motor.get("start", 0.0) - float(ratio) * drive["start"]
        joints[crank.name] = replace(crank, gear=Gear(first, ratio, offset, motor=True))
    fixed = {name: joint for name, joint in joints.items() if joint.fixed}
    context = replace(top.context, joints={**fixed, first: joints[first], **joints})
    return replace(top, context=context)


def _opened(document: Mapping[str, Any], where: str, group: tuple[Joint, ...] = ()) -> Table:
    """Return the file's table with its unit and its joints' names known; add unknown keys to the problems."""
    top = Table(where, document)
    unit = _part(top, "length_unit") or "mm"
    top.refuse_unknown(SCENE_FILE.keys)
    sections = (document.get(key) for key in ("ground", "joints", "points"))
    names = [*_shorthand_names(top), *(name for section in sections for name in _names(section))]
    names += [point.name for point in group]
    context = Context(unit, tuple(dict.fromkeys(names)), problems=top.context.problems)
    return replace(top, context=context)


def _names(section: object) -> list[str]:
    return list(section) if isinstance(section, Mapping) else []


def _shorthand_names(top: Table) -> list[str]:
    """Return the names of the joints that a shorthand states; all possible ones where it is no table."""
    stated = {key: top.values[key] for key in SHORTHANDS if key in top}
    tables = (
        (key, table if isinstance(table, Mapping) else SHORTHANDS[key].keys) for key, table in stated.items()
    )
    return [name for key, table in tables for name in names_of(key, table)]


def _with_joints(top: Table, group: tuple[Joint, ...]) -> tuple[Table, Expansion]:
    """Return the file's table with its sound joints and a group's known, and its shorthand's meaning."""
    pins = _part(top, "ground") or {}
    short = top.attempt(_expansion, top, pins.get("O2", Pin("O2", (0.0, 0.0))))
    moving = _part(top, "joints") or {}
    if not (any(key in top for key in SHORTHANDS) or "joints" in top):
        ways = f"[joints], [points] and [links], or one of {', '.join(SHORTHANDS)}"
        reason = f"describes no linkage; give it {ways}"
        top.context.problems.append(top.wrong(reason))
    expanded: dict[str, Joint | None] = dict.fromkeys(_shorthand_names(top))
    if short:
        expanded = {joint.name: joint for joint in short.joints}
    expanded |= {point.name: point for point in group}
    known = solved(top, expanded, pins, moving, [point.name for point in group])
    return known, short or Expansion()


def _expansion(top: Table, o2: Pin | None) -> Expansion | None:
    """Return the meaning of the file's shorthand, about its first pin; an empty one without a shorthand."""
    named = [key for key in SHORTHANDS if key in top]
    if len(named) > 1:
        raise top.wrong(f"has both [{named[0]}] and [{named[1]}]; keep one, write the other as [joints]")
    if not named:
        return Expansion()
    expansion: Expansion | None = SHORTHANDS[named[0]].made(top.table(named[0]), o2 or Pin("O2", (0.0, 0.0)))
    return expansion if o2 else None


def _linkage(top: Table, short: Expansion, stated: Mapping[str, Any]) -> Linkage | None:
    """Return the linkage; None where any part of it has a fault."""
    context = top.context
    bodies: dict[str, Any] = {body.name: body for body in short.bodies} | dict(stated)
    drive = top.attempt(read_drive, top, short.drive)
    springs, dampers = _part(top, "springs") or {}, _part(top, "dampers") or {}
    loads = _loads(top, bodies)
    gravity = top.attempt(_gravity, top, bodies)
    parts = (*bodies.values(), *springs.values(), *dampers.values(), *loads)
    if not context.sound or drive is None or gravity is None or None in parts:
        return None
    linkage = Linkage(
        joints=tuple(context.joints.values()),
        drive=drive,
        bodies=tuple(bodies.values()),
        springs=tuple(springs.values()),
        dampers=tuple(dampers.values()),
        metre=units.metre(context.unit),
        gravity=gravity,
        loads=tuple(load for load in loads if load),
    )
    return top.attempt(refuse_apart, top, linkage)


def _loads(top: Table, bodies: Mapping[str, Body | None]) -> list[Load | None]:
    """Return the loads; None for each with a fault, or on a body or among joints with one."""
    stated: Mapping[str, Load | None] = _part(top, "loads") or {}
    sound = {name: body for name, body in bodies.items() if body}
    known = top.context.sound and len(sound) == len(bodies)
    loads = top.table("loads") if stated else top
    return [
        load and top.attempt(refuse_misplaced, loads, load, sound, top.context.rigid) if known else None
        for load in stated.values()
    ]


def _gravity(top: Table, bodies: Mapping[str, Body | None]) -> float | None:
    """Return the scene's gravity in m/s², 0 where it states none; refuse it where nothing has a mass."""
    if "gravity" not in top:
        return 0.0
    gravity: float | None = SECTIONS["gravity"].read(top)
    if all(body and body.mass is None for body in bodies.values()):
        raise top.error("gravity", 'pulls at nothing; give a body its mass, such as mass = "3 kg"')
    return gravity


def _trace(top: Table, short: Expansion) -> tuple[str, ...] | None:
    trace: Mapping[str, tuple[str, ...]] | None = _part(top, "trace")
    return None if trace is None else trace.get("joints", short.trace)


def _check_assembly(top: Table, scene: Scene, check: Check | None) -> None:
    """Refuse lengths that cannot be assembled, naming their file and table."""
    try:
        if check:
            check(scene)
        _ = scene.mechanism
    except DyadAtLimit:
        raise
    except EndsError as error:
        drive = top.table("drive")
        ends = next((key for key in ("cylinder", "slider") if key in drive), None)
        raise unassembled(drive.table(ends) if ends else drive, str(error)) from None
    except AssemblyError as error:
        section = next((key for key in SHORTHANDS if key in top), "joints")
        raise unassembled(top.table(section), str(error)) from None


# Every problem of a scene file at once, each with its line.

_AT_LINE = r"\(at line (\d+), column \d+\)|\(line (\d+)\)"
_ITEM = r"(.+?)(?:\[\d+\])+"


class Problem(NamedTuple):
    """What is wrong, in words, and its line, if there is one."""

    message: str
    line: int | None = None


def problems(text: str, *, name: str, where: str) -> list[Problem]:
    """Return every problem of a scene file's text in the order of the lines, 100 at the most."""
    try:
        document = parse(text, where)
    except BadInput as error:
        return [_unparsed(error, text)]
    _, errors = read(document, name=name, where=where)
    lines = line_numbers(text) if errors else {}
    problems_of = dict.fromkeys(Problem(str(error), _line(lines, error.keys)) for error in errors)
    return sorted(problems_of, key=lambda problem: problem.line or 0)[:MOST_PROBLEMS]


def _unparsed(error: BadInput, text: str) -> Problem:
    if error.keys:
        return Problem(str(error), _line(line_numbers(text), error.keys))
    at = re.search(_AT_LINE, str(error))
    return Problem(str(error), int(at[1] or at[2]) if at else None)


def _line(lines: dict[Keys, int], keys: Keys) -> int | None:
    """Return the line of a key, or of the nearest table around it."""
    items = [(key, re.fullmatch(_ITEM, key)) for key in keys]
    plain = tuple(item[1] if item else key for key, item in items)
    return next((lines[plain[:n]] for n in range(len(plain), 0, -1) if plain[:n] in lines), None)
