"""Draw gear pairs: wheels that mesh, planets on the wheel they roll on, belts between pulleys.

First which wheels there are, how large and with how many teeth; then how they are drawn: discs that stay,
and teeth, outlines and holes that turn.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import ceil, cos, floor, pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Crank
from linkanim.picture.figure import DrawContext, Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Part, directions, disc, segments, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

# Gear pairs: wheels that mesh, planets on the wheel they roll on, pulleys where both turn the same way.

_TEETH = 48
"""About the number of teeth that two wheels of one size have together, if they turn slowly enough."""
_PASSING = 25 / 3
"""The most teeth that pass in a second: a third of a pitch from frame to frame, so that wheels do not seem
to turn backwards."""
_FEWEST = 9
_DWARFED = 2.0
"""Where both wheels of a pair have radii of more than this many crank lengths, they are drawn as quiet rims;
where one is wider than the linkage, as pitch circles."""
TIP, FOOT = 0.85, 1.0
"""How far a tooth reaches beyond the pitch circle and the gap below it, in modules."""
_QUIET_TIP, _QUIET_FOOT, _QUIET_RIM = 0.4, 0.5, 0.45
"""The same for a quiet rim, whose teeth are low; and the rim's width below its gaps, in modules."""
_TOGETHER = 1e-9
"""Share of the picture below which two pivots count as one, with no gears between them to show."""
_BELT = 0.3
"""The larger pulley's radius, as a share of the distance between the pivots."""


@frozen
class Wheel:
    """A wheel about a joint, its radius in the scene's unit; `teeth` is 0 for a pulley.

    It turns with the direction from its centre to the joint `arm`; without an arm it does not turn. `tooth`
    is the angle of a tooth from that direction, in radians, counter-clockwise. The teeth of a `ring` point
    inwards: `tooth` is then the angle of a gap. Where only the `pitch` circle is drawn, it is the angle of a
    mark. A `quiet` wheel would dwarf what it drives: only a faint rim with low teeth is drawn.
    """

    centre: str
    arm: str | None
    radius: float
    teeth: int = 0
    tooth: float = 0.0
    ring: bool = False
    pitch: bool = False
    quiet: bool = False

    @property
    def reach(self) -> float:
        """The wheel's outer radius in the scene's unit: at its tips, or at a ring's outer edge."""
        beyond = 7.0 if self.ring else 2 * (_QUIET_TIP if self.quiet else TIP)
        return self.radius * (1 + beyond / self.teeth) if self.teeth else self.radius


@frozen
class WheelPair:
    """Two wheels that roll on each other, or share a belt; a planet rolls on a wheel that stands still."""

    driver: Wheel
    driven: Wheel

    @property
    def wheels(self) -> tuple[Wheel, Wheel]:
        """Both wheels, the one behind first."""
        return self.driver, self.driven

    @property
    def planetary(self) -> bool:
        """Whether the driven wheel goes round with an arm."""
        return self.driver.arm is None

    @property
    def belted(self) -> bool:
        """Whether the wheels are pulleys."""
        return not (self.driven.teeth or self.driven.pitch)


def pairs(figure: Figure) -> tuple[WheelPair, ...]:
    """Return the gear pairs with pivots apart, sized so that their pitch circles roll on each other.

    A crank that is geared to the crank on whose pin it turns is a planet. It rolls on a wheel that stands
    still about that crank's pivot: a sun, or a ring around the planet where it turns the other way.
    """
    cranks = {crank.name: crank for crank in figure.linkage.cranks}
    wheels = (_pair(figure, crank, cranks) for crank in cranks.values())
    return tuple(pair for pair in wheels if pair)


def _pair(figure: Figure, crank: Crank, cranks: dict[str, Crank]) -> WheelPair | None:
    gear = crank.gear
    if gear is None or gear.motor or gear.mate not in cranks:
        return None
    driver = cranks[gear.mate]
    fixed = figure.linkage.joint(driver.pivot).fixed
    if crank.pivot == driver.name and fixed:
        return _planet(figure, crank, driver)
    apart = figure.start(crank.pivot) - figure.start(driver.pivot)
    if not (fixed and figure.linkage.joint(crank.pivot).fixed) or abs(apart) <= _TOGETHER * figure.extent:
        return None
    if gear.ratio > 0:
        return _pulleys((driver, crank), abs(apart), float(gear.ratio))
    return _meshing(figure, (driver, crank), apart)


def _pulleys(cranks: tuple[Crank, Crank], apart: float, ratio: float) -> WheelPair:
    radii = _BELT * apart * min(ratio, 1), _BELT * apart * min(1 / ratio, 1)
    return WheelPair(*(Wheel(one.pivot, one.name, radius) for one, radius in zip(cranks, radii, strict=True)))


