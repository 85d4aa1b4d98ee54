"""Draw each body of a worked solution free, with all forces on it; three forces also as a closed triangle."""

from __future__ import annotations

import math
import re
from cmath import rect
from collections.abc import Iterator

import numpy as np

from linkanim.explain.forces import FreeBody
from linkanim.explain.solution import Solution
from linkanim.frozen import NamedTuple
from linkanim.mechanics.linkage import holding
from linkanim.mechanics.quantities import called
from linkanim.paper.illustration import page_pen
from linkanim.paper.svg import svg
from linkanim.paper.vectors import NamedPlace, around_joint, beside, captions
from linkanim.picture.bodies import colours_of
from linkanim.picture.chart import Pen
from linkanim.picture.figure import figure
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.motion_marks import vector_of
from linkanim.picture.placing import grounded
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import arrows, box, disc, hull, lined, stroke
from linkanim.picture.text import subscripted
from linkanim.picture.theme import mixed
from linkanim.picture.view import Rect

_PANEL, _ACROSS = (300, 240), 3
"""The size of a body's panel in pixels, and how many lie beside each other."""
_FILLED, _LONGEST = 0.5, 0.32
"""The share of a panel that the largest body takes, and the longest arrow."""
_SHORTEST = 0.05
"""A force of less than this share of the greatest on a body is drawn so long, that it is seen."""
_NOTHING = 1e-9
_OF = re.compile(r'id="(?:arrow|side)-([^"]*?)(?:-\d+)?"')
"""The ids of the groups of arrows, with their names."""


class _Arrow(NamedTuple):
    """A force in pixels: its name, its foot and how far it reaches."""

    name: str
    foot: complex
    reach: complex


def free_bodies_svg(found: Solution) -> str:
    """Return the bodies free as SVG, each in a panel with its forces and couples.

    Each arrow says what it is of, as its name does.
    """
    bodies = _panels(found)
    groups = [group for body in enumerate(bodies) for group in _panel(found, *body)]
    drawn = svg(_size(len(bodies)), None, groups, title=f"Free bodies of {found.title}")
    return _OF.sub(lambda arrow: f'data-of="{vector_of(arrow[1])}"', drawn)


def _panels(found: Solution) -> list[FreeBody]:
    """Return the bodies on which anything acts."""
    return [body for body in found.bodies if body.forces or body.couples]


def _size(count: int) -> tuple[int, int]:
    return _PANEL[0] * min(count, _ACROSS), _PANEL[1] * math.ceil(count / _ACROSS)


