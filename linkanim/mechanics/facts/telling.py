"""Which of a linkage's quantities say most of it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkanim.mechanics.facts.effort import effort_token
from linkanim.mechanics.facts.register import Quantity, register
from linkanim.mechanics.linkage.linkage import Body, Damper, Linkage, Spring
from linkanim.mechanics.linkage.pins import Pin
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.mechanics.motion.derived import crank_body, output_body
from linkanim.mechanics.motion.measures import TURNING
from linkanim.mechanics.motion.motion import Motion

_LEAST, _MOST = 6, 10
_LEVEL = 1e-6
"""Of a quantity's greatest size; what changes less stands still."""


def telling(cycle: Motion, traced: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return the tokens of six to ten quantities that say most of a linkage, the most telling first.

    What it is there to move, the forces, how its links turn, the torque at its input, the first of the
    `traced` joints whose speed changes, how well it transmits; nothing that stands still over the cycle.
    """
    linkage = cycle.setting.linkage
    changing = {token for token, one in register(linkage).items() if _changes(one, cycle)}
    point = tuple(name for name in traced if f"{name}.velocity" in changing)[:1]
    wished = [token for token in _wished(linkage, point) if token in changing]
    rest = [token for token in register(linkage) if token in changing and token not in wished]
    rest.sort(key=lambda token: token.partition(".")[0] not in traced)
    return tuple(dict.fromkeys((*wished[:_MOST], *rest[: max(_LEAST - len(wished), 0)])))


def _changes(one: Quantity, cycle: Motion) -> bool:
    """Whether a quantity has more than one value, rounding errors aside."""
    values = np.asarray(one.read(cycle))
    found = values[np.isfinite(values)]
    return bool(found.size and np.ptp(found) > max(_LEVEL * np.abs(found).max(), 10 * one.rounding(cycle)))


def _wished(linkage: Linkage, traced: tuple[str, ...]) -> Iterator[str]:
    output = output_body(linkage)
    bodies = sorted(linkage.bodies, key=lambda body: body is not output)
    sliders = [body.name for body in bodies if body.slider is not None]
    for name in sliders:
        yield from (f"{name}.travel_velocity", f"{name}.travel_acceleration")
    struts: tuple[Spring | Damper, ...] = (*linkage.springs, *linkage.dampers)
    for strut in struts:
        yield f"{strut.name}.{'force' if strut.forceful else 'length'}"
    if output and not sliders:
        yield from (f"{output.name}.{measure.name}" for measure in TURNING)
    for body in _in_chain(linkage):
        if not crank_body(linkage, body) and not (output and not sliders and _rigid(linkage, body, output)):
            yield f"{body.name}.angular_velocity"
    yield effort_token(linkage)
    for name in traced:
        yield from (f"{name}.velocity", f"{name}.acceleration")
    yield from (f"{name}.travel" for name in sliders)
    yield from ("transmission_angle", "mechanical_advantage")


def _in_chain(linkage: Linkage) -> tuple[Body, ...]:
    """Return the bodies that turn, in the order in which the joints that move them are solved.

    Of those that cannot move against each other it is the first.
    """
    moving = [joint.name for joint in linkage.joints if not isinstance(joint, Pin)]
    bodies = {body.name: body for name in moving for body in linkage.bodies if name in body.joints}
    found: list[Body] = []
    for body in bodies.values():
        if not any(_rigid(linkage, body, other) for other in found):
            found.append(body)
    return tuple(found)


def _rigid(linkage: Linkage, body: Body, other: Body) -> bool:
    """Tell whether two bodies that turn cannot move against each other."""
    return holding(linkage.frames, body.joints) == holding(linkage.frames, other.joints)
