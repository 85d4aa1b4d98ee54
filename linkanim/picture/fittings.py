"""Draw what joints need in addition to bars and pins, springs and dampers, and what stands still.

A joint's fittings are, for example, a slider's block and its guide. A spring's pitch follows its length, a
damper's piston slides. The ground has hatched pedestals under fixed pins, and the guides of sliders.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property, lru_cache
from itertools import pairwise
from math import frexp, pi, sin
from typing import NamedTuple

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Damper, Joint, Line, Slide, Spring, holding
from linkanim.mechanics.motion import Pose
from linkanim.picture.figure import DOWN, DrawContext, Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Layer, Loop, Outlines
from linkanim.picture.shapes import (
    DASH_DOT,
    MOST_MARKS,
    Part,
    Places,
    box,
    cut_ribbon,
    dashes,
    directions,
    length,
    lengths,
    lined,
    offsets,
    ribbon,
    rod,
    rounded,
    segments,
    slotted,
    stroke,
    unit,
)
from linkanim.picture.theme import LIGHT, Theme, mixed
from linkanim.picture.view import View

# Springs, whose pitch follows their length, and dampers, whose piston slides.

_COILS = (4, 20)
"""The least and the greatest number of coils of a spring; its shortest length decides."""
TILT = 0.15
"""How far a coil's front stands forward of its side, as a share of its radius."""
BACK, EDGE, CORE = 1.9, 2.6, 1.5
"""Widths of the far halves of coils, and of the near ones with and without outline, in widths of the wire."""
_WOUND = 8.5
"""The least step from coil to coil where a spring is shortest, in widths of a thin line."""
_CYLINDER = 0.6
"""The least length of the barrel of a cylinder that holds or drives, as a share of its retracted length."""
_BARREL = 0.95
"""The half width of a damper's or cylinder's barrel, in half widths of a bar."""


def spans(figure: Figure, view: View, item: Spring | Damper) -> tuple[float, float]:
    """Return how short and how long a spring or damper becomes over a cycle, in pixels."""
    one, other = (figure.path(name, view) for name in item.between)
    apart = lengths(one - other)
    return float(np.nanmin(apart)), float(np.nanmax(apart))


@frozen
class Coil:
    """A spring to draw: its radius and the straight length at either end in pixels, its coils."""

    between: tuple[str, str]
    radius: float
    lead: float
    coils: int
    gauge: Gauge
    theme: Theme

    def layers(self, places: Places) -> list[Layer]:
        """Return the far halves of the coils, then the near ones over them."""
        start, end = (places[name] for name in self.between)
        span, turn = length(end - start), unit(end - start)
        lead = min(self.lead, 0.2 * span)
        pitch = (span - 2 * lead) / self.coils
        feet = np.asarray(start + turn * (lead + pitch * np.arange(self.coils)), np.complex128)
        wire = self.wire
        along, round_ = self._halves
        halves = turn * (pitch * along + round_)
        far, near = zip(halves, offsets(halves), strict=True)
        # the outlines of the near halves hide the ends of the far ones
        shade = mixed(self.theme.metal, self.theme.background, 0.3)
        layers = [Layer(shade, [cut_ribbon(*far, BACK * wire)]).repeated(feet)]
        for colour, width in ((self.theme.outline, EDGE * wire), (self.theme.metal, CORE * wire)):
            (one, other), coil = _leads(lead, self.radius, width), ribbon(*near, width)
            points = start + turn * one, end + turn * other, np.add.outer(feet, coil).ravel()
            counts = len(one), len(other), *[len(coil)] * self.coils
            layers.append(Layer(colour, Outlines(np.concatenate(points), counts)))
        return layers

    @property
    def wire(self) -> float:
        """The width of the spring's wire, in pixels."""
        return 1.5 * self.gauge.line

    @cached_property
    def _halves(self) -> tuple[Loop, Loop]:
        """The far and the near half of a coil, for a spring along the real axis."""
        along = np.add.outer([0.5, 0.0], np.linspace(0, 0.5, 13))
        facing = directions(2 * pi * along - pi / 2)
        about = self.radius * (TILT * facing.real + 1j * facing.imag)
        return along.astype(np.complex128), about.astype(np.complex128)


