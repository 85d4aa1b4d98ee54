"""How gear pairs are drawn: discs that stay, teeth, outlines and holes that turn, belts between pulleys."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts.wheels import FOOT, TIP, Wheel, WheelPair, pairs
from linkanim.picture.raster.directions import directions
from linkanim.picture.raster.parts import Part
from linkanim.picture.raster.raster import Colour, Layer, Loop
from linkanim.picture.raster.shapes import disc, segments, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

_PRESSURE = radians(25)
"""Steep enough for a wheel of the fewest teeth, whose flanks would be undercut at the usual 20 degrees."""
_SHADED = 0.3
"""How much of the ground's colour is in the driven wheel's."""
_MARK = (1.7, 0.55)
"""The length of a pitch circle's mark and half its width, in half widths of a bar."""
_DASHES = ((0.0, 0.5, 4), (0.72, 0.78, 2))
"""Where the dash and the dot of a pitch circle begin and end, in steps, and their points."""
_HOLES, _HOLED, _HOLE = 5, 0.62, 0.19
"""How many holes a wheel has, how far from its middle, and how large: shares of what is within its teeth."""


def wheel_layers(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return what does not turn: wheels and discs that stay where they are, and the belts between them."""
    layers = []
    for pair in pairs(figure):
        for wheel in (wheel for wheel in pair.wheels if _stays(figure, wheel)):
            if wheel.pitch:
                shown = [Layer(theme.ground, _pitch_circle(wheel.radius * view.scale, gauge))]
            elif wheel.arm:
                shown = [Layer(_tone(wheel, pair, theme), [disc(_root(wheel, view, gauge))])]
            else:
                shown = [*_wheel(wheel, pair, (view, gauge, theme), moving=True)]
            layers += [layer.placed(figure.pixel(wheel.centre, view)) for layer in shown]
        if pair.belted and not pair.planetary:
            one, other = (figure.pixel(wheel.centre, view) for wheel in pair.wheels)
            layers.append(Layer(theme.ground, list(_belt(pair, one, other, view, gauge))))
    return layers


def _stays(figure: Figure, wheel: Wheel) -> bool:
    return figure.linkage.joint(wheel.centre).fixed


def wheel_parts(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Part, ...]:
    """Return what turns or goes round: teeth, outlines, and holes that show how far a wheel has turned."""
    parts = []
    for pair in pairs(figure):
        for wheel in (wheel for wheel in pair.wheels if wheel.arm or not _stays(figure, wheel)):
            stays = _stays(figure, wheel)
            ends = wheel.centre, wheel.centre, wheel.arm or wheel.centre
            if wheel.pitch:
                parts.append(Part(*ends, (Layer(theme.outline, [_mark(wheel, view, gauge)]),)))
                continue
            rim, *holes, edge = _wheel(wheel, pair, (view, gauge, theme), moving=not stays)
            # the outline of a pulley has equal sides instead of teeth
            fold = (wheel.teeth or len(rim.loops[0])) if stays else 1
            parts.append(Part(*ends, (rim, edge), fold=fold))
            parts += [Part(*ends, (hole,), fold=_HOLES if stays else 1) for hole in holes]
        if pair.planetary and pair.belted:
            far = abs(figure.start(pair.driven.centre) - figure.start(pair.driver.centre)) * view.scale
            ends = pair.driver.centre, pair.driver.centre, pair.driven.centre
            belt = list(_belt(pair, 0j, complex(far), view, gauge))
            parts.append(Part(*ends, (Layer(theme.ground, belt),)))
    return tuple(parts)


def _wheel(
    wheel: Wheel, pair: WheelPair, drawn: tuple[View, Gauge, Theme], *, moving: bool
) -> tuple[Layer, ...]:
    """Return a wheel about the origin; one that only turns without its disc, which is drawn once."""
    view, gauge, theme = drawn
    tone = _tone(wheel, pair, theme)
    edge = theme.ground if wheel is pair.driver else mixed(theme.ground, theme.outline, 0.5)
    rim = _rim(wheel, view, gauge, moving=moving)
    if wheel.ring:
        lines = [loop for outline in rim for loop in stroke(outline, gauge.outline, closed=True)]
        return Layer(tone, rim), Layer(edge, lines)
    root = _root(wheel, view, gauge)
    ways = directions(2 * pi / _HOLES * np.arange(_HOLES))
    holes = [way * (_HOLED * root) + disc(_HOLE * root) for way in ways]
    line = stroke(rim[0], gauge.outline, closed=True)
    return Layer(tone, rim), Layer(mixed(tone, theme.background, 0.6), holes), Layer(edge, line)


def _pitch_circle(radius: float, gauge: Gauge) -> list[Loop]:
    """Return a circle about 0 in dashes and dots."""
    step = 2 * pi / max(round(2 * pi * radius / (9 * gauge.line)), 8)
    ways = directions(np.arange(0, 2 * pi - step / 2, step))
    inner, outer = radius - 0.4 * gauge.line, radius + 0.4 * gauge.line
    arcs = [directions(np.linspace(*ends) * step) for ends in _DASHES]
    # Ends that are not round: there are many, and a file holds each point.
    marks = [np.concatenate([inner * arc, outer * arc[::-1]]) for arc in arcs]
    return [way * mark for way in ways for mark in marks]


def _mark(wheel: Wheel, view: View, gauge: Gauge) -> Loop:
    """Return a pointer to the pitch circle from within, where a tooth would be."""
    tip, (long, half) = wheel.radius * view.scale, (share * gauge.bar for share in _MARK)
    way = complex(directions(-wheel.tooth))
    return way * np.array([tip, tip - long + 1j * half, tip - long - 1j * half])


def _tone(wheel: Wheel, pair: WheelPair, theme: Theme) -> Colour:
    return theme.gear if wheel is pair.driver else mixed(theme.gear, theme.ground, _SHADED)


def _root(wheel: Wheel, view: View, gauge: Gauge) -> float:
    """Return the radius of the disc within the teeth, in pixels."""
    radius = wheel.radius * view.scale
    module = 2 * radius / wheel.teeth if wheel.teeth else 0.0
    return max(radius - 1.1 * FOOT * module - gauge.line, 1.0)


def _rim(wheel: Wheel, view: View, gauge: Gauge, *, moving: bool) -> list[Loop]:
    """Return the outline; with a hole where the disc shows, and of a ring the outer edge before it."""
    radius = wheel.radius * view.scale
    if wheel.ring:
        return [disc(wheel.reach * view.scale), _toothed(wheel, radius, TIP, FOOT)[::-1]]
    hole = disc(max(_root(wheel, view, gauge) - gauge.line, 0.5))[::-1]
    outline = _toothed(wheel, radius, FOOT, TIP) if wheel.teeth else disc(radius)
    return [outline] if moving else [outline, hole]


def _toothed(wheel: Wheel, radius: float, foot: float, tip: float) -> Loop:
    """Return the outline of teeth `foot` modules below the pitch circle and `tip` beyond it."""
    radii, half = _flank(wheel.teeth, foot, tip)
    sides = np.concatenate((-half, half[::-1]))
    turns = np.arange(wheel.teeth)[:, None] * 2 * pi / wheel.teeth + sides - wheel.tooth
    outline: Loop = radius * np.concatenate((radii, radii[::-1])) * directions(turns)
    return outline.ravel()


def _flank(teeth: int, foot: float, tip: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return radii from a tooth's foot to its tip in pitch radii, and half its angle there.

    An involute of the base circle, so that two wheels touch without cutting into each other: half the
    angle is pi / 2z + inv(pressure) - inv(its angle there), with inv a = tan a - a (ISO 21771, tooth
    thickness at any circle). Below the base circle the flank is a radius. A ring's gaps are such teeth.
    """
    base = cos(_PRESSURE)
    radii = np.linspace(1 - 2 * foot / teeth, 1 + 2 * tip / teeth, 8)
    there = np.arccos(base / np.maximum(radii, base))
    return radii, pi / (2 * teeth) + _involute(_PRESSURE) - _involute(there)


def _involute(angle: ArrayLike) -> NDArray[np.float64]:
    flank: NDArray[np.float64] = np.tan(angle) - np.asarray(angle)
    return flank


def _belt(pair: WheelPair, one: complex, other: complex, view: View, gauge: Gauge) -> Iterator[Loop]:
    """Yield the two straight runs of an open belt between two pulleys about these places."""
    first, second = pair.driver.radius * view.scale, pair.driven.radius * view.scale
    along = (other - one) / abs(other - one)
    lean = np.arccos((first - second) / abs(other - one))
    for side in (1, -1):
        normal = along * complex(directions(side * lean))
        yield from segments(one + first * normal, other + second * normal, 1.5 * gauge.line)
