"""Fittings: what a joint needs beside bars and pins, such as a slider's block and its guide.

They follow from what slides along what, whatever the joint's kind.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import frexp
from typing import NamedTuple

import numpy as np

from linkanim.mechanics.linkage.joint import Joint, Line, Slide
from linkanim.picture.figure import DOWN, Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts.struts import barrel
from linkanim.picture.raster.directions import directions, lengths
from linkanim.picture.raster.parts import Part, lined, slotted
from linkanim.picture.raster.raster import Layer, Loop
from linkanim.picture.raster.shapes import MOST_MARKS, box, segments, unit
from linkanim.picture.theme import LIGHT, Theme
from linkanim.picture.view import View

_TRIED = 90
"""Poses of a cycle at which is looked how far a fitting reaches."""
_LARGE = 20
"""Powers of two in the size of a scene that is taken as it is; a larger one is scaled down."""
_BLOCK = (4.6, 3.2)
"""A slider block's length and height in half widths of a bar."""
SLOTTED, SLOT = 1.35, 0.5
"""Half the widths of a slotted bar and of its slot, in those of a bar."""
ROD, BARREL = 0.6, 1.2
"""Half the widths of a rod that slides through a swivel, and of the cylinder that it slides in."""
PISTON = 1.1
"""The length of the piston at its end, in half widths of a bar."""
_BORE = 1.5
"""How wide an engine's cylinder is, in widths that its rod sweeps where it is open."""
_CROWN, _SKIRT = 0.8, 0.55
"""How far an engine's piston reaches beyond its pin and back, in half widths of its cylinder."""
_RINGS, _HEAD = (0.5, 0.72), 1.3
"""Where its rings and, as it is furthest out, the cylinder's head are between its pin and its crown."""


@dataclass(frozen=True)
class Bench:
    """What fittings are made with: the scene with its cycle, its scale, thicknesses and colours."""

    figure: Figure
    view: View
    gauge: Gauge
    theme: Theme


@dataclass(frozen=True)
class Bar:
    """What a joint makes of the bar from one joint to another: a slotted bar, or a rod with a piston.

    `slot` has the slot's ends in pixels from the first joint, the other on the real axis. Without a
    slot the bar is a rod, with a `piston` at its end or not.
    """

    ends: tuple[str, str]
    slot: tuple[complex, complex] | None = None
    piston: bool = False


class GuideRails(NamedTuple):
    """Two lines on the ground and the joint that travels between them: the way `along`, y down, has length 1.

    They lie `aside` of its line of travel, and begin and end so far `beyond` its ends; with a `head` they
    are a cylinder that is closed at their end.
    """

    joint: str
    along: complex
    aside: float
    beyond: tuple[float, float]
    head: bool = False


@dataclass(frozen=True)
class Fitting:
    """What a joint adds to the picture: parts behind the bodies and before them, its guide on the ground.

    `bar` is what it makes of its bar.
    """

    behind: tuple[Part, ...] = ()
    before: tuple[Part, ...] = ()
    guide: GuideRails | None = None
    bar: Bar | None = None


def fittings(bench: Bench) -> tuple[Fitting, ...]:
    """Return the fittings of all joints that have some, in the joints' order."""
    return tuple(_fitting(joint, bench) for joint in bench.figure.linkage.joints if joint.slides)


def _fitting(joint: Joint, bench: Bench) -> Fitting:
    """Return what a joint adds by what slides: itself on a line, a pin in its own bar's slot, or both."""
    first, *across = joint.slides
    if first.point != joint.name:
        return _slotted(first, bench)
    if across:
        return _yoke(first, across[0], bench)
    return _slider(joint, first.line, bench)


