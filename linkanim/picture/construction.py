"""The construction of a synthesis on a picture: its marks as thin lines, points and names."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from linkanim.picture.chart import Pen, line_layer
from linkanim.picture.items import Caption, Halo, Item
from linkanim.picture.placing import Alternatives, chosen, grounded
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import arrows, disc, segments
from linkanim.picture.theme import mixed
from linkanim.picture.view import Box, Rect, View
from linkanim.synthesis.constructions import Mark

_WIDTHS = {"bar": 2.4, "line": 1.1, "thin": 0.8, "dashed": 0.8, "arc": 1.1, "frame": 1.3}
"""Widths of lines, in a chart's lines; those of a plate are as of a bar, or thin."""
_DASHES = (7.0, 5.0)
_DOT, _RING, _CROSS = 3.0, 2.4, 3.2
"""The sizes of points, in widths of a line."""
_POINTS = ("dot", "ring", "cross")
"""The marks that lie over all lines."""
_CUT, _JUMP = 1e-6, 4.0
"""How far apart pieces of one curve may be (pixels); a step of more widths goes through infinity."""
_ROOM = 0.12
"""Share of the marks' width and height that is left free at every side."""
_AROUND = np.exp(1j * np.pi * np.array([0.25, 0.75, -0.25, -0.75, 0.0, 1.0, 0.5, -0.5]))
_FARTHER = (1.0, 1.9)
_BEYOND = (1.0, 1.9, 2.8)
_FAR_OFF = (2.8, 3.7, 4.6, 5.5)
"""How far from its point a name stands, in letters: usually, along a tick, and where those are taken."""


def box_of(marks: Sequence[Mark]) -> Box:
    """Return the rectangle that holds all marks that count, with room around it."""
    points = np.concatenate([mark.points for mark in marks if mark.spreads] or [np.zeros(1, np.complex128)])
    points = points[np.isfinite(points)]
    left, right = float(points.real.min()), float(points.real.max())
    low, high = float(points.imag.min()), float(points.imag.max())
    room = _ROOM * max(right - left, high - low, 1e-12)
    return Box(left - room, low - room, right + room, high + room)


def view_of(box: Box, rect: Rect) -> View:
    """Return the view in which a box fills a rectangle of the picture."""
    scale = min(rect.width / (box.right - box.left), rect.height / (box.high - box.low))
    middle = rect.middle
    x = middle.real - scale * (box.left + box.right) / 2
    return View(scale, x, middle.imag + scale * (box.low + box.high) / 2)


def construction_items(marks: Sequence[Mark], view: View, area: Rect, pen: Pen) -> Iterator[Item]:
    """Yield marks, later ones over earlier ones, then their names where there is room."""

    def pixels(points: Loop) -> Loop:
        return np.asarray(view.x + view.scale * points.real + 1j * (view.y - view.scale * points.imag))

    def shows(mark: Mark) -> bool:
        return all(area.holds(place.real, place.imag) for place in pixels(mark.points))

    marks = [mark for mark in marks if mark.spreads or mark.shape not in _POINTS or shows(mark)]
    for mark in sorted(marks, key=lambda mark: (mark.shape != "plate") + (mark.shape in _POINTS)):
        yield from _drawn(mark, pixels(mark.points), area, pen)
    yield from _names(marks, pixels, area, pen)


def _tone(mark: Mark, pen: Pen) -> Colour:
    theme = pen.theme
    return {
        "ink": theme.outline,
        "dim": theme.ground,
        "first": theme.acceleration,
        "second": theme.velocity,
        "third": theme.traces[1],
        "fourth": theme.traces[0],
    }[mark.tone]


def _drawn(mark: Mark, at: Loop, area: Rect, pen: Pen) -> Iterator[Layer]:
    colour, line = _tone(mark, pen), pen.line
    match mark.shape:
        case "dot":
            yield Layer(colour, [place + disc(_DOT * line) for place in at])
        case "ring":
            yield Layer(colour, [place + disc((_RING + 0.9) * line) for place in at])
            yield Layer(pen.theme.background, [place + disc((_RING - 0.3) * line) for place in at])
        case "cross":
            arm = _CROSS * line * np.exp(0.25j * np.pi)
            ends = [(place - half, place + half) for place in at for half in (arm, 1j * arm)]
            yield Layer(colour, [loop for pair in ends for loop in segments(*pair, 1.2 * line)])
        case "frame":
            axis = at[1] - at[0]
            reaches = np.array([axis, -1j * axis])
            yield Layer(colour, arrows(np.array([at[0], at[0]]), reaches, _WIDTHS["frame"] * line))
        case "word":
            return
        case "plate":
            yield Layer(mixed(colour, pen.theme.background, 0.86), [at])
            width = _WIDTHS["bar" if mark.tone == "ink" else "thin"] * line
            yield Layer(colour, segments(at, np.roll(at, -1), width))
        case "line" | "arc":
            yield line_layer(_clipped(at, area), colour, _WIDTHS[mark.shape] * line)
        case "dashed":
            parts = (_inside(one, other, area) for one, other in pairwise(at.tolist()))
            runs = [np.array(part) for part in parts if part]
            yield line_layer(runs, colour, _WIDTHS["dashed"] * line, _DASHES)
        case _:
            yield Layer(colour, segments(at[:-1], at[1:], _WIDTHS[mark.shape] * line))