@lru_cache(maxsize=16)
def _leads(lead: float, radius: float, width: float) -> tuple[Loop, Loop]:
    """Return the wire at both ends of a spring along the real axis, each drawn about 0."""
    share = np.linspace(0.0, 1.0, 13)
    rise = share * share * (3 - 2 * share)
    (first,) = stroke(lead * share - 1j * radius * rise, width)
    return first, -first.conj()[::-1]


@frozen
class Damping:
    """A damper to draw: its shortest and longest length, its cylinder's length and start, in pixels.

    `cylinder` lies along the real axis from its closed end at 0, `head` about 0.
    """

    between: tuple[str, str]
    shortest: float
    longest: float
    length: float
    foot: float
    rod: float
    cylinder: tuple[Layer, Layer]
    head: Layer

    def layers(self, places: Places) -> list[Layer]:
        """Return cylinder, rods and piston; the piston stands deeper the shorter the damper is."""
        start, end = (places[name] for name in self.between)
        span, turn = length(end - start), unit(end - start)
        piston = self.foot + self._piston(span)
        rods = [rod(piston, max(span, piston), self.rod / 2), rod(0.0, self.foot, self.rod / 2)]
        return [
            *(layer.placed(start + turn * self.foot, turn) for layer in self.cylinder),
            Layer(self.cylinder[0].colour, rods).placed(start, turn),
            self.head.placed(start + turn * piston, turn),
        ]

    def _piston(self, span: float) -> float:
        """Return where in the cylinder the piston stands, in pixels from its closed end."""
        swept = self.longest - self.shortest
        share = (span - self.shortest) / swept if swept > 0 else 0.5
        return self.length * (0.16 + 0.68 * min(max(share, 0.0), 1.0))


def coils(context: DrawContext) -> tuple[Coil, ...]:
    """Return the scene's springs."""
    figure, view, gauge, theme = context.known
    lead, coils = 1.5 * gauge.bar, []
    for item in figure.linkage.springs:
        room = spans(figure, view, item)[0] - 2 * lead
        count = min(max(int(room / (_WOUND * gauge.line)), _COILS[0]), _COILS[1])
        coils.append(Coil(item.between, 1.15 * gauge.bar, lead, count, gauge, theme))
    return tuple(coils)


def dampings(context: DrawContext) -> tuple[Damping, ...]:
    """Return the scene's dampers and driving cylinder; each barrel takes the stroke where there is room."""
    figure, view, gauge, theme = context.known
    dampings = []
    for item in figure.cylinders:
        shortest, longest = spans(figure, view, item)
        needed = (longest - shortest) / 0.68
        least = 5 * gauge.bar if item.forceful else max(5 * gauge.bar, _CYLINDER * shortest)
        length = min(max(needed, least), max(0.8 * shortest, 2 * gauge.bar))
        foot = max(0.5 * (shortest - length), 0.0) * 0.6
        dampings.append(damping(item.between, (shortest, longest), (length, foot), gauge, theme))
    return tuple(dampings)


def damping(
    between: tuple[str, str], span: tuple[float, float], size: tuple[float, float], gauge: Gauge, theme: Theme
) -> Damping:
    """Return a damper of a shortest and longest `span`.

    `size` is its cylinder's length and distance from the first joint, in pixels.
    """
    (length, foot), radius = size, _BARREL * gauge.bar
    cylinder = barrel(0.0, length, radius, gauge, theme)
    head = piston(0.16 * length, radius, gauge, theme)
    return Damping(between, *span, length, foot, 2.4 * gauge.line, cylinder, head)


