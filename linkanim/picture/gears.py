"""Gear pairs: wheels that mesh, planets on the wheel they roll on, pulleys where both turn the same way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from math import ceil, cos, pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.mechanics.kinds import Crank
from linkanim.picture.directions import directions
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts import Part, Stamp
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import disc, segments, stroke
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

_TEETH = 24
"""Of about how many teeth two wheels of one size have together: few, so that each can be followed."""
_FEWEST = 9
_PRESSURE = radians(25)
"""Steep enough for a wheel of `_FEWEST` teeth, whose flanks would be undercut at the usual 20 degrees."""
_TIP, _FOOT = 0.85, 1.0
"""How far a tooth reaches beyond the pitch circle and the gap below it, in modules."""
_SHADED = 0.3
"""How much of the ground's colour is in the driven wheel's."""
_HOLES, _HOLED, _HOLE = 5, 0.62, 0.19
"""How many holes a wheel has, how far from its middle, and how large: shares of what is within its teeth."""
_BELT = 0.3
"""The larger pulley's radius, as a share of the distance between the pivots."""


@dataclass(frozen=True)
class Wheel:
    """A wheel about a joint, its radius in the scene's unit; `teeth` is 0 for a pulley.

    It turns with the direction from its centre to the joint `arm`, or not at all without one. `tooth` is
    the angle of a tooth ahead of that direction, in radians, counter-clockwise. The teeth of a `ring`
    point inwards: `tooth` is then the angle of a gap.
    """

    centre: str
    arm: str | None
    radius: float
    teeth: int = 0
    tooth: float = 0.0
    ring: bool = False

    @property
    def reach(self) -> float:
        """How far it reaches from its middle, in the scene's unit: to its tips, or a ring's outer edge."""
        beyond = 7.0 if self.ring else 2 * _TIP
        return self.radius * (1 + beyond / self.teeth) if self.teeth else self.radius


@dataclass(frozen=True)
class WheelPair:
    """Two wheels that roll on each other, or share a belt; a planet rolls on a wheel that stands still."""

    driver: Wheel
    driven: Wheel

    @property
    def wheels(self) -> tuple[Wheel, Wheel]:
        """Both of them, the one behind first."""
        return self.driver, self.driven

    @property
    def planetary(self) -> bool:
        """Whether the driven wheel goes round with an arm."""
        return self.driver.arm is None


def pairs(figure: Figure) -> tuple[WheelPair, ...]:
    """Return the gear pairs with pivots apart, sized so that their pitch circles roll on each other.

    A crank that is geared to the one whose pin it turns on is a planet: what makes it turn as it does is
    a wheel about that crank's own pivot which stands still, a ring around it where it turns the other way.
    """
    cranks = {crank.name: crank for crank in figure.linkage.cranks}
    found = (_pair(figure, crank, cranks) for crank in cranks.values())
    return tuple(pair for pair in found if pair)


def _pair(figure: Figure, crank: Crank, cranks: dict[str, Crank]) -> WheelPair | None:
    gear = crank.gear
    if gear is None or gear.mate not in cranks:
        return None
    driver = cranks[gear.mate]
    fixed = figure.linkage.joint(driver.pivot).fixed
    if crank.pivot == driver.name and fixed:
        return _planet(figure, crank, driver)
    apart = figure.start(crank.pivot) - figure.start(driver.pivot)
    if not (fixed and figure.linkage.joint(crank.pivot).fixed) or apart == 0:
        return None
    if gear.ratio > 0:
        return _pulleys((driver, crank), abs(apart), float(gear.ratio))
    return _meshing(figure, (driver, crank), apart)


def _pulleys(cranks: tuple[Crank, Crank], apart: float, ratio: float) -> WheelPair:
    driver, driven = cranks
    large = _BELT * apart
    return WheelPair(
        Wheel(driver.pivot, driver.name, large * min(ratio, 1)),
        Wheel(driven.pivot, driven.name, large * min(1 / ratio, 1)),
    )


def _meshing(figure: Figure, cranks: tuple[Crank, Crank], apart: complex) -> WheelPair:
    """Return two wheels on fixed pivots that turn against each other."""
    driver, driven = cranks
    assert driven.gear is not None
    ratio = abs(driven.gear.ratio)
    radius = abs(apart) * float(ratio / (1 + ratio))
    first, second = _teeth(ratio.numerator, ratio.denominator)
    contact = float(np.angle(apart))
    at = contact - _angle(figure, driver)
    facing = contact + pi - _angle(figure, driven) + pi / second
    return WheelPair(
        Wheel(driver.pivot, driver.name, radius, first, at),
        Wheel(driven.pivot, driven.name, abs(apart) - radius, second, facing),
    )


