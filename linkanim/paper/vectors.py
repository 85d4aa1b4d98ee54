"""Vectors as figures: the loops of a worked solution over the faint links, and the polygons of a pose."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from linkanim.explain.formula import Symbol
from linkanim.explain.solution import Solution
from linkanim.explain.steps import names_of
from linkanim.mechanics.linkage import holding
from linkanim.mechanics.measures import output_slider
from linkanim.mechanics.quantities import link_labels
from linkanim.paper.figure import Figured
from linkanim.paper.svg import svg
from linkanim.picture.chart import Pen, pen_for
from linkanim.picture.figure import figure
from linkanim.picture.fittings import ground_layers
from linkanim.picture.items import Caption, Group, Halo
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.placing import Alternatives, Obstacles, chosen, grounded
from linkanim.picture.polygons import polygons_of
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import arrows, disc
from linkanim.picture.text import subscripted
from linkanim.picture.view import Rect
from linkanim.words import said

_WIDE, _TALL = (520, 380), (400, 480)
"""The figure's size in pixels; printed beside its equations, it has letters of some 7 pt."""
_FILLED = 0.86
"""The share of the picture's width or height that vectors and links take."""
_SHORT = 1e-6
"""A share of the picture's width: a vector that is shorter has no direction."""


def polygons_svg(figured: Figured) -> str:
    """Return the velocity and the acceleration polygon of a figure's pose, side by side and nothing else."""
    picture, scene = figured.picture, figured.scene
    pose = scene.pose(figured.shown_phase, speed=figured.speed, acceleration=figured.acceleration)
    pen, edge = pen_for(picture.layout, picture.type, picture.theme), 0.02 * figured.size[0]
    whole = Rect(0, 0, *figured.size).inset(edge)
    groups = [one.group(pose) for one in polygons_of(picture.figure, whole, pen, figured.shown_phase)]
    title = said("Velocity and acceleration polygon of {title}", title=said(scene.title))
    return svg(figured.size, picture.theme.background, groups, title=title)


class NamedPlace(NamedTuple):
    """A text, and where its middle may stand, best first."""

    text: str
    places: list[complex]
    colour: Colour

    def alternatives(self, pen: Pen) -> Alternatives:
        """Return its places, each as much worse as it stands further back."""
        size = pen.type.width(self.text, pen.text, strong=True), pen.text
        return Alternatives(size, np.array([self.places]), np.arange(float(len(self.places))), most=1.0)

    def caption(self, n: int, pen: Pen) -> Caption:
        """Return it at its n-th place."""
        at, halo = self.places[n], Halo(pen.theme.background, 0.2 * pen.text)
        top = at.real, at.imag - pen.text / 2
        return Caption(self.text, top, pen.text, self.colour, "centre", strong=True, halo=halo)


def vectors_svg(solution: Solution) -> str:
    """Return the vector loops as SVG: each vector once, with its name, and its joints with theirs."""
    picture = _picture(solution)
    ground = Group("ground", ground_layers(picture.drawing.setting, _pins(solution, picture)))
    title = said("Vector loops of {title}", title=solution.title)
    drawn = [ground, *_links(solution, picture), *_drawn(solution, picture)]
    return svg(picture.size, picture.theme.background, drawn, title=title, indices=indices_of(solution))


_OF_INPUT = ("0", "m", "slow", "stretched", "folded", "back", "front", "s1", "s2", "f1", "f2")
"""The indices of angles of the whole motion that are the input's."""


