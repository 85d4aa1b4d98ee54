"""The bodies: which joints are on them, what they weigh and how they are drawn."""

from __future__ import annotations

import re
from collections.abc import Mapping

from linkanim import units
from linkanim.mechanics.linkage.joint import Joint, RigidBody
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.rigid_bodies import coincide, holding
from linkanim.scenes.reading.check import Table, no_joint
from linkanim.scenes.reading.joints import LOOKS

_HEX = re.compile(r"#[0-9a-f]{6}", re.I | re.A)


def read_bodies(
    top: Table, joints: tuple[Joint, ...], rigid: tuple[RigidBody, ...], usual: tuple[Body, ...]
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
        raise table.error("slider", no_joint(slider, joints))
    if not joints[slider].travels:
        raise table.error("slider", "does not travel on a line; name a joint that has one")
    return Body(name, slider=slider, mass=_mass(table), colour=_colour(table))


def _bar(name: str, table: Table, joints: Mapping[str, Joint], rigid: tuple[RigidBody, ...]) -> Body:
    table.only("joints", "com", "mass", "inertia", "look", "colour")
    members = table.members("joints", joints)
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
