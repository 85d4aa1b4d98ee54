"""How far apart the sizes in one scene may be: beyond that neither digits nor pixels show them together."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.scenes.fields.shorthands import SHORTHANDS
from linkanim.scenes.fields.table import Table

MOST_APART = 1e9
"""How many times as long as its shortest bar anything in a scene may be."""


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
        yield from ((abs(length), joint.name) for length in joint.lengths)
    for body in linkage.bodies:
        yield from ((abs(part), f"{body.name}'s centre of mass") for part in body.com or ())
    yield from ((abs(length), "the input's travel") for length in drive.actuator.lengths)
