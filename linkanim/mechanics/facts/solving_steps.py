"""In which step each joint is solved: the causal chain from the input to the output."""

from __future__ import annotations

from collections.abc import Mapping

from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.rigid_bodies import Rigid


def solving_steps(linkage: Linkage) -> Mapping[str, int]:
    """Return each joint's step: 0 on the ground, 1 the input's, then one more than what it is found from.

    A point of a body comes with the last of the joints that its body is known by; dyads that need nothing
    of each other share a step.
    """
    steps: dict[str, int] = {}
    for joint in linkage.joints:
        before = max((steps[name] for name in joint.needs), default=0)
        with_body = joint.fixed or isinstance(joint, Rigid)
        steps[joint.name] = before if with_body else before + 1
    return steps