def outlines(figure: Figure) -> Iterator[tuple[Loop, Loop, Loop]]:
    """Yield the outlines of slotted bars and guides, drawn thin, and the places and directions of each.

    x + yi in the scene's unit, y up, at some of the cycle's moments; where a joint is nowhere none.
    """
    # A power of two keeps every digit; arcs have as many points as their size in pixels asks for.
    scale = 2.0 ** -max(frexp(figure.extent)[1] - _LARGE, 0)
    thin = scale * 1e-6 * max(figure.shortest, 1e-6 * figure.extent)
    bench = Bench(figure, View(scale, 0.0, 0.0), Gauge(thin, thin / 8, thin, thin), LIGHT)
    parts = [part for fitting in fittings(bench) for part in (*fitting.behind, *fitting.before)]
    step = max(len(figure.cycle.phase) // _TRIED, 1)
    for fitting in fittings(bench):
        if fitting.guide and fitting.guide.head:
            ends = [end for line, _ in _placed(fitting.guide, bench).lines for end in line]
            yield (
                np.array(ends, np.complex128).conj() / scale,
                np.zeros(1, np.complex128),
                np.ones(1, np.complex128),
            )
    for part in parts:
        at, tail, head = (
            np.atleast_2d(figure.cycle.position[name])[::step] @ DOWN.conj()
            for name in (part.at, part.tail, part.head)
        )
        way = head - tail
        turn = np.where(way == 0, 1, way / np.where(way == 0, 1, lengths(way)))
        known = np.isfinite(at + way)
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


def _slider(joint: Joint, line: Line, bench: Bench) -> Fitting:
    """Return a block between rails on the ground, or a small one in the slot of a body that carries it.

    One that drives is in the colour of what drives.
    """
    along, name = complex(directions(-line.angle)), joint.name
    if line.on is not None:
        guide, slot = _carried_slot(name, line, along, bench)
        block = Part(name, *line.on, _block(bench, along, 0.62), (name,))
        return Fitting(behind=(guide,), before=(slot, block))
    bodies = (body for body in bench.figure.linkage.bodies if body.slider == name)
    if joint.bars and any(bench.figure.scene.style(body.name).outline == "piston" for body in bodies):
        return _cylindered(name, joint.bars[0][0], along, bench)
    rim, metal = _block(bench, along)
    if name == bench.figure.linkage.drive.joint:
        metal = Layer(bench.theme.bodies[0], metal.loops)
    block = Part(name, name, name, (rim, metal), (name,))
    return Fitting(behind=(block,), guide=_rails(name, along, bench.gauge))


def _cylindered(name: str, far: str, along: complex, bench: Bench) -> Fitting:
    """Return a piston in a cylinder that its rod to `far` stays within; its head is where the rod is not."""
    gauge, paths = bench.gauge, (bench.figure.path(end, bench.view) for end in (name, far))
    place, end = (path * np.conj(along) for path in paths)
    out = along if np.nanmean((place - end).real) > 0 else -along
    way, rod = place * np.conj(out / along), (end - place) * np.conj(out / along)
    # how far aside the rod is where the cylinder is open
    share = np.minimum((way.real - np.nanmin(way.real)) / np.maximum(-rod.real, 1e-9), 1.0)
    aside = max(_BORE * float(np.nanmax(np.abs(share * rod.imag))), _reach_of_rails(gauge))
    crown, skirt, edge = _CROWN * aside, _SKIRT * aside, gauge.outline
    wide, middle = 2 * (aside - gauge.line), (crown - skirt) / 2
    outer = box(crown + skirt, wide, 0.4 * gauge.bar) + middle
    inner = box(crown + skirt - 2 * edge, wide - 2 * edge, 0.3 * gauge.bar) + middle
    rings = [box(2 * edge, wide - 2 * edge) + share * crown for share in _RINGS]
    shapes = ((bench.theme.outline, [outer]), (bench.theme.metal, [inner]), (bench.theme.outline, rings))
    layers = tuple(Layer(*shape).placed(0j, out) for shape in shapes)
    block = Part(name, name, name, layers, (name,))
    return Fitting((block,), guide=GuideRails(name, out, aside, (0.0, _HEAD * crown), head=True))


def _carried_slot(name: str, line: Line, along: complex, bench: Bench) -> tuple[Part, Part]:
    """Return the bar that a body carries along a line, from the joint it runs through, and the slot in it."""
    assert line.on is not None
    gauge, theme, scale = bench.gauge, bench.theme, bench.view.scale
    places = bench.figure.cycle.position
    seen = (places[name] - places[line.through]) @ DOWN * np.conj(_facing(line, bench) * along)
    foot = -1j * along * line.offset * scale
    near, far = (foot + along * scale * float(way) for way in (np.nanmin(seen.real), np.nanmax(seen.real)))
    colours = theme.outline, theme.metal
    arm = lined([0j, foot], gauge.bar, gauge.outline, colours) if line.offset else []
    bar = lined([foot, near, far], SLOTTED * gauge.bar, gauge.outline, colours)
    hollow = lined([near, far], SLOT * gauge.bar, gauge.outline, (theme.outline, theme.background))
    ways = (line.through, *line.on)
    return Part(*ways, (*arm, *bar), (line.through,)), Part(*ways, tuple(hollow))


def _block(bench: Bench, turn: complex = 1 + 0j, share: float = 1.0) -> tuple[Layer, ...]:
    return block_layers(bench.gauge, bench.theme, turn, share)


def block_layers(gauge: Gauge, theme: Theme, turn: complex, share: float = 1.0) -> tuple[Layer, ...]:
    """Return what slides about 0, along the direction `turn`: the block between rails, or a share of it."""
    length, height = (share * side * gauge.bar for side in _BLOCK)
    edge, corner = 2 * share * gauge.outline, share * gauge.bar
    outer, inner = box(length, height, 0.4 * corner), box(length - edge, height - edge, 0.3 * corner)
    return Layer(theme.outline, [turn * outer]), Layer(theme.metal, [turn * inner])


def rails_of(bench: Bench) -> Iterator[list[Loop]]:
    """Yield the lines of each guide on the ground; they are open where another guide crosses them."""
    places = [_placed(fitting.guide, bench) for fitting in fittings(bench) if fitting.guide]
    for place in places:
        others = [other for other in places if other is not place]
        parts = [(part, side) for line, side in place.lines for part in _opened(line, others)]
        yield [loop for part, side in parts for loop in hatched(*part, bench.gauge, side)]


def rail_reach(bench: Bench, joint: str) -> float:
    """Return how far the rails of a joint lie from its line of travel; 0 where it has none on the ground."""
    guides = (one.guide for one in fittings(bench) if one.guide)
    return next((guide.aside for guide in guides if guide.joint == joint), 0.0)


def _rails(name: str, along: complex, gauge: Gauge) -> GuideRails:
    """Return the guide of a block."""
    beyond = (_BLOCK[0] / 2 + 0.9) * gauge.bar
    return GuideRails(name, along, _reach_of_rails(gauge), (beyond, beyond))


def _reach_of_rails(gauge: Gauge) -> float:
    return (_BLOCK[1] / 2) * gauge.bar + gauge.line


_Line = tuple[complex, complex]
"""Both ends of a line in pixels."""


class _Channel(NamedTuple):
    """A guide in its place, in pixels: the middles of its ends, how far aside it reaches, and its lines.

    With each line comes the side that is hatched.
    """

    begin: complex
    end: complex
    aside: float
    lines: list[tuple[_Line, int]]


def _placed(guide: GuideRails, bench: Bench) -> _Channel:
    """Return a guide as long as the joint's travel needs."""
    path = bench.figure.path(guide.joint, bench.view) * np.conj(guide.along)
    way, across = path.real, 1j * float(np.nanmean(path.imag))
    begin = guide.along * (float(np.nanmin(way)) - guide.beyond[0] + across)
    end = guide.along * (float(np.nanmax(way)) + guide.beyond[1] + across)
    off = 1j * guide.along * guide.aside
    lines = [((begin + side * off, end + side * off), side) for side in (1, -1)]
    head = [((end + off, end - off), 1)] if guide.head else []
    return _Channel(begin, end, guide.aside, lines + head)


def _opened(line: _Line, others: Iterable[_Channel]) -> list[_Line]:
    """Return what is left of a line outside of other guides."""
    parts = [line]
    for other in others:
        parts = [part for whole in parts for part in _outside(*whole, other)]
    return parts


def _outside(begin: complex, end: complex, other: _Channel) -> Iterator[_Line]:
    """Yield what of a line lies before a channel and beyond it; all of it where it does not cross it."""
    along, long = unit(other.end - other.begin), abs(other.end - other.begin)
    first, last = ((place - other.begin) / along for place in (begin, end))
    if first.imag * last.imag >= 0 or min(abs(first.imag), abs(last.imag)) < other.aside:
        yield begin, end
        return
    where = first.imag / (first.imag - last.imag)
    half = other.aside / abs(first.imag - last.imag)
    if not 0 < (first + where * (last - first)).real < long:
        yield begin, end
        return
    yield begin, begin + (where - half) * (end - begin)
    yield begin + (where + half) * (end - begin), end


def _facing(line: Line, bench: Bench) -> Loop:
    """Return the direction of a line's axis over the cycle, y down; 1 of one on the ground."""
    if line.on is None:
        return np.ones(1, np.complex128)
    start, end = (bench.figure.cycle.position[name] for name in line.on)
    way = (end - start) @ DOWN
    facing: Loop = way / lengths(way)
    return facing


def _slotted(slide: Slide, bench: Bench) -> Fitting:
    """Return the slot in the bar, and the collar that slides in it and turns with it.

    About a joint of the ground it is the bar that slides: a rod through a swivel.
    """
    assert slide.axis is not None
    collar = Part(slide.point, *slide.axis, _block(bench, share=0.62), (slide.point,))
    if bench.figure.linkage.joint(slide.point).fixed:
        return _swivelled(slide, slide.axis, collar, bench)
    return Fitting(before=(collar,), bar=Bar(slide.axis, _slot_ends(slide, bench)))


def _swivelled(slide: Slide, bar: tuple[str, str], collar: Part, bench: Bench) -> Fitting:
    """Return what makes of the bar a rod; in a cylinder, with a piston, where its end is free."""
    if bar[1] in bench.figure.pins:
        return Fitting(before=(collar,), bar=Bar(bar))
    gauge, (near, far) = bench.gauge, _slot_ends(slide, bench)
    length, room = bench.view.scale * dict(bench.figure.linkage.joint(bar[1]).bars)[bar[0]], 0.8 * gauge.bar
    ends = min(length - far.real, 0.0) - room, max(length - near.real, 0.0) + room
    wall = barrel(*ends, BARREL * gauge.bar, gauge, bench.theme)
    layers = tuple(layer.placed(complex(0, -near.imag)) for layer in wall)
    cylinder = Part(slide.point, *bar, layers, (slide.point,))
    return Fitting(behind=(cylinder,), before=(collar,), bar=Bar(bar, piston=True))


def _slot_ends(slide: Slide, bench: Bench) -> tuple[complex, complex]:
    """Return the ends of a slot in pixels, the pivot at 0 and the bar along the real axis."""
    places, offset = bench.figure.cycle.position, slide.line.offset
    way = np.sum((places[slide.point] - places[slide.line.through]) ** 2, axis=-1)
    along = np.sqrt(np.maximum(way - offset**2, 0))
    side = -1j * offset
    return bench.view.scale * (np.nanmin(along) + side), bench.view.scale * (np.nanmax(along) + side)


def _yoke(guided: Slide, slot: Slide, bench: Bench) -> Fitting:
    """Return a block between rails with a slotted bar across it, and the collar that the pin turns in."""
    gauge, theme, scale = bench.gauge, bench.theme, bench.view.scale
    places, line, name = bench.figure.cycle.position, guided.line, guided.point
    along, across = (complex(directions(-angle)) for angle in (line.angle, slot.line.angle))
    apart = (places[slot.point] - places[name]) @ DOWN
    way = np.real(apart * np.conj(across * _facing(line, bench)))
    ends = scale * float(np.nanmin(way)) * across, scale * float(np.nanmax(way)) * across
    colours = theme.outline, theme.metal
    widths = SLOTTED * gauge.bar, SLOT * gauge.bar
    bar = slotted([0j, *ends], ends, widths, gauge.outline, colours)
    ways = line.on or (name, name)
    yoke = Part(name, *ways, (*_block(bench, along), *bar))
    collar = Part(slot.point, *ways, _block(bench, across, 0.62), (slot.point,))
    if line.on is None:
        return Fitting((yoke,), (collar,), _rails(name, along, gauge))
    behind, before = _carried_slot(name, line, along, bench)
    return Fitting((behind, before, yoke), (collar,))
