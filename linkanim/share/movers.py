"""Find the parts of a picture that move on a page, how, and in which colours.

Each group is SVG, with the data by which the page's script moves it. Tracks are the paths of joints in
pixels, as nodes between which a quintic is close enough for the largest screens. Colours are pairs, of the
light and the dark theme.
"""

from __future__ import annotations

import base64
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.measures import rounding_of
from linkanim.mechanics.motion import Motion, Pose
from linkanim.paper.svg import RIMMED, drawn, flat, hexadecimal, in_steps
from linkanim.picture.bodies import WHEELS
from linkanim.picture.dimensions import pivots
from linkanim.picture.figure import DOWN
from linkanim.picture.fittings import (
    BACK,
    CORE,
    EDGE,
    TILT,
    Coil,
    Damping,
    away,
    fittings,
    pedestal,
    rails_of,
    rails_under,
)
from linkanim.picture.items import Caption, Group, Item
from linkanim.picture.look import ACCELERATION, VELOCITY, ThemeName
from linkanim.picture.motion_marks import (
    AHEAD,
    RECENT,
    SWEEP,
    SWELL,
    Kind,
    Sliding,
    Trace,
    Turning,
    arrows_of,
)
from linkanim.picture.names import Label, Names
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Part, Places, Stamp, units
from linkanim.picture.theme import theme_of
from linkanim.picture.view import View
from linkanim.scenes.scene import Scene
from linkanim.words import name_said, said

_LIT: tuple[Colour, Colour] = (217, 72, 15), (255, 146, 43)
"""The colour of what is pointed at, in both themes."""

# Colours of a page that follows its reader's setting: each has a pair, of the light and the dark theme.


@frozen
class Pairs:
    """The colours met so far, numbered in their order; a page's styles call them --c0, --c1, ...."""

    numbers: dict[tuple[Colour, Colour], int] = field(default_factory=dict)

    def variable(self, light: Colour, dark: Colour) -> str:
        """Return the pair as a style's value."""
        return f"var(--c{self._number(light, dark)})"

    def variables(self, light: Iterable[Colour], dark: Iterable[Colour]) -> list[str]:
        """Return colours of both themes as a style's values."""
        return [self.variable(*pair) for pair in zip(light, dark, strict=True)]

    def elements(self, light: Iterable[Item], dark: Iterable[Item]) -> str:
        """Return the same items, described in both themes, as SVG."""
        coded = [self._coded(*pair) for pair in zip(light, dark, strict=True)]
        return "".join(map(_shorter, drawn(coded, _coloured, fixed=False)))

    def outlined(self, light: Sequence[Layer], dark: Sequence[Layer]) -> str:
        """Return layers as `elements` does; a line along all of a layer's outlines is a stroke of them.

        So the outline of a gear's teeth is held once, and not three times.
        """
        layers, outlines = [*zip(light, dark, strict=True)], list[str]()
        while layers:
            one, other = layers.pop(0)
            shapes = self.elements([one], [other])
            if layers and (wide := _width_along(one, layers[0][0])):
                line = _coloured(self._coded(*layers.pop(0)).colour)
                shapes = f'{shapes.removesuffix("/>")} stroke="{line}" stroke-width="{wide:.3g}"/>'
            outlines.append(shapes)
        return "".join(outlines)

    def styles(self, themes: tuple[ThemeName, ThemeName], stated: ThemeName | None) -> str:
        """Return the style sheet of the colours, ink and background among them by their names.

        A theme that is `stated` is used whatever the reader's setting is.
        """
        pair = [theme_of(name) for name in themes]
        ink = self.variable(pair[0].ink, pair[1].ink)
        back = self.variable(pair[0].background, pair[1].background)
        named = f"--ink: {ink}; --back: {back}; --lit: {self.variable(*_LIT)};"
        light, dark = (self._declared(n) for n in range(2))
        if stated:
            return f":root {{ color-scheme: {stated}; {named} {light} }}"
        return (
            f":root {{ color-scheme: light dark; {named} {light} }}\n"
            f"@media (prefers-color-scheme: dark) {{ :root:not([data-theme=light]) {{ {dark} }} }}\n"
            f":root[data-theme=light] {{ color-scheme: light; }}\n"
            f":root[data-theme=dark] {{ color-scheme: dark; {dark} }}"
        )

    def _declared(self, which: int) -> str:
        colours = (hexadecimal(pair[which]) for pair in self.numbers)
        return " ".join(f"--c{n}: {colour};" for n, colour in enumerate(colours))

    def _number(self, light: Colour, dark: Colour) -> int:
        return self.numbers.setdefault((light, dark), len(self.numbers))

    def _coded(self, light: Item, dark: Item) -> Item:
        """Return an item whose colour is the number of its pair."""
        colour = self._code(light.colour, dark.colour)
        if not (isinstance(light, Caption) and isinstance(dark, Caption)):
            return light._replace(colour=colour)
        halo = light.halo
        if halo and dark.halo:
            halo = halo._replace(colour=self._code(halo.colour, dark.halo.colour))
        return light._replace(colour=colour, halo=halo)

    def _code(self, light: Colour, dark: Colour) -> Colour:
        red, green, blue = self._number(light, dark).to_bytes(3)
        return red, green, blue