def barrel(near: float, far: float, radius: float, gauge: Gauge, theme: Theme) -> tuple[Layer, Layer]:
    """Return a cylinder along the real axis: its wall, and its inside."""
    length, middle, edge = far - near, (near + far) / 2, gauge.outline
    wall = box(length, 2 * radius, 0.25 * radius) + middle
    inside = box(length - 2 * edge, 2 * (radius - edge), 0.2 * radius) + middle
    hollow = mixed(theme.metal, theme.background, 0.72)
    return Layer(theme.outline, [wall]), Layer(hollow, [inside])


def piston(length: float, radius: float, gauge: Gauge, theme: Theme) -> Layer:
    """Return the piston about 0 that fits into a cylinder along the real axis."""
    return Layer(theme.metal, [box(length, 2 * radius - 3 * gauge.outline, 0.1 * radius)])


# Fittings: what a joint needs in addition to bars and pins, such as a slider's block and its guide.
#
# They follow from what slides along what, not from the joint's kind.

_TRIED = 90
"""The number of poses of a cycle that tell how far a fitting extends."""
_LARGE = 20
"""A scene larger than 2 to this power, in its unit, is scaled down first."""
_BLOCK = (4.6, 3.2)
"""A slider block's length and height in half widths of a bar."""
SLOTTED, SLOT = 1.35, 0.5
"""Half the widths of a slotted bar and of its slot, in half widths of a bar."""
ROD, BARREL = 0.6, 1.2
"""Half the widths of a rod that slides through a swivel, and of its cylinder, in half widths of a bar."""
PISTON = 1.1
"""The length of the piston at the rod's end, in half widths of a bar."""
_BORE = 1.5
"""The width of an engine's cylinder, in widths that the rod sweeps at its open end."""
_CROWN, _SKIRT = 0.8, 0.55
"""How far an engine's piston extends ahead of its pin and behind it, in half widths of its cylinder."""
_RINGS, _HEAD = (0.5, 0.72), 1.3
"""Where a piston's rings are, and the cylinder's head at the outer dead centre, in pin-to-crown lengths."""


@frozen
class Bar:
    """How a joint changes the bar between two joints: into a slotted bar, or a rod with a piston.

    `slot` has the slot's ends in pixels, the bar's first joint at 0 and the other one on the real axis.
    Without a slot the bar is a rod, with or without a `piston` at its end.
    """

    ends: tuple[str, str]
    slot: tuple[complex, complex] | None = None
    piston: bool = False
    reaches: tuple[str, ...] = ()
    """The joint that travels in its slot."""

    def slotted(self, context: DrawContext) -> Part:
        """Return its slot as a part: the bar is as long as that needs."""
        wide = rounded([*(self.slot or (0j,))], SLOTTED * context.gauge.bar)
        return Part(self.ends[0], *self.ends, (Layer(context.theme.metal, [wide]),))


_Line = tuple[complex, complex]
"""Both ends of a line in pixels."""


class _Channel(NamedTuple):
    """A guide in its place, in pixels: the middles of its ends, half its width, and its lines.

    Each line stands with the side of it that is hatched.
    """

    begin: complex
    end: complex
    aside: float
    lines: list[tuple[_Line, int]]

    def off(self, lines: Iterable[_Line]) -> list[_Line]:
        """Return the parts of some lines outside it."""
        return [part for line in lines for part in self._outside(*line)]

    def _outside(self, begin: complex, end: complex) -> Iterator[_Line]:
        """Yield the parts of a line before and beyond it; the whole line where the two do not cross."""
        along, long = unit(self.end - self.begin), abs(self.end - self.begin)
        first, last = ((place - self.begin) / along for place in (begin, end))
        if first.imag * last.imag >= 0 or min(abs(first.imag), abs(last.imag)) < self.aside:
            yield begin, end
            return
        where = first.imag / (first.imag - last.imag)
        half = self.aside / abs(first.imag - last.imag)
        if not 0 < (first + where * (last - first)).real < long:
            yield begin, end
            return
        yield begin, begin + (where - half) * (end - begin)
        yield begin + (where + half) * (end - begin), end