def _clipped(at: Loop, area: Rect) -> Iterator[Loop]:
    """Yield the pieces of a curve that lie in the picture, cut at its edges; it may run through infinity."""
    run: list[complex] = []
    for piece in _pieces(at, area):
        if run and abs(run[-1] - piece[0]) > _CUT:
            yield np.array(run)
            run = []
        run += piece.tolist() if not run else piece[1:].tolist()
    if len(run) > 1:
        yield np.array(run)


def _pieces(at: Loop, area: Rect) -> Iterator[Loop]:
    """Yield the parts of a curve in the picture: whole stretches inside, and segments cut at its edges."""
    x, y = at.real, at.imag
    within = (x >= area.x) & (x <= area.right) & (y >= area.y) & (y <= area.bottom)
    beyond = ((x < area.x), (x > area.right), (y < area.y), (y > area.bottom), ~np.isfinite(at))
    whole = within[:-1] & within[1:]
    gone = np.any([side[:-1] & side[1:] for side in beyond], axis=0)
    kinds = np.where(whole, 1, np.where(gone, 2, 0))
    starts = [0, *(np.flatnonzero(np.diff(kinds)) + 1).tolist(), len(kinds)]
    for first, last in pairwise(starts):
        if first == last or kinds[first] == 2:
            continue
        if kinds[first] == 1:
            yield at[first : last + 1]
            continue
        for n in range(first, last):
            part = _inside(complex(at[n]), complex(at[n + 1]), area)
            if part is not None:
                yield np.array(part)


def _inside(one: complex, other: complex, area: Rect) -> tuple[complex, complex] | None:
    """Return the part of a segment in a rectangle; None where none is, or where it runs through infinity."""
    if not (cmath.isfinite(one) and cmath.isfinite(other)) or abs(other - one) > _JUMP * area.width:
        return None
    return area.crossed(one, other)


def _names(marks: Sequence[Mark], pixels: Callable[[Loop], Loop], area: Rect, pen: Pen) -> Iterator[Item]:
    """Yield each mark's name beside it, where it meets no other name and as few points as possible."""
    points = [pixels(mark.points) for mark in marks if mark.spreads]
    busy = np.concatenate(points) if points else np.empty(0, np.complex128)
    named = [mark for mark in marks if mark.label]
    sizes = [(float(pen.type.width(mark.label, pen.small)), 1.2 * pen.small) for mark in named]
    feet = [_foot(mark, pixels(mark.points)) for mark in named]
    choices, leads = list[Alternatives](), list[int]()
    for mark, size, foot in zip(named, sizes, feet, strict=True):
        places, lead = _label_places(mark, pixels(mark.points), foot, size, pen)
        off = [busy - at for at in places]
        covers = [int(((abs(one.real) < size[0] / 2) & (abs(one.imag) < size[1] / 2)).sum()) for one in off]
        price = 0.05 * np.arange(len(places)) + 2.0 * np.array(covers) / max(len(busy), 1)
        choices.append(Alternatives(size, np.array([places]), price, most=1.0))
        leads.append(lead)
    halo = Halo(pen.theme.background, 0.2 * pen.small)
    for mark, size, foot, choice, lead, n in zip(
        named, sizes, feet, choices, leads, chosen(choices, grounded(area)), strict=True
    ):
        at = complex(choice.places[0, n or 0])
        best = _about(at, *size)
        if n is not None and n >= lead:
            # the room around the mark is taken: a thin line leads to a name farther off
            colour = mixed(_tone(mark, pen), pen.theme.background, 0.5)
            led = np.array([foot, best.nearest(foot)])
            yield Layer(colour, segments(led[:1], led[1:], _WIDTHS["thin"] * pen.line))
        yield Caption(mark.label, (best.x, best.y), pen.small, _tone(mark, pen), halo=halo)


def _foot(mark: Mark, at: Loop) -> complex:
    """Return the point of a mark that its name is about."""
    return complex(at[len(at) // 2 if mark.shape == "arc" else 0])


def _label_places(
    mark: Mark, at: Loop, foot: complex, size: tuple[float, float], pen: Pen
) -> tuple[list[complex], int]:
    """Return where a mark's name may stand, and from which place on a line leads to it."""
    if mark.shape == "word":
        return [foot], 1
    if mark.shape == "thin" and len(at) == 2:
        # a tick of a scale has its number beyond it, or before it
        along = complex(at[1] - at[0]) / max(abs(at[1] - at[0]), 1e-9)
        beyond = 0.5 * (size[0] * abs(along.real) + size[1] * abs(along.imag)) + 0.25 * pen.small
        ends = ((complex(at[1]), along), (complex(at[0]), -along))
        places = [end + away * beyond * out for away in _BEYOND for end, out in ends]
        return places, len(places)
    near = [foot + off for off in _offsets(_FARTHER, pen)]
    return [*near, *(foot + off for off in _offsets(_FAR_OFF, pen))], len(near)


def _offsets(distances: Sequence[float], pen: Pen) -> Iterator[complex]:
    """Yield where about its point a name may stand, the nearest first."""
    return (away * pen.small * complex(direction) for away in distances for direction in _AROUND)


def _about(at: complex, wide: float, high: float) -> Rect:
    """Return the rectangle of a name about a place."""
    return Rect(at.real - wide / 2, at.imag - high / 2, wide, high)
