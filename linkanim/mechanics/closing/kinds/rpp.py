"""A pin in the slot of a bar that slides on a line: the dyad of the Scotch yoke.

With f and e how far the pin lies forward along the line and to its left, and σ the slot's direction from
the line's, the slot crosses the line at s = f - e cot σ: linear, so the bar never jams and has one closure.
"""

from __future__ import annotations

from linkanim.mechanics.closing.walk import Assembly, Walk, guide
from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.formulas.planar import Moving
from linkanim.mechanics.formulas.precise import direction
from linkanim.mechanics.linkage.dyads import RPP


def close(joint: RPP, walk: Walk) -> None:
    """Add where the slot crosses the line: s = f - e cot σ, and its derivatives alike."""
    rail, point = guide(joint.line, walk), walk.points[joint.pin]
    cosine, sine = direction(joint.slot)
    forward, aside, lean = rail.forward(point), rail.aside(point), cosine / sine
    travel = Moving(
        forward.value - aside.value * lean,
        forward.rate - aside.rate * lean,
        forward.second - aside.second * lean,
    )
    walk.points[joint.name] = rail.place(travel)
    walk.travels[joint.name] = travel


def linkage_name(joint: RPP, assembly: Assembly) -> str:
    """Return Scotch yoke, or that its slot is not square to its line."""
    return "Scotch yoke" if unit(joint.slot)[0] == 0 else "Scotch yoke, oblique slot"