def _coloured(colour: Colour) -> str:
    """Return a pair, by its number, as a style's value."""
    return f"var(--c{int.from_bytes(colour)})"


def _width_along(layer: Layer, line: Layer) -> float | None:
    """Return how wide a line is that runs along all of a layer's outlines and nothing else; else None."""
    sides = [*zip(line.loops[::2], line.loops[1::2], strict=False)]
    if not sides or len(line.loops) != 2 * len(layer.loops):
        return None
    for loop, (one, other) in zip(layer.loops, sides, strict=True):
        middle = 0.5 * (one + other[::-1]) if len(one) == len(other) == len(loop) else np.inf
        if not np.allclose(middle, loop, rtol=0.0, atol=1e-6):
            return None
    return min(float(np.abs(one - other[::-1]).min()) for one, other in sides)


def _shorter(element: str) -> str:
    """Return a path in half the characters, and words without what the page's style says."""
    return in_steps(element).replace(RIMMED, "")


# The paths of joints in pixels, as nodes between which a quintic is close enough for the largest screens.
#
# A node has the position and its first two derivatives by phase, from the solver; between two nodes runs the
# polynomial of fifth degree that has them at both ends (Hermite). Nodes lie where they are needed. For a
# scene that returns along the same path they are those of the first half: at its ends rates change sign at
# once.

GRID = 1 << 16
"""The equal parts of the true period, at whose ends nodes may lie; they begin where a way does."""
NEAR = 3e-4
"""How far off a curve may be between its nodes, in pixels of the picture: 0.0012 at 3840 × 2160."""
_TOLD, _SLIGHT = 4e-5, 1e-2
"""The share of an acceleration by which it may be off: two fifths of the last of four digits. One of less
than the second share of the greatest may be off by as much as one of that size."""
_FIRST = 16
"""The fewest parts into which a curve is divided at first, for each turn of the drive."""
_PROBES = (0.25, 0.5, 0.75)
"""Where between two nodes the error is checked, in shares of the stretch."""
_STEPS = 1 << 30
"""Steps of a point's places, from its first one to the farthest."""
LARGEST_SINGLE = float(np.finfo(np.float32).max)
"""The largest number of 32 bits: larger rates, beside a place where they are unbounded, are cut to it."""
_ROUNDINGS = 10.0
"""How many usual rounding errors a point that rests may be off, as a quantity that does not change."""
_ROUNDED = 1e-6
"""How far the points of a rounded outline may be off their radius, in pixels."""
_STATED = ("dead-centres", "key", "dimension-lines")
"""The groups that hold for the given lengths alone; the key lists the dimensions that have no place."""
_KINDS: tuple[Kind, ...] = (VELOCITY, ACCELERATION)
_OF_LENGTHS = ("dimension:", "dead-centre:")
"""The labels that hold for the given lengths alone."""
_NOWHERE = complex(-1e4, -1e4)
"""Where a joint is drawn that has no position (NaN): outside the picture."""

Whole = NDArray[np.int64]


def begin_of(scene: Scene) -> float:
    """Return the phase at which tracks begin."""
    return scene.mechanism.way[0] if scene.mechanism.way else 0.0


def link_words(scene: Scene) -> dict[str, str]:
    """Return what each body is called by what it does, in the language that is spoken, by its own name."""
    return {name: name_said(word) for name, word in scene.info.link_names.items()}


