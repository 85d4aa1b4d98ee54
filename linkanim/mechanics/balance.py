"""Even out a machine: the work that a flywheel stores, counterweights that make the shaking force vanish.

The total centre of mass of a four-bar stands still, and with it the shaking force is 0, where the masses of
the crank and the rocker balance what the coupler hangs on their pins (R. S. Berkof and G. G. Lowen, A new
method for completely force balancing simple linkages, Journal of Engineering for Industry, 1969). With z₃ the
coupler's centre from A along A → B, as a share r₃ of that, the bars' moments about their pivots have to be

    m₂ z₂ = -m₃ (1 - z₃/r₃) r₂     m₄ z₄ = -m₃ (z₃/r₃) r₄
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import tau
from typing import Any, NamedTuple

import numpy as np

from linkanim.mechanics.forces import input_effort
from linkanim.mechanics.linkage import RRR, Body, Crank, Linkage, Pin, holding
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.program import Array
from linkanim.mechanics.search import in_blocks
from linkanim.mechanics.tolerances import NO_SHARE

_FINER = 8
"""How many times as closely as it is sampled the stored work is looked at for its extremes."""


class Counterweight(NamedTuple):
    """A mass (kg) added to a body at a place from its pivot, along the bar and to its left."""

    body: str
    mass: float
    place: complex


def surplus(solved: Callable[[Array], Any], phases: Array) -> float | None:
    """Return the greatest surplus of work (J) over a period at an even speed, which a flywheel has to store.

    It is how far the work of the torque less its mean rises and falls. `phases` cover a period from 0 at
    equal steps; None where the torque is not bounded.
    """
    parts = [solved(part) for part in in_blocks(phases)]
    torque = np.concatenate([np.asarray(input_effort(part)) for part in parts])
    if not np.isfinite(torque).all():
        return None
    period = len(phases) * float(phases[1])
    waves = np.fft.rfft(torque - torque.mean())
    numbers = np.arange(len(waves))
    stored = np.divide(waves, 1j * numbers, out=np.zeros_like(waves), where=numbers > 0) * (period / tau)
    fine = np.fft.irfft(stored, _FINER * len(phases)) * _FINER
    return float(fine.max() - fine.min())


def flywheel(work: float, speed: float, fluctuation: float) -> float:
    """Return the moment of inertia (kg m²) that keeps the speed within a coefficient of fluctuation.

    That is the difference of the greatest and the least speed, as a share of their mean (rad/s).
    """
    return work / (fluctuation * speed * speed)


def counterweights(linkage: Linkage) -> tuple[Counterweight, ...] | None:
    """Return what makes a four-bar's shaking force vanish, each at half its bar's length; None for others.

    None, too, where the coupler has no mass. Bars without a stated mass count as without any.
    """
    bars = _four_bar(linkage)
    if bars is None:
        return None
    (first, b3, last), (r2, r3, r4), names = bars
    share = _moment(linkage, b3, names[1]) / b3.mass / r3 if b3.mass else 0.0
    needed = (-(b3.mass or 0.0) * (1 - share) * r2, -(b3.mass or 0.0) * share * r4)
    weights = []
    for body, pivot, length, moment in (
        (first, names[0], r2, needed[0]),
        (last, names[2], r4, needed[1]),
    ):
        lacking = moment - _moment(linkage, body, pivot)
        if abs(lacking) > NO_SHARE * (b3.mass or 0.0) * length:
            place = 0.5 * length * lacking / abs(lacking)
            weights.append(Counterweight(body.name, abs(lacking) / (0.5 * length), complex(place)))
    return tuple(weights)


class Shaken(NamedTuple):
    """What inertia does to the ground over a period: phases, the force's size (N), the moment (N m)."""

    phases: Array
    force: Array
    moment: Array

    @property
    def greatest(self) -> tuple[float, float]:
        """The greatest force, and the greatest moment."""
        return float(self.force.max()), float(np.abs(self.moment).max())


