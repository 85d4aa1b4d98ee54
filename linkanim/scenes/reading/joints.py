"""The joints of a file in the order in which they are solved, those with a fault left out."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from linkanim.errors import AssemblyError, BadInput
from linkanim.mechanics.linkage.dyads import RRR
from linkanim.mechanics.linkage.joint import Joint, RigidBody
from linkanim.mechanics.linkage.pins import Crank
from linkanim.mechanics.linkage.rigid_bodies import brace, coincide, holding, rigid_bodies
from linkanim.scenes.fields.form import Field, Key, fields_in
from linkanim.scenes.fields.joints import JOINTS
from linkanim.scenes.fields.table import Table

Stated = Mapping[str, Joint | None]
"""Joints by their names, None where one has a fault."""


def solved(top: Table, expanded: Stated, pins: Stated, moving: Stated) -> Table:
    """Return the file's table with its sound joints known, in solved order: a shorthand's and the file's.

    A joint that depends on one with a fault is left out, and not looked at any further.
    """
    stated = _together(top, expanded, pins, moving)
    for name in moving:
        joint = stated[name]
        stated[name] = joint and top.attempt(_with_fit_references, top, joint, stated)
    order = _solved_order(stated)
    if len(order) < len(stated):
        first, *others = _circle(stated, stated.keys() - set(order))
        chain = " -> ".join([first, *others[:12], *["..."] * (len(others) > 12)])
        reason = f"{chain}: a joint cannot depend on itself; start from a crank"
        top.context.problems.append(top.table("joints").wrong(reason))
    return _rigid(top, [stated[name] for name in order])


def _together(top: Table, expanded: Stated, pins: Stated, moving: Stated) -> dict[str, Joint | None]:
    """Return all joints, pins given by coordinates first: so TOML writers order tables too."""
    listed = sorted(pins, key=lambda name: isinstance(top.values["ground"][name], Mapping))
    stated = dict(expanded)
    own = {name: pins[name] for name in listed if not (name == "O2" and expanded)}
    for section, added in (("ground", own), ("joints", moving)):
        for name, joint in added.items():
            if name in stated:
                error = top.table(section).error(name, "there is already a joint of that name")
                top.context.problems.append(error)
            stated[name] = None if name in stated else joint
    return stated


def _with_fit_references(top: Table, joint: Joint, stated: Stated) -> Joint:
    """Return a joint, refused where those that it is found from are itself, or not what they must be."""
    table = top.table("joints").table(joint.name)
    found = dict[str, Joint | None]()
    moving: tuple[Key, str] | None = None
    for key, one, holder in fields_in(JOINTS.form(table.values), table.values):
        names = _references(one, holder)
        found |= {name: stated.get(name) for name in names}
        for name in names:
            if reason := _unfit(joint, name, "" if one.unless in holder else one.must, stated):
                raise _at(table, key, reason)
        if one.must == "moving":
            moving = key, names[0]
    if moving and all(other and other.fixed for other in found.values()):
        raise _at(table, moving[0], f"{moving[1]} is fixed, so nothing would move; name a joint that moves")
    return joint


def _references(one: Field, holder: Mapping[str, Any]) -> list[str]:
    """Return the joints that a field names."""
    value = holder[one.key] if one.plain and one.plain.refers else []
    return [value] if isinstance(value, str) else value


def _unfit(joint: Joint, name: str, must: str, stated: Stated) -> str | None:
    """Say why a joint cannot be what another one needs; None where it can, or has a fault itself."""
    found = stated.get(name)
    if name == joint.name:
        return "a joint cannot be found from itself"
    if must == "fixed" and found and not found.fixed:
        pins = ", ".join(other.name for other in stated.values() if other and other.fixed)
        return f"{name} moves; name a fixed pin ({pins})"
    if must == "crank" and found and not isinstance(found, Crank):
        return f"{name} is not a crank"
    return None


def _at(table: Table, key: Key, reason: str) -> BadInput:
    """Return the error about what a joint is found from, which stands at a key under its table."""
    steps = [str(step) for step in key]
    return table.at(f"{table.path}.{'.'.join(steps)}: {reason}", *steps)


def _needs(stated: Stated, name: str) -> list[str]:
    """Return the joints that one is found from; none of one that has a fault."""
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


def _circle(stated: Stated, stuck: set[str]) -> tuple[str, ...]:
    """Return a chain of joints that ends where it began, among the `stuck` ones (each needs a stuck one)."""
    name = min(stuck)
    path = [name]
    while True:
        name = next(need for need in _needs(stated, name) if need in stuck)
        if name in path:
            return (*path[path.index(name) :], name)
        path.append(name)


def _rigid(top: Table, joints: Iterable[Joint | None]) -> Table:
    """Return the file's table with its joints known, a dyad whose bars stand on one body as a point of it."""
    found: dict[str, Joint] = {}
    bodies = rigid_bodies(())
    for joint in joints:
        if joint is None or any(need not in found for need in joint.needs):
            continue
        placed = top.attempt(_on_one_body, top, joint, bodies)
        if placed is not None:
            found[joint.name] = placed
            bodies = placed.placed(bodies)
    return replace(top, context=replace(top.context, joints=found, rigid=bodies))


def _on_one_body(top: Table, joint: Joint, bodies: tuple[RigidBody, ...]) -> Joint:
    """Return a joint, refused where it is a point of no body, or its bars stand on one and do not meet."""
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
    """Return the error about lengths that do not go together."""
    error = AssemblyError(f"{table.where}: {table.path}: {reason}")
    error.keys = table.keys
    return error