def _meshing(figure: Figure, cranks: tuple[Crank, Crank], apart: complex) -> WheelPair:
    """Return two wheels on fixed pivots that turn against each other."""
    driver, driven = cranks
    assert driven.gear is not None
    ratio = abs(driven.gear.ratio)
    radius = abs(apart) * float(ratio / (1 + ratio))
    second, contact = abs(apart) - radius, float(np.angle(apart))
    at, facing = contact - _angle(figure, driver), contact + pi - _angle(figure, driven)
    one = Wheel(driver.pivot, driver.name, radius, tooth=at, pitch=True)
    other = Wheel(driven.pivot, driven.name, second, tooth=facing, pitch=True)
    quiet = radius > _DWARFED * driver.length and second > _DWARFED * driven.length
    box = figure.box
    if quiet and 2 * max(radius, second) > max(box.right - box.left, box.high - box.low):
        return WheelPair(one, other)
    some, others = _teeth(ratio.numerator, ratio.denominator, _turns(figure, driven))
    toothed = replace(other, teeth=others, tooth=facing + pi / others, pitch=False, quiet=quiet)
    return WheelPair(replace(one, teeth=some, pitch=False, quiet=quiet), toothed)


def _teeth(one: int, other: int, turns: float) -> tuple[int, int]:
    """Return the teeth of two wheels whose radii are as `one` to `other`, the latter at `turns` a second."""
    many = min(_TEETH / (one + other), _PASSING / max(other * turns, 1e-9))
    many = max(ceil(_FEWEST / min(one, other)), floor(many))
    return many * one, many * other


def _planet(figure: Figure, planet: Crank, arm: Crank) -> WheelPair | None:
    """Return the still wheel, of radius R, and the planet, of radius r, that rolls on it; the arm is d long.

    The planet turns 1 - R/r times as often as its arm inside a ring, where R - r = d; 1 + R/r times outside a
    sun, where R + r = d; and 1 - R/r times where a belt joins the two.
    """
    assert planet.gear is not None
    ratio, long, inside = planet.gear.ratio, arm.length, planet.gear.ratio < 0
    if 0 < ratio <= 1:
        pulley = Wheel(planet.pivot, planet.name, _BELT * long)
        still = Wheel(arm.pivot, None, pulley.radius * float(1 - ratio))
        return WheelPair(still, pulley) if ratio < 1 else None
    contact, radius = _angle(figure, arm), long / abs(float(ratio))
    teeth, small = _teeth(abs(ratio.numerator - ratio.denominator), ratio.denominator, _turns(figure, planet))
    tooth = contact - _angle(figure, planet) + (0.0 if inside else pi + pi / small)
    large = long + radius if inside else long - radius
    rolling = Wheel(planet.pivot, planet.name, radius, small, tooth)
    return WheelPair(Wheel(arm.pivot, None, large, teeth, contact, ring=inside), rolling)


def _angle(figure: Figure, crank: Crank) -> float:
    return float(np.angle(figure.start(crank.name) - figure.start(crank.pivot)))


def teeth_a_second(figure: Figure) -> float:
    """Return how many teeth of the fastest wheel pass a fixed direction in a second at the scene's speed."""
    turned = (wheel for wheel in wheels(figure) if wheel.arm)
    cranks = {crank.name: crank for crank in figure.linkage.cranks}
    return max((wheel.teeth * _turns(figure, cranks[str(wheel.arm)]) for wheel in turned), default=0.0)


def _turns(figure: Figure, crank: Crank) -> float:
    """Return how many turns a second a crank makes where it is fastest, at the scene's speed."""
    arm = figure.cycle.position[crank.name] - figure.cycle.position[crank.pivot]
    turned = np.diff(np.unwrap(np.arctan2(arm[:, 1], arm[:, 0])))
    step = figure.scene.period / len(figure.cycle.phase)
    return float(np.nanmax(np.abs(turned))) / step * abs(figure.linkage.drive.speed) / (2 * pi)


def wheels(figure: Figure) -> Iterator[Wheel]:
    """Yield the wheels of all pairs."""
    for pair in pairs(figure):
        yield from pair.wheels


# How gear pairs are drawn: discs that stay, teeth, outlines and holes that turn, belts between pulleys.

_PRESSURE = radians(25)
"""The pressure angle: at the usual 20° the flanks of a wheel of the fewest teeth would be undercut."""
_FADED = 0.45
"""The share of the background's colour in a quiet rim."""
_SHADED = 0.3
"""The share of the ground's colour in the driven wheel's."""
_MARK = (1.7, 0.55)
"""The length of a pitch circle's mark and half its width, in half widths of a bar."""
_DASHES = ((0.0, 0.5, 4), (0.72, 0.78, 2))
"""Where the dash and the dot of a pitch circle begin and end, in steps, and their points."""
_HOLES, _HOLED, _HOLE = 5, 0.62, 0.19
"""How many holes a wheel has, their distance from its middle and their radius, in radii within its teeth."""