def shaken(linkage: Linkage, speed: float) -> Shaken:
    """Return what inertia alone does to the ground at an even speed (rad/s of phase), the moment about 0."""
    alone = replace(linkage, gravity=0.0, loads=(), springs=(), dampers=())
    solved = mechanism(alone)
    reactions = solved.solve(phase=solved.phases, speed=speed).reactions
    return Shaken(solved.phases, np.hypot(*reactions.ground), np.asarray(reactions.moment))


def balanced(linkage: Linkage, weights: tuple[Counterweight, ...]) -> Linkage:
    """Return a linkage with counterweights, each as a point of its body."""
    by_name = {one.body: one for one in weights}
    bodies = tuple(
        _weighted(linkage, body, by_name[body.name]) if body.name in by_name else body
        for body in linkage.bodies
    )
    return replace(linkage, bodies=bodies)


def _weighted(linkage: Linkage, body: Body, weight: Counterweight) -> Body:
    """Return a body with a counterweight; its centre from its first joint."""
    bars = _four_bar(linkage)
    assert bars is not None
    pivot = bars[2][0] if body.name == bars[0][0].name else bars[2][2]
    mass = (body.mass or 0.0) + weight.mass
    centre = (_moment(linkage, body, pivot) + weight.mass * weight.place) / mass
    inertia = None
    if body.inertia is not None:
        own = _moment(linkage, body, pivot) / body.mass if body.mass else 0.0
        metre = linkage.metre
        parts = (body.mass or 0.0) * abs(centre - own) ** 2 + weight.mass * abs(centre - weight.place) ** 2
        inertia = body.inertia + parts * metre * metre
    # along first -> second joint, from the first
    if body.joints[0] != pivot:
        length = _length(linkage, body)
        centre = length - centre
    return replace(body, mass=mass, com=(centre.real, centre.imag), inertia=inertia)


def _length(linkage: Linkage, body: Body) -> float:
    frame = linkage.rigid_bodies[holding(linkage.rigid_bodies, body.joints) or 0]
    return abs(frame[body.joints[1]] - frame[body.joints[0]])


def _moment(linkage: Linkage, body: Body, pivot: str) -> complex:
    """Return mass times place of a body's centre, from a pivot along its bar; 0 without a mass."""
    if body.mass is None or body.com is None:
        return 0j
    centre = complex(*body.com)
    return body.mass * (centre if body.joints[0] == pivot else _length(linkage, body) - centre)


FourBar = tuple[tuple[Body, Body, Body], tuple[float, float, float], tuple[str, str, str]]


def _four_bar(linkage: Linkage) -> FourBar | None:
    """Return a four-bar's crank, coupler and rocker, their lengths, and where each begins, or None."""
    moving = [joint for joint in linkage.joints if joint.dyad or joint.grouped or isinstance(joint, Crank)]
    crank, dyads = linkage.driven.joint, [joint for joint in moving if isinstance(joint, RRR)]
    if len(moving) != 2 or not dyads or not isinstance(crank, Crank):
        return None
    (dyad,) = dyads
    first, last = dyad.ends if dyad.ends[0] == crank.name else dyad.ends[::-1]
    lengths = dyad.lengths if dyad.ends[0] == crank.name else dyad.lengths[::-1]
    if first != crank.name or not isinstance(linkage.by_name[last], Pin):
        return None
    pairs = ((crank.pivot, crank.name), (crank.name, dyad.name), (last, dyad.name))
    bodies = [next((one for one in linkage.bodies if {*pair} == {*one.joints[:2]}), None) for pair in pairs]
    if any(body is None for body in bodies) or bodies[1] is None or bodies[1].mass is None:
        return None
    b2, b3, b4 = (body for body in bodies if body)
    return (b2, b3, b4), (crank.length, *lengths), (crank.pivot, crank.name, last)
