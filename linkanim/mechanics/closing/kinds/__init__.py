"""How each kind of joint closes: one file a kind of dyad, and the one list of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkanim.mechanics.closing.kinds import placed, rpp, rpr, rrp, rrr
from linkanim.mechanics.closing.walk import Assembly, Walk
from linkanim.mechanics.linkage.dyads import RPP, RPR, RRP, RRR
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Pin
from linkanim.mechanics.linkage.rigid_bodies import Brace, Rigid
from linkanim.mechanics.loops.loop import Gearing, Loop


@dataclass(frozen=True, slots=True)
class Closer:
    """What solves one kind of joint.

    `close` adds the joint's motion, and its bars', to a walk. `loop` returns the loop that it closes from a
    crank pin and fixed elements, if it does. `name` returns the class of a linkage whose only dyad it is.
    """

    close: Callable[[Any, Walk], None]
    loop: Callable[[Any, Linkage, Mapping[str, Gearing]], Loop | None] = lambda *_: None
    name: Callable[[Any, Assembly], str | None] = lambda *_: None


CLOSERS: Mapping[type[Joint], Closer] = {
    Pin: Closer(placed.place_pin),
    Crank: Closer(placed.place_crank),
    DrivenSlider: Closer(placed.place_slider),
    Rigid: Closer(placed.place_point),
    Brace: Closer(placed.place_point),
    RRR: Closer(rrr.close, rrr.loop),
    RRP: Closer(rrp.close, rrp.loop, rrp.linkage_name),
    RPR: Closer(rpr.close, rpr.loop, rpr.linkage_name),
    RPP: Closer(rpp.close, name=rpp.linkage_name),
}
"""Every kind that a linkage can be made of."""