def _panel(found: Solution, n: int, body: FreeBody) -> Iterator[Group]:
    """Yield the groups of one body: its outline, each force, its couples, and the names."""
    pen = page_pen((960, 540), "light")
    room = Rect(n % _ACROSS * _PANEL[0], n // _ACROSS * _PANEL[1], *_PANEL).inset(8)
    triangle = _is_triangle(body)
    half = room._replace(width=room.width * (0.62 if triangle else 1.0))
    joints = _joints(found, body)
    scale = _FILLED * _PANEL[1] / max(_spread(found), 1e-12)
    spots = {name: scale * at.conjugate() for name, at in joints.items()}
    drawn = list(_arrows(body, scale))
    ends = np.array([*spots.values(), *(end for one in drawn for end in (one.foot, one.foot + one.reach))])
    middle = complex(ends.real.max() + ends.real.min(), ends.imag.max() + ends.imag.min()) / 2
    off = complex(half.x + half.width / 2, half.y + half.height / 2 + 8) - middle
    spots = {name: at + off for name, at in spots.items()}
    drawn = [one._replace(foot=one.foot + off) for one in drawn]
    words, colour, turning = _words(found, body), pen.theme.force, pen.theme.acceleration
    yield grouped(f"free-{body.name}", _outline(found, body, spots, pen))
    for one in drawn:
        yield Group(f"arrow-{one.name}", [Layer(colour, arrows([one.foot], [one.reach], 1.5 * pen.line))])
    yield grouped(f"couples-{body.name}", _couples(body, spots, pen))
    names = [NamedPlace(one.name, beside(one.foot, one.foot + one.reach, pen.small), colour) for one in drawn]
    names += [
        NamedPlace(name, around_joint(at, 2.4 * pen.small), turning) for name, at in _turned(body, spots)
    ]
    pins = [
        NamedPlace(subscripted(one), around_joint(at, pen.small), pen.theme.ink) for one, at in spots.items()
    ]
    ground = grounded(half, lines=[(one.foot, one.foot + one.reach) for one in drawn], half=1.5 * pen.line)
    small = pen.__class__(pen.type, pen.theme, pen.small, pen.small, pen.line)
    told = [
        one._replace(of=vector_of(one.text)) if one.colour in (colour, turning) else one
        for one in captions([*names, *pins], ground, small)
    ]
    title = Caption(words, (room.x, room.y), pen.small, pen.theme.ink, strong=True)
    yield Group(f"names-{body.name}", [], [title, *told])
    if triangle:
        yield from _triangle(body, room._replace(x=half.right, width=room.width - half.width), small)


def _words(found: Solution, body: FreeBody) -> str:
    scene = found.request.scene
    own = next((one for one in scene.linkage.bodies if one.name == body.name), None)
    return called(own, scene.info.link_names) if own else f"Bar {body.name}"


def _joints(found: Solution, body: FreeBody) -> dict[str, complex]:
    """Return the joints of a body and where they lie."""
    linkage = found.request.scene.linkage
    own = next((one for one in linkage.bodies if one.name == body.name), None)
    if own is not None and own.slider:
        return {own.slider: found.places[own.slider]}
    if own is None:
        pair = tuple(body.name.split("–"))
        if len(pair) < 2:
            return {body.about: found.places[body.about]}
        n = holding(linkage.rigid_bodies, pair)
    else:
        n = holding(linkage.rigid_bodies, own.joints)
    return {name: found.places[name] for name in (linkage.rigid_bodies[n] if n else (body.about,))}


def _spread(found: Solution) -> float:
    """Return the width or height of the largest body, in the scene's unit."""
    spreads = [0.0]
    for body in _panels(found):
        places = np.array(list(_joints(found, body).values()))
        spreads.append(float(max(np.ptp(places.real), np.ptp(places.imag))))
    return max(spreads)


def _outline(found: Solution, body: FreeBody, spots: dict[str, complex], pen: Pen) -> Iterator[Item]:
    theme, own = pen.theme, colours_of(figure(found.request.scene), pen.theme)
    edge = mixed(own.get(body.name, theme.metal), theme.background, 0.35)
    inside = mixed(edge, theme.background, 0.7)
    colours: tuple[Colour, Colour] = (edge, inside)
    points = list(spots.values())
    if len(points) == 1:
        yield Layer(edge, [points[0] + box(46, 30, 3)])
        yield Layer(inside, [points[0] + box(42, 26, 2)])
    else:
        yield from lined(hull(points) if len(points) > 2 else points, 9.0, 2.0, colours)
    for at in points:
        yield Layer(theme.outline, [at + disc(4.2)])
        yield Layer(theme.background, [at + disc(2.6)])


def _arrows(body: FreeBody, scale: float) -> Iterator[_Arrow]:
    """Yield the forces as arrows, the greatest on a body equally long on each."""
    values = [complex(one.force.x.value, one.force.y.value) for one in body.forces]
    most = max(map(abs, values), default=0.0)
    for one, value in zip(body.forces, values, strict=True):
        if abs(value) <= _NOTHING * most or not most:
            continue
        foot = scale * complex(one.place.x.value, -one.place.y.value)
        long = max(abs(value) / most, _SHORTEST) * _LONGEST * _PANEL[1]
        yield _Arrow(one.name, foot, long * (value / abs(value)).conjugate())


def _couples(body: FreeBody, spots: dict[str, complex], pen: Pen) -> Iterator[Item]:
    """Yield the couples as bent arrows about the body's middle."""
    values = {name: couple.value for name, couple in body.couples}
    for n, (name, middle) in enumerate(_turned(body, spots)):
        radius, way = 15.0 + 7.0 * n, -1.0 if values[name] > 0 else 1.0
        turns = way * np.linspace(-2.2, 1.2, 24)
        path = middle + radius * np.exp(1j * turns)
        yield Layer(pen.theme.acceleration, stroke(path, 1.3 * pen.line))
        head = 1j * way * rect(1.0, float(turns[-1]))
        yield Layer(pen.theme.acceleration, arrows([path[-1]], [9.0 * head], 1.3 * pen.line))


def _turned(body: FreeBody, spots: dict[str, complex]) -> list[tuple[str, complex]]:
    """Return the couples that are not zero, and the middle about which they are drawn."""
    middle = sum(spots.values()) / len(spots)
    return [(name, middle) for name, couple in body.couples if couple.value]


def _is_triangle(body: FreeBody) -> bool:
    """Tell whether exactly three forces hold a body: they meet in a point, and close a triangle."""
    return (
        len([one for one in body.forces if one.force.x.value or one.force.y.value]) == 3 and not body.couples
    )


def _triangle(body: FreeBody, room: Rect, pen: Pen) -> Iterator[Group]:
    """Yield the polygon of a body's three forces, head to tail."""
    values = [(one.name, complex(one.force.x.value, -one.force.y.value)) for one in body.forces]
    ends = np.cumsum([0j, *(value for _, value in values)])
    spread = max(float(np.ptp(ends.real)), float(np.ptp(ends.imag)), 1e-12)
    scale = 0.62 * min(room.width, room.height) / spread
    middle = complex(ends.real.max() + ends.real.min(), ends.imag.max() + ends.imag.min()) / 2
    begin = complex(room.x + room.width / 2, room.y + room.height / 2) - scale * middle
    colour, sides = pen.theme.force, []
    for (name, value), start in zip(values, ends, strict=False):
        if value:
            foot, reach = begin + scale * complex(start), scale * value
            sides.append((foot, foot + reach))
            yield Group(f"side-{name}", [Layer(colour, arrows([foot], [reach], 1.2 * pen.line))])
    names = [
        NamedPlace(name, beside(*side, pen.small), colour)
        for (name, _), side in zip([one for one in values if one[1]], sides, strict=True)
    ]
    told = captions(names, grounded(room, lines=sides, half=1.2 * pen.line), pen)
    yield Group(f"triangle-{body.name}", [], [one._replace(of=vector_of(one.text)) for one in told])