class GuideRails(NamedTuple):
    """Two lines on the ground and the joint that travels between them: `along`, y down, has length 1.

    The lines lie `aside` of the line of travel, and extend `beyond` its two ends, all in pixels; with a
    `head` they are a cylinder that is closed at its far end.
    """

    joint: str
    along: complex
    aside: float
    beyond: tuple[float, float]
    head: bool = False

    def channel(self, context: DrawContext) -> _Channel:
        """Return it as long as the joint's travel needs."""
        path = context.figure.path(self.joint, context.view) * np.conj(self.along)
        travel, across = path.real, 1j * float(np.nanmean(path.imag))
        begin = self.along * (float(np.nanmin(travel)) - self.beyond[0] + across)
        end = self.along * (float(np.nanmax(travel)) + self.beyond[1] + across)
        off = 1j * self.along * self.aside
        lines = [((begin + side * off, end + side * off), side) for side in (1, -1)]
        head = [((end + off, end - off), 1)] if self.head else []
        return _Channel(begin, end, self.aside, lines + head)


@frozen
class Fitting:
    """What a joint adds to the picture: parts behind the bodies and before them, its guide on the ground.

    `bar` is how it changes its bar.
    """

    behind: tuple[Part, ...] = ()
    before: tuple[Part, ...] = ()
    guide: GuideRails | None = None
    bar: Bar | None = None


def fittings(context: DrawContext) -> tuple[Fitting, ...]:
    """Return the fittings of all joints that have some, in the joints' order."""
    sliding = [(joint, joint.slides) for joint in context.figure.linkage.joints]
    return tuple(one for joint, slides in sliding if slides for one in _fitted(joint, slides, context))


def _fitted(joint: Joint, slides: Sequence[Slide], context: DrawContext) -> Iterator[Fitting]:
    """Yield what a joint adds by what slides: itself on lines, a pin in its own bar's slot, or both."""
    own = [slide for slide in slides if slide.point == joint.name]
    others = [slide for slide in slides if slide.point != joint.name]
    if own and others:
        yield _yoke(own[0], others[0], context)
    elif others:
        yield _slotted(others[0], context)
    else:
        yield from (_slider(joint, slide.line, context) for slide in own)


