"""Joints that are put in place without closing anything: pins, cranks, a driven slider, points of bodies."""

from __future__ import annotations

from functools import partial

from linkanim.mechanics.closing.walk import Walk, guide
from linkanim.mechanics.formulas.circular import half_angle
from linkanim.mechanics.formulas.planar import MovingPoint, Vec, carried
from linkanim.mechanics.linkage.pins import Crank, DrivenSlider, Pin
from linkanim.mechanics.linkage.rigid_bodies import Rigid
from linkanim.mechanics.loops.input_state import TravelState
from linkanim.mechanics.loops.loop import own_loop


def place_pin(pin: Pin, walk: Walk) -> None:
    """Put the pin where it stands."""
    walk.points[pin.name] = MovingPoint(walk.place_of(pin))


def place_crank(crank: Crank, walk: Walk) -> None:
    """Add r e^{iψ}, ψ = ratio × θ + offset, as r (cos² - sin²) and 2r sin cos of ψ/2.

    The difference is right to 2.3 eps of r, where r - 2r sin² is to 3.6: that is taken where a loop
    against a fixed pin needs 2r sin² anyway.
    """
    gearing = walk.assembly.gears[crank.name]
    loop = own_loop(crank.name, walk.assembly.loops)
    form = loop.form if loop else partial(half_angle, size=2.0 * crank.length)
    half = walk.state.half(-gearing.offset, gearing.ratio, form=form)
    squares = half.squares(2.0 * crank.length)
    spans = loop is not None and loop.ground is not None
    along = crank.length - squares.sine if spans else (squares.cosine - squares.sine) * 0.5
    arm = Vec(along, squares.product)
    pace = walk.pace(gearing)
    walk.points[crank.name] = walk.points[crank.pivot] + carried(arm, pace)
    walk.add_piece(pace, (crank.pivot, crank.name), arm)


def place_slider(slider: DrivenSlider, walk: Walk) -> None:
    """Put the slider where the input has it."""
    assert isinstance(walk.state, TravelState)
    walk.points[slider.name] = guide(slider.line, walk).place(walk.state.travel)
    walk.travels[slider.name] = walk.state.travel


def place_point(point: Rigid, walk: Walk) -> None:
    """Carry the point with its body."""
    walk.points[point.name] = walk.attached(point.on, point.at, point.name)
