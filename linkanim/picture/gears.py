"""Gear pairs: two toothed wheels that mesh, or two pulleys where both cranks turn the same way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, cos, pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.mechanics.kinds import Crank
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts import Part
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import disc, segments, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Box, View, joined

_TEETH = 24
"""Of about how many teeth two wheels of one size have together: few, so that each can be followed."""
_FEWEST = 9
_PRESSURE = radians(25)
"""Steep enough for a wheel of `_FEWEST` teeth, whose flanks would be undercut at the usual 20 degrees."""
_TIP, _FOOT = 0.85, 1.0
"""How far a tooth reaches beyond the pitch circle and the gap below it, in modules."""
_SHADED = 0.3
"""How much of the ground's colour is in the driven wheel's."""
_BELT = 0.3
"""The larger pulley's radius, as a share of the distance between the pivots."""


@dataclass(frozen=True)
class Wheel:
    """A wheel about the pivot of a crank, its radius in the scene's unit; `teeth` is 0 for a pulley.

    `tooth` is the angle of a tooth ahead of the crank, in radians, counter-clockwise.
    """

    crank: Crank
    radius: float
    teeth: int = 0
    tooth: float = 0.0


@dataclass(frozen=True)
class Pair:
    """Two wheels that drive each other."""

    driver: Wheel
    driven: Wheel


def pairs(figure: Figure) -> tuple[Pair, ...]:
    """Return the gear pairs with pivots apart, sized so that their pitch circles roll on each other."""
    cranks = {crank.name: crank for crank in figure.linkage.cranks}
    found = (_pair(figure, crank, cranks) for crank in cranks.values())
    return tuple(pair for pair in found if pair)


def _pair(figure: Figure, crank: Crank, cranks: dict[str, Crank]) -> Pair | None:
    gear = crank.gear
    if gear is None or gear.mate not in cranks:
        return None
    driver = cranks[gear.mate]
    apart = figure.start(crank.pivot) - figure.start(driver.pivot)
    ratio = abs(gear.ratio)
    if apart == 0 or ratio == 0:
        return None
    if gear.ratio > 0:
        large = _BELT * abs(apart)
        share = float(ratio)
        return Pair(Wheel(driver, large * min(share, 1)), Wheel(crank, large * min(1 / share, 1)))
    radius = abs(apart) * float(ratio / (1 + ratio))
    fewest = ceil(_FEWEST / min(ratio.numerator, ratio.denominator))
    many = max(fewest, round(_TEETH / (ratio.numerator + ratio.denominator)))
    first, second = many * ratio.numerator, many * ratio.denominator
    contact = float(np.angle(apart))
    at = contact - _angle(figure, driver)
    facing = contact + pi - _angle(figure, crank) + pi / second
    return Pair(Wheel(driver, radius, first, at), Wheel(crank, abs(apart) - radius, second, facing))


def _angle(figure: Figure, crank: Crank) -> float:
    return float(np.angle(figure.start(crank.name) - figure.start(crank.pivot)))


def teeth_a_second(figure: Figure) -> float:
    """Return how many teeth pass the fastest gear pair's contact in a second at the scene's speed."""
    step = figure.scene.period / len(figure.cycle.phase)
    fastest = 0.0
    for pair in pairs(figure):
        arm = figure.cycle.position[pair.driver.crank.name] - figure.cycle.position[pair.driver.crank.pivot]
        turned = np.diff(np.unwrap(np.arctan2(arm[:, 1], arm[:, 0])))
        fastest = max(fastest, pair.driver.teeth * float(np.nanmax(np.abs(turned))) / step)
    return fastest * abs(figure.linkage.drive.speed) / (2 * pi)


def wheels_box(figure: Figure, box: Box) -> Box:
    """Return the box widened so that every wheel is in it."""
    for pair in pairs(figure):
        for wheel in (pair.driver, pair.driven):
            centre, radius = figure.start(wheel.crank.pivot), 1.06 * wheel.radius
            low, high = centre - complex(radius, radius), centre + complex(radius, radius)
            box = joined(box, Box(low.real, low.imag, high.real, high.imag))
    return box