def _teeth(one: int, other: int) -> tuple[int, int]:
    """Return the numbers of teeth of two wheels whose radii are as these numbers."""
    many = max(ceil(_FEWEST / min(one, other)), round(_TEETH / (one + other)))
    return many * one, many * other


def _planet(figure: Figure, planet: Crank, arm: Crank) -> WheelPair | None:
    """Return the still wheel and the planet that rolls on it: r and R of radius, the arm d long.

    Rolling on it makes the planet turn 1 - R/r times as often as its arm inside a ring, where R - r = d,
    and 1 + R/r times outside a sun, where R + r = d; a belt from it, 1 - R/r times.
    """
    assert planet.gear is not None
    ratio, long = planet.gear.ratio, arm.length
    contact = _angle(figure, arm)
    if ratio < 0:
        still, small = _teeth(ratio.denominator - ratio.numerator, ratio.denominator)
        tooth = contact - _angle(figure, planet)
        rolling = Wheel(planet.pivot, planet.name, long / float(-ratio), small, tooth)
        return WheelPair(Wheel(arm.pivot, None, long + rolling.radius, still, contact, ring=True), rolling)
    if ratio > 1:
        still, small = _teeth(ratio.numerator - ratio.denominator, ratio.denominator)
        facing = contact + pi - _angle(figure, planet) + pi / small
        rolling = Wheel(planet.pivot, planet.name, long / float(ratio), small, facing)
        return WheelPair(Wheel(arm.pivot, None, long - rolling.radius, still, contact), rolling)
    if ratio < 1:
        large = _BELT * long
        still_wheel = Wheel(arm.pivot, None, large * float(1 - ratio))
        return WheelPair(still_wheel, Wheel(planet.pivot, planet.name, large))
    return None


def _angle(figure: Figure, crank: Crank) -> float:
    return float(np.angle(figure.start(crank.name) - figure.start(crank.pivot)))


def teeth_a_second(figure: Figure) -> float:
    """Return how many teeth of the fastest wheel turn past a direction in a second at the scene's speed."""
    step = figure.scene.period / len(figure.cycle.phase)
    fastest = 0.0
    for wheel in (wheel for pair in pairs(figure) for wheel in pair.wheels if wheel.arm):
        arm = figure.cycle.position[str(wheel.arm)] - figure.cycle.position[wheel.centre]
        turned = np.diff(np.unwrap(np.arctan2(arm[:, 1], arm[:, 0])))
        fastest = max(fastest, wheel.teeth * float(np.nanmax(np.abs(turned))) / step)
    return fastest * abs(figure.linkage.drive.speed) / (2 * pi)


def wheels(figure: Figure) -> Iterator[Wheel]:
    """Yield the wheels of all pairs."""
    for pair in pairs(figure):
        yield from pair.wheels