def wheel_layers(context: DrawContext) -> list[Layer]:
    """Return what does not turn: wheels and discs that stay where they are, and the belts between them."""
    parts, figure = still_parts(context), context.figure
    names = {name for part in parts for name in (part.at, part.head)}
    places = {name: figure.pixel(name, context.view) for name in names}
    return [layer.placed(places[part.at], part.turn(places)) for part in parts for layer in part.layers]


def still_parts(context: DrawContext) -> tuple[Part, ...]:
    """Return what does not turn as parts: each disc about its centre, a belt from one to the other."""
    figure, view, gauge, theme = context.known
    parts = []
    for pair in pairs(figure):
        one, other = (wheel.centre for wheel in pair.wheels)
        for wheel in (wheel for wheel in pair.wheels if _stays(figure, wheel)):
            if wheel.pitch:
                shown = [Layer(theme.ground, _pitch_circle(wheel.radius * view.scale, gauge))]
            elif wheel.quiet:
                continue
            elif wheel.arm:
                shown = [Layer(_tone(wheel, pair, theme), [disc(_root(wheel, view, gauge))])]
            else:
                shown = [*_wheel(wheel, pair, (view, gauge, theme), moving=True)]
            at = wheel.centre
            parts.append(Part(at, at, at, tuple(shown), sized=(one, other)))
        if pair.belted and not pair.planetary:
            parts.append(_belting(pair, context))
    return tuple(parts)


def _stays(figure: Figure, wheel: Wheel) -> bool:
    return figure.linkage.joint(wheel.centre).fixed


def wheel_parts(context: DrawContext) -> tuple[Part, ...]:
    """Return what turns or goes round: teeth, outlines, and holes that show how far a wheel has turned."""
    figure, view, gauge, theme = context.known
    parts = []
    for pair in pairs(figure):
        for wheel in (wheel for wheel in pair.wheels if wheel.arm or not _stays(figure, wheel)):
            stays = _stays(figure, wheel)
            ends = wheel.centre, wheel.centre, wheel.arm or wheel.centre
            size = pair.driver.centre, pair.driven.centre
            if wheel.pitch:
                parts.append(Part(*ends, (Layer(theme.outline, [_mark(wheel, view, gauge)]),), sized=size))
                continue
            if wheel.quiet:
                rim = tuple(_quiet(wheel, pair, (view, gauge, theme)))
                parts.append(Part(*ends, rim, fold=wheel.teeth, sized=size))
                continue
            rims, *holes, edge = _wheel(wheel, pair, (view, gauge, theme), moving=not stays)
            # the outline of a pulley has equal sides instead of teeth
            fold = (wheel.teeth or len(rims.loops[0])) if stays else 1
            parts.append(Part(*ends, (rims, edge), fold=fold, sized=size))
            parts += [Part(*ends, (hole,), fold=_HOLES if stays else 1, sized=size) for hole in holes]
        if pair.planetary and pair.belted:
            parts.append(_belting(pair, context))
    return tuple(parts)


def _belting(pair: WheelPair, context: DrawContext) -> Part:
    """Return the belt of a pair from its driver to its driven pulley."""
    figure, view, gauge, theme = context.known
    one, other = (wheel.centre for wheel in pair.wheels)
    far = abs(figure.start(other) - figure.start(one)) * view.scale
    belt = list(_belt(pair, 0j, complex(far), view, gauge))
    return Part(one, one, other, (Layer(theme.ground, belt),), sized=(one, other))


def _quiet(wheel: Wheel, pair: WheelPair, drawn: tuple[View, Gauge, Theme]) -> Iterator[Layer]:
    """Yield the rim of a wheel that would dwarf what it drives, about the origin: faint, with low teeth."""
    view, gauge, theme = drawn
    radius = wheel.radius * view.scale
    rim = _toothed(wheel, radius, _QUIET_FOOT, _QUIET_TIP)
    within = disc(max(radius - (2 * _QUIET_FOOT + _QUIET_RIM) * 2 * radius / wheel.teeth, 1.0))[::-1]
    yield Layer(mixed(_tone(wheel, pair, theme), theme.background, _FADED), [rim, within])
    lines = [loop for outline in (rim, within) for loop in stroke(outline, 0.7 * gauge.outline, closed=True)]
    yield Layer(mixed(theme.ground, theme.background, _FADED), lines)


def _wheel(
    wheel: Wheel, pair: WheelPair, drawn: tuple[View, Gauge, Theme], *, moving: bool
) -> tuple[Layer, ...]:
    """Return a wheel about the origin; one that stays in place has no disc here, which is drawn once."""
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
    # The ends are square: there are many, and a file holds every point of a round one.
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
    """Return the outline, with a hole where the disc shows; for a ring, its outer edge comes first."""
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
