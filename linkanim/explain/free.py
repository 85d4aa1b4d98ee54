"""A body of a worked solution drawn free: its joints, the forces on it as arrows, its couples.

Places are complex numbers x + yi, y up, in the scene's unit; how large all is drawn is for who draws it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from linkanim.explain.forces import FreeBody
from linkanim.explain.solution import Solution
from linkanim.mechanics.linkage import holding
from linkanim.mechanics.quantities import called
from linkanim.words import said

_SHORTEST = 0.05 / 0.32
"""A force of less than this share of the greatest on a body is drawn so long, so that it is seen."""
_NOTHING = 1e-9


class DrawnForce(NamedTuple):
    """A force as it is drawn: its name, where it begins, and its way, 1 long for the greatest on its body."""

    name: str
    foot: complex
    way: complex


def panels(solution: Solution) -> list[FreeBody]:
    """Return the bodies on which anything acts."""
    return [body for body in solution.bodies if body.forces or body.couples]


def titled(solution: Solution, body: FreeBody) -> str:
    """Return what a body is called."""
    scene = solution.request.scene
    own = next((one for one in scene.linkage.bodies if one.name == body.name), None)
    return called(own, scene.info.link_names) if own else said("Bar {name}", name=body.name)


def joints_of(solution: Solution, body: FreeBody) -> dict[str, complex]:
    """Return the joints of a body and where they lie."""
    linkage = solution.request.scene.linkage
    own = next((one for one in linkage.bodies if one.name == body.name), None)
    if own is not None and own.slider:
        return {own.slider: solution.places[own.slider]}
    if own is None:
        pair = tuple(body.name.split("–"))
        if len(pair) < 2:
            return {body.about: solution.places[body.about]}
        n = holding(linkage.rigid_bodies, pair)
    else:
        n = holding(linkage.rigid_bodies, own.joints)
    return {name: solution.places[name] for name in (linkage.rigid_bodies[n] if n else (body.about,))}


def spread(solution: Solution) -> float:
    """Return the width or height of the largest body."""
    spreads = [0.0]
    for body in panels(solution):
        places = np.array(list(joints_of(solution, body).values()))
        spreads.append(float(max(np.ptp(places.real), np.ptp(places.imag))))
    return max(spreads)


def pulls(body: FreeBody) -> Iterator[DrawnForce]:
    """Yield the forces on a body that are not zero."""
    values = [complex(one.force.x.value, one.force.y.value) for one in body.forces]
    most = max(map(abs, values), default=0.0)
    for one, value in zip(body.forces, values, strict=True):
        if abs(value) > _NOTHING * most:
            way = value / abs(value) * max(abs(value) / most, _SHORTEST)
            yield DrawnForce(one.name, complex(one.place.x.value, one.place.y.value), way)


def couples(body: FreeBody) -> list[tuple[str, float]]:
    """Return the couples that are not zero, counter-clockwise positive."""
    return [(name, couple.value) for name, couple in body.couples if couple.value]


def triangle(body: FreeBody) -> list[tuple[str, complex, complex]]:
    """Return the names and sides (N) of the triangle that a body's three forces close; none of others.

    Exactly three forces that hold a body meet in a point, and head to tail they close a triangle.
    """
    values = [(one.name, complex(one.force.x.value, one.force.y.value)) for one in body.forces]
    sides = [(name, value) for name, value in values if value]
    if len(sides) != 3 or body.couples:
        return []
    begins = np.cumsum([0j, *(value for _, value in sides)]).tolist()
    return [(name, begin, begin + value) for (name, value), begin in zip(sides, begins, strict=False)]