def wheel_layers(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return what does not turn: the wheels' discs and the belts."""
    layers = []
    for pair in pairs(figure):
        for wheel in (pair.driver, pair.driven):
            centre = _centre(figure, view, wheel)
            layers.append(Layer(_tone(wheel, pair, theme), [centre + disc(_root(wheel, view, gauge))]))
        if not pair.driver.teeth:
            layers.append(Layer(theme.ground, list(_belt(figure, view, pair, gauge))))
    return layers


def wheel_parts(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Part, ...]:
    """Return what turns: the teeth, their outline, and holes that show how far a wheel has turned."""
    parts = []
    for pair in pairs(figure):
        for wheel in (pair.driver, pair.driven):
            root, tone = _root(wheel, view, gauge), _tone(wheel, pair, theme)
            holes = [0.62 * root * np.exp(2j * pi * k / 5) + disc(0.19 * root) for k in range(5)]
            ring = _ring(wheel, view, gauge)
            line = stroke(ring[0], gauge.outline, closed=True)
            layers = [Layer(tone, ring), Layer(mixed(tone, theme.background, 0.6), holes)]
            layers.append(Layer(_edge(wheel, pair, theme), line))
            parts.append(Part(wheel.crank.pivot, wheel.crank.pivot, wheel.crank.name, tuple(layers)))
    return tuple(parts)


def _tone(wheel: Wheel, pair: Pair, theme: Theme) -> Colour:
    return theme.gear if wheel is pair.driver else mixed(theme.gear, theme.ground, _SHADED)


def _edge(wheel: Wheel, pair: Pair, theme: Theme) -> Colour:
    return theme.ground if wheel is pair.driver else mixed(theme.ground, theme.outline, 0.5)


def _centre(figure: Figure, view: View, wheel: Wheel) -> complex:
    place = figure.start(wheel.crank.pivot)
    return view.place((place.real, place.imag))


def _module(wheel: Wheel, view: View) -> float:
    return 2 * wheel.radius * view.scale / wheel.teeth if wheel.teeth else 0.0


def _root(wheel: Wheel, view: View, gauge: Gauge) -> float:
    return max(wheel.radius * view.scale - 1.1 * _FOOT * _module(wheel, view) - gauge.line, 1.0)


def _ring(wheel: Wheel, view: View, gauge: Gauge) -> list[Loop]:
    """Return the rim: teeth outside, a circle just inside the disc's edge as its hole."""
    inner = disc(max(_root(wheel, view, gauge) - gauge.line, 0.5))[::-1]
    if not wheel.teeth:
        return [disc(wheel.radius * view.scale), inner]
    radii, half = _flank(wheel.teeth)
    sides = np.concatenate((-half, half[::-1]))
    turns = np.arange(wheel.teeth)[:, None] * 2 * pi / wheel.teeth + sides - wheel.tooth
    outline = wheel.radius * view.scale * np.concatenate((radii, radii[::-1])) * np.exp(1j * turns)
    return [outline.ravel(), inner]


def _flank(teeth: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return radii from a tooth's foot to its tip in pitch radii, and half its angle there.

    An involute of the base circle, so that two wheels touch without cutting into each other: half the
    angle is pi / 2z + inv(pressure) - inv(its angle there), with inv a = tan a - a (ISO 21771, tooth
    thickness at any circle). Below the base circle the flank is a radius.
    """
    base = cos(_PRESSURE)
    radii = np.linspace(1 - 2 * _FOOT / teeth, 1 + 2 * _TIP / teeth, 8)
    there = np.arccos(base / np.maximum(radii, base))
    return radii, pi / (2 * teeth) + _involute(_PRESSURE) - _involute(there)


def _involute(angle: ArrayLike) -> NDArray[np.float64]:
    flank: NDArray[np.float64] = np.tan(angle) - np.asarray(angle)
    return flank


def _belt(figure: Figure, view: View, pair: Pair, gauge: Gauge) -> Iterator[Loop]:
    """Yield the two straight runs of an open belt."""
    one, other = _centre(figure, view, pair.driver), _centre(figure, view, pair.driven)
    radii = pair.driver.radius * view.scale, pair.driven.radius * view.scale
    along = (other - one) / abs(other - one)
    lean = np.arccos((radii[0] - radii[1]) / abs(other - one))
    for side in (1, -1):
        normal = along * np.exp(1j * side * lean)
        ends = one + radii[0] * normal, other + radii[1] * normal
        yield from segments(*ends, 1.5 * gauge.line)