def outlines(figure: Figure, still: Pose | None = None) -> Iterator[tuple[Loop, Loop, Loop]]:
    """Yield the outlines of slotted bars and guides, drawn thin, and the places and directions of each.

    All are x + yi in the scene's unit, y up, at some of the cycle's moments or in one pose, without moments
    at which a joint is NaN.
    """
    # A power of two keeps every digit; arcs have as many points as their size in pixels asks for.
    scale = 2.0 ** -max(frexp(figure.extent)[1] - _LARGE, 0)
    thin = scale * 1e-6 * max(figure.shortest, 1e-6 * figure.extent)
    context = DrawContext(figure, View(scale, 0.0, 0.0), Gauge(thin, thin / 8, thin, thin), LIGHT)
    known = fittings(context)
    parts = [part for fitting in known for part in (*fitting.behind, *fitting.before)]
    parts += [fitting.bar.slotted(context) for fitting in known if fitting.bar]
    step = max(len(figure.cycle.phase) // _TRIED, 1)
    for fitting in known:
        if fitting.guide and fitting.guide.head:
            ends = [end for line, _ in fitting.guide.channel(context).lines for end in line]
            yield (
                np.array(ends, np.complex128).conj() / scale,
                np.zeros(1, np.complex128),
                np.ones(1, np.complex128),
            )
    for part in parts:
        at, tail, head = (
            (
                np.array([still.position[name]])
                if still
                else np.atleast_2d(figure.cycle.position[name])[::step]
            )
            @ DOWN.conj()
            for name in (part.at, part.tail, part.head)
        )
        arrow = head - tail
        turn = np.where(arrow == 0, 1, arrow / np.where(arrow == 0, 1, lengths(arrow)))
        known = np.isfinite(at + arrow)
        for loop in (loop for layer in part.layers for loop in layer.loops):
            yield loop.conj() / scale, at[known], turn[known]


def hatched(begin: complex, end: complex, gauge: Gauge, side: int) -> Iterator[Loop]:
    """Yield a line and its hatching to one side (+1: where the imaginary part grows for a line along 1)."""
    along = unit(end - begin)
    length, step = abs(end - begin), 0.62 * gauge.bar
    count = max(round(min(length / step, MOST_MARKS)), 1)
    feet = begin + along * length * (np.arange(count) + 0.75) / count
    yield from segments(begin, end, 1.4 * gauge.line)
    yield from segments(feet, feet + along * (-0.5 + 0.62j * side) * gauge.bar, 0.8 * gauge.line)


def _slider(joint: Joint, line: Line, context: DrawContext) -> Fitting:
    """Return a block between rails on the ground, or a small one in the slot of a body that carries it.

    A slider that drives has the colour of the driven part.
    """
    along, name = complex(directions(-line.angle)), joint.name
    if line.on is not None:
        block = Part(name, *line.on, _block(context, along, 0.62), (name,))
        bar = _own_slot(name, line, context)
        if bar:
            return Fitting(before=(block,), bar=bar)
        guide, slot = _carried_slot(name, line, along, context)
        return Fitting(behind=(guide,), before=(slot, block))
    bodies = (body for body in context.figure.linkage.bodies if body.slider == name)
    if joint.bars and any(context.figure.scene.style(body.name).outline == "piston" for body in bodies):
        return _cylindered(name, joint.bars[0][0], along, context)
    rim, metal = _block(context, along)
    if name == context.figure.linkage.drive.joint:
        metal = Layer(context.theme.bodies[0], metal.loops)
    block = Part(name, name, name, (rim, metal), (name,))
    return Fitting(behind=(block,), guide=_rails(name, along, context.gauge))


def _cylindered(name: str, far: str, along: complex, context: DrawContext) -> Fitting:
    """Return a piston in a cylinder, wide enough for its rod to `far`; its head is at the other end."""
    gauge, paths = context.gauge, (context.figure.path(end, context.view) for end in (name, far))
    place, end = (path * np.conj(along) for path in paths)
    out = along if np.nanmean((place - end).real) > 0 else -along
    slid, rod = place * np.conj(out / along), (end - place) * np.conj(out / along)
    # the rod's offset from the axis at the open end of the cylinder
    share = np.minimum((slid.real - np.nanmin(slid.real)) / np.maximum(-rod.real, 1e-9), 1.0)
    aside = max(_BORE * float(np.nanmax(np.abs(share * rod.imag))), _reach_of_rails(gauge))
    crown, skirt, edge = _CROWN * aside, _SKIRT * aside, gauge.outline
    wide, middle = 2 * (aside - gauge.line), (crown - skirt) / 2
    outer = box(crown + skirt, wide, 0.4 * gauge.bar) + middle
    inner = box(crown + skirt - 2 * edge, wide - 2 * edge, 0.3 * gauge.bar) + middle
    rings = [box(2 * edge, wide - 2 * edge) + share * crown for share in _RINGS]
    theme = context.theme
    shapes = ((theme.outline, [outer]), (theme.metal, [inner]), (theme.outline, rings))
    layers = tuple(Layer(*shape).placed(0j, out) for shape in shapes)
    block = Part(name, name, name, layers, (name,))
    return Fitting((block,), guide=GuideRails(name, out, aside, (0.0, _HEAD * crown), head=True))


_ALONG = 1e-9
"""By how much, as a share of its length, a bar's joints may lie beside a line that is its own axis."""


def _own_slot(name: str, line: Line, context: DrawContext) -> Bar | None:
    """Return the bar along whose own axis a line runs, with its slot; None where a body carries the line."""
    assert line.on is not None
    linkage, places = context.figure.linkage, context.figure.cycle.position
    carrier = next((body.joints for body in linkage.bodies if {*line.on} <= {*body.joints}), ())
    n = holding(linkage.rigid_bodies, carrier) if carrier else None
    if n is None or abs(sin(line.angle)) > _ALONG or line.through != line.on[0]:
        return None
    shape = linkage.rigid_bodies[n]
    start, end = (shape[joint] for joint in line.on)
    aside = [line.offset, *(((shape[joint] - start) / unit(end - start)).imag for joint in carrier)]
    if max(map(abs, aside)) > _ALONG * abs(end - start):
        return None
    slid = (places[name] - places[line.through]) @ DOWN * np.conj(_facing(line, context))
    near, far = (context.view.scale * float(way) for way in (np.nanmin(slid.real), np.nanmax(slid.real)))
    return Bar(line.on, (complex(near), complex(far)), reaches=(name,))


def _carried_slot(name: str, line: Line, along: complex, context: DrawContext) -> tuple[Part, Part]:
    """Return the bar that a body carries along a line, from the joint it runs through, and the slot in it."""
    assert line.on is not None
    gauge, theme, scale = context.gauge, context.theme, context.view.scale
    places = context.figure.cycle.position
    seen = (places[name] - places[line.through]) @ DOWN * np.conj(_facing(line, context) * along)
    foot = -1j * along * line.offset * scale
    near, far = (foot + along * scale * float(way) for way in (np.nanmin(seen.real), np.nanmax(seen.real)))
    colours = theme.outline, theme.metal
    arm = lined([0j, foot], gauge.bar, gauge.outline, colours) if line.offset else []
    bar = lined([foot, near, far], SLOTTED * gauge.bar, gauge.outline, colours)
    hollow = lined([near, far], SLOT * gauge.bar, gauge.outline, (theme.outline, theme.background))
    joints = (line.through, *line.on)
    return Part(*joints, (*arm, *bar), (line.through,)), Part(*joints, tuple(hollow))


def _block(context: DrawContext, turn: complex = 1 + 0j, share: float = 1.0) -> tuple[Layer, ...]:
    return block_layers(context.gauge, context.theme, turn, share)


def block_layers(gauge: Gauge, theme: Theme, turn: complex, share: float = 1.0) -> tuple[Layer, ...]:
    """Return a slider's block about 0 that slides along the direction `turn`; `share` scales its size."""
    length, height = (share * side * gauge.bar for side in _BLOCK)
    edge, corner = 2 * share * gauge.outline, share * gauge.bar
    outer, inner = box(length, height, 0.4 * corner), box(length - edge, height - edge, 0.3 * corner)
    return Layer(theme.outline, [turn * outer]), Layer(theme.metal, [turn * inner])


def rails_of(context: DrawContext) -> Iterator[list[Loop]]:
    """Yield the lines of each guide on the ground; they are open where another guide crosses them."""
    places = [fitting.guide.channel(context) for fitting in fittings(context) if fitting.guide]
    for place in places:
        rails = list[Loop]()
        for line, side in place.lines:
            parts = [line]
            for other in places:
                parts = other.off(parts) if other is not place else parts
            rails += [loop for part in parts for loop in hatched(*part, context.gauge, side)]
        yield rails


def rail_reach(context: DrawContext, joint: str) -> float:
    """Return how far the rails of a joint lie from its line of travel; 0 where it has none on the ground."""
    guides = (one.guide for one in fittings(context) if one.guide)
    return next((guide.aside for guide in guides if guide.joint == joint), 0.0)


def _rails(name: str, along: complex, gauge: Gauge) -> GuideRails:
    """Return the guide of a block."""
    beyond = (_BLOCK[0] / 2 + 0.9) * gauge.bar
    return GuideRails(name, along, _reach_of_rails(gauge), (beyond, beyond))


def _reach_of_rails(gauge: Gauge) -> float:
    return (_BLOCK[1] / 2) * gauge.bar + gauge.line


def _facing(line: Line, context: DrawContext) -> Loop:
    """Return the direction of a line's axis over the cycle, y down; 1 for a line on the ground."""
    if line.on is None:
        return np.ones(1, np.complex128)
    start, end = (context.figure.cycle.position[name] for name in line.on)
    vector = (end - start) @ DOWN
    facing: Loop = vector / lengths(vector)
    return facing


def _slotted(slide: Slide, context: DrawContext) -> Fitting:
    """Return the slot in the bar, and the collar that slides in it and turns with it.

    Where the collar is on the ground, the bar slides instead: a rod through a swivel.
    """
    assert slide.axis is not None
    collar = Part(slide.point, *slide.axis, _block(context, share=0.62), (slide.point,))
    if context.figure.linkage.joint(slide.point).fixed:
        return _swivelled(slide, slide.axis, collar, context)
    return Fitting(before=(collar,), bar=Bar(slide.axis, _slot_ends(slide, context), reaches=(slide.point,)))


def _swivelled(slide: Slide, bar: tuple[str, str], collar: Part, context: DrawContext) -> Fitting:
    """Return the fitting that makes the bar a rod; where its end is free, with a piston in a cylinder."""
    if bar[1] in context.figure.pins:
        return Fitting(before=(collar,), bar=Bar(bar))
    gauge, (near, far) = context.gauge, _slot_ends(slide, context)
    long, room = dict(context.figure.linkage.joint(bar[1]).bars)[bar[0]], 0.8 * gauge.bar
    length = context.view.scale * long
    ends = min(length - far.real, 0.0) - room, max(length - near.real, 0.0) + room
    wall = barrel(*ends, BARREL * gauge.bar, gauge, context.theme)
    layers = tuple(layer.placed(complex(0, -near.imag)) for layer in wall)
    cylinder = Part(slide.point, *bar, layers, (slide.point,), reaches=(bar[1],))
    return Fitting(behind=(cylinder,), before=(collar,), bar=Bar(bar, piston=True))


def _slot_ends(slide: Slide, context: DrawContext) -> tuple[complex, complex]:
    """Return the ends of a slot in pixels, the pivot at 0 and the bar along the real axis."""
    places, offset = context.figure.cycle.position, slide.line.offset
    square = np.sum((places[slide.point] - places[slide.line.through]) ** 2, axis=-1)
    along = np.sqrt(np.maximum(square - offset**2, 0))
    side = -1j * offset
    return context.view.scale * (np.nanmin(along) + side), context.view.scale * (np.nanmax(along) + side)


def _yoke(guided: Slide, slot: Slide, context: DrawContext) -> Fitting:
    """Return a block between rails with a slotted bar across it, and the collar that the pin turns in."""
    gauge, theme, scale = context.gauge, context.theme, context.view.scale
    places, line, name = context.figure.cycle.position, guided.line, guided.point
    along, across = (complex(directions(-angle)) for angle in (line.angle, slot.line.angle))
    apart = (places[slot.point] - places[name]) @ DOWN
    travel = np.real(apart * np.conj(across * _facing(line, context)))
    ends = scale * float(np.nanmin(travel)) * across, scale * float(np.nanmax(travel)) * across
    colours = theme.outline, theme.metal
    widths = SLOTTED * gauge.bar, SLOT * gauge.bar
    bar = slotted([0j, *ends], ends, widths, gauge.outline, colours)
    carriers = line.on or (name, name)
    yoke = Part(name, *carriers, (*_block(context, along), *bar), reaches=(slot.point,))
    collar = Part(slot.point, *carriers, _block(context, across, 0.62), (slot.point,))
    if line.on is None:
        return Fitting((yoke,), (collar,), _rails(name, along, gauge))
    behind, before = _carried_slot(name, line, along, context)
    return Fitting((behind, before, yoke), (collar,))


# What stands still: pedestals with their hatching under fixed pins, and the guides of sliders.


def ground_layers(context: DrawContext, pins: Collection[str] | None = None) -> list[Layer]:
    """Return guides, and the pedestals of fixed `pins`, of all where none are named."""
    figure, view, gauge, theme = context.known
    rails = *rails_of(context), *rails_under(context)
    layers = [Layer(theme.ground, [loop for rail in rails for loop in rail])]
    for name in figure.fixed if pins is None else pins:
        layers += pedestal(figure.pixel(name, view), away(figure, name), gauge, theme)
    return layers


def rails_under(context: DrawContext) -> Iterator[list[Loop]]:
    """Yield the outlines of the rails under wheels on fixed pins, one rail for all wheels of one level."""
    figure, view, gauge, _ = context.known
    feet: dict[float, list[complex]] = {}
    for body in figure.bodies:
        if figure.scene.style(body.name).outline == "railwheel" and body.joints[0] in figure.fixed:
            radius = view.scale * figure.wheel_reach(body)
            foot = figure.pixel(body.joints[0], view) + 1j * radius
            feet.setdefault(round(foot.imag, 3), []).extend((foot - radius, foot + radius))
    for ends in feet.values():
        yield list(hatched(min(ends, key=np.real), max(ends, key=np.real), gauge, 1))


def away(figure: Figure, name: str) -> complex:
    """Return a pedestal's direction: down; away from their pull where it holds only springs and dampers."""
    struts = [strut for strut in figure.struts if name in strut.between]
    jointed = any(name in body.joints for body in figure.bodies)
    if jointed or not struts:
        return 1j
    other = next(end for end in struts[0].between if end != name)
    x, y = np.nanmean(np.atleast_2d(figure.cycle.position[other]), axis=0)
    here = figure.start(name)
    pull = unit(complex(float(x) - here.real, here.imag - float(y)))
    return -pull


def ground_line(names: Sequence[str], context: DrawContext) -> list[Layer]:
    """Return the line of the ground from pivot to pivot, in dashes and dots."""
    figure, view, gauge, theme = context.known
    loops = []
    for one, other in pairwise(figure.pixel(name, view) for name in names):
        loops += dashes(one, other, 9 * gauge.line, 0.8 * gauge.line, DASH_DOT)
    return [Layer(theme.ground, loops)]


def pedestal_corners(context: DrawContext, name: str) -> list[complex]:
    """Return the corners of a triangle that holds a pedestal: its pin, and the ends of its hatching."""
    figure, view, gauge, _ = context.known
    pin, turn = figure.pixel(name, view), away(figure, name) / 1j
    wide, deep = 1.35 * 1.75 * gauge.bar + 0.5 * gauge.bar, 3.1 * gauge.bar
    return [pin, pin + turn * complex(-wide, deep), pin + turn * complex(wide, deep)]


@lru_cache(maxsize=32)
def pedestal(pin: complex, away: complex, gauge: Gauge, theme: Theme) -> tuple[Layer, ...]:
    """Return a fixed pin's foot, in pixels: it widens from the pin to a hatched line, in a direction."""
    deep, wide, bar = 2.1 * gauge.bar, 1.75 * gauge.bar, gauge.bar
    foot = [0j, complex(-0.85 * wide, deep), complex(0.85 * wide, deep)]
    turn = away / 1j
    shape = [pin + turn * rounded(foot, 0.35 * bar)]
    inner = [pin + turn * rounded(foot, max(0.35 * bar - gauge.outline, 0.1))]
    base = complex(-1.35 * wide, deep + 0.35 * bar), complex(1.35 * wide, deep + 0.35 * bar)
    lines = [pin + turn * loop for loop in hatched(*base, gauge, 1)]
    return Layer(theme.ground, lines), Layer(theme.outline, shape), Layer(theme.gear, inner)
