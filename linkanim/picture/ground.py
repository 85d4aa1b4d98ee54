"""What stands still: pedestals with their hatching under fixed pins, and the guides of sliders."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkanim.mechanics.kinds import RRP
from linkanim.picture.bodies import BLOCK
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Layer, Loop
from linkanim.picture.shapes import rounded, segments, unit
from linkanim.picture.theme import Theme
from linkanim.picture.view import View


def ground_layers(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return pedestals and guides."""
    lines = [loop for slider in figure.sliders for loop in _guide(slider, figure, view, gauge)]
    layers = [Layer(theme.ground, lines)]
    for name in figure.fixed:
        layers += _pedestal(_pixel(figure, view, name), _away(figure, name), gauge, theme)
    return layers


def _pixel(figure: Figure, view: View, name: str) -> complex:
    place = figure.start(name)
    return view.place((place.real, place.imag))


def _away(figure: Figure, name: str) -> complex:
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


def _pedestal(pin: complex, away: complex, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return a foot that widens from the pin to a hatched line."""
    deep, wide, bar = 2.1 * gauge.bar, 1.75 * gauge.bar, gauge.bar
    foot = [0j, complex(-0.85 * wide, deep), complex(0.85 * wide, deep)]
    turn = away / 1j
    shape = [pin + turn * rounded(foot, 0.35 * bar)]
    inner = [pin + turn * rounded(foot, max(0.35 * bar - gauge.outline, 0.1))]
    base = complex(-1.35 * wide, deep + 0.35 * bar), complex(1.35 * wide, deep + 0.35 * bar)
    lines = [pin + turn * loop for loop in _hatched(*base, gauge, 1)]
    return [Layer(theme.ground, lines), Layer(theme.outline, shape), Layer(theme.gear, inner)]


def _hatched(begin: complex, end: complex, gauge: Gauge, side: int) -> Iterator[Loop]:
    """Yield a line and its hatching to one side (+1: where the imaginary part grows for a line along 1)."""
    along = unit(end - begin)
    length, step = abs(end - begin), 0.62 * gauge.bar
    count = max(round(length / step), 1)
    feet = begin + along * length * (np.arange(count) + 0.75) / count
    yield from segments(begin, end, 1.4 * gauge.line)
    yield from segments(feet, feet + along * (-0.5 + 0.62j * side) * gauge.bar, 0.8 * gauge.line)


def _guide(slider: RRP, figure: Figure, view: View, gauge: Gauge) -> Iterator[Loop]:
    """Yield the two rails that a block runs between, as long as its travel needs."""
    along = complex(np.exp(-1j * slider.line.angle))
    path = figure.path(slider.name, view)
    way = np.real(path * np.conj(along))
    across = float(np.nanmean(np.imag(path * np.conj(along))))
    beyond = (BLOCK[0] / 2 + 0.9) * gauge.bar
    near, far = float(np.nanmin(way)) - beyond, float(np.nanmax(way)) + beyond
    rail = (BLOCK[1] / 2) * gauge.bar + gauge.line
    for side in (1, -1):
        level = 1j * (across + side * rail)
        yield from _hatched(along * (near + level), along * (far + level), gauge, side)