def indices_of(solution: Solution) -> dict[str, str]:
    """Return the symbols of each group of the figure, with blanks between, as a kind and an index.

    The kinds are r, a length; w, what belongs to a link that turns; s, a travel; j, what belongs to a joint.
    Springs and dampers, which the figure of the loops lacks, have none.
    """
    linkage, names = solution.request.scene.linkage, names_of(figure(solution.request.scene))
    labels = link_labels(linkage)
    bars = [(start, joint.name) for joint in linkage.joints for start, _ in joint.bars]
    of: dict[str, list[str]] = {}
    for body in linkage.bodies:
        if body.slider:
            of[f"fitting-{body.slider}"] = [f"w{labels[body.name]}", f"s{names.slide(body.slider).sub}"]
            continue
        frame = holding(linkage.rigid_bodies, body.joints)
        rigid = set(body.joints) | set(() if frame is None else linkage.rigid_bodies[frame])
        others = (one for one in linkage.bodies if one.slider is None and set(one.joints) <= rigid)
        own = [ends for ends in bars if {*ends} <= rigid]
        of[f"body-{body.name}"] = [f"{kind}{labels[one.name]}" for one in others for kind in ("w", "jG")]
        of[f"body-{body.name}"] += [f"w{names.angle(*ends)}" for ends in own]
        of[f"body-{body.name}"] += [f"r{names.length(*ends)}" for ends in own]
    for symbol, (begin, head) in solution.arrows.items():
        letter, index = symbol.letter, symbol.sub
        ends = [
            [name for name, at in solution.places.items() if abs(at - end) < _SHORT * abs(head - begin)]
            for end in (begin, head)
        ]
        pairs = [pair for one, other in product(*ends) for pair in ((one, other), (other, one))]
        of[_vector(symbol)] = [f"{'r' if letter == 'R' else 'j' if letter == 'E' else 's'}{index}"]
        if letter == "R":
            angles = [*(names.angle(*pair) for pair in pairs), *("".join(pair) for pair in pairs)]
            of[_vector(symbol)] += [f"w{angle}" for angle in angles]
            of[_vector(symbol)] += ["w1"] * (index == "1")
    drawn = {symbol.sub for symbol in solution.arrows if symbol.letter == "R"}
    for joint in linkage.joints:
        legs = (f"r{index}" for index in names.legs.get(joint.name, ()))
        more = (f"r{n}" for ends, n in names.lengths.items() if joint.name in ends and n not in drawn)
        of[_mark(joint.name)] = [f"j{joint.name}", *legs, *more]
    driven, output = linkage.driven.body, output_slider(linkage)
    moved = of.get(f"body-{driven.name}" if driven else "", of[_mark(linkage.drive.joint)])
    moved += [*(f"w{index}" for index in _OF_INPUT), "sin", "jin"]
    if output is not None:
        of[f"fitting-{output.slider}"] += [f"s{end}" for end in ("min", "max", "back", "front")]
    return {group: " ".join(dict.fromkeys(own)) for group, own in of.items()}


def _vector(symbol: Symbol) -> str:
    return f"vector-{symbol.letter}{symbol.sub}"


def _mark(joint: str) -> str:
    return f"mark-{joint}"


def _picture(solution: Solution) -> Picture:
    """Return the links with all vectors in view, as large as there is room for."""
    look, scene = Look(trace=False, hud=False), solution.request.scene
    bodies = {name for body in scene.linkage.bodies for name in body.joints}
    places = [end for ends in solution.arrows.values() for end in ends]
    places += [at for name, at in solution.places.items() if name in bodies]
    high, wide = (float(np.ptp(np.imag(places))), float(np.ptp(np.real(places))))
    size = _TALL if high > wide else _WIDE
    whole = Figured(scene, size, look, solution.phase).picture
    outlines = (loop for group in _links(solution, whole) for layer in group.layers for loop in layer.loops)
    ends = np.concatenate([[_pixel(whole, place) for place in places], *outlines])
    spans = max(float(np.ptp(ends.real)), 1.0), max(float(np.ptp(ends.imag)), 1.0)
    zoom = min(_FILLED * size[0] / spans[0], _FILLED * size[1] / spans[1])
    off = (ends.real.max() + ends.real.min() - size[0]) / 2, (ends.imag.max() + ends.imag.min() - size[1]) / 2
    pan = -zoom * float(off[0]) / size[1], -zoom * float(off[1]) / size[1]
    return Figured(scene, size, replace(look, zoom=zoom, pan=pan), solution.phase).picture