def centre(body: str) -> str:
    """Return the name of a body's centre of mass among the points."""
    return f"{body} (centre of mass)"


@frozen
class Track:
    """A point's nodes: places on the grid (n,), positions in pixels x + yi (n,), derivatives (2, n)."""

    nodes: Whole
    places: Loop
    rates: Loop

    @property
    def packed(self) -> list[Any]:
        """It as a page holds it: nodes, places, rates, and what places are steps of.

        Places are whole steps of a grain, in 32 bits, from the point's first one, so that those of a small
        path are as fine as its accelerations need.
        """
        first = self.places[0]
        ways = _parts(self.places - first)
        grain = (float(np.abs(ways).max()) or 1.0) / _STEPS
        steps, rates = np.rint(ways / grain), _parts(self.rates.T)
        rates = np.clip(rates, -LARGEST_SINGLE, LARGEST_SINGLE)
        tail = [first.real, first.imag, grain]
        return [packed(self.nodes, "<u2"), packed(steps, "<i4"), packed(rates, "<f4"), tail]


def tracks(scene: Scene, view: View) -> dict[str, Track]:
    """Return the tracks of joints and centres of mass over a true period; over a way that it retraces.

    A point that rests, apart from rounding, has one node.
    """
    joints = (joint.name for joint in scene.linkage.joints)
    names = (*joints, *(centre(body.name) for body in scene.linkage.bodies if body.com is not None))
    first = min(max(_FIRST, 1 << math.ceil(math.log2(_FIRST * scene.period / math.tau))), GRID)
    step = GRID // first
    end = GRID // 2 if scene.mechanism.way else GRID
    begins = np.arange(0, end, step)
    still = _Solved(scene, view, names, begins).still
    nodes = {name: [begins[:1] if name in still else begins] for name in names}
    open_ = {name: begins for name in names if name not in still}
    while open_ and step >= 1 / min(_PROBES):
        open_ = dict(_halved(open_, _Solved(scene, view, names, _looked_at(open_, step)), step))
        step //= 2
        for name, some in open_.items():
            nodes[name].append(some)
    for name in nodes.keys() - still if end < GRID else ():
        nodes[name].append(np.array([end]))
    kept = {name: np.unique(np.concatenate(some)) for name, some in nodes.items()}
    solved = _Solved(scene, view, names, np.unique(np.concatenate([*kept.values()])))
    found = {}
    for name, some in kept.items():
        place, *rates = solved.at(name, some)
        found[name] = Track(
            some, place, np.zeros((2, 1), np.complex128) if name in still else np.array(rates)
        )
    return found


def _looked_at(open_: Mapping[str, Whole], step: int) -> Whole:
    """Return the places on the grid at which stretches begin, end, and are checked between."""
    shares = np.array((0.0, *_PROBES, 1.0)) * step
    begins = np.unique(np.concatenate([*open_.values()]))
    looked_at: Whole = np.unique(np.add.outer(begins, shares.astype(np.int64)) % GRID)
    return looked_at


