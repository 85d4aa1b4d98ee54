"""What stands still: pedestals with their hatching under fixed pins, and the guides of sliders."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np

from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts.fittings import Bench, hatched, rails_of
from linkanim.picture.raster.raster import Layer, Loop
from linkanim.picture.raster.shapes import rounded, segments, unit
from linkanim.picture.theme import Theme
from linkanim.picture.view import View


def ground_layers(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return pedestals and guides."""
    rails = *rails_of(Bench(figure, view, gauge, theme)), *rails_under(figure, view, gauge)
    layers = [Layer(theme.ground, [loop for rail in rails for loop in rail])]
    for name in figure.fixed:
        layers += pedestal(figure.pixel(name, view), away(figure, name), gauge, theme)
    return layers


def rails_under(figure: Figure, view: View, gauge: Gauge) -> Iterator[list[Loop]]:
    """Yield the outlines of each rail that wheels on fixed pins stand on, one under all of a level."""
    feet: dict[float, list[complex]] = {}
    for body in figure.bodies:
        if figure.scene.style(body.name).outline == "railwheel" and body.joints[0] in figure.fixed:
            radius = view.scale * figure.wheel_reach(body)
            foot = figure.pixel(body.joints[0], view) + 1j * radius
            feet.setdefault(round(foot.imag, 3), []).extend((foot - radius, foot + radius))
    for ends in feet.values():
        yield list(hatched(min(ends, key=np.real), max(ends, key=np.real), gauge, 1))


def away(figure: Figure, name: str) -> complex:
    """Return the way a pedestal points: down; away from its pull where it only holds springs and dampers."""
    struts = [strut for strut in figure.struts if name in strut.between]
    jointed = any(name in body.joints for body in figure.bodies)
    if jointed or not struts:
        return 1j
    other = next(end for end in struts[0].between if end != name)
    x, y = np.nanmean(np.atleast_2d(figure.cycle.position[other]), axis=0)
    here = figure.start(name)
    pull = unit(complex(float(x) - here.real, here.imag - float(y)))
    return -pull


def ground_line(names: Sequence[str], figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return the line of the ground from pivot to pivot, in dashes and dots."""
    loops = []
    for one, other in pairwise(figure.pixel(name, view) for name in names):
        marks = np.arange(0, abs(other - one), 9 * gauge.line)
        along = unit(other - one)
        dashes, dots = one + along * marks, one + along * (marks + 6.8 * gauge.line)
        loops += segments(dashes, dashes + 5 * along * gauge.line, 0.8 * gauge.line)
        loops += segments(dots, dots + 0.9 * along * gauge.line, 0.8 * gauge.line)
    return [Layer(theme.ground, loops)]


def pedestal_corners(figure: Figure, view: View, gauge: Gauge, name: str) -> list[complex]:
    """Return the corners of a triangle that holds a pedestal: its pin, and the ends of its hatching."""
    pin, turn = figure.pixel(name, view), away(figure, name) / 1j
    wide, deep = 1.35 * 1.75 * gauge.bar + 0.5 * gauge.bar, 3.1 * gauge.bar
    return [pin, pin + turn * complex(-wide, deep), pin + turn * complex(wide, deep)]


@lru_cache(maxsize=32)
def pedestal(pin: complex, away: complex, gauge: Gauge, theme: Theme) -> tuple[Layer, ...]:
    """Return the foot of a fixed pin, in pixels: it widens from the pin to a hatched line, the way `away`."""
    deep, wide, bar = 2.1 * gauge.bar, 1.75 * gauge.bar, gauge.bar
    foot = [0j, complex(-0.85 * wide, deep), complex(0.85 * wide, deep)]
    turn = away / 1j
    shape = [pin + turn * rounded(foot, 0.35 * bar)]
    inner = [pin + turn * rounded(foot, max(0.35 * bar - gauge.outline, 0.1))]
    base = complex(-1.35 * wide, deep + 0.35 * bar), complex(1.35 * wide, deep + 0.35 * bar)
    lines = [pin + turn * loop for loop in hatched(*base, gauge, 1)]
    return Layer(theme.ground, lines), Layer(theme.outline, shape), Layer(theme.gear, inner)