def _pins(solution: Solution, picture: Picture) -> list[str]:
    """Return the fixed pins of links and of vectors."""
    ends = {end for ends in solution.arrows.values() for end in ends}
    bodies = {name for body in solution.request.scene.linkage.bodies for name in body.joints}
    return [name for name in picture.figure.fixed if name in bodies or solution.places[name] in ends]


def _links(solution: Solution, picture: Picture) -> Iterator[Group]:
    """Return the links in faint colours, with the pins of nothing else."""
    others = {*picture.figure.fixed} - {*_pins(solution, picture)}
    return picture.drawing.faint_groups(solution.request.scene.pose(solution.phase, 0), others)


def _pixel(picture: Picture, at: complex) -> complex:
    return picture.view.pixel((at.real, at.imag))


def _drawn(solution: Solution, picture: Picture) -> Iterator[Group]:
    """Yield the marks of joints and the vectors, each with its name, placed where it covers nothing."""
    pen, theme = pen_for(picture.layout, picture.type, picture.theme), picture.theme
    ways = [
        (symbol, _pixel(picture, begin), _pixel(picture, end))
        for symbol, (begin, end) in solution.arrows.items()
    ]
    long = [way for way in ways if abs(way[2] - way[1]) > _SHORT * picture.size[0]]
    bodies = {name for body in solution.request.scene.linkage.bodies for name in body.joints}
    joints = {name: _pixel(picture, at) for name, at in solution.places.items()}
    ends = [end for _, *both in long for end in both]
    shown = {
        name: at for name, at in joints.items() if name in bodies or any(abs(at - end) < 1 for end in ends)
    }
    names = [
        NamedPlace(subscripted(name), around_joint(at, pen.text), theme.ink) for name, at in shown.items()
    ]
    groups = [
        Group(_mark(name), [Layer(theme.ink, [at + disc(1.6 * pen.line)])]) for name, at in shown.items()
    ]
    for symbol, begin, end in long:
        colour = theme.velocity if symbol.letter == "R" else theme.acceleration
        arrow = Layer(colour, arrows([begin], [end - begin], 1.7 * pen.line))
        groups.append(Group(_vector(symbol), [arrow]))
        text = f"{symbol.letter}_{{{symbol.sub}}}"
        names.append(NamedPlace(text, name_places(begin, end, pen.text), colour))
    whole = Rect(0, 0, *picture.size)
    ground = grounded(whole, lines=[(begin, end) for _, begin, end in long], half=1.5 * pen.line)
    spots = np.array([[*shown.values()]], np.complex128).reshape(1, -1)
    placed = captions(names, ground._replace(discs=spots, radii=np.full(len(shown), 4 * pen.line)), pen)
    for group, words in zip(groups, placed, strict=True):
        yield group._replace(captions=[words])


def captions(names: list[NamedPlace], ground: Obstacles, pen: Pen) -> Iterator[Caption]:
    """Yield names placed where they cover nothing, else as little as possible."""
    which = chosen([one.alternatives(pen) for one in names], ground)
    for one, n in zip(names, which, strict=True):
        yield one.caption(n or 0, pen)


def name_places(begin: complex, end: complex, text: float) -> list[complex]:
    """Return places for a vector's name: by its middle on either side, then along it and further off."""
    across = 1j * (end - begin) / abs(end - begin)
    return [
        begin + share * (end - begin) + side * away * text * across
        for away in (0.9, 1.4, 2.0)
        for share in (0.5, 0.35, 0.65, 0.2, 0.8)
        for side in (1, -1)
    ]


def around_joint(at: complex, text: float) -> list[complex]:
    """Return places for a joint's name."""
    turns = (-45, -135, 45, 135, 0, 180, -90, 90)
    return [at + away * text * np.exp(1j * np.radians(turn)) for away in (1.1, 1.6) for turn in turns]
