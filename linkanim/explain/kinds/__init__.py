"""How each kind of joint is worked out by hand: one file a kind of dyad, and the one list of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkanim.explain.chains import Route
from linkanim.explain.kinds import placed, rpp, rpr, rrp, rrr
from linkanim.explain.rates import Order, Rates
from linkanim.explain.work import Work
from linkanim.mechanics.linkage.dyads import RPP, RPR, RRP, RRR
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Pin
from linkanim.mechanics.linkage.rigid_bodies import Brace, Rigid


@dataclass(frozen=True, slots=True)
class KindSteps:
    """The steps of one kind of joint.

    `place` adds the lines of its position, `move` those of its rates of an order. `route` is the way to it
    from a joint before it, `loop` of a dyad the two ways that meet.
    """

    place: Callable[[Any, Work], None]
    move: Callable[[Any, Rates, Order], None]
    route: Callable[[Any, Work], Route] | None = None
    loop: Callable[[Any, Work], tuple[Route, Route]] | None = None


KINDS: Mapping[type[Joint], KindSteps] = {
    Pin: KindSteps(placed.place_pin, placed.rest),
    Crank: KindSteps(placed.place_crank, placed.move_crank, placed.route_of_crank),
    DrivenSlider: KindSteps(placed.place_slider, placed.move_slider, placed.route_of_slider),
    Rigid: KindSteps(placed.place_point, placed.move_point, placed.route_of_point),
    Brace: KindSteps(placed.place_point, placed.move_point, placed.route_of_point),
    RRR: KindSteps(rrr.place, rrr.move, rrr.route, rrr.loop),
    RRP: KindSteps(rrp.place, rrp.move, rrp.route, rrp.loop),
    RPR: KindSteps(rpr.place, rpr.move, rpr.route, rpr.loop),
    RPP: KindSteps(rpp.place, rpp.move, rpp.route, rpp.loop),
}
"""Every kind that a linkage can be made of."""