def wheel_layers(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return what does not turn: wheels and discs that stay where they are, and the belts between them."""
    layers = []
    for pair in pairs(figure):
        for wheel in (wheel for wheel in pair.wheels if _stays(figure, wheel)):
            still = [Layer(_tone(wheel, pair, theme), [disc(_root(wheel, view, gauge))])]
            shown = still if wheel.arm else _wheel(wheel, pair, (view, gauge, theme), moving=True)
            layers += Stamp(tuple(shown)).at([_centre(figure, view, wheel)])
        if not pair.driven.teeth and not pair.planetary:
            layers.append(Layer(theme.ground, list(_belt(_pulled(pair, figure, view), gauge))))
    return layers


def _stays(figure: Figure, wheel: Wheel) -> bool:
    return figure.linkage.joint(wheel.centre).fixed


def wheel_parts(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Part, ...]:
    """Return what turns or goes round: teeth, outlines, and holes that show how far a wheel has turned."""
    parts = []
    for pair in pairs(figure):
        for wheel in (wheel for wheel in pair.wheels if wheel.arm or not _stays(figure, wheel)):
            layers = _wheel(wheel, pair, (view, gauge, theme), moving=not _stays(figure, wheel))
            parts.append(Part(wheel.centre, wheel.centre, wheel.arm or wheel.centre, layers))
        if pair.planetary and not pair.driven.teeth:
            far = abs(figure.start(pair.driven.centre) - figure.start(pair.driver.centre)) * view.scale
            belt = (0j, complex(far), pair.driver.radius * view.scale, pair.driven.radius * view.scale)
            ends = pair.driver.centre, pair.driver.centre, pair.driven.centre
            parts.append(Part(*ends, (Layer(theme.ground, list(_belt(belt, gauge))),)))
    return tuple(parts)


def _wheel(
    wheel: Wheel, pair: WheelPair, drawn: tuple[View, Gauge, Theme], *, moving: bool
) -> tuple[Layer, ...]:
    """Return a wheel about the origin; one that only turns without its disc, which is drawn once."""
    view, gauge, theme = drawn
    tone, edge = _tone(wheel, pair, theme), _edge(wheel, pair, theme)
    rim = _rim(wheel, view, gauge, moving=moving)
    if wheel.ring:
        lines = [loop for outline in rim for loop in stroke(outline, gauge.outline, closed=True)]
        return Layer(tone, rim), Layer(edge, lines)
    root = _root(wheel, view, gauge)
    ways = directions(2 * pi / _HOLES * np.arange(_HOLES))
    holes = [way * (_HOLED * root) + disc(_HOLE * root) for way in ways]
    line = stroke(rim[0], gauge.outline, closed=True)
    return Layer(tone, rim), Layer(mixed(tone, theme.background, 0.6), holes), Layer(edge, line)


def turning_apart(figure: Figure, parts: Sequence[Part]) -> tuple[tuple[Part, ...], ...]:
    """Return the parts of wheels in sets that never lie over each other: rims with their lines, and holes.

    None where a wheel goes round, or lies before another's holes.
    """
    turning = [wheel for wheel in wheels(figure) if wheel.arm or not _stays(figure, wheel)]
    if not all(_stays(figure, wheel) for wheel in turning) or _overlapping(figure, turning):
        return ()
    rims = (replace(part, layers=(part.layers[0], part.layers[2])) for part in parts)
    # the outline of a pulley has equal sides instead of teeth
    folds = (wheel.teeth or len(part.layers[0].loops[0]) for part, wheel in zip(parts, turning, strict=True))
    return (
        tuple(replace(rim, fold=fold) for rim, fold in zip(rims, folds, strict=True)),
        tuple(replace(part, layers=part.layers[1:2], fold=_HOLES) for part in parts),
    )


def _overlapping(figure: Figure, turning: Sequence[Wheel]) -> bool:
    """Return whether one of these wheels reaches to where another has its holes."""
    holed = _HOLED + _HOLE
    return any(
        abs(figure.start(one.centre) - figure.start(other.centre)) < one.reach + holed * other.radius
        for one, other in permutations(turning, 2)
    )


def _tone(wheel: Wheel, pair: WheelPair, theme: Theme) -> Colour:
    return theme.gear if wheel is pair.driver else mixed(theme.gear, theme.ground, _SHADED)


def _edge(wheel: Wheel, pair: WheelPair, theme: Theme) -> Colour:
    return theme.ground if wheel is pair.driver else mixed(theme.ground, theme.outline, 0.5)


def _centre(figure: Figure, view: View, wheel: Wheel) -> complex:
    place = figure.start(wheel.centre)
    return view.place((place.real, place.imag))


def _module(wheel: Wheel, view: View) -> float:
    return 2 * wheel.radius * view.scale / wheel.teeth if wheel.teeth else 0.0


def _root(wheel: Wheel, view: View, gauge: Gauge) -> float:
    return max(wheel.radius * view.scale - 1.1 * _FOOT * _module(wheel, view) - gauge.line, 1.0)


def _rim(wheel: Wheel, view: View, gauge: Gauge, *, moving: bool) -> list[Loop]:
    """Return the outline; with a hole where the disc shows, and of a ring the outer edge before it."""
    radius = wheel.radius * view.scale
    if wheel.ring:
        return [disc(wheel.reach * view.scale), _toothed(wheel, radius, _TIP, _FOOT)[::-1]]
    hole = disc(max(_root(wheel, view, gauge) - gauge.line, 0.5))[::-1]
    outline = _toothed(wheel, radius, _FOOT, _TIP) if wheel.teeth else disc(radius)
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


def _pulled(pair: WheelPair, figure: Figure, view: View) -> tuple[complex, complex, float, float]:
    """Return the centres of two pulleys in pixels, and their radii."""
    radii = pair.driver.radius * view.scale, pair.driven.radius * view.scale
    return _centre(figure, view, pair.driver), _centre(figure, view, pair.driven), *radii


def _belt(pulled: tuple[complex, complex, float, float], gauge: Gauge) -> Iterator[Loop]:
    """Yield the two straight runs of an open belt."""
    one, other, first, second = pulled
    along = (other - one) / abs(other - one)
    lean = np.arccos((first - second) / abs(other - one))
    for side in (1, -1):
        normal = along * complex(directions(side * lean))
        yield from segments(one + first * normal, other + second * normal, 1.5 * gauge.line)
