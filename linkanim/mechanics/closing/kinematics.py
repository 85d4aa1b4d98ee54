"""The motion of every joint, body and centre of mass, with first and second derivatives, from one walk."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from linkanim.mechanics.closing.chain import Closing
from linkanim.mechanics.closing.kinds import CLOSERS
from linkanim.mechanics.closing.walk import Assembly, Walk
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope
from linkanim.mechanics.loops.input_state import InputState


@dataclass(frozen=True)
class Kinematics:
    """What the walk finds; positions in the scene's unit."""

    points: Mapping[str, MovingPoint]
    centres: Mapping[str, MovingPoint]
    bodies: Mapping[str, Slope]
    travels: Mapping[str, Moving]
    closings: Mapping[str, Closing]
    """What closes each dyad on moving points: L², or how far its end lies from its line, U and W."""


def walked(assembly: Assembly, state: InputState) -> Kinematics:
    """Return the motion of everything in the linkage at the state's instant."""
    walk = Walk(assembly, state)
    for joint in assembly.linkage.joints:
        CLOSERS[type(joint)].close(joint, walk)
    bodies = assembly.linkage.bodies
    turning = [body for body in bodies if body.slider is None]
    return Kinematics(
        walk.points,
        {
            body.name: walk.attached((body.joints[0], body.joints[1]), body.com)
            for body in turning
            if body.com is not None
        },
        {body.name: walk.turning_of(body.joints, f"body {body.name}") for body in turning},
        {body.name: walk.travels[body.slider] for body in bodies if body.slider is not None},
        walk.closings,
    )


def walk_at(assembly: Assembly, phase: Value, pace: Slope) -> Kinematics:
    """Return the motion of everything at a phase that runs at `pace`: floats, or symbolic expressions."""
    return walked(assembly, assembly.path.state(phase, pace))
