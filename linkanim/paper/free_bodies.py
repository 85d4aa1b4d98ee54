"""Draw each body of a worked solution free, with all forces on it; three forces also as a closed triangle."""

from __future__ import annotations

import math
import re
from cmath import rect
from collections.abc import Iterator

import numpy as np

from linkanim.explain.forces import FreeBody
from linkanim.explain.solution import Solution
from linkanim.paper.illustration import page_pen
from linkanim.paper.svg import svg
from linkanim.paper.vectors import NamedPlace, around_joint, captions, name_places
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
from linkanim.words import said

_PANEL, _ACROSS = (300, 240), 3
"""The size of a body's panel in pixels, and how many lie beside each other."""
_FILLED, _LONGEST = 0.5, 0.32
"""The share of a panel that the largest body takes, and the longest arrow."""
_OF = re.compile(r'id="(?:arrow|side)-([^"]*?)(?:-\d+)?"')
"""The ids of the groups of arrows, with their names."""


def free_bodies_svg(solution: Solution) -> str:
    """Return the bodies free as SVG, each in a panel with its forces and couples.

    Each arrow says what it is of, as its name does.
    """
    bodies = solution.bodies
    groups = [group for body in enumerate(bodies) for group in _panel(solution, *body)]
    drawn = svg(_size(len(bodies)), None, groups, title=said("Free bodies of {title}", title=solution.title))
    return _OF.sub(lambda arrow: f'data-of="{vector_of(arrow[1])}"', drawn)


def _size(count: int) -> tuple[int, int]:
    return _PANEL[0] * min(count, _ACROSS), _PANEL[1] * math.ceil(count / _ACROSS)


def _panel(solution: Solution, n: int, body: FreeBody) -> Iterator[Group]:
    """Yield the groups of one body: its outline, each force, its couples, and the names."""
    pen = page_pen((960, 540), "light")
    room = Rect(n % _ACROSS * _PANEL[0], n // _ACROSS * _PANEL[1], *_PANEL).inset(8)
    three = bool(body.triangle())
    half = room._replace(width=room.width * (0.62 if three else 1.0))
    joints = solution.joints_of(body)
    scale = _FILLED * _PANEL[1] / max(solution.spread, 1e-12)
    spots = {name: scale * at.conjugate() for name, at in joints.items()}
    long = _LONGEST * _PANEL[1]
    drawn = [(name, scale * foot.conjugate(), long * way.conjugate()) for name, foot, way in body.pulls()]
    ends = np.array([*spots.values(), *(end for _, foot, way in drawn for end in (foot, foot + way))])
    middle = complex(ends.real.max() + ends.real.min(), ends.imag.max() + ends.imag.min()) / 2
    off = complex(half.x + half.width / 2, half.y + half.height / 2 + 8) - middle
    spots = {name: at + off for name, at in spots.items()}
    drawn = [(name, foot + off, way) for name, foot, way in drawn]
    words, colour, turning = solution.body_title(body), pen.theme.force, pen.theme.acceleration
    yield grouped(f"free-{body.name}", _outline(solution, body, spots, pen))
    for name, foot, way in drawn:
        yield Group(f"arrow-{name}", [Layer(colour, arrows([foot], [way], 1.5 * pen.line))])
    yield grouped(f"couples-{body.name}", _couples(body, spots, pen))
    names = [NamedPlace(name, name_places(foot, foot + way, pen.small), colour) for name, foot, way in drawn]
    names += [
        NamedPlace(name, around_joint(_middle(spots), 2.4 * pen.small), turning) for name, _ in body.turning()
    ]
    pins = [
        NamedPlace(subscripted(one), around_joint(at, pen.small), pen.theme.ink) for one, at in spots.items()
    ]
    ground = grounded(half, lines=[(foot, foot + way) for _, foot, way in drawn], half=1.5 * pen.line)
    small = pen.__class__(pen.type, pen.theme, pen.small, pen.small, pen.line)
    told = [
        one._replace(of=vector_of(one.text)) if one.colour in (colour, turning) else one
        for one in captions([*names, *pins], ground, small)
    ]
    title = Caption(words, (room.x, room.y), pen.small, pen.theme.ink, strong=True)
    yield Group(f"names-{body.name}", [], [title, *told])
    if three:
        yield from _triangle(body, room._replace(x=half.right, width=room.width - half.width), small)


def _outline(solution: Solution, body: FreeBody, spots: dict[str, complex], pen: Pen) -> Iterator[Item]:
    theme, own = pen.theme, colours_of(figure(solution.request.scene), pen.theme)
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


def _couples(body: FreeBody, spots: dict[str, complex], pen: Pen) -> Iterator[Item]:
    """Yield the couples as bent arrows about the body's middle."""
    middle = _middle(spots)
    for n, (_, value) in enumerate(body.turning()):
        radius, way = 15.0 + 7.0 * n, -1.0 if value > 0 else 1.0
        turns = way * np.linspace(-2.2, 1.2, 24)
        path = middle + radius * np.exp(1j * turns)
        yield Layer(pen.theme.acceleration, stroke(path, 1.3 * pen.line))
        head = 1j * way * rect(1.0, float(turns[-1]))
        yield Layer(pen.theme.acceleration, arrows([path[-1]], [9.0 * head], 1.3 * pen.line))


def _middle(spots: dict[str, complex]) -> complex:
    """Return the place about which couples are drawn."""
    return sum(spots.values()) / len(spots)


def _triangle(body: FreeBody, room: Rect, pen: Pen) -> Iterator[Group]:
    """Yield the polygon of a body's three forces, head to tail."""
    sides = [(name, begin.conjugate(), end.conjugate()) for name, begin, end in body.triangle()]
    ends = np.array([side[1:] for side in sides])
    spread_ = max(float(np.ptp(ends.real)), float(np.ptp(ends.imag)), 1e-12)
    scale = 0.62 * min(room.width, room.height) / spread_
    middle = complex(ends.real.max() + ends.real.min(), ends.imag.max() + ends.imag.min()) / 2
    off, colour = complex(room.x + room.width / 2, room.y + room.height / 2) - scale * middle, pen.theme.force
    placed = [(name, off + scale * begin, off + scale * end) for name, begin, end in sides]
    for name, foot, head in placed:
        yield Group(f"side-{name}", [Layer(colour, arrows([foot], [head - foot], 1.2 * pen.line))])
    names = [NamedPlace(name, name_places(foot, head, pen.small), colour) for name, foot, head in placed]
    told = captions(names, grounded(room, lines=[side[1:] for side in placed], half=1.2 * pen.line), pen)
    yield Group(f"triangle-{body.name}", [], [one._replace(of=vector_of(one.text)) for one in told])