def _halved(open_: Mapping[str, Whole], solved: _Solved, step: int) -> Iterator[tuple[str, Whole]]:
    """Yield the beginnings of both halves of each stretch that is off in place or acceleration."""
    width = solved.scene.period * step / GRID
    for name, begins in open_.items():
        ends = (begins + step) % GRID
        course = quintic(solved.at(name, begins), solved.at(name, ends), width)
        shares = np.array(_PROBES)[:, None]
        place, _, bend = solved.at(name, begins + (shares * step).astype(np.int64))
        off = np.abs(evaluated(course, shares) - place) > NEAR
        size = np.maximum(np.abs(bend), _SLIGHT * np.abs(bend).max())
        off |= np.abs(evaluated(_second(course), shares) / width**2 - bend) > _TOLD * size
        far = begins[off.any(axis=0)]
        if far.size:
            yield name, np.sort(np.concatenate((far, far + step // 2)))


class _Solved:
    """The points at places on the grid, solved at once."""

    def __init__(self, scene: Scene, view: View, names: Sequence[str], grid: Whole) -> None:
        self.scene, self._grid = scene, grid
        motion = scene.solve(phase=begin_of(scene) + grid * (scene.period / GRID), speed=1.0)
        self._known = dict(zip(names, _pixels(motion, scene, view), strict=True))
        self._rounding = _ROUNDINGS * view.scale * rounding_of(motion, "{}", 0)

    def at(self, name: str, places: Whole) -> Loop:
        """Return position and derivatives (3, …) at places on the grid."""
        path: Loop = self._known[name][:, np.searchsorted(self._grid, places)]
        return path

    @property
    def still(self) -> set[str]:
        """The points that rest at all places: they neither move nor have rates, apart from rounding."""
        moves = {name: path - [[path[0, 0]], [0], [0]] for name, path in self._known.items()}
        return {name for name, move in moves.items() if np.abs(move).max() <= self._rounding}


def _pixels(motion: Motion, scene: Scene, view: View) -> Iterator[Loop]:
    """Yield each point's position and derivatives (3, n) in pixels; one without a position does not move."""
    joints = (joint.name for joint in scene.linkage.joints)
    centres = (body.name for body in scene.linkage.bodies if body.com is not None)
    kinds: tuple[Any, ...] = (motion.position, motion.velocity, motion.acceleration)
    of_mass: tuple[Any, ...] = (motion.com_position, motion.com_velocity, motion.com_acceleration)
    for some, names in ((kinds, joints), (of_mass, centres)):
        for name in names:
            path = np.stack([np.broadcast_to(kind[name] @ DOWN, motion.phase.shape) for kind in some])
            path = view.scale * path + np.array([[complex(view.x, view.y)], [0], [0]])
            yield np.where(np.isfinite(path), path, np.array([[_NOWHERE], [0], [0]]))


def quintic(begin: Loop, end: Loop, width: float) -> Loop:
    """Return the coefficients (6, n), lowest first, of polynomials over 0 to 1 between two nodes (3, n)."""
    scale = np.array([1.0, width, 0.5 * width * width])[:, None]
    (p, v, a), (q, w, b) = scale * begin, scale * end
    way = q - p
    return np.stack(
        (
            p,
            v,
            a,
            10 * way - 6 * v - 4 * w - 3 * a + b,
            -15 * way + 8 * v + 7 * w + 3 * a - 2 * b,
            6 * way - 3 * (v + w) - a + b,
        )
    )


def _second(coefficients: Loop) -> Loop:
    """Return the coefficients of polynomials' second derivatives by the share of their stretch."""
    powers = np.arange(2, len(coefficients))
    return (powers * (powers - 1))[:, None] * coefficients[2:]


def evaluated(coefficients: Loop, share: Any) -> Any:
    """Return a polynomial's values at shares of its stretch, 0 to 1 (Horner)."""
    value = coefficients[-1]
    for one in coefficients[-2::-1]:
        value = value * share + one
    return value


def _parts(values: Loop) -> NDArray[np.float64]:
    """Return real and imaginary parts one after the other."""
    parts: NDArray[np.float64] = np.ascontiguousarray(values).view(np.float64)
    return parts


def packed(values: Any, kind: str) -> str:
    """Return numbers of a kind, such as "<f4", in base 64."""
    return base64.b64encode(np.ascontiguousarray(values, kind).tobytes()).decode("ascii")


# The moving parts of a picture: each group as SVG, with the data by which the page's script moves it.

Mover = dict[str, Any]
"""The data that moves a group: its `kind`, the points it follows, its measures in pixels, its colours."""


@frozen
class Movable:
    """A group as SVG, and the data that moves it; None where it stands still."""

    shapes: str
    mover: Mover | None = None
    transform: str = ""
    """Its place at the start."""

    def markup(self, moving: Iterator[int], known: dict[str, str]) -> str:
        """Return the group, with the next number if it moves.

        Shapes that are `known` are used again, by the id of the group that has them.
        """
        placed = f' transform="{self.transform}"' if self.transform else ""
        numbered = f' data-m="{next(moving)}"' if self.mover else ""
        shapes = self.shapes
        if shapes in known:
            shapes = f'<use href="#{known[shapes]}"/>'
        elif len(shapes) >= _SHARED:
            known[shapes] = f"s{len(known)}"
            shapes = f'<g id="{known[shapes]}">{shapes}</g>'
        return f"<g{placed}{numbered}>{shapes}</g>"


_SHARED = 100
"""The fewest bytes of shapes that are stored once where they occur again."""


@frozen
class Mobile:
    """A picture in both themes, whose groups move on a page."""

    light: Picture
    dark: Picture
    pairs: Pairs
    forces: Mover | None = None
    """The data of the arrows of forces."""

    @cached_property
    def _places(self) -> Places:
        """Where joints and centres of mass lie at the start."""
        pose, _ = self.light.poses(0.0)
        masses = {centre(body): self.light.view.pixel(at) for body, at in pose.com_position.items()}
        return {**self.light.drawing.places(pose), **masses}

    def movables(self) -> Iterator[Movable]:
        """Yield all that is drawn, back to front, in its place at the start."""
        pose, _ = self.light.poses(0.0)
        for one, other in zip(self.light.groups(pose), self.dark.groups(pose), strict=True):
            yield from self._movable(one, other, pose)

    def _movable(self, one: Group, other: Group, pose: Pose) -> Iterator[Movable]:
        match one.made_of, other.made_of:
            case Part() as part, Part() as dark:
                yield self._part(part, dark)
            case tuple() as parts, tuple() as darks:
                for both in zip(parts, darks, strict=True):
                    drawn = self._part(*both)
                    given = {"given": True} if one.name == "dimensions" else {}
                    yield replace(drawn, mover={**(drawn.mover or {}), **given})
            case Stamp() as stamp, Stamp() as dark:
                for body in pose.com_position:
                    at = centre(body)
                    put = (Part(at, at, at, some.layers) for some in (stamp, dark))
                    yield self._part(*put)
                yield from (Movable("", self._arrows(kind)) for kind in _KINDS)
                if self.forces:
                    yield Movable("", self.forces)
            case Names(), Names():
                yield from self._names()
            case dict() as lines, dict() as darks if self.light.names:
                for of, line in lines.items():
                    drawn = self._part(line, darks[of])
                    yield replace(drawn, mover={**(drawn.mover or {}), "named": True, "given": True})
            case (Coil() | Damping() | Trace() | Turning() | Sliding()) as live, dark:
                yield Movable("", self._live(one, live, dark))
            case _ if one.name == "ground-line":
                yield Movable("", self._level())
            case _ if one.name == "ground":
                yield from self._ground()
            case _:
                if shapes := self.pairs.elements(flat([one]), flat([other])):
                    yield Movable(shapes, {"kind": "given"} if one.name in _STATED else None)

    def _part(self, light: Part, dark: Part) -> Movable:
        described = self.pairs.outlined if light.sized else self.pairs.elements
        shapes = described(light.layers, dark.layers)
        mover = {"kind": "part", "at": light.at, "tail": light.tail, "head": light.head, **self._form(light)}
        link = link_words(self.light.scene).get(light.name)
        mover |= {"link": link} if link else {}
        turn, at = light.turn(self._places), self._places[light.at]
        matrix = (turn.real, turn.imag, -turn.imag, turn.real, at.real, at.imag)
        return Movable(shapes, mover, f"matrix({' '.join(f'{part:.7g}' for part in matrix)})")

    def _form(self, part: Part) -> Mover:
        """Return how a part's shape follows from lengths: which joints it reaches to, and its outlines.

        An outline that is rounded about some of the joints' places has a radius and their numbers, two for
        each joint: where it is nearest in the part's frame and where it is farthest; other outlines have 0.
        """
        if part.sized:
            return {"sized": list(part.sized)}
        names = list(dict.fromkeys((*part.joints, *part.reaches)))
        if len(names) < 2:
            return {}
        ends = np.concatenate([self._ends(part, name) for name in names])
        wheel = self.light.figure.scene.style(part.name).outline in WHEELS
        layers = (layer.loops for layer in part.layers if layer.loops)
        forms = [[_rounding(loop, ends, wheel=wheel) for loop in loops] for loops in layers]
        return {"reaches": names, "forms": forms}

    def _ends(self, part: Part, name: str) -> Loop:
        """Return both ends (2,) of a joint's way in a part's frame (pixels); alike for one fixed in it."""
        figure, view = self.light.figure, self.light.view
        known = (figure.cycle.position[one] for one in (part.at, part.tail, part.head, name))
        at, tail, head, joint = (view.scale * (np.atleast_2d(one) @ DOWN) for one in known)
        way: Loop = (joint - at) / (units(head - tail) if part.tail != part.head else 1)
        way = way[np.isfinite(way)]
        along = way.real if np.ptp(way.real) >= np.ptp(way.imag) else way.imag
        return way[[along.argmin(), along.argmax()]]

    def _ground(self) -> Iterator[Movable]:
        """Yield guides, rails and pedestals."""
        contexts = [one.drawing.setting for one in (self.light, self.dark)]
        rails = [[*rails_of(context)] for context in contexts]
        grounds = [context.theme.ground for context in contexts]
        guides = [fitting.guide for fitting in fittings(contexts[0]) if fitting.guide]
        gauge = contexts[0].gauge
        for guide, *loops in zip(guides, *rails, strict=True):
            layers = ([Layer(*both)] for both in zip(grounds, loops, strict=True))
            more = {"beyond": list(guide.beyond), "aside": guide.aside, "closed": guide.head}
            size = {"bar": gauge.bar, "line": gauge.line, "colour": self.pairs.variable(*grounds)}
            mover = {"kind": "rails", "at": guide.joint, "along": _pair(guide.along), **more, **size}
            yield Movable(self.pairs.elements(*layers), mover)
        under = [[Layer(one.theme.ground, loops) for loops in rails_under(one)] for one in contexts]
        if shapes := self.pairs.elements(*under):
            yield Movable(shapes)
        for name in contexts[0].figure.fixed:
            feet = (pedestal(0j, away(one.figure, name), one.gauge, one.theme) for one in contexts)
            yield self._part(*(Part(name, name, name, foot) for foot in feet))

    def _level(self) -> Mover:
        """Return the data of the ground's line, from pivot to pivot."""
        colour = self.pairs.variable(self.light.theme.ground, self.dark.theme.ground)
        names = list(pivots(self.light.figure))
        return {"kind": "level", "names": names, "line": self.light.gauge.line, "colour": colour}

    def _names(self) -> Iterator[Movable]:
        """Yield the labels, each about 0."""
        pictures, lines = (self.light, self.dark), list[list[Caption]]()
        for picture in pictures:
            placed = picture.names.captions(
                picture.drawing.places(picture.poses(0.0)[0]), picture.drawing.setting
            )
            lines.append([line._replace(at=(0.0, -0.5 * line.size)) for line in placed])
        for label, *both in zip(self.light.names.labels, *lines, strict=True):
            shapes = self.pairs.elements(*([line] for line in both))
            given = {"given": True} if label.of.startswith(_OF_LENGTHS) else {}
            yield Movable(shapes, {"kind": "label", **_placed(label), **given})

    def _live(self, group: Group, light: Any, dark: Any) -> Mover:
        """Return the data of what the script draws anew at every pose."""
        match light:
            case Coil():
                return self._coil(light, dark)
            case Damping():
                return self._damping(light, dark)
            case Trace():
                kind, width = ("curve" if group.still else "recent"), light.width
                colours = self.pairs.variables((light.back, *light.shades), (dark.back, *dark.shades))
                recent = {"phase": RECENT, "swell": SWELL}
                return {"kind": kind, "at": light.joint, "width": width, "colours": colours} | recent
            case Sliding():
                along = _pair(light.along)
                more = {"kind": "sliding", "at": light.joint, "along": along, "room": light.room}
                return {**more, "longest": light.longest, **self._driven(light, dark)}
        bar = {"kind": "turning", "pivot": light.pivot, "pin": light.pin, "arc": light.arc}
        reach = {"arrow": light.arrow, "middle": light.middle, "sweep": SWEEP, "ahead": AHEAD}
        return {**bar, **reach, "angle": self.light.look.names > 1, **self._driven(light, dark)}

    def _driven(self, light: Any, dark: Any) -> Mover:
        colours = self.pairs.variables(light.colours, dark.colours)
        drive = self.light.scene.linkage.drive
        read = abs(drive.speed) / drive.coordinate.displayed(1.0)
        return {"gain": read / light.fastest, "line": light.gauge.line, "colours": colours}

    def _coil(self, light: Coil, dark: Coil) -> Mover:
        ends = dict(zip(light.between, (0j, 1 + 0j), strict=True))
        both = ([layer.colour for layer in coil.layers(ends)] for coil in (light, dark))
        between, widths = list(light.between), [wide * light.wire for wide in (BACK, EDGE, CORE)]
        size = {"radius": light.radius, "lead": light.lead, "coils": light.coils, "widths": widths}
        return {
            "kind": "coil", "between": between, **size, "tilt": TILT, "colours": self.pairs.variables(*both)
        }  # fmt: skip

    def _damping(self, light: Damping, dark: Damping) -> Mover:
        barrel = self.pairs.elements(light.cylinder, dark.cylinder)
        head = self.pairs.elements([light.head], [dark.head])
        colour = self.pairs.variable(light.cylinder[0].colour, dark.cylinder[0].colour)
        size = {
            "reach": [light.shortest, light.longest],
            "length": light.length,
            "rod": light.rod,
            "colour": colour,
        }
        return {"kind": "damping", "between": list(light.between), **size, "barrel": barrel, "head": head}

    def _arrows(self, kind: Kind) -> Mover:
        """Return the data of arrows, of which the `usual` first are shown, others while they are asked for.

        `gain` is their length for a rate of 1 pixel/rad (or /rad²) of phase.
        """
        scene, sides = self.light.scene, (self.light, self.dark)
        light, dark = (arrows_of(one.figure, kind, one.size[1], one.gauge, one.theme) for one in sides)
        order = light.order
        gain = light.scale(light.drive) * abs(light.drive) ** order / self.light.view.scale
        colours = self.pairs.variables((light.colour, light.halo), (dark.colour, dark.halo))
        usual = [*scene.trace, *(centre(body.name) for body in scene.linkage.bodies if body.com is not None)]
        feet = [*usual, *(name for name in self.light.figure.moving if name not in usual)]
        size = {"longest": light.longest, "drawn": light.longest_drawn, "line": light.gauge.line}
        known = {"colours": colours, "words": said(light.words), "unit": light.unit}
        return {
            "kind": "arrows",
            "order": order,
            "at": feet,
            "usual": len(usual),
            "gain": gain,
            **size,
            **known,
        }


def shares_of(picture: Picture, body: str, place: tuple[float, float]) -> tuple[str, str, list[float]]:
    """Return a body's place at the start by two joints, as shares of the way between them and to its right.

    Of a body with one joint they are alike, and the place is so many pixels off.
    """
    pose, pose_places = picture.scene.pose(0.0, 0), picture.scene.linkage.body(body)
    joints = pose_places.joints or (str(pose_places.slider),)
    ends = [picture.view.pixel(pose.position[name]) for name in joints]
    off = picture.view.pixel(place) - ends[0]
    share = off / (ends[1] - ends[0]) if len(ends) > 1 else off
    return joints[0], joints[min(1, len(ends) - 1)], _pair(share)


def _placed(label: Label) -> Mover:
    """Return a label's place: the parts of its anchor, as numbers and arrays; what is not is left out."""
    assert label.anchor is not None
    at, head, base, way, reach, flat_, turns = label.anchor
    ways = {"base": _pair(base), "way": _pair(way), "size": list(label.size)}
    bent = {name: True for name, given in (("flat", flat_), ("turns", turns)) if given}
    return {"at": at, "head": head, **ways, "reach": reach, **bent, "font": label.line}


def _rounding(loop: Loop, ends: Loop, *, wheel: bool) -> Any:
    """Return a rounded outline's radius, below 0 for a hole, and the numbers of its ends; else 0.

    Of a wheel that reaches beyond all ends, it is how far, and a third entry says so.
    """
    loop = np.asarray(loop)
    side = 1 if (np.conj(loop) * np.roll(loop, -1)).imag.sum() > 0 else -1
    off = np.abs(loop[:, None] - ends)
    round_ = np.ptp(off, axis=0) <= _ROUNDED  # a disc about one end may reach beyond others
    radius, near = off.min(axis=1), off.argmin(axis=1)
    if round_.any():
        near = np.full(len(loop), round_.argmax())
        radius = off[:, near[0]]
    if np.ptp(radius) > _ROUNDED:
        return 0
    numbers = sorted({*near.tolist()})
    size = round(side * float(radius.mean()), 3)
    reach = float(np.abs(ends).max())
    if wheel and len(numbers) == 1 and abs(size) > 0.8 * reach:
        return [round(size - side * reach, 3), numbers, side]
    return [size, numbers]


def _pair(value: Any) -> list[float]:
    return [float(np.real(value)), float(np.imag(value))]
